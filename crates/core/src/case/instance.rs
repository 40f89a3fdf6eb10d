//! An instance: a triangle whose coordinates are those of an object, which a matrix puts into the world.

use super::Case;
use crate::arith::Float;

/// A matrix of three rows, the last column of which is the translation, from an object to the world; and its inverse as
/// ray tracers have it, rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance<F> {
    matrix: [[F; 4]; 3],
    inverse: [[F; 4]; 3],
}

impl<F: Float> Instance<F> {
    /// None if the inverse that is computed in `F` is not finite.
    ///
    /// It is computed as glam's `Affine3::inverse` does: the cross products of the columns times the rounded 1/det, and
    /// the translation from that.
    pub fn new(matrix: [[F; 4]; 3]) -> Option<Instance<F>> {
        let [x, y, z, translation] = [0, 1, 2, 3].map(|column| matrix.map(|row| row[column]));
        let rows = [cross(y, z), cross(z, x), cross(x, y)];
        let scale = F::one() / dot(x, rows[0]);
        let inverse = rows.map(|row| {
            let [a, b, c] = row.map(|number| number * scale);
            [a, b, c, -dot([a, b, c], translation)]
        });
        let is_finite = inverse.as_flattened().iter().all(|number| number.is_finite());
        is_finite.then_some(Instance { matrix, inverse })
    }

    /// The matrix.
    pub fn matrix(&self) -> [[F; 4]; 3] {
        self.matrix
    }

    /// The case that a kernel gets for a ray of the world and a triangle of the object: the ray by the rounded inverse.
    pub fn in_object(&self, case: &Case<F>) -> Case<F> {
        let [origin, direction, a, b, c] = case.vectors();
        let origin = self.inverse.map(|[i, j, k, moved]| dot([i, j, k], origin) + moved);
        let direction = self.inverse.map(|[i, j, k, _]| dot([i, j, k], direction));
        Case::new(origin, direction, [a, b, c]).on(case.ray.t_min, case.ray.t_max)
    }
}

fn cross<F: Float>([a, b, c]: [F; 3], [p, q, r]: [F; 3]) -> [F; 3] {
    [b * r - c * q, c * p - a * r, a * q - b * p]
}

fn dot<F: Float>([a, b, c]: [F; 3], [p, q, r]: [F; 3]) -> F {
    a * p + b * q + c * r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ray_goes_by_the_inverse_as_glam_has_it() {
        let columns = [[0.3f32, -1.7, 0.2], [2.1, 0.4, -0.9], [0.1, 0.6, 1.3], [10.5, -3.25, 0.7]];
        let matrix = [0, 1, 2].map(|row| columns.map(|column| column[row]));
        let instance = Instance::new(matrix).unwrap();
        let affine = glam::Affine3::from_cols_array_2d(&columns).inverse();
        let case = Case::new(
            [1.1f32, 2.2, 3.3],
            [0.5, -0.25, 0.125],
            [[0.; 3], [1., 0., 0.], [0., 1., 0.]],
        );
        let case = case.on(0.5, 7.0);
        let found = instance.in_object(&case);
        let [origin, direction, ..] = found.vectors();
        let expected = affine.transform_point3(glam::Vec3::new(1.1, 2.2, 3.3)).to_array();
        assert_eq!(origin, expected);
        let expected = affine.transform_vector3(glam::Vec3::new(0.5, -0.25, 0.125)).to_array();
        assert_eq!(direction, expected);
        assert_eq!(
            (found.vectors()[3], found.ray.t_min, found.ray.t_max),
            ([1., 0., 0.], 0.5, 7.0)
        );
        assert_eq!(Instance::new([[1f32, 2., 3., 0.], [2., 4., 6., 0.], [0., 0., 1., 0.]]), None);
    }
}
