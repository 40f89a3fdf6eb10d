//! Scenes by their names.

use crate::case::{SCENES, ScenePreset};

/// The preset that has exactly these sizes.
pub fn preset_of(scene: &str) -> Option<&'static ScenePreset> {
    SCENES
        .iter()
        .find(|preset| preset.scene.to_string() == scene)
}

/// A scene in a sentence: its name, or its sizes with room to break lines.
pub fn named_scene(scene: &str) -> String {
    match preset_of(scene) {
        Some(preset) => preset.name.to_owned(),
        None => scene.replace(',', ", "),
    }
}
