//! `linkwork view`

use std::path::PathBuf;

use clap::Args;
use linkwork::output::complaint::Complaint;
use linkwork::view::{Viewed, page};

use super::live_server::serve;
use super::output_files::{file, save};
use super::source::{Assignment, Source};
use super::{Answer, Refusal};

/// Write a page in which the mechanism can be moved, with the solver inside.
///
/// The page is one file. It opens in any browser, offline, and loads nothing: the mechanism follows the held
/// coordinates on its branch, as in the other commands, and stops at dead points. Without a file the page is a gallery of mechanisms.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork view mechanisms/four_bar.ron\n  \
    linkwork view mechanisms/three_rps.ron --set b=1.2 -o three_rps.html\n  \
    linkwork view mechanisms/four_bar.ron --watch")]
pub struct View {
    /// The mechanism file: tables, or joint coordinates; `-` reads standard input; without one the page is a gallery
    file: Option<PathBuf>,
    /// Give a parameter another value: a number or an expression as in the file, e.g. --set l2="3.5 m"
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<Assignment>,
    /// File to write the page to [default: beside the mechanism file, or linkwork.html without one]
    #[arg(short, long, value_name = "FILE", value_parser = file(&["html", "htm"]))]
    output: Option<PathBuf>,
    /// Serve the page to this machine only, and reload the file whenever it is saved, until Ctrl-C
    #[arg(long, conflicts_with = "output")]
    watch: bool,
}

impl View {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let source = (self.file.clone()).map(|file| Source::new(file, self.set.clone()));
        let (viewed, beside, warnings) = match &source {
            Some(source) if self.watch => return serve(source),
            Some(source) => {
                let loaded = source.load()?;
                let viewed = source.viewed()?;
                (viewed, source.beside("html"), loaded.warnings())
            }
            None if self.watch => return Err(nameless("there is no file to watch")),
            None if !self.set.is_empty() => {
                return Err(nameless("a gallery has no parameters to set"));
            }
            None => (Viewed::default(), "linkwork.html".into(), String::new()),
        };
        let path = self.output.as_ref().unwrap_or(&beside);
        save(path, page(&viewed).as_bytes())?;
        let data = format!("{}: open it in a browser.\n", path.display());
        Ok(Answer::yes(data, warnings))
    }
}

/// Error where a mechanism file is needed and none is named.
fn nameless(why: &str) -> Refusal {
    Complaint::new(why)
        .help("name the mechanism file: `linkwork view FILE …`")
        .into()
}
