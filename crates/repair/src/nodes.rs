//! The numbers of a guarded kernel, their sizes, and the expressions of both.

mod names;

pub use names::names;

use crate::arith::recorded::{Operation, Place};
use crate::language::{Dialect, Expression};
use crate::prove::repair::Guarded;
use names::AXES;
use std::collections::{BTreeSet, HashMap, HashSet};

/// A number that the code computes: the value of an operation, or its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    Value(Place),
    Size { place: Place, has_slack: bool },
}

impl Node {
    /// The size without slack.
    pub fn size(place: Place) -> Node {
        let has_slack = false;
        Node::Size { place, has_slack }
    }

    fn place(self) -> Place {
        match self {
            Node::Value(place) | Node::Size { place, .. } => place,
        }
    }
}

/// The names that are known at some point of the code.
#[derive(Clone, Default)]
pub struct Scope {
    pub nodes: HashSet<Node>,
    pub signs: HashSet<Place>,
    /// The products of signs that are known as numbers, by name.
    pub sides: HashMap<Vec<Place>, String>,
    /// How many chains of gates there are so far.
    pub chains: usize,
}

/// The nodes of one kernel.
pub struct Nodes<'a> {
    guarded: &'a Guarded,
    dialect: Dialect,
    names: Vec<String>,
    /// How often each node is used.
    uses: HashMap<Node, usize>,
    /// True once the axes have other names.
    pub is_renamed: bool,
}

impl<'a> Nodes<'a> {
    /// The roots, and all nodes that they need.
    pub fn new(guarded: &'a Guarded, dialect: Dialect, mut roots: Vec<Node>) -> Nodes<'a> {
        let mut nodes = Nodes {
            guarded,
            dialect,
            names: names(guarded),
            uses: HashMap::new(),
            is_renamed: false,
        };
        roots.sort();
        roots.dedup();
        let mut open = roots;
        while let Some(node) = open.pop() {
            let uses = nodes.uses.entry(node).or_default();
            *uses += 1;
            if *uses == 1 {
                open.extend(nodes.operands(node));
            }
        }
        nodes
    }

    /// A node as it stands in an expression: its name, or the expression that it is.
    pub fn text(&self, node: Node) -> String {
        self.whole(node).text()
    }

    /// The name of a number, inputs included.
    pub fn plain_name(&self, place: Place) -> String {
        match self.operation(place) {
            Operation::Input(i) => self.input(i).replace(['[', '.'], "_").replace(']', ""),
            _ => self.names[place as usize].clone(),
        }
    }

    fn operation(&self, place: Place) -> Operation {
        self.guarded.operations[place as usize]
    }

    fn operands(&self, node: Node) -> Vec<Node> {
        match node {
            Node::Size { place, .. } if self.guarded.is_leaf(place) => vec![Node::Value(place)],
            Node::Size {
                place,
                has_slack: true,
            } => vec![Node::size(place)],
            _ => {
                let parts = self.operation(node.place()).operands();
                parts
                    .into_iter()
                    .map(|part| self.part(node, part))
                    .collect()
            }
        }
    }

    /// The node of a node's operand: a part of a value is a value, a part of a size is a size. Factors are those that may
    /// need slack.
    fn part(&self, whole: Node, place: Place) -> Node {
        let Node::Size { place: product, .. } = whole else {
            return Node::Value(place);
        };
        let is_factor = matches!(self.operation(product), Operation::Mul(..));
        Node::Size {
            place,
            has_slack: is_factor && self.guarded.sizes().needs_slack(place),
        }
    }

    /// True if a node stands in the expression that uses it.
    fn is_inline(&self, node: Node) -> bool {
        use Operation::{Abs, Input, Neg, Number};
        let is_used_once = || self.uses[&node] == 1;
        let Node::Value(place) = node else {
            return is_used_once();
        };
        match self.operation(place) {
            Input(_) | Number(_) | Neg(_) | Abs(_) => true,
            // A number that is compared is named, since its size and its sign are named after it.
            _ if self.guarded.margins.contains_key(&place) => false,
            _ => is_used_once() && !self.guarded.is_leaf(place),
        }
    }

    /// True if a number is an input but for its sign.
    fn is_input(&self, place: Place) -> bool {
        match self.operation(place) {
            Operation::Input(_) => true,
            Operation::Neg(a) | Operation::Abs(a) => self.is_input(a),
            _ => false,
        }
    }

    /// A node's name or its expression.
    fn whole(&self, node: Node) -> Expression {
        if self.is_inline(node) {
            self.expression(node)
        } else {
            Expression::Name(self.name(node))
        }
    }

    /// A node as a factor: a sum in brackets.
    fn factor(&self, node: Node) -> String {
        match self.whole(node) {
            Expression::Sum(text) => format!("({text})"),
            whole => whole.text(),
        }
    }

    /// A node behind a sign that takes only what is nearest: all but a name in brackets.
    fn nearest(&self, node: Node) -> String {
        match self.whole(node) {
            Expression::Name(text) => text,
            whole => format!("({})", whole.text()),
        }
    }

    /// The expression of a node.
    fn expression(&self, node: Node) -> Expression {
        match node {
            Node::Size {
                place,
                has_slack: true,
            } => self.with_slack(place),
            Node::Size { place, .. } if self.guarded.is_leaf(place) => {
                Expression::Name(self.leaf_size(place))
            }
            _ => self.result(node),
        }
    }

    /// The absolute value of a leaf.
    fn leaf_size(&self, place: Place) -> String {
        match self.operation(place) {
            Operation::Number(x) => self.dialect.number(f64::from(x).abs()),
            _ => self.dialect.abs(&self.text(Node::Value(place))),
        }
    }

    fn with_slack(&self, place: Place) -> Expression {
        let size = if self.guarded.is_leaf(place) {
            self.leaf_size(place)
        } else {
            self.text(Node::size(place))
        };
        if self.is_input(place) {
            return self.dialect.sum_of_input("+", [&size, "SLACK"]);
        }
        Expression::Sum(format!("{size} + SLACK"))
    }

    /// The expression of an operation on its operands' values, or of its size from their sizes.
    fn result(&self, node: Node) -> Expression {
        let is_size = matches!(node, Node::Size { .. });
        let part = |place: Place| self.part(node, place);
        match self.operation(node.place()) {
            Operation::Input(i) => Expression::Name(self.input(i)),
            Operation::Number(x) => Expression::Name(self.dialect.number(x.into())),
            Operation::Add(a, b) => self.sum(node, "+", [a, b]),
            Operation::Sub(a, b) if is_size => self.sum(node, "+", [a, b]),
            Operation::Sub(a, b) => self.sum(node, "-", [a, b]),
            Operation::Mul(a, b) => self.product(part(a), "*", part(b)),
            Operation::Div(a, b) => self.product(part(a), "/", part(b)),
            Operation::Neg(a) | Operation::Abs(a) if is_size => self.whole(part(a)),
            Operation::Neg(a) => {
                let negated = self.nearest(part(a));
                Expression::Product(format!("-{negated}"))
            }
            Operation::Abs(a) => Expression::Name(self.dialect.abs(&self.text(part(a)))),
            Operation::Sqrt(a) => Expression::Name(self.dialect.sqrt(&self.text(part(a)))),
            Operation::Fma(..) | Operation::Minor(..) => {
                unreachable!("kernels that fuse are refused")
            }
        }
    }

    /// A sum or a difference.
    fn sum(&self, whole: Node, sign: &str, terms: [Place; 2]) -> Expression {
        let [x, y] = terms.map(|term| self.part(whole, term));
        let x = self.text(x);
        let y = self.factor(y);
        if terms.iter().any(|term| self.is_input(*term)) {
            return self.dialect.sum_of_input(sign, [&x, &y]);
        }
        Expression::Sum(format!("{x} {sign} {y}"))
    }

    /// A product or a quotient.
    fn product(&self, a: Node, sign: &str, b: Node) -> Expression {
        let a = self.factor(a);
        let b = self.nearest(b);
        Expression::Product(format!("{a} {sign} {b}"))
    }

    fn input(&self, i: u8) -> String {
        match i {
            15 => "t_from".to_owned(),
            16 => "t_to".to_owned(),
            _ => {
                let vector = ["o", "d", "a", "b", "c"][usize::from(i / 3)];
                let axis = usize::from(i % 3);
                if self.is_renamed {
                    format!("{vector}[{}]", AXES[axis])
                } else {
                    self.dialect.coordinate(vector, axis)
                }
            }
        }
    }

    fn name(&self, node: Node) -> String {
        let Node::Size { place, has_slack } = node else {
            return self.names[node.place() as usize].clone();
        };
        let name = self.plain_name(place);
        let with_slack = Node::Size {
            place,
            has_slack: true,
        };
        // Of two sizes of one number the one without slack is a sum's.
        let is_of_sum = !has_slack && self.uses.contains_key(&with_slack);
        let size = if is_of_sum { "size_sum" } else { "size" };
        format!("{size}_{name}")
    }

    /// Defines some nodes and all that they need, as far as the scope does not know them.
    pub fn define(&self, nodes: &[Node], scope: &mut Scope) -> Vec<String> {
        let mut open = nodes.to_vec();
        let mut needed = BTreeSet::new();
        while let Some(node) = open.pop() {
            if !scope.nodes.contains(&node) && needed.insert(node) {
                open.extend(self.operands(node));
            }
        }
        let mut ordered: Vec<Node> = needed.into_iter().collect();
        ordered.sort_by_key(|node| self.order(*node));
        scope.nodes.extend(&ordered);
        self.definitions(&ordered)
    }

    /// The order of definitions: values before sizes, and in both the leaves first, by name, so that the coordinates of a
    /// vector stand together.
    fn order(&self, node: Node) -> (bool, bool, String, Node) {
        let is_size = matches!(node, Node::Size { .. });
        let is_leaf = self.guarded.is_leaf(node.place());
        let name = if is_leaf {
            self.name(node)
        } else {
            String::new()
        };
        (is_size, !is_leaf, name, node)
    }

    /// The definitions of nodes that are not inline, the coordinates of a vector on one line.
    fn definitions(&self, nodes: &[Node]) -> Vec<String> {
        let mut lines = Vec::new();
        let mut group: Vec<(String, String)> = Vec::new();
        for node in nodes {
            if self.is_inline(*node) {
                continue;
            }
            let name = self.name(*node);
            let text = self.expression(*node).text();
            if !fits(&group, &name, &text) {
                lines.push(self.dialect.definitions(&group));
                group.clear();
            }
            group.push((name, text));
        }
        if !group.is_empty() {
            lines.push(self.dialect.definitions(&group));
        }
        lines
    }
}

/// True if a definition has its place on the line of some others: it is of the same vector, and the line is short enough.
fn fits(line: &[(String, String)], name: &str, text: &str) -> bool {
    let Some((last, _)) = line.last() else {
        return true;
    };
    let Some((vector, _)) = last.rsplit_once('_') else {
        return false;
    };
    let is_of_vector = name
        .rsplit_once('_')
        .is_some_and(|(stem, _)| stem == vector);
    let mut length = text.len();
    for (name, text) in line {
        length += name.len() + text.len() + 16;
    }
    is_of_vector && length <= 120
}
