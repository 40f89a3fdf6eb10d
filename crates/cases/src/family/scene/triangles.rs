//! Where the strata's triangles come from: the numbers of a scene, or (in `mesh`) the faces of a mesh.

use super::super::integer::{shuffle, turned};
use super::super::unit;
use super::draw::{RayAxes, edge_length, either_sign, in_plane, rounded, symmetric};
use super::planes::{AXES, faces_at_a_corner, half_of_a_face, place, plane, turn};
use crate::arith::Float;
use crate::case::{DirectionLength, Draw, PlaneKind, Scene};
use glam::DVec3;

/// A triangle's vertices, in order.
pub type Corners<F> = [[F; 3]; 3];

/// A triangle, and a direction parallel to its plane.
pub struct Parallel<F> {
    /// The triangle.
    pub triangle: Corners<F>,
    /// The direction.
    pub direction: [F; 3],
    /// About how long the triangle's edges are.
    pub size: f64,
}

/// Two triangles on one edge.
pub struct Pair<F> {
    /// The ends of the edge.
    pub ends: [[F; 3]; 2],
    /// The triangles. They run through the edge in opposite directions; it may be any edge of each.
    pub triangles: [Corners<F>; 2],
}

/// A closed fan around a vertex.
pub struct Ring<F> {
    /// The vertex.
    pub center: [F; 3],
    /// The triangles, in order; the vertex may be any corner of each.
    pub triangles: Vec<Corners<F>>,
}

/// Triangles to aim rays at. Those of a mesh keep the order of their vertices; of others each corner is as
/// likely to be the one that a ray is aimed at, because kernels do not treat a, b and c alike.
pub trait TriangleSource<F: Float> {
    /// A triangle, and the frame of its plane.
    fn triangle(&self, draw: &mut Draw) -> (Corners<F>, RayAxes);

    /// Two triangles on one edge.
    fn pair(&self, draw: &mut Draw) -> Pair<F>;

    /// The triangles of a closed fan.
    fn fan(&self, draw: &mut Draw) -> Ring<F>;

    /// A triangle and a direction exactly parallel to its plane, where one can be made.
    fn parallel(&self, draw: &mut Draw) -> Parallel<F>;
}

impl<F: Float> TriangleSource<F> for Scene {
    fn triangle(&self, draw: &mut Draw) -> (Corners<F>, RayAxes) {
        let size = edge_length(draw, self);
        let (a, frame) = plane(draw, self, size);
        let (to_b, to_c) = if self.plane == PlaneKind::Box {
            let (along, across) = half_of_a_face(draw, size);
            (frame.flat(along, 0.0), frame.flat(0.0, across))
        } else {
            let (x, y) = apex(draw, size);
            (frame.flat(size, 0.0), frame.flat(x, y))
        };
        let corners = shuffle(draw, [a, a + to_b, a + to_c]);
        (corners.map(rounded), frame)
    }

    fn pair(&self, draw: &mut Draw) -> Pair<F> {
        let size = edge_length(draw, self);
        let (p, frame) = plane(draw, self, size);
        let q = p + frame.flat(size, 0.0);
        let (along, across) = apex(draw, size);
        let first = p + frame.flat(along, across);
        let (along, across) = apex(draw, size);
        let bend = symmetric(draw);
        // The second triangle is bent out of the plane of the first by up to 27 degrees; on level ground by up to 6; in
        // planes of two axes not at all; at the edge of a box by a right angle.
        let away = match self.plane {
            PlaneKind::Generic => bent_away(&frame, 0.5 * bend),
            PlaneKind::Terrain => bent_away(&frame, 0.1 * bend),
            PlaneKind::Axis | PlaneKind::AxisNearZero | PlaneKind::AxisAtZero => -frame.across,
            PlaneKind::Box => frame.normal * bend.signum(),
        };
        let second = p + frame.along * along + away * across;
        let [p, q, first, second] = [p, q, first, second].map(rounded);
        let triangles = [[p, q, first], [q, p, second]].map(|corners| turned(draw, corners));
        Pair {
            ends: [p, q],
            triangles,
        }
    }

    fn fan(&self, draw: &mut Draw) -> Ring<F> {
        let size = edge_length(draw, self);
        let (center, frame) = plane(draw, self, size);
        let steep = match self.plane {
            PlaneKind::Generic => 0.2,
            PlaneKind::Terrain => 0.02,
            _ => 0.0,
        };
        let spokes = match self.plane {
            PlaneKind::Box => faces_at_a_corner(draw, &frame),
            _ => HEXAGON.map(|[x, y]| {
                let length = 0.5 + 0.5 * draw.unit();
                let height = steep * symmetric(draw);
                frame.flat(x * length, y * length) + frame.normal * height
            }),
        };
        let rim = spokes.map(|spoke| rounded::<F>(center + spoke * (size / 1.1)));
        let center = rounded(center);
        let mut triangles = Vec::with_capacity(rim.len());
        for (i, corner) in rim.into_iter().enumerate() {
            let next = rim[(i + 1) % rim.len()];
            triangles.push(turned(draw, [center, corner, next]));
        }
        Ring { center, triangles }
    }

    fn parallel(&self, draw: &mut Draw) -> Parallel<F> {
        let size = edge_length(draw, self);
        let is_tilted = matches!(self.plane, PlaneKind::Generic | PlaneKind::Terrain);
        let (triangle, direction) = if is_tilted {
            parallel_of_any_sort(draw, self, size)
        } else {
            let (base, frame) = plane(draw, self, size);
            level(draw, self, size, base, &frame)
        };
        Parallel {
            triangle,
            direction,
            size,
        }
    }
}

/// A triangle, and a direction exactly parallel to its plane. Unit vectors in a generic plane do not exist among floats.
/// What does: rays along an axis in a plane that holds the axis, rays in planes of constant height, and, if directions may
/// have any length, sums of edges on a grid.
fn parallel_of_any_sort<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
) -> (Corners<F>, [F; 3]) {
    let axes = draw.pick(&AXES);
    match (scene.direction, draw.below(3)) {
        (DirectionLength::Target, 0) => on_grid(draw, scene, size),
        (_, 0 | 1) => holding_axis(draw, scene, size, axes),
        _ => {
            let base = place(draw, scene, size);
            let frame = RayAxes::upright(axes, turn(draw));
            level(draw, scene, size, base, &frame)
        }
    }
}

/// The unit vector against `across`, bent out of the plane by the angle of a tangent.
fn bent_away(frame: &RayAxes, tangent: f64) -> DVec3 {
    (frame.normal * tangent - frame.across) / (1.0 + tangent * tangent).sqrt()
}

/// The corners of a hexagon: cosines and sines of multiples of 60 degrees.
pub const HEXAGON: [[f64; 2]; 6] = {
    const SINE: f64 = 0.866_025_403_784_438_6;
    [
        [1.0, 0.0],
        [0.5, SINE],
        [-0.5, SINE],
        [-1.0, 0.0],
        [-0.5, -SINE],
        [0.5, -SINE],
    ]
};

/// Along and across, the third vertex of a triangle on the edge from (0, 0) to (size, 0), which is the
/// longest; its height is at least an eighth of that.
fn apex(draw: &mut Draw, size: f64) -> (f64, f64) {
    loop {
        let (x, y) = (draw.unit(), 0.125 + 0.875 * draw.unit());
        if x * x + y * y <= 1.0 && (1.0 - x) * (1.0 - x) + y * y <= 1.0 {
            return (x * size, y * size);
        }
    }
}

/// The spacing of floats near the largest coordinate, on whose multiples small sums are exact.
fn grid<F: Float>(scene: &Scene) -> f64 {
    F::from_f64(scene.largest()).ulp().to_f64()
}

/// The multiple of a spacing next to a number.
fn snapped(x: f64, spacing: f64) -> f64 {
    (x / spacing).round_ties_even() * spacing
}

/// The point of a grid next to a point.
fn snapped_point(point: DVec3, spacing: f64) -> DVec3 {
    point.to_array().map(|x| snapped(x, spacing)).into()
}

/// A triangle on the grid of a generic plane, and a sum of its edges.
fn on_grid<F: Float>(draw: &mut Draw, scene: &Scene, size: f64) -> (Corners<F>, [F; 3]) {
    // Coarser than a float's own grid, so that sums of three edges are floats too.
    let spacing = 8.0 * grid::<F>(scene);
    let size = size.max(4.0 * spacing);
    loop {
        let base = place(draw, scene, size);
        let frame = RayAxes::draw(draw);
        let (x, y) = apex(draw, size);
        let a = snapped_point(base, spacing);
        let b = snapped_point(base + frame.flat(size, 0.0), spacing);
        let c = snapped_point(base + frame.flat(x, y), spacing);
        let ab = b - a;
        let ac = c - a;
        let normal = ab.cross(ac);
        if 0.001 * size.powi(4) < normal.dot(normal) {
            let sums = [(1.0, 0.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 2.0)];
            let (i, j) = draw.pick(&sums);
            let corners = shuffle(draw, [a, b, c]);
            return (corners.map(rounded), rounded(ab * i + ac * j));
        }
    }
}

/// A triangle whose plane holds an axis, and the direction of that axis. Along the two other axes the
/// corners are steps on one line of the grid. Its longest edge is from half of the size to the size; its
/// height is at least an eighth of that.
fn holding_axis<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
    [axis, second, third]: [usize; 3],
) -> (Corners<F>, [F; 3]) {
    let spacing = grid::<F>(scene);
    let mut base = place(draw, scene, size);
    base[second] = snapped(base[second], spacing);
    base[third] = snapped(base[third], spacing);
    let most = (size / spacing / 4.0) as i64;
    loop {
        // One step of the line, in units of the grid.
        let step = [
            draw.integer(-most, most),
            draw.integer((most + 1) / 2, most),
        ];
        let [steps_to_b, steps_to_c] = draw.pick(&[[1, 2], [2, -1], [-1, 1], [1, -2]]);
        let b_along = symmetric(draw) * size;
        let c_along = symmetric(draw) * size;
        let b = seen_from_base(b_along, step.map(|part| part * steps_to_b), spacing);
        let c = seen_from_base(c_along, step.map(|part| part * steps_to_c), spacing);
        let longest = b.length().max(c.length()).max((c - b).length());
        let is_wide = 0.125 * longest * longest <= b.cross(c).length();
        if longest <= size && size <= 2.0 * longest && is_wide {
            let corners = [DVec3::ZERO, b, c].map(|from_base| {
                let mut corner = base;
                corner[axis] += from_base.x;
                corner[second] += from_base.y;
                corner[third] += from_base.z;
                rounded(corner)
            });
            let triangle = shuffle(draw, corners);
            return (triangle, along_axis(draw, scene, axis));
        }
    }
}

/// A vector from the base: some way along an axis, and steps of the grid along the two others.
fn seen_from_base(along: f64, steps: [i64; 2], spacing: f64) -> DVec3 {
    let [second, third] = steps.map(|count| count as f64 * spacing);
    DVec3::new(along, second, third)
}

/// A triangle in a plane of two axes, and a direction in that plane.
fn level<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
    base: DVec3,
    frame: &RayAxes,
) -> (Corners<F>, [F; 3]) {
    let (x, y) = apex(draw, size);
    let corners = [base, base + frame.flat(size, 0.0), base + frame.flat(x, y)];
    let way = in_plane(draw, frame);
    let direction = flat_along(draw, scene, way);
    let triangle = shuffle(draw, corners).map(rounded);
    (triangle, direction)
}

/// A direction along an axis, of the length that the scene's directions have.
pub fn along_axis<F: Float>(draw: &mut Draw, scene: &Scene, axis: usize) -> [F; 3] {
    let length = match scene.direction {
        DirectionLength::Unit | DirectionLength::Mixed => 1.0,
        DirectionLength::Target => edge_length(draw, scene),
    };
    let mut direction = [F::zero(); 3];
    direction[axis] = F::from_f64(either_sign(draw, length));
    direction
}

/// A direction along a unit vector, of the length that the scene's directions have; what is 0 stays so.
pub fn flat_along<F: Float>(draw: &mut Draw, scene: &Scene, flat: DVec3) -> [F; 3] {
    match scene.direction {
        DirectionLength::Unit | DirectionLength::Mixed => {
            let of_unit_length: [f64; 3] = unit(flat.to_array());
            of_unit_length.map(F::from_f64)
        }
        DirectionLength::Target => rounded(flat * edge_length(draw, scene)),
    }
}
