//! Floor 1: the ray, the triangle, the case, its id, and the counter-based random numbers.

#![forbid(unsafe_code)]

mod forms;
#[cfg(test)]
mod hard;
mod instance;
mod scene;
mod target;

pub use forms::{AnyCase, AnyScalar, rust_case, rust_list};
#[cfg(test)]
pub use hard::hard_cases;
pub use instance::{Instance, Matrix};
pub use scene::ShortNumber;
pub use scene::{
    DirectionLength, PlaneKind, RayKind, SCENES, Scene, SceneInterval, SceneKind, ScenePreset,
    Toward,
};
pub use target::{Target, Triangles};

use crate::arith::{
    Exact, ExactVector, Float, Real, ScalarName, Triple, Vector, scale_by_power_of_two,
};
use crate::error::{Error, ErrorKind};
use std::fmt;
use std::str::FromStr;

/// A ray `origin + t * direction`, with the interval `[t_min, t_max]` of t in which hits count. The
/// direction is a free vector of any length, used exactly as given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<V: Vector> {
    /// Where t = 0. Unit: length.
    pub origin: V,
    /// Any length but zero.
    pub direction: V,
    /// The start of the interval, in units of the direction.
    pub t_min: V::Real,
    /// The end of the interval.
    pub t_max: V::Real,
}

/// A triangle; seen from its front, a, b, c run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle<V> {
    /// First vertex.
    pub a: V,
    /// Second vertex.
    pub b: V,
    /// Third vertex.
    pub c: V,
}

impl<V> Triangle<V> {
    /// From its vertices.
    pub fn new(a: V, b: V, c: V) -> Self {
        Triangle { a, b, c }
    }

    /// The vertices, in order.
    pub fn vertices(self) -> [V; 3] {
        [self.a, self.b, self.c]
    }

    /// The edges ab, bc, ca.
    pub fn edges(&self) -> [(&V, &V); 3] {
        [(&self.a, &self.b), (&self.b, &self.c), (&self.c, &self.a)]
    }
}

/// One question to a kernel: does this ray meet this triangle?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case<F: Float> {
    /// The ray and its interval.
    pub ray: Ray<F::Vector>,
    /// The triangle.
    pub triangle: Triangle<F::Vector>,
}

impl<F: Float> Case<F> {
    /// From arrays, with the default interval `[0, +inf]`.
    pub fn new(origin: [F; 3], direction: [F; 3], [a, b, c]: [[F; 3]; 3]) -> Self {
        let ray = Ray {
            origin: origin.into(),
            direction: direction.into(),
            t_min: F::zero(),
            t_max: F::infinity(),
        };
        Case {
            ray,
            triangle: Triangle::new(a.into(), b.into(), c.into()),
        }
    }

    /// The same case on another interval.
    pub fn on(mut self, t_min: F, t_max: F) -> Self {
        (self.ray.t_min, self.ray.t_max) = (t_min, t_max);
        self
    }

    /// Origin, direction, a, b, c.
    #[inline(always)]
    pub fn vectors(&self) -> [[F; 3]; 5] {
        let Triangle { a, b, c } = self.triangle;
        [
            self.ray.origin.into(),
            self.ray.direction.into(),
            a.into(),
            b.into(),
            c.into(),
        ]
    }

    /// The case in `f64`, which holds every `f32` exactly.
    #[inline]
    pub fn widen(&self) -> Case<f64> {
        // A plain loop: arrays of arrays do not go through `map` without calls.
        let mut wide = [[0.0; 3]; 5];
        for (wide, narrow) in wide
            .as_flattened_mut()
            .iter_mut()
            .zip(self.vectors().as_flattened())
        {
            *wide = narrow.to_f64();
        }
        let [origin, direction, a, b, c] = wide;
        Case::new(origin, direction, [a, b, c]).on(self.ray.t_min.to_f64(), self.ray.t_max.to_f64())
    }

    /// The case in another arithmetic, number by number.
    pub fn lift<R: Real>(&self, number: impl Fn(F) -> R) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
        let numbers = self.numbers();
        lifted(|i| number(numbers[i]))
    }

    /// The case in exact numbers.
    pub fn exact(&self) -> (Ray<ExactVector>, Triangle<ExactVector>) {
        self.widen().lift(Exact::from_f64)
    }
}

/// A ray and a triangle whose numbers are made from their places among the seventeen of a case.
pub fn lifted<R: Real>(number: impl Fn(usize) -> R) -> (Ray<Triple<R>>, Triangle<Triple<R>>) {
    let triple = |i: usize| Triple::from([number(i), number(i + 1), number(i + 2)]);
    let ray = Ray {
        origin: triple(0),
        direction: triple(3),
        t_min: number(15),
        t_max: number(16),
    };
    (
        ray,
        Triangle {
            a: triple(6),
            b: triple(9),
            c: triple(12),
        },
    )
}

/// How a family's cases are transformed after they are generated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Positions are multiplied by 2 to this power.
    pub scale: i32,
    /// The direction is multiplied too.
    pub scale_direction: bool,
    /// Added to every position, after scaling.
    pub offset: [f64; 3],
    /// The direction is replaced by its rounded unit vector, and that direction is the case.
    pub unit_direction: bool,
    /// The digest of the mesh that the cases come from.
    pub mesh: Option<String>,
    /// The scene that the cases come from.
    pub scene: Option<Scene>,
    /// The kernel at whose hit points a scene's shadow rays start.
    pub kernel: Option<String>,
    /// Where the triangle is put: rays are brought to the world by this, and kernels get them by its inverse.
    pub instance: Option<Matrix<f64>>,
}

impl Parameters {
    /// True if the parameters leave each case's truth alone (up to overflow and underflow).
    pub fn keep_truth(&self) -> bool {
        self.offset == [0.0; 3] && !self.unit_direction
    }

    /// The instance in a scalar, if there is one.
    pub fn instance_in<F: Float>(&self) -> Option<Instance<F>> {
        Instance::new(self.instance?.map(|row| row.map(F::from_f64)))
    }
}

impl fmt::Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut words = Vec::new();
        if self.scale != 0 {
            words.push(format!("scale=2^{}", self.scale));
        }
        if self.scale_direction {
            words.push("scale-direction".to_owned());
        }
        if self.offset != [0.0; 3] {
            let [x, y, z] = self.offset;
            words.push(format!("offset={x:e}:{y:e}:{z:e}"));
        }
        if self.unit_direction {
            words.push("unit".to_owned());
        }
        words.extend(self.mesh.iter().map(|digest| format!("mesh={digest}")));
        words.extend(self.scene.iter().map(Scene::to_string));
        words.extend(self.kernel.iter().map(|kernel| format!("kernel={kernel}")));
        words.extend(
            self.instance
                .iter()
                .map(|matrix| format!("instance={}", instance::text(matrix))),
        );
        f.write_str(
            if words.is_empty() {
                "-".to_owned()
            } else {
                words.join(",")
            }
            .as_str(),
        )
    }
}

impl FromStr for Parameters {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let mut parameters = Parameters::default();
        for word in text.split(',').filter(|word| *word != "-") {
            let (key, value) = word.split_once('=').unwrap_or((word, ""));
            let mut scene = parameters.scene.clone().unwrap_or_default();
            if scene.set(key, value).map_err(Error::syntax)? {
                parameters.scene = Some(scene);
                continue;
            }
            match key {
                "scale" => parameters.scale = parse_power_of_two(value).map_err(Error::syntax)?,
                "scale-direction" => parameters.scale_direction = true,
                "offset" => parameters.offset = parse_offset(value).map_err(Error::syntax)?,
                "unit" => parameters.unit_direction = true,
                "mesh" => parameters.mesh = Some(value.to_owned()),
                "kernel" => parameters.kernel = Some(value.to_owned()),
                "instance" => {
                    parameters.instance = Some(instance::parsed(value).map_err(Error::syntax)?)
                }
                _ => {
                    let known = "scale=2^k, scale-direction, offset=x:y:z, unit, mesh=digest, \
                                 the words of a scene, kernel=name, instance=12 numbers";
                    let line = format!("unknown parameter '{key}'; there are {known}");
                    return Err(Error::new(ErrorKind::UnknownName, line));
                }
            }
        }
        let out_of_range = |line| Error::new(ErrorKind::OutOfRange, line);
        if let Some(scene) = &parameters.scene {
            scene.check().map_err(out_of_range)?;
            if parameters.mesh.is_none() {
                scene.check_fit().map_err(out_of_range)?;
            }
            let scales = parameters.scale != 0 || parameters.scale_direction;
            if scales || !parameters.keep_truth() {
                let message = "a scene has sizes of its own: no scale, offset or unit";
                return Err(Error::new(ErrorKind::Conflict, message));
            }
        }
        Ok(parameters)
    }
}

/// The exponent k of `2^k`; `1` is `2^0`.
pub fn parse_power_of_two(text: &str) -> Result<i32, String> {
    let exponent = if text == "1" {
        Some(0)
    } else {
        text.strip_prefix("2^").and_then(|k| k.parse().ok())
    };
    exponent
        .filter(|k: &i32| (-1100..=1100).contains(k))
        .ok_or_else(|| format!("'{text}' is not a scale: write 2^k with |k| <= 1100, as 2^-10"))
}

/// Three finite numbers between colons.
pub fn parse_offset(text: &str) -> Result<[f64; 3], String> {
    between_colons(text)
        .ok_or_else(|| format!("'{text}' is not an offset: write x:y:z, as 1e6:0:0"))
}

/// This many finite numbers between colons.
fn between_colons<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |n: &str| n.parse().ok().filter(|x: &f64| x.is_finite());
    text.split(':')
        .map(number)
        .collect::<Option<Vec<f64>>>()?
        .try_into()
        .ok()
}

/// A generated case in one string: `family@version/scalar/parameters/seed/index`, and `.k` for
/// triangle k of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseId {
    /// The family's name.
    pub family: String,
    /// The family's version: it changes whenever its cases do.
    pub version: u32,
    /// The scalar of its numbers.
    pub scalar: ScalarName,
    /// How the case was transformed.
    pub parameters: Parameters,
    /// The seed of the set.
    pub seed: u64,
    /// The place in the set.
    pub index: u64,
    /// Which triangle of a group; the whole group if none.
    pub triangle: Option<usize>,
}

impl fmt::Display for CaseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let CaseId {
            family,
            version,
            scalar,
            parameters,
            seed,
            index,
            triangle,
        } = self;
        write!(f, "{family}@{version}/{scalar}/{parameters}/{seed}/{index}")?;
        triangle.map_or(Ok(()), |k| write!(f, ".{k}"))
    }
}

impl FromStr for CaseId {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let shape = || {
            Error::syntax(format!(
                "'{text}' is not a case id: family@version/scalar/parameters/seed/index, as tiny@2/f32/-/1/135"
            ))
        };
        let [family, scalar, parameters, seed, index] = text
            .split('/')
            .collect::<Vec<_>>()
            .try_into()
            .map_err(|_| shape())?;
        let (family, version) = family.split_once('@').ok_or_else(shape)?;
        let other_scalar = || {
            Error::syntax(format!(
                "'{text}': its scalar is '{scalar}', expected f32 or f64"
            ))
        };
        let (index, triangle) = match index.split_once('.') {
            Some((index, k)) => (index, Some(k.parse().map_err(|_| shape())?)),
            None => (index, None),
        };
        Ok(CaseId {
            family: family.to_owned(),
            version: version.parse().map_err(|_| shape())?,
            scalar: ScalarName::named(scalar).ok_or_else(other_scalar)?,
            parameters: parameters.parse()?,
            seed: seed.parse().map_err(|_| shape())?,
            index: index.parse().map_err(|_| shape())?,
            triangle,
        })
    }
}

/// Random numbers of one case: a stream that depends on (family, seed, index) only, so that case i
/// never depends on case i-1. SplitMix64 (Steele, Lea and Flood 2014) from a mixed start.
///
/// Integers and IEEE + - × ÷ √ only: functions in which libraries differ never enter a case.
#[derive(Clone, Debug)]
pub struct Draw {
    state: u64,
}

impl Draw {
    /// The stream of case `index` of a family's set.
    pub fn new(family: &str, seed: u64, index: u64) -> Draw {
        // FNV-1a of the name keeps the families' streams apart.
        let name = family
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
            });
        Draw {
            state: mix(name ^ mix(seed.wrapping_add(mix(index)))),
        }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.state)
    }

    /// A uniform integer in `low..=high` (within 2^-32 for the ranges that families use).
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        let span = u128::from(high.abs_diff(low)) + 1;
        low + ((u128::from(self.bits()) * span) >> 64) as i64
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.integer(0, count as i64 - 1) as usize
    }

    /// One of the elements.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// True once in two.
    pub fn coin(&mut self) -> bool {
        self.bits() >> 63 == 1
    }

    /// A number in [0, 1) on the grid of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// A number in [-1, 1] with a full significand at every magnitude.
    pub fn symmetric<F: Float>(&mut self) -> F {
        let exponent = -1 - self.bits().trailing_zeros().min(40) as i32;
        self.with_exponent(exponent)
    }

    /// A number of either sign with a random significand and a given binary exponent, which lies in
    /// the scalar's range (subnormals included).
    pub fn with_exponent<F: Float>(&mut self, exponent: i32) -> F {
        let significand = 1.0 + (self.bits() >> 12) as f64 * (1.0 / (1u64 << 52) as f64);
        let value = F::from_f64(scale_by_power_of_two(significand, exponent));
        if self.coin() { -value } else { value }
    }

    /// Three of [`Draw::symmetric`].
    pub fn point<F: Float>(&mut self) -> [F; 3] {
        std::array::from_fn(|_| self.symmetric())
    }

    /// Three integers in `-bound..=bound`.
    pub fn lattice_point(&mut self, bound: i64) -> [i64; 3] {
        std::array::from_fn(|_| self.integer(-bound, bound))
    }
}

pub fn mix(value: u64) -> u64 {
    let z = (value ^ value >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_survive_their_text() {
        for text in [
            "edge-near@1/f32/-/42/17",
            "fan@3/f64/scale=2^-10,scale-direction,offset=1e6:0e0:-2.5e0,unit/0/5.2",
            "mesh@1/f32/mesh=0123456789abcdef/7/1000000",
            "scene-shadow@1/f32/extent=5,edge=0.01..3,distance=0..10,direction=unit,kernel=cramer/1/2",
            "fan@3/f64/instance=1e0:0e0:-2.5e-1:1e6:0e0:2e0:0e0:0e0:0e0:-0e0:3e0:1e-1/0/5",
        ] {
            assert_eq!(text.parse::<CaseId>().unwrap().to_string(), text);
        }
        for bad in [
            "",
            "edge-near/f32/-/1/2",
            "a@1/f32/scale=3/1/2",
            "a@1/f32/instance=1:2/1/2",
            "a@1/f32/-/1/2.x",
            "a@1/f32/-/1/2/3",
        ] {
            assert!(bad.parse::<CaseId>().is_err(), "{bad}");
        }
    }

    #[test]
    fn draws_depend_on_family_seed_and_index_only() {
        let first = Draw::new("edge-near", 1, 2).bits();
        assert_eq!(first, Draw::new("edge-near", 1, 2).bits());
        for other in [
            ("edge-exact", 1, 2),
            ("edge-near", 2, 2),
            ("edge-near", 1, 3),
        ] {
            assert_ne!(first, Draw::new(other.0, other.1, other.2).bits());
        }
    }
}
