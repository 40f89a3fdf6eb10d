//! A study's curves as SVG: the epsilon on a logarithmic axis with zero in its middle, shares of wrong answers on a
//! logarithmic one.

use super::record::{EpsilonRecord, GatePart};
use crate::audit::Trials;
use crate::epsilon::LEAST_SUM;
use crate::plot::{Decades, decades_around};
use crate::report::Style;
use crate::report::chart::{Chart, Frame, Mark, file, text_at};
use std::io::{self, Write};

const FRAME: Frame =
    Frame { width: 940.0, left: 76.0, right: 24.0, above: 62.0, plot: 240.0, zero: 36.0 };

/// The lines that are drawn: the question's place, its name and its class.
const LINES: [(usize, &str, &str); 3] = [
    (0, "false misses", "miss"),
    (5, "false hits that this gate is there to refuse", "hit"),
    (2, "cracks", "crack"),
];

/// Changes of a share below this do not make the axis longer.
const NEGLIGIBLE: f64 = 2e-3;

/// The most decades of shares that fit.
const MOST_DECADES: i32 = 8;

/// Writes one panel a gate, one below the other.
pub fn write(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let (mut drawing, mut y) = (String::new(), 0.0);
    for part in &record.result.gates {
        let chart = panel(part);
        drawing += &format!("<g transform=\"translate(0 {y})\">{}</g>\n", chart.drawing);
        y += chart.height + 14.0;
    }
    let title = "Shares of wrong answers by epsilon";
    out.write_all(file(title, FRAME.width, y, &drawing).as_bytes())
}

/// The decades of one sign in which the drawn shares change, and those of the marks.
fn span(part: &GatePart, points: &[(f64, [u64; 6])], sign: f64) -> Option<Decades> {
    let asked = part.curves[0].asked;
    let mut side: Vec<(f64, [u64; 6])> =
        points.iter().filter(|(e, _)| e * sign > 0.0).copied().collect();
    side.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let (first, last) = (side.first()?.1, side.last()?.1);
    let moved = |a: &[u64; 6], b: &[u64; 6]| {
        LINES.iter().any(|(k, ..)| a[*k].abs_diff(b[*k]) as f64 > NEGLIGIBLE * asked[*k] as f64)
    };
    let low = side.iter().find(|(_, counts)| moved(counts, &first)).map(|(e, _)| *e);
    let high = side.iter().rev().find(|(_, counts)| moved(counts, &last)).map(|(e, _)| *e);
    // The least sum lies where shares change, or where it makes no difference.
    let marks = part.marks.iter().filter(|mark| mark.name != LEAST_SUM);
    let marks = marks.filter_map(|mark| mark.epsilon.parse::<f64>().ok());
    decades_around(low.into_iter().chain(high).chain(marks.filter(|e| e * sign > 0.0)))
}

/// One gate's plot.
fn panel(part: &GatePart) -> Chart {
    let GatePart { kernel, scalar, gate, refuses, .. } = part;
    let all = &part.curves[0];
    let points = all.points.iter();
    let points: Vec<(f64, [u64; 6])> =
        points.filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts))).collect();
    let asked = all.asked.iter().max().copied().unwrap_or(1);
    let decades = [-1.0, 1.0].map(|sign| span(part, &points, sign));
    let mut chart = Chart::new(FRAME, decades, (asked, MOST_DECADES), &marks(part));
    chart.drawing += &text_at(12.0, 20.0, "this", &format!("{kernel} {scalar}, gate {gate}"));
    chart.drawing += &text_at(12.0, 38.0, "soft", &format!("refuses where {refuses}"));
    let mut legend = Vec::new();
    for (question, name, class) in LINES.into_iter().filter(|line| 0 < all.asked[line.0]) {
        let (of, of_squared) = (all.asked[question], all.asked_squared[question]);
        let point = |(epsilon, counts): &(f64, [u64; 6])| {
            let trials = Trials::alike_on_each_ray(counts[question], of, of_squared);
            let interval = all.sample.then(|| trials.interval());
            let interval = interval.map(|interval| [interval.low, interval.high]);
            (*epsilon, counts[question] as f64 / of as f64, interval)
        };
        chart.line(class, points.iter().map(point));
        let mark = format!("<path class=\"line {class}\" d=\"M0 0h30\"/>");
        legend.push((mark, name.to_owned()));
    }
    chart.legend(&legend);
    chart
}

/// Named epsilons, those with one place together.
fn marks(part: &GatePart) -> Vec<Mark> {
    let mut marks: Vec<Mark> = Vec::new();
    for mark in &part.marks {
        let Ok(value) = mark.epsilon.parse::<f64>() else { continue };
        match marks.iter_mut().find(|known| known.value == value) {
            Some(known) => known.text += &format!(", {}", mark.name),
            None => marks.push(Mark { value, text: mark.name.clone(), is_this: false }),
        }
    }
    marks
}
