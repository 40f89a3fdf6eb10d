//! A mesh with its tree, and the faces that a ray meets.

use crate::aabb::{Aabb, exponent_of};
use crate::build::build;
use crate::closed::{Closed, closed};
use crate::filter::are_moderate;
use crate::found::{Found, Name, Order};
use crate::fraction::Parameter;
use crate::grid::Grid;
use crate::hit::{Nearer, in_order};
use crate::mesh::{MeshError, Triangle, is_finite, triangles, widened};
use crate::query::{Numbers, Query};
use crate::ray::{InvalidRay, Ray};
use crate::slab::TreeRay;
use crate::tree::{Node, walk};
use hairline_core::Float;
use std::sync::OnceLock;

pub use crate::hit::{Hit, Nearest};

/// A mesh that rays are held against: 10^7 faces of `f32` need about 0.7 GB, and 1.5 GB while the tree is built.
///
/// A face is a closed triangle: its edges and vertices belong to it. Without area it is a segment or a point, and is met
/// like any other. A face that repeats another one is met where that is. A face with a NaN or an infinity is never met;
/// [`Scene::not_finite`] names it.
pub struct Scene<F: Float> {
    /// The finite triangles in the order of the tree's leaves.
    triangles: Vec<Triangle<F>>,
    /// The face of each of them.
    faces: Vec<u32>,
    /// The place of each face among them; [`NO_PLACE`] if it is not finite.
    places: Vec<u32>,
    not_finite: Vec<u32>,
    nodes: Vec<Node>,
    numbers: Numbers,
    /// Coordinates times 2 to this power are below 2.
    exponent: i32,
    closed: OnceLock<Closed>,
}

const NO_PLACE: u32 = u32::MAX;

impl<F: Float> Scene<F> {
    /// From vertices and the three of each face. An error if a face names a vertex that does not exist, or if there are
    /// too many faces.
    pub fn new(vertices: &[[F; 3]], faces: &[[u32; 3]]) -> Result<Scene<F>, MeshError> {
        Ok(Scene::of(&triangles(vertices, faces)?))
    }

    fn of(triangles: &[Triangle<F>]) -> Scene<F> {
        let mut finite = Vec::with_capacity(triangles.len());
        let mut not_finite = Vec::new();
        let mut grid = Grid::NONE;
        let mut moderate = true;
        let mut largest = 0.0f64;
        for (face, triangle) in triangles.iter().enumerate() {
            let wide = widened(triangle);
            if !is_finite(&wide) {
                not_finite.push(face as u32);
                continue;
            }
            finite.push(face as u32);
            let numbers = wide.as_flattened();
            grid = numbers.iter().copied().fold(grid, Grid::with);
            moderate &= are_moderate(numbers);
            largest = numbers.iter().fold(largest, |most, x| most.max(x.abs()));
        }
        let exponent = -exponent_of(largest).unwrap_or(0);
        let around = |face: &u32| Aabb::around(&widened(&triangles[*face as usize]), exponent);
        let boxes: Vec<Aabb> = finite.iter().map(around).collect();
        let (nodes, order) = build(&boxes);
        let faces: Vec<u32> = order.into_iter().map(|i| finite[i as usize]).collect();
        let mut places = vec![NO_PLACE; triangles.len()];
        for (place, face) in faces.iter().enumerate() {
            places[*face as usize] = place as u32;
        }
        let ordered = faces.iter().map(|face| triangles[*face as usize]);
        Scene {
            triangles: ordered.collect(),
            faces,
            places,
            not_finite,
            nodes,
            numbers: Numbers {
                grid,
                are_moderate: moderate,
            },
            exponent,
            closed: OnceLock::new(),
        }
    }

    /// How far the surface is closed: found out once, when it is first needed.
    pub fn closed(&self) -> &Closed {
        let triangle = |place: usize| widened(&self.triangles[place]);
        self.closed.get_or_init(|| closed(triangle, &self.faces))
    }

    /// The faces that no ray meets because a coordinate is NaN or infinite, by number.
    pub fn not_finite(&self) -> &[u32] {
        &self.not_finite
    }

    /// The faces that rays may meet, in no order: all but those of [`Scene::not_finite`].
    pub fn finite(&self) -> &[u32] {
        &self.faces
    }

    /// The vertices of a face. None if there is no such face, or if it is not finite.
    pub fn triangle(&self, face: u32) -> Option<Triangle<f64>> {
        self.place_of(face).map(|place| self.triangle_at(place))
    }

    /// The faces that a ray meets first on its interval. None if it meets no face; an error if the ray means nothing.
    pub fn nearest(&self, ray: &Ray<F>) -> Result<Option<Nearest>, InvalidRay> {
        let ray = ray.checked()?;
        let query = self.query(ray);
        let mut nearer = Nearer::NONE;
        self.visit_places(&ray, |place, triangle| {
            nearer.add(query.meet(place, triangle, nearer.least)?)
        });
        Ok(nearer.first(&self.order(&query), |place| self.face_at(place)))
    }

    /// All hits of a ray on its interval, ordered by their first t and then by their last one; exactly, whatever the bounds
    /// are. Faces with equal hits share one. An error if the ray means nothing.
    pub fn hits(&self, ray: &Ray<F>) -> Result<Vec<Hit>, InvalidRay> {
        let ray = ray.checked()?;
        let query = self.query(ray);
        let found = self.all(&ray, &query);
        Ok(in_order(found, &self.order(&query), |place| {
            self.face_at(place)
        }))
    }

    pub(crate) fn query(&self, ray: Ray<f64>) -> Query {
        Query::new(ray, self.numbers)
    }

    /// Every face that a ray meets, in no order.
    pub(crate) fn all(&self, ray: &Ray<f64>, query: &Query) -> Vec<Found> {
        let mut found = Vec::new();
        self.visit_places(ray, |place, triangle| {
            found.extend(query.meet(place, triangle, f64::INFINITY));
            None
        });
        found
    }

    /// Calls `visit` for each face whose box the ray meets, roughly from near to far; no face that the ray meets is left
    /// out. If `visit` gives a t, faces beyond it need not be visited any more. An error if the ray means nothing.
    ///
    /// The same tree for a triangle test of your own.
    #[inline(always)]
    pub fn visit(
        &self,
        ray: &Ray<F>,
        mut visit: impl FnMut(u32, &Triangle<f64>) -> Option<f64>,
    ) -> Result<(), InvalidRay> {
        let ray = ray.checked()?;
        self.visit_places(&ray, |place, triangle| visit(self.face_at(place), triangle));
        Ok(())
    }

    /// The same with a face's place in the tree.
    #[inline(always)]
    fn visit_places(
        &self,
        ray: &Ray<f64>,
        mut visit: impl FnMut(u32, &Triangle<f64>) -> Option<f64>,
    ) {
        let mut ray = TreeRay::new(ray, self.exponent);
        walk(&self.nodes, &mut ray, |place| {
            visit(place, &self.triangle_at(place))
        });
    }

    #[inline(always)]
    pub(crate) fn triangle_at(&self, place: u32) -> Triangle<f64> {
        widened(&self.triangles[place as usize])
    }

    /// None if there is no such face, or if it is not finite.
    pub(crate) fn place_of(&self, face: u32) -> Option<u32> {
        let place = self.places.get(face as usize).copied();
        place.filter(|place| *place != NO_PLACE)
    }

    /// The finite triangles in the order of their faces.
    pub(crate) fn in_order_of_faces(&self) -> Vec<Triangle<F>> {
        let places = self.places.iter().filter(|place| **place != NO_PLACE);
        places
            .map(|place| self.triangles[*place as usize])
            .collect()
    }

    /// How many faces are finite: their places are the numbers below.
    pub(crate) fn face_count(&self) -> u32 {
        self.faces.len() as u32
    }

    /// A node of the tree; there is a first one if there is a face.
    pub(crate) fn node(&self, place: usize) -> &Node {
        &self.nodes[place]
    }

    /// Boxes of the tree are those of coordinates times 2 to this power.
    pub(crate) fn exponent(&self) -> i32 {
        self.exponent
    }

    pub(crate) fn face_at(&self, place: u32) -> u32 {
        self.faces[place as usize]
    }

    pub(crate) fn order<'a>(
        &'a self,
        query: &'a Query,
    ) -> Order<impl Fn(u32) -> Parameter + 'a, impl Fn(&Found) -> Option<Name> + 'a> {
        Order {
            crossing: |place| query.exact.crossing(&self.triangle_at(place)),
            name: |found: &Found| found.name(&self.triangle_at(found.place)),
        }
    }
}
