//! Every kernel, in both scalars, at any epsilons, judged by the oracle under its contract. What ends a
//! run is our own: a panic on the way, or a verdict that the margins contradict. A disagreement of the
//! kernel does not: kernels with epsilons have millions.
#![cfg_attr(fuzzing, no_main)]

use hairline_fuzz::{check_kernel, check_oracle, disagreement, hold, with_input};

fn judge(data: &[u8]) {
    with_input!(data, |input| {
        hold(check_oracle(&input.case));
        hold(check_kernel(&input));
        std::hint::black_box(disagreement(&input));
    });
}

hairline_fuzz::target!(judge, cases);
