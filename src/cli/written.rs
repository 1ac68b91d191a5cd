//! What is written beside an answer: rows as they come, and pictures.

use std::io::{self, Write};
#[cfg(feature = "plot")]
use std::path::Path;

use super::Refusal;
use super::watched::{interruptions, read_no_more};

/// Whole lines to stdout, as they come.
pub struct Lines {
    wanted: bool,
    waiting: String,
    failed: Option<io::Error>,
}

impl Lines {
    /// Bytes written at once.
    const MANY: usize = 1 << 16;

    pub fn new(wanted: bool) -> Self {
        Lines {
            wanted,
            waiting: String::new(),
            failed: None,
        }
    }

    pub fn add(&mut self, line: &str) {
        if self.wanted {
            if self.waiting.len() + line.len() > Self::MANY {
                self.flush();
            }
            self.waiting.push_str(line);
        }
    }

    fn flush(&mut self) {
        let mut stdout = io::stdout().lock();
        let written = stdout
            .write_all(self.waiting.as_bytes())
            .and_then(|()| stdout.flush());
        self.waiting.clear();
        if let Err(error) = written {
            read_no_more();
            self.failed.get_or_insert(error);
        }
    }

    /// Whether somebody still reads.
    pub fn open(&self) -> bool {
        self.failed.is_none()
    }

    /// A reader who has seen enough, as `head` does, is no error.
    pub fn finish(mut self) -> Result<(), Refusal> {
        self.flush();
        match self.failed {
            Some(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Refusal(format!(
                "error: the rows cannot be written: {error}\n"
            ))),
            _ => Ok(()),
        }
    }
}

/// What is said where an interruption ended the rows before their time.
pub const INTERRUPTED_REMARK: &str = "note: interrupted: the rows end before the answer does\n";

/// All lines of a text to stdout; whether nobody interrupted meanwhile.
pub fn rows<L: AsRef<str>>(all: impl Iterator<Item = L>) -> Result<bool, Refusal> {
    let before = interruptions();
    let mut lines = Lines::new(true);
    for line in all {
        if !lines.open() || interruptions() > before {
            break;
        }
        lines.add(line.as_ref());
    }
    lines.finish()?;
    Ok(interruptions() == before)
}

/// Written beside and then put in its place, so that it is never half written.
#[cfg(feature = "plot")]
pub fn save(path: &Path, picture: &str) -> Result<(), Refusal> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let written = std::fs::write(&beside, picture).and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|error| {
        Refusal(format!(
            "error: {} cannot be written: {error}\n",
            path.display()
        ))
    })
}
