//! One case: all that is known of it, and the verdicts around it.

use crate::kernel::numbers;
use crate::request::{Explain, Map};
use hairline::ScalarName;
use hairline::internals::audit::{Row, Unobserved};
use hairline::internals::case::{AnyScalar, CaseId};
use hairline::internals::corpus::lines::{self, AnyCase, StoredCase, bare_case};
use hairline::internals::corpus::truth_json::TruthLine;
use hairline::internals::family::{Grouping, cases_of};
use hairline::internals::map::{self, CaseVector, PixelStep};
use hairline::internals::report::explain::{self, Together};
use hairline::internals::report::page::{Paged, elements};
use hairline::{Case, Scalar};
use serde::Serialize;
use serde_json::value::RawValue;

#[derive(Serialize)]
pub struct Explained {
    title: String,
    html: String,
    scalar: ScalarName,
    triangles: Vec<Triangle>,
}

#[derive(Serialize)]
struct Triangle {
    /// Origin, direction, a, b, c, t_min, t_max.
    numbers: Vec<Option<f64>>,
    /// The case as JSON.
    case: Box<RawValue>,
    truth: TruthLine,
    /// The finding, if the kernel is wrong here.
    finding: Option<&'static str>,
    /// The kernel's answer.
    said: String,
    /// The drawing as SVG; none where there is nothing to draw.
    drawing: Option<String>,
}

#[derive(Serialize)]
pub struct MapAnswer {
    /// The kernel's side, a digit a pixel, row by row from the top.
    computed: String,
    /// The exact side.
    exact: String,
    /// Colour, meaning and number of pixels of each side.
    legends: [Vec<(String, &'static str, usize)>; 2],
    /// To the right, and upwards: the coordinate, its value in the middle, and the step.
    axes: [[String; 3]; 2],
    wrong: usize,
}

/// A map, or the case of a pixel.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Mapped {
    Map(MapAnswer),
    Case { case: String },
}

type Found<F> = (Vec<Case<F>>, Grouping);

/// The cases of an id, or the one that JSON is.
fn found(text: &str) -> Result<AnyScalar<Found<f32>, Found<f64>>, String> {
    if text.trim_start().starts_with('{') {
        let stored = lines::case_of(text.trim(), 1, "case").map_err(|error| error.to_string())?;
        let grouping = if stored.is_secondary {
            Grouping::SecondaryRay
        } else {
            Grouping::Single
        };
        return Ok(match stored.case {
            AnyScalar::F32(case) => AnyScalar::F32((vec![case], grouping)),
            AnyScalar::F64(case) => AnyScalar::F64((vec![case], grouping)),
        });
    }
    let id: CaseId = text.parse()?;
    if id.parameters.mesh.is_some() || id.parameters.instance.is_some() {
        return Err(format!(
            "'{id}' is a case of a mesh or an instance: `hairline explain` takes it"
        ));
    }
    match id.scalar {
        ScalarName::F32 => cases_of(&id).map(AnyScalar::F32),
        ScalarName::F64 => cases_of(&id).map(AnyScalar::F64),
    }
}

/// The exact answer of each triangle, fractions included.
pub fn truth(text: &str) -> Result<Vec<TruthLine>, String> {
    let line = |case: AnyCase| StoredCase::of(case).truth_line(true);
    Ok(match found(text)? {
        AnyScalar::F32((cases, _)) => cases.into_iter().map(|case| line(case.into())).collect(),
        AnyScalar::F64((cases, _)) => cases.into_iter().map(|case| line(case.into())).collect(),
    })
}

pub fn explain(asked: &Explain) -> Result<Explained, String> {
    let row = asked.kernel.row()?;
    match found(&asked.case)? {
        AnyScalar::F32(found) => explained(&asked.case, found, row),
        AnyScalar::F64(found) => explained(&asked.case, found, row),
    }
}

fn explained<F: Scalar>(name: &str, found: Found<F>, row: Row) -> Result<Explained, String> {
    row.check::<F>()?;
    let (cases, grouping) = found;
    let group = Together {
        cases: &cases,
        grouping,
        neighbours: Some(&[]),
        instance: None,
    };
    let rows = [row];
    let explanation = explain::explain(name, group, &rows);
    let (page, html) = (explanation.page(), elements(&explanation));
    let drawing = |case| map::drawing(case, &rows[0]).ok();
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    let triangles = explanation
        .triangles
        .into_iter()
        .zip(&cases)
        .map(|(part, case)| Triangle {
            numbers: numbers(case).map(finite).to_vec(),
            case: part.case,
            truth: part.truth,
            finding: part.rows.first().and_then(|row| row.finding),
            said: part
                .rows
                .first()
                .map_or(String::new(), |row| row.said.clone()),
            drawing: drawing(case),
        });
    let triangles = triangles.collect();
    Ok(Explained {
        title: page.title,
        html,
        scalar: F::NAME,
        triangles,
    })
}

pub fn map(asked: &Map) -> Result<Mapped, String> {
    let row = asked.kernel.row()?;
    match found(&asked.case)? {
        AnyScalar::F32((cases, _)) => mapped(asked, &cases[0], &row),
        AnyScalar::F64((cases, _)) => mapped(asked, &cases[0], &row),
    }
}

fn mapped<F: Scalar>(asked: &Map, case: &Case<F>, row: &Row) -> Result<Mapped, String> {
    row.check::<F>()?;
    let part =
        CaseVector::named(&asked.vary).ok_or_else(|| format!("there is no '{}'", asked.vary))?;
    if !asked.zoom.is_power_of_two() || (1 << 24) < asked.zoom {
        return Err(format!(
            "zoom: {} is not a power of two up to 2^24",
            asked.zoom
        ));
    }
    let mut grid = map::grid_of_case(case, part, None, None, asked.size)?;
    for (axis, shift) in grid.axes.iter_mut().zip(asked.shift) {
        axis.step = match axis.step {
            PixelStep::Ulps(ulps) => PixelStep::Ulps(ulps.saturating_mul(asked.zoom)),
            PixelStep::PowerOfTwo(power) => {
                PixelStep::PowerOfTwo(power + asked.zoom.trailing_zeros() as i32)
            }
        };
        // As on a picture wide enough to have that pixel.
        let wide = map::Axis {
            count: 1 << 31,
            ..*axis
        };
        axis.centre = wide.value((i64::from(shift) + (1 << 30)) as usize);
    }
    if let Some(pixel) = asked.pixel {
        let within = pixel.iter().zip(grid.size()).all(|(at, size)| *at < size);
        let at = within.then(|| map::case_at(case, &grid, pixel));
        let at = at.ok_or_else(|| "the map has no such pixel".to_owned())?;
        return Ok(Mapped::Case {
            case: bare_case(at),
        });
    }
    let map = map::of_kernel(case, row, &grid, &Unobserved)?;
    let [width, height] = map.size();
    let digits = |ink: &dyn Fn(usize) -> map::Ink| -> String {
        (0..width * height)
            .map(|pixel| char::from(b'0' + ink(pixel) as u8))
            .collect()
    };
    let legend = |legend: Vec<(map::Ink, &'static str, usize)>| {
        legend
            .into_iter()
            .map(|(ink, words, count)| (ink.name().to_owned(), words, count))
            .collect()
    };
    Ok(Mapped::Map(MapAnswer {
        computed: digits(&|pixel| map.computed(pixel)),
        exact: digits(&|pixel| map.exact(pixel)),
        legends: [legend(map.computed_legend()), legend(map.exact_legend())],
        axes: map
            .axes
            .clone()
            .map(|axis| [axis.name, axis.centre, axis.step.describe()]),
        wrong: map.wrong(),
    }))
}
