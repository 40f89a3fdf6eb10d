//! The trials of a kernel in a scene, and one pass over them.

use super::super::relative::Scales;
use super::knob::{Knob, MOST_KNOBS, Margins};
use super::prepared::{Prepared, Store};
use crate::arith::Float;
use crate::audit::{Chunk, Row, Source, SourceSummary};
use crate::case::{Case, Parameters, Scene};
use crate::contract::{Contract, Extent, Sides};
use crate::engine::{self, Merge, Observer, Unobserved};
use crate::family::Stratum;
use crate::judge::{GroupTruth, Obligation};
use crate::kernel::{Hit, Scalar, Subject};
use crate::mesh::SceneMesh;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

named! {
    pub names
    /// How an answer is wrong in a scene; the word in `--cost`.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Kind {
        /// A ray slips through between triangles that share an edge or a vertex.
        Crack = "crack",
        /// A hit is lost.
        Miss = "miss",
        /// A hit is reported where there is none.
        Hit = "hit",
        /// A ray hits the triangle that it starts on.
        SelfHit = "self-hit",
    }
}

impl Kind {
    /// True if it is the refusal that is wrong.
    pub fn is_wrong_if_refused(self) -> bool {
        matches!(self, Kind::Crack | Kind::Miss)
    }
}

/// A number that is counted: the wrong answers of one kind in one stratum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Count {
    /// The stratum's family.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub stratum: Stratum,
    /// `crack`, `miss`, `hit` or `self-hit`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub kind: Kind,
}

/// The counts of a kernel with these knobs under a contract, in the order of reports. Without a
/// least t nothing can keep a ray from hitting the triangle that it starts on.
pub fn counts(knobs: &[Knob], contract: &Contract) -> Vec<Count> {
    use Stratum::*;
    let starts = contract.extent != Extent::Line;
    let culls = contract.sides == Sides::Front;
    let all = [
        (Interior, Kind::Miss, true),
        (Interior, Kind::Hit, culls),
        (Edges, Kind::Crack, true),
        (Vertices, Kind::Crack, true),
        (Grazing, Kind::Miss, true),
        (Grazing, Kind::Hit, true),
        (Parallel, Kind::Hit, true),
        (Shadow, Kind::SelfHit, starts && !knobs.is_empty()),
        (Outside, Kind::Hit, true),
    ];
    let counted = all.into_iter().filter(|(.., is_counted)| *is_counted);
    counted.map(|(stratum, kind, _)| Count { stratum, kind }).collect()
}

/// A scene to study.
pub struct StudiedScene {
    /// In numbers.
    pub scene: Scene,
    /// Its unit of length; empty if it has none.
    pub unit: &'static str,
    /// The mesh that it is, if it is one.
    pub mesh: Option<Arc<SceneMesh>>,
    /// The same scene with planes of other kinds; none if a kind is named, and for a mesh, which has its own.
    pub others: Vec<Scene>,
}

/// The setting of a pass: a kernel, its knobs and a scene.
pub struct Setting<'a, F: Float> {
    /// The kernel, its contract, and the epsilons of the gates that are no knobs.
    pub row: &'a Row,
    /// The same kernel in the scalar.
    pub subject: &'static dyn Subject<F>,
    /// At most [`MOST_KNOBS`].
    pub knobs: &'a [Knob],
    /// The kinds and strata whose wrong answers are counted.
    pub counts: &'a [Count],
    /// The scene.
    pub scene: &'a Scene,
    /// The mesh that it is, if it is one.
    pub mesh: Option<&'a Arc<SceneMesh>>,
    /// Epsilons are multiplied by each case's own size.
    pub relative: bool,
    /// Curves are counted at every number of two digits.
    pub fine_curves: bool,
    /// The store that keeps the rays of this kernel, its knobs and its scene between passes.
    pub store: Option<&'a Store<F>>,
}

/// A trial: the answers on a ray that counts for something.
pub struct Trial<'a, F: Float> {
    /// Which of the setting's counts it is for.
    pub count: usize,
    /// The margins of each triangle; a hit is reported if one is accepted.
    pub margins: &'a [Margins<F>],
    /// The triangles with their ray.
    pub cases: &'a [Case<F>],
    /// The values that a hit of each triangle would report.
    pub values: &'a [Option<Hit<F>>],
}

impl<F: Float> Trial<'_, F> {
    /// True if a hit is reported with these epsilons.
    pub fn is_hit(&self, epsilons: &[F]) -> bool {
        self.margins.iter().any(|margins| accepts(margins, epsilons))
    }
}

/// True if the kernel failed while its margins were looked for.
pub fn is_unknown<F: Float>(margins: &Margins<F>) -> bool {
    margins[0].is_nan()
}

/// True if margins accept epsilons.
pub fn accepts<F: Float>(margins: &Margins<F>, epsilons: &[F]) -> bool {
    epsilons.iter().zip(margins).all(|(epsilon, margin)| epsilon <= margin)
}

impl<F: Scalar> Setting<'_, F> {
    /// Runs all trials of a seed's first indices of every stratum, and sums what `add` makes of them.
    pub fn sum<S: Merge>(
        &self,
        seed: u64,
        count: u64,
        observer: &dyn Observer,
        empty: impl Fn() -> S + Sync,
        add: impl Fn(&mut S, Trial<'_, F>) + Sync,
    ) -> S {
        self.sum_with(seed, count, observer, empty, add, |_, _, _| {})
    }

    /// The same; `look` also sees each chunk's cases with their margins, those that are no trials included.
    pub fn sum_with<S: Merge>(
        &self,
        seed: u64,
        count: u64,
        observer: &dyn Observer,
        empty: impl Fn() -> S + Sync,
        add: impl Fn(&mut S, Trial<'_, F>) + Sync,
        look: impl Fn(&mut S, &[Case<F>], &[Margins<F>]) + Sync,
    ) -> S {
        let mut total = empty();
        for stratum in Stratum::ALL {
            if !self.counts.iter().any(|count| count.stratum == stratum) {
                continue;
            }
            let source = self.source(stratum, seed, count);
            let add = |sums: &mut S, indices: Range<u64>| {
                let place = (stratum, indices.start, indices.end);
                let make = || self.prepare(&source, stratum, indices);
                let part = match self.store {
                    Some(store) => store.part(seed, place, make),
                    None => Arc::new(make()),
                };
                let Prepared { cases, margins, relative, values, trials } = &*part;
                let margins = match self.relative {
                    true => relative.get_or_init(|| self.relative_margins(cases, margins)),
                    false => margins,
                };
                look(sums, cases, margins);
                for (count, range) in trials {
                    let (margins, cases) = (&margins[range.clone()], &cases[range.clone()]);
                    let values = &values[range.clone()];
                    add(sums, Trial { count: *count, margins, cases, values });
                }
            };
            let indices = 0..source.count::<F>();
            total.merge(engine::sum(indices, source.chunk(), observer, &empty, add));
        }
        total
    }

    /// The first indices of a stratum.
    pub fn source(&self, stratum: Stratum, seed: u64, count: u64) -> Source {
        let kernel = (stratum == Stratum::Shadow).then(|| self.row.entry.info.name.to_owned());
        let scene = Some(self.scene.clone());
        let parameters = Parameters { scene, kernel, ..Parameters::default() };
        match self.mesh {
            Some(mesh) => Source::of_scene_mesh(mesh, stratum, parameters, seed, count),
            None => Source::Family {
                family: stratum.family(),
                parameters,
                seed,
                count,
                exhaustive: false,
            },
        }
    }

    /// The cases of some indices, their margins, and the trials among them.
    fn prepare(&self, source: &Source, stratum: Stratum, indices: Range<u64>) -> Prepared<F> {
        let mut summary = SourceSummary::new(0, F::NAME);
        let chunk = Chunk::<F>::make(source, indices, &Unobserved, &mut summary);
        let (margins, values) = self.margins(&chunk.cases);
        let mut trials = self.trials(&chunk, stratum);
        trials.retain(|(_, range)| !margins[range.clone()].iter().any(is_unknown));
        Prepared { cases: chunk.cases, margins, relative: OnceLock::new(), values, trials }
    }

    /// Which cases are a trial together, and of which count.
    fn trials(&self, chunk: &Chunk<F>, stratum: Stratum) -> Vec<(usize, Range<usize>)> {
        let contract = &self.row.contract;
        let of =
            |kind: Kind| self.counts.iter().position(|count| *count == Count { stratum, kind });
        if let Some(count) = of(Kind::SelfHit) {
            return (0..chunk.cases.len()).map(|i| (count, i..i + 1)).collect();
        }
        if let Some(count) = of(Kind::Crack) {
            let groups = chunk.groups().zip(chunk.group_truths(contract));
            let crossed = groups.filter(|(_, truth)| *truth == GroupTruth::Crossing);
            return crossed.map(|((_, range), _)| (count, range)).collect();
        }
        let [misses, hits] = [of(Kind::Miss), of(Kind::Hit)];
        let family = stratum.family();
        let all = chunk.obligations(contract).into_iter().enumerate();
        let counted = all.filter_map(|(i, obligation)| {
            let count = match obligation {
                // At a mesh not every parallel ray can be made exactly so.
                _ if !family.keeps(&chunk.truths[i..=i]) => None,
                Obligation::MustHit => misses,
                Obligation::MustMiss => hits,
                Obligation::Free => None,
            };
            Some((count?, i..i + 1))
        });
        counted.collect()
    }

    /// Each case's margins of the knobs, -inf where another gate refuses, NaN where they are unknown; and what a
    /// hit would report.
    fn margins(&self, cases: &[Case<F>]) -> (Vec<Margins<F>>, Vec<Option<Hit<F>>>) {
        let info = self.row.entry.info;
        let gates = info.gates;
        let epsilons = self.row.epsilons::<F>();
        let mut all = vec![F::zero(); cases.len() * gates.len()];
        let mut values = vec![None; cases.len()];
        self.subject.margins(info, cases, &mut all, &mut values);
        let is_fixed = |gate: usize| !self.knobs.contains(&Knob::Gate(gate));
        let of_case = |i: usize| {
            let row = &all[i * gates.len()..(i + 1) * gates.len()];
            if row.iter().any(|margin| margin.is_nan()) {
                return [F::from_f64(f64::NAN); MOST_KNOBS];
            }
            let refused = (0..gates.len()).any(|g| is_fixed(g) && row[g] < epsilons[g]);
            let mut margins = [F::infinity(); MOST_KNOBS];
            if refused {
                return [-F::infinity(); MOST_KNOBS];
            }
            for (margin, knob) in margins.iter_mut().zip(self.knobs) {
                *margin = match knob {
                    Knob::Gate(gate) => row[*gate],
                    Knob::LeastT => t_of(values[i].as_ref()),
                };
            }
            margins
        };
        ((0..cases.len()).map(of_case).collect(), values)
    }

    /// Margins as multiples of each case's own size.
    fn relative_margins(&self, cases: &[Case<F>], margins: &[Margins<F>]) -> Vec<Margins<F>> {
        let mut relative = margins.to_vec();
        for (k, knob) in self.knobs.iter().enumerate() {
            let dimension = knob.dimension(self.row.entry.info.gates);
            if dimension.has_unit() {
                let scales = Scales::new(cases, dimension);
                let all = relative.iter_mut().enumerate();
                all.for_each(|(i, margins)| margins[k] = scales.relative(i, margins[k]));
            }
        }
        relative
    }
}

/// The t that a hit would report; -inf if it is no number, for no comparison accepts that.
fn t_of<F: Float>(values: Option<&Hit<F>>) -> F {
    let t = values.and_then(|hit| hit.t);
    t.filter(|t| !t.is_nan()).unwrap_or(-F::infinity())
}
