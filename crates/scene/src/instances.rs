//! Meshes that matrices put into the world, with one tree over all their faces.

use crate::aabb::{Aabb, exponent_of};
use crate::build::build;
use crate::found::{Common, Found, Name, Order};
use crate::fraction::Parameter;
use crate::grid::Grid;
use crate::hit::{Hit, Nearer, Nearest, in_order};
use crate::instance::{Instance, InstanceError, PlacedFace, WrongInstance};
use crate::mesh::{Triangle, is_finite, widened};
use crate::placed::Placed;
use crate::query::{Numbers, Query};
use crate::ray::{InvalidRay, Ray};
use crate::rounded::rounded;
use crate::slab::TreeRay;
use crate::tree::{Node, walk};
use hairline_core::Float;
use num_rational::BigRational;

/// A scene of instances. Its answers are those of the exactly transformed vertices, which need not be floats.
///
/// ```
/// use hairline_scene::{Instance, Instances, PlacedFace, Ray, triangles};
///
/// let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let mesh = triangles(&vertices, &[[0, 1, 2]]).unwrap();
/// // A tenth as large, at z = 0 and at z = 0.1.
/// let at = |z: f64| [[0.1, 0.0, 0.0, 0.0], [0.0, 0.1, 0.0, 0.0], [0.0, 0.0, 0.1, z]];
/// let instances = [0.0, 0.1].map(|z| Instance { mesh: 0, matrix: at(z) });
/// let scene = Instances::new(vec![mesh], &instances).unwrap();
/// let ray = Ray::new([0.025, 0.025, 1.0], [0.0, 0.0, -1.0]);
/// let nearest = scene.nearest(&ray).unwrap().unwrap();
/// assert_eq!(nearest.faces, [PlacedFace { instance: 1, face: 0 }]);
/// ```
pub struct Instances<F: Float> {
    meshes: Vec<Vec<Triangle<F>>>,
    instances: Vec<(u32, Placed)>,
    /// The finite faces in the order of the tree's leaves.
    faces: Vec<PlacedFace>,
    nodes: Vec<Node>,
    exponent: i32,
}

impl<F: Float> Instances<F> {
    /// From meshes, each with its triangles, and instances of them. A face with a NaN or an infinity is never met.
    pub fn new(
        meshes: Vec<Vec<Triangle<F>>>,
        instances: &[Instance<F>],
    ) -> Result<Instances<F>, InstanceError> {
        let mut placed = Vec::with_capacity(instances.len());
        let mut faces = Vec::new();
        let mut largest = 0.0f64;
        for (number, instance) in (0..).zip(instances) {
            let wrong = |kind| InstanceError {
                instance: number,
                kind,
            };
            let mesh = meshes.get(instance.mesh as usize);
            let mesh = mesh.ok_or(wrong(WrongInstance::NoSuchMesh))?;
            let matrix = instance.matrix.map(|row| row.map(F::to_f64));
            if !matrix.as_flattened().iter().all(|x| x.is_finite()) {
                return Err(wrong(WrongInstance::NotFinite));
            }
            let finite = || {
                (0..)
                    .zip(mesh.iter().map(widened))
                    .filter(|it| is_finite(&it.1))
            };
            let in_world = Placed::new(matrix, finite().map(|(_, triangle)| triangle));
            let in_world = in_world.ok_or(wrong(WrongInstance::TooLarge))?;
            largest = largest.max(in_world.largest());
            placed.push((instance.mesh, in_world));
            faces.extend(finite().map(|(face, _)| PlacedFace {
                instance: number,
                face,
            }));
            // Places in the tree have u32 as their numbers.
            if u32::MAX as usize <= faces.len() {
                return Err(wrong(WrongInstance::TooManyFaces));
            }
        }
        let mut scene = Instances {
            meshes,
            instances: placed,
            faces,
            nodes: Vec::new(),
            exponent: -exponent_of(largest).unwrap_or(0),
        };
        let around = |face: &PlacedFace| {
            let (placed, triangle) = scene.of(*face);
            placed.around(&triangle, scene.exponent)
        };
        let boxes: Vec<Aabb> = scene.faces.iter().map(around).collect();
        let (nodes, order) = build(&boxes);
        let in_leaves = order.into_iter().map(|i| scene.faces[i as usize]);
        (scene.faces, scene.nodes) = (in_leaves.collect(), nodes);
        Ok(scene)
    }

    /// The faces that a ray meets first on its interval. None if it meets no face; an error if the ray means nothing.
    pub fn nearest(&self, ray: &Ray<F>) -> Result<Option<Nearest<PlacedFace>>, InvalidRay> {
        let query = query(ray)?;
        let mut nearer = Nearer::NONE;
        self.visit(&query, |place| {
            nearer.add(self.meet(&query, place, nearer.least)?)
        });
        Ok(nearer.first(&self.order(&query), |place| self.faces[place as usize]))
    }

    /// All hits of a ray on its interval, ordered by their first t and then by their last one, exactly. Faces with equal hits
    /// share one. An error if the ray means nothing.
    pub fn hits(&self, ray: &Ray<F>) -> Result<Vec<Hit<PlacedFace>>, InvalidRay> {
        let query = query(ray)?;
        let mut found = Vec::new();
        self.visit(&query, |place| {
            found.extend(self.meet(&query, place, f64::INFINITY));
            None
        });
        Ok(in_order(found, &self.order(&query), |place| {
            self.faces[place as usize]
        }))
    }

    /// The exact first and last t of a face's hit. None if the ray does not meet the face; an error if the ray means nothing.
    pub fn fractions(
        &self,
        ray: &Ray<F>,
        face: PlacedFace,
    ) -> Result<Option<[BigRational; 2]>, InvalidRay> {
        let query = query(ray)?;
        let exists = self
            .instances
            .get(face.instance as usize)
            .is_some_and(|of| {
                let mesh = &self.meshes[of.0 as usize];
                let triangle = mesh.get(face.face as usize);
                triangle.is_some_and(|triangle| is_finite(&widened(triangle)))
            });
        let ends = exists.then(|| self.ends(&query, face)).flatten();
        Ok(ends.map(|(_, ends)| {
            let exact = ends.map(|end| end.rational());
            exact.map(|t| t.expect("a common point is finite"))
        }))
    }

    /// The same as the nearest doubles.
    pub fn t(&self, ray: &Ray<F>, face: PlacedFace) -> Result<Option<[f64; 2]>, InvalidRay> {
        let exact = self.fractions(ray, face)?;
        Ok(exact.map(|ends| ends.each_ref().map(rounded)))
    }

    fn of(&self, face: PlacedFace) -> (&Placed, Triangle<f64>) {
        let (mesh, placed) = &self.instances[face.instance as usize];
        let triangle = &self.meshes[*mesh as usize][face.face as usize];
        (placed, widened(triangle))
    }

    fn visit(&self, query: &Query, visit: impl FnMut(u32) -> Option<f64>) {
        let mut ray = TreeRay::new(&query.ray, self.exponent);
        walk(&self.nodes, &mut ray, visit);
    }

    /// The common points of a ray and the face at a place. None also if they lie surely beyond a t.
    fn meet(&self, query: &Query, place: u32, beyond: f64) -> Option<Found> {
        let face = self.faces[place as usize];
        let exactly = || {
            let (common, ends) = self.ends(query, face)?;
            let found = Found::between(place, common, ends);
            (found.from.lower <= beyond).then_some(found)
        };
        let (placed, triangle) = self.of(face);
        match placed.more() {
            Some(more) => query.meet_or(place, &placed.rounded(&triangle), more, beyond, exactly),
            None => exactly(),
        }
    }

    /// The common points of a ray and a face, exactly.
    fn ends(&self, query: &Query, face: PlacedFace) -> Option<(Common, [Parameter; 2])> {
        let (placed, triangle) = self.of(face);
        let meeting = query.exact.meet(placed.exact(&triangle))?;
        query.on_interval(meeting)
    }

    fn order<'a>(
        &'a self,
        query: &'a Query,
    ) -> Order<impl Fn(u32) -> Parameter + 'a, impl Fn(&Found) -> Option<Name> + 'a> {
        Order {
            crossing: |place| {
                let ends = self.ends(query, self.faces[place as usize]);
                let (_, [t, _]) = ends.expect("a face that is met");
                t
            },
            name: |_: &Found| None,
        }
    }
}

fn query<F: Float>(ray: &Ray<F>) -> Result<Query, InvalidRay> {
    let of_instances = Numbers {
        grid: Grid::NONE,
        are_moderate: true,
    };
    Ok(Query::new(ray.checked()?, of_instances))
}
