//! How a ray and a box really meet.

/// How the line, the ray and the interval of a case meet its box, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// NaN, infinities, a zero direction, or an interval whose ends are not in order.
    Invalid,
    /// The box has no points: `min > max` on some axis.
    Empty,
    /// The line passes outside the box.
    Outside,
    /// The line has a point of the box.
    Meets(Meeting),
}

/// A line that meets a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meeting {
    /// Where it passes.
    pub class: Class,
    /// Where the ray starts.
    pub origin: Origin,
    /// How much of the common points lies on the ray, at t >= 0.
    pub ray: Overlap,
    /// How much of the common points lies in the interval.
    pub interval: Overlap,
}

/// Where a line meets a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// It passes through the interior.
    Interior,
    /// It has one point of a flat box, inside a face.
    Face,
    /// It has one point of the box, on an edge.
    Edge,
    /// It has one point of the box, a corner.
    Corner,
    /// It runs inside the plane of a face, and has a segment of the boundary.
    Along,
}

/// Where the origin of a ray lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Outside the box.
    Outside,
    /// On its boundary.
    On,
    /// In its interior.
    Inside,
}

/// How much of what a line and a box have in common lies between two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlap {
    /// None of it.
    None,
    /// One point, at an end.
    AtAnEnd,
    /// Some of it between the ends.
    Within,
}

impl Truth {
    /// True if the closed box and the closed interval have a common point; none of an invalid case.
    pub fn hits_closed(&self) -> Option<bool> {
        match self {
            Truth::Invalid => None,
            Truth::Empty | Truth::Outside => Some(false),
            Truth::Meets(meeting) => Some(meeting.interval != Overlap::None),
        }
    }
}
