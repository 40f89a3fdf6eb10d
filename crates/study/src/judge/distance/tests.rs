//! Distances against exact squares, which a test of the library compares with rationals, and which step
//! finds them.

use super::*;
use crate::arith::Exact;
use crate::case::{Draw, Parameters};
use crate::family::{FAMILIES, apply};
use crate::oracle::{define, truth};
use num_traits::ToPrimitive;

/// Compares a valid case's distances, and counts the step.
fn compare<F: Float>(case: &Case<F>, steps: &mut [u32; 4]) {
    let truth = truth(case);
    if truth == Truth::Invalid {
        return;
    }
    let (found, step) = Distances::and_step(case, &truth);
    steps[step as usize] += 1;
    let (ray, triangle) = case.exact();
    let squares = Squares::<Exact>::of(&ray, &triangle, truth.crossing().is_some());
    let unit = if squares.longest.is_zero() {
        Exact::one()
    } else {
        squares.longest
    };
    let is_near = |found: f64, square: Exact, what: &str| {
        let exact = (square / &unit).approximate_root();
        // Neither below nor above the range of floats.
        let is_near = exact == found || (found - exact).abs() <= exact / 1000.0;
        assert!(
            is_near || exact < 1e-300,
            "{step:?} {what} {found:e} {exact:e} {}",
            case.hex()
        );
    };
    is_near(found.in_space, squares.in_space, "in space");
    let ends = [0.0, case.ray.t_min.to_f64(), case.ray.t_max.to_f64()];
    for ((found, square), end) in found.along.into_iter().zip(squares.along).zip(ends) {
        match square {
            Some(square) => is_near(found, square, "along"),
            None if truth.crossing().is_some() => {
                assert!(found == f64::INFINITY && end.is_infinite())
            }
            None => assert!(found.is_nan()),
        }
    }
    let ulp = Exact::from_f64(ulp_of_points(case).to_f64());
    is_near(1.0 / found.edge_in_ulps, ulp.clone() * ulp, "ulp");
}

/// A case, and the same on intervals that end at its t, some ulps beside it, and less near.
fn compare_cuts<F: Float>(case: &Case<F>, draw: &mut Draw, steps: &mut [u32; 4]) {
    compare(case, steps);
    let Some(t) = define(case).exact.t.and_then(|t| t.to_f64()) else {
        return;
    };
    let t = F::from_f64(t);
    let beside =
        F::from_f64(t.to_f64() * (1.0 + scaled(draw.symmetric(), draw.integer(-45, 0) as i32)));
    let ulps = t.offset_ulps(draw.integer(-3, 3));
    let end = draw.pick(&[t, ulps, beside]);
    match draw.below(3) {
        0 => compare(&case.on(end, F::infinity()), steps),
        1 => compare(&case.on(-F::infinity(), end), steps),
        _ => compare(&case.on(end, end), steps),
    }
}

fn families<F: crate::kernel::Scalar>(scales: &[i32], steps: &mut [u32; 4]) {
    for family in FAMILIES {
        for index in 0..8 {
            let mut draw = Draw::new("distances", 1, index);
            let made = family.make::<F>(&Parameters::default(), 1, index);
            let scale = scales[index as usize % scales.len()];
            let parameters = Parameters {
                scale,
                scale_direction: draw.coin(),
                ..Parameters::default()
            };
            for case in made.cases() {
                let mut case = *case;
                apply(&parameters, &mut case);
                compare_cuts(&case, &mut draw, steps);
            }
        }
    }
}

/// Rays that graze the triangle's plane, at down to 2^-70 of a right angle.
fn grazing<F: Float>(steps: &mut [u32; 4]) {
    for index in 0..200 {
        let mut draw = Draw::new("grazing", 1, index);
        let [a, b, c] = [(); 3].map(|()| draw.point::<f64>());
        let (s, t) = (draw.symmetric::<f64>(), draw.symmetric::<f64>());
        let tilt = scaled(1.0, -draw.integer(0, 70) as i32);
        let up = draw.point::<f64>();
        let d = [0, 1, 2].map(|i| s * (b[i] - a[i]) + t * (c[i] - a[i]) + tilt * up[i]);
        let [o, d, a, b, c] = [draw.point(), d, a, b, c].map(|v| v.map(F::from_f64));
        compare_cuts(&Case::<F>::new(o, d, [a, b, c]), &mut draw, steps);
    }
}

/// Axes of sizes of their own, a point far away, and numbers that are lost beside it.
fn of_all_sizes(steps: &mut [u32; 4]) {
    for index in 0..200 {
        let mut draw = Draw::new("sizes", 1, index);
        let of_axis = [(); 4].map(|()| {
            let size = draw.integer(-500, 400) as i32;
            draw.pick(&[0, 0, size])
        });
        let mut vectors: [[f64; 3]; 5] = [(); 5].map(|()| draw.point());
        for (i, vector) in vectors.iter_mut().enumerate() {
            for (axis, x) in vector.iter_mut().enumerate() {
                let size = of_axis[axis] + if i == 1 { of_axis[3] } else { 0 };
                *x = if draw.below(6) == 0 {
                    0.0
                } else {
                    scaled(*x, size)
                };
            }
        }
        if draw.coin() {
            let far = draw.pick(&[0, 2, 3, 4]);
            let size = draw.integer(30, 500) as i32;
            vectors[far] = vectors[far].map(|x| scaled(x, size));
        }
        let [o, d, a, b, c] = vectors;
        compare_cuts(&Case::new(o, d, [a, b, c]), &mut draw, steps);
    }
}

#[test]
fn distances_of_all_families_are_right_to_a_thousandth() {
    let mut steps = [0; 4];
    families::<f32>(&[0, 0, -100, 90], &mut steps);
    families::<f64>(&[0, 0, -700, 600, -1030, 1000], &mut steps);
    assert!(steps.iter().all(|count| *count > 0), "{steps:?}");
}

#[test]
fn distances_are_right_to_a_thousandth_and_each_step_finds_what_it_can() {
    let mut steps = [[0; 4]; 3];
    grazing::<f32>(&mut steps[0]);
    grazing::<f64>(&mut steps[1]);
    of_all_sizes(&mut steps[2]);
    // A step that hands on what it could find is only slower, which no distance shows. So whoever changes
    // when a step is certain, or these cases, puts the new counts here, and says why.
    assert_eq!(
        steps,
        [[244, 0, 156, 0], [0, 117, 197, 86], [0, 57, 105, 237]]
    );
}

#[test]
fn numbers_lost_beside_a_far_origin_are_not_overlooked() {
    let by_integers = |case: Case<f64>| {
        let (found, step) = Distances::and_step(&case, &truth(&case));
        assert_eq!(step, DistanceStep::Integers, "{}", case.hex());
        compare(&case, &mut [0; 4]);
        found
    };
    // What is left near 1 of a number below 2^-174 is zero, and of one of 2^-160 some bits.
    let [far, edge, lost, few] = [900, 510, -176, -160].map(|exponent| scaled(1.0, exponent));
    let triangle = [[0.0; 3], [4.0 * edge, 0.0, 0.0], [0.0, 4.0 * edge, 0.0]];
    let beside = by_integers(Case::new([lost, edge, far], [0.0, 0.0, -1.0], triangle));
    assert_eq!(beside.in_space, lost / edge / 32f64.sqrt());
    let above = Case::new([far, 0.0, few], [0.0, 0.0, -1.0], triangle);
    let end = few * (1.0 + scaled(1.0, -20));
    by_integers(above.on(end, f64::INFINITY));
    by_integers(above.on(0.0, end));
    // The triangle would be a point on the line.
    let small = triangle.map(|vertex| vertex.map(|x| scaled(x, -710)));
    by_integers(Case::new([edge, edge, far], [0.0, 0.0, -1.0], small));
}

#[test]
fn what_a_truth_knows_to_be_zero_is_zero_in_every_step() {
    let mut steps = Vec::new();
    // Onto an edge of a triangle, and at an end of the interval.
    for (far, edge) in [
        (1.0, 1.0),
        (scaled(3.0, -700), scaled(1.0, -700)),
        (scaled(1.0, 800), 1.0),
    ] {
        let triangle = [[0.0; 3], [0.0, 4.0 * edge, 0.0], [0.0, 0.0, 4.0 * edge]];
        let case = Case::<f64>::new([far, edge, 0.0], [-1.0, 0.0, 0.0], triangle);
        for (t_min, t_max) in [(far, f64::INFINITY), (0.0, far), (far, far.next_up())] {
            let case = case.on(t_min, t_max);
            let (found, step) = Distances::and_step(&case, &truth(&case));
            assert_eq!(found.in_space, 0.0, "{step:?}");
            assert_eq!(
                [found.along[1] == 0.0, found.along[2] == 0.0],
                [t_min == far, t_max == far]
            );
            steps.push(step);
        }
        let start = Case::<f64>::new([0.0, edge, edge], [-1.0, 0.0, 0.0], triangle);
        assert_eq!(Distances::of(&start, &truth(&start)).along[0], 0.0);
    }
    use DistanceStep::{DoubleDoubles, FloatsNearOne, Integers};
    let near = [FloatsNearOne, FloatsNearOne, DoubleDoubles];
    assert_eq!(steps, [near, near, [Integers; 3]].concat());
}

#[test]
fn a_line_that_does_not_cross_the_plane_has_no_distance_along_it() {
    let triangle = [[0.0; 3], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let (ray, triangle) = Case::<f64>::new([1.0; 3], [0.0, 1.0, 0.0], triangle).exact();
    let along = Squares::<Exact>::of(&ray, &triangle, false).along;
    assert!(along.iter().all(Option::is_none));
    assert_eq!(nearest_on_segment(0.0, 0.0), 0.0);
    assert_eq!(
        [-1.0, 1.0, 3.0].map(|x| nearest_on_segment(x, 2.0)),
        [0.0, 0.5, 1.0]
    );
}

#[test]
fn a_line_through_the_middle_of_an_edge_is_at_zero_although_floats_round() {
    for index in 0..40 {
        let mut draw = Draw::new("middle", 1, index);
        let [o, a, b, c] = [(); 4].map(|()| {
            draw.lattice_point(1 << 45)
                .map(|x| x as f64 / (1i64 << 45) as f64)
        });
        // o + d/2 is the middle of ab.
        let d = [0, 1, 2].map(|i| a[i] + b[i] - 2.0 * o[i]);
        let case = Case::<f64>::new(o, d, [a, b, c]);
        let (end, above) = (0.5, 0.5f64.next_up());
        for (case, along, step) in [
            (case.on(end, f64::INFINITY), 1, DistanceStep::FloatsNearOne),
            (case.on(0.0, end), 2, DistanceStep::FloatsNearOne),
            (case.on(end, above), 1, DistanceStep::DoubleDoubles),
        ] {
            let (found, by) = Distances::and_step(&case, &truth(&case));
            assert_eq!(
                (found.in_space, found.along[along], by),
                (0.0, 0.0, step),
                "{}",
                case.hex()
            );
        }
    }
}

/// The steps for a distance of a share of 2^-38 times the largest coordinate, 4, which is that of one point
/// after the other; the points and the direction are multiplied by powers of two.
fn steps_at<F: Float>(share: f64, [size, length]: [i32; 2]) -> [DistanceStep; 4] {
    let at = |x: f64| F::from_f64(scaled(x, size));
    let step = |origin: f64, [a, b, c]: [f64; 3]| {
        let triangle = [[-a, 0.0, 0.0], [b, 0.0, 0.0], [0.0, c, 0.0]].map(|v| v.map(at));
        let origin = [0.25, scaled(share, -36), origin].map(at);
        let d = [0.0, 0.0, -1.75].map(|x| F::from_f64(scaled(x, length)));
        let case = Case::<F>::new(origin, d, triangle);
        compare(&case, &mut [0; 4]);
        Distances::and_step(&case, &truth(&case)).1
    };
    [
        step(4.0, [1.0, 1.0, 1.0]),
        step(1.0, [4.0, 1.0, 1.0]),
        step(1.0, [1.0, 4.0, 1.0]),
        step(1.0, [1.0, 1.0, 4.0]),
    ]
}

#[test]
fn floats_are_certain_of_distances_from_a_share_of_the_largest_coordinate_on() {
    for powers in [[0, 0], [40, 20], [-40, 0]] {
        assert_eq!(
            steps_at::<f32>(3.0, powers),
            [DistanceStep::DoubleDoubles; 4]
        );
        assert_eq!(
            steps_at::<f64>(3.0, powers),
            [DistanceStep::DoubleDoubles; 4]
        );
        for share in [4.0, 5.0] {
            assert_eq!(steps_at::<f32>(share, powers), [DistanceStep::Floats; 4]);
            assert_eq!(
                steps_at::<f64>(share, powers),
                [DistanceStep::FloatsNearOne; 4]
            );
        }
    }
}

#[test]
fn edges_whose_squares_could_underflow_are_left_to_integers_but_points_are_not() {
    let step = |edges: [f64; 2]| {
        let [x, y] = edges;
        let triangle = [[0.0; 3], [x, 0.0, 0.0], [0.0, y, 0.0]];
        let case = Case::<f64>::new([0.25, 0.5, 1.0], [0.0, 0.0, -1.0], triangle);
        compare(&case, &mut [0; 4]);
        Distances::and_step(&case, &truth(&case)).1
    };
    let edge = |exponent: i32| scaled(1.5, exponent);
    // The longest edge is √2·1.5 times as long, against 2^-400.
    assert_eq!(step([edge(-401); 2]), DistanceStep::FloatsNearOne);
    assert_eq!(step([edge(-402); 2]), DistanceStep::Integers);
    assert_eq!(step([scaled(1.0, -400), 0.0]), DistanceStep::FloatsNearOne);
    assert_eq!(step([0.0, edge(-450)]), DistanceStep::Integers);
    assert_eq!(step([0.0; 2]), DistanceStep::FloatsNearOne);
}

#[test]
fn floats_are_certain_of_an_end_from_a_thousandfold_of_their_error_on() {
    let mut steps = [0; 4];
    for index in 0..2000 {
        let mut draw = Draw::new("ends", 1, index);
        let [o, d, a, b, c] = [(); 5].map(|()| draw.point());
        // Origins and triangles of sizes of their own.
        let far = scaled(1.0, draw.integer(-3, 3) as i32);
        let case = Case::<f64>::new(o.map(|x| x * far), d, [a, b, c]);
        let Some(t) = define(&case).exact.t.and_then(|t| t.to_f64()) else {
            continue;
        };
        let end = t * (1.0 + scaled(draw.symmetric(), draw.integer(-44, -26) as i32));
        compare(&case.on(end, f64::INFINITY), &mut steps);
    }
    // As above: whoever changes when floats are certain puts the new counts here, and says why.
    assert_eq!(steps, [0, 677, 1323, 0]);
}
