//! Recomputes the truth of many boxes by its definition in rationals and by integers that share no formula with it, and
//! counts the differences: `cargo run --release -p hairline-boxes --example recompute -- 10000000`.

#[path = "../tests/reference/mod.rs"]
mod reference;

use hairline_boxes::{FAMILIES, FamilyScalar, check};
use hairline_core::engine::{Merge, Unobserved, sum};
use std::ops::Range;
use std::process::ExitCode;

#[derive(Default)]
struct Differences {
    first: Option<String>,
    count: u64,
}

impl Merge for Differences {
    fn merge(&mut self, other: Differences) {
        self.count += other.count;
        self.first = self.first.take().or(other.first);
    }
}

fn compare<F: FamilyScalar>(index: u64, found: &mut Differences) {
    // Half of them of families, half of cases that are hard to decide.
    let case = if index % 4 < 2 {
        FAMILIES[index as usize / 4 % FAMILIES.len()].case::<F>(2, index)
    } else {
        reference::hard_case::<F>(2, index)
    };
    let independent = reference::truth(&case.widen());
    let difference = match check(&case) {
        Err(difference) => difference,
        Ok(defined) if defined != independent => {
            format!("{defined:?} {independent:?} {}", case.hex())
        }
        Ok(_) => return,
    };
    found.count += 1;
    found.first.get_or_insert(difference);
}

fn main() -> ExitCode {
    let count = std::env::args()
        .nth(1)
        .and_then(|text| text.parse().ok())
        .unwrap_or(100_000);
    let add = |found: &mut Differences, indices: Range<u64>| {
        for index in indices {
            match index % 2 {
                0 => compare::<f32>(index, found),
                _ => compare::<f64>(index, found),
            }
        }
    };
    let found = sum(0..count, 1024, &Unobserved, Differences::default, add);
    println!("{count} boxes, {} differences", found.count);
    match found.first {
        None => ExitCode::SUCCESS,
        Some(difference) => {
            println!("{difference}");
            ExitCode::FAILURE
        }
    }
}
