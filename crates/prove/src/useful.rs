//! Scenes in which the bounds of edge gates say something: each is proved before it is told.

use super::summary::{format_of, paths_of};
use super::verdict::{USELESS, verdicts};
use super::{Proof, Scene, Searched};
use crate::kernel::{Entry, Role, Scalar};

/// True if the bounds of edge gates say something about false misses in a scene.
fn is_useful<F: Searched + Scalar>(entry: &Entry, scene: &Scene, epsilons: &[f64]) -> bool {
    let share = || {
        let (domain, format) = (scene.domain().ok()?, format_of::<F>());
        let parts = scene.parts(&scene.shapes());
        let edge = entry.info.gates.iter().position(|gate| gate.role == Role::Edge)?;
        let proof = Proof::new(paths_of::<F>(entry).ok()?, Some(edge), domain, format);
        let proof = proof.split(&parts, format);
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
    let Scene { edge: [shortest, longest], coordinates, distance, grazing, shape, .. } = *scene;
    let mut all = Vec::new();
    if F::DIGITS == 24 && entry.scalars()[1] && is_useful::<f64>(entry, scene, &epsilons) {
        all.push("in f64".to_owned());
    }
    let larger = |x: f64| Scene { edge: [x * shortest, longest], ..*scene };
    // The triangles of a mesh are what they are.
    let most = if shape.is_none() { longest / shortest } else { 1.0 };
    let edges = first(most, &larger);
    all.extend(edges.map(|x| format!("with edges from {}", (x * shortest) as f32)));
    let nearer = |x: f64| Scene { coordinates: coordinates / x, distance: distance / x, ..*scene };
    all.extend(first(coordinates / longest, &nearer).map(|x| {
        let [coordinates, distance] = [coordinates, distance].map(|it| (it / x) as f32);
        format!(
            "with coordinates up to {coordinates} and origins up to {distance} from the vertices"
        )
    }));
    let steeper = |x: f64| Scene { grazing: x * grazing, ..*scene };
    let angle = first(90.0 / grazing, &steeper);
    all.extend(angle.map(|x| format!("for rays at {} degrees to the plane and more", x * grazing)));
    (!all.is_empty()).then(|| format!(" It is proved to be less {}.", all.join(", or ")))
}
