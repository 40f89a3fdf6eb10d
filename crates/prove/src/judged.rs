//! A kernel's verdicts at some epsilons: how wrong they can be, the worst that is known, and scenes in which the
//! bounds of edge gates say something.

use super::depth::Judge;
use super::gates::Proof;
use super::summary::{Effort, Summary, Witness, format_of, worst};
use super::verdict::{Farthest, USELESS, Verdicts, supposes_weights, verdicts};
use super::witness::{Goal, Inputs, Searched};
use super::{Domain, Dyadic, Scene};
use crate::kernel::{Entry, Role, Scalar};

/// The verdicts of a kernel.
#[derive(Clone, Debug)]
pub struct Judged<F> {
    /// The bounds.
    pub verdicts: Verdicts,
    /// The deepest false miss and the farthest false hit that are known.
    pub known: [Option<Witness<F>>; 2],
    /// The known verdict that is farther off than its bound, if there is one: then the proof is wrong, or the search.
    pub contradiction: Option<String>,
}

/// The goals of the search, in the order of [`Judged::known`].
pub const VERDICTS: [Goal; 2] = [Goal::Missed, Goal::Hit];

impl<F: Searched + Scalar> Judged<F> {
    /// The verdicts of a kernel that is proved, in the domain or its parts.
    pub fn new(
        entry: &Entry,
        summary: &Summary<F>,
        epsilons: &[F],
        parts: &[Domain],
        (known, effort): (&[Inputs<F>], Effort),
    ) -> Option<Judged<F>> {
        let proof = &summary.proof;
        let domain = summary.domain;
        let is_wide = domain.measures.is_none() && supposes_weights(entry, proof);
        // Near the triangle, and anywhere.
        let wide = is_wide.then(|| {
            [Dyadic::ABOVE_ONE - Dyadic::ONE, Dyadic::ABOVE_ONE].map(|below| {
                let domain = Domain {
                    quotient: Dyadic::ABOVE_ONE,
                    below,
                    ..domain
                };
                Proof::of::<F>(entry, None, domain).ok()
            })
        });
        let [near, far] = wide.unwrap_or_default();
        let proofs = [
            proof,
            near.as_ref().unwrap_or(proof),
            far.as_ref().unwrap_or(proof),
        ];
        let floats: Vec<f64> = epsilons.iter().map(|x| x.to_f64()).collect();
        let verdicts = verdicts(entry, proofs, &floats, parts);
        let of_edges = || proof.of_edges(entry);
        let judge = Judge {
            gated: F::subject(entry)?.gated()?,
            epsilons,
            scales: verdicts.scales.iter().map(|(scale, _)| *scale).collect(),
        };
        let known = VERDICTS.map(|goal| {
            let bound = if goal == Goal::Missed {
                &verdicts.misses
            } else {
                &verdicts.hits
            };
            let found = of_edges().filter(|_| bound.is_ok()).filter_map(|quantity| {
                let effort = effort.shared(proof, quantity);
                worst::<F>((proof, quantity), goal, Some(&judge), known, effort)
            });
            let wrong = found.filter(|found| 0.0 < found.score);
            wrong.max_by(|a, b| a.score.total_cmp(&b.score))
        });
        let bounds = [
            ("false miss", &verdicts.misses),
            ("false hit", &verdicts.hits),
        ];
        let mut contradiction = None;
        for ((what, bound), known) in bounds.into_iter().zip(&known) {
            let (Ok(Farthest { share, .. }), Some(Witness { score, .. })) = (bound, known) else {
                continue;
            };
            if share * (1.0 + 1e-12) < *score {
                contradiction.get_or_insert(format!(
                    "a {what} is known {score:e} of an edge away, and {share:e} is its bound"
                ));
            }
        }
        Some(Judged {
            verdicts,
            known,
            contradiction,
        })
    }
}

/// True if the bounds of edge gates say something about false misses in a scene.
fn is_useful<F: Searched + Scalar>(entry: &Entry, scene: &Scene, epsilons: &[f64]) -> bool {
    let share = || {
        let domain = scene.domain().ok()?;
        let parts = scene.parts(&scene.shapes());
        let mut gates = entry.info.gates.iter();
        let edge = gates.position(|gate| gate.role == Role::Edge)?;
        let proof = Proof::of::<F>(entry, Some(edge), domain).ok()?;
        let proof = proof.split(&parts, format_of::<F>());
        verdicts(entry, [&proof; 3], epsilons, &parts).misses.ok()
    };
    share().is_some_and(|it| it.share < USELESS)
}

/// A sentence on the least changes of one number of a scene, in steps of two, or of the scalar, for which the bound of an edge
/// gates say something; none if there is none.
pub fn useful_scenes<F: Searched + Scalar>(
    entry: &Entry,
    scene: &Scene,
    epsilons: &[F],
) -> Option<String> {
    let epsilons: Vec<f64> = epsilons.iter().map(|x| x.to_f64()).collect();
    // The first factor from 2 to the most for which a changed scene is useful; greater ones are, too.
    let first = |most: f64, changed: &dyn Fn(f64) -> Scene| {
        let useful = |x: &f64| is_useful::<F>(entry, &changed(*x), &epsilons);
        let factors = std::iter::successors(Some(2.0), |x| Some(2.0 * x));
        let factors: Vec<f64> = factors.take_while(|x| *x <= most).collect();
        let found = factors.last().is_some_and(useful);
        found.then(|| factors[factors.partition_point(|x| !useful(x))])
    };
    let Scene {
        edge: [shortest, longest],
        coordinates,
        distance,
        grazing,
        shape,
        ..
    } = *scene;
    let mut all = Vec::new();
    if F::DIGITS == 24 && entry.scalars()[1] && is_useful::<f64>(entry, scene, &epsilons) {
        all.push("in f64".to_owned());
    }
    let larger = |x: f64| Scene {
        edge: [x * shortest, longest],
        ..*scene
    };
    // The triangles of a mesh are what they are.
    let most = if shape.is_none() {
        longest / shortest
    } else {
        1.0
    };
    let edges = first(most, &larger);
    all.extend(edges.map(|x| format!("with edges from {}", (x * shortest) as f32)));
    let nearer = |x: f64| Scene {
        coordinates: coordinates / x,
        distance: distance / x,
        ..*scene
    };
    all.extend(first(coordinates / longest, &nearer).map(|x| {
        let [coordinates, distance] = [coordinates, distance].map(|it| (it / x) as f32);
        format!(
            "with coordinates up to {coordinates} and origins up to {distance} from the vertices"
        )
    }));
    let steeper = |x: f64| Scene {
        grazing: x * grazing,
        ..*scene
    };
    let angle = first(90.0 / grazing, &steeper);
    all.extend(angle.map(|x| format!("for rays at {} degrees to the plane and more", x * grazing)));
    (!all.is_empty()).then(|| format!(" It is proved to be less {}.", all.join(", or ")))
}
