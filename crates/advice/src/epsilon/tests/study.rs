//! A whole study: what it chooses, names and tries on fresh rays.

use super::super::measure::{Ran, differs, measure};
use super::super::prepared::Prepared;
use super::*;

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The number, the largest and the median of the errors in a histogram.
fn told(errors: &Histogram) -> (u64, f64, f64) {
    (errors.count(), errors.largest(), errors.quantile(0.5))
}

#[test]
fn a_study_tries_everything_on_fresh_rays() {
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let knobs = tuned.knobs.len();
        let named = vec![
            ("one".to_owned(), epsilons[..knobs].to_vec()),
            ("again".to_owned(), epsilons[..knobs].to_vec()),
            ("zero".to_owned(), vec![0.0; knobs]),
        ];
        let costs = Costs::parse("crack=3,miss=2,hit=0.5").unwrap();
        let max_error = MaxError::parse("t=0.05,point=0.1").unwrap();
        let (seed, number) = (6, 300);
        let pass = Pass::new(seed, number, &Unobserved);
        let setting = tuned.setting();
        let study = study_scene(&setting, &costs, Some(&max_error), &named, pass).unwrap();
        let names: Vec<&str> = study
            .tried
            .iter()
            .map(|tried| tried.name.as_str())
            .collect();
        assert_eq!(names, ["recommended", "one", "zero"], "{kernel}");
        assert_eq!(study.tried[0].epsilons, study.best);
        let cheapest = |max| cheapest(&setting, &costs, max, pass);
        let accurate = cheapest(Some(&max_error));
        assert_eq!(study.is_accurate, accurate.is_some());
        let best = accurate.or_else(|| cheapest(None)).unwrap();
        let max = study.is_accurate.then_some(&max_error);
        let (best, _) = within_limits(&setting, best, &costs, max, pass);
        assert_eq!(study.best, best);
        let fresh = tuned.all(seed + 1, number);
        let of = |c: usize| fresh.iter().filter(move |kept| kept.count == c);
        for tried in &study.tried {
            let mut cost = 0.0;
            for (c, count) in tuned.counts.iter().enumerate() {
                let hits: Vec<&StoredStudy> =
                    of(c).filter(|kept| kept.is_hit(&tried.epsilons)).collect();
                let all = of(c).count();
                let wrong = if tuned.is_lost(c) {
                    all - hits.len()
                } else {
                    hits.len()
                };
                let found = tried.wrong[c];
                assert_eq!(
                    (found.count, found.of),
                    (wrong as u64, all as u64),
                    "{kernel} {count:?}"
                );
                assert_eq!(found.products.of_squared, all as u64, "one trial a ray");
                cost += costs.of(count.kind) * wrong as f64 / all.max(1) as f64;
                let exceeded = tried.exceeded[c];
                let mut sums = [Histogram::default(), Histogram::default()];
                let hits = if tuned.is_miss(c) { hits } else { Vec::new() };
                for kept in &hits {
                    let pairs = sums.iter_mut().zip(kept.errors);
                    pairs.for_each(|(sum, error)| {
                        error.into_iter().for_each(|error| sum.add(error))
                    });
                }
                let off = hits
                    .iter()
                    .filter(|kept| max_error.is_exceeded(&kept.errors))
                    .count();
                assert_eq!(
                    (exceeded.count, exceeded.of),
                    (off as u64, hits.len() as u64)
                );
                assert_eq!(
                    tried.errors[c].each_ref().map(told),
                    sums.each_ref().map(told)
                );
            }
            for (c, found) in tried.doubles.iter().enumerate() {
                let is_crack = setting.counts[c].kind == WrongKind::Crack;
                let rays = fresh.iter().filter(|kept| is_crack && kept.count == c);
                let accepts =
                    |m: &&KnobMargins<f32>| tried.epsilons.iter().zip(*m).all(|(e, m)| e <= m);
                let double = |kept: &&StoredStudy| 1 < kept.margins.iter().filter(accepts).count();
                let counted = (rays.clone().filter(double).count(), rays.count());
                assert_eq!(
                    (found.count as usize, found.of as usize),
                    counted,
                    "{kernel} {c}"
                );
            }
            assert!(
                (tried.cost - cost).abs() <= 1e-9,
                "{kernel} {} {cost}",
                tried.cost
            );
        }
        let expected = limits(&setting, &study.best, pass);
        let found: Vec<_> = study
            .limits
            .iter()
            .map(|found| found.bound.clone())
            .collect();
        assert_eq!(found, expected, "{kernel}");
        let moved = study.limits.iter().filter_map(
            |OnFresh {
                 bound,
                 wrong,
                 price,
             }| {
                Some((
                    bound.knob,
                    bound.count,
                    bound.is_lower,
                    bound.value?,
                    *wrong,
                    *price,
                ))
            },
        );
        let proofs = study.proved.iter().map(
            |OnFresh {
                 bound,
                 wrong,
                 price,
             }| {
                (
                    bound.knob,
                    bound.count,
                    bound.is_lower,
                    bound.value,
                    *wrong,
                    *price,
                )
            },
        );
        for (k, c, is_lower, value, trials, price) in moved.chain(proofs) {
            let left = |kept: &&StoredStudy| is_lower || kept.is_hit_with(&study.best, k, f32::MIN);
            let lost = of(c)
                .filter(left)
                .filter(|kept| !kept.is_hit_with(&study.best, k, value));
            let (lost, all) = (lost.count() as u64, of(c).filter(left).count() as u64);
            let wrong = if tuned.is_lost(c) { lost } else { all - lost };
            assert_eq!(
                (trials.count, trials.of),
                (wrong, all),
                "{kernel} {k} {c} {value:e}"
            );
            if let Some((c, trials)) = price {
                let hits = of(c)
                    .filter(|kept| kept.is_hit_with(&study.best, k, value))
                    .count();
                let wrong = if tuned.is_lost(c) {
                    of(c).count() - hits
                } else {
                    hits
                };
                let expected = (wrong as u64, of(c).count() as u64, is_lower);
                assert_eq!(
                    (trials.count, trials.of, tuned.is_lost(c)),
                    expected,
                    "{kernel} {value:e}"
                );
            }
        }
        for (k, curve) in study.curves.iter().enumerate() {
            let has = |value: f32| curve.values.contains(&value);
            assert!(study.tried.iter().all(|tried| has(tried.epsilons[k])) && has(0.0));
            let of_knob = study.limits.iter().filter(|found| found.bound.knob == k);
            assert!(
                of_knob.filter_map(|found| found.bound.value).all(has),
                "{kernel} {k}"
            );
            let of_knob = study.proved.iter().filter(|found| found.bound.knob == k);
            assert!(
                of_knob.map(|found| found.bound.value).all(has),
                "{kernel} {k}"
            );
            for (i, value) in curve.values.iter().enumerate().step_by(5) {
                for c in 0..tuned.counts.len() {
                    let hits = of(c).filter(|kept| kept.is_hit_with(&study.best, k, *value));
                    assert_eq!(
                        curve.hits[c][i],
                        hits.count() as u64,
                        "{kernel} {k} {c} {value:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_knob_moves_to_the_middle_of_its_limits_where_that_costs_no_more_than_chance_explains() {
    let (costs, seed, number) = (Costs::default(), 8, 300);
    let pass = Pass::new(seed, number, &Unobserved);
    let (mut moved, mut dearer) = (0, 0);
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let (setting, all) = (tuned.setting(), tuned.all(seed, number));
        let of = |c: usize| all.iter().filter(move |kept| kept.count == c);
        let cost = |point: &[f32]| -> f64 {
            let of_count = |(c, count): (usize, &RayCount)| {
                let wrong = of(c)
                    .filter(|kept| kept.is_hit(point) != tuned.is_lost(c))
                    .count();
                costs.of(count.kind) * (wrong as f64 / of(c).count().max(1) as f64)
            };
            tuned.counts.iter().enumerate().map(of_count).sum()
        };
        let by_chance = |from: &[f32], to: &[f32]| -> f64 {
            let of_count = |(c, count): (usize, &RayCount)| {
                let hits = |point| of(c).filter(|kept| kept.is_hit(point)).count();
                let weight = costs.of(count.kind) / of(c).count().max(1) as f64;
                weight * weight * hits(from).abs_diff(hits(to)) as f64
            };
            2.0 * tuned
                .counts
                .iter()
                .enumerate()
                .map(of_count)
                .sum::<f64>()
                .sqrt()
        };
        for factor in [0.0, 1e-4, 1.0, 1e3] {
            let from: Vec<f32> = epsilons[..tuned.knobs.len()]
                .iter()
                .map(|x| x * factor)
                .collect();
            let middles = between(&all_limits(&setting, &from, pass), from.len());
            let mut expected = from.clone();
            for (k, middle) in middles.into_iter().enumerate() {
                let is_moved = |middle: &f32| from[k] != 0.0 && (*middle < 0.0) == (from[k] < 0.0);
                let Some(middle) = middle.filter(is_moved) else {
                    continue;
                };
                let mut next = expected.clone();
                next[k] = middle;
                match cost(&next) - cost(&from) <= by_chance(&from, &next) {
                    true => expected = next,
                    false => dearer += 1,
                }
            }
            let (found, of_found) = within_limits(&setting, from.clone(), &costs, None, pass);
            assert_eq!(found, expected, "{kernel} {from:?}");
            assert_eq!(of_found, limits(&setting, &found, pass));
            moved += u32::from(found != from);
        }
    }
    assert!(0 < moved && 0 < dearer, "{moved} {dearer}");
}

#[test]
fn a_form_that_follows_the_size_is_named_if_it_is_a_fifth_cheaper() {
    for (kernel, scene, expected) in [
        ("plane-inside-out", "cad-mm", true),
        ("plane-unit-normal", "city", true),
        ("moller-trumbore", "room", false),
        // By a sixth.
        ("plucker", "room", false),
    ] {
        let tuned = Tuned::new(kernel, scene);
        let setting = tuned.setting();
        let costs = Costs::default();
        let study =
            study_scene(&setting, &costs, None, &[], Pass::new(1, 300, &Unobserved)).unwrap();
        let relative = Setting {
            relative: true,
            ..setting
        };
        let followed = cheapest(&relative, &costs, None, Pass::new(1, 300, &Unobserved)).unwrap();
        let (followed, found) = within_limits(
            &relative,
            followed,
            &costs,
            None,
            Pass::new(1, 300, &Unobserved),
        );
        let wrong = count_at(
            &relative,
            &[Attempt::new(followed.clone())],
            Pass::new(2, 300, &Unobserved),
        )
        .remove(0);
        let cost = costs.total(
            &tuned.counts,
            wrong.iter().map(|w| w.share().unwrap_or(0.0)),
        );
        let is_named = cost < 0.8 * study.tried[0].cost;
        let told = format!("{kernel} {cost} {}", study.tried[0].cost);
        assert_eq!(
            (study.relative.is_some(), is_named),
            (expected, expected),
            "{told}"
        );
        assert_eq!(study.relative_limits, found);
        if let Some(form) = study.relative {
            assert_eq!(
                (form.epsilons, form.wrong, form.cost),
                (followed, wrong, cost)
            );
        }
    }
}

#[test]
fn epsilons_of_a_row_stand_by_knob() {
    let tuned = Tuned::new("moller-trumbore", "room");
    let of_gates = tuned.row.epsilons::<f32>();
    assert_eq!(
        own_epsilons(&tuned.row, &tuned.knobs, 0.25),
        [of_gates[0], of_gates[1], 0.25]
    );
    let reversed: Vec<Knob> = tuned.knobs.iter().rev().copied().collect();
    assert_eq!(
        own_epsilons(&tuned.row, &reversed, 0.25),
        [0.25, of_gates[1], of_gates[0]]
    );
    assert_eq!([0, 7, u64::MAX].map(fresh_seed), [1, 8, 0]);
}

#[test]
fn a_pass_tells_a_fault_of_any_chunk_and_the_errors_of_one_attempt() {
    let tuned = Tuned::new("moller-trumbore", "room");
    let zero = vec![0.0; tuned.knobs.len()];
    let attempts = [Attempt::new(zero.clone())];
    let with_fault_at = |wanted: usize| {
        let looked = AtomicUsize::new(0);
        let check = |_: &Prepared<f32>, _: &[KnobMargins<f32>]| {
            let fault = (looked.fetch_add(1, Relaxed) == wanted).then(|| "off".to_owned());
            Ran {
                fault,
                ..Ran::default()
            }
        };
        let found = measure(
            &tuned.setting(),
            &attempts,
            1,
            None,
            Pass::new(6, 300, &Unobserved),
            check,
        );
        (found, looked.into_inner())
    };
    let (sound, chunks) = with_fault_at(usize::MAX);
    assert!(sound.ran.fault.is_none() && 5 < chunks);
    for chunk in 0..chunks {
        assert_eq!(
            with_fault_at(chunk).0.ran.fault.as_deref(),
            Some("off"),
            "{chunk} of {chunks}"
        );
    }
    let all = tuned.all(6, 300);
    for (c, errors) in sound.of_hits[0].errors.iter().enumerate() {
        let hits = all
            .iter()
            .filter(|kept| kept.count == c && kept.is_hit(&zero))
            .count();
        let hits = if tuned.is_miss(c) { hits as u64 } else { 0 };
        assert_eq!(
            errors.each_ref().map(Histogram::count),
            [hits; 2],
            "{:?}",
            tuned.counts[c]
        );
    }
}

#[test]
fn a_run_that_is_not_what_its_margins_say_is_told() {
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let setting = tuned.setting();
        let point = [epsilons[..tuned.knobs.len()].to_vec()];
        let differs = differs(&setting, &point, &Unobserved);
        let told = |change: &(dyn Fn(KnobMargins<f32>) -> KnobMargins<f32> + Sync)| {
            let check = |part: &Prepared<f32>, margins: &[KnobMargins<f32>]| {
                differs(
                    part,
                    &margins
                        .iter()
                        .map(|margins| change(*margins))
                        .collect::<Vec<_>>(),
                )
            };
            measure(
                &setting,
                &[],
                0,
                None,
                Pass::new(6, 300, &Unobserved),
                check,
            )
            .ran
            .fault
        };
        assert_eq!(told(&|margins| margins), None, "{kernel}");
        let [hit, miss] = [f32::MAX, f32::MIN].map(|all| told(&move |_| [all; 3]).unwrap());
        assert!(
            hit.contains("it misses, but with each of these alone it hits, on "),
            "{hit}"
        );
        assert!(
            miss.contains("it hits, but with each of these alone it misses, on "),
            "{miss}"
        );
    }
}
