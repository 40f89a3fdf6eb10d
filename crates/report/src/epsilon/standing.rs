//! May these numbers be used? The sentence that stands first: good, a trade, or no good; and the rows that argue for it.

use super::answer::holes_text;
use super::fitness::{fitness, is_fine};
use super::notes::{is_no_good, no_good};
use super::numbers::{cost_text, human, share};
use super::record::*;
use super::words::{of_kind, of_stratum};
use crate::page::Tone;
use hairline_record::Rate;

/// The share of a cost from which on what remains is said.
const TELLING: f64 = 0.005;

/// How good the best fixed numbers are, in a sentence or two.
pub(super) fn standing(record: &SceneResult, part: &SceneKernelPart) -> (Tone, String) {
    let flaws = no_good(record, part, &part.tried[0]);
    if !flaws.is_empty() {
        return (Tone::Bad, sentences(&flaws));
    }
    let trades: Vec<String> = (0..part.knobs.len())
        .filter_map(|knob| trade(part, knob))
        .collect();
    match (&trades[..], remains(record, part, &part.tried[0], None, 2)) {
        ([], None) => {
            let within = "Good: every number is within all of its limits.";
            (Tone::Good, format!("{within}{}", one_sided(part)))
        }
        ([], Some(rest)) => {
            let within = "Every number is within its limits, and none mends what is left";
            (Tone::Plain, format!("{within}: {rest}."))
        }
        (trades, None) => (Tone::Plain, format!("A trade: {}.", trades.join("; "))),
        (trades, Some(rest)) => (
            Tone::Plain,
            format!("A trade: {}. What is left: {rest}.", trades.join("; ")),
        ),
    }
}

/// More than the best cost by less than this share of it is as good, within ten times what is telling.
const AS_GOOD: f64 = 0.1;

/// So many given numbers are judged.
const MOST_GIVEN: usize = 3;

/// How good the numbers are that the kernel came with, or the user gave, a sentence each.
pub(super) fn of_given(record: &SceneResult, part: &SceneKernelPart) -> Option<String> {
    // The last ones are those of `--at`.
    let given: Vec<&TriedPart> = part.tried[1..]
        .iter()
        .filter(|tried| tried.name != "zero")
        .collect();
    let last = &given[given.len().saturating_sub(MOST_GIVEN)..];
    let sentences: Vec<String> = last
        .iter()
        .map(|tried| given_sentence(record, part, tried))
        .collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

fn given_sentence(record: &SceneResult, part: &SceneKernelPart, tried: &TriedPart) -> String {
    let judged = judged(record, part, tried);
    if tried.name == "source" {
        return format!("As published: {judged}.");
    }
    let numbers: Vec<String> = part
        .knobs
        .iter()
        .zip(&tried.epsilons)
        .map(|(knob, epsilon)| format!("{}={}", knob.name, human(epsilon)))
        .collect();
    format!("At {}: {judged}.", numbers.join(","))
}

/// How good tried numbers are beside the recommended ones: `no good (cost 3.150 against 0.141)`.
fn judged(record: &SceneResult, part: &SceneKernelPart, tried: &TriedPart) -> String {
    let best = &part.tried[0];
    let [own, least] = [tried, best].map(|it| cost_text(it.cost));
    let mut costs = format!("cost {own} against {least}");
    if let Some(holes) = holes_text(tried) {
        costs = format!("{costs}, {holes} holes in a million pixels");
    }
    let is_bad = is_no_good(record, part, tried);
    let is_best_bad = is_no_good(record, part, best);
    if (!is_bad || is_best_bad) && is_as_cheap(tried.cost, best.cost) {
        return format!("as good ({costs})");
    }
    let [own_rest, best_rest] = [tried, best].map(|it| cost_without_self_hits(record, part, it));
    if is_as_cheap(own_rest, best_rest) {
        return format!("as good once shadow rays start off the surface; else not ({costs})");
    }
    let word = if is_bad { "no good" } else { "worse" };
    match remains(record, part, tried, Some(best), 1) {
        Some(rest) => format!("{word} ({costs}): {rest}"),
        None => format!("{word} ({costs})"),
    }
}

fn is_as_cheap(cost: f64, best: f64) -> bool {
    cost - best <= (AS_GOOD * best).clamp(TELLING, 10.0 * TELLING)
}

/// The cost of all wrong answers but self-hits, which starts off the surface end too.
fn cost_without_self_hits(record: &SceneResult, part: &SceneKernelPart, tried: &TriedPart) -> f64 {
    let counts = part.counts.iter().zip(&tried.wrong);
    let others = counts.filter(|(count, _)| count.kind != WrongKind::SelfHit);
    others
        .map(|(count, rate)| record.cost(count.kind) * rate.rate.unwrap_or(0.0))
        .sum()
}

/// The knobs that some rays limit on one side and no rays on the other.
fn one_sided(part: &SceneKernelPart) -> String {
    let side = |(i, knob): (usize, &KnobPart)| {
        let mut lower = part
            .limits
            .iter()
            .filter(|limit| limit.knob == i)
            .map(|it| it.is_lower);
        let first = lower.next()?;
        let other = if first { "larger" } else { "smaller" };
        lower.all(|it| it == first).then(|| {
            format!(
                " No ray here argues against a {other} {}: other --family may.",
                knob.name
            )
        })
    };
    part.knobs.iter().enumerate().filter_map(side).collect()
}

/// Sentences from lines without their stops.
fn sentences(lines: &[String]) -> String {
    let sentence = |line: &String| {
        let mut letters = line.chars();
        let first = letters
            .next()
            .map(|c| c.to_uppercase().to_string())
            .unwrap_or_default();
        format!("{first}{}.", letters.as_str())
    };
    lines.iter().map(sentence).collect::<Vec<_>>().join(" ")
}

/// The limits that no value of a knob keeps at once, or a note that its value is outside them; none if all are kept.
fn trade(part: &SceneKernelPart, knob: usize) -> Option<String> {
    let name = &part.knobs[knob].name;
    let conflict = part
        .conflicts
        .iter()
        .find(|conflict| part.limits[conflict.lower].knob == knob);
    if let Some(ConflictPart { lower, upper, .. }) = conflict {
        let [lower, upper] = [lower, upper].map(|place| &part.limits[*place]);
        let noun = |limit: &KnobLimitPart| noun(&part.counts[limit.count]);
        return Some(match (&lower.value, &upper.value) {
            (None, _) => format!("every value of {name} leaves {}", noun(lower)),
            (_, None) => format!("every value of {name} leaves {}", noun(upper)),
            _ => format!(
                "every value of {name} leaves {} or {}",
                noun(lower),
                noun(upper)
            ),
        });
    }
    beyond_limits(part, knob).map(|epsilon| {
        format!("{name}={epsilon} is recommended although it is outside its limits: values within them cost more")
    })
}

/// The chosen value of a knob if it is outside its limits although some value is within.
fn beyond_limits(part: &SceneKernelPart, knob: usize) -> Option<&str> {
    let epsilon = &part.tried[0].epsilons[knob];
    let chosen: f64 = epsilon.parse().ok()?;
    let is_beyond = |limit: &KnobLimitPart| {
        // Past the far end of an unsure limit it is outside all the same.
        let end = if limit.is_unsure {
            &limit.far
        } else {
            &limit.value
        };
        let bound: Option<f64> = end.as_ref().and_then(|value| value.parse().ok());
        let is_wrong = |bound| {
            if limit.is_lower {
                chosen < bound
            } else {
                bound < chosen
            }
        };
        limit.knob == knob && bound.is_some_and(is_wrong)
    };
    part.limits.iter().any(is_beyond).then_some(epsilon)
}

/// The wrong answers that make most of the cost, or of what it is above the cost of others, so many of them, in words, if that
/// is worth a word.
fn remains(
    record: &SceneResult,
    part: &SceneKernelPart,
    tried: &TriedPart,
    beside: Option<&TriedPart>,
    most: usize,
) -> Option<String> {
    let of_count = |(place, (count, rate)): (usize, (&RayCount, &Rate))| {
        let share_of = |rate: &Rate| rate.rate.filter(|_| 0 < rate.count);
        let more = share_of(rate)?
            - beside
                .and_then(|it| share_of(&it.wrong[place]))
                .unwrap_or(0.0);
        Some((record.cost(count.kind) * more, phrase(count, &share(rate))))
    };
    let counts = part.counts.iter().zip(&tried.wrong).enumerate();
    let mut all: Vec<(f64, String)> = counts.filter_map(of_count).collect();
    all.retain(|(cost, _)| TELLING < *cost);
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.truncate(most);
    let words: Vec<String> = all.into_iter().map(|(_, words)| words).collect();
    (!words.is_empty()).then(|| words.join(", "))
}

/// The counts that argue for the recommended numbers: those whose cost differs most among what was tried; what is the
/// same with all of them comes last.
pub(super) fn telling(record: &SceneResult, part: &SceneKernelPart, most: usize) -> Vec<usize> {
    let extremes = |place: &usize| {
        let tried = part.tried.iter().chain(&part.relative);
        let shares = tried.map(|tried| tried.wrong[*place].rate.unwrap_or(0.0));
        shares.fold([f64::INFINITY, 0.0], |[low, high], share| {
            [share.min(low), share.max(high)]
        })
    };
    let told = |place: &usize| {
        let [low, high] = extremes(place);
        let cost = record.cost(part.counts[*place].kind);
        // Less than a tenth of the share is the same.
        if high < 1.1 * low {
            1e-6 * cost * high
        } else {
            cost * (high - low)
        }
    };
    let mut places: Vec<usize> = (0..part.counts.len())
        .filter(|place| 0.0 < told(place))
        .collect();
    places.sort_by(|a, b| told(b).total_cmp(&told(a)));
    places.truncate(most);
    places.sort_unstable();
    places
}

/// `lost hits inside triangles`.
fn noun(count: &RayCount) -> String {
    let what = of_kind(count.kind)[1];
    match count.rays {
        Rays::Stratum(stratum) => format!("{what} {}", of_stratum(stratum, count.kind)[1]),
        rays => format!("{what} of {}", rays.name()),
    }
}

/// `2.9% of the shadow rays hit their own start`.
fn phrase(count: &RayCount, share: &str) -> String {
    let [_, _, of, does] = match count.rays {
        Rays::Stratum(stratum) => of_stratum(stratum, count.kind),
        _ => of_kind(count.kind),
    };
    match count.rays {
        Rays::Stratum(_) => format!("{share} of the {of} {does}"),
        rays => format!("{share} of the {of} of {} {does}", rays.name()),
    }
}

/// A word on the scalar, if its numbers are too far apart for the scene.
pub(super) fn coarse(record: &SceneResult, part: &SceneKernelPart) -> Option<String> {
    (!is_fine(record, part)).then(|| fitness(record, part))
}
