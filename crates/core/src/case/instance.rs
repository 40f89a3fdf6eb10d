//! An instance: a triangle whose coordinates are those of an object, which a matrix puts into the world.

use super::{Case, Ray, Triangle, between_colons};
use crate::arith::{Exact, Float, Real, Triple, Vector};

/// Three rows of a matrix from an object to the world; the last column is the translation.
pub type Matrix<F> = [[F; 4]; 3];

/// A matrix of three rows, the last column of which is the translation, from an object to the world; and its inverse as
/// ray tracers have it, rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance<F> {
    matrix: Matrix<F>,
    inverse: Matrix<F>,
}

impl<F: Float> Instance<F> {
    /// None if the inverse that is computed in `F` is not finite.
    ///
    /// It is computed as glam's `Affine3::inverse` does: the cross products of the columns times the rounded 1/det, and
    /// the translation from that.
    pub fn new(matrix: Matrix<F>) -> Option<Instance<F>> {
        let [x, y, z, translation] = [0, 1, 2, 3].map(|column| matrix.map(|row| row[column]));
        let rows = [cross(y, z), cross(z, x), cross(x, y)];
        let scale = F::one() / dot(x, rows[0]);
        let inverse = rows.map(|row| {
            let [a, b, c] = row.map(|number| number * scale);
            [a, b, c, -dot([a, b, c], translation)]
        });
        let is_finite = inverse
            .as_flattened()
            .iter()
            .all(|number| number.is_finite());
        is_finite.then_some(Instance { matrix, inverse })
    }

    /// The instance of a matrix that has an inverse, exactly and as computed; else what is wrong with it.
    pub fn checked(matrix: Matrix<F>) -> Result<Instance<F>, String> {
        let is_finite = matrix
            .as_flattened()
            .iter()
            .all(|number| number.is_finite());
        if is_finite && exact_determinant(&matrix).is_zero() {
            return Err(format!(
                "the matrix is singular in {}: it has no inverse",
                F::NAME
            ));
        }
        Instance::new(matrix).ok_or_else(|| format!("its inverse is not finite in {}", F::NAME))
    }

    /// The matrix.
    pub fn matrix(&self) -> Matrix<F> {
        self.matrix
    }

    /// The same in `f64`, which holds its numbers exactly.
    pub fn widen(&self) -> Instance<f64> {
        let [matrix, inverse] =
            [self.matrix, self.inverse].map(|m| m.map(|row| row.map(F::to_f64)));
        Instance { matrix, inverse }
    }

    /// A point of the object in the world, rounded.
    pub fn point_in_world(&self, point: [F; 3]) -> [F; 3] {
        self.matrix
            .map(|[i, j, k, moved]| dot([i, j, k], point) + moved)
    }

    /// A normal of the object in the world, of any length, rounded: by the transposed inverse, which leaves it on its
    /// side of the triangle.
    pub fn normal_in_world(&self, normal: [F; 3]) -> [F; 3] {
        [0, 1, 2].map(|column| dot(self.inverse.map(|row| row[column]), normal))
    }

    /// The case whose ray, which was in the object, is brought to the world and rounded there.
    pub fn in_world(&self, case: &Case<F>) -> Case<F> {
        let [origin, direction, ..] = case.vectors();
        let direction = self
            .matrix
            .map(|[i, j, k, _]| dot([i, j, k], direction))
            .into();
        let ray = Ray {
            origin: self.point_in_world(origin).into(),
            direction,
            ..case.ray
        };
        Case { ray, ..*case }
    }

    /// Points of the object in the world, in an arithmetic that does not round.
    pub fn place<R: Real>(&self, points: [[F; 3]; 3], number: impl Fn(f64) -> R) -> [Triple<R>; 3] {
        let lift = |x: F| number(x.to_f64());
        points.map(|point| {
            let point = Triple::from(point.map(lift));
            self.matrix
                .map(|[i, j, k, moved]| Triple::from([i, j, k].map(lift)).dot(&point) + lift(moved))
                .into()
        })
    }

    /// True if it turns an object inside out.
    pub fn is_mirrored(&self) -> bool {
        exact_determinant(&self.matrix).is_sign_negative()
    }

    /// A ray of the world as the object has it, and the triangle, in an arithmetic that does not round; both as many
    /// times as large as the determinant of the matrix, which is the last, so that nothing is divided.
    pub fn lift<R: Real>(
        &self,
        case: &Case<F>,
        number: impl Fn(f64) -> R,
    ) -> (Ray<Triple<R>>, Triangle<Triple<R>>, R) {
        let column = |i: usize| Triple::from(self.matrix.map(|row| number(row[i].to_f64())));
        let [x, y, z] = [0, 1, 2].map(column);
        let rows = [y.cross(&z), z.cross(&x), x.cross(&y)];
        let determinant = x.dot(&rows[0]);
        let solved = |v: &Triple<R>| rows.each_ref().map(|row| row.dot(v)).into();
        let (ray, Triangle { a, b, c }) = case.widen().lift(&number);
        let origin = solved(&ray.origin.minus(&column(3)));
        let [a, b, c] = [a, b, c].map(|vertex| vertex.times(&determinant));
        (
            Ray {
                origin,
                direction: solved(&ray.direction),
                ..ray
            },
            Triangle { a, b, c },
            determinant,
        )
    }

    /// The case that a kernel gets for a ray of the world and a triangle of the object: the ray by the rounded inverse.
    pub fn in_object(&self, case: &Case<F>) -> Case<F> {
        let [origin, direction, a, b, c] = case.vectors();
        let origin = self
            .inverse
            .map(|[i, j, k, moved]| dot([i, j, k], origin) + moved);
        let direction = self.inverse.map(|[i, j, k, _]| dot([i, j, k], direction));
        Case::new(origin, direction, [a, b, c]).on(case.ray.t_min, case.ray.t_max)
    }
}

fn exact_determinant<F: Float>(matrix: &Matrix<F>) -> Exact {
    let [x, y, z] = [0, 1, 2]
        .map(|column| Triple::from(matrix.map(|row| Exact::from_f64(row[column].to_f64()))));
    x.dot(&y.cross(&z))
}

/// A matrix as case ids have it: twelve numbers, row by row.
pub(super) fn text(matrix: &Matrix<f64>) -> String {
    matrix
        .as_flattened()
        .iter()
        .map(|x| format!("{x:e}"))
        .collect::<Vec<_>>()
        .join(":")
}

/// A matrix of a case id.
pub(super) fn parsed(text: &str) -> Result<Matrix<f64>, String> {
    let numbers: [f64; 12] = between_colons(text)
        .ok_or_else(|| format!("'{text}' is no instance: write 12 numbers with : between them"))?;
    let (rows, _) = numbers.as_chunks();
    Ok([rows[0], rows[1], rows[2]])
}

fn cross<F: Float>([a, b, c]: [F; 3], [p, q, r]: [F; 3]) -> [F; 3] {
    [b * r - c * q, c * p - a * r, a * q - b * p]
}

fn dot<F: Float>([a, b, c]: [F; 3], [p, q, r]: [F; 3]) -> F {
    a * p + b * q + c * r
}

#[cfg(test)]
mod tests;
