//! Floor 1: what a kernel promises. Pure data; `judge` turns it and a truth into an obligation.

#![forbid(unsafe_code)]

mod words;

use crate::error::Error;
use std::fmt;
use std::str::FromStr;

/// The promise a kernel is judged by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contract {
    /// Which part of the line counts.
    pub extent: Extent,
    /// Which sides of a triangle can be hit.
    pub sides: Sides,
    /// Edges and vertices: hits, misses or either.
    pub boundary: Boundary,
    /// The point t = 0 of a ray, and t_min and t_max of an interval: hits, misses or either.
    pub ends: Boundary,
    /// Lines in the plane of the triangle.
    pub coplanar: Demand,
    /// Triangles without area.
    pub degenerate: Demand,
    /// NaN, infinities, a zero direction, an impossible interval.
    pub invalid: Demand,
    /// The directions that the kernel promises anything for.
    pub direction: Direction,
    /// The promise about triangles that share an edge or a vertex.
    pub across: Across,
    /// A ray that starts at a kernel's own hit point must not hit that triangle again.
    pub no_self_hit: bool,
    /// Cases nearer than this to where another verdict would be right are free.
    pub band: Option<Band>,
    /// No hit is owed where |d·((b-a)×(c-a))|, the determinant of Möller and Trumbore, is exactly less than this: a
    /// documented epsilon, which may lose small triangles and rays nearly parallel to them. Zero: hits are owed everywhere.
    pub least_determinant: f64,
    /// How far t·|d|, u and v may be off besides what rounding explains, in the triangle's longest edges and in weights:
    /// what a kernel's documentation allows. Infinite: values are not judged.
    pub value_tolerance: f64,
}

/// A distance to the boundary below which nothing is demanded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// How far; above zero.
    pub size: f64,
    /// In what.
    pub unit: BandUnit,
}

/// The unit of a band.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BandUnit {
    /// The triangle's longest edge.
    Edges,
    /// Units in the last place of the largest coordinate of the case's points.
    Ulps,
}

impl fmt::Display for Band {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            BandUnit::Edges => write!(f, "{:e}", self.size),
            BandUnit::Ulps => write!(f, "{}ulps", self.size),
        }
    }
}

impl FromStr for Band {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (number, unit) = match text.strip_suffix("ulps").or(text.strip_suffix("ulp")) {
            Some(number) => (number, BandUnit::Ulps),
            None => (text, BandUnit::Edges),
        };
        let size = number
            .trim()
            .parse()
            .ok()
            .filter(|size: &f64| *size > 0.0 && size.is_finite());
        size.map(|size| Band { size, unit }).ok_or_else(|| {
            Error::syntax(format!("'{text}' is not a band: write a distance above 0, in longest edges as 1e-6 or in ulps as 4ulps"))
        })
    }
}

named! {
    pub names
    /// The part of the line that counts.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Extent {
        /// All t.
        Line = "line",
        /// t ≥ 0.
        Ray = "ray",
        /// t in `[t_min, t_max]`.
        Interval = "interval",
    }
}

named! {
    pub names
    /// The sides that can be hit.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Sides {
        /// Both.
        Both = "both",
        /// Only the front: the back must be missed.
        Front = "front",
    }
}

named! {
    pub names
    /// The right answer on edges and vertices, or at the ends of a ray or an interval.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Boundary {
        /// Hits.
        Closed = "closed",
        /// Misses.
        Open = "open",
        /// Either.
        Free = "free",
    }
}

named! {
    pub names
    /// A demand on a kernel in one situation.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Demand {
        /// A miss.
        Miss = "miss",
        /// A hit where there is a common point, else a miss.
        Hit = "hit",
        /// Nothing.
        Free = "free",
    }
}

/// The directions that a kernel promises anything for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Any length.
    Any,
    /// Unit length within this many ulps; other directions are free.
    Unit {
        /// The tolerance on the length, in ulps of 1.
        ulps: u32,
    },
}

named! {
    pub names
    /// A promise across triangles that share an edge or a vertex.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Across {
        /// Nothing.
        Nothing = "nothing",
        /// No crack: at least one of the triangles reports the hit.
        AtLeastOne = "at-least-one",
        /// No crack and no double.
        ExactlyOne = "exactly-one",
    }
}

impl Contract {
    /// The closed triangle on a ray, both sides; a coplanar ray, a triangle without area and invalid
    /// input are missed, as the ray tracing interfaces of graphics libraries rule.
    pub const CLOSED_RAY: Contract = Contract {
        extent: Extent::Ray,
        sides: Sides::Both,
        boundary: Boundary::Closed,
        ends: Boundary::Closed,
        coplanar: Demand::Miss,
        degenerate: Demand::Miss,
        invalid: Demand::Miss,
        direction: Direction::Any,
        across: Across::Nothing,
        no_self_hit: false,
        band: None,
        least_determinant: 0.0,
        value_tolerance: 0.0,
    };

    /// A kernel's own contract starts here: as [`Contract::CLOSED_RAY`], invalid input free.
    pub const fn of_kernel(extent: Extent, sides: Sides, boundary: Boundary) -> Contract {
        Contract {
            extent,
            sides,
            boundary,
            invalid: Demand::Free,
            ..Contract::CLOSED_RAY
        }
    }

    /// The same with other demands on coplanar lines and triangles without area.
    pub const fn with_flat(self, coplanar: Demand, degenerate: Demand) -> Contract {
        Contract {
            coplanar,
            degenerate,
            ..self
        }
    }

    /// The same with a promise across triangles.
    pub const fn with_across(self, across: Across) -> Contract {
        Contract { across, ..self }
    }

    /// True if the truth of a case decides what is demanded, and no length or determinant.
    pub fn asks_of_truths_alone(&self) -> bool {
        self.direction == Direction::Any && self.band.is_none() && self.least_determinant == 0.0
    }

    /// The contract in one line, as reports show it.
    pub fn describe(&self) -> String {
        let sides = match self.sides {
            Sides::Both => "both sides",
            Sides::Front => "front only",
        };
        let boundary = match self.boundary {
            Boundary::Closed => "closed",
            Boundary::Open => "open",
            Boundary::Free => "boundary free",
        };
        let ends = match self.ends {
            Boundary::Closed => "",
            Boundary::Open => ", ends open",
            Boundary::Free => ", ends free",
        };
        let Contract {
            extent,
            coplanar,
            degenerate,
            invalid,
            across,
            ..
        } = self;
        let mut text = format!(
            "{extent}, {sides}, {boundary}{ends}, coplanar {coplanar}, degenerate {degenerate}, invalid {invalid}"
        );
        if *across != Across::Nothing {
            text.push_str(&format!(", {across} across triangles"));
        }
        if let Direction::Unit { ulps } = self.direction {
            text.push_str(&format!(", unit directions within {ulps} ulps"));
        }
        if self.no_self_hit {
            text.push_str(", no self-hit");
        }
        if let Some(band) = self.band {
            let unit = if band.unit == BandUnit::Ulps {
                ""
            } else {
                " longest edges"
            };
            text.push_str(&format!(", free within {band}{unit} of the boundary"));
        }
        if self.least_determinant > 0.0 {
            text.push_str(&format!(
                ", no hit owed at |det| < {:e}",
                self.least_determinant
            ));
        }
        match self.value_tolerance {
            0.0 => {}
            f64::INFINITY => text.push_str(", values free"),
            edges => text.push_str(&format!(", values free within {edges:e} longest edges")),
        }
        text
    }
}

/// A contract that all kernels can be judged by, for a league table.
pub struct NamedContract {
    /// The name on the command line.
    pub name: &'static str,
    /// The promise.
    pub contract: Contract,
    /// Its purpose, in a few words.
    pub about: &'static str,
}

/// One row per named contract.
pub const NAMED: &[NamedContract] = &[
    NamedContract {
        name: "closed-line",
        contract: Contract {
            extent: Extent::Line,
            ..Contract::CLOSED_RAY
        },
        about: "the closed triangle, any t",
    },
    NamedContract {
        name: "closed-ray",
        contract: Contract::CLOSED_RAY,
        about: "the closed triangle, t >= 0",
    },
    NamedContract {
        name: "closed-interval",
        contract: Contract {
            extent: Extent::Interval,
            ..Contract::CLOSED_RAY
        },
        about: "the closed triangle, t in [t_min, t_max]",
    },
    NamedContract {
        name: "open-ray",
        contract: Contract {
            boundary: Boundary::Open,
            ..Contract::CLOSED_RAY
        },
        about: "the open triangle (edges and vertices are misses), t >= 0",
    },
    NamedContract {
        name: "front-closed-ray",
        contract: Contract {
            sides: Sides::Front,
            ..Contract::CLOSED_RAY
        },
        about: "the closed triangle from its front, t >= 0",
    },
    NamedContract {
        name: "no-self-hit",
        contract: Contract {
            no_self_hit: true,
            ..Contract::CLOSED_RAY
        },
        about: "closed-ray, and no second hit on the triangle that the ray starts on (family secondary-ray)",
    },
];
