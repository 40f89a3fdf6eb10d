//! The certificate of a guarded kernel.

use super::super::certificate::{Heading, comparison_text, heading, operation_text};
use super::{Axes, Guarded, Literal, Step};
use std::fmt::Write;

impl Guarded {
    /// Its program, its margins and its decisions, for the checker.
    pub fn certificate(&self) -> String {
        let head =
            Heading { kernel: self.info.name, scalar: self.scalar, format: self.scale.format };
        let (extent, is_front) = self.promise();
        let mut text = heading(&head);
        let sides = if is_front { "front" } else { "both" };
        let _ = writeln!(text, "guarded {} {sides}", extent.name());
        for (place, operation) in self.operations.iter().enumerate() {
            let _ = writeln!(text, "op {place} {}", operation_text(operation));
        }
        for (place, margin) in &self.margins {
            let _ = writeln!(text, "margin {place} {} {}", margin.roundings, margin.factor);
        }
        self.write_step(&self.steps, &mut text);
        text.push_str("end\n");
        text
    }

    fn write_step(&self, step: &Step, text: &mut String) {
        match step {
            Step::Choice(comparison, yes, no) => {
                let _ = writeln!(text, "choice {}", comparison_text(comparison));
                self.write_step(yes, text);
                self.write_step(no, text);
            }
            Step::Sign(literal, yes, no) => {
                let _ = writeln!(text, "sign {}", literal_text(literal));
                self.write_step(yes, text);
                self.write_step(no, text);
            }
            Step::Gate(gate, patterns, next) => {
                let _ = writeln!(text, "gate {}", self.info.gates[*gate].name);
                for (word, patterns) in ["hit", "miss"].iter().zip(patterns) {
                    for pattern in patterns {
                        let words = pattern.iter().map(literal_text);
                        let words: Vec<String> =
                            [(*word).to_owned()].into_iter().chain(words).collect();
                        let _ = writeln!(text, "{}", words.join(" "));
                    }
                }
                self.write_step(next, text);
            }
            Step::Axes(axes, next) => {
                write_axes(axes, text);
                self.write_step(next, text);
            }
            Step::Hit(_) => text.push_str("found\n"),
            Step::Ask => text.push_str("ask\n"),
        }
    }
}

fn write_axes(axes: &Axes, text: &mut String) {
    match axes {
        Axes::Are(axes) => {
            let names: String =
                axes.iter().map(|axis| ['x', 'y', 'z'][usize::from(*axis)]).collect();
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
fn literal_text(Literal { is_negative, signs, nonzero }: &Literal) -> String {
    let signs: Vec<String> = signs.iter().map(u32::to_string).collect();
    let nonzero: String = nonzero.iter().map(|place| format!("!{place}")).collect();
    format!("{}{}{nonzero}", if *is_negative { '-' } else { '+' }, signs.join("*"))
}
