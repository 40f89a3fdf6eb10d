//! `hairline rays`: what rays really meet in a mesh, and what another program should have answered.

mod arguments;
mod program;
mod readings;

use super::before::set_threads;
use super::exit::{Failure, Status};
use super::flags::find_scalar;
use super::input::{open, read_mesh};
use super::known::{KnownCounts, KnownSubject};
use super::progress::Progress;
use crate::arith::ScalarName;
use crate::expect::RecordComparison;
use crate::files::InputError;
use crate::files::mesh::Mesh;
use crate::record::{Context, Record, provenance_of};
use crate::report::{Format, write_junit};
pub use arguments::RaysArguments;
use arguments::{AnswerArguments, kinds};
use hairline_rays::{
    AllHits, AnswerKind, Answers, Asked, BadRay, FoundHits, GivenSteps, JudgedRun, Judgements,
    LocatedPoints, MadeRays, PlainProgram, RaysResult, RaysScalar, Text, answers, ray_of_words,
};
use hairline_scene::{Judgement, NoTargets, Ray, Scene};
use std::time::Instant;

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
    is_name: |name| Judgement::named(name).is_some_and(Judgement::is_wrong),
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
        given: None,
        threads,
        tells_each: arguments.output.writes("csv"),
    };
    if arguments.is_judged()? {
        return run.judge(scalar);
    }
    match scalar {
        Some(ScalarName::F32) => run.answer::<f32>(),
        Some(ScalarName::F64) | None => run.answer::<f64>(),
    }
}

/// A run of the command.
#[derive(Clone, Copy)]
struct RaysRun<'a> {
    arguments: &'a RaysArguments,
    mesh: &'a Mesh,
    /// The steps that made the mesh, if it is not the one that was read, and the scalar in which they are computed.
    given: Option<(&'a GivenSteps, ScalarName)>,
    threads: usize,
    /// True if a line for each answer is written.
    tells_each: bool,
}

impl<'a> RaysRun<'a> {
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
            let ray = ray_of_words::<F>(text)
                .map_err(|message| Failure::usage(format!("--ray: {message}")))?;
            let outputs = output.pairs(Format::OF_PAGE)?;
            let told = F::told(self.mesh, &scene, &ray)
                .map_err(|error| Failure::usage(format!("--ray: {error}")))?;
            output.write(outputs, &told)?;
            return Ok(Status::Success);
        }
        match self.asked::<F>()? {
            Asked::Rays(rays) if self.arguments.kind()? == AnswerKind::All => {
                let outputs = output.pairs(AllHits::FORMATS)?;
                let found = self.shown(|| F::found_all(&scene, &rays));
                let found = found.map_err(|bad| self.bad(bad))?;
                output.write(outputs, &found)?;
            }
            Asked::Rays(rays) => {
                let outputs = output.pairs(FoundHits::FORMATS)?;
                let found = self.shown(|| F::found(&scene, &rays));
                let found = found.map_err(|bad| self.bad(bad))?;
                output.write(outputs, &found)?;
            }
            Asked::Points(points) => {
                let outputs = output.pairs(LocatedPoints::FORMATS)?;
                let located = self.shown(|| F::located(&scene, &points));
                let located = located.map_err(|bad| self.bad(bad))?;
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
        output.write(outputs, &Record::new(result, provenance))?;
        Ok(status)
    }

    fn summary<F: RaysScalar>(&self, judgements: &Judgements<F>) -> Result<RaysResult, Failure> {
        if let Some(message) = judgements.no_hits() {
            let file = self.arguments.answered.answers.as_deref();
            return Err(InputError::of(file.unwrap_or_default(), message).into());
        }
        F::summary(judgements).map_err(|bad| self.bad(bad))
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

    fn judged<F: RaysScalar>(&self) -> Result<Judgements<'a, F>, Failure> {
        let scene = self.scene::<F>()?;
        let asked = self.asked::<F>()?;
        let program = match self.arguments.program.is_given() {
            true => Some(self.arguments.program.program::<F>()?),
            false => None,
        };
        let run = JudgedRun {
            mesh: self.mesh,
            scene,
            answers: self.answers(&asked, program.as_ref())?,
            asked,
            given: self.given.map(|(steps, scalar)| steps.scene(scalar)),
            program,
            tells_each: self.tells_each,
        };
        self.shown(|| F::judged(run)).map_err(|bad| self.bad(bad))
    }

    /// The result of some work, with a line on a terminal as long as it takes.
    fn shown<T>(&self, work: impl FnOnce() -> T) -> T {
        let quiet = self.arguments.output.quiet || self.arguments.program.is_given();
        let progress = Progress::without_end("what the rays meet, exactly", quiet);
        let found = work();
        progress.finish();
        found
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
            let text = text(file.unwrap_or_default())?;
            return Ok(answers(text, kind, asked.count(), faces)?);
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

    /// The rays or points, as written or as they are given to the program.
    fn asked<F: RaysScalar>(&self) -> Result<Asked<F>, Failure> {
        Ok(match self.given {
            None => self.written()?,
            Some((steps, ScalarName::F64)) => steps.asked(&self.written::<f64>()?),
            Some((steps, ScalarName::F32)) => steps.asked(&self.written::<f32>()?),
        })
    }

    /// The rays or points of a file, or rays that are made.
    fn written<F: RaysScalar>(&self) -> Result<Asked<F>, Failure> {
        let RaysArguments {
            rays, points, make, ..
        } = self.arguments;
        if let Some(count) = make {
            return Ok(Asked::Rays(self.made(*count)?));
        }
        Ok(match points {
            Some(file) => Asked::Points(F::points_of(text(file)?)?),
            None => Asked::Rays(F::rays_of(text(rays.as_deref().unwrap_or_default())?)?),
        })
    }

    fn made<F: RaysScalar>(&self, count: u64) -> Result<Vec<Ray<F>>, Failure> {
        let kinds = kinds(&self.arguments.kinds)?;
        let seed = self.arguments.seed.unwrap_or(1);
        let made = self.shown(|| F::made(self.mesh, &kinds, count, seed));
        made.map_err(|error| {
            let of_scalar = match error {
                NoTargets::TooLarge => format!(" in {}", F::NAME),
                NoTargets::NoSize => String::new(),
            };
            InputError::of(&self.mesh.name, format!("{error}{of_scalar}")).into()
        })
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

/// A file of somebody else, to be read line by line.
fn text(file: &str) -> Result<Text<'_>, Failure> {
    Ok(Text {
        name: file,
        bytes: open(file)?,
    })
}
