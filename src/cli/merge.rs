//! `hairline merge`: the records of parts of a run become the record of the whole.

use super::exit::{Failure, Status};
use super::flags::placed;
use super::input::{corpus_sets, read_mesh, read_record};
use super::plugins::PluginArguments;
use super::progress::Progress;
use super::reporting::{Outputs, ReportArguments, illustrated, self_check};
use crate::audit::{CorpusSet, Plan, Source, StoredSource};
use crate::corpus::InputError;
use crate::family::{MeshFamily, Stratum};
use crate::kernel;
use crate::mesh::{Part, SceneMesh, Surface};
use crate::report::{mergeable, merged};
use clap::Args;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The arguments of `merge`: the records, and how to report.
#[derive(Args)]
pub struct MergeArguments {
    /// The records that `--shard` with `--format json` wrote
    #[arg(required = true, value_name = "RECORD")]
    records: Vec<String>,

    /// Merge without the shards that are missing; the record says which shards it has
    #[arg(long)]
    allow_partial: bool,

    #[command(flatten)]
    plugins: PluginArguments,

    #[command(flatten)]
    report: ReportArguments,
}

/// Runs the command.
pub fn run(arguments: &MergeArguments) -> Result<Status, Failure> {
    let outputs = arguments.report.outputs()?;
    outputs.told(joined(arguments, &outputs))
}

fn joined(arguments: &MergeArguments, outputs: &Outputs<'_>) -> Result<Status, Failure> {
    let files = &arguments.records;
    let records = files.iter().map(|file| read_record(file)).collect::<Result<Vec<_>, _>>()?;
    // What they answer is looked at again, for the worst findings and their causes. They go by the words of the run.
    let rows = records.iter().flat_map(|record| &record.result.plan.rows);
    let selectors: BTreeMap<String, String> =
        rows.map(|row| (row.kernel.clone(), row.selector.clone())).collect();
    arguments.plugins.entries_known_as(&selectors)?;
    let is_unknown = |(kernel, flag): &(&String, &String)| {
        flag.starts_with("--kernel-") && kernel::find(kernel).is_none()
    };
    if let Some((kernel, flag)) = selectors.iter().find(is_unknown) {
        let message = format!(
            "the causes of findings of kernel '{kernel}' are looked for by running it: add {flag}, or wherever it \
             lies here"
        );
        return Err(InputError::of("merge", message).into());
    }
    let parts = mergeable(records, arguments.allow_partial).map_err(|error| {
        let file = error.record.map_or("merge", |i| &files[i]);
        InputError::of(file, error.message)
    })?;
    let quiet = arguments.report.output.quiet;
    let progress = Progress::new(0, "indices", true);
    let illustrate = |plan: &Plan| outputs.illustrate().then(|| illustrated(plan));
    let mut record =
        merged(parts, illustrate, &progress, |source, scalars| open(source, scalars, quiet))
            .map_err(|Unmergeable(failure)| failure)?;
    self_check(&record)?;
    outputs.write(&mut record)?;
    Ok(Status::Success)
}

/// A failure, or a message about the parts.
struct Unmergeable(Failure);

impl From<String> for Unmergeable {
    fn from(message: String) -> Unmergeable {
        Unmergeable(InputError::of("merge", message).into())
    }
}

impl From<Failure> for Unmergeable {
    fn from(failure: Failure) -> Unmergeable {
        Unmergeable(failure)
    }
}

fn open(source: &StoredSource, scalars: [bool; 2], quiet: bool) -> Result<Source, Unmergeable> {
    match source {
        StoredSource::Mesh { path, parameters, seed, count } => {
            let family = Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path));
            let parameters = parameters.parse()?;
            Ok(Source::Mesh { family, parameters, seed: *seed, count: *count })
        }
        StoredSource::MeshPart { path, part, parameters, seed, directions } => {
            let family = Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path));
            let unknown = || format!("unknown part of a mesh '{part}'");
            Ok(Source::MeshPart {
                surface: Arc::new(Surface::new(family, scalars)),
                part: Part::named(part).ok_or_else(unknown)?,
                parameters: parameters.parse()?,
                seed: *seed,
                directions: *directions,
            })
        }
        StoredSource::SceneMesh { path, stratum, parameters, seed, count } => {
            let family = Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path));
            let unknown = || format!("unknown part of a scene '{stratum}'");
            Ok(Source::SceneMesh {
                mesh: Arc::new(SceneMesh::new(Surface::new(family, scalars))),
                stratum: Stratum::named(stratum).ok_or_else(unknown)?,
                parameters: parameters.parse()?,
                seed: *seed,
                count: *count,
            })
        }
        StoredSource::Corpus { file, is_secondary, instance } => {
            let [others, secondary] = corpus_sets(file)?;
            let set = if *is_secondary { secondary } else { others };
            instance.map(placed).transpose()?;
            Ok(Source::Corpus(CorpusSet { instance: *instance, ..set }))
        }
        StoredSource::Family { family, .. } => {
            Err(format!("family '{family}' needs no file").into())
        }
    }
}
