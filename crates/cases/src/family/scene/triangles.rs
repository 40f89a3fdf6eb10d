//! Where the strata's triangles come from: the numbers of a scene, or (in `mesh`) the faces of a mesh.

use super::super::integer::{shuffle, turned};
use super::super::unit;
use super::draw::{RayAxes, edge_length, in_plane, rounded, symmetric};
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
        let [base, (x, y)] = match self.plane {
            PlaneKind::Box => half_of_a_face(draw, size),
            _ => [(size, 0.0), apex(draw, size)],
        };
        let (b, c) = (a + frame.flat(base.0, base.1), a + frame.flat(x, y));
        let corners = shuffle(draw, [a, b, c]);
        (corners.map(rounded), frame)
    }

    fn pair(&self, draw: &mut Draw) -> Pair<F> {
        let size = edge_length(draw, self);
        let (p, frame) = plane(draw, self, size);
        let q = p + frame.flat(size, 0.0);
        let (x, y) = apex(draw, size);
        let first = p + frame.flat(x, y);
        // The second triangle is bent out of the plane of the first by up to 27 degrees; on level ground by up to 6; in
        // planes of two axes not at all; at the edge of a box by a right angle.
        let (x, y) = apex(draw, size);
        let bend = symmetric(draw);
        let bent = |bend: f64| (frame.normal * bend - frame.across) / (1.0 + bend * bend).sqrt();
        let down = match self.plane {
            PlaneKind::Generic => bent(0.5 * bend),
            PlaneKind::Terrain => bent(0.1 * bend),
            PlaneKind::Axis | PlaneKind::AxisNearZero | PlaneKind::AxisAtZero => -frame.across,
            PlaneKind::Box => frame.normal * bend.signum(),
        };
        let second = p + frame.along * x + down * y;
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
        let ring = match self.plane {
            PlaneKind::Box => faces_at_a_corner(draw, &frame),
            _ => HEXAGON.map(|[x, y]| {
                let (spoke, height) = (0.5 + 0.5 * draw.unit(), steep * symmetric(draw));
                frame.flat(x * spoke, y * spoke) + frame.normal * height
            }),
        };
        let ring = ring.map(|corner| rounded::<F>(center + corner * (size / 1.1)));
        let center = rounded(center);
        let triangle = |i: usize| turned(draw, [center, ring[i], ring[(i + 1) % ring.len()]]);
        Ring {
            center,
            triangles: (0..ring.len()).map(triangle).collect(),
        }
    }

    /// Unit vectors exactly in a generic plane do not exist among floats. What does: rays along an axis in
    /// a plane that holds the axis, rays in planes of constant height, and, if directions may have any
    /// length, sums of edges on a grid.
    fn parallel(&self, draw: &mut Draw) -> Parallel<F> {
        let size = edge_length(draw, self);
        if !matches!(self.plane, PlaneKind::Generic | PlaneKind::Terrain) {
            let (base, frame) = plane(draw, self, size);
            let (triangle, direction) = level(draw, self, size, base, &frame);
            return Parallel {
                triangle,
                direction,
                size,
            };
        }
        let axes = draw.pick(&AXES);
        let (triangle, direction) = match (self.direction, draw.below(3)) {
            (DirectionLength::Target, 0) => on_grid::<F>(draw, self, size),
            (_, 0 | 1) => holding_axis(draw, self, size, axes),
            _ => {
                let (base, turned) = (place(draw, self, size), turn(draw));
                level(draw, self, size, base, &RayAxes::upright(axes, turned))
            }
        };
        Parallel {
            triangle,
            direction,
            size,
        }
    }
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

/// A triangle on the grid of a generic plane, and a sum of its edges.
fn on_grid<F: Float>(draw: &mut Draw, scene: &Scene, size: f64) -> ([[F; 3]; 3], [F; 3]) {
    // Coarser than a float's own grid, so that sums of three edges are floats too.
    let spacing = 8.0 * grid::<F>(scene);
    let size = size.max(4.0 * spacing);
    loop {
        let (a, frame) = (place(draw, scene, size), RayAxes::draw(draw));
        let (x, y) = apex(draw, size);
        let corners = [a, a + frame.flat(size, 0.0), a + frame.flat(x, y)];
        let [a, b, c] = corners.map(|p| DVec3::from(p.to_array().map(|x| snapped(x, spacing))));
        let (e, f) = (b - a, c - a);
        let normal = e.cross(f);
        if 0.001 * size.powi(4) < normal.dot(normal) {
            let sums = [(1.0, 0.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 2.0)];
            let (i, j) = draw.pick(&sums);
            return (
                shuffle(draw, [a, b, c]).map(rounded),
                rounded(e * i + f * j),
            );
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
    axes: [usize; 3],
) -> ([[F; 3]; 3], [F; 3]) {
    let spacing = grid::<F>(scene);
    let base = place(draw, scene, size);
    let steps = (size / spacing / 4.0) as i64;
    loop {
        let line = [
            draw.integer(-steps, steps),
            draw.integer((steps + 1) / 2, steps),
        ];
        let [first, second] = draw.pick(&[[1, 2], [2, -1], [-1, 1], [1, -2]]);
        let along = [0.0, symmetric(draw) * size, symmetric(draw) * size];
        let from_base = |step: i64, along: f64| {
            let [i, j] = line.map(|part| (step * part) as f64 * spacing);
            DVec3::new(along, i, j)
        };
        let corners = [
            from_base(0, 0.0),
            from_base(first, along[1]),
            from_base(second, along[2]),
        ];
        let [e, f] = [corners[1] - corners[0], corners[2] - corners[0]];
        let longest = [e, f, f - e]
            .iter()
            .fold(0.0f64, |most, edge| most.max(edge.length()));
        let is_wide = 0.125 * longest * longest <= e.cross(f).length();
        if longest <= size && size <= 2.0 * longest && is_wide {
            let at_base = |corner: DVec3| {
                let mut p = [0.0; 3];
                p[axes[0]] = base[axes[0]] + corner.x;
                for (axis, steps) in [(axes[1], corner.y), (axes[2], corner.z)] {
                    p[axis] = snapped(base[axis], spacing) + steps;
                }
                p.map(F::from_f64)
            };
            let corners = shuffle(draw, corners.map(at_base));
            return (corners, along_axis(draw, scene, axes[0]));
        }
    }
}

/// A triangle in a plane of two axes, and a direction in that plane.
fn level<F: Float>(
    draw: &mut Draw,
    scene: &Scene,
    size: f64,
    base: DVec3,
    frame: &RayAxes,
) -> ([[F; 3]; 3], [F; 3]) {
    let (x, y) = apex(draw, size);
    let corners = [base, base + frame.flat(size, 0.0), base + frame.flat(x, y)];
    let flat = in_plane(draw, frame);
    let flat = flat_along(draw, scene, flat);
    (shuffle(draw, corners).map(rounded), flat)
}

/// A direction along an axis, of the length that the scene's directions have.
pub fn along_axis<F: Float>(draw: &mut Draw, scene: &Scene, axis: usize) -> [F; 3] {
    let length = match scene.direction {
        DirectionLength::Unit | DirectionLength::Mixed => 1.0,
        DirectionLength::Target => edge_length(draw, scene),
    };
    let mut direction = [F::zero(); 3];
    direction[axis] = F::from_f64(if draw.coin() { length } else { -length });
    direction
}

/// A direction along a unit vector, of the length that the scene's directions have; what is 0 stays so.
pub fn flat_along<F: Float>(draw: &mut Draw, scene: &Scene, flat: DVec3) -> [F; 3] {
    match scene.direction {
        DirectionLength::Unit | DirectionLength::Mixed => {
            unit::<f64>(flat.to_array()).map(F::from_f64)
        }
        DirectionLength::Target => rounded(flat * edge_length(draw, scene)),
    }
}
