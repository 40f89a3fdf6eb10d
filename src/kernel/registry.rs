//! The one table of built-in kernels.

use super::{Builtin, Kernel, KernelInfo, Subject};
use crate::arith::Float;

/// A row: a kernel in both scalars.
pub struct Entry {
    /// What it is and what it promises.
    pub info: &'static KernelInfo,
    f32: &'static dyn Subject<f32>,
    f64: &'static dyn Subject<f64>,
}

const fn row<K: Kernel>() -> Entry {
    Entry {
        info: &const { K::INFO },
        f32: const { &Builtin::<K>::SUBJECT },
        f64: const { &Builtin::<K>::SUBJECT },
    }
}

/// Every built-in kernel, in the order of reports.
pub static KERNELS: &[Entry] = &[
    row::<super::plane_unit_normal::PlaneUnitNormal>(),
    row::<super::half_space::HalfSpace>(),
    row::<super::scalar_triple::ScalarTriple>(),
    row::<super::scalar_triple::ScalarTripleShared>(),
    row::<super::scalar_triple::ScalarTripleTwoSided>(),
    row::<super::cramer::Cramer>(),
    row::<super::plane_inside_out::PlaneInsideOut>(),
    row::<super::plane_inside_out::PlaneInsideOutPrecomputed>(),
    row::<super::plane_inside_out::PlaneInsideOutStrict>(),
    row::<super::plane_inside_out::ConvexPolygon>(),
    row::<super::moller_trumbore::MollerTrumbore>(),
    row::<super::moller_trumbore::MollerTrumboreCulling>(),
    row::<super::woop_watertight::WoopWatertight>(),
    row::<super::plucker::Plucker>(),
    row::<super::baldwin_weber::BaldwinWeber>(),
    row::<super::havel_herout::HavelHerout>(),
];

/// The kernel of a name.
pub fn find(name: &str) -> Option<&'static Entry> {
    KERNELS.iter().find(|entry| entry.info.name == name)
}

/// A scalar that kernels are registered in.
pub trait Scalar: Float + crate::family::Makes {
    /// The kernel of a row, in this scalar.
    fn subject(entry: &Entry) -> &dyn Subject<Self>;
}

impl Scalar for f32 {
    fn subject(entry: &Entry) -> &dyn Subject<f32> {
        entry.f32
    }
}

impl Scalar for f64 {
    fn subject(entry: &Entry) -> &dyn Subject<f64> {
        entry.f64
    }
}

/// The candidate nearest to a mistyped name, by edit distance, if one is near enough to suggest.
pub fn nearest_name<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .min()
        .filter(|(distance, candidate)| *distance <= 2.max(candidate.len() / 3))
        .map(|(_, candidate)| candidate)
}

/// Levenshtein distance in bytes.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.bytes().enumerate() {
            let substitute = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = substitute.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_each_set_has_one_epsilon_a_gate() {
        for (i, entry) in KERNELS.iter().enumerate() {
            assert!(KERNELS[..i].iter().all(|other| other.info.name != entry.info.name));
            assert!(!entry.info.epsilon_sets.is_empty());
            for set in entry.info.epsilon_sets {
                assert_eq!(set.values.len(), entry.info.gates.len(), "{}", entry.info.name);
            }
        }
    }

    #[test]
    fn a_typing_error_finds_its_kernel() {
        let names = || KERNELS.iter().map(|entry| entry.info.name);
        assert_eq!(nearest_name("moler-trumbore", names()), Some("moller-trumbore"));
        assert_eq!(nearest_name("woop", names()), None);
        assert_eq!(nearest_name("havel-heruot", names()), Some("havel-herout"));
    }
}
