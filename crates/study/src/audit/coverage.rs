//! The kinds of cases in each family: which corner, which side, which plane they try. A kernel is never tried on a kind
//! that has no case.

use crate::arith::Float;
use crate::case::{Case, Parameters, Ray, Scene};
use crate::family::{Family, STRATA};
use crate::kernel::Scalar;
use crate::oracle;
use crate::truth::{Crossing, Facing, Place, Truth};
use glam::DVec3;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// One thing that a case may be like, among others of its kind.
pub struct Aspect {
    /// The kind: `corner`, `plane`, ….
    pub kind: &'static str,
    /// The name of the kind: `a`, `along an axis`.
    pub name: &'static str,
    is_met: fn(&CaseShape) -> bool,
}

/// The data of a case that tell its kinds: the triangle, the ray and the exact truth, in numbers near enough for that.
struct CaseShape {
    truth: Truth,
    /// Weights of a, b and c where the line meets the plane; NaN where it does not.
    weights: [f64; 3],
    origin: DVec3,
    direction: DVec3,
    points: [DVec3; 3],
    normal: DVec3,
    /// The longest edge, and the distance from the origin to the hit in longest edges.
    edge: f64,
    distance: f64,
    sine: f64,
    t_min: f64,
    t_max: f64,
}

/// A weight that counts as 0: as near to an edge as that many longest edges.
const NEAR: f64 = 1.0 / 1024.0;

macro_rules! aspects {
    ($($kind:literal: $($name:literal => $is_met:expr),+;)+) => {
        /// Every aspect, those of a kind together.
        pub const ASPECTS: &[Aspect] = &[$($(Aspect { kind: $kind, name: $name, is_met: $is_met },)+)+];
    };
}

aspects! {
    "corner":
        "a" => |s| s.is_corner(0), "b" => |s| s.is_corner(1), "c" => |s| s.is_corner(2);
    "edge":
        "ab" => |s| s.is_edge(2), "bc" => |s| s.is_edge(0), "ca" => |s| s.is_edge(1);
    "side":
        "front" => |s| s.faces(Facing::Front), "back" => |s| s.faces(Facing::Back),
        "neither" => |s| s.truth.crossing().is_none();
    "plane":
        "generic" => |s| zeros(s.normal) == 0 && s.has_area(),
        "holds an axis" => |s| zeros(s.normal) == 1,
        "axis plane" => |s| zeros(s.normal) == 2,
        "at 0" => |s| (0..3).any(|i| s.points.iter().all(|p| p[i] == 0.0));
    "ray":
        "generic" => |s| zeros(s.direction) == 0,
        "in an axis plane" => |s| zeros(s.direction) == 1,
        "along an axis" => |s| zeros(s.direction) == 2;
    "sine":
        "< 2^-10" => |s| s.sine < NEAR, "to 0.1" => |s| (NEAR..0.1).contains(&s.sine), "> 0.1" => |s| 0.1 < s.sine;
    "edge length":
        "< 2^-20" => |s| s.edge < POWER.recip(), "ordinary" => |s| (POWER.recip()..POWER).contains(&s.edge),
        "> 2^20" => |s| POWER <= s.edge;
    "way":
        "0" => |s| s.distance == 0.0, "< 1 edge" => |s| 0.0 < s.distance && s.distance < 1.0,
        "1 to 1000" => |s| (1.0..1000.0).contains(&s.distance), "> 1000" => |s| 1000.0 <= s.distance;
    "t":
        "before" => |s| s.is_at(Place::Before), "at the start" => |s| s.is_at(Place::AtMin),
        "within" => |s| s.is_at(Place::Within), "at the end" => |s| s.is_at(Place::AtMax),
        "beyond" => |s| s.is_at(Place::Beyond);
    "t in [-, inf]":
        "before" => |s| s.is_on(Less, false, Place::Before),
        "at the start" => |s| s.is_on(Less, false, Place::AtMin),
        "within" => |s| s.is_on(Less, false, Place::Within);
    "t in [-, end]":
        "before" => |s| s.is_on(Less, true, Place::Before),
        "at the start" => |s| s.is_on(Less, true, Place::AtMin),
        "within" => |s| s.is_on(Less, true, Place::Within),
        "at the end" => |s| s.is_on(Less, true, Place::AtMax),
        "beyond" => |s| s.is_on(Less, true, Place::Beyond);
    "t in [0, inf]":
        "before" => |s| s.is_on(Equal, false, Place::Before),
        "at the start" => |s| s.is_on(Equal, false, Place::AtMin),
        "within" => |s| s.is_on(Equal, false, Place::Within);
    "t in [0, end]":
        "before" => |s| s.is_on(Equal, true, Place::Before),
        "at the start" => |s| s.is_on(Equal, true, Place::AtMin),
        "within" => |s| s.is_on(Equal, true, Place::Within),
        "at the end" => |s| s.is_on(Equal, true, Place::AtMax),
        "beyond" => |s| s.is_on(Equal, true, Place::Beyond);
    "t in [+, inf]":
        "before" => |s| s.is_on(Greater, false, Place::Before),
        "at the start" => |s| s.is_on(Greater, false, Place::AtMin),
        "within" => |s| s.is_on(Greater, false, Place::Within);
    "t in [+, end]":
        "before" => |s| s.is_on(Greater, true, Place::Before),
        "at the start" => |s| s.is_on(Greater, true, Place::AtMin),
        "within" => |s| s.is_on(Greater, true, Place::Within),
        "at the end" => |s| s.is_on(Greater, true, Place::AtMax),
        "beyond" => |s| s.is_on(Greater, true, Place::Beyond);
    "from 0":
        "near" => |s| s.offset() < 16.0, "far" => |s| 1000.0 < s.offset();
    "signs":
        "negative" => |s| s.numbers().any(|x| x < 0.0),
        "-0" => |s| s.numbers().any(|x| x == 0.0 && x.is_sign_negative());
}

/// 2^20.
const POWER: f64 = 1_048_576.0;

fn zeros(v: DVec3) -> usize {
    if v == DVec3::ZERO {
        0
    } else {
        v.to_array().iter().filter(|x| **x == 0.0).count()
    }
}

/// The length, also where its square is beyond the range.
fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 {
        0.0
    } else {
        largest * (v / largest).length()
    }
}

impl CaseShape {
    fn of<F: Float>(case: &Case<F>) -> CaseShape {
        let Case {
            ray:
                Ray {
                    origin,
                    direction,
                    t_min,
                    t_max,
                },
            triangle,
        } = case.widen();
        let [a, b, c] = triangle.vertices();
        let edge = [b - a, c - b, a - c]
            .map(length)
            .into_iter()
            .fold(0.0, f64::max);
        // Near 1, so that products of extreme numbers stay numbers.
        let [ab, ac, start] = [b - a, c - a, a - origin].map(|v| v / edge);
        let unit = direction / length(direction);
        let normal = ab.cross(ac);
        let determinant = unit.dot(normal);
        let of = |row: DVec3| row.dot(start) / determinant;
        let (u, v) = (of(unit.cross(ac)), of(ab.cross(unit)));
        CaseShape {
            truth: oracle::truth(case),
            weights: [1.0 - u - v, u, v],
            origin,
            direction,
            points: [a, b, c],
            normal,
            edge,
            distance: of(normal).abs(),
            sine: determinant.abs() / length(normal),
            t_min,
            t_max,
        }
    }

    fn crossing(&self) -> Option<&Crossing> {
        self.truth.crossing()
    }

    fn is_corner(&self, which: usize) -> bool {
        self.crossing().is_some() && (self.weights[which] - 1.0).abs() < NEAR && {
            (0..3).all(|i| i == which || self.weights[i].abs() < NEAR)
        }
    }

    /// Near the edge across from a corner, and not near another corner.
    fn is_edge(&self, across: usize) -> bool {
        let inside = |i: usize| (NEAR..1.0 - NEAR).contains(&self.weights[i]);
        let others = (0..3).filter(|i| *i != across);
        self.crossing().is_some() && self.weights[across].abs() < NEAR && others.clone().all(inside)
    }

    fn faces(&self, facing: Facing) -> bool {
        self.crossing()
            .is_some_and(|crossing| crossing.facing == facing)
    }

    fn is_at(&self, place: Place) -> bool {
        self.crossing()
            .is_some_and(|crossing| crossing.place == place)
    }

    /// True if t lies there against an interval whose start has a sign, and whose end is finite or not.
    fn is_on(&self, sign_of_start: Ordering, is_finite: bool, place: Place) -> bool {
        self.t_min.partial_cmp(&0.0) == Some(sign_of_start)
            && self.t_max.is_finite() == is_finite
            && self.is_at(place)
    }

    fn has_area(&self) -> bool {
        !matches!(self.truth, Truth::Degenerate(_) | Truth::Invalid)
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let vectors = [self.origin, self.direction].into_iter().chain(self.points);
        vectors.flat_map(|v| v.to_array())
    }

    /// How far the triangle lies from 0, in longest edges.
    fn offset(&self) -> f64 {
        self.points
            .map(length)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
            / self.edge
    }
}

/// The share of a family's cases that are like each of [`ASPECTS`], in both scalars together; of a stratum in the scene
/// `room`, on every kind of plane.
pub fn coverage(family: &Family, indices: u64) -> Vec<f64> {
    let is_stratum = STRATA.iter().any(|stratum| stratum.name == family.name);
    let scenes = match is_stratum {
        false => vec![Parameters::default()],
        true => {
            let (room, _) = Scene::parse("room").expect("a preset");
            let in_scene = |scene| Parameters {
                scene: Some(scene),
                ..Parameters::default()
            };
            room.to_try_kernels("room")
                .of_all_kinds()
                .into_iter()
                .map(in_scene)
                .collect()
        }
    };
    let (mut counts, mut cases) = (vec![0u64; ASPECTS.len()], 0);
    for parameters in &scenes {
        cases += add::<f32>(family, parameters, indices, &mut counts)
            + add::<f64>(family, parameters, indices, &mut counts);
    }
    counts
        .into_iter()
        .map(|count| count as f64 / cases as f64)
        .collect()
}

fn add<F: Scalar>(
    family: &Family,
    parameters: &Parameters,
    indices: u64,
    counts: &mut [u64],
) -> u64 {
    let made = (0..indices).map(|index| family.make::<F>(parameters, 1, index));
    let mut cases = 0;
    for case in made.flat_map(|made| made.cases().to_vec()) {
        let shape = CaseShape::of(&case);
        cases += 1;
        for (count, cell) in counts.iter_mut().zip(ASPECTS) {
            *count += u64::from((cell.is_met)(&shape));
        }
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::FAMILIES;

    #[test]
    fn every_aspect_is_met_by_some_family_and_no_family_prefers_a_corner_or_an_edge() {
        let rows: Vec<(&str, Vec<f64>)> = FAMILIES
            .iter()
            .chain(STRATA)
            .map(|family| (family.name, coverage(family, 400)))
            .collect();
        for (i, aspect) in ASPECTS.iter().enumerate() {
            let most = rows.iter().map(|(_, shares)| shares[i]).fold(0.0, f64::max);
            let least = if aspect.kind.starts_with("t in") {
                0.01
            } else {
                0.05
            };
            assert!(least < most, "{} {}: {most}", aspect.kind, aspect.name);
        }
        for (name, shares) in &rows {
            for kind in ["corner", "edge"] {
                let of = ASPECTS
                    .iter()
                    .zip(shares)
                    .filter(|(aspect, _)| aspect.kind == kind);
                let of: Vec<f64> = of.map(|(_, share)| *share).collect();
                let all: f64 = of.iter().sum();
                let least = of.iter().fold(1.0, |least: f64, share| least.min(*share));
                // Of few cases chance decides; a polygon's triangles are the fan of its first vertex.
                assert!(
                    all < 0.1 || *name == "polygon" || all / 5.0 < least,
                    "{name} {kind}: {of:?}"
                );
            }
        }
    }

    #[test]
    fn aspects_are_those_of_the_case() {
        let case = Case::<f64>::new(
            [0.25, -0.0, 2.0],
            [0.0, 0.0, -1.0],
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        );
        let shape = CaseShape::of(&case);
        let met: Vec<&str> = ASPECTS
            .iter()
            .filter(|aspect| (aspect.is_met)(&shape))
            .map(|a| a.name)
            .collect();
        let expected = [
            "ab",
            "front",
            "axis plane",
            "at 0",
            "along an axis",
            "> 0.1",
            "ordinary",
            "1 to 1000",
            "within",
            "within",
            "near",
            "negative",
            "-0",
        ];
        assert_eq!(met, expected);
    }
}
