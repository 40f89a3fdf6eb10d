//! The rays that `hairline epsilon` studies, as its command line names them: those of a scene or a mesh, or cases of families
//! and stored ones.

use super::SourceArguments;
use super::scene::note_left_out;
use crate::cli::exit::Failure;
use crate::epsilon::StudiedRays;
use crate::family::Stratum;

impl SourceArguments {
    /// The flags with which `hairline epsilon` studies such cases: it takes a scene whole.
    pub fn epsilon_flags(&self) -> Vec<String> {
        let families = if self.scene.is_some() {
            &[]
        } else {
            &self.family[..]
        };
        self.flags_of(families)
    }

    /// The rays to study: those of a scene, which both scalars of the run can hold, or of the scene that a mesh is; or
    /// the families and stored cases that are named.
    pub fn studied_rays(&self, quiet: bool) -> Result<StudiedRays, Failure> {
        let is_stratum = |name: &String| Stratum::named(name).is_some();
        let strata: Vec<String> = self
            .family
            .iter()
            .filter(|name| is_stratum(name))
            .cloned()
            .collect();
        let studied = StudiedRays {
            strata,
            ..StudiedRays::default()
        };
        let other = studied.strata.len() < self.family.len() || !self.corpus.is_empty();
        if other || self.exhaustive || self.changes_cases() {
            for (flag, is_given) in [
                ("--scene", self.scene.is_some()),
                ("--mesh", !self.mesh.is_empty()),
            ] {
                if is_given {
                    let message = format!(
                        "leave out {flag}, whose rays are studied, or families, --corpus and changes to cases (--scale, \
                         --offset, --direction)"
                    );
                    return Err(Failure::usage(message));
                }
            }
            let flags = self.case_flags(&self.family).join(" ");
            return Ok(StudiedRays {
                sources: self.sources(quiet)?,
                flags,
                ..studied
            });
        }
        if !self.mesh.is_empty() {
            let (scene, mesh) = self.mesh_scene(quiet)?;
            self.note_what_is_missed(&scene, Some(&mesh), quiet)?;
            return Ok(StudiedRays {
                scene: Some(scene),
                mesh: Some(mesh),
                ..studied
            });
        }
        let (scene, unit) = self.scene()?.unwrap_or_default();
        if let Some(text) = self.scene.as_deref().filter(|_| !quiet) {
            note_left_out(&scene, text);
        }
        self.note_what_is_missed(&scene, None, quiet)?;
        let others = if self.names_kind() {
            Vec::new()
        } else {
            scene.of_all_kinds().split_off(1)
        };
        Ok(StudiedRays {
            scene: Some(scene),
            unit,
            others,
            ..studied
        })
    }
}
