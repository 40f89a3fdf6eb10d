//! The record as SARIF 2.1.0, for forges that show code scanning: one result a class of disagreement.

use hairline_record::{
    Conformance, Deviation, FindingKind, Key, Rate, Record, Unproved, disagreements, group_digits,
};

use crate::format::{Style, write_json};
use serde_json::{Value, json};
use std::io::{self, Write};

/// A forge keeps this many results of a run, and rejects a file with five times as many.
const MOST_RESULTS: usize = 5_000;

/// The rule of expectations that no longer come true.
const STALE: &str = "stale-expectation";

/// The rule of kernels whose second answer to a case is another.
const UNSTEADY: &str = "unsteady";

/// Where the format is defined.
const SCHEMA: &str =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

/// Writes the record.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let mut results = match &record.conformance {
        Some(conformance) => of_check(conformance),
        None => of_audit(record),
    };
    let left_out = results.len().saturating_sub(MOST_RESULTS);
    results.truncate(MOST_RESULTS);
    let mut invocation = json!({ "executionSuccessful": true });
    if 0 < left_out {
        let text = format!(
            "{} of {} classes of disagreement are left out here; the JSON record has them all",
            group_digits(left_out as u64),
            group_digits((left_out + MOST_RESULTS) as u64)
        );
        invocation["toolExecutionNotifications"] =
            json!([{ "level": "warning", "message": { "text": text } }]);
    }
    let version = record.provenance.tool.trim_start_matches("hairline ");
    let properties = json!({ "plan": record.result.plan.hash, "leftOut": left_out });
    write_log(version, invocation, results, properties, out)
}

/// Writes that a run ended without a record: no results, and a notification of the tool.
pub(super) fn write_failure(code: u8, message: &str, out: &mut dyn Write) -> io::Result<()> {
    let invocation = json!({
        "executionSuccessful": false,
        "exitCode": code,
        "toolExecutionNotifications": [{ "level": "error", "message": { "text": message } }],
    });
    write_log(
        env!("CARGO_PKG_VERSION"),
        invocation,
        Vec::new(),
        json!({}),
        out,
    )
}

fn write_log(
    version: &str,
    invocation: Value,
    results: Vec<Value>,
    properties: Value,
    out: &mut dyn Write,
) -> io::Result<()> {
    let log = json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "hairline", "version": version, "rules": rules() } },
            "invocations": [invocation],
            "results": results,
            "properties": properties,
        }],
    });
    write_json(&log, out)
}

/// The rules, whose order and names are stable: new ones go to the end.
fn rules() -> Vec<Value> {
    let stale = (STALE, "What was expected to be wrong is less so, or right");
    let unsteady = (UNSTEADY, "Answers differ from run to run");
    let rule = |kind: &FindingKind| (kind.name(), kind.about());
    let others = [stale, rule(&FindingKind::Unproved), unsteady];
    let all = FindingKind::FOUND.iter().map(rule).chain(others);
    all.map(|(id, text)| json!({ "id": id, "shortDescription": { "text": text } }))
        .collect()
}

/// The results of a check: new findings come first, and known ones are suppressed.
fn of_check(conformance: &Conformance) -> Vec<Value> {
    let file = conformance.expectations.as_deref();
    let unproved = conformance.unproved.iter().map(|unproved| {
        let text = format!("{unproved}\n{}", unproved.command);
        let rule = FindingKind::Unproved.name();
        let (row, gate) = (unproved.row(), &unproved.gate);
        let (scalar, family) = (unproved.scalar, Unproved::FAMILY);
        let fingerprint = format!("{row} {scalar} {family}: {rule} of {gate}");
        let place = format!("{row}/{scalar}/{family}");
        let rate = Rate::default();
        result(rule, "error", &text, &place, gate, &fingerprint, &rate)
    });
    let unexpected = conformance
        .unexpected
        .iter()
        .map(|found| deviation(found, found.finding.name(), "error", file));
    let named = |list: &[Deviation], rule| -> Vec<Value> {
        list.iter()
            .map(|found| deviation(found, rule, "error", file))
            .collect()
    };
    let unsteady = named(&conformance.unsteady, UNSTEADY);
    let stale = named(&conformance.stale, STALE);
    let known = conformance.known.iter().map(|found| {
        let mut result = deviation(found, found.finding.name(), "note", file);
        let why = found.why.as_deref().unwrap_or("a known disagreement");
        result["suppressions"] = json!([{ "kind": "external", "justification": why }]);
        result
    });
    unproved
        .chain(unsteady)
        .chain(unexpected)
        .chain(stale)
        .chain(known)
        .collect()
}

fn deviation(found: &Deviation, rule: &str, level: &str, file: Option<&str>) -> Value {
    let mut text = found.describe();
    for line in [&found.why, &found.command, &found.bits]
        .into_iter()
        .flatten()
    {
        text.push_str(&format!("\n{line}"));
    }
    let mut result = of_key(&found.key(), rule, level, &text, &found.found);
    if let Some(file) = file {
        result["locations"][0]["physicalLocation"] = json!({
            "artifactLocation": { "uri": uri(file) },
            "region": { "startLine": found.line.unwrap_or(1) },
        });
    }
    result
}

fn of_audit(record: &Record) -> Vec<Value> {
    let all = disagreements(&record.result);
    let of_found = all.iter().map(|found| {
        let (count, of) = (group_digits(found.rate.count), group_digits(found.rate.of));
        let mut text = format!("{}: {count} of {of}", found.key);
        if let Some(example) = &found.example {
            text.push_str(&format!("\n{}\n{}", example.command, example.bits));
        }
        of_key(
            &found.key,
            found.key.finding.name(),
            "warning",
            &text,
            found.rate,
        )
    });
    of_found.collect()
}

/// The result on a class of disagreement.
fn of_key(key: &Key, rule: &str, level: &str, text: &str, rate: &Rate) -> Value {
    let place = format!("{}/{}/{}", key.row(), key.scalar, key.family);
    let (class, fingerprint) = (key.class.name(), key.to_string());
    result(rule, level, text, &place, class, &fingerprint, rate)
}

fn result(
    rule: &str,
    level: &str,
    text: &str,
    place: &str,
    class: &str,
    fingerprint: &str,
    rate: &Rate,
) -> Value {
    json!({
        "ruleId": rule,
        "level": level,
        "message": { "text": text },
        "locations": [{
            "logicalLocations": [{ "fullyQualifiedName": place, "kind": "function" }],
        }],
        "partialFingerprints": { "disagreement/v1": fingerprint },
        "properties": { "class": class, "count": rate.count, "of": rate.of },
    })
}

/// A path as a relative URI.
fn uri(path: &str) -> String {
    let mut uri = String::new();
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte));
            }
            b'\\' => uri.push('/'),
            other => uri.push_str(&format!("%{other:02X}")),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_becomes_a_uri() {
        assert_eq!(uri("a b/ü.toml"), "a%20b/%C3%BC.toml");
    }
}
