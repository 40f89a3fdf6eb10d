//! OBJ files of triangles, and rays as `hairline rays --make` writes them.

use crate::library::{Line, Mesh};
use std::fs;

pub fn mesh(path: &str) -> Result<Mesh, String> {
    let text = text(path)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => vertices.push([number(x)?, number(y)?, number(z)?]),
            ["f", a, b, c] => faces.push([corner(a)?, corner(b)?, corner(c)?]),
            ["f", ..] => return Err(format!("{path}: not a triangle: {line}")),
            _ => {}
        }
    }
    Ok(Mesh { vertices, faces })
}

pub fn rays(path: &str) -> Result<Vec<Line>, String> {
    let text = text(path)?;
    let rays = text.lines().skip(1).map(|line| {
        let numbers: Vec<f64> = line.split(',').map(number).collect::<Result<_, _>>()?;
        let [ox, oy, oz, dx, dy, dz] = numbers[..] else {
            return Err(format!("{path}: not six numbers: {line}"));
        };
        Ok([[ox, oy, oz], [dx, dy, dz]])
    });
    rays.collect()
}

fn text(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))
}

fn number(word: &str) -> Result<f64, String> {
    word.parse()
        .map_err(|error| format!("not a number: {word}: {error}"))
}

/// A face's corner, `7` or `7/1/2`, counted from 0.
fn corner(word: &str) -> Result<u32, String> {
    let vertex = word.split('/').next().unwrap_or_default();
    let vertex: Option<u32> = vertex.parse().ok();
    let from_zero = vertex.and_then(|vertex| vertex.checked_sub(1));
    from_zero.ok_or_else(|| format!("not a vertex: {word}"))
}
