//! A ray–triangle test as one finds it in a renderer: Möller–Trumbore with an epsilon picked by feel.

/// A point or a vector.
pub type Vec3 = [f32; 3];

/// Determinants nearer to zero than this are taken for parallel rays.
pub const EPSILON: f32 = 1e-6;

/// t of the hit of `origin + t * direction`, t >= 0, on the triangle; none if it misses.
pub fn intersect(origin: Vec3, direction: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let p = cross(direction, ac);
    let det = dot(ab, p);
    if det.abs() < EPSILON {
        return None;
    }
    let from = minus(origin, a);
    let u = dot(from, p) / det;
    let q = cross(from, ab);
    let v = dot(direction, q) / det;
    let t = dot(ac, q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
}

fn minus(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
