//! A scene in a few numbers that a person knows: where its triangles are, how large they are, and how far
//! rays travel.

use crate::arith::{Float, smallest_normal};
use crate::suggest::nearest_name;
pub use kinds::{PlaneKind, RayKind, SceneKind, Toward};
pub use text::ShortNumber;
use text::{Sizes, extent_in, number, range, sizes};

/// The sizes of a scene's rays and triangles, in the scene's own unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Every coordinate of a triangle is within ± this of the center.
    pub extent: f64,
    /// All three coordinates of the scene's center.
    pub center: f64,
    /// The longest edge of a triangle: in the smallest triangle, and in the largest; each doubling between them is
    /// equally likely.
    pub edge: [f64; 2],
    /// Half of the triangles' longest edges are below this; none if each doubling is equally likely.
    pub median_edge: Option<f64>,
    /// How far a ray starts from the point that it is aimed at: at least, and at most.
    pub distance: [f64; 2],
    /// The length of the directions.
    pub direction: DirectionLength,
    /// The sines of the angles between almost parallel rays and planes, each halving equally likely; none for those
    /// from 1/8 down to below rounding.
    pub sine: Option<[f64; 2]>,
    /// If true, all almost parallel rays are aimed inside their triangle; otherwise half of them are aimed beside it.
    pub aims_inside: bool,
    /// Where the direction of a ray comes from.
    pub ray: RayKind,
    /// How the planes of triangles lie.
    pub plane: PlaneKind,
    /// Where rays go.
    pub toward: Toward,
    /// The intervals of rays.
    pub interval: SceneInterval,
}

named! {
    pub names
    /// How long the directions of a scene's rays are.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum DirectionLength {
        /// Rounded unit vectors: t is a length.
        Unit = "unit",
        /// From the origin to the target: t = 1 there.
        Target = "target",
        /// Half unit vectors, a quarter as far as the target, a quarter from 1/64 to 64 long: for kernels that have to be
        /// right whatever the length is.
        Mixed = "mixed",
    }
}

named! {
    pub names
    /// Which intervals of t a scene's rays have.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SceneInterval {
        /// From 0 to infinity.
        Whole = "whole",
        /// Half from 0 to infinity; of the others most hold the crossing, and some are over before it or begin after it.
        Drawn = "drawn",
    }
}

/// A scene with a name.
pub struct ScenePreset {
    /// The name on the command line.
    pub name: &'static str,
    /// Its unit of length; empty if it has none.
    pub unit: &'static str,
    /// The scene.
    pub scene: Scene,
}

const fn preset(
    name: &'static str,
    unit: &'static str,
    extent: f64,
    edge: [f64; 2],
    distance: [f64; 2],
) -> ScenePreset {
    let direction = DirectionLength::Unit;
    let scene = Scene {
        extent,
        center: 0.0,
        edge,
        median_edge: None,
        distance,
        direction,
        sine: None,
        aims_inside: false,
        ray: RayKind::Stored,
        plane: PlaneKind::Generic,
        toward: Toward::Any,
        interval: SceneInterval::Whole,
    };
    ScenePreset { name, unit, scene }
}

/// The scenes with names; the first is the default.
pub const SCENES: &[ScenePreset] = &[
    preset("unit", "", 1.0, [0.1, 1.0], [0.0, 4.0]),
    preset("room", "m", 5.0, [0.01, 3.0], [0.0, 10.0]),
    preset("city", "m", 1000.0, [0.01, 10.0], [0.0, 2000.0]),
    preset("cad-mm", "mm", 500.0, [0.05, 200.0], [0.0, 1000.0]),
];

impl Default for Scene {
    fn default() -> Scene {
        SCENES[0].scene.clone()
    }
}

/// The least sine of an angle: far below what a rounded direction can have.
const LEAST_SINE: f64 = 1e-30;

/// In place of a preset: the scene of a mesh.
const OF_MESH: &str = "mesh";

/// The words of a scene, as errors list them.
const WORDS: &str = "extent=1000, center=0, edge=0.01..10 or 0.01..0.1..10, distance=0..2000, direction=unit, target or mixed, \
     sine=1e-7..0.1, aim=inside or both, ray=stored or generated, \
     plane=generic, axis, axis-near-0, axis-0, terrain or box, toward=any, axis-plane or axis, interval=whole or drawn";

impl Scene {
    /// The same with lengths that are so many times as large.
    fn grown(self, times: f64) -> Scene {
        let [edge, distance] = [self.edge, self.distance].map(|range| range.map(|x| x * times));
        let median_edge = self.median_edge.map(|x| x * times);
        Scene {
            extent: self.extent * times,
            edge,
            median_edge,
            distance,
            ..self
        }
    }

    /// The lengths that the words of a scene leave out, as words; none where a preset's name has them.
    pub fn left_out(&self, text: &str) -> Option<String> {
        let keys: Vec<&str> = text
            .split(',')
            .map(|word| word.split('=').next().unwrap_or("").trim())
            .collect();
        if SCENES.iter().any(|preset| preset.name == keys[0]) {
            return None;
        }
        let lengths = [("edge", self.edge), ("distance", self.distance)];
        let left = lengths.into_iter().filter(|(key, _)| !keys.contains(key));
        let left: Vec<String> = left
            .map(|(key, range)| format!("{key}={}", Sizes(range, None)))
            .collect();
        (!left.is_empty()).then(|| left.join(" and "))
    }

    /// From words between commas: perhaps a preset's name, then what differs from it; without a name from the preset
    /// `unit`, whose lengths grow with the extent. Also the unit of length of the preset.
    pub fn parse(text: &str) -> Result<(Scene, &'static str), String> {
        let mut words = text.split(',').map(str::trim).peekable();
        let first = words.peek().copied().unwrap_or_default();
        if first == OF_MESH {
            return Err(format!("'{OF_MESH}' needs --mesh FILE"));
        }
        let preset = SCENES.iter().find(|preset| preset.name == first);
        let (mut scene, unit) = match preset {
            Some(preset) => (preset.scene.clone(), preset.unit),
            None => (Scene::default().grown(extent_in(words.clone())), ""),
        };
        scene.set_all(words.skip(usize::from(preset.is_some())), |word, is_key| {
            if is_key {
                return format!("unknown word '{word}'; there are {WORDS}");
            }
            let names: Vec<&str> = SCENES.iter().map(|preset| preset.name).collect();
            if names.contains(&word) {
                return format!("'{word}' is a preset: it comes first, and there is one at most");
            }
            if let Some(near) = nearest_name(&word.to_lowercase(), names.iter().copied()) {
                return format!("'{word}' is no scene; did you mean '{near}'?");
            }
            let names = names.join(", ");
            if word.is_empty() {
                return format!("nothing stands before or after a comma: write {WORDS}");
            }
            format!("'{word}' is no scene: begin with one of {names}, or write {WORDS}")
        })?;
        scene.check()?;
        scene.check_fit()?;
        Ok((scene, unit))
    }

    /// The scene of a mesh with what words say of its rays: perhaps `mesh`, then words between commas.
    pub fn of_mesh(mut self, text: &str) -> Result<Scene, String> {
        let words = text.split(',').map(str::trim);
        let words = words
            .enumerate()
            .filter(|(i, word)| !(*i == 0 && *word == OF_MESH));
        let own = (
            self.extent,
            self.center,
            self.edge,
            self.median_edge,
            self.plane,
        );
        let expected = "write mesh, or mesh,distance=0..20,direction=target";
        let wrong = |word: &str| format!("'{word}' is no word for the scene of a mesh: {expected}");
        self.set_all(words.map(|(_, word)| word), |word, _| wrong(word))?;
        if own
            != (
                self.extent,
                self.center,
                self.edge,
                self.median_edge,
                self.plane,
            )
        {
            return Err(format!(
                "a mesh has its own extent, edges and planes: {expected}"
            ));
        }
        self.check()?;
        Ok(self)
    }

    /// Sets what words say; the error for a word that is unknown, or no `key=value`, is the caller's.
    fn set_all<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        unknown: impl Fn(&str, bool) -> String,
    ) -> Result<(), String> {
        let mut known = Vec::new();
        for word in words {
            let (key, value) = word.split_once('=').ok_or_else(|| unknown(word, false))?;
            let (key, value) = (key.trim(), value.trim());
            if known.contains(&key) {
                return Err(format!("'{key}' is given twice"));
            }
            if !self.set(key, value)? {
                return Err(unknown(key, true));
            }
            known.push(key);
        }
        Ok(())
    }

    /// Sets what a word names; false if it names nothing of a scene.
    pub(super) fn set(&mut self, key: &str, value: &str) -> Result<bool, String> {
        let word = format!("{key}={value}");
        match key {
            "extent" => self.extent = number(key, value)?,
            "center" => self.center = number(key, value)?,
            "edge" => (self.edge, self.median_edge) = sizes(key, value)?,
            "distance" => self.distance = range(key, value)?,
            "aim" => {
                self.aims_inside = match value {
                    "inside" => true,
                    "both" => false,
                    _ => return Err(format!("{word}: write aim=inside or both")),
                }
            }
            "sine" => self.sine = Some(range(key, value)?),
            "ray" => self.ray = RayKind::chosen(&word, value)?,
            "plane" => self.plane = PlaneKind::chosen(&word, value)?,
            "toward" => self.toward = Toward::chosen(&word, value)?,
            "interval" => {
                let unknown = || format!("{word}: write interval=whole or drawn");
                self.interval = SceneInterval::named(value).ok_or_else(unknown)?;
            }
            "direction" => {
                let unknown = || format!("{word}: write direction=unit, target or mixed");
                self.direction = DirectionLength::named(value).ok_or_else(unknown)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// An error if the numbers make no scene.
    pub(super) fn check(&self) -> Result<(), String> {
        let Scene {
            extent,
            edge: [shortest, _],
            distance: [nearest, farthest],
            ..
        } = *self;
        if extent <= 0.0 {
            return Err(format!("extent={extent}: must be above 0"));
        }
        if shortest <= 0.0 {
            return Err(format!(
                "edge={}: must be above 0",
                Sizes(self.edge, self.median_edge)
            ));
        }
        if nearest < 0.0 || farthest <= 0.0 {
            return Err(format!(
                "distance={}: must be from 0 up, and not 0 alone",
                Sizes(self.distance, None)
            ));
        }
        if self.plane.is_near_zero() && self.center != 0.0 {
            let (plane, center) = (self.plane.name(), ShortNumber(self.center));
            return Err(format!(
                "plane={plane}: such planes are at coordinate 0, not around center={center}"
            ));
        }
        match self.sine {
            Some([low, high]) if low < LEAST_SINE || 1.0 < high => Err(format!(
                "sine={}: sines of angles are from {LEAST_SINE:e} to 1",
                Sizes([low, high], None)
            )),
            _ => Ok(()),
        }
    }

    /// Its kind of planes and rays.
    pub fn kind(&self) -> SceneKind {
        SceneKind {
            plane: self.plane,
            toward: self.toward,
        }
    }

    /// The same scene in each kind that it can have; the generic one first.
    pub fn of_all_kinds(&self) -> Vec<Scene> {
        let can_have = |kind: &SceneKind| !kind.plane.is_near_zero() || self.center == 0.0;
        let of = |SceneKind { plane, toward }| Scene {
            plane,
            toward,
            ..self.clone()
        };
        SceneKind::ALL
            .into_iter()
            .filter(can_have)
            .map(of)
            .collect()
    }

    /// True if the words of a scene name a kind of planes or rays.
    pub fn names_kind(text: &str) -> bool {
        names(text, "plane") || names(text, "toward")
    }

    /// The scene as kernels are tried in it: with directions of all lengths and intervals of every kind, unless its words
    /// say which. A kernel that is right for unit vectors on `[0, inf)` alone shows nowhere else.
    pub fn to_try_kernels(mut self, text: &str) -> Scene {
        if !names(text, "direction") {
            self.direction = DirectionLength::Mixed;
        }
        if !names(text, "interval") {
            self.interval = SceneInterval::Drawn;
        }
        self
    }

    /// The largest coordinate of a triangle.
    pub fn largest(&self) -> f64 {
        self.center.abs() + self.extent
    }

    /// An error if the largest triangles are not within the extent.
    pub(super) fn check_fit(&self) -> Result<(), String> {
        if self.extent < self.edge[1] {
            return Err(format!(
                "edge={}: the longest edge is at most the extent, {}",
                Sizes(self.edge, self.median_edge),
                ShortNumber(self.extent)
            ));
        }
        Ok(())
    }

    /// An error if products of the scene's lengths overflow in a scalar.
    pub fn check_range_in<F: Float>(&self) -> Result<(), String> {
        let reach = self.largest() + self.distance[1];
        if !F::from_f64(reach * reach * reach).is_finite() {
            return Err(format!(
                "products of three lengths such as {} overflow in {}: use a larger unit of length",
                ShortNumber(reach),
                F::NAME
            ));
        }
        Ok(())
    }

    /// An error if a scalar cannot hold the scene: its triangles collapse, or products underflow or
    /// overflow.
    pub fn check_in<F: Float>(&self) -> Result<(), String> {
        self.check_range_in::<F>()?;
        let (shortest, name) = (self.edge[0], F::NAME);
        if shortest * shortest * F::EPSILON.to_f64() < smallest_normal::<F>() {
            return Err(format!(
                "the areas of triangles of edge {} underflow in {name}: use a smaller unit of length",
                ShortNumber(shortest)
            ));
        }
        let spacing = F::from_f64(self.largest()).ulp().to_f64();
        if shortest < 32.0 * spacing {
            return Err(format!(
                "triangles of edge {} nearly collapse at coordinates of {}, where the numbers of {name} are {spacing:.1e} apart{}",
                ShortNumber(shortest),
                ShortNumber(self.largest()),
                if F::NAME == f32::NAME {
                    ": use f64, or move the origin to the camera"
                } else {
                    ""
                }
            ));
        }
        Ok(())
    }

    /// Those of some scalars (`f32`, `f64`) that can hold the scene, and why another cannot. The error says why none can.
    pub fn held_in(&self, scalars: [bool; 2]) -> Result<([bool; 2], Option<String>), String> {
        let all = [self.check_in::<f32>().err(), self.check_in::<f64>().err()];
        let held = [0, 1].map(|i| scalars[i] && all[i].is_none());
        let mut reasons = all
            .into_iter()
            .zip(scalars)
            .filter_map(|(why, is_chosen)| why.filter(|_| is_chosen));
        match reasons.next() {
            Some(why) if held == [false; 2] => Err(why),
            why => Ok((held, why)),
        }
    }
}

/// True if the words of a scene give a key.
fn names(text: &str, key: &str) -> bool {
    text.split(',')
        .filter_map(|word| word.split('=').next())
        .any(|word| word.trim() == key)
}

mod kinds;
#[cfg(test)]
mod tests;
mod text;
