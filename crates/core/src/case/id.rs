//! The name of a case: family, scalar, parameters, seed and index.

use super::between_colons;
use super::instance::{self, Instance, Matrix};
use super::scene::Scene;
use crate::arith::{Float, ScalarName};
use crate::error::{Error, ErrorKind};
use std::fmt;
use std::str::FromStr;

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
}
