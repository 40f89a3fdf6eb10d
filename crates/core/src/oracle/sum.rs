//! The exact sign of a sum of products of four floats, whatever their exponents, in integers of 256 bits.

use super::fixed::I256;
use std::cmp::Ordering;

/// Four integers of up to 53 bits times 2^exponent.
#[derive(Clone, Copy)]
pub(super) struct ExactProduct {
    /// The four integers that are multiplied.
    pub factors: [i64; 4],
    /// At least -2^19 and below 2^19. The exponent of a zero need only be below that of any other.
    pub exponent: i32,
}

impl ExactProduct {
    /// For places that are not used.
    pub const ZERO: ExactProduct = ExactProduct {
        factors: [0; 4],
        exponent: 0,
    };

    fn digits(&self) -> I256 {
        let [x, y, z, w] = self.factors.map(i128::from);
        I256::product(x * y, z * w)
    }
}

/// 64 = 2^6 products of four factors below 2^53: their sum is below 2^[`BITS`].
const BITS: u32 = 6 + 4 * 53;

/// The sign of a sum of up to 64 products.
///
/// Products are added from the largest exponent down. Before each one the sum is put into its unit, 2^exponent. All
/// that is still to come is below 2^[`BITS`] units. If the sum is as large as that, its sign is decided. If not, it
/// is below that, and below twice that after the addition: 256 bits hold it.
pub(super) fn sign_of_sum(products: &[ExactProduct]) -> Ordering {
    // To be sorted: the exponent, and in the lowest six bits the place of the product.
    let mut keys = [0; 64];
    let keys = &mut keys[..products.len()];
    for (place, product) in products.iter().enumerate() {
        keys[place] = (product.exponent + (1 << 19)) << 6 | place as i32;
    }
    keys.sort_unstable();
    let mut sum = I256::ZERO;
    let mut unit = 0;
    for key in keys.iter().rev() {
        let product = &products[(key & 63) as usize];
        if sum != I256::ZERO {
            let finer = (unit - product.exponent) as u32;
            if sum.bits() + finer > BITS {
                break;
            }
            sum = sum.shifted(finer);
        }
        sum = sum + product.digits();
        unit = product.exponent;
    }
    sum.cmp(&I256::ZERO)
}

#[cfg(test)]
mod tests {
    use super::super::fixed::number_of_bits;
    use super::*;
    use crate::case::Draw;
    use num_bigint::BigInt;

    #[test]
    fn a_sum_decides_only_if_it_outweighs_all_that_may_come() {
        let most = (1 << 53) - 1;
        let large = ExactProduct {
            factors: [-most, most, most, most],
            exponent: 0,
        };
        let mut products = vec![large; 42];
        products[0] = ExactProduct {
            factors: [1; 4],
            exponent: 217,
        };
        assert_eq!(sign_of_sum(&products), Ordering::Less);
    }

    #[test]
    fn sums_that_cancel_down_to_any_place_have_the_sign_of_integers_of_any_size() {
        let mut signs = [0; 3];
        for index in 0..40_000 {
            let mut draw = Draw::new("sums", 1, index);
            let (mut sum, mut products) = (BigInt::ZERO, Vec::new());
            let mut exponent = 5000;
            let count = draw.pick(&[2, 4, 16]);
            for _ in 0..count {
                exponent -=
                    draw.pick(&[0, 0, 0, 1, 53, 100, 205, 211, 212, 213, 217, 218, 219, 400]);
                let mut add = |factors: [i64; 4], more: i64| {
                    let product: BigInt = factors.iter().map(|x| BigInt::from(*x)).product();
                    sum += product << (exponent + more);
                    products.push(ExactProduct {
                        factors,
                        exponent: (exponent + more) as i32,
                    });
                };
                let factors = [0; 4].map(|_| {
                    let bits = draw.pick(&[1, 40, 53, 53]);
                    i64::try_from(number_of_bits(&mut draw, bits)).expect("53 bits")
                });
                add(factors, 0);
                // What cancels it, in full or but for a little: another product that is as large.
                let [x, y, z, w] = factors;
                match draw.below(4) {
                    0 => add([-y, z, x, w], 0),
                    1 => add([y, -x + draw.integer(-1, 1), w, z], 0),
                    2 if x % 2 == 0 => add([-x / 2, y, z, w], 1),
                    _ => {}
                }
            }
            let first = draw.below(products.len());
            products.rotate_left(first);
            assert_eq!(sign_of_sum(&products), sum.cmp(&BigInt::ZERO), "{index}");
            signs[(sum.cmp(&BigInt::ZERO) as i8 + 1) as usize] += 1;
        }
        assert!(
            signs[0].min(signs[2]) > 10_000 && signs[1] > 1000,
            "{signs:?}"
        );
    }
}
