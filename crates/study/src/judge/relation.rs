//! Simple relations between the answers of a kernel and the exact values, by which a mistake is known: t is twice the exact
//! t, u and v are exchanged, t_min is ignored.

mod miss;

pub use miss::{MISSES, is_hit_far_beside, stands_for_miss};

use super::distance::Distances;
use super::values::{ALLOWANCE, Allowed, given_values, length, roundoff};
use super::{Obligation, obligation};
use crate::arith::{Bounded, Exact, Float, Real, bounded};
use crate::case::Case;
use crate::contract::Contract;
use crate::kernel::{Gives, Verdict};
use crate::oracle;
use crate::truth::{Crossing, Feature, Place, Truth};
use glam::DVec3;
use std::cmp::Ordering;

named! {
    pub names
    /// A simple relation between wrong answers and the exact values. Its documentation is the sentence about it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Relation {
        /// t is twice the exact t.
        TwiceT = "t-twice",
        /// t is half the exact t.
        HalfT = "t-half",
        /// t has the opposite sign.
        OppositeT = "t-opposite",
        /// t is t*|d|.
        LengthT = "t-times-length",
        /// t is t*|d|^2.
        SquaredLengthT = "t-times-squared-length",
        /// t is t/|d|.
        OverLengthT = "t-over-length",
        /// t is t - t_min.
        FromStartT = "t-less-t-min",
        /// t is (t - t_min)/(t_max - t_min).
        ShareT = "t-in-interval",
        /// t is clamped to t_max.
        ClampedT = "t-clamped",
        /// u and v are exchanged.
        Exchanged = "u-v-exchanged",
        /// u is the weight of a (1 - u - v).
        WeightAForU = "w-for-u",
        /// v is the weight of a (1 - u - v).
        WeightAForV = "w-for-v",
        /// u and v are the weights of a and b.
        WeightsOfAb = "weights-of-a-b",
        /// u and v are the weights of c and a.
        WeightsOfCa = "weights-of-c-a",
        /// t, u and v are computed in f32.
        InF32 = "in-f32",
        /// t, u and v are those of the previous answer.
        Previous = "previous-answer",
        /// it takes |t| for t.
        AbsoluteT = "t-absolute",
        /// it ignores t_min.
        IgnoresTMin = "t-min-ignored",
        /// it takes 0 for t_min.
        ZeroTMin = "t-min-zero",
        /// it takes 0 for a t_min below 0.
        ClampedTMin = "t-min-clamped",
        /// it ignores t_max.
        IgnoresTMax = "t-max-ignored",
        /// it reports a miss as a hit with t = -1.
        MinusOneForMiss = "minus-one-for-miss",
        /// it reports a miss as a hit with t = NaN.
        NanForMiss = "nan-for-miss",
        /// it reports a miss as a hit with an infinite t.
        InfiniteForMiss = "infinite-for-miss",
        /// it reports a miss as a hit with a huge t.
        HugeForMiss = "huge-for-miss",
    }
}

/// The part of an answer that a relation is about. Of those about one part only one is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// t.
    T,
    /// u and v.
    Weights,
    /// All values of a hit.
    Values,
    /// Hit or miss, by the start of the interval.
    Start,
    /// Hit or miss, by the end of the interval.
    End,
    /// A miss, and how it is told.
    Miss,
}

impl Part {
    /// The cases that show if a relation about this part is true.
    pub fn cases(self) -> &'static str {
        match self {
            Part::T => "hits with a wrong t",
            Part::Weights => "hits with a wrong u or v",
            Part::Values => "hits with wrong values",
            Part::Start | Part::End => "cases where that changes the answer",
            Part::Miss => "hits far beside a triangle",
        }
    }
}

impl Relation {
    /// The part of an answer that it is about.
    pub fn part(self) -> Part {
        match self {
            Relation::TwiceT
            | Relation::HalfT
            | Relation::OppositeT
            | Relation::LengthT
            | Relation::SquaredLengthT
            | Relation::OverLengthT
            | Relation::FromStartT
            | Relation::ShareT
            | Relation::ClampedT => Part::T,
            Relation::Exchanged
            | Relation::WeightAForU
            | Relation::WeightAForV
            | Relation::WeightsOfAb
            | Relation::WeightsOfCa => Part::Weights,
            Relation::InF32 | Relation::Previous => Part::Values,
            Relation::AbsoluteT
            | Relation::IgnoresTMin
            | Relation::ZeroTMin
            | Relation::ClampedTMin => Part::Start,
            Relation::IgnoresTMax => Part::End,
            Relation::MinusOneForMiss
            | Relation::NanForMiss
            | Relation::InfiniteForMiss
            | Relation::HugeForMiss => Part::Miss,
        }
    }
}

/// The values u and v stand for in each relation about them, by their places in the weights of a, b and c.
const WEIGHTS: [(Relation, [usize; 2]); 5] = [
    (Relation::Exchanged, [2, 1]),
    (Relation::WeightAForU, [0, 2]),
    (Relation::WeightAForV, [1, 0]),
    (Relation::WeightsOfAb, [0, 1]),
    (Relation::WeightsOfCa, [2, 0]),
];

/// Wrong values of a hit, and the relations that they have to the exact ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RelatedValues {
    /// The parts that are wrong: [`Part::T`], [`Part::Weights`], and [`Part::Values`] if any is.
    pub wrong: Vec<Part>,
    /// The relations that hold.
    pub holding: Vec<Relation>,
}

impl RelatedValues {
    /// The relations of a hit with finite values, on a line that crosses the plane, by a kernel that gives these values;
    /// errors up to a contract's tolerance are not wrong.
    pub fn of<F: Float>(
        case: &Case<F>,
        gives: Gives,
        verdict: &Verdict<F>,
        tolerance: f64,
    ) -> RelatedValues {
        let hit = HitValues {
            case,
            gives,
            verdict,
            tolerance,
        };
        let in_bounds = bounded(|| hit.related(&Allowed::<Bounded>::of(case)));
        in_bounds.unwrap_or_else(|| hit.related(&Allowed::<Exact>::of(case)))
    }
}

/// The values of a hit.
struct HitValues<'a, F: Float> {
    case: &'a Case<F>,
    gives: Gives,
    verdict: &'a Verdict<F>,
    tolerance: f64,
}

impl<F: Float> HitValues<'_, F> {
    fn related<R: Real>(&self, allowed: &Allowed<R>) -> RelatedValues {
        let is_wrong = |which: usize| {
            let values = given_values(self.gives, self.verdict);
            let value = values.into_iter().find(|(place, _)| *place == which);
            value.is_some_and(|value| !allowed.admits_all(&[value], self.tolerance))
        };
        let mut related = RelatedValues {
            wrong: Vec::new(),
            holding: Vec::new(),
        };
        if is_wrong(0) {
            related.wrong.push(Part::T);
            related.holding.extend(self.of_t(allowed));
        }
        if is_wrong(1) || is_wrong(2) {
            related.wrong.push(Part::Weights);
            related.holding.extend(self.of_weights(allowed));
        }
        if !related.wrong.is_empty() {
            related.wrong.push(Part::Values);
            related
                .holding
                .extend(self.is_in_f32(allowed).then_some(Relation::InF32));
        }
        related
    }

    /// The relations of t. Each is a line: t is `factor`·(exact t - `start`).
    fn of_t<R: Real>(&self, allowed: &Allowed<R>) -> Vec<Relation> {
        let [t_min, t_max] = [self.case.ray.t_min, self.case.ray.t_max].map(F::to_f64);
        let length = length(self.case.widen().vectors()[1]);
        let lines = [
            (Relation::TwiceT, 2.0, 0.0),
            (Relation::HalfT, 0.5, 0.0),
            (Relation::OppositeT, -1.0, 0.0),
            (Relation::LengthT, length, 0.0),
            (Relation::SquaredLengthT, length * length, 0.0),
            (Relation::OverLengthT, 1.0 / length, 0.0),
            (Relation::FromStartT, 1.0, t_min),
            (Relation::ShareT, 1.0 / (t_max - t_min), t_min),
        ];
        let t = R::number(self.verdict.t.to_f64());
        let holds = |factor: f64, start: f64| {
            let is_number = factor.is_normal() && start.is_finite();
            is_number && {
                let start = R::number(start);
                let factor = R::number(factor);
                let expected = (allowed.exact[0].clone() - &start) * &factor;
                let rounding = start.abs() * R::number(roundoff::<F>());
                let unit = (rounding + &allowed.unit[0]) * factor.abs();
                is_near(&t, expected, unit)
            }
        };
        let held = lines
            .into_iter()
            .filter(|(_, factor, start)| holds(*factor, *start));
        let mut holding: Vec<Relation> = held.map(|(relation, ..)| relation).collect();
        if self.verdict.t == self.case.ray.t_max {
            holding.push(Relation::ClampedT);
        }
        holding
    }

    fn of_weights<R: Real>(&self, allowed: &Allowed<R>) -> Vec<Relation> {
        let [_, u, v] = &allowed.exact;
        let weights = [R::one() - u - v, u.clone(), v.clone()];
        let unit = allowed.unit[1].clone() + &allowed.unit[2];
        let found = [self.verdict.u, self.verdict.v].map(|x| R::number(x.to_f64()));
        let stands_for = |place: usize, weight: usize| {
            is_near(&found[place], weights[weight].clone(), unit.clone())
        };
        let holds = |[for_u, for_v]: [usize; 2]| stands_for(0, for_u) && stands_for(1, for_v);
        let held = WEIGHTS.into_iter().filter(|(_, weights)| holds(*weights));
        held.map(|(relation, _)| relation).collect()
    }

    /// True if every value is a number of f32, as near to the exact one as rounding in f32 may leave it.
    fn is_in_f32<R: Real>(&self, allowed: &Allowed<R>) -> bool {
        /// The roundoff of f32 in units of that of f64.
        const COARSER: f64 = (1u64 << 29) as f64;
        F::NAME == f64::NAME
            && given_values(self.gives, self.verdict)
                .into_iter()
                .all(|(which, value)| {
                    let unit = R::number(COARSER) * &allowed.unit[which];
                    let exact = allowed.exact[which].clone();
                    f64::from(value as f32) == value && is_near(&R::number(value), exact, unit)
                })
    }
}

/// True if a number is as near to an expected one as [`ALLOWANCE`] units.
fn is_near<R: Real>(found: &R, expected: R, unit: R) -> bool {
    let off = (expected - found).abs();
    off.is_at_most(&(R::number(ALLOWANCE) * unit))
}

/// How far, in longest edges, a case must be from where its obligation changes, and from the triangle's boundary, to show how
/// the interval is read: nearer to either rounding decides.
const CLEAR: f64 = 1.0 / 1024.0;

/// A sine, a weight and a share of t from which on a case is plain.
const PLAIN: f64 = 1.0 / 64.0;

/// The relations about hit or miss that demand another answer to a case than its contract, each with what it demands. The
/// contract demands something there.
pub fn other_demands<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    contract: &Contract,
) -> Vec<(Relation, Obligation)> {
    let Some(crossing) = truth.crossing().filter(|it| it.feature != Feature::Outside) else {
        return Vec::new();
    };
    let owed = obligation(truth, contract, false);
    let others = Relation::ALL.into_iter().filter_map(|relation| {
        let crossing = as_taken(relation, case, crossing)?;
        let other = obligation(&Truth::Transversal(crossing), contract, false);
        let is_other = other != owed && owed != Obligation::Free && other != Obligation::Free;
        is_other.then_some((relation, other))
    });
    let others: Vec<(Relation, Obligation)> = others.collect();
    let is_clear = || {
        let distances = Distances::of(case, truth);
        let nearest = distances.nearest_change(truth, contract);
        CLEAR <= distances.in_space.min(nearest)
    };
    if others.is_empty() || !is_clear() {
        return Vec::new();
    }
    others
}

/// True if a line passes so steeply and so clearly inside or outside a triangle that no kernel errs by rounding, nor by an epsilon
/// that anybody would choose. In `f64`, so that it costs little: it decides what a kernel's mistake is called and no verdict.
pub fn is_plain<F: Float>(case: &Case<F>) -> bool {
    let [origin, direction, a, b, c] = case.widen().vectors().map(DVec3::from);
    let normal = (b - a).cross(c - a);
    let det = normal.dot(direction);
    let is_steep = PLAIN * normal.length() * direction.length() < det.abs();
    let s = origin - a;
    let v = (b - a).cross(s).dot(direction) / det;
    let u = s.cross(c - a).dot(direction) / det;
    let weights = [1.0 - u - v, u, v];
    let is_inside = weights.iter().all(|weight| PLAIN < *weight);
    let is_outside = weights.iter().any(|weight| *weight < -PLAIN);
    let t = -normal.dot(s) / det;
    let ends = [case.ray.t_min, case.ray.t_max].map(F::to_f64);
    let is_away = |end: f64| PLAIN * t.abs() < (t - end).abs();
    is_steep && t.is_normal() && (is_outside || is_inside && ends.into_iter().all(is_away))
}

/// A crossing as a kernel takes it of which a relation is true; none if the relation changes no answer to the case.
fn as_taken<F: Float>(relation: Relation, case: &Case<F>, crossing: &Crossing) -> Option<Crossing> {
    let is_negative = crossing.t_sign == Ordering::Less;
    let is_before = matches!(crossing.place, Place::Before | Place::AtMin);
    let at = |place: Place| Some(Crossing { place, ..*crossing });
    match relation {
        Relation::AbsoluteT if is_negative => {
            let [origin, direction, a, b, c] = case.vectors();
            let Case { ray, .. } = case;
            let turned = Case::new(origin, direction.map(|x| -x), [a, b, c]);
            let truth = oracle::truth(&turned.on(ray.t_min, ray.t_max));
            let place = truth.crossing()?.place;
            Some(Crossing {
                place,
                t_sign: Ordering::Greater,
                ..*crossing
            })
        }
        Relation::IgnoresTMin if is_before => Some(Crossing {
            place: Place::Within,
            t_sign: Ordering::Greater,
            ..*crossing
        }),
        Relation::ZeroTMin if is_before && !is_negative => at(Place::Within),
        Relation::ZeroTMin | Relation::ClampedTMin if !is_before && is_negative => {
            at(Place::Before)
        }
        Relation::IgnoresTMax if matches!(crossing.place, Place::Beyond | Place::AtMax) => {
            at(Place::Within)
        }
        _ => None,
    }
}

/// True if a verdict is what a relation demands of a case with this truth; of a hit behind the origin also if the t that it
/// reports has the sign that the relation gives it.
pub fn answers_as<F: Float>(
    relation: Relation,
    demand: Obligation,
    truth: &Truth,
    gives: Gives,
    verdict: &Verdict<F>,
) -> bool {
    if verdict.hit != (demand == Obligation::MustHit) {
        return false;
    }
    let is_behind = truth
        .crossing()
        .is_some_and(|it| it.t_sign == Ordering::Less);
    if !verdict.hit || !gives.t || !is_behind {
        return true;
    }
    let is_positive = verdict.t > F::zero();
    is_positive == (relation == Relation::AbsoluteT)
}

#[cfg(test)]
mod tests;
