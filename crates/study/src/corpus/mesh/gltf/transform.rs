//! Where a node puts its mesh, in `f64`.

use gltf::scene;

/// An affine map: three rows of a linear part and a translation.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Transform([[f64; 4]; 3]);

impl Transform {
    pub const IDENTITY: Transform =
        Transform([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    /// The transform of a node; none if its matrix is not affine.
    pub fn of(node: &scene::Transform) -> Option<Transform> {
        match node {
            scene::Transform::Matrix { matrix } => {
                let columns = matrix.map(|column| column.map(f64::from));
                let row = |i: usize| columns.map(|column| column[i]);
                (row(3) == [0.0, 0.0, 0.0, 1.0]).then(|| Transform([0, 1, 2].map(row)))
            }
            scene::Transform::Decomposed { translation, rotation, scale } => {
                let [x, y, z, w] = rotation.map(f64::from);
                let turned = [
                    [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
                    [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
                    [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
                ];
                let [sx, sy, sz] = scale.map(f64::from);
                Some(Transform([0, 1, 2].map(|i| {
                    let [a, b, c] = turned[i];
                    [a * sx, b * sy, c * sz, f64::from(translation[i])]
                })))
            }
        }
    }

    /// First `local`, then this.
    pub fn after(&self, local: &Transform) -> Transform {
        let translation = [0.0, 0.0, 0.0, 1.0];
        Transform(self.0.map(|row| {
            std::array::from_fn(|j| {
                let product = |k: usize| row[k] * local.0[k][j];
                product(0) + product(1) + product(2) + row[3] * translation[j]
            })
        }))
    }

    /// A point's place. The identity leaves every bit.
    pub fn apply(&self, point: [f32; 3]) -> [f64; 3] {
        let [x, y, z] = point.map(f64::from);
        if *self == Transform::IDENTITY {
            return [x, y, z];
        }
        self.0.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// True if it turns a right hand into a left one; glTF then counts corners the other way round.
    pub fn mirrors(&self) -> bool {
        let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = self.0;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0
    }
}
