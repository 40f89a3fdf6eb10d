//! The binary encoding of docs/protocol.md: little-endian, `f32` only.

use crate::inputs::{Coordinates, Inputs};
use std::io::{self, Read, Write};

/// Bytes of a case: origin, direction, a, b, c, t_min, t_max.
pub const CASE_BYTES: usize = 17 * 4;
/// Bytes of a verdict: hit, facing, t, u, v.
pub const VERDICT_BYTES: usize = 5 * 4;

/// Cases that are asked together.
pub struct Batch {
    /// How many.
    pub count: u32,
    /// The epsilon of the gate `parallel`.
    pub parallel: f32,
    /// The cases, as they came.
    pub cases: Vec<u8>,
    /// By what the shader multiplies each case's coordinates, a float a case; negative where b and c are sums.
    pub factors: Vec<u8>,
}

impl Batch {
    /// The next batch; none at the end of the input.
    pub fn read(input: &mut impl Read) -> io::Result<Option<Batch>> {
        let mut head = [0; 16];
        match input.read(&mut head[..1])? {
            0 => return Ok(None),
            _ => input.read_exact(&mut head[1..])?,
        }
        let word =
            |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let (bits, count, epsilons) = (word(4), word(8), word(12));
        if &head[..4] != b"HLB1" || bits != 32 || 1 < epsilons {
            let told = "expected a batch HLB1 in 32 bits with one epsilon or none";
            return Err(io::Error::new(io::ErrorKind::InvalidData, told));
        }
        let mut epsilon = [0; 4];
        input.read_exact(&mut epsilon[..4 * epsilons as usize])?;
        let mut cases = vec![0; count as usize * CASE_BYTES];
        input.read_exact(&mut cases)?;
        Ok(Some(Batch {
            count,
            parallel: f32::from_le_bytes(epsilon),
            cases,
            factors: Vec::new(),
        }))
    }

    /// The same cases, with coordinates that the shader makes.
    pub fn made_in_the_shader(mut self, inputs: Inputs) -> Batch {
        self.factors.clear();
        for case in self.cases.chunks_exact_mut(CASE_BYTES) {
            let (words, _) = case.as_chunks_mut::<4>();
            let mut coordinates: Coordinates =
                std::array::from_fn(|place| f32::from_le_bytes(words[place]));
            let factor = inputs.split(&mut coordinates);
            for (word, coordinate) in words.iter_mut().zip(coordinates) {
                *word = coordinate.to_le_bytes();
            }
            self.factors.extend(factor.to_le_bytes());
        }
        self
    }
}

/// Writes the verdicts, which are laid out as the protocol has them.
pub fn write_answer(output: &mut impl Write, count: u32, verdicts: &[u8]) -> io::Result<()> {
    output.write_all(b"HLA1")?;
    output.write_all(&count.to_le_bytes())?;
    output.write_all(verdicts)?;
    output.flush()
}
