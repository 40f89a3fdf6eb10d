//! The five determinants whose signs decide a truth.

/// The determinants that decide a truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Determinant {
    /// U, V or W: the weight of vertex 0, 1 or 2.
    Weight(usize),
    /// D = d·((b-a)×(c-a)).
    D,
    /// T = (a-o)·((b-o)×(c-o)).
    T,
}

pub(super) type FloatPoint = [f64; 3];

/// The rows of a determinant first·(second × third): d or a point, and points from which a base is
/// subtracted. D and the weights have d first; from the a of T the base is subtracted too.
#[inline]
pub(super) fn rows<V>(determinant: Determinant, [o, d, a, b, c]: [V; 5]) -> [V; 4] {
    match determinant {
        Determinant::Weight(0) => [d, c, b, o],
        Determinant::Weight(1) => [d, a, c, o],
        Determinant::Weight(_) => [d, b, a, o],
        Determinant::D => [d, b, c, a],
        Determinant::T => [a, b, c, o],
    }
}

#[cfg(test)]
pub(super) const ALL: [Determinant; 5] = [
    Determinant::Weight(0),
    Determinant::Weight(1),
    Determinant::Weight(2),
    Determinant::D,
    Determinant::T,
];
