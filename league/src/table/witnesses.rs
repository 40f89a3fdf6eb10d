//! The worst known cases as corpus lines, one file a kernel, which tests/witnesses.rs runs again.

use hairline::internals::arith::Float;
use hairline::internals::audit::Row;
use hairline::internals::case::Case;
use hairline::internals::corpus::lines::{AnyCase, write_case};
use hairline::internals::explore::campaign::Find;
use hairline::internals::kernel::{find, register};
use hairline_league::edition::{Depth, EntrantResult};
use hairline_league::kernels;
use std::fs;

/// Writes the deepest false miss and false hit of each built-in entrant and scalar. Files of entrants that
/// the edition does not have stay.
pub fn write(folder: &str, results: &[EntrantResult]) -> Result<(), String> {
    for kernel in kernels().into_iter().filter(|kernel| find(kernel.info.name).is_none()) {
        register(kernel)?;
    }
    for entrant in results.iter().filter(|entrant| find(&entrant.kernel).is_some()) {
        let mut text = String::new();
        for (scalar, result) in &entrant.scalars {
            for depth in [&result.deepest_miss, &result.deepest_hit].into_iter().flatten() {
                text.push_str(&line(&entrant.kernel, scalar, depth)?);
                text.push('\n');
            }
        }
        let path = format!("{folder}/{}.jsonl", entrant.kernel);
        fs::write(&path, text).map_err(|error| format!("{path}: {error}"))?;
    }
    Ok(())
}

/// A line of a corpus file, with what the kernel shows on the case.
fn line(kernel: &str, scalar: &str, depth: &Depth) -> Result<String, String> {
    let wrong = |message: &str| format!("{kernel} {}: {message}", depth.case);
    let case = match scalar {
        "f32" => AnyCase::F32(case(&depth.bits, |bits| f32::from_bits(bits as u32))),
        _ => AnyCase::F64(case(&depth.bits, f64::from_bits)),
    };
    let row = Row::named(kernel, None, "own").map_err(|error| wrong(&error.0))?;
    let mut find = Find::of(&row, case).ok_or(wrong("it shows nothing"))?;
    find.from = Some(depth.case.clone());
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
