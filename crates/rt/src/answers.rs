//! `hairline-rt answers`: what a device says about rays at a mesh, for `hairline rays --answers`.

use crate::device::Device;
use crate::failure::Failure;
use crate::input::{read_mesh, read_rays, triangles};
use crate::output::print;
use crate::structure::{Build, Part, Structure, build_one};
use crate::trace::{DeviceRay, Found, Met, Tracer};
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

/// How many triangles that a ray meets are told at once.
const ROOM: usize = 16;

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mesh = read_mesh(&arguments.mesh)?;
    let rays = read_rays(&arguments.rays)?;
    let rays: Vec<DeviceRay> = rays.iter().map(DeviceRay::of).collect();
    let device = Device::open()?;
    let whole = [Part::of(triangles(&mesh))];
    let asked = AskedRays {
        tracer: Tracer::new(&device),
        structure: &build_one(&device, &whole, Build::FastTrace)?,
        rays: &rays,
    };
    print(&match arguments.answered {
        Question::Nearest => asked.each(|found| match found.face() {
            Some(face) => format!("{face},{}", found.t),
            None => "-1".to_owned(),
        })?,
        Question::Any => asked.each(|found| u8::from(found.face().is_some()).to_string())?,
        Question::Count => asked.each(|found| found.count.to_string())?,
        Question::All => asked.all_hits()?,
    })
}

/// Rays at a mesh on a device.
struct AskedRays<'a> {
    tracer: Tracer<'a>,
    structure: &'a Structure,
    rays: &'a [DeviceRay],
}

impl AskedRays<'_> {
    /// A line a ray.
    fn each(&self, line: impl Fn(&Found) -> String) -> Result<String, Failure> {
        let (found, _) = self.tracer.trace(self.structure, self.rays, 0)?;
        Ok(found.iter().map(|found| line(found) + "\n").collect())
    }

    /// A line a hit.
    fn all_hits(&self) -> Result<String, Failure> {
        let (found, met) = self.tracer.trace(self.structure, self.rays, ROOM)?;
        let mut text = String::new();
        for (index, found) in found.iter().enumerate() {
            let count = found.count as usize;
            let mut hits = match count <= ROOM {
                true => met[index * ROOM..][..count].to_vec(),
                // It is asked once more, alone.
                false => {
                    let ray = &self.rays[index..=index];
                    self.tracer.trace(self.structure, ray, count)?.1
                }
            };
            hits.sort_by(|a, b| a.t.total_cmp(&b.t));
            for Met { face, t } in hits {
                text += &format!("{index},{face},{t}\n");
            }
        }
        Ok(text)
    }
}
