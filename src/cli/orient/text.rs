//! A record of orientation predicates as text for people. The layout is not stable.

use crate::orientation::{CasePart, Rate, Record};
use crate::report::group_digits;
use std::io::{self, Write};

/// Writes one table for each dimension and scalar, then the first examples.
pub(super) fn write(record: &Record, out: &mut dyn Write) -> io::Result<()> {
    let (result, provenance) = (&record.result, &record.provenance);
    writeln!(
        out,
        "{}, seed {}, {} threads, {:.1} s",
        provenance.tool, result.seed, provenance.threads, provenance.seconds
    )?;
    let mut heading = (0, "");
    for (row, timing) in result.results.iter().zip(&provenance.timings) {
        if heading != (row.dimension, row.scalar) {
            heading = (row.dimension, row.scalar);
            write_heading(record, heading, out)?;
        }
        writeln!(
            out,
            "{:<18} {:<11} {:<34} {:<38} {:<38} {:>7.1}",
            label(row.predicate, row.epsilon.as_deref()),
            row.family,
            rate(&row.wrong_sign),
            rate(&row.false_zero),
            rate(&row.missed_zero),
            timing.nanoseconds_per_call
        )?;
    }
    writeln!(out, "\nFirst findings")?;
    if result.examples.is_empty() {
        return writeln!(out, "none");
    }
    for example in &result.examples {
        let label = label(example.predicate, example.epsilon.as_deref());
        writeln!(out, "{label}, {}: {}", example.case.scalar, example.finding)?;
        write_case(&example.case, "    ", out)?;
        writeln!(out, "    {}", command(&example.case.id, example.epsilon.as_deref()))?;
    }
    Ok(())
}

fn write_heading(
    record: &Record,
    (dimension, scalar): (usize, &'static str),
    out: &mut dyn Write,
) -> io::Result<()> {
    let sets = record.result.sets.iter();
    let zeros: Vec<String> = sets
        .filter(|set| (set.dimension, set.scalar) == (dimension, scalar))
        .map(|set| format!("{} {}", set.family, group_digits(set.zeros)))
        .collect();
    writeln!(
        out,
        "\norient{dimension}d, {scalar}, {} cases of each family; exactly 0: {}",
        group_digits(record.result.count),
        zeros.join(", ")
    )?;
    writeln!(
        out,
        "{:<18} {:<11} {:<34} {:<38} {:<38} {:>7}",
        "predicate (eps.)",
        "family",
        "wrong-sign, % of all",
        "false-zero, % of nonzero",
        "missed-zero, % of zeros",
        "ns/call"
    )
}

fn label(predicate: &str, epsilon: Option<&str>) -> String {
    epsilon.map_or_else(|| predicate.to_owned(), |epsilon| format!("{predicate} ({epsilon})"))
}

/// `1,234 of 20,000: 6.2 [5.8, 6.5]`, `-` without a trial.
fn rate(rate: &Rate) -> String {
    let (Some(share), Some([low, high])) = (rate.rate, rate.interval) else {
        return "-".to_owned();
    };
    let (count, of) = (group_digits(rate.count), group_digits(rate.of));
    let [share, low, high] = [share, low, high].map(|x| 100.0 * x);
    format!("{count} of {of}: {share:.2} [{low:.2}, {high:.2}]")
}

/// The command that shows a case again with the epsilon of its row.
fn command(id: &str, epsilon: Option<&str>) -> String {
    let epsilon = epsilon.map_or_else(String::new, |epsilon| format!(" --epsilon {epsilon}"));
    format!("hairline orient --case '{id}'{epsilon}")
}

/// One case: its points with their bits, the truth, and every answer that it has.
pub(super) fn write_case(case: &CasePart, indent: &str, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{indent}{}", case.id)?;
    for ((name, point), bits) in ["a", "b", "c", "d"].iter().zip(&case.points).zip(&case.bits) {
        let numbers: Vec<String> = point.iter().map(|&x| number(x, case.scalar)).collect();
        writeln!(out, "{indent}  {name} = ({})  {}", numbers.join(", "), bits.join(","))?;
    }
    writeln!(out, "{indent}  exact: {}  det = {}", case.sign, case.determinant)?;
    for answer in &case.answers {
        let verdict = answer.finding.unwrap_or("right");
        writeln!(
            out,
            "{indent}  {:<18} says {:<3}  det = {}  {verdict}",
            label(answer.predicate, answer.epsilon.as_deref()),
            answer.answer,
            answer.determinant
        )?;
    }
    Ok(())
}

/// The shortest text that reads back as the number in its scalar.
fn number(value: f64, scalar: &str) -> String {
    if scalar == "f32" { format!("{:?}", value as f32) } else { format!("{value:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_name_count_trials_share_and_interval() {
        let some = Rate {
            count: 1234,
            of: 20000,
            rate: Some(0.0617),
            interval: Some([0.0584, 0.0651]),
            first: None,
        };
        assert_eq!(rate(&some), "1,234 of 20,000: 6.17 [5.84, 6.51]");
        let none = Rate { count: 0, of: 0, rate: None, interval: None, first: None };
        assert_eq!(rate(&none), "-");
    }
}
