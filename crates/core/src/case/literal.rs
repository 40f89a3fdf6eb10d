//! A case as source code in Rust.

use super::Case;
use crate::arith::Float;

/// A case as an expression in Rust.
pub fn rust_case<F: Float>(case: &Case<F>) -> String {
    let [origin, direction, a, b, c] = case.vectors().map(|v| rust_list(&v));
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    let interval = if t_min.to_bits() == F::zero().to_bits() && t_max == F::infinity() {
        String::new()
    } else {
        format!(".on({}, {})", rust_number(t_min), rust_number(t_max))
    };
    format!("Case::<{}>::new({origin}, {direction}, [{a}, {b}, {c}]){interval}", F::NAME)
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
        format!("{}{}::INFINITY", if x.is_sign_negative() { "-" } else { "" }, F::NAME)
    }
}
