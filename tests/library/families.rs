//! Each family keeps its promise, and the fast oracle agrees with the definition on its cases.

use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::{FAMILIES, Family, STRATA};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle;
use hairline::internals::truth::Truth;

fn check<F: Scalar>(family: &Family, count: u64) {
    for index in 0..count {
        let made = family.make::<F>(&Parameters::default(), 1, index);
        let truths: Vec<Truth> = made.cases().iter().map(oracle::truth).collect();
        let id = family.id::<F>(&Parameters::default(), 1, index);
        assert!(family.keeps(&truths), "{id} breaks its promise: {truths:?} {made:?}");
        if index < count / 10 {
            for (case, truth) in made.cases().iter().zip(&truths) {
                assert_eq!(*truth, oracle::define(case).truth, "{id}: {case:?}");
            }
        }
    }
}

#[test]
fn every_family_keeps_its_promise_in_f32() {
    FAMILIES.iter().for_each(|family| check::<f32>(family, 3000));
}

#[test]
fn every_family_keeps_its_promise_in_f64() {
    FAMILIES.iter().for_each(|family| check::<f64>(family, 3000));
}

/// The weights of a, b and c where a line meets the plane of a triangle, rounded in `f64`.
fn weights(case: &Case<f32>) -> Option<[f64; 3]> {
    let [o, d, corners @ ..] = case.vectors().map(|v| v.map(f64::from));
    let [a, b, c] = corners.map(|p| [0, 1, 2].map(|i| p[i] - o[i]));
    let triple = |p: [f64; 3], q: [f64; 3]| -> f64 {
        let cross = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            p[j] * q[k] - p[k] * q[j]
        });
        (0..3).map(|i| d[i] * cross[i]).sum()
    };
    let weights = [triple(c, b), triple(a, c), triple(b, a)];
    let sum: f64 = weights.iter().sum();
    let weights = weights.map(|weight| weight / sum);
    weights.iter().all(|weight| weight.is_finite()).then_some(weights)
}

/// The place of the one smallest number, if it is clearly the smallest.
fn least(numbers: [f64; 3]) -> Option<usize> {
    let place = (0..3).min_by(|i, j| numbers[*i].total_cmp(&numbers[*j]))?;
    let is_clear = |i: usize| i == place || numbers[place] + 1e-6 < numbers[i];
    (0..3).all(is_clear).then_some(place)
}

/// Kernels do not treat a, b and c alike, so no family may: whichever corner a line passes nearest to, and whichever
/// edge, each is as likely as the others, in the first triangle of a group and in the second.
#[test]
fn no_family_prefers_a_corner_or_an_edge() {
    // Of these the polygon's triangles are the fan of its first vertex, which is what it is; the lattice is everything
    // there is; the others have no weights.
    let left_out = ["polygon", "lattice", "parallel-off", "coplanar", "degenerate", "invalid"];
    let has_weights =
        |family: &&Family| !left_out.contains(&family.name) && family.name != "scene-parallel";
    for family in FAMILIES.iter().chain(STRATA).filter(has_weights) {
        let mut counts = [[[0u32; 3]; 2]; 2];
        for index in 0..4000 {
            let made = family.make::<f32>(&Parameters::default(), 1, index);
            for (counts, case) in counts.iter_mut().zip(made.cases()) {
                let Some(weights) = weights(case) else { continue };
                let nearest = [weights.map(|weight| -weight), weights.map(f64::abs)].map(least);
                for (counts, place) in counts.iter_mut().zip(nearest) {
                    place.into_iter().for_each(|place| counts[place] += 1);
                }
            }
        }
        for counts in counts.as_flattened() {
            let all: u32 = counts.iter().sum();
            let is_even =
                |count: &u32| (0.29..0.38).contains(&(f64::from(*count) / f64::from(all)));
            // A vertex is as near to both of its edges.
            assert!(all < 400 || counts.iter().all(is_even), "{}: {counts:?}", family.name);
        }
    }
}
