//! The fast oracle against its definition in rationals, one by one, in lanes and in columns.
#![cfg_attr(fuzzing, no_main)]

use hairline_fuzz::{check_oracle, hold, with_input};

fn compare(data: &[u8]) {
    with_input!(data, |input| hold(check_oracle(&input.case)));
}

hairline_fuzz::target!(compare, cases);
