//! Runs tests with a mutant: those that reach it, the likely ones first, until one fails.

use crate::build::{TestBinary, Tree, digest};
use crate::config::Program;
use crate::find::Mutant;
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet};
use std::fs;
use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// A test or a program, which sites it reaches, and how long it takes.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Test {
    name: String,
    command: Vec<String>,
    seconds: f64,
    sites: HashSet<u32>,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Passed,
    Failed,
    TimedOut,
}

/// The tests that take part.
#[derive(Default, Serialize, Deserialize)]
pub struct Tests {
    tests: Vec<Test>,
    /// What was left out, and why.
    pub left_out: Vec<String>,
    /// How many mutants of a function each test has killed.
    #[serde(skip)]
    kills: Mutex<HashMap<(String, String), f64>>,
}

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The test that failed or did not end.
    Killed(String),
    Lived,
    NotReached,
}

impl Tests {
    /// Runs each test with one of some words in its name once without a mutant, and sees what it reaches; without words
    /// all tests.
    pub fn of_binaries(
        tree: &Tree,
        binaries: &[TestBinary],
        words: &[String],
        slow: f64,
    ) -> Result<Tests, String> {
        let mut commands: Vec<(String, Vec<String>)> = Vec::new();
        for TestBinary { name, path } in binaries {
            let list = Command::new(path)
                .args(["--list", "--format", "terse"])
                .current_dir(&tree.copy)
                .output()
                .map_err(|e| format!("{}: {e}", path.display()))?;
            let list = String::from_utf8_lossy(&list.stdout).into_owned();
            for test in list.lines().filter_map(|line| line.strip_suffix(": test")) {
                let path = path.display().to_string();
                let arguments = ["--exact", test, "--include-ignored", "--test-threads=1"];
                let command = [path]
                    .into_iter()
                    .chain(arguments.map(str::to_owned))
                    .collect();
                commands.push((format!("{name}: {test}"), command));
            }
        }
        commands.retain(|(name, _)| words.is_empty() || words.iter().any(|w| name.contains(w)));
        commands.sort();
        Tests::reach(tree, commands, slow)
    }

    /// Runs a program once without a mutant.
    pub fn of_program(tree: &Tree, program: &Program) -> Result<Tests, String> {
        if !program.build.is_empty() {
            tree.cargo(&program.build)?;
        }
        let target = tree.target.display().to_string();
        let command = program
            .run
            .iter()
            .map(|word| word.replace("{target}", &target))
            .collect();
        Tests::reach(tree, vec![(program.name.clone(), command)], f64::INFINITY)
    }

    /// Runs each command, if the same build did not do so before.
    fn reach(
        tree: &Tree,
        commands: Vec<(String, Vec<String>)>,
        slow: f64,
    ) -> Result<Tests, String> {
        let name = format!(
            "{:016x}.json",
            digest(&(tree.digest_of_copy()?, &commands, slow.to_bits()))
        );
        let (log, path) = (tree.target.join("reached"), tree.target.join(name));
        if let Some(known) = fs::read(&path)
            .ok()
            .and_then(|b| serde_json::from_slice(&b).ok())
        {
            return Ok(known);
        }
        let mut tests = Tests::default();
        for (name, command) in commands {
            let _ = fs::remove_file(&log);
            let (begin, limit) = (Instant::now(), slow.min(3600.0));
            let end = run(
                tree,
                &command,
                ("MUTANT_LOG", &log.display().to_string()),
                limit,
            )?;
            let seconds = begin.elapsed().as_secs_f64();
            match end {
                End::Passed => {
                    let text = fs::read_to_string(&log).unwrap_or_default();
                    let sites = text.lines().filter_map(|line| line.parse().ok()).collect();
                    tests.tests.push(Test {
                        name,
                        command,
                        seconds,
                        sites,
                    });
                }
                End::Failed => tests
                    .left_out
                    .push(format!("{name}: fails without a mutant")),
                End::TimedOut => tests
                    .left_out
                    .push(format!("{name}: takes more than {slow} s")),
            }
        }
        let text = serde_json::to_string(&tests).map_err(|e| e.to_string())?;
        fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(tests)
    }

    /// Keeps the tests that take at most so many seconds.
    pub fn keep(&mut self, slow: f64) {
        self.tests.retain(|test| test.seconds <= slow);
    }

    /// How many tests there are, and how long they take together in seconds.
    pub fn count(&self) -> (usize, f64) {
        (
            self.tests.len(),
            self.tests.iter().map(|test| test.seconds).sum(),
        )
    }

    /// Tries a mutant on the tests that reach it: the quick ones first, and those that killed others of its function.
    pub fn kill(&self, tree: &Tree, mutant: &Mutant) -> Result<Outcome, String> {
        let key = |test: &Test| (mutant.function.clone(), test.name.clone());
        let mut order: Vec<(f64, &Test)> = {
            let kills = self.kills.lock().expect("no panic");
            let reaching = self
                .tests
                .iter()
                .filter(|test| test.sites.contains(&mutant.site));
            let weight = |test| 1.0 + 4.0 * kills.get(&key(test)).copied().unwrap_or(0.0);
            reaching
                .map(|test| (test.seconds / weight(test), test))
                .collect()
        };
        order.sort_by(|one, other| one.0.total_cmp(&other.0));
        for (_, test) in &order {
            let limit = 5.0 + 5.0 * test.seconds;
            let end = run(
                tree,
                &test.command,
                ("MUTANT", &mutant.id.to_string()),
                limit,
            )?;
            if end != End::Passed {
                *self
                    .kills
                    .lock()
                    .expect("no panic")
                    .entry(key(test))
                    .or_default() += 1.0;
                return Ok(Outcome::Killed(test.name.clone()));
            }
        }
        Ok(if order.is_empty() {
            Outcome::NotReached
        } else {
            Outcome::Lived
        })
    }
}

/// Runs a command in the copy, with one variable more, for so many seconds at most.
fn run(tree: &Tree, command: &[String], variable: (&str, &str), limit: f64) -> Result<End, String> {
    // A mutant may ask for memory without end.
    let mut child = Command::new("sh")
        .args(["-c", "ulimit -v 8000000; exec \"$@\"", "sh"])
        .args(command)
        .current_dir(&tree.copy)
        .env(variable.0, variable.1)
        .env("CARGO_MANIFEST_DIR", &tree.copy)
        // The same run each time, which leaves nothing behind.
        .envs([("RAYON_NUM_THREADS", "1"), ("PROPTEST_RNG_SEED", "1")])
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .process_group(0)
        .spawn()
        .map_err(|e| format!("{}: {e}", command[0]))?;
    let end = wait(&mut child, limit).map_err(|e| e.to_string())?;
    if end != End::Passed {
        // With the programs that it started, which would run on.
        let group = format!("-{}", child.id());
        let kill = ["-c", "kill -s KILL -- \"$1\" 2>/dev/null", "sh", &group];
        Command::new("sh")
            .args(kill)
            .status()
            .map_err(|e| e.to_string())?;
        child
            .kill()
            .and_then(|()| child.wait())
            .map_err(|e| e.to_string())?;
    }
    Ok(end)
}

/// How a process ends within so many seconds.
fn wait(child: &mut Child, limit: f64) -> io::Result<End> {
    let begin = Instant::now();
    let mut wait = Duration::from_micros(500);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(if status.success() {
                End::Passed
            } else {
                End::Failed
            });
        }
        if begin.elapsed().as_secs_f64() > limit {
            return Ok(End::TimedOut);
        }
        std::thread::sleep(wait);
        wait = (wait * 2).min(Duration::from_millis(20));
    }
}
