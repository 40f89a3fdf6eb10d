//! Instances: the fast answers are those of the definition, and known ones.

use crate::drawn::Reference;
use crate::instanced::{Placements, compare_instances};
use crate::solids::{cube, octahedron};
use crate::spheres::icosphere;
use hairline_core::Case;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::{Draw, Instance as CaseInstance};
use hairline_core::oracle::define_instance;
use hairline_scene::{
    Instance, Instances, Matrix, PlacedFace, Ray, Scene, WrongInstance, define_instances,
};

const IDENTITY: Matrix<f64> = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

fn check(met: Placements) {
    let few = met.rays / 50;
    assert!(
        few < met.hits && few < met.ties && few < met.segments,
        "{met:?}"
    );
    assert!(
        met.invalid < met.rays / 2 && met.too_large < met.rays / 20,
        "{met:?}"
    );
}

#[test]
fn hits_of_instances_are_those_of_the_definition() {
    check(compare_instances::<f32>(1, 300, Reference::Definition));
    check(compare_instances::<f64>(1, 300, Reference::Definition));
}

#[test]
fn more_hits_of_instances_are_those_of_the_faces_that_the_exact_inverse_meets() {
    check(compare_instances::<f32>(2, 2_000, Reference::Walk));
    check(compare_instances::<f64>(2, 2_000, Reference::Walk));
}

#[test]
fn the_definition_is_that_of_the_exact_inverse() {
    let mut hits = 0;
    for index in 0..3000 {
        let mut draw = Draw::new("inverse", 1, index);
        let triangle = [(); 3].map(|()| draw.lattice_point(3).map(|x| x as f64));
        let matrix = [(); 3].map(|()| [(); 4].map(|()| draw.integer(-2, 2) as f64));
        let origin = draw.lattice_point(5).map(|x| x as f64);
        let direction = draw.lattice_point(3).map(|x| x as f64);
        let Some(inverted) = CaseInstance::new(matrix) else {
            continue;
        };
        if direction == [0.0; 3] {
            continue;
        }
        let ray = Ray::new(origin, direction);
        let case = Case::<f64>::new(origin, direction, triangle);
        let expected = define_instance(&case, &inverted);
        let found = define_instances(&[vec![triangle]], &[Instance { mesh: 0, matrix }], &ray);
        let found = found.unwrap().pop();
        assert_eq!(found.is_some(), expected.truth.hits_closed() == Some(true));
        if let (Some(found), Some(t)) = (found, expected.exact.t) {
            assert_eq!([found.from, found.to], [t.clone(), t]);
            hits += 1;
        }
    }
    assert!(50 < hits, "{hits}");
}

#[test]
fn instances_that_stay_floats_are_scenes() {
    // Many faces, moved by whole numbers, mirrored, and twice as large.
    let sphere: Vec<[[f32; 3]; 3]> = icosphere(2).triangles();
    let sphere: Vec<[[f64; 3]; 3]> = sphere
        .iter()
        .map(|face| face.map(|vertex| vertex.map(f64::from)))
        .collect();
    let meshes = vec![sphere, cube(), octahedron()];
    let moved = |scale: [f64; 3], by: [f64; 3]| {
        let mut matrix = IDENTITY;
        for axis in 0..3 {
            matrix[axis][axis] = scale[axis];
            matrix[axis][3] = by[axis];
        }
        matrix
    };
    let instances: Vec<Instance<f64>> = (0..12)
        .map(|k| Instance {
            mesh: k % 3,
            matrix: moved(
                [if k < 6 { 1.0 } else { -2.0 }, 1.0, 0.5],
                [f64::from(k), f64::from(k % 4), f64::from(k % 5)],
            ),
        })
        .collect();
    let mut vertices = Vec::new();
    let mut numbers = Vec::new();
    for (instance, it) in (0..).zip(&instances) {
        for (face, triangle) in (0..).zip(&meshes[it.mesh as usize]) {
            numbers.push(PlacedFace { instance, face });
            for vertex in triangle {
                vertices.push(
                    it.matrix.map(|[a, b, c, moved]| {
                        a * vertex[0] + b * vertex[1] + c * vertex[2] + moved
                    }),
                );
            }
        }
    }
    let faces = (0..numbers.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let flat = Scene::new(&vertices, &faces.collect::<Vec<_>>()).unwrap();
    let scene = Instances::new(meshes, &instances).unwrap();
    let mut hits = 0;
    for index in 0..2000 {
        let mut draw = Draw::new("flat", 1, index);
        let origin: [f64; 3] = draw.point().map(|x: f64| 20.0 * x);
        let target: [f64; 3] = draw.pick(&vertices);
        let ray = Ray::new(origin, [0, 1, 2].map(|i| target[i] - origin[i]));
        let (expected, found) = (flat.hits(&ray).unwrap(), scene.hits(&ray).unwrap());
        let named = |face: &u32| numbers[*face as usize];
        let expected = expected
            .iter()
            .map(|hit| hit.faces.iter().map(named).collect());
        let expected: Vec<Vec<PlacedFace>> = expected.collect();
        let found: Vec<Vec<PlacedFace>> = found.into_iter().map(|hit| hit.faces).collect();
        assert_eq!(found, expected, "{ray:?}");
        hits += found.len();
    }
    assert!(4000 < hits, "{hits}");
}

#[test]
fn a_tenth_is_the_float_and_not_its_rounded_product() {
    // Exactly 0.1·3 lies between two floats, and the larger one is the rounded product.
    let mesh = vec![[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]]];
    let matrix = IDENTITY.map(|row| row.map(|x| 0.1 * x));
    let scene = Instances::new(vec![mesh], &[Instance { mesh: 0, matrix }]).unwrap();
    let rounded = 0.1 * 3.0;
    let at = |x: f64| {
        scene
            .nearest(&Ray::new([x, 0.0, 1.0], [0.0, 0.0, -1.0]))
            .unwrap()
    };
    assert_eq!(at(rounded), None);
    assert!(at(rounded.next_down()).is_some());
}

#[test]
fn a_singular_matrix_makes_faces_flat() {
    let mut matrix = IDENTITY;
    matrix[2] = [0.0, 0.0, 0.0, 1.0];
    let instance = Instance { mesh: 0, matrix };
    let scene = Instances::new(vec![cube()], &[instance]).unwrap();
    // Top and bottom lie on each other, the four sides are segments.
    let down = Ray::new([0.5, 0.25, 5.0], [0.0, 0.0, -1.0]);
    let hits = scene.hits(&down).unwrap();
    assert_eq!(hits.len(), 1);
    assert_eq!(hits[0].faces.len(), 2);
    let at_side = Ray::new([2.0, 0.25, 5.0], [0.0, 0.0, -1.0]);
    let faces = &scene.hits(&at_side).unwrap()[0].faces;
    assert_eq!(faces.len(), 4);
    assert_eq!(scene.t(&at_side, faces[0]), Ok(Some([4.0; 2])));
    // Along the plane.
    let along = Ray::new([-5.0, 0.25, 1.0], [1.0, 0.0, 0.0]);
    assert!(scene.hits(&along).unwrap().iter().any(|hit| hit.is_segment));
    // All of it a point.
    let matrix = IDENTITY.map(|_| [0.0, 0.0, 0.0, 7.0]);
    let scene = Instances::new(vec![cube()], &[Instance { mesh: 0, matrix }]).unwrap();
    let nearest = scene
        .nearest(&Ray::new([0.0; 3], [1.0; 3]))
        .unwrap()
        .unwrap();
    assert_eq!(nearest.faces.len(), 12);
    assert!(nearest.t.lower <= 7.0 && 7.0 <= nearest.t.upper);
}

#[test]
fn wrong_instances_and_faces_are_named() {
    let meshes = || vec![cube()];
    let good = Instance {
        mesh: 0,
        matrix: IDENTITY,
    };
    let wrong = |instance: Instance<f64>| {
        let error = Instances::new(meshes(), &[good, instance]).err().unwrap();
        assert!(error.to_string().contains("instance 1"), "{error}");
        error.kind
    };
    assert_eq!(
        wrong(Instance { mesh: 1, ..good }),
        WrongInstance::NoSuchMesh
    );
    let with = |x: f64| {
        let mut matrix = IDENTITY;
        matrix[1][1] = x;
        wrong(Instance { mesh: 0, matrix })
    };
    assert_eq!(with(f64::NAN), WrongInstance::NotFinite);
    assert_eq!(with(f64::INFINITY), WrongInstance::NotFinite);
    assert_eq!(with(f64::MAX), WrongInstance::TooLarge);
    // Vertices at 2 are at 2^1000 then, and half as far.
    let power = |exponent: i32| scale_by_power_of_two(1.0, exponent);
    assert_eq!(with(power(999)), WrongInstance::TooLarge);
    let mut matrix = IDENTITY;
    matrix[1][1] = power(998);
    assert!(Instances::new(meshes(), &[Instance { mesh: 0, matrix }]).is_ok());
    let mut faces = cube();
    faces[3][0][1] = f64::NAN;
    let scene = Instances::new(vec![faces], &[good]).unwrap();
    let ray = Ray::new([0.0; 3], [1.0, 0.0, 0.0]);
    for (instance, face) in [(0, 3), (0, 12), (1, 0)] {
        assert_eq!(
            scene.fractions(&ray, PlacedFace { instance, face }),
            Ok(None)
        );
    }
    assert_eq!(
        Instances::<f64>::new(Vec::new(), &[])
            .unwrap()
            .nearest(&ray),
        Ok(None)
    );
}
