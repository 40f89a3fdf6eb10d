//! `hairline verify`: what a product answered to the test vectors, judged.

use super::exit::{Failure, Status};
use super::flags::unknown;
use super::input::read_text;
use super::output::OutputArguments;
use super::vectors::core_set;
use crate::command::named_file::SizeLimit;
use crate::files::InputError;
use crate::record::{Context, Record, provenance_of};
use crate::report::Format;
use crate::vectors::{Profile, VerifyResult, digest, json::topic_file, verify};
use clap::Args;

/// One row per format.
const FORMATS: &[Format<Record<VerifyResult>>] = &[
    Format::TEXT,
    Format::JSON,
    Format {
        name: "junit",
        write: |record, _, out| record.result.write_junit(out),
    },
    Format::MARKDOWN,
    Format::HTML,
];

/// The specifications of which there is a profile, by name.
const PROFILES: [(&str, &str); 4] = [
    ("dxr", include_str!("../../vectors/profiles/dxr.json")),
    ("parity", include_str!("../../vectors/profiles/parity.json")),
    (
        "picking",
        include_str!("../../vectors/profiles/picking.json"),
    ),
    ("vulkan", include_str!("../../vectors/profiles/vulkan.json")),
];

/// Which results, and by what they are judged.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help(
        "text; json: every wrong answer and every missing id, which `hairline diff` compares; or junit, markdown or html; or \
         several separated by commas",
    )
}))]
pub struct VerifyArguments {
    /// The results file: {"vectors": SHA-256, "product": TEXT, "results": {ID: "hit", "miss" or, of a
    /// group, the number of hits}}; a hit may be {"hit": true, "t": 1.5, "u": 0.25, "v": 0.5}, whose values are
    /// compared with the exact ones; - is standard input
    #[arg(value_name = "RESULTS")]
    file: String,

    /// Demand what a specification demands where the vectors leave it free: dxr, parity, picking or
    /// vulkan
    #[arg(long, value_name = "NAME")]
    profile: Option<String>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &VerifyArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(FORMATS)?;
    let profile = arguments
        .profile
        .as_deref()
        .map(profile_named)
        .transpose()?;
    let text = read_text(&arguments.file, SizeLimit::RECORD)?;
    let core = core_set();
    let files: Vec<_> = core
        .iter()
        .map(|(topic, tests)| topic_file(topic, tests))
        .collect();
    let result =
        verify(&text, &core, &digest(&files), profile.as_ref()).map_err(|bad| InputError {
            line: bad.line,
            ..InputError::of(&arguments.file, bad.message)
        })?;
    if result.total.answered() == 0 {
        let message = "it answers no test: all results are missing or \"not asked\"";
        return Err(Failure::nothing(format!("{}: {message}", arguments.file)));
    }
    let status = match result.total.wrong {
        0 => Status::Success,
        _ => Status::Disagreements,
    };
    let provenance = provenance_of(&Context {
        seconds: 0.0,
        threads: 1,
    });
    arguments
        .output
        .write(outputs, &Record::new(result, provenance))?;
    Ok(status)
}

fn profile_named(name: &str) -> Result<Profile, Failure> {
    let names = PROFILES.iter().map(|(known, _)| *known);
    let (_, text) = PROFILES
        .iter()
        .find(|(known, _)| *known == name)
        .ok_or_else(|| unknown("profile", name, names, "hairline verify --help"))?;
    Ok(Profile::parse(text).expect("tests read the profiles"))
}
