//! The numbers of a guarded kernel, their sizes, the expressions of both, and names from what they are.

use crate::arith::Vector;
use crate::arith::recorded::{Operation, Place};
use crate::language::Dialect;
use crate::prove::repair::Guarded;
use crate::prove::{Leaf, Sample, run};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A number's value; or its size, with slack or without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    Value(Place),
    Size(Place, bool),
}

/// The names that are known at some point of the code.
#[derive(Clone, Default)]
pub struct Scope {
    pub nodes: HashSet<Node>,
    pub signs: HashSet<Place>,
}

/// All of them in one kernel.
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
    /// The nodes that some of them need.
    pub fn new(guarded: &'a Guarded, dialect: Dialect, mut roots: Vec<Node>) -> Nodes<'a> {
        let (names, uses) = (names(guarded), HashMap::new());
        let mut nodes = Nodes {
            guarded,
            dialect,
            names,
            uses,
            is_renamed: false,
        };
        roots.sort();
        roots.dedup();
        let mut seen = HashSet::new();
        while let Some(node) = roots.pop() {
            *nodes.uses.entry(node).or_default() += 1;
            if seen.insert(node) {
                roots.extend(nodes.operands(node));
            }
        }
        nodes
    }

    /// A node as it stands in an expression: its name, or the expression that it is.
    pub fn text(&self, node: Node) -> String {
        if self.is_inline(node) {
            self.expression(node).0
        } else {
            self.name(node)
        }
    }

    /// The name of a number, inputs included.
    pub fn plain_name(&self, place: Place) -> String {
        match self.guarded.operations[place as usize] {
            Operation::Input(i) => self.input(i).replace(['[', '.'], "_").replace(']', ""),
            _ => self.names[place as usize].clone(),
        }
    }

    fn operands(&self, node: Node) -> Vec<Node> {
        let (Node::Value(place) | Node::Size(place, _)) = node;
        match node {
            Node::Size(..) if self.guarded.is_leaf(place) => vec![Node::Value(place)],
            Node::Size(_, true) => vec![Node::Size(place, false)],
            _ => {
                let operation = self.guarded.operations[place as usize];
                let part = |part| self.part(node, operation, part);
                operation.operands().into_iter().map(part).collect()
            }
        }
    }

    /// A part of a value is a value; of a size it is a size.
    fn part(&self, whole: Node, operation: Operation, place: Place) -> Node {
        match (whole, operation) {
            (Node::Value(_), _) => Node::Value(place),
            (_, Operation::Mul(..)) => self.factor(place),
            _ => Node::Size(place, false),
        }
    }

    fn factor(&self, place: Place) -> Node {
        Node::Size(place, self.guarded.sizes().needs_slack(place))
    }

    /// True if a node stands in the expression that uses it.
    fn is_inline(&self, node: Node) -> bool {
        let (Node::Value(place) | Node::Size(place, _)) = node;
        let operation = self.guarded.operations[place as usize];
        use Operation::{Abs, Input, Neg, Number};
        match (node, operation) {
            (Node::Value(_), Input(_) | Number(_) | Neg(_) | Abs(_)) => true,
            // Where it is compared it has its name.
            (Node::Value(_), _) if self.guarded.margins.contains_key(&place) => false,
            (Node::Value(_), _) => self.uses[&node] == 1 && !self.guarded.is_leaf(place),
            (Node::Size(..), _) => self.uses[&node] == 1,
        }
    }

    /// True if a number is an input but for its sign.
    fn is_input(&self, place: Place) -> bool {
        match self.guarded.operations[place as usize] {
            Operation::Input(_) => true,
            Operation::Neg(a) | Operation::Abs(a) => self.is_input(a),
            _ => false,
        }
    }

    /// A node's name or its expression, and how tightly that binds.
    fn whole(&self, node: Node) -> (String, u8) {
        if self.is_inline(node) {
            self.expression(node)
        } else {
            (self.name(node), 2)
        }
    }

    /// The same as an operand, in brackets if it binds less tightly than the operation.
    fn operand(&self, node: Node, least: u8) -> String {
        let (text, binds) = self.whole(node);
        if binds < least {
            format!("({text})")
        } else {
            text
        }
    }

    /// A sum or a difference.
    fn sum(&self, whole: Node, sign: &str, terms: [Place; 2]) -> (String, u8) {
        let (Node::Value(place) | Node::Size(place, _)) = whole;
        let operation = self.guarded.operations[place as usize];
        let [x, y] = terms.map(|term| self.part(whole, operation, term));
        let [x, y] = [self.operand(x, 0), self.operand(y, 1)];
        if terms.iter().any(|term| self.is_input(*term)) {
            return self.dialect.sum_of_input(sign, [&x, &y]);
        }
        (format!("{x} {sign} {y}"), 0)
    }

    /// The expression of a node, and how tightly it binds: 0 a sum, 1 a product, 2 a name.
    fn expression(&self, node: Node) -> (String, u8) {
        let product = |a, sign: &str, b| {
            (
                format!("{} {sign} {}", self.operand(a, 1), self.operand(b, 2)),
                1,
            )
        };
        let (Node::Value(place) | Node::Size(place, _)) = node;
        let operation = self.guarded.operations[place as usize];
        let is_leaf = self.guarded.is_leaf(place);
        if let Node::Size(_, slack) = node
            && (slack || is_leaf)
        {
            let size = match operation {
                _ if !is_leaf => self.operand(Node::Size(place, false), 0),
                Operation::Number(x) => self.dialect.number(f64::from(x).abs()),
                _ => self.dialect.abs(&self.operand(Node::Value(place), 0)),
            };
            return match slack {
                false => (size, 2),
                true if self.is_input(place) => self.dialect.sum_of_input("+", [&size, "SLACK"]),
                true => (format!("{size} + SLACK"), 0),
            };
        }
        let is_size = matches!(node, Node::Size(..));
        let part = |place: Place| self.part(node, operation, place);
        match operation {
            Operation::Input(i) => (self.input(i), 2),
            Operation::Number(x) => (self.dialect.number(x.into()), 2),
            Operation::Add(a, b) => self.sum(node, "+", [a, b]),
            Operation::Sub(a, b) => self.sum(node, if is_size { "+" } else { "-" }, [a, b]),
            Operation::Mul(a, b) => product(part(a), "*", part(b)),
            Operation::Div(a, b) => product(part(a), "/", part(b)),
            Operation::Neg(a) | Operation::Abs(a) if is_size => self.whole(part(a)),
            Operation::Neg(a) => (format!("-{}", self.operand(part(a), 2)), 1),
            Operation::Abs(a) => (self.dialect.abs(&self.operand(part(a), 0)), 2),
            Operation::Sqrt(a) => (self.dialect.sqrt(&self.operand(part(a), 0)), 2),
            Operation::Fma(..) | Operation::Minor(..) => {
                unreachable!("kernels that fuse are refused")
            }
        }
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
        match node {
            Node::Value(place) => self.names[place as usize].clone(),
            Node::Size(place, slack) => {
                let name = self.plain_name(place);
                // Of two sizes of one number the one without slack is a sum's.
                let sum = if slack || !self.uses.contains_key(&Node::Size(place, true)) {
                    ""
                } else {
                    "_sum"
                };
                format!("size{sum}_{name}")
            }
        }
    }

    /// Defines what some nodes need, and they themselves.
    pub fn define(&self, nodes: &[Node], scope: &mut Scope) -> Vec<String> {
        let mut lines = Vec::new();
        let mut open: Vec<Node> = nodes.to_vec();
        let mut needed = BTreeSet::new();
        while let Some(node) = open.pop() {
            if !scope.nodes.contains(&node) && needed.insert(node) {
                open.extend(self.operands(node));
            }
        }
        // Vectors first, coordinate by coordinate.
        let mut ordered: Vec<Node> = needed.into_iter().collect();
        ordered.sort_by_key(|node| match *node {
            Node::Value(place) if self.guarded.is_leaf(place) => (0, self.name(*node), *node),
            Node::Value(_) => (1, String::new(), *node),
            Node::Size(place, _) if self.guarded.is_leaf(place) => (2, self.name(*node), *node),
            Node::Size(..) => (3, String::new(), *node),
        });
        let mut group: Vec<(String, String)> = Vec::new();
        for node in ordered {
            scope.nodes.insert(node);
            if self.is_inline(node) {
                continue;
            }
            let (name, (expression, _)) = (self.name(node), self.expression(node));
            let stem = |name: &str| name.rsplit_once('_').map(|(stem, _)| stem.to_owned());
            let length: usize = group
                .iter()
                .map(|(name, text)| name.len() + text.len() + 16)
                .sum();
            let fits = group
                .last()
                .is_none_or(|(last, _)| stem(last).is_some() && stem(last) == stem(&name));
            if !fits || 120 < length + expression.len() {
                lines.push(self.dialect.definitions(&group));
                group.clear();
            }
            group.push((name, expression));
        }
        if !group.is_empty() {
            lines.push(self.dialect.definitions(&group));
        }
        lines
    }
}

/// Inputs at which numbers show what they are.
const SAMPLE: [f64; 17] = [
    0.31, -0.72, 0.53, 0.94, 0.25, -0.46, 0.87, 0.18, -0.99, 0.21, 0.62, 0.13, -0.74, 0.35, 0.96,
    0.07, 1.68,
];

/// By place: the name of a number that is neither an input nor a whole number.
pub fn names(guarded: &Guarded) -> Vec<String> {
    let operations = &guarded.operations;
    let mut values = Vec::new();
    run(operations, &SAMPLE, &mut values);
    let known = known();
    let (mut taken, mut names) = (HashSet::new(), Vec::new());
    for (place, operation) in operations.iter().enumerate() {
        let is_known = |(_, value): &&(&str, f64)| {
            (values[place].abs() - value.abs()).abs() <= 1e-9 * value.abs()
        };
        let found = match Leaf::of(*operation, operations) {
            Some(Leaf::Difference(p, q, axis)) => {
                Some(format!("{}{}_{}", POINTS[q], POINTS[p], AXES[axis]))
            }
            Some(leaf) => Some(format!("{leaf:?}")),
            None => cross(operations, operation, &names).or_else(|| {
                known
                    .iter()
                    .find(is_known)
                    .map(|(name, _)| (*name).to_owned())
            }),
        };
        let stem = found.unwrap_or_else(|| "n".to_owned());
        let numbered = (1..).map(|i| format!("{stem}{i}"));
        let first = (stem != "n").then(|| stem.clone());
        let mut all = first.into_iter().chain(numbered);
        let name = all
            .find(|name| !taken.contains(name))
            .expect("names do not end");
        taken.insert(name.clone());
        names.push(name);
    }
    names
}

/// The origin and the vertices.
const POINTS: [&str; 4] = ["o", "a", "b", "c"];
/// The axes.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// The name of a coordinate of a cross product, of vectors with names.
fn cross(operations: &[Operation], operation: &Operation, names: &[String]) -> Option<String> {
    let Operation::Sub(p, q) = *operation else {
        return None;
    };
    let factors = |place: Place| match operations[place as usize] {
        Operation::Mul(a, b) => Some([a, b].map(|place| vector(operations, place, names))),
        _ => None,
    };
    let ([Some((v, j)), Some((w, k))], [Some(x), Some(y)]) = (factors(p)?, factors(q)?) else {
        return None;
    };
    let is_turned = [&x, &y] == [&(v.clone(), k), &(w.clone(), j)]
        || [&y, &x] == [&(v.clone(), k), &(w.clone(), j)];
    (is_turned && (j + 1) % 3 == k).then(|| format!("{v}_{w}_{}", AXES[(k + 1) % 3]))
}

/// The vector's name and the axis, if a number is named as a coordinate.
fn vector(operations: &[Operation], place: Place, names: &[String]) -> Option<(String, usize)> {
    if let Some(Leaf::Direction(axis)) = Leaf::of(operations[place as usize], operations) {
        return Some(("d".to_owned(), axis));
    }
    let (stem, axis) = names.get(place as usize)?.rsplit_once('_')?;
    Some((stem.to_owned(), AXES.iter().position(|name| *name == axis)?))
}

/// The numbers that have names: weights of the vertices, the determinant, and t times it.
fn known() -> Vec<(&'static str, f64)> {
    let sample = Sample::of(&SAMPLE);
    let (det, t) = (sample.volume(), sample.time());
    let [u, v] = [1, 2].map(|vertex| sample.weight(vertex));
    vec![
        ("det", det),
        ("weight_of_a", sample.weight(0) * det),
        ("weight_of_b", u * det),
        ("weight_of_c", v * det),
        ("t_det", t * det),
        ("after_t_min", (t - SAMPLE[15]) * det),
        ("before_t_max", (SAMPLE[16] - t) * det),
        ("normal_square", sample.normal.dot(&sample.normal)),
        ("inv_det", 1.0 / det),
        ("t", t),
        ("u", u),
        ("v", v),
    ]
}
