//! Judged answers as a record has them, and what is compared of them.

use crate::arith::ScalarName;
use crate::asked::AnswerKind;
use crate::audit::Trials;
use crate::files::mesh::Mesh;
use crate::record::{Comparable, NamedRate, NamedValue, Rate, Study, group_digits, number_of};
use crate::report::JunitCase;
use crate::report::page::Picture;
use hairline_core::printable::printable;
use hairline_scene::Judgement;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

/// The answers of a program about a mesh, judged.
#[apply(part!)]
pub struct RaysResult {
    /// The mesh: its file, the number of its faces, and a digest.
    pub mesh: String,
    /// The rays or points: their number, and a digest.
    pub cases: String,
    /// The program, where hairline ran it: the kernel and its box test.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub program: Option<String>,
    /// The kind of answers: `nearest`, `any`, `all`, `count` or `inside`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub kind: AnswerKind,
    /// The scalar in which they are judged.
    pub scalar: ScalarName,
    /// True if directions are made of length 1 first, so that t is a length.
    pub has_unit_directions: bool,
    /// How many answers.
    pub asked: u64,
    /// An entry for each judgement, the worst first.
    pub counts: Vec<JudgementCount>,
    /// How many are right by the numbers as written, in f64, if another reading was chosen because more are right there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right_as_written: Option<u64>,
    /// The steps that made the program's scene, if answers are judged by that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<GivenScene>,
    /// How many are right by the program's scene, as its user says that it is made, if answers were judged by that too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right_as_given: Option<u64>,
    /// The number that added to the faces of wrong answers makes most of them right, if one does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shift: Option<i64>,
    /// The answers that name a face that the mesh does not have: one more than its last one. A larger number is an error in the file.
    #[serde(default)]
    pub beyond_the_mesh: u64,
    /// The hits that are lost, and who loses them too.
    pub lost: LostHits,
    /// How the rays of wrong answers meet the mesh.
    #[serde(default)]
    pub wrong_rays: WrongRays,
    /// The wrong answers with a t before the ray's start or beyond its end, by more than anybody overlooks.
    #[serde(default)]
    pub outside_interval: u64,
    /// The points that are taken to be outside where the surface winds around them an even number of times.
    #[serde(default)]
    pub wound_evenly: u64,
    /// The worst answers.
    pub worst: Vec<WrongAnswer>,
    /// Every answer, if it was asked for. A record has the counts alone.
    #[serde(skip)]
    pub each: Vec<EachAnswer>,
}

/// A scene that a program makes of the written one.
#[apply(part!)]
pub struct GivenScene {
    /// The steps, in their order: `move=-5,0,2 scale=0.001`.
    pub steps: String,
    /// How many times as large as the written scene it is.
    pub scale: f64,
    /// The scalar in which the steps are computed.
    pub computed_in: ScalarName,
    /// True if t is counted as in the written scene.
    pub has_written_t: bool,
}

/// How the rays of wrong answers meet the mesh.
#[apply(part!)]
#[derive(Default)]
pub struct WrongRays {
    /// Those that run in the plane of a face that they meet.
    pub in_plane: u64,
    /// Those that meet an edge or a vertex exactly, and run in no plane.
    pub at_edge: u64,
    /// Those that meet the inside of a face, within a millionth of it from an edge.
    #[serde(default)]
    pub near_edge: u64,
    /// Those that meet the inside of a face, at a slope below 1/1000.
    #[serde(default)]
    pub grazing: u64,
    /// Those that meet the inside of a face otherwise.
    pub inside: u64,
    /// Those that meet nothing.
    pub nothing: u64,
}

/// An answer with its judgement.
#[derive(Clone, Debug, PartialEq)]
pub struct EachAnswer {
    /// The judgement.
    pub judgement: Judgement,
    /// The exact answer: the nearest faces, or all in order; or the place of a point.
    pub exact: String,
    /// The t of the first face, as the nearest double.
    pub t: Option<f64>,
    /// The answer: faces, a number or a word.
    pub answered: String,
    /// Its t, of a nearest hit that has one.
    pub answered_t: Option<f64>,
    /// How far it is off, in longest edges.
    pub off: Option<f64>,
}

/// How often a judgement was made.
#[apply(part!)]
pub struct JudgementCount {
    /// The judgement.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub judgement: Judgement,
    /// How many answers.
    pub count: u64,
    /// The median distance from the exact hit, in longest edges of the face, where it is known.
    pub median_off: Option<f64>,
    /// The largest.
    pub most_off: Option<f64>,
}

/// Exact hits that a program missed, or in place of which it named another face.
#[apply(part!)]
#[derive(Default)]
pub struct LostHits {
    /// How many.
    pub count: u64,
    /// How many hits are found.
    #[serde(default)]
    pub found: u64,
    /// How many of the lost ones lie at the start of the ray's interval, as near as anybody sees.
    pub at_start: u64,
    /// How many at its end.
    pub at_end: u64,
    /// How many a plain program with boxes loses without them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without_boxes: Option<WithoutBoxes>,
    /// The built-in kernels that miss some of them too, by themselves, on all faces of the hit: those first that explain most. Each
    /// with the epsilon of its that explains most.
    pub missed_by_kernels: Vec<MissCount>,
    /// The built-in slab tests that miss some of them too, on the boxes of all faces of the hit: those first that explain most.
    pub missed_by_box_tests: Vec<MissCount>,
    /// The ways in which an instance's transform in f32 loses some of them too: those first that explain most.
    #[serde(default)]
    pub missed_by_transforms: Vec<MissCount>,
}

/// How many rays a plain program loses if it asks about every face.
#[apply(part!)]
pub struct WithoutBoxes {
    /// So many of the rays whose hits are lost were tried.
    pub tried: u64,
    /// So many of these are lost without boxes too.
    pub lost: u64,
}

/// How many hits a kernel or a slab test misses.
#[apply(part!)]
pub struct MissCount {
    /// Its name.
    pub name: String,
    /// Its epsilon, if it is not one of its own: `parallel=1e-8`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epsilon: Option<String>,
    /// How many of the hits that the program lost.
    pub count: u64,
    /// About how many of those that the program found.
    pub of_found: u64,
    /// So many of the lost hits does it explain: those that it misses, less what it would miss of others and the program found. A
    /// program has larger boxes than those of single faces, so of slab tests less the share that they miss of found hits.
    pub explained: u64,
}

/// A wrong answer.
#[apply(part!)]
pub struct WrongAnswer {
    /// The ray's or point's number, from 0.
    pub index: u64,
    /// Its judgement.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub judgement: Judgement,
    /// The truth, the answer, and how far it is off.
    pub text: String,
    /// Commands that show it.
    pub commands: Vec<String>,
    /// The mesh around it, for pages alone.
    #[serde(skip)]
    pub picture: Option<Picture>,
}

impl RaysResult {
    /// How many answers are wrong.
    pub fn wrong_count(&self) -> u64 {
        self.count_of(Judgement::is_wrong)
    }

    /// How many are exact, or one of several right ones.
    pub fn right_count(&self) -> u64 {
        self.count_of(Judgement::is_right)
    }

    /// How many have a judgement.
    pub fn count(&self, judgement: Judgement) -> u64 {
        self.count_of(|it| it == judgement)
    }

    fn count_of(&self, is_counted: impl Fn(Judgement) -> bool) -> u64 {
        let counted = self.counts.iter().filter(|it| is_counted(it.judgement));
        counted.map(|it| it.count).sum()
    }
}

impl RaysResult {
    /// A line an answer, beside the truth.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "number,judgement,exact,exact_t,answered,answered_t,off_in_edges"
        )?;
        let number = |it: Option<f64>| it.map_or(String::new(), |it| format!("{it:?}"));
        for (index, it) in self.each.iter().enumerate() {
            let (exact, answered) = (&it.exact, &it.answered);
            let [t, answered_t, off] = [it.t, it.answered_t, it.off].map(number);
            writeln!(
                out,
                "{index},{},{exact},{t},{answered},{answered_t},{off}",
                it.judgement
            )?;
        }
        Ok(())
    }

    /// As tests for JUnit, one a judgement that is wrong.
    pub fn suites(&self) -> BTreeMap<String, BTreeMap<(String, String), JunitCase>> {
        let wrong = self.counts.iter().filter(|it| it.judgement.is_wrong());
        let test = |it: &JudgementCount| {
            let place = format!("{}.{}", self.scalar, self.kind);
            let case = match it.count {
                0 => JunitCase::default(),
                count => self.failed(it.judgement, count),
            };
            ((place, it.judgement.to_string()), case)
        };
        [(self.mesh.clone(), wrong.map(test).collect())].into()
    }

    fn failed(&self, judgement: Judgement, count: u64) -> JunitCase {
        let of_kind = self.worst.iter().filter(|it| it.judgement == judgement);
        let text: Vec<String> = of_kind
            .flat_map(|it| [&it.text].into_iter().chain(&it.commands))
            .cloned()
            .collect();
        let message = format!("{judgement}: {} of {}", group_digits(count), self.asked);
        JunitCase {
            failures: vec![(message, text.join("\n"))],
            notes: Vec::new(),
        }
    }
}

impl Comparable for RaysResult {
    const STUDY: Study = Study::Rays;

    fn question(&self) -> String {
        format!("{} of {}", self.kind, self.mesh)
    }

    fn cases(&self) -> String {
        let RaysResult {
            kind,
            cases,
            mesh,
            scalar,
            given,
            ..
        } = self;
        let steps = given.as_ref().map(|it| format!(", after {}", it.steps));
        let steps = steps.unwrap_or_default();
        format!("{kind} of {cases}, at {mesh}, in {scalar}{steps}")
    }

    fn counted(&self) -> Vec<NamedRate> {
        let wrong = self.counts.iter().filter(|it| it.judgement.is_wrong());
        let command = |judgement: Judgement| {
            let worst = self.worst.iter().find(|it| it.judgement == judgement);
            worst.and_then(|it| it.commands.first().cloned())
        };
        let named = |it: &JudgementCount| NamedRate {
            what: it.judgement.to_string(),
            rate: Rate::new(Trials::independent(it.count, self.asked), false),
            command: command(it.judgement),
        };
        wrong.map(named).collect()
    }

    fn chosen(&self) -> Vec<NamedValue> {
        let scalar = NamedValue::chosen("judged in".to_owned(), self.scalar.name());
        vec![scalar]
    }
}

/// A mesh by the name of its file, the number of its faces and a digest.
pub fn mesh_label(mesh: &Mesh) -> String {
    let file = Path::new(&mesh.name).file_name().unwrap_or_default();
    let file = printable(&file.to_string_lossy());
    let faces = number_of(mesh.triangles.len() as u64, "face", "faces");
    format!("{file} ({faces}, {})", &mesh.digest[..8])
}

/// A distance, for people.
pub fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    match (1e-3..1e6).contains(&number.abs()) {
        true => format!("{number:.3}"),
        false => format!("{number:.2e}"),
    }
}
