//! Plots of each value of a number while the others stay: wrong answers over the value, what was tried as
//! lines with names above, limits on the axis. One panel a number, the same in a file and in a page.

use super::answer::{LimitRow, RECOMMENDED, column, limit_rows, scene, title, used};
use super::numbers::human;
use super::record::*;
use super::words::{label, unit_of};
use crate::arith::ScalarName;
use crate::audit::Trials;
use crate::chart::{Chart, ChartMark, LINE, WIDTH, file, text_at, wrapped};
use crate::page::{Drawing, Picture};
use crate::plot::{Decades, decades_around, group_digits};
use hairline_record::percent;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::ptr;

/// Changes of a share below this are not drawn.
const NEGLIGIBLE: f64 = 2e-4;
/// Writes the recommendation and the panels of each kernel, one below the other.
pub fn write(record: &SceneResult, out: &mut dyn Write) -> io::Result<()> {
    let (mut drawing, mut y) = (String::new(), 0.0);
    for part in &record.kernels {
        let mut heading = vec![(title(record, part), "this"), (scene(record), "soft")];
        for used in used(record, part) {
            let parts = used.parts.iter().enumerate();
            let words = [used.lead.as_str(), "and"];
            heading.extend(parts.map(|(k, part)| (format!("{} {part}", words[k.min(1)]), "")));
        }
        y += 8.0;
        for (text, class) in heading {
            y += LINE;
            drawing += &text_at(12.0, y, class, &text);
        }
        for panel in panels(record, part) {
            let Drawing::Chart(panel, [_, height]) = panel.drawing else {
                continue;
            };
            let _ = write!(drawing, "<g transform=\"translate(0 {y:.0})\">{panel}</g>");
            y += height;
        }
        for text in footer(record, part).iter().flat_map(|text| wrapped(text)) {
            y += LINE;
            drawing += &text_at(12.0, y, "soft", &text);
        }
        y += LINE;
    }
    out.write_all(file("Wrong answers by epsilon in a scene", [WIDTH, y], &drawing).as_bytes())
}

/// The footer: the rays and the contract behind the shares.
pub(super) fn footer(record: &SceneResult, part: &SceneKernelPart) -> [String; 2] {
    [
        format!(
            "{} indices of each kind of ray, seed {}",
            group_digits(record.rays_of(part)),
            record.fresh_seed
        ),
        format!("contract: {}", part.contract),
    ]
}

/// One panel a number.
pub(super) fn panels(record: &SceneResult, part: &SceneKernelPart) -> Vec<Picture> {
    (0..part.curves.len())
        .map(|knob| Draft::new(record, part, knob).panel())
        .collect()
}

/// A count as a line: the wrong answers at each value that this number is to blame for.
struct CountLine<'a> {
    count: &'a RayCount,
    of: u64,
    /// Hits that other numbers refuse, whatever this one is.
    by_others: u64,
    wrong: Vec<u64>,
}

/// `grazing hit`.
fn class_of(count: &RayCount) -> String {
    format!("{} {}", color_of(count), count.kind)
}

/// The class of a stratum's colour; other rays have that of the kind of error.
fn color_of(count: &RayCount) -> &'static str {
    match (count.rays, count.kind) {
        (Rays::Stratum(stratum), _) => stratum.name().trim_start_matches("scene-"),
        (_, WrongKind::Miss) => "interior",
        (_, WrongKind::Hit) => "grazing",
        (_, WrongKind::Crack) => "edges",
        (_, WrongKind::SelfHit) => "shadow",
    }
}

/// The data of a panel.
struct Draft<'a> {
    record: &'a SceneResult,
    part: &'a SceneKernelPart,
    place: usize,
    knob: &'a KnobPart,
    values: Vec<f64>,
    lines: Vec<CountLine<'a>>,
    /// The values that were tried, with their names, in order.
    tried: Vec<(f64, String)>,
    /// Its limits; the proved ones come last.
    limits: Vec<LimitRow<'a>>,
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or(0.0)
}

impl<'a> Draft<'a> {
    fn new(record: &'a SceneResult, part: &'a SceneKernelPart, place: usize) -> Draft<'a> {
        let (curve, knob) = (&part.curves[place], &part.knobs[place]);
        let lines = part
            .counts
            .iter()
            .zip(&curve.counts)
            .map(|(count, points)| {
                let is_lost = matches!(count.kind, WrongKind::Crack | WrongKind::Miss);
                let left = points.of - points.refused_by_others;
                let wrong = points
                    .hits
                    .iter()
                    .map(|hits| if is_lost { left - hits } else { *hits });
                let by_others = if is_lost { points.refused_by_others } else { 0 };
                CountLine {
                    count,
                    of: points.of,
                    by_others,
                    wrong: wrong.collect(),
                }
            });
        let moves = |line: &CountLine<'_>| {
            let (least, most) = (line.wrong.iter().min(), line.wrong.iter().max());
            let span = most.unwrap_or(&0) - least.unwrap_or(&0);
            0 < line.of && NEGLIGIBLE * (line.of as f64) < span as f64
        };
        let mut tried: Vec<(f64, String)> = Vec::new();
        for one in &part.tried {
            let (value, name) = (number(&one.epsilons[place]), column(part, &one.name));
            match tried.iter_mut().find(|(known, _)| *known == value) {
                Some((_, names)) => {
                    let _ = write!(names, ", {name}");
                }
                None => tried.push((value, name)),
            }
        }
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        Draft {
            record,
            part,
            place,
            knob,
            values: curve.values.iter().map(|value| number(value)).collect(),
            lines: lines.filter(moves).collect(),
            tried,
            limits: limit_rows(record, part)
                .filter(|row| ptr::eq(row.knob, knob))
                .collect(),
        }
    }

    /// The decades of one sign: of what was tried, of the limits, and where lines move.
    fn decades(&self, sign: f64) -> Option<Decades> {
        let moved = |pair: &[f64], i: usize| {
            let moves = |line: &CountLine<'_>| {
                let change = line.wrong[i].abs_diff(line.wrong[i + 1]) as f64;
                5.0 * NEGLIGIBLE * (line.of as f64) < change
            };
            (pair[0] * sign > 0.0 && self.lines.iter().any(moves)).then_some(pair[0])
        };
        let moving = self
            .values
            .windows(2)
            .enumerate()
            .filter_map(|(i, pair)| moved(pair, i));
        let limits = self
            .limits
            .iter()
            .filter_map(|row| Some(number(row.value?)));
        let special = self.tried.iter().map(|(value, _)| *value).chain(limits);
        // What is next to zero needs no decades of its own.
        let least = if self.part.scalar == ScalarName::F32 {
            1e-30
        } else {
            1e-200
        };
        let all = moving.chain(special).filter(|value| least < value * sign);
        // Nothing is known beyond the values.
        let end = self
            .values
            .iter()
            .fold(least, |end, value| end.max(value * sign));
        let end = end.log10().ceil() as i32;
        decades_around(all).map(|(low, high)| (low, high.min(end).max(low + 1)))
    }

    /// From where to where every limit is kept; none where they do not meet.
    fn within(&self) -> Option<[f64; 2]> {
        let (mut low, mut high, mut any) = (f64::NEG_INFINITY, f64::INFINITY, false);
        for row in self.limits.iter().filter(|row| !row.is_proved) {
            let value = number(row.value?);
            any = true;
            match row.is_lower {
                true => low = low.max(value),
                false => high = high.min(value),
            }
        }
        (any && low <= high).then_some([low, high])
    }

    fn panel(&self) -> Picture {
        let unit = unit_of(self.record, self.knob);
        let name = match self.knob.is_gate {
            true => format!("{}: epsilon of this gate", self.knob.name),
            false => format!("{}: least t that counts", self.knob.name),
        };
        let title = if unit.is_empty() {
            name
        } else {
            format!("{name} ({})", unit.trim())
        };
        let others = self
            .part
            .knobs
            .iter()
            .zip(&self.part.tried[0].epsilons)
            .enumerate();
        let others = others.filter(|(place, _)| *place != self.place);
        let others: Vec<String> = others
            .map(|(_, (knob, epsilon))| format!("{}={}", knob.name, human(epsilon)))
            .collect();
        let marks: Vec<ChartMark> = self.tried.iter().map(mark).collect();
        let most = self.lines.iter().map(|line| line.of).max().unwrap_or(1);
        let decades = [self.decades(-1.0), self.decades(1.0)];
        let mut chart = Chart::new(decades, most, &marks);
        chart.drawing += &text_at(12.0, 26.0, "this", &title);
        if !others.is_empty() {
            let with = format!("with {}", others.join(", "));
            chart.drawing += &text_at(12.0, 42.0, "soft", &with);
        }
        if let Some(ends) = self.within() {
            chart.shade(
                if is_open(ends) {
                    "within open"
                } else {
                    "within"
                },
                ends,
            );
        }
        for line in &self.lines {
            let point = |(value, wrong): (&f64, &u64)| {
                let interval = Trials::independent(*wrong, line.of).interval();
                let share = *wrong as f64 / line.of as f64;
                (*value, share, Some([interval.low, interval.high]))
            };
            chart.line(
                &class_of(line.count),
                self.values.iter().zip(&line.wrong).map(point),
            );
        }
        for row in &self.limits {
            if let Some(value) = row.value {
                chart.drawing += &marker(chart.on_axis(number(value)), row);
            }
        }
        let legend = self.legend();
        chart.legend(&legend);
        let about = legend
            .iter()
            .fold(title, |about, (_, text)| format!("{about}; {text}"));
        let drawing = Drawing::Chart(chart.drawing, [WIDTH, chart.height]);
        Picture {
            about,
            caption: String::new(),
            drawing,
        }
    }

    /// Marks with their texts: the lines, then the limits.
    fn legend(&self) -> Vec<(String, String)> {
        let lines = self.lines.iter().map(|line| {
            let what = label(line.count);
            let n = group_digits(line.of);
            let others = match line.by_others as f64 / line.of as f64 {
                0.0 => String::new(),
                share => format!(", {} by others", percent(share)),
            };
            let mark = format!(
                "<path class=\"line {}\" d=\"M0 0h30\"/>",
                class_of(line.count)
            );
            (mark, format!("{what} (n = {n}{others})"))
        });
        let limits = self.limits.iter().map(|row| {
            let most = if row.is_proved { "proved" } else { &row.most };
            (
                marker([15.0, 0.0], row),
                format!("{} {}: {most}", row.bound, label(row.count)),
            )
        });
        let mut all: Vec<(String, String)> = lines.chain(limits).collect();
        if let Some(line) = self.lines.last() {
            let mark = format!(
                "<path class=\"band {}\" d=\"M0 -6h30v12h-30z\"/>",
                class_of(line.count)
            );
            all.push((
                mark,
                "around a line: its 95 % interval (Clopper and Pearson)".to_owned(),
            ));
        }
        if let Some(ends) = self.within() {
            let [class, text] = match (is_open(ends), ends[0] == f64::NEG_INFINITY) {
                (false, _) => ["within", "within every limit, 95 % sure of each"],
                (true, true) => [
                    "within open",
                    "below its limits, 95 % sure of each; none from below",
                ],
                (true, false) => [
                    "within open",
                    "above its limits, 95 % sure of each; none from above",
                ],
            };
            let mark = format!("<rect class=\"{class}\" y=\"-6\" width=\"30\" height=\"12\"/>");
            all.push((mark, text.to_owned()));
        } else if self.limits.iter().any(|row| !row.is_proved) {
            all.push((String::new(), "no value is within every limit".to_owned()));
        }
        all
    }
}

/// A value that was tried.
fn mark((value, names): &(f64, String)) -> ChartMark {
    let text = if *value == 0.0 {
        "0".to_owned()
    } else {
        human(&format!("{value:e}"))
    };
    let is_this = names.split(", ").any(|name| name == RECOMMENDED);
    ChartMark {
        value: *value,
        text: format!("{names}: {text}"),
        is_this,
    }
}

/// True if limits are on one side only.
fn is_open(ends: [f64; 2]) -> bool {
    ends.iter().any(|end| end.is_infinite())
}

/// A triangle on the axis that points to the side that a limit allows.
fn marker([x, y]: [f64; 2], row: &LimitRow) -> String {
    let ahead = if row.is_lower { 9.0 } else { -9.0 };
    let class = if row.is_proved {
        "limit proved"
    } else {
        "limit"
    };
    let stratum = color_of(row.count);
    format!(
        "<path class=\"{class} {stratum}\" d=\"M{x:.1} {:.1}l{ahead} 5l{} 5z\"/>\n",
        y - 5.0,
        -ahead
    )
}
