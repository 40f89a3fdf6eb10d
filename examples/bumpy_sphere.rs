//! Writes a closed, bumpy sphere of 12·N² triangles as OBJ, the same on every machine, to try
//! `hairline mesh` on something large:
//!
//! ```text
//! cargo run --release --example bumpy_sphere -- 289 > million.obj
//! hairline mesh million.obj --kernel moller-trumbore
//! ```

use hairline::internals::case::Draw;
use std::collections::HashMap;
use std::io::{self, BufWriter, Write};

fn main() -> io::Result<()> {
    let n = std::env::args()
        .nth(1)
        .map_or(Some(289), |n| n.parse().ok());
    let Some(n) = n.filter(|n| (1..=2048).contains(n)) else {
        return Err(io::Error::other("the argument is no number from 1 to 2048"));
    };
    let mut out = BufWriter::new(io::stdout().lock());
    let (vertices, faces) = bumpy_sphere(n);
    vertices
        .iter()
        .try_for_each(|[x, y, z]| writeln!(out, "v {x} {y} {z}"))?;
    faces
        .iter()
        .try_for_each(|[a, b, c]| writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1))?;
    out.flush()
}

/// A cube of n × n squares a side, brought to a sphere with bumps.
fn bumpy_sphere(n: i32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut numbers: HashMap<[i32; 3], u32> = HashMap::new();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let axis = side % 3;
        // The lattice runs from -n to n in steps of two.
        let mut at = |i: i32, j: i32| {
            let mut point = [n; 3];
            (point[(axis + 1) % 3], point[(axis + 2) % 3]) = (2 * i - n, 2 * j - n);
            if side >= 3 {
                point = point.map(|x| -x);
            }
            *numbers.entry(point).or_insert_with(|| {
                vertices.push(bumpy(point, vertices.len() as u64));
                vertices.len() as u32 - 1
            })
        };
        for i in 0..n {
            for j in 0..n {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                // Seen from outside counter-clockwise: the opposite side mirrors.
                faces.extend(if side < 3 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, c, b], [a, d, c]]
                });
            }
        }
    }
    (vertices, faces)
}

fn bumpy(point: [i32; 3], number: u64) -> [f64; 3] {
    let wide = point.map(f64::from);
    let length = wide.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = point.iter().map(|x| x.abs()).max().unwrap_or(1);
    // Bumps of a quarter of a square's size.
    let bump = Draw::new("bumpy-sphere", 1, number).unit() * 0.25 / f64::from(largest);
    wide.map(|x| f64::from((x / length * (1.0 + bump)) as f32))
}
