//! Rays and points in files of other people, line by line.

use crate::cli::exit::Failure;
use crate::cli::input::open;
use crate::files::InputError;
use crate::files::json::Object;
use crate::files::text_lines::TextLines;
use crate::files::{json, number};
use crate::kernel::Scalar;
use hairline_scene::Ray;
use std::io::BufReader;

/// The most bytes of a line.
pub(super) const LONGEST_LINE: usize = 1 << 16;

/// The form of a ray, for messages.
const RAY: &str = "origin and direction as six numbers, or eight with t_min and t_max";

/// The rays of a file. An error names the line and what is wrong in it.
pub(super) fn rays<F: Scalar>(file: &str) -> Result<Vec<Ray<F>>, Failure> {
    let read = |line: &str| match line.chars().next() {
        Some('{') => ray_of_json(line),
        Some('[') => Err(
            "expected a ray a line, not an array: {\"origin\":[0,0,5],\"direction\":[0,0,-1]}"
                .to_owned(),
        ),
        _ => ray_of_numbers(&words(line)),
    };
    lines(file, "rays", is_head, read)
}

/// The points of a file.
pub(super) fn points<F: Scalar>(file: &str) -> Result<Vec<[F; 3]>, Failure> {
    let read = |line: &str| {
        let numbers = numbers(&words(line))?;
        let count = numbers.len();
        <[F; 3]>::try_from(numbers)
            .map_err(|_| format!("expected three numbers of a point, found {count}"))
    };
    lines(file, "points", is_head, read)
}

/// A ray as words of a command line: `0,0,5 0,0,-1`.
pub(super) fn ray_of_words<F: Scalar>(text: &str) -> Result<Ray<F>, Failure> {
    ray_of_numbers(&words(text)).map_err(|message| Failure::usage(format!("--ray: {message}")))
}

/// One thing a line. A first line of names alone, and lines that begin with #, are skipped.
pub(super) fn lines<T>(
    file: &str,
    what: &str,
    is_head: impl Fn(&str) -> bool,
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<Vec<T>, Failure> {
    let mut all = Vec::new();
    let reader = BufReader::new(open(file)?);
    for line in TextLines::new(reader, file, LONGEST_LINE) {
        let (number, text) = line?;
        let text = without_mark(&text);
        if text.starts_with('#') || number == 1 && is_head(text) {
            continue;
        }
        let one = read(text).map_err(|message| InputError::at(file, number, message))?;
        all.push(one);
    }
    if all.is_empty() {
        return Err(InputError::of(file, format!("there are no {what} in it")).into());
    }
    Ok(all)
}

/// A line without spaces around it, and without the byte order mark that some editors begin a file with.
pub(super) fn without_mark(line: &str) -> &str {
    line.trim_start_matches('\u{feff}').trim()
}

/// True of a line of names: nothing that stands for a number.
pub(super) fn is_head(line: &str) -> bool {
    let is_name = |word: &str| {
        let is_number = number::parse::<f64>(word).is_ok();
        word.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_number
    };
    words(line).first().is_some_and(|first| is_name(first))
}

/// The words between commas, semicolons and spaces; between two commas may be none.
pub(super) fn words(line: &str) -> Vec<&str> {
    match line.contains([',', ';']) {
        true => {
            let parts = line.split([',', ';']);
            parts.flat_map(spaced).collect()
        }
        false => line.split_whitespace().collect(),
    }
}

fn spaced(part: &str) -> Vec<&str> {
    let words: Vec<&str> = part.split_whitespace().collect();
    match words.is_empty() {
        true => vec![""],
        false => words,
    }
}

fn numbers<F: Scalar>(words: &[&str]) -> Result<Vec<F>, String> {
    words.iter().map(|word| number::parse(word)).collect()
}

fn ray_of_numbers<F: Scalar>(words: &[&str]) -> Result<Ray<F>, String> {
    let numbers = numbers::<F>(words)?;
    let (&[ox, oy, oz, dx, dy, dz], interval) = numbers
        .split_first_chunk()
        .ok_or_else(|| format!("expected {RAY}, found {}", numbers.len()))?;
    let ray = Ray::new([ox, oy, oz], [dx, dy, dz]);
    match interval {
        [] => Ok(ray),
        [t_min, t_max] => Ok(ray.on(*t_min, *t_max)),
        _ => Err(format!("expected {RAY}, found {}", numbers.len())),
    }
}

fn ray_of_json<F: Scalar>(line: &str) -> Result<Ray<F>, String> {
    let object = Object::parse(line, &["origin", "direction", "t_min", "t_max"])?;
    let vector = |field: &str| -> Result<[F; 3], String> {
        let [x, y, z] = json::array(object.required(field)?, "numbers")?;
        Ok([json_number(x)?, json_number(y)?, json_number(z)?])
    };
    let ray = Ray::new(vector("origin")?, vector("direction")?);
    let t_min = object.read("t_min", json_number)?.unwrap_or(ray.t_min);
    let t_max = object.read("t_max", json_number)?.unwrap_or(ray.t_max);
    Ok(ray.on(t_min, t_max))
}

/// A JSON number, or a string that is one: JSON has no infinity.
pub(super) fn json_number<F: Scalar>(text: &str) -> Result<F, String> {
    match text.starts_with('"') {
        true => number::parse(&json::string(text)?),
        false => number::parse(text),
    }
}
