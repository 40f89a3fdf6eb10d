//! A program's answers to questions about a mesh, and their judgements.

use crate::asked::{Answers, Asked};
use crate::files::hex;
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use crate::plain::PlainProgram;
use crate::record::{group_digits, number_of};
use crate::result::GivenScene;
use hairline_scene::{Judged, Judgement, Scene};
use hmac_sha256::Hash;

/// Rays or points at a mesh, with a program's answers.
pub struct JudgedRun<'a, F: Scalar> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The same as a scene.
    pub scene: Scene<F>,
    /// The questions.
    pub asked: Asked<F>,
    /// As many answers.
    pub answers: Answers,
    /// The steps that made the scene and the questions, if they are not as written.
    pub given: Option<GivenScene>,
    /// Who answered, if hairline ran it.
    pub program: Option<PlainProgram>,
    /// True if each answer is told beside the truth, for CSV: exact values take time.
    pub tells_each: bool,
}

/// A run with its judgements, by one reading of what the program computes with.
pub struct Judgements<'a, F: Scalar> {
    /// The questions as they are read, and the answers.
    pub(crate) run: JudgedRun<'a, F>,
    /// The judgements of the answers.
    pub(crate) judged: Vec<Judged>,
    /// How many are right.
    pub tally: Tally,
    /// True if directions are made of length 1 first, so that t is a length.
    pub(crate) has_unit_directions: bool,
    /// True if t is counted as in the written scene, and the scene is of another size.
    pub(crate) has_written_t: bool,
    /// How many are right by the numbers as written, in f64, if another reading was chosen because more are right there.
    pub right_as_written: Option<u64>,
    /// The questions as they were given: their number, and a digest.
    pub(crate) cases: String,
}

impl<F: Scalar> Judgements<'_, F> {
    /// A complaint if a program named no hit of any ray, and some rays hit the mesh: then the file is likely cut off.
    pub fn no_hits(&self) -> Option<String> {
        let Answers::All(all) = &self.run.answers else {
            return None;
        };
        let is_said_wrongly = all.iter().all(Vec::is_empty) && 0 < self.tally.wrong;
        is_said_wrongly.then(|| {
            format!(
                "there are no hits in it, and {} of {} hit the mesh: expected ray,face,t, a line for each hit",
                group_digits(self.tally.wrong),
                number_of(all.len() as u64, "ray", "rays")
            )
        })
    }
}

/// How many answers are right.
#[derive(Clone, Copy, Debug)]
pub struct Tally {
    /// Exact, or one of several right ones.
    pub right: u64,
    /// Those that name a face, or tell of a hit that there is.
    pub right_hits: u64,
    /// Wrong, so that it may be seen.
    pub wrong: u64,
    /// The right face with a wrong t.
    pub wrong_t: u64,
}

impl Tally {
    /// The counts of judgements.
    pub(crate) fn of(judged: &[Judged]) -> Tally {
        let count = |is_counted: fn(&Judged) -> bool| {
            let counted = judged.iter().filter(|it| is_counted(it));
            counted.count() as u64
        };
        Tally {
            right: count(|it| it.judgement.is_right()),
            right_hits: count(|it| it.judgement.is_right() && it.hit.is_some()),
            wrong: count(|it| it.judgement.is_wrong()),
            wrong_t: count(|it| it.judgement == Judgement::WrongT),
        }
    }

    /// True if a reading in f32 explains more than this one in f64: most programs compute in one of the two, and name the exact
    /// face most often by the numbers that they have.
    pub fn is_explained_better_by(&self, in_f32: &Tally) -> bool {
        // Misses tell nothing: a mesh that f32 does not hold has no hits there. Silhouettes that are left out are neither right nor wrong.
        self.right_hits < in_f32.right_hits && in_f32.wrong <= self.wrong
    }
}

/// The number of the rays or points, and a digest of their numbers.
pub(crate) fn cases_label<F: Scalar>(asked: &Asked<F>) -> String {
    let count = asked.count() as u64;
    let (name, numbers): (String, Vec<F>) = match asked {
        Asked::Rays(rays) => {
            let numbers = rays.iter().flat_map(|ray| {
                let vectors = ray.origin.into_iter().chain(ray.direction);
                vectors.chain([ray.t_min, ray.t_max])
            });
            (number_of(count, "ray", "rays"), numbers.collect())
        }
        Asked::Points(points) => {
            let numbers = points.iter().flatten().copied();
            (number_of(count, "point", "points"), numbers.collect())
        }
    };
    let mut hash = Hash::new();
    for number in numbers {
        hash.update(number.to_f64().to_bits().to_le_bytes());
    }
    let digest = hex(&hash.finalize());
    format!("{name}, {}", &digest[..8])
}
