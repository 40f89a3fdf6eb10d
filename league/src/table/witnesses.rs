//! The worst known cases as corpus lines, one file a kernel, which tests/witnesses.rs runs again.

use super::columns::worst;
use super::rows::TableRow;
use hairline::internals::arith::Float;
use hairline::internals::audit::Row;
use hairline::internals::case::Case;
use hairline::internals::corpus::lines::{AnyCase, write_case};
use hairline::internals::explore::campaign::Find;
use hairline::internals::kernel::{find, register};
use hairline::internals::report::Example;
use hairline_league::kernels;
use std::collections::BTreeMap;
use std::fs;

/// Writes the worst false miss and false hit of each built-in entrant and scalar. Files of entrants that
/// the records do not have stay.
pub fn write(folder: &str, rows: &[TableRow]) -> Result<(), String> {
    for kernel in kernels().into_iter().filter(|kernel| find(kernel.info.name).is_none()) {
        register(kernel)?;
    }
    let mut files: BTreeMap<&str, String> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.entrant.kernel.is_some()) {
        for finding in ["false-miss", "false-hit"] {
            if let Some((_, example)) = worst(row, finding) {
                let line = line(row, example)?;
                files.entry(row.entrant.name).or_default().push_str(&format!("{line}\n"));
            }
        }
    }
    for (kernel, text) in files {
        let path = format!("{folder}/{kernel}.jsonl");
        fs::write(&path, text).map_err(|error| format!("{path}: {error}"))?;
    }
    Ok(())
}

/// A line of a corpus file, with what the kernel shows on the case.
fn line(row: &TableRow, example: &Example) -> Result<String, String> {
    let wrong = |message: &str| format!("{} {}: {message}", row.entrant.name, example.case);
    let case = match row.scalar {
        "f32" => AnyCase::F32(case(&example.bits, |bits| f32::from_bits(bits as u32))),
        _ => AnyCase::F64(case(&example.bits, f64::from_bits)),
    };
    let kernel = Row::named(row.entrant.name, None, "own").map_err(|error| wrong(&error.0))?;
    let mut find = Find::of(&kernel, case).ok_or(wrong("it shows nothing"))?;
    find.from = Some(example.case.clone());
    Ok(write_case(&find.stored()))
}

/// From `o=…,…,… d=… a=… b=… c=… t=…,…`, in hexadecimal bits.
fn case<F: Float>(text: &str, number: impl Fn(u64) -> F) -> Case<F> {
    let words = text.split(' ').flat_map(|word| word[2..].split(','));
    let numbers: Vec<F> =
        words.map(|word| number(u64::from_str_radix(word, 16).expect("a record's bits"))).collect();
    let triple = |i: usize| [numbers[i], numbers[i + 1], numbers[i + 2]];
    Case::new(triple(0), triple(3), [triple(6), triple(9), triple(12)]).on(numbers[15], numbers[16])
}
