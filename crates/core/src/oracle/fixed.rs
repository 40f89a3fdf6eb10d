//! Integers of 192 and of 256 bits, for what does not fit in 128.

use num_bigint::BigInt;
use std::cmp::Ordering;
use std::ops::{Add, Neg, Sub};

/// An integer of 192 bits: what determinants of coordinates of 61 bits need, and no more than that.
///
/// `high * 2^64 + low`. Ordered by value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct I192 {
    high: i128,
    low: u64,
}

impl I192 {
    /// The product of any `a` and of a `b` below 2^126 in absolute value.
    #[inline(always)]
    pub fn product(a: i64, b: i128) -> I192 {
        let a = i128::from(a);
        let low = a * i128::from(b as u64);
        I192 {
            high: a * (b >> 64) + (low >> 64),
            low: low as u64,
        }
    }
}

impl Add for I192 {
    type Output = I192;
    #[inline(always)]
    fn add(self, other: I192) -> I192 {
        let (low, carry) = self.low.overflowing_add(other.low);
        I192 {
            high: self.high + other.high + i128::from(carry),
            low,
        }
    }
}

impl Sub for I192 {
    type Output = I192;
    #[inline(always)]
    fn sub(self, other: I192) -> I192 {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        I192 {
            high: self.high - other.high - i128::from(borrow),
            low,
        }
    }
}

impl From<I192> for BigInt {
    fn from(I192 { high, low }: I192) -> BigInt {
        (BigInt::from(high) << 64) + low
    }
}

impl From<I192> for I256 {
    #[inline(always)]
    fn from(I192 { high, low }: I192) -> I256 {
        I256 {
            high: high >> 64,
            low: (high as u128) << 64 | u128::from(low),
        }
    }
}

/// An integer of 256 bits.
///
/// `high * 2^128 + low`. Ordered by value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct I256 {
    high: i128,
    low: u128,
}

/// A number's upper and lower 64 bits.
#[inline(always)]
fn halves(x: u128) -> [u128; 2] {
    [x >> 64, x & u128::from(u64::MAX)]
}

impl I256 {
    pub(super) const ZERO: I256 = I256 { high: 0, low: 0 };

    /// The factors of a product have to be below this in absolute value: 2^107.
    pub(super) const MOST_OF_A_FACTOR: u128 = 1 << 107;

    /// The product of two numbers below [`I256::MOST_OF_A_FACTOR`] in absolute value.
    #[inline(always)]
    pub(super) fn product(a: i128, b: i128) -> I256 {
        let [a_high, a_low] = halves(a.unsigned_abs());
        let [b_high, b_low] = halves(b.unsigned_abs());
        let middle = a_high * b_low + a_low * b_high;
        let (low, carry) = (a_low * b_low).overflowing_add(middle << 64);
        let high = a_high * b_high + (middle >> 64) + u128::from(carry);
        let size = I256 {
            high: high as i128,
            low,
        };
        if (a < 0) == (b < 0) { size } else { -size }
    }

    /// The absolute value of any number but -2^255.
    #[inline(always)]
    pub(super) fn size(self) -> I256 {
        if self.high < 0 { -self } else { self }
    }

    /// The product of a number from 0 to 2^191 and any `u64`.
    #[inline(always)]
    pub(super) fn times(self, factor: u64) -> I256 {
        let factor = u128::from(factor);
        let [middle, low] = halves(self.low).map(|half| half * factor);
        let [carried, low] = halves(low);
        let [above, middle] = halves(middle + carried);
        I256 {
            high: self.high * factor as i128 + above as i128,
            low: middle << 64 | low,
        }
    }

    /// How many bits its absolute value has.
    #[inline(always)]
    pub(super) fn bits(self) -> u32 {
        let I256 { high, low } = self.size();
        if high == 0 {
            128 - low.leading_zeros()
        } else {
            256 - high.leading_zeros()
        }
    }

    /// Times 2^places. The result has at most 255 bits.
    #[inline(always)]
    pub(super) fn shifted(self, places: u32) -> I256 {
        match places {
            0 => self,
            1..128 => I256 {
                high: self.high << places | (self.low >> (128 - places)) as i128,
                low: self.low << places,
            },
            _ => I256 {
                high: (self.low << (places - 128)) as i128,
                low: 0,
            },
        }
    }

    /// The order of this number times 2^places and another one. Both are positive.
    #[inline(always)]
    pub(super) fn compare_scaled(self, places: i64, other: I256) -> Ordering {
        let [bits, other_bits] = [self, other].map(I256::bits);
        let by_length = (i64::from(bits) + places).cmp(&i64::from(other_bits));
        // Of one length, they are compared from their highest bits on.
        let up = self.shifted(255 - bits);
        by_length.then(up.cmp(&other.shifted(255 - other_bits)))
    }
}

impl From<i128> for I256 {
    #[inline(always)]
    fn from(x: i128) -> I256 {
        I256 {
            high: x >> 127,
            low: x as u128,
        }
    }
}

impl Add for I256 {
    type Output = I256;
    #[inline(always)]
    fn add(self, other: I256) -> I256 {
        let (low, carry) = self.low.overflowing_add(other.low);
        I256 {
            high: self.high + other.high + i128::from(carry),
            low,
        }
    }
}

impl Neg for I256 {
    type Output = I256;
    #[inline(always)]
    fn neg(self) -> I256 {
        I256 {
            high: !self.high,
            low: !self.low,
        } + I256 { high: 0, low: 1 }
    }
}

/// A number of so many bits: the largest, a power of two, or any; of either sign.
#[cfg(test)]
pub(super) fn number_of_bits(draw: &mut crate::case::Draw, bits: i64) -> BigInt {
    let most: BigInt = (BigInt::from(1) << bits) - 1;
    let any: BigInt = (0..4).fold(BigInt::ZERO, |sum, _| (sum << 64) + draw.bits());
    let x = match draw.below(3) {
        0 => most.clone(),
        1 => (&most + 1) >> 1,
        _ => any & &most,
    };
    x * draw.pick(&[1, -1])
}

#[cfg(test)]
mod tests {
    use super::super::integer::ExactInteger;
    use super::*;
    use crate::case::Draw;

    impl I256 {
        fn big(self) -> BigInt {
            (BigInt::from(self.high) << 128) + self.low
        }

        fn of(value: &BigInt) -> I256 {
            let low: BigInt = value & BigInt::from(u128::MAX);
            let high: BigInt = value >> 128;
            I256 {
                high: high.try_into().expect("256 bits"),
                low: low.try_into().expect("128 bits"),
            }
        }
    }

    /// Numbers near the ends of their bits, near zero, and between.
    fn number(draw: &mut Draw, bits: u32) -> i128 {
        let most = (1i128 << bits) - 1;
        let near = i128::from(draw.integer(0, 2));
        let any = (i128::from(draw.bits()) << 64 | i128::from(draw.bits())) & most;
        let carry = i128::from(u64::MAX) & most;
        let x = draw.pick(&[
            near,
            most - near,
            any,
            any >> (bits / 2),
            (carry + near) & most,
        ]);
        if draw.coin() { x } else { -x }
    }

    #[test]
    fn products_sums_and_orders_are_those_of_integers_of_any_size() {
        let mut carries = 0;
        for index in 0..20_000 {
            let mut draw = Draw::new("wide", 1, index);
            let mut product = || {
                let (a, b) = (number(&mut draw, 63) as i64, number(&mut draw, 125));
                let product = I192::product(a, b);
                assert_eq!(product.big(), BigInt::from(a) * BigInt::from(b), "{a} {b}");
                product
            };
            let (x, y) = (product(), product());
            let (sum, difference) = (x + y, x - y);
            assert_eq!(sum.big(), x.big() + y.big(), "{x:?} {y:?}");
            assert_eq!(difference.big(), x.big() - y.big(), "{x:?} {y:?}");
            assert_eq!(difference.sign(), x.big().cmp(&y.big()), "{x:?} {y:?}");
            assert_eq!(x.sign(), x.big().cmp(&BigInt::ZERO), "{x:?}");
            assert_eq!(I256::from(x).big(), x.big(), "{x:?}");
            carries += usize::from(sum.high != x.high + y.high);
        }
        assert!(carries > 1000, "{carries}");
    }

    #[test]
    fn integers_of_256_bits_are_those_of_any_size() {
        for index in 0..20_000 {
            let mut draw = Draw::new("256 bits", 1, index);
            let [x, y] = [0; 2].map(|_| {
                let bits = draw.integer(1, 254);
                number_of_bits(&mut draw, bits)
            });
            let places = 255 - x.bits().max(1);
            let places = draw.integer(0, places as i64) as u32;
            let [a, b] = [&x, &y].map(I256::of);
            assert_eq!(
                [a.big(), b.big(), (a + b).big()],
                [x.clone(), y.clone(), &x + &y]
            );
            assert_eq!(((-a).big(), a.cmp(&b)), (-&x, x.cmp(&y)), "{x} {y}");
            assert_eq!(
                (u64::from(a.bits()), a.shifted(places).big()),
                (x.bits(), &x << places)
            );
            assert_eq!(I256::from(a.low as i128).big(), BigInt::from(a.low as i128));
            let of_both = [0; 2].map(|_| {
                let bits = draw.integer(0, 107);
                i128::try_from(number_of_bits(&mut draw, bits)).expect("107 bits")
            });
            let [x, y] = of_both.map(BigInt::from);
            assert_eq!(I256::product(of_both[0], of_both[1]).big(), x * y);
            let bits = draw.integer(0, 191);
            let long = number_of_bits(&mut draw, bits);
            let any = draw.bits();
            let factor = draw.pick(&[0, 1, u64::MAX, any]);
            let size = I256::of(&long).size();
            assert_eq!(size.big().magnitude(), long.magnitude());
            assert_eq!(
                size.times(factor).big(),
                size.big() * factor,
                "{long} {factor}"
            );
        }
    }

    #[test]
    fn a_scaled_number_is_compared_as_integers_of_any_size_are() {
        let mut orders = [0; 3];
        for index in 0..40_000 {
            let mut draw = Draw::new("scaled", 1, index);
            let bits = draw.integer(1, 245);
            let mut x = I256::of(&number_of_bits(&mut draw, bits)).size().big();
            let places = draw.integer(-250, 250);
            // Often the other number is the scaled one, or beside it.
            let mut y = match draw.below(3) {
                0 => I256::of(&number_of_bits(&mut draw, bits)).size().big(),
                _ if places < 0 => {
                    x = x >> -places << -places;
                    &x >> -places
                }
                _ => &x << places,
            };
            y += draw.integer(-1, 1);
            let is_positive = x > BigInt::ZERO && y > BigInt::ZERO;
            if y.bits() > 245 || !is_positive {
                continue;
            }
            let expected = if places < 0 {
                x.cmp(&(&y << -places))
            } else {
                (&x << places).cmp(&y)
            };
            let order = I256::of(&x).compare_scaled(places, I256::of(&y));
            assert_eq!(order, expected, "{x} {places} {y}");
            orders[(order as i8 + 1) as usize] += 1;
        }
        assert!(orders.iter().all(|count| *count > 3000), "{orders:?}");
    }
}
