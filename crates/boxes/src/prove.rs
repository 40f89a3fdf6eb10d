//! The least growth of the far end with which no ray is lost, for the three formulas of t: docs/design/boxes-proof.md has the
//! argument. What it presumes of a program's numbers is checked here, exactly, and so is a ray that a smaller growth loses.

use crate::case::{BoxCase, Boxes};
use crate::family::Made;
use crate::kernel::TABLE;
use crate::oracle::truth;
use hairline_core::Verdict;
use hairline_core::arith::{scale_by_power_of_two, smallest_normal};
use hairline_core::kernel::{Scalar, Subject};
use num_rational::BigRational as Rational;
use num_traits::{One, pow};

/// The sizes of a program's numbers. Coordinates are 0 or within `coordinates`, components of directions 0 or within
/// `directions`, whatever their signs.
#[derive(Clone, Copy, Debug)]
pub struct Domain {
    coordinates: [f64; 2],
    directions: [f64; 2],
}

impl Domain {
    /// From the least and the largest size of a coordinate, and of a component of a direction. An error if they are not finite
    /// sizes above 0 in order.
    pub fn new(coordinates: [f64; 2], directions: [f64; 2]) -> Result<Domain, String> {
        for [least, most] in [coordinates, directions] {
            let are_sizes = 0.0 < least && most.is_finite();
            if !are_sizes || most < least {
                return Err(format!(
                    "{least:e} and {most:e} are not finite sizes above 0 in order"
                ));
            }
        }
        Ok(Domain {
            coordinates,
            directions,
        })
    }
}

/// The answer for a formula in a scalar.
#[derive(Clone, Debug)]
pub struct Growth<F: Made> {
    /// The slab test with this formula.
    pub test: &'static str,
    /// The growth that is enough, as a number of units in the last place of 1; none if no growth is.
    pub enough: Option<u32>,
    /// A ray that the next smaller growth loses, or if no growth is enough a very large one.
    pub witness: BoxCase<F>,
    /// All that the answer rests on, in words, and if it holds. It is proved if all of them hold.
    pub conditions: Vec<(String, bool)>,
}

/// A formula, with rays that need more growth than one unit less than it is promised.
struct Form {
    test: &'static str,
    /// How often a t is rounded.
    roundings: Option<u32>,
    /// A plane, an origin and a direction where the box is entered and where it is left, in `f32` and in `f64`.
    witnesses: [[[f64; 3]; 2]; 2],
}

const FORMS: [Form; 3] = [
    Form {
        test: "divided",
        roundings: Some(2),
        witnesses: [
            [
                [0.99609375, -0.003906317055225372, 0.6872742176055908],
                [
                    0.9960941076278687,
                    -0.003906307741999626,
                    0.6872744560241699,
                ],
            ],
            [
                [
                    0.9960937500000007,
                    -0.003906250000000113,
                    0.6782062333199226,
                ],
                [
                    0.9960937500000002,
                    -0.003906250000000097,
                    0.6782062333199222,
                ],
            ],
        ],
    },
    Form {
        test: "multiplied",
        roundings: Some(3),
        witnesses: [
            [
                [0.996093988, -0.00390631147, 0.842104375],
                [0.996096611, -0.00390630821, 0.842106581],
            ],
            [
                [
                    0.9960937500000004,
                    -0.003906250000000113,
                    0.8494528542674405,
                ],
                [
                    0.9960937500000056,
                    -0.003906250000000103,
                    0.8494528542674449,
                ],
            ],
        ],
    },
    Form {
        test: "fused",
        roundings: None,
        witnesses: [
            [[-5.0, -5.0, 3.0], [TINY, 0.0, 1.0]],
            [[5.0, 5.0, 3.0], [TINY, 0.0, 1.0]],
        ],
    },
];

/// 2^-100. The smaller it is, the more growth that witness needs.
const TINY: f64 = f64::from_bits((1023 - 100) << 52);

/// The least growth of the far end for each formula.
pub fn least_growths<F: Made + Scalar>(domain: &Domain) -> Vec<Growth<F>> {
    FORMS
        .iter()
        .filter_map(|form| least_growth(form, domain))
        .collect()
}

fn least_growth<F: Made + Scalar>(form: &Form, domain: &Domain) -> Option<Growth<F>> {
    let subject = F::subject(TABLE.find(form.test)?)?;
    let [single, double] = form.witnesses;
    let witness = ray::<F>(if F::DIGITS < 53 { single } else { double });
    let mut growth = Growth {
        test: form.test,
        enough: form.roundings,
        witness,
        conditions: Vec::new(),
    };
    let is_met = truth(&witness).hits_closed() == Some(true);
    growth.add(is_met, "the exact line of the witness meets its box");
    let Some(roundings) = form.roundings else {
        let lost = !is_hit(subject, &witness, u32::MAX);
        growth.add(lost, "a growth by 2^32 units in the last place loses it");
        return Some(growth);
    };
    let less = roundings - 1;
    let lost = !is_hit(subject, &witness, less);
    growth.add(lost, &format!("1 + {less}*EPSILON loses it"));
    let kept = is_hit(subject, &witness, roundings);
    growth.add(kept, &format!("1 + {roundings}*EPSILON keeps it"));
    growth.check_rounding(roundings);
    growth.check_range(roundings, domain);
    Some(growth)
}

/// A ray that enters a box on the first axis and leaves it on the second.
fn ray<F: Made>([enters, leaves]: [[f64; 3]; 2]) -> BoxCase<F> {
    let number = F::from_f64;
    let [near, first, into] = enters.map(number);
    let [far, second, out] = leaves.map(number);
    let (zero, one) = (F::zero(), F::one());
    let min = [near, -one, zero];
    let max = [number(8.0), far, one];
    BoxCase::new([first, second, number(0.5)], [into, out, zero], [min, max])
}

/// True if a test hits a ray with a growth of so many units in the last place of 1.
fn is_hit<F: Made>(subject: &dyn Subject<F, Boxes>, case: &BoxCase<F>, units: u32) -> bool {
    let growth = F::from_f64(-f64::from(units)) * F::EPSILON;
    let mut verdict = [Verdict::miss(None)];
    subject.run(&[*case], &[growth], &mut verdict);
    verdict[0].hit
}

/// The exact value of a finite number.
fn exact(x: f64) -> Rational {
    Rational::from_float(x).unwrap_or_else(Rational::one)
}

impl<F: Made> Growth<F> {
    fn add(&mut self, holds: bool, what: &str) {
        self.conditions.push((what.to_owned(), holds));
    }

    /// The grown far end is less than half a place below the near one, so it rounds to that or to more: step 5.
    fn check_rounding(&mut self, roundings: u32) {
        let n = roundings as usize;
        let one = Rational::one;
        let unit = exact(F::EPSILON.to_f64()) / exact(2.0);
        let grown = one() + exact(2.0 * f64::from(roundings)) * &unit;
        let share = grown / pow(one() + exact(2.0) * &unit, n);
        let half_a_place = one() - unit / exact(2.0);
        let what = format!("(1 + {}u) / (1 + 2u)^{n} > 1 - u/2, u = EPSILON/2", 2 * n);
        self.add(half_a_place < share, &what);
    }

    /// Nothing overflows, and nothing underflows: the hypothesis.
    fn check_range(&mut self, roundings: u32, domain: &Domain) {
        let [least, extent] = domain.coordinates.map(exact);
        let [slow, fast] = domain.directions.map(exact);
        let smallest = exact(smallest_normal::<F>());
        let largest = exact(scale_by_power_of_two(1.0, F::MAX_EXPONENT));
        let error = pow(
            Rational::one() + exact(F::EPSILON.to_f64()),
            roundings as usize,
        );
        // Coordinates are multiples of a last place of the least one, and so are their differences.
        let place = least * exact(F::EPSILON.to_f64()) / exact(2.0);
        let most = exact(2.0) * extent;
        self.add(&most * &error < largest, "b - o does not overflow");
        if 2 < roundings {
            let inverse = Rational::one() / &slow;
            self.add(inverse * &error < largest, "1 / d does not overflow");
            let inverse = Rational::one() / &fast;
            self.add(smallest < inverse / &error, "1 / d does not underflow");
        }
        self.add(most / slow * &error < largest, "t does not overflow");
        let holds = smallest < place / fast / error;
        self.add(holds, "no t but 0 underflows");
    }
}
