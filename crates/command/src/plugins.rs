//! Kernels of the user's own: libraries and commands that flags name.

#![forbid(unsafe_code)]

use crate::audit::{quoted, shell_word};
use crate::exit::{Failure, Status};
use crate::files::hex;
use crate::flags::{again, refuse_twice};
use crate::kernel::{Entry, Scalar, TRIANGLES, Table};
use crate::plugin::{Asked, HOST_COMMAND, KernelProgram, LoadError, ProcessLimits, load};
use clap::Args;
use hairline_boxes::Boxes;
use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// The flags that bring kernels along.
#[derive(Args, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PluginArguments {
    /// A kernel in a shared library with the functions of include/hairline.h; may be repeated
    #[arg(long, value_name = "FILE", help_heading = "Kernels of your own")]
    kernel_lib: Vec<String>,

    /// A kernel as a command that answers cases over its pipes (docs/protocol.md); may be repeated
    #[arg(long, value_name = "COMMAND", help_heading = "Kernels of your own")]
    kernel_cmd: Vec<String>,

    /// How long such a kernel may take to start: to be loaded and to answer its first call, or until its hello is over; never
    /// less than --kernel-timeout
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = START_SECONDS,
        help_heading = "Kernels of your own"
    )]
    #[serde(default = "start_seconds")]
    kernel_start: f64,

    /// How long to wait for an answer of such a kernel
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = TIMEOUT_SECONDS,
        help_heading = "Kernels of your own"
    )]
    kernel_timeout: f64,

    /// On how many cases such a kernel may crash or hang before the run ends [default: 1000, or 30 seconds of
    /// waiting, which are 3 cases; no limit in a fuzz campaign]
    #[arg(long, value_name = "N", help_heading = "Kernels of your own")]
    kernel_failures: Option<u64>,

    /// End the run if such a kernel flushes subnormal numbers to zero, or does not round to nearest; of a
    /// --kernel-cmd its own word is taken (`floats` in docs/protocol.md)
    #[arg(long, help_heading = "Kernels of your own")]
    #[serde(default)]
    require_ieee: bool,
}

/// How long a library may be asked its first batch again and again, in milliseconds; 0 for not at all.
static LONG_RUN: AtomicU64 = AtomicU64::new(0);

/// As long as that, if the kernel's own timeout is long.
const LONGEST_RUN: f64 = 2.0;

/// True if nothing is said of a kernel while it runs.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Says nothing of kernels while they run.
pub fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// How long a kernel may take to start by default.
const START_SECONDS: f64 = 60.0;

fn start_seconds() -> f64 {
    START_SECONDS
}

/// How long a kernel may be silent by default.
const TIMEOUT_SECONDS: f64 = 10.0;

/// How long a run waits in all for a silent kernel by default, but for three cases at least.
const PATIENCE_SECONDS: f64 = 30.0;

/// On how many cases it may fail by default.
const FAILURES: u64 = 1000;

/// A kernel that fails on so many cases before it answers any is given up.
const FIRST_FAILURES: u64 = 100;

impl Default for PluginArguments {
    fn default() -> PluginArguments {
        PluginArguments {
            kernel_lib: Vec::new(),
            kernel_cmd: Vec::new(),
            kernel_start: START_SECONDS,
            kernel_timeout: TIMEOUT_SECONDS,
            kernel_failures: None,
            require_ieee: false,
        }
    }
}

impl PluginArguments {
    /// Goes on after any number of failures, unless the flags set a limit.
    pub fn go_on_after_failures(&mut self) {
        self.kernel_failures.get_or_insert(u64::MAX);
    }

    /// True if a flag names a kernel.
    pub fn names_kernels(&self) -> bool {
        !self.kernel_lib.is_empty() || !self.kernel_cmd.is_empty()
    }

    /// The programs that they start: each flag with its word.
    pub fn programs(&self) -> Vec<(&'static str, &str)> {
        let libraries = self
            .kernel_lib
            .iter()
            .map(|path| ("--kernel-lib", path.as_str()));
        let commands = self
            .kernel_cmd
            .iter()
            .map(|line| ("--kernel-cmd", line.as_str()));
        libraries.chain(commands).collect()
    }

    /// The flags that bring the kernels along, as a shell takes them.
    pub fn flags(&self) -> Vec<String> {
        [
            again("--kernel-lib", &self.kernel_lib),
            again("--kernel-cmd", &self.kernel_cmd),
        ]
        .concat()
    }

    /// The names of the libraries, and of the files that commands name, with the digests of their contents.
    pub fn files(&self) -> BTreeMap<String, String> {
        let words = self
            .kernel_cmd
            .iter()
            .filter_map(|line| shlex::split(line))
            .flatten();
        let paths = self.kernel_lib.iter().cloned().chain(words);
        let digest = |path: String| {
            let bytes = Path::new(&path).is_file().then(|| fs::read(&path))?.ok()?;
            // Shards may have it in other folders.
            let name = Path::new(&path).file_name()?.to_string_lossy().into_owned();
            Some((name, hex(&Hash::hash(&bytes)[..8])))
        };
        paths.filter_map(digest).collect()
    }

    /// Lets libraries answer their first batch again and again: a kernel may be wrong after many calls.
    pub fn run_long(&self) {
        let seconds = LONGEST_RUN.min(self.kernel_timeout / 4.0).max(0.0);
        LONG_RUN.store((seconds * 1000.0) as u64, Ordering::Relaxed);
    }

    /// Starts the kernels and puts them into the table.
    pub fn entries(&self) -> Result<Vec<&'static Entry>, Failure> {
        self.entries_known_as(&BTreeMap::new())
    }

    /// The same; a kernel of one of these names goes by the flag beside it, which a record has.
    pub fn entries_known_as(
        &self,
        known: &BTreeMap<String, String>,
    ) -> Result<Vec<&'static Entry>, Failure> {
        self.entries_in(&TRIANGLES, known)
    }

    /// Starts slab tests and puts them into the table of boxes.
    pub fn slab_tests(&self) -> Result<Vec<&'static Entry<Boxes>>, Failure> {
        self.entries_in(&hairline_boxes::TABLE, &BTreeMap::new())
    }

    fn entries_in<T: Asked>(
        &self,
        table: &Table<T>,
        known: &BTreeMap<String, String>,
    ) -> Result<Vec<&'static Entry<T>>, Failure> {
        let limits = self.limits()?;
        refuse_twice("--kernel-lib", &self.kernel_lib)?;
        refuse_twice("--kernel-cmd", &self.kernel_cmd)?;
        let started = |flag: &str, what: &String, program: fn(&str) -> _| {
            let selector = format!("{flag} {}", quoted(what));
            // It is started once for the whole run.
            let started = |entry: &&'static Entry<T>| entry.selector() == selector;
            if let Some(entry) = table.all().into_iter().find(started) {
                return Ok(entry);
            }
            let entry =
                load::<T>(program(what)?, limits, selector).map_err(|error| match error {
                    LoadError::Start(error) => {
                        let message = format!("{what}: it cannot be started: {error}");
                        Failure::Message(Status::InputOutput, message)
                    }
                    LoadError::Hello(message) => Failure::bad_input(format!("{what}: {message}")),
                })?;
            let entry = match known.get(entry.info.name) {
                Some(flag) => entry.chosen_by(flag.clone().leak()),
                None => entry,
            };
            let taken = |message| Failure::bad_input(format!("{what}: {message}"));
            table.register(entry).map_err(taken)
        };
        let libraries = self
            .kernel_lib
            .iter()
            .map(|path| started("--kernel-lib", path, host_of::<T>));
        let commands = self
            .kernel_cmd
            .iter()
            .map(|line| started("--kernel-cmd", line, parsed));
        libraries.chain(commands).collect()
    }

    fn limits(&self) -> Result<ProcessLimits, Failure> {
        let (start, seconds) = (self.kernel_start, self.kernel_timeout);
        for (flag, seconds) in [("--kernel-start", start), ("--kernel-timeout", seconds)] {
            if !(0.001..=86_400.0).contains(&seconds) {
                let message = format!("{flag}: {seconds} is not from 0.001 to 86400 seconds");
                return Err(Failure::usage(message));
            }
        }
        let [start, silence] = [start.max(seconds), seconds].map(Duration::from_secs_f64);
        let failures = self.kernel_failures.unwrap_or(FAILURES);
        // A limit that is set is meant.
        let (first_failures, timeouts) = match self.kernel_failures {
            Some(failures) => (u64::MAX, failures.saturating_add(1)),
            None => (
                FIRST_FAILURES,
                ((PATIENCE_SECONDS / seconds).ceil() as u64).max(3),
            ),
        };
        let tell: fn(&str) = |line| {
            if !IS_QUIET.load(Ordering::Relaxed) {
                eprintln!("{line}");
            }
        };
        let require_ieee = self.require_ieee;
        Ok(ProcessLimits {
            start,
            silence,
            failures,
            first_failures,
            timeouts,
            tell,
            require_ieee,
        })
    }
}

/// The words that start this program again, where that is not the process's own file.
static AGAIN: OnceLock<Vec<String>> = OnceLock::new();

/// Says how this program is started from a shell, where it runs inside another one: the first call counts.
pub fn started_by(words: Vec<String>) {
    AGAIN.get_or_init(|| words);
}

/// This program again, as the process that loads a library.
fn host_of<T: Asked>(path: &str) -> Result<KernelProgram, Failure> {
    if !cfg!(unix) {
        let message = "--kernel-lib needs a Unix system; --kernel-cmd works everywhere";
        return Err(Failure::usage(message));
    }
    let whole = Path::new(path)
        .canonicalize()
        .map_err(|error| Failure::of_file(path, &error))?;
    if let Some(what_to_do) = of_source_code(&whole, path) {
        return Err(Failure::usage(format!("--kernel-lib {path}: {what_to_do}")));
    }
    let own = || std::env::current_exe().map(PathBuf::into_os_string);
    let this = match AGAIN.get() {
        Some(words) => words.iter().map(OsString::from).collect(),
        None => vec![own().map_err(|error| Failure::of_file("this program", &error))?],
    };
    let long_run = LONG_RUN.load(Ordering::Relaxed);
    let long_run = (0 < long_run).then(|| format!("--long-run={long_run}").into());
    let words = this.into_iter().chain([
        HOST_COMMAND.into(),
        T::FORM.judges.into(),
        whole.into_os_string(),
    ]);
    let words = words.chain(long_run);
    let words = words
        .map(|word| word.into_string().ok())
        .collect::<Option<Vec<String>>>();
    words
        .map(KernelProgram::host)
        .ok_or_else(|| Failure::usage(format!("--kernel-lib {path}: a path that is not UTF-8")))
}

/// Advice about a file that is source code and no library, by the end of its name.
fn of_source_code(file: &Path, given: &str) -> Option<String> {
    let library = |compiler: &str| {
        format!(
            "this is source code, not a library; build one: {compiler} {}",
            shell_word(given)
        )
    };
    let program = |runs: &str| {
        let line = format!("{runs} {given}");
        format!(
            "this is no library; a program answers over its pipes (docs/protocol.md): --kernel-cmd {}",
            shell_word(&line)
        )
    };
    match file.extension()?.to_str()? {
        "c" => Some(library("cc -O2 -shared -fPIC -o libmine.so")),
        "cc" | "cpp" | "cxx" => Some(library("c++ -O2 -shared -fPIC -o libmine.so")),
        "rs" => Some(library("rustc -O --crate-type cdylib -o libmine.so")),
        "py" => Some(program("python3")),
        "js" | "mjs" => Some(program("node")),
        _ => None,
    }
}

/// The program of a command line.
fn parsed(line: &str) -> Result<KernelProgram, Failure> {
    let wrong = |error| Failure::usage(format!("--kernel-cmd '{line}': {error}"));
    KernelProgram::parse(line).map_err(wrong)
}

/// An error if the verdicts of a kernel are worth nothing.
pub fn check() -> Result<(), Failure> {
    check_table(&TRIANGLES)?;
    check_table(&hairline_boxes::TABLE)
}

fn check_table<T: Asked>(table: &Table<T>) -> Result<(), Failure> {
    for entry in table.all() {
        let f32 = f32::subject(entry).and_then(|subject| subject.gave_up());
        let f64 = || f64::subject(entry).and_then(|subject| subject.gave_up());
        if let Some(message) = f32.or_else(f64) {
            return Err(Failure::bad_input(format!(
                "kernel '{}': {message}",
                entry.info.name
            )));
        }
    }
    Ok(())
}

/// Ends the kernels' processes, and prints what should be known of them beside their verdicts.
pub fn finish() {
    finish_table(&TRIANGLES);
    finish_table(&hairline_boxes::TABLE);
}

fn finish_table<T: Asked>(table: &Table<T>) {
    for entry in table.all() {
        entry.finish();
        for note in entry.notes() {
            eprintln!("note: kernel '{}': {note}", entry.info.name);
        }
    }
}
