//! Expressions in GLSL whose result is `precise`, as SPIR-V that the driver gets as it is.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::{self, Command, Stdio};

/// A shader with an expression that is written in WGSL; an error in one line.
pub fn shader(wgsl: &str) -> Result<Vec<u32>, String> {
    let expression = wgsl.replace("inverseSqrt", "inversesqrt");
    let text = include_str!("one.glsl").replace("EXPRESSION", &expression);
    // A folder that nobody else has made.
    let folder = env::temp_dir().join(format!("hairline-rt-{}", process::id()));
    let failed = |error: io::Error| format!("{}: {error}", folder.display());
    fs::create_dir(&folder).map_err(failed)?;
    let compiled = compiled(&text, &folder.join("shader.spv"));
    fs::remove_dir_all(&folder).map_err(failed)?;
    let bytes = compiled?;
    let (words, _) = bytes.as_chunks();
    Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

/// GLSL as SPIR-V, through a file. wgpu's own reader forgets `precise`.
fn compiled(text: &str, file: &Path) -> Result<Vec<u8>, String> {
    let failed = |error: io::Error| format!("glslangValidator: {error} (Debian: glslang-tools)");
    let mut child = Command::new("glslangValidator")
        .args(["-V", "--stdin", "-S", "comp", "-o"])
        .arg(file)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    let mut input = child.stdin.take().expect("a pipe");
    input.write_all(text.as_bytes()).map_err(failed)?;
    drop(input);
    let output = child.wait_with_output().map_err(failed)?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stdout);
        return Err(format!(
            "glslangValidator: {}",
            words.trim().replace('\n', "; ")
        ));
    }
    fs::read(file).map_err(failed)
}
