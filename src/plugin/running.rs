//! A running process, and what goes in and comes out. A command has a pipe each way, each with a thread of
//! its own, so that neither side's full pipe nor its silence stops this program. The host of a library reads
//! a batch whole before it answers, so one socket serves both ways, without threads.

#![forbid(unsafe_code)]

use crate::kernel::Failure;
use std::io::{self, ErrorKind, Read, Write};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// What to start: a program with its arguments.
#[derive(Clone, Debug)]
pub struct Program {
    words: Vec<String>,
    /// Whether it is this program as the host of a library.
    is_host: bool,
}

impl Program {
    /// This program as the host of a library: its words, the program first.
    pub fn host(words: Vec<String>) -> Program {
        Program { words, is_host: true }
    }

    /// From a line, split as a shell splits it. No shell runs it: variables, pipes and && need
    /// `sh -c '…'`.
    pub fn parse(line: &str) -> Result<Program, String> {
        let words =
            shlex::split(line).ok_or("a quotation mark or a backslash in it is not closed")?;
        if words.is_empty() {
            Err("it is empty".to_owned())
        } else {
            Ok(Program { words, is_host: false })
        }
    }

    /// Starts it; its standard error is this program's, if it may be loud. It is lost when it is silent for this long.
    pub(super) fn start(&self, silence: Duration, is_loud: bool) -> io::Result<Running> {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]);
        if !is_loud {
            command.stderr(Stdio::null());
        }
        // A group of its own, to be killed with all that it starts.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let (child, link) = match self.is_host {
            #[cfg(unix)]
            true => socket(command, silence)?,
            _ => pipes(command)?,
        };
        let (received, spare) = (Vec::new(), Vec::new());
        Ok(Running { child, link: Some(link), silence, received, taken: 0, spare })
    }
}

/// Starts a process with one socket as its standard input and output.
#[cfg(unix)]
fn socket(mut command: Command, silence: Duration) -> io::Result<(Child, Link)> {
    let (ours, its) = UnixStream::pair()?;
    ours.set_read_timeout(Some(silence))?;
    ours.set_write_timeout(Some(silence))?;
    let ends = [its.try_clone()?, its].map(|end| Stdio::from(std::os::fd::OwnedFd::from(end)));
    let [input, output] = ends;
    Ok((command.stdin(input).stdout(output).spawn()?, Link::Socket(ours)))
}

/// Starts a process with a pipe each way.
fn pipes(mut command: Command) -> io::Result<(Child, Link)> {
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
    let (input, output) = (child.stdin.take(), child.stdout.take());
    let (to, outgoing) = channel::<Vec<u8>>();
    let (arrived, from) = sync_channel::<Vec<u8>>(16);
    let missing = || io::Error::other("no pipe to it");
    let (mut input, mut output) = (input.ok_or_else(missing)?, output.ok_or_else(missing)?);
    // Both end when the process does, or when this side is dropped; nobody waits for them.
    thread::spawn(move || {
        while let Ok(bytes) = outgoing.recv() {
            if input.write_all(&bytes).and_then(|()| input.flush()).is_err() {
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
    /// What came, of which this much is taken.
    received: Vec<u8>,
    taken: usize,
    /// Memory for what is sent next.
    spare: Vec<u8>,
}

/// The most bytes that are read at once.
const ROOM: usize = 1 << 16;

/// The most bytes of a line.
const LONGEST_LINE: usize = 1 << 16;

/// How long a process that closed its output may take to end.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// Why nothing more comes from a process.
#[derive(Debug, PartialEq)]
pub(super) enum Lost {
    /// It died, or was silent for too long.
    Failed(Failure),
    /// What it wrote is not a valid answer.
    Garbled(String),
}

impl Running {
    /// Memory to write into what is sent next: new memory for each batch costs more than the batch.
    pub fn spare(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.spare)
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
            let unread = &self.received[self.taken..];
            if let Some(end) = unread[searched..].iter().position(|byte| *byte == b'\n') {
                let line = unread[..searched + end].to_vec();
                self.taken += line.len() + 1;
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
        while self.received.len() - self.taken < count {
            self.receive()?;
        }
        let start = self.taken;
        self.taken += count;
        Ok(&self.received[start..self.taken])
    }

    /// Whether unexpected output came.
    pub fn has_unread(&mut self) -> bool {
        match &mut self.link {
            Some(Link::Pipes { from, .. }) => self.received.extend(from.try_iter().flatten()),
            #[cfg(unix)]
            Some(Link::Socket(socket)) => {
                // An answer that is asked for comes later, so nothing more than one read is needed.
                let _ = socket
                    .set_nonblocking(true)
                    .and_then(|()| read_some(socket, &mut self.received));
                let _ = socket.set_nonblocking(false);
            }
            None => {}
        }
        self.taken < self.received.len()
    }

    fn receive(&mut self) -> Result<(), Lost> {
        self.received.drain(..self.taken);
        self.taken = 0;
        let received = match &mut self.link {
            Some(Link::Pipes { from, .. }) => match from.recv_timeout(self.silence) {
                Ok(more) => {
                    self.received.extend(more);
                    return Ok(());
                }
                Err(RecvTimeoutError::Timeout) => Err(ErrorKind::TimedOut),
                Err(RecvTimeoutError::Disconnected) => Ok(0),
            },
            #[cfg(unix)]
            Some(Link::Socket(socket)) => {
                read_some(socket, &mut self.received).map_err(|error| error.kind())
            }
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
        let start = Instant::now();
        while start.elapsed() < LAST_WORDS {
            match self.child.try_wait() {
                Ok(Some(status)) => return failure_of(status),
                Ok(None) => thread::sleep(Duration::from_millis(1)),
                Err(_) => break,
            }
        }
        Failure::Timeout
    }
}

/// Appends what one read gives; how many bytes.
#[cfg(unix)]
fn read_some(from: &mut impl Read, bytes: &mut Vec<u8>) -> io::Result<usize> {
    let start = bytes.len();
    bytes.resize(start + ROOM, 0);
    let read = from.read(&mut bytes[start..]);
    bytes.truncate(start + *read.as_ref().unwrap_or(&0));
    read
}

impl Drop for Running {
    fn drop(&mut self) {
        #[cfg(unix)]
        super::host::kill_group(self.child.id());
        let _ = self.child.kill();
        let _ = self.child.wait();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_line_is_split_as_a_shell_splits_it() {
        let words = |line: &str| Program::parse(line).map(|program| program.words);
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
}
