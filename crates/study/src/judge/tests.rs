//! Obligations, findings and classes, worked out by hand. Here are the classes, and the truths that all of them are tried on.

mod findings;
mod many_cases;
mod obligations;

use super::*;
use crate::oracle::truth;

fn case_down_at(x: f64, y: f64, z: f64) -> Case<f64> {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    Case::new([x, y, z], [0.0, 0.0, -1.0], triangle)
}

fn down_at(x: f64, y: f64, z: f64) -> Truth {
    truth(&case_down_at(x, y, z))
}

/// All truths that there are, and some that cannot be.
fn all_truths() -> Vec<Truth> {
    let mut all = vec![Truth::Parallel, Truth::Invalid];
    for feature in Feature::ALL {
        for facing in [Facing::Front, Facing::Back] {
            for place in Place::ALL {
                for t_sign in [Ordering::Less, Ordering::Equal, Ordering::Greater] {
                    all.push(Truth::Transversal(Crossing {
                        facing,
                        place,
                        t_sign,
                        feature,
                    }));
                }
            }
        }
    }
    for kind in [
        ContactKind::None,
        ContactKind::Segment,
        ContactKind::Point(Feature::EdgeBc),
    ] {
        for (meets_ray, meets_line) in [(false, false), (false, true), (true, true)] {
            let contact = Contact {
                kind,
                meets_ray,
                meets_line,
            };
            all.extend([Truth::Coplanar(contact), Truth::Degenerate(contact)]);
        }
    }
    all
}

#[test]
fn class_names_are_unique_and_numbered() {
    let names: std::collections::HashSet<&str> = Class::all().map(Class::name).collect();
    assert_eq!(names.len(), Class::COUNT);
    assert_eq!(
        Class::of(&down_at(1.0, 0.0, 1.0)).name(),
        "edge/front/within"
    );
    assert_eq!(
        Class::of(&down_at(1.0, 1.0, -1.0)).name(),
        "interior/front/before"
    );
    assert_eq!(Class::of(&Truth::Invalid).name(), "invalid");
    assert!(Class::try_from(Class::COUNT as u8).is_err());
    for truth in all_truths() {
        let class = Class::of(&truth);
        assert_eq!(class.is_invalid(), truth == Truth::Invalid, "{truth:?}");
        let crossing = truth.crossing();
        assert_eq!(
            class.is_flat(),
            crossing.is_none() && !class.is_invalid(),
            "{truth:?}"
        );
        let is_back = crossing.is_some_and(|crossing| crossing.facing == Facing::Back);
        assert_eq!(class.is_back(), is_back, "{truth:?}");
        let is_off = crossing.is_some_and(|crossing| !is_in_extent(crossing, Extent::Interval));
        assert_eq!(class.is_off_the_interval(), is_off, "{truth:?}");
        assert_eq!(Class::try_from(u8::from(class)), Ok(class));
        if let Some(Crossing {
            feature,
            facing,
            place,
            ..
        }) = crossing
        {
            let part = feature.name().split('_').next().unwrap();
            let place = if is_off { place.name() } else { "within" };
            assert_eq!(class.name(), format!("{part}/{}/{place}", facing.name()));
        }
    }
}
