//! A case that changed between two runs over the same cases, from the digests of what was wrong in each.

use crate::audit::Digest;
use crate::case::{Case, CaseId, Parameters};
use crate::family;
use crate::kernel::Scalar;
use crate::report::{Example, Key, ResultPart};

/// The change of a case.
#[derive(Clone, Copy, PartialEq)]
pub enum Change {
    /// It shows a finding, and did not.
    New,
    /// It showed a finding, and no longer shows that one.
    Right,
}

/// The note on a case that is shown, if no digest tells whether it changed.
pub const UNSURE: &str = "; the case shown may have failed before";

impl Change {
    /// The digests of what was wrong before and of what is wrong now: the one that has the case, and the one
    /// that has not.
    pub fn of<'a>(self, before: &'a Digest, now: &'a Digest) -> [&'a Digest; 2] {
        match self {
            Change::New => [now, before],
            Change::Right => [before, now],
        }
    }

    /// The note on a case that is shown.
    pub fn note(self) -> &'static str {
        match self {
            Change::New => "; the case shown is new",
            Change::Right => "; the case shown no longer shows it",
        }
    }
}

/// A case of a class that is in the first set and not in the second, if their digests tell one; `example` is
/// another of the class, shown again by a command like its.
pub fn changed_case(
    result: &ResultPart,
    key: &Key,
    example: &Example,
    [has, has_not]: [&Digest; 2],
) -> Option<Example> {
    // The place of a stored case does not tell its name, which may be another case's id.
    if key.family.starts_with("corpus:") {
        return None;
    }
    let is_source = |scalar: &str, family: &str| scalar == key.scalar && family == key.family;
    let source = result.sources.iter().find(|source| is_source(&source.scalar, &source.family))?;
    let place = has.beyond(has_not, source.indices).min()?;
    let mut id: CaseId = example.case.parse().ok()?;
    // Of a family of single cases another triangle is none: several places were taken for one.
    if id.triangle.is_none() && place.triangle != 0 {
        return None;
    }
    (id.index, id.triangle) = (place.index, id.triangle.map(|_| place.triangle as usize));
    let case = id.to_string();
    let Parameters { mesh, scene, instance, .. } = &id.parameters;
    let is_plain = mesh.is_none() && scene.is_none() && instance.is_none();
    let is_of_cases = !example.bits.is_empty() && is_plain;
    let bits = is_of_cases.then(|| in_named_scalar!(id.scalar, F => bits::<F>(&id))).flatten();
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
