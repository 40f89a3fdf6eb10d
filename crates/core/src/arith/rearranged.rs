//! Sums as compilers of shaders rearrange them, by two rules that two devices were seen to have. The rules look at expressions, never at values, each sum is rearranged once, and a minus hides what it
//! stands before: `(a - b) - a` is `-b`, but `a - (a + b)` and `a*h - b*h` stay. Compilers have other rules besides.

/// A factor or a term: it is known whether another one is the same expression.
pub(super) trait Operand: Copy {
    fn is_the_same_as(self, other: Self) -> bool;
    fn negation(self) -> Self;
}

/// A number, as far as the rules look.
#[derive(Clone, Copy, Debug)]
pub(super) enum MadeOf<O> {
    Sum(O, O),
    Product(O, O),
    Other,
}

/// The replacement of a sum.
pub(super) enum Rest<O> {
    /// `(a + b) - a` is `b`.
    Term(O),
    /// `a*h + b*h` is `(a + b)*h`.
    Product { terms: [O; 2], factor: O },
}

/// The replacement of a sum of two terms; none if it stays as it is.
pub(super) fn rearranged<O: Operand>([left, right]: [(O, MadeOf<O>); 2]) -> Option<Rest<O>> {
    undone(left.1, right.0)
        .or_else(|| undone(right.1, left.0))
        .or_else(|| with_common_factor(left.1, right.1))
}

fn undone<O: Operand>(sum: MadeOf<O>, term: O) -> Option<Rest<O>> {
    let MadeOf::Sum(a, b) = sum else {
        return None;
    };
    let negative = term.negation();
    if a.is_the_same_as(negative) {
        Some(Rest::Term(b))
    } else if b.is_the_same_as(negative) {
        Some(Rest::Term(a))
    } else {
        None
    }
}

fn with_common_factor<O: Operand>(left: MadeOf<O>, right: MadeOf<O>) -> Option<Rest<O>> {
    let (MadeOf::Product(a, b), MadeOf::Product(c, d)) = (left, right) else {
        return None;
    };
    for (term, factor) in [(a, b), (b, a)] {
        for (other, candidate) in [(c, d), (d, c)] {
            if candidate.is_the_same_as(factor) {
                let terms = [term, other];
                return Some(Rest::Product { terms, factor });
            }
        }
    }
    None
}
