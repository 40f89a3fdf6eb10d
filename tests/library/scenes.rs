//! Scenes: the strata keep their promises in every scene, and cases have the sizes that their scene says.

use hairline::Truth;
use hairline::internals::arith::Float;
use hairline::internals::audit::{EpsilonChoice, Row, Unobserved};
use hairline::internals::case::{Case, Parameters, SCENES, Scene};
use hairline::internals::epsilon::{
    Attempt, Costs, Knob, KnobLimit, MaxError, Pass, ProvedValue, RayCount, Rays, Setting,
    WrongKind, cheapest, contract_with, count_at, counts, limits, proved,
};
use hairline::internals::family::{MeshFamily, Stratum};
use hairline::internals::files::mesh;
use hairline::internals::judge::{
    GroupTruth, Obligation, asked, group_obligation, may_be_elsewhere,
};
use hairline::internals::kernel::{KERNELS, Scalar, Verdict, find};
use hairline::internals::mesh::{SceneMesh, Surface};
use hairline::internals::oracle;
use std::collections::BTreeSet;
use std::sync::Arc;

fn scenes() -> Vec<Scene> {
    let presets = SCENES.iter().map(|preset| preset.scene.clone());
    let further = [
        // Triangles of 32 spacings of f32, a scene of a nanometre, directions to the target.
        "extent=1000,edge=0.002..0.004,distance=0..2000",
        "extent=1e-9,edge=1e-11..1e-9,distance=1e-10..1e-9",
        "extent=5,edge=5,distance=3,direction=target",
        "room,direction=target",
        "extent=10,center=-1000,edge=0.5..1,distance=0..20",
        "city,direction=target,edge=0.01",
    ];
    presets
        .chain(further.map(|text| Scene::parse(text).unwrap().0))
        .collect()
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn check<F: Scalar>(stratum: Stratum, scene: &Scene) {
    if scene.check_in::<F>().is_err() {
        return;
    }
    let parameters = Parameters {
        scene: Some(scene.clone()),
        ..Parameters::default()
    };
    let family = stratum.family();
    let spacing = F::from_f64(scene.largest()).ulp().to_f64();
    let (mut hits, mut misses) = (0, 0);
    for index in 0..500 {
        let id = family.id::<F>(&parameters, 3, index).to_string();
        let made = family.make::<F>(&parameters, 3, index);
        let truths: Vec<Truth> = made.cases().iter().map(oracle::truth).collect();
        assert!(family.keeps(&truths), "{id}: {truths:?}");
        for (case, truth) in made.cases().iter().zip(&truths) {
            if index < 40 {
                assert_eq!(*truth, oracle::define(case).truth, "{id}");
            }
            *(if truth.hits_closed() == Some(true) {
                &mut hits
            } else {
                &mut misses
            }) += 1;
            sizes::<F>(stratum, scene, case, spacing, &id);
        }
    }
    let share = f64::from(hits) / f64::from(hits + misses);
    let expected = match stratum {
        // Triangles of 32 spacings are moved by some of them.
        Stratum::Interior => 0.75..=1.0,
        // About half of the rays at an edge or a vertex are on each side of it.
        Stratum::Edges => 0.3..=0.9,
        // Exactly at the vertex all six are hit.
        Stratum::Vertices => 0.1..=1.0,
        Stratum::Grazing => 0.02..=0.7,
        // Small distances from the plane round to none.
        Stratum::Parallel => 0.0..=0.6,
        Stratum::Shadow | Stratum::Segment => 0.2..=0.8,
        Stratum::Outside => 0.0..=0.2,
    };
    println!("{:?} {} {scene}: {share}", stratum, F::NAME);
    assert!(
        expected.contains(&share),
        "{stratum:?} {scene} {}: {share}",
        F::NAME
    );
}

fn sizes<F: Float>(stratum: Stratum, scene: &Scene, case: &Case<F>, spacing: f64, id: &str) {
    let [_, d, a, b, c] = case.widen().vectors();
    let corners = [a, b, c].into_iter().flatten();
    let most = corners.fold(0.0f64, |most, x| most.max(x.abs()));
    assert!(
        most <= scene.largest() + 4.0 * scene.edge[1].min(scene.extent),
        "{id}: {most}"
    );
    let edges = [minus(a, b), minus(b, c), minus(c, a)];
    let longest = edges.map(length).into_iter().fold(0.0, f64::max);
    // Where the direction is a sum of edges, both are made on a grid of 8 spacings; fans have edges of
    // their own.
    let target = scene.to_string().ends_with("target");
    let (low, high) = match stratum {
        Stratum::Parallel if target => (scene.edge[0] / 4.0, scene.edge[1] + 64.0 * spacing),
        Stratum::Parallel => (scene.edge[0] / 2.0, scene.edge[1]),
        Stratum::Vertices => (scene.edge[0] / 3.0, 1.2 * scene.edge[1]),
        _ => (scene.edge[0], scene.edge[1]),
    };
    let slack = 4.0 * spacing;
    assert!(
        (low - slack..=high + slack).contains(&longest),
        "{id}: an edge of {longest}"
    );
    if !target {
        let [[x, y, z], [p, q, r], _] = edges;
        let area = length([y * r - z * q, z * p - x * r, x * q - y * p]);
        assert!(
            0.1 * longest * longest - slack * longest <= area,
            "{id}: twice an area of {area}"
        );
        assert!(
            (length(d) - 1.0).abs() < 2.0 * F::EPSILON.to_f64(),
            "{id}: |d| = {}",
            length(d)
        );
    }
}

#[test]
fn strata_keep_their_promises_in_every_scene() {
    for scene in scenes() {
        for stratum in Stratum::ALL {
            check::<f32>(stratum, &scene);
            check::<f64>(stratum, &scene);
        }
    }
}

#[test]
fn shadow_rays_start_at_the_hit_points_of_the_kernel_that_is_named() {
    let of = |kernel: Option<&str>| {
        let parameters = Parameters {
            kernel: kernel.map(str::to_owned),
            ..Parameters::default()
        };
        let made = |i| {
            Stratum::Shadow
                .family()
                .make::<f32>(&parameters, 1, i)
                .cases()[0]
                .hex()
        };
        (0..200).map(made).collect::<Vec<String>>()
    };
    assert_eq!(of(None), of(Some("moller-trumbore")));
    let same = of(None)
        .iter()
        .zip(of(Some("woop-watertight")))
        .filter(|(a, b)| *a == b)
        .count();
    assert!((10..190).contains(&same), "{same} of 200");
}

/// A kernel's row in a scene, its knobs and what is counted.
fn tuned(kernel: &str) -> (Row, Vec<Knob>, Vec<RayCount>) {
    let row = EpsilonChoice::Source
        .rows(&[find(kernel).unwrap()], None)
        .unwrap()
        .remove(0);
    let knobs = Knob::all(&row);
    let row = Row {
        contract: contract_with(&knobs, &row.contract),
        ..row
    };
    let counts = counts(&knobs, &row.contract);
    (row, knobs, counts)
}

fn setting<'a>(
    row: &'a Row,
    knobs: &'a [Knob],
    counts: &'a [RayCount],
    scene: &'a Scene,
) -> Setting<'a, f32> {
    let subject = f32::subject(row.entry).unwrap();
    Setting {
        row,
        subject,
        knobs,
        counts,
        scene: Some(scene),
        sources: &[],
        mesh: None,
        relative: false,
        fine_curves: false,
        store: None,
        shared: None,
    }
}

/// A case or group, and which of the counts it is for.
struct Counted {
    count: usize,
    cases: Vec<Case<f32>>,
    /// Those of the triangles around a group.
    around: Vec<Case<f32>>,
}

/// Everything that is counted, straight from the generators, the oracle and the judge.
fn all_counted(setting: &Setting<'_, f32>, seed: u64, number: u64) -> Vec<Counted> {
    let contract = &setting.row.contract;
    let mut all = Vec::new();
    for (count, RayCount { rays, kind }) in setting.counts.iter().enumerate() {
        let Rays::Stratum(stratum) = *rays else {
            panic!("{rays:?} in a scene")
        };
        let family = stratum.family();
        let source = setting.source(stratum, seed, number);
        for index in 0..source.count::<f32>() {
            let made = source.make::<f32>(index);
            let cases = made.cases().to_vec();
            let truths: Vec<Truth> = cases.iter().map(oracle::truth).collect();
            let is_counted = match kind {
                WrongKind::SelfHit => true,
                WrongKind::Crack => {
                    let owed = group_obligation(&cases, &truths, contract, family.grouping);
                    owed == GroupTruth::Crossing
                }
                WrongKind::Miss => {
                    asked(&cases[0], &truths[0], contract, false) == Obligation::MustHit
                }
                WrongKind::Hit => {
                    asked(&cases[0], &truths[0], contract, false) == Obligation::MustMiss
                }
            };
            if is_counted {
                let mut around = Vec::new();
                if *kind == WrongKind::Crack {
                    assert!(source.add_neighbours(index, &cases, &mut around));
                }
                all.push(Counted {
                    count,
                    cases,
                    around,
                });
            }
        }
    }
    all
}

/// The shares of wrong answers of a kernel that is run with some epsilons.
fn shares(setting: &Setting<'_, f32>, all: &[Counted], epsilons: &[f32]) -> Vec<f64> {
    let mut of_gates = setting.row.epsilons::<f32>();
    let mut least_t = f32::NEG_INFINITY;
    for (knob, epsilon) in setting.knobs.iter().zip(epsilons) {
        match knob {
            Knob::Gate(gate) => of_gates[*gate] = *epsilon,
            Knob::LeastT => least_t = *epsilon,
        }
    }
    let kernel = f32::subject(setting.row.entry).unwrap();
    let (mut wrong, mut of) = (vec![0; setting.counts.len()], vec![0; setting.counts.len()]);
    let mut verdicts = [Verdict::miss(None); 8];
    let has_least_t = least_t != f32::NEG_INFINITY;
    let is_kept = |v: &Verdict<f32>| v.hit && (!has_least_t || least_t <= v.t);
    for Counted {
        count,
        cases,
        around,
    } in all
    {
        let verdicts = &mut verdicts[..cases.len()];
        kernel.run(cases, &of_gates, verdicts);
        let mut hit = verdicts.iter().any(is_kept);
        if !hit && !around.is_empty() {
            let mut verdicts = vec![Verdict::miss(None); around.len()];
            kernel.run(around, &of_gates, &mut verdicts);
            verdicts
                .iter_mut()
                .for_each(|verdict| verdict.hit = is_kept(verdict));
            let truths: Vec<Truth> = around.iter().map(oracle::truth).collect();
            let first = oracle::truth(&cases[0]);
            let facing = first.crossing().unwrap().facing;
            let contract = &setting.row.contract;
            hit = may_be_elsewhere(facing, around, &truths, &verdicts, contract);
        }
        of[*count] += 1;
        wrong[*count] += u64::from(
            hit != matches!(
                setting.counts[*count].kind,
                WrongKind::Crack | WrongKind::Miss
            ),
        );
    }
    wrong
        .iter()
        .zip(of)
        .map(|(wrong, of)| *wrong as f64 / f64::from(of.max(1)))
        .collect()
}

#[test]
fn no_point_of_a_small_grid_is_cheaper_than_the_recommended_one() {
    let (scene, _) = Scene::parse("room").unwrap();
    let (number, seed) = (400, 5);
    let values: [&[f32]; 3] = [
        &[0.0, 1e-12, 1e-9, 1e-8, 1e-6, 1e-4],
        &[-1e-2, -1e-3, -1e-5, -1e-7, 0.0, 1e-6],
        &[0.0, 1e-5, 1e-4, 1e-3, 1e-2],
    ];
    for kernel in [
        "moller-trumbore",
        "plane-unit-normal",
        "woop-watertight",
        "plucker",
    ] {
        let (row, knobs, counts) = tuned(kernel);
        let setting = setting(&row, &knobs, &counts, &scene);
        let all = all_counted(&setting, seed, number);
        for costs in ["crack=10", "crack=1,self-hit=30", "miss=0.01,hit=5"] {
            let costs = Costs::parse(costs).unwrap();
            let best =
                cheapest(&setting, &costs, None, Pass::new(seed, number, &Unobserved)).unwrap();
            let cost = |epsilons: &[f32]| costs.total(&counts, shares(&setting, &all, epsilons));
            let least = cost(&best);
            let gates = row.entry.info.gates;
            let of = |knob: &Knob| match knob.gate(gates).role.name() {
                "parallel" => values[0],
                "t" => values[2],
                _ => values[1],
            };
            let axes: Vec<&[f32]> = knobs.iter().map(of).collect();
            for i in 0..axes.iter().map(|axis| axis.len()).product() {
                let mut rest = i;
                let point: Vec<f32> = axes
                    .iter()
                    .map(|axis| {
                        let value = axis[rest % axis.len()];
                        rest /= axis.len();
                        value
                    })
                    .collect();
                let found = cost(&point);
                // A knob is left at 0 if that costs at most a hundredth more.
                assert!(
                    least <= 1.01 * found + 1e-9,
                    "{kernel}: {best:?} {least}, {point:?} {found}"
                );
            }
            // And the counts by margins are those of the run.
            let wrong = count_at(
                &setting,
                &[Attempt::new(best.clone())],
                Pass::new(seed, number, &Unobserved),
            )
            .remove(0);
            let counted: Vec<f64> = wrong.iter().map(|w| w.share().unwrap_or(0.0)).collect();
            assert_eq!(counted, shares(&setting, &all, &best), "{kernel} {best:?}");
        }
    }
}

#[test]
fn limits_are_violated_no_more_often_than_stated() {
    for (kernel, scene, epsilons, many) in [
        ("moller-trumbore", "room", [1e-9f32, -1e-4, 1e-4], 40_000),
        ("plane-unit-normal", "city", [1e-7, 0.05, -1e-3], 10_000),
        ("woop-watertight", "unit", [-1e-7, 1e-9, 5e-5], 10_000),
    ] {
        check_limits(kernel, scene, &epsilons, many);
    }
}

fn check_limits(kernel: &str, scene: &str, epsilons: &[f32; 3], many: u64) {
    let (scene, _) = Scene::parse(scene).unwrap();
    let (row, knobs, counts) = tuned(kernel);
    let setting = setting(&row, &knobs, &counts, &scene);
    let (number, runs) = (400, 100);
    let found: Vec<_> = (1..=runs)
        .map(|seed| limits(&setting, epsilons, Pass::new(seed, number, &Unobserved)))
        .collect();
    let attempts: Vec<Attempt<f32>> = found
        .iter()
        .flatten()
        .filter_map(|l| Attempt::at_limit(l, epsilons))
        .collect();
    let mut wrong =
        count_at(&setting, &attempts, Pass::new(1 << 40, many, &Unobserved)).into_iter();
    let mut violated = std::collections::BTreeMap::<(usize, usize), u32>::new();
    for limit in found.iter().flatten().filter(|limit| limit.value.is_some()) {
        let share = wrong.next().unwrap()[limit.count].share().unwrap();
        let stated = 1.0 / limit.one_in as f64;
        // The share itself is a sample.
        let noise = 3.0 * (stated / many as f64).sqrt();
        *violated.entry((limit.knob, limit.count)).or_default() +=
            u32::from(stated + noise < share);
    }
    // Of 100 seeds, 5 are expected at most; 12 or more happen once in 250 times then.
    assert!(
        violated.len() >= 5 && violated.values().all(|n| *n < 12),
        "{kernel} {violated:?}"
    );
}

/// t of a hit of a kernel on a case, and how far it is off: in `f64`, of which `f32` needs half the digits.
fn error_of_t(kernel: &str, epsilons: &[f32], case: &Case<f32>) -> Option<f64> {
    let mut verdicts = [Verdict::miss(None)];
    f32::subject(find(kernel).unwrap())
        .unwrap()
        .run(&[*case], epsilons, &mut verdicts);
    let [o, d, a, b, c] = case.widen().vectors();
    let (e, f) = (minus(b, a), minus(c, a));
    let n = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        e[j] * f[k] - e[k] * f[j]
    });
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let exact = dot(n, minus(a, o)) / dot(n, d);
    verdicts[0]
        .hit
        .then(|| (f64::from(verdicts[0].t) - exact).abs() / exact.abs())
}

#[test]
fn errors_above_the_limit_are_no_more_frequent_than_stated() {
    let (scene, _) = Scene::parse("room").unwrap();
    let kernel = "moller-trumbore";
    let (row, _, _) = tuned(kernel);
    let knobs = [Knob::Gate(0)];
    let counts = [WrongKind::Miss, WrongKind::Hit].map(|kind| RayCount {
        rays: Rays::Stratum(Stratum::Grazing),
        kind,
    });
    let setting = setting(&row, &knobs, &counts, &scene);
    let most = 0.02;
    let max_error = MaxError::parse(&format!("t={most}")).unwrap();
    let (number, many, runs) = (8_000, 20_000, 100);
    let source = setting.source(Stratum::Grazing, 1 << 40, many);
    let cases: Vec<Case<f32>> = (0..many)
        .map(|index| source.make::<f32>(index).cases()[0])
        .filter(|case| {
            asked(case, &oracle::truth(case), &row.contract, false) == Obligation::MustHit
        })
        .collect();
    let mut gates = row.epsilons::<f32>();
    // By epsilon: the share of larger errors among the hits that remain.
    let mut known = std::collections::BTreeMap::<u32, f64>::new();
    let costs = Costs::default();
    let (mut violated, mut claims) = (0, 0);
    for seed in 1..=runs {
        let best = cheapest(
            &setting,
            &costs,
            Some(&max_error),
            Pass::new(seed, number, &Unobserved),
        );
        // A sample may be too small to show it anywhere; then nothing is claimed.
        let Some(epsilon) = best.map(|best| best[0]) else {
            continue;
        };
        claims += 1;
        let share = *known.entry(epsilon.to_bits()).or_insert_with(|| {
            gates[0] = epsilon;
            let errors: Vec<f64> = cases
                .iter()
                .filter_map(|case| error_of_t(kernel, &gates, case))
                .collect();
            let larger = errors.iter().filter(|error| most < **error).count();
            // The share itself is a sample.
            let share = larger as f64 / errors.len() as f64;
            share - 2.0 * (share / errors.len() as f64).sqrt()
        });
        violated += u32::from(0.01 < share);
    }
    // The cheapest epsilon without a limit is another one, with larger errors.
    gates[0] = cheapest(&setting, &costs, None, Pass::new(1, number, &Unobserved)).unwrap()[0];
    let free: Vec<f64> = cases
        .iter()
        .filter_map(|case| error_of_t(kernel, &gates, case))
        .collect();
    let larger = free.iter().filter(|error| most < **error).count();
    assert!(free.len() < 50 * larger, "{larger} of {}", free.len());
    // Of 100 seeds, 5 are expected at most; 12 or more happen once in 250 times then.
    assert!(
        violated < 12 && 95 < claims,
        "{violated} of {claims}: {known:?}"
    );
    let none = MaxError::parse("t=1e-12").unwrap();
    assert_eq!(
        cheapest(
            &setting,
            &costs,
            Some(&none),
            Pass::new(1, number, &Unobserved)
        ),
        None
    );
}

#[test]
fn proved_values_are_beyond_the_limits_that_rays_show_and_no_ray_contradicts_them() {
    let mut proofs = 0;
    for preset in SCENES {
        for entry in KERNELS.iter().filter(|entry| entry.scalars()[0]) {
            let (row, knobs, counts) = tuned(entry.info.name);
            let setting = setting(&row, &knobs, &counts, &preset.scene);
            let proved = proved(&setting);
            let zero = vec![0.0; knobs.len()];
            let seen = if proved.is_empty() {
                vec![]
            } else {
                limits(&setting, &zero, Pass::new(7, 2000, &Unobserved))
            };
            for ProvedValue {
                knob,
                count,
                is_lower,
                value,
            } in proved
            {
                let name = format!(
                    "{} {} {:?} {value:e}",
                    preset.name, entry.info.name, counts[count]
                );
                let at = Some(value);
                let limit = KnobLimit {
                    knob,
                    count,
                    is_lower,
                    value: at,
                    far: None,
                    one_in: 1,
                };
                let attempt = [Attempt::at_limit(&limit, &zero).unwrap()];
                let wrong =
                    count_at(&setting, &attempt, Pass::new(11, 4000, &Unobserved)).remove(0)[count];
                assert_eq!(wrong.count, 0, "{name}");
                assert!(0 < wrong.of, "{name}");
                let same = |other: &&KnobLimit<f32>| other.knob == knob && other.count == count;
                if let Some(seen) = seen.iter().find(same).and_then(|limit| limit.value) {
                    assert!(
                        if is_lower {
                            seen <= value
                        } else {
                            value <= seen
                        },
                        "{name}: {seen:e}"
                    );
                }
                proofs += 1;
            }
        }
    }
    assert!(20 < proofs, "{proofs}");
}

/// FNV-1a over the bits of a stratum's first cases in the scene `city`.
fn digest<F: Scalar>(stratum: Stratum) -> u64 {
    let (city, _) = Scene::parse("city").unwrap();
    let parameters = Parameters {
        scene: Some(city),
        ..Parameters::default()
    };
    let cases = (0..300).map(|i| stratum.family().make::<F>(&parameters, 1, i));
    let bits = cases
        .flat_map(|made| made.cases().to_vec())
        .flat_map(|case| case.bits());
    bits.fold(0xcbf2_9ce4_8422_2325, |hash, bits| {
        (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// Case ids must make the same cases everywhere: a change here needs a new version of the stratum.
#[test]
fn cases_are_the_same_on_every_machine() {
    let found = Stratum::ALL.map(|stratum| [digest::<f32>(stratum), digest::<f64>(stratum)]);
    let pinned = [
        [18220451513381649495, 15788289487224457115],
        [1048511107724483337, 15772291362880847381],
        [1840260932182949327, 9453073006559614775],
        [2526995784592904596, 9039085253003666718],
        [17009795235220384855, 8630289535108491134],
        [8360894271225813315, 2046316959174811182],
        [6225250750103278271, 7090790742106470397],
        [13003427174133859023, 3720205830954302756],
    ];
    assert_eq!(found, pinned, "{found:#018x?}");
}

/// A box whose faces are cut into triangles, and a tetrahedron with bent edges beside it.
const MESH: &str = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nv -2 -1 3\nv 2 -1 3\nv 2 1 3\nv -2 1 3\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n\
    v 5.1 0.3 0.7\nv 6.4 0.2 0.9\nv 5.7 1.3 0.4\nv 5.8 0.6 1.9\n\
    f 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\nv 7 7 7\nf 9 9 13\n";

/// A triangle's vertices in their order.
fn bits<F: Float>(corners: [[F; 3]; 3]) -> [[u64; 3]; 3] {
    corners.map(|corner| corner.map(F::to_bits))
}

fn check_mesh<F: Scalar>(direction: &str) {
    let mut beside = |_: &str, _| Err(std::io::ErrorKind::NotFound.into());
    let mesh = mesh::read(MESH.as_bytes(), "box.obj", &mut beside, &mut |_| {}).unwrap();
    let faces: BTreeSet<_> = (0..mesh.triangles.len())
        .map(|face| bits(mesh.vertices::<F>(face)))
        .collect();
    let surface = Surface::new(Arc::new(MeshFamily::new(mesh, "box.obj")), [true, true]);
    let mesh = SceneMesh::new(surface);
    // The last face has no area.
    assert_eq!((mesh.face_count::<F>(), faces.len()), (16, 17));
    let scene = mesh.scene().of_mesh(direction).unwrap();
    let parameters = Parameters {
        scene: Some(scene.clone()),
        ..Parameters::default()
    };
    for stratum in Stratum::ALL {
        let family = stratum.family();
        let (mut seen, mut kept, mut hits, mut owed_something) = (BTreeSet::new(), 0, 0, 0);
        for index in 0..600 {
            let made = mesh.make::<F>(stratum, &parameters, 3, index);
            let truths: Vec<Truth> = made.cases().iter().map(oracle::truth).collect();
            kept += u32::from(family.keeps(&truths));
            hits += u32::from(truths.iter().any(|truth| truth.hits_closed() == Some(true)));
            for case in made.cases() {
                let [o, _, a, b, c] = case.vectors();
                let corners = bits([a, b, c]);
                assert!(
                    faces.contains(&corners),
                    "{stratum:?} {index}: not as in the file"
                );
                seen.insert(corners);
                let reach = length(minus(o.map(F::to_f64), a.map(F::to_f64)));
                assert!(reach <= scene.distance[1] + 4.0 * scene.edge[1], "{reach}");
            }
            if stratum == Stratum::Edges {
                let [one, other] = made.cases() else {
                    panic!("two triangles")
                };
                let ends = |case: &Case<F>| -> BTreeSet<_> {
                    let [.., a, b, c] = case.vectors();
                    [a, b, c].map(|corner| corner.map(F::to_bits)).into()
                };
                assert_eq!(ends(one).intersection(&ends(other)).count(), 2, "{index}");
                let contract = &tuned("moller-trumbore").0.contract;
                let owed = group_obligation(made.cases(), &truths, contract, family.grouping);
                owed_something += u32::from(owed != GroupTruth::Free);
            }
        }
        let is_parallel = stratum == Stratum::Parallel;
        // Of the tetrahedron no face holds an axis.
        assert!(
            kept == 600 || is_parallel && direction != "mesh",
            "{stratum:?}: {kept}"
        );
        assert!(500 < kept, "{stratum:?}: {kept}");
        assert!(
            400 < owed_something || stratum != Stratum::Edges,
            "{owed_something}"
        );
        let all = if is_parallel && direction == "mesh" {
            12
        } else {
            16
        };
        assert_eq!(seen.len(), all, "{stratum:?}");
        let aimed = [Stratum::Interior, Stratum::Edges, Stratum::Vertices];
        assert!(
            !aimed.contains(&stratum) || 200 < hits,
            "{stratum:?}: {hits}"
        );
    }
}

#[test]
fn strata_of_a_mesh_are_rays_at_its_own_triangles() {
    check_mesh::<f32>("mesh");
    check_mesh::<f64>("mesh");
    check_mesh::<f64>("mesh,direction=target");
}
