//! Spheres of triangles, as programs make them, and a small reader of OBJ.

use crate::drawn::Drawn;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A sphere around 0: each face of an icosahedron is cut in four, some times over, and each new vertex moved to length 1.
/// The vertices are those of trimesh's `icosphere`, in f32.
pub fn icosphere(cuts: usize) -> Drawn<f32> {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        for signs in 0..4 {
            let mut vertex = [0.0; 3];
            vertex[i] = if signs & 1 == 0 { 1.0 } else { -1.0 };
            vertex[j] = if signs & 2 == 0 { golden } else { -golden };
            vertices.push(unit(vertex));
        }
    }
    // A face is three vertices that are all an edge's length apart.
    let count = vertices.len() as u32;
    let is_edge = |i: u32, j: u32| distance(vertices[i as usize], vertices[j as usize]) < 1.1;
    let mut faces = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                if is_edge(a, b) && is_edge(b, c) && is_edge(c, a) {
                    let [p, q, r] = [a, b, c].map(|i| vertices[i as usize]);
                    let is_outward = 0.0 < volume(p, q, r);
                    faces.push(if is_outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..cuts {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut smaller = Vec::new();
        for [a, b, c] in faces {
            let [d, e, f] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
                *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                    let (p, q) = (vertices[i as usize], vertices[j as usize]);
                    vertices.push(unit([0, 1, 2].map(|k| p[k] + q[k])));
                    vertices.len() as u32 - 1
                })
            });
            smaller.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
        }
        faces = smaller;
    }
    Drawn {
        vertices: vertices
            .iter()
            .map(|vertex| vertex.map(|x| x as f32))
            .collect(),
        faces,
    }
}

fn unit(vertex: [f64; 3]) -> [f64; 3] {
    let length = distance(vertex, [0.0; 3]);
    vertex.map(|x| x / length)
}

fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    let squares = [0, 1, 2].map(|i| (p[i] - q[i]) * (p[i] - q[i]));
    squares.into_iter().sum::<f64>().sqrt()
}

fn volume([a, b, c]: [f64; 3], [d, e, f]: [f64; 3], [g, h, i]: [f64; 3]) -> f64 {
    a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
}

/// MATLAB's `sphere(n)` in triangles, as its `surf2patch` makes them: the seam is not welded, and the faces at the poles
/// have no area.
pub fn matlab_sphere(n: usize) -> Drawn<f64> {
    let side = n + 1;
    let mut vertices = Vec::new();
    for i in 0..side {
        let theta = PI * (2.0 * i as f64 / n as f64 - 1.0);
        let sine = if i == 0 || i == n { 0.0 } else { theta.sin() };
        for j in 0..side {
            let phi = PI / 2.0 * (2.0 * j as f64 / n as f64 - 1.0);
            let radius = if j == 0 || j == n { 0.0 } else { phi.cos() };
            vertices.push([radius * theta.cos(), radius * sine, phi.sin()]);
        }
    }
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let a = (i * side + j) as u32;
            let b = a + side as u32;
            faces.extend([[a, b, a + 1], [a + 1, b, b + 1]]);
        }
    }
    Drawn { vertices, faces }
}

/// Vertices and faces of an OBJ file in f32, and the numbers that stand behind the faces.
pub fn numbered_obj(text: &str) -> (Drawn<f32>, Vec<u32>) {
    let mut mesh = Drawn {
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    let mut numbers = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => mesh.vertices.push([x, y, z].map(|x| x.parse().unwrap())),
            ["f", a, b, c, "#", number] => {
                let corners = [a, b, c].map(|i| i.parse::<u32>().unwrap() - 1);
                mesh.faces.push(corners);
                numbers.push(number.parse().unwrap());
            }
            _ => assert!(line.starts_with('#'), "{line}"),
        }
    }
    (mesh, numbers)
}
