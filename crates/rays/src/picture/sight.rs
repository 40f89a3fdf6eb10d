//! The things that a picture has to show of an answer: the ray or the point, the exact points, and those that were answered.

use super::space::{Scale, direction_of, nearest_point};
use crate::arith::Float;
use crate::asked::Answers;
use glam::DVec3;
use hairline_scene::{Answer, InvalidRay, Nearest, Ray, Scene};

/// At most so many hits are marked.
const MARKED: usize = 8;

/// A point of the mesh, and its faces; of faces alone the point is not known.
#[derive(Clone, Debug, Default)]
pub(super) struct Spot {
    pub faces: Vec<u32>,
    pub point: Option<[f64; 3]>,
}

/// The ray, or the point with the way to the surface.
#[derive(Clone, Copy, Debug)]
pub(super) enum Asked {
    Ray(Ray<f64>),
    Point([f64; 3]),
}

/// All that is shown.
#[derive(Clone, Debug)]
pub(super) struct Sight {
    pub asked: Asked,
    /// The exact hits; of a point the nearest point of the surface.
    pub exact: Vec<Spot>,
    /// The hits that were answered.
    pub answered: Vec<Spot>,
    /// Where to look if there is neither: the face that the ray passes nearest.
    pub passed: Option<u32>,
}

impl Sight {
    /// The sight of a ray; `hit` is the exact hit that an answer is about.
    pub fn of_ray<F: Float>(
        scene: &Scene<F>,
        ray: &Ray<F>,
        hit: Option<&Nearest>,
        answered: Option<(&Answers, usize)>,
    ) -> Result<Sight, InvalidRay> {
        let spot_of = |face: u32, t: Option<f64>| spot(scene, ray, face, t);
        let mut exact = Vec::new();
        if let Some(hit) = hit {
            let Spot { point, .. } = spot_of(hit.faces[0], None)?;
            let faces = hit.faces.clone();
            exact.push(Spot { faces, point });
        }
        let mut named = Vec::new();
        match answered {
            Some((Answers::Nearest(all), index)) => {
                let Answer { face, t } = all[index];
                named.extend(face.map(|face| spot_of(face, t)).transpose()?);
            }
            Some((Answers::All(all), index)) => {
                for hit in all[index].iter().take(MARKED) {
                    named.push(spot_of(hit.face, hit.t)?);
                }
                exact.extend(others(scene, ray, &exact)?);
            }
            Some((Answers::Count(_), _)) => exact.extend(others(scene, ray, &exact)?),
            _ => {}
        }
        let wide = Ray {
            origin: ray.origin.map(F::to_f64),
            direction: ray.direction.map(F::to_f64),
            t_min: ray.t_min.to_f64(),
            t_max: ray.t_max.to_f64(),
        };
        let is_somewhere = |spots: &[Spot]| {
            let mut faces = spots.iter().flat_map(|spot| &spot.faces);
            faces.any(|face| scene.triangle(*face).is_some())
        };
        let passed = match is_somewhere(&exact) || is_somewhere(&named) {
            true => None,
            false => passed_by(scene, &wide),
        };
        Ok(Sight {
            asked: Asked::Ray(wide),
            exact,
            answered: named,
            passed,
        })
    }

    /// The sight of a point.
    pub fn of_point<F: Float>(scene: &Scene<F>, point: [F; 3]) -> Sight {
        let point = point.map(F::to_f64);
        let nearest = nearest_to(scene, [point], |scale, _| scale.place(point));
        let exact = nearest.map(|face| Spot {
            faces: vec![face],
            point: None,
        });
        Sight {
            asked: Asked::Point(point),
            exact: exact.into_iter().collect(),
            answered: Vec::new(),
            passed: None,
        }
    }
}

/// A hit of a face: at a t, or else where the ray meets the face.
fn spot<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    face: u32,
    t: Option<f64>,
) -> Result<Spot, InvalidRay> {
    let point = match t {
        Some(t) => Some(point_at(ray, t)),
        None => scene.values(ray, face)?.map(|values| values.points[0]),
    };
    Ok(Spot {
        faces: vec![face],
        point: point.filter(|point| point.iter().all(|x| x.is_finite())),
    })
}

fn point_at<F: Float>(ray: &Ray<F>, t: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis| ray.origin[axis].to_f64() + t * ray.direction[axis].to_f64())
}

/// The exact hits that are not marked yet.
fn others<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    marked: &[Spot],
) -> Result<Vec<Spot>, InvalidRay> {
    let is_marked = |face: &u32| marked.iter().any(|spot| spot.faces.contains(face));
    let mut spots = Vec::new();
    for hit in scene.hits(ray)?.into_iter().take(MARKED) {
        if !hit.faces.iter().any(is_marked) {
            let Spot { point, .. } = spot(scene, ray, hit.faces[0], None)?;
            let faces = hit.faces;
            spots.push(Spot { faces, point });
        }
    }
    Ok(spots)
}

/// The face that a ray passes nearest, about.
fn passed_by<F: Float>(scene: &Scene<F>, ray: &Ray<f64>) -> Option<u32> {
    let direction = direction_of(ray.direction);
    nearest_to(scene, [ray.origin], |scale, [a, b, c]| {
        let origin = scale.place(ray.origin);
        let centre = (a + b + c) / 3.0;
        origin + (centre - origin).dot(direction).max(0.0) * direction
    })
}

/// The face with the least distance from a point that belongs to it.
fn nearest_to<F: Float>(
    scene: &Scene<F>,
    around: [[f64; 3]; 1],
    point_for: impl Fn(&Scale, [DVec3; 3]) -> DVec3,
) -> Option<u32> {
    let faces = scene.finite().iter();
    let corners = faces.filter_map(|face| scene.triangle(*face)).flatten();
    let scale = Scale::of(corners.chain(around));
    let mut nearest = None;
    let mut least = f64::INFINITY;
    for face in scene.finite() {
        let triangle = scene.triangle(*face)?.map(|corner| scale.place(corner));
        let point = point_for(&scale, triangle);
        let distance = nearest_point(triangle, point).distance(point);
        if distance < least {
            least = distance;
            nearest = Some(*face);
        }
    }
    nearest
}
