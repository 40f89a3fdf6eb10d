//! `mesh-edges`, `mesh-vertices`: rays at the edges and vertices of a mesh, each with the triangles
//! around it, by index. Exact rays have the target on their line, if such floats were found; near rays are
//! aimed at it by a program that rounds. The oracle says which are exact.

use super::topology::Topology;
use crate::arith::Float;
use crate::case::{Case, CaseId, Draw, Parameters, Ray, Triangle};
use crate::corpus::mesh::Mesh;
use crate::family::{self, Grouping, nudged, toward, unit_vector};
use glam::DVec3;

/// Part of the ids.
pub(super) const VERSION: u32 = 1;

named! {
    pub names
    /// The part of a mesh that rays are aimed at.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum AimedPart {
        /// The edges of two faces that are wound consistently.
        Edges = "mesh-edges",
        /// The vertices inside one closed fan.
        Vertices = "mesh-vertices",
    }
}

impl AimedPart {
    /// How the triangles of one index belong together.
    pub fn grouping(self) -> Grouping {
        match self {
            AimedPart::Edges => Grouping::SharedEdge,
            AimedPart::Vertices => Grouping::Fan,
        }
    }
}

/// How a ray is aimed: which of them follows from its number at the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aim {
    /// True if the target is to lie on its line exactly.
    pub exact: bool,
    /// True if the ray is nearly in the plane of one of the triangles; else it has any direction.
    pub grazing: bool,
}

impl Aim {
    /// The aim of the ray with a number: any four in a row have all kinds.
    pub fn of(number: u64) -> Aim {
        Aim { exact: matches!(number % 4, 0 | 3), grazing: number % 4 >= 2 }
    }
}

/// The edges and vertices of a mesh as a source of cases.
pub struct Targets<'m> {
    mesh: &'m Mesh,
    topology: &'m Topology,
    parameters: &'m Parameters,
    seed: u64,
}

impl<'m> Targets<'m> {
    /// The targets of a mesh and its topology in a scalar.
    pub fn new(
        mesh: &'m Mesh,
        topology: &'m Topology,
        parameters: &'m Parameters,
        seed: u64,
    ) -> Targets<'m> {
        Targets { mesh, topology, parameters, seed }
    }

    /// How many targets there are.
    pub fn count(&self, part: AimedPart) -> u64 {
        match part {
            AimedPart::Edges => self.topology.shared.len() as u64,
            AimedPart::Vertices => self.topology.fans.len() as u64,
        }
    }

    /// The target and the number of the ray of an index. There is a target.
    pub fn place(&self, part: AimedPart, index: u64) -> (usize, u64) {
        let count = self.count(part);
        ((index % count) as usize, index / count)
    }

    /// True if an id is of the version that [`Targets::make`] makes.
    pub fn makes(id: &CaseId) -> bool {
        id.version == VERSION
    }

    /// The points of a target, as vertices of the mesh: two ends, or one vertex.
    pub fn points(&self, part: AimedPart, target: usize) -> Vec<u32> {
        match part {
            AimedPart::Edges => self.topology.shared[target].ends.to_vec(),
            AimedPart::Vertices => vec![self.topology.fans.get(target).0],
        }
    }

    /// The triangles around a target; of a fan in their order.
    pub fn faces(&self, part: AimedPart, target: usize) -> &[u32] {
        match part {
            AimedPart::Edges => &self.topology.shared[target].faces,
            AimedPart::Vertices => self.topology.fans.get(target).1,
        }
    }

    /// A vertex's position, in `f64`, which holds every scalar exactly.
    pub fn position<F: Float>(&self, vertex: u32) -> [f64; 3] {
        self.mesh.position::<F>(vertex).map(F::to_f64)
    }

    /// Adds the cases of an index: one ray, and each triangle around its target.
    pub fn make<F: Float>(&self, part: AimedPart, index: u64, cases: &mut Vec<Case<F>>) {
        let faces = self.faces(part, self.place(part, index).0);
        let (origin, direction) = self.ray(part, index);
        let mut first = Case::new(origin, direction, self.mesh.vertices(faces[0] as usize));
        family::apply(self.parameters, &mut first);
        cases.push(first);
        cases.extend(faces[1..].iter().map(|face| self.case(&first.ray, *face)));
    }

    /// Adds the ray of an index with the triangles that share a point with one around its target; false if
    /// they are too many ([`super::MOST_AROUND`]).
    pub fn add_neighbours<F: Float>(
        &self,
        (part, index): (AimedPart, u64),
        ray: &Ray<F::Vector>,
        cases: &mut Vec<Case<F>>,
    ) -> bool {
        let group = self.faces(part, self.place(part, index).0);
        let faces = self.topology.around(&self.mesh.triangles, group);
        faces.is_some_and(|faces| {
            cases.extend(faces.iter().map(|face| self.case(ray, *face)));
            true
        })
    }

    /// A face, put through the parameters, with a ray that was.
    fn case<F: Float>(&self, ray: &Ray<F::Vector>, face: u32) -> Case<F> {
        let [a, b, c] = self.mesh.vertices(face as usize).map(F::Vector::from);
        let mut case = Case { ray: *ray, triangle: Triangle::new(a, b, c) };
        family::apply(self.parameters, &mut case);
        Case { ray: *ray, ..case }
    }

    /// The ray of an index, before the parameters.
    fn ray<F: Float>(&self, part: AimedPart, index: u64) -> ([F; 3], [F; 3]) {
        let (target, number) = self.place(part, index);
        let mut draw = Draw::new(part.name(), self.seed, index);
        let faces = self.faces(part, target);
        let points = self.points(part, target);
        let ends = [points[0], points[points.len() - 1]].map(|point| self.mesh.position(point));
        let about = self.mesh.vertices(faces[draw.below(faces.len())] as usize);
        self.ray_at(&mut draw, Aim::of(number), ends, about)
    }

    /// A ray at the segment between two points (or at one point, given twice), which belongs to a
    /// triangle: from about the triangle's size away, or from about that of the mesh.
    fn ray_at<F: Float>(
        &self,
        draw: &mut Draw,
        aim: Aim,
        ends: [[F; 3]; 2],
        triangle: [[F; 3]; 3],
    ) -> ([F; 3], [F; 3]) {
        let wide = triangle.map(|corner| DVec3::from(corner.map(F::to_f64)));
        let size = (wide[1] - wide[0]).abs().max((wide[2] - wide[0]).abs()).max_element();
        let way = if aim.grazing { grazing_direction(draw, wide) } else { any_way(draw) };
        let distance = if draw.coin() {
            self.topology.extent * (0.5 + 1.5 * draw.unit())
        } else {
            size * (1.0 + 7.0 * draw.unit())
        };
        let away = (way * distance).to_array();
        if aim.exact {
            return exact_ray(ends, away);
        }
        let [p, q] = ends.map(|end| end.map(F::to_f64));
        let s = 0.0625 + 0.875 * draw.unit();
        let target: [F; 3] = std::array::from_fn(|i| F::from_f64(p[i] + (q[i] - p[i]) * s));
        let origin: [F; 3] = std::array::from_fn(|i| F::from_f64(target[i].to_f64() - away[i]));
        let ulps = draw.pick(&[0, 0, 1, 4]);
        (origin, nudged(draw, toward(origin, target), ulps))
    }
}

/// A unit vector, rounded; every direction is as likely.
fn any_way(draw: &mut Draw) -> DVec3 {
    unit_vector(draw, 0.01)
}

/// A vector of about unit length, 2^-1 to 2^-12 off the plane of a triangle.
fn grazing_direction(draw: &mut Draw, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let any = any_way(draw);
    let tilt = 1.0 / (1u64 << draw.integer(1, 12)) as f64;
    let tilt = if draw.coin() { tilt } else { -tilt };
    // Edges of length about one, so that products neither overflow nor underflow.
    let edge = |to: DVec3| (to - a) / (to - a).abs().max_element();
    let normal = edge(b).cross(edge(c));
    let length = normal.length();
    if !(length > 0.0 && length.is_finite()) {
        return any;
    }
    let normal = normal / length;
    any - any.dot(normal) * normal + tilt * normal
}

/// A ray through the middle of a segment (or through a point given twice), from about as far away as
/// said. Where floats allow it the middle lies on its line exactly, though it need be no float itself:
/// the direction is (p - o) + (q - o).
fn exact_ray<F: Float>([p, q]: [[F; 3]; 2], away: [f64; 3]) -> ([F; 3], [F; 3]) {
    let axes: [(F, F); 3] = std::array::from_fn(|i| exact_axis(p[i], q[i], away[i]));
    (axes.map(|(origin, _)| origin), axes.map(|(_, direction)| direction))
}

/// o and d of one axis with d = (p - o) + (q - o), exactly if such were found: with o on the coarser
/// grid of p and q, and near enough for d to keep the finer one's digits.
fn exact_axis<F: Float>(p: F, q: F, away: f64) -> (F, F) {
    let (wide_p, wide_q) = (p.to_f64(), q.to_f64());
    let middle = wide_p * 0.5 + wide_q * 0.5;
    let ulps = |x: F, of_zero: f64| if x.is_zero() { of_zero } else { x.ulp().to_f64() };
    let coarse = ulps(p, 0.0).max(ulps(q, 0.0));
    let fine = ulps(p, f64::INFINITY).min(ulps(q, f64::INFINITY));
    let reach = fine * (1u64 << (F::DIGITS - 3)) as f64;
    let mut nearest = (F::zero(), F::zero());
    for away in [away, away.min(reach).max(-reach)] {
        let start = middle - away;
        let on_grid = (start / coarse).round() * coarse;
        let origin = F::from_f64(if on_grid.is_finite() { on_grid } else { start });
        let (sum, exact) = sum_of_differences(wide_p, wide_q, origin.to_f64());
        let direction = F::from_f64(sum);
        nearest = (origin, direction);
        if exact && direction.to_f64() == sum {
            break;
        }
    }
    nearest
}

/// (p - o) + (q - o), and whether no step rounded.
fn sum_of_differences(p: f64, q: f64, o: f64) -> (f64, bool) {
    let (from_p, e1) = two_sum(p, -o);
    let (from_q, e2) = two_sum(q, -o);
    let (sum, e3) = two_sum(from_p, from_q);
    (sum, e1 == 0.0 && e2 == 0.0 && e3 == 0.0)
}

/// The rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;

    fn exact<F: Float>(x: F) -> BigRational {
        BigRational::from_float(x.to_f64()).expect("finite")
    }

    /// How many of the axes of random segments have the middle on the line exactly.
    fn exact_axes<F: Float>(segment: impl Fn(&mut Draw) -> (F, F, f64)) -> usize {
        let mut draw = Draw::new("exact-axes", 1, 0);
        let is_exact = |_: &u32| {
            let (p, q, away) = segment(&mut draw);
            let (origin, direction) = exact_axis(p, q, away);
            let origin = exact(origin);
            exact(p) + exact(q) - &origin - &origin == exact(direction)
        };
        (0..1000).filter(is_exact).count()
    }

    #[test]
    fn the_middle_of_nearly_every_segment_is_on_a_ray_exactly() {
        fn near<F: Float>(draw: &mut Draw) -> (F, F, f64) {
            let p = 1.0 + draw.unit();
            let q = p + (draw.unit() - 0.5) / 16.0;
            (F::from_f64(p), F::from_f64(q), draw.unit() * 4.0 - 2.0)
        }
        assert!(exact_axes::<f32>(near) > 990);
        assert!(exact_axes::<f64>(near) > 990);
        // Of very different sizes, one of them zero, and a vertex.
        let apart = |draw: &mut Draw| {
            (draw.symmetric::<f32>(), F32_SMALL * draw.symmetric::<f32>(), draw.unit())
        };
        assert!(exact_axes::<f32>(apart) > 500);
        assert_eq!(exact_axes::<f32>(|draw| (draw.symmetric(), 0.0, draw.unit())), 1000);
        let vertex = |draw: &mut Draw| {
            let p = draw.symmetric::<f64>();
            (p, p, 2.0 * draw.unit())
        };
        assert_eq!(exact_axes::<f64>(vertex), 1000);
    }

    const F32_SMALL: f32 = 1.0 / 1024.0;

    #[test]
    fn nothing_panics_at_the_ends_of_the_range() {
        for p in [0.0f64, -0.0, 5e-324, f64::MAX, f64::MIN_POSITIVE, 1.0] {
            for q in [0.0, f64::MAX, -f64::MAX, 5e-324] {
                for away in [0.0, 1e308, f64::INFINITY, f64::NAN, -1.0] {
                    exact_axis(p, q, away);
                    exact_axis(p as f32, q as f32, away);
                }
            }
        }
    }
}
