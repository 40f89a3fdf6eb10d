//! The table of published schemes and their formulas, in the order of operations of their sources.

use super::hit::{HitPoint, Start};
use crate::arith::Float;

/// A published offset scheme: a row of the table.
pub struct PublishedScheme {
    /// The name on the command line.
    pub name: &'static str,
    /// The formula of the start in the hit point p and the normal n, with # for the scheme's number.
    pub(super) start: &'static str,
    /// Author, title, year and address.
    pub source: &'static str,
    /// The number that it takes.
    pub parameter: Option<Parameter>,
    /// The values with which it runs if nobody names a scheme; none stands for its default.
    pub(super) usual: &'static [Option<&'static str>],
    /// True if the scheme has no constants for `f64`.
    pub(super) only_f32: bool,
    pub(super) formula: OffsetFormula,
}

/// A scheme's number.
#[derive(Clone, Copy)]
pub struct Parameter {
    /// The meaning of the number.
    pub what: &'static str,
    /// Its value in the source.
    pub default: &'static str,
}

const fn number(what: &'static str, default: &'static str) -> Option<Parameter> {
    Some(Parameter { what, default })
}

/// The defaults of a row: it takes no number, and runs in both scalars.
const PLAIN: PublishedScheme = PublishedScheme {
    name: "",
    start: "",
    source: "",
    parameter: None,
    usual: &[None],
    only_f32: false,
    formula: OffsetFormula::Nothing,
};

/// Every published scheme, in the order of reports.
pub static PUBLISHED: &[PublishedScheme] = &[
    PublishedScheme {
        name: "none",
        start: "start at p",
        source: "-",
        formula: OffsetFormula::Nothing,
        ..PLAIN
    },
    PublishedScheme {
        name: "t-min",
        start: "start at p, and count hits from t = # on",
        source: "Shirley, Black, Hollasch: Ray Tracing in One Weekend, version 4, 2023, section 6.8, https://raytracing.github.io/books/RayTracingInOneWeekend.html",
        parameter: number("the least t", "0.001"),
        usual: &[Some("1e-3")],
        formula: OffsetFormula::TMin,
        ..PLAIN
    },
    PublishedScheme {
        name: "t-relative",
        start: "start at p, and count hits from # of the first ray's t on",
        source: "Pharr, Humphreys: pbrt-v2, 2010, rayEpsilon in src/shapes/trianglemesh.cpp, https://github.com/mmp/pbrt-v2",
        parameter: number("the share of t", "0.001"),
        usual: &[Some("1e-3")],
        formula: OffsetFormula::TRelative,
        ..PLAIN
    },
    PublishedScheme {
        name: "normal",
        start: "start at p + n * #",
        source: "common practice; for example demont-engine, issue 256, 2026, https://github.com/havokentity/demont-engine/issues/256",
        parameter: number("the distance", "0.001"),
        usual: &[Some("1e-4"), Some("1e-3")],
        formula: OffsetFormula::Normal,
        ..PLAIN
    },
    PublishedScheme {
        name: "ulps",
        start: "start at p + n * (# ulps of the largest |coordinate| of p)",
        source: "this project: the least that follows the coordinates",
        parameter: number("the number of ulps", "4"),
        usual: &[],
        formula: OffsetFormula::Ulps,
        ..PLAIN
    },
    PublishedScheme {
        name: "waechter-binder",
        start: "move each coordinate by 256 ulps times n (by 2^-16 times n near 0)",
        source: "Wächter, Binder: A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems, chapter 6, 2019, https://doi.org/10.1007/978-1-4842-4427-2_6",
        only_f32: true,
        formula: OffsetFormula::WaechterBinder,
        ..PLAIN
    },
    PublishedScheme {
        name: "pbrt-v3",
        start: "start beyond the error box of gamma # around p, along n",
        source: "Pharr, Jakob, Humphreys: Physically Based Rendering, 3rd edition, 2016, section 3.9.5, https://pbr-book.org/3ed-2018/Shapes/Managing_Rounding_Error",
        parameter: number("the n of gamma n", "7"),
        only_f32: true,
        formula: OffsetFormula::PbrtV3,
        ..PLAIN
    },
    PublishedScheme {
        name: "pbrt-v4",
        start: "start beyond the error box of gamma # around p, along n",
        source: "Pharr, Jakob, Humphreys: Physically Based Rendering, 4th edition, 2023, section 6.8.6, https://pbr-book.org/4ed/Shapes/Managing_Rounding_Error",
        parameter: number("the n of gamma n", "7"),
        formula: OffsetFormula::PbrtV4,
        ..PLAIN
    },
    PublishedScheme {
        name: "mitsuba-3.9",
        start: "start at p + n * # u * (1 + the largest |coordinate| of p)",
        source: "Jakob and others: Mitsuba 3 up to 3.9, 2022 to 2026, offset_p in include/mitsuba/render/interaction.h, https://github.com/mitsuba-renderer/mitsuba3",
        parameter: number("the number of u", "1500"),
        formula: OffsetFormula::Mitsuba39,
        ..PLAIN
    },
    PublishedScheme {
        name: "mitsuba",
        start: "start at p + n * # u * (|n| . the largest |coordinates| of the vertices)",
        source: "Jakob: A better ray epsilon, 2026, by its description, https://github.com/mitsuba-renderer/mitsuba3/pull/1962",
        parameter: number("the number of u", "32"),
        formula: OffsetFormula::Mitsuba,
        ..PLAIN
    },
];

/// A scheme's formula.
#[derive(Clone, Copy)]
pub(super) enum OffsetFormula {
    Nothing,
    TMin,
    TRelative,
    Normal,
    Ulps,
    WaechterBinder,
    PbrtV3,
    PbrtV4,
    Mitsuba39,
    Mitsuba,
}

impl OffsetFormula {
    /// Where the new ray starts.
    pub fn start<F: Float>(self, parameter: F, hit: &HitPoint<F>) -> Start<F> {
        let HitPoint { point, normal, .. } = *hit;
        match self {
            OffsetFormula::Nothing => Start::at(point),
            OffsetFormula::TMin => Start {
                origin: point,
                t_min: parameter,
            },
            OffsetFormula::TRelative => Start {
                origin: point,
                t_min: parameter * hit.t,
            },
            OffsetFormula::Normal => Start::at(along(point, normal, parameter)),
            OffsetFormula::Ulps => {
                Start::at(along(point, normal, parameter * largest(point).ulp()))
            }
            OffsetFormula::WaechterBinder => Start::at(waechter_binder(point, normal)),
            OffsetFormula::PbrtV3 => Start::at(pbrt(point, error_box(parameter, hit), normal)),
            OffsetFormula::PbrtV4 => {
                let boxed = rounded_outwards(point, error_box(parameter, hit));
                Start::at(pbrt(
                    boxed.map(|[middle, _]| middle),
                    boxed.map(|[_, half]| half),
                    normal,
                ))
            }
            OffsetFormula::Mitsuba39 => {
                let magnitude = (F::one() + largest(point)) * (parameter * unit_roundoff::<F>());
                Start::at(fused_along(point, normal, magnitude))
            }
            OffsetFormula::Mitsuba => {
                let reach = most_of_vertices(hit.vertices);
                let error =
                    dot(normal.map(|x| x.abs()), reach) * (parameter * unit_roundoff::<F>());
                Start::at(fused_along(point, normal, error))
            }
        }
    }
}

/// u = 2^-24 in `f32`.
fn unit_roundoff<F: Float>() -> F {
    F::EPSILON * F::from_f64(0.5)
}

fn larger<F: Float>(a: F, b: F) -> F {
    if a < b { b } else { a }
}

/// The largest absolute value of a coordinate.
pub(super) fn largest<F: Float>(point: [F; 3]) -> F {
    point
        .into_iter()
        .fold(F::zero(), |most, x| larger(most, x.abs()))
}

/// On each axis the largest absolute value of a coordinate of the vertices.
fn most_of_vertices<F: Float>(vertices: [[F; 3]; 3]) -> [F; 3] {
    std::array::from_fn(|i| largest(vertices.map(|vertex| vertex[i])))
}

fn dot<F: Float>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `point + normal * distance`, each step rounded.
pub(super) fn along<F: Float>(point: [F; 3], normal: [F; 3], distance: F) -> [F; 3] {
    std::array::from_fn(|i| point[i] + normal[i] * distance)
}

/// The same with fused products.
fn fused_along<F: Float>(point: [F; 3], normal: [F; 3], distance: F) -> [F; 3] {
    std::array::from_fn(|i| distance.mul_add(normal[i], point[i]))
}

/// The constants of the source: origin 1/32, float_scale 1/65536, int_scale 256. Adding to the bits of a
/// positive number and subtracting from those of a negative one moves both up in the order of floats.
fn waechter_binder<F: Float>(point: [F; 3], normal: [F; 3]) -> [F; 3] {
    std::array::from_fn(|i| {
        let (p, n) = (point[i], normal[i]);
        if p.abs() < F::from_f64(1.0 / 32.0) {
            return p + F::from_f64(1.0 / 65536.0) * n;
        }
        // The cast cuts the fraction off.
        p.offset_ulps((256.0 * n.to_f64()) as i64)
    })
}

/// gamma_n times the sum of the vertices' weighed coordinates. Without weights the largest coordinates
/// bound it.
fn error_box<F: Float>(n: F, hit: &HitPoint<F>) -> [F; 3] {
    let nu = n * unit_roundoff::<F>();
    let gamma = nu / (F::one() - nu);
    let sums = match hit.weights {
        Some(weights) => std::array::from_fn(|i| {
            let parts: [F; 3] = std::array::from_fn(|k| (weights[k] * hit.vertices[k][i]).abs());
            parts[0] + parts[1] + parts[2]
        }),
        None => most_of_vertices(hit.vertices),
    };
    sums.map(|sum| gamma * sum)
}

/// pbrt's interval of a value and its error: its middle and half its width.
fn rounded_outwards<F: Float>(point: [F; 3], error: [F; 3]) -> [[F; 2]; 3] {
    std::array::from_fn(|i| {
        let (x, e) = (point[i], error[i]);
        if e.is_zero() {
            return [x, F::zero()];
        }
        let (low, high) = ((x - e).offset_ulps(-1), (x + e).offset_ulps(1));
        let half = F::from_f64(0.5);
        [(low + high) * half, (high - low) * half]
    })
}

/// To the plane through the corner of the box, then away from the point to the next floats.
fn pbrt<F: Float>(point: [F; 3], error: [F; 3], normal: [F; 3]) -> [F; 3] {
    let distance = dot(normal.map(|x| x.abs()), error);
    std::array::from_fn(|i| {
        let offset = distance * normal[i];
        let moved = point[i] + offset;
        if F::zero() < offset {
            moved.offset_ulps(1)
        } else if offset < F::zero() {
            moved.offset_ulps(-1)
        } else {
            moved
        }
    })
}
