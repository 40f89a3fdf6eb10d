//! The answer on the front page: cracks and doubles beside what is promised, then verdicts by question.

use super::heat::{SHADE_NAMES, shade};
use super::room::Room;
use super::view::View;
use super::words::{interval, percent};
use crate::report::formats::columns::{Across, Cell, Column, shared_in_scenes};
use crate::report::formats::lines::{Line, column_legend};
use crate::report::{group_digits, number_of};
use maud::{Markup, PreEscaped, html};

/// Bytes for the table.
const MOST: usize = 1_000_000;

pub(super) fn section(view: &View, room: &mut Room) -> Markup {
    let has_groups = view.lines.iter().any(|line| line.across.is_some());
    let mut part = room.part(MOST);
    let body = part.fill(view.lines.iter(), |line| row(view, line, has_groups).into_string());
    let left_out = part.left_out;
    room.take_back(part);
    html! {
        section #questions aria-labelledby="questions-title" {
            h2 #questions-title { "Kernels by question" }
            p {
                "Rays that cross a surface at an edge or a vertex: a crack is one that no triangle reports, a double one "
                "that two do. Blue: cracks where the contract promises nothing; orange: what it rules out. Then, in "
                "orange, the share of wrong verdicts on single triangles, false "
                "misses and false hits, by each row's own contract, with the 95 % interval. The cases are chosen to be "
                "hard. A star: more than 0.1 % of the verdicts are wrong by over 1/1000 of the triangle's longest edge."
            }
            @if let Some(note) = shared_in_scenes(view.record) { p { (note) } }
            (legend())
            div.scroll role="group" aria-label="The table" tabindex="0" {
                table.heat.few[view.columns.len() < 12] #questions-table {
                    thead { tr {
                        th scope="col" { "kernel (epsilons)" }
                        @if has_groups {
                            th.text scope="col" data-sort="" { "promised" } th scope="col" data-sort="" { "cracks" } th scope="col" data-sort="" { "doubles" }
                        }
                        @for column in &view.columns { th scope="col" data-sort="" { (column.label()) } }
                    } }
                    tbody { (PreEscaped(body)) }
                }
            }
            @if 0 < left_out {
                p.note { (number_of(left_out, "row is", "rows are")) " left out here; the JSON record has all." }
            }
            p { (column_legend(&view.columns, &view.lines)) "." }
        }
    }
}

fn legend() -> Markup {
    html! {
        div.legend role="group" aria-label="Shades" {
            @for (letter, what) in [("m", "wrong"), ("h", "cracks, not promised")] {
                p {
                    b { (what) }
                    @for (i, name) in SHADE_NAMES.iter().enumerate() { span class={ (letter) (i) } { (name) } }
                }
            }
        }
    }
}

fn row(view: &View, line: &Line, has_groups: bool) -> Markup {
    let row = view.rows.iter().find(|row| std::ptr::eq(row.part, line.row.part));
    let part = line.row.part;
    html! {
        tr {
            th scope="row" {
                @match row {
                    Some(row) => { a href={ "#" (row.anchor) } { (part.kernel) } },
                    None => (part.kernel),
                }
                " " span.set { "(" (part.set) ")" } " " span.what { (line.row.scalar) }
            }
            @if has_groups { (across(line.across.as_ref())) }
            @for (column, cell) in view.columns.iter().zip(&line.cells) { (share_of(*column, cell)) }
        }
    }
}

fn share_of(column: Column, cell: &Cell) -> Markup {
    let Some(share) = cell.wrong.share() else { return html! { td { "–" } } };
    let star = if cell.is_far() { " *" } else { "" };
    let ends = cell.wrong.interval();
    let [count, of] = [cell.wrong.count, cell.wrong.of].map(group_digits);
    html! {
        td class={ "m" (shade(share)) } data-v=(format!("{share:.3e}")) {
            (percent(share)) (star)
            small { @match column.complete {
                true => { (count) " of " (of) },
                false => (interval([ends.low, ends.high])),
            } }
        }
    }
}

/// The cells for a promise, kept or not, and for cracks and doubles, which are shaded where they are ruled out.
fn across(across: Option<&Across>) -> Markup {
    let Some(across) = across else { return html! { td.text { "–" } td { "–" } td { "–" } } };
    let rate = |[count, of]: [u64; 2], hue: &str| {
        let share = count as f64 / of.max(1) as f64;
        let class = if hue.is_empty() { String::new() } else { format!("{hue}{}", shade(share)) };
        html! { td class=(class) data-v=(format!("{share:.3e}")) { (percent(share)) small { (group_digits(count)) " of " (group_digits(of)) } } }
    };
    let [no_crack, no_double] = across.rules_out();
    html! {
        td class={ "text " (promise_class(across)) } data-v=(promise_rank(across)) { (across.words()) }
        (rate(across.cracks, if no_crack { "m" } else { "h" }))
        (rate(across.doubles, if no_double { "m" } else { "" }))
    }
}

/// The colour of a promise: kept, broken, or not made.
fn promise_class(across: &Across) -> &'static str {
    match (across.rules_out()[0], across.is_broken()) {
        (false, _) => "set",
        (true, true) => "broken",
        (true, false) => "kept",
    }
}

/// Broken promises stand before kept ones, and those before none.
fn promise_rank(across: &Across) -> u8 {
    match (across.rules_out()[0], across.is_broken()) {
        (false, _) => 0,
        (true, false) => 1,
        (true, true) => 2,
    }
}

/// Cracks and doubles of one row in one scalar, in a few words.
pub(super) fn in_short(across: &Across) -> Markup {
    let share = |[count, of]: [u64; 2]| percent(count as f64 / of.max(1) as f64);
    html! {
        (share(across.cracks)) " cracks, " (share(across.doubles)) " doubles; promised "
        span class=(promise_class(across)) { (across.words()) }
    }
}
