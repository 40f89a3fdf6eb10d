//! A small change to a kernel, as a difference between two listings of what it compares.

use crate::audit::Row;
use crate::kernel::{Change, Gate, has_size};

/// A kernel's comparisons in order, with its epsilons; and what stands around them.
fn listing(row: &Row, change: Option<Change>, is_fused: bool) -> Vec<String> {
    let mut lines = Vec::new();
    if is_fused {
        lines.push("// compiled with -ffp-contract=fast, or with fma() by hand".to_owned());
    }
    match change {
        Some(Change::Sorted) => lines
            .push("sort(a, b, c);  // by x, then y, then z; u and v go with b and c".to_owned()),
        Some(Change::Double) => {
            lines.push("double o, d, a, b, c;  // from the floats; so is all below".to_owned());
        }
        Some(Change::BySize) => {
            lines.push("L = largest |coordinate| of b-a and c-a;".to_owned());
            lines.push("D = largest |coordinate| of d;".to_owned());
        }
        _ => {}
    }
    for (gate, epsilon) in row.entry.info.gates.iter().zip(&row.epsilons) {
        let mut epsilon = epsilon.to_string();
        if change == Some(Change::BySize) && epsilon != "0" && has_size(gate) {
            epsilon += &size(gate);
        }
        let refuses = gate.refuses.split(" (printed").next().unwrap_or_default();
        lines.push(format!("if ({}) miss;  // {}", with_epsilon(refuses, &epsilon), gate.name));
    }
    if change == Some(Change::Ahead) {
        lines.push("if (t < 0) miss;".to_owned());
    }
    lines.push("hit;".to_owned());
    lines
}

/// `*L*L*D` for a number of length squared times the direction.
fn size(gate: &Gate) -> String {
    let power = |name: &str, times: i8| name.repeat(times.max(0) as usize);
    power("*L", gate.dimension.length) + &power("*D", gate.dimension.direction)
}

/// A refusal with a number for its `e`.
fn with_epsilon(refuses: &str, epsilon: &str) -> String {
    let mut text = String::new();
    let mut before = ' ';
    let mut rest = refuses.chars().peekable();
    while let Some(c) = rest.next() {
        let is_word = |c: &char| c.is_alphanumeric() || *c == '_';
        match c == 'e' && !is_word(&before) && !rest.peek().is_some_and(is_word) {
            // -(-1e-6), -0
            true if before == '-' && (epsilon.starts_with('-') || epsilon == "0") => {
                text.pop();
                text += epsilon.trim_start_matches('-');
            }
            true => text += epsilon,
            false => text.push(c),
        }
        before = c;
    }
    text
}

/// The changes from one row to another with a change around it, as a unified diff.
pub fn patch(before: &Row, after: &Row, change: Option<Change>, is_fused: bool) -> String {
    let (old, new) = (listing(before, None, false), listing(after, change, is_fused));
    let names = [before, after].map(|row| row.flags().replacen("--kernel ", "", 1));
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
