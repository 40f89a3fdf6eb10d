//! Whether a document is what a JSON Schema says, for the keywords that the schemas in use have. An
//! unknown keyword, or a pattern that would have to be checked, stops the test.

use serde::de::DeserializeOwned;
use serde_json::Value;

/// The findings in a record's text, which is what the published schema says.
pub fn result<T: DeserializeOwned>(record: &str) -> T {
    let schema = serde_json::from_str(include_str!("../../docs/schema/record.json")).unwrap();
    let mut record: Value = serde_json::from_str(record).unwrap();
    assert_eq!(errors(&schema, &record), [""; 0]);
    serde_json::from_value(record["result"].take()).unwrap()
}

/// Everything in a document that its schema does not allow.
pub fn errors(schema: &Value, document: &Value) -> Vec<String> {
    let mut checker = Checker {
        root: schema,
        errors: Vec::new(),
    };
    checker.check(schema, document, "");
    checker.errors
}

struct Checker<'a> {
    root: &'a Value,
    errors: Vec<String>,
}

impl Checker<'_> {
    fn check(&mut self, schema: &Value, document: &Value, path: &str) {
        let Value::Object(keywords) = schema else {
            if *schema == Value::Bool(false) {
                self.errors.push(format!("{path}: not allowed"));
            }
            return;
        };
        for (keyword, value) in keywords {
            let before = self.errors.len();
            let holds = match keyword.as_str() {
                "$ref" => {
                    let pointer = value.as_str().unwrap().strip_prefix('#').unwrap();
                    let target = self.root.pointer(pointer).expect("a definition");
                    self.check(target, document, path);
                    true
                }
                "type" => is_of_type(value, document),
                "enum" => value.as_array().unwrap().contains(document),
                "const" => value == document,
                "minimum" => document
                    .as_f64()
                    .is_none_or(|x| value.as_f64().unwrap() <= x),
                "maximum" => document
                    .as_f64()
                    .is_none_or(|x| x <= value.as_f64().unwrap()),
                "minItems" => document
                    .as_array()
                    .is_none_or(|a| value.as_u64().unwrap() as usize <= a.len()),
                "maxItems" => document
                    .as_array()
                    .is_none_or(|a| a.len() <= value.as_u64().unwrap() as usize),
                "uniqueItems" => document
                    .as_array()
                    .is_none_or(|a| (1..a.len()).all(|i| !a[..i].contains(&a[i]))),
                "required" => document.as_object().is_none_or(|object| {
                    value
                        .as_array()
                        .unwrap()
                        .iter()
                        .all(|k| object.contains_key(k.as_str().unwrap()))
                }),
                "items" => {
                    let items = document.as_array().map(Vec::as_slice).unwrap_or_default();
                    for (i, item) in items.iter().enumerate() {
                        self.check(value, item, &format!("{path}/{i}"));
                    }
                    true
                }
                "prefixItems" => {
                    let items = document.as_array().map(Vec::as_slice).unwrap_or_default();
                    for (i, (item, schema)) in
                        items.iter().zip(value.as_array().unwrap()).enumerate()
                    {
                        self.check(schema, item, &format!("{path}/{i}"));
                    }
                    true
                }
                "properties" => {
                    for (name, schema) in value.as_object().unwrap() {
                        if let Some(inner) = document.get(name) {
                            self.check(schema, inner, &format!("{path}/{name}"));
                        }
                    }
                    true
                }
                "additionalProperties" => {
                    let known = keywords.get("properties").and_then(Value::as_object);
                    for (name, inner) in document.as_object().into_iter().flatten() {
                        if !known.is_some_and(|known| known.contains_key(name)) {
                            self.check(value, inner, &format!("{path}/{name}"));
                        }
                    }
                    true
                }
                "anyOf" => 0 < self.matching(value, document),
                "oneOf" => self.matching(value, document) == 1,
                "pattern" => {
                    assert!(
                        !document.is_string(),
                        "{path}: a pattern that nothing here checks"
                    );
                    true
                }
                // They say nothing about a document that could be wrong here.
                "$schema" | "$id" | "$defs" | "definitions" | "title" | "description"
                | "default" | "format" => true,
                other => panic!("{path}: the keyword '{other}' is not known here"),
            };
            if !holds && self.errors.len() == before {
                self.errors
                    .push(format!("{path}: {keyword} {value} does not hold"));
            }
        }
    }

    fn matching(&self, schemas: &Value, document: &Value) -> usize {
        let matches = |schema: &&Value| {
            let mut checker = Checker {
                root: self.root,
                errors: Vec::new(),
            };
            checker.check(schema, document, "");
            checker.errors.is_empty()
        };
        schemas.as_array().unwrap().iter().filter(matches).count()
    }
}

fn is_of_type(types: &Value, document: &Value) -> bool {
    let is = |name: &str| match name {
        "object" => document.is_object(),
        "array" => document.is_array(),
        "string" => document.is_string(),
        "boolean" => document.is_boolean(),
        "null" => document.is_null(),
        "number" => document.is_number(),
        "integer" => document.is_i64() || document.is_u64(),
        other => panic!("type '{other}'"),
    };
    match types {
        Value::String(name) => is(name),
        names => names
            .as_array()
            .unwrap()
            .iter()
            .any(|name| is(name.as_str().unwrap())),
    }
}
