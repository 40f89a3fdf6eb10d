//! How the right epsilons move when everything is made larger or smaller.

use super::advice::Trade;
use super::run::{Request, run};
use crate::audit::{Observer, Source};
use crate::case::Parameters;
use crate::kernel::Scalar;

/// The limits of a gate's epsilon where all positions are multiplied by a power of two.
#[derive(Clone, Debug)]
pub struct AtScale<F> {
    /// The exponent of two.
    pub exponent: i32,
    /// The last epsilon with no avoidable miss.
    pub misses_up_to: F,
    /// The first epsilon with no avoidable hit.
    pub hits_from: F,
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
        Source::Corpus(_) => None,
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
        let responses = run(request, &sources, observer);
        for (n, (gate, rows)) in request.gates.iter().zip(&mut gates).enumerate() {
            let trade = Trade::new(&request.row.entry.info.gates[*gate], n, &sources, &responses);
            let (misses_up_to, hits_from) = (trade.misses.limit, trade.hits.limit);
            rows.push(AtScale { exponent, misses_up_to, hits_from });
        }
    }
    gates
}

/// The epsilons that are best at every scale, if there are any.
pub fn common<F: Scalar>(rows: &[AtScale<F>]) -> Option<(F, F)> {
    let larger = |a: F, b: F| if a < b { b } else { a };
    let smaller = |a: F, b: F| if b < a { b } else { a };
    let low = rows.iter().map(|row| row.hits_from).reduce(larger)?;
    let high = rows.iter().map(|row| row.misses_up_to).reduce(smaller)?;
    (low <= high).then_some((low, high))
}

/// By which power of the scale a limit moves: the slope of log2 |limit| between two scales, if it
/// keeps its sign.
pub fn slope<F: Scalar>(first: (i32, F), last: (i32, F)) -> Option<f64> {
    let (a, b) = (first.1.to_f64(), last.1.to_f64());
    let usable = a * b.signum() > 0.0 && a.is_finite() && b.is_finite() && first.0 != last.0;
    usable.then(|| (b / a).abs().log2() / f64::from(last.0 - first.0))
}
