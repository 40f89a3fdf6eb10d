//! `hairline-rt leaks`: rays from inside a closed mesh that a device lets out, decided again exactly.

mod aim;
mod report;

use crate::device::Device;
use crate::failure::Failure;
use crate::input::read_mesh;
use crate::output::{check_output, print, progress, write_file, write_json};
use crate::structure::{Build, Part, build_one};
use crate::world::World;
use aim::{Aim, Aimer, Start};
use clap::ValueHint;
use hairline_rays::MadeRays;
use report::{FromAfar, Leaks, Row, Scaled};
use std::process::ExitCode;

/// Rays from inside a closed mesh that the device lets out, or hits twice
///
/// Rays start inside, so each has to meet the mesh, an odd number of times where it only crosses it. With --far others come from
/// outside and end inside. The first lost rays are decided again, exactly. Ends with 1 if one of these has to hit.
#[derive(clap::Args)]
pub struct Arguments {
    /// A closed mesh: OBJ, PLY, STL or glTF; numbers are rounded to f32
    #[arg(value_hint = ValueHint::FilePath)]
    mesh: String,
    /// Rays of each count
    #[arg(short = 'n', long, default_value_t = 200_000, value_parser = clap::value_parser!(u64).range(1..))]
    count: u64,
    /// Other rays
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Cuts the box of the mesh into K × K × K tiles, each an instance with a translation of its own
    #[arg(long, value_name = "K", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=64))]
    tiles: u32,
    /// The mesh in all sizes too: scaled by 1e-44 to 1e37
    #[arg(long)]
    scales: bool,
    /// Rays from outside too, that start 1 to 100,000 times the diagonal of the mesh's box away
    #[arg(long)]
    far: bool,
    /// Writes lost rays of the mesh as it is, those from outside too, into a file for `hairline rays MESH FILE`
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    lost: Option<String>,
    /// The counts as JSON, too
    #[arg(short, long, value_hint = ValueHint::FilePath)]
    output: Option<String>,
}

/// How far away rays start, in diagonals of the mesh's box.
const SIZES_AWAY: [f32; 6] = [1.0, 10.0, 100.0, 1e3, 1e4, 1e5];

/// The powers of ten that meshes are scaled by.
const EXPONENTS: std::ops::RangeInclusive<i32> = -44..=37;

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    for path in arguments.lost.iter().chain(&arguments.output) {
        check_output(path)?;
    }
    let mesh = read_mesh(&arguments.mesh)?;
    let device = Device::open()?;
    let aimer = Aimer::new(&device, arguments.count, arguments.seed);
    let world = World::new(&mesh, 1.0, arguments.seed)
        .map_err(|why| Failure::data(format!("{}: {why}", mesh.name)))?;

    let whole = [Part::of(world.triangles.clone())];
    let counted = |name: &str, world: &World, parts: &[Part], how: Build| {
        let structure = build_one(&device, parts, how)?;
        let mut aimed = Vec::new();
        for aim in Aim::ALL {
            progress(&format!("{name}, {aim}"));
            aimed.push(aimer.count(world, &structure, aim, Start::Inside)?);
        }
        Ok::<Row, Failure>(Row::new(name, aimed))
    };
    let mut rows = vec![
        counted("one structure", &world, &whole, Build::FastTrace)?,
        counted(
            "built for speed of building",
            &world,
            &whole,
            Build::FastBuild,
        )?,
    ];
    // A mesh far from the origin may lose its inside on the grid.
    if let Ok(tiled) = world.on_a_grid() {
        let tiles = tiled.tiles(arguments.tiles);
        let name = format!("{} instances with translations", tiles.len());
        rows.push(counted(&name, &tiled, &tiles, Build::FastTrace)?);
    }

    let mut from_afar = Vec::new();
    let structure = build_one(&device, &whole, Build::FastTrace)?;
    for sizes in SIZES_AWAY.into_iter().filter(|_| arguments.far) {
        let distance = sizes * world.size();
        if !world.is_seen_from(distance) {
            from_afar.push(FromAfar {
                sizes,
                counted: None,
            });
            continue;
        }
        progress(&format!("from {sizes} diagonals of its box away"));
        let counted = aimer.count(&world, &structure, Aim::Vertex, Start::Away(distance))?;
        from_afar.push(FromAfar {
            sizes,
            counted: Some(counted),
        });
    }
    let mut scaled = Vec::new();
    for exponent in EXPONENTS.filter(|_| arguments.scales) {
        progress(&format!("scaled by 1e{exponent}"));
        // A size at which numbers of f32 do not hold the mesh is no fault of the device.
        let Ok(world) = World::new(&mesh, 10f64.powi(exponent), arguments.seed) else {
            continue;
        };
        let whole = [Part::of(world.triangles.clone())];
        let structure = build_one(&device, &whole, Build::FastTrace)?;
        let counted = aimer.count(&world, &structure, Aim::Vertex, Start::Inside)?;
        scaled.push(Scaled { exponent, counted });
    }
    progress("");
    let leaks = Leaks {
        device: device.name(),
        mesh: mesh.name.clone(),
        faces: mesh.triangles.len() as u64,
        rays: arguments.count,
        seed: arguments.seed,
        rows,
        from_afar,
        scaled,
    };
    print(&leaks)?;
    if let Some(path) = &arguments.lost {
        let mut csv = Vec::new();
        MadeRays(leaks.lost_rays())
            .write(&mut csv)
            .expect("memory takes all of it");
        write_file(path, &csv)?;
    }
    if let Some(path) = &arguments.output {
        write_json(path, &leaks)?;
    }
    Ok(ExitCode::from(u8::from(leaks.any_lost())))
}
