//! A kernel as a row of the tables: its description, and its code in each scalar.

use super::subject::{Own, Test};
use super::{Generic, Kernel, KernelIn, KernelInfo};
use crate::case::{Target, Triangles};
use std::ptr;

/// A row: a kernel in one or both scalars.
#[derive(Clone, Copy)]
pub struct Entry<T: Target = Triangles> {
    /// The description of the kernel, with its promise.
    pub info: &'static KernelInfo,
    /// The flag that chooses it on a command line, if not `--kernel` with its name.
    pub(super) flag: Option<&'static str>,
    pub(super) f32: Option<&'static dyn KernelIn<f32, T>>,
    pub(super) f64: Option<&'static dyn KernelIn<f64, T>>,
}

impl<T: Target> Entry<T> {
    /// A kernel of any target that runs in no scalar yet; [`Entry::new`] is the same for triangles.
    pub const fn described(info: &'static KernelInfo) -> Entry<T> {
        Entry {
            info,
            flag: None,
            f32: None,
            f64: None,
        }
    }

    /// A kernel written for every arithmetic: both scalars, margins and exact runs.
    pub const fn of<K: Kernel<T>>() -> Entry<T> {
        Entry {
            info: &const { K::INFO },
            flag: None,
            f32: Some(const { &Generic::<K, T>::SUBJECT }),
            f64: Some(const { &Generic::<K, T>::SUBJECT }),
        }
    }

    /// The same with a test in `f32`, which lives as long as the process.
    pub fn f32(self, test: impl Test<f32, T> + 'static) -> Entry<T> {
        self.with_f32(Box::leak(Box::new(Own::new(test))))
    }

    /// The same with a test in `f64`, which lives as long as the process.
    pub fn f64(self, test: impl Test<f64, T> + 'static) -> Entry<T> {
        self.with_f64(Box::leak(Box::new(Own::new(test))))
    }

    /// Notes on it, besides its verdicts; each in one line.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.f32.map_or(Vec::new(), |subject| subject.notes());
        let more = self.f64.map_or(Vec::new(), |subject| subject.notes());
        notes.extend(
            more.into_iter()
                .filter(|note| !notes.contains(note))
                .collect::<Vec<_>>(),
        );
        notes
    }

    /// Ends what it started; more verdicts start it again.
    pub fn finish(&self) {
        self.f32.into_iter().for_each(|subject| subject.finish());
        self.f64.into_iter().for_each(|subject| subject.finish());
    }

    /// The same with a subject in `f32`.
    pub const fn with_f32(self, subject: &'static dyn KernelIn<f32, T>) -> Entry<T> {
        Entry {
            f32: Some(subject),
            ..self
        }
    }

    /// The same with a subject in `f64`.
    pub const fn with_f64(self, subject: &'static dyn KernelIn<f64, T>) -> Entry<T> {
        Entry {
            f64: Some(subject),
            ..self
        }
    }

    /// The same, chosen on a command line by another flag than `--kernel` with its name.
    pub const fn chosen_by(self, flag: &'static str) -> Entry<T> {
        Entry {
            flag: Some(flag),
            ..self
        }
    }

    /// True if it shows its gates: each one's margin on a case.
    pub fn shows_gates(&self) -> bool {
        let f32 = self.f32.is_some_and(|subject| subject.gated().is_some());
        f32 || self.f64.is_some_and(|subject| subject.gated().is_some())
    }

    /// True if a study of epsilons can ask it for margins: see [`KernelIn::tells_margins`].
    pub fn tells_margins(&self) -> bool {
        self.f32.is_none_or(|subject| subject.tells_margins())
            && self.f64.is_none_or(|subject| subject.tells_margins())
    }

    /// For `f32` and for `f64`, true if it runs in that scalar.
    pub const fn scalars(&self) -> [bool; 2] {
        [self.f32.is_some(), self.f64.is_some()]
    }

    /// True if it is the same kernel with the same code.
    pub(super) fn is(&self, other: &Entry<T>) -> bool {
        // Subjects without size share their address, so that their methods count too; methods that are
        // in two places make the same kernel two, which is no harm.
        #[allow(ambiguous_wide_pointer_comparisons)]
        fn same<S: ?Sized>(a: Option<&S>, b: Option<&S>) -> bool {
            a.map(ptr::from_ref) == b.map(ptr::from_ref)
        }
        ptr::eq(self.info, other.info)
            && self.flag == other.flag
            && same(self.f32, other.f32)
            && same(self.f64, other.f64)
    }

    /// The flag that chooses it on a command line.
    pub fn selector(&self) -> String {
        self.flag
            .map_or_else(|| format!("--kernel {}", self.info.name), str::to_owned)
    }
}

impl Entry {
    /// A kernel that runs in no scalar yet: [`Entry::f32`] and [`Entry::f64`] give it its tests.
    pub const fn new(info: &'static KernelInfo) -> Entry {
        Entry::described(info)
    }
}
