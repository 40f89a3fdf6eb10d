//! Which kernel for a scene: all kernels in one table, the one that costs least first.

use super::answer::{USE, is_scale_free_better, title, used};
use super::commands::{of_kernel, scene_words};
use super::evidence;
use super::fitness::{fitness, is_fine};
use super::notes::few_rays;
use super::record::{
    RayCount, Rays, SceneKernelPart, SceneRecord, SceneResult, Stratum, TriedPart, WrongKind,
};
use super::words::{how_to_read, of_unit, share_cell};
use crate::arith::ScalarName;
use crate::lists::alike;
use crate::page::{Block, Cell, Command, Head, Page, Row, Table};
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
    }
    let shown = || {
        all.iter()
            .flat_map(|(_, rows)| rows.iter().take(most).map(|((part, _), _)| *part))
    };
    let forms = match shown().any(|part| is_scale_free_better(record, part)) {
        true => " L: the triangle's longest edge; M: the largest coordinate.",
        false => "",
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
         pixels. cost: each share times its weight, false hits and almost parallel rays too.{forms}{fewer}"
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
            "Kernels with their best epsilons in {scene}{}",
            of_unit(&record.unit)
        ),
        blocks,
        ..Page::default()
    }
}

/// The kernels of a scalar, the cheapest first, each with those that were wrong as often with the same numbers.
fn ranked<'a>(record: &'a SceneResult, scalar: ScalarName) -> Vec<(Best<'a>, Vec<Best<'a>>)> {
    let best = |part: &'a SceneKernelPart| match &part.relative {
        Some(relative) if is_scale_free_better(record, part) => relative,
        _ => &part.tried[0],
    };
    let parts = record.kernels.iter().filter(|part| part.scalar == scalar);
    let mut parts: Vec<Best> = parts.map(|part| (part, best(part))).collect();
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
        Cell::number(best.cost, format!("{:.3}", best.cost)),
        cell(|count| count.kind == WrongKind::Crack),
        cell(is_lost),
        cell(|count| count.kind == WrongKind::SelfHit),
        Cell::optional(time, |time| format!("{time:.0}")),
    ];
    let used = used(&whole.result, part).into_iter().next();
    let used = used.map(|used| {
        let lead = if used.lead == USE {
            "use"
        } else {
            "no numbers are good; least bad:"
        };
        format!("{lead} {}", used.parts.join("  and  "))
    });
    let names: Vec<&str> = like.iter().map(|(part, _)| part.kernel.as_str()).collect();
    let alike = format!("as often wrong with the same numbers: {}", names.join(", "));
    let alike = (!names.is_empty()).then_some(alike);
    let fewer = part.rays.map(|rays| {
        let rays = group_digits(rays);
        format!("surely not among the first, so it got only {rays} rays of each kind")
    });
    Row {
        below: used.into_iter().chain(alike).chain(fewer).collect(),
        ..Row::new(&part.kernel, cells)
    }
}

/// True if a count is of hits inside triangles that are lost; of other sources of all hits that are.
fn is_lost(count: &RayCount) -> bool {
    let inside = !matches!(count.rays, Rays::Stratum(stratum) if stratum != Stratum::Interior);
    inside && count.kind == WrongKind::Miss
}
