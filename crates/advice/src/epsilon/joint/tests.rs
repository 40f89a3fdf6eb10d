//! The best point of a grid against its definition, and the counts that it is chosen by.

use super::super::tests::{KERNELS, StoredStudy, Tuned};
use super::*;
use crate::audit::Unobserved;
use crate::case::Draw;
use crate::epsilon::Rays;

#[test]
fn a_union_counts_each_point_once() {
    let mut draw = Draw::new("union", 1, 0);
    for _ in 0..500 {
        let boxes: Vec<Accepted> = (0..draw.below(6) + 1)
            .map(|_| [(); MOST_KNOBS].map(|()| draw.below(4)))
            .collect();
        let terms = union(boxes.iter().copied());
        for point in 0..64usize {
            let point = [point / 16, point / 4 % 4, point % 4];
            let holds = |corner: &Accepted| point.iter().zip(corner).all(|(p, c)| p < c);
            let sum: i64 = terms
                .iter()
                .filter(|(_, c)| holds(c))
                .map(|(sign, _)| sign)
                .sum();
            assert_eq!(
                sum,
                i64::from(boxes.iter().any(holds)),
                "{boxes:?} {point:?}"
            );
        }
    }
}

#[test]
fn the_counts_of_a_pass_are_those_of_its_trials_one_by_one() {
    let max_error = MaxError::parse("t=1e-5").unwrap();
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let all = tuned.all(6, 200);
        let of_knob = |size: f32| vec![-size, 0.0, size, 100.0 * size];
        let values: Vec<Vec<f32>> = epsilons[..tuned.knobs.len()]
            .iter()
            .map(|e| of_knob(e.abs().max(1e-6)))
            .collect();
        let count = |max_error: Option<&MaxError>| {
            let grid = KnobGrid::new(values.clone());
            Joint::count(
                &tuned.setting(),
                grid,
                max_error,
                Pass::new(6, 200, &Unobserved),
            )
        };
        let joint = count(Some(&max_error));
        assert!(count(None).exceeded.is_none());
        let exceeded = joint.exceeded.as_ref().unwrap();
        let mut off_in_all = 0;
        for places in all_places(&values) {
            let (point, cell) = (at(&values, &places), joint.cell_of(&places));
            let counted = |sums: &[i64]| sums.get(cell).copied().unwrap_or(0) as usize;
            for (c, count) in tuned.counts.iter().enumerate() {
                let of: Vec<&StoredStudy> = all.iter().filter(|kept| kept.count == c).collect();
                let hits: Vec<&&StoredStudy> =
                    of.iter().filter(|kept| kept.is_hit(&point)).collect();
                let off = hits
                    .iter()
                    .filter(|kept| max_error.is_exceeded(&kept.errors))
                    .count();
                // Only where a hit is right its errors count.
                let off = if count.kind == WrongKind::Miss {
                    off
                } else {
                    0
                };
                off_in_all += off;
                let found = [
                    joint.of[c] as usize,
                    counted(&joint.hits[c]),
                    counted(&exceeded[c]),
                ];
                assert_eq!(
                    found,
                    [of.len(), hits.len(), off],
                    "{kernel} {count:?} {point:?}"
                );
            }
        }
        assert!(0 < off_in_all, "{kernel}");
    }
}

/// Random trials of three counts; each may be there many times, with an error that is too large or not.
struct Trials {
    /// The count, the margins, how many, and how many of them are too far off.
    all: Vec<(usize, Vec<KnobMargins<f32>>, i64, i64)>,
}

const COUNTS: [RayCount; 4] = {
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
    fn random(draw: &mut Draw, values: &[Vec<f32>]) -> Trials {
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
    fn hits(&self, point: &[f32]) -> [[i64; 2]; 4] {
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

    fn cost(&self, costs: &[f64; 4], point: &[f32]) -> f64 {
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

    fn is_accurate(&self, point: &[f32]) -> bool {
        let [hits, off] = self.hits(point)[0];
        MaxError::is_kept(off as u64, hits as u64)
    }
}

fn draw_near(draw: &mut Draw, values: &[f32]) -> f32 {
    draw.pick(values) + draw.pick(&[0.0, 0.25, -0.25])
}

/// The counts at every point, each by itself.
fn counted(values: &[Vec<f32>], trials: &Trials, limited: bool) -> Joint<f32> {
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

fn at(values: &[Vec<f32>], places: &[usize]) -> Vec<f32> {
    values
        .iter()
        .zip(places)
        .map(|(values, place)| values[*place])
        .collect()
}

/// The last knob's places first.
fn all_places(values: &[Vec<f32>]) -> Vec<Vec<usize>> {
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

/// The point that [`Joint::best`] promises, found step by step at points that are counted one by one.
fn expected(
    values: &[Vec<f32>],
    cost: &dyn Fn(&[usize]) -> f64,
    is_accurate: &dyn Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    let accurate = all_places(values)
        .into_iter()
        .filter(|places| is_accurate(places));
    let mut places = accurate.reduce(|a, b| if cost(&b) < cost(&a) { b } else { a })?;
    let is_kept = |places: &[usize], most: f64| is_accurate(places) && cost(places) <= most;
    let most = cost(&places) * 1.01;
    let mut free = Vec::new();
    for (k, values) in values.iter().enumerate() {
        let mut zeroed = places.clone();
        match values.iter().position(|value| *value == 0.0) {
            Some(zero) => zeroed[k] = zero,
            None => zeroed[k] = usize::MAX,
        }
        if zeroed[k] < usize::MAX && is_kept(&zeroed, most) {
            places = zeroed;
        } else {
            free.push(k);
        }
    }
    for k in free {
        let ends = |most: f64| {
            let is_good = |place: usize| {
                let mut moved = places.clone();
                moved[k] = place;
                is_kept(&moved, most)
            };
            let (mut low, mut high) = (places[k], places[k]);
            while 0 < low && is_good(low - 1) {
                low -= 1;
            }
            while high + 1 < values[k].len() && is_good(high + 1) {
                high += 1;
            }
            (low, high)
        };
        // Four values of the least cost or more are taken by themselves.
        let (low, high) = ends(cost(&places));
        let (low, high) = if low + 3 <= high {
            (low, high)
        } else {
            ends(most)
        };
        places[k] = (low + high) / 2;
    }
    Some(places)
}

/// Some values of one to three knobs.
fn axes(draw: &mut Draw) -> Vec<Vec<f32>> {
    let axis = |draw: &mut Draw| {
        let from = -(draw.below(5) as i64);
        (from..from + 1 + draw.below(6) as i64)
            .map(|x| x as f32)
            .collect()
    };
    (0..1 + draw.below(3)).map(|_| axis(draw)).collect()
}

/// A hundredth more is within reach of what costs a hundredth.
const COSTS: [[f64; 4]; 3] = [
    [10.0, 1.0, 1.0, 1.0],
    [1.0, 100.0, 1.0, 1.0],
    [1.0, 0.0, 0.01, 1.0],
];

#[test]
fn the_best_point_is_the_cheapest_and_rather_zero_or_in_the_middle() {
    let mut draw = Draw::new("best", 1, 0);
    let (mut none, mut limited_count, mut zeros, mut moved) = (0, 0, 0, 0);
    for round in 0..1500 {
        let mut values = axes(&mut draw);
        if draw.coin() {
            values[0].iter_mut().for_each(|x| *x += 0.5);
        }
        let trials = Trials::random(&mut draw, &values);
        let costs = Costs {
            of: draw.pick(&COSTS),
        };
        let limited = draw.below(3) == 0;
        let joint = counted(&values, &trials, limited);
        let by_count = COUNTS.map(|count| costs.of(count.kind));
        let cost = |places: &[usize]| trials.cost(&by_count, &at(&values, places));
        let is_accurate = |places: &[usize]| !limited || trials.is_accurate(&at(&values, places));
        let expected = expected(&values, &cost, &is_accurate);
        let found = joint.best(&COUNTS, &costs);
        let expected = expected.map(|places| at(&values, &places));
        assert_eq!(found, expected, "{round} {values:?} {:?}", trials.all);
        none += u32::from(found.is_none());
        limited_count += u32::from(limited && found.is_some());
        let point = found.unwrap_or_default();
        zeros += u32::from(point.contains(&0.0));
        moved += u32::from(point.iter().any(|x| *x != 0.0));
    }
    let limited = limited_count;
    assert!(
        20 < none && 100 < limited && 200 < zeros && 200 < moved,
        "{none} {limited} {zeros} {moved}"
    );
}

#[test]
fn a_point_moves_one_knob_after_the_other_where_that_costs_no_more_than_chance_explains() {
    let mut draw = Draw::new("moved", 1, 0);
    let (mut all_moved, mut some_stay, mut inaccurate, mut by_chance) = (0, 0, 0, 0);
    'rounds: for round in 0..1500 {
        let values = axes(&mut draw);
        let trials = Trials::random(&mut draw, &values);
        let costs = Costs {
            of: draw.pick(&COSTS),
        };
        let limited = draw.coin();
        let by_count = COUNTS.map(|count| costs.of(count.kind));
        let cost = |point: &[f32]| trials.cost(&by_count, point);
        // Each ray that ends otherwise adds its weight to the difference, and its square to the variance.
        let by_chance_at_most = |from: &[f32], to: &[f32]| {
            let [before, after] = [from, to].map(|point| trials.hits(point));
            let weight = |c: usize| {
                let of: i64 = trials
                    .all
                    .iter()
                    .filter(|it| it.0 == c)
                    .map(|it| it.2)
                    .sum();
                by_count[c] / of.max(1) as f64
            };
            let changed = |c: usize| (after[c][0] - before[c][0]).abs() as f64;
            let variance: f64 = (0..4).map(|c| weight(c).powi(2) * changed(c)).sum();
            2.0 * variance.sqrt()
        };
        let is_accurate = |point: &[f32]| !limited || trials.is_accurate(point);
        let from: Vec<f32> = values.iter().map(|values| draw.pick(values)).collect();
        // 99 is none of the values: nothing is known of it.
        let to = |values: &Vec<f32>| {
            let other = draw.pick(values);
            draw.pick(&[None, Some(other), Some(other), Some(99.0)])
        };
        let to: Vec<Option<f32>> = values.iter().map(to).collect();
        let (mut expected, mut stayed) = (from.clone(), 0);
        for (k, to) in to.iter().enumerate() {
            let Some(value) = to.filter(|value| *value != 99.0) else {
                continue;
            };
            let mut next = expected.clone();
            next[k] = value;
            let is_kept = is_accurate(&next) || !is_accurate(&from);
            let more = cost(&next) - cost(&from);
            let most = by_chance_at_most(&from, &next);
            // Of what is as much as chance explains rounding decides.
            if (more - most).abs() < 1e-12 && 0.0 < more {
                continue 'rounds;
            }
            let is_as_good = more <= most;
            by_chance += u32::from(1e-9 < more && is_as_good && is_kept);
            inaccurate += u32::from(is_as_good && !is_kept);
            if is_as_good && is_kept {
                expected = next;
            } else {
                stayed += 1;
            }
        }
        let joint = counted(&values, &trials, limited);
        let found = joint.moved(&COUNTS, &costs, &from, &to);
        all_moved += u32::from(expected != from && stayed == 0);
        some_stay += u32::from(0 < stayed);
        assert_eq!(
            found,
            Some(expected),
            "{round} {values:?} {from:?} {to:?} {:?}",
            trials.all
        );
        assert_eq!(
            joint.moved(&COUNTS, &costs, &vec![99.0; from.len()], &to),
            None
        );
    }
    assert!(
        100 < all_moved && 100 < some_stay && 2 < inaccurate && 20 < by_chance,
        "{all_moved} {some_stay} {inaccurate} {by_chance}"
    );
}

#[test]
fn cells_are_summed_over_all_above_them() {
    let mut draw = Draw::new("accumulated", 1, 0);
    for lengths in [vec![1], vec![4], vec![2, 3], vec![3, 1, 2]] {
        let values: Vec<Vec<f32>> = lengths
            .iter()
            .map(|n| (0..*n).map(|x| x as f32).collect())
            .collect();
        let grid = KnobGrid::new(values.clone());
        // One more in each direction.
        let wide: Vec<Vec<f32>> = lengths
            .iter()
            .map(|n| (0..=*n).map(|x| x as f32).collect())
            .collect();
        let all = all_places(&wide);
        assert_eq!(grid.cells(), all.len());
        let cells: Vec<i64> = all.iter().map(|_| draw.integer(-9, 9)).collect();
        let sums = accumulated(&grid, &cells);
        for places in &all {
            let above = |other: &&Vec<usize>| places.iter().zip(*other).all(|(p, o)| p <= o);
            let sum: i64 = all
                .iter()
                .filter(above)
                .map(|o| cells[grid.cell(o.iter().copied())])
                .sum();
            assert_eq!(
                sums[grid.cell(places.iter().copied())],
                sum,
                "{lengths:?} {places:?}"
            );
        }
        assert!(accumulated(&grid, &[]).is_empty());
    }
}

#[test]
fn costs_are_words_between_commas() {
    let costs = Costs::parse("miss=0, crack=2.5").unwrap();
    assert_eq!(
        WrongKind::ALL.map(|kind| costs.of(kind)),
        [2.5, 0.0, 1.0, 1.0]
    );
    let of = |costs: Costs| WrongKind::ALL.map(|kind| costs.of(kind));
    assert_eq!(of(Costs::default()), [10.0, 1.0, 1.0, 1.0]);
    assert_eq!(
        of(Costs::parse("hit=1e9,self-hit=0").unwrap()),
        [10.0, 1.0, 1e9, 0.0]
    );
    for (text, part) in [
        ("", "is no cost"),
        ("crack", "is no cost"),
        ("cracks=1", "unknown kind"),
        (
            "mis=3",
            "unknown kind 'mis': did you mean 'miss'? write crack=10,",
        ),
        ("crack=nan", "not a number from 0"),
        ("crack=-1", "not a number from 0"),
        ("crack=1000000000.1", "not a number from 0"),
        ("miss=1,miss=2", "given twice"),
        ("crack=0,miss=0,hit=0,self-hit=0", "every cost is 0"),
    ] {
        assert!(Costs::parse(text).unwrap_err().contains(part), "{text}");
    }
}

#[test]
fn a_grid_accepts_a_value_up_to_its_margin() {
    let grid = KnobGrid::new(vec![vec![-1.0f32, 0.0, 2.0], vec![0.0], vec![1.0, 3.0]]);
    assert_eq!(grid.accepted(&[0.0, f32::INFINITY, 1.0]), Some([2, 1, 1]));
    assert_eq!(grid.accepted(&[2.0, 0.0, 2.9]), Some([3, 1, 1]));
    // Of which a value of one knob is accepted by none.
    assert_eq!(grid.accepted(&[0.0, f32::INFINITY, 0.5]), None);
    assert_eq!(grid.accepted(&[-f32::INFINITY, 0.0, 3.0]), None);
    assert_eq!(grid.accepted(&[2.0, -0.5, 3.0]), None);
}

#[test]
fn sums_of_two_threads_are_added_cell_by_cell() {
    let mut sums = JointSums {
        of: vec![1, 2],
        cells: vec![vec![1, 2], vec![]],
        exceeded: vec![vec![], vec![5]],
    };
    sums.merge(JointSums {
        of: vec![10, 20],
        cells: vec![vec![3, 4], vec![7, 9]],
        exceeded: vec![vec![6], vec![8]],
    });
    assert_eq!(sums.of, [11, 22]);
    assert_eq!(sums.cells, [[4, 6], [7, 9]]);
    assert_eq!(sums.exceeded, [[6], [13]]);
}
