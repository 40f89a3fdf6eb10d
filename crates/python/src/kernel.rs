//! A function of Python's as a kernel.

use hairline::internals::case::CaseId;
use hairline::internals::family::cases_of;
use hairline::{Case, Float, KernelIn, Scalar, ScalarName, Verdict};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::{Mutex, PoisonError};

/// The function, while there is a run. It takes origin, direction, a, b, c as arrays of (n, 3), t_min and t_max as
/// (n,), and returns hit, t, u, v as arrays of (n,).
#[derive(Default)]
pub struct Function {
    answers: Mutex<Option<Py<PyAny>>>,
    /// The first error in it: it ends the run.
    error: Mutex<Option<PyErr>>,
}

impl Function {
    /// Gives it something to call.
    pub fn start(&self, answers: Py<PyAny>) {
        *lock(&self.answers) = Some(answers);
        *lock(&self.error) = None;
    }

    /// Lets go of what is called. An error if there was one.
    pub fn finish(&self) -> PyResult<()> {
        drop(lock(&self.answers).take());
        lock(&self.error).take().map_or(Ok(()), Err)
    }

    /// Ends the run: whatever is asked from now on is a miss.
    pub fn fail(&self, error: PyErr) {
        lock(&self.error).get_or_insert(error);
        drop(lock(&self.answers).take());
    }

    fn call<F: Scalar + Element>(
        &self,
        py: Python<'_>,
        cases: &[Case<F>],
        verdicts: &mut [Verdict<F>],
    ) -> PyResult<()> {
        let answers = lock(&self.answers)
            .as_ref()
            .map(|answers| answers.clone_ref(py));
        let Some(answers) = answers else {
            return Ok(());
        };
        let arguments = PyTuple::new(py, arguments(py, cases)?)?;
        let answered = answers.bind(py).call1(arguments)?;
        let (hit, t, u, v) = answered.extract::<(
            PyReadonlyArray1<'_, bool>,
            PyReadonlyArray1<'_, F>,
            PyReadonlyArray1<'_, F>,
            PyReadonlyArray1<'_, F>,
        )>()?;
        let lengths = [hit.len(), t.len(), u.len(), v.len()];
        if lengths != [cases.len(); 4] {
            return Err(PyValueError::new_err(format!("{lengths:?} answers")));
        }
        let (hit, [t, u, v]) = (hit.as_array(), [t.as_array(), u.as_array(), v.as_array()]);
        for (i, verdict) in verdicts.iter_mut().enumerate() {
            if hit[i] {
                *verdict = Verdict {
                    hit: true,
                    t: t[i],
                    u: u[i],
                    v: v[i],
                    ..*verdict
                };
            }
        }
        Ok(())
    }
}

/// The arguments of a function: origin, direction, a, b, c as arrays of (n, 3), t_min and t_max as (n,).
pub fn arguments<'py, F: Scalar + Element>(
    py: Python<'py>,
    cases: &[Case<F>],
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let vectors = (0..5).map(|k| {
        let flat: Vec<F> = cases.iter().flat_map(|case| case.vectors()[k]).collect();
        Ok(PyArray1::from_vec(py, flat)
            .reshape([cases.len(), 3])?
            .into_any())
    });
    let ends = [
        |case: &Case<F>| case.ray.t_min,
        |case: &Case<F>| case.ray.t_max,
    ]
    .map(|end| Ok(PyArray1::from_vec(py, cases.iter().map(end).collect::<Vec<F>>()).into_any()));
    vectors.chain(ends).collect()
}

/// The arguments of a case, by its id: a row for each of its triangles.
#[pyfunction]
pub fn case<'py>(py: Python<'py>, id: &str) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let id: CaseId = id
        .parse()
        .map_err(|error: hairline::Error| PyValueError::new_err(error.to_string()))?;
    if id.parameters.mesh.is_some() || id.parameters.instance.is_some() {
        let words = "is a case of a mesh or an instance: `hairline explain` takes it";
        return Err(PyValueError::new_err(format!("'{id}' {words}")));
    }
    match id.scalar {
        ScalarName::F32 => arguments(py, &cases_of::<f32>(&id).map_err(PyValueError::new_err)?.0),
        ScalarName::F64 => arguments(py, &cases_of::<f64>(&id).map_err(PyValueError::new_err)?.0),
    }
}

impl<F: Float + Scalar + Element> KernelIn<F> for &'static Function {
    fn run(&self, cases: &[Case<F>], _: &[F], verdicts: &mut [Verdict<F>]) {
        verdicts.fill(Verdict::miss(None));
        Python::attach(|py| {
            self.call(py, cases, verdicts)
                .unwrap_or_else(|error| self.fail(error));
        });
    }

    /// It has no epsilons.
    fn tells_margins(&self) -> bool {
        false
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
