//! Floor 4: compares the oracle with its definition, and with integer arithmetic that shares nothing with it.

#![forbid(unsafe_code)]

mod integers;
mod thresholds;

use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw, Parameters};
use crate::engine::{self, Merge, Observer};
use crate::family::{Family, LATTICE_SIZE, apply, find};
use crate::kernel::Scalar;
use crate::oracle::{Batch, Layers, define, truth_counted, truths};
use crate::truth::Truth;
use integers::Integers;
use num_traits::ToPrimitive;
use std::ops::Range;

/// The reference with which the oracle is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Its definition in rationals: slow and obvious.
    Definition,
    /// Integers of a fitting size, with formulas of their own: a hundred times as fast.
    Integers,
}

impl Reference {
    /// The truth, and a float near its t or near a contact's last t.
    fn truth<F: Float>(self, case: &Case<F>) -> (Truth, Option<f64>) {
        if self == Reference::Integers {
            return integers::truth(&case.widen());
        }
        let definition = define(case);
        let contact_t = definition.exact.contact_t.map(|[_, last]| last);
        let t = definition.exact.t.or(contact_t);
        (definition.truth, t.and_then(|t| t.to_f64()))
    }
}

/// The results of one check.
#[derive(Clone, Debug, Default)]
pub struct Check {
    /// Cases compared.
    pub cases: u64,
    /// Cases on which the oracle differs.
    pub differences: u64,
    /// The first of them by index: what it is, and both truths.
    pub first: Option<(u64, String)>,
    /// Which layer of the oracle decided.
    pub layers: Layers,
}

/// Cases with their indices, and the truths that they should have.
type ExpectedTruths<F> = Vec<(u64, Case<F>, Truth)>;

impl Check {
    /// Compares the truths that the oracle finds one by one, of a slice, and of columns.
    fn compare<F: Float>(&mut self, expected: &ExpectedTruths<F>) {
        let cases: Vec<Case<F>> = expected.iter().map(|(_, case, _)| *case).collect();
        let mut batch = Batch::new();
        cases.iter().for_each(|case| batch.push(case));
        let (mut of_slice, mut of_columns) = (Vec::new(), Vec::new());
        truths(&cases, &mut of_slice, &mut Layers::default());
        batch.truths(&mut of_columns, &mut Layers::default());
        for (i, (index, case, expected)) in expected.iter().enumerate() {
            let found = [
                ("", Some(truth_counted(case, &mut self.layers))),
                (" in a slice", of_slice.get(i).copied()),
                (" in columns", of_columns.get(i).copied()),
            ];
            self.cases += 1;
            if let Some((place, found)) = found.iter().find(|(_, found)| *found != Some(*expected))
            {
                self.differences += 1;
                let found = found.map_or("nothing".to_owned(), |found| format!("'{found}'"));
                let hex = case.hex();
                self.propose(
                    *index,
                    format!("the oracle says {found}{place}, should say '{expected}': {hex}"),
                );
            }
        }
    }

    fn propose(&mut self, index: u64, message: String) {
        if self.first.as_ref().is_none_or(|(first, _)| index < *first) {
            self.first = Some((index, message));
        }
    }
}

impl Merge for Check {
    fn merge(&mut self, other: Check) {
        self.cases += other.cases;
        self.differences += other.differences;
        self.layers.merge(&other.layers);
        if let Some((index, message)) = other.first {
            self.propose(index, message);
        }
    }
}

/// Compares the cases that are made for indices, on all threads.
fn over<F: Float>(
    indices: u64,
    observer: &dyn Observer,
    make: impl Fn(u64, &mut ExpectedTruths<F>) + Sync,
) -> Check {
    let add = |sum: &mut Check, indices: Range<u64>| {
        let mut expected = Vec::new();
        indices.for_each(|index| make(index, &mut expected));
        sum.compare(&expected);
    };
    engine::sum(0..indices, 64, observer, Check::default, add)
}

/// A family's set against a reference. Every fourth index also with the interval's ends at the
/// crossing, exact where a float is, and some ulps beside it; every fourth also scaled to where
/// products of two or three coordinates overflow or underflow in part.
pub fn family<F: Scalar>(
    family: &Family,
    reference: Reference,
    seed: u64,
    indices: u64,
    observer: &dyn Observer,
) -> Check {
    over(indices, observer, |index, expected| {
        let made = family.make::<F>(&Parameters::default(), seed, index);
        for case in made.cases() {
            with_cuts(reference, index, case, expected);
            if index % 4 == 1 {
                let mut draw = Draw::new("scaled", seed, index);
                let third = F::MAX_EXPONENT.div_euclid(3);
                let spread = i64::from(F::DIGITS) * 2;
                let towards = if draw.coin() { third } else { -third };
                let scale = towards + draw.integer(-spread, spread) as i32;
                let scale_direction = draw.coin();
                let mut scaled = *case;
                let parameters = Parameters {
                    scale,
                    scale_direction,
                    ..Parameters::default()
                };
                apply(&parameters, &mut scaled);
                expected.push((index, scaled, reference.truth(&scaled).0));
            }
        }
    })
}

/// Cases of any finite bit patterns, and of numbers that coincide and lie at the ends of the range.
pub fn whole_range<F: Float>(
    reference: Reference,
    seed: u64,
    indices: u64,
    observer: &dyn Observer,
) -> Check {
    let smallest = F::from_bits(1);
    let numbers = [
        F::zero(),
        -F::zero(),
        F::one(),
        -F::one(),
        F::from_f64(0.1),
        smallest,
        -smallest,
        F::infinity().offset_ulps(-1),
        -F::infinity().offset_ulps(-1),
        F::one() + F::EPSILON,
        F::from_f64(3.0),
        smallest.offset_ulps(1 << 20),
        F::from_f64(scale_by_power_of_two(1.0, F::MAX_EXPONENT)),
    ];
    over(indices, observer, |index, expected| {
        let mut draw = Draw::new("whole-range", seed, index);
        // The first cases have one number everywhere.
        let alone = numbers.get(index as usize).copied();
        let coincide = draw.coin() || alone.is_some();
        // Few numbers a case: more coincidences.
        let palette = [0; 4].map(|_| draw.pick(&numbers));
        let palette = alone.map_or(palette, |number| [number; 4]);
        let number = |draw: &mut Draw| {
            if coincide {
                return draw.pick(&palette);
            }
            loop {
                let x = F::from_bits(draw.bits() & (F::infinity().to_bits() << 1 | 1));
                if x.is_finite() {
                    return x;
                }
            }
        };
        let [o, d, a, b, c] = std::array::from_fn(|_| std::array::from_fn(|_| number(&mut draw)));
        with_cuts(reference, index, &Case::new(o, d, [a, b, c]), expected);
    })
}

/// Cases at the thresholds of the oracle's layers, each also on an interval that ends at its crossing.
pub fn thresholds(reference: Reference, seed: u64, indices: u64, observer: &dyn Observer) -> Check {
    over(indices, observer, |index, expected| {
        with_cut(reference, index, &thresholds::case(seed, index), expected);
    })
}

/// A case, and every fourth on an interval that ends at its crossing or contact.
fn with_cuts<F: Float>(
    reference: Reference,
    index: u64,
    case: &Case<F>,
    expected: &mut ExpectedTruths<F>,
) {
    if index.is_multiple_of(4) {
        with_cut(reference, index, case, expected);
    } else {
        expected.push((index, *case, reference.truth(case).0));
    }
}

/// A case, and the same on an interval that ends at its crossing or contact.
fn with_cut<F: Float>(
    reference: Reference,
    index: u64,
    case: &Case<F>,
    expected: &mut ExpectedTruths<F>,
) {
    let (truth, t) = reference.truth(case);
    expected.push((index, *case, truth));
    if let Some(t) = t {
        let cut = cut_at(&mut Draw::new("interval", 0, index), case, F::from_f64(t));
        expected.push((index, cut, reference.truth(&cut).0));
    }
}

/// The case with an interval that starts or ends at, or some ulps beside, a t.
fn cut_at<F: Float>(draw: &mut Draw, case: &Case<F>, t: F) -> Case<F> {
    let end = t.offset_ulps(draw.integer(-2, 2));
    match draw.below(3) {
        0 => case.on(end, F::infinity()),
        1 => case.on(-F::infinity(), end),
        _ => case.on(end, end),
    }
}

/// All 3^15 lattice cases against 64-bit integers.
pub fn lattice(observer: &dyn Observer) -> Check {
    let family = find("lattice").expect("a family of that name");
    over(LATTICE_SIZE, observer, |index, all| {
        let made = family.make_in_order::<f32>(&Parameters::default(), index);
        let case = made.cases()[0];
        let numbers = case.vectors().map(|v| v.map(|x| x as i64));
        let expected = match numbers[1] {
            [0, 0, 0] => Truth::Invalid,
            _ => Integers::of_lattice(numbers).truth().0,
        };
        all.push((index, case, expected));
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Unobserved;

    #[test]
    fn at_the_thresholds_of_its_layers_the_oracle_is_right_and_each_layer_decides_what_it_can() {
        let by_definition = thresholds(Reference::Definition, 1, 400, &Unobserved);
        let by_integers = thresholds(Reference::Integers, 1, 40_000, &Unobserved);
        for check in [by_definition, by_integers.clone()] {
            assert_eq!((check.differences, check.first), (0, None));
        }
        // A layer that hands on what it could decide is only slower, which no truth shows. So whoever
        // changes a bound, an order of layers or these cases puts the new counts here, and says why.
        let counts = [
            ("invalid", 141),
            ("filter", 7561),
            ("grid", 6363),
            ("wide grid", 15690),
            ("scaled filter", 4297),
            ("double-double", 3293),
            ("robust", 311),
            ("monomials", 23964),
            ("big integers", 2400),
        ];
        assert_eq!(by_integers.layers.named(), counts);
    }

    #[test]
    fn a_wrong_truth_is_counted_and_the_first_is_kept() {
        let case = Case::<f32>::new([0.0; 3], [1.0, 0.0, 0.0], [[0.0; 3]; 3]);
        let (mut left, mut right) = (Check::default(), Check::default());
        right.compare(&vec![
            (9, case, Truth::Parallel),
            (4, case, Truth::Parallel),
        ]);
        left.compare(&vec![(5, case, crate::oracle::truth(&case))]);
        left.merge(right);
        let sum = left;
        assert_eq!((sum.cases, sum.differences), (3, 2));
        let decided: u64 = sum.layers.named().iter().map(|(_, count)| count).sum();
        assert_eq!(decided, 3, "counted by layers too");
        assert_eq!(sum.first.as_ref().map(|(index, _)| *index), Some(4));
        assert!(sum.first.unwrap().1.contains("should say 'parallel'"));
    }
}
