//! A campaign's directory:
//!
//! - `campaign.json`: what it was begun with; written once;
//! - `finds.jsonl`: one line a find, appended in one write each, and synced to the disk before the
//!   find is reported;
//! - `state.json`: counters and population, written beside and renamed now and then; it may be older
//!   than the finds;
//! - `lock`: one process at a time.

use crate::cli::exit::{Failure, Status};
use crate::cli::output::write_json_lines;
use crate::cli::select::KernelArguments;
use crate::command::named_file::{self, SizeLimit};
use crate::corpus::lines::{self, write_case};
use crate::explore::campaign::{CampaignState, Find};
use crate::files::InputError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The version of the directory's files.
pub const FORMAT: u32 = 1;

/// The file that says what a campaign was begun with.
pub const CAMPAIGN: &str = "campaign.json";

/// The file of the finds.
pub const FINDS: &str = "finds.jsonl";

const STATE: &str = "state.json";

const LOCK: &str = "lock";

/// Why neither a campaign nor triage takes a band.
pub const NO_BAND: &str = "findings are kept and run again without one";

/// The plan that a campaign was begun with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Begun {
    /// The version of these files.
    pub format: u32,
    /// The version of hairline that began it.
    pub version: String,
    /// Which kernels, epsilons and contract.
    pub kernels: KernelArguments,
    /// Which scalars.
    pub scalar: Vec<String>,
    /// Which random cases.
    pub seed: u64,
}

/// An open campaign directory.
pub struct Directory {
    path: PathBuf,
    finds: File,
    /// The length of the finds that are whole.
    length: u64,
    _lock: FolderLock,
}

impl Directory {
    /// Makes the directory, if there is none, and takes its lock.
    pub fn open(path: &str) -> Result<Directory, Failure> {
        let path = PathBuf::from(path);
        fs::create_dir_all(&path).map_err(|error| Failure::of_path(&path, &error))?;
        let files = [CAMPAIGN, FINDS, STATE, LOCK].map(|name| path.join(name));
        files.iter().try_for_each(|file| refuse_link(file))?;
        let lock = FolderLock::take(&path)?;
        let finds_path = path.join(FINDS);
        let finds = File::options().create(true).append(true).open(&finds_path);
        let finds = finds.map_err(|error| Failure::of_path(&finds_path, &error))?;
        Ok(Directory {
            path,
            finds,
            length: 0,
            _lock: lock,
        })
    }

    /// The plan that the campaign was begun with; none for a new one.
    pub fn begun(&self) -> Result<Option<Begun>, Failure> {
        let begun = read_begun(&self.path)?;
        let finds = fs::metadata(self.path.join(FINDS)).map_or(0, |metadata| metadata.len());
        if begun.is_none() && finds > 0 {
            let message =
                format!("{FINDS} is there, but {CAMPAIGN} is not: no campaign of this program");
            return Err(InputError::of(&self.path.display().to_string(), message).into());
        }
        Ok(begun)
    }

    /// Writes what the campaign is begun with.
    pub fn begin(&self, begun: &Begun) -> Result<(), Failure> {
        self.write(CAMPAIGN, begun)
    }

    /// The finds until now, each run again; a last line without its end is cut off.
    pub fn finds(&mut self) -> Result<Vec<Find>, Failure> {
        let path = self.path.join(FINDS);
        let bytes = named_file::read(&path, SizeLimit::CASES)
            .map_err(|error| Failure::of_path(&path, &error))?;
        let whole = bytes
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |end| end + 1);
        let name = path.display().to_string();
        // First read, then cut: a file that is no finds file is left alone.
        let finds = read_finds(&bytes[..whole], &name)?;
        if whole < bytes.len() {
            self.finds
                .set_len(whole as u64)
                .map_err(|error| Failure::of_path(&path, &error))?;
            let cut = bytes.len() - whole;
            eprintln!(
                "{name}: the last line was cut short, as by a kill; its {cut} bytes are removed (that find was not reported)"
            );
        }
        self.length = whole as u64;
        Ok(finds)
    }

    /// Appends finds, each line in one write, and returns once they are on the disk. What a full disk
    /// leaves of a line is taken back.
    pub fn append(&mut self, finds: &[Find]) -> Result<(), Failure> {
        let appended = finds.iter().try_for_each(|find| self.append_line(find));
        let appended = appended.and_then(|()| self.finds.sync_data());
        appended.map_err(|error| {
            let path = self.path.join(FINDS);
            let message = format!("{}: {error}; the finds before are kept", path.display());
            Failure::Message(Status::InputOutput, message)
        })
    }

    fn append_line(&mut self, find: &Find) -> io::Result<()> {
        let line = write_case(&find.stored()) + "\n";
        let short = || io::Error::new(ErrorKind::StorageFull, "the disk took half a line");
        let written = self.finds.write(line.as_bytes());
        let whole = written.and_then(|n| {
            if n == line.len() {
                Ok(())
            } else {
                Err(short())
            }
        });
        match whole {
            Ok(()) => self.length += line.len() as u64,
            Err(_) => self.finds.set_len(self.length)?,
        }
        whole
    }

    /// The counters and the population that were saved last, if any were.
    pub fn state(&self) -> Result<CampaignState, Failure> {
        Ok(read_json(
            &self.path.join(STATE),
            "; without it the campaign begins anew and knows its finds",
        )?
        .unwrap_or_default())
    }

    /// An error about the state.
    pub fn wrong_state(&self, message: String) -> Failure {
        InputError::of(&self.path.join(STATE).display().to_string(), message).into()
    }

    /// Saves counters and population.
    pub fn save(&self, state: &CampaignState) -> Result<(), Failure> {
        self.write(STATE, state)
    }

    fn write(&self, name: &str, value: &impl Serialize) -> Result<(), Failure> {
        write_json_lines(self.path.join(name), std::slice::from_ref(value))
    }
}

/// An error if a file of a campaign leads elsewhere, or is none: a directory that was handed on must not choose what is
/// written to.
fn refuse_link(path: &Path) -> Result<(), Failure> {
    let Ok(metadata) = fs::symlink_metadata(path) else {
        return Ok(());
    };
    match metadata.is_file() {
        true => Ok(()),
        false => {
            let error =
                io::Error::other("no ordinary file: a campaign's files are its own, and no links");
            Err(Failure::of_path(path, &error))
        }
    }
}

/// The plan that the campaign in a directory was begun with; none if there is no campaign.
pub fn read_begun(directory: &Path) -> Result<Option<Begun>, Failure> {
    let path = directory.join(CAMPAIGN);
    // The version first: of another one the other fields may be others.
    let Some(any) = read_json::<serde_json::Value>(&path, "")? else {
        return Ok(None);
    };
    let format = any.get("format").and_then(serde_json::Value::as_u64);
    if let Some(other) = format.filter(|format| *format != u64::from(FORMAT)) {
        let message = format!("is of format {other}; this program reads format {FORMAT}");
        return Err(InputError::of(&path.display().to_string(), message).into());
    }
    read_json(&path, "")
}

/// The finds in a text of whole lines.
pub fn read_finds(text: &[u8], name: &str) -> Result<Vec<Find>, Failure> {
    let finds = lines::read(text, name).map(|stored| {
        let stored = stored?;
        Find::of_stored(&stored).map_err(|message| InputError::at(name, stored.line, message))
    });
    Ok(finds.collect::<Result<_, InputError>>()?)
}

fn read_json<T: DeserializeOwned>(path: &Path, advice: &str) -> Result<Option<T>, Failure> {
    let text = match named_file::read(path, SizeLimit::CASES) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        text => text.map_err(|error| Failure::of_path(path, &error))?,
    };
    let read = serde_json::from_slice(&text);
    let damaged = |error: serde_json::Error| {
        InputError::at(
            &path.display().to_string(),
            error.line(),
            format!("{error}{advice}"),
        )
    };
    Ok(Some(read.map_err(damaged)?))
}

/// The lock of a folder, held until it is dropped.
///
/// The system holds it, on an open file, and releases it when the process ends in whatever way.
/// The file names the process for others to read; it is empty when nobody holds the lock.
struct FolderLock {
    file: File,
}

impl FolderLock {
    /// Takes the lock of a folder, and tells if the last process to hold it was killed.
    fn take(folder: &Path) -> Result<FolderLock, Failure> {
        let path = folder.join(LOCK);
        let failed = |error: io::Error| Failure::of_path(&path, &error);
        let file = File::options()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&path);
        let mut file = file.map_err(failed)?;
        let holder = || fs::read_to_string(&path).unwrap_or_default();
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::Error(error)) => return Err(failed(error)),
            Err(TryLockError::WouldBlock) => {
                let (folder, holder) = (folder.display(), holder());
                let message = format!(
                    "{folder}: another campaign writes here: {}",
                    holder.trim_end()
                );
                return Err(Failure::Message(Status::InputOutput, message));
            }
        }
        if !holder().is_empty() {
            eprintln!(
                "{}: its process is gone; the campaign goes on here",
                path.display()
            );
        }
        let owner = format!("process {} on {}\n", std::process::id(), host());
        let written = file
            .set_len(0)
            .and_then(|()| file.write_all(owner.as_bytes()));
        written.map_err(failed)?;
        Ok(FolderLock { file })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        let _ = self.file.set_len(0);
    }
}

/// The machine's name, where the system tells it in a file.
fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let name = name.trim();
    if name.is_empty() {
        "this machine".to_owned()
    } else {
        name.to_owned()
    }
}
