//! The conformance part of a record as text for people.

use super::net::{NET_TITLE, net_lines};
use super::{Conformance, Deviation, Method, Record, RowChange, group_digits};
use crate::report::number_of;
use crate::report::page::{Block, Item, Items};

/// The most deviations of a kind that the text lists without `--details`.
const MOST_LISTED: usize = 3;

/// The meaning of the words of a class.
const CLASSES: &str = "of interior/back/within: where the line meets the triangle, which side it comes from, where on the \
                       ray (within, before its start, beyond its end)";

/// The blocks below the verdict of a `check`.
pub(super) fn blocks(record: &Record, conformance: &Conformance) -> Vec<Block> {
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
    let mut texts = vec![format!("{}, plan {plan}: {how}", record.provenance.tool)];
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
    let mut blocks: Vec<Block> = texts.into_iter().map(Block::Text).collect();
    let unproved = conformance.unproved.iter();
    let unproved = unproved.map(|it| Item::shown_by(it.to_string(), it.command.clone()));
    let title = "Proofs that [proved] demands and that are missing";
    blocks.extend(Block::items(title, MOST_LISTED, unproved.collect()));
    let net = net_lines(conformance);
    let net = net.into_iter().map(|text| Item { text, ..Item::default() }).collect();
    blocks.extend(Block::items(NET_TITLE, MOST_LISTED, net));
    let stale =
        "Stale expectations (what was wrong is less so, or gone; --bless writes what was found)";
    let unsteady = "Answers differ from run to run, so these kernels are not compared";
    for (title, list) in [
        (unsteady, &conformance.unsteady),
        ("Unexpected disagreements", &conformance.unexpected),
        (stale, &conformance.stale),
    ] {
        let items = list.iter().map(|found| deviation(conformance, found)).collect();
        blocks.extend(Block::items(title, MOST_LISTED, items));
    }
    let mut all = conformance.unexpected.iter().chain(&conformance.stale);
    if all.any(|found| found.class.contains('/')) {
        blocks.push(Block::text(CLASSES));
    }
    let told = conformance.known.iter().filter(|known| known.why.is_some() || known.url.is_some());
    let told: Vec<Item> = told.map(|found| deviation(conformance, found)).collect();
    if !told.is_empty() {
        let items = vec![Block::Items(Items { items: told, most: usize::MAX })];
        blocks.push(Block::Details("Known, with a reason".to_owned(), items));
    }
    blocks
}

fn deviation(conformance: &Conformance, found: &Deviation) -> Item {
    let place = conformance.expectations.as_ref().zip(found.line);
    let place = place.map_or(String::new(), |(file, line)| format!("{file}:{line}: "));
    Item {
        text: format!("{place}{}", found.describe()),
        notes: found.why.iter().cloned().collect(),
        url: found.url.clone(),
        lines: found.command.iter().cloned().collect(),
        more: found.bits.iter().filter(|bits| !bits.is_empty()).cloned().collect(),
    }
}
