//! Kernels that compare sizes of barycentric coordinates, or their negatives, of which nothing follows on which side of an edge
//! the line passes.

use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::Sides;
use crate::kernel::{Entry, Gate, Gated, Generic, Hit, Kernel, KernelInfo, Refuse, Role, Sink};
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

    type Prepared<V: Vector> = Triangle<V>;

    fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
        triangle.clone()
    }

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

fn verdicts_of(edge: usize, compares: Compares) -> Verdicts {
    COMPARES.set((edge, compares));
    let paths = <Generic<Sizes> as Gated<f64>>::paths(&Generic::SUBJECT).unwrap();
    let proof = Proof::new(paths, None, Domain::UNIT, Format::F64);
    let entry = Entry::new(&Sizes::INFO);
    verdicts(&entry, [&proof; 3], &[0.0], &[Domain::UNIT])
}

#[test]
fn nothing_is_proved_of_a_kernel_that_compares_a_size_or_a_negative() {
    for edge in 0..3 {
        let Verdicts { misses, hits, .. } = verdicts_of(edge, Itself);
        assert!(misses.is_ok() && hits.is_ok(), "{misses:?} {hits:?}");
        for compares in [Size, SizeOnTwoPaths, Ramp, NegativeWeight] {
            let Verdicts { misses, hits, .. } = verdicts_of(edge, compares);
            let is_silent = misses.is_err() && hits.is_err();
            assert!(is_silent, "{compares:?} at {edge}: {misses:?} {hits:?}");
        }
    }
}
