//! The parts that the flags of several commands share: headings of the help, names in tables, numbers.

#![forbid(unsafe_code)]

use crate::arith::{Float, ScalarName};
use crate::audit::shell_word;
use crate::case::{Instance, Matrix};
use crate::exit::Failure;
use crate::family::{self, FAMILIES, Family};
use crate::files::number;
use crate::kernel::{self, Entry};
use crate::suggest::did_you_mean;
use std::fmt::Display;
use std::str::FromStr;

/// Headings of the help: which cases and rows a run has, how they are judged, and what is written. The
/// flags that matter most stand under none, and so come first.
pub const RUNNING: &str = "What to run";
/// Likewise.
pub const JUDGING: &str = "How to judge";
/// Likewise.
pub const OUTPUT: &str = "Output";

/// The error for a name that is not in a table.
pub fn unknown<'a>(
    what: &str,
    name: &str,
    names: impl IntoIterator<Item = &'a str>,
    list: &str,
) -> Failure {
    Failure::usage(format!(
        "unknown {what} '{name}'{}",
        did_you_mean(name, names, list)
    ))
}

/// The family of a name.
pub fn find_family(name: &str) -> Result<&'static Family, Failure> {
    let names = FAMILIES.iter().map(|family| family.name);
    family::find(name).ok_or_else(|| unknown("family", name, names, "hairline list families"))
}

/// The kernel of a name.
pub fn find_kernel(name: &str) -> Result<&'static Entry, Failure> {
    let names = || kernel::all().into_iter().map(|entry| entry.info.name);
    let wrong = || {
        let Some(base) = name
            .rsplit_once('+')
            .and_then(|(base, _)| kernel::find(base))
        else {
            return unknown("kernel", name, names(), "hairline list kernels");
        };
        let forms: Vec<String> = kernel::forms(base)
            .iter()
            .map(|(name, about)| format!("+{name} ({about})"))
            .collect();
        let base = base.info.name;
        let forms = if forms.is_empty() {
            "nothing".to_owned()
        } else {
            forms.join(", ")
        };
        Failure::usage(format!(
            "unknown kernel '{name}': behind '{base}' can stand {forms}"
        ))
    };
    kernel::find(name).ok_or_else(wrong)
}

/// The scalar of a name.
pub fn find_scalar(name: &str) -> Result<ScalarName, Failure> {
    let unknown = || Failure::usage(format!("unknown scalar '{name}': there are f32 and f64"));
    ScalarName::named(name).ok_or_else(unknown)
}

/// The value of a flag, if it is given.
pub fn parsed<T: FromStr<Err: Display>>(
    flag: &str,
    text: Option<&str>,
) -> Result<Option<T>, Failure> {
    let wrong = |error| Failure::usage(format!("{flag}: {error}"));
    text.map(str::parse).transpose().map_err(wrong)
}

/// A flag with each of its values, as a shell takes them.
pub fn again<'a>(flag: &str, values: impl IntoIterator<Item = &'a String>) -> Vec<String> {
    values
        .into_iter()
        .map(|value| format!("{flag} {}", shell_word(value)))
        .collect()
}

/// The most cases of one family: beyond it a run would take years.
const MOST_CASES: u64 = 1_000_000_000_000;

/// A number of cases.
pub fn case_count(text: &str) -> Result<u64, &'static str> {
    let count = text.replace('_', "").parse().ok();
    let count = count.filter(|count| (1..=MOST_CASES).contains(count));
    count.ok_or("not a number of cases from 1 to 10^12, as 1_000_000")
}

/// An error if a flag names something twice.
pub fn refuse_twice<T: PartialEq + Display>(flag: &str, named: &[T]) -> Result<(), Failure> {
    match (1..named.len()).find(|&i| named[..i].contains(&named[i])) {
        Some(i) => Err(Failure::usage(format!(
            "{flag}: '{}' is given twice",
            named[i]
        ))),
        None => Ok(()),
    }
}

/// True for each scalar that is named: `f32`, `f64`.
pub fn chosen_scalars(names: &[String]) -> Result<[bool; 2], Failure> {
    let mut scalars = [false; 2];
    for name in names {
        scalars[find_scalar(name)? as usize] = true;
    }
    Ok(scalars)
}

/// The chosen scalars in which a kernel runs.
pub fn scalars_of(entry: &Entry, chosen: [bool; 2]) -> impl Iterator<Item = ScalarName> {
    let runs = entry.scalars();
    ScalarName::among([chosen[0] && runs[0], chosen[1] && runs[1]])
}

/// Reads the matrix of `--instance`: twelve numbers, row by row.
pub fn matrix(text: &str) -> Result<Matrix<f64>, Failure> {
    let wrong = |message: String| Failure::usage(format!("--instance: {message}"));
    let words = text
        .split([',', ' ', ';', '\n'])
        .filter(|word| !word.is_empty());
    let numbers = words
        .map(number::parse)
        .collect::<Result<Vec<f64>, _>>()
        .map_err(wrong)?;
    let count = || {
        wrong(format!(
            "expected 12 numbers, row by row, found {}",
            numbers.len()
        ))
    };
    let (rows, []) = numbers.as_chunks::<4>() else {
        return Err(count());
    };
    rows.try_into().map_err(|_| count())
}

/// The instance of a matrix, if it has an inverse.
pub fn placed<F: Float>(matrix: Matrix<F>) -> Result<Instance<F>, Failure> {
    Instance::checked(matrix).map_err(|error| Failure::usage(format!("--instance: {error}")))
}

/// Reads the matrix of `--instance`, if it is given, for a run in some scalars.
pub fn matrix_in(text: Option<&str>, scalars: [bool; 2]) -> Result<Option<Matrix<f64>>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let wide = matrix(text)?;
    for name in ScalarName::among(scalars) {
        in_named_scalar!(name, F => placed(wide.map(|row| row.map(F::from_f64))).map(drop)?);
    }
    Ok(Some(wide))
}
