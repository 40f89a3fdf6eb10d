//! The words of scenes, and what is wrong with them.

use super::*;

#[test]
fn scenes_survive_their_text() {
    for text in [
        "extent=1000,edge=0.01..10,distance=0..2000,direction=unit",
        "extent=1e-7,edge=1e-9,distance=5e-9..1e-8,direction=target",
        "extent=10,center=-100000,edge=1,distance=0..4,direction=unit",
        "extent=1,edge=1,distance=0..4,direction=unit,sine=1e-8..0.01",
        "extent=1,edge=1,distance=0..4,direction=unit,aim=inside",
        "extent=100,edge=0.05..0.1..20,distance=0..4,direction=unit,ray=generated,plane=axis-near-0",
        "extent=1,edge=1,distance=0..4,direction=unit,toward=axis-plane",
    ] {
        assert_eq!(Scene::parse(text).unwrap().0.to_string(), text);
    }
    let (city, unit) = Scene::parse("city").unwrap();
    assert_eq!(
        Scene::parse("extent=1000, edge=0.01..10, distance=0..2000")
            .unwrap()
            .0,
        city
    );
    assert_eq!(unit, "m");
    // What is not given grows with the extent.
    for text in [
        "extent=1000",
        "distance=0..4000, extent = 1000, edge=100..1000",
    ] {
        let grown = "extent=1000,edge=100..1000,distance=0..4000,direction=unit";
        assert_eq!(Scene::parse(text).unwrap().0.to_string(), grown);
    }
    for (text, left) in [
        ("extent=10", Some("edge=1..10 and distance=0..40")),
        ("extent=10, edge=1", Some("distance=0..40")),
        ("extent=10,distance=3,edge=1", None),
        ("room,extent=10", None),
    ] {
        let (scene, _) = Scene::parse(text).unwrap();
        assert_eq!(scene.left_out(text).as_deref(), left, "{text}");
    }
    let (near, unit) = Scene::parse("city, distance = 0..20").unwrap();
    assert_eq!(
        (near.distance, near.extent, unit),
        ([0.0, 20.0], 1000.0, "m")
    );
}

#[test]
fn bad_scenes_say_what_was_expected() {
    for (text, part) in [
        ("", "nothing stands before or after a comma"),
        ("room,", "nothing stands before or after a comma"),
        ("edge=1...2", "two dots, as 0.5..2"),
        ("palace", "begin with one of unit, room, city, cad-mm"),
        ("size=3", "unknown word 'size'"),
        ("extent=nan", "'nan' is not a finite number"),
        ("extent=inf", "not a finite number"),
        ("extent=0", "extent=0: must be above 0"),
        ("extent=-1", "must be above 0"),
        ("center=nan", "not a finite number"),
        ("edge=0..1", "edge=0..1: must be above 0"),
        ("edge=1..", "edge=1..: write both ends"),
        ("edge=0.5..0.25", "the range is empty"),
        ("edge=0.1..0.05..1", "the one that half are below"),
        ("edge=0.1..0.2..0.3..1", "two numbers or three"),
        ("edge=0.1....1", "two numbers or three"),
        ("ray=cast", "there are stored, generated"),
        ("plane=flat", "there are generic, axis"),
        ("toward=up", "there are any, axis-plane, axis"),
        (
            "extent=2,center=1,edge=1,plane=axis-0",
            "at coordinate 0, not around center=1",
        ),
        ("edge=0.5..2", "the longest edge is at most the extent, 1"),
        ("distance=0", "not 0 alone"),
        ("distance=-1..2", "from 0 up"),
        ("direction=long", "direction=unit, target or mixed"),
        ("sine=0..1", "sines of angles are from 1e-30 to 1"),
        ("sine=0.5..2", "to 1"),
        ("aim=up", "write aim=inside or both"),
        ("sine=flat", "'flat' is not a finite number"),
        (
            "extent=4km",
            "'4km' is not a finite number: write all lengths in one unit",
        ),
        ("Room", "'Room' is no scene; did you mean 'room'?"),
        (
            "edge=1,room",
            "'room' is a preset: it comes first, and there is one at most",
        ),
        ("extent=1,extent=2", "'extent' is given twice"),
    ] {
        let error = Scene::parse(text).unwrap_err();
        assert!(
            error.contains(part) && !error.contains('\n'),
            "{text}: {error}"
        );
    }
}

#[test]
fn a_scalar_refuses_what_it_cannot_hold() {
    let refused = |text: &str| {
        let (scene, _) = Scene::parse(text).unwrap();
        [scene.check_in::<f32>(), scene.check_in::<f64>()].map(|held| held.err())
    };
    for preset in SCENES {
        assert_eq!(refused(preset.name), [None, None], "{}", preset.name);
    }
    let [f32, f64] = refused("extent=1e6,edge=0.1..1,distance=0..10");
    assert!(f32.unwrap().contains("collapse at coordinates of 1000000") && f64.is_none());
    let [f32, f64] = refused("extent=10,center=-1e6,edge=0.1..1,distance=0..10");
    assert!(f32.unwrap().contains("collapse at coordinates of 1000010") && f64.is_none());
    let [f32, f64] = refused("extent=1e-17,edge=1e-18..1e-17,distance=0..1e-17");
    assert!(f32.unwrap().contains("underflow in f32") && f64.is_none());
    let [f32, f64] = refused("extent=1e14,edge=1e13,distance=0..1e14");
    assert!(f32.unwrap().contains("overflow in f32") && f64.is_none());
    let [_, f64] = refused("extent=1e-150,edge=1e-151..1e-150,distance=0..1e-150");
    assert!(f64.unwrap().contains("underflow in f64"));
    let [_, f64] = refused("extent=1e300,edge=1e299,distance=0..1e300");
    assert!(f64.unwrap().contains("overflow in f64"));
}

#[test]
fn every_kind_of_planes_and_rays_is_found_by_its_name() {
    for plane in PlaneKind::ALL {
        for toward in Toward::ALL {
            let kind = SceneKind { plane, toward };
            assert_eq!(SceneKind::named(&kind.to_string()), Some(kind));
        }
    }
    assert_eq!(SceneKind::named("model.obj"), None);
    assert!(
        SceneKind::ALL
            .iter()
            .all(|kind| SceneKind::named(&kind.to_string()) == Some(*kind))
    );
}
