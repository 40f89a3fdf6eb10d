//! `hairline diff`: two records side by side.

use super::boxes::BoxesResult;
use super::exit::{Failure, Status};
use super::input::RecordText;
use super::output::OutputArguments;
use crate::expect::{RecordComparison, difference, difference_of};
use crate::record::{Comparable, Record, Study};
use crate::report::epsilon::SceneResult;
use crate::report::offset::OffsetResult;
use crate::report::proofs::ProofResult;
use crate::vectors::VerifyResult;
use clap::Args;
use hairline_rays::RaysResult;

/// The arguments of `diff`: the records to compare, and how to report.
#[derive(Args)]
pub struct DiffArguments {
    /// The earlier record, as `--format json` wrote it
    old: String,

    /// The later record
    new: String,

    /// Exit with 1 if something got worse
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &DiffArguments) -> Result<Status, Failure> {
    let pairs = arguments.output.pairs(RecordComparison::FORMATS)?;
    let [old, new] = [&arguments.old, &arguments.new].map(|path| RecordText::open(path));
    let (old, new) = (old?, new?);
    let comparison = match old.study {
        Study::Audit => {
            let (old, new): (Record, Record) = (old.read()?, new.read()?);
            if let (Some(before), Some(now)) = (&old.result.mesh, &new.result.mesh) {
                of_one_question([before, now].map(|mesh| format!("mesh {}", mesh.digest)))?;
            }
            difference(&old.result, &new.result)
        }
        Study::Epsilon => of_one_study::<SceneResult>(old, new)?,
        Study::Offset => of_one_study::<OffsetResult>(old, new)?,
        Study::Prove => of_one_study::<ProofResult>(old, new)?,
        Study::Verify => of_one_study::<VerifyResult>(old, new)?,
        Study::Boxes => of_one_study::<BoxesResult>(old, new)?,
        Study::Rays => of_one_study::<RaysResult>(old, new)?,
    };
    if comparison.common == 0 {
        let message = "nothing to compare: the records have no kernel with its epsilons on the same kind of rays in common; two kernels, or two epsilons of one, are compared in one run";
        return Err(Failure::nothing(message));
    }
    arguments.output.write(pairs, &comparison)?;
    Ok(if arguments.exit_code && comparison.is_worse() {
        Status::Disagreements
    } else {
        Status::Success
    })
}

fn of_one_study<R: Comparable>(
    old: RecordText<'_>,
    new: RecordText<'_>,
) -> Result<RecordComparison, Failure> {
    let (old, new) = (old.read::<R>()?, new.read::<R>()?);
    of_one_question([&old, &new].map(|record| record.result.question()))?;
    Ok(difference_of(&old.result, &new.result))
}

/// Refuses records of two scenes, meshes or domains: an error in one says nothing about another.
fn of_one_question([before, now]: [String; 2]) -> Result<(), Failure> {
    if before == now {
        return Ok(());
    }
    let message = format!(
        "nothing to compare: the records answer different questions: before {before}; now {now}"
    );
    Err(Failure::nothing(message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::ResultPart;
    use schemars::JsonSchema;

    /// A record of any study.
    #[derive(JsonSchema)]
    #[serde(untagged)]
    #[allow(dead_code)]
    enum AnyRecord {
        Audit(Record<ResultPart>),
        Epsilon(Record<SceneResult>),
        Offset(Record<OffsetResult>),
        Prove(Record<ProofResult>),
        Verify(Record<VerifyResult>),
        Boxes(Record<BoxesResult>),
        Rays(Record<RaysResult>),
    }

    #[test]
    fn the_committed_schema_is_that_of_the_types() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/schema/record.json");
        let schema = schemars::schema_for!(AnyRecord);
        let derived = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        if std::fs::read_to_string(file).ok().as_ref() == Some(&derived) {
            return;
        }
        let path = std::env::temp_dir().join("hairline-record.json");
        std::fs::write(&path, derived).unwrap();
        let path = path.display();
        panic!("the record has changed: cp {path} docs/schema/record.json");
    }
}
