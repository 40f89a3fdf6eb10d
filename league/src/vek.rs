//! vek 0.17.2: `geom::Ray::triangle_intersection`.

use crate::{ENTRANT, Entrant, PROMISE, Run, UNIT};
use hairline::internals::case::Case;
use hairline::internals::contract::Contract;
use hairline::internals::kernel::{Entry, Hit, KernelInfo, Scalar};
use vek::geom::Ray;
use vek::num_traits::real::Real;
use vek::vec::Vec3;

pub const VEK: Entrant = Entrant {
    name: INFO.name,
    package: "vek",
    version: "0.17.2",
    function: "vek::geom::Ray::triangle_intersection",
    claim: &[
        "Tests if this ray intersects the given triangle, returning the distance from the ray's \
            origin along its direction where the intersection lies.",
        "If the returned value is `Some(x)` where `x < EPSILON`, then you should assume there was \
            a line intersection, **NOT** a ray intersection.",
        "The ray's direction. **Methods expect it to be normalized**.",
    ],
    page: "https://docs.rs/vek/0.17.2/vek/geom/repr_c/struct.Ray.html#method.triangle_intersection",
    note: "As documented, a value below EPSILON is taken for a miss here.",
    run: Run::Here(entry),
    findings: &["vek.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "vek 0.17.2, geom::Ray::triangle_intersection",
    ..KernelInfo::own(
        "vek",
        Contract {
            direction: UNIT,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(test::<f32>).f64(test::<f64>)
}

fn test<F: Scalar + Real + std::ops::Add<Output = F>>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, d, a, b, c] = case.vectors().map(Vec3::from);
    let t = Ray::new(o, d).triangle_intersection([a, b, c])?;
    (t >= F::EPSILON).then(|| Hit::at(t))
}
