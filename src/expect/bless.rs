//! Writing what a run found as what is expected from now on.

use super::{Amount, Entry, Expectations, SCHEMA};
use crate::report::{Conformance, Disagreement, ResultPart, disagreements};
use std::fmt::Write;

/// Why expectations cannot be written: the file also has entries for kernels, scalars or families that
/// the plan leaves out, and these would be lost.
#[derive(Debug)]
pub struct Unblessable {
    /// How many.
    pub outside_the_plan: u64,
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
