//! `hairline help`, and what a shell and `man` read: how to call the commands, and the words on their screens.

use super::exit::{Failure, Status};
use super::output::{write_page, write_result};
use crate::contract::NAMED;
use crate::family;
use crate::kernel::{self, Change};
use crate::offset::PUBLISHED;
use crate::report::listed;
use crate::report::page::{Block, Page};
use crate::suggest::did_you_mean;
use clap::Args;
use clap_complete::Shell;
use std::collections::BTreeMap;

/// The words of the screens, a page of the guide.
const WORDS: &str = include_str!("../../docs/guide/words.md");

/// By command: a call that does its main job.
pub const EXAMPLES: &[(&str, &str)] = &[
    (
        "audit",
        "hairline audit --kernel moller-trumbore,woop-watertight --scalar f32",
    ),
    (
        "epsilon",
        "hairline epsilon --kernel moller-trumbore --scene room",
    ),
    (
        "offset",
        "hairline offset --kernel moller-trumbore --scene room",
    ),
    (
        "prove",
        "hairline prove --kernel moller-trumbore --scalar f32",
    ),
    (
        "repair",
        "hairline repair --kernel moller-trumbore --emit c -o guarded.h",
    ),
    ("mesh", "hairline mesh model.obj"),
    (
        "explain",
        "hairline explain 'tiny@3/f32/-/1/15467' --kernel moller-trumbore",
    ),
    (
        "map",
        "hairline map 'tiny@3/f32/-/1/15467' --kernel moller-trumbore -o map.svg",
    ),
    ("list", "hairline list kernels"),
    ("boxes", "hairline boxes audit --kernel ize,kay-kajiya"),
    (
        "rays",
        "hairline rays model.obj rays.csv --answers mine.csv",
    ),
    (
        "fuzz",
        "hairline fuzz campaign --kernel moller-trumbore --time 60",
    ),
    ("check", "hairline check --bless"),
    ("merge", "hairline merge 1.json 2.json -o all.json"),
    ("diff", "hairline diff before.json after.json"),
    (
        "generate",
        "hairline generate --family edge-near --scalar f32 -o cases.txt",
    ),
    ("truth", "hairline truth cases.jsonl"),
    ("vectors", "hairline vectors --format csv -o core.csv"),
    ("verify", "hairline verify results.json --profile dxr"),
    ("selfcheck", "hairline selfcheck"),
    ("corpus", "hairline corpus verify"),
    ("help", "hairline help ulp"),
    (
        "completions",
        "hairline completions bash > ~/.local/share/bash-completion/completions/hairline",
    ),
    ("man", "hairline man epsilon | man -l -"),
];

/// A command, or a word.
#[derive(Args)]
pub struct HelpArguments {
    /// A command, a word of a screen (ulp, leak, false miss), or `words` for all of them
    #[arg(value_name = "COMMAND|WORD")]
    words: Vec<String>,
}

/// Which shell.
#[derive(Args)]
pub struct CompletionsArguments {
    #[arg(value_enum)]
    shell: Shell,
}

/// Which command.
#[derive(Args)]
pub struct ManArguments {
    /// A command [default: hairline itself]
    command: Option<String>,
}

/// Prints the help of a command, or the meaning of a word.
pub fn run(arguments: &HelpArguments, mut program: clap::Command) -> Result<Status, Failure> {
    program.build();
    let mut command = Some(&mut program);
    for word in &arguments.words {
        command = command.and_then(|command| command.find_subcommand_mut(word));
    }
    if let Some(command) = command {
        match arguments.words.is_empty() {
            true => command.print_help()?,
            false => command.print_long_help()?,
        }
        return Ok(Status::Success);
    }
    let asked = arguments.words.join(" ");
    let page = match asked.as_str() {
        "words" => all_words(),
        _ => Page {
            title: meaning(&asked)?,
            ..Page::default()
        },
    };
    write_page(page)?;
    Ok(Status::Success)
}

/// Prints a script for a shell.
pub fn completions(
    arguments: &CompletionsArguments,
    mut program: clap::Command,
) -> Result<Status, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, "hairline", &mut script);
    write_result("-", |out| out.write_all(&script))?;
    Ok(Status::Success)
}

/// Prints a page of the manual.
pub fn man(arguments: &ManArguments, mut program: clap::Command) -> Result<Status, Failure> {
    program.build();
    let page = match &arguments.command {
        None => program,
        Some(name) => {
            let names = EXAMPLES.iter().map(|(name, _)| *name);
            let unknown = || format!("unknown command '{name}'{}", near(name, names));
            let found = program.find_subcommand(name);
            found.ok_or_else(|| Failure::usage(unknown()))?.clone()
        }
    };
    let page = clap_mangen::Man::new(page);
    write_result("-", |out| page.render(out))?;
    Ok(Status::Success)
}

fn near<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    did_you_mean(name, names, "hairline help words")
}

/// A word's names, and its meaning, in a line `- **word**, **other**: meaning`.
fn entry(line: &str) -> Option<(String, &str)> {
    let (names, meaning) = line.strip_prefix("- **")?.split_once("**: ")?;
    Some((names.replace("**", ""), meaning))
}

/// The line about a word; its number, its case and hyphens do not matter. Of several words that are no entry together, as
/// the head of a column, the line about the longest part that is one.
fn meaning(asked: &str) -> Result<String, Failure> {
    let entries: Vec<(String, &str)> = WORDS.lines().filter_map(entry).collect();
    let names = || entries.iter().flat_map(|(names, _)| names.split(", "));
    let about = |part: &str| {
        entries
            .iter()
            .find(|(names, _)| names.split(", ").any(|name| is_name(part, name)))
            .map(|(names, meaning)| format!("{names}: {}", meaning.replace('`', "'")))
            .or_else(|| named(part))
    };
    parts_of(asked)
        .iter()
        .find_map(|part| about(part))
        .ok_or_else(|| Failure::usage(format!("unknown word '{asked}'{}", near(asked, names()))))
}

/// Words that stand one after the other in a text: all of them, and then fewer and fewer.
fn parts_of(text: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    (1..=words.len())
        .rev()
        .flat_map(|count| words.windows(count))
        .map(|part| part.join(" "))
        .collect()
}

/// True if a word, or its plural, is a name; its case and hyphens do not matter.
fn is_name(word: &str, name: &str) -> bool {
    let plain = |word: &str| word.to_lowercase().replace('-', " ");
    let (word, name) = (plain(word), plain(name));
    let is_plural = |end| word.strip_suffix(end) == Some(&name);
    word == name || is_plural("s") || is_plural("es")
}

/// A kernel, a gate, a family, a contract, a scheme or a change of this name.
fn named(name: &str) -> Option<String> {
    let kernel = kernel::find(name).map(|entry| {
        format!(
            "a kernel: {}; its contract: {}",
            entry.info.source,
            entry.info.contract.describe()
        )
    });
    let family =
        || family::find(name).map(|family| format!("a family of cases: {}", family.promise));
    let contract = || {
        let found = NAMED.iter().find(|named| named.name == name)?;
        Some(format!(
            "a contract: {}: {}",
            found.about,
            found.contract.describe()
        ))
    };
    let scheme = || {
        let found = PUBLISHED.iter().find(|published| published.name == name)?;
        Some(format!("an offset of new rays: {}", found.source))
    };
    let change = || {
        let change = Change::named(name.trim_start_matches('+'))?;
        Some(format!(
            "a change of a kernel (KERNEL+{}): {}",
            change.name(),
            change.about()
        ))
    };
    let about = kernel
        .or_else(|| gate(name))
        .or_else(family)
        .or_else(contract)
        .or_else(scheme)
        .or_else(change)?;
    Some(format!("{name}: {about}"))
}

/// The comparisons of gates of a name, and the kernels that have them.
fn gate(name: &str) -> Option<String> {
    let mut kernels: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for entry in kernel::all() {
        for gate in entry.info.gates.iter().filter(|gate| gate.name == name) {
            kernels
                .entry(gate.refuses)
                .or_default()
                .push(entry.info.name);
        }
    }
    let forms: Vec<String> = kernels
        .iter()
        .map(|(refuses, kernels)| format!("{refuses} ({})", listed_words(kernels)))
        .collect();
    (!forms.is_empty()).then(|| format!("a gate, which refuses where {}", forms.join("; ")))
}

/// The most kernels that are named for one comparison.
const MOST_KERNELS: usize = 3;

fn listed_words(words: &[&str]) -> String {
    let owned: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
    listed(&owned, MOST_KERNELS)
}

fn all_words() -> Page {
    let mut blocks = Vec::new();
    for part in WORDS.split("\n## ").skip(1) {
        let terms = part.lines().filter_map(entry);
        blocks.push(Block::Heading(
            part.lines().next().unwrap_or_default().to_owned(),
        ));
        blocks.push(Block::Terms(
            terms
                .map(|(names, meaning)| (names, meaning.replace('`', "'")))
                .collect(),
        ));
    }
    Page {
        title: "The words on the screens".to_owned(),
        blocks,
        ..Page::default()
    }
}
