//! One test: a ray with a triangle or a group of triangles, and what is right.

use super::flags;
use super::number::EitherFloat;
use crate::arith::{Float, ScalarName};
use crate::case::Case;
use crate::contract::{Boundary, Contract, Demand, Extent};
use crate::corpus::lines::AnyCase;
use crate::family::Grouping;
use crate::files::hex;
use crate::judge::{GroupTruth, Obligation, group_obligation, obligation};
use crate::oracle::{exact_values, truth};
use crate::truth::{Crossing, Place, Truth};
use hmac_sha256::Hash;
use num_rational::BigRational;
use num_traits::One;

/// Every point of the closed triangle is a hit at every t of the closed interval, a coplanar triangle and
/// one without area included. Invalid input is free.
pub(super) const CLOSED: Contract = Contract {
    extent: Extent::Interval,
    coplanar: Demand::Hit,
    degenerate: Demand::Hit,
    invalid: Demand::Free,
    ..Contract::CLOSED_RAY
};

/// Only a line that crosses the plane hits: inside the triangle, strictly between the ends of the interval.
const OPEN: Contract = Contract {
    boundary: Boundary::Open,
    ends: Boundary::Open,
    coplanar: Demand::Miss,
    degenerate: Demand::Miss,
    ..CLOSED
};

/// How many digits end an id.
pub const DIGITS: usize = 16;

/// One test: a ray and a triangle, or a ray and the triangles of a group.
pub struct VectorTest {
    /// A name, and a digest of the numbers: an id never comes back with other numbers.
    pub id: String,
    /// A description of the test, in one line.
    pub comment: String,
    /// Where a published case comes from.
    pub source: Option<String>,
    /// The things that may go wrong, in words that each file explains.
    pub flags: Vec<&'static str>,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// Origin, direction, t_min and t_max.
    pub(super) ray: [EitherFloat; 8],
    /// The ray with each triangle.
    pub cases: Vec<AnyCase>,
    /// One, or those of the group.
    pub triangles: Vec<TestTriangle>,
    /// How they belong together.
    pub grouping: Grouping,
    /// The right result for the triangles of a group together; none for a single triangle.
    pub group: Option<TestGroup>,
}

/// A triangle of a test, and what is right on it.
pub struct TestTriangle {
    /// The coordinates of a, b and c.
    pub(super) numbers: [EitherFloat; 9],
    /// The exact truth.
    pub truth: Truth,
    /// t, u, v and the margin, if the line crosses the plane.
    pub(super) values: Option<[BigRational; 4]>,
}

/// The right result for the triangles of a group together.
#[derive(Clone, Copy)]
pub struct TestGroup {
    /// How the triangles lie to each other and to the ray.
    pub truth: GroupTruth,
    /// How many triangles the ray hits under the closed reading, and how many under the open one.
    pub counts: [usize; 2],
}

/// The name of a test, and what is known besides its numbers.
pub(super) struct Label {
    /// The id without its digest.
    pub(super) name: String,
    pub(super) comment: String,
    pub(super) source: Option<String>,
    /// The flag of its family.
    pub(super) flag: Option<&'static str>,
}

impl VectorTest {
    /// The test of a case, or of the cases of a group; none if nothing is demanded of the group.
    pub(super) fn new<F: Float>(
        label: Label,
        cases: &[Case<F>],
        grouping: Grouping,
    ) -> Option<VectorTest> {
        let triangles: Vec<TestTriangle> = cases.iter().map(TestTriangle::new).collect();
        let truths: Vec<Truth> = triangles.iter().map(|triangle| triangle.truth).collect();
        let group = grouping
            .shares_a_ray()
            .then(|| TestGroup::new(cases, &truths, grouping));
        if group.is_some_and(|group| group.truth == GroupTruth::Free) {
            return None;
        }
        let [[ox, oy, oz], [dx, dy, dz], ..] = cases[0].vectors();
        let (t_min, t_max) = (cases[0].ray.t_min, cases[0].ray.t_max);
        let ray = [ox, oy, oz, dx, dy, dz, t_min, t_max].map(EitherFloat::of);
        let Label {
            name,
            comment,
            source,
            flag,
        } = label;
        let mut flags: Vec<&str> = flag.into_iter().collect();
        let mut numbers = ray
            .iter()
            .chain(triangles.iter().flat_map(|triangle| &triangle.numbers));
        let of_numbers = numbers
            .any(|number| number.is_extreme)
            .then_some("range-ends");
        truths
            .iter()
            .flat_map(flags::of_truth)
            .chain(of_numbers)
            .for_each(|flag| {
                if !flags.contains(&flag) {
                    flags.push(flag)
                }
            });
        let mut test = VectorTest {
            id: name,
            comment,
            source,
            flags,
            scalar: F::NAME,
            ray,
            cases: cases.iter().map(|case| (*case).into()).collect(),
            triangles,
            grouping,
            group,
        };
        test.id = format!("{}-{}", test.id, test.digest());
        Some(test)
    }

    /// The bit patterns of the ray and then of each triangle, in hexadecimal between spaces.
    pub(super) fn bits(&self) -> String {
        let triangles = self.triangles.iter().flat_map(|triangle| &triangle.numbers);
        let words: Vec<&str> = self
            .ray
            .iter()
            .chain(triangles)
            .map(|it| &*it.bits)
            .collect();
        words.join(" ")
    }

    /// The first [`DIGITS`] digits of the SHA-256 of the scalar and the bit patterns.
    pub(super) fn digest(&self) -> String {
        hex(&Hash::hash(
            format!("{} {}", self.scalar, self.bits()).as_bytes(),
        ))[..DIGITS]
            .to_owned()
    }

    /// The digest as a number.
    pub fn number(&self) -> u64 {
        u64::from_str_radix(&self.digest(), 16).expect("hexadecimal digits, at most 16")
    }
}

impl TestTriangle {
    pub(super) fn new<F: Float>(case: &Case<F>) -> TestTriangle {
        let vertices = case.vectors();
        let numbers = std::array::from_fn(|i| EitherFloat::of(vertices[2 + i / 3][i % 3]));
        let truth = truth(case);
        TestTriangle {
            numbers,
            truth,
            values: values(case, &truth),
        }
    }

    /// Hit, miss, or free for invalid input, if edges, vertices, ends and every contact are hits.
    pub fn closed(&self) -> Obligation {
        obligation(&self.truth, &CLOSED, false)
    }

    /// The same if none of them is.
    pub fn open(&self) -> Obligation {
        obligation(&self.truth, &OPEN, false)
    }

    /// Why the test is free, in the words of a profile.
    pub(super) fn free_because(&self) -> Vec<&'static str> {
        let crossing = |is: fn(&Crossing) -> bool| self.truth.crossing().is_some_and(is);
        let is_class = |name: &str| self.truth.class_name() == name;
        let reasons = [
            (
                "boundary",
                crossing(|c| c.feature.is_edge() || c.feature.is_vertex()),
            ),
            (
                "ends",
                crossing(|c| matches!(c.place, Place::AtMin | Place::AtMax)),
            ),
            ("coplanar", is_class("coplanar")),
            ("degenerate", is_class("degenerate")),
            ("invalid", is_class("invalid")),
        ];
        let free = result(&self.truth) == Obligation::Free;
        reasons
            .into_iter()
            .filter(|(_, holds)| free && *holds)
            .map(|(name, _)| name)
            .collect()
    }
}

/// Cases that are all in one scalar.
pub fn in_scalar<'a, F: Float>(cases: impl IntoIterator<Item = &'a AnyCase>) -> Vec<Case<F>> {
    let read = |case: &AnyCase| Case::from_bits(&either_scalar!(case, case => case.bits()));
    cases.into_iter().map(read).collect()
}

/// t, u, v and the smallest weight of a line that crosses the plane.
fn values<F: Float>(case: &Case<F>, truth: &Truth) -> Option<[BigRational; 4]> {
    let exact = exact_values(case, truth);
    let [t, u, v] = [exact.t?, exact.u?, exact.v?];
    let of_a = BigRational::one() - &u - &v;
    let least = of_a.min(u.clone()).min(v.clone());
    Some([t, u, v, least])
}

/// The demand of both readings; free if they differ.
pub(super) fn result(truth: &Truth) -> Obligation {
    let [closed, open] = [CLOSED, OPEN].map(|reading| obligation(truth, &reading, false));
    if closed == open {
        closed
    } else {
        Obligation::Free
    }
}

/// Where a line meets the plane, or the class of a line that does not cross it.
pub(super) fn place(truth: &Truth) -> &'static str {
    truth
        .crossing()
        .map_or(truth.class_name(), |crossing| crossing.feature.name())
}

impl TestGroup {
    pub(super) fn new<F: Float>(
        cases: &[Case<F>],
        truths: &[Truth],
        grouping: Grouping,
    ) -> TestGroup {
        let hits = |reading| {
            let asked = truths
                .iter()
                .map(|truth| obligation(truth, &reading, false));
            asked.filter(|asked| *asked == Obligation::MustHit).count()
        };
        let truth = group_obligation(cases, truths, &CLOSED, grouping);
        TestGroup {
            truth,
            counts: [CLOSED, OPEN].map(hits),
        }
    }

    /// The number of hits that is right.
    pub fn result(&self) -> &'static str {
        match self.truth {
            _ if self.counts == [1, 1] => "exactly-one",
            GroupTruth::Crossing => "at-least-one",
            GroupTruth::Fold { .. } | GroupTruth::Free => "free",
        }
    }

    /// The parity of the number of triangles that the line passes: `odd` or `even`.
    pub fn parity(&self) -> &'static str {
        if self.truth == (GroupTruth::Fold { odd: false }) {
            "even"
        } else {
            "odd"
        }
    }
}

/// The word in the vectors.
pub(super) fn word(obligation: Obligation) -> &'static str {
    match obligation {
        Obligation::MustHit => "hit",
        Obligation::MustMiss => "miss",
        Obligation::Free => "free",
    }
}

/// The SHA-256 of the core set: of its JSON files, in the order of their names.
pub fn digest(files: &[(String, String)]) -> String {
    let mut sum = Hash::new();
    files.iter().for_each(|(_, text)| sum.update(text));
    hex(&sum.finalize())
}
