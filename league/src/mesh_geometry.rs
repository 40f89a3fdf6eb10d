//! mesh-geometry 0.4.0: `queries::ray_intersects_triangle`.

use crate::model::{self, GATES, MollerTrumbore, Style, T};
use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, EpsilonSet, Gives, Hit, KernelInfo, Refuse, Scalar};
use mesh_geometry::queries::{Ray, ray_intersects_triangle};
use mesh_geometry::{Point3, Vec3};
use num_traits::Float;

pub const MESH_GEOMETRY: Entrant = Entrant {
    name: INFO.name,
    package: "mesh-geometry",
    version: "0.4.0",
    function: "mesh_geometry::queries::ray_intersects_triangle",
    claim: &[
        "If the ray intersects the triangle (a,b,c), returns `Some((t,u,v))` where intersection = \
            origin + t·dir, and (u,v) are barycentric coords.",
    ],
    page: "https://docs.rs/mesh-geometry/0.4.0/mesh_geometry/queries/fn.ray_intersects_triangle.html",
    note: "`Ray::dir` is \"not necessarily normalized\".",
    run: Run::Here(entry),
    findings: &["mesh-geometry.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "mesh-geometry 0.4.0, queries::ray_intersects_triangle",
    gates: GATES,
    epsilon_sets: &[EpsilonSet {
        name: "source",
        values: &["1e-8", "0", "1e-8"],
    }],
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own("mesh-geometry", PROMISE)
};

fn entry() -> Entry {
    let entry = model::with_f32::<MollerTrumbore<Model>>(Entry::new(&INFO), test::<f32>);
    model::with_f64::<MollerTrumbore<Model>>(entry, test::<f64>)
}

struct Model;

impl Style for Model {
    const INFO: KernelInfo = INFO;
    const CULLS: bool = false;
    const U: Refuse = Refuse::Below;
    const T: T = T::Above;
}

fn test<F: Scalar + Float>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, [x, y, z], a, b, c] = case.vectors();
    let [origin, a, b, c] = [o, a, b, c].map(|[x, y, z]| Point3::new(x, y, z));
    let ray = Ray {
        origin,
        dir: Vec3::new(x, y, z),
    };
    let (t, u, v) = ray_intersects_triangle(ray, a, b, c)?;
    Some(Hit {
        uv: Some((u, v)),
        ..Hit::at(t)
    })
}
