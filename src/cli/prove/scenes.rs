//! Scenes that something is proved in: how flags name them, the scene that a mesh is, and their words.

use super::ProveArguments;
use crate::audit::shell_word;
use crate::case;
use crate::cli::exit::Failure;
use crate::cli::input::read_mesh;
use crate::cli::sources::about_scene;
use crate::files::InputError;
use crate::prove::{Scene, Shape};

impl ProveArguments {
    /// The scene, and the sizes and areas of its triangles.
    pub fn scene(&self) -> Result<(Option<Scene>, Vec<Shape>), Failure> {
        if let Some(path) = &self.mesh {
            let distance = self.distance.expect("required by --mesh");
            let (scene, shapes) = mesh_scene(path, distance, self.grazing, self.output.quiet)?;
            return Ok((Some(scene), shapes));
        }
        if let Some(text) = &self.scene {
            let (scene, _) = case::Scene::parse(text).map_err(about_scene)?;
            let scene = Scene::of(&scene).map_err(about_scene)?;
            let scene = Scene {
                min_angle: self.min_angle,
                grazing: self.grazing,
                ..scene
            };
            return Ok((
                Some(scene),
                scene.domain().map_or(Vec::new(), |_| scene.shapes()),
            ));
        }
        let Some(edge) = self.edge else {
            return match self.distance {
                Some(_) => Err(Failure::usage(
                    "--distance needs --coordinates and --edge, or --mesh",
                )),
                None => Ok((None, Vec::new())),
            };
        };
        let Some(coordinates) = self.coordinates else {
            return Err(Failure::usage(
                "--edge needs --coordinates: how far from 0 the scene reaches",
            ));
        };
        let distance = self.distance.unwrap_or(2.0 * coordinates);
        let (min_angle, grazing) = (self.min_angle, self.grazing);
        let (is_of_longest, shape) = (false, None);
        let scene = Scene {
            coordinates,
            edge,
            is_of_longest,
            distance,
            min_angle,
            grazing,
            shape,
        };
        let shapes = scene.domain().map_or(Vec::new(), |_| scene.shapes());
        Ok((Some(scene), shapes))
    }

    /// The flags of `epsilon` that choose rays in such a scene.
    pub fn rays(&self) -> String {
        match (&self.scene, &self.mesh) {
            (Some(scene), _) => format!("--scene {}", shell_word(scene)),
            (None, Some(mesh)) => format!("--mesh {}", shell_word(mesh)),
            _ => match (self.coordinates, self.edge) {
                (Some(coordinates), Some([low, high])) => {
                    let distance = self.distance.unwrap_or(2.0 * coordinates);
                    let extent = coordinates.max(high);
                    format!("--scene extent={extent},edge={low}..{high},distance=0..{distance}")
                }
                _ => "--scene room".to_owned(),
            },
        }
    }
}

/// `0.01..10`, or one number for both.
pub fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| {
        text.trim()
            .parse()
            .map_err(|_| format!("'{text}' is no number"))
    };
    Ok([number(low)?, number(high)?])
}

/// `1`, or `1deg`.
pub fn degrees(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches("deg").trim();
    number
        .parse()
        .map_err(|_| format!("'{text}' is no angle in degrees"))
}

/// The scene that a mesh is, and of each triangle the largest coordinate of its edges and twice its area
/// (infinite where there is none: no ray hits it).
pub fn mesh_scene(
    path: &str,
    distance: f64,
    grazing: f64,
    quiet: bool,
) -> Result<(Scene, Vec<Shape>), Failure> {
    let mut shapes = Vec::new();
    let mesh = read_mesh(path, quiet)?;
    let mut edge = [f64::INFINITY, 0.0f64];
    let (mut min_angle, mut coordinates) = (60.0f64, 0.0f64);
    for triangle in 0..mesh.triangles.len() {
        let (mut size, mut shape) = (0.0f64, f64::INFINITY);
        // As the mesh is in either scalar.
        let of_f32 = mesh
            .vertices::<f32>(triangle)
            .map(|vertex| vertex.map(f64::from));
        for vertices in [mesh.vertices::<f64>(triangle), of_f32] {
            let side = |i: usize| {
                let (p, q) = (vertices[i], vertices[(i + 1) % 3]);
                [0, 1, 2].map(|axis| q[axis] - p[axis])
            };
            let sides = [side(0), side(1), side(2)];
            let lengths = sides.map(|side| side.iter().map(|x| x * x).sum::<f64>().sqrt());
            let area = Scene::twice_area(&vertices);
            size = sides
                .iter()
                .flatten()
                .fold(size, |most, x| most.max(x.abs()));
            coordinates = vertices
                .iter()
                .flatten()
                .fold(coordinates, |most, x| most.max(x.abs()));
            let longest = lengths.into_iter().fold(0.0, f64::max);
            edge[1] = edge[1].max(longest);
            if area > 0.0 {
                shape = shape.min(area);
                edge[0] = edge[0].min(longest);
                let angle = (0..3).map(|i| (area / (lengths[i] * lengths[(i + 1) % 3])).min(1.0));
                let angle = angle.fold(1.0, f64::min).asin().to_degrees();
                min_angle = min_angle.min(angle);
            }
        }
        shapes.push((size, shape));
    }
    let shape = shapes
        .iter()
        .map(|(_, shape)| *shape)
        .fold(f64::INFINITY, f64::min);
    if !shape.is_finite() {
        return Err(InputError::of(path, "no triangle with an area").into());
    }
    // Origins are up to the distance away from the vertices.
    let coordinates = coordinates + distance;
    // As `epsilon --mesh` has them.
    let (is_of_longest, shape) = (true, Some(shape));
    let scene = Scene {
        coordinates,
        edge,
        is_of_longest,
        distance,
        min_angle,
        grazing,
        shape,
    };
    Ok((scene, shapes))
}

/// A scene's words.
pub fn scene_text(scene: &Scene) -> String {
    let short = |x: f64| {
        format!("{x:.4}")
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    };
    let is_plain = |x: f64| (0.001..1e7).contains(&x);
    let digits = |x: f64| {
        if is_plain(x) {
            short(x)
        } else {
            format!("{x:.2e}")
        }
    };
    let Scene {
        coordinates,
        edge: [low, high],
        distance,
        min_angle,
        grazing,
        ..
    } = *scene;
    let [coordinates, low, high, distance, min_angle, grazing] =
        [coordinates, low, high, distance, min_angle, grazing].map(digits);
    let edges = if scene.is_of_longest {
        "each triangle's longest edge"
    } else {
        "every edge"
    };
    format!(
        "coordinates up to {coordinates}, {edges} from {low} to {high}, origins up to {distance} from the \
         vertices, angles from {min_angle}°, rays at {grazing}° to the plane and more with |d| = 1, t_min and t_max \
         up to {distance}; where a kernel divides to get t, u or v, exact |t| up to {distance}, |u|, |v| and |1-u-v| up to 1"
    )
}
