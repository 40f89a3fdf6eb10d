//! The signs of a guarded kernel decide: rays that pass all gates hit surely, and rays that a gate rejects miss surely.

use crate::tests::{FRONT, GUARDED, assert_each_is_refused, changed, refusal};

const GATE_B: &str = "gate b\nhit -39*62\nmiss +39*62\n";
const GATE_C: &str = "gate c\nhit +39*67\nmiss -39*67\n";
const GATE_A: &str = "gate a\nhit +39*69\nmiss -39*69\n";
const NEAR: &str = "gate near\nhit +39*46\nmiss -39*46\n";
const FAR: &str = "gate far\nhit +39*48\nmiss -39*48\n";

#[test]
fn rays_that_pass_all_gates_hit_surely() {
    const INSIDE: &str = "do not pass through the inside of the triangle";
    assert_each_is_refused(
        GUARDED,
        &[
            ("the weight of a is looked at", &[(GATE_A, "")], INSIDE),
            ("that of b", &[(GATE_B, "")], INSIDE),
            ("that of c", &[(GATE_C, "")], INSIDE),
            (
                "t_min is looked at",
                &[(NEAR, "")],
                "meet the triangle at t <= t_min",
            ),
            (
                "t_max is looked at",
                &[(FAR, "")],
                "meet the triangle at t >= t_max",
            ),
            (
                "every pattern of a gate",
                &[("hit +39*69", "hit +39*69\nhit -39*69")],
                INSIDE,
            ),
            (
                "every condition of a pattern",
                &[("hit +39*69", "hit +!39")],
                INSIDE,
            ),
            (
                "both ways of a choice",
                &[("gate near", "choice zero 0\nask\nfound\ngate near")],
                INSIDE,
            ),
            (
                "the first way too",
                &[("gate near", "choice zero 0\nfound\ngate near")],
                INSIDE,
            ),
            (
                "both ways of a sign",
                &[("gate near", "sign +39*69\nask\nfound\ngate near")],
                INSIDE,
            ),
            (
                "the sign of each way",
                &[(NEAR, "sign +39*46\nask\n")],
                "t <= t_min",
            ),
        ],
    );
    // Where the sign is sure, no gate needs it.
    let sure = changed(
        GUARDED,
        &[("found\nend", "found\nask\nend"), (NEAR, "sign +39*46\n")],
    );
    assert_eq!(refusal(&sure), None);
    assert_eq!(
        refusal(&changed(
            GUARDED,
            &[("gate near", "choice zero 0\nask\ngate near")]
        )),
        None
    );
    let ray = [
        ("guarded interval both", "guarded ray both"),
        (NEAR, "gate t\nhit +39*44\nmiss -39*44\n"),
        (FAR, ""),
    ];
    let ray = changed(GUARDED, &ray);
    let line = changed(
        GUARDED,
        &[("guarded interval", "guarded line"), (NEAR, ""), (FAR, "")],
    );
    let of_t = "gate t\nhit +39*44\nmiss -39*44\n";
    assert_each_is_refused(&ray, &[("t is looked at", &[(of_t, "")], "at t <= 0")]);
    // Where the front alone counts, the determinant has one sign, and both signs of t must be tried.
    let front = |certificate: &str, extent: &str| {
        let sides = [
            format!("guarded {extent} both"),
            format!("guarded {extent} front"),
        ];
        changed(
            certificate,
            &[(&sides[0], &sides[1]), ("hit +!39", "hit -39\nmiss +39")],
        )
    };
    assert_each_is_refused(
        &front(GUARDED, "interval"),
        &[
            (
                "t_min of a front",
                &[(NEAR, "")],
                "meet the triangle at t <= t_min",
            ),
            (
                "t_max of a front",
                &[(FAR, "")],
                "meet the triangle at t >= t_max",
            ),
        ],
    );
    assert_each_is_refused(
        &front(&ray, "ray"),
        &[("t of a front", &[(of_t, "")], "meet the triangle at t <= 0")],
    );
    assert_each_is_refused(
        &line,
        &[(
            "a front is one side",
            &[("line both", "line front")],
            "hit the back, and it promises the front only",
        )],
    );
    assert_each_is_refused(
        FRONT,
        &[(
            "it is the front",
            &[
                ("hit -39\nmiss +39", "hit +39\nmiss +39"),
                ("hit +62\nmiss -62", "hit -62"),
                ("hit -67\nmiss +67", "hit +67"),
                ("hit -69\nmiss +69", "hit +69"),
            ],
            "hit the back, and it promises the front only",
        )],
    );
}

#[test]
fn rays_that_a_gate_rejects_miss_surely() {
    let rejects = |gate: &str| format!("gate '{gate}' rejects rays that may hit");
    assert_each_is_refused(
        GUARDED,
        &[
            (
                "the weight of a",
                &[("miss -39*69", "miss +39*69")],
                &rejects("a"),
            ),
            ("of b", &[("miss +39*62", "miss -39*62")], &rejects("b")),
            ("of c", &[("miss -39*67", "miss +39*67")], &rejects("c")),
            (
                "t above t_min",
                &[("miss -39*46", "miss +39*46")],
                &rejects("near"),
            ),
            (
                "t below t_max",
                &[("miss -39*48", "miss +39*48")],
                &rejects("far"),
            ),
            (
                "both sides",
                &[("hit +!39", "hit +!39\nmiss -39")],
                &rejects("parallel"),
            ),
            (
                "every miss",
                &[("miss -39*69", "miss -39*69\nmiss +!39")],
                &rejects("a"),
            ),
            (
                "an edge",
                &[("miss -39*69", "miss +!39!62!67")],
                &rejects("a"),
            ),
        ],
    );
    let line = changed(
        GUARDED,
        &[("guarded interval", "guarded line"), (NEAR, ""), (FAR, "")],
    );
    let before = "gate t\nmiss -39*44\ngate a";
    assert_each_is_refused(
        &line,
        &[("all of a line", &[("gate a", before)], &rejects("t"))],
    );
    let ray = [
        ("guarded interval", "guarded ray"),
        (FAR, ""),
        (NEAR, "gate t\nhit +39*44\nmiss -39*44\n"),
    ];
    let ray = changed(GUARDED, &ray);
    let after = [("miss -39*44", "miss +39*44")];
    let far = "gate far\nmiss -39*48\ngate a";
    assert_each_is_refused(
        &ray,
        &[
            ("t above 0", &after, &rejects("t")),
            ("all of a ray", &[("gate a", far)], &rejects("far")),
        ],
    );
    assert_each_is_refused(
        FRONT,
        &[
            (
                "the front",
                &[("hit -39\nmiss +39", "hit -39\nmiss -39")],
                &rejects("parallel"),
            ),
            // Two axes exchanged turn every sign.
            (
                "under all names of axes",
                &[("axes yzx", "axes yxz")],
                &rejects("parallel"),
            ),
            (
                "under the first names too",
                &[("axes xyz", "axes yxz")],
                &rejects("parallel"),
            ),
        ],
    );
}
