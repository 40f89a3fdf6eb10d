//! The cases that a command line names: families, rays in a scene, meshes and stored cases.

mod scene;
mod studied;

pub(super) use scene::{about_scene, mesh_scene, note_left_out};

use super::exit::Failure;
use super::flags::{RUNNING, again, case_count, find_family, refuse_twice};
use super::input::{corpus_files, corpus_sets, read_mesh};
use crate::audit::{CorpusSet, Source, Stock};
use crate::case::{Parameters, parse_offset, parse_power_of_two};
use crate::family::{FAMILIES, Family, MeshFamily, STRATA, Stratum};
use clap::Args;
use clap::builder::TypedValueParser;
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Cases of each family, and which, if the flags do not say.
const COUNT: u64 = 20_000;
const SEED: u64 = 1;

/// In place of the names of all families but a scene's.
const ALL_FAMILIES: &str = "all";

/// The flags that choose cases.
#[derive(Args)]
pub struct SourceArguments {
    /// f32, f64, or f32,f64
    #[arg(long, value_delimiter = ',', value_name = "SCALAR", default_value = "f32,f64", help_heading = RUNNING)]
    scalar: Vec<String>,

    /// A family of cases, or several separated by commas; all stands for every one but a scene's [default: all, or none
    /// with --scene, --mesh or --corpus]
    #[arg(long, short, value_delimiter = ',', value_name = "NAME")]
    family: Vec<String>,

    /// How many cases of each family, or of each kind of ray in a scene [default: 20000; for `epsilon` in a
    /// scene 40000]
    #[arg(
        long,
        short = 'n',
        default_value_t = COUNT,
        hide_default_value = true,
        value_name = "N",
        value_parser = case_count,
        allow_hyphen_values = true
    )]
    count: u64,

    /// Run every case of the lattice family instead of a sample
    #[arg(long, help_heading = RUNNING)]
    exhaustive: bool,

    /// Seed of the random cases
    #[arg(long, default_value_t = SEED, help_heading = RUNNING)]
    seed: u64,

    /// Multiply all positions by a power of two, as 2^-10
    #[arg(long, default_value = "1", value_name = "2^K", allow_hyphen_values = true, help_heading = RUNNING)]
    scale: String,

    /// Multiply directions by the scale too
    #[arg(long, help_heading = RUNNING)]
    scale_direction: bool,

    /// Add a vector to all positions, as 1e6:0:0
    #[arg(long, value_name = "X:Y:Z", allow_hyphen_values = true, help_heading = RUNNING)]
    offset: Option<String>,

    /// `unit`: replace each direction by its rounded unit vector
    #[arg(long, value_name = "unit", value_parser = ["unit"], hide_possible_values = true, help_heading = RUNNING)]
    direction: Option<String>,

    /// Run rays in a scene instead of families: unit, room, city or cad-mm, or what is known of yours,
    /// as extent=1000,edge=0.01..10,distance=0..2000; mesh is the scene that --mesh names.
    /// edge=0.01..0.1..10: half are smaller than 0.1; plane=generic, axis, axis-near-0, axis-0, terrain
    /// or box: how triangles lie; toward=axis or axis-plane: where rays go [without either: all kinds, told
    /// apart]; ray=generated: aimed before the origin is rounded
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,

    /// Run rays at the edges, vertices and faces of an OBJ, PLY, STL or glTF file; may be repeated
    #[arg(long, value_name = "FILE")]
    mesh: Vec<String>,

    /// Run stored cases: a JSON lines file, or a folder of them; may be repeated
    #[arg(long, value_name = "FILE|DIR", help_heading = RUNNING)]
    corpus: Vec<String>,
}

impl SourceArguments {
    /// The flags again, as a shell takes them.
    pub fn flags(&self) -> Vec<String> {
        self.flags_of(&self.family)
    }

    fn flags_of(&self, families: &[String]) -> Vec<String> {
        let scalar = (self.scalar != ["f32", "f64"]).then(|| self.scalar.join(","));
        let count = (self.count != COUNT).then(|| self.count.to_string());
        let seed = (self.seed != SEED).then(|| self.seed.to_string());
        let [scalar, count, seed] = [("--scalar", scalar), ("-n", count), ("--seed", seed)]
            .map(|(flag, it)| again(flag, &it));
        [scalar, self.case_flags(families), count, seed].concat()
    }

    /// Those of them that say which cases, but for how many of them, of which seed and scalar.
    fn case_flags(&self, families: &[String]) -> Vec<String> {
        let switch = |flag: &str, is_given: bool| Vec::from_iter(is_given.then(|| flag.to_owned()));
        let family = (!families.is_empty()).then(|| families.join(","));
        let flags = [
            again("--family", &family),
            again("--scene", &self.scene),
            again("--mesh", &self.mesh),
            again("--corpus", &self.corpus),
            again("--scale", (self.scale != "1").then_some(&self.scale)),
            again("--offset", &self.offset),
            again("--direction", &self.direction),
            switch("--exhaustive", self.exhaustive),
            switch("--scale-direction", self.scale_direction),
        ];
        flags.concat()
    }

    /// True if cases are changed.
    fn changes_cases(&self) -> bool {
        let sized = self.scale != "1" || self.scale_direction || self.offset.is_some();
        sized || self.direction.is_some()
    }

    /// True if a scene or a mesh is named.
    pub fn names_scene_or_mesh(&self) -> bool {
        self.scene.is_some() || !self.mesh.is_empty()
    }

    /// The seed, and how many cases of each family.
    pub fn seed_and_count(&self) -> (u64, u64) {
        (self.seed, self.count)
    }

    /// The sources, meshes and corpora read.
    pub fn sources(&self, quiet: bool) -> Result<Vec<Source>, Failure> {
        let (seed, count) = self.seed_and_count();
        if self.scene.is_some() && !self.mesh.is_empty() {
            return self.strata_of_mesh(quiet);
        }
        let parameters = self.parameters()?;
        if !self.corpus.is_empty() && parameters != Parameters::default() {
            let message = "--corpus cases are run as they are stored: leave out --scale, --offset and --direction";
            return Err(Failure::usage(message));
        }
        if let Some(scene) = &parameters.scene {
            self.note_what_is_missed(scene, None, quiet)?;
        }
        let mut sources = Vec::new();
        let families = self.families()?;
        if self.exhaustive && families.iter().all(|family| family.size.is_none()) {
            return Err(Failure::usage(
                "--exhaustive: only the family 'lattice' is finite",
            ));
        }
        for family in families {
            let stock = match self.exhaustive && family.size.is_some() {
                true => Stock::Whole(family),
                false => Stock::Family(family),
            };
            // Other families than those of a scene have sizes of their own.
            let is_of_scene = Stratum::named(family.name).is_some();
            let parameters = match parameters.scene.is_some() && !is_of_scene {
                true => Parameters::default(),
                false => parameters.clone(),
            };
            sources.push(Source {
                stock,
                parameters,
                seed,
                count,
            });
        }
        for (i, path) in self.mesh.iter().enumerate() {
            // Reports name a mesh by its file alone.
            let name = |path: &String| Path::new(path).file_name().map(ToOwned::to_owned);
            if self.mesh[..i].iter().any(|other| name(other) == name(path)) {
                let message = format!("--mesh: there are two files of the name of '{path}'");
                return Err(Failure::usage(message));
            }
            let family = Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path));
            let stock = Stock::Mesh(family);
            sources.push(Source {
                stock,
                parameters: parameters.clone(),
                seed,
                count,
            });
        }
        let mut seen = HashSet::new();
        for path in &self.corpus {
            for file in corpus_files(path)? {
                if !seen.insert(fs::canonicalize(&file).unwrap_or_else(|_| PathBuf::from(&file))) {
                    return Err(Failure::usage(format!("--corpus: '{file}' is given twice")));
                }
                let [others, secondary] = corpus_sets(&file)?;
                let is_empty = |set: &CorpusSet| set.f32.is_empty() && set.f64.is_empty();
                if !is_empty(&others) || is_empty(&secondary) {
                    sources.push(Source::stored(others, None));
                }
                if !is_empty(&secondary) {
                    sources.push(Source::stored(secondary, None));
                }
            }
        }
        Ok(sources)
    }

    /// The families that are named, or all that belong to the other flags. With a scene its strata run in any case, unless
    /// some of them are named.
    fn families(&self) -> Result<Vec<&'static Family>, Failure> {
        refuse_twice("--family", &self.family)?;
        let mut named: Vec<&'static Family> = Vec::new();
        for name in &self.family {
            let families = match name.as_str() {
                ALL_FAMILIES => FAMILIES.iter().collect(),
                _ => vec![find_family(name)?],
            };
            let is_known = |family: &&Family| named.iter().any(|known| known.name == family.name);
            let new: Vec<&'static Family> = families
                .into_iter()
                .filter(|family| !is_known(family))
                .collect();
            named.extend(new);
        }
        let names_others = !self.mesh.is_empty() || !self.corpus.is_empty();
        let of_scene = |family: &&Family| Stratum::named(family.name).is_some();
        match &self.scene {
            Some(_) if !named.iter().any(of_scene) => Ok(STRATA.iter().chain(named).collect()),
            None if named.is_empty() && !names_others => Ok(FAMILIES.iter().collect()),
            _ => Ok(named),
        }
    }

    fn parameters(&self) -> Result<Parameters, Failure> {
        let offset = self.offset.as_deref().map_or(Ok([0.0; 3]), parse_offset);
        Ok(Parameters {
            scale: parse_power_of_two(&self.scale)
                .map_err(|e| Failure::usage(format!("--scale: {e}")))?,
            scale_direction: self.scale_direction,
            offset: offset.map_err(|e| Failure::usage(format!("--offset: {e}")))?,
            unit_direction: self.direction.is_some(),
            mesh: None,
            scene: self.scene_to_try_kernels()?,
            kernel: None,
            instance: None,
        })
    }
}

/// The most rays at an edge or vertex: their number fits what counts them, for every kernel.
const MOST_DIRECTIONS: u64 = 65_536;

/// Reads a number of rays at each edge and vertex.
pub fn rays_at_each() -> impl TypedValueParser<Value = u64> {
    clap::value_parser!(u64).range(1..=MOST_DIRECTIONS)
}
