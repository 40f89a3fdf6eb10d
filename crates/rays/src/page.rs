//! Judged answers as a page: how many are wrong, who loses the hits, and the worst.

use crate::arith::ScalarName;
use crate::asked::AnswerKind;
use crate::record::{group_digits, number_of};
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};
use crate::result::{JudgementCount, LostHits, MissCount, RaysResult, short};
use hairline_scene::Judgement;

/// How many wrong answers stand on a screen.
const SHOWN: usize = 3;

/// How many tests a sentence names.
const NAMED: usize = 3;

/// The least share of lost hits that a test alone misses, or that lie at an end, which says that they are lost there.
const BLAMED: f64 = 0.9;

impl Paged for RaysResult {
    fn page(&self) -> Page {
        let wrong = self.wrong_count();
        let mut blocks = vec![Block::text(self.blame())];
        blocks.extend(self.reading().map(Block::text));
        blocks.push(Block::Table(self.table()));
        let shown = self.counts.iter().filter(|it| 0 < it.count);
        blocks.push(Block::terms(
            shown.map(|it| (it.judgement.name(), meaning(self.kind, it.judgement))),
        ));
        let items = self.worst.iter().map(|it| Item {
            text: it.text.clone(),
            lines: it.commands.clone(),
            ..Item::default()
        });
        let title_of_worst = "Wrong answers (all are counted from 0)";
        blocks.extend(Block::items(title_of_worst, SHOWN, items.collect()));
        let pictures = self.worst.iter().filter_map(|it| it.picture.clone());
        blocks.extend(pictures.map(Block::Picture));
        Page {
            command: "rays",
            title: self.title(),
            tone: if wrong == 0 { Tone::Good } else { Tone::Bad },
            blocks,
        }
    }
}

impl RaysResult {
    fn title(&self) -> String {
        let answers = number_of(self.asked, "answer", "answers");
        let said = match self.wrong_count() {
            0 => format!("None of {answers} is wrong"),
            1 => format!("1 of {answers} is wrong"),
            wrong => format!("{} of {answers} are wrong", group_digits(wrong)),
        };
        match &self.program {
            None => said,
            Some(program) => format!("{said}: {program}"),
        }
    }

    /// Where the hits are lost, as far as it can be told.
    fn blame(&self) -> String {
        if let Some(shift) = self.shift {
            return format!(
                "The faces are numbered otherwise: with {shift:+} most wrong ones are right. Numbers count from 0 here, in the order of the \
                 file."
            );
        }
        match self.kind {
            AnswerKind::Inside if self.wrong_count() == 0 => {
                "Every point is on the side that was answered.".to_owned()
            }
            AnswerKind::Inside => {
                "Their distances from the surface, below, tell how near a point must be to be taken for one on the other side.".to_owned()
            }
            _ => self.lost.sentence(),
        }
    }

    /// How the numbers were read, if not as they are written.
    fn reading(&self) -> Option<String> {
        let as_written = self.right_as_written?;
        let by = match (self.scalar, self.has_unit_directions) {
            (ScalarName::F32, true) => {
                "by mesh and rays rounded to f32, with directions made of length 1, so that t is a length"
            }
            (ScalarName::F32, false) => {
                "by mesh and rays rounded to f32, in which the program seems to compute"
            }
            (ScalarName::F64, _) => {
                "with directions made of length 1, so that t is a length, as the program seems to do"
            }
        };
        let flag = match self.scalar {
            ScalarName::F32 => " (--scalar f64)",
            ScalarName::F64 => "",
        };
        Some(format!(
            "Judged {by}: {} right that way, and {} by the numbers as written{flag}.",
            number_of(self.right_count(), "answer is", "answers are"),
            group_digits(as_written)
        ))
    }

    fn table(&self) -> Table {
        let about = match self.kind {
            AnswerKind::Inside => "how far from the surface, in longest edges of the face there",
            _ => "how far behind the exact point, in longest edges of the nearest face",
        };
        let heads = vec![
            Head::default(),
            Head::of("answers"),
            Head::of("median off").about(about),
            Head::of("most off"),
        ];
        let row = |it: &JudgementCount| {
            let is_wrong = it.judgement.is_wrong();
            let cells = [
                Cell::count(it.count).broken_if(is_wrong && 0 < it.count),
                Cell::optional(it.median_off, short),
                Cell::optional(it.most_off, short),
            ];
            Row::new(it.judgement.name(), cells)
        };
        let shown = self.counts.iter().filter(|it| 0 < it.count);
        Table::new(heads, shown.map(row).collect())
    }
}

impl LostHits {
    fn sentence(&self) -> String {
        if self.count == 0 {
            return "No hit is lost.".to_owned();
        }
        let lost = number_of(self.count, "exact hit is", "exact hits are");
        let start = format!("{lost} lost: missed, or another face is answered.");
        let enough = BLAMED * self.count as f64;
        let of_ends = [
            (self.at_start, "start", "t_min"),
            (self.at_end, "end", "t_max"),
        ];
        for (count, end, name) in of_ends {
            if enough <= count as f64 {
                return format!(
                    "{start} They lie at the {end} of the ray's interval: look at how the program compares t with {name}, and at its \
                     offsets."
                );
            }
        }
        let explained = |all: &[MissCount]| all.first().map_or(0, |it| it.explained) as f64;
        let by_kernels = explained(&self.missed_by_kernels);
        let by_boxes = explained(&self.missed_by_box_tests);
        let kernels = named(&self.missed_by_kernels);
        let box_tests = named(&self.missed_by_box_tests);
        let half = self.count as f64 / 2.0;
        if enough <= by_kernels && by_boxes <= by_kernels {
            return format!(
                "{start} The triangle test loses them: built-in kernels alone miss these on their faces, and hardly any other ({kernels})."
            );
        }
        // The boxes above those of the faces lose rays too.
        if half <= by_boxes && by_kernels < by_boxes {
            return format!(
                "{start} The box test loses them: built-in slab tests miss the boxes around their faces, far more often than those of faces \
                 that are found ({box_tests})."
            );
        }
        let places =
            "a tree, a box, a transform, an end of the interval, or how faces are numbered";
        match (kernels.is_empty(), box_tests.is_empty()) {
            (true, true) => format!(
                "{start} No built-in kernel and no slab test misses just these, so look at {places}."
            ),
            (false, true) => format!(
                "{start} Built-in kernels alone explain so many of them: {kernels}. For the others look at {places}."
            ),
            (true, false) => format!(
                "{start} Built-in slab tests explain so many of them: {box_tests}. For the others look at {places}."
            ),
            (false, false) => format!(
                "{start} Built-in kernels alone explain so many of them: {kernels}; slab tests, on the boxes around the faces: \
                 {box_tests}. For the others look at {places}."
            ),
        }
    }
}

/// The tests that explain most, with how many hits.
fn named(all: &[MissCount]) -> String {
    let named = all.iter().take(NAMED);
    let words: Vec<String> = named
        .map(|it| format!("{} {}", it.name, group_digits(it.explained)))
        .collect();
    words.join(", ")
}

/// The meaning of a judgement of a kind of answers.
fn meaning(kind: AnswerKind, judgement: Judgement) -> String {
    let text = match (kind, judgement) {
        (AnswerKind::All, Judgement::Lost) => {
            "a point at which the mesh is hit, and none of its faces is named"
        }
        (AnswerKind::All, Judgement::Tie) => "every point, by some of the faces that are met there",
        (AnswerKind::All, Judgement::Right) => "every face that is met, in order",
        (AnswerKind::Any, Judgement::Ghost) => "a hit where nothing is",
        (AnswerKind::Any, Judgement::Right) => "a hit where one is, or none where none is",
        (AnswerKind::Count, Judgement::Tie) => "every face that is met counts: two at an edge",
        (AnswerKind::Count, Judgement::Right) => {
            "every point at which the surface is met counts once"
        }
        (AnswerKind::Count, Judgement::Neighbour) => "silhouettes are left out, which nobody sees",
        (AnswerKind::Inside, Judgement::Tie) => "on the surface, where every answer is right",
        (AnswerKind::Inside, Judgement::Right) => "the exact side",
        (AnswerKind::Nearest, Judgement::Right) => "the nearest face, or no hit",
        (AnswerKind::Nearest, Judgement::Tie) => "one of several nearest faces",
        (AnswerKind::Nearest, Judgement::Ghost) => "a face elsewhere, that the ray does not meet",
        (AnswerKind::Nearest | AnswerKind::All, Judgement::Neighbour) => {
            "a face that the ray misses by a hair, or a silhouette left out: nobody sees it"
        }
        (_, judgement) => return begun_small(judgement.about()),
    };
    text.to_owned()
}

/// A sentence as a part of another: its first letter is small.
fn begun_small(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}
