//! Kernels in processes of their own, of triangles and of boxes. A command that speaks the protocol of docs/protocol.md over its pipes, or a
//! shared library with the functions of include/hairline.h, which a child of this program loads.
//!
//! A process may crash, hang, exit or write outside its buffers: that is a finding about the case, and
//! the run goes on with a new process. An invalid answer ends the run.

#![deny(unsafe_code)]

use hairline_cases::corpus;
use hairline_core::{arith, case, contract, kernel, truth};
use hairline_files as files;
use hairline_study::plot;

mod asked;
mod binary;
mod exchange;
mod hello;
#[cfg(unix)]
mod host;
mod margins;
mod offset;
mod process;
mod running;
mod stderr;
pub mod text;
mod turns;

pub use asked::{Asked, Form};
pub use hello::Hello;
pub use offset::OffsetCommand;
pub use process::{LoadError, ProcessLimits, load};
pub use running::KernelProgram;

#[cfg(unix)]
pub use host::serve;

/// The protocol's version, in the first line of a hello.
pub const PROTOCOL: u32 = 1;

/// The hidden command by which this program loads a library: `hairline kernel-host TARGET FILE`.
pub const HOST_COMMAND: &str = "kernel-host";

/// On other systems a library has no host.
#[cfg(not(unix))]
pub fn serve(_: &Form, _: &std::path::Path, _: std::time::Duration) -> u8 {
    eprintln!("hairline: --kernel-lib needs a Unix system: its library runs behind guard pages");
    1
}
