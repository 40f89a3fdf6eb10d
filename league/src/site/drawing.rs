//! A triangle in its own plane, and where the line of the ray meets it.

use hairline::internals::arith::Float;
use hairline::internals::case::Case;
use hairline::internals::truth::ExactValues;
use maud::{Markup, html};
use num_rational::BigRational;
use num_traits::ToPrimitive;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 300.0;
const MARGIN: f64 = 36.0;
/// A crossing farther away than this many longest edges is not drawn.
const FARTHEST: f64 = 4.0;

/// The picture; none where the line lies in the plane or is parallel to it, where the triangle has no area to draw, or
/// where they are too far apart to be seen together.
pub fn picture<F: Float>(case: &Case<F>, exact: &ExactValues) -> Option<Markup> {
    let (u, v) = (exact.u.as_ref()?, exact.v.as_ref()?);
    let w = BigRational::from_integer(1.into()) - u - v;
    let least = u.min(v).min(&w).to_f64()?;
    let (u, v) = (u.to_f64()?, v.to_f64()?);
    let corners = in_plane(case)?;
    let [a, b, c] = corners;
    let crossing = [u * b[0] + v * c[0], u * b[1] + v * c[1]];
    if !crossing.iter().all(|x| x.abs() <= FARTHEST) {
        return None;
    }
    let place = view([a, b, c, crossing]);
    let [a, b, c] = corners.map(&place);
    let [x, y] = place(crossing);
    let points = [a, b, c].map(|[x, y]| format!("{x:.1},{y:.1}")).join(" ");
    let said = match least {
        0.0 => "on the boundary".to_owned(),
        _ if least < 0.0 => format!("outside: the smallest of its three weights is {least:.1e}"),
        _ => format!("inside: the smallest of its three weights is {least:.1e}"),
    };
    Some(html! {
        figure style="margin:0" {
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) width=(WIDTH) role="img" aria-label={ "The crossing is " (said) } {
                polygon.triangle points=(points) {}
                @for (name, [x, y]) in ["a", "b", "c"].iter().zip([a, b, c]) {
                    text x=(format!("{:.1}", x + 7.0)) y=(format!("{:.1}", y - 7.0)) { (name) }
                }
                circle.point cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5" {}
            }
            figcaption.soft { "The triangle in its plane. The point is where the line crosses it, " (said) "." }
        }
    })
}

/// The corners in the plane, with a at the origin, b on the first axis and the longest edge as the unit.
fn in_plane<F: Float>(case: &Case<F>) -> Option<[[f64; 2]; 3]> {
    let [_, _, a, b, c] = case.vectors().map(|vector| vector.map(|x| x.to_f64()));
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let edges = [minus(b, a), minus(c, a), minus(c, b)];
    let largest = edges
        .iter()
        .flatten()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let [e, f, g] = edges.map(|edge| edge.map(|x| x / largest));
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let longest = [e, f, g]
        .iter()
        .fold(0.0, |most: f64, edge| most.max(dot(*edge, *edge).sqrt()));
    let length = dot(e, e).sqrt();
    let along = dot(e, f) / length;
    let across = (dot(f, f) - along * along).max(0.0).sqrt();
    let corners = [[0.0; 2], [length, 0.0], [along, across]].map(|p| p.map(|x| x / longest));
    (corners.iter().flatten().all(|x| x.is_finite()) && 1e-3 < across).then_some(corners)
}

/// Where points go on the picture, so that all these are on it; up is up.
fn view(points: [[f64; 2]; 4]) -> impl Fn([f64; 2]) -> [f64; 2] {
    let end = |axis: usize, pick: fn(f64, f64) -> f64| {
        points
            .iter()
            .map(|point| point[axis])
            .reduce(pick)
            .expect("points")
    };
    let low = [end(0, f64::min), end(1, f64::min)];
    let high = [end(0, f64::max), end(1, f64::max)];
    let scale = ((WIDTH - 2.0 * MARGIN) / (high[0] - low[0]))
        .min((HEIGHT - 2.0 * MARGIN) / (high[1] - low[1]));
    move |[x, y]| {
        [
            MARGIN + (x - low[0]) * scale,
            HEIGHT - MARGIN - (y - low[1]) * scale,
        ]
    }
}
