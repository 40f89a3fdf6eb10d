//! `hairline orient`: orientation predicates on families of points, one case again, known cases.

mod page;

use super::exit::{Failure, Status};
use super::flags::{case_count, chosen_scalars, unknown};
use super::output::OutputArguments;
use super::progress::Progress;
use crate::arith::Float;
use crate::audit::EpsilonText;
use crate::orientation::points_json;
use crate::orientation::{
    self, CasePart, Dimension, FAMILIES, KNOWN, Known, Plan, Points, PointsId, Record, Row, SCHEMA,
    Scalar, build, default_rows, find_family, find_known, show,
};
use crate::report::Format;
use clap::Args;
use page::Cases;

/// The flags of `orient`: the run, and how it is reported.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, markdown or html, or several separated by commas")
}))]
pub struct OrientArguments {
    /// Dimension of the points: 2, 3 or both
    #[arg(long, value_delimiter = ',', value_name = "2|3", default_value = "2,3")]
    dimension: Vec<String>,

    /// f32, f64 or both
    #[arg(long, value_delimiter = ',', value_name = "SCALAR", default_value = "f32,f64")]
    scalar: Vec<String>,

    /// Epsilons of the plain determinants, a row for each: the sign counts as 0 where abs(det) <= E
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "E",
        default_value = "0,1e-6",
        allow_hyphen_values = true
    )]
    epsilon: Vec<String>,

    /// How many cases of each family
    #[arg(
        long,
        short = 'n',
        default_value = "20000",
        value_name = "N",
        value_parser = case_count,
        allow_hyphen_values = true
    )]
    count: u64,

    /// Seed of the random cases
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Show one case again: an id, the name of a known case, or points as
    /// {"scalar":"f64","points":[[x,y],...]}, three in the plane or four in space
    #[arg(long, value_name = "ID", conflicts_with_all = ["known", "dimension", "scalar", "count", "seed"])]
    case: Option<String>,

    /// Show the known cases on which robust's predicates are wrong
    #[arg(long, conflicts_with_all = ["dimension", "scalar", "count", "seed"])]
    known: bool,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &OrientArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(Format::OF_PAGE)?;
    let scalars = chosen_scalars(&arguments.scalar)?;
    let rows = arguments.rows()?;
    if arguments.known {
        let cases: Vec<(CasePart, Option<&Known>)> = KNOWN
            .iter()
            .map(|known| Ok((known_case(known, &rows)?, Some(known))))
            .collect::<Result<_, Failure>>()?;
        return arguments.write_cases(&cases);
    }
    if let Some(text) = &arguments.case {
        let case = one_case(text, &rows)?;
        if case.0.scalar == "f32" {
            arguments.check_epsilons_in_f32()?;
        }
        return arguments.write_cases(&[case]);
    }
    if scalars[0] {
        arguments.check_epsilons_in_f32()?;
    }
    let plan = Plan {
        rows,
        dimensions: arguments.dimensions()?,
        scalars,
        count: arguments.count,
        seed: arguments.seed,
    };
    let progress = Progress::new(plan.cases(), "cases", arguments.output.quiet);
    let sums = orientation::run(&plan, &progress);
    progress.finish();
    let record = build(&plan, &sums, progress.seconds(), rayon::current_num_threads());
    self_check(&record)?;
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

/// A family that breaks its own promise is a fault of this tool.
fn self_check(record: &Record) -> Result<(), Failure> {
    match record.result.sets.iter().find(|set| set.promise_broken > 0) {
        None => Ok(()),
        Some(set) => {
            let first = set.first_broken.as_deref().unwrap_or("-");
            let message =
                format!("self-check: family '{}' breaks its promise, first at {first}", set.family);
            Err(Failure::Message(Status::SelfCheck, message))
        }
    }
}

/// A curated case, whose stored sign is checked.
fn known_case(known: &Known, rows: &[Row]) -> Result<CasePart, Failure> {
    let case = shown(known.name.to_owned(), &known.points(), rows)?;
    if case.sign != orientation::Answer::from(known.sign).symbol() {
        let message = format!("self-check: the stored sign of '{}' is wrong", known.name);
        return Err(Failure::Message(Status::SelfCheck, message));
    }
    Ok(case)
}

/// The case of an id or of a name.
fn one_case(text: &str, rows: &[Row]) -> Result<(CasePart, Option<&'static Known>), Failure> {
    if let Some(known) = find_known(text) {
        return Ok((known_case(known, rows)?, Some(known)));
    }
    if text.trim_start().starts_with('{') {
        return Ok((given_points(text, rows)?, None));
    }
    if !text.contains(['/', ':', '@']) {
        let names = KNOWN.iter().map(|known| known.name);
        return Err(unknown("case", text, names, "hairline orient --known"));
    }
    let id: PointsId = text.parse().map_err(|error: String| Failure::usage(error))?;
    let case = match id.scalar.as_str() {
        "f32" => case_of_id::<f32>(&id, rows)?,
        "f64" => case_of_id::<f64>(&id, rows)?,
        other => return Err(Failure::usage(format!("unknown scalar '{other}' in '{id}'"))),
    };
    Ok((case, None))
}

/// The case of points as JSON.
fn given_points(text: &str, rows: &[Row]) -> Result<CasePart, Failure> {
    let points =
        points_json::parse(text).map_err(|error| Failure::usage(format!("--case: {error}")))?;
    let name = "the points given".to_owned();
    let case = either_scalar!(&points, points => show(name, points, rows));
    case.ok_or_else(|| Failure::usage("--case: points that are not finite have no orientation"))
}

fn case_of_id<F: Scalar>(id: &PointsId, rows: &[Row]) -> Result<CasePart, Failure> {
    shown(id.to_string(), &points_of_id::<F>(id)?, rows)
}

/// The points of an id, whose family must be of the version that this program makes.
pub(super) fn points_of_id<F: Scalar>(id: &PointsId) -> Result<Points<F>, Failure> {
    let names = FAMILIES.iter().map(|family| family.name);
    let family = find_family(&id.family)
        .ok_or_else(|| unknown("family", &id.family, names, "hairline orient"))?;
    if family.version != id.version {
        let (name, version) = (family.name, family.version);
        return Err(Failure::usage(format!("'{id}': family '{name}' is at version {version}")));
    }
    Ok(family.make::<F>(id.dimension, id.seed, id.index))
}

fn shown<F: Scalar>(id: String, points: &Points<F>, rows: &[Row]) -> Result<CasePart, Failure> {
    let message = format!("self-check: the points of '{id}' are not finite");
    show(id, points, rows).ok_or(Failure::Message(Status::SelfCheck, message))
}

impl OrientArguments {
    fn write_cases(&self, cases: &[(CasePart, Option<&Known>)]) -> Result<Status, Failure> {
        let pairs = self.output.pairs(Format::OF_PAGE)?;
        let notes = cases.iter().map(|(_, known)| known.map_or("", |known| known.why)).collect();
        let cases = cases.iter().map(|(case, _)| case.clone()).collect();
        self.output.write(pairs, &Cases { schema: SCHEMA, cases, notes })?;
        Ok(Status::Success)
    }

    fn dimensions(&self) -> Result<Vec<Dimension>, Failure> {
        let known = |name: &String| match name.as_str() {
            "2" => Ok(Dimension::Two),
            "3" => Ok(Dimension::Three),
            other => Err(Failure::usage(format!("unknown dimension '{other}': there are 2 and 3"))),
        };
        let mut dimensions = self.dimension.iter().map(known).collect::<Result<Vec<_>, _>>()?;
        dimensions.sort();
        dimensions.dedup();
        Ok(dimensions)
    }

    /// All predicates, the plain ones once with each epsilon.
    fn rows(&self) -> Result<Vec<Row>, Failure> {
        let mut epsilons: Vec<String> = Vec::new();
        for text in &self.epsilon {
            let text = text.trim();
            check_epsilon::<f64>(text)?;
            if !epsilons.iter().any(|other| other == text) {
                epsilons.push(text.to_owned());
            }
        }
        Ok(default_rows(&epsilons))
    }

    /// An error if an epsilon is not representable in `f32`.
    fn check_epsilons_in_f32(&self) -> Result<(), Failure> {
        self.epsilon.iter().try_for_each(|text| check_epsilon::<f32>(text.trim()))
    }
}

/// An error if a text is no epsilon of a predicate in a scalar.
pub(super) fn check_epsilon<F: Float>(text: &str) -> Result<(), Failure> {
    let epsilon = EpsilonText::Decimal(text.to_owned());
    let wrong = match epsilon.value::<F>() {
        Some(value) if value < F::zero() => "is below 0",
        Some(_) if epsilon.fitting::<F>().is_some() => return Ok(()),
        Some(_) => "is 0",
        None => "is not a finite number",
    };
    Err(Failure::usage(format!("--epsilon: '{text}' {wrong} in {}", F::NAME)))
}
