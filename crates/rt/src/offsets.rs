//! `hairline-rt offsets`: second rays on a device, from where first ones hit, with the offsets that renderers use.

use crate::device::{Device, Shader};
use crate::failure::Failure;
use crate::input::read_mesh;
use crate::output::{print, progress, write_json};
use crate::structure::{Build, Part, Structure, build_one};
use crate::world::World;
use bytemuck::{Pod, Zeroable};
use clap::ValueHint;
use hairline_files::number::write_shortest;
use hairline_record::group_digits;
use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// How often second rays hit the triangle that they leave, by the device, for each offset of their start
///
/// Try what `hairline offset --mesh MESH` recommends: --scheme normal=2.6e-7
#[derive(clap::Args)]
pub struct Arguments {
    /// A closed mesh: OBJ, PLY, STL or glTF; numbers are rounded to f32
    #[arg(value_hint = ValueHint::FilePath)]
    mesh: String,
    /// Offsets as in `hairline offset`: none, normal=DISTANCE, ulps=NUMBER, waechter-binder, t-min=T
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "none,ulps=1,ulps=4,ulps=16,waechter-binder,t-min=1e-3"
    )]
    scheme: Vec<Scheme>,
    /// First rays for each
    #[arg(short = 'n', long, default_value_t = 200_000, value_parser = clap::value_parser!(u64).range(1..))]
    count: u64,
    /// Other rays
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// The counts as JSON, too
    #[arg(short, long, value_hint = ValueHint::FilePath)]
    output: Option<String>,
}

/// Where a second ray starts.
#[derive(Clone, Copy)]
struct Scheme {
    kind: SchemeKind,
    value: f32,
}

/// As in the shader.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SchemeKind {
    None,
    Normal,
    Ulps,
    WaechterBinder,
    TMin,
}

impl SchemeKind {
    const NAMED: [(SchemeKind, &str); 5] = [
        (SchemeKind::None, "none"),
        (SchemeKind::Normal, "normal"),
        (SchemeKind::Ulps, "ulps"),
        (SchemeKind::WaechterBinder, "waechter-binder"),
        (SchemeKind::TMin, "t-min"),
    ];

    fn takes_a_value(self) -> bool {
        !matches!(self, SchemeKind::None | SchemeKind::WaechterBinder)
    }
}

impl FromStr for Scheme {
    type Err = String;

    fn from_str(text: &str) -> Result<Scheme, String> {
        let (name, value) = match text.split_once('=') {
            Some((name, value)) => (name, Some(value)),
            None => (text, None),
        };
        let named = SchemeKind::NAMED.iter().find(|(_, known)| *known == name);
        let &(kind, _) = named.ok_or_else(|| {
            let names = SchemeKind::NAMED.map(|(_, name)| name).join(", ");
            format!("no offset is called '{name}'; there are {names}")
        })?;
        match (kind.takes_a_value(), value) {
            (false, None) => Ok(Scheme { kind, value: 0.0 }),
            (false, Some(_)) => Err(format!("{name} takes no value")),
            (true, None) => Err(format!("expected a value, as in {name}=1e-3")),
            (true, Some(value)) => match value.parse() {
                Ok(value) if (0.0..f32::INFINITY).contains(&value) => Ok(Scheme { kind, value }),
                _ => Err(format!("expected a number from 0 on, found '{value}'")),
            },
        }
    }
}

impl Scheme {
    fn name(self) -> String {
        let named = SchemeKind::NAMED
            .iter()
            .find(|(kind, _)| *kind == self.kind);
        let name = named.map_or("", |(_, name)| name);
        match self.kind.takes_a_value() {
            true => format!("{name}={}", write_shortest(self.value)),
            false => name.to_owned(),
        }
    }
}

/// The task of a run, as the shader reads it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Task {
    seed: u32,
    rays: u32,
    scheme: u32,
    value: f32,
    is_along_ray: u32,
}

/// Second rays of one offset.
#[derive(Serialize)]
struct Counted {
    scheme: String,
    /// From the vertices and u, v; and o + t*d.
    points: [Seconds; 2],
}

/// Second rays.
#[derive(Default, Serialize)]
struct Seconds {
    rays: u64,
    /// Those that hit the triangle that they leave.
    self_hits: u64,
    /// Those that hit nothing, though they start inside a closed mesh: most started behind its surface.
    lost: u64,
}

/// Everything that was counted.
#[derive(Serialize)]
struct Offsets {
    device: String,
    mesh: String,
    faces: u64,
    seed: u32,
    schemes: Vec<Counted>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mesh = read_mesh(&arguments.mesh)?;
    let world = World::new(&mesh, 1.0, arguments.seed);
    let world = world.map_err(|why| Failure::data(format!("{}: {why}", mesh.name)))?;
    let device = Device::open()?;
    let whole = [Part::of(world.triangles.clone())];
    let traced = Traced {
        shader: device.shader(concat!(
            include_str!("common.wgsl"),
            include_str!("inside.wgsl"),
            include_str!("offsets.wgsl")
        )),
        device: &device,
        structure: &build_one(&device, &whole, Build::FastTrace)?,
        world: &world,
        arguments,
    };
    let mut schemes = Vec::new();
    for &scheme in &arguments.scheme {
        progress(&scheme.name());
        schemes.push(Counted {
            scheme: scheme.name(),
            points: [traced.count(scheme, false)?, traced.count(scheme, true)?],
        });
    }
    progress("");
    let offsets = Offsets {
        device: device.name(),
        mesh: mesh.name.clone(),
        faces: mesh.triangles.len() as u64,
        seed: arguments.seed,
        schemes,
    };
    print(&offsets)?;
    match &arguments.output {
        Some(path) => write_json(path, &offsets),
        None => Ok(()),
    }
}

/// A mesh on a device, and how it is asked.
struct Traced<'a> {
    device: &'a Device,
    shader: Shader,
    structure: &'a Structure,
    world: &'a World,
    arguments: &'a Arguments,
}

impl Traced<'_> {
    /// Counts second rays of an offset, from points of one form.
    fn count(&self, scheme: Scheme, is_along_ray: bool) -> Result<Seconds, Failure> {
        let balls = self.device.storage(&self.world.balls);
        let corners = self.device.storage(&self.world.triangles);
        let mut seconds = Seconds::default();
        for run in self.device.runs(self.arguments.count) {
            let task = self.device.storage(&[Task {
                seed: run.seed(self.arguments.seed),
                rays: run.rays,
                scheme: scheme.kind as u32,
                value: scheme.value,
                is_along_ray: u32::from(is_along_ray),
            }]);
            let counters = self.device.zeros::<u32>(3);
            let bound = [
                self.structure.tlas.as_binding(),
                balls.as_entire_binding(),
                corners.as_entire_binding(),
                task.as_entire_binding(),
                counters.as_entire_binding(),
            ];
            let mut encoder = self.device.gpu.create_command_encoder(&Default::default());
            self.device
                .dispatch(&mut encoder, &self.shader, &bound, run.rays);
            let [counters] = self.device.finish(encoder, [&counters])?;
            let counters: Vec<u32> = bytemuck::pod_collect_to_vec(&counters);
            seconds.rays += u64::from(counters[0]);
            seconds.self_hits += u64::from(counters[1]);
            seconds.lost += u64::from(counters[2]);
        }
        Ok(seconds)
    }
}

impl fmt::Display for Offsets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.device)?;
        writeln!(
            f,
            "{}: {} faces; rays inside it, and second rays from where they hit",
            self.mesh,
            group_digits(self.faces)
        )?;
        writeln!(f)?;
        writeln!(
            f,
            "{:20} {:^31} {:^31}",
            "", "p = (1-u-v)*a + u*b + v*c", "p = o + t*d"
        )?;
        writeln!(
            f,
            "{:20} {}",
            "offset",
            "      rays  self-hits      lost ".repeat(2)
        )?;
        for Counted { scheme, points } in &self.schemes {
            write!(f, "{scheme:20}")?;
            for seconds in points {
                let counts = [seconds.rays, seconds.self_hits, seconds.lost];
                let [rays, self_hits, lost] = counts.map(group_digits);
                write!(f, " {rays:>9} {self_hits:>10} {lost:>9} ")?;
            }
            writeln!(f)?;
        }
        writeln!(f)?;
        writeln!(
            f,
            "self-hits  the second ray hits the triangle that it leaves"
        )?;
        writeln!(
            f,
            "lost       it hits nothing, though it starts inside: most of these start behind the surface"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_have_the_names_of_hairline_offset() {
        let told = |text: &str| text.parse::<Scheme>().map(Scheme::name);
        for name in [
            "none",
            "normal=2.6e-7",
            "ulps=4",
            "waechter-binder",
            "t-min=0.001",
        ] {
            assert!(
                told(name).is_ok_and(|told| told.parse::<Scheme>().is_ok()),
                "{name}"
            );
        }
        assert_eq!(told("normal=2.6e-7").as_deref(), Ok("normal=2.6e-7"));
        let refused = [
            "normal",
            "none=1",
            "normal=-1",
            "normal=nan",
            "normal=1e99",
            "pbrt",
        ];
        for text in refused {
            assert!(told(text).is_err(), "{text}");
        }
    }
}
