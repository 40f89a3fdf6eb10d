//! The epsilons at which a response is exact, and the cells between them.

use crate::arith::{Float, scale_by_power_of_two};

/// Cells to a power of two: their lower ends are 2^k·m with m = 64..127.
const PER_OCTAVE: usize = 64;

/// The edges of a response's cells, in order: 0, ±2^k·m for m = 64..127 over the scalar's whole
/// range, its largest numbers, +inf, and any marks.
#[derive(Clone, Debug)]
pub struct Axis<F> {
    edges: Vec<F>,
    /// By bin: how many edges lie in lower bins.
    starts: Vec<u32>,
}

impl<F: Float> Axis<F> {
    /// With these epsilons among the edges.
    pub fn new(marks: &[F]) -> Axis<F> {
        let largest = largest();
        let mut edges = vec![F::infinity(), largest, -largest, F::zero()];
        edges.extend(marks.iter().filter(|mark| mark.is_finite()));
        for exponent in F::MIN_EXPONENT..=F::MAX_EXPONENT {
            for m in PER_OCTAVE..2 * PER_OCTAVE {
                // What is no subnormal number rounds to another edge.
                let edge = F::from_f64(scale_by_power_of_two(m as f64, exponent - 6));
                edges.extend([edge, -edge]);
            }
        }
        edges.sort_by_key(|edge| edge.place());
        edges.dedup_by(|a, b| *a == *b);
        let mut starts = vec![0; 2 * half::<F>() + 1];
        for edge in &edges[..edges.len() - 1] {
            starts[bin(*edge)] += 1;
        }
        let mut below = 0;
        for start in &mut starts {
            below += std::mem::replace(start, below);
        }
        Axis { edges, starts }
    }

    /// All edges, in order; the last is +inf.
    pub fn edges(&self) -> &[F] {
        &self.edges
    }

    /// The number of edges at or below a number that is not NaN.
    #[inline]
    pub fn cell(&self, x: F) -> usize {
        if !x.is_finite() {
            return if x < F::zero() { 0 } else { self.edges.len() };
        }
        let mut cell = self.starts[bin(x)] as usize;
        while self.edges[cell] <= x {
            cell += 1;
        }
        cell
    }
}

/// The largest finite number.
pub(super) fn largest<F: Float>() -> F {
    F::infinity().offset_ulps(-1)
}

/// Bins on each side of zero.
fn half<F: Float>() -> usize {
    (F::MAX_EXPONENT - F::MIN_EXPONENT + 1) as usize * PER_OCTAVE
}

/// The bin of a finite number: in order, and with no edge but marks inside.
#[inline]
fn bin<F: Float>(x: F) -> usize {
    let x = x.to_f64();
    let bits = x.abs().to_bits();
    if bits == 0 {
        return half::<F>();
    }
    let (exponent, six_bits) = if bits >> 52 == 0 {
        let top = 63 - bits.leading_zeros();
        (top as i32 - 1074, bits << (52 - top) >> 46)
    } else {
        ((bits >> 52) as i32 - 1023, bits >> 46)
    };
    let place = (exponent - F::MIN_EXPONENT) as usize * PER_OCTAVE + (six_bits & 63) as usize + 1;
    if x < 0.0 { half::<F>() - place } else { half::<F>() + place }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;

    fn cells_are_what_a_search_finds<F: Float>() {
        let marks = ["1e-6", "-1e-6", "1e-45", "3.5"].map(|text| F::parse(text).unwrap());
        let axis = Axis::new(&marks);
        let mut draw = Draw::new("axis", 1, 0);
        let check = |x: F| {
            let searched = axis.edges().partition_point(|edge| *edge <= x);
            assert_eq!(axis.cell(x), searched, "{x}");
        };
        for _ in 0..100_000 {
            let x = F::from_bits(draw.bits());
            if !x.is_nan() {
                check(x);
            }
            let edge = axis.edges()[draw.below(axis.edges().len())];
            check(edge.offset_ulps(draw.integer(-1, 1)));
        }
        check(F::infinity());
        check(-F::infinity());
        check(-F::zero());
        assert!(marks.iter().all(|mark| axis.edges().contains(mark) || mark.is_zero()));
    }

    #[test]
    fn cells_are_what_a_search_finds_in_both_scalars() {
        cells_are_what_a_search_finds::<f32>();
        cells_are_what_a_search_finds::<f64>();
    }

    fn each_short_significand_is_an_edge_in_a_bin_of_its_own<F: Float>(bins: usize) {
        let axis = Axis::<F>::new(&[]);
        // Of at most seven bits, from the smallest number on.
        let of_exponent = |exponent: i32| 1 << (exponent - F::MIN_EXPONENT).min(6);
        let short: usize = (F::MIN_EXPONENT..=F::MAX_EXPONENT).map(of_exponent).sum();
        assert_eq!(axis.edges().len(), 2 * short + 4);
        assert!(axis.edges().windows(2).all(|pair| pair[0] < pair[1]));
        let short = &axis.edges()[1..2 * short + 2];
        assert!(short.windows(2).all(|pair| bin(pair[0]) < bin(pair[1])));
        let last = axis.edges()[short.len() + 1];
        assert!(last.is_finite() && !last.offset_ulps(1).is_finite());
        assert_eq!((axis.edges()[0], largest::<F>()), (-last, last));
        let ends = [-last, F::zero(), last].map(bin);
        assert_eq!((ends, half::<F>()), ([0, bins, 2 * bins], bins));
        // Of its neighbours, that which is farther from zero shares it.
        for edge in short.iter().filter(|edge| !edge.is_zero()) {
            let away = if *edge < F::zero() { -1 } else { 1 };
            let beside = edge.offset_ulps(away);
            let is_edge = || short.binary_search_by_key(&beside.place(), |x| x.place()).is_ok();
            assert!(bin(beside) == bin(*edge) || is_edge(), "{edge:e}");
            assert_ne!(bin(edge.offset_ulps(-away)), bin(*edge), "{edge:e}");
        }
    }

    #[test]
    fn each_short_significand_is_an_edge_in_a_bin_of_its_own_in_both_scalars() {
        // 64 for each power of two, from 2^-149 to 2^127 and from 2^-1074 to 2^1023.
        each_short_significand_is_an_edge_in_a_bin_of_its_own::<f32>(64 * 277);
        each_short_significand_is_an_edge_in_a_bin_of_its_own::<f64>(64 * 2098);
    }

    #[test]
    fn every_short_significand_is_an_edge() {
        let axis = Axis::<f32>::new(&[]);
        for (m, k) in [(64, 0), (127, 10), (65, -120), (97, -155), (64, -155), (1, -149)] {
            let edge = (f64::from(m) * 2f64.powi(k)) as f32;
            assert!(axis.edges().contains(&edge) && axis.edges().contains(&-edge), "{m} 2^{k}");
        }
        let axis = Axis::<f64>::new(&[]);
        for (m, k) in [(64, 0), (127, -1074), (65, -1074), (97, 900), (1, -1074), (3, -1073)] {
            let edge = scale_by_power_of_two(f64::from(m), k);
            assert!(axis.edges().contains(&edge) && axis.edges().contains(&-edge), "{m} 2^{k}");
        }
    }
}
