//! The verdicts of kernels on a case and on the triangles of a group, and the judgement of the latter.

use crate::arith::Float;
use crate::audit::Row;
use crate::case::{Case, Instance};
use crate::contract::Across;
use crate::family::Grouping;
use crate::judge::{GroupTruth, group_obligation, may_be_elsewhere};
use crate::kernel::{KernelIn, Scalar, Verdict, verdicts_of};
use crate::oracle::{self, Layers};
use crate::truth::Truth;
use std::slice;

/// One case, or the triangles of a group with one ray.
#[derive(Clone, Copy)]
pub struct Together<'a, F: Scalar> {
    /// The ray and each triangle. With an instance the ray is of the world, and kernels get it by the rounded inverse.
    pub cases: &'a [Case<F>],
    /// How they belong together.
    pub grouping: Grouping,
    /// The triangles around those of the group; none if they are too many to be asked, or cannot be made.
    pub neighbours: Option<&'a [Case<F>]>,
    /// Where the triangles are put, if not where they are.
    pub instance: Option<&'a Instance<F>>,
}

impl<F: Scalar> Together<'_, F> {
    /// Cases as kernels get them, and their truths, which are of the world.
    pub(super) fn asked(&self, cases: &[Case<F>]) -> (Vec<Case<F>>, Vec<Truth>) {
        let (mut truths, layers) = (Vec::new(), &mut Layers::default());
        let Some(instance) = self.instance else {
            oracle::truths(cases, &mut truths, layers);
            return (cases.to_vec(), truths);
        };
        oracle::truths_of_instance(cases, instance, &mut truths, layers);
        (
            cases.iter().map(|case| instance.in_object(case)).collect(),
            truths,
        )
    }
}

/// The fewest digits that read back as the number in its scalar.
pub(crate) fn number<F: Float>(x: F) -> String {
    plain(&format!("{x:e}"))
}

/// A size in three digits.
pub(super) fn short(x: f64) -> String {
    let text = format!("{x:.2e}");
    if (1e4..1e7).contains(&x.abs()) {
        text
    } else {
        plain(&text)
    }
}

/// A number as `1.5e0` writes it, to the same digits: without an exponent where it is neither large nor small.
pub(super) fn plain(text: &str) -> String {
    let Some((mantissa, exponent)) = text.split_once('e') else {
        return text.to_owned();
    };
    let Ok(exponent) = exponent.parse::<i32>() else {
        return text.to_owned();
    };
    let (sign, mantissa) = mantissa
        .strip_prefix('-')
        .map_or(("", mantissa), |digits| ("-", digits));
    let digits = mantissa.replace('.', "");
    let (whole, rest) = match exponent {
        0..7 => {
            let digits = format!("{digits:0<width$}", width = exponent as usize + 1);
            let (whole, rest) = digits.split_at(exponent as usize + 1);
            (whole.to_owned(), rest.to_owned())
        }
        -4..0 => (
            "0".to_owned(),
            format!("{}{digits}", "0".repeat(-exponent as usize - 1)),
        ),
        _ => (digits[..1].to_owned(), digits[1..].to_owned()),
    };
    let rest = rest.trim_end_matches('0');
    let point = if rest.is_empty() { "" } else { "." };
    let end = if (-4..7).contains(&exponent) {
        String::new()
    } else {
        format!("e{exponent}")
    };
    format!("{sign}{whole}{point}{rest}{end}")
}

/// The verdict of a kernel.
pub(super) fn verdict_of<F: Scalar>(
    subject: &dyn KernelIn<F>,
    case: &Case<F>,
    epsilons: &[F],
) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    verdicts_of(subject, slice::from_ref(case), epsilons, &mut verdict);
    let [verdict] = verdict;
    verdict
}

/// How many triangles are hit, the judgement in words, and if it is wrong; or why there is none.
pub(super) fn group_verdict<F: Scalar>(
    group: Together<F>,
    row: &Row,
    subject: &dyn KernelIn<F>,
) -> Result<(usize, &'static str, bool), String> {
    let (cases, truths) = &group.asked(group.cases);
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    verdicts_of(subject, cases, &row.epsilons::<F>(), &mut verdicts);
    if let Some(failure) = verdicts.iter().find_map(|verdict| verdict.failure) {
        return Err(failure.to_string());
    }
    let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
    let asked = group_obligation(cases, truths, &row.contract, group.grouping);
    let (judged, is_wrong) = match (asked, hits) {
        (GroupTruth::Free, _) => ("nothing is asked of the group", false),
        (GroupTruth::Crossing, 0) if is_elsewhere(&truths[0], group, row) => (
            "one hit is right, and rounding may have moved it to a neighbour: elsewhere",
            false,
        ),
        (GroupTruth::Crossing, 0) => ("one hit is right: CRACK", true),
        (GroupTruth::Crossing, 1) => ("one hit is right", false),
        (GroupTruth::Crossing, _) if row.contract.across == Across::ExactlyOne => {
            ("one hit is right: DOUBLE", true)
        }
        (GroupTruth::Crossing, _) => ("a double, which its contract allows", false),
        (GroupTruth::Fold { odd }, hits) if (hits % 2 == 1) == odd => {
            ("at a fold: the parity is right", false)
        }
        (GroupTruth::Fold { .. }, _) => ("at a fold: the parity is WRONG", true),
    };
    Ok((hits, judged, is_wrong))
}

/// True if a hit that a group lacks may be among the triangles around it, or these are too many.
fn is_elsewhere<F: Scalar>(truth: &Truth, group: Together<F>, row: &Row) -> bool {
    let Some(crossing) = truth.crossing() else {
        return false;
    };
    let Some(neighbours) = group.neighbours else {
        return true;
    };
    let Some(subject) = F::subject(row.entry) else {
        return false;
    };
    let (neighbours, truths) = group.asked(neighbours);
    let mut verdicts = vec![Verdict::miss(None); neighbours.len()];
    verdicts_of(subject, &neighbours, &row.epsilons::<F>(), &mut verdicts);
    may_be_elsewhere(
        crossing.facing,
        &neighbours,
        &truths,
        &verdicts,
        &row.contract,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_digits_without_needless_exponents() {
        for (text, expected) in [
            ("1.000000e0", "1"),
            ("-8.999999e0", "-8.999999"),
            ("2.5e-1", "0.25"),
            ("-1.2e-4", "-0.00012"),
            ("1.2e-5", "1.2e-5"),
            ("2.50e6", "2500000"),
            ("1.234567e3", "1234.567"),
            ("6.40e7", "6.4e7"),
            ("0e0", "0"),
            ("inf", "inf"),
            ("below 1e-6", "below 1e-6"),
        ] {
            assert_eq!(plain(text), expected, "{text}");
        }
    }
}
