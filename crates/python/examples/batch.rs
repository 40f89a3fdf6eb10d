//! The Rust side of `ratio.py`: for each line on its input the seconds that a [`Batch`] takes for the rays of a file.
//!
//! The file has origin, direction, a, b, c, each as rows of three numbers; `f32` or `f64` says which.

use hairline::{Batch, Float, Layers};
use std::time::Instant;

fn serve<F: Float, const BYTES: usize>(data: &[u8], number: fn([u8; BYTES]) -> F) {
    let numbers: Vec<F> = data
        .as_chunks()
        .0
        .iter()
        .map(|bytes| number(*bytes))
        .collect();
    let count = numbers.len() / 15;
    let [o, d, a, b, c] = [0, 1, 2, 3, 4].map(|k| {
        let rows = numbers[3 * k * count..][..3 * count].as_chunks::<3>().0;
        [0, 1, 2].map(|j| rows.iter().map(|row| row[j]).collect::<Vec<F>>())
    });
    let ends = [F::from_f64(0.0), F::from_f64(f64::INFINITY)].map(|end| vec![end; count]);
    let batch = Batch::from_columns(o, d, [a, b, c], ends).expect("columns of one length");
    for _ in std::io::stdin().lines() {
        let start = Instant::now();
        let mut truths = Vec::new();
        batch.truths(&mut truths, &mut Layers::default());
        println!("{}", start.elapsed().as_secs_f64());
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let data = std::fs::read(&words[1]).expect("the file of rays");
    match words[0].as_str() {
        "f32" => serve(&data, f32::from_ne_bytes),
        _ => serve(&data, f64::from_ne_bytes),
    }
}
