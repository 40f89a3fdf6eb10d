//! Records may be of somebody else: before anything of one counts, it has to keep what stands here.
//!
//! Its numbers agree with each other, its names are names, and its commands are those that this program makes of them.

use crate::audit::{is_one_command, quoted};
use crate::finding::Example;
use crate::kernel;
use crate::kind::FindingKind;
use crate::plan::{PlanFlags, Provenance, RowPart};
use crate::result::{Counts, KernelResult, ResultPart};

/// The flags that choose a kernel, each with one word.
const SELECTORS: [&str; 3] = ["--kernel ", "--kernel-lib ", "--kernel-cmd "];

impl ResultPart {
    /// An error in one line if something contradicts something else, or the flags that made it.
    pub fn check_with(&self, provenance: &Provenance) -> Result<(), String> {
        for row in &self.plan.rows {
            row.check()
                .map_err(|message| format!("plan.rows: {message}"))?;
        }
        for result in &self.results {
            let place = result.place();
            let row = self
                .plan
                .rows
                .iter()
                .find(|row| [&row.kernel, &row.set] == place[..2]);
            let checked = match row {
                Some(row) => result.check(row),
                None => Err("no row of the plan".to_owned()),
            };
            checked.map_err(|message| format!("results of {}: {message}", place.join(" ")))?;
        }
        provenance.check_programs(&self.plan.rows)
    }
}

impl RowPart {
    fn check(&self) -> Result<(), String> {
        let kernel = &self.kernel;
        kernel::check_name(kernel)?;
        let selector = &self.selector;
        let word = SELECTORS
            .iter()
            .find_map(|flag| selector.strip_prefix(flag));
        // Answers from elsewhere have none.
        if !selector.is_empty() && !word.is_some_and(is_one_word) {
            return Err(format!("selector: {selector:?} chooses no kernel"));
        }
        // They stand in apostrophes, and the contract in none.
        let mut words = self.epsilons.iter().flat_map(|(name, value)| [name, value]);
        let wrong = words
            .find(|word| word.contains('\''))
            .or(Some(&self.contract_words));
        if let Some(wrong) =
            wrong.filter(|word| !is_one_command(word) || word.contains([' ', '\'']))
        {
            return Err(format!("{wrong:?} is neither an epsilon nor a contract"));
        }
        Ok(())
    }
}

/// True for one word of a shell, plain or as [`quoted`] writes it.
fn is_one_word(text: &str) -> bool {
    let quoted = text
        .strip_prefix('\'')
        .and_then(|rest| rest.strip_suffix('\''));
    let is_whole = match quoted {
        // An apostrophe in it stands outside of the quotes, behind a backslash.
        Some(inside) => !inside.replace("'\\''", "").contains('\''),
        None => !text.contains([' ', '\'', '\\']),
    };
    is_whole && !text.is_empty() && is_one_command(text)
}

impl KernelResult {
    fn check(&self, row: &RowPart) -> Result<(), String> {
        for (what, count) in COUNTED {
            // Numbers of somebody else may have no sum.
            let of_classes = self
                .classes
                .values()
                .map(count)
                .fold(0, u64::saturating_add);
            let total = count(&self.total);
            if of_classes != total {
                return Err(format!("{what}: {total} in all, and {of_classes} by class"));
            }
        }
        if self.total.cases < self.total.hits {
            return Err(format!(
                "{} hits of {} cases",
                self.total.hits, self.total.cases
            ));
        }
        for (class, counts) in &self.classes {
            for &kind in FindingKind::OF_A_TRIANGLE {
                let counted = counts.rate(kind).map_or(0, |rate| rate.count);
                let parts = self.findings.iter();
                let told = parts.filter(|part| part.finding == kind && part.class == *class);
                let told = told
                    .map(|part| part.rate.count)
                    .fold(0, u64::saturating_add);
                if counted != told {
                    return Err(format!("{kind} of {class}: {counted} counted, {told} told"));
                }
            }
        }
        if let Some(part) = self
            .findings
            .iter()
            .find(|part| !self.classes.contains_key(&part.class))
        {
            return Err(format!(
                "a finding of {:?}, which did not occur",
                part.class.name()
            ));
        }
        let mut examples = self
            .findings
            .iter()
            .flat_map(|part| part.first.iter().chain([&part.worst]));
        examples.try_for_each(|example| example.check(row))
    }
}

type Count = fn(&Counts) -> u64;

/// Counts of a result that those of its classes add up to.
const COUNTED: [(&str, Count); 14] = [
    ("cases", |counts| counts.cases),
    ("free cases", |counts| counts.free),
    ("hits", |counts| counts.hits),
    ("cases to hit", |counts| counts.false_misses.of),
    ("false misses", |counts| counts.false_misses.count),
    ("cases to miss", |counts| counts.false_hits.of),
    ("false hits", |counts| counts.false_hits.count),
    ("values", |counts| counts.bad_values.of),
    ("bad values", |counts| counts.bad_values.count),
    ("finite values", |counts| counts.wrong_values.of),
    ("wrong values", |counts| counts.wrong_values.count),
    ("panics", |counts| counts.panics),
    ("crashes", |counts| counts.crashes),
    ("timeouts", |counts| counts.timeouts),
];

impl Example {
    /// The command shows the case with the row's own flags; before them may stand the file that has the case.
    fn check(&self, row: &RowPart) -> Result<(), String> {
        let shown = format!("hairline explain {}", quoted(&self.case));
        let rest = self.command.strip_prefix(&shown);
        let rest = rest.and_then(|rest| without_flags(rest, row));
        let is_file = |rest: &str| {
            let rest = rest.trim();
            let file = ["--mesh ", "--corpus "]
                .iter()
                .find_map(|flag| rest.strip_prefix(flag));
            let parts = file.map(|words| words.split(" --instance "));
            rest.is_empty() || parts.is_some_and(|mut words| words.all(is_one_word))
        };
        match rest.as_deref().is_some_and(is_file) {
            true => Ok(()),
            false => Err(format!(
                "command: {:?} does not show {:?}",
                self.command, self.case
            )),
        }
    }
}

/// The part of a command before the flags of a row; none if it does not end in those. Epsilons may stand in any order.
fn without_flags(command: &str, row: &RowPart) -> Option<String> {
    let sorted = |line: &str| match line.split_once("--epsilon '") {
        Some((before, rest)) if rest.contains('\'') => {
            let (words, after) = rest.split_once('\'').unwrap_or_default();
            let mut words: Vec<&str> = words.split(',').collect();
            words.sort_unstable();
            format!("{before}--epsilon '{}'{after}", words.join(","))
        }
        _ => line.to_owned(),
    };
    let command = sorted(command);
    command
        .strip_suffix(&sorted(&row.flags()))
        .map(str::to_owned)
}

impl Provenance {
    /// An error in one line if its flags start a program that no row of the plan is of, or write a file.
    fn check_programs(&self, rows: &[RowPart]) -> Result<(), String> {
        let Some(flags) = &self.plan_flags else {
            return Ok(());
        };
        // A selector may stand there without the quotes that it does not need.
        let forms = rows
            .iter()
            .flat_map(|row| [row.selector.clone(), row.selector.replace('\'', "")]);
        let known = forms.filter(|form| !form.is_empty());
        let rest = known.fold(flags.all().join(" "), |rest, form| rest.replace(&form, ""));
        let mut words = rest.split(' ');
        let acts = |word: &str| {
            word.contains("--kernel-lib")
                || word.contains("--kernel-cmd")
                || word.starts_with("-o")
                || word.starts_with("--o")
        };
        match words.find(|word| acts(word)) {
            Some(word) => Err(format!(
                "provenance.plan_flags: {word:?} is of no row of the plan"
            )),
            None => Ok(()),
        }
    }

    /// An error in one line if something in it would do more than be told.
    pub fn check(&self) -> Result<(), String> {
        let is_of_target = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        if self.target.is_empty() || !self.target.chars().all(is_of_target) {
            return Err(format!(
                "provenance.target: {:?} is none; expected one as x86_64-linux",
                self.target
            ));
        }
        let flags = self.plan_flags.as_ref().map(PlanFlags::all);
        if let Some(wrong) = flags.into_iter().flatten().find(|it| !is_one_command(it)) {
            return Err(format!("provenance.plan_flags: {wrong:?} are no flags"));
        }
        self.parts.iter().try_for_each(Provenance::check)
    }
}
