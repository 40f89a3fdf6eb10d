//! The rays or points that a program is asked about.

use super::Text;
use super::line::{is_head, json_number, numbers};
use crate::files::InputError;
use crate::files::json::{self, Object};
use crate::kernel::Scalar;
use hairline_scene::Ray;

/// The form of a ray, for messages.
const RAY: &str = "origin and direction as six numbers, or eight with t_min and t_max";

/// The rays of a file. An error names the line and what is wrong in it.
pub fn rays<F: Scalar>(text: Text) -> Result<Vec<Ray<F>>, InputError> {
    text.one_a_line("rays", is_head, |line| {
        let ray = match line.chars().next() {
            Some('{') => ray_of_json(line)?,
            Some('[') => {
                return Err(
                    "expected a ray a line, not an array: {\"origin\":[0,0,5],\"direction\":[0,0,-1]}"
                        .to_owned(),
                );
            }
            _ => ray_of_words(line)?,
        };
        ray.check().map_err(|error| error.to_string())?;
        Ok(ray)
    })
}

/// The points of a file.
pub fn points<F: Scalar>(text: Text) -> Result<Vec<[F; 3]>, InputError> {
    text.one_a_line("points", is_head, |line| {
        let numbers = numbers(line)?;
        let count = numbers.len();
        let point = <[F; 3]>::try_from(numbers)
            .map_err(|_| format!("expected three numbers of a point, found {count}"))?;
        match point.iter().all(|x| x.is_finite()) {
            true => Ok(point),
            false => Err("the point has a coordinate that is not finite".to_owned()),
        }
    })
}

/// A ray as numbers: `0,0,5 0,0,-1`.
pub fn ray_of_words<F: Scalar>(text: &str) -> Result<Ray<F>, String> {
    let numbers = numbers::<F>(text)?;
    let (&[ox, oy, oz, dx, dy, dz], interval) = numbers
        .split_first_chunk()
        .ok_or_else(|| format!("expected {RAY}, found {}", numbers.len()))?;
    let ray = Ray::new([ox, oy, oz], [dx, dy, dz]);
    match interval {
        [] => Ok(ray),
        [t_min, t_max] => Ok(ray.on(*t_min, *t_max)),
        _ => Err(format!("expected {RAY}, found {}", numbers.len())),
    }
}

fn ray_of_json<F: Scalar>(line: &str) -> Result<Ray<F>, String> {
    let object = Object::parse(line, &["origin", "direction", "t_min", "t_max"])?;
    let vector = |field: &str| -> Result<[F; 3], String> {
        let [x, y, z] = json::array(object.required(field)?, "numbers")?;
        Ok([json_number(x)?, json_number(y)?, json_number(z)?])
    };
    let ray = Ray::new(vector("origin")?, vector("direction")?);
    let t_min = object.read("t_min", json_number)?.unwrap_or(ray.t_min);
    let t_max = object.read("t_max", json_number)?.unwrap_or(ray.t_max);
    Ok(ray.on(t_min, t_max))
}
