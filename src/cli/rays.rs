//! `hairline rays`: what rays really meet in a mesh, and what another program should have answered.

mod answers;
mod program;
mod read;

use super::before::set_threads;
use super::exit::{Failure, Status};
use super::flags::{find_scalar, unknown};
use super::input::read_mesh;
use super::known::{Blessing, KnownCounts, KnownSubject};
use super::output::OutputArguments;
use crate::arith::ScalarName;
use crate::expect::RecordComparison;
use crate::files::InputError;
use crate::files::mesh::Mesh;
use crate::record::{Context, Record, group_digits, provenance_of};
use crate::report::{Format, write_junit};
use clap::Args;
use hairline_rays::{
    AnswerKind, Answers, Asked, BadRay, FoundHits, JudgedRun, LocatedPoints, MadeRays,
    PlainProgram, RaysResult, RaysScalar, more_right,
};
use hairline_scene::{Judgement, NoTargets, Ray, RayKind, Scene, Targets};
use program::ProgramArguments;
use std::iter;
use std::time::Instant;

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

    /// Points instead of rays, three numbers a line: inside, outside or on the surface
    #[arg(long, value_name = "FILE", conflicts_with = "rays")]
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

    /// Seed of the rays that are made [default: 1]
    #[arg(long, value_name = "SEED", requires = "make")]
    seed: Option<u64>,

    #[command(flatten)]
    answered: AnswerArguments,

    #[command(flatten)]
    program: ProgramArguments,

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

/// Whose answers are judged, and what is known of them.
#[derive(Args)]
struct AnswerArguments {
    /// A program's answers, one a line in the order of the rays: the nearest face's number from 0 (-1 for a miss), and its t
    /// if there is one; or JSON with the fields face and t
    #[arg(long, value_name = "FILE", help_heading = ANSWERS)]
    answers: Option<String>,

    /// Answers of another kind: any (1 for a hit, 0 for none), all (every hit a line: ray, face, t), count (of hits), or
    /// inside (inside, outside or on; of --points) [default: nearest]
    #[arg(long, value_name = "KIND", requires = "answers", help_heading = ANSWERS)]
    answered: Option<String>,

    /// Known wrong answers: fail only if there are more, and with 3 if there are fewer
    #[arg(long, value_name = "FILE", help_heading = ANSWERS)]
    known: Option<String>,

    #[command(flatten)]
    blessing: Blessing,
}

/// The heading of these flags in the help.
const ANSWERS: &str = "Answers of a program";

/// The formats of judged answers.
const FORMATS: &[Format<Record<RaysResult>>] = &[
    Format::TEXT,
    Format::JSON,
    Format::MARKDOWN,
    Format::HTML,
    Format {
        name: "junit",
        write: |record, _, out| write_junit(&record.result.suites(), out),
    },
    Format {
        name: "csv",
        write: |record, _, out| record.result.write_csv(out),
    },
];

/// The file of known wrong answers.
const SUBJECT: KnownSubject = KnownSubject {
    schema: "hairline-rays/1",
    about: "Known wrong answers about rays at a mesh: `hairline rays --known` fails if there are more. --bless writes them.",
    parts: "judgements",
    choice: "the mesh, the file of rays (or --make and --seed), and --scalar say which",
};

/// Runs the command.
pub fn run(arguments: &RaysArguments) -> Result<Status, Failure> {
    let threads = set_threads(arguments.threads)?;
    let given = [&arguments.rays, &arguments.ray, &arguments.points];
    if arguments.make.is_none() && given.iter().all(|given| given.is_none()) {
        return Err(Failure::usage(
            "which rays? Give a file of them, one as --ray \"0,0,5 0,0,-1\", or --make 1000 -o rays.csv; --points FILE asks if points are \
             inside",
        ));
    }
    let scalar = arguments.scalar.as_deref().map(find_scalar).transpose()?;
    arguments.check_files()?;
    let mesh = read_mesh(&arguments.mesh, arguments.output.quiet)?;
    let run = RaysRun {
        arguments,
        mesh: &mesh,
        threads,
    };
    if arguments.is_judged()? {
        return run.judge(scalar);
    }
    match scalar {
        Some(ScalarName::F32) => run.answer::<f32>(),
        Some(ScalarName::F64) | None => run.answer::<f64>(),
    }
}

/// The most rays that are made: they are held in memory.
const MOST: u64 = 50_000_000;

impl RaysArguments {
    /// An error if standard input is two files, or if a result would take the place of one of the files that are read.
    fn check_files(&self) -> Result<(), Failure> {
        let AnswerArguments { answers, known, .. } = &self.answered;
        let others = [&self.rays, &self.points, answers, known];
        let read = || iter::once(&self.mesh).chain(others.into_iter().flatten());
        if 1 < read().filter(|file| *file == "-").count() {
            return Err(Failure::usage(
                "-: standard input is named twice; give a file for one of them",
            ));
        }
        match self.make {
            Some(count) if MOST < count => Err(Failure::usage(format!(
                "--make {count}: at most {}, which fill memory; use several seeds",
                group_digits(MOST)
            ))),
            _ => self.output.keeps(read()),
        }
    }

    /// True if answers are judged: those of a file, or of a program that hairline runs.
    fn is_judged(&self) -> Result<bool, Failure> {
        let has_answers = self.answered.answers.is_some() || self.program.is_given();
        self.answered
            .blessing
            .needs(self.answered.known.as_deref())?;
        if self.answered.answered.is_some() && self.answered.answers.is_none() {
            return Err(Failure::usage(
                "--answered: a plain program answers nearest hits",
            ));
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
    fn kind(&self) -> Result<AnswerKind, Failure> {
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

/// A run of the command.
struct RaysRun<'a> {
    arguments: &'a RaysArguments,
    mesh: &'a Mesh,
    threads: usize,
}

impl RaysRun<'_> {
    /// Answers the questions, or makes rays.
    fn answer<F: RaysScalar>(&self) -> Result<Status, Failure> {
        let RaysArguments { output, .. } = self.arguments;
        if let Some(count) = self.arguments.make {
            let outputs = output.pairs(MadeRays::<F>::FORMATS)?;
            output.write(outputs, &MadeRays(self.made::<F>(count)?))?;
            return Ok(Status::Success);
        }
        let scene = self.scene::<F>()?;
        if let Some(text) = &self.arguments.ray {
            let ray = read::ray_of_words::<F>(text)?;
            let outputs = output.pairs(Format::OF_PAGE)?;
            let told = F::told(self.mesh, &scene, &ray)
                .map_err(|error| Failure::usage(format!("--ray: {error}")))?;
            output.write(outputs, &told)?;
            return Ok(Status::Success);
        }
        match self.asked::<F>()? {
            Asked::Rays(rays) => {
                let outputs = output.pairs(FoundHits::FORMATS)?;
                let found = F::found(&scene, &rays).map_err(|bad| self.bad(bad))?;
                output.write(outputs, &found)?;
            }
            Asked::Points(points) => {
                let outputs = output.pairs(LocatedPoints::FORMATS)?;
                let located = F::located(&scene, &points).map_err(|bad| self.bad(bad))?;
                output.write(outputs, &located)?;
            }
        }
        Ok(Status::Success)
    }

    /// Judges answers: in a scalar, or else in the one in which more are right.
    fn judge(&self, scalar: Option<ScalarName>) -> Result<Status, Failure> {
        let RaysArguments {
            output, answered, ..
        } = self.arguments;
        let AnswerArguments {
            known, blessing, ..
        } = answered;
        let known = known
            .as_deref()
            .map(|file| KnownCounts::open(&SUBJECT, file, blessing))
            .transpose()?;
        if let Some(known) = known {
            let outputs = output.pairs(RecordComparison::FORMATS)?;
            return known.compare(self.judged_in(scalar)?, output, outputs);
        }
        let outputs = output.pairs(FORMATS)?;
        let start = Instant::now();
        let result = self.judged_in(scalar)?;
        let status = match (result.wrong_count(), result.count(Judgement::NotDefined)) {
            (0, 0) => Status::Success,
            // Nothing was held to anything.
            (0, _) => Status::BadInput,
            _ => Status::Disagreements,
        };
        let provenance = provenance_of(&Context {
            seconds: start.elapsed().as_secs_f64(),
            threads: self.threads,
        });
        output.write(outputs, &Record::new(result, provenance).sealed())?;
        Ok(status)
    }

    fn judged_in(&self, scalar: Option<ScalarName>) -> Result<RaysResult, Failure> {
        match scalar {
            Some(ScalarName::F32) => self.judged::<f32>(),
            Some(ScalarName::F64) => self.judged::<f64>(),
            // A program that hairline runs computes in f64, and standard input is read once.
            None if self.arguments.program.is_given() || self.reads_standard_input() => {
                self.judged::<f64>()
            }
            None => Ok(more_right(self.judged::<f64>()?, || self.judged::<f32>())),
        }
    }

    fn reads_standard_input(&self) -> bool {
        let RaysArguments {
            rays,
            points,
            answered,
            ..
        } = self.arguments;
        let files = [rays, points, &answered.answers];
        files.into_iter().flatten().any(|file| file == "-")
    }

    fn judged<F: RaysScalar>(&self) -> Result<RaysResult, Failure> {
        let scene = self.scene::<F>()?;
        let asked = self.asked::<F>()?;
        let program = match self.arguments.program.is_given() {
            true => Some(self.arguments.program.program::<F>()?),
            false => None,
        };
        let run = JudgedRun {
            mesh: self.mesh,
            scene: &scene,
            asked: &asked,
            answers: &self.answers(&asked, program.as_ref())?,
            program: program.as_ref(),
        };
        F::judged(&run).map_err(|bad| self.bad(bad))
    }

    /// The answers of a program that hairline runs, or else of a file.
    fn answers<F: RaysScalar>(
        &self,
        asked: &Asked<F>,
        program: Option<&PlainProgram>,
    ) -> Result<Answers, Failure> {
        let kind = self.arguments.kind()?;
        let Some(program) = program else {
            let file = self.arguments.answered.answers.as_deref();
            let faces = self.mesh.triangles.len();
            return answers::answers(file.unwrap_or_default(), kind, asked.count(), faces);
        };
        let Asked::Rays(rays) = asked else {
            return Err(Failure::usage("--kernel: it answers rays, not points"));
        };
        F::answered(program, self.mesh, rays).map_err(Failure::usage)
    }

    fn scene<F: RaysScalar>(&self) -> Result<Scene<F>, Failure> {
        let name = &self.mesh.name;
        let scene = F::scene(self.mesh).map_err(|error| InputError::of(name, error.to_string()))?;
        match scene.not_finite().first() {
            None => Ok(scene),
            Some(face) => {
                let message = format!(
                    "face {face}, counted from 0, has a coordinate beyond {}",
                    F::NAME
                );
                Err(InputError::of(name, message).into())
            }
        }
    }

    /// The rays or points of a file, or rays that are made.
    fn asked<F: RaysScalar>(&self) -> Result<Asked<F>, Failure> {
        let RaysArguments {
            rays, points, make, ..
        } = self.arguments;
        if let Some(count) = make {
            return Ok(Asked::Rays(self.made(*count)?));
        }
        match points {
            Some(file) => Ok(Asked::Points(read::points(file)?)),
            None => Ok(Asked::Rays(read::rays(
                rays.as_deref().unwrap_or_default(),
            )?)),
        }
    }

    fn made<F: RaysScalar>(&self, count: u64) -> Result<Vec<Ray<F>>, Failure> {
        let kinds = kinds(&self.arguments.kinds)?;
        let faces = 0..self.mesh.triangles.len();
        let triangles = faces.map(|face| self.mesh.vertices(face)).collect();
        let targets = Targets::<F>::new(triangles).map_err(|error| {
            let of_scalar = match error {
                NoTargets::TooLarge => format!(" in {}", F::NAME),
                NoTargets::NoSize => String::new(),
            };
            InputError::of(&self.mesh.name, format!("{error}{of_scalar}"))
        })?;
        Ok(targets.rays(&kinds, count, self.arguments.seed.unwrap_or(1)))
    }

    /// The failure of a ray or point that means nothing.
    fn bad(&self, BadRay { index, error }: BadRay) -> Failure {
        let RaysArguments { rays, points, .. } = self.arguments;
        if let Some(file) = points {
            let message = format!("point {index} has a coordinate that is not finite");
            return InputError::of(file, message).into();
        }
        let file = rays.as_deref().unwrap_or(&self.mesh.name);
        InputError::of(file, format!("ray {index}, counted from 0: {error}")).into()
    }
}

/// The kinds of rays of these names; all without names.
fn kinds(names: &[String]) -> Result<Vec<RayKind>, Failure> {
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
