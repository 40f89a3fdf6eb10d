//! The advice as code to paste, in the language of a kernel.

use super::answer::is_scale_free_better;
use super::record::*;
use super::standing::standing;
use super::words::of_unit;
use crate::arith::ScalarName;
use std::io::{self, Write};

/// A language of kernels.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum SnippetLanguage {
    C,
    Rust,
    Glsl,
}

/// Writes the numbers of each kernel as constants, each with the comparison that takes it.
pub(super) fn write(
    record: &SceneResult,
    language: SnippetLanguage,
    out: &mut dyn Write,
) -> io::Result<()> {
    for (i, part) in record.kernels.iter().enumerate() {
        if 0 < i {
            writeln!(out)?;
        }
        writeln!(
            out,
            "// {} {} in {}{}",
            part.kernel,
            part.scalar,
            record.scene,
            of_unit(&record.unit)
        )?;
        writeln!(out, "// {}", standing(record, part).1)?;
        let relative = part
            .relative
            .as_ref()
            .filter(|_| is_scale_free_better(record, part));
        let follows = relative.is_some();
        let tried = relative.unwrap_or(&part.tried[0]);
        for (knob, value) in part.knobs.iter().zip(&tried.epsilons) {
            let form = knob
                .form
                .as_ref()
                .filter(|_| follows && value.parse() != Ok(0.0));
            writeln!(
                out,
                "{}",
                constant(language, part.scalar, knob, value, form)
            )?;
        }
        if follows {
            writeln!(
                out,
                "// L: the triangle's longest edge; M: the largest coordinate"
            )?;
        }
    }
    Ok(())
}

fn name(knob: &KnobPart) -> String {
    let name = knob.name.to_uppercase().replace('-', "_");
    if knob.is_gate {
        format!("{name}_EPSILON")
    } else {
        name
    }
}

/// One number with its comparison, as the kernel's listing has it; with what it is multiplied by, if its form says.
fn constant(
    language: SnippetLanguage,
    scalar: ScalarName,
    knob: &KnobPart,
    value: &str,
    form: Option<&String>,
) -> String {
    let name = name(knob);
    let compared = form.map_or(name.clone(), |form| form.replacen('e', &name, 1));
    let comparison = match knob.printed.as_ref().or(knob.refuses.as_ref()) {
        Some(refuses) => format!("refuse where {}", with_name(refuses, &compared)),
        None => format!("count a hit only where t >= {compared}"),
    };
    // C, GLSL and Rust all want a point or an exponent in a float.
    let is_float = value.contains(['.', 'e', 'E']);
    let number = if is_float {
        value.to_owned()
    } else {
        format!("{value}.0")
    };
    let constant = match (language, scalar) {
        (SnippetLanguage::C, ScalarName::F32) => format!("static const float {name} = {number}f;"),
        (SnippetLanguage::C, _) => format!("static const double {name} = {number};"),
        (SnippetLanguage::Rust, scalar) => format!("const {name}: {scalar} = {number};"),
        (SnippetLanguage::Glsl, ScalarName::F32) => format!("const float {name} = {number};"),
        (SnippetLanguage::Glsl, _) => format!("const double {name} = {number}lf;"),
    };
    format!("{constant}  // {comparison}")
}

/// A comparison with the epsilon's name in the place of `e`.
fn with_name(comparison: &str, name: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut text = String::new();
    let mut word = String::new();
    for c in comparison.chars().chain([' ']) {
        if is_word(c) {
            word.push(c);
            continue;
        }
        text += if word == "e" { name } else { &word };
        word.clear();
        text.push(c);
    }
    text.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Dimension, Role};

    #[test]
    fn an_epsilon_has_its_name_where_the_comparison_has_it() {
        let text = with_name("det > -e && edge_e < e", "PARALLEL_EPSILON");
        assert_eq!(text, "det > -PARALLEL_EPSILON && edge_e < PARALLEL_EPSILON");
        let knob = KnobPart {
            name: "parallel".to_owned(),
            is_gate: true,
            role: Role::Parallel,
            refuses: Some("abs(det) < e".to_owned()),
            printed: Some("det > -e && det < e".to_owned()),
            dimension: Dimension::DETERMINANT,
            form: None,
        };
        let of = |language, scalar| constant(language, scalar, &knob, "5e-10", None);
        let comparison = "  // refuse where det > -PARALLEL_EPSILON && det < PARALLEL_EPSILON";
        assert_eq!(
            of(SnippetLanguage::C, ScalarName::F32),
            format!("static const float PARALLEL_EPSILON = 5e-10f;{comparison}")
        );
        assert_eq!(
            of(SnippetLanguage::Rust, ScalarName::F64),
            format!("const PARALLEL_EPSILON: f64 = 5e-10;{comparison}")
        );
        let form = "e * L^4".to_owned();
        let text = constant(
            SnippetLanguage::C,
            ScalarName::F32,
            &knob,
            "-2e-3",
            Some(&form),
        );
        assert!(text.ends_with("det < PARALLEL_EPSILON * L^4"), "{text}");
        let least = KnobPart {
            name: "t_min".to_owned(),
            is_gate: false,
            refuses: None,
            printed: None,
            ..knob.clone()
        };
        let text = constant(SnippetLanguage::Glsl, ScalarName::F32, &least, "0", None);
        assert_eq!(
            text,
            "const float T_MIN = 0.0;  // count a hit only where t >= T_MIN"
        );
    }
}
