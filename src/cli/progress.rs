//! The progress bar; nothing else knows indicatif.

use crate::audit::Observer;
use crate::record::group_digits;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A bar on a terminal's standard error; silent elsewhere.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    unit: String,
    /// True once a long run is estimated, or nobody wants to know.
    is_told: AtomicBool,
}

/// A run that takes longer says so.
const LONG: Duration = Duration::from_secs(600);

impl Progress {
    /// With a total in some unit; hidden if `quiet` or not on a terminal.
    pub fn new(total: u64, unit: &str, quiet: bool) -> Progress {
        let hidden = quiet || !std::io::stderr().is_terminal();
        let target = if hidden {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        let template = format!("{{wide_bar}} {{human_pos}}/{{human_len}} {unit} {{eta}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        let (unit, is_told) = (unit.to_owned(), AtomicBool::new(quiet));
        Progress {
            bar,
            start: Instant::now(),
            unit,
            is_told,
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

    /// For work without an end, which [`Progress::tell`] describes.
    pub fn without_end(quiet: bool) -> Progress {
        let progress = Progress::new(0, "", quiet);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {wide_msg}") {
            progress.bar.set_style(style);
        }
        progress
    }

    /// Shows one line.
    pub fn tell(&self, message: String) {
        self.bar.set_message(message);
        self.bar.tick();
    }

    /// Sets how far it is.
    pub fn set(&self, position: u64) {
        self.bar.set_position(position);
    }

    /// Says after the first second how long a long run takes.
    fn estimate(&self) {
        let (elapsed, done) = (self.start.elapsed(), self.bar.position());
        let is_early = elapsed < Duration::from_secs(1) || done == 0;
        if is_early || self.is_told.swap(true, Ordering::Relaxed) {
            return;
        }
        let total = self.bar.length().unwrap_or_default();
        let whole = elapsed.as_secs_f64() * total as f64 / done as f64;
        if LONG.as_secs_f64() < whole {
            let time = HumanDuration(Duration::try_from_secs_f64(whole).unwrap_or(Duration::MAX));
            let (total, unit) = (group_digits(total), &self.unit);
            self.bar.suspend(|| {
                eprintln!("{total} {unit} take about {time} at the pace of the first second");
            });
        }
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
