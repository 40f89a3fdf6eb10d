//! A study of a scene for people at a terminal: what to use, what it does, and how far each number may
//! move.

use super::record::*;
use super::words::label;
use crate::report::record::Rate;
use crate::report::{Style, group_digits, number_of};
use std::io::{self, Write};

/// The width of a column of the tables.
const WIDTH: usize = 13;

/// Writes the recommendation first, then the evidence.
pub fn write(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    for (i, part) in record.kernels.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        recommendation(record, part, out)?;
        effects(record, part, out)?;
        limits(record, part, out)?;
    }
    legend(record, out)
}

/// ` m`; nothing without a unit.
fn spaced(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// The unit of t.
fn unit_of_t(record: &SceneRecord) -> String {
    match record.unit_directions {
        true => spaced(&record.unit),
        false => " of the way to the target".to_owned(),
    }
}

/// The `--epsilon` flag of some epsilons; none if no gate takes one.
fn flag(part: &SceneKernelPart, epsilons: &[String]) -> Option<String> {
    let gates = part.knobs.iter().zip(epsilons).filter(|(knob, _)| knob.is_gate);
    let words: Vec<String> = gates.map(|(knob, e)| format!("{}={e}", knob.name)).collect();
    (!words.is_empty()).then(|| format!("--epsilon {}", words.join(",")))
}

fn least_t<'a>(part: &SceneKernelPart, epsilons: &'a [String]) -> Option<&'a String> {
    let knobs = part.knobs.iter().zip(epsilons);
    knobs.filter(|(knob, _)| !knob.is_gate).map(|(_, epsilon)| epsilon).next()
}

fn recommendation(
    record: &SceneRecord,
    part: &SceneKernelPart,
    out: &mut dyn Write,
) -> io::Result<()> {
    let SceneRecord { scene, unit, mesh, .. } = record;
    match mesh {
        Some(MeshPart { file, triangles, .. }) => {
            let triangles = number_of(*triangles, "triangle", "triangles");
            writeln!(out, "{} {} in {file} ({triangles})", part.kernel, part.scalar)?;
            writeln!(out, "  {scene}")?;
        }
        None => writeln!(out, "{} {} in {scene}{}", part.kernel, part.scalar, of_unit(unit))?,
    }
    let epsilons = &part.tried[0].epsilons;
    let t = least_t(part, epsilons).map(|e| match part.takes_interval {
        true => format!("t_min = {}{} on every ray", human(e), unit_of_t(record)),
        false => format!("count a hit only if t >= {}{}", human(e), unit_of_t(record)),
    });
    let parts: Vec<String> = flag(part, epsilons).into_iter().chain(t).collect();
    writeln!(out, "  use  {}", parts.join("  and  "))?;
    for (knob, epsilon) in part.knobs.iter().zip(epsilons) {
        if let Some(meaning) = meaning(record, part, knob, epsilon) {
            writeln!(out, "       {meaning}")?;
        }
    }
    Ok(())
}

fn of_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" ({unit})") }
}

/// What an epsilon means for the scene's triangles.
fn meaning(
    record: &SceneRecord,
    part: &SceneKernelPart,
    knob: &KnobPart,
    epsilon: &str,
) -> Option<String> {
    let value: f64 = epsilon.parse().ok().filter(|value| *value != 0.0)?;
    let unit = spaced(&record.unit);
    match (knob.role.as_str(), knob.dimension) {
        ("t", [1, -1]) => {
            Some(format!("nothing nearer than {}{} is hit", human(epsilon), unit_of_t(record)))
        }
        ("parallel", [2, 1]) if record.unit_directions && 0.0 < value => {
            if let Some(shape) = part.least_shape {
                return Some(match value / shape {
                    small if small < 1.0 => {
                        format!(
                            "the smallest triangle is missed at angles below {}",
                            degrees(small)
                        )
                    }
                    _ => "the smallest triangle is never hit".to_owned(),
                });
            }
            // Twice the area of an equilateral triangle, times the sine, is the determinant.
            let small = value / (0.75f64.sqrt() * record.edge[0] * record.edge[0]);
            let least = (value / 0.75f64.sqrt()).sqrt();
            Some(match 1.0 <= small {
                true => format!("no triangle below an edge of {least:.1e}{unit} is ever hit"),
                false => format!(
                    "the smallest triangles (edge {}{unit}) are missed at angles below {}",
                    record.edge[0],
                    degrees(small)
                ),
            })
        }
        ("parallel", [0, 1]) if record.unit_directions && 0.0 < value && value < 1.0 => {
            Some(format!("every triangle is missed at angles below {}", degrees(value)))
        }
        ("edge", [0, 0]) => {
            let what = if value < 0.0 { "larger" } else { "smaller" };
            Some(format!("triangles are {what} by {:e} of their size at each side", value.abs()))
        }
        _ => None,
    }
}

fn degrees(sine: f64) -> String {
    let angle = libm::asin(sine.min(1.0)).to_degrees();
    if angle < 0.01 { format!("{angle:.0e}\u{b0}") } else { format!("{angle:.2}\u{b0}") }
}

/// A shortest decimal as people write it.
fn human(epsilon: &str) -> String {
    match epsilon.parse::<f64>() {
        Ok(value) if (1e-4..1e7).contains(&value.abs()) => format!("{value}"),
        _ => epsilon.to_owned(),
    }
}

fn effects(record: &SceneRecord, part: &SceneKernelPart, out: &mut dyn Write) -> io::Result<()> {
    let title = format!("wrong on fresh rays (seed {}):", record.fresh_seed);
    write!(out, "{title:<32}")?;
    for tried in &part.tried {
        let name = match tried.name.as_str() {
            "recommended" => "this",
            "source" => "as published",
            name if WIDTH <= name.len() => "as given",
            name => name,
        };
        write!(out, "{name:>WIDTH$}")?;
    }
    writeln!(out)?;
    for (i, count) in part.counts.iter().enumerate() {
        write!(out, "  {:<30}", label(&count.stratum, &count.kind))?;
        for tried in &part.tried {
            write!(out, "{:>WIDTH$}", share(&tried.wrong[i]))?;
        }
        writeln!(out)?;
    }
    write!(out, "  {:<30}", "cost")?;
    for tried in &part.tried {
        write!(out, "{:>WIDTH$}", format!("{:.3}", tried.cost))?;
    }
    writeln!(out)?;
    if let Some(relative) = &part.relative {
        let forms = part.knobs.iter().zip(&relative.epsilons).map(|(knob, e)| match &knob.form {
            Some(form) => format!("{}: {}", knob.name, form.replacen('e', e, 1)),
            None => format!("{}: {e}", knob.name),
        });
        let forms: Vec<String> = forms.collect();
        let cost = relative.cost;
        writeln!(out, "epsilons that follow each triangle's size would cost {cost:.3}:")?;
        writeln!(out, "  {}", forms.join(", "))?;
    }
    Ok(())
}

/// `0 of 40,000`, `1 in 1,200`, `2.9%`.
fn share(rate: &Rate) -> String {
    match rate.rate {
        None => "-".to_owned(),
        Some(0.0) => format!("0 of {}", group_digits(rate.of)),
        Some(share) if share < 0.01 => {
            let one_in = 1.0 / share;
            let unit = 10f64.powi((one_in.log10().floor() as i32 - 1).max(0));
            format!("1 in {}", group_digits(((one_in / unit).round() * unit) as u64))
        }
        Some(share) => format!("{:.1}%", share * 100.0),
    }
}

/// `>= 1.2e-6`, or that no value keeps the limit.
fn bound(limit: &LimitPart, unit: &str) -> String {
    match &limit.value {
        Some(value) => {
            format!("{} {}{unit}", if limit.is_lower { ">=" } else { "<=" }, human(value))
        }
        None => "no value".to_owned(),
    }
}

fn limits(record: &SceneRecord, part: &SceneKernelPart, out: &mut dyn Write) -> io::Result<()> {
    if part.limits.is_empty() {
        return Ok(());
    }
    let title = "each alone may move to (95 % sure, so 1 in 20 fails):";
    writeln!(out, "{title:<55}{:>11}{:>WIDTH$}", "at most", "fresh rays")?;
    let unit = |knob: &KnobPart| match (knob.role.as_str(), record.unit_directions) {
        ("t", true) => spaced(&record.unit),
        _ => String::new(),
    };
    for limit in &part.limits {
        let (knob, count) = (&part.knobs[limit.knob], &part.counts[limit.count]);
        let what = label(&count.stratum, &count.kind);
        let fresh = limit.fresh.as_ref().map_or("-".to_owned(), |fresh| match fresh.count {
            0 => "0".to_owned(),
            _ => share(fresh),
        });
        writeln!(
            out,
            "  {:<8} {:<13} {what:<29}{:>12}{fresh:>WIDTH$}{}",
            knob.name,
            bound(limit, &unit(knob)),
            format!("1 in {}", group_digits(limit.one_in)),
            if limit.set_by.is_some() { " *" } else { "" },
        )?;
    }
    for conflict in &part.conflicts {
        let (lower, upper) = (&part.limits[conflict.lower], &part.limits[conflict.upper]);
        let knob = &part.knobs[lower.knob];
        let unit = unit(knob);
        let what = |limit: &LimitPart| {
            let count = &part.counts[limit.count];
            format!("{} ({})", bound(limit, &unit), label(&count.stratum, &count.kind))
        };
        writeln!(out, "no value of {} is both {}", knob.name, what(lower))?;
        writeln!(out, "  and {}:", what(upper))?;
        let instead = match (&conflict.scale_free, &knob.form, knob.role.as_str()) {
            (Some([from, to]), Some(form), _) => {
                format!("{form} in its place is within both limits, with e from {from} to {to}")
            }
            (_, _, "t") => "start the ray off the surface instead".to_owned(),
            _ => "rounding decides those rays: it takes wider numbers or another kernel".to_owned(),
        };
        writeln!(out, "  {instead}")?;
    }
    Ok(())
}

fn legend(record: &SceneRecord, out: &mut dyn Write) -> io::Result<()> {
    let costs: Vec<String> =
        record.costs.iter().map(|(kind, cost)| format!("{kind} {cost}")).collect();
    writeln!(out)?;
    writeln!(out, "cost: each share times its weight ({}), added up", costs.join(", "))?;
    writeln!(
        out,
        "almost parallel: sines from 1/8 to an eighth of an ulp of 1, evenly by halvings"
    )?;
    let is_set = |limit: &LimitPart| limit.set_by.is_some();
    if record.kernels.iter().any(|part| part.limits.iter().any(is_set)) {
        writeln!(out, "* set by the scene's sizes, distances and angles as well as by rounding")?;
    }
    writeln!(out, "beside: within about one triangle's size; every share is of its own row")
}
