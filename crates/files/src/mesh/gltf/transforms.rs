//! The transforms of nodes.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::scene::Transform;

/// The transform of a node; none if its matrix is not affine.
pub(super) fn transform_of(node: &Transform) -> Option<DAffine3> {
    let wide = |vector: &[f32; 3]| DVec3::from(vector.map(f64::from));
    match node {
        Transform::Matrix { matrix } => {
            let matrix = DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)));
            let is_affine = matrix.row(3).to_array() == [0.0, 0.0, 0.0, 1.0];
            is_affine.then(|| DAffine3::from_mat4(matrix))
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => {
            let rotation = DQuat::from_array(rotation.map(f64::from));
            let (scale, translation) = (wide(scale), wide(translation));
            Some(DAffine3::from_scale_rotation_translation(
                scale,
                rotation,
                translation,
            ))
        }
    }
}

/// A point's place. The identity leaves every bit.
pub(super) fn placed(transform: &DAffine3, point: [f32; 3]) -> [f64; 3] {
    let point = point.map(f64::from);
    if *transform == DAffine3::IDENTITY {
        return point;
    }
    transform.transform_point3(point.into()).to_array()
}

/// The rows of a transform's matrix; the last column is the translation.
pub(super) fn rows(transform: &DAffine3) -> [[f64; 4]; 3] {
    let columns = transform.to_cols_array_2d();
    [0, 1, 2].map(|row| columns.map(|column| column[row]))
}

/// True if it turns a right hand into a left one; glTF then counts corners the other way round.
pub(super) fn mirrors(transform: &DAffine3) -> bool {
    transform.matrix3.determinant() < 0.0
}
