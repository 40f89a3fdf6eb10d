//! The whole program with kernels of one's own in it: `cargo run --example own_kernel -- audit`. One is
//! a closure, one a small trait, in one scalar each.

use hairline::{Case, Contract, Entry, EpsilonSet, Gate, Hit, KernelInfo, Role, Test};

/// The plain test by signed volumes, with an epsilon on the ray's parameter.
struct Mine;

impl Test<f32> for Mine {
    fn test(&self, case: &Case<f32>, epsilons: &[f32]) -> Option<Hit<f32>> {
        let [o, d] = [case.ray.origin, case.ray.direction];
        let [a, b, c] = case.triangle.vertices().map(|vertex| vertex - o);
        let [u, v, w] = [(c, b), (a, c), (b, a)].map(|(p, q)| d.dot(p.cross(q)));
        let inside = u.min(v).min(w) >= 0.0 || u.max(v).max(w) <= 0.0;
        let t = a.dot((b - a).cross(c - a)) / d.dot((b - a).cross(c - a));
        (inside && t >= epsilons[0]).then(|| Hit::at(t))
    }
}

/// It promises what `closed-ray` says, and takes one epsilon, t, of dimension length / direction.
const MINE: KernelInfo = KernelInfo {
    gates: &[Gate::signed(Role::T, "!(t >= e)", 1, -1)],
    epsilon_sets: &[EpsilonSet {
        name: "own",
        values: &["1e-4"],
    }],
    ..KernelInfo::own("mine", Contract::CLOSED_RAY)
};

const BOUNDING_BOX: KernelInfo = KernelInfo::own("bounding-box", Contract::CLOSED_RAY);

fn main() -> std::process::ExitCode {
    let bounding_box = |case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors();
        let ends = [0, 1, 2].map(|i| {
            let corners = [a[i], b[i], c[i]].map(|x| (x - o[i]) / d[i]);
            (
                corners.into_iter().fold(f64::INFINITY, f64::min),
                corners.into_iter().fold(f64::NEG_INFINITY, f64::max),
            )
        });
        let enter = ends.iter().fold(0.0, |t, end| f64::max(t, end.0));
        let leave = ends.iter().fold(f64::INFINITY, |t, end| t.min(end.1));
        (enter <= leave).then(|| Hit::at(enter))
    };
    hairline::cli::main_with([
        Entry::new(&MINE).f32(Mine),
        Entry::new(&BOUNDING_BOX).f64(bounding_box),
    ])
}
