//! The flags that choose slab tests, and the boxes and rays for them.

use crate::cli::exit::Failure;
use crate::cli::flags::{RUNNING, chosen_scalars, unknown};
use crate::cli::input::read_mesh;
use crate::cli::plugins::PluginArguments;
use crate::kernel::EpsilonText;
use clap::Args;
use hairline_boxes::{BoxEntry, FAMILIES, Family, Scene, Setup, Source, TABLE, Tree, find_family};
use hairline_rays::mesh_label;

/// Which slab tests, with which epsilons.
#[derive(Args)]
pub struct TestArguments {
    /// A slab test, or several separated by commas [default: all]; NAME+ARITHMETIC runs it in another arithmetic
    #[arg(
        short = 'k',
        long = "kernel",
        value_delimiter = ',',
        value_name = "NAME"
    )]
    tests: Vec<String>,

    /// An epsilon of a gate for all of them, as growth=-3*EPSILON or padding=-1e-6
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "GATE=VALUE",
        allow_hyphen_values = true
    )]
    epsilon: Vec<String>,

    #[command(flatten)]
    plugins: PluginArguments,
}

impl TestArguments {
    /// Each chosen test with each of its published epsilons, or with the one that is named.
    pub fn setups(&self) -> Result<Vec<Setup>, Failure> {
        let mut setups = Vec::new();
        for entry in self.entries()? {
            let mut published = Setup::published(entry);
            if !self.epsilon.is_empty() {
                published.truncate(1);
            }
            for setup in published {
                setups.push(self.with_epsilons(setup)?);
            }
        }
        Ok(setups)
    }

    /// The tests of the user's own and the named ones; without any name those of the user's own alone, if there are some.
    fn entries(&self) -> Result<Vec<&'static BoxEntry>, Failure> {
        let mut entries = self.plugins.slab_tests()?;
        if self.tests == ["all"] || self.tests.is_empty() && entries.is_empty() {
            return Ok(TABLE.all());
        }
        let names = || TABLE.all().into_iter().map(|entry| entry.info.name);
        let find = |name: &String| {
            let wrong = || unknown("slab test", name, names(), "hairline boxes list tests");
            TABLE.find(name).ok_or_else(wrong)
        };
        for entry in self.tests.iter().map(find) {
            entries.push(entry?);
        }
        Ok(entries)
    }

    fn with_epsilons(&self, setup: Setup) -> Result<Setup, Failure> {
        let mut setup = setup;
        for given in &self.epsilon {
            let parts = given.split_once('=');
            let value = parts.and_then(|(_, value)| EpsilonText::of(value));
            let (Some((gate, _)), Some(value)) = (parts, value) else {
                let message =
                    format!("--epsilon: '{given}' is no GATE=VALUE, as growth=-3*EPSILON");
                return Err(Failure::usage(message));
            };
            setup = setup.with(gate, value).map_err(Failure::usage)?;
        }
        Ok(setup)
    }
}

/// Which boxes and rays.
#[derive(Args)]
pub struct CaseArguments {
    /// A family of boxes, or several separated by commas [default: all]
    #[arg(short, long, value_delimiter = ',', value_name = "NAME")]
    family: Vec<String>,

    /// Boxes and rays of a program's sizes in place of families: coordinates lie within this. The rays are aimed at corners,
    /// edges and faces
    #[arg(
        long,
        value_name = "LENGTH",
        requires = "size",
        conflicts_with = "family"
    )]
    extent: Option<f64>,

    /// The longest side of such a box
    #[arg(long, value_name = "LENGTH", requires = "extent")]
    size: Option<f64>,

    /// The boxes of a mesh in place of families: those of its faces and of the nodes of a hierarchy over them (OBJ, PLY, STL or
    /// glTF)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["family", "extent"])]
    mesh: Option<String>,

    /// How many rays of each family, of these sizes, or of the mesh
    #[arg(short = 'n', long, default_value_t = 10_000, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub count: u64,

    /// Seed of the draws
    #[arg(long, default_value_t = 1, help_heading = RUNNING)]
    pub seed: u64,

    /// f32 or f64 [default: both]
    #[arg(long, value_delimiter = ',', value_name = "SCALAR", help_heading = RUNNING)]
    scalar: Vec<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N", help_heading = RUNNING)]
    pub threads: Option<usize>,
}

impl CaseArguments {
    /// Where the cases come from.
    pub fn sources(&self, is_quiet: bool) -> Result<Vec<Source>, Failure> {
        if let Some(path) = &self.mesh {
            let tree = tree(path, is_quiet)?;
            return Ok(vec![Source::Mesh(Box::leak(Box::new(tree)))]);
        }
        if let (Some(extent), Some(size)) = (self.extent, self.size) {
            let scene = Scene::new(extent, size).map_err(Failure::usage)?;
            return Ok(vec![Source::Scene(scene)]);
        }
        if self.family.is_empty() {
            return Ok(FAMILIES.iter().map(Source::Family).collect());
        }
        let find = |name: &String| found_family(name).map(Source::Family);
        self.family.iter().map(find).collect()
    }

    /// The chosen scalars: `f32`, `f64`.
    pub fn scalars(&self) -> Result<[bool; 2], Failure> {
        if self.scalar.is_empty() {
            return Ok([true; 2]);
        }
        chosen_scalars(&self.scalar)
    }
}

/// The boxes of a mesh, by the name of its file, the number of its faces and a digest.
fn tree(path: &str, is_quiet: bool) -> Result<Tree, Failure> {
    let mesh = read_mesh(path, is_quiet)?;
    let triangles: Vec<_> = (0..mesh.triangles.len())
        .map(|i| mesh.vertices(i))
        .collect();
    Tree::new(mesh_label(&mesh), &triangles).map_err(Failure::bad_input)
}

fn found_family(name: &str) -> Result<&'static Family, Failure> {
    let names = FAMILIES.iter().map(|family| family.name);
    find_family(name).map_err(|_| unknown("family", name, names, "hairline boxes list families"))
}
