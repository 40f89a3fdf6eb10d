//! Runs Möller and Trumbore's test on the core set: rustc -O reader.rs && ./reader ../../vectors results.json
use std::{env, fs};

macro_rules! moller_trumbore {
    ($name:ident, $float:ty) => {
        /// `n` holds origin, direction, t_min, t_max, a, b and c.
        fn $name(n: [$float; 17]) -> bool {
            let vector = |i: usize| [n[i], n[i + 1], n[i + 2]];
            let minus = |p: [$float; 3], q: [$float; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            let dot = |p: [$float; 3], q: [$float; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            let cross = |p: [$float; 3], q: [$float; 3]| {
                [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
            };
            let (d, a) = (vector(3), vector(8));
            let (e, f, s) = (minus(vector(11), a), minus(vector(14), a), minus(vector(0), a));
            let (p, q) = (cross(d, f), cross(s, e));
            let det = dot(e, p);
            let (u, v, t) = (dot(s, p) / det, dot(d, q) / det, dot(f, q) / det);
            det != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && n[6] <= t && t <= n[7]
        }
    };
}
moller_trumbore!(hits_f32, f32);
moller_trumbore!(hits_f64, f64);

fn main() {
    let mut arguments = env::args().skip(1);
    let folder = arguments.next().unwrap_or("vectors".into());
    let (product, mut results, mut hits, mut failed) = ("Moller-Trumbore in Rust", vec![], 0, 0);
    for line in fs::read_to_string(folder.clone() + "/core.csv").unwrap().lines().skip(1) {
        let row: Vec<&str> = line.split(',').collect();
        let bits: [u64; 17] = std::array::from_fn(|i| u64::from_str_radix(row[18 + i], 16).unwrap());
        let hit = if row[3] == "f32" { hits_f32(bits.map(|x| f32::from_bits(x as u32))) } else { hits_f64(bits.map(f64::from_bits)) };
        let [triangle, triangles] = [1, 2].map(|i| row[i].parse::<usize>().unwrap());
        hits = if triangle == 0 { 0 } else { hits } + usize::from(hit);
        if triangle + 1 < triangles { continue } // the group goes on
        let (group, answer) = (row[4], if hit { "hit" } else { "miss" });
        let right = if group.is_empty() { row[6] } else { group };
        let pass = right == "free" || right == answer || right == "exactly-one" && hits == 1 || right == "at-least-one" && hits > 0;
        failed += usize::from(!pass);
        results.push(if group.is_empty() { format!("\"{}\": \"{answer}\"", row[0]) } else { format!("\"{}\": {hits}", row[0]) });
    }
    println!("{product}: {} passed, {failed} failed", results.len() - failed);
    let sha = fs::read_to_string(folder + "/sha256.txt").unwrap();
    let text = format!("{{\"vectors\": \"{}\", \"product\": \"{product}\", \"results\": {{\n{}}}}}\n", sha.trim(), results.join(",\n"));
    fs::write(arguments.next().unwrap_or("results.json".into()), text).unwrap();
}
