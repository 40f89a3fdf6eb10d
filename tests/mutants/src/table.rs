//! What a run says: a table with a line a module, and the survivors.

use crate::config::Config;
use crate::find::Mutant;
use crate::results::Results;

/// A line a module, and all together.
pub fn table(config: &Config, results: &Results, chosen: &[&Mutant], refused: usize) -> String {
    let programs: Vec<&str> = config
        .programs
        .iter()
        .map(|program| program.name.as_str())
        .collect();
    let others = [
        "equivalent",
        "not reached",
        "lived",
        "left over",
        "may live",
    ];
    let titles = ["mutants", "killed"]
        .into_iter()
        .chain(programs.iter().copied())
        .chain(others);
    let mut text = format!("{:<12}", "module");
    titles.for_each(|title| text += &format!("{title:>12}"));
    let modules = config
        .modules
        .iter()
        .map(|module| (module.name.as_str(), Some(module)));
    for (name, module) in modules.chain([("all", None)]) {
        let of_module = |mutant: &&&Mutant| module.is_none_or(|module| module.has(&mutant.file));
        let (equivalent, others): (Vec<&Mutant>, Vec<&Mutant>) = chosen
            .iter()
            .filter(of_module)
            .partition(|mutant| config.is_equivalent(mutant));
        let count = |by: &str, outcome: &str| {
            let last = others
                .iter()
                .filter_map(|mutant| results.of(by, mutant, true));
            last.filter(|line| line.outcome == outcome).count()
        };
        let all = equivalent.len() + others.len();
        let [killed, not_reached, lived] =
            ["killed", "not reached", "lived"].map(|outcome| count("tests", outcome));
        let killed_by = programs.iter().map(|program| count(program, "killed"));
        let counts = [all, killed].into_iter().chain(killed_by);
        let tried = killed + not_reached + lived + equivalent.len();
        if 0 < all {
            text += &format!("\n{name:<12}");
            counts
                .chain([equivalent.len(), not_reached, lived])
                .for_each(|n| text += &format!("{n:>12}"));
            text += &format!(
                "{:>10.1} %",
                100.0 * (not_reached + lived) as f64 / tried.max(1) as f64
            );
            let may_live = module.map(|m| format!("{:>10.1} %", 100.0 * m.may_live));
            text += &may_live.unwrap_or_default();
        }
    }
    text + &format!("\nnot counted: {refused} that do not compile")
}

/// Whether no module has more survivors than it may, by what `by` notices. An equivalent that was killed is one too
/// many.
pub fn is_met(config: &Config, results: &Results, by: &str, chosen: &[&Mutant]) -> bool {
    config.modules.iter().all(|module| {
        let of_module = chosen.iter().filter(|mutant| module.has(&mutant.file));
        let (mut tried, mut lived) = (0, 0);
        for mutant in of_module {
            let outcome = results
                .of(by, mutant, true)
                .map(|line| line.outcome == "killed");
            match (config.is_equivalent(mutant), outcome) {
                (true, Some(true)) => return false,
                (true, _) => tried += 1,
                (false, Some(killed)) => (tried, lived) = (tried + 1, lived + u32::from(!killed)),
                (false, None) => {}
            }
        }
        f64::from(lived) <= module.may_live * f64::from(tried)
    })
}

/// The mutants that lived or were not reached, without equivalents; and equivalents that were killed.
pub fn survivors(config: &Config, results: &Results, by: &str, chosen: &[&Mutant]) -> Vec<String> {
    let line = |mutant: &&&Mutant| {
        let line = results.of(by, mutant, true)?;
        let note = match (config.is_equivalent(mutant), line.outcome.as_str()) {
            (true, "killed") => format!(" (no equivalent: killed by {})", line.test),
            (true, _) | (false, "killed") => return None,
            (false, "not reached") => " (not reached)".to_owned(),
            (false, _) => String::new(),
        };
        Some(mutant.describe() + &note)
    };
    chosen.iter().filter_map(|mutant| line(&mutant)).collect()
}
