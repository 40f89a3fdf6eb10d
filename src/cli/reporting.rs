//! The parts that `audit`, `check` and `merge` share: the flags of a run, its record, and where that goes.

use super::before::{
    count_indices, note_secondary_rays, scalars_in_use, set_threads, total_indices,
};
use super::exit::{Failure, Status};
use super::flags::{OUTPUT, RUNNING, again, matrix_in, parsed};
use super::output::{OutputArguments, write_failure};
use super::plugins;
use super::progress::Progress;
use super::prove;
use super::select::KernelArguments;
use super::sources::{SourceArguments, rays_at_each};
use crate::arith::ScalarName;
use crate::audit::{self, Audit, Plan, Shard, Source};
use crate::record::{
    Context, Illustrations, PartialPart, PlanFlags, Record, build, drawing, group_digits,
    number_of, shard_part,
};
use crate::report::{FORMATS, Format, HTML, ON_FAILURE};
use clap::{Args, ValueEnum};

/// On how many indices of each source the errors of right hits are measured.
pub const MEASURED: usize = 100;

/// The flags that say how to report.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, junit, sarif, markdown or html, or several separated by commas")
}))]
pub struct ReportArguments {
    #[command(flatten)]
    pub output: OutputArguments,

    /// When to draw the worst cases and to say what is proved, on the HTML report; auto: for --format html
    #[arg(long, value_enum, default_value_t, help_heading = OUTPUT)]
    illustrate: IllustrateChoice,
}

/// When to illustrate a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, ValueEnum)]
enum IllustrateChoice {
    /// Where a format shows it.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// Where a record goes.
pub struct Outputs<'a> {
    pairs: Vec<(&'static Format, &'a str)>,
    illustrate: bool,
    flags: &'a OutputArguments,
}

impl ReportArguments {
    /// Checks the flags, before anything runs.
    pub fn outputs(&self) -> Result<Outputs<'_>, Failure> {
        let pairs = self.output.pairs(FORMATS)?;
        let illustrate = match self.illustrate {
            IllustrateChoice::Auto => pairs.iter().any(|(format, _)| format.name == HTML),
            choice => choice == IllustrateChoice::Always,
        };
        Ok(Outputs {
            pairs,
            illustrate,
            flags: &self.output,
        })
    }
}

impl Outputs<'_> {
    /// True if the record is to hold the data for pictures.
    pub fn illustrate(&self) -> bool {
        self.illustrate
    }

    /// The outcome of a run. If it failed, the formats that a CI reads say so.
    pub fn told(&self, outcome: Result<Status, Failure>) -> Result<Status, Failure> {
        if let Err(Failure::Message(status, message)) = &outcome {
            let told = self.pairs.iter().filter_map(|(format, path)| {
                let (_, write) = ON_FAILURE.iter().find(|(name, _)| *name == format.name)?;
                Some((write, *path))
            });
            // The first failure is the one to tell.
            let _ = write_failure(told.collect(), |write, _, out| {
                write(*status as u8, message, out)
            });
        }
        outcome
    }

    /// The same without files, and without what a failure is written to.
    pub fn on_screen(&self) -> Self {
        let tells_failure =
            |format: &Format| ON_FAILURE.iter().any(|(name, _)| *name == format.name);
        let to_screen = self
            .pairs
            .iter()
            .filter(|(format, path)| *path == "-" && !tells_failure(format));
        Outputs {
            pairs: to_screen.copied().collect(),
            ..*self
        }
    }

    /// Writes a record to each.
    pub fn write(&self, record: &Record) -> Result<(), Failure> {
        self.flags.write(self.pairs.clone(), record)
    }
}

/// The flags that say what to run and how to report: of `audit` and `check`.
#[derive(Args)]
pub struct RunArguments {
    #[command(flatten)]
    pub kernels: KernelArguments,

    #[command(flatten)]
    sources: SourceArguments,

    /// How many rays at each edge and vertex of a mesh, from 1 to 65536: exact and near, grazing and not,
    /// in turn
    #[arg(long, default_value_t = 8, value_name = "N", allow_hyphen_values = true, value_parser = rays_at_each(), help_heading = RUNNING)]
    directions: u64,

    /// Put all triangles into the world by a 3x4 matrix, row by row, as "m00, …, m23": kernels get the rays, which are
    /// of the world, by the rounded inverse
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true, help_heading = RUNNING)]
    instance: Option<String>,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N", help_heading = OUTPUT)]
    examples: usize,

    /// Run only part K of N, counted from 0; `hairline merge` makes one record of all parts
    #[arg(long, value_name = "K/N", help_heading = RUNNING)]
    shard: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N", help_heading = RUNNING)]
    threads: Option<usize>,

    #[command(flatten)]
    pub report: ReportArguments,
}

impl RunArguments {
    /// The plan of the flags, with this many findings of each class attributed.
    pub fn plan(&self, attribute: usize) -> Result<Plan, Failure> {
        // Before anything runs on all threads, as the reading of a mesh does.
        set_threads(self.threads)?;
        self.kernels.plugins.run_long();
        let rows = self.kernels.rows()?;
        let scalars = scalars_in_use(&rows, self.sources.scalars()?)?;
        let sources = self.sources.sources(self.report.output.quiet)?;
        let others = match self.sources.names_kind() {
            true => Vec::new(),
            false => sources.iter().flat_map(Source::in_other_kinds).collect(),
        };
        let with_parts = |source: Source| {
            let parts = source.mesh_parts(self.directions, scalars);
            std::iter::once(source).chain(parts)
        };
        let sources = sources.into_iter().flat_map(with_parts).chain(others);
        let sources = match matrix_in(self.instance.as_deref(), scalars)? {
            Some(matrix) => sources.map(|source| source.placed(matrix)).collect(),
            None => sources.collect(),
        };
        Ok(Plan {
            attribute,
            ..Plan::new(rows, sources, scalars, self.examples)
        })
    }

    /// The flags that choose the cases again.
    fn source_flags(&self) -> String {
        let directions = (self.directions != 8).then(|| self.directions.to_string());
        let others = [
            again("--directions", &directions),
            again("--instance", &self.instance),
        ];
        [self.sources.flags(), others.concat()].concat().join(" ")
    }

    /// Runs a plan and makes its record, illustrated if asked.
    pub fn execute(&self, plan: &Plan, illustrate: bool) -> Result<Record, Failure> {
        total_indices(&plan.sources, plan.scalars)?;
        let flags = PlanFlags {
            kernels: self.kernels.flags(),
            sources: self.source_flags(),
            // No epsilon is chosen in instances.
            epsilon: self
                .instance
                .is_none()
                .then(|| self.sources.epsilon_flags().join(" ")),
        };
        let run = Execution {
            plan,
            kernels: &self.kernels,
            shard: parsed("--shard", self.shard.as_deref())?,
            quiet: self.report.output.quiet,
            illustrate,
        };
        let mut record = run.record()?;
        record.provenance.plan_flags = Some(flags);
        Ok(record)
    }
}

/// A plan to run, or a part of it.
pub struct Execution<'a> {
    pub plan: &'a Plan,
    pub kernels: &'a KernelArguments,
    /// The part that runs, if not the whole.
    pub shard: Option<Shard>,
    pub quiet: bool,
    /// True if the record is to hold the data for pictures.
    pub illustrate: bool,
}

impl Execution<'_> {
    /// Runs it and makes its record.
    pub fn record(&self) -> Result<Record, Failure> {
        let Execution {
            plan,
            kernels,
            shard,
            quiet,
            ..
        } = *self;
        let threads = rayon::current_num_threads();
        let total = count_indices(&plan.sources, plan.scalars);
        if !quiet {
            note_secondary_rays(&plan.rows, &plan.sources);
            let rows = number_of(plan.rows.len() as u64, "kernel row", "kernel rows");
            let sources = number_of(
                plan.sources.len() as u64,
                "source of cases",
                "sources of cases",
            );
            let threads = number_of(threads as u64, "thread", "threads");
            let scalars: Vec<&str> = ScalarName::among(plan.scalars)
                .map(ScalarName::name)
                .collect();
            eprintln!(
                "{rows} on {sources} in {}: {} rays{}, {threads}",
                scalars.join(" and "),
                group_digits(total),
                shard.map_or(String::new(), |shard| format!(", of them shard {shard}"))
            );
        }
        let progress = Progress::new(total, "rays", quiet);
        let mut sums = audit::sum(plan, shard.unwrap_or(Shard::WHOLE), &progress);
        let part = shard.map(|_| shard_part(plan, &sums));
        audit::finish(plan, &progress, &mut sums);
        progress.finish();
        plugins::check()?;
        let seconds = progress.seconds();
        let mut record = build(plan, &sums, &Context { seconds, threads });
        (record.result.partial, record.shard) = (shard.map(PartialPart::from), part);
        record.provenance.kernel_files = kernels.plugins.files();
        // Of the whole plan: a part of a run leaves it to `merge`.
        if self.illustrate && shard.is_none() {
            let progress = Progress::without_end("what is proved of the kernels", quiet);
            illustrate(plan, &sums, &mut record);
            progress.finish();
        }
        Ok(record)
    }
}

/// Adds the data for pictures: of a plan for a mesh its drawing, otherwise the proofs about the kernels.
pub fn illustrate(plan: &Plan, sums: &Audit, record: &mut Record) {
    record.drawing = drawing(plan, sums);
    if record.drawing.is_none() {
        let proofs = prove::proofs(&plan.rows, plan.scalars);
        record.illustrations = Some(Illustrations { proofs });
    }
}

/// A family that breaks its own promise is a fault of this tool.
pub fn self_check(record: &Record) -> Result<(), Failure> {
    let broken = |source: &&crate::record::SourcePart| source.promises && source.promise_broken > 0;
    match record.result.sources.iter().find(broken) {
        None => Ok(()),
        Some(source) => {
            let first = source.first_broken.as_deref().unwrap_or("-");
            let message = format!(
                "self-check: family '{}' breaks its promise, first at {first}",
                source.family
            );
            Err(Failure::self_check(message))
        }
    }
}
