//! A truth stored beside a case, and its comparison with the true one.

#![forbid(unsafe_code)]

use super::json;
use super::truth_json::{ContactLine, TruthLine, fraction_text};
use crate::truth::{Facing, Feature, Place};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use serde::Serialize;
use serde_json::value::RawValue;

/// The most characters of a fraction. On the whole range of `f64` t has fewer than 4,000.
const LONGEST_FRACTION: usize = 10_000;

const CLASSES: [&str; 5] = ["transversal", "parallel", "coplanar", "degenerate", "invalid"];
const CONTACT_KINDS: [&str; 3] = ["none", "point", "segment"];

/// A field of a stored truth: none if it is not stored, `Some(None)` if it is stored as null.
pub type Stored<T> = Option<Option<T>>;

/// The truth beside a case in a corpus file: the fields of [`TruthLine`], any of them. Fractions are
/// kept as [`TruthLine`] writes them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct StoredTruth {
    /// Never compared: the case has a name of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Stored<String>,
    /// See [`TruthLine::class`]; never null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub class: Stored<String>,
    /// See [`TruthLine::facing`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facing: Stored<String>,
    /// See [`TruthLine::t`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t: Stored<String>,
    /// See [`TruthLine::feature`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feature: Stored<String>,
    /// See [`TruthLine::contact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Stored<StoredContact>,
    /// See [`TruthLine::hits_closed`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hits_closed: Stored<bool>,
    /// See [`TruthLine::t_exact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_exact: Stored<String>,
    /// See [`TruthLine::u_exact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub u_exact: Stored<String>,
    /// See [`TruthLine::v_exact`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v_exact: Stored<String>,
}

/// The fields of [`ContactLine`], any of them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct StoredContact {
    /// See [`ContactLine::kind`]; never null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Stored<String>,
    /// See [`ContactLine::feature`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feature: Stored<String>,
    /// See [`ContactLine::t`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t: Stored<[String; 2]>,
}

impl StoredTruth {
    /// From its JSON. Unknown and duplicate fields, words that no truth has and what is no fraction
    /// are errors, which name the field.
    pub fn parse(text: &str) -> Result<StoredTruth, String> {
        let [name, class, facing, t, feature, contact, hits_closed, t_exact, u_exact, v_exact] =
            json::fields(
                text,
                [
                    "name",
                    "class",
                    "facing",
                    "t",
                    "feature",
                    "contact",
                    "hits_closed",
                    "t_exact",
                    "u_exact",
                    "v_exact",
                ],
            )?;
        Ok(StoredTruth {
            name: stored("name", name, json::string)?,
            class: never_null("class", word("class", class, &CLASSES)?)?,
            facing: word("facing", facing, &[Facing::Front, Facing::Back].map(Facing::name))?,
            t: word("t", t, &Place::ALL.map(Place::name))?,
            feature: word("feature", feature, &Feature::ALL.map(Feature::name))?,
            contact: stored("contact", contact, StoredContact::parse)?,
            hits_closed: stored("hits_closed", hits_closed, boolean)?,
            t_exact: stored("t_exact", t_exact, fraction)?,
            u_exact: stored("u_exact", u_exact, fraction)?,
            v_exact: stored("v_exact", v_exact, fraction)?,
        })
    }

    /// The stored fields, on one line.
    pub fn to_json(&self) -> String {
        // Strings and booleans under names that are strings: nothing that could fail.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Compares each stored field but the name with what the oracle says.
    pub fn check(&self, line: &TruthLine) -> Result<(), String> {
        same("class", &self.class, Some(line.class))?;
        same("facing", &self.facing, line.facing)?;
        same("t", &self.t, line.t)?;
        same("feature", &self.feature, line.feature)?;
        match (&self.contact, &line.contact) {
            (Some(Some(stored)), Some(contact)) => stored.check(contact)?,
            (stored, contact) => {
                let kind = |contact: &StoredContact| match &contact.kind {
                    Some(Some(kind)) => kind.clone(),
                    _ => "some".to_owned(),
                };
                let stored = stored.as_ref().map(|stored| stored.as_ref().map(kind));
                same("contact", &stored, contact.as_ref().map(|contact| contact.kind))?;
            }
        }
        let hits_closed = self.hits_closed.map(|hits| hits.map(|hits| hits.to_string()));
        same("hits_closed", &hits_closed, line.hits_closed.map(boolean_name))?;
        let text = |field: &Stored<String>| field.clone().flatten();
        same("t_exact", &self.t_exact, text(&line.t_exact).as_deref())?;
        same("u_exact", &self.u_exact, text(&line.u_exact).as_deref())?;
        same("v_exact", &self.v_exact, text(&line.v_exact).as_deref())
    }

    /// Whether a fraction is stored, or null for one.
    pub fn has_fractions(&self) -> bool {
        let of_contact = self.contact.iter().flatten().any(|contact| contact.t.is_some());
        of_contact || [&self.t_exact, &self.u_exact, &self.v_exact].into_iter().any(Option::is_some)
    }
}

impl From<&TruthLine> for StoredTruth {
    /// All fields but the name.
    fn from(line: &TruthLine) -> StoredTruth {
        let word = |word: Option<&str>| Some(word.map(str::to_owned));
        StoredTruth {
            name: None,
            class: word(Some(line.class)),
            facing: word(line.facing),
            t: word(line.t),
            feature: word(line.feature),
            contact: Some(line.contact.as_ref().map(|contact| StoredContact {
                kind: word(Some(contact.kind)),
                feature: word(contact.feature),
                t: contact.t.clone(),
            })),
            hits_closed: Some(line.hits_closed),
            t_exact: line.t_exact.clone(),
            u_exact: line.u_exact.clone(),
            v_exact: line.v_exact.clone(),
        }
    }
}

impl StoredContact {
    fn parse(value: &RawValue) -> Result<StoredContact, String> {
        let [kind, feature, t] = json::fields(value.get(), ["kind", "feature", "t"])?;
        Ok(StoredContact {
            kind: never_null("kind", word("kind", kind, &CONTACT_KINDS)?)?,
            feature: word("feature", feature, &Feature::ALL.map(Feature::name))?,
            t: stored("t", t, |ends| {
                let [first, last] = json::array(ends, "fractions")?;
                Ok([fraction(first)?, fraction(last)?])
            })?,
        })
    }

    fn check(&self, contact: &ContactLine) -> Result<(), String> {
        let ends = |t: &[String; 2]| format!("[{}, {}]", t[0], t[1]);
        same("contact.kind", &self.kind, Some(contact.kind))?;
        same("contact.feature", &self.feature, contact.feature)?;
        let t = self.t.as_ref().map(|t| t.as_ref().map(ends));
        same("contact.t", &t, contact.t.as_ref().and_then(Option::as_ref).map(ends).as_deref())
    }
}

/// Whether a field, where it is stored, is what the oracle found.
fn same(field: &str, stored: &Stored<String>, found: Option<&str>) -> Result<(), String> {
    let show = |word: Option<&str>| word.map_or("null".to_owned(), |word| format!("'{word}'"));
    match stored {
        Some(stored) if stored.as_deref() != found => {
            let (stored, found) = (show(stored.as_deref()), show(found));
            Err(format!("stored truth is wrong: {field} is {stored}, the oracle says {found}"))
        }
        _ => Ok(()),
    }
}

fn stored<'a, T>(
    field: &str,
    value: Option<&'a RawValue>,
    read: impl Fn(&'a RawValue) -> Result<T, String>,
) -> Result<Stored<T>, String> {
    let value = value.map(|value| match value.get() {
        "null" => Ok(None),
        _ => read(value).map(Some).map_err(|message| format!("{field}: {message}")),
    });
    value.transpose()
}

fn word(field: &str, value: Option<&RawValue>, known: &[&str]) -> Result<Stored<String>, String> {
    stored(field, value, |value| {
        let text = json::string(value)?;
        if known.contains(&text.as_str()) {
            return Ok(text);
        }
        Err(format!("{} is none of {}", json::quoted(&text), known.join(", ")))
    })
}

fn never_null<T>(field: &str, stored: Stored<T>) -> Result<Stored<T>, String> {
    match stored {
        Some(None) => Err(format!("{field}: cannot be null")),
        stored => Ok(stored),
    }
}

fn boolean(value: &RawValue) -> Result<bool, String> {
    match value.get() {
        "true" => Ok(true),
        "false" => Ok(false),
        other => Err(format!("expected true, false or null, found {}", json::excerpt(other))),
    }
}

fn boolean_name(value: bool) -> &'static str {
    if value { "true" } else { "false" }
}

/// `p/q` or an integer, in a string; reduced.
fn fraction(value: &RawValue) -> Result<String, String> {
    let text = json::string(value)?;
    match parse_fraction(&text) {
        Some(fraction) => Ok(fraction_text(&fraction)),
        None => Err(format!("{} is not a fraction p/q with q > 0", json::quoted(&text))),
    }
}

fn parse_fraction(text: &str) -> Option<BigRational> {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let plain = digits(numerator.strip_prefix('-').unwrap_or(numerator)) && digits(denominator);
    if !plain || text.len() > LONGEST_FRACTION {
        return None;
    }
    let denominator: BigInt = denominator.parse().ok()?;
    let numerator: BigInt = numerator.parse().ok()?;
    (!denominator.is_zero()).then(|| BigRational::new(numerator, denominator))
}

#[cfg(test)]
mod tests {
    use super::super::truth_json::tests::{contact, transversal};
    use super::*;
    use crate::truth::ContactKind;

    #[test]
    fn a_stored_truth_is_the_printed_one_or_part_of_it() {
        for line in [transversal(), contact(ContactKind::Segment), contact(ContactKind::None)] {
            let printed = serde_json::to_string(&line).unwrap();
            let stored = StoredTruth::parse(&printed).unwrap();
            assert_eq!(stored.check(&line), Ok(()));
            assert_eq!(StoredTruth { name: None, ..stored.clone() }, StoredTruth::from(&line));
            assert_eq!(serde_json::to_string(&stored).unwrap(), printed);
        }
        for part in ["{}", r#"{"name":"other"}"#, r#"{"v_exact":"3","t_exact":"-15/10"}"#] {
            assert_eq!(StoredTruth::parse(part).unwrap().check(&transversal()), Ok(()), "{part}");
        }
        let part = StoredTruth::parse(r#"{"contact":{"t":["2/6","4"]}}"#).unwrap();
        assert_eq!(part.check(&contact(ContactKind::Segment)), Ok(()));
    }

    #[test]
    fn a_wrong_truth_is_named_with_the_right_one() {
        let segment = contact(ContactKind::Segment);
        let point = contact(ContactKind::Point(Feature::EdgeAb));
        for (stored, line, is, says) in [
            (r#"{"class":"parallel"}"#, transversal(), "class is 'parallel'", "'transversal'"),
            (r#"{"facing":"back"}"#, transversal(), "facing is 'back'", "'front'"),
            (r#"{"t":"at_min"}"#, transversal(), "t is 'at_min'", "'within'"),
            (r#"{"feature":"edge_ab"}"#, transversal(), "feature is 'edge_ab'", "'vertex_a'"),
            (r#"{"feature":null}"#, transversal(), "feature is null", "'vertex_a'"),
            (r#"{"feature":"interior"}"#, point.clone(), "feature is 'interior'", "null"),
            (r#"{"contact":{}}"#, transversal(), "contact is 'some'", "null"),
            (r#"{"contact":{"kind":"none"}}"#, transversal(), "contact is 'none'", "null"),
            (r#"{"contact":null}"#, segment.clone(), "contact is null", "'segment'"),
            (
                r#"{"contact":{"kind":"none"}}"#,
                segment.clone(),
                "contact.kind is 'none'",
                "'segment'",
            ),
            (
                r#"{"contact":{"feature":"vertex_a"}}"#,
                point.clone(),
                "contact.feature is 'vertex_a'",
                "'edge_ab'",
            ),
            (
                r#"{"contact":{"t":["1/3","5"]}}"#,
                point,
                "contact.t is '[1/3, 5/1]'",
                "'[1/3, 4/1]'",
            ),
            (r#"{"contact":{"t":null}}"#, segment, "contact.t is null", "'[1/3, 4/1]'"),
            (r#"{"hits_closed":false}"#, transversal(), "hits_closed is 'false'", "'true'"),
            (r#"{"t_exact":"3/2"}"#, transversal(), "t_exact is '3/2'", "'-3/2'"),
            (r#"{"u_exact":"1"}"#, transversal(), "u_exact is '1/1'", "'0/1'"),
            (r#"{"v_exact":null}"#, transversal(), "v_exact is null", "'3/1'"),
        ] {
            let message = format!("stored truth is wrong: {is}, the oracle says {says}");
            assert_eq!(StoredTruth::parse(stored).unwrap().check(&line), Err(message));
        }
    }

    #[test]
    fn what_no_truth_has_is_refused() {
        for (text, message) in [
            ("[]", "expected an object, found []"),
            (r#"{"class":null}"#, "class: cannot be null"),
            (r#"{"class":"hit"}"#, "class: 'hit' is none of transversal, parallel, "),
            (r#"{"t":"inside"}"#, "t: 'inside' is none of before, at_min, within, at_max, beyond"),
            (r#"{"facing":3}"#, "facing: expected a string, found 3"),
            (r#"{"feature":"edge"}"#, "feature: 'edge' is none of interior, edge_ab, "),
            (r#"{"t_exact":3}"#, "t_exact: expected a string, found 3"),
            (r#"{"u_exact":"1/0"}"#, "u_exact: '1/0' is not a fraction p/q with q > 0"),
            (r#"{"u_exact":"1/-2"}"#, "u_exact: '1/-2' is not a fraction"),
            (r#"{"u_exact":"+1/2"}"#, "u_exact: '+1/2' is not a fraction"),
            (r#"{"u_exact":"0.5"}"#, "u_exact: '0.5' is not a fraction"),
            (r#"{"u_exact":"1_0"}"#, "u_exact: '1_0' is not a fraction"),
            (r#"{"hits_closed":1}"#, "hits_closed: expected true, false or null, found 1"),
            (r#"{"contact":"none"}"#, "contact: expected an object, found \"none\""),
            (r#"{"contact":{"kind":"line"}}"#, "contact: kind: 'line' is none of none, point, "),
            (r#"{"contact":{"t":["1"]}}"#, "contact: t: expected 2 fractions, found 1"),
            (
                r#"{"contact":{"t":"1"}}"#,
                "contact: t: expected an array of 2 fractions, found \"1\"",
            ),
            (
                r#"{"contact":{"u":1}}"#,
                "contact: unknown field 'u', expected one of kind, feature, t",
            ),
            (r#"{"hit":true}"#, "unknown field 'hit', expected one of name, class, facing, t, "),
            (r#"{"t":null,"t":null}"#, "duplicate field 't'"),
        ] {
            let error = StoredTruth::parse(text).unwrap_err();
            assert!(error.starts_with(message), "{text}: {error}");
        }
        let long = format!(r#"{{"u_exact":"{}"}}"#, "1".repeat(LONGEST_FRACTION + 1));
        assert!(StoredTruth::parse(&long).is_err());
    }
}
