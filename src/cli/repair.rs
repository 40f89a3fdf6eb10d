//! `hairline repair`: small changes to a kernel and what they mend; and a kernel that says hit, miss or ask, as source code
//! with a proof.

use super::before::{count_indices, scalars_in_use, total_indices};
use super::exit::{Failure, Status};
use super::flags::{case_count, chosen_scalars, find_kernel};
use super::output::{write_page, write_result};
use super::progress::Progress;
use super::sources::{about_scene, mesh_scene};
use crate::arith::ScalarName;
use crate::audit::{EpsilonChoice, Source, shell_word};
use crate::case::{Parameters, Scene};
use crate::family::{FAMILIES, Family, Stratum};
use crate::kernel::{self, Entry, Scalar};
use crate::prove::repair::Guarded;
use crate::report::page::{Block, Page};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use hairline_core::Error;
use hairline_repair::smaller::{self, Guard, RepairRays};
use hairline_repair::{Asks, Language, function_name, source_code};

fn languages() -> impl TypedValueParser<Value = Language> {
    let value = |language: Language| PossibleValue::new(language.name()).help(language.about());
    let names = PossibleValuesParser::new(Language::ALL.map(value));
    names.map(|name| Language::named(&name).expect("one of the names"))
}

/// The kernel, and what to write.
#[derive(Args)]
pub struct RepairArguments {
    /// A kernel [default: with --emit and a folder, all]
    #[arg(long, short, value_name = "NAME")]
    kernel: Option<String>,

    /// f32, f64, or both separated by a comma
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "f32",
        value_name = "SCALAR"
    )]
    scalar: Vec<String>,

    /// Write the kernel that says hit, miss or ask in this language, instead of small changes
    #[arg(long, value_name = "LANGUAGE", value_parser = languages())]
    emit: Option<Language>,

    /// Epsilons of your own copy of the kernel, as parallel=1e-7; what --emit writes has none
    #[arg(long, value_name = "GATE=VALUE,...", allow_hyphen_values = true)]
    epsilon: Option<String>,

    /// Count in a scene as `epsilon` takes it: room, or a few numbers [default: the families of `audit`]
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,

    /// The same in the scene that a mesh is
    #[arg(long, value_name = "FILE")]
    mesh: Option<String>,

    /// How many rays of each kind
    #[arg(long, short = 'n', default_value_t = 20_000, value_name = "N", value_parser = case_count)]
    count: u64,

    /// Seed of the rays
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Write the proof to this file, for `hairline prove --check`
    #[arg(long, value_name = "FILE")]
    certificate: Option<String>,

    /// Where to write; - is standard output, and a folder takes a file for each kernel and scalar
    #[arg(short, long, default_value = "-", value_name = "FILE|FOLDER/")]
    output: String,

    /// Say nothing but what was asked for
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &RepairArguments) -> Result<Status, Failure> {
    let scalars = chosen_scalars(&arguments.scalar)?;
    let sources = arguments.sources(scalars)?;
    let is_folder = arguments.output.ends_with('/');
    let entries: Vec<&Entry> = match &arguments.kernel {
        Some(name) => vec![find_kernel(name)?],
        None if is_folder => kernel::all(),
        None => {
            return Err(Failure::usage(
                "repair is of one --kernel, or of all with -o FOLDER/",
            ));
        }
    };
    let is_single = entries.len() == 1 && scalars[0] != scalars[1];
    let is_written = arguments.emit.is_some() || arguments.certificate.is_some();
    if is_written && arguments.epsilon.is_some() {
        let message =
            "--epsilon is of the kernel as it is: what --emit and --certificate write has none";
        return Err(Failure::usage(message));
    }
    let is_stdout = arguments.output == "-" && arguments.emit.is_some();
    if is_stdout && arguments.certificate.as_deref() == Some("-") {
        let message = "the kernel and its proof cannot both go to standard output: -o FILE";
        return Err(Failure::usage(message));
    }
    if !is_written {
        if arguments.output != "-" {
            return Err(Failure::usage(
                "-o takes what --emit writes: name a language, as --emit c",
            ));
        }
        return arguments.smaller(entries[0], scalars, sources);
    }
    if !is_folder && !is_single {
        return Err(Failure::usage(
            "two scalars are two files: name one, or -o FOLDER/",
        ));
    }
    if is_folder {
        std::fs::create_dir_all(&arguments.output)
            .map_err(|error| Failure::of_file(&arguments.output, &error))?;
    }
    let mut written = 0;
    for entry in entries {
        for name in ScalarName::among(scalars) {
            match in_named_scalar!(name, F => Guarded::new::<F>(entry)) {
                Ok(guarded) => {
                    arguments.write(&guarded, &sources)?;
                    written += 1;
                }
                Err(why) => {
                    let message = format!("{} is not repaired: {why}", entry.info.name);
                    if arguments.kernel.is_some() {
                        return Err(Failure::nothing(message));
                    }
                    if !arguments.quiet {
                        eprintln!("{message}");
                    }
                }
            }
        }
    }
    if written == 0 {
        return Err(Failure::nothing("no kernel here can be repaired"));
    }
    Ok(Status::Success)
}

impl RepairArguments {
    /// The rays on which asks are counted.
    fn sources(&self, scalars: [bool; 2]) -> Result<Vec<(&'static Family, Source)>, Failure> {
        let (scene, mesh) = match (&self.scene, &self.mesh) {
            (None, None) => return Ok(Vec::new()),
            (words, Some(path)) => {
                let (scene, mesh) = mesh_scene(path, words.as_deref(), scalars, self.quiet)?;
                (scene, Some(mesh))
            }
            (Some(words), None) => {
                let (scene, _) = Scene::parse(words).map_err(about_scene)?;
                scene.held_in(scalars).map_err(about_scene)?;
                (scene, None)
            }
        };
        let parameters = Parameters {
            scene: Some(scene),
            ..Parameters::default()
        };
        let of = |stratum| {
            let parameters = parameters.clone();
            let source =
                Source::of_stratum(stratum, mesh.as_ref(), parameters, self.seed, self.count);
            (stratum.family(), source)
        };
        Ok(Stratum::ALL.into_iter().map(of).collect())
    }

    /// The flags of `audit` for the same rays.
    fn flags_of_rays(&self) -> String {
        let given = [
            self.mesh
                .as_ref()
                .map(|mesh| format!(" --mesh {}", shell_word(mesh))),
            self.scene
                .as_ref()
                .map(|scene| format!(" --scene {}", shell_word(scene))),
            (self.seed != 1).then(|| format!(" --seed {}", self.seed)),
            (self.count != 20_000).then(|| format!(" -n {}", self.count)),
        ];
        given.into_iter().flatten().collect()
    }

    /// The screen of small changes.
    fn smaller(
        &self,
        entry: &'static Entry,
        scalars: [bool; 2],
        scene: Vec<(&'static Family, Source)>,
    ) -> Result<Status, Failure> {
        let wrong = |error: Error| Failure::usage(format!("--epsilon: {error}"));
        let choice = match &self.epsilon {
            Some(text) => EpsilonChoice::parse(text).map_err(wrong)?,
            None => EpsilonChoice::Source,
        };
        let row = choice.rows(&[entry], None).map_err(wrong)?.remove(0);
        let scalars = scalars_in_use(std::slice::from_ref(&row), scalars)?;
        let of = |family| {
            (
                family,
                Source::of(family, Parameters::default(), self.seed, self.count),
            )
        };
        let sources = if scene.is_empty() {
            FAMILIES
                .iter()
                .filter(|it| it.question.is_ordinary())
                .map(of)
                .collect()
        } else {
            scene
        };
        let is_scene = self.scene.is_some() || self.mesh.is_some();
        let aimed = if is_scene {
            ""
        } else {
            ", which are aimed at hard places (--scene room: at plain ones too)"
        };
        let rays = RepairRays {
            sources: sources.iter().map(|(_, source)| source.clone()).collect(),
            is_scene,
            flags: self.flags_of_rays(),
        };
        let mut blocks = Vec::new();
        for name in ScalarName::among(scalars) {
            let guarded = in_named_scalar!(name, F => Guarded::new::<F>(entry));
            let passes = 1 + u64::from(guarded.is_ok());
            let total = passes * total_indices(&rays.sources, name.alone())?;
            let progress = Progress::new(total, "rays", self.quiet);
            let (asks, guard) = match guarded {
                Ok(guarded) => {
                    let asks = in_named_scalar!(name, F => Asks::count::<F>(&guarded, &sources, &progress));
                    let about = format!(
                        "Guarded, as --emit writes it, no answer is wrong, which is proved; it asks on {} of these rays{aimed}.",
                        asks.whole()
                    );
                    let selector = Some(entry.selector());
                    (Some(asks), Guard { about, selector })
                }
                Err(why) => {
                    let about = format!("It cannot be guarded: {why}.");
                    let selector = in_named_scalar!(name, F => guarded_without_form::<F>(entry));
                    (None, Guard { about, selector })
                }
            };
            blocks.push(Block::Heading(format!("{} in {name}", row.label())));
            blocks.extend(
                in_named_scalar!(name, F => smaller::blocks::<F>(&row, &rays, guard, &progress)),
            );
            progress.finish();
            blocks.extend(asks.filter(|_| is_scene).iter().flat_map(Asks::blocks));
        }
        let title = format!("{}: small changes, and what they mend", entry.info.name);
        write_page(Page {
            command: "repair",
            title,
            blocks,
            ..Page::default()
        })?;
        Ok(Status::Success)
    }

    fn write(
        &self,
        guarded: &Guarded,
        sources: &[(&'static Family, Source)],
    ) -> Result<(), Failure> {
        if let Some(path) = &self.certificate {
            write_result(path, |out| out.write_all(guarded.certificate().as_bytes()))?;
        }
        let all: Vec<Source> = sources.iter().map(|(_, source)| source.clone()).collect();
        let total = count_indices(&all, guarded.scalar.alone());
        let progress = Progress::new(total, "rays", self.quiet);
        let asks = (!sources.is_empty()).then(
            || in_named_scalar!(guarded.scalar, F => Asks::count::<F>(guarded, sources, &progress)),
        );
        progress.finish();
        let Some(language) = self.emit else {
            return Ok(());
        };
        if guarded.scalar == ScalarName::F64 && matches!(language, Language::Wgsl | Language::Hlsl)
        {
            return Err(Failure::usage(
                "WGSL has no f64, and HLSL no functions of it: --scalar f32",
            ));
        }
        let where_ = self.mesh.as_ref().or(self.scene.as_ref());
        let shares = asks
            .zip(where_)
            .map(|(asks, place)| format!("{place}: {}", asks.line()));
        let text = source_code(guarded, language, shares.as_deref());
        let path = match self.output.strip_suffix('/') {
            Some(folder) => format!(
                "{folder}/{}.{}",
                function_name(guarded),
                language.extension()
            ),
            None => self.output.clone(),
        };
        write_result(&path, |out| out.write_all(text.as_bytes()))
    }
}

/// The words that choose a kernel in its plain form, where it has another one and can be guarded as it is.
fn guarded_without_form<F: Scalar>(entry: &Entry) -> Option<String> {
    let (plain, _form) = entry.info.name.split_once('+')?;
    let plain = kernel::find(plain)?;
    Guarded::new::<F>(plain).ok()?;
    Some(plain.selector())
}
