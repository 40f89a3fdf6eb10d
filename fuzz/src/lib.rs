//! What the fuzz targets share. Each target is a libFuzzer program under cargo-fuzz, and without it a
//! plain program that replays the files and folders named on its command line.

mod checks;
mod pinned;

pub use checks::*;
pub use pinned::Pinned;

use hairline::internals::case::Draw;
use hairline::internals::explore::inputs;
use std::{env, fs, path::Path};

/// Declares a fuzz target over bytes: `target!(function)`; with `target!(function, cases)` bytes are
/// inputs of `hairline::internals::explore::inputs`, which are moved as such.
#[macro_export]
macro_rules! target {
    ($function:path $(, $cases:ident)?) => {
        #[cfg(fuzzing)]
        libfuzzer_sys::fuzz_target!(|data: &[u8]| $function(data));

        $($crate::target!(@mutator $cases);)?

        #[cfg(not(fuzzing))]
        fn main() {
            $crate::replay($function);
        }
    };
    (@mutator cases) => {
        #[cfg(fuzzing)]
        libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
            $crate::move_input(data, size, max_size, seed)
                .unwrap_or_else(|| libfuzzer_sys::fuzzer_mutate(data, size, max_size))
        });
    };
}

/// Moves the input in `data[..size]` one or two steps, and gives its new size; none, for libFuzzer's own
/// mutations, once in four and where it does not fit.
pub fn move_input(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> Option<usize> {
    let mut draw = Draw::new("fuzz", u64::from(seed), 0);
    if draw.below(4) == 0 {
        return None;
    }
    let mut input = inputs::mutated(&inputs::from_bytes(&data[..size]), &mut draw);
    if draw.coin() {
        input = inputs::mutated(&input, &mut draw);
    }
    let bytes = inputs::to_bytes(&input);
    let fits = bytes.len() <= max_size.min(data.len());
    fits.then(|| {
        data[..bytes.len()].copy_from_slice(&bytes);
        bytes.len()
    })
}

/// Calls a generic function with the input that bytes are, in its scalar.
#[macro_export]
macro_rules! with_input {
    ($data:expr, |$input:ident| $body:expr) => {
        match hairline::internals::explore::inputs::from_bytes($data) {
            hairline::internals::explore::inputs::AnyInput::F32($input) => $body,
            hairline::internals::explore::inputs::AnyInput::F64($input) => $body,
        }
    };
}

/// Ends a target's run where two parts of hairline contradict each other.
pub fn hold<T, E: std::fmt::Display>(result: Result<T, E>) {
    if let Err(contradiction) = result {
        panic!("{contradiction}");
    }
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
        return entries
            .map(|entry| replay_path(&entry.expect("an entry").path(), target))
            .sum();
    }
    target(&fs::read(path).expect("a file that can be read"));
    1
}
