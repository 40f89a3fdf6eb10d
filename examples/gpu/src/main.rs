//! A ray–triangle test in WGSL that answers hairline over its pipe, in the binary encoding of
//! docs/protocol.md: `hairline audit --kernel-cmd examples/gpu/target/release/hairline-gpu-example`; or a guarded one in WGSL
//! or GLSL: `… hairline-gpu-example guarded.glsl miss`.

mod gpu;
mod guarded;
mod protocol;

use gpu::Gpu;
use guarded::Shader;
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
    let words: Vec<String> = std::env::args().skip(1).collect();
    let shader = match &words[..] {
        [] => Ok(Shader::published()),
        [file, ask] => Shader::read(file, ask),
        _ => Err(
            "expected nothing, or FILE.wgsl|FILE.glsl and what an ask counts as: hit or miss"
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
    let on = format!("; on {}; {ROUNDING}", gpu.device());
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
        let verdicts = gpu.run(&batch).map_err(io::Error::other)?;
        protocol::write_answer(&mut output, batch.count, &verdicts)?;
    }
    Ok(())
}
