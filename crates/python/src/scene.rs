//! Rays and points at a whole mesh, exactly.

use super::check_floats;
use super::judged::{
    INSIDE, Judgements, NOT_DEFINED, ON, OUTSIDE, answer_of, arrays_of, hits_of, place_of_code,
    told,
};
use hairline::Float;
use hairline_scene::{InvalidRay, Location, Passage, Ray, Scene, Winding};
use numpy::{Element, PyArray1, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

/// No face.
const NO_FACE: i64 = -1;

/// A mesh with its tree, in one of the two scalars.
#[pyclass(frozen)]
pub struct ExactScene(AnyScene);

enum AnyScene {
    F32(Scene<f32>),
    F64(Scene<f64>),
}

/// Runs something on the scene in its scalar.
macro_rules! in_scalar {
    ($scene:expr, $it:ident => $run:expr) => {
        match $scene {
            AnyScene::F32($it) => $run,
            AnyScene::F64($it) => $run,
        }
    };
}

/// The first t, the last t, the faces, a segment or a point, crosses or touches if that is defined, and the windings
/// before and after if they are.
type Meeting = (f64, f64, Vec<u32>, bool, Option<bool>, Option<(i64, i64)>);

/// Origins, directions, and the ends of intervals: rows of three, three, one and one number.
type Columns<'py> = [Bound<'py, PyAny>; 4];

#[pymethods]
impl ExactScene {
    #[new]
    fn new(
        vertices: &Bound<'_, PyAny>,
        faces: PyReadonlyArrayDyn<'_, u32>,
        in_f32: bool,
    ) -> PyResult<ExactScene> {
        check_floats()?;
        let faces = faces.as_slice()?.as_chunks().0;
        let scene = match in_f32 {
            true => AnyScene::F32(scene_of(vertices, faces)?),
            false => AnyScene::F64(scene_of(vertices, faces)?),
        };
        Ok(ExactScene(scene))
    }

    /// The first of the nearest faces of each ray ([`NO_FACE`] for none), its t, and how many faces there are at that t.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
    ) -> PyResult<(
        Bound<'py, PyArray1<i64>>,
        Bound<'py, PyArray1<f64>>,
        Bound<'py, PyArray1<u32>>,
    )> {
        check_floats()?;
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            py.detach(|| of_all(rays.len(), |i| nearest(scene, &rays[i])))?
        });
        let faces: Vec<i64> = all.iter().map(|(face, ..)| *face).collect();
        let t: Vec<f64> = all.iter().map(|(_, t, _)| *t).collect();
        let counts: Vec<u32> = all.iter().map(|(.., count)| *count).collect();
        Ok((
            PyArray1::from_vec(py, faces),
            PyArray1::from_vec(py, t),
            PyArray1::from_vec(py, counts),
        ))
    }

    /// The judgements of the nearest hits that were answered. A face below 0 is a miss; t may be NaN, which is no t if `has_t` is
    /// false.
    fn judge<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
        faces: PyReadonlyArrayDyn<'py, i64>,
        t: PyReadonlyArrayDyn<'py, f64>,
        has_t: bool,
    ) -> PyResult<Judgements<'py>> {
        let (faces, t) = (faces.as_slice()?, t.as_slice()?);
        let answer = |i: usize| answer_of(faces[i], has_t.then(|| t[i]));
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            py.detach(|| of_all(rays.len(), |i| Ok(told(&scene.judge(&rays[i], &answer(i))?))))?
        });
        Ok(arrays_of(py, &all))
    }

    /// The judgements of answers that there is a hit, or none.
    fn judge_any<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
        hits: PyReadonlyArrayDyn<'py, bool>,
    ) -> PyResult<Judgements<'py>> {
        let hits = hits.as_slice()?;
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            py.detach(|| of_all(rays.len(), |i| Ok(told(&scene.judge_any(&rays[i], hits[i])?))))?
        });
        Ok(arrays_of(py, &all))
    }

    /// The judgements of numbers of hits.
    fn judge_count<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
        counts: PyReadonlyArrayDyn<'py, u64>,
    ) -> PyResult<Judgements<'py>> {
        let counts = counts.as_slice()?;
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            py.detach(|| of_all(rays.len(), |i| Ok(told(&scene.judge_count(&rays[i], counts[i])?))))?
        });
        Ok(arrays_of(py, &all))
    }

    /// The judgements of all hits: a ray, a face and a t for each hit, those of a ray in their order.
    fn judge_hits<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
        ray: PyReadonlyArrayDyn<'py, i64>,
        faces: PyReadonlyArrayDyn<'py, u32>,
        t: PyReadonlyArrayDyn<'py, f64>,
        has_t: bool,
    ) -> PyResult<Judgements<'py>> {
        let t = has_t.then(|| t.as_slice()).transpose()?;
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            let named = hits_of(rays.len(), ray.as_slice()?, faces.as_slice()?, t);
            py.detach(|| of_all(rays.len(), |i| Ok(told(&scene.judge_hits(&rays[i], &named[i])?))))?
        });
        Ok(arrays_of(py, &all))
    }

    /// The judgements of places of points, by their codes.
    fn judge_place<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        places: PyReadonlyArrayDyn<'py, i8>,
    ) -> PyResult<Judgements<'py>> {
        let places = places.as_slice()?;
        let place = |i: usize| place_of_code(places[i]);
        let all = in_scalar!(&self.0, scene => {
            let points = rows(points)?;
            py.detach(|| of_all(points.len(), |i| Ok(told(&scene.judge_place(points[i], place(i))?))))?
        });
        Ok(arrays_of(py, &all))
    }

    /// The first ray as an SVG, with a face and a t that a program answered, if it answered; none if there is no face to draw.
    fn picture(
        &self,
        columns: Columns<'_>,
        answer: Option<(i64, Option<f64>)>,
    ) -> PyResult<Option<String>> {
        check_floats()?;
        let answer = answer.map(|(face, t)| answer_of(face, t));
        in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            let mut pictures = of_all(1, |i| hairline_rays::pictured(scene, &rays[i], answer))?;
            Ok(pictures.swap_remove(0).map(|picture| picture.file()))
        })
    }

    /// The codes of the places of points, and the winding numbers (0 where they are not defined).
    fn locate<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<i64>>)> {
        check_floats()?;
        let all = in_scalar!(&self.0, scene => {
            let points = rows(points)?;
            py.detach(|| of_all(points.len(), |i| Ok(place_of(&scene.locate(points[i])?))))?
        });
        let places: Vec<i8> = all.iter().map(|(place, _)| *place).collect();
        let windings: Vec<i64> = all.iter().map(|(_, winding)| *winding).collect();
        Ok((
            PyArray1::from_vec(py, places),
            PyArray1::from_vec(py, windings),
        ))
    }

    /// Everything that the first ray meets, in order.
    fn meetings(&self, columns: Columns<'_>) -> PyResult<Vec<Meeting>> {
        check_floats()?;
        in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            of_all(rays.len(), |i| meetings(scene, &rays[i])).map(|mut all| all.swap_remove(0))
        })
    }

    /// A face with an edge where the surface is open; none if it is closed.
    fn open_at(&self) -> Option<u32> {
        in_scalar!(&self.0, scene => scene.closed().even.err().map(|edge| edge.face))
    }
}

fn scene_of<F: Float + Element>(
    vertices: &Bound<'_, PyAny>,
    faces: &[[u32; 3]],
) -> PyResult<Scene<F>> {
    let vertices = rows::<F>(vertices)?;
    Scene::new(&vertices, faces).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Rows of three numbers.
fn rows<F: Float + Element>(column: &Bound<'_, PyAny>) -> PyResult<Vec<[F; 3]>> {
    let array = column.extract::<PyReadonlyArrayDyn<'_, F>>()?;
    Ok(array.as_slice()?.as_chunks().0.to_vec())
}

fn rays<F: Float + Element>(
    [origin, direction, t_min, t_max]: Columns<'_>,
) -> PyResult<Vec<Ray<F>>> {
    let (origins, directions) = (rows::<F>(&origin)?, rows::<F>(&direction)?);
    let t_min = t_min.extract::<PyReadonlyArrayDyn<'_, F>>()?;
    let t_max = t_max.extract::<PyReadonlyArrayDyn<'_, F>>()?;
    let ends = t_min.as_slice()?.iter().zip(t_max.as_slice()?);
    let lines = origins.into_iter().zip(directions);
    let ray = |((origin, direction), (t_min, t_max)): (([F; 3], [F; 3]), (&F, &F))| {
        Ray::new(origin, direction).on(*t_min, *t_max)
    };
    Ok(lines.zip(ends).map(ray).collect())
}

/// An answer about each of so many, on all cores; an error names the first that means nothing.
fn of_all<R: Send>(
    count: usize,
    of_one: impl Fn(usize) -> Result<R, InvalidRay> + Sync,
) -> PyResult<Vec<R>> {
    check_floats()?;
    let found: Result<Vec<R>, (usize, InvalidRay)> = (0..count)
        .into_par_iter()
        .map(|index| of_one(index).map_err(|error| (index, error)))
        .collect();
    found.map_err(|(index, error)| PyValueError::new_err(format!("row {index}: {error}")))
}

fn nearest<F: Float>(scene: &Scene<F>, ray: &Ray<F>) -> Result<(i64, f64, u32), InvalidRay> {
    let Some(nearest) = scene.nearest(ray)? else {
        return Ok((NO_FACE, f64::NAN, 0));
    };
    let face = nearest.faces[0];
    let t = match nearest.t.is_exact() {
        true => nearest.t.lower,
        false => scene.t(ray, face)?.map_or(f64::NAN, |[first, _]| first),
    };
    Ok((face.into(), t, nearest.faces.len() as u32))
}

fn place_of(location: &Location) -> (i8, i64) {
    let number = |winding: &Winding| match winding {
        Winding::Number(number) => *number,
        Winding::IsOdd(_) => 0,
    };
    match location {
        Location::On(_) => (ON, 0),
        Location::Off(winding) if winding.is_zero() => (OUTSIDE, number(winding)),
        Location::Off(winding) => (INSIDE, number(winding)),
        Location::NotDefined(_) => (NOT_DEFINED, 0),
    }
}

fn meetings<F: Float>(scene: &Scene<F>, ray: &Ray<F>) -> Result<Vec<Meeting>, InvalidRay> {
    let meeting = |passage: Passage| {
        let t = scene.ends(ray, &passage)?;
        let windings = match passage.around {
            Ok([Winding::Number(before), Winding::Number(after)]) => Some((before, after)),
            _ => None,
        };
        let crosses = passage.crosses().ok();
        Ok((
            t[0],
            t[1],
            passage.faces,
            passage.is_segment,
            crosses,
            windings,
        ))
    };
    scene.passages(ray)?.into_iter().map(meeting).collect()
}
