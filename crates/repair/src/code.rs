//! A guarded kernel as source code.

use crate::arith::recorded::{Comparison, Place};
use crate::language::Dialect;
use crate::nodes::{Node, Nodes, Scope};
use crate::prove::repair::{Axes, Chain, Guarded, Literal, Pattern, Step};
use std::collections::BTreeSet;
use std::collections::hash_map::Entry;

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
        let roots = steps.iter().flat_map(|step| roots_of(step, guarded));
        let mut code = Code {
            nodes: Nodes::new(guarded, dialect, roots.collect()),
            guarded,
            dialect,
            lines: Vec::new(),
            depth: 1,
        };
        // A gate that cannot decide stays open, so that the end asks.
        if steps.iter().any(|step| matches!(step, Step::Gate(..))) {
            code.line(dialect.open());
        }
        code.step(&guarded.steps, Scope::default());
        code.lines
    }

    fn line(&mut self, text: impl AsRef<str>) {
        let indent = "    ".repeat(self.depth);
        self.lines.push(indent + text.as_ref());
    }

    /// The head of a block, and a step inside it.
    fn block(&mut self, head: impl AsRef<str>, step: &Step, scope: &Scope) {
        self.line(head);
        self.depth += 1;
        self.step(step, scope.clone());
        self.depth -= 1;
    }

    fn define(&mut self, nodes: &[Node], scope: &mut Scope) {
        for line in self.nodes.define(nodes, scope) {
            self.line(line);
        }
    }

    /// Defines the signs of all numbers in some literals.
    fn signs(&mut self, literals: &[&Literal], scope: &mut Scope) {
        let places = literals.iter().flat_map(|literal| literal.places());
        self.signs_of(places, scope);
    }

    /// The same of some numbers.
    fn signs_of(&mut self, places: impl Iterator<Item = Place>, scope: &mut Scope) {
        for place in places.collect::<BTreeSet<Place>>() {
            if scope.signs.insert(place) {
                self.sign(place, scope);
            }
        }
    }

    /// Defines the sign of a number: 1 or -1 if it is certain, else 0.
    fn sign(&mut self, place: Place, scope: &mut Scope) {
        let factor = self.guarded.margins[&place].factor;
        let value = Node::Value(place);
        let call = if factor.is_zero() {
            self.define(&[value], scope);
            let function = self.dialect.function("exact_sign");
            format!("{function}({})", self.nodes.text(value))
        } else {
            let size = Node::size(place);
            self.define(&[value, size], scope);
            let function = self.dialect.function("sure_sign");
            let x = self.nodes.text(value);
            let size = self.nodes.text(size);
            let factor = self.dialect.number(factor.to_f64());
            format!("{function}({x}, {size}, {factor})")
        };
        self.line(self.dialect.integer(&self.sign_name(place), &call));
    }

    fn sign_name(&self, place: Place) -> String {
        format!("sign_{}", self.nodes.plain_name(place))
    }

    /// The conditions that together make sure that a literal holds.
    fn conditions(&self, literal: &Literal) -> Vec<String> {
        let mut conditions = Vec::new();
        for place in &literal.nonzero {
            conditions.push(format!("{} != 0", self.sign_name(*place)));
        }
        if !literal.signs.is_empty() {
            let signs = literal.signs.iter().map(|place| self.sign_name(*place));
            let product = signs.collect::<Vec<String>>().join(" * ");
            let order = if literal.is_negative { "<" } else { ">" };
            conditions.push(format!("{product} {order} 0"));
        }
        conditions
    }

    /// The condition that makes sure that one of some patterns holds.
    fn patterns(&self, patterns: &[Pattern]) -> String {
        let mut alternatives = Vec::new();
        for pattern in patterns {
            let parts = pattern.iter().flat_map(|literal| self.conditions(literal));
            let parts: Vec<String> = parts.collect();
            let all = parts.join(" && ");
            let needs_brackets = 1 < patterns.len() && parts.len() != 1;
            alternatives.push(if needs_brackets {
                format!("({all})")
            } else {
                all
            });
        }
        alternatives.join(" || ")
    }

    fn step(&mut self, step: &Step, mut scope: Scope) {
        match step {
            Step::Choice(comparison, yes, no) => {
                let condition = self.comparison(comparison, &mut scope);
                self.block(self.dialect.if_(&condition), yes, &scope);
                self.block("} else {", no, &scope);
                self.line("}");
            }
            Step::Sign(literal, yes, no) => {
                self.signs(&[literal], &mut scope);
                let holds = self.conditions(literal).join(" && ");
                let opposite = self.conditions(&literal.negated()).join(" && ");
                let or_else = format!("}} else {}", self.dialect.if_(&opposite));
                self.block(self.dialect.if_(&holds), yes, &scope);
                // A number that only must not be zero is never known to be zero.
                if opposite != holds {
                    self.block(or_else, no, &scope);
                }
                self.block("} else {", &Step::Ask, &scope);
                self.line("}");
            }
            Step::Gate(gate, [hits, misses], next) => {
                let start = self.lines.len();
                let chain = self.guarded.chain(step);
                match &chain {
                    Some(chain) => self.chain(chain, &mut scope),
                    None => self.gate(hits, misses, &mut scope),
                }
                if start < self.lines.len() {
                    let alone = [*gate];
                    let gates = chain.as_ref().map_or(&alone[..], |chain| &chain.gates);
                    let names = gates.iter().map(|gate| self.guarded.info.gates[*gate].name);
                    let names = names.collect::<Vec<_>>().join(", ");
                    let plural = if gates.len() == 1 { "" } else { "s" };
                    let indent = "    ".repeat(self.depth);
                    let comment = format!("{indent}// gate{plural} {names}");
                    self.lines.insert(start, self.dialect.comment(&comment));
                }
                self.step(chain.map_or(next, |chain| chain.next), scope);
            }
            Step::Axes(axes, next) => {
                self.line(self.dialect.axes());
                self.axes(axes, &mut scope);
                self.nodes.is_renamed = true;
                self.step(next, Scope::default());
            }
            Step::Hit(values) => self.hit(values, &mut scope),
            Step::Ask => self.line(self.dialect.answer("ASK")),
        }
    }

    /// Misses if a pattern of misses surely holds, and leaves the gate open unless one of hits does.
    fn gate(&mut self, hits: &[Pattern], misses: &[Pattern], scope: &mut Scope) {
        let literals: Vec<&Literal> = hits.iter().chain(misses).flatten().collect();
        self.signs(&literals, scope);
        if !misses.is_empty() {
            let places = misses.iter().flatten().flat_map(Literal::places);
            let condition = self.sure_miss(places.collect(), self.patterns(misses));
            self.line(self.dialect.early(&condition, "MISS"));
        }
        match hits {
            [] => self.line(self.dialect.assign_open("")),
            // Nothing has to hold.
            [pattern] if pattern.is_empty() => {}
            _ => self.line(self.dialect.assign_open(&self.patterns(hits))),
        }
    }

    /// Asks where a number is no finite one, misses if the least of the numbers is surely negative, and leaves the gates open
    /// unless it is surely positive.
    fn chain(&mut self, chain: &Chain, scope: &mut Scope) {
        self.signs_of(chain.sides.iter().copied(), scope);
        let numbers = chain.numbers.iter().map(|(_, place)| *place);
        let sizes: Vec<Node> = chain
            .widest
            .iter()
            .map(|place| Node::size(*place))
            .collect();
        let values = numbers.map(Node::Value);
        let nodes: Vec<Node> = values.chain(sizes.iter().copied()).collect();
        self.define(&nodes, scope);
        let dialect = self.dialect;
        let value = |place: &Place| self.nodes.text(Node::Value(*place));
        let widest: Vec<String> = chain.widest.iter().map(value).collect();
        let sizes = sizes.into_iter().map(|size| self.nodes.text(size));
        let size = dialect.extreme("greater", sizes.collect());
        let factor = dialect.number(chain.factor);
        scope.chains += 1;
        let names = ["side", "margin", "least"].map(|stem| match scope.chains {
            1 => stem.to_owned(),
            count => format!("{stem}{count}"),
        });
        let [side, margin, least] = names;
        let side = self.side(chain, side, scope);
        let turned = |(is_negative, place): &(bool, Place)| {
            let sign = if *is_negative { "-" } else { "" };
            format!("{side}{sign}{}", self.nodes.text(Node::Value(*place)))
        };
        let numbers = chain.numbers.iter().map(turned).collect();
        let function = dialect.function("margin_of");
        let definitions = [
            (&margin, format!("{function}({size}, {factor})")),
            (&least, dialect.extreme("lesser", numbers)),
        ];
        for (name, text) in definitions {
            self.line(dialect.definitions(&[(name.clone(), text)]));
        }
        if let Some(line) = dialect.unless_finite(&widest.join(" + ")) {
            self.line(line);
        }
        let condition = self.sure_miss(chain.places(), format!("{least} < -{margin}"));
        self.line(dialect.early(&condition, "MISS"));
        self.line(dialect.assign_open(&format!("{least} > {margin}")));
    }

    /// The factor that turns the numbers of a chain, with the sign of a product behind it. Its name is new if it has none yet.
    fn side(&mut self, chain: &Chain, name: String, scope: &mut Scope) -> String {
        let signs = chain.sides.iter().map(|place| self.sign_name(*place));
        let signs = signs.collect::<Vec<String>>().join(" * ");
        if signs.is_empty() {
            return signs;
        }
        let known = scope.sides.entry(chain.sides.clone());
        if let Entry::Vacant(_) = known {
            let definition = (name.clone(), self.dialect.real(&signs));
            self.line(self.dialect.definitions(&[definition]));
        }
        format!("{} * ", known.or_insert(name))
    }

    /// The condition for a miss by some numbers. An end of the interval that one depends on must not have been cut to the
    /// largest size.
    fn sure_miss(&self, places: Vec<Place>, mut condition: String) -> String {
        for (end, is_whole) in [(0, "t_from == t_min"), (1, "t_to == t_max")] {
            let depends = |place: &Place| self.guarded.uses_end(*place, end);
            if !places.iter().any(depends) {
                continue;
            }
            if condition.contains("||") {
                condition = format!("({condition})");
            }
            condition = format!("{is_whole} && {condition}");
        }
        condition
    }

    /// Asks if a gate is open, and else returns a hit with these values.
    fn hit(&mut self, values: &[Option<Place>; 3], scope: &mut Scope) {
        self.line(self.dialect.early("open", "ASK"));
        let nodes = values.map(|value| value.map(Node::Value));
        let given: Vec<Node> = nodes.into_iter().flatten().collect();
        self.define(&given, scope);
        let texts = nodes.map(|node| Some(self.nodes.text(node?)));
        for line in self.dialect.hit(&texts) {
            self.line(line);
        }
    }

    /// The condition of a comparison, whose numbers are defined first.
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

    /// Assigns the names of the axes.
    fn axes(&mut self, axes: &Axes, scope: &mut Scope) {
        match axes {
            Axes::Are([x, y, z]) => self.line(format!("x = {x}; y = {y}; z = {z};")),
            Axes::If(comparison, yes, no) => {
                let condition = self.comparison(comparison, scope);
                self.line(self.dialect.if_(&condition));
                self.depth += 1;
                self.axes(yes, scope);
                self.depth -= 1;
                self.line("} else {");
                self.depth += 1;
                self.axes(no, scope);
                self.depth -= 1;
                self.line("}");
            }
        }
    }
}

/// The nodes that a step names.
fn roots_of(step: &Step, guarded: &Guarded) -> Vec<Node> {
    let mut roots = Vec::new();
    for place in step.literals().into_iter().flat_map(Literal::places) {
        roots.push(Node::Value(place));
        if !guarded.margins[&place].factor.is_zero() {
            roots.push(Node::size(place));
        }
    }
    let values = match step {
        Step::Choice(comparison, ..) => comparison.places(),
        Step::Hit(values) => values.iter().flatten().copied().collect(),
        _ => vec![],
    };
    roots.extend(values.into_iter().map(Node::Value));
    roots
}
