//! bvh 0.13.0: `Bvh::traverse` and `Ray::intersects_triangle` on what it returns, the least distance of all.
//!
//! `intersects_triangle` misses a triangle from behind, as documented, so every face is asked twice, once turned.
//! `Ray::new` makes the direction a unit vector.

use crate::library::{Answer, Library, Line, Mesh};
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::{BHShape, BHValue};
use bvh::bvh::Bvh;
use bvh::ray::Ray;
use nalgebra::{Point3, Vector3};

pub const IN_F32: Library = Library {
    name: "bvh",
    version: "0.13.0",
    scalar: "f32",
    answers: answers_in_f32,
};

pub const IN_F64: Library = Library {
    name: "bvh-f64",
    scalar: "f64",
    answers: answers_in_f64,
    ..IN_F32
};

struct Face<F: BHValue> {
    corners: [Point3<F>; 3],
    number: u32,
    node: usize,
}

impl<F: BHValue> Bounded<F, 3> for Face<F> {
    fn aabb(&self) -> Aabb<F, 3> {
        let [a, b, c] = &self.corners;
        Aabb::empty().grow(a).grow(b).grow(c)
    }
}

impl<F: BHValue> BHShape<F, 3> for Face<F> {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

macro_rules! answers {
    ($answers:ident, $scalar:ident) => {
        fn $answers(mesh: &Mesh, rays: &[Line]) -> Vec<Answer> {
            let scalar = |point: [f64; 3]| point.map(|x| x as $scalar);
            let face = |number| {
                let corners = mesh.triangle(number).map(|p| Point3::from(scalar(p)));
                Face {
                    corners,
                    number,
                    node: 0,
                }
            };
            let mut faces: Vec<Face<$scalar>> = (0..mesh.faces.len() as u32).map(face).collect();
            let tree = Bvh::build(&mut faces);
            let answer = |[o, d]: &Line| {
                let direction = Vector3::from(scalar(*d));
                let ray = Ray::new(Point3::from(scalar(*o)), direction);
                let distance = |face: &&Face<$scalar>| {
                    let [a, b, c] = &face.corners;
                    let sides = [[a, b, c], [a, c, b]];
                    let sides = sides.map(|[a, b, c]| ray.intersects_triangle(a, b, c).distance);
                    (face.number, sides[0].min(sides[1]))
                };
                let met = tree.traverse(&ray, &faces);
                let nearest = met
                    .iter()
                    .map(distance)
                    .min_by(|(_, s), (_, t)| s.total_cmp(t));
                let (face, distance) = nearest.filter(|(_, distance)| distance.is_finite())?;
                Some((face, f64::from(distance / direction.norm())))
            };
            rays.iter().map(answer).collect()
        }
    };
}

answers!(answers_in_f32, f32);
answers!(answers_in_f64, f64);
