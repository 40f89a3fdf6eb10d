//! `mesh-edges`, `mesh-vertices`: rays at the edges and vertices of a mesh, each with the triangles
//! around it, by index. Exact rays have the target on their line, if such floats were found; near rays are
//! aimed at it by a program that rounds. The oracle says which are exact.

use super::topology::Topology;
use crate::arith::Float;
use crate::case::{Case, CaseId, Draw, Parameters, Ray, Triangle};
use crate::family::{
    self, Grouping, draw_interval, either_sign, exact_ray, nudged, rounded, toward, unit_vector,
    wide,
};
use crate::files::mesh::Mesh;
use glam::DVec3;
use std::slice;

/// Part of the ids.
pub(super) const VERSION: u32 = 2;

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

/// How a ray is aimed, which follows from its number at the target.
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
        Aim {
            exact: matches!(number % 4, 0 | 3),
            grazing: number % 4 >= 2,
        }
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
        Targets {
            mesh,
            topology,
            parameters,
            seed,
        }
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

    /// Adds the cases of an index: one ray with its interval, and each triangle around its target.
    pub fn make<F: Float>(&self, part: AimedPart, index: u64, cases: &mut Vec<Case<F>>) {
        let (target, _) = self.place(part, index);
        let (first_face, other_faces) = self.faces(part, target).split_first().expect("a face");
        let mut draw = Draw::new(part.name(), self.seed, index);
        let (origin, direction) = self.ray(part, index, &mut draw);
        let triangle = self.mesh.vertices(*first_face as usize);
        let mut first = Case::new(origin, direction, triangle);
        family::apply(self.parameters, &mut first);
        draw_interval(part.grouping(), &mut draw, slice::from_mut(&mut first));
        cases.push(first);
        for face in other_faces {
            cases.push(self.case(&first.ray, *face));
        }
    }

    /// Adds the ray of an index with the triangles that share a point with one around its target; false if
    /// they are too many ([`super::MOST_AROUND`]).
    pub fn add_neighbours<F: Float>(
        &self,
        (part, index): (AimedPart, u64),
        ray: &Ray<F::Vector>,
        cases: &mut Vec<Case<F>>,
    ) -> bool {
        let (target, _) = self.place(part, index);
        let group = self.faces(part, target);
        let Some(faces) = self.topology.around(&self.mesh.triangles, group) else {
            return false;
        };
        for face in faces {
            cases.push(self.case(ray, face));
        }
        true
    }

    /// A face, put through the parameters, with a ray that has been through them.
    fn case<F: Float>(&self, ray: &Ray<F::Vector>, face: u32) -> Case<F> {
        let [a, b, c] = self.mesh.vertices(face as usize).map(F::Vector::from);
        let mut case = Case {
            ray: *ray,
            triangle: Triangle::new(a, b, c),
        };
        family::apply(self.parameters, &mut case);
        Case { ray: *ray, ..case }
    }

    /// The ray of an index, before the parameters.
    fn ray<F: Float>(&self, part: AimedPart, index: u64, draw: &mut Draw) -> ([F; 3], [F; 3]) {
        let (target, number) = self.place(part, index);
        let face = draw.pick(self.faces(part, target));
        let triangle = self.mesh.vertices(face as usize);
        let points = self.points(part, target);
        let ends = [points[0], points[points.len() - 1]].map(|point| self.mesh.position(point));
        self.ray_at(draw, Aim::of(number), ends, triangle)
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
        let [a, b, c] = triangle.map(wide);
        let size = (b - a).abs().max((c - a).abs()).max_element();
        let way = if aim.grazing {
            grazing_direction(draw, [a, b, c])
        } else {
            any_way(draw)
        };
        let distance = if draw.coin() {
            self.topology.extent * (0.5 + 1.5 * draw.unit())
        } else {
            size * (1.0 + 7.0 * draw.unit())
        };
        let away = way * distance;
        if aim.exact {
            return exact_ray(ends, away.to_array());
        }
        let [p, q] = ends.map(wide);
        let s = 0.0625 + 0.875 * draw.unit();
        let target: [F; 3] = rounded(p + (q - p) * s);
        let origin = rounded(wide(target) - away);
        let ulps = draw.pick(&[0, 0, 1, 4]);
        let direction = nudged(draw, toward(origin, target), ulps);
        (origin, direction)
    }
}

/// A unit vector, rounded; every direction is as likely.
fn any_way(draw: &mut Draw) -> DVec3 {
    unit_vector(draw, 0.01)
}

/// A vector of about unit length, 2^-1 to 2^-12 off the plane of a triangle.
fn grazing_direction(draw: &mut Draw, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let any = any_way(draw);
    let sine = 1.0 / (1u64 << draw.integer(1, 12)) as f64;
    let tilt = either_sign(draw, sine);
    // Edges of length about one, so that products neither overflow nor underflow.
    let [ab, ac] = [b - a, c - a].map(|edge| edge / edge.abs().max_element());
    let cross = ab.cross(ac);
    let length = cross.length();
    let has_area = 0.0 < length && length.is_finite();
    if !has_area {
        return any;
    }
    let normal = cross / length;
    any - any.dot(normal) * normal + tilt * normal
}
