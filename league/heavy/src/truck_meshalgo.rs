//! truck-meshalgo 0.4.0: `signed_crossing_faces` of a mesh of one triangle.

use crate::PROMISE;
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo};
use truck_meshalgo::prelude::*;

const INFO: KernelInfo = KernelInfo {
    source: "truck-meshalgo 0.4.0, IncludingPointInDomain::signed_crossing_faces",
    gives: Gives {
        t: false,
        uv: false,
        facing: false,
    },
    ..KernelInfo::own("truck-meshalgo", PROMISE)
};

pub fn entry() -> Entry {
    Entry::new(&INFO).f64(|case: &Case<f64>, _: &[f64]| {
        let [o, d, a, b, c] = case.vectors();
        let positions = [a, b, c].map(|[x, y, z]| Point3::new(x, y, z)).to_vec();
        let mesh = PolygonMesh::new(
            StandardAttributes {
                positions,
                ..Default::default()
            },
            Faces::from_iter([[0usize, 1, 2]]),
        );
        let count = mesh.signed_crossing_faces(Point3::from(o), Vector3::from(d));
        (count != 0).then_some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    })
}
