//! The values that a product may give with a hit: t, and u with v.

use super::profile::Answered;
use super::test::VectorTest;
use crate::arith::Float;
use crate::case::Case;
use crate::contract::Contract;
use crate::files::{json, number};
use crate::judge::{Finding, Obligation, ValueErrors, judge};
use crate::kernel::{Gives, Verdict};

/// The full answer of a product to a test.
pub struct GivenAnswer<'a> {
    /// Hit, miss, or how many triangles.
    pub answered: Answered,
    /// The texts of t, u and v.
    values: [Option<&'a str>; 3],
}

impl<'a> GivenAnswer<'a> {
    /// Reads `"hit"`, `"miss"`, a number of hits, or `{"hit": true, "t": 1.5, "u": 0.25, "v": 0.5}`.
    pub fn parse(text: &'a str) -> Result<GivenAnswer<'a>, String> {
        let alone = |answered| {
            Ok(GivenAnswer {
                answered,
                values: [None; 3],
            })
        };
        match text {
            "\"hit\"" => alone(Answered::Single(true)),
            "\"miss\"" => alone(Answered::Single(false)),
            object if object.starts_with('{') => {
                let object = json::Object::parse(object, &["hit", "t", "u", "v"])?;
                let hit = match object.required("hit")? {
                    "true" => true,
                    "false" => false,
                    other => {
                        return Err(format!(
                            "hit: expected true or false, found {}",
                            json::excerpt(other)
                        ));
                    }
                };
                let given = |name| object.get(name).filter(|text| *text != "null");
                let values = ["t", "u", "v"].map(given);
                if values[1].is_some() != values[2].is_some() {
                    return Err("u and v: expected both or neither".to_owned());
                }
                if !hit && values.iter().any(Option::is_some) {
                    return Err("t, u and v: expected none with a miss".to_owned());
                }
                Ok(GivenAnswer { answered: Answered::Single(hit), values })
            }
            other => other
                .parse()
                .map_err(|_| {
                    format!(
                        "expected \"hit\", \"miss\" or a number of hits, found {}; a hit with its values is \
                         {{\"hit\": true, \"t\": 1.5}}, and a test that was not asked \"not asked\"",
                        json::excerpt(other)
                    )
                })
                .and_then(|hits| alone(Answered::Hits(hits))),
        }
    }

    /// The fault in the values, and the exact ones, whether the hit is demanded or free.
    pub fn wrong_values(&self, test: &VectorTest) -> Result<Option<String>, String> {
        either_scalar!(&test.cases[0], case => self.wrong(test, case))
    }

    fn wrong<F: Float>(&self, test: &VectorTest, case: &Case<F>) -> Result<Option<String>, String> {
        let nan = F::from_f64(f64::NAN);
        let read = |i: usize| match self.values[i] {
            None => Ok(nan),
            Some(text) => {
                // JSON has no infinity and no NaN: they are strings.
                let parsed = match text.starts_with('"') {
                    true => json::string(text).and_then(|text| number::parse::<F>(&text)),
                    false => number::parse::<F>(text),
                };
                parsed.map_err(|message| format!("{}: {message}", ["t", "u", "v"][i]))
            }
        };
        let (t, u, v) = (read(0)?, read(1)?, read(2)?);
        let [t_given, uv_given, _] = self.values.map(|value| value.is_some());
        if !t_given && !uv_given {
            return Ok(None);
        }
        let gives = Gives {
            t: t_given,
            uv: uv_given,
            facing: false,
        };
        let verdict = Verdict {
            hit: true,
            t,
            u,
            v,
            ..Verdict::miss(None)
        };
        let truth = &test.triangles[0].truth;
        let Some(finding) = judge(
            (&Contract::CLOSED_RAY, Obligation::Free),
            (case, truth),
            gives,
            &verdict,
        ) else {
            return Ok(None);
        };
        if finding != Finding::WrongValue {
            return Ok(Some("a value that is not finite".to_owned()));
        }
        let errors = ValueErrors::of(case, truth, gives, &verdict);
        let parts = (0..3).filter(|&i| errors.is_wrong(i, 0.0)).map(|i| {
            let (name, exact) = (["t", "u", "v"][i], errors.exact[i]);
            format!(
                "{name} = {}, exactly {exact:.9e}",
                self.values[i].unwrap_or_default()
            )
        });
        Ok(Some(parts.collect::<Vec<_>>().join("; ")))
    }
}
