//! What both worlds count, and when two counts differ.

use super::dice::Dice;
use super::meshes::Mesh;
use super::rays::{Aim, Shot, plane_of, shots, words, words_of_rays};
use hairline::internals::audit::{EpsilonChoice, Row, Unobserved};
use hairline::internals::case::{Case, Scene};
use hairline::internals::epsilon::{
    Attempt, Knob, Pass, RayCount, Setting, WrongKind, contract_with, count_at, counts,
    own_epsilons,
};
use hairline::internals::family::{MeshFamily, Stratum};
use hairline::internals::files::mesh;
use hairline::internals::kernel::{Scalar, Verdict, find};
use hairline::internals::mesh::{SceneMesh, Surface};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rate {
    pub count: u64,
    pub of: u64,
}

impl Rate {
    pub fn share(self) -> f64 {
        self.count as f64 / self.of.max(1) as f64
    }

    /// Wilson's interval at four standard deviations.
    fn ends(self) -> [f64; 2] {
        let (share, of, z) = (self.share(), self.of.max(1) as f64, 4.0f64);
        let middle = share + z * z / (2.0 * of);
        let half = z * (share * (1.0 - share) / of + z * z / (4.0 * of * of)).sqrt();
        [middle - half, middle + half].map(|end| end / (1.0 + z * z / of))
    }

    /// Whether it is larger than so many times another rate, by more than chance.
    pub fn is_above(self, other: Rate, times: f64) -> bool {
        let ([low, _], [_, high]) = (self.ends(), other.ends());
        times * high < low
    }
}

impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.3} % ({} of {})",
            100.0 * self.share(),
            self.count,
            self.of
        )
    }
}

/// A kernel with what may be chosen of it.
pub struct Tuned {
    pub row: Row,
    pub knobs: Vec<Knob>,
    pub counts: Vec<RayCount>,
}

impl Tuned {
    pub fn new(kernel: &str) -> Tuned {
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
        Tuned { row, knobs, counts }
    }

    pub fn setting<'a, F: Scalar>(
        &'a self,
        scene: &'a Scene,
        counts: &'a [RayCount],
    ) -> Setting<'a, F> {
        Setting {
            row: &self.row,
            subject: F::subject(self.row.entry).unwrap(),
            knobs: &self.knobs,
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

    pub fn zeros<F: Scalar>(&self) -> Vec<F> {
        vec![F::zero(); self.knobs.len()]
    }

    pub fn published<F: Scalar>(&self) -> Vec<F> {
        own_epsilons(&self.row, &self.knobs, F::zero())
    }

    /// How many rays are answered wrongly with epsilons for all knobs.
    pub fn wrong<F: Scalar>(&self, aim: Aim, all: &[Shot], epsilons: &[F]) -> Rate {
        let cases: Vec<_> = all.iter().flat_map(Shot::cases::<F>).collect();
        self.wrong_of(aim, all, &cases, epsilons)
    }

    /// The same, with the rays' cases.
    pub fn wrong_of<F: Scalar>(
        &self,
        aim: Aim,
        all: &[Shot],
        cases: &[Case<F>],
        epsilons: &[F],
    ) -> Rate {
        let mut of_gates = self.row.epsilons::<F>();
        let mut least_t = None;
        for (knob, epsilon) in self.knobs.iter().zip(epsilons) {
            match knob {
                Knob::Gate(gate) => of_gates[*gate] = *epsilon,
                Knob::LeastT => least_t = Some(*epsilon),
            }
        }
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        F::subject(self.row.entry)
            .unwrap()
            .run(cases, &of_gates, &mut verdicts);
        let mut rest = &verdicts[..];
        let is_wrong = |shot: &&Shot| {
            let (of_shot, others) = rest.split_at(shot.faces.len());
            rest = others;
            let counts = |verdict: &Verdict<F>| least_t.is_none_or(|least_t| least_t <= verdict.t);
            let is_hit = of_shot.iter().any(|verdict| verdict.hit && counts(verdict));
            is_hit != aim.owes_a_hit()
        };
        Rate {
            count: all.iter().filter(is_wrong).count() as u64,
            of: all.len() as u64,
        }
    }
}

/// What hairline calls it.
pub fn count_of(aim: Aim) -> RayCount {
    let (stratum, kind) = match aim {
        Aim::Inside => (Stratum::Interior, WrongKind::Miss),
        Aim::Edge => (Stratum::Edges, WrongKind::Crack),
        Aim::Vertex => (Stratum::Vertices, WrongKind::Crack),
        Aim::Along => (Stratum::Grazing, WrongKind::Miss),
        Aim::AlongBeside => (Stratum::Grazing, WrongKind::Hit),
        Aim::Beside => (Stratum::Outside, WrongKind::Hit),
        Aim::Leave => (Stratum::Shadow, WrongKind::SelfHit),
    };
    RayCount {
        rays: hairline::internals::epsilon::Rays::Stratum(stratum),
        kind,
    }
}

/// The rays of an aim by where their planes lie.
pub fn by_plane<F: Scalar>(
    mesh: &Mesh,
    aim: Aim,
    tuned: &Tuned,
    seed: u64,
    count: usize,
) -> BTreeMap<&'static str, Vec<Shot>> {
    let mut planes = BTreeMap::<_, Vec<Shot>>::new();
    for shot in shots::<F>(mesh, aim, tuned.row.entry, &mut Dice::new(seed), count) {
        planes
            .entry(plane_of(mesh, &shot.faces))
            .or_default()
            .push(shot);
    }
    planes
}

/// The scene with planes of a kind, as hairline's tables have it: where they lack the kind, the generic one.
pub fn scene_of(mesh: &Mesh, shots: &[Shot], plane: &str) -> Scene {
    let all: Vec<&Shot> = shots.iter().collect();
    let (scene, _) = Scene::parse(&words(mesh, &all)).unwrap();
    let mut scenes = scene.of_all_kinds();
    let place = scenes.iter().position(|scene| scene.plane.name() == plane);
    scenes.swap_remove(place.unwrap_or(0))
}

/// What hairline counts of an aim in a scene.
pub fn theirs<F: Scalar>(
    tuned: &Tuned,
    scene: &Scene,
    aim: Aim,
    epsilons: &[F],
    count: u64,
) -> Rate {
    let counts = [count_of(aim)];
    let attempts = [Attempt::new(epsilons.to_vec())];
    let setting = tuned.setting::<F>(scene, &counts);
    let trials = count_at(&setting, &attempts, Pass::new(1, count, &Unobserved))[0][0];
    Rate {
        count: trials.count,
        of: trials.of,
    }
}

/// The same mesh as hairline reads it from a file, and its scene with the rays' distances.
pub fn read(mesh: &Mesh, shots: &[Shot]) -> (Arc<SceneMesh>, Scene) {
    let mut text = String::new();
    for (i, face) in mesh.faces.iter().enumerate() {
        face.iter()
            .for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
        text += &format!("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    let mut beside = |_: &str, _| Err(std::io::ErrorKind::NotFound.into());
    let read = mesh::read(text.as_bytes(), "world.obj", &mut beside, &mut |_| {}).unwrap();
    let family = Arc::new(MeshFamily::new(read, "world.obj"));
    let read = Arc::new(SceneMesh::new(Surface::new(family, [true, true])));
    let all: Vec<&Shot> = shots.iter().collect();
    let (_, distance) = words_of_rays(mesh, &all);
    let scene = read.scene().of_mesh(&distance).unwrap();
    (read, scene)
}

/// What hairline counts of an aim at a mesh.
pub fn theirs_at<F: Scalar>(
    tuned: &Tuned,
    (mesh, scene): &(Arc<SceneMesh>, Scene),
    aim: Aim,
    epsilons: &[F],
    count: u64,
) -> Rate {
    let counts = [count_of(aim)];
    let attempts = [Attempt::new(epsilons.to_vec())];
    let setting = Setting {
        mesh: Some(mesh),
        ..tuned.setting::<F>(scene, &counts)
    };
    let trials = count_at(&setting, &attempts, Pass::new(1, count, &Unobserved))[0][0];
    Rate {
        count: trials.count,
        of: trials.of,
    }
}
