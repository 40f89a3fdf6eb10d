//! An offset scheme as a command: it reads hit points as lines and answers where new rays start.

#![forbid(unsafe_code)]

use super::running::{KernelProgram, Lost, Running};
use super::text::{end_line, number, shown};
use crate::arith::Float;
use crate::kernel::Failure;
use hairline_advice::offset::{HitPoint, Offset, Start};
use std::fmt::Write;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long the command may be silent when an answer is due.
const SILENCE: Duration = Duration::from_secs(10);

/// An offset scheme in processes of its own, one a thread. The first thing that goes wrong ends the run: see
/// [`OffsetCommand::fault`].
#[derive(Clone)]
pub struct OffsetCommand {
    program: KernelProgram,
    state: Arc<Mutex<OffsetState>>,
}

#[derive(Default)]
struct OffsetState {
    /// Processes that are idle at the moment.
    idle: Vec<Running>,
    fault: Option<String>,
}

impl OffsetCommand {
    /// The command of a program, which is not started yet.
    pub fn new(program: KernelProgram) -> OffsetCommand {
        OffsetCommand {
            program,
            state: Arc::default(),
        }
    }

    /// Starts one process, so that what cannot be started shows before the run.
    pub fn start(&self) -> io::Result<()> {
        let running = self.running()?;
        self.state().idle.push(running);
        Ok(())
    }

    /// Why its answers are worth nothing; one line.
    pub fn fault(&self) -> Option<String> {
        self.state().fault.clone()
    }

    fn state(&self) -> MutexGuard<'_, OffsetState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An idle process, or a new one.
    fn running(&self) -> io::Result<Running> {
        let idle = self.state().idle.pop();
        idle.map_or_else(|| self.program.start(SILENCE), Ok)
    }

    fn ask<F: Float>(&self, hits: &[HitPoint<F>]) -> Result<Vec<Start<F>>, String> {
        let mut running = self
            .running()
            .map_err(|e| format!("it cannot be started: {e}"))?;
        let mut lines: String = hits.iter().map(hit_line).collect();
        lines += &end_line(hits.len() as u64);
        running.send(lines.into_bytes());
        let mut starts = Vec::with_capacity(hits.len());
        for _ in hits {
            starts.push(start_of(&line(&mut running)?)?);
        }
        let (last, expected) = (line(&mut running)?, end_line(hits.len() as u64));
        if last.trim_end() != expected.trim_end() {
            return Err(format!(
                "expected '{}', found '{}'",
                expected.trim_end(),
                shown(&last)
            ));
        }
        self.state().idle.push(running);
        Ok(starts)
    }
}

fn line(running: &mut Running) -> Result<String, String> {
    running.line().map_err(|lost| match lost {
        Lost::Garbled(message) => message,
        Lost::Failed(Failure::Timeout) => {
            format!("it was silent for {} s", SILENCE.as_secs())
        }
        Lost::Failed(failure) => format!("it {failure}"),
    })
}

/// `hit SCALAR`, then the point, the normal, a, b, c, u, v, t and the direction; `nan` for what is unknown.
fn hit_line<F: Float>(hit: &HitPoint<F>) -> String {
    let [a, b, c] = hit.vertices;
    let nan = F::from_f64(f64::NAN);
    let [_, u, v] = hit.weights.unwrap_or([nan; 3]);
    let mut line = format!("hit {}", F::NAME);
    let vectors = [hit.point, hit.normal, a, b, c];
    for value in vectors
        .as_flattened()
        .iter()
        .chain(&[u, v, hit.t])
        .chain(&hit.direction)
    {
        let _ = write!(line, " {}", number(*value));
    }
    line.push('\n');
    line
}

/// `X Y Z`, perhaps with a least t.
fn start_of<F: Float>(line: &str) -> Result<Start<F>, String> {
    let number = |word| F::parse(word).filter(|x| x.to_f64().is_finite());
    let numbers: Option<Vec<F>> = line.split_ascii_whitespace().map(number).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(Start::at([x, y, z])),
        Some(&[x, y, z, t_min]) => Ok(Start {
            origin: [x, y, z],
            t_min,
        }),
        _ => Err(format!(
            "expected finite numbers 'X Y Z' or 'X Y Z T_MIN' for each hit, found '{}'",
            shown(line)
        )),
    }
}

impl<F: Float> Offset<F> for OffsetCommand {
    fn start(&self, hit: &HitPoint<F>) -> Start<F> {
        self.starts(std::slice::from_ref(hit))[0]
    }

    fn starts(&self, hits: &[HitPoint<F>]) -> Vec<Start<F>> {
        let has_failed = self.state().fault.is_some();
        let nowhere = || vec![Start::at([F::from_f64(f64::NAN); 3]); hits.len()];
        if has_failed || hits.is_empty() {
            return nowhere();
        }
        self.ask(hits).unwrap_or_else(|message| {
            self.state().fault.get_or_insert(message);
            nowhere()
        })
    }
}
