//! The limits that a scene gives to numbers that kernels divide by, and to quotients: each is known by its value, in
//! whatever order a program computes it.

use super::Dyadic;
use super::order::largest_axes;
use super::run::run;
use crate::arith::recorded::Place;
use crate::case::Draw;
use crate::kernel::Path;
use glam::DVec3;

/// The measures of a scene's triangles and rays. In the names of numbers N = (b-a)×(c-a), N_k is its largest coordinate
/// and N_i another one, d_k the largest coordinate of d, e an edge, p and q are vertices, and u stands for all three
/// barycentric coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measures {
    /// |N| at least.
    pub area: Dyadic,
    /// |N·d|/|N| at least, for |d| = 1.
    pub sine: Dyadic,
    /// The length of an edge over |N| at most: the reciprocal of a height.
    pub slope: Dyadic,
    /// Every coordinate of a point at most.
    pub world: Dyadic,
    /// |t| at most.
    pub distance: Dyadic,
}

/// A limit of the size of a number, and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Limit {
    /// The domain's limit of all divisors, or of all quotients.
    Domain(Dyadic),
    /// The scene's, which knows the number by this name.
    Scene(&'static str, Dyadic),
    /// The largest numerator over the least divisor. It supposes nothing more.
    Own(Dyadic),
}

impl Limit {
    /// The limit itself.
    pub fn size(self) -> Dyadic {
        match self {
            Limit::Domain(size) | Limit::Scene(_, size) | Limit::Own(size) => size,
        }
    }
}

/// A number that a scene knows.
pub(super) struct Known {
    pub name: &'static str,
    pub limit: Dyadic,
    pub value: f64,
}

/// How many inputs show whether two formulas are the same. Random ones: different rational functions are equal
/// nearly nowhere.
const SAMPLES: u64 = 3;

/// Values of all numbers of a path's program at some inputs.
#[derive(Debug)]
pub(super) struct Samples {
    values: Vec<(Vec<f64>, Sample)>,
    /// The axis of N's largest coordinate, if the path chose it. All axes if no N takes the path.
    axes: Vec<usize>,
}

impl Samples {
    pub fn new(path: &Path) -> Samples {
        let sample = |i: u64| {
            let mut draw = Draw::new("measures", 1, i);
            let inputs: [f64; 17] = std::array::from_fn(|_| draw.symmetric());
            let mut values = Vec::new();
            run(&path.operations, path.operations.len() as Place - 1, &inputs, &mut values);
            (values, Sample::of(&inputs))
        };
        let mut samples = Samples { values: (0..SAMPLES).map(sample).collect(), axes: vec![] };
        samples.axes = largest_axes(path, |place| {
            (0..3).find(|axis| samples.is_same(place, |i| samples.values[i].1.normal[*axis]))
        });
        samples
    }

    /// True if a number is another one up to its sign, given that one's values.
    fn is_same(&self, place: Place, other: impl Fn(usize) -> f64) -> bool {
        self.values.iter().enumerate().all(|(i, (values, _))| {
            let (x, y) = (values[place as usize].abs(), other(i).abs());
            (x - y).abs() <= 1e-9 * y
        })
    }

    /// The limit of the first of the known numbers that a number is, up to its sign. Given these numbers, for a
    /// sample and the axes of N's largest coordinate.
    pub fn find(
        &self,
        place: Place,
        known: impl Fn(&Sample, &[usize]) -> Vec<Known>,
    ) -> Option<Limit> {
        let of = |(_, sample): &(Vec<f64>, Sample)| known(sample, &self.axes);
        let mut lists: Vec<Vec<Known>> = self.values.iter().map(of).collect();
        let is_same = |at: usize| self.is_same(place, |i| lists[i][at].value);
        let found = (0..lists[0].len()).find(|i| is_same(*i))?;
        let Known { name, limit, .. } = lists[0].swap_remove(found);
        Some(Limit::Scene(name, limit))
    }
}

/// A triangle and a ray.
#[derive(Debug)]
pub(super) struct Sample {
    origin: DVec3,
    direction: DVec3,
    vertices: [DVec3; 3],
    edges: [DVec3; 3],
    pub normal: DVec3,
}

impl Sample {
    pub fn of(inputs: &[f64; 17]) -> Sample {
        let [origin, direction, a, b, c] =
            [0, 3, 6, 9, 12].map(|i| DVec3::from_slice(&inputs[i..]));
        let edges = [b - a, c - a, c - b];
        Sample { origin, direction, vertices: [a, b, c], edges, normal: edges[0].cross(edges[1]) }
    }
}

/// The name of the largest coordinate of N.
pub const LARGEST: &str = "|N_k|";

/// No other coordinate of N is more than this times as large as N_k, which is the largest one of those computed.
const LARGER: f64 = 1.01;

/// Slightly more than √(1 + 1.01²): a vector at right angles to N has no coordinate above this times |N_k|/|N| times its
/// length.
const ROOT: f64 = 1.423;

impl Measures {
    /// Divisors. Given the axes of N's largest coordinate.
    pub(super) fn divisors(&self, sample: &Sample, axes: &[usize]) -> Vec<Known> {
        let Measures { area, sine, .. } = *self;
        let normal = sample.normal;
        let (volume, length) = (normal.dot(sample.direction), normal.length());
        let known =
            |name, limit: Dyadic, value| Known { name, limit: limit.round_down(DIGITS), value };
        let largest = area * below(0.573);
        let mut all = vec![
            known("|N·d|", area * sine, volume),
            known("|N·N|", area * area, normal.dot(normal)),
            known("|N|", area, length),
            known("|N·d|/|N|", sine, volume / length),
        ];
        for k in axes.iter().copied() {
            all.push(known(LARGEST, largest, normal[k]));
            all.push(known("|N·d/N_k|", sine, volume / normal[k]));
        }
        all
    }

    /// Quotients.
    pub(super) fn quotients(&self, sample: &Sample, axes: &[usize]) -> Vec<Known> {
        let Measures { slope, world, distance, .. } = *self;
        let Sample { origin, direction, vertices, edges, normal } = *sample;
        let [a, b, c] = vertices;
        let known =
            |name, limit: Dyadic, value| Known { name, limit: limit.round_up(DIGITS), value };
        let square = normal.dot(normal);
        let t = normal.dot(a - origin) / normal.dot(direction);
        let p = origin + t * direction - a;
        let [v, u] = [edges[0].cross(p), p.cross(edges[1])].map(|x| normal.dot(x) / square);
        let mut all = vec![known("|t|", distance, t)];
        all.extend([u, v, 1.0 - u - v].map(|w| known("|u|", Dyadic::ONE, w)));
        for k in axes.iter().copied() {
            let over = |name, limit, value: f64| known(name, limit, value / normal[k]);
            for i in (0..3).filter(|i| *i != k) {
                let name = "|N_i/N_k|";
                all.push(over(name, above(LARGER), normal[i]));
                let name = "|e_i/N_k|";
                all.extend(edges.map(|edge| over(name, slope * above(ROOT), edge[i])));
            }
            let name = "|N·a/N_k|";
            all.push(over(name, world * above(3.03), a.dot(normal)));
            // p×q = p×(q-p).
            let name = "|(p×q)_k/N_k|";
            for (p, q) in [(a, b), (a, c), (b, c)] {
                all.push(over(name, world * slope * above(2.0 * ROOT), p.cross(q)[k]));
            }
        }
        let name = "|(e×N)_i/N·N|";
        for i in 0..3 {
            all.extend(edges.map(|edge| known(name, slope, edge.cross(normal)[i] / square)));
        }
        all
    }
}

/// Binary digits of what a scene says; the corners are computed with them exactly.
pub(super) const DIGITS: u32 = 10;

fn above(x: f64) -> Dyadic {
    Dyadic::from_f64(x).expect("finite").round_up(DIGITS)
}

fn below(x: f64) -> Dyadic {
    Dyadic::from_f64(x).expect("finite").round_down(DIGITS)
}
