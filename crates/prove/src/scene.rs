//! A scene in numbers that a person knows, and the domain that it is.

use super::bound::Proven;
use super::dyadic::{Big, root_up};
use super::measures::{Angle, Sample, above, below};
use super::{Domain, Dyadic, Measures};
use crate::arith::{Triple, Vector};
use crate::case::{self, DirectionLength};
use num_traits::Zero;
use std::collections::BTreeMap;

/// The sizes of the triangles and rays of a scene, in one unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// Every coordinate of origins and vertices is at most this.
    pub coordinates: f64,
    /// The shortest and the longest edge.
    pub edge: [f64; 2],
    /// True if that is said of each triangle's longest edge only.
    pub is_of_longest: bool,
    /// From an origin to a vertex at most.
    pub distance: f64,
    /// No angle of a triangle is smaller, in degrees.
    pub min_angle: f64,
    /// No ray of interest meets its triangle's plane at a smaller angle, in degrees.
    pub grazing: f64,
    /// Twice the smallest area, if it is known.
    pub shape: Option<f64>,
}

/// A triangle: the largest coordinate of its edges, and twice its area.
pub type Shape = (f64, f64);

impl Scene {
    /// A scene as samples are drawn from it. An error in one sentence if its directions have any length.
    pub fn of(scene: &case::Scene) -> Proven<Scene> {
        if scene.direction != DirectionLength::Unit {
            return Err("proofs suppose |d| <= 1: write direction=unit".to_owned());
        }
        let [_, farthest] = scene.distance;
        Ok(Scene {
            // Rays start that far from a point of the triangle.
            coordinates: scene.largest() + farthest,
            edge: scene.edge,
            is_of_longest: true,
            distance: farthest + scene.edge[1],
            min_angle: 1.0,
            grazing: 1.0,
            shape: None,
        })
    }

    /// The domain; an error in one sentence if there is none.
    pub fn domain(&self) -> Proven<Domain> {
        let Scene {
            coordinates,
            edge: [shortest, longest],
            distance,
            min_angle,
            grazing,
            ..
        } = *self;
        let lengths = [
            ("coordinates", coordinates),
            ("shortest edge", shortest),
            ("longest edge", longest),
            ("distance", distance),
        ];
        if let Some((name, value)) = lengths.iter().find(|(_, x)| !(x.is_finite() && *x > 0.0)) {
            return Err(format!("{name}: expected a positive number, found {value}"));
        }
        if let Some((name, value)) = lengths.iter().find(|(_, x)| !(1e-30..=1e30).contains(x)) {
            return Err(format!(
                "{name}: expected a length from 1e-30 to 1e30, found {value:e}"
            ));
        }
        if shortest > longest {
            return Err(format!(
                "the shortest edge, {shortest}, is longer than the longest, {longest}"
            ));
        }
        if longest > 3.5 * coordinates {
            return Err(format!(
                "an edge of {longest} does not fit into coordinates up to {coordinates}"
            ));
        }
        // Some vertex is as far from the origin as half an edge.
        if distance < longest / 2.0 {
            return Err(format!(
                "no origin is within {distance} of all vertices of a triangle with an edge of {longest}"
            ));
        }
        let angles = [
            ("smallest angle", min_angle, 60.0),
            ("grazing angle", grazing, 90.0),
        ];
        let outside = |(_, x, most): &&(&str, f64, f64)| !(*x > 0.0 && x <= most);
        if let Some((name, value, most)) = angles.iter().find(outside) {
            return Err(format!(
                "{name}: expected above 0 and at most {most} degrees, found {value}"
            ));
        }
        Ok(self.domain_of(longest, longest))
    }

    /// The domain of triangles with such edges: the largest coordinate, and the length.
    fn domain_of(&self, size: f64, longest: f64) -> Domain {
        let Scene {
            coordinates,
            edge: [shortest, _],
            distance,
            min_angle,
            grazing,
            ..
        } = *self;
        // Slightly more, for what rounding took from the numbers themselves.
        let up = |x: f64| above(x * (1.0 + 1e-9));
        // A difference of coordinates is at most twice the largest of them.
        let reach = distance.min(2.0 * coordinates);
        // Divisors are det = N·d, N·N, |N|, the largest coordinate of N, and N·d over it or over |N|.
        let shape = self.least_shape();
        let divisors = [
            shape * sine(grazing),
            shape * shape,
            shape * 0.577,
            sine(grazing),
        ];
        let floor = divisors.into_iter().fold(f64::INFINITY, f64::min);
        // Edges over twice the area. An edge of length 1 has a height above it of at least tan(α)/2.
        let slope = if self.is_of_longest {
            2.0 / (shortest * tangent(min_angle))
        } else {
            1.0 / (shortest * sine(min_angle))
        };
        let slope = slope.min(longest / shape);
        let down = |x: f64| below(x * 0.999_999);
        let measures = Measures {
            area: down(shape),
            sine: down(sine(grazing)),
            longest: up(longest),
            slope: up(slope),
            world: up(coordinates),
            distance: up(distance),
            scene: *self,
        };
        Domain {
            edge: up(size),
            reach: up(reach),
            world: up(coordinates),
            direction: Dyadic::ONE,
            extent: up(distance),
            direction_floor: Dyadic::HALF,
            floor: down(floor),
            quotient: up(distance.max(1.0)),
            below: up(distance.max(1.0)),
            measures: Some(measures),
        }
    }

    /// The domains of its triangles of about one size each, of which these are the shapes.
    pub fn parts(&self, shapes: &[Shape]) -> Vec<Domain> {
        let mut sizes: BTreeMap<i32, Shape> = BTreeMap::new();
        for (size, shape) in shapes.iter().filter(|(_, shape)| shape.is_finite()) {
            let (largest, least) = sizes
                .entry((2.0 * size.log2()).ceil() as i32)
                .or_insert((*size, *shape));
            *largest = largest.max(*size);
            *least = least.min(*shape);
        }
        let part = |(size, least): &Shape| {
            // A mesh's sizes are coordinates: an edge is no longer than √3 times the largest.
            let factor = if self.shape.is_some() { 1.733 } else { 1.0 };
            let longest = (factor * size).min(self.edge[1]);
            Scene {
                shape: Some(*least),
                ..*self
            }
            .domain_of(*size, longest)
        };
        sizes.values().map(part).collect()
    }

    /// Twice the area of a triangle, to a millionth of it. Zero only if it has none.
    pub fn twice_area(vertices: &[[f64; 3]; 3]) -> f64 {
        let [a, b, c] = vertices.map(glam::DVec3::from);
        let u = b - a;
        let v = c - a;
        // Each of three coordinates is two products of differences: six roundings.
        let error = 6.0 * f64::EPSILON * u.abs().max_element() * v.abs().max_element();
        let area = u.cross(v).length();
        if 1e6 * error < area && area.is_normal() {
            return area;
        }
        let exact = |x: f64| Dyadic::from_f64(x).map_or_else(Big::zero, Big::from);
        let [a, b, c] = vertices.map(|vertex| vertex.map(exact));
        let minor = |i: usize, j: usize| {
            (&b[i] - &a[i]) * (&c[j] - &a[j]) - (&b[j] - &a[j]) * (&c[i] - &a[i])
        };
        let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
        let square: Big = normal.iter().map(|x| x * x).sum();
        root_up(&square, 53).to_f64()
    }

    /// True of a triangle and a ray as the words of the scene have them. Lengths and angles of floats are what they are to a
    /// few epsilons of their scalar: no direction of floats is exactly 1 long.
    pub(super) fn holds(&self, sample: &Sample<f64>, angle: Angle, epsilon: f64) -> bool {
        let Sample {
            origin,
            direction,
            vertices,
            edges,
            normal,
            ..
        } = sample;
        let slack = 4.0 * epsilon;
        for point in vertices.iter().chain([origin]) {
            if (0..3).any(|axis| self.coordinates < point.at(axis).abs()) {
                return false;
            }
        }
        let distances = vertices.iter().map(|vertex| length(&vertex.minus(origin)));
        if distances.fold(0.0, f64::max) > self.distance * (1.0 + slack) {
            return false;
        }
        let lengths = edges.each_ref().map(length);
        let longest = lengths.into_iter().fold(0.0, f64::max);
        let shortest = lengths.into_iter().fold(longest, f64::min);
        let least = if self.is_of_longest {
            longest
        } else {
            shortest
        };
        if least < self.edge[0] * (1.0 - slack) || self.edge[1] * (1.0 + slack) < longest {
            return false;
        }
        let area = length(normal);
        let [ab, ac, bc] = edges;
        // |N| over the product is the tangent of the angle; an obtuse angle is not the smallest.
        let products = [ab.dot(ac), -ab.dot(bc), ac.dot(bc)];
        let tangent = tangent(self.min_angle) * (1.0 - slack);
        if products.into_iter().any(|product| area < tangent * product) {
            return false;
        }
        let speed = length(direction);
        if (speed - 1.0).abs() > slack {
            return false;
        }
        let least = sine(self.grazing) * (1.0 - slack) * area * speed;
        angle == Angle::Zero || least <= normal.dot(direction).abs()
    }

    /// Twice the smallest area, or slightly less.
    pub fn least_shape(&self) -> f64 {
        // The longest edge, and the smallest angle at both of its ends. Or the shortest edge twice, and the smallest
        // angle twice; or an equilateral triangle.
        let of_one = if self.is_of_longest {
            tangent(self.min_angle) / 2.0
        } else {
            sine((2.0 * self.min_angle).min(60.0))
        };
        let of_angles = self.edge[0] * self.edge[0] * of_one;
        self.shape.map_or(of_angles, |shape| shape * 0.999_999)
    }

    /// The sizes of triangles, in steps: the longest edge, and the least that twice the area is from the step
    /// before on. A triangle whose longest edge is l has another of at least l/2 at an angle of at least the smallest.
    pub fn shapes(&self) -> Vec<Shape> {
        let [shortest, longest] = self.edge;
        let mut shapes = Vec::new();
        let mut size = shortest;
        while size < longest || shapes.is_empty() {
            let next = (size * std::f64::consts::SQRT_2).min(longest).max(size);
            let least = (size * size / 2.0 * sine(self.min_angle)).max(self.least_shape());
            shapes.push((next, least));
            if next <= size {
                break;
            }
            size = next;
        }
        shapes
    }
}

fn length(v: &Triple<f64>) -> f64 {
    v.dot(v).sqrt()
}

/// The tangent of an angle in degrees, or slightly less.
fn tangent(degrees: f64) -> f64 {
    libm::tan(degrees.to_radians()) * 0.999_999_999
}

/// The sine of an angle in degrees, or slightly less.
fn sine(degrees: f64) -> f64 {
    libm::sin(degrees.to_radians()) * 0.999_999_999
}
