//! What is said about every epsilon against running the kernel at it.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::epsilon::Axis;
use hairline::internals::explore::inputs::{AnyInput, from_bytes};
use hairline_fuzz::check_response;
use hairline_fuzz::hold;
use std::sync::LazyLock;

static NARROW: LazyLock<Axis<f32>> = LazyLock::new(|| Axis::new(&[]));
static WIDE: LazyLock<Axis<f64>> = LazyLock::new(|| Axis::new(&[]));

fn compare(data: &[u8]) {
    match from_bytes(data) {
        AnyInput::F32(input) => hold(check_response(&input, &NARROW)),
        AnyInput::F64(input) => hold(check_response(&input, &WIDE)),
    }
}

hairline_fuzz::target!(compare, cases);
