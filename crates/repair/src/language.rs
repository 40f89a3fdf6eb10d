//! The languages that guarded kernels are written in.

named! {
    pub names
    /// A language.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Language {
        /// C99, C++17, and CUDA.
        C = "c",
        /// The same in a file that CUDA includes.
        Cuda = "cuda",
        /// Rust.
        Rust = "rust",
        /// The OpenGL shading language, 4.00 and later.
        Glsl = "glsl",
        /// The WebGPU shading language.
        Wgsl = "wgsl",
        /// The high-level shading language of Direct3D.
        Hlsl = "hlsl",
    }
}

use Language::{C, Cuda, Glsl, Hlsl, Rust, Wgsl};

impl Language {
    /// True if it runs on GPUs: infinities are not sure to exist there.
    pub fn is_of_shaders(self) -> bool {
        matches!(self, Glsl | Wgsl | Hlsl)
    }

    /// The end of a file's name.
    pub fn extension(self) -> &'static str {
        match self {
            C => "h",
            Cuda => "cuh",
            Rust => "rs",
            Glsl => "glsl",
            Wgsl => "wgsl",
            Hlsl => "hlsl",
        }
    }
}

/// An expression, by how tightly it binds.
pub enum Expression {
    /// A sum or a difference.
    Sum(String),
    /// A product, a quotient or a negative number.
    Product(String),
    /// A name, a literal or a call.
    Name(String),
}

impl Expression {
    pub fn text(self) -> String {
        match self {
            Expression::Sum(text) | Expression::Product(text) | Expression::Name(text) => text,
        }
    }
}

/// A language, and the scalar of a kernel in it.
#[derive(Clone, Copy)]
pub struct Dialect {
    pub language: Language,
    pub is_f32: bool,
}

impl Dialect {
    /// The type of a scalar.
    pub fn scalar(self) -> &'static str {
        match (self.language, self.is_f32) {
            (Rust | Wgsl, true) => "f32",
            (Rust | Wgsl, false) => "f64",
            (_, true) => "float",
            (_, false) => "double",
        }
    }

    /// A number, so that it is read as the same one.
    pub fn number(self, x: f64) -> String {
        let text = if self.is_f32 {
            format!("{:?}", x as f32)
        } else {
            format!("{x:?}")
        };
        match (self.language, self.is_f32) {
            (C | Cuda | Hlsl, true) => format!("{text}f"),
            (Wgsl, _) => format!("{text}f"),
            (Glsl, false) => format!("{text}lf"),
            _ => text,
        }
    }

    pub fn coordinate(self, vector: &str, axis: usize) -> String {
        match self.language {
            C | Cuda | Rust => format!("{vector}[{axis}]"),
            _ => format!("{vector}.{}", ["x", "y", "z"][axis]),
        }
    }

    pub fn abs(self, x: &str) -> String {
        match (self.language, self.is_f32) {
            (C | Cuda, true) => format!("fabsf({x})"),
            (C | Cuda, false) => format!("fabs({x})"),
            (Rust, _) => format!("({x}).abs()"),
            _ => format!("abs({x})"),
        }
    }

    /// A sum or a difference with an input among its terms. C has functions for it, which a product that the caller passes
    /// is not fused into.
    pub fn sum_of_input(self, sign: &str, [x, y]: [&str; 2]) -> Expression {
        let name = if sign == "+" { "sum" } else { "difference" };
        match self.language {
            C | Cuda => Expression::Name(format!("{}({x}, {y})", self.function(name))),
            _ => Expression::Sum(format!("{x} {sign} {y}")),
        }
    }

    /// How a product that the caller passes is kept from being fused into a difference here.
    pub fn about_fusing(self) -> &'static str {
        match self.language {
            C | Cuda => {
                "An input may be a product of the caller's: sums of inputs are functions, into which no compiler fuses it."
            }
            Glsl | Hlsl => {
                "An input may be a product of the caller's: `precise` keeps a compiler from fusing it into a difference here."
            }
            Rust => "An input may be a product of the caller's: Rust fuses no product into a sum.",
            Wgsl => {
                "An input may be a product of the caller's: the bits of each are combined with `zero`, so that no compiler
fuses it into a difference here. Read `zero` from a uniform or a storage buffer that has a 0 in it: a literal, a constant
and an override are known to the compiler."
            }
        }
    }

    pub fn sqrt(self, x: &str) -> String {
        match (self.language, self.is_f32) {
            (C | Cuda, true) => format!("sqrtf({x})"),
            (Rust, _) => format!("({x}).sqrt()"),
            _ => format!("sqrt({x})"),
        }
    }

    /// The least of some numbers, or the most.
    pub fn extreme(self, name: &str, numbers: Vec<String>) -> String {
        let function = match (self.language.is_of_shaders(), name) {
            (true, "lesser") => "min".to_owned(),
            (true, _) => "max".to_owned(),
            _ => self.function(name),
        };
        let all = numbers.into_iter();
        let of_two = |all: String, next: String| format!("{function}({all}, {next})");
        all.reduce(of_two).unwrap_or_default()
    }

    /// A product of integers as a number of the scalar's type.
    pub fn real(self, product: &str) -> String {
        let scalar = self.scalar();
        match self.language {
            C | Cuda if product.contains(' ') => format!("({scalar})({product})"),
            C | Cuda => format!("({scalar}){product}"),
            Rust => format!("{scalar}::from({product})"),
            _ => format!("{scalar}({product})"),
        }
    }

    /// Asks unless a number is finite. Shaders have asked already where one might not be.
    pub fn unless_finite(self, x: &str) -> Option<String> {
        let most = if self.is_f32 { "FLT_MAX" } else { "DBL_MAX" };
        let is_infinite = match self.language {
            C | Cuda => format!("!({} <= {most})", self.abs(x)),
            Rust => format!("!({x}).is_finite()"),
            _ => return None,
        };
        Some(self.early(&is_infinite, "ASK"))
    }

    /// Definitions of numbers, on one line.
    pub fn definitions(self, all: &[(String, String)]) -> String {
        let scalar = self.scalar();
        let all: Vec<String> = all
            .iter()
            .map(|(name, text)| format!("{name} = {text}"))
            .collect();
        match self.language {
            C | Cuda => format!("const {scalar} {};", all.join(", ")),
            Glsl | Hlsl => format!("precise {scalar} {};", all.join(", ")),
            Rust | Wgsl => format!("let {};", all.join("; let ")),
        }
    }

    pub fn integer(self, name: &str, text: &str) -> String {
        match self.language {
            C | Cuda => format!("const int {name} = {text};"),
            Glsl | Hlsl => format!("int {name} = {text};"),
            Rust | Wgsl => format!("let {name} = {text};"),
        }
    }

    /// The variable that says whether a gate could not decide.
    pub fn open(self) -> &'static str {
        match self.language {
            C | Cuda => "int open = 0;",
            Glsl | Hlsl => "bool open = false;",
            Rust => "let mut open = false;",
            Wgsl => "var open = false;",
        }
    }

    /// It is open unless a condition holds.
    pub fn assign_open(self, condition: &str) -> String {
        match (self.language, condition) {
            (C | Cuda, "") => "open = 1;".to_owned(),
            (_, "") => "open = true;".to_owned(),
            (C | Cuda | Rust, _) => format!("open |= !({condition});"),
            _ => format!("open = open || !({condition});"),
        }
    }

    pub fn if_(self, condition: &str) -> String {
        match self.language {
            Rust => format!("if {condition} {{"),
            _ => format!("if ({condition}) {{"),
        }
    }

    /// Returns an answer if a condition holds.
    pub fn early(self, condition: &str, answer: &str) -> String {
        match self.language {
            C | Cuda | Glsl | Hlsl => format!("if ({condition}) {}", self.answer(answer)),
            Rust | Wgsl => format!("{} {} }}", self.if_(condition), self.answer(answer)),
        }
    }

    /// Returns an answer without values.
    pub fn answer(self, answer: &str) -> String {
        match (self.language, answer) {
            (Rust, "MISS") => "return Answer::Miss;".to_owned(),
            (Rust, _) => "return Answer::Ask;".to_owned(),
            _ => format!("return HAIRLINE_{answer};"),
        }
    }

    /// Returns a hit with its t, u and v.
    pub fn hit(self, values: &[Option<String>]) -> Vec<String> {
        // Shaders have the three in a vector.
        let names = [("t", "x"), ("u", "y"), ("v", "z")].into_iter();
        let given = names
            .zip(values)
            .filter_map(|(names, text)| Some((names, text.as_ref()?)));
        if self.language == Rust {
            let field = |((name, _), text): ((&str, _), &String)| match name == text {
                true => name.to_owned(),
                false => format!("{name}: {text}"),
            };
            let fields: Vec<String> = given.map(field).collect();
            return vec![format!("Answer::Hit {{ {} }}", fields.join(", "))];
        }
        let set = |((name, axis), text): ((&str, &str), &String)| match self.language {
            C | Cuda => format!("answer->{name} = {text};"),
            Wgsl => format!("(*answer).{axis} = {text};"),
            _ => format!("answer.{axis} = {text};"),
        };
        let mut lines: Vec<String> = given.map(set).collect();
        lines.push("return HAIRLINE_HIT;".to_owned());
        lines
    }

    /// The variables that name the axes.
    pub fn axes(self) -> &'static str {
        match self.language {
            C | Cuda | Glsl | Hlsl => "int x, y, z;",
            Rust => "let (x, y, z): (usize, usize, usize);",
            Wgsl => "var x: i32; var y: i32; var z: i32;",
        }
    }

    /// The name of a function that several kernels share.
    pub fn function(self, name: &str) -> String {
        match self.language {
            Rust => name.to_owned(),
            _ => format!(
                "hairline_{name}_{}",
                if self.is_f32 { "f32" } else { "f64" }
            ),
        }
    }

    /// A line's comment after `//`.
    pub fn comment(self, line: &str) -> String {
        match self.language {
            C | Cuda => format!("{} */", line.replacen("//", "/*", 1)),
            _ => line.to_owned(),
        }
    }
}
