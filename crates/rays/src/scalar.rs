//! The doors of this crate, one a scalar: what takes long is compiled behind them, where code is optimised for speed.

use crate::asked::{Answers, BadRay};
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::files::InputError;
use crate::files::mesh::Mesh;
use crate::found::{self, FoundHits};
use crate::found_all::{self, AllHits};
use crate::judged;
use crate::kernel::Scalar;
use crate::made;
use crate::one::{self, RayTold};
use crate::plain::{self, PlainProgram};
use crate::points::{self, LocatedPoints};
use crate::result::RaysResult;
use crate::run::{JudgedRun, Judgements};
use crate::summary;
use crate::text::{self, Text};
use hairline_scene::{InvalidRay, MeshError, NoTargets, Ray, RayKind, Scene};

/// A scalar in which a mesh is asked about.
pub trait RaysScalar: Scalar + Sized {
    /// The triangles of a mesh as a scene.
    fn scene(mesh: &Mesh) -> Result<Scene<Self>, MeshError>;

    /// The rays of a file.
    fn rays_of(text: Text) -> Result<Vec<Ray<Self>>, InputError>;

    /// The points of a file.
    fn points_of(text: Text) -> Result<Vec<[Self; 3]>, InputError>;

    /// Rays of some kinds at a mesh, so many in all.
    fn made(
        mesh: &Mesh,
        kinds: &[RayKind],
        count: u64,
        seed: u64,
    ) -> Result<Vec<Ray<Self>>, NoTargets>;

    /// Everything that one ray meets.
    fn told(mesh: &Mesh, scene: &Scene<Self>, ray: &Ray<Self>) -> Result<RayTold, InvalidRay>;

    /// The nearest hits of rays.
    fn found(scene: &Scene<Self>, rays: &[Ray<Self>]) -> Result<FoundHits, BadRay>;

    /// All hits of rays.
    fn found_all(scene: &Scene<Self>, rays: &[Ray<Self>]) -> Result<AllHits, BadRay>;

    /// The places of points.
    fn located(scene: &Scene<Self>, points: &[[Self; 3]]) -> Result<LocatedPoints, BadRay>;

    /// The nearest hits of rays as a plain program finds them. An error if it does not run in this scalar.
    fn answered(program: &PlainProgram, mesh: &Mesh, rays: &[Ray<Self>])
    -> Result<Answers, String>;

    /// Answers, judged.
    fn judged(run: JudgedRun<Self>) -> Result<Judgements<Self>, BadRay>;

    /// The counts, and what is told of judged answers.
    fn summary(judgements: &Judgements<Self>) -> Result<RaysResult, BadRay>;
}

macro_rules! implement {
    ($scalar:ty) => {
        impl RaysScalar for $scalar {
            fn scene(mesh: &Mesh) -> Result<Scene<Self>, MeshError> {
                scene_of(mesh)
            }

            fn rays_of(text: Text) -> Result<Vec<Ray<Self>>, InputError> {
                text::rays(text)
            }

            fn points_of(text: Text) -> Result<Vec<[Self; 3]>, InputError> {
                text::points(text)
            }

            fn made(
                mesh: &Mesh,
                kinds: &[RayKind],
                count: u64,
                seed: u64,
            ) -> Result<Vec<Ray<Self>>, NoTargets> {
                made::made(mesh, kinds, count, seed)
            }

            fn told(
                mesh: &Mesh,
                scene: &Scene<Self>,
                ray: &Ray<Self>,
            ) -> Result<RayTold, InvalidRay> {
                one::told(mesh, scene, ray)
            }

            fn found(scene: &Scene<Self>, rays: &[Ray<Self>]) -> Result<FoundHits, BadRay> {
                found::found(scene, rays)
            }

            fn found_all(scene: &Scene<Self>, rays: &[Ray<Self>]) -> Result<AllHits, BadRay> {
                found_all::found_all(scene, rays)
            }

            fn located(scene: &Scene<Self>, points: &[[Self; 3]]) -> Result<LocatedPoints, BadRay> {
                points::located(scene, points)
            }

            fn answered(
                program: &PlainProgram,
                mesh: &Mesh,
                rays: &[Ray<Self>],
            ) -> Result<Answers, String> {
                plain::answered(program, mesh, rays)
            }

            fn judged(run: JudgedRun<Self>) -> Result<Judgements<Self>, BadRay> {
                judged::judged(run)
            }

            fn summary(judgements: &Judgements<Self>) -> Result<RaysResult, BadRay> {
                summary::summary(judgements)
            }
        }
    };
}

implement!(f32);
implement!(f64);

fn scene_of<F: Scalar>(mesh: &Mesh) -> Result<Scene<F>, MeshError>
where
    Case<F>: Into<AnyCase>,
{
    let count = mesh.positions_f64.len() as u32;
    let vertices: Vec<[F; 3]> = (0..count).map(|vertex| mesh.position(vertex)).collect();
    Scene::new(&vertices, &mesh.triangles)
}
