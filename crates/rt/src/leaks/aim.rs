//! Rays that a device makes, traces and counts, and the exact decision about those that it loses.

use crate::device::{Device, Shader};
use crate::failure::Failure;
use crate::structure::Structure;
use crate::world::World;
use bytemuck::{Pod, Zeroable};
use hairline_scene::{Passage, Ray, Winding};
use serde::Serialize;
use std::fmt;

/// Where rays are aimed.
#[derive(Clone, Copy)]
pub enum Aim {
    Vertex,
    Edge,
    Face,
}

impl Aim {
    pub const ALL: [Aim; 3] = [Aim::Vertex, Aim::Edge, Aim::Face];
}

impl fmt::Display for Aim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Aim::Vertex => "at vertices",
            Aim::Edge => "at edges",
            Aim::Face => "into faces",
        })
    }
}

/// Where rays start.
#[derive(Clone, Copy)]
pub enum Start {
    Inside,
    /// So far from a point inside, where they end after they have passed what they are aimed at.
    Away(f32),
}

/// Counts of rays that were aimed alike.
#[derive(Clone, Default, Serialize)]
pub struct Aimed {
    pub rays: u64,
    /// Rays whose nearest hit the device does not find.
    pub lost: u64,
    /// How many of the lost ones were decided exactly: the first ones.
    pub decided: u64,
    /// How many of these meet the mesh: all, unless this program is wrong.
    pub must_hit: u64,
    /// Rays with a nearest hit that meet an even number of triangles by the device.
    pub even: u64,
    /// How many of those were decided exactly.
    pub even_decided: u64,
    /// How many of these cross single layers only, so that the number has to be odd.
    pub must_be_odd: u64,
    /// Lost rays that must hit.
    #[serde(skip)]
    pub lost_rays: Vec<Ray<f32>>,
}

/// The task of a run, as the shader reads it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Task {
    seed: u32,
    rays: u32,
    faces: u32,
    aim: u32,
    room: u32,
    distance: f32,
}

/// A ray that the device loses, or hits an even number of times.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Suspect {
    origin: [f32; 3],
    direction: [f32; 3],
    is_hit: u32,
}

/// How many suspects of a dispatch are decided: so many lost ones, and so many with an even count.
const ROOM: usize = 1024;

/// Traces aimed rays on a device.
pub struct Aimer<'a> {
    device: &'a Device,
    shader: Shader,
    rays: u64,
    seed: u32,
}

impl<'a> Aimer<'a> {
    pub fn new(device: &'a Device, rays: u64, seed: u32) -> Aimer<'a> {
        let shader = device.shader(concat!(
            include_str!("../common.wgsl"),
            include_str!("../inside.wgsl"),
            include_str!("../leaks.wgsl")
        ));
        Aimer {
            device,
            shader,
            rays,
            seed,
        }
    }

    /// Counts rays at a mesh that the device has as a structure. There have to be balls for this start.
    pub fn count(
        &self,
        world: &World,
        structure: &Structure,
        aim: Aim,
        start: Start,
    ) -> Result<Aimed, Failure> {
        let device = self.device;
        let distance = match start {
            Start::Inside => 0.0,
            Start::Away(distance) => distance,
        };
        let balls = device.storage(&world.balls_seen_from(distance));
        let corners = device.storage(&world.triangles);
        let mut counted = Aimed::default();
        for run in device.runs(self.rays) {
            let task = Task {
                seed: run.seed(self.seed),
                rays: run.rays,
                faces: world.triangles.len() as u32,
                aim: aim as u32,
                room: ROOM as u32,
                distance,
            };
            let task = device.storage(&[task]);
            let counters = device.zeros::<u32>(2);
            let suspects = device.zeros::<Suspect>(2 * ROOM);
            let bound = [
                structure.tlas.as_binding(),
                balls.as_entire_binding(),
                corners.as_entire_binding(),
                task.as_entire_binding(),
                counters.as_entire_binding(),
                suspects.as_entire_binding(),
            ];
            let mut encoder = device.gpu.create_command_encoder(&Default::default());
            device.dispatch(&mut encoder, &self.shader, &bound, run.rays);
            let [counters, suspects] = device.finish(encoder, [&counters, &suspects])?;
            let counters: Vec<u32> = bytemuck::pod_collect_to_vec(&counters);
            let suspects: Vec<Suspect> = bytemuck::pod_collect_to_vec(&suspects);
            counted.rays += u64::from(run.rays);
            counted.lost += u64::from(counters[0]);
            counted.even += u64::from(counters[1]);
            for (suspects, count) in suspects.chunks(ROOM).zip(counters) {
                for suspect in &suspects[..ROOM.min(count as usize)] {
                    counted.decide(world, suspect, start);
                }
            }
        }
        Ok(counted)
    }
}

/// True if the ray passes from one side of a single layer to the other.
fn is_crossing_of_one_layer(passage: &Passage) -> bool {
    match passage.around {
        Ok([Winding::Number(before), Winding::Number(behind)]) => {
            !passage.is_segment && before.abs_diff(behind) == 1
        }
        _ => false,
    }
}

impl Aimed {
    fn decide(&mut self, world: &World, suspect: &Suspect, start: Start) {
        let ray = Ray::new(suspect.origin, suspect.direction);
        let ray = match start {
            Start::Inside => ray,
            Start::Away(_) => ray.on(0.0, 1.0),
        };
        if suspect.is_hit == 0 {
            self.decided += 1;
            // A ray that means nothing is none that was made here.
            if let Ok(Some(_)) = world.scene.nearest(&ray) {
                self.must_hit += 1;
                self.lost_rays.push(ray);
            }
            return;
        }
        self.even_decided += 1;
        let passages = world.scene.passages(&ray).unwrap_or_default();
        let crosses_only = passages.iter().all(is_crossing_of_one_layer);
        self.must_be_odd += u64::from(crosses_only && passages.len() % 2 == 1);
    }
}
