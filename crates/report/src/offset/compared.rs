//! The part of what `offset` found that is compared with another run: how often each offset went wrong, and which is to be used.

use super::record::{OffsetResult, PointsPart, SchemePart, WrongPart};
use crate::segments::SegmentsPart;
use hairline_record::{Comparable, NamedRate, NamedValue, Rate, Study};

impl Comparable for OffsetResult {
    const STUDY: Study = Study::Offset;

    fn question(&self) -> String {
        let OffsetResult {
            scene,
            mesh,
            wall,
            fold,
            instance,
            ..
        } = self;
        let mesh = mesh
            .as_ref()
            .map_or(String::new(), |path| format!("mesh {path} "));
        let place = instance.map_or(String::new(), |matrix| format!(" at {matrix:?}"));
        format!("{mesh}{scene}{place}, wall {wall}, fold {fold}")
    }

    fn cases(&self) -> String {
        let OffsetResult {
            seed,
            pilot_seed,
            count,
            ..
        } = self;
        format!("{seed} {pilot_seed} {count}")
    }

    fn counted(&self) -> Vec<NamedRate> {
        let schemes = self
            .points
            .iter()
            .flat_map(|part| part.schemes.iter().map(move |scheme| (part.name(), scheme)));
        let segments = self.segments.iter().flat_map(SegmentsPart::counted);
        schemes
            .flat_map(|(of, scheme)| scheme.counted(&of))
            .chain(segments)
            .collect()
    }

    fn chosen(&self) -> Vec<NamedValue> {
        let derived = self.points.iter().filter_map(|part| {
            let value = part.derived.as_ref()?.normal.to_string();
            let what = format!(
                "{}: derived bound of the distance along the normal",
                part.name()
            );
            Some(NamedValue {
                what,
                value,
                is_bound: true,
            })
        });
        let best = self.points.iter().filter_map(|part| {
            let what = format!("{}: offset to use", part.name());
            Some(NamedValue::chosen(what, &part.best.as_ref()?.scheme))
        });
        derived.chain(best).collect()
    }
}

impl PointsPart {
    /// The kernel, the scalar and the kind of hit point in words.
    fn name(&self) -> String {
        format!(
            "{} ({}) {} {}",
            self.kernel, self.set, self.scalar, self.point
        )
    }
}

impl SchemePart {
    /// How often what went wrong, of a kind of hit point.
    fn counted(&self, of: &str) -> Vec<NamedRate> {
        let counted = |what: String, rate: &Rate, first: Option<&WrongPart>| NamedRate {
            what: format!("{of}: {}: {what}", self.name),
            rate: rate.clone(),
            command: first.map(|first| first.explain.clone()),
        };
        let here = [
            ("wrong sides", &self.wrong, self.first_wrong.as_ref()),
            ("self-hits", &self.self_hits, None),
            ("past a wall", &self.beyond_wall, None),
            ("past a fold", &self.past_neighbour, None),
        ];
        let here = here.map(|(what, rate, first)| counted(what.to_owned(), rate, first));
        let elsewhere = self.elsewhere.iter().flat_map(|on| {
            let kinds = [
                ("wrong sides", &on.wrong, on.first_wrong.as_ref()),
                ("self-hits", &on.self_hits, None),
            ];
            kinds.map(|(what, rate, first)| counted(format!("{what} on {}", on.plane), rate, first))
        });
        here.into_iter().chain(elsewhere).collect()
    }
}
