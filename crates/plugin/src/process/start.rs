//! The start of a kernel's process, until its hello is over.

#![forbid(unsafe_code)]

use super::{Process, ProcessLimits, ProcessState};
use crate::asked::Asked;
use crate::binary::{self, Before};
use crate::hello::{Hello, HelloLines};
use crate::kernel::{Entry, Failure};
use crate::running::{KernelProgram, Lost, Running};
use crate::turns::Turns;
use std::io;
use std::marker::PhantomData;
use std::sync::Mutex;
use std::time::Instant;

/// Why a kernel's process cannot be used.
#[derive(Debug)]
pub enum LoadError {
    /// It cannot be started.
    Start(io::Error),
    /// Its hello is invalid; one line.
    Hello(String),
}

/// Starts a kernel's process and reads its hello. The entry lives as long as this process; `flag`
/// chooses it on a command line.
pub fn load<T: Asked>(
    program: KernelProgram,
    limits: ProcessLimits,
    flag: String,
) -> Result<Entry<T>, LoadError> {
    let since = Instant::now();
    let running = program.start(limits.start).map_err(LoadError::Start)?;
    let (hello, running) = greet(running, &program, &limits).map_err(LoadError::Hello)?;
    hello.is_of(&T::FORM).map_err(LoadError::Hello)?;
    let turns = Turns::new(hello.processes, since.elapsed());
    let mut notes = hello.notes();
    if !hello.floats.is_default() {
        let note = format!(
            "its process computes with {} from the start (a library built with -ffast-math does that when it is \
             loaded)",
            hello.floats
        );
        if limits.require_ieee {
            return Err(LoadError::Hello(format!(
                "{note}, which --require-ieee refuses"
            )));
        }
        notes.push(note);
    }
    let info = hello.info();
    let scalars = hello.scalars;
    let state = Mutex::new(ProcessState {
        idle: vec![running],
        notes,
        ..ProcessState::default()
    });
    let kernel = Process {
        target: PhantomData,
        program,
        limits,
        hello,
        turns,
        state,
    };
    let kernel: &'static Process<T> = Box::leak(Box::new(kernel));
    let mut entry = Entry::described(info).chosen_by(flag.leak());
    if scalars[0] {
        entry = entry.with_f32(kernel);
    }
    if scalars[1] {
        entry = entry.with_f64(kernel);
    }
    Ok(entry)
}

/// Reads a process's hello. An error says in one line why it cannot be used.
pub(super) fn greet(
    mut running: Running,
    program: &KernelProgram,
    limits: &ProcessLimits,
) -> Result<(Hello, Running), String> {
    let mut lines = HelloLines::default();
    loop {
        let failure = match running.line() {
            Ok(line) => match lines.take(&line)? {
                None => continue,
                Some(hello) => {
                    running.wait_at_most(limits.silence);
                    return Ok((hello, running));
                }
            },
            Err(Lost::Garbled(message)) => return Err(message),
            Err(Lost::Failed(failure)) => failure,
        };
        let failure = match binary::before_answer(running.unread()) {
            Some(Before::Failure(said)) => said,
            _ => failure,
        };
        let limit = limits.start.as_secs_f64();
        // The host of a library announces it, then calls it.
        let when = match program.is_host && lines.have_begun() {
            true => "in its first call, on a plain case,",
            false => "before its hello was over",
        };
        return Err(match failure {
            Failure::Timeout => format!(
                "{when} it was silent for {limit} s after its start (--kernel-start SECONDS waits longer)"
            ),
            Failure::Overrun => {
                format!("{when} it {failure}: are its structs those of include/hairline.h?")
            }
            failure => format!("{when} it {failure}"),
        });
    }
}
