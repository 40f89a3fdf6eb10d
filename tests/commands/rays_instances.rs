//! `hairline rays`: hits that a program loses by the transform of an instance.

use crate::program::{ends, flat, scratch};
use serde_json::json;
use std::fs;

/// How many triangles are hit by a program, and as many are lost.
const MANY: usize = 12;

/// Where f32 has steps of 1/16.
const FAR: f64 = 1e6;

/// The screen about a program that finds the triangles around k/16 + `found`, and loses those around k/16 + `lost`. They are 0.02
/// wide, and a node of a glTF file puts them far away.
fn told(name: &str, found: f32, lost: f32) -> String {
    let folder = scratch(name);
    let steps = (0..2 * MANY).map(|k| k as f32 / 16.0 + if k % 2 == 0 { found } else { lost });
    let middles: Vec<f32> = steps.collect();
    let corners = middles
        .iter()
        .flat_map(|x| [x - 0.01, 0.0, 0.0, x + 0.01, 0.0, 0.0, *x, 1.0, 0.0]);
    let bytes: Vec<u8> = corners.flat_map(f32::to_le_bytes).collect();
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "translation": [FAR, 0, 0] }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{
            "bufferView": 0, "componentType": 5126, "count": 6 * MANY, "type": "VEC3",
            "min": [0, 0, 0], "max": [2, 1, 0],
        }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "uri": "far.bin", "byteLength": bytes.len() }],
    });
    fs::write(folder.join("far.bin"), bytes).unwrap();
    fs::write(folder.join("far.gltf"), document.to_string()).unwrap();
    let rays = middles
        .iter()
        .map(|x| format!("{:?},0.25,5,0,0,-1\n", FAR + f64::from(*x)));
    fs::write(folder.join("r.csv"), rays.collect::<String>()).unwrap();
    let answers = (0..2 * MANY).map(|k| match k % 2 {
        0 => format!("{k},5\n"),
        _ => "-1\n".to_owned(),
    });
    fs::write(folder.join("a.csv"), answers.collect::<String>()).unwrap();
    let words = ["rays", "far.gltf", "r.csv", "-q", "--answers", "a.csv"];
    flat(&ends(&folder, &words, 1).0)
}

#[test]
fn the_transform_of_an_instance_is_named_where_it_loses_the_hits() {
    let said = |name: &str, found: f32, lost: f32, way: &str| {
        let said = told(name, found, lost);
        let words = format!(
            "The instance's transform loses them: in f32 it parts these rays from their faces, and hardly any other ({way} {MANY})."
        );
        assert!(said.contains(&words), "{words}: {said}");
    };
    // Rays are rounded off the face; the face is rounded to the other side.
    said("rays-inverse", 0.0, 0.028, "rays by the inverse");
    said("rays-matrix", 0.028, 0.015, "vertices by the matrix");
    // Where as many are lost that the program finds, the transform is not it.
    let other = told("rays-neither", 0.028, 0.028);
    assert!(
        other.contains("No built-in triangle test and no slab test"),
        "{other}"
    );
}
