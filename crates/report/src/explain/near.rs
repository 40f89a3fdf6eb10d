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

    /// All cases with their answers.
    pub fn all(&self) -> impl Iterator<Item = (&Case<F>, &Verdict<F>)> {
        let drawn = self.drawn.iter().zip(&self.answers);
        drawn.chain(self.scaled.iter().map(|(case, answer)| (case, answer)))
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
            part.cause = relations.join("; ");
            part.why = Some(part.cause.clone());
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
    let times = |x: F| F::from_f64(x.to_f64() * factor);
    let [origin, direction, a, b, c] = case.vectors();
    let triangle = [a, b, c].map(|vertex| vertex.map(times));
    let larger = Case::new(origin.map(times), direction, triangle);
    larger.on(times(case.ray.t_min), times(case.ray.t_max))
}

/// How the numbers of one kind, points or directions, are moved.
struct Move {
    /// A number moves by at most this.
    most: f64,
    /// It is multiplied with this after that: a power of two, which changes no rounding.
    factor: f64,
}

impl Move {
    fn apply<F: Float>(&self, vector: [F; 3], draw: &mut Draw) -> [F; 3] {
        vector.map(|x| {
            let by = draw.symmetric::<F>().to_f64() * self.most;
            F::from_f64((x.to_f64() + by) * self.factor)
        })
    }
}

/// The case with every number moved by the same part of its triangle, or of the direction: from one unit in the last place to
/// all of it. In ordinary sizes if asked, because what an epsilon refuses in small triangles is a hit there; and from the other
/// side.
fn near<F: Float>(case: &Case<F>, [ordinary, turned]: [bool; 2], draw: &mut Draw) -> Case<F> {
    let [origin, direction, a, b, c] = case.vectors();
    let triangle = if turned { [a, c, b] } else { [a, b, c] };
    let size = triangle_size(triangle);
    let length = largest(direction.map(F::to_f64));
    // The numbers of a scalar have so many binary digits: the part is one of them.
    let digit = draw.below(F::DIGITS as usize) as i32;
    let part = 2f64.powi(-digit);
    let of = |size: f64| Move {
        most: size * part,
        factor: if ordinary { to_about_one(size) } else { 1.0 },
    };
    let (points, directions) = (of(size), of(length));
    let origin = points.apply(origin, draw);
    let triangle = triangle.map(|vertex| points.apply(vertex, draw));
    let direction = directions.apply(direction, draw);
    let end = |t: F| F::from_f64(t.to_f64() * points.factor / directions.factor);
    Case::new(origin, direction, triangle).on(end(case.ray.t_min), end(case.ray.t_max))
}

fn largest(numbers: [f64; 3]) -> f64 {
    numbers.into_iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The largest coordinate of the two edges at the first vertex.
fn triangle_size<F: Float>([a, b, c]: [[F; 3]; 3]) -> f64 {
    let edge = |to: [F; 3]| [0, 1, 2].map(|i| (to[i] - a[i]).to_f64());
    largest(edge(b)).max(largest(edge(c)))
}

/// The power of two that makes a size at least 1 and less than 2; 1 where there is none.
fn to_about_one(size: f64) -> f64 {
    if size.is_normal() {
        2f64.powi(-size.log2().floor() as i32)
    } else {
        1.0
    }
}
