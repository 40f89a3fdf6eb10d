//! `league-site FOLDER [EDITION] [URL]`: an edition as pages that work from a folder: one for each entrant, each
//! finding, each deepest case and each epsilon in use, and a badge for each entrant and scalar. Run it from the
//! project's root.

mod badges;
mod cases;
mod drawing;
mod epsilons;
mod findings;
mod kernels;
mod page;
mod program;

use hairline_league::edition;
use page::Pages;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        [folder] => site(folder, None, None),
        [folder, edition] => site(folder, Some(edition), None),
        [folder, edition, url] => site(folder, Some(edition), Some(url)),
        _ => Err("usage: league-site FOLDER [EDITION] [URL]".to_owned()),
    };
    match done {
        Ok(said) => {
            println!("{said}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("league-site: {message}");
            ExitCode::from(2)
        }
    }
}

/// Writes all pages; what was written, in a line.
fn site(folder: &str, edition: Option<&str>, url: Option<&str>) -> Result<String, String> {
    let editions = Path::new("league/editions");
    let edition = match edition {
        Some(name) => name.to_owned(),
        None => edition::names(editions)?.pop().ok_or("no edition")?,
    };
    let results = edition::results(&editions.join(&edition))?;
    hairline_league::register()?;
    let findings = findings::read(Path::new("league/findings"))?;
    let cases = cases::of(&results);
    let epsilons = epsilons::in_use(&results);
    let mut pages = Pages::new(folder, &edition);
    page::index(&mut pages, &results, &findings, &epsilons)?;
    kernels::write(&mut pages, &results, &findings, url)?;
    findings::write(&mut pages, &findings)?;
    cases::write(&mut pages, &cases)?;
    epsilons::write(&mut pages, &epsilons)?;
    badges::write(&mut pages, &results)?;
    Ok(pages.said())
}
