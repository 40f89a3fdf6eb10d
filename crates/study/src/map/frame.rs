//! From which side a case is looked at, and where things then lie: exactly until the last step, so that
//! neither size nor nearness loses digits.

use crate::arith::{Exact, ExactVector, Real, Vector};
use crate::case::{Ray, Triangle};
use crate::judge::square;

/// The direction of view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum View {
    /// Along the triangle's normal, from its front.
    Normal,
    /// Along the ray, at a triangle without area.
    Ray,
    /// Across the ray, which runs along a triangle without area.
    Across,
}

/// Two exact axes at a right angle, of any length, and the unit of length.
pub(super) struct MapFrame {
    /// How it looks at the case.
    pub view: View,
    axes: [ExactVector; 2],
    /// Squares of the axes' lengths.
    squares: [Exact; 2],
    /// The square of the unit: the longest edge; of a triangle that is a point the distance from it to
    /// the ray's line, or 1.
    unit: Exact,
}

/// A vector seen in a frame: its products with the axes.
#[derive(Clone, Debug)]
pub(super) struct Flat([Exact; 2]);

/// A part of a straight line, in units of the frame: `foot + s * way` for s in `[from, to]`. The foot is
/// the line's point nearest to where distances are counted from, so that no digits cancel there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub foot: [f64; 2],
    /// The direction, of length 1.
    pub way: [f64; 2],
    pub from: f64,
    pub to: f64,
}

impl MapFrame {
    /// For finite coordinates and a direction that is not zero.
    pub fn of(ray: &Ray<ExactVector>, triangle: &Triangle<ExactVector>) -> MapFrame {
        let Triangle { a, b, c } = triangle;
        let edges = [b.minus(a), c.minus(b), a.minus(c)];
        let longest = |best: ExactVector, edge: ExactVector| {
            if square(&best).is_less(&square(&edge)) {
                edge
            } else {
                best
            }
        };
        let edge = edges.into_iter().reduce(longest).expect("three edges");
        let normal = b.minus(a).cross(&c.minus(a));
        let d = &ray.direction;
        let offset = ray.origin.minus(a);
        let across = edge.cross(d);
        let (view, axes) = if !is_zero(&normal) {
            (View::Normal, [edge.clone(), normal.cross(&edge)])
        } else if !is_zero(&across) {
            (View::Ray, [d.cross(&across), across])
        } else if !is_zero(&edge) {
            let up = edge.cross(&offset).cross(&edge);
            let up = if is_zero(&up) {
                perpendicular(&edge)
            } else {
                up
            };
            (View::Across, [edge.clone(), up])
        } else {
            let aside = perpendicular(d);
            (View::Ray, [aside.clone(), d.cross(&aside)])
        };
        let squares = axes.each_ref().map(square);
        let mut frame = MapFrame {
            view,
            axes,
            squares,
            unit: Exact::one(),
        };
        let to_line = frame.flat(&offset);
        let unit = if is_zero(&edge) {
            frame.dot(&to_line, &to_line)
        } else {
            square(&edge)
        };
        if !unit.is_zero() {
            frame.unit = unit;
        }
        frame
    }

    /// A vector as it is seen.
    pub fn flat(&self, vector: &ExactVector) -> Flat {
        Flat(self.axes.each_ref().map(|axis| vector.dot(axis)))
    }

    /// The scalar product of what is seen of two vectors.
    pub fn dot(&self, a: &Flat, b: &Flat) -> Exact {
        let [x, y] = [0, 1].map(|i| a.0[i].clone() * &b.0[i] / &self.squares[i]);
        x + y
    }

    /// To the right and upwards, in units; each to some ulps of itself, 0 and infinite where that is no
    /// float.
    pub fn coordinates(&self, flat: &Flat) -> [f64; 2] {
        [0, 1].map(|i| {
            let x = &flat.0[i];
            self.signed_length(x, &(x.clone() * x / &self.squares[i]))
        })
    }

    /// The stretch `base + s * way` for s in `[from, to]` (any s, without an end), `base` counted from the
    /// point of which distances matter; none if the way is seen as a point.
    pub fn stretch(&self, base: &Flat, way: &Flat, ends: [Option<Exact>; 2]) -> Option<Stretch> {
        let length = self.dot(way, way);
        if length.is_zero() {
            return None;
        }
        let nearest = -self.dot(base, way) / &length;
        let foot = base.plus(&way.times(&nearest));
        let [from, to] = ends.map(|end| {
            end.map(|s| {
                let s = s - &nearest;
                self.signed_length(&s, &(s.clone() * &s * &length))
            })
        });
        let [x, y] = way.0.each_ref().map(|x| x.clone() * x);
        let share = |square: Exact, i: usize| {
            let share = (square / &self.squares[i] / &length).approximate_root();
            if way.0[i].is_sign_negative() {
                -share
            } else {
                share
            }
        };
        Some(Stretch {
            foot: self.coordinates(&foot),
            way: [share(x, 0), share(y, 1)],
            from: from.unwrap_or(f64::NEG_INFINITY),
            to: to.unwrap_or(f64::INFINITY),
        })
    }

    /// The length of a vector in space, in units.
    pub fn length(&self, vector: &ExactVector) -> f64 {
        (square(vector) / &self.unit).approximate_root()
    }

    /// The root of a square in units, with the sign of another number.
    fn signed_length(&self, sign: &Exact, square: &Exact) -> f64 {
        let length = (square.clone() / &self.unit).approximate_root();
        if sign.is_sign_negative() {
            -length
        } else {
            length
        }
    }
}

impl Flat {
    pub fn plus(&self, other: &Flat) -> Flat {
        Flat([0, 1].map(|i| self.0[i].clone() + &other.0[i]))
    }

    pub fn times(&self, factor: &Exact) -> Flat {
        Flat(self.0.each_ref().map(|x| x.clone() * factor))
    }
}

impl Stretch {
    /// How far the stretch is from the point that distances are counted from.
    pub fn distance(&self) -> f64 {
        let s = 0f64.clamp(self.from, self.to);
        (0..2)
            .map(|i| self.foot[i] + s * self.way[i])
            .fold(0.0, f64::hypot)
    }
}

fn is_zero(vector: &ExactVector) -> bool {
    (0..3).all(|axis| vector.at(axis).is_zero())
}

/// Some vector at a right angle to one that is not zero.
fn perpendicular(vector: &ExactVector) -> ExactVector {
    let mut axis = [0.0; 3];
    axis[(vector.largest_axis() + 1) % 3] = 1.0;
    let [x, y, z] = axis.map(Exact::from_f64);
    vector.cross(&ExactVector::new(x, y, z))
}
