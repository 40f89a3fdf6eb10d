//! A mesh as a scene: its faces, shared edges and closed fans, each as likely as the others, in place of
//! triangles drawn from numbers.

use super::surface::Surface;
use super::topology::{SharedEdge, Topology};
use crate::arith::{Float, three_digits};
use crate::case::{Case, DirectionLength, Draw, Parameters, Ray, Scene, Triangle};
use crate::family::{
    CaseGroup, Corners, Pair, Parallel, RayAxes, Ring, Stratum, TriangleSource, along_axis, circle,
    flat_along, in_plane, rounded, wide,
};
use crate::files::is_without_area;
use crate::kernel::Scalar;
use glam::DVec3;

/// A mesh whose strata are those of a scene.
pub struct SceneMesh {
    surface: Surface,
    /// The faces with an area, in `f32` and in `f64`.
    faces: [Vec<u32>; 2],
}

/// How many faces are tried for one to which some direction is exactly parallel.
const TRIES: usize = 64;

impl SceneMesh {
    /// In the scalars of the surface.
    pub fn new(surface: Surface) -> SceneMesh {
        let faces = [
            faces_with_area::<f32>(&surface),
            faces_with_area::<f64>(&surface),
        ];
        SceneMesh { surface, faces }
    }

    /// The mesh and its topology.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How many faces have an area in a scalar.
    pub fn face_count<F: Float>(&self) -> usize {
        self.faces_of::<F>().len()
    }

    fn faces_of<F: Float>(&self) -> &[u32] {
        &self.faces[usize::from(F::NAME == f64::NAME)]
    }

    /// The mesh in the numbers of a scene: rays start up to the diagonal of its box away. The numbers have
    /// three digits, rounded outwards.
    pub fn scene(&self) -> Scene {
        let mesh = self.surface.mesh();
        let faces = if self.faces[1].is_empty() {
            &self.faces[0]
        } else {
            &self.faces[1]
        };
        let mut edge = [f64::INFINITY, 0.0f64];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for face in faces {
            let corners = mesh.vertices::<f64>(*face as usize);
            let size = longest_edge(corners);
            edge = [edge[0].min(size), edge[1].max(size)];
            for corner in corners.map(DVec3::from) {
                (low, high) = (low.min(corner), high.max(corner));
            }
        }
        Scene {
            extent: three_digits(low.abs().max(high.abs()).max_element(), true),
            center: 0.0,
            edge: [three_digits(edge[0], false), three_digits(edge[1], true)],
            distance: [0.0, three_digits((high - low).length(), true)],
            ..Scene::default()
        }
    }

    /// Twice the area of the smallest face in a scalar.
    pub fn least_shape<F: Float>(&self) -> f64 {
        let mesh = self.surface.mesh();
        let shape = |face: &u32| {
            let [a, b, c] = mesh.vertices::<F>(*face as usize).map(wide);
            (b - a).cross(c - a).length()
        };
        self.faces_of::<F>()
            .iter()
            .map(shape)
            .fold(f64::INFINITY, f64::min)
    }

    /// How many of so many indices of a stratum there are: none if the mesh has nothing to aim at.
    pub fn count<F: Float>(&self, stratum: Stratum, count: u64) -> u64 {
        let topology = self.surface.topology::<F>();
        let is_empty = match stratum {
            Stratum::Edges => topology.is_none_or(|topology| topology.shared.is_empty()),
            Stratum::Vertices => topology.is_none_or(|topology| topology.fans.is_empty()),
            _ => self.faces_of::<F>().is_empty(),
        };
        if is_empty { 0 } else { count }
    }

    /// Case `index` of a stratum; there is something to aim at.
    pub fn make<F: Scalar>(
        &self,
        stratum: Stratum,
        parameters: &Parameters,
        seed: u64,
        index: u64,
    ) -> CaseGroup<F> {
        let scene = parameters.scene.clone().unwrap_or_default();
        stratum.make_at(&self.triangles::<F>(&scene), parameters, seed, index)
    }

    /// Adds the triangles that share a point with one of a stratum's group, with a ray; false if they are too many
    /// ([`super::MOST_AROUND`]), or if the stratum has no groups. The numbers are those from which the group is drawn,
    /// before anything else.
    pub fn add_neighbours<F: Float>(
        &self,
        stratum: Stratum,
        draw: &mut Draw,
        ray: &Ray<F::Vector>,
        cases: &mut Vec<Case<F>>,
    ) -> bool {
        let topology = self.surface.topology::<F>().expect("a scalar of the run");
        let group = match stratum {
            Stratum::Edges => &any_edge(topology, draw).faces,
            Stratum::Vertices => any_fan(topology, draw).1,
            _ => return false,
        };
        let mesh = self.surface.mesh();
        let Some(faces) = topology.around(&mesh.triangles, group) else {
            return false;
        };
        for face in faces {
            let [a, b, c] = mesh.vertices(face as usize).map(F::Vector::from);
            cases.push(Case {
                ray: *ray,
                triangle: Triangle::new(a, b, c),
            });
        }
        true
    }

    /// Its triangles, for rays of a scene.
    pub fn triangles<'a, F: Float>(
        &'a self,
        scene: &'a Scene,
    ) -> impl TriangleSource<F> + use<'a, F> {
        let topology = self.surface.topology::<F>().expect("a scalar of the run");
        OfMesh {
            mesh: self,
            topology,
            scene,
        }
    }
}

/// The faces whose area and normal can be computed.
fn faces_with_area<F: Float>(surface: &Surface) -> Vec<u32> {
    let mesh = surface.mesh();
    let has_area = |face: &u32| {
        let corners = mesh.vertices::<F>(*face as usize);
        let is_finite = corners.as_flattened().iter().all(|x| x.is_finite());
        is_finite
            && RayAxes::of(corners).is_some()
            && !is_without_area(corners.map(|corner| wide(corner).to_array()))
    };
    match surface.topology::<F>() {
        Some(_) => (0..mesh.triangles.len() as u32).filter(has_area).collect(),
        None => Vec::new(),
    }
}

/// An edge of two faces; there is one.
fn any_edge<'t>(topology: &'t Topology, draw: &mut Draw) -> &'t SharedEdge {
    &topology.shared[draw.below(topology.shared.len())]
}

/// The centre and the faces of a closed fan; there is one.
fn any_fan<'t>(topology: &'t Topology, draw: &mut Draw) -> (u32, &'t [u32]) {
    topology.fans.get(draw.below(topology.fans.len()))
}

fn longest_edge<F: Float>(corners: Corners<F>) -> f64 {
    let [a, b, c] = corners.map(wide);
    (b - a).length().max((c - b).length()).max((a - c).length())
}

/// The triangles of a mesh in a scalar.
struct OfMesh<'a> {
    mesh: &'a SceneMesh,
    topology: &'a Topology,
    scene: &'a Scene,
}

impl OfMesh<'_> {
    fn any_face<F: Float>(&self, draw: &mut Draw) -> Corners<F> {
        let faces = self.mesh.faces_of::<F>();
        self.corners(faces[draw.below(faces.len())])
    }

    /// Faces as they stand in the file.
    fn corners<F: Float>(&self, face: u32) -> Corners<F> {
        self.mesh.surface.mesh().vertices(face as usize)
    }
}

impl<F: Float> TriangleSource<F> for OfMesh<'_> {
    fn triangle(&self, draw: &mut Draw) -> (Corners<F>, RayAxes) {
        let triangle = self.any_face(draw);
        (
            triangle,
            RayAxes::of(triangle).expect("faces without a normal are left out"),
        )
    }

    fn pair(&self, draw: &mut Draw) -> Pair<F> {
        let edge = any_edge(self.topology, draw);
        let ends = edge
            .ends
            .map(|point| self.mesh.surface.mesh().position(point));
        Pair {
            ends,
            triangles: edge.faces.map(|face| self.corners(face)),
        }
    }

    fn fan(&self, draw: &mut Draw) -> Ring<F> {
        let (center, faces) = any_fan(self.topology, draw);
        let triangles = faces.iter().map(|face| self.corners(*face)).collect();
        Ring {
            center: self.mesh.surface.mesh().position(center),
            triangles,
        }
    }

    fn parallel(&self, draw: &mut Draw) -> Parallel<F> {
        let found = (0..TRIES).find_map(|_| {
            let triangle = self.any_face(draw);
            Some((triangle, exactly_parallel(draw, triangle, self.scene)?))
        });
        let (triangle, direction) = found.unwrap_or_else(|| {
            // A rounded one, which the oracle keeps only if it is exact by chance.
            let (triangle, frame) = self.triangle(draw);
            (triangle, rounded(in_plane(draw, &frame)))
        });
        Parallel {
            triangle,
            direction,
            size: longest_edge(triangle),
        }
    }
}

/// A direction exactly parallel to a triangle: along an axis where an edge is, in the plane of two axes
/// where the triangle is, and, if directions may have any length, along an edge that is a difference of its
/// ends without rounding.
fn exactly_parallel<F: Float>(
    draw: &mut Draw,
    triangle: Corners<F>,
    scene: &Scene,
) -> Option<[F; 3]> {
    let mut made: Vec<[F; 3]> = Vec::new();
    for i in 0..3 {
        let (p, q) = (triangle[i], triangle[(i + 1) % 3]);
        let moved: Vec<usize> = (0..3).filter(|axis| p[*axis] != q[*axis]).collect();
        if let [axis] = moved[..] {
            made.push(along_axis(draw, scene, axis));
        }
        if scene.direction == DirectionLength::Target {
            let edge: [F; 3] = std::array::from_fn(|axis| q[axis] - p[axis]);
            let is_exact =
                |axis: usize| p[axis] + edge[axis] == q[axis] && q[axis] - edge[axis] == p[axis];
            made.extend((0..3).all(is_exact).then_some(edge));
        }
    }
    let [a, b, c] = triangle;
    for axis in 0..3 {
        if a[axis] == b[axis] && b[axis] == c[axis] {
            let ([x, y], length) = circle(draw);
            let mut flat = DVec3::ZERO;
            (flat[(axis + 1) % 3], flat[(axis + 2) % 3]) = (x, y);
            made.push(flat_along(draw, scene, flat / length));
        }
    }
    (!made.is_empty()).then(|| made[draw.below(made.len())])
}
