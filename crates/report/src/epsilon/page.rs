//! A study of epsilons as a page: of one kernel or two what to use, and why; of more a table.

use super::answer::{scene, title};
use super::evidence::of_kernel;
use super::legend::how_to_read;
use super::ranking;
use super::record::{SceneRecord, SceneResult};
use super::standing::standing;
use crate::page::{Block, Page, Paged, Tone};

impl Paged for SceneRecord {
    fn page(&self) -> Page {
        let result = &self.result;
        let is_ranked = ranking::is_needed(result);
        let mut page = if is_ranked {
            ranking::page(self)
        } else {
            result.of_kernels()
        };
        let left_out = result
            .left_out
            .iter()
            .map(|why| Block::Text(format!("Left out: {why}.")));
        page.blocks.splice(0..0, left_out);
        page
    }
}

impl SceneResult {
    /// Each kernel in each scalar by itself.
    fn of_kernels(&self) -> Page {
        let mut page = Page {
            command: "epsilon",
            ..Page::default()
        };
        for (i, part) in self.kernels.iter().enumerate() {
            let on = if self.has_scene() { "in" } else { "on" };
            let title = format!("{} {on} {}", title(self, part), scene(self));
            match i {
                0 => page.title = title,
                _ => page.blocks.push(Block::Heading(title)),
            }
            page.blocks.extend(of_kernel(self, part));
        }
        page.blocks
            .push(Block::Details("How to read".to_owned(), how_to_read(self)));
        let tones = self.kernels.iter().map(|part| standing(self, part).0);
        page.tone = if tones.clone().all(|tone| tone == Tone::Good) {
            Tone::Good
        } else {
            Tone::Plain
        };
        if tones.clone().all(|tone| tone == Tone::Bad) {
            page.tone = Tone::Bad;
        }
        page
    }
}
