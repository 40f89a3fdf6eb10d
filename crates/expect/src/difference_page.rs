//! The comparison of two records as a page, and as tests of a build.

use super::difference::{Difference, RecordComparison};
use super::trend::{OtherValue, Trend};
use hairline_record::{group_digits, number_of};
use hairline_report::page::{Block, Item, Page, Paged, Tone};
use hairline_report::{Format, JunitCase, write_junit};
use std::collections::BTreeMap;

impl RecordComparison {
    /// The formats of a comparison.
    pub const FORMATS: &'static [Format<RecordComparison>] = &[
        Format::TEXT,
        Format::JSON,
        Format::MARKDOWN,
        Format::HTML,
        Format {
            name: "junit",
            write: |comparison, _, out| {
                let suites = [("before and now".to_owned(), comparison.tests())].into();
                write_junit(&suites, out)
            },
        },
    ];

    /// A test for each class that differs, which fails if it is worse; one that passes if none does.
    fn tests(&self) -> BTreeMap<(String, String), JunitCase> {
        let mut tests: BTreeMap<(String, String), JunitCase> = BTreeMap::new();
        for difference in &self.differences {
            let Item { text, lines, .. } = difference.item();
            let case = match difference.change {
                Trend::Worse => JunitCase {
                    failures: vec![(text, lines.join("\n"))],
                    notes: Vec::new(),
                },
                _ => JunitCase {
                    failures: Vec::new(),
                    notes: vec![text],
                },
            };
            tests.insert((difference.what.clone(), "wrong answers".to_owned()), case);
        }
        for value in self.chosen.iter().chain(&self.accuracy) {
            let Item { text, lines, .. } = value.item();
            let is_worse = value.change == Some(Trend::Worse);
            let failures = match is_worse {
                true => vec![(text, lines.join("\n"))],
                false => Vec::new(),
            };
            let case = JunitCase {
                failures,
                notes: Vec::new(),
            };
            tests.insert((value.what.clone(), "value".to_owned()), case);
        }
        if tests.is_empty() {
            let same = ("all".to_owned(), "nothing differs".to_owned());
            tests.insert(same, JunitCase::default());
        }
        tests
    }
}

/// So many of each trend stand on the screen.
const MOST: usize = 3;

impl Paged for RecordComparison {
    fn page(&self) -> Page {
        let count = |change| {
            self.differences
                .iter()
                .filter(|d| d.change == change)
                .count() as u64
        };
        let [worse, better, other, same] = [
            Trend::Worse,
            Trend::Better,
            Trend::Other,
            Trend::Insignificant,
        ]
        .map(count);
        let tone = match (self.is_worse(), better) {
            (true, _) => Tone::Bad,
            (false, 0) => Tone::Plain,
            (false, _) => Tone::Good,
        };
        let mut answers = Vec::new();
        if 0 < self.compared || self.chosen.is_empty() {
            let [worse, better] = [worse, better].map(group_digits);
            let mut trends = format!("{worse} worse, {better} better");
            let rarer = [
                (other, "as often but on other cases"),
                (same, "too little to tell"),
            ];
            for (count, what) in rarer.into_iter().filter(|(count, _)| 0 < *count) {
                trends += &format!(", {} {what}", group_digits(count));
            }
            answers.push(trends);
        }
        answers.extend(counted(&self.chosen, ["value differs", "values differ"]));
        answers.extend(counted(
            &self.accuracy,
            ["error of hits differs", "errors of hits differ"],
        ));
        if !self.contracts.is_empty() {
            let rows = number_of(self.contracts.len() as u64, "row is", "rows are");
            answers.push(format!("{rows} judged by another contract"));
        }
        let how = match self.same_cases {
            true => "the same cases: every difference counts",
            false => {
                "other cases, of some families at least: their rates differ if their Clopper-Pearson intervals at 0.05 / \
                 comparisons are disjoint"
            }
        };
        let compared = group_digits(self.compared as u64);
        let mut blocks = Vec::new();
        if 0 < self.compared {
            blocks.push(Block::Text(format!(
                "{compared} classes of disagreement compared, on {how}"
            )));
        }
        let values = |title: &str, most: usize, all: &[OtherValue]| {
            Block::items(title, most, all.iter().map(OtherValue::item).collect())
        };
        let title = "Judged by another contract, so that the rates answer another question";
        blocks.extend(values(title, 1, &self.contracts));
        for (count, whose) in [(self.only_old, "old"), (self.only_new, "new")] {
            if 0 < count {
                blocks.push(Block::Text(format!(
                    "{} are of kernels, epsilons, scalars or families that only the {whose} record has",
                    group_digits(count as u64)
                )));
            }
        }
        for (title, change) in [
            ("Worse", Trend::Worse),
            ("Better", Trend::Better),
            ("Other cases, as many", Trend::Other),
        ] {
            let of_change = self.differences.iter().filter(|d| d.change == change);
            blocks.extend(Block::items(
                title,
                MOST,
                of_change.map(Difference::item).collect(),
            ));
        }
        blocks.extend(values(
            "Values that were chosen or proved",
            MOST,
            &self.chosen,
        ));
        blocks.extend(values(
            "Errors of right hits, of a sample",
            MOST,
            &self.accuracy,
        ));
        Page {
            command: "diff",
            title: answers.join("; "),
            tone,
            blocks,
        }
    }
}

/// How many values differ, and how many of them are worse; none if none differ.
fn counted(values: &[OtherValue], [one, many]: [&str; 2]) -> Option<String> {
    let worse = values
        .iter()
        .filter(|it| it.change == Some(Trend::Worse))
        .count();
    let worse = if 0 < worse {
        format!(", {worse} of them worse")
    } else {
        String::new()
    };
    (!values.is_empty()).then(|| number_of(values.len() as u64, one, many) + &worse)
}

impl Difference {
    fn item(&self) -> Item {
        let (old, new) = (self.old.counts(), self.new.counts());
        let text = format!("{}: {old} before, {new} now{}", self.what, self.shown);
        Item {
            text,
            lines: self.command.iter().cloned().collect(),
            ..Item::default()
        }
    }
}
