//! What a run says: a table with a line a module, and the survivors.

use crate::config::Config;
use crate::find::Mutant;
use crate::results::Results;
use std::fmt::Write;

/// A line a module, and all together.
pub fn table(config: &Config, results: &Results, chosen: &[&Mutant], refused: usize) -> String {
    let programs: Vec<&str> = config.programs.iter().map(|program| program.name.as_str()).collect();
    let mut text = format!("{:<16}{:>9}{:>9}", "module", "mutants", "killed");
    let wide = ["equivalent", "not reached", "lived", "share"];
    for title in programs.iter().copied().chain(wide) {
        write!(text, "{title:>13}").expect("to a string");
    }
    let modules = config.modules.iter().map(|module| (module.name.as_str(), Some(module)));
    for (name, module) in modules.chain([("all", None)]) {
        let of_module = |mutant: &&&Mutant| module.is_none_or(|module| module.has(&mutant.file));
        let here: Vec<&Mutant> = chosen.iter().filter(of_module).copied().collect();
        let count = |by: &str, outcome: &str| {
            let is = |mutant: &&&Mutant| {
                results.of(by, mutant, true).is_some_and(|line| line.outcome == outcome)
            };
            here.iter().filter(is).count()
        };
        let tried = here.iter().filter(|m| results.of("tests", m, true).is_some()).count();
        let equivalent = here.iter().filter(|m| is_equivalent(config, m)).count();
        let lived = |outcome: &str| {
            let left = here.iter().filter(|m| !is_equivalent(config, m));
            let is =
                |m: &&&Mutant| results.of("tests", m, true).is_some_and(|l| l.outcome == outcome);
            left.filter(is).count()
        };
        if here.is_empty() {
            continue;
        }
        let (lived, not_reached) = (lived("lived"), lived("not reached"));
        let share = 100.0 * (lived + not_reached) as f64 / tried.max(1) as f64;
        write!(text, "\n{name:<16}{:>9}{:>9}", here.len(), count("tests", "killed"))
            .expect("to a string");
        for program in &programs {
            write!(text, "{:>13}", count(program, "killed")).expect("to a string");
        }
        write!(text, "{equivalent:>13}{not_reached:>13}{lived:>13}{share:>11.1} %")
            .expect("to a string");
    }
    text + &format!("\nnot counted: {refused} that do not compile")
}

/// The mutants that lived or were not reached, without equivalents; and equivalents that were killed.
pub fn survivors(config: &Config, results: &Results, by: &str, chosen: &[&Mutant]) -> Vec<String> {
    let line = |mutant: &&&Mutant| {
        let line = results.of(by, mutant, true)?;
        let note = match (is_equivalent(config, mutant), line.outcome.as_str()) {
            (true, "killed") => format!(" (no equivalent: killed by {})", line.test),
            (true, _) | (false, "killed") => return None,
            (false, "not reached") => " (not reached)".to_owned(),
            (false, _) => String::new(),
        };
        Some(mutant.describe() + &note)
    };
    chosen.iter().filter_map(|mutant| line(&mutant)).collect()
}

fn is_equivalent(config: &Config, mutant: &Mutant) -> bool {
    config.equivalents.iter().any(|entry| entry.matches(mutant))
}
