//! Many cases at once, as arrays of coordinates (columns) or as a slice of cases; either way the
//! filter takes them in groups.

use super::filter::{self, SignCode};
use super::{Layer, Layers};
use crate::arith::Float;
use crate::case::Case;
use crate::truth::Truth;
#[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
use fearless_simd::{Level, Simd};
use std::error::Error;
use std::fmt;
use std::ops::Deref;

/// Cases as a structure of arrays: one column for each coordinate of o, d, a, b and c, and for t_min
/// and t_max. A `Batch<Vec<f64>>` owns its columns and takes cases one by one; a `Batch<&[f64]>`
/// looks at columns that lie elsewhere.
///
/// ```
/// use hairline_core::{Batch, Layers};
///
/// // Three rays straight down onto the triangle (0,0,0), (2,0,0), (0,2,0).
/// let [zero, one, two] = [[0.0; 3], [1.0; 3], [2.0; 3]];
/// let (down, infinity) = ([-1.0; 3], [f64::INFINITY; 3]);
/// let batch = Batch::<&[f64]>::from_columns(
///     [&[0.5, 1.0, 3.0], &[0.5, 1.0, 3.0], &one],
///     [&zero, &zero, &down],
///     [[&zero, &zero, &zero], [&two, &zero, &zero], [&zero, &two, &zero]],
///     [&zero, &infinity],
/// )?;
/// let (mut truths, mut layers) = (Vec::new(), Layers::default());
/// batch.truths(&mut truths, &mut layers);
/// let hits: Vec<_> = truths.iter().map(|truth| truth.hits_closed()).collect();
/// assert_eq!(hits, [Some(true), Some(true), Some(false)]);
/// # Ok::<(), hairline_core::UnequalColumns>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch<C> {
    /// The columns of o, d, a, b and c.
    vectors: [[C; 3]; 5],
    /// t_min and t_max.
    interval: [C; 2],
}

/// Columns of different lengths are no batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnequalColumns {
    /// The first column whose length differs, as `d.y`, or `d` where vectors lie as rows.
    pub column: &'static str,
    /// Its length, in cases.
    pub length: usize,
    /// The length of the first column.
    pub expected: usize,
}

impl UnequalColumns {
    /// An error if one of the columns has another length than the first.
    pub(super) fn check(
        names: &[&'static str],
        lengths: impl Iterator<Item = usize>,
    ) -> Result<(), UnequalColumns> {
        let mut lengths = lengths.peekable();
        let expected = lengths.peek().copied().unwrap_or(0);
        match names
            .iter()
            .zip(lengths)
            .find(|(_, length)| *length != expected)
        {
            Some((column, length)) => Err(UnequalColumns {
                column,
                length,
                expected,
            }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for UnequalColumns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let UnequalColumns {
            column,
            length,
            expected,
        } = self;
        write!(
            f,
            "column {column} has {length} cases, the first one {expected}"
        )
    }
}

impl Error for UnequalColumns {}

impl<F: Float> Batch<Vec<F>> {
    /// No cases yet.
    pub fn new() -> Self {
        Batch::default()
    }

    /// Adds a case.
    pub fn push(&mut self, case: &Case<F>) {
        for (columns, values) in self.vectors.iter_mut().zip(case.vectors()) {
            for (column, value) in columns.iter_mut().zip(values) {
                column.push(value);
            }
        }
        let [t_min, t_max] = &mut self.interval;
        t_min.push(case.ray.t_min);
        t_max.push(case.ray.t_max);
    }

    /// Forgets the cases and keeps the memory.
    pub fn clear(&mut self) {
        self.vectors
            .as_flattened_mut()
            .iter_mut()
            .chain(&mut self.interval)
            .for_each(Vec::clear);
    }
}

impl<F: Float, C: Deref<Target = [F]>> Batch<C> {
    /// From the columns of the coordinates x, y, z of each vector, and of t_min and t_max, all of one
    /// length.
    pub fn from_columns(
        origin: [C; 3],
        direction: [C; 3],
        [a, b, c]: [[C; 3]; 3],
        interval: [C; 2],
    ) -> Result<Self, UnequalColumns> {
        const NAMES: [&str; 17] = [
            "o.x", "o.y", "o.z", "d.x", "d.y", "d.z", "a.x", "a.y", "a.z", "b.x", "b.y", "b.z",
            "c.x", "c.y", "c.z", "t_min", "t_max",
        ];
        let batch = Batch {
            vectors: [origin, direction, a, b, c],
            interval,
        };
        let columns = batch.vectors.as_flattened().iter().chain(&batch.interval);
        UnequalColumns::check(&NAMES, columns.map(|column| column.len()))?;
        Ok(batch)
    }

    /// The number of cases.
    pub fn len(&self) -> usize {
        self.vectors[0][0].len()
    }

    /// True if there is no case.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A case; panics if there are no more than `index`.
    pub fn case(&self, index: usize) -> Case<F> {
        let [o, d, vertices @ ..] = self
            .vectors
            .each_ref()
            .map(|columns| columns.each_ref().map(|c| c[index]));
        Case::new(o, d, vertices).on(self.interval[0][index], self.interval[1][index])
    }

    /// The truths of all cases, in order, and counts for the layers that decided them. `truths` is
    /// cleared first.
    pub fn truths(&self, truths: &mut Vec<Truth>, layers: &mut Layers) {
        decide_all(self, truths, layers);
    }
}

/// Cases that go through the filter together.
const GROUP: usize = 32;

/// Cases that the filter can take in groups, however they are stored.
pub(super) trait StoredCases<F: Float> {
    fn count(&self) -> usize;
    /// One of them.
    fn get(&self, index: usize) -> Case<F>;
    /// The codes of a group.
    fn codes(&self, group: usize) -> [SignCode; GROUP];
    /// The layers behind the filter. They are compiled into each way of storing: a case that is handed
    /// over in memory is written in pieces that are not those in which it is read, which costs more than
    /// some of the layers.
    #[inline(never)]
    fn behind_the_filter(&self, index: usize, layers: &mut Layers) -> Truth {
        super::behind_the_filter(&self.get(index), layers)
    }
}

/// o, d, a, b, c and the ends of the interval, in the scalar of the filter. Large arrays do not go through `map`
/// without being written to memory.
#[inline(always)]
pub(super) fn widened<F: Float>(case: &Case<F>) -> ([[f64; 3]; 5], [f64; 2]) {
    let [o, d, a, b, c] = case.vectors();
    let wide = |[x, y, z]: [F; 3]| [x.to_f64(), y.to_f64(), z.to_f64()];
    let ends = [case.ray.t_min.to_f64(), case.ray.t_max.to_f64()];
    ([wide(o), wide(d), wide(a), wide(b), wide(c)], ends)
}

/// The codes of cases that are columns or rows: a loop without a branch, over as many cases at a time as a vector holds.
#[inline(always)]
fn codes_of<F: Float>(
    vectors: impl Fn(usize) -> [[F; 3]; 5],
    ends: [&[F; GROUP]; 2],
) -> [SignCode; GROUP] {
    let mut codes = [SignCode::NONE; GROUP];
    for (k, code) in codes.iter_mut().enumerate() {
        let wide = |[x, y, z]: [F; 3]| [x.to_f64(), y.to_f64(), z.to_f64()];
        let [o, d, a, b, c] = vectors(k);
        let ends = [ends[0][k].to_f64(), ends[1][k].to_f64()];
        *code = filter::compute([wide(o), wide(d), wide(a), wide(b), wide(c)]).code(ends);
    }
    codes
}

/// A group's part of a column.
#[inline(always)]
fn part<T>(column: &impl Deref<Target = [T]>, group: usize) -> &[T; GROUP] {
    &column.as_chunks::<GROUP>().0[group]
}

impl<F: Float> StoredCases<F> for [Case<F>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn get(&self, index: usize) -> Case<F> {
        self[index]
    }
    #[inline(always)]
    fn codes(&self, group: usize) -> [SignCode; GROUP] {
        let mut codes = [SignCode::NONE; GROUP];
        for (code, case) in codes.iter_mut().zip(&self.as_chunks::<GROUP>().0[group]) {
            let (vectors, ends) = widened(case);
            *code = filter::compute(vectors).code(ends);
        }
        codes
    }
    #[inline(never)]
    fn behind_the_filter(&self, index: usize, layers: &mut Layers) -> Truth {
        super::behind_the_filter(&self[index], layers)
    }
}

impl<F: Float, C: Deref<Target = [F]>> StoredCases<F> for Batch<C> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn get(&self, index: usize) -> Case<F> {
        self.case(index)
    }
    #[inline(always)]
    fn codes(&self, group: usize) -> [SignCode; GROUP] {
        let [o, d, a, b, c] = self
            .vectors
            .each_ref()
            .map(|v| v.each_ref().map(|column| part(column, group)));
        let at = |[x, y, z]: [&[F; GROUP]; 3], k: usize| [x[k], y[k], z[k]];
        let vectors = |k| [at(o, k), at(d, k), at(a, k), at(b, k), at(c, k)];
        codes_of(
            vectors,
            self.interval.each_ref().map(|column| part(column, group)),
        )
    }
}

/// Cases as rows: the vectors o, d, a, b and c of each, and the ends of its interval.
pub(super) struct RowBatch<'a, F> {
    pub vectors: [&'a [[F; 3]]; 5],
    pub interval: [&'a [F]; 2],
}

impl<F: Float> StoredCases<F> for RowBatch<'_, F> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.interval[0].len()
    }
    #[inline(always)]
    fn get(&self, index: usize) -> Case<F> {
        let ([o, d, vertices @ ..], [t_min, t_max]) = (self.vectors, self.interval);
        Case::new(o[index], d[index], vertices.map(|v| v[index])).on(t_min[index], t_max[index])
    }
    #[inline(always)]
    fn codes(&self, group: usize) -> [SignCode; GROUP] {
        let [o, d, a, b, c] = self.vectors.each_ref().map(|rows| part(rows, group));
        let vectors = |k: usize| [o[k], d[k], a[k], b[k], c[k]];
        codes_of(
            vectors,
            self.interval.each_ref().map(|column| part(column, group)),
        )
    }
}

/// The truths of stored cases, on the widest vectors that the machine has: the same operations in the same order, none
/// fused, so that no bit changes.
pub(super) fn decide_all<F: Float>(
    cases: &(impl StoredCases<F> + ?Sized),
    truths: &mut Vec<Truth>,
    layers: &mut Layers,
) {
    #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
    if let Some(avx2) = Level::new().as_avx2() {
        return avx2.vectorize(
            #[inline(always)]
            || decide_groups(cases, truths, layers),
        );
    }
    decide_groups(cases, truths, layers);
}

/// In groups of [`GROUP`] and then one by one.
#[inline(always)]
fn decide_groups<F: Float>(
    cases: &(impl StoredCases<F> + ?Sized),
    truths: &mut Vec<Truth>,
    layers: &mut Layers,
) {
    truths.clear();
    let count = cases.count();
    truths.reserve(count);
    let mut certain = 0;
    let mut take = |code: SignCode, index: usize| {
        let past = || {
            let (vectors, ends) = widened(&cases.get(index));
            filter::compute(vectors).past(ends)
        };
        truths.push(match code.truth(past) {
            Some(truth) => {
                certain += 1;
                truth
            }
            None => cases.behind_the_filter(index, layers),
        });
    };
    let groups = count / GROUP;
    for group in 0..groups {
        let codes = cases.codes(group);
        codes
            .into_iter()
            .enumerate()
            .for_each(|(k, code)| take(code, group * GROUP + k));
    }
    for index in groups * GROUP..count {
        let (vectors, ends) = widened(&cases.get(index));
        take(filter::compute(vectors).code(ends), index);
    }
    layers.count(Layer::Filter, certain);
}

#[cfg(test)]
mod tests;
