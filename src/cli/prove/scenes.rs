//! Scenes: their words, and the scene that a mesh is.

use crate::cli::exit::Failure;
use crate::cli::input::read_mesh;
use crate::corpus::InputError;
use crate::prove::Scene;

/// `0.01..10`, or one number for both.
pub fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| text.trim().parse().map_err(|_| format!("'{text}' is no number"));
    Ok([number(low)?, number(high)?])
}

/// `1`, or `1deg`.
pub fn degrees(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches("deg").trim();
    number.parse().map_err(|_| format!("'{text}' is no angle in degrees"))
}

/// The scene that a mesh is, and the largest coordinate of each triangle's edges.
pub fn mesh_scene(
    path: &str,
    distance: f64,
    grazing: f64,
    quiet: bool,
) -> Result<(Scene, Vec<f64>), Failure> {
    let mut triangles = Vec::new();
    let mesh = read_mesh(path, quiet)?;
    let mut edge = [f64::INFINITY, 0.0f64];
    let (mut min_angle, mut coordinates) = (180.0f64, 0.0f64);
    for triangle in 0..mesh.triangles.len() {
        let vertices = mesh.vertices::<f64>(triangle);
        let length = |p: [f64; 3], q: [f64; 3]| {
            (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum::<f64>().sqrt()
        };
        let sides = [0, 1, 2].map(|i| length(vertices[i], vertices[(i + 1) % 3]));
        let angle = (0..3).map(|i| {
            let [a, b, c] = [0, 1, 2].map(|k| sides[(i + k) % 3]);
            ((b * b + c * c - a * a) / (2.0 * b * c)).clamp(-1.0, 1.0).acos().to_degrees()
        });
        let angle = angle.fold(180.0, f64::min);
        if angle.is_nan() || angle <= 0.0 {
            continue;
        }
        let size = |(p, q): (usize, usize)| {
            (0..3).map(move |i| (vertices[p][i] - vertices[q][i]).abs()).fold(0.0, f64::max)
        };
        triangles.push([(0, 1), (1, 2), (2, 0)].map(size).into_iter().fold(0.0, f64::max));
        for side in sides {
            edge = [edge[0].min(side), edge[1].max(side)];
        }
        min_angle = min_angle.min(angle);
        let sizes = vertices.iter().flatten().map(|x| x.abs());
        coordinates = sizes.fold(coordinates, f64::max);
    }
    if edge[1] == 0.0 {
        return Err(InputError::of(path, "no triangle with an area").into());
    }
    // Origins are up to the distance away from the vertices.
    let coordinates = coordinates + distance;
    Ok((Scene { coordinates, edge, distance, min_angle, grazing }, triangles))
}

/// A scene's words.
pub fn scene_text(scene: &Scene) -> String {
    let short = |x: f64| format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').to_owned();
    let digits = |x: f64| if x < 0.001 { format!("{x:.2e}") } else { short(x) };
    let Scene { coordinates, edge: [low, high], distance, min_angle, grazing } = *scene;
    let [coordinates, low, high, distance, min_angle, grazing] =
        [coordinates, low, high, distance, min_angle, grazing].map(digits);
    format!(
        "coordinates up to {coordinates}, edges from {low} to {high}, origins up to {distance} from the \
         vertices, angles of {min_angle} degrees and more, rays at {grazing} degrees to the plane and more, |d| <= 1"
    )
}
