//! Advice on what to type instead, after a command line that clap refuses.

use crate::case::SCENES;
use crate::family;
use crate::kernel;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Ends of the names of files that are meshes.
const MESHES: [&str; 5] = [".obj", ".ply", ".stl", ".gltf", ".glb"];

/// A line of advice about a refused command line, if there is something to say that clap does not.
pub fn advice(error: &clap::Error) -> Option<String> {
    match error.kind() {
        ErrorKind::UnknownArgument => {
            let word = text_of(error, ContextKind::InvalidArg)?;
            about_argument(&word, &usage_of(error))
        }
        ErrorKind::MissingRequiredArgument => {
            let is_list = usage_of(error).contains("hairline list");
            is_list.then(|| {
                "WHAT is kernels, families, contracts, presets, schemes or arithmetics".to_owned()
            })
        }
        _ => None,
    }
}

/// Advice about an argument that a command does not take; `usage` names the command.
fn about_argument(word: &str, usage: &str) -> Option<String> {
    let flag = word.split('=').next().unwrap_or(word);
    if flag == "--kernel-lib" || flag == "--kernel-cmd" {
        return usage.contains("hairline repair").then(|| {
            "repair changes the source of kernels that hairline knows, and cannot change a library: \
             `hairline list kernels` names those that are like yours"
                .to_owned()
        });
    }
    if word.starts_with('-') {
        return None;
    }
    let is_scene = SCENES.iter().any(|preset| preset.name == word);
    let lower = word.to_lowercase();
    let flag = if is_scene {
        "--scene"
    } else if kernel::find(word).is_some() {
        "--kernel"
    } else if family::find(word).is_some() {
        "--family"
    } else if MESHES.iter().any(|end| lower.ends_with(end)) {
        "--mesh"
    } else {
        return None;
    };
    Some(format!("'{word}' stands behind a flag: {flag} {word}"))
}

/// A part of an error that is one word.
fn text_of(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind)? {
        ContextValue::String(text) => Some(text.clone()),
        _ => None,
    }
}

/// The usage line of the command that was called.
fn usage_of(error: &clap::Error) -> String {
    match error.get(ContextKind::Usage) {
        Some(ContextValue::StyledStr(usage)) => usage.to_string(),
        _ => String::new(),
    }
}
