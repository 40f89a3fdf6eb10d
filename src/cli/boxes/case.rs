//! A box and a ray by name: the id of a family's case, or JSON.

use crate::arith::ScalarName;
use crate::cli::exit::Failure;
use hairline_boxes::{BoxCase, Made, Source, case_of};
use hairline_core::Float;
use hairline_core::case::CaseId;
use serde::{Deserialize, Serialize};

/// A case of either scalar.
pub enum AnyBoxCase {
    F32(BoxCase<f32>),
    F64(BoxCase<f64>),
}

/// A case in JSON. Numbers are the nearest doubles; those of `f32` are rounded once more, which leaves a float alone.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCase {
    scalar: ScalarName,
    origin: [f64; 3],
    direction: [f64; 3],
    min: [f64; 3],
    max: [f64; 3],
    #[serde(default)]
    t_min: f64,
    /// Infinite if it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    t_max: Option<f64>,
}

/// The name of a case: its id, or if it has none the case in JSON.
pub fn name<F: Made>(source: &Source, seed: u64, index: u64) -> String {
    match source {
        Source::Family(family) => family.id::<F>(seed, index).to_string(),
        Source::Scene(_) => written(&source.case::<F>(seed, index)),
    }
}

/// A case in JSON.
fn written<F: Made>(case: &BoxCase<F>) -> String {
    let wide = case.widen();
    let [origin, direction, min, max] = wide.vectors();
    let t_max = wide.ray.t_max;
    let written = WrittenCase {
        scalar: F::NAME,
        origin,
        direction,
        min,
        max,
        t_min: wide.ray.t_min,
        t_max: t_max.is_finite().then_some(t_max),
    };
    serde_json::to_string(&written).unwrap_or_default()
}

/// The case of a name.
pub fn case_named(name: &str) -> Result<AnyBoxCase, Failure> {
    if name.trim_start().starts_with('{') {
        let parsed: Result<WrittenCase, _> = serde_json::from_str(name);
        let case = parsed.map_err(|error| {
            let fields = "scalar, origin, direction, min, max, and t_min and t_max if it has them";
            Failure::usage(format!("the case in JSON: {error}; expected {fields}"))
        })?;
        return Ok(match case.scalar {
            ScalarName::F32 => AnyBoxCase::F32(read(&case)),
            ScalarName::F64 => AnyBoxCase::F64(read(&case)),
        });
    }
    let id: CaseId = name.parse().map_err(|error| {
        let message = format!(
            "{error}; expected an id as corner@1/f32/-/1/17, or JSON as \
             {{\"scalar\":\"f32\",\"origin\":[2,0,1],\"direction\":[-1,1,0],\"min\":[0,0,0],\"max\":[1,1,1]}}"
        );
        Failure::usage(message)
    })?;
    let wrong = |message: String| Failure::usage(format!("'{name}': {message}"));
    match id.scalar {
        ScalarName::F32 => case_of(&id).map(AnyBoxCase::F32).map_err(wrong),
        ScalarName::F64 => case_of(&id).map(AnyBoxCase::F64).map_err(wrong),
    }
}

fn read<F: Float>(case: &WrittenCase) -> BoxCase<F> {
    let vector = |numbers: [f64; 3]| numbers.map(F::from_f64);
    let corners = [vector(case.min), vector(case.max)];
    let t_max = case.t_max.unwrap_or(f64::INFINITY);
    BoxCase::new(vector(case.origin), vector(case.direction), corners)
        .on(F::from_f64(case.t_min), F::from_f64(t_max))
}
