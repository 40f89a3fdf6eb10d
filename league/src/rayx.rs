//! rayx 0.2.0: Baldwin and Weber's test on its precomputed triangle, and its Möller–Trumbore.

use crate::model::{self, GATES_INTERVAL, MollerTrumbore, Style, T};
use crate::{ENTRANT, Entrant, PROMISE, Run};
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Extent};
use hairline::internals::kernel::{Entry, EpsilonSet, Gives, Hit, KernelInfo, Refuse, Scalar};
use nalgebra_0_34::{RealField, Vector3};
use num_traits::Float;
use rayx::intersect::intersect_moller_trumbore;
use rayx::{Ray, Triangle};

pub const RAYX: Entrant = Entrant {
    name: BALDWIN_WEBER.name,
    package: "rayx",
    version: "0.2.0",
    function: "rayx::Triangle::new, rayx::Triangle::intersect",
    claim: &[
        "Returns `Some(Hit)` if the ray intersects within `[t_min, t_max]`.",
        "A ray with parametric form `o + t*d`.",
    ],
    page: "https://docs.rs/rayx/0.2.0/rayx/struct.Triangle.html#method.intersect",
    note: "The very ends are left to it. A triangle that `Triangle::new` refuses is a miss.",
    run: Run::Here(baldwin_weber),
    findings: &["rayx.md"],
    ..ENTRANT
};

pub const RAYX_MOLLER_TRUMBORE: Entrant = Entrant {
    name: MOLLER_TRUMBORE.name,
    package: "rayx",
    version: "0.2.0",
    function: "rayx::intersect::intersect_moller_trumbore",
    claim: &["Möller–Trumbore ray–triangle intersection algorithm."],
    page: "https://docs.rs/rayx/0.2.0/rayx/intersect/fn.intersect_moller_trumbore.html",
    note: "The interval is as `Triangle::intersect` has it.",
    run: Run::Here(moller_trumbore),
    findings: &["rayx.md"],
    ..ENTRANT
};

const CONTRACT: Contract = Contract {
    extent: Extent::Interval,
    ..PROMISE
};

const GIVES: Gives = Gives {
    t: true,
    uv: true,
    facing: false,
};

const BALDWIN_WEBER: KernelInfo = KernelInfo {
    source: "rayx 0.2.0, Triangle::intersect",
    gives: GIVES,
    ..KernelInfo::own("rayx", CONTRACT)
};

const MOLLER_TRUMBORE: KernelInfo = KernelInfo {
    source: "rayx 0.2.0, intersect_moller_trumbore",
    gates: GATES_INTERVAL,
    epsilon_sets: &[EpsilonSet {
        name: "source",
        values: &["16*EPSILON", "0", "0"],
    }],
    gives: GIVES,
    ..KernelInfo::own("rayx-moller-trumbore", CONTRACT)
};

fn baldwin_weber() -> Entry {
    Entry::new(&BALDWIN_WEBER)
        .f32(test_baldwin_weber::<f32>)
        .f64(test_baldwin_weber::<f64>)
}

fn moller_trumbore() -> Entry {
    let entry = Entry::new(&MOLLER_TRUMBORE);
    let entry = model::with_f32::<MollerTrumbore<Model>>(entry, test_moller_trumbore::<f32>);
    model::with_f64::<MollerTrumbore<Model>>(entry, test_moller_trumbore::<f64>)
}

struct Model;

impl Style for Model {
    const INFO: KernelInfo = MOLLER_TRUMBORE;
    const CULLS: bool = false;
    const U: Refuse = Refuse::Below;
    const T: T = T::InInterval;
}

fn test_baldwin_weber<F: Scalar + Float + RealField>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, d, a, b, c] = case.vectors();
    let triangle = Triangle::new(a, b, c).ok()?;
    triangle
        .intersect(Ray::new(o, d), case.ray.t_min, case.ray.t_max)
        .map(hit)
}

fn test_moller_trumbore<F: Scalar + Float + RealField>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let [o, d, a, b, c] = case.vectors();
    let [a, b, c] = [a, b, c].map(Vector3::from);
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    intersect_moller_trumbore(a, b, c, Ray::new(o, d), t_min, t_max).map(hit)
}

fn hit<F: Float + RealField>(hit: rayx::Hit<F>) -> Hit<F> {
    Hit {
        uv: Some((hit.u, hit.v)),
        ..Hit::at(hit.t)
    }
}
