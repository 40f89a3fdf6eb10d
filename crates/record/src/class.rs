//! The subject of a finding: a class of truths of single triangles, or triangles together.

use crate::judge::Class;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// The subject of a finding, by which it is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FindingClass {
    /// Single triangles whose truths are of a class.
    Truth(Class),
    /// The triangles of a group together.
    Group,
    /// Whole polygons.
    Polygon,
    /// All classes together.
    Any,
}

impl FindingClass {
    /// The name in records and lock files: `edge/front/within`, `group`.
    pub fn name(self) -> &'static str {
        match self {
            FindingClass::Truth(class) => class.name(),
            FindingClass::Group => "group",
            FindingClass::Polygon => "polygon",
            FindingClass::Any => "any class",
        }
    }

    /// The class of truths; none of triangles together.
    pub fn truth(self) -> Option<Class> {
        match self {
            FindingClass::Truth(class) => Some(class),
            FindingClass::Group | FindingClass::Polygon | FindingClass::Any => None,
        }
    }
}

impl FromStr for FindingClass {
    type Err = String;

    fn from_str(name: &str) -> Result<FindingClass, String> {
        let of_truths = Class::all().map(FindingClass::Truth);
        let others = [
            FindingClass::Group,
            FindingClass::Polygon,
            FindingClass::Any,
        ];
        of_truths
            .chain(others)
            .find(|class| class.name() == name)
            .ok_or_else(|| format!("a class of findings, not '{name}'"))
    }
}

impl fmt::Display for FindingClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// By name: the order of lines in files.
impl Ord for FindingClass {
    fn cmp(&self, other: &FindingClass) -> Ordering {
        self.name().cmp(other.name())
    }
}

impl PartialOrd for FindingClass {
    fn partial_cmp(&self, other: &FindingClass) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Serialize for FindingClass {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for FindingClass {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<FindingClass, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse()
            .map_err(|expected| de::Error::custom(format!("expected {expected}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_has_a_name_of_its_own_that_leads_back_to_it() {
        let mut names = Vec::new();
        for class in Class::all().map(FindingClass::Truth) {
            assert_eq!(class.name().parse(), Ok(class));
            names.push(class.name());
        }
        names.sort();
        names.dedup();
        assert_eq!(names.len(), Class::COUNT);
        assert_eq!("group".parse(), Ok(FindingClass::Group));
        let wrong: Result<FindingClass, String> = "edge".parse();
        assert!(wrong.unwrap_err().ends_with("not 'edge'"));
    }
}
