//! The record of `offset` as a page: for each kind of hit point what to use, three rows that argue for it, and
//! everything else folded.

use super::choice::derived_name;
use super::record::{BestPart, DerivedPart, OffsetResult, PointsPart};
use super::table::{arguing, of_elsewhere, table};
use super::terms::{how_to_read, words};
use crate::arith::ScalarName;
use crate::case::{Scene, ShortNumber};
use crate::kernel::{self, Role};
use crate::page::{Block, Command, Page, Paged, Use};
use crate::scene::named_scene;
use crate::segments::short_length as size;
use hairline_advice::offset::describe;
use hairline_record::{group_digits, percent};

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
