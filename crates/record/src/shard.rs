//! How the records of a run's parts become the record of the whole.

use crate::audit::{self, Audit, MOST_SHARDS, Observer, Plan, Stock, StoredPlan, StoredStock};
use crate::build::{Context, TOOL, build, plan_part};
use crate::files::hex;
use crate::part::{PartialPart, ShardPart};
use crate::plan::Provenance;
use crate::record::Record;
use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

#[derive(Serialize, Deserialize)]
struct ShardSums {
    plan: StoredPlan,
    audit: Audit,
}

/// The part of a record that merging needs; `audit` is as it is before it is finished.
pub fn shard_part(plan: &Plan, audit: &Audit) -> ShardPart {
    let sums = ShardSums {
        plan: StoredPlan::of(plan),
        audit: audit.clone(),
    };
    let sums = serde_json::to_string(&sums).unwrap_or_default();
    ShardPart {
        digest: digest(&sums),
        sums,
    }
}

fn digest(sums: &str) -> String {
    hex(&Hash::hash(sums.as_bytes())[..8])
}

/// Why records cannot be merged: which of them, counted from 0, and what is wrong.
#[derive(Debug)]
pub struct ShardError {
    /// The record to blame; none if it is no single one.
    pub record: Option<usize>,
    /// In one line.
    pub message: String,
}

fn error(record: usize, message: impl Into<String>) -> ShardError {
    ShardError {
        record: Some(record),
        message: message.into(),
    }
}

/// Records that are parts of one plan, each once.
pub struct Mergeable {
    plan: StoredPlan,
    hash: String,
    parts: Vec<Audit>,
    partial: PartialPart,
    provenance: Vec<Provenance>,
}

/// Checks that records are parts of one plan, without overlap and, unless that is allowed, gaps.
pub fn mergeable(records: Vec<Record>, allow_partial: bool) -> Result<Mergeable, ShardError> {
    let mut all: Option<Mergeable> = None;
    for (i, record) in records.into_iter().enumerate() {
        let (Some(partial), Some(shard)) = (record.result.partial, record.shard) else {
            return Err(error(i, "not a part of a run: it was made without --shard"));
        };
        if partial.of == 0 || MOST_SHARDS < partial.of {
            let message = format!("cut in {} parts, expected 1 to {MOST_SHARDS}", partial.of);
            return Err(error(i, message));
        }
        let tool = &record.provenance.tool;
        if tool != TOOL {
            let message = format!(
                "made by {tool}, and this is {TOOL}: merge parts with the version that made them"
            );
            return Err(error(i, message));
        }
        if digest(&shard.sums) != shard.digest {
            return Err(error(i, "damaged: its sums do not have their digest"));
        }
        let sums: ShardSums = serde_json::from_str(&shard.sums)
            .map_err(|e| error(i, format!("made by another version: {e}")))?;
        let hash = record.result.plan.hash;
        let Some(all) = &mut all else {
            let (parts, provenance) = (vec![sums.audit], vec![record.provenance]);
            all = Some(Mergeable {
                plan: sums.plan,
                hash,
                parts,
                partial,
                provenance,
            });
            continue;
        };
        if hash != all.hash || sums.plan != all.plan {
            let message = format!(
                "of another plan: {hash}, expected {} as the first",
                all.hash
            );
            return Err(error(i, message));
        }
        if partial.of != all.partial.of {
            let message = format!(
                "cut in {}, expected {} as the first",
                partial.of, all.partial.of
            );
            return Err(error(i, message));
        }
        let (target, first) = (&record.provenance.target, &all.provenance[0].target);
        if target != first {
            let message = format!(
                "made on {target}, the first on {first}: a kernel may answer otherwise there"
            );
            return Err(error(i, message));
        }
        let files = &record.provenance.kernel_files;
        if let Some((file, digest)) = files.iter().find(|(file, digest)| {
            all.provenance[0]
                .kernel_files
                .get(*file)
                .is_some_and(|first| first != *digest)
        }) {
            let message = format!("of another build of {file} ({digest}) than the first");
            return Err(error(i, message));
        }
        if let Some(twice) = partial
            .present
            .iter()
            .find(|k| all.partial.present.contains(k))
        {
            return Err(error(
                i,
                format!("shard {twice}/{} is given twice", partial.of),
            ));
        }
        all.parts.push(sums.audit);
        all.partial.present.extend(partial.present);
        all.provenance.push(record.provenance);
    }
    let Some(mut all) = all else {
        return Err(ShardError {
            record: None,
            message: "no records".to_owned(),
        });
    };
    all.partial.present.sort_unstable();
    let missing: Vec<String> = all.missing().map(|k| k.to_string()).collect();
    if !allow_partial && !missing.is_empty() {
        let (of, missing) = (all.partial.of, missing.join(", "));
        let message =
            format!("shards {missing} of {of} are missing (--allow-partial goes without)");
        return Err(ShardError {
            record: None,
            message,
        });
    }
    Ok(all)
}

impl Mergeable {
    /// An error in one line if a file that the parts' kernels were made of is none of these, which are here: then the kernels may answer
    /// otherwise than they did.
    pub fn ensure_built_from(&self, here: &BTreeMap<String, String>) -> Result<(), String> {
        let recorded = self.provenance.iter().flat_map(|part| &part.kernel_files);
        for (file, digest) in recorded {
            // It may have another name here.
            if here.values().any(|known| known == digest) {
                continue;
            }
            let found = match here.get(file) {
                Some(other) => format!("{file} is another build here ({other})"),
                None => "no file that is named here is that one".to_owned(),
            };
            return Err(format!(
                "the parts ran {file} ({digest}), and {found}: name the file that they ran"
            ));
        }
        Ok(())
    }

    fn missing(&self) -> impl Iterator<Item = u64> {
        (0..self.partial.of).filter(|k| self.partial.present.binary_search(k).is_err())
    }
}

/// Adds parts up; `open` reads the meshes and corpora of the plan again, `illustrate` adds what pictures
/// are drawn from. The result of all parts is, byte for byte, that of a run without parts.
pub fn merged<E: From<String>>(
    parts: Mergeable,
    illustrate: impl FnOnce(&Plan, &Audit, &mut Record),
    observer: &dyn Observer,
    open: impl FnMut(&StoredStock, [bool; 2]) -> Result<Stock, E>,
) -> Result<Record, E> {
    let complete = parts.missing().next().is_none();
    let plan = parts.plan.plan(open)?;
    let hash = plan_part(&plan).hash;
    if hash != parts.hash {
        let message = format!(
            "the plan is {hash} here, expected {}: a mesh or a corpus has changed, a kernel of your own \
             announces itself differently, or the parts are of another version",
            parts.hash
        );
        return Err(message.into());
    }
    let mut audit = Audit::of_nothing(&plan);
    for part in parts.parts {
        audit.merge(part)?;
    }
    let shard = (!complete).then(|| shard_part(&plan, &audit));
    audit::finish(&plan, observer, &mut audit);
    let seconds = parts.provenance.iter().map(|part| part.seconds).sum();
    let threads = parts
        .provenance
        .iter()
        .map(|part| part.threads)
        .max()
        .unwrap_or(0);
    let mut record = build(&plan, &audit, &Context { seconds, threads });
    record.result.partial = (!complete).then_some(parts.partial);
    record.shard = shard;
    illustrate(&plan, &audit, &mut record);
    if let Some(first) = parts.provenance.first() {
        record.provenance.plan_flags.clone_from(&first.plan_flags);
        record.provenance.target.clone_from(&first.target);
        record
            .provenance
            .kernel_files
            .clone_from(&first.kernel_files);
    }
    for (kernel, notes) in parts.provenance.iter().flat_map(|part| &part.kernel_notes) {
        let known = record
            .provenance
            .kernel_notes
            .entry(kernel.clone())
            .or_default();
        known.extend(
            notes
                .iter()
                .filter(|note| !known.contains(note))
                .cloned()
                .collect::<Vec<_>>(),
        );
    }
    record.provenance.parts = parts.provenance;
    Ok(record)
}
