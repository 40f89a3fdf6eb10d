//! Who loses the same hits: built-in kernels alone on the faces that it lies on, slab tests on the boxes of these, or an end of the
//! interval.

use crate::audit::Row as KernelRow;
use crate::case::{Case, Target};
use crate::files::mesh::Mesh;
use crate::kernel::{KERNELS, KernelIn, Scalar, Verdict, verdicts_of};
use crate::result::{LostHits, MissCount};
use crate::single::{box_case, case_of};
use hairline_boxes::{BoxCase, KERNELS as BOX_TESTS, Setup};
use hairline_scene::{Nearest, Ray, Scene};
use std::cmp::Reverse;
use std::ops::Range;

/// An exact hit of a ray.
pub struct HitOfRay<'a, F: Scalar> {
    pub ray: &'a Ray<F>,
    pub hit: &'a Nearest,
}

/// About as many of the hits that a program found are looked at.
const FOUND: usize = 50_000;

/// Counts who loses the hits too that a program lost, and loses others that it found: a test that the program has misses what is
/// lost and nothing else.
pub fn lost_hits<F: Scalar>(
    mesh: &Mesh,
    scene: &Scene<F>,
    lost: &[HitOfRay<F>],
    found: &[HitOfRay<F>],
) -> LostHits {
    let mut ends = [0, 0];
    for HitOfRay { ray, hit } in lost {
        for (end, count) in [ray.t_min, ray.t_max].into_iter().zip(&mut ends) {
            *count += u64::from(scene.is_near(ray, hit, end.to_f64()));
        }
    }
    let mut counts = LostHits {
        count: lost.len() as u64,
        at_start: ends[0],
        at_end: ends[1],
        ..LostHits::default()
    };
    if lost.is_empty() {
        return counts;
    }
    let step = found.len().div_ceil(FOUND).max(1);
    let sides = Sides {
        lost: Both::new(mesh, lost.iter()),
        found: Both::new(mesh, found.iter().step_by(step)),
        scale: step as u64,
    };
    let kernels = KERNELS.iter().filter_map(|entry| {
        let name = entry.info.name;
        let row = KernelRow::named(name, None, "own").ok()?;
        let (kernel, epsilons) = (F::subject(entry)?, row.epsilons::<F>());
        let missed = sides.count(|side| side.triangles.missed_by(kernel, &epsilons));
        let explained = missed.of_lost.saturating_sub(missed.of_found);
        Some(missed.named(name, explained))
    });
    counts.missed_by_kernels = best_first(kernels);
    let box_tests = BOX_TESTS.iter().filter_map(|entry| {
        let setup = Setup::published(entry).into_iter().next()?;
        let (test, epsilons) = (setup.subject().ok()?, setup.epsilons::<F>()?);
        let missed = sides.count(|side| side.boxes.missed_by(test, &epsilons));
        let share = missed.of_found as f64 / found.len().max(1) as f64;
        let by_chance = (share * lost.len() as f64).round() as u64;
        let explained = missed.of_lost.saturating_sub(by_chance);
        Some(missed.named(entry.info.name, explained))
    });
    counts.missed_by_box_tests = best_first(box_tests);
    counts
}

/// The hits that are lost, and those that are found.
struct Sides<F: Scalar> {
    lost: Both<F>,
    found: Both<F>,
    /// Each hit that is found stands for so many.
    scale: u64,
}

impl<F: Scalar> Sides<F> {
    fn count(&self, missed: impl Fn(&Both<F>) -> u64) -> Missed {
        Missed {
            of_lost: missed(&self.lost),
            of_found: missed(&self.found) * self.scale,
        }
    }
}

/// How many hits a test misses.
struct Missed {
    of_lost: u64,
    of_found: u64,
}

impl Missed {
    fn named(&self, name: &str, explained: u64) -> MissCount {
        MissCount {
            name: name.to_owned(),
            count: self.of_lost,
            of_found: self.of_found,
            explained,
        }
    }
}

/// The faces of hits, and the boxes around them.
struct Both<F: Scalar> {
    triangles: Grouped<Case<F>>,
    boxes: Grouped<BoxCase<F>>,
}

/// Cases in groups: those of a hit together.
struct Grouped<C> {
    cases: Vec<C>,
    groups: Vec<Range<usize>>,
}

impl<F: Scalar> Both<F> {
    fn new<'a>(mesh: &Mesh, hits: impl Iterator<Item = &'a HitOfRay<'a, F>>) -> Both<F> {
        let mut triangles = Grouped::default();
        let mut boxes = Grouped::default();
        for HitOfRay { ray, hit } in hits {
            let faces = hit.faces.iter();
            triangles.add(faces.clone().map(|face| case_of(mesh, ray, *face)));
            boxes.add(faces.map(|face| box_case(ray, &mesh.vertices::<F>(*face as usize))));
        }
        Both { triangles, boxes }
    }
}

impl<C> Default for Grouped<C> {
    fn default() -> Grouped<C> {
        Grouped {
            cases: Vec::new(),
            groups: Vec::new(),
        }
    }
}

impl<C> Grouped<C> {
    fn add(&mut self, cases: impl Iterator<Item = C>) {
        let first = self.cases.len();
        self.cases.extend(cases);
        self.groups.push(first..self.cases.len());
    }

    /// How many groups a kernel misses whole.
    fn missed_by<F: Scalar, T: Target<Case<F> = C>>(
        &self,
        kernel: &dyn KernelIn<F, T>,
        epsilons: &[F],
    ) -> u64 {
        let mut verdicts = vec![Verdict::miss(None); self.cases.len()];
        verdicts_of(kernel, &self.cases, epsilons, &mut verdicts);
        let is_missed = |group: &&Range<usize>| {
            let mut verdicts = verdicts[(*group).clone()].iter();
            verdicts.all(|verdict| !verdict.hit)
        };
        self.groups.iter().filter(is_missed).count() as u64
    }
}

/// Those that explain any, the best first.
fn best_first(all: impl Iterator<Item = MissCount>) -> Vec<MissCount> {
    let mut all: Vec<MissCount> = all.filter(|it| 0 < it.explained).collect();
    all.sort_by_key(|it| (Reverse(it.explained), it.name.clone()));
    all
}
