//! The frame of the body of a guarded kernel: a header comment, its function, and the functions that it calls.

use super::code::Code;
use super::language::Language;
use super::names::names;
use crate::arith::recorded::{Operation, Place};
use crate::contract::Extent;
use crate::prove::repair::Guarded;

/// The source of a guarded kernel; the shares of rays on which it asks, if they were counted.
pub fn source(guarded: &Guarded, language: Language, shares: Option<&str>) -> String {
    let frame = Frame { guarded, language, is_f32: guarded.scalar == "f32" };
    let mut comment = frame.comment();
    comment.extend(shares.map(|shares| format!("\nHow often it asks: {shares}")));
    let comment = comment.join("\n");
    let body = Code::body(guarded, language).join("\n");
    let text = match language {
        Language::C => format!("/* {}\n */\n{}", comment.replace('\n', "\n * "), frame.c(&body)),
        _ => {
            let mark = if language == Language::Rust { "//!" } else { "//" };
            let comment: Vec<String> =
                comment.lines().map(|line| format!("{mark} {line}")).collect();
            let code =
                if language == Language::Rust { frame.rust(&body) } else { frame.shader(&body) };
            format!("{}\n{code}", comment.join("\n"))
        }
    };
    text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

struct Frame<'a> {
    guarded: &'a Guarded,
    language: Language,
    is_f32: bool,
}

/// `moller_trumbore_f32`.
pub fn function_name(guarded: &Guarded) -> String {
    let name = guarded.info.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    format!("{name}_{}", guarded.scalar)
}

impl Frame<'_> {
    fn comment(&self) -> Vec<String> {
        let Guarded { info, scalar, scale, .. } = self.guarded;
        let (extent, is_front) = self.guarded.promise();
        let language = format!("{:?}", self.language).to_lowercase();
        let command = format!("hairline repair --kernel {} --scalar {scalar}", info.name);
        let between = match extent {
            Extent::Line => "at any t (t_min and t_max are not looked at)",
            Extent::Ray => "at t >= 0 (t_min and t_max are not looked at)",
            Extent::Interval => "at t_min <= t <= t_max",
        };
        let sides = if is_front { "front" } else { "both sides" };
        let digits = scale.format.digits;
        let mut lines = vec![
            format!("{} in {scalar} with three answers: hit, miss, ask. Made by", info.name),
            format!("    {command} --emit {language}"),
            format!("from: {}", info.source),
            String::new(),
            format!("promise: {}, {sides}", extent.name()),
            "A hit is right: the ray passes through the inside of the triangle. A miss is right: it does not meet".to_owned(),
            format!("the triangle, its edges included, {between}. Where rounding may decide, and on an edge: ask."),
            "This holds for all finite inputs at every scale. The kernel's epsilons are gone. t, u and v are those that".to_owned(),
            "the kernel computes; nothing is claimed of them.".to_owned(),
            String::new(),
            "Why: a sum of products, each of which passes at most K roundings before the last sum, is off by at most".to_owned(),
            format!("((1+u)^K - 1) times the sum of their sizes, u = 2^-{digits}. Its sign is right beyond factor * sizes; the factor"),
            "covers the rounding of the sizes too. It supposes rounding to nearest, and differences of points that are computed".to_owned(),
            "as they stand here. K is that of the worst order of a sum, so sums of products may be fused and reordered;".to_owned(),
            "SLACK and the margin's least size cover underflow, subnormal numbers flushed or not. What".to_owned(),
            "overflows is no finite number, and asks.".to_owned(),
        ];
        if self.language.is_of_shaders() {
            lines.pop();
            lines.push(format!("overflows does not occur where coordinates are below {}: others ask. It supposes finite inputs.", self.largest()));
            lines.push("The language does not promise rounding to nearest; graphics devices that are known do so.".to_owned());
        }
        let names = names(self.guarded);
        for (place, margin) in &self.guarded.margins {
            let name = match self.guarded.operations[*place as usize] {
                Operation::Input(_) => continue,
                _ => &names[*place as usize],
            };
            lines.push(format!(
                "    {name}: K = {}, factor {:.3e}",
                margin.roundings,
                margin.factor.to_f64()
            ));
        }
        lines.push(format!("Proof: {command} --certificate FILE; hairline prove --check FILE"));
        lines
    }

    fn number(&self, x: f64) -> String {
        self.language.number(x, self.is_f32)
    }

    /// The largest coordinate for which nothing overflows.
    fn largest(&self) -> String {
        let most = if self.is_f32 { 126.0 } else { 1022.0 };
        let holds = |exponent: &i32| {
            let size = f64::from(*exponent);
            (0..self.guarded.operations.len())
                .all(|place| self.magnitude(place as Place, size) < most)
        };
        let exponent = (0..self.guarded.scale.far.ceil_log2()).rev().find(holds).unwrap_or(0);
        self.number(2f64.powi(exponent))
    }

    /// The logarithm of a bound of a number's size, for inputs of a size.
    fn magnitude(&self, place: Place, input: f64) -> f64 {
        let of = |place: Place| self.magnitude(place, input);
        let sum = |a: f64, b: f64| a.max(b) + 1.0;
        match self.guarded.operations[place as usize] {
            Operation::Input(15..) => f64::from(self.guarded.scale.far.ceil_log2()),
            Operation::Input(_) => input,
            Operation::Number(x) => f64::from(x.abs().max(1)).log2(),
            Operation::Add(a, b) | Operation::Sub(a, b) => sum(of(a), of(b)),
            Operation::Mul(a, b) => sum(of(a), 0.0) + sum(of(b), 0.0),
            Operation::Neg(a) | Operation::Abs(a) => of(a),
            // Of t, u and v nothing is claimed.
            _ => 0.0,
        }
    }

    fn ends(&self) -> Option<[String; 3]> {
        let far = self.number(self.guarded.scale.far.to_f64());
        (self.guarded.promise().0 == Extent::Interval).then(|| {
            let is_bad = format!("!(t_min <= t_max && t_min <= {far} && t_max >= -{far})");
            [is_bad, format!("t_min < -{far}"), format!("t_max > {far}")]
        })
    }

    fn c(&self, body: &str) -> String {
        let Guarded { scale, scalar, info, .. } = self.guarded;
        let (name, real) = (function_name(self.guarded), self.language.scalar(self.is_f32));
        let upper = scalar.to_uppercase();
        let guard = format!("HAIRLINE_{}_H", name.to_uppercase());
        let [slack, tiny, far] =
            [scale.slack, scale.tiny, scale.far].map(|x| self.number(x.to_f64()));
        let most = if self.is_f32 { "FLT_MAX" } else { "DBL_MAX" };
        let (extent, is_front) = self.guarded.promise();
        let given: Vec<&str> = [("t", info.gives.t), ("u", info.gives.uv), ("v", info.gives.uv)]
            .into_iter()
            .filter_map(|(name, is_given)| is_given.then_some(name))
            .collect();
        let mut head = String::new();
        match self.ends() {
            Some([is_bad, below, above]) => {
                head.push_str(&format!("    const {real} t_from = {below} ? -{far} : t_min;\n"));
                head.push_str(&format!("    const {real} t_to = {above} ? {far} : t_max;\n"));
                head.push_str(&format!("    if ({is_bad}) return HAIRLINE_ASK;\n"));
            }
            None => head.push_str("    (void)t_min, (void)t_max;\n"),
        }
        let body = body.replacen("    int open = 0;\n", &format!("    int open = 0;\n{head}"), 1);
        let copied: String = given
            .iter()
            .map(|name| format!("    answer->{name} = ({real})exact.{name};\n"))
            .collect();
        let ends = match extent {
            Extent::Line => "-HUGE_VAL, HUGE_VAL",
            Extent::Ray => "0, HUGE_VAL",
            Extent::Interval => "t_min, t_max",
        };
        let ends =
            if self.is_f32 { ends.replace("HUGE_VAL", "HUGE_VALF") } else { ends.to_owned() };
        let unused =
            if extent == Extent::Interval { "" } else { "    (void)t_min, (void)t_max;\n" };
        let of_front = if is_front { " || !exact.front" } else { "" };
        let inputs = format!(
            "const {real} o[3], const {real} d[3], const {real} a[3], const {real} b[3], const {real} c[3],\n    \
             {real} t_min, {real} t_max, {name}_hit *answer"
        );
        format!(
            "#ifndef {guard}
#define {guard}

#include <float.h>
#include <math.h>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) \
    || defined(__ASSOCIATIVE_MATH__)
#error \"-ffast-math changes results: compile without it, and without -ffinite-math-only and -fassociative-math\"
#endif
/* 16 and 32 are about types narrower than float. */
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 && FLT_EVAL_METHOD != 32
#error \"float and double have to be rounded to their own precision, as with -msse2 -mfpmath=sse\"
#endif

#ifndef HAIRLINE_ANSWERS
#define HAIRLINE_ANSWERS
enum {{ HAIRLINE_MISS = 0, HAIRLINE_HIT = 1, HAIRLINE_ASK = 2 }};
#endif

#ifndef HAIRLINE_SURE_{upper}
#define HAIRLINE_SURE_{upper}
/* The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0. */
static inline int hairline_sure_sign_{scalar}({real} x, {real} size, {real} factor) {{
    const {real} margin = factor * size + {tiny};
    return x > margin && x <= {most} ? 1 : x < -margin && x >= -{most} ? -1 : 0;
}}

/* The sign of an input, or of a difference of two. */
static inline int hairline_exact_sign_{scalar}({real} x) {{
    return x > 0 && x <= {most} ? 1 : x < 0 && x >= -{most} ? -1 : 0;
}}
#endif

typedef struct {{
    {real} {};
}} {name}_hit;

/* HAIRLINE_HIT, with *answer; HAIRLINE_MISS or HAIRLINE_ASK. Vectors are arrays of three: the ray o + t * d, the triangle abc. */
static inline int {name}({inputs}) {{
    const {real} SLACK = {slack};
{body}
}}

#ifdef HAIRLINE_ASK_EXACT
/* The same, 1 for a hit and 0 for a miss, with the exact test of hairline where it asks. */
#include \"hairline_exact.h\"
static inline int {name}_exact({inputs}) {{
    hairline_answer exact;
    const int found = {name}(o, d, a, b, c, t_min, t_max, answer);
    if (found != HAIRLINE_ASK) return found;
{unused}    if (!hairline_exact_{scalar}(o, d, a, b, c, {ends}, &exact){of_front}) return 0;
{copied}    return 1;
}}
#endif

#endif
",
            given.join(", ")
        )
    }

    fn rust(&self, body: &str) -> String {
        let Guarded { scale, info, .. } = self.guarded;
        let (name, real) = (function_name(self.guarded), self.language.scalar(self.is_f32));
        let [slack, tiny, far] =
            [scale.slack, scale.tiny, scale.far].map(|x| self.number(x.to_f64()));
        let mut head = String::new();
        let ends = match self.ends() {
            Some([is_bad, below, above]) => {
                head.push_str(&format!(
                    "    let t_from = if {below} {{ -{far} }} else {{ t_min }};\n"
                ));
                head.push_str(&format!(
                    "    let t_to = if {above} {{ {far} }} else {{ t_max }};\n"
                ));
                head.push_str(&format!("    if {is_bad} {{ return Answer::Ask; }}\n"));
                format!(", t_min: {real}, t_max: {real}")
            }
            None => String::new(),
        };
        let given = [("t", info.gives.t), ("u", info.gives.uv), ("v", info.gives.uv)];
        let fields: Vec<String> = given
            .iter()
            .filter(|(_, is_given)| *is_given)
            .map(|(name, _)| format!("{name}: {real}"))
            .collect();
        format!(
            "//! Where it asks, `hairline_core::truth` has the exact answer.

/// The answer to a ray and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {{
    /// The ray passes through the inside of the triangle.
    Hit {{ {} }},
    /// The ray does not meet the triangle.
    Miss,
    /// Rounding may decide.
    Ask,
}}

/// Added to sizes whose numbers may have underflowed.
const SLACK: {real} = {slack};

/// The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0.
fn sure_sign(x: {real}, size: {real}, factor: {real}) -> i32 {{
    let margin = factor * size + {tiny};
    i32::from(x > margin && x.is_finite()) - i32::from(x < -margin && x.is_finite())
}}

/// The sign of an input, or of a difference of two.
#[allow(dead_code)]
fn exact_sign(x: {real}) -> i32 {{
    i32::from(x > 0.0 && x.is_finite()) - i32::from(x < 0.0 && x.is_finite())
}}

/// The ray o + t * d and the triangle abc.
#[allow(clippy::too_many_arguments, clippy::nonminimal_bool, clippy::neg_cmp_op_on_partial_ord, clippy::neg_multiply)]
pub fn {name}(o: [{real}; 3], d: [{real}; 3], a: [{real}; 3], b: [{real}; 3], c: [{real}; 3]{ends}) -> Answer {{
{head}{body}
}}
",
            fields.join(", ")
        )
    }

    fn shader(&self, body: &str) -> String {
        let Guarded { scale, scalar, .. } = self.guarded;
        let (name, real) = (function_name(self.guarded), self.language.scalar(self.is_f32));
        let [slack, tiny, far] =
            [scale.slack, scale.tiny, scale.far].map(|x| self.number(x.to_f64()));
        let (most, zero) = (self.largest(), self.number(0.0));
        let is_wgsl = self.language == Language::Wgsl;
        let vector = match self.language {
            Language::Wgsl => "vec3f",
            Language::Hlsl => "float3",
            _ if self.is_f32 => "vec3",
            _ => "dvec3",
        };
        let vectors = ["o", "d", "a", "b", "c"];
        let beyond = |v: &str| match self.language {
            Language::Glsl => format!("any(greaterThan(abs({v}), {vector}({most})))"),
            Language::Wgsl => format!("any(abs({v}) > vec3f({most}))"),
            _ => format!("any(abs({v}) > {most})"),
        };
        let beyond = vectors.map(beyond).join(" ||\n        ");
        let mut head = format!("    if ({beyond}) {{ return HAIRLINE_ASK; }}\n");
        let declare = |name: &str, value: &str| match self.language {
            Language::Wgsl => format!("    let {name} = {value};\n"),
            _ => format!("    {real} {name} = {value};\n"),
        };
        let parameter = |name: &str, kind: &str| {
            if is_wgsl { format!("{name}: {kind}") } else { format!("{kind} {name}") }
        };
        let mut inputs: Vec<String> = vectors.iter().map(|v| parameter(v, vector)).collect();
        if let Some([is_bad, ..]) = self.ends() {
            head.push_str(&declare("t_from", &format!("max(t_min, -{far})")));
            head.push_str(&declare("t_to", &format!("min(t_max, {far})")));
            head.push_str(&format!("    if ({is_bad}) {{ return HAIRLINE_ASK; }}\n"));
            inputs.extend(["t_min", "t_max"].map(|end| parameter(end, real)));
        }
        inputs.push(if is_wgsl {
            "answer: ptr<function, vec3f>".to_owned()
        } else {
            format!("out {vector} answer")
        });
        if !is_wgsl {
            head = format!(
                "    answer = {};\n{head}",
                if self.language == Language::Hlsl {
                    "float3(0, 0, 0)".to_owned()
                } else {
                    format!("{vector}({zero})")
                }
            );
        }
        let inputs = inputs.join(", ");
        let names = [("MISS", 0), ("HIT", 1), ("ASK", 2)];
        let constants = names.map(|(name, value)| match self.language {
            Language::Wgsl => format!("const HAIRLINE_{name}: i32 = {value};"),
            Language::Hlsl => format!("static const int HAIRLINE_{name} = {value};"),
            _ => format!("const int HAIRLINE_{name} = {value};"),
        });
        let constants = constants.join("\n");
        let slack = if is_wgsl {
            format!("let SLACK = {slack};")
        } else {
            format!("const {real} SLACK = {slack};")
        };
        let (sure, exact) = if is_wgsl {
            (
                format!(
                    "fn hairline_sure_sign_{scalar}(x: {real}, size: {real}, factor: {real}) -> i32 {{\n    let margin = factor * size + {tiny};\n    return select(0, 1, x > margin) - select(0, 1, x < -margin);\n}}"
                ),
                format!(
                    "fn hairline_exact_sign_{scalar}(x: {real}) -> i32 {{\n    return select(0, 1, x > {zero}) - select(0, 1, x < {zero});\n}}"
                ),
            )
        } else {
            (
                format!(
                    "int hairline_sure_sign_{scalar}({real} x, {real} size, {real} factor) {{\n    precise {real} margin = factor * size + {tiny};\n    return x > margin ? 1 : x < -margin ? -1 : 0;\n}}"
                ),
                format!(
                    "int hairline_exact_sign_{scalar}({real} x) {{\n    return x > {zero} ? 1 : x < {zero} ? -1 : 0;\n}}"
                ),
            )
        };
        let signature = if is_wgsl {
            format!("fn {name}({inputs}) -> i32")
        } else {
            format!("int {name}({inputs})")
        };
        format!(
            "{constants}

// The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0.
{sure}

// The sign of an input, or of a difference of two.
{exact}

// The ray o + t * d and the triangle abc. A hit's t, u and v are those of *answer* where the kernel has them.
{signature} {{
    {slack}
{head}{body}
}}
"
        )
    }
}
