//! Random trials, whose hits at each point of a grid are counted one by one.

use super::*;

/// Random trials of three counts; each may be there many times, with an error that is too large or not.
pub(super) struct Trials {
    /// The count, the margins, how many, and how many of them are too far off.
    pub all: Vec<(usize, Vec<KnobMargins<f32>>, i64, i64)>,
}

pub(super) const COUNTS: [RayCount; 4] = {
    use crate::family::Stratum::*;
    [
        RayCount {
            rays: Rays::Stratum(Interior),
            kind: WrongKind::Miss,
        },
        RayCount {
            rays: Rays::Stratum(Parallel),
            kind: WrongKind::Hit,
        },
        RayCount {
            rays: Rays::Stratum(Edges),
            kind: WrongKind::Crack,
        },
        RayCount {
            rays: Rays::Stratum(Shadow),
            kind: WrongKind::SelfHit,
        },
    ]
};

impl Trials {
    pub fn random(draw: &mut Draw, values: &[Vec<f32>]) -> Trials {
        let margin = |draw: &mut Draw, axis: usize| match values.get(axis) {
            Some(_) if draw.below(4) == 0 => f32::INFINITY,
            Some(values) => draw_near(draw, values),
            None => f32::INFINITY,
        };
        let trial = |draw: &mut Draw| {
            // Of the last count there is none.
            let count = draw.below(3);
            let triangles = if count == 2 { 1 + draw.below(3) } else { 1 };
            let margins = (0..triangles).map(|_| [0, 1, 2].map(|axis| margin(draw, axis)));
            let margins = margins.collect();
            let off = if draw.below(4) == 0 {
                draw.below(3) as i64
            } else {
                0
            };
            (count, margins, draw.pick(&[1, 100, 300]), off)
        };
        Trials {
            all: (0..1 + draw.below(12)).map(|_| trial(draw)).collect(),
        }
    }

    /// By count: the hits at a point, and those of them that are too far off.
    pub fn hits(&self, point: &[f32]) -> [[i64; 2]; 4] {
        let mut hits = [[0; 2]; 4];
        for (count, margins, many, off) in &self.all {
            if margins
                .iter()
                .any(|m| point.iter().zip(m).all(|(value, m)| value <= m))
            {
                hits[*count][0] += many;
                hits[*count][1] += off;
            }
        }
        hits
    }

    pub fn cost(&self, costs: &[f64; 4], point: &[f32]) -> f64 {
        let hits = self.hits(point);
        let share = |c: usize| {
            let of: i64 = self
                .all
                .iter()
                .filter(|trial| trial.0 == c)
                .map(|trial| trial.2)
                .sum();
            let refused = [0, 2].contains(&c);
            let wrong = if refused { of - hits[c][0] } else { hits[c][0] };
            wrong as f64 / of.max(1) as f64
        };
        (0..4).map(|c| costs[c] * share(c)).sum()
    }

    pub fn is_accurate(&self, point: &[f32]) -> bool {
        let [hits, off] = self.hits(point)[0];
        MaxError::is_kept(off as u64, hits as u64)
    }
}

fn draw_near(draw: &mut Draw, values: &[f32]) -> f32 {
    draw.pick(values) + draw.pick(&[0.0, 0.25, -0.25])
}

/// The counts at every point, each by itself.
pub(super) fn counted(values: &[Vec<f32>], trials: &Trials, limited: bool) -> Joint<f32> {
    let grid = KnobGrid::new(values.to_vec());
    let mut of = vec![0; 4];
    trials
        .all
        .iter()
        .for_each(|(count, _, many, _)| of[*count] += *many as u64);
    let mut sums = [(); 2].map(|()| vec![vec![-1; grid.cells()]; 4]);
    for places in all_places(values) {
        let cell = grid.cell(places.iter().map(|place| place + 1));
        let hits = trials.hits(&at(values, &places));
        for (c, hits) in hits.into_iter().enumerate() {
            hits.into_iter()
                .zip(&mut sums)
                .for_each(|(n, sum)| sum[c][cell] = n);
        }
    }
    let [mut hits, mut exceeded] = sums;
    // Of what is never counted there are no cells.
    hits[3] = Vec::new();
    exceeded[1..].fill(Vec::new());
    if trials.all.iter().all(|(.., off)| *off == 0) {
        exceeded[0] = Vec::new();
    }
    Joint {
        grid,
        of,
        hits,
        exceeded: limited.then_some(exceeded),
    }
}

pub(super) fn at(values: &[Vec<f32>], places: &[usize]) -> Vec<f32> {
    values
        .iter()
        .zip(places)
        .map(|(values, place)| values[*place])
        .collect()
}

/// The last knob's places first.
pub(super) fn all_places(values: &[Vec<f32>]) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for values in values {
        let longer = |places: &Vec<usize>| {
            let places = places.clone();
            (0..values.len()).map(move |place| [&places[..], &[place]].concat())
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// Some values of one to three knobs.
pub(super) fn axes(draw: &mut Draw) -> Vec<Vec<f32>> {
    let axis = |draw: &mut Draw| {
        let from = -(draw.below(5) as i64);
        (from..from + 1 + draw.below(6) as i64)
            .map(|x| x as f32)
            .collect()
    };
    (0..1 + draw.below(3)).map(|_| axis(draw)).collect()
}

/// A hundredth more is within reach of what costs a hundredth.
pub(super) const COSTS: [[f64; 4]; 3] = [
    [10.0, 1.0, 1.0, 1.0],
    [1.0, 100.0, 1.0, 1.0],
    [1.0, 0.0, 0.01, 1.0],
];
