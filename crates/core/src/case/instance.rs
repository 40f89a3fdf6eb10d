//! An instance: a triangle whose coordinates are those of an object, which a matrix puts into the world.

use super::{Case, Ray, Triangle, between_colons};
use crate::arith::{Exact, Float, Real, Triple, Vector};

/// Three rows of an affine matrix; the last column is the translation.
pub type Matrix<F> = [[F; 4]; 3];

/// A matrix from an object to the world, and its inverse as ray tracers have it, rounded.
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
        let [x, y, z, translation] = columns(&matrix);
        let adjugate = [cross(y, z), cross(z, x), cross(x, y)];
        let scale = F::one() / dot(x, adjugate[0]);
        let inverse = adjugate.map(|row| {
            let [a, b, c] = row.map(|number| number * scale);
            let moved_back = -dot([a, b, c], translation);
            [a, b, c, moved_back]
        });
        is_finite(&inverse).then_some(Instance { matrix, inverse })
    }

    /// The instance of a matrix that has an inverse, exactly and as computed; else what is wrong with it.
    pub fn checked(matrix: Matrix<F>) -> Result<Instance<F>, String> {
        if is_finite(&matrix) && exact_determinant(&matrix).is_zero() {
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

    /// The instance in `f64`, which holds its numbers exactly.
    pub fn widen(&self) -> Instance<f64> {
        Instance {
            matrix: self.matrix.map(|row| row.map(F::to_f64)),
            inverse: self.inverse.map(|row| row.map(F::to_f64)),
        }
    }

    /// A point of the object in the world, rounded.
    pub fn point_in_world(&self, point: [F; 3]) -> [F; 3] {
        apply_to_point(&self.matrix, point)
    }

    /// A normal of the object in the world, of any length, rounded: by the transposed inverse, which leaves it on its
    /// side of the triangle.
    pub fn normal_in_world(&self, normal: [F; 3]) -> [F; 3] {
        let [x, y, z, _] = columns(&self.inverse);
        [dot(x, normal), dot(y, normal), dot(z, normal)]
    }

    /// The case whose ray, which was in the object, is brought to the world and rounded there.
    pub fn in_world(&self, case: &Case<F>) -> Case<F> {
        let [origin, direction, ..] = case.vectors();
        let ray = Ray {
            origin: self.point_in_world(origin).into(),
            direction: apply_to_direction(&self.matrix, direction).into(),
            ..case.ray
        };
        Case { ray, ..*case }
    }

    /// Points of the object in the world, in an arithmetic that does not round.
    pub fn place<R: Real>(&self, points: [[F; 3]; 3], number: impl Fn(f64) -> R) -> [Triple<R>; 3] {
        points.map(|point| {
            let in_object = lifted(point, &number);
            let in_world = self.matrix.map(|[x, y, z, moved]| {
                let row = lifted([x, y, z], &number);
                row.dot(&in_object) + number(moved.to_f64())
            });
            in_world.into()
        })
    }

    /// True if it mirrors an object, which turns its triangles' fronts to the back.
    pub fn is_mirrored(&self) -> bool {
        exact_determinant(&self.matrix).is_sign_negative()
    }

    /// A ray of the world as the object has it, the triangle, and the determinant of the matrix, in an arithmetic that does
    /// not round. Ray and triangle are both multiplied by the determinant, so that nothing is divided.
    pub fn lift<R: Real>(
        &self,
        case: &Case<F>,
        number: impl Fn(f64) -> R,
    ) -> (Ray<Triple<R>>, Triangle<Triple<R>>, R) {
        let [x, y, z, translation] = columns(&self.matrix).map(|column| lifted(column, &number));
        // The adjugate, which is the inverse times the determinant.
        let adjugate = [y.cross(&z), z.cross(&x), x.cross(&y)];
        let determinant = x.dot(&adjugate[0]);
        let (ray, triangle) = case.widen().lift(&number);
        let from_translation = ray.origin.minus(&translation);
        let in_object = Ray {
            origin: dots(&adjugate, &from_translation),
            direction: dots(&adjugate, &ray.direction),
            ..ray
        };
        let scaled = Triangle {
            a: triangle.a.times(&determinant),
            b: triangle.b.times(&determinant),
            c: triangle.c.times(&determinant),
        };
        (in_object, scaled, determinant)
    }

    /// The case that a kernel gets for a ray of the world and a triangle of the object: the ray by the rounded inverse.
    pub fn in_object(&self, case: &Case<F>) -> Case<F> {
        let [origin, direction, a, b, c] = case.vectors();
        let in_object = Case::new(
            apply_to_point(&self.inverse, origin),
            apply_to_direction(&self.inverse, direction),
            [a, b, c],
        );
        in_object.on(case.ray.t_min, case.ray.t_max)
    }
}

fn exact_determinant<F: Float>(matrix: &Matrix<F>) -> Exact {
    let [x, y, z, _] = columns(matrix);
    let exact = |column| lifted(column, Exact::from_f64);
    exact(x).dot(&exact(y).cross(&exact(z)))
}

/// The directions into which the object's axes are turned, and the translation.
fn columns<F: Float>(matrix: &Matrix<F>) -> [[F; 3]; 4] {
    [0, 1, 2, 3].map(|i| matrix.map(|row| row[i]))
}

/// A vector in another arithmetic.
fn lifted<F: Float, R: Real>(vector: [F; 3], number: impl Fn(f64) -> R) -> Triple<R> {
    vector.map(|x| number(x.to_f64())).into()
}

fn is_finite<F: Float>(matrix: &Matrix<F>) -> bool {
    let numbers = matrix.as_flattened();
    numbers.iter().all(F::is_finite)
}

fn apply_to_point<F: Float>(matrix: &Matrix<F>, point: [F; 3]) -> [F; 3] {
    matrix.map(|[x, y, z, moved]| dot([x, y, z], point) + moved)
}

/// A direction is not moved by the translation.
fn apply_to_direction<F: Float>(matrix: &Matrix<F>, direction: [F; 3]) -> [F; 3] {
    matrix.map(|[x, y, z, _]| dot([x, y, z], direction))
}

/// The product of each row with a vector.
fn dots<R: Real>(rows: &[Triple<R>; 3], vector: &Triple<R>) -> Triple<R> {
    rows.each_ref().map(|row| row.dot(vector)).into()
}

/// The text of a matrix in a case id: twelve numbers, row by row.
pub(super) fn text(matrix: &Matrix<f64>) -> String {
    let numbers = matrix.as_flattened();
    let words: Vec<String> = numbers.iter().map(|x| format!("{x:e}")).collect();
    words.join(":")
}

/// The matrix of a case id's text.
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
