//! Judged answers as a page: how many are wrong, who loses the hits, and the worst.

use crate::asked::AnswerKind;
use crate::blame::FEWEST;
use crate::record::{group_digits, number_of};
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};
use crate::result::{
    JudgementCount, LostHits, MissCount, RaysResult, WithoutBoxes, WrongRays, short,
};
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
        let mut blocks: Vec<Block> = self.blame().map(Block::text).into_iter().collect();
        blocks.extend(self.wrong_rays.sentence().map(Block::text));
        blocks.extend(self.ends().map(Block::text));
        blocks.extend(self.beyond().map(Block::text));
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
        if (self.worst.len() as u64) < wrong {
            blocks.push(Block::text(
                "--format csv has every answer, with its judgement and the exact one.",
            ));
        }
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
        let undefined = self.count(Judgement::NotDefined);
        let said = match self.wrong_count() {
            0 if 0 < undefined => {
                format!("{} of {answers} cannot be judged", group_digits(undefined))
            }
            0 => format!("None of {answers} is wrong"),
            1 => format!("1 of {answers} is wrong"),
            wrong => format!("{} of {answers} are wrong", group_digits(wrong)),
        };
        match &self.program {
            None => said,
            Some(program) => format!("{said}: {program}"),
        }
    }

    /// Where the hits are lost, as far as it can be told; or whether points can be judged at all.
    fn blame(&self) -> Option<String> {
        if let Some(shift) = self.shift {
            return Some(format!(
                "The faces are numbered otherwise: with {shift:+} most wrong ones are right. Numbers count from 0 here, in the order of the \
                 file."
            ));
        }
        let has_wrong = 0 < self.wrong_count();
        match self.kind {
            AnswerKind::Inside if 0 < self.count(Judgement::NotDefined) => {
                Some("The surface is open, so only points on it can be judged: close it, or ask about hits.".to_owned())
            }
            AnswerKind::Inside if has_wrong && self.wound_evenly == self.wrong_count() => {
                Some("All wrong ones are taken to be outside where the surface winds around them twice, or another even number of times: does your \
                     program count crossings, and take odd numbers for inside?".to_owned())
            }
            AnswerKind::Inside if BLAMED * self.asked as f64 <= self.wrong_count() as f64 => {
                Some("Nine in ten are on the other side: inside and outside seem to be exchanged.".to_owned())
            }
            AnswerKind::Inside if has_wrong => {
                Some("\"Off\" is the distance from the surface: small ones are points that were taken to be on its other side; where they are \
                     large, hits are lost or counted twice on the way.".to_owned())
            }
            AnswerKind::Inside => None,
            AnswerKind::Count => None,
            _ if self.lost.count == 0 && has_wrong => None,
            _ => Some(self.lost_hits()),
        }
    }

    fn lost_hits(&self) -> String {
        let LostHits { count, .. } = self.lost;
        let lost = group_digits(count);
        let start = match (self.kind, count) {
            (_, 0) => return "No hit is lost.".to_owned(),
            (AnswerKind::Nearest, 1) => {
                "1 answer misses the exact hit: it names nothing, or another face.".to_owned()
            }
            (AnswerKind::Nearest, _) => {
                format!("{lost} answers miss the exact hit: they name nothing, or another face.")
            }
            (AnswerKind::Any, _) => {
                format!("{lost} of the answers say that nothing is hit, where something is.")
            }
            _ => format!("{lost} of the answers leave a hit out."),
        };
        let reason = self.lost.reason(self.program.is_some());
        format!("{start} {}", reason.unwrap_or_else(|| self.no_reason()))
    }

    /// Why no test and no end explains the lost hits.
    fn no_reason(&self) -> String {
        let LostHits { count, found, .. } = self.lost;
        if count.min(found) < FEWEST as u64 {
            let found = number_of(found, "hit is", "hits are");
            return format!("{found} found: too few of these or of those to tell who loses them.");
        }
        if self.wrong_rays.are_at_edges() {
            return "Their rays meet edges or vertices exactly, and no built-in test misses just these: does yours take u = 0 and v = 0 for \
                    hits, in both neighbours?"
                .to_owned();
        }
        let nearest = self.lost.nearest_test().unwrap_or_default();
        format!(
            "No built-in triangle test and no slab test misses nine in ten of these and finds the others.{nearest} If yours are others, look at \
             them; else at the tree, a transform, an end of the interval, or how faces are numbered."
        )
    }

    /// Answers outside of the rays' intervals.
    fn ends(&self) -> Option<String> {
        let (is_one, answers) = match self.outside_interval {
            0 => return None,
            1 => (true, "1 wrong answer has".to_owned()),
            count => (false, format!("{} wrong answers have", group_digits(count))),
        };
        let its = if is_one { "its ray's" } else { "their rays'" };
        Some(format!(
            "{answers} a t before {its} t_min or behind t_max: does your program know the ends?"
        ))
    }

    /// Answers with faces that do not exist, if not all faces are numbered otherwise.
    fn beyond(&self) -> Option<String> {
        let name = match (self.beyond_the_mesh, self.shift) {
            (0, _) | (_, Some(_)) => return None,
            (1, None) => "1 answer names".to_owned(),
            (count, None) => format!("{} answers name", group_digits(count)),
        };
        Some(format!(
            "{name} a face that the mesh does not have: faces are counted from 0 here, so the last one's number is one less than there are faces."
        ))
    }

    fn table(&self) -> Table {
        let about = match self.kind {
            AnswerKind::Inside => "distance from the surface, in longest edges of the face there",
            _ => {
                "distance from the exact point, before or behind it, in longest edges of the nearest face"
            }
        };
        let shown = || self.counts.iter().filter(|it| 0 < it.count);
        let has_distances = shown().any(|it| it.most_off.is_some());
        let mut heads = vec![Head::default(), Head::of("answers")];
        if has_distances {
            heads.push(Head::of("median off").about(about));
            heads.push(Head::of("most off"));
        }
        let row = |it: &JudgementCount| {
            let is_wrong = it.judgement.is_wrong();
            let mut cells = vec![Cell::count(it.count).broken_if(is_wrong)];
            if has_distances {
                cells.push(Cell::optional(it.median_off, short));
                cells.push(Cell::optional(it.most_off, short));
            }
            Row::new(it.judgement.name(), cells)
        };
        Table::new(heads, shown().map(row).collect())
    }
}

impl WrongRays {
    /// True if nearly all meet an edge or a vertex, or run in a plane.
    fn are_at_edges(&self) -> bool {
        let there = self.in_plane + self.at_edge;
        let all = there + self.near_edge + self.grazing + self.inside + self.nothing;
        BLAMED * all as f64 <= there as f64
    }

    /// A sentence about the rays of wrong answers.
    fn sentence(&self) -> Option<String> {
        let kinds = [
            (self.in_plane, "run in the plane of a face that they meet"),
            (self.at_edge, "meet an edge or a vertex exactly"),
            (
                self.near_edge,
                "meet a face within a millionth of it from an edge",
            ),
            (self.grazing, "graze a face, at a slope below 1/1000"),
            (self.inside, "meet the inside of a face"),
            (self.nothing, "meet nothing"),
        ];
        let there = kinds.into_iter().filter(|(count, _)| 0 < *count);
        let words: Vec<String> = there
            .map(|(count, what)| format!("{} {what}", group_digits(count)))
            .collect();
        if words.is_empty() {
            return None;
        }
        Some(format!("Rays of the wrong answers: {}.", words.join(", ")))
    }
}

impl LostHits {
    /// Who loses most of them, if a test or an end does.
    fn reason(&self, is_plain_program: bool) -> Option<String> {
        let enough = BLAMED * self.count as f64;
        let of_ends = [
            (self.at_start, "start", "t_min"),
            (self.at_end, "end", "t_max"),
        ];
        for (count, end, name) in of_ends {
            if enough <= count as f64 {
                return Some(format!(
                    "They lie at the {end} of the ray's interval: look at how the program compares t with {name}, and at its \
                     offsets."
                ));
            }
        }
        if let Some(without) = &self.without_boxes {
            return Some(without.sentence());
        }
        if is_plain_program {
            return Some("Every face was asked about, so the triangle test loses them.".to_owned());
        }
        let explained = |all: &[MissCount]| all.first().map_or(0, |it| it.explained) as f64;
        let by_kernels = explained(&self.missed_by_kernels);
        let by_boxes = explained(&self.missed_by_box_tests);
        let kernels = named(&self.missed_by_kernels);
        let box_tests = named(&self.missed_by_box_tests);
        let by_transforms = explained(&self.missed_by_transforms);
        // A test that explains as much is the simpler reason.
        if enough <= by_transforms && by_kernels.max(by_boxes) < by_transforms {
            return Some(format!(
                "The instance's transform loses them: in f32 it parts these rays from their faces, and hardly any other ({}).",
                named(&self.missed_by_transforms)
            ));
        }
        let half = self.count as f64 / 2.0;
        if enough <= by_kernels && by_boxes <= by_kernels {
            return Some(format!(
                "The triangle test loses them: built-in kernels alone miss these on their faces, and hardly any other ({kernels})."
            ));
        }
        // The boxes above those of the faces lose rays too.
        if half <= by_boxes && by_kernels < by_boxes {
            return Some(format!(
                "The box test loses them: built-in slab tests miss the boxes around their faces, far more often than those of faces \
                 that are found ({box_tests})."
            ));
        }
        None
    }
}

impl LostHits {
    /// The test that explains most of the lost hits, if it explains some.
    fn nearest_test(&self) -> Option<String> {
        let best = |all: &[MissCount]| all.first().map(|it| it.explained).unwrap_or(0);
        let tests = [
            &self.missed_by_kernels,
            &self.missed_by_box_tests,
            &self.missed_by_transforms,
        ];
        let nearest = tests.into_iter().max_by_key(|all| best(all))?;
        (self.count <= 4 * best(nearest)).then(|| {
            let test = &nearest[0];
            let epsilon = test.epsilon.iter().map(|it| format!(" ({it})"));
            format!(
                " {}{} comes nearest, with {} of {}.",
                test.name,
                epsilon.collect::<String>(),
                group_digits(test.explained),
                group_digits(self.count)
            )
        })
    }
}

impl WithoutBoxes {
    fn sentence(&self) -> String {
        let WithoutBoxes { tried, lost } = *self;
        let those = match tried {
            1 => "the one".to_owned(),
            tried => format!("{} of them", group_digits(tried)),
        };
        match lost {
            0 => format!(
                "Where every face is asked, none of {} is lost: the box test loses them.",
                number_of(tried, "that was tried", "that were tried")
            ),
            lost if lost == tried => format!(
                "Where every face is asked, {those} that {} tried {} lost all the same: the triangle test loses them.",
                if tried == 1 { "was" } else { "were" },
                if tried == 1 { "is" } else { "are" },
            ),
            lost => format!(
                "Of {} that were tried the triangle test loses {}, where every face is asked; the box test loses the others.",
                group_digits(tried),
                group_digits(lost)
            ),
        }
    }
}

/// The tests that explain most, with how many hits.
fn named(all: &[MissCount]) -> String {
    let named = all.iter().take(NAMED);
    let words: Vec<String> = named
        .map(|it| match &it.epsilon {
            None => format!("{} {}", it.name, group_digits(it.explained)),
            Some(epsilon) => format!("{} ({epsilon}) {}", it.name, group_digits(it.explained)),
        })
        .collect();
    words.join(", ")
}

/// The meaning of a judgement of a kind of answers.
fn meaning(kind: AnswerKind, judgement: Judgement) -> String {
    let text = match (kind, judgement) {
        (AnswerKind::All, Judgement::Lost) => {
            "a point at which the mesh is hit, and none of its faces is named"
        }
        (AnswerKind::All, Judgement::Tie) => {
            "right: every point, by some of the faces that are met there"
        }
        (AnswerKind::All, Judgement::Right) => "every face that is met, in order",
        (_, Judgement::SelfHit) => {
            "the face that the ray starts at, and misses by a hair, in front of where it hits: start new rays off the surface"
        }
        (AnswerKind::Any, Judgement::Ghost) => "a hit where nothing is",
        (AnswerKind::Any, Judgement::Right) => "a hit where one is, or none where none is",
        (AnswerKind::Count, Judgement::Tie) => {
            "right: some points count once for each of their faces, two at an edge"
        }
        (AnswerKind::Count, Judgement::Right) => {
            "every point at which the surface is met counts once"
        }
        (AnswerKind::Count, Judgement::Neighbour) => {
            "a silhouette that the ray touches is not counted, or one that it misses by a hair is: nobody sees it"
        }
        (AnswerKind::Inside, Judgement::Tie) => "right: on the surface every answer is",
        (AnswerKind::Inside, Judgement::Right) => "the exact side",
        (AnswerKind::Nearest, Judgement::Right) => "the nearest face, or no hit",
        (AnswerKind::Nearest, Judgement::Tie) => "right: one of several nearest faces",
        (AnswerKind::Nearest, Judgement::Ghost) => "a face elsewhere, that the ray does not meet",
        (AnswerKind::Nearest | AnswerKind::All, Judgement::Neighbour) => {
            "a face that the ray misses by a hair, or a silhouette that the program left out: nobody sees it"
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
