//! stub
use crate::arith::Float;
use crate::case::{Case, CaseId, Parameters};
/// stub
pub struct MeshFamily;
impl MeshFamily {
    /// stub
    pub fn file_name(&self) -> &str {
        ""
    }
    /// stub
    pub fn path(&self) -> &str {
        ""
    }
    /// stub
    pub fn make<F: Float>(&self, _: &Parameters, _: u64, _: u64) -> Case<F> {
        todo!()
    }
    /// stub
    pub fn id<F: Float>(&self, _: &Parameters, _: u64, _: u64) -> CaseId {
        todo!()
    }
}
