//! Small plots: what is wrong at every epsilon of a gate.

use super::room::Room;
use super::view::Row;
use super::words::{interval, percent};
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

struct Plot<'a> {
    part: &'a ResponsePart,
    /// Epsilons with their counts, in order.
    points: Vec<(f64, [u64; 3])>,
    /// Decades of negative epsilons, from small to large, and of positive ones; none if not drawn.
    decades: [Option<(i32, i32)>; 2],
    /// The exponent of ten of the smallest share that is drawn.
    lowest: i32,
}

impl<'a> Plot<'a> {
    fn new(part: &'a ResponsePart) -> Plot<'a> {
        let points = part.points.iter();
        let points = points.filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts)));
        let asked = part.asked.iter().max().copied().unwrap_or(1).max(1);
        let lowest = (-((asked as f64).log10().ceil() as i32)).clamp(-5, -1);
        let mut plot = Plot { part, points: points.collect(), decades: [None, None], lowest };
        plot.decades = [plot.span(-1.0), plot.span(1.0)];
        if plot.decades == [None, None] {
            plot.decades[1] = Some((-8, 0));
        }
        plot
    }

    /// The decades of one sign in which shares change visibly, and the row's own epsilon.
    fn span(&self, sign: f64) -> Option<(i32, i32)> {
        let moved = |pair: &&[(f64, [u64; 3])]| {
            (0..3).any(|k| {
                let change = pair[0].1[k].abs_diff(pair[1].1[k]) as f64;
                change > 2e-3 * self.part.asked[k] as f64
            })
        };
        // What changes between zero and the smallest number needs no decades of its own.
        let smallest = if self.part.scalar == "f32" { 2e-45 } else { 5e-324 };
        let changes = self.points.windows(2).filter(moved).map(|pair| pair[1].0);
        let changes = changes.filter(|e| smallest < e.abs());
        let own = self.part.epsilon.parse::<f64>().ok();
        let sizes = changes.chain(own).filter(|e| e * sign > 0.0).map(|e| e.abs().log10());
        let (low, high) = sizes
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (low <= high).then(|| (low.floor() as i32 - 1, high.ceil() as i32 + 1))
    }

    /// Where the stretch around zero begins and ends.
    fn zero(&self) -> (f64, f64) {
        let inner = WIDTH - LEFT - RIGHT - ZERO;
        let count = |span: Option<(i32, i32)>| span.map_or(0, |(low, high)| high - low);
        let (negative, positive) = (count(self.decades[0]), count(self.decades[1]));
        let share = f64::from(negative) / f64::from((negative + positive).max(1));
        let start = LEFT + inner * share;
        (start, start + ZERO)
    }

    /// The place of an epsilon across.
    fn x(&self, epsilon: f64) -> f64 {
        let (start, end) = self.zero();
        let along = |(low, high): (i32, i32)| {
            ((epsilon.abs().log10() - f64::from(low)) / f64::from(high - low)).clamp(0.0, 1.0)
        };
        match self.decades {
            [Some(span), _] if epsilon < 0.0 => start - along(span) * (start - LEFT),
            [_, Some(span)] if 0.0 < epsilon => end + along(span) * (WIDTH - RIGHT - end),
            [None, _] if epsilon < 0.0 => start,
            [_, None] if 0.0 < epsilon => end,
            _ => (start + end) / 2.0,
        }
    }

    /// The place of a share down; zero has a line of its own at the bottom.
    fn y(&self, share: f64) -> f64 {
        let zero = f64::from(self.lowest) - 0.7;
        let log = if 0.0 < share { share.log10().clamp(zero, 0.0) } else { zero };
        TOP + (HEIGHT - BOTTOM - TOP) * (log / zero)
    }

    fn draw(&self, name: &str) -> Markup {
        let own = self.part.epsilon.parse::<f64>().ok().map(|e| self.x(e));
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
        let mut ticks: Vec<(f64, String)> = Vec::new();
        let (start, end) = self.zero();
        for (span, sign) in self.decades.iter().zip([-1.0, 1.0]) {
            let Some((low, high)) = *span else { continue };
            let wide = if sign < 0.0 { start - LEFT } else { WIDTH - RIGHT - end };
            let stride = (52.0 * f64::from(high - low) / wide.max(1.0)).ceil().max(1.0) as usize;
            for exponent in (low..=high).step_by(stride) {
                let x = self.x(sign * 10f64.powi(exponent));
                if 24.0 < (x - (start + end) / 2.0).abs() && x < WIDTH - 14.0 {
                    let minus = if sign < 0.0 { "−" } else { "" };
                    ticks.push((x, format!("{minus}1e{exponent}")));
                }
            }
        }
        ticks.push(((start + end) / 2.0, "0".to_owned()));
        html! {
            @for exponent in self.lowest..=0 {
                @let y = self.y(10f64.powi(exponent));
                path.grid d=(format!("M{LEFT} {y:.1}H{}", WIDTH - RIGHT)) {}
                text x=(LEFT - 5.0) y=(format!("{:.1}", y + 3.5)) text-anchor="end" { (level(exponent)) }
            }
            path.axis d=(format!("M{LEFT} {bottom}H{}", WIDTH - RIGHT)) {}
            text x=(LEFT - 5.0) y=(format!("{:.1}", bottom + 3.5)) text-anchor="end" { "none" }
            @for (x, label) in ticks {
                path.axis d=(format!("M{x:.1} {bottom}v4")) {}
                text x=(format!("{x:.1}")) y=(bottom + 16.0) text-anchor="middle" { (label) }
            }
        }
    }

    /// A question's share by epsilon, with its interval behind it.
    fn line(&self, question: usize) -> Markup {
        let (mut path, mut upper, mut lower) = (String::new(), String::new(), Vec::new());
        let right = WIDTH - RIGHT;
        let mut last: Option<u64> = None;
        let drawn = self.points.iter().map(|(e, counts)| (self.x(*e), *counts));
        let first = self.points.first().map(|(_, counts)| (LEFT, *counts));
        for (x, counts) in first.into_iter().chain(drawn) {
            let Some((share, ends)) = self.part.share(question, counts) else { break };
            if last == Some(counts[question]) {
                continue;
            }
            let y = self.y(share);
            path.push_str(&match last {
                None => format!("M{x:.1} {y:.1}"),
                Some(_) => format!("H{x:.1}V{y:.1}"),
            });
            if let Some([low, high]) = ends {
                let (high, low) = (self.y(high), self.y(low));
                upper.push_str(&match last {
                    None => format!("M{x:.1} {high:.1}"),
                    Some(_) => format!("H{x:.1}V{high:.1}"),
                });
                lower.push((x, low));
            }
            last = Some(counts[question]);
        }
        path.push_str(&format!("H{right}"));
        // Back along the lower ends.
        let mut band = String::new();
        if let Some((_, low)) = lower.last() {
            band = format!("{upper}H{right}V{low:.1}");
            for pair in lower.windows(2).rev() {
                band.push_str(&format!("H{:.1}V{:.1}", pair[1].0, pair[0].1));
            }
            band.push_str(&format!("H{:.1}Z", lower[0].0));
        }
        let class = LINES[question].0;
        html! {
            @if !band.is_empty() && question < 2 { path class={ "band " (class) } d=(band) {} }
            path class={ "line " (class) } d=(path) {}
        }
    }
}

fn level(exponent: i32) -> &'static str {
    match exponent {
        0 => "100 %",
        -1 => "10 %",
        -2 => "1 %",
        -3 => "0.1 %",
        -4 => "0.01 %",
        _ => "0.001 %",
    }
}
