//! A record of an audit or a check as a page: the answer, the rest of the screen, and folded everything.

use super::columns::Column;
use super::headline;
use super::kernel;
use super::lines::lines;
use super::row_view::RowView;
use super::{ranking, screen, verdict};
use crate::mesh;
use crate::page::{Block, Page, Paged, Tone};
use hairline_record::*;
use hairline_record::{ComparisonVerdict, Record, group_digits, number_of};
use std::collections::BTreeSet;

impl Paged for Record {
    fn page(&self) -> Page {
        if let (Some(mesh), None) = (&self.result.mesh, &self.conformance) {
            return mesh::page(self, mesh);
        }
        let columns = Column::all(self);
        let lines = lines(self, &columns);
        let (title, on_screen) = screen::blocks(self, &columns, &lines);
        let mut page = Page {
            command: "audit",
            title,
            ..Page::default()
        };
        match &self.conformance {
            None => page.blocks = on_screen,
            Some(conformance) => {
                let headline = headline::headline(self, conformance);
                let run_title = std::mem::replace(&mut page.title, headline);
                page.tone = match conformance.verdict {
                    ComparisonVerdict::Conforms => Tone::Good,
                    ComparisonVerdict::Disagreements | ComparisonVerdict::Unsteady => Tone::Bad,
                    ComparisonVerdict::Stale => Tone::Stale,
                };
                page.command = "check";
                page.blocks = verdict::blocks(self, conformance);
                let run = [Block::Text(run_title)]
                    .into_iter()
                    .chain(on_screen)
                    .collect();
                page.blocks.push(Block::Details("The run".to_owned(), run));
            }
        }
        page.blocks
            .extend(broken_families(self).into_iter().map(Block::Text));
        page.blocks
            .extend(incomplete_meshes(self).into_iter().map(Block::Text));
        let of_scalars = lines.chunk_by(|one, other| one.row.scalar == other.row.scalar);
        let tables = of_scalars.map(|lines| ranking::of_scalar(self, &columns, lines));
        let tables: Vec<Block> = tables.collect();
        // That of one scalar is on the screen.
        if 1 < tables.len() {
            page.blocks
                .push(Block::Details("Every question".to_owned(), tables));
        }
        let rows = &self.result.plan.rows;
        for row in rows {
            let of_row = lines.iter().filter(|line| std::ptr::eq(line.row.part, row));
            let views: Vec<&RowView> = of_row.map(|line| &line.row).collect();
            if !views.is_empty() {
                page.blocks.push(Block::Details(
                    row.label(),
                    kernel::blocks(self, row, &views),
                ));
            }
        }
        page.blocks
            .push(Block::Details("About this run".to_owned(), about(self)));
        page
    }
}

/// How the record was made, and how it is made again.
fn about(record: &Record) -> Vec<Block> {
    let provenance = &record.provenance;
    let mut terms = vec![
        ("plan", record.result.plan.hash.clone()),
        ("target", provenance.target.clone()),
        (
            "time",
            format!(
                "{:.1} s on {}",
                provenance.seconds,
                number_of(provenance.threads as u64, "thread", "threads")
            ),
        ),
    ];
    let again = provenance.plan_flags.as_ref();
    terms.extend(again.map(|flags| ("again", flags.command(&flags.kernels))));
    vec![Block::terms(terms)]
}

/// The sources that are not what their family promises.
fn broken_families(record: &Record) -> Vec<String> {
    // In an instance none is kept, as the notes say.
    let is_broken = |source: &&SourcePart| 0 < source.promise_broken && !record.result.is_placed();
    let broken = record.result.sources.iter().filter(is_broken);
    let sentence = |source: &SourcePart| {
        let (n, of) = (
            group_digits(source.promise_broken),
            group_digits(source.indices),
        );
        let first = source.first_broken.as_deref().unwrap_or("-");
        format!(
            "{} {}: {n} of {of} indices are not what the family's promise says, first {first}",
            source.scalar, source.family
        )
    };
    broken.map(sentence).collect()
}

/// The meshes that are not all that their files hold.
fn incomplete_meshes(record: &Record) -> BTreeSet<String> {
    let sentence = |source: &SourcePart| {
        let count = number_of(source.left_out?, "polygon", "polygons");
        let file = source.family.split_once(':').map_or("", |(_, file)| file);
        Some(format!(
            "{file}: {count} left out, because they cross themselves or fold over"
        ))
    };
    record.result.sources.iter().filter_map(sentence).collect()
}
