//! How the arithmetic of this thread rounds, found by computing: a library that was built with `-ffast-math`
//! may change it when it is loaded, and any code may while it runs.

use std::fmt;
use std::hint::black_box;

/// The state of a thread's floating-point unit, as far as it changes results: a bit if it flushes results, a bit if it
/// flushes inputs, and in the two bits above them its rounding direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FloatEnvironment(u32);

/// Subnormal results become zero (x86: FTZ; Arm: FZ).
const FLUSHES_RESULTS: u32 = 1;
/// Subnormal operands count as zero (x86: DAZ; Arm: FZ).
const FLUSHES_INPUTS: u32 = 2;

/// IEEE 754's rounding directions of binary arithmetic, in words; the first, to nearest with ties to even, is the default.
const ROUNDING: [&str; 4] = ["", "rounding up", "rounding down", "rounding toward zero"];

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
            (true, ..) => 1,
            (_, true, true) => 2,
            (_, true, false) => 3,
            _ => 0,
        };
        let flag = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        let results = flag(is_zero(times(f64::MIN_POSITIVE, 0.5)), FLUSHES_RESULTS);
        let inputs = flag(is_zero(times(f64::from_bits(1), 1e30)), FLUSHES_INPUTS);
        FloatEnvironment(results | inputs | rounding << 2)
    }

    /// True if this is the environment that IEEE 754 and every language start with.
    pub fn is_default(self) -> bool {
        self == FloatEnvironment::default()
    }

    /// As one number.
    pub fn bits(self) -> u32 {
        self.0
    }

    /// From [`Self::bits`]; none if the number is none of them.
    pub fn from_bits(bits: u32) -> Option<FloatEnvironment> {
        (bits < 16).then_some(FloatEnvironment(bits))
    }
}

impl fmt::Display for FloatEnvironment {
    /// The differences from the default, in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = [
            if self.0 & FLUSHES_RESULTS != 0 {
                "flush-to-zero"
            } else {
                ""
            },
            if self.0 & FLUSHES_INPUTS != 0 {
                "denormals-are-zero"
            } else {
                ""
            },
            ROUNDING[(self.0 >> 2) as usize],
        ];
        let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
        f.write_str(if words.is_empty() {
            "the default of IEEE 754"
        } else {
            ""
        })?;
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
        assert!(
            all.iter()
                .enumerate()
                .all(|(bits, found)| found.bits() == bits as u32)
        );
        assert_eq!(FloatEnvironment::from_bits(16), None);
        assert_eq!(
            all[7].to_string(),
            "flush-to-zero and denormals-are-zero and rounding up"
        );
        assert!(all[0].is_default() && FloatEnvironment::now().is_default());
    }
}
