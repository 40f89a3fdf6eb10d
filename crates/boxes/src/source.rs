//! Where the cases of a run come from: a family, a scene of a program's own sizes, or the boxes of a mesh.

use crate::case::{BoxCase, each_axis};
use crate::family::{Family, Made};
use crate::tree::Tree;
use hairline_core::Float;
use hairline_core::case::Draw;
use std::fmt;
use std::ops::Range;

/// A source of cases.
#[derive(Clone, Copy)]
pub enum Source {
    /// A family.
    Family(&'static Family),
    /// A scene.
    Scene(Scene),
    /// The boxes of a mesh.
    Mesh(&'static Tree),
}

/// The sizes of a program's boxes: rays start anywhere in the world and are aimed at corners, edges and faces of boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    extent: f64,
    size: f64,
}

/// How often the origin of a ray is drawn again if it is the target.
const TRIES: usize = 8;

impl Scene {
    /// Coordinates lie within `extent`, and boxes are at most `size` long on each axis. An error if that is impossible.
    pub fn new(extent: f64, size: f64) -> Result<Scene, String> {
        let are_numbers = extent.is_finite() && 0.0 < size;
        if !are_numbers || extent < size {
            return Err(format!(
                "a scene of extent {extent:e} has no boxes of size {size:e}: write finite numbers with 0 < size <= extent"
            ));
        }
        Ok(Scene { extent, size })
    }

    fn case<F: Float>(&self, seed: u64, index: u64) -> BoxCase<F> {
        let mut draw = Draw::new("scene of boxes", seed, index);
        let min = within::<F>(&mut draw, self.extent - self.size);
        let mut max = min;
        let mut target = min;
        for i in 0..3 {
            let side = F::from_f64(draw.unit() * self.size);
            max[i] = min[i] + side;
            target[i] = match draw.below(3) {
                0 => min[i],
                1 => max[i],
                _ => min[i] + side * F::from_f64(draw.unit()),
            };
        }
        let length = F::from_f64(0.25 + 3.75 * draw.unit());
        let mut origin = target;
        let mut direction = [F::zero(); 3];
        // Where all coordinates round to 0 no ray has a direction, and the case is invalid.
        for _ in 0..TRIES {
            if direction != [F::zero(); 3] {
                break;
            }
            origin = within::<F>(&mut draw, self.extent);
            direction = each_axis(|i| (target[i] - origin[i]) * length);
        }
        BoxCase::new(origin, direction, [min, max])
    }
}

/// A point whose coordinates are at most this large.
fn within<F: Float>(draw: &mut Draw, most: f64) -> [F; 3] {
    each_axis(|_| {
        let share = 2.0 * draw.unit() - 1.0;
        F::from_f64(share * most)
    })
}

impl Source {
    /// True if the cases of each even index and the next one are two neighbours and one ray.
    pub fn is_of_pairs(&self) -> bool {
        matches!(self, Source::Family(family) if family.is_of_pairs)
    }

    /// Case `index` of a seed's set.
    pub fn case<F: Made>(&self, seed: u64, index: u64) -> BoxCase<F> {
        match self {
            Source::Family(family) => family.case(seed, index),
            Source::Scene(scene) => scene.case(seed, index),
            Source::Mesh(tree) => tree.case(seed, index),
        }
    }

    /// The cases of some indices.
    pub fn cases<F: Made>(&self, seed: u64, indices: Range<u64>) -> Vec<BoxCase<F>> {
        let cases = indices.map(|index| self.case(seed, index));
        cases.collect()
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Source::Family(family) => f.pad(family.name),
            Source::Scene(scene) => write!(f, "extent={:e},size={:e}", scene.extent, scene.size),
            Source::Mesh(tree) => f.pad(&tree.name),
        }
    }
}
