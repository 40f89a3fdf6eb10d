//! Kernels with the numbers that can be chosen, in a scene; and all trials of a pass, for brute force.

use super::*;

/// One trial of a pass.
pub struct StoredStudy {
    pub count: usize,
    pub margins: Vec<KnobMargins<f32>>,
    pub errors: HitErrors,
}

struct All(Vec<StoredStudy>);

impl Merge for All {
    fn merge(&mut self, other: All) {
        self.0.extend(other.0);
    }
}

pub struct Tuned {
    pub row: Row,
    pub knobs: Vec<Knob>,
    pub counts: Vec<RayCount>,
    pub scene: Scene,
}

impl Tuned {
    pub fn new(kernel: &str, scene: &str) -> Tuned {
        let row = EpsilonChoice::Source
            .rows(&[find(kernel).unwrap()], None)
            .unwrap()
            .remove(0);
        let knobs = Knob::all(&row);
        let row = Row {
            contract: contract_with(&knobs, &row.contract),
            ..row
        };
        let counts = counts(&knobs, &row.contract);
        Tuned {
            row,
            knobs,
            counts,
            scene: Scene::parse(scene).unwrap().0,
        }
    }

    pub fn setting(&self) -> Setting<'_, f32> {
        let Tuned {
            row,
            knobs,
            counts,
            scene,
        } = self;
        let subject = f32::subject(row.entry).unwrap();
        Setting {
            row,
            subject,
            knobs,
            counts,
            scene: Some(scene),
            sources: &[],
            mesh: None,
            relative: false,
            fine_curves: false,
            store: None,
            shared: None,
        }
    }

    pub fn all(&self, seed: u64, number: u64) -> Vec<StoredStudy> {
        let keep = |all: &mut All, trial: Trial<'_, f32>| {
            let margins = trial.margins.to_vec();
            all.0.push(StoredStudy {
                count: trial.count,
                margins,
                errors: trial.errors(),
            });
        };
        self.setting()
            .sum(
                Pass::new(seed, number, &Unobserved),
                || All(Vec::new()),
                keep,
            )
            .0
    }

    pub fn is_miss(&self, count: usize) -> bool {
        self.counts[count].kind == WrongKind::Miss
    }

    /// True if a refusal is wrong for this count.
    pub fn is_lost(&self, count: usize) -> bool {
        matches!(self.counts[count].kind, WrongKind::Miss | WrongKind::Crack)
    }
}

impl StoredStudy {
    pub fn is_hit(&self, epsilons: &[f32]) -> bool {
        self.margins
            .iter()
            .any(|m| epsilons.iter().zip(m).all(|(e, m)| e <= m))
    }

    /// True if it is a hit after one of the epsilons is replaced.
    pub fn is_hit_with(&self, epsilons: &[f32], knob: usize, value: f32) -> bool {
        let mut moved = epsilons.to_vec();
        moved[knob] = value;
        self.is_hit(&moved)
    }

    /// The largest value of a knob at which it is a hit: one of its margins; -inf if it is none anywhere.
    pub fn alone(&self, epsilons: &[f32], knob: usize) -> f32 {
        let margins = self.margins.iter().map(|m| m[knob]);
        let hits = margins.filter(|m| self.is_hit_with(epsilons, knob, *m));
        hits.fold(f32::NEG_INFINITY, f32::max)
    }
}

/// Kernels, and epsilons that are no round numbers.
pub const KERNELS: [(&str, [f32; 3]); 4] = [
    ("moller-trumbore", [1.3e-7, -1.3e-5, 1.3e-4]),
    ("plane-unit-normal", [1.3e-3, 1.3e-4, 0.0]),
    ("woop-watertight", [-1.3e-7, 1.3e-9, 0.0]),
    ("moller-trumbore-culling", [1.3e-6, 1.3e-5, 1.3e-3]),
];
