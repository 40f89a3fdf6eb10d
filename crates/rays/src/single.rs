//! One ray against one face of a mesh, or against a box.

use crate::audit::quoted;
use crate::case::Case;
use crate::corpus::lines::{AnyCase, bare_case};
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use hairline_boxes::BoxCase;
use hairline_scene::{Location, Ray};

/// The ray against a face.
pub fn case_of<F: Scalar>(mesh: &Mesh, ray: &Ray<F>, face: u32) -> Case<F> {
    let triangle = mesh.vertices(face as usize);
    Case::<F>::new(ray.origin, ray.direction, triangle).on(ray.t_min, ray.t_max)
}

/// The ray against the box around some points, one at least.
pub fn box_case<F: Scalar>(ray: &Ray<F>, points: &[[F; 3]]) -> BoxCase<F> {
    BoxCase::new(ray.origin, ray.direction, around(points)).on(ray.t_min, ray.t_max)
}

/// The least and the greatest corner of the box around some points, one at least.
pub fn around<F: Scalar>(points: &[[F; 3]]) -> [[F; 3]; 2] {
    let mut min = points[0];
    let mut max = points[0];
    for point in points {
        for axis in 0..3 {
            if point[axis] < min[axis] {
                min[axis] = point[axis];
            }
            if max[axis] < point[axis] {
                max[axis] = point[axis];
            }
        }
    }
    [min, max]
}

/// The command that shows the ray and a face.
pub fn explain_command<F: Scalar>(mesh: &Mesh, ray: &Ray<F>, face: u32) -> String
where
    Case<F>: Into<AnyCase>,
{
    let case = case_of(mesh, ray, face);
    format!("hairline explain {}", quoted(&bare_case(case)))
}

/// Faces in words, so many at most.
pub fn faces_in_words(faces: &[u32], most: usize) -> String {
    let shown = faces.iter().take(most);
    let mut words: Vec<String> = shown.map(u32::to_string).collect();
    if most < faces.len() {
        words.push(format!("{} more", faces.len() - most));
    }
    match faces.len() {
        1 => format!("face {}", words[0]),
        _ => format!("faces {}", words.join(", ")),
    }
}

/// The place of a point in a word.
pub fn place_name(location: &Location) -> &'static str {
    match location {
        Location::On(_) => "on",
        Location::NotDefined(_) => "not defined",
        Location::Off(winding) if winding.is_zero() => "outside",
        Location::Off(_) => "inside",
    }
}

/// Numbers of faces, one after the other.
pub fn joined(faces: &[u32]) -> String {
    let words: Vec<String> = faces.iter().map(u32::to_string).collect();
    words.join(" ")
}
