//! The conformance part of a record as text for people, with the changes between expectations and a run, in cases: by row
//! and finding, so that a trade is seen as one.

use super::relations;
use super::remedies::remedies;
use crate::arith::Float;
use crate::case::Case;
use crate::explain::number;
use crate::judge::Class;
use crate::page::{Block, Cell, Head, Item, Items, Row, Table};
use hairline_record::{
    ComparisonVerdict, Conformance, Deviation, ErrorChange, Method, NetFinding, Record, RowChange,
    ShortCase, group_digits, number_of,
};
use std::array;

/// The most deviations of a kind that the text lists without `--details`.
const MOST_LISTED: usize = 3;

/// The most lines of changes on a screen.
const MOST_CHANGES: usize = 8;

/// The meaning of the words of a class.
const CLASSES: &str = "A class, as interior/back/within: where the line meets the triangle, which side it comes from, where on the \
                       ray (within, before its start, beyond its end)";

/// The blocks below the first line of a `check`.
pub(super) fn blocks(record: &Record, conformance: &Conformance) -> Vec<Block> {
    let mut blocks: Vec<Block> = reasons(record, conformance)
        .into_iter()
        .map(Block::Text)
        .collect();
    let unproved = conformance.unproved.iter();
    let unproved = unproved.map(|it| Item::shown_by(it.to_string(), it.command.clone()));
    let title = "Proofs that [proved] demands and that are missing";
    blocks.extend(Block::items(title, MOST_LISTED, unproved.collect()));
    blocks.extend(net_table(conformance));
    // What is better is read where nothing is worse.
    let is_worse = conformance.verdict == ComparisonVerdict::Disagreements;
    let mut better = Vec::new();
    let errors = "Errors of right hits, of a sample";
    let (large, small): (Vec<&ErrorChange>, Vec<&ErrorChange>) = conformance
        .errors
        .iter()
        .partition(|change| change.is_worse || !is_worse);
    blocks.extend(Block::items(errors, MOST_LISTED, in_words(&large)));
    better.extend(Block::items(errors, MOST_LISTED, in_words(&small)));
    blocks.extend(
        conformance
            .short_case
            .iter()
            .flat_map(|short| short_case(conformance, short)),
    );
    let unsteady = "Answers differ from run to run, so these kernels are not compared";
    blocks.extend(listed(conformance, unsteady, &conformance.unsteady));
    blocks.extend(listed(
        conformance,
        "Unexpected disagreements",
        &conformance.unexpected,
    ));
    let stale =
        "Stale expectations (what was wrong is less so, or gone; --bless writes what was found)";
    let stale = listed(conformance, stale, &conformance.stale);
    match is_worse {
        true => better.extend(stale),
        false => blocks.extend(stale),
    }
    let mut all = conformance.unexpected.iter().chain(&conformance.stale);
    if all.any(|found| found.class.truth().is_some_and(Class::crosses)) {
        blocks.push(Block::text(CLASSES));
    }
    blocks.extend(Block::items(
        "What to do",
        MOST_LISTED,
        remedies(record, conformance),
    ));
    blocks.push(Block::Text(compared(record, conformance)));
    if !better.is_empty() {
        blocks.push(Block::Details("What is better".to_owned(), better));
    }
    let classes = vec![Block::Text(super::capitalised(&conformance.summary()))];
    blocks.push(Block::Details("In classes".to_owned(), classes));
    let told = conformance
        .known
        .iter()
        .filter(|known| known.why.is_some() || known.url.is_some());
    let told: Vec<Item> = told.map(|found| deviation(conformance, found)).collect();
    if !told.is_empty() {
        let items = vec![Block::Items(Items {
            items: told,
            most: usize::MAX,
        })];
        blocks.push(Block::Details("Known, with a reason".to_owned(), items));
    }
    blocks
}

/// The reason as far as it is known, and what could not be compared, a sentence each.
fn reasons(record: &Record, conformance: &Conformance) -> Vec<String> {
    let mut texts = Vec::new();
    if !conformance.unexpected.is_empty() {
        let mistakes = relations::new_sentences(record, conformance).into_iter();
        texts.extend(mistakes.map(|mistake| format!("{mistake}.")));
        let computes = conformance.computes.iter();
        texts.extend(computes.map(|it| format!("{} ({}): {it}.", it.kernel, it.set)));
    }
    let [more, fewer] = conformance.more_and_fewer();
    if 0 < more && more < fewer {
        let classes = number_of(conformance.unexpected.len() as u64, "class", "classes");
        texts.push(format!(
            "Fewer answers are wrong in total. The check fails because {classes} of cases have more, or other, wrong answers \
             than known: some that were right, or wrong in another way, are wrong in this way now."
        ));
    }
    texts.extend(conformance.note.clone());
    texts.extend(conformance.rows.iter().map(RowChange::to_string));
    if 0 < conformance.too_rare_to_tell {
        texts.push(format!(
            "without an entry, and too rare to tell from none: {}",
            number_of(
                conformance.too_rare_to_tell,
                "class of disagreement",
                "classes of disagreement"
            )
        ));
    }
    if 0 < conformance.outside_the_plan {
        texts.push(format!(
            "{} expectations are of kernels, scalars or families that this plan leaves out",
            group_digits(conformance.outside_the_plan)
        ));
    }
    texts
}

/// The run, and the file that it was compared with.
fn compared(record: &Record, conformance: &Conformance) -> String {
    let how = match (conformance.method, &conformance.expectations) {
        (_, None) => "nothing is expected: there is no file of expectations".to_owned(),
        (Method::CaseByCase, Some(file)) if conformance.is_by_family => {
            format!("compared family by family with {file}")
        }
        (Method::CaseByCase, Some(file)) => format!("compared case by case with {file}"),
        (Method::Intervals, Some(file)) => format!(
            "compared by intervals with {file}, which is of other cases (it has {} entries)",
            group_digits(conformance.expected())
        ),
    };
    let plan = &record.result.plan.hash;
    format!("{}, plan {plan}: {how}", record.provenance.tool)
}

fn in_words(changes: &[&ErrorChange]) -> Vec<Item> {
    changes
        .iter()
        .map(|change| Item::of(change.to_string()))
        .collect()
}

/// A short case of what got worse, and the command that shows it.
fn short_case(conformance: &Conformance, short: &ShortCase) -> Vec<Block> {
    let ShortCase {
        scalar,
        family,
        class,
        finding,
        ..
    } = short;
    let title = format!("A short case: {finding} of {class}, {scalar}, from {family}");
    let numbers =
        in_named_scalar!(*scalar, F => Case::<F>::from_hex(&short.bits).map(|case| listing(&case)));
    let about = match (&short.right, &conformance.expectations) {
        (Some(formula), _) => format!("{formula} as published is right on it."),
        (None, Some(_)) => {
            "An older build of the kernel may be wrong on it too: ask it with the same command."
                .to_owned()
        }
        (None, None) => "This shows it:".to_owned(),
    };
    let item = Item {
        text: about,
        lines: vec![short.command.clone()],
        more: vec![short.bits.clone()],
        ..Item::default()
    };
    let mut blocks = vec![Block::Heading(title)];
    blocks.extend(numbers.map(Block::Listing));
    blocks.push(Block::Items(Items {
        items: vec![item],
        most: 1,
    }));
    blocks
}

/// A case's vectors, one a line, and its interval if it is not from 0 to infinity.
fn listing<F: Float>(case: &Case<F>) -> String {
    let vectors = case.vectors().map(|vector| vector.map(number));
    let widths: [usize; 3] = array::from_fn(|axis| {
        let lengths = vectors.iter().map(|vector| vector[axis].len());
        lengths.max().unwrap_or_default()
    });
    let names = ["origin", "direction", "a", "b", "c"];
    let mut lines: Vec<String> = names
        .iter()
        .zip(&vectors)
        .map(|(name, [x, y, z])| {
            let [of_x, of_y, of_z] = widths;
            format!("{name:<9}  {x:>of_x$}  {y:>of_y$}  {z:>of_z$}")
        })
        .collect();
    let [t_min, t_max] = [case.ray.t_min, case.ray.t_max];
    if t_min != F::zero() || t_max != F::infinity() {
        lines.push(format!(
            "t within   {} and {}",
            number(t_min),
            number(t_max)
        ));
    }
    lines.join("\n")
}

/// Classes that deviate, with their commands: one of many on a screen.
fn listed(conformance: &Conformance, title: &str, list: &[Deviation]) -> Vec<Block> {
    let items: Vec<Item> = list
        .iter()
        .map(|found| deviation(conformance, found))
        .collect();
    let most = match items.len() <= MOST_LISTED {
        true => MOST_LISTED,
        false => 1,
    };
    Block::items(title, most, items)
}

fn deviation(conformance: &Conformance, found: &Deviation) -> Item {
    let place = conformance.expectations.as_ref().zip(found.line);
    let place = place.map_or(String::new(), |(file, line)| format!("{file}:{line}: "));
    Item {
        text: format!("{place}{}", found.describe()),
        notes: found.why.iter().cloned().collect(),
        url: found.url.clone(),
        lines: found.command.iter().cloned().collect(),
        more: found
            .bits
            .iter()
            .filter(|bits| !bits.is_empty())
            .cloned()
            .collect(),
    }
}

/// The most families that a finding names.
const MOST_FAMILIES: usize = 1;

/// The changes in cases, by row and finding: a trade is seen as one.
fn net_table(conformance: &Conformance) -> Vec<Block> {
    let net = conformance.net();
    if net.is_empty() || conformance.expectations.is_none() {
        return Vec::new();
    }
    let is_of_one = net.iter().all(|one| one.row == net[0].row);
    let row = |one: &NetFinding<'_>| {
        let of_row = match is_of_one {
            true => String::new(),
            false => format!("{} ", one.row),
        };
        let change = one.now.wrapping_sub(one.known).cast_signed();
        let cells = [
            Cell::count(one.known),
            Cell::count(one.now),
            Cell::number(change as f64, signed(change)).broken_if(0 < change),
            Cell::words(most_changed(one)),
        ];
        Row::new(format!("{of_row}{} {}", one.scalar, one.finding), cells)
    };
    let heads = vec![
        Head::default(),
        Head::of("known"),
        Head::of("now"),
        Head::of("change"),
        Head::text("most in"),
    ];
    let title = match is_of_one {
        true => format!("What changed in {}: wrong answers, by kind", net[0].row),
        false => "What changed: wrong answers, by kernel and kind".to_owned(),
    };
    let table = Table::new(heads, net.iter().map(row).collect()).at_most(MOST_CHANGES);
    vec![Block::Heading(title), Block::Table(table)]
}

/// `sliver +794, grazing +771, 3 more`.
fn most_changed(net: &NetFinding<'_>) -> String {
    let named = net.families.iter().take(MOST_FAMILIES);
    let mut words: Vec<String> = named
        .map(|(name, more)| format!("{name} {}", signed(*more)))
        .collect();
    if MOST_FAMILIES < net.families.len() {
        words.push(format!("{} more", net.families.len() - MOST_FAMILIES));
    }
    words.join(", ")
}

/// `+1,234`, `-5`, `0`.
fn signed(number: i64) -> String {
    let sign = match number {
        0 => "",
        1.. => "+",
        _ => "-",
    };
    format!("{sign}{}", group_digits(number.unsigned_abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ScalarName;
    use crate::page::html::tests::{conformance, deviation};
    use hairline_record::FindingKind;

    #[test]
    fn a_trade_is_a_line() {
        let of = |family: &str, finding: FindingKind, expected: Option<u64>, found: u64| {
            let mut one = deviation("k", "");
            (one.family, one.finding) = (family.to_owned(), finding);
            (one.expected_count, one.found.count) = (expected, found);
            one
        };
        let mut all = conformance(vec![
            of("tiny", FindingKind::FalseMiss, Some(10), 1_234),
            of("tiny", FindingKind::FalseMiss, Some(5), 4),
            of("fan", FindingKind::FalseMiss, Some(0), 3),
            of("far", FindingKind::FalseMiss, Some(7), 2),
            of("sliver", FindingKind::FalseMiss, Some(0), 1),
            of("axis-aligned", FindingKind::BadValue, Some(1), 4),
            of("fan", FindingKind::BadValue, Some(3), 0),
            // As many on other cases, and a share: no number of cases.
            of("huge", FindingKind::Crack, Some(4), 4),
            of("huge", FindingKind::Double, None, 4),
        ]);
        all.stale = vec![
            of("far", FindingKind::FalseHit, Some(20), 0),
            of("fan", FindingKind::Panic, Some(8), 0),
        ];
        // Nothing of it is in the run.
        all.stale[1].found.of = 0;
        let mut other = of("tiny", FindingKind::Crack, Some(0), 1);
        other.scalar = ScalarName::F64;
        all.stale.push(other);
        all.known.clear();
        let told = |all: &Conformance| -> Vec<String> {
            let net = all.net();
            let line = |one: &NetFinding<'_>| {
                let NetFinding {
                    row,
                    scalar,
                    finding,
                    known,
                    now,
                    ..
                } = one;
                format!(
                    "{row} {scalar} {finding}: {known} to {now}, {}",
                    most_changed(one)
                )
            };
            net.iter().map(line).collect()
        };
        let expected = [
            "k (k) f32 bad-value: 4 to 4, axis-aligned +3, 1 more",
            "k (k) f32 false-hit: 20 to 0, far -20",
            "k (k) f32 false-miss: 22 to 1244, tiny +1,223, 3 more",
            "k (k) f64 crack: 0 to 1, tiny +1",
        ];
        assert_eq!(told(&all), expected);
        assert_eq!(
            all.more_and_fewer(),
            [1_234 - 10 + 3 + 1 + 3 + 1, 1 + 5 + 3 + 20]
        );
        all.method = Method::Intervals;
        assert_eq!(told(&all), [""; 0]);
    }
}
