//! The text encoding: a line a case, a line a verdict. Also what `generate` writes.

#![forbid(unsafe_code)]

pub(super) use super::hello::shown;
use crate::arith::Float;
use crate::files::number;
use crate::kernel::Verdict;
use crate::truth::Facing;
use std::fmt::{Display, Write};

/// A number that every reader of IEEE doubles reads back as the same float.
pub fn number<F: Float>(value: F) -> String {
    number::write(value).trim_matches('"').to_owned()
}

/// `case ID SCALAR`, then the numbers of a case: origin, direction, a, b, c (or min, max of a box), t_min, t_max.
pub fn case_line<F: Float>(id: impl Display, numbers: &[F]) -> String {
    let mut line = format!("case {id} {}", F::NAME);
    for value in numbers {
        let _ = write!(line, " {}", number(*value));
    }
    line.push('\n');
    line
}

/// `end N`: answer everything now. The kernel writes the same line after its answers.
pub fn end_line(count: u64) -> String {
    format!("end {count}\n")
}

/// Epsilons, from now on.
pub(super) fn epsilons_line<F: Float>(epsilons: &[F]) -> String {
    let values: Vec<String> = epsilons.iter().map(|e| number(*e)).collect();
    format!("epsilons {} {}\n", F::NAME, values.join(" "))
}

/// A line that a kernel wrote.
#[derive(Debug, PartialEq)]
pub(super) enum AnswerLine<'a, F> {
    /// The verdict on a case.
    Verdict(&'a str, Verdict<F>),
    /// `end N [took=NANOSECONDS]`.
    End {
        /// How many cases are answered.
        cases: u64,
        /// The nanoseconds in the kernel, if it says.
        took: Option<u64>,
    },
}

/// `ID miss`, `ID hit [t=T] [u=U] [v=V] [facing=front|back]` or `end N`; an error says what was
/// expected.
pub(super) fn answer<F: Float>(line: &str) -> Result<AnswerLine<'_, F>, String> {
    let shape = || {
        if line.starts_with("HLA1") {
            return "it answers in the binary encoding, and its hello does not say 'encoding binary'"
                .to_owned();
        }
        format!(
            "expected 'ID miss', 'ID hit t=… u=… v=… facing=front' or 'end N', found '{}'",
            shown(line)
        )
    };
    let mut words = line.split_ascii_whitespace();
    let (first, second) = (
        words.next().ok_or_else(shape)?,
        words.next().ok_or_else(shape)?,
    );
    let verdict = match (first, second) {
        ("end", cases) => {
            let cases = cases.parse().map_err(|_| shape())?;
            let took = words.next().map(|word| {
                let time = word
                    .strip_prefix("took=")
                    .and_then(|time| time.parse().ok());
                time.ok_or_else(shape)
            });
            let took = took.transpose()?;
            return if words.next().is_none() {
                Ok(AnswerLine::End { cases, took })
            } else {
                Err(shape())
            };
        }
        (_, "miss") => Verdict::miss(None),
        (_, "hit") => Verdict {
            hit: true,
            ..Verdict::miss(None)
        },
        _ => return Err(shape()),
    };
    words
        .try_fold(verdict, |verdict, word| {
            with_value(verdict, word, line)?.ok_or_else(shape)
        })
        .map(|verdict| AnswerLine::Verdict(first, verdict))
}

/// A verdict with one value more; none if the word is of no value that a hit has.
fn with_value<F: Float>(
    mut verdict: Verdict<F>,
    word: &str,
    line: &str,
) -> Result<Option<Verdict<F>>, String> {
    let Some((key, text)) = word.split_once('=').filter(|_| verdict.hit) else {
        return Ok(None);
    };
    let own = match (key, text) {
        ("facing", "front" | "back" | "unknown") => {
            verdict.facing = match text {
                "front" => Some(Facing::Front),
                "back" => Some(Facing::Back),
                _ => None,
            };
            return Ok(Some(verdict));
        }
        ("t", _) => &mut verdict.t,
        ("u", _) => &mut verdict.u,
        ("v", _) => &mut verdict.v,
        _ => return Ok(None),
    };
    if line.matches(&format!(" {key}=")).count() > 1 {
        return Err(format!("it gives {key} twice in '{}'", shown(line)));
    }
    // A kernel that computes in f64 may give a number that the case's scalar cannot hold.
    let number = number::parse::<f64>(&text.to_ascii_lowercase());
    let number = number.map_err(|error| format!("{key}={text} in '{}': {error}", shown(line)))?;
    *own = F::from_f64(number);
    Ok(Some(verdict))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_case_is_a_line_of_twenty_words() {
        let case = Case::<f32>::new(
            [0.1, -0.0, f32::NAN],
            [0.0, 0.0, -1.0],
            [
                [1e-45, 3e38, 0.5],
                [4.0, 0.0, f32::NEG_INFINITY],
                [0.0, 4.0, 0.0],
            ],
        );
        assert_eq!(
            case_line("fan@1/f32/-/1/5.2", &case.numbers()),
            "case fan@1/f32/-/1/5.2 f32 0.10000000149011612 -0.0 nan 0 0 -1 1.401298464324817e-45 \
             3.0000000054977558e38 0.5 4 0 -inf 0 4 0 0 inf\n"
        );
        assert_eq!(epsilons_line(&[1e-6f64, 0.0]), "epsilons f64 1e-6 0\n");
    }

    fn verdict(line: &str) -> Result<(String, Verdict<f32>), String> {
        match answer::<f32>(line)? {
            AnswerLine::Verdict(id, verdict) => Ok((id.to_owned(), verdict)),
            AnswerLine::End { .. } => Err("end".to_owned()),
        }
    }

    #[test]
    fn verdicts_are_read_in_any_order_of_their_values() {
        let (id, read) = verdict("17 hit facing=back v=0x1p-2 t=1e300 u=NaN ").unwrap();
        assert_eq!(
            (id.as_str(), read.hit, read.facing),
            ("17", true, Some(Facing::Back))
        );
        assert_eq!((read.t, read.v), (f32::INFINITY, 0.25));
        assert!(read.u.is_nan());
        let (_, read) = verdict("a hit t=-Infinity").unwrap();
        assert!(read.t == f32::NEG_INFINITY && read.u.is_nan() && read.facing.is_none());
        let (id, read) = verdict("fan@1/f32/-/1/5.2 miss\r").unwrap();
        assert_eq!((id.as_str(), read.hit), ("fan@1/f32/-/1/5.2", false));
        assert_eq!(
            answer::<f64>("end 12"),
            Ok(AnswerLine::End {
                cases: 12,
                took: None
            })
        );
        assert_eq!(
            answer::<f64>("end 12 took=5"),
            Ok(AnswerLine::End {
                cases: 12,
                took: Some(5)
            })
        );
        for line in [
            "end 12 5",
            "end 12 took=",
            "end 12 took=-1",
            "end 12 took=5 6",
        ] {
            assert!(answer::<f64>(line).is_err(), "{line}");
        }
    }

    #[test]
    fn what_is_no_verdict_says_what_was_expected() {
        for line in [
            "",
            "17",
            "17 maybe",
            "17 hit 0.5",
            "17 hit w=1",
            "17 hit facing=left",
            "17 miss t=1",
            "end",
            "end x",
            "end 3 4",
            "hit 17",
            "{\"hit\":true}",
        ] {
            let error = verdict(line).unwrap_err();
            assert!(error.starts_with("expected 'ID miss', "), "{line}: {error}");
        }
        for (line, expected) in [
            ("17 hit t=", "t= in '17 hit t=': '' is not a number"),
            ("17 hit u=x", "u=x in '17 hit u=x': 'x' is not a number"),
            (
                "17 hit t=1e400",
                "t=1e400 in '17 hit t=1e400': '1e400' overflows f64",
            ),
            ("17 hit t=1 t=2", "it gives t twice in '17 hit t=1 t=2'"),
        ] {
            let error = verdict(line).unwrap_err();
            assert!(error.starts_with(expected), "{line}: {error}");
        }
        assert!(verdict(&"x".repeat(5000)).unwrap_err().len() < 300);
    }
}
