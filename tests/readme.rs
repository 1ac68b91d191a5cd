//! The README and the guide show what the program prints: every command on these pages is run, every file is read.
//!
//! `UPDATE_README=1 cargo test --test readme` writes the output and the pictures of the present program to the pages. Of
//! a long output a page shows the first lines and the last; a line `…` stands for those between, and an update keeps how
//! many there are. A command without output on the page is run and must succeed.

use std::fs;
use std::path::Path;
use std::process::Command;

use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::analysis::frames::{FramesSettings, frames};
use linkwork::description::{AxesDescription, Description, is_mechanism};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

/// The line that stands for those left out.
const LEFT_OUT: &str = "…";
/// Where the pages' pictures are, and those of the guide.
const GUIDE: &str = "src/guide/";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(page: &str) -> String {
    fs::read_to_string(root().join(page)).unwrap()
}

/// The README, then the pages of the guide, by their paths.
fn pages() -> Vec<String> {
    let entries = fs::read_dir(root().join(GUIDE)).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut pages: Vec<String> = names
        .filter(|name| name.ends_with(".md"))
        .map(|name| format!("{GUIDE}{name}"))
        .collect();
    pages.sort();
    pages.insert(0, "README.md".into());
    pages
}

/// A fenced block: its language and its lines.
struct Block {
    language: String,
    text: String,
}

fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for line in page.lines() {
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

fn blocks_in<'a>(blocks: &'a [Block], language: &'a str) -> impl Iterator<Item = &'a Block> {
    blocks.iter().filter(move |b| b.language == language)
}

/// The commands of a block with the lines shown below each.
fn commands(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut commands: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("$ "), commands.last_mut()) {
            (Some(command), _) => commands.push((command, Vec::new())),
            (None, Some((_, shown))) => shown.push(line),
            (None, None) => panic!("{line:?} is no output of a command"),
        }
    }
    commands
}

/// What a command line prints, first to stdout, then to stderr.
fn run(command: &str) -> String {
    let arguments = command.strip_prefix("cargo run --release -- ");
    let arguments = arguments.or_else(|| command.strip_prefix("linkwork "));
    let Some(arguments) = arguments else {
        panic!("{command:?} is not a command of linkwork");
    };
    let program = Path::new(env!("CARGO_BIN_EXE_linkwork"));
    let path = std::env::var("PATH").unwrap_or_default();
    let beside = program.parent().unwrap().display();
    let output = Command::new("sh")
        .args(["-c", &format!("\"$LINKWORK\" {arguments}")])
        .env("PATH", format!("{beside}:{path}"))
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

/// The lines of `printed` that a page shows which has shown `before`: none, all, or as many first and last ones.
fn shortened<'a>(printed: &'a str, before: &[&str]) -> Vec<&'a str> {
    let lines: Vec<&str> = printed.lines().collect();
    let left_out: Vec<usize> = (0..before.len())
        .filter(|&line| before[line] == LEFT_OUT)
        .collect();
    match left_out[..] {
        [first] if lines.len() > before.len() => {
            let last = lines.len() - (before.len() - first - 1);
            [&lines[..first], &[LEFT_OUT], &lines[last..]].concat()
        }
        [] if before.is_empty() => Vec::new(),
        [] | [_] => lines,
        _ => panic!("more than one `{LEFT_OUT}` in an output"),
    }
}

/// The files on the pages that a command draws.
fn pictures(command: &str) -> Vec<&str> {
    let words: Vec<&str> = command.split(' ').collect();
    let options = ["--svg", "--png", "--animate", "--glb"];
    let given = words.windows(2).filter(|pair| options.contains(&pair[0]));
    let paths = given.map(|pair| pair[1]);
    paths.filter(|path| path.starts_with(GUIDE)).collect()
}

/// Whether two files show the same: text to the letter, painted pictures in their size and in being more than paper.
fn same_picture(path: &str, drawn: &Path) -> bool {
    let [shown, drawn] = [&root().join(path), drawn].map(|path| fs::read(path).unwrap());
    match path.rsplit('.').next() {
        Some("png") => {
            let [shown, drawn] = [shown, drawn].map(|bytes| {
                let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
                let mut reader = decoder.read_info().unwrap();
                let mut dots = vec![0; reader.output_buffer_size().unwrap()];
                let info = reader.next_frame(&mut dots).unwrap();
                let inked = dots.iter().filter(|part| **part < 200).count();
                (info.width, info.height, inked > dots.len() / 200)
            });
            shown == drawn && shown.2
        }
        Some("gif") => {
            let [shown, drawn] = [shown, drawn].map(|bytes| {
                let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
                let mut frames = 0;
                while let Some(frame) = decoder.read_next_frame().unwrap() {
                    let first = frame.buffer[0];
                    let inked = frame.buffer.iter().filter(|dot| **dot != first).count();
                    frames += usize::from(inked > frame.buffer.len() / 200);
                }
                (decoder.width(), decoder.height(), frames)
            });
            shown == drawn && shown.2 > 1
        }
        _ => shown == drawn,
    }
}

#[test]
fn commands_print_what_the_pages_show() {
    let update = std::env::var_os("UPDATE_README").is_some();
    let drawn = tempfile::tempdir().unwrap();
    // where the pages write what is not kept
    fs::create_dir_all(root().join("target")).unwrap();
    let mut count = 0;
    for name in pages() {
        let mut page = read(&name);
        for block in blocks_in(&blocks(&page), "console") {
            let mut text = String::new();
            for (command, shown) in commands(&block.text) {
                text += &format!("$ {command}\n");
                if command == "cargo test" {
                    continue;
                }
                count += 1;
                let pictures = if update {
                    Vec::new()
                } else {
                    pictures(command)
                };
                let there = |path: &str| drawn.path().join(Path::new(path).file_name().unwrap());
                let replaced = pictures.iter().fold(command.to_owned(), |command, path| {
                    command.replace(path, there(path).to_str().unwrap())
                });
                let printed = run(&replaced);
                let shortened = shortened(&printed, &shown);
                text.extend(shortened.iter().map(|line| format!("{line}\n")));
                if !update {
                    assert_eq!(shown, shortened, "{name}: {command}");
                }
                for path in pictures {
                    let same = same_picture(path, &there(path));
                    assert!(same, "{command} draws another picture");
                }
            }
            let fenced = |text: &str| format!("```console\n{text}```");
            page = page.replace(&fenced(&block.text), &fenced(&text));
        }
        if update {
            fs::write(root().join(&name), page).unwrap();
        }
    }
    assert!(count > 40);
}

#[test]
fn the_test_command_is_the_one_that_changes_must_pass() {
    let tests = blocks(&read("README.md"))
        .iter()
        .filter(|b| b.text == "$ cargo test\n")
        .count();
    assert_eq!(tests, 1);
    let checks = fs::read_to_string(root().join(".ci/run"));
    // a package has no .ci
    assert!(checks.is_err() || checks.is_ok_and(|text| text.lines().any(|l| l == "cargo test")));
}

#[test]
fn files_on_the_pages_are_read_and_assemble() {
    let mut count = 0;
    for name in pages() {
        for block in blocks_in(&blocks(&read(&name)), "ron") {
            count += 1;
            if !is_mechanism(&block.text) {
                let axes = AxesDescription::read(&block.text).unwrap();
                let report = frames(&axes, &FramesSettings::default()).unwrap();
                assert!(report.warnings.is_empty() && report.moved < 1e-12);
                continue;
            }
            let description = Description::read(&block.text).unwrap();
            let mechanism = Mechanism::new(&description).unwrap();
            let warnings = mechanism.warnings();
            assert!(warnings.is_empty(), "{name}: {warnings:?}");
            let question = Question::new(&mechanism);
            let report = assemble(&question, &AssemblySettings::default(), &Watch::none()).unwrap();
            assert_eq!(report.outcome, Outcome::Converged);
            let forms = linkwork::analysis::compare::compare(
                &mechanism,
                &Default::default(),
                &Watch::none(),
            );
            assert!(forms.agree && !forms.closed_forms.is_empty());
        }
    }
    assert!(count >= 2);
}

#[test]
fn files_named_on_the_pages_exist() {
    let ends = [".ron", ".rs", ".md", ".svg", ".png", ".gif", ".urdf"];
    for name in pages() {
        let page = read(&name);
        let words = page.split(|c: char| c.is_whitespace() || "`()[],".contains(c));
        let named = words.filter(|word| ends.iter().any(|end| word.ends_with(end)));
        let named: Vec<&str> = named.collect();
        assert!(name != "README.md" || named.len() > 10);
        // a page names files by their paths in the repository, in links to its neighbours by their names alone
        let own = root().join(&name);
        let folders = [Some(root()), own.parent()];
        // commands write below target
        for file in named.iter().filter(|file| !file.starts_with("target/")) {
            let there = folders.iter().flatten().any(|f| f.join(file).exists());
            assert!(there, "{name} names {file}");
        }
    }
}

#[test]
fn the_readme_is_short_and_leads_to_every_page_of_the_guide() {
    let readme = read("README.md");
    let lines = readme.lines().count();
    assert!(lines <= 150, "{lines} lines");
    let modules = read("src/guide.rs");
    for page in &pages()[1..] {
        assert!(readme.contains(&format!("({page})")), "{page} has no link");
        let included = format!("include_str!(\"{}\")", page.strip_prefix("src/").unwrap());
        assert!(modules.contains(&included), "{page} is no module");
    }
}
