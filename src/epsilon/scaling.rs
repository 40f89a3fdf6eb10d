//! How the right epsilons move when everything is made larger or smaller.

use super::advice::{Side, Trade};
use super::duty::Duty;
use super::run::{Request, run};
use crate::audit::{Observer, Source};
use crate::case::Parameters;
use crate::kernel::Scalar;

/// The limits of a gate's epsilon where all positions are multiplied by a power of two.
#[derive(Clone, Debug)]
pub struct AtScale<F> {
    /// The exponent of two.
    pub exponent: i32,
    /// The last epsilon with no avoidable miss; none if no case sets one.
    pub misses_up_to: Option<F>,
    /// The first epsilon with no avoidable false hit; none if no case sets one.
    pub hits_from: Option<F>,
    /// Of the cases that must be hit, those missed at every epsilon, and how many there are.
    pub missed_anyway: (u64, u64),
}

impl<F: Scalar> AtScale<F> {
    /// The limits of a trade.
    pub fn new(exponent: i32, trade: &Trade<F>) -> AtScale<F> {
        let limit = |side: &Side<F>| side.decided_by.map(|_| side.limit);
        AtScale {
            exponent,
            misses_up_to: limit(&trade.misses),
            hits_from: limit(&trade.hits),
            missed_anyway: (trade.misses.unavoidable, trade.misses.curve.total),
        }
    }
}

/// The sources with their positions multiplied by a further power of two; stored cases stay out.
pub fn scaled(sources: &[Source], exponent: i32, most: u64) -> Vec<Source> {
    let further = |parameters: &Parameters| Parameters {
        scale: parameters.scale + exponent,
        ..parameters.clone()
    };
    let scaled = |source: &Source| match source {
        Source::Family { family, parameters, seed, count, .. } => Some(Source::Family {
            family,
            parameters: further(parameters),
            seed: *seed,
            count: (*count).min(most),
            exhaustive: false,
        }),
        Source::Mesh { family, parameters, seed, count } => Some(Source::Mesh {
            family: family.clone(),
            parameters: further(parameters),
            seed: *seed,
            count: (*count).min(most),
        }),
        Source::MeshPart { .. } | Source::SceneMesh { .. } | Source::Corpus(_) => None,
    };
    sources.iter().filter_map(scaled).collect()
}

/// The limits of each gate of a request, at each scale: `[gate][scale]`.
pub fn at_scales<F: Scalar>(
    request: &Request<'_, F>,
    sources: &[Source],
    exponents: &[i32],
    most: u64,
    observer: &dyn Observer,
) -> Vec<Vec<AtScale<F>>> {
    let mut gates: Vec<Vec<AtScale<F>>> = request.gates.iter().map(|_| Vec::new()).collect();
    for &exponent in exponents {
        let sources = scaled(sources, exponent, most);
        if sources.is_empty() {
            break;
        }
        let responses = run(request, &sources, observer);
        for (n, (gate, rows)) in request.gates.iter().zip(&mut gates).enumerate() {
            let gates = request.row.entry.info.gates;
            let duty = Duty::of(gates, *gate, &request.row.contract);
            let trade = Trade::new(&gates[*gate], &duty, n, &sources, &responses);
            rows.push(AtScale::new(exponent, &trade));
        }
    }
    gates
}

/// The epsilons that are best at every scale, if there are any: from and to, each none if no case
/// sets it.
pub fn common<F: Scalar>(rows: &[AtScale<F>]) -> Option<(Option<F>, Option<F>)> {
    let larger = |a: F, b: F| if a < b { b } else { a };
    let smaller = |a: F, b: F| if b < a { b } else { a };
    let low = rows.iter().filter_map(|row| row.hits_from).reduce(larger);
    let high = rows.iter().filter_map(|row| row.misses_up_to).reduce(smaller);
    let meet = low.zip(high).is_none_or(|(low, high)| low <= high);
    meet.then_some((low, high))
}

/// By which power of the scale a limit moves: the slope of log2 |limit| between two scales, if it
/// keeps its sign.
pub fn slope<F: Scalar>(first: (i32, F), last: (i32, F)) -> Option<f64> {
    let (a, b) = (first.1.to_f64(), last.1.to_f64());
    let one_sign = (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0);
    let usable = one_sign && a.is_finite() && b.is_finite() && first.0 != last.0;
    usable.then(|| (b.abs().log2() - a.abs().log2()) / f64::from(last.0 - first.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_powers_and_need_two_limits_of_one_sign() {
        assert_eq!(slope((-10, 1.0f32), (10, 16.0)), Some(0.2));
        assert_eq!(slope((0, 1.0e-16f64), (1, 5e-324)).map(f64::is_finite), Some(true));
        assert_eq!(slope((0, -1.0f32), (2, -16.0)), Some(2.0));
        for (a, b) in [(0.0f32, 1.0), (1.0, 0.0), (-1.0, 1.0), (1.0, f32::INFINITY)] {
            assert_eq!(slope((0, a), (1, b)), None, "{a} {b}");
        }
    }

    #[test]
    fn what_no_case_sets_limits_nothing() {
        let row = |misses_up_to, hits_from| AtScale::<f32> {
            exponent: 0,
            misses_up_to,
            hits_from,
            missed_anyway: (0, 1),
        };
        let open = row(None, None);
        assert_eq!(
            common(&[open.clone(), row(Some(2.0), Some(1.0))]),
            Some((Some(1.0), Some(2.0)))
        );
        assert_eq!(common(&[row(Some(2.0), None), row(None, Some(3.0))]), None);
        assert_eq!(common(&[open]), Some((None, None)));
    }
}
