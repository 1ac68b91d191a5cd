//! The file that keeps generic solutions from one run to the next.

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use linkwork::analysis::assemblies::{GenericSolutions, StoredError};
use linkwork::ask;
use linkwork::output::complaint::Complaint;

use super::output_files::{beside, replace};
use super::{Refusal, say};

/// The largest store that is read (bytes): a hundred times that of a thousand solutions of a large mechanism.
const MAX_BYTES: u64 = 1 << 28;

/// An ordinary file with stored solutions, or the place for one.
pub struct FileStore {
    path: PathBuf,
    /// Place of the file itself, links followed.
    place: PathBuf,
    exists: bool,
}

fn another(title: String) -> Refusal {
    let help = "name another file with --store, or leave the option out";
    Complaint::new(title).help(help).into()
}

impl FileStore {
    /// The store at a path, where there is an ordinary file or none yet. Nothing else is opened: reading a pipe waits,
    /// reading a device need not end.
    pub fn at(path: &Path) -> Result<Self, Refusal> {
        let refused = |reason: &dyn Display| {
            let path = path.display();
            another(format!("{path} cannot be a store of solutions: {reason}"))
        };
        let (place, exists) = match fs::metadata(path) {
            Ok(data) if data.is_dir() => return Err(refused(&"it is a folder")),
            Ok(data) if !data.is_file() => return Err(refused(&"it is not a regular file")),
            Ok(data) if data.len() > MAX_BYTES => {
                return Err(refused(&format!(
                    "it has {} MiB, and no store has more than {}",
                    data.len() >> 20,
                    MAX_BYTES >> 20
                )));
            }
            Ok(_) => (fs::canonicalize(path).map_err(|e| refused(&e))?, true),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(refused(&error)),
            Err(_) if path.is_symlink() => return Err(refused(&"it is a link that leads nowhere")),
            Err(_) => (path.to_owned(), false),
        };
        Ok(FileStore {
            path: path.to_owned(),
            place,
            exists,
        })
    }

    /// The stored solutions; nothing if there is no file yet, or an empty one.
    fn read(&self) -> Result<Option<GenericSolutions>, Refusal> {
        if !self.exists {
            return Ok(None);
        }
        let path = self.path.display();
        let mut bytes = Vec::new();
        let file = File::open(&self.place);
        let read = file.and_then(|file| file.take(MAX_BYTES).read_to_end(&mut bytes));
        let unread = |error| format!("the stored solutions in {path} cannot be read: {error}");
        read.map_err(|error| another(unread(error)))?;
        if bytes.is_empty() {
            return Ok(None);
        }
        let stored = String::from_utf8(bytes)
            .map_err(|_| StoredError::SomethingElse)
            .and_then(|text| GenericSolutions::from_text(&text));
        stored.map(Some).map_err(|error| {
            let title = format!("{path} does not hold stored solutions: {error}");
            let anew = "delete the file: they are then searched for anew";
            match error {
                StoredError::SomethingElse => another(title),
                StoredError::OtherVersion | StoredError::Damaged => {
                    Complaint::new(title).help(anew).into()
                }
            }
        })
    }

    /// Refuses a place that cannot be written, before the search rather than after it. Leaves nothing behind.
    fn check_writable(&self) -> Result<(), Refusal> {
        let refused = |reason: &dyn Display| {
            let path = self.path.display();
            another(format!(
                "the solutions cannot be stored in {path}: {reason}"
            ))
        };
        let place = fs::metadata(&self.place).ok().filter(|_| self.exists);
        if place.is_some_and(|data| data.permissions().readonly()) {
            return Err(refused(&"it is write-protected"));
        }
        let beside = beside(&self.place);
        let tried = File::create(&beside).and_then(|_| fs::remove_file(&beside));
        tried.map_err(|error| {
            let folder = beside.parent().unwrap_or(Path::new("."));
            match folder.as_os_str().is_empty() || folder.exists() {
                true => refused(&error),
                false => refused(&"there is no such folder"),
            }
        })
    }
}

impl ask::Store for FileStore {
    fn known(&self) -> Result<Option<GenericSolutions>, String> {
        self.read().map_err(|Refusal(said)| said)
    }

    fn prepare(&self, has_others: bool) -> Result<(), String> {
        self.check_writable().map_err(|Refusal(said)| said)?;
        if has_others {
            say(&format!(
                "note: {} has the solutions of another question and is written anew\n",
                self.path.display()
            ));
        }
        Ok(())
    }

    fn keep(&self, generic: &GenericSolutions) {
        // the answer is not lost with its store
        if let Err(error) = replace(&self.place, generic.to_text().as_bytes()) {
            say(&format!(
                "warning: the solutions could not be stored in {}: {error}\n",
                self.path.display()
            ));
        }
    }
}
