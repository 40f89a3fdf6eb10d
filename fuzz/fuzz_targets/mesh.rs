//! The readers of meshes in all formats, by content: no panic on any bytes, and every index it gives is in range.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::files::mesh::read;

fn indices_in_range(data: &[u8]) {
    let mut beside = |_: &str, _| Err(std::io::ErrorKind::NotFound.into());
    if let Ok(mesh) = read(data, "fuzz", &mut beside, &mut |_| {}) {
        assert_eq!(mesh.places.len(), mesh.triangles.len());
        for triangle in 0..mesh.triangles.len() {
            let _ = (
                mesh.vertices::<f32>(triangle),
                mesh.vertices::<f64>(triangle),
            );
        }
    }
}

hairline_fuzz::target!(indices_in_range);
