//! Numbers of a path's program, known by their values at a few inputs, in whatever order the program computes them.

use super::measures::{Kind, Known, Limit, Measures, Sample};
use super::order::{largest_axes, unsigned};
use super::run::{cone, parts, values};
use super::watertight::signed;
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::arith::{Exact, Real, Triple, Vector};
use crate::case::Draw;
use crate::kernel::Path;
use std::cell::OnceCell;
use std::collections::HashMap;

/// How many inputs show in floats whether two formulas may be the same. One more shows it exactly: different rational
/// functions are equal nearly nowhere.
const SAMPLES: u64 = 3;

/// Values of all numbers of a path's program at some inputs.
#[derive(Debug)]
pub struct Samples<'a> {
    path: &'a Path,
    pub values: Vec<(Vec<f64>, Sample<f64>)>,
    /// The exact inputs of one of them, once they are needed.
    exact: OnceCell<([Exact; 17], Sample<Exact>)>,
    /// The axis of N's largest coordinate, if the path chose it. All axes if no N takes the path.
    axes: Vec<usize>,
}

/// True if the numbers whose signs a path asks for have these signs.
fn has_signs(path: &Path, inputs: &[f64; 17]) -> bool {
    let values = values(&path.operations, inputs);
    let mut decisions = path.decisions.iter();
    decisions.all(|(comparison, answer)| match *comparison {
        Comparison::Negative(place) => (values[place as usize] < 0.0) == *answer,
        _ => true,
    })
}

/// Short numbers, so that exact arithmetic is fast. The triangle faces the ray as a path's signs say, if they do.
fn inputs(path: &Path, i: u64) -> [f64; 17] {
    const ONE: i64 = 1 << 20;
    let mut draw = Draw::new("measures", 1, i);
    let drawn = [(); 17].map(|()| draw.integer(-ONE, ONE) as f64 / ONE as f64);
    let mut turned = drawn;
    (9..12).for_each(|i| turned.swap(i, i + 3));
    if !has_signs(path, &drawn) && has_signs(path, &turned) {
        turned
    } else {
        drawn
    }
}

impl<'a> Samples<'a> {
    pub fn new(path: &'a Path) -> Samples<'a> {
        let sample = |i: u64| {
            let inputs = inputs(path, i);
            let values = values(&path.operations, &inputs);
            (values, Sample::of(&inputs))
        };
        let values = (0..SAMPLES).map(sample).collect();
        let mut samples = Samples {
            path,
            values,
            exact: OnceCell::new(),
            axes: vec![],
        };
        samples.axes = largest_axes(path, |place| {
            (0..3).find(|axis| samples.is_of_normal(place, *axis))
        });
        samples
    }

    /// The coordinates of N that the path compares: by them it has chosen an axis. They may be computed in another way than
    /// the coordinate that it divides by.
    pub fn compared_coordinates(&self) -> Vec<Place> {
        let compared = self.path.decisions.iter().flat_map(|(it, _)| it.places());
        let mut places: Vec<Place> = compared.map(|it| unsigned(self.path, it)).collect();
        places.retain(|place| (0..3).any(|axis| self.is_of_normal(*place, axis)));
        places.dedup();
        places
    }

    /// True if a number is a coordinate of N, up to its sign.
    pub fn is_of_normal(&self, place: Place, axis: usize) -> bool {
        self.may_be(place, |i| self.values[i].1.normal.at(axis))
            && self.is_exactly(place, |sample| sample.normal.at(axis))
    }

    /// True if a number may be another one up to its sign, given that one's values.
    pub fn may_be(&self, place: Place, other: impl Fn(usize) -> f64) -> bool {
        self.values.iter().enumerate().all(|(i, (values, _))| {
            let x = values[place as usize].abs();
            let y = other(i).abs();
            (x - y).abs() <= 1e-9 * y
        })
    }

    /// True if it is the other one up to its sign at exact inputs, and so wherever the path is taken.
    pub fn is_exactly(&self, place: Place, other: impl Fn(&Sample<Exact>) -> Exact) -> bool {
        let Some(operations) = self.smooth(unsigned(self.path, place)) else {
            return false;
        };
        let (inputs, sample) = self.exact.get_or_init(|| {
            let inputs = inputs(self.path, SAMPLES).map(Exact::from_f64);
            let sample = Sample::of(&inputs);
            (inputs, sample)
        });
        let value = values(&operations, inputs).pop();
        let value = value.expect("its own value");
        (value.abs() - other(sample).abs()).is_zero()
    }

    /// True if there is a size in a number: |x|, or a root, as of x·x. Then its sign beside another number depends on the path.
    pub fn has_sizes(operations: &[Operation]) -> bool {
        let is_size = |it: &Operation| matches!(it, Operation::Abs(_) | Operation::Sqrt(_));
        operations.iter().any(is_size)
    }

    /// True if a number is |x|, and x has no size in it.
    pub fn is_size(&self, place: Place) -> bool {
        match self.path.operations[place as usize] {
            Operation::Abs(inner) => self.smooth(inner).is_some(),
            _ => false,
        }
    }

    /// A number that is another one up to its sign: true if it is the negative of it, false if it is the other itself; none if
    /// that is not known everywhere on the path.
    pub fn is_negative_of(
        &self,
        place: Place,
        other: impl Fn(&Sample<f64>) -> f64,
    ) -> Option<bool> {
        let operations = self.smooth(place)?;
        let (inputs, sample) = (inputs(self.path, 0), &self.values[0].1);
        let value = values(&operations, &inputs).pop().expect("its own value");
        Some(value * other(sample) < 0.0)
    }

    /// The program of a number, with x or -x in place of each |x| where the path has asked for the sign of x. None if there is
    /// another |x|, or a root of something else than N·N.
    ///
    /// Then it is a quotient of polynomials, or of their products with |N|. Two of these are equal everywhere if they are
    /// at a few points. A few points may show one side of |x| alone: |x+1| + |x-1| - 2 is 0 from -1 to 1.
    fn smooth(&self, place: Place) -> Option<Vec<Operation>> {
        let operations = cone(&self.path.operations, place).operations;
        if !Samples::has_sizes(&operations) {
            return Some(operations);
        }
        let mut smooth: Vec<Operation> = Vec::new();
        // By place on the tape: where its number is among these.
        let mut places: HashMap<Place, Place> = HashMap::new();
        for part in parts(&self.path.operations, place) {
            let operation = match self.path.operations[part as usize] {
                Operation::Abs(inner) if self.is_negative(inner)? => Operation::Neg(inner),
                Operation::Abs(inner) => {
                    places.insert(part, places[&inner]);
                    continue;
                }
                Operation::Sqrt(inner) if !self.is_square_of_normal(inner) => return None,
                operation => operation,
            };
            places.insert(part, smooth.len() as Place);
            smooth.push(operation.with(|operand| places[&operand]));
        }
        Some(cone(&smooth, places[&place]).operations)
    }

    /// True if the path takes a number to be negative; none if it has not asked for its sign.
    fn is_negative(&self, place: Place) -> Option<bool> {
        let asked = signed(self.path, place);
        self.path.decisions.iter().find_map(|(comparison, answer)| {
            let Comparison::Negative(of) = *comparison else {
                return None;
            };
            let known = signed(self.path, of);
            let is_turned = known.is_negative != asked.is_negative;
            (known.place == asked.place).then_some(*answer != is_turned)
        })
    }

    /// True if a number is N·N.
    fn is_square_of_normal(&self, place: Place) -> bool {
        let square = |normal: &Triple<f64>| normal.dot(normal);
        self.may_be(place, |i| square(&self.values[i].1.normal))
            && self.is_exactly(place, |sample| sample.normal.dot(&sample.normal))
    }

    /// True if a number is a barycentric coordinate, or 1 less one.
    pub fn is_share(&self, place: Place) -> bool {
        let (values, sample) = &self.values[0];
        let is = |vertex: usize, is_rest: bool| {
            self.may_be(place, |i| self.values[i].1.share(vertex, is_rest))
                && 0.0 < values[place as usize] * sample.share(vertex, is_rest)
                && self.is_exactly(place, |sample| sample.share(vertex, is_rest))
        };
        (0..3).any(|vertex| is(vertex, false) || is(vertex, true))
    }

    /// The limit of the first of the known numbers that a number is, up to its sign.
    pub fn find(&self, place: Place, measures: &Measures, kind: Kind) -> Option<Limit> {
        let mut lists = Vec::new();
        for (_, sample) in &self.values {
            lists.push(measures.known(kind, sample, &self.axes));
        }
        for (at, Known { name, limit, .. }) in lists[0].iter().enumerate() {
            let exact = |sample: &Sample<Exact>| {
                let mut known = measures.known(kind, sample, &self.axes);
                known.swap_remove(at).value
            };
            if self.may_be(place, |i| lists[i][at].value) && self.is_exactly(place, exact) {
                return Some(Limit::Scene(name, *limit));
            }
        }
        None
    }
}
