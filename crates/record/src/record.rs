//! The versioned record from which every format is made.
//!
//! `result` is what a study found: the same bytes whatever the number of threads. `provenance` says where and how it was
//! made and is never compared.

use crate::conformance::Conformance;
#[cfg(feature = "studies")]
use crate::drawing::MeshDrawing;
#[cfg(feature = "studies")]
use crate::files::hex;
use crate::illustration::Illustrations;
use crate::part::ShardPart;
use crate::plan::Provenance;
use crate::result::ResultPart;
use crate::study::{Findings, Study};
#[cfg(feature = "studies")]
use hmac_sha256::Hash;
use serde::Deserialize;
#[cfg(feature = "studies")]
use serde::{Serialize, Serializer};

/// The schema's name and version.
pub const SCHEMA: &str = "hairline-record/2";

/// Everything that one command found.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(
    feature = "schema",
    derive(schemars::JsonSchema),
    schemars(rename = "RecordOf{R}")
)]
#[serde(deny_unknown_fields)]
pub struct Record<R = ResultPart> {
    /// [`SCHEMA`].
    pub schema: String,
    /// The study: `audit`, `epsilon`, `offset`, `prove`, `verify`, `boxes` or `rays`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub study: Study,
    /// The findings.
    pub result: R,
    /// SHA-256 of `result` as JSON without spaces, hexadecimal; a record that was changed since is refused.
    pub checksum: Option<String>,
    /// The data that `merge` needs; only in a part of an audit.
    pub shard: Option<ShardPart>,
    /// How that compares with what was expected; only of `check`.
    pub conformance: Option<Conformance>,
    /// The data for pictures; only where an audit was asked for them.
    pub illustrations: Option<Illustrations>,
    /// The drawing of a mesh, for pages alone.
    #[cfg(feature = "studies")]
    #[serde(skip)]
    pub drawing: Option<MeshDrawing>,
    /// Where and how it was made.
    pub provenance: Provenance,
}

impl<R: Findings> Record<R> {
    /// Without a checksum yet.
    pub fn new(result: R, provenance: Provenance) -> Record<R> {
        Record {
            schema: SCHEMA.to_owned(),
            study: R::STUDY,
            result,
            checksum: None,
            shard: None,
            conformance: None,
            illustrations: None,
            #[cfg(feature = "studies")]
            drawing: None,
            provenance,
        }
    }

    /// The checksum of its findings as they are now.
    #[cfg(feature = "studies")]
    fn checksum_now(&self) -> String {
        let text = serde_json::to_string(&self.result).unwrap_or_default();
        hex(&Hash::hash(text.as_bytes()))
    }

    /// An error in one line if it is not as this program writes records: changed since, or put together by somebody else.
    #[cfg(feature = "studies")]
    pub fn check(&self) -> Result<(), String> {
        let Some(written) = &self.checksum else {
            return Err("it has no checksum, as every record has that hairline wrote".to_owned());
        };
        if *written != self.checksum_now() {
            return Err("its result is not the one that hairline wrote: the checksum differs, so numbers were changed since".to_owned());
        }
        self.result.check(&self.provenance)?;
        self.provenance.check()
    }
}

/// Whatever writes a record writes the checksum of its findings too. It takes a second of an audit, so one that only a
/// screen shows has none.
#[cfg(feature = "studies")]
impl<R: Findings> Serialize for Record<R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a, R> {
            schema: &'a str,
            study: Study,
            result: &'a R,
            checksum: String,
            #[serde(skip_serializing_if = "Option::is_none")]
            shard: &'a Option<ShardPart>,
            #[serde(skip_serializing_if = "Option::is_none")]
            conformance: &'a Option<Conformance>,
            #[serde(skip_serializing_if = "Option::is_none")]
            illustrations: &'a Option<Illustrations>,
            provenance: &'a Provenance,
        }
        Written {
            schema: &self.schema,
            study: self.study,
            result: &self.result,
            checksum: self.checksum_now(),
            shard: &self.shard,
            conformance: &self.conformance,
            illustrations: &self.illustrations,
            provenance: &self.provenance,
        }
        .serialize(serializer)
    }
}
