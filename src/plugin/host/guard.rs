//! Memory between guard pages: who touches what lies beside it is caught.

use super::super::binary::OVERRUN;
use std::ffi::{c_int, c_void};
use std::io;
use std::ptr;
use std::sync::atomic::{AtomicI32, AtomicUsize, Ordering};

/// Guard pages on each side of a buffer.
const GUARD_PAGES: usize = 16;
/// What stands between the guard in front of a buffer and the buffer.
const SLACK: u8 = 0xa5;

/// Where each of the three buffers begins and ends, guards included: what the handler looks at.
static RANGES: [[AtomicUsize; 2]; 3] = [const { [const { AtomicUsize::new(0) }; 2] }; 3];
/// Where the handler writes.
static OUTPUT: AtomicI32 = AtomicI32::new(-1);

/// Memory that ends where a guard begins: the first byte past it is a fault.
pub(super) struct Buffer {
    map: *mut c_void,
    map_length: usize,
    page: usize,
    length: usize,
}

impl Buffer {
    /// A buffer in one of the three places that the handler knows.
    pub fn new(place: usize, length: usize) -> io::Result<Buffer> {
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

    pub fn make_read_only(&mut self) -> io::Result<()> {
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

    pub fn start(&self) -> *mut u8 {
        // SAFETY: within the mapping.
        unsafe { self.end().sub(self.length) }
    }

    pub fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: `length` bytes before the guard, mapped, and borrowed from this buffer alone.
        unsafe { std::slice::from_raw_parts_mut(self.start(), self.length) }
    }

    /// What is in it.
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

pub(super) fn overrun_head() -> [u8; 8] {
    let [a, b, c, d] = OVERRUN;
    [a, b, c, d, 0, 0, 0, 0]
}

/// From now on a fault in or beside a buffer is reported as such; any other kills the process as usual.
pub(super) fn watch_guards(output: c_int) {
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
