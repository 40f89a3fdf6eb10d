//! The certificate of a guarded kernel.

use super::super::certificate::{comparison_text, heading, operation_text};
use super::{Axes, Guarded, Literal, Step};
use std::fmt::Write;

impl Guarded {
    /// Its program, its margins and its decisions, for the checker.
    pub fn certificate(&self) -> String {
        let (extent, is_front) = self.promise();
        let mut text = heading(self.info.name, self.scalar, self.scale.format);
        let sides = if is_front { "front" } else { "both" };
        let _ = writeln!(text, "guarded {} {sides}", extent.name());
        for (place, operation) in self.operations.iter().enumerate() {
            let _ = writeln!(text, "op {place} {}", operation_text(operation));
        }
        for (place, margin) in &self.margins {
            let _ = writeln!(
                text,
                "margin {place} {} {}",
                margin.roundings, margin.factor
            );
        }
        self.write_step(&self.steps, &mut text);
        text.push_str("end\n");
        text
    }

    fn write_step(&self, step: &Step, text: &mut String) {
        let _ = match step {
            Step::Choice(comparison, ..) => {
                writeln!(text, "choice {}", comparison_text(comparison))
            }
            Step::Sign(literal, ..) => writeln!(text, "sign {}", literal_text(literal)),
            Step::Gate(gate, patterns, _) => {
                let mut lines = vec![format!("gate {}", self.info.gates[*gate].name)];
                for (word, patterns) in ["hit", "miss"].into_iter().zip(patterns) {
                    lines.extend(patterns.iter().map(|pattern| {
                        let words = pattern
                            .iter()
                            .map(|literal| format!(" {}", literal_text(literal)));
                        format!("{word}{}", words.collect::<String>())
                    }));
                }
                writeln!(text, "{}", lines.join("\n"))
            }
            Step::Axes(axes, _) => {
                write_axes(axes, text);
                Ok(())
            }
            Step::Hit(_) => writeln!(text, "found"),
            Step::Ask => writeln!(text, "ask"),
        };
        step.next()
            .into_iter()
            .for_each(|step| self.write_step(step, text));
    }
}

fn write_axes(axes: &Axes, text: &mut String) {
    match axes {
        Axes::Are(axes) => {
            let names: String = axes
                .iter()
                .map(|axis| ['x', 'y', 'z'][usize::from(*axis)])
                .collect();
            let _ = writeln!(text, "axes {names}");
        }
        Axes::If(comparison, yes, no) => {
            let _ = writeln!(text, "axes {}", comparison_text(comparison));
            write_axes(yes, text);
            write_axes(no, text);
        }
    }
}

/// `-3*7!5`: the product of 3 and 7 is negative, and 5 is not zero.
fn literal_text(
    Literal {
        is_negative,
        signs,
        nonzero,
    }: &Literal,
) -> String {
    let signs: Vec<String> = signs.iter().map(u32::to_string).collect();
    let nonzero: String = nonzero.iter().map(|place| format!("!{place}")).collect();
    format!(
        "{}{}{nonzero}",
        if *is_negative { '-' } else { '+' },
        signs.join("*")
    )
}
