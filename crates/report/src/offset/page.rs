//! The record of `offset` as a page: for each kind of hit point what to use, three rows that argue for it, and
//! everything else folded.

use super::choice::derived_name;
use super::record::{BestPart, DerivedPart, OffsetResult, PointsPart, SchemePart};
use crate::arith::ScalarName;
use crate::case::{Scene, SceneKind, ShortNumber};
use crate::elsewhere::{self, ComparedRates};
use crate::kernel::{self, Role};
use crate::page::{Block, Cell, Command, Head, Page, Paged, Row, Table, Use};
use crate::scene::named_scene;
use crate::segments::short_length as size;
use hairline_advice::offset::describe;
use hairline_record::{Rate, group_digits, interval_of, percent};

impl Paged for OffsetResult {
    fn page(&self) -> Page {
        let mut blocks = Vec::new();
        let mut points: Vec<&str> = self.points.iter().map(|part| part.point.as_str()).collect();
        points.dedup();
        if 1 < points.len() {
            blocks.push(Block::text(format!(
                "Which hit point is yours? {}, or {}: each has its own answer.",
                expression("uv"),
                expression("ray")
            )));
        }
        self.points
            .iter()
            .for_each(|part| blocks.extend(of_points(self, part)));
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", self.unit)
        };
        for part in &self.segments {
            blocks.extend(part.blocks(&self.planes, &unit));
        }
        blocks.push(Block::terms(words(self)));
        blocks.push(Block::Details("How to read".to_owned(), how_to_read(self)));
        let several = self.points.iter().filter(|part| 1 < part.schemes.len());
        let commands = several.filter_map(|part| part.best.as_ref()).take(1);
        let command = |best: &BestPart| Command {
            line: best.command.clone(),
            what: "this one alone",
        };
        let commands: Vec<Command> = commands.map(command).collect();
        if !commands.is_empty() {
            blocks.push(Block::Commands("next", commands));
        }
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" ({})", self.unit)
        };
        let scene = match &self.mesh {
            Some(path) => format!("{} ({})", path.escape_debug(), named_scene(&self.scene)),
            None => named_scene(&self.scene),
        };
        let placed = if self.instance.is_some() {
            ", in an instance"
        } else {
            ""
        };
        let title = format!("{} in {scene}{unit}{placed}", self.answer());
        Page {
            command: "offset",
            title,
            blocks,
            ..Page::default()
        }
    }
}

impl OffsetResult {
    /// The offset to use for the first kind of hit point, in few words; the question where there are several answers.
    fn answer(&self) -> String {
        let Some(part) = self.points.first() else {
            return "Where new rays must start".to_owned();
        };
        match &part.best {
            Some(best) if !best.is_too_high => {
                format!(
                    "Start new rays with {}{}",
                    best.scheme,
                    describe(&best.scheme)
                )
            }
            _ => "No offset here is good".to_owned(),
        }
    }
}

/// A kind of hit point as code forms it.
fn expression(point: &str) -> &'static str {
    match point {
        "uv" => "p = (1-u-v)*a + u*b + v*c",
        _ => "p = o + t*d",
    }
}

/// One kind of hit point of one kernel in one scalar.
fn of_points(record: &OffsetResult, part: &PointsPart) -> Vec<Block> {
    let set = if part.set == "source" {
        String::new()
    } else {
        format!(" ({})", part.set)
    };
    let heading = format!(
        "{}{set} {}, {}",
        part.kernel,
        part.scalar,
        expression(&part.point)
    );
    let mut blocks = vec![Block::Heading(heading)];
    blocks.extend(answer(record, part));
    if 0 < part.hits {
        blocks.push(Block::Table(table(record, arguing(part), false)));
        let title = format!("Every offset, {}", expression(&part.point));
        let mut all = vec![Block::Table(table(
            record,
            part.schemes.iter().collect(),
            true,
        ))];
        all.extend(of_elsewhere(record, part));
        all.push(Block::Notes(least(record, part)));
        blocks.push(Block::Details(title, all));
    }
    blocks
}

/// The offset to use, or a sentence that nothing here is good.
fn answer(record: &OffsetResult, part: &PointsPart) -> Vec<Block> {
    let hits = group_digits(part.hits);
    let Some(best) = &part.best else {
        return vec![Block::text(match part.hits {
            0 => {
                "The kernel hits no triangle of this scene: give it other epsilons (`hairline epsilon --scene`).".to_owned()
            }
            _ if has_endless_normals(record, part) => format!(
                "No offset here is right: the squared length of the normals of such triangles overflows in {}. Use a larger \
                 unit of length, or f64.",
                part.scalar
            ),
            _ => format!("Every offset here fails for some of the {hits} new rays: use a larger one, or f64."),
        })];
    };
    let scheme = part
        .schemes
        .iter()
        .find(|scheme| scheme.name == best.scheme);
    let median = size(
        scheme
            .and_then(|scheme| scheme.height_in_edges.median)
            .unwrap_or(0.0),
    );
    if best.is_too_high {
        return vec![Block::text(format!(
            "None of these: the lowest that never fails, {}, is too high. Half of its new rays start {median} of their \
             triangle's longest edge above it or more, and pass walls. Leave out --scheme, and offsets are made for the \
             scene; if these are too high as well, use f64.",
            best.scheme
        ))];
    }
    let mut notes = Vec::new();
    if let Some(derived) = part.derived.as_ref().filter(|_| best.is_derived) {
        let unknown = match shows_edges(part) {
            true => "",
            false => ", if the kernel lets no other weights through: it shows no test of them",
        };
        let weights = weights(derived);
        notes.push(format!(
            "derived bound: no wrong side on any ray of such a scene with {weights}{unknown}"
        ));
    }
    let kinds = match record.planes.len() {
        0 | 1 => "",
        _ => ", nor on planes or with rays of any other kind",
    };
    let one_in = group_digits(best.one_in);
    notes.push(format!(
        "no wrong side or self-hit on two seeds: 0 of {hits}, at most 1 in {one_in} (95 % sure){kinds}"
    ));
    let text = format!("{}{}", best.scheme, describe(&best.scheme));
    vec![Block::Use(Use {
        lead: "use".to_owned(),
        parts: vec![text],
        notes,
    })]
}

/// True if the squared length of the normal of the scene's largest triangles, the fourth power of an edge, is beyond the
/// range of the scalar.
fn has_endless_normals(record: &OffsetResult, part: &PointsPart) -> bool {
    let largest = if part.scalar == ScalarName::F32 {
        f64::from(f32::MAX)
    } else {
        f64::MAX
    };
    let scene = Scene::parse(&record.scene)
        .ok()
        .filter(|_| record.mesh.is_none());
    scene.is_some_and(|(scene, _)| largest < scene.edge[1].powi(4))
}

/// The rows that argue: what is recommended, the user's own, no offset at all, and the best that was published with a
/// name; of few all.
fn arguing(part: &PointsPart) -> Vec<&SchemePart> {
    if part.schemes.len() <= 4 {
        return part.schemes.iter().collect();
    }
    let is_best = |scheme: &&SchemePart| {
        part.best
            .as_ref()
            .is_some_and(|BestPart { scheme: best, .. }| *best == scheme.name)
    };
    let is_published = |scheme: &&SchemePart| scheme.name != "none" && !scheme.name.contains('=');
    let failed = |scheme: &SchemePart| scheme.wrong.count.max(scheme.self_hits.count);
    let height = |scheme: &SchemePart| scheme.height_in_edges.median.unwrap_or(f64::INFINITY);
    let published = part.schemes.iter().filter(is_published).min_by(|a, b| {
        failed(a)
            .cmp(&failed(b))
            .then(height(a).total_cmp(&height(b)))
    });
    let none = part.schemes.iter().find(|scheme| scheme.name == "none");
    // A scheme that is not described is the user's own.
    let own = part
        .schemes
        .iter()
        .filter(|scheme| describe(&scheme.name).is_empty());
    let mut rows: Vec<&SchemePart> = part.schemes.iter().filter(is_best).collect();
    for scheme in own.chain(none).chain(published) {
        if !rows.iter().any(|row| row.name == scheme.name) {
            rows.push(scheme);
        }
    }
    rows
}

/// The hypothesis of a derived bound.
fn weights(derived: &DerivedPart) -> String {
    let DerivedPart {
        least_weight,
        largest_weight,
        ..
    } = derived;
    format!(
        "u, v and 1-u-v from {} to {}",
        ShortNumber(*least_weight),
        ShortNumber(*largest_weight)
    )
}

/// True if the kernel shows a test that keeps the weights in a range; without one only the rays that were tried say so.
fn shows_edges(part: &PointsPart) -> bool {
    let entry = kernel::find(&part.kernel);
    entry.is_some_and(|entry| entry.info.gates.iter().any(|gate| gate.role == Role::Edge))
}

fn share(rate: &Rate) -> String {
    rate.rate.map_or("-".to_owned(), percent)
}

fn share_cell(rate: &Rate) -> Cell {
    Cell::rate(rate, share(rate))
}

fn height(height: Option<f64>) -> Cell {
    height.map_or(Cell::words("behind"), size_cell)
}

fn size_cell(x: f64) -> Cell {
    Cell::number(x, size(x))
}

/// Some offsets; with everything that is counted, or in short.
fn table(record: &OffsetResult, schemes: Vec<&SchemePart>, is_whole: bool) -> Table {
    type Shown = Box<dyn Fn(&SchemePart) -> Cell>;
    let mut columns: Vec<(Head, Shown)> = vec![
        (
            Head::of("wrong side"),
            Box::new(|scheme| share_cell(&scheme.wrong)),
        ),
        (
            Head::of("self-hits"),
            Box::new(|scheme| share_cell(&scheme.self_hits)),
        ),
        (
            Head::of("height: median"),
            Box::new(|scheme| height(scheme.height_in_edges.median)),
        ),
    ];
    if is_whole {
        let interval = |scheme: &SchemePart| {
            let text = interval_of(&scheme.wrong);
            Cell::rate(&scheme.wrong, text.trim_matches([' ', '(', ')']))
        };
        columns[0] = (Head::of("wrong side [95 %]"), Box::new(interval));
        let mut more = |head: &str, shown: Shown| columns.push((Head::of(head).optional(), shown));
        more(
            "99 %",
            Box::new(|scheme| height(scheme.height_in_edges.p99)),
        );
        more(
            "top seen",
            Box::new(|scheme| size_cell(scheme.height_in_edges.highest)),
        );
        more(
            "in ulps",
            Box::new(|scheme| height(scheme.height_in_ulps.median)),
        );
        more(
            "times least",
            Box::new(|scheme| scheme.over_least.map_or(Cell::none(), size_cell)),
        );
    }
    if !is_whole && 1 < record.planes.len() {
        columns.insert(1, (Head::of("on its worst kind"), Box::new(on_worst_kind)));
    }
    columns.push((
        Head::of(format!("past a wall at {}", record.wall)),
        Box::new(|scheme| share_cell(&scheme.beyond_wall)),
    ));
    columns.push((
        Head::of(format!("past a fold of {}\u{b0}", record.fold)),
        Box::new(|scheme| share_cell(&scheme.past_neighbour)),
    ));
    let row = |scheme: &&SchemePart| {
        Row::new(&scheme.name, columns.iter().map(|(_, shown)| shown(scheme)))
    };
    let rows = schemes.iter().map(row).collect();
    let heads = [Head::of("offset")]
        .into_iter()
        .chain(columns.into_iter().map(|(head, _)| head));
    Table::new(heads.collect(), rows)
}

/// The largest share of wrong sides on any kind of planes, and that kind; nothing if it is the first.
fn on_worst_kind(scheme: &SchemePart) -> Cell {
    let of_rate = |rate: &Rate| rate.rate.unwrap_or(0.0);
    let worst = scheme
        .elsewhere
        .iter()
        .max_by(|a, b| of_rate(&a.wrong).total_cmp(&of_rate(&b.wrong)));
    match worst {
        Some(worst) if of_rate(&scheme.wrong) < of_rate(&worst.wrong) => {
            let text = format!("{} {}", share(&worst.wrong), worst.plane);
            Cell::rate(&worst.wrong, text)
        }
        _ => Cell::none(),
    }
}

/// The shares of wrong sides on other kinds of planes, of the schemes that are worse there.
fn of_elsewhere(record: &OffsetResult, part: &PointsPart) -> Vec<Block> {
    let rows = part.schemes.iter().map(|scheme| ComparedRates {
        label: scheme.name.clone(),
        rates: [&scheme.wrong]
            .into_iter()
            .chain(scheme.elsewhere.iter().map(|other| &other.wrong))
            .cloned()
            .collect(),
    });
    elsewhere::blocks(
        "more wrong sides",
        &record.planes,
        &rows.collect::<Vec<_>>(),
        share,
    )
}

/// How far off the hit points themselves are, the derived bound, and what is left out.
fn least(record: &OffsetResult, part: &PointsPart) -> Vec<String> {
    let least = &part.least;
    let unit = if record.unit.is_empty() {
        String::new()
    } else {
        format!(" {}", record.unit)
    };
    let mut notes = Vec::new();
    if 0 < least.needed.count {
        let (lengths, ulps) = (&least.lengths, &least.ulps);
        notes.push(format!(
            "{} of the hit points are themselves wrong; the smallest safe offset along the normal there: median {}{unit}, \
             99 % {}{unit}, largest seen {}{unit}; in ulps of the point {}, {}, {}",
            percent(least.needed.rate.unwrap_or(0.0)),
            size(lengths.median),
            size(lengths.p99),
            size(lengths.largest),
            size(ulps.median),
            size(ulps.p99),
            size(ulps.largest),
        ));
    }
    if let Some(derived) = &part.derived {
        let range = match derived.least_weight < 0.0 {
            true => format!(
                "; that range: at this epsilon the edge test lets no weight below {} through, and the three add up to 1",
                ShortNumber(derived.least_weight)
            ),
            false => String::new(),
        };
        notes.push(format!(
            "derived bound: {}{unit} or more, for {} (by hand: docs/guide/offset.md){range}",
            derived_name(derived.normal),
            weights(derived)
        ));
    }
    let left_out = [
        (part.missed, "first rays that the kernel missed"),
        (
            part.without_side,
            "hits of triangles without area or along their plane",
        ),
        (part.not_finite, "hit points that are not finite"),
        (
            least.none,
            "hit points that no offset along the normal helps",
        ),
    ];
    let left_out = left_out.into_iter().filter(|(count, _)| 0 < *count);
    let words: Vec<String> = left_out
        .map(|(count, what)| format!("{} {what}", group_digits(count)))
        .collect();
    notes.extend((!words.is_empty()).then(|| format!("left out: {}", words.join(", "))));
    notes
}

/// The words of the first screen.
fn words(record: &OffsetResult) -> [(&'static str, String); 4] {
    [
        ("n", "the unit normal on the side that the first ray came from; u: half an ulp of 1".to_owned()),
        (
            "wrong side",
            "the new ray starts on the exact plane of its triangle or behind it; self-hits: the kernel says that it hits \
             that triangle"
                .to_owned(),
        ),
        (
            "height",
            format!(
                "over the plane, in longest edges of the triangle; a wall stands {} of one in front of it",
                record.wall
            ),
        ),
        (
            "blocked",
            "a shadow ray from another point to p hits the surface at p itself, with a direction that goes to p;              shorter: by how much it ends before p"
                .to_owned(),
        ),
    ]
}

/// The rest.
fn how_to_read(record: &OffsetResult) -> Vec<Block> {
    let fold = record.fold;
    let terms = [
        ("behind", "half of the starts (or 99 %) are not above the plane".to_owned()),
        ("in ulps", "the height in ulps of the triangle's largest coordinate: the median".to_owned()),
        (
            "a fold",
            format!("starts behind a neighbour on the edge nearest to p, folded up to {fold} degrees with the triangle"),
        ),
        (
            "times least",
            "the way along the normal over the shortest that is right, where p itself is wrong (median)".to_owned(),
        ),
        ("new rays", "leave to the side that the first ray came from, in every direction alike".to_owned()),
        (
            "made",
            format!(
                "offsets are made for the scene on seed {}, and counted on seed {}; `hairline list schemes` has the \
                 sources, --format json a wrong start of each",
                record.pilot_seed, record.seed
            ),
        ),
    ];
    vec![Block::terms(terms.into_iter().chain(kinds(record)))]
}

/// The kinds of planes and rays in words, where there are several.
fn kinds(record: &OffsetResult) -> Option<(&'static str, String)> {
    let kinds = record
        .planes
        .iter()
        .filter_map(|name| SceneKind::named(name));
    let words: Vec<_> = kinds
        .map(|kind| format!("{kind}: {}", kind.in_words()))
        .collect();
    (1 < words.len()).then(|| ("kinds", words.join("; ")))
}
