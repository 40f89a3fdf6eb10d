//! Heights over a triangle's exact plane, as numbers for people; the oracle decides sides.

use crate::arith::{Bounded, Exact, Float, Real, Triple, Vector};
use crate::case::Instance;

/// A triangle's plane, in double-doubles; of an instance that of the exact triangle in the world.
pub struct Plane {
    vertices: [[f64; 3]; 3],
    instance: Option<Instance<f64>>,
    near: PlaneMeasures<Bounded>,
}

/// A vertex, the normal, the squares of its length and of the longest edge's.
struct PlaneMeasures<R> {
    corner: Triple<R>,
    normal: Triple<R>,
    normal_squared: R,
    edge_squared: R,
}

fn triple<R>(point: [f64; 3], number: fn(f64) -> R) -> Triple<R> {
    point.map(number).into()
}

impl<R: Real> PlaneMeasures<R> {
    fn new(
        vertices: [[f64; 3]; 3],
        instance: &Option<Instance<f64>>,
        number: fn(f64) -> R,
    ) -> PlaneMeasures<R> {
        let [mut a, mut b, mut c] = vertices.map(|vertex| triple(vertex, number));
        if let Some(instance) = instance {
            [a, b, c] = instance.place(vertices, number);
            // Above stays the side of the object's front.
            if instance.is_mirrored() {
                std::mem::swap(&mut b, &mut c);
            }
        }
        let edges = [b.minus(&a), c.minus(&a), c.minus(&b)];
        let normal = edges[0].cross(&edges[1]);
        let squares = edges.map(|edge| edge.dot(&edge));
        PlaneMeasures {
            corner: a,
            normal_squared: normal.dot(&normal),
            normal,
            edge_squared: squares.into_iter().reduce(R::larger).expect("three edges"),
        }
    }

    /// The dot product of the normal with a vector, or with the way from the plane to a point.
    fn product(&self, is_point: bool, vector: Triple<R>) -> R {
        self.normal.dot(&if is_point {
            vector.minus(&self.corner)
        } else {
            vector
        })
    }
}

impl Plane {
    /// The plane of a triangle with an area.
    pub fn new<F: Float>(vertices: [[F; 3]; 3], instance: Option<Instance<F>>) -> Plane {
        let vertices = vertices.map(|vertex| vertex.map(F::to_f64));
        let instance = instance.map(|it| it.widen());
        Plane {
            vertices,
            near: PlaneMeasures::new(vertices, &instance, Bounded::new),
            instance,
        }
    }

    /// How high a point lies above the plane, in longest edges of the triangle, within a millionth of
    /// itself. Above is where (b - a) × (c - a) points. NaN of a point that is not finite, and over a
    /// triangle without area.
    pub fn height<F: Float>(&self, point: [F; 3]) -> f64 {
        self.over(true, point)
    }

    /// By how much a vector rises over the plane, in longest edges of the triangle.
    pub fn rise<F: Float>(&self, vector: [F; 3]) -> f64 {
        self.over(false, vector)
    }

    /// The product of a vector, or of a point, with the normal over the lengths of the normal and of the longest edge: in
    /// double-doubles if they are certain, else exactly.
    fn over<F: Float>(&self, is_point: bool, vector: [F; 3]) -> f64 {
        let vector = vector.map(F::to_f64);
        if !vector.iter().all(|x| x.is_finite()) {
            return f64::NAN;
        }
        let PlaneMeasures {
            normal_squared,
            edge_squared,
            ..
        } = &self.near;
        let product = self
            .near
            .product(is_point, triple(vector, Bounded::new))
            .approximate();
        let lengths = normal_squared.approximate().zip(edge_squared.approximate());
        if let Some((product, (normal, edge))) = product.zip(lengths) {
            let height = product / normal.sqrt() / edge.sqrt();
            if height.is_finite() && (height != 0.0 || product == 0.0) {
                return height;
            }
        }
        let measures = PlaneMeasures::new(self.vertices, &self.instance, Exact::from_f64);
        let product = measures.product(is_point, triple(vector, Exact::from_f64));
        let squares = measures.normal_squared * &measures.edge_squared;
        let height = (product.clone() * &product / &squares).approximate_root();
        if product.is_sign_negative() {
            -height
        } else {
            height
        }
    }
}
