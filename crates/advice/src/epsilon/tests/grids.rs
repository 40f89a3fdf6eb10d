//! Grids of epsilons: round numbers over the margins that matter, as fine as the number of points allows.

use super::*;

/// The largest size of a value of a knob that means anything where directions are of unit length: the largest
/// triangle, or the longest way.
fn largest(tuned: &Tuned, knob: Knob) -> f64 {
    let gates = tuned.row.entry.info.gates;
    let [edge, way] = [tuned.scene.edge[1], tuned.scene.distance[1]];
    let length = if knob.gate(gates).role == Role::T {
        way
    } else {
        edge
    };
    length.powi(knob.gate(gates).dimension.length.into())
}

#[test]
fn a_grid_holds_round_numbers_over_the_margins_that_matter() {
    let max_error = MaxError::parse("t=1e-5").unwrap();
    let mut thin = 0;
    for (kernel, _) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        for (most_points, max_error) in [(300_000, None), (300_000, Some(&max_error)), (1000, None)]
        {
            let all = tuned.all(5, 200);
            let (found, step): (KnobGrid<f32>, usize) = grid(
                &tuned.setting(),
                most_points,
                max_error,
                Pass::new(5, 200, &Unobserved),
            );
            let is_thin = 0 < step;
            assert!(!is_thin || most_points == 1000, "{kernel}");
            thin += u32::from(is_thin);
            for (k, knob) in tuned.knobs.iter().enumerate() {
                let most = largest(&tuned, *knob);
                let (mut above, mut below) = (Vec::new(), Vec::new());
                for kept in &all {
                    let margin = kept.margins.iter().map(|m| m[k]).fold(f32::MIN, f32::max);
                    let size = f64::from(margin.abs()).min(most);
                    let is_off = max_error.is_some_and(|max| max.is_exceeded(&kept.errors));
                    if !margin.is_finite() || margin == 0.0 || margin == f32::MIN {
                        continue;
                    }
                    if margin < 0.0 && tuned.is_lost(kept.count) {
                        below.extend([size, (100.0 * size).min(most)]);
                    }
                    let (kind, is_miss) =
                        (tuned.counts[kept.count].kind, tuned.is_miss(kept.count));
                    let is_of_t = knob.gate(tuned.row.entry.info.gates).role == Role::T;
                    // False hits that start elsewhere say nothing of a least t.
                    let is_in_reach = !is_of_t || is_miss || kind == WrongKind::SelfHit;
                    let is_refused = !tuned.is_lost(kept.count) || is_miss && is_off;
                    if margin > 0.0 && is_refused && is_in_reach {
                        above.push(size);
                        let is_beyond = is_miss || is_of_t;
                        above.extend(is_beyond.then_some((100.0 * size).min(most)));
                    }
                }
                if !knob.takes_negative(tuned.row.entry.info.gates) {
                    below.clear();
                }
                let values = &found.values()[k];
                assert!(
                    values.windows(2).all(|pair| pair[0] < pair[1]),
                    "{values:?}"
                );
                let has = |value: f32| values.contains(&value);
                assert!(has(0.0), "{values:?}");
                let of_sign = |is_above: bool| -> Vec<f64> {
                    let mut sizes: Vec<f64> = values
                        .iter()
                        .filter(|x| **x != 0.0 && (0.0 < **x) == is_above)
                        .map(|x| f64::from(x.abs()))
                        .collect();
                    sizes.sort_by(f64::total_cmp);
                    sizes
                };
                for (sizes, wanted) in [(of_sign(true), above), (of_sign(false), below)] {
                    let told = format!("{kernel} {knob:?} {sizes:?}");
                    let is_decade = |size: &f64| format!("{:e}", *size as f32).starts_with("1e");
                    assert!(!is_thin || sizes.iter().all(is_decade), "{told}");
                    let Some(least) = wanted.iter().copied().reduce(f64::min) else {
                        assert!(sizes.is_empty(), "{told}");
                        continue;
                    };
                    let most = wanted.into_iter().fold(0.0, f64::max);
                    let [first, second] = [sizes[0], sizes[1.min(sizes.len() - 1)]];
                    // Three times the precision below the largest of them the others are as good as none.
                    let low = least.max(2e-38).max(most * f64::from(f32::EPSILON).powi(3));
                    assert!(
                        first <= low * 1.000001 && low <= second * 1.000001,
                        "{told} {least:e}"
                    );
                    let last = sizes[sizes.len() - 1];
                    let before = sizes[sizes.len().saturating_sub(2)];
                    assert!(most <= last * 1.000001, "{told} {most:e}");
                    assert!(sizes.len() == 1 || before < most, "{told} {most:e}");
                }
            }
            let points: usize = found
                .values()
                .iter()
                .map(|values| values.len() + 1)
                .product();
            assert!(points <= most_points, "{points}");
        }
    }
    assert!(0 < thin);
}

#[test]
fn a_grid_is_as_fine_as_its_points_allow() {
    for (kernel, _) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let within = |most_points: usize| {
            let (found, step) = grid(
                &tuned.setting(),
                most_points,
                None,
                Pass::new(5, 200, &Unobserved),
            );
            let points: usize = found
                .values()
                .iter()
                .map(|values| values.len() + 1)
                .product();
            (points, step)
        };
        let (points, finest) = within(usize::MAX);
        assert_eq!((within(points), finest), ((points, 0), 0), "{kernel}");
        let (fewer, coarser) = within(points - 1);
        assert!(
            fewer < points && coarser == 1,
            "{kernel}: {fewer} of {points}, {coarser}"
        );
        // Nothing is left out after the eighth step, however few are allowed.
        assert_eq!(within(0).1, 8, "{kernel}");
    }
}
