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
    (
        $($kind:literal: $($name:literal => $is_met:expr),+;)+
        intervals:
        $($interval:literal: $start:ident, $is_finite:literal => $($place:ident),+;)+
        others:
        $($other_kind:literal: $($other:literal => $is_other_met:expr),+;)+
    ) => {
        /// Every aspect, those of a kind together.
        pub const ASPECTS: &[Aspect] = &[
            $($(Aspect { kind: $kind, name: $name, is_met: $is_met },)+)+
            $($(Aspect {
                kind: $interval,
                name: place_name(Place::$place),
                is_met: |s| s.is_on($start, $is_finite, Place::$place),
            },)+)+
            $($(Aspect { kind: $other_kind, name: $other, is_met: $is_other_met },)+)+
        ];
    };
}

aspects! {
    "corner":
        "a" => |s| s.is_corner(0), "b" => |s| s.is_corner(1), "c" => |s| s.is_corner(2);
    "edge":
        "ab" => |s| s.is_edge(2), "bc" => |s| s.is_edge(0), "ca" => |s| s.is_edge(1);
    "side":
        "front" => |s| s.faces(Facing::Front), "back" => |s| s.faces(Facing::Back),
        "neither" => |s| s.crossing().is_none();
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
    intervals:
    "t in [-, inf]": Less, false => Before, AtMin, Within;
    "t in [-, end]": Less, true => Before, AtMin, Within, AtMax, Beyond;
    "t in [0, inf]": Equal, false => Before, AtMin, Within;
    "t in [0, end]": Equal, true => Before, AtMin, Within, AtMax, Beyond;
    "t in [+, inf]": Greater, false => Before, AtMin, Within;
    "t in [+, end]": Greater, true => Before, AtMin, Within, AtMax, Beyond;
    others:
    "from 0":
        "near" => |s| s.offset() < 16.0, "far" => |s| 1000.0 < s.offset();
    "signs":
        "negative" => |s| s.numbers().any(|x| x < 0.0),
        "-0" => |s| s.numbers().any(|x| x == 0.0 && x.is_sign_negative());
}

const fn place_name(place: Place) -> &'static str {
    match place {
        Place::Before => "before",
        Place::AtMin => "at the start",
        Place::Within => "within",
        Place::AtMax => "at the end",
        Place::Beyond => "beyond",
    }
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
        let Case { ray, triangle } = case.widen();
        let Ray {
            origin,
            direction,
            t_min,
            t_max,
        } = ray;
        let [a, b, c] = triangle.vertices();
        let edges = [b - a, c - b, a - c].map(length);
        let edge = edges.into_iter().fold(0.0, f64::max);
        // Near 1, so that products of extreme numbers stay numbers.
        let [ab, ac, start] = [b - a, c - a, a - origin].map(|v| v / edge);
        let unit = direction / length(direction);
        let normal = ab.cross(ac);
        let determinant = unit.dot(normal);
        let t = normal.dot(start) / determinant;
        let u = unit.cross(ac).dot(start) / determinant;
        let v = ab.cross(unit).dot(start) / determinant;
        CaseShape {
            truth: oracle::truth(case),
            weights: [1.0 - u - v, u, v],
            origin,
            direction,
            points: [a, b, c],
            normal,
            edge,
            distance: t.abs(),
            sine: determinant.abs() / length(normal),
            t_min,
            t_max,
        }
    }

    fn crossing(&self) -> Option<&Crossing> {
        self.truth.crossing()
    }

    /// True if the line meets the plane near a corner: its weight is near 1, and the others are near 0.
    fn is_corner(&self, which: usize) -> bool {
        let is_near = |i: usize| {
            let at_corner = if i == which { 1.0 } else { 0.0 };
            (self.weights[i] - at_corner).abs() < NEAR
        };
        self.crossing().is_some() && (0..3).all(is_near)
    }

    /// True if the line meets the plane near the edge across from a corner, and not near another corner.
    fn is_edge(&self, across: usize) -> bool {
        let is_near = |i: usize| {
            let weight = self.weights[i];
            if i == across {
                weight.abs() < NEAR
            } else {
                (NEAR..1.0 - NEAR).contains(&weight)
            }
        };
        self.crossing().is_some() && (0..3).all(is_near)
    }

    fn faces(&self, facing: Facing) -> bool {
        let crossing = self.crossing();
        crossing.is_some_and(|crossing| crossing.facing == facing)
    }

    fn is_at(&self, place: Place) -> bool {
        let crossing = self.crossing();
        crossing.is_some_and(|crossing| crossing.place == place)
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
        let distances = self.points.map(length);
        let nearest = distances.into_iter().fold(f64::INFINITY, f64::min);
        nearest / self.edge
    }
}

/// The share of a family's cases that are like each of [`ASPECTS`], in both scalars together; for a stratum in the scene
/// `room`, on every kind of plane.
pub fn coverage(family: &Family, indices: u64) -> Vec<f64> {
    let mut counts = Counts {
        cases: 0,
        met: vec![0; ASPECTS.len()],
    };
    for parameters in parameters_of(family) {
        counts.add::<f32>(family, &parameters, indices);
        counts.add::<f64>(family, &parameters, indices);
    }
    let share = |met: &u64| *met as f64 / counts.cases as f64;
    counts.met.iter().map(share).collect()
}

/// The parameters with which the cases of a family are looked at.
fn parameters_of(family: &Family) -> Vec<Parameters> {
    let is_stratum = STRATA.iter().any(|stratum| stratum.name == family.name);
    if !is_stratum {
        return vec![Parameters::default()];
    }
    let (room, _) = Scene::parse("room").expect("a preset");
    let mut parameters = Vec::new();
    for scene in room.to_try_kernels("room").of_all_kinds() {
        parameters.push(Parameters {
            scene: Some(scene),
            ..Parameters::default()
        });
    }
    parameters
}

/// How many cases there are, and how many of them are like each of [`ASPECTS`].
struct Counts {
    cases: u64,
    met: Vec<u64>,
}

impl Counts {
    fn add<F: Scalar>(&mut self, family: &Family, parameters: &Parameters, indices: u64) {
        for index in 0..indices {
            let made = family.make::<F>(parameters, 1, index);
            for case in made.cases() {
                let shape = CaseShape::of(case);
                self.cases += 1;
                for (met, aspect) in self.met.iter_mut().zip(ASPECTS) {
                    *met += u64::from((aspect.is_met)(&shape));
                }
            }
        }
    }
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
