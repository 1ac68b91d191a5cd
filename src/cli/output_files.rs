//! Output beside an answer: rows as they come, and pictures.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};
use linkwork::output::Rows;
use linkwork::output::csv::Csv;

use super::Refusal;
use super::progress::{cuts_short, interruptions, read_no_more};

/// Whole lines to stdout, as they come.
pub struct StdoutLines {
    wanted: bool,
    waiting: Vec<u8>,
    failed: Option<io::Error>,
}

impl StdoutLines {
    const MANY: usize = 1 << 16;

    pub fn new(wanted: bool) -> Self {
        StdoutLines {
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

    /// True while there is a reader.
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

/// Never fails: what goes wrong is reported at the end.
impl Write for StdoutLines {
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

pub fn unwritten(error: io::Error) -> Refusal {
    Refusal::error(format!("the rows cannot be written: {error}"))
}

/// All rows to stdout; whether nobody interrupted before the last.
pub fn rows(all: Rows) -> Result<bool, Refusal> {
    let before = interruptions();
    let mut csv = Csv::new(StdoutLines::new(true), all.columns).map_err(unwritten)?;
    let mut whole = true;
    for row in all.rows {
        whole = !cuts_short(before);
        if !whole || !csv.target().open() {
            break;
        }
        csv.row(row).map_err(unwritten)?;
    }
    csv.finish().map_err(unwritten)?.finish()?;
    Ok(whole)
}

/// Endings of files that tell what is in them.
const ENDINGS: [&str; 33] = [
    "svg", "png", "gif", "glb", "html", "htm", "csv", "json", "md", "ron", "urdf", "xml", "mjcf",
    "sdf", "c", "h", "rs", "py", "js", "tex", "txt", "jpg", "jpeg", "webp", "apng", "bmp", "tif",
    "tiff", "pdf", "eps", "mp4", "gltf", "stl",
];

/// Refuses a file whose ending says that something else is in it than what is written there.
pub fn fits(path: &Path, own: &[&str]) -> Result<(), String> {
    let ending = path
        .extension()
        .map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some(ending) if ENDINGS.contains(&ending) && !own.contains(&ending) => Err(format!(
            "the name ends in `.{ending}`, and no such file is written: end it in `.{}`",
            own[0]
        )),
        _ => Ok(()),
    }
}

/// A file to write, whose ending fits.
pub fn file(own: &'static [&'static str]) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path: PathBuf| fits(&path, own).map(|()| path))
}

/// A file beside another, of this process alone.
pub fn beside(path: &Path) -> PathBuf {
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.part", std::process::id()));
    beside.into()
}

/// Writes beside a file and then puts it in its place, so that it is never half written.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = beside(path);
    let written = File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()?;
        std::fs::rename(&beside, path)
    });
    if written.is_err() {
        // perhaps it was never made
        let _ = std::fs::remove_file(&beside);
    }
    written
}

/// Saves a file without which there is no answer. A place that exists and is no ordinary file, such as a device, is
/// written to.
pub fn save(path: &Path, bytes: &[u8]) -> Result<(), Refusal> {
    let written = match std::fs::metadata(path) {
        Ok(there) if !there.is_file() => std::fs::write(path, bytes),
        _ => replace(path, bytes),
    };
    let said = |error| format!("{} cannot be written: {error}", path.display());
    written.map_err(|error| Refusal::error(said(error)))
}

/// The text for stdout: all of it, or nothing if it is written to a file.
pub fn written(text: String, file: Option<&Path>) -> Result<String, Refusal> {
    let Some(path) = file else {
        return Ok(text);
    };
    save(path, text.as_bytes())?;
    Ok(String::new())
}
