//! maths-rs 1.0.0: `ray_vs_triangle`.

use crate::{ENTRANT, Entrant, PROMISE, Run, UNIT};
use hairline::internals::case::Case;
use hairline::internals::contract::Contract;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo, Scalar};
use maths_rs::num::Float;
use maths_rs::vec::Vec3;

pub const MATHS_RS: Entrant = Entrant {
    name: INFO.name,
    package: "maths-rs",
    version: "1.0.0",
    function: "maths_rs::ray_vs_triangle",
    claim: &[
        "returns the intersection point of ray `r0` and normalized direction `rv` with triangle \
            `t0-t1-t2`",
    ],
    page: "https://docs.rs/maths-rs/1.0.0/maths_rs/fn.ray_vs_triangle.html",
    note: "It gives the point and not t, so no value of a hit is judged.",
    run: Run::Here(entry),
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "maths-rs 1.0.0, ray_vs_triangle",
    gives: Gives {
        t: false,
        uv: false,
        facing: false,
    },
    ..KernelInfo::own(
        "maths-rs",
        Contract {
            direction: UNIT,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(test::<f32>).f64(test::<f64>)
}

fn test<F: Scalar + Float>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, d, a, b, c] = case.vectors().map(|[x, y, z]| Vec3::new(x, y, z));
    maths_rs::ray_vs_triangle(o, d, a, b, c)?;
    Some(Hit {
        t: None,
        uv: None,
        facing: None,
    })
}
