//! The proofs of `prove` for the knobs in a scene: epsilons at which some wrong answers occur on no ray of the scene.

use super::knob::Knob;
use super::rays::{RayCount, Rays, WrongKind};
use super::trials::Setting;
use crate::arith::{Float, smallest_normal, three_digits};
use crate::audit::Row;
use crate::case::{DirectionLength, Scene};
use crate::engine;
use crate::family::Stratum;
use crate::kernel::{Role, Scalar};
use crate::prove::{self, Proof, Uses};

/// A value of a knob that is proved.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedValue<F> {
    /// The knob's place in the setting.
    pub knob: usize,
    /// The count's place in the setting.
    pub count: usize,
    /// True if it holds for the values at and above, false if for those at and below.
    pub is_lower: bool,
    /// The value.
    pub value: F,
}

/// The values that are proved for each knob; none in scenes whose directions have any length, nor where a proof
/// assumes more than the sizes of triangles and distances, nor for an edge's epsilon while that of another gate is not
/// studied: a crack could be that gate's.
pub fn proved<F: Scalar>(setting: &Setting<'_, F>) -> Vec<ProvedValue<F>> {
    let Some(scene) = setting.scene else {
        return Vec::new();
    };
    let is_unit = scene.direction == DirectionLength::Unit;
    // Else rounding moves vertices and starts by more than the room that the domain has for it.
    if !is_unit || setting.relative || scene.check_in::<F>().is_err() {
        return Vec::new();
    }
    let others_are_studied = studies_all_gates(setting.row, setting.knobs);
    let of_knob = |&(k, knob): &(usize, &Knob)| {
        let Knob::Gate(gate) = *knob else {
            return Vec::new();
        };
        let role = setting.row.entry.info.gates[gate].role;
        if role == Role::Edge && !others_are_studied {
            return Vec::new();
        }
        let is_lower = role == Role::Parallel;
        let decided = |count: &RayCount| {
            matches!(
                (role, count.rays, count.kind),
                (
                    Role::Parallel,
                    Rays::Stratum(Stratum::Parallel),
                    WrongKind::Hit
                ) | (
                    Role::Edge,
                    Rays::Stratum(Stratum::Edges | Stratum::Vertices),
                    WrongKind::Crack
                )
            )
        };
        let counts = setting
            .counts
            .iter()
            .enumerate()
            .filter(|(_, count)| decided(count));
        let places: Vec<usize> = counts.map(|(place, _)| place).collect();
        let bound = if places.is_empty() {
            None
        } else {
            bound(setting, scene, gate)
        };
        let Some(bound) = bound else {
            return Vec::new();
        };
        let value = beyond(bound, is_lower);
        places
            .into_iter()
            .map(|count| ProvedValue {
                knob: k,
                count,
                is_lower,
                value,
            })
            .collect()
    };
    let knobs: Vec<(usize, &Knob)> = setting.knobs.iter().enumerate().collect();
    engine::map(&knobs, of_knob).into_iter().flatten().collect()
}

/// True if all gates whose epsilon can be chosen are knobs: of those it is known which rays they refuse themselves.
fn studies_all_gates(row: &Row, knobs: &[Knob]) -> bool {
    let all = Knob::all(row);
    let mut gates = all.iter().filter(|knob| **knob != Knob::LeastT);
    gates.all(|gate| knobs.contains(gate))
}

/// Strictly beyond a bound, above it or below its negative, in few digits.
fn beyond<F: Float>(bound: f64, is_above: bool) -> F {
    let size = (bound * (1.0 + 1e-9)).max(smallest_normal::<F>());
    let beyond = F::from_f64(size).offset_ulps(1);
    three_digits(if is_above { beyond } else { -beyond }, is_above)
}

/// The largest error of what a gate compares with its epsilon in a scene.
fn bound<F: Scalar>(setting: &Setting<'_, F>, scene: &Scene, gate: usize) -> Option<f64> {
    let domain = proved_scene(scene)?.domain().ok()?;
    let proof = Proof::of::<F>(setting.row.entry, Some(gate), domain).ok()?;
    let bound = proof.gate(gate)?.ok()?.bound.as_ref().ok()?.error.to_f64();
    let uses = Uses::of(
        proof
            .quantities
            .iter()
            .flat_map(|quantity| &quantity.lemmas),
    );
    let is_margin = proof.quantities.iter().all(|quantity| quantity.is_margin);
    (is_margin && !uses.floor && !uses.extent).then_some(bound)
}

/// The scene, and slightly more: rounding moves vertices, triangles to which rays are parallel may be half as
/// large, and a ray starts farther from a triangle's vertices than from its target.
fn proved_scene(scene: &Scene) -> Option<prove::Scene> {
    let [shortest, longest] = scene.edge;
    let [nearest, farthest] = scene.distance;
    // Rounding moves a vertex by less than a 32nd of the shortest edge.
    let edge = [shortest / 2.5, longest + shortest / 16.0];
    let distance = [nearest, farthest + 2.5 * longest];
    prove::Scene::of(&Scene {
        edge,
        distance,
        extent: scene.extent + 2.0 * longest,
        ..scene.clone()
    })
    .ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_proved_value_is_strictly_beyond_its_bound() {
        assert_eq!(
            [true, false].map(|above| beyond::<f32>(1.0, above)),
            [1.01, -1.01]
        );
        assert_eq!(
            [true, false].map(|above| beyond::<f64>(1.234, above)),
            [1.24, -1.24]
        );
        // The float before 1.01 is beyond the one before itself.
        let before = f64::from(1.01f32.next_down()) * (1.0 - 1e-9);
        assert_eq!(beyond::<f32>(before, true), 1.01);
        assert_eq!(beyond::<f32>(f64::from(1.01f32) * (1.0 - 1e-9), true), 1.02);
        // What is off by less than 1e-9 of itself may be the bound.
        assert_eq!(beyond::<f64>(1.01 * (1.0 - 5e-10), true), 1.02);
        assert_eq!(beyond::<f64>(1.01 * (1.0 - 2e-9), true), 1.01);
        // No smaller than the normal numbers.
        assert_eq!(beyond::<f32>(1e-45, true), 1.18e-38);
    }

    #[test]
    fn what_is_proved_holds_for_a_larger_scene() {
        let (scene, _) = Scene::parse("extent=8,edge=0.5..4,distance=1..16").unwrap();
        let edge = [0.5 / 2.5, 4.0 + 0.5 / 16.0];
        let expected = Scene {
            extent: 8.0 + 8.0,
            edge,
            distance: [1.0, 16.0 + 10.0],
            ..scene.clone()
        };
        let (found, expected) = (
            proved_scene(&scene).unwrap(),
            prove::Scene::of(&expected).unwrap(),
        );
        assert_eq!(
            (found.coordinates, found.edge, found.distance, found.shape),
            (
                expected.coordinates,
                expected.edge,
                expected.distance,
                expected.shape
            )
        );
    }
}
