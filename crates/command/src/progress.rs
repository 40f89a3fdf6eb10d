//! The progress bar; nothing else knows indicatif.

#![forbid(unsafe_code)]

use crate::audit::Observer;
use crate::pace::Pace;
use crate::record::group_digits;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A bar on a terminal's standard error; silent elsewhere.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    pace: Arc<Mutex<Pace>>,
    unit: String,
    /// True once a long run is estimated, or nobody wants to know.
    is_told: AtomicBool,
}

/// A run that takes longer says so.
const LONG: Duration = Duration::from_secs(600);

impl Progress {
    /// With a total in some unit; hidden if `quiet` or not on a terminal.
    pub fn new(total: u64, unit: &str, quiet: bool) -> Progress {
        let progress = Progress::undrawn(total, unit, quiet);
        // The line stands there before the first work is done.
        progress.bar.tick();
        progress
    }

    fn undrawn(total: u64, unit: &str, quiet: bool) -> Progress {
        let hidden = quiet || !std::io::stderr().is_terminal();
        let target = if hidden {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        let pace = Arc::new(Mutex::new(Pace::default()));
        let of_style = pace.clone();
        let left = move |state: &ProgressState, out: &mut dyn fmt::Write| {
            let of_bar = BarState {
                done: state.pos(),
                total: state.len().unwrap_or_default(),
            };
            if let Some(time) = of_bar.left(&of_style) {
                // A line that cannot be drawn is no reason to stop.
                let _ = write!(out, "{} left", HumanDuration(time));
            }
        };
        let template = format!("{{wide_bar}} {{human_pos}}/{{human_len}} {unit} {{left}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style.with_key("left", left));
        }
        Progress {
            bar,
            start: Instant::now(),
            pace,
            unit: unit.to_owned(),
            is_told: AtomicBool::new(quiet),
        }
    }

    /// For what is written to an output; hidden if that is a terminal, as the lines would mix.
    pub fn of_output(total: u64, unit: &str, output: &str) -> Progress {
        Progress::new(
            total,
            unit,
            output == "-" && std::io::stdout().is_terminal(),
        )
    }

    /// For work whose size nobody knows: a line that says what is done, until [`Progress::tell`] has another one.
    pub fn without_end(first: &str, quiet: bool) -> Progress {
        let progress = Progress::undrawn(0, "", quiet);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {wide_msg}") {
            progress.bar.set_style(style);
        }
        progress.tell(first.to_owned());
        progress
    }

    /// Shows one line.
    pub fn tell(&self, message: String) {
        self.bar.set_message(message);
        self.bar.tick();
    }

    /// Adds to the total.
    pub fn expect_more(&self, work: u64) {
        self.bar.inc_length(work);
    }

    /// Says a line above the bar, on a terminal.
    pub fn say(&self, line: &str) {
        self.bar.println(line);
    }

    /// Sets how far it is.
    pub fn set(&self, position: u64) {
        self.bar.set_position(position);
    }

    /// Says once how long a long run takes, when its pace is steady.
    fn estimate(&self) {
        let done = self.bar.position();
        locked(&self.pace).note(done, self.start.elapsed());
        if self.is_told.load(Ordering::Relaxed) {
            return;
        }
        let total = self.bar.length().unwrap_or_default();
        let Some(whole) = seconds_of(total, &self.pace) else {
            return;
        };
        if whole < LONG.as_secs_f64() || self.is_told.swap(true, Ordering::Relaxed) {
            return;
        }
        let time = HumanDuration(duration(whole));
        let (total, unit) = (group_digits(total), &self.unit);
        self.bar.suspend(|| {
            eprintln!("{total} {unit} take about {time} at the pace so far");
        });
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}

/// How far a bar is.
struct BarState {
    done: u64,
    total: u64,
}

/// A run that has done less than one in so many of its rays does not say when it ends: its kinds of rays take unequal times.
const EARLY: u64 = 8;

impl BarState {
    /// The time that is left, if enough is done, at a steady pace.
    fn left(&self, pace: &Mutex<Pace>) -> Option<Duration> {
        if self.done < self.total / EARLY {
            return None;
        }
        let seconds = seconds_of(self.total.saturating_sub(self.done), pace)?;
        Some(duration(seconds))
    }
}

/// How many seconds some work takes; none if the pace is not steady.
fn seconds_of(work: u64, pace: &Mutex<Pace>) -> Option<f64> {
    let per_second = locked(pace).per_second()?;
    Some(work as f64 / per_second)
}

fn duration(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

fn locked(pace: &Mutex<Pace>) -> MutexGuard<'_, Pace> {
    pace.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Observer for Progress {
    fn advance(&self, cases: u64) {
        self.bar.inc(cases);
        self.estimate();
    }

    fn now(&self) -> u64 {
        self.start.elapsed().as_nanos() as u64
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}
