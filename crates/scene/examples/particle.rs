//! Follows a particle through closed parts with each built-in kernel, and says how often it is lost, and why:
//! `cargo run --release -p hairline-scene --example particle -- 1000000 1 f32` (steps, seed, scalar).

#[allow(dead_code)]
#[path = "../tests/scene/drawn.rs"]
mod drawn;
#[allow(dead_code)]
#[path = "../tests/scene/solids.rs"]
mod solids;
#[allow(dead_code)]
#[path = "../tests/scene/spheres.rs"]
mod spheres;
#[path = "../tests/scene/track.rs"]
mod track;

use hairline_core::Scalar;
use track::{Parts, Program, Reason, follow};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, default: u64| match words.get(i) {
        Some(word) => word.parse().expect("a number"),
        None => default,
    };
    let (steps, seed) = (number(0, 10_000), number(1, 1));
    match words.get(2).map(String::as_str) {
        None | Some("f32") => table::<f32>(seed, steps),
        Some("f64") => table::<f64>(seed, steps),
        Some(word) => panic!("unknown scalar '{word}': there are f32 and f64"),
    }
}

fn table<F: Scalar>(seed: u64, steps: u64) {
    let parts = Parts::<F>::new();
    for (name, program) in Program::all() {
        let losses = follow(&parts, &program, seed, steps);
        let lost: u64 = losses.values().sum();
        println!("{name}: lost {lost} times in {steps} steps");
        for ((lost, reason), count) in losses {
            let reason = match reason {
                Reason::Wrong(judgement) => format!("the answer was wrong, {judgement:?}"),
                Reason::Touched => "it touched an edge or a vertex".to_owned(),
                Reason::Rounded => {
                    "a rounded point, or t_min behind it, was beyond a surface".to_owned()
                }
            };
            println!("  {count} {lost:?}: {reason}");
        }
    }
}
