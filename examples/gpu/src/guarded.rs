//! A guarded kernel as `hairline repair --emit wgsl` or `glsl` writes it, on the device.

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

/// GLSL for Vulkan, compiled by glslangValidator: wgpu's own reader knows no `precise`.
fn compiled(text: &str) -> Result<Vec<u32>, String> {
    let file = std::env::temp_dir().join(format!("hairline-gpu-{}.spv", std::process::id()));
    let failed =
        |error: std::io::Error| format!("glslangValidator: {error} (Debian: glslang-tools)");
    let mut child = Command::new("glslangValidator")
        .args(["-V", "--stdin", "-S", "comp", "-o"])
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

const WGSL: &str = "
struct Batch { count: u32, parallel: f32, zero: u32 }
@group(0) @binding(0) var<storage, read> batch: Batch;
@group(0) @binding(1) var<storage, read> cases: array<f32>;
@group(0) @binding(2) var<storage, read_write> verdicts: array<u32>;
fn vector(at: u32) -> vec3f { return vec3f(cases[at], cases[at + 1u], cases[at + 2u]); }
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= batch.count) { return; }
    let at = 17u * id.x;
    var values: vec3f;
    let answer = KERNEL(vector(at), vector(at + 3u), vector(at + 6u), vector(at + 9u), vector(at + 12u)ENDS, batch.zero, &values);
    for (var i = 0u; i < 5u; i++) { verdicts[5u * id.x + i] = 0u; }
    if (answer == HAIRLINE_HIT || answer == COUNTED) { verdicts[5u * id.x] = 1u; }
}
";

const GLSL: &str = "
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Batch { uint count; float parallel; };
layout(std430, set = 0, binding = 1) readonly buffer Cases { float cases[]; };
layout(std430, set = 0, binding = 2) buffer Verdicts { uint verdicts[]; };
vec3 vector(uint at) { return vec3(cases[at], cases[at + 1u], cases[at + 2u]); }
void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= count) { return; }
    uint at = 17u * id;
    vec3 values;
    int answer = KERNEL(vector(at), vector(at + 3u), vector(at + 6u), vector(at + 9u), vector(at + 12u)ENDS, values);
    for (uint i = 0u; i < 5u; i++) { verdicts[5u * id + i] = 0u; }
    if (answer == HAIRLINE_HIT || answer == COUNTED) { verdicts[5u * id] = 1u; }
}
";

impl Shader {
    /// From a file; `ask` says what an answer `ask` counts as, hit or miss. An error in one line.
    pub fn read(file: &str, ask: &str) -> Result<Shader, String> {
        let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
        let is_glsl = Path::new(file)
            .extension()
            .is_some_and(|extension| extension == "glsl");
        let counted = match ask {
            "hit" => "HAIRLINE_ASK",
            "miss" => "HAIRLINE_HIT",
            _ => return Err(format!("'{ask}': an ask counts as a hit or a miss")),
        };
        let promise = text.lines().find_map(|line| line.split_once("promise: "));
        let words = promise.and_then(|(_, words)| words.split_once(", "));
        let (extent, sides) = words.ok_or(format!("{file}: no line with its promise"))?;
        let start = if is_glsl { "int " } else { "fn " };
        let mut head = text
            .lines()
            .filter_map(|line| line.strip_prefix(start)?.split_once('('));
        // The last function is the kernel.
        let (name, inputs) = head.next_back().ok_or(format!("{file}: no function"))?;
        let ends = if inputs.contains("t_min") {
            ", cases[at + 15u], cases[at + 16u]"
        } else {
            ""
        };
        let wrapped = if is_glsl { GLSL } else { WGSL };
        let wrapped = wrapped
            .replace("KERNEL", name)
            .replace("ENDS", ends)
            .replace("COUNTED", counted);
        let code = match is_glsl {
            true => Code::SpirV(compiled(&format!("#version 450\n{text}{wrapped}"))?),
            false => Code::Wgsl(format!("{text}{wrapped}")),
        };
        let sides = if sides == "front" { "front" } else { "both" };
        let language = if is_glsl { "GLSL" } else { "WGSL" };
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
