//! Compares the fast answers with the definition on as many random scenes as you like:
//! `cargo run --release -p hairline-scene --example compare -- 100000 7` (rays of each scalar, seed). With the word `walk`
//! behind them only the faces that the truths of single triangles say are met are asked by definition, which is much faster.
//! With `instances` behind that word the scenes are of instances, and with the path of an OBJ file behind it the scene is that file's.

#[path = "../tests/scene/drawn.rs"]
mod drawn;
#[path = "../tests/scene/instanced.rs"]
mod instanced;

use drawn::{Drawn, Reference, compare_many, compare_mesh};
use hairline_core::Float;
use instanced::compare_instances;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, default: u64| match words.get(i) {
        Some(word) => word.parse().expect("a number"),
        None => default,
    };
    let (rays, seed) = (number(0, 10_000), number(1, 1));
    let reference = match words.get(2).map(String::as_str) {
        None => Reference::Definition,
        Some("walk") => Reference::Walk,
        Some(word) => panic!("unknown reference '{word}': there is walk"),
    };
    match words.get(3).map(String::as_str) {
        None => {
            let narrow = compare_many::<f32>(seed, rays, reference);
            println!("f32: no difference, {narrow:?}");
            let wide = compare_many::<f64>(seed, rays, reference);
            println!("f64: no difference, {wide:?}");
        }
        Some("instances") => {
            let narrow = compare_instances::<f32>(seed, rays, reference);
            println!("f32: no difference, {narrow:?}");
            let wide = compare_instances::<f64>(seed, rays, reference);
            println!("f64: no difference, {wide:?}");
        }
        Some(path) => {
            let narrow = compare_mesh(&read_obj::<f32>(path), seed, rays);
            println!("f32: no difference, {narrow:?}");
            let wide = compare_mesh(&read_obj::<f64>(path), seed, rays);
            println!("f64: no difference, {wide:?}");
        }
    }
}

/// The vertices and faces of an OBJ file; polygons as fans.
fn read_obj<F: Float>(path: &str) -> Drawn<F> {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let text = std::fs::read_to_string(path).expect("a file");
    for line in text.replace("\\\n", " ").lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, ..] => {
                let number = |x: &str| F::from_f64(x.parse().expect("a coordinate"));
                vertices.push([x, y, z].map(number));
            }
            ["f", ref corners @ ..] => {
                // From 1, or backwards from -1.
                let number = |corner: &&str| {
                    let vertex = corner.split('/').next()?.parse::<i64>().ok()?;
                    let before = if vertex < 0 {
                        vertices.len() as i64
                    } else {
                        -1
                    };
                    u32::try_from(before + vertex).ok()
                };
                let corners: Option<Vec<u32>> = corners.iter().map(number).collect();
                let corners = corners.expect("numbers of vertices");
                faces.extend(
                    corners
                        .windows(2)
                        .skip(1)
                        .map(|pair| [corners[0], pair[0], pair[1]]),
                );
            }
            _ => {}
        }
    }
    Drawn { vertices, faces }
}
