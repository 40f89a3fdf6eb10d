//! Files that the user names: meshes, rays.

use crate::failure::Failure;
use crate::structure::Triangle;
use hairline_files::mesh::{self, Mesh};
use hairline_rays::{RaysScalar, Text};
use hairline_scene::Ray;
use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::Path;

/// Reads a mesh. An error also if a number is beyond the range of f32, which is all that a GPU takes.
pub fn read_mesh(path: &str) -> Result<Mesh, Failure> {
    let file = BufReader::new(open(path)?);
    let mut file_beside = |name: &str, most: u64| {
        let beside = Path::new(path).with_file_name(name);
        // The mesh names it, not the user: no pipe, no device.
        if !fs::metadata(&beside)?.is_file() {
            return Err(io::Error::other("not a file"));
        }
        let mut bytes = Vec::new();
        File::open(beside)?.take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let mesh = mesh::read(file, path, &mut file_beside, &mut |_| {})?;
    let is_finite = |vertex: &[f32; 3]| vertex.iter().all(|x| x.is_finite());
    match mesh.positions_f32.iter().all(is_finite) {
        true => Ok(mesh),
        false => Err(Failure::data(format!(
            "{path}: a coordinate is beyond the range of f32, the only numbers that a GPU takes"
        ))),
    }
}

/// The triangles of a mesh, in the order of its faces.
pub fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let faces = 0..mesh.triangles.len();
    faces.map(|face| mesh.vertices(face)).collect()
}

/// Reads rays as `hairline rays` does. An error also if one is none that a GPU may be asked about.
pub fn read_rays(path: &str) -> Result<Vec<Ray<f32>>, Failure> {
    let bytes = Box::new(open(path)?);
    let rays = f32::rays_of(Text { name: path, bytes })?;
    match rays.iter().position(|ray| ray.t_min < 0.0) {
        None => Ok(rays),
        Some(index) => Err(Failure::data(format!(
            "{path}: ray {index} begins at a t_min below 0, which Vulkan, DXR and Metal do not allow"
        ))),
    }
}

/// Reads a text file whole.
pub fn read_text(path: &str) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|error| Failure::of_file(path, &error))
}

fn open(path: &str) -> Result<File, Failure> {
    File::open(path).map_err(|error| Failure::of_file(path, &error))
}
