//! The limits that a scene gives to numbers that kernels divide by, and to quotients: each is known by its value, in
//! whatever order a program computes it.

use super::{Dyadic, Scene};
use crate::arith::{Real, Triple, Vector};

/// The measures of a scene's triangles and rays. In the names of numbers N = (b-a)×(c-a), N_k is its largest coordinate
/// and N_i another one, d_k the largest coordinate of d, e an edge, p and q are vertices, and u stands for all three
/// barycentric coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// |N| at least.
    pub area: Dyadic,
    /// |N·d|/|N| at least, for |d| = 1.
    pub sine: Dyadic,
    /// The longest edge.
    pub longest: Dyadic,
    /// The length of an edge over |N| at most: the reciprocal of a height.
    pub slope: Dyadic,
    /// Every coordinate of a point at most.
    pub world: Dyadic,
    /// |t| at most.
    pub distance: Dyadic,
    /// The scene itself, in numbers that are not rounded.
    pub scene: Scene,
}

/// A limit of the size of a number, and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Limit {
    /// The domain's limit of all divisors, or of all quotients.
    Domain(Dyadic),
    /// The scene's, which knows the number by this name.
    Scene(&'static str, Dyadic),
    /// The largest numerator over the least divisor. It supposes nothing more.
    Own(Dyadic),
}

impl Limit {
    /// The limit itself.
    pub fn size(self) -> Dyadic {
        match self {
            Limit::Domain(size) | Limit::Scene(_, size) | Limit::Own(size) => size,
        }
    }
}

/// A number that a scene knows.
pub struct Known<R> {
    pub name: &'static str,
    pub limit: Dyadic,
    pub value: R,
}

/// The rays that a search looks at.
#[derive(Clone, Copy, PartialEq)]
pub enum Angle {
    /// Those that meet the plane at the scene's least angle or more.
    OfScene,
    /// Those that are parallel to the plane.
    Zero,
}

/// The use of a number in a program.
#[derive(Clone, Copy)]
pub enum Kind {
    Divisor,
    Quotient,
}

/// A triangle and a ray.
#[derive(Debug)]
pub struct Sample<R> {
    pub(super) origin: Triple<R>,
    pub(super) direction: Triple<R>,
    pub(super) vertices: [Triple<R>; 3],
    /// From a to b, from a to c, from b to c.
    pub(super) edges: [Triple<R>; 3],
    /// N = (b-a)×(c-a).
    pub normal: Triple<R>,
    pub(super) ends: [R; 2],
}

impl<R: Real> Sample<R> {
    /// The sample of the seventeen numbers of a case.
    pub fn of(inputs: &[R; 17]) -> Sample<R> {
        let at = |i: usize| Triple::from([0, 1, 2].map(|axis| inputs[i + axis].clone()));
        let [origin, direction, a, b, c] = [0, 3, 6, 9, 12].map(at);
        let edges = [b.minus(&a), c.minus(&a), c.minus(&b)];
        let normal = edges[0].cross(&edges[1]);
        let ends = [inputs[15].clone(), inputs[16].clone()];
        Sample {
            origin,
            direction,
            vertices: [a, b, c],
            edges,
            normal,
            ends,
        }
    }

    /// N·d.
    pub fn volume(&self) -> R {
        self.normal.dot(&self.direction)
    }

    /// The barycentric coordinate of a vertex where the line meets the plane.
    pub fn weight(&self, vertex: usize) -> R {
        let [p, q] = [1, 2].map(|i| self.vertices[(vertex + i) % 3].minus(&self.origin));
        p.cross(&q).dot(&self.direction) / self.volume()
    }

    /// That, or 1 less that.
    pub fn share(&self, vertex: usize, is_rest: bool) -> R {
        let weight = self.weight(vertex);
        if is_rest { R::one() - weight } else { weight }
    }

    /// The ray's t there.
    pub fn time(&self) -> R {
        self.normal.dot(&self.vertices[0].minus(&self.origin)) / self.volume()
    }
}

/// The name of the largest coordinate of N.
pub const LARGEST: &str = "|N_k|";

/// No other coordinate of N is more than this times as large as N_k, which is the largest one of those computed.
const LARGER: f64 = 1.01;

/// Slightly more than √(1 + 1.01²): a vector at right angles to N has no coordinate above this times |N_k|/|N| times its
/// length.
const ROOT: f64 = 1.423;

impl Measures {
    /// True of a triangle and a ray of the scene, and of the size that these measures are about.
    pub(super) fn hold(&self, sample: &Sample<f64>, angle: Angle, epsilon: f64) -> bool {
        let length = sample.normal.dot(&sample.normal).sqrt();
        self.area.to_f64() <= length && self.scene.holds(sample, angle, epsilon)
    }

    /// The numbers that a scene knows, given the axes of N's largest coordinate.
    pub(super) fn known<R: Real>(
        &self,
        kind: Kind,
        sample: &Sample<R>,
        axes: &[usize],
    ) -> Vec<Known<R>> {
        match kind {
            Kind::Divisor => self.divisors(sample, axes),
            Kind::Quotient => self.quotients(sample, axes),
        }
    }

    fn divisors<R: Real>(&self, sample: &Sample<R>, axes: &[usize]) -> Vec<Known<R>> {
        let Measures { area, sine, .. } = *self;
        let normal = &sample.normal;
        let square = normal.dot(normal);
        let volume = sample.volume();
        let length = square.sqrt();
        let known = |name, limit: Dyadic, value| Known {
            name,
            limit: limit.round_down(DIGITS),
            value,
        };
        let largest = area * below(0.573);
        let mut all = vec![
            known("|N·d|", area * sine, volume.clone()),
            known("|N·N|", area * area, square),
            known("|N|", area, length.clone()),
            known("|N·d|/|N|", sine, volume.clone() / length),
        ];
        for k in axes.iter().copied() {
            all.push(known(LARGEST, largest, normal.at(k)));
            all.push(known("|N·d/N_k|", sine, volume.clone() / normal.at(k)));
        }
        all
    }

    fn quotients<R: Real>(&self, sample: &Sample<R>, axes: &[usize]) -> Vec<Known<R>> {
        let Measures {
            slope,
            world,
            distance,
            ..
        } = *self;
        let Sample {
            vertices,
            edges,
            normal,
            ..
        } = sample;
        let [a, b, c] = vertices;
        let known = |name, limit: Dyadic, value| Known {
            name,
            limit: limit.round_up(DIGITS),
            value,
        };
        let square = normal.dot(normal);
        let mut all = vec![known("|t|", distance, sample.time())];
        // Slightly more, for the points next to a vertex.
        for is_rest in [false, true] {
            let share = |i| known("|u|", Dyadic::ABOVE_ONE, sample.share(i, is_rest));
            all.extend([0, 1, 2].map(share));
        }
        for k in axes.iter().copied() {
            let over = |name, limit, value: R| known(name, limit, value / normal.at(k));
            for i in (0..3).filter(|i| *i != k) {
                all.push(over("|N_i/N_k|", above(LARGER), normal.at(i)));
                for edge in edges {
                    all.push(over("|e_i/N_k|", slope * above(ROOT), edge.at(i)));
                }
            }
            all.push(over("|N·a/N_k|", world * above(3.03), a.dot(normal)));
            // p×q = p×(q-p).
            let most = world * slope * above(2.0 * ROOT);
            for (p, q) in [(a, b), (a, c), (b, c)] {
                all.push(over("|(p×q)_k/N_k|", most, p.cross(q).at(k)));
            }
        }
        for i in 0..3 {
            for edge in edges {
                let value = edge.cross(normal).at(i) / &square;
                all.push(known("|(e×N)_i/N·N|", slope, value));
            }
        }
        all
    }
}

/// Binary digits of what a scene says; the corners are computed with them exactly.
const DIGITS: u32 = 10;

pub fn above(x: f64) -> Dyadic {
    Dyadic::from_f64(x).expect("finite").round_up(DIGITS)
}

pub fn below(x: f64) -> Dyadic {
    Dyadic::from_f64(x).expect("finite").round_down(DIGITS)
}
