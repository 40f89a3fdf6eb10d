//! Tests of tallies.

use super::*;
use crate::judge::GroupTruth;

#[test]
fn any_split_adds_up_to_the_same() {
    let class = Class::all().next().unwrap();
    let event = |tally: &mut Tally, index: u64| {
        tally.classes[class.number()].ask(Obligation::MustHit, 1);
        if index.is_multiple_of(3) {
            let place = CasePlace { index, triangle: 0 };
            let severity = Some(((index * 7 % 11) as f64, 2.0));
            tally.find(
                class,
                Finding::FalseMiss,
                (place, Digest::hash(place)),
                severity,
            );
        }
        let products = tally
            .products
            .entry((Some(class), Finding::FalseMiss))
            .or_default();
        products.add_ray(index % 4, 4);
        let (truth, hits) = (GroupTruth::Crossing, (index % 4) as usize);
        let group = JudgedGroup {
            index,
            truth,
            hits,
            elsewhere: index % 8 == 4,
        };
        let target = (index * 37 % 1000) as u32;
        let aimed = AimedRay {
            target,
            class: (index % 3) as usize,
        };
        tally.group(&group, Some(aimed), Across::ExactlyOne);
    };
    let mut whole = Tally::new([5, 0, 7]);
    (0..100).for_each(|index| event(&mut whole, index));
    for cut in [0, 1, 17, 50, 99] {
        let (mut left, mut right) = (Tally::new([5, 0, 7]), Tally::new([5, 0, 7]));
        (0..cut).for_each(|index| event(&mut left, index));
        (cut..100).for_each(|index| event(&mut right, index));
        let mut swapped = right.clone();
        swapped.merge(left.clone());
        left.merge(right);
        assert_eq!(left, whole);
        assert_eq!(swapped, whole);
    }
    let examples = &whole.examples.get(class, Finding::FalseMiss).unwrap();
    assert_eq!(examples.first.len(), 5);
    assert_eq!(examples.worst.unwrap().0, 10.0);
    assert_eq!(whole.severities[&Finding::FalseMiss].ulps.largest(), 20.0);
}
