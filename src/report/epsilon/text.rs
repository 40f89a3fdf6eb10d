//! A study for people at a terminal.

use super::record::*;
use crate::arith::{Float, smallest_normal};
use crate::kernel::{self, Role};
use crate::report::rate::percent;
use crate::report::record::Rate;
use crate::report::{Style, group_digits, number_of};
use std::io::{self, Write};

/// Writes the limits and the prices of every gate.
pub fn write(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    for (i, part) in record.result.gates.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        heading(part, record.result.sources.len(), out)?;
        limits(part, out)?;
        if let Some(proved) = &part.proved {
            writeln!(out, "  proved {proved} (hairline prove --kernel {})", part.kernel)?;
        }
        prices(part, out)?;
    }
    Ok(())
}

fn heading(part: &GatePart, sources: usize, out: &mut dyn Write) -> io::Result<()> {
    let GatePart { kernel, scalar, gate, refuses, .. } = part;
    writeln!(out, "{kernel} {scalar}, gate {gate}: refuses where {refuses}")?;
    let others: Vec<String> =
        part.others.iter().map(|(gate, epsilon)| format!("{gate} = {epsilon}")).collect();
    if !others.is_empty() {
        writeln!(out, "  other gates: {}", others.join(", "))?;
    }
    writeln!(out, "  contract: {}", part.contract)?;
    let [must_hit, must_miss, groups, _, secondary, _] = part.curves[0].asked;
    let mut asked = format!(
        "  {}: {} hit, {} must miss",
        number_of(sources as u64, "source", "sources"),
        number_of(must_hit, "case must", "cases must"),
        group_digits(must_miss)
    );
    if groups != 0 {
        let groups = number_of(groups, "group expects", "groups expect");
        asked.push_str(&format!(", {groups} one hit"));
    }
    if secondary != 0 {
        let rays = number_of(secondary, "ray starts on its", "rays start on their");
        asked.push_str(&format!(", {rays} triangle"));
    }
    writeln!(out, "{asked}")?;
    let entry = kernel::find(kernel);
    let is_on_t = entry.is_some_and(|entry| {
        entry.info.gates.iter().any(|known| known.name == gate && known.role == Role::T)
    });
    if secondary != 0 && is_on_t {
        writeln!(
            out,
            "    where a ray starts on its triangle, every hit is one that this gate lets through; `all` is by the exact\n    \
             answer for the rounded start, which may lie on either side"
        )?;
    }
    Ok(())
}

/// The largest and smallest epsilons that repair all that can be repaired.
fn limits(part: &GatePart, out: &mut dyn Write) -> io::Result<()> {
    let TradePart { misses, hits, settled, refused_by_others, .. } = &part.trade;
    let least = |limit: &LimitPart, kind: &str| match (limit.of, limit.unavoidable) {
        (0, _) => format!("no case asks about {kind}"),
        (of, 0) => format!("none of {} {kind}", group_digits(of)),
        (of, n) => {
            let (n, of) = (group_digits(n), group_digits(of));
            format!("{n} of {of} {kind}, and no epsilon does better")
        }
    };
    let decided = |limit: &LimitPart, out: &mut dyn Write| match &limit.command {
        Some(command) => writeln!(out, "      decided by {command}"),
        None => Ok(()),
    };
    let flushed = |limit: &str, out: &mut dyn Write| match is_subnormal(&part.scalar, limit) {
        true => writeln!(out, "      {limit} is {FLUSHED}"),
        false => Ok(()),
    };
    let what = "possible false hits of the kinds that this gate is there to refuse";
    writeln!(
        out,
        "  seen on these cases, which are not yours (--scene recommends epsilons for a scene):"
    )?;
    if misses.command.is_none() {
        writeln!(out, "    every e: {}", least(misses, "possible false misses"))?;
    } else {
        writeln!(out, "    e <= {}: {}", misses.limit, least(misses, "possible false misses"))?;
        flushed(&misses.limit, out)?;
        decided(misses, out)?;
    }
    for (gate, count) in refused_by_others {
        writeln!(
            out,
            "      {} that gate {gate} refuses first, whatever e is",
            group_digits(*count)
        )?;
    }
    if hits.command.is_none() {
        writeln!(out, "    every e: {}", least(hits, what))?;
    } else {
        writeln!(out, "    e >= {}: {}", hits.limit, least(hits, what))?;
        flushed(&hits.limit, out)?;
        decided(hits, out)?;
    }
    match settled {
        _ if misses.of == 0 || hits.of == 0 => {
            let (side, limit) = if hits.of == 0 { ("lower", "hit") } else { ("upper", "miss") };
            writeln!(
                out,
                "    these cases set no {side} limit: none of them can show a false {limit}"
            )
        }
        Some([from, to]) if misses.command.is_none() && hits.command.is_none() => {
            writeln!(out, "    so this gate decides nothing here, at any e from {from} to {to}")
        }
        Some([from, to]) if misses.command.is_none() => {
            writeln!(out, "    from {from} up both counts are at their least")
        }
        Some([from, to]) => {
            writeln!(out, "    from {from} to {to} both counts are at their least")
        }
        None => writeln!(
            out,
            "    the two do not meet: between {} and {} every epsilon trades one for the other",
            misses.limit, hits.limit
        ),
    }
}

/// The remark on a subnormal epsilon.
pub(in crate::report) const FLUSHED: &str =
    "a subnormal number, which machines that flush to zero take for 0";

/// True if an epsilon is below the normal numbers of its scalar.
pub(in crate::report) fn is_subnormal(scalar: &str, epsilon: &str) -> bool {
    epsilon.parse().is_ok_and(|e: f64| e != 0.0 && e.abs() < least_normal(scalar))
}

/// The smallest normal number of the scalar of a name.
pub(in crate::report) fn least_normal(scalar: &str) -> f64 {
    if scalar == f32::NAME { smallest_normal::<f32>() } else { smallest_normal::<f64>() }
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
    let (gate, all) = ("this gate", "all false");
    let width = part.prices.iter().map(|price| price.epsilon.len()).max().unwrap_or(0).max(12);
    writeln!(out, "    {:width$} {gate:>24}{gate:>24}{all:>10}{all:>10}{columns}", "")?;
    let (loses, lets) = ("loses", "lets through");
    writeln!(out, "    {:width$} {loses:>24}{lets:>24}{:>10}{:>10}", "e", "misses", "hits")?;
    for price in &part.prices {
        let mark = if price.on_front { '*' } else { ' ' };
        write!(out, "  {mark} {:<width$} ", price.epsilon)?;
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

/// The price of one choice, in words.
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
        "" if price.lost.of == 0 => "no case must be hit".to_owned(),
        "" => "loses nothing".to_owned(),
        lost => format!("loses {lost}"),
    };
    text.push_str(&match admitted.as_str() {
        "" if price.let_through.of == 0 => "; no case is this gate's to refuse".to_owned(),
        "" => "; lets no false hit through".to_owned(),
        admitted => format!("; lets through {admitted}"),
    });
    if let Some(farthest) = &price.farthest {
        text.push_str(&match farthest.edges {
            0.0 => ", none farther than the boundary itself".to_owned(),
            edges => format!(
                ", the farthest off by {edges:.1e} of its longest edge ({:.1e} ulps)",
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
