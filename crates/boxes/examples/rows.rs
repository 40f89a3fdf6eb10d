//! Prints an audit of all slab tests on all families: `cargo run --release -p hairline-boxes --example rows -- 20000`.

use hairline_boxes::{FAMILIES, FamilyScalar, KERNELS, Row, Setup, Source, audit};
use hairline_core::engine::Unobserved;
use hairline_core::kernel::Scalar;

fn print<F: FamilyScalar + Scalar>(count: u64) {
    let setups: Vec<Setup> = KERNELS.iter().flat_map(Setup::published).collect();
    let sources: Vec<Source> = FAMILIES.iter().map(Source::Family).collect();
    for Row {
        setup,
        source,
        scalar,
        tally,
    } in audit::<F>(&setups, &sources, count, 1, &Unobserved)
    {
        let [misses, hits] = [&tally.false_misses, &tally.false_hits];
        if misses.count + hits.count + tally.failed.count > 0 {
            let worst = hits.worst.map_or(0.0, |worst| worst.severity);
            println!(
                "{scalar} {:<16} {:<7} {source:<14} must hit {:>6} lost {:>6}  must miss {:>6} false hits {:>6} worst {worst:.1e}",
                setup.entry.info.name,
                setup.set,
                tally.must_hit,
                misses.count,
                tally.must_miss,
                hits.count
            );
        }
    }
}

fn main() {
    let count = std::env::args()
        .nth(1)
        .and_then(|text| text.parse().ok())
        .unwrap_or(2_000);
    print::<f32>(count);
    print::<f64>(count);
}
