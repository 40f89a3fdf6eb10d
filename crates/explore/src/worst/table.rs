//! The worst known cases: a table that only grows, kept as a corpus file.
//!
//! Each line is a case with its truth. Its name says what it is the worst of,
//! `worst:kernel/scalar/epsilons/target/domain`; its `why` how bad it is,
//! `score=… found=… seed=… evaluations=… unit=…`: the exact score of this case, rounded to seventeen
//! digits; the score that the search found, before the case was simplified; and what finds it again.

use super::climb::{WorstGoal, exact_score, search};
use crate::audit::Row;
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::decimal::Decimal;
use crate::domain::SearchDomain;
use crate::engine;
use crate::files::InputError;
use crate::kernel::Scalar;
use crate::objective::SearchTarget;
use crate::shrink::shrink_scored;
use crate::simplify::Size;
use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};

/// The prefix of the names of the table's cases.
const PREFIX: &str = "worst:";

/// A row of the table.
#[derive(Clone)]
pub struct WorstEntry {
    /// The goal for which this is the worst case.
    pub goal: WorstGoal,
    /// The witness.
    pub case: AnyCase,
    /// The witness's exact score, rounded.
    pub score: Decimal,
    /// The score of the case that the search found, before it was simplified.
    pub found: Decimal,
    /// The seed of that search.
    pub seed: u64,
    /// Its evaluations.
    pub evaluations: u64,
}

/// The result of proposing an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Update {
    /// Nothing was known before.
    Added,
    /// It is worse than the known one, or as bad and simpler, and takes its place.
    Raised,
    /// The known one stays.
    Kept,
}

/// The worst known entry of each goal.
#[derive(Clone, Default)]
pub struct WorstTable {
    entries: BTreeMap<String, WorstEntry>,
}

/// Searches, and simplifies what was found: an entry a goal, none where nothing has a score.
pub fn find_worst<F: Scalar>(
    goals: &[WorstGoal],
    evaluations: u64,
    seed: u64,
) -> Vec<Option<WorstEntry>> {
    let found = search::<F>(goals, evaluations, seed);
    let pairs: Vec<_> = goals.iter().zip(found).collect();
    engine::map(&pairs, |(goal, found)| {
        let found = found.as_ref()?;
        let shrunk = shrink_scored(&goal.scorer::<F>(), &found.case);
        let case = shrunk.map_or(found.case, |shrunk| shrunk.case);
        let score = exact_score(goal, &case)?;
        let (goal, case) = ((*goal).clone(), AnyCase::from(case));
        Some(WorstEntry {
            goal,
            case,
            score,
            found: found.score,
            seed,
            evaluations,
        })
    })
}

impl WorstEntry {
    /// The name of its case.
    pub fn name(&self) -> String {
        let name = in_named_scalar!(self.case.scalar(), F => self.goal.name::<F>());
        format!("{PREFIX}{name}")
    }

    /// As a case of a corpus file, its truth included.
    pub fn stored(&self) -> StoredCase {
        let WorstEntry {
            score,
            found,
            seed,
            evaluations,
            ..
        } = self;
        let unit = self.goal.target.objective.unit();
        let why = format!(
            "score={score} found={found} seed={seed} evaluations={evaluations} unit={unit}"
        );
        let stored = StoredCase::of(self.case).with_truth();
        StoredCase {
            name: Some(self.name()),
            why: Some(why),
            ..stored
        }
    }

    /// The entry that a stored case is; none if its name says that it is none.
    fn of_stored(stored: &StoredCase) -> Option<Result<WorstEntry, String>> {
        let name = stored.name.as_ref()?.strip_prefix(PREFIX)?;
        let parsed = parse_goal(name, &stored.case).and_then(|goal| {
            let [score, found, seed, evaluations] = parse_why(stored.why.as_deref())?;
            let count = |text: &str| text.parse().map_err(|_| format!("'{text}' is no count"));
            Ok(WorstEntry {
                goal,
                case: stored.case,
                score: score.parse()?,
                found: found.parse()?,
                seed: count(seed)?,
                evaluations: count(evaluations)?,
            })
        });
        let entry = parsed.and_then(|entry| {
            let written = entry.name();
            let same = Some(&written) == stored.name.as_ref();
            same.then_some(entry)
                .ok_or_else(|| format!("its name would be '{written}'"))
        });
        Some(entry)
    }

    /// True if this entry takes the place of a known one.
    fn replaces(&self, known: &WorstEntry) -> bool {
        let size = |case: &AnyCase| either_scalar!(case, case => Size::of(case));
        match self.score.cmp(&known.score) {
            std::cmp::Ordering::Greater => true,
            std::cmp::Ordering::Equal => size(&self.case) < size(&known.case),
            std::cmp::Ordering::Less => false,
        }
    }
}

/// `kernel/scalar/epsilons/target/domain`; the scalar is that of the case.
fn parse_goal(name: &str, case: &AnyCase) -> Result<WorstGoal, String> {
    let shape = || format!("'{name}' is not kernel/scalar/epsilons/target/domain");
    let parts: [&str; 5] = name
        .split('/')
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|_| shape())?;
    let [kernel, scalar, epsilons, target, domain] = parts;
    if scalar != case.scalar().name() {
        return Err(format!(
            "'{name}' is of {scalar}, its case of {}",
            case.scalar()
        ));
    }
    let epsilons = Some(epsilons).filter(|text| *text != "-");
    let row = Row::named(kernel, epsilons, "own")?;
    row.check_in(case.scalars())?;
    let target = SearchTarget::find(target, row.entry.info)
        .ok_or_else(|| format!("'{target}' is nothing that {kernel} is searched for"))?;
    let domain = SearchDomain::named(domain).ok_or_else(|| format!("unknown domain '{domain}'"))?;
    Ok(WorstGoal {
        row,
        target,
        domain,
    })
}

/// The values of score, found, seed and evaluations.
fn parse_why(why: Option<&str>) -> Result<[&str; 4], String> {
    let expected = "why: expected score=… found=… seed=… evaluations=… unit=…";
    let words: Vec<&str> = why.unwrap_or_default().splitn(5, ' ').collect();
    let words: [&str; 5] = words.try_into().map_err(|_| expected.to_owned())?;
    let value = |i: usize, key: &str| {
        let text = words[i]
            .strip_prefix(key)
            .and_then(|rest| rest.strip_prefix('='));
        text.ok_or_else(|| expected.to_owned())
    };
    value(4, "unit")?;
    Ok([
        value(0, "score")?,
        value(1, "found")?,
        value(2, "seed")?,
        value(3, "evaluations")?,
    ])
}

/// Computes the score of a stored case of the table again, exactly. True if it is a case of the
/// table; an error if the score is another one.
pub fn replay(stored: &StoredCase) -> Result<bool, String> {
    let Some(entry) = WorstEntry::of_stored(stored) else {
        return Ok(false);
    };
    let entry = entry?;
    match either_scalar!(&entry.case, case => exact_score(&entry.goal, case)) {
        Some(score) if score == entry.score => Ok(true),
        Some(score) => Err(format!("its score is {score}, not {}", entry.score)),
        None => {
            Err("it has no score: it shows nothing of the kind, or is outside the domain".into())
        }
    }
}

impl WorstTable {
    /// From a corpus file in which every case is an entry, each with the score that it says.
    pub fn read(reader: impl BufRead, file: &str) -> Result<WorstTable, InputError> {
        let mut table = WorstTable::default();
        for stored in lines::read(reader, file) {
            let stored = stored?;
            let wrong = |message: String| InputError::at(file, stored.line, message);
            let none = || wrong(format!("no entry: its name does not begin with '{PREFIX}'"));
            let entry = WorstEntry::of_stored(&stored)
                .ok_or_else(none)?
                .map_err(wrong)?;
            replay(&stored).map_err(wrong)?;
            if table.entries.insert(entry.name(), entry).is_some() {
                return Err(wrong("a second entry of this name".to_owned()));
            }
        }
        Ok(table)
    }

    /// Takes an entry in if nothing worse is known.
    pub fn merge(&mut self, entry: WorstEntry) -> Update {
        let name = entry.name();
        let update = match self.entries.get(&name) {
            None => Update::Added,
            Some(known) if entry.replaces(known) => Update::Raised,
            Some(_) => return Update::Kept,
        };
        self.entries.insert(name, entry);
        update
    }

    /// The entries, in the order of their names.
    pub fn entries(&self) -> impl Iterator<Item = &WorstEntry> {
        self.entries.values()
    }

    /// One line an entry.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.entries()
            .try_for_each(|entry| writeln!(out, "{}", lines::write_case(&entry.stored())))
    }
}
