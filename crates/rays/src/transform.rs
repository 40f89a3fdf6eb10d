//! Hits that the transform of an instance loses where a program computes it in f32: it brings the ray to the object, or the vertices to
//! the world.

use crate::case::{Case, Instance};
use crate::files::mesh::{Mesh, PlacedPart};
use crate::kernel::Scalar;
use crate::oracle::truth;
use hairline_scene::Ray;

named! {
    pub names
    /// A way in which a program brings a ray and an instance together.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Way {
        /// The ray is brought to the object by the inverse.
        RayByInverse = "rays by the inverse",
        /// The vertices are brought to the world by the matrix.
        VerticesByMatrix = "vertices by the matrix",
    }
}

impl Way {
    /// True if a ray misses a face exactly after this transform in f32. Faces that no matrix moved are not lost by it.
    pub fn loses<F: Scalar>(self, mesh: &Mesh, ray: &Ray<F>, face: u32) -> bool {
        let Some((part, corners)) = mesh.before_matrix(face as usize) else {
            return false;
        };
        let Some(instance) = instance_of(part) else {
            return false;
        };
        let hits = match self {
            Way::RayByInverse => {
                let narrow = |point: [F; 3]| point.map(|x| x.to_f64() as f32);
                let [t_min, t_max] = [ray.t_min, ray.t_max].map(|t| t.to_f64() as f32);
                let case = Case::new(narrow(ray.origin), narrow(ray.direction), corners);
                truth(&instance.in_object(&case.on(t_min, t_max))).hits_closed()
            }
            Way::VerticesByMatrix => {
                let placed = corners.map(|corner| instance.point_in_world(corner));
                let placed = placed.map(|corner| corner.map(|x| F::from_f64(f64::from(x))));
                let case = Case::<F>::new(ray.origin, ray.direction, placed);
                truth(&case.on(ray.t_min, ray.t_max)).hits_closed()
            }
        };
        hits == Some(false)
    }
}

/// The instance in f32, with its rounded inverse; none if that is not finite.
fn instance_of(part: &PlacedPart) -> Option<Instance<f32>> {
    Instance::new(part.matrix.map(|row| row.map(|x| x as f32)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle around x, 0.02 wide, a million away; its place in the world is exact in f64.
    fn far_triangle(x: f32) -> Mesh {
        let local = [[x - 0.01, 0.0, 0.0], [x + 0.01, 0.0, 0.0], [x, 1.0, 0.0]];
        let world = local.map(|[x, y, z]| [f64::from(x) + 1e6, f64::from(y), f64::from(z)]);
        Mesh {
            name: "far".to_owned(),
            positions_f32: world.map(|corner| corner.map(|x| x as f32)).to_vec(),
            positions_f64: world.to_vec(),
            triangles: vec![[0, 1, 2]],
            places: vec![1],
            has_lines: false,
            groups: 1,
            placed: vec![PlacedPart {
                matrix: [
                    [1.0, 0.0, 0.0, 1e6],
                    [0.0, 1.0, 0.0, 0.0],
                    [0.0, 0.0, 1.0, 0.0],
                ],
                first: 0,
                vertices: local.to_vec(),
            }],
            notes: Vec::new(),
            digest: String::new(),
        }
    }

    #[test]
    fn a_transform_loses_what_f32_rounds_off_the_face() {
        // The step of f32 is 1/16 out there.
        for (x, by_inverse, by_matrix) in [
            (0.0625, false, false),
            (0.0625 + 0.028, true, false),
            (0.0625 + 0.015, true, true),
        ] {
            let mesh = far_triangle(x);
            let ray = Ray::new([1e6 + f64::from(x), 0.25, 5.0], [0.0, 0.0, -1.0]);
            assert_eq!(Way::RayByInverse.loses(&mesh, &ray, 0), by_inverse, "{x}");
            assert_eq!(
                Way::VerticesByMatrix.loses(&mesh, &ray, 0),
                by_matrix,
                "{x}"
            );
        }
        // No matrix, no loss; and a matrix without inverse tells nothing.
        let mut mesh = far_triangle(0.0905);
        let ray = Ray::new([1e6 + 0.0905, 0.25, 5.0], [0.0, 0.0, -1.0]);
        mesh.placed[0].matrix[0][0] = 0.0;
        assert!(!Way::RayByInverse.loses(&mesh, &ray, 0));
        mesh.placed.clear();
        assert!(!Way::RayByInverse.loses(&mesh, &ray, 0));
    }
}
