//! Plans and sums as data, so that the parts of a run can be added up by another process.

use super::plan::Plan;
use super::row::{Row, RowSpec};
use super::run::Audit;
use super::source::{Source, Stock};
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
    measured: usize,
    places: usize,
}

/// A source that can be opened again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredSource {
    /// The stock.
    pub stock: StoredStock,
    /// As in case ids.
    pub parameters: String,
    /// The seed of the set.
    pub seed: u64,
    /// How many indices.
    pub count: u64,
}

/// A stock by names and paths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StoredStock {
    /// A family.
    Family(String),
    /// Every case of a finite family.
    Whole(String),
    /// Rays at a mesh.
    Mesh(String),
    /// Groups at the part of a mesh, `mesh-edges` or `mesh-vertices`.
    MeshPart(String, String),
    /// The family of a stratum, of the scene that a mesh is.
    SceneMesh(String, String),
    /// The stored cases of a file: those that start on their triangle, or the others.
    Corpus(String, bool),
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
            measured: plan.measured,
            places: plan.places,
        }
    }

    /// The plan again; `open` reads meshes, in the scalars of the run, and corpora.
    pub fn plan<E: From<String>>(
        &self,
        mut open: impl FnMut(&StoredStock, [bool; 2]) -> Result<Stock, E>,
    ) -> Result<Plan, E> {
        let mut open = |stock: &StoredStock| open(stock, self.scalars);
        let sources = self.sources.iter().map(|source| source.open(&mut open));
        Ok(Plan {
            sources: sources.collect::<Result<_, E>>()?,
            rows: self
                .rows
                .iter()
                .map(RowSpec::row)
                .collect::<Result<_, _>>()
                .map_err(String::from)?,
            scalars: self.scalars,
            examples: self.examples,
            attribute: self.attribute,
            measured: self.measured,
            places: self.places,
        })
    }
}

impl StoredSource {
    fn of(source: &Source) -> StoredSource {
        let stock = match &source.stock {
            Stock::Family(family) => StoredStock::Family(family.name.to_owned()),
            Stock::Whole(family) => StoredStock::Whole(family.name.to_owned()),
            Stock::Mesh(family) => StoredStock::Mesh(family.path().to_owned()),
            Stock::MeshPart(surface, part) => {
                StoredStock::MeshPart(surface.family().path().to_owned(), part.name().to_owned())
            }
            Stock::SceneMesh(mesh, stratum) => {
                let stratum = stratum.family().name.to_owned();
                StoredStock::SceneMesh(mesh.surface().family().path().to_owned(), stratum)
            }
            Stock::Corpus(set) => StoredStock::Corpus(set.file.clone(), set.is_secondary),
        };
        let Source {
            parameters,
            seed,
            count,
            ..
        } = source;
        StoredSource {
            stock,
            parameters: parameters.to_string(),
            seed: *seed,
            count: *count,
        }
    }

    /// The source again; `open` reads what is in a file.
    fn open<E: From<String>>(
        &self,
        open: &mut impl FnMut(&StoredStock) -> Result<Stock, E>,
    ) -> Result<Source, E> {
        let found =
            |name: &str| family::find(name).ok_or_else(|| format!("unknown family '{name}'"));
        let stock = match &self.stock {
            StoredStock::Family(name) => Stock::Family(found(name)?),
            StoredStock::Whole(name) => Stock::Whole(found(name)?),
            stock => open(stock)?,
        };
        let parameters = self.parameters.parse().map_err(String::from)?;
        Ok(Source {
            stock,
            parameters,
            seed: self.seed,
            count: self.count,
        })
    }
}

impl Audit {
    /// Adds another part of the same run; both as they are before [`super::finish`].
    pub fn merge(&mut self, other: Audit) -> Result<(), String> {
        let layout = |audit: &Audit| -> Vec<_> {
            audit
                .cells
                .iter()
                .map(|cell| (cell.scalar, cell.source, cell.row))
                .collect()
        };
        let sources = |audit: &Audit| {
            audit
                .sources
                .iter()
                .map(|s| (s.scalar, s.source))
                .collect::<Vec<_>>()
        };
        let whole = |audit: &Audit| {
            audit
                .cells
                .iter()
                .all(|cell| cell.tally.classes.len() == Class::COUNT)
        };
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
