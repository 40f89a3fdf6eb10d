//! The corners that are enough, against all of them.

use crate::arith::recorded::{Operation, Recorded};
use crate::case::Draw;
use crate::formula::{Formula, Maximum, Step, VariableOrigin};
use crate::{Bound, Domain, Dyadic, Format, Prover};

/// Random sums and products of variables and numbers, zero among them. No product has a variable in both factors.
fn random(draw: &mut Draw, variables: usize) -> Formula {
    let mut formula = Formula::default();
    let mut supports: Vec<u64> = Vec::new();
    let mut push = |formula: &mut Formula, step: Step, given: Option<Dyadic>| {
        supports.push(step.support(&supports));
        formula.rounds.push(given.is_none());
        let exactly = |size| Bound {
            size,
            computed: size,
            error: Dyadic::ZERO,
        };
        formula.given.push(given.map(exactly));
        formula.steps.push(step);
        formula.places.push(None);
        formula.relative.push(false);
        supports.clone()
    };
    for v in 0..variables {
        let size = Dyadic::new(1 + draw.below(7) as i128, -2);
        formula.variables.push(size);
        formula.origins.push(VariableOrigin::Quotient);
        push(&mut formula, Step::Variables(vec![(v, 1)]), Some(size));
    }
    let value = draw.below(3) as i32;
    push(
        &mut formula,
        Step::Of(Operation::Number(value)),
        Some(Dyadic::new(value.into(), 0)),
    );
    // The first one's ends may be no mirror images.
    let below = draw
        .coin()
        .then(|| (0, Dyadic::new(draw.below(9) as i128, -3)));
    formula.below = below.filter(|(_, below)| *below < formula.variables[0]);
    // The steps that no other one uses yet.
    let mut open: Vec<usize> = (0..formula.steps.len()).collect();
    while open.len() > 1 {
        let a = open.swap_remove(draw.below(open.len()));
        // Steps may be used more than once.
        let all = formula.steps.len();
        let b = if draw.below(4) == 0 {
            draw.below(all)
        } else {
            open[draw.below(open.len())]
        };
        let supports = push(&mut formula, Step::Of(Operation::Neg(a)), None);
        *formula.rounds.last_mut().unwrap() = false;
        let a = formula.steps.len() - 1;
        let step = match draw.below(4) {
            0 => Step::Of(Operation::Add(a, b)),
            1 => Step::Of(Operation::Sub(a, b)),
            _ if supports[a] & supports[b] != 0 => Step::Of(Operation::Sub(a, b)),
            2 => Step::Of(Operation::Mul(a, b)),
            _ => Step::Of(Operation::Fma(a, b, draw.below(all))),
        };
        push(&mut formula, step, None);
        open.retain(|step| *step != b);
        open.push(formula.steps.len() - 1);
    }
    formula
}

/// The effects of all errors at a corner; values and slopes are found step by step, forwards.
fn effects(formula: &Formula, corner: u64, format: Format) -> Dyadic {
    let count = formula.steps.len();
    let mut all: Vec<(Dyadic, Vec<Dyadic>)> = Vec::new();
    for (k, step) in formula.steps.iter().enumerate() {
        let none = || vec![Dyadic::ZERO; count];
        let of = |i: usize| all[i].clone();
        let plus = |(x, dx): (Dyadic, Vec<Dyadic>), (y, dy): (Dyadic, Vec<Dyadic>)| {
            (x + y, dx.into_iter().zip(dy).map(|(a, b)| a + b).collect())
        };
        let minus = |(x, dx): (Dyadic, Vec<Dyadic>)| (-x, dx.into_iter().map(|a| -a).collect());
        let times = |(x, dx): (Dyadic, Vec<Dyadic>), (y, dy): (Dyadic, Vec<Dyadic>)| {
            (
                x * y,
                dx.into_iter().zip(dy).map(|(a, b)| a * y + b * x).collect(),
            )
        };
        let (value, mut slopes) = match *step {
            Step::Variables(ref sum) => {
                let (v, _) = sum[0];
                let size = formula.variables[v];
                let below = formula
                    .below
                    .filter(|(of, _)| *of == v)
                    .map_or(size, |(_, x)| x);
                (if corner >> v & 1 == 1 { -below } else { size }, none())
            }
            Step::Of(Operation::Number(value)) => (Dyadic::new(value.into(), 0), none()),
            Step::Of(Operation::Neg(a)) => minus(of(a)),
            Step::Of(Operation::Add(a, b)) => plus(of(a), of(b)),
            Step::Of(Operation::Sub(a, b)) => plus(of(a), minus(of(b))),
            Step::Of(Operation::Mul(a, b)) => times(of(a), of(b)),
            Step::Of(Operation::Fma(a, b, c)) => plus(times(of(a), of(b)), of(c)),
            Step::Of(_) => unreachable!("none is made"),
        };
        slopes[k] = Dyadic::ONE;
        all.push((value, slopes));
    }
    let effect = |k: usize| {
        let slope = all[count - 1].1[k].abs();
        if formula.relative[k] {
            slope * all[k].0.abs() * format.unit()
        } else {
            slope * formula.bounds[k].error
        }
    };
    (0..count).map(effect).fold(Dyadic::ZERO, |sum, x| sum + x)
}

#[test]
fn the_largest_effects_are_those_of_all_corners() {
    let mut draw = Draw::new("mirrors", 1, 0);
    let (mut tried, mut all, mut found) = (0, 0, 0);
    for _ in 0..2000 {
        let variables = 1 + draw.below(6);
        let mut formula = random(&mut draw, variables);
        let Ok(Maximum { first, corner, .. }) = formula.maximum(Format::F32) else {
            continue;
        };
        let of = |corner: u64| effects(&formula, corner, Format::F32);
        let largest = (0..1 << variables).map(of).fold(Dyadic::ZERO, Dyadic::max);
        let at = (0..1 << variables)
            .find(|corner| of(*corner) == largest)
            .unwrap();
        assert_eq!(first, largest, "{formula:?}");
        let expected: Vec<bool> = (0..variables).map(|v| at >> v & 1 == 1).collect();
        assert_eq!(corner, expected, "{formula:?}");
        found += 1;
        tried += formula.signs_to_try().count_ones();
        all += variables as u32;
    }
    // Neither none nor all of them.
    assert!(
        1500 < found && all / 4 < tried && tried < all * 3 / 4,
        "{found} {tried} {all}"
    );
}

#[test]
fn of_a_scalar_triple_product_the_signs_of_axes_and_vectors_are_free() {
    let (path, place) = super::recorded(|| {
        let [b, c] = [2, 3].map(|p| [0, 1, 2].map(|axis| super::difference(p, 1, axis)));
        let d = [3, 4, 5].map(Recorded::input);
        let minor = |i: usize, j: usize| b[i].clone() * &c[j] - b[j].clone() * &c[i];
        let [x, y, z] = d;
        x * minor(1, 2) + y * minor(2, 0) + z * minor(0, 1)
    });
    let mut prover = Prover::new(&path, Domain::UNIT, Format::F32);
    prover.bound(place).expect("multi-affine");
    let formula = &prover.lemmas.last().expect("a lemma").formula;
    assert_eq!(
        (formula.variables.len(), formula.signs_to_try().count_ones()),
        (9, 4)
    );
}

#[test]
fn a_zero_has_no_rounding_error() {
    let zero = crate::dyadic::Big::from(Dyadic::ZERO);
    assert_eq!(Format::F32.half_ulp_of(&zero), Dyadic::ZERO);
}
