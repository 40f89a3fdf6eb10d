//! The page of an audit of a mesh's edges and vertices; with a drawing of the mesh if there is one.

mod examples;
mod rows;
mod screen;
#[cfg(feature = "pages")]
mod stage;
mod topology;

pub use screen::page;
