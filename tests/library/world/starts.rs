//! Starts of rays that leave a surface, in both worlds.

use super::counts::{Rate, Tuned};
use super::dice::Dice;
use super::exact::{Meeting, dot, side};
use super::meshes::Mesh;
use super::rays::{Aim, Shot, corners_normal, hit_points, plane_of, shots};
use hairline::internals::arith::Float;
use hairline::internals::audit::Unobserved;
use hairline::internals::case::Scene;
use hairline::internals::kernel::{Scalar, Verdict};
use hairline::internals::offset::{HitPoint, OffsetPlan, PointKind, Scheme, Start, run};
use std::collections::BTreeMap;

/// A hit point of the second world, and on which side of its triangle's plane the new ray is to start.
pub struct Hit<F: Float> {
    pub shot: Shot,
    pub point: HitPoint<F>,
    side: i32,
}

/// The hit points of a kernel on first rays at a mesh, by where their planes lie.
pub fn hits<F: Scalar>(
    mesh: &Mesh,
    tuned: &Tuned,
    kind: PointKind,
    seed: u64,
    count: usize,
) -> BTreeMap<&'static str, Vec<Hit<F>>> {
    let mut dice = Dice::new(seed);
    let all = shots::<F>(mesh, Aim::Inside, tuned.row.entry, &mut dice, count);
    let cases: Vec<_> = all.iter().flat_map(Shot::cases::<F>).collect();
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    let kernel = F::subject(tuned.row.entry).unwrap();
    kernel.run(&cases, &tuned.row.epsilons::<F>(), &mut verdicts);
    let mut planes = BTreeMap::<_, Vec<Hit<F>>>::new();
    for ((shot, case), verdict) in all.into_iter().zip(cases).zip(verdicts) {
        if !verdict.hit {
            continue;
        }
        let face = shot.faces[0];
        let side = -Meeting::of(shot.origin, shot.direction, face).facing;
        let direction = dice.sphere().map(F::from_f64);
        let leaves = dot(corners_normal(face), direction.map(F::to_f64));
        let is_turned = (leaves < 0.0) != (side < 0);
        let direction = if is_turned {
            direction.map(|x| -x)
        } else {
            direction
        };
        let [by_weights, on_ray] = hit_points(&case, &verdict);
        let point = HitPoint {
            point: if kind == PointKind::Ray {
                on_ray
            } else {
                by_weights
            },
            normal: normal(case.vectors(), side),
            vertices: face.map(|corner| corner.map(F::from_f64)),
            weights: Some([F::one() - verdict.u - verdict.v, verdict.u, verdict.v]),
            t: verdict.t,
            direction,
        };
        planes
            .entry(plane_of(mesh, &shot.faces))
            .or_default()
            .push(Hit { shot, point, side });
    }
    planes
}

/// The unit normal as a renderer computes it, on a side.
fn normal<F: Float>([_, _, a, b, c]: [[F; 3]; 5], side: i32) -> [F; 3] {
    let (e, f) = (
        [0, 1, 2].map(|i| b[i] - a[i]),
        [0, 1, 2].map(|i| c[i] - a[i]),
    );
    let n = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        e[j] * f[k] - e[k] * f[j]
    });
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|x| if side < 0 { -(x / length) } else { x / length })
}

/// How many new rays of a scheme start on the plane or behind it.
pub fn wrong<F: Float>(scheme: &Scheme, hits: &[Hit<F>]) -> Rate {
    let offset = scheme.offset::<F>().unwrap();
    let is_wrong = |hit: &&Hit<F>| {
        let Start { origin, t_min } = offset.start(&hit.point);
        let direction = hit.point.direction.map(F::to_f64);
        let start = side(
            origin.map(F::to_f64),
            t_min.to_f64(),
            direction,
            hit.shot.faces[0],
        );
        start != hit.side
    };
    Rate {
        count: hits.iter().filter(is_wrong).count() as u64,
        of: hits.len() as u64,
    }
}

/// The first rays of hit points.
pub fn first_rays<F: Float>(hits: &[Hit<F>]) -> Vec<Shot> {
    hits.iter().map(|hit| hit.shot.clone()).collect()
}

/// The same of each scheme, says hairline.
pub fn theirs<F: Scalar>(
    tuned: &Tuned,
    scene: &Scene,
    kind: PointKind,
    schemes: &[Scheme],
    count: u64,
) -> Vec<Rate> {
    let row = &tuned.row;
    let plan = OffsetPlan {
        row,
        scene,
        mesh: None,
        kind,
        schemes,
        wall: 0.01,
        fold: 45.0,
        instance: None,
        with_least: false,
        with_heights: true,
        seed: 1,
        count,
    };
    let sums = run::<F>(&plan, &Unobserved);
    sums.schemes
        .iter()
        .map(|of| Rate {
            count: of.wrong,
            of: of.rays,
        })
        .collect()
}
