//! Published constants of filters, reproduced.

use super::super::dyadic::{Big, round_up};
use super::super::{
    Bound, Domain, Dyadic, Format, Formula, Prover, Step, VariableOrigin, relative,
};
use super::{difference, orient2d, orient3d, recorded};
use crate::arith::recorded::{Operation, Recorded};
use num_traits::{One, ToPrimitive};

/// Bounds of the value and of the sign in units of u, where no difference is larger than the size.
fn bounds(run: fn() -> Recorded, size: Dyadic, degree: usize) -> [f64; 2] {
    let (path, place) = recorded(run);
    let domain = Domain {
        edge: size,
        reach: size,
        ..Domain::UNIT
    };
    let mut prover = Prover::new(&path, domain, Format::F64);
    let value = prover.bound(place).expect("a polynomial").error;
    let sign = prover.bound_before_last(place).expect("a polynomial");
    let scale = (0..degree).fold(Format::F64.unit(), |product, _| product * size);
    [value, sign].map(|bound| bound.to_f64() / scale.to_f64())
}

/// The same, the largest over sizes of one binade: a constant that serves every size. In between, the
/// quotient of bound and power falls; it jumps where some number's size passes a power of two.
fn at_every_size(run: fn() -> Recorded, degree: usize) -> [f64; 2] {
    let sizes = (0..32).map(|i| Dyadic::new((32 + i) * 65536 + 1, -21));
    sizes
        .map(|size| bounds(run, size, degree))
        .fold([0.0; 2], |[a, b], [c, d]| [a.max(c), b.max(d)])
}

/// The error bound that CGAL, FPG and Cherchi et al. propagate: a size and an error in units of u, by
/// products and sums, each with half an ulp of the largest size.
#[derive(Clone, Copy)]
struct Static {
    size: f64,
    error: f64,
}

impl Static {
    const DIFFERENCE: Static = Static {
        size: 1.0,
        error: 1.0,
    };

    fn rounded(size: f64, error: f64) -> Static {
        // Half an ulp of 1 is u.
        Static {
            size,
            error: error + 2f64.powi(size.log2().floor() as i32),
        }
    }
    fn plus(self, other: Static) -> Static {
        Static::rounded(self.size + other.size, self.error + other.error)
    }
    fn times(self, other: Static) -> Static {
        let error = self.error * other.size + self.size * other.error;
        Static::rounded(self.size * other.size, error)
    }
    fn minor(self) -> Static {
        self.times(self).plus(self.times(self))
    }
    /// A 3 by 3 determinant by its first row.
    fn determinant(self) -> Static {
        let term = self.times(self.minor());
        term.plus(term).plus(term)
    }
}

#[test]
fn the_published_static_filters_follow_from_their_own_rules() {
    let difference = Static::DIFFERENCE;
    // CGAL's 8.00488 and 46.0332 have a slack for the rounding of the filter itself.
    assert_eq!(difference.minor().error, 8.0);
    // Cherchi et al. 2020: dL is a determinant of three differences, dT one of three cross products.
    assert_eq!(difference.determinant().error, 44.0);
    assert_eq!(4.884981308350689e-15, 44.0 * 2f64.powi(-53));
    assert_eq!(difference.minor().determinant().error, 784.0);
    // Printed with five more units in the last place, from their floats' own rounding.
    let printed = 8.704148513061234e-14 * 2f64.powi(53);
    assert!(printed > 784.0 && printed < 784.0 + 1e-12, "{printed}");
}

/// dL of Cherchi et al. 2020, by its first row.
fn row_by_row() -> Recorded {
    let at = |p: u8, axis: u8| difference(p, 0, axis);
    let minor = |i: u8, j: u8| at(2, i) * at(3, j) - at(2, j) * at(3, i);
    at(1, 0) * minor(1, 2) - at(1, 1) * minor(0, 2) + at(1, 2) * minor(0, 1)
}

#[test]
fn our_static_bounds_are_smaller_than_the_published_ones() {
    let one = Dyadic::ONE;
    let about = |found: [f64; 2], expected: [f64; 2]| {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-4, "{found} is not {expected}");
        }
    };
    // Value and sign, where all differences are at most one.
    about(bounds(orient2d, one, 2), [4.0, 3.0]);
    about(bounds(orient3d, one, 3), [21.0, 17.0]);
    about(bounds(row_by_row, one, 3), [21.0, 17.0]);
    // As a constant for every size of the differences: beside 8.00488 and 46.0332 of CGAL.
    about(at_every_size(orient2d, 2), [8.0, 6.0]);
    about(at_every_size(orient3d, 3), [38.0, 34.0]);
}

/// Steps of a formula whose leaves are independent rounded differences, at most one in size.
#[derive(Default)]
struct Steps(Formula);

impl Steps {
    fn push(&mut self, step: Step, given: Option<Bound>) -> usize {
        let formula = &mut self.0;
        formula.steps.push(step);
        formula.places.push(None);
        formula.given.push(given);
        formula.relative.push(false);
        formula.rounds.push(true);
        formula.steps.len() - 1
    }
    fn difference(&mut self) -> usize {
        let one = Dyadic::ONE;
        self.0.variables.push(one);
        self.0.origins.push(VariableOrigin::Quotient);
        let variable = vec![(self.0.variables.len() - 1, 1)];
        let given = Bound {
            size: one,
            computed: one,
            error: Format::F64.half_ulp_of(&one.into()),
        };
        self.push(Step::Variables(variable), Some(given))
    }
    fn times(&mut self, a: usize, b: usize) -> usize {
        self.push(Step::Of(Operation::Mul(a, b)), None)
    }
    fn minor(&mut self, a: usize, b: usize, c: usize, d: usize) -> usize {
        let (p, q) = (self.times(a, b), self.times(c, d));
        self.push(Step::Of(Operation::Sub(p, q)), None)
    }
}

/// dT of Cherchi et al. 2020: a determinant of three cross products, 18 differences.
#[test]
fn the_determinant_of_three_normals_has_less_than_784_units() {
    let mut steps = Steps::default();
    let [[vx, vy, vz], [wx, wy, wz], [ux, uy, uz]] = [(); 3].map(|()| {
        let [[ax, ay, az], [bx, by, bz]] = [(); 2].map(|()| [(); 3].map(|()| steps.difference()));
        [(ay, bz, az, by), (bx, az, bz, ax), (ax, by, ay, bx)]
            .map(|(a, b, c, d)| steps.minor(a, b, c, d))
    });
    let [x, y, z] = [(wy, uz, wz, uy), (wx, uz, wz, ux), (wx, uy, wy, ux)]
        .map(|(a, b, c, d)| steps.minor(a, b, c, d));
    let [da, db, dc] = [(vx, x), (vz, z), (vy, y)].map(|(a, b)| steps.times(a, b));
    let sum = steps.push(Step::Of(Operation::Add(da, db)), None);
    steps.push(Step::Of(Operation::Sub(sum, dc)), None);
    let mut formula = steps.0;
    let mut units = |last: bool| {
        *formula.rounds.last_mut().expect("a step") = last;
        let found = formula.maximum(Format::F64).expect("multi-affine");
        (found.first.to_f64() + found.rest.to_f64()) * 2f64.powi(53)
    };
    let units = [true, false].map(&mut units);
    assert!(units[0] < 224.001 && units[1] < 192.001, "{units:?}");
}

/// A positive number rounded up to the digits of a format: 3 + 16 of 3 + 12 and more.
fn in_units_of_u(x: Big, format: Format) -> [f64; 2] {
    let unit = Big::from(format.unit());
    let rounded = Big::from(round_up(&x, format.digits));
    let whole = (&x / &unit).floor();
    let rest = (rounded / &unit - &whole) / &unit;
    [
        whole.to_f64().expect("small"),
        rest.to_f64().expect("small"),
    ]
}

#[test]
fn shewchuks_filters_follow_from_the_recorded_programs() {
    let filter = |run: fn() -> Recorded, format: Format| {
        let (path, place) = recorded(run);
        let form = relative(&path, place, Domain::UNIT, format).expect("a polynomial");
        (
            form.roundings.of_format,
            form.for_sign.of_format,
            form.filter(format),
        )
    };
    for format in [Format::F32, Format::F64] {
        let (value, sign, factor) = filter(orient2d, format);
        assert_eq!((value, sign), (4, 3));
        // ccwerrboundA = (3 + 16u)u.
        assert_eq!(in_units_of_u(factor, format), [3.0, 16.0]);
        let (value, sign, factor) = filter(orient3d, format);
        assert_eq!((value, sign), (8, 7));
        // o3derrboundA = (7 + 56u)u is one unit in the last place more than it has to be.
        assert_eq!(in_units_of_u(factor, format), [7.0, 48.0]);
        // An underflow adds what the guards of CGAL exclude.
        let (path, place) = recorded(orient2d);
        let form = relative(&path, place, Domain::UNIT, format).expect("a polynomial");
        let two = Big::from(format.tiny()) * (Big::one() + Big::one());
        assert!(
            Big::from(form.underflow) >= two && form.underflow < format.tiny() * Dyadic::new(3, 0)
        );
    }
}
