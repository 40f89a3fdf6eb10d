//! The child's side of `--kernel-lib`: loads a library with the functions of include/hairline.h and
//! answers batches in the binary encoding. It is a process of its own so that the library may crash,
//! hang, exit or write where it must not.
//!
//! Its unsafe code calls C.

#![allow(unsafe_code)]

mod guard;

use super::PROTOCOL;
use super::binary::{
    ANSWER, BATCH, BATCH_HEAD, CASE_NUMBERS, MARGINS, environment_head, float, push, verdict_bytes,
};
use crate::arith::{Float, FloatEnvironment};
use crate::kernel::{by_running, of_miss};
use guard::{Buffer, overrun_head, watch_guards};
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
use std::time::Duration;

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
type Test = unsafe extern "C" fn(*const c_void, usize, *const c_void, *mut c_void);

/// Loads a library and answers batches from standard input until it ends; returns the exit code.
pub fn serve(path: &Path) -> u8 {
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
        watch_guards(self.output.as_raw_fd());
        while let Some(batch) = self.batch(&library).map_err(failed)? {
            self.answer(&batch, &mut floats).map_err(failed)?;
        }
        Ok(())
    }

    /// A batch; none at the end of the input.
    fn batch(&mut self, library: &Library) -> io::Result<Option<Batch>> {
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
        let mut epsilons = Buffer::new(1, word(12) * size)?;
        self.input.read_exact(epsilons.bytes())?;
        let mut cases = Buffer::new(0, count * CASE_NUMBERS * size)?;
        self.input.read_exact(cases.bytes())?;
        cases.make_read_only()?;
        epsilons.make_read_only()?;
        Ok(Some(Batch { test, size, count, cases, epsilons, with_margins }))
    }

    fn answer(&mut self, batch: &Batch, floats: &mut FloatEnvironment) -> io::Result<()> {
        let &Batch { test, size, count, ref cases, ref epsilons, with_margins } = batch;
        let record = if size == 4 { verdict_bytes::<f32>() } else { verdict_bytes::<f64>() };
        let mut verdicts = Buffer::new(2, count * record)?;
        // No verdict has a hit of -1: what stays so was not answered.
        verdicts.bytes().fill(0xff);
        // SAFETY: the pointers are valid for what include/hairline.h promises the library; whether
        // the library keeps to it is what this process is for.
        unsafe {
            test(cases.start().cast(), count, epsilons.start().cast(), verdicts.start().cast())
        };
        let margins = match (with_margins, size) {
            (false, _) => Some(Vec::new()),
            (true, 4) => batch.margins::<f32>(&mut verdicts)?,
            (true, _) => batch.margins::<f64>(&mut verdicts)?,
        };
        let before = std::mem::replace(floats, FloatEnvironment::now());
        if *floats != before {
            self.output.write_all(&environment_head(*floats))?;
        }
        let Some(margins) = margins.filter(|_| verdicts.is_untouched_before()) else {
            self.output.write_all(&overrun_head())?;
            return Err(io::Error::other("wrote before its output"));
        };
        self.output.write_all(&ANSWER)?;
        self.output.write_all(&(count as u32).to_le_bytes())?;
        self.output.write_all(verdicts.bytes())?;
        self.output.write_all(&margins)
    }
}

/// What a library is asked.
struct Batch {
    test: Test,
    /// Bytes of the scalar.
    size: usize,
    /// Of cases.
    count: usize,
    cases: Buffer,
    epsilons: Buffer,
    with_margins: bool,
}

impl Batch {
    /// The bytes of each case's margins, one a gate. An answer that is neither a hit nor a miss, at whatever
    /// epsilons, becomes the case's verdict, which this program's parent refuses; none if it wrote before its
    /// output.
    fn margins<F: Float>(&self, verdicts: &mut Buffer) -> io::Result<Option<Vec<u8>>> {
        let open: Vec<F> =
            self.epsilons.as_bytes().chunks_exact(size_of::<F>()).map(float).collect();
        let probe = RefCell::new(Probe {
            epsilons: Buffer::new(1, size_of_val(&open[..]))?,
            verdict: Buffer::new(2, verdict_bytes::<F>())?,
        });
        let mut bytes = Vec::with_capacity(self.count * size_of_val(&open[..]));
        for (i, verdict) in verdicts.bytes().chunks_exact_mut(verdict_bytes::<F>()).enumerate() {
            let is_wrong = Cell::new(false);
            let is_hit = |epsilons: &[F]| {
                let hit = probe.borrow_mut().ask(self, i, epsilons);
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
        Ok(probe.into_inner().verdict.is_untouched_before().then_some(bytes))
    }
}

/// Room for one case's epsilons and its verdict, between guards like those of a batch.
struct Probe {
    epsilons: Buffer,
    verdict: Buffer,
}

impl Probe {
    /// What a library says of one case of a batch at some epsilons: the first bytes of its verdict.
    fn ask<F: Float>(&mut self, batch: &Batch, i: usize, epsilons: &[F]) -> [u8; 4] {
        let mut bytes = Vec::with_capacity(size_of_val(epsilons));
        epsilons.iter().for_each(|epsilon| push(&mut bytes, *epsilon));
        self.epsilons.bytes().copy_from_slice(&bytes);
        self.verdict.bytes().fill(0xff);
        // SAFETY: the i-th case is one of the batch, and all pointers are as include/hairline.h promises.
        unsafe {
            let case = batch.cases.start().add(i * CASE_NUMBERS * batch.size);
            let (epsilons, verdict) = (self.epsilons.start(), self.verdict.start());
            (batch.test)(case.cast(), 1, epsilons.cast(), verdict.cast());
        }
        let hit = &self.verdict.as_bytes()[..4];
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
