//! `hairline-rt signature`: which evaluation of each expression a device's compiler chooses, found by its bits.

mod expressions;
mod precise;

use crate::device::{Device, Shader};
use crate::failure::Failure;
use crate::output::{check_output, print, write_json};
use clap::ValueHint;
use expressions::{EXPRESSIONS, Evaluation, Expression, INPUTS, Numbers, SUBNORMAL};
use hairline_core::case::Draw;
use serde::Serialize;
use std::fmt;

/// How the device computes in WGSL: which products it fuses, what it reorders, and what becomes of subnormal numbers
///
/// Each expression is a shader of its own. Its results are compared, bit for bit, with evaluations that a compiler may choose.
/// Where there is glslangValidator each is asked once more in GLSL, with a result that is `precise`.
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
    /// In GLSL, with a precise result.
    precise: Precise,
    /// Expressions of subnormal numbers.
    subnormal: Vec<Flushed>,
}

/// The same expressions in GLSL whose result is `precise`.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Precise {
    Asked(Vec<Evaluated>),
    /// The reason, in one line.
    NotAsked(String),
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
    if let Some(path) = &arguments.output {
        check_output(path)?;
    }
    let device = Device::open()?;
    let generic: Vec<Numbers> = (0..COUNT).map(generic).collect();
    let small: Vec<Numbers> = (0..64).map(small).collect();
    let mut signature = Signature {
        device: device.name(),
        expressions: Vec::new(),
        precise: asked_precisely(&device, &generic)?,
        subnormal: Vec::new(),
    };
    for expression in EXPRESSIONS {
        let shader = wgsl_shader(&device, expression.wgsl);
        let results = evaluate(&device, &shader, &generic)?;
        signature
            .expressions
            .push(Evaluated::new(expression, &generic, &results));
    }
    for &expression in SUBNORMAL {
        let results = evaluate(&device, &wgsl_shader(&device, expression), &small)?;
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

/// The expressions with a `precise` result, if the device and this machine can be asked.
fn asked_precisely(device: &Device, inputs: &[Numbers]) -> Result<Precise, Failure> {
    if !device.takes_spirv() {
        let why = "the device takes no SPIR-V as it is".to_owned();
        return Ok(Precise::NotAsked(why));
    }
    let mut asked = Vec::new();
    for expression in EXPRESSIONS {
        let words = match precise::shader(expression.wgsl) {
            Ok(words) => words,
            Err(why) => return Ok(Precise::NotAsked(why)),
        };
        let results = evaluate(device, &device.spirv_shader(&words, BUFFERS), inputs)?;
        asked.push(Evaluated::new(expression, inputs, &results));
    }
    Ok(Precise::Asked(asked))
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

/// A shader of an expression of `a` to `h`.
fn wgsl_shader(device: &Device, wgsl: &str) -> Shader {
    device.shader(&include_str!("signature/one.wgsl").replace("EXPRESSION", wgsl))
}

/// The buffers of each shader: how many inputs, the inputs, the results.
const BUFFERS: u32 = 3;

/// The results of a shader on a device.
fn evaluate(device: &Device, shader: &Shader, inputs: &[Numbers]) -> Result<Vec<f32>, Failure> {
    let count = device.storage(&[inputs.len() as u32]);
    let numbers = device.storage(inputs);
    let results = device.zeros::<f32>(inputs.len());
    let bound = [
        count.as_entire_binding(),
        numbers.as_entire_binding(),
        results.as_entire_binding(),
    ];
    let mut encoder = device.gpu.create_command_encoder(&Default::default());
    device.dispatch(&mut encoder, shader, &bound, inputs.len() as u32);
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

    /// The evaluation in words.
    fn told(&self) -> String {
        let best = self.best();
        if best.equal == self.inputs {
            return best.evaluation.to_owned();
        }
        let share = 100.0 * best.equal as f64 / self.inputs as f64;
        let ulps = match best.most_ulps {
            Some(ulps) => format!("the others within {ulps} ulps"),
            None => "others of another sign".to_owned(),
        };
        format!("{}: {share:.2} %, {ulps}", best.evaluation)
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
            writeln!(f, "{:34} {}", evaluated.expression, evaluated.told())?;
        }
        writeln!(f)?;
        self.write_precise(f)?;
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

impl Signature {
    /// The expressions that `precise` changes.
    fn write_precise(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let asked = match &self.precise {
            Precise::Asked(asked) => asked,
            Precise::NotAsked(why) => return writeln!(f, "GLSL's precise was not asked: {why}"),
        };
        writeln!(f, "In GLSL with a precise result")?;
        let mut alike = 0;
        for (precise, free) in asked.iter().zip(&self.expressions) {
            let told = precise.told();
            if told == free.told() {
                alike += 1;
            } else {
                writeln!(f, "{:34} {told}", precise.expression)?;
            }
        }
        writeln!(f, "{:34} as above", format!("{alike} expressions"))
    }
}
