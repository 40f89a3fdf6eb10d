//! The committed JSON Schemas, which tests derive from the types.

use schemars::JsonSchema;

/// Panics unless the schema in `docs/schema/NAME.json` is that of a type, and says how to mend it.
pub fn assert_committed<T: JsonSchema>(name: &str) {
    let file = format!("{}/docs/schema/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let derived = serde_json::to_string_pretty(&schemars::schema_for!(T)).unwrap() + "\n";
    if std::fs::read_to_string(&file).ok().as_ref() != Some(&derived) {
        let path = std::env::temp_dir().join(format!("hairline-{name}.json"));
        std::fs::write(&path, derived).unwrap();
        panic!(
            "the record has changed: cp {} docs/schema/{name}.json",
            path.display()
        );
    }
}
