//! `hairline.toml`: the settings of `check`, under the environment and the command line.

use super::exit::Failure;
use crate::suggest::nearest_name;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Where settings are looked for by default.
pub const FILE: &str = "hairline.toml";

/// The form of a setting's value.
#[derive(Clone, Copy, PartialEq)]
enum ValueKind {
    /// A list of names, or one.
    Names,
    /// A list of files, or one; from the folder of `hairline.toml`.
    Files,
    /// One file; likewise.
    File,
    /// A list of command lines, or one.
    Commands,
    /// A string or a number.
    Text,
    /// true or false.
    Flag,
    /// A table of demands on proofs: `[proved]`, by kernel, scalar and gate.
    Demands,
}

impl ValueKind {
    /// True if several may be given.
    fn is_list(self) -> bool {
        !matches!(self, ValueKind::File | ValueKind::Text | ValueKind::Flag)
    }
}

/// A setting: a flag of `check` that may also stand in the file or the environment.
struct FlagSetting {
    key: &'static str,
    kind: ValueKind,
    /// A value, for a flag without a default.
    example: &'static str,
}

const fn setting(key: &'static str, kind: ValueKind, example: &'static str) -> FlagSetting {
    FlagSetting { key, kind, example }
}

const SETTINGS: &[FlagSetting] = &[
    setting("kernel", ValueKind::Names, "moller-trumbore"),
    setting("kernel-lib", ValueKind::Files, "libmine.so"),
    setting("kernel-cmd", ValueKind::Commands, "node kernel.mjs"),
    setting("kernel-start", ValueKind::Text, ""),
    setting("kernel-timeout", ValueKind::Text, ""),
    setting("kernel-failures", ValueKind::Text, "1000"),
    setting("require-ieee", ValueKind::Flag, ""),
    setting("arithmetic", ValueKind::Names, "ieee,fma"),
    setting("epsilon", ValueKind::Text, "parallel=1e-6,edge=0"),
    setting("epsilon-preset", ValueKind::Text, "bvh"),
    setting("contract", ValueKind::Text, "own,coplanar=free"),
    setting("band", ValueKind::Text, "4ulps"),
    setting("scalar", ValueKind::Names, ""),
    setting("family", ValueKind::Names, "tiny"),
    setting("count", ValueKind::Text, ""),
    setting("seed", ValueKind::Text, ""),
    setting("exhaustive", ValueKind::Flag, ""),
    setting("scale", ValueKind::Text, ""),
    setting("scale-direction", ValueKind::Flag, ""),
    setting("offset", ValueKind::Text, "1e6:0:0"),
    setting("direction", ValueKind::Text, "unit"),
    setting("scene", ValueKind::Text, "room"),
    setting("mesh", ValueKind::Files, "model.obj"),
    setting("directions", ValueKind::Text, ""),
    setting(
        "instance",
        ValueKind::Text,
        "0 0 -2 1000  2 0 0 0.5  0 -2 0 -64",
    ),
    setting("corpus", ValueKind::Files, "cases.jsonl"),
    setting("examples", ValueKind::Text, ""),
    setting(
        "proved",
        ValueKind::Demands,
        "woop-watertight/f32/watertight=true",
    ),
    setting("expectations", ValueKind::File, ""),
];

/// The file of default settings, commented: what the flags of `check` say of themselves.
pub fn default_file(check: &clap::Command) -> String {
    let mut text = "# hairline.toml: what `hairline check` runs. A flag of the command line wins over a variable\n\
                    # (HAIRLINE_COUNT for count), which wins over this file. Paths are from this file's folder.\n"
        .to_owned();
    for FlagSetting { key, kind, example } in SETTINGS {
        let Some(flag) = check
            .get_arguments()
            .find(|flag| flag.get_long() == Some(key))
        else {
            continue;
        };
        let about = flag.get_help().map(ToString::to_string).unwrap_or_default();
        let default = flag
            .get_default_values()
            .first()
            .map(|value| value.to_string_lossy());
        let (sign, value) = match (&default, kind) {
            (Some(value), _) => ("", &**value),
            (None, ValueKind::Flag) => ("", "false"),
            (None, _) => ("# ", *example),
        };
        let quoted = |text: &str| format!("\"{text}\"");
        let value = match kind {
            _ if kind.is_list() => {
                format!(
                    "[{}]",
                    value.split(',').map(quoted).collect::<Vec<_>>().join(", ")
                )
            }
            ValueKind::Flag => value.to_owned(),
            _ if value.parse::<u64>().is_ok() && *key != "scale" => value.to_owned(),
            _ => quoted(value),
        };
        let (mut comment, mut width) = ("#".to_owned(), 1);
        for word in format!("{about}.").split(' ') {
            if 99 < width + word.len() {
                (comment, width) = (comment + "\n#", 1);
            }
            comment += &format!(" {word}");
            width += 1 + word.len();
        }
        text += &format!("\n{comment}\n{sign}{key} = {value}\n");
    }
    text
}

/// A setting that is given outside the command line, as words of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The flag, without dashes.
    pub key: &'static str,
    /// `--key=value`, once or more often.
    pub words: Vec<String>,
    /// `hairline.toml:3` or `HAIRLINE_COUNT`.
    pub place: String,
}

/// How the variables of settings begin.
const PREFIX: &str = "HAIRLINE_";

/// The variable of a setting.
fn variable(key: &str) -> String {
    format!("{PREFIX}{}", key.to_uppercase().replace('-', "_"))
}

/// A note on each variable whose name begins as those of settings do, and is none.
pub fn unknown_variables(names: impl Iterator<Item = String>) -> Vec<String> {
    let known: Vec<String> = SETTINGS
        .iter()
        .map(|setting| variable(setting.key))
        .collect();
    let is_unknown = |name: &String| name.starts_with(PREFIX) && !known.contains(name);
    let note = |name: String| {
        // What all names have in common makes none of them nearer.
        let own = |name: &'_ str| name[PREFIX.len()..].to_owned();
        let names: Vec<String> = known.iter().map(|name| own(name)).collect();
        let near = nearest_name(&own(&name), names.iter().map(String::as_str));
        let advice = match near {
            _ if name == "HAIRLINE_BLESS" => "; in `check` it is the flag --bless".to_owned(),
            Some(near) => format!("; did you mean {PREFIX}{near}?"),
            None => String::new(),
        };
        format!("note: {name} is no setting, and is not used{advice}")
    };
    let mut notes: Vec<String> = names.filter(is_unknown).map(note).collect();
    notes.sort();
    notes
}

/// The settings of the environment, read by a function; empty ones do not count.
pub fn from_environment(get: impl Fn(&str) -> Option<String>) -> Result<Vec<Given>, Failure> {
    let mut all = Vec::new();
    for setting in SETTINGS {
        let place = variable(setting.key);
        let Some(text) = get(&place).filter(|text| !text.is_empty()) else {
            continue;
        };
        let words = match (setting.kind, text.as_str()) {
            (ValueKind::Flag, "1" | "true") => vec![format!("--{}", setting.key)],
            (ValueKind::Flag, "0" | "false") => Vec::new(),
            (ValueKind::Flag, _) => {
                return Err(Failure::usage(format!(
                    "{place}: expected true or false, not '{text}'"
                )));
            }
            _ => vec![format!("--{}={text}", setting.key)],
        };
        all.push(Given {
            key: setting.key,
            words,
            place,
        });
    }
    Ok(all)
}

/// The settings of a file's text.
pub fn from_file(text: &str, file: &str) -> Result<Vec<Given>, Failure> {
    let line = |at: usize| {
        text.as_bytes()[..at]
            .iter()
            .filter(|b| **b == b'\n')
            .count()
            + 1
    };
    let error = |at: usize, message: String| {
        let message = message.replace('\n', "; ");
        Failure::usage(format!("{file}:{}: {message}", line(at)))
    };
    let table = DeTable::parse(text).map_err(|e| {
        error(
            e.span().map_or(0, |span| span.start),
            e.message().to_owned(),
        )
    })?;
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    let mut all = Vec::new();
    for (key, value) in table.get_ref() {
        let (name, at) = (key.get_ref().as_ref(), key.span().start);
        let Some(setting) = SETTINGS.iter().find(|setting| setting.key == name) else {
            return Err(error(at, unknown_key(name)));
        };
        let words = words(setting, value.get_ref(), folder).map_err(|m| error(at, m))?;
        all.push(Given {
            key: setting.key,
            words,
            place: format!("{file}:{}", line(at)),
        });
    }
    Ok(all)
}

fn unknown_key(name: &str) -> String {
    let keys = || SETTINGS.iter().map(|setting| setting.key);
    match nearest_name(name, keys()) {
        Some(near) => format!("unknown setting '{name}'; did you mean '{near}'?"),
        None => {
            format!(
                "unknown setting '{name}'; there are {}",
                keys().collect::<Vec<_>>().join(", ")
            )
        }
    }
}

fn words(setting: &FlagSetting, value: &DeValue, folder: &Path) -> Result<Vec<String>, String> {
    let key = setting.key;
    if let ValueKind::Flag = setting.kind {
        return match value {
            DeValue::Boolean(true) => Ok(vec![format!("--{key}")]),
            DeValue::Boolean(false) => Ok(Vec::new()),
            _ => Err(format!("{key}: expected true or false")),
        };
    }
    if let (ValueKind::Demands, DeValue::Table(kernels)) = (setting.kind, value) {
        return demands(kernels).map(|all| vec![format!("--{key}={}", all.join(","))]);
    }
    let is_list = setting.kind.is_list();
    let texts = match value {
        DeValue::Array(items) if is_list => items
            .iter()
            .map(|item| scalar_text(item.get_ref()))
            .collect::<Option<Vec<_>>>(),
        one => scalar_text(one).map(|text| vec![text]),
    };
    let expected = if is_list {
        "a string or a list of strings"
    } else {
        "a string or a number"
    };
    let texts = texts.ok_or_else(|| format!("{key}: expected {expected}"))?;
    if texts.is_empty() {
        return Err(format!(
            "{key}: the list is empty; leave it out for the default"
        ));
    }
    Ok(match setting.kind {
        ValueKind::Names | ValueKind::Demands => vec![format!("--{key}={}", texts.join(","))],
        ValueKind::Files | ValueKind::File => texts
            .iter()
            .map(|text| format!("--{key}={}", folder.join(text).display()))
            .collect(),
        _ => texts.iter().map(|text| format!("--{key}={text}")).collect(),
    })
}

/// `[proved]`: a table of kernels, of scalars, of gates.
fn demands(kernels: &DeTable) -> Result<Vec<String>, String> {
    let expected =
        || "proved: expected KERNEL.SCALAR.GATE = UNITS or KERNEL.SCALAR.watertight = true";
    let mut all = Vec::new();
    for (kernel, scalars) in kernels {
        let DeValue::Table(scalars) = scalars.get_ref() else {
            return Err(expected().to_owned());
        };
        for (scalar, gates) in scalars {
            let DeValue::Table(gates) = gates.get_ref() else {
                return Err(expected().to_owned());
            };
            for (gate, value) in gates {
                let value = match value.get_ref() {
                    DeValue::Boolean(true) => "true".to_owned(),
                    number => scalar_text(number).ok_or_else(|| expected().to_owned())?,
                };
                let names = [kernel, scalar, gate].map(|name| name.get_ref().as_ref());
                all.push(format!("{}={value}", names.join("/")));
            }
        }
    }
    if all.is_empty() {
        Err(expected().to_owned())
    } else {
        Ok(all)
    }
}

fn scalar_text(value: &DeValue) -> Option<String> {
    match value {
        DeValue::String(text) => Some(text.to_string()),
        DeValue::Integer(number) if number.radix() == 10 => Some(number.as_str().to_owned()),
        DeValue::Float(number) => Some(number.as_str().to_owned()),
        _ => None,
    }
}

/// The settings that count: of each key the first in the layers, highest first, unless the command
/// line has it. An epsilon and a preset of epsilons are the same key, and exclude each other.
pub fn layered(
    layers: [Vec<Given>; 2],
    on_command_line: impl Fn(&str) -> bool,
) -> Result<Vec<Given>, Failure> {
    let subject = |key: &'static str| {
        if key == "epsilon-preset" {
            "epsilon"
        } else {
            key
        }
    };
    let mut taken: Vec<Given> = Vec::new();
    for layer in layers {
        let above = taken.len();
        for given in layer {
            let key = subject(given.key);
            let is_above = SETTINGS
                .iter()
                .any(|s| subject(s.key) == key && on_command_line(s.key));
            let other = taken.iter().position(|other| subject(other.key) == key);
            match other {
                _ if is_above => {}
                None => taken.push(given),
                Some(i) if i < above => {}
                Some(i) => {
                    let Given { key, place, .. } = &taken[i];
                    return Err(Failure::usage(format!(
                        "{}: {} cannot be used with {key} ({place})",
                        given.place, given.key
                    )));
                }
            }
        }
    }
    Ok(taken)
}

#[cfg(test)]
mod tests;
