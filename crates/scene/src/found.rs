//! A face that a ray meets, the order of two of them along the ray, and what needs no arithmetic: points with one name.

use crate::bounds::Bounds;
use crate::fraction::Parameter;
use crate::mesh::Triangle;
use hairline_core::{Facing, Feature};
use std::cell::OnceCell;
use std::cmp::Ordering;

/// The common points of a ray and a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Common {
    /// The point at which the line crosses the face's plane.
    Crossing(Facing, Feature),
    /// A point of a face that holds part of the line, or that has no area.
    Point(Feature),
    /// A segment.
    Segment,
}

/// A face that a ray meets on its interval.
pub struct Found {
    /// The face's place in the tree.
    pub place: u32,
    pub common: Common,
    pub from: Bounds,
    pub to: Bounds,
    /// First and last t, once they are known exactly.
    exact: OnceCell<Box<[Parameter; 2]>>,
}

/// One of the ends of what a ray and a face have in common.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum End {
    From = 0,
    To = 1,
}

impl Found {
    /// The point at which the line crosses the face's plane, with bounds of its t.
    #[inline(always)]
    pub fn crossing(place: u32, facing: Facing, feature: Feature, t: Bounds) -> Found {
        Found {
            place,
            common: Common::Crossing(facing, feature),
            from: t,
            to: t,
            exact: OnceCell::new(),
        }
    }

    /// The rest, from exact ends.
    pub fn between(place: u32, common: Common, ends: [Parameter; 2]) -> Found {
        Found {
            place,
            common,
            from: ends[0].bounds(),
            to: ends[1].bounds(),
            exact: OnceCell::from(Box::new(ends)),
        }
    }

    pub fn is_segment(&self) -> bool {
        self.common == Common::Segment
    }

    pub fn bounds(&self, end: End) -> Bounds {
        match end {
            End::From => self.from,
            End::To => self.to,
        }
    }

    /// The vertices that name the point among all points of a line. None of a segment.
    pub fn name(&self, triangle: &Triangle<f64>) -> Option<Name> {
        let [a, b, c] = triangle;
        let feature = match self.common {
            Common::Crossing(_, feature) | Common::Point(feature) => feature,
            Common::Segment => return None,
        };
        Some(match feature {
            Feature::VertexA => Name::of([a]),
            Feature::VertexB => Name::of([b]),
            Feature::VertexC => Name::of([c]),
            Feature::EdgeAb => Name::of([a, b]),
            Feature::EdgeBc => Name::of([b, c]),
            Feature::EdgeCa => Name::of([c, a]),
            Feature::Interior | Feature::Outside => Name::of([a, b, c]),
        })
    }
}

/// One vertex, the two of an edge, or the three of a face, by coordinates and in any order. A line that meets a vertex,
/// or an edge or a face in one point only, meets it at one t, whichever face the vertices are taken from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Name([[u64; 3]; 3]);

impl Name {
    fn of<const N: usize>(vertices: [&[f64; 3]; N]) -> Name {
        // The two zeros are one number. What is not there has the bits of NaN.
        let bits = vertices.map(|vertex| vertex.map(|x| (x + 0.0).to_bits()));
        let mut all = [[u64::MAX; 3]; 3];
        all[..N].copy_from_slice(&bits);
        all.sort();
        Name(all)
    }
}

/// The order of faces along one ray.
pub struct Order<C, N> {
    /// The exact t at which the line crosses the plane of the face at a place.
    pub crossing: C,
    /// The name of a point, if it has one.
    pub name: N,
}

impl<C, N> Order<C, N>
where
    C: Fn(u32) -> Parameter,
    N: Fn(&Found) -> Option<Name>,
{
    /// The order of an end of one and an end of another, exactly.
    pub fn compare(&self, a: &Found, a_end: End, b: &Found, b_end: End) -> Ordering {
        let (x, y) = (a.bounds(a_end), b.bounds(b_end));
        if x.upper < y.lower {
            return Ordering::Less;
        }
        if y.upper < x.lower {
            return Ordering::Greater;
        }
        if x.is_exact() && y.is_exact() {
            return Ordering::Equal;
        }
        let name = (self.name)(a);
        if name.is_some() && name == (self.name)(b) {
            return Ordering::Equal;
        }
        let (x, y) = (self.parameter(a, a_end), self.parameter(b, b_end));
        x.compare(y)
    }

    /// The order by the first t, and where that is equal by the last one.
    pub fn by_ends(&self, a: &Found, b: &Found) -> Ordering {
        let by_first = self.compare(a, End::From, b, End::From);
        by_first.then_with(|| {
            // A point ends where it begins, and a segment does not.
            match (a.is_segment(), b.is_segment()) {
                (true, true) => self.compare(a, End::To, b, End::To),
                (a, b) => a.cmp(&b),
            }
        })
    }

    /// The order of an end and a float, exactly; the float may be infinite.
    pub fn compare_float(&self, found: &Found, end: End, t: f64) -> Ordering {
        let bounds = found.bounds(end);
        if bounds.upper < t {
            return Ordering::Less;
        }
        if t < bounds.lower {
            return Ordering::Greater;
        }
        if bounds.is_exact() {
            return Ordering::Equal;
        }
        self.parameter(found, end).compare_float(t)
    }

    /// An end, exactly.
    pub fn parameter<'f>(&self, found: &'f Found, end: End) -> &'f Parameter {
        let ends = found.exact.get_or_init(|| {
            let t = (self.crossing)(found.place);
            Box::new([t.clone(), t])
        });
        &ends[end as usize]
    }
}
