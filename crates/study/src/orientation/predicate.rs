//! The table of predicates: plain determinants with an epsilon, and the crate robust's.

use super::{Answer, Dimension, Points};
use crate::arith::Float;
use robust::{Coord, Coord3D};

/// A predicate's determinant: its sign is the answer.
trait Formula {
    const NAME: &'static str;
    const DIMENSION: Dimension;
    fn determinant<F: Float>(points: &[[F; 3]; 4]) -> F;
}

/// (a-c)×(b-c), Shewchuk 1997, section 4.2, without its stages.
struct Plain2d;
/// `det(a-d, b-d, c-d)` by its column z, Shewchuk 1997, section 4.3, without its stages.
struct Plain3d;
/// Crate robust 1.2: Shewchuk's stages with the filter of Ozaki et al.
struct Robust2d;
/// Crate robust 1.2: Shewchuk's stages.
struct Robust3d;

impl Formula for Plain2d {
    const NAME: &'static str = "orient2d";
    const DIMENSION: Dimension = Dimension::Two;

    #[inline(always)]
    fn determinant<F: Float>(&[a, b, c, _]: &[[F; 3]; 4]) -> F {
        (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])
    }
}

impl Formula for Plain3d {
    const NAME: &'static str = "orient3d";
    const DIMENSION: Dimension = Dimension::Three;

    #[inline(always)]
    fn determinant<F: Float>(&[a, b, c, d]: &[[F; 3]; 4]) -> F {
        let [[adx, ady, adz], [bdx, bdy, bdz], [cdx, cdy, cdz]] =
            [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1], p[2] - d[2]]);
        adz * (bdx * cdy - cdx * bdy)
            + bdz * (cdx * ady - adx * cdy)
            + cdz * (adx * bdy - bdx * ady)
    }
}

impl Formula for Robust2d {
    const NAME: &'static str = "robust::orient2d";
    const DIMENSION: Dimension = Dimension::Two;

    #[inline(always)]
    fn determinant<F: Float>(&[a, b, c, _]: &[[F; 3]; 4]) -> F {
        let [a, b, c] = [a, b, c].map(|p| Coord { x: p[0].to_f64(), y: p[1].to_f64() });
        F::from_f64(robust::orient2d(a, b, c))
    }
}

impl Formula for Robust3d {
    const NAME: &'static str = "robust::orient3d";
    const DIMENSION: Dimension = Dimension::Three;

    #[inline(always)]
    fn determinant<F: Float>(&points: &[[F; 3]; 4]) -> F {
        let [a, b, c, d] = points.map(|p| {
            let [x, y, z] = p.map(F::to_f64);
            Coord3D { x, y, z }
        });
        F::from_f64(robust::orient3d(a, b, c, d))
    }
}

/// Computes the determinant of each of some points of a predicate's dimension.
#[doc(hidden)]
pub type Batch<F> = fn(&[Points<F>], &mut Vec<F>);

fn batch<T: Formula, F: Float>(cases: &[Points<F>], determinants: &mut Vec<F>) {
    determinants.clear();
    determinants.extend(cases.iter().map(|points| T::determinant(&points.coordinates)));
}

/// A row of the table of predicates.
pub struct Predicate {
    /// The name in tables.
    pub name: &'static str,
    /// Points of the plane or of space.
    pub dimension: Dimension,
    /// True if the predicate takes an epsilon; without one it is exact where it keeps its promise.
    pub takes_epsilon: bool,
    batch_f32: Option<Batch<f32>>,
    batch_f64: Batch<f64>,
}

const fn plain<T: Formula>() -> Predicate {
    Predicate {
        name: T::NAME,
        dimension: T::DIMENSION,
        takes_epsilon: true,
        batch_f32: Some(batch::<T, f32>),
        batch_f64: batch::<T, f64>,
    }
}

const fn only_f64<T: Formula>() -> Predicate {
    Predicate {
        name: T::NAME,
        dimension: T::DIMENSION,
        takes_epsilon: false,
        batch_f32: None,
        batch_f64: batch::<T, f64>,
    }
}

/// Every predicate, in the order of reports.
pub static PREDICATES: &[Predicate] =
    &[plain::<Plain2d>(), only_f64::<Robust2d>(), plain::<Plain3d>(), only_f64::<Robust3d>()];

/// The scalars that predicates run in.
pub trait Scalar: Float {
    /// A predicate in this scalar, if it runs in it.
    #[doc(hidden)]
    fn batch(predicate: &Predicate) -> Option<Batch<Self>>;
}

impl Scalar for f32 {
    fn batch(predicate: &Predicate) -> Option<Batch<f32>> {
        predicate.batch_f32
    }
}

impl Scalar for f64 {
    fn batch(predicate: &Predicate) -> Option<Batch<f64>> {
        Some(predicate.batch_f64)
    }
}

/// A predicate with its epsilon: a row of every table.
#[derive(Clone)]
pub struct Row {
    /// The predicate.
    pub predicate: &'static Predicate,
    /// Decimal text, rounded to the nearest number of the scalar; none if it takes none.
    pub epsilon: Option<String>,
}

impl Row {
    /// `orient2d (1e-6)`, `robust::orient2d`.
    pub fn label(&self) -> String {
        match &self.epsilon {
            Some(epsilon) => format!("{} ({epsilon})", self.predicate.name),
            None => self.predicate.name.to_owned(),
        }
    }

    /// True if the predicate runs in a scalar on points of a dimension.
    pub fn runs<F: Scalar>(&self, dimension: Dimension) -> bool {
        self.predicate.dimension == dimension && F::batch(self.predicate).is_some()
    }

    /// The epsilon in a scalar; 0 where there is none.
    pub fn epsilon<F: Float>(&self) -> F {
        self.epsilon.as_deref().and_then(F::parse).unwrap_or(F::zero())
    }

    /// The determinant as the predicate computes it, and its answer; none if it does not run here.
    pub fn answer<F: Scalar>(&self, points: &Points<F>) -> Option<(F, Answer)> {
        if !self.runs::<F>(points.dimension) {
            return None;
        }
        let mut determinants = Vec::with_capacity(1);
        F::batch(self.predicate)?(std::slice::from_ref(points), &mut determinants);
        let determinant = determinants[0];
        Some((determinant, Answer::of(determinant, self.epsilon())))
    }
}

/// Every predicate, those that take an epsilon once with each of these.
pub fn default_rows(epsilons: &[String]) -> Vec<Row> {
    let of = |predicate: &'static Predicate| -> Vec<Row> {
        if predicate.takes_epsilon {
            let with = |epsilon: &String| Row { predicate, epsilon: Some(epsilon.clone()) };
            epsilons.iter().map(with).collect()
        } else {
            vec![Row { predicate, epsilon: None }]
        }
    };
    PREDICATES.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_positive_in_every_predicate() {
        let two = Points::two([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
        let three = Points::three([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);
        let rows = default_rows(&["0".to_owned(), "1e-6".to_owned()]);
        let answers: Vec<(f64, Answer)> = rows
            .iter()
            .map(|row| row.answer(&two).or_else(|| row.answer(&three)).unwrap())
            .collect();
        assert_eq!(answers, vec![(1.0, Answer::Plus); 6]);
    }
}
