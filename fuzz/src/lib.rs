//! What the fuzz targets share. Each target is a libFuzzer program under cargo-fuzz, and without it a
//! plain program that replays the files and folders named on its command line.

use hairline::arith::Float;
use hairline::case::Case;
use std::{env, fs, path::Path};

/// Declares a fuzz target over bytes.
#[macro_export]
macro_rules! target {
    ($function:path) => {
        #[cfg(fuzzing)]
        libfuzzer_sys::fuzz_target!(|data: &[u8]| $function(data));

        #[cfg(not(fuzzing))]
        fn main() {
            $crate::replay($function);
        }
    };
}

/// Runs a target on every file named on the command line, and on every file of every folder.
pub fn replay(target: fn(&[u8])) {
    let mut count = 0;
    for path in env::args_os().skip(1) {
        count += replay_path(Path::new(&path), target);
    }
    println!("{count} inputs replayed");
    assert!(count > 0, "no input to replay: name files or folders");
}

fn replay_path(path: &Path, target: fn(&[u8])) -> usize {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a folder that can be read");
        return entries.map(|entry| replay_path(&entry.expect("an entry").path(), target)).sum();
    }
    target(&fs::read(path).expect("a file that can be read"));
    1
}

/// A case near trouble, from bytes: the first one chooses how the others become coordinates (a small
/// lattice, raw bits, or lattice points moved by ulps), so that mutations keep coincidences.
pub fn case<F: Float>(data: &[u8]) -> Case<F> {
    let byte = |i: usize| data.get(i).copied().unwrap_or(0);
    let mode = byte(0) % 3;
    let number = |k: usize| -> F {
        let raw: u64 = (0..8).fold(0, |bits, i| bits << 8 | u64::from(byte(1 + 8 * k + i)));
        let lattice = F::from_f64(f64::from((byte(1 + 8 * k) % 9) as i8 - 4));
        match mode {
            0 => lattice,
            1 => F::from_bits(raw),
            _ => lattice.offset_ulps(i64::from((raw as u8 % 7) as i8 - 3)),
        }
    };
    let vector = |v: usize| std::array::from_fn(|i| number(3 * v + i));
    let case = Case::new(vector(0), vector(1), [vector(2), vector(3), vector(4)]);
    if byte(0) & 0x80 == 0 { case } else { case.on(number(15), number(16)) }
}
