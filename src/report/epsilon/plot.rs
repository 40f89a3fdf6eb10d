//! A study's curves as SVG, readable in black and white: the epsilon on a logarithmic axis with zero
//! in its middle, shares of wrong answers on a logarithmic one.
//!
//! Drawn here, since no plotting library has an axis with zero between two logarithmic halves.

use super::record::{EpsilonRecord, GatePart};
use crate::audit::Trials;
use crate::epsilon::LEAST_SUM;
use crate::plot::{Decades, EpsilonAxis, ShareAxis, decades_around, escaped};
use crate::report::Style;
use std::io::{self, Write};

const WIDTH: f64 = 940.0;
const PANEL: f64 = 480.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 110.0;
const TOP: f64 = 190.0;
const BOTTOM: f64 = 56.0;
/// The width of the stretch around zero.
const ZERO: f64 = 36.0;

/// The lines that are drawn: the question's place, its name and its stroke.
const LINES: [(usize, &str, &str); 3] = [
    (0, "false misses", "stroke-width=\"2\""),
    (
        5,
        "false hits that this gate is there to refuse",
        "stroke-width=\"2\" stroke-dasharray=\"7 4\"",
    ),
    (2, "cracks", "stroke-width=\"1.5\" stroke-dasharray=\"2 3\""),
];

/// Changes of a share below this do not make the axis longer.
const NEGLIGIBLE: f64 = 2e-3;

/// The most decades of shares that fit.
const MOST_DECADES: i32 = 8;

/// Writes one panel a gate, one below the other.
pub fn write(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let height = PANEL * record.result.gates.len().max(1) as f64;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\" role=\"img\">"
    )?;
    writeln!(out, "<title>Shares of wrong answers by epsilon</title>")?;
    writeln!(out, "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>")?;
    for (i, part) in record.result.gates.iter().enumerate() {
        writeln!(out, "<g transform=\"translate(0 {})\">", PANEL * i as f64)?;
        Panel::new(part).write(out)?;
        writeln!(out, "</g>")?;
    }
    writeln!(out, "</svg>")
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
struct Panel<'a> {
    part: &'a GatePart,
    /// Epsilons with their counts, in order.
    points: Vec<(f64, [u64; 6])>,
    across: EpsilonAxis,
    down: ShareAxis,
}

impl<'a> Panel<'a> {
    fn new(part: &'a GatePart) -> Panel<'a> {
        let points: Vec<(f64, [u64; 6])> = part.curves[0]
            .points
            .iter()
            .filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts)))
            .collect();
        let asked = part.curves[0].asked.iter().max().copied().unwrap_or(1);
        let decades = [-1.0, 1.0].map(|sign| span(part, &points, sign));
        let across = EpsilonAxis::new(LEFT, WIDTH - RIGHT, ZERO, decades);
        let down = ShareAxis::new(TOP, PANEL - BOTTOM, asked, MOST_DECADES);
        Panel { part, points, across, down }
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let GatePart { kernel, scalar, gate, refuses, .. } = self.part;
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"20\" font-size=\"15\" font-weight=\"bold\">{}</text>",
            escaped(&format!("{kernel} {scalar}, gate {gate}"))
        )?;
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"38\">{}</text>",
            escaped(&format!("refuses where {refuses}"))
        )?;
        self.axes(out)?;
        self.marks(out)?;
        let mut legend = LEFT;
        for (k, name, stroke) in LINES {
            if self.part.curves[0].asked[k] == 0 {
                continue;
            }
            self.line(k, stroke, out)?;
            writeln!(
                out,
                "<path d=\"M{legend} 54h34\" stroke=\"#000\" fill=\"none\" {stroke}/><text x=\"{}\" y=\"58\">{name}</text>",
                legend + 40.0
            )?;
            legend += 70.0 + 6.4 * name.len() as f64;
        }
        Ok(())
    }

    fn axes(&self, out: &mut dyn Write) -> io::Result<()> {
        let (top, bottom) = (TOP, PANEL - BOTTOM);
        let right = WIDTH - RIGHT;
        writeln!(out, "<g stroke=\"#ccc\" fill=\"none\">")?;
        for (y, _) in self.down.ticks() {
            writeln!(out, "<path d=\"M{LEFT} {y:.1}H{right}\"/>")?;
        }
        writeln!(
            out,
            "</g><path d=\"M{LEFT} {bottom}H{right}M{LEFT} {bottom}V{top}\" stroke=\"#000\" fill=\"none\"/>"
        )?;
        writeln!(out, "<g text-anchor=\"end\">")?;
        for (y, label) in self.down.ticks().into_iter().chain([(bottom, "none".to_owned())]) {
            writeln!(out, "<text x=\"{}\" y=\"{:.1}\">{label}</text>", LEFT - 8.0, y + 4.0)?;
        }
        writeln!(out, "</g><g text-anchor=\"middle\">")?;
        // A label is some 46 wide.
        for (x, label) in self.across.ticks(46.0, WIDTH) {
            writeln!(
                out,
                "<path d=\"M{x:.1} {bottom}v5\" stroke=\"#000\"/><text x=\"{x:.1}\" y=\"{}\">{label}</text>",
                bottom + 19.0
            )?;
        }
        writeln!(
            out,
            "<text x=\"{}\" y=\"{}\">epsilon</text></g>",
            (LEFT + right) / 2.0,
            bottom + 42.0
        )
    }

    /// Named epsilons, as lines with their names above.
    fn marks(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut last = f64::NEG_INFINITY;
        let mut named: Vec<(f64, String)> = Vec::new();
        for mark in &self.part.marks {
            let Ok(epsilon) = mark.epsilon.parse::<f64>() else { continue };
            let x = self.across.x(epsilon);
            match named.last_mut() {
                Some((at, names)) if (*at - x).abs() < 1.0 => {
                    names.push_str(&format!(", {}", mark.name));
                }
                _ => named.push((x, mark.name.clone())),
            }
        }
        for (x, names) in named {
            // Names stand apart where their lines do not.
            let at = x.max(last + 13.0);
            last = at;
            writeln!(
                out,
                "<path d=\"M{x:.1} {}V{TOP}L{at:.1} {}\" stroke=\"#888\" stroke-dasharray=\"1 3\" fill=\"none\"/><text transform=\"translate({:.1} {}) rotate(-40)\" font-size=\"11\">{}</text>",
                PANEL - BOTTOM,
                TOP - 8.0,
                at + 3.0,
                TOP - 10.0,
                escaped(&names)
            )?;
        }
        Ok(())
    }

    /// A question's share by epsilon, with the 95 % interval behind it where it is of a sample.
    fn line(&self, question: usize, stroke: &str, out: &mut dyn Write) -> io::Result<()> {
        let all = &self.part.curves[0];
        let (of, of_squared) = (all.asked[question], all.asked_squared[question]);
        let points = self.ends_and_points().into_iter().map(|(epsilon, counts)| {
            let trials = Trials::alike_on_each_ray(counts[question], of, of_squared);
            let interval = all.sample.then(|| trials.interval());
            let interval = interval.map(|interval| [interval.low, interval.high]);
            (self.across.x(epsilon), counts[question] as f64 / of as f64, interval)
        });
        let (path, band) = self.down.steps(points, self.across.x(f64::MAX));
        if !band.is_empty() {
            writeln!(out, "<path d=\"{band}\" fill=\"#000\" fill-opacity=\"0.13\"/>")?;
        }
        writeln!(out, "<path d=\"{path}\" stroke=\"#000\" fill=\"none\" {stroke}/>")
    }

    /// The points, and the ends of the axis with the counts that hold there.
    fn ends_and_points(&self) -> Vec<(f64, [u64; 6])> {
        let [low, high] = self.across.ends();
        let at = |epsilon: f64| {
            let after = self.points.partition_point(|(e, _)| *e < epsilon);
            self.points.get(after).or(self.points.last()).map_or([0; 6], |(_, counts)| *counts)
        };
        let mut all = vec![(low, at(low))];
        let mut spot = f64::NEG_INFINITY;
        for (epsilon, counts) in self.points.iter().filter(|(e, _)| low < *e && *e < high) {
            // What falls on one spot of the drawing is drawn once.
            if self.across.x(*epsilon) - spot < 1.0 {
                all.pop();
            } else {
                spot = self.across.x(*epsilon);
            }
            all.push((*epsilon, *counts));
        }
        all.push((high, at(high)));
        all
    }
}
