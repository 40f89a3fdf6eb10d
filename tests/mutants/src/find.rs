//! Finds what can be changed in a file: each site is a span of its text, with the texts that may stand there instead.

use crate::changes::{defaults, instead_of, is_assignment, is_integer, last_name, other_literals};
use proc_macro2::Span;
use std::collections::HashMap;
use std::ops::Range;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Block, Expr, Stmt, Token, Type, UnOp};

/// What breaking a line adds, and what stands there in one that is whole.
const BROKEN: [(&str, &str); 6] = [
    (" .", "."),
    ("( ", "("),
    (", )", ")"),
    (" )", ")"),
    (", }", " }"),
    (", ]", "]"),
];

/// One change of one place.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// From 1 on, over all files.
    pub id: u32,
    /// The site at which it is chosen.
    pub site: u32,
    pub file: String,
    pub line: usize,
    pub column: usize,
    /// The function with its type, `Type::name`.
    pub function: String,
    /// What is changed, for example `replace < with <=`.
    pub change: String,
    /// The expression that is changed, or around what is changed.
    pub source: String,
    /// How many mutants before this one have the same file, function, change and source.
    pub nth: usize,
    /// What stands at the site's place instead.
    pub text: String,
}

impl Mutant {
    /// Names the mutant in results: it does not depend on lines, so edits elsewhere do not change it.
    pub fn key(&self) -> String {
        let Mutant {
            file,
            function,
            change,
            source,
            nth,
            ..
        } = self;
        format!("{file}|{function}|{change}|{source}|{nth}")
    }

    /// Where and what, as in a compiler's message.
    pub fn describe(&self) -> String {
        let Mutant {
            file,
            line,
            column,
            function,
            change,
            source,
            ..
        } = self;
        match source.is_empty() {
            true => format!("{file}:{line}:{column}: {change}"),
            false => format!("{file}:{line}:{column}: {change} in {{{source}}} of {function}"),
        }
    }
}

/// How a site chooses among its mutants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// Another expression takes its place.
    Expression,
    /// A condition with `let` becomes false.
    LetCondition,
    /// A statement is left out.
    Statement,
    /// A function returns at once.
    Body,
}

/// A span of a file at which mutants are chosen.
#[derive(Clone, Debug)]
pub struct Site {
    pub range: Range<usize>,
    pub form: Form,
    pub number: u32,
}

/// The type of a named constant, as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constant {
    Float,
    Integer,
}

/// The names of a file's constants that are numbers.
pub fn constants(file: &syn::File) -> HashMap<String, Constant> {
    struct Constants(HashMap<String, Constant>);
    impl<'a> Visit<'a> for Constants {
        fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
            let constant = match last_name(&item.ty).as_str() {
                "f32" | "f64" => Constant::Float,
                name if is_integer(name) => Constant::Integer,
                _ => return,
            };
            self.0.insert(item.ident.to_string(), constant);
        }
    }
    let mut found = Constants(HashMap::new());
    found.visit_file(file);
    found.0
}

/// Finds the mutants of files, one after the other.
#[derive(Default)]
pub struct Finder {
    pub mutants: Vec<Mutant>,
    pub sites: HashMap<String, Vec<Site>>,
    pub constants: HashMap<String, Constant>,
    /// True if conditions of the file are left out.
    pub conditions: bool,
    site_count: u32,
    file: String,
    text: String,
    /// The file's sites by place.
    places: HashMap<(usize, usize, Form), u32>,
    equal: HashMap<String, usize>,
    /// Types and functions around.
    path: Vec<String>,
    /// The expressions around.
    around: Vec<Range<usize>>,
}

impl Finder {
    /// Adds the mutants of a file.
    pub fn add_file(&mut self, name: &str, text: &str, parsed: &syn::File) {
        self.file = name.to_owned();
        self.text = text.to_owned();
        self.places.clear();
        self.sites.insert(name.to_owned(), Vec::new());
        self.visit_file(parsed);
    }

    /// The mutants of a file.
    pub fn of_file(&self, file: &str) -> impl Iterator<Item = &Mutant> {
        self.mutants
            .iter()
            .filter(move |mutant| mutant.file == file)
    }

    fn text_of(&self, node: &impl Spanned) -> &str {
        &self.text[node.span().byte_range()]
    }

    /// One line of at most 100 characters, the same however a formatter breaks it.
    fn source_of(&self, range: Range<usize>) -> String {
        let words: Vec<&str> = self.text[range].split_whitespace().collect();
        let mut line = words.join(" ");
        for (broken, whole) in BROKEN {
            line = line.replace(broken, whole);
        }
        line.chars().take(100).collect()
    }

    fn add(
        &mut self,
        (place, form): (Range<usize>, Form),
        at: Span,
        change: String,
        source: Range<usize>,
        text: String,
    ) {
        let count = &mut self.site_count;
        let file_sites = self.sites.get_mut(&self.file).expect("of the file's");
        let site = *self
            .places
            .entry((place.start, place.end, form))
            .or_insert_with(|| {
                *count += 1;
                file_sites.push(Site {
                    range: place,
                    form,
                    number: *count,
                });
                *count
            });
        let (line, column) = (at.start().line, at.start().column + 1);
        let (file, function) = (self.file.clone(), self.path.join("::"));
        let source = self.source_of(source);
        let id = self.mutants.len() as u32 + 1;
        let mut mutant = Mutant {
            id,
            site,
            file,
            line,
            column,
            function,
            change,
            source,
            nth: 0,
            text,
        };
        let equal = self.equal.entry(mutant.key()).or_default();
        mutant.nth = *equal;
        *equal += 1;
        self.mutants.push(mutant);
    }

    /// Another expression in place of one.
    fn replace(&mut self, expr: &Expr, at: Span, change: String, text: String) {
        let range = expr.span().byte_range();
        self.add((range.clone(), Form::Expression), at, change, range, text);
    }

    /// Another number in place of one; the source is the expression around.
    fn replace_number(&mut self, expr: &Expr, change: String, text: String) {
        let range = expr.span().byte_range();
        let source = self.around.last().cloned().unwrap_or(range.clone());
        self.add((range, Form::Expression), expr.span(), change, source, text);
    }

    fn condition(&mut self, condition: &Expr, word: &str, values: &[bool]) {
        if !has_let(condition) {
            for value in values {
                let change = format!("{word} -> {value}");
                self.replace(condition, condition.span(), change, value.to_string());
            }
        } else if word != "guard" {
            let range = condition.span().byte_range();
            let place = (range.clone(), Form::LetCondition);
            self.add(
                place,
                condition.span(),
                format!("{word} -> false"),
                range,
                String::new(),
            );
        }
    }

    fn binary(&mut self, expr: &Expr, binary: &syn::ExprBinary) {
        if has_let(expr) {
            return;
        }
        let (left, right) = (self.text_of(&binary.left), self.text_of(&binary.right));
        let (left, right) = (left.to_owned(), right.to_owned());
        let was = self.text_of(&binary.op).to_owned();
        if self.conditions && matches!(binary.op, syn::BinOp::And(_)) {
            for (side, kept) in [("left", &right), ("right", &left)] {
                let change = format!("drop the {side} of &&");
                self.replace(expr, binary.op.span(), change, format!("({kept})"));
            }
        }
        for now in instead_of(&binary.op) {
            let text = match is_assignment(&binary.op) {
                true => format!("{left} {now} {right}"),
                false => format!("({left}) {now} ({right})"),
            };
            self.replace(
                expr,
                binary.op.span(),
                format!("replace {was} with {now}"),
                text,
            );
        }
    }

    /// A condition that a method has in a closure or before its dot.
    fn condition_of_method(&mut self, call: &syn::ExprMethodCall) {
        let method = call.method.to_string();
        match call.args.first() {
            Some(Expr::Closure(closure)) if TAKES_CONDITION.contains(&method.as_str()) => {
                self.condition(&closure.body, &method, &[true]);
            }
            _ if ["then", "then_some"].contains(&method.as_str()) => {
                self.condition(&call.receiver, &method, &[true]);
            }
            _ => {}
        }
    }

    fn constant(&mut self, expr: &Expr, path: &syn::ExprPath) {
        let Some(name) = path.path.get_ident().map(ToString::to_string) else {
            return;
        };
        let changes: &[&str] = match self.constants.get(&name) {
            Some(Constant::Float) => &["* 1e12", "* 1e-12"],
            Some(Constant::Integer) => &["+ 1", "- 1"],
            None => return,
        };
        for change in changes {
            let text = format!("({name} {change})");
            self.replace_number(expr, format!("const {name} {change}"), text);
        }
    }

    /// A function, its body replaced and its body searched.
    fn function(
        &mut self,
        attributes: &[syn::Attribute],
        signature: &syn::Signature,
        block: &Block,
    ) {
        if is_test(attributes) || signature.constness.is_some() {
            return;
        }
        self.path.push(signature.ident.to_string());
        let around = std::mem::take(&mut self.around);
        let body = self.text_of(block).to_owned();
        let body = body[1..body.len() - 1].trim();
        for value in defaults(&signature.output) {
            if body != value {
                let name = if value.is_empty() { "()" } else { &value };
                let change = format!("fn {} -> {name}", signature.ident);
                let place = (block.span().byte_range(), Form::Body);
                self.add(place, signature.ident.span(), change, 0..0, value);
            }
        }
        self.visit_block(block);
        self.around = around;
        self.path.pop();
    }
}

impl<'a> Visit<'a> for Finder {
    fn visit_item_fn(&mut self, item: &'a syn::ItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'a syn::ImplItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'a syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.attrs, &item.sig, block);
        }
    }

    fn visit_item_impl(&mut self, item: &'a syn::ItemImpl) {
        if !is_test(&item.attrs) {
            let name = last_name(&item.self_ty);
            let name = if name.is_empty() {
                self.text_of(&item.self_ty).to_owned()
            } else {
                name
            };
            self.path.push(name);
            visit::visit_item_impl(self, item);
            self.path.pop();
        }
    }

    fn visit_item_trait(&mut self, item: &'a syn::ItemTrait) {
        self.path.push(item.ident.to_string());
        visit::visit_item_trait(self, item);
        self.path.pop();
    }

    fn visit_item_mod(&mut self, item: &'a syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    // What is computed when the code is compiled, and what is no expression.
    fn visit_item_const(&mut self, _: &'a syn::ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'a syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'a syn::TraitItemConst) {}
    fn visit_item_static(&mut self, _: &'a syn::ItemStatic) {}
    fn visit_item_enum(&mut self, _: &'a syn::ItemEnum) {}
    fn visit_expr_const(&mut self, _: &'a syn::ExprConst) {}
    fn visit_pat(&mut self, _: &'a syn::Pat) {}
    fn visit_type(&mut self, _: &'a Type) {}
    fn visit_path(&mut self, _: &'a syn::Path) {}
    fn visit_attribute(&mut self, _: &'a syn::Attribute) {}
    fn visit_generics(&mut self, _: &'a syn::Generics) {}
    fn visit_angle_bracketed_generic_arguments(
        &mut self,
        _: &'a syn::AngleBracketedGenericArguments,
    ) {
    }

    fn visit_expr_repeat(&mut self, repeat: &'a syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }

    fn visit_macro(&mut self, found: &'a syn::Macro) {
        let name = found
            .path
            .segments
            .last()
            .map(|s| s.ident.to_string())
            .unwrap_or_default();
        let takes_expressions = ["vec", "format", "write", "writeln"].contains(&name.as_str());
        let parse = Punctuated::<Expr, Token![,]>::parse_terminated;
        if takes_expressions && let Ok(arguments) = found.parse_body_with(parse) {
            arguments
                .iter()
                .for_each(|argument| self.visit_expr(argument));
        }
    }

    fn visit_arm(&mut self, arm: &'a syn::Arm) {
        if let Some((_, guard)) = &arm.guard {
            self.condition(guard, "guard", &[true, false]);
        }
        self.around.push(arm.span().byte_range());
        visit::visit_arm(self, arm);
        self.around.pop();
    }

    fn visit_stmt(&mut self, statement: &'a Stmt) {
        let outer = std::mem::take(&mut self.around);
        self.around.push(statement.span().byte_range());
        if let Stmt::Expr(expr, Some(_)) = statement {
            let removable = match expr {
                Expr::Binary(binary) => is_assignment(&binary.op),
                Expr::Try(tried) if self.conditions => is_call(&tried.expr),
                expr => is_call(expr) || matches!(expr, Expr::Assign(_)),
            };
            if removable {
                let place = (statement.span().byte_range(), Form::Statement);
                let (at, source) = (expr.span(), expr.span().byte_range());
                self.add(place, at, "delete statement".into(), source, String::new());
            }
        }
        visit::visit_stmt(self, statement);
        self.around = outer;
    }

    fn visit_expr(&mut self, expr: &'a Expr) {
        match expr {
            Expr::If(found) => self.condition(&found.cond, "if", &[true, false]),
            // A loop that never ends only costs time.
            Expr::While(found) => self.condition(&found.cond, "while", &[false]),
            Expr::Binary(binary) => self.binary(expr, binary),
            Expr::Unary(unary) => {
                let sign = match unary.op {
                    UnOp::Not(_) => "!",
                    UnOp::Neg(_) => "-",
                    _ => return visit::visit_expr(self, expr),
                };
                let text = format!("({})", self.text_of(&unary.expr));
                self.replace(expr, unary.op.span(), format!("delete {sign}"), text);
            }
            Expr::Lit(found) => {
                let was = self.text_of(found).to_owned();
                for other in other_literals(&found.lit) {
                    self.replace_number(expr, format!("literal {was} -> {other}"), other);
                }
            }
            Expr::Path(path) => self.constant(expr, path),
            Expr::MethodCall(call) if self.conditions => self.condition_of_method(call),
            Expr::Call(call) if self.conditions && self.text_of(&call.func) == "ensure" => {
                call.args
                    .first()
                    .iter()
                    .for_each(|holds| self.condition(holds, "ensure", &[true]));
            }
            _ => {}
        }
        self.around.push(expr.span().byte_range());
        visit::visit_expr(self, expr);
        self.around.pop();
    }
}

/// Methods whose closure is a condition.
const TAKES_CONDITION: [&str; 7] = [
    "all",
    "any",
    "filter",
    "find",
    "is_none_or",
    "is_some_and",
    "take_while",
];

fn is_call(expr: &Expr) -> bool {
    matches!(expr, Expr::Call(_) | Expr::MethodCall(_))
}

fn has_let(expr: &Expr) -> bool {
    match expr {
        Expr::Let(_) => true,
        Expr::Binary(binary) => has_let(&binary.left) || has_let(&binary.right),
        _ => false,
    }
}

/// Whether `#[cfg(test)]` or `#[test]` stands before an item.
fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let list = attribute.meta.require_list();
        attribute.path().is_ident("test")
            || attribute.path().is_ident("cfg")
                && list.is_ok_and(|list| list.tokens.to_string().starts_with("test"))
    })
}
