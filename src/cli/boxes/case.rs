//! A box and a ray by name: the id of a family's case, a published case, or JSON.

use super::published;
use super::written::{AnyBoxCase, WrittenCase};
use crate::cli::exit::Failure;
use hairline_boxes::{Made, Source, case_of};
use hairline_core::ScalarName;
use hairline_core::case::CaseId;

/// The name of a case: its id, or if it has none the case in JSON.
pub fn name<F: Made>(source: &Source, seed: u64, index: u64) -> String {
    match source {
        Source::Family(family) => family.id::<F>(seed, index).to_string(),
        Source::Scene(_) | Source::Mesh(_) => source.case::<F>(seed, index).json(),
    }
}

/// The case of a name.
pub fn case_named(name: &str) -> Result<AnyBoxCase, Failure> {
    if name.trim_start().starts_with('{') {
        let parsed: Result<WrittenCase, _> = serde_json::from_str(name);
        let case = parsed.map_err(|error| {
            let fields = "scalar, origin, direction, min, max, and t_min and t_max if it has them";
            Failure::usage(format!("the case in JSON: {error}; expected {fields}"))
        })?;
        return Ok(case.read());
    }
    if let Some(published) = name.strip_prefix('@') {
        return Ok(published::find(published)?.case.read());
    }
    let id: CaseId = name.parse().map_err(|error| {
        let message = format!(
            "{error}; expected an id as corner@1/f32/-/1/17, a published case as @bvh-107, or JSON as \
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
