//! ncollide3d 0.33.0, parry's predecessor: `query::ray_intersection_with_triangle`.

use crate::{ENTRANT, Entrant, PROMISE, Run, UNIT};
use hairline::internals::case::Case;
use hairline::internals::contract::Contract;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo, Scalar};
use nalgebra_0_30::{Point3, RealField, Vector3};
use ncollide3d::query::{Ray, ray_intersection_with_triangle};

pub const NCOLLIDE3D: Entrant = Entrant {
    name: INFO.name,
    package: "ncollide3d",
    version: "0.33.0",
    function: "ncollide3d::query::ray_intersection_with_triangle",
    claim: &[
        "Computes the intersection between a triangle and a ray.",
        "If an intersection is found, the time of impact, the normal and the barycentric \
            coordinates of the intersection point are returned.",
        "`dir` must be normalized.",
    ],
    page: "https://docs.rs/ncollide3d/0.33.0/ncollide3d/query/fn.ray_intersection_with_triangle.html",
    note: "The last sentence is of `Ray::new`: it gets unit directions.",
    run: Run::Here(entry),
    findings: &["parry3d.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "ncollide3d 0.33.0, query::ray_intersection_with_triangle",
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own(
        "ncollide3d",
        Contract {
            direction: UNIT,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    Entry::new(&INFO).f32(test::<f32>).f64(test::<f64>)
}

fn test<F: Scalar + RealField>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, d, a, b, c] = case.vectors();
    let [a, b, c] = [a, b, c].map(Point3::from);
    let ray = Ray::new(Point3::from(o), Vector3::from(d));
    let (hit, weights) = ray_intersection_with_triangle(&a, &b, &c, &ray)?;
    Some(Hit {
        uv: Some((weights.y, weights.z)),
        ..Hit::at(hit.toi)
    })
}
