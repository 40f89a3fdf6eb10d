//! How a kernel announces itself: lines of text, the same in front of either encoding.

#![forbid(unsafe_code)]

use super::PROTOCOL;
use super::asked::{Asked, Form};
use crate::arith::FloatEnvironment;
use crate::case::Triangles;
use crate::contract::{Contract, Demand};
use crate::files::number;
use crate::kernel::{Dimension, EpsilonSet, Gate, Gives, KernelInfo, Role, Tunable};
use hairline_boxes::Boxes;

/// A kernel's announcement.
#[derive(Clone, Debug, PartialEq)]
pub struct Hello {
    name: String,
    source: String,
    /// The word of its target.
    judges: &'static str,
    contract: Contract,
    gives: [bool; 3],
    epsilons: Vec<HelloEpsilon>,
    /// True for each scalar in which it runs: `f32`, `f64`.
    pub scalars: [bool; 2],
    /// True if cases and verdicts go in binary.
    pub binary: bool,
    /// How its arithmetic rounds.
    pub floats: FloatEnvironment,
    /// True if it can be asked for margins.
    pub margins: bool,
    /// The number of processes that it wants at most.
    pub processes: u32,
}

#[derive(Clone, Debug, PartialEq)]
struct HelloEpsilon {
    name: String,
    /// None if neither its name nor a word says it.
    role: Option<Role>,
    value: String,
    dimension: Dimension,
    tunable: Tunable,
    refuses: String,
}

/// A hello line by line.
pub struct HelloLines {
    /// The first words of the lines so far.
    said: Vec<String>,
    /// The words of its contract.
    promise: String,
    hello: Hello,
}

impl Default for HelloLines {
    fn default() -> HelloLines {
        let hello = Hello {
            name: String::new(),
            source: "not told".to_owned(),
            judges: TRIANGLES,
            contract: Contract::CLOSED_RAY,
            gives: [false; 3],
            epsilons: Vec::new(),
            scalars: [false; 2],
            binary: false,
            floats: FloatEnvironment::default(),
            margins: false,
            processes: u32::MAX,
        };
        HelloLines {
            said: Vec::new(),
            promise: String::new(),
            hello,
        }
    }
}

impl HelloLines {
    /// Takes a line; the hello, if it was the last. An error says what was expected.
    pub fn take(&mut self, line: &str) -> Result<Option<Hello>, String> {
        let (word, rest) = line
            .trim()
            .split_once(char::is_whitespace)
            .unwrap_or((line.trim(), ""));
        let (rest, hello) = (rest.trim(), &mut self.hello);
        match word {
            "error" => return Err(rest.to_owned()),
            _ if self.said.is_empty() => first_line(line, word, rest)?,
            "name" => hello.name = rest.to_owned(),
            "source" => hello.source = rest.to_owned(),
            "judges" => {
                let known = [TRIANGLES, BOXES];
                let judged = known.into_iter().find(|known| *known == rest);
                hello.judges = judged.ok_or_else(|| {
                    let rest = shown(rest);
                    format!("judges: '{rest}' is none of {}", known.join(", "))
                })?;
            }
            "contract" => {
                hello.contract = rest.parse().map_err(|error| format!("contract: {error}"))?;
                self.promise = rest.to_owned();
            }
            "gives" => hello.gives = subset(rest, "gives", ["t", "uv", "facing"])?,
            "scalars" => hello.scalars = subset(rest, "scalars", ["f32", "f64"])?,
            "encoding" => {
                hello.binary = match rest {
                    "text" => false,
                    "binary" => true,
                    other => return Err(format!("encoding: '{other}' is none of text, binary")),
                }
            }
            "floats" => {
                let floats = rest.parse().ok().and_then(FloatEnvironment::from_bits);
                hello.floats =
                    floats.ok_or_else(|| format!("floats: '{}' is not 0 to 15", shown(rest)))?;
            }
            "margins" => hello.margins = true,
            "processes" => {
                let number = rest.parse().ok().filter(|number| 0 < *number);
                hello.processes = number
                    .ok_or_else(|| format!("processes: '{}' is not 1 or more", shown(rest)))?;
            }
            "epsilon" => hello.epsilons.push(epsilon(rest)?),
            "ready" => return self.finish().map(Some),
            _ => {
                let known = "name, source, judges, contract, gives, scalars, encoding, floats, margins, processes, epsilon, ready, error";
                return Err(format!("'{}' is none of {known}", shown(line)));
            }
        }
        if word != "epsilon" && self.has(word) {
            return Err(format!("'{word}' is said twice"));
        }
        self.said.push(word.to_owned());
        Ok(None)
    }

    /// True if a line came.
    pub fn have_begun(&self) -> bool {
        !self.said.is_empty()
    }

    /// True if a line began with a word.
    fn has(&self, word: &str) -> bool {
        self.said.iter().any(|said| said == word)
    }

    fn finish(&self) -> Result<Hello, String> {
        let hello = &self.hello;
        let missing = |what: &str| Err(format!("its hello has no line '{what} …' before 'ready'"));
        if !self.has("scalars") {
            return missing("scalars");
        }
        if hello.scalars == [false; 2] {
            return Err("scalars: none is named; there are f32 and f64".to_owned());
        }
        if hello.margins && !hello.binary {
            return Err("margins: they are asked for in 'encoding binary' only".to_owned());
        }
        let names: Vec<&str> = hello
            .epsilons
            .iter()
            .map(|epsilon| &*epsilon.name)
            .collect();
        if let Some(i) = (1..names.len()).find(|&i| names[..i].contains(&names[i])) {
            return Err(format!("epsilon '{}' is announced twice", names[i]));
        }
        if hello.name.is_empty() {
            return missing("name");
        }
        if !self.has("contract") {
            return missing("contract");
        }
        let mut hello = hello.clone();
        if hello.judges == BOXES {
            hello.contract = self.promise_of_boxes(hello.contract);
        }
        Ok(hello)
    }

    /// A box stands for what is in it: if flat, or if a ray runs in a face, it is a hit unless the words say otherwise.
    fn promise_of_boxes(&self, contract: Contract) -> Contract {
        let demand = |word: &str, said: Demand| match self.promise.contains(word) {
            true => said,
            false => Demand::Hit,
        };
        let coplanar = demand("coplanar=", contract.coplanar);
        let degenerate = demand("degenerate=", contract.degenerate);
        contract.with_flat(coplanar, degenerate)
    }
}

/// The words of the targets.
const TRIANGLES: &str = Triangles::FORM.judges;
const BOXES: &str = Boxes::FORM.judges;

impl Hello {
    /// An error if it judges another target.
    pub fn is_of(&self, form: &Form) -> Result<(), String> {
        if self.judges == form.judges {
            return Ok(());
        }
        let (judges, asked) = (self.judges, form.judges);
        Err(format!(
            "it judges {judges}, and this command asks about {asked} ('judges {asked}' in its hello says that it judges them)"
        ))
    }

    /// True if it takes epsilons.
    pub fn has_epsilons(&self) -> bool {
        !self.epsilons.is_empty()
    }

    /// Notes on the announcement, each in one line.
    pub fn notes(&self) -> Vec<String> {
        let unknown = self
            .epsilons
            .iter()
            .filter(|epsilon| epsilon.role.is_none());
        let note = |epsilon: &HelloEpsilon| {
            format!(
                "what its epsilon '{}' is there to refuse is not known, so advice about it is poor; begin its \
                 meaning with role=parallel (parallel rays, triangles without area), role=t (off the ends of the \
                 ray), role=edge (outside the triangle) or role=other",
                epsilon.name
            )
        };
        unknown.map(note).collect()
    }

    /// The kernel's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its entry for the table of kernels, which lives as long as the process.
    pub fn info(&self) -> &'static KernelInfo {
        let [t, uv, facing] = self.gives;
        let gate = |epsilon: &HelloEpsilon| Gate {
            name: leak(&epsilon.name),
            role: epsilon.role.unwrap_or(Role::Other),
            refuses: leak(&epsilon.refuses),
            printed: None,
            dimension: epsilon.dimension,
            epsilon: epsilon.tunable,
        };
        let values: Vec<&'static str> = self.epsilons.iter().map(|e| leak(&e.value)).collect();
        let sets = vec![EpsilonSet {
            name: "own",
            values: values.leak(),
        }];
        Box::leak(Box::new(KernelInfo {
            source: leak(&self.source),
            gates: self.epsilons.iter().map(gate).collect::<Vec<_>>().leak(),
            epsilon_sets: sets.leak(),
            gives: Gives { t, uv, facing },
            ..KernelInfo::own(leak(&self.name), self.contract)
        }))
    }
}

fn leak(text: &str) -> &'static str {
    text.to_owned().leak()
}

fn first_line(line: &str, word: &str, rest: &str) -> Result<(), String> {
    if word != "hairline-kernel" {
        let line = shown(line);
        return Err(format!(
            "its first line is '{line}', expected 'hairline-kernel {PROTOCOL}'"
        ));
    }
    if rest.parse() != Ok(PROTOCOL) {
        let rest = shown(rest);
        return Err(format!(
            "it speaks protocol '{rest}', this program speaks {PROTOCOL}"
        ));
    }
    Ok(())
}

/// Which of some words a line has.
fn subset<const N: usize>(text: &str, what: &str, known: [&str; N]) -> Result<[bool; N], String> {
    let mut found = [false; N];
    for word in text.split_whitespace() {
        let place = known
            .iter()
            .position(|known| *known == word)
            .ok_or_else(|| format!("{what}: '{}' is none of {}", shown(word), known.join(", ")))?;
        found[place] = true;
    }
    Ok(found)
}

/// `NAME VALUE LENGTH DIRECTION signed|non-negative [role=ROLE] MEANING…`.
fn epsilon(text: &str) -> Result<HelloEpsilon, String> {
    let shape = || {
        format!(
            "epsilon: '{}' is not NAME VALUE LENGTH DIRECTION signed|non-negative [role=ROLE] [MEANING], as: parallel 1e-6 2 1 non-negative abs(det) < e",
            shown(text)
        )
    };
    let mut words = text.split_whitespace();
    let mut next = || words.next().ok_or_else(shape);
    let (name, value, length, direction, tunable) = (next()?, next()?, next()?, next()?, next()?);
    let power = |word: &str| word.parse::<i8>().map_err(|_| shape());
    let dimension = Dimension::new(power(length)?, power(direction)?);
    let tunable = match tunable {
        "signed" => Tunable::Signed,
        "non-negative" => Tunable::NonNegative,
        _ => return Err(shape()),
    };
    if name == "t_min" {
        return Err(
            "epsilon t_min: the name is taken: it is the start of each ray's interval".to_owned(),
        );
    }
    let finite = [
        number::parse::<f32>(value).map(f64::from),
        number::parse::<f64>(value),
    ];
    let fits = |x: &f64| x.is_finite() && (tunable == Tunable::Signed || *x >= 0.0);
    if !finite.iter().all(|x| x.as_ref().is_ok_and(fits)) || value.contains(['x', 'X']) {
        let plain = value.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let advice = match plain != value && number::parse::<f64>(plain).is_ok() {
            true => format!("; write {plain}, without a suffix"),
            false => String::new(),
        };
        let value = shown(value);
        return Err(format!(
            "epsilon {name}: '{value}' is no epsilon that it can take{advice}"
        ));
    }
    let mut words = words.peekable();
    let role = match words.next_if(|word| word.starts_with("role=")) {
        None => Role::of_gate(name),
        Some(word) => Some(Role::named(&word["role=".len()..]).ok_or_else(|| {
            let known = Role::ALL.map(Role::name).join(", ");
            format!("epsilon {name}: '{}' is none of {known}", shown(word))
        })?),
    };
    let meaning = words.collect::<Vec<_>>().join(" ");
    let refuses = if meaning.is_empty() {
        "not told".to_owned()
    } else {
        meaning
    };
    let (name, value) = (name.to_owned(), value.to_owned());
    Ok(HelloEpsilon {
        name,
        role,
        value,
        dimension,
        tunable,
        refuses,
    })
}

/// The beginning of what a process wrote, on one line.
pub fn shown(text: &str) -> String {
    let start: String = text.chars().take(60).collect();
    let dots = if start.len() < text.len() { "…" } else { "" };
    start
        .chars()
        .flat_map(char::escape_debug)
        .collect::<String>()
        + dots
}

#[cfg(test)]
mod tests;
