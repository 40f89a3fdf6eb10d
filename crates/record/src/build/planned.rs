//! From the plan of a run to the part of a record that names it: its rows, its sources, and the hashes of both.

use crate::arith::ScalarName;
use crate::audit::{CorpusSet, Plan, Row, Source, Stock, words};
use crate::case::Matrix;
use crate::files::hex;
use crate::plan::*;
use hmac_sha256::Hash;

/// A row as a plan names it.
fn row_part(row: &Row) -> RowPart {
    RowPart {
        contract_words: row.spec().contract,
        kernel: row.entry.info.name.to_owned(),
        selector: row.entry.selector(),
        set: row.set.clone(),
        epsilons: row
            .tuned()
            .map(|(gate, text)| (gate.name.to_owned(), text.to_string()))
            .collect(),
        contract: row.contract.describe(),
    }
}

pub fn plan_part(plan: &Plan) -> PlanPart {
    let part = PlanPart {
        hash: String::new(),
        rows: plan.rows.iter().map(row_part).collect(),
        sources: plan.sources.iter().map(planned_source).collect(),
        scalars: ScalarName::among(plan.scalars).collect(),
    };
    #[cfg(feature = "studies")]
    let part = part.hashed();
    part
}

#[cfg(feature = "studies")]
impl PlanPart {
    /// With the hash of the other fields.
    pub fn hashed(mut self) -> PlanPart {
        self.hash.clear();
        let text = serde_json::to_string(&self).unwrap_or_default();
        self.hash = hex(&Hash::hash(text.as_bytes())[..8]);
        self
    }

    /// The hash of what chooses the cases, which are the same for any kernels, epsilons and contracts.
    pub fn hash_of_cases(&self) -> String {
        let text = serde_json::to_string(&self.sources).unwrap_or_default();
        hex(&Hash::hash(text.as_bytes())[..8])
    }
}

/// A source as the plan names it.
fn planned_source(source: &Source) -> PlannedSource {
    PlannedSource {
        family: source.name(),
        set: match &source.stock {
            Stock::Corpus(set) => {
                let instance = source.parameters.instance.as_ref();
                let place = instance.map(|it| format!("/instance={}", words(it).replace(' ', ":")));
                let digest = corpus_digest(set, instance);
                format!("{}@{digest}{}", set.file, place.unwrap_or_default())
            }
            _ => set_of_id(&source.id::<f64>(0, None)),
        },
        count: source.count::<f32>().max(source.count::<f64>()),
    }
}

/// The digest of the stored cases and their names: another file of the same name is another plan.
fn corpus_digest(set: &CorpusSet, instance: Option<&Matrix<f64>>) -> String {
    let mut digest = Hash::new();
    let mut add = |name: &str, bits: &[u64]| {
        digest.update(name.as_bytes());
        bits.iter()
            .for_each(|bits| digest.update(bits.to_le_bytes()));
    };
    set.f32
        .iter()
        .for_each(|(name, case)| add(name, &case.bits()));
    set.f64
        .iter()
        .for_each(|(name, case)| add(name, &case.bits()));
    if let Some(matrix) = instance {
        add(
            "instance",
            &[0, 1, 2].map(|row| matrix[row].map(f64::to_bits)).concat(),
        );
    }
    hex(&digest.finalize()[..8])
}

/// `family@version/parameters/seed` of an id: without the scalar and the index.
fn set_of_id(id: &str) -> String {
    let words: Vec<&str> = id.split('/').collect();
    match words[..] {
        [family, _, parameters, seed, _] => format!("{family}/{parameters}/{seed}"),
        _ => id.to_owned(),
    }
}
