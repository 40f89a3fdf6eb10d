//! A case as a drawing: the triangle in its own plane, the ray, where its line really meets the plane
//! and where a kernel says so, with a zoomed inset where these are near the boundary.
//!
//! Everything is exact until it is a place in the drawing, counted from where it is looked at: digits
//! are lost neither far from zero nor close to an edge.

use super::frame::Stretch;
use super::panel::Panel;
use super::scene::{FloatLayer, MapScene};
use super::svg::{BOLD, DOCUMENT, SMALL, drawing_of, text, wrapped};
use crate::arith::{Exact, Float, Real};
use crate::audit::{Row, exact_severity};
use crate::case::Case;
use crate::files::number;
use crate::judge::{asked, judge};
use crate::kernel::{Scalar, Verdict, verdicts_of};
use crate::oracle::{self, Definition};
use crate::truth::Truth;
use hairline_core::{Error, ErrorKind};

const WIDTH: f64 = 640.0;
const SIDE: f64 = 298.0;
const MARGIN: f64 = 14.0;
const LINE: f64 = 18.0;

/// The drawing of a row on a case, to be put into a page: it has no ids and no styles, and text of the
/// page's colour.
pub fn drawing<F: Scalar>(case: &Case<F>, row: &Row) -> Result<String, Error> {
    Ok(DrawingTexts::new(case, row)?.finish(""))
}

/// The drawing as a file of its own, dark where the reader's screen is.
pub fn drawing_document<F: Scalar>(case: &Case<F>, row: &Row) -> Result<String, Error> {
    Ok(DrawingTexts::new(case, row)?.finish(DOCUMENT))
}

/// The texts of the drawing, and its body so far.
struct DrawingTexts {
    title: String,
    lines: Vec<String>,
    body: String,
    y: f64,
}

impl DrawingTexts {
    fn new<F: Scalar>(case: &Case<F>, row: &Row) -> Result<DrawingTexts, Error> {
        let name = row.entry.info.name;
        let subject = F::subject(row.entry).ok_or_else(|| {
            let line = format!("kernel '{name}' does not run in {}", F::NAME);
            Error::new(ErrorKind::Unsupported, line)
        })?;
        let mut verdict = [Verdict::miss(None)];
        verdicts_of(
            subject,
            std::slice::from_ref(case),
            &row.epsilons::<F>(),
            &mut verdict,
        );
        let [verdict] = verdict;
        let definition = oracle::define(case);
        let asked = asked(case, &definition.truth, &row.contract, false);
        let gives = row.entry.info.gives;
        let finding = judge(
            (&row.contract, asked),
            (case, &definition.truth),
            gives,
            &verdict,
        );
        let judged = finding.map_or("as its contract asks", |finding| finding.name());
        let mut witness = DrawingTexts {
            title: format!("{} in {}: {judged}", row.label(), F::NAME),
            lines: vec![exactly(&definition), computed(row, &verdict)],
            body: String::new(),
            y: 0.0,
        };
        if !case.vectors().iter().flatten().all(Real::is_finite) {
            let nothing = "A coordinate is not finite: there is nothing to draw.";
            witness.lines.push(nothing.to_owned());
            return Ok(witness);
        }
        witness.distances(case, row);
        let [_, direction, ..] = case.vectors();
        if direction.iter().any(|x| !x.is_zero()) {
            witness.scene(&MapScene::new(case, gives, &verdict, &definition));
        } else {
            witness
                .lines
                .push("A direction of zero: there is no line to draw.".to_owned());
        }
        Ok(witness)
    }

    /// How far the case is from its boundary, in words.
    fn distances<F: Float>(&mut self, case: &Case<F>, row: &Row) {
        let Some(severity) = exact_severity(case, row.contract.extent) else {
            return;
        };
        let space = severity.in_space;
        let mut text = format!(
            "The line passes the triangle's boundary at {} of its longest edge, {} ulps of the largest coordinate",
            distance(space),
            distance(space * severity.edge_in_ulps)
        );
        if let Some(in_plane) = severity.in_plane {
            text += &format!("; in the plane it is {}", distance(in_plane));
        }
        if let Some(along) = severity.along {
            text += &format!("; along the ray {} from an end of it", distance(along));
        }
        self.lines.push(text + ".");
    }

    fn scene(&mut self, scene: &MapScene) {
        self.lines.push(scene.seen().to_owned());
        if let Some(apart) = scene.apart() {
            let apart = distance(apart);
            let words = format!("The kernel's point is {apart} longest edges from the exact one.");
            self.lines.push(words);
        }
        let top = self.y + 52.0;
        let layer = scene.from(&scene.triangle.a);
        let main = overview(&layer, MARGIN, top);
        self.panel(&main, &layer, "the triangle");
        let near = scene.from(&scene.focus());
        if let Some(half) = near.inset_half() {
            let left = WIDTH - MARGIN - SIDE;
            let inset = Panel {
                left,
                top,
                side: SIDE,
                centre: [0.0; 2],
                half,
            };
            let name = format!("the point, {} times larger", brief(main.half / half));
            self.panel(&inset, &near, &name);
            self.bar(&inset);
        }
        self.y = top + SIDE + 4.0;
        self.keys(scene);
    }

    fn panel(&mut self, panel: &Panel, layer: &FloatLayer, name: &str) {
        let Panel {
            left, top, side, ..
        } = *panel;
        let out = &mut self.body;
        *out += &text(left, top - 8.0, BOLD, name);
        let edges: Option<Vec<Stretch>> = layer.edges.iter().copied().collect();
        let fill = edges
            .filter(|_| layer.has_area)
            .map(|edges| panel.left_of(&edges));
        if let Some(path) = fill.filter(|path| !path.is_empty()) {
            *out += &format!("<path d=\"{path}\" fill=\"#6fb4e6\" fill-opacity=\"0.4\"/>\n");
        }
        let mut stroke = |stretch: &Option<Stretch>, attributes: &str| {
            if let Some([[x1, y1], [x2, y2]]) = stretch.and_then(|stretch| panel.ends(&stretch)) {
                let ends = format!("M{x1:.2} {y1:.2}L{x2:.2} {y2:.2}");
                *out += &format!("<path d=\"{ends}\" fill=\"none\" {attributes}/>\n");
            }
        };
        for edge in &layer.edges {
            stroke(edge, "stroke=\"currentColor\" stroke-width=\"2\"");
        }
        stroke(
            &layer.line,
            "stroke=\"currentColor\" stroke-dasharray=\"3 4\"",
        );
        stroke(&layer.interval, "stroke=\"currentColor\"");
        stroke(
            &layer.contact,
            "stroke=\"#0072b2\" stroke-width=\"5\" stroke-opacity=\"0.7\"",
        );
        *out += &format!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{side}\" height=\"{side}\" fill=\"none\" stroke=\"#808080\"/>\n"
        );
        self.names(panel, layer);
        let marks = [
            (Some(layer.origin), PointMark::Origin),
            (layer.computed, PointMark::Computed),
            (layer.exact, PointMark::Exact),
        ];
        for (point, mark) in marks {
            let Some(point) = point else { continue };
            if let Some(place) = panel.place(point) {
                self.body += &mark.at(place);
            } else if let (Some(([x, y], [dx, dy])), true) =
                (panel.pointer(point), mark != PointMark::Origin)
            {
                // An arrow whose tip is on the rim.
                let (bx, by) = (x - 12.0 * dx, y - 12.0 * dy);
                let corner = |side: f64| format!("L{:.2} {:.2}", bx - side * dy, by + side * dx);
                let (one, other, color) = (corner(5.0), corner(-5.0), mark.color());
                self.body +=
                    &format!("<path d=\"M{x:.2} {y:.2}{one}{other}z\" fill=\"{color}\"/>\n");
            }
        }
    }

    /// The names of the vertices, beside them and off the triangle.
    fn names(&mut self, panel: &Panel, layer: &FloatLayer) {
        let mut named: Vec<([f64; 2], String)> = Vec::new();
        for (vertex, name) in layer.vertices.into_iter().zip(["a", "b", "c"]) {
            let Some(place) = panel.place(vertex) else {
                continue;
            };
            match named.iter_mut().find(|(at, _)| *at == place) {
                Some((_, names)) => *names += &format!(" = {name}"),
                None => named.push((place, name.to_owned())),
            }
        }
        let middle: [f64; 2] = [0, 1].map(|i| layer.vertices.iter().map(|v| v[i] / 3.0).sum());
        let from = panel.place(middle);
        for ([x, y], names) in named {
            let away = from.map(|[mx, my]| [x - mx, y - my]);
            let [dx, dy] = match away {
                _ if !layer.has_area => [0.0, -1.0],
                Some([dx, dy]) if dx.hypot(dy) > 1.0 => [dx, dy].map(|way| way / dx.hypot(dy)),
                _ => [-0.7, -0.7],
            };
            // Within the window.
            let x = (x + 13.0 * dx).clamp(panel.left + 10.0, panel.left + panel.side - 10.0);
            let y = (y + 13.0 * dy).clamp(panel.top + 12.0, panel.top + panel.side - 8.0);
            let attributes = " text-anchor=\"middle\" font-style=\"italic\"";
            let [x, y] = [x, y + 4.0].map(|place| format!("{place:.2}"));
            self.body += &text(x, y, attributes, &names);
        }
    }

    /// The scale of an inset: a bar of a power of ten of longest edges.
    fn bar(&mut self, panel: &Panel) {
        let power = panel.half.log10().floor();
        let length = 10f64.powf(power) / panel.half * panel.side / 2.0;
        let (x, y) = (panel.left + 10.0, panel.top + panel.side - 12.0);
        if !(1.0..=panel.side).contains(&length) {
            return;
        }
        let [x, bar, words] = [x, y - 3.0, y - 8.0].map(|place| format!("{place:.2}"));
        self.body += &format!(
            "<path d=\"M{x} {bar}v6h{length:.2}v-6\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\"/>"
        );
        self.body += &text(x, words, SMALL, &format!("1e{power} of the longest edge"));
    }

    /// Draws the key to the marks.
    fn keys(&mut self, scene: &MapScene) {
        let mut keys = vec![(PointMark::Origin, "the ray's origin")];
        if scene.exact.is_some() {
            keys.push((PointMark::Exact, "where its line meets the plane, exactly"));
        }
        if scene.computed.is_some() {
            keys.push((PointMark::Computed, "where the kernel says so"));
        }
        let mut x = MARGIN + 8.0;
        self.y += LINE;
        for (mark, words) in keys {
            self.body += &mark.at([x, self.y - 4.5]);
            self.body += &text(format_args!("{:.2}", x + 12.0), self.y, SMALL, words);
            x += 40.0 + 6.6 * words.len() as f64;
        }
        let contact = if scene.contact.is_some() {
            ", thick: in the triangle"
        } else {
            ""
        };
        self.lines.push(format!(
            "Lines: the ray on its interval, dashed: the rest of its line{contact}. Arrows at the rim point to marks outside of it."
        ));
    }

    fn finish(mut self, document: &str) -> String {
        let most = ((WIDTH - 2.0 * MARGIN) / 6.9) as usize;
        self.body += &text(MARGIN, LINE, BOLD, &self.title);
        let mut y = self.y.max(LINE) + 4.0;
        for line in self.lines.iter().flat_map(|line| wrapped(line, most)) {
            y += LINE;
            self.body += &text(MARGIN, y, SMALL, &line);
        }
        let words = [&*self.title, &self.lines.join(" ")];
        drawing_of(
            [WIDTH, y + 10.0],
            words,
            &(document.to_owned() + &self.body),
        )
    }
}

/// The mark of a point.
#[derive(Clone, Copy, PartialEq, Eq)]
enum PointMark {
    Origin,
    Exact,
    Computed,
}

impl PointMark {
    fn color(self) -> &'static str {
        match self {
            PointMark::Origin => "currentColor",
            PointMark::Exact => "#0072b2",
            PointMark::Computed => "#c83e00",
        }
    }

    fn at(self, [x, y]: [f64; 2]) -> String {
        let color = self.color();
        match self {
            PointMark::Origin => format!(
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"7\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>\n"
            ),
            PointMark::Exact => format!(
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.5\" fill=\"{color}\" stroke=\"#fff\"/>\n"
            ),
            PointMark::Computed => format!(
                "<path d=\"M{:.2} {:.2}l11 11m0 -11l-11 11\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2.5\"/>\n",
                x - 5.5,
                y - 5.5
            ),
        }
    }
}

/// A window onto the whole triangle, and onto marks that are not far from it.
fn overview(layer: &FloatLayer, left: f64, top: f64) -> Panel {
    let mut points: Vec<[f64; 2]> = layer.vertices.to_vec();
    let is_near = |p: &[f64; 2]| p.iter().all(|x| x.abs() < 2.5);
    points.extend(
        [layer.exact, layer.computed]
            .into_iter()
            .flatten()
            .filter(is_near),
    );
    let ends = |i: usize| {
        let values = || points.iter().map(|p| p[i]).filter(|x| x.is_finite());
        (
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        )
    };
    let [(x0, x1), (y0, y1)] = [ends(0), ends(1)];
    let extent = (x1 - x0).max(y1 - y0);
    let half = if extent > 0.0 { extent * 0.64 } else { 1.5 };
    Panel {
        left,
        top,
        side: SIDE,
        centre: [x0.midpoint(x1), y0.midpoint(y1)],
        half,
    }
}

/// The exact truth in words.
fn exactly(definition: &Definition) -> String {
    let mut text = format!("Exactly: {}", definition.truth);
    if let (Truth::Transversal(_), Some(t)) = (definition.truth, &definition.exact.t)
        && let t = Exact::from_rational(t).approximate()
        && t.is_finite()
    {
        text += &format!(", t = {}", value(t));
    }
    text + "."
}

/// The verdict in words.
fn computed<F: Float>(row: &Row, verdict: &Verdict<F>) -> String {
    if let Some(failure) = verdict.failure {
        return format!("Computed: no verdict, the kernel {failure}.");
    }
    if !verdict.hit {
        let gate = verdict
            .refused_by
            .and_then(|gate| row.entry.info.gates.get(usize::from(gate)));
        return match gate {
            Some(gate) => format!("Computed: a miss, refused by gate {}.", gate.name),
            None => "Computed: a miss.".to_owned(),
        };
    }
    let gives = row.entry.info.gives;
    let mut text = "Computed: a hit".to_owned();
    if gives.t {
        text += &format!(", t = {}", value(verdict.t));
    }
    if gives.uv {
        text += &format!(", u = {}, v = {}", value(verdict.u), value(verdict.v));
    }
    if let (true, Some(facing)) = (gives.facing, verdict.facing) {
        text += &format!(", {}", facing.name());
    }
    text + "."
}

/// A distance in four digits.
fn distance(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if x.is_finite() {
        format!("{x:.3e}")
    } else {
        "more than 1e308".to_owned()
    }
}

/// A computed value.
fn value<F: Float>(x: F) -> String {
    if x.is_nan() {
        "not a number".to_owned()
    } else if !x.is_finite() {
        "infinite".to_owned()
    } else {
        number::write(x)
    }
}

/// A factor in three digits.
fn brief(factor: f64) -> String {
    if factor < 1000.0 {
        format!("{factor:.1}")
    } else {
        format!("{factor:.2e}")
    }
}
