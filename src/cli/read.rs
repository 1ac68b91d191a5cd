//! Files to read: standard input where one is named `-`, and what was meant by a name that is not there.

use std::io::{self, ErrorKind};
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use linkwork::description::{LoadError, load_text_within, nearest, text_from};

use super::shipped;

/// The path that errors give: `-` is standard input.
pub fn called(path: &Path) -> PathBuf {
    match is_stdin(path) {
        true => "standard input".into(),
        false => path.to_owned(),
    }
}

pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// The text of a file, or of standard input, which is read once and kept for who asks again.
pub fn text(path: &Path, limit: u64) -> Result<String, LoadError> {
    static READ: Mutex<Option<String>> = Mutex::new(None);
    if !is_stdin(path) {
        return load_text_within(path, limit);
    }
    let mut read = READ.lock().unwrap_or_else(|broken| broken.into_inner());
    if read.is_none() {
        *read = Some(text_from(io::stdin().lock(), &called(path), limit)?);
    }
    Ok(read.clone().unwrap_or_default())
}

/// Help where a file is not there: one with a similar name, or a shipped one.
pub fn help(error: &LoadError) -> Option<String> {
    let LoadError::Unreadable { path, error } = error else {
        return None;
    };
    if error.kind() != ErrorKind::NotFound {
        return None;
    }
    if let Some(meant) = neighbour(path) {
        return Some(format!("did you mean `{}`?", meant.display()));
    }
    let name = path.file_stem()?.to_str()?;
    let shipped = shipped::find(name).ok()?.name;
    Some(format!(
        "`linkwork new {name} --from {shipped}` writes the example of that name"
    ))
}

/// The path with each part that is not there replaced by one that is and has a similar name.
fn neighbour(path: &Path) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    for part in path.components() {
        let there = found.join(part);
        if there.exists() || !matches!(part, Component::Normal(_)) {
            found = there;
            continue;
        }
        let with_ending = there.with_extension("ron");
        if with_ending.exists() {
            found = with_ending;
            continue;
        }
        let folder = match found.as_os_str().is_empty() {
            true => Path::new("."),
            false => &found,
        };
        let entries = folder.read_dir().ok()?.take(10_000).flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut names: Vec<String> = names.collect();
        names.sort();
        let wanted = part.as_os_str().to_str()?;
        let stem = |name: &str| name.strip_suffix(".ron").map(str::to_owned);
        let near = nearest(wanted, names.iter().map(String::as_str)).map(str::to_owned);
        let near = near.or_else(|| {
            let stems: Vec<String> = names.iter().filter_map(|name| stem(name)).collect();
            Some(nearest(wanted, stems.iter().map(String::as_str))?.to_owned() + ".ron")
        });
        found.push(near?);
    }
    Some(found)
}
