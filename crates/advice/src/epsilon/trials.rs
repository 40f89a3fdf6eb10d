//! The trials of a kernel in a scene, or on other sources, and one pass over them.

use super::errors::{HitErrors, JudgedHit};
use super::knob::{Guards, Knob, KnobMargins, MOST_KNOBS};
use super::prepared::{Prepared, PreparedTrial, Store};
use super::queue::Queue;
use super::rays::{RayCount, Rays, WrongKind, guards, guards_start};
use super::shared::{MadeCases, SharedCases};
use crate::arith::Float;
use crate::audit::{Chunk, Row, Source, Stock};
use crate::case::{Case, Parameters, Scene};
use crate::engine::{self, Merge, Observer, Unobserved};
use crate::family::{Grouping, Pixel, Stratum, add_ring, pixel, pixel_draw};
use crate::judge::{Class, Obligation};
use crate::kernel::{KernelIn, Scalar};
use crate::mesh::SceneMesh;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The rays to study.
#[derive(Default)]
pub struct StudiedRays {
    /// The scene; none if there are sources.
    pub scene: Option<Scene>,
    /// Families and stored cases, if they are named instead of a scene.
    pub sources: Vec<Source>,
    /// The flags that choose the sources again.
    pub flags: String,
    /// The strata of the scene; all if none is named.
    pub strata: Vec<String>,
    /// The scene's unit of length; empty if it has none.
    pub unit: &'static str,
    /// The mesh that it is, if it is one.
    pub mesh: Option<Arc<SceneMesh>>,
    /// The same scene with planes of other kinds; none if a kind is named, and for a mesh, which has its own.
    pub others: Vec<Scene>,
}

/// The rays of a pass: the first of each kind of a seed.
#[derive(Clone, Copy)]
pub struct Pass<'a> {
    /// The seed.
    pub seed: u64,
    /// So many of each kind; of stored cases all.
    pub count: u64,
    /// Hears of each ray.
    pub observer: &'a dyn Observer,
}

impl Pass<'_> {
    /// So many rays of a seed.
    pub fn new(seed: u64, count: u64, observer: &dyn Observer) -> Pass<'_> {
        Pass {
            seed,
            count,
            observer,
        }
    }

    /// At most so many of these rays of each kind.
    pub fn of(self, most: u64) -> Self {
        Pass {
            count: self.count.min(most),
            ..self
        }
    }

    /// As many fresh rays.
    pub fn fresh(self) -> Self {
        Pass {
            seed: fresh_seed(self.seed),
            ..self
        }
    }
}

/// The seed of the fresh rays: the next one.
pub fn fresh_seed(seed: u64) -> u64 {
    seed.wrapping_add(1)
}

/// The setting of a pass: a kernel, its knobs and a scene.
pub struct Setting<'a, F: Scalar> {
    /// The kernel, its contract, and the epsilons of the gates that are no knobs.
    pub row: &'a Row,
    /// The same kernel in the scalar.
    pub subject: &'static dyn KernelIn<F>,
    /// At most [`MOST_KNOBS`].
    pub knobs: &'a [Knob],
    /// The kinds and rays whose wrong answers are counted.
    pub counts: &'a [RayCount],
    /// The scene; none on sources.
    pub scene: Option<&'a Scene>,
    /// The sources; none in a scene.
    pub sources: &'a [Source],
    /// The mesh that it is, if it is one.
    pub mesh: Option<&'a Arc<SceneMesh>>,
    /// Epsilons are multiplied by each case's own size.
    pub relative: bool,
    /// Curves are counted at every number of two digits.
    pub fine_curves: bool,
    /// The store that keeps the rays of this kernel, its knobs and its scene between passes.
    pub store: Option<&'a Store<F>>,
    /// The cases that are made once for several kernels, if there are several.
    pub shared: Option<&'a SharedCases<F>>,
}

/// A trial: the answers on a ray that counts for something.
pub struct Trial<'a, F: Float> {
    /// Which of the setting's counts it is for.
    pub count: usize,
    /// By knob: true if it is there to refuse such a ray, where refusing it is right.
    pub guards: Guards,
    /// The margins of each triangle, those around a group at the end; a hit is reported if one is accepted.
    pub margins: &'a [KnobMargins<F>],
    /// How many of the triangles are around the group and not of it.
    pub around: usize,
    /// The hit of its first triangle, if hits of such rays can be lost.
    pub first: Option<JudgedHit<'a, F>>,
}

impl<F: Float> Trial<'_, F> {
    /// True if a hit is reported with these epsilons.
    pub fn is_hit(&self, epsilons: &[F]) -> bool {
        self.margins
            .iter()
            .any(|margins| accepts(margins, epsilons))
    }

    /// The errors of the first triangle's hit, if hits of such rays can be lost.
    pub fn errors(&self) -> HitErrors {
        self.first.map_or(HitErrors::default(), |hit| hit.errors())
    }

    /// How many triangles of the group itself report a hit with these epsilons.
    pub fn hits(&self, epsilons: &[F]) -> usize {
        let own = &self.margins[..self.margins.len() - self.around];
        own.iter()
            .filter(|margins| accepts(margins, epsilons))
            .count()
    }
}

/// True if the kernel failed while its margins were looked for.
pub fn is_unknown<F: Float>(margins: &KnobMargins<F>) -> bool {
    margins[0].is_nan()
}

/// True if margins accept epsilons.
pub fn accepts<F: Float>(margins: &KnobMargins<F>, epsilons: &[F]) -> bool {
    epsilons
        .iter()
        .zip(margins)
        .all(|(epsilon, margin)| epsilon <= margin)
}

impl<F: Scalar> Setting<'_, F> {
    /// Runs all trials of a seed's first indices of every stratum, and sums what `add` makes of them.
    pub fn sum<S: Merge>(
        &self,
        pass: Pass<'_>,
        empty: impl Fn() -> S + Sync,
        add: impl Fn(&mut S, Trial<'_, F>) + Sync,
    ) -> S {
        self.sum_with(pass, empty, add, |_, _, _| {})
    }

    /// The same; `look` also sees each chunk with all its margins, those that are of no trial included.
    pub(super) fn sum_with<S: Merge>(
        &self,
        pass: Pass<'_>,
        empty: impl Fn() -> S + Sync,
        add: impl Fn(&mut S, Trial<'_, F>) + Sync,
        look: impl Fn(&mut S, &Prepared<F>, &[KnobMargins<F>]) + Sync,
    ) -> S {
        let queue = self.queue(pass);
        let add_chunk = |sums: &mut S, chunk: u64| {
            let (queued, indices) = queue.at(chunk);
            let place = (queued.group, queued.place, indices.start, indices.end);
            let count = indices.end - indices.start;
            let make = || self.prepare(&queued.source, queued.rays, indices);
            let part = match self.store {
                Some(store) => store.part(pass.seed, place, make),
                None => Arc::new(make()),
            };
            let margins = match self.relative {
                true => part.relative.get_or_init(|| self.all_relative(&part)),
                false => &part.margins,
            };
            look(sums, &part, margins);
            for trial in &part.trials {
                add(
                    sums,
                    Trial {
                        count: trial.count,
                        guards: trial.guards,
                        margins: &margins[trial.margins.clone()],
                        around: trial.around,
                        first: part.first_hit(trial),
                    },
                );
            }
            pass.observer.advance(count);
        };
        // All kinds of rays in one queue, so that threads wait for each other once a pass.
        engine::sum(0..queue.chunks(), 1, &Unobserved, empty, |sums, chunks| {
            chunks.for_each(|chunk| add_chunk(sums, chunk));
        })
    }

    /// The sources of a pass, one after the other.
    fn queue(&self, pass: Pass<'_>) -> Queue {
        let mut all: Vec<Rays> = self.counts.iter().map(|count| count.rays).collect();
        all.dedup_by(|a, b| a == b);
        let mut queue = Queue::default();
        for (group, rays) in all.into_iter().enumerate() {
            for (place, source) in self.sources_of(rays, pass).into_iter().enumerate() {
                let count = source.count::<F>();
                queue.add(rays, [group, place], source, count);
            }
        }
        queue
    }

    /// The first indices of the rays of one kind; of stored cases all.
    fn sources_of(&self, rays: Rays, pass: Pass<'_>) -> Vec<Source> {
        let Pass { seed, count, .. } = pass;
        let reseeded = |source: &Source| match source.stock {
            Stock::Family(_) => Source {
                seed,
                count,
                ..source.clone()
            },
            _ => source.clone(),
        };
        match rays {
            Rays::Stratum(stratum) => vec![self.source(stratum, seed, count)],
            _ => self
                .sources
                .iter()
                .filter(|source| Rays::of(source) == rays)
                .map(reseeded)
                .collect(),
        }
    }

    /// The first indices of a stratum.
    pub fn source(&self, stratum: Stratum, seed: u64, count: u64) -> Source {
        let kernel = (stratum == Stratum::Shadow).then(|| self.row.entry.info.name.to_owned());
        let scene = Some(self.scene.cloned().unwrap_or_default());
        let parameters = Parameters {
            scene,
            kernel,
            ..Parameters::default()
        };
        Source::of_stratum(stratum, self.mesh, parameters, seed, count)
    }

    /// A ray of a picture's pixels near a shared edge.
    pub(super) fn pixel(&self, scene: &Scene, seed: u64, index: u64) -> Pixel<F> {
        match self.mesh {
            Some(mesh) => pixel(&mesh.triangles::<F>(scene), scene, seed, index),
            None => pixel(scene, scene, seed, index),
        }
    }

    /// The triangles around those of a pixel that may have its hit, with its ray; none if they are too many to be asked.
    pub(super) fn around_pixel(
        &self,
        pixel: &Pixel<F>,
        seed: u64,
        index: u64,
    ) -> Option<Vec<Case<F>>> {
        let (ray, mut around) = (&pixel.cases[0].ray, Vec::new());
        let draw = &mut pixel_draw(seed, index);
        let is_asked = match self.mesh {
            Some(mesh) => mesh.add_neighbours(Stratum::Edges, draw, ray, &mut around),
            None => add_ring(&pixel.cases, ray, &mut around),
        };
        self.keep_moved(&self.source(Stratum::Edges, seed, 0), &mut around);
        is_asked.then_some(around)
    }

    /// The cases of some indices, their margins, and the trials among them.
    fn prepare(&self, source: &Source, rays: Rays, indices: Range<u64>) -> Prepared<F> {
        let made = match self.shared {
            Some(shared) => shared.part(source, indices),
            None => Arc::new(MadeCases::new(source, indices)),
        };
        let (margins, values) = self.margins(&made.chunk.cases);
        let mut hits = Vec::new();
        if self.place(rays, WrongKind::Miss).is_some() {
            hits.extend(values.into_iter().map(|hit| (hit, OnceLock::new())));
        }
        let trials = self.trials(&made.chunk, rays);
        let mut prepared = Prepared {
            made,
            margins,
            others: Vec::new(),
            relative: OnceLock::new(),
            hits,
            trials,
        };
        self.add_crossings(rays, &mut prepared);
        let Prepared {
            margins, trials, ..
        } = &mut prepared;
        trials.retain(|trial| !margins[trial.margins.clone()].iter().any(is_unknown));
        prepared
    }

    /// The place of a count, if it is counted.
    fn place(&self, rays: Rays, kind: WrongKind) -> Option<usize> {
        self.counts
            .iter()
            .position(|count| *count == RayCount { rays, kind })
    }

    /// Which cases are a trial together, and of which count; other rays than those of a stratum may count for several things.
    fn trials(&self, chunk: &Chunk<F>, rays: Rays) -> Vec<PreparedTrial> {
        let (contract, gates) = (&self.row.contract, self.row.entry.info.gates);
        let [_, misses, hits, self_hits] = WrongKind::ALL.map(|kind| self.place(rays, kind));
        let stratum = match rays {
            Rays::Stratum(stratum) => Some(stratum.family()),
            _ => None,
        };
        let is_start = stratum.is_some() || chunk.grouping == Grouping::SecondaryRay;
        let starts = self_hits.filter(|_| is_start);
        let roles = || self.knobs.iter().map(|knob| knob.gate(gates).role);
        // By knob, by the number of the class.
        let by_class = |role| Class::all().map(move |class| guards(gates, role, contract, class));
        let guarded: Vec<Vec<bool>> = roles().map(|role| by_class(role).collect()).collect();
        let mut trials = Vec::new();
        for (i, obligation) in chunk.obligations(contract).into_iter().enumerate() {
            // A stratum is what a knob is there for, or is not.
            let mut guards = [stratum.is_some(); MOST_KNOBS];
            for (guards, (role, of_classes)) in guards.iter_mut().zip(roles().zip(&guarded)) {
                *guards |= match starts {
                    Some(_) => guards_start(role, contract),
                    None => of_classes[chunk.class(i).number()],
                };
            }
            let count = match obligation {
                _ if starts.is_some() => starts,
                // At a mesh not every parallel ray can be made exactly so.
                _ if stratum.is_some_and(|family| !family.keeps(&chunk.truths[i..=i])) => None,
                Obligation::MustHit => misses,
                Obligation::MustMiss => hits,
                Obligation::Free => None,
            };
            trials.extend(count.map(|count| PreparedTrial {
                count,
                guards,
                first: i,
                margins: i..i + 1,
                around: 0,
            }));
        }
        trials
    }
}
