//! One kernel, named by HAIRLINE_KERNEL, judged by the oracle under its contract. Its disagreements end
//! the run if HAIRLINE_FINDING names them; see `hairline_fuzz::Pinned` for what else can be asked.
#![cfg_attr(fuzzing, no_main)]

use hairline_fuzz::{Pinned, check_kernel, hold, with_input};
use std::sync::LazyLock;

static PINNED: LazyLock<Pinned> = LazyLock::new(Pinned::from_environment);

fn judge(data: &[u8]) {
    with_input!(data, |input| {
        let input = PINNED.pin(input);
        hold(check_kernel(&input));
        hold(PINNED.unwanted(&input));
    });
}

hairline_fuzz::target!(judge, cases);
