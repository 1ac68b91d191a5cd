//! The README holds what the program says: every command in it is run, every file in it is read.
//!
//! `UPDATE_README=1 cargo test --test readme` writes what the program says now.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::analysis::frames::{FramesSettings, frames};
use linkwork::description::{AxesDescription, Description, is_mechanism};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn readme() -> String {
    fs::read_to_string(root().join("README.md")).unwrap()
}

/// A fenced block: its language and its lines.
struct Block {
    language: String,
    text: String,
}

fn blocks(readme: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for line in readme.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(language)) => {
                open = Some(Block {
                    language: language.into(),
                    text: String::new(),
                });
            }
            (Some(_), Some("")) => blocks.extend(open.take()),
            (Some(block), _) => block.text += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is not closed");
    blocks
}

fn blocks_in<'a>(blocks: &'a [Block], language: &str) -> Vec<&'a Block> {
    let found: Vec<&Block> = blocks.iter().filter(|b| b.language == language).collect();
    assert!(!found.is_empty(), "no block in {language}");
    found
}

/// What a command line prints, first to stdout, then to stderr.
fn run(command: &str) -> String {
    let arguments = command.strip_prefix("cargo run --release -- ");
    let arguments = arguments.or_else(|| command.strip_prefix("linkwork "));
    let Some(arguments) = arguments else {
        panic!("{command:?} is not a command of linkwork");
    };
    let output = Command::new("sh")
        .args(["-c", &format!("\"$LINKWORK\" {arguments}")])
        .env("LINKWORK", env!("CARGO_BIN_EXE_linkwork"))
        .env("NO_COLOR", "1")
        .current_dir(root())
        .output()
        .unwrap();
    assert!(
        output.status.code().is_some_and(|code| code <= 2),
        "{command}"
    );
    [output.stdout, output.stderr]
        .map(|bytes| String::from_utf8(bytes).unwrap())
        .concat()
}

#[test]
fn commands_print_what_the_readme_shows() {
    let mut readme = readme();
    let mut commands = 0;
    for block in blocks_in(&blocks(&readme), "console") {
        let (command, shown) = block.text.split_once('\n').unwrap();
        let command = command.strip_prefix("$ ").unwrap();
        if command == "cargo test" {
            assert_eq!(shown, "");
            continue;
        }
        commands += 1;
        let printed = run(command);
        if std::env::var_os("UPDATE_README").is_some() {
            readme = readme.replace(
                &format!("```console\n{}```", block.text),
                &format!("```console\n$ {command}\n{printed}```"),
            );
        } else {
            assert_eq!(printed, shown, "of {command}");
        }
    }
    assert!(commands > 5);
    if std::env::var_os("UPDATE_README").is_some() {
        fs::write(root().join("README.md"), readme).unwrap();
    }
}

#[test]
fn the_test_command_is_the_one_that_changes_must_pass() {
    let tests = blocks(&readme())
        .iter()
        .filter(|b| b.text == "$ cargo test\n")
        .count();
    assert_eq!(tests, 1);
    let checks = fs::read_to_string(root().join(".ci/run"));
    // a package has no .ci
    assert!(checks.is_err() || checks.is_ok_and(|text| text.lines().any(|l| l == "cargo test")));
}

#[test]
fn files_in_the_readme_are_read_and_assemble() {
    for block in blocks_in(&blocks(&readme()), "ron") {
        if !is_mechanism(&block.text) {
            let axes = AxesDescription::read(&block.text).unwrap();
            let report = frames(&axes, &FramesSettings::default()).unwrap();
            assert!(report.warnings.is_empty() && report.moved < 1e-12);
            continue;
        }
        let description = Description::read(&block.text).unwrap();
        let mechanism = Mechanism::new(&description).unwrap();
        assert!(
            mechanism.warnings().is_empty(),
            "{:?}",
            mechanism.warnings()
        );
        let report = assemble(
            &Question::new(&mechanism),
            &AssemblySettings::default(),
            &Watch::none(),
        )
        .unwrap();
        assert_eq!(report.outcome, Outcome::Converged);
        let forms =
            linkwork::analysis::compare::compare(&mechanism, &Default::default(), &Watch::none());
        assert!(forms.agree && !forms.closed_forms.is_empty());
    }
}

#[test]
fn files_named_in_the_readme_exist() {
    let readme = readme();
    let words = readme.split(|c: char| c.is_whitespace() || "`()".contains(c));
    let named: Vec<PathBuf> = words
        .filter(|word| word.ends_with(".ron") || word.ends_with(".rs"))
        .map(|word| root().join(word))
        .collect();
    assert!(named.len() > 3);
    for path in named {
        assert!(path.exists(), "{}", path.display());
    }
}
