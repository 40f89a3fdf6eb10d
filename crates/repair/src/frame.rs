//! The frame of the body of a guarded kernel: a header comment, its function, and the functions that it calls.

use crate::arith::ScalarName;
use crate::arith::recorded::{Operation, Place};
use crate::code::Code;
use crate::contract::Extent;
use crate::language::{Dialect, Language};
use crate::nodes::names;
use crate::prove::repair::{Guarded, Margin, Scale};

/// The source of a guarded kernel; the shares of rays on which it asks, if they were counted.
pub fn source_code(guarded: &Guarded, language: Language, shares: Option<&str>) -> String {
    let dialect = Dialect {
        language,
        is_f32: guarded.scalar == ScalarName::F32,
    };
    let Scale {
        slack, tiny, far, ..
    } = guarded.scale;
    let [slack, tiny, far] = [slack, tiny, far].map(|x| dialect.number(x.to_f64()));
    let (real, name) = (dialect.scalar(), function_name(guarded));
    let frame = Frame {
        guarded,
        dialect,
        name,
        real,
        slack,
        tiny,
        far,
    };
    let shares = shares.map(|shares| format!("\n\nHow often it asks: {shares}"));
    let comment = frame.comment() + &shares.unwrap_or_default();
    let body = Code::body(guarded, dialect).join("\n");
    let marked = |mark: &str| {
        comment
            .lines()
            .map(|line| format!("{mark} {line}\n"))
            .collect::<String>()
    };
    let text = match language {
        Language::C | Language::Cuda => {
            format!(
                "/* {}\n */\n{}",
                comment.replace('\n', "\n * "),
                frame.c(&body)
            )
        }
        Language::Rust => marked("//!") + &frame.rust(&body),
        _ => marked("//") + &frame.shader(&body),
    };
    text.lines()
        .map(|line| format!("{}\n", line.trim_end()))
        .collect()
}

struct Frame<'a> {
    guarded: &'a Guarded,
    dialect: Dialect,
    /// The function's name, the scalar's, and the constants of the margins.
    name: String,
    real: &'static str,
    slack: String,
    tiny: String,
    far: String,
}

/// `moller_trumbore_f32`.
pub fn function_name(guarded: &Guarded) -> String {
    let name = guarded
        .info
        .name
        .replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    format!("{name}_{}", guarded.scalar)
}

impl Frame<'_> {
    fn comment(&self) -> String {
        let Guarded {
            info,
            scalar,
            scale,
            ..
        } = self.guarded;
        let (extent, is_front) = self.guarded.promise();
        let language = format!("{:?}", self.dialect.language).to_lowercase();
        let command = format!("hairline repair --kernel {} --scalar {scalar}", info.name);
        let between = match extent {
            Extent::Line => "at any t (t_min and t_max are not looked at)",
            Extent::Ray => "at t >= 0 (t_min and t_max are not looked at)",
            Extent::Interval => "at t_min <= t <= t_max",
        };
        let sides = if is_front { "front" } else { "both sides" };
        let digits = scale.format.digits;
        let range = match self.dialect.language.is_of_shaders() {
            false => "overflows on the way to a decision is no finite number, and asks.".to_owned(),
            true => format!(
                "overflows does not occur where coordinates are at most {}: others ask. It supposes finite inputs.
The language does not promise rounding to nearest; graphics devices that are known do so.",
                self.largest()
            ),
        };
        let fusing = self.dialect.about_fusing();
        let names = names(self.guarded);
        let margin = |(place, margin): (&Place, &Margin)| {
            let is_input = matches!(
                self.guarded.operations[*place as usize],
                Operation::Input(_)
            );
            let (name, factor) = (&names[*place as usize], margin.factor.to_f64());
            let line = format!(
                "    {name}: K = {}, factor {factor:.3e}\n",
                margin.roundings
            );
            (!is_input).then_some(line)
        };
        let margins: String = self.guarded.margins.iter().filter_map(margin).collect();
        format!(
            "{} in {scalar} with three answers: hit, miss, ask. Made by
    {command} --emit {language}
from: {}

promise: {}, {sides}
A hit is right: the ray passes through the inside of the triangle. A miss is right: it does not meet
the triangle, its edges included, {between}. Where rounding may decide, and on an edge: ask.
This holds for all finite inputs at every scale. The kernel's epsilons are gone. t, u and v are those that
the kernel computes; nothing is claimed of them, and near the ends of the range they may be infinite or NaN.

Why: a sum of products, each of which passes at most K roundings before the last sum, is off by at most
((1+u)^K - 1) times the sum of their sizes, u = 2^-{digits}. Its sign is right beyond factor * sizes; the factor
covers the rounding of the sizes too. It supposes rounding to nearest, and differences of points that are computed
as they stand here. K is that of the worst order of a sum, so sums of products may be fused and reordered;
SLACK and the margin's least size cover underflow, subnormal numbers flushed or not. Where gates in a row
want numbers to be positive, or to have the sign of another, the least of them decides: by one margin, large enough for each. What
{range}
{fusing}
{margins}Proof: {command} --certificate FILE; hairline prove --check FILE",
            info.name,
            info.source,
            extent.name()
        )
    }

    /// The largest coordinate for which nothing overflows.
    fn largest(&self) -> String {
        let most = if self.dialect.is_f32 { 126.0 } else { 1022.0 };
        let holds = |exponent: &i32| {
            let size = f64::from(*exponent);
            (0..self.guarded.operations.len())
                .all(|place| self.magnitude(place as Place, size) < most)
        };
        let exponent = (0..self.guarded.scale.far.ceil_log2())
            .rev()
            .find(holds)
            .unwrap_or(0);
        self.dialect.number(2f64.powi(exponent))
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

    /// The first lines of a kernel that promises an interval: its ends within the largest size, or it asks.
    fn head(&self) -> Option<String> {
        let far = &self.far;
        let either = |condition: String, far: String, end: &str| match self.dialect.language {
            Language::C | Language::Cuda => format!("{condition} ? {far} : {end}"),
            Language::Rust => format!("if {condition} {{ {far} }} else {{ {end} }}"),
            _ => format!(
                "{}({end}, {far})",
                if end == "t_min" { "max" } else { "min" }
            ),
        };
        let ends = [
            (
                "t_from",
                either(format!("t_min < -{far}"), format!("-{far}"), "t_min"),
            ),
            (
                "t_to",
                either(format!("t_max > {far}"), far.clone(), "t_max"),
            ),
        ];
        let is_bad = format!("!(t_min <= t_max && t_min <= {far} && t_max >= -{far})");
        let ask = match self.dialect.language {
            Language::C | Language::Cuda => format!("if ({is_bad}) return HAIRLINE_ASK;"),
            Language::Rust => format!("if {is_bad} {{ return Answer::Ask; }}"),
            _ => format!("if ({is_bad}) {{ return HAIRLINE_ASK; }}"),
        };
        let define = |(name, value): (&str, String)| match self.dialect.language {
            Language::C | Language::Cuda => format!("    const {} {name} = {value};\n", self.real),
            Language::Rust | Language::Wgsl => format!("    let {name} = {value};\n"),
            _ => format!("    {} {name} = {value};\n", self.real),
        };
        let head = format!("{}    {ask}\n", ends.map(define).concat());
        (self.guarded.promise().0 == Extent::Interval).then_some(head)
    }

    /// The values that the kernel gives of a hit.
    fn given(&self) -> Vec<&'static str> {
        let gives = self.guarded.info.gives;
        let all = [("t", gives.t), ("u", gives.uv), ("v", gives.uv)].into_iter();
        all.filter_map(|(name, is_given)| is_given.then_some(name))
            .collect()
    }

    fn c(&self, body: &str) -> String {
        let Frame {
            name,
            real,
            slack,
            tiny,
            ..
        } = self;
        let scalar = self.guarded.scalar;
        let upper = scalar.name().to_uppercase();
        let guard = format!("HAIRLINE_{}_H", name.to_uppercase());
        let (most, infinity) = if self.dialect.is_f32 {
            ("FLT_MAX", "HUGE_VALF")
        } else {
            ("DBL_MAX", "HUGE_VAL")
        };
        let (extent, is_front) = self.guarded.promise();
        let given = self.given();
        let unused = "    (void)t_min, (void)t_max;\n";
        let head = self.head().unwrap_or(unused.to_owned());
        let body = body.replacen(
            "    int open = 0;\n",
            &format!("    int open = 0;\n{head}"),
            1,
        );
        let copied = given
            .iter()
            .map(|it| format!("    answer->{it} = ({real})exact.{it};\n"));
        let copied: String = copied.collect();
        let (ends, unused) = match extent {
            Extent::Line => (format!("-{infinity}, {infinity}"), unused),
            Extent::Ray => (format!("0, {infinity}"), unused),
            Extent::Interval => ("t_min, t_max".to_owned(), ""),
        };
        let of_front = if is_front { " || !exact.front" } else { "" };
        let inputs = format!(
            "const {real} o[3], const {real} d[3], const {real} a[3], const {real} b[3], const {real} c[3],\n    \
             {real} t_min, {real} t_max, {name}_hit *answer"
        );
        let letter = if self.dialect.is_f32 { "f" } else { "d" };
        let sums = format!(
            include_str!("sums.h"),
            letter = letter,
            real = real,
            scalar = scalar,
            upper = upper
        );
        format!(
            include_str!("frame.h"),
            body = body,
            copied = copied,
            ends = ends,
            guard = guard,
            inputs = inputs,
            most = most,
            name = name,
            of_front = of_front,
            real = real,
            scalar = scalar,
            slack = slack,
            sums = sums,
            tiny = tiny,
            unused = unused,
            upper = upper,
            given = given.join(", ")
        )
    }

    fn rust(&self, body: &str) -> String {
        let Frame {
            name,
            real,
            slack,
            tiny,
            ..
        } = self;
        let head = self.head();
        let ends = head
            .as_ref()
            .map_or(String::new(), |_| format!(", t_min: {real}, t_max: {real}"));
        let head = head.unwrap_or_default();
        let fields: Vec<String> = self
            .given()
            .iter()
            .map(|name| format!("{name}: {real}"))
            .collect();
        format!(
            include_str!("frame.rust"),
            body = body,
            ends = ends,
            head = head,
            name = name,
            real = real,
            slack = slack,
            tiny = tiny,
            fields = fields.join(", ")
        )
    }

    fn shader(&self, body: &str) -> String {
        let Frame {
            name,
            real,
            slack,
            tiny,
            ..
        } = self;
        let scalar = self.guarded.scalar;
        let (most, zero) = (self.largest(), self.dialect.number(0.0));
        let is_wgsl = self.dialect.language == Language::Wgsl;
        let (vector, constant) = match self.dialect.language {
            Language::Wgsl => ("vec3f", "const HAIRLINE_$: i32"),
            Language::Hlsl => ("float3", "static const int HAIRLINE_$"),
            _ => (
                if self.dialect.is_f32 { "vec3" } else { "dvec3" },
                "const int HAIRLINE_$",
            ),
        };
        let constants = [("MISS", 0), ("HIT", 1), ("ASK", 2)]
            .map(|(name, value)| format!("{} = {value};\n", constant.replace('$', name)));
        let constants = constants.concat();
        let typed = |kind: &str, names: &[String]| -> Vec<String> {
            let one = |name: &String| match is_wgsl {
                true => format!("{name}: {kind}"),
                false => format!("{kind} {name}"),
            };
            names.iter().map(one).collect()
        };
        let function_of = |kind: &str, name: &str, inputs: Vec<String>| match is_wgsl {
            true => format!("fn {name}({}) -> {kind}", inputs.join(", ")),
            false => format!("{kind} {name}({})", inputs.join(", ")),
        };
        let integer = if is_wgsl { "i32" } else { "int" };
        let function = |name: &str, inputs| function_of(integer, name, inputs);
        let sign = |above: &str, below: &str| match is_wgsl {
            true => format!("select(0, 1, x > {above}) - select(0, 1, x < {below})"),
            false => format!("x > {above} ? 1 : x < {below} ? -1 : 0"),
        };
        let of_size = format!("hairline_margin_of_{scalar}");
        let margin = [("margin".to_owned(), format!("{of_size}(size, factor)"))];
        let margin = self.dialect.definitions(&margin);
        let of_size = function_of(
            real,
            &of_size,
            typed(real, &["size", "factor"].map(str::to_owned)),
        );
        let sure = function(
            &format!("hairline_sure_sign_{scalar}"),
            typed(real, &["x", "size", "factor"].map(str::to_owned)),
        );
        let exact = function(
            &format!("hairline_exact_sign_{scalar}"),
            typed(real, &["x".to_owned()]),
        );
        let (of_margin, of_zero) = (sign("margin", "-margin"), sign(&zero, &zero));
        let vectors = ["o", "d", "a", "b", "c"];
        let head = self.head();
        let ends: &[&str] = if head.is_some() {
            &["t_min", "t_max"]
        } else {
            &[]
        };
        let passed = |names: &[&str]| -> Vec<String> {
            let suffix = if is_wgsl { "_in" } else { "" };
            names.iter().map(|name| format!("{name}{suffix}")).collect()
        };
        let mut inputs = typed(vector, &passed(&vectors));
        inputs.extend(typed(real, &passed(ends)));
        match is_wgsl {
            true => inputs.extend(["zero: u32", "answer: ptr<function, vec3f>"].map(str::to_owned)),
            false => inputs.push(format!("out {vector} answer")),
        }
        let signature = function(name, inputs);
        let beyond = vectors.map(|v| match self.dialect.language {
            Language::Glsl => format!("any(greaterThan(abs({v}), {vector}({most})))"),
            Language::Wgsl => format!("any(abs({v}) > vec3f({most}))"),
            _ => format!("any(abs({v}) > {most})"),
        });
        let beyond = beyond.join(" ||\n        ");
        let head = head.unwrap_or_default();
        let (slack, start) = match self.dialect.language {
            Language::Wgsl => (format!("let SLACK = {slack};"), hidden(&vectors, ends)),
            Language::Hlsl => (
                format!("const {real} SLACK = {slack};"),
                "    answer = float3(0, 0, 0);\n".to_owned(),
            ),
            _ => (
                format!("const {real} SLACK = {slack};"),
                format!("    answer = {vector}({zero});\n"),
            ),
        };
        format!(
            "{constants}
// How far from zero a number must be for its sign to be right.
{of_size} {{
    return factor * size + {tiny};
}}

// The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0.
{sure} {{
    {margin}
    return {of_margin};
}}

// The sign of an input, or of a difference of two.
{exact} {{
    return {of_zero};
}}

// The ray o + t * d and the triangle abc. A hit's t, u and v are those of *answer* where the kernel has them.
{signature} {{
    {slack}
{start}    if ({beyond}) {{ return HAIRLINE_ASK; }}
{head}{body}
}}
"
        )
    }
}

/// The inputs of a function in WGSL, by their names, in a form that no compiler knows.
fn hidden(vectors: &[&str], numbers: &[&str]) -> String {
    let vectors = vectors
        .iter()
        .map(|v| format!("    let {v} = bitcast<vec3f>(bitcast<vec3u>({v}_in) ^ vec3u(zero));\n"));
    let numbers = numbers
        .iter()
        .map(|x| format!("    let {x} = bitcast<f32>(bitcast<u32>({x}_in) ^ zero);\n"));
    vectors.chain(numbers).collect()
}
