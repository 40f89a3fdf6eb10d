//! The definition of truth, with num-rational: slow, obvious, and the reference for all else.
//!
//! On each axis the points `o + t·d` between min and max have t in a closed interval: all t or none if d is 0, otherwise
//! from one plane to the other. The line meets the box at the t that all three axes allow.

use crate::case::BoxCase;
use crate::truth::{Class, Meeting, Origin, Overlap, Truth};
use hairline_core::Float;
use num_rational::BigRational as Rational;
use num_traits::{Signed, Zero};

/// The truth of a case by definition, with the exact t behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// The truth.
    pub truth: Truth,
    /// Where the line enters and leaves the box.
    pub line: Option<Range>,
    /// The part of that in the interval of the case.
    pub interval: Option<Range>,
}

/// A closed range of t.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Range {
    /// Its least t.
    pub enter: Rational,
    /// Its greatest t.
    pub exit: Rational,
}

/// An end of an interval: a number or an infinity.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum End {
    MinusInfinity,
    At(Rational),
    PlusInfinity,
}

/// One axis of a case.
struct Axis {
    origin: Rational,
    direction: Rational,
    min: Rational,
    max: Rational,
}

impl Axis {
    fn is_parallel(&self) -> bool {
        self.direction.is_zero()
    }

    /// True if no point is between the planes.
    fn is_empty(&self) -> bool {
        self.min > self.max
    }

    /// True if the line is outside the slab at all t.
    fn is_beside(&self) -> bool {
        self.is_parallel() && !self.contains(&Rational::zero())
    }

    /// Where it enters and leaves the slab; none of a line parallel to it.
    fn crossing(&self) -> Option<Range> {
        if self.is_parallel() {
            return None;
        }
        let at_min = (&self.min - &self.origin) / &self.direction;
        let at_max = (&self.max - &self.origin) / &self.direction;
        if self.direction.is_positive() {
            Some(Range {
                enter: at_min,
                exit: at_max,
            })
        } else {
            Some(Range {
                enter: at_max,
                exit: at_min,
            })
        }
    }

    /// True if the coordinate of the line is between the planes at some t, or at all.
    fn contains(&self, t: &Rational) -> bool {
        let x = self.coordinate(t);
        self.min <= x && x <= self.max
    }

    /// True if the coordinate of the line is that of one of the planes.
    fn is_on_plane(&self, t: &Rational) -> bool {
        let x = self.coordinate(t);
        x == self.min || x == self.max
    }

    fn coordinate(&self, t: &Rational) -> Rational {
        &self.origin + t * &self.direction
    }
}

/// The truth of a case, by definition.
pub fn define<F: Float>(case: &BoxCase<F>) -> Definition {
    let only = |truth| Definition {
        truth,
        line: None,
        interval: None,
    };
    let wide = case.widen();
    let Some(axes) = axes(&wide) else {
        return only(Truth::Invalid);
    };
    let Some(t_min) = end(wide.ray.t_min) else {
        return only(Truth::Invalid);
    };
    let Some(t_max) = end(wide.ray.t_max) else {
        return only(Truth::Invalid);
    };
    if t_min > t_max || axes.iter().all(Axis::is_parallel) {
        return only(Truth::Invalid);
    }
    if axes.iter().any(Axis::is_empty) {
        return only(Truth::Empty);
    }
    let Some(line) = common(&axes) else {
        return only(Truth::Outside);
    };
    let zero = End::At(Rational::zero());
    let meeting = Meeting {
        class: class(&axes, &line),
        origin: origin(&axes),
        ray: overlap(&line, &zero, &End::PlusInfinity),
        interval: overlap(&line, &t_min, &t_max),
    };
    Definition {
        truth: Truth::Meets(meeting),
        interval: clipped(&line, &t_min, &t_max),
        line: Some(line),
    }
}

/// None if a coordinate is not finite.
fn axes(case: &BoxCase<f64>) -> Option<[Axis; 3]> {
    let [origin, direction, min, max] = case.vectors();
    let axis = |i: usize| {
        Some(Axis {
            origin: Rational::from_float(origin[i])?,
            direction: Rational::from_float(direction[i])?,
            min: Rational::from_float(min[i])?,
            max: Rational::from_float(max[i])?,
        })
    };
    Some([axis(0)?, axis(1)?, axis(2)?])
}

/// None of NaN.
fn end(t: f64) -> Option<End> {
    if t == f64::INFINITY {
        return Some(End::PlusInfinity);
    }
    if t == f64::NEG_INFINITY {
        return Some(End::MinusInfinity);
    }
    Rational::from_float(t).map(End::At)
}

/// The t at which the line is in all three slabs; none if there is no such t.
fn common(axes: &[Axis; 3]) -> Option<Range> {
    if axes.iter().any(Axis::is_beside) {
        return None;
    }
    let crossings = || axes.iter().filter_map(Axis::crossing);
    let enter = crossings().map(|range| range.enter).max()?;
    let exit = crossings().map(|range| range.exit).min()?;
    (enter <= exit).then_some(Range { enter, exit })
}

fn class(axes: &[Axis; 3], line: &Range) -> Class {
    if line.enter < line.exit {
        let two = Rational::from_integer(2.into());
        let middle = (&line.enter + &line.exit) / two;
        if axes.iter().any(|axis| axis.is_on_plane(&middle)) {
            return Class::Along;
        }
        return Class::Interior;
    }
    let on_planes = axes.iter().filter(|axis| axis.is_on_plane(&line.enter));
    match on_planes.count() {
        3 => Class::Corner,
        2 => Class::Edge,
        _ => Class::Face,
    }
}

fn origin(axes: &[Axis; 3]) -> Origin {
    let zero = Rational::zero();
    if !axes.iter().all(|axis| axis.contains(&zero)) {
        return Origin::Outside;
    }
    if axes.iter().any(|axis| axis.is_on_plane(&zero)) {
        return Origin::On;
    }
    Origin::Inside
}

/// The part of a range between two ends.
fn clipped(range: &Range, low: &End, high: &End) -> Option<Range> {
    let enter = End::At(range.enter.clone()).max(low.clone());
    let exit = End::At(range.exit.clone()).min(high.clone());
    let End::At(enter) = enter else {
        return None;
    };
    let End::At(exit) = exit else {
        return None;
    };
    (enter <= exit).then_some(Range { enter, exit })
}

fn overlap(range: &Range, low: &End, high: &End) -> Overlap {
    let Some(Range { enter, exit }) = clipped(range, low, high) else {
        return Overlap::None;
    };
    let is_one_point = enter == exit;
    let point = End::At(enter);
    if is_one_point && (point == *low || point == *high) {
        return Overlap::AtAnEnd;
    }
    Overlap::Within
}
