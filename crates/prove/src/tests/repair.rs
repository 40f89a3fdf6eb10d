//! Guarded kernels: which are made, and their counts of roundings beside those of permanents.

use crate::kernel::{KERNELS, find};
use crate::repair::{Guarded, Step};
use crate::{Domain, Format, compared, paths_of, relative};

#[test]
fn all_kernels_are_repaired_but_the_one_without_a_test_of_t() {
    for entry in KERNELS {
        let name = entry.info.name;
        let made = [Guarded::new::<f32>(entry), Guarded::new::<f64>(entry)];
        for made in made {
            match made {
                Ok(guarded) => assert!(name != "half-space" && !guarded.margins.is_empty()),
                Err(why) => {
                    assert_eq!(name, "half-space", "{why}");
                    assert_eq!(
                        why,
                        "its gates accept rays that meet the triangle at t <= 0"
                    );
                }
            }
        }
    }
}

/// The numbers of this kernel have no divisions, so both rules count the same roundings; one in the kernel's order of
/// sums, the other in any.
#[test]
fn a_margin_counts_no_fewer_roundings_than_the_permanent() {
    let entry = find("scalar-triple").unwrap();
    let guarded = Guarded::new::<f64>(entry).unwrap();
    let path = &paths_of::<f64>(entry).unwrap()[0];
    let (_, place) = compared(path)[0];
    let permanent = relative(path, place, Domain::UNIT, Format::F64).unwrap();
    let margins: Vec<u32> = guarded
        .margins
        .values()
        .map(|margin| margin.roundings)
        .collect();
    let in_order = permanent.for_sign.of_format;
    assert!(
        margins
            .iter()
            .all(|any_order| (in_order..in_order + 3).contains(any_order))
    );
    // Six roundings, and shares of u/256 for underflows.
    let factor = guarded.margins.values().next().unwrap().factor.to_f64() * 2f64.powi(53);
    assert!((6.0..6.1).contains(&factor), "{factor}");
}

/// Each chain of a kernel as three counts: the signs that turn its numbers, the numbers, and the widest of these.
#[test]
fn numbers_of_one_unit_share_a_margin_that_suffices_for_each() {
    let folded = |name: &str| {
        let guarded = Guarded::new::<f32>(find(name).unwrap()).unwrap();
        let (mut step, mut found) = (&guarded.steps, Vec::new());
        while let Step::Gate(.., after) = step {
            let Some(chain) = guarded.chain(step) else {
                step = after;
                continue;
            };
            for (_, place) in &chain.numbers {
                let factor = guarded.margins[place].factor;
                assert!(factor.to_f64() <= chain.factor, "{name}");
            }
            found.push([chain.sides.len(), chain.numbers.len(), chain.widest.len()]);
            step = chain.next;
        }
        found
    };
    assert_eq!(folded("moller-trumbore"), [[1, 4, 1]]);
    // A t is no weight, and without a sign that they share the determinant is one of the numbers.
    assert_eq!(folded("moller-trumbore-t"), [[1, 4, 1], [1, 1, 1]]);
    assert_eq!(folded("moller-trumbore-culling"), [[0, 5, 1]]);
    // Both ends of the interval stay alone.
    assert_eq!(folded("cramer"), [[1, 1, 1], [1, 1, 1], [1, 4, 1]]);
    assert_eq!(folded("scalar-triple-two-sided"), [[1, 2, 2]]);
    // Three numbers of one sign, any: gates that no product decides.
    assert_eq!(folded("plucker"), [[0; 3]; 0]);
}
