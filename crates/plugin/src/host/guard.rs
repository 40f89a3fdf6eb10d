//! Memory between guard pages: who touches what lies beside it is caught. So is who throws.

use super::super::binary::Before;
use crate::kernel::Failure;
use std::ffi::{c_int, c_void};
use std::io;
use std::ptr;
use std::sync::atomic::{AtomicI32, AtomicUsize, Ordering};

/// Guard pages on each side of a buffer.
const GUARD_PAGES: usize = 16;
/// The byte between the guard in front of a buffer and the buffer.
const SLACK: u8 = 0xa5;

/// How many buffers there are.
const BUFFERS: usize = 5;
/// Where each of them begins and ends, guards included: what the handler looks at.
static RANGES: [[AtomicUsize; 2]; BUFFERS] =
    [const { [const { AtomicUsize::new(0) }; 2] }; BUFFERS];
/// Where the handler writes.
static OUTPUT: AtomicI32 = AtomicI32::new(-1);
/// The [`CurrentException`] of the library's C++ runtime; 0 if it has none.
static CURRENT_EXCEPTION: AtomicUsize = AtomicUsize::new(0);

/// Memory that ends where a guard begins: the first byte past it is a fault.
pub(super) struct Buffer {
    /// Its number among those that the handler knows.
    place: usize,
    map: *mut c_void,
    map_length: usize,
    page: usize,
    length: usize,
}

impl Buffer {
    /// All of them, empty.
    pub fn all() -> io::Result<[Buffer; BUFFERS]> {
        // SAFETY: a plain question.
        let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) }.max(1) as usize;
        let buffers: Vec<Buffer> = (0..BUFFERS)
            .map(|place| Buffer::new(place, page, 0))
            .collect::<io::Result<_>>()?;
        buffers
            .try_into()
            .map_err(|_| io::Error::other("as many as there are places"))
    }

    /// Makes it this long, and writable. What was in it is lost.
    pub fn fit(&mut self, length: usize) -> io::Result<()> {
        if Buffer::map_length(self.page, length) == self.map_length {
            self.length = length;
            self.protect(libc::PROT_READ | libc::PROT_WRITE)?;
            self.slack().fill(SLACK);
        } else {
            *self = Buffer::new(self.place, self.page, length)?;
        }
        Ok(())
    }

    fn map_length(page: usize, length: usize) -> usize {
        length.max(1).next_multiple_of(page) + 2 * GUARD_PAGES * page
    }

    fn new(place: usize, page: usize, length: usize) -> io::Result<Buffer> {
        let map_length = Buffer::map_length(page, length);
        let flags = libc::MAP_PRIVATE | libc::MAP_ANON;
        // SAFETY: a new mapping, which nothing else knows.
        let map = unsafe { libc::mmap(ptr::null_mut(), map_length, libc::PROT_NONE, flags, -1, 0) };
        if map == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        let mut buffer = Buffer {
            place,
            map,
            map_length,
            page,
            length,
        };
        buffer.protect(libc::PROT_READ | libc::PROT_WRITE)?;
        buffer.slack().fill(SLACK);
        RANGES[place][0].store(map as usize, Ordering::SeqCst);
        RANGES[place][1].store(map as usize + map_length, Ordering::SeqCst);
        Ok(buffer)
    }

    pub fn make_read_only(&mut self) -> io::Result<()> {
        self.protect(libc::PROT_READ)
    }

    fn protect(&mut self, protection: c_int) -> io::Result<()> {
        let guard = GUARD_PAGES * self.page;
        // SAFETY: the pages of this mapping between its guards; no reference into them is alive.
        let done = unsafe {
            libc::mprotect(
                self.map.byte_add(guard),
                self.map_length - 2 * guard,
                protection,
            )
        };
        if done == 0 {
            Ok(())
        } else {
            Err(io::Error::last_os_error())
        }
    }

    fn end(&self) -> *mut u8 {
        // SAFETY: within the mapping.
        unsafe {
            self.map
                .byte_add(self.map_length - GUARD_PAGES * self.page)
                .cast()
        }
    }

    pub fn start(&self) -> *mut u8 {
        // SAFETY: within the mapping.
        unsafe { self.end().sub(self.length) }
    }

    pub fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: `length` bytes before the guard, mapped, and borrowed from this buffer alone.
        unsafe { std::slice::from_raw_parts_mut(self.start(), self.length) }
    }

    /// The buffer's contents.
    pub fn as_bytes(&self) -> &[u8] {
        // SAFETY: `length` bytes before the guard, mapped, and borrowed from this buffer.
        unsafe { std::slice::from_raw_parts(self.start(), self.length) }
    }

    /// The bytes between the guard in front and the buffer.
    fn slack(&mut self) -> &mut [u8] {
        let length = self.map_length - 2 * GUARD_PAGES * self.page - self.length;
        // SAFETY: these bytes lie between the guard in front and the buffer.
        unsafe { std::slice::from_raw_parts_mut(self.start().sub(length), length) }
    }

    pub fn is_untouched_before(&mut self) -> bool {
        self.slack().iter().all(|byte| *byte == SLACK)
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: this buffer's own mapping, which nothing refers to any more.
        unsafe { libc::munmap(self.map, self.map_length) };
    }
}

/// The function that gives the type of the exception that is being handled; null if there is none.
pub(super) type CurrentException = unsafe extern "C" fn() -> *const c_void;

/// From now on a fault in or beside a buffer, and an abort because of an exception, are reported as such;
/// any other kills the process as usual.
pub(super) fn watch(output: c_int, exception: Option<CurrentException>) {
    OUTPUT.store(output, Ordering::SeqCst);
    CURRENT_EXCEPTION.store(
        exception.map_or(0, |current| current as usize),
        Ordering::SeqCst,
    );
    // SAFETY: the handler calls only what may be called in one.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        let handler: extern "C" fn(c_int, *mut libc::siginfo_t, *mut c_void) = on_signal;
        action.sa_sigaction = handler as usize;
        action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
        libc::sigemptyset(&mut action.sa_mask);
        for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGABRT] {
            libc::sigaction(signal, &action, ptr::null_mut());
        }
    }
}

extern "C" fn on_signal(signal: c_int, info: *mut libc::siginfo_t, _: *mut c_void) {
    // SAFETY: with SA_SIGINFO the system passes a valid siginfo; write, _exit and signal may be
    // called in a handler, and so may CURRENT_EXCEPTION's function, since abort was called and did not
    // interrupt anything.
    unsafe {
        let failure = if signal == libc::SIGABRT {
            let current = CURRENT_EXCEPTION.load(Ordering::SeqCst);
            let current = std::mem::transmute::<usize, Option<CurrentException>>(current);
            current
                .is_some_and(|current| !current().is_null())
                .then_some(Failure::Exception)
        } else {
            let address = (*info).si_addr() as usize;
            let is_ours = RANGES.iter().any(|[start, end]| {
                (start.load(Ordering::SeqCst)..end.load(Ordering::SeqCst)).contains(&address)
            });
            is_ours.then_some(Failure::Overrun)
        };
        if let Some(failure) = failure {
            let head = Before::Failure(failure).head();
            libc::write(
                OUTPUT.load(Ordering::SeqCst),
                head.as_ptr().cast(),
                head.len(),
            );
            libc::_exit(1);
        }
        // Back to the default: the faulting instruction runs again, and ends the process.
        libc::signal(signal, libc::SIG_DFL);
    }
}
