//! Which floats the pixels of a map stand for: two coordinates of one point, each in equal steps.

use crate::arith::{Float, scale_by_power_of_two};
use hairline_core::{Error, ErrorKind};

/// How far the neighbouring pixels of an axis are apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelStep {
    /// So many floats: with 1, each pixel is a float and the next pixel the next float.
    Ulps(u32),
    /// 2 to this power, the sum with the centre rounded to the nearest float. For a coordinate that is
    /// zero, about which the floats are denser than anything that is computed from them.
    PowerOfTwo(i32),
}

impl PixelStep {
    /// In words: `1 ulp`, `16 ulps`, `2^-24`.
    pub fn describe(self) -> String {
        match self {
            PixelStep::Ulps(1) => "1 ulp".to_owned(),
            PixelStep::Ulps(k) => format!("{k} ulps"),
            PixelStep::PowerOfTwo(k) => format!("2^{k}"),
        }
    }
}

/// One axis of a map: a coordinate and its values, from low to high.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<F> {
    /// Which coordinate of the point: 0, 1 or 2.
    pub coordinate: usize,
    /// The value of the case itself, at pixel `count / 2`.
    pub centre: F,
    /// From pixel to pixel.
    pub step: PixelStep,
    /// The number of pixels.
    pub count: usize,
}

impl<F: Float> Axis<F> {
    /// How many steps a pixel is from the centre.
    pub fn offset(&self, pixel: usize) -> i64 {
        pixel as i64 - (self.count / 2) as i64
    }

    /// The float of a pixel: past the largest it is infinite, and about a NaN it is that NaN.
    pub fn value(&self, pixel: usize) -> F {
        let offset = self.offset(pixel);
        if offset == 0 {
            // Also of a negative zero.
            return self.centre;
        }
        match self.step {
            PixelStep::Ulps(ulps) => self.centre.offset_ulps(offset * i64::from(ulps)),
            PixelStep::PowerOfTwo(power) => {
                let distance = F::from_f64(scale_by_power_of_two(offset as f64, power));
                self.centre + distance
            }
        }
    }
}

/// The pixels of a map: one point of the input takes all pairs of values of two of its coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<F> {
    /// Which point is varied: its place among origin, direction, a, b, c.
    pub point: usize,
    /// To the right, and upwards.
    pub axes: [Axis<F>; 2],
}

/// The most pixels of a map on a side.
pub const MOST_PIXELS: usize = 2048;

impl<F: Float> Grid<F> {
    /// About a point, in a chosen plane of two of its coordinates; `step` on both axes, or by
    /// its natural step if none. `extent` is a coordinate as large as those that the point is compared with.
    pub fn about(
        point: usize,
        values: &[F],
        coordinates: [usize; 2],
        step: Option<PixelStep>,
        [width, height]: [usize; 2],
        extent: F,
    ) -> Result<Grid<F>, Error> {
        if coordinates[0] == coordinates[1] || coordinates.iter().any(|&i| i >= values.len()) {
            let count = values.len();
            let line = format!("axes are two different ones of a point's {count} coordinates");
            return Err(Error::new(ErrorKind::OutOfRange, line));
        }
        if ![width, height]
            .iter()
            .all(|side| (1..=MOST_PIXELS).contains(side))
        {
            let line = format!(
                "a map of {width}x{height} pixels is not possible: each side has 1 to {MOST_PIXELS}"
            );
            return Err(Error::new(ErrorKind::OutOfRange, line));
        }
        if step == Some(PixelStep::Ulps(0)) {
            let line = "a step is at least 1 ulp";
            return Err(Error::new(ErrorKind::OutOfRange, line));
        }
        let axis = |coordinate: usize, count| {
            let centre = values[coordinate];
            let step = step.unwrap_or_else(|| natural_step(centre, values, extent));
            Axis {
                coordinate,
                centre,
                step,
                count,
            }
        };
        Ok(Grid {
            point,
            axes: [axis(coordinates[0], width), axis(coordinates[1], height)],
        })
    }

    /// Pixels to the right, and upwards.
    pub fn size(&self) -> [usize; 2] {
        self.axes.map(|axis| axis.count)
    }

    /// The point's coordinates at a pixel, counted from the left and from the bottom.
    pub fn moved<const N: usize>(&self, mut point: [F; N], [x, y]: [usize; 2]) -> [F; N] {
        for (axis, pixel) in self.axes.iter().zip([x, y]) {
            point[axis.coordinate] = axis.value(pixel);
        }
        point
    }
}

/// The default step of an axis: 1 ulp, and for a coordinate that is zero the ulp of the
/// point's largest coordinate (of `extent`, for a point that is zero).
fn natural_step<F: Float>(centre: F, values: &[F], extent: F) -> PixelStep {
    let largest = values.iter().map(F::abs).fold(F::zero(), F::larger);
    let largest = if largest.is_zero() {
        extent.abs()
    } else {
        largest
    };
    if !centre.is_zero() || largest.is_zero() || !largest.is_finite() {
        return PixelStep::Ulps(1);
    }
    // An ulp is a power of two.
    let (_, exponent) = crate::arith::decompose(largest.ulp().to_f64());
    PixelStep::PowerOfTwo(exponent as i32)
}
