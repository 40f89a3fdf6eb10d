//! Changes hairline's code in small ways and shows which changes no test notices.
//!
//! All mutants are compiled into one copy of the package; a variable of the environment says which one is active.
//! So the package is built once, and a mutant costs only the tests that reach it.

mod build;
mod changes;
mod config;
mod find;
mod results;
mod rewrite;
mod table;
mod trial;

use build::Tree;
use clap::Parser;
use config::Config;
use find::Mutant;
use results::Results;
use std::collections::HashSet;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use trial::Tests;

/// Changes the code in small ways, and lists the changes that no test notices.
#[derive(Parser)]
struct Arguments {
    /// The package
    #[arg(long, default_value = ".")]
    root: PathBuf,

    /// Its modules, programs and equivalents
    #[arg(long, default_value = "tests/mutants/mutants.toml")]
    config: PathBuf,

    /// Where the copy, what is built and the results lie
    #[arg(long, default_value = "target/mutants")]
    work: PathBuf,

    /// Only the modules of these groups; other groups are built again, other files are not
    #[arg(long)]
    group: Vec<String>,

    /// Only these files, or folders with a slash at the end
    #[arg(long)]
    file: Vec<String>,

    /// Only the mutants at this place
    #[arg(long, value_name = "FILE:LINE:COLUMN")]
    mutant: Option<String>,

    /// Only N mutants, drawn at random
    #[arg(long, value_name = "N")]
    sample: Option<usize>,

    /// Chooses the random mutants
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Runs this program of the configuration instead of the tests
    #[arg(long, value_name = "PROGRAM")]
    by: Option<String>,

    /// Only mutants that lived in their last run, whatever was changed since
    #[arg(long)]
    lived: bool,

    /// Tries the equivalents too: one that is killed is none
    #[arg(long)]
    equivalents: bool,

    /// Only tests with one of these words in their names
    #[arg(long, value_name = "WORD")]
    test: Vec<String>,

    /// Leaves out more tests: those that take longer, in seconds
    #[arg(long, value_name = "SECONDS")]
    slow: Option<f64>,

    /// Tries so many mutants at once; each takes one core
    #[arg(long, short, default_value_t = 1)]
    jobs: usize,

    /// Writes the survivors to this file as they come
    #[arg(long, value_name = "FILE")]
    survivors: Option<PathBuf>,

    /// Only lists the mutants
    #[arg(long)]
    list: bool,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

/// True if no module has more survivors without a reason than it may.
fn run(arguments: &Arguments) -> Result<bool, String> {
    let root = arguments.root.canonicalize().map_err(|e| e.to_string())?;
    let work = root.join(&arguments.work);
    std::fs::create_dir_all(&work).map_err(|e| format!("{}: {e}", work.display()))?;
    let config = Config::read(&root.join(&arguments.config))?;
    let tree = Tree::new(&root, &work);
    let of_group = |module: &&config::Module| {
        arguments.group.is_empty() || arguments.group.contains(&module.group)
    };
    let modules: Vec<_> = config.modules.iter().filter(of_group).collect();
    let files = tree.sources(|file| modules.iter().any(|module| module.has(file)))?;
    let with_conditions = |file: &str| {
        modules
            .iter()
            .any(|module| module.conditions && module.has(file))
    };
    let finder = tree.find(&files, with_conditions)?;
    config.check_equivalents(&finder.mutants, &files)?;
    let chosen = choose(arguments, &finder.mutants);
    if chosen.is_empty() && arguments.sample != Some(0) {
        return Err("no mutant is chosen".into());
    }
    if arguments.list {
        chosen
            .iter()
            .for_each(|mutant| println!("{}", mutant.describe()));
        return Ok(true);
    }

    let by = arguments.by.as_deref().unwrap_or("tests");
    let mut results = Results::open(
        &work.join("results.jsonl"),
        by,
        &format!("{:016x}", tree.digest()?),
    )?;
    let known = finder
        .mutants
        .iter()
        .filter(|mutant| results.is_refused(mutant));
    let mut refused: HashSet<u32> = known.map(|mutant| mutant.id).collect();
    let binaries = tree.build(&finder, &mut refused, &config.tests)?;
    for mutant in finder
        .mutants
        .iter()
        .filter(|mutant| refused.contains(&mutant.id))
    {
        if !results.is_refused(mutant) {
            results.refuse(mutant)?;
        }
    }
    let mut tests = match &arguments.by {
        None => Tests::of_binaries(&tree, &binaries, &arguments.test, config.slow)?,
        Some(name) => {
            let program = config.programs.iter().find(|program| program.name == *name);
            Tests::of_program(&tree, program.ok_or(format!("no program '{name}'"))?)?
        }
    };
    tests.keep(arguments.slow.unwrap_or(f64::INFINITY));
    tests
        .left_out
        .iter()
        .for_each(|line| eprintln!("left out: {line}"));
    let (count, seconds) = tests.count();
    eprintln!("{count} tests, {seconds:.0} s together");
    if count == 0 {
        return Err("no test passes without a mutant".into());
    }

    let chosen: Vec<&Mutant> = chosen
        .into_iter()
        .filter(|m| !refused.contains(&m.id))
        .collect();
    let waits = |mutant: &&&Mutant| {
        let is_known = match (arguments.lived, results.of(by, mutant, arguments.lived)) {
            (true, Some(line)) => line.outcome == "killed",
            (_, line) => line.is_some(),
        };
        !is_known && (arguments.equivalents || !config.is_equivalent(mutant))
    };
    let waiting: Vec<&Mutant> = chosen.iter().filter(waits).copied().collect();
    let (next, results) = (AtomicUsize::new(0), Mutex::new(results));
    let work = || -> Result<(), String> {
        while let Some(mutant) = waiting.get(next.fetch_add(1, Relaxed)) {
            let outcome = tests.kill(&tree, mutant)?;
            let mut results = results.lock().expect("no panic");
            results.add(mutant, &outcome)?;
            eprintln!(
                "{}/{} {}: {outcome:?}",
                mutant.id,
                finder.mutants.len(),
                mutant.describe()
            );
            if let Some(path) = &arguments.survivors {
                let text = table::survivors(&config, &results, by, &chosen).join("\n") + "\n";
                std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?;
            }
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..arguments.jobs).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .try_for_each(|worker| worker.join().expect("no panic"))
    })?;
    let results = results.into_inner().expect("no panic");
    println!(
        "{}",
        table::table(&config, &results, &chosen, refused.len())
    );
    let survivors = table::survivors(&config, &results, by, &chosen);
    survivors.iter().for_each(|line| println!("{line}"));
    Ok(table::is_met(&config, &results, by, &chosen))
}

/// The mutants that the arguments choose, in the order of the files.
fn choose<'m>(arguments: &Arguments, mutants: &'m [Mutant]) -> Vec<&'m Mutant> {
    let is_chosen = |mutant: &&Mutant| {
        let Mutant {
            file, line, column, ..
        } = mutant;
        let has = |f: &String| f == file || f.ends_with('/') && file.starts_with(f.as_str());
        (arguments.file.is_empty() || arguments.file.iter().any(has))
            && arguments
                .mutant
                .as_ref()
                .is_none_or(|at| *at == format!("{file}:{line}:{column}"))
    };
    let mut chosen: Vec<&Mutant> = mutants.iter().filter(is_chosen).collect();
    if let Some(count) = arguments.sample {
        // Each mutant draws a number by itself, so that an edit elsewhere changes few choices.
        chosen.sort_by_cached_key(|mutant| build::digest(&(arguments.seed, mutant.key())));
        chosen.truncate(count);
        chosen.sort_by_key(|mutant| mutant.id);
    }
    chosen
}
