//! A study's curves as SVG, readable in black and white: the epsilon on a logarithmic axis with zero
//! in its middle, shares of wrong answers on a logarithmic one.
//!
//! Drawn here, since no plotting library has an axis with zero between two logarithmic halves.

use super::record::{EpsilonRecord, GatePart};
use crate::audit::Trials;
use crate::report::Style;
use crate::response::LEAST_SUM;
use std::io::{self, Write};

const WIDTH: f64 = 940.0;
const PANEL: f64 = 480.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 110.0;
const TOP: f64 = 190.0;
const BOTTOM: f64 = 56.0;
/// The width of the stretch around zero.
const ZERO: f64 = 36.0;

/// What is drawn: the question's place, its name and its stroke.
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

/// One gate's plot.
struct Panel<'a> {
    part: &'a GatePart,
    /// Epsilons with their counts, in order.
    points: Vec<(f64, [u64; 6])>,
    /// Decades of negative epsilons, from small to large, and of positive ones; empty if not drawn.
    decades: [Option<(i32, i32)>; 2],
    /// The exponent of ten of the smallest share that is drawn.
    lowest: i32,
}

impl<'a> Panel<'a> {
    fn new(part: &'a GatePart) -> Panel<'a> {
        let points: Vec<(f64, [u64; 6])> = part.curves[0]
            .points
            .iter()
            .filter_map(|(epsilon, counts)| Some((epsilon.parse().ok()?, *counts)))
            .collect();
        let asked = part.curves[0].asked.iter().max().copied().unwrap_or(1).max(1);
        let lowest = -((asked as f64).log10().ceil() as i32);
        let mut panel = Panel { part, points, decades: [None, None], lowest };
        panel.decades = [panel.span(-1.0), panel.span(1.0)];
        if panel.decades == [None, None] {
            panel.decades[1] = Some((-8, 0));
        }
        panel
    }

    /// The decades of one sign in which the drawn shares change, and those of the marks.
    fn span(&self, sign: f64) -> Option<(i32, i32)> {
        let asked = self.part.curves[0].asked;
        let mut side: Vec<(f64, [u64; 6])> =
            self.points.iter().filter(|(e, _)| e * sign > 0.0).copied().collect();
        side.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let (first, last) = (side.first()?.1, side.last()?.1);
        let moved = |a: &[u64; 6], b: &[u64; 6]| {
            LINES.iter().any(|(k, ..)| a[*k].abs_diff(b[*k]) as f64 > NEGLIGIBLE * asked[*k] as f64)
        };
        let low = side.iter().find(|(_, counts)| moved(counts, &first)).map(|(e, _)| e.abs());
        let high = side.iter().rev().find(|(_, counts)| moved(counts, &last)).map(|(e, _)| e.abs());
        // The least sum lies where shares change, or where it makes no difference.
        let marks = self.part.marks.iter().filter(|mark| mark.name != LEAST_SUM);
        let marks = marks.filter_map(|mark| mark.epsilon.parse::<f64>().ok());
        let marks = marks.filter(|e| e * sign > 0.0).map(f64::abs);
        let all: Vec<f64> = low.into_iter().chain(high).chain(marks).collect();
        let low = all.iter().copied().reduce(f64::min)?.log10().floor() as i32 - 1;
        let high = all.iter().copied().reduce(f64::max)?.log10().ceil() as i32 + 1;
        Some((low, high.max(low + 2)))
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
        match (epsilon.partial_cmp(&0.0), self.decades) {
            (Some(std::cmp::Ordering::Less), [Some(span), _]) => {
                start - along(span) * (start - LEFT)
            }
            (Some(std::cmp::Ordering::Greater), [_, Some(span)]) => {
                end + along(span) * (WIDTH - RIGHT - end)
            }
            _ => (start + end) / 2.0,
        }
    }

    /// The place of a share down; zero has a line of its own at the bottom.
    fn y(&self, share: f64) -> f64 {
        let (top, bottom) = (TOP, PANEL - BOTTOM);
        let zero = f64::from(self.lowest) - 1.0;
        let log = if share > 0.0 { share.log10().max(zero) } else { zero };
        top + (bottom - top) * (log / zero)
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let GatePart { kernel, scalar, gate, refuses, form, .. } = self.part;
        let form = if form == "e" { String::new() } else { format!(", with {form} in place of e") };
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"20\" font-size=\"15\" font-weight=\"bold\">{}</text>",
            escaped(&format!("{kernel} {scalar}, gate {gate}"))
        )?;
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"38\">{}</text>",
            escaped(&format!("refuses where {refuses}{form}"))
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
        writeln!(out, "<g stroke=\"#ccc\" fill=\"none\">")?;
        for exponent in self.lowest..=0 {
            writeln!(
                out,
                "<path d=\"M{LEFT} {:.1}H{}\"/>",
                self.y(10f64.powi(exponent)),
                WIDTH - RIGHT
            )?;
        }
        writeln!(
            out,
            "</g><path d=\"M{LEFT} {bottom}H{}M{LEFT} {bottom}V{top}\" stroke=\"#000\" fill=\"none\"/>",
            WIDTH - RIGHT
        )?;
        writeln!(out, "<g text-anchor=\"end\">")?;
        for exponent in self.lowest..=0 {
            let label = if exponent == 0 {
                "100 %".to_owned()
            } else {
                format!("10{}", superscript(exponent))
            };
            writeln!(
                out,
                "<text x=\"{}\" y=\"{:.1}\">{label}</text>",
                LEFT - 8.0,
                self.y(10f64.powi(exponent)) + 4.0
            )?;
        }
        writeln!(out, "<text x=\"{}\" y=\"{:.1}\">none</text></g>", LEFT - 8.0, bottom + 4.0)?;
        writeln!(out, "<g text-anchor=\"middle\">")?;
        let (start, end) = self.zero();
        let middle = (start + end) / 2.0;
        for (span, sign) in self.decades.iter().zip([-1.0, 1.0]) {
            let Some((low, high)) = *span else { continue };
            let decade =
                (self.x(sign * 10f64.powi(low + 1)) - self.x(sign * 10f64.powi(low))).abs();
            // A label is some 46 wide.
            let stride = (46.0 / decade.max(0.1)).ceil() as usize;
            for exponent in (low..=high).step_by(stride) {
                let x = self.x(sign * 10f64.powi(exponent));
                if (x - middle).abs() < 30.0 {
                    continue;
                }
                let minus = if sign < 0.0 { "−" } else { "" };
                writeln!(
                    out,
                    "<path d=\"M{x:.1} {bottom}v5\" stroke=\"#000\"/><text x=\"{x:.1}\" y=\"{}\">{minus}10{}</text>",
                    bottom + 19.0,
                    superscript(exponent)
                )?;
            }
        }
        writeln!(
            out,
            "<path d=\"M{x:.1} {bottom}v5\" stroke=\"#000\"/><text x=\"{x:.1}\" y=\"{}\">0</text>",
            bottom + 19.0,
            x = middle
        )?;
        writeln!(
            out,
            "<text x=\"{}\" y=\"{}\">epsilon</text></g>",
            (LEFT + WIDTH - RIGHT) / 2.0,
            bottom + 42.0
        )
    }

    /// Named epsilons, as lines with their names above.
    fn marks(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut last = f64::NEG_INFINITY;
        let mut named: Vec<(f64, String)> = Vec::new();
        for mark in &self.part.marks {
            let Ok(epsilon) = mark.epsilon.parse::<f64>() else { continue };
            let x = self.x(epsilon);
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
        let mut path = String::new();
        let mut band: Vec<(f64, [f64; 2])> = Vec::new();
        let mut last: Option<(f64, u64)> = None;
        for (epsilon, counts) in self.ends_and_points() {
            let (x, count) = (self.x(epsilon), counts[question]);
            let y = self.y(count as f64 / of as f64);
            path.push_str(&match last {
                None => format!("M{x:.1} {y:.1}"),
                Some((_, before)) if before == count => continue,
                // The count holds up to the epsilon at which it changes.
                Some(_) => format!("H{x:.1}V{y:.1}"),
            });
            last = Some((x, count));
            if all.sample {
                let interval = Trials::alike_on_each_ray(count, of, of_squared).interval();
                let ends = [self.y(interval.high), self.y(interval.low)];
                // Its corners as the line's.
                for [high, low] in band.last().map(|(_, ends)| *ends).into_iter().chain([ends]) {
                    band.push((x, [high, low]));
                }
            }
        }
        path.push_str(&format!("H{:.1}", self.x(f64::MAX)));
        if let Some((_, ends)) = band.last().copied() {
            band.push((self.x(f64::MAX), ends));
            let corner = |x: f64, y: f64| format!("{x:.1} {y:.1}");
            let upper = band.iter().map(|(x, [high, _])| corner(*x, *high));
            let lower = band.iter().rev().map(|(x, [_, low])| corner(*x, *low));
            let outline: Vec<String> = upper.chain(lower).collect();
            writeln!(
                out,
                "<path d=\"M{}Z\" fill=\"#000\" fill-opacity=\"0.13\"/>",
                outline.join("L")
            )?;
        }
        writeln!(out, "<path d=\"{path}\" stroke=\"#000\" fill=\"none\" {stroke}/>")
    }

    /// The points, and the ends of the axis with the counts that hold there.
    fn ends_and_points(&self) -> Vec<(f64, [u64; 6])> {
        let low = self.decades[0].map_or(0.0, |(_, high)| -(10f64.powi(high)));
        let high = self.decades[1].map_or(0.0, |(_, high)| 10f64.powi(high));
        let at = |epsilon: f64| {
            let after = self.points.partition_point(|(e, _)| *e < epsilon);
            self.points.get(after).or(self.points.last()).map_or([0; 6], |(_, counts)| *counts)
        };
        let mut all = vec![(low, at(low))];
        let mut spot = f64::NEG_INFINITY;
        for (epsilon, counts) in self.points.iter().filter(|(e, _)| low < *e && *e < high) {
            // What falls on one spot of the drawing is drawn once.
            if self.x(*epsilon) - spot < 1.0 {
                all.pop();
            } else {
                spot = self.x(*epsilon);
            }
            all.push((*epsilon, *counts));
        }
        all.push((high, at(high)));
        all
    }
}

/// An exponent in raised digits.
fn superscript(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raised).collect()
}

/// Text for XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
