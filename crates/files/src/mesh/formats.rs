//! Which format a file of a mesh has, and its reader.

use super::counted::{Counted, LIMITS, ReadLimits};
use super::{InputError, Mesh, gltf, obj, ply, stl};
use std::io::{self, BufRead, Read};

/// Reads at most so many bytes of a file in the folder of the mesh's own.
pub type ReadBeside<'a> = dyn FnMut(&str, u64) -> io::Result<Vec<u8>> + 'a;

/// Reads an OBJ, PLY, STL or glTF file (text or GLB). The name's extension says which; if it says nothing, the
/// first bytes do, and what is none of the others is read as OBJ. `beside` reads the buffers that a glTF file
/// has in files of their own. `name` is for messages and for [`Mesh::name`]; `progress` is called about every MiB
/// with the number of bytes read so far, and once at the end.
///
/// Materials, normals and textures are ignored; anything else that is not read gets a note. Polygons are cut into the fan
/// from their first vertex. Where that fan folds over itself or is bent by a right angle or more, as those of many concave
/// ones do, one ear after the other is cut off. Those for which this does not do either, because they cross themselves, are
/// left out with a note. Triangles without area are kept with a note.
///
/// It is an error if the file cannot be read, ends early or has a line above 1 MiB; if a number is malformed or not finite
/// in `f64`; if a face has fewer than three vertices, or one that the file does not have; if there are no vertices or no
/// triangles, or more than 100 million of either; if it names a file outside its folder or on the network; and if it
/// needs a glTF extension that changes geometry (compressed or quantised meshes, instances).
pub fn read<R: BufRead>(
    reader: R,
    name: &str,
    beside: &mut ReadBeside,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    read_within(reader, name, LIMITS, beside, progress)
}

pub(super) fn read_within<R: BufRead>(
    reader: R,
    name: &str,
    limits: ReadLimits,
    beside: &mut ReadBeside,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    let mut reader = Counted::new(reader, progress);
    let mut head = Vec::new();
    let format = match MeshFormat::of_extension(name) {
        Some(Ok(format)) => format,
        Some(Err(other)) => {
            let message =
                format!("{other} files are not read: convert it to PLY, OBJ, STL or glTF");
            return Err(InputError::of(name, message));
        }
        None => {
            let start = (&mut reader).take(HEAD).read_to_end(&mut head);
            start.map_err(|error| InputError::reading(name, None, &error))?;
            MeshFormat::of_content(&head)
        }
    };
    let whole = head.as_slice().chain(&mut reader);
    let mesh = match format {
        MeshFormat::Obj => obj::read(whole, name, limits),
        MeshFormat::Ply => ply::read(whole, name, limits),
        MeshFormat::Stl => stl::read(whole, name, limits),
        MeshFormat::Gltf => gltf::read(whole, name, limits, beside),
    }?;
    reader.finish();
    Ok(mesh)
}

/// Bytes that tell a format.
const HEAD: u64 = 84;

/// The extensions of other formats of meshes.
const OTHERS: &[&str] = &[
    "3ds", "3mf", "abc", "amf", "blend", "dae", "fbx", "ifc", "iges", "igs", "max", "mesh", "msh",
    "off", "step", "stp", "usd", "usda", "usdc", "usdz", "vrml", "vtk", "vtp", "vtu", "wrl", "x3d",
    "xyz",
];

enum MeshFormat {
    Obj,
    Ply,
    /// Text or binary.
    Stl,
    /// Text or GLB.
    Gltf,
}

impl MeshFormat {
    /// An error with the extension if it is that of another format; none if it says nothing.
    fn of_extension(name: &str) -> Option<Result<MeshFormat, String>> {
        let (_, extension) = name.rsplit_once('.')?;
        let extension = extension.to_ascii_lowercase();
        match extension.as_str() {
            "obj" => Some(Ok(MeshFormat::Obj)),
            "ply" => Some(Ok(MeshFormat::Ply)),
            "stl" => Some(Ok(MeshFormat::Stl)),
            "gltf" | "glb" => Some(Ok(MeshFormat::Gltf)),
            other => OTHERS.contains(&other).then_some(Err(extension)),
        }
    }

    fn of_content(head: &[u8]) -> MeshFormat {
        let text = head.trim_ascii_start();
        if head.starts_with(b"ply\n") || head.starts_with(b"ply\r") {
            MeshFormat::Ply
        } else if head.starts_with(gltf::MAGIC) || text.starts_with(b"{") {
            MeshFormat::Gltf
        } else if stl::is_text(head) || head.contains(&0) {
            // An OBJ file is text.
            MeshFormat::Stl
        } else {
            MeshFormat::Obj
        }
    }
}
