//! Maps as SVG: a computed panel for each kernel, then the exact one, with ticks, a legend and counts.
//!
//! The drawing has no ids and no styles, so that many of them go into one page, and its text has the
//! page's colour. [`svg_document`] is the same as a file of its own, in light and dark.

use super::{AxisText, Ink, Map, PixelStep};
use crate::plot::{Ticks, escaped, group_digits, pixel_ticks};
use std::fmt::{Display, Write};

/// The side of a panel's slot.
const PANEL: f64 = 268.0;
const LEFT: f64 = 68.0;
const GAP: f64 = 40.0;
const RIGHT: f64 = 16.0;
/// The height of a line of text.
const LINE: f64 = 18.0;
/// The width of a letter, on average: wide enough for most.
const LETTER: f64 = 7.0;

/// The drawing of one or several kernels on the same inputs, to be put into a page. The exact panel is that of the first:
/// [`compared`](super::compared) says whether it is that of all.
pub fn svg(maps: &[Map]) -> String {
    SvgDrawing::new(maps).finish("")
}

/// The drawing as a file of its own, dark where the reader's screen is.
pub fn svg_document(maps: &[Map]) -> String {
    SvgDrawing::new(maps).finish(DOCUMENT)
}

/// The style and the background of drawings in files of their own.
pub(super) const DOCUMENT: &str = "<style>svg{color:#1b1b1b;--paper:#fff}@media(prefers-color-scheme:dark){svg{color:#e6e6e6;--paper:#14171a}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\" style=\"fill:var(--paper,#fff)\"/>\n";

pub(super) const BOLD: &str = " font-weight=\"bold\"";
pub(super) const SMALL: &str = " font-size=\"12\"";

/// Text at a place.
pub(super) fn text(x: impl Display, y: impl Display, attributes: &str, words: &str) -> String {
    format!(
        "<text x=\"{x}\" y=\"{y}\"{attributes}>{}</text>\n",
        escaped(words)
    )
}

/// A drawing of so many dots: its title, its description for a reader who does not see it, and what it consists of.
pub(super) fn drawing_of(
    [width, height]: [f64; 2],
    [title, description]: [&str; 2],
    body: &str,
) -> String {
    let (title, description) = (escaped(title), escaped(description));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"currentColor\" role=\"img\">\n<title>{title}</title>\n<desc>{description}</desc>\n{body}</svg>\n"
    )
}

struct SvgDrawing<'a> {
    /// The kernels' maps: at least one.
    maps: &'a [Map],
    body: String,
    /// Where the next thing goes.
    y: f64,
}

impl<'a> SvgDrawing<'a> {
    fn new(maps: &'a [Map]) -> SvgDrawing<'a> {
        let mut drawing = SvgDrawing {
            maps,
            body: String::new(),
            y: 0.0,
        };
        drawing.lines(&title(maps), BOLD);
        drawing.lines(&format!("what is right: {}", maps[0].measure), SMALL);
        drawing.panels();
        drawing.legend();
        drawing
    }

    /// The whole width: a panel a kernel, and the exact one.
    fn width(&self) -> f64 {
        self.left_of(self.maps.len()) + PANEL + RIGHT
    }

    /// Where a panel begins; the exact one comes after those of the kernels.
    fn left_of(&self, panel: usize) -> f64 {
        LEFT + (PANEL + GAP) * panel as f64
    }

    fn finish(self, document: &str) -> String {
        let words = [&*title(self.maps), &description(self.maps)];
        drawing_of(
            [self.width(), self.y + 6.0],
            words,
            &(document.to_owned() + &self.body),
        )
    }

    /// Text over the whole width, in as many lines as it takes.
    fn lines(&mut self, words: &str, attributes: &str) {
        for line in wrapped(words, ((self.width() - RIGHT - 12.0) / LETTER) as usize) {
            self.y += LINE;
            self.body.push_str(&text(12, self.y, attributes, &line));
        }
    }

    fn panels(&mut self) {
        let exact = &self.maps[0];
        let [width, height] = exact.size();
        let cell = PANEL / width.max(height) as f64;
        let (wide, high) = (cell * width as f64, cell * height as f64);
        let top = self.y + 34.0;
        let computed = self.maps.iter().map(|map| {
            let name = match self.maps {
                [_] => "computed",
                _ => &map.subject,
            };
            (name, cells([width, height], |pixel| map.computed(pixel)))
        });
        let exact_cells = cells([width, height], |pixel| exact.exact(pixel));
        let panels: Vec<(&str, String)> = computed.chain([("exact", exact_cells)]).collect();
        for (panel, (name, cells)) in panels.into_iter().enumerate() {
            let left = self.left_of(panel);
            self.body += &text(left, top - 10.0, BOLD, name);
            self.body += &format!(
                "<g transform=\"translate({left} {top}) scale({cell})\" shape-rendering=\"crispEdges\">\n{cells}</g>\n<rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{high}\" fill=\"none\" stroke=\"#808080\"/>\n"
            );
            for (at, tick) in ticks(&exact.axes[0]) {
                let (x, y) = (left + at * wide, top + high);
                let mark = format_args!("{x:.1} {y:.1}v5");
                self.tick(mark, format_args!("{x:.1}"), y + 18.0, ("middle", &tick));
            }
        }
        for (at, tick) in ticks(&exact.axes[1]) {
            let y = top + (1.0 - at) * high;
            self.tick(
                format_args!("{LEFT} {y:.1}h-5"),
                LEFT - 8.0,
                y + 4.0,
                ("end", &tick),
            );
        }
        self.y = top + high + 24.0;
        for (axis, way) in exact.axes.iter().zip(["to the right", "upwards"]) {
            self.lines(&format!("{way}: {}", axis_words(axis)), SMALL);
        }
    }

    /// A tick and its label.
    fn tick(&mut self, mark: impl Display, x: impl Display, y: f64, (anchor, label): (&str, &str)) {
        self.body += &format!("<path d=\"M{mark}\" stroke=\"#808080\"/>");
        let attributes = format!(" text-anchor=\"{anchor}\"{SMALL}");
        self.body += &text(x, format_args!("{y:.1}"), &attributes, label);
    }

    fn legend(&mut self) {
        self.y += 8.0;
        let computed = self.maps.iter().map(Map::computed_legend);
        let panels: Vec<_> = computed.chain([self.maps[0].exact_legend()]).collect();
        let rows = panels.iter().map(Vec::len).max().unwrap_or(0);
        for (panel, side) in panels.iter().enumerate() {
            let left = match panel {
                0 => 12.0,
                panel => self.left_of(panel),
            };
            for (i, (ink, words, count)) in side.iter().enumerate() {
                let y = self.y + LINE * (i as f64 + 1.0);
                let count = group_digits(*count as u64);
                self.body += &format!(
                    "<rect x=\"{left}\" y=\"{}\" width=\"13\" height=\"13\" fill=\"{}\" stroke=\"#808080\"/>",
                    y - 11.0,
                    ink.name()
                );
                self.body += &text(left + 20.0, y, "", &format!("{words}: {count}"));
            }
        }
        self.y += LINE * rows as f64;
    }
}

fn title(maps: &[Map]) -> String {
    let subjects: Vec<&str> = maps.iter().map(|map| &*map.subject).collect();
    let subjects = subjects.join(" and ");
    format!("{subjects} in {}, one pixel one input", maps[0].scalar)
}

/// A description for a reader who does not see the picture.
fn description(maps: &[Map]) -> String {
    let exact = &maps[0];
    let [width, height] = exact.size();
    let list = |legend: Vec<(Ink, &str, usize)>| {
        let parts: Vec<String> = legend
            .iter()
            .map(|(_, words, n)| format!("{words} {}", group_digits(*n as u64)))
            .collect();
        parts.join(", ")
    };
    let computed: Vec<String> = maps
        .iter()
        .map(|map| {
            let wrong = group_digits(map.wrong() as u64);
            let legend = list(map.computed_legend());
            format!("{}, {wrong} wrong: {legend}.", map.subject)
        })
        .collect();
    format!(
        "A map of {width} by {height} pixels. {} Right, exact: {}. To the right: {}. Upwards: {}.",
        computed.join(" "),
        list(exact.exact_legend()),
        axis_words(&exact.axes[0]),
        axis_words(&exact.axes[1])
    )
}

fn axis_words(axis: &AxisText) -> String {
    format!(
        "{} in steps of {} about {} (bits {})",
        axis.name,
        axis.step.describe(),
        axis.centre,
        axis.bits
    )
}

fn ticks(axis: &AxisText) -> Ticks {
    let unit = match axis.step {
        PixelStep::Ulps(k) => k.into(),
        PixelStep::PowerOfTwo(_) => 1,
    };
    pixel_ticks(axis.count, unit)
}

/// The cells of a panel, one unit each: the commonest ink below, the others as one path each, of runs
/// over rows, equal runs of neighbouring rows together.
fn cells([width, height]: [usize; 2], ink: impl Fn(usize) -> Ink) -> String {
    let inks: Vec<Ink> = (0..width * height).map(ink).collect();
    let count = |wanted: Ink| inks.iter().filter(|ink| **ink == wanted).count();
    let ground = Ink::ALL
        .into_iter()
        .max_by_key(|ink| count(*ink))
        .expect("there are inks");
    let mut paths = vec![String::new(); Ink::ALL.len()];
    // The runs that may go on below: ink, first and last column, first row.
    let mut open: Vec<(Ink, usize, usize, usize)> = Vec::new();
    for y in 0..=height {
        let row = inks.get(y * width..(y + 1) * width).unwrap_or(&[]);
        let runs = runs(row);
        let (kept, ended): (Vec<_>, Vec<_>) = open
            .into_iter()
            .partition(|(ink, from, to, _)| runs.contains(&(*ink, *from, *to)));
        for (ink, from, to, top) in ended {
            let (w, h) = (to - from, y - top);
            let _ = write!(paths[ink as usize], "M{from} {top}h{w}v{h}h-{w}z");
        }
        open = runs
            .into_iter()
            .map(|(ink, from, to)| {
                let above = kept
                    .iter()
                    .find(|run| (run.0, run.1, run.2) == (ink, from, to));
                above.copied().unwrap_or((ink, from, to, y))
            })
            .collect();
    }
    let mut out = format!(
        "<path fill=\"{}\" d=\"M0 0h{width}v{height}h-{width}z\"/>\n",
        ground.name()
    );
    for ink in Ink::ALL {
        let path = &paths[ink as usize];
        if ink != ground && !path.is_empty() {
            let _ = writeln!(out, "<path fill=\"{}\" d=\"{path}\"/>", ink.name());
        }
    }
    out
}

/// Equal neighbours of a row: ink, first column, the column after the last.
fn runs(row: &[Ink]) -> Vec<(Ink, usize, usize)> {
    let mut from = 0;
    row.chunk_by(|a, b| a == b)
        .map(|run| {
            let start = from;
            from += run.len();
            (run[0], start, from)
        })
        .collect()
}

/// Text in lines of at most so many letters, broken at spaces and commas; a longer word stays whole.
pub(super) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_inclusive([' ', ',']) {
        let line = lines.last_mut().expect("there is one");
        if !line.is_empty() && line.chars().count() + word.trim_end().chars().count() > most {
            lines.push(word.to_owned());
        } else {
            line.push_str(word);
        }
    }
    lines
        .iter()
        .map(|line| line.trim_end().to_owned())
        .collect()
}
