//! A study for people at a terminal.

use super::record::*;
use crate::report::record::Rate;
use crate::report::text::percent;
use crate::report::{Style, group_digits};
use std::io::{self, Write};

/// Writes the limits, the prices and the scaling of every gate.
pub fn write(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    for (i, part) in record.result.gates.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        heading(part, record.result.sources.len(), out)?;
        limits(part, out)?;
        prices(part, out)?;
        if let Some(scaling) = &part.scaling {
            write_scaling(part, scaling, out)?;
        }
    }
    for map in &record.result.maps {
        writeln!(out)?;
        write_map(map, out)?;
    }
    Ok(())
}

fn heading(part: &GatePart, sources: usize, out: &mut dyn Write) -> io::Result<()> {
    let GatePart { kernel, scalar, gate, refuses, form, .. } = part;
    writeln!(out, "{kernel} {scalar}, gate {gate}: refuses where {refuses}")?;
    if form != "e" {
        writeln!(out, "  with {form} in place of e")?;
    }
    let others: Vec<String> =
        part.others.iter().map(|(gate, epsilon)| format!("{gate} = {epsilon}")).collect();
    if !others.is_empty() {
        writeln!(out, "  other gates: {}", others.join(", "))?;
    }
    writeln!(out, "  contract: {}", part.contract)?;
    let [must_hit, must_miss, groups, _, respawned, _] = part.curves[0].asked.map(group_digits);
    let mut asked =
        format!("  {sources} sources: {must_hit} cases must hit, {must_miss} must miss");
    if groups != "0" {
        asked.push_str(&format!(", {groups} groups are owed one hit"));
    }
    if respawned != "0" {
        asked.push_str(&format!(", {respawned} rays start on their triangle"));
    }
    writeln!(out, "{asked}")
}

/// The largest and smallest epsilons that repair all that can be repaired.
fn limits(part: &GatePart, out: &mut dyn Write) -> io::Result<()> {
    let TradePart { misses, hits, settled, refused_by_others, .. } = &part.trade;
    let e = &part.form;
    let least = |limit: &LimitPart, kind: &str| match (limit.of, limit.unavoidable) {
        (0, _) => format!("no case asks about {kind}"),
        (_, 0) => format!("no {kind}"),
        (of, n) => {
            let (n, of) = (group_digits(n), group_digits(of));
            format!("the fewest {kind} that any epsilon reaches, {n} of {of}")
        }
    };
    let decided = |limit: &LimitPart, out: &mut dyn Write| match &limit.command {
        Some(command) => writeln!(out, "      decided by {command}"),
        None => Ok(()),
    };
    let what = "false hits of the kinds that this gate is there to refuse";
    writeln!(out, "  right epsilons:")?;
    if misses.command.is_none() {
        writeln!(out, "    every e: {}", least(misses, "false misses"))?;
    } else {
        writeln!(out, "    {e} <= {}: {}", misses.limit, least(misses, "false misses"))?;
        decided(misses, out)?;
    }
    for (gate, count) in refused_by_others {
        writeln!(out, "      {} that gate {gate} refuses, whatever e is", group_digits(*count))?;
    }
    if hits.command.is_none() {
        writeln!(out, "    every e: {}", least(hits, what))?;
    } else {
        writeln!(out, "    {e} >= {}: {}", hits.limit, least(hits, what))?;
        decided(hits, out)?;
    }
    match settled {
        Some([from, to]) if misses.command.is_none() && hits.command.is_none() => {
            writeln!(out, "    so this gate decides nothing here: any e will do ({from} to {to})")
        }
        Some([from, to]) if misses.command.is_none() => {
            writeln!(out, "    so use any e from {from} (to {to}): both counts are at their least")
        }
        Some([from, to]) => {
            writeln!(out, "    so use an e from {from} to {to}: both counts are at their least")
        }
        None => writeln!(
            out,
            "    the two do not meet: between {} and {} every epsilon trades one for the other",
            misses.limit, hits.limit
        ),
    }
}

fn prices(part: &GatePart, out: &mut dyn Write) -> io::Result<()> {
    if part.prices.is_empty() {
        return Ok(());
    }
    let groups = part.prices.iter().any(|price| price.cracks.of > 0);
    let columns = if groups { "   cracks  doubles" } else { "" };
    writeln!(
        out,
        "  what an epsilon costs (the kernel was run with it; * marks the best trades):"
    )?;
    writeln!(
        out,
        "    {:<14}{:>24}{:>24}{:>10}{:>10}{columns}",
        "", "this gate", "this gate", "all false", "all false"
    )?;
    writeln!(
        out,
        "    {:<14}{:>24}{:>24}{:>10}{:>10}",
        part.form.chars().next().unwrap_or('e'),
        "loses",
        "lets through",
        "misses",
        "hits"
    )?;
    for price in &part.prices {
        let mark = if price.on_front { '*' } else { ' ' };
        write!(out, "  {mark} {:<14}", price.epsilon)?;
        write!(out, "{:>24}{:>24}", share(&price.lost), share(&price.let_through))?;
        write!(out, "{:>10}{:>10}", short(&price.false_misses), short(&price.false_hits))?;
        if groups {
            write!(out, "{:>9}{:>9}", short(&price.cracks), short(&price.doubles))?;
        }
        let names = price.names.join(", ");
        writeln!(out, "{}{names}", if names.is_empty() { "" } else { "  " })?;
    }
    let mut last = None;
    for price in part.prices.iter().filter(|price| price.on_front || !price.names.is_empty()) {
        let counts = (price.lost.count, price.let_through.count);
        if last.replace(counts) != Some(counts) {
            writeln!(out, "  e = {}: {}", price.epsilon, sentence(price))?;
        }
    }
    Ok(())
}

/// What one choice costs, in words.
fn sentence(price: &PricePart) -> String {
    let worst = |pick: fn(&FamilyPrice) -> &Rate| {
        let mut families: Vec<&FamilyPrice> =
            price.families.iter().filter(|family| pick(family).count > 0).collect();
        let share = |family: &FamilyPrice| pick(family).rate.unwrap_or(0.0);
        families.sort_by(|a, b| share(b).total_cmp(&share(a)));
        let named = families
            .iter()
            .take(3)
            .map(|family| format!("{} of {}", percent(share(family)), family.family));
        named.collect::<Vec<_>>().join(", ")
    };
    let lost = worst(|family| &family.lost);
    let admitted = worst(|family| &family.let_through);
    let mut text = match lost.as_str() {
        "" => "loses nothing".to_owned(),
        lost => format!("loses {lost}"),
    };
    text.push_str(&match admitted.as_str() {
        "" => "; lets no false hit through".to_owned(),
        admitted => format!("; lets through {admitted}"),
    });
    if let Some(farthest) = &price.farthest {
        text.push_str(&match farthest.edges {
            0.0 => ", none farther than the boundary itself".to_owned(),
            edges => format!(
                ", the farthest {edges:.1e} of its longest edge outside ({:.1e} ulps)",
                farthest.ulps
            ),
        });
    }
    text
}

fn share(rate: &Rate) -> String {
    match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(share), None) => percent(share),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", percent(share), percent(low), percent(high))
        }
    }
}

fn short(rate: &Rate) -> String {
    rate.rate.map_or("-".to_owned(), percent)
}

fn write_scaling(part: &GatePart, scaling: &ScalingPart, out: &mut dyn Write) -> io::Result<()> {
    let [length, direction] = part.dimension;
    writeln!(
        out,
        "  when everything is scaled (the margin has dimension length^{length}·|d|^{direction}, so limits should move by scale^{length}):"
    )?;
    let slope = |slope: Option<f64>| slope.map_or("-".to_owned(), |slope| format!("{slope:.2}"));
    let relative = scaling.form.as_deref().filter(|_| !scaling.relative.rows.is_empty());
    let second = relative.map_or(String::new(), |form| format!("    with {form}"));
    writeln!(out, "    {:<8}{:>18}{:>18}{second}", "scale", "no miss up to", "no hit from")?;
    for (i, (scale, misses, hits)) in scaling.absolute.rows.iter().enumerate() {
        write!(out, "    {scale:<8}{misses:>18}{hits:>18}")?;
        match relative.and(scaling.relative.rows.get(i)) {
            Some((_, misses, hits)) => writeln!(out, "    {misses:>16}{hits:>16}")?,
            None => writeln!(out)?,
        }
    }
    let (misses, hits) = (slope(scaling.misses), slope(scaling.hits));
    writeln!(out, "    measured powers: {misses} and {hits}; predicted: {}", scaling.predicted)?;
    let absolute = match &scaling.absolute.common {
        Some([from, to]) => format!("an absolute e from {from} to {to} is right at all of them"),
        None => "no absolute e is right at all of them".to_owned(),
    };
    writeln!(out, "    {absolute}")?;
    let Some(form) = relative else { return Ok(()) };
    let common = match &scaling.relative.common {
        Some([from, to]) => format!("e from {from} to {to} is right at all of them"),
        None => "no e is right at all of them either, for it trades at each".to_owned(),
    };
    let unit = match scaling.unit.as_str() {
        "" => String::new(),
        unit => format!(", with {unit}"),
    };
    writeln!(out, "    scale-free form: {form}{unit}: {common}")
}

fn write_map(map: &MapPart, out: &mut dyn Write) -> io::Result<()> {
    let [first, second] = &map.gates;
    writeln!(out, "{} {}: {first} (down) against {second} (across)", map.kernel, map.scalar)?;
    let tables = [
        ("false misses", &map.false_misses, map.must_hit),
        ("false hits", &map.false_hits, map.must_miss),
    ];
    for (kind, table, of) in tables {
        writeln!(out, "  {kind} of {}", group_digits(of))?;
        write!(out, "    {:>14}", "")?;
        for epsilon in &map.epsilons[1] {
            write!(out, " {epsilon:>13}")?;
        }
        writeln!(out)?;
        for (epsilon, row) in map.epsilons[0].iter().zip(table) {
            write!(out, "    {epsilon:>14}")?;
            for count in row {
                write!(out, " {:>13}", group_digits(*count))?;
            }
            writeln!(out)?;
        }
    }
    Ok(())
}
