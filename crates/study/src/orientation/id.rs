//! A generated configuration in one string.

use super::Dimension;
use std::fmt;
use std::str::FromStr;

/// `dimension:family@version/scalar/seed/index`, as `orient3d:near@1/f64/1/17`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointsId {
    /// `orient2d` or `orient3d`.
    pub dimension: Dimension,
    /// The family's name.
    pub family: String,
    /// The family's version: it changes whenever its cases do.
    pub version: u32,
    /// `f32` or `f64`.
    pub scalar: String,
    /// The seed of the set.
    pub seed: u64,
    /// The place in the set.
    pub index: u64,
}

impl fmt::Display for PointsId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PointsId { dimension, family, version, scalar, seed, index } = self;
        write!(f, "{}:{family}@{version}/{scalar}/{seed}/{index}", dimension.name())
    }
}

impl FromStr for PointsId {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let shape = || {
            format!(
                "'{text}' is not a case id: orient2d or orient3d, then :family@version/scalar/seed/index"
            )
        };
        let [family, scalar, seed, index] =
            text.split('/').collect::<Vec<_>>().try_into().map_err(|_| shape())?;
        let (dimension, family) = family.split_once(':').ok_or_else(shape)?;
        let (family, version) = family.split_once('@').ok_or_else(shape)?;
        let dimension = Dimension::named(dimension);
        Ok(PointsId {
            dimension: dimension.ok_or_else(shape)?,
            family: family.to_owned(),
            version: version.parse().map_err(|_| shape())?,
            scalar: scalar.to_owned(),
            seed: seed.parse().map_err(|_| shape())?,
            index: index.parse().map_err(|_| shape())?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_survive_their_text() {
        for text in ["orient3d:near@1/f64/1/17", "orient2d:range-low@2/f32/0/18446744073709551615"]
        {
            assert_eq!(text.parse::<PointsId>().unwrap().to_string(), text);
        }
        for bad in [
            "",
            "near@1/f64/1/17",
            "orient4d:near@1/f64/1/17",
            "orient3d:near/f64/1/17",
            "orient3d:near@1/f64/1",
            "orient3d:near@1/f64/1/x",
            "orient3d:near@1/f64/1/2/3",
        ] {
            assert!(bad.parse::<PointsId>().is_err(), "{bad}");
        }
    }
}
