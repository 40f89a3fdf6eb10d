//! What stands in place of operators, of numbers, and of a function's body.

use syn::{BinOp, Lit, ReturnType, Type};

/// What an operator is exchanged for.
pub fn instead_of(op: &BinOp) -> &'static [&'static str] {
    match op {
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) => &["+", "/"],
        BinOp::Mul(_) => &["+", "/"],
        BinOp::Div(_) => &["*", "%"],
        BinOp::Rem(_) => &["*", "/"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::BitXor(_) => &["|", "&"],
        BinOp::BitAnd(_) => &["|", "^"],
        BinOp::BitOr(_) => &["&", "^"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &["<=", ">"],
        BinOp::Le(_) => &["<", ">"],
        BinOp::Gt(_) => &[">=", "<"],
        BinOp::Ge(_) => &[">", "<"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) => &["+=", "/="],
        BinOp::MulAssign(_) => &["+=", "/="],
        BinOp::DivAssign(_) => &["*=", "%="],
        BinOp::RemAssign(_) => &["*=", "/="],
        BinOp::BitXorAssign(_) => &["|=", "&="],
        BinOp::BitAndAssign(_) => &["|=", "^="],
        BinOp::BitOrAssign(_) => &["&=", "^="],
        BinOp::ShlAssign(_) => &[">>="],
        BinOp::ShrAssign(_) => &["<<="],
        _ => &[],
    }
}

/// What a function may return at once.
pub fn defaults(output: &ReturnType) -> Vec<String> {
    match output {
        ReturnType::Default => vec![String::new()],
        ReturnType::Type(_, found) => values(found),
    }
}

fn values(found: &Type) -> Vec<String> {
    let texts: &[&str] = match found {
        Type::Tuple(tuple) if tuple.elems.is_empty() => &["()"],
        Type::Reference(reference) if last_name(&reference.elem) == "str" => &["\"\"", "\"xyzzy\""],
        Type::Path(_) => match last_name(found).as_str() {
            "bool" => &["true", "false"],
            "f32" | "f64" => &["0.0", "1.0", "-1.0"],
            "String" => &["String::new()", "\"xyzzy\".into()"],
            "Ordering" => &[
                "std::cmp::Ordering::Less",
                "std::cmp::Ordering::Equal",
                "std::cmp::Ordering::Greater",
            ],
            "Option" => &["None"],
            "Vec" => &["vec![]"],
            "Result" => match argument(found) {
                Some(inner) => return values(inner).iter().map(|v| format!("Ok({v})")).collect(),
                None => &["Ok(())"],
            },
            name if is_integer(name) => &["0", "1"],
            _ => &[],
        },
        _ => &[],
    };
    texts.iter().map(|text| (*text).to_owned()).collect()
}

/// The first type argument, as T of `Result<T, E>`.
fn argument(found: &Type) -> Option<&Type> {
    let Type::Path(path) = found else { return None };
    let syn::PathArguments::AngleBracketed(list) = &path.path.segments.last()?.arguments else {
        return None;
    };
    list.args.iter().find_map(|argument| match argument {
        syn::GenericArgument::Type(found) => Some(found),
        _ => None,
    })
}

/// The name of a type without its path and arguments.
pub fn last_name(found: &Type) -> String {
    match found {
        Type::Path(path) => path
            .path
            .segments
            .last()
            .map(|s| s.ident.to_string())
            .unwrap_or_default(),
        Type::Reference(reference) => last_name(&reference.elem),
        _ => String::new(),
    }
}

pub fn is_integer(name: &str) -> bool {
    let Some(rest) = name.strip_prefix(['i', 'u']) else {
        return false;
    };
    rest == "size" || rest.parse::<u32>().is_ok()
}

/// What stands in place of a literal.
pub fn other_literals(literal: &Lit) -> Vec<String> {
    match literal {
        Lit::Bool(was) => vec![(!was.value).to_string()],
        Lit::Int(was) => {
            let value: Option<u128> = was.base10_parse().ok();
            let others = value.map(|value| [value.checked_add(1), value.checked_sub(1)]);
            let others = others.into_iter().flatten().flatten();
            others
                .map(|other| format!("{other}{}", was.suffix()))
                .collect()
        }
        Lit::Float(was) => {
            let others = match was.base10_parse::<f64>() {
                Ok(0.0) => vec![1.0],
                Ok(value) => vec![2.0 * value, value / 1024.0],
                Err(_) => vec![],
            };
            others
                .into_iter()
                .map(|other| format!("{other:?}{}", was.suffix()))
                .collect()
        }
        _ => vec![],
    }
}

/// Whether an operator stores its result.
pub fn is_assignment(op: &BinOp) -> bool {
    use BinOp::{Eq, Ge, Gt, Le, Lt, Ne};
    let compares = matches!(op, Eq(_) | Ne(_) | Lt(_) | Le(_) | Gt(_) | Ge(_));
    !compares && instead_of(op).iter().any(|other| other.ends_with('='))
}
