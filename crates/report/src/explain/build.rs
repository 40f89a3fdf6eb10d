//! An explanation from the case itself: every kernel runs here once more, as it is and without rounding.

use super::advice::group_advice;
use super::row::{answered, row_part};
use super::verdict::{Together, group_verdict, number, verdict_of};
use super::{Explanation, InstancePart, TogetherPart, TrianglePart};
use crate::audit::{Row, exact_severity, polygon_verdict};
use crate::case::{Case, Instance, Ray};
use crate::contract::Extent;
use crate::corpus::lines::{self, StoredCase};
use crate::family::Grouping;
use crate::judge::{asked, judge, polygon_obligation, polygon_truth};
use crate::kernel::{Gives, Scalar};
use crate::map::sketch;
use crate::oracle::{self, Definition};
use crate::truth::ExactValues;
use num_traits::ToPrimitive;
use serde_json::value::RawValue;

/// Explains a case or a group with some rows.
pub fn explain<F: Scalar>(name: &str, group: Together<F>, rows: &[Row]) -> Explanation {
    let is_secondary = group.grouping == Grouping::SecondaryRay;
    let (cases, _) = group.asked(group.cases);
    let triangle = |(case, in_world): (&Case<F>, &Case<F>)| TrianglePart {
        rows: rows
            .iter()
            .map(|row| row_part(case, is_secondary, row))
            .collect(),
        instance: group
            .instance
            .map(|it| instance_part(it, [in_world, case], is_secondary, rows)),
        sketch: sketch(case, only(rows)),
        ..of_case(case, is_secondary)
    };
    let triangles = cases.iter().zip(group.cases).map(triangle).collect();
    let mut together = Vec::new();
    if 1 < group.cases.len() {
        for row in rows {
            together.extend(group_part(group, row));
            if group.grouping == Grouping::Polygon && row.entry.info.polygons {
                together.extend(polygon_part(group, row));
            }
        }
    }
    let is_json = name.trim_start().starts_with(['{', '[', '\u{feff}']);
    let case = if is_json { "this case" } else { name };
    let schema = "hairline-explanation/1";
    Explanation {
        schema,
        case: case.to_owned(),
        scalar: F::NAME,
        triangles,
        together,
        picture: None,
    }
}

/// The row, if there is one only.
fn only(rows: &[Row]) -> Option<&Row> {
    match rows {
        [row] => Some(row),
        _ => None,
    }
}

/// The inputs and the truth.
fn of_case<F: Scalar>(case: &Case<F>, is_secondary: bool) -> TrianglePart {
    let labels = ["origin", "direction", "a", "b", "c"];
    let vector = |(label, vector): (&str, [F; 3])| {
        let [x, y, z] = vector.map(number);
        [label.to_owned(), x, y, z, vector.map(F::hex).join(" ")]
    };
    let inputs = labels.into_iter().zip(case.vectors()).map(vector).collect();
    let stored = StoredCase {
        is_secondary,
        ..StoredCase::of(*case)
    };
    let line = lines::write_case(&stored);
    let Definition { truth, exact, .. } = oracle::define(case);
    // In the plane of the triangle there is no such distance.
    let from_boundary = exact_severity(case, Extent::Interval)
        .filter(|_| truth.crossing().is_some())
        .map(|severity| [severity.in_space, severity.in_space * severity.edge_in_ulps]);
    TrianglePart {
        case: RawValue::from_string(line).expect("a case is written as JSON"),
        truth: stored.truth_line(true),
        from_boundary,
        instance: None,
        rows: Vec::new(),
        in_words: match why_invalid(case) {
            Some(reason) => format!("{truth}: {reason}"),
            None => truth.to_string(),
        },
        exact: nearest_doubles(&exact),
        inputs,
        sketch: None,
        interval: [case.ray.t_min, case.ray.t_max].map(|t| [number(t), t.hex()]),
    }
}

/// The exact t, u and v that there are, by name, each as the nearest double; one beyond the range of doubles is left out.
fn nearest_doubles(exact: &ExactValues) -> Vec<(&'static str, f64)> {
    let values = [("t", &exact.t), ("u", &exact.u), ("v", &exact.v)];
    let mut doubles = Vec::new();
    for (name, value) in values {
        let double = value.as_ref().and_then(ToPrimitive::to_f64);
        if let Some(double) = double.filter(|double| double.is_finite()) {
            doubles.push((name, double));
        }
    }
    doubles
}

/// The answers of the rows held against the exact instance in the world.
fn instance_part<F: Scalar>(
    instance: &Instance<F>,
    [in_world, in_object]: [&Case<F>; 2],
    is_secondary: bool,
    rows: &[Row],
) -> InstancePart {
    let (exact, seen) = (
        oracle::define_instance(in_world, instance),
        oracle::define(in_object),
    );
    let values = |definition: &Definition| {
        let ExactValues { t, u, v, .. } = &definition.exact;
        Some([t.clone()?, u.clone()?, v.clone()?])
    };
    let moved = values(&exact).zip(values(&seen)).map(|(exact, seen)| {
        [0, 1, 2].map(|i| {
            (&seen[i] - &exact[i])
                .to_f64()
                .unwrap_or(f64::INFINITY)
                .abs()
        })
    });
    let finding = |row: &Row| {
        let subject = F::subject(row.entry)?;
        let verdict = verdict_of(subject, in_object, &row.epsilons());
        let owed = asked(in_object, &exact.truth, &row.contract, is_secondary);
        // Values belong to the ray that the kernel got.
        let gives = Gives::NOTHING;
        let finding = judge(
            (&row.contract, owed),
            (in_object, &exact.truth),
            gives,
            &verdict,
        )?;
        Some((row.label(), finding.name()))
    };
    InstancePart {
        matrix: instance
            .matrix()
            .map(|row| row.map(|number| number.to_f64())),
        truth: exact.truth.to_string(),
        moved,
        wrong: rows.iter().filter_map(finding).collect(),
    }
}

/// The reason for which no answer to a case is right; none if one is.
fn why_invalid<F: Scalar>(case: &Case<F>) -> Option<&'static str> {
    let (vectors, Ray { t_min, t_max, .. }) = (case.vectors(), case.ray);
    let any = |is_so: fn(F) -> bool| vectors.iter().flatten().any(|x| is_so(*x));
    let reasons = [
        (any(|x| x.is_nan()), "a coordinate is NaN"),
        (any(|x| !x.is_finite()), "a coordinate is infinite"),
        (vectors[1].iter().all(|x| x.is_zero()), "the direction is 0"),
        (t_min.is_nan() || t_max.is_nan(), "t_min or t_max is NaN"),
        (t_min > t_max, "t_min is greater than t_max"),
    ];
    reasons
        .into_iter()
        .find(|(holds, _)| *holds)
        .map(|(_, reason)| reason)
}

/// The contract's demand on the triangles together, and the kernel's answer.
fn group_part<F: Scalar>(group: Together<F>, row: &Row) -> Option<TogetherPart> {
    let subject = F::subject(row.entry)?;
    let (count, label) = (group.cases.len(), row.label());
    let part = |said: String, judged: &str, is_wrong| TogetherPart {
        row: label.clone(),
        said,
        judged: judged.to_owned(),
        advice: if is_wrong {
            group_advice(group, row)
        } else {
            String::new()
        },
        is_wrong,
    };
    Some(match group_verdict(group, row, subject) {
        Err(failure) => part(failure, "the group is not judged", false),
        Ok((hits, judged, is_wrong)) => {
            part(format!("{hits} of {count} triangles hit"), judged, is_wrong)
        }
    })
}

/// The kernel's answer on a polygon as a whole.
fn polygon_part<F: Scalar>(group: Together<F>, row: &Row) -> Option<TogetherPart> {
    let subject = F::subject(row.entry)?;
    let (cases, truths) = &group.asked(group.cases);
    let owed = polygon_obligation(cases, truths, &row.contract);
    let verdict = polygon_verdict(subject, cases, &row.epsilons());
    let (asked, union) = ((&row.contract, owed), (&cases[0], &polygon_truth(truths)));
    let gives = group
        .instance
        .map_or(row.entry.info.gives, |_| Gives::NOTHING);
    let finding = judge(asked, union, gives, &verdict);
    let answer = answered(owed, &verdict, finding);
    let corners = cases.len() + 2;
    Some(TogetherPart {
        row: row.label(),
        said: format!(
            "the polygon of {corners} corners as a whole: {}",
            answer.said
        ),
        judged: answer.judgement(),
        advice: String::new(),
        is_wrong: finding.is_some(),
    })
}
