//! `hairline rays`: what rays really meet in a mesh, and what another program should have answered.

mod found;
mod judged;
mod made;
mod one;
mod points;
mod read;

use super::before::set_threads;
use super::exit::{Failure, Status};
use super::flags::find_scalar;
use super::input::read_mesh;
use super::output::OutputArguments;
use crate::arith::ScalarName;
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::files::InputError;
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use clap::Args;
use hairline_scene::Scene;

/// Which mesh, which rays, whose answers.
#[derive(Args)]
pub struct RaysArguments {
    /// The mesh: an OBJ, PLY, STL or glTF file (.gltf or .glb); - is standard input
    #[arg(value_name = "MESH")]
    mesh: String,

    /// The rays, one a line: origin and direction as six numbers, or eight with t_min and t_max; or JSON with the fields
    /// origin, direction, t_min and t_max
    #[arg(value_name = "RAYS")]
    rays: Option<String>,

    /// One ray instead, as "ox,oy,oz dx,dy,dz" or with t_min,t_max behind: everything about it
    #[arg(long, value_name = "RAY", conflicts_with_all = ["rays", "answers", "points"], allow_hyphen_values = true)]
    ray: Option<String>,

    /// The nearest hits that a program answered, one a line in the order of the rays: the face's number from 0 (-1 for a
    /// miss), and its t if there is one; or JSON with the fields face and t
    #[arg(long, value_name = "FILE", requires = "rays")]
    answers: Option<String>,

    /// Points instead of rays, three numbers a line: inside, outside or on the surface
    #[arg(long, value_name = "FILE", conflicts_with_all = ["rays", "answers"])]
    points: Option<String>,

    /// Make so many rays at the mesh instead, as CSV: ask your program about them
    #[arg(long, value_name = "N", conflicts_with_all = ["rays", "ray", "answers", "points"])]
    make: Option<u64>,

    /// Which rays to make: random, vertex, edge, axis, plane (in that of a face), surface (from face to face) [default: all in turn]
    #[arg(
        long,
        value_name = "KIND,...",
        value_delimiter = ',',
        requires = "make"
    )]
    kinds: Vec<String>,

    /// Seed of the rays that are made
    #[arg(long, default_value_t = 1, requires = "make")]
    seed: u64,

    /// f32 or f64: what the numbers of mesh and rays are rounded to first [default: f64; for --answers the one in which more
    /// are right]
    #[arg(long, value_name = "SCALAR")]
    scalar: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &RaysArguments) -> Result<Status, Failure> {
    set_threads(arguments.threads)?;
    let given = [&arguments.rays, &arguments.ray, &arguments.points];
    if arguments.make.is_none() && given.iter().all(|given| given.is_none()) {
        return Err(Failure::usage(
            "which rays? Give a file of them, one as --ray \"0,0,5 0,0,-1\", or --make 1000 -o rays.csv; --points FILE asks if points are \
             inside",
        ));
    }
    let scalar = arguments.scalar.as_deref().map(find_scalar).transpose()?;
    let mesh = read_mesh(&arguments.mesh, arguments.output.quiet)?;
    if let Some(answers) = &arguments.answers {
        return judged::run(arguments, &mesh, answers, scalar);
    }
    match scalar {
        Some(ScalarName::F32) => run_in::<f32>(arguments, &mesh),
        Some(ScalarName::F64) | None => run_in::<f64>(arguments, &mesh),
    }
}

fn run_in<F: Scalar>(arguments: &RaysArguments, mesh: &Mesh) -> Result<Status, Failure>
where
    Case<F>: Into<AnyCase>,
{
    if let Some(count) = arguments.make {
        return made::run::<F>(arguments, mesh, count);
    }
    let scene = scene::<F>(mesh)?;
    if let Some(text) = &arguments.ray {
        return one::run(arguments, mesh, &scene, read::ray_of_words::<F>(text)?);
    }
    if let Some(file) = &arguments.points {
        return points::run(arguments, &scene, &read::points::<F>(file)?);
    }
    found::run(arguments, &scene, &read::rays::<F>(arguments.rays_file())?)
}

impl RaysArguments {
    fn rays_file(&self) -> &str {
        self.rays.as_deref().unwrap_or_default()
    }
}

/// The triangles of a mesh as a scene.
fn scene<F: Scalar>(mesh: &Mesh) -> Result<Scene<F>, Failure> {
    let count = mesh.positions_f64.len() as u32;
    let vertices: Vec<[F; 3]> = (0..count).map(|vertex| mesh.position(vertex)).collect();
    Scene::new(&vertices, &mesh.triangles)
        .map_err(|error| InputError::of(&mesh.name, error.to_string()).into())
}
