//! Two quotients by one divisor, and points in a box.

use super::super::bound::Ratio;
use super::super::{Domain, Dyadic, Format, Formula, Proof, Rule, Step, VariableOrigin, paths_of};
use crate::arith::recorded::Operation;
use crate::case::Draw;
use crate::kernel;

/// The effects of a formula's errors at a point, where each is as large as its bound.
fn effects(formula: &Formula, variables: &[f64], values: &mut Vec<f64>) -> f64 {
    values.clear();
    for step in &formula.steps {
        let of = |i: usize| values[i];
        let sum = |sum: &[(usize, i8)]| {
            sum.iter()
                .map(|(v, sign)| f64::from(*sign) * variables[*v])
                .sum()
        };
        values.push(match *step {
            Step::Variables(ref all) => sum(all),
            Step::Of(Operation::Number(value)) => value.into(),
            Step::Of(Operation::Neg(a)) => -of(a),
            Step::Of(Operation::Add(a, b)) => of(a) + of(b),
            Step::Of(Operation::Sub(a, b)) => of(a) - of(b),
            Step::Of(Operation::Mul(a, b)) => of(a) * of(b),
            Step::Of(Operation::Fma(a, b, c)) => of(a) * of(b) + of(c),
            Step::Of(Operation::Minor(a, b, c, d)) => of(a) * of(b) - of(c) * of(d),
            Step::Of(_) => unreachable!("no such step"),
        });
    }
    let mut slopes = vec![0.0; values.len()];
    *slopes.last_mut().unwrap() = 1.0;
    for (i, step) in formula.steps.iter().enumerate().rev() {
        let (own, of) = (slopes[i], |i: usize| values[i]);
        let parts: &[(usize, f64)] = match *step {
            Step::Variables(_) | Step::Of(Operation::Number(_)) => &[],
            Step::Of(Operation::Neg(a)) => &[(a, -1.0)],
            Step::Of(Operation::Add(a, b)) => &[(a, 1.0), (b, 1.0)],
            Step::Of(Operation::Sub(a, b)) => &[(a, 1.0), (b, -1.0)],
            Step::Of(Operation::Mul(a, b)) => &[(a, of(b)), (b, of(a))],
            Step::Of(Operation::Fma(a, b, c)) => &[(a, of(b)), (b, of(a)), (c, 1.0)],
            Step::Of(Operation::Minor(a, b, c, d)) => {
                &[(a, of(b)), (b, of(a)), (c, -of(d)), (d, -of(c))]
            }
            Step::Of(_) => unreachable!("no such step"),
        };
        parts.iter().for_each(|(to, by)| slopes[*to] += own * by);
    }
    slopes
        .iter()
        .zip(&formula.bounds)
        .map(|(slope, bound)| slope.abs() * bound.error.to_f64())
        .sum()
}

/// No effects on a barycentric coordinate, wherever the points of a box lie, are larger than those at the corners that
/// are tried, and some are nearly that: of u, of v and of both, which have one error of their divisor.
#[test]
fn effects_on_barycentric_quotients_are_largest_at_corners_of_a_box_of_points() {
    let paths = paths_of::<f32>(kernel::find("moller-trumbore").expect("it is there"));
    let proof = Proof::new(paths.expect("paths"), None, Domain::UNIT, Format::F32);
    let lemmas = proof
        .quantities
        .iter()
        .flat_map(|quantity| &quantity.lemmas);
    let ratios = lemmas.filter(|lemma| matches!(lemma.rule, Rule::Quotient { .. }));
    let mut ratios: Vec<_> = ratios.map(|lemma| (lemma.place, lemma)).collect();
    ratios.dedup_by_key(|(place, _)| *place);
    let (mut draw, mut values) = (Draw::new("boxes", 1, 1), Vec::new());
    let mut wholes = 0;
    for (_, lemma) in ratios {
        let formula = &lemma.formula;
        let is_boxed = |source: &&VariableOrigin| matches!(source, VariableOrigin::Boxed(..));
        assert_eq!(formula.origins.iter().filter(is_boxed).count(), 12);
        let (most, mut best) = (lemma.maximum.first.to_f64(), 0.0f64);
        for _ in 0..60_000 {
            let point = formula
                .variables
                .iter()
                .zip(&formula.origins)
                .map(|(size, source)| {
                    let x: f64 = draw.symmetric();
                    let x = if draw.below(3) > 0 {
                        x.signum() * (1.0 - x.powi(8))
                    } else {
                        x
                    };
                    // A quotient lies between 0 and 1.
                    size.to_f64()
                        * if *source == VariableOrigin::Quotient {
                            x.abs()
                        } else {
                            x
                        }
                });
            let found = effects(formula, &point.collect::<Vec<_>>(), &mut values);
            assert!(found <= most, "{found} {most}");
            best = best.max(found);
        }
        assert!(0.9 * most < best, "{best} of {most}");
        wholes += usize::from(most > 27.9 * 2f64.powi(-24));
    }
    // u + v, whose maximum a program that shares nothing with this one found too: 27.989 u.
    assert_eq!(wholes, 1);
}

/// Where 1 - u - v is at most 8 and at least 0, u + v is between -7 and 1.
#[test]
fn a_sum_is_as_large_as_its_rest_lets_it_be() {
    let domain = Domain {
        quotient: Dyadic::power(3),
        ..Domain::UNIT
    };
    let paths = paths_of::<f32>(kernel::find("cramer").expect("it is there")).expect("paths");
    let proof = Proof::new(paths, None, domain, Format::F32);
    let is_rest = |rule: &Rule| {
        matches!(
            rule,
            Rule::Quotient {
                ratio: Ratio::Rest,
                below: Some(_),
                ..
            }
        )
    };
    let lemmas = proof
        .quantities
        .iter()
        .flat_map(|quantity| &quantity.lemmas);
    let rest = lemmas
        .into_iter()
        .find(|lemma| is_rest(&lemma.rule))
        .expect("(1-gamma)-beta");
    let formula = &rest.formula;
    let (v, lower) = formula.below.expect("it has ends");
    assert_eq!(formula.origins[v], VariableOrigin::Quotient);
    assert_eq!([formula.variables[v], lower], [Dyadic::new(7, 0); 2]);
}
