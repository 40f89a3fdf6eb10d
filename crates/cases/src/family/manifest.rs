//! The manifest: generated sets, each by what makes it again and a digest that proves it is the same, and digests of the
//! meshes beside it.

use super::{FAMILIES, Family};
use crate::arith::ScalarName;
use crate::case::Parameters;
use crate::corpus::lines::LONGEST_LINE;
use crate::files::text_lines::TextLines;
use crate::files::{InputError, hex};
use crate::kernel::Scalar;
use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};
use std::io::BufRead;

/// A line of a manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ManifestLine {
    /// A generated set of cases.
    Set(SetLine),
    /// A mesh beside the manifest.
    Mesh(MeshLine),
}

/// A generated set of cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetLine {
    /// The family's name.
    pub family: String,
    /// The family's version.
    pub version: u32,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The parameters of the cases, as in case ids.
    pub parameters: String,
    /// The seed.
    pub seed: u64,
    /// How many indices from 0.
    pub count: u64,
    /// SHA-256 of the cases' bits, little-endian, in the order of their hexadecimal form.
    pub digest: String,
}

/// A mesh beside the manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshLine {
    /// The file's name.
    pub mesh: String,
    /// A description of what is hard about it.
    pub about: String,
    /// SHA-256 of the file's bytes.
    pub digest: String,
}

/// How many cases of each family a manifest covers.
const SET_SIZE: u64 = 10_000;

/// The generated sets of this version of the program.
pub fn sets() -> impl Iterator<Item = ManifestLine> {
    let sets = FAMILIES
        .iter()
        .flat_map(|family| [set_line::<f32>(family), set_line::<f64>(family)]);
    sets.map(ManifestLine::Set)
}

/// The first family of this program without a generated set among some lines; none if the lines have no set at all.
pub fn left_out<'a>(lines: impl Iterator<Item = &'a ManifestLine> + Clone) -> Option<&'static str> {
    let mut sets = lines.filter_map(|line| match line {
        ManifestLine::Set(set) => Some(set.family.as_str()),
        ManifestLine::Mesh(_) => None,
    });
    let has_line = |family: &&Family| sets.clone().any(|name| name == family.name);
    let missing = FAMILIES.iter().find(|family| !has_line(family))?;
    sets.next().map(|_| missing.name)
}

fn set_line<F: Scalar>(family: &Family) -> SetLine {
    let parameters = Parameters::default();
    SetLine {
        family: family.name.to_owned(),
        version: family.version,
        scalar: F::NAME,
        parameters: parameters.to_string(),
        seed: 1,
        count: SET_SIZE,
        digest: set_digest::<F>(family, &parameters, 1, SET_SIZE),
    }
}

fn set_digest<F: Scalar>(
    family: &Family,
    parameters: &Parameters,
    seed: u64,
    count: u64,
) -> String {
    let mut hash = Hash::new();
    for index in 0..count {
        for case in family.make::<F>(parameters, seed, index).cases() {
            case.bits()
                .iter()
                .for_each(|bits| hash.update(bits.to_le_bytes()));
        }
    }
    hex(&hash.finalize())
}

fn digest_of(bytes: &[u8]) -> String {
    hex(&Hash::hash(bytes))
}

/// The lines of a manifest. Blank lines are skipped.
pub fn read(reader: impl BufRead, file: &str) -> Result<Vec<(usize, ManifestLine)>, InputError> {
    let mut lines = Vec::new();
    for line in TextLines::new(reader, file, LONGEST_LINE) {
        let (number, line) = line?;
        let parsed = serde_json::from_str(&line).map_err(|_| {
            let sets = "family, version, scalar, parameters, seed, count, digest";
            let expected = format!("expected {{{sets}}} or {{mesh, about, digest}}");
            InputError::at(file, number, format!("not a manifest line: {expected}"))
        })?;
        lines.push((number, parsed));
    }
    Ok(lines)
}

/// Makes a line's set again, or digests the bytes of its mesh, and compares.
pub fn verify(line: &ManifestLine, mesh: &[u8]) -> Result<(), String> {
    let (stored, found) = match line {
        ManifestLine::Set(line) => (&line.digest, digest_again(line)?),
        ManifestLine::Mesh(line) => (&line.digest, digest_of(mesh)),
    };
    if *stored == found {
        Ok(())
    } else {
        Err(format!("the digest is {found}, the manifest says {stored}"))
    }
}

fn digest_again(line: &SetLine) -> Result<String, String> {
    let family =
        super::find(&line.family).ok_or_else(|| format!("unknown family '{}'", line.family))?;
    if family.version != line.version {
        return Err(format!(
            "family '{}' is at version {}, the manifest has {}",
            line.family, family.version, line.version
        ));
    }
    let parameters: Parameters = line.parameters.parse()?;
    let (seed, count) = (line.seed, line.count);
    Ok(in_named_scalar!(line.scalar, F => set_digest::<F>(family, &parameters, seed, count)))
}
