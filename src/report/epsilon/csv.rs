//! A study's curves, one line a point: what a spreadsheet or a plotting program reads.

use super::record::EpsilonRecord;
use crate::report::Style;
use std::io::{self, Write};

/// Writes the points of every curve.
pub fn write(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "kernel,scalar,gate,family,epsilon,false_misses,must_hit,false_hits,must_miss,cracks,doubles,crossings,self_hits,secondary_rays,own_false_hits,guarded"
    )?;
    for part in &record.result.gates {
        for curve in &part.curves {
            let family = quoted(&curve.family);
            let [must_hit, must_miss, crossings, _, secondary, guarded] = curve.asked;
            for (epsilon, [misses, hits, cracks, doubles, self_hits, own]) in &curve.points {
                writeln!(
                    out,
                    "{},{},{},{family},{epsilon},{misses},{must_hit},{hits},{must_miss},{cracks},{doubles},{crossings},{self_hits},{secondary},{own},{guarded}",
                    part.kernel, part.scalar, part.gate
                )?;
            }
        }
    }
    Ok(())
}

/// A field as RFC 4180 has it: quoted where it holds a comma, a quote or a line break.
pub fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
