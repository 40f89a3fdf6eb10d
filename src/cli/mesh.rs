//! `hairline mesh`: whether rays slip through a mesh, where, and how often.

use super::before::{count_indices, one_scalar, set_threads};
use super::exit::{Failure, Status};
use super::flags::{RUNNING, matrix_in, parsed};
use super::input::read_mesh;
use super::reporting::{Execution, Outputs, ReportArguments};
use super::select::KernelArguments;
use super::sources::rays_at_each;
use crate::audit::{Plan, Source};
use crate::case::Parameters;
use crate::family::MeshFamily;
use crate::mesh::Surface;
use crate::record::places;
use clap::Args;
use std::sync::Arc;

/// Which mesh and kernels, and how to report it.
#[derive(Args)]
#[command(mut_arg("band", |band| band.hide(true)))]
#[command(mut_arg("illustrate", |illustrate| illustrate.hide(true)))]
#[command(mut_arg("format", |format| {
    format.help("text, json, junit, sarif, markdown or html, or several separated by commas; html draws the mesh with the edges and vertices where rays slip through")
}))]
pub struct MeshArguments {
    /// An OBJ, PLY, STL or glTF file (.gltf or .glb); - is standard input
    #[arg(value_name = "FILE")]
    file: String,

    #[command(flatten)]
    kernels: KernelArguments,

    /// f32, f64, or f32,f64 [default: f32, or f64 where no kernel runs in f32]
    #[arg(long, value_delimiter = ',', value_name = "SCALAR")]
    scalar: Vec<String>,

    /// How many rays at each edge and vertex, from 1 to 65536: exact and near, grazing and not, in turn
    #[arg(long, default_value_t = 8, value_name = "N", allow_hyphen_values = true, value_parser = rays_at_each())]
    directions: u64,

    /// `unit`: replace each direction by its rounded unit vector; few rays then meet an edge exactly
    #[arg(long, value_name = "unit", value_parser = ["unit"], hide_possible_values = true)]
    direction: Option<String>,

    /// Put the mesh into the world by a 3x4 matrix, row by row, as "m00, …, m23": kernels get the rays, which are of
    /// the world, by the rounded inverse
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true)]
    instance: Option<String>,

    /// Seed of the random rays
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    examples: usize,

    /// Run only part K of N, counted from 0; `hairline merge` makes one record of all parts
    #[arg(long, value_name = "K/N", help_heading = RUNNING)]
    shard: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    report: ReportArguments,
}

/// Runs the command.
pub fn run(arguments: &MeshArguments) -> Result<Status, Failure> {
    let outputs = arguments.report.outputs()?;
    outputs.told(audited(arguments, &outputs))
}

fn audited(arguments: &MeshArguments, outputs: &Outputs<'_>) -> Result<Status, Failure> {
    let shard = parsed("--shard", arguments.shard.as_deref())?;
    let plan = arguments.plan(outputs.illustrate())?;
    let run = Execution {
        plan: &plan,
        kernels: &arguments.kernels,
        shard,
        quiet: arguments.report.output.quiet,
        illustrate: outputs.illustrate(),
    };
    let record = run.record()?;
    if 0 < count_indices(&plan.sources, plan.scalars) {
        outputs.write(&record)?;
        return Ok(Status::Success);
    }
    // It is printed why, but no file becomes a report of nothing.
    outputs.on_screen().write(&record)?;
    let message = format!(
        "{}: nothing to ask: no edge lies between two sound faces that are wound consistently",
        arguments.file
    );
    Err(Failure::nothing(message))
}

impl MeshArguments {
    fn plan(&self, illustrate: bool) -> Result<Plan, Failure> {
        let rows = self
            .kernels
            .rows_without_band("every ray goes to an edge or a vertex")?;
        let scalars = one_scalar(&rows, &self.scalar)?;
        let parameters = Parameters {
            unit_direction: self.direction.is_some(),
            instance: matrix_in(self.instance.as_deref(), scalars)?,
            ..Parameters::default()
        };
        set_threads(self.threads)?;
        let family = MeshFamily::new(read_mesh(&self.file, self.report.output.quiet)?, &self.file);
        // A part of a run may be merged into a page.
        let is_drawn = illustrate || self.shard.is_some();
        let places = if is_drawn { places(family.mesh()) } else { 0 };
        let surface = Arc::new(Surface::new(Arc::new(family), scalars));
        let sources = Source::parts_of(&surface, &parameters, self.seed, self.directions).into();
        Ok(Plan {
            places,
            ..Plan::new(rows, sources, scalars, self.examples)
        })
    }
}
