//! The sentences about gates that `prove --scene ... --details` prints, held against rays of the scene: those that its samples
//! are, and parallel ones along an edge.

use hairline::internals::arith::Arithmetic;
use hairline::internals::case::{self, Draw, Parameters};
use hairline::internals::family::Stratum;
use hairline::internals::kernel::{Entry, KERNELS, Scalar, in_arithmetic};
use hairline::internals::prove::{
    Effort, GateSummary, Published, Scene, Searched, Shape, Summary, Triangles, statements,
};

use super::sentences::{
    Drawn, Inputs, Proved, Says, Sentence, cross, float, length, minus, published, read,
    read_of_scene, vectors,
};

/// Scenes of other sizes: what is said must not depend on one of them.
const SCENES: [&str; 3] = [
    "room",
    "extent=500,edge=0.05..200,distance=0..1000,direction=unit",
    "extent=0.5,edge=0.001..0.4,distance=0..0.1,direction=unit",
];

/// How wide the scene's numbers are kept from: what rounding takes from them is not what is tried here.
const WITHIN: f64 = 1.0 - 1e-5;

/// What a gate's sentences suppose of the ray.
#[derive(Clone, Copy, PartialEq)]
enum Supposed {
    /// That it is of the scene, or parallel.
    Nothing,
    /// That the line meets the triangle at the scene's least angle or more.
    Hit,
}

/// A sentence about a gate, and what is supposed for it.
struct OfGate {
    gate: usize,
    supposed: Supposed,
    sentence: Sentence,
    /// The rays that it was asked about.
    times: u64,
}

/// What is said of a gate.
fn sentences<F: Searched + Scalar>(
    proved: &Proved<F>,
    gate: &GateSummary<F>,
    scene: &Scene,
    published: &[Published],
) -> Vec<OfGate> {
    let shapes: Vec<Shape> = scene.shapes();
    let triangles = Triangles {
        scene,
        shapes: &shapes,
    };
    let Proved { entry, summary, .. } = proved;
    let lines = statements::<F>(entry, summary, gate, Some(triangles), published);
    // A limit of |N|, of its largest coordinate, or of the direction's holds for each triangle and ray of the scene.
    let is_of_any = |name: &str| {
        ["|N| ", "|N_k| ", "|d_k| ", "|N·N| "]
            .iter()
            .any(|it| name.starts_with(it))
    };
    let supposition = lines.iter().find_map(|line| {
        line.strip_prefix("It supposes of the exact numbers, and more of larger triangles: ")
    });
    let supposed = match supposition {
        Some(names)
            if !names
                .split(", ")
                .take_while(|it| it.starts_with('|'))
                .all(is_of_any) =>
        {
            Supposed::Hit
        }
        _ => Supposed::Nothing,
    };
    let mut all: Vec<OfGate> = Vec::new();
    let mut that = f64::NAN;
    for line in &lines {
        let sentence = if line.starts_with("In this scene, for |d| = 1, ") {
            Some(read_of_scene(line, published, that))
        } else if line.starts_with("It supposes of the exact numbers") {
            None
        } else {
            read(line, published)
        };
        if let Some(Sentence {
            says: Says::RefusesParallel(bound),
            ..
        }) = &sentence
        {
            that = *bound;
        }
        let sentence = sentence.filter(|sentence| sentence.says.says_something());
        all.extend(sentence.map(|sentence| OfGate {
            gate: gate.index,
            supposed,
            sentence,
            times: 0,
        }));
    }
    all
}

/// The numbers of a case with the interval of the scene's proofs.
fn inputs<F: Scalar>(case: &case::Case<F>, scene: &Scene) -> Inputs {
    let numbers = case.vectors().map(|v| v.map(F::to_f64)).concat();
    let ends = [0.0, float::<F>(scene.distance * WITHIN)];
    let all = [&numbers[..], &ends[..]].concat();
    all.try_into().expect("five vectors and an interval")
}

/// A ray along an edge: from 0, which is a vertex, so that the edge is exactly a multiple of the direction.
fn parallel<F: Scalar>(scene: &Scene, draw: &mut Draw) -> Inputs {
    let any = |draw: &mut Draw| [(); 3].map(|()| draw.symmetric::<f64>());
    let direction = any(draw);
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    let direction = direction.map(|x| float::<F>(x / length));
    let [shortest, longest] = scene.edge;
    let steps = (longest / shortest).log2().max(1.0) as usize;
    let size = 2f64.powi(shortest.log2().ceil() as i32 + draw.below(steps) as i32);
    let end = direction.map(|x| x * size);
    let third = any(draw).map(|x| float::<F>(x * size));
    let origin = any(draw).map(|x| float::<F>(x * scene.distance));
    let mut vertices = [[0.0; 3], end, third];
    vertices.rotate_left(draw.below(3));
    let numbers = [[origin, direction].concat(), vertices.concat()].concat();
    let ends = [0.0, float::<F>(scene.distance * WITHIN)];
    [&numbers[..], &ends[..]].concat().try_into().expect("17")
}

/// True of a triangle and a ray's origin and direction as the screen's line on the scene has them, with a little to spare.
fn is_of_scene<F: Scalar>(inputs: &Inputs, scene: &Scene) -> bool {
    let [origin, direction, edges @ ..] = vectors(inputs);
    let vertices = [6, 9, 12].map(|i| -> [f64; 3] { inputs[i..i + 3].try_into().expect("three") });
    let coordinates = vertices.iter().chain([&origin]).flatten();
    let largest = coordinates.fold(0.0f64, |most, x| most.max(x.abs()));
    let distances = vertices.map(|vertex| length(minus(vertex, origin)));
    let farthest = distances.into_iter().fold(0.0, f64::max);
    let lengths = edges.map(length);
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let area = length(cross(edges[0], edges[1]));
    let angle = |i: usize, j: usize| {
        (area / lengths[i] / lengths[j])
            .min(1.0)
            .asin()
            .to_degrees()
    };
    let least = angle(0, 1).min(angle(1, 2)).min(angle(2, 0));
    let speed = length(direction) - 1.0;
    largest < scene.coordinates * WITHIN
        && farthest < scene.distance * WITHIN
        && scene.edge[0] < longest * WITHIN
        && longest < scene.edge[1] * WITHIN
        && scene.min_angle < least * WITHIN
        && speed.abs() < 2.0 * F::EPSILON.to_f64()
}

/// The rays that are tried.
fn drawn<F: Searched + Scalar>(
    proved: &Proved<F>,
    words: &case::Scene,
    scene: &Scene,
) -> Vec<Drawn<F>> {
    let parameters = Parameters {
        scene: Some(words.clone()),
        ..Parameters::default()
    };
    let mut all = Vec::new();
    for stratum in [
        Stratum::Interior,
        Stratum::Edges,
        Stratum::Vertices,
        Stratum::Grazing,
        Stratum::Parallel,
    ] {
        for index in 0..RAYS {
            let group = stratum.family().make::<F>(&parameters, 1, index);
            all.extend(group.cases().first().map(|case| inputs(case, scene)));
        }
    }
    for index in 0..2 * RAYS {
        all.push(parallel::<F>(scene, &mut Draw::new("parallel", 1, index)));
    }
    let is_of_scene = |inputs: &Inputs| is_of_scene::<F>(inputs, scene);
    all.into_iter()
        .filter(is_of_scene)
        .map(|it| proved.drawn(it))
        .collect()
}

/// The sentences of one kernel hold for the rays; how many were asked about some, and how many there are.
fn hold<F: Searched + Scalar>(entry: &'static Entry, words: &str) -> [usize; 2] {
    let (words, _) = case::Scene::parse(words).unwrap();
    let scene = Scene::of(&words).unwrap();
    let domain = scene.domain().unwrap();
    let parts = scene.parts(&scene.shapes());
    let summary = Summary::<F>::new(entry, domain, &parts, &[], Effort::NONE).unwrap();
    let proved = Proved::new(entry, summary);
    let published = published::<F>();
    let gates = proved.summary.gates.iter();
    let of_gate = |gate| sentences(&proved, gate, &scene, &published);
    let mut all: Vec<OfGate> = gates.flat_map(of_gate).collect();
    let least_sine = scene.grazing.to_radians().sin() / WITHIN;
    for drawn in drawn(&proved, &words, &scene) {
        let is_steep = least_sine < drawn.sine;
        let gates = 0..entry.info.gates.len();
        let asked: Vec<_> = gates.map(|gate| proved.ask(&drawn, gate)).collect();
        for OfGate {
            gate,
            supposed,
            sentence,
            times,
        } in &mut all
        {
            let is_meant = match supposed {
                Supposed::Nothing => is_steep || drawn.is_parallel,
                Supposed::Hit => is_steep && drawn.is_hit,
            };
            // Hits are kept at angles that a sentence says, also below the scene's.
            let is_meant = is_meant || matches!(sentence.says, Says::OfScene { .. });
            let Some(asked) = asked[*gate].as_ref().filter(|_| is_meant) else {
                continue;
            };
            let Some(holds) = sentence.holds(&drawn, asked) else {
                continue;
            };
            proved.assert_holds(holds, sentence, &drawn);
            *times += 1;
        }
    }
    let asked = all.iter().filter(|it| 0 < it.times);
    [asked.count(), all.len()]
}

/// Rays of each kind.
const RAYS: u64 = 8;

/// Of each second kernel the sentences about one arithmetic in one scene: proofs in a scene take seconds.
fn all_hold<F: Searched + Scalar>(first: usize) {
    let mut sums = [0; 2];
    for (i, kernel) in KERNELS.iter().enumerate().skip(first).step_by(2) {
        let arithmetic = [Arithmetic::IEEE, Arithmetic::FMA][i / 2 % 2];
        let entry = in_arithmetic(kernel, arithmetic).unwrap();
        let [asked, all] = hold::<F>(entry, SCENES[i % SCENES.len()]);
        sums[0] += asked;
        sums[1] += all;
    }
    // A bound above all numbers of a scene says nothing of its rays.
    let [asked, all] = sums;
    assert!(9 * all < 10 * asked, "{asked} of {all}");
}

#[test]
fn every_sentence_about_a_gate_in_a_scene_holds_for_its_rays_in_f32() {
    all_hold::<f32>(0);
}

#[test]
fn every_sentence_about_a_gate_in_a_scene_holds_for_its_rays_in_f64() {
    all_hold::<f64>(1);
}
