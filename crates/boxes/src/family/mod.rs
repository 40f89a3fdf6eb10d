//! Where cases come from: families, each with a promise that the truth keeps in the tests.
//!
//! Case i depends on the family, its version, the seed and i alone. Generators use integers and IEEE + - × ÷ only. To add
//! a family: write its function, and give it a row in [`FAMILIES`].

mod aimed;
mod lattice;

use crate::case::BoxCase;
use crate::truth::{Class, Meeting, Origin, Overlap, Truth};
use hairline_core::Float;
use hairline_core::case::{CaseId, Draw, Parameters};

/// A row of the table of families.
pub struct Family {
    /// The name on the command line and in case ids.
    pub name: &'static str,
    /// Part of the case ids; raised whenever the cases change.
    pub version: u32,
    /// About the truth of its cases, in one line.
    pub promise: &'static str,
    /// True if the cases of each even index and the next one are two neighbours and one ray.
    pub is_of_pairs: bool,
    keeps: fn(&Truth) -> bool,
    f32: Make<f32>,
    f64: Make<f64>,
}

/// Makes a case from a stream, or the second of two.
type Make<F> = fn(&mut Draw, bool) -> BoxCase<F>;

/// A scalar that families make cases in.
pub trait Made: Float {
    /// The function with which a family makes cases.
    fn made(family: &Family) -> Make<Self>;
}

impl Made for f32 {
    fn made(family: &Family) -> Make<f32> {
        family.f32
    }
}

impl Made for f64 {
    fn made(family: &Family) -> Make<f64> {
        family.f64
    }
}

impl Family {
    /// Case `index` of a seed's set.
    pub fn case<F: Made>(&self, seed: u64, index: u64) -> BoxCase<F> {
        let is_second = self.is_of_pairs && index % 2 == 1;
        // Both of a pair have one stream.
        let stream = index - u64::from(is_second);
        F::made(self)(&mut Draw::new(self.name, seed, stream), is_second)
    }

    /// The name of a case, from which it is made again.
    pub fn id<F: Made>(&self, seed: u64, index: u64) -> CaseId {
        CaseId {
            family: self.name.to_owned(),
            version: self.version,
            scalar: F::NAME,
            parameters: Parameters::default(),
            seed,
            index,
            triangle: None,
        }
    }

    /// True if a truth is as the family promises.
    pub fn keeps(&self, truth: &Truth) -> bool {
        (self.keeps)(truth)
    }
}

/// The case of an id; an error says what is wrong with the id.
pub fn case_of<F: Made>(id: &CaseId) -> Result<BoxCase<F>, String> {
    let family = find_family(&id.family)?;
    if family.version != id.version {
        let (name, version) = (family.name, family.version);
        return Err(format!(
            "family '{name}' is at version {version}, not {}",
            id.version
        ));
    }
    if id.scalar != F::NAME {
        return Err(format!("the case is of {}, not of {}", id.scalar, F::NAME));
    }
    if id.parameters != Parameters::default() || id.triangle.is_some() {
        return Err("families of boxes take no parameters, and have no triangles".to_owned());
    }
    Ok(family.case(id.seed, id.index))
}

/// The family of a name.
pub fn find_family(name: &str) -> Result<&'static Family, String> {
    let mut families = FAMILIES.iter();
    let found = families.find(|family| family.name == name);
    found.ok_or_else(|| {
        let names = FAMILIES.iter().map(|family| family.name);
        let names: Vec<&str> = names.collect();
        format!("unknown family '{name}'; there are {}", names.join(", "))
    })
}

/// A row, from a name, a function that makes a case, a promise, and a function that says if a truth keeps it.
macro_rules! family {
    ($name:literal, lattice::$make:ident, $promise:literal, $keeps:expr) => {
        family!(
            $name,
            (|draw: &mut Draw| lattice::$make(draw).placed(draw)),
            $promise,
            $keeps
        )
    };
    ($name:literal, $make:expr, $promise:literal, $keeps:expr) => {
        Family {
            name: $name,
            version: 1,
            promise: $promise,
            is_of_pairs: false,
            keeps: $keeps,
            f32: |draw, _| $make(draw),
            f64: |draw, _| $make(draw),
        }
    };
}

/// Every family, in the order of reports.
pub static FAMILIES: &[Family] = &[
    family!(
        "interior",
        aimed::interior,
        "through the interior, ahead or behind",
        |truth| { has_class(truth, Class::Interior) }
    ),
    family!(
        "outside",
        aimed::outside,
        "the line passes outside",
        |truth| { *truth == Truth::Outside }
    ),
    family!(
        "corner",
        lattice::corner,
        "touches a corner and nothing else, ahead",
        |truth| { has_class(truth, Class::Corner) && is_ahead(truth) }
    ),
    family!(
        "corner-near",
        aimed::corner_near,
        "aimed at a corner and rounded",
        is_valid
    ),
    family!(
        "edge",
        lattice::edge,
        "touches an edge and nothing else, ahead",
        |truth| { has_class(truth, Class::Edge) && is_ahead(truth) }
    ),
    family!(
        "edge-near",
        aimed::edge_near,
        "aimed at an edge and rounded",
        is_valid
    ),
    family!(
        "in-face",
        lattice::in_face,
        "runs in the plane of a face or along an edge",
        |truth| { has_class(truth, Class::Along) }
    ),
    family!(
        "axis-inside",
        lattice::axis_inside,
        "through the interior, parallel to a face",
        |truth| { has_class(truth, Class::Interior) }
    ),
    family!(
        "axis-outside",
        lattice::axis_outside,
        "beside the box, parallel to a face",
        |truth| { *truth == Truth::Outside }
    ),
    family!(
        "origin-inside",
        lattice::origin_inside,
        "the origin is in the interior",
        |truth| { has_origin(truth, Origin::Inside) }
    ),
    family!(
        "origin-on",
        lattice::origin_on,
        "the origin is on the boundary",
        |truth| { has_origin(truth, Origin::On) }
    ),
    family!(
        "touch-at-zero",
        lattice::touch_at_zero,
        "leaves the box at t = 0",
        |truth| { meeting(truth).is_some_and(|meeting| meeting.ray == Overlap::AtAnEnd) }
    ),
    family!(
        "interval-ends",
        lattice::interval_ends,
        "meets the box at an end of the interval alone",
        |truth| { meeting(truth).is_some_and(|meeting| meeting.interval == Overlap::AtAnEnd) }
    ),
    family!(
        "behind",
        lattice::behind,
        "through the interior, all of it behind the origin",
        |truth| {
            has_class(truth, Class::Interior)
                && meeting(truth).is_some_and(|meeting| meeting.ray == Overlap::None)
        }
    ),
    family!(
        "flat",
        lattice::flat,
        "through the inside of a flat box, ahead",
        |truth| { has_class(truth, Class::Face) && is_ahead(truth) }
    ),
    family!(
        "point",
        lattice::point,
        "through a box that is a point, ahead",
        |truth| { has_class(truth, Class::Corner) && is_ahead(truth) }
    ),
    family!(
        "denormal",
        (|draw: &mut Draw| lattice::meeting(draw).denormal(draw)),
        "meets a box of subnormal size, ahead",
        is_ahead
    ),
    family!(
        "far",
        aimed::far,
        "through the interior from far away",
        |truth| { has_class(truth, Class::Interior) && is_ahead(truth) }
    ),
    family!(
        "huge",
        aimed::huge,
        "through the interior, where differences overflow",
        |truth| { has_class(truth, Class::Interior) }
    ),
    family!(
        "empty",
        lattice::empty,
        "the box has no points",
        |truth| *truth == Truth::Empty
    ),
    Family {
        name: "neighbour",
        version: 1,
        promise: "one of two neighbours, both met at one t ahead: at a wall that they share",
        is_of_pairs: true,
        keeps: is_ahead,
        f32: |draw, is_second| lattice::neighbour(draw, is_second).placed(draw),
        f64: |draw, is_second| lattice::neighbour(draw, is_second).placed(draw),
    },
];

fn meeting(truth: &Truth) -> Option<Meeting> {
    match truth {
        Truth::Meets(meeting) => Some(*meeting),
        _ => None,
    }
}

fn is_valid(truth: &Truth) -> bool {
    matches!(truth, Truth::Outside | Truth::Meets(_))
}

fn has_class(truth: &Truth, class: Class) -> bool {
    meeting(truth).is_some_and(|meeting| meeting.class == class)
}

fn has_origin(truth: &Truth, origin: Origin) -> bool {
    meeting(truth).is_some_and(|meeting| meeting.origin == origin)
}

fn is_ahead(truth: &Truth) -> bool {
    meeting(truth).is_some_and(|meeting| meeting.ray == Overlap::Within)
}
