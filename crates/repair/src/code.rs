//! A guarded kernel as source code.

use crate::arith::recorded::{Comparison, Place};
use crate::language::Dialect;
use crate::nodes::{AXES, Node, Nodes, Scope};
use crate::prove::repair::{Axes, Guarded, Literal, Pattern, Step};
use std::collections::BTreeSet;

/// The body of a function, line by line.
pub struct Code<'a> {
    nodes: Nodes<'a>,
    guarded: &'a Guarded,
    dialect: Dialect,
    lines: Vec<String>,
    depth: usize,
}

impl<'a> Code<'a> {
    /// The lines of a guarded kernel's body.
    pub fn body(guarded: &'a Guarded, dialect: Dialect) -> Vec<String> {
        let steps = guarded.steps.all();
        let roots = steps
            .iter()
            .flat_map(|step| roots_of(step, guarded))
            .collect();
        let nodes = Nodes::new(guarded, dialect, roots);
        let mut code = Code {
            nodes,
            guarded,
            dialect,
            lines: Vec::new(),
            depth: 1,
        };
        // Some gate may stay open.
        if steps.iter().any(|step| matches!(step, Step::Gate(..))) {
            code.line(dialect.open());
        }
        code.step(&guarded.steps, Scope::default());
        code.lines
    }

    fn line(&mut self, text: impl AsRef<str>) {
        self.lines
            .push(format!("{}{}", "    ".repeat(self.depth), text.as_ref()));
    }

    fn define(&mut self, nodes: &[Node], scope: &mut Scope) {
        for line in self.nodes.define(nodes, scope) {
            self.line(line);
        }
    }

    fn signs(&mut self, literals: &[&Literal], scope: &mut Scope) {
        let places: BTreeSet<Place> = literals
            .iter()
            .flat_map(|literal| literal.places())
            .collect();
        for place in places {
            if !scope.signs.insert(place) {
                continue;
            }
            let margin = self.guarded.margins[&place];
            let is_exact = margin.factor.is_zero();
            let value = Node::Value(place);
            let size = Node::Size(place, false);
            let nodes = [value, size];
            self.define(&nodes[..if is_exact { 1 } else { 2 }], scope);
            let x = self.nodes.text(value);
            let call = if is_exact {
                format!("{}({x})", self.dialect.function("exact_sign"))
            } else {
                let factor = self.dialect.number(margin.factor.to_f64());
                let function = self.dialect.function("sure_sign");
                format!("{function}({x}, {}, {factor})", self.nodes.text(size))
            };
            self.line(self.dialect.integer(&self.sign_name(place), &call));
        }
    }

    fn sign_name(&self, place: Place) -> String {
        format!("sign_{}", self.nodes.plain_name(place))
    }

    /// A condition that a literal surely holds.
    fn literal(
        &self,
        Literal {
            is_negative,
            signs,
            nonzero,
        }: &Literal,
    ) -> Vec<String> {
        let signs: Vec<String> = signs.iter().map(|place| self.sign_name(*place)).collect();
        let mut parts: Vec<String> = nonzero
            .iter()
            .map(|place| format!("{} != 0", self.sign_name(*place)))
            .collect();
        if !signs.is_empty() {
            parts.push(format!(
                "{} {} 0",
                signs.join(" * "),
                if *is_negative { "<" } else { ">" }
            ));
        }
        parts
    }

    fn patterns(&self, patterns: &[Pattern]) -> String {
        let text = |pattern: &Pattern| {
            pattern
                .iter()
                .flat_map(|it| self.literal(it))
                .collect::<Vec<_>>()
        };
        let all: Vec<Vec<String>> = patterns.iter().map(text).collect();
        let is_single = all.len() == 1;
        let one = |parts: &Vec<String>| {
            let text = parts.join(" && ");
            if is_single || parts.len() == 1 {
                text
            } else {
                format!("({text})")
            }
        };
        all.iter().map(one).collect::<Vec<_>>().join(" || ")
    }

    fn step(&mut self, step: &Step, mut scope: Scope) {
        match step {
            Step::Choice(comparison, yes, no) => {
                let condition = self.comparison(comparison, &mut scope);
                let ways = [(condition, yes), (String::new(), no)];
                self.branch(ways, |code, step| code.step(step, scope.clone()));
            }
            Step::Sign(literal, yes, no) => {
                self.signs(&[literal], &mut scope);
                let [yes_if, no_if] =
                    [literal.clone(), literal.negated()].map(|it| self.literal(&it).join(" && "));
                let ways = [(yes_if, &**yes), (no_if, no), (String::new(), &Step::Ask)];
                self.branch(ways, |code, step| code.step(step, scope.clone()));
            }
            Step::Gate(gate, [hits, misses], next) => {
                let literals: Vec<&Literal> = hits.iter().chain(misses).flatten().collect();
                let name = self.guarded.info.gates[*gate].name;
                let start = self.lines.len();
                self.signs(&literals, &mut scope);
                if !misses.is_empty() {
                    let places = || misses.iter().flatten().flat_map(Literal::places);
                    let is_of = |end: u8| places().any(|place| self.guarded.uses_end(place, end));
                    let mut condition = self.patterns(misses);
                    for (end, known) in [(0, "t_from == t_min"), (1, "t_to == t_max")] {
                        if is_of(end) {
                            let wrapped = if condition.contains("||") {
                                format!("({condition})")
                            } else {
                                condition
                            };
                            condition = format!("{known} && {wrapped}");
                        }
                    }
                    self.line(self.dialect.early(&condition, "MISS"));
                }
                match &hits[..] {
                    [] => self.line(self.dialect.assign_open("")),
                    [pattern] if pattern.is_empty() => {}
                    _ => self.line(self.dialect.assign_open(&self.patterns(hits))),
                }
                if start < self.lines.len() {
                    let comment = format!("{}// gate {name}", "    ".repeat(self.depth));
                    self.lines.insert(start, self.dialect.comment(&comment));
                }
                self.step(next, scope);
            }
            Step::Axes(axes, next) => {
                self.line(self.dialect.axes());
                self.axes(axes, &mut scope);
                self.nodes.is_renamed = true;
                self.step(next, Scope::default());
            }
            Step::Hit(values) => {
                self.line(self.dialect.early("open", "ASK"));
                let given: Vec<Option<Node>> =
                    values.iter().map(|place| place.map(Node::Value)).collect();
                let nodes: Vec<Node> = given.iter().flatten().copied().collect();
                self.define(&nodes, &mut scope);
                let text = |node: &Option<Node>| node.map(|node| self.nodes.text(node));
                let values: Vec<Option<String>> = given.iter().map(text).collect();
                for line in self.dialect.hit(&values) {
                    self.line(line);
                }
            }
            Step::Ask => self.line(self.dialect.answer("ASK")),
        }
    }

    fn branch<T, const N: usize>(
        &mut self,
        ways: [(String, T); N],
        mut body: impl FnMut(&mut Self, T),
    ) {
        for (i, (condition, way)) in ways.into_iter().enumerate() {
            let head = match (i, condition.as_str()) {
                (0, condition) => self.dialect.if_(condition),
                (_, "") => "} else {".to_owned(),
                (_, condition) => format!("}} else {}", self.dialect.if_(condition)),
            };
            self.line(head);
            self.depth += 1;
            body(self, way);
            self.depth -= 1;
        }
        self.line("}");
    }

    fn comparison(&mut self, comparison: &Comparison, scope: &mut Scope) -> String {
        let nodes: Vec<Node> = comparison.places().into_iter().map(Node::Value).collect();
        self.define(&nodes, scope);
        let text = |place: Place| self.nodes.text(Node::Value(place));
        let zero = self.dialect.number(0.0);
        match *comparison {
            Comparison::Less(a, b) => format!("{} < {}", text(a), text(b)),
            Comparison::AtMost(a, b) => format!("{} <= {}", text(a), text(b)),
            Comparison::Zero(a) => format!("{} == {zero}", text(a)),
            Comparison::Negative(a) => format!("{} < {zero}", text(a)),
        }
    }

    /// The names of the axes.
    fn axes(&mut self, axes: &Axes, scope: &mut Scope) {
        match axes {
            Axes::Are(axes) => {
                let set: Vec<String> = (0..3)
                    .map(|i| format!("{} = {};", AXES[i], axes[i]))
                    .collect();
                self.line(set.join(" "));
            }
            Axes::If(comparison, yes, no) => {
                let condition = self.comparison(comparison, scope);
                let ways = [(condition, yes), (String::new(), no)];
                self.branch(ways, |code, axes| code.axes(axes, scope));
            }
        }
    }
}

/// The nodes that a step names.
fn roots_of(step: &Step, guarded: &Guarded) -> Vec<Node> {
    let signs: Vec<Place> = step
        .literals()
        .into_iter()
        .flat_map(Literal::places)
        .collect();
    let has_size = |place: &&Place| !guarded.margins[*place].factor.is_zero();
    let sizes = signs
        .iter()
        .filter(has_size)
        .map(|place| Node::Size(*place, false));
    let values = match step {
        Step::Choice(comparison, ..) => comparison.places(),
        Step::Hit(values) => values.iter().flatten().copied().collect(),
        _ => vec![],
    };
    sizes
        .chain(signs.iter().chain(&values).copied().map(Node::Value))
        .collect()
}
