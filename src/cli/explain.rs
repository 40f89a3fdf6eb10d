//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::flags::{matrix, placed};
use super::output::OutputArguments;
use super::select::KernelArguments;
use crate::arith::Float;
use crate::case::{Case, Instance};
use crate::report::Format;
use crate::report::explain::{Explanation, Together, explain};
use crate::report::page::Picture;
use clap::Args;
use hairline_rays::pictured;
use hairline_scene::{Ray, Scene};

/// The flags of the command.
#[derive(Args)]
pub struct ExplainArguments {
    #[command(flatten)]
    case: CaseArguments,

    /// Where an instance puts the triangle: a 3x4 matrix row by row, as "m00, …, m23". The case's ray is of the world, and the
    /// kernel gets it by the rounded inverse
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true)]
    instance: Option<String>,

    #[command(flatten)]
    kernels: KernelArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(Format::OF_PAGE)?;
    let rows = arguments.kernels.rows()?;
    let cases = arguments.case.cases_and_instances()?;
    for row in &rows {
        row.check_in(cases.scalars())?;
    }
    let record = either_scalar!(&cases, group => {
        let given = instance_of(arguments)?;
        if given.is_some() && group.instance.is_some() {
            return Err(Failure::usage("--instance: the case's id has an instance of its own"));
        }
        let together = Together {
            cases: &group.cases,
            grouping: group.grouping,
            neighbours: group.neighbours.as_deref(),
            instance: given.as_ref().or(group.instance.as_ref()),
        };
        Explanation {
            picture: picture(&group.cases),
            ..explain(&arguments.case.case, together, &rows)
        }
    });
    arguments.output.write(pairs, &record)?;
    Ok(Status::Success)
}

/// The triangles and the ray in space; none if the ray means nothing, or no triangle is finite.
fn picture<F: Float>(cases: &[Case<F>]) -> Option<Picture> {
    let first = cases.first()?;
    let [origin, direction, ..] = first.vectors();
    let ray = Ray::new(origin, direction).on(first.ray.t_min, first.ray.t_max);
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for case in cases {
        let [_, _, corners @ ..] = case.vectors();
        let place = vertices.len() as u32;
        faces.push([place, place + 1, place + 2]);
        vertices.extend(corners);
    }
    let scene = Scene::new(&vertices, &faces).ok()?;
    pictured(&scene, &ray, None).ok().flatten()
}

/// The instance of `--instance`, if it is given.
fn instance_of<F: Float>(arguments: &ExplainArguments) -> Result<Option<Instance<F>>, Failure> {
    let Some(text) = &arguments.instance else {
        return Ok(None);
    };
    // A run reads doubles at first too, so both have the same numbers.
    let wide = matrix(text)?;
    placed(wide.map(|row| row.map(F::from_f64))).map(Some)
}
