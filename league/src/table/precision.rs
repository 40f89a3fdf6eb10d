//! Whose errors in `f32` go away when the same function runs on the same case in `f64`.

use super::columns::percent;
use hairline::internals::audit::EpsilonChoice;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::contract::Direction;
use hairline::internals::family::FAMILIES;
use hairline::internals::judge::{asked, judge};
use hairline::internals::kernel::{Entry, Scalar, Subject, Verdict};
use hairline::internals::oracle;
use hairline_league::kernels;
use std::fmt::Write;

/// Cases of each family.
const COUNT: u64 = 1000;

/// One row for each kernel of both scalars.
pub fn table() -> String {
    let mut text = "Of the false verdicts in `f32`, those that are right when the same function is given \
        the same numbers in `f64`: what is left then is not a matter of precision (but of a formula or an \
        epsilon), and what goes is, or of an epsilon that is smaller in `f64`.\n\n\
        | kernel | gone in f64 | left |\n|---|---|---|\n"
        .to_owned();
    for entry in kernels() {
        if let (Some(narrow), Some(wide)) = (f32::subject(&entry), f64::subject(&entry)) {
            let [gone, left] = count(&entry, narrow, wide);
            let (gone, left) = (percent(gone, gone + left), percent(left, gone + left));
            writeln!(text, "| {} | {gone} % | {left} % |", entry.info.name).unwrap();
        }
    }
    text.push('\n');
    text
}

fn count(entry: &Entry, narrow: &dyn Subject<f32>, wide: &dyn Subject<f64>) -> [u64; 2] {
    let unit_direction = entry.info.contract.direction != Direction::Any;
    let parameters = Parameters { unit_direction, ..Parameters::default() };
    let mut counts = [0; 2];
    for family in FAMILIES {
        for index in 0..COUNT {
            for case in family.make::<f32>(&parameters, 1, index).cases() {
                if is_false(entry, narrow, case, case) {
                    let left = is_false(entry, wide, &case.widen(), case);
                    counts[usize::from(left)] += 1;
                }
            }
        }
    }
    counts
}

/// Whether the verdict is false; what is asked is asked of the narrow case, whose direction counts.
fn is_false<F: Scalar>(
    entry: &Entry,
    subject: &dyn Subject<F>,
    case: &Case<F>,
    narrow: &Case<f32>,
) -> bool {
    let truth = oracle::truth(narrow);
    let asked = asked(narrow, &truth, &entry.info.contract, false);
    let mut verdict = [Verdict::miss(None)];
    subject.run(std::slice::from_ref(case), &epsilons::<F>(entry), &mut verdict);
    judge(asked, &truth, entry.info.gives, &verdict[0]).is_some()
}

/// The epsilons of the kernel's source.
fn epsilons<F: Scalar>(entry: &Entry) -> Vec<F> {
    let entry: &'static Entry = Box::leak(Box::new(*entry));
    let rows = EpsilonChoice::Source.rows(&[entry], None).expect("its own epsilons");
    rows[0].epsilons()
}
