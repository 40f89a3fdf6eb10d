//! The findings, whose pages are written in Markdown.

use crate::page::{Pages, slug};
use maud::PreEscaped;
use pulldown_cmark::{Options, Parser};
use std::fs;
use std::path::Path;

/// A page of league/findings.
pub struct Finding {
    /// The name of its file, which the results of an edition link to.
    pub file: String,
    pub slug: String,
    pub title: String,
    /// Without the title.
    text: String,
}

/// All of a folder, by name.
pub fn read(folder: &Path) -> Result<Vec<Finding>, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut findings = Vec::new();
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let text =
            fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let file = path
            .file_name()
            .expect("a file")
            .to_string_lossy()
            .into_owned();
        let (title, text) = text
            .strip_prefix("# ")
            .and_then(|text| text.split_once('\n'))
            .ok_or(format!("{}: expected a title, '# …'", path.display()))?;
        let slug = slug(file.trim_end_matches(".md"));
        findings.push(Finding {
            slug,
            title: title.to_owned(),
            text: text.to_owned(),
            file,
        });
    }
    findings.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(findings)
}

/// The pages.
pub fn write(pages: &mut Pages, findings: &[Finding]) -> Result<(), String> {
    for finding in findings {
        let mut body = String::new();
        let parser = Parser::new_ext(&finding.text, Options::ENABLE_TABLES);
        pulldown_cmark::html::push_html(&mut body, parser);
        let path = format!("finding/{}.html", finding.slug);
        pages.page(&path, &finding.title, &PreEscaped(body))?;
    }
    Ok(())
}
