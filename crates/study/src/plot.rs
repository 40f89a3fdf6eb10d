//! The parts that all plots share: axes with their ticks, stepped lines with their intervals, and text for XML.

use crate::printable::is_obeyed;

/// Each label of an axis with its place.
pub type Ticks = Vec<(f64, String)>;

/// Decades from the smaller exponent of ten to the larger one.
pub type Decades = (i32, i32);

/// The decades of some sizes, with one more on each side; none without sizes.
pub fn decades_around(sizes: impl Iterator<Item = f64>) -> Option<Decades> {
    let (low, high) = sizes
        .map(|size| size.abs().log10())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
    (low <= high).then(|| {
        let low = low.floor() as i32 - 1;
        (low, (high.ceil() as i32 + 1).max(low + 2))
    })
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
    /// Between two places, with a stretch around zero of some width.
    pub fn new(left: f64, right: f64, zero: f64, mut decades: [Option<Decades>; 2]) -> EpsilonAxis {
        if decades == [None, None] {
            decades[1] = Some((-8, 0));
        }
        let [negative, positive] =
            decades.map(|span| f64::from(span.map_or(0, |(low, high)| high - low)));
        let start = left + (right - left - zero) * negative / (negative + positive).max(1.0);
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
        let along = |(low, high): Decades| {
            ((epsilon.abs().log10() - f64::from(low)) / f64::from(high - low)).clamp(0.0, 1.0)
        };
        let [negative, positive] = self.decades.map(|span| span.map_or(0.0, along));
        match epsilon {
            e if e < 0.0 => start - negative * (start - self.left),
            e if 0.0 < e => end + positive * (self.right - end),
            _ => (start + end) / 2.0,
        }
    }

    /// Zero and powers of ten, as many as fit with labels of some width; none beyond an edge.
    pub fn ticks(&self, label: f64, edge: f64) -> Ticks {
        let middle = self.x(0.0);
        let mut ticks = vec![(middle, "0".to_owned())];
        for (span, sign) in self.decades.iter().zip([-1.0, 1.0]) {
            let Some((low, high)) = *span else { continue };
            let place = |exponent: i32| self.x(sign * 10f64.powi(exponent));
            let decade = (place(high) - place(low)).abs() / f64::from(high - low);
            let stride = (label / decade.max(0.1)).ceil() as i32;
            let shown = (low..=high).filter(|exponent| exponent % stride == 0);
            let shown = shown
                .map(|exponent| (place(exponent), exponent))
                .filter(|(x, _)| 0.6 * label < (x - middle).abs() && x + 0.3 * label <= edge);
            let minus = if sign < 0.0 { "−" } else { "" };
            ticks.extend(shown.map(|(x, e)| (x, format!("{minus}10{}", superscript(e)))));
        }
        ticks
    }
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
    /// Down to one of so many, or at most so many decades.
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
        let label = |exponent: i32| {
            let digits = (-2 - exponent).max(0) as usize;
            format!("{:.digits$} %", 10f64.powi(exponent + 2))
        };
        (self.lowest..=0)
            .map(|e| (self.y(10f64.powi(e)), label(e)))
            .collect()
    }

    /// A share that changes at some places, from each place on to the next and at last to the right
    /// end: the path of its line, and that of its interval, empty without intervals.
    pub fn steps(
        &self,
        points: impl Iterator<Item = (f64, f64, Option<[f64; 2]>)>,
        right: f64,
    ) -> (String, String) {
        let (mut path, mut upper, mut lower) = (String::new(), String::new(), Vec::new());
        let mut last = None;
        for (x, share, interval) in points.filter(|(x, ..)| !x.is_nan()) {
            if last == Some(share) {
                continue;
            }
            let step = |y: f64| match last {
                None => format!("M{x:.1} {y:.1}"),
                Some(_) => format!("H{x:.1}V{y:.1}"),
            };
            path.push_str(&step(self.y(share)));
            if let Some([low, high]) = interval {
                upper.push_str(&step(self.y(high)));
                lower.push((x, self.y(low)));
            }
            last = Some(share);
        }
        path.push_str(&format!("H{right:.1}"));
        let Some((_, low)) = lower.last() else {
            return (path, String::new());
        };
        // Back along the lower ends.
        let mut band = format!("{upper}H{right:.1}V{low:.1}");
        for pair in lower.windows(2).rev() {
            band.push_str(&format!("H{:.1}V{:.1}", pair[1].0, pair[0].1));
        }
        band.push_str(&format!("H{:.1}Z", lower[0].0));
        (path, band)
    }
}

/// The first pixel of a row, its centre and its last one, each labelled with its distance from the
/// centre, in units; their places from 0 to 1.
pub fn pixel_ticks(count: usize, unit: u64) -> Ticks {
    let centre = count / 2;
    let mut pixels = vec![0, centre, count - 1];
    pixels.dedup();
    let tick = |pixel: usize| {
        let distance = group_digits(pixel.abs_diff(centre) as u64 * unit);
        let sign = ["−", "", "+"][(pixel.cmp(&centre) as i8 + 1) as usize];
        (
            (pixel as f64 + 0.5) / count as f64,
            format!("{sign}{distance}"),
        )
    };
    pixels.into_iter().map(tick).collect()
}

/// A number with a comma after each third digit.
pub fn group_digits(number: u64) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups
        .map(String::from_utf8_lossy)
        .collect::<Vec<_>>()
        .join(",")
}

/// `3 findings`, `1 finding`.
pub fn number_of(count: u64, one: &str, many: &str) -> String {
    format!(
        "{} {}",
        group_digits(count),
        if count == 1 { one } else { many }
    )
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
