//! `linkwork new`

use std::path::{Path, PathBuf};

use clap::Args;
use linkwork::output::complaint::Complaint;

use super::output_files::save;
use super::read::is_stdin;
use super::{Answer, Refusal, shipped};

/// Begin a mechanism file: a copy of an example, with its comments.
///
/// `linkwork examples` lists the examples; they are inside the program.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork new my_linkage\n  \
    linkwork new my_platform --from 3-rps")]
pub struct New {
    /// Name of the mechanism, whose file is NAME.ron; `-` writes to stdout
    name: PathBuf,
    /// Example to begin from: its name, or the beginning of its title; `axes` is a 4-bar by joint coordinates
    #[arg(long, value_name = "EXAMPLE", default_value = "axes")]
    from: String,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
}

impl New {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let example = shipped::find(&self.from)?;
        if is_stdin(&self.name) {
            return Ok(Answer::yes(example.text, String::new()));
        }
        let path = match self.name.extension() {
            Some(ending) if ending == "ron" => self.name.clone(),
            _ => PathBuf::from(format!("{}.ron", self.name.display())),
        };
        if path.exists() && !self.force {
            let title = format!("{} exists", path.display());
            return Err(Complaint::new(title)
                .help("give another name, or --force to replace it")
                .into());
        }
        save(&path, renamed(&example, &path).as_bytes())?;
        let path = path.display();
        Ok(Answer::yes(
            format!(
                "{path}: a copy of {}. `linkwork check {path}` says what it describes, `linkwork view {path}` moves it.\n",
                example.name
            ),
            String::new(),
        ))
    }
}

/// The example under the name of its new file.
fn renamed(example: &shipped::Example, path: &Path) -> String {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let [old, new] = [example.title(), &name].map(|name| format!("name: \"{name}\""));
    match name.contains(['"', '\\']) {
        true => example.text.clone(),
        false => example.text.replacen(&old, &new, 1),
    }
}
