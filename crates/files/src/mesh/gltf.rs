//! glTF 2.0, text or GLB: the triangles of one scene, each where its node puts it.
//!
//! The crate gltf reads and checks the JSON. Buffers are read here, with every sum of offsets checked.

mod buffers;
mod transforms;

use super::builder::{FilePlace, MeshBuilder};
use super::counted::ReadLimits;
use super::{InputError, Mesh, PlacedPart};
use buffers::Buffers;
use glam::DAffine3;
use gltf::json;
use gltf::json::validation::Checked;
use gltf::mesh::{Mode, Semantic};
use gltf::{Accessor, Document, Glb, Node, Primitive};
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Read;
use std::mem;
use transforms::{mirrors, placed, rows, transform_of};

/// The first bytes of a GLB file.
pub(super) const MAGIC: &[u8] = b"glTF";

/// Reads a file. Buffers in other files are read with `beside`.
pub(super) fn read(
    mut reader: impl Read,
    name: &str,
    limits: ReadLimits,
    beside: &mut super::ReadBeside,
) -> Result<Mesh, InputError> {
    let mut bytes = Vec::new();
    reader
        .read_to_end(&mut bytes)
        .map_err(|error| InputError::reading(name, None, &error))?;
    let size = bytes.len();
    let (root, binary) = parse(&bytes, name)?;
    drop(bytes);
    let mut mesh = MeshBuilder::without_lines();
    let root = stripped(root, &mut mesh).map_err(|message| InputError::of(name, message))?;
    let document = Document::from_json(root).map_err(|error| InputError::of(name, said(&error)))?;
    let buffers = Buffers::new(name, binary, size, beside);
    let mut reader = GltfReader {
        name,
        limits,
        mesh,
        buffers,
        groups: 0,
    };
    reader.walk(&document)?;
    reader.mesh.finish(name, reader.groups)
}

/// The JSON, and the binary part of a GLB file.
fn parse(bytes: &[u8], name: &str) -> Result<(json::Root, Option<Vec<u8>>), InputError> {
    let bad = |message: String| InputError::of(name, message);
    let is_binary = bytes.starts_with(MAGIC);
    let (text, binary) = if is_binary {
        let bytes = &bytes[..length_of(bytes).map_err(bad)?];
        let glb = Glb::from_slice(bytes).map_err(|error| bad(format!("not GLB: {error}")))?;
        (glb.json, glb.bin.map(Cow::into_owned))
    } else {
        (Cow::Borrowed(bytes), None)
    };
    let text = str::from_utf8(&text).map_err(|_| bad("its JSON is not UTF-8".to_owned()))?;
    let root: json::Root = json::deserialize::from_str(text).map_err(|error| {
        let line = (!is_binary)
            .then_some(error.line())
            .filter(|line| *line > 0);
        InputError {
            line,
            ..bad(format!("not glTF: {error}"))
        }
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = crate::json::quoted(&root.asset.version);
        return Err(bad(format!("glTF of version {version}, expected 2.0")));
    }
    root.extensions_required
        .iter()
        .try_for_each(|name| check_extension(name))
        .map_err(bad)?;
    Ok((root, binary))
}

/// How long a GLB file says that it is: at most as long as it is, and at least the headers of the file and of its JSON.
fn length_of(bytes: &[u8]) -> Result<usize, String> {
    let length = bytes
        .get(8..12)
        .and_then(|length| length.try_into().ok())
        .map(u32::from_le_bytes);
    match length {
        Some(length) if length >= 20 && length as usize <= bytes.len() => Ok(length as usize),
        Some(length) => {
            let short = if length < 20 {
                " (headers alone have 20)"
            } else {
                ""
            };
            Err(format!(
                "the file has {} bytes, but its header says {length}{short}",
                bytes.len()
            ))
        }
        None => Err(format!(
            "the file has {} of the 12 bytes of a GLB header",
            bytes.len()
        )),
    }
}

/// Refuses what changes the geometry in ways that are not read.
fn check_extension(name: &str) -> Result<(), String> {
    let harmless = [
        "KHR_materials_",
        "KHR_texture_",
        "EXT_texture_",
        "MSFT_texture_",
        "KHR_lights_",
    ];
    if harmless.iter().any(|start| name.starts_with(start)) {
        return Ok(());
    }
    let about = match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "compressed meshes are not read: export it without compression"
        }
        "KHR_mesh_quantization" => "quantised positions are not read: export it with floats",
        "EXT_mesh_gpu_instancing" => "instances are not read: export each as a node",
        _ => "hairline does not know it",
    };
    Err(format!(
        "the file needs the extension {}: {about}",
        crate::json::quoted(name)
    ))
}

/// Leaves away what does not concern triangles, so that a fault in it is none here.
fn stripped(mut root: json::Root, mesh: &mut MeshBuilder) -> Result<json::Root, String> {
    root.extensions_required.clear();
    if root
        .extensions_used
        .iter()
        .any(|name| name == "EXT_mesh_gpu_instancing")
    {
        mesh.note("instances (EXT_mesh_gpu_instancing) not made", None);
    }
    root.animations.clear();
    root.cameras.clear();
    root.images.clear();
    root.materials.clear();
    root.samplers.clear();
    root.textures.clear();
    root.skins.clear();
    for accessor in &mut root.accessors {
        // They have to be there, but are not used.
        accessor.min = Some(json::Value::from(vec![0; 3]));
        accessor.max = accessor.min.clone();
    }
    for node in &mut root.nodes {
        node.camera = None;
        if node.skin.take().is_some() {
            mesh.note("skins left out: meshes as they are without", None);
        }
    }
    let accessors = root.accessors.len();
    for primitive in root.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        let positions = primitive
            .attributes
            .get(&Checked::Valid(Semantic::Positions));
        if let Some(index) = positions
            .map(|index| index.value())
            .filter(|i| *i >= accessors)
        {
            // The crate would panic.
            return Err(format!(
                "a primitive has its positions in accessors[{index}], of {accessors}"
            ));
        }
        primitive.material = None;
        primitive
            .attributes
            .retain(|name, _| *name == Checked::Valid(Semantic::Positions));
        if primitive.targets.take().is_some() {
            mesh.note("morph targets left out", None);
        }
    }
    Ok(root)
}

/// The first thing that is wrong.
fn said(error: &gltf::Error) -> String {
    match error {
        gltf::Error::Validation(errors) => match errors.first() {
            Some((path, error)) => format!("{path}: {error}"),
            None => "not glTF".to_owned(),
        },
        error => error.to_string(),
    }
}

/// How many triangles a file of any size may have. Nodes can place one mesh any number of times, so a larger file may have one
/// triangle for each of its bytes: one that is placed once takes more than a byte.
const TRIANGLES_OF_ANY_FILE: usize = 2_000_000;

struct GltfReader<'a> {
    name: &'a str,
    limits: ReadLimits,
    mesh: MeshBuilder,
    buffers: Buffers<'a>,
    groups: usize,
}

impl GltfReader<'_> {
    fn error<T>(&self, message: String) -> Result<T, InputError> {
        Err(InputError::of(self.name, message))
    }

    /// Adds the meshes of the default scene, or of the first one, or of all nodes if there is no scene.
    fn walk(&mut self, document: &Document) -> Result<(), InputError> {
        let scene = document
            .default_scene()
            .or_else(|| document.scenes().next());
        let mut waiting: Vec<(Node, DAffine3)> = match scene {
            Some(scene) => scene
                .nodes()
                .map(|node| (node, DAffine3::IDENTITY))
                .collect(),
            None => {
                let mut is_root = vec![true; document.nodes().len()];
                for node in document.nodes() {
                    node.children()
                        .for_each(|child| is_root[child.index()] = false);
                }
                let roots = document.nodes().filter(|node| is_root[node.index()]);
                roots.map(|node| (node, DAffine3::IDENTITY)).collect()
            }
        };
        waiting.reverse();
        let mut seen = vec![false; document.nodes().len()];
        while let Some((node, above)) = waiting.pop() {
            if mem::replace(&mut seen[node.index()], true) {
                return self.error(format!("nodes[{}] has two parents", node.index()));
            }
            let local = transform_of(&node.transform());
            let Some(transform) = local.map(|local| above * local) else {
                let expected = "expected a matrix whose last row is 0 0 0 1";
                return self.error(format!("nodes[{}].matrix: {expected}", node.index()));
            };
            if let Some(mesh) = node.mesh() {
                let before = self.mesh.triangles();
                self.add_mesh(&mesh, &transform)?;
                self.groups += usize::from(self.mesh.triangles() > before);
            }
            let below = waiting.len();
            waiting.extend(node.children().map(|child| (child, transform)));
            waiting[below..].reverse();
        }
        Ok(())
    }

    fn add_mesh(&mut self, mesh: &gltf::Mesh, transform: &DAffine3) -> Result<(), InputError> {
        if *transform != DAffine3::IDENTITY {
            self.mesh.placed.push(PlacedPart {
                matrix: rows(transform),
                first: self.mesh.vertices() as u32,
                vertices: Vec::new(),
            });
        }
        // Where the vertices of each accessor begin: primitives may share them.
        let mut starts = HashMap::new();
        for primitive in mesh.primitives() {
            let place = format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
            use Mode::{TriangleFan, TriangleStrip, Triangles};
            if !matches!(primitive.mode(), Triangles | TriangleStrip | TriangleFan) {
                self.mesh
                    .note("primitives of lines and points skipped", None);
                continue;
            }
            let Some(positions) = primitive.get(&Semantic::Positions) else {
                continue;
            };
            let start = match starts.get(&positions.index()) {
                Some(start) => *start,
                None => {
                    let start = self.mesh.vertices() as u32;
                    self.add_vertices(&positions, transform, &place)?;
                    starts.insert(positions.index(), start);
                    start
                }
            };
            self.add_triangles(&primitive, start, positions.count(), transform, &place)?;
        }
        Ok(())
    }

    fn add_vertices(
        &mut self,
        accessor: &Accessor,
        transform: &DAffine3,
        place: &str,
    ) -> Result<(), InputError> {
        use gltf::accessor::{DataType, Dimensions};
        let kind = (accessor.dimensions(), accessor.data_type());
        if kind != (Dimensions::Vec3, DataType::F32) {
            return self.error(format!(
                "{place}: positions are {kind:?}, expected (Vec3, F32)"
            ));
        }
        let limit = self.limits.elements;
        if accessor.count() > limit - self.mesh.vertices().min(limit) {
            return self.error(format!("{place}: more than {limit} vertices"));
        }
        let bytes = self.buffers.elements(accessor)?;
        for (index, position) in bytes.as_chunks::<12>().0.iter().enumerate() {
            let coordinates = position.as_chunks::<4>().0;
            let local = [0, 1, 2].map(|axis| f32::from_le_bytes(coordinates[axis]));
            let wide = placed(transform, local);
            if let Some(number) = wide.iter().find(|number| !number.is_finite()) {
                return self.error(format!(
                    "{place}: vertex {index} has {number}, which is not finite"
                ));
            }
            if *transform != DAffine3::IDENTITY
                && let Some(part) = self.mesh.placed.last_mut()
            {
                part.vertices.push(local);
            }
            let place = FilePlace::Vertex(self.mesh.vertices() + 1);
            self.mesh
                .vertex(wide, wide.map(|number| number as f32), place);
        }
        Ok(())
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        start: u32,
        vertices: usize,
        transform: &DAffine3,
        place: &str,
    ) -> Result<(), InputError> {
        let count = primitive
            .indices()
            .map_or(vertices, |indices| indices.count());
        let triangles = match primitive.mode() {
            Mode::Triangles if !count.is_multiple_of(3) => {
                return self.error(format!(
                    "{place}: {count} corners, expected a multiple of 3"
                ));
            }
            Mode::Triangles => count / 3,
            _ => count.saturating_sub(2),
        };
        let limit = self.limits.elements;
        if triangles > limit - self.mesh.triangles().min(limit) {
            return self.error(format!("{place}: more than {limit} triangles"));
        }
        let bytes = self.buffers.bytes();
        let limit = bytes.max(TRIANGLES_OF_ANY_FILE);
        if self.mesh.triangles() + triangles > limit {
            return self.error(format!(
                "{place}: more than {limit} triangles, of {bytes} bytes: meshes are placed too often"
            ));
        }
        let indices = match primitive.indices() {
            Some(accessor) => self.indices(&accessor, vertices, place)?,
            None => (0..vertices as u32).collect(),
        };
        for i in 0..triangles {
            let [a, mut b, mut c] = match primitive.mode() {
                Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
                Mode::TriangleFan => [0, i + 1, i + 2],
                _ => [3 * i, 3 * i + 1, 3 * i + 2],
            };
            if mirrors(transform) {
                mem::swap(&mut b, &mut c);
            }
            let number = self.mesh.triangles() as u32 + 1;
            self.mesh
                .face(&[a, b, c].map(|corner| start + indices[corner]), number);
        }
        Ok(())
    }

    /// Indices below the number of vertices.
    fn indices(
        &mut self,
        accessor: &Accessor,
        vertices: usize,
        place: &str,
    ) -> Result<Vec<u32>, InputError> {
        use gltf::accessor::{DataType, Dimensions};
        let bytes = self.buffers.elements(accessor)?;
        let indices: Vec<u32> = match (accessor.dimensions(), accessor.data_type()) {
            (Dimensions::Scalar, DataType::U8) => bytes.into_iter().map(u32::from).collect(),
            (Dimensions::Scalar, DataType::U16) => {
                let words = bytes.as_chunks().0.iter();
                words
                    .map(|word| u32::from(u16::from_le_bytes(*word)))
                    .collect()
            }
            (Dimensions::Scalar, DataType::U32) => bytes
                .as_chunks()
                .0
                .iter()
                .map(|word| u32::from_le_bytes(*word))
                .collect(),
            kind => {
                let expected = "expected (Scalar, U8), (Scalar, U16) or (Scalar, U32)";
                return self.error(format!("{place}: indices are {kind:?}, {expected}"));
            }
        };
        match indices.iter().position(|index| *index as usize >= vertices) {
            Some(at) => {
                let count = super::builder::vertices_text(vertices);
                let index = indices[at];
                self.error(format!(
                    "{place}: corner {at} names vertex {index}, but there are {count}"
                ))
            }
            None => Ok(indices),
        }
    }
}
