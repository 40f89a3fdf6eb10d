//! Errors of the hits that remain: of t relative to itself, of the point in the scene's unit of length.

use super::confidence::is_shown;
use crate::arith::{Bounded, Exact, Float, Real, Vector};
use crate::audit::{Histogram, t_of};
use crate::case::Case;
use crate::kernel::Hit;
use std::sync::OnceLock;

named! {
    pub names
    /// A value of a hit that can be off; the word in `--max-error`.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Value {
        /// |t - t'| / |t'|, t' being exact.
        T = "t",
        /// The distance of the point from the exact one; o + t·d as the scalar computes it, or a point of the weights
        /// where a kernel reports no t.
        Point = "point",
    }
}

/// Errors by value; none of what a kernel does not report, infinite where it is not finite.
pub type HitErrors = [Option<f64>; Value::ALL.len()];

/// Errors of some hits by value.
pub type ErrorSums = [Histogram; Value::ALL.len()];

/// One hit in this many may have a larger error.
pub const ERRORS_ONE_IN: u64 = 100;

/// How large errors may be, by value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaxError {
    of: [Option<f64>; Value::ALL.len()],
}

impl MaxError {
    /// From words such as `t=1e-3,point=0.01`.
    pub fn parse(text: &str) -> Result<MaxError, String> {
        let mut most = MaxError::default();
        for word in text.split(',').map(str::trim) {
            let expected = "write t=1e-3 (relative) or point=0.01 (in the scene's unit), or both";
            let (key, number) = word
                .split_once('=')
                .ok_or_else(|| format!("'{word}' is no error: {expected}"))?;
            let value = Value::named(key.trim());
            let value = value.ok_or_else(|| format!("unknown value '{key}': {expected}"))?;
            if most.of[value as usize].is_some() {
                return Err(format!("'{key}' is given twice"));
            }
            let number = number.trim();
            let error = number
                .parse()
                .ok()
                .filter(|x: &f64| 0.0 < *x && x.is_finite());
            let error = error.ok_or_else(|| format!("{key}={number}: not a number above 0"))?;
            most.of[value as usize] = Some(error);
        }
        Ok(most)
    }

    /// The largest error of a value, if it is limited.
    pub fn of(&self, value: Value) -> Option<f64> {
        self.of[value as usize]
    }

    /// True if an error is larger; never for a value that the kernel does not report.
    pub fn is_exceeded(&self, errors: &HitErrors) -> bool {
        let mut pairs = self.of.iter().zip(errors);
        pairs.any(|(most, error)| most.zip(*error).is_some_and(|(most, error)| most < error))
    }

    /// True if so many larger errors among so many hits show that at most one in a hundred is larger.
    pub fn is_kept(exceeded: u64, hits: u64) -> bool {
        is_shown(exceeded, hits, ERRORS_ONE_IN)
    }
}

/// A hit, and its errors once they are asked for.
#[derive(Clone, Copy)]
pub struct JudgedHit<'a, F: Float> {
    /// The triangle and its ray, whose line crosses the plane.
    pub case: &'a Case<F>,
    /// The values that are reported.
    pub hit: &'a Hit<F>,
    /// The errors, which the same hit has in every pass.
    pub errors: &'a OnceLock<HitErrors>,
}

impl<F: Float> JudgedHit<'_, F> {
    /// Its errors.
    pub fn errors(&self) -> HitErrors {
        let of_hit = || hit_errors(self.case, self.hit);
        *self.errors.get_or_init(of_hit)
    }
}

/// The errors of a hit on a triangle whose plane the line crosses.
pub fn hit_errors<F: Float>(case: &Case<F>, hit: &Hit<F>) -> HitErrors {
    errors(case, hit, Bounded::new, Bounded::within).unwrap_or_else(|| {
        let float = |x: &Exact, _| Some(x.approximate());
        errors(case, hit, Exact::from_f64, float).expect("always a number")
    })
}

/// In an arithmetic that does not round; `float` is a number as a float, if it is known to within a
/// tolerance or to a millionth of itself.
fn errors<F: Float, R: Real>(
    case: &Case<F>,
    hit: &Hit<F>,
    number: impl Fn(f64) -> R,
    float: impl Fn(&R, f64) -> Option<f64>,
) -> Option<HitErrors> {
    let lift = |x: F| number(x.to_f64());
    let (ray, triangle) = case.lift(lift);
    let exact_t = t_of(&ray, &triangle);
    let of_t = |t: F| -> Option<f64> {
        if !t.is_finite() {
            return Some(f64::INFINITY);
        }
        let size = float(&exact_t, 0.0)?.abs();
        let off = float(&(lift(t) - &exact_t), size * 1e-9)?.abs();
        Some(if off == 0.0 { 0.0 } else { off / size })
    };
    let [o, d, a, b, c] = case.vectors();
    let point = match (hit.t, &hit.uv) {
        (Some(t), _) => Some([0, 1, 2].map(|i| o[i] + t * d[i])),
        (None, Some((u, v))) => {
            let w = F::one() - *u - *v;
            Some([0, 1, 2].map(|i| w * a[i] + *u * b[i] + *v * c[i]))
        }
        (None, None) => None,
    };
    let exact_point = ray.origin.plus(&ray.direction.times(&exact_t));
    let of_point = |point: [F; 3]| -> Option<f64> {
        if !point.iter().all(F::is_finite) {
            return Some(f64::INFINITY);
        }
        let mut square = 0.0;
        for (axis, x) in point.into_iter().enumerate() {
            let off = lift(x) - &exact_point.at(axis);
            square += float(&off, x.ulp().to_f64() * 1e-6)?.powi(2);
        }
        Some(square.sqrt())
    };
    let transpose = |error: Option<Option<f64>>| match error {
        None => Some(None),
        Some(error) => error.map(Some),
    };
    Some([transpose(hit.t.map(of_t))?, transpose(point.map(of_point))?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use num_rational::BigRational;

    fn rational(x: f32) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    #[test]
    fn errors_are_those_of_rational_numbers() {
        let mut draw = Draw::new("hit-errors", 1, 0);
        for _ in 0..200 {
            // A plane of constant z: t' = (z - o_z) / d_z.
            let z: f32 = draw.symmetric();
            let [mut o, mut d]: [[f32; 3]; 2] = [draw.point(), draw.point()];
            (o[2], d[2]) = (o[2] + 2.0, d[2] / 64.0);
            let corners = [[-9.0, -9.0, z], [9.0, -9.0, z], [0.0, 9.0, z]];
            let t = (z - o[2]) / d[2] * (1.0 + draw.symmetric::<f32>() / 1024.0);
            let exact = (rational(z) - rational(o[2])) / rational(d[2]);
            let off = (rational(t) - &exact) / &exact;
            let hit = Hit {
                t: Some(t),
                uv: None,
                facing: None,
            };
            let [of_t, of_point] = hit_errors(&Case::new(o, d, corners), &hit);
            let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-5 * expected;
            assert!(close(of_t.unwrap(), to_f64(&off).abs()), "{of_t:?} {off}");
            let square: f64 = (0..3)
                .map(|i| {
                    let exact = rational(o[i]) + &exact * rational(d[i]);
                    to_f64(&(rational(o[i] + t * d[i]) - exact)).powi(2)
                })
                .sum();
            assert!(close(of_point.unwrap(), square.sqrt()), "{of_point:?}");
        }
        let hit = Hit {
            t: Some(f32::NAN),
            uv: None,
            facing: None,
        };
        let case = Case::new([0.0; 3], [0.0, 0.0, 1.0], [[0.0, 0.0, 1.0]; 3]);
        assert_eq!(hit_errors(&case, &hit)[1], Some(f64::INFINITY));
    }

    #[test]
    fn errors_of_weights_are_those_of_the_point_that_they_name() {
        let mut draw = Draw::new("weight-errors", 1, 0);
        for index in 0..200 {
            let (o, d): ([f32; 3], [f32; 3]) = (draw.point(), draw.point());
            let corners: [[f32; 3]; 3] = [draw.point(), draw.point(), draw.point()];
            let (u, v) = (draw.symmetric::<f32>() * 3.0, draw.symmetric::<f32>());
            let w = 1.0 - u - v;
            let [a, b, c] = corners;
            let at = |i: usize| w * a[i] + u * b[i] + v * c[i];
            // Where the line crosses the plane, by Cramer's rule.
            let [ro, rd, ra, rb, rc] = [o, d, a, b, c].map(|v| v.map(rational));
            let minus =
                |p: &[BigRational; 3], q: &[BigRational; 3]| [0, 1, 2].map(|i| &p[i] - &q[i]);
            let (e, f, s) = (minus(&rb, &ra), minus(&rc, &ra), minus(&ra, &ro));
            let n = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &e[i] * &f[j] - &e[j] * &f[i]);
            let dot = |p: &[BigRational; 3]| (0..3).map(|i| &p[i] * &n[i]).sum::<BigRational>();
            let t = dot(&s) / dot(&rd);
            let off = |i: usize| to_f64(&(rational(at(i)) - (&ro[i] + &t * &rd[i])));
            let distance = (0..3).map(|i| off(i).powi(2)).sum::<f64>().sqrt();
            let case = Case::new(o, d, corners);
            let hit = Hit {
                t: None,
                uv: Some((u, v)),
                facing: None,
            };
            let [of_t, of_point] = hit_errors(&case, &hit);
            let found = of_point.unwrap();
            assert!(
                of_t.is_none() && (found - distance).abs() <= 1e-5 * distance,
                "{found} {index}"
            );
            // The point of t is judged where there is one.
            let both = hit_errors(
                &case,
                &Hit {
                    t: Some(0.5),
                    uv: Some((u, v)),
                    facing: None,
                },
            );
            assert_eq!(
                both,
                hit_errors(
                    &case,
                    &Hit {
                        t: Some(0.5),
                        uv: None,
                        facing: None
                    }
                )
            );
        }
    }

    #[test]
    fn errors_are_zero_where_nothing_is_off_and_none_where_nothing_is_said() {
        let corners = [[-4.0, -4.0, 2.0], [4.0, -4.0, 2.0], [0.0, 4.0, 2.0]];
        let of = |t: Option<f32>, uv, z: f32| {
            let case = Case::<f32>::new([0.0, 0.0, z], [0.0, 0.0, 1.0], corners);
            hit_errors(
                &case,
                &Hit {
                    t,
                    uv,
                    facing: None,
                },
            )
        };
        assert_eq!(of(Some(2.0), None, 0.0), [Some(0.0); 2]);
        assert_eq!(of(Some(3.0), None, 1.0), [Some(2.0), Some(2.0)]);
        assert_eq!(of(Some(1.0), None, 0.0), [Some(0.5), Some(1.0)]);
        // At t' = 0 an error has no size to be compared with.
        assert_eq!(of(Some(0.0), None, 2.0), [Some(0.0); 2]);
        assert_eq!(of(Some(1.0), None, 2.0), [Some(f64::INFINITY), Some(1.0)]);
        assert_eq!(of(None, None, 0.0), [None; 2]);
        assert_eq!(of(None, Some((0.25, 0.5)), 0.0), [None, Some(0.0)]);
        assert_eq!(of(Some(f32::INFINITY), None, 0.0), [Some(f64::INFINITY); 2]);
        assert_eq!(of(Some(f32::NAN), None, 0.0), [Some(f64::INFINITY); 2]);
        assert_eq!(
            of(None, Some((f32::NAN, 0.5)), 0.0),
            [None, Some(f64::INFINITY)]
        );
    }

    fn to_f64(x: &BigRational) -> f64 {
        use num_traits::ToPrimitive;
        x.to_f64().unwrap()
    }

    #[test]
    fn one_hit_in_a_hundred_may_be_farther_off_if_that_is_shown() {
        // Wilks: 299 hits without one, 473 with one.
        assert!(MaxError::is_kept(0, 299) && !MaxError::is_kept(0, 298));
        assert!(MaxError::is_kept(1, 473) && !MaxError::is_kept(1, 472));
    }

    #[test]
    fn words_say_how_large_errors_may_be() {
        let most = MaxError::parse("t=1e-3, point=0.5").unwrap();
        assert_eq!(
            Value::ALL.map(|value| most.of(value)),
            [Some(1e-3), Some(0.5)]
        );
        assert!(most.is_exceeded(&[Some(0.01), None]) && most.is_exceeded(&[None, Some(1.0)]));
        assert!(!most.is_exceeded(&[Some(1e-3), Some(0.5)]) && !most.is_exceeded(&[None, None]));
        for (text, part) in [
            ("", "is no error"),
            ("t", "is no error"),
            ("u=1", "unknown value 'u'"),
            ("t=0", "not a number above 0"),
            ("t=nan", "not a number above 0"),
            ("point=-1", "not a number above 0"),
            ("t=1,t=2", "given twice"),
        ] {
            assert!(MaxError::parse(text).unwrap_err().contains(part), "{text}");
        }
    }
}
