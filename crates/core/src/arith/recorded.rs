//! Numbers that write down what is computed with them: a kernel that runs on them leaves its
//! straight-line program.
//!
//! A number is a place on a tape of operations, one tape a thread. The same operation on the same places
//! is written once. A comparison has no value to look at, so it follows a script: running a kernel again
//! with another script leads along another path. Products are fused into sums, and sums are rearranged, as in
//! [`Emulated`](super::Emulated).

mod sums;

use super::rearranged::Operand;
use super::{Arithmetic, Real};
use std::cell::RefCell;
use std::collections::HashMap;
use std::mem;
use sums::{Signed, rearranged};

/// A place on the tape.
pub type Place = u32;

/// One operation; the operands come earlier on the tape. All but `Input`, `Number`, `Neg` and `Abs` round
/// once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation<P = Place> {
    /// One of the seventeen numbers of a case, in the order of `Case::hex`.
    Input(u8),
    /// A small whole number.
    Number(i32),
    /// `a + b`.
    Add(P, P),
    /// `a - b`.
    Sub(P, P),
    /// `a * b`.
    Mul(P, P),
    /// `a / b`.
    Div(P, P),
    /// `-a`, exact.
    Neg(P),
    /// `|a|`, exact.
    Abs(P),
    /// The square root.
    Sqrt(P),
    /// `a*b + c`, rounded once.
    Fma(P, P, P),
    /// `a*b - c*d`, in wider arithmetic, then rounded to the format.
    Minor(P, P, P, P),
}

/// An operand or a product of two, which an operation adds up; true if it subtracts it.
pub type Term<P> = (bool, P, Option<P>);

impl<P: Copy> Operation<P> {
    /// A stand-in for infinity. No program that uses it is analysed.
    pub const INFINITY: Operation<P> = Operation::Number(i32::MAX);

    /// The terms that it adds up; none of what is no sum, no difference and no product.
    pub fn terms(&self) -> impl Iterator<Item = Term<P>> + use<P> {
        use Operation::*;
        let product = |is_minus, a, b| Some((is_minus, a, Some(b)));
        let terms = match *self {
            Neg(a) => [Some((true, a, None)), None],
            Add(a, b) => [a, b].map(|a| Some((false, a, None))),
            Sub(a, b) => [Some((false, a, None)), Some((true, b, None))],
            Mul(a, b) => [product(false, a, b), None],
            Fma(a, b, c) => [product(false, a, b), Some((false, c, None))],
            Minor(a, b, c, d) => [product(false, a, b), product(true, c, d)],
            Input(_) | Number(_) | Div(..) | Abs(_) | Sqrt(_) => [None, None],
        };
        terms.into_iter().flatten()
    }

    /// Its operands.
    pub fn operands(&self) -> Vec<P> {
        let mut operands = Vec::new();
        self.with(|place| {
            operands.push(place);
            place
        });
        operands
    }

    /// The same with other operands.
    pub fn with<Q>(&self, mut of: impl FnMut(P) -> Q) -> Operation<Q> {
        use Operation::*;
        match *self {
            Input(i) => Input(i),
            Number(value) => Number(value),
            Add(a, b) => Add(of(a), of(b)),
            Sub(a, b) => Sub(of(a), of(b)),
            Mul(a, b) => Mul(of(a), of(b)),
            Div(a, b) => Div(of(a), of(b)),
            Neg(a) => Neg(of(a)),
            Abs(a) => Abs(of(a)),
            Sqrt(a) => Sqrt(of(a)),
            Fma(a, b, c) => Fma(of(a), of(b), of(c)),
            Minor(a, b, c, d) => Minor(of(a), of(b), of(c), of(d)),
        }
    }
}

/// A comparison of numbers on the tape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Comparison {
    /// `a < b`.
    Less(Place, Place),
    /// `a <= b`.
    AtMost(Place, Place),
    /// `a == 0`.
    Zero(Place),
    /// The sign bit of a.
    Negative(Place),
}

impl Comparison {
    /// The compared numbers.
    pub fn places(&self) -> Vec<Place> {
        let mut places = Vec::new();
        self.with(|place| {
            places.push(place);
            place
        });
        places
    }

    /// The same of other numbers.
    pub fn with(&self, mut of: impl FnMut(Place) -> Place) -> Comparison {
        match *self {
            Comparison::Less(a, b) => Comparison::Less(of(a), of(b)),
            Comparison::AtMost(a, b) => Comparison::AtMost(of(a), of(b)),
            Comparison::Zero(a) => Comparison::Zero(of(a)),
            Comparison::Negative(a) => Comparison::Negative(of(a)),
        }
    }
}

/// The operations and comparisons that a run wrote down.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    /// The operations in order.
    pub operations: Vec<Operation>,
    /// The comparisons of the path, or of a test that is tried.
    pub decisions: Decisions,
    /// A question that a tape gives one answer to, whatever the numbers are; the last one that was asked.
    pub unanswered: Option<&'static str>,
    places: HashMap<Operation, Place>,
    arithmetic: Arithmetic,
}

/// Comparisons, and the answers that they get.
#[derive(Clone, Debug, Default)]
pub struct Decisions {
    /// Each comparison once, in order, and its answer.
    pub made: Vec<(Comparison, bool)>,
    /// The answers to the first of them; later ones get no.
    script: Vec<bool>,
    /// Every comparison, each time that it is asked.
    asked: Vec<Comparison>,
}

impl Decisions {
    fn following(script: Vec<bool>) -> Decisions {
        Decisions {
            script,
            ..Decisions::default()
        }
    }

    fn answer(&mut self, comparison: Comparison) -> bool {
        self.asked.push(comparison);
        if let Some((_, answer)) = self.made.iter().find(|(known, _)| *known == comparison) {
            return *answer;
        }
        let answer = self.script.get(self.made.len()).copied().unwrap_or(false);
        self.made.push((comparison, answer));
        answer
    }
}

/// One way through the comparisons of a test, and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The comparisons that are made, and the answers that they get.
    pub answers: Vec<(Comparison, bool)>,
    /// The answer of the test then.
    pub accepts: bool,
}

thread_local! {
    static TAPE: RefCell<Tape> = RefCell::default();
}

fn on_tape<T>(with: impl FnOnce(&mut Tape) -> T) -> T {
    TAPE.with(|tape| with(&mut tape.borrow_mut()))
}

/// Runs `run` on an empty tape; the first comparisons get the answers of the script, later ones no. Returns
/// the result and the tape.
pub fn record<T>(script: &[bool], arithmetic: Arithmetic, run: impl FnOnce() -> T) -> (T, Tape) {
    let decisions = Decisions::following(script.to_vec());
    TAPE.set(Tape {
        decisions,
        arithmetic,
        ..Tape::default()
    });
    let result = run();
    (result, TAPE.take())
}

/// The script after the one that led to some answers: the last no becomes a yes, and what came after it is open
/// again. None at the end.
pub fn next_script(answers: &[(Comparison, bool)]) -> Option<Vec<bool>> {
    let last_no = answers.iter().rposition(|(_, answer)| !answer)?;
    let before = answers[..last_no].iter().map(|(_, answer)| *answer);
    Some(before.chain([true]).collect())
}

/// Every way through the comparisons of a test; none if they are more than `most`. They do not count as decisions,
/// and what the path decided before does not answer them.
pub fn outcomes(most: usize, test: impl Fn() -> bool) -> Option<Vec<Outcome>> {
    let mut outcomes = Vec::new();
    let mut script = Some(Vec::new());
    while let Some(next) = script {
        let tried = Decisions::following(next);
        let path = on_tape(|tape| mem::replace(&mut tape.decisions, tried));
        let accepts = test();
        let answers = on_tape(|tape| mem::replace(&mut tape.decisions, path)).made;
        script = next_script(&answers);
        outcomes.push(Outcome { answers, accepts });
        if outcomes.len() > most {
            return None;
        }
    }
    Some(outcomes)
}

/// How many decisions there are so far.
pub fn decisions_so_far() -> usize {
    on_tape(|tape| tape.decisions.made.len())
}

/// How many comparisons were asked so far, those with a known answer included.
pub fn asked_so_far() -> usize {
    on_tape(|tape| tape.decisions.asked.len())
}

/// The comparisons that were asked from the given one on.
pub fn asked_from(first: usize) -> Vec<Comparison> {
    on_tape(|tape| tape.decisions.asked[first..].to_vec())
}

/// A number on the tape of this thread.
#[derive(Debug)]
pub struct Recorded {
    place: Place,
    /// If this is a product that may still be fused.
    factors: Option<[Place; 2]>,
}

impl Clone for Recorded {
    fn clone(&self) -> Self {
        Recorded {
            place: self.place,
            factors: None,
        }
    }
}

fn push(operation: Operation) -> Place {
    on_tape(|tape| {
        let next = tape.operations.len() as Place;
        *tape.places.entry(operation).or_insert_with(|| {
            tape.operations.push(operation);
            next
        })
    })
}

impl Recorded {
    /// One of the seventeen numbers of a case.
    pub fn input(index: u8) -> Recorded {
        Recorded::at(Operation::Input(index))
    }

    /// Its place.
    pub fn place(&self) -> Place {
        self.place
    }

    fn at(operation: Operation) -> Recorded {
        Recorded::of_place(push(operation))
    }

    fn of_place(place: Place) -> Recorded {
        Recorded {
            place,
            factors: None,
        }
    }

    fn number(&self) -> Option<i32> {
        on_tape(|tape| match tape.operations[self.place as usize] {
            Operation::Number(value) => Some(value),
            _ => None,
        })
    }

    fn ask(comparison: Comparison) -> bool {
        on_tape(|tape| tape.decisions.answer(comparison))
    }

    fn sum(&self, other: &Recorded) -> Recorded {
        if let Some(sum) = rearranged([self, other].map(|it| Signed::of(it.place))) {
            return sum;
        }
        let operation = match (self.factors, other.factors) {
            (Some([a, b]), _) => Operation::Fma(a, b, other.place),
            (None, Some([a, b])) => Operation::Fma(a, b, self.place),
            (None, None) => Operation::Add(self.place, other.place),
        };
        Recorded::at(operation)
    }

    fn difference(&self, other: &Recorded) -> Recorded {
        if let Some(sum) = rearranged([Signed::of(self.place), Signed::of(other.place).negation()])
        {
            return sum;
        }
        match (self.factors, other.factors) {
            (None, None) => Recorded::at(Operation::Sub(self.place, other.place)),
            _ => self.sum(&other.negation()),
        }
    }

    fn product(&self, other: &Recorded) -> Recorded {
        let place = push(Operation::Mul(self.place, other.place));
        let fused = on_tape(|tape| tape.arithmetic.fused);
        Recorded {
            place,
            factors: fused.then_some([self.place, other.place]),
        }
    }

    fn quotient(&self, other: &Recorded) -> Recorded {
        Recorded::at(Operation::Div(self.place, other.place))
    }

    fn negation(&self) -> Recorded {
        let factors = self.factors.map(|[a, b]| [push(Operation::Neg(a)), b]);
        // The negative of a negative is the number itself.
        let inner = on_tape(|tape| match tape.operations[self.place as usize] {
            Operation::Neg(a) => Some(a),
            _ => None,
        });
        let place = inner.unwrap_or_else(|| push(Operation::Neg(self.place)));
        Recorded { place, factors }
    }
}

operators!([] Recorded, Clone::clone);

impl Real for Recorded {
    fn zero() -> Self {
        Recorded::at(Operation::Number(0))
    }
    fn one() -> Self {
        Recorded::at(Operation::Number(1))
    }
    /// A small whole number; any other stands in as infinity does, and its program is not analysed.
    fn number(value: f64) -> Self {
        let whole = value as i32;
        if f64::from(whole) == value {
            Recorded::at(Operation::Number(whole))
        } else {
            Recorded::infinity()
        }
    }
    fn abs(&self) -> Self {
        Recorded::at(Operation::Abs(self.place))
    }
    fn sqrt(&self) -> Self {
        Recorded::at(Operation::Sqrt(self.place))
    }
    fn is_sign_negative(&self) -> bool {
        match self.number() {
            Some(value) => value < 0,
            None => Recorded::ask(Comparison::Negative(self.place)),
        }
    }
    fn is_less(&self, other: &Self) -> bool {
        match (self.number(), other.number()) {
            (Some(a), Some(b)) => a < b,
            _ if self.place == other.place => false,
            _ => Recorded::ask(Comparison::Less(self.place, other.place)),
        }
    }
    fn is_at_most(&self, other: &Self) -> bool {
        match (self.number(), other.number()) {
            (Some(a), Some(b)) => a <= b,
            _ if self.place == other.place => true,
            _ => Recorded::ask(Comparison::AtMost(self.place, other.place)),
        }
    }
    fn is_zero(&self) -> bool {
        match self.number() {
            Some(value) => value == 0,
            None => Recorded::ask(Comparison::Zero(self.place)),
        }
    }
    fn is_nan(&self) -> bool {
        on_tape(|tape| tape.unanswered = Some("it asks whether a number is NaN"));
        false
    }
    fn is_finite(&self) -> bool {
        on_tape(|tape| tape.unanswered = Some("it asks whether a number is finite"));
        true
    }
    fn just_below(&self) -> Self {
        on_tape(|tape| tape.unanswered = Some("it asks for the number next to another one"));
        self.clone()
    }
    fn infinity() -> Self {
        Recorded::at(Operation::INFINITY)
    }
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        Recorded::at(Operation::Minor(a.place, b.place, c.place, d.place))
    }
    fn fused(a: &Self, b: &Self, c: &Self) -> Self {
        Recorded::at(Operation::Fma(a.place, b.place, c.place))
    }
}
