//! How the arithmetic of this thread rounds, found by computing: a library that was built with `-ffast-math`
//! may change it when it is loaded, and any code may while it runs.

use std::fmt;
use std::hint::black_box;

/// The state of a thread's floating-point unit, as far as it changes results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FloatEnvironment {
    /// Subnormal results become zero (x86: FTZ; Arm: FZ).
    pub flushes_results: bool,
    /// Subnormal operands count as zero (x86: DAZ; Arm: FZ).
    pub flushes_inputs: bool,
    /// How results are rounded.
    pub rounding: Rounding,
}

/// IEEE 754's rounding directions of binary arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// To nearest, ties to even.
    #[default]
    Nearest,
    /// Towards positive infinity.
    Up,
    /// Towards negative infinity.
    Down,
    /// Towards zero.
    Zero,
}

impl FloatEnvironment {
    /// That of this thread, now.
    #[inline(never)]
    pub fn now() -> FloatEnvironment {
        let times = |a: f64, b: f64| black_box(a) * black_box(b);
        let plus = |a: f64, b: f64| black_box(a) + black_box(b);
        // Bits are looked at, since a comparison may take a subnormal number as zero too.
        let is_zero = |x: f64| x.to_bits() == 0;
        let rounding = match (
            1.0 < plus(1.0, f64::EPSILON / 4.0),
            plus(1.0, -f64::EPSILON / 8.0) < 1.0,
            plus(-1.0, -f64::EPSILON / 4.0) < -1.0,
        ) {
            (true, ..) => Rounding::Up,
            (_, true, true) => Rounding::Down,
            (_, true, false) => Rounding::Zero,
            _ => Rounding::Nearest,
        };
        FloatEnvironment {
            flushes_results: is_zero(times(f64::MIN_POSITIVE, 0.5)),
            flushes_inputs: is_zero(times(f64::from_bits(1), 1e30)),
            rounding,
        }
    }

    /// True if this is the environment that IEEE 754 and every language start with.
    pub fn is_default(self) -> bool {
        self == FloatEnvironment::default()
    }

    /// As one number.
    pub fn bits(self) -> u32 {
        u32::from(self.flushes_results)
            | u32::from(self.flushes_inputs) << 1
            | (self.rounding as u32) << 2
    }

    /// From [`Self::bits`]; none if the number is none of them.
    pub fn from_bits(bits: u32) -> Option<FloatEnvironment> {
        let rounding = [Rounding::Nearest, Rounding::Up, Rounding::Down, Rounding::Zero];
        Some(FloatEnvironment {
            flushes_results: bits & 1 != 0,
            flushes_inputs: bits & 2 != 0,
            rounding: *rounding.get((bits >> 2) as usize)?,
        })
    }
}

impl fmt::Display for FloatEnvironment {
    /// The differences from the default, in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounding = match self.rounding {
            Rounding::Nearest => None,
            Rounding::Up => Some("rounding up"),
            Rounding::Down => Some("rounding down"),
            Rounding::Zero => Some("rounding toward zero"),
        };
        let words = [
            self.flushes_results.then_some("flush-to-zero"),
            self.flushes_inputs.then_some("denormals-are-zero"),
            rounding,
        ];
        let words: Vec<&str> = words.into_iter().flatten().collect();
        f.write_str(if words.is_empty() { "the default of IEEE 754" } else { "" })?;
        f.write_str(&words.join(" and "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_name_each_environment_once() {
        let all: Vec<FloatEnvironment> = (0..16).filter_map(FloatEnvironment::from_bits).collect();
        assert_eq!(all.len(), 16);
        assert!(all.iter().enumerate().all(|(bits, found)| found.bits() == bits as u32));
        assert_eq!(FloatEnvironment::from_bits(16), None);
        assert_eq!(all[7].to_string(), "flush-to-zero and denormals-are-zero and rounding up");
        assert!(all[0].is_default() && FloatEnvironment::now().is_default());
    }
}
