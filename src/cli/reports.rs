//! In which formats a record goes where.

use super::exit::Failure;
use super::output::{ColorChoice, paired_outputs, write_result};
use crate::report::{FORMATS, Format, Record, Style};
use clap::Args;

/// The flags that choose formats and files.
#[derive(Args)]
pub struct ReportArguments {
    /// text or json, or both separated by commas
    #[arg(long, value_delimiter = ',', value_name = "FORMAT", default_value = "text")]
    format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<String>,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    pub examples: usize,

    /// List the worst finding of every class, not only of every kind
    #[arg(long)]
    details: bool,

    /// When to colour the text
    #[arg(long, value_enum, default_value_t)]
    color: ColorChoice,
}

impl ReportArguments {
    /// Formats with where they go.
    pub fn outputs(&self) -> Result<Vec<(&'static Format, &str)>, Failure> {
        paired_outputs(FORMATS, |format| format.name, &self.format, &self.output)
    }

    /// Writes a record in each format.
    pub fn write(&self, outputs: &[(&Format, &str)], record: &Record) -> Result<(), Failure> {
        for (format, path) in outputs {
            let style = Style { color: self.color.enabled(*path == "-"), details: self.details };
            write_result(path, |out| (format.write)(record, style, out))?;
        }
        Ok(())
    }
}
