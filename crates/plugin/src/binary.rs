//! The binary encoding: little-endian, a batch at a time. Records are laid out as the structures of
//! include/hairline.h.

#![forbid(unsafe_code)]

use crate::arith::{Float, FloatEnvironment};
use crate::kernel::{Failure, Verdict};
use crate::truth::Facing;

/// The first four bytes of a batch.
pub(super) const BATCH: [u8; 4] = *b"HLB1";
/// The first four bytes of a batch whose margins are asked for too. Its epsilons let the most through.
pub(super) const MARGINS: [u8; 4] = *b"HLM1";
/// The first four bytes of the answer to either.
pub(super) const ANSWER: [u8; 4] = *b"HLA1";
/// Instead of an answer, from the host of a library: the kernel touched memory outside its buffers.
const OVERRUN: [u8; 4] = *b"HLX1";
/// Instead of an answer, from the host of a library: the kernel threw a C++ exception.
const EXCEPTION: [u8; 4] = *b"HLC1";
/// In front of an answer: the process's arithmetic has changed, and its bits follow.
const ENVIRONMENT: [u8; 4] = *b"HLE1";
/// In front of an answer: how long the kernel took, in nanoseconds.
const TOOK: [u8; 4] = *b"HLT1";

/// Bytes of a batch's head: [`BATCH`], bits of the scalar, number of cases, number of epsilons.
pub(super) const BATCH_HEAD: usize = 16;
/// Bytes of an answer's head: [`ANSWER`], number of verdicts.
pub(super) const ANSWER_HEAD: usize = 8;
/// Bytes of a verdict's hit and facing, which are 32-bit integers.
const VERDICT_HEAD: usize = 8;
/// Bytes of a verdict: its head, then t, u, v.
pub(super) const fn verdict_bytes<F: Float>() -> usize {
    VERDICT_HEAD + 3 * size_of::<F>()
}

/// Appends a number.
pub(super) fn push<F: Float>(bytes: &mut Vec<u8>, value: F) {
    bytes.extend_from_slice(&value.to_bits().to_le_bytes()[..size_of::<F>()]);
}

/// Writes a number into bytes of its size.
pub(super) fn write<F: Float>(bytes: &mut [u8], value: F) {
    bytes.copy_from_slice(&value.to_bits().to_le_bytes()[..size_of::<F>()]);
}

/// A number from its bytes.
pub(super) fn float<F: Float>(bytes: &[u8]) -> F {
    let mut bits = [0; 8];
    bits[..size_of::<F>()].copy_from_slice(bytes);
    F::from_bits(u64::from_le_bytes(bits))
}

/// Writes a batch, of [`BATCH`] or [`MARGINS`]: the head, the epsilons, the numbers of the cases, `width` of them a case.
pub(super) fn write_batch<F: Float, N: AsRef<[F]>>(
    kind: [u8; 4],
    width: usize,
    cases: impl ExactSizeIterator<Item = N>,
    epsilons: &[F],
    bytes: &mut Vec<u8>,
) {
    bytes.clear();
    bytes.extend(kind);
    for count in [8 * size_of::<F>(), cases.len(), epsilons.len()] {
        bytes.extend((count as u32).to_le_bytes());
    }
    for epsilon in epsilons {
        push(bytes, *epsilon);
    }
    let size = size_of::<F>();
    let record = width * size;
    let start = bytes.len();
    bytes.resize(start + cases.len() * record, 0);
    let records = bytes[start..].chunks_exact_mut(record);
    for (record, case) in records.zip(cases) {
        for (place, number) in record.chunks_exact_mut(size).zip(case.as_ref()) {
            place.copy_from_slice(&number.to_bits().to_le_bytes()[..size]);
        }
    }
}

/// A message of a process before its answer, or instead of it.
#[derive(Debug, PartialEq)]
pub(super) enum Before {
    /// Its arithmetic has changed to this.
    Floats(FloatEnvironment),
    /// This many nanoseconds went by in the kernel.
    Took(u64),
    /// There is no answer.
    Failure(Failure),
}

impl Before {
    /// The message as a head.
    pub fn head(&self) -> [u8; ANSWER_HEAD] {
        let (kind, number) = match *self {
            Before::Floats(floats) => (ENVIRONMENT, floats.bits()),
            Before::Took(time) => (TOOK, time.try_into().unwrap_or(u32::MAX)),
            Before::Failure(Failure::Exception) => (EXCEPTION, 0),
            Before::Failure(_) => (OVERRUN, 0),
        };
        let mut head = [0; ANSWER_HEAD];
        head[..4].copy_from_slice(&kind);
        head[4..].copy_from_slice(&number.to_le_bytes());
        head
    }
}

/// The message in a head that is not the answer's.
pub(super) fn before_answer(head: &[u8]) -> Option<Before> {
    let (kind, number) = head.split_first_chunk()?;
    let number = u32::from_le_bytes(number.try_into().ok()?);
    match *kind {
        ENVIRONMENT => FloatEnvironment::from_bits(number).map(Before::Floats),
        TOOK => Some(Before::Took(number.into())),
        EXCEPTION => Some(Before::Failure(Failure::Exception)),
        OVERRUN => Some(Before::Failure(Failure::Overrun)),
        _ => None,
    }
}

/// A verdict from its bytes; an error says what was expected.
pub(super) fn verdict<F: Float>(bytes: &[u8]) -> Result<Verdict<F>, String> {
    let (head, values) = bytes.split_at(VERDICT_HEAD);
    let (integers, _) = head.as_chunks();
    match i32::from_le_bytes(integers[0]) {
        0 => return Ok(Verdict::miss(None)),
        1 => {}
        other => return Err(format!("hit is {other}, expected 0 or 1")),
    }
    let facing = match i32::from_le_bytes(integers[1]) {
        0 => None,
        1 => Some(Facing::Front),
        2 => Some(Facing::Back),
        other => {
            return Err(format!(
                "facing is {other}, expected 0, 1 (front) or 2 (back)"
            ));
        }
    };
    let size = size_of::<F>();
    let [t, u, v] = [0, 1, 2].map(|place| float(&values[place * size..][..size]));
    Ok(Verdict {
        hit: true,
        facing,
        t,
        u,
        v,
        ..Verdict::miss(None)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn records_have_the_layout_of_the_header() {
        let case = Case::<f32>::new([1.0; 3], [0.0, 0.0, -1.0], [[0.0; 3]; 3]).on(-1.0, 2.0);
        let mut bytes = b"what was in it".to_vec();
        let numbers = [case.numbers()].into_iter();
        write_batch(BATCH, 17, numbers, &[0.5], &mut bytes);
        assert_eq!(bytes.len(), 16 + 4 + 68);
        assert_eq!(
            bytes[..20],
            *b"HLB1\x20\0\0\0\x01\0\0\0\x01\0\0\0\0\0\0\x3f"
        );
        assert_eq!(bytes[20..24], 1f32.to_le_bytes());
        assert_eq!(bytes[80..], *b"\0\0\x80\xbf\0\0\0\x40");
        assert_eq!((verdict_bytes::<f32>(), verdict_bytes::<f64>()), (20, 32));
        let mut wide = Vec::new();
        let numbers = [case.widen().numbers()].into_iter();
        write_batch(MARGINS, 17, numbers, &[], &mut wide);
        assert_eq!(
            (wide.len(), wide[..5].to_vec()),
            (16 + 136, b"HLM1\x40".to_vec())
        );
        assert_eq!(wide[16..24], 1f64.to_le_bytes());
    }

    #[test]
    fn what_comes_before_an_answer_is_read_back() {
        for (before, head) in [
            (
                Before::Floats(FloatEnvironment::from_bits(3).unwrap()),
                b"HLE1\x03\0\0\0",
            ),
            (Before::Took(0x0201), b"HLT1\x01\x02\0\0"),
            (Before::Took(u32::MAX.into()), b"HLT1\xff\xff\xff\xff"),
            (Before::Failure(Failure::Overrun), b"HLX1\0\0\0\0"),
            (Before::Failure(Failure::Exception), b"HLC1\0\0\0\0"),
        ] {
            assert_eq!(before.head(), *head);
            assert_eq!(before_answer(head), Some(before));
        }
        assert_eq!(Before::Took(u64::MAX).head(), *b"HLT1\xff\xff\xff\xff");
        assert_eq!(before_answer(b"HLA1\x01\0\0\0"), None);
    }

    #[test]
    fn verdicts_are_read_and_what_is_none_is_refused() {
        let record = |hit: i32, facing: i32| {
            let mut bytes = [hit.to_le_bytes(), facing.to_le_bytes()].concat();
            [0.5f64, 0.25, f64::NAN]
                .iter()
                .for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes
        };
        let read = verdict::<f64>(&record(1, 2)).unwrap();
        assert_eq!(
            (read.hit, read.facing, read.t, read.u),
            (true, Some(Facing::Back), 0.5, 0.25)
        );
        assert!(read.v.is_nan());
        assert!(!verdict::<f64>(&record(0, 77)).unwrap().hit);
        assert!(
            verdict::<f64>(&record(2, 0))
                .unwrap_err()
                .contains("hit is 2")
        );
        assert!(
            verdict::<f64>(&record(1, -1))
                .unwrap_err()
                .contains("facing is -1")
        );
    }
}
