//! Kernels that compare numbers which look like barycentric coordinates: sizes, negatives, other scales, and numbers that are
//! what they seem at the points that are looked at.

use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::Sides;
use crate::kernel::{
    Entry, Gate, Gated, Generic, Hit, Kernel, KernelInfo, Path, Refuse, Role, Sink,
};
use crate::verdict::{Verdicts, verdicts};
use crate::{Domain, Format, Proof};
use hairline_core::Contract;
use std::cell::Cell;

/// The number that the kernel of these tests compares with 0 at an edge, D being -N·d. At the others it is 2λ·D, so it culls.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Compares {
    /// 2λ·D.
    Itself,
    /// |λ·D| + |λ·D|.
    Size,
    /// The same, on a path for each sign of λ·D.
    SizeOnTwoPaths,
    /// λ·D + |λ·D|, which is 2λ·D or 0.
    Ramp,
    /// -λ, which no hit passes.
    NegativeWeight,
    /// λ·D over a coordinate of the direction, whose sign is another one.
    OverAxis,
    /// λ·D and a number that is 0 where a coordinate of the origin is at most 1.
    MoreFarAway,
    /// λ·D times 16777217 - 16777216, which no f32 holds.
    LongNumber,
    /// λ·D, if another number is finite.
    IfFinite,
    /// λ·D, and the rest of a number that is just below another one.
    JustBelow,
}
use Compares::*;

thread_local! {
    /// The edge, and what is compared there.
    static COMPARES: Cell<(usize, Compares)> = const { Cell::new((0, Itself)) };
}

const CULLING: Contract = Contract {
    sides: Sides::Front,
    ..Contract::CLOSED_RAY
};

struct Sizes;

impl Kernel for Sizes {
    const INFO: KernelInfo = KernelInfo {
        gates: &[Gate::signed(Role::Edge, "one of u, v, w < e", 3, 1)],
        ..KernelInfo::own("sizes", CULLING)
    };

    crate::kernel::stores_triangle!();

    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let d = &ray.direction;
        let [a, b, c] = [&triangle.a, &triangle.b, &triangle.c].map(|p| p.minus(&ray.origin));
        let volumes = [(&c, &b), (&a, &c), (&b, &a)].map(|(p, q)| p.cross(q).dot(d));
        let mut compared = volumes.each_ref().map(|x| x.clone() + x);
        let (edge, compares) = COMPARES.get();
        let size = volumes[edge].abs();
        if compares == SizeOnTwoPaths {
            let _ = volumes[edge].is_sign_negative();
        }
        match compares {
            Itself => {}
            Size | SizeOnTwoPaths => compared[edge] = size.clone() + &size,
            Ramp => compared[edge] = volumes[edge].clone() + &size,
            OverAxis => compared[edge] = volumes[edge].clone() / &d.at(0),
            MoreFarAway => {
                let [x, one] = [ray.origin.at(0), V::Real::one()];
                let more = (x.clone() - &one).abs() + &(x + &one).abs() - &one - &one;
                compared = compared.map(|it| it + &more);
            }
            LongNumber => {
                let one = V::Real::number(16777217.0) - &V::Real::number(16777216.0);
                compared = compared.map(|it| it * &one);
            }
            IfFinite => {
                if !(d.at(0) * &d.at(0)).is_finite() {
                    return None;
                }
            }
            JustBelow => {
                let many = V::Real::number(1073741824.0);
                let more = many.clone() - &many.just_below();
                compared = compared.map(|it| it + &more);
            }
            NegativeWeight => {
                let all = volumes[0].clone() + &volumes[1] + &volumes[2];
                compared[edge] = V::Real::zero() - &(volumes[edge].clone() / &all);
            }
        }
        sink.gate(0, Refuse::Below, [compared.each_ref()])?;
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

fn paths_of(edge: usize, compares: Compares) -> Result<Vec<Path>, String> {
    COMPARES.set((edge, compares));
    <Generic<Sizes> as Gated<f64>>::paths(&Generic::SUBJECT)
}

fn verdicts_of(edge: usize, compares: Compares) -> Verdicts {
    let paths = paths_of(edge, compares).unwrap();
    let format = if compares == LongNumber {
        Format::F32
    } else {
        Format::F64
    };
    let proof = Proof::new(paths, None, Domain::UNIT, format);
    let entry = Entry::new(&Sizes::INFO);
    verdicts(&entry, [&proof; 3], &[0.0], &[Domain::UNIT])
}

#[test]
fn nothing_is_proved_of_a_kernel_whose_numbers_are_not_surely_weights() {
    for edge in 0..3 {
        let Verdicts { misses, hits, .. } = verdicts_of(edge, Itself);
        assert!(misses.is_ok() && hits.is_ok(), "{misses:?} {hits:?}");
        let others = [
            Size,
            SizeOnTwoPaths,
            Ramp,
            NegativeWeight,
            OverAxis,
            MoreFarAway,
            LongNumber,
        ];
        for compares in others {
            let Verdicts { misses, hits, .. } = verdicts_of(edge, compares);
            let is_silent = misses.is_err() && hits.is_err();
            assert!(is_silent, "{compares:?} at {edge}: {misses:?} {hits:?}");
        }
    }
}

/// A tape cannot answer these questions: what stands behind the other answer would not be seen.
#[test]
fn a_kernel_has_no_program_that_asks_what_a_tape_does_not_know() {
    for compares in [IfFinite, JustBelow] {
        let why = paths_of(0, compares).unwrap_err();
        assert!(why.starts_with("it asks"), "{why}");
    }
}
