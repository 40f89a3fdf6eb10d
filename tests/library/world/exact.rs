//! The second world's truth: signs of determinants, in `f64` where a bound on the error says that they are right, and
//! otherwise in integers.

use num_bigint::BigInt;
use std::cmp::Ordering;

pub type Point = [f64; 3];

pub fn minus(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

pub fn plus(p: Point, q: Point, times: f64) -> Point {
    [
        p[0] + times * q[0],
        p[1] + times * q[1],
        p[2] + times * q[2],
    ]
}

pub fn dot(p: Point, q: Point) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

pub fn cross(p: Point, q: Point) -> Point {
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

pub fn length(p: Point) -> f64 {
    dot(p, p).sqrt()
}

pub fn unit(p: Point) -> Point {
    let length = length(p);
    p.map(|x| x / length)
}

/// All numbers as integers, times the same power of two, whose exponent is at most 0.
fn integers<const N: usize>(points: [Point; N]) -> ([[BigInt; 3]; N], u32) {
    let parts = points.map(|point| point.map(parts));
    let used = parts.iter().flatten().filter(|(digits, _)| *digits != 0);
    let low = used
        .map(|(_, exponent)| *exponent)
        .min()
        .unwrap_or(0)
        .min(0);
    let whole = |(digits, exponent): (i64, i32)| match digits {
        0 => BigInt::ZERO,
        _ => BigInt::from(digits) << (exponent - low) as u32,
    };
    (parts.map(|point| point.map(whole)), low.unsigned_abs())
}

/// A float's digits as an integer, and the exponent of their unit.
fn parts(x: f64) -> (i64, i32) {
    assert!(x.is_finite());
    let (bits, sign) = (x.to_bits(), if x < 0.0 { -1 } else { 1 });
    let (exponent, digits) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    match exponent {
        0 => (sign * digits, -1074),
        _ => (sign * (digits | 1 << 52), exponent - 1075),
    }
}

fn whole_minus(p: &[BigInt; 3], q: &[BigInt; 3]) -> [BigInt; 3] {
    [&p[0] - &q[0], &p[1] - &q[1], &p[2] - &q[2]]
}

fn whole_determinant(p: &[BigInt; 3], q: &[BigInt; 3], r: &[BigInt; 3]) -> BigInt {
    &p[0] * (&q[1] * &r[2] - &q[2] * &r[1])
        + &p[1] * (&q[2] * &r[0] - &q[0] * &r[2])
        + &p[2] * (&q[0] * &r[1] - &q[1] * &r[0])
}

fn sign(x: &BigInt) -> i32 {
    x.cmp(&BigInt::ZERO) as i32
}

/// The sign of p . (q x r) where `f64` is sure of it. Ten roundings of 2^-53 each are 1.2e-15.
fn sure(p: Point, q: Point, r: Point) -> Option<i32> {
    let all = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let [one, other] = [p[i] * (q[j] * r[k]), p[i] * (q[k] * r[j])];
        (one - other, one.abs() + other.abs())
    });
    let [value, most] = [
        all[0].0 + all[1].0 + all[2].0,
        all[0].1 + all[1].1 + all[2].1,
    ];
    let is_sure = 1e-200 < most && 2e-15 * most < value.abs();
    is_sure.then(|| {
        value
            .partial_cmp(&0.0)
            .map_or(0, |order: Ordering| order as i32)
    })
}

/// How a line meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The sign of the direction along (b - a) x (c - a); 0 for a parallel line.
    pub facing: i32,
    /// The signs of the weights of a, b and c: -1 outside.
    pub weights: [i32; 3],
    /// The sign of t.
    pub ahead: i32,
}

impl Meeting {
    pub fn of(origin: Point, direction: Point, [a, b, c]: [Point; 3]) -> Meeting {
        let [p, q, r] = [a, b, c].map(|corner| minus(corner, origin));
        let (e, f) = (minus(b, a), minus(c, a));
        let near = [
            sure(direction, e, f),
            sure(direction, q, r),
            sure(direction, r, p),
            sure(direction, p, q),
            sure(p, e, f),
        ];
        let signs = match near {
            [Some(facing), Some(u), Some(v), Some(w), Some(ahead)] => [facing, u, v, w, ahead],
            _ => {
                let ([o, d, a, b, c], _) = integers([origin, direction, a, b, c]);
                let [p, q, r] = [&a, &b, &c].map(|corner| whole_minus(corner, &o));
                let (e, f) = (whole_minus(&b, &a), whole_minus(&c, &a));
                let all = [
                    [&d, &e, &f],
                    [&d, &q, &r],
                    [&d, &r, &p],
                    [&d, &p, &q],
                    [&p, &e, &f],
                ];
                all.map(|[p, q, r]| sign(&whole_determinant(p, q, r)))
            }
        };
        let [facing, u, v, w, ahead] = signs;
        Meeting {
            facing,
            weights: [u, v, w].map(|weight| weight * facing),
            ahead: ahead * facing,
        }
    }

    /// Whether the ray hits the triangle, its boundary included.
    pub fn is_hit(&self) -> bool {
        self.facing != 0 && self.weights.iter().all(|weight| 0 <= *weight) && self.ahead == 1
    }
}

/// The sign of the height of origin + t * direction over a triangle's plane; it is above where the corners run
/// counter-clockwise.
pub fn side(origin: Point, t: f64, direction: Point, [a, b, c]: [Point; 3]) -> i32 {
    let (e, f) = (minus(b, a), minus(c, a));
    if let Some(sign) = sure(minus(origin, a), e, f).filter(|_| t == 0.0) {
        return sign;
    }
    let ([o, d, a, b, c, more], low) = integers([origin, direction, a, b, c, [t, 0.0, 0.0]]);
    let (e, f) = (whole_minus(&b, &a), whole_minus(&c, &a));
    let height = whole_determinant(&whole_minus(&o, &a), &e, &f) << low;
    sign(&(height + &more[0] * whole_determinant(&d, &e, &f)))
}

#[test]
fn signs_are_right_where_floats_are_not_sure() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let down = [0.0, 0.0, -1.0];
    let meeting = |x: f64, y: f64| Meeting::of([x, y, 2.0], down, triangle);
    assert_eq!(
        meeting(0.25, 0.25),
        Meeting {
            facing: -1,
            weights: [1, 1, 1],
            ahead: 1
        }
    );
    assert_eq!(meeting(0.5, 0.5).weights, [0, 1, 1]);
    assert_eq!(meeting(0.5, 0.5f64.next_up()).weights, [-1, 1, 1]);
    assert_eq!(meeting(0.5, 0.5f64.next_down()).weights, [1, 1, 1]);
    assert_eq!(meeting(-1e-300, 0.5).weights, [1, -1, 1]);
    assert!(meeting(0.0, 0.0).is_hit() && !meeting(-1e-300, 0.0).is_hit());
    assert_eq!(Meeting::of([0.1, 0.1, -2.0], down, triangle).ahead, -1);
    assert_eq!(
        Meeting::of([0.1, 0.1, 0.0], [1.0, 0.0, 0.0], triangle).facing,
        0
    );
    for (z, t, expected) in [
        (0.0, 0.0, 0),
        (1e-310, 0.0, 1),
        (0.5, 0.5, 0),
        (0.5, 0.75, -1),
    ] {
        assert_eq!(side([9.0, 7.0, z], t, down, triangle), expected, "{z} {t}");
    }
    let almost = 0.5f64.next_down();
    assert_eq!(side([9.0, 7.0, 0.5], almost, down, triangle), 1);
}
