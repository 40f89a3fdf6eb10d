//! The answers of a program in a file: one a line in the order of the rays, or of all hits one hit a line.

use super::Text;
use super::line::{is_head, json_number, words};
use crate::asked::{AnswerKind, Answers};
use crate::files::InputError;
use crate::files::json::{self, Object};
use hairline_scene::{Answer, NamedHit, NamedPlace};
use std::cell::Cell;

/// The words of programs for no face: a signed and an unsigned -1.
const NO_FACE: [&str; 6] = ["-1", "4294967295", "none", "null", "miss", ""];

/// Names of the one column of a file, of which some are answers too.
const HEADS: [&str; 3] = ["hit", "count", "inside"];

/// The words for yes and for no.
const YES: [&str; 3] = ["1", "true", "hit"];
const NO: [&str; 3] = ["0", "false", "miss"];

/// The answers of a file to so many rays or points, at a mesh of so many faces.
pub fn answers(
    text: Text,
    kind: AnswerKind,
    asked: usize,
    faces: usize,
) -> Result<Answers, InputError> {
    let rays = format!("{asked} rays");
    let points = format!("{asked} points");
    let answers = match kind {
        AnswerKind::Nearest => {
            let read = |line: &str| nearest(line, faces);
            Answers::Nearest(one_a_line(text, asked, &rays, read)?)
        }
        AnswerKind::Any => Answers::Any(one_a_line(text, asked, &rays, any)?),
        AnswerKind::All => Answers::All(all(text, asked, faces)?),
        AnswerKind::Count => Answers::Count(one_a_line(text, asked, &rays, count)?),
        AnswerKind::Inside => Answers::Inside(one_a_line(text, asked, &points, place)?),
    };
    Ok(answers)
}

fn one_a_line<T>(
    text: Text,
    asked: usize,
    questions: &str,
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<Vec<T>, InputError> {
    let name = text.name;
    let may_be_head = Cell::new(false);
    let is_only_a_head = |first: &str| {
        may_be_head.set(HEADS.contains(&first.to_ascii_lowercase().as_str()));
        is_head(first) && read(first).is_err()
    };
    let mut answers = text.one_a_line("answers", is_only_a_head, &read)?;
    // One too many: then a first line that may be both is a head.
    if answers.len() == asked + 1 && may_be_head.get() {
        answers.remove(0);
    }
    if answers.len() != asked {
        let message = format!(
            "{} answers to {questions}: expected one a line, in their order (empty lines do not count: a miss is -1, or 0 hits)",
            answers.len()
        );
        return Err(InputError::of(name, message));
    }
    Ok(answers)
}

/// A face's number as a program wrote it. One more than there are is what a program says that counts from 1.
fn face(word: &str, faces: usize) -> Result<u32, String> {
    let face = word.parse().map_err(|_| {
        format!(
            "expected a face's number from 0, or -1 for a miss, found {}",
            json::quoted(word)
        )
    })?;
    match faces < face as usize {
        true => Err(format!(
            "face {face}, and the mesh has {faces}, counted from 0"
        )),
        false => Ok(face),
    }
}

fn is_no_face(word: &str) -> bool {
    NO_FACE.contains(&word.to_ascii_lowercase().as_str())
}

/// A face among all hits of a ray, where a miss has no line.
fn named_face(word: &str, faces: usize) -> Result<u32, String> {
    if is_no_face(word) {
        return Err("a miss has no line here: only hits have, as ray,face,t".to_owned());
    }
    face(word, faces).map_err(|message| format!("{message}; a line is ray,face,t"))
}

fn nearest(line: &str, faces: usize) -> Result<Answer, String> {
    let answer = |word: &str, t: Option<&str>| {
        if is_no_face(word) {
            return Ok(Answer {
                face: None,
                t: None,
            });
        }
        Ok(Answer {
            face: Some(face(word, faces)?),
            t: t.filter(|t| !t.is_empty()).map(json_number).transpose()?,
        })
    };
    if line.starts_with('{') {
        let object = Object::parse(line, &["face", "t"])?;
        let t = object.get("t").filter(|t| *t != "null");
        return answer(object.get("face").unwrap_or("null"), t);
    }
    match words(line)[..] {
        [face] => answer(face, None),
        [face, t] => answer(face, Some(t)),
        ref words => Err(format!(
            "expected a face and its t, as 12,0.5, found {} words; with --answered all a line is ray,face,t",
            words.len()
        )),
    }
}

fn any(line: &str) -> Result<bool, String> {
    let word = one_word(line, "hit")?;
    match word.as_str() {
        word if YES.contains(&word) => Ok(true),
        word if NO.contains(&word) => Ok(false),
        word => Err(format!(
            "expected 1 for a hit or 0 for none, found {}",
            json::quoted(word)
        )),
    }
}

fn count(line: &str) -> Result<u64, String> {
    let word = one_word(line, "count")?;
    let wrong = |_| format!("expected the number of hits, found {}", json::quoted(&word));
    word.parse().map_err(wrong)
}

fn place(line: &str) -> Result<NamedPlace, String> {
    let word = one_word(line, "place")?;
    match word.as_str() {
        "1" | "true" => Ok(NamedPlace::Inside),
        "0" | "false" => Ok(NamedPlace::Outside),
        word => NamedPlace::named(word).ok_or_else(|| {
            format!(
                "expected inside, outside or on, or 1 for inside and 0 for outside, found {}",
                json::quoted(word)
            )
        }),
    }
}

/// The one word of a line, or of its field.
fn one_word(line: &str, field: &str) -> Result<String, String> {
    if line.starts_with('{') {
        let object = Object::parse(line, &[field])?;
        let value = object.required(field)?;
        return match value.starts_with('"') {
            true => json::string(value),
            false => Ok(value.to_owned()),
        };
    }
    match words(line)[..] {
        [word] => Ok(word.to_ascii_lowercase()),
        ref words => Err(format!("expected one word, found {}", words.len())),
    }
}

/// All hits: a line each, with the ray's number from 0, the face and its t if there is one; those of a ray in the program's order.
fn all(text: Text, asked: usize, faces: usize) -> Result<Vec<Vec<NamedHit>>, InputError> {
    let name = text.name;
    let has_head = Cell::new(false);
    let is_only_a_head = |first: &str| {
        has_head.set(is_head(first));
        has_head.get()
    };
    let mut answers = vec![Vec::new(); asked];
    let mut has_hits = false;
    text.for_each_line(is_only_a_head, |line| {
        let hit = hit(line, asked, faces)?;
        answers[hit.ray].push(hit.named);
        has_hits = true;
        Ok(())
    })?;
    match has_hits || has_head.get() {
        true => Ok(answers),
        false => Err(InputError::of(
            name,
            "there are no answers in it: expected ray,face,t, a line for each hit; if no ray hits, a first line of these names alone",
        )),
    }
}

/// A hit with its ray.
struct HitOfRay {
    ray: usize,
    named: NamedHit,
}

fn hit(line: &str, asked: usize, faces: usize) -> Result<HitOfRay, String> {
    let found = |ray: &str, word: &str, t: Option<&str>| {
        let ray = ray.parse().ok().filter(|ray| *ray < asked);
        Ok(HitOfRay {
            ray: ray.ok_or_else(|| {
                format!("expected a ray's number, from 0 and below {asked}, first")
            })?,
            named: NamedHit {
                face: named_face(word, faces)?,
                t: t.filter(|t| !t.is_empty()).map(json_number).transpose()?,
            },
        })
    };
    if line.starts_with('{') {
        let object = Object::parse(line, &["ray", "face", "t"])?;
        let t = object.get("t").filter(|t| *t != "null");
        return found(object.required("ray")?, object.required("face")?, t);
    }
    match words(line)[..] {
        [ray, face] => found(ray, face, None),
        [ray, face, t] => found(ray, face, Some(t)),
        ref words => Err(format!(
            "expected a ray, a face and its t, as 0,12,0.5, found {} words",
            words.len()
        )),
    }
}
