//! `linkwork setup`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use clap_complete::{Shell, generate};
use linkwork::output::complaint::Complaint;

use super::output_files::save;
use super::{Answer, Refusal, command};

/// Install the completions of shells and the manual for this user.
///
/// Completions for bash, zsh, fish and PowerShell, and a manual page for each command, are written below the folder in
/// which these programs look for what a user installs. Nothing else is changed.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork setup\n  \
    linkwork setup --print zsh > _linkwork")]
pub struct Setup {
    /// Folder to write below [default: XDG_DATA_HOME, or else ~/.local/share]
    #[arg(long, value_name = "DIR")]
    to: Option<PathBuf>,
    /// Print the completions of one shell instead
    #[arg(long, value_name = "SHELL", conflicts_with = "to", value_enum)]
    print: Option<Shell>,
}

/// Places of completions below the folder.
const PLACES: [(Shell, &str); 4] = [
    (Shell::Bash, "bash-completion/completions/linkwork"),
    (Shell::Zsh, "zsh/site-functions/_linkwork"),
    (Shell::Fish, "fish/vendor_completions.d/linkwork.fish"),
    (Shell::PowerShell, "powershell/linkwork.ps1"),
];

impl Setup {
    pub fn run(&self) -> Result<Answer, Refusal> {
        if let Some(shell) = self.print {
            return Ok(Answer::yes(completions(shell), String::new()));
        }
        let folder = self.to.clone().or_else(own).ok_or_else(|| {
            Refusal::from(Complaint::new("there is no home folder").help("give --to DIR"))
        })?;
        let mut said = String::new();
        for (shell, place) in PLACES {
            let path = folder.join(place);
            put(&path, completions(shell).as_bytes())?;
            let needs = match shell {
                Shell::Zsh => ", if the folder is in `fpath` before `compinit` in ~/.zshrc",
                Shell::PowerShell => ", if $PROFILE runs it: `. FILE`",
                _ => "",
            };
            let shell = shell.to_possible_value();
            let shell = shell.as_ref().map_or("", |shell| shell.get_name());
            said += &format!("{}: completions of {shell}{needs}\n", path.display());
        }
        let pages = folder.join("man/man1");
        make(&pages)?;
        clap_mangen::generate_to(command().disable_help_subcommand(true), &pages)
            .map_err(|error| Refusal::error(format!("the manual cannot be written: {error}")))?;
        let pages = pages.display();
        said += &format!("{pages}: a manual page for each command: `man linkwork-check`\n");
        Ok(Answer::yes(said, String::new()))
    }
}

/// Folder of what this user installs.
fn own() -> Option<PathBuf> {
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let home = || set("HOME").or_else(|| set("USERPROFILE"));
    set("XDG_DATA_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(PathBuf::from(home()?).join(".local/share")))
}

fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    generate(shell, &mut command(), "linkwork", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), Refusal> {
    make(path.parent().unwrap_or(Path::new(".")))?;
    save(path, bytes)
}

fn make(folder: &Path) -> Result<(), Refusal> {
    let said = |error| format!("{} cannot be made: {error}", folder.display());
    std::fs::create_dir_all(folder).map_err(|error| Refusal::error(said(error)))
}
