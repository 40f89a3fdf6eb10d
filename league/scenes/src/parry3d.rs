//! parry3d and parry3d-f64 0.31.1: `CompositeShapeRef::cast_local_ray` on a `TriMesh`, which `TriMesh`'s own
//! `cast_local_ray` calls and which names the face too. "Returns the ray's time of impact and the index of the sub-shape of
//! `self` that was hit."

use crate::library::{Answer, Library, Line, Mesh, in_f32};

pub const IN_F32: Library = Library {
    name: "parry3d",
    version: "0.31.1",
    scalar: "f32",
    answers: answers_in_f32,
};

pub const IN_F64: Library = Library {
    name: "parry3d-f64",
    scalar: "f64",
    answers: answers_in_f64,
    ..IN_F32
};

macro_rules! answers {
    ($answers:ident, $library:ident, $scalar:ident, $converted:expr) => {
        fn $answers(mesh: &Mesh, rays: &[Line]) -> Vec<Answer> {
            use $library::math::Vector;
            use $library::query::Ray;
            use $library::shape::{CompositeShapeRef, TriMesh};
            let vector = |point: [f64; 3]| Vector::from($converted(point));
            let vertices = mesh.vertices.iter().copied().map(vector).collect();
            let shape = TriMesh::new(vertices, mesh.faces.clone()).expect("a mesh");
            let answer = |[o, d]: &Line| {
                let ray = Ray::new(vector(*o), vector(*d));
                let hit = CompositeShapeRef(&shape).cast_local_ray(&ray, $scalar::MAX, true);
                hit.map(|(face, t)| (face, f64::from(t)))
            };
            rays.iter().map(answer).collect()
        }
    };
}

answers!(answers_in_f32, parry3d, f32, in_f32);
answers!(
    answers_in_f64,
    parry3d_f64,
    f64,
    std::convert::identity::<[f64; 3]>
);
