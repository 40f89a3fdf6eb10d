//! Rays at a mesh, to ask a program about: at random, and at the places where programs err.

use crate::mesh::Triangle;
use crate::ray::Ray;
use hairline_core::Float;
use hairline_core::case::Draw;
use std::error::Error;
use std::fmt;

named! {
    pub names
    /// Where rays are aimed.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum RayKind {
        /// From around the mesh, into its box.
        Random = "random",
        /// At vertices.
        Vertex = "vertex",
        /// At the middles of edges.
        Edge = "edge",
        /// Along an axis, through a vertex or into the box.
        Axis = "axis",
        /// In the plane of a face, as near as floats come to it.
        Plane = "plane",
        /// From one face to another.
        Surface = "surface",
    }
}

/// Why no rays can be aimed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTargets {
    /// There is no triangle of a size.
    NoSize,
    /// Rays around them would have numbers beyond the range of the scalar.
    TooLarge,
}

impl fmt::Display for NoTargets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoTargets::NoSize => "there is no face of a size to aim rays at",
            NoTargets::TooLarge => "the mesh is too large for rays around it",
        })
    }
}

impl Error for NoTargets {}

/// Origins are farther from the middle of the mesh than its box, by at most this factor.
const AROUND: f64 = 3.0;

/// Origins in the plane of a face are up to 17 of its edges away, each of which is at most as long as the box on an axis.
const IN_PLANE: f64 = 34.0;

/// Directions are multiples of this share of the mesh's size, so that few are rounded.
const STEPS: i64 = 64;

/// Triangles that rays are aimed at.
pub struct Targets<F> {
    triangles: Vec<Triangle<F>>,
    /// The middle of their box.
    middle: [f64; 3],
    /// Half of its largest side.
    half: f64,
}

impl<F: Float> Targets<F> {
    /// Targets on some triangles. An error if they have no size, or are too large for rays around them.
    pub fn new(triangles: Vec<Triangle<F>>) -> Result<Targets<F>, NoTargets> {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for vertex in triangles.iter().flatten() {
            for axis in 0..3 {
                low[axis] = low[axis].min(vertex[axis].to_f64());
                high[axis] = high[axis].max(vertex[axis].to_f64());
            }
        }
        let half = [0, 1, 2].map(|axis| high[axis] / 2.0 - low[axis] / 2.0);
        let half = half.into_iter().fold(0.0, f64::max);
        if half == 0.0 || triangles.is_empty() {
            return Err(NoTargets::NoSize);
        }
        let middle = [0, 1, 2].map(|axis| low[axis].midpoint(high[axis]));
        let farthest = middle
            .into_iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        // Room for a direction from the farthest origin to the other side.
        if !F::from_f64(2.0 * (farthest + IN_PLANE * half)).is_finite() {
            return Err(NoTargets::TooLarge);
        }
        Ok(Targets {
            triangles,
            middle,
            half,
        })
    }

    /// So many rays, one of each kind in turn.
    pub fn rays(&self, kinds: &[RayKind], count: u64, seed: u64) -> Vec<Ray<F>> {
        let ray = |index: u64| {
            let kind = kinds[(index % kinds.len() as u64) as usize];
            self.ray(kind, seed, index)
        };
        (0..count).map(ray).collect()
    }

    fn ray(&self, kind: RayKind, seed: u64, index: u64) -> Ray<F> {
        let draw = &mut Draw::new(&format!("rays-{kind}"), seed, index);
        match kind {
            RayKind::Random => {
                let origin = self.point(draw, AROUND);
                let target = self.point(draw, 1.0);
                through(origin, target)
            }
            RayKind::Vertex => {
                let [target, ..] = self.turned(draw);
                self.at(target, draw)
            }
            RayKind::Edge => {
                let [a, b, _] = self.turned(draw);
                self.at(between(a, b, 0.5), draw)
            }
            RayKind::Axis => self.along_an_axis(draw),
            RayKind::Plane => {
                let [a, b, c] = self.turned(draw);
                let [along_b, along_c] = [(); 2].map(|()| (2 * draw.integer(-8, 8) + 1) as f64);
                let origin = between(between(a, b, along_b), between(a, c, along_c), 0.5);
                let target = between(between(a, b, 0.25), c, 0.25);
                through(origin, target)
            }
            RayKind::Surface => {
                let [from, to] = [(); 2].map(|()| {
                    let [a, b, c] = self.face(draw);
                    let [u, v] = [(); 2].map(|()| draw.unit());
                    between(between(a, b, u), c, v)
                });
                through(from, to)
            }
        }
    }

    fn face(&self, draw: &mut Draw) -> [[F; 3]; 3] {
        draw.pick(&self.triangles)
    }

    /// A face that begins with any of its vertices.
    fn turned(&self, draw: &mut Draw) -> [[F; 3]; 3] {
        let mut face = self.face(draw);
        face.rotate_left(draw.below(3));
        face
    }

    /// A point in a cube around the middle of the mesh, so many times as large as its box.
    fn point(&self, draw: &mut Draw, factor: f64) -> [F; 3] {
        self.middle.map(|middle| {
            let offset: f64 = draw.symmetric();
            F::from_f64(middle + factor * self.half * offset)
        })
    }

    /// A ray that has a point at t = 1, exactly where its origin is not rounded: the direction has few digits.
    fn at(&self, target: [F; 3], draw: &mut Draw) -> Ray<F> {
        let step = power_of_two_below(AROUND * self.half / STEPS as f64);
        let direction = [(); 3].map(|()| F::from_f64(step * draw.integer(-STEPS, STEPS) as f64));
        if direction.iter().all(|x| x.is_zero()) {
            return through(self.point(draw, AROUND), target);
        }
        let origin = [0, 1, 2].map(|axis| target[axis] - direction[axis]);
        Ray::new(origin, direction)
    }

    fn along_an_axis(&self, draw: &mut Draw) -> Ray<F> {
        let axis = draw.below(3);
        let is_at_vertex = draw.coin();
        let mut origin = match is_at_vertex {
            true => self.face(draw)[0],
            false => self.point(draw, 1.0),
        };
        let mut direction = [F::zero(); 3];
        let (way, start) = match draw.coin() {
            true => (1.0, -AROUND),
            false => (-1.0, AROUND),
        };
        direction[axis] = F::from_f64(way);
        origin[axis] = F::from_f64(self.middle[axis] + start * self.half);
        Ray::new(origin, direction)
    }
}

/// The ray from one point towards another; along x if they are one.
fn through<F: Float>(origin: [F; 3], target: [F; 3]) -> Ray<F> {
    let mut direction = [0, 1, 2].map(|axis| target[axis] - origin[axis]);
    if direction.iter().all(|x| x.is_zero()) {
        direction[0] = F::from_f64(1.0);
    }
    Ray::new(origin, direction)
}

fn between<F: Float>(from: [F; 3], to: [F; 3], share: f64) -> [F; 3] {
    [0, 1, 2].map(|axis| {
        let [from, to] = [from[axis].to_f64(), to[axis].to_f64()];
        F::from_f64(from + share * (to - from))
    })
}

/// The largest power of two that is not above a size; 0 for a subnormal one.
fn power_of_two_below(size: f64) -> f64 {
    let digits = (1 << 52) - 1;
    f64::from_bits(size.to_bits() & !digits)
}
