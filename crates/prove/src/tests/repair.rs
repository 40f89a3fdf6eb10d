//! Guarded kernels against the oracle, and what is refused.

use crate::kernel::KERNELS;
use crate::repair::Guarded;

#[test]
fn look() {
    for entry in KERNELS {
        let start = std::time::Instant::now();
        let made = Guarded::new::<f32>(entry);
        println!("{:?}", start.elapsed());
        match &made {
            Ok(made) => println!(
                "{} {} ops, {} margins {:?}",
                entry.info.name,
                made.operations.len(),
                made.margins.len(),
                made.margins.values().map(|m| m.roundings).max()
            ),
            Err(why) => println!("{}: {why}", entry.info.name),
        }
    }
}
