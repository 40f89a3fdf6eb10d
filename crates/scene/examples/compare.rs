//! Compares the fast answers with the definition on as many random scenes as you like:
//! `cargo run --release -p hairline-scene --example compare -- 100000 7` (rays of each scalar, seed). With the word `walk`
//! behind them only the faces that the truths of single triangles say are met are asked by definition, which is much faster.
//! With `instances` behind that word the scenes are of instances.

#[path = "../tests/scene/drawn.rs"]
mod drawn;
#[path = "../tests/scene/instanced.rs"]
mod instanced;

use drawn::{Reference, compare_many};
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
        Some(word) => panic!("unknown scenes '{word}': there are instances"),
    }
}
