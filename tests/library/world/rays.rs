//! The second world's rays: from random points to random points of surfaces and edges, to vertices, along surfaces, and
//! from hit points.

use super::dice::Dice;
use super::exact::{Meeting, Point, cross, dot, length, minus, plus, unit};
use super::meshes::Mesh;
use hairline::internals::arith::Float;
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Scalar, Verdict};

/// What rays are aimed at, and what may go wrong there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aim {
    /// A hit is lost.
    Inside,
    /// A ray slips through.
    Edge,
    /// The same.
    Vertex,
    /// A hit is lost on a surface that is almost parallel to the ray.
    Along,
    /// A false hit there.
    AlongBeside,
    /// A false hit on a point of the plane outside the triangle.
    Beside,
    /// The triangle that a ray leaves is hit.
    Leave,
}

impl Aim {
    pub const ALL: [Aim; 7] = [
        Aim::Inside,
        Aim::Edge,
        Aim::Vertex,
        Aim::Along,
        Aim::AlongBeside,
        Aim::Beside,
        Aim::Leave,
    ];

    /// Whether a hit is the right answer.
    pub fn owes_a_hit(self) -> bool {
        matches!(self, Aim::Inside | Aim::Edge | Aim::Vertex | Aim::Along)
    }
}

/// A ray with the triangles of which one has to be hit, or which must not be hit. All numbers are floats of the scalar
/// that rounded them.
#[derive(Clone, Debug)]
pub struct Shot {
    pub origin: Point,
    pub direction: Point,
    pub faces: Vec<[Point; 3]>,
    /// How far the target is.
    pub distance: f64,
}

impl Shot {
    pub fn cases<F: Float>(&self) -> impl Iterator<Item = Case<F>> {
        let narrow = |p: Point| p.map(F::from_f64);
        self.faces.iter().map(move |face| {
            Case::new(
                narrow(self.origin),
                narrow(self.direction),
                face.map(narrow),
            )
        })
    }

    /// Whether it is what its aim says.
    pub fn is_owed(&self, aim: Aim) -> bool {
        let meets: Vec<Meeting> = self
            .faces
            .iter()
            .map(|face| Meeting::of(self.origin, self.direction, *face))
            .collect();
        let facing = meets[0].facing;
        let is_regular = meets
            .iter()
            .all(|meets| meets.facing == facing && facing != 0);
        let is_hit = meets.iter().any(Meeting::is_hit);
        match aim {
            Aim::Leave => true,
            Aim::Beside | Aim::AlongBeside => is_regular && !is_hit,
            _ => is_regular && is_hit,
        }
    }
}

pub fn corners_normal([a, b, c]: [Point; 3]) -> Point {
    cross(minus(b, a), minus(c, a))
}

/// A face of a random point of the surface: likely by its area.
struct Surface<'a> {
    mesh: &'a Mesh,
    sums: Vec<f64>,
}

impl<'a> Surface<'a> {
    fn new(mesh: &'a Mesh) -> Surface<'a> {
        let mut sum = 0.0;
        let areas = mesh.faces.iter().map(|face| {
            sum += length(corners_normal(*face));
            sum
        });
        Surface {
            mesh,
            sums: areas.collect(),
        }
    }

    fn face(&self, dice: &mut Dice) -> [Point; 3] {
        let at = dice.share() * self.sums[self.sums.len() - 1];
        self.mesh.faces[self.sums.partition_point(|sum| *sum < at)]
    }
}

/// A point of a triangle, uniform: Osada and others, "Shape distributions", 2002, section 4.2.
fn point_inside([a, b, c]: [Point; 3], dice: &mut Dice) -> Point {
    let (root, share) = (dice.share().sqrt(), dice.share());
    plus(
        plus(a, minus(b, a), root * (1.0 - share)),
        minus(c, a),
        root * share,
    )
}

/// A point of the plane beside a triangle: on the other side of one of its edges, no farther than that is long.
fn point_beside(face: [Point; 3], dice: &mut Dice) -> Point {
    let k = dice.one_of(3);
    let (p, q, r) = (face[k], face[(k + 1) % 3], face[(k + 2) % 3]);
    let on_edge = plus(p, minus(q, p), dice.between(-0.5, 1.5));
    plus(on_edge, minus(on_edge, r), dice.share())
}

fn rounded<F: Float>(p: Point) -> Point {
    p.map(|x| F::from_f64(x).to_f64())
}

fn shot<F: Float>(from: Point, to: Point, faces: Vec<[Point; 3]>) -> Shot {
    let origin = rounded::<F>(from);
    let way = minus(to, origin);
    Shot {
        origin,
        direction: rounded::<F>(unit(way)),
        faces,
        distance: length(way),
    }
}

/// Rays of one aim at a mesh, and how many were drawn for them; those that owe nothing are left out.
pub fn shots<F: Scalar>(
    mesh: &Mesh,
    aim: Aim,
    kernel: &Entry,
    dice: &mut Dice,
    count: usize,
) -> Vec<Shot> {
    let surface = Surface::new(mesh);
    let mut all = Vec::with_capacity(count);
    let of = |faces: &[usize]| {
        faces
            .iter()
            .map(|face| mesh.faces[*face])
            .collect::<Vec<_>>()
    };
    for _ in 0..40 * count {
        if all.len() == count {
            break;
        }
        let from = [0, 1, 2].map(|i| dice.between(mesh.air[0][i], mesh.air[1][i]));
        let face = surface.face(dice);
        let made = match aim {
            Aim::Inside => shot::<F>(from, point_inside(face, dice), vec![face]),
            Aim::Beside => shot::<F>(from, point_beside(face, dice), vec![face]),
            Aim::Edge => {
                let ([p, q], faces) = &mesh.edges[dice.one_of(mesh.edges.len())];
                let to = plus(*p, minus(*q, *p), dice.between(0.02, 0.98));
                shot::<F>(from, to, of(faces))
            }
            Aim::Vertex => {
                let (vertex, faces) = &mesh.fans[dice.one_of(mesh.fans.len())];
                shot::<F>(from, *vertex, of(faces))
            }
            Aim::Along | Aim::AlongBeside => match along::<F>(face, from, aim, dice) {
                Some(made) => made,
                None => continue,
            },
            Aim::Leave => match leaving::<F>(
                shot::<F>(from, point_inside(face, dice), vec![face]),
                kernel,
                dice,
            ) {
                Some(made) => made,
                None => continue,
            },
        };
        if made.is_owed(aim) {
            all.push(made);
        }
    }
    all
}

/// The sines of the angles of rays along surfaces, each tenth as likely.
const SINES: [f64; 2] = [1e-5, 1e-2];

/// A ray in a random direction of the plane, turned out of it by an angle that it still has, within a tenth, when it is
/// rounded; none if ever so many do not have it.
fn along<F: Float>(face: [Point; 3], from: Point, aim: Aim, dice: &mut Dice) -> Option<Shot> {
    // Rays at the inside of a triangle may pass it too, because they are rounded.
    let is_inside = aim == Aim::Along || dice.coin();
    let target = if is_inside {
        point_inside(face, dice)
    } else {
        point_beside(face, dice)
    };
    let normal = unit(corners_normal(face));
    let sine = SINES[0] * (SINES[1] / SINES[0]).powf(dice.share());
    let rise = if dice.coin() { sine } else { -sine };
    let distance = length(minus(target, from));
    let made = (0..1000).map(|_| {
        let flat = unit(cross(normal, dice.sphere()));
        let way = plus(flat, normal, rise);
        shot::<F>(plus(target, way, -distance), target, vec![face])
    });
    let reached = |shot: &Shot| dot(normal, unit(shot.direction)).abs() / sine;
    made.into_iter()
        .find(|shot| (1.0 / 1.1..1.1).contains(&reached(shot)))
}

/// The verdict of a kernel without any epsilon.
fn plain<F: Scalar>(kernel: &Entry, case: Case<F>) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    let zeros = vec![F::zero(); kernel.info.gates.len()];
    F::subject(kernel)
        .unwrap()
        .run(&[case], &zeros, &mut verdict);
    verdict[0]
}

/// The two points that renderers make of a hit: from the weights of the corners, and along the ray.
pub fn hit_points<F: Float>(case: &Case<F>, verdict: &Verdict<F>) -> [[F; 3]; 2] {
    let [o, d, a, b, c] = case.vectors();
    let Verdict { t, u, v, .. } = *verdict;
    let w = F::one() - u - v;
    [
        [0, 1, 2].map(|i| w * a[i] + u * b[i] + v * c[i]),
        [0, 1, 2].map(|i| o[i] + t * d[i]),
    ]
}

/// A ray in any direction from the hit point of another one.
fn leaving<F: Scalar>(first: Shot, kernel: &Entry, dice: &mut Dice) -> Option<Shot> {
    let case = first.cases::<F>().next()?;
    let verdict = plain(kernel, case);
    let [by_weights, on_ray] = hit_points(&case, &verdict);
    let gives = kernel.info.gives;
    let point = if gives.uv && (!gives.t || dice.coin()) {
        by_weights
    } else {
        on_ray
    };
    let origin = point.map(F::to_f64);
    let is_found = verdict.hit && origin.iter().all(|x| x.is_finite());
    let direction = rounded::<F>(dice.sphere());
    is_found.then_some(Shot {
        origin,
        direction,
        ..first
    })
}

/// Where the planes of faces lie, in the words of a scene.
pub fn plane_of(mesh: &Mesh, faces: &[[Point; 3]]) -> &'static str {
    let level = |face: &[Point; 3]| {
        let flat = (0..3).find(|i| face[0][*i] == face[1][*i] && face[1][*i] == face[2][*i]);
        flat.map(|axis| (axis, face[0][axis]))
    };
    match (
        level(&faces[0]),
        faces
            .iter()
            .map(level)
            .all(|plane| plane == level(&faces[0])),
    ) {
        (Some((_, 0.0)), true) => "axis-0",
        (Some((_, at)), true) if at.abs() < 1e-3 * mesh.extent => "axis-near-0",
        (Some(_), true) => "axis",
        (Some(_), false) if faces.iter().all(|face| level(face).is_some()) => "box",
        _ => mesh.ground,
    }
}

/// The scene, in hairline's words, whose numbers are those of some rays: the extent of their mesh, the least, the median
/// and the largest size of their triangles, and their distances.
pub fn words(mesh: &Mesh, shots: &[&Shot]) -> String {
    let (of_mesh, of_rays) = words_of_rays(mesh, shots);
    format!("{of_mesh},{of_rays}")
}

/// The words of the mesh, and those of the rays: distances of the same mean and spread.
pub fn words_of_rays(mesh: &Mesh, shots: &[&Shot]) -> (String, String) {
    let size = |face: &[Point; 3]| {
        (0..3)
            .map(|i| length(minus(face[i], face[(i + 1) % 3])))
            .fold(0.0, f64::max)
    };
    let mut sizes: Vec<f64> = shots
        .iter()
        .flat_map(|shot| shot.faces.iter().map(size))
        .collect();
    sizes.sort_by(f64::total_cmp);
    let [least, median, most] = [0, sizes.len() / 2, sizes.len() - 1].map(|i| sizes[i]);
    let count = shots.len() as f64;
    let mean = shots.iter().map(|shot| shot.distance).sum::<f64>() / count;
    let spread = shots
        .iter()
        .map(|shot| (shot.distance - mean).powi(2))
        .sum::<f64>()
        / count;
    let reach = (3.0 * spread).sqrt();
    let (near, far) = ((mean - reach).max(0.0), mean + reach);
    let (extent, center, [low, high]) = (mesh.extent, mesh.center, SINES);
    (
        format!("extent={extent},center={center},edge={least}..{median}..{most}"),
        format!("distance={near}..{far},sine={low}..{high}"),
    )
}
