//! JSON: a file a topic, and one line a test. docs/schema/vectors.json is the schema.

use super::flags::FLAGS;
use super::number::{EitherFloat, nearest};
use super::{TestGroup, TestTriangle, VectorTest, VectorTopic, place, result, word};
use crate::corpus::truth_json::fraction_text;
use crate::files::json::object;
use crate::files::number;
use num_rational::BigRational;
use serde_json::{Value, json};

/// The version of the format.
pub const SCHEMA: &str = "ray-triangle-vectors-1";

/// The most characters of an exact fraction that is written.
const LONGEST_FRACTION: usize = 60;

/// A file of the core set, with its name.
pub fn topic_file(topic: &VectorTopic, tests: &[VectorTest]) -> (String, String) {
    let used = |name: &str| tests.iter().any(|test| test.flags.contains(&name));
    let flags = FLAGS.iter().filter(|(name, _)| used(name));
    let flags: Vec<String> = flags
        .map(|(name, effect)| format!("\n\"{name}\":{}", json!(effect)))
        .collect();
    let lines: Vec<String> = tests
        .iter()
        .map(|test| format!("\n{}", line(test)))
        .collect();
    let text = format!(
        "{{\n\"schema\":\"{SCHEMA}\",\n\"topic\":\"{}\",\n\"about\":{},\n\"licence\":\"CC0-1.0\",\n\"flags\":{{{}\n}},\n\"tests\":[{}\n]\n}}\n",
        topic.name,
        json!(topic.about),
        flags.join(","),
        lines.join(","),
    );
    (format!("{}.json", topic.name), text)
}

/// A test, without the end of the line.
pub fn line(test: &VectorTest) -> String {
    let mut fields = Fields(Vec::new());
    fields.add("id", json!(test.id));
    fields.add("comment", json!(test.comment));
    fields.0.extend(
        test.source
            .as_ref()
            .map(|source| ("source", json!(source).to_string())),
    );
    fields.add("flags", json!(test.flags));
    fields.add("scalar", json!(test.scalar));
    let text = |numbers: &[EitherFloat]| numbers.iter().map(EitherFloat::text).collect::<Vec<_>>();
    fields.add("origin", json!(text(&test.ray[..3])));
    fields.add("direction", json!(text(&test.ray[3..6])));
    fields.add("t_min", json!(test.ray[6].text()));
    fields.add("t_max", json!(test.ray[7].text()));
    match &test.group {
        None => {
            let triangle = &test.triangles[0];
            for (name, vertex) in ["a", "b", "c"].into_iter().zip(triangle.numbers.chunks(3)) {
                fields.add(name, json!(text(vertex)));
            }
            fields.add("bits", json!(test.bits()));
            fields.triangle(triangle);
        }
        Some(group) => fields.group(test, group, text),
    }
    object(fields.0)
}

/// The fields of a test, each with its JSON.
struct Fields(Vec<(&'static str, String)>);

impl Fields {
    fn add(&mut self, name: &'static str, value: Value) {
        self.0.push((name, value.to_string()));
    }

    fn triangle(&mut self, triangle: &TestTriangle) {
        self.add("result", json!(word(result(&triangle.truth))));
        self.add("closed", json!(word(triangle.closed())));
        self.add("open", json!(word(triangle.open())));
        let reasons = triangle.free_because();
        if !reasons.is_empty() {
            self.add("free_because", json!(reasons));
        }
        self.add("where", json!(place(&triangle.truth)));
        let (Some(crossing), Some(values)) = (triangle.truth.crossing(), &triangle.values) else {
            return;
        };
        self.add("place", json!(crossing.place.name()));
        self.add("facing", json!(crossing.facing.name()));
        for (name, value) in ["t", "u", "v", "margin"].into_iter().zip(values) {
            self.0.push((name, double(value)));
        }
        for (name, value) in ["t_exact", "u_exact", "v_exact"].into_iter().zip(values) {
            let text = fraction_text(value);
            if text.len() <= LONGEST_FRACTION {
                self.add(name, json!(text));
            }
        }
    }

    /// The vertices once each, and triangles of their indices.
    fn group(
        &mut self,
        test: &VectorTest,
        group: &TestGroup,
        text: impl Fn(&[EitherFloat]) -> Vec<String>,
    ) {
        let mut vertices: Vec<&[EitherFloat]> = Vec::new();
        let mut index = |vertex| {
            let same = |other: &&[EitherFloat]| patterns(other) == patterns(vertex);
            vertices.iter().position(same).unwrap_or_else(|| {
                vertices.push(vertex);
                vertices.len() - 1
            })
        };
        let triangles: Vec<Vec<usize>> = test
            .triangles
            .iter()
            .map(|triangle| triangle.numbers.chunks(3).map(&mut index).collect())
            .collect();
        let vertices: Vec<Vec<String>> = vertices.into_iter().map(text).collect();
        self.add("vertices", json!(vertices));
        self.add("triangles", json!(triangles));
        self.add("bits", json!(test.bits()));
        self.add("result", json!(group.result()));
        self.add("closed", json!(group.counts[0]));
        self.add("open", json!(group.counts[1]));
        self.add("parity", json!(group.parity()));
        let places: Vec<&str> = test.triangles.iter().map(|it| place(&it.truth)).collect();
        self.add("where", json!(places));
    }
}

fn patterns(vertex: &[EitherFloat]) -> Vec<&str> {
    vertex.iter().map(|number| &*number.bits).collect()
}

/// The nearest double; null beyond the largest.
fn double(value: &BigRational) -> String {
    let nearest = nearest(value);
    if nearest.is_finite() {
        number::write(nearest)
    } else {
        "null".to_owned()
    }
}
