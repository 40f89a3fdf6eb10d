//! A truth as one JSON object, as the `truth` command prints it.

use crate::truth::{Contact, ContactKind, ExactValues, Truth};
use num_rational::BigRational;
use serde::Serialize;

/// A truth as the `truth` command prints it, fields in this order. Fields that do not apply are
/// null; fractions read `p/q`, reduced, q > 0.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TruthLine {
    /// The case's name or id.
    pub name: Option<String>,
    /// `transversal`, `parallel`, `coplanar`, `degenerate` or `invalid`.
    pub class: &'static str,
    /// `front` or `back`.
    pub facing: Option<&'static str>,
    /// `before`, `at_min`, `within`, `at_max` or `beyond`.
    pub t: Option<&'static str>,
    /// `interior`, `edge_ab` and so on.
    pub feature: Option<&'static str>,
    /// The contact in a coplanar or degenerate case.
    pub contact: Option<ContactLine>,
    /// True if the ray on its interval meets the closed triangle; null for invalid input.
    pub hits_closed: Option<bool>,
    /// t of a transversal case. The fractions are left out where nobody asked for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_exact: Option<Option<String>>,
    /// The weight of b.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub u_exact: Option<Option<String>>,
    /// The weight of c.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v_exact: Option<Option<String>>,
}

/// A contact as JSON.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ContactLine {
    /// `none`, `point` or `segment`.
    pub kind: &'static str,
    /// Where the point lies; null for the other kinds.
    pub feature: Option<&'static str>,
    /// The first and the last t, equal for a point; null if there is no contact. Left out with the fractions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t: Option<Option<[String; 2]>>,
}

impl TruthLine {
    /// The truth of a case, and the numbers behind it where they are asked for: what `exact` leaves out is null.
    pub fn new(name: Option<&str>, truth: &Truth, exact: Option<&ExactValues>) -> TruthLine {
        let crossing = truth.crossing();
        let contact = match truth {
            Truth::Coplanar(contact) | Truth::Degenerate(contact) => Some(contact),
            Truth::Transversal(_) | Truth::Parallel | Truth::Invalid => None,
        };
        let mut line = TruthLine {
            name: name.map(str::to_owned),
            class: truth.class_name(),
            facing: crossing.map(|crossing| crossing.facing.name()),
            t: crossing.map(|crossing| crossing.place.name()),
            feature: crossing.map(|crossing| crossing.feature.name()),
            contact: contact.map(ContactLine::new),
            hits_closed: truth.hits_closed(),
            t_exact: None,
            u_exact: None,
            v_exact: None,
        };
        let Some(exact) = exact else { return line };
        let text = |value: &Option<BigRational>| Some(value.as_ref().map(fraction_text));
        (line.t_exact, line.u_exact, line.v_exact) =
            (text(&exact.t), text(&exact.u), text(&exact.v));
        if let Some(contact) = &mut line.contact {
            let ends = exact.contact_t.as_ref().filter(|_| contact.kind != "none");
            contact.t = Some(ends.map(|ends| ends.each_ref().map(fraction_text)));
        }
        line
    }

    /// The same without its numbers.
    pub fn leave_out_fractions(&mut self) {
        (self.t_exact, self.u_exact, self.v_exact) = (None, None, None);
        self.contact.iter_mut().for_each(|contact| contact.t = None);
    }
}

impl ContactLine {
    fn new(contact: &Contact) -> ContactLine {
        let (kind, feature) = match contact.kind {
            ContactKind::None => ("none", None),
            ContactKind::Point(feature) => ("point", Some(feature.name())),
            ContactKind::Segment => ("segment", None),
        };
        ContactLine {
            kind,
            feature,
            t: None,
        }
    }
}

/// `p/q` of a reduced fraction, q > 0.
pub fn fraction_text(value: &BigRational) -> String {
    format!("{}/{}", value.numer(), value.denom())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::truth::{Crossing, Facing, Feature, Place};
    use std::cmp::Ordering;

    fn ratio(p: i64, q: i64) -> BigRational {
        BigRational::new(p.into(), q.into())
    }

    /// At vertex a, u = 0, v = 3.
    pub fn transversal() -> TruthLine {
        let truth = Truth::Transversal(Crossing {
            facing: Facing::Front,
            place: Place::Within,
            t_sign: Ordering::Greater,
            feature: Feature::VertexA,
        });
        let [t, u, v] = [ratio(6, -4), ratio(0, 7), ratio(3, 1)].map(Some);
        TruthLine::new(
            Some("one"),
            &truth,
            Some(&ExactValues {
                t,
                u,
                v,
                contact_t: None,
            }),
        )
    }

    /// In the plane, from t = 1/3 to 4.
    pub fn contact(kind: ContactKind) -> TruthLine {
        let truth = Truth::Coplanar(Contact {
            kind,
            meets_ray: true,
            meets_line: true,
        });
        let contact_t = Some([ratio(1, 3), ratio(4, 1)]);
        TruthLine::new(
            None,
            &truth,
            Some(&ExactValues {
                contact_t,
                ..ExactValues::default()
            }),
        )
    }

    #[test]
    fn a_truth_prints_every_field_in_order() {
        assert_eq!(
            serde_json::to_string(&transversal()).unwrap(),
            r#"{"name":"one","class":"transversal","facing":"front","t":"within","#.to_owned()
                + r#""feature":"vertex_a","contact":null,"hits_closed":true,"#
                + r#""t_exact":"-3/2","u_exact":"0/1","v_exact":"3/1"}"#
        );
        let nulls = r#""t_exact":null,"u_exact":null,"v_exact":null}"#;
        let invalid = TruthLine::new(None, &Truth::Invalid, Some(&ExactValues::default()));
        assert_eq!(
            serde_json::to_string(&invalid).unwrap(),
            r#"{"name":null,"class":"invalid","facing":null,"t":null,"feature":null,"#.to_owned()
                + r#""contact":null,"hits_closed":null,"#
                + nulls
        );
        for (kind, json) in [
            (
                ContactKind::None,
                r#"{"kind":"none","feature":null,"t":null}"#,
            ),
            (
                ContactKind::Point(Feature::EdgeBc),
                r#"{"kind":"point","feature":"edge_bc","t":["1/3","4/1"]}"#,
            ),
            (
                ContactKind::Segment,
                r#"{"kind":"segment","feature":null,"t":["1/3","4/1"]}"#,
            ),
        ] {
            let hits = kind != ContactKind::None;
            let rest = format!(r#""contact":{json},"hits_closed":{hits},{nulls}"#);
            assert!(
                serde_json::to_string(&contact(kind))
                    .unwrap()
                    .ends_with(&rest),
                "{rest}"
            );
        }
    }
}
