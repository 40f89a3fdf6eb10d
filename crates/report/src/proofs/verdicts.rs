//! A kernel's verdicts: how far from its triangle a ray can pass that is judged wrongly, as a record and in sentences.

use crate::arith::Float;
use crate::audit::{self, shell_word};
use crate::case::Case;
use crate::page::{Cell, Row};
use crate::prove::{
    Depth, End, Judged, Other, Scale, Searched, USELESS, Witness, WrongDecisions, above, below,
    case_of,
};

/// The verdicts at some epsilons.
#[apply(part!)]
pub struct VerdictPart {
    /// As `--epsilon` takes them; none if no gate takes one.
    pub epsilons: Option<String>,
    /// Misses of triangles that the ray crosses.
    pub misses: DepthPart,
    /// Hits of triangles that the ray passes by.
    pub hits: DepthPart,
    /// The numbers that edge gates multiply barycentric coordinates by.
    pub scales: Vec<ScalePart>,
    /// Where other gates may decide wrongly.
    pub others: Vec<OtherPart>,
    /// The sentences that people ask for first.
    pub sentences: Vec<String>,
}

/// How far from the boundary of its triangle a wrong verdict can be, in the triangle's plane.
#[apply(part!)]
pub struct DepthPart {
    /// At most, as a share of the triangle's longest edge: inside or outside the line of some edge.
    pub share: Option<f64>,
    /// The distance of a hit from the triangle, which is more beyond a vertex.
    pub apart: Option<f64>,
    /// The same as a length of the scene.
    pub length: Option<f64>,
    /// Why nothing is known.
    pub why: Option<String>,
    /// The worst that is known.
    pub known: Option<KnownPart>,
    /// share / known.share
    pub factor: Option<f64>,
    /// In a scene where nothing follows: with which changes something would.
    #[serde(skip)]
    pub useful: String,
}

/// The worst verdict that a search found.
#[apply(part!)]
pub struct KnownPart {
    /// How far inside or outside, as a share of the longest edge.
    pub share: f64,
    /// The command that shows it.
    pub command: String,
}

/// A number that an edge gate multiplies a barycentric coordinate by.
#[apply(part!)]
pub struct ScalePart {
    /// As the kernel's source calls it.
    pub number: String,
    /// It is never smaller.
    pub at_least: f64,
}

/// A gate that is at no edge.
#[apply(part!)]
pub struct OtherPart {
    /// Its name; `t`, `t_max` or `of the back` for one that is missing.
    pub gate: String,
    /// The wrong decisions that it may make, in words.
    pub may: String,
    /// True if it never refuses a hit.
    #[serde(skip)]
    pub is_never: bool,
}

impl VerdictPart {
    /// The verdicts of a row.
    pub fn new<F: Searched>(judged: &Judged<F>, row: &audit::Row, useful: String) -> VerdictPart {
        let verdicts = &judged.verdicts;
        let depth = |bound: &Depth, known: &Option<Witness<F>>| {
            let found = bound.as_ref().ok();
            DepthPart {
                share: found.map(|it| it.share),
                apart: found.map(|it| it.apart),
                length: found.and_then(|it| it.length),
                why: bound.as_ref().err().cloned(),
                known: known.as_ref().map(|known| KnownPart {
                    share: known.score,
                    command: row.explain_command(&shell_word(&text_of(&case_of(&known.inputs)))),
                }),
                factor: found
                    .zip(known.as_ref())
                    .map(|(it, known)| it.share / known.score),
                useful: useful.clone(),
            }
        };
        let scale = |(scale, least): &(Scale, f64)| ScalePart {
            number: scale.name().to_owned(),
            at_least: *least,
        };
        let other = |it: &Other| OtherPart {
            gate: match (it.gate, it.may) {
                (Some(gate), _) => row.entry.info.gates[gate].name.to_owned(),
                (None, WrongDecisions::Missing(End::Far)) => "t_max".to_owned(),
                (None, WrongDecisions::Back) => "of the back".to_owned(),
                (None, _) => "t".to_owned(),
            },
            may: may(&it.may),
            is_never: it.may == WrongDecisions::Never,
        };
        let others = verdicts.others.iter().map(other).collect();
        let mut part = VerdictPart {
            epsilons: row.epsilon_argument(),
            misses: depth(&verdicts.misses, &judged.known[0]),
            hits: depth(&verdicts.hits, &judged.known[1]),
            scales: verdicts.scales.iter().map(scale).collect(),
            others,
            sentences: Vec::new(),
        };
        part.sentences = part.in_words();
        part
    }

    /// A row of the table of all kernels.
    pub fn row(&self, kernel: &str) -> Row {
        let cells = [&self.misses, &self.hits].map(|depth| {
            let known = depth.known.as_ref();
            [
                Cell::optional(depth.share, above),
                Cell::optional(known.map(|it| it.share), below),
                Cell::optional(depth.factor, |factor| format!("{factor:.2}")),
            ]
        });
        let mut whys: Vec<&String> = [&self.misses.why, &self.hits.why]
            .into_iter()
            .flatten()
            .collect();
        whys.dedup();
        let below = whys
            .into_iter()
            .map(|why| format!("nothing is proved: {why}"))
            .collect();
        Row {
            below,
            ..Row::new(kernel, cells.concat())
        }
    }

    /// The conditions of the statements besides the domain, as `|N·d| is at least 0.5, N = (b-a)×(c-a)`; none where a scene has it.
    pub fn limits(&self) -> Option<String> {
        let is_limited = |it: &&ScalePart| it.number != "1" && self.misses.length.is_none();
        let limits = self.scales.iter().filter(is_limited);
        let limits = limits.map(|it| format!("{} is at least {}", it.number, below(it.at_least)));
        let mut limits: Vec<String> = limits.collect();
        limits.dedup();
        let some = !limits.is_empty();
        some.then(|| format!("{}, N = (b-a)×(c-a)", limits.join(" and ")))
    }

    fn in_words(&self) -> Vec<String> {
        let [where_, there] = match self.limits() {
            Some(limits) => [format!("Where {limits}: "), "There: ".to_owned()],
            None => [String::new(), String::new()],
        };
        let mut all = vec![
            format!("{where_}{}", self.misses.sentence("false miss", "inside")),
            format!("{there}{}", self.hits.sentence("false hit", "outside")),
        ];
        let others = self.others.iter().filter(|other| !other.is_never);
        all.extend(others.map(|other| format!("Gate {} {}", other.gate, other.may)));
        all
    }
}

impl DepthPart {
    fn sentence(&self, what: &str, side: &str) -> String {
        let known = self.known.as_ref().map_or(String::new(), |known| {
            format!("; one {} {side} is known", below(known.share))
        });
        match (self.share, &self.why) {
            (Some(share), _) if USELESS <= share => {
                format!(
                    "Nothing useful follows for {what}es: the bound is half of a triangle's longest edge {side}, or \
                     more{known}.{}",
                    self.useful
                )
                .replace("hites", "hits")
            }
            (Some(0.0), _) => format!("No {what} at an edge."),
            (Some(share), _) => {
                let factor =
                    self.factor.map_or(String::new(), |factor| format!(" (factor {factor:.2})"));
                let length = self.length.map_or(String::new(), |length| {
                    format!(", nor than {} as a length of the scene", above(length))
                });
                let apart = self.apart.filter(|apart| share < *apart).map_or(String::new(), |x| {
                    format!(" (beyond a vertex at most {} from the triangle)", above(x))
                });
                format!(
                    "No {what} is farther {side} an edge than {} of the triangle's longest edge{length}{known}{factor}{apart}.",
                    above(share)
                )
            }
            (None, why) => {
                format!("Nothing is proved of a {what}: {}.", why.as_deref().unwrap_or_default())
            }
        }
    }
}

fn may(may: &WrongDecisions) -> String {
    match may {
        WrongDecisions::Never => "never refuses a hit here.".to_owned(),
        WrongDecisions::Refuse(name, most) => {
            format!(
                "may also refuse hits where {name} is below {}.",
                above(*most)
            )
        }
        WrongDecisions::Ends(early, late) => format!(
            "may also refuse hits whose t is nearer to an end than {}, and let through what is up to {} beyond.",
            above(*early),
            above(*late)
        ),
        WrongDecisions::Unknown => {
            "may decide wrongly anywhere: what it compares, or with which sign, is not known."
                .to_owned()
        }
        WrongDecisions::Missing(End::Start) => {
            "is missing: hits behind the ray's start are let through.".to_owned()
        }
        WrongDecisions::Missing(End::Far) => {
            "is missing: hits beyond the ray's end are let through.".to_owned()
        }
        WrongDecisions::Back => {
            "is missing: front faces alone are promised, and no single gate refuses every back."
                .to_owned()
        }
    }
}

/// A case as `explain` takes it.
fn text_of<F: Float>(case: &Case<F>) -> String {
    let [origin, direction, a, b, c] = case.vectors();
    format!(
        "{{scalar:{},origin:{origin:?},direction:{direction:?},a:{a:?},b:{b:?},c:{c:?},t_max:{:?}}}",
        F::NAME,
        case.ray.t_max
    )
    .replace(' ', "")
}
