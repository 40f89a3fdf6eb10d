//! The constants of docs/design/margin.md, computed again in exact rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Zero};
use std::collections::BTreeMap;
use std::ops::{Add, Mul};

fn ratio(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// 2 to a power.
fn two(exponent: i32) -> BigRational {
    let power = BigRational::from(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// A format, as the page has it.
#[derive(Clone)]
struct Format {
    /// u = 2^-digits, φ = 2^normal, δ = 2^least.
    digits: i32,
    normal: i32,
    least: i32,
    largest: i32,
    far: i32,
    most: i32,
}

const FORMATS: [Format; 2] = [
    Format {
        digits: 24,
        normal: -126,
        least: -59,
        largest: 27,
        far: 40,
        most: 127,
    },
    Format {
        digits: 53,
        normal: -1022,
        least: -506,
        largest: 280,
        far: 128,
        most: 1023,
    },
];

impl Format {
    fn u(&self) -> BigRational {
        two(-self.digits)
    }

    /// (1+u)^k - 1.
    fn gamma(&self, k: u32) -> BigRational {
        Pow::pow(BigRational::one() + self.u(), k) - BigRational::one()
    }
}

/// A polynomial in e, R, D and |t| with coefficients that are not negative.
#[derive(Clone, Debug)]
struct Polynomial(BTreeMap<[u8; 4], BigRational>);

impl Polynomial {
    fn number(x: BigRational) -> Self {
        Polynomial(BTreeMap::from([([0; 4], x)]))
    }

    fn variable(place: usize) -> Self {
        let mut powers = [0; 4];
        powers[place] = 1;
        Polynomial(BTreeMap::from([(powers, BigRational::one())]))
    }

    fn times(&self, x: &BigRational) -> Self {
        self.clone() * Polynomial::number(x.clone())
    }

    /// True if no coefficient is larger: then no value is, where the variables are not negative.
    fn is_within(&self, other: &Polynomial) -> bool {
        let zero = BigRational::zero();
        let least = |powers| other.0.get(powers).unwrap_or(&zero);
        self.0.iter().all(|(powers, x)| x <= least(powers))
    }
}

impl Add for Polynomial {
    type Output = Polynomial;
    fn add(mut self, other: Polynomial) -> Polynomial {
        for (powers, x) in other.0 {
            *self.0.entry(powers).or_insert_with(BigRational::zero) += x;
        }
        self
    }
}

impl Mul for Polynomial {
    type Output = Polynomial;
    fn mul(self, other: Polynomial) -> Polynomial {
        let mut product = Polynomial(BTreeMap::new());
        for (p, x) in &self.0 {
            for (q, y) in &other.0 {
                let powers = [0, 1, 2, 3].map(|i| p[i] + q[i]);
                let term = Polynomial(BTreeMap::from([(powers, x * y)]));
                product = product + term;
            }
        }
        product
    }
}

/// A computed number: its size is at least the sum of the absolute values of its terms, each of which passes some
/// roundings; underflow adds at most `flushed` times φ.
#[derive(Clone)]
struct Computed {
    size: Polynomial,
    roundings: u32,
    flushed: Polynomial,
}

/// The numbers of the test in a format.
struct Bounds<'a>(&'a Format);

impl Bounds<'_> {
    fn one(&self) -> Polynomial {
        Polynomial::number(BigRational::one())
    }

    /// A number that is read, which may flush it.
    fn read(&self, number: Computed) -> Computed {
        Computed {
            flushed: number.flushed + self.one(),
            ..number
        }
    }

    fn input(&self, size: Polynomial) -> Computed {
        self.read(Computed {
            size,
            roundings: 0,
            flushed: Polynomial(BTreeMap::new()),
        })
    }

    /// One more rounding, and one more underflow.
    fn rounded(&self, size: Polynomial, roundings: u32, flushed: Polynomial) -> Computed {
        let flushed = flushed.times(&(BigRational::one() + self.0.u())) + self.one();
        Computed {
            size,
            roundings: roundings + 1,
            flushed,
        }
    }

    /// The difference of two inputs, whose size is known.
    fn difference_of_inputs(&self, size: Polynomial) -> Computed {
        self.rounded(size, 0, self.one() + self.one())
    }

    fn sum(&self, x: &Computed, y: &Computed) -> Computed {
        self.rounded(
            x.size.clone() + y.size.clone(),
            x.roundings.max(y.roundings),
            x.flushed.clone() + y.flushed.clone(),
        )
    }

    fn product(&self, x: &Computed, y: &Computed) -> Computed {
        let grown = |it: &Computed| {
            it.size
                .times(&(BigRational::one() + self.0.gamma(it.roundings)))
        };
        let flushed = x.flushed.clone() * grown(y)
            + y.flushed.clone() * grown(x)
            + (x.flushed.clone() * y.flushed.clone()).times(&two(self.0.normal));
        self.rounded(
            x.size.clone() * y.size.clone(),
            x.roundings + y.roundings,
            flushed,
        )
    }

    /// A coordinate of a cross product, or a dot product of three equal terms.
    fn minor(&self, x: &Computed, y: &Computed) -> Computed {
        let product = self.product(x, y);
        self.sum(&product, &product)
    }

    fn dot(&self, x: &Computed, y: &Computed) -> Computed {
        let product = self.product(x, y);
        self.sum(&self.sum(&product, &product), &product)
    }
}

#[test]
fn roundings_and_underflow_are_within_the_margin() {
    for format in &FORMATS {
        let bounds = Bounds(format);
        let [e, r, d, t] = [0, 1, 2, 3].map(Polynomial::variable);
        let one = bounds.one();
        let s = bounds.difference_of_inputs(r.clone());
        let edge = bounds.read(bounds.difference_of_inputs(e.clone()));
        let direction = bounds.input(d.clone());
        // c-a and b-a are not read again before N is made, which flushes less.
        let normal = bounds.read(bounds.minor(&edge, &edge));
        let weight = bounds.dot(&bounds.minor(&s, &direction), &edge);
        let det = bounds.dot(&direction, &normal);
        assert_eq!((weight.roundings, det.roundings), (7, 7));
        // det - U - V: the last sum cannot pass a number that it is compared with.
        let first = bounds.sum(&det, &weight);
        assert_eq!(first.roundings, 8);
        let last = bounds.sum(&first, &weight);
        // An underflow of the margin's own products takes four at most from what follows.
        let own = Polynomial::number(ratio(4, 1));
        let delta = two(format.least);
        let phi = two(format.normal);
        let floor = (one.clone() + e.clone()) * (one.clone() + d.clone());
        let floor = floor * (one.clone() + e.clone() + r.clone());
        let floor = floor.times(&(&delta * &delta / &phi));
        assert!((last.flushed + own.clone()).is_within(&floor), "{floor:?}");

        let depth = bounds.dot(&s, &normal);
        assert_eq!(depth.roundings, 8);
        let end = bounds.product(&bounds.input(t.clone()), &det);
        assert_eq!(end.roundings, 8);
        let past = bounds.sum(&depth, &end);
        // depth * (|s| + |t| speed + δ (1 + speed)), with speed at least D + δ (1+D).
        let square = (one.clone() + e.clone()) * (one.clone() + e.clone());
        let speed = d.clone() + (one.clone() + d.clone()).times(&delta);
        let lengths = r.clone() + t * speed.clone() + (one.clone() + speed).times(&delta);
        let floor = (square * lengths).times(&(&delta / &phi));
        assert!((past.flushed + own).is_within(&floor), "{floor:?}");
    }
}

#[test]
fn the_factor_covers_eight_roundings_and_its_own() {
    for format in &FORMATS {
        let (u, one) = (format.u(), BigRational::one());
        // A permanent is at most κ = 3!/3^(3/2) times the product of the lengths of its rows: κ² = 4/3. Both sides squared.
        let gamma = format.gamma(8);
        let needed = &gamma * &gamma * ratio(4, 3);
        // The margin is itself the result of fewer than 32 roundings.
        let own = Pow::pow(&one - &u, 32u32);
        let given = ratio(37, 4) * &u * own;
        assert!(needed < &given * &given);
        // 9.23 would not do.
        let less = ratio(923, 100) * &u;
        assert!(&less * &less < needed);
        // A length's squares that underflow are less than δ: 6 φ < δ².
        assert!(ratio(6, 1) * two(format.normal) < two(2 * format.least));
    }
}

#[test]
fn nothing_overflows_within_the_largest_sizes() {
    for format in &FORMATS {
        let (largest, one) = (two(format.largest), BigRational::one());
        // With e, |a|, |o| and D at most that: |s| at most twice it. The largest numbers are t det, with |t| at most the
        // farthest end, W, and the sums of their terms' sizes; 2 covers all roundings.
        let r = ratio(2, 1) * &largest;
        let e = &largest;
        let cube = |x: &BigRational, y: &BigRational, z: &BigRational| ratio(6, 1) * x * y * z;
        let det = cube(e, e, &largest);
        let w = &det + ratio(2, 1) * cube(&r, &largest, e);
        let past = cube(&r, e, e) + two(format.far) * &det;
        for number in [det, w, past] {
            assert!(ratio(2, 1) * number + &one < two(format.most));
        }
    }
}

/// Σ (x_j y_k + x_k y_j)² <= 4/3 |x|² |y|² for vectors that are not negative: the step of the permanent's bound, on a grid.
#[test]
fn the_bound_of_the_permanent_holds_and_is_met_on_the_diagonal() {
    let square = |v: [i64; 3]| v.iter().map(|x| x * x).sum::<i64>();
    let pairs = |x: [i64; 3], y: [i64; 3]| {
        let sums = [(0, 1), (1, 2), (2, 0)].map(|(j, k)| x[j] * y[k] + x[k] * y[j]);
        square(sums)
    };
    let of = |i: i64| [i % 7, i / 7 % 7, i / 49];
    for (i, j) in (0..343).flat_map(|i| (0..343).map(move |j| (i, j))) {
        let (x, y) = (of(i), of(j));
        assert!(3 * pairs(x, y) <= 4 * square(x) * square(y), "{x:?} {y:?}");
    }
    let (x, y) = ([2; 3], [5; 3]);
    assert_eq!(3 * pairs(x, y), 4 * square(x) * square(y));
}
