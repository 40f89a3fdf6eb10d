//! The expressions, in WGSL, and evaluations of them that compilers choose. Floats of Rust are IEEE 754, operation by operation.

/// How many numbers an expression may use: `a` to `h`; the vectors x = (a, b, c), y = (d, e, f), z = (g, h, a).
pub const INPUTS: usize = 8;

pub type Numbers = [f32; INPUTS];

/// A name, and what it does.
pub type Evaluation = (&'static str, fn(Numbers) -> f32);

/// An expression with its evaluations.
pub struct Expression {
    pub wgsl: &'static str,
    pub evaluations: &'static [Evaluation],
}

fn fma(a: f32, b: f32, c: f32) -> f32 {
    a.mul_add(b, c)
}

/// An order of the three products of a dot product.
type DotOrder = fn([f32; 3], [f32; 3]) -> f32;

const AS_WRITTEN: &str = "as written, each operation rounded";

fn dot_as_written([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> f32 {
    (a * d + b * e) + c * f
}

fn dot_from_the_end([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> f32 {
    a * d + (b * e + c * f)
}

fn dot_z_outermost([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> f32 {
    fma(c, f, fma(b, e, a * d))
}

fn dot_x_outermost([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> f32 {
    fma(a, d, fma(b, e, c * f))
}

fn dot_y_innermost([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> f32 {
    fma(c, f, fma(a, d, b * e))
}

fn x_y([a, b, c, d, e, f, ..]: Numbers) -> [[f32; 3]; 2] {
    [[a, b, c], [d, e, f]]
}

fn determinant(numbers: Numbers, cross: fn([f32; 4]) -> f32, dot: DotOrder) -> f32 {
    let [a, b, c, d, e, f, g, h] = numbers;
    let [y, z] = [[d, e, f], [g, h, a]];
    let normal = [0, 1, 2].map(|axis| {
        let [p, q] = [(axis + 1) % 3, (axis + 2) % 3];
        cross([y[p], z[q], z[p], y[q]])
    });
    dot([a, b, c], normal)
}

/// p q - r s.
fn minor_as_written([p, q, r, s]: [f32; 4]) -> f32 {
    p * q - r * s
}

fn minor_left_fused([p, q, r, s]: [f32; 4]) -> f32 {
    fma(p, q, -(r * s))
}

fn minor_right_fused([p, q, r, s]: [f32; 4]) -> f32 {
    fma(-r, s, p * q)
}

pub const EXPRESSIONS: &[Expression] = &[
    Expression {
        wgsl: "a * b + c",
        evaluations: &[
            (AS_WRITTEN, |[a, b, c, ..]| a * b + c),
            ("fused", |[a, b, c, ..]| fma(a, b, c)),
        ],
    },
    Expression {
        wgsl: "fma(a, b, c)",
        evaluations: &[
            ("fused", |[a, b, c, ..]| fma(a, b, c)),
            ("two roundings", |[a, b, c, ..]| a * b + c),
        ],
    },
    Expression {
        wgsl: "a * b + c * d",
        evaluations: &[
            (AS_WRITTEN, |[a, b, c, d, ..]| a * b + c * d),
            ("left product fused", |[a, b, c, d, ..]| fma(a, b, c * d)),
            ("right product fused", |[a, b, c, d, ..]| fma(c, d, a * b)),
        ],
    },
    Expression {
        wgsl: "a * b - c * d",
        evaluations: &[
            (AS_WRITTEN, |[a, b, c, d, ..]| {
                minor_as_written([a, b, c, d])
            }),
            ("left product fused", |[a, b, c, d, ..]| {
                minor_left_fused([a, b, c, d])
            }),
            ("right product fused", |[a, b, c, d, ..]| {
                minor_right_fused([a, b, c, d])
            }),
        ],
    },
    Expression {
        wgsl: "cross(x, y).x",
        evaluations: &[
            (AS_WRITTEN, |[_, b, c, _, e, f, ..]| {
                minor_as_written([b, f, c, e])
            }),
            ("left product fused", |[_, b, c, _, e, f, ..]| {
                minor_left_fused([b, f, c, e])
            }),
            ("right product fused", |[_, b, c, _, e, f, ..]| {
                minor_right_fused([b, f, c, e])
            }),
        ],
    },
    Expression {
        wgsl: "dot(x, y)",
        evaluations: DOT,
    },
    Expression {
        wgsl: "a * d + b * e + c * f",
        evaluations: DOT,
    },
    Expression {
        wgsl: "dot(x, cross(y, z))",
        evaluations: &[
            (AS_WRITTEN, |it| {
                determinant(it, minor_as_written, dot_as_written)
            }),
            ("left products fused, z outermost", |it| {
                determinant(it, minor_left_fused, dot_z_outermost)
            }),
            ("left products fused, x outermost", |it| {
                determinant(it, minor_left_fused, dot_x_outermost)
            }),
            ("right products fused, z outermost", |it| {
                determinant(it, minor_right_fused, dot_z_outermost)
            }),
            ("right products fused, x outermost", |it| {
                determinant(it, minor_right_fused, dot_x_outermost)
            }),
        ],
    },
    Expression {
        wgsl: "a / b",
        evaluations: &[
            ("rounded correctly", |[a, b, ..]| a / b),
            ("a * (1 / b)", |[a, b, ..]| a * (1.0 / b)),
        ],
    },
    Expression {
        wgsl: "1.0 / a",
        evaluations: &[("rounded correctly", |[a, ..]| 1.0 / a)],
    },
    Expression {
        wgsl: "sqrt(abs(a))",
        evaluations: &[("rounded correctly", |[a, ..]| a.abs().sqrt())],
    },
    Expression {
        wgsl: "inverseSqrt(abs(a))",
        evaluations: &[
            ("rounded correctly", |[a, ..]| {
                // Doubles are wide enough to round once.
                (1.0 / f64::from(a.abs()).sqrt()) as f32
            }),
            ("1 / sqrt", |[a, ..]| 1.0 / a.abs().sqrt()),
        ],
    },
    Expression {
        wgsl: "length(x)",
        evaluations: &[
            (AS_WRITTEN, |[a, b, c, ..]| {
                dot_as_written([a, b, c], [a, b, c]).sqrt()
            }),
            ("z outermost, fused", |[a, b, c, ..]| {
                dot_z_outermost([a, b, c], [a, b, c]).sqrt()
            }),
            ("y * y innermost, fused", |[a, b, c, ..]| {
                dot_y_innermost([a, b, c], [a, b, c]).sqrt()
            }),
        ],
    },
    Expression {
        wgsl: "a * h + b * h",
        evaluations: &[
            (AS_WRITTEN, |[a, b, .., h]| a * h + b * h),
            ("(a + b) * h", |[a, b, .., h]| (a + b) * h),
            ("left product fused", |[a, b, .., h]| fma(a, h, b * h)),
            ("right product fused", |[a, b, .., h]| fma(b, h, a * h)),
        ],
    },
    Expression {
        wgsl: "a * h - b * h",
        evaluations: &[
            (AS_WRITTEN, |[a, b, .., h]| a * h - b * h),
            ("(a - b) * h", |[a, b, .., h]| (a - b) * h),
            ("left product fused", |[a, b, .., h]| fma(a, h, -(b * h))),
            ("right product fused", |[a, b, .., h]| fma(-b, h, a * h)),
        ],
    },
    Expression {
        wgsl: "c - (a * h + b * h)",
        evaluations: &[
            (AS_WRITTEN, |[a, b, c, .., h]| c - (a * h + b * h)),
            ("c - (a + b) * h", |[a, b, c, .., h]| c - (a + b) * h),
            ("c - (a + b) * h, fused", |[a, b, c, .., h]| {
                fma(-(a + b), h, c)
            }),
            ("c - a * h - b * h, fused", |[a, b, c, .., h]| {
                c - fma(a, h, b * h)
            }),
        ],
    },
    Expression {
        wgsl: "a * h + h",
        evaluations: &[
            (AS_WRITTEN, |[a, .., h]| a * h + h),
            ("(a + 1) * h", |[a, .., h]| (a + 1.0) * h),
            ("fused", |[a, .., h]| fma(a, h, h)),
        ],
    },
    Expression {
        wgsl: "(a - b) + b",
        evaluations: &[(AS_WRITTEN, |[a, b, ..]| (a - b) + b), ("a", |[a, ..]| a)],
    },
    Expression {
        wgsl: "a - (a + b)",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| a - (a + b)),
            ("-b", |[_, b, ..]| -b),
        ],
    },
    Expression {
        wgsl: "(a - b) - a",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| (a - b) - a),
            ("-b", |[_, b, ..]| -b),
        ],
    },
    Expression {
        wgsl: "a - (b + a)",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| a - (b + a)),
            ("-b", |[_, b, ..]| -b),
        ],
    },
    Expression {
        wgsl: "a - (a - b)",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| a - (a - b)),
            ("b", |[_, b, ..]| b),
        ],
    },
    Expression {
        wgsl: "(a + b) - a",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| (a + b) - a),
            ("b", |[_, b, ..]| b),
        ],
    },
    Expression {
        wgsl: "(a * b) / b",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| (a * b) / b),
            ("a * b * (1 / b)", |[a, b, ..]| (a * b) * (1.0 / b)),
            ("a", |[a, ..]| a),
        ],
    },
    Expression {
        // The rounding error of a sum (Knuth).
        wgsl: "(a - ((a + b) - ((a + b) - a))) + (b - ((a + b) - a))",
        evaluations: &[
            (AS_WRITTEN, |[a, b, ..]| {
                let sum = a + b;
                let of_b = sum - a;
                (a - (sum - of_b)) + (b - of_b)
            }),
            ("0", |_| 0.0),
        ],
    },
];

const DOT: &[Evaluation] = &[
    (AS_WRITTEN, |it| with(it, dot_as_written)),
    ("from the end, each operation rounded", |it| {
        with(it, dot_from_the_end)
    }),
    ("fma(z, fma(y, x))", |it| with(it, dot_z_outermost)),
    ("fma(x, fma(y, z))", |it| with(it, dot_x_outermost)),
    ("fma(z, fma(x, y))", |it| with(it, dot_y_innermost)),
];

fn with(numbers: Numbers, dot: DotOrder) -> f32 {
    let [x, y] = x_y(numbers);
    dot(x, y)
}

/// Expressions whose exact results are subnormal numbers, for a subnormal `a`, b = 1.25·2^-100, c = 1.5·2^-40 and d = 1.
pub const SUBNORMAL: &[&str] = &[
    "a + a",
    "a * d",
    "a - 0.0",
    "abs(a)",
    "max(a, 0.0)",
    "b * c",
    "b * c + a",
    "fma(b, c, a)",
    "b / 1.2e12",
    "select(0.0, 1.0, a > 0.0)",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signature::generic;

    /// The evaluations of an expression differ on the numbers that devices get, so that a device's results tell them apart.
    #[test]
    fn evaluations_differ() {
        for expression in EXPRESSIONS {
            let results = |evaluate: fn(Numbers) -> f32| -> Vec<f32> {
                (0..1000).map(|index| evaluate(generic(index))).collect()
            };
            for (place, (name, evaluate)) in expression.evaluations.iter().enumerate() {
                for (other, other_evaluate) in &expression.evaluations[..place] {
                    let [these, those] = [*evaluate, *other_evaluate].map(results);
                    assert_ne!(these, those, "{}: {name}, {other}", expression.wgsl);
                }
            }
        }
    }
}
