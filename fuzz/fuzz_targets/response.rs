//! What is said about every epsilon against running the kernel at it.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::explore::inputs::{AnyInput, from_bytes};
use hairline_fuzz::check_response;
use hairline_fuzz::hold;

fn compare(data: &[u8]) {
    match from_bytes(data) {
        AnyInput::F32(input) => hold(check_response(&input)),
        AnyInput::F64(input) => hold(check_response(&input)),
    }
}

hairline_fuzz::target!(compare, cases);
