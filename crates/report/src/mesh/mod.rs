//! The page of an audit of a mesh's edges and vertices; with a drawing of the mesh if there is one.

mod rows;
mod screen;
#[cfg(feature = "pages")]
mod stage;

pub use screen::page;
