//! The faces that a ray meets first, and all of them in exact order.

use crate::bounds::Bounds;
use crate::found::{End, Found, Name, Order};
use crate::fraction::Parameter;
use std::cmp::Ordering;

/// The least t at which a ray meets a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest<N = u32> {
    /// Bounds of t.
    pub t: Bounds,
    /// All faces that the ray meets there, by number or by instance and number. Any one of them is right.
    pub faces: Vec<N>,
}

/// Points of a ray that it shares with the same faces: one point, or a segment that lies in them.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit<N = u32> {
    /// Bounds of the first t.
    pub from: Bounds,
    /// Bounds of the last t; that of a point is the first one.
    pub to: Bounds,
    /// True if the ray runs inside the faces from the first t to a later one.
    pub is_segment: bool,
    /// The faces, by number or by instance and number.
    pub faces: Vec<N>,
}

/// A search for the nearest faces.
pub struct Nearer {
    /// The face with the least upper bound.
    best: Option<Found>,
    /// Those that may come before it. Seldom are there any.
    rivals: Vec<Found>,
    /// The least upper bound.
    pub least: f64,
}

impl Nearer {
    pub const NONE: Nearer = Nearer {
        best: None,
        rivals: Vec::new(),
        least: f64::INFINITY,
    };

    /// Adds a face. Gives the least upper bound, if the face has it.
    #[inline(always)]
    pub fn add(&mut self, found: Found) -> Option<f64> {
        if self.best.is_some() && self.least <= found.from.upper {
            self.rivals.push(found);
            return None;
        }
        self.least = found.from.upper;
        let least = self.least;
        self.rivals.extend(self.best.replace(found));
        self.rivals.retain(|rival| rival.from.lower <= least);
        Some(least)
    }

    /// The nearest of all, exactly. `face` gives the face at a place.
    pub fn first<N: Ord>(
        self,
        order: &Order<impl Fn(u32) -> Parameter, impl Fn(&Found) -> Option<Name>>,
        face: impl Fn(u32) -> N,
    ) -> Option<Nearest<N>> {
        let best = self.best?;
        let mut first = &best;
        let mut faces = vec![face(best.place)];
        for rival in &self.rivals {
            match order.compare(rival, End::From, first, End::From) {
                Ordering::Less => {
                    first = rival;
                    faces.clear();
                    faces.push(face(rival.place));
                }
                Ordering::Equal => faces.push(face(rival.place)),
                Ordering::Greater => {}
            }
        }
        faces.sort();
        Some(Nearest {
            t: first.from,
            faces,
        })
    }
}

/// The hits of some faces, in exact order. `face` gives the face at a place.
pub fn in_order<N: Ord>(
    mut found: Vec<Found>,
    order: &Order<impl Fn(u32) -> Parameter, impl Fn(&Found) -> Option<Name>>,
    face: impl Fn(u32) -> N,
) -> Vec<Hit<N>> {
    found.sort_by(|a, b| order.by_ends(a, b));
    let equal = found.chunk_by(|a, b| order.by_ends(a, b) == Ordering::Equal);
    let hit = |same: &[Found]| {
        let mut faces: Vec<N> = same.iter().map(|found| face(found.place)).collect();
        faces.sort();
        Hit {
            from: same[0].from,
            to: same[0].to,
            is_segment: same[0].is_segment(),
            faces,
        }
    };
    equal.map(hit).collect()
}
