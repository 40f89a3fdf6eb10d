//! A kernel's answer, and the reasons why there may be none.

use super::Hit;
use crate::arith::Float;
use crate::truth::Facing;
use std::fmt;

/// A kernel's answer. Values that the kernel does not give are NaN ([`KernelInfo::gives`](super::KernelInfo::gives)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict<F> {
    /// Hit or miss.
    pub hit: bool,
    /// The gate that refused.
    pub refused_by: Option<u8>,
    /// The side hit.
    pub facing: Option<Facing>,
    /// The ray's parameter.
    pub t: F,
    /// The weight of b.
    pub u: F,
    /// The weight of c.
    pub v: F,
    /// Why there is no verdict; the rest is then that of a miss.
    pub failure: Option<Failure>,
}

/// Why a kernel gave no verdict on a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Failure {
    /// It panicked.
    Panic,
    /// Its process was killed by a signal.
    Signal(i32),
    /// Its process ended by itself, with this exit code.
    Exit(i32),
    /// It wrote to its input, or touched what lies beside its buffers.
    Overrun,
    /// It threw a C++ exception that nothing caught.
    Exception,
    /// It gave no answer in time.
    Timeout,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Panic => f.write_str("panicked"),
            Failure::Signal(number) => match signal_name(*number) {
                Some(name) => write!(f, "died of signal {number} ({name})"),
                None => write!(f, "died of signal {number}"),
            },
            Failure::Exit(code) => write!(f, "ended its process with exit code {code}"),
            Failure::Overrun => f.write_str("touched memory outside its buffers"),
            Failure::Exception => f.write_str("threw a C++ exception"),
            Failure::Timeout => f.write_str("gave no answer in time"),
        }
    }
}

/// The signals that a kernel's faults raise; the numbers are those of Linux, macOS and the BSDs alike.
fn signal_name(number: i32) -> Option<&'static str> {
    match number {
        4 => Some("SIGILL"),
        5 => Some("SIGTRAP"),
        6 => Some("SIGABRT"),
        8 => Some("SIGFPE"),
        9 => Some("SIGKILL"),
        11 => Some("SIGSEGV"),
        13 => Some("SIGPIPE"),
        15 => Some("SIGTERM"),
        _ => None,
    }
}

impl<F: Float> Verdict<F> {
    /// A miss at a gate.
    pub fn miss(refused_by: Option<u8>) -> Self {
        let nan = F::from_f64(f64::NAN);
        Verdict {
            hit: false,
            refused_by,
            facing: None,
            t: nan,
            u: nan,
            v: nan,
            failure: None,
        }
    }

    /// No verdict: the kernel failed.
    pub fn failed(failure: Failure) -> Self {
        Verdict {
            failure: Some(failure),
            ..Verdict::miss(None)
        }
    }

    /// The verdict that follows from a kernel's result and the gate at which it stopped.
    #[inline(always)]
    pub fn of(hit: Option<Hit<F>>, refused_by: Option<usize>) -> Self {
        match hit {
            None => Verdict::miss(refused_by.map(|gate| gate as u8)),
            Some(Hit { t, uv, facing }) => {
                let nan = F::from_f64(f64::NAN);
                let (u, v) = uv.unwrap_or((nan, nan));
                let t = t.unwrap_or(nan);
                Verdict {
                    hit: true,
                    refused_by: None,
                    facing,
                    t,
                    u,
                    v,
                    failure: None,
                }
            }
        }
    }
}
