//! Writing what a run found as what is expected from now on.

use super::{Amount, Entry, Expectations, SCHEMA};
use crate::report::{Conformance, Disagreement, Method, ResultPart, disagreements};
use std::fmt::{self, Write};

/// Why expectations cannot be written: the file also has entries for kernels, scalars or families that
/// the plan leaves out, and these would be lost.
#[derive(Debug)]
pub struct Unblessable {
    /// How many.
    pub outside_the_plan: u64,
}

/// How many classes of disagreement change when a run becomes what is expected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NetChange {
    /// Fewer cases than expected, or none.
    pub better: u64,
    /// More cases than expected.
    pub worse: u64,
    /// Cases where none is expected.
    pub new: u64,
    /// As many cases as expected, but not the same ones.
    pub other_cases: u64,
    /// As expected.
    pub unchanged: u64,
}

impl NetChange {
    /// From expectations to what a run found.
    pub fn of(old: &Expectations, compared: &Conformance) -> NetChange {
        let mut change = NetChange {
            better: compared.stale.len() as u64,
            unchanged: compared.known.len() as u64,
            ..NetChange::default()
        };
        for found in &compared.unexpected {
            let is_same_rate = |count: u64, of: Option<u64>| {
                compared.method == Method::CaseByCase
                    && count == found.found.count
                    && of.is_none_or(|of| of == found.found.of)
            };
            *match old.entries.get(&found.key()).map(|entry| &entry.amount) {
                None => &mut change.new,
                Some(Amount::Count { count, of, .. }) if is_same_rate(*count, *of) => {
                    &mut change.other_cases
                }
                Some(_) => &mut change.worse,
            } += 1;
        }
        change
    }

    /// Whether something got worse.
    pub fn is_worse(&self) -> bool {
        0 < self.worse + self.new
    }
}

impl fmt::Display for NetChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let NetChange { better, worse, new, other_cases, unchanged } = self;
        write!(
            f,
            "{better} better, {worse} worse, {new} new, {other_cases} of other cases, {unchanged} unchanged"
        )
    }
}

/// The file of expectations that a run would meet. Reasons and links of the old one are kept, and so
/// are bounds by rate that hold; nothing that the plan leaves out is dropped silently.
pub fn bless(
    result: &ResultPart,
    old: &Expectations,
    compared: &Conformance,
) -> Result<String, Unblessable> {
    if compared.outside_the_plan > 0 {
        return Err(Unblessable { outside_the_plan: compared.outside_the_plan });
    }
    let mut text = format!(
        "# Known disagreements: what `hairline check` expects beside the default, which is none.\n\
         # `hairline check --bless` writes this file; `why` and `url` of an entry are kept.\n\
         # An entry has a count (with `of` and the digest of the cases), or a `rate`, an upper bound.\n\
         schema = \"{SCHEMA}\"\nplan = \"{}\"\n",
        result.plan.hash
    );
    let found = disagreements(result);
    let row = |found: &Disagreement| {
        let key = &found.key;
        (key.scalar.clone(), key.kernel.clone(), key.set.clone())
    };
    let rows = result.plan.scalars.iter().flat_map(|scalar| {
        let of_row =
            |part: &crate::report::RowPart| (scalar.clone(), part.kernel.clone(), part.set.clone());
        result.plan.rows.iter().map(of_row).collect::<Vec<_>>()
    });
    for wanted in rows {
        let mut of_row = found.iter().filter(|found| row(found) == wanted).peekable();
        if of_row.peek().is_none() {
            continue;
        }
        let (scalar, kernel, set) = &wanted;
        let (kernel, set, scalar) = (quoted(kernel), quoted(set), quoted(scalar));
        let _ = write!(
            text,
            "\n[[known]]\nkernel = {kernel}\nset = {set}\nscalar = {scalar}\nfindings = [\n"
        );
        for found in of_row {
            let held = compared.known.iter().any(|known| known.key() == found.key);
            let old = old.entries.get(&found.key);
            let _ = writeln!(text, "  {},", line(found, old, held));
        }
        text.push_str("]\n");
    }
    Ok(text)
}

fn line(found: &Disagreement, old: Option<&Entry>, held: bool) -> String {
    let key = &found.key;
    let amount = match old.map(|old| &old.amount) {
        Some(Amount::Rate(rate)) if held => format!("rate = {rate:?}"),
        _ => format!(
            "count = {}, of = {}, digest = {}",
            found.rate.count,
            found.rate.of,
            quoted(found.digest)
        ),
    };
    let mut line = format!(
        "{{ family = {}, class = {}, finding = {}, {amount}",
        quoted(&key.family),
        quoted(&key.class),
        quoted(&key.finding)
    );
    for (name, text) in [
        ("why", old.and_then(|old| old.why.as_ref())),
        ("url", old.and_then(|old| old.url.as_ref())),
    ] {
        if let Some(text) = text {
            let _ = write!(line, ", {name} = {}", quoted(text));
        }
    }
    line + " }"
}

/// A TOML string.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => _ = write!(quoted, "\\u{:04X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
