//! Kernels that are one test under several names: what one of them answers, all of them answer.

use super::Entry;

/// The kernels that are one test of a triangle, in the machine's own arithmetic: the same gates with the same margins,
/// the same values, contract and sets of epsilons. So a study of one of them is a study of all. The tests below
/// compare every kernel with every other one, and fail if this table says too much or too little.
const ONE_TEST: &[&[&str]] = &[
    // To store N and D with the triangle, or to loop over the edges of any polygon, changes no number of the listing.
    &[
        "plane-inside-out",
        "plane-inside-out-precomputed",
        "convex-polygon",
    ],
];

impl Entry {
    /// True if another kernel is the same test of a triangle, under this name or another.
    pub fn is_one_test_with(&self, other: &Entry) -> bool {
        let [own, other] = [self, other].map(|entry| entry.info.name);
        let has_both = |names: &&[&str]| names.contains(&own) && names.contains(&other);
        own == other || ONE_TEST.iter().any(has_both)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::Float;
    use crate::case::{Case, hard_cases};
    use crate::kernel::{KERNELS, Scalar, Verdict};

    /// A number as bits; all NaNs are one.
    fn bits<F: Float>(x: F) -> u64 {
        if x.is_nan() { u64::MAX } else { x.to_bits() }
    }

    /// All that a study reads of a kernel on a case: its margins, the values of a hit, and its verdicts.
    fn answers<F: Scalar>(entry: &Entry, case: &Case<F>) -> Vec<u64> {
        let (info, subject) = (entry.info, F::subject(entry).unwrap());
        let (cases, width) = ([*case], info.gates.len());
        let (mut margins, mut values) = (vec![F::zero(); width], [None]);
        subject.margins(info, &cases, &mut margins, &mut values);
        let mut answers: Vec<u64> = margins.into_iter().map(bits).collect();
        if let [Some(hit)] = &values {
            answers.push(hit.facing.map_or(0, |facing| 1 + facing as u64));
            answers.extend(hit.numbers().map(|x| bits(*x)));
        }
        for epsilon in [0.0, 1e-6] {
            let mut verdicts = [Verdict::miss(None)];
            subject.run(&cases, &vec![F::from_f64(epsilon); width], &mut verdicts);
            let [verdict] = verdicts;
            answers.push(verdict.refused_by.map_or(0, |gate| 1 + u64::from(gate)));
            answers.extend([verdict.t, verdict.u, verdict.v].map(bits));
        }
        answers
    }

    /// The first case on which two kernels do not answer alike.
    fn first_difference<F: Scalar>(one: &Entry, other: &Entry, count: u64) -> Option<String> {
        let differ = |case: &Case<F>| answers(one, case) != answers(other, case);
        let found = hard_cases::<F>(1, count).into_iter().find(differ)?;
        Some(found.hex())
    }

    /// The rest that a study reads of a kernel, and its programs, path by path.
    fn description(entry: &Entry) -> String {
        let info = entry.info;
        let paths = f32::subject(entry).unwrap().gated().unwrap().paths();
        format!(
            "{:?} {:?} {:?} {:?} {paths:?}",
            info.contract, info.gates, info.epsilon_sets, info.gives
        )
    }

    #[test]
    fn the_table_has_all_kernels_that_are_one_test_and_no_others() {
        let mut same = 0;
        for (place, one) in KERNELS.iter().enumerate() {
            for other in &KERNELS[..place] {
                let names = [one, other].map(|entry| entry.info.name);
                if one.is_one_test_with(other) {
                    same += 1;
                    assert!(description(one) == description(other), "{names:?}");
                    assert_eq!(
                        first_difference::<f32>(one, other, 20_000),
                        None,
                        "{names:?}"
                    );
                    assert_eq!(
                        first_difference::<f64>(one, other, 20_000),
                        None,
                        "{names:?}"
                    );
                } else {
                    let difference = first_difference::<f32>(one, other, 20_000);
                    assert!(difference.is_some(), "{names:?} answer alike");
                }
            }
        }
        assert_eq!(same, 3);
    }

    #[test]
    fn names_that_are_no_kernels_are_not_in_the_table() {
        for name in ONE_TEST.concat() {
            let known = KERNELS.iter().filter(|entry| entry.info.name == name);
            assert_eq!(known.count(), 1, "{name}");
        }
        assert!(KERNELS.iter().all(|entry| entry.is_one_test_with(entry)));
    }
}
