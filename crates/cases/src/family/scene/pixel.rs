//! Rays of a picture's pixels, near edges that triangles share.
//!
//! A pixel's ray meets a triangle anywhere, and few meet it so near to an edge that rounding decides. So rays are aimed at
//! the third of a triangle that is nearest to the shared edge, each halving of the distance equally often: from the
//! centre down to far less than any rounding. A ray stands for an area in proportion to its distance.

use super::Setup;
use super::aimed::aim;
use super::draw::{ray, wide};
use super::triangles::{Pair, TriangleSource};
use crate::arith::Float;
use crate::case::{Case, Draw, Scene};
use std::f64::consts::LN_2;

/// So many halvings are below the scalar's precision.
const HALVINGS: f64 = 8.0;

/// The numbers from which a ray is drawn, those of its pair of triangles first.
pub fn pixel_draw(seed: u64, index: u64) -> Draw {
    Draw::new("scene-pixels", seed, index)
}

/// A ray near an edge that triangles share. Areas are as it sees them: at right angles to it.
pub struct Pixel<F: Float> {
    /// The triangles with their ray.
    pub cases: Vec<Case<F>>,
    /// The area that it stands for.
    pub area: f64,
    /// A third of the triangles' area, as each has three edges.
    pub triangles: f64,
}

/// Ray `index` of a seed's.
pub fn pixel<F: Float>(
    triangles: &dyn TriangleSource<F>,
    scene: &Scene,
    seed: u64,
    index: u64,
) -> Pixel<F> {
    let setup = Setup {
        triangles,
        scene,
        kernel: None,
    };
    let draw = &mut pixel_draw(seed, index);
    let Pair { ends, triangles } = setup.triangles.pair(draw);
    let toward = aim(draw, scene, triangles[0]);
    let areas = triangles.map(|triangle| {
        let [a, b, c] = triangle.map(wide);
        (b - a).cross(c - a).dot(toward).abs() / 2.0
    });
    let which = usize::from(draw.coin());
    let apex = triangles[which]
        .into_iter()
        .find(|corner| !ends.contains(corner));
    let apex = wide(apex.unwrap_or(ends[0]));
    let [p, q] = ends.map(wide);
    // The weight of the third corner is the least of the three.
    let halvings = HALVINGS - F::one().ulp().to_f64().log2();
    let weight = (-draw.unit() * halvings).exp2() / 3.0;
    let length = 1.0 - 3.0 * weight;
    let of_q = weight + length * draw.unit();
    let target = p + (q - p) * of_q + (apex - p) * weight;
    let (start, direction) = ray(draw, scene, target, toward);
    Pixel {
        cases: triangles
            .map(|triangle| Case::new(start, direction, triangle))
            .into(),
        // Over the densities of the weight and of the triangle.
        area: 2.0 * areas[which] * length * weight * halvings * LN_2 * 2.0,
        triangles: (areas[0] + areas[1]) / 3.0,
    }
}
