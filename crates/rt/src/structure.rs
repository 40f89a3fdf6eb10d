//! Acceleration structures: the driver builds them from triangles, and its rays ask them.

use crate::device::Device;
use crate::failure::Failure;
use wgpu::{AccelerationStructureFlags, AccelerationStructureGeometryFlags};

/// The corners of a triangle.
pub type Triangle = [[f32; 3]; 3];

/// Triangles under one translation: a bottom-level structure, and its only instance.
pub struct Part {
    /// The triangles, before they are moved.
    pub triangles: Vec<Triangle>,
    /// Where they are moved.
    pub translation: [f32; 3],
}

/// Parts that rays meet together: a top-level structure.
pub struct Structure {
    pub tlas: wgpu::Tlas,
}

/// How the driver builds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Build {
    FastTrace,
    FastBuild,
}

impl Part {
    /// Triangles that are not moved.
    pub fn of(triangles: Vec<Triangle>) -> Part {
        Part {
            triangles,
            translation: [0.0; 3],
        }
    }

    /// The matrix of its instance, in three rows of four.
    fn transform(&self) -> [f32; 12] {
        let [x, y, z] = self.translation;
        [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z]
    }
}

/// Builds one structure.
pub fn build_one(device: &Device, parts: &[Part], how: Build) -> Result<Structure, Failure> {
    let mut encoder = device.gpu.create_command_encoder(&Default::default());
    let mut structures = build(device, &mut encoder, &[parts], how)?;
    device.finish(encoder, [])?;
    Ok(structures.remove(0))
}

/// Builds many structures, each of some parts, at once.
pub fn build(
    device: &Device,
    encoder: &mut wgpu::CommandEncoder,
    scenes: &[&[Part]],
    build: Build,
) -> Result<Vec<Structure>, Failure> {
    let flags = match build {
        Build::FastTrace => AccelerationStructureFlags::PREFER_FAST_TRACE,
        Build::FastBuild => AccelerationStructureFlags::PREFER_FAST_BUILD,
    };
    let parts: Vec<&Part> = scenes.iter().copied().flatten().collect();
    let most = device.gpu.limits().max_blas_primitive_count as usize;
    if let Some(part) = parts.iter().find(|part| most < part.triangles.len()) {
        return Err(Failure::data(format!(
            "{} triangles are too many for this device, which takes {most}",
            part.triangles.len()
        )));
    }
    let corners: Vec<Triangle> = parts
        .iter()
        .flat_map(|part| &part.triangles)
        .copied()
        .collect();
    let buffer = device.buffer(&corners, wgpu::BufferUsages::BLAS_INPUT);
    let sizes: Vec<_> = parts.iter().map(|part| size_of_part(part)).collect();
    let bottoms: Vec<wgpu::Blas> = sizes
        .iter()
        .map(|size| {
            let descriptor = wgpu::CreateBlasDescriptor {
                label: None,
                flags,
                update_mode: wgpu::AccelerationStructureUpdateMode::Build,
            };
            let descriptors = vec![size.clone()];
            let sizes = wgpu::BlasGeometrySizeDescriptors::Triangles { descriptors };
            device.gpu.create_blas(&descriptor, sizes)
        })
        .collect();

    let mut first_vertex = 0;
    let mut entries = Vec::new();
    for (size, bottom) in sizes.iter().zip(&bottoms) {
        entries.push(wgpu::BlasBuildEntry {
            blas: bottom,
            geometry: wgpu::BlasGeometries::TriangleGeometries(vec![wgpu::BlasTriangleGeometry {
                size,
                vertex_buffer: &buffer,
                first_vertex,
                vertex_stride: size_of::<[f32; 3]>() as u64,
                index_buffer: None,
                first_index: None,
                transform_buffer: None,
                transform_buffer_offset: None,
            }]),
        });
        first_vertex += size.vertex_count;
    }
    let mut bottom = bottoms.iter();
    let tops: Vec<wgpu::Tlas> = scenes
        .iter()
        .map(|scene| {
            let mut tlas = device.gpu.create_tlas(&wgpu::CreateTlasDescriptor {
                label: None,
                max_instances: scene.len() as u32,
                flags,
                update_mode: wgpu::AccelerationStructureUpdateMode::Build,
            });
            for (place, (part, blas)) in scene.iter().zip(bottom.by_ref()).enumerate() {
                let instance = wgpu::TlasInstance::new(blas, part.transform(), 0, 0xff);
                tlas[place] = Some(instance);
            }
            tlas
        })
        .collect();
    encoder.build_acceleration_structures(entries.iter(), tops.iter());
    Ok(tops.into_iter().map(|tlas| Structure { tlas }).collect())
}

fn size_of_part(part: &Part) -> wgpu::BlasTriangleGeometrySizeDescriptor {
    wgpu::BlasTriangleGeometrySizeDescriptor {
        vertex_format: wgpu::VertexFormat::Float32x3,
        vertex_count: 3 * part.triangles.len() as u32,
        index_format: None,
        index_count: None,
        // So that a triangle is counted once.
        flags: AccelerationStructureGeometryFlags::NO_DUPLICATE_ANY_HIT_INVOCATION,
    }
}
