//! Small plots: what is wrong at every epsilon of a gate.

use super::room::Room;
use super::view::Row;
use super::words::{interval, percent};
use crate::plot::{Decades, decades_around};
use crate::report::chart::{Chart, Frame, Mark};
use crate::report::{Record, ResponsePart, group_digits};
use maud::{Markup, PreEscaped, html};

const FRAME: Frame =
    Frame { width: 340.0, left: 46.0, right: 10.0, above: 8.0, plot: 140.0, zero: 18.0 };

/// The lines, by question.
const LINES: [(&str, &str); 3] = [
    ("misses", "false misses"),
    ("hits", "false hits that this gate is there to refuse"),
    ("cracks", "cracks"),
];

/// The plots of a row.
pub(super) fn figures(record: &Record, row: &Row, room: &mut Room) -> Markup {
    let Some(illustrations) = &record.illustrations else { return html! {} };
    let parts = illustrations
        .responses
        .iter()
        .filter(|part| part.kernel == row.part.kernel && part.set == row.part.set);
    let parts: Vec<&ResponsePart> = parts.collect();
    if parts.is_empty() {
        return html! {};
    }
    let left_out = room.left_out;
    let text = room.fill(parts.iter(), |part| figure(part).into_string());
    html! {
        h4 { "Every epsilon" }
        p {
            "How often the kernel is wrong as one epsilon varies and the others stay, on at most "
            (group_digits(illustrations.indices)) " indices of each of "
            (group_digits(illustrations.families.len() as u64))
            " sources. The upright line is this row's epsilon; shaded is the 95 % interval."
        }
        ul.lines aria-hidden="true" {
            @for (class, name) in LINES {
                li { svg viewBox="0 0 34 8" { path class={ "line " (class) } d="M0 4h34" {} } " " (name) }
            }
        }
        div.plots { (PreEscaped(text)) }
        @if left_out < room.left_out {
            p.note { (group_digits(room.left_out - left_out)) " plots are left out here; the JSON record has their numbers." }
        }
    }
}

fn figure(part: &ResponsePart) -> Markup {
    let chart = drawn(part);
    let name = format!("{} gate {}", part.scalar, part.gate);
    html! {
        figure {
            figcaption { b { (name) } " " (words(part)) }
            svg.chart.plot viewBox=(format!("0 0 {} {}", FRAME.width, chart.height)) role="img" aria-label={ "Shares of wrong answers by epsilon of " (name) "; the numbers stand in the caption" } {
                (PreEscaped(chart.drawing))
            }
        }
    }
}

/// The plot in words.
fn words(part: &ResponsePart) -> Markup {
    let epsilon = |text: &str| match text.parse::<f64>() {
        Ok(value) if 8 < text.len() => format!("≈ {value:.2e}"),
        _ => format!("= {text}"),
    };
    let share = |question: usize, count: u64| {
        let mut counts = [0; 3];
        counts[question] = count;
        part.share(question, counts)
    };
    let told = |question: usize, count: u64| match share(question, count) {
        Some((share, Some(ends))) => format!("{} [{}]", percent(share), interval(ends)),
        Some((share, None)) => percent(share),
        None => "none possible".to_owned(),
    };
    html! {
        "At e " (epsilon(&part.epsilon)) ": false misses " (told(0, part.own[0]))
        ", false hits let through " (told(1, part.own[1])) ". "
        @if let Some((fewest, _)) = share(0, part.misses.0) {
            "Fewest misses (" (percent(fewest)) ") up to e " (epsilon(&part.misses.1))
            @if let Some((fewest, _)) = share(1, part.hits.0) {
                ", fewest hits (" (percent(fewest)) ") from e " (epsilon(&part.hits.1))
            }
            "."
        }
    }
}

/// The decades of one sign in which shares change visibly, and the row's own epsilon.
fn span(part: &ResponsePart, points: &[(f64, [u64; 3])], sign: f64) -> Option<Decades> {
    let moved = |pair: &&[(f64, [u64; 3])]| {
        (0..3).any(|k| {
            let change = pair[0].1[k].abs_diff(pair[1].1[k]) as f64;
            change > 2e-3 * part.asked[k] as f64
        })
    };
    // What changes between zero and the smallest number needs no decades of its own.
    let smallest = if part.scalar == "f32" { 2e-45 } else { 5e-324 };
    let changes = points.windows(2).filter(moved).map(|pair| pair[1].0);
    let changes = changes.filter(|e| smallest < e.abs());
    let own = part.epsilon.parse::<f64>().ok();
    decades_around(changes.chain(own).filter(|e| e * sign > 0.0))
}

fn drawn(part: &ResponsePart) -> Chart {
    let points = part.points.iter();
    let points: Vec<(f64, [u64; 3])> =
        points.filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts))).collect();
    let asked = part.asked.iter().max().copied().unwrap_or(1);
    let decades = [-1.0, 1.0].map(|sign| span(part, &points, sign));
    let own = part.epsilon.parse::<f64>().ok();
    let text = format!("e = {}", part.epsilon);
    let own: Vec<Mark> = own.map(|value| Mark { value, text, is_this: true }).into_iter().collect();
    let mut chart = Chart::new(FRAME, decades, (asked, 5), &own);
    for (question, (class, _)) in LINES.into_iter().enumerate() {
        if 0 < part.asked[question] {
            let point = |(epsilon, counts): &(f64, [u64; 3])| {
                let (share, interval) = part.share(question, *counts)?;
                // The cracks' interval would hide the others.
                Some((*epsilon, share, interval.filter(|_| question < 2)))
            };
            chart.line(class, points.iter().map_while(point));
        }
    }
    chart
}
