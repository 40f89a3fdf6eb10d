//! The obligation of a slab test on a case, and whether it was met. A verdict is compared with a truth here and nowhere else.

use crate::case::BoxCase;
use crate::distance::about;
use crate::truth::{Class, Meeting, Overlap, Truth};
use hairline_core::{Boundary, Contract, Demand, Extent, Float, Verdict};

/// The demand of a contract on a case with some truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obligation {
    /// A hit.
    Hit,
    /// A miss.
    Miss,
    /// Nothing.
    Free,
}

/// How a verdict stands to what was owed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// It is right, or nothing was owed.
    Right,
    /// A hit of a box that must be missed.
    FalseHit,
    /// A miss of a box that must be hit.
    FalseMiss,
    /// No verdict: the test failed.
    Failed,
}

impl Obligation {
    /// From a truth and a contract. Of a contract, `coplanar` is about lines in the plane of a face, `degenerate` about
    /// flat boxes, and `invalid` also about boxes without points, which programs use for "nothing here".
    pub fn new(truth: &Truth, contract: &Contract) -> Obligation {
        match truth {
            Truth::Invalid | Truth::Empty => match contract.invalid {
                Demand::Free => Obligation::Free,
                Demand::Miss | Demand::Hit => Obligation::Miss,
            },
            Truth::Outside => Obligation::Miss,
            Truth::Meets(meeting) => of_meeting(meeting, contract),
        }
    }

    /// How a verdict stands to it.
    pub fn judge<F: Float>(self, verdict: &Verdict<F>) -> Finding {
        if verdict.failure.is_some() {
            return Finding::Failed;
        }
        match (self, verdict.hit) {
            (Obligation::Miss, true) => Finding::FalseHit,
            (Obligation::Hit, false) => Finding::FalseMiss,
            _ => Finding::Right,
        }
    }
}

fn of_meeting(meeting: &Meeting, contract: &Contract) -> Obligation {
    let overlap = match contract.extent {
        Extent::Line => Overlap::Within,
        Extent::Ray => meeting.ray,
        Extent::Interval => meeting.interval,
    };
    let at_the_ends = match overlap {
        Overlap::None => return Obligation::Miss,
        Overlap::AtAnEnd => of_boundary(contract.ends),
        Overlap::Within => Obligation::Hit,
    };
    let on_the_box = match meeting.class {
        Class::Interior => Obligation::Hit,
        Class::Edge | Class::Corner => of_boundary(contract.boundary),
        Class::Face => of_demand(contract.degenerate),
        Class::Along => of_demand(contract.coplanar),
    };
    at_the_ends.and(on_the_box)
}

fn of_boundary(boundary: Boundary) -> Obligation {
    match boundary {
        Boundary::Closed => Obligation::Hit,
        Boundary::Open => Obligation::Miss,
        Boundary::Free => Obligation::Free,
    }
}

fn of_demand(demand: Demand) -> Obligation {
    match demand {
        Demand::Hit => Obligation::Hit,
        Demand::Miss => Obligation::Miss,
        Demand::Free => Obligation::Free,
    }
}

impl Obligation {
    /// A hit is owed only if both demand it, and a miss if one does.
    fn and(self, other: Obligation) -> Obligation {
        match (self, other) {
            (Obligation::Miss, _) | (_, Obligation::Miss) => Obligation::Miss,
            (Obligation::Free, _) | (_, Obligation::Free) => Obligation::Free,
            _ => Obligation::Hit,
        }
    }
}

/// How wrong a verdict is: how far the box would have to grow, or shrink, on all sides for it to be right, by the largest
/// coordinate of the case, to about 1e-15.
pub fn severity<F: Float>(case: &BoxCase<F>, extent: Extent) -> Option<f64> {
    let case = case.widen();
    let case = match extent {
        Extent::Line => case.on(f64::NEG_INFINITY, f64::INFINITY),
        Extent::Ray => case.on(0.0, f64::INFINITY),
        Extent::Interval => case,
    };
    about(&case).map(f64::abs)
}
