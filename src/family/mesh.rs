//! stub
/// stub
pub struct MeshFamily;
