//! A case in other forms: as bit patterns, and back; in one of the two scalars; and as source code in Rust.

use super::Case;
use crate::arith::{Float, ScalarName};

impl<F: Float> Case<F> {
    /// The bit patterns of origin, direction, a, b, c, t_min and t_max, in hexadecimal.
    pub fn hex(&self) -> String {
        let triples = self.vectors().map(|v| v.map(F::hex).join(","));
        let [o, d, a, b, c] = triples;
        let (t_min, t_max) = (self.ray.t_min.hex(), self.ray.t_max.hex());
        format!("o={o} d={d} a={a} b={b} c={c} t={t_min},{t_max}")
    }

    /// All seventeen numbers, in the order of [`Case::hex`].
    pub fn numbers(&self) -> [F; 17] {
        let vectors = self.vectors();
        std::array::from_fn(|i| match i {
            15 => self.ray.t_min,
            16 => self.ray.t_max,
            _ => vectors[i / 3][i % 3],
        })
    }

    /// The bits of all numbers: what a digest covers.
    pub fn bits(&self) -> [u64; 17] {
        self.numbers().map(F::to_bits)
    }

    /// From the bits of all numbers.
    pub fn from_bits(bits: &[u64; 17]) -> Case<F> {
        let number = |i: usize| F::from_bits(bits[i]);
        let vector = |i: usize| [number(3 * i), number(3 * i + 1), number(3 * i + 2)];
        let triangle = [vector(2), vector(3), vector(4)];
        Case::new(vector(0), vector(1), triangle).on(number(15), number(16))
    }

    /// From what [`Case::hex`] writes; none of anything else, nor of the other scalar's.
    pub fn from_hex(text: &str) -> Option<Case<F>> {
        let words: Vec<&str> = text.split(' ').take(6).collect();
        let lists = words
            .iter()
            .filter_map(|word| Some(word.split_once('=')?.1));
        let bits: Vec<u64> = lists
            .flat_map(|list| list.split(','))
            .map(|number| u64::from_str_radix(number, 16))
            .collect::<Result<_, _>>()
            .ok()?;
        let case = Case::from_bits(bits.as_slice().try_into().ok()?);
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

    /// For `f32` and for `f64`, true if it is of that scalar.
    pub fn scalars(&self) -> [bool; 2] {
        self.scalar().alone()
    }
}

/// A case in the scalar that it was written for.
pub type AnyCase = AnyScalar<Case<f32>, Case<f64>>;

impl<F: Float> From<Case<F>> for AnyCase {
    fn from(case: Case<F>) -> AnyCase {
        let bits = case.bits();
        match F::NAME == f32::NAME {
            true => AnyCase::F32(Case::from_bits(&bits)),
            false => AnyCase::F64(Case::from_bits(&bits)),
        }
    }
}

/// A case as an expression in Rust.
pub fn rust_case<F: Float>(case: &Case<F>) -> String {
    let [origin, direction, a, b, c] = case.vectors().map(|v| rust_list(&v));
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    let interval = if t_min.to_bits() == F::zero().to_bits() && t_max == F::infinity() {
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
    if x.is_nan() {
        format!("{}::from_bits(0x{})", F::NAME, x.hex())
    } else if x.is_finite() {
        format!("{x:?}")
    } else {
        format!(
            "{}{}::INFINITY",
            if x.is_sign_negative() { "-" } else { "" },
            F::NAME
        )
    }
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
