//! A ray–triangle test in WGSL that answers hairline over its pipe, in the binary encoding of
//! docs/protocol.md: `hairline audit --kernel-cmd examples/gpu/target/debug/hairline-gpu-example`; or a guarded one in WGSL,
//! GLSL or HLSL: `… hairline-gpu-example guarded.glsl miss`. `… products` or
//! `… sums` at the end has the coordinates made in the shader.

mod gpu;
mod guarded;
mod inputs;
mod protocol;

use gpu::Gpu;
use guarded::Shader;
use inputs::Inputs;
use protocol::Batch;
use std::io::{self, Write};
use std::process::ExitCode;

/// What WGSL's own section on floating-point evaluation promises, and so what a kernel in it can.
const ROUNDING: &str =
    "WGSL: x/y within 2.5 ulps, products may be fused into sums, subnormal numbers may be flushed";

fn main() -> ExitCode {
    match answer() {
        // hairline has gone: nobody is left to answer.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("hairline-gpu-example: {error}");
            ExitCode::FAILURE
        }
        Ok(()) => ExitCode::SUCCESS,
    }
}

/// Says hello, then answers batches until there are no more.
fn answer() -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::stdout().lock());
    writeln!(output, "hairline-kernel 1")?;
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let inputs = match words.last().map(String::as_str) {
        Some("products") => Inputs::Products,
        Some("sums") => Inputs::Sums,
        _ => Inputs::Stored,
    };
    words.pop_if(|word| ["products", "sums"].contains(&word.as_str()));
    let shader = match &words[..] {
        [] => Ok(Shader::published()),
        [file, ask] => Shader::read(file, ask),
        _ => Err(
            "expected nothing, or FILE.wgsl|FILE.glsl|FILE.hlsl and what an ask counts as, hit or miss; then, if wanted, products or sums"
                .to_owned(),
        ),
    };
    let (mut gpu, hello) = match shader.and_then(|shader| Ok((Gpu::new(&shader)?, shader.hello))) {
        Ok(gpu) => gpu,
        Err(message) => {
            // hairline shows the line; whoever starts this program by hand reads it too.
            writeln!(output, "error {message}")?;
            return output.flush();
        }
    };
    let on = format!("{}; on {}; {ROUNDING}", inputs.told(), gpu.device());
    for line in hello.lines() {
        writeln!(
            output,
            "{line}{}",
            if line.starts_with("source ") { &on } else { "" }
        )?;
    }
    writeln!(output, "processes 1\nencoding binary\nready")?;
    output.flush()?;
    while let Some(batch) = Batch::read(&mut input)? {
        let count = batch.count;
        let verdicts = gpu
            .run(&batch.made_in_the_shader(inputs))
            .map_err(io::Error::other)?;
        protocol::write_answer(&mut output, count, &verdicts)?;
    }
    Ok(())
}
