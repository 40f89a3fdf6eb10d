//! The parts that all plots share: axes with their ticks, stepped lines with their intervals, and text for XML.

use crate::printable::is_obeyed;
use std::cmp::Ordering;

/// Each label of an axis with its place.
pub type Ticks = Vec<(f64, String)>;

/// Decades from the smaller exponent of ten to the larger one.
pub type Decades = (i32, i32);

/// The decades of some sizes, with one more on each side; none without sizes.
pub fn decades_around(sizes: impl Iterator<Item = f64>) -> Option<Decades> {
    let mut least = f64::INFINITY;
    let mut most = f64::NEG_INFINITY;
    for size in sizes {
        let exponent = size.abs().log10();
        least = least.min(exponent);
        most = most.max(exponent);
    }
    if least > most {
        return None;
    }
    let low = least.floor() as i32 - 1;
    let high = most.ceil() as i32 + 1;
    Some((low, high.max(low + 2)))
}

/// Epsilons across: zero in a stretch of its own, negative and positive ones logarithmic on each side.
pub struct EpsilonAxis {
    left: f64,
    right: f64,
    /// The stretch around zero: where it begins and ends.
    zero: (f64, f64),
    /// Decades of negative epsilons, and of positive ones; none if not drawn.
    decades: [Option<Decades>; 2],
}

impl EpsilonAxis {
    /// The axis between two places, with a stretch around zero of some width.
    pub fn new(left: f64, right: f64, zero: f64, mut decades: [Option<Decades>; 2]) -> EpsilonAxis {
        if decades == [None, None] {
            decades[1] = Some((-8, 0));
        }
        let counts = decades.map(|span| span.map_or(0, |(low, high)| high - low));
        let [negative, positive] = counts.map(f64::from);
        let all = (negative + positive).max(1.0);
        let start = left + (right - left - zero) * negative / all;
        EpsilonAxis {
            left,
            right,
            zero: (start, start + zero),
            decades,
        }
    }

    /// The place of an epsilon; one beyond the axis is at its end.
    pub fn x(&self, epsilon: f64) -> f64 {
        let (start, end) = self.zero;
        let [negative, positive] = self.decades.map(|span| share_along(span, epsilon));
        if epsilon < 0.0 {
            start - negative * (start - self.left)
        } else if 0.0 < epsilon {
            end + positive * (self.right - end)
        } else {
            (start + end) / 2.0
        }
    }

    /// Zero and powers of ten, as many as fit with labels of some width; none beyond an edge.
    pub fn ticks(&self, label: f64, edge: f64) -> Ticks {
        let middle = self.x(0.0);
        let mut ticks = vec![(middle, "0".to_owned())];
        for (span, sign) in self.decades.into_iter().zip([-1.0, 1.0]) {
            let Some((low, high)) = span else { continue };
            let place = |exponent: i32| self.x(sign * 10f64.powi(exponent));
            let decade = (place(high) - place(low)).abs() / f64::from(high - low);
            let stride = (label / decade.max(0.1)).ceil() as i32;
            let minus = if sign < 0.0 { "−" } else { "" };
            for exponent in low..=high {
                let x = place(exponent);
                let is_clear_of_zero = 0.6 * label < (x - middle).abs();
                let is_within_edge = x + 0.3 * label <= edge;
                if exponent % stride == 0 && is_clear_of_zero && is_within_edge {
                    ticks.push((x, format!("{minus}10{}", superscript(exponent))));
                }
            }
        }
        ticks
    }
}

/// How far along some decades the size of an epsilon is, from 0 to 1; 0 without decades.
fn share_along(span: Option<Decades>, epsilon: f64) -> f64 {
    let Some((low, high)) = span else {
        return 0.0;
    };
    let from_low = epsilon.abs().log10() - f64::from(low);
    (from_low / f64::from(high - low)).clamp(0.0, 1.0)
}

/// Shares upwards, logarithmic, with zero below the smallest.
pub struct ShareAxis {
    top: f64,
    bottom: f64,
    /// The exponent of ten of the smallest share.
    lowest: i32,
}

/// How many decades below the smallest share zero is.
const NONE: f64 = 0.7;

impl ShareAxis {
    /// The axis from 1 down to one in `of`, but by at most so many decades.
    pub fn new(top: f64, bottom: f64, of: u64, most: i32) -> ShareAxis {
        let lowest = -((of.max(1) as f64).log10().ceil() as i32);
        ShareAxis {
            top,
            bottom,
            lowest: lowest.clamp(-most, -1),
        }
    }

    /// The place of a share.
    pub fn y(&self, share: f64) -> f64 {
        let zero = f64::from(self.lowest) - NONE;
        let log = if 0.0 < share {
            share.log10().clamp(zero, 0.0)
        } else {
            zero
        };
        self.top + (self.bottom - self.top) * (log / zero)
    }

    /// Powers of ten as percentages.
    pub fn ticks(&self) -> Ticks {
        let mut ticks = Vec::new();
        for exponent in self.lowest..=0 {
            let digits = (-2 - exponent).max(0) as usize;
            let label = format!("{:.digits$} %", 10f64.powi(exponent + 2));
            ticks.push((self.y(10f64.powi(exponent)), label));
        }
        ticks
    }

    /// A share that changes at some places, from each place on to the next and at last to the right
    /// end: the path of its line, and that of its interval, empty without intervals.
    pub fn steps(
        &self,
        points: impl Iterator<Item = (f64, f64, Option<[f64; 2]>)>,
        right: f64,
    ) -> (String, String) {
        let mut path = String::new();
        let mut upper = String::new();
        let mut lower = Vec::new();
        let mut last = None;
        for (x, share, interval) in points {
            if x.is_nan() || last == Some(share) {
                continue;
            }
            let is_first = last.is_none();
            path.push_str(&step_to(x, self.y(share), is_first));
            if let Some([low, high]) = interval {
                upper.push_str(&step_to(x, self.y(high), is_first));
                lower.push((x, self.y(low)));
            }
            last = Some(share);
        }
        path.push_str(&format!("H{right:.1}"));
        if lower.is_empty() {
            return (path, String::new());
        }
        // Back along the lower ends.
        let mut band = upper;
        let mut to = right;
        for (x, low) in lower.into_iter().rev() {
            band.push_str(&format!("H{to:.1}V{low:.1}"));
            to = x;
        }
        band.push_str(&format!("H{to:.1}Z"));
        (path, band)
    }
}

/// A step of a path: across, and then up or down.
fn step_to(x: f64, y: f64, is_first: bool) -> String {
    if is_first {
        format!("M{x:.1} {y:.1}")
    } else {
        format!("H{x:.1}V{y:.1}")
    }
}

/// The first pixel of a row, its centre and its last one, each labelled with its distance from the
/// centre, in units; their places from 0 to 1.
pub fn pixel_ticks(count: usize, unit: u64) -> Ticks {
    let centre = count / 2;
    let mut pixels = vec![0, centre, count - 1];
    pixels.dedup();
    let mut ticks = Vec::with_capacity(pixels.len());
    for pixel in pixels {
        let place = (pixel as f64 + 0.5) / count as f64;
        let distance = group_digits(pixel.abs_diff(centre) as u64 * unit);
        let sign = match pixel.cmp(&centre) {
            Ordering::Less => "−",
            Ordering::Equal => "",
            Ordering::Greater => "+",
        };
        ticks.push((place, format!("{sign}{distance}")));
    }
    ticks
}

/// A number with a comma after each third digit.
pub fn group_digits(number: u64) -> String {
    let digits = number.to_string();
    let from_the_right = digits.as_bytes().rchunks(3).map(String::from_utf8_lossy);
    let groups: Vec<_> = from_the_right.rev().collect();
    groups.join(",")
}

/// `3 findings`, `1 finding`.
pub fn number_of(count: u64, one: &str, many: &str) -> String {
    let noun = if count == 1 { one } else { many };
    format!("{} {noun}", group_digits(count))
}

/// An exponent in raised digits.
fn superscript(exponent: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    exponent.to_string().chars().map(raised).collect()
}

/// Text for XML 1.0; a character that XML does not have, or that is an order, becomes a replacement character.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' => escaped.push(c),
            c if is_obeyed(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: Ticks) -> Vec<String> {
        ticks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn zero_stands_between_two_logarithmic_halves() {
        let axis = EpsilonAxis::new(0.0, 220.0, 20.0, [Some((-4, -2)), Some((-6, 2))]);
        assert_eq!(
            [-1e-2, -1e-3, 0.0, 1e-6, 1e-2, 1e2].map(|e| axis.x(e).round()),
            [0.0, 20.0, 50.0, 60.0, 140.0, 220.0]
        );
        assert_eq!([axis.x(f64::MIN), axis.x(f64::MAX)], [0.0, 220.0]);
        // Two decades take 40: every second one has a label, and none leaves the picture.
        assert_eq!(
            labels(axis.ticks(40.0, 220.0)),
            ["0", "−10⁻²", "10⁻⁴", "10⁻²", "10⁰"]
        );
        let positive = EpsilonAxis::new(0.0, 100.0, 20.0, [None, None]);
        assert_eq!(
            [-1.0, 0.0, 1e-8, 1.0].map(|e| positive.x(e)),
            [0.0, 10.0, 20.0, 100.0]
        );
        assert_eq!(decades_around([3e-7, -2e-3].into_iter()), Some((-8, -1)));
        assert_eq!(decades_around([1.0].into_iter()), Some((-1, 1)));
        assert_eq!(decades_around([].into_iter()), None);
    }

    #[test]
    fn a_share_steps_where_it_changes() {
        let axis = ShareAxis::new(0.0, 27.0, 100, 5);
        assert_eq!(
            [1.0, 0.1, 0.01, 1e-9, 0.0].map(|s| axis.y(s)),
            [0.0, 10.0, 20.0, 27.0, 27.0]
        );
        assert_eq!(labels(axis.ticks()), ["1 %", "10 %", "100 %"]);
        assert_eq!(
            labels(ShareAxis::new(0.0, 1.0, 1 << 40, 5).ticks())[0],
            "0.001 %"
        );
        let points = [
            (0.0, 0.1, Some([0.01, 1.0])),
            (5.0, 0.1, None),
            (7.0, 1.0, Some([0.1, 1.0])),
        ];
        let (path, band) = axis.steps(points.into_iter(), 9.0);
        assert_eq!(path, "M0.0 10.0H7.0V0.0H9.0");
        assert_eq!(band, "M0.0 0.0H7.0V0.0H9.0V10.0H7.0V20.0H0.0Z");
    }

    #[test]
    fn pixels_are_counted_from_the_centre() {
        let ticks = pixel_ticks(4, 1024);
        let expected = [(0.125, "−2,048"), (0.625, "0"), (0.875, "+1,024")];
        assert_eq!(ticks, expected.map(|(at, label)| (at, label.to_owned())));
        assert_eq!(pixel_ticks(1, 1), [(0.5, "0".to_owned())]);
    }

    #[test]
    fn nothing_in_a_text_is_markup() {
        assert_eq!(
            escaped("a<b> & \"c\"\u{1}\n"),
            "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}\n"
        );
    }
}
