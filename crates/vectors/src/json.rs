//! JSON: a file a topic, and one line a test. docs/schema/vectors.json is the schema.

use super::flags::FLAGS;
use super::number::{EitherFloat, nearest};
use super::set::VectorTopic;
use super::test::{TestGroup, TestTriangle, VectorTest, place, result, word};
use crate::corpus::truth_json::fraction_text;
use crate::files::json::object;
use crate::files::number;
use num_rational::BigRational;
use serde_json::{Value, json};

/// The version of the format.
pub const SCHEMA: &str = "ray-triangle-vectors-1";

/// The most characters of an exact fraction that is written.
const LONGEST_FRACTION: usize = 60;

/// The name of a file of the core set, and its text.
pub fn topic_file(topic: &VectorTopic, tests: &[VectorTest]) -> (String, String) {
    let mut flags = Vec::new();
    for (name, effect) in FLAGS.iter() {
        if tests.iter().any(|test| test.flags.contains(name)) {
            flags.push(format!("\n\"{name}\":{}", json!(effect)));
        }
    }
    let mut lines = Vec::new();
    for test in tests {
        lines.push(format!("\n{}", line(test)));
    }
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
    if let Some(source) = &test.source {
        fields.add("source", json!(source));
    }
    fields.add("flags", json!(test.flags));
    fields.add("scalar", json!(test.scalar));
    fields.add("origin", json!(texts(&test.ray[..3])));
    fields.add("direction", json!(texts(&test.ray[3..6])));
    fields.add("t_min", json!(test.ray[6].text()));
    fields.add("t_max", json!(test.ray[7].text()));
    match &test.group {
        None => {
            let triangle = &test.triangles[0];
            for (name, vertex) in ["a", "b", "c"].into_iter().zip(triangle.numbers.chunks(3)) {
                fields.add(name, json!(texts(vertex)));
            }
            fields.add("bits", json!(test.bits()));
            fields.triangle(triangle);
        }
        Some(group) => fields.group(test, group),
    }
    object(fields.0)
}

/// The fields of a test, each with its JSON.
struct Fields(Vec<(&'static str, String)>);

impl Fields {
    fn add(&mut self, name: &'static str, value: Value) {
        self.0.push((name, value.to_string()));
    }

    /// The right results for a triangle, with the exact values if the line crosses its plane.
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
        // The margin is written as a double alone.
        for (name, value) in ["t_exact", "u_exact", "v_exact"].into_iter().zip(values) {
            let text = fraction_text(value);
            if text.len() <= LONGEST_FRACTION {
                self.add(name, json!(text));
            }
        }
    }

    /// The vertices once each, and triangles of their indices.
    fn group(&mut self, test: &VectorTest, group: &TestGroup) {
        let mut vertices: Vec<&[EitherFloat]> = Vec::new();
        let mut triangles = Vec::new();
        for triangle in &test.triangles {
            let mut indices = Vec::new();
            for vertex in triangle.numbers.chunks(3) {
                let known = vertices
                    .iter()
                    .position(|other| patterns(other) == patterns(vertex));
                indices.push(known.unwrap_or(vertices.len()));
                if known.is_none() {
                    vertices.push(vertex);
                }
            }
            triangles.push(indices);
        }
        let vertices: Vec<Vec<String>> = vertices.into_iter().map(texts).collect();
        self.add("vertices", json!(vertices));
        self.add("triangles", json!(triangles));
        self.add("bits", json!(test.bits()));
        self.add("result", json!(group.result()));
        let [closed, open] = group.counts;
        self.add("closed", json!(closed));
        self.add("open", json!(open));
        self.add("parity", json!(group.parity()));
        let places: Vec<&str> = test.triangles.iter().map(|it| place(&it.truth)).collect();
        self.add("where", json!(places));
    }
}

fn texts(numbers: &[EitherFloat]) -> Vec<String> {
    numbers.iter().map(EitherFloat::text).collect()
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
