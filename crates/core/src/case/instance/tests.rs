//! Instances beside glam's matrices, beside exact arithmetic, and by hand.

use super::*;
use crate::case::Draw;
use std::array::from_fn;

/// A matrix whose inverse has no rounded number: x is stretched, y sheared along x, z stretched. Its determinant is 8.
const SHEARED: Matrix<f64> = [
    [2.0, 1.0, 0.0, 5.0],
    [0.0, 1.0, 0.0, -3.0],
    [0.0, 0.0, 4.0, 1.0],
];

/// The same with two rows exchanged, which turns an object inside out.
const MIRRORED: Matrix<f64> = [SHEARED[1], SHEARED[0], SHEARED[2]];

const TRIANGLE: [[f64; 3]; 3] = [[1.0, 2.0, -1.0], [3.0, -1.0, 2.0], [-2.0, 1.0, 4.0]];

fn case() -> Case<f64> {
    Case::new([7.0, -2.0, 3.0], [-1.0, 0.5, 2.0], TRIANGLE).on(0.5, 7.0)
}

fn minus(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    from_fn(|axis| p[axis] - q[axis])
}

/// The normal of a triangle by its edges from a.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    cross(minus(b, a), minus(c, a))
}

#[test]
fn the_ray_goes_by_the_inverse_as_glam_has_it() {
    let mut draw = Draw::new("instances", 1, 0);
    let mut number = || draw.below(1 << 24) as f32 / (1 << 22) as f32 - 2.0;
    for _ in 0..1000 {
        let columns: [[f32; 3]; 4] = from_fn(|_| from_fn(|_| number()));
        let [origin, direction]: [[f32; 3]; 2] = from_fn(|_| from_fn(|_| number()));
        let matrix = [0, 1, 2].map(|row| columns.map(|column| column[row]));
        let instance = Instance::new(matrix).unwrap();
        let inverse = glam::Affine3::from_cols_array_2d(&columns).inverse();
        let triangle = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let found = instance.in_object(&Case::new(origin, direction, triangle).on(0.5, 7.0));
        let point = inverse.transform_point3(origin.into()).to_array();
        let vector = inverse.transform_vector3(direction.into()).to_array();
        assert_eq!(
            found,
            Case::new(point, vector, triangle).on(0.5, 7.0),
            "{matrix:?}"
        );
        assert_eq!(instance.matrix(), matrix);
    }
}

#[test]
fn a_matrix_without_an_inverse_is_refused() {
    let singular = [
        [1.0f32, 2.0, 3.0, 0.0],
        [2.0, 4.0, 6.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    assert_eq!(Instance::new(singular), None);
    let why = |matrix: Matrix<f32>| Instance::checked(matrix).unwrap_err();
    assert_eq!(
        why(singular),
        "the matrix is singular in f32: it has no inverse"
    );
    // It has an inverse, but its determinant, 2^-150, is rounded to 0.
    let tiny = 2.0f32.powi(-50);
    let small = [
        [tiny, 0.0, 0.0, 0.0],
        [0.0, tiny, 0.0, 0.0],
        [0.0, 0.0, tiny, 0.0],
    ];
    assert_eq!(why(small), "its inverse is not finite in f32");
    let mut no_number = small;
    no_number[1][1] = f32::NAN;
    assert_eq!(why(no_number), "its inverse is not finite in f32");
    // Cancellation leaves a determinant of 0 where the exact one is 2^-46.
    let [one, less] = [1.0f32, 1.0 - 2.0f32.powi(-23)];
    let more = 1.0 + 2.0f32.powi(-23);
    let near = [
        [more, one, 0.0, 0.0],
        [one, less, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    assert_eq!(why(near), "its inverse is not finite in f32");
    assert_eq!(
        Instance::checked(SHEARED),
        Ok(Instance::new(SHEARED).unwrap())
    );
}

/// The normal of the triangle in the world is that of its vertices there, divided by the determinant. So a mirror leaves
/// it on the side on which the object has it.
#[test]
fn a_normal_of_the_world_is_normal_to_the_triangle_there() {
    for (matrix, determinant) in [(SHEARED, 8.0), (MIRRORED, -8.0)] {
        let instance = Instance::new(matrix).unwrap();
        let there = TRIANGLE.map(|point| instance.point_in_world(point));
        let found = instance.normal_in_world(normal(TRIANGLE));
        assert_eq!(found.map(|x| determinant * x), normal(there));
        // A point before the triangle is before it in the world too.
        let before = instance.point_in_world(from_fn(|i| TRIANGLE[0][i] + normal(TRIANGLE)[i]));
        assert!(0.0 < dot(found, minus(before, there[0])));
    }
}

#[test]
fn a_mirror_turns_an_object_inside_out() {
    let diagonal = |[x, y, z]: [f64; 3]| [[x, 0., 0., 1.], [0., y, 0., -1.], [0., 0., z, 0.]];
    for (matrix, is_mirrored) in [
        (diagonal([1.0, 1.0, 1.0]), false),
        (diagonal([-1.0, 2.0, 3.0]), true),
        (diagonal([1.0, -2.0, 3.0]), true),
        (diagonal([1.0, 2.0, -3.0]), true),
        (diagonal([-1.0, -2.0, 3.0]), false),
        (diagonal([-1.0, -2.0, -3.0]), true),
        (SHEARED, false),
        (MIRRORED, true),
    ] {
        assert_eq!(
            Instance::new(matrix).unwrap().is_mirrored(),
            is_mirrored,
            "{matrix:?}"
        );
    }
}

#[test]
fn points_and_rays_of_the_object_are_brought_to_the_world() {
    let instance = Instance::new(SHEARED).unwrap();
    let exact = instance.place(TRIANGLE, Exact::from_f64);
    // (2x + y + 5, y - 3, 4z + 1).
    let there = [[9.0, -1.0, -3.0], [10.0, -4.0, 9.0], [2.0, -2.0, 17.0]];
    assert_eq!(TRIANGLE.map(|point| instance.point_in_world(point)), there);
    assert_eq!(
        exact.map(|point| [0, 1, 2].map(|axis| point.at(axis).approximate())),
        there
    );
    let case = case();
    let placed = instance.in_world(&case);
    let [origin, direction, triangle @ ..] = placed.vectors();
    assert_eq!((origin, direction), ([17.0, -5.0, 13.0], [-1.5, 0.5, 8.0]));
    assert_eq!(triangle, TRIANGLE, "the triangle stays in the object");
    assert_eq!((placed.ray.t_min, placed.ray.t_max), (0.5, 7.0));
    // And back, since nothing is rounded.
    assert_eq!(instance.in_object(&placed), case);
    assert_eq!(instance.widen(), instance);
}

/// The exact ray in the object is as many times as large as the determinant, and so is the triangle: the matrix brings
/// both back.
#[test]
fn the_exact_ray_of_the_object_is_the_worlds() {
    for (matrix, determinant) in [(SHEARED, 8.0), (MIRRORED, -8.0)] {
        let instance = Instance::new(matrix).unwrap();
        let placed = instance.in_world(&case());
        let (ray, triangle, found) = instance.lift(&placed, Exact::from_f64);
        let [origin, direction, a, b, c] = case()
            .vectors()
            .map(|vector| vector.map(|x| determinant * x));
        let floats = |vector: &Triple<Exact>| [0, 1, 2].map(|axis| vector.at(axis).approximate());
        assert_eq!(found.approximate(), determinant);
        assert_eq!(
            [&ray.origin, &ray.direction].map(floats),
            [origin, direction]
        );
        assert_eq!(
            [&triangle.a, &triangle.b, &triangle.c].map(floats),
            [a, b, c]
        );
        assert_eq!(
            [ray.t_min, ray.t_max].map(|end| end.approximate()),
            [0.5, 7.0]
        );
    }
}

#[test]
fn an_instance_of_a_case_id_is_twelve_numbers() {
    let written = text(&SHEARED);
    assert_eq!(written, "2e0:1e0:0e0:5e0:0e0:1e0:0e0:-3e0:0e0:0e0:4e0:1e0");
    assert_eq!(parsed(&written), Ok(SHEARED));
    assert!(
        parsed(&written[4..])
            .unwrap_err()
            .ends_with("write 12 numbers with : between them")
    );
}
