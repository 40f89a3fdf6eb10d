//! The part of a page that shows where: the drawing with its controls, and the first places of each row. A script turns the
//! mesh; without it the tables of places are what there is.

use super::rows::MeshRow;
use crate::page::html::words::{code, shortened};
use crate::page::{Block, Stage};
use hairline_cases::mesh::AimedPart;
use hairline_record::*;
use hairline_record::{AROUND, DrawnRow, MeshDrawing, MeshMark, PLACES};
use hairline_record::{Record, group_digits, number_of};
use maud::{Markup, html};

/// Places of a row that stand in its table.
const LISTED: usize = 20;
/// The words for a fault, in the order of [`crate::audit::PlaceFault`].
const WRONG: [&str; 3] = ["crack", "double", "wrong at a fold"];

/// The drawing and the places of a report that has a drawing.
pub(super) fn block(record: &Record, mesh: &MeshPart, rows: &[MeshRow<'_>]) -> Option<Block> {
    let drawing = record.drawing.as_ref()?;
    let rows = shown(rows, drawing);
    let markup = html! {
        (self::drawing(mesh, drawing, &rows))
        h2 { "Row by row" }
        p {
            "The first places of each row, with the first ray that shows each. Vertices have their numbers in the "
            "file (those with equal coordinates the number of the first), faces "
            @if drawing.has_lines { "the lines of the file." } @else { "are counted from 1." }
        }
        @for (i, row) in rows.iter().enumerate() { (places(i, drawing, row)) }
    };
    let (style, script) = (include_str!("view.css"), include_str!("view.js"));
    Some(Block::Stage(Stage {
        markup: markup.into_string(),
        style,
        script,
    }))
}

/// The drawing: a canvas for the script.
fn drawing(mesh: &MeshPart, drawing: &MeshDrawing, rows: &[ShownRow]) -> Markup {
    let numbers = |values: &mut dyn Iterator<Item = i64>| {
        values
            .map(|value| value.to_string())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let points = numbers(&mut drawing.points.iter().flat_map(|(_, at)| at.map(i64::from)));
    let vertices = numbers(&mut drawing.points.iter().map(|(number, _)| i64::from(*number)));
    let triangles = numbers(
        &mut drawing
            .triangles
            .iter()
            .flat_map(|face| face.map(i64::from)),
    );
    let kinds: Vec<usize> = (0..WRONG.len())
        .filter(|kind| has_kind(rows, *kind))
        .collect();
    // Drawn first: what breaks its promise, otherwise what leaks most.
    let badness = |row: &ShownRow| (row.row.promise().is_some_and(|(_, kept)| !kept), row.marked);
    let worst = (0..rows.len())
        .rev()
        .max_by_key(|i| badness(&rows[*i]))
        .unwrap_or(0);
    html! {
        h2 { "Where" }
        div {
            @if drawing.triangles.is_empty() {
                p { "No row has a place to mark, and the mesh is too large to be drawn whole." }
            } @else {
                p {
                    @if drawing.whole { "The whole mesh" } @else {
                        "Of " (number_of(mesh.triangles, "triangle", "triangles")) " only those around marked places, "
                        (group_digits(drawing.triangles.len() as u64)) " in all: at most " (AROUND) " around each of at most "
                        (PLACES) " places of a row, which are spread over the mesh"
                    }
                    ". Marked are cracks, and doubles and wrong folds of rows that promise exactly one hit."
                }
                form.filters #stage-controls hidden aria-label="The drawing" {
                    label { "Kernel row "
                        select #row autocomplete="off" {
                            @for (i, row) in rows.iter().enumerate() {
                                option value=(i) selected[i == worst] { (shortened(&row.row.part.label(), 80)) " " (row.row.scalar) }
                            }
                        }
                    }
                    @if 1 < kinds.len() {
                        fieldset {
                            @for kind in &kinds { label { input type="checkbox" id={ "kind-" (kind) } checked autocomplete="off"; span class={ "w" (kind) } { (WRONG[*kind]) } } }
                        }
                    }
                    fieldset { label { input #through type="checkbox" autocomplete="off"; "see through" } }
                    button #in type="button" { "Zoom in" }
                    button #out type="button" { "Zoom out" }
                    button #reset type="button" { "Reset" }
                    button #previous type="button" { "Previous place" }
                    button #next type="button" { "Next place" }
                    output #sum for="row" aria-live="polite" {}
                }
                div.stage #stage hidden {
                    canvas #view tabindex="0" role="application" aria-describedby="keys"
                        aria-label="The mesh, with the places where the chosen kernel row goes wrong"
                        data-points=(points) data-vertices=(vertices) data-triangles=(triangles)
                        data-whole[drawing.whole] data-directions=(mesh.directions) data-faces=(drawing.faces()) data-file=(shortened(&mesh.file, 120)) {}
                }
                div #place hidden {
                    div aria-live="polite" { p #what {} p { code #command {} } }
                    p.note #keys {
                        "Drag or use the arrow keys to turn; pinch, + and - to zoom, or the wheel once the drawing has the focus; 0 to "
                        "reset; n and p for the next and the previous place."
                    }
                }
                noscript { p.note { "A script draws the mesh. Without it the places are those of the tables below." } }
            }
        }
    }
}

fn has_kind(rows: &[ShownRow], kind: usize) -> bool {
    let mut marks = rows.iter().flat_map(|row| &row.drawn.marks);
    marks.any(|mark| mark.wrong as usize == kind)
}

/// A row's first places, with its marks for the script.
fn places(i: usize, drawing: &MeshDrawing, row: &ShownRow) -> Markup {
    let [edges, vertices] = &row.drawn.commands;
    let leaking = row.row.at.map(|at| at.leaking);
    let number = |mark: &MeshMark, end: usize| drawing.points[mark.ends[end] as usize].0;
    let index = |part: AimedPart| &row.drawn.commands[part as usize];
    html! {
        details.row id={ "r" (i) } data-marks=(row.marks) data-edges=(edges[0]) data-vertices=(vertices[0]) data-after=(edges[1]) {
            summary {
                b { (row.row.part.label()) " " (row.row.scalar) } ": "
                span.sum {
                    (number_of(leaking[0], "edge leaks", "edges leak")) ", "
                    (number_of(leaking[1], "vertex leaks", "vertices leak")) "; "
                    @if row.marked < row.drawn.marks.len() { (group_digits(row.marked as u64)) " of " (group_digits(row.drawn.marks.len() as u64)) " places are marked" }
                    @else { (number_of(row.marked as u64, "place is marked", "places are marked")) }
                }
            }
            @if 0 < row.marked {
                div.scroll role="group" aria-label={ "Places of " (row.row.part.label()) } tabindex="0" {
                    table {
                        thead { tr { th scope="col" { "place" } th.text scope="col" { "what" } th scope="col" { "rays" } th.text scope="col" { (drawing.faces()) } th.text scope="col" { "the first ray again" } } }
                        tbody {
                            @for mark in row.drawn.marks.iter().take(row.marked.min(LISTED)) {
                                tr {
                                    th scope="row" { @match mark.part {
                                        AimedPart::Edges => { "edge " (number(mark, 0)) "–" (number(mark, 1)) },
                                        AimedPart::Vertices => { "vertex " (number(mark, 0)) },
                                    } }
                                    td.text { span class={ "w" (mark.wrong as usize) } { (WRONG[mark.wrong as usize]) } }
                                    td { (mark.rays) }
                                    td.text { (lines(mark, ", ")) }
                                    td.text.command { (code(&index(mark.part).join(&mark.index.to_string()))) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Bytes for all marks. A row that leaves some of its share leaves them to the next.
const MARKS: usize = 3_500_000;

/// A row with its marks.
struct ShownRow<'a> {
    row: &'a MeshRow<'a>,
    drawn: &'a DrawnRow,
    /// Its marks as the script reads them, and how many there are.
    marks: String,
    marked: usize,
}

/// The rows with as many marks as fit.
fn shown<'a>(all: &'a [MeshRow<'a>], drawing: &'a MeshDrawing) -> Vec<ShownRow<'a>> {
    let mut left = MARKS;
    let mut rows = Vec::new();
    for (i, (row, drawn)) in all.iter().zip(&drawing.rows).enumerate() {
        let share = left / (drawing.rows.len() - i);
        let (mut marks, mut marked) = (String::new(), 0);
        for text in drawn.marks.iter().map(mark_text) {
            if share < marks.len() + text.len() {
                break;
            }
            marks += &text;
            marked += 1;
        }
        left -= marks.len();
        rows.push(ShownRow {
            row,
            drawn,
            marks,
            marked,
        });
    }
    rows
}

/// `what a b rays index line,line;`
fn mark_text(mark: &MeshMark) -> String {
    let MeshMark {
        wrong,
        ends: [a, b],
        rays,
        index,
        ..
    } = mark;
    format!(
        "{} {a} {b} {rays} {index} {};",
        *wrong as usize,
        lines(mark, ",")
    )
}

/// The lines of the faces around, the first eight.
fn lines(mark: &MeshMark, comma: &str) -> String {
    let more = if mark.lines.len() > 8 {
        &["…".to_owned()][..]
    } else {
        &[]
    };
    let first = mark.lines.iter().take(8).map(u32::to_string);
    first
        .chain(more.iter().cloned())
        .collect::<Vec<_>>()
        .join(comma)
}
