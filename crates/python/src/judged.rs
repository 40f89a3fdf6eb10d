//! Answers about whole meshes, and their judgements as numbers.

use hairline_scene::{Answer, Judged, Judgement, NamedHit, NamedPlace};
use numpy::PyArray1;
use pyo3::prelude::*;

/// The names of judgements, in the order of their codes. New ones go to the end: programs may have stored codes.
const JUDGEMENTS: [(Judgement, &str); 14] = [
    (Judgement::Right, "right"),
    (Judgement::Tie, "tie"),
    (Judgement::Neighbour, "neighbour"),
    (Judgement::WrongT, "wrong_t"),
    (Judgement::Lost, "lost"),
    (Judgement::Farther, "farther"),
    (Judgement::Ghost, "ghost"),
    (Judgement::TooFew, "too_few"),
    (Judgement::TooMany, "too_many"),
    (Judgement::Twice, "twice"),
    (Judgement::WrongOrder, "wrong_order"),
    (Judgement::WrongSide, "wrong_side"),
    (Judgement::NotDefined, "not_defined"),
    (Judgement::SelfHit, "self_hit"),
];

/// Codes of places.
pub(super) const OUTSIDE: i8 = 0;
pub(super) const INSIDE: i8 = 1;
pub(super) const ON: i8 = 2;
pub(super) const NOT_DEFINED: i8 = 3;

/// The codes of judgements, and how far each answer is off, in longest edges (NaN where that is not known).
pub(super) type Judgements<'py> = (Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<f64>>);

/// The names of judgements, in the order of their codes.
#[pyfunction]
pub fn judgements() -> Vec<&'static str> {
    JUDGEMENTS.iter().map(|(_, name)| *name).collect()
}

/// A judgement in numbers.
pub(super) struct Told {
    code: u8,
    off: f64,
}

/// A judgement as its code, and how far the answer is off.
pub(super) fn told(judged: &Judged) -> Told {
    let place = JUDGEMENTS
        .iter()
        .position(|(its, _)| *its == judged.judgement);
    Told {
        code: place.expect("every judgement has a name") as u8,
        off: judged.off.unwrap_or(f64::NAN),
    }
}

/// Judgements as two arrays.
pub(super) fn arrays_of<'py>(py: Python<'py>, all: &[Told]) -> Judgements<'py> {
    let codes = all.iter().map(|told| told.code).collect();
    let off = all.iter().map(|told| told.off).collect();
    (PyArray1::from_vec(py, codes), PyArray1::from_vec(py, off))
}

/// A nearest hit that was answered: a face below 0 is a miss.
pub(super) fn answer_of(face: i64, t: Option<f64>) -> Answer {
    Answer {
        face: u32::try_from(face).ok(),
        t,
    }
}

/// The hits of each of so many rays, in their order.
pub(super) fn hits_of(
    count: usize,
    rays: &[i64],
    faces: &[u32],
    t: Option<&[f64]>,
) -> Vec<Vec<NamedHit>> {
    let mut named = vec![Vec::new(); count];
    for (i, ray) in rays.iter().enumerate() {
        named[*ray as usize].push(NamedHit {
            face: faces[i],
            t: t.map(|t| t[i]),
        });
    }
    named
}

/// The place of a code.
pub(super) fn place_of_code(code: i8) -> NamedPlace {
    match code {
        OUTSIDE => NamedPlace::Outside,
        INSIDE => NamedPlace::Inside,
        _ => NamedPlace::On,
    }
}
