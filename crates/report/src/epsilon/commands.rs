//! The commands that show more of what is recommended for a scene.

use super::notes::{has_default_costs, is_coarse};
use super::record::{NamedNumber, SceneKernelPart, SceneResult};
use crate::audit::shell_word;
use crate::case::ShortNumber;
use crate::kernel::Role;
use crate::page::Command;
use crate::scene::preset_of;
use hairline_advice::epsilon::COUNT;

/// Commands that show more of what is recommended.
pub(super) fn commands(record: &SceneResult, part: &SceneKernelPart) -> Vec<Command> {
    let best = &part.tried[0].epsilons;
    let of_audit = of_scene(record);
    let chosen = part.knobs.iter().zip(best).filter(|(knob, _)| knob.is_gate);
    let chosen = chosen
        .map(|(knob, value)| (&knob.name, value))
        .chain(&part.others);
    let epsilons: Vec<String> = chosen
        .map(|(gate, value)| format!("{gate}={value}"))
        .collect();
    let with = if epsilons.is_empty() {
        String::new()
    } else {
        format!(" --epsilon {}", epsilons.join(","))
    };
    let seed = record.fresh_seed;
    let line = |name: &str| {
        let (kernel, scalar) = (&part.selector, part.scalar);
        format!("hairline {name} {kernel}{with} {of_audit} --scalar {scalar} --seed {seed}")
    };
    // A t that keeps rays from their own surface is right where the exact answer for the rounded start is a hit.
    let guards_start = part
        .knobs
        .iter()
        .any(|knob| knob.is_gate && knob.role == Role::T);
    let own = part.contract_flag.as_deref();
    let contract = match (own, guards_start) {
        (None, false) => String::new(),
        (Some(words), _) if !guards_start || words.contains("no-self-hit") => {
            format!(" --contract {words}")
        }
        _ => format!(" --contract {},no-self-hit", own.unwrap_or("own")),
    };
    let mut all = vec![Command {
        line: format!("{} -n {}{contract}", line("audit"), record.rays_of(part)),
        what: "",
    }];
    let has_t = record.has_scene()
        && part.knobs.iter().any(|knob| knob.role == Role::T)
        && !is_coarse(record, part);
    if has_t {
        all.push(Command {
            line: line("offset"),
            what: "an offset in place of t_min",
        });
    }
    all
}

/// The scene as `--scene` takes it.
pub(super) fn scene_words(record: &SceneResult) -> String {
    match preset_of(&record.scene) {
        Some(preset) => preset.name.to_owned(),
        None => shell_word(&record.scene),
    }
}

/// The flags that name the scene of a study, or its mesh and how rays meet it.
fn of_scene(record: &SceneResult) -> String {
    if !record.has_scene() {
        return record.flags.clone();
    }
    let Some(mesh) = &record.mesh else {
        return format!("--scene {}", scene_words(record));
    };
    // A mesh has its own extent and edges.
    let is_of_rays = |word: &&str| {
        !["extent=", "center=", "edge="]
            .iter()
            .any(|key| word.starts_with(key))
    };
    // Standard input was read once.
    let path = if mesh.path == "-" { "FILE" } else { &mesh.path };
    let words: Vec<&str> = ["mesh"]
        .into_iter()
        .chain(record.scene.split(',').filter(is_of_rays))
        .collect();
    format!(
        "--mesh {} --scene {}",
        shell_word(path),
        shell_word(&words.join(","))
    )
}

/// The command that studies one kernel as this record does.
pub(super) fn of_kernel(record: &SceneResult, part: &SceneKernelPart) -> String {
    let numbers = |flag: &str, numbers: &[NamedNumber]| {
        let words: Vec<String> = numbers
            .iter()
            .map(|it| format!("{}={}", it.name, ShortNumber(it.number)))
            .collect();
        format!(" {flag} {}", words.join(","))
    };
    let mut command = format!(
        "hairline epsilon {} {} --scalar {}",
        part.selector,
        of_scene(record),
        part.scalar
    );
    if !has_default_costs(record) {
        command += &numbers("--cost", &record.costs);
    }
    if !record.max_error.is_empty() {
        command += &numbers("--max-error", &record.max_error);
    }
    if record.seed != 1 {
        command += &format!(" --seed {}", record.seed);
    }
    if record.count != COUNT {
        command += &format!(" -n {}", record.count);
    }
    command
}
