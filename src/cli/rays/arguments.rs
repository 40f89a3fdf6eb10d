//! The flags of `rays`, and which of them go together.

use super::program::ProgramArguments;
use crate::cli::exit::Failure;
use crate::cli::flags::unknown;
use crate::cli::known::Blessing;
use crate::cli::output::OutputArguments;
use crate::record::group_digits;
use clap::Args;
use hairline_rays::AnswerKind;
use hairline_scene::RayKind;
use std::iter;

/// Which mesh, which rays, whose answers.
#[derive(Args)]
pub struct RaysArguments {
    /// The mesh: an OBJ, PLY, STL or glTF file (.gltf or .glb); - is standard input
    #[arg(value_name = "MESH")]
    pub(super) mesh: String,

    /// The rays, one a line: origin and direction as six numbers, or eight with t_min and t_max; or JSON with the fields
    /// origin, direction, t_min and t_max
    #[arg(value_name = "RAYS")]
    pub(super) rays: Option<String>,

    /// One ray instead, as "ox,oy,oz dx,dy,dz" or with t_min,t_max behind: everything about it
    #[arg(long, value_name = "RAY", conflicts_with_all = ["rays", "answers", "points"], allow_hyphen_values = true)]
    pub(super) ray: Option<String>,

    /// Points instead of rays, three numbers a line: inside, outside or on the surface
    #[arg(long, value_name = "FILE", conflicts_with = "rays")]
    pub(super) points: Option<String>,

    /// Make so many rays at the mesh instead, as CSV: ask your program about them
    #[arg(long, value_name = "N", conflicts_with_all = ["rays", "ray", "answers", "points"])]
    pub(super) make: Option<u64>,

    /// Which rays to make: random, vertex, edge, axis, plane (in that of a face), surface (from face to face) [default: all in turn]
    #[arg(
        long,
        value_name = "KIND,...",
        value_delimiter = ',',
        requires = "make"
    )]
    pub(super) kinds: Vec<String>,

    /// Seed of the rays that are made [default: 1]
    #[arg(long, value_name = "SEED", requires = "make")]
    pub(super) seed: Option<u64>,

    #[command(flatten)]
    pub(super) answered: AnswerArguments,

    #[command(flatten)]
    pub(super) program: ProgramArguments,

    /// f32 or f64: what the numbers of mesh and rays are rounded to first [default: f64; for --answers the one in which more
    /// are right]
    #[arg(long, value_name = "SCALAR")]
    pub(super) scalar: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) threads: Option<usize>,

    #[command(flatten)]
    pub(super) output: OutputArguments,
}

/// Whose answers are judged, and what is known of them.
#[derive(Args)]
pub struct AnswerArguments {
    /// A program's answers, one a line in the order of the rays: the nearest face's number from 0 (-1 for a miss), and its t
    /// if there is one; or JSON with the fields face and t
    #[arg(long, value_name = "FILE", help_heading = ANSWERS)]
    pub(super) answers: Option<String>,

    /// Answers of another kind: any (1 for a hit, 0 for none), all (every hit a line: ray, face, t), count (of hits), or
    /// inside (inside, outside or on; of --points); all without --answers writes every exact hit [default: nearest]
    #[arg(long, value_name = "KIND", help_heading = ANSWERS)]
    pub(super) answered: Option<String>,

    /// How the program moves and scales mesh and rays before it computes, as "move=-5,0,2 scale=0.001": answers are judged by that
    /// scene too
    #[arg(long, value_name = "STEPS", requires = "answers", conflicts_with = "points", help_heading = ANSWERS)]
    pub(super) given: Option<String>,

    /// Known wrong answers: fail only if there are more, and with 3 if there are fewer
    #[arg(long, value_name = "FILE", help_heading = ANSWERS)]
    pub(super) known: Option<String>,

    #[command(flatten)]
    pub(super) blessing: Blessing,
}

/// The heading of these flags in the help.
const ANSWERS: &str = "Answers of a program";

/// The most rays that are made: they are held in memory.
const MOST: u64 = 50_000_000;

impl RaysArguments {
    /// An error if standard input is two files, or if a result would take the place of one of the files that are read.
    pub(super) fn check_files(&self) -> Result<(), Failure> {
        let AnswerArguments { answers, known, .. } = &self.answered;
        let others = [&self.rays, &self.points, answers, known];
        let read = || iter::once(&self.mesh).chain(others.into_iter().flatten());
        if 1 < read().filter(|file| *file == "-").count() {
            return Err(Failure::usage(
                "-: standard input is named twice; give a file for one of them",
            ));
        }
        match self.make {
            Some(0) => Err(Failure::usage("--make 0: at least 1")),
            Some(count) if MOST < count => Err(Failure::usage(format!(
                "--make {count}: at most {}, which fill memory; use several seeds",
                group_digits(MOST)
            ))),
            _ => self.output.keeps(read()),
        }
    }

    /// True if answers are judged: those of a file, or of a program that hairline runs.
    pub(super) fn is_judged(&self) -> Result<bool, Failure> {
        let has_answers = self.answered.answers.is_some() || self.program.is_given();
        self.answered
            .blessing
            .needs(self.answered.known.as_deref())?;
        let asks_for_all = !self.program.is_given() && self.rays.is_some();
        match &self.answered.answered {
            Some(_) if self.answered.answers.is_some() => {}
            Some(kind) if asks_for_all && ["nearest", "all"].contains(&kind.as_str()) => {}
            Some(_) if self.program.is_given() => {
                return Err(Failure::usage(
                    "--answered: a plain program answers nearest hits",
                ));
            }
            Some(kind) => {
                return Err(Failure::usage(format!(
                    "--answered {kind}: whose answers? Give them with --answers; without them a file of rays has the nearest hits, or all"
                )));
            }
            None => {}
        }
        let is_about_made_rays = !self.kinds.is_empty() || self.seed.is_some();
        if is_about_made_rays && self.make.is_none() {
            return Err(Failure::usage(
                "--kinds and --seed are about rays that are made: give --make N too",
            ));
        }
        if self.answered.known.is_some() && !has_answers {
            return Err(Failure::usage(
                "--known: whose answers? Give them with --answers, or --kernel",
            ));
        }
        let has_questions = self.rays.is_some() || self.points.is_some() || self.make.is_some();
        if has_answers && !has_questions {
            return Err(Failure::usage(
                "answers to which rays? Give the file of them too",
            ));
        }
        Ok(has_answers)
    }

    /// The kind of the answers.
    pub(super) fn kind(&self) -> Result<AnswerKind, Failure> {
        let kind = match (&self.answered.answered, &self.points) {
            (Some(name), _) => AnswerKind::named(name).ok_or_else(|| {
                let names = AnswerKind::ALL.map(AnswerKind::name);
                unknown("kind of answers", name, names, "hairline rays --help")
            })?,
            (None, Some(_)) => AnswerKind::Inside,
            (None, None) => AnswerKind::Nearest,
        };
        match (kind, self.points.is_some()) {
            (AnswerKind::Inside, false) => Err(Failure::usage(
                "--answered inside: of which points? Give --points FILE in place of rays",
            )),
            (AnswerKind::Inside, true) | (_, false) => Ok(kind),
            (_, true) => Err(Failure::usage(format!(
                "--answered {kind}: points are inside or outside"
            ))),
        }
    }
}

/// The kinds of rays of these names; all without names.
pub(super) fn kinds(names: &[String]) -> Result<Vec<RayKind>, Failure> {
    if names.is_empty() {
        return Ok(RayKind::ALL.to_vec());
    }
    let named = |name: &String| {
        RayKind::named(name).ok_or_else(|| {
            let names = RayKind::ALL.map(RayKind::name);
            unknown("kind of rays", name, names, "hairline rays --help")
        })
    };
    names.iter().map(named).collect()
}
