//! A case of an audit in a test, explained with the kernel of that test, which no other program knows.

use crate::audit::Row;
use crate::case::CaseId;
use crate::engine::Unobserved;
use crate::family::{around, cases_of};
use crate::map;
use crate::report::Format;
use crate::report::explain::{Together, explain};
use hairline_core::{Error, ErrorKind};

/// The environment variable that names the case.
pub const VARIABLE: &str = "HAIRLINE_CASE";

/// The explanation of the case that the environment names, or what is wrong with it; none if it names none.
pub fn instead(rows: impl FnOnce() -> Result<Vec<Row>, Error>) -> Option<String> {
    let case = std::env::var(VARIABLE).ok()?;
    let rows = match rows() {
        Ok(rows) => rows,
        Err(error) => return Some(error.to_string()),
    };
    let text = explained(&rows, &case);
    Some(text.unwrap_or_else(|error| format!("{VARIABLE}: {error}")))
}

/// The explanation of a case as text. An error says what is wrong with its name.
pub(super) fn explained(rows: &[Row], name: &str) -> Result<String, Error> {
    let id = named(name)?;
    let explanation = in_named_scalar!(id.scalar, F => {
        let (cases, grouping) = cases_of::<F>(&id).map_err(no_cases)?;
        let neighbours = around(&cases, grouping);
        let group = Together {
            cases: &cases,
            grouping,
            neighbours: neighbours.as_deref(),
            instance: None,
        };
        explain(name, group, rows)
    });
    let mut text = Vec::new();
    // Writing into memory does not fail.
    let _ = (Format::TEXT.write)(&explanation, Default::default(), &mut text);
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// The map of a row around a case as SVG, its origin varied. An error says what is wrong with the case's name.
pub(super) fn mapped(row: &Row, name: &str) -> Result<String, Error> {
    let id = named(name)?;
    let drawn = in_named_scalar!(id.scalar, F => {
        let (cases, _) = cases_of::<F>(&id).map_err(no_cases)?;
        let Some(case) = cases.first() else {
            return Err(Error::new(ErrorKind::Nothing, format!("'{id}' has no triangle")));
        };
        let grid = map::grid_of_case(case, map::CaseVector::Origin, None, None, [128; 2])?;
        map::of_kernel(case, row, &grid, &Unobserved)?
    });
    Ok(map::svg_document(&[drawn]))
}

/// The error of a name that leads to no cases.
fn no_cases(message: String) -> Error {
    Error::new(ErrorKind::UnknownName, message)
}

/// The id that a case's name is.
fn named(name: &str) -> Result<CaseId, Error> {
    let id: CaseId = name.parse()?;
    if id.parameters.instance.is_some() {
        let message = format!("'{id}' is a case of an instance: `hairline explain` takes it");
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    Ok(id)
}
