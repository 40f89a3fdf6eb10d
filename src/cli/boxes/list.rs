//! `hairline boxes list`.

use super::published::{Published, published};
use crate::cli::exit::{Failure, Status};
use crate::cli::output::write_page;
use crate::report::page::{Block, Item, Items, Page};
use clap::{Args, ValueEnum};
use hairline_boxes::{BoxEntry, FAMILIES, TABLE};

/// The table to list.
#[derive(Args)]
pub struct ListArguments {
    #[arg(value_enum)]
    what: Listed,
}

#[derive(Clone, Copy, ValueEnum)]
enum Listed {
    /// Slab tests with their sources, contracts, gates and epsilons
    Tests,
    /// Families of boxes with their promises
    Families,
    /// Boxes and rays of other people's reports, for `explain @NAME`
    Published,
}

/// Runs the command.
pub fn run(arguments: &ListArguments) -> Result<Status, Failure> {
    let block = match arguments.what {
        Listed::Tests => items(TABLE.all().into_iter().map(item).collect()),
        Listed::Families => {
            let term = |family: &hairline_boxes::Family| {
                (family.name.to_owned(), family.promise.to_owned())
            };
            Block::Terms(FAMILIES.iter().map(term).collect())
        }
        Listed::Published => items(published().into_iter().map(report).collect()),
    };
    write_page(Page {
        blocks: vec![block],
        ..Page::default()
    })?;
    Ok(Status::Success)
}

fn items(items: Vec<Item>) -> Block {
    let most = items.len();
    Block::Items(Items { items, most })
}

fn report(report: Published) -> Item {
    Item {
        text: format!("@{}", report.name),
        notes: vec![
            report.source,
            report.about,
            format!("numbers: {}", report.numbers),
        ],
        ..Item::default()
    }
}

fn item(entry: &'static BoxEntry) -> Item {
    let info = entry.info;
    let mut notes = vec![
        info.source.to_owned(),
        format!("promises {}", info.contract.describe()),
    ];
    for (i, gate) in info.gates.iter().enumerate() {
        let values: Vec<String> = info
            .epsilon_sets
            .iter()
            .filter_map(|set| Some(format!("{} {}", set.name, set.values.get(i)?)))
            .collect();
        notes.push(format!(
            "{}: {}; e is {}",
            gate.name,
            gate.refuses,
            values.join(", ")
        ));
    }
    Item {
        text: info.name.to_owned(),
        notes,
        ..Item::default()
    }
}
