//! Rays that a device traces: the nearest hit of each, and all that it meets.

use crate::device::{Device, Shader};
use crate::failure::Failure;
use crate::structure::Structure;
use bytemuck::{Pod, Zeroable};
use hairline_scene::Ray;

/// A ray, as the shader takes it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct DeviceRay {
    pub origin: [f32; 3],
    pub t_min: f32,
    pub direction: [f32; 3],
    pub t_max: f32,
}

impl DeviceRay {
    /// Its numbers in the shader's order.
    pub fn of(ray: &Ray<f32>) -> DeviceRay {
        DeviceRay {
            origin: ray.origin,
            t_min: ray.t_min,
            direction: ray.direction,
            t_max: ray.t_max,
        }
    }
}

/// Everything that a device says about a ray.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Found {
    is_hit: u32,
    face: u32,
    pub t: f32,
    /// The weight of the second corner.
    pub u: f32,
    /// The weight of the third corner.
    pub v: f32,
    /// How many triangles it meets, by its candidates.
    pub count: u32,
}

/// A triangle that a ray meets.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Met {
    pub face: u32,
    pub t: f32,
}

impl Found {
    /// The nearest face.
    pub fn face(&self) -> Option<u32> {
        (self.is_hit != 0).then_some(self.face)
    }
}

/// Traces rays on a device.
pub struct Tracer<'a> {
    device: &'a Device,
    shader: Shader,
}

impl<'a> Tracer<'a> {
    pub fn new(device: &'a Device) -> Tracer<'a> {
        let shader = device.shader(concat!(
            include_str!("common.wgsl"),
            include_str!("trace.wgsl")
        ));
        Tracer { device, shader }
    }

    /// Traces rays through one structure. For each ray at most `room` of the triangles that it meets are told.
    pub fn trace(
        &self,
        structure: &Structure,
        rays: &[DeviceRay],
        room: usize,
    ) -> Result<(Vec<Found>, Vec<Met>), Failure> {
        let bytes_a_ray = size_of::<DeviceRay>().max(room * size_of::<Met>());
        let most = (self.device.most_bytes() / bytes_a_ray).min(self.device.most_invocations());
        let mut all = (Vec::new(), Vec::new());
        for rays in rays.chunks(most) {
            let mut encoder = self.device.gpu.create_command_encoder(&Default::default());
            let sizes = self.device.storage(&[rays.len() as u32, room as u32]);
            let rays_there = self.device.storage(rays);
            let found = self.device.zeros::<Found>(rays.len());
            let met = self.device.zeros::<Met>(rays.len() * room);
            let bound = [
                structure.tlas.as_binding(),
                sizes.as_entire_binding(),
                rays_there.as_entire_binding(),
                found.as_entire_binding(),
                met.as_entire_binding(),
            ];
            self.device
                .dispatch(&mut encoder, &self.shader, &bound, rays.len() as u32);
            let [found, met] = self.device.finish(encoder, [&found, &met])?;
            all.0
                .extend(bytemuck::pod_collect_to_vec::<u8, Found>(&found));
            all.1.extend(bytemuck::pod_collect_to_vec::<u8, Met>(&met));
        }
        Ok(all)
    }

    /// Traces a ray through each structure, all in one submission with what the encoder holds.
    pub fn trace_each(
        &self,
        mut encoder: wgpu::CommandEncoder,
        structures: &[Structure],
        rays: &[DeviceRay],
    ) -> Result<Vec<Found>, Failure> {
        let device = self.device;
        let alignment = device.gpu.limits().min_storage_buffer_offset_alignment as usize;
        let stride = size_of::<DeviceRay>().max(alignment);
        let mut bytes = vec![0u8; stride * rays.len()];
        for (place, ray) in rays.iter().enumerate() {
            bytes[place * stride..][..size_of::<DeviceRay>()]
                .copy_from_slice(bytemuck::bytes_of(ray));
        }
        let rays_there = device.storage(&bytes);
        let found = device.zeros::<u8>(bytes.len());
        let sizes = device.storage(&[1u32, 0]);
        let met = device.zeros::<Met>(1);
        for (place, structure) in structures.iter().enumerate() {
            let slice = |buffer, size: usize| {
                wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: (place * stride) as u64,
                    size: std::num::NonZeroU64::new(size as u64),
                })
            };
            let bound = [
                structure.tlas.as_binding(),
                sizes.as_entire_binding(),
                slice(&rays_there, size_of::<DeviceRay>()),
                slice(&found, size_of::<Found>()),
                met.as_entire_binding(),
            ];
            device.dispatch(&mut encoder, &self.shader, &bound, 1);
        }
        let [bytes] = device.finish(encoder, [&found])?;
        let found = bytes.chunks(stride);
        Ok(found
            .map(|chunk| bytemuck::pod_read_unaligned(&chunk[..size_of::<Found>()]))
            .collect())
    }
}
