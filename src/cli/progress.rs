//! The progress bar; nothing else knows indicatif.

use crate::audit::Observer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Instant;

/// A bar on a terminal's standard error; silent elsewhere.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
}

impl Progress {
    /// With a total in some unit; hidden if `quiet` or not on a terminal.
    pub fn new(total: u64, unit: &str, quiet: bool) -> Progress {
        let hidden = quiet || !std::io::stderr().is_terminal();
        let target =
            if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        let template = format!("{{wide_bar}} {{human_pos}}/{{human_len}} {unit} {{eta}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        Progress { bar, start: Instant::now() }
    }

    /// For what is written to an output; hidden if that is a terminal, as the lines would mix.
    pub fn of_output(total: u64, unit: &str, output: &str) -> Progress {
        Progress::new(total, unit, output == "-" && std::io::stdout().is_terminal())
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

    /// Adds to the total.
    pub fn add_total(&self, more: u64) {
        self.bar.inc_length(more);
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
