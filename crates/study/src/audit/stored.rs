//! Plans and sums as data, so that the parts of a run can be added up by another process.

use super::plan::Plan;
use super::row::{Row, RowSpec};
use super::run::Audit;
use super::source::Source;
use crate::case::{Matrix, Parameters};
use crate::family;
use crate::judge::Class;
use serde::{Deserialize, Serialize};

/// A plan with names for what is built in, and paths for what is not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredPlan {
    rows: Vec<RowSpec>,
    sources: Vec<StoredSource>,
    scalars: [bool; 2],
    examples: usize,
    attribute: usize,
}

/// A source that can be opened again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum StoredSource {
    /// A family's set.
    Family {
        /// The family's name.
        family: String,
        /// As in case ids.
        parameters: String,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
        /// Every case of a finite family.
        exhaustive: bool,
    },
    /// Rays at a mesh.
    Mesh {
        /// The mesh's file.
        path: String,
        /// As in case ids.
        parameters: String,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
    },
    /// Groups at the edges or vertices of a mesh.
    MeshPart {
        /// The mesh's file.
        path: String,
        /// `mesh-edges` or `mesh-vertices`.
        part: String,
        /// As in case ids.
        parameters: String,
        /// The seed of the set.
        seed: u64,
        /// Rays at each edge or vertex.
        directions: u64,
    },
    /// A stratum of the scene that a mesh is.
    SceneMesh {
        /// Its path.
        path: String,
        /// The stratum's family.
        stratum: String,
        /// The parameters of the rays.
        parameters: String,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
    },
    /// Stored cases.
    Corpus {
        /// Their file.
        file: String,
        /// True for the cases that start on their triangle, false for the others.
        #[serde(default)]
        is_secondary: bool,
        /// Where their triangles are put.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        instance: Option<Matrix<f64>>,
    },
}

impl StoredPlan {
    /// The stored form of a plan.
    pub fn of(plan: &Plan) -> StoredPlan {
        StoredPlan {
            rows: plan.rows.iter().map(Row::spec).collect(),
            sources: plan.sources.iter().map(StoredSource::of).collect(),
            scalars: plan.scalars,
            examples: plan.examples,
            attribute: plan.attribute,
        }
    }

    /// The plan again; `open` reads meshes, in the scalars of the run, and corpora.
    pub fn plan<E: From<String>>(
        &self,
        mut open: impl FnMut(&StoredSource, [bool; 2]) -> Result<Source, E>,
    ) -> Result<Plan, E> {
        let sources = self.sources.iter().map(|source| match source.family()? {
            Some(source) => Ok(source),
            None => open(source, self.scalars),
        });
        Ok(Plan {
            sources: sources.collect::<Result<_, E>>()?,
            rows: self.rows.iter().map(RowSpec::row).collect::<Result<_, _>>().map_err(|e| e.0)?,
            scalars: self.scalars,
            examples: self.examples,
            attribute: self.attribute,
        })
    }
}

impl StoredSource {
    fn of(source: &Source) -> StoredSource {
        match source {
            Source::Family { family, parameters, seed, count, exhaustive } => {
                StoredSource::Family {
                    family: family.name.to_owned(),
                    parameters: parameters.to_string(),
                    seed: *seed,
                    count: *count,
                    exhaustive: *exhaustive,
                }
            }
            Source::Mesh { family, parameters, seed, count } => StoredSource::Mesh {
                path: family.path().to_owned(),
                parameters: parameters.to_string(),
                seed: *seed,
                count: *count,
            },
            Source::MeshPart { surface, part, parameters, seed, directions } => {
                StoredSource::MeshPart {
                    path: surface.path().to_owned(),
                    part: part.name().to_owned(),
                    parameters: parameters.to_string(),
                    seed: *seed,
                    directions: *directions,
                }
            }
            Source::SceneMesh { mesh, stratum, parameters, seed, count } => {
                StoredSource::SceneMesh {
                    path: mesh.surface().path().to_owned(),
                    stratum: stratum.family().name.to_owned(),
                    parameters: parameters.to_string(),
                    seed: *seed,
                    count: *count,
                }
            }
            Source::Corpus(set) => StoredSource::Corpus {
                file: set.file.clone(),
                is_secondary: set.is_secondary,
                instance: set.instance,
            },
        }
    }

    /// A family, which needs no file.
    fn family(&self) -> Result<Option<Source>, String> {
        let StoredSource::Family { family, parameters, seed, count, exhaustive } = self else {
            return Ok(None);
        };
        let found = family::find(family).ok_or_else(|| format!("unknown family '{family}'"))?;
        let parameters: Parameters = parameters.parse()?;
        let (seed, count, exhaustive) = (*seed, *count, *exhaustive);
        Ok(Some(Source::Family { family: found, parameters, seed, count, exhaustive }))
    }
}

impl Audit {
    /// Adds another part of the same run; both as they are before [`super::finish`].
    pub fn merge(&mut self, other: Audit) -> Result<(), String> {
        let layout = |audit: &Audit| -> Vec<_> {
            audit.cells.iter().map(|cell| (cell.scalar, cell.source, cell.row)).collect()
        };
        let sources =
            |audit: &Audit| audit.sources.iter().map(|s| (s.scalar, s.source)).collect::<Vec<_>>();
        let whole =
            |audit: &Audit| audit.cells.iter().all(|cell| cell.tally.classes.len() == Class::COUNT);
        let same = layout(self) == layout(&other) && sources(self) == sources(&other);
        if !same || !whole(self) || !whole(&other) {
            return Err("the sums are not of the same plan".to_owned());
        }
        for (summary, more) in self.sources.iter_mut().zip(&other.sources) {
            summary.merge(more);
        }
        for (cell, more) in self.cells.iter_mut().zip(other.cells) {
            cell.tally.merge(more.tally);
            cell.nanoseconds += more.nanoseconds;
        }
        Ok(())
    }
}
