//! The objectives that a search maximises: errors of margins and values, and the severity of findings.
//!
//! | objective | what is scored | unit |
//! |---|---|---|
//! | `margin` | the error of what a gate compares with its epsilon | ulps of the gate's scale |
//! | `t` | the error of t | ulps of the exact t |
//! | `uv` | the larger error of u and v | ulps of 1 |
//! | `wrong-value` | the error of t, u or v over what one rounding may do to it | u·κ (`judge::values`) |
//! | `false-miss` | how far inside a line passes that the gate refused | longest edges |
//! | `false-hit` | how far outside a line passes that the gate let through | longest edges |
//!
//! The largest epsilon that a gate `x <= e` accepts is the float below x. The score uses x, the threshold,
//! because an exact number has no next one below it.
//!
//! An absolute error of a margin means nothing by itself: its unit is a power of length, times a power of
//! |d| ([`Dimension`]). A gate's *scale* on a case is E^p·|d|^q, with the dimension's powers p and q, E the
//! largest difference between coordinates of the origin and the vertices on one axis, and |d| the
//! largest component of the direction; an ulp of it is 2^-23 (`f32`) or 2^-52 (`f64`) of it. A kernel
//! that takes differences first and divides by nothing stays at a few such ulps; products of
//! absolute coordinates, and quotients of small numbers, do not. Of a margin larger than its scale,
//! as u where the line passes far away, an ulp is 2^-23 (2^-52) of the exact margin.
//!
//! These count: a margin, if no gate before it rejected and both margins are finite; t, u and v of a hit
//! that is not a false one, if they are finite; a false miss at the gate that rejected; a false hit at the
//! first gate that rejects when the same formula runs without rounding. A false hit of the formula itself
//! is convention, not error, and has no score. A false hit before or beyond the extent has a score only at
//! a gate on t.

use super::domain::{SearchDomain, larger};
use crate::arith::{Exact, Float, Real, Vector};
use crate::audit::{Row, values};
use crate::case::{Case, Ray, Triangle};
use crate::judge::{
    Distances, Finding, ValueErrors, asked, exact_times, exact_to_change, is_in_extent, judge,
};
use crate::kernel::gate::refused_by;
use crate::kernel::{Dimension, KernelInfo, Role, Scalar, Tunable, Verdict};
use crate::oracle;
use crate::truth::{Feature, Truth};
use std::slice;

named! {
    pub names
    /// A quantity that a search maximises.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Objective {
        /// The error of what a gate compares with its epsilon.
        Margin = "margin",
        /// The error of t.
        T = "t",
        /// The error of u or v.
        Uv = "uv",
        /// The error of t, u or v over what one rounding may do to it.
        WrongValue = "wrong-value",
        /// How far inside a false miss is.
        FalseMiss = "false-miss",
        /// How far outside a false hit is.
        FalseHit = "false-hit",
    }
}

impl Objective {
    /// The unit of a score.
    pub fn unit(self) -> &'static str {
        match self {
            Objective::Margin => "ulps of the gate's scale",
            Objective::T => "ulps of t",
            Objective::Uv => "ulps of 1",
            Objective::WrongValue => "u·κ",
            Objective::FalseMiss => "longest edges inside",
            Objective::FalseHit => "longest edges outside",
        }
    }
}

/// An objective, at a gate where it has one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SearchTarget {
    /// The quantity that is scored.
    pub objective: Objective,
    /// The gate's place in the kernel's order; none for t, u and v.
    pub gate: Option<usize>,
}

impl SearchTarget {
    /// Every target that a kernel has: no margin of a gate without epsilons, no value that it does
    /// not give.
    pub fn of_kernel(info: &KernelInfo) -> Vec<SearchTarget> {
        let mut targets = Vec::new();
        let mut add = |objective, gate| targets.push(SearchTarget { objective, gate });
        for (place, gate) in info.gates.iter().enumerate() {
            if gate.epsilon != Tunable::Fixed {
                add(Objective::Margin, Some(place));
            }
        }
        if info.gives.t {
            add(Objective::T, None);
        }
        if info.gives.uv {
            add(Objective::Uv, None);
        }
        if info.gives.t || info.gives.uv {
            add(Objective::WrongValue, None);
        }
        for objective in [Objective::FalseMiss, Objective::FalseHit] {
            for place in 0..info.gates.len() {
                add(objective, Some(place));
            }
        }
        targets
    }

    /// `margin:edge`, `t`: the name in the table.
    pub fn name(self, info: &KernelInfo) -> String {
        match self.gate {
            Some(gate) => format!("{}:{}", self.objective.name(), info.gates[gate].name),
            None => self.objective.name().to_owned(),
        }
    }

    /// The target of a name.
    pub fn find(name: &str, info: &KernelInfo) -> Option<SearchTarget> {
        let mut targets = SearchTarget::of_kernel(info).into_iter();
        targets.find(|target| target.name(info) == name)
    }
}

/// Scores cases for one row, target and domain.
pub struct Scorer<'a, F> {
    row: &'a Row,
    epsilons: Vec<F>,
    target: SearchTarget,
    domain: SearchDomain,
}

/// A substitute that a search climbs on where there is no score: below every score, and lower the farther
/// the line passes from the triangle's boundary, where findings are.
fn no_score_yet(in_space: f64) -> f64 {
    if in_space.is_finite() {
        -1.0 - in_space
    } else {
        f64::MIN
    }
}

impl<'a, F: Scalar> Scorer<'a, F> {
    /// A kernel with its epsilons, judged by the row's contract.
    pub fn new(row: &'a Row, target: SearchTarget, domain: SearchDomain) -> Self {
        Scorer {
            row,
            epsilons: row.epsilons(),
            target,
            domain,
        }
    }

    /// A score in `f64`. An `f32` case is compared with the same kernel and formulas in `f64`, an `f64` case with exact
    /// numbers. The score is negative where there is nothing to score, and minus infinity outside the domain.
    pub fn quick(&self, case: &Case<F>) -> f64 {
        if !self.domain.holds_quickly(case) {
            return f64::NEG_INFINITY;
        }
        let score = match self.target.objective {
            Objective::Margin if is_narrow::<F>() => self.quick_margin(case),
            Objective::T | Objective::Uv if is_narrow::<F>() => self.quick_value(case),
            Objective::Margin => self.exact_margin(case).as_ref().map(nearest),
            Objective::T | Objective::Uv => self.exact_value(case).as_ref().map(nearest),
            Objective::WrongValue => self.quick_times(case),
            Objective::FalseMiss | Objective::FalseHit => return self.quick_severity(case),
        };
        score.filter(|score| !score.is_nan()).unwrap_or(-1.0)
    }

    /// The exact score; none where there is nothing to score, or outside the domain.
    pub fn exact(&self, case: &Case<F>) -> Option<Exact> {
        if !self.domain.holds(case) {
            return None;
        }
        match self.target.objective {
            Objective::Margin => self.exact_margin(case),
            Objective::T | Objective::Uv => self.exact_value(case),
            Objective::WrongValue => {
                let (_, verdict) = self.hit_with_values(case)?;
                finite(exact_times(case, self.row.entry.info.gives, &verdict))
            }
            Objective::FalseMiss | Objective::FalseHit => {
                let (truth, verdict, finding) = verdict_and_finding(self.row, &self.epsilons, case);
                finding.filter(|finding| self.wants(*finding, &truth, &verdict, case))?;
                exact_to_change(case, &truth, &self.row.contract)
            }
        }
    }

    /// The threshold of the target's gate, if the gate is reached and the threshold is finite. Thresholds
    /// are compared, not margins: the margin of a gate `x <= e` is the float below x, and an exact number has none.
    fn reached_threshold(&self, case: &Case<F>) -> Option<Threshold<F>> {
        let gate = self.target.gate?;
        let gated = F::subject(self.row.entry)?.gated()?;
        let margins = gated.measure(case).margins;
        if refused_by(&margins, &self.epsilons).is_some_and(|refused| refused < gate) {
            return None;
        }
        let value = gated.thresholds(case)[gate];
        value.is_finite().then_some(Threshold { gate, value })
    }

    fn quick_margin(&self, case: &Case<F>) -> Option<f64> {
        let Threshold { gate, value } = self.reached_threshold(case)?;
        let wide = case.widen();
        let exact = f64::subject(self.row.entry)?.gated()?.thresholds(&wide)[gate];
        let scale = scale(&wide.ray, &wide.triangle, self.dimension(gate));
        let unit = scale.max(exact.abs()) * F::EPSILON.to_f64();
        finite((value.to_f64() - exact).abs() / unit)
    }

    fn exact_margin(&self, case: &Case<F>) -> Option<Exact> {
        let Threshold { gate, value } = self.reached_threshold(case)?;
        let gated = F::subject(self.row.entry)?.gated()?;
        let exact = gated.measure_exact(case).margins.swap_remove(gate);
        let (ray, triangle) = case.exact();
        let scale = scale(&ray, &triangle, self.dimension(gate));
        let unit = larger(scale, exact.abs()) * of(F::EPSILON);
        finite((of(value) - exact).abs() / unit)
    }

    /// The least unit in which the error of a gate's margin is counted on a case.
    pub fn unit_of_margin(&self, case: &Case<F>, gate: usize) -> f64 {
        let wide = case.widen();
        scale(&wide.ray, &wide.triangle, self.dimension(gate)) * F::EPSILON.to_f64()
    }

    fn dimension(&self, gate: usize) -> Dimension {
        self.row.entry.info.gates[gate].dimension
    }

    /// The verdict, if it is a hit that is not false, on a transversal case.
    fn true_hit(&self, case: &Case<F>) -> Option<Verdict<F>> {
        let (truth, verdict, finding) = verdict_and_finding(self.row, &self.epsilons, case);
        truth.crossing()?;
        let is_true = verdict.hit && finding != Some(Finding::FalseHit);
        is_true.then_some(verdict)
    }

    /// The truth and the verdict of a hit that is not false, with finite values, at a point of the triangle.
    fn hit_with_values(&self, case: &Case<F>) -> Option<(Truth, Verdict<F>)> {
        let verdict = self.true_hit(case)?;
        let truth = oracle::truth(case);
        if truth.crossing()?.feature == Feature::Outside {
            return None;
        }
        let values = [verdict.t, verdict.u, verdict.v];
        values.iter().all(F::is_finite).then_some((truth, verdict))
    }

    fn quick_times(&self, case: &Case<F>) -> Option<f64> {
        let (truth, verdict) = self.hit_with_values(case)?;
        let times = ValueErrors::of(case, &truth, self.row.entry.info.gives, &verdict).times;
        finite(times.into_iter().flatten().fold(0.0, f64::max))
    }

    fn quick_value(&self, case: &Case<F>) -> Option<f64> {
        let verdict = self.true_hit(case)?;
        let wide = case.widen();
        let [t, u, v] = values(&wide.ray, &wide.triangle);
        let error = |computed: F, exact: f64| (computed.to_f64() - exact).abs();
        if self.target.objective != Objective::T {
            let worst = error(verdict.u, u).max(error(verdict.v, v));
            return finite(worst / F::EPSILON.to_f64());
        }
        // A t of zero has no ulp to count in.
        if t == 0.0 {
            return None;
        }
        finite(error(verdict.t, t) / F::from_f64(t).ulp().to_f64())
    }

    fn exact_value(&self, case: &Case<F>) -> Option<Exact> {
        let verdict = self.true_hit(case)?;
        let (ray, triangle) = case.exact();
        let [t, u, v] = values(&ray, &triangle);
        let error = |computed: F, exact: &Exact| (of(computed) - exact).abs();
        if self.target.objective != Objective::T {
            let worst = larger(error(verdict.u, &u), error(verdict.v, &v));
            return finite(worst / of(F::EPSILON));
        }
        if t.is_zero() {
            return None;
        }
        let ulp = F::from_f64(t.approximate()).ulp();
        finite(error(verdict.t, &t) / of(ulp))
    }

    /// The error of t over the exact t, of a case that a `t` target scores.
    pub fn relative_error_of_t(&self, case: &Case<F>) -> Option<f64> {
        let verdict = self.true_hit(case)?;
        let (ray, triangle) = case.exact();
        let [t, ..] = values(&ray, &triangle);
        let error = (of(verdict.t) - &t).abs();
        Some((error / t.abs()).approximate())
    }

    fn quick_severity(&self, case: &Case<F>) -> f64 {
        let (truth, verdict, finding) = verdict_and_finding(self.row, &self.epsilons, case);
        if truth == Truth::Invalid {
            return f64::MIN;
        }
        let distances = Distances::of(case, &truth);
        match finding.filter(|finding| self.wants(*finding, &truth, &verdict, case)) {
            Some(_) => distances.nearest_change(&truth, &self.row.contract),
            None => no_score_yet(distances.in_space),
        }
    }

    /// True if a finding is of the target's kind, by the target's gate.
    fn wants(&self, finding: Finding, truth: &Truth, verdict: &Verdict<F>, case: &Case<F>) -> bool {
        match (self.target.objective, finding) {
            (Objective::FalseMiss, Finding::FalseMiss) => {
                verdict.refused_by.map(usize::from) == self.target.gate
            }
            (Objective::FalseHit, Finding::FalseHit) => self.wants_false_hit(truth, case),
            _ => false,
        }
    }

    /// True if the target's gate is the first that refuses without rounding. A hit before or beyond the extent counts only
    /// at a gate on t.
    fn wants_false_hit(&self, truth: &Truth, case: &Case<F>) -> bool {
        let Some(gate) = self.target.gate else {
            return false;
        };
        let extent = self.row.contract.extent;
        let crossing = truth.crossing();
        let is_off_end = crossing.is_some_and(|crossing| !is_in_extent(crossing, extent));
        if is_off_end && self.row.entry.info.gates[gate].role != Role::T {
            return false;
        }
        exactly_refusing(self.row, &self.epsilons, case) == Some(gate)
    }
}

/// A gate, and the threshold of its epsilon on a case.
struct Threshold<F> {
    gate: usize,
    value: F,
}

/// The first gate that refuses in exact arithmetic; none if the formula without rounding hits.
fn exactly_refusing<F: Scalar>(row: &Row, epsilons: &[F], case: &Case<F>) -> Option<usize> {
    let gated = F::subject(row.entry)?.gated()?;
    gated.run_exact(case, epsilons).refused_by()
}

/// The truth, the kernel's verdict, and the finding if they disagree. Cases are judged one by one:
/// nothing is demanded of a secondary ray on the triangle that it starts on.
pub fn verdict_and_finding<F: Scalar>(
    row: &Row,
    epsilons: &[F],
    case: &Case<F>,
) -> (Truth, Verdict<F>, Option<Finding>) {
    let mut verdict = Verdict::miss(None);
    // A kernel that does not run in this scalar misses.
    if let Some(subject) = F::subject(row.entry) {
        let verdicts = slice::from_mut(&mut verdict);
        subject.run(slice::from_ref(case), epsilons, verdicts);
    }
    let truth = oracle::truth(case);
    let obligation = asked(case, &truth, &row.contract, false);
    let demand = (&row.contract, obligation);
    let finding = judge(demand, (case, &truth), row.entry.info.gives, &verdict);
    (truth, verdict, finding)
}

/// True if `f64` has digits and range to spare for products of a scalar's numbers.
fn is_narrow<F: Float>() -> bool {
    2 * F::DIGITS <= f64::DIGITS
}

fn of<F: Float>(value: F) -> Exact {
    Exact::from_f64(value.to_f64())
}

/// A score as a float; beyond the floats there is still something to climb on.
fn nearest(value: &Exact) -> f64 {
    if value.is_finite() {
        value.approximate().min(f64::MAX)
    } else {
        f64::NAN
    }
}

/// A gate's scale on a case: E^p·|d|^q.
pub fn scale<V: Vector>(ray: &Ray<V>, triangle: &Triangle<V>, dimension: Dimension) -> V::Real {
    let Triangle { a, b, c } = triangle;
    let o = &ray.origin;
    let mut extent = V::Real::zero();
    for (p, q) in [(o, a), (o, b), (o, c), (a, b), (a, c), (b, c)] {
        extent = larger(extent, largest_component(&p.minus(q)));
    }
    let direction = largest_component(&ray.direction);
    power(&extent, dimension.length) * power(&direction, dimension.direction)
}

fn largest_component<V: Vector>(vector: &V) -> V::Real {
    let mut largest = V::Real::zero();
    for axis in 0..3 {
        largest = larger(largest, vector.at(axis).abs());
    }
    largest
}

/// A score that counts: one that is finite.
fn finite<R: Real>(score: R) -> Option<R> {
    score.is_finite().then_some(score)
}

fn power<R: Real>(base: &R, exponent: i8) -> R {
    let product = (0..exponent.unsigned_abs()).fold(R::one(), |product, _| product * base);
    if exponent < 0 {
        R::one() / product
    } else {
        product
    }
}
