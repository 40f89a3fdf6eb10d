//! The tables of kernels, one a target: the built-in ones, and those that a program adds.

use super::changed::{Change, Changed, InDouble, WithFallback, has_size, sized};
use super::entry::Entry;
use super::{Gate, KernelIn, KernelInfo, Role};
use crate::arith::{Arithmetic, Float};
use crate::case::{Target, Triangles};
use crate::contract::{Contract, Extent, Sides};
use std::sync::{Mutex, PoisonError, RwLock};

impl Entry {
    /// True if a program has it without adding it, in whatever arithmetic.
    pub fn is_built_in(&self) -> bool {
        let name = self.info.name;
        let name = name_and_variant(name).map_or(name, |(kernel, _)| kernel);
        KERNELS.iter().any(|entry| entry.info.name == name)
    }
}

/// The kernels of a target.
pub struct Table<T: Target> {
    built_in: &'static [Entry<T>],
    /// The kernels that programs added to the built-in ones.
    added: RwLock<Vec<&'static Entry<T>>>,
    /// The kernels in other forms that have been requested by name so far.
    variants: RwLock<Vec<&'static Entry<T>>>,
}

impl<T: Target> Table<T> {
    /// With the built-in kernels alone.
    pub const fn new(built_in: &'static [Entry<T>]) -> Table<T> {
        Table {
            built_in,
            added: RwLock::new(Vec::new()),
            variants: RwLock::new(Vec::new()),
        }
    }

    /// Every kernel: the added ones, then the built-in ones in the order of reports.
    pub fn all(&self) -> Vec<&'static Entry<T>> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        added.iter().copied().chain(self.built_in).collect()
    }

    /// The kernel of a name; with the feature `margins` also in another arithmetic, as `moller-trumbore+fma`.
    pub fn find(&self, name: &str) -> Option<&'static Entry<T>> {
        if let Some((kernel, KernelForm::InArithmetic(arithmetic))) = name_and_variant(name) {
            return self.in_arithmetic(self.find(kernel)?, arithmetic);
        }
        let is_named = |entry: &&'static Entry<T>| entry.info.name == name;
        let added = || {
            self.added
                .read()
                .unwrap_or_else(PoisonError::into_inner)
                .iter()
                .copied()
                .find(is_named)
        };
        self.built_in.iter().find(is_named).or_else(added)
    }

    /// A kernel in an arithmetic, called `NAME+ARITHMETIC` unless that is IEEE 754's; none if the
    /// kernel is not written for every arithmetic, or is in another one already.
    pub fn in_arithmetic(
        &self,
        entry: &'static Entry<T>,
        arithmetic: Arithmetic,
    ) -> Option<&'static Entry<T>> {
        if arithmetic == Arithmetic::IEEE {
            return Some(entry);
        }
        let subjects = |info| {
            let f32 = entry.f32?.in_arithmetic(arithmetic, info)?;
            Some((Some(f32), Some(entry.f64?.in_arithmetic(arithmetic, info)?)))
        };
        let told = || Some((entry.info.contract, entry.info.gates));
        self.variant(
            entry,
            (arithmetic.name(), arithmetic.describe()),
            told,
            subjects,
        )
    }

    /// Another form of a kernel, made once; none of one that is in another form already.
    fn variant(
        &self,
        entry: &'static Entry<T>,
        (form, about): (&str, &str),
        told: impl FnOnce() -> Option<(Contract, &'static [Gate])>,
        subjects: impl FnOnce(&'static KernelInfo) -> Option<Subjects<T>>,
    ) -> Option<&'static Entry<T>> {
        let base = entry.info;
        if name_and_variant(base.name).is_some() {
            return None;
        }
        let name = format!("{}+{form}", base.name);
        let mut variants = self
            .variants
            .write()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(variant) = variants.iter().find(|variant| variant.info.name == name) {
            return Some(*variant);
        }
        let source = format!("{}; {about}", base.source);
        let (contract, gates) = told()?;
        let info: &'static KernelInfo = Box::leak(Box::new(KernelInfo {
            name: String::leak(name),
            source: String::leak(source),
            contract,
            gates,
            ..*base
        }));
        let (f32, f64) = subjects(info)?;
        let variant: &'static Entry<T> = Box::leak(Box::new(Entry {
            info,
            flag: None,
            f32,
            f64,
        }));
        variants.push(variant);
        Some(variant)
    }

    /// Adds a kernel for the rest of the process; every command then knows its name. An error if the
    /// name is empty, taken, or not a word.
    pub fn register(&self, entry: Entry<T>) -> Result<&'static Entry<T>, String> {
        let name = entry.info.name;
        check_name(name)?;
        if let Some((kernel, form)) = name_and_variant(name) {
            let form_of = match form {
                KernelForm::InArithmetic(_) => "a kernel in another arithmetic",
                KernelForm::With(_) => "a changed kernel",
            };
            let form = &name[kernel.len()..];
            return Err(format!(
                "'{name}' is no name for a kernel: {form} names {form_of}"
            ));
        }
        if self.find(name).is_some() {
            return Err(format!(
                "there are two kernels of the name '{name}' (to compare two builds, audit each with --format json, \
                 and see hairline diff)"
            ));
        }
        let entry: &'static Entry<T> = Box::leak(Box::new(entry));
        self.added
            .write()
            .unwrap_or_else(PoisonError::into_inner)
            .push(entry);
        Ok(entry)
    }
}

/// Every built-in kernel, in the order of reports.
pub static KERNELS: &[Entry] = &[
    Entry::of::<super::plane_unit_normal::PlaneUnitNormal>(),
    Entry::of::<super::half_space::HalfSpace>(),
    Entry::of::<super::scalar_triple::ScalarTriple>(),
    Entry::of::<super::scalar_triple::ScalarTripleShared>(),
    Entry::of::<super::scalar_triple::ScalarTripleTwoSided>(),
    Entry::of::<super::cramer::Cramer>(),
    Entry::of::<super::plane_inside_out::PlaneInsideOut>(),
    Entry::of::<super::plane_inside_out::PlaneInsideOutPrecomputed>(),
    Entry::of::<super::plane_inside_out::PlaneInsideOutStrict>(),
    Entry::of::<super::plane_inside_out::ConvexPolygon>(),
    Entry::of::<super::moller_trumbore::MollerTrumbore>(),
    Entry::of::<super::moller_trumbore::MollerTrumboreT>(),
    Entry::of::<super::moller_trumbore::MollerTrumboreCulling>(),
    Entry::of::<super::woop_watertight::WoopWatertight>(),
    Entry::of::<super::plucker::Plucker>(),
    Entry::of::<super::baldwin_weber::BaldwinWeber>(),
    Entry::of::<super::havel_herout::HavelHerout>(),
];

/// The kernels of triangles.
pub static TRIANGLES: Table<Triangles> = Table::new(KERNELS);

/// Every kernel: the added ones, then the built-in ones in the order of reports.
pub fn all() -> Vec<&'static Entry> {
    TRIANGLES.all()
}

/// The kernels of a run that names none: those of the program's author, if it has some, or else the built-in ones.
pub fn unnamed() -> Vec<&'static Entry> {
    // Those with a flag of their own are there by that flag alone.
    let mut all = all();
    all.retain(|entry| entry.flag.is_none());
    let is_own = |entry: &&Entry| !entry.is_built_in();
    if all.iter().any(is_own) {
        all.retain(is_own);
    }
    all
}

/// A kernel in an arithmetic, called `NAME+ARITHMETIC` unless that is IEEE 754's; none if the
/// kernel is not written for every arithmetic, or is in another one already.
pub fn in_arithmetic(entry: &'static Entry, arithmetic: Arithmetic) -> Option<&'static Entry> {
    TRIANGLES.in_arithmetic(entry, arithmetic)
}

/// The forms that a kernel has, as its name takes them after a `+`, each with its meaning.
pub fn forms(entry: &'static Entry) -> Vec<(&'static str, &'static str)> {
    let arithmetics = Arithmetic::ALL.into_iter().skip(1);
    let arithmetics = arithmetics.filter(|it| in_arithmetic(entry, *it).is_some());
    let changes = Change::ALL
        .into_iter()
        .filter(|it| changed(entry, *it).is_some());
    let changes = changes.map(|it| (it.name(), it.about()));
    arithmetics
        .map(|it| (it.name(), it.describe()))
        .chain(changes)
        .collect()
}

/// A kernel with a change around it, called `NAME+CHANGE`; none if that would change nothing, or it is in
/// another form already.
pub fn changed(entry: &'static Entry, change: Change) -> Option<&'static Entry> {
    let KernelInfo {
        contract,
        gates,
        gives,
        ..
    } = *entry.info;
    let told = || match change {
        Change::BySize if gates.iter().any(has_size) => Some((contract, sized(gates))),
        // A front-only kernel would see some triangles from behind.
        Change::Sorted if contract.sides == Sides::Both => Some((contract, gates)),
        Change::Ahead if contract.extent == Extent::Line && gives.t => Some((
            Contract {
                extent: Extent::Ray,
                ..contract
            },
            gates,
        )),
        Change::Double if entry.f32.is_some() => Some((contract, gates)),
        Change::Fallback if gates.iter().any(|gate| gate.role == Role::Edge) => {
            Some((contract, gates))
        }
        _ => None,
    };
    fn leaked<F: Float>(
        change: Change,
        gates: &'static [Gate],
        kernel: &'static dyn KernelIn<F>,
    ) -> &'static dyn KernelIn<F> {
        Box::leak(Box::new(Changed {
            change,
            gates,
            kernel,
        }))
    }
    let subjects = |_| match change {
        Change::Double => {
            let in_double: &'static dyn KernelIn<f32> = Box::leak(Box::new(InDouble(entry.f64?)));
            Some((Some(in_double), None))
        }
        Change::Fallback => {
            let (kernel, in_double) = (entry.f32?, InDouble(entry.f64?));
            let fallback = WithFallback {
                kernel,
                gated: kernel.gated()?,
                in_double,
            };
            let fallback: &'static dyn KernelIn<f32> = Box::leak(Box::new(fallback));
            Some((Some(fallback), None))
        }
        _ => Some((
            entry.f32.map(|kernel| leaked(change, gates, kernel)),
            entry.f64.map(|kernel| leaked(change, gates, kernel)),
        )),
    };
    TRIANGLES.variant(entry, (change.name(), change.about()), told, subjects)
}

/// The same kernel in both scalars, in another form.
type Subjects<T> = (
    Option<&'static dyn KernelIn<f32, T>>,
    Option<&'static dyn KernelIn<f64, T>>,
);

/// The form of a kernel that stands behind a `+` in a name.
enum KernelForm {
    InArithmetic(Arithmetic),
    With(Change),
}

/// A kernel's name, and the form of it that the name ends in, if it does.
fn name_and_variant(name: &str) -> Option<(&str, KernelForm)> {
    let (kernel, form) = name.rsplit_once('+')?;
    let arithmetic = form.parse().ok().filter(|found| *found != Arithmetic::IEEE);
    let arithmetic = arithmetic.map(KernelForm::InArithmetic);
    let form = arithmetic.or_else(|| Change::named(form).map(KernelForm::With))?;
    Some((kernel, form))
}

/// Entries that live as long as the process without being in the table.
static KEPT: Mutex<Vec<&'static Entry>> = Mutex::new(Vec::new());

/// Keeps an entry for the rest of the process; the same entry is kept once.
pub fn kept(entry: &Entry) -> &'static Entry {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all()
        .into_iter()
        .chain(kept.iter().copied())
        .find(|e| e.is(entry))
    {
        return known;
    }
    let entry = Box::leak(Box::new(*entry));
    kept.push(entry);
    entry
}

/// An error if a name is empty or not a word.
pub fn check_name(name: &str) -> Result<(), String> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "-_.+@".contains(c);
    if name.is_empty() || !name.chars().all(is_word) {
        return Err(format!(
            "'{}' is no name for a kernel: use letters, digits and -_.+@",
            name.escape_default()
        ));
    }
    Ok(())
}

/// Adds a kernel for the rest of the process; every command then knows its name. An error if the
/// name is empty, taken, or not a word.
pub fn register(entry: Entry) -> Result<&'static Entry, String> {
    TRIANGLES.register(entry)
}

/// The kernel of a name; with the feature `studies` also in another arithmetic, as `moller-trumbore+fma`, or with a
/// [`Change`], as `moller-trumbore+sorted`.
pub fn find(name: &str) -> Option<&'static Entry> {
    match name_and_variant(name) {
        Some((kernel, KernelForm::With(change))) => changed(find(kernel)?, change),
        _ => TRIANGLES.find(name),
    }
}

/// A scalar that kernels are registered in.
pub trait Scalar: Float {
    /// The kernel of a row, if it runs in this scalar.
    fn subject<T: Target>(entry: &Entry<T>) -> Option<&'static dyn KernelIn<Self, T>>;
}

impl Scalar for f32 {
    fn subject<T: Target>(entry: &Entry<T>) -> Option<&'static dyn KernelIn<f32, T>> {
        entry.f32
    }
}

impl Scalar for f64 {
    fn subject<T: Target>(entry: &Entry<T>) -> Option<&'static dyn KernelIn<f64, T>> {
        entry.f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_each_set_has_one_epsilon_a_gate() {
        for (i, entry) in KERNELS.iter().enumerate() {
            assert!(
                KERNELS[..i]
                    .iter()
                    .all(|other| other.info.name != entry.info.name)
            );
            assert!(!entry.info.epsilon_sets.is_empty());
            for set in entry.info.epsilon_sets {
                assert_eq!(
                    set.values.len(),
                    entry.info.gates.len(),
                    "{}",
                    entry.info.name
                );
            }
        }
    }
}
