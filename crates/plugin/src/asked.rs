//! The targets whose kernels may run in processes of their own, and how their cases go there.

#![forbid(unsafe_code)]

use crate::arith::Float;
use crate::case::{Case, Target, Triangles};
use crate::corpus::lines::bare_case;
use hairline_boxes::{BoxCase, Boxes};

/// How cases of a target go to a process.
#[derive(Debug)]
pub struct Form {
    /// The target, in a word of a hello.
    pub judges: &'static str,
    /// The functions of a library that answer cases, in `f32` and in `f64`.
    pub functions: [&'static str; 2],
    /// The command that explains a case.
    pub explain: &'static str,
    /// The numbers of a plain case, a hit in the middle.
    pub plain: &'static [f64],
}

/// A target whose kernels may run in processes of their own.
pub trait Asked: Target {
    /// How its cases go there.
    const FORM: Form;

    /// The numbers of a case, in the order in which they go there.
    fn numbers<F: Float>(case: &Self::Case<F>) -> impl AsRef<[F]>;

    /// A case as its `explain` takes it.
    fn shown<F: Float>(case: &Self::Case<F>) -> String;
}

impl Asked for Triangles {
    #[rustfmt::skip]
    const FORM: Form = Form {
        judges: "triangles",
        functions: ["hairline_test_f32", "hairline_test_f64"],
        explain: "hairline explain",
        plain: &[
            0.3, 0.3, 1.0,  0.0, 0.0, -1.0,
            0.0, 0.0, 0.0,  1.0, 0.0, 0.0,  0.0, 1.0, 0.0,
            0.0, f64::INFINITY,
        ],
    };

    fn numbers<F: Float>(case: &Case<F>) -> impl AsRef<[F]> {
        case.numbers()
    }

    fn shown<F: Float>(case: &Case<F>) -> String {
        bare_case(*case)
    }
}

impl Asked for Boxes {
    #[rustfmt::skip]
    const FORM: Form = Form {
        judges: "boxes",
        functions: ["hairline_test_boxes_f32", "hairline_test_boxes_f64"],
        explain: "hairline boxes explain",
        plain: &[
            0.3, 0.3, 2.0,  0.0, 0.0, -1.0,
            0.0, 0.0, 0.0,  1.0, 1.0, 1.0,
            0.0, f64::INFINITY,
        ],
    };

    fn numbers<F: Float>(case: &BoxCase<F>) -> impl AsRef<[F]> {
        case.numbers()
    }

    fn shown<F: Float>(case: &BoxCase<F>) -> String {
        case.json()
    }
}
