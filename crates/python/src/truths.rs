//! The exact truths of arrays of cases.

use super::check_floats;
use hairline::{Case, ContactKind, Facing, Feature, Float, Layers, Place, Truth, truths};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Cases that are looked at together: they stay in the cache.
const BLOCK: usize = 256;

/// Bytes of a truth: class, facing, place, feature, the sign of t, and whether it is a hit.
const FIELDS: usize = 6;

/// Does not apply.
const NONE: u8 = 255;

/// A contact along a segment, after all features.
const SEGMENT: u8 = Feature::ALL.len() as u8;

const CLASSES: [&str; 5] = ["transversal", "parallel", "coplanar", "degenerate", "invalid"];

/// The names of the numbers in each field.
#[pyfunction]
pub fn names() -> BTreeMap<&'static str, Vec<&'static str>> {
    let features = Feature::ALL.map(Feature::name).into_iter().chain(["segment"]);
    BTreeMap::from([
        ("class", CLASSES.to_vec()),
        ("facing", Facing::ALL.map(Facing::name).to_vec()),
        ("place", Place::ALL.map(Place::name).to_vec()),
        ("feature", features.collect()),
    ])
}

/// The truths of `count` cases as bytes, [`FIELDS`] each. `columns` are origin, direction, a, b, c of three numbers a case,
/// t_min and t_max of one; or of one case, for all.
#[pyfunction]
pub fn truth<'py>(
    py: Python<'py>,
    columns: [Bound<'py, PyAny>; 7],
    count: usize,
    in_f32: bool,
) -> PyResult<Bound<'py, PyArray1<u8>>> {
    check_floats()?;
    match in_f32 {
        true => truth_in::<f32>(py, columns, count),
        false => truth_in::<f64>(py, columns, count),
    }
}

fn truth_in<'py, F: Float + Element>(
    py: Python<'py>,
    columns: [Bound<'py, PyAny>; 7],
    count: usize,
) -> PyResult<Bound<'py, PyArray1<u8>>> {
    let arrays = columns.each_ref().map(|column| column.extract::<PyReadonlyArrayDyn<'py, F>>());
    let arrays = arrays.into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut columns = [const { Column::<F> { numbers: &[], step: 0 } }; 7];
    for (i, (array, column)) in arrays.iter().zip(&mut columns).enumerate() {
        let width = if i < 5 { 3 } else { 1 };
        let numbers = array.as_slice()?;
        if numbers.len() != width && numbers.len() != width * count {
            return Err(PyValueError::new_err("columns of different lengths"));
        }
        *column = Column { numbers, step: if numbers.len() == width { 0 } else { width } };
    }
    let bytes = PyArray1::<u8>::zeros(py, count * FIELDS, false);
    {
        let mut bytes = bytes.try_readwrite()?;
        let bytes = bytes.as_slice_mut()?;
        py.detach(|| decide(&columns, bytes));
    }
    Ok(bytes)
}

/// The numbers of a vector or an end, and how many numbers lie from one case to the next.
struct Column<'a, F> {
    numbers: &'a [F],
    step: usize,
}

impl<F: Float> Column<'_, F> {
    fn vector(&self, index: usize) -> [F; 3] {
        *self.numbers[index * self.step..].first_chunk().expect("three numbers a case")
    }

    fn end(&self, index: usize) -> F {
        self.numbers[index * self.step]
    }
}

fn decide<F: Float>([o, d, a, b, c, t_min, t_max]: &[Column<'_, F>; 7], bytes: &mut [u8]) {
    let case = |i: usize| {
        let triangle = [a.vector(i), b.vector(i), c.vector(i)];
        Case::new(o.vector(i), d.vector(i), triangle).on(t_min.end(i), t_max.end(i))
    };
    let blocks = bytes.par_chunks_mut(BLOCK * FIELDS).enumerate();
    let empty = || (Vec::new(), Vec::new(), Layers::default());
    blocks.for_each_init(empty, |(cases, found, layers), (block, bytes)| {
        cases.clear();
        cases.extend((block * BLOCK..).take(bytes.len() / FIELDS).map(case));
        truths(cases, found, layers);
        for (truth, bytes) in found.iter().zip(bytes.as_chunks_mut::<FIELDS>().0) {
            *bytes = code(truth);
        }
    });
}

fn code(truth: &Truth) -> [u8; FIELDS] {
    let hit = u8::from(truth.hits_closed() == Some(true));
    let (class, [facing, place, feature], t_sign) = match truth {
        Truth::Transversal(crossing) => {
            let feature = feature(crossing.feature);
            (0, [crossing.facing as u8, crossing.place as u8, feature], crossing.t_sign as i8)
        }
        Truth::Parallel => (1, [NONE; 3], 0),
        Truth::Coplanar(contact) => (2, [NONE, NONE, touched(contact.kind)], 0),
        Truth::Degenerate(contact) => (3, [NONE, NONE, touched(contact.kind)], 0),
        Truth::Invalid => (4, [NONE; 3], 0),
    };
    [class, facing, place, feature, t_sign as u8, hit]
}

fn touched(kind: ContactKind) -> u8 {
    match kind {
        ContactKind::None => feature(Feature::Outside),
        ContactKind::Point(at) => feature(at),
        ContactKind::Segment => SEGMENT,
    }
}

/// Its place among all.
fn feature(feature: Feature) -> u8 {
    feature as u8
}
