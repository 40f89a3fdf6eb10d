//! The worst known cases as corpus lines, one file a kernel, which tests/witnesses.rs runs again.

use hairline::internals::audit::Row;
use hairline::internals::corpus::lines::write_case;
use hairline::internals::explore::campaign::Find;
use hairline::internals::kernel::find;
use hairline_league::edition::{Depth, EntrantResult};
use hairline_league::register;
use std::fs;

/// Writes the deepest false miss and false hit of each built-in entrant and scalar. Files of entrants that
/// the edition does not have stay.
pub fn write(folder: &str, results: &[EntrantResult]) -> Result<(), String> {
    register()?;
    for entrant in results
        .iter()
        .filter(|entrant| find(&entrant.kernel).is_some())
    {
        let mut text = String::new();
        for (scalar, result) in &entrant.scalars {
            for depth in [&result.deepest_miss, &result.deepest_hit]
                .into_iter()
                .flatten()
            {
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
    let row = Row::named(kernel, None, "own").map_err(|error| wrong(&error.to_string()))?;
    let mut find = Find::of(&row, depth.case(scalar)).ok_or(wrong("it shows nothing"))?;
    find.found.from = Some(depth.case.clone());
    Ok(write_case(&find.stored()))
}
