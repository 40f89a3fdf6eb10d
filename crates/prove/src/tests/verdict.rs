//! The bound of verdicts, held to kernels that run in formats of few digits, where wrong verdicts are far off and can be drawn.
//! The exact numbers and distances here share nothing with the bound's.

use super::super::verdict::{Verdicts, verdicts};
use super::super::{Domain, Dyadic, Format, Proof};
use super::tiny::round;
use crate::arith::recorded::{Comparison, Operation};
use crate::case::Draw;
use crate::kernel::{self, Acceptance, Path, Refuse};
use crate::paths_of;
use glam::DVec3;

/// The results of a path's operations in a format of so many digits.
fn run(path: &Path, inputs: &[f64; 17], digits: u32) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::new();
    for operation in &path.operations {
        let of = |place: u32| values[place as usize];
        let value = match *operation {
            Operation::Input(i) => inputs[usize::from(i)],
            Operation::Number(value) => f64::from(value),
            Operation::Add(a, b) => round(of(a) + of(b), digits),
            Operation::Sub(a, b) => round(of(a) - of(b), digits),
            Operation::Mul(a, b) => round(of(a) * of(b), digits),
            Operation::Div(a, b) => round(of(a) / of(b), digits),
            Operation::Neg(a) => -of(a),
            Operation::Abs(a) => of(a).abs(),
            other => panic!("{other:?}"),
        };
        values.push(value);
    }
    values
}

/// True if a kernel's gates accept a case in a format, at these epsilons.
fn accepts(paths: &[Path], inputs: &[f64; 17], epsilons: &[f64], digits: u32) -> bool {
    let taken = paths.iter().find_map(|path| {
        let values = run(path, inputs, digits);
        let of = |place: u32| values[place as usize];
        let is_so = |(comparison, answer): &(Comparison, bool)| {
            *answer
                == match *comparison {
                    Comparison::Less(a, b) => of(a) < of(b),
                    Comparison::AtMost(a, b) => of(a) <= of(b),
                    Comparison::Zero(a) => of(a) == 0.0,
                    Comparison::Negative(a) => of(a).is_sign_negative(),
                }
        };
        path.decisions.iter().all(is_so).then_some((path, values))
    });
    let (path, values) = taken.expect("some path");
    path.compared.iter().all(|compared| {
        let Acceptance::Clauses(refuse, clauses) = &compared.accepts else {
            panic!("{compared:?}")
        };
        let e = epsilons[compared.gate];
        let passes = |place: &u32| match (refuse, values[*place as usize]) {
            (Refuse::Below | Refuse::UnlessAtLeast, x) => x >= e,
            (Refuse::AtMost | Refuse::UnlessAbove, x) => x > e,
        };
        clauses.iter().any(|clause| clause.iter().all(passes))
    })
}

/// How far inside a triangle a point of its plane is, as a share of the longest edge; negative outside.
fn inside(point: DVec3, vertices: [DVec3; 3]) -> f64 {
    let [a, b, c] = vertices;
    let normal = (b - a).cross(c - a);
    let sides = [(a, b), (b, c), (c, a)];
    let longest = sides
        .iter()
        .map(|(p, q)| p.distance(*q))
        .fold(0.0, f64::max);
    let is_inside = sides
        .iter()
        .all(|(p, q)| normal.dot((*q - *p).cross(point - *p)) >= 0.0);
    let distance = sides.iter().map(|(p, q)| {
        let along = ((point - *p).dot(*q - *p) / p.distance_squared(*q)).clamp(0.0, 1.0);
        point.distance(*p + along * (*q - *p))
    });
    let distance = distance.fold(f64::INFINITY, f64::min) / longest;
    if is_inside { distance } else { -distance }
}

/// A ray towards an edge of a triangle, all in a format, with |N·d| at least a half; and the point where it meets the plane.
fn drawn(draw: &mut Draw, digits: u32) -> Option<([f64; 17], DVec3, [DVec3; 3])> {
    let near_one = |draw: &mut Draw| {
        let x = 1.0 - draw.unit() * 2f64.powi(-(draw.below(7) as i32));
        if draw.coin() { x } else { -x }
    };
    let mut vector = || DVec3::from([0; 3].map(|_| round(near_one(draw), digits)));
    let (direction, [a, b, c]) = (vector(), [(); 3].map(|()| vector() / 2.0));
    let weight = draw.unit();
    let target = (1.0 - weight) * a + weight * b;
    let target = target + (c - target) * draw.symmetric::<f64>() * 0.2;
    let origin = target - direction * draw.unit();
    let origin = DVec3::from(origin.to_array().map(|x| round(x, digits)));
    let normal = (b - a).cross(c - a);
    let volume = normal.dot(direction);
    let most = Domain::UNIT.edge.to_f64();
    let differences = [b - a, c - a, c - b, a - origin, b - origin, c - origin];
    let fits = differences.iter().all(|it| it.abs().max_element() <= most);
    if !fits || volume.abs() < 0.5 {
        return None;
    }
    let point = origin + direction * (normal.dot(a - origin) / volume);
    let mut inputs = [0.0; 17];
    for (i, v) in [origin, direction, a, b, c].into_iter().enumerate() {
        inputs[3 * i..3 * i + 3].copy_from_slice(&v.to_array());
    }
    // No t is beyond them.
    (inputs[15], inputs[16]) = (-2.0, 2.0);
    Some((inputs, point, [a, b, c]))
}

#[test]
fn no_verdict_of_a_tiny_format_is_farther_off_than_its_bound() {
    for (name, digits, epsilons) in [
        ("scalar-triple-two-sided", 9, &[0.0][..]),
        ("scalar-triple-two-sided", 9, &[0.01]),
        ("moller-trumbore", 12, &[1e-3, 0.0]),
        ("moller-trumbore", 12, &[1e-3, -0.01]),
        ("cramer", 12, &[0.0, 0.0, 0.0]),
    ] {
        let entry = kernel::find(name).unwrap();
        let format = Format {
            digits,
            smallest: -200,
            largest: 200,
        };
        let of = |domain| Proof::new(paths_of::<f64>(entry).unwrap(), None, domain, format);
        let quotient = Dyadic::ABOVE_ONE;
        let wide = |below| {
            of(Domain {
                quotient,
                below,
                ..Domain::UNIT
            })
        };
        let (proof, near, far) = (
            of(Domain::UNIT),
            wide(quotient - Dyadic::ONE),
            wide(quotient),
        );
        let Verdicts { misses, hits, .. } =
            verdicts(entry, [&proof, &near, &far], epsilons, &[Domain::UNIT]);
        let bounds = [misses, hits].map(|bound| bound.unwrap().share);
        let (mut worst, mut draw) = ([0.0f64; 2], Draw::new("verdict", 1, 1));
        for (inputs, point, vertices) in (0..3_000_000)
            .filter_map(|_| drawn(&mut draw, digits))
            .take(300_000)
        {
            let depth = inside(point, vertices);
            let is_hit = accepts(&proof.paths, &inputs, epsilons, digits);
            let kind = usize::from(is_hit);
            worst[kind] = worst[kind].max(if is_hit { -depth } else { depth });
        }
        println!("{name} p={digits} {epsilons:?}: {worst:?} of {bounds:?}");
        for (worst, bound) in worst.into_iter().zip(bounds) {
            assert!(worst <= bound, "{name}: {worst} {bound}");
        }
    }
}

#[test]
fn in_a_tiny_format_no_barycentric_quotient_is_wrong_by_more_than_its_bound() {
    for (name, digits) in [("moller-trumbore", 9), ("cramer", 9), ("cramer", 12)] {
        let entry = kernel::find(name).unwrap();
        let format = Format {
            digits,
            smallest: -200,
            largest: 200,
        };
        let proof = Proof::new(paths_of::<f64>(entry).unwrap(), None, Domain::UNIT, format);
        let of_weights = || {
            proof
                .quantities
                .iter()
                .filter(|quantity| quantity.uses().inside)
        };
        // u, v, 1 less each and 1 less both, on some path.
        assert!(4 <= of_weights().count(), "{name}");
        let mut draw = Draw::new("inside", 1, digits.into());
        let mut shares: Vec<f64> = Vec::new();
        for quantity in of_weights() {
            let path = &proof.paths[quantity.path];
            let bound = quantity.bound.as_ref().unwrap().error.to_f64();
            let mut worst = 0.0f64;
            for (inputs, point, vertices) in (0..300_000)
                .filter_map(|_| drawn(&mut draw, digits))
                .take(30_000)
            {
                let of = |values: Vec<f64>| values[quantity.place as usize];
                if 0.0 <= inside(point, vertices) {
                    // As exact as f64 is, which has forty digits more.
                    let [computed, exact] = [digits, 53].map(|p| of(run(path, &inputs, p)));
                    worst = worst.max((computed - exact).abs());
                }
            }
            assert!(worst <= bound, "{name}: {worst} {bound}");
            shares.push(worst / bound);
        }
        println!("{name} p={digits}: {shares:?}");
        // The bounds say something.
        assert!(
            shares.iter().all(|share| 0.05 < *share),
            "{name}: {shares:?}"
        );
    }
}
