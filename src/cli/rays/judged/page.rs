//! Judged answers as a page: how many are wrong, who lost them, and the worst.

use super::{JudgedAnswers, JudgementCount, SHOWN};
use crate::record::{group_digits, number_of};
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};

/// How many kernels a sentence names.
const NAMED: usize = 3;

/// The least share of lost hits that a kernel alone misses which says that the triangle test lost them.
const BLAMED: f64 = 0.9;

pub(super) fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    match (1e-3..1e6).contains(&number.abs()) {
        true => format!("{number:.3}"),
        false => format!("{number:.2e}"),
    }
}

impl Paged for JudgedAnswers {
    fn page(&self) -> Page {
        let wrong = self.wrong_count();
        let answers = number_of(self.rays, "answer", "answers");
        let title = match wrong {
            0 => format!("None of {answers} is wrong"),
            1 => format!("1 of {answers} is wrong"),
            wrong => format!("{} of {answers} are wrong", group_digits(wrong)),
        };
        let mut blocks = vec![Block::text(self.blame())];
        if let Some(in_f64) = self.right_in_f64 {
            blocks.push(Block::text(format!(
                "Judged by mesh and rays rounded to f32, in which the program seems to compute: {} right there, and {} by the \
                 numbers as written (--scalar f64).",
                number_of(self.right_count(), "answer is", "answers are"),
                group_digits(in_f64)
            )));
        }
        blocks.push(Block::Table(self.table()));
        let shown = self.counts.iter().filter(|it| 0 < it.count);
        blocks.push(Block::terms(
            shown.map(|it| (it.judgement, it.meaning.to_owned())),
        ));
        let items = self.worst.iter().map(|it| Item {
            text: it.text.clone(),
            lines: it.command.iter().cloned().collect(),
            ..Item::default()
        });
        let title_of_worst = "Wrong answers (rays and faces are counted from 0)";
        blocks.extend(Block::items(title_of_worst, SHOWN, items.collect()));
        Page {
            command: "rays",
            title,
            tone: if wrong == 0 { Tone::Good } else { Tone::Bad },
            blocks,
        }
    }
}

impl JudgedAnswers {
    /// Who lost the hits, as far as it can be told.
    fn blame(&self) -> String {
        if let Some(shift) = self.shift {
            return format!(
                "The faces are numbered otherwise: with {shift:+} most wrong ones are right. Numbers count from 0 here, in the order of the \
                 file."
            );
        }
        if self.lost == 0 {
            return "No hit is lost.".to_owned();
        }
        let named: Vec<String> = self
            .missed_by
            .iter()
            .filter(|it| 0 < it.count)
            .take(NAMED)
            .map(|it| format!("{} {}", it.kernel, group_digits(it.count)))
            .collect();
        let most = self.missed_by.first().map_or(0, |it| it.count);
        let lost = number_of(self.lost, "nearest hit is", "nearest hits are");
        let start = format!("{lost} lost: missed, or another face is answered.");
        let places =
            "a tree, a box, a transform, an end of the interval, or how faces are numbered";
        if most == 0 {
            format!(
                "{start} No built-in kernel alone misses one of them on its face, so look at {places}."
            )
        } else if BLAMED * self.lost as f64 <= most as f64 {
            format!(
                "{start} The triangle test lost them: a built-in kernel alone misses nearly all of them too ({}).",
                named.join(", ")
            )
        } else {
            format!(
                "{start} A built-in kernel alone misses so many of them: {}. For the others look at {places}.",
                named.join(", ")
            )
        }
    }

    fn table(&self) -> Table {
        let heads = vec![
            Head::default(),
            Head::of("answers"),
            Head::of("median off")
                .about("how far behind the exact point, in longest edges of the nearest face"),
            Head::of("most off"),
        ];
        let row = |it: &JudgementCount| {
            let is_wrong = it.kind.is_wrong();
            let cells = [
                Cell::count(it.count).broken_if(is_wrong && 0 < it.count),
                Cell::optional(it.median, short),
                Cell::optional(it.most, short),
            ];
            Row::new(it.judgement, cells)
        };
        let shown = self.counts.iter().filter(|it| 0 < it.count);
        Table::new(heads, shown.map(row).collect())
    }
}
