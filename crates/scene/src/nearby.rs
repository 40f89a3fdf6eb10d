//! Faces near a ray that misses them, or near a point: by the tree, in floats. They name a judgement and decide no hit.

use crate::aabb::{Aabb, Boxes, LANES};
use crate::distance::{distance_to, longest_edge};
use crate::ray::Ray;
use crate::scene::Scene;
use crate::slab::TreeRay;
use crate::tree::{Child, Node};
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;

/// A face that lies nearest to a point.
struct NearestFace {
    /// The distance, and the same in the units of the tree.
    away: f64,
    distance: f64,
    /// The distance in longest edges of the face.
    in_edges: f64,
}

/// Nodes that are yet to be looked at.
struct Waiting {
    child: Child,
    /// The distance of its box.
    distance: f64,
}

impl<F: Float> Scene<F> {
    /// True if something holds of the place of a face whose box, grown by a share of its sides, is met by a ray.
    pub(crate) fn is_any_near(
        &self,
        ray: &Ray<f64>,
        share: f64,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let ray = TreeRay::new(ray, self.exponent());
        let mut waiting = self.root();
        while let Some(child) = waiting.pop() {
            match child.place() {
                Err(mut places) => {
                    if places.any(&mut holds) {
                        return true;
                    }
                }
                Ok(place) => {
                    let node = self.node(place);
                    let entered = ray.enters(&grown(&node.bounds, share));
                    waiting.extend(entered.map(|k| node.children[k]));
                }
            }
        }
        false
    }

    /// The distance of a point from the surface, computed in `f64`. None without a face.
    pub fn distance(&self, point: [F; 3]) -> Option<f64> {
        self.nearest_face(point).map(|it| it.away)
    }

    /// The distance of a point from the surface, in longest edges of the face there. None without a face.
    pub(crate) fn distance_in_edges(&self, point: [F; 3]) -> Option<f64> {
        self.nearest_face(point).map(|it| it.in_edges)
    }

    fn nearest_face(&self, point: [F; 3]) -> Option<NearestFace> {
        let point = point.map(F::to_f64);
        let scaled = point.map(|x| scale_by_power_of_two(x, self.exponent()));
        let mut nearest: Option<NearestFace> = None;
        let roots = self.root().into_iter();
        let mut waiting: Vec<Waiting> = roots
            .map(|child| Waiting {
                child,
                distance: 0.0,
            })
            .collect();
        while let Some(Waiting { child, distance }) = waiting.pop() {
            let is_beyond = |distance: f64| {
                let nearest = nearest.as_ref().map_or(f64::INFINITY, |it| it.distance);
                nearest < distance
            };
            if is_beyond(distance) {
                continue;
            }
            let places = match child.place() {
                Ok(place) => {
                    waiting.extend(nearer_last(self.node(place), scaled));
                    continue;
                }
                Err(places) => places,
            };
            for place in places {
                let triangle = self.triangle_at(place);
                let away = distance_to(&triangle, point);
                let distance = scale_by_power_of_two(away, self.exponent());
                if nearest.as_ref().is_none_or(|it| distance < it.distance) {
                    nearest = Some(NearestFace {
                        away,
                        distance,
                        in_edges: away / longest_edge(&triangle),
                    });
                }
            }
        }
        nearest
    }

    fn root(&self) -> Vec<Child> {
        match self.face_count() {
            0 => Vec::new(),
            _ => vec![Child::node(0)],
        }
    }
}

/// The children of a node, the nearest one last.
fn nearer_last(node: &Node, point: [f64; 3]) -> [Waiting; LANES] {
    let mut all = std::array::from_fn(|k| Waiting {
        child: node.children[k],
        distance: distance_to_box(&node.bounds.get(k), point),
    });
    all.sort_by(|a: &Waiting, b| b.distance.total_cmp(&a.distance));
    all
}

/// Boxes, each grown.
fn grown(boxes: &Boxes, share: f64) -> Boxes {
    let mut all = Boxes::EMPTY;
    for k in 0..LANES {
        all.set(k, &grown_box(&boxes.get(k), share));
    }
    all
}

/// A box grown on each side by a share of the sum of its sides, which is longer than any edge in it.
fn grown_box(bounds: &Aabb, share: f64) -> Aabb {
    let sides = [0, 1, 2].map(|axis| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]));
    let more = share * sides.iter().sum::<f64>();
    Aabb {
        min: bounds
            .min
            .map(|x| ((f64::from(x) - more) as f32).next_down()),
        max: bounds.max.map(|x| ((f64::from(x) + more) as f32).next_up()),
    }
}

/// The distance of a point from a box, rounded down.
fn distance_to_box(bounds: &Aabb, point: [f64; 3]) -> f64 {
    let gaps = [0, 1, 2].map(|axis| {
        let (min, max) = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
        (min - point[axis]).max(point[axis] - max).max(0.0)
    });
    let [x, y, z] = gaps;
    x.hypot(y).hypot(z) * (1.0 - 8.0 * f64::EPSILON)
}
