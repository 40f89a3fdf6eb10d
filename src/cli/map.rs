//! `hairline map`: where a kernel is wrong, one pixel one input; and a case drawn.

mod summary;

use super::before::set_threads;
use super::case::CaseArguments;
use super::exit::{Failure, Status};
use super::flags::{find_scalar, unknown};
use super::output::write_results;
use super::outputs::{format_of, paired_outputs};
use super::progress::Progress;
use super::select::KernelArguments;
use crate::arith::ScalarName;
use crate::audit::Row;
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::kernel::Scalar;
use crate::map::{self, CaseVector, Map, PixelStep, Spot};
use crate::printable::printable_lines;
use crate::report::{Format, Style};
use clap::Args;
use std::io::{self, Write};

/// Which input, whose verdicts, which pixels, and where to.
#[derive(Args)]
pub struct MapArguments {
    /// A case id, the name of a stored case, or a case as JSON
    #[arg(value_name = "CASE")]
    case: Option<String>,

    /// The mesh that the case's id names
    #[arg(long, value_name = "FILE")]
    mesh: Option<String>,

    /// Where the stored case is: a JSON lines file, or a folder of them
    #[arg(long, value_name = "FILE|DIR")]
    corpus: Option<String>,

    /// A standard spot instead of a case: edge, vertex, grazing [default: edge]
    #[arg(long, value_name = "SPOT", conflicts_with = "case")]
    at: Option<String>,

    /// The scalar of --at: f32 or f64 [default: f32]
    #[arg(long, value_name = "SCALAR", conflicts_with = "case")]
    scalar: Option<String>,

    #[command(flatten)]
    kernels: KernelArguments,

    /// Which point to vary: origin, direction, a, b or c [default: origin]
    #[arg(long, value_name = "POINT")]
    vary: Option<String>,

    /// The coordinates to vary, to the right and upwards [default: the two that lie most in the
    /// triangle's plane]
    #[arg(long, value_name = "AXIS,AXIS")]
    axes: Option<String>,

    /// The step from pixel to pixel: a number of floats, as 1, or a length, as 2^-24 [default: 1 float;
    /// where a coordinate is 0, the ulp of the largest one]
    #[arg(long, value_name = "ULPS|2^K", allow_hyphen_values = true)]
    step: Option<String>,

    /// Width and height in pixels, the case in the middle; one number for both
    #[arg(
        long,
        value_name = "W[xH]",
        default_value = "128",
        allow_hyphen_values = true
    )]
    size: String,

    /// The side of a pixel in a PNG, in dots [default: the picture becomes about 1000 dots wide]
    #[arg(long, value_name = "N")]
    dots: Option<usize>,

    /// Draw the case instead: the triangle, the ray, where they meet, and where the kernel reports a hit
    /// (SVG)
    #[arg(long, conflicts_with_all = ["vary", "axes", "step", "size", "dots"])]
    drawing: bool,

    /// text, svg or png, or several separated by commas [default: by the ending of each output's name;
    /// text without outputs]
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// Print no summary beside the picture
    #[arg(long, short)]
    quiet: bool,
}

/// One row per format.
const FORMATS: &[Format<MapPicture>] = &[
    Format {
        name: "text",
        write: |picture, _, out| out.write_all(printable_lines(&picture.summary).as_bytes()),
    },
    Format {
        name: "svg",
        write: |picture, _, out| out.write_all(picture.svg.as_bytes()),
    },
    Format {
        name: "png",
        write: |picture, _, out| out.write_all(&picture.png),
    },
];

/// The most pixels of an SVG, which has a shape for each run of them.
const MOST_SVG_PIXELS: usize = 1 << 18;

/// The width of a PNG, if nothing else is said.
const DOTS_WIDE: usize = 1024;

/// The most kernels that stand side by side.
const MOST_ROWS: usize = 4;

/// A picture and what is said about it.
#[derive(Default)]
struct MapPicture {
    summary: String,
    svg: String,
    png: Vec<u8>,
    maps: Vec<Map>,
}

/// Runs the command.
pub fn run(arguments: &MapArguments) -> Result<Status, Failure> {
    let formats = arguments.formats()?;
    let outputs = paired_outputs(FORMATS, &formats, &arguments.output)?;
    let wants = |name: &str| outputs.iter().any(|(format, _)| format.name == name);
    if arguments.drawing && wants("png") {
        return Err(Failure::usage(
            "a drawing is written as svg or text, not as png",
        ));
    }
    set_threads(arguments.threads)?;
    let [width, height] = arguments.size()?;
    if !arguments.drawing && wants("svg") && width * height > MOST_SVG_PIXELS {
        return Err(Failure::usage(format!(
            "--size: {width}x{height} pixels are too many for an SVG, which takes {MOST_SVG_PIXELS} (512x512); write a PNG"
        )));
    }
    let mut picture = either_scalar!(&arguments.input()?, case => arguments.of_case(case))?;
    if let (Some(map), true) = (picture.maps.first(), wants("png")) {
        let panels = picture.maps.len() + 1;
        picture.png = map::png(&picture.maps, arguments.dots(map, panels))?;
    }
    let quiet = arguments.quiet || wants("text");
    write_results(outputs, |format, _, out| {
        (format.write)(&picture, Style::default(), out)
    })?;
    if !quiet {
        // A summary that nobody reads is no error.
        let _ = io::stderr().write_all(printable_lines(&picture.summary).as_bytes());
    }
    Ok(Status::Success)
}

/// The names of some rows.
fn labels(rows: &[Row]) -> String {
    let labels: Vec<String> = rows.iter().map(Row::label).collect();
    labels.join(", ")
}

impl MapArguments {
    /// The case.
    fn input(&self) -> Result<AnyCase, Failure> {
        let Some(case) = self.case.clone() else {
            return self.standard();
        };
        let (mesh, corpus) = (self.mesh.clone(), self.corpus.clone());
        let named = CaseArguments { case, mesh, corpus };
        either_scalar!(&named.cases()?, group => Ok((*named.one(group)?).into()))
    }

    /// The case of `--at`.
    fn standard(&self) -> Result<AnyCase, Failure> {
        let name = self.at.as_deref().unwrap_or(Spot::Edge.name());
        let names = Spot::ALL.map(Spot::name);
        let spot =
            Spot::named(name).ok_or_else(|| unknown("spot", name, names, "hairline map --help"))?;
        Ok(
            match find_scalar(self.scalar.as_deref().unwrap_or("f32"))? {
                ScalarName::F32 => AnyCase::F32(spot.case()),
                ScalarName::F64 => AnyCase::F64(spot.case()),
            },
        )
    }

    /// The formats that are named, or that the outputs' names end in.
    fn formats(&self) -> Result<Vec<String>, Failure> {
        if !self.format.is_empty() {
            return Ok(self.format.clone());
        }
        if self.output.is_empty() {
            return Ok(vec!["text".to_owned()]);
        }
        let of = |output: &String| {
            format_of(FORMATS, output)
                .map(str::to_owned)
                .ok_or_else(|| {
                    Failure::usage(format!(
                        "-o {output}: its name does not end in .svg, .png or .txt; say --format"
                    ))
                })
        };
        self.output.iter().map(of).collect()
    }

    fn of_case<F: Scalar>(&self, case: &Case<F>) -> Result<MapPicture, Failure> {
        let rows = self.rows()?;
        for row in &rows {
            row.check::<F>()?;
        }
        if self.drawing {
            let [row] = &rows[..] else {
                return Err(Failure::usage(format!(
                    "a drawing is of one kernel with one set of epsilons, and there are {}",
                    labels(&rows)
                )));
            };
            let svg = map::drawing_document(case, row)?;
            let summary = summary::of_drawing(case, row);
            return Ok(MapPicture {
                summary,
                svg,
                ..MapPicture::default()
            });
        }
        let part = self.varied()?;
        let (axes, step, size) = (self.axes()?, self.step()?, self.size()?);
        let grid = map::grid_of_case(case, part, axes, step, size)?;
        let pixels = size[0] * size[1];
        let all_pixels = (pixels * rows.len()) as u64;
        let progress = Progress::new(all_pixels, "pixels", self.quiet);
        let mut maps = Vec::new();
        let mut summary = String::new();
        for row in &rows {
            let map = map::of_kernel(case, row, &grid, &progress)?;
            let again = |pixel| summary::explain(&map::case_at(case, &grid, pixel), row);
            summary += &summary::of_map(&map, &grid, &again);
            maps.push(map);
        }
        map::compared(&maps)?;
        let is_small = pixels <= MOST_SVG_PIXELS;
        let svg = if is_small {
            map::svg_document(&maps)
        } else {
            String::new()
        };
        Ok(MapPicture {
            summary,
            svg,
            maps,
            ..MapPicture::default()
        })
    }

    /// The kernels with their epsilons, a panel each.
    fn rows(&self) -> Result<Vec<Row>, Failure> {
        if !self.kernels.names_kernels() {
            let message = "a map is of one kernel, or of a few: choose them by --kernel (see `hairline list kernels`)";
            return Err(Failure::usage(message));
        }
        let rows = self.kernels.rows()?;
        if MOST_ROWS < rows.len() {
            return Err(Failure::usage(format!(
                "a map has room for {MOST_ROWS} kernels, each with one set of epsilons, and there are {}: {}",
                rows.len(),
                labels(&rows)
            )));
        }
        Ok(rows)
    }

    /// Which vector is varied.
    fn varied(&self) -> Result<CaseVector, Failure> {
        let Some(name) = &self.vary else {
            return Ok(CaseVector::Origin);
        };
        CaseVector::named(name).ok_or_else(|| {
            let names = CaseVector::ALL.map(CaseVector::name).join(", ");
            Failure::usage(format!("--vary: unknown point '{name}': there are {names}"))
        })
    }

    fn axes(&self) -> Result<Option<[usize; 2]>, Failure> {
        let Some(text) = &self.axes else {
            return Ok(None);
        };
        let coordinate = |name: &str| ["x", "y", "z"].iter().position(|axis| *axis == name.trim());
        text.split_once(',')
            .and_then(|(a, b)| Some([coordinate(a)?, coordinate(b)?]))
            .map(Some)
            .ok_or_else(|| {
                Failure::usage(format!("--axes: '{text}' are not two of x, y, z, as x,y"))
            })
    }

    fn step(&self) -> Result<Option<PixelStep>, Failure> {
        let Some(text) = &self.step else {
            return Ok(None);
        };
        let power = |k: &str| {
            k.parse()
                .ok()
                .filter(|k| (-1100..=1100).contains(k))
                .map(PixelStep::PowerOfTwo)
        };
        let step = match text.strip_prefix("2^") {
            Some(k) => power(k),
            None => text
                .parse()
                .ok()
                .filter(|ulps| *ulps >= 1)
                .map(PixelStep::Ulps),
        };
        step.map(Some).ok_or_else(|| {
            Failure::usage(format!(
                "--step: '{text}' is neither a number of floats from 1, as 16, nor 2^k with |k| <= 1100"
            ))
        })
    }

    fn size(&self) -> Result<[usize; 2], Failure> {
        let side = |text: &str| {
            text.parse()
                .ok()
                .filter(|side| (1..=map::MOST_PIXELS).contains(side))
        };
        let (width, height) = self
            .size
            .split_once('x')
            .unwrap_or((&self.size, &self.size));
        side(width)
            .zip(side(height))
            .map(|(width, height)| [width, height])
            .ok_or_else(|| {
                Failure::usage(format!(
                    "--size: '{}' is not W or WxH with sides from 1 to {} pixels",
                    self.size,
                    map::MOST_PIXELS
                ))
            })
    }

    /// The side of a pixel in a PNG of so many panels.
    fn dots(&self, map: &Map, panels: usize) -> usize {
        let [width, height] = map.size();
        let fitting = DOTS_WIDE / panels / width.max(height);
        self.dots.unwrap_or(fitting.max(1))
    }
}
