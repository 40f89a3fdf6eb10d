//! Scenes in which a bound on edges says something: each is proved before it is told.

use super::summary::{format_of, paths_of};
use super::{Proof, Scene, Searched};
use crate::kernel::{Entry, Scalar};

/// At a share of half of the way across a triangle and more a bound says nothing.
pub const USELESS: f64 = 0.5;

/// From an edge value, in so many powers of length, to a share of the way across a triangle; none if that depends on the
/// triangle.
pub fn share(length: i8, scene: Option<&Scene>) -> Option<f64> {
    match (length, scene) {
        (0, _) => Some(1.0),
        (2, Some(scene)) => {
            Some(1.0 / (scene.least_shape() * libm::sin(scene.grazing.to_radians())))
        }
        _ => None,
    }
}

/// True if the bound of an edge gate says something in a scene.
fn is_useful<F: Searched + Scalar>(entry: &Entry, gate: usize, scene: &Scene) -> bool {
    let bound = || {
        let (domain, format) = (scene.domain().ok()?, format_of::<F>());
        let proof = Proof::new(paths_of::<F>(entry).ok()?, Some(gate), domain, format);
        let proof = proof.split(&scene.parts(&scene.shapes()), format);
        proof.gate(gate)?.ok()?.bound.as_ref().ok().map(|bound| bound.error.to_f64())
    };
    let share = share(entry.info.gates[gate].dimension.length, Some(scene));
    bound().zip(share).is_some_and(|(bound, share)| bound * share < USELESS)
}

/// A sentence on the least changes of one number of a scene, in steps of two, or of the scalar, for which the bound of an edge
/// gate says something; empty if there is none.
pub fn useful_scenes<F: Searched + Scalar>(entry: &Entry, gate: usize, scene: &Scene) -> String {
    // The first factor from 2 to the most for which a changed scene is useful; greater ones are, too.
    let first = |most: f64, changed: &dyn Fn(f64) -> Scene| {
        let useful = |x: &f64| is_useful::<F>(entry, gate, &changed(*x));
        let factors = std::iter::successors(Some(2.0), |x| Some(2.0 * x));
        let factors: Vec<f64> = factors.take_while(|x| *x <= most).collect();
        let found = factors.last().is_some_and(useful);
        found.then(|| factors[factors.partition_point(|x| !useful(x))])
    };
    let Scene { edge: [shortest, longest], coordinates, distance, grazing, shape, .. } = *scene;
    let mut all = Vec::new();
    if F::DIGITS == 24 && entry.scalars()[1] && is_useful::<f64>(entry, gate, scene) {
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
    match all.is_empty() {
        true => String::new(),
        false => format!(" It is proved to be less {}.", all.join(", or ")),
    }
}
