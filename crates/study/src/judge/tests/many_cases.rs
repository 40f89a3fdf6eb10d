//! Many cases at once: each is asked what it is asked alone, and no finding is overlooked.

use crate::judge::*;
use crate::oracle::truth;

#[test]
fn cases_that_are_all_free_are_all_listed() {
    let case = Case::<f64>::new([f64::NAN; 3], [1.0; 3], [[0.0; 3]; 3]);
    let (cases, truths) = ([case; 5], [Truth::Invalid; 5]);
    let free = Contract {
        invalid: Demand::Free,
        ..Contract::CLOSED_RAY
    };
    for (contract, listed) in [(free, vec![0, 1, 2, 3, 4]), (Contract::CLOSED_RAY, vec![])] {
        let all = ask_all(&cases, &truths, &Kinds::new(&truths), &contract, false);
        assert_eq!(all.free, listed);
    }
}

/// Cases that are not suspects met their obligation, whatever the verdict; without values, every suspect
/// shows a finding.
fn no_suspect_is_overlooked(
    cases: &[Case<f64>],
    truths: &[Truth],
    (contract, all): (&Contract, &Demands),
) {
    let of = |(case, truth)| ValueLimits::of(case, truth);
    let limits: Vec<ValueLimits<f64>> = cases.iter().zip(truths).map(of).collect();
    let (nan, facings) = (f64::NAN, [None, Some(Facing::Front), Some(Facing::Back)]);
    let mut found = Vec::new();
    for number in 0..144 {
        let bit = |k: usize| number >> k & 1 == 1;
        let gives = Gives {
            t: bit(0),
            uv: bit(1),
            facing: bit(2),
        };
        let failure = (number >= 128).then_some(Failure::Panic);
        let value = |k: usize| if bit(k) { 0.5 } else { nan };
        let (hit, facing) = (failure.is_none() && bit(3), facings[number / 16 % 3]);
        let verdict = Verdict {
            hit,
            facing,
            t: value(4),
            u: value(5),
            failure,
            ..Verdict::miss(None)
        };
        let verdict = Verdict {
            v: value(6),
            ..verdict
        };
        suspects(
            (&all.of, &limits),
            gives,
            &vec![verdict; truths.len()],
            &mut found,
        );
        let findings = (0..truths.len()).filter(|&i| {
            judge(
                (contract, all.of[i].obligation()),
                (&cases[i], &truths[i]),
                gives,
                &verdict,
            )
            .is_some()
        });
        let findings: Vec<usize> = findings.collect();
        assert!(
            findings.iter().all(|i| found.binary_search(i).is_ok()),
            "{gives:?} {verdict:?}"
        );
        if !(gives.t || gives.uv || gives.facing) {
            assert_eq!(found, findings, "{verdict:?}");
        }
    }
}

#[test]
fn many_cases_are_asked_what_each_is_asked() {
    use crate::contract::NAMED;
    use crate::family::FAMILIES;
    let own = crate::kernel::KERNELS
        .iter()
        .map(|entry| entry.info.contract);
    let unit = Contract {
        direction: Direction::Unit { ulps: 4 },
        ..Contract::CLOSED_RAY
    };
    let contracts = NAMED
        .iter()
        .map(|named| named.contract)
        .chain(own)
        .chain([unit]);
    for contract in contracts {
        let ends = [Boundary::Closed, Boundary::Open, Boundary::Free];
        for contract in ends.map(|ends| Contract { ends, ..contract }) {
            // All families together, so that ends and insides stand side by side.
            let made = FAMILIES.iter().flat_map(|family| {
                (0..40).map(|i| family.make::<f64>(&crate::case::Parameters::default(), 1, i))
            });
            let cases: Vec<Case<f64>> = made.flat_map(|made| made.cases().to_vec()).collect();
            let truths: Vec<Truth> = cases.iter().map(truth).collect();
            let kinds = Kinds::new(&truths);
            for secondary in [false, true] {
                let each: Vec<Obligation> = cases
                    .iter()
                    .zip(&truths)
                    .map(|(case, truth)| asked(case, truth, &contract, secondary))
                    .collect();
                let all = ask_all(&cases, &truths, &kinds, &contract, secondary);
                let of: Vec<_> = all
                    .of
                    .iter()
                    .map(|expected| expected.obligation())
                    .collect();
                assert_eq!(of, each, "{contract:?}");
                let is_free = |i: &usize| each[*i] == Obligation::Free;
                assert_eq!(
                    all.free,
                    (0..each.len()).filter(is_free).collect::<Vec<_>>()
                );
                let mut counts = vec![[0u64; 3]; Class::COUNT];
                for (class, asked, count) in &all.counts {
                    counts[class.number()][*asked as usize] += count;
                }
                for (truth, asked) in truths.iter().zip(&each) {
                    counts[Class::of(truth).number()][*asked as usize] -= 1;
                }
                assert!(
                    counts.iter().flatten().all(|count| *count == 0),
                    "{contract:?}"
                );
                no_suspect_is_overlooked(&cases, &truths, (&contract, &all));
            }
        }
    }
}
