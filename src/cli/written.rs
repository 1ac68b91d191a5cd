//! What is written beside an answer: rows as they come, and pictures.

use std::io::{self, Write};
#[cfg(feature = "plot")]
use std::path::Path;

use linkwork::output::csv::{Csv, Record};

use super::Refusal;
use super::watched::{interruptions, read_no_more};

/// Whole lines to stdout, as they come.
pub struct Lines {
    wanted: bool,
    waiting: Vec<u8>,
    failed: Option<io::Error>,
}

impl Lines {
    /// Bytes written at once.
    const MANY: usize = 1 << 16;

    pub fn new(wanted: bool) -> Self {
        Lines {
            wanted,
            waiting: Vec::new(),
            failed: None,
        }
    }

    fn send(&mut self) {
        let mut stdout = io::stdout().lock();
        let written = stdout
            .write_all(&self.waiting)
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
        self.send();
        match self.failed {
            Some(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(unwritten(error)),
            _ => Ok(()),
        }
    }
}

/// Never fails: what goes wrong is told at the end.
impl Write for Lines {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.wanted {
            self.waiting.extend_from_slice(bytes);
            if self.waiting.len() > Self::MANY {
                self.send();
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Rows that cannot be written.
pub fn unwritten(error: io::Error) -> Refusal {
    Refusal(format!("error: the rows cannot be written: {error}\n"))
}

/// What is said where an interruption ended the rows before their time.
pub const INTERRUPTED_REMARK: &str = "note: interrupted: the rows end before the answer does\n";

/// All rows to stdout; whether nobody interrupted meanwhile.
pub fn rows<'a>(
    (columns, all): (Vec<String>, impl Iterator<Item = Record<'a>>),
) -> Result<bool, Refusal> {
    let before = interruptions();
    let mut csv = Csv::new(Lines::new(true), columns).map_err(unwritten)?;
    for row in all {
        if !csv.target().open() || interruptions() > before {
            break;
        }
        csv.row(row).map_err(unwritten)?;
    }
    csv.finish().map_err(unwritten)?.finish()?;
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
