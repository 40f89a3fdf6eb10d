//! The bounds of steps, and what is of higher order, against what docs/guide/proof.md says of them.

use super::super::format::{Bound, F32, F64, Format, Parameters};
use super::super::number::{ERROR_DIGITS, Number, power, round_up};
use super::super::operations::{Term, terms};
use super::*;
use hairline_core::case::Draw;
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// The guide's statements about a step: its bound, its terms of first order, and all others.
#[derive(Clone)]
struct Stated {
    bound: Bound,
    first: Number,
    rest: Number,
}

/// The number 1, so that a single operand is a product too.
fn one() -> Stated {
    Stated {
        bound: Bound::exactly(&Number::one()),
        first: Number::zero(),
        rest: Number::zero(),
    }
}

/// The products that a step adds up.
fn products(step: &Step, above: &[Stated]) -> Vec<[Stated; 2]> {
    let of = |i: usize| above[i].clone();
    step.terms
        .iter()
        .map(|term| [of(term.left), term.right.map_or(one(), of)])
        .collect()
}

fn sum(numbers: impl Iterator<Item = Number>) -> Number {
    numbers.fold(Number::zero(), |sum, x| sum + x)
}

/// The terms of first order of a product, |a|f_b + f_a|b|.
fn first([a, b]: &[Stated; 2]) -> Number {
    &a.bound.size * &b.first + &a.first * &b.bound.size
}

/// All others: (|a| + f_a + r_a)(|b| + f_b + r_b) less the exact product and the terms of first order.
fn rest(pair: &[Stated; 2]) -> Number {
    let [a, b] = pair;
    let all = |x: &Stated| &x.bound.size + &x.first + &x.rest;
    all(a) * all(b) - &a.bound.size * &b.bound.size - first(pair)
}

/// Sizes, h and m of a step, from its size at a corner and the error that its operands bring.
fn stated_bound(
    format: &Format,
    step: &Step,
    pairs: &[[Stated; 2]],
    corner: &Number,
    error: &Number,
) -> Bound {
    let (h, up) = (
        |z: &Number| format.half_ulp(z),
        |z: &Number| format.float_up(z),
    );
    let by_operands = sum(pairs.iter().map(|[a, b]| &a.bound.size * &b.bound.size));
    let size = by_operands.min(corner.clone());
    let computed: Vec<Number> = pairs
        .iter()
        .map(|[a, b]| &a.bound.computed * &b.bound.computed)
        .collect();
    let z = sum(computed.iter().cloned()).min(&size + error);
    let (computed, error) = match (step.name, format.parameters) {
        ("neg", _) => (up(&z), Number::zero()),
        _ if step.place.is_none() => (up(&z), Number::zero()),
        ("minor", F32) => (up(&z), h(&z) + Format::of(F64).half_ulp(&z)),
        ("minor", _) => {
            let two_tiny = Number::from_integer(2.into()) * power(format.parameters.smallest - 1);
            let w = up(&computed[0]) + up(&computed[1]);
            let y = h(&computed[0]) + h(&computed[1]) + &two_tiny;
            (
                up(&(up(&w) + up(&y))),
                round_up(&(h(&w) + up(&y) + h(&y) + two_tiny), ERROR_DIGITS),
            )
        }
        _ => (up(&z), h(&z)),
    };
    Bound {
        size,
        computed,
        error,
    }
}

/// The guide's statements about all steps. The bounds are known when relative steps count as such.
fn stated(
    format: &Format,
    steps: &[Step],
    corners: &[Number],
    known: Option<&[Bound]>,
) -> Vec<Stated> {
    let mut all: Vec<Stated> = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        let pairs = products(step, &all);
        let (mut first, mut rest) = (sum(pairs.iter().map(first)), sum(pairs.iter().map(rest)));
        let error = &first + &rest;
        let by_rule = || stated_bound(format, step, &pairs, &corners[k], &error);
        let bound = known.map(|known| known[k].clone()).or(step.given.clone());
        let bound = bound.unwrap_or_else(by_rule);
        if known.is_some() && step.relative {
            let Parameters {
                digits, smallest, ..
            } = format.parameters;
            rest += power(-digits) * error + power(smallest - 1);
            first += power(-digits) * &bound.size;
        } else {
            first += &bound.error;
        }
        all.push(Stated { bound, first, rest });
    }
    all
}

fn step(name: &'static str, terms: Vec<Term>, given: Option<Bound>) -> Step {
    Step {
        place: Some(0),
        name,
        variables: vec![],
        constant: 0,
        terms,
        support: 0,
        given,
        rounds: false,
        relative: false,
        left_out: false,
    }
}

fn empty_program(parameters: Parameters) -> Program {
    let mut reader = Reader {
        lines: "".lines().peekable(),
        line: 0,
        work: 0,
    };
    Program::of_operations(Format::of(parameters), &mut reader).expect("no line")
}

/// A number near 2^exponent; zero once in a while.
fn near(draw: &mut Draw, exponent: i64) -> Number {
    if draw.below(12) == 0 {
        return Number::zero();
    }
    let places = draw.below(8) as i64 - 10;
    Number::from(BigInt::from(1 + draw.below(1 << 10))) * power(exponent + places)
}

/// Variables, whose errors are a good part of them, and what is made of them.
fn random_steps(draw: &mut Draw, format: &Format, scale: i64) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for _ in 0..4 {
        let below = draw.below(4) as i64;
        let error = near(draw, scale - below);
        let (size, computed) = (near(draw, scale), near(draw, scale));
        steps.push(step(
            "variables",
            vec![],
            Some(Bound {
                size,
                computed,
                error,
            }),
        ));
    }
    let has_minor = [F32, F64].contains(&format.parameters);
    for _ in 0..1 + draw.below(4) {
        let all = [
            ("neg", 1),
            ("add", 2),
            ("sub", 2),
            ("mul", 2),
            ("fma", 3),
            ("minor", 4),
        ];
        let (name, operands) = draw.pick(&all[..if has_minor { 6 } else { 5 }]);
        let operands: Vec<usize> = (0..operands).map(|_| draw.below(steps.len())).collect();
        let mut next = step(name, terms(name, &operands).expect("a sum"), None);
        if draw.below(6) == 0 && ["mul", "sub"].contains(&name) {
            next.place = None;
        }
        steps.push(next);
    }
    for step in &mut steps {
        let rounds = step.place.is_some() && step.name != "neg";
        step.rounds = rounds && (step.name != "minor" || format.parameters == F32);
        step.relative = step.rounds && draw.coin();
    }
    steps
}

#[test]
fn bounds_and_higher_orders_are_what_the_guide_says() {
    let mut draw = Draw::new("formula", 1, 0);
    let small = Parameters {
        digits: 3,
        smallest: -40,
        largest: 100,
    };
    let programs = [small, F32, F64].map(empty_program);
    let mut with_rest = 0;
    for _ in 0..4000 {
        let program = &programs[draw.below(3)];
        let format = &program.format;
        let smallest = format.parameters.smallest;
        // Some products are subnormal numbers or less, or all numbers are.
        let scale = draw.pick(&[0, 0, smallest / 2 + 5, smallest + 4]);
        let steps = random_steps(&mut draw, format, scale);
        let mut formula = Formula::of_variables(program, vec![]);
        formula.steps = steps;
        let corners: Vec<Number> = formula
            .steps
            .iter()
            .map(|_| near(&mut draw, scale))
            .collect();

        let expected = stated(format, &formula.steps, &corners, None);
        let expected: Vec<Bound> = expected.into_iter().map(|stated| stated.bound).collect();
        let bounds = formula.bounds(&corners);
        assert_eq!(bounds, expected);

        let all = stated(format, &formula.steps, &corners, Some(&expected));
        let rest = formula.rest(&bounds);
        assert_eq!(rest, all[all.len() - 1].rest);
        with_rest += usize::from(!rest.is_zero());
    }
    assert!(2000 < with_rest, "{with_rest}");
}
