//! What glTF can say: nodes, kinds of primitives, buffers and their faults.

use super::*;

/// The solid's document, changed, as GLB with its buffer.
fn changed(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let solid = solid();
    let mut document = solid.document(None);
    change(&mut document);
    glb(&document, &solid.buffer())
}

/// As `changed`, with bytes after the solid's in the buffer. They begin at 144.
fn extended(more: &[u8], change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let solid = solid();
    let mut document = solid.document(None);
    let buffer = [solid.buffer(), more.to_vec()].concat();
    assert_eq!(solid.buffer().len(), 144);
    document["buffers"][0]["byteLength"] = json!(buffer.len());
    let view = json!({ "buffer": 0, "byteOffset": 144, "byteLength": more.len() });
    document["bufferViews"].as_array_mut().unwrap().push(view);
    change(&mut document);
    glb(&document, &buffer)
}

#[test]
fn nodes_put_meshes_where_they_belong() {
    let plain = mesh_of("a.glb", &solid().glb());
    // A quarter turn around z, twice as large, then moved, below a node that is moved too.
    let half = 0.5f32.sqrt();
    let mesh = mesh_of(
        "a.glb",
        &changed(|document| {
            document["scenes"][0]["nodes"] = json!([1, 0]);
            document["nodes"] = json!([
                { "mesh": 0 },
                { "translation": [0, 0, 1], "children": [2, 3] },
                { "mesh": 0, "rotation": [0, 0, half, half], "scale": [2, 2, 2], "translation": [8, 0, 0] },
                { "mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 1] },
            ]);
        }),
    );
    assert_eq!(
        (mesh.groups, mesh.triangles.len(), mesh.positions_f64.len()),
        (3, 24, 24)
    );
    for (vertex, [x, y, z]) in plain.positions_f64.iter().enumerate() {
        let turned = mesh.positions_f64[vertex];
        let expected = [8.0 - 2.0 * y, 2.0 * x, 2.0 * z + 1.0];
        for (found, expected) in turned.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-5, "{turned:?}");
        }
        assert_eq!(mesh.positions_f64[8 + vertex], [0.5 - x, *y, z + 1.0]);
        // Rounded once.
        assert_eq!(
            mesh.positions_f32[8 + vertex],
            [0.5 - x, *y, z + 1.0].map(|x| x as f32)
        );
    }
    // Their places before the matrix are kept, but not those of the plain one.
    assert_eq!((mesh.placed.len(), plain.placed.len()), (2, 0));
    let mirrored = &mesh.placed[1];
    assert_eq!(
        mirrored.matrix,
        [
            [-1.0, 0.0, 0.0, 0.5],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 1.0]
        ]
    );
    assert_eq!(
        (mirrored.first, &mirrored.vertices),
        (8, &plain.positions_f32)
    );
    assert_eq!(plain.before_matrix(0), None);
    assert_eq!(mesh.before_matrix(23), None);
    let [a, ..] = mesh.triangles[12];
    assert_eq!(
        mesh.before_matrix(12).unwrap().1[0],
        plain.positions_f32[a as usize - 8]
    );
    // A mirror image is wound the other way round, so that its outside stays outside.
    assert_eq!(mesh.triangles[8], [8, 8 + 4, 8 + 2]);
    // The node without a transform keeps every bit.
    assert_eq!(mesh.positions_f32[16..], plain.positions_f32);
    // Without scenes every node counts that is nobody's child.
    let file = changed(|document| {
        document
            .as_object_mut()
            .unwrap()
            .retain(|name, _| !name.starts_with("scene"));
        document["nodes"] = json!([{ "children": [1] }, { "mesh": 0 }, { "mesh": 0 }]);
    });
    assert_eq!(mesh_of("a.glb", &file).triangles.len(), 16);
}

#[test]
fn strips_fans_plain_vertices_and_sparse_accessors_are_triangles() {
    let triangles = |file: Vec<u8>| mesh_of("a.glb", &file).triangles;
    let primitive = |mode: u32, indices: &[u32], width: usize| {
        let kind = [5121, 5123, 5125][width / 2];
        let bytes = indices
            .iter()
            .flat_map(|index| index.to_le_bytes()[..width].to_vec());
        extended(&bytes.collect::<Vec<u8>>(), |document| {
            document["meshes"][0]["primitives"][0]["mode"] = json!(mode);
            document["accessors"][1] = json!({
                "bufferView": 2, "componentType": kind, "type": "SCALAR", "count": indices.len()
            });
        })
    };
    for width in [1, 2, 4] {
        let list = [5, 0, 2, 1, 3, 4];
        assert_eq!(
            triangles(primitive(4, &list, width)),
            [[5, 0, 2], [1, 3, 4]]
        );
        assert_eq!(
            triangles(primitive(5, &list[..5], width)),
            [[5, 0, 2], [0, 1, 2], [2, 1, 3]]
        );
        assert_eq!(
            triangles(primitive(6, &list[..5], width)),
            [[5, 0, 2], [5, 2, 1], [5, 1, 3]]
        );
    }
    let file = changed(|document| {
        let primitive = &mut document["meshes"][0]["primitives"][0];
        primitive.as_object_mut().unwrap().remove("indices");
        document["accessors"][0]["count"] = json!(6);
    });
    assert_eq!(triangles(file), [[0, 1, 2], [3, 4, 5]]);
    // Two primitives share their vertices; lines are left out.
    let file = changed(|document| {
        let primitives = &mut document["meshes"][0]["primitives"];
        *primitives =
            json!([primitives[0], primitives[0], { "mode": 1, "attributes": { "POSITION": 0 } }]);
    });
    let mesh = mesh_of("a.glb", &file);
    assert_eq!(
        (mesh.triangles.len(), mesh.positions_f64.len(), mesh.groups),
        (16, 8, 1)
    );
    assert_eq!(
        mesh.notes[0].to_string(),
        "primitives of lines and points skipped: 1"
    );
    // Interleaved with 4 bytes of something else, and vertex 1 replaced.
    let solid = solid();
    let mut bytes: Vec<u8> = Vec::new();
    for vertex in &solid.vertices {
        bytes.extend(vertex.iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([9; 4]);
    }
    bytes.extend([1, 0, 0, 0]);
    bytes.extend(
        [-9.0f32, 0.25, 0.5]
            .iter()
            .flat_map(|number| number.to_le_bytes()),
    );
    let file = |base: bool| {
        extended(&bytes, |document| {
            document["bufferViews"][2]["byteStride"] = json!(16);
            let views = document["bufferViews"].as_array_mut().unwrap();
            views.push(json!({ "buffer": 0, "byteOffset": 144 + 128, "byteLength": 16 }));
            document["accessors"][0]["sparse"] = json!({
                "count": 1,
                "indices": { "bufferView": 3, "componentType": 5121 },
                "values": { "bufferView": 3, "byteOffset": 4 },
            });
            document["accessors"][0]["bufferView"] = json!(2);
            if !base {
                document["accessors"][0]
                    .as_object_mut()
                    .unwrap()
                    .remove("bufferView");
            }
        })
    };
    let mut vertices = solid.vertices.clone();
    vertices[1] = [-9.0, 0.25, 0.5];
    assert_eq!(mesh_of("a.glb", &file(true)).positions_f32, vertices);
    let zeros = mesh_of("a.glb", &file(false)).positions_f32;
    assert_eq!(
        (zeros[1], zeros[0], zeros[7]),
        ([-9.0, 0.25, 0.5], [0.0; 3], [0.0; 3])
    );
}

#[test]
fn vertices_doubled_at_seams_are_one_point() {
    // As exporters write it: three vertices a face.
    let whole = solid();
    let vertices = whole
        .faces
        .iter()
        .flatten()
        .map(|v| whole.vertices[*v as usize])
        .collect();
    let faces = (0..8)
        .map(|face| [0, 1, 2].map(|corner| 3 * face + corner))
        .collect();
    let apart = Solid { vertices, faces };
    let folder = scratch("mesh-seams");
    fs::write(folder.join("a.glb"), apart.glb()).unwrap();
    let (out, _) = ends(
        &folder,
        &["mesh", "a.glb", "--kernel", "woop-watertight"],
        0,
    );
    for part in [
        "in f32 (6 points)",
        "\nedges     12 between two faces\n",
        "\nvertices  6 inside a",
    ] {
        assert!(out.contains(part), "{part}\n{out}");
    }
}

#[test]
fn buffers_lie_in_the_text_or_beside_it_and_nowhere_else() {
    let folder = scratch("gltf-beside");
    let whole = solid();
    let expected = mesh_of("a.glb", &whole.glb()).digest;
    fs::create_dir(folder.join("models")).unwrap();
    fs::create_dir(folder.join("models/data")).unwrap();
    fs::write(folder.join("models/data/my mesh.bin"), whole.buffer()).unwrap();
    fs::write(folder.join("secret.bin"), whole.buffer()).unwrap();
    let write = |uri: &str| {
        let text = whole.document(Some(uri.to_owned())).to_string();
        fs::write(folder.join("models/a.gltf"), text).unwrap();
    };
    let refused = |uri: &str, code: i32, message: &str| {
        write(uri);
        let (_, error) = ends(&folder, &["mesh", "models/a.gltf"], code);
        assert!(error.contains(message), "{uri}: {error}");
    };
    for uri in ["data/my%20mesh.bin", "./data/my mesh.bin"] {
        write(uri);
        let run = ["mesh", "models/a.gltf", "--format", "json", "--quiet"];
        let record: Value = serde_json::from_str(&ends(&folder, &run, 0).0).unwrap();
        assert_eq!(record["result"]["mesh"]["digest"], expected);
    }
    let outside = "is not a file in the folder of this one";
    let absolute = folder.join("secret.bin").display().to_string();
    for uri in [
        "../secret.bin",
        "data/../../secret.bin",
        "%2e%2e/secret.bin",
        "..%2fsecret.bin",
        &absolute,
        "https://example.org/a.bin",
        "http://localhost/a.bin",
        "file:secret.bin",
        "..\\secret.bin",
        "",
        "a%0",
    ] {
        refused(uri, 65, outside);
    }
    refused(
        "data/other.bin",
        74,
        "models/a.gltf: buffers[0].uri: 'data/other.bin': cannot read: ",
    );
    fs::write(folder.join("models/short.bin"), &whole.buffer()[1..]).unwrap();
    refused(
        "short.bin",
        65,
        "models/a.gltf: buffers[0] has 143 bytes, expected 144",
    );
    refused("data:text/plain,AAAA", 65, "a data URI that is not base64");
    refused("data:;base64,A*", 65, "buffers[0].uri: not base64: ");
    let unpadded = data_uri(&whole.buffer()[..143]);
    refused(
        unpadded.trim_end_matches('='),
        65,
        "has 143 bytes, expected 144",
    );
}

#[test]
fn gltf_files_that_are_wrong_say_where() {
    let set = |path: &str, value: Value| {
        refusal(
            "a.glb",
            changed(|document| *document.pointer_mut(path).unwrap() = value),
        )
    };
    let extension = |name: &str| {
        refusal(
            "a.glb",
            changed(|document| document["extensionsRequired"] = json!([name])),
        )
    };
    let huge = json!(1u64 << 53);
    for (said, message) in [
        (
            refusal("a.gltf", "{\n\"asset\": 3\n}"),
            "a.gltf:2: not glTF: ",
        ),
        (refusal("a.gltf", "{\n\n"), "a.gltf:3: not glTF: EOF"),
        (
            refusal("a.gltf", b"{\xff}"),
            "a.gltf: its JSON is not UTF-8",
        ),
        (
            refusal("a.glb", "glTF"),
            "a.glb: the file has 4 of the 12 bytes of a GLB header",
        ),
        (
            refusal("a.glb", b"glTF\x02\0\0\0\0\0\0\0"),
            "a.glb: the file has 12 bytes, but its header says 0",
        ),
        (
            refusal("a.glb", b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0JSON"),
            "a.glb: not GLB: unsupported version",
        ),
        (
            refusal(
                "a.glb",
                [&b"glTF\x02\0\0\0\x0c\0\0\0"[..], &solid().glb()[12..]].concat(),
            ),
            &format!(
                "a.glb: the file has {} bytes, but its header says 12 (headers alone have 20)",
                solid().glb().len()
            ),
        ),
        // The buffer stands behind the end that the header says.
        (
            refusal(
                "a.glb",
                [&b"glTF\x02\0\0\0\x40\0\0\0"[..], &solid().glb()[12..]].concat(),
            ),
            "a.glb: not GLB: ",
        ),
        (
            set("/asset/version", json!("1.0")),
            "a.glb: glTF of version '1.0', expected 2.0",
        ),
        (
            extension("KHR_draco_mesh_compression"),
            "a.glb: the file needs the extension 'KHR_draco_mesh_compression': compressed",
        ),
        (
            extension("EXT_meshopt_compression"),
            "a.glb: the file needs the extension 'EXT_meshopt_compression': compressed",
        ),
        (
            extension("KHR_mesh_quantization"),
            "a.glb: the file needs the extension 'KHR_mesh_quantization': quantised",
        ),
        (
            set(
                "/meshes/0/primitives/0/attributes",
                json!({ "POSITION": 2 }),
            ),
            "a.glb: a primitive has its positions in accessors[2], of 2",
        ),
        (
            set("/meshes/0/primitives/0/attributes", json!({ "NORMAL": 0 })),
            "a.glb: meshes[0].primitives[0].attributes[\"POSITION\"]: Missing data",
        ),
        (
            extension("X_any"),
            "a.glb: the file needs the extension 'X_any': hairline does not know it",
        ),
        (
            set("/accessors/0/componentType", json!(5122)),
            "a.glb: meshes[0].primitives[0]: positions are (Vec3, I16)",
        ),
        (
            set("/accessors/1/componentType", json!(5126)),
            "a.glb: accessors[1]: bufferViews[1] does not hold 24",
        ),
        (
            set("/accessors/0/bufferView", json!(9)),
            "a.glb: accessors[0].bufferView: Index out of bounds",
        ),
        (
            set("/accessors/0/count", json!(9)),
            "a.glb: accessors[0]: bufferViews[0] does not hold 9 elements of 12 bytes",
        ),
        (
            set("/accessors/0/count", json!(7)),
            "a.glb: meshes[0].primitives[0]: corner 13 names vertex 7, but there are 7",
        ),
        (
            set("/accessors/1/count", json!(23)),
            "a.glb: meshes[0].primitives[0]: 23 corners, expected a multiple of 3",
        ),
        (
            set("/accessors/0/count", huge.clone()),
            "a.glb: meshes[0].primitives[0]: more than 100000000 vertices",
        ),
        (
            set("/accessors/0/count", json!(99_999_999)),
            "a.glb: accessors[0]: bufferViews[0] does not hold 99999999",
        ),
        (
            set("/accessors/1/count", json!(3u64 << 51)),
            "a.glb: meshes[0].primitives[0]: more than 100000000 triangles",
        ),
        (
            set("/bufferViews/0/byteLength", json!(u64::MAX)),
            "a.glb: accessors[0]: bufferViews[0] does not hold",
        ),
        (
            set("/bufferViews/0/byteOffset", json!(u64::MAX)),
            "a.glb: accessors[0]: bufferViews[0] does not hold",
        ),
        (
            set("/buffers/0/byteLength", huge),
            "a.glb: buffers[0] has 144 bytes, expected 9007199254740992",
        ),
        (
            set("/nodes", json!([{ "mesh": 0, "children": [0] }])),
            "a.glb: nodes[0] has two parents",
        ),
        (
            set(
                "/nodes/0",
                json!({ "mesh": 0, "translation": [1e39, 0, 0] }),
            ),
            "a.glb: not glTF: number out of range",
        ),
        (
            set(
                "/nodes/0",
                json!({ "mesh": 0, "matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }),
            ),
            "a.glb: nodes[0].matrix: expected",
        ),
        (
            set("/nodes/0", json!({})),
            "a.glb: the file has no triangles",
        ),
        (
            set(
                "/meshes/0/primitives/0",
                json!({ "attributes": { "POSITION": 0 }, "indices": 1, "mode": 1 }),
            ),
            "a.glb: the file has no triangles: primitives of lines and points skipped: 1",
        ),
        (
            set("/scenes/0/nodes", json!([])),
            "a.glb: the file has no triangles",
        ),
    ] {
        assert!(
            said.starts_with(message) && !said.contains('\n'),
            "{said}\n{message}"
        );
    }
    // A small file that asks for all zeros, many of them.
    let zeros = changed(|document| {
        document["accessors"][0] = json!({
            "componentType": 5126, "type": "VEC3", "count": 90_000_000,
            "sparse": {
                "count": 1,
                "indices": { "bufferView": 1, "componentType": 5123 }, "values": { "bufferView": 0 },
            },
        });
    });
    assert!(refusal("a.glb", zeros).contains("accessors[0]: 90000000 elements, more than the "));
    // A small file that places one mesh very often.
    let crowd = changed(|document| {
        let primitive = document["meshes"][0]["primitives"][0].clone();
        document["meshes"][0]["primitives"] = vec![primitive; 100].into();
        document["scenes"][0]["nodes"] = (0..3_000).collect();
        document["nodes"] = vec![json!({ "mesh": 0 }); 3_000].into();
    });
    let said = refusal("a.glb", crowd);
    assert!(
        said.contains(": more than 2000000 triangles, of "),
        "{said}"
    );
    let mut not_finite = solid();
    not_finite.vertices[5][1] = f32::NAN;
    assert_eq!(
        refusal("a.glb", not_finite.glb()),
        "a.glb: meshes[0].primitives[0]: vertex 5 has NaN, which is not finite"
    );
    // What concerns materials does not matter.
    let mut file = Vec::new();
    for name in ["KHR_materials_unlit", "KHR_texture_basisu"] {
        file = changed(|document| {
            document["extensionsRequired"] = json!([name]);
            document["textures"] = json!([{ "sampler": 7 }]);
            document["materials"] = json!([{ "normalTexture": { "index": 9 } }]);
            document["meshes"][0]["primitives"][0]["attributes"]["anything"] = json!(77);
        });
    }
    assert_eq!(mesh_of("a.glb", &file).triangles.len(), 8);
}
