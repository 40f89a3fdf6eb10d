//! Rays and points at a whole mesh, exactly.

use super::check_floats;
use hairline::Float;
use hairline_scene::{Answer, InvalidRay, Judgement, Location, Passage, Ray, Scene, Winding};
use numpy::{Element, PyArray1, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

/// The names of judgements, in the order of their codes.
const JUDGEMENTS: [(Judgement, &str); 7] = [
    (Judgement::Right, "right"),
    (Judgement::Tie, "tie"),
    (Judgement::Neighbour, "neighbour"),
    (Judgement::WrongT, "wrong_t"),
    (Judgement::Lost, "lost"),
    (Judgement::Farther, "farther"),
    (Judgement::Ghost, "ghost"),
];

/// Codes of places.
const OUTSIDE: i8 = 0;
const INSIDE: i8 = 1;
const ON: i8 = 2;
const NOT_DEFINED: i8 = 3;

/// No face.
const NO_FACE: i64 = -1;

/// The names of judgements, in the order of their codes.
#[pyfunction]
pub fn judgements() -> Vec<&'static str> {
    JUDGEMENTS.iter().map(|(_, name)| *name).collect()
}

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
            py.detach(|| of_all(&rays, |ray| nearest(scene, ray)))?
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

    /// The codes of the judgements of answers, and how far each lies behind the exact point, in longest edges (NaN where that
    /// is not known). A face below 0 is a miss; t may be NaN, which is no t if `has_t` is false.
    fn judge<'py>(
        &self,
        py: Python<'py>,
        columns: Columns<'py>,
        faces: PyReadonlyArrayDyn<'py, i64>,
        t: PyReadonlyArrayDyn<'py, f64>,
        has_t: bool,
    ) -> PyResult<(Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<f64>>)> {
        check_floats()?;
        let (faces, t) = (faces.as_slice()?, t.as_slice()?);
        let answer = |index: usize| Answer {
            face: u32::try_from(faces[index]).ok(),
            t: has_t.then(|| t[index]),
        };
        let all = in_scalar!(&self.0, scene => {
            let rays = rays(columns)?;
            let indexed: Vec<_> = rays.into_iter().enumerate().collect();
            py.detach(|| {
                of_all(&indexed, |(index, ray)| {
                    let judged = scene.judge(ray, &answer(*index))?;
                    Ok((code_of(judged.judgement), judged.off.unwrap_or(f64::NAN)))
                })
            })?
        });
        let codes: Vec<u8> = all.iter().map(|(code, _)| *code).collect();
        let behind: Vec<f64> = all.iter().map(|(_, behind)| *behind).collect();
        Ok((
            PyArray1::from_vec(py, codes),
            PyArray1::from_vec(py, behind),
        ))
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
            py.detach(|| of_all(&points, |point| Ok(place_of(&scene.locate(*point)?))))?
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
            of_all(&rays, |ray| meetings(scene, ray)).map(|mut all| all.swap_remove(0))
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

/// An answer about each, on all cores; an error names the first that means nothing.
fn of_all<T: Sync, R: Send>(
    all: &[T],
    of_one: impl Fn(&T) -> Result<R, InvalidRay> + Sync,
) -> PyResult<Vec<R>> {
    let indexed = all.par_iter().enumerate();
    let found: Result<Vec<R>, (usize, InvalidRay)> = indexed
        .map(|(index, one)| of_one(one).map_err(|error| (index, error)))
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
        false => scene
            .values(ray, face)?
            .map_or(f64::NAN, |values| values.t[0]),
    };
    Ok((face.into(), t, nearest.faces.len() as u32))
}

fn code_of(judgement: Judgement) -> u8 {
    let place = JUDGEMENTS.iter().position(|(its, _)| *its == judgement);
    place.expect("every judgement of a nearest hit has a name") as u8
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
