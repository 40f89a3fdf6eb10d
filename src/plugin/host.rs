//! The child's side of `--kernel-lib`: loads a library with the functions of include/hairline.h and
//! answers batches in the binary encoding. It is a process of its own so that the library may crash,
//! hang, exit or write where it must not.
//!
//! Its unsafe code calls C.

#![allow(unsafe_code)]

use super::PROTOCOL;
use super::binary::{
    ANSWER, BATCH, BATCH_HEAD, CASE_NUMBERS, OVERRUN, environment_head, verdict_bytes,
};
use crate::arith::FloatEnvironment;
use libloading::os::unix;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::fs::File;
use std::io::{self, Read, Write};
use std::mem::ManuallyDrop;
use std::os::fd::{AsFd, AsRawFd};
use std::os::unix::process::parent_id;
use std::path::Path;
use std::ptr;
use std::sync::atomic::{AtomicI32, AtomicUsize, Ordering};
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
        let hello = format!("{hello}floats {}\nready\n", floats.bits());
        let failed = |error: io::Error| error.to_string();
        self.output.write_all(hello.as_bytes()).map_err(failed)?;
        watch_guards(self.output.as_raw_fd());
        while let Some((test, size, cases, epsilons)) = self.batch(&library).map_err(failed)? {
            self.answer(test, size, &cases, &epsilons, &mut floats).map_err(failed)?;
        }
        Ok(())
    }

    /// A batch: the function it is for, the bytes of its scalar, its cases and epsilons; none at the
    /// end of the input.
    #[allow(clippy::type_complexity)]
    fn batch(&mut self, library: &Library) -> io::Result<Option<(Test, usize, Buffer, Buffer)>> {
        let mut head = [0; BATCH_HEAD];
        if self.input.read(&mut head[..1])? == 0 {
            return Ok(None);
        }
        self.input.read_exact(&mut head[1..])?;
        let word = |at: usize| {
            u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]) as usize
        };
        let test = if word(4) == 32 { library.f32 } else { library.f64 };
        let (Some(test), true) = (test, head[..4] == BATCH) else {
            return Err(io::Error::other("not a batch"));
        };
        let (size, count) = (word(4) / 8, word(8));
        let mut epsilons = Buffer::new(1, word(12) * size)?;
        self.input.read_exact(epsilons.bytes())?;
        let mut cases = Buffer::new(0, count * CASE_NUMBERS * size)?;
        self.input.read_exact(cases.bytes())?;
        cases.make_read_only()?;
        epsilons.make_read_only()?;
        Ok(Some((test, size, cases, epsilons)))
    }

    fn answer(
        &mut self,
        test: Test,
        size: usize,
        cases: &Buffer,
        epsilons: &Buffer,
        floats: &mut FloatEnvironment,
    ) -> io::Result<()> {
        let count = cases.length / (CASE_NUMBERS * size);
        let record = if size == 4 { verdict_bytes::<f32>() } else { verdict_bytes::<f64>() };
        let mut verdicts = Buffer::new(2, count * record)?;
        // No verdict has a hit of -1: what stays so was not answered.
        verdicts.bytes().fill(0xff);
        // SAFETY: the pointers are valid for what include/hairline.h promises the library; whether
        // the library keeps to it is what this process is for.
        unsafe {
            test(cases.start().cast(), count, epsilons.start().cast(), verdicts.start().cast())
        };
        let before = std::mem::replace(floats, FloatEnvironment::now());
        if *floats != before {
            self.output.write_all(&environment_head(*floats))?;
        }
        if !verdicts.is_untouched_before() {
            self.output.write_all(&overrun_head())?;
            return Err(io::Error::other("wrote before its output"));
        }
        self.output.write_all(&ANSWER)?;
        self.output.write_all(&(count as u32).to_le_bytes())?;
        self.output.write_all(verdicts.bytes())
    }
}

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

/// Guard pages on each side of a buffer.
const GUARD_PAGES: usize = 16;
/// What stands between the guard in front of a buffer and the buffer.
const SLACK: u8 = 0xa5;

/// Where each of the three buffers begins and ends, guards included: what the handler looks at.
static RANGES: [[AtomicUsize; 2]; 3] = [const { [const { AtomicUsize::new(0) }; 2] }; 3];
/// Where the handler writes.
static OUTPUT: AtomicI32 = AtomicI32::new(-1);

/// Memory that ends where a guard begins: the first byte past it is a fault.
struct Buffer {
    map: *mut c_void,
    map_length: usize,
    page: usize,
    length: usize,
}

impl Buffer {
    /// A buffer in one of the three places that the handler knows.
    fn new(place: usize, length: usize) -> io::Result<Buffer> {
        // SAFETY: a plain question.
        let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) }.max(1) as usize;
        let guard = GUARD_PAGES * page;
        let data = length.max(1).next_multiple_of(page);
        let map_length = data + 2 * guard;
        let flags = libc::MAP_PRIVATE | libc::MAP_ANON;
        // SAFETY: a new mapping, which nothing else knows.
        let map = unsafe { libc::mmap(ptr::null_mut(), map_length, libc::PROT_NONE, flags, -1, 0) };
        if map == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        let mut buffer = Buffer { map, map_length, page, length };
        buffer.protect(libc::PROT_READ | libc::PROT_WRITE)?;
        buffer.slack().fill(SLACK);
        RANGES[place][0].store(map as usize, Ordering::SeqCst);
        RANGES[place][1].store(map as usize + map_length, Ordering::SeqCst);
        Ok(buffer)
    }

    fn make_read_only(&mut self) -> io::Result<()> {
        self.protect(libc::PROT_READ)
    }

    fn protect(&mut self, protection: c_int) -> io::Result<()> {
        let guard = GUARD_PAGES * self.page;
        // SAFETY: the pages of this mapping between its guards; no reference into them is alive.
        let done = unsafe {
            libc::mprotect(self.map.byte_add(guard), self.map_length - 2 * guard, protection)
        };
        if done == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
    }

    fn end(&self) -> *mut u8 {
        // SAFETY: within the mapping.
        unsafe { self.map.byte_add(self.map_length - GUARD_PAGES * self.page).cast() }
    }

    fn start(&self) -> *mut u8 {
        // SAFETY: within the mapping.
        unsafe { self.end().sub(self.length) }
    }

    fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: `length` bytes before the guard, mapped, and borrowed from this buffer alone.
        unsafe { std::slice::from_raw_parts_mut(self.start(), self.length) }
    }

    /// The bytes between the guard in front and the buffer.
    fn slack(&mut self) -> &mut [u8] {
        let length = self.map_length - 2 * GUARD_PAGES * self.page - self.length;
        // SAFETY: these bytes lie between the guard in front and the buffer.
        unsafe { std::slice::from_raw_parts_mut(self.start().sub(length), length) }
    }

    fn is_untouched_before(&mut self) -> bool {
        self.slack().iter().all(|byte| *byte == SLACK)
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: this buffer's own mapping, which nothing refers to any more.
        unsafe { libc::munmap(self.map, self.map_length) };
    }
}

fn overrun_head() -> [u8; 8] {
    let [a, b, c, d] = OVERRUN;
    [a, b, c, d, 0, 0, 0, 0]
}

/// From now on a fault in or beside a buffer is reported as such; any other kills the process as usual.
fn watch_guards(output: c_int) {
    OUTPUT.store(output, Ordering::SeqCst);
    // SAFETY: the handler calls only what may be called in one.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        let handler: extern "C" fn(c_int, *mut libc::siginfo_t, *mut c_void) = on_fault;
        action.sa_sigaction = handler as usize;
        action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
        libc::sigemptyset(&mut action.sa_mask);
        libc::sigaction(libc::SIGSEGV, &action, ptr::null_mut());
        libc::sigaction(libc::SIGBUS, &action, ptr::null_mut());
    }
}

extern "C" fn on_fault(signal: c_int, info: *mut libc::siginfo_t, _: *mut c_void) {
    // SAFETY: with SA_SIGINFO the system passes a valid siginfo; write, _exit and signal may be
    // called in a handler.
    unsafe {
        let address = (*info).si_addr() as usize;
        let is_ours = RANGES.iter().any(|[start, end]| {
            (start.load(Ordering::SeqCst)..end.load(Ordering::SeqCst)).contains(&address)
        });
        if is_ours {
            let head = overrun_head();
            libc::write(OUTPUT.load(Ordering::SeqCst), head.as_ptr().cast(), head.len());
            libc::_exit(1);
        }
        // Back to the default: the faulting instruction runs again, and ends the process.
        libc::signal(signal, libc::SIG_DFL);
    }
}
