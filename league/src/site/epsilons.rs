//! A page for each epsilon in use: by whom, what is proved of it, and what it does to rays in four scenes.

use crate::page::{Pages, slug, table};
use crate::program;
use hairline::ScalarName;
use hairline::internals::kernel::{Dimension, Entry, Gate, KERNELS, PRESETS, Tunable, all};
use hairline::internals::record::{KernelResult, Record};
use hairline_league::edition::EntrantResult;
use maud::{Markup, html};
use serde_json::Value;
use std::collections::BTreeMap;

/// Round numbers that people ask about, at the gate for parallel rays.
const ROUND: [&str; 10] = [
    "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-12", "1e-15",
];
const SCENES: [&str; 4] = ["unit", "room", "city", "cad-mm"];
/// Rays of each family of a scene; the environment's COUNT if it is set.
fn rays() -> String {
    std::env::var("COUNT").unwrap_or("10000".to_owned())
}

/// A value, and the gates at which it stands somewhere.
pub struct Epsilon {
    /// As `--epsilon` takes it.
    pub text: String,
    users: Vec<User>,
}

struct User {
    who: String,
    gate: &'static str,
    dimension: Dimension,
    /// The comparison, in its own notation.
    form: &'static str,
    /// Whether the league has a page about it.
    has_page: bool,
}

impl Epsilon {
    /// The name of its page.
    pub fn slug(&self) -> String {
        let sign = if self.text.starts_with('-') {
            "minus-"
        } else {
            ""
        };
        format!(
            "{sign}{}",
            slug(&self.text.replace('*', "-times-").replace("e-", "e-minus-"))
        )
    }
}

/// Those of published libraries and of every kernel's source, and the round ones, the largest first.
pub fn in_use(results: &[EntrantResult]) -> Vec<Epsilon> {
    let mut found: BTreeMap<String, Vec<User>> = BTreeMap::new();
    for text in ROUND {
        found.insert(text.to_owned(), Vec::new());
    }
    for entry in all() {
        let values = entry
            .info
            .epsilon_sets
            .first()
            .map_or(&[][..], |set| set.values);
        for (gate, value) in entry.info.gates.iter().zip(values) {
            if gate.epsilon != Tunable::Fixed && !is_zero(value) {
                let who = entry.info.name;
                let has_page = results.iter().any(|result| result.kernel == who);
                found.entry(canonical(value)).or_default().push(User {
                    who: who.to_owned(),
                    gate: gate.name,
                    dimension: gate.dimension,
                    form: gate.refuses,
                    has_page,
                });
            }
        }
    }
    for preset in PRESETS {
        for entry in preset.entries {
            let text = match entry.value.ends_with("EPSILON") {
                true => entry.value.to_owned(),
                false => canonical(entry.value),
            };
            // An entrant that is modelled is there already.
            let users = found.entry(text).or_default();
            let is_same =
                |user: &User| user.gate == entry.gate && user.who.starts_with(preset.name);
            if users.iter().any(is_same) {
                continue;
            }
            let page = results
                .iter()
                .find(|result| result.kernel.starts_with(preset.name));
            users.push(User {
                who: page.map_or(preset.name, |page| &page.kernel).to_owned(),
                gate: entry.gate,
                dimension: entry.dimension,
                form: entry.form,
                has_page: page.is_some(),
            });
        }
    }
    let mut all: Vec<Epsilon> = found
        .into_iter()
        .map(|(text, users)| Epsilon { text, users })
        .collect();
    all.sort_by(|a, b| size(&b.text).total_cmp(&size(&a.text)));
    all
}

fn is_zero(text: &str) -> bool {
    text.parse() == Ok(0.0)
}

/// `1e-6` for 0.000001.
fn canonical(text: &str) -> String {
    text.parse::<f64>()
        .map_or(text.to_owned(), |value| format!("{value:e}"))
}

/// To sort by; multiples of the scalar's own distance from 1 as in f32.
fn size(text: &str) -> f64 {
    let epsilon = f64::from(f32::EPSILON);
    match text.strip_suffix("EPSILON") {
        Some(times) => times.trim_end_matches('*').parse().unwrap_or(1.0) * epsilon,
        None => text.parse().unwrap_or(0.0),
    }
}

/// The pages.
pub fn write(pages: &mut Pages, epsilons: &[Epsilon]) -> Result<(), String> {
    let mut costs = Costs::default();
    for epsilon in epsilons {
        eprintln!("epsilon {}", epsilon.text);
        let body = html! {
            @if epsilon.text.contains("EPSILON") {
                p { "EPSILON is the distance from 1 to the next number: 1.19e-7 in f32, 2.22e-16 in f64." }
            }
            h2 { "Who uses it" }
            (users(&epsilon.users))
            @for (gate, dimension) in gates(epsilon) { (section(epsilon, gate, dimension, &mut costs)?) }
        };
        let path = format!("epsilon/{}.html", epsilon.slug());
        pages.page(&path, &format!("An epsilon of {}", epsilon.text), &body)?;
    }
    Ok(())
}

fn users(users: &[User]) -> Markup {
    if users.is_empty() {
        return html! { p { "None of hairline's kernels, the league's modelled entrants and the known presets." } };
    }
    let head = html! { th { "library or kernel" } th.text { "gate" } th.text { "refuses" } th.text { "dimension" } };
    let body = html! {
        @for user in users {
            tr {
                td {
                    @if user.has_page { a href={ "../kernel/" (slug(&user.who)) ".html" } { (user.who) } }
                    @else { (user.who) }
                }
                td.text { (user.gate) } td.text { code { (user.form) } } td.text { (words(user.dimension)) }
            }
        }
    };
    html! {
        p { "Of hairline's kernels, the league's entrants whose formula is modelled, and the presets of " code { "hairline list presets" } "; others may." }
        (table("Who uses it", &head, &body))
    }
}

/// What a dimension means for an epsilon.
fn words(dimension: Dimension) -> String {
    let power = |name: &str, exponent: i8| match exponent {
        0 => None,
        1 => Some(name.to_owned()),
        exponent => Some(format!("{name}^{exponent}")),
    };
    let parts: Vec<String> = [
        power("length", dimension.length),
        power("direction", dimension.direction),
    ]
    .into_iter()
    .flatten()
    .collect();
    if parts.is_empty() {
        "none: the same at every size".to_owned()
    } else {
        parts.join(" ")
    }
}

/// What becomes of an epsilon where everything is ten times as large.
fn scaling(dimension: Dimension) -> String {
    match dimension.length {
        0 => "Triangles of all sizes need the same epsilon here.".to_owned(),
        length => format!(
            "The same number means something else at every size: where all lengths are 10 times as large, the same rays \
             need an epsilon 1e{length} times as large."
        ),
    }
}

/// What becomes of a proved bound where everything is larger.
fn bound_of_size(dimension: Dimension) -> String {
    match dimension.length {
        0 => "Where all lengths are larger the bounds are the same.".to_owned(),
        length => format!(
            "Where lengths are up to s, the bounds are s^{length} times as large: with lengths up to 100, 1e{} times.",
            2 * length
        ),
    }
}

/// The gates that it stands at, each once; that for parallel rays if it stands nowhere.
fn gates(epsilon: &Epsilon) -> Vec<(&'static str, Dimension)> {
    let mut gates: Vec<(&str, Dimension)> = Vec::new();
    for user in &epsilon.users {
        if !gates.contains(&(user.gate, user.dimension)) {
            gates.push((user.gate, user.dimension));
        }
    }
    if gates.is_empty() {
        gates.push(("parallel", Dimension::new(2, 1)));
    }
    gates
}

/// The built-in kernel that is tried: one that has the epsilon, or else one with such a gate.
fn stand_in(epsilon: &Epsilon, gate: &str, dimension: Dimension) -> Option<&'static Entry> {
    let value = &epsilon.text;
    let fits = |candidate: &Gate| {
        candidate.name == gate
            && candidate.dimension == dimension
            && candidate.epsilon != Tunable::Fixed
            && (candidate.epsilon == Tunable::Signed || !value.starts_with('-'))
    };
    let is_user = |entry: &&Entry| epsilon.users.iter().any(|user| user.who == entry.info.name);
    let is_known = |entry: &&Entry| entry.info.name == "moller-trumbore";
    let fitting: Vec<&Entry> = KERNELS
        .iter()
        .filter(|entry| entry.info.gates.iter().any(fits))
        .collect();
    let mut wanted = fitting.iter().copied().filter(is_user);
    wanted
        .next()
        .or(fitting.iter().copied().find(is_known))
        .or(fitting.first().copied())
}

fn section(
    epsilon: &Epsilon,
    gate: &'static str,
    dimension: Dimension,
    costs: &mut Costs,
) -> Result<Markup, String> {
    let value = &epsilon.text;
    let title = format!("At a gate {gate} of dimension {}", words(dimension));
    let Some(entry) = stand_in(epsilon, gate, dimension) else {
        return Ok(
            html! { h2 { (title) } p { "No kernel of hairline has such a gate: it is not measured." } },
        );
    };
    let kernel = entry.info.name;
    let (with, without) = (set(entry, gate, value), set(entry, gate, "0"));
    let mut rows = Vec::new();
    for scene in SCENES {
        let [with, without] = [
            costs.of(kernel, &with, scene)?,
            costs.of(kernel, &without, scene)?,
        ];
        rows.extend(with.into_iter().zip(without));
    }
    let head =
        html! { th { "scene" } th { "scalar" } @for column in COLUMNS { th { (column.head) } } };
    let body = html! {
        @for (with, without) in &rows {
            tr {
                td { (with.scene) } td { (with.scalar) }
                @for (share, before) in with.shares.iter().zip(&without.shares) { td { (percent(*share)) " (" (percent(*before)) ")" } }
            }
        }
    };
    Ok(html! {
        h2 { (&title) }
        p { (scaling(dimension)) }
        p { "Tried with " code { (kernel) } ", all other epsilons 0." }
        h3 { "What is proved" }
        p {
            "Of coordinates of points and of their differences up to 1, and of directions up to 1. " (bound_of_size(dimension))
            " u is half the distance from 1 to the next number: 6.0e-8 in f32, 1.1e-16 in f64."
        }
        @for scalar in ["f32", "f64"] { (proved(kernel, gate, &with, scalar)?) }
        h3 { "What it does to rays" }
        p {
            "Answers that are wrong, in % of some " (rays()) " rays of each kind, with this epsilon and (in brackets) with 0: what stands in the brackets too "
            "is not this epsilon's doing. These are our scenes, not yours: unit has edges and distances around 1; room and city are in metres, cad-mm in "
            "millimetres. Grazing rays are aimed at angles from 7 degrees down to below what rounding resolves, so their shares compare epsilons and are "
            "no share of your rays. Self-hits are of rays that start on a computed hit point."
        }
        (table(&format!("What it does, {title}"), &head, &body))
        p { "For your own sizes; at the end stands what the epsilons of the source cost there, and which cost less:" }
        pre { code { "hairline epsilon --kernel " (kernel) " --scene extent=100,edge=0.01..10" } }
    })
}

/// `parallel=1e-6,t=0`: all epsilons of a kernel, one of them at a value.
fn set(entry: &Entry, gate: &str, value: &str) -> String {
    let tunable = entry
        .info
        .gates
        .iter()
        .filter(|gate| gate.epsilon != Tunable::Fixed);
    let words = tunable.map(|other| {
        format!(
            "{}={}",
            other.name,
            if other.name == gate { value } else { "0" }
        )
    });
    words.collect::<Vec<_>>().join(",")
}

/// What `prove` says of the gate at this epsilon.
fn proved(kernel: &str, gate: &str, set: &str, scalar: &str) -> Result<Markup, String> {
    let arguments = [
        "prove",
        "--kernel",
        kernel,
        "--gate",
        gate,
        "--epsilon",
        set,
        "--scalar",
        scalar,
    ];
    let record: Value = program::json(&arguments)?;
    let result = &record["result"];
    let part = &result["gates"][0];
    let verdicts = &result["kernels"][0]["verdicts"];
    let sentences = [&verdicts["sentences"], &part["statements"]].into_iter();
    let sentences = sentences.flat_map(|it| it.as_array().map_or(&[][..], Vec::as_slice));
    Ok(html! {
        h4 { (scalar) }
        @if let Some(why) = part["why"].as_str() { p { "No bound: " (why) "." } }
        ul { @for sentence in sentences.filter_map(Value::as_str) { li { (sentence) } } }
    })
}

/// What is counted in a scene.
struct Column {
    head: &'static str,
    family: &'static str,
    /// How many, of how many.
    count: fn(&KernelResult) -> [u64; 2],
}

const COLUMNS: [Column; 7] = [
    Column {
        head: "hits lost",
        family: "scene-interior",
        count: misses,
    },
    Column {
        head: "grazing hits lost",
        family: "scene-grazing",
        count: misses,
    },
    Column {
        head: "grazing misses hit",
        family: "scene-grazing",
        count: hits,
    },
    Column {
        head: "cracks at edges",
        family: "scene-edges",
        count: cracks,
    },
    Column {
        head: "parallel rays hit",
        family: "scene-parallel",
        count: hits,
    },
    Column {
        head: "hits beside it",
        family: "scene-outside",
        count: hits,
    },
    Column {
        head: "self-hits",
        family: "scene-shadow",
        count: self_hits,
    },
];

fn cracks(part: &KernelResult) -> [u64; 2] {
    part.across
        .as_ref()
        .map_or([0, 0], |across| [across.cracks.count, across.cracks.of])
}

fn self_hits(part: &KernelResult) -> [u64; 2] {
    part.self_hits
        .as_ref()
        .map_or([0, 0], |rate| [rate.count, rate.of])
}

fn misses(part: &KernelResult) -> [u64; 2] {
    [part.total.false_misses.count, part.total.false_misses.of]
}

fn hits(part: &KernelResult) -> [u64; 2] {
    [part.total.false_hits.count, part.total.false_hits.of]
}

#[derive(Clone)]
struct Cost {
    scene: &'static str,
    scalar: String,
    shares: [[u64; 2]; COLUMNS.len()],
}

/// What was measured so far, by kernel, epsilons and scene.
#[derive(Default)]
struct Costs(BTreeMap<(&'static str, String, &'static str), Vec<Cost>>);

impl Costs {
    /// Of a kernel with epsilons in a scene, by scalar.
    fn of(
        &mut self,
        kernel: &'static str,
        set: &str,
        scene: &'static str,
    ) -> Result<Vec<Cost>, String> {
        let key = (kernel, set.to_owned(), scene);
        if !self.0.contains_key(&key) {
            let arguments = [
                "audit",
                "--kernel",
                kernel,
                "--epsilon",
                set,
                "--scene",
                scene,
                "-n",
                &rays(),
            ];
            let record: Record = program::json(&arguments)?;
            let cost = |scalar: ScalarName| Cost {
                scene,
                scalar: scalar.to_string(),
                shares: COLUMNS.map(|Column { family, count, .. }| {
                    let is_of =
                        |part: &&KernelResult| part.scalar == scalar && part.family == family;
                    record
                        .result
                        .results
                        .iter()
                        .find(is_of)
                        .map_or([0, 0], count)
                }),
            };
            self.0.insert(key.clone(), ScalarName::ALL.map(cost).into());
        }
        Ok(self.0[&key].clone())
    }
}

fn percent([count, of]: [u64; 2]) -> String {
    match 100.0 * count as f64 / of as f64 {
        _ if of == 0 => "-".to_owned(),
        0.0 => "0".to_owned(),
        share if share < 0.1 => format!("{share:.2}"),
        share => format!("{share:.1}"),
    }
}
