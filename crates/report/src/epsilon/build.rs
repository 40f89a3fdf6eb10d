//! A study of a scene as a record.

use super::numbers::shortest;
use super::record::*;
use super::words::set_by;
use crate::arith::Float;
use crate::audit::{Histogram, Source, Trials};
use crate::case::{DirectionLength, Scene};
use crate::contract::{Contract, Extent};
use crate::kernel::{Role, Scalar, Tunable};
use hairline_advice::epsilon::scale_free_form;
use hairline_advice::epsilon::{
    Costs, Curve, ERRORS_ONE_IN, Elsewhere, ErrorSums, Knob, KnobLimit, MaxError, OnFresh,
    ProvedValue, SceneStudy, Setting, StudiedRays, Tried, Value, WrongKind, fresh_seed,
};
use hairline_record::Rate;
use hairline_record::provenance_of;
use hairline_record::{Context, Record};

/// The record of some studies of one scene, each with the kernel's nanoseconds a ray.
pub fn scene_record(
    studied: &StudiedRays,
    costs: &Costs,
    max_error: Option<&MaxError>,
    seed: u64,
    count: u64,
    context: &Context,
    kernels: Vec<(SceneKernelPart, f64)>,
) -> SceneRecord {
    let mut provenance = provenance_of(context);
    for (part, nanoseconds) in &kernels {
        let times = provenance
            .kernel_nanoseconds
            .entry(part.scalar)
            .or_default();
        times.insert(part.kernel.clone(), *nanoseconds);
    }
    let StudiedRays {
        scene: of_scene,
        sources,
        flags,
        unit,
        mesh,
        ..
    } = studied;
    let scene = of_scene.clone().unwrap_or_default();
    let result = SceneResult {
        scene: of_scene.as_ref().map_or(String::new(), Scene::to_string),
        sources: sources.iter().map(Source::name).collect(),
        flags: flags.clone(),
        unit: (*unit).to_owned(),
        left_out: None,
        reach: reach(&scene),
        mesh: mesh
            .as_ref()
            .map(|mesh| mesh.surface())
            .map(|surface| MeshScenePart {
                path: surface.family().path().to_owned(),
                digest: surface.mesh().digest.clone(),
                triangles: surface.mesh().triangles.len() as u64,
            }),
        unit_directions: scene.direction == DirectionLength::Unit,
        edge: scene.edge,
        sine: scene.sine,
        aims_inside: scene.aims_inside,
        seed,
        fresh_seed: fresh_seed(seed),
        count,
        costs: WrongKind::ALL
            .map(|kind| named(kind.name(), costs.of(kind)))
            .into(),
        max_error: Value::ALL
            .into_iter()
            .filter_map(|value| Some(named(value.name(), max_error?.of(value)?)))
            .collect(),
        kernels: kernels.into_iter().map(|(part, _)| part).collect(),
    };
    Record::new(result, provenance)
}

/// The largest coordinate of a ray's start.
fn reach(scene: &Scene) -> f64 {
    scene.largest() + scene.distance[1]
}

fn named(name: &str, number: f64) -> NamedNumber {
    NamedNumber {
        name: name.to_owned(),
        number,
    }
}

/// The record of a study of one kernel in one scalar, which the user asked to judge by a contract.
pub fn kernel_part<F: Scalar>(
    setting: &Setting<'_, F>,
    contract: &Contract,
    study: &SceneStudy<F>,
    max_error: Option<&MaxError>,
) -> SceneKernelPart {
    let info = setting.row.entry.info;
    let knob_part = |knob: &Knob| {
        let gate = knob.gate(info.gates);
        let dimension = gate.dimension;
        let is_gate = matches!(knob, Knob::Gate(_));
        KnobPart {
            name: gate.name.to_owned(),
            is_gate,
            role: gate.role,
            refuses: is_gate.then(|| gate.refuses.to_owned()),
            printed: gate.printed.map(str::to_owned),
            dimension,
            form: scale_free_form(dimension),
        }
    };
    let tried_part = |tried| tried_part(tried, max_error.is_some());
    let tried = study.tried.iter().map(tried_part).collect();
    let limits = study.limits.iter().map(
        |OnFresh {
             bound: limit,
             wrong,
             price,
         }| {
            let knob = setting.knobs[limit.knob];
            KnobLimitPart {
                knob: limit.knob,
                count: limit.count,
                is_lower: limit.is_lower,
                value: limit.value.map(shortest),
                far: limit.far.map(shortest),
                is_unsure: limit.is_unsure(),
                one_in: limit.one_in,
                fresh: limit.value.map(|_| Rate::new(*wrong, true)),
                set_by: set_by(knob.gate(info.gates).role, setting.counts[limit.count])
                    .map(str::to_owned),
                price: price_part(*price),
            }
        },
    );
    SceneKernelPart {
        kernel: info.name.to_owned(),
        selector: setting.row.entry.selector(),
        scalar: F::NAME,
        rays: None,
        contract: setting.row.contract.describe(),
        contract_flag: (*contract != info.contract).then(|| contract.words(Some(&info.contract))),
        has_edge_epsilon: info
            .gates
            .iter()
            .any(|gate| gate.role == Role::Edge && gate.epsilon != Tunable::Fixed),
        spacing: F::from_f64(setting.scene.map_or(0.0, reach)).ulp().to_f64(),
        least_shape: setting.mesh.map(|mesh| mesh.least_shape::<F>()),
        takes_interval: setting.row.contract.extent == Extent::Interval,
        knobs: setting.knobs.iter().map(knob_part).collect(),
        others: setting
            .row
            .tuned()
            .filter(|(gate, _)| {
                !setting
                    .knobs
                    .iter()
                    .any(|knob| knob.gate(info.gates).name == gate.name)
            })
            .map(|(gate, text)| (gate.name.to_owned(), text.to_string()))
            .collect(),
        counts: setting.counts.to_vec(),
        is_accurate: max_error.map(|_| study.is_accurate),
        tried,
        limits: limits.collect(),
        proved: study.proved.iter().map(proved_part).collect(),
        curves: study.curves.iter().map(curve_part).collect(),
        conflicts: conflicts(study),
        relative: study.relative.as_ref().map(tried_part),
        segments: None,
        elsewhere: study.elsewhere.iter().map(plane_part).collect(),
    }
}

fn rates(trials: &[Trials]) -> Vec<Rate> {
    trials
        .iter()
        .map(|trials| Rate::new(*trials, true))
        .collect()
}

fn plane_part(found: &Elsewhere) -> PlanePart {
    PlanePart {
        plane: found.kind.to_string(),
        wrong: rates(&found.wrong),
    }
}

/// For each knob the highest limit from below and the lowest from above, where they do not meet.
fn conflicts<F: Scalar>(study: &SceneStudy<F>) -> Vec<ConflictPart> {
    let limits: Vec<&KnobLimit<F>> = study.limits.iter().map(|found| &found.bound).collect();
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
        let meet = |low: &KnobLimit<F>, high: &KnobLimit<F>| {
            low.value.zip(high.value).filter(|(low, high)| low <= high)
        };
        let same = |limit: &&KnobLimit<F>| {
            let found = study.relative_limits.iter();
            found
                .clone()
                .find(|other| other.knob == knob && other.count == limit.count)
                .filter(|other| limit.one_in <= other.one_in)
        };
        if meet(low, high).is_some() {
            return None;
        }
        let scale_free = same(low)
            .zip(same(high))
            .and_then(|(low, high)| meet(low, high));
        let scale_free = scale_free.map(|(low, high)| [shortest(low), shortest(high)]);
        Some(ConflictPart {
            lower,
            upper,
            scale_free,
        })
    };
    (0..study.best.len()).filter_map(conflict).collect()
}

fn price_part(price: Option<(usize, Trials)>) -> Option<PricePart> {
    price.map(|(count, trials)| PricePart {
        count,
        wrong: Rate::new(trials, true),
    })
}

fn proved_part<F: Float>(found: &OnFresh<ProvedValue<F>>) -> ProvedPart {
    let OnFresh {
        bound: proved,
        wrong,
        price,
    } = found;
    ProvedPart {
        knob: proved.knob,
        count: proved.count,
        is_lower: proved.is_lower,
        value: shortest(proved.value),
        fresh: Rate::new(*wrong, true),
        price: price_part(*price),
    }
}

fn curve_part<F: Float>(curve: &Curve<F>) -> CurvePart {
    let counts = curve.of.iter().zip(&curve.left).zip(&curve.hits);
    let count = |((of, left), hits): ((&u64, &u64), &Vec<u64>)| CurveCount {
        of: *of,
        refused_by_others: of - left,
        hits: hits.clone(),
    };
    CurvePart {
        values: curve.values.iter().map(|value| shortest(*value)).collect(),
        counts: counts.map(count).collect(),
    }
}

/// The errors of each count whose hits were measured.
fn error_parts(errors: &[ErrorSums]) -> Vec<ErrorPart> {
    let finite = |error: f64| error.is_finite().then_some(error);
    let part = |(count, value, sum): (usize, Value, &Histogram)| ErrorPart {
        count,
        value: value.name().to_owned(),
        hits: sum.count(),
        median: finite(sum.quantile(0.5)),
        most: finite(sum.quantile(1.0 - 1.0 / ERRORS_ONE_IN as f64)),
        worst: finite(sum.largest()),
    };
    let all = Value::ALL.into_iter().flat_map(|value| {
        let of_value = errors.iter().enumerate();
        of_value.map(move |(count, sums)| (count, value, &sums[value as usize]))
    });
    all.filter(|(.., sum)| 0 < sum.count()).map(part).collect()
}

fn tried_part<F: Float>(tried: &Tried<F>, is_limited: bool) -> TriedPart {
    let in_a_million = |share: f64| 1e6 * share;
    let interval = tried.holes.and_then(|holes| holes.interval);
    TriedPart {
        name: tried.name.clone(),
        epsilons: tried
            .epsilons
            .iter()
            .map(|epsilon| shortest(*epsilon))
            .collect(),
        wrong: rates(&tried.wrong),
        cost: tried.cost,
        holes_per_million: tried.holes.map(|holes| in_a_million(holes.share)),
        holes_interval: interval.map(|ends| [ends.low, ends.high].map(in_a_million)),
        doubles: rates(&tried.doubles),
        errors: error_parts(&tried.errors),
        exceeded: if is_limited {
            rates(&tried.exceeded)
        } else {
            Vec::new()
        },
    }
}
