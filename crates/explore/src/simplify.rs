//! Which of two cases is simpler, and the single steps towards simpler ones.

use crate::arith::{Float, Vector, decompose, scale_by_power_of_two};
use crate::case::{Case, Ray, Triangle};
use std::array;
use std::cmp::Reverse;

/// How simple a case is; smaller is simpler. A total order on cases:
/// 1. the bits that its seventeen numbers need: of ±m·2^e with m odd, those of m, those of |e|, and
///    one each for a minus sign, for a negative e and for a t_max that is not the default; nothing for
///    a zero;
/// 2. the different values among them, signs aside: shared coordinates are simpler;
/// 3. the sum of the |e|: nearer to one is simpler;
/// 4. their bit patterns, in the order of [`Case::bits`], so that no two cases are alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Size {
    /// The bits that the numbers need.
    pub bits: u32,
    /// The different values.
    pub values: usize,
    exponents: u32,
    patterns: [u64; 17],
}

impl Size {
    /// The size of a case.
    pub fn of<F: Float>(case: &Case<F>) -> Size {
        let coordinates = case.vectors();
        let ends = [case.ray.t_min, case.ray.t_max];
        let mut all = coordinates.iter().flatten().chain(&ends);
        let mut values: [u64; 17] = array::from_fn(|_| all.next().map_or(0, |x| x.abs().to_bits()));
        values.sort_unstable();
        let parts = coordinates
            .iter()
            .flatten()
            .chain(&ends)
            .filter_map(|x| odd_and_exponent(*x));
        Size {
            bits: bits(case),
            values: values.chunk_by(u64::eq).count(),
            exponents: parts.map(|(_, exponent)| exponent.unsigned_abs()).sum(),
            patterns: case.bits(),
        }
    }

    /// The size of a case that is simpler than another; none if it is not.
    pub fn below<F: Float>(case: &Case<F>, other: &Size) -> Option<Size> {
        // The bits decide most, and are the quickest to count.
        (bits(case) <= other.bits)
            .then(|| Size::of(case))
            .filter(|size| size < other)
    }
}

/// The bits that a case's numbers need.
fn bits<F: Float>(case: &Case<F>) -> u32 {
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    let far = if t_max == F::infinity() {
        0
    } else {
        1 + number_bits(t_max)
    };
    let coordinates = case.vectors();
    coordinates
        .as_flattened()
        .iter()
        .map(|x| number_bits(*x))
        .sum::<u32>()
        + number_bits(t_min)
        + far
}

/// The bits that a number needs; more than any finite number for an infinity and a NaN.
fn number_bits<F: Float>(x: F) -> u32 {
    let negative = u32::from(x.is_sign_negative());
    let Some((digits, exponent)) = odd_and_exponent(x) else {
        return if x.is_zero() {
            negative
        } else {
            100 + negative
        };
    };
    let of = |n: u64| u64::BITS - n.leading_zeros();
    of(digits) + of(exponent.unsigned_abs().into()) + negative + u32::from(exponent < 0)
}

/// |x| = m·2^e with m odd; none of zero, infinities and NaN.
pub(super) fn odd_and_exponent<F: Float>(x: F) -> Option<(u64, i32)> {
    if x.is_zero() || !x.is_finite() {
        return None;
    }
    let (digits, exponent) = decompose(x.to_f64());
    Some((digits.unsigned_abs(), exponent as i32))
}

/// One step. What it makes may be no simpler, or the same case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Simplification {
    /// One end of the interval, or both, to the default: bit 0 is t_min, bit 1 t_max.
    DefaultInterval(u8),
    /// Another case altogether: a ray along z at a small right triangle in the plane z = 0, by number.
    Lattice(usize),
    /// The origin one direction before the point where the line meets the plane (behind it if t is
    /// negative, on it if t is zero), with the same direction, or that along an axis: twice the axis,
    /// plus one for the negative one.
    Aim(Option<usize>),
    /// All points moved so that this point (0 the origin, 2 to 4 the vertices) is zero on these axes.
    MoveToZero {
        /// The point.
        point: usize,
        /// A bit an axis.
        axes: u8,
    },
    /// Vectors multiplied by a power of two: bit 0 is the points, bit 1 the direction.
    Scale {
        /// Which vectors.
        vectors: u8,
        /// By how much.
        by: ScaleBy,
    },
    /// Two axes negated in every vector; the third is left alone.
    TurnHalf(usize),
    /// One coordinate of one point copied from another.
    Copy {
        /// The point it is taken from.
        from: usize,
        /// The point that changes.
        to: usize,
        /// The axis.
        axis: usize,
    },
    /// Every coordinate of the points that equals this one on its axis changed alike.
    Everywhere(usize, SimplerNumber),
    /// One number changed, by its place in [`Case::bits`].
    Number(usize, SimplerNumber),
    /// Two coordinates set to small integers at once.
    Pair([usize; 2], [i8; 2]),
}

/// A power of two for [`Simplification::Scale`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScaleBy {
    /// The smallest power that makes all of them integers.
    ToIntegers,
    /// The power that puts the largest into [1, 2).
    LargestToOne,
    /// By this power.
    Power(i8),
}

/// How one number becomes simpler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimplerNumber {
    /// To a small integer.
    To(i8),
    /// Its sign dropped.
    Positive,
    /// Cut to this many leading bits, towards zero.
    Cut(u8),
    /// Cut to this many leading bits, away from zero.
    CutUp(u8),
    /// To the nearest integer.
    Integer,
    /// Multiplied by 2 to this power.
    Scaled(i8),
    /// The power of two in it halved.
    HalfExponent,
    /// Without its lowest bit that is set.
    LowestBitCleared,
    /// With its lowest bit that is set added once more.
    LowestBitAdded,
}

/// The list of simplifications, in words for users.
pub const SIMPLIFICATIONS: &str = "default interval, a lattice case, an origin one axis before the plane, \
    a point moved to zero, scaling by powers of two, \
    turning about an axis, copied coordinates, fewer bits, smaller exponents, small integers (one \
    number, all equal ones on an axis, or two coordinates at once)";

const POINTS: [usize; 4] = [0, 2, 3, 4];

impl Simplification {
    /// Every step, in the order of trying.
    pub fn all() -> Vec<Simplification> {
        use Simplification::*;
        let mut all: Vec<Simplification> = [3, 1, 2].map(DefaultInterval).to_vec();
        all.extend((0..LATTICE_CASES).map(Lattice));
        all.extend((0..6).map(Some).chain([None]).map(Aim));
        for axes in [7, 1, 2, 4] {
            all.extend(POINTS.map(|point| MoveToZero { point, axes }));
        }
        for by in [
            ScaleBy::ToIntegers,
            ScaleBy::LargestToOne,
            ScaleBy::Power(-1),
            ScaleBy::Power(1),
            ScaleBy::Power(-8),
            ScaleBy::Power(8),
        ] {
            all.extend([3, 1, 2].map(|vectors| Scale { vectors, by }));
        }
        all.extend([0, 1, 2].map(TurnHalf));
        let coordinates_of_points = POINTS
            .into_iter()
            .flat_map(|p| [3 * p, 3 * p + 1, 3 * p + 2]);
        let changes = SimplerNumber::all();
        for number in coordinates_of_points {
            all.extend(changes.iter().map(|change| Everywhere(number, *change)));
        }
        for axis in 0..3 {
            for (from, to) in POINTS
                .into_iter()
                .flat_map(|from| POINTS.map(|to| (from, to)))
            {
                all.extend((from != to).then_some(Copy { from, to, axis }));
            }
        }
        for number in 0..17 {
            all.extend(changes.iter().map(|change| Number(number, *change)));
        }
        for (i, j) in (0..15).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let values = [0, 1, -1]
                .into_iter()
                .flat_map(|x| [0, 1, -1].map(|y| [x, y]));
            all.extend(values.map(|values| Pair([i, j], values)));
        }
        all
    }

    /// The case after the step.
    pub fn apply<F: Float>(self, case: &Case<F>) -> Case<F> {
        let mut vectors = case.vectors();
        let mut interval = [case.ray.t_min, case.ray.t_max];
        match self {
            Simplification::DefaultInterval(ends) => {
                for (end, default) in [F::zero(), F::infinity()].into_iter().enumerate() {
                    if ends >> end & 1 == 1 {
                        interval[end] = default;
                    }
                }
            }
            Simplification::Lattice(number) => vectors = lattice_case(number),
            Simplification::Aim(axis) => {
                if let Some([origin, direction]) = aimed(case, axis) {
                    (vectors[0], vectors[1]) = (origin, direction);
                }
            }
            Simplification::MoveToZero { point, axes } => {
                let by = vectors[point];
                for axis in (0..3).filter(|axis| axes >> axis & 1 == 1) {
                    for i in POINTS {
                        vectors[i][axis] = vectors[i][axis] - by[axis];
                    }
                }
            }
            Simplification::Scale { vectors: which, by } => {
                let chosen = || (0..5).filter(|i| which >> usize::from(*i == 1) & 1 == 1);
                let power = by.power(chosen().flat_map(|i| vectors[i]));
                let scaled = |x: F| F::from_f64(scale_by_power_of_two(x.to_f64(), power));
                chosen().for_each(|i| vectors[i] = vectors[i].map(scaled));
            }
            Simplification::TurnHalf(axis) => {
                for vector in &mut vectors {
                    // No zero becomes a negative one.
                    let turned = vector.map(|x| if x.is_zero() { x } else { -x });
                    *vector =
                        std::array::from_fn(|i| if i == axis { vector[i] } else { turned[i] });
                }
            }
            Simplification::Copy { from, to, axis } => vectors[to][axis] = vectors[from][axis],
            Simplification::Everywhere(number, change) => {
                let axis = number % 3;
                let value = vectors[number / 3][axis];
                for i in POINTS
                    .into_iter()
                    .filter(|&i| case.vectors()[i][axis] == value)
                {
                    vectors[i][axis] = change.apply(value);
                }
            }
            Simplification::Number(number, change) => match number {
                15 | 16 => interval[number - 15] = change.apply(interval[number - 15]),
                _ => {
                    vectors[number / 3][number % 3] = change.apply(vectors[number / 3][number % 3])
                }
            },
            Simplification::Pair(numbers, values) => {
                for (number, value) in numbers.into_iter().zip(values) {
                    vectors[number / 3][number % 3] = F::from_f64(value.into());
                }
            }
        }
        let [origin, direction, a, b, c] = vectors;
        Case::new(origin, direction, [a, b, c]).on(interval[0], interval[1])
    }
}

/// Two windings, sixteen places in the plane, three heights of the origin, two directions.
const LATTICE_CASES: usize = 2 * 16 * 3 * 2;

fn lattice_case<F: Float>(number: usize) -> [[F; 3]; 5] {
    let digit = |unit: usize, base: usize| (number / unit % base) as f64;
    let (winding, down) = (number % 2, number / 2 % 2);
    let origin = [digit(12, 4) - 1.0, digit(48, 4) - 1.0, digit(4, 3) - 1.0];
    let direction = [0.0, 0.0, if down == 1 { -1.0 } else { 1.0 }];
    let (mut b, mut c) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    if winding == 1 {
        (b, c) = (c, b);
    }
    [origin, direction, [0.0; 3], b, c].map(|v| v.map(F::from_f64))
}

/// Origin and direction of [`Simplification::Aim`]; none where the line does not cross the plane.
fn aimed<F: Float>(case: &Case<F>, axis: Option<usize>) -> Option<[[F; 3]; 2]> {
    let Case {
        ray: Ray {
            origin, direction, ..
        },
        triangle: Triangle { a, b, c },
    } = case;
    let normal = b.minus(a).cross(&c.minus(a));
    let t = normal.dot(&a.minus(origin)) / normal.dot(direction);
    if !t.is_finite() {
        return None;
    }
    let met = origin.plus(&direction.times(&t));
    let along = axis.map_or(*direction, |axis| {
        let length = if axis % 2 == 1 { -F::one() } else { F::one() };
        let component = |i: usize| if i == axis / 2 { length } else { F::zero() };
        F::Vector::new(component(0), component(1), component(2))
    });
    let side = if t.is_zero() { F::zero() } else { F::one() };
    let side = if t.is_sign_negative() { -side } else { side };
    Some([met.minus(&along.times(&side)).into(), along.into()])
}

impl ScaleBy {
    fn power<F: Float>(self, numbers: impl Iterator<Item = F>) -> i32 {
        let parts = numbers.filter_map(odd_and_exponent);
        match self {
            ScaleBy::Power(power) => power.into(),
            ScaleBy::ToIntegers => parts.map(|(_, e)| -e).max().unwrap_or(0),
            ScaleBy::LargestToOne => {
                let top = |(m, e): (u64, i32)| Reverse(e + m.ilog2() as i32);
                parts.map(top).min().map_or(0, |Reverse(top)| -top)
            }
        }
    }
}

impl SimplerNumber {
    fn all() -> Vec<SimplerNumber> {
        let mut all: Vec<SimplerNumber> = [0, 1, -1, 2, 3].map(SimplerNumber::To).to_vec();
        all.push(SimplerNumber::Positive);
        for bits in [1, 2, 3, 4, 6, 9, 13, 18, 24, 36, 48] {
            all.extend([SimplerNumber::Cut(bits), SimplerNumber::CutUp(bits)]);
        }
        all.extend([SimplerNumber::Integer, SimplerNumber::HalfExponent]);
        all.extend([-1, 1, -8, 8].map(SimplerNumber::Scaled));
        all.extend([
            SimplerNumber::LowestBitCleared,
            SimplerNumber::LowestBitAdded,
        ]);
        all
    }

    fn apply<F: Float>(self, x: F) -> F {
        let Some((digits, exponent)) = odd_and_exponent(x) else {
            return match self {
                SimplerNumber::To(value) => F::from_f64(value.into()),
                SimplerNumber::Positive if x.is_zero() => F::zero(),
                _ => x,
            };
        };
        let of = |digits: u64, exponent: i32| {
            let size = F::from_f64(scale_by_power_of_two(digits as f64, exponent));
            if x.is_sign_negative() && !size.is_zero() {
                -size
            } else {
                size
            }
        };
        let cut = |bits: u8, up: u64| {
            let low = (digits.ilog2() + 1).saturating_sub(bits.into());
            if low == 0 {
                x
            } else {
                of((digits >> low) + up, exponent + low as i32)
            }
        };
        match self {
            SimplerNumber::To(value) => F::from_f64(value.into()),
            SimplerNumber::Positive => x.abs(),
            SimplerNumber::Cut(bits) => cut(bits, 0),
            SimplerNumber::CutUp(bits) => cut(bits, 1),
            SimplerNumber::Integer => {
                let whole = x.to_f64().round();
                if whole == 0.0 {
                    F::zero()
                } else {
                    F::from_f64(whole)
                }
            }
            SimplerNumber::Scaled(power) => of(digits, exponent + i32::from(power)),
            SimplerNumber::HalfExponent => of(digits, exponent / 2),
            SimplerNumber::LowestBitCleared => of(digits - 1, exponent),
            SimplerNumber::LowestBitAdded => of(digits + 1, exponent),
        }
    }
}
