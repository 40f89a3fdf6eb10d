//! A case that changed between two runs over the same cases, from the digests of what was wrong in each.

use crate::audit::Digest;
use crate::case::{Case, CaseId, Parameters};
use crate::family;
use crate::kernel::Scalar;
use hairline_core::ScalarName;
use hairline_record::{Example, Key, ResultPart};

/// The change of a case.
#[derive(Clone, Copy, PartialEq)]
pub enum CaseChange {
    /// It shows a finding, and did not.
    New,
    /// It showed a finding, and no longer shows that one.
    Right,
}

impl CaseChange {
    /// The note on a case that is shown, if one is: whether it changed, as far as the digests tell.
    pub fn note(self, is_changed: bool, is_shown: bool) -> &'static str {
        match (self, is_changed) {
            (CaseChange::New, true) => "; the case shown is new",
            (CaseChange::Right, true) => "; the case shown no longer shows it",
            (CaseChange::New, false) if is_shown => "; the case shown may have failed before",
            _ => "",
        }
    }
}

/// A case of a class that changed, if the digests of what was wrong before and of what is wrong now tell one; nothing was wrong
/// where there is none. `example` is another of the class, shown again by a command like its.
pub fn changed_case(
    result: &ResultPart,
    key: &Key,
    example: &Example,
    change: CaseChange,
    digests: [Option<&str>; 2],
) -> Option<Example> {
    let [before, now] = digests.map(|digest| match digest {
        None => Some(Digest::default()),
        Some(text) => Digest::try_from(text.to_owned()).ok(),
    });
    let (before, now) = (before?, now?);
    let (has, has_not) = match change {
        CaseChange::New => (now, before),
        CaseChange::Right => (before, now),
    };
    // The place of a stored case does not tell its name, which may be another case's id.
    if key.family.starts_with("corpus:") {
        return None;
    }
    let is_source = |scalar: ScalarName, family: &str| scalar == key.scalar && family == key.family;
    let source = result
        .sources
        .iter()
        .find(|source| is_source(source.scalar, &source.family))?;
    let place = has.beyond(&has_not, source.indices).min()?;
    let mut id: CaseId = example.case.parse().ok()?;
    // Of a family of single cases another triangle is none: several places were taken for one.
    if id.triangle.is_none() && place.triangle != 0 {
        return None;
    }
    (id.index, id.triangle) = (place.index, id.triangle.map(|_| place.triangle as usize));
    let case = id.to_string();
    let Parameters {
        mesh,
        scene,
        instance,
        ..
    } = &id.parameters;
    let is_plain = mesh.is_none() && scene.is_none() && instance.is_none();
    let is_of_cases = !example.bits.is_empty() && is_plain;
    let bits = is_of_cases
        .then(|| in_named_scalar!(id.scalar, F => bits::<F>(&id)))
        .flatten();
    Some(Example {
        command: example.command.replace(&example.case, &case),
        bits: bits.unwrap_or_default(),
        severity: None,
        case,
    })
}

/// The bits of a family's case, if it is of the version that this program makes.
fn bits<F: Scalar>(id: &CaseId) -> Option<String> {
    let family = family::find(&id.family).filter(|family| family.version == id.version)?;
    let made = family.make::<F>(&id.parameters, id.seed, id.index);
    made.cases().get(id.triangle.unwrap_or(0)).map(Case::hex)
}
