//! One batch with a process: what is asked, and what it answers.

#![forbid(unsafe_code)]

use super::asked::Asked;
use super::binary::{self, Before};
use super::hello::shown;
use super::running::{Lost, Running};
use super::text;
use crate::arith::{Float, FloatEnvironment};
use crate::kernel::Verdict;

/// The remarks of a process besides its verdicts.
#[derive(Default)]
pub(super) struct Said {
    /// The nanoseconds that it took.
    pub took: Option<u64>,
    /// How it computes now, if that has changed.
    pub floats: Option<FloatEnvironment>,
}

/// Asks in lines of text.
pub(super) fn in_text<F: Float, T: Asked>(
    running: &mut Running,
    cases: &[T::Case<F>],
    epsilons: &[F],
    verdicts: &mut [Verdict<F>],
) -> Result<Said, Lost> {
    let mut lines = String::new();
    if !epsilons.is_empty() {
        lines.push_str(&text::epsilons_line(epsilons));
    }
    for (id, case) in cases.iter().enumerate() {
        lines.push_str(&text::case_line(id, T::numbers(case).as_ref()));
    }
    let count = cases.len() as u64;
    lines.push_str(&text::end_line(count));
    running.send(lines.into_bytes());
    for (id, place) in verdicts.iter_mut().enumerate() {
        let line = running.line()?;
        match text::answer::<F>(&line).map_err(Lost::Garbled)? {
            text::AnswerLine::Verdict(name, verdict) if name.parse() == Ok(id) => *place = verdict,
            _ => {
                let line = shown(&line);
                let message =
                    format!("expected the verdict on case {id} of {count}, found '{line}'");
                return Err(Lost::Garbled(message));
            }
        }
    }
    let line = running.line()?;
    match text::answer::<F>(&line) {
        Ok(text::AnswerLine::End { cases, took }) if cases == count => {
            Ok(Said { took, floats: None })
        }
        _ => Err(Lost::Garbled(format!(
            "after {count} verdicts expected 'end {count}', found '{}'",
            shown(&line)
        ))),
    }
}

/// Asks in the binary encoding; for the margins too, if there is room for them.
pub(super) fn in_binary<F: Float, T: Asked>(
    running: &mut Running,
    cases: &[T::Case<F>],
    epsilons: &[F],
    verdicts: &mut [Verdict<F>],
    margins: &mut [F],
) -> Result<Said, Lost> {
    let kind = if margins.is_empty() {
        binary::BATCH
    } else {
        binary::MARGINS
    };
    let mut bytes = running.spare();
    let width = T::FORM.plain.len();
    let numbers = cases.iter().map(T::numbers);
    binary::write_batch(kind, width, numbers, epsilons, &mut bytes);
    running.send(bytes);
    let mut said = Said::default();
    let head = loop {
        let head = running.bytes(binary::ANSWER_HEAD)?;
        match binary::before_answer(head) {
            Some(Before::Floats(floats)) => said.floats = Some(floats),
            Some(Before::Took(time)) => said.took = Some(time),
            Some(Before::Failure(failure)) => return Err(Lost::Failed(failure)),
            None => break head,
        }
    };
    let mut expected = binary::ANSWER.to_vec();
    expected.extend((cases.len() as u32).to_le_bytes());
    if head != expected {
        // A verdict in text, or the end of a batch.
        let is_text = head.iter().all(|byte| matches!(byte, b' '..=b'~' | b'\n'));
        let [head, expected] = [head, &expected].map(|bytes| bytes.escape_ascii());
        let why = if is_text {
            "its hello says 'encoding binary', and it answers in text: "
        } else {
            ""
        };
        let message = format!("{why}its answer begins with '{head}', expected '{expected}'");
        return Err(Lost::Garbled(message));
    }
    let size = binary::verdict_bytes::<F>();
    let bytes = running.bytes(size * cases.len())?;
    for (id, (record, place)) in bytes.chunks_exact(size).zip(verdicts).enumerate() {
        let of = cases.len();
        *place = binary::verdict(record)
            .map_err(|message| Lost::Garbled(format!("verdict {id} of {of}: {message}")))?;
    }
    let bytes = running.bytes(size_of_val(margins))?;
    for (bytes, margin) in bytes.chunks_exact(size_of::<F>()).zip(margins) {
        *margin = binary::float(bytes);
    }
    Ok(said)
}
