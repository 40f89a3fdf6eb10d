//! Writes `fuzz/seeds/cases`, the start of every target over cases: each construction in each scalar,
//! and a spread of the curated cases, kernels in turn. Run it from the repository's root.

use hairline::internals::case::Draw;
use hairline::internals::corpus::lines::{AnyCase, read};
use hairline::internals::explore::inputs::{AnyInput, CONSTRUCTIONS, Input, MAX_GATES, to_bytes};
use hairline::internals::kernel::KERNELS;
use std::fs;

fn main() {
    let folder = "fuzz/seeds/cases";
    fs::create_dir_all(folder).expect("a folder that can be made");
    let write = |name: String, bytes: Vec<u8>| {
        fs::write(format!("{folder}/{name}"), bytes).expect("a file that can be written");
    };
    for kind in 0..CONSTRUCTIONS.len() as u8 {
        for scalar in 0..2u8 {
            let mut draw = Draw::new("seeds", scalar.into(), kind.into());
            let mut bytes = vec![scalar, draw.bits() as u8];
            bytes.extend([(); MAX_GATES].map(|()| draw.bits() as u8 & 0x7f));
            bytes.push(kind);
            bytes.extend((0..24).map(|_| draw.bits() as u8));
            write(format!("construction-{kind}-{scalar}"), bytes);
        }
    }
    let curated = fs::read("corpora/curated.jsonl").expect("the curated cases");
    for (i, stored) in read(&curated[..], "curated")
        .flatten()
        .step_by(16)
        .enumerate()
    {
        let entry = &KERNELS[i % KERNELS.len()];
        let input = match stored.case {
            AnyCase::F32(case) => AnyInput::F32(Input::of_source(entry, case)),
            AnyCase::F64(case) => AnyInput::F64(Input::of_source(entry, case)),
        };
        write(format!("curated-{i:02}"), to_bytes(&input));
    }
}
