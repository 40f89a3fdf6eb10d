//! The answer of one kernel in words: the same on the screen and in a page.

use super::notes::{accuracy, is_coarse, is_no_good, no_good, notes, price};
use super::numbers::{
    bound, cost_text, human, interval, least_normal, share, share_cell, short_error,
};
use super::record::*;
use super::words::{flag, label, least_t, of_unit, unit_of, unit_of_t, where_of};
use crate::arith::{ScalarName, two_digits};
use crate::kernel::Role;
use crate::page::{Cell, Row, Use};
use crate::scene::named_scene;
use hairline_record::Rate;
use hairline_record::{group_digits, number_of};

/// A limit of a number: of these rays, or a proved one.
pub(super) struct LimitRow<'a> {
    pub knob: &'a KnobPart,
    /// The limit; none if no value keeps it.
    pub value: Option<&'a String>,
    /// True if values must be at or above it.
    pub is_lower: bool,
    pub count: &'a RayCount,
    pub is_proved: bool,
    /// The limit in words.
    pub bound: String,
    pub most: String,
    pub fresh: String,
    /// True if the scene's sizes set it as much as rounding does.
    pub is_of_scene: bool,
    /// Its price, if that is high.
    pub price: Option<String>,
}

/// The kernel, the scalar, and in short the scene.
pub(super) fn title(record: &SceneResult, part: &SceneKernelPart) -> String {
    let kernel = format!("{} {}", part.kernel, part.scalar);
    let Some(MeshScenePart {
        path, triangles, ..
    }) = &record.mesh
    else {
        return kernel;
    };
    let file = path.rsplit('/').next().unwrap_or(path);
    format!(
        "{kernel} in {file} ({})",
        number_of(*triangles, "triangle", "triangles")
    )
}

/// The scene's words: its name, or its sizes.
pub(super) fn scene(record: &SceneResult) -> String {
    match record.has_scene() {
        true => format!("{}{}", named_scene(&record.scene), of_unit(&record.unit)),
        false => record.sources.join(", "),
    }
}

/// The name of the numbers that cost least.
pub(super) fn name(record: &SceneResult, part: &SceneKernelPart) -> &'static str {
    if lead(record, part, &part.tried[0]) == USE {
        RECOMMENDED
    } else {
        "least bad"
    }
}

/// The names of what was tried.
pub(super) fn column_names(record: &SceneResult, part: &SceneKernelPart) -> Vec<String> {
    let names = columns(part).map(|tried| column(part, &tried.name));
    let own = |column| {
        if column == RECOMMENDED {
            name(record, part).to_owned()
        } else {
            column
        }
    };
    names.map(own).collect()
}

/// A form without a unit is the answer if it leaves less than this share of the cost.
const DECISIVE: f64 = 0.5;

/// The epsilons that were tried: the recommended ones, the form without a unit, the others.
fn columns(part: &SceneKernelPart) -> impl Iterator<Item = &TriedPart> {
    let (first, others) = part.tried.split_at(1);
    first.iter().chain(&part.relative).chain(others)
}

/// The numbers to use.
pub(super) fn used_numbers(record: &SceneResult, part: &SceneKernelPart) -> Use {
    Use {
        lead: lead(record, part, &part.tried[0]).to_owned(),
        parts: fixed(record, part),
        notes: notes(record, part),
    }
}

/// The epsilons to use; the best first.
pub(super) fn used(record: &SceneResult, part: &SceneKernelPart) -> Vec<Use> {
    let fixed = used_numbers(record, part);
    let Some(relative) = &part.relative else {
        return vec![fixed];
    };
    let followed = scale_free(record, part, relative);
    let mut all = [fixed, followed];
    if is_scale_free_better(record, part) {
        all.reverse();
    }
    let second = match all.each_ref().map(|it| it.lead.as_str()) {
        [USE, LEAST_BAD] => "not",
        _ => "or",
    };
    all[1].lead = second.to_owned();
    all.into()
}

pub(super) const USE: &str = "use";
const LEAST_BAD: &str = "least bad:";

/// The words before epsilons: that they are to be used, unless the notes say that no numbers are good.
fn lead(record: &SceneResult, part: &SceneKernelPart, tried: &TriedPart) -> &'static str {
    if is_no_good(record, part, tried) {
        LEAST_BAD
    } else {
        USE
    }
}

/// True if epsilons that follow each triangle's size come first.
pub(super) fn is_scale_free_better(record: &SceneResult, part: &SceneKernelPart) -> bool {
    let best = &part.tried[0];
    let is_good = |tried| no_good(record, part, tried).is_empty();
    part.relative.as_ref().is_some_and(|relative| {
        relative.cost < DECISIVE * best.cost
            || part.is_accurate == Some(false)
            || is_good(relative) && !is_good(best)
    })
}

/// Numbers to paste.
fn fixed(record: &SceneResult, part: &SceneKernelPart) -> Vec<String> {
    let epsilons = &part.tried[0].epsilons;
    let t = least_t(part, epsilons).map(|e| match part.takes_interval {
        _ if e.parse() == Ok(0.0) => "no least t: t_min = 0 costs least".to_owned(),
        true => format!("t_min = {}{} on every ray", human(e), unit_of_t(record)),
        false => format!("count a hit only if t >= {}{}", human(e), unit_of_t(record)),
    });
    flag(part, epsilons).into_iter().chain(t).collect()
}

/// The column of what is recommended, where there is no form without a unit.
pub(super) const RECOMMENDED: &str = "recommended";

/// The name of a column.
pub(super) fn column(part: &SceneKernelPart, name: &str) -> String {
    match name {
        "recommended" if part.relative.is_some() => "fixed",
        "recommended" => RECOMMENDED,
        "source" => "as published",
        name if 13 <= name.len() => "as given",
        name => name,
    }
    .to_owned()
}

/// The row of the holes in a picture.
pub(super) const PICTURE: &str = "of a million pixels: holes";

/// An interval of holes whose ends are farther apart than this factor is told in place of their number.
const UNCERTAIN: f64 = 4.0;

/// Holes in a million pixels, in two digits: `0.24`, or `0.002 to 0.3` where few rays leaked; none where they were not counted.
pub(super) fn holes_text(tried: &TriedPart) -> Option<String> {
    let holes = tried.holes_per_million?;
    let number = |x: f64, is_up| match x {
        0.0 => "0".to_owned(),
        ..1e-4 => "< 0.0001".to_owned(),
        _ => human(&format!("{:e}", two_digits(x, is_up))),
    };
    Some(match tried.holes_interval {
        Some([_, high]) if high < 1e-4 => number(high, true),
        Some([..1e-4, high]) => format!("up to {}", number(high, true)),
        Some([low, high]) if low * UNCERTAIN < high => {
            format!("{} to {}", number(low, false), number(high, true))
        }
        _ => number(holes, true),
    })
}

fn holes_cell(tried: &TriedPart) -> Option<Cell> {
    Some(Cell::number(tried.holes_per_million?, holes_text(tried)?))
}

/// The results of what was tried.
pub(super) fn rows(part: &SceneKernelPart) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, count) in part.counts.iter().enumerate() {
        // A family may have nothing of a kind.
        if !matches!(count.rays, Rays::Stratum(_)) && part.tried[0].wrong[i].of == 0 {
            continue;
        }
        rows.push(Row::new(
            label(count),
            columns(part).map(|tried| share_cell(&tried.wrong[i])),
        ));
        if count.rays == Rays::Stratum(Stratum::Edges) {
            let holes: Option<Vec<Cell>> = columns(part).map(holes_cell).collect();
            rows.extend(holes.map(|holes| Row::new(PICTURE, holes)));
        }
        let several = match (count.rays, count.kind) {
            (Rays::Stratum(Stratum::Edges), _) => "at a shared edge: both hit".to_owned(),
            (Rays::Stratum(Stratum::Vertices), _) => "at a shared vertex: several hit".to_owned(),
            (rays, WrongKind::Crack) => format!("{}: several hit", rays.name()),
            _ => continue,
        };
        rows.push(Row::new(
            several,
            columns(part).map(|tried| share_cell(&tried.doubles[i])),
        ));
    }
    for (i, count) in part.counts.iter().enumerate() {
        let found: Vec<Option<&Rate>> = columns(part)
            .map(|tried| tried.exceeded.get(i).filter(|rate| 0 < rate.of))
            .collect();
        if found.iter().any(Option::is_some) {
            let cells = found
                .into_iter()
                .map(|rate| rate.map_or(Cell::none(), share_cell));
            rows.push(Row::new(
                format!("too far off, {}", where_of(count.rays)),
                cells,
            ));
        }
    }
    let costs = columns(part).map(|tried| Cell::number(tried.cost, cost_text(tried.cost)));
    rows.push(Row::new("cost", costs));
    rows
}

/// The errors of the hits that remain.
pub(super) fn error_rows(record: &SceneResult, part: &SceneKernelPart) -> Vec<Row> {
    let mut rows = Vec::new();
    for value in ["t", "point"] {
        let unit = if value == "t" {
            String::new()
        } else {
            of_unit(&record.unit)
        };
        for (place, count) in part.counts.iter().enumerate() {
            let is_of = |error: &&ErrorPart| error.count == place && error.value == value;
            let of = |tried: &TriedPart| tried.errors.iter().find(is_of).map(errors);
            let found: Vec<Option<String>> = columns(part).map(of).collect();
            if found.iter().any(Option::is_some) {
                let cells = found
                    .into_iter()
                    .map(|errors| errors.map_or(Cell::none(), Cell::words));
                rows.push(Row::new(
                    format!("of {value}{unit}, {}", where_of(count.rays)),
                    cells,
                ));
            }
        }
    }
    rows
}

/// Half of the errors, 99 % of them, and the worst.
fn errors(error: &ErrorPart) -> String {
    [error.median, error.most, error.worst]
        .map(short_error)
        .join(" ")
}

/// True if a value is the least that no machine flushes to zero: then every value above zero will do.
fn is_least(value: &str, scalar: ScalarName) -> bool {
    let least = least_normal(scalar);
    value
        .parse::<f64>()
        .is_ok_and(|value| 0.0 < value && value <= least * 1.1)
}

/// Comparisons that follow each triangle's size.
fn scale_free(record: &SceneResult, part: &SceneKernelPart, relative: &TriedPart) -> Use {
    let forms = part
        .knobs
        .iter()
        .zip(&relative.epsilons)
        .map(|(knob, e)| match &knob.form {
            Some(form) if e.parse() != Ok(0.0) => {
                format!("{} = {}", knob.name, form.replacen('e', e, 1))
            }
            _ => format!("{} = {e}", knob.name),
        });
    let (least, most) = (relative.cost, part.tried[0].cost);
    let mut notes = no_good(record, part, relative);
    notes.extend([
        "epsilons that follow each triangle's size, in the place of fixed ones;".to_owned(),
        format!(
            "they cost {}, the best fixed ones {}",
            cost_text(least),
            cost_text(most)
        ),
    ]);
    notes.extend(accuracy(record));
    Use {
        lead: lead(record, part, relative).to_owned(),
        parts: vec![forms.collect::<Vec<_>>().join(", ")],
        notes,
    }
}

/// How far each number may move; what is proved comes last.
pub(super) fn limit_rows<'a>(
    record: &SceneResult,
    part: &'a SceneKernelPart,
) -> impl Iterator<Item = LimitRow<'a>> {
    let limits = part.limits.iter().map(|limit| {
        let (knob, value) = (&part.knobs[limit.knob], limit.value.as_ref());
        LimitRow {
            knob,
            value,
            is_lower: limit.is_lower,
            count: &part.counts[limit.count],
            is_proved: false,
            bound: match value {
                Some(value) if limit.is_lower && is_least(value, part.scalar) => "> 0".to_owned(),
                _ => interval(limit, &unit_of(record, knob)),
            },
            most: format!("1 in {}", group_digits(limit.one_in)),
            fresh: limit
                .fresh
                .as_ref()
                .map_or("-".to_owned(), |fresh| match fresh.count {
                    0 => "0".to_owned(),
                    _ => share(fresh),
                }),
            is_of_scene: limit.set_by.is_some(),
            price: dear(part, limit.price.as_ref().filter(|_| !limit.is_unsure)),
        }
    });
    let proved = part.proved.iter().map(|proved| {
        let knob = &part.knobs[proved.knob];
        LimitRow {
            knob,
            value: Some(&proved.value),
            is_lower: proved.is_lower,
            count: &part.counts[proved.count],
            is_proved: true,
            bound: bound(Some(&proved.value), proved.is_lower, &unit_of(record, knob)),
            most: "0: proved".to_owned(),
            fresh: match proved.fresh.of {
                0 => "-".to_owned(),
                _ => group_digits(proved.fresh.count),
            },
            is_of_scene: false,
            price: dear(part, proved.price.as_ref()),
        }
    });
    limits.chain(proved)
}

/// Limits of a knob that do not meet, and what helps.
pub(super) fn conflict(
    record: &SceneResult,
    part: &SceneKernelPart,
    conflict: &ConflictPart,
) -> String {
    let knob = &part.knobs[part.limits[conflict.lower].knob];
    let instead = match (&conflict.scale_free, &knob.form, knob.role) {
        // With directions of unit length a share of |d| is the number itself.
        (Some([from, to]), Some(form), _)
            if knob.dimension.length != 0 || !record.unit_directions =>
        {
            format!("{form} in its place is within both limits, with e from {from} to {to}")
        }
        (_, _, Role::T) if is_coarse(record, part) => {
            "the numbers are too far apart for such triangles: use f64, or move the scene to the origin".to_owned()
        }
        (_, _, Role::T) => {
            "start shadow rays off the surface, with no t_min for them (`hairline offset` finds how far)".to_owned()
        }
        _ if part.scalar == ScalarName::F64 => "these numbers cost least; no value meets both beside the others".to_owned(),
        _ => "these numbers cost least; to meet both takes wider numbers (f64) or another kernel"
            .to_owned(),
    };
    format!(
        "no value of {} is within all of its limits: {instead}",
        knob.name
    )
}

/// From this share on, a limit's price is said.
const DEAR: f64 = 0.01;

/// The price in words, if it is one that nobody would pay unwarned.
fn dear(part: &SceneKernelPart, of: Option<&PricePart>) -> Option<String> {
    let (more, what) = price(part, of).filter(|(more, _)| DEAR < *more)?;
    Some(format!("costs: {:.1}% {what}", 100.0 * more))
}
