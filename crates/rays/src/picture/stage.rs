//! All that is shown of an answer, placed in the region of its picture.

use super::marks::{self, Kind};
use super::sight::{Asked, Sight, Spot};
use super::space::{Region, Scale, direction_of, longest_edge, nearest_point};
use super::view::{View, Wished};
use crate::arith::Float;
use glam::DVec3;
use hairline_scene::{Ray, Scene};

/// An answered point is shown if it is nearer than so many longest edges, or than the mesh is large.
const NEAR: f64 = 50.0;

/// The ray's start is shown if it is not farther away than so many radii of the region.
const START: f64 = 2.0;

/// The mesh is shown to so many edges from the points.
const AROUND: f64 = 1.0;

/// A ray is drawn to so many radii of the region.
const FAR: f64 = 20.0;

/// A label names so many faces.
const NAMED: usize = 3;

/// The region of a picture, and what is placed there.
pub(super) struct Stage {
    pub region: Region,
    /// The points that the picture is about, the exact point first.
    points: Vec<DVec3>,
    /// A point of the ray: the exact one, if there is one.
    anchor: DVec3,
    /// True if an answered point is too far away to be shown.
    pub is_outside: bool,
    along: DVec3,
    margin: f64,
    /// The start of the ray, or the point; none if it is not near.
    start: Option<DVec3>,
    placed: Vec<Placed>,
}

/// A spot in the region.
struct Placed {
    kind: Kind,
    faces: Vec<u32>,
    corners: Vec<[DVec3; 3]>,
    point: Option<DVec3>,
}

impl Placed {
    /// The spot in the scale.
    fn new<F: Float>(scene: &Scene<F>, scale: &Scale, kind: Kind, spot: &Spot) -> Placed {
        let triangles = spot.faces.iter().filter_map(|face| scene.triangle(*face));
        let point = spot.point.map(|point| scale.place(point));
        Placed {
            kind,
            faces: spot.faces.clone(),
            corners: triangles
                .map(|triangle| triangle.map(|corner| scale.place(corner)))
                .collect(),
            point: point.filter(|point| point.is_finite()),
        }
    }

    /// The points that have to be seen: the hit, and where the face is nearest to it; or else the face.
    fn points(&self) -> Vec<DVec3> {
        match (self.point, self.corners.first()) {
            (Some(point), Some(corners)) => vec![point, nearest_point(*corners, point)],
            (Some(point), None) => vec![point],
            (None, Some(corners)) => corners.to_vec(),
            (None, None) => Vec::new(),
        }
    }

    /// The same in the region.
    fn within(self, region: &Region) -> Placed {
        let place = |point: DVec3| region.place_scaled(point);
        let corners = self.corners.into_iter();
        Placed {
            corners: corners.map(|corners| corners.map(place)).collect(),
            point: self.point.map(place),
            ..self
        }
    }

    fn middle_of_face(&self) -> Option<DVec3> {
        let corners = self.corners.first();
        corners.map(|[a, b, c]| (*a + *b + *c) / 3.0)
    }

    /// The point, or else the middle of the face.
    fn middle(&self) -> Option<DVec3> {
        self.point.or_else(|| self.middle_of_face())
    }

    /// The place of the label: the point, or the middle of a face that lies elsewhere.
    fn label_at(&self) -> Option<DVec3> {
        let is_on_face = |point: &DVec3| {
            let corners = self.corners.first();
            corners.is_none_or(|corners| {
                nearest_point(*corners, *point).distance(*point) <= longest_edge(*corners)
            })
        };
        self.point
            .filter(is_on_face)
            .or_else(|| self.middle_of_face())
    }

    fn label(&self, lead: &str) -> String {
        let named = self.faces.iter().take(NAMED);
        let numbers: Vec<String> = named.map(u32::to_string).collect();
        let more = match NAMED < self.faces.len() {
            true => " …",
            false => "",
        };
        let noun = match self.faces.len() {
            1 => "face",
            _ => "faces",
        };
        format!("{lead}: {noun} {}{more}", numbers.join(", "))
    }
}

impl Stage {
    /// Places all that a picture shows. None if the mesh has no finite face.
    pub fn of<F: Float>(scene: &Scene<F>, sight: &Sight) -> Option<Stage> {
        if scene.finite().is_empty() {
            return None;
        }
        let scale = scale_of(scene, sight);
        let mut placed = placed_in(&scale, scene, sight);
        let margin = margin_of(&placed);
        let is_outside = leave_out_far_points(&mut placed, margin, || size_of(scene, &scale));
        let mut points: Vec<DVec3> = placed.iter().flat_map(Placed::points).collect();
        if let Some(triangle) = sight.passed.and_then(|face| scene.triangle(face)) {
            points.extend(triangle.map(|corner| scale.place(corner)));
        }
        let marked = placed.iter().find_map(|spot| spot.point);
        let anchor = match sight.asked {
            Asked::Point(point) => scale.place(point),
            Asked::Ray(ray) => marked.unwrap_or_else(|| nearest_of_ray(&scale, &ray, &points)),
        };
        points.push(anchor);
        let along = match sight.asked {
            Asked::Ray(ray) => direction_of(ray.direction),
            Asked::Point(_) => {
                let way = marked.map_or(DVec3::ZERO, |marked| marked - anchor);
                direction_of(way.to_array())
            }
        };
        let start = match sight.asked {
            Asked::Ray(ray) => ray.origin,
            Asked::Point(point) => point,
        };
        let region = Region::around(scale, &points, margin);
        let points = points.iter().map(|point| region.place_scaled(*point));
        Some(Stage {
            points: points.collect(),
            anchor: region.place_scaled(anchor),
            is_outside,
            along,
            margin: region.length(AROUND * margin),
            start: region.place(start),
            placed: placed.into_iter().map(|it| it.within(&region)).collect(),
            region,
        })
    }

    /// The wishes to the view.
    pub fn wished(&self) -> Wished {
        let start = self.start.filter(|start| start.length() < START);
        let faces = self.placed.iter().filter_map(|spot| spot.corners.first());
        Wished {
            along: self.along,
            anchor: self.anchor,
            points: self.points.iter().copied().chain(start).collect(),
            faces: faces.copied().collect(),
            margin: self.margin,
        }
    }

    /// The elements of the ray, of points and of faces, with labels.
    pub fn marks(&self, view: &View, sight: &Sight) -> String {
        let mut elements = String::new();
        for spot in self.placed.iter().rev() {
            for corners in &spot.corners {
                elements += &marks::face(view, spot.kind, corners);
            }
        }
        elements += &match sight.asked {
            Asked::Ray(ray) => marks::ray(view, self.ends(&ray), true),
            Asked::Point(_) => {
                let ends = self.start.zip(self.placed.first().and_then(|it| it.point));
                ends.map_or(String::new(), |(from, to)| {
                    marks::ray(view, [from, to], false)
                })
            }
        };
        if let Some(start) = self.start {
            elements += &marks::start(view, start);
        }
        for spot in self.placed.iter().rev() {
            if let Some(point) = spot.point {
                elements += &marks::point(view, spot.kind, point);
            }
        }
        let exact = match sight.asked {
            Asked::Ray(_) => "exact",
            Asked::Point(_) => "nearest",
        };
        for (kind, lead) in [(Kind::Answered, "answer"), (Kind::Exact, exact)] {
            let first = self.placed.iter().find(|spot| spot.kind == kind);
            if let Some((spot, middle)) = first.and_then(|spot| Some((spot, spot.label_at()?))) {
                elements += &marks::label(view, kind, middle, &spot.label(lead));
            }
        }
        elements
    }

    /// The ends of the ray's interval, not far outside the region.
    fn ends(&self, ray: &Ray<f64>) -> [DVec3; 2] {
        let along = |t: f64, beyond: f64| {
            let point = [0, 1, 2].map(|axis| ray.origin[axis] + t * ray.direction[axis]);
            let placed = self.region.place(point);
            let along = placed.map(|point| (point - self.anchor).dot(self.along));
            along.unwrap_or(beyond).clamp(-FAR, FAR)
        };
        let ends = [along(ray.t_min, -FAR), along(ray.t_max, FAR)];
        ends.map(|end| self.anchor + end * self.along)
    }
}

/// The scale of the faces and exact points that are shown; without an exact point of the ray's start too.
fn scale_of<F: Float>(scene: &Scene<F>, sight: &Sight) -> Scale {
    let spots = sight.exact.iter().chain(&sight.answered);
    let faces = spots.flat_map(|spot| &spot.faces).chain(&sight.passed);
    let corners = faces.filter_map(|face| scene.triangle(*face)).flatten();
    let exact = sight.exact.iter().filter_map(|spot| spot.point);
    let start = match sight.asked {
        Asked::Point(point) => Some(point),
        Asked::Ray(ray) => Some(ray.origin).filter(|_| sight.exact.is_empty()),
    };
    Scale::of(corners.chain(exact).chain(start))
}

/// The spots in a scale.
fn placed_in<F: Float>(scale: &Scale, scene: &Scene<F>, sight: &Sight) -> Vec<Placed> {
    let mut placed = Vec::new();
    for spot in &sight.exact {
        placed.push(Placed::new(scene, scale, Kind::Exact, spot));
    }
    for spot in &sight.answered {
        placed.push(Placed::new(scene, scale, Kind::Answered, spot));
    }
    if let Asked::Point(point) = sight.asked {
        for spot in &mut placed {
            let corners = spot.corners.first();
            spot.point = corners.map(|corners| nearest_point(*corners, scale.place(point)));
        }
    }
    placed
}

/// The length of the shortest of the spots' longest edges; 0 if no face is longer.
fn margin_of(placed: &[Placed]) -> f64 {
    let corners = placed.iter().filter_map(|spot| spot.corners.first());
    let edges = corners.map(|corners| longest_edge(*corners));
    let shortest = edges.filter(|edge| 0.0 < *edge).min_by(f64::total_cmp);
    shortest.unwrap_or(0.0)
}

/// The point of a ray that is nearest to the first of some points.
fn nearest_of_ray(scale: &Scale, ray: &Ray<f64>, points: &[DVec3]) -> DVec3 {
    let origin = scale.place(ray.origin);
    let direction = direction_of(ray.direction);
    let to = points.first().map_or(DVec3::ZERO, |point| *point - origin);
    origin + to.dot(direction).max(0.0) * direction
}

/// Leaves out answered points that are too far away to be shown with the others. Returns true if there are any.
fn leave_out_far_points(placed: &mut [Placed], margin: f64, size: impl Fn() -> f64) -> bool {
    let exact = placed.iter().find(|spot| spot.kind == Kind::Exact);
    let of_face = || placed.first().and_then(Placed::middle_of_face);
    let Some(centre) = exact.and_then(Placed::middle).or_else(of_face) else {
        return false;
    };
    let mut is_any = false;
    for spot in placed.iter_mut().filter(|spot| spot.kind == Kind::Answered) {
        let is_far = |point: DVec3| {
            let distance = point.distance(centre);
            NEAR * margin < distance && size() < distance
        };
        if spot.point.is_some_and(is_far) {
            spot.point = None;
            is_any = true;
        }
    }
    is_any
}

/// The size of the mesh in a scale.
fn size_of<F: Float>(scene: &Scene<F>, scale: &Scale) -> f64 {
    let mut min = DVec3::INFINITY;
    let mut max = DVec3::NEG_INFINITY;
    for corner in scene
        .finite()
        .iter()
        .filter_map(|face| scene.triangle(*face))
        .flatten()
    {
        let point = scale.place(corner);
        min = min.min(point);
        max = max.max(point);
    }
    min.distance(max)
}
