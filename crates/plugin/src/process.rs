//! A kernel in processes of its own, as a [`Subject`]: one process a turn, which receives batches. If a
//! batch ends its process the cases run again one by one, to find the one that does it.

#![forbid(unsafe_code)]

mod start;

pub use start::{LoadError, load};

use super::asked::Asked;
use super::binary;
use super::exchange;
use super::hello::Hello;
use super::margins::{self, MARGINS_AT_ONCE, MarginFailures};
use super::running::{self, KernelProgram, Lost, Running};
use super::stderr::MOST_LINES;
use super::turns::Turns;
use crate::arith::{Float, FloatEnvironment};
use crate::kernel::{Failure, Hit, KernelInfo, Subject, Verdict, open_epsilons, values_of};
use crate::plot::{group_digits, number_of};
use std::marker::PhantomData;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How much this program tolerates of a process.
#[derive(Clone, Copy, Debug)]
pub struct ProcessLimits {
    /// How long it may be silent while it starts.
    pub start: Duration,
    /// How long it may be silent when an answer is due.
    pub silence: Duration,
    /// On how many cases it may crash or hang before the run ends.
    pub failures: u64,
    /// The run ends if it crashes or hangs on so many cases and answered none before.
    pub first_failures: u64,
    /// With how many silences the run ends.
    pub timeouts: u64,
    /// Is told of each silence, in one line.
    pub tell: fn(&str),
    /// True if the run ends when its arithmetic is not that which IEEE 754 starts with.
    pub require_ieee: bool,
}

/// After how many cases a process that has never answered is given up.
const NEVER_ANSWERED: u64 = 3;

/// After so many processes that ended between batches, as if all was done, the command is one that does.
const ENDED: u64 = 3;

/// How often in ten milliseconds each words of a kernel are waited for.
const LISTENED: usize = 10;

struct Process<T> {
    target: PhantomData<T>,
    program: KernelProgram,
    limits: ProcessLimits,
    hello: Hello,
    turns: Turns,
    state: Mutex<ProcessState>,
}

#[derive(Default)]
struct ProcessState {
    /// Processes that are idle at the moment.
    idle: Vec<Running>,
    /// True if any batch was answered.
    has_answered: bool,
    /// True if it was waited for words of it.
    has_listened: bool,
    /// Cases that killed a process, or on which it was silent.
    failures: u64,
    /// Those on which it was silent.
    timeouts: u64,
    /// The first of them.
    first: Option<String>,
    /// Processes that ended with 0 after they had answered.
    ended: u64,
    margins: MarginFailures,
    notes: Vec<String>,
    gave_up: Option<String>,
}

impl ProcessState {
    fn asks_no_margins(&self) -> bool {
        self.gave_up.is_some() || self.margins.gave_up.is_some()
    }
}

impl<T: Asked> Process<T> {
    fn state(&self) -> MutexGuard<'_, ProcessState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gets the verdicts on a batch from a process, which goes back to the idle ones if it answered; the
    /// margins too, if there is room for them. Returns the nanoseconds in the kernel, if the process says.
    fn ask<F: Float>(
        &self,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
        margins: &mut [F],
    ) -> Result<Option<u64>, Lost> {
        let idle = self.state().idle.pop();
        let mut running = match idle {
            Some(running) => running,
            None => self.another()?,
        };
        let since = Instant::now();
        let said = if self.hello.binary {
            exchange::in_binary::<F, T>(&mut running, cases, epsilons, verdicts, margins)
        } else {
            exchange::in_text::<F, T>(&mut running, cases, epsilons, verdicts)
        };
        self.turns.add_work(since.elapsed());
        let said = said?;
        if let Some(floats) = said.floats {
            self.has_changed_to(floats)?;
        }
        if running.has_unread() {
            return Err(Lost::Garbled("it wrote more than was asked for".to_owned()));
        }
        let mut state = self.state();
        state.idle.push(running);
        state.has_answered = true;
        Ok(said.took)
    }

    fn another(&self) -> Result<Running, Lost> {
        // What goes wrong at a start is no case's fault.
        let cannot = |error| Lost::Garbled(format!("it cannot be started again: {error}"));
        let started = self.program.start(self.limits.start).map_err(cannot)?;
        let again = |message| Lost::Garbled(format!("started again, {message}"));
        let (hello, running) = start::greet(started, &self.program, &self.limits).map_err(again)?;
        if hello != self.hello {
            let message = "started again, it announced itself differently".to_owned();
            return Err(Lost::Garbled(message));
        }
        Ok(running)
    }

    /// Notes that the arithmetic of a process changed while it answered; an error if that is not allowed.
    fn has_changed_to(&self, floats: FloatEnvironment) -> Result<(), Lost> {
        let note = format!("its process computes with {floats}, set by the kernel while it ran");
        if self.limits.require_ieee && !floats.is_default() {
            return Err(Lost::Garbled(format!(
                "{note}, which --require-ieee refuses"
            )));
        }
        self.note(note);
        Ok(())
    }

    fn note(&self, note: String) {
        let notes = &mut self.state().notes;
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// Gets the verdict on one case.
    fn ask_one<F: Float>(&self, case: &T::Case<F>, epsilons: &[F]) -> Result<Verdict<F>, String> {
        let mut verdict = [Verdict::miss(None)];
        let mut ask = || self.ask(std::slice::from_ref(case), epsilons, &mut verdict, &mut []);
        let mut said = ask();
        if let Err(Lost::Failed(Failure::Exit(0))) = said {
            // It may have ended before the case came: then a new process answers.
            self.state().idle.clear();
            said = ask();
            let mut state = self.state();
            state.ended += u64::from(said.is_ok());
            if ENDED <= state.ended {
                let message = "it answers a batch and ends with exit code 0: a kernel reads on until its input ends";
                return Err(message.to_owned());
            }
        }
        match said {
            Ok(_) => Ok(verdict[0]),
            Err(Lost::Garbled(message)) => Err(message),
            Err(Lost::Failed(failure)) => self.pinned::<F>(failure, case),
        }
    }

    /// The verdict on a case that ends a process when it runs alone; an error if there are too many.
    fn pinned<F: Float>(&self, failure: Failure, case: &T::Case<F>) -> Result<Verdict<F>, String> {
        let mut state = self.state();
        state.failures += 1;
        let (failures, most) = (state.failures, self.limits.failures);
        let (silence, patience) = (self.limits.silence.as_secs_f64(), self.limits.timeouts);
        if failure == Failure::Timeout {
            state.timeouts += 1;
            // Several threads may wait for the last of them.
            if patience < u64::MAX && state.timeouts <= patience {
                let (name, number) = (self.hello.name(), state.timeouts);
                (self.limits.tell)(&format!(
                    "kernel '{name}': no answer within {silence} s, {number} of {patience}: {}",
                    T::shown(case)
                ));
            }
        }
        if failure == Failure::Timeout && !state.has_answered && failures >= NEVER_ANSWERED {
            let cause = if self.program.is_host {
                "its function does not return; if it only starts slowly, --kernel-timeout waits longer"
            } else {
                "does it flush its output after a batch, and speak the encoding that its hello announces?"
            };
            return Err(format!(
                "it has answered none of {failures} cases, each within {silence} s: {cause}"
            ));
        }
        let first = state.first.get_or_insert_with(|| {
            format!(
                "{failure} on '{}', as `{}` takes it",
                T::shown(case),
                T::FORM.explain
            )
        });
        let first = first.clone();
        if failure == Failure::Timeout && state.timeouts >= patience {
            return Err(format!(
                "it gave no answer within {silence} s on {} (--kernel-timeout waits shorter, \
                 --kernel-failures N goes on until more than N fail); first: {first}",
                number_of(patience, "case", "cases")
            ));
        }
        if !state.has_answered && failures >= self.limits.first_failures {
            return Err(format!(
                "it failed on each of its first {failures} cases (--kernel-failures N goes on until more than N fail); \
                 first: {first}"
            ));
        }
        if failures > most {
            return Err(format!(
                "it failed on more than {most} cases, the limit of --kernel-failures; first: {first}"
            ));
        }
        drop(state);
        if failure == Failure::Overrun {
            self.note(format!(
                "it touches memory outside its buffers; if it does so on many cases, are its structs those of \
                 include/hairline.h (in f{} {} bytes a case, {} a verdict)?",
                8 * size_of::<F>(),
                T::FORM.plain.len() * size_of::<F>(),
                binary::verdict_bytes::<F>(),
            ));
        }
        Ok(Verdict::failed(failure))
    }

    /// The verdicts on a batch that killed a process, case by case.
    fn pin_all<F: Float>(
        &self,
        of_batch: Failure,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
    ) -> Result<(), String> {
        for (case, verdict) in cases.iter().zip(&mut *verdicts) {
            *verdict = self.ask_one(case, epsilons)?;
        }
        if verdicts.iter().all(|verdict| verdict.failure.is_none()) {
            self.note(format!(
                "asked many cases at once it {of_batch}; asked one by one it answered them all, and these answers count"
            ));
        }
        Ok(())
    }
}

impl<F: Float, T: Asked> Subject<F, T> for Process<T> {
    fn run(&self, cases: &[T::Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        self.run_timed(cases, epsilons, verdicts);
    }

    fn run_timed(
        &self,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
    ) -> Option<u64> {
        verdicts.fill(Verdict::miss(None));
        let _turn = self.turns.take();
        let has_given_up = self.state().gave_up.is_some();
        if has_given_up {
            return None;
        }
        self.try_run(cases, epsilons, verdicts)
            .unwrap_or_else(|message| {
                self.state().gave_up.get_or_insert(message);
                None
            })
    }

    fn tells_margins(&self) -> bool {
        self.hello.margins || !self.hello.has_epsilons()
    }

    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[T::Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        if self.hello.has_epsilons() {
            let _turn = self.turns.take();
            let (open, width) = (open_epsilons(info), info.gates.len());
            let ask = |cases: &[T::Case<F>], verdicts: &mut [Verdict<F>], margins: &mut [F]| {
                self.ask(cases, &open, verdicts, margins).map(|_| ())
            };
            let failed = |failure, case: &T::Case<F>| {
                self.state().margins.add(failure, &T::shown(case));
            };
            let margins = margins.chunks_mut(MARGINS_AT_ONCE * width);
            let parts = cases
                .chunks(MARGINS_AT_ONCE)
                .zip(verdicts.chunks_mut(MARGINS_AT_ONCE));
            for ((cases, verdicts), margins) in parts.zip(margins) {
                if self.state().asks_no_margins() {
                    margins.fill(F::from_f64(f64::NAN));
                    continue;
                }
                let found =
                    margins::find::<F, T>((info, &open), cases, verdicts, margins, &ask, &failed);
                if let Err(message) = found {
                    self.state().gave_up.get_or_insert(message);
                }
            }
        } else {
            Subject::run(self, cases, &[], &mut verdicts);
        }
        let pairs = values.iter_mut().zip(&verdicts);
        pairs.for_each(|(place, verdict)| *place = values_of(info, verdict));
    }

    fn margins_gave_up(&self) -> Option<String> {
        self.state().margins.gave_up.clone()
    }

    fn notes(&self) -> Vec<String> {
        let state = self.state();
        let mut notes = state.notes.clone();
        notes.extend(state.margins.note());
        if self.program.said.are_too_many() {
            notes.push(format!(
                "it writes more than {MOST_LINES} different lines to standard error; the rest is left out"
            ));
        }
        notes
    }

    fn talks(&self) -> bool {
        // What it wrote before an answer may still be on its way; a kernel that was once silent for that long is not
        // waited for again.
        let has_listened = std::mem::replace(&mut self.state().has_listened, true);
        let mut waits = if has_listened { 0 } else { LISTENED };
        while 0 < waits && !self.program.said.are_some() {
            std::thread::sleep(Duration::from_millis(10));
            waits -= 1;
        }
        self.program.said.are_some()
    }

    fn finish(&self) {
        let idle = std::mem::take(&mut self.state().idle);
        running::finish(idle);
    }

    fn gave_up(&self) -> Option<String> {
        self.state().gave_up.clone()
    }
}

impl<T: Asked> Process<T> {
    fn try_run<F: Float>(
        &self,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
    ) -> Result<Option<u64>, String> {
        match (self.ask(cases, epsilons, verdicts, &mut []), cases) {
            (Ok(took), _) => return Ok(took),
            (Err(Lost::Garbled(message)), _) => return Err(message),
            (Err(Lost::Failed(failure)), [case]) => {
                verdicts[0] = self.pinned::<F>(failure, case)?
            }
            (Err(Lost::Failed(failure)), _) => {
                if failure == Failure::Timeout && self.limits.timeouts < u64::MAX {
                    (self.limits.tell)(&format!(
                        "kernel '{}': no answer within {} s on {} cases together; they are asked one by one",
                        self.hello.name(),
                        self.limits.silence.as_secs_f64(),
                        group_digits(cases.len() as u64)
                    ));
                }
                self.pin_all(failure, cases, epsilons, verdicts)?;
            }
        }
        Ok(None)
    }
}
