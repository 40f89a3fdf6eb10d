//! Which kernel for a scene: all kernels in one table, the one that costs least first.

use super::answer::{USE, is_scale_free_better, title, used_numbers};
use super::commands::{of_kernel, scene_words};
use super::evidence;
use super::fitness::{fitness, is_fine};
use super::legend::how_to_read;
use super::notes::few_rays;
use super::numbers::{cost_text, share_cell};
use super::record::{
    RayCount, Rays, SceneKernelPart, SceneRecord, SceneResult, Stratum, TriedPart, WrongKind,
};
use super::words::{of_unit, unit_of_cost};
use crate::arith::ScalarName;
use crate::audit::Trials;
use crate::lists::alike;
use crate::page::{Block, Cell, Command, Head, Page, Row, Table};
use hairline_advice::epsilon::{CostSeen, Costs};
use hairline_core::exact;
use hairline_record::{Rate, group_digits};

/// A kernel, and the results of what its `use` line says.
type Best<'a> = (&'a SceneKernelPart, &'a TriedPart);

/// True if a record has too many kernels for a screen of each.
pub(super) fn is_needed(record: &SceneResult) -> bool {
    let mut names: Vec<&str> = record
        .kernels
        .iter()
        .map(|part| part.kernel.as_str())
        .collect();
    names.dedup();
    has_a_table(names.len())
}

/// True if so many kernels are shown in one table, and not each by itself.
pub fn has_a_table(kernels: usize) -> bool {
    2 < kernels
}

/// How many rows of a scalar's table are on the first screen, about as many as it has room for.
pub fn rows_on_screen(scalars: usize) -> usize {
    if scalars == 1 { 6 } else { 3 }
}

/// A table for each scalar, and what to run next.
pub(super) fn page(whole: &SceneRecord) -> Page {
    let record = &whole.result;
    let scene = match &record.mesh {
        Some(mesh) => mesh.path.clone(),
        None if record.has_scene() => scene_words(record),
        None => record.sources.join(", "),
    };
    let mut blocks: Vec<Block> = few_rays(record, record.count)
        .map(Block::Text)
        .into_iter()
        .collect();
    let all = ScalarName::ALL.map(|scalar| (scalar, ranked(record, scalar)));
    let scalars = all.iter().filter(|(_, rows)| !rows.is_empty()).count();
    let most = rows_on_screen(scalars);
    let mut winners: Vec<(ScalarName, String)> = Vec::new();
    for (scalar, rows) in &all {
        let Some(best) = rows.first() else { continue };
        blocks.extend(
            record
                .has_scene()
                .then(|| Block::text(fitness(record, best.0.0))),
        );
        let heads = [
            scalar.name(),
            "cost",
            "leaks",
            "lost inside",
            "self-hits",
            "ns a ray",
        ];
        let heads = heads.map(Head::of).into();
        let all = rows.iter().map(|one| row(whole, one)).collect();
        blocks.push(Block::Table(Table::new(heads, all).at_most(most)));
        let alike = alike_with_first(record, rows);
        if 1 < alike {
            blocks.push(Block::Text(format!(
                "These rays cannot tell the costs of the first {alike} apart: another seed may order them differently."
            )));
        }
        winners.push((*scalar, winner(rows, alike)));
    }
    let shown = || {
        all.iter()
            .flat_map(|(_, rows)| rows.iter().take(most).map(|((part, _), _)| *part))
    };
    let has_no_t =
        |part: &SceneKernelPart| part.counts.iter().all(|it| it.kind != WrongKind::SelfHit);
    let no_t = if shown().any(has_no_t) {
        " (-: the kernel has no t)"
    } else {
        ""
    };
    let some_got_fewer = record.kernels.iter().any(|part| part.rays.is_some());
    let fewer = match some_got_fewer {
        true => format!(
            " Kernels that surely cost more than the first {most} got fewer rays: -n {} gives all of them as many.",
            record.count
        ),
        false => String::new(),
    };
    blocks.push(Block::text(format!(
        "leaks: at shared edges or vertices; self-hits: of shadow rays{no_t}. Shares are of rays aimed there, not of your \
         pixels. cost, which is no time: {}.{fewer}",
        unit_of_cost(record)
    )));
    let details = |part| Block::Details(title(record, part), evidence::of_kernel(record, part));
    blocks.extend(record.kernels.iter().map(details));
    blocks.push(Block::Details(
        "How to read".to_owned(),
        how_to_read(record),
    ));
    let best = shown()
        .find(|part| is_fine(record, part))
        .or(shown().next());
    let next = best.map(|best| Command {
        line: of_kernel(record, best),
        what: "may I use these numbers?",
    });
    blocks.extend(next.map(|next| Block::Commands("next", vec![next])));
    Page {
        command: "epsilon",
        title: format!(
            "Fewest wrong answers in {scene}{}: {}",
            of_unit(&record.unit),
            in_words(&winners)
        ),
        blocks,
        ..Page::default()
    }
}

/// A line below the row of the exact test.
const EXACT: &str = "no other epsilon; ns: triangle and ray made ready too (docs/design/margin.md)";

/// The kernels of a scalar, the cheapest first, each with those that were wrong as often with the same numbers.
fn ranked<'a>(record: &'a SceneResult, scalar: ScalarName) -> Vec<(Best<'a>, Vec<Best<'a>>)> {
    let parts = record.kernels.iter().filter(|part| part.scalar == scalar);
    // Numbers that can be typed; forms that follow each triangle are code, and stand with the kernel.
    let mut parts: Vec<Best> = parts.map(|part| (part, &part.tried[0])).collect();
    parts.sort_by(|(_, a), (_, b)| a.cost.total_cmp(&b.cost));
    let wrong = |tried: &TriedPart| -> Vec<[u64; 2]> {
        tried
            .wrong
            .iter()
            .map(|rate| [rate.count, rate.of])
            .collect()
    };
    alike(parts, |(one, best), (other, its)| {
        let is_same_numbers = one.counts == other.counts && best.epsilons == its.epsilons;
        is_same_numbers && wrong(best) == wrong(its)
    })
}

/// The first kernel of a table, and how many others these rays cannot tell from it.
fn winner(rows: &[(Best, Vec<Best>)], alike: usize) -> String {
    let first = rows.first().map_or("", |((part, _), _)| &*part.kernel);
    match alike {
        0 | 1 => first.to_owned(),
        2 => format!("{first}, and 1 other that is about as good"),
        alike => format!("{first}, and {} others that are about as good", alike - 1),
    }
}

/// The winner in each scalar, once if it is the same.
fn in_words(winners: &[(ScalarName, String)]) -> String {
    match winners {
        [(one, first), (other, second)] if first == second => {
            format!("{first} ({one} and {other})")
        }
        winners => {
            let words: Vec<String> = winners
                .iter()
                .map(|(scalar, winner)| format!("{winner} ({scalar})"))
                .collect();
            words.join("; ")
        }
    }
}

/// How many kernels cost no more than the first one, as far as these rays can tell, with that one.
fn alike_with_first(record: &SceneResult, rows: &[(Best, Vec<Best>)]) -> usize {
    let costs = Costs::by_kind(|kind| record.cost(kind));
    let seen = |(part, best): &Best| {
        let wrong: Vec<Trials> = best.wrong.iter().map(Rate::trials).collect();
        CostSeen::of(&part.counts, &costs, &wrong)
    };
    let Some((first, _)) = rows.first() else {
        return 0;
    };
    let least = seen(first);
    let is_alike = |(best, _): &&(Best, Vec<Best>)| !least.is_surely_below(&seen(best));
    rows.iter().take_while(is_alike).count()
}

fn row(whole: &SceneRecord, ((part, best), like): &(Best, Vec<Best>)) -> Row {
    let cell = |is_of: fn(&RayCount) -> bool| {
        let counts = part.counts.iter().zip(&best.wrong);
        let rates = counts.filter(|(count, _)| is_of(count));
        let worst = |a: &&Rate, b: &&Rate| a.rate.unwrap_or(0.0).total_cmp(&b.rate.unwrap_or(0.0));
        rates
            .map(|(_, rate)| rate)
            .max_by(worst)
            .map_or(Cell::none(), share_cell)
    };
    let time = whole.provenance.nanoseconds(part.scalar, &part.kernel);
    let cells = [
        Cell::number(best.cost, cost_text(best.cost)),
        cell(|count| count.kind == WrongKind::Crack),
        cell(is_lost),
        cell(|count| count.kind == WrongKind::SelfHit),
        Cell::optional(time, |time| format!("{time:.0}")),
    ];
    let fixed = used_numbers(&whole.result, part);
    let lead = if fixed.lead == USE {
        "use"
    } else {
        "no numbers are good; least bad:"
    };
    let mut below = vec![format!("{lead} {}", fixed.parts.join("  and  "))];
    if part.kernel == exact::NAME {
        below.push(EXACT.to_owned());
    }
    let follows = is_scale_free_better(&whole.result, part);
    if let Some(relative) = part.relative.as_ref().filter(|_| follows) {
        below.push(format!(
            "cost {} with numbers that follow each triangle's size, as code: {} --snippet c",
            cost_text(relative.cost),
            part.selector
        ));
    }
    let names: Vec<&str> = like.iter().map(|(part, _)| part.kernel.as_str()).collect();
    let alike = format!("as often wrong with the same numbers: {}", names.join(", "));
    below.extend((!names.is_empty()).then_some(alike));
    let fewer = part.rays.map(|rays| {
        let rays = group_digits(rays);
        format!("surely not among the first, so it got only {rays} rays of each kind")
    });
    below.extend(fewer);
    Row {
        below,
        ..Row::new(&part.kernel, cells)
    }
}

/// True if a count is of hits inside triangles that are lost; of other sources of all hits that are.
fn is_lost(count: &RayCount) -> bool {
    let inside = !matches!(count.rays, Rays::Stratum(stratum) if stratum != Stratum::Interior);
    inside && count.kind == WrongKind::Miss
}
