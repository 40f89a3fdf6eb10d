//! Verdicts by question: the columns of the screen and of the summary in Markdown.

use super::row_view::{RowView, WRONG};
use crate::audit::{Octave, Trials, is_of_mesh, kind_of};
use crate::case::SceneKind;
use crate::family::Question;
use hairline_record::*;
use hairline_record::{family_of, is_at_shared};

/// The sources of one question, all of them samples or all of them complete sets; of a scene's kinds of planes and rays
/// one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Column {
    kind: SceneKind,
    topic: ColumnTopic,
    /// True if its sources are whole sets, which have counts, and no interval.
    pub(super) complete: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum ColumnTopic {
    Families(Question),
    Mesh,
    Stored,
}

/// The sizes of the triangles of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ColumnSizes {
    /// As scenes have them.
    Ordinary,
    /// Tiny, huge, far or thin.
    Unusual,
    /// Numbers at the ends of the range, or whose exponents have nothing to do with each other.
    Extreme,
}

impl Column {
    /// The column of a source by its name.
    fn of(family: &str, complete: bool) -> Column {
        let question = family_of(family).map(|family| family.question);
        let topic = match question {
            Some(question) => ColumnTopic::Families(question),
            None if is_of_mesh(family) => ColumnTopic::Mesh,
            None => ColumnTopic::Stored,
        };
        Column {
            kind: kind_of(family),
            topic,
            complete,
        }
    }

    /// The columns of a record in which some kernel must give a verdict, in order: of a scene those of the kind that its
    /// words name.
    pub(super) fn all(record: &Record) -> Vec<Column> {
        let mut all = Column::in_all_kinds(record);
        let own = kinds(record)[0];
        all.retain(|column| column.kind == own);
        all
    }

    /// The same in all kinds of planes and rays.
    pub(super) fn in_all_kinds(record: &Record) -> Vec<Column> {
        let mut all: Vec<Column> = Vec::new();
        for result in &record.result.results {
            let total = &result.total;
            if 0 < total.false_misses.of + total.false_hits.of {
                all.push(Column::of(
                    &result.family,
                    is_complete(&record.result.sources, result),
                ));
            }
        }
        all.sort();
        all.dedup();
        all
    }

    /// The same question in another kind of planes and rays.
    pub(super) fn of_kind(self, kind: SceneKind) -> Column {
        Column { kind, ..self }
    }

    /// Its head.
    pub(super) fn label(self) -> &'static str {
        match self.topic {
            ColumnTopic::Families(Question::Grid) if self.complete => "lattice",
            ColumnTopic::Families(question) => question.name(),
            ColumnTopic::Mesh => "mesh",
            ColumnTopic::Stored => "stored",
        }
    }

    /// The contents of the column, where its head does not say them.
    pub(super) fn about(self) -> &'static str {
        match self.topic {
            ColumnTopic::Families(Question::Grid) if self.complete => "every case of the lattice",
            ColumnTopic::Families(question) => question.contents(),
            ColumnTopic::Mesh | ColumnTopic::Stored => "",
        }
    }

    /// The sizes of its triangles.
    pub(super) fn sizes(self) -> ColumnSizes {
        match self.topic {
            ColumnTopic::Families(question) if !question.is_ordinary() => ColumnSizes::Extreme,
            ColumnTopic::Families(Question::Sizes) => ColumnSizes::Unusual,
            _ => ColumnSizes::Ordinary,
        }
    }

    /// True if its cases are of sizes that occur.
    pub(super) fn is_ordinary(self) -> bool {
        self.sizes() != ColumnSizes::Extreme
    }

    /// True if a source belongs to it.
    pub(super) fn has(self, source: &SourcePart) -> bool {
        self == Column::of(&source.family, !source.sample)
    }

    /// One row's results in it.
    pub(super) fn results<'a>(self, row: &RowView<'a>) -> Vec<&'a KernelResult> {
        let of = |part: &&KernelResult| Column::of(&part.family, is_complete(row.sources, part));
        row.results
            .iter()
            .copied()
            .filter(|part| self == of(part))
            .collect()
    }
}

/// True if the cases of a source are of sizes that occur, by its name.
pub(super) fn is_of_ordinary_size(family: &str) -> bool {
    Column::of(family, true).is_ordinary()
}

/// The kinds of a record's planes and rays; the one that tables are about comes first.
pub(super) fn kinds(record: &Record) -> Vec<SceneKind> {
    let mut kinds: Vec<SceneKind> = Vec::new();
    for source in &record.result.plan.sources {
        let kind = kind_of(&source.family);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    // A plan without sources has results of none.
    if kinds.is_empty() {
        vec![SceneKind::ALL[0]]
    } else {
        kinds
    }
}

/// True if a result's source is a whole set rather than a random sample.
fn is_complete(sources: &[SourcePart], part: &KernelResult) -> bool {
    let of = |source: &&SourcePart| source.scalar == part.scalar && source.family == part.family;
    sources.iter().find(of).is_some_and(|source| !source.sample)
}

/// The verdicts of one row in one column.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ColumnCell {
    /// False misses and false hits among the cases on which the contract demands a verdict.
    pub(super) wrong: Trials,
    /// Wrong verdicts that are off by [`FAR`] longest edges or more.
    pub(super) far: u64,
}

/// A wrong verdict that can be seen: 2^-10 longest edges, about a thousandth.
const FAR: i32 = -10;

impl ColumnCell {
    /// The values of a row's hits, in the columns of ordinary sizes.
    pub(super) fn of_values(columns: &[Column], row: &RowView) -> ColumnCell {
        let mut cell = ColumnCell::default();
        for column in columns.iter().filter(|column| column.is_ordinary()) {
            for result in column.results(row) {
                cell.wrong.merge(&result.total.wrong_values.trials());
            }
        }
        cell
    }

    /// The sum of results.
    pub(super) fn sum(results: &[&KernelResult]) -> ColumnCell {
        let mut cell = ColumnCell::default();
        for result in results {
            if let (true, Some(across)) = (is_at_shared(&result.family), &result.across) {
                cell.wrong.merge(&across.cracks.trials());
                continue;
            }
            for (kind, rate) in WRONG {
                cell.wrong.merge(&rate(&result.total).trials());
                cell.far += far(result, kind);
            }
        }
        cell
    }
}

/// The answers that can be seen to be wrong: verdicts, and values of hits, that are off by [`FAR`] longest edges or more.
pub(super) fn visible(results: &[&KernelResult]) -> u64 {
    let values = results
        .iter()
        .map(|result| far(result, FindingKind::WrongValue));
    ColumnCell::sum(results).far + values.sum::<u64>()
}

/// The note on the shared edges and vertices of a scene or a mesh, where a neighbour may take a ray that a triangle leaves.
pub(super) fn shared_in_scenes(record: &Record) -> Option<&'static str> {
    let sources = &record.result.plan.sources;
    sources.iter().any(|source| is_at_shared(&source.family)).then_some(
        "At edges and vertices that triangles share a ray is wrong if no triangle reports it (a crack); which of them does, \
         and whether two do, changes no nearest hit.",
    )
}

/// The findings of a kind that are off by [`FAR`] longest edges or more.
fn far(result: &KernelResult, kind: FindingKind) -> u64 {
    let Some(severity) = result.severity.get(&kind) else {
        return 0;
    };
    severity
        .edges
        .octaves
        .range(Octave::From(FAR)..)
        .map(|(_, n)| n)
        .sum()
}

/// The outcomes of groups of triangles, for one row.
#[derive(Clone, Debug)]
pub(super) struct AcrossColumn {
    promised: Promised,
    /// Crossings without a hit in ordinary sizes: how many, of how many. If none is of ordinary size, of all.
    pub(super) cracks: [u64; 2],
    /// Crossings without a hit in other sizes.
    pub(super) extreme_cracks: [u64; 2],
    /// Crossings with two hits or more.
    pub(super) doubles: [u64; 2],
    /// Folds with the wrong parity.
    odd_folds: u64,
}

impl AcrossColumn {
    /// The sum of a row's results of a kind of planes; none without a crossing.
    pub(super) fn of(row: &RowView, kind: SceneKind) -> Option<AcrossColumn> {
        let results = || {
            row.results
                .iter()
                .filter(|result| kind_of(&result.family) == kind)
        };
        let parts = || results().filter_map(|result| result.across.as_ref());
        let ordinary = results().filter(|result| is_of_ordinary_size(&result.family));
        let ordinary = ordinary.filter_map(|result| result.across.as_ref());
        let [mut cracks, all] = [
            sum(ordinary, |it| &it.cracks),
            sum(parts(), |it| &it.cracks),
        ];
        if cracks[1] == 0 {
            cracks = all;
        }
        let doubles = sum(parts(), |it| &it.doubles);
        let odd_folds = sum(parts(), |it| &it.odd_folds)[0];
        let extreme_cracks = [all[0] - cracks[0], all[1] - cracks[1]];
        let promised = parts().next()?.promised;
        let across = AcrossColumn {
            promised,
            cracks,
            extreme_cracks,
            doubles,
            odd_folds,
        };
        (0 < all[1]).then_some(across)
    }

    /// True if the contract rules out cracks, and true if it rules out doubles.
    pub(super) fn rules_out(&self) -> [bool; 2] {
        let [cracks, doubles, _] = self.promised.rules_out();
        [cracks, doubles]
    }

    /// True if something happened that the contract rules out, in any size.
    pub(super) fn is_broken(&self) -> bool {
        let happened = [
            self.cracks[0] + self.extreme_cracks[0],
            self.doubles[0],
            self.odd_folds,
        ];
        self.promised
            .rules_out()
            .into_iter()
            .zip(happened)
            .any(|(ruled_out, n)| ruled_out && 0 < n)
    }

    /// True if all that happened so are leaks in other than ordinary sizes.
    pub(super) fn is_broken_by_extremes(&self) -> bool {
        let [_, no_doubles, no_odd_folds] = self.promised.rules_out();
        let is_broken_otherwise =
            no_doubles && 0 < self.doubles[0] || no_odd_folds && 0 < self.odd_folds;
        self.is_broken() && self.cracks[0] == 0 && !is_broken_otherwise
    }

    /// The promise, and the word `kept` or `BROKEN`; none without a promise.
    pub(super) fn promise(&self) -> Option<String> {
        let kept = if self.is_broken() { "BROKEN" } else { "kept" };
        self.promised
            .in_short()
            .map(|promise| format!("{promise}: {kept}"))
    }
}

/// The sum of a rate of some parts: how many, of how many.
fn sum<'a>(
    parts: impl Iterator<Item = &'a AcrossPart>,
    rate: fn(&AcrossPart) -> &Rate,
) -> [u64; 2] {
    parts
        .map(rate)
        .fold([0, 0], |[n, of], rate| [n + rate.count, of + rate.of])
}

/// A share in percent in four characters: `0`, `<0.1`, `12.3`, `100`.
pub(super) fn short_percent([count, of]: [u64; 2]) -> String {
    let tenths = (count as f64 / of as f64 * 1000.0).round();
    match count {
        _ if of == 0 => "-".to_owned(),
        0 => "0".to_owned(),
        _ if count == of => "100".to_owned(),
        _ if tenths < 1.0 => "<0.1".to_owned(),
        _ => format!("{:.1}", tenths.min(999.0) / 10.0),
    }
}
