//! Advice on what to type instead, after a command line that clap refuses.

use crate::case::SCENES;
use crate::family;
use crate::kernel;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;

/// Ends of the names of files that are meshes.
const MESHES: [&str; 5] = [".obj", ".ply", ".stl", ".gltf", ".glb"];

/// A line of advice about refused words of a program, if there is something to say that clap does not.
pub fn advice(error: &clap::Error, program: &clap::Command, words: &[OsString]) -> Option<String> {
    let command = called(program, words);
    match error.kind() {
        ErrorKind::UnknownArgument => match error.get(ContextKind::InvalidArg)? {
            ContextValue::String(argument) => about_argument(argument, command),
            _ => None,
        },
        ErrorKind::MissingRequiredArgument => choices(command),
        _ => None,
    }
}

/// The command that words call: the innermost one of a program.
fn called<'a>(program: &'a clap::Command, words: &[OsString]) -> &'a clap::Command {
    let mut command = program;
    for word in words.iter().skip(1) {
        let Some(inner) = command.find_subcommand(word) else {
            break;
        };
        command = inner;
    }
    command
}

/// The values of a command's first argument that has no flag, where it takes only these.
fn choices(command: &clap::Command) -> Option<String> {
    let argument = command.get_positionals().next()?;
    let values = argument.get_possible_values();
    let names: Vec<&str> = values.iter().map(|value| value.get_name()).collect();
    let name = argument.get_id().as_str().to_uppercase();
    (!names.is_empty()).then(|| format!("{name} is one of {}", names.join(", ")))
}

/// Advice about an argument that a command does not take.
fn about_argument(argument: &str, command: &clap::Command) -> Option<String> {
    let is_of_library = ["--kernel-lib", "--kernel-cmd"].contains(&argument);
    if is_of_library && command.get_name() == "repair" {
        let advice = "repair changes the source of kernels that hairline knows, and cannot change a library: \
                      `hairline list kernels` names those that are like yours";
        return Some(advice.to_owned());
    }
    let flag = flag_of(argument)?;
    let takes_flag = command
        .get_arguments()
        .any(|known| known.get_long() == Some(flag));
    takes_flag.then(|| format!("'{argument}' stands behind a flag: --{flag} {argument}"))
}

/// The flag before which a word is missing: the name of a scene, a kernel or a family, or the file of a mesh.
fn flag_of(word: &str) -> Option<&'static str> {
    let lower = word.to_lowercase();
    if SCENES.iter().any(|preset| preset.name == word) {
        Some("scene")
    } else if kernel::find(word).is_some() {
        Some("kernel")
    } else if family::find(word).is_some() {
        Some("family")
    } else if MESHES.iter().any(|end| lower.ends_with(end)) {
        Some("mesh")
    } else {
        None
    }
}
