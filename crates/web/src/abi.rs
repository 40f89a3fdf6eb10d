//! The functions that JavaScript calls, and the one that it gives. Bytes go through one buffer each way, which the
//! module owns; a call may move it, so its place is asked for after each.

#![allow(unsafe_code)]

use crate::{request, truths};
use std::cell::RefCell;

thread_local! {
    /// The bytes that JavaScript writes; in doubles, so that it is aligned for them.
    static INPUT: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
    /// A file that requests may be about.
    static FILE: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    /// The bytes that JavaScript reads.
    static OUTPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

#[link(wasm_import_module = "hairline")]
unsafe extern "C" {
    /// The verdicts of JavaScript's kernel: 17 numbers a case in, 4 a verdict out.
    fn kernel(
        cases: *const f64,
        count: usize,
        epsilons: *const f64,
        gates: usize,
        verdicts: *mut f64,
    );
}

/// Has JavaScript's kernel answer for some cases.
pub fn run(cases: &[[f64; 17]], epsilons: &[f64], verdicts: &mut [[f64; 4]]) {
    assert_eq!(cases.len(), verdicts.len());
    let (input, output) = (cases.as_ptr().cast(), verdicts.as_mut_ptr().cast());
    // SAFETY: the pointers are those of slices of the lengths that go with them, and JavaScript keeps none.
    unsafe {
        kernel(
            input,
            cases.len(),
            epsilons.as_ptr(),
            epsilons.len(),
            output,
        )
    }
}

/// Room for so many bytes, and where it is.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(bytes: usize) -> *mut f64 {
    INPUT.with_borrow_mut(|input| {
        input.clear();
        input.resize(bytes.div_ceil(8), 0.0);
        input.as_mut_ptr()
    })
}

/// Answers a request of so many bytes of JSON; the answer's length.
#[unsafe(no_mangle)]
pub extern "C" fn ask(bytes: usize) -> usize {
    let text = input_bytes(bytes);
    let answer = FILE.with_borrow(|file| request::answer(&text, file));
    put(answer.into_bytes())
}

/// Keeps so many bytes as the file of later requests.
#[unsafe(no_mangle)]
pub extern "C" fn keep_file(bytes: usize) {
    let bytes = input_bytes(bytes);
    FILE.with_borrow_mut(|file| *file = bytes);
}

/// The truths of so many cases of 17 numbers, 4 bytes each; the answer's length.
#[unsafe(no_mangle)]
pub extern "C" fn truths(count: usize, in_f32: bool) -> usize {
    let codes = INPUT.with_borrow(|input| truths::codes(&input[..count * 17], in_f32));
    put(codes)
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    OUTPUT.with_borrow(|output| output.as_ptr())
}

fn put(bytes: Vec<u8>) -> usize {
    OUTPUT.with_borrow_mut(|output| {
        *output = bytes;
        output.len()
    })
}

fn input_bytes(count: usize) -> Vec<u8> {
    INPUT.with_borrow(|input| {
        input
            .iter()
            .flat_map(|number| number.to_ne_bytes())
            .take(count)
            .collect()
    })
}
