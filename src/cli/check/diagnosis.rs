//! The reason why a check fails, as far as running a kernel again can tell: the formula that a kernel of one's own computes, and
//! a short case.

use crate::audit::{Plan, Row};
use crate::case::Case;
use crate::corpus::lines::bare_case;
use crate::explore::{Signature, shorten, verdict_and_finding};
use crate::judge::Class;
use crate::kernel::Scalar;
use crate::oracle;
use crate::record::{ComputedFormula, Conformance, Deviation, FindingClass, ShortCase};
use crate::report::explain::misused_formula;

/// How many unexpected classes of a kernel are tried to find the formula that it computes.
const TRIED: usize = 10;

/// How many cases are shortened, of which the shortest is shown: each asks the kernel some 300 times.
const SHORTENED: usize = 3;

/// The formulas that kernels of one's own with unexpected answers compute, but for an epsilon or fused products.
pub(super) fn computed_formulas(plan: &Plan, conformance: &Conformance) -> Vec<ComputedFormula> {
    let foreign = plan.rows.iter().filter(|row| !row.entry.is_built_in());
    let formula_of = |row: &Row| {
        let found = conformance.unexpected.iter();
        let mut shown = found
            .filter(|found| is_of(found, row))
            .filter_map(|found| Some((found, found.bits.as_ref()?)))
            .take(TRIED);
        shown.find_map(|(found, bits)| {
            in_named_scalar!(found.scalar, F => misused_formula(&Case::<F>::from_hex(bits)?, row))
        })
    };
    foreign.filter_map(formula_of).collect()
}

/// The shortest of some cases of what got worse, each in as few digits as still show it; none if no single triangle shows it.
pub(super) fn short_case(plan: &Plan, conformance: &Conformance) -> Option<ShortCase> {
    let mut found: Vec<&Deviation> = conformance
        .unexpected
        .iter()
        .filter(|found| found.bits.is_some())
        .collect();
    // A wrong verdict on a crossing within the interval reads easiest, and what was never wrong tells most.
    let is_plain = |class: Class| class.crosses() && !class.is_off_the_interval();
    found.sort_by_key(|found| {
        (
            !found.finding.is_wrong_verdict(),
            !found.class.truth().is_some_and(is_plain),
            found.expected_count != Some(0),
        )
    });
    let shortened = found.into_iter().take(SHORTENED).filter_map(|found| {
        let row = plan.rows.iter().find(|row| is_of(found, row))?;
        let computed = conformance
            .computes
            .iter()
            .find(|it| (&it.kernel, &it.set) == (&found.kernel, &found.set));
        let published = computed.and_then(|it| published(it, row));
        in_named_scalar!(found.scalar, F => shortened::<F>(found, row, published.as_ref()))
    });
    shortened.min_by_key(|short| short.command.len())
}

/// Takes over what an earlier comparison of the same record found out, as far as it is about what got worse now.
pub(super) fn take_over(before: Conformance, conformance: &mut Conformance) {
    let unexpected = &conformance.unexpected;
    let is_worse = |computed: &ComputedFormula| {
        let is_of =
            |found: &Deviation| (&found.kernel, &found.set) == (&computed.kernel, &computed.set);
        unexpected.iter().any(is_of)
    };
    let is_still_worse = |short: &ShortCase| {
        let place = (&short.kernel, &short.set, short.scalar, &short.family);
        let kind = (short.class, short.finding);
        unexpected.iter().any(|found| {
            (&found.kernel, &found.set, found.scalar, &found.family) == place
                && (found.class, found.finding) == kind
        })
    };
    let computes = before.computes.into_iter().filter(is_worse).collect();
    let short_case = before.short_case.filter(is_still_worse);
    conformance.computes = computes;
    conformance.short_case = short_case;
}

/// True if a deviation is of a row, and not a failure: a kernel that crashes is not asked hundreds of times.
fn is_of(found: &Deviation, row: &Row) -> bool {
    (&*found.kernel, &found.set) == (row.entry.info.name, &row.set) && !found.finding.is_failure()
}

/// The formula that a kernel computes otherwise, as it is published, under the contract of the kernel.
fn published(computed: &ComputedFormula, row: &Row) -> Option<Row> {
    Row::named(&computed.formula, None, &row.contract.words(None)).ok()
}

/// The case of a deviation in as few digits as show the same finding, and on which the published formula is right if it is
/// right on the case; none if the row alone shows no such finding.
fn shortened<F: Scalar>(
    found: &Deviation,
    row: &Row,
    published: Option<&Row>,
) -> Option<ShortCase> {
    let case = Case::<F>::from_hex(found.bits.as_ref()?)?;
    let signature = Signature::of(row, &case)?;
    let is_same = found.finding == signature.finding.into()
        && found.class == FindingClass::Truth(signature.class);
    if !is_same {
        return None;
    }
    let is_right = |row: &&Row, case: &Case<F>| {
        F::subject(row.entry).is_some()
            && verdict_and_finding(row, &row.epsilons(), case).2.is_none()
    };
    let published = published.filter(|row| is_right(row, &case));
    // A start on the surface would be shorter, and another question.
    let place = |case: &Case<F>| oracle::truth(case).crossing().map(|it| it.place);
    let own_place = place(&case);
    let short = shorten(&case, |case| {
        place(case) == own_place
            && signature.is_shown(row, case)
            && published.is_none_or(|row| is_right(&row, case))
    });
    let line = bare_case(short);
    Some(ShortCase {
        kernel: found.kernel.clone(),
        set: found.set.clone(),
        scalar: found.scalar,
        family: found.family.clone(),
        class: found.class,
        finding: found.finding,
        right: published.map(|row| row.entry.info.name.to_owned()),
        bits: short.hex(),
        command: row.explain_command(&format!("'{line}'")),
    })
}
