//! manifold-rust 0.19.2: `collider::ray_triangle_intersection`.

use crate::model::{self, GATES, MollerTrumbore, Style, T};
use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, EpsilonSet, Hit, KernelInfo, Refuse};
use manifold_rust::collider::ray_triangle_intersection;
use manifold_rust::linalg::Vec3;

pub const MANIFOLD_RUST: Entrant = Entrant {
    name: INFO.name,
    package: "manifold-rust",
    version: "0.19.2",
    function: "manifold_rust::collider::ray_triangle_intersection",
    claim: &[],
    page: "https://docs.rs/manifold-rust/0.19.2/manifold_rust/collider/fn.ray_triangle_intersection.html",
    note: "Public and not documented. The crate's `Manifold::ray_cast` is another algorithm, \
        not judged here.",
    run: Run::Here(entry),
    findings: &["manifold-rust.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "manifold-rust 0.19.2, collider::ray_triangle_intersection",
    gates: GATES,
    epsilon_sets: &[EpsilonSet {
        name: "source",
        values: &["1e-9", "0", "1e-9"],
    }],
    ..KernelInfo::own("manifold-rust", PROMISE)
};

fn entry() -> Entry {
    model::with_f64::<MollerTrumbore<Model>>(Entry::new(&INFO), |case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors().map(|[x, y, z]| Vec3::new(x, y, z));
        ray_triangle_intersection(o, d, [a, b, c]).map(Hit::at)
    })
}

struct Model;

impl Style for Model {
    const INFO: KernelInfo = INFO;
    const CULLS: bool = false;
    const U: Refuse = Refuse::UnlessAtLeast;
    const T: T = T::Above;
}
