//! Who loses a hit too: built-in kernels alone on the faces that it lies on, slab tests on the boxes of these, or an end of the
//! interval.

use crate::audit::Row as KernelRow;
use crate::case::Target;
use crate::files::mesh::Mesh;
use crate::kernel::{KERNELS, KernelIn, Scalar, Verdict, verdicts_of};
use crate::result::{LostHits, MissCount};
use crate::single::{box_case, case_of};
use hairline_boxes::{KERNELS as BOX_TESTS, Setup};
use hairline_scene::{Nearest, Ray, Scene};
use std::cmp::Reverse;
use std::ops::Range;

/// A hit that a program lost.
pub struct LostHit<'a, F: Scalar> {
    pub ray: &'a Ray<F>,
    pub hit: &'a Nearest,
}

/// Counts who loses these hits too.
pub fn lost_hits<F: Scalar>(mesh: &Mesh, scene: &Scene<F>, lost: &[LostHit<F>]) -> LostHits {
    let mut triangles = Grouped::default();
    let mut boxes = Grouped::default();
    let mut ends = [0, 0];
    for LostHit { ray, hit } in lost {
        let faces = hit.faces.iter();
        triangles.add(faces.clone().map(|face| case_of(mesh, ray, *face)));
        boxes.add(faces.map(|face| box_case(ray, &mesh.vertices::<F>(*face as usize))));
        for (end, count) in [ray.t_min, ray.t_max].into_iter().zip(&mut ends) {
            *count += u64::from(scene.is_near(ray, hit, end.to_f64()));
        }
    }
    let kernels = KERNELS.iter().filter_map(|entry| {
        let name = entry.info.name;
        let row = KernelRow::named(name, None, "own").ok()?;
        let count = triangles.missed_by(F::subject(entry)?, &row.epsilons::<F>());
        Some(MissCount::new(name, count))
    });
    let box_tests = BOX_TESTS.iter().filter_map(|entry| {
        let setup = Setup::published(entry).into_iter().next()?;
        let count = boxes.missed_by(setup.subject().ok()?, &setup.epsilons::<F>()?);
        Some(MissCount::new(entry.info.name, count))
    });
    LostHits {
        count: lost.len() as u64,
        at_start: ends[0],
        at_end: ends[1],
        missed_by_kernels: most_first(kernels),
        missed_by_box_tests: most_first(box_tests),
    }
}

/// Cases in groups: those of a hit together.
struct Grouped<C> {
    cases: Vec<C>,
    groups: Vec<Range<usize>>,
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

impl MissCount {
    fn new(name: &str, count: u64) -> MissCount {
        MissCount {
            name: name.to_owned(),
            count,
        }
    }
}

/// Those that miss any, the most first.
fn most_first(all: impl Iterator<Item = MissCount>) -> Vec<MissCount> {
    let mut all: Vec<MissCount> = all.filter(|it| 0 < it.count).collect();
    all.sort_by_key(|it| (Reverse(it.count), it.name.clone()));
    all
}
