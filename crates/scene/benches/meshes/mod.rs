//! The meshes of the bench: a sphere, a terrain, a soup, all on the grid 2^-18.

use hairline_core::case::Draw;
use std::collections::HashMap;

pub struct Mesh {
    pub vertices: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// The vertices of a face, drawn.
    pub fn face(&self, draw: &mut Draw) -> [[f64; 3]; 3] {
        let corners = draw.pick(&self.faces);
        corners.map(|i| self.vertices[i as usize])
    }
}

pub fn on_grid(x: f64) -> f64 {
    (x * 262_144.0).round() / 262_144.0
}

fn rounded(point: [f64; 3]) -> [f64; 3] {
    point.map(on_grid)
}

/// A mesh that is turned about two axes, so that its coordinates have full significands.
pub fn turned(mesh: Mesh) -> Mesh {
    let turned = |[x, y, z]: [f64; 3]| {
        let [x, y] = [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y];
        let (sine, cosine) = 0.4f64.sin_cos();
        [x, cosine * y - sine * z, sine * y + cosine * z]
    };
    Mesh {
        vertices: mesh.vertices.into_iter().map(turned).collect(),
        faces: mesh.faces,
    }
}

/// An icosahedron whose faces are cut in four some times, 20·4^times faces.
pub fn icosphere(times: u32) -> Mesh {
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    for [y, z] in [[1.0, p], [-1.0, p], [1.0, -p], [-1.0, -p]] {
        vertices.extend([[0.0, y, z], [y, z, 0.0], [z, 0.0, y]].map(unit));
    }
    // Three vertices are a face if they are neighbours: with unit vectors their products are 1/√5.
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let are_neighbours =
        |i: usize, j: usize| (dot(&vertices[i], &vertices[j]) - 0.2f64.sqrt()).abs() < 1e-9;
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if are_neighbours(i, j) && are_neighbours(j, k) && are_neighbours(k, i) {
                    faces.push([i, j, k].map(|n| n as u32));
                }
            }
        }
    }
    for _ in 0..times {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut cut = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| {
                *middles.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                    let (p, q) = (vertices[p as usize], vertices[q as usize]);
                    vertices.push(unit([0, 1, 2].map(|i| p[i] + q[i])));
                    vertices.len() as u32 - 1
                })
            });
            cut.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        faces = cut;
    }
    Mesh {
        vertices: vertices.into_iter().map(rounded).collect(),
        faces,
    }
}

fn unit(point: [f64; 3]) -> [f64; 3] {
    let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
    point.map(|x| x / length)
}

/// Hills over a square of n×n cells, two faces each.
pub fn terrain(n: u32) -> Mesh {
    let mut draw = Draw::new("terrain", 1, 0);
    let mut vertices = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let [x, y] = [i, j].map(|k| (f64::from(k) - f64::from(n) / 2.0) / 128.0);
            let waves =
                0.15 * (3.0 * x).sin() * (4.0 * y).cos() + 0.05 * (13.0 * x + 7.0 * y).sin();
            vertices.push(rounded([x, y, waves + (draw.unit() - 0.5) / 128.0]));
        }
    }
    let faces = cells(n);
    Mesh { vertices, faces }
}

/// Two faces for each of n×n cells between vertices in rows.
fn cells(n: u32) -> Vec<[u32; 3]> {
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let q = i * (n + 1) + j;
            faces.extend([[q, q + n + 1, q + n + 2], [q, q + n + 2, q + 1]]);
        }
    }
    faces
}

/// A square of n×n cells of size 1 in the plane z = 0.
pub fn flat(n: u32) -> Mesh {
    let mut vertices = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            vertices.push([i, j, 0].map(f64::from));
        }
    }
    let faces = cells(n);
    Mesh { vertices, faces }
}

/// Faces that share the origin only.
pub fn fan(count: u32) -> Mesh {
    let corner = |i: u32| match i % 3 {
        0 => [0.0; 3],
        _ => {
            let angle = f64::from(i);
            [angle.cos(), angle.sin(), (angle * 0.37).sin() * 0.1]
        }
    };
    unwelded(count, corner)
}

/// Faces about the origin whose sizes are 60 powers of two.
pub fn shrinking(count: u32) -> Mesh {
    let corner = |i: u32| {
        let size = 0.77 * 2f64.powi(-((i / 3) as i32 % 60));
        let angle = f64::from(i);
        [angle.cos(), angle.sin(), (angle * 0.37).sin()].map(|x| size * x)
    };
    unwelded(count, corner)
}

fn unwelded(count: u32, corner: impl Fn(u32) -> [f64; 3]) -> Mesh {
    Mesh {
        vertices: (0..3 * count).map(corner).collect(),
        faces: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
    }
}

/// Faces anywhere; one in fifty repeats another one, and one in fifty has no area.
pub fn soup(count: u32) -> Mesh {
    let mut draw = Draw::new("soup", 1, 0);
    let size = 1.5 * f64::from(count).powf(-1.0 / 3.0);
    let mut vertices = Vec::new();
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for face in 0..count {
        let centre = [(); 3].map(|()| 2.0 * draw.unit() - 1.0);
        for _ in 0..3 {
            let corner = centre.map(|x| x + size * (2.0 * draw.unit() - 1.0));
            vertices.push(rounded(corner));
        }
        let own = [3 * face, 3 * face + 1, 3 * face + 2];
        faces.push(match (draw.below(50), faces.is_empty()) {
            (0, false) => draw.pick(&faces),
            (1, _) => [own[0], own[1], own[1]],
            _ => own,
        });
    }
    Mesh { vertices, faces }
}
