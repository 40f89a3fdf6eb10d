//! Compares the fast answers with the definition on as many random scenes as you like:
//! `cargo run --release -p hairline-scene --example compare -- 1000000 7` (rays of each scalar, seed).

#[path = "../tests/scene/drawn.rs"]
mod drawn;

use drawn::compare_many;

fn main() {
    let mut numbers = std::env::args().skip(1).map(|word| word.parse::<u64>());
    let rays = numbers
        .next()
        .map_or(100_000, |number| number.expect("a number of rays"));
    let seed = numbers.next().map_or(1, |number| number.expect("a seed"));
    println!("f32: no difference, {:?}", compare_many::<f32>(seed, rays));
    println!("f64: no difference, {:?}", compare_many::<f64>(seed, rays));
}
