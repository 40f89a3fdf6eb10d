//! A device with ray queries: opened, and its buffers written, read and dispatched.

// Ray queries are behind two unsafe doors of wgpu, and SPIR-V that nothing but the driver reads behind a third.
#![allow(unsafe_code)]

use crate::failure::Failure;
use bytemuck::Pod;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{Buffer, BufferUsages};

/// How many invocations a workgroup has, as in all shaders here.
const WORKGROUP: u32 = 64;

/// A device that traces rays.
pub struct Device {
    info: wgpu::AdapterInfo,
    pub gpu: wgpu::Device,
    queue: wgpu::Queue,
}

/// A compute shader that is ready to run.
pub struct Shader {
    pipeline: wgpu::ComputePipeline,
}

/// One of the dispatches of a task.
pub struct Run {
    index: u64,
    pub rays: u32,
}

impl Run {
    /// A seed of its own.
    pub fn seed(&self, seed: u32) -> u32 {
        seed.wrapping_mul(0x9e37_79b9) ^ self.index as u32
    }
}

impl Device {
    /// The first adapter with ray queries. `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` choose among several.
    pub fn open() -> Result<Device, Failure> {
        if let Ok(backends) = std::env::var("WGPU_BACKEND")
            && wgpu::Backends::from_comma_list(&backends).is_empty()
        {
            return Err(Failure::data(format!(
                "WGPU_BACKEND={backends}: no backend is called so; there are vulkan, dx12 and metal"
            )));
        }
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let has_queries = |adapter: &wgpu::Adapter| {
            let features = adapter.features();
            features.contains(wgpu::Features::EXPERIMENTAL_RAY_QUERY)
        };
        let names: Vec<String> = adapters.iter().map(|it| it.get_info().name).collect();
        let mut able: Vec<wgpu::Adapter> = adapters.into_iter().filter(has_queries).collect();
        if able.is_empty() {
            return Err(Failure::unavailable(format!(
                "no device with ray queries was found (there are: {}). A driver in software is Mesa's lavapipe of 2025 or later: \
                 on Debian 13 apt-get install mesa-vulkan-drivers",
                match names.is_empty() {
                    true => "none".to_owned(),
                    false => names.join(", "),
                }
            )));
        }
        let wanted = std::env::var("WGPU_ADAPTER_NAME").unwrap_or_default();
        let is_chosen = |adapter: &wgpu::Adapter| {
            let name = adapter.get_info().name.to_lowercase();
            name.contains(&wanted.to_lowercase())
        };
        let Some(chosen) = able.iter().position(is_chosen) else {
            let names: Vec<String> = able.iter().map(|it| it.get_info().name).collect();
            return Err(Failure::data(format!(
                "WGPU_ADAPTER_NAME={wanted}: no device with ray queries has this in its name; there are: {}",
                names.join(", ")
            )));
        };
        let adapter = able.swap_remove(chosen);
        let passthrough = wgpu::Features::PASSTHROUGH_SHADERS & adapter.features();
        let request = wgpu::DeviceDescriptor {
            label: Some("hairline-rt"),
            required_features: wgpu::Features::EXPERIMENTAL_RAY_QUERY | passthrough,
            required_limits: adapter.limits(),
            // SAFETY: wgpu calls ray queries experimental since its checks of them may have gaps. What is asked here is what their
            // specification allows.
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            ..Default::default()
        };
        let (gpu, queue) =
            pollster::block_on(adapter.request_device(&request)).map_err(Failure::unavailable)?;
        Ok(Device {
            info: adapter.get_info(),
            gpu,
            queue,
        })
    }

    /// The adapter and its driver, in a line.
    pub fn name(&self) -> String {
        let wgpu::AdapterInfo {
            name,
            driver,
            driver_info,
            backend,
            ..
        } = &self.info;
        format!("{name}, {driver} {driver_info} ({backend})").replace('\n', " ")
    }

    /// A shader from WGSL with an entry point `main`.
    pub fn shader(&self, wgsl: &str) -> Shader {
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some("hairline-rt"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        };
        // SAFETY: the shaders of this crate stay inside their buffers, as far as the driver names faces that exist, and every loop of
        // them ends. With wgpu's checks the driver would not be asked what the shader says.
        let module = unsafe {
            self.gpu
                .create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
        };
        self.pipeline(&module, None)
    }

    /// True if it takes SPIR-V as it is.
    pub fn takes_spirv(&self) -> bool {
        let features = self.gpu.features();
        features.contains(wgpu::Features::PASSTHROUGH_SHADERS)
    }

    /// A shader from SPIR-V with an entry point `main`, which nothing but the driver reads. Its buffers are at the bindings
    /// from 0 up, and it writes to the last one.
    pub fn spirv_shader(&self, words: &[u32], buffers: u32) -> Shader {
        let entry = wgpu::PassthroughShaderEntryPoint {
            name: "main".into(),
            workgroup_size: (WORKGROUP, 1, 1),
        };
        let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
            label: Some("hairline-rt"),
            entry_points: vec![entry].into(),
            spirv: Some(words.into()),
            ..Default::default()
        };
        // SAFETY: as above; the bindings are those of the layout, which the caller says.
        let module = unsafe { self.gpu.create_shader_module_passthrough(descriptor) };
        let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..buffers)
            .map(|binding| storage_at(binding, binding + 1 < buffers))
            .collect();
        let group = self
            .gpu
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: None,
                entries: &entries,
            });
        let layout = self
            .gpu
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(&group)],
                immediate_size: 0,
            });
        self.pipeline(&module, Some(&layout))
    }

    fn pipeline(
        &self,
        module: &wgpu::ShaderModule,
        layout: Option<&wgpu::PipelineLayout>,
    ) -> Shader {
        let pipeline = self
            .gpu
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("hairline-rt"),
                layout,
                module,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                cache: None,
            });
        Shader { pipeline }
    }

    /// A buffer that shaders read and write, with its contents.
    pub fn storage<T: Pod>(&self, contents: &[T]) -> Buffer {
        self.buffer(contents, BufferUsages::STORAGE | BufferUsages::COPY_SRC)
    }

    /// A buffer with its contents.
    pub fn buffer<T: Pod>(&self, contents: &[T], usage: BufferUsages) -> Buffer {
        self.gpu.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(contents),
            usage,
        })
    }

    /// A buffer of so many zeros that shaders write.
    pub fn zeros<T: Pod>(&self, count: usize) -> Buffer {
        self.gpu.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            // No buffer is empty.
            size: (count.max(1) * size_of::<T>()) as u64,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// Adds a run of a shader, for so many invocations, to what an encoder holds.
    pub fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shader: &Shader,
        bound: &[wgpu::BindingResource],
        invocations: u32,
    ) {
        let entries: Vec<wgpu::BindGroupEntry> = (0..)
            .zip(bound)
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding,
                resource: resource.clone(),
            })
            .collect();
        let group = self.gpu.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &shader.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&shader.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(invocations.div_ceil(WORKGROUP), 1, 1);
    }

    /// Runs what an encoder holds, and reads buffers back.
    pub fn finish<const N: usize>(
        &self,
        mut encoder: wgpu::CommandEncoder,
        buffers: [&Buffer; N],
    ) -> Result<[Vec<u8>; N], Failure> {
        let copies = buffers.map(|buffer| {
            let copy = self.gpu.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: buffer.size(),
                usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
            copy
        });
        self.queue.submit([encoder.finish()]);
        for copy in &copies {
            copy.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        }
        self.gpu
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(Failure::unavailable)?;
        let mut read = [const { Vec::new() }; N];
        for (bytes, copy) in read.iter_mut().zip(&copies) {
            let range = copy.slice(..).get_mapped_range();
            *bytes = range.map_err(Failure::unavailable)?.to_vec();
        }
        Ok(read)
    }

    /// The dispatches that trace so many rays, none so long that a driver takes it for a hang.
    pub fn runs(&self, rays: u64) -> impl Iterator<Item = Run> {
        let most = (1 << 22).min(self.most_invocations() as u64);
        (0..rays.div_ceil(most)).map(move |index| Run {
            index,
            rays: most.min(rays - index * most) as u32,
        })
    }

    /// The most invocations of one dispatch.
    pub fn most_invocations(&self) -> usize {
        self.gpu.limits().max_compute_workgroups_per_dimension as usize * WORKGROUP as usize
    }

    /// The most bytes of a buffer that a shader sees.
    pub fn most_bytes(&self) -> usize {
        let limits = self.gpu.limits();
        let most = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        usize::try_from(most).unwrap_or(usize::MAX)
    }
}

/// A storage buffer at a binding of a compute shader.
fn storage_at(binding: u32, read_only: bool) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}
