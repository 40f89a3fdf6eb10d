//! The cases that maps are made of when none is named: near an edge, near a vertex, grazing.

use super::{CaseVector, Map, grid_of_case, of_kernel};
use crate::arith::Float;
use crate::audit::Row;
use crate::case::Case;
use crate::engine::Unobserved;
use crate::kernel::Scalar;
use hairline_core::Error;

named! {
    pub names
    /// Where a standard case lies. All coordinates are short decimals, rounded to the scalar.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Spot {
        /// The ray crosses the plane on an edge, not far from a vertex.
        Edge = "edge",
        /// The ray crosses the plane at a vertex.
        Vertex = "vertex",
        /// The ray crosses an edge at a small angle to the plane.
        Grazing = "grazing",
    }
}

impl Spot {
    /// The case.
    pub fn case<F: Float>(self) -> Case<F> {
        let (origin, direction, triangle) = match self {
            // Onto (0.5, 0.5, -0.125) of the edge ab. Points of which one lies near 0.5 and the others
            // far off on a line with it are those of Kettner et al.
            Spot::Edge => (
                [0.625, 0.75, 0.875],
                [-0.125, -0.25, -1.0],
                [[-12.0, -12.0, 3.0], [24.0, 24.0, -6.0], [-12.0, 24.0, 1.0]],
            ),
            // Onto c.
            Spot::Vertex => (
                [0.625, 0.75, 0.875],
                [-0.125, -0.25, -1.0],
                [[24.0, 12.0, 3.0], [12.0, 24.0, -2.0], [0.5, 0.5, -0.125]],
            ),
            // Onto (0.5, 0.5, -0.125) of the edge ab: in the plane but for 2^-10 along z.
            Spot::Grazing => (
                [0.75, 0.625, -0.1787109375],
                [-0.25, -0.125, 0.0537109375],
                [[-12.0, -12.0, 3.0], [24.0, 24.0, -6.0], [-12.0, 20.0, 1.0]],
            ),
        };
        let float = |p: [f64; 3]| p.map(F::from_f64);
        Case::new(float(origin), float(direction), triangle.map(float))
    }
}

/// The map of a row about a standard case: its ray's origin varied float by float, in the two
/// coordinates that lie most in the triangle's plane. `size` in pixels: to the right, and upwards.
pub fn standard<F: Scalar>(row: &Row, spot: Spot, size: [usize; 2]) -> Result<Map, Error> {
    let case = spot.case::<F>();
    let grid = grid_of_case(&case, CaseVector::Origin, None, None, size)?;
    of_kernel(&case, row, &grid, &Unobserved)
}
