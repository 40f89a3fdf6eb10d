//! `hairline fuzz`: a campaign that goes on past the first finding.

mod directory;
mod shrink;
mod summary;
mod triage;
mod worst;

use super::before::{scalars_in_use, set_threads};
use super::exit::{Failure, Status};
use super::flags::chosen_scalars;
use super::output::{standard_output, write_lines};
use super::progress::Progress;
use super::select::KernelArguments;
use crate::audit::shell_word;
use crate::explore::campaign::{Campaign, CampaignPlan, CampaignState, Find};
use crate::printable::printable;
use clap::{Args, Subcommand};
use directory::{Begun, CAMPAIGN, Directory, FORMAT, NO_BAND};
use std::io::Write;
use summary::write_summary;

/// The seconds between two savings of counters and population, at least and at most: a session that
/// is killed early should not have been for nothing.
const SAVE_EVERY: [f64; 2] = [0.5, 10.0];

/// The commands for findings.
#[derive(Subcommand)]
pub enum FuzzCommand {
    /// Keep one small finding of each kind, out of campaigns, corpora and cargo-fuzz artifacts
    Triage(triage::TriageArguments),
    /// Make a case with a finding as simple as possible, as JSON, Rust and C to paste into a test
    Shrink(shrink::ShrinkArguments),
    /// Search for the worst case of each kernel and gate, and keep the worst known
    Worst(Box<worst::WorstArguments>),
}

/// Where the campaign is kept, what it searches, and how long it runs.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    mut_arg("band", |band| band.hide(true))
)]
pub struct FuzzArguments {
    #[command(subcommand)]
    command: Option<FuzzCommand>,

    /// The campaign's directory; a campaign that is already there goes on
    #[arg(
        value_name = "DIR",
        required_unless_present = "output",
        conflicts_with = "output"
    )]
    directory: Option<String>,

    /// The same as DIR
    #[arg(long, short, value_name = "DIR")]
    output: Option<String>,

    #[command(flatten)]
    kernels: KernelArguments,

    /// f32, f64, or both separated by a comma [default: both]
    #[arg(long, value_delimiter = ',', value_name = "SCALAR")]
    scalar: Vec<String>,

    /// Seed of the random cases [default: 1]
    #[arg(long)]
    seed: Option<u64>,

    /// Stop this session after this many seconds [default: when it is killed, which loses nothing]
    #[arg(long, value_name = "SECONDS")]
    time: Option<f64>,

    /// Stop when the campaign has made this many evaluations; the findings then depend on the seed only
    #[arg(long, short = 'n', value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    evaluations: Option<u64>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// Print the name of each finding once it is on the disk
    #[arg(long)]
    print: bool,

    /// Print no live status
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &FuzzArguments) -> Result<Status, Failure> {
    match &arguments.command {
        Some(FuzzCommand::Triage(arguments)) => triage::run(arguments),
        Some(FuzzCommand::Shrink(arguments)) => shrink::run(arguments),
        Some(FuzzCommand::Worst(arguments)) => worst::run(arguments),
        None => campaign(arguments),
    }
}

/// Begins a campaign or goes on with it.
fn campaign(arguments: &FuzzArguments) -> Result<Status, Failure> {
    let path = arguments.directory.as_ref().or(arguments.output.as_ref());
    let path = path.ok_or_else(|| Failure::usage("say where the campaign is kept: DIR"))?;
    if let Some(seconds) = arguments
        .time
        .filter(|seconds| seconds.is_nan() || *seconds < 0.0)
    {
        return Err(Failure::usage(format!(
            "--time: {seconds} is no number of seconds"
        )));
    }
    // Wrong flags are found out before a directory is made.
    plan(&arguments.asked())?;
    set_threads(arguments.threads)?;
    let mut directory = Directory::open(path)?;
    let begun = arguments.begun(&directory, path)?;
    let mut campaign = Campaign::new(&plan(&begun)?);
    let finds = directory.finds()?;
    finds.iter().for_each(|find| campaign.learn(find));
    let state = directory.state()?;
    campaign
        .restore(&state)
        .map_err(|message| directory.wrong_state(message))?;
    let mut session = Session::new(arguments, directory, campaign, finds, &state);
    let outcome = session.go_on(arguments);
    session.progress.finish();
    // A full disk does not keep the summary from being printed.
    let (finds, new, state) = (&session.finds, session.new_finds(), session.state());
    write_lines(|out| write_summary(out, path, finds, new, &state))?;
    outcome.map(|()| Status::Success)
}

/// The plan of a campaign.
fn plan(begun: &Begun) -> Result<CampaignPlan, Failure> {
    let rows = begun.kernels.rows_without_band(NO_BAND)?;
    let scalars = scalars_in_use(&rows, chosen_scalars(&begun.scalar)?)?;
    let varies = !begun.kernels.chooses_epsilons();
    Ok(CampaignPlan {
        rows,
        varies,
        scalars,
        seed: begun.seed,
    })
}

impl FuzzArguments {
    /// The beginning of a new campaign under these flags.
    fn asked(&self) -> Begun {
        let both = || vec!["f32".to_owned(), "f64".to_owned()];
        let scalar = if self.scalar.is_empty() {
            both()
        } else {
            self.scalar.clone()
        };
        // A campaign is for keeping on, and to a kernel that crashes a crash is no news.
        let kernels = self.kernels.clone().go_on_after_failures();
        let version = env!("CARGO_PKG_VERSION").to_owned();
        Begun {
            format: FORMAT,
            version,
            kernels,
            scalar,
            seed: self.seed.unwrap_or(1),
        }
    }

    /// The plan that the campaign was begun with; a new one is begun. Flags that are given must agree.
    fn begun(&self, directory: &Directory, path: &str) -> Result<Begun, Failure> {
        let asked = self.asked();
        let Some(begun) = directory.begun()? else {
            directory.begin(&asked)?;
            return Ok(asked);
        };
        let is_other = self.kernels != KernelArguments::default()
            && asked.kernels != begun.kernels
            && !begun.kernels.are_named_by(&self.kernels);
        let other = [
            ("kernels, epsilons or contract", is_other),
            (
                "scalars",
                !self.scalar.is_empty() && asked.scalar != begun.scalar,
            ),
            ("seed", self.seed.is_some() && asked.seed != begun.seed),
        ];
        if let Some((what, _)) = other.into_iter().find(|(_, differs)| *differs) {
            return Err(Failure::usage(format!(
                "{path}: the campaign was begun with other {what} (see {path}/{CAMPAIGN}); leave those flags out to go on with it, or name another directory"
            )));
        }
        // A directory may be somebody else's: what it names is not run because it stands there.
        if !begun.kernels.runs_no_more_than(&self.kernels) {
            let programs = begun.kernels.plugins.flags().join(" ");
            return Err(Failure::usage(format!(
                "{path}: the campaign runs a program that {path}/{CAMPAIGN} names: to run it, name it again: hairline fuzz {} {programs}",
                shell_word(path)
            )));
        }
        Ok(begun)
    }
}

/// A campaign that runs.
struct Session {
    directory: Directory,
    campaign: Campaign,
    finds: Vec<Find>,
    progress: Progress,
    /// The sessions with this one.
    sessions: u64,
    /// The seconds of the sessions before.
    seconds_before: f64,
    finds_before: usize,
    evaluations_before: u64,
}

impl Session {
    fn new(
        arguments: &FuzzArguments,
        directory: Directory,
        campaign: Campaign,
        finds: Vec<Find>,
        state: &CampaignState,
    ) -> Session {
        // Finds may be younger than the state.
        let last = finds
            .iter()
            .filter_map(|find| find.found.seconds)
            .fold(0.0, f64::max);
        Session {
            progress: Progress::without_end("the first round", arguments.quiet),
            sessions: state.sessions.saturating_add(1),
            seconds_before: state.seconds.max(last),
            finds_before: finds.len(),
            evaluations_before: campaign.evaluations,
            directory,
            campaign,
            finds,
        }
    }

    /// Round after round, until time or evaluations are used up.
    fn go_on(&mut self, arguments: &FuzzArguments) -> Result<(), Failure> {
        self.save()?;
        let mut saved = 0.0;
        loop {
            let left = arguments
                .evaluations
                .map(|n| n.saturating_sub(self.campaign.evaluations));
            let time_is_up = arguments
                .time
                .is_some_and(|limit| limit <= self.progress.seconds());
            if time_is_up || left == Some(0) {
                return self.save();
            }
            let finds = self.campaign.round(left.unwrap_or(u64::MAX));
            self.keep(finds, arguments.print)?;
            self.progress.tell(self.status());
            let [least, most] = SAVE_EVERY;
            if self.progress.seconds() - saved >= f64::clamp(saved, least, most) {
                self.save()?;
                saved = self.progress.seconds();
            }
        }
    }

    /// Finds count, and are printed, once they are on the disk.
    fn keep(&mut self, mut finds: Vec<Find>, print: bool) -> Result<(), Failure> {
        if finds.is_empty() {
            return Ok(());
        }
        let seconds = (self.seconds() * 10.0).round() / 10.0;
        finds
            .iter_mut()
            .for_each(|find| find.found.seconds = Some(seconds));
        self.directory.append(&finds)?;
        if print {
            let mut out = standard_output()?;
            finds
                .iter()
                .try_for_each(|find| writeln!(out, "{}", printable(&find.name())))?;
            out.flush()?;
        }
        self.finds.extend(finds);
        Ok(())
    }

    fn save(&self) -> Result<(), Failure> {
        self.directory.save(&self.state())
    }

    fn state(&self) -> CampaignState {
        self.campaign.state(self.seconds(), self.sessions)
    }

    fn new_finds(&self) -> usize {
        self.finds.len() - self.finds_before
    }

    fn seconds(&self) -> f64 {
        self.seconds_before + self.progress.seconds()
    }

    fn status(&self) -> String {
        let here = self.campaign.evaluations - self.evaluations_before;
        let last = self
            .finds
            .last()
            .map_or(String::new(), |find| format!("; last: {}", find.name()));
        format!(
            "{:.0} s, {} evaluations ({:.0}/s), {} signatures (+{}){last}",
            self.seconds(),
            self.campaign.evaluations,
            here as f64 / self.progress.seconds(),
            self.finds.len(),
            self.new_finds(),
        )
    }
}
