//! Who loses the hits that a program lost: a built-in kernel alone on the faces of each hit, a slab test on the boxes of these faces, the
//! transform of an instance, or an end of the interval.

use crate::audit::Row as KernelRow;
use crate::case::{Case, Target};
use crate::files::mesh::Mesh;
use crate::kernel::{Entry, KERNELS, KernelIn, Scalar, Verdict, verdicts_of};
use crate::result::{LostHits, MissCount};
use crate::single::{box_case, case_of};
use crate::transform::Way;
use hairline_boxes::{BoxCase, KERNELS as BOX_TESTS, Setup};
use hairline_scene::{Nearest, Ray, Scene};
use std::cmp::Reverse;
use std::ops::{Range, RangeInclusive};

/// An exact hit of a ray.
pub struct HitOfRay<'a, F: Scalar> {
    pub ray: &'a Ray<F>,
    pub hit: &'a Nearest,
}

/// The most hits that are looked at, about: of those that a program lost, and of those that it found.
const SAMPLE: usize = 50_000;

/// So many faces of a hit at most.
const FACES: usize = 64;

/// Fewer hits that are lost, or found, do not tell who loses them.
pub const FEWEST: usize = 10;

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
        found: found.len() as u64,
        at_start: ends[0],
        at_end: ends[1],
        ..LostHits::default()
    };
    if lost.len() < FEWEST || found.len() < FEWEST {
        return counts;
    }
    let sides = Sides {
        lost: Sample::of(mesh, lost),
        found: Sample::of(mesh, found),
    };
    let kernels = KERNELS.iter().filter_map(|entry| sides.of_kernel(entry));
    counts.missed_by_kernels = best_first(kernels);
    let box_tests = BOX_TESTS.iter().filter_map(|entry| {
        let setup = Setup::published(entry).into_iter().next()?;
        let (test, epsilons) = (setup.subject().ok()?, setup.epsilons::<F>()?);
        let missed = sides.count(|side| side.boxes.missed_by(test, &epsilons));
        // A program's boxes hold several faces. So a hit that it finds says little against a test that misses the box of one face.
        let explained = missed.of_lost.saturating_sub(sides.by_chance(&missed));
        Some(missed.named(entry.info.name, None, explained))
    });
    counts.missed_by_box_tests = best_first(box_tests);
    let transforms = Way::ALL.into_iter().map(|way| {
        let missed = sides.count(|side| side.missed_after(way));
        let unexplained = missed.of_found.max(sides.by_chance(&missed));
        let explained = missed.of_lost.saturating_sub(unexplained);
        missed.named(way.name(), None, explained)
    });
    counts.missed_by_transforms = best_first(transforms);
    counts
}

/// The gate of rays along the plane, and the powers of ten that programs have there.
const PARALLEL: &str = "parallel";
const DECADES: RangeInclusive<i32> = -12..=-3;

/// The epsilons with which a kernel is asked: none for its own, and others for rays along the plane.
fn epsilons_of(entry: &Entry) -> Vec<Option<String>> {
    let mut all = vec![None];
    if entry.info.gates.iter().any(|gate| gate.name == PARALLEL) {
        let decades = DECADES.map(|power| format!("1e{power}"));
        let values = ["0".to_owned()].into_iter().chain(decades);
        all.extend(values.map(|value| Some(format!("{PARALLEL}={value}"))));
    }
    all
}

/// The hits that are lost, and those that are found.
struct Sides<F: Scalar> {
    lost: Sample<F>,
    found: Sample<F>,
}

/// Some of many hits.
struct Sample<F: Scalar> {
    hits: Both<F>,
    count: usize,
    /// Each stands for so many.
    scale: u64,
}

impl<F: Scalar> Sample<F> {
    fn of(mesh: &Mesh, hits: &[HitOfRay<F>]) -> Sample<F> {
        let step = hits.len().div_ceil(SAMPLE).max(1);
        Sample {
            hits: Both::new(mesh, hits.iter().step_by(step)),
            count: hits.len(),
            scale: step as u64,
        }
    }
}

impl<F: Scalar> Sides<F> {
    /// The hits that a kernel misses, with its own epsilons or with another one for rays along the plane: the one that explains most.
    fn of_kernel(&self, entry: &Entry) -> Option<MissCount> {
        let kernel = F::subject(entry)?;
        let mut best: Option<MissCount> = None;
        for epsilon in epsilons_of(entry) {
            let name = entry.info.name;
            let Ok(row) = KernelRow::named(name, epsilon.as_deref(), "own") else {
                continue;
            };
            let values = row.epsilons::<F>();
            let missed = self.count(|side| side.triangles.missed_by(kernel, &values));
            let unexplained = missed.of_found.max(self.by_chance(&missed));
            let explained = missed.of_lost.saturating_sub(unexplained);
            if best.as_ref().is_none_or(|best| best.explained < explained) {
                best = Some(missed.named(name, epsilon, explained));
            }
        }
        best
    }

    fn count(&self, missed: impl Fn(&Both<F>) -> u64) -> Missed {
        let Sides { lost, found } = self;
        Missed {
            of_lost: (missed(&lost.hits) * lost.scale).min(lost.count as u64),
            of_found: missed(&found.hits) * found.scale,
        }
    }

    /// How many lost hits a test would miss if it missed as large a share of them as of those that are found.
    fn by_chance(&self, missed: &Missed) -> u64 {
        let share = missed.of_found as f64 / self.found.count as f64;
        (share * self.lost.count as f64).round() as u64
    }
}

/// How many hits a test misses.
struct Missed {
    of_lost: u64,
    of_found: u64,
}

impl Missed {
    fn named(&self, name: &str, epsilon: Option<String>, explained: u64) -> MissCount {
        MissCount {
            name: name.to_owned(),
            epsilon,
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
    /// For each hit the ways of a transform that lose it on all of its faces.
    transforms: Vec<Vec<Way>>,
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
        let mut transforms = Vec::new();
        for HitOfRay { ray, hit } in hits {
            let faces = hit.faces.iter().take(FACES);
            let loses = |way: &Way| faces.clone().all(|face| way.loses(mesh, ray, *face));
            transforms.push(Way::ALL.into_iter().filter(loses).collect());
            triangles.add(faces.clone().map(|face| case_of(mesh, ray, *face)));
            boxes.add(faces.map(|face| box_case(ray, &mesh.vertices::<F>(*face as usize))));
        }
        Both {
            triangles,
            boxes,
            transforms,
        }
    }

    /// How many hits are lost after a transform.
    fn missed_after(&self, way: Way) -> u64 {
        let missed = self.transforms.iter().filter(|ways| ways.contains(&way));
        missed.count() as u64
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
