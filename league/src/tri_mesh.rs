//! tri-mesh 0.6.1: `Mesh::ray_intersection` on a mesh of one triangle.

use crate::{ENTRANT, Entrant, PROMISE, Run};
use cgmath::Vector3;
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};
use three_d_asset::{Positions, TriMesh};
use tri_mesh::Mesh;

pub const TRI_MESH: Entrant = Entrant {
    name: INFO.name,
    package: "tri-mesh",
    version: "0.6.1",
    function: "tri_mesh::Mesh::ray_intersection",
    claim: &[
        "Find the [Intersection] between any face in the mesh and the given ray.",
        "If no faces are intersected, None is returned.",
    ],
    page: "https://docs.rs/tri-mesh/0.6.1/tri_mesh/struct.Mesh.html#method.ray_intersection",
    note: "Its tolerance about edges, 1e-7, is in its source and not in its documentation.",
    run: Run::Here(entry),
    findings: &["tri-mesh.md"],
    ..ENTRANT
};

const INFO: KernelInfo = KernelInfo {
    source: "tri-mesh 0.6.1, Mesh::ray_intersection",
    gives: Gives {
        t: false,
        uv: false,
        facing: false,
    },
    ..KernelInfo::own("tri-mesh", PROMISE)
};

fn entry() -> Entry {
    Entry::new(&INFO).f64(|case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors().map(Vector3::from);
        let mesh: Mesh = TriMesh {
            positions: Positions::F64(vec![a, b, c]),
            ..Default::default()
        }
        .into();
        mesh.ray_intersection(&o, &d).map(|_| Hit {
            t: None,
            uv: None,
            facing: None,
        })
    })
}
