//! The answers of a program to a file of rays, judged.

use super::RaysArguments;
use super::found::of_all;
use super::one::{case_of, explain_command};
use super::read;
use crate::arith::ScalarName;
use crate::audit::Row as KernelRow;
use crate::case::Case;
use crate::cli::exit::{Failure, Status};
use crate::corpus::lines::AnyCase;
use crate::files::mesh::Mesh;
use crate::kernel::{KERNELS, Scalar, Verdict, verdicts_of};
use crate::record::{group_digits, number_of};
use crate::report::Format;
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};
use hairline_scene::{Answer, Judged, Judgement, Nearest, Ray, Scene};
use serde::Serialize;
use std::cmp::Reverse;

/// How many wrong answers are shown with their commands.
const SHOWN: usize = 3;

/// How many kernels a sentence names.
const NAMED: usize = 3;

/// The least share of lost hits that a kernel alone misses which says that the triangle test lost them.
const BLAMED: f64 = 0.9;

/// How many wrong answers are looked at for what the kernels say.
const ASKED: usize = 10_000;

/// How a program did.
#[derive(Serialize)]
struct JudgedAnswers {
    scalar: &'static str,
    rays: u64,
    /// Rays that hit the mesh.
    hits: u64,
    counts: Vec<JudgementCount>,
    /// Rays whose nearest faces are others when mesh and rays are taken as f64, where f32 was asked for.
    other_in_f64: Option<u64>,
    /// How many hits that the program lost, or answered with a wrong face, kernels were asked about.
    asked: u64,
    /// How many of these each kernel misses by itself, on every nearest face.
    missed_by: Vec<KernelMisses>,
    worst: Vec<WrongAnswer>,
}

/// How often a judgement was made.
#[derive(Serialize)]
struct JudgementCount {
    judgement: &'static str,
    meaning: &'static str,
    count: u64,
    /// The median distance behind the exact hit, in longest edges of the face, where it is known.
    median: Option<f64>,
    /// The largest.
    most: Option<f64>,
}

/// A kernel, and how many of the lost hits it misses too.
#[derive(Serialize)]
struct KernelMisses {
    kernel: &'static str,
    count: u64,
}

/// A wrong answer.
#[derive(Serialize)]
struct WrongAnswer {
    /// The ray's number, from 0.
    ray: usize,
    text: String,
    /// Shows the nearest face, or the one that was answered.
    command: Option<String>,
}

/// The judgements in the order of a screen, with a name and a meaning.
const KINDS: [(Judgement, &str, &str); 7] = [
    (Judgement::Lost, "lost", "a miss where the mesh is hit"),
    (
        Judgement::Farther,
        "farther face",
        "a face behind the nearest one: slipped through",
    ),
    (
        Judgement::Ghost,
        "ghost",
        "a face elsewhere, that the ray does not meet",
    ),
    (
        Judgement::WrongT,
        "wrong t",
        "the right face, off by over 1/1000 of its longest edge",
    ),
    (
        Judgement::Neighbour,
        "neighbour",
        "a face that the ray misses by a hair, and the right point",
    ),
    (
        Judgement::Tie,
        "right, a tie",
        "one of several nearest faces",
    ),
    (Judgement::Right, "right", "the nearest face, or no hit"),
];

/// Judges all answers.
pub(super) fn run<F: Scalar>(
    arguments: &RaysArguments,
    mesh: &Mesh,
    scene: &Scene<F>,
    rays: &[Ray<F>],
    file: &str,
) -> Result<Status, Failure>
where
    Case<F>: Into<AnyCase>,
{
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let answers = read::answers(file, rays.len())?;
    let judged = of_all(arguments, rays.len(), |index| {
        scene.judge(&rays[index], &answers[index])
    })?;
    let run = JudgedRun {
        mesh,
        rays,
        answers: &answers,
        judged: &judged,
    };
    let mut result = run.result();
    if F::NAME == ScalarName::F32 {
        result.other_in_f64 = Some(run.others_in_f64(arguments)?);
    }
    let is_wrong = judged.iter().any(|judged| judged.judgement.is_wrong());
    arguments.output.write(outputs, &result)?;
    Ok(match is_wrong {
        true => Status::Disagreements,
        false => Status::Success,
    })
}

/// Rays with their answers and judgements, each list in the order of the rays.
struct JudgedRun<'a, F: Scalar> {
    mesh: &'a Mesh,
    rays: &'a [Ray<F>],
    answers: &'a [Answer],
    judged: &'a [Judged],
}

impl<F: Scalar> JudgedRun<'_, F>
where
    Case<F>: Into<AnyCase>,
{
    fn result(&self) -> JudgedAnswers {
        let hits = self.judged.iter().filter(|it| it.nearest.is_some()).count();
        let (asked, missed_by) = self.kernels_that_miss();
        JudgedAnswers {
            scalar: F::NAME.name(),
            rays: self.rays.len() as u64,
            hits: hits as u64,
            counts: KINDS.iter().map(|kind| self.count(kind)).collect(),
            other_in_f64: None,
            asked,
            missed_by,
            worst: self.worst(),
        }
    }

    fn count(
        &self,
        (judgement, name, meaning): &(Judgement, &'static str, &'static str),
    ) -> JudgementCount {
        let of_kind = self.judged.iter().filter(|it| it.judgement == *judgement);
        let mut behind: Vec<f64> = of_kind
            .clone()
            .filter_map(|it| it.behind.map(f64::abs))
            .collect();
        behind.sort_by(f64::total_cmp);
        JudgementCount {
            judgement: name,
            meaning,
            count: of_kind.count() as u64,
            median: behind.get(behind.len() / 2).copied(),
            most: behind.last().copied(),
        }
    }

    /// How many hits that were lost or answered with a wrong face kernels were asked about, and how many each misses by itself:
    /// what it is most often to blame for first.
    fn kernels_that_miss(&self) -> (u64, Vec<KernelMisses>) {
        let is_lost = |judged: &(usize, &Judged)| {
            let kind = judged.1.judgement;
            judged.1.nearest.is_some() && kind.is_wrong() && kind != Judgement::WrongT
        };
        let lost: Vec<(usize, &Judged)> = self
            .judged
            .iter()
            .enumerate()
            .filter(is_lost)
            .take(ASKED)
            .collect();
        let mut all: Vec<KernelMisses> = KERNELS
            .iter()
            .filter_map(|entry| {
                let row = KernelRow::named(entry.info.name, None, "own").ok()?;
                let subject = F::subject(entry)?;
                let misses = |(index, judged): &&(usize, &Judged)| {
                    let nearest = judged.nearest.as_ref().map_or(&[][..], |it| &it.faces);
                    let cases: Vec<Case<F>> = nearest
                        .iter()
                        .map(|face| case_of(self.mesh, &self.rays[*index], *face))
                        .collect();
                    let mut verdicts = vec![Verdict::miss(None); cases.len()];
                    verdicts_of(subject, &cases, &row.epsilons::<F>(), &mut verdicts);
                    verdicts.iter().all(|verdict| !verdict.hit)
                };
                Some(KernelMisses {
                    kernel: entry.info.name,
                    count: lost.iter().filter(misses).count() as u64,
                })
            })
            .collect();
        all.sort_by_key(|it| (Reverse(it.count), it.kernel));
        (lost.len() as u64, all)
    }

    /// Some wrong answers: the farthest of each kind.
    fn worst(&self) -> Vec<WrongAnswer> {
        let wrong = self.judged.iter().enumerate();
        let mut wrong: Vec<(usize, &Judged)> =
            wrong.filter(|(_, it)| it.judgement.is_wrong()).collect();
        let size = |judged: &Judged| judged.behind.map_or(0.0, f64::abs);
        wrong.sort_by(|(_, a), (_, b)| {
            let by_kind = a.judgement.cmp(&b.judgement);
            by_kind.then(size(b).total_cmp(&size(a)))
        });
        // One of each kind first.
        let mut seen = Vec::new();
        let (first, others): (Vec<_>, Vec<_>) = wrong.into_iter().partition(|(_, judged)| {
            let is_first = !seen.contains(&judged.judgement);
            seen.push(judged.judgement);
            is_first
        });
        let all = first.into_iter().chain(others).take(SHOWN);
        all.map(|(index, judged)| self.told(index, judged))
            .collect()
    }

    fn told(&self, index: usize, judged: &Judged) -> WrongAnswer {
        let ray = &self.rays[index];
        let nearest = judged.nearest.as_ref().map(|it| it.faces[0]);
        let answer = match self.answers[index].face {
            None => "a miss".to_owned(),
            Some(face) => format!("face {face}"),
        };
        let truth = match nearest {
            None => "no face is hit".to_owned(),
            Some(face) => format!("the nearest is face {face}"),
        };
        let behind = match judged.behind {
            Some(behind) => format!(", {} longest edges behind", short(behind)),
            None => String::new(),
        };
        let shown = nearest.or(self.answers[index].face);
        let command = shown
            .filter(|face| (*face as usize) < self.mesh.triangles.len())
            .map(|face| explain_command(self.mesh, ray, face));
        WrongAnswer {
            ray: index,
            text: format!("ray {index}: {answer}{behind}; {truth}"),
            command,
        }
    }

    /// How many rays have other nearest faces if mesh and rays are taken as they are written, in f64.
    fn others_in_f64(&self, arguments: &RaysArguments) -> Result<u64, Failure> {
        let scene = super::scene::<f64>(self.mesh)?;
        let rays = read::rays::<f64>(arguments.rays.as_deref().unwrap_or_default())?;
        let others = of_all(arguments, rays.len(), |index| {
            let nearest = scene.nearest(&rays[index])?;
            let faces = |it: &Option<Nearest>| it.as_ref().map(|it| it.faces.clone());
            Ok(faces(&nearest) != faces(&self.judged[index].nearest))
        })?;
        Ok(others.into_iter().filter(|is_other| *is_other).count() as u64)
    }
}

fn short(number: f64) -> String {
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
        let wrong: u64 = self.wrong().map(|it| it.count).sum();
        let rays = number_of(self.rays, "answer", "answers");
        let title = match wrong {
            0 => format!("None of {rays} is wrong"),
            wrong => format!("{} of {rays} are wrong", group_digits(wrong)),
        };
        let mut blocks = vec![Block::text(self.blame()), Block::Table(self.table())];
        if let Some(others) = self.other_in_f64.filter(|others| 0 < *others) {
            blocks.push(Block::text(format!(
                "Judged by mesh and rays rounded to f32. As they are written, in f64, {} another nearest face: what rounding the \
                 input costs.",
                number_of(others, "ray has", "rays have")
            )));
        }
        let items = self.worst.iter().map(|it| Item {
            text: it.text.clone(),
            lines: it.command.iter().cloned().collect(),
            ..Item::default()
        });
        blocks.extend(Block::items("Wrong answers", SHOWN, items.collect()));
        Page {
            command: "rays",
            title,
            tone: if wrong == 0 { Tone::Good } else { Tone::Bad },
            blocks,
        }
    }
}

impl JudgedAnswers {
    fn wrong(&self) -> impl Iterator<Item = &JudgementCount> {
        let is_wrong = |name: &str| {
            let kind = KINDS.iter().find(|(_, its, _)| *its == name);
            kind.is_some_and(|(judgement, ..)| judgement.is_wrong())
        };
        self.counts.iter().filter(move |it| is_wrong(it.judgement))
    }

    /// Who lost the hits, as far as kernels tell.
    fn blame(&self) -> String {
        let of = group_digits(self.asked);
        let named: Vec<String> = self
            .missed_by
            .iter()
            .filter(|it| 0 < it.count)
            .take(NAMED)
            .map(|it| format!("{} {}", it.kernel, group_digits(it.count)))
            .collect();
        let most = self.missed_by.first().map_or(0, |it| it.count);
        let elsewhere = "a tree, a box, a transform or an end of the interval";
        if self.asked == 0 {
            "No hit is lost.".to_owned()
        } else if most == 0 {
            format!(
                "None of the {of} lost hits is missed by a built-in kernel alone, on its face: {elsewhere} lost them."
            )
        } else if BLAMED * self.asked as f64 <= most as f64 {
            format!(
                "The triangle test lost them. Of {of} lost hits a built-in kernel alone misses, on every nearest face: {}.",
                named.join(", ")
            )
        } else {
            format!(
                "Of {of} lost hits a built-in kernel alone misses, on every nearest face: {}. The others were lost by {elsewhere}.",
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
            Head::text("meaning"),
        ];
        let row = |it: &JudgementCount| {
            let is_wrong = self.wrong().any(|wrong| wrong.judgement == it.judgement);
            let cells = [
                Cell::count(it.count).broken_if(is_wrong && 0 < it.count),
                Cell::optional(it.median, short),
                Cell::optional(it.most, short),
                Cell::words(it.meaning),
            ];
            Row::new(it.judgement, cells)
        };
        let shown = self.counts.iter().filter(|it| 0 < it.count);
        Table::new(heads, shown.map(row).collect())
    }
}
