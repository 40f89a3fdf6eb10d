//! Tests of choices of epsilons.

use super::*;

fn rows(names: &[&str], choice: EpsilonChoice) -> Result<Vec<Row>, Error> {
    let entries: Vec<_> = names.iter().map(|name| find(name).unwrap()).collect();
    choice.rows(&entries, None)
}

fn given(pairs: &[(&str, &str)]) -> EpsilonChoice {
    EpsilonChoice::Given(
        pairs
            .iter()
            .map(|(g, v)| ((*g).to_owned(), (*v).to_owned()))
            .collect(),
    )
}

#[test]
fn the_default_plan_has_two_rows_where_a_source_gives_no_value() {
    let all: Vec<_> = KERNELS.iter().collect();
    let rows = EpsilonChoice::Source.rows(&all, None).unwrap();
    let of = |name: &str| {
        rows.iter()
            .filter(|row| row.entry.info.name == name)
            .count()
    };
    assert_eq!((of("plane-unit-normal"), of("moller-trumbore")), (2, 1));
}

#[test]
fn epsilons_go_to_the_gates_that_have_them() {
    let rows = rows(
        &["moller-trumbore", "half-space"],
        given(&[("parallel", "1e-9")]),
    )
    .unwrap();
    assert_eq!(rows[0].epsilons::<f32>(), [1e-9, 0.0]);
    assert_eq!(rows[0].set, "parallel=1e-9");
    assert_eq!(rows[1].set, "source");
}

#[test]
fn bad_epsilons_are_refused_with_a_reason() {
    let message = |names: &[&str], pairs: &[(&str, &str)]| {
        rows(names, given(pairs)).err().unwrap().to_string()
    };
    assert!(
        message(&["moller-trumbore"], &[("paralel", "0")]).contains("did you mean 'parallel'?")
    );
    assert!(message(&["moller-trumbore"], &[("parallel", "-1e-6")]).contains("means nothing"));
    assert!(message(&["moller-trumbore"], &[("edge", "small")]).contains("is not an epsilon"));
    assert!(message(&["moller-trumbore"], &[("edge", "1e309")]).contains("is not an epsilon"));
    assert!(message(&["havel-herout"], &[("u", "0")]).contains("takes no epsilon"));
    assert!(
        message(&["moller-trumbore"], &[("edge", "nan*EPSILON")]).contains("is not an epsilon")
    );
    // A kernel that cannot take a value does not keep the others from taking it.
    let rows = rows(&["havel-herout", "cramer"], given(&[("t", "1e-6")])).unwrap();
    assert_eq!(
        (rows[0].set.as_str(), rows[1].set.as_str()),
        ("source", "t=1e-6")
    );
}

#[test]
fn an_epsilon_that_a_scalar_has_not_is_refused_there() {
    let row = |text: &str| rows(&["moller-trumbore"], given(&[("parallel", text)])).unwrap();
    let in_f32 = |text: &str| row(text)[0].check::<f32>().map_err(String::from);
    assert!(
        in_f32("1e39")
            .unwrap_err()
            .contains("1e39 is beyond the range of f32")
    );
    assert!(in_f32("1e-60").unwrap_err().contains("1e-60 is 0 in f32"));
    for fine in ["0", "0.0e5", "1e-45", "3e38", "EPSILON"] {
        assert_eq!(in_f32(fine), Ok(()), "{fine}");
    }
    assert_eq!(row("1e-60")[0].check::<f64>(), Ok(()));
    assert!(row("1e-400")[0].check::<f64>().is_err());
}

#[test]
fn presets_go_only_where_the_dimension_is_the_same() {
    let truck = || EpsilonChoice::Preset("truck".to_owned());
    let taken = rows(&["moller-trumbore", "cramer", "woop-watertight"], truck()).unwrap();
    assert_eq!(taken.len(), 2, "woop's determinant has another dimension");
    let bvh = || EpsilonChoice::Preset("bvh".to_owned());
    let taken = rows(&["cramer"], bvh()).unwrap();
    assert_eq!(
        taken[0].epsilons::<f32>(),
        [f32::EPSILON, f32::EPSILON, 0.0]
    );
    let bullet = EpsilonChoice::Preset("bullet".to_owned());
    let error = rows(&["moller-trumbore"], bullet)
        .err()
        .unwrap()
        .to_string();
    assert!(
        error.contains("no gate of moller-trumbore is a 'edge-over-n2'"),
        "{error}"
    );
}

#[test]
fn a_preset_is_taken_whole_or_not_at_all() {
    let godot = || EpsilonChoice::Preset("godot".to_owned());
    let error = rows(&["moller-trumbore"], godot())
        .err()
        .unwrap()
        .to_string();
    assert_eq!(
        error,
        "preset 'godot' refuses where !(t > e), and no gate of moller-trumbore is a 't' of that dimension; it \
         fits cramer, plane-inside-out, plane-inside-out-precomputed, plane-inside-out-strict, convex-polygon, \
         moller-trumbore-t"
    );
    // Among several kernels one that does not take it is left out.
    let taken = rows(&["moller-trumbore", "moller-trumbore-t"], godot()).unwrap();
    let [row] = &taken[..] else {
        panic!("{} rows", taken.len())
    };
    assert_eq!(
        (row.entry.info.name, &*row.set),
        ("moller-trumbore-t", "godot: parallel+t")
    );
    assert_eq!(row.epsilons::<f64>(), [1e-5, 0.0, 1e-5]);
}

#[test]
fn a_command_names_all_that_a_row_is() {
    let contract = "closed-ray,coplanar=free";
    let mut row = Row::named("moller-trumbore", Some("parallel=1e-6"), contract).unwrap();
    let command = row.explain_command("'x'");
    let expected = "hairline explain 'x' --kernel moller-trumbore \
                    --epsilon 'parallel=1e-6,edge=0' --contract closed-ray,coplanar=free";
    assert_eq!(command, expected);
    row.contract.band = "4ulps".parse().ok();
    assert_eq!(
        row.explain_command("'x'"),
        format!("{expected} --band 4ulps")
    );
}

#[test]
fn a_row_comes_back_from_its_text() {
    for (kernel, epsilons, contract) in [
        ("moller-trumbore", None, "own"),
        (
            "moller-trumbore+fma",
            Some("parallel=16*EPSILON,edge=-1e-7"),
            "own,band=4ulps",
        ),
        (
            "half-space",
            None,
            "front-closed-ray,invalid=free,band=1e-3",
        ),
    ] {
        let row = Row::named(kernel, epsilons, contract).unwrap();
        let text = serde_json::to_string(&row.spec()).unwrap();
        let again = serde_json::from_str::<RowSpec>(&text)
            .unwrap()
            .row()
            .unwrap();
        assert_eq!(again.spec(), row.spec());
        assert_eq!(
            (again.epsilons, again.contract),
            (row.epsilons, row.contract),
            "{text}"
        );
    }
    let unknown = RowSpec {
        kernel: "x".into(),
        set: None,
        epsilons: None,
        contract: "own".into(),
    };
    assert!(
        unknown
            .row()
            .err()
            .unwrap()
            .to_string()
            .starts_with("unknown kernel 'x': one of your own")
    );
}
