//! A function of Python's as a kernel.

use hairline::{Case, Float, Scalar, Subject, Verdict};
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
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
        let answers = lock(&self.answers).as_ref().map(|answers| answers.clone_ref(py));
        let Some(answers) = answers else { return Ok(()) };
        let rows = |k: usize| -> PyResult<_> {
            let flat: Vec<F> = cases.iter().flat_map(|case| case.vectors()[k]).collect();
            PyArray1::from_vec(py, flat).reshape([cases.len(), 3])
        };
        let ends = |end: fn(&Case<F>) -> F| {
            PyArray1::from_vec(py, cases.iter().map(end).collect::<Vec<F>>())
        };
        let [o, d, a, b, c]: [Bound<'_, PyArray2<F>>; 5] =
            [rows(0)?, rows(1)?, rows(2)?, rows(3)?, rows(4)?];
        let (t_min, t_max) = (ends(|case| case.ray.t_min), ends(|case| case.ray.t_max));
        let answered = answers.bind(py).call1((o, d, a, b, c, t_min, t_max))?;
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
                *verdict = Verdict { hit: true, t: t[i], u: u[i], v: v[i], ..*verdict };
            }
        }
        Ok(())
    }
}

impl<F: Float + Scalar + Element> Subject<F> for &'static Function {
    fn run(&self, cases: &[Case<F>], _: &[F], verdicts: &mut [Verdict<F>]) {
        verdicts.fill(Verdict::miss(None));
        Python::attach(|py| {
            self.call(py, cases, verdicts).unwrap_or_else(|error| self.fail(error));
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
