//! Numbers at the ends of the range, where published slab tests lose hits.

use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;
use hairline_core::{Case, truth};
use hairline_scene::{Ray, Scene, Triangle};

/// A face, and another one on the side of larger x: the box of both begins where the first one does.
fn scene(face: Triangle<f64>) -> Scene<f64> {
    let away = 4.0 * face[1][0];
    let other = face.map(|[x, y, z]| [x + away, y, z]);
    let vertices = [face, other].concat();
    Scene::new(&vertices, &[[0, 1, 2], [3, 4, 5]]).unwrap()
}

/// The right triangle at the origin, in the plane z = 0.
fn corner(size: f64) -> Triangle<f64> {
    [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0]]
}

fn finds_face_0(scene: &Scene<f64>, ray: &Ray<f64>) -> bool {
    let nearest = scene.nearest(ray).unwrap();
    nearest.is_some_and(|nearest| nearest.faces.contains(&0))
}

#[test]
fn a_reciprocal_that_overflows_loses_nothing() {
    // At t = 2^900 the ray is at x = 2^-126, inside the box that it started beside.
    let power = |exponent: i32| scale_by_power_of_two(1.0, exponent);
    let ray = Ray::new([-power(-126), 0.25, power(900)], [power(-1025), 0.0, -1.0]);
    assert!(finds_face_0(&scene(corner(1.0)), &ray));
    // At t = 1 it is at x = 2^-1074.
    let tiny = f64::from_bits(1);
    let ray = Ray::new([-tiny, 0.25, 1.0], [2.0 * tiny, 0.0, -1.0]);
    assert!(finds_face_0(&scene(corner(1.0)), &ray));
}

#[test]
fn an_origin_that_overflows_in_the_scale_of_the_scene_loses_nothing() {
    let size = 2f64.powi(-500);
    let far = 2f64.powi(600);
    let ray = Ray::new([0.25 * size, 0.25 * size, far], [0.0, 0.0, -far]);
    assert!(finds_face_0(&scene(corner(size)), &ray));
}

#[test]
fn products_that_underflow_lose_nothing() {
    let mut hits = 0;
    for index in 0..40_000 {
        let mut draw = Draw::new("underflow", 1, index);
        // The planes of x and z are met at nearly the same t, near the middle between two subnormal numbers.
        let t = 0.5 + draw.integer(1, 5) as f64;
        let steps = [(); 3].map(|()| draw.integer(1, 5) as f64);
        let speed = |draw: &mut Draw, step: f64| {
            let speed = step / t;
            f64::from_bits(speed.to_bits().wrapping_add_signed(draw.integer(-2, 2)))
        };
        let [x, y, z] = steps;
        let direction = [
            speed(&mut draw, x),
            speed(&mut draw, y),
            -speed(&mut draw, z),
        ];
        let origin = [-x, -y, z].map(|step| scale_by_power_of_two(step, -1074));
        let ray = Ray::new(origin, direction);
        let case = Case::<f64>::new(ray.origin, ray.direction, corner(1.0));
        if truth(&case).hits_closed() == Some(true) {
            assert!(finds_face_0(&scene(corner(1.0)), &ray), "{ray:?}");
            hits += 1;
        }
    }
    assert!(2000 < hits, "{hits}");
}

#[test]
fn ends_of_intervals_that_underflow_in_the_scale_lose_nothing() {
    // t is multiplied by 2^-60 in the scale of this scene and this direction.
    let size = 2f64.powi(60);
    for digits in 1..40 {
        let t = f64::from_bits(digits) * 2f64.powi(30);
        let ray = Ray::new([0.25 * size, 0.25 * size, t], [0.0, 0.0, -1.0]);
        for ends in [[t, t], [0.0, t], [t, 1.0]] {
            let ray = ray.on(ends[0], ends[1]);
            assert!(finds_face_0(&scene(corner(size)), &ray), "{ray:?}");
        }
        let short = ray.on(0.0, t.next_down());
        assert_eq!(scene(corner(size)).nearest(&short), Ok(None));
    }
}

#[test]
fn contacts_of_faces_without_area_fill_the_integers() {
    // 38 bits in every coordinate of a segment, and a ray across it.
    let most = 2f64.powi(37);
    let [a, b] = [
        [most, most - 1.0, 1.0 - most],
        [-most, 3.0 - most, most - 5.0],
    ];
    let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
    let face = [a, middle, b];
    let scene = Scene::new(&face, &[[0, 1, 2]]).unwrap();
    for direction in [[1.0, most - 1.0, most - 3.0], [most - 1.0, 1.0, 1.0 - most]] {
        let origin = [0, 1, 2].map(|i| middle[i] - direction[i]);
        let values = scene.values(&Ray::new(origin, direction), 0).unwrap();
        assert_eq!(values.map(|values| values.t), Some([1.0; 2]));
    }
}

#[test]
fn a_hit_at_the_end_of_the_interval_is_in_a_box_that_rounding_puts_behind_it() {
    for speed in 1..200 {
        for t in 1..40 {
            // (b-o)·(1/d) is a little more than t for some of them.
            let [d, t] = [speed, t].map(f64::from);
            let face = [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let ray = Ray::new([-d * t, 0.25, 0.25], [d, 0.0, 0.0]).on(0.0, t);
            let behind = face.map(|[x, y, z]| [x + 1.0, y, z]);
            let scene = Scene::new(&[face, behind].concat(), &[[0, 1, 2], [3, 4, 5]]).unwrap();
            assert!(finds_face_0(&scene, &ray), "{ray:?}");
            // And where t is negative.
            let back = Ray::new([d * t, 0.25, 0.25], [d, 0.0, 0.0]).on(f64::NEG_INFINITY, -t);
            assert!(finds_face_0(&scene, &back), "{back:?}");
        }
    }
}
