//! Tests of truths in files.

use super::super::truth_json::tests::{contact, transversal};
use super::*;
use crate::truth::ContactKind;

#[test]
fn a_stored_truth_is_the_printed_one_or_part_of_it() {
    for line in [
        transversal(),
        contact(ContactKind::Segment),
        contact(ContactKind::None),
    ] {
        let printed = serde_json::to_string(&line).unwrap();
        let stored = StoredTruth::parse(&printed).unwrap();
        assert_eq!(stored.check(&line), Ok(()));
        assert_eq!(stored.to_json(), printed);
        assert_eq!(stored.0[0].0, "name");
        assert_eq!(stored.0[1..], StoredTruth::from(&line).0);
    }
    for part in [
        "{}",
        r#"{"name":"other"}"#,
        r#"{"v_exact":"3","t_exact":"-15/10"}"#,
    ] {
        assert_eq!(
            StoredTruth::parse(part).unwrap().check(&transversal()),
            Ok(()),
            "{part}"
        );
    }
    let part = StoredTruth::parse(r#"{"contact":{"t":["2/6","4"]}}"#).unwrap();
    assert_eq!(part.check(&contact(ContactKind::Segment)), Ok(()));
}

#[test]
fn a_wrong_truth_is_named_with_the_right_one() {
    let segment = contact(ContactKind::Segment);
    let point = contact(ContactKind::Point(Feature::EdgeAb));
    for (stored, line, is, says) in [
        (
            r#"{"class":"parallel"}"#,
            transversal(),
            "class is 'parallel'",
            "'transversal'",
        ),
        (
            r#"{"facing":"back"}"#,
            transversal(),
            "facing is 'back'",
            "'front'",
        ),
        (
            r#"{"t":"at_min"}"#,
            transversal(),
            "t is 'at_min'",
            "'within'",
        ),
        (
            r#"{"feature":"edge_ab"}"#,
            transversal(),
            "feature is 'edge_ab'",
            "'vertex_a'",
        ),
        (
            r#"{"feature":null}"#,
            transversal(),
            "feature is null",
            "'vertex_a'",
        ),
        (
            r#"{"feature":"interior"}"#,
            point.clone(),
            "feature is 'interior'",
            "null",
        ),
        (
            r#"{"contact":{}}"#,
            transversal(),
            "contact is 'some'",
            "null",
        ),
        (
            r#"{"contact":{"kind":"none"}}"#,
            transversal(),
            "contact is 'none'",
            "null",
        ),
        (
            r#"{"contact":null}"#,
            segment.clone(),
            "contact is null",
            "'segment'",
        ),
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
        (
            r#"{"contact":{"t":null}}"#,
            segment,
            "contact.t is null",
            "'[1/3, 4/1]'",
        ),
        (
            r#"{"hits_closed":false}"#,
            transversal(),
            "hits_closed is 'false'",
            "'true'",
        ),
        (
            r#"{"t_exact":"3/2"}"#,
            transversal(),
            "t_exact is '3/2'",
            "'-3/2'",
        ),
        (
            r#"{"u_exact":"1"}"#,
            transversal(),
            "u_exact is '1/1'",
            "'0/1'",
        ),
        (
            r#"{"v_exact":null}"#,
            transversal(),
            "v_exact is null",
            "'3/1'",
        ),
    ] {
        let message = format!("stored truth is wrong: {is}, the oracle says {says}");
        assert_eq!(
            StoredTruth::parse(stored).unwrap().check(&line),
            Err(message)
        );
    }
}

#[test]
fn what_no_truth_has_is_refused() {
    for (text, message) in [
        ("[]", "expected an object, found []"),
        (r#"{"class":null}"#, "class: cannot be null"),
        (
            r#"{"class":"hit"}"#,
            "class: 'hit' is none of transversal, parallel, ",
        ),
        (
            r#"{"t":"inside"}"#,
            "t: 'inside' is none of before, at_min, within, at_max, beyond",
        ),
        (r#"{"facing":3}"#, "facing: expected a string, found 3"),
        (
            r#"{"feature":"edge"}"#,
            "feature: 'edge' is none of interior, edge_ab, ",
        ),
        (r#"{"t_exact":3}"#, "t_exact: expected a string, found 3"),
        (
            r#"{"u_exact":"1/0"}"#,
            "u_exact: '1/0' is not a fraction p/q with q > 0",
        ),
        (r#"{"u_exact":"1/-2"}"#, "u_exact: '1/-2' is not a fraction"),
        (r#"{"u_exact":"+1/2"}"#, "u_exact: '+1/2' is not a fraction"),
        (r#"{"u_exact":"0.5"}"#, "u_exact: '0.5' is not a fraction"),
        (r#"{"u_exact":"1_0"}"#, "u_exact: '1_0' is not a fraction"),
        (
            r#"{"hits_closed":1}"#,
            "hits_closed: expected true, false or null, found 1",
        ),
        (
            r#"{"contact":"none"}"#,
            "contact: expected an object, found \"none\"",
        ),
        (
            r#"{"contact":{"kind":"line"}}"#,
            "contact: kind: 'line' is none of none, point, ",
        ),
        (
            r#"{"contact":{"t":["1"]}}"#,
            "contact: t: expected 2 fractions, found 1",
        ),
        (
            r#"{"contact":{"t":"1"}}"#,
            "contact: t: expected an array of 2 fractions, found \"1\"",
        ),
        (
            r#"{"contact":{"u":1}}"#,
            "contact: unknown field 'u', expected one of kind, feature, t",
        ),
        (
            r#"{"hit":true}"#,
            "unknown field 'hit', expected one of name, class, facing, t, ",
        ),
        (r#"{"t":null,"t":null}"#, "duplicate field 't'"),
    ] {
        let error = StoredTruth::parse(text).unwrap_err();
        assert!(error.starts_with(message), "{text}: {error}");
    }
    let long = format!(r#"{{"u_exact":"{}"}}"#, "1".repeat(LONGEST_FRACTION + 1));
    assert!(StoredTruth::parse(&long).is_err());
}
