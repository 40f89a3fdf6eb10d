//! Follows a particle from surface to surface through closed parts in each other, as transport programs do, with one kernel, and
//! counts where it is lost against the exact scene.

use crate::solids::cuboid;
use crate::spheres::icosphere;
use hairline_core::case::Draw;
use hairline_core::kernel::{EpsilonText, KERNELS};
use hairline_core::{Case, Entry, Float, KernelIn, Scalar, Sides, Verdict};
use hairline_scene::{Answer, Judgement, Location, Ray, Scene, Triangle, Winding};
use std::collections::BTreeMap;

/// Parts in each other, the outermost first: the cubes of svalinn/DAGMC#986 with shells of spheres in them, as in
/// openmc-dev/openmc#3600. A cell is known by the number of surfaces around it.
pub struct Parts<F: Float> {
    scene: Scene<F>,
    faces: Vec<Triangle<F>>,
    /// The surface of each face.
    surfaces: Vec<i64>,
    /// Vertices, and middles of edges.
    targets: Vec<[F; 3]>,
}

impl<F: Float> Parts<F> {
    pub fn new() -> Parts<F> {
        let cube = |size: f64| cuboid([-size; 3], [size; 3]);
        let sphere = |radius: f64| {
            let faces = icosphere(2).triangles();
            let scaled = |vertex: [f32; 3]| vertex.map(|x| f64::from(x) * radius);
            faces.into_iter().map(|face| face.map(scaled)).collect()
        };
        let parts: [Vec<Triangle<f64>>; 5] = [
            cube(60.0),
            cube(57.5),
            sphere(50.0),
            sphere(40.0),
            cube(10.0),
        ];
        let rounded = |x: f64| F::from_f64(x);
        let half = rounded(0.5);
        let (mut faces, mut surfaces, mut targets) = (Vec::new(), Vec::new(), Vec::new());
        for (surface, part) in (0..).zip(parts) {
            for face in part {
                let face = face.map(|vertex| vertex.map(rounded));
                let [a, b, _] = face;
                faces.push(face);
                surfaces.push(surface);
                // Those of the outermost part are where it is turned back.
                if surface != 0 {
                    targets.extend([a, [0, 1, 2].map(|i| (a[i] + b[i]) * half)]);
                }
            }
        }
        let vertices: Vec<[F; 3]> = faces.iter().flatten().copied().collect();
        let numbers = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        let scene = Scene::new(&vertices, &numbers.collect::<Vec<_>>()).unwrap();
        assert_eq!(scene.closed().oriented, Ok(()));
        Parts {
            scene,
            faces,
            surfaces,
            targets,
        }
    }

    /// Checks that a point is in the wall between both outer cubes, and that a ray from it leaves through the side x = -60.
    #[allow(dead_code)]
    pub fn check_wall(&self, at: [F; 3], direction: [F; 3]) {
        let in_wall = Location::Off(Winding::Number(1));
        assert_eq!(self.scene.locate(at), Ok(in_wall));
        let ray = Ray::new(at, direction);
        let passages = self.scene.passages(&ray).unwrap();
        assert_eq!(passages.len(), 1);
        assert_eq!(passages[0].around, Ok([1, 0].map(Winding::Number)));
        let values = self.scene.values(&ray, passages[0].faces[0]).unwrap();
        assert_eq!(values.unwrap().points[0][0], -60.0);
    }

    fn cells(&self) -> i64 {
        self.surfaces[self.surfaces.len() - 1] + 1
    }
}

/// A program: the nearest hit of a kernel on all faces, or the exact first passage that crosses a surface.
pub enum Program<F: Float> {
    Exact,
    Kernel(&'static dyn KernelIn<F>, Vec<F>),
}

impl<F: Scalar> Program<F> {
    /// A built-in kernel with its first epsilons. None if it misses the backs of faces.
    fn of(entry: &'static Entry) -> Option<Program<F>> {
        if entry.info.contract.sides == Sides::Front {
            return None;
        }
        let texts = entry.info.epsilon_sets[0].values.iter();
        let epsilons = texts.map(|text| EpsilonText::of(text)?.value());
        Some(Program::Kernel(
            F::subject(entry)?,
            epsilons.collect::<Option<_>>()?,
        ))
    }

    /// All of them, by name.
    pub fn all() -> Vec<(&'static str, Program<F>)> {
        let kernels = KERNELS
            .iter()
            .filter_map(|entry| Some((entry.info.name, Program::of(entry)?)));
        [("exact", Program::Exact)]
            .into_iter()
            .chain(kernels)
            .collect()
    }

    fn nearest(&self, parts: &Parts<F>, ray: &Ray<F>) -> Option<(u32, F)> {
        let Program::Kernel(kernel, epsilons) = self else {
            let passages = parts.scene.passages(ray).unwrap();
            let crossed = passages
                .iter()
                .find(|passage| passage.crosses() == Ok(true))?;
            let t = parts.scene.ends(ray, crossed).unwrap()[0];
            return Some((crossed.faces[0], F::from_f64(t)));
        };
        let mut best: Option<(u32, F)> = None;
        let visited = parts.scene.visit(ray, |face, _| {
            let triangle = parts.faces[face as usize];
            let case = Case::<F>::new(ray.origin, ray.direction, triangle);
            let mut verdict = [Verdict::miss(None)];
            kernel.run(&[case.on(ray.t_min, ray.t_max)], epsilons, &mut verdict);
            // Some kernels give no t.
            let t = if verdict[0].t.is_finite() {
                verdict[0].t
            } else {
                plane_t(ray, triangle)
            };
            let is_nearer = best.is_none_or(|(_, least)| t < least);
            if verdict[0].hit && ray.t_min <= t && is_nearer {
                best = Some((face, t));
            }
            None
        });
        visited.unwrap();
        best
    }
}

fn plane_t<F: Float>(ray: &Ray<F>, [a, b, c]: Triangle<F>) -> F {
    let minus = |p: [F; 3], q: [F; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
    let dot = |p: [F; 3], q: [F; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let ([p, q, r], [x, y, z]) = (minus(b, a), minus(c, a));
    let normal = [q * z - r * y, r * x - p * z, p * y - q * x];
    dot(minus(a, ray.origin), normal) / dot(ray.direction, normal)
}

/// How a particle is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lost {
    /// Nothing is hit, within closed parts.
    NothingHit,
    /// The surface that is hit is none of its cell.
    OtherSurface,
    /// It passes through another cell than the program says, which notices nothing.
    OtherCell,
}

/// Why, in this step or in the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The answer was wrong.
    Wrong(Judgement),
    /// The answer was right: an edge or a vertex that the ray touches, and does not cross.
    Touched,
    /// All answers were right: the rounded point, or t_min behind it, is beyond another surface.
    Rounded,
}

/// The losses of a particle on its way.
pub type Losses = BTreeMap<(Lost, Reason), u64>;

struct Particle<F> {
    at: [F; 3],
    direction: [F; 3],
    cell: i64,
    /// From this t on surfaces count: a point that was moved to a surface lies a little before it or behind it.
    t_min: F,
    reason: Option<Reason>,
}

/// Follows a particle for some steps; one that is lost starts again in the middle.
pub fn follow<F: Scalar>(parts: &Parts<F>, program: &Program<F>, seed: u64, steps: u64) -> Losses {
    let mut losses = Losses::new();
    let mut particle = None;
    for step in 0..steps {
        let mut draw = Draw::new("particle", seed, step);
        let mut now = particle.take().unwrap_or_else(|| Particle {
            at: [F::zero(); 3],
            direction: direction(parts, [F::zero(); 3], &mut draw),
            cell: parts.cells(),
            t_min: F::zero(),
            reason: None,
        });
        match now.step(parts, program, &mut draw) {
            Ok(()) => particle = Some(now),
            Err(lost) => {
                let reason = now.reason.unwrap_or(Reason::Rounded);
                *losses.entry((lost, reason)).or_default() += 1;
            }
        }
    }
    losses
}

/// Why a particle may be lost that follows an answer.
fn reason<F: Float>(parts: &Parts<F>, ray: &Ray<F>, nearest: Option<(u32, F)>) -> Option<Reason> {
    let answer = Answer {
        face: nearest.map(|(face, _)| face),
        t: nearest.map(|(_, t)| t.to_f64()),
    };
    let judgement = parts.scene.judge(ray, &answer).unwrap().judgement;
    if judgement.is_wrong() {
        return Some(Reason::Wrong(judgement));
    }
    let passages = parts.scene.passages(ray).unwrap();
    let is_crossed = passages.first()?.crosses() == Ok(true);
    (!is_crossed).then_some(Reason::Touched)
}

/// A direction to a vertex, to the middle of an edge, or to any point well inside.
fn direction<F: Float>(parts: &Parts<F>, from: [F; 3], draw: &mut Draw) -> [F; 3] {
    let any = draw.point().map(|x: F| x * F::from_f64(30.0));
    let target = if draw.coin() {
        draw.pick(&parts.targets)
    } else {
        any
    };
    let way = [0, 1, 2].map(|i| target[i] - from[i]);
    if way == [F::zero(); 3] {
        [F::one(); 3]
    } else {
        way
    }
}

impl<F: Scalar> Particle<F> {
    fn step(
        &mut self,
        parts: &Parts<F>,
        program: &Program<F>,
        draw: &mut Draw,
    ) -> Result<(), Lost> {
        let ray = Ray::new(self.at, self.direction).on(self.t_min, F::infinity());
        let nearest = program.nearest(parts, &ray);
        let now = match program {
            Program::Exact => None,
            Program::Kernel(..) => reason(parts, &ray, nearest),
        };
        let before = std::mem::replace(&mut self.reason, now);
        let result = self.go(parts, nearest, draw);
        if result.is_err() {
            self.reason = self.reason.or(before);
        }
        result
    }

    /// To the surface that is hit, or to a collision before it.
    fn go(
        &mut self,
        parts: &Parts<F>,
        nearest: Option<(u32, F)>,
        draw: &mut Draw,
    ) -> Result<(), Lost> {
        let (face, t) = nearest.ok_or(Lost::NothingHit)?;
        let surface = parts.surfaces[face as usize];
        if self.cell != surface && self.cell != surface + 1 {
            return Err(Lost::OtherSurface);
        }
        let half = F::from_f64(0.5);
        let middle = self.at_t(self.t_min * half + t * half);
        let cell = Winding::Number(self.cell);
        if parts.scene.locate(middle).unwrap() != Location::Off(cell) {
            return Err(Lost::OtherCell);
        }
        if draw.below(4) == 0 {
            self.at = middle;
            self.direction = direction(parts, self.at, draw);
            self.t_min = F::zero();
            return Ok(());
        }
        self.at = self.at_t(t);
        if surface == 0 {
            self.direction = direction(parts, self.at, draw);
        } else {
            self.cell = 2 * surface + 1 - self.cell;
        }
        let [x, y, z] = self.direction.map(F::to_f64);
        // Some hundred roundings of a coordinate.
        let offset = 60.0 * 256.0 * F::EPSILON.to_f64();
        self.t_min = F::from_f64(offset / (x * x + y * y + z * z).sqrt());
        Ok(())
    }

    fn at_t(&self, t: F) -> [F; 3] {
        [0, 1, 2].map(|i| self.at[i] + t * self.direction[i])
    }
}
