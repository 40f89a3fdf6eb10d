//! Audits of functions of Python's.

use super::check_floats;
use super::kernel::Function;
use hairline::internals::contract::Contract;
use hairline::internals::record::{FindingPart, PlanFlags, Record};
use hairline::internals::report::page::Paged;
use hairline::internals::report::{Format, Style, severity};
use hairline::{Entry, Error, Gives, KernelInfo, Outcome, Request};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// A request, its options checked for their types alone.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    name: String,
    /// The flag that chooses it on a command line; none if no command can.
    selector: String,
    /// True if it reports t, and if u and v.
    gives: (bool, bool),
    in_f32: bool,
    contract: String,
    families: Option<Vec<String>>,
    count: u64,
    scene: Option<String>,
    seed: u64,
    band: Option<String>,
    allow: BTreeMap<String, f64>,
    /// The flags that choose the cases on a command line.
    sources: String,
    /// Those with which `hairline epsilon` studies such cases.
    epsilon: String,
}

/// The outcome of an audit.
#[pyclass(frozen)]
pub struct Audited {
    request: Request,
    function: &'static Function,
    answers: Py<PyAny>,
    outcome: Outcome,
}

/// Audits a function; see [`Function`].
#[pyfunction]
pub fn audit(py: Python<'_>, answers: Py<PyAny>, asked: Asked) -> PyResult<Audited> {
    check_floats()?;
    // An entry lives as long as the process; the function itself does not.
    let function: &'static Function = Box::leak(Box::default());
    let flags = PlanFlags {
        kernels: asked.selector.clone(),
        sources: asked.sources.clone(),
        epsilon: Some(asked.epsilon.clone()),
    };
    let request = request(asked, function).map_err(PyValueError::new_err)?;
    let mut outcome = running(py, function, &answers, || request.run())?;
    if !flags.kernels.is_empty() {
        outcome.record.provenance.plan_flags = Some(flags);
    }
    Ok(Audited {
        request,
        function,
        answers,
        outcome,
    })
}

fn request(asked: Asked, function: &'static Function) -> Result<Request, String> {
    let contract = Contract::from_words(&asked.contract, None)
        .map_err(|error| format!("contract: {error}"))?;
    let (t, uv) = asked.gives;
    let info: &'static KernelInfo = Box::leak(Box::new(KernelInfo {
        source: "a function in Python",
        gives: Gives {
            t,
            uv,
            facing: false,
        },
        ..KernelInfo::own(asked.name.leak(), contract)
    }));
    let subject: &'static &'static Function = Box::leak(Box::new(function));
    let entry = Entry::new(info).chosen_by(asked.selector.leak());
    let entry = if asked.in_f32 {
        entry.with_f32(subject)
    } else {
        entry.with_f64(subject)
    };
    let mut request = hairline::audit(&entry)
        .count(asked.count)
        .seed(asked.seed)
        .attribute(100);
    if let Some(scene) = &asked.scene {
        request = request.scene(scene);
        // As the program: a scene that names its kind is run in that one.
        if !hairline::internals::case::Scene::names_kind(scene) {
            request = request.all_kinds();
        }
    }
    if let Some(families) = asked.families {
        request = request.families(families);
    }
    if let Some(band) = &asked.band {
        request = request.band(band);
    }
    Ok(asked
        .allow
        .iter()
        .fold(request, |request, (finding, share)| {
            request.allow(finding, *share)
        }))
}

/// Does something with the function on another thread, while this one waits for Ctrl-C.
fn running<T: Send>(
    py: Python<'_>,
    function: &'static Function,
    answers: &Py<PyAny>,
    work: impl FnOnce() -> Result<T, Error> + Send,
) -> PyResult<T> {
    function.start(answers.clone_ref(py));
    let worked = py.detach(|| {
        thread::scope(|scope| {
            let (done, end) = channel::<()>();
            let work = scope.spawn(move || {
                let _dropped_at_the_end = done;
                work()
            });
            while let Err(RecvTimeoutError::Timeout) = end.recv_timeout(Duration::from_millis(50)) {
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    function.fail(error);
                }
            }
            work.join()
        })
    });
    function.finish()?;
    worked
        .map_err(|_| PyRuntimeError::new_err("hairline itself failed: please report it"))?
        .map_err(|error| PyValueError::new_err(error.to_string()))
}

#[pymethods]
impl Audited {
    /// The screen of `hairline audit`.
    fn text(&self, details: bool) -> PyResult<String> {
        self.written(
            Format::TEXT,
            Style {
                details,
                ..Style::default()
            },
        )
    }

    /// The page of `hairline audit --format html`, without maps.
    fn html(&self) -> PyResult<String> {
        self.written(Format::HTML, Style::default())
    }

    /// The record of `hairline audit --format json`.
    fn json(&self) -> PyResult<String> {
        self.written(Format::JSON, Style::default())
    }

    /// The verdict in a sentence.
    fn title(&self) -> String {
        self.outcome.record.page().title
    }

    fn conforms(&self) -> bool {
        self.outcome.conforms()
    }

    /// By how far the worst of each finding is wrong, in longest edges of the triangle; none where that is no distance.
    fn distances(&self) -> Vec<Option<f64>> {
        let distance = |part: &FindingPart| part.worst.severity.as_ref().map(|_| severity(part));
        self.outcome.findings().map(distance).collect()
    }

    /// The broken promises, each with its first cases.
    fn complaint(&self) -> String {
        self.outcome.to_string()
    }

    /// A case and the function's answer to it, as `hairline explain` shows them.
    fn explain(&self, py: Python<'_>, case: &str) -> PyResult<String> {
        running(py, self.function, &self.answers, || {
            self.request.explain(case)
        })
    }

    /// The function's verdicts around a case, as SVG.
    fn map(&self, py: Python<'_>, case: &str) -> PyResult<String> {
        running(py, self.function, &self.answers, || self.request.map(case))
    }
}

impl Audited {
    fn written(&self, format: Format<Record>, style: Style) -> PyResult<String> {
        let mut text = Vec::new();
        (format.write)(&self.outcome.record, style, &mut text)?;
        Ok(String::from_utf8(text)?)
    }
}
