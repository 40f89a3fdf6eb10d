//! A study of a scene as a record.

use super::record::*;
use super::words::set_by;
use crate::arith::Float;
use crate::case::{DirectionLength, Scene};
use crate::contract::Extent;
use crate::epsilon::scale_free_form;
use crate::epsilon::scene::{Costs, Kind, Knob, Limit, SceneStudy, Setting, Tried, fresh_seed};
use crate::kernel::Scalar;
use crate::mesh::Surface;
use crate::report::epsilon::shortest;
use crate::report::record::Rate;

/// The record of some studies of one scene.
pub fn scene_record(
    scene: &Scene,
    unit: &str,
    mesh: Option<&Surface>,
    costs: &Costs,
    seed: u64,
    count: u64,
    kernels: Vec<SceneKernelPart>,
) -> SceneRecord {
    SceneRecord {
        schema: SCENE_SCHEMA.to_owned(),
        scene: scene.to_string(),
        unit: unit.to_owned(),
        mesh: mesh.map(|surface| MeshPart {
            file: surface.file_name().to_owned(),
            digest: surface.mesh().digest.clone(),
            triangles: surface.mesh().triangles.len() as u64,
        }),
        unit_directions: scene.direction == DirectionLength::Unit,
        edge: scene.edge,
        seed,
        fresh_seed: fresh_seed(seed),
        count,
        costs: Kind::ALL.map(|kind| (kind.name().to_owned(), costs.of(kind))).into(),
        kernels,
    }
}

/// The record of a study of one kernel in one scalar.
pub fn kernel_part<F: Scalar>(setting: &Setting<'_, F>, study: &SceneStudy<F>) -> SceneKernelPart {
    let info = setting.row.entry.info;
    let knob_part = |knob: &Knob| {
        let dimension = knob.dimension(info.gates);
        KnobPart {
            name: knob.name(info.gates).to_owned(),
            is_gate: matches!(knob, Knob::Gate(_)),
            role: knob.role(info.gates).name().to_owned(),
            dimension: [dimension.length, dimension.direction],
            form: scale_free_form(dimension),
        }
    };
    let tried = study.tried.iter().map(tried_part).collect();
    let limits = study.limits.iter().map(|(limit, trials)| {
        let knob = setting.knobs[limit.knob];
        LimitPart {
            knob: limit.knob,
            count: limit.count,
            is_lower: limit.is_lower,
            value: limit.value.map(shortest),
            one_in: limit.one_in,
            fresh: limit.value.map(|_| Rate::new(*trials, true)),
            set_by: set_by(knob.role(info.gates), setting.counts[limit.count]).map(str::to_owned),
        }
    });
    SceneKernelPart {
        kernel: info.name.to_owned(),
        selector: setting.row.entry.selector(),
        scalar: F::NAME.to_owned(),
        contract: setting.row.contract.describe(),
        least_shape: setting.mesh.map(|mesh| mesh.least_shape::<F>()),
        takes_interval: setting.row.contract.extent == Extent::Interval,
        knobs: setting.knobs.iter().map(knob_part).collect(),
        counts: setting
            .counts
            .iter()
            .map(|count| CountPart {
                stratum: count.stratum.family().name.to_owned(),
                kind: count.kind.name().to_owned(),
            })
            .collect(),
        tried,
        limits: limits.collect(),
        conflicts: conflicts(study),
        relative: study.relative.as_ref().map(tried_part),
    }
}

/// Of each knob the highest limit from below and the lowest from above, where they do not meet.
fn conflicts<F: Scalar>(study: &SceneStudy<F>) -> Vec<ConflictPart> {
    let limits: Vec<&Limit<F>> = study.limits.iter().map(|(limit, _)| limit).collect();
    let strictest = |knob: usize, is_lower: bool| {
        let of_knob = limits.iter().enumerate();
        let of_knob = of_knob.filter(|(_, l)| l.knob == knob && l.is_lower == is_lower);
        // A limit that no value keeps is stricter than any.
        of_knob.max_by_key(|(_, limit)| {
            let place = limit.value.map_or(i64::MAX, |value| match is_lower {
                true => value.place(),
                false => -value.place(),
            });
            (place, usize::MAX - limit.count)
        })
    };
    let conflict = |knob: usize| {
        let ((lower, low), (upper, high)) = (strictest(knob, true)?, strictest(knob, false)?);
        let meet = |low: &Limit<F>, high: &Limit<F>| {
            low.value.zip(high.value).filter(|(low, high)| low <= high)
        };
        let same = |limit: &&Limit<F>| {
            let found = study.relative_limits.iter();
            found.clone().find(|other| other.knob == knob && other.count == limit.count)
        };
        if meet(low, high).is_some() {
            return None;
        }
        let scale_free = same(low).zip(same(high)).and_then(|(low, high)| meet(low, high));
        let scale_free = scale_free.map(|(low, high)| [shortest(low), shortest(high)]);
        Some(ConflictPart { lower, upper, scale_free })
    };
    (0..study.best.len()).filter_map(conflict).collect()
}

fn tried_part<F: Float>(tried: &Tried<F>) -> TriedPart {
    TriedPart {
        name: tried.name.clone(),
        epsilons: tried.epsilons.iter().map(|epsilon| shortest(*epsilon)).collect(),
        wrong: tried.wrong.iter().map(|trials| Rate::new(*trials, true)).collect(),
        cost: tried.cost,
    }
}
