//! Nearest hits of Rust crates, for `hairline rays --answers`:
//!
//! ```text
//! hairline-league-scenes list                              the libraries: name, version, scalar
//! hairline-league-scenes answers NAME MESH.obj RAYS.csv    a line a ray: face,t or -1
//! hairline-league-scenes time MESH.obj RAYS.csv            microseconds a ray of hairline-scene's exact answer
//! ```

mod bvh;
mod library;
mod obvhs;
mod parry3d;
mod read;
mod time;

use library::{LIBRARIES, Library};
use std::process::ExitCode;

const USAGE: &str =
    "hairline-league-scenes list | answers NAME MESH.obj RAYS.csv | time MESH.obj RAYS.csv";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

fn run(words: &[&str]) -> Result<String, String> {
    match words {
        ["list"] => Ok(LIBRARIES.iter().map(listed).collect()),
        ["answers", name, mesh, rays] => {
            let library = LIBRARIES.iter().find(|library| library.name == *name);
            let library = library.ok_or_else(|| format!("there is no library {name}"))?;
            let answers = (library.answers)(&read::mesh(mesh)?, &read::rays(rays)?);
            Ok(answers.iter().map(line).collect())
        }
        ["time", mesh, rays] => {
            let time = time::microseconds(&read::mesh(mesh)?, &read::rays(rays)?)?;
            Ok(format!("{time:.3}\n"))
        }
        _ => Err(USAGE.to_owned()),
    }
}

fn listed(library: &Library) -> String {
    let Library {
        name,
        version,
        scalar,
        ..
    } = library;
    format!("{name}\t{version}\t{scalar}\n")
}

fn line(answer: &library::Answer) -> String {
    match answer {
        Some((face, t)) => format!("{face},{t:?}\n"),
        None => "-1\n".to_owned(),
    }
}
