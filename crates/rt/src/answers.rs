//! `hairline-rt answers`: what a device says about rays at a mesh, for `hairline rays --answers`.

use crate::device::Device;
use crate::failure::Failure;
use crate::input::{read_mesh, read_rays, triangles};
use crate::output::print;
use crate::structure::{Build, Part, build};
use crate::trace::{DeviceRay, Tracer};
use clap::ValueEnum;

/// The device's answers about rays at a mesh, as CSV for `hairline rays MESH RAYS --answers`
///
/// hairline-rt answers model.obj rays.csv > answers.csv; hairline rays model.obj rays.csv --answers answers.csv --scalar f32
#[derive(clap::Args)]
pub struct Arguments {
    /// OBJ, PLY, STL or glTF; numbers are rounded to f32
    mesh: String,
    /// Rays as `hairline rays --make` writes them: six numbers a line, or eight with t_min and t_max
    rays: String,
    /// The question
    #[arg(long, value_enum, default_value = "nearest")]
    answered: Question,
}

/// A question about a ray.
#[derive(Clone, Copy, ValueEnum)]
enum Question {
    /// The face and t of the nearest hit
    Nearest,
    /// 1 if the ray meets anything, or 0
    Any,
    /// How many triangles it meets
    Count,
    /// Every triangle that it meets
    All,
}

/// How many triangles that a ray meets are told at first.
const ROOM: usize = 16;

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mesh = read_mesh(&arguments.mesh)?;
    let rays = read_rays(&arguments.rays)?;
    let rays: Vec<DeviceRay> = rays.iter().map(DeviceRay::of).collect();
    let device = Device::open()?;
    let mut encoder = device.gpu.create_command_encoder(&Default::default());
    let part = Part::of(triangles(&mesh));
    let structures = build(&device, &mut encoder, &[vec![part]], Build::FastTrace)?;
    device.finish(encoder, [])?;
    let tracer = Tracer::new(&device);
    let mut room = match arguments.answered {
        Question::All => ROOM,
        _ => 0,
    };
    let (mut found, mut met) = tracer.trace(&structures[0], &rays, room)?;
    let most = found.iter().map(|found| found.count as usize).max();
    if let (Question::All, Some(most)) = (arguments.answered, most.filter(|most| room < *most)) {
        room = most;
        (found, met) = tracer.trace(&structures[0], &rays, room)?;
    }

    let mut text = String::new();
    for (index, found) in found.iter().enumerate() {
        match (arguments.answered, found.face()) {
            (Question::Nearest, Some(face)) => text += &format!("{face},{}\n", found.t),
            (Question::Nearest, None) => text += "-1\n",
            (Question::Any, face) => text += &format!("{}\n", u8::from(face.is_some())),
            (Question::Count, _) => text += &format!("{}\n", found.count),
            (Question::All, _) => {
                let mut hits = met[index * room..][..found.count as usize].to_vec();
                hits.sort_by(|a, b| a.t.total_cmp(&b.t));
                for hit in hits {
                    text += &format!("{index},{},{}\n", hit.face, hit.t);
                }
            }
        }
    }
    print(&text)
}
