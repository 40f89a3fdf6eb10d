//! `hairline fuzz worst`: searches for the worst cases, and the table of the worst known.

use crate::audit::{Observer, quoted};
use crate::case::Case;
use crate::cli::before::{scalars_in_use, set_threads};
use crate::cli::exit::{Failure, Status};
use crate::cli::flags::{chosen_scalars, unknown};
use crate::cli::input::open;
use crate::cli::output::{write_lines, write_result};
use crate::cli::progress::Progress;
use crate::cli::select::KernelArguments;
use crate::corpus::lines::{AnyCase, bare_case};
use crate::explore::studied::Searched;
use crate::explore::{LANES, Objective, SearchDomain, Update, WorstEntry, WorstGoal, WorstTable};
use crate::kernel::{self, Scalar};
use crate::prove;
use clap::Args;
use std::fs;
use std::io::{self, BufReader, Write};

/// The goals that are searched together, between looks at the clock.
const GOALS_AT_ONCE: usize = 16;

/// The arguments of `worst`: the goals of the search, and its length.
#[derive(Args)]
#[command(mut_arg("band", |band| band.hide(true)))]
pub struct WorstArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    /// f32, f64, or both separated by a comma
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "f32,f64",
        value_name = "SCALAR"
    )]
    scalar: Vec<String>,

    /// Only this gate [default: every gate, and values]
    #[arg(long, value_name = "NAME")]
    gate: Option<String>,

    /// margin, t, uv, wrong-value, false-miss, false-hit, or several separated by commas [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    objective: Vec<String>,

    /// moderate (ordinary sizes and shapes), any, or both separated by a comma
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "moderate,any",
        value_name = "NAME"
    )]
    domain: Vec<String>,

    /// Evaluations for each kernel, epsilons, scalar, objective, gate and domain
    #[arg(long, short = 'n', default_value_t = 20_000, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    evaluations: u64,

    /// Search again with the next seed until this many seconds have passed
    #[arg(long, value_name = "SECONDS")]
    time: Option<u64>,

    /// Seed of the random moves
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Add what is found to this table, where it is worse than what the table has
    #[arg(long, value_name = "FILE", conflicts_with_all = ["list", "contract"])]
    update: Option<String>,

    /// Print the known table instead of searching
    #[arg(long)]
    list: bool,

    /// The table that --list prints [default: the one that the program was built with]
    #[arg(long, value_name = "FILE", requires = "list")]
    table: Option<String>,

    /// Threads [default: all cores]; without --time the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// Print no progress
    #[arg(long, short)]
    quiet: bool,
}

/// The table of the worst known, as it was when the program was built.
const KNOWN: &[u8] = include_bytes!("../../../corpora/worst.jsonl");

/// Runs the command.
pub fn run(arguments: &WorstArguments) -> Result<Status, Failure> {
    let goals = arguments.goals()?;
    if goals.iter().all(Vec::is_empty) {
        return Err(Failure::nothing(
            "no chosen kernel has such an objective at such a gate",
        ));
    }
    if arguments.list {
        return list(arguments, &goals);
    }
    set_threads(arguments.threads)?;
    // What is known is read first: a wrong table is found out before the search, not after.
    let mut known = match arguments.update.as_deref() {
        Some(path) if fs::exists(path).map_err(|error| Failure::of_file(path, &error))? => {
            read_table(path)?
        }
        _ => WorstTable::default(),
    };
    let found = search(arguments, &goals);
    let Some(path) = &arguments.update else {
        write_lines(|out| write_entries(out, found.entries(), None))?;
        return Ok(Status::Success);
    };
    let updates: Vec<(Update, &WorstEntry)> = found
        .entries()
        .map(|entry| (known.merge(entry.clone()), entry))
        .collect();
    write_result(path, |out| known.write(out))?;
    let count = |wanted| {
        updates
            .iter()
            .filter(|(update, _)| *update == wanted)
            .count()
    };
    let (added, raised, kept) = (
        count(Update::Added),
        count(Update::Raised),
        count(Update::Kept),
    );
    eprintln!("{path}: {added} added, {raised} raised, {kept} stay as they were");
    let changed = updates.iter().filter(|(update, _)| *update != Update::Kept);
    let changed = changed.map(|(_, entry)| *entry);
    write_lines(|out| write_entries(out, changed, Some(path)))?;
    Ok(Status::Success)
}

impl WorstArguments {
    /// The goals in `f32`, and in `f64`.
    fn goals(&self) -> Result<[Vec<WorstGoal>; 2], Failure> {
        let no_band = "the worst case is as far as possible from where the verdict would be right";
        let rows = self.kernels.rows_without_band(no_band)?;
        let gates = || {
            rows.iter()
                .flat_map(|row| row.entry.info.gates)
                .map(|gate| gate.name)
        };
        if let Some(gate) = self
            .gate
            .as_deref()
            .filter(|gate| !gates().any(|name| name == *gate))
        {
            return Err(unknown("gate", gate, gates(), "hairline list kernels"));
        }
        let names = || Objective::ALL.map(Objective::name).into_iter();
        for name in &self.objective {
            if !names().any(|known| known == name) {
                return Err(unknown(
                    "objective",
                    name,
                    names(),
                    "hairline fuzz worst --help",
                ));
            }
        }
        let domains = self.domain.iter().map(|name| {
            let names = SearchDomain::ALL.map(SearchDomain::name);
            SearchDomain::named(name)
                .ok_or_else(|| unknown("domain", name, names, "hairline fuzz worst --help"))
        });
        let domains: Vec<SearchDomain> = domains.collect::<Result<_, _>>()?;
        let pairs = rows
            .iter()
            .flat_map(|row| domains.iter().map(move |domain| (row, *domain)));
        let goals: Vec<WorstGoal> = pairs
            .flat_map(|(row, domain)| WorstGoal::of_row(row, domain))
            .filter(|goal| self.wants(goal))
            .collect();
        let scalars = chosen_scalars(&self.scalar)?;
        scalars_in_use(&rows, scalars)?;
        Ok(scalars.map(|chosen| if chosen { goals.clone() } else { Vec::new() }))
    }

    fn wants(&self, goal: &WorstGoal) -> bool {
        let (target, gates) = (goal.target, goal.row.entry.info.gates);
        let gate = target.gate.map(|gate| gates[gate].name);
        let objective = target.objective.name();
        (self.objective.is_empty() || self.objective.iter().any(|name| name == objective))
            && (self.gate.is_none() || self.gate.as_deref() == gate)
    }
}

/// Searches round after round; the first round is always whole.
fn search(arguments: &WorstArguments, [f32_goals, f64_goals]: &[Vec<WorstGoal>; 2]) -> WorstTable {
    let goals = (f32_goals.len() + f64_goals.len()) as u64;
    let progress = Progress::new(goals, "goals", arguments.quiet);
    let seconds = || progress.now() as f64 * 1e-9;
    let mut found = WorstTable::default();
    let (mut searched, mut round) = (0u64, 0u64);
    let mut goes_on = |entries: Vec<Option<WorstEntry>>, round: u64| {
        searched += entries.len() as u64;
        progress.set(searched % goals.max(1));
        entries.into_iter().flatten().for_each(|entry| {
            found.merge(entry);
        });
        round == 0 || arguments.time.is_some_and(|limit| seconds() < limit as f64)
    };
    loop {
        let seed = arguments.seed.wrapping_add(round);
        let went_on = f32_goals
            .chunks(GOALS_AT_ONCE)
            .all(|goals| goes_on(f32::find_worst(goals, arguments.evaluations, seed), round))
            && f64_goals
                .chunks(GOALS_AT_ONCE)
                .all(|goals| goes_on(f64::find_worst(goals, arguments.evaluations, seed), round));
        if !went_on || arguments.time.is_none_or(|limit| seconds() >= limit as f64) {
            break;
        }
        round += 1;
    }
    progress.finish();
    let (evaluations, seconds) = (searched * arguments.evaluations, seconds());
    eprintln!(
        "{evaluations} evaluations of {goals} goals in {LANES} lanes each, {} rounds, {seconds:.1} s: {:.0} evaluations/s, simplifying included",
        round + 1,
        evaluations as f64 / seconds
    );
    found
}

/// The known entries of the chosen kernels, scalars, objectives, gates and domains; of any epsilons,
/// unless some are chosen.
fn list(arguments: &WorstArguments, goals: &[Vec<WorstGoal>; 2]) -> Result<Status, Failure> {
    let table = match &arguments.table {
        Some(path) => read_table(path)?,
        None => WorstTable::read(KNOWN, "the known table")?,
    };
    let key = |goal: &WorstGoal| {
        let epsilons = arguments
            .kernels
            .chooses_epsilons()
            .then(|| goal.row.epsilon_argument());
        (goal.row.entry.info.name, goal.target, goal.domain, epsilons)
    };
    let wanted = |entry: &&WorstEntry| {
        let goals = &goals[usize::from(matches!(entry.case, AnyCase::F64(_)))];
        goals.iter().any(|goal| key(goal) == key(&entry.goal))
    };
    let entries: Vec<&WorstEntry> = table.entries().filter(wanted).collect();
    if entries.is_empty() {
        let message = "the table has no entry for these flags (the program's own is of built-in kernels; without --list \
                       this command searches, which takes minutes)";
        return Err(Failure::nothing(message));
    }
    write_lines(|out| write_entries(out, entries.into_iter(), arguments.table.as_deref()))?;
    Ok(Status::Success)
}

fn read_table(path: &str) -> Result<WorstTable, Failure> {
    Ok(WorstTable::read(BufReader::new(open(path)?), path)?)
}

/// Two lines an entry: how bad it is, and the command that shows it.
fn write_entries<'a>(
    out: &mut dyn Write,
    entries: impl Iterator<Item = &'a WorstEntry>,
    table: Option<&str>,
) -> io::Result<()> {
    let mut entries: Vec<&WorstEntry> = entries.collect();
    let is_f64 = |entry: &WorstEntry| matches!(entry.case, AnyCase::F64(_));
    entries.sort_by_key(|entry| {
        let WorstGoal {
            row,
            target,
            domain,
        } = &entry.goal;
        (
            row.entry.info.name,
            row.epsilon_argument(),
            is_f64(entry),
            *domain,
            *target,
        )
    });
    let mut kernel = String::new();
    for entry in entries {
        let WorstGoal {
            row,
            target,
            domain,
        } = &entry.goal;
        let info = row.entry.info;
        let epsilons = row.epsilon_argument();
        let scalar = if is_f64(entry) { "f64" } else { "f32" };
        let of = match &epsilons {
            Some(epsilons) => format!("{} ({epsilons})", info.name),
            None => info.name.to_owned(),
        };
        if of != kernel {
            writeln!(out, "{of}")?;
            kernel = of;
        }
        let score = entry.score.brief();
        write!(
            out,
            "    {scalar} {:<9} {:<20} {score:>10} {}",
            domain.name(),
            target.name(info),
            target.objective.unit()
        )?;
        if let Some(relative) = relative_error(entry).filter(|error| error.is_finite()) {
            write!(out, " ({relative:.1e} of t)")?;
        }
        if let Some(most) = most_at_its_extents(entry) {
            write!(
                out,
                " (at most {} at these extents, as proved)",
                prove::units(most, true)
            )?;
        }
        writeln!(out)?;
        let case = match table {
            Some(table) => format!("{} --corpus {}", quoted(&entry.name()), quoted(table)),
            None => quoted(&bare_case(entry.case)),
        };
        writeln!(out, "        {}", row.explain_command(&case))?;
    }
    Ok(())
}

/// The relative error of t, of an entry about t.
fn relative_error(entry: &WorstEntry) -> Option<f64> {
    if entry.goal.target.objective != Objective::T {
        return None;
    }
    either_scalar!(&entry.case, case => entry.goal.scorer().relative_error_of_t(case))
}

/// How large the score of a margin can be for any input with the extents of an entry's case; none where the gate divides
/// by anything but the direction's largest coordinate. Of ordinary sizes only: where numbers overflow or underflow a
/// bound says nothing.
fn most_at_its_extents(entry: &WorstEntry) -> Option<f64> {
    let WorstGoal {
        row,
        target,
        domain,
    } = &entry.goal;
    let is_ordinary = target.objective == Objective::Margin && *domain == SearchDomain::Moderate;
    let gate = target.gate.filter(|_| is_ordinary)?;
    either_scalar!(&entry.case, case => {
        let bound = bound_at_extents(row.entry, gate, case)?;
        Some(bound / entry.goal.scorer().unit_of_margin(case, gate))
    })
}

/// A bound of the error of what a gate compares.
fn bound_at_extents<F: Scalar>(entry: &kernel::Entry, gate: usize, case: &Case<F>) -> Option<f64> {
    let domain = prove::Domain::of_sizes(case)?;
    prove::bound_of_gate::<F>(entry, gate, domain).map(|bound| bound.to_f64())
}
