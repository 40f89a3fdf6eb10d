//! `hairline merge`: the records of parts of a run become the record of the whole.

use super::exit::{Failure, Status};
use super::input::{corpus_sets, read_mesh, read_record};
use super::plugins::PluginArguments;
use super::progress::Progress;
use super::reporting::{Outputs, ReportArguments, illustrate, self_check};
use crate::audit::{Audit, Plan, Stock, StoredStock};
use crate::family::{MeshFamily, Stratum};
use crate::files::InputError;
use crate::kernel;
use crate::mesh::{AimedPart, SceneMesh, Surface};
use crate::record::{Record, mergeable, merged};
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
    let records = files
        .iter()
        .map(|file| read_record(file))
        .collect::<Result<Vec<_>, _>>()?;
    // What they answer is looked at again, for the worst findings and their causes. They go by the words of the run.
    let rows = records.iter().flat_map(|record| &record.result.plan.rows);
    let selectors: BTreeMap<String, String> = rows
        .map(|row| (row.kernel.clone(), row.selector.clone()))
        .collect();
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
    let files = arguments.plugins.files();
    parts
        .ensure_built_from(&files)
        .map_err(|message| InputError::of("merge", message))?;
    let quiet = arguments.report.output.quiet;
    let progress = Progress::new(0, "indices", true);
    let illustrate = |plan: &Plan, sums: &Audit, record: &mut Record| {
        if outputs.illustrate() {
            illustrate(plan, sums, record);
        }
    };
    let record = merged(parts, illustrate, &progress, |stock, scalars| {
        open(stock, scalars, quiet)
    })
    .map_err(|Unmergeable(failure)| failure)?;
    self_check(&record)?;
    outputs.write(&record)?;
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

/// An error if a part names a stream in place of a file: nobody has said that it is there.
fn ensure_file(path: &str) -> Result<(), String> {
    match path == "-" || path.starts_with("/dev/") || path.starts_with("/proc/") {
        true => Err(format!("a part is of '{path}', which is no file")),
        false => Ok(()),
    }
}

fn open(stock: &StoredStock, scalars: [bool; 2], quiet: bool) -> Result<Stock, Unmergeable> {
    let family = |path| -> Result<_, Unmergeable> {
        ensure_file(path)?;
        Ok(Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path)))
    };
    Ok(match stock {
        StoredStock::Mesh(path) => Stock::Mesh(family(path)?),
        StoredStock::MeshPart(path, part) => {
            let unknown = || format!("unknown part of a mesh '{part}'");
            let part = AimedPart::named(part).ok_or_else(unknown)?;
            Stock::MeshPart(Arc::new(Surface::new(family(path)?, scalars)), part)
        }
        StoredStock::SceneMesh(path, stratum) => {
            let unknown = || format!("unknown part of a scene '{stratum}'");
            let stratum = Stratum::named(stratum).ok_or_else(unknown)?;
            let surface = Surface::new(family(path)?, scalars);
            Stock::SceneMesh(Arc::new(SceneMesh::new(surface)), stratum)
        }
        StoredStock::Corpus(file, is_secondary) => {
            ensure_file(file)?;
            let [others, secondary] = corpus_sets(file)?;
            Stock::Corpus(if *is_secondary { secondary } else { others })
        }
        StoredStock::Family(family) | StoredStock::Whole(family) => {
            return Err(format!("family '{family}' needs no file").into());
        }
    })
}
