//! `hairline-rt signature`: which evaluation of each expression a device's compiler chooses, found by its bits.

mod expressions;

use crate::device::Device;
use crate::failure::Failure;
use crate::output::{print, write_json};
use clap::ValueHint;
use expressions::{EXPRESSIONS, Evaluation, Expression, INPUTS, Numbers, SUBNORMAL};
use hairline_core::case::Draw;
use serde::Serialize;
use std::fmt;

/// How the device computes in WGSL: which products it fuses, what it reorders, and what becomes of subnormal numbers
///
/// Each expression is a shader of its own. Its results are compared, bit for bit, with evaluations that a compiler may choose.
#[derive(clap::Args)]
pub struct Arguments {
    /// The same as JSON, to send to somebody
    #[arg(short, long, value_hint = ValueHint::FilePath)]
    output: Option<String>,
}

/// How many inputs each expression gets.
const COUNT: u64 = 50_000;

/// A device's arithmetic.
#[derive(Serialize)]
struct Signature {
    device: String,
    expressions: Vec<Evaluated>,
    /// Expressions of subnormal numbers.
    subnormal: Vec<Flushed>,
}

/// An expression, and the evaluations beside it.
#[derive(Serialize)]
struct Evaluated {
    expression: &'static str,
    inputs: usize,
    evaluations: Vec<Compared>,
}

/// An evaluation that a compiler may choose.
#[derive(Serialize)]
struct Compared {
    evaluation: &'static str,
    /// How many results are the same number.
    equal: usize,
    /// The most floats between two results; none across zero and NaN.
    most_ulps: Option<u32>,
}

/// An expression whose exact result is a subnormal number.
#[derive(Serialize)]
struct Flushed {
    expression: &'static str,
    inputs: usize,
    zeros: usize,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let device = Device::open()?;
    let generic: Vec<Numbers> = (0..COUNT).map(generic).collect();
    let small: Vec<Numbers> = (0..64).map(small).collect();
    let mut signature = Signature {
        device: device.name(),
        expressions: Vec::new(),
        subnormal: Vec::new(),
    };
    for expression in EXPRESSIONS {
        let results = evaluate(&device, expression.wgsl, &generic)?;
        signature
            .expressions
            .push(Evaluated::new(expression, &generic, &results));
    }
    for &expression in SUBNORMAL {
        let results = evaluate(&device, expression, &small)?;
        signature.subnormal.push(Flushed {
            expression,
            inputs: results.len(),
            zeros: results.iter().filter(|result| **result == 0.0).count(),
        });
    }
    print(&signature)?;
    match &arguments.output {
        Some(path) => write_json(path, &signature),
        None => Ok(()),
    }
}

/// Eight numbers of five sizes and both signs.
fn generic(index: u64) -> Numbers {
    let draw = &mut Draw::new("signature", 1, index);
    [(); INPUTS].map(|()| {
        let size = 2f64.powi(draw.integer(-2, 2) as i32);
        let number: f64 = draw.symmetric();
        (size * number) as f32
    })
}

/// A subnormal number, two whose product is one, and 1.
fn small(index: u64) -> Numbers {
    let bits = 1 + 131_071 * index as u32;
    let [b, c] = [1.25 * 2f32.powi(-100), 1.5 * 2f32.powi(-40)];
    [f32::from_bits(bits), b, c, 1.0, 0.0, 0.0, 0.0, 0.0]
}

/// The results of an expression of `a` to `h` on a device.
fn evaluate(device: &Device, wgsl: &str, inputs: &[Numbers]) -> Result<Vec<f32>, Failure> {
    let shader = device.shader(&include_str!("signature/one.wgsl").replace("EXPRESSION", wgsl));
    let count = device.storage(&[inputs.len() as u32]);
    let numbers = device.storage(inputs);
    let results = device.zeros::<f32>(inputs.len());
    let bound = [
        count.as_entire_binding(),
        numbers.as_entire_binding(),
        results.as_entire_binding(),
    ];
    let mut encoder = device.gpu.create_command_encoder(&Default::default());
    device.dispatch(&mut encoder, &shader, &bound, inputs.len() as u32);
    let [results] = device.finish(encoder, [&results])?;
    Ok(bytemuck::pod_collect_to_vec(&results))
}

impl Evaluated {
    fn new(expression: &Expression, inputs: &[Numbers], results: &[f32]) -> Evaluated {
        let compared = |&(evaluation, evaluate): &Evaluation| {
            let expected: Vec<f32> = inputs.iter().map(|numbers| evaluate(*numbers)).collect();
            let pairs = || expected.iter().zip(results);
            Compared {
                evaluation,
                equal: pairs().filter(|(a, b)| a == b).count(),
                most_ulps: pairs()
                    .map(|(a, b)| ulps(*a, *b))
                    .try_fold(0, |most, ulps| Some(most.max(ulps?))),
            }
        };
        Evaluated {
            expression: expression.wgsl,
            inputs: inputs.len(),
            evaluations: expression.evaluations.iter().map(compared).collect(),
        }
    }

    /// The evaluation that all results equal; else the nearest one.
    fn best(&self) -> &Compared {
        let best = self.evaluations.iter().max_by_key(|it| it.equal);
        best.expect("every expression has evaluations")
    }
}

/// How many floats lie from one to another of the same sign.
fn ulps(a: f32, b: f32) -> Option<u32> {
    let is_comparable = !a.is_nan() && !b.is_nan() && a.is_sign_negative() == b.is_sign_negative();
    is_comparable.then(|| a.to_bits().abs_diff(b.to_bits()))
}

impl fmt::Display for Signature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.device)?;
        writeln!(f)?;
        for evaluated in &self.expressions {
            let best = evaluated.best();
            let told = match best.equal == evaluated.inputs {
                true => best.evaluation.to_owned(),
                false => {
                    let share = 100.0 * best.equal as f64 / evaluated.inputs as f64;
                    let ulps = best
                        .most_ulps
                        .map_or("others of another sign".to_owned(), |ulps| {
                            format!("the others within {ulps} ulps")
                        });
                    format!("{}: {share:.2} %, {ulps}", best.evaluation)
                }
            };
            writeln!(f, "{:34} {told}", evaluated.expression)?;
        }
        writeln!(f)?;
        writeln!(f, "Results that are subnormal numbers")?;
        for flushed in &self.subnormal {
            let told = match flushed.zeros {
                0 => "kept".to_owned(),
                zeros if zeros == flushed.inputs => "zero".to_owned(),
                zeros => format!("zero in {zeros} of {}", flushed.inputs),
            };
            writeln!(f, "{:34} {told}", flushed.expression)?;
        }
        Ok(())
    }
}
