//! The meaning of signs, and the points that tell two polynomials apart.

use super::super::format::{F32, Format};
use super::super::modular::PRIME;
use super::super::points::{FAR, NEAR, T, UV, V, VW, W, WU};
use super::super::reader::Reader;
use super::*;

fn promise(extent: &str, is_front: bool) -> Promise {
    let sides = if is_front { "front" } else { "both" };
    Promise::parse(&[extent, sides]).expect("a promise")
}

/// Signs of a ray that hits the inside of the front, between the ends, with some of them changed. There the weights and
/// their sums are positive and D is negative, so T is negative after 0.
fn signs(changes: &[(usize, i8)]) -> KnownSigns {
    let mut signs = [1; COUNT];
    for number in [T, NEAR, FAR] {
        signs[number] = -1;
    }
    for (number, sign) in changes {
        signs[*number] = *sign;
    }
    signs
}

/// For each part of a line and its sides, and each change of the signs: what is wrong with a hit, and whether the closed
/// triangle may be hit.
#[test]
fn hits_and_misses_by_their_signs() {
    const INSIDE: Option<&str> = Some("do not pass through the inside of the triangle");
    const BACK: Option<&str> = Some("hit the back, and it promises the front only");
    const START: Option<&str> = Some("meet the triangle at t <= 0");
    const NEAREST: Option<&str> = Some("meet the triangle at t <= t_min");
    const FARTHEST: Option<&str> = Some("meet the triangle at t >= t_max");
    let back = [
        (U, -1),
        (V, -1),
        (W, -1),
        (SUM, -1),
        (T, 1),
        (NEAR, 1),
        (FAR, 1),
    ];
    for (extent, is_front, changes, wrong, may_hit) in [
        ("line", true, &[][..], None, true),
        ("line", false, &back[..], None, true),
        ("line", true, &back[..], BACK, false),
        ("line", false, &[(U, -1)], INSIDE, false),
        ("line", false, &[(V, -1)], INSIDE, false),
        ("line", false, &[(W, -1)], INSIDE, false),
        ("line", false, &[(U, 0)], INSIDE, true),
        ("line", false, &[(V, 0)], INSIDE, true),
        ("line", false, &[(W, 0)], INSIDE, true),
        (
            "line",
            false,
            &[(U, 0), (V, 0), (W, 0), (SUM, 0)],
            INSIDE,
            false,
        ),
        ("line", false, &[(T, 1), (NEAR, 1), (FAR, 1)], None, true),
        ("ray", false, &[], None, true),
        ("ray", false, &back[..], None, true),
        ("ray", false, &[(T, 0)], START, true),
        ("ray", false, &[(T, 1)], START, false),
        ("ray", false, &[(NEAR, 1), (FAR, 1)], None, true),
        ("interval", false, &[], None, true),
        ("interval", false, &back[..], None, true),
        ("interval", false, &[(NEAR, 0)], NEAREST, true),
        ("interval", false, &[(NEAR, 1)], NEAREST, false),
        ("interval", false, &[(FAR, 0)], FARTHEST, true),
        ("interval", false, &[(FAR, 1)], FARTHEST, false),
        ("interval", false, &[(T, 1)], None, true),
    ] {
        let promise = promise(extent, is_front);
        let signs = signs(changes);
        assert_eq!(promise.wrong_hit(&signs), wrong, "{extent} {changes:?}");
        assert_eq!(
            promise.is_closed_hit(&signs),
            may_hit,
            "{extent} {changes:?}"
        );
    }
}

/// Signs that occur are tried: those of small weights, and of the ends of short intervals.
#[test]
fn signs_that_occur_can_be() {
    let all = -2..=2;
    for (u, v, w) in all
        .clone()
        .flat_map(|u| (-2..=2).flat_map(move |v| (-2..=2).map(move |w| (u, v, w))))
    {
        let (sum, determinant) = (u + v + w, -(u + v + w));
        for (t, start, length) in all
            .clone()
            .flat_map(|t| (-2..=2).flat_map(move |s| (0..=2).map(move |l| (t, s, l))))
        {
            let near = t - start * determinant;
            let far = (start + length) * determinant - t;
            let mut signs = [1; COUNT];
            let numbers = [u, v, w, u + v, v + w, w + u, sum, t, near, far];
            for (sign, number) in signs.iter_mut().zip(numbers) {
                *sign = i32::signum(number) as i8;
            }
            for extent in ["line", "ray", "interval"] {
                let promise = promise(extent, false);
                assert!(promise.can_be(&signs), "{extent} {numbers:?}");
            }
        }
    }
    // Two weights of one sign have a sum of this sign, and both ends of an interval at least one t.
    for (impossible, extent) in [
        (&[(UV, -1)][..], "line"),
        (&[(VW, 0)], "line"),
        (&[(WU, -1)], "line"),
        (&[(SUM, -1)], "line"),
        (&[(U, 0), (UV, -1)], "line"),
        (&[(NEAR, 1), (FAR, 1)], "interval"),
        (&[(NEAR, 0), (FAR, 1)], "interval"),
    ] {
        let promise = promise(extent, false);
        assert!(!promise.can_be(&signs(impossible)), "{impossible:?}");
    }
    let ray = promise("ray", false);
    assert!(ray.can_be(&signs(&[(NEAR, 1), (FAR, 1)])));
}

/// Two polynomials that differ agree at a point with a chance below 2^-54, at all points after the first below 2^-200.
#[test]
fn polynomials_are_compared_at_every_point() {
    let mut reader = Reader {
        lines: "op 0 input 3\n".lines().peekable(),
        line: 0,
        work: 0,
    };
    let program = Program::of_operations(Format::of(F32), &mut reader).unwrap();
    let known = Signs::new(promise("line", false), &program);
    assert!(200 < 54 * (known.points.len() - 1));
    let factors = &known.products.values().next().unwrap()[0];
    let of_point = |point: &Point| product(factors, point);
    let values: Vec<u64> = known
        .points
        .iter()
        .map(|point| times(3, of_point(point)))
        .collect();
    assert_eq!(known.ratio(&values, factors), Some(false));
    let negative: Vec<u64> = values.iter().map(|value| PRIME - value).collect();
    assert_eq!(known.ratio(&negative, factors), Some(true));
    for i in 0..values.len() {
        let mut other = values.clone();
        other[i] = times(2, other[i]);
        assert_eq!(
            known.ratio(&other, factors),
            None,
            "another value at point {i}"
        );
    }
}
