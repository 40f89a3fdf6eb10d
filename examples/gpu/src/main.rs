//! A ray–triangle test in WGSL that answers hairline over its pipe, in the binary encoding of
//! docs/protocol.md: `hairline audit --kernel-cmd examples/gpu/target/release/hairline-gpu-example`.

mod gpu;
mod protocol;

use gpu::Gpu;
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
    let mut gpu = match Gpu::new() {
        Ok(gpu) => gpu,
        Err(message) => {
            // hairline shows the line; whoever starts this program by hand reads it too.
            writeln!(output, "error {message}")?;
            return output.flush();
        }
    };
    writeln!(
        output,
        "name wgsl-moller-trumbore\n\
         source Möller and Trumbore (1997) in WGSL on {}; {ROUNDING}\n\
         scalars f32\n\
         contract extent=line,sides=both,boundary=closed\n\
         gives t uv facing\n\
         epsilon parallel 1e-6 2 1 non-negative abs(det) < e\n\
         encoding binary\n\
         ready",
        gpu.device()
    )?;
    output.flush()?;
    while let Some(batch) = Batch::read(&mut input)? {
        let verdicts = gpu.run(&batch).map_err(io::Error::other)?;
        protocol::write_answer(&mut output, batch.count, &verdicts)?;
    }
    Ok(())
}
