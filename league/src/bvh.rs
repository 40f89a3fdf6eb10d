//! bvh 0.13.0: `Ray::intersects_triangle`.

use crate::model::{self, GATES_CULLING, MollerTrumbore, Style, T};
use crate::{ENTRANT, Entrant, PROMISE, Run, UNIT};
use bvh::bounding_hierarchy::BHValue;
use bvh::ray::Ray;
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Sides};
use hairline::internals::kernel::{Entry, EpsilonSet, Gives, Hit, KernelInfo, Refuse, Scalar};
use nalgebra_0_35::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, Point3, Vector3};
use num_traits::{Float, One, Zero};

pub const BVH: Entrant = Entrant {
    name: INFO.name,
    package: "bvh",
    version: "0.13.0",
    function: "bvh::ray::Ray::intersects_triangle",
    claim: &[
        "Returns the distance to the intersection, as well as the u and v coordinates of the \
            intersection.",
        "The distance is set to +INFINITY if the ray does not intersect the triangle, or hits \
            it from behind.",
    ],
    page: "https://docs.rs/bvh/0.13.0/bvh/ray/struct.Ray.html#method.intersects_triangle",
    note: "It gets unit directions, because `Ray::new` normalizes.",
    run: Run::Here(entry),
    findings: &["bvh.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "bvh 0.13.0, Ray::intersects_triangle",
    gates: GATES_CULLING,
    epsilon_sets: &[EpsilonSet {
        name: "source",
        values: &["EPSILON", "0", "EPSILON", "0"],
    }],
    gives: Gives {
        t: true,
        uv: true,
        facing: false,
    },
    ..KernelInfo::own(
        "bvh",
        Contract {
            sides: Sides::Front,
            direction: UNIT,
            ..PROMISE
        },
    )
};

fn entry() -> Entry {
    let entry = model::with_f32::<MollerTrumbore<Model>>(Entry::new(&INFO), test::<f32>);
    model::with_f64::<MollerTrumbore<Model>>(entry, test::<f64>)
}

struct Model;

impl Style for Model {
    const INFO: KernelInfo = INFO;
    const CULLS: bool = true;
    const U: Refuse = Refuse::UnlessAtLeast;
    const T: T = T::AboveAndFinite;
}

/// The fields are public: the ray is made of a direction that is normalised already, where `Ray::new`
/// would round it once more.
fn test<F>(case: &Case<F>, _: &[F]) -> Option<Hit<F>>
where
    F: Scalar + BHValue + Float + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + Zero + One,
{
    let [o, d, a, b, c] = case.vectors();
    let [a, b, c] = [a, b, c].map(Point3::from);
    let inv_direction = Vector3::from(d.map(|x| <F as One>::one() / x));
    let ray = Ray {
        origin: Point3::from(o),
        direction: Vector3::from(d),
        inv_direction,
    };
    let hit = ray.intersects_triangle(&a, &b, &c);
    let is_hit = hit.distance != <F as Float>::infinity();
    is_hit.then(|| Hit {
        uv: Some((hit.u, hit.v)),
        ..Hit::at(hit.distance)
    })
}
