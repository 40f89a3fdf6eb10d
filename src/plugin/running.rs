//! A running process: what goes in and comes out, each with its own thread, so that neither side's
//! full pipe nor its silence stops this program.

#![forbid(unsafe_code)]

use crate::kernel::Failure;
use std::io::{self, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// What to start: a program with its arguments.
#[derive(Clone, Debug)]
pub struct Program {
    words: Vec<String>,
}

impl Program {
    /// From its words, the program first.
    pub fn new(words: Vec<String>) -> Program {
        Program { words }
    }

    /// From a line, split as a shell splits it. No shell runs it: variables, pipes and && need
    /// `sh -c '…'`.
    pub fn parse(line: &str) -> Result<Program, String> {
        let words =
            shlex::split(line).ok_or("a quotation mark or a backslash in it is not closed")?;
        if words.is_empty() { Err("it is empty".to_owned()) } else { Ok(Program { words }) }
    }

    /// Starts it; its standard error is this program's.
    pub(super) fn start(&self) -> io::Result<Running> {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]);
        // A group of its own, to be killed with all that it starts.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
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
            let mut buffer = vec![0; 1 << 16];
            while let Ok(count @ 1..) = output.read(&mut buffer) {
                if arrived.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        Ok(Running { child, to: Some(to), from, unread: Vec::new() })
    }
}

/// A process that was started; dropping it kills it and what it started.
pub(super) struct Running {
    child: Child,
    to: Option<Sender<Vec<u8>>>,
    from: Receiver<Vec<u8>>,
    unread: Vec<u8>,
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
    /// What it wrote is not a valid answer.
    Garbled(String),
}

impl Running {
    /// Hands bytes over to be written; what is left of a dead process shows when reading.
    pub fn send(&self, bytes: Vec<u8>) {
        if let Some(to) = &self.to {
            let _ = to.send(bytes);
        }
    }

    /// The next line, without its end.
    pub fn line(&mut self, silence: Duration) -> Result<String, Lost> {
        let mut searched = 0;
        loop {
            if let Some(end) = self.unread[searched..].iter().position(|byte| *byte == b'\n') {
                let rest = self.unread.split_off(searched + end + 1);
                let mut line = std::mem::replace(&mut self.unread, rest);
                line.truncate(searched + end);
                return String::from_utf8(line)
                    .map_err(|_| Lost::Garbled("it wrote a line that is not UTF-8".to_owned()));
            }
            searched = self.unread.len();
            if searched > LONGEST_LINE {
                let message = format!("it wrote more than {LONGEST_LINE} bytes without a newline");
                return Err(Lost::Garbled(message));
            }
            self.receive(silence)?;
        }
    }

    /// The next bytes, this many.
    pub fn bytes(&mut self, count: usize, silence: Duration) -> Result<Vec<u8>, Lost> {
        while self.unread.len() < count {
            self.receive(silence)?;
        }
        let rest = self.unread.split_off(count);
        Ok(std::mem::replace(&mut self.unread, rest))
    }

    /// Whether unexpected output came.
    pub fn has_unread(&mut self) -> bool {
        while let Ok(more) = self.from.try_recv() {
            self.unread.extend(more);
        }
        !self.unread.is_empty()
    }

    fn receive(&mut self, silence: Duration) -> Result<(), Lost> {
        match self.from.recv_timeout(silence) {
            Ok(more) => {
                self.unread.extend(more);
                Ok(())
            }
            Err(RecvTimeoutError::Timeout) => Err(Lost::Failed(Failure::Timeout)),
            Err(RecvTimeoutError::Disconnected) => Err(Lost::Failed(self.end())),
        }
    }

    /// How a process ended whose output is closed.
    fn end(&mut self) -> Failure {
        self.to = None;
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
