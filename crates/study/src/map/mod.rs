//! Floor 4: maps of verdicts. One pixel is one float: what a kernel computes on each, beside what is
//! exactly true, as in Kettner, Mehlhorn, Pion, Schirra and Yap 2008, "Classroom examples of robustness
//! problems in geometric computations", figure 2.
//!
//! ```text
//! Case, Row, Grid ──► of_kernel ──► Map ──► svg, png, counts
//! Case, Row ──► drawing: the triangle, the ray, where they meet and where the kernel says so
//! ```
//!
//! Pictures are returned as text and bytes; the caller writes them.
//!
//! ```
//! use hairline_study::audit::Row;
//! use hairline_study::map::{self, Spot};
//!
//! let row = Row::named("moller-trumbore", None, "own")?;
//! let map = map::standard::<f32>(&row, Spot::Edge, [32, 32])?;
//! assert!(map.wrong() > 0);
//! assert!(map::svg(&[map]).starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod drawing;
mod frame;
mod grid;
mod kernel;
mod panel;
#[cfg(feature = "pictures")]
mod png;
mod scene;
mod sketch;
mod spot;
mod svg;

pub use self::drawing::{drawing, drawing_document};
pub use self::grid::{Axis, Grid, MOST_PIXELS, PixelStep};
pub use self::kernel::{CaseVector, case_at, grid_of_case, of_kernel};
#[cfg(feature = "pictures")]
pub use self::png::png;
pub use self::sketch::sketch;
pub use self::spot::{Spot, standard};
pub use self::svg::{svg, svg_document};

use crate::arith::{Float, ScalarName};
use crate::files::number;
use crate::judge::{Finding, Obligation};
use crate::truth::Truth;
use hairline_core::{Error, ErrorKind};

/// The results at each pixel of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The kernel that was run: `moller-trumbore (source)`.
    pub subject: String,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The measure of what is right: the contract.
    pub measure: String,
    /// To the right, and upwards.
    pub axes: [AxisText; 2],
    /// Row by row, the top row (the highest values of the second axis) first.
    pub pixels: Vec<RayPixel>,
}

/// An axis in words and numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AxisText {
    /// `direction.x`
    pub name: String,
    /// The value in the middle, as text that reads back.
    pub centre: String,
    /// Its bits in hexadecimal.
    pub bits: String,
    /// From pixel to pixel.
    pub step: PixelStep,
    /// The number of pixels.
    pub count: usize,
}

impl AxisText {
    fn of<F: Float>(axis: &Axis<F>, point: &str) -> AxisText {
        AxisText {
            name: format!("{point}.{}", ["x", "y", "z"][axis.coordinate]),
            centre: number::write(axis.centre),
            bits: axis.centre.hex(),
            step: axis.step,
            count: axis.count,
        }
    }
}

/// A kernel on the case of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayPixel {
    /// True if the kernel hits; none if it failed.
    pub hit: Option<bool>,
    /// The exact truth.
    pub truth: Truth,
    /// The contract's demand.
    pub asked: Obligation,
    /// True if the ray meets the boundary exactly, so that the contract demands a hit or leaves it free
    /// only because of what it says of edges and vertices.
    pub on_boundary: bool,
    /// The kind of wrong answer; none if the kernel is right.
    pub finding: Option<Finding>,
}

named! {
    pub names
    /// The look of a pixel, in the order of legends, with its colour as HTML and SVG write it. Right is pale and wrong is
    /// dark, so that wrong pixels are seen without telling colours apart.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Ink {
        /// A hit.
        Yes = "#6fb4e6",
        /// A miss.
        No = "#dcdfe2",
        /// Exactly on the boundary.
        Boundary = "#f0e442",
        /// Nothing is demanded.
        Free = "#fafafa",
        /// A false hit.
        FalseYes = "#c83e00",
        /// A false miss.
        FalseNo = "#4b127a",
        /// A hit with a bad or a wrong value.
        Bad = "#00664b",
        /// No verdict.
        Failed = "#000000",
    }
}

impl Ink {
    /// Red, green, blue.
    pub fn rgb(self) -> [u8; 3] {
        let part = |place| u8::from_str_radix(&self.name()[place..place + 2], 16);
        [1, 3, 5].map(|place| part(place).expect("hexadecimal digits"))
    }
}

/// An error if one exact panel cannot stand for the maps of several kernels: they are of the same inputs, and their contracts
/// ask different things of some of them.
pub fn compared(maps: &[Map]) -> Result<(), Error> {
    let pixels = |map: &Map| 0..map.pixels.len();
    let is_other = |map: &&Map| pixels(map).any(|pixel| map.exact(pixel) != maps[0].exact(pixel));
    match maps.iter().find(is_other) {
        None => Ok(()),
        Some(other) => {
            let line = format!(
                "{} and {} promise different things here, so no one exact picture is of both: judge them by one contract, as \
                 --contract closed-ray",
                maps[0].subject, other.subject
            );
            Err(Error::new(ErrorKind::Unsupported, line))
        }
    }
}

impl Map {
    /// Pixels to the right, and upwards.
    pub fn size(&self) -> [usize; 2] {
        [self.axes[0].count, self.axes[1].count]
    }

    /// The result of the kernel at a pixel, row by row from the top: its answer where
    /// that is right, and the kind of error where it is wrong.
    pub fn computed(&self, pixel: usize) -> Ink {
        self.pixels[pixel].computed()
    }

    /// The exact truth at a pixel.
    pub fn exact(&self, pixel: usize) -> Ink {
        self.pixels[pixel].exact()
    }

    /// How many pixels are wrong.
    pub fn wrong(&self) -> usize {
        self.pixels
            .iter()
            .filter(|pixel| pixel.finding.is_some())
            .count()
    }

    /// The inks of the computed side that occur, what they mean and how many pixels have them.
    pub fn computed_legend(&self) -> Vec<(Ink, &'static str, usize)> {
        let words = |ink| match ink {
            Ink::Yes => "hit",
            Ink::FalseYes => "false hit",
            Ink::FalseNo => "false miss",
            Ink::Bad => "hit with a wrong value",
            Ink::Failed => "failed: no verdict",
            _ => "miss",
        };
        self.legend(words, |pixel| self.computed(pixel))
    }

    /// The same of the exact side.
    pub fn exact_legend(&self) -> Vec<(Ink, &'static str, usize)> {
        let words = |ink| match ink {
            Ink::Yes => "a hit is asked",
            Ink::No => "a miss is asked",
            Ink::Boundary => "exactly on an edge or a vertex",
            _ => "nothing is asked",
        };
        self.legend(words, |pixel| self.exact(pixel))
    }

    fn legend(
        &self,
        words: impl Fn(Ink) -> &'static str,
        ink: impl Fn(usize) -> Ink,
    ) -> Vec<(Ink, &'static str, usize)> {
        let mut counts = [0; Ink::ALL.len()];
        let [width, height] = self.size();
        (0..width * height).for_each(|pixel| counts[ink(pixel) as usize] += 1);
        let counted = Ink::ALL
            .into_iter()
            .zip(counts)
            .filter(|(_, count)| *count > 0);
        counted
            .map(|(ink, count)| (ink, words(ink), count))
            .collect()
    }
}

impl RayPixel {
    fn computed(&self) -> Ink {
        match (self.finding, self.hit) {
            (Some(Finding::FalseHit), _) => Ink::FalseYes,
            (Some(Finding::FalseMiss), _) => Ink::FalseNo,
            (Some(Finding::BadValue | Finding::WrongValue), _) => Ink::Bad,
            (Some(_), _) | (None, None) => Ink::Failed,
            (None, Some(true)) => Ink::Yes,
            (None, Some(false)) => Ink::No,
        }
    }

    fn exact(&self) -> Ink {
        match self.asked {
            _ if self.on_boundary => Ink::Boundary,
            Obligation::MustHit => Ink::Yes,
            Obligation::MustMiss => Ink::No,
            Obligation::Free => Ink::Free,
        }
    }
}
