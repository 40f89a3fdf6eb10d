//! Tests of the definition in rationals.

use super::*;
use crate::case::Draw;
use crate::oracle::{Layers, truth, truths_of_instance};

#[test]
fn an_interval_out_of_order_or_no_direction_is_invalid() {
    let triangle = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let down = |z: f64| Case::<f64>::new([0.25, 0.25, 1.0], [0.0, 0.0, z], triangle);
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    for (t_min, t_max, valid) in [
        (1.0, 1.0, true),
        (-infinity, infinity, true),
        (-infinity, -infinity, true),
        (infinity, infinity, true),
        (1.0, 0.5, false),
        (infinity, -infinity, false),
        (nan, 1.0, false),
        (0.0, nan, false),
    ] {
        for case in [down(-1.0), down(-0.1)].map(|case| case.on(t_min, t_max)) {
            assert_eq!(
                define(&case).truth != Truth::Invalid,
                valid,
                "{t_min} {t_max}"
            );
            assert_eq!(truth(&case), define(&case).truth, "{t_min} {t_max}");
        }
    }
    for zero in [0.0, -0.0] {
        let still = Case::new([0.1; 3], [zero; 3], triangle);
        assert_eq!(
            (define(&still).truth, truth(&still)),
            (Truth::Invalid, Truth::Invalid)
        );
    }
}

#[test]
fn the_truths_of_instances_are_those_of_the_definition() {
    let mut kinds = [0; 6];
    for index in 0..3000 {
        let mut draw = Draw::new("instances", 1, index);
        let number = |draw: &mut Draw| match draw.below(4) {
            0 => draw.integer(-2, 2) as f64,
            1 => draw.integer(-3, 3) as f64 * 2f64.powi(draw.integer(-40, 40) as i32),
            _ => draw.symmetric::<f64>(),
        };
        let coarse = index % 2 == 0;
        let rows = [(); 3].map(|()| {
            [(); 4].map(|()| match coarse {
                true => draw.integer(-2, 2) as f64,
                false => number(&mut draw),
            })
        });
        let Some(instance) = Instance::new(rows) else {
            continue;
        };
        let [o, d, a, b, mut c] = std::array::from_fn(|_| match coarse {
            true => draw.lattice_point(2).map(|x| x as f64),
            false => [(); 3].map(|()| number(&mut draw)),
        });
        if draw.below(8) == 0 {
            c = [0, 1, 2].map(|i| a[i] + 2.0 * (b[i] - a[i]));
        }
        let case = Case::<f64>::new(o, d, [a, b, c]);
        // Some lattice rays are aimed at the triangle where the matrix puts it.
        let case = if draw.coin() {
            instance.in_world(&case)
        } else {
            case
        };
        let (t_min, t_max) = draw.pick(&[
            (0.0, f64::INFINITY),
            (f64::NEG_INFINITY, 1.0),
            (-0.5, 0.5),
            (1.0, 1.0),
        ]);
        let case = case.on(t_min, t_max);
        let defined = define_instance(&case, &instance).truth;
        let mut found = Vec::new();
        truths_of_instance(&[case], &instance, &mut found, &mut Layers::default());
        assert_eq!(found, [defined], "{} {rows:?}", case.hex());
        kinds[match defined {
            Truth::Invalid => 0,
            Truth::Parallel => 1,
            Truth::Coplanar(_) => 2,
            Truth::Degenerate(_) => 3,
            Truth::Transversal(Crossing {
                facing: Facing::Front,
                ..
            }) => 4,
            Truth::Transversal(_) => 5,
        }] += 1;
    }
    assert!(kinds.into_iter().all(|count| 5 < count), "{kinds:?}");
}

#[test]
fn values_are_those_of_the_crossing_and_contacts_those_of_the_oracle() {
    let (mut crossings, mut contacts) = (0, 0);
    for index in 0..6000 {
        let mut draw = Draw::new("definition", 1, index);
        let [o, d, a, b, mut c] = std::array::from_fn(|_| draw.lattice_point(2).map(|x| x as f64));
        if draw.coin() {
            let k = draw.integer(-1, 2) as f64;
            c = [0, 1, 2].map(|i| a[i] + k * (b[i] - a[i]));
        }
        let ends = [
            (0.0, f64::INFINITY),
            (f64::NEG_INFINITY, f64::INFINITY),
            (-1.0, 0.5),
            (0.5, 0.5),
            (1.0, 1.0),
        ];
        let (t_min, t_max) = draw.pick(&ends);
        let case = Case::<f64>::new(o, d, [a, b, c]).on(t_min, t_max);
        let Definition {
            truth: defined,
            exact,
        } = define(&case);
        assert_eq!(truth(&case), defined, "{}", case.hex());
        contacts += u32::from(matches!(defined, Truth::Coplanar(_) | Truth::Degenerate(_)));
        // o + t d = a + u (b-a) + v (c-a).
        if let (Some(t), Some(u), Some(v)) = (exact.t, exact.u, exact.v) {
            let [o, d, a, b, c] = case
                .vectors()
                .map(|x| x.map(|x| Rational::from_float(x).unwrap()));
            assert_eq!(
                along(&o, &d, &t),
                along(&along(&a, &minus(&b, &a), &u), &minus(&c, &a), &v)
            );
            crossings += 1;
        }
    }
    assert!(
        crossings > 1000 && contacts > 1000,
        "{crossings} {contacts}"
    );
}
