//! Orientation predicates against the determinant in rationals.
#![cfg_attr(fuzzing, no_main)]

use hairline_fuzz::{check_orientation, hold, with_input};

fn compare(data: &[u8]) {
    with_input!(data, |input| hold(check_orientation(&input.case)));
}

hairline_fuzz::target!(compare, cases);
