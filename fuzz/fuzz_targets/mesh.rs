//! The mesh reader: no panic on any bytes, and every index it gives is in range.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::corpus::mesh::read_obj;

fn indices_in_range(data: &[u8]) {
    if let Ok(mesh) = read_obj(data, "fuzz.obj", &mut |_| {}) {
        assert_eq!(mesh.lines.len(), mesh.triangles.len());
        for triangle in 0..mesh.triangles.len() {
            let _ = (mesh.vertices::<f32>(triangle), mesh.vertices::<f64>(triangle));
        }
    }
}

hairline_fuzz::target!(indices_in_range);
