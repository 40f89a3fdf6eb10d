//! Writers of meshes that share nothing with the readers.

use serde_json::{Value, json};

/// A mesh with numbers that `f32` holds.
#[derive(Clone)]
pub struct Solid {
    pub vertices: Vec<[f32; 3]>,
    pub faces: Vec<[u32; 3]>,
}

/// A closed surface of eight triangles, one vertex that no face uses, and one twice, as at a seam.
pub fn solid() -> Solid {
    let vertices = [
        [0.9, 0.1, 0.0],
        [-1.1, 0.0, 0.1],
        [0.0, 1.3, -0.1],
        [0.1, -0.7, 0.0],
        [0.0, 0.1, 1.0],
        [-0.1, 0.0, -0.8],
        [7.0, 7.0, 7.0],
        [0.9, 0.1, 0.0],
    ];
    let faces = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 7, 5],
        [1, 2, 5],
        [3, 1, 5],
        [7, 3, 5],
    ];
    Solid {
        vertices: vertices.to_vec(),
        faces: faces.to_vec(),
    }
}

impl Solid {
    pub fn obj(&self) -> Vec<u8> {
        let mut text = String::new();
        for [x, y, z] in self.vertices.iter().map(|vertex| vertex.map(f64::from)) {
            text += &format!("v {x} {y} {z}\n");
        }
        for [a, b, c] in self.faces.iter().map(|face| face.map(|corner| corner + 1)) {
            text += &format!("f {a} {b} {c}\n");
        }
        text.into_bytes()
    }

    /// With elements and properties that are no one's business here.
    pub fn ply(&self, encoding: &str, coordinate: &str, count: &str, index: &str) -> Vec<u8> {
        let mut ply = Ply::new(encoding);
        ply.header(&format!(
            "comment a solid\nelement vertex {}",
            self.vertices.len()
        ));
        ply.header(&format!(
            "property uchar red\nproperty {coordinate} x\nproperty {coordinate} y"
        ));
        ply.header(&format!(
            "property {coordinate} z\nelement material 1\nproperty list int short id"
        ));
        ply.header(&format!(
            "element face {}\nproperty float32 quality",
            self.faces.len()
        ));
        ply.header(&format!("property list {count} {index} vertex_indices"));
        ply.header("element edge 2\nproperty int vertex1\nend_header");
        for vertex in &self.vertices {
            ply.number("uchar", 255.0);
            vertex
                .iter()
                .for_each(|number| ply.number(coordinate, f64::from(*number)));
            ply.end();
        }
        for (kind, number) in [("int", 2.0), ("short", -1.0), ("short", 5.0)] {
            ply.number(kind, number);
        }
        ply.end();
        for face in &self.faces {
            ply.number("float32", 0.5);
            ply.number(count, 3.0);
            face.iter()
                .for_each(|corner| ply.number(index, f64::from(*corner)));
            ply.end();
        }
        for number in [3.0, -4.0] {
            ply.number("int", number);
            ply.end();
        }
        ply.bytes
    }

    /// An ASCII STL file.
    pub fn stl_text(&self) -> Vec<u8> {
        let mut text = "solid caf\u{e9} of names\n".to_owned();
        for face in &self.faces {
            text += "  facet normal 0 0 0\n    outer loop\n";
            for [x, y, z] in face.map(|corner| self.vertices[corner as usize]) {
                text += &format!("      vertex {x:?} {y:e} {z:?}\n");
            }
            text += "    endloop\n  endfacet\n";
        }
        (text + "endsolid caf\u{e9} of names\n").into_bytes()
    }

    /// A binary one, whose header begins with these bytes.
    pub fn stl_binary(&self, title: &[u8]) -> Vec<u8> {
        let mut bytes = title.to_vec();
        bytes.resize(80, b' ');
        bytes.extend((self.faces.len() as u32).to_le_bytes());
        for face in &self.faces {
            bytes.extend([0; 12]);
            for corner in face.map(|corner| self.vertices[corner as usize]) {
                corner
                    .iter()
                    .for_each(|number| bytes.extend(number.to_le_bytes()));
            }
            bytes.extend([0; 2]);
        }
        bytes
    }

    /// Positions, then indices of two bytes.
    pub fn buffer(&self) -> Vec<u8> {
        let numbers = self
            .vertices
            .iter()
            .flatten()
            .flat_map(|number| number.to_le_bytes());
        let indices = self
            .faces
            .iter()
            .flatten()
            .flat_map(|corner| (*corner as u16).to_le_bytes());
        numbers.chain(indices).collect()
    }

    /// One node with one mesh, whose buffer is in a file, in the text or in a GLB file.
    pub fn document(&self, uri: Option<String>) -> Value {
        let (vertices, corners) = (self.vertices.len(), self.faces.len() * 3);
        let mut buffer = json!({ "byteLength": self.buffer().len() });
        if let Some(uri) = uri {
            buffer["uri"] = json!(uri);
        }
        json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": vertices },
                { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": corners },
            ],
            "bufferViews": [
                { "buffer": 0, "byteOffset": 0, "byteLength": vertices * 12 },
                { "buffer": 0, "byteOffset": vertices * 12, "byteLength": corners * 2 },
            ],
            "buffers": [buffer],
        })
    }

    pub fn gltf(&self) -> Vec<u8> {
        serde_json::to_vec_pretty(&self.document(Some(data_uri(&self.buffer())))).unwrap()
    }

    pub fn glb(&self) -> Vec<u8> {
        glb(&self.document(None), &self.buffer())
    }
}

pub fn glb(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut buffer = buffer.to_vec();
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = |length: usize| (length as u32).to_le_bytes();
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(length(12 + 8 + json.len() + 8 + buffer.len()));
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", buffer)] {
        file.extend(length(chunk.len()));
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

pub fn data_uri(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = "data:application/octet-stream;base64,".to_owned();
    for three in bytes.chunks(3) {
        let byte = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = char::from(DIGITS[(bits >> (18 - 6 * i)) as usize % 64]);
            text.push(if i <= three.len() { digit } else { '=' });
        }
    }
    text
}

/// A PLY file that is being written.
pub struct Ply {
    encoding: String,
    pub bytes: Vec<u8>,
}

impl Ply {
    pub fn new(encoding: &str) -> Ply {
        let bytes = format!("ply\nformat {encoding} 1.0\n").into_bytes();
        Ply {
            encoding: encoding.to_owned(),
            bytes,
        }
    }

    pub fn header(&mut self, lines: &str) {
        self.bytes.extend(lines.bytes());
        self.bytes.push(b'\n');
    }

    pub fn number(&mut self, kind: &str, number: f64) {
        if self.encoding == "ascii" {
            return self.bytes.extend(format!("{number} ").bytes());
        }
        let mut bytes = match kind {
            "char" | "int8" => (number as i8).to_le_bytes().to_vec(),
            "uchar" | "uint8" => (number as u8).to_le_bytes().to_vec(),
            "short" | "int16" => (number as i16).to_le_bytes().to_vec(),
            "ushort" | "uint16" => (number as u16).to_le_bytes().to_vec(),
            "int" | "int32" => (number as i32).to_le_bytes().to_vec(),
            "uint" | "uint32" => (number as u32).to_le_bytes().to_vec(),
            "float" | "float32" => (number as f32).to_le_bytes().to_vec(),
            _ => number.to_le_bytes().to_vec(),
        };
        if self.encoding == "binary_big_endian" {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    pub fn end(&mut self) {
        if self.encoding == "ascii" {
            self.bytes.push(b'\n');
        }
    }
}
