//! The inputs of a map: a case, points, or standard ones.

use super::MapArguments;
use crate::case::Case;
use crate::cli::case::CaseArguments;
use crate::cli::exit::Failure;
use crate::cli::flags::{is_f32, unknown};
use crate::cli::orient::points_of_id;
use crate::corpus::InputError;
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::map::{self, Spot};
use crate::orientation::points_json::{self, AnyPoints};
use crate::orientation::{Dimension, PointsId, find_known};

/// The case or the points that are mapped.
pub enum Input {
    Case(AnyCase),
    /// Points, and which of them is varied by default.
    Points(AnyPoints, usize),
}

impl MapArguments {
    /// The case or the points.
    pub(super) fn input(&self) -> Result<Input, Failure> {
        let Some(text) = &self.case else { return self.standard() };
        if self.corpus.is_some() {
            return self.case(text);
        }
        let text = text.trim();
        if text.starts_with('{') && points_json::is_points(text) {
            let points = points_json::parse(text)
                .map_err(|message| InputError::at("argument", 1, message))?;
            let last = either_scalar!(points, points => points.dimension().number());
            return Ok(Input::Points(points, last));
        }
        if let Some(known) = find_known(text) {
            let points = known.points();
            return Ok(Input::Points(AnyPoints::F64(points), points.dimension().number()));
        }
        if Dimension::ALL
            .iter()
            .any(|dimension| text.starts_with(&format!("{}:", dimension.name())))
        {
            let id: PointsId = text.parse().map_err(|error: String| Failure::usage(error))?;
            let last = id.dimension.number();
            let points = match is_f32(&id.scalar, &format!(" in '{id}'"))? {
                true => AnyPoints::F32(points_of_id(&id)?),
                false => AnyPoints::F64(points_of_id(&id)?),
            };
            return Ok(Input::Points(points, last));
        }
        self.case(text)
    }

    fn case(&self, text: &str) -> Result<Input, Failure> {
        let case = CaseArguments {
            case: text.to_owned(),
            mesh: self.mesh.clone(),
            corpus: self.corpus.clone(),
        };
        either_scalar!(case.cases()?, group => Ok(Input::Case((*one(&group.cases, text)?).into())))
    }

    /// The input of `--at`.
    fn standard(&self) -> Result<Input, Failure> {
        let name = self.at.as_deref().unwrap_or(Spot::Edge.name());
        let scalar = |default| is_f32(self.scalar.as_deref().unwrap_or(default), "");
        if let Some(spot) = Spot::named(name) {
            return Ok(match scalar("f32")? {
                true => Input::Case(AnyCase::F32(spot.case())),
                false => Input::Case(AnyCase::F64(spot.case())),
            });
        }
        let dimension = match name {
            "collinear" => Dimension::Two,
            "coplanar" => Dimension::Three,
            _ => {
                let names = Spot::ALL.map(Spot::name).into_iter().chain(["collinear", "coplanar"]);
                return Err(unknown("spot", name, names, "hairline map --help"));
            }
        };
        Ok(if scalar("f64")? {
            let (points, point) = map::standard_points(dimension);
            Input::Points(AnyPoints::F32(points), point)
        } else {
            let (points, point) = map::standard_points(dimension);
            Input::Points(AnyPoints::F64(points), point)
        })
    }
}

/// The one triangle of a case.
fn one<'a, F: Scalar>(cases: &'a [Case<F>], name: &str) -> Result<&'a Case<F>, Failure> {
    match cases {
        [case] => Ok(case),
        _ => Err(Failure::usage(format!(
            "'{name}' has {} triangles: say which, as {name}.0 to {name}.{}",
            cases.len(),
            cases.len() - 1
        ))),
    }
}
