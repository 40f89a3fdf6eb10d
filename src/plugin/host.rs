//! The child's side of `--kernel-lib`: loads a library with the functions of include/hairline.h and
//! answers batches in the binary encoding. It is a process of its own so that the library may crash,
//! hang, exit or write where it must not.
//!
//! Its unsafe code calls C.

#![allow(unsafe_code)]

mod guard;

use super::PROTOCOL;
use super::binary::{
    ANSWER, BATCH, BATCH_HEAD, Before, CASE_NUMBERS, MARGINS, float, push, verdict_bytes,
};
use crate::arith::{Float, FloatEnvironment};
use crate::kernel::{Failure, by_running, of_miss};
use guard::{Buffer, CurrentException, watch};
use libloading::os::unix;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, c_char, c_void};
use std::fs::File;
use std::io::{self, Read, Write};
use std::mem::ManuallyDrop;
use std::os::fd::{AsFd, AsRawFd};
use std::os::unix::process::parent_id;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

/// The version of include/hairline.h.
const ABI: u32 = 1;

/// `hairline_epsilon`.
#[repr(C)]
struct Epsilon {
    name: *const c_char,
    value: *const c_char,
    refuses: *const c_char,
    length: i32,
    direction: i32,
    non_negative: i32,
    reserved: i32,
}

/// `hairline_kernel`.
#[repr(C)]
struct Kernel {
    name: *const c_char,
    source: *const c_char,
    contract: *const c_char,
    gives: u32,
    epsilon_count: u32,
    epsilons: *const Epsilon,
}

/// `hairline_test_f32` and `hairline_test_f64`: cases, count, epsilons, verdicts.
type Test = unsafe extern "C-unwind" fn(*const c_void, usize, *const c_void, *mut c_void);

/// Loads a library and answers batches from standard input until it ends; returns the exit code.
pub fn serve(path: &Path) -> u8 {
    let mut job = Job { path, code: 1 };
    // A thread, but none of Rust's: at the end of such a one stands a handler for all exceptions, and a C++
    // runtime that finds a handler does not say what was thrown. For the same reason `on_thread` may unwind;
    // nothing ever does that far.
    //
    // SAFETY: the two kinds of functions are called alike, and the job lives until the thread is joined.
    let is_done = unsafe {
        let run = std::mem::transmute::<UnwindingStart, Start>(on_thread as UnwindingStart);
        let mut thread = std::mem::zeroed();
        let job = (&raw mut job).cast();
        libc::pthread_create(&mut thread, std::ptr::null(), run, job) == 0
            && libc::pthread_join(thread, std::ptr::null_mut()) == 0
    };
    if !is_done {
        eprintln!("hairline: no thread for the library: {}", io::Error::last_os_error());
    }
    job.code
}

/// What the thread of a library does.
struct Job<'a> {
    path: &'a Path,
    code: u8,
}

/// What a thread runs, as the C library has it, and the same with leave to unwind.
type Start = extern "C" fn(*mut c_void) -> *mut c_void;
type UnwindingStart = extern "C-unwind" fn(*mut c_void) -> *mut c_void;

extern "C-unwind" fn on_thread(job: *mut c_void) -> *mut c_void {
    // SAFETY: `serve` passes its job, and waits.
    let job = unsafe { &mut *job.cast::<Job>() };
    job.code = serve_here(job.path);
    std::ptr::null_mut()
}

fn serve_here(path: &Path) -> u8 {
    match Protocol::take() {
        Err(error) => {
            eprintln!("hairline: {error}");
            1
        }
        Ok(mut protocol) => match protocol.serve(path) {
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
        if moved { Ok(Protocol { input, output }) } else { Err(io::Error::last_os_error()) }
    }

    fn serve(&mut self, path: &Path) -> Result<(), String> {
        limit_damage();
        let library = Library::open(path)?;
        let hello = library.hello()?;
        let mut floats = FloatEnvironment::now();
        let hello = format!("{hello}floats {}\nmargins\nready\n", floats.bits());
        let failed = |error: io::Error| error.to_string();
        self.output.write_all(hello.as_bytes()).map_err(failed)?;
        watch(self.output.as_raw_fd(), library.current_exception());
        let mut room = Room::new().map_err(failed)?;
        while let Some(batch) = self.batch(&library, &mut room).map_err(failed)? {
            self.answer(&batch, &mut room, &mut floats).map_err(failed)?;
        }
        Ok(())
    }

    /// A batch; none at the end of the input.
    fn batch(&mut self, library: &Library, room: &mut Room) -> io::Result<Option<Batch>> {
        let mut head = [0; BATCH_HEAD];
        if self.input.read(&mut head[..1])? == 0 {
            return Ok(None);
        }
        self.input.read_exact(&mut head[1..])?;
        let word = |at: usize| {
            u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]) as usize
        };
        let test = if word(4) == 32 { library.f32 } else { library.f64 };
        let with_margins = head[..4] == MARGINS;
        let (Some(test), true) = (test, with_margins || head[..4] == BATCH) else {
            return Err(io::Error::other("not a batch"));
        };
        let (size, count) = (word(4) / 8, word(8));
        let lengths = [word(12) * size, count * CASE_NUMBERS * size];
        for (buffer, length) in [&mut room.epsilons, &mut room.cases].into_iter().zip(lengths) {
            buffer.fit(length)?;
            self.input.read_exact(buffer.bytes())?;
            buffer.make_read_only()?;
        }
        Ok(Some(Batch { test, size, count, with_margins }))
    }

    fn answer(
        &mut self,
        batch: &Batch,
        room: &mut Room,
        floats: &mut FloatEnvironment,
    ) -> io::Result<()> {
        let &Batch { test, size, count, with_margins } = batch;
        let record = if size == 4 { verdict_bytes::<f32>() } else { verdict_bytes::<f64>() };
        room.verdicts.fit(count * record)?;
        // No verdict has a hit of -1: what stays so was not answered.
        room.verdicts.bytes().fill(0xff);
        let [cases, epsilons, verdicts] = [&room.cases, &room.epsilons, &room.verdicts]
            .map(|buffer| buffer.start().cast::<c_void>());
        let start = Instant::now();
        // SAFETY: the pointers are valid for what include/hairline.h promises the library; whether
        // the library keeps to it is what this process is for.
        unsafe { test(cases, count, epsilons, verdicts) };
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
            self.output.write_all(&Before::Failure(Failure::Overrun).head())?;
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
        Ok(Room { cases, epsilons, verdicts, one_epsilons, one_verdict })
    }
}

/// What a library is asked.
struct Batch {
    test: Test,
    /// Bytes of the scalar.
    size: usize,
    /// Of cases.
    count: usize,
    with_margins: bool,
}

impl Batch {
    /// The bytes of each case's margins, one a gate. An answer that is neither a hit nor a miss, at whatever
    /// epsilons, becomes the case's verdict, which this program's parent refuses; none if it wrote before its
    /// output.
    fn margins<F: Float>(&self, room: &mut Room) -> io::Result<Option<Vec<u8>>> {
        let open: Vec<F> =
            room.epsilons.as_bytes().chunks_exact(size_of::<F>()).map(float).collect();
        room.one_epsilons.fit(size_of_val(&open[..]))?;
        room.one_verdict.fit(verdict_bytes::<F>())?;
        let (cases, verdicts) = (&room.cases, &mut room.verdicts);
        let one = RefCell::new([&mut room.one_epsilons, &mut room.one_verdict]);
        let mut bytes = Vec::with_capacity(self.count * size_of_val(&open[..]));
        for (i, verdict) in verdicts.bytes().chunks_exact_mut(verdict_bytes::<F>()).enumerate() {
            let is_wrong = Cell::new(false);
            let is_hit = |epsilons: &[F]| {
                let hit = self.ask_one(i, cases, epsilons, &mut one.borrow_mut());
                is_wrong.set(is_wrong.get() || (hit != HIT && hit != MISS));
                hit == HIT
            };
            let mut margins = vec![-F::infinity(); open.len()];
            match verdict[..4] == HIT {
                true => by_running(&open, is_hit, &mut margins),
                false => of_miss(&open, is_hit, &mut margins),
            }
            if is_wrong.get() {
                verdict[..4].copy_from_slice(&WRONG);
            }
            margins.into_iter().for_each(|margin| push(&mut bytes, margin));
        }
        Ok(room.one_verdict.is_untouched_before().then_some(bytes))
    }

    /// What the library says of one case of the batch at some epsilons: the first bytes of its verdict. These
    /// epsilons and the verdict have their own room.
    fn ask_one<F: Float>(
        &self,
        i: usize,
        cases: &Buffer,
        epsilons: &[F],
        [room, verdict]: &mut [&mut Buffer; 2],
    ) -> [u8; 4] {
        let mut bytes = Vec::with_capacity(size_of_val(epsilons));
        epsilons.iter().for_each(|epsilon| push(&mut bytes, *epsilon));
        room.bytes().copy_from_slice(&bytes);
        verdict.bytes().fill(0xff);
        // SAFETY: the i-th case is one of the batch, and all pointers are as include/hairline.h promises.
        unsafe {
            let case = cases.start().add(i * CASE_NUMBERS * self.size);
            (self.test)(case.cast(), 1, room.start().cast(), verdict.start().cast());
        }
        let hit = &verdict.as_bytes()[..4];
        [hit[0], hit[1], hit[2], hit[3]]
    }
}

/// The first bytes of a verdict that is none, as an unanswered one has them.
const WRONG: [u8; 4] = [0xff; 4];
/// Of a miss.
const MISS: [u8; 4] = [0; 4];
/// Of a hit.
const HIT: [u8; 4] = 1i32.to_ne_bytes();

/// No core files, and no life without the program that started this one: a kernel that hangs does not
/// see its input end.
fn limit_damage() {
    let none = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
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

/// A loaded library; it stays loaded until the process ends.
struct Library {
    library: ManuallyDrop<unix::Library>,
    f32: Option<Test>,
    f64: Option<Test>,
}

impl Library {
    fn open(path: &Path) -> Result<Library, String> {
        // SAFETY: what the library's constructors do is what this process is for.
        let opened = unsafe { unix::Library::open(Some(path), unix::RTLD_NOW | unix::RTLD_LOCAL) };
        let library = ManuallyDrop::new(opened.map_err(|error| {
            // What the loader says stands in the source of the error.
            let reason = std::error::Error::source(&error).map(ToString::to_string);
            one_line(&reason.unwrap_or_else(|| error.to_string()))
        })?);
        let mut library = Library { library, f32: None, f64: None };
        // SAFETY: by include/hairline.h this symbol has this type.
        let abi = unsafe { library.symbol::<unsafe extern "C" fn() -> u32>("hairline_abi") };
        let abi = abi.ok_or(
            "it has no function hairline_abi: build it with include/hairline.h (extern \"C\" in C++)",
        )?;
        // SAFETY: it takes nothing.
        let abi = unsafe { abi() };
        if abi != ABI {
            return Err(format!(
                "it was built with version {abi} of hairline.h, this program has version {ABI}"
            ));
        }
        // SAFETY: by include/hairline.h these symbols have this type.
        unsafe {
            library.f32 = library.symbol::<Test>("hairline_test_f32");
            library.f64 = library.symbol::<Test>("hairline_test_f64");
        }
        if library.f32.is_none() && library.f64.is_none() {
            return Err("it has neither hairline_test_f32 nor hairline_test_f64".to_owned());
        }
        Ok(library)
    }

    /// How to ask the library's C++ runtime for the exception that is being handled, if it has one.
    fn current_exception(&self) -> Option<CurrentException> {
        // SAFETY: by the Itanium C++ ABI (2.5.4) this symbol has this type.
        unsafe { self.symbol::<CurrentException>("__cxa_current_exception_type") }
    }

    /// A function of the library.
    ///
    /// # Safety
    /// The symbol is a function of type `T`, if there is one.
    unsafe fn symbol<T: Copy>(&self, name: &str) -> Option<T> {
        // SAFETY: the caller's promise.
        let symbol = unsafe { self.library.get::<T>(name.as_bytes()) };
        symbol.ok().map(|symbol| *symbol)
    }

    /// What the library says of itself, as the lines of a hello.
    fn hello(&self) -> Result<String, String> {
        // SAFETY: by include/hairline.h the symbol has this type, and what it returns stays valid.
        let kernel = unsafe {
            let describe =
                self.symbol::<unsafe extern "C" fn() -> *const Kernel>("hairline_describe");
            let describe = describe.ok_or("it has no function hairline_describe")?;
            describe().as_ref().ok_or("hairline_describe returned NULL")?
        };
        // SAFETY: strings by include/hairline.h.
        let [name, source, contract] =
            unsafe { [kernel.name, kernel.source, kernel.contract].map(|text| text_of(text)) };
        let mut hello = format!("hairline-kernel {PROTOCOL}\nencoding binary\n");
        hello += &format!("name {}\n", name.ok_or("its name is NULL")?);
        hello += &format!("contract {}\n", contract.ok_or("its contract is NULL")?);
        hello += &source.map_or_else(String::new, |source| format!("source {source}\n"));
        let words = |words: &[(bool, &str)]| -> String {
            words.iter().filter(|(given, _)| *given).map(|(_, word)| format!(" {word}")).collect()
        };
        let gives =
            [(1, "t"), (2, "uv"), (4, "facing")].map(|(bit, w)| (kernel.gives & bit != 0, w));
        hello += &format!("gives{}\n", words(&gives));
        let scalars = [(self.f32.is_some(), "f32"), (self.f64.is_some(), "f64")];
        hello += &format!("scalars{}\n", words(&scalars));
        if kernel.epsilon_count > 0 && kernel.epsilons.is_null() {
            return Err("its epsilons are NULL, and epsilon_count is not 0".to_owned());
        }
        for i in 0..kernel.epsilon_count as usize {
            // SAFETY: epsilon_count elements by include/hairline.h.
            hello += &epsilon_line(unsafe { &*kernel.epsilons.add(i) })?;
        }
        Ok(hello)
    }
}

fn epsilon_line(epsilon: &Epsilon) -> Result<String, String> {
    // SAFETY: strings by include/hairline.h.
    let [name, value, refuses] =
        unsafe { [epsilon.name, epsilon.value, epsilon.refuses].map(|text| text_of(text)) };
    let name = name.ok_or("an epsilon's name is NULL")?;
    let value = value.ok_or_else(|| format!("the value of epsilon {name} is NULL"))?;
    let sign = if epsilon.non_negative != 0 { "non-negative" } else { "signed" };
    let (length, direction) = (epsilon.length, epsilon.direction);
    let refuses = refuses.unwrap_or_default();
    Ok(format!("epsilon {name} {value} {length} {direction} {sign} {refuses}\n"))
}

/// A C string on one line; none for NULL.
///
/// # Safety
/// `text` is NULL or a valid C string.
unsafe fn text_of(text: *const c_char) -> Option<String> {
    // SAFETY: the caller's promise.
    let text = (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) })?;
    Some(one_line(&text.to_string_lossy()))
}

fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
