//! Classes of truths: what reports count by.

use crate::truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::sync::LazyLock;

/// All of a truth that an obligation depends on: its class, and either the sign of t with whether it is
/// at an end of the interval, or what a line in the plane meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TruthKind(u8);

impl TruthKind {
    /// Numbers of kinds are below this.
    pub const COUNT: usize = Class::COUNT * 8;

    /// The kind of a truth.
    pub fn of(truth: &Truth) -> TruthKind {
        let digits = match truth {
            Truth::Transversal(Crossing { place, t_sign, .. }) => [
                matches!(place, Place::AtMin | Place::AtMax),
                matches!(t_sign, Ordering::Less),
                matches!(t_sign, Ordering::Equal),
            ],
            Truth::Coplanar(Contact {
                kind,
                meets_ray,
                meets_line,
            })
            | Truth::Degenerate(Contact {
                kind,
                meets_ray,
                meets_line,
            }) => [matches!(kind, ContactKind::None), *meets_ray, *meets_line],
            Truth::Parallel | Truth::Invalid => [false; 3],
        };
        let shifted = |number, digit| 2 * number + u8::from(digit);
        TruthKind(digits.into_iter().fold(Class::of(truth).0, shifted))
    }

    /// Its class.
    pub fn class(self) -> Class {
        Class(self.0 >> 3)
    }

    /// The side that the ray crosses the plane from; none if it does not.
    pub fn facing(self) -> Option<Facing> {
        let class = self.class();
        let side = if class.is_back() {
            Facing::Back
        } else {
            Facing::Front
        };
        class.crosses().then_some(side)
    }

    /// A number below [`TruthKind::COUNT`].
    #[inline]
    pub fn number(self) -> usize {
        usize::from(self.0)
    }
}

/// A coarse class of truths: what reports count by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "u8", try_from = "u8")]
pub struct Class(u8);

const PARTS: [&str; 4] = ["interior", "edge", "vertex", "outside"];
const SIDES: [&str; 2] = ["front", "back"];
const PLACES: [&str; 3] = ["within", "before", "beyond"];
const FLAT: [&str; 4] = ["parallel", "coplanar", "degenerate", "invalid"];

/// The number of the first class whose line does not cross the plane at one point.
const FIRST_FLAT: usize = PARTS.len() * SIDES.len() * PLACES.len();

impl Class {
    /// The number of classes.
    pub const COUNT: usize = FIRST_FLAT + FLAT.len();

    /// The class of a truth.
    pub fn of(truth: &Truth) -> Class {
        let number = match truth {
            Truth::Transversal(Crossing {
                facing,
                place,
                feature,
                ..
            }) => {
                let part = match feature {
                    Feature::Interior => 0,
                    feature if feature.is_edge() => 1,
                    feature if feature.is_vertex() => 2,
                    _ => 3,
                };
                let side = usize::from(*facing == Facing::Back);
                let place = match place {
                    Place::AtMin | Place::Within | Place::AtMax => 0,
                    Place::Before => 1,
                    Place::Beyond => 2,
                };
                (part * SIDES.len() + side) * PLACES.len() + place
            }
            Truth::Parallel => FIRST_FLAT,
            Truth::Coplanar(_) => FIRST_FLAT + 1,
            Truth::Degenerate(_) => FIRST_FLAT + 2,
            Truth::Invalid => FIRST_FLAT + 3,
        };
        Class(number as u8)
    }

    /// All classes, in the order of reports.
    pub fn all() -> impl Iterator<Item = Class> {
        (0..Class::COUNT).map(|number| Class(number as u8))
    }

    /// A number below [`Class::COUNT`].
    pub fn number(self) -> usize {
        usize::from(self.0)
    }

    /// True if the line crosses the plane at one point.
    pub fn crosses(self) -> bool {
        self.number() < FIRST_FLAT
    }

    /// Where the line meets the triangle, or the kind of situation: `edge`, `coplanar`.
    pub fn part(self) -> &'static str {
        match self.crosses() {
            true => PARTS[self.number() / PLACES.len() / SIDES.len()],
            false => FLAT[self.number() - FIRST_FLAT],
        }
    }

    fn side(self) -> usize {
        self.number() / PLACES.len() % SIDES.len()
    }

    fn place(self) -> usize {
        self.number() % PLACES.len()
    }

    /// The class of input that has no meaning.
    pub const INVALID: Class = Class(Class::COUNT as u8 - 1);

    /// True if the input has no meaning: no value of a hit is judged then.
    pub fn is_invalid(self) -> bool {
        self == Class::INVALID
    }

    /// True if the line crosses the plane beside the triangle.
    pub fn is_outside(self) -> bool {
        self.part() == "outside"
    }

    /// True if the triangle has no area.
    pub fn is_degenerate(self) -> bool {
        self.part() == "degenerate"
    }

    /// True if the line is parallel to the plane, or the triangle has no area.
    pub fn is_flat(self) -> bool {
        matches!(self.part(), "parallel" | "coplanar" | "degenerate")
    }

    /// True if the line crosses the plane from behind.
    pub fn is_back(self) -> bool {
        self.crosses() && self.side() == 1
    }

    /// True if the line crosses the plane before or beyond the interval.
    pub fn is_off_the_interval(self) -> bool {
        self.crosses() && self.place() != 0
    }

    /// The name in records: `edge/front/within`, `coplanar`.
    pub fn name(self) -> &'static str {
        static NAMES: LazyLock<Vec<String>> =
            LazyLock::new(|| Class::all().map(Class::spelled).collect());
        &NAMES[self.number()]
    }

    fn spelled(self) -> String {
        if !self.crosses() {
            return self.part().to_owned();
        }
        let (side, place) = (SIDES[self.side()], PLACES[self.place()]);
        format!("{}/{side}/{place}", self.part())
    }
}

impl From<Class> for u8 {
    fn from(class: Class) -> u8 {
        class.0
    }
}

impl TryFrom<u8> for Class {
    type Error = String;

    fn try_from(number: u8) -> Result<Class, String> {
        let known = usize::from(number) < Class::COUNT;
        if known {
            Ok(Class(number))
        } else {
            Err(format!("no class of number {number}"))
        }
    }
}
