//! `hairline mesh`: whether rays slip through a mesh, where, and how often.

use super::before::{one_scalar, set_threads};
use super::exit::{Failure, Status};
use super::flags::{matrix_in, scalar_names};
use super::input::read_mesh;
use super::output::OutputArguments;
use super::plugins;
use super::progress::Progress;
use super::select::KernelArguments;
use super::sources::rays_at_each;
use crate::audit::mesh::{MeshFound, MeshPlan};
use crate::family::MeshFamily;
use crate::mesh::{AimedPart, Surface};
use crate::report::mesh::{MESH_FORMATS, build, places};
use crate::report::{Context, HTML, number_of};
use crate::studied::Studied;
use clap::Args;
use std::sync::Arc;

/// Which mesh and kernels, and how to report it.
#[derive(Args)]
#[command(mut_arg("band", |band| band.hide(true)))]
#[command(mut_arg("format", |format| {
    format.help("text, json, markdown or html, or several separated by commas; html draws the mesh with the edges and vertices where rays slip through")
}))]
pub struct MeshArguments {
    /// An OBJ, PLY, STL or glTF file (.gltf or .glb); - is standard input
    #[arg(value_name = "FILE")]
    file: String,

    #[command(flatten)]
    kernels: KernelArguments,

    /// f32, f64 or both [default: f32, or f64 where no kernel runs in f32]
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

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &MeshArguments) -> Result<Status, Failure> {
    let mut outputs = arguments.output.pairs(MESH_FORMATS)?;
    let mut plan = arguments.plan()?;
    let scalars = one_scalar(&plan.rows, &arguments.scalar)?;
    plan.instance = matrix_in(arguments.instance.as_deref(), scalars)?;
    let threads = set_threads(arguments.threads)?;
    let family =
        MeshFamily::new(read_mesh(&arguments.file, arguments.output.quiet)?, &arguments.file);
    if outputs.iter().any(|(format, _)| format.name == HTML) {
        plan.places = places(family.mesh());
    }
    let surface = Arc::new(Surface::new(Arc::new(family), scalars));
    let progress = Progress::new(0, "rays", arguments.output.quiet);
    let run =
        |name| in_named_scalar!(name, F => arguments.run_scalar::<F>(&surface, &plan, &progress));
    let found: Vec<MeshFound> = scalar_names(scalars).map(run).collect();
    progress.finish();
    plugins::check()?;
    let context = Context { seconds: progress.seconds(), threads };
    let report = build(&surface, &plan, &found, &context);
    let nothing = found.iter().all(|found| found.cases == 0);
    if nothing {
        // It is printed why, but no file becomes a report of nothing.
        outputs.retain(|(_, path)| *path == "-");
    }
    arguments.output.write(outputs, &report)?;
    if nothing {
        let message = format!(
            "{}: nothing to ask: no edge lies between two sound faces that are wound consistently",
            arguments.file
        );
        return Err(Failure::nothing(message));
    }
    Ok(Status::Success)
}

impl MeshArguments {
    fn plan(&self) -> Result<MeshPlan, Failure> {
        let unit_direction = self.direction.is_some();
        let MeshArguments { directions, seed, examples, .. } = *self;
        let rows = self.kernels.rows_without_band("every ray goes to an edge or a vertex")?;
        Ok(MeshPlan { rows, directions, seed, unit_direction, instance: None, examples, places: 0 })
    }

    fn run_scalar<F: Studied>(
        &self,
        surface: &Arc<Surface>,
        plan: &MeshPlan,
        progress: &Progress,
    ) -> MeshFound {
        let parameters = plan.parameters();
        let targets = surface.targets::<F>(&parameters, plan.seed);
        let count = |part| targets.as_ref().map_or(0, |targets| targets.count(part));
        let rays: u64 = AimedPart::ALL.map(|part| count(part) * plan.directions).iter().sum();
        progress.add_total(rays);
        if !self.output.quiet {
            let rows = plan.rows.iter().filter(|row| F::subject(row.entry).is_some()).count();
            let rows = number_of(rows as u64, "kernel row", "kernel rows");
            eprintln!("{rows} on {rays} rays in {}", F::NAME);
        }
        F::mesh(surface, plan, progress)
    }
}
