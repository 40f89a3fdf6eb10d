//! A case as one JSON object.

use super::stored_case::{StoredCase, check_name};
use super::stored_truth::StoredTruth;
use super::{FoundBy, plain_json};
use crate::arith::Float;
use crate::case::{AnyCase, Case};
use crate::files::json::{self, Object};
use crate::files::number;
use serde_json::Value;
use std::fmt;

/// The fields that are vectors, in the order of [`Case::vectors`].
pub(super) const VECTORS: [&str; 5] = ["origin", "direction", "a", "b", "c"];

/// The fields of a case. Those from `note` on are for people, and so is every name that begins with `_`.
const FIELDS: [&str; 28] = [
    "name",
    "scalar",
    "origin",
    "direction",
    "from",
    "to",
    "a",
    "b",
    "c",
    "t_min",
    "t_max",
    "starts",
    "truth",
    "bits",
    "why",
    "url",
    "found",
    "note",
    "notes",
    "comment",
    "comments",
    "description",
    "id",
    "label",
    "tags",
    "source",
    "date",
    "_",
];

/// The fields of `bits`.
const BITS: [&str; 9] = [
    "origin",
    "direction",
    "from",
    "to",
    "a",
    "b",
    "c",
    "t_min",
    "t_max",
];

/// The value of the field `starts` for a ray that starts at a computed hit point on its triangle.
const ON_TRIANGLE: &str = "on-triangle";

/// The case that stands in a line, and what stands beside it.
pub fn parse(text: &str, line: usize) -> Result<StoredCase, String> {
    // Whatever is not read so is read again, and errors come from there.
    let plain = match text.contains("\"f32\"") {
        true => plain_json::read::<f32>(text, AnyCase::F32),
        false => plain_json::read::<f64>(text, AnyCase::F64),
    };
    plain.map_or_else(
        || parse_any(text, line),
        |plain| Ok(StoredCase { line, ..plain }),
    )
}

/// Any line, and what is wrong with it.
pub(super) fn parse_any(text: &str, line: usize) -> Result<StoredCase, String> {
    let text = json::tidied(text);
    let object = Object::parse(&text, &FIELDS)?;
    let case = match object.is_f32()? {
        true => AnyCase::F32(parse_case(&object)?),
        false => AnyCase::F64(parse_case(&object)?),
    };
    let starts = object.read("starts", json::string)?;
    if let Some(other) = starts.as_deref().filter(|starts| *starts != ON_TRIANGLE) {
        let found = json::quoted(other);
        return Err(format!("starts: expected '{ON_TRIANGLE}', found {found}"));
    }
    let name = |value| json::string(value).and_then(check_name);
    Ok(StoredCase {
        name: object.read("name", name)?,
        case,
        is_secondary: starts.is_some(),
        truth: object.read("truth", StoredTruth::parse)?,
        line,
        why: object.read("why", json::string)?,
        url: object.read("url", json::string)?,
        found: object.read("found", FoundBy::parse)?,
    })
}

fn parse_case<F: Float>(object: &Object) -> Result<Case<F>, String> {
    let bits = object
        .read("bits", |bits| Object::parse(bits, &BITS))?
        .unwrap_or_default();
    let vector = |field| parse_vector(field, object.get(field), bits.get(field));
    let is_given = |field: &&&str| object.get(field).or(bits.get(field)).is_some();
    let is_segment = ["from", "to"].iter().any(|field| is_given(&field));
    let (origin, direction) = if is_segment {
        if let Some(field) = ["origin", "direction"].iter().find(is_given) {
            return Err(format!("{field}: leave it out, or 'from' and 'to'"));
        }
        let [from, to] = [vector("from")?, vector("to")?];
        (from, [0, 1, 2].map(|axis| to[axis] - from[axis]))
    } else {
        (vector("origin")?, vector("direction")?)
    };
    let corners = [vector("a")?, vector("b")?, vector("c")?];
    let end = |field| number_of(field, object.get(field), bits.get(field));
    let longest = if is_segment { F::one() } else { F::infinity() };
    let (t_min, t_max) = (
        end("t_min")?.unwrap_or(F::zero()),
        end("t_max")?.unwrap_or(longest),
    );
    Ok(Case::new(origin, direction, corners).on(t_min, t_max))
}

/// The numbers of `[1,2,3]` or `{"x":1,"y":2,"z":3}`.
fn three(value: &str) -> Result<[&str; 3], String> {
    if !value.starts_with('{') {
        return json::array(value, "numbers");
    }
    let object = Object::parse(value, &["x", "y", "z"])?;
    Ok([
        object.required("x")?,
        object.required("y")?,
        object.required("z")?,
    ])
}

fn parse_vector<F: Float>(
    field: &str,
    value: Option<&str>,
    bits: Option<&str>,
) -> Result<[F; 3], String> {
    if value.or(bits).is_none() {
        return Err(format!("missing field '{field}'"));
    }
    // A vector of another language may stand in quotes.
    let unquoted = value.and_then(|value| json::string(value).ok());
    let value = unquoted
        .as_deref()
        .map(json::tidied)
        .or(value.map(Into::into));
    let values = value.as_deref().map(three).transpose();
    let values = values.map_err(|message| format!("{field}: {message}"))?;
    let bits = bits
        .map(|bits| json::array::<3>(bits, "bit patterns"))
        .transpose();
    let bits = bits.map_err(|message| format!("bits.{field}: {message}"))?;
    let mut vector = [F::zero(); 3];
    for (axis, number) in vector.iter_mut().enumerate() {
        let [value, bits] = [values, bits].map(|them| them.map(|them| them[axis]));
        *number = number_of(format_args!("{field}[{axis}]"), value, bits)?.unwrap_or(*number);
    }
    Ok(vector)
}

/// A JSON number or a string, from its text.
pub fn parse_number<F: Float>(path: impl fmt::Display, text: &str) -> Result<F, String> {
    let number = match text.as_bytes().first() {
        Some(b'"') => json::string(text).and_then(|text| number::parse(&text)),
        Some(b'-' | b'0'..=b'9') => number::parse(text),
        _ => Err(format!(
            "expected a number or a string, found {}",
            json::excerpt(text)
        )),
    };
    number.map_err(|message| format!("{path}: {message}"))
}

/// The number of a text, of a bit pattern, or of both, which must agree; of a NaN the pattern's.
fn number_of<F: Float>(
    path: impl fmt::Display,
    text: Option<&str>,
    bits: Option<&str>,
) -> Result<Option<F>, String> {
    let number: Option<F> = text.map(|text| parse_number(&path, text)).transpose()?;
    let pattern: Option<F> = bits
        .map(|bits| parse_pattern(bits).map_err(|message| format!("bits.{path}: {message}")))
        .transpose()?;
    let show = |value: F| {
        format!(
            "{} ({})",
            number::write(value).replace('"', ""),
            value.hex()
        )
    };
    match (number, pattern) {
        (Some(number), Some(pattern))
            if pattern.to_bits() != number.to_bits() && !(pattern.is_nan() && number.is_nan()) =>
        {
            Err(format!(
                "bits.{path} is {}, but {path} is {}",
                show(pattern),
                show(number)
            ))
        }
        (number, pattern) => Ok(pattern.or(number)),
    }
}

fn parse_pattern<F: Float>(value: &str) -> Result<F, String> {
    let text = json::string(value)?;
    let text = text.trim_start_matches("0x");
    let digits = F::zero().hex().len();
    let plain = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    match u64::from_str_radix(text, 16) {
        Ok(bits) if plain => Ok(F::from_bits(bits)),
        _ => Err(format!(
            "expected {digits} hexadecimal digits, found {}",
            json::quoted(text)
        )),
    }
}

/// The case and what stands beside it, with its bit patterns.
pub fn write<F: Float>(stored: &StoredCase, case: &Case<F>) -> String {
    let text = |text: &String| Value::from(text.as_str()).to_string();
    let mut fields = Vec::new();
    fields.extend(stored.name.as_ref().map(|name| ("name", text(name))));
    fields.push(scalar::<F>());
    fields.extend(numbers(case, number::write));
    if stored.is_secondary {
        fields.push(("starts", format!("\"{ON_TRIANGLE}\"")));
    }
    fields.extend(
        stored
            .truth
            .as_ref()
            .map(|truth| ("truth", truth.to_json())),
    );
    let bits = numbers(case, |number| format!("\"{}\"", number.hex()));
    fields.push(("bits", json::object(bits)));
    fields.extend(stored.why.as_ref().map(|why| ("why", text(why))));
    fields.extend(stored.url.as_ref().map(|url| ("url", text(url))));
    fields.extend(
        stored
            .found
            .as_ref()
            .map(|found| ("found", found.to_json())),
    );
    json::object(fields)
}

/// The numbers of a case alone, in the fewest digits that its scalar needs.
pub fn write_bare<F: Float>(case: &Case<F>) -> String {
    let mut fields = vec![scalar::<F>()];
    fields.extend(numbers(case, number::write_shortest));
    json::object(fields)
}

fn scalar<F: Float>() -> (&'static str, String) {
    ("scalar", format!("\"{}\"", F::NAME))
}

/// The vectors of a case, and the ends of its interval that are not the default ones, as texts.
fn numbers<F: Float>(case: &Case<F>, text: impl Fn(F) -> String) -> Vec<(&'static str, String)> {
    let mut fields: Vec<(&str, String)> = Vec::new();
    for (field, vector) in VECTORS.into_iter().zip(case.vectors()) {
        fields.push((field, format!("[{}]", vector.map(&text).join(","))));
    }
    let ends = [
        ("t_min", case.ray.t_min, F::zero()),
        ("t_max", case.ray.t_max, F::infinity()),
    ];
    for (field, end, default) in ends {
        if end.to_bits() != default.to_bits() {
            fields.push((field, text(end)));
        }
    }
    fields
}

#[cfg(test)]
mod tests;
