//! The device: one compute pipeline, and buffers that grow with the batches.

use crate::guarded::{Code, Shader};
use crate::protocol::{Batch, CASE_BYTES, VERDICT_BYTES};
use wgpu::{Buffer, BufferUsages};

/// As in the shader.
const WORKGROUP: u32 = 64;
/// The buffers that a shader reads come before the one that it writes.
const INPUTS: usize = 3;

/// A device with the kernel on it.
pub struct Gpu {
    info: wgpu::AdapterInfo,
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    buffers: Option<Buffers>,
}

/// Room for some cases.
struct Buffers {
    room: u32,
    batch: Buffer,
    cases: Buffer,
    factors: Buffer,
    verdicts: Buffer,
    /// Where the host reads the verdicts.
    read: Buffer,
}

impl Gpu {
    /// On the first adapter that wgpu finds; an error in one line if there is none.
    /// `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` choose another.
    pub fn new(shader: &Shader) -> Result<Gpu, String> {
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let no_adapter = |error: String| {
            format!(
                "no GPU adapter was found ({error}): install a Vulkan, Metal or Direct3D 12 driver; \
                 on Debian mesa-vulkan-drivers has one in software"
            )
            .replace('\n', "; ")
        };
        let adapter = match std::env::var("WGPU_ADAPTER_NAME") {
            Ok(name) => named(&instance, &name)?,
            Err(_) => pollster::block_on(instance.request_adapter(&Default::default()))
                .map_err(|error| no_adapter(error.to_string()))?,
        };
        let request = wgpu::DeviceDescriptor {
            label: Some("hairline"),
            required_limits: adapter.limits(),
            required_features: adapter.features() & wgpu::Features::PASSTHROUGH_SHADERS,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&request))
            .map_err(|error| format!("{}: {error}", adapter.get_info().name))?;
        let module = module(&device, &shader.code)?;
        let group = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &std::array::from_fn::<_, { INPUTS + 1 }, _>(storage),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&group)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("kernel"),
            layout: Some(&layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        Ok(Gpu {
            info: adapter.get_info(),
            device,
            queue,
            pipeline,
            buffers: None,
        })
    }

    /// The adapter and its driver.
    pub fn device(&self) -> String {
        let wgpu::AdapterInfo {
            name,
            driver,
            driver_info,
            backend,
            ..
        } = &self.info;
        format!("{name}, {driver} {driver_info} ({backend})").replace('\n', " ")
    }

    /// The verdicts on a batch, as bytes.
    pub fn run(&mut self, batch: &Batch) -> Result<Vec<u8>, String> {
        if batch.count == 0 {
            return Ok(Vec::new());
        }
        if self
            .buffers
            .as_ref()
            .is_none_or(|buffers| buffers.room < batch.count)
        {
            self.buffers = Some(self.room_for(batch.count));
        }
        let buffers = self.buffers.as_ref().expect("made above");
        let mut head = batch.count.to_le_bytes().to_vec();
        head.extend(batch.parallel.to_le_bytes());
        // A zero that the compiler of a guarded kernel does not know.
        head.extend(0_u32.to_le_bytes());
        self.queue.write_buffer(&buffers.batch, 0, &head);
        self.queue.write_buffer(&buffers.cases, 0, &batch.cases);
        self.queue.write_buffer(&buffers.factors, 0, &batch.factors);

        let bound = [
            &buffers.batch,
            &buffers.cases,
            &buffers.factors,
            &buffers.verdicts,
        ];
        let entries: Vec<wgpu::BindGroupEntry> = (0..)
            .zip(bound)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(batch.count.div_ceil(WORKGROUP), 1, 1);
        }
        let size = u64::from(batch.count) * VERDICT_BYTES as u64;
        encoder.copy_buffer_to_buffer(&buffers.verdicts, 0, &buffers.read, 0, size);
        self.queue.submit([encoder.finish()]);

        let slice = buffers.read.slice(..size);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| error.to_string())?;
        let bytes = slice
            .get_mapped_range()
            .map_err(|error| error.to_string())?
            .to_vec();
        buffers.read.unmap();
        Ok(bytes)
    }

    fn room_for(&self, count: u32) -> Buffers {
        let buffer = |label, size: u64, usage| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let (cases, verdicts) = (
            u64::from(count) * CASE_BYTES as u64,
            u64::from(count) * VERDICT_BYTES as u64,
        );
        let (input, output) = (BufferUsages::COPY_DST, BufferUsages::COPY_SRC);
        Buffers {
            room: count,
            batch: buffer("batch", 12, BufferUsages::STORAGE | input),
            cases: buffer("cases", cases, BufferUsages::STORAGE | input),
            factors: buffer(
                "factors",
                4 * u64::from(count),
                BufferUsages::STORAGE | input,
            ),
            verdicts: buffer("verdicts", verdicts, BufferUsages::STORAGE | output),
            read: buffer("read", verdicts, BufferUsages::MAP_READ | input),
        }
    }
}

/// The shader on the device.
fn module(device: &wgpu::Device, code: &Code) -> Result<wgpu::ShaderModule, String> {
    let label = Some("kernel");
    match code {
        Code::Wgsl(text) => {
            let source = wgpu::ShaderSource::Wgsl(text.into());
            Ok(device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source }))
        }
        Code::SpirV(words) => {
            if !device
                .features()
                .contains(wgpu::Features::PASSTHROUGH_SHADERS)
            {
                return Err(
                    "GLSL and HLSL need Vulkan, and a device that takes SPIR-V as it is".to_owned(),
                );
            }
            let desc = wgpu::ShaderModuleDescriptorPassthrough {
                label,
                entry_points: vec![wgpu::PassthroughShaderEntryPoint {
                    name: "main".into(),
                    workgroup_size: (WORKGROUP, 1, 1),
                }]
                .into(),
                spirv: Some(words.into()),
                ..Default::default()
            };
            // wgpu's own reader of SPIR-V forgets NoContraction, and so `precise`.
            // SAFETY: the words are what glslangValidator wrote; its bindings are those of the layout, and it indexes within its buffers.
            Ok(unsafe { device.create_shader_module_passthrough(desc) })
        }
    }
}

/// A storage buffer at a binding, read-only but for the last one.
fn storage(binding: usize) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding: binding as u32,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: binding < INPUTS,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

/// The adapter whose name contains some text.
fn named(instance: &wgpu::Instance, name: &str) -> Result<wgpu::Adapter, String> {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let names: Vec<String> = adapters
        .iter()
        .map(|adapter| adapter.get_info().name)
        .collect();
    let wanted = name.to_lowercase();
    let place = names
        .iter()
        .position(|found| found.to_lowercase().contains(&wanted));
    let none = || {
        format!(
            "no GPU adapter is called '{name}'; there are: {}",
            names.join(", ")
        )
    };
    place
        .and_then(|place| adapters.into_iter().nth(place))
        .ok_or_else(none)
}
