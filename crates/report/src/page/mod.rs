//! The answer of a command in the order in which people read it: one value, from which every format for people is drawn.
//!
//! A study's record implements [`Paged`], and is then text, Markdown and HTML.

#[cfg(feature = "pages")]
pub(crate) mod html;
mod markdown;
mod readable;
mod table;
mod text;

#[cfg(feature = "pages")]
pub use html::elements;
pub use markdown::{LIMIT as MARKDOWN_LIMIT, within as markdown_within};
pub use table::{Cell, CellValue, Head, Row, Table};

pub use crate::chart::text_at;

use hairline_record::Record;

use crate::chart;
use crate::format::Format;
#[cfg(feature = "pages")]
use serde::Serialize;

/// The answer of one command.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// The command: `epsilon`.
    pub command: &'static str,
    /// The first line.
    pub title: String,
    /// How it went.
    pub tone: Tone,
    /// The rest.
    pub blocks: Vec<Block>,
}

/// How it went: the colour of a title.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Neither.
    #[default]
    Plain,
    /// As it should be.
    Good,
    /// A promise is broken.
    Bad,
    /// Better than expected.
    Stale,
}

/// A part of a page.
#[derive(Clone, Debug)]
pub enum Block {
    /// The title of what follows.
    Heading(String),
    /// Sentences.
    Text(String),
    /// Sentences, each by itself.
    Notes(Vec<String>),
    /// Something to paste, after a word, with notes.
    Use(Use),
    /// Numbers.
    Table(Table),
    /// Commands that lead on, after a word.
    Commands(&'static str, Vec<Command>),
    /// Words and what they mean.
    Terms(Vec<(String, String)>),
    /// Code, line by line as it is.
    Listing(String),
    /// Things one after the other, each with lines to paste.
    Items(Items),
    /// A drawing, where a format has pictures.
    Picture(Picture),
    /// A drawing that moves, where a format has scripts.
    Stage(Stage),
    /// Blocks for those who want everything, with a title.
    Details(String, Vec<Block>),
}

/// Something to paste.
#[derive(Clone, Debug, Default)]
pub struct Use {
    /// `use`, `or`, `not`.
    pub lead: String,
    /// The texts to paste, all of which it takes.
    pub parts: Vec<String>,
    /// Its meaning, a sentence each.
    pub notes: Vec<String>,
}

/// A command line, which is never broken, and what it is for.
#[derive(Clone, Debug)]
pub struct Command {
    /// The line.
    pub line: String,
    /// Its purpose; may be empty.
    pub what: &'static str,
}

/// Things one after the other.
#[derive(Clone, Debug, Default)]
pub struct Items {
    /// The things.
    pub items: Vec<Item>,
    /// So many stand on a screen; all where everything is told.
    pub most: usize,
}

/// A thing with what is said of it.
#[derive(Clone, Debug, Default)]
pub struct Item {
    /// A sentence.
    pub text: String,
    /// Further sentences.
    pub notes: Vec<String>,
    /// An address of the web where more is to be read.
    pub url: Option<String>,
    /// Lines to paste: commands.
    pub lines: Vec<String>,
    /// More lines, for those who want everything: bits.
    pub more: Vec<String>,
}

/// A drawing.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its content, for those who do not see it.
    pub about: String,
    /// A caption; may be empty.
    pub caption: String,
    /// The drawing itself.
    pub drawing: Drawing,
}

/// A drawing with controls, in HTML.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Its elements.
    pub markup: String,
    /// The style that they need beside the page's.
    pub style: &'static str,
    /// The script that moves it.
    pub script: &'static str,
}

/// The data of a drawing.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// Elements of SVG, in a width and a height.
    Chart(String, [f64; 2]),
    /// A whole SVG.
    Svg(String),
}

impl Picture {
    /// The drawing with its caption as an SVG file of its own, light or dark as the reader's screen is.
    pub fn file(&self) -> String {
        match &self.drawing {
            Drawing::Chart(elements, size) => {
                chart::captioned_file(&self.about, *size, elements, &self.caption)
            }
            Drawing::Svg(svg) => svg.clone(),
        }
    }
}

/// A record that is a page.
pub trait Paged {
    /// The page.
    fn page(&self) -> Page;
}

impl Paged for Page {
    fn page(&self) -> Page {
        self.clone()
    }
}

/// Where and how it was made is no part of the page.
impl<R: Paged> Paged for Record<R> {
    fn page(&self) -> Page {
        self.result.page()
    }
}

impl<R: Paged> Format<R> {
    /// For a terminal. The layout is not stable.
    pub const TEXT: Format<R> = Format {
        name: "text",
        write: |record, style, out| text::write(&record.page().readable(), style, out),
    };
    /// For a forge or a chat.
    pub const MARKDOWN: Format<R> = Format {
        name: "markdown",
        write: |record, style, out| markdown::write(&record.page(), style, out),
    };
    /// One file that needs nothing else: light and dark, wide and narrow, without scripts and without a network.
    #[cfg(feature = "pages")]
    pub const HTML: Format<R> = Format {
        name: super::HTML,
        write: |record, _, out| html::write(&record.page().readable(), out),
    };
}

#[cfg(feature = "pages")]
impl<R: Paged + Serialize> Format<R> {
    /// The formats of a record that is a page, and data.
    pub const OF_PAGE: &'static [Format<R>] =
        &[Format::TEXT, Format::JSON, Format::MARKDOWN, Format::HTML];
}

impl Item {
    /// A sentence by itself.
    pub fn of(text: String) -> Item {
        Item {
            text,
            ..Item::default()
        }
    }

    /// A finding, and the command that shows it.
    pub fn shown_by(text: String, command: String) -> Item {
        Item {
            text,
            lines: vec![command],
            ..Item::default()
        }
    }
}

impl Block {
    /// A sentence.
    pub fn text(text: impl Into<String>) -> Block {
        Block::Text(text.into())
    }

    /// Terms with their meanings.
    pub fn terms<'a>(terms: impl IntoIterator<Item = (&'a str, String)>) -> Block {
        Block::Terms(
            terms
                .into_iter()
                .map(|(term, meaning)| (term.to_owned(), meaning))
                .collect(),
        )
    }

    /// A title, and things below it; nothing if there are none.
    pub fn items(title: &str, most: usize, items: Vec<Item>) -> Vec<Block> {
        match items.is_empty() {
            true => Vec::new(),
            false => vec![
                Block::Heading(title.to_owned()),
                Block::Items(Items { items, most }),
            ],
        }
    }
}
