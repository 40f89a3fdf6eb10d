//! Small plots: what is wrong at every epsilon of a gate.

use super::room::Room;
use super::view::Row;
use super::words::{interval, percent};
use crate::plot::{Decades, EpsilonAxis, ShareAxis, decades_around};
use crate::report::{Record, ResponsePart, group_digits};
use maud::{Markup, PreEscaped, html};

const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 190.0;
const LEFT: f64 = 46.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 30.0;
/// The width of the stretch around zero.
const ZERO: f64 = 18.0;

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
    let plot = Plot::new(part);
    let name = format!("{} gate {}", part.scalar, part.gate);
    html! {
        figure {
            figcaption { b { (name) } " " (words(part)) }
            (plot.draw(&name))
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

struct Plot<'a> {
    part: &'a ResponsePart,
    /// Epsilons with their counts, in order.
    points: Vec<(f64, [u64; 3])>,
    across: EpsilonAxis,
    down: ShareAxis,
}

impl<'a> Plot<'a> {
    fn new(part: &'a ResponsePart) -> Plot<'a> {
        let points = part.points.iter();
        let points = points.filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts)));
        let points: Vec<(f64, [u64; 3])> = points.collect();
        let asked = part.asked.iter().max().copied().unwrap_or(1);
        let decades = [-1.0, 1.0].map(|sign| span(part, &points, sign));
        let across = EpsilonAxis::new(LEFT, WIDTH - RIGHT, ZERO, decades);
        Plot { part, points, across, down: ShareAxis::new(TOP, HEIGHT - BOTTOM, asked, 5) }
    }

    fn draw(&self, name: &str) -> Markup {
        let own = self.part.epsilon.parse::<f64>().ok().map(|e| self.across.x(e));
        html! {
            svg.plot viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label={ "Shares of wrong answers by epsilon of " (name) "; the numbers stand in the caption" } {
                (self.axes())
                @for question in 0..3 {
                    @if 0 < self.part.asked[question] { (self.line(question)) }
                }
                @if let Some(x) = own {
                    path.own d=(format!("M{x:.1} {:.1}V{}", HEIGHT - BOTTOM, TOP - 4.0)) {}
                    text.own x=(format!("{:.1}", x.clamp(LEFT + 24.0, WIDTH - RIGHT - 24.0))) y=(TOP - 9.0) text-anchor="middle" { "e = " (self.part.epsilon) }
                }
            }
        }
    }

    fn axes(&self) -> Markup {
        let bottom = HEIGHT - BOTTOM;
        html! {
            @for (y, label) in self.down.ticks() {
                path.grid d=(format!("M{LEFT} {y:.1}H{}", WIDTH - RIGHT)) {}
                text x=(LEFT - 5.0) y=(format!("{:.1}", y + 3.5)) text-anchor="end" { (label) }
            }
            path.axis d=(format!("M{LEFT} {bottom}H{}", WIDTH - RIGHT)) {}
            text x=(LEFT - 5.0) y=(format!("{:.1}", bottom + 3.5)) text-anchor="end" { "none" }
            @for (x, label) in self.across.ticks(44.0, WIDTH) {
                path.axis d=(format!("M{x:.1} {bottom}v4")) {}
                text x=(format!("{x:.1}")) y=(bottom + 16.0) text-anchor="middle" { (label) }
            }
        }
    }

    /// A question's share by epsilon, with its interval behind it.
    fn line(&self, question: usize) -> Markup {
        let drawn = self.points.iter().map(|(e, counts)| (self.across.x(*e), *counts));
        let first = self.points.first().map(|(_, counts)| (LEFT, *counts));
        let shares = first.into_iter().chain(drawn).map_while(|(x, counts)| {
            let (share, interval) = self.part.share(question, counts)?;
            Some((x, share, interval))
        });
        let (path, band) = self.down.steps(shares, WIDTH - RIGHT);
        let class = LINES[question].0;
        html! {
            @if !band.is_empty() && question < 2 { path class={ "band " (class) } d=(band) {} }
            path class={ "line " (class) } d=(path) {}
        }
    }
}
