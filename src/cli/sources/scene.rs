//! The scene that a command line names, by words or by a mesh: how it is read, which scalars can hold it, and what cannot
//! stand next to it.

use super::SourceArguments;
use crate::arith::ScalarName;
use crate::audit::Source;
use crate::case::{Parameters, Scene};
use crate::cli::before::note_missed_angles;
use crate::cli::exit::Failure;
use crate::cli::flags::chosen_scalars;
use crate::cli::input::read_mesh;
use crate::family::{MeshFamily, Stratum};
use crate::files::InputError;
use crate::mesh::{SceneMesh, Surface};
use std::sync::Arc;

impl SourceArguments {
    /// The scene, which a scalar of the run can hold, and its unit of length.
    pub(super) fn scene(&self) -> Result<Option<(Scene, &'static str)>, Failure> {
        let Some(text) = &self.scene else {
            return Ok(None);
        };
        self.refuse_other_cases()?;
        let (scene, unit) = Scene::parse(text).map_err(about_scene)?;
        scene
            .held_in(chosen_scalars(&self.scalar)?)
            .map_err(about_scene)?;
        Ok(Some((scene, unit)))
    }

    /// The scene as kernels are tried in it.
    pub(super) fn scene_to_try_kernels(&self) -> Result<Option<Scene>, Failure> {
        let words = self.scene.as_deref().unwrap_or_default();
        Ok(self.scene()?.map(|(scene, _)| scene.to_try_kernels(words)))
    }

    /// True if the scene's words name a kind of planes or rays.
    pub fn names_kind(&self) -> bool {
        self.scene.as_deref().is_some_and(Scene::names_kind)
    }

    /// The scene that the mesh is, and the mesh.
    pub(super) fn mesh_scene(&self, quiet: bool) -> Result<(Scene, Arc<SceneMesh>), Failure> {
        self.refuse_other_cases()?;
        let [path] = &self.mesh[..] else {
            return Err(Failure::usage("--mesh: a scene is of one mesh"));
        };
        mesh_scene(path, self.scene.as_deref(), self.scalars()?, quiet)
    }

    /// True for each scalar of the run: `f32`, `f64`. One that cannot hold the scene is left out if the other can.
    pub fn scalars(&self) -> Result<[bool; 2], Failure> {
        let chosen = chosen_scalars(&self.scalar)?;
        Ok(self.held_in(chosen).map_or(chosen, |(held, _)| held))
    }

    /// The reason for which one of the scalars is left out.
    pub fn left_out(&self) -> Result<Option<String>, Failure> {
        Ok(self
            .held_in(chosen_scalars(&self.scalar)?)
            .and_then(|(_, why)| why))
    }

    /// The scalars that can hold the scene that the words are of, and why another cannot; none without a scene.
    fn held_in(&self, chosen: [bool; 2]) -> Option<([bool; 2], Option<String>)> {
        let words = self.scene.as_ref().filter(|_| self.mesh.is_empty())?;
        Scene::parse(words).ok()?.0.held_in(chosen).ok()
    }

    /// Says, before a run of a scene, which scalar cannot hold it, and which angles its almost parallel rays do not have.
    pub(super) fn note_what_is_missed(
        &self,
        scene: &Scene,
        mesh: Option<&SceneMesh>,
        quiet: bool,
    ) -> Result<(), Failure> {
        if let Some(why) = self.left_out()?.filter(|_| !quiet) {
            eprintln!("left out: {why}");
        }
        if !quiet && self.runs(Stratum::Grazing) {
            note_missed_angles(scene, mesh, self.scalars()?, self.seed_and_count().0);
        }
        Ok(())
    }

    /// True if a stratum is named, or none is.
    fn runs(&self, stratum: Stratum) -> bool {
        let mut named = self
            .family
            .iter()
            .filter_map(|name| Stratum::named(name))
            .peekable();
        named.peek().is_none() || named.any(|other| other == stratum)
    }

    /// The strata of the scene that the mesh is.
    pub(super) fn strata_of_mesh(&self, quiet: bool) -> Result<Vec<Source>, Failure> {
        self.refuse_other_families()?;
        let (scene, mesh) = self.mesh_scene(quiet)?;
        self.note_what_is_missed(&scene, Some(&mesh), quiet)?;
        let scene = scene.to_try_kernels(self.scene.as_deref().unwrap_or_default());
        let parameters = Parameters {
            scene: Some(scene),
            ..Parameters::default()
        };
        let strata = Stratum::ALL
            .into_iter()
            .filter(|stratum| self.runs(*stratum));
        let (seed, count) = self.seed_and_count();
        let source =
            |stratum| Source::of_stratum(stratum, Some(&mesh), parameters.clone(), seed, count);
        Ok(strata.map(source).collect())
    }

    fn refuse_other_cases(&self) -> Result<(), Failure> {
        if !self.corpus.is_empty() {
            return Err(about_scene("leave out --corpus".to_owned()));
        }
        if self.changes_cases() {
            let sizes = "a scene has sizes of its own: leave out --scale, --offset and --direction";
            return Err(about_scene(sizes.to_owned()));
        }
        Ok(())
    }

    fn refuse_other_families(&self) -> Result<(), Failure> {
        match self
            .family
            .iter()
            .find(|name| Stratum::named(name).is_none())
        {
            Some(other) => Err(about_scene(format!("'{other}' is no part of a scene"))),
            None => Ok(()),
        }
    }
}

/// Says which lengths of a scene its words leave out.
pub fn note_left_out(scene: &Scene, text: &str) {
    if let Some(left) = scene.left_out(text) {
        eprintln!("note: --scene does not say {left}: these are those of `unit`, times the extent");
    }
}

/// An error about `--scene`.
pub fn about_scene(message: String) -> Failure {
    Failure::usage(format!("--scene: {message}"))
}

/// The scene that a mesh is, with what words say of its rays, and the mesh, in some scalars.
pub fn mesh_scene(
    path: &str,
    words: Option<&str>,
    scalars: [bool; 2],
    quiet: bool,
) -> Result<(Scene, Arc<SceneMesh>), Failure> {
    let words = words.unwrap_or("mesh");
    // What is wrong with the words shows before a large mesh is read.
    Scene::default().of_mesh(words).map_err(about_scene)?;
    let family = Arc::new(MeshFamily::new(read_mesh(path, quiet)?, path));
    let mesh = SceneMesh::new(Surface::new(family, scalars));
    for name in ScalarName::among(scalars) {
        if in_named_scalar!(name, F => mesh.face_count::<F>()) == 0 {
            let message = format!("no triangle has an area in {name}");
            return Err(InputError::of(path, message).into());
        }
    }
    let scene = mesh.scene().of_mesh(words).map_err(about_scene)?;
    for name in ScalarName::among(scalars) {
        let held = in_named_scalar!(name, F => scene.check_range_in::<F>());
        held.map_err(|error| InputError::of(path, error))?;
    }
    Ok((scene, Arc::new(mesh)))
}
