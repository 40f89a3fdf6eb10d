//! The exact truths of arrays of cases.

use super::check_floats;
use hairline::{ContactKind, Facing, Feature, Float, Layers, Place, Truth, truths_of_rows};
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

const CLASSES: [&str; 5] = [
    "transversal",
    "parallel",
    "coplanar",
    "degenerate",
    "invalid",
];

/// The names of the numbers in each field.
#[pyfunction]
pub fn names() -> BTreeMap<&'static str, Vec<&'static str>> {
    let features = Feature::ALL
        .map(Feature::name)
        .into_iter()
        .chain(["segment"]);
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
    let arrays = columns
        .each_ref()
        .map(|column| column.extract::<PyReadonlyArrayDyn<'py, F>>());
    let arrays = arrays.into_iter().collect::<Result<Vec<_>, _>>()?;
    let numbers = |k: usize| Ok::<_, PyErr>(arrays[k].as_slice()?);
    let vector = |k| Column::new(numbers(k)?.as_chunks().0, count);
    let [o, d, a, b, c] = [vector(0)?, vector(1)?, vector(2)?, vector(3)?, vector(4)?];
    let ends = [
        Column::new(numbers(5)?, count)?,
        Column::new(numbers(6)?, count)?,
    ];
    let bytes = PyArray1::<u8>::zeros(py, count * FIELDS, false);
    {
        let mut bytes = bytes.try_readwrite()?;
        let bytes = bytes.as_slice_mut()?;
        py.detach(|| decide(&[o, d, a, b, c], &ends, bytes));
    }
    Ok(bytes)
}

/// A vector or an end of each case.
enum Column<'a, T> {
    Each(&'a [T]),
    /// The same in every case: as many as a block has.
    All([T; BLOCK]),
}

impl<'a, T: Copy> Column<'a, T> {
    fn new(items: &'a [T], count: usize) -> PyResult<Self> {
        match items {
            [all] => Ok(Column::All([*all; BLOCK])),
            _ if items.len() == count => Ok(Column::Each(items)),
            _ => Err(PyValueError::new_err("columns of different lengths")),
        }
    }

    /// So many from some case on.
    fn block(&self, start: usize, count: usize) -> &[T] {
        match self {
            Column::Each(items) => &items[start..][..count],
            Column::All(items) => &items[..count],
        }
    }
}

fn decide<F: Float>(
    vectors: &[Column<'_, [F; 3]>; 5],
    ends: &[Column<'_, F>; 2],
    bytes: &mut [u8],
) {
    let blocks = bytes.par_chunks_mut(BLOCK * FIELDS).enumerate();
    let empty = || (Vec::new(), Layers::default());
    blocks.for_each_init(empty, |(found, layers), (block, bytes)| {
        let (start, count) = (block * BLOCK, bytes.len() / FIELDS);
        let vectors = vectors.each_ref().map(|column| column.block(start, count));
        let ends = ends.each_ref().map(|end| end.block(start, count));
        truths_of_rows(vectors, ends, found, layers).expect("columns of one length");
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
            (
                0,
                [crossing.facing as u8, crossing.place as u8, feature],
                crossing.t_sign as i8,
            )
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
