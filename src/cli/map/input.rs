//! The case of a map: one that is named, or a standard one.

use super::MapArguments;
use crate::case::Case;
use crate::cli::case::CaseArguments;
use crate::cli::exit::Failure;
use crate::cli::flags::{is_f32, unknown};
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::map::Spot;

impl MapArguments {
    /// The case.
    pub(super) fn input(&self) -> Result<AnyCase, Failure> {
        let Some(text) = &self.case else { return self.standard() };
        let case = CaseArguments {
            case: text.to_owned(),
            mesh: self.mesh.clone(),
            corpus: self.corpus.clone(),
        };
        either_scalar!(case.cases()?, group => Ok((*one(&group.cases, text)?).into()))
    }

    /// The case of `--at`.
    fn standard(&self) -> Result<AnyCase, Failure> {
        let name = self.at.as_deref().unwrap_or(Spot::Edge.name());
        let names = Spot::ALL.map(Spot::name);
        let spot =
            Spot::named(name).ok_or_else(|| unknown("spot", name, names, "hairline map --help"))?;
        Ok(match is_f32(self.scalar.as_deref().unwrap_or("f32"), "")? {
            true => AnyCase::F32(spot.case()),
            false => AnyCase::F64(spot.case()),
        })
    }
}

/// The one triangle of a case.
fn one<'a, F: Scalar>(cases: &'a [Case<F>], name: &str) -> Result<&'a Case<F>, Failure> {
    match cases {
        [case] => Ok(case),
        _ => Err(Failure::usage(format!(
            "'{name}' has {} triangles: say which, as {name}.0 to {name}.{}",
            cases.len(),
            cases.len() - 1
        ))),
    }
}
