//! The parts of a scene's plots: sizes, colours, axes, marks and texts.

use super::record::CountPart;
use crate::plot::{EpsilonAxis, ShareAxis, escaped};
use std::fmt::Write as _;

/// The width of a panel, and of a file.
pub(super) const WIDTH: f64 = 460.0;
pub(super) const LEFT: f64 = 62.0;
pub(super) const RIGHT: f64 = 14.0;
/// The height of the plot itself, and of a line of text.
pub(super) const PLOT: f64 = 210.0;
pub(super) const LINE: f64 = 17.0;
/// The width of the stretch around zero.
pub(super) const ZERO: f64 = 24.0;
/// About the width of a character.
pub(super) const CHARACTER: f64 = 6.4;

/// Colours by kind of ray, dashes by kind of error; light and dark.
pub(super) const STYLE: &str = "
.scene-plot { font: 12px system-ui, -apple-system, sans-serif; fill: #1d2125; }
.scene-plot .paper { fill: #fff; } .scene-plot .soft { fill: #575e66; }
.scene-plot .grid { stroke: #dcdfe3; fill: none; } .scene-plot .axis { stroke: #575e66; fill: none; }
.scene-plot .tried { stroke: #575e66; stroke-dasharray: 1 3; fill: none; }
.scene-plot .this { stroke: #1d2125; stroke-dasharray: none; } .scene-plot text.this { stroke: none; font-weight: 700; }
.scene-plot .within { fill: #1a6b3a; fill-opacity: .14; } .scene-plot .open { fill-opacity: .06; }
.scene-plot .line { stroke: currentColor; fill: none; stroke-width: 2; stroke-linejoin: round; }
.scene-plot .band { fill: currentColor; fill-opacity: .07; }
.scene-plot .limit { fill: currentColor; stroke: currentColor; } .scene-plot .proved { fill: none; stroke-width: 1.5; }
.scene-plot .hit, .scene-plot .self-hit { stroke-dasharray: 7 3; } .scene-plot .crack { stroke-dasharray: 2 3; }
.scene-plot .interior { color: #b34700; } .scene-plot .edges { color: #5f6670; }
.scene-plot .vertices { color: #7b3fa0; } .scene-plot .grazing { color: #1d5fae; }
.scene-plot .parallel { color: #00707a; } .scene-plot .shadow { color: #1a6b3a; } .scene-plot .outside { color: #8a6d00; }
@media (prefers-color-scheme: dark) {
.scene-plot { fill: #e6e8ea; }
.scene-plot .paper { fill: #14171a; } .scene-plot .soft { fill: #a3abb3; }
.scene-plot .grid { stroke: #343a41; } .scene-plot .axis, .scene-plot .tried { stroke: #a3abb3; }
.scene-plot .this { stroke: #e6e8ea; } .scene-plot text.this { stroke: none; } .scene-plot .within { fill: #7ed09a; }
.scene-plot .interior { color: #f5a45d; } .scene-plot .edges { color: #a3abb3; }
.scene-plot .vertices { color: #c79be6; } .scene-plot .grazing { color: #86b9f7; }
.scene-plot .parallel { color: #5fc7d1; } .scene-plot .shadow { color: #7ed09a; } .scene-plot .outside { color: #e0c04f; }
}
";

/// A text in lines that fit.
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

pub(super) fn text_at(x: f64, y: f64, class: &str, text: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" class=\"{class}\">{}</text>\n", escaped(text))
}

/// True if limits are on one side only.
pub(super) fn is_open(ends: [f64; 2]) -> bool {
    ends.iter().any(|end| end.is_infinite())
}

/// The middle of a text near a place, so that it stays in the panel.
pub(super) fn centre(x: f64, text: &str) -> f64 {
    let half = CHARACTER * text.chars().count() as f64 / 2.0;
    x.clamp((4.0 + half).min(WIDTH / 2.0), (WIDTH - 4.0 - half).max(WIDTH / 2.0))
}

/// A triangle on the axis that points to the side that a limit allows.
pub(super) fn marker(x: f64, y: f64, is_lower: bool, count: &CountPart, is_proved: bool) -> String {
    let ahead = if is_lower { 9.0 } else { -9.0 };
    let class = if is_proved { "limit proved" } else { "limit" };
    let stratum = count.stratum.trim_start_matches("scene-");
    format!(
        "<path class=\"{class} {stratum}\" d=\"M{x:.1} {:.1}l{ahead} 5l{} 5z\"/>\n",
        y - 5.0,
        -ahead
    )
}

pub(super) fn axes(across: &EpsilonAxis, down: &ShareAxis, top: f64, bottom: f64) -> String {
    let right = WIDTH - RIGHT;
    let mut drawing = String::new();
    for (y, label) in down.ticks().into_iter().chain([(bottom, "none".to_owned())]) {
        let _ = writeln!(
            drawing,
            "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{right}\"/><text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
            LEFT - 6.0,
            y + 4.0
        );
    }
    let _ = writeln!(drawing, "<path class=\"axis\" d=\"M{LEFT} {top}V{bottom}H{right}\"/>");
    for (x, label) in across.ticks(48.0, WIDTH) {
        let _ = writeln!(
            drawing,
            "<path class=\"axis\" d=\"M{x:.1} {bottom}v5\"/><text class=\"soft\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
            bottom + 19.0
        );
    }
    drawing
}
