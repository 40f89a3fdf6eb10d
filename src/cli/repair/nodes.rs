//! The numbers of a guarded kernel, their sizes, and the expressions of both.

use super::language::Language;
use super::names::{AXES, names};
use crate::arith::recorded::{Operation, Place};
use crate::prove::repair::Guarded;
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
    language: Language,
    names: Vec<String>,
    /// How often each node is used.
    uses: HashMap<Node, usize>,
    /// True once the axes have other names.
    pub is_renamed: bool,
}

impl<'a> Nodes<'a> {
    /// The nodes that some of them need.
    pub fn new(guarded: &'a Guarded, language: Language, mut roots: Vec<Node>) -> Nodes<'a> {
        let (names, uses) = (names(guarded), HashMap::new());
        let mut nodes = Nodes { guarded, language, names, uses, is_renamed: false };
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
        if self.is_inline(node) { self.expression(node).0 } else { self.name(node) }
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
        let place = match node {
            Node::Value(place) | Node::Size(place, _) => place,
        };
        let operation = self.guarded.operations[place as usize];
        match node {
            Node::Value(_) => match operation {
                Operation::Input(_)
                | Operation::Number(_)
                | Operation::Neg(_)
                | Operation::Abs(_) => true,
                // Where it is compared it has its name.
                _ => {
                    self.uses[&node] == 1
                        && !self.guarded.is_leaf(place)
                        && !self.guarded.margins.contains_key(&place)
                }
            },
            Node::Size(..) => self.uses[&node] == 1,
        }
    }

    /// The expression of a node, and how tightly it binds: 0 a sum, 1 a product, 2 a name.
    fn expression(&self, node: Node) -> (String, u8) {
        let of = |node: Node, least: u8| {
            let (text, binds) =
                if self.is_inline(node) { self.expression(node) } else { (self.name(node), 2) };
            if binds < least { format!("({text})") } else { text }
        };
        let sum = |a, sign: &str, b| (format!("{} {sign} {}", of(a, 0), of(b, 1)), 0);
        let product = |a, sign: &str, b| (format!("{} {sign} {}", of(a, 1), of(b, 2)), 1);
        let (Node::Value(place) | Node::Size(place, _)) = node;
        let operation = self.guarded.operations[place as usize];
        let is_leaf = self.guarded.is_leaf(place);
        if let Node::Size(_, slack) = node
            && (slack || is_leaf)
        {
            let size = match operation {
                _ if !is_leaf => of(Node::Size(place, false), 0),
                Operation::Number(x) => self.language.number(f64::from(x).abs(), self.is_f32()),
                _ => self.language.abs(&of(Node::Value(place), 0), self.is_f32()),
            };
            return if slack { (format!("{size} + SLACK"), 0) } else { (size, 2) };
        }
        let is_size = matches!(node, Node::Size(..));
        let part = |place: Place| self.part(node, operation, place);
        match operation {
            Operation::Input(i) => (self.input(i), 2),
            Operation::Number(x) => (self.language.number(x.into(), self.is_f32()), 2),
            Operation::Add(a, b) => sum(part(a), "+", part(b)),
            Operation::Sub(a, b) => sum(part(a), if is_size { "+" } else { "-" }, part(b)),
            Operation::Mul(a, b) => product(part(a), "*", part(b)),
            Operation::Div(a, b) => product(part(a), "/", part(b)),
            Operation::Neg(a) | Operation::Abs(a) if is_size => match self.is_inline(part(a)) {
                true => self.expression(part(a)),
                false => (self.name(part(a)), 2),
            },
            Operation::Neg(a) => (format!("-{}", of(part(a), 2)), 1),
            Operation::Abs(a) => (self.language.abs(&of(part(a), 0), self.is_f32()), 2),
            Operation::Sqrt(a) => (self.language.sqrt(&of(part(a), 0), self.is_f32()), 2),
            Operation::Fma(..) | Operation::Minor(..) => {
                unreachable!("kernels that fuse are refused")
            }
        }
    }

    pub fn is_f32(&self) -> bool {
        self.guarded.scalar == "f32"
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
                    self.language.coordinate(vector, axis)
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
            let length: usize = group.iter().map(|(name, text)| name.len() + text.len() + 16).sum();
            let fits = group
                .last()
                .is_none_or(|(last, _)| stem(last).is_some() && stem(last) == stem(&name));
            if !fits || 120 < length + expression.len() {
                lines.push(self.language.definitions(&group, self.is_f32()));
                group.clear();
            }
            group.push((name, expression));
        }
        if !group.is_empty() {
            lines.push(self.language.definitions(&group, self.is_f32()));
        }
        lines
    }
}
