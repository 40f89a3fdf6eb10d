//! `hairline help`, and what a shell and `man` read: how to call the commands, and the words on their screens.

use super::exit::{Failure, Status};
use super::output::{write_page, write_result};
use crate::contract::NAMED;
use crate::family;
use crate::kernel::{self, Change};
use crate::offset::PUBLISHED;
use crate::report::page::{Block, Page};
use crate::suggest::did_you_mean;
use clap::Args;
use clap_complete::Shell;

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

/// The line about a word; its number, its case and hyphens do not matter.
fn meaning(word: &str) -> Result<String, Failure> {
    let plain = |word: &str| word.to_lowercase().replace('-', " ");
    let asked = plain(word);
    let entries: Vec<(String, &str)> = WORDS.lines().filter_map(entry).collect();
    let is_asked = |name: &str| {
        let name = plain(name);
        name == asked
            || ["s", "es"]
                .iter()
                .any(|end| asked.strip_suffix(end) == Some(&name))
    };
    let found = entries
        .iter()
        .find(|(names, _)| names.split(", ").any(is_asked));
    let names = || entries.iter().flat_map(|(names, _)| names.split(", "));
    if let Some((names, meaning)) = found {
        return Ok(format!("{names}: {}", meaning.replace('`', "'")));
    }
    let unknown = || Failure::usage(format!("unknown word '{word}'{}", near(word, names())));
    named(word).ok_or_else(unknown)
}

/// A kernel, a family, a contract, a scheme or a change of this name.
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
        .or_else(family)
        .or_else(contract)
        .or_else(scheme)
        .or_else(change)?;
    Some(format!("{name}: {about}"))
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
