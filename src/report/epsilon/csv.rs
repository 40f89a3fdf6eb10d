//! The advice, one line a number: what a spreadsheet reads.

use super::record::*;
use crate::report::Style;
use crate::report::record::Rate;
use std::io::{self, Write};

/// Writes the epsilons that were tried, their shares of wrong answers, and the limits.
pub fn write(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "kernel,scalar,line,name,knob,value,stratum,kind,one_in,wrong,of,low,high,far")?;
    for part in &record.kernels {
        let mut line = |what: &str, name: &str, knob: &str, value: &str, rest: [String; 3]| {
            let [count, rate, far] = rest;
            writeln!(
                out,
                "{},{},{what},{},{knob},{value},{count},{rate},{far}",
                part.kernel,
                part.scalar,
                quoted(name)
            )
        };
        let count = |place: usize, one_in: Option<u64>| {
            let Count { rays, kind } = &part.counts[place];
            let one_in = one_in.map_or(String::new(), |n| n.to_string());
            format!("{},{kind},{one_in}", rays.name())
        };
        for tried in &part.tried {
            for (knob, value) in part.knobs.iter().zip(&tried.epsilons) {
                line(
                    "epsilon",
                    &tried.name,
                    &knob.name,
                    value,
                    [",,".into(), ",,,".into(), String::new()],
                )?;
            }
        }
        for tried in &part.tried {
            for (place, rate) in tried.wrong.iter().enumerate() {
                line(
                    "share",
                    &tried.name,
                    "",
                    "",
                    [count(place, None), fields(Some(rate)), String::new()],
                )?;
            }
        }
        let side = |is_lower: bool| if is_lower { "at-least" } else { "at-most" };
        for limit in &part.limits {
            let knob = &part.knobs[limit.knob].name;
            let value = limit.value.as_deref().unwrap_or("");
            let (count, fresh) = (count(limit.count, Some(limit.one_in)), &limit.fresh);
            let rest = [count, fields(fresh.as_ref()), limit.far.clone().unwrap_or_default()];
            let what = if limit.is_unsure { "unsure" } else { "limit" };
            line(what, side(limit.is_lower), knob, value, rest)?;
        }
        for proved in &part.proved {
            let knob = &part.knobs[proved.knob].name;
            let rest = [count(proved.count, None), fields(Some(&proved.fresh)), String::new()];
            line("proved", side(proved.is_lower), knob, &proved.value, rest)?;
        }
    }
    Ok(())
}

/// Wrong answers, of how many, and the 95 % interval.
fn fields(rate: Option<&Rate>) -> String {
    let Some(rate) = rate else { return ",,,".to_owned() };
    let [low, high] =
        rate.interval.map_or(Default::default(), |ends| ends.map(|end| end.to_string()));
    format!("{},{},{low},{high}", rate.count, rate.of)
}

/// A field as RFC 4180 has it: quoted where it holds a comma, a quote or a line break.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
