//! `hairline offset`: how new rays must start so that they do not hit the surface that they leave.

use super::before::{one_scalar, refuse_wrong_values, set_threads};
use super::exit::{Failure, Status};
use super::flags::{RUNNING, case_count, matrix_in, refuse_twice, scalars_of};
use super::output::OutputArguments;
use super::progress::Progress;
use super::select::KernelArguments;
use super::sources::{about_scene, mesh_scene, note_left_out};
use crate::advised::Advised;
use crate::arith::ScalarName;
use crate::audit::{Row, shell_word};
use crate::case::Scene;
use crate::engine::Unobserved;
use crate::epsilon::fresh_seed;
use crate::kernel::Scalar;
use crate::mesh::SceneMesh;
use crate::offset::{
    OffsetPlan, OffsetSums, PointKind, Scheme, SegmentPlan, default_schemes, needs_t, parse,
    register,
};
use crate::plugin::{KernelProgram, OffsetCommand};
use crate::record::{Context, Record, provenance_of};
use crate::report::offset::{DerivedPart, OffsetResult, PointsPart, made_for};
use crate::report::{Format, SegmentsPart};
use clap::Args;
use clap::builder::ArgPredicate;
use std::sync::Arc;

/// The flags of `offset`: the run, and how it is reported.
#[derive(Args)]
#[command(mut_arg("kernel", |kernel| {
    kernel.help("A kernel, or several separated by commas [default: moller-trumbore, or only your own if there are some]")
}))]
pub struct OffsetArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    /// Where triangles are, how large they are, and how far first rays travel: unit, room, city or cad-mm,
    /// or what is known of yours, as extent=1000,edge=0.01..10,distance=0..2000; center=1e5 moves it,
    /// edge=0.01..0.1..10 makes half of them smaller than 0.1, plane=axis-0 tries floors at 0 only
    /// (generic, axis, axis-near-0, axis-0, terrain, box) [without plane: all kinds, told apart]
    #[arg(
        long,
        value_name = "SCENE",
        default_value = "unit",
        default_value_if("mesh", ArgPredicate::IsPresent, "mesh")
    )]
    scene: String,

    /// First rays at the triangles of an OBJ, PLY, STL or glTF file instead; then --scene says how far they travel, as
    /// mesh,distance=0..20
    #[arg(long, value_name = "FILE")]
    mesh: Option<String>,

    /// Put all triangles into the world by a 3x4 matrix, row by row, as "m00, …, m23": hit points go there, are offset
    /// there, and new rays come back by the rounded inverse
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true)]
    instance: Option<String>,

    /// Offset schemes, separated by commas, some with a value: normal=1e-3,waechter-binder (see `hairline
    /// list schemes`) [default: all published ones, and two that are made for the scene]
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "SCHEME",
        allow_hyphen_values = true
    )]
    scheme: Vec<String>,

    /// An offset of your own as a command that answers hit points over its pipes (docs/guide/offset.md), with a
    /// name: mine=./mine; may be repeated
    #[arg(long, value_name = "NAME=COMMAND")]
    scheme_cmd: Vec<String>,

    /// How hit points are formed: uv (from the vertices and u, v), ray (o + t*d), or both
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "POINT",
        default_value = "uv,ray"
    )]
    point: Vec<String>,

    /// A wall in front of every triangle, this many of its longest edges away: starts beyond it are counted
    #[arg(
        long,
        value_name = "EDGES",
        default_value = "0.01",
        allow_hyphen_values = true
    )]
    wall: String,

    /// A neighbour on the edge nearest to each hit point, folded up to this angle with the triangle: starts behind
    /// it are counted
    #[arg(
        long,
        value_name = "DEGREES",
        default_value = "45",
        allow_hyphen_values = true
    )]
    fold: String,

    /// f32, f64, or f32,f64 [default: f32, or f64 where no kernel runs in f32]
    #[arg(long, value_delimiter = ',', value_name = "SCALAR", help_heading = RUNNING)]
    scalar: Vec<String>,

    /// How many first rays
    #[arg(
        long,
        short = 'n',
        default_value = "200000",
        value_name = "N",
        value_parser = case_count,
        allow_hyphen_values = true
    )]
    count: u64,

    /// Seed of the random rays
    #[arg(long, default_value_t = 1, help_heading = RUNNING)]
    seed: u64,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Schemes are run on the pilots, and on what is reported. Those that are made for the scene are chosen in between, on few
/// rays.
const PASSES_OF_SCHEMES: u64 = 2;

/// Segments are drawn for the pilots, and for what is reported.
const PASSES_OF_SEGMENTS: u64 = 2;

/// The kernel that runs if nobody names one.
const DEFAULT_KERNEL: &str = "moller-trumbore";

/// Runs the command.
pub fn run(arguments: &OffsetArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let threads = set_threads(arguments.threads)?;
    let rows = arguments.rows()?;
    let scalars = one_scalar(&rows, &arguments.scalar)?;
    refuse_wrong_values(&rows, scalars)?;
    let (scene, scalars, unit, mesh) = arguments.first_rays(scalars)?;
    let instance = matrix_in(arguments.instance.as_deref(), scalars)?;
    let kinds = arguments.kinds()?;
    let distance = "a distance above 0 in longest edges, such as 0.01";
    let wall = number_below("--wall", &arguments.wall, f64::INFINITY, distance)?;
    let angle = "an angle between 0 and 180 degrees, such as 45";
    let fold = number_below("--fold", &arguments.fold, 180.0, angle)?;
    // A mesh has planes of its own.
    let scenes = match Scene::names_kind(&arguments.scene) || mesh.is_some() {
        true => vec![scene.clone()],
        false => scene.of_all_kinds(),
    };
    let commands = arguments.commands()?;
    let schemes = arguments.schemes()?;
    // Schemes are chosen and made on other rays than those that are reported.
    let pilot_seed = fresh_seed(arguments.seed);
    let mut studies: Vec<(OffsetPlan<'_>, ScalarName)> = Vec::new();
    for row in &rows {
        for &kind in kinds.iter().filter(|kind| kind.is_given_by(row.entry)) {
            let plan = OffsetPlan {
                row,
                scene: &scenes[0],
                mesh: mesh.as_ref(),
                kind,
                schemes: &schemes,
                wall,
                fold,
                instance,
                with_least: arguments.makes_schemes(),
                with_heights: false,
                seed: pilot_seed,
                count: arguments.count,
            };
            let runs = |name: &ScalarName| in_named_scalar!(*name, F => has::<F>(&schemes));
            studies.extend(
                scalars_of(row.entry, scalars)
                    .filter(runs)
                    .map(|name| (plan, name)),
            );
        }
    }
    if studies.is_empty() {
        let message = "nothing to run: no kernel gives such hit points, or no scheme runs in the chosen scalars";
        return Err(Failure::nothing(message));
    }
    let kernels: usize = rows
        .iter()
        .map(|row| scalars_of(row.entry, scalars).count())
        .sum();
    let runs = studies.len() as u64 * PASSES_OF_SCHEMES + kernels as u64 * PASSES_OF_SEGMENTS;
    let total = runs * scenes.len() as u64 * arguments.count;
    let progress = Progress::new(total, "first rays", arguments.output.quiet);
    let study = |(plan, name): &(OffsetPlan<'_>, ScalarName)| in_named_scalar!(*name, F => arguments.study::<F>(plan, &scenes, &progress));
    let points = studies.iter().map(study).collect();
    let segments = arguments.segments(&rows, scalars, &scenes, mesh.as_ref(), &progress);
    progress.finish();
    for (name, command) in commands {
        if let Some(fault) = command.fault() {
            return Err(Failure::bad_input(format!("scheme '{name}': {fault}")));
        }
    }
    let result = OffsetResult {
        scene: scene.to_string(),
        mesh: arguments.mesh.clone(),
        unit: unit.to_owned(),
        seed: arguments.seed,
        pilot_seed,
        count: arguments.count,
        wall,
        fold,
        instance,
        planes: scenes
            .iter()
            .map(|scene| scene.kind().to_string())
            .collect(),
        points,
        segments,
    };
    let context = Context {
        seconds: progress.seconds(),
        threads,
    };
    arguments
        .output
        .write(outputs, &Record::new(result, provenance_of(&context)))?;
    Ok(Status::Success)
}

/// Where first rays come from: a scene, the scalars of the run that can hold it, its unit of length, and the mesh that it
/// is, if it is one.
type FirstRays = (Scene, [bool; 2], &'static str, Option<Arc<SceneMesh>>);

/// True if any scheme runs in a scalar.
fn has<F: Scalar>(schemes: &[Scheme]) -> bool {
    schemes.iter().any(|scheme| scheme.offset::<F>().is_some())
}

/// The number of a flag, above 0 and below a limit; `expected` says so.
fn number_below(flag: &str, text: &str, limit: f64, expected: &str) -> Result<f64, Failure> {
    let number = text
        .trim()
        .parse()
        .ok()
        .filter(|number| 0.0 < *number && *number < limit);
    number.ok_or_else(|| Failure::usage(format!("{flag}: '{text}' is not {expected}")))
}

/// A plan in each of some scenes.
fn on_each<'a>(scenes: &'a [Scene], plan: &OffsetPlan<'a>) -> Vec<OffsetPlan<'a>> {
    scenes
        .iter()
        .map(|scene| OffsetPlan { scene, ..*plan })
        .collect()
}

impl OffsetArguments {
    /// Runs the schemes of a plan on its rays in each scene, the first of which the table is about, makes others for what is
    /// seen there, and runs all on the rays that are reported.
    fn study<F: Advised>(
        &self,
        plan: &OffsetPlan<'_>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> PointsPart {
        let gives_t = plan.row.entry.info.gives.t;
        let is_for = |s: &&Scheme| s.offset::<F>().is_some() && (gives_t || !needs_t(&s.name));
        let mut schemes: Vec<Scheme> = plan.schemes.iter().filter(is_for).cloned().collect();
        let run = |plans: &[OffsetPlan<'_>]| -> Vec<OffsetSums> {
            plans.iter().map(|plan| F::offset(plan, progress)).collect()
        };
        let pilots = run(&on_each(
            scenes,
            &OffsetPlan {
                schemes: &schemes,
                ..*plan
            },
        ));
        let (given, derived) = (schemes.len(), DerivedPart::of::<F>(plan, &pilots));
        if self.makes_schemes() {
            let made = made_for(&pilots, derived.as_ref().map(|derived| derived.normal));
            let plans = on_each(scenes, plan);
            for of_kind in made {
                schemes.extend(F::first_without_failure(&plans, &of_kind, &Unobserved));
            }
        }
        let made: Vec<usize> = (given..schemes.len()).collect();
        let mut plans = on_each(
            scenes,
            &OffsetPlan {
                schemes: &schemes,
                seed: self.seed,
                ..*plan
            },
        );
        // How much a hit point needs, and how high starts lie, is reported of the first kind of plane.
        for (place, plan) in plans.iter_mut().enumerate() {
            plan.with_least = place == 0;
            plan.with_heights = place == 0;
        }
        let sums = run(&plans);
        PointsPart::new::<F>(&plans, [&pilots, &sums], &made, derived, &self.place())
    }

    /// Where segments end that go to the hit points of each kernel; in an instance, and beside schemes that are named, nobody
    /// asks.
    fn segments(
        &self,
        rows: &[Row],
        scalars: [bool; 2],
        scenes: &[Scene],
        mesh: Option<&Arc<SceneMesh>>,
        progress: &Progress,
    ) -> Vec<SegmentsPart> {
        if self.instance.is_some() || !self.makes_schemes() {
            return Vec::new();
        }
        let seeds = [fresh_seed(self.seed), self.seed];
        let mut parts = Vec::new();
        for row in rows {
            let count = self.count;
            let plan = SegmentPlan {
                row,
                scene: &scenes[0],
                mesh,
                ends: &[],
                seed: 0,
                count,
            };
            for name in scalars_of(row.entry, scalars) {
                parts.push(in_named_scalar!(name, F => {
                    SegmentsPart::study::<F>(&plan, scenes, seeds, progress)
                }));
            }
        }
        parts
    }

    /// True if offsets are made for the scene besides the published ones.
    fn makes_schemes(&self) -> bool {
        self.scheme.is_empty()
    }

    fn rows(&self) -> Result<Vec<Row>, Failure> {
        let rows = self
            .kernels
            .rows_without_band("it means nothing for the start of a ray")?;
        if self.kernels.names_kernels() || rows.iter().any(|row| !row.entry.is_built_in()) {
            return Ok(rows);
        }
        Ok(rows
            .into_iter()
            .filter(|row| row.entry.info.name == DEFAULT_KERNEL)
            .collect())
    }

    /// The flags that name the scene or the mesh.
    fn place(&self) -> String {
        let mesh = self
            .mesh
            .as_ref()
            .map(|path| format!("--mesh {} ", shell_word(path)));
        let instance = self.instance.as_ref();
        let instance = instance.map(|words| format!(" --instance {}", shell_word(words)));
        let (mesh, instance) = (mesh.unwrap_or_default(), instance.unwrap_or_default());
        format!("{mesh}--scene {}{instance}", shell_word(&self.scene))
    }

    fn first_rays(&self, scalars: [bool; 2]) -> Result<FirstRays, Failure> {
        if let Some(path) = &self.mesh {
            let (scene, mesh) = mesh_scene(path, Some(&self.scene), scalars, self.output.quiet)?;
            return Ok((scene, scalars, "", Some(mesh)));
        }
        let (scene, unit) = Scene::parse(&self.scene).map_err(about_scene)?;
        let (scalars, left_out) = scene.held_in(scalars).map_err(about_scene)?;
        if !self.output.quiet {
            left_out.iter().for_each(|why| eprintln!("left out: {why}"));
            note_left_out(&scene, &self.scene);
        }
        Ok((scene, scalars, unit, None))
    }

    fn kinds(&self) -> Result<Vec<PointKind>, Failure> {
        let chosen = |name: &String| {
            let message = || format!("--point: unknown point '{name}': there are uv and ray");
            PointKind::named(name).ok_or_else(|| Failure::usage(message()))
        };
        refuse_twice("--point", &self.point)?;
        self.point.iter().map(chosen).collect()
    }

    /// Starts the commands that answer for offsets, and makes their names known.
    fn commands(&self) -> Result<Vec<(String, OffsetCommand)>, Failure> {
        let started = |text: &String| {
            let wrong = |error: String| Failure::usage(format!("--scheme-cmd '{text}': {error}"));
            let missing = || wrong("write NAME=COMMAND, as mine=./mine".to_owned());
            let (name, line) = text.split_once('=').ok_or_else(missing)?;
            let name = name.trim();
            let program = KernelProgram::parse(line).map_err(wrong)?;
            let command = OffsetCommand::new(program);
            let scheme = Scheme::own(name).f32(command.clone()).f64(command.clone());
            let flags = format!("--scheme-cmd {} --scheme {name}", shell_word(text));
            register(scheme.chosen_by(flags)).map_err(wrong)?;
            command.start().map_err(|error| {
                let message = format!("{line}: it cannot be started: {error}");
                Failure::Message(Status::InputOutput, message)
            })?;
            Ok((name.to_owned(), command))
        };
        self.scheme_cmd.iter().map(started).collect()
    }

    fn schemes(&self) -> Result<Vec<Scheme>, Failure> {
        if self.scheme.is_empty() {
            return Ok(default_schemes());
        }
        let of_commands = self
            .scheme_cmd
            .iter()
            .filter_map(|command| command.split_once('='));
        let of_commands = of_commands.map(|(name, _)| name.trim().to_owned());
        let more = of_commands.filter(|name| !self.scheme.contains(name));
        let chosen =
            self.scheme.iter().cloned().chain(more).map(|text| {
                parse(&text).map_err(|error| Failure::usage(format!("--scheme: {error}")))
            });
        let chosen: Vec<Scheme> = chosen.collect::<Result<_, _>>()?;
        let names: Vec<&String> = chosen.iter().map(|scheme| &scheme.name).collect();
        refuse_twice("--scheme", &names)?;
        Ok(chosen)
    }
}
