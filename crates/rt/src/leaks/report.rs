//! The screen of `leaks`.

use super::aim::{Aim, Aimed};
use hairline_record::group_digits;
use hairline_scene::Ray;
use serde::Serialize;
use std::fmt;

/// The counts of a mesh on a device.
#[derive(Serialize)]
pub struct Leaks {
    pub device: String,
    pub mesh: String,
    pub faces: u64,
    /// Rays of each count.
    pub rays: u64,
    pub seed: u32,
    pub rows: Vec<Row>,
    pub from_afar: Vec<FromAfar>,
    pub scaled: Vec<Scaled>,
}

/// Counts of one way to build the mesh.
#[derive(Serialize)]
pub struct Row {
    name: String,
    /// At vertices, at edges, into faces.
    aimed: Vec<Aimed>,
}

/// Counts of rays at vertices that start outside.
#[derive(Serialize)]
pub struct FromAfar {
    /// How far away, in diagonals of the mesh's box.
    pub sizes: f32,
    /// None where the numbers of f32 do not hold such rays.
    pub counted: Option<Aimed>,
}

/// Counts of rays at vertices of the mesh in some size.
#[derive(Serialize)]
pub struct Scaled {
    pub exponent: i32,
    pub counted: Aimed,
}

/// How many of a size's rays are lost.
#[derive(Clone, Copy, PartialEq)]
enum Share {
    Nothing,
    /// At most twice as many as in the size that the file has, and a few.
    AsUsual,
    More,
    All,
}

impl Row {
    pub fn new(name: &str, aimed: Vec<Aimed>) -> Row {
        Row {
            name: name.to_owned(),
            aimed,
        }
    }
}

impl Scaled {
    /// Beside the count in the size that the file has.
    fn share(&self, usual: u64) -> Share {
        let Aimed { lost, rays, .. } = self.counted;
        match lost {
            0 => Share::Nothing,
            lost if lost == rays => Share::All,
            lost if lost <= 2 * usual + 10 => Share::AsUsual,
            _ => Share::More,
        }
    }
}

impl Leaks {
    /// True if a ray is lost that must hit.
    pub fn any_lost(&self) -> bool {
        self.all().any(|aimed| aimed.must_hit > 0)
    }

    fn all(&self) -> impl Iterator<Item = &Aimed> {
        let rows = self.rows.iter().flat_map(|row| &row.aimed);
        let from_afar = self.from_afar.iter().filter_map(|it| it.counted.as_ref());
        let scaled = self.scaled.iter().map(|it| &it.counted);
        rows.chain(from_afar).chain(scaled)
    }

    /// Lost rays of the mesh as it is, in one structure.
    pub fn lost_rays(&self) -> Vec<Ray<f32>> {
        let from_inside = self.rows.iter().take(1).flat_map(|row| &row.aimed);
        let from_afar = self.from_afar.iter().filter_map(|it| it.counted.as_ref());
        let aimed = from_inside.chain(from_afar);
        let mut rays: Vec<Ray<f32>> = aimed.flat_map(|aimed| aimed.lost_rays.clone()).collect();
        let bits = |ray: &Ray<f32>| {
            let [origin, direction] = [ray.origin, ray.direction].map(|it| it.map(f32::to_bits));
            (origin, direction, ray.t_max.to_bits())
        };
        rays.sort_by_key(bits);
        rays.dedup_by_key(|ray| bits(ray));
        rays
    }
}

impl fmt::Display for Leaks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.device)?;
        writeln!(
            f,
            "{}: {} faces, {} rays of each count, each from or to a point inside: it has to meet the mesh",
            self.mesh,
            group_digits(self.faces),
            group_digits(self.rays)
        )?;
        writeln!(f)?;
        writeln!(
            f,
            "{:34} {:^19} {:^19} {:^19}",
            "",
            Aim::Vertex.to_string(),
            Aim::Edge.to_string(),
            Aim::Face.to_string()
        )?;
        writeln!(f, "{:34} {}", "", "     lost      even".repeat(3))?;
        for row in &self.rows {
            write!(f, "{:34}", row.name)?;
            for aimed in &row.aimed {
                let [lost, even] = [aimed.lost, aimed.even].map(|it| share(it, aimed.rays));
                write!(f, " {lost:>9} {even:>9}")?;
            }
            writeln!(f)?;
        }
        writeln!(f)?;
        self.fmt_decided(f)?;
        self.fmt_from_afar(f)?;
        self.fmt_scaled(f)
    }
}

impl Leaks {
    fn fmt_decided(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sum = |number: fn(&Aimed) -> u64| -> u64 { self.all().map(number).sum() };
        let [decided, must_hit] = [sum(|it| it.decided), sum(|it| it.must_hit)];
        let lost = sum(|it| it.lost);
        match (lost, lost == decided) {
            (0, _) => writeln!(f, "No ray is lost.")?,
            (_, true) => writeln!(
                f,
                "Lost: each of these {} rays was decided again, exactly: {} must hit.",
                group_digits(lost),
                group_digits(must_hit)
            )?,
            (_, false) => writeln!(
                f,
                "Lost: {} of these {} rays were decided again, exactly: {} must hit.",
                group_digits(decided),
                group_digits(lost),
                group_digits(must_hit)
            )?,
        }
        if must_hit < decided {
            writeln!(
                f,
                "      {} need not hit: hairline-rt is wrong here, please report it.",
                decided - must_hit
            )?;
        }
        let [decided, must_be_odd] = [sum(|it| it.even_decided), sum(|it| it.must_be_odd)];
        if decided > 0 {
            writeln!(
                f,
                "Even: the ray meets an even number of triangles by the device. {} of them were decided again, exactly; \
                 {} of these\n      cross single layers of the surface and touch nothing: a triangle counts twice, or not at all.",
                group_digits(decided),
                group_digits(must_be_odd)
            )?;
        }
        Ok(())
    }

    fn fmt_from_afar(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.from_afar.is_empty() {
            return Ok(());
        }
        writeln!(f)?;
        writeln!(
            f,
            "Rays from outside to a point inside, past a vertex, which start so many diagonals of the mesh's box away"
        )?;
        for FromAfar { sizes, counted } in &self.from_afar {
            let sizes = group_digits(*sizes as u64);
            let told = match counted {
                Some(counted) => format!("lost {}", share(counted.lost, counted.rays)),
                None => "numbers of f32 do not hold such rays".to_owned(),
            };
            writeln!(f, "  {sizes:>7}: {told}")?;
        }
        Ok(())
    }

    /// The sizes, from one share to the next.
    fn fmt_scaled(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(first) = self.scaled.first() else {
            return Ok(());
        };
        writeln!(f)?;
        writeln!(f, "Rays at vertices, the mesh scaled by")?;
        let usual = self.scaled.iter().find(|it| it.exponent == 0);
        let usual = usual.map_or(0, |it| it.counted.lost);
        let [mut from, mut to] = [first; 2];
        for next in self.scaled.iter().skip(1) {
            if next.share(usual) != from.share(usual) {
                self.fmt_sizes(f, from, to)?;
                from = next;
            }
            to = next;
        }
        self.fmt_sizes(f, from, to)
    }

    fn fmt_sizes(&self, f: &mut fmt::Formatter<'_>, from: &Scaled, to: &Scaled) -> fmt::Result {
        let within = from.exponent..=to.exponent;
        let sizes = self
            .scaled
            .iter()
            .filter(|it| within.contains(&it.exponent));
        let lost: Vec<u64> = sizes.map(|it| it.counted.lost).collect();
        let least = lost.iter().min().copied().unwrap_or_default();
        let most = lost.iter().max().copied().unwrap_or_default();
        let told = match [least, most].map(|lost| share(lost, self.rays)) {
            _ if most == 0 => "none is lost".to_owned(),
            _ if least == self.rays => "all are lost".to_owned(),
            [least, most] if least == most => format!("{most} are lost"),
            [least, most] => format!("{least} to {most} are lost"),
        };
        match from.exponent == to.exponent {
            true => writeln!(f, "  1e{}: {told}", from.exponent),
            false => writeln!(f, "  1e{} to 1e{}: {told}", from.exponent, to.exponent),
        }
    }
}

/// A count as a share, to three digits behind the point; a few rays as their number.
fn share(count: u64, of: u64) -> String {
    let percent = 100.0 * count as f64 / of as f64;
    match (count, percent < 0.0095) {
        (0, _) => "0".to_owned(),
        (1, true) => "1 ray".to_owned(),
        (_, true) => format!("{} rays", group_digits(count)),
        (_, false) => format!("{percent:.3} %"),
    }
}
