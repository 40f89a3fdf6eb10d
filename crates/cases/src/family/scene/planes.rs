//! Where the planes of a scene's triangles lie, and how they are turned.

use super::draw::{RayAxes, between_powers, circle, either_sign, symmetric};
use crate::case::{Draw, PlaneKind, Scene};
use glam::DVec3;

/// The axes in cyclic order: two in a plane, and its normal.
pub const AXES: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];

/// How far from coordinate 0 a plane is that is near it, in shares of the extent.
const NEAR_ZERO: [f64; 2] = [1e-6, 1e-3];

/// The sines of the slopes of level ground.
const SLOPES: [f64; 2] = [1e-3, 0.1];

/// A point and the frame of a plane through it, of the scene's kind.
pub fn plane(draw: &mut Draw, scene: &Scene, size: f64) -> (DVec3, RayAxes) {
    let mut base = place(draw, scene, size);
    if scene.plane == PlaneKind::Generic {
        return (base, RayAxes::draw(draw));
    }
    let axes = draw.pick(&AXES);
    // Floors and boxes mostly have edges along axes.
    let turned = match scene.plane {
        PlaneKind::Box => [1.0, 0.0],
        PlaneKind::Terrain => turn(draw),
        _ if draw.coin() => [1.0, 0.0],
        _ => turn(draw),
    };
    let mut frame = RayAxes::upright(axes, turned);
    let side = either_sign(draw, 1.0);
    let height = &mut base[axes[2]];
    match scene.plane {
        PlaneKind::Generic | PlaneKind::Axis | PlaneKind::Box => {}
        PlaneKind::AxisNearZero => *height = near_zero(draw, scene, side),
        PlaneKind::AxisAtZero => *height = 0.0,
        PlaneKind::Terrain => {
            *height = scene.center + near_zero(draw, scene, side);
            let downhill = turn(draw);
            let slope = between_powers(draw, SLOPES);
            return (base, frame.tilted(downhill, slope));
        }
    }
    // Half of the planes face down.
    frame.across *= side;
    frame.normal *= side;
    (base, frame)
}

/// A small height on one side of 0.
fn near_zero(draw: &mut Draw, scene: &Scene, side: f64) -> f64 {
    side * scene.extent * between_powers(draw, NEAR_ZERO)
}

/// A point so far inside the extent that all within `size` of it is inside too, where there is one.
pub fn place(draw: &mut Draw, scene: &Scene, size: f64) -> DVec3 {
    let reach = (scene.extent - size).max(0.0);
    let share = DVec3::new(symmetric(draw), symmetric(draw), symmetric(draw));
    let from_center = share * reach;
    // Adding 0 would take the sign from zeros.
    if scene.center == 0.0 {
        from_center
    } else {
        from_center + DVec3::splat(scene.center)
    }
}

/// A vector of length 1, uniform on the circle.
pub fn turn(draw: &mut Draw) -> [f64; 2] {
    let (vector, length) = circle(draw);
    vector.map(|x| x / length)
}

/// Half a rectangle: how far along and how far across its other two vertices lie from the corner. Its diagonal is `size`
/// long.
pub fn half_of_a_face(draw: &mut Draw, size: f64) -> (f64, f64) {
    let across = 0.25 + 0.45 * draw.unit();
    let along = (1.0 - across * across).sqrt();
    (along * size, across * size)
}

/// The ends of the six edges around a corner of a box: three are the box's, three are diagonals of faces, all at most
/// about 1 long.
pub fn faces_at_a_corner(draw: &mut Draw, frame: &RayAxes) -> [DVec3; 6] {
    let [x, y, z] = [frame.along, frame.across, frame.normal].map(|axis| {
        let length = 0.35 + 0.35 * draw.unit();
        axis * either_sign(draw, length)
    });
    [x, x + y, y, y + z, z, z + x]
}
