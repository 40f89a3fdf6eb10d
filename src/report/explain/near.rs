//! Cases like a given one, with a kernel's answers to them: by what it does there a mistake is known.

use super::ExplainedRow;
use crate::arith::Float;
use crate::audit::{Attribution, Relations, Row};
use crate::case::{Case, Draw};
use crate::kernel::{Scalar, Subject, Verdict, verdicts_of};

/// How many cases are drawn around the given one.
const DRAWN: usize = 1_000;

/// How often the given case is scaled, and by how many steps to the octave: between 2^-32 and 2^32.
const SCALED: i32 = 1_024;
const STEPS: f64 = 16.0;

/// Cases like a given one, and a kernel's answers.
pub(super) struct Nearby<F: Scalar> {
    /// Drawn around it.
    pub drawn: Vec<Case<F>>,
    /// One a drawn case.
    pub answers: Vec<Verdict<F>>,
    /// The case in other sizes, with the answers: between two of them is the size at which an epsilon begins to refuse.
    pub scaled: Vec<(Case<F>, Verdict<F>)>,
}

impl<F: Scalar> Nearby<F> {
    /// The answers of a row around a case; none if the kernel does not run in this scalar, or would print something each
    /// time.
    pub fn of(case: &Case<F>, row: &Row) -> Option<Nearby<F>> {
        let subject = F::subject(row.entry).filter(|subject| !subject.talks())?;
        let mut draw = Draw::new("nearest", 1, 0);
        let drawn: Vec<Case<F>> = (0..DRAWN)
            .map(|i| near(case, [i % 2 == 1, i % 4 < 2], &mut draw))
            .collect();
        let sizes: Vec<Case<F>> = (-SCALED / 2..SCALED / 2)
            .map(|step| scaled(case, f64::from(step) / STEPS))
            .collect();
        let answers = run(subject, &drawn, row);
        let scaled_answers = run(subject, &sizes, row);
        let scaled = sizes.into_iter().zip(scaled_answers).collect();
        Some(Nearby {
            drawn,
            answers,
            scaled,
        })
    }

    /// The simple relations that hold there between the wrong answers of a row and the exact values.
    pub fn relations(&self, row: &Row) -> Vec<String> {
        let gives = row.entry.info.gives;
        let relations = Relations::of(&self.drawn, &row.contract, gives, &self.answers);
        let known = relations.known().into_iter();
        known
            .map(|related| format!("{related} like this one"))
            .collect()
    }
}

/// Adds simple relations that hold near the case: where nothing else is known of the cause, they are the cause.
pub(super) fn add_relations(
    part: &mut ExplainedRow,
    relations: Vec<String>,
    cause: Option<Attribution>,
) {
    match cause {
        None | Some(Attribution::NotEpsilon) if !relations.is_empty() => {
            part.why = Some(relations.join("; "));
        }
        _ => part.notes.extend(relations),
    }
}

/// The verdicts of a row's kernel.
pub(super) fn run<F: Scalar>(
    subject: &dyn Subject<F>,
    cases: &[Case<F>],
    row: &Row,
) -> Vec<Verdict<F>> {
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    verdicts_of(subject, cases, &row.epsilons::<F>(), &mut verdicts);
    verdicts
}

/// The case with every length multiplied by a power of two, which need not be whole.
fn scaled<F: Float>(case: &Case<F>, power: f64) -> Case<F> {
    let factor = 2f64.powf(power);
    let [origin, direction, a, b, c] = case.vectors();
    let times = |x: F| F::from_f64(x.to_f64() * factor);
    let [origin, a, b, c] = [origin, a, b, c].map(|point| point.map(times));
    Case::new(origin, direction, [a, b, c]).on(times(case.ray.t_min), times(case.ray.t_max))
}

/// The case with every number moved by the same part of its triangle, or of the direction: from one unit in the last place to
/// all of it. In ordinary sizes if asked, because what an epsilon refuses in small triangles is a hit there; and from the other side.
fn near<F: Float>(case: &Case<F>, [ordinary, turned]: [bool; 2], draw: &mut Draw) -> Case<F> {
    let [o, d, a, b, c] = case.vectors();
    let [b, c] = if turned { [c, b] } else { [b, c] };
    let largest =
        |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, |m: f64, x| m.max(x.abs()));
    let sides = [b, c].map(|vertex| [0, 1, 2].map(|i| (vertex[i] - a[i]).to_f64()));
    let size = largest(&mut sides.into_iter().flatten());
    let length = largest(&mut d.into_iter().map(F::to_f64));
    // Powers of two change no rounding.
    let power = |size: f64| match ordinary && size.is_normal() {
        true => 2f64.powi(-size.log2().floor() as i32),
        false => 1.0,
    };
    let (of_size, of_length) = (power(size), power(length));
    let part = 2f64.powi(-(draw.below(F::DIGITS as usize) as i32));
    let mut moved = |vector: [F; 3], size: f64, power: f64| {
        vector.map(|x| {
            let by = draw.symmetric::<F>().to_f64() * size * part;
            F::from_f64((x.to_f64() + by) * power)
        })
    };
    let [o, a, b, c] = [o, a, b, c].map(|point| moved(point, size, of_size));
    let ends = [case.ray.t_min, case.ray.t_max];
    let [t_min, t_max] = ends.map(|t| F::from_f64(t.to_f64() * of_size / of_length));
    Case::new(o, moved(d, length, of_length), [a, b, c]).on(t_min, t_max)
}
