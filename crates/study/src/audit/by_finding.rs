//! One slot for each class and finding: a map whose keys are few and known.

use crate::judge::{Class, Finding};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// One value for each class and finding; most slots are empty.
#[derive(Clone, Debug, PartialEq)]
pub struct ByFinding<T>(Vec<Option<Box<T>>>);

const FINDINGS: usize = Finding::ALL.len();

fn place(class: Class, finding: Finding) -> usize {
    class.number() * FINDINGS + finding as usize
}

impl<T> Default for ByFinding<T> {
    fn default() -> ByFinding<T> {
        let mut slots = Vec::new();
        slots.resize_with(Class::COUNT * FINDINGS, || None);
        ByFinding(slots)
    }
}

impl<T: Default> ByFinding<T> {
    /// The slot of a class and finding, filled with nothing yet if it was empty.
    pub fn slot(&mut self, class: Class, finding: Finding) -> &mut T {
        self.0[place(class, finding)].get_or_insert_default()
    }

    /// Adds another, slot by slot.
    pub fn merge(&mut self, other: ByFinding<T>, mut add: impl FnMut(&mut T, T)) {
        for (slot, more) in self.0.iter_mut().zip(other.0) {
            if let Some(more) = more {
                add(slot.get_or_insert_default(), *more);
            }
        }
    }
}

impl<T> ByFinding<T> {
    /// The value for a class and finding.
    pub fn get(&self, class: Class, finding: Finding) -> Option<&T> {
        self.0[place(class, finding)].as_deref()
    }

    /// All that is kept, by class, then by finding.
    pub fn iter(&self) -> impl Iterator<Item = ((Class, Finding), &T)> {
        let keys = Class::all().flat_map(|class| Finding::ALL.map(|finding| (class, finding)));
        let keyed = keys.zip(&self.0);
        keyed.filter_map(|(key, slot)| Some((key, slot.as_deref()?)))
    }

    /// All that is kept, to be changed, without the keys.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.iter_mut().filter_map(Option::as_deref_mut)
    }
}

impl<T: Serialize> Serialize for ByFinding<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.iter())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for ByFinding<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<ByFinding<T>, D::Error> {
        let kept: Vec<((Class, Finding), T)> = Vec::deserialize(from)?;
        let mut all = ByFinding::default();
        for ((class, finding), value) in kept {
            all.0[place(class, finding)] = Some(Box::new(value));
        }
        Ok(all)
    }
}
