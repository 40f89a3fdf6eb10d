//! The points of an orientation predicate as one JSON object.

use super::Points;
use crate::arith::Float;
use crate::case::AnyScalar;
use crate::corpus::{case_json, json};

/// Points in the scalar that they were written for.
pub type AnyPoints = AnyScalar<Points<f32>, Points<f64>>;

/// Three points of the plane or four of space from `{"scalar":"f64","points":[[x,y],...]}`; numbers as
/// in the files of cases.
pub fn parse(text: &str) -> Result<AnyPoints, String> {
    let text = json::tidied(text);
    let object = json::Object::parse(&text, &["scalar", "points"])?;
    let (is_f32, points) = (object.is_f32()?, object.required("points")?);
    match is_f32 {
        true => parse_points(points).map(AnyPoints::F32),
        false => parse_points(points).map(AnyPoints::F64),
    }
}

/// True if an object has a field `points`, which no case has.
pub fn is_points(text: &str) -> bool {
    json::pairs(&json::tidied(text))
        .is_ok_and(|fields| fields.iter().any(|(name, _)| name == "points"))
}

fn parse_points<F: Float>(value: &str) -> Result<Points<F>, String> {
    match json::elements(value).map(Iterator::count) {
        Some(3) => Ok(Points::two(rows::<F, 3, 2>(value)?)),
        Some(4) => Ok(Points::three(rows::<F, 4, 3>(value)?)),
        _ => Err(format!(
            "points: expected 3 points of 2 numbers or 4 of 3, found {}",
            json::excerpt(value)
        )),
    }
}

fn rows<F: Float, const N: usize, const M: usize>(value: &str) -> Result<[[F; M]; N], String> {
    let mut rows = [[F::zero(); M]; N];
    let points = json::array::<N>(value, "points").map_err(|m| format!("points: {m}"))?;
    for (i, (row, point)) in rows.iter_mut().zip(points).enumerate() {
        let numbers =
            json::array::<M>(point, "numbers").map_err(|m| format!("points[{i}]: {m}"))?;
        for (j, (x, number)) in row.iter_mut().zip(numbers).enumerate() {
            *x = case_json::parse_number(format_args!("points[{i}][{j}]"), number)?;
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_as_they_are_written() {
        let plane = parse(r#"{"scalar":"f64","points":[[0.5,"0x1p-1"],[12,12],[24,24.5]]}"#);
        let expected = Points::two([[0.5, 0.5], [12.0, 12.0], [24.0, 24.5]]);
        assert_eq!(plane, Ok(AnyPoints::F64(expected)));
        let space = r#"{"points":[[1,0,0],[0,1,0],[0,0,1],[0,0,0]],"scalar":"f32"}"#;
        assert!(matches!(parse(space), Ok(AnyPoints::F32(points)) if points.iter().count() == 4));
    }

    #[test]
    fn a_wrong_object_is_told_by_its_field() {
        for (text, part) in [
            ("{}", "missing field 'scalar'"),
            (r#"{"scalar":"f64"}"#, "missing field 'points'"),
            (r#"{"scalar":"f16","points":[]}"#, "none of f32, f64"),
            (r#"{"scalar":"f64","points":[[0,0]]}"#, "expected 3 points of 2 numbers or 4 of 3"),
            (r#"{"scalar":"f64","points":7}"#, "expected 3 points"),
            (r#"{"scalar":"f64","points":[[0,0],[1],[2,2]]}"#, "points[1]: expected 2 numbers"),
            (r#"{"scalar":"f64","points":[[0,0],[1,true],[2,2]]}"#, "points[1][1]: expected"),
            (r#"{"scalar":"f64","points":[[0,0],[1,1],[2,2]],"x":0}"#, "unknown field"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.contains(part), "{text}: {message}");
        }
    }
}
