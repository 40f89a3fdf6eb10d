//! A running process, and what goes in and comes out. A command has a pipe each way, each with a thread of
//! its own, so that neither side's full pipe nor its silence stops this program. The host of a library reads
//! a batch whole before it answers, so one socket serves both ways, without threads.

#![forbid(unsafe_code)]

use super::stderr::StderrLines;
use crate::kernel::Failure;
use std::io::{self, ErrorKind, Read, Write};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// A program to start, with its arguments.
#[derive(Clone, Debug)]
pub struct KernelProgram {
    words: Vec<String>,
    /// True if it is this program as the host of a library.
    pub(super) is_host: bool,
    /// The lines that it wrote to standard error.
    pub(super) said: StderrLines,
}

impl KernelProgram {
    /// This program as the host of a library: its words, the program first.
    pub fn host(words: Vec<String>) -> KernelProgram {
        KernelProgram {
            words,
            is_host: true,
            said: StderrLines::default(),
        }
    }

    /// From a line, split as a shell splits it. No shell runs it: variables, pipes and && need
    /// `sh -c '…'`.
    pub fn parse(line: &str) -> Result<KernelProgram, String> {
        let words =
            shlex::split(line).ok_or("a quotation mark or a backslash in it is not closed")?;
        if words.is_empty() {
            Err("it is empty".to_owned())
        } else {
            Ok(KernelProgram {
                words,
                is_host: false,
                said: StderrLines::default(),
            })
        }
    }

    /// Starts it. It is lost when it is silent for this long.
    pub(super) fn start(&self, silence: Duration) -> io::Result<Running> {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]).stderr(Stdio::piped());
        // A group of its own, to be killed with all that it starts.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let (mut child, link) = match self.is_host {
            #[cfg(unix)]
            true => socket(command, silence)?,
            _ => pipes(command)?,
        };
        let (inbox, spare) = (Inbox::default(), Vec::new());
        let words = child.stderr.take().map(|stderr| self.said.pass_on(stderr));
        Ok(Running {
            child,
            link: Some(link),
            silence,
            inbox,
            spare,
            words,
        })
    }
}

/// Starts a process with one socket as its standard input and output.
#[cfg(unix)]
fn socket(mut command: Command, silence: Duration) -> io::Result<(Child, Link)> {
    let (ours, its) = UnixStream::pair()?;
    set_timeouts(&ours, silence)?;
    let ends = [its.try_clone()?, its].map(|end| Stdio::from(std::os::fd::OwnedFd::from(end)));
    let [input, output] = ends;
    Ok((
        command.stdin(input).stdout(output).spawn()?,
        Link::Socket(ours),
    ))
}

#[cfg(unix)]
fn set_timeouts(socket: &UnixStream, silence: Duration) -> io::Result<()> {
    socket.set_read_timeout(Some(silence))?;
    socket.set_write_timeout(Some(silence))
}

/// Starts a process with a pipe each way.
fn pipes(mut command: Command) -> io::Result<(Child, Link)> {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()?;
    let (input, output) = (child.stdin.take(), child.stdout.take());
    let (to, outgoing) = channel::<Vec<u8>>();
    let (arrived, from) = sync_channel::<Vec<u8>>(16);
    let missing = || io::Error::other("no pipe to it");
    let (mut input, mut output) = (input.ok_or_else(missing)?, output.ok_or_else(missing)?);
    // Both end when the process does, or when this side is dropped; nobody waits for them.
    thread::spawn(move || {
        while let Ok(bytes) = outgoing.recv() {
            if input
                .write_all(&bytes)
                .and_then(|()| input.flush())
                .is_err()
            {
                break;
            }
        }
    });
    thread::spawn(move || {
        let mut buffer = vec![0; ROOM];
        while let Ok(count @ 1..) = output.read(&mut buffer) {
            if arrived.send(buffer[..count].to_vec()).is_err() {
                break;
            }
        }
    });
    Ok((child, Link::Pipes { to, from }))
}

/// The way to a process and back.
enum Link {
    Pipes {
        to: Sender<Vec<u8>>,
        from: Receiver<Vec<u8>>,
    },
    #[cfg(unix)]
    Socket(UnixStream),
}

/// A process that was started; dropping it kills it and what it started.
pub(super) struct Running {
    child: Child,
    /// None once its output is closed.
    link: Option<Link>,
    silence: Duration,
    inbox: Inbox,
    /// Memory for what is sent next.
    spare: Vec<u8>,
    /// Gone when all that it wrote to standard error is passed on.
    words: Option<Receiver<()>>,
}

/// The most bytes of a line.
const LONGEST_LINE: usize = 1 << 16;

/// How long a process that closed its output may take to end.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// Why nothing more comes from a process.
#[derive(Debug, PartialEq)]
pub(super) enum Lost {
    /// It died, or was silent for too long.
    Failed(Failure),
    /// Its output is not a valid answer.
    Garbled(String),
}

impl Running {
    /// Memory to write into what is sent next: new memory for each batch costs more than the batch.
    pub fn spare(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.spare)
    }

    /// From now on it is lost when it is silent for this long.
    pub fn wait_at_most(&mut self, silence: Duration) {
        self.silence = silence;
        #[cfg(unix)]
        if let Some(Link::Socket(socket)) = &self.link {
            let _ = set_timeouts(socket, silence);
        }
    }

    /// The bytes that came after those that were taken.
    pub fn unread(&self) -> &[u8] {
        self.inbox.unread()
    }

    /// Hands bytes over to be written; what is left of a dead process shows when reading.
    pub fn send(&mut self, bytes: Vec<u8>) {
        match &mut self.link {
            Some(Link::Pipes { to, .. }) => {
                let _ = to.send(bytes);
            }
            #[cfg(unix)]
            Some(Link::Socket(socket)) => {
                let _ = socket.write_all(&bytes);
                self.spare = bytes;
            }
            None => {}
        }
    }

    /// The next line, without its end.
    pub fn line(&mut self) -> Result<String, Lost> {
        let mut searched = 0;
        loop {
            let unread = self.inbox.unread();
            if let Some(end) = unread[searched..].iter().position(|byte| *byte == b'\n') {
                let line = unread[..searched + end].to_vec();
                self.inbox.take(line.len() + 1);
                let not_text = "it wrote a line that is not UTF-8 (if it answers in the binary encoding, its \
                                hello must say 'encoding binary')";
                return String::from_utf8(line).map_err(|_| Lost::Garbled(not_text.to_owned()));
            }
            searched = unread.len();
            if searched > LONGEST_LINE {
                let message = format!("it wrote more than {LONGEST_LINE} bytes without a newline");
                return Err(Lost::Garbled(message));
            }
            self.receive()?;
        }
    }

    /// The next bytes, this many.
    pub fn bytes(&mut self, count: usize) -> Result<&[u8], Lost> {
        while self.inbox.unread().len() < count {
            self.receive()?;
        }
        Ok(self.inbox.take(count).unwrap_or_default())
    }

    /// True if unexpected output came.
    pub fn has_unread(&mut self) -> bool {
        match &mut self.link {
            Some(Link::Pipes { from, .. }) => {
                from.try_iter().for_each(|more| self.inbox.add(&more));
            }
            #[cfg(unix)]
            Some(Link::Socket(socket)) => {
                // An answer that is asked for comes later, so nothing more than one read is needed.
                let _ = socket
                    .set_nonblocking(true)
                    .and_then(|()| self.inbox.read(socket));
                let _ = socket.set_nonblocking(false);
            }
            None => {}
        }
        !self.inbox.unread().is_empty()
    }

    fn receive(&mut self) -> Result<(), Lost> {
        let received = match &mut self.link {
            Some(Link::Pipes { from, .. }) => match from.recv_timeout(self.silence) {
                Ok(more) => {
                    self.inbox.add(&more);
                    return Ok(());
                }
                Err(RecvTimeoutError::Timeout) => Err(ErrorKind::TimedOut),
                Err(RecvTimeoutError::Disconnected) => Ok(0),
            },
            #[cfg(unix)]
            Some(Link::Socket(socket)) => self.inbox.read(socket).map_err(|error| error.kind()),
            None => Ok(0),
        };
        match received {
            Ok(1..) | Err(ErrorKind::Interrupted) => Ok(()),
            Err(ErrorKind::TimedOut | ErrorKind::WouldBlock) => Err(Lost::Failed(Failure::Timeout)),
            Ok(0) | Err(_) => Err(Lost::Failed(self.end())),
        }
    }

    /// How a process ended whose output is closed.
    fn end(&mut self) -> Failure {
        self.link = None;
        self.status(Instant::now())
            .map_or(Failure::Timeout, failure_of)
    }

    /// How it ended, if it does in its last words' time from the start.
    fn status(&mut self, start: Instant) -> Option<ExitStatus> {
        loop {
            let status = self.child.try_wait().ok()?;
            if status.is_some() || LAST_WORDS <= start.elapsed() {
                return status;
            }
            thread::sleep(Duration::from_millis(1));
        }
    }
}

/// Lets processes end by themselves, whose input ends, and passes on what they still say.
pub(super) fn finish(mut all: Vec<Running>) {
    all.iter_mut().for_each(|running| running.link = None);
    let start = Instant::now();
    for running in &mut all {
        running.status(start);
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        #[cfg(unix)]
        super::host::kill_group(self.child.id());
        let _ = self.child.kill();
        let _ = self.child.wait();
        // A process that left the group may hold the other end.
        let _ = self
            .words
            .take()
            .map(|words| words.recv_timeout(LAST_WORDS));
    }
}

#[cfg(unix)]
fn failure_of(status: ExitStatus) -> Failure {
    use std::os::unix::process::ExitStatusExt;
    let signal = || Failure::Signal(status.signal().unwrap_or_default());
    status.code().map_or_else(signal, Failure::Exit)
}

#[cfg(not(unix))]
fn failure_of(status: ExitStatus) -> Failure {
    Failure::Exit(status.code().unwrap_or_default())
}

/// The most bytes that are read at once.
const ROOM: usize = 1 << 16;

/// Bytes that came from a process and are not taken yet, in memory that is kept: new or cleared memory for each read
/// costs as much as the read.
#[derive(Default)]
struct Inbox {
    /// The first of them came, in order; the rest is room.
    bytes: Vec<u8>,
    came: usize,
    taken: usize,
}

impl Inbox {
    /// The bytes that are not taken yet.
    pub fn unread(&self) -> &[u8] {
        &self.bytes[self.taken..self.came]
    }

    /// The next bytes, if so many are there.
    pub fn take(&mut self, count: usize) -> Option<&[u8]> {
        let start = self.taken;
        let end = start.checked_add(count).filter(|end| *end <= self.came)?;
        self.taken = end;
        Some(&self.bytes[start..end])
    }

    /// Appends bytes.
    pub fn add(&mut self, more: &[u8]) {
        self.make_room(more.len()).copy_from_slice(more);
        self.came += more.len();
    }

    /// Appends what one read gives; how many bytes.
    pub fn read(&mut self, from: &mut impl Read) -> io::Result<usize> {
        let read = from.read(self.make_room(ROOM))?;
        self.came += read;
        Ok(read)
    }

    /// Room behind what came, for so many bytes; what was taken is forgotten.
    fn make_room(&mut self, count: usize) -> &mut [u8] {
        self.bytes.copy_within(self.taken..self.came, 0);
        (self.came, self.taken) = (self.came - self.taken, 0);
        let end = self.came + count;
        if self.bytes.len() < end {
            self.bytes.resize(end, 0);
        }
        &mut self.bytes[self.came..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_line_is_split_as_a_shell_splits_it() {
        let words = |line: &str| KernelProgram::parse(line).map(|program| program.words);
        assert_eq!(words("node  my.js -x").unwrap(), ["node", "my.js", "-x"]);
        assert_eq!(
            words(r#"sh -c 'a "b" \' "c'd" e\ f "" g"h"'i'"#).unwrap(),
            ["sh", "-c", "a \"b\" \\", "c'd", "e f", "", "ghi"]
        );
        assert_eq!(words(" ").unwrap_err(), "it is empty");
        for line in ["sh -c 'x", "sh \"x", "x\\"] {
            let error = words(line).unwrap_err();
            assert_eq!(error, "a quotation mark or a backslash in it is not closed");
        }
    }

    #[test]
    fn bytes_come_out_once_and_in_order() {
        let mut inbox = Inbox::default();
        inbox.add(b"abc");
        assert_eq!(inbox.take(4), None);
        assert_eq!(inbox.take(2), Some(&b"ab"[..]));
        assert_eq!(inbox.read(&mut &b"defg"[..]).unwrap(), 4);
        assert_eq!(inbox.unread(), b"cdefg");
        inbox.add(&[b'x'; 2 * ROOM]);
        assert_eq!(inbox.take(6), Some(&b"cdefgx"[..]));
        assert_eq!(inbox.unread().len(), 2 * ROOM - 1);
        assert_eq!(inbox.take(usize::MAX), None);
    }
}
