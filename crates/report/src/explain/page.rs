//! The page of an explanation: the verdict, the gates that made it, the cause, what makes it right; then the truth and the
//! inputs.

use super::verdict::{self, plain, short};
use super::{ExplainedGate, ExplainedRow, Explanation, InstancePart, TogetherPart, TrianglePart};
use crate::lists::listed;
use crate::page::{Block, Cell, Head, Page, Paged, Row, Table, Tone};

/// With so many rows each is shown by itself.
const MOST_ROWS: usize = 2;

/// So many answers on all triangles together stand on a screen.
const MOST_TOGETHER: usize = 8;

/// The most names in the title.
const MOST_NAMES: usize = 3;

impl Paged for Explanation {
    fn page(&self) -> Page {
        let (title, is_wrong) = self.answer();
        let tone = if is_wrong { Tone::Bad } else { Tone::Plain };
        let mut blocks = self.all_together();
        let several = 1 < self.triangles.len();
        for (i, triangle) in self.triangles.iter().enumerate() {
            if several {
                blocks.push(Block::Heading(format!(
                    "triangle {i} of {}",
                    self.triangles.len()
                )));
            }
            let is_in_title = !several && triangle.rows.len() == 1;
            blocks.extend(of_triangle(triangle, [i == 0, !several], is_in_title));
        }
        blocks.extend(self.picture.clone().map(Block::Picture));
        let input = |triangle: &TrianglePart| Block::Listing(format!("{}\n", triangle.case.get()));
        let inputs = self.triangles.iter().map(input);
        blocks.push(Block::Details(
            "The case as JSON".to_owned(),
            inputs.collect(),
        ));
        Page {
            command: "explain",
            title,
            tone,
            blocks,
        }
    }
}

impl Explanation {
    /// The first sentence, and if something is wrong.
    fn answer(&self) -> (String, bool) {
        if let [part] = &self.together[..] {
            let text = format!(
                "{} {}, all triangles together: {}",
                part.row,
                self.scalar,
                part.sentence()
            );
            return (text, part.is_wrong);
        }
        if !self.together.is_empty() {
            let wrong = self.together.iter().filter(|part| part.is_wrong).count();
            let text = format!(
                "{wrong} of {} rows are wrong on {} in {}, all triangles together.",
                self.together.len(),
                self.case,
                self.scalar
            );
            return (text, 0 < wrong);
        }
        let rows: Vec<&ExplainedRow> = self
            .triangles
            .iter()
            .flat_map(|triangle| &triangle.rows)
            .collect();
        if let [row] = rows[..] {
            let text = sentence(row);
            let Some(instance) = self.triangles.first().and_then(|it| it.instance.as_ref()) else {
                return (text, row.finding.is_some());
            };
            // The verdict that counts is that of the world.
            let in_world = instance
                .wrong
                .iter()
                .find(|(label, _)| *label == row.label());
            let text = match (in_world, row.finding) {
                (Some((label, finding)), None) => format!(
                    "{label}: {} of the exact instance in the world, by the rounded inverse (transform): on the ray that it got, it \
                     is right",
                    finding.to_uppercase()
                ),
                (Some(_), Some(_)) => format!("{text}, in the world as well"),
                (None, Some(_)) => {
                    format!("{text} on the ray that it got; in the world, as it should")
                }
                (None, None) => text,
            };
            return (text, in_world.is_some());
        }
        let wrong: Vec<String> = rows
            .iter()
            .filter(|row| row.finding.is_some())
            .map(|row| row.label())
            .collect();
        let names = listed(&wrong, MOST_NAMES);
        let (case, scalar) = (&self.case, self.scalar);
        let hits = rows.iter().filter(|row| row.said == "hit").count();
        match wrong.len() {
            0 if rows.iter().all(|row| row.asked == "nothing") => {
                let text = format!(
                    "No contract of the {} rows asks anything of {case} in {scalar}: {hits} of them hit.",
                    rows.len()
                );
                (text, false)
            }
            0 => (
                format!(
                    "All {} rows do as they should on {case} in {scalar}.",
                    rows.len()
                ),
                false,
            ),
            count => {
                let are = if count == 1 { "is" } else { "are" };
                let text = format!(
                    "{count} of {} rows {are} wrong on {case} in {scalar}: {names}.",
                    rows.len()
                );
                (text, true)
            }
        }
    }

    /// The rows on all triangles together, the wrong ones first; one alone stands in the title.
    fn all_together(&self) -> Vec<Block> {
        let mut parts: Vec<&TogetherPart> = self.together.iter().collect();
        parts.sort_by_key(|part| !part.is_wrong);
        match parts.len() {
            0 | 1 => Vec::new(),
            2..=MOST_ROWS => parts
                .into_iter()
                .map(|part| Block::Text(format!("{}: {}", part.row, part.sentence())))
                .collect(),
            _ => {
                let row = |part: &TogetherPart| {
                    let said = Cell::words(part.said.replace(" triangles hit", " hit"));
                    let judged = Cell::words(&part.judged).broken_if(part.is_wrong);
                    Row::new(&part.row, [said, judged])
                };
                let heads = ["kernel (epsilons)", "together", "is"].map(Head::text);
                let rows = parts.iter().map(|part| row(part)).collect();
                let mut blocks = vec![Block::Table(
                    Table::new(heads.into(), rows).at_most(MOST_TOGETHER),
                )];
                if let Some(part) = parts.iter().find(|part| !part.advice.is_empty()) {
                    blocks.push(Block::Text(format!("right here: {}", part.advice)));
                }
                blocks
            }
        }
    }
}

impl TogetherPart {
    fn sentence(&self) -> String {
        let advice = match self.advice.as_str() {
            "" => String::new(),
            names => format!("; right here: {names}"),
        };
        format!("{}; {}{advice}", self.said, self.judged)
    }
}

/// The rows on a triangle, its truth and its inputs.
fn of_triangle(
    triangle: &TrianglePart,
    [is_first, is_alone]: [bool; 2],
    is_in_title: bool,
) -> Vec<Block> {
    let rows = &triangle.rows;
    let mut blocks = Vec::new();
    if rows.len() <= MOST_ROWS {
        for row in rows {
            if !is_in_title {
                blocks.push(Block::Heading(sentence(row)));
            }
            blocks.extend(of_row(row, is_first));
        }
    } else {
        let most = if is_alone { 0 } else { MOST_TOGETHER };
        blocks.push(Block::Table(all_rows(rows).at_most(most)));
        let each = rows
            .iter()
            .flat_map(|row| [vec![Block::Heading(sentence(row))], of_row(row, is_first)].concat());
        blocks.push(Block::Details("Each row".to_owned(), each.collect()));
    }
    let [[t_min, low], [t_max, high]] = &triangle.interval;
    let mut terms = vec![("truth", format!("{}{}", triangle.in_words, exact(triangle)))];
    if let Some([edges, ulps]) = triangle.from_boundary {
        let passes = match edges {
            0.0 => "meets the boundary exactly".to_owned(),
            _ => {
                let [edges, ulps] = [edges, ulps].map(short);
                format!(
                    "passes {edges} of the longest edge ({ulps} ulps) from the boundary, in space"
                )
            }
        };
        terms.push(("line", passes));
    }
    if let Some(instance) = &triangle.instance {
        terms.push(("world", in_world(instance)));
    }
    if is_first {
        terms.push(("t", format!("in [{t_min}, {t_max}] ({low} {high})")));
    }
    blocks.push(Block::terms(terms));
    // A screen of many rows has no room for it.
    let has_room = is_alone && rows.len() <= MOST_ROWS;
    let sketch = triangle.sketch.as_ref().filter(|_| has_room);
    blocks.extend(sketch.cloned().map(Block::Listing));
    blocks.push(Block::Table(inputs(triangle, is_first)));
    blocks
}

/// The exact answer for an instance, what rounding the inverse costs, and the rows that are wrong by it.
fn in_world(instance: &InstancePart) -> String {
    let moved = instance.moved.map_or(String::new(), |moved| {
        let [t, u, v] = moved.map(short);
        format!("; the rounded inverse moves t by {t}, u by {u}, v by {v}")
    });
    let wrong: Vec<String> = instance
        .wrong
        .iter()
        .map(|(row, finding)| format!("{row} {}", finding.to_uppercase()))
        .collect();
    let wrong = if wrong.is_empty() {
        "none".to_owned()
    } else {
        wrong.join(", ")
    };
    format!("{}{moved}; wrong there: {wrong}", instance.truth)
}

/// The exact values, where there are any: fractions are approximated.
fn exact(triangle: &TrianglePart) -> String {
    let values: Vec<String> = triangle
        .exact
        .iter()
        .map(|(name, value)| format!("{name} = {}", verdict::number(*value)))
        .collect();
    if values.is_empty() {
        String::new()
    } else {
        format!("; {}", values.join(", "))
    }
}

fn sentence(row: &ExplainedRow) -> String {
    if row.runs {
        format!("{}: {}", row.label(), row.judged())
    } else {
        format!("{}: {}", row.label(), row.said)
    }
}

/// Why, what to do, and the gates.
fn of_row(row: &ExplainedRow, is_first: bool) -> Vec<Block> {
    let mut blocks = Vec::new();
    let finding = row.finding.unwrap_or_default();
    blocks.extend(
        row.why
            .iter()
            .map(|why| Block::Text(format!("why the {finding}: {why}"))),
    );
    if !row.advice.is_empty() {
        blocks.push(Block::text("right on this case (tried):"));
        blocks.push(Block::Notes(row.advice.clone()));
    }
    blocks.extend(row.notes.iter().cloned().map(Block::Text));
    let is_shown = |gate: &ExplainedGate| gate.margin.is_some() || gate.decision.is_some();
    if row.gates.iter().any(is_shown) {
        blocks.push(Block::Table(gates(row, is_first)));
    } else if !row.gates.is_empty() {
        let all = row.gates.iter().filter_map(|gate| {
            gate.epsilon
                .as_ref()
                .map(|epsilon| format!("{} = {epsilon}", gate.gate))
        });
        let all = all.collect::<Vec<_>>().join(", ");
        blocks.push(Block::Text(format!(
            "with {all}; it does not show what it compares"
        )));
    }
    if let Some(verdict) = row.without_rounding {
        blocks.push(Block::Text(format!(
            "the same formula without rounding: {verdict}"
        )));
    }
    blocks.extend(row.values.iter().cloned().map(Block::Text));
    if is_first && !row.contract.is_empty() {
        blocks.push(Block::Text(format!("contract: {}", row.contract)));
    }
    blocks
}

/// The gates in the order of the test; the comparison of each below it.
fn gates(row: &ExplainedRow, is_first: bool) -> Table {
    let runs = row
        .gates
        .iter()
        .all(|gate| gate.exact.is_none() && gate.exactly.is_none());
    let mut heads = vec![Head::of("gate")];
    heads.push(Head::of(if runs {
        "accepts up to e ="
    } else {
        "compares"
    }));
    if !runs {
        heads.push(Head::of("exactly"));
    }
    heads.push(Head::of("e"));
    heads.push(Head::text("decision"));
    let text = |value: &Option<String>| value.as_deref().map_or("-".to_owned(), plain);
    let table_row = |gate: &ExplainedGate| {
        let mut decision = gate.decision.unwrap_or("-").to_owned();
        if gate.is_fixed {
            decision += " at every e";
        }
        let is_wrong = matches!((gate.decision, gate.exactly), (Some(a), Some(b)) if a != b);
        if is_wrong {
            decision += ", WRONG";
        }
        if gate.decides {
            decision += " <- decides";
        }
        let mut cells = vec![Cell::words(text(&gate.margin))];
        if !runs {
            cells.push(Cell::words(text(&gate.exact)));
        }
        cells.push(Cell::words(gate.epsilon.as_deref().unwrap_or("fixed")));
        cells.push(Cell::words(decision).broken_if(is_wrong));
        let mut below = if is_first {
            vec![format!("refuses where {}", gate.refuses)]
        } else {
            Vec::new()
        };
        if is_wrong {
            below.push(format!(
                "WRONG: without rounding it {}",
                gate.exactly.unwrap_or_default()
            ));
        }
        Row {
            below,
            ..Row::new(gate.gate, cells)
        }
    };
    Table::new(heads, row.gates.iter().map(table_row).collect())
}

/// Many rows: the verdict of each, the gate that made it, and the cause.
fn all_rows(rows: &[ExplainedRow]) -> Table {
    let heads = vec![
        Head::of("kernel (epsilons)"),
        Head::text("says"),
        Head::text("is"),
        Head::text("decided by"),
        Head::text("cause"),
    ];
    let row = |row: &ExplainedRow| {
        let judged = match (row.asked, row.finding) {
            ("", _) => "-".to_owned(),
            (_, Some(finding)) => finding.to_uppercase(),
            _ => "right".to_owned(),
        };
        let gate = row.decisive().map_or("", |gate| gate.gate);
        let cells = [
            Cell::words(&row.said),
            Cell::words(judged).broken_if(row.finding.is_some()),
            Cell::words(gate),
            Cell::words(&row.cause),
        ];
        Row::new(row.label(), cells)
    };
    // The wrong ones first.
    let wrong = rows.iter().filter(|row| row.finding.is_some());
    let others = rows.iter().filter(|row| row.finding.is_none());
    Table::new(heads, wrong.chain(others).map(row).collect())
}

/// The ray and the triangle, in numbers and in bits.
fn inputs(triangle: &TrianglePart, is_first: bool) -> Table {
    let heads = ["vector", "x", "y", "z"].map(Head::of);
    let heads = heads
        .into_iter()
        .chain([Head::text("bits").optional()])
        .collect();
    let row =
        |[label, x, y, z, bits]: &[String; 5]| Row::new(label, [x, y, z, bits].map(Cell::words));
    // The ray is that of the first triangle.
    let before = if is_first { 0 } else { 2 };
    Table::new(
        heads,
        triangle.inputs.iter().skip(before).map(row).collect(),
    )
}
