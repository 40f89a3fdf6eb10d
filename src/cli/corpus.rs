//! `hairline corpus`: verify or make the stored cases.

use super::exit::{Failure, Status};
use super::flags::{find_family, find_scalar};
use super::input::{MANIFEST, corpus_files, open, read_corpus};
use super::output::{write_json_lines, write_lines, write_result};
use super::progress::Progress;
use crate::case::Parameters;
use crate::command::named_file::{self, SizeLimit};
use crate::corpus::lines::{StoredCase, write_case};
use crate::corpus::truth_json::TruthLine;
use crate::explore;
use crate::explore::campaign::Find;
use crate::family::manifest::{self, ManifestLine};
use crate::family::{Family, Grouping};
use crate::files::InputError;
use crate::kernel::Scalar;
use crate::oracle;
use clap::{Args, Subcommand};
use std::io::{self, BufReader, Write};
use std::path::Path;

/// The arguments of `corpus`, which verifies or writes stored cases.
#[derive(Args)]
pub struct CorpusArguments {
    #[command(subcommand)]
    command: CorpusCommand,
}

#[derive(Subcommand)]
enum CorpusCommand {
    /// Check every stored truth, and generate every set and mesh of the manifest again
    Verify {
        /// A folder of corpus files, or one of them
        #[arg(default_value = "corpora", value_name = "FILE|DIR")]
        path: String,
    },
    /// Write the digests of all generated sets into the manifest; or, with --family, that family's cases
    Generate {
        /// The folder of the manifest; what it says of meshes stays
        #[arg(default_value = "corpora", value_name = "DIR")]
        path: String,

        /// Write the cases of this family as JSON lines instead
        #[arg(long, value_name = "NAME")]
        family: Option<String>,

        /// f32 or f64
        #[arg(long, default_value = "f32", value_name = "SCALAR")]
        scalar: String,

        /// How many cases, or groups of cases
        #[arg(long, short = 'n', default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..))]
        count: u64,

        /// Seed of the random cases
        #[arg(long, default_value_t = 1)]
        seed: u64,

        /// Where the family's cases go; - is standard output
        #[arg(short, long, default_value = "-", value_name = "FILE")]
        output: String,
    },
}

/// Runs the command.
pub fn run(arguments: &CorpusArguments) -> Result<Status, Failure> {
    match &arguments.command {
        CorpusCommand::Verify { path } => verify(path),
        CorpusCommand::Generate {
            family: Some(name),
            scalar,
            count,
            seed,
            output,
            ..
        } => {
            let family = find_family(name)?;
            let (seed, count) = (*seed, *count);
            let scalar = find_scalar(scalar)?;
            let progress = Progress::of_output(count, "cases", output);
            write_result(
                output,
                |out| in_named_scalar!(scalar, F => write_family::<F>(out, family, seed, count, &progress)),
            )?;
            Ok(Status::Success)
        }
        CorpusCommand::Generate { path, .. } => generate(Path::new(path)),
    }
}

fn write_family<F: Scalar>(
    out: &mut dyn Write,
    family: &Family,
    seed: u64,
    count: u64,
    progress: &Progress,
) -> io::Result<()> {
    let parameters = Parameters::default();
    for index in 0..count {
        progress.set(index);
        let made = family.make::<F>(&parameters, seed, index);
        let several = made.cases().len() > 1;
        for (k, case) in made.cases().iter().enumerate() {
            let mut id = family.id::<F>(&parameters, seed, index);
            id.triangle = several.then_some(k);
            let stored = StoredCase {
                name: Some(id.to_string()),
                is_secondary: family.grouping == Grouping::SecondaryRay,
                ..StoredCase::of(*case)
            };
            writeln!(out, "{}", write_case(&stored.with_truth()))?;
        }
    }
    Ok(())
}

fn verify(path: &str) -> Result<Status, Failure> {
    let (mut report, mut nothing) = (Vec::new(), true);
    let progress = Progress::without_end(path, false);
    for file in corpus_files(path)? {
        progress.tell(file.clone());
        let stored = read_corpus(&file)?;
        let with_truth = stored
            .iter()
            .filter(|stored| stored.truth.is_some())
            .count();
        // read_corpus holds the stored truths to the fast oracle, which must agree with the definition.
        let (mut scores, mut finds) = (0, 0);
        for case in &stored {
            agree(&file, case)?;
            let replayed = explore::replay(case);
            scores +=
                u64::from(replayed.map_err(|message| InputError::at(&file, case.line, message))?);
            if case.found.is_some() {
                let shown = Find::of_stored(case);
                shown.map_err(|message| InputError::at(&file, case.line, message))?;
                finds += 1;
            }
        }
        let finds = if finds > 0 {
            format!(", {finds} finds shown again")
        } else {
            String::new()
        };
        let scores = if scores > 0 {
            format!(", {scores} stored scores right")
        } else {
            String::new()
        };
        let cases = stored.len();
        nothing &= cases == 0;
        report.push(format!(
            "{file}: {cases} cases, {with_truth} stored truths right{scores}{finds}"
        ));
    }
    let manifest_path = Path::new(path).join(MANIFEST);
    if manifest_path.exists() {
        let name = manifest_path.display().to_string();
        let lines = manifest_lines(&name)?;
        nothing &= lines.is_empty();
        if let Some(family) = manifest::left_out(lines.iter().map(|(_, line)| line)) {
            return Err(Failure::bad_input(format!(
                "{name}: no line for the family {family}: write it again with hairline corpus generate {path}"
            )));
        }
        let folder = manifest_path.parent().unwrap_or(Path::new("."));
        for (number, line) in &lines {
            progress.tell(format!("{name}: line {number} of {}", lines.len()));
            let mesh = match line {
                ManifestLine::Set(_) => Vec::new(),
                ManifestLine::Mesh(line) => {
                    let path = folder.join("meshes").join(&line.mesh);
                    named_file::read(&path, SizeLimit::CASES)
                        .map_err(|error| Failure::of_path(&path, &error))?
                }
            };
            manifest::verify(line, &mesh)
                .map_err(|message| InputError::at(&name, *number, message))?;
        }
        let meshes = lines
            .iter()
            .filter(|(_, line)| matches!(line, ManifestLine::Mesh(_)))
            .count();
        let sets = lines.len() - meshes;
        report.push(format!(
            "{name}: {sets} generated sets and {meshes} meshes are the same again"
        ));
    }
    progress.finish();
    if nothing {
        return Err(Failure::nothing(format!("{path}: no case to verify")));
    }
    write_lines(|out| report.iter().try_for_each(|line| writeln!(out, "{line}")))?;
    Ok(Status::Success)
}

fn agree(file: &str, stored: &StoredCase) -> Result<(), Failure> {
    let slow = either_scalar!(&stored.case, case => oracle::define(case));
    let slow = TruthLine::new(stored.name.as_deref(), &slow.truth, Some(&slow.exact));
    let fast = stored.truth_line(true);
    if fast == slow {
        return Ok(());
    }
    let text = |line| serde_json::to_string(line).unwrap_or_default();
    let message = format!(
        "{file}:{}: self-check: the oracle says {}, its definition {}",
        stored.line,
        text(&fast),
        text(&slow)
    );
    Err(Failure::self_check(message))
}

fn manifest_lines(name: &str) -> Result<Vec<(usize, ManifestLine)>, Failure> {
    Ok(manifest::read(BufReader::new(open(name)?), name)?)
}

fn generate(folder: &Path) -> Result<Status, Failure> {
    let path = folder.join(MANIFEST);
    let old = match path.exists() {
        true => manifest_lines(&path.display().to_string())?,
        false => Vec::new(),
    };
    let meshes = old.into_iter().map(|(_, line)| line);
    let meshes = meshes.filter(|line| matches!(line, ManifestLine::Mesh(_)));
    let lines: Vec<ManifestLine> = manifest::sets().chain(meshes).collect();
    write_json_lines(&path, &lines)?;
    eprintln!("{}: {} lines", path.display(), lines.len());
    Ok(Status::Success)
}
