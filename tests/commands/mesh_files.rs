//! Meshes in OBJ, PLY and glTF files: the same mesh from each, and what is wrong with a file.

mod ply;
mod writers;

use crate::program;

use hairline::internals::files::InputError;
use hairline::internals::files::mesh::{self, Mesh};
use program::{ends, scratch};
use serde_json::{Value, json};
use std::fs;
use std::io;
use writers::{Ply, Solid, data_uri, glb, solid};

fn read_as(name: &str, bytes: &[u8]) -> Result<Mesh, InputError> {
    let mut beside = |name: &str, _: u64| Err(io::Error::new(io::ErrorKind::NotFound, name));
    mesh::read(bytes, name, &mut beside, &mut |_| {})
}

fn mesh_of(name: &str, bytes: &[u8]) -> Mesh {
    read_as(name, bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(name: &str, bytes: impl AsRef<[u8]>) -> String {
    read_as(name, bytes.as_ref()).expect_err(name).to_string()
}

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// The solid in every format, with names that tell it.
fn files(solid: &Solid) -> Vec<(String, Vec<u8>)> {
    let ply = |encoding: &str| {
        (
            format!("{encoding}.ply"),
            solid.ply(encoding, "float", "uchar", "int"),
        )
    };
    let mut files = vec![("a.obj".to_owned(), solid.obj())];
    files.extend(ENCODINGS.map(ply));
    files.extend([
        ("a.gltf".to_owned(), solid.gltf()),
        ("a.glb".to_owned(), solid.glb()),
    ]);
    files
}

#[test]
fn a_mesh_is_the_same_in_every_format() {
    let solid = solid();
    let expected = mesh_of("a.obj", &solid.obj());
    assert_eq!(expected.triangles, solid.faces);
    for (name, bytes) in files(&solid) {
        // By extension, and by content.
        for name in [name.as_str(), "-", "mesh.txt"] {
            let mesh = mesh_of(name, &bytes);
            assert_eq!(mesh.positions_f32, solid.vertices, "{name}");
            assert_eq!(mesh.positions_f64, expected.positions_f64, "{name}");
            assert_eq!(
                (mesh.triangles, mesh.digest),
                (expected.triangles.clone(), expected.digest.clone())
            );
        }
    }
    let [ply, obj] = [solid.ply("ascii", "float", "uchar", "int"), solid.obj()];
    // Faces begin after 16 lines of header, 8 vertices and a material; 8 vertices in the OBJ file.
    assert_eq!(
        mesh_of("a.ply", &ply).places,
        (26..34).collect::<Vec<u32>>()
    );
    assert_eq!(mesh_of("a.obj", &obj).places, (9..17).collect::<Vec<u32>>());
    assert_eq!(
        mesh_of("a.glb", &solid.glb()).places,
        (1..9).collect::<Vec<u32>>()
    );
    assert!(mesh_of("a.ply", &ply).has_lines && !mesh_of("a.glb", &solid.glb()).has_lines);
    assert!(refusal("a.ply", obj).contains("ply"));
}

#[test]
fn an_stl_file_is_the_mesh_whose_equal_corners_are_one() {
    let solid = solid();
    let text = solid.stl_text();
    let mut latin = text.clone();
    // The name in another encoding: one byte for two.
    let place = latin.iter().position(|byte| *byte == 0xc3).unwrap();
    latin.splice(place..place + 2, [0xe9]);
    let files = [
        ("a.stl", text),
        ("-", latin),
        ("a.STL", solid.stl_binary(b"made by hand")),
        ("b.stl", solid.stl_binary(b"solid all the same")),
        ("-", solid.stl_binary(b"solid\nall the same\n")),
    ];
    for (name, bytes) in files {
        let mesh = mesh_of(name, &bytes);
        // Six of the eight vertices: one is used by no face, and two are one.
        assert_eq!(
            (mesh.positions_f64.len(), mesh.triangles.len()),
            (6, 8),
            "{name}"
        );
        for (face, corners) in solid.faces.iter().enumerate() {
            let expected = corners.map(|corner| solid.vertices[corner as usize]);
            assert_eq!(mesh.vertices::<f32>(face), expected, "{name}");
        }
        let joined =
            "corners that equal an earlier one in every bit, joined with it: 18 (first at ";
        assert!(
            mesh.notes[0].to_string().starts_with(joined),
            "{}",
            mesh.notes[0]
        );
    }
    // Decimals keep the digits that f32 has not.
    let wide = mesh_of("a.stl", &solid.stl_text()).positions_f64;
    assert_eq!(wide[0], [0.9, 0.1, 0.0]);
    let zeros = "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nfacet\nvertex -0 0 0\n\
                 vertex 0 1 0\nvertex 0 0 1\nendfacet\nendsolid\n";
    assert_eq!(
        mesh_of("a.stl", zeros.as_bytes()).positions_f64.len(),
        4,
        "both zeros are one"
    );

    let folder = scratch("mesh-stl");
    fs::write(folder.join("a.stl"), solid.stl_binary(b"")).unwrap();
    fs::write(folder.join("a.obj"), solid.obj()).unwrap();
    let screen = |file: &str| {
        let flags = [
            "--kernel",
            "plucker",
            "--directions",
            "8",
            "--details",
            "-q",
        ];
        ends(&folder, &[&["mesh", file][..], &flags].concat(), 0).0
    };
    assert!(
        screen("a.stl").contains("edges     12 between two faces"),
        "{}",
        screen("a.stl")
    );
    assert!(screen("a.obj").contains("edges     12 between two faces"));
}

#[test]
fn what_is_wrong_with_an_stl_file_is_said_with_its_place() {
    let head = "solid x\nfacet normal 0 0 1\nouter loop\n";
    let corner = "vertex 0 0 0\n";
    let binary = |count: u32, bytes: usize| {
        let mut file = vec![b' '; 80];
        file.extend(count.to_le_bytes());
        file.resize(84 + bytes, 0);
        file
    };
    let mut infinite = solid().stl_binary(b"");
    infinite[84 + 12..84 + 16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let cases: [(Vec<u8>, &str); 9] = [
        (
            b"solid x\nendsolid\n".to_vec(),
            "a.stl: the file has no facets",
        ),
        (
            format!("{head}vertex 0 0\n").into(),
            "a.stl:4: vertex has 2 of 3 coordinates",
        ),
        (
            format!("{head}vertex 0 0 0 0\n").into(),
            "a.stl:4: vertex has 4 of 3 coordinates",
        ),
        (
            format!("{head}vertex 0 x 0\n").into(),
            "a.stl:4: vertex has 'x', which is not a number",
        ),
        (
            format!("{head}vertex 0 nan 0\n").into(),
            "a.stl:4: vertex has 'nan', which is not finite",
        ),
        (
            format!("{head}{corner}{corner}endfacet\n").into(),
            "a.stl:6: facet has 2 of 3 vertices",
        ),
        (
            format!("{head}v 1 2 3\n").into(),
            "a.stl:4: expected a line of an STL file, such as 'vertex 0 1 0', found 'v'",
        ),
        (
            binary(2, 60),
            "a.stl: the file ends in triangle 2 of the 2 that its header says",
        ),
        (infinite, "a.stl: triangle 1 has inf, which is not finite"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(refusal("a.stl", bytes), expected);
    }
    assert!(refusal("a.stl", b"abc").contains("the file ends within the header of a binary STL"));
    assert!(refusal("a.stl", binary(u32::MAX, 0)).contains("more than 100000000 triangles"));
    for name in ["model.fbx", "a.OFF", "b.3mf", "c.usdz"] {
        let extension = name.split('.').next_back().unwrap().to_lowercase();
        let expected =
            format!("{name}: {extension} files are not read: convert it to PLY, OBJ, STL or glTF");
        assert_eq!(refusal(name, b"x"), expected);
    }
}

#[cfg(unix)]
#[test]
fn a_buffer_that_is_a_pipe_is_refused_and_not_waited_for() {
    let folder = scratch("mesh-fifo");
    let pipe = folder.join("pipe.bin");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let document = serde_json::to_vec(&solid().document(Some("pipe.bin".to_owned()))).unwrap();
    fs::write(folder.join("a.gltf"), document).unwrap();
    let (_, error) = ends(&folder, &["mesh", "a.gltf", "-q"], 74);
    assert!(
        error.contains("pipe.bin") && error.contains("no ordinary file"),
        "{error}"
    );
}

#[test]
fn names_and_comments_may_be_in_any_encoding() {
    let latin = |text: &str| text.chars().map(|c| c as u8).collect::<Vec<u8>>();
    let ply = "ply\nformat ascii 1.0\ncomment caf\u{e9}\nobj_info \u{e4}\nelement vertex 3\nproperty float x\n\
               property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n\
               end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(mesh_of("a.ply", &latin(ply)).triangles, [[0, 1, 2]]);
    let obj = "# caf\u{e9}\no \u{e4}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \u{fc}\nf 1 2 3\n";
    assert_eq!(mesh_of("a.obj", &latin(obj)).triangles, [[0, 1, 2]]);
    let number = "v 0 0 \u{e9}\n";
    assert!(refusal("a.obj", latin(number)).starts_with("a.obj:1: vertex has "));
}

/// What a record says but for the file and the places in it.
fn without_places(record: &mut Value) {
    match record {
        Value::Object(fields) => {
            for place in [
                "file",
                "family",
                "hash",
                "command",
                "lines",
                "faces",
                "first_line",
                "first_face",
                "notes",
            ] {
                if !fields.get(place).is_some_and(|value| value.is_object()) {
                    fields.remove(place);
                }
            }
            fields.values_mut().for_each(without_places);
        }
        Value::Array(parts) => parts.iter_mut().for_each(without_places),
        _ => {}
    }
}

#[test]
fn every_command_that_takes_a_mesh_takes_every_format() {
    let folder = scratch("mesh-files");
    let files = files(&solid());
    files
        .iter()
        .for_each(|(name, bytes)| fs::write(folder.join(name), bytes).unwrap());
    let flags = [
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32,f64",
        "--quiet",
    ];
    let mut records = files.iter().map(|(name, _)| {
        let run = ["mesh", name, "--format", "json", "--directions", "64"];
        let mut record: Value =
            serde_json::from_str(&ends(&folder, &[&run[..], &flags].concat(), 0).0).unwrap();
        without_places(&mut record["result"]);
        record["result"].take()
    });
    let first = records.next().unwrap();
    assert_eq!(
        first["mesh"]["scalars"][0]["topology"]["closed_manifold"],
        true
    );
    assert!(
        first["results"][0]["across"]["leaking"]["count"]
            .as_u64()
            .unwrap()
            > 0
    );
    records.for_each(|record| assert_eq!(record, first));

    // Ids hold the digest, so that one made from a file is shown with another.
    let run = ["mesh", "a.glb", "--directions", "64", "--details"];
    let (text, _) = ends(&folder, &[&run[..], &flags].concat(), 0);
    assert!(text.contains(", faces 1, "), "{text}");
    let page = |file: &str| {
        ends(
            &folder,
            &[&["mesh", file, "--format", "html"][..], &flags].concat(),
            0,
        )
        .0
    };
    assert!(page("a.glb").contains("data-faces=\"faces\""));
    assert!(page("a.obj").contains("data-faces=\"faces at lines\""));
    let command = text
        .lines()
        .find(|line| line.trim_start().starts_with("hairline explain"));
    let words = command
        .unwrap()
        .split_whitespace()
        .skip(1)
        .map(|word| word.trim_matches('\''));
    let words: Vec<&str> = words.collect();
    let shown = ends(&folder, &words, 0).0;
    let of_obj: Vec<&str> = words
        .iter()
        .map(|word| word.trim_matches('"'))
        .map(|word| if word == "a.glb" { "a.obj" } else { word })
        .collect();
    assert_ne!(words, of_obj);
    assert_eq!(ends(&folder, &of_obj, 0).0.replace("a.obj", "a.glb"), shown);

    let counts = |command: &[&str], file: &str| {
        let out = ends(
            &folder,
            &[command, &["--mesh", file, "--quiet"]].concat(),
            0,
        )
        .0;
        let record = serde_json::from_str(&out).unwrap_or(Value::Null);
        let counts = match [&record["result"]["results"], &record["result"]["kernels"]] {
            [Value::Null, Value::Null] => out,
            [results, Value::Null] => results.to_string(),
            [_, kernels] => kernels.to_string(),
        };
        counts.replace(file, "FILE")
    };
    for command in [
        &[
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "-n",
            "1000",
            "--format",
            "json",
        ][..],
        &[
            "audit", "--kernel", "cramer", "-n", "100", "--format", "json",
        ],
        &[
            "audit", "--kernel", "cramer", "-n", "100", "--scene", "mesh", "--format", "json",
        ],
        &[
            "prove",
            "--kernel",
            "moller-trumbore",
            "--scalar",
            "f32",
            "--distance",
            "20",
        ],
    ] {
        let expected = counts(command, "a.obj");
        for file in ["binary_big_endian.ply", "a.gltf"] {
            assert_eq!(counts(command, file), expected, "{command:?}");
        }
    }
}

/// The walls of an L-shaped prism, whose caps are two concave polygons.
const PRISM: &str = "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\n\
                     v 0 0 1\nv 4 0 1\nv 4 1 1\nv 1 1 1\nv 1 4 1\nv 0 4 1\n\
                     f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";

#[test]
fn concave_polygons_are_cut_and_what_cannot_be_cut_is_counted_in_every_report() {
    let folder = scratch("mesh-concave");
    // From the outer corner at the end of an arm, from which the fan folds over.
    let caps = "f 8 9 10 11 12 7\nf 3 2 1 6 5 4\n";
    let mesh = |name: &str, faces: &str, more: &[&str]| {
        fs::write(folder.join(name), format!("{PRISM}{faces}")).unwrap();
        let flags = ["mesh", name, "--kernel", "plucker", "-q"];
        ends(&folder, &[&flags[..], more].concat(), 0).0
    };
    let screen = mesh("a.obj", caps, &[]);
    assert!(
        screen.contains("20 triangles") && screen.contains("faces     20 sound\n"),
        "{screen}"
    );
    assert!(
        screen.contains("a closed surface, wound consistently"),
        "{screen}"
    );
    // A cap that crosses itself.
    let crossed = caps.replace("8 9 10 11", "8 11 10 9");
    let screen = mesh("b.obj", &crossed, &[]);
    let expected =
        "16 sound, 1 left out, polygons that cross themselves or fold over (first at line 19)";
    assert!(program::flat(&screen).contains(expected), "{screen}");
    assert!(!screen.contains("a closed surface"), "{screen}");
    let record: Value =
        serde_json::from_str(&mesh("b.obj", &crossed, &["--format", "json"])).unwrap();
    let left_out = &record["result"]["mesh"]["scalars"][0]["topology"]["faces"]["left_out"];
    assert_eq!(
        (&left_out["count"], &left_out["first_line"]),
        (&json!(1), &json!(19))
    );
    let audit = [
        "audit", "--mesh", "b.obj", "--kernel", "plucker", "-n", "100", "-q",
    ];
    let (screen, _) = ends(&folder, &audit, 0);
    let expected = "b.obj: 1 polygon left out, because they cross themselves or fold over";
    assert!(program::flat(&screen).contains(expected), "{screen}");
    let (record, _) = ends(&folder, &[&audit[..], &["--format", "json"]].concat(), 0);
    let record: Value = serde_json::from_str(&record).unwrap();
    assert_eq!(record["result"]["sources"][0]["left_out"], json!(1));
    let (record, _) = ends(
        &folder,
        &[
            "audit", "--mesh", "a.obj", "-k", "plucker", "-n", "9", "-q", "--format", "json",
        ],
        0,
    );
    assert!(!record.contains("left_out"));
}

#[test]
fn cut_or_altered_files_are_an_error_or_the_same_mesh_and_never_a_panic() {
    let solid = solid();
    for (name, bytes) in files(&solid).into_iter().skip(1) {
        let whole = mesh_of(&name, &bytes).digest;
        for length in 0..bytes.len() {
            if let Ok(mesh) = read_as(&name, &bytes[..length]) {
                assert_eq!(mesh.digest, whole, "{name} {length}");
                assert!(
                    name != "a.glb" && length + 12 > bytes.len(),
                    "{name} {length}"
                );
            }
        }
        for at in 0..bytes.len() {
            for other in [0, 0xff, bytes[at] ^ 1, bytes[at] ^ 0x80, b'9', b'-'] {
                let mut altered = bytes.clone();
                altered[at] = other;
                if let Ok(mesh) = read_as(&name, &altered) {
                    let count = mesh.positions_f64.len() as u32;
                    assert!(
                        mesh.triangles
                            .as_flattened()
                            .iter()
                            .all(|vertex| *vertex < count)
                    );
                    assert!(
                        mesh.positions_f64
                            .as_flattened()
                            .iter()
                            .all(|x| x.is_finite())
                    );
                }
            }
        }
    }
}

mod gltf;
