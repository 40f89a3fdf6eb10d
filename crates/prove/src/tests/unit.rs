//! Quotients and unit vectors in formats of a few digits, where terms of higher order count.

use super::super::{Bound, Domain, Dyadic, Format, Prover, VariableOrigin};
use super::tiny::round;
use super::{difference, recorded};
use crate::arith::Real;
use crate::arith::recorded::{Operation, Place, Recorded};
use crate::case::Draw;
use crate::kernel::Path;

/// Divided by its length, by one reciprocal or by three divisions.
fn unit([x, y, z]: [Recorded; 3], by_reciprocal: bool) -> [Recorded; 3] {
    let square = |x: &Recorded| x.clone() * x;
    let length = (square(&x) + square(&y) + square(&z)).sqrt();
    let reciprocal = Recorded::one() / &length;
    [x, y, z].map(|x| {
        if by_reciprocal {
            x * &reciprocal
        } else {
            x / &length
        }
    })
}

/// The normal of a, b, c.
fn normal() -> [Recorded; 3] {
    let edges = [2, 3].map(|p| [0, 1, 2].map(|axis| difference(p, 1, axis)));
    let [[x, y, z], [u, v, w]] = edges;
    let minor =
        |a: &Recorded, b: &Recorded, c: &Recorded, d: &Recorded| a.clone() * b - c.clone() * d;
    [
        minor(&y, &w, &v, &z),
        minor(&z, &u, &w, &x),
        minor(&x, &v, &u, &y),
    ]
}

fn edge() -> [Recorded; 3] {
    [0, 1, 2].map(|axis| difference(2, 1, axis))
}

/// n·d.
fn along_direction([x, y, z]: [Recorded; 3]) -> Recorded {
    let [u, v, w] = [3, 4, 5].map(Recorded::input);
    x * &u + y * &v + z * &w
}

/// Computed with so many digits, or exactly for 53.
fn values(path: &Path, inputs: &[f64; 17], digits: u32) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::new();
    for operation in &path.operations {
        let of = |place: Place| values[place as usize];
        let value = match *operation {
            Operation::Input(i) => inputs[usize::from(i)],
            Operation::Number(value) => value.into(),
            Operation::Add(a, b) => of(a) + of(b),
            Operation::Sub(a, b) => of(a) - of(b),
            Operation::Mul(a, b) => of(a) * of(b),
            Operation::Div(a, b) => of(a) / of(b),
            Operation::Neg(a) => -of(a),
            Operation::Sqrt(a) => of(a).sqrt(),
            other => panic!("{other:?}"),
        };
        values.push(if digits < 53 && value != 0.0 {
            round(value, digits)
        } else {
            value
        });
    }
    values
}

/// The largest error beside its bound on those of the inputs that are in the domain, and how many are: divisors are at
/// least its floor, and quotients at most 1.
pub fn largest_share(
    (path, place): (Path, Place),
    domain: Domain,
    digits: u32,
    all: impl Iterator<Item = [f64; 17]>,
) -> (f64, usize) {
    let format = Format {
        digits,
        smallest: -200,
        largest: 200,
    };
    let mut prover = Prover::new(&path, domain, format);
    let Bound {
        error, computed, ..
    } = prover.bound(place).expect("a bound");
    let (mut worst, mut tried) = (0.0f64, 0);
    for inputs in all {
        let exact = values(&path, &inputs, 53);
        let size = |place: Place| exact[place as usize].abs();
        let is_inside = |(place, operation): (usize, &Operation)| match *operation {
            Operation::Div(a, b) => {
                let is_one = path.operations[a as usize] == Operation::Number(1);
                size(b) >= domain.floor.to_f64() && (is_one || size(place as Place) <= 1.0)
            }
            _ => true,
        };
        if !path.operations.iter().enumerate().all(is_inside) {
            continue;
        }
        tried += 1;
        let found = values(&path, &inputs, digits)[place as usize];
        assert!(found.abs() <= computed.to_f64());
        worst = worst.max((found - exact[place as usize]).abs() / error.to_f64());
    }
    (worst, tried)
}

/// The same where edges are at most 1.
fn share_of_edges_below_one(run: &dyn Fn() -> Recorded, digits: u32, floor: f64) -> f64 {
    let floor = Dyadic::from_f64(floor).expect("finite");
    let domain = Domain {
        edge: Dyadic::ONE,
        floor,
        ..Domain::UNIT
    };
    let mut draw = Draw::new("unit", 1, u64::from(digits));
    let all = (0..400_000).map(|_| {
        // Points between -1/2 and 1/2.
        let mut inputs: [f64; 17] = std::array::from_fn(|_| round(draw.symmetric(), digits));
        (6..15).for_each(|i| inputs[i] *= 0.5);
        inputs
    });
    let (worst, tried) = largest_share(recorded(run), domain, digits, all);
    assert!(tried > 1000, "{tried}");
    worst
}

#[test]
fn no_quotient_and_no_unit_vector_in_a_tiny_format_passes_its_bound() {
    let direction = || [3, 4, 5].map(Recorded::input);
    let first = |[x, _, _]: [Recorded; 3]| x;
    let last = |[_, _, z]: [Recorded; 3]| z;
    // One product in numerator and divisor.
    let share = || {
        let product = difference(2, 1, 0) * &difference(3, 1, 1);
        product.clone() / &(product + &Recorded::input(3))
    };
    let cases: [(&str, &dyn Fn() -> Recorded, f64); 10] = [
        ("a share of a sum", &share, 0.25),
        (
            "a quotient of inputs",
            &|| Recorded::input(3) / &Recorded::input(4),
            0.5,
        ),
        (
            "of differences",
            &|| difference(2, 1, 0) / &difference(3, 1, 1),
            0.5,
        ),
        (
            "of an input and a determinant",
            &|| Recorded::input(3) / &last(normal()),
            0.5,
        ),
        (
            "of determinants",
            &|| first(normal()) / &last(normal()),
            0.5,
        ),
        (
            "a direction's coordinate",
            &|| first(unit(direction(), true)),
            0.5,
        ),
        ("by divisions", &|| first(unit(direction(), false)), 0.5),
        (
            "a difference's coordinate",
            &|| first(unit(edge(), true)),
            0.5,
        ),
        (
            "a normal's coordinate",
            &|| first(unit(normal(), true)),
            0.75,
        ),
        (
            "a normal along a direction",
            &|| along_direction(unit(normal(), true)),
            0.75,
        ),
    ];
    for digits in [4, 5, 8] {
        for (name, run, floor) in cases {
            let worst = share_of_edges_below_one(run, digits, floor);
            println!("{name}, p={digits}: {worst:.3} of the bound");
            assert!(0.08 < worst && worst <= 1.0, "{name}, p={digits}: {worst}");
        }
    }
}

/// The variables of the formula that proves a number, which are parts of a unit vector and which are not.
fn parts_and_cuts(run: fn() -> Recorded) -> [usize; 2] {
    let (path, place) = recorded(run);
    let mut prover = Prover::new(&path, Domain::UNIT, Format::F32);
    prover.bound(place).expect("a bound");
    let origins = &prover.lemmas.last().expect("a lemma").formula.origins;
    let count =
        |is: fn(&VariableOrigin) -> bool| origins.iter().filter(|source| is(source)).count();
    [
        count(|s| matches!(s, VariableOrigin::Part(_))),
        count(|s| matches!(s, VariableOrigin::Cut(_))),
    ]
}

#[test]
fn what_is_not_linear_in_one_unit_vector_has_its_coordinates_in_boxes() {
    assert_eq!(
        parts_and_cuts(|| along_direction(unit(normal(), true))),
        [3, 0]
    );
    // A constant beside it, a product of two coordinates, the same coordinate twice, and two unit vectors.
    let not_linear: [fn() -> Recorded; 4] = [
        || along_direction(unit(normal(), true)) + Recorded::input(15),
        || {
            let [x, y, z] = unit(normal(), true);
            x * &y + z
        },
        || {
            let [x, _, _] = unit(normal(), true);
            let [again, _, _] = unit(normal(), false);
            x + again
        },
        || {
            let [x, _, _] = unit(normal(), true);
            let [other, _, _] = unit([3, 4, 5].map(Recorded::input), true);
            x + other
        },
    ];
    for run in not_linear {
        let [parts, cuts] = parts_and_cuts(run);
        assert!(parts == 0 && cuts > 1, "{parts} {cuts}");
    }
}
