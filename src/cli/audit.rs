//! `hairline audit`: kernels on families of cases, a mesh or a corpus.

use super::exit::{Failure, Status};
use super::input::{corpus_files, corpus_set, read_mesh};
use super::output::{ColorChoice, write_result};
use super::progress::Progress;
use super::select::{KernelArguments, case_count, chosen_scalars, unknown};
use crate::audit::{self, Plan, Source};
use crate::case::{Parameters, parse_offset, parse_power_of_two};
use crate::family::{FAMILIES, Family, MeshFamily, find};
use crate::report::{Context, FORMATS, Format, Record, Style, build};
use clap::Args;
use std::sync::Arc;

/// What to run, and how to report it.
#[derive(Args)]
pub struct AuditArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    /// f32, f64 or both
    #[arg(long, value_delimiter = ',', value_name = "SCALAR", default_value = "f32,f64")]
    scalar: Vec<String>,

    /// A case family, or several separated by commas [default: all, or none with --mesh or --corpus]
    #[arg(long, short, value_delimiter = ',', value_name = "NAME")]
    family: Vec<String>,

    /// Cases for each family
    #[arg(
        long,
        short = 'n',
        default_value = "20000",
        value_name = "N",
        allow_hyphen_values = true
    )]
    count: String,

    /// Every case of the lattice family instead of a sample
    #[arg(long)]
    exhaustive: bool,

    /// Which random cases
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Multiply all positions by a power of two, as 2^-10
    #[arg(long, default_value = "1", value_name = "2^K", allow_hyphen_values = true)]
    scale: String,

    /// Multiply the direction too
    #[arg(long)]
    scale_direction: bool,

    /// Add a vector to all positions, as 1e6:0:0
    #[arg(long, value_name = "X:Y:Z", allow_hyphen_values = true)]
    offset: Option<String>,

    /// `unit`: replace each direction by its rounded unit vector
    #[arg(long, value_name = "unit")]
    direction: Option<String>,

    /// Rays at the edges, vertices and faces of an OBJ file; may be repeated
    #[arg(long, value_name = "FILE")]
    mesh: Vec<String>,

    /// Stored cases: a JSON lines file, or a folder of them; may be repeated
    #[arg(long, value_name = "FILE|DIR")]
    corpus: Vec<String>,

    /// text or json, or both separated by commas
    #[arg(long, value_delimiter = ',', value_name = "FORMAT", default_value = "text")]
    format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<String>,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    examples: usize,

    /// List the worst finding of every class, not only of every kind
    #[arg(long)]
    details: bool,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// When to colour the text
    #[arg(long, value_enum, default_value_t)]
    color: ColorChoice,

    /// No progress, no notes
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &AuditArguments) -> Result<Status, Failure> {
    let outputs = arguments.outputs()?;
    let plan = arguments.plan()?;
    let threads = arguments.threads()?;
    let total: u64 = plan
        .sources
        .iter()
        .map(|source| {
            let [f32, f64] = [source.count::<f32>(), source.count::<f64>()];
            u64::from(plan.scalars[0]) * f32 + u64::from(plan.scalars[1]) * f64
        })
        .sum();
    if total == 0 {
        let message = "nothing to run: the sources have no case in the chosen scalars".to_owned();
        return Err(Failure::Message(Status::NothingSelected, message));
    }
    if !arguments.quiet {
        let (rows, sources) = (plan.rows.len(), plan.sources.len());
        let scalars = arguments.scalar.join(" and ");
        eprintln!(
            "{rows} kernel rows on {sources} sources of cases in {scalars}: {total} indices, {threads} threads"
        );
    }
    let progress = Progress::new(total, "indices", arguments.quiet);
    let sums = audit::run(&plan, &progress);
    progress.finish();
    let seconds = progress.seconds();
    let record = build(&plan, &sums, &Context { seconds, threads });
    for (format, path) in outputs {
        let style =
            Style { color: arguments.color.enabled(path == "-"), details: arguments.details };
        write_result(path, |out| (format.write)(&record, style, out))?;
    }
    self_check(&plan, &record)
}

/// A family that breaks its own promise is a fault of this tool.
fn self_check(plan: &Plan, record: &Record) -> Result<Status, Failure> {
    let promising: Vec<String> =
        plan.sources.iter().filter(|source| source.promises()).map(Source::name).collect();
    let broken = record
        .result
        .sources
        .iter()
        .find(|source| source.promise_broken > 0 && promising.contains(&source.family));
    match broken {
        None => Ok(Status::Success),
        Some(source) => {
            let first = source.first_broken.as_deref().unwrap_or("-");
            let message = format!(
                "self-check: family '{}' breaks its promise, first at {first}",
                source.family
            );
            Err(Failure::Message(Status::SelfCheck, message))
        }
    }
}

impl AuditArguments {
    /// Formats with where they go.
    fn outputs(&self) -> Result<Vec<(&'static Format, &str)>, Failure> {
        let formats = self.format.iter().map(|name| {
            let names = FORMATS.iter().map(|format| format.name);
            let found = FORMATS.iter().find(|format| format.name == name);
            found.ok_or_else(|| unknown("format", name, names, "hairline audit --help"))
        });
        let formats = formats.collect::<Result<Vec<_>, _>>()?;
        if let Some(i) =
            (1..self.output.len()).find(|&i| self.output[..i].contains(&self.output[i]))
        {
            return Err(Failure::usage(format!("-o {} is given twice", self.output[i])));
        }
        match (formats.len(), self.output.len()) {
            (1, 0) => Ok(vec![(formats[0], "-")]),
            (n, m) if n == m => {
                Ok(formats.into_iter().zip(self.output.iter().map(String::as_str)).collect())
            }
            (n, m) => Err(Failure::usage(format!(
                "{n} formats but {m} outputs: give -o once for each format, in the same order"
            ))),
        }
    }

    fn plan(&self) -> Result<Plan, Failure> {
        let scalars = chosen_scalars(&self.scalar)?;
        Ok(Plan {
            rows: self.kernels.rows()?,
            sources: self.sources()?,
            scalars,
            examples: self.examples,
        })
    }

    fn sources(&self) -> Result<Vec<Source>, Failure> {
        let (count, parameters, seed) = (case_count(&self.count)?, self.parameters()?, self.seed);
        if !self.corpus.is_empty() && parameters != Parameters::default() {
            let message = "--corpus cases are run as they are stored: leave out --scale, --offset and --direction";
            return Err(Failure::usage(message));
        }
        let mut sources = Vec::new();
        let families = self.families()?;
        if self.exhaustive && families.iter().all(|family| family.size.is_none()) {
            return Err(Failure::usage("--exhaustive: only the family 'lattice' is finite"));
        }
        for family in families {
            let exhaustive = self.exhaustive && family.size.is_some();
            sources.push(Source::Family {
                family,
                parameters: parameters.clone(),
                seed,
                count,
                exhaustive,
            });
        }
        for path in &self.mesh {
            let family = Arc::new(MeshFamily::new(read_mesh(path, self.quiet)?, path));
            sources.push(Source::Mesh { family, parameters: parameters.clone(), seed, count });
        }
        for path in &self.corpus {
            for file in corpus_files(path)? {
                sources.push(Source::Corpus(corpus_set(&file)?));
            }
        }
        Ok(sources)
    }

    fn families(&self) -> Result<Vec<&'static Family>, Failure> {
        if self.family.is_empty() {
            let others = !self.mesh.is_empty() || !self.corpus.is_empty();
            return Ok(if others { Vec::new() } else { FAMILIES.iter().collect() });
        }
        self.family
            .iter()
            .map(|name| {
                let names = FAMILIES.iter().map(|family| family.name);
                find(name).ok_or_else(|| unknown("family", name, names, "hairline list families"))
            })
            .collect()
    }

    fn parameters(&self) -> Result<Parameters, Failure> {
        let unit_direction = match self.direction.as_deref() {
            None => false,
            Some("unit") => true,
            Some(other) => {
                return Err(Failure::usage(format!(
                    "--direction: unknown '{other}'; there is 'unit'"
                )));
            }
        };
        let offset = self.offset.as_deref().map_or(Ok([0.0; 3]), parse_offset);
        Ok(Parameters {
            scale: parse_power_of_two(&self.scale)
                .map_err(|e| Failure::usage(format!("--scale: {e}")))?,
            scale_direction: self.scale_direction,
            offset: offset.map_err(|e| Failure::usage(format!("--offset: {e}")))?,
            unit_direction,
            mesh: None,
        })
    }

    /// Sets the number of threads; returns how many there are.
    fn threads(&self) -> Result<usize, Failure> {
        if let Some(threads) = self.threads {
            if threads == 0 || threads > 4096 {
                return Err(Failure::usage(format!("--threads: {threads} is not from 1 to 4096")));
            }
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build_global()
                .map_err(|error| Failure::Message(Status::InputOutput, error.to_string()))?;
        }
        Ok(rayon::current_num_threads())
    }
}
