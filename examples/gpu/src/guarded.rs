//! A guarded kernel as `hairline repair --emit wgsl`, `glsl` or `hlsl` writes it, on the device.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// A shader, and the lines of the hello that are about its kernel.
pub struct Shader {
    pub code: Code,
    pub hello: String,
}

/// What the device takes.
pub enum Code {
    Wgsl(String),
    SpirV(Vec<u32>),
}

/// A language that a kernel is emitted in.
#[derive(Clone, Copy, PartialEq)]
enum Language {
    Wgsl,
    Glsl,
    Hlsl,
}

impl Language {
    /// By a file's name.
    fn of(file: &Path) -> Result<Language, String> {
        match file.extension().and_then(|extension| extension.to_str()) {
            Some("wgsl") => Ok(Language::Wgsl),
            Some("glsl") => Ok(Language::Glsl),
            Some("hlsl") => Ok(Language::Hlsl),
            _ => Err(format!(
                "{}: expected a name that ends in .wgsl, .glsl or .hlsl",
                file.display()
            )),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Language::Wgsl => "WGSL",
            Language::Glsl => "GLSL",
            Language::Hlsl => "HLSL",
        }
    }

    /// What a line begins with that defines the kernel.
    fn start(self) -> &'static str {
        match self {
            Language::Wgsl => "fn ",
            Language::Glsl | Language::Hlsl => "int ",
        }
    }

    /// The program that calls the kernel.
    fn caller(self) -> &'static str {
        match self {
            Language::Wgsl => include_str!("wrapped/guarded.wgsl"),
            Language::Glsl => include_str!("wrapped/guarded.glsl"),
            Language::Hlsl => include_str!("wrapped/guarded.hlsl"),
        }
    }
}

/// GLSL or HLSL for Vulkan, compiled by glslangValidator: wgpu's own reader knows no `precise`.
fn compiled(text: &str, language: Language) -> Result<Vec<u32>, String> {
    let file = std::env::temp_dir().join(format!("hairline-gpu-{}.spv", std::process::id()));
    let failed =
        |error: std::io::Error| format!("glslangValidator: {error} (Debian: glslang-tools)");
    let mut command = Command::new("glslangValidator");
    command.args(["-V", "--stdin", "-S", "comp"]);
    if language == Language::Hlsl {
        command.args(["-D", "-e", "main"]);
    }
    let mut child = command
        .arg("-o")
        .arg(&file)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    child
        .stdin
        .take()
        .expect("a pipe")
        .write_all(text.as_bytes())
        .map_err(failed)?;
    let output = child.wait_with_output().map_err(failed)?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stdout)
            .trim()
            .replace('\n', "; "));
    }
    let bytes = std::fs::read(&file).map_err(failed)?;
    let _ = std::fs::remove_file(&file);
    let (words, _) = bytes.as_chunks();
    Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

impl Shader {
    /// From a file; `ask` says what an answer `ask` counts as, hit or miss. An error in one line.
    pub fn read(file: &str, ask: &str) -> Result<Shader, String> {
        let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
        let language = Language::of(Path::new(file))?;
        let counted = match ask {
            "hit" => "HAIRLINE_ASK",
            "miss" => "HAIRLINE_HIT",
            _ => return Err(format!("'{ask}': an ask counts as a hit or a miss")),
        };
        let promise = text.lines().find_map(|line| line.split_once("promise: "));
        let words = promise.and_then(|(_, words)| words.split_once(", "));
        let (extent, sides) = words.ok_or(format!("{file}: no line with its promise"))?;
        let mut head = text
            .lines()
            .filter_map(|line| line.strip_prefix(language.start())?.split_once('('));
        // The last function is the kernel.
        let (name, inputs) = head.next_back().ok_or(format!("{file}: no function"))?;
        let ends = if inputs.contains("t_min") {
            ", cases[at + 15u], cases[at + 16u]"
        } else {
            ""
        };
        let caller = language
            .caller()
            .replace("KERNEL", name)
            .replace("ENDS", ends)
            .replace("COUNTED", counted);
        let code = match language {
            Language::Wgsl => Code::Wgsl(format!("{text}{caller}")),
            Language::Glsl => Code::SpirV(compiled(
                &format!("#version 450\n{text}{caller}"),
                language,
            )?),
            Language::Hlsl => Code::SpirV(compiled(&format!("{text}{caller}"), language)?),
        };
        let sides = if sides == "front" { "front" } else { "both" };
        let language = language.name();
        let hello = format!(
            "name guarded-{}\n\
             source {file} in {language}, an ask is a {ask}\n\
             scalars f32\n\
             contract extent={extent},sides={sides},boundary=closed,invalid=free\n",
            name.replace('_', "-")
        );
        Ok(Shader { code, hello })
    }

    /// Möller and Trumbore's test as published.
    pub fn published() -> Shader {
        let hello = "name wgsl-moller-trumbore\n\
                     source Möller and Trumbore (1997) in WGSL\n\
                     scalars f32\n\
                     contract extent=line,sides=both,boundary=closed\n\
                     gives t uv facing\n\
                     epsilon parallel 1e-6 2 1 non-negative abs(det) < e\n";
        let text = include_str!("moller_trumbore.wgsl").to_owned();
        Shader {
            code: Code::Wgsl(text),
            hello: hello.to_owned(),
        }
    }
}
