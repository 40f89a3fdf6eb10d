mod claims;
mod constants;
mod gates;
mod meaning;
mod measures;
mod mirrors;
mod others;
mod permanent;
mod program;
mod ratios;
mod repair;
mod sign;
mod tiny;
mod unit;
mod verdict;
mod watertight;

use crate::arith::Arithmetic;
use crate::arith::recorded::{Place, Recorded, record};
use crate::kernel::Path;

/// A polynomial's program and the place of its value.
fn recorded(run: impl FnOnce() -> Recorded) -> (Path, Place) {
    let (place, tape) = record(&[], Arithmetic::IEEE, || run().place());
    let (operations, decisions) = (tape.operations, tape.decisions);
    (
        Path {
            operations,
            compared: Vec::new(),
            decisions: decisions.made,
            hits: true,
            values: [None; 3],
        },
        place,
    )
}

/// A difference of two coordinates: points are numbered 0 to 3 as the origin, a, b and c.
fn difference(p: u8, q: u8, axis: u8) -> Recorded {
    let number = |p: u8| Recorded::input(if p == 0 { axis } else { 3 + 3 * p + axis });
    number(p) - number(q)
}

/// orient2d(a, b, c) in Shewchuk's order.
fn orient2d() -> Recorded {
    let [acx, bcx] = [1, 2].map(|p| difference(p, 3, 0));
    let [acy, bcy] = [1, 2].map(|p| difference(p, 3, 1));
    acx * bcy - acy * bcx
}

/// orient3d(a, b, c, origin) in Shewchuk's order.
fn orient3d() -> Recorded {
    let [adx, bdx, cdx] = [1, 2, 3].map(|p| difference(p, 0, 0));
    let [ady, bdy, cdy] = [1, 2, 3].map(|p| difference(p, 0, 1));
    let [adz, bdz, cdz] = [1, 2, 3].map(|p| difference(p, 0, 2));
    let minor =
        |a: &Recorded, b: &Recorded, c: &Recorded, d: &Recorded| a.clone() * b - c.clone() * d;
    adz * minor(&bdx, &cdy, &cdx, &bdy)
        + bdz * minor(&cdx, &ady, &adx, &cdy)
        + cdz * minor(&adx, &bdy, &bdx, &ady)
}
