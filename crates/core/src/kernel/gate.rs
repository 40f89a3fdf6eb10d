//! Gates, their margins, and the sinks that receive them.
//!
//! A kernel is a chain of gates. A gate compares a quantity with its epsilon; raising the epsilon can
//! only reject more. Its *margin* on a case is the largest representable epsilon at which it accepts, so
//! one evaluation gives the verdict at every epsilon.

use crate::arith::Real;
use serde::{Deserialize, Serialize};

/// When a gate refuses a quantity `x` under an epsilon. The form says what a NaN does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refuse {
    /// `if x < eps { miss }`: a NaN passes.
    Below,
    /// `if x <= eps { miss }`: a NaN passes.
    AtMost,
    /// `if !(x >= eps) { miss }`: a NaN is refused.
    UnlessAtLeast,
    /// `if !(x > eps) { miss }`: a NaN is refused.
    UnlessAbove,
}

impl Refuse {
    /// True if `x` passes under `epsilon`, by the comparison of the source.
    #[inline(always)]
    pub fn passes<R: Real>(self, x: &R, epsilon: &R) -> bool {
        match self {
            Refuse::Below => !x.is_less(epsilon),
            Refuse::AtMost => !x.is_at_most(epsilon),
            Refuse::UnlessAtLeast => epsilon.is_at_most(x),
            Refuse::UnlessAbove => epsilon.is_less(x),
        }
    }

    /// True if all quantities of at least one clause pass.
    #[inline(always)]
    fn passes_any<R: Real, const M: usize, const N: usize>(
        self,
        clauses: [[&R; N]; M],
        epsilon: &R,
    ) -> bool {
        clauses
            .iter()
            .any(|clause| clause.iter().all(|&x| self.passes(x, epsilon)))
    }

    /// The largest epsilon under which `x` passes.
    #[inline(always)]
    pub fn margin<R: Real>(self, x: &R) -> R {
        match self {
            Refuse::AtMost | Refuse::UnlessAbove if !x.is_nan() => x.just_below(),
            _ => self.threshold(x),
        }
    }

    /// The least upper bound of the epsilons under which `x` passes.
    #[inline(always)]
    pub fn threshold<R: Real>(self, x: &R) -> R {
        match self {
            _ if !x.is_nan() => x.clone(),
            Refuse::Below | Refuse::AtMost => R::infinity(),
            Refuse::UnlessAtLeast | Refuse::UnlessAbove => -R::infinity(),
        }
    }
}

/// The powers of length and of |d| in a margin. An absolute epsilon on anything but (0, 0) is a
/// different test at every scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "[i8; 2]", into = "[i8; 2]")]
pub struct Dimension {
    /// Power of length.
    pub length: i8,
    /// Power of the direction's length.
    pub direction: i8,
}

impl From<[i8; 2]> for Dimension {
    fn from([length, direction]: [i8; 2]) -> Dimension {
        Dimension { length, direction }
    }
}

impl From<Dimension> for [i8; 2] {
    fn from(dimension: Dimension) -> [i8; 2] {
        [dimension.length, dimension.direction]
    }
}

impl Dimension {
    /// A plain number.
    pub const NONE: Dimension = Dimension::new(0, 0);
    /// A t: a length in units of the direction.
    pub const T: Dimension = Dimension::new(1, -1);
    /// A determinant: twice the area of what is seen of the triangle, times |d|.
    pub const DETERMINANT: Dimension = Dimension::new(2, 1);
    /// A share of |d|.
    pub const DIRECTION: Dimension = Dimension::new(0, 1);

    /// `(length, direction)`.
    pub const fn new(length: i8, direction: i8) -> Dimension {
        Dimension { length, direction }
    }

    /// True if a margin scales with a length or with the direction; false if it is a plain number.
    pub fn has_unit(self) -> bool {
        self != Dimension::NONE
    }
}

named! {
    pub names
    /// The cases that a gate is there to refuse.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Role {
        /// Rays parallel to the plane and triangles without area; with a sign, the culled side too.
        Parallel = "parallel",
        /// Crossings before and beyond the extent, and with them the triangle that a ray starts on.
        T = "t",
        /// Crossings outside the triangle, and whatever has no gate of its own.
        Edge = "edge",
        /// Something else.
        Other = "other",
    }
}

impl Role {
    /// The role of a gate that has the name of its role, or of what is usually compared there.
    pub fn of_gate(name: &str) -> Option<Role> {
        match name.to_ascii_lowercase().as_str() {
            "det" | "determinant" | "a" | "den" | "denominator" | "area" => Some(Role::Parallel),
            "tmin" | "t_near" | "near" | "dist" | "distance" => Some(Role::T),
            "u" | "v" | "w" | "uv" | "uvw" | "bary" | "barycentric" | "inside" => Some(Role::Edge),
            name => Role::named(name),
        }
    }
}

/// One gate of a kernel: its name, its role, its comparison and its epsilons.
#[derive(Clone, Copy, Debug)]
pub struct Gate {
    /// The name, as in `--epsilon NAME=…`.
    pub name: &'static str,
    /// The cases that it is there to refuse.
    pub role: Role,
    /// The refusal in the source's notation, with `e` for the epsilon.
    pub refuses: &'static str,
    /// The refusal as the source prints it, where it says the same in other words.
    pub printed: Option<&'static str>,
    /// The margin's dimension.
    pub dimension: Dimension,
    /// The epsilons that it takes.
    pub epsilon: Tunable,
}

/// The epsilons that a gate takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tunable {
    /// None: the gate is a fixed test.
    Fixed,
    /// Zero and above; below zero it would refuse nothing that it does not refuse at zero.
    NonNegative,
    /// Any; a negative one is a tolerance.
    Signed,
}

impl Gate {
    /// A gate that takes any epsilon, with the name of its role.
    pub const fn signed(role: Role, refuses: &'static str, length: i8, direction: i8) -> Gate {
        let dimension = Dimension::new(length, direction);
        Gate {
            name: role.name(),
            role,
            refuses,
            printed: None,
            dimension,
            epsilon: Tunable::Signed,
        }
    }

    /// A gate `abs(x) < e`.
    pub const fn non_negative(
        role: Role,
        refuses: &'static str,
        length: i8,
        direction: i8,
    ) -> Gate {
        let gate = Gate::signed(role, refuses, length, direction);
        Gate {
            epsilon: Tunable::NonNegative,
            ..gate
        }
    }

    /// A test that takes no epsilon.
    pub const fn fixed(role: Role, refuses: &'static str) -> Gate {
        Gate {
            epsilon: Tunable::Fixed,
            ..Gate::signed(role, refuses, 0, 0)
        }
    }

    /// The gate as its source prints it.
    pub const fn printed(self, text: &'static str) -> Gate {
        Gate {
            printed: Some(text),
            ..self
        }
    }

    /// The same gate under another name.
    pub const fn named(self, name: &'static str) -> Gate {
        Gate { name, ..self }
    }
}

/// Receives the quantities of a kernel's gates. Each method returns none where the kernel stops with a miss.
pub trait Sink<R: Real> {
    /// A gate on several quantities under one epsilon: at least one clause must pass, and a clause
    /// passes when all its quantities do.
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&R; N]; M],
    ) -> Option<()>;

    /// A gate whose source rounds with the epsilon in it. `accepts` is monotone in its argument;
    /// `exact` is its threshold without rounding.
    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&R) -> bool,
        exact: impl FnOnce() -> R,
    ) -> Option<()>;

    /// A test without an epsilon.
    #[inline(always)]
    fn fixed(&mut self, gate: usize, accepts: bool) -> Option<()> {
        let margin = || {
            if accepts {
                R::infinity()
            } else {
                -R::infinity()
            }
        };
        self.rounded(gate, |_| accepts, margin)
    }

    /// A gate on one quantity.
    #[inline(always)]
    fn one(&mut self, gate: usize, refuse: Refuse, x: &R) -> Option<()> {
        self.gate(gate, refuse, [[x]])
    }
}

/// The fast sink: compares as the source does and stops at the first refusal, unless it watches.
#[derive(Debug)]
pub struct Deciding<'a, R> {
    epsilons: &'a [R],
    /// The gate that refused.
    pub refused_by: Option<usize>,
    /// Where it watches: whether each gate passed; true if the kernel never compared.
    pub passed: Vec<bool>,
}

impl<'a, R> Deciding<'a, R> {
    /// With one epsilon a gate.
    pub fn new(epsilons: &'a [R]) -> Self {
        Deciding {
            epsilons,
            refused_by: None,
            passed: Vec::new(),
        }
    }

    /// The same, but it never stops.
    #[cfg(feature = "margins")]
    pub fn watching(epsilons: &'a [R]) -> Self {
        Deciding {
            passed: vec![true; epsilons.len()],
            ..Deciding::new(epsilons)
        }
    }

    #[inline(always)]
    fn record(&mut self, gate: usize, accepts: bool) -> Option<()> {
        if let Some(passed) = self.passed.get_mut(gate) {
            *passed &= accepts;
            return Some(());
        }
        if !accepts {
            self.refused_by = Some(gate);
        }
        accepts.then_some(())
    }
}

impl<R: Real> Sink<R> for Deciding<'_, R> {
    #[inline(always)]
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&R; N]; M],
    ) -> Option<()> {
        let accepts = refuse.passes_any(clauses, &self.epsilons[gate]);
        self.record(gate, accepts)
    }

    #[inline(always)]
    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&R) -> bool,
        _: impl FnOnce() -> R,
    ) -> Option<()> {
        let accepts = accepts(&self.epsilons[gate]);
        self.record(gate, accepts)
    }
}

/// The measuring sink: takes every gate's margin, or its threshold, and never stops.
#[derive(Debug)]
pub struct Measuring<'a, R> {
    margins: &'a mut [R],
    thresholds: bool,
}

impl<'a, R: Real> Measuring<'a, R> {
    /// With one place a gate; it stays +inf where the kernel never compares. A gate `x <= e` has the margin next
    /// below x and the threshold x, so that only its threshold compares with an exact number.
    pub fn new(margins: &'a mut [R], thresholds: bool) -> Self {
        margins.fill(R::infinity());
        Measuring {
            margins,
            thresholds,
        }
    }

    #[inline(always)]
    fn record(&mut self, gate: usize, margin: R) -> Option<()> {
        if margin.is_less(&self.margins[gate]) {
            self.margins[gate] = margin;
        }
        Some(())
    }
}

/// The first gate that refuses a case of these margins under these epsilons.
pub fn refused_by<R: Real>(margins: &[R], epsilons: &[R]) -> Option<usize> {
    (0..margins.len()).find(|&gate| margins[gate].is_less(&epsilons[gate]))
}

impl<R: Real> Sink<R> for Measuring<'_, R> {
    #[inline(always)]
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&R; N]; M],
    ) -> Option<()> {
        let thresholds = self.thresholds;
        let margin = |x: &R| {
            if thresholds {
                refuse.threshold(x)
            } else {
                refuse.margin(x)
            }
        };
        let least = |clause: [&R; N]| {
            clause
                .map(margin)
                .into_iter()
                .fold(R::infinity(), R::smaller)
        };
        self.record(
            gate,
            clauses
                .map(least)
                .into_iter()
                .fold(-R::infinity(), R::larger),
        )
    }

    #[inline(always)]
    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&R) -> bool,
        exact: impl FnOnce() -> R,
    ) -> Option<()> {
        self.record(gate, R::largest_accepted(accepts, exact))
    }
}

/// One of two sinks, chosen at run time: a kernel's code in a slow arithmetic is compiled once for both.
#[derive(Debug)]
pub(super) enum Either<A, B> {
    One(A),
    Other(B),
}

impl<R: Real, A: Sink<R>, B: Sink<R>> Sink<R> for Either<&mut A, &mut B> {
    #[inline(never)]
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&R; N]; M],
    ) -> Option<()> {
        match self {
            Either::One(sink) => sink.gate(gate, refuse, clauses),
            Either::Other(sink) => sink.gate(gate, refuse, clauses),
        }
    }

    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&R) -> bool,
        exact: impl FnOnce() -> R,
    ) -> Option<()> {
        match self {
            Either::One(sink) => sink.rounded(gate, accepts, exact),
            Either::Other(sink) => sink.rounded(gate, accepts, exact),
        }
    }
}
