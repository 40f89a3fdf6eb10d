//! The one plot of curves: epsilons across, with zero between two logarithmic halves; shares upwards; names above,
//! stepped lines with their intervals, a legend below. Elements of SVG; their classes are styled by [`STYLE`] in a file,
//! and by a page's own rules.
//!
//! Drawn here, since no plotting library has such an axis.

use crate::plot::{Decades, EpsilonAxis, ShareAxis, escaped};
use std::fmt::Write as _;

/// The height of a line of text, and about the width of a character.
pub(super) const LINE: f64 = 17.0;
const CHARACTER: f64 = 6.4;
/// The width of a label on an axis.
const LABEL: f64 = 46.0;

/// The width of a plot with its labels, and where it begins and ends.
pub(super) const WIDTH: f64 = 460.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = WIDTH - 14.0;

/// The width of the stretch around zero.
const ZERO: f64 = 24.0;

/// The height of titles above the names, and of the plot itself.
const ABOVE: f64 = 56.0;
const PLOT: f64 = 210.0;

/// The most decades of shares that fit.
const MOST_DECADES: i32 = 5;

/// Colours by kind of ray, dashes by kind of error; light and dark.
pub(super) const STYLE: &str = include_str!("chart.css");

/// Drawings, in a width and a height, as a file.
pub(super) fn file(title: &str, [width, height]: [f64; 2], drawing: &str) -> String {
    let title = escaped(title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\">\n<title>{title}</title>\n<style>{STYLE}</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n{drawing}\n</svg>\n"
    )
}

/// Drawings as a file, with a caption below; it may be empty.
pub(super) fn captioned_file(
    title: &str,
    [width, height]: [f64; 2],
    drawing: &str,
    caption: &str,
) -> String {
    let mut drawing = drawing.to_owned();
    let mut y = height;
    for line in wrapped(caption).iter().filter(|line| !line.is_empty()) {
        y += LINE;
        drawing += &text_at(12.0, y, "soft", line);
    }
    file(title, [width, y + LINE / 2.0], &drawing)
}

/// A text at a place of a drawing, as an element of SVG.
pub fn text_at(x: f64, y: f64, class: &str, text: &str) -> String {
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" class=\"{class}\">{}</text>\n",
        escaped(text)
    )
}

/// A text in lines that fit into a plot's width.
pub(super) fn wrapped(text: &str) -> Vec<String> {
    let most = ((WIDTH - 24.0) / CHARACTER) as usize;
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("there is one");
        if line.is_empty() || line.len() + word.len() < most {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A value that is marked by a line with its name above the plot.
pub(super) struct ChartMark {
    /// Its place on the axis.
    pub value: f64,
    /// Its name.
    pub text: String,
    /// True if it is the one that matters.
    pub is_this: bool,
}

/// A plot while it is drawn.
pub(super) struct Chart {
    across: EpsilonAxis,
    down: ShareAxis,
    top: f64,
    /// The elements so far.
    pub drawing: String,
    /// How far down it reaches.
    pub height: f64,
}

impl Chart {
    /// The axes and the marks. Shares are of so many.
    pub fn new(decades: [Option<Decades>; 2], of: u64, marks: &[ChartMark]) -> Chart {
        let across = EpsilonAxis::new(LEFT, RIGHT, ZERO, decades);
        let (placed, rows) = in_rows(&across, marks);
        let top = ABOVE + LINE * rows as f64;
        let bottom = top + PLOT;
        let down = ShareAxis::new(top, bottom, of, MOST_DECADES);
        let mut chart = Chart {
            across,
            down,
            top,
            drawing: String::new(),
            height: bottom + 24.0,
        };
        chart.axes();
        for (mark, middle, row) in placed {
            // The first row is the lowest, next to the plot.
            let y = ABOVE - 10.0 + LINE * (rows - row) as f64;
            let class = if mark.is_this { "this" } else { "" };
            let _ = writeln!(
                chart.drawing,
                "<path class=\"tried {class}\" d=\"M{:.1} {:.1}V{bottom}\"/><text class=\"{class}\" x=\"{middle:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{}</text>",
                chart.across.x(mark.value),
                y + 3.0,
                escaped(&mark.text)
            );
        }
        chart
    }

    /// The place of a value on the axis, and the axis itself.
    pub fn on_axis(&self, value: f64) -> [f64; 2] {
        [self.across.x(value), self.top + PLOT]
    }

    /// Shades the values between two; an infinite one stands for the end of the axis.
    pub fn shade(&mut self, class: &str, ends: [f64; 2]) {
        let [from, to] = ends.map(|value| match value.is_finite() {
            true => self.across.x(value),
            false if value < 0.0 => LEFT,
            false => RIGHT,
        });
        let (top, width) = (self.top, (to - from).max(2.0));
        let _ = writeln!(
            self.drawing,
            "<rect class=\"{class}\" x=\"{from:.1}\" y=\"{top}\" width=\"{width:.1}\" height=\"{PLOT}\"/>"
        );
    }

    /// A share that changes at some values, each with its interval if it is of a sample. The values are in order; before
    /// the first the share is as there.
    pub fn line(
        &mut self,
        class: &str,
        points: impl Iterator<Item = (f64, f64, Option<[f64; 2]>)>,
    ) {
        let mut shown: Vec<(f64, f64, Option<[f64; 2]>)> = Vec::new();
        for (value, share, interval) in points {
            let x = self.across.x(value);
            match shown.last_mut() {
                // What falls on one spot of the drawing is drawn once.
                Some(last) if x - last.0 < 1.0 => *last = (last.0, share, interval),
                None if LEFT < x => shown.push((LEFT, share, interval)),
                _ => shown.push((x, share, interval)),
            }
        }
        if shown.is_empty() {
            return;
        }
        let (path, band) = self.down.steps(shown.into_iter(), RIGHT);
        if !band.is_empty() {
            let _ = writeln!(self.drawing, "<path class=\"band {class}\" d=\"{band}\"/>");
        }
        let _ = writeln!(self.drawing, "<path class=\"line {class}\" d=\"{path}\"/>");
    }

    /// Marks with their texts, one below the other.
    pub fn legend(&mut self, lines: &[(String, String)]) {
        self.height += 20.0;
        for (mark, text) in lines {
            let y = self.height;
            let _ = writeln!(
                self.drawing,
                "<g transform=\"translate(12 {:.1})\">{mark}</g>",
                y - 4.0
            );
            self.drawing += &text_at(50.0, y, "", text);
            self.height += LINE;
        }
        self.height += 6.0;
    }

    fn axes(&mut self) {
        let (top, bottom) = (self.top, self.top + PLOT);
        for (y, label) in self
            .down
            .ticks()
            .into_iter()
            .chain([(bottom, "none".to_owned())])
        {
            let _ = writeln!(
                self.drawing,
                "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/><text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                LEFT - 6.0,
                y + 4.0
            );
        }
        let _ = writeln!(
            self.drawing,
            "<path class=\"axis\" d=\"M{LEFT} {top}V{bottom}H{RIGHT}\"/>"
        );
        for (x, label) in self.across.ticks(LABEL, WIDTH) {
            let _ = writeln!(
                self.drawing,
                "<path class=\"axis\" d=\"M{x:.1} {bottom}v5\"/><text class=\"soft\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
                bottom + 19.0
            );
        }
    }
}

/// The marks in rows, so that no name lies on another: each with the middle of its name and its row. Also how many rows
/// there are.
fn in_rows<'a>(
    across: &EpsilonAxis,
    marks: &'a [ChartMark],
) -> (Vec<(&'a ChartMark, f64, usize)>, usize) {
    let mut ends: Vec<f64> = Vec::new();
    let mut placed = Vec::new();
    for mark in marks {
        let half = CHARACTER * mark.text.chars().count() as f64 / 2.0;
        // The name stays in the panel.
        let most = (WIDTH - 4.0 - half).max(WIDTH / 2.0);
        let middle = across
            .x(mark.value)
            .clamp((4.0 + half).min(WIDTH / 2.0), most);
        let row = ends
            .iter()
            .position(|end| *end + 6.0 <= middle - half)
            .unwrap_or(ends.len());
        if row == ends.len() {
            ends.push(0.0);
        }
        ends[row] = middle + half;
        placed.push((mark, middle, row));
    }
    (placed, ends.len())
}
