//! The child's side of `--kernel-lib`: loads a library with the functions of include/hairline.h and
//! answers batches in the binary encoding. It is a process of its own so that the library may crash,
//! hang, exit or write where it must not.
//!
//! Its unsafe code calls C.

#![allow(unsafe_code)]

mod guard;
mod library;

use super::asked::Form;
use super::binary::{
    ANSWER, BATCH, BATCH_HEAD, Before, MARGINS, float, push, verdict_bytes, write, write_batch,
};
use crate::arith::{Float, FloatEnvironment};
use crate::files::number;
use crate::kernel::{Failure, by_running};
use guard::{Buffer, watch};
use library::{Library, TestFunction, one_line};
use std::cell::{Cell, RefCell};
use std::ffi::c_void;
use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, AsRawFd};
use std::os::unix::process::parent_id;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

/// Loads a library whose kernel judges a target, and answers batches from standard input until it ends; returns the exit code.
///
/// A library that is asked more than once may be wrong after many calls. So for `long_run`, if it is not 0, the first whole
/// batch is asked again and again before its answer counts.
pub fn serve(form: &Form, path: &Path, long_run: Duration) -> u8 {
    let mut job = LibraryJob {
        form,
        path,
        long_run,
        code: 1,
    };
    // A thread, but none of Rust's: at the end of such a one stands a handler for all exceptions, and a C++
    // runtime that finds a handler does not say what was thrown. For the same reason `on_thread` may unwind;
    // nothing ever does that far.
    //
    // SAFETY: the two kinds of functions are called alike, and the job lives until the thread is joined.
    let is_done = unsafe {
        let run = std::mem::transmute::<UnwindingStart, ThreadStart>(on_thread as UnwindingStart);
        let mut thread = std::mem::zeroed();
        let job = (&raw mut job).cast();
        libc::pthread_create(&mut thread, std::ptr::null(), run, job) == 0
            && libc::pthread_join(thread, std::ptr::null_mut()) == 0
    };
    if !is_done {
        eprintln!(
            "hairline: no thread for the library: {}",
            io::Error::last_os_error()
        );
    }
    job.code
}

/// The job of a library's thread.
struct LibraryJob<'a> {
    form: &'a Form,
    path: &'a Path,
    long_run: Duration,
    code: u8,
}

/// The function that a thread runs, as the C library has it, and the same with leave to unwind.
type ThreadStart = extern "C" fn(*mut c_void) -> *mut c_void;
type UnwindingStart = extern "C-unwind" fn(*mut c_void) -> *mut c_void;

extern "C-unwind" fn on_thread(job: *mut c_void) -> *mut c_void {
    // SAFETY: `serve` passes its job, and waits.
    let job = unsafe { &mut *job.cast::<LibraryJob>() };
    job.code = serve_here(job);
    std::ptr::null_mut()
}

fn serve_here(job: &LibraryJob) -> u8 {
    match Protocol::take() {
        Err(error) => {
            eprintln!("hairline: {error}");
            1
        }
        Ok(mut protocol) => match protocol.serve(job) {
            Ok(()) => 0,
            Err(message) => {
                let _ = writeln!(protocol.output, "error {}", one_line(&message));
                1
            }
        },
    }
}

/// The pipes to the program that started this one.
struct Protocol {
    input: File,
    output: File,
}

impl Protocol {
    /// Takes standard input and output for the protocol; the library's own prints go to standard
    /// error, and it reads nothing.
    fn take() -> io::Result<Protocol> {
        let input = File::from(io::stdin().as_fd().try_clone_to_owned()?);
        let output = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let nothing = File::open("/dev/null")?;
        // SAFETY: dup2 of descriptors that are open; nothing in this process owns 0 and 1.
        let moved = unsafe { libc::dup2(nothing.as_raw_fd(), 0) >= 0 && libc::dup2(2, 1) >= 0 };
        if moved {
            Ok(Protocol { input, output })
        } else {
            Err(io::Error::last_os_error())
        }
    }

    fn serve(&mut self, job: &LibraryJob) -> Result<(), String> {
        limit_damage();
        let library = Library::open(job.path, job.form)?;
        let hello = library.hello()?;
        let mut floats = FloatEnvironment::now();
        let announced = format!("{hello}floats {}\nmargins\n", floats.bits());
        let failed = |error: io::Error| error.to_string();
        self.output
            .write_all(announced.as_bytes())
            .map_err(failed)?;
        watch(self.output.as_raw_fd(), library.current_exception());
        let mut room = Room::new().map_err(failed)?;
        first_call::<f32>(&library, &hello, &mut room).map_err(failed)?;
        first_call::<f64>(&library, &hello, &mut room).map_err(failed)?;
        self.output.write_all(b"ready\n").map_err(failed)?;
        let mut long_run = Some(job.long_run).filter(|limit| !limit.is_zero());
        while let Some(batch) =
            HostBatch::read(&mut self.input, &library, &mut room).map_err(failed)?
        {
            if let Some(limit) = long_run.take_if(|_| batch.is_whole()) {
                batch.ask_often(&mut room, limit).map_err(failed)?;
            }
            self.answer(&batch, &mut room, &mut floats)
                .map_err(failed)?;
        }
        Ok(())
    }

    fn answer(
        &mut self,
        batch: &HostBatch,
        room: &mut Room,
        floats: &mut FloatEnvironment,
    ) -> io::Result<()> {
        let &HostBatch {
            size,
            count,
            with_margins,
            ..
        } = batch;
        batch.make_room(room)?;
        let start = Instant::now();
        batch.call(room);
        let took = Before::Took(start.elapsed().as_nanos() as u64);
        let margins = match (with_margins, size) {
            (false, _) => Some(Vec::new()),
            (true, 4) => batch.margins::<f32>(room)?,
            (true, _) => batch.margins::<f64>(room)?,
        };
        let before = std::mem::replace(floats, FloatEnvironment::now());
        if *floats != before {
            self.output.write_all(&Before::Floats(*floats).head())?;
        }
        let Some(margins) = margins.filter(|_| room.verdicts.is_untouched_before()) else {
            self.output
                .write_all(&Before::Failure(Failure::Overrun).head())?;
            return Err(io::Error::other("wrote before its output"));
        };
        let mut answer = Vec::with_capacity(16 + room.verdicts.as_bytes().len() + margins.len());
        answer.extend(took.head());
        answer.extend(ANSWER);
        answer.extend((count as u32).to_le_bytes());
        answer.extend(room.verdicts.as_bytes());
        answer.extend(margins);
        self.output.write_all(&answer)
    }
}

/// The memory that a library sees.
struct Room {
    cases: Buffer,
    epsilons: Buffer,
    verdicts: Buffer,
    /// One case's epsilons and its verdict, while margins are looked for.
    one_epsilons: Buffer,
    one_verdict: Buffer,
}

impl Room {
    fn new() -> io::Result<Room> {
        let [cases, epsilons, verdicts, one_epsilons, one_verdict] = Buffer::all()?;
        Ok(Room {
            cases,
            epsilons,
            verdicts,
            one_epsilons,
            one_verdict,
        })
    }
}

/// A request to a library.
struct HostBatch {
    test: TestFunction,
    /// Bytes of the scalar.
    size: usize,
    /// The number of cases.
    count: usize,
    /// The numbers of a case.
    width: usize,
    with_margins: bool,
}

/// Answers a plain case, a hit in the middle, and forgets the verdict: a library may take long for its
/// first call, and that is no case's fault.
fn first_call<F: Float>(library: &Library, hello: &str, room: &mut Room) -> io::Result<()> {
    let is_there = if size_of::<F>() == 4 {
        library.f32
    } else {
        library.f64
    };
    if is_there.is_none() {
        return Ok(());
    }
    let numbers = library.form.plain.iter();
    let plain: Vec<F> = numbers.map(|number| F::from_f64(*number)).collect();
    // An invalid value is refused by who reads the hello.
    let value = |line: &str| number::parse(line.split(' ').nth(2)?).ok();
    let epsilons = hello.lines().filter(|line| line.starts_with("epsilon "));
    let epsilons: Vec<F> = epsilons
        .map(|line| value(line).unwrap_or(F::zero()))
        .collect();
    let mut bytes = Vec::new();
    let width = plain.len();
    let cases = [plain].into_iter();
    write_batch(BATCH, width, cases, &epsilons, &mut bytes);
    if let Some(batch) = HostBatch::read(&mut &bytes[..], library, room)? {
        batch.make_room(room)?;
        batch.call(room);
    }
    Ok(())
}

/// A batch of so many cases is a whole one, and no part in which a failure is looked for.
const WHOLE: usize = 1024;

/// Rounds whose time says nothing about the next: a library's first call reads files, builds tables, fills caches.
const WARM_UP: usize = 3;

/// More calls than a 24-bit counter or a float can count.
const MANY_CALLS: usize = (1 << 24) + WHOLE;

impl HostBatch {
    /// Reads a batch; none at the end of the input.
    fn read(
        input: &mut impl Read,
        library: &Library,
        room: &mut Room,
    ) -> io::Result<Option<HostBatch>> {
        let mut head = [0; BATCH_HEAD];
        if input.read(&mut head[..1])? == 0 {
            return Ok(None);
        }
        input.read_exact(&mut head[1..])?;
        let word = |at: usize| {
            u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]) as usize
        };
        let test = if word(4) == 32 {
            library.f32
        } else {
            library.f64
        };
        let with_margins = head[..4] == MARGINS;
        let (Some(test), true) = (test, with_margins || head[..4] == BATCH) else {
            return Err(io::Error::other("not a batch"));
        };
        let (size, count) = (word(4) / 8, word(8));
        let width = library.form.plain.len();
        let lengths = [word(12) * size, count * width * size];
        for (buffer, length) in [&mut room.epsilons, &mut room.cases]
            .into_iter()
            .zip(lengths)
        {
            buffer.fit(length)?;
            input.read_exact(buffer.bytes())?;
            buffer.make_read_only()?;
        }
        Ok(Some(HostBatch {
            test,
            size,
            count,
            width,
            with_margins,
        }))
    }

    /// Makes room for its verdicts. No verdict has a hit of -1: what stays so was not answered.
    fn make_room(&self, room: &mut Room) -> io::Result<()> {
        let record = if self.size == 4 {
            verdict_bytes::<f32>()
        } else {
            verdict_bytes::<f64>()
        };
        room.verdicts.fit(self.count * record)?;
        room.verdicts.bytes().fill(0xff);
        Ok(())
    }

    /// Lets the library answer it.
    fn call(&self, room: &Room) {
        let [cases, epsilons, verdicts] = [&room.cases, &room.epsilons, &room.verdicts]
            .map(|buffer| buffer.start().cast::<c_void>());
        // SAFETY: the pointers are valid for what include/hairline.h promises the library; whether
        // the library keeps to it is what this process is for.
        unsafe { (self.test)(cases, self.count, epsilons, verdicts) };
    }

    fn is_whole(&self) -> bool {
        WHOLE <= self.count && !self.with_margins
    }

    /// Asks the library all of this again until it has answered so many cases; a few times only, if that would take longer
    /// than a limit.
    fn ask_often(&self, room: &mut Room, limit: Duration) -> io::Result<()> {
        self.make_room(room)?;
        let rounds = MANY_CALLS.div_ceil(self.count);
        for round in 0..rounds {
            let start = Instant::now();
            self.call(room);
            if round == WARM_UP && limit < start.elapsed() * rounds as u32 {
                return Ok(());
            }
        }
        Ok(())
    }

    /// The bytes of each case's margins, one a gate. An answer that is neither a hit nor a miss, at whatever
    /// epsilons, becomes the case's verdict, which this program's parent refuses; none if it wrote before its
    /// output.
    fn margins<F: Float>(&self, room: &mut Room) -> io::Result<Option<Vec<u8>>> {
        let open: Vec<F> = room
            .epsilons
            .as_bytes()
            .chunks_exact(size_of::<F>())
            .map(float)
            .collect();
        room.one_epsilons.fit(size_of_val(&open[..]))?;
        room.one_verdict.fit(verdict_bytes::<F>())?;
        let (cases, verdicts) = (&room.cases, &mut room.verdicts);
        let one = RefCell::new([&mut room.one_epsilons, &mut room.one_verdict]);
        let mut bytes = Vec::with_capacity(self.count * size_of_val(&open[..]));
        for (i, verdict) in verdicts
            .bytes()
            .chunks_exact_mut(verdict_bytes::<F>())
            .enumerate()
        {
            let is_wrong = Cell::new(false);
            let is_hit = |epsilons: &[F]| {
                let hit = self.ask_one(i, cases, epsilons, &mut one.borrow_mut());
                is_wrong.set(is_wrong.get() || (hit != HIT && hit != MISS));
                hit == HIT
            };
            let mut margins = vec![-F::infinity(); open.len()];
            by_running(&open, verdict[..4] == HIT, is_hit, &mut margins);
            if is_wrong.get() {
                verdict[..4].copy_from_slice(&WRONG);
            }
            margins
                .into_iter()
                .for_each(|margin| push(&mut bytes, margin));
        }
        Ok(room.one_verdict.is_untouched_before().then_some(bytes))
    }

    /// The library's answer to one case of the batch at some epsilons: the first bytes of its verdict. These
    /// epsilons and the verdict have their own room.
    fn ask_one<F: Float>(
        &self,
        i: usize,
        cases: &Buffer,
        epsilons: &[F],
        [room, verdict]: &mut [&mut Buffer; 2],
    ) -> [u8; 4] {
        // A hundred times a case: without a vector each time.
        let places = room.bytes().chunks_exact_mut(size_of::<F>());
        for (place, epsilon) in places.zip(epsilons) {
            write(place, *epsilon);
        }
        verdict.bytes().fill(0xff);
        // SAFETY: the i-th case is one of the batch, and all pointers are as include/hairline.h promises.
        unsafe {
            let case = cases.start().add(i * self.width * self.size);
            (self.test)(case.cast(), 1, room.start().cast(), verdict.start().cast());
        }
        let hit = &verdict.as_bytes()[..4];
        [hit[0], hit[1], hit[2], hit[3]]
    }
}

/// The first bytes of a verdict that is none, as an unanswered one has them.
const WRONG: [u8; 4] = [0xff; 4];
/// The first bytes of a miss.
const MISS: [u8; 4] = [0; 4];
/// The first bytes of a hit.
const HIT: [u8; 4] = 1i32.to_ne_bytes();

/// No core files, and no life without the program that started this one: a kernel that hangs does not
/// see its input end.
fn limit_damage() {
    let none = libc::rlimit {
        rlim_cur: 0,
        rlim_max: 0,
    };
    // SAFETY: a plain system call on this process.
    unsafe { libc::setrlimit(libc::RLIMIT_CORE, &none) };
    let parent = parent_id();
    thread::spawn(move || {
        while parent_id() == parent {
            thread::sleep(Duration::from_secs(1));
        }
        std::process::exit(1);
    });
}

/// Kills a process that leads a group, and all that it started.
pub(super) fn kill_group(leader: u32) {
    // SAFETY: a plain system call; an id that no group has is an error, which is none here.
    unsafe { libc::kill(-(leader as libc::pid_t), libc::SIGKILL) };
}
