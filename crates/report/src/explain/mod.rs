//! One case explained: its exact truth, the verdict of each kernel with every gate behind it, the cause where it is wrong,
//! and the changes that make it right here.

mod advice;
mod build;
mod margin;
mod near;
mod nearest;
mod other_epsilon;
mod page;
mod row;
mod verdict;

use crate::arith::ScalarName;
pub use build::explain;
pub use nearest::misused_formula;
pub use verdict::Together;
pub(crate) use verdict::number;

use crate::corpus::truth_json::TruthLine;
use crate::page::Picture;
use serde::Serialize;
use serde_json::value::RawValue;

/// A case or a group explained.
#[derive(Debug, Serialize)]
pub struct Explanation {
    /// `hairline-explanation/1`.
    pub schema: &'static str,
    /// Its id or name, or `this case`.
    pub case: String,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// Each triangle with the ray.
    pub triangles: Vec<TrianglePart>,
    /// The rows on all triangles together; none of a single one.
    pub together: Vec<TogetherPart>,
    /// The triangles and the ray in space, where a format has pictures; none where the ray means nothing.
    #[serde(skip)]
    pub picture: Option<Picture>,
}

/// A triangle and the ray.
#[derive(Debug, Serialize)]
pub struct TrianglePart {
    /// As a corpus stores it.
    pub case: Box<RawValue>,
    /// The exact answer, fractions included.
    pub truth: TruthLine,
    /// How far the line passes from the triangle's boundary, in longest edges and in ulps of the largest coordinate; none
    /// where there is no such distance.
    pub from_boundary: Option<[f64; 2]>,
    /// The answers held against an instance in the world, if the case is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instance: Option<InstancePart>,
    /// Every row.
    pub rows: Vec<ExplainedRow>,
    /// The exact answer in words.
    #[serde(skip)]
    pub in_words: String,
    /// The exact t, u and v, by name, each as the nearest double; none where the line crosses no plane.
    #[serde(skip)]
    pub exact: Vec<(&'static str, f64)>,
    /// The vectors in numbers and in bits, each with its name.
    #[serde(skip)]
    pub inputs: Vec<[String; 5]>,
    /// The triangle in letters, with the exact point.
    #[serde(skip)]
    pub sketch: Option<String>,
    /// The least and the greatest t, each with its bits.
    #[serde(skip)]
    pub interval: [[String; 2]; 2],
}

/// A triangle that a matrix puts into the world, where the ray is given.
#[derive(Debug, Serialize)]
pub struct InstancePart {
    /// The matrix.
    pub matrix: [[f64; 4]; 3],
    /// The exact answer in the world, in words.
    pub truth: String,
    /// How far rounding the inverse and the ray moved t, u and v; none where one of both rays crosses no plane at one point.
    pub moved: Option<[f64; 3]>,
    /// The rows that are wrong there, each with its finding.
    pub wrong: Vec<(String, &'static str)>,
}

/// The answer of a row on one triangle.
#[derive(Debug, Default, Serialize)]
pub struct ExplainedRow {
    /// The kernel.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// `hit`, `miss`, or why it has no verdict.
    pub said: String,
    /// The demand of its contract: `a hit`, `a miss` or `nothing`.
    pub asked: &'static str,
    /// The finding, if it is wrong.
    pub finding: Option<&'static str>,
    /// The contract.
    pub contract: String,
    /// Its gates, in the order of the test.
    pub gates: Vec<ExplainedGate>,
    /// The verdict of the same formula without rounding.
    pub without_rounding: Option<&'static str>,
    /// The cause, if it is wrong.
    pub why: Option<String>,
    /// The same in a word or two.
    #[serde(skip)]
    pub cause: String,
    /// True if the kernel runs in the scalar of the case.
    #[serde(skip)]
    pub runs: bool,
    /// The changes that make it right here, each tried.
    pub advice: Vec<String>,
    /// The values of a hit, and how far they are off.
    pub values: Vec<String>,
    /// Further sentences.
    pub notes: Vec<String>,
}

/// A gate of a row on one triangle.
#[derive(Debug, Default, Serialize)]
pub struct ExplainedGate {
    /// Its name.
    pub gate: &'static str,
    /// Its comparison, `e` standing for the epsilon.
    pub refuses: &'static str,
    /// The epsilon; none if it takes none.
    pub epsilon: Option<String>,
    /// The number that it compares, as computed.
    pub margin: Option<String>,
    /// The same without rounding.
    pub exact: Option<String>,
    /// `passes` or `refuses`; none where the kernel does not show it.
    pub decision: Option<&'static str>,
    /// The decision without rounding.
    pub exactly: Option<&'static str>,
    /// True if its decision is the same at every epsilon.
    #[serde(skip)]
    pub is_fixed: bool,
    /// True if this gate made the verdict.
    pub decides: bool,
}

/// The answer of a row on all triangles.
#[derive(Debug, Serialize)]
pub struct TogetherPart {
    /// `kernel (epsilons)`.
    pub row: String,
    /// `1 of 2 triangles hit`, or why there is no answer.
    pub said: String,
    /// The judgement in words.
    pub judged: String,
    /// The kernels that are right here; may be empty.
    pub advice: String,
    /// True if it breaks what is asked of them together.
    pub is_wrong: bool,
}

impl ExplainedRow {
    /// `kernel (epsilons)`.
    pub fn label(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }

    /// The verdict beside what is asked, in words.
    pub fn judged(&self) -> String {
        format!("{}; {}", self.said, self.judgement())
    }

    /// The contract's demand, and if it is kept.
    pub fn judgement(&self) -> String {
        let judged = self
            .finding
            .map_or("as it should".to_owned(), str::to_uppercase);
        let of_hits = match self.finding {
            Some("wrong-value" | "bad-value") => ", and of a hit right values",
            _ => "",
        };
        format!("its contract asks {}{of_hits}: {judged}", self.asked)
    }

    /// The gate that made the verdict.
    pub fn decisive(&self) -> Option<&ExplainedGate> {
        self.gates.iter().find(|gate| gate.decides)
    }
}
