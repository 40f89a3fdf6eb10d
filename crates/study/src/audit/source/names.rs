//! The names of a source: in tables, in the ids of its cases, and the flags of a command that makes a case again.

use super::{Source, Stock};
use crate::arith::Float;
use crate::audit::row::quoted;
use crate::case::{CaseId, Matrix, SceneKind};
use crate::family::Stratum;
use crate::mesh::AimedPart;
use crate::printable::printable;

/// True if a source of this name in tables makes its cases from a mesh.
pub fn is_of_mesh(name: &str) -> bool {
    name.split_once(':').is_some_and(|(kind, file)| {
        kind == "mesh"
            || AimedPart::named(kind).is_some()
            || Stratum::named(kind).is_some() && SceneKind::named(file).is_none()
    })
}

/// The kind of planes and rays of the scene whose source has this name in tables; the generic one of other sources.
pub fn kind_of(name: &str) -> SceneKind {
    let kind = name
        .split_once(':')
        .and_then(|(_, kind)| SceneKind::named(kind));
    kind.unwrap_or(SceneKind::ALL[0])
}

/// A matrix as `--instance` takes it.
pub fn words(matrix: &Matrix<f64>) -> String {
    matrix
        .as_flattened()
        .iter()
        .map(f64::to_string)
        .collect::<Vec<_>>()
        .join(" ")
}

impl Source {
    /// The name in tables: one line, whatever a file is called.
    pub fn name(&self) -> String {
        let name = match &self.stock {
            Stock::Family(family) | Stock::Whole(family) => match &self.parameters.scene {
                Some(scene) if scene.kind() != SceneKind::ALL[0] => {
                    format!("{}:{}", family.name, scene.kind())
                }
                _ => family.name.to_owned(),
            },
            Stock::Mesh(family) => format!("mesh:{}", family.file_name()),
            Stock::MeshPart(surface, part) => {
                format!("{}:{}", part.name(), surface.family().file_name())
            }
            Stock::SceneMesh(mesh, stratum) => {
                format!(
                    "{}:{}",
                    stratum.family().name,
                    mesh.surface().family().file_name()
                )
            }
            Stock::Corpus(set) if set.is_secondary => format!("corpus-secondary:{}", set.file),
            Stock::Corpus(set) => format!("corpus:{}", set.file),
        };
        printable(&name)
    }

    /// The id of a case, or of triangle k of a group.
    pub fn id<F: Float>(&self, index: u64, triangle: Option<usize>) -> String {
        let Source {
            parameters, seed, ..
        } = self;
        let id = match &self.stock {
            Stock::Whole(family) => {
                // In its natural order the lattice has a name of its own: `lattice-all@1/f32/-/0/17`,
                // whose seed is always 0.
                let mut id = family.id::<F>(parameters, 0, index);
                id.family = format!("{}-all", family.name);
                id
            }
            Stock::Family(family) => family.id::<F>(parameters, *seed, index),
            Stock::Mesh(family) => family.id::<F>(parameters, *seed, index),
            Stock::MeshPart(surface, part) => surface.id::<F>(*part, parameters, *seed, index),
            Stock::SceneMesh(_, stratum) => stratum.family().id::<F>(parameters, *seed, index),
            Stock::Corpus(set) => return set.get::<F>(index).0.to_owned(),
        };
        CaseId { triangle, ..id }.to_string()
    }

    /// The words after `hairline explain` that show a case again.
    pub fn explain_arguments<F: Float>(&self, index: u64, triangle: Option<usize>) -> String {
        let id = quoted(&self.id::<F>(index, triangle));
        match self.file_flag() {
            Some(flag) => format!("{id} {flag}"),
            None => id,
        }
    }

    /// The flag that names the file from which an id makes its case; none of families.
    pub fn file_flag(&self) -> Option<String> {
        let Stock::Corpus(set) = &self.stock else {
            return self
                .mesh()
                .map(|family| format!("--mesh {}", quoted(family.path())));
        };
        let instance = self.parameters.instance.as_ref();
        let instance = instance.map(|matrix| format!(" --instance {}", quoted(&words(matrix))));
        Some(format!(
            "--corpus {}{}",
            quoted(&set.file),
            instance.unwrap_or_default()
        ))
    }
}
