//! A case in other forms: as bit patterns, and back; in one of the two scalars; and as source code in Rust.

use super::Case;
use crate::arith::{Float, ScalarName};

impl<F: Float> Case<F> {
    /// The bit patterns of origin, direction, a, b, c, t_min and t_max, in hexadecimal.
    pub fn hex(&self) -> String {
        let [o, d, a, b, c] = self.vectors().map(|v| v.map(F::hex).join(","));
        let t_min = self.ray.t_min.hex();
        let t_max = self.ray.t_max.hex();
        format!("o={o} d={d} a={a} b={b} c={c} t={t_min},{t_max}")
    }

    /// All seventeen numbers, in the order of [`Case::hex`].
    pub fn numbers(&self) -> [F; 17] {
        let mut numbers = [F::zero(); 17];
        numbers[..15].copy_from_slice(self.vectors().as_flattened());
        numbers[15] = self.ray.t_min;
        numbers[16] = self.ray.t_max;
        numbers
    }

    /// The bits of all numbers, over which digests are made.
    pub fn bits(&self) -> [u64; 17] {
        self.numbers().map(F::to_bits)
    }

    /// The case whose numbers have these bits.
    pub fn from_bits(bits: &[u64; 17]) -> Case<F> {
        let numbers = bits.map(F::from_bits);
        let (&[origin, direction, a, b, c], &[t_min, t_max]) = numbers.as_chunks() else {
            unreachable!("17 numbers are five vectors and two ends of an interval")
        };
        Case::new(origin, direction, [a, b, c]).on(t_min, t_max)
    }

    /// The case that [`Case::hex`] wrote as this text; none if the text is anything else, or the other scalar's.
    pub fn from_hex(text: &str) -> Option<Case<F>> {
        let words: Vec<&str> = text.split(' ').take(6).collect();
        let mut bits = Vec::new();
        for word in &words {
            let (_, list) = word.split_once('=')?;
            for number in list.split(',') {
                bits.push(u64::from_str_radix(number, 16).ok()?);
            }
        }
        let case = Case::from_bits(bits.as_slice().try_into().ok()?);
        // Names, digits and their number are right if the case is written in the same way.
        (case.hex() == words.join(" ")).then_some(case)
    }
}

/// Something in one of the two scalars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyScalar<A, B> {
    /// In `f32`.
    F32(A),
    /// In `f64`.
    F64(B),
}

impl<A, B> AnyScalar<A, B> {
    /// The scalar's name.
    pub fn scalar(&self) -> ScalarName {
        match self {
            AnyScalar::F32(_) => f32::NAME,
            AnyScalar::F64(_) => f64::NAME,
        }
    }

    /// Two flags, for `f32` and for `f64`: true for the scalar that it is in.
    pub fn scalars(&self) -> [bool; 2] {
        self.scalar().alone()
    }
}

/// A case in the scalar that it was written for.
pub type AnyCase = AnyScalar<Case<f32>, Case<f64>>;

impl<F: Float> From<Case<F>> for AnyCase {
    fn from(case: Case<F>) -> AnyCase {
        let bits = case.bits();
        if F::NAME == f32::NAME {
            AnyCase::F32(Case::from_bits(&bits))
        } else {
            AnyCase::F64(Case::from_bits(&bits))
        }
    }
}

/// A case as an expression in Rust.
pub fn rust_case<F: Float>(case: &Case<F>) -> String {
    let [origin, direction, a, b, c] = case.vectors().map(|v| rust_list(&v));
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    // -0 is not the default, though it is equal to it.
    let starts_at_zero = t_min.to_bits() == F::zero().to_bits();
    let interval = if starts_at_zero && t_max == F::infinity() {
        String::new()
    } else {
        format!(".on({}, {})", rust_number(t_min), rust_number(t_max))
    };
    format!(
        "Case::<{}>::new({origin}, {direction}, [{a}, {b}, {c}]){interval}",
        F::NAME
    )
}

/// Numbers as an array in Rust.
pub fn rust_list<F: Float>(numbers: &[F]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| rust_number(*x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// The shortest literal that is the number; a NaN by its bits.
fn rust_number<F: Float>(x: F) -> String {
    let scalar = F::NAME;
    if x.is_nan() {
        return format!("{scalar}::from_bits(0x{})", x.hex());
    }
    if x.is_finite() {
        return format!("{x:?}");
    }
    let sign = if x.is_sign_negative() { "-" } else { "" };
    format!("{sign}{scalar}::INFINITY")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_comes_back_from_its_bits_and_nothing_else_does() {
        let case = Case::<f32>::new(
            [0.1, -0.0, f32::NAN],
            [1.0; 3],
            [[0.0; 3], [2.0; 3], [1e30; 3]],
        );
        let case = case.on(-1.0, f32::INFINITY);
        let again = Case::<f32>::from_hex(&case.hex()).unwrap();
        assert_eq!(again.hex(), case.hex());
        assert_eq!(Case::<f32>::from_bits(&case.bits()).hex(), case.hex());
        assert!(
            Case::<f64>::from_hex(&case.hex()).is_none(),
            "of the other scalar"
        );
        for bad in ["", "o=", "o=zz,00000000,00000000 d=", &case.hex()[..60]] {
            assert!(Case::<f32>::from_hex(bad).is_none(), "{bad}");
        }
    }
}
