//! A small change to a kernel, as a difference between two listings of what it compares.

use super::candidates::Candidate;
use crate::audit::Row;
use crate::kernel::{Change, Gate, Role, refuses_at};

/// A kernel's comparisons in order, with its epsilons; and what stands around them. Plain gates are those of the kernel
/// without the change.
fn listing(row: &Row, plain: &[Gate], change: Option<Change>, is_fused: bool) -> Vec<String> {
    let head: &[&str] = match change {
        None if is_fused => &["// compiled with -ffp-contract=fast, or with fma() by hand"],
        Some(Change::Sorted) => {
            &["sort(a, b, c);  // by x, then y, then z; u and v go with b and c"]
        }
        Some(Change::Double) => &["double o, d, a, b, c;  // from the floats; so is all below"],
        Some(Change::BySize) => {
            &["L = largest |coordinate| of b-a and c-a;", "D = largest |coordinate| of d;"]
        }
        _ => &[],
    };
    let mut lines: Vec<String> = head.iter().map(|line| (*line).to_owned()).collect();
    if row.entry.info.gates.iter().any(|gate| gate.refuses.contains("TINY")) {
        lines.push("TINY = the least positive float;".to_owned());
    }
    for ((gate, plain), epsilon) in row.entry.info.gates.iter().zip(plain).zip(&row.epsilons) {
        let epsilon = epsilon.to_string();
        // Nothing times a size is nothing.
        let refuses = if epsilon == "0" { plain.refuses } else { gate.refuses };
        let refuses = refuses.split(" (printed").next().unwrap_or_default();
        if change == Some(Change::Fallback) && gate.role == Role::Edge {
            let what = "the least number below == 0";
            lines.push(format!("if ({what}) return the_same_in_double(o, d, a, b, c);"));
        }
        lines.push(format!("if ({}) miss;  // {}", refuses_at(refuses, &epsilon), gate.name));
    }
    lines.extend((change == Some(Change::Ahead)).then(|| "if (t < 0) miss;".to_owned()));
    lines.push("hit;".to_owned());
    lines
}

/// The changes from a row to a candidate, as a unified diff.
pub fn patch(before: &Row, after: &Candidate) -> String {
    let gates = before.entry.info.gates;
    let old = listing(before, gates, None, false);
    let new = listing(&after.row, gates, after.change(), after.is_fused());
    let names = [before, &after.row].map(|row| row.flags().replacen("--kernel ", "", 1));
    let mut lines = vec![
        format!("--- {}", names[0]),
        format!("+++ {}", names[1]),
        format!("@@ -1,{} +1,{} @@", old.len(), new.len()),
    ];
    let mut rest = &new[..];
    for line in &old {
        match rest.iter().position(|it| it == line) {
            Some(place) => {
                lines.extend(rest[..place].iter().map(|line| format!("+{line}")));
                lines.push(format!(" {line}"));
                rest = &rest[place + 1..];
            }
            None => lines.push(format!("-{line}")),
        }
    }
    lines.extend(rest.iter().map(|line| format!("+{line}")));
    lines.join("\n")
}
