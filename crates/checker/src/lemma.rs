//! Lemmas: which rule proves the bound of an operation, and the rule of sums.

use super::formula::Formula;
use super::number::{ERROR_DIGITS, SIZE_DIGITS, round_up};
use super::operations::index;
use super::program::{Lemma, Program};
use super::reader::{Outcome, Reader, ensure};
use super::{quotient, two_quotients, unit};

/// A rule of the guide's table in "The certificate".
enum Rule {
    Sum,
    Unit,
    Quotient,
    SumOfQuotients,
    RestOfQuotients,
}

/// The first line of a lemma.
struct Heading {
    place: usize,
    rule: Rule,
    /// True if a quotient is a product with a rounded reciprocal.
    by_reciprocal: bool,
}

impl Heading {
    fn parse(words: &[&str], program: &Program) -> Option<Heading> {
        let &[place, name] = words else { return None };
        let place = index(place, program.operations.len())?;
        // A change of sign is exact, so the bound is that of the operand.
        let is_sign = ["neg", "abs"].contains(&program.name(place));
        if is_sign || program.lemmas.contains_key(&place) {
            return None;
        }
        let of_quotients = name.strip_suffix("-by-reciprocal");
        let by_reciprocal = of_quotients.is_some();
        let rule = match of_quotients.unwrap_or(name) {
            "sum" if !by_reciprocal => Rule::Sum,
            "unit" if !by_reciprocal => Rule::Unit,
            "quotient" => Rule::Quotient,
            "sum-of-quotients" => Rule::SumOfQuotients,
            "rest-of-quotients" => Rule::RestOfQuotients,
            _ => return None,
        };
        Some(Heading {
            place,
            rule,
            by_reciprocal,
        })
    }
}

/// Reads and checks a lemma.
pub fn read(program: &mut Program, reader: &mut Reader) -> Outcome<()> {
    let form = "lemma OPERATION sum, unit or quotient, sum-of-quotients or rest-of-quotients, \
                each of these perhaps with -by-reciprocal, for an operation without a lemma that is no neg or abs";
    let heading = reader.read(form, |words| Heading::parse(words, program))?;
    let lemma = proved(program, &heading, reader)?;
    reader.demand("size", &lemma.bound.size)?;
    reader.demand("computed", &lemma.bound.computed)?;
    reader.demand("error", &lemma.bound.error)?;
    program.lemmas.insert(heading.place, lemma);
    Ok(())
}

/// The lemma that its rule proves.
fn proved(program: &Program, heading: &Heading, reader: &mut Reader) -> Outcome<Lemma> {
    let Heading {
        place,
        by_reciprocal,
        ..
    } = *heading;
    let bound = match heading.rule {
        Rule::Sum => return sum(program, place, reader),
        Rule::Unit => return unit::lemma(program, place),
        Rule::Quotient => quotient::bound(program, place, by_reciprocal, reader)?,
        Rule::SumOfQuotients => two_quotients::sum(program, place, by_reciprocal, reader)?,
        Rule::RestOfQuotients => two_quotients::rest(program, place, by_reciprocal, reader)?,
    };
    Ok(Lemma {
        before: bound.error.clone(),
        bound,
        unit: None,
    })
}

/// The lemma of a sum of products: "Formulas without divisions" in the guide. The computed number has two bounds, one
/// from the operands' computed sizes, and one from its size and its error.
fn sum(program: &Program, place: usize, reader: &mut Reader) -> Outcome<Lemma> {
    let formula = Formula::read(program, None, reader)?;
    ensure(
        formula.place() == Some(place),
        format!("found another last step, expected operation {place}"),
    )?;
    let shown = formula.maximum(reader)?;
    let mut bound = shown.bound;
    bound.size = round_up(&bound.size, SIZE_DIGITS);
    bound.error = round_up(&bound.error, ERROR_DIGITS);
    let by_error = &bound.size + &bound.error;
    bound.computed = bound.computed.min(by_error);
    Ok(Lemma {
        bound,
        before: shown.before,
        unit: None,
    })
}
