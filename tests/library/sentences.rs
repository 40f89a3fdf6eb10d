//! The sentences about gates that `prove --details` prints, as a reader understands them, held against drawn rays: what a gate
//! compares is computed in floats, and exactly.

use hairline::Sides;
use hairline::internals::arith::recorded::Operation;
use hairline::internals::arith::{Arithmetic, Exact, Real};
use hairline::internals::case::{Case, Draw};
use hairline::internals::kernel::{Entry, Gated, KERNELS, Scalar, in_arithmetic};
use hairline::internals::prove::{
    Domain, Effort, GateSummary, Published, Sample, Searched, Summary, case_of, compared, parts,
    run, statements,
};

use super::prove::taken;

/// The largest coordinate of points, of their differences and of directions that are drawn.
const BELOW_ONE: f64 = 1.0 - 1.0 / 1024.0;

/// What a sentence says of a gate's margin m, the largest epsilon e that accepts, and of its exact value x.
#[derive(Debug)]
pub enum Says {
    /// No number that is compared is wrong by more than this.
    Error(f64),
    /// m is at most this for rays that are exactly parallel.
    RefusesParallel(f64),
    /// So is it where some coordinates are at most `size`.
    RefusesParallelUpTo { size: f64, of: String, epsilon: f64 },
    /// x is at most m and this.
    KeepsAbove(f64),
    /// m is at least this for rays that hit.
    KeepsHits(f64),
    /// An m below `lowest` has an x below 0; an m above `highest` has one that is not.
    Decides { lowest: f64, highest: f64 },
    /// m is at least `epsilon` where x is at least `kept`, and below it where x is at most `refused`.
    Of {
        epsilon: f64,
        kept: f64,
        refused: f64,
    },
    /// m and x are on the same side of 0, unless the exact value of a number that is compared is at most this.
    SignUnlessWithin(f64),
    /// m is below `epsilon` for parallel rays at triangles with edges up to this, and at least that for hits at `degrees` to the
    /// plane and more, if there are any.
    OfScene {
        epsilon: f64,
        parallel_up_to: f64,
        degrees: Option<f64>,
    },
}

impl Says {
    /// False of a sentence in a scene that no ray could contradict.
    pub fn says_something(&self) -> bool {
        !matches!(
            self,
            Says::OfScene {
                parallel_up_to: 0.0,
                degrees: None,
                ..
            }
        )
    }

    /// The ray with lengths times a power of two, as large as the sentence goes; none if the sentence says nothing of it, or a
    /// float underflows.
    fn in_its_size<F: Scalar>(&self, drawn: &Drawn<F>) -> Option<Inputs> {
        let inputs = &drawn.inputs;
        let Says::RefusesParallelUpTo { size, of, .. } = self else {
            return Some(*inputs);
        };
        if !drawn.is_parallel {
            return None;
        }
        let exponent = (size / size_of(inputs, of)).log2().floor();
        let factor = 2f64.powi(exponent as i32);
        let mut scaled = *inputs;
        for i in (0..3).chain(6..15) {
            scaled[i] *= factor;
        }
        scaled
            .iter()
            .all(|x| float::<F>(*x) == *x)
            .then_some(scaled)
    }
}

pub struct Sentence {
    pub says: Says,
    /// It begins by what is supposed of divisors and quotients, or ends with it.
    supposes: bool,
    pub text: String,
}

/// The number after some words.
fn after(text: &str, words: &str) -> Option<f64> {
    let (_, rest) = text.split_once(words)?;
    let number = rest.split([' ', ';', ',']).next()?;
    number.trim_end_matches('.').parse().ok()
}

/// Reads a sentence. A sentence that no test knows fails, so that none is added without one.
pub fn read(line: &str, published: &[Published]) -> Option<Sentence> {
    let epsilon_of = |name: &str| {
        let mut named = published.iter().filter(|(other, _)| other == name);
        named.next().expect("an epsilon that was asked for").1
    };
    let number = |words: &str| after(line, words).unwrap_or_else(|| panic!("{line}"));
    let says = if line.starts_with("What it compares is never wrong") {
        Says::Error(number("more than "))
    } else if line.contains("refuses every ray that is exactly parallel") {
        Says::RefusesParallel(number("epsilon above "))
    } else if line.contains("refuses a hit only where") {
        Says::KeepsAbove(number("at most e + "))
    } else if line.contains("is proved to refuse every parallel ray") {
        let name = line
            .strip_prefix("e = ")
            .unwrap()
            .split(" is proved")
            .next();
        let (_, of) = line.split_once("where coordinates of ").unwrap();
        Says::RefusesParallelUpTo {
            size: number("are at most "),
            of: of.split(" are at most").next().unwrap().to_owned(),
            epsilon: epsilon_of(name.unwrap()),
        }
    } else if line.contains("loses no hit at an edge") {
        Says::KeepsHits(number("epsilon below "))
    } else if line.contains("loses nothing that the exact formula accepts") {
        Says::Decides {
            lowest: number("epsilon below "),
            highest: number("one above "),
        }
    } else if line.contains("refuses no exact value of") {
        let (_, rest) = line.split_once("epsilon of ").unwrap();
        Says::Of {
            epsilon: epsilon_of(rest.split(" refuses no").next().unwrap()),
            kept: number("no exact value of "),
            refused: number("accepts none of "),
        }
    } else if line.contains("decides otherwise than exact arithmetic") {
        Says::SignUnlessWithin(number("is within "))
    } else if line.starts_with("No bound")
        || line.contains("is proved for no size")
        // Held in crates/prove's own tests.
        || line.contains("times its permanent")
    {
        return None;
    } else {
        panic!("a sentence that is not held by a test: {line}");
    };
    let supposes = line.contains("divisors are at least") || line.contains("such divisors");
    Some(Sentence {
        says,
        supposes,
        text: line.to_owned(),
    })
}

/// Reads what is said in a scene of an epsilon: of `that` one, which a sentence before is about, or of one with a name.
pub fn read_of_scene(line: &str, published: &[Published], that: f64) -> Sentence {
    let rest = line
        .strip_prefix("In this scene, for |d| = 1, ")
        .unwrap_or_else(|| panic!("{line}"));
    let (of_parallel, of_hits) = rest.split_once("; ").unwrap();
    let (name, parallel_up_to) = if let Some(name) =
        of_parallel.strip_suffix(" refuses every parallel ray")
    {
        (name, f64::INFINITY)
    } else if let Some(name) = of_parallel.strip_suffix(" is not proved to refuse parallel rays") {
        (name, 0.0)
    } else {
        let words = " is proved to refuse the parallel rays of triangles with edges up to ";
        let (name, size) = of_parallel.split_once(words).unwrap();
        (name, size.strip_suffix(" only").unwrap().parse().unwrap())
    };
    let epsilon = match name.strip_prefix("e = ") {
        Some(name) => published.iter().find(|(it, _)| it == name).unwrap().1,
        None => {
            assert_eq!(name, "that epsilon", "{line}");
            that.next_up()
        }
    };
    let degrees = after(of_hits, "keeps every hit at ");
    assert!(
        degrees.is_some() || of_hits.starts_with("for no angle"),
        "{line}"
    );
    Sentence {
        says: Says::OfScene {
            epsilon,
            parallel_up_to,
            degrees,
        },
        supposes: false,
        text: line.to_owned(),
    }
}

pub type Inputs = [f64; 17];

/// A number of as many digits as a float of F has.
pub fn float<F: Scalar>(x: f64) -> f64 {
    F::from_f64(x).to_f64()
}

/// Near the corners of the unit domain, where errors are largest, or anywhere in it.
fn coordinate<F: Scalar>(draw: &mut Draw, most: f64) -> f64 {
    let x: f64 = draw.symmetric();
    let from_corner = 2f64.powi(-(draw.below(8) as i32)) * x.abs();
    let x = if draw.below(2) == 0 {
        x
    } else {
        x.signum() * (1.0 - from_corner)
    };
    float::<F>(most * x)
}

fn vector<F: Scalar>(draw: &mut Draw, most: f64) -> [f64; 3] {
    [(); 3].map(|()| coordinate::<F>(draw, most))
}

pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn inputs(origin: [f64; 3], direction: [f64; 3], vertices: [[f64; 3]; 3]) -> Inputs {
    let [a, b, c] = vertices;
    let numbers = [origin, direction, a, b, c].concat();
    let interval = [0.0, BELOW_ONE];
    let all = [&numbers[..], &interval[..]].concat();
    all.try_into().expect("five points and an interval")
}

/// Along an edge between points of a grid of as many digits as a float has, so that their difference is exact; the other
/// edge is any.
fn parallel<F: Scalar>(draw: &mut Draw) -> Inputs {
    let half = BELOW_ONE / 2.0;
    let start = match draw.below(3) {
        0 => [0.0; 3],
        1 => [(); 3].map(|()| draw.integer(-4, 4) as f64 / 16.0),
        _ => [(); 3].map(|()| draw.integer(0, 1) as f64 * 0.875 - 0.4375),
    };
    let grid = 2f64.powi(F::DIGITS as i32);
    let end = vector::<F>(draw, half).map(|x| (x * grid).round() / grid);
    let along = minus(end, start);
    // The same way, as long as directions may be.
    let exponent = -along
        .map(f64::abs)
        .into_iter()
        .fold(0.0, f64::max)
        .log2()
        .ceil();
    let direction = along.map(|x| x * 2f64.powi(exponent.max(0.0) as i32));
    let mut vertices = [start, end, vector::<F>(draw, half)];
    vertices.rotate_left(draw.below(3));
    if draw.below(2) == 0 {
        vertices.swap(1, 2);
    }
    let sign = if draw.below(2) == 0 { 1.0 } else { -1.0 };
    let origin = match draw.below(4) {
        0 => vertices[draw.below(3)],
        _ => vector::<F>(draw, half),
    };
    inputs(origin, direction.map(|x| sign * x), vertices)
}

/// At a point of the triangle, most of them near an edge or a vertex.
fn aimed<F: Scalar>(draw: &mut Draw) -> Inputs {
    let half = BELOW_ONE / 2.0;
    let vertices = [(); 3].map(|()| vector::<F>(draw, half));
    let near = |draw: &mut Draw| match draw.below(3) {
        0 => draw.unit(),
        _ => 2f64.powi(-(draw.below(40) as i32)) * draw.symmetric::<f64>(),
    };
    let mut weights = [near(draw), near(draw), 0.0];
    weights[2] = 1.0 - weights[0] - weights[1];
    weights.rotate_left(draw.below(3));
    let target: [f64; 3] =
        std::array::from_fn(|i| (0..3).map(|k| weights[k] * vertices[k][i]).sum::<f64>());
    let origin = vector::<F>(draw, half);
    let way = minus(target, origin);
    let largest = way.map(f64::abs).into_iter().fold(0.0, f64::max);
    let direction = way.map(|x| float::<F>(x / largest));
    inputs(origin, direction, vertices)
}

/// Any floats of the unit domain.
fn any<F: Scalar>(draw: &mut Draw) -> Inputs {
    let half = BELOW_ONE / 2.0;
    let origin = vector::<F>(draw, half);
    let direction = vector::<F>(draw, 1.0);
    inputs(origin, direction, [(); 3].map(|()| vector::<F>(draw, half)))
}

/// The largest coordinate of what a sentence names.
fn size_of(inputs: &Inputs, of: &str) -> f64 {
    let point = |i: usize| -> [f64; 3] { inputs[i..i + 3].try_into().expect("three") };
    let [origin, a, b, c] = [0, 6, 9, 12].map(point);
    let named = of.split(" and of ").flat_map(|name| match name {
        "edges" => vec![minus(b, a), minus(c, b), minus(a, c)],
        "vectors from the origin to the vertices" => [a, b, c].map(|p| minus(p, origin)).to_vec(),
        "points" => vec![origin, a, b, c],
        _ => panic!("coordinates of {name}"),
    });
    named.flatten().map(f64::abs).fold(0.0, f64::max)
}

/// A drawn ray and what is exactly true of it.
pub struct Drawn<F: Scalar> {
    pub case: Case<F>,
    inputs: Inputs,
    pub is_parallel: bool,
    /// Its line crosses the triangle, edges included, on a side that the kernel owes.
    pub is_hit: bool,
    /// Of the angle between the ray and the plane, nearly.
    pub sine: f64,
    /// The triangle's longest edge, nearly.
    pub longest: f64,
}

/// What a gate does with a ray, in floats and exactly.
pub struct Asked {
    computed: f64,
    exact: Exact,
    /// The numbers that it compares, on the path that the floats take.
    numbers: Vec<(f64, Exact)>,
    /// They are divided by 1/2 and more, and their quotients are at most 1.
    divides_as_supposed: bool,
}

/// A kernel, and everything that is proved of it.
pub struct Proved<F: Scalar> {
    pub entry: &'static Entry,
    pub summary: Summary<F>,
    gated: &'static dyn Gated<F>,
}

impl<F: Searched + Scalar> Proved<F> {
    pub fn new(entry: &'static Entry, summary: Summary<F>) -> Proved<F> {
        Proved {
            entry,
            summary,
            gated: F::subject(entry).unwrap().gated().unwrap(),
        }
    }

    /// What is true of a ray.
    pub fn drawn(&self, inputs: Inputs) -> Drawn<F> {
        let sample = Sample::of(&inputs.map(Exact::from_f64));
        let zero = Exact::zero();
        let volume = sample.volume();
        let is_parallel = volume.is_zero();
        let is_owed = self.entry.info.contract.sides == Sides::Both || volume.is_less(&zero);
        let is_inside = || {
            [0, 1, 2]
                .iter()
                .all(|i| zero.is_at_most(&sample.weight(*i)))
        };
        let [_, direction, edges @ ..] = vectors(&inputs);
        let normal = cross(edges[0], edges[1]);
        let volume: f64 = (0..3).map(|i| normal[i] * direction[i]).sum();
        Drawn {
            case: case_of(&inputs.map(F::from_f64)),
            inputs,
            is_parallel,
            is_hit: !is_parallel && is_owed && is_inside(),
            sine: volume.abs() / length(normal) / length(direction),
            longest: edges.map(length).into_iter().fold(0.0, f64::max),
        }
    }

    /// Fails with the sentence and the ray that contradicts it.
    pub fn assert_holds(&self, holds: bool, sentence: &Sentence, drawn: &Drawn<F>) {
        assert!(
            holds,
            "{} {}: {}\n{}",
            self.entry.info.name,
            F::NAME,
            sentence.text,
            drawn.case.hex()
        );
    }

    /// None if a gate is not asked.
    pub fn ask(&self, drawn: &Drawn<F>, gate: usize) -> Option<Asked> {
        let computed = self.gated.measure(&drawn.case).margins[gate].to_f64();
        let exact = self.gated.measure_exact(&drawn.case).margins[gate].clone();
        let proof = &self.summary.proof;
        let inputs = drawn.inputs.map(F::from_f64);
        let (index, of_path) = taken(&proof.paths, &inputs);
        let operations = &proof.paths[index].operations;
        let (mut floats, mut values) = (Vec::new(), Vec::new());
        run(operations, &inputs, &mut floats);
        run(operations, &drawn.inputs.map(Exact::from_f64), &mut values);
        let compared = compared(&proof.paths[index]).into_iter();
        let of_gate = compared.filter(|(compared, _)| compared.gate == gate);
        let places: Vec<u32> = of_gate.map(|(_, place)| place).collect();
        let number = |place: &u32| {
            let place = *place as usize;
            (floats[place].to_f64(), values[place].clone())
        };
        let is_asked = !places.is_empty() && !computed.is_nan() && exact.sign().is_some();
        is_asked.then(|| Asked {
            computed,
            exact,
            numbers: places.iter().map(number).collect(),
            divides_as_supposed: divides_as_supposed(
                operations,
                &of_path,
                &places,
                &Sample::of(&drawn.inputs),
            ),
        })
    }
}

/// What the domain says of the divisors and quotients that some numbers are made of, with a little to spare: the values are
/// rounded to f64.
fn divides_as_supposed(
    operations: &[Operation],
    values: &[f64],
    places: &[u32],
    sample: &Sample<f64>,
) -> bool {
    let weights = [0, 1, 2].map(|vertex| sample.weight(vertex));
    let is_weight = |x: f64| {
        let mut near = weights.iter().flat_map(|w| [*w, 1.0 - w]);
        near.any(|w| (x - w).abs() < 1e-6)
    };
    let used = places.iter().flat_map(|place| parts(operations, *place));
    let mut all = used.map(|place| (operations[place as usize], values[place as usize]));
    all.all(|(operation, value)| match operation {
        Operation::Div(numerator, divisor) => {
            let is_inverse = values[numerator as usize] == 1.0;
            0.5001 <= values[divisor as usize].abs()
                && (value.abs() <= 0.9999 || is_inverse)
                && (!is_weight(value) || 0.0 <= value)
        }
        Operation::Sqrt(_) => 0.5001 <= value,
        _ => true,
    })
}

impl Sentence {
    /// False if a ray contradicts it; none if it says nothing of the ray.
    pub fn holds<F: Searched + Scalar>(&self, drawn: &Drawn<F>, asked: &Asked) -> Option<bool> {
        let Asked {
            computed,
            exact,
            numbers,
            divides_as_supposed,
        } = asked;
        let computed = *computed;
        if self.supposes && !divides_as_supposed {
            return None;
        }
        let number = Exact::from_f64;
        let zero = Exact::zero();
        match &self.says {
            Says::Error(bound) => {
                let bound = number(*bound);
                let mut errors = numbers.iter().map(|(x, exact)| (number(*x) - exact).abs());
                Some(errors.all(|error| error.is_at_most(&bound)))
            }
            Says::RefusesParallel(bound) => drawn.is_parallel.then_some(computed <= *bound),
            // Asked about the ray in that size.
            Says::RefusesParallelUpTo { epsilon, .. } => {
                drawn.is_parallel.then(|| computed < float::<F>(*epsilon))
            }
            Says::KeepsAbove(bound) => {
                let most = number(computed) + &number(*bound);
                Some(exact.is_at_most(&most))
            }
            Says::KeepsHits(bound) => drawn.is_hit.then_some(*bound <= computed),
            Says::Decides { lowest, highest } => {
                if computed < *lowest {
                    Some(exact.is_less(&zero))
                } else if *highest < computed {
                    Some(zero.is_at_most(exact))
                } else {
                    None
                }
            }
            Says::Of {
                epsilon,
                kept,
                refused,
            } => {
                if number(*kept).is_at_most(exact) {
                    Some(*epsilon <= computed)
                } else if exact.is_at_most(&number(*refused)) {
                    Some(computed < *epsilon)
                } else {
                    None
                }
            }
            Says::SignUnlessWithin(bound) => {
                let bound = number(*bound);
                let mut all = numbers.iter().map(|(_, exact)| exact.abs());
                let is_near = all.any(|size| size.is_at_most(&bound));
                (!is_near).then(|| (computed < 0.0) == exact.is_less(&zero))
            }
            Says::OfScene {
                epsilon,
                parallel_up_to,
                degrees,
            } => {
                let is_at = |degrees: f64| degrees.to_radians().sin() * ROUNDED < drawn.sine;
                if drawn.is_parallel {
                    (drawn.longest * ROUNDED < *parallel_up_to).then_some(computed < *epsilon)
                } else if drawn.is_hit && degrees.is_some_and(is_at) {
                    Some(*epsilon <= computed)
                } else {
                    None
                }
            }
        }
    }
}

/// More than what rounding to f64 adds to a sine or to a length.
const ROUNDED: f64 = 1.0 + 1e-9;

pub fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i])
}

/// The origin, the direction, and the edges around the triangle, nearly.
pub fn vectors(inputs: &Inputs) -> [[f64; 3]; 5] {
    let point = |i: usize| -> [f64; 3] { inputs[i..i + 3].try_into().expect("three") };
    let [origin, direction, a, b, c] = [0, 3, 6, 9, 12].map(point);
    [origin, direction, minus(b, a), minus(c, b), minus(a, c)]
}

/// Epsilons of every size, at which it is asked what a gate does.
pub fn published<F: Scalar>() -> Vec<Published> {
    let values = [1e-45, 1e-30, 1e-12, 1e-9, 1e-6, 1e-4, 0.01, 0.25];
    let values = values.into_iter().map(float::<F>).filter(|x| 0.0 < *x);
    values.map(|x| (format!("{x:e}"), x)).collect()
}

/// The sentences of one kernel hold for all rays that are drawn; how many rays each was asked about.
fn hold<F: Searched + Scalar>(entry: &'static Entry, rays: u64) -> Vec<(String, u64)> {
    let summary = Summary::<F>::new(entry, Domain::UNIT, &[], &[], Effort::NONE).unwrap();
    let published = published::<F>();
    let of_gate = |gate: &GateSummary<F>| {
        let lines = statements::<F>(entry, &summary, gate, None, &published);
        let read = lines.iter().filter_map(|line| read(line, &published));
        read.map(|sentence| (gate.index, sentence, 0))
            .collect::<Vec<_>>()
    };
    let mut sentences: Vec<(usize, Sentence, u64)> =
        summary.gates.iter().flat_map(of_gate).collect();
    let proved = Proved::new(entry, summary);
    for ray in 0..rays {
        let mut draw = Draw::new("sentences", 1, ray);
        let inputs = match ray % 3 {
            0 => parallel::<F>(&mut draw),
            1 => aimed::<F>(&mut draw),
            _ => any::<F>(&mut draw),
        };
        let drawn = proved.drawn(inputs);
        let gates = entry.info.gates.len();
        let asked: Vec<_> = (0..gates).map(|gate| proved.ask(&drawn, gate)).collect();
        for (gate, sentence, times) in &mut sentences {
            let Some(inputs) = sentence.says.in_its_size(&drawn) else {
                continue;
            };
            let scaled = (inputs != drawn.inputs).then(|| {
                let drawn = proved.drawn(inputs);
                let asked = proved.ask(&drawn, *gate);
                (drawn, asked)
            });
            let (drawn, asked) = match &scaled {
                Some((drawn, asked)) => (drawn, asked),
                None => (&drawn, &asked[*gate]),
            };
            let Some(holds) = asked.as_ref().and_then(|it| sentence.holds(drawn, it)) else {
                continue;
            };
            proved.assert_holds(holds, sentence, drawn);
            *times += 1;
        }
    }
    let times = sentences.into_iter().map(|(_, it, times)| (it.text, times));
    times.collect()
}

fn all_hold<F: Searched + Scalar>() {
    let mut unasked = Vec::new();
    for kernel in KERNELS {
        for arithmetic in [Arithmetic::IEEE, Arithmetic::FMA] {
            let entry = in_arithmetic(kernel, arithmetic).unwrap();
            let times = hold::<F>(entry, RAYS).into_iter();
            let never = times.filter(|(_, times)| *times == 0);
            unasked.extend(never.map(|(text, _)| format!("{}: {text}", entry.info.name)));
        }
    }
    // It divides numbers by each other twice, and few rays keep all of the divisors at 1/2 and more.
    unasked.retain(|text| !text.starts_with("baldwin-weber"));
    assert!(unasked.is_empty(), "{unasked:#?}");
}

/// Rays for each kernel, in each arithmetic and scalar.
const RAYS: u64 = 120;

#[test]
fn every_sentence_about_a_gate_holds_for_drawn_rays_in_f32() {
    all_hold::<f32>();
}

#[test]
fn every_sentence_about_a_gate_holds_for_drawn_rays_in_f64() {
    all_hold::<f64>();
}
