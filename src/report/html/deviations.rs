//! What a check found that was not expected, and what was expected and not found.

use super::room::Room;
use super::words::{code, counts, link, shortened};
use crate::report::{Conformance, Deviation, Method, Record, group_digits, number_of};
use maud::{Markup, PreEscaped, html};

/// Bytes for each list.
const MOST: usize = 700_000;

/// The section; nothing for a record that was not compared.
pub(super) fn section(record: &Record, room: &mut Room) -> Markup {
    let Some(conformance) = &record.conformance else { return html! {} };
    let told = conformance.known.iter().filter(|known| known.why.is_some() || known.url.is_some());
    let told: Vec<&Deviation> = told.collect();
    html! {
        section #deviations aria-labelledby="deviations-title" {
            h2 #deviations-title { "Deviations" }
            p { (how(conformance)) }
            @if !conformance.unproved.is_empty() {
                h3 { "Proofs missing (" (conformance.unproved.len()) ")" }
                ul.cards.unexpected {
                    @for unproved in &conformance.unproved {
                        li { p { (unproved) } p.example { (code(&unproved.command)) } }
                    }
                }
            }
            (list("Unexpected", "unexpected", conformance, conformance.unexpected.iter(), room))
            (list("Stale: what was wrong is less so, or gone", "stale", conformance, conformance.stale.iter(), room))
            (list("Known, with a reason", "known", conformance, told.into_iter(), room))
        }
    }
}

fn how(conformance: &Conformance) -> Markup {
    let known = number_of(
        conformance.known.len() as u64,
        "known disagreement came true",
        "known disagreements came true",
    );
    html! {
        @match (&conformance.expectations, conformance.method) {
            (None, _) => "There is no file of expectations: nothing is expected to happen.",
            (Some(file), Method::CaseByCase) => {
                "Compared case by case with " code { (shortened(file, 200)) } ". " (known) "."
            }
            (Some(file), Method::Intervals) => {
                "Compared by intervals with " code { (shortened(file, 200)) } ", which is of other cases. "
                (known) "."
            }
        }
        @if let Some(note) = &conformance.note { " " (note) "." }
        @for change in &conformance.rows { " " (change) "." }
        @if 0 < conformance.too_rare_to_tell {
            " " (group_digits(conformance.too_rare_to_tell))
            " classes of disagreement have no entry and are too rare to tell from none."
        }
        @if 0 < conformance.outside_the_plan {
            " " (group_digits(conformance.outside_the_plan))
            " expectations are of kernels, scalars or families that this plan leaves out."
        }
    }
}

fn list<'a>(
    title: &str,
    class: &str,
    conformance: &Conformance,
    deviations: impl ExactSizeIterator<Item = &'a Deviation>,
    room: &mut Room,
) -> Markup {
    let count = deviations.len() as u64;
    let mut part = room.part(MOST);
    let items = part.fill(deviations, |found| card(conformance, found).into_string());
    let left_out = part.left_out;
    room.take_back(part);
    html! {
        @if 0 < count {
            h3 { (title) " (" (group_digits(count)) ")" }
            ul class={ "cards " (class) } { (PreEscaped(items)) }
            @if 0 < left_out {
                p.note { (number_of(left_out, "more is", "more are")) " left out here; the JSON record has all." }
            }
        }
    }
}

fn card(conformance: &Conformance, found: &Deviation) -> Markup {
    let place = conformance.expectations.as_ref().zip(found.line);
    html! {
        li {
            p {
                b { (found.kernel) " (" (found.set) ")" } " " (found.scalar) " " (found.family) ": "
                (found.finding) " of " (found.class)
            }
            p {
                "found " (counts(&found.found)) ", expected " (found.expected)
                @if let Some((file, line)) = place { " (" (shortened(file, 200)) ":" (line) ")" }
            }
            @if let Some(why) = &found.why { p.why { (why) } }
            @if let Some(url) = &found.url { p.why { (link(url)) } }
            @if let Some(command) = &found.command { p.example { (code(command)) } }
            @if let Some(bits) = found.bits.as_ref().filter(|bits| !bits.is_empty()) {
                p.example { (code(bits)) }
            }
        }
    }
}
