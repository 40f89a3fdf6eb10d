//! `hairline list`: the tables that the other commands take names from.

use super::exit::{Failure, Status};
use super::output::write_page;
use super::plugins::PluginArguments;
use crate::arith::Arithmetic;
use crate::audit::{ASPECTS, Aspect, coverage};
use crate::contract::NAMED;
use crate::family::{FAMILIES, Family, STRATA};
use crate::kernel::{self, Change, Dimension, KernelInfo, PRESETS, Preset, Tunable};
use crate::offset::{PUBLISHED, PublishedScheme, describe};
use crate::report::page::{Block, Cell, Head, Item, Items, Page, Row, Table};
use clap::{Args, ValueEnum};

/// The arguments of `list`.
#[derive(Args)]
pub struct ListArguments {
    #[arg(value_enum)]
    what: Listed,

    /// For families: the share of the cases, in percent, that meet each corner, edge and side, each orientation of
    /// plane and ray, each size, distance and place of t; of the strata in the scene room. '.' is none
    #[arg(long)]
    coverage: bool,

    #[command(flatten)]
    plugins: PluginArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum Listed {
    /// Kernels with their sources, contracts, gates and epsilons
    Kernels,
    /// Case families with their promises
    Families,
    /// Contracts that all kernels can be judged by
    Contracts,
    /// Epsilons of published libraries
    Presets,
    /// Offset schemes of new rays with their sources
    Schemes,
    /// Arithmetics that kernels can be run in
    Arithmetics,
}

/// Runs the command.
pub fn run(arguments: &ListArguments) -> Result<Status, Failure> {
    arguments.plugins.entries()?;
    let blocks = match arguments.what {
        Listed::Families if arguments.coverage => of_coverage(),
        _ if arguments.coverage => {
            return Err(Failure::usage("--coverage: only families have it"));
        }
        Listed::Kernels => kernels(),
        Listed::Families => {
            let term = |family: &Family| (family.name.to_owned(), family.promise.to_owned());
            vec![Block::Terms(
                FAMILIES.iter().chain(STRATA).map(term).collect(),
            )]
        }
        Listed::Contracts => contracts(),
        Listed::Presets => presets(),
        Listed::Schemes => all(PUBLISHED.iter().map(of_scheme)),
        Listed::Arithmetics => {
            let term = |a: &Arithmetic| (a.name().to_owned(), a.describe().to_owned());
            vec![Block::Terms(Arithmetic::ALL.iter().map(term).collect())]
        }
    };
    write_page(Page {
        blocks,
        ..Page::default()
    })?;
    Ok(Status::Success)
}

/// The kernels, and what may stand behind their names.
fn kernels() -> Vec<Block> {
    let mut blocks = all(kernel::all().iter().map(|entry| of_kernel(entry.info)));
    let arithmetics = Arithmetic::ALL
        .iter()
        .skip(1)
        .map(|it| (it.name(), it.describe()));
    let changes = Change::ALL.iter().map(|it| (it.name(), it.about()));
    let forms = arithmetics.chain(changes);
    let forms = forms
        .map(|(name, about)| (format!("+{name}"), about.to_owned()))
        .collect();
    let text = "A kernel in another form is NAME+FORM, as moller-trumbore+fma. One form at a time, where it would change something:";
    blocks.extend([Block::Text(text.to_owned()), Block::Terms(forms)]);
    blocks
}

/// All of some items.
fn all(items: impl Iterator<Item = Item>) -> Vec<Block> {
    vec![Block::Items(Items {
        items: items.collect(),
        most: usize::MAX,
    })]
}

fn contracts() -> Vec<Block> {
    let own = (
        "own".to_owned(),
        "each kernel by what its own source states (the default)".to_owned(),
    );
    let named = NAMED.iter().map(|named| {
        (
            named.name.to_owned(),
            format!("{}: {}", named.about, named.contract.describe()),
        )
    });
    vec![Block::Terms([own].into_iter().chain(named).collect())]
}

/// The cases of each family: a table a kind of aspect.
fn of_coverage() -> Vec<Block> {
    const INDICES: u64 = 500;
    let of_family = |family: &'static Family| (family.name, coverage(family, INDICES));
    let rows: Vec<(&str, Vec<f64>)> = FAMILIES.iter().chain(STRATA).map(of_family).collect();
    let mut first = 0;
    let table = |aspects: &[Aspect]| {
        let places = first..first + aspects.len();
        first = places.end;
        let names = aspects.iter().map(|aspect| Head::of(aspect.name));
        let heads = [Head::of(aspects[0].kind)]
            .into_iter()
            .chain(names)
            .collect();
        let row = |(name, shares): &(&str, Vec<f64>)| {
            Row::new(
                *name,
                shares[places.clone()]
                    .iter()
                    .map(|share| Cell::number(*share, percent_in_three(*share))),
            )
        };
        Block::Table(Table::new(heads, rows.iter().map(row).collect()))
    };
    ASPECTS
        .chunk_by(|a, b| a.kind == b.kind)
        .map(table)
        .collect()
}

/// `.`, `<1`, `37`, `100`.
fn percent_in_three(share: f64) -> String {
    match share * 100.0 {
        0.0 => ".".to_owned(),
        percent if percent < 1.0 => "<1".to_owned(),
        percent => format!("{percent:.0}"),
    }
}

fn of_kernel(info: &KernelInfo) -> Item {
    let mut notes = vec![
        format!("source: {}", info.source),
        format!("contract: {}", info.contract.describe()),
    ];
    for (i, gate) in info.gates.iter().enumerate() {
        let refuses = match gate.printed {
            Some(printed) => format!("{} (printed {printed})", gate.refuses),
            None => gate.refuses.to_owned(),
        };
        if gate.epsilon == Tunable::Fixed {
            notes.push(format!(
                "test {}: refuses where {refuses}; takes no epsilon",
                gate.name
            ));
            continue;
        }
        let sets = info
            .epsilon_sets
            .iter()
            .map(|set| format!("{} ({})", set.values[i], set.name));
        notes.push(format!(
            "gate {}: refuses where {refuses}; dimension length^{} direction^{}; e = {}",
            gate.name,
            gate.dimension.length,
            gate.dimension.direction,
            sets.collect::<Vec<_>>().join(", ")
        ));
    }
    Item {
        text: info.name.to_owned(),
        notes,
        ..Item::default()
    }
}

fn of_scheme(published: &PublishedScheme) -> Item {
    let (name, source) = (published.name, published.source);
    let parameter = published
        .parameter
        .as_ref()
        .map(|parameter| format!("{name}=VALUE: {} [{}]", parameter.what, parameter.default));
    let notes = [format!("source: {source}")]
        .into_iter()
        .chain(parameter)
        .collect();
    Item {
        text: format!("{name}{}", describe(name)),
        notes,
        ..Item::default()
    }
}

fn presets() -> Vec<Block> {
    let own = "as each kernel's source has them (the default)".to_owned();
    let own = Item {
        text: "source".to_owned(),
        notes: vec![own],
        ..Item::default()
    };
    let of_preset = |preset: &Preset| {
        let entries = preset.entries.iter().map(|entry| {
            let (value, Dimension { length, direction }) = (entry.value, entry.dimension);
            format!(
                "gate {}={value}, dimension length^{length} direction^{direction}: {}",
                entry.gate, entry.form
            )
        });
        let notes = [preset.source.to_owned()]
            .into_iter()
            .chain(entries)
            .collect();
        Item {
            text: preset.name.to_owned(),
            notes,
            ..Item::default()
        }
    };
    all([own].into_iter().chain(PRESETS.iter().map(of_preset)))
}
