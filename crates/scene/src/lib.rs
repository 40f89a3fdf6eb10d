//! An exact answer to "where does this ray meet this mesh?" for every finite `f32` and `f64`: the nearest faces, and all
//! hits in order.
//!
//! ```
//! use hairline_scene::{Ray, Scene};
//!
//! // A square of two faces, hit on the diagonal that they share.
//! let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let scene = Scene::<f64>::new(&vertices, &[[0, 1, 2], [0, 2, 3]]).unwrap();
//! let ray = Ray::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]);
//! let nearest = scene.nearest(&ray).unwrap().unwrap();
//! assert_eq!(nearest.faces, [0, 1]);
//! ```
//!
//! [`Scene::hits`] has all hits in exact order, [`Scene::values`] their numbers. For closed surfaces [`Scene::passages`] says
//! where a ray crosses the surface, touches it or runs in it, and [`Scene::locate`] whether a point is inside. [`Instances`] are
//! meshes that matrices put into the world.
//!
//! ```
//! use hairline_scene::{Location, Ray, Scene, Winding};
//!
//! let vertices = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
//! let tetrahedron = Scene::new(&vertices, &faces).unwrap();
//! assert_eq!(tetrahedron.locate([0.25; 3]), Ok(Location::Off(Winding::Number(1))));
//!
//! // Along an edge: the ray runs in the surface, and is outside before and after.
//! let along = Ray::new([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
//! let passages = tetrahedron.passages(&along).unwrap();
//! assert!(passages[0].is_segment);
//! assert_eq!(passages[0].crosses(), Ok(false));
//! ```
//!
//! [`define`] and [`define_instances`] are the definition, in rationals and over all faces. A [`Scene`] gives the same answers fast: a tree whose
//! box test loses nothing, a filter in floats with bounds, and integers where the bounds do not tell.

#![forbid(unsafe_code)]

#[macro_use(named)]
extern crate hairline_core;

// From the ground up: each block uses only those above it.
mod bounds;
mod distance;
mod grid;
mod instance;
mod mesh;
mod ray;
mod rounded;
mod winding;

mod closed;
mod define;
mod moved;

mod aabb;
mod exact;
mod filter;
mod fraction;

mod found;
mod hit;
mod query;
mod slab;
mod tree;

mod build;
mod placed;

mod instances;
mod scene;

mod nearby;

mod passage;
mod values;

mod judge;

mod aimed;
mod conforms;

pub use aimed::{NoTargets, RayKind, Targets};
pub use bounds::Bounds;
pub use closed::Closed;
pub use conforms::{NotConforming, WrongAnswer, WrongAnswers};
pub use define::{DefinedHit, define, define_instances, nearest_of};
pub use hairline_core::case::Matrix;
pub use instance::{Instance, InstanceError, PlacedFace, WrongInstance};
pub use instances::Instances;
pub use judge::{Answer, Judged, Judgement, NamedHit, NamedPlace, VISIBLE};
pub use mesh::{MeshError, Triangle, triangles};
pub use passage::{Location, Passage};
pub use ray::{InvalidRay, Ray};
pub use rounded::rounded;
pub use scene::{Hit, Nearest, Scene};
pub use values::Values;
pub use winding::{OpenEdge, Winding};
