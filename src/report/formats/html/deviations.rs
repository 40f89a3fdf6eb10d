//! The deviations that a check found: what was not expected, and what was expected and not found.

use super::room::Room;
use super::words::{code, counts, link, shortened};
use crate::report::formats::net::{NET_TITLE, net_lines};
use crate::report::{Conformance, Deviation, Method, Record, group_digits, number_of};
use maud::{Markup, PreEscaped, html};

/// Bytes for each list.
const MOST: usize = 700_000;

/// The section; nothing for a record that was not compared.
pub(super) fn section(record: &Record, room: &mut Room) -> Markup {
    let Some(conformance) = &record.conformance else { return html! {} };
    let net = net_lines(conformance, usize::MAX);
    let card = |found: &Deviation| card(conformance, found);
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
            (list(NET_TITLE, "net", net.iter(), room, |line: &String| html! { li { (line) } }))
            (list("Unexpected", "cards unexpected", conformance.unexpected.iter(), room, card))
            (list("Stale: what was wrong is less so, or gone", "cards stale", conformance.stale.iter(), room, card))
            (list("Known, with a reason", "cards known", told.into_iter(), room, card))
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
            " Without an entry, and too rare to tell from none: "
            (number_of(conformance.too_rare_to_tell, "class of disagreement", "classes of disagreement")) "."
        }
        @if 0 < conformance.outside_the_plan {
            " " (group_digits(conformance.outside_the_plan))
            " expectations are of kernels, scalars or families that this plan leaves out."
        }
    }
}

/// A list of pieces, as many as there is room for; nothing of none.
fn list<T>(
    title: &str,
    class: &str,
    all: impl ExactSizeIterator<Item = T>,
    room: &mut Room,
    piece: impl Fn(T) -> Markup,
) -> Markup {
    let count = all.len() as u64;
    let mut part = room.part(MOST);
    let items = part.fill(all, |one| piece(one).into_string());
    let left_out = part.left_out;
    room.take_back(part);
    html! {
        @if 0 < count {
            h3 { (title) " (" (group_digits(count)) ")" }
            ul class=(class) { (PreEscaped(items)) }
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
