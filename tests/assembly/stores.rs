//! The file that keeps generic solutions: what was changed is refused, and nothing else is touched.

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use linkwork::analysis::assemblies::{
    AssembliesError, AssembliesSettings, AssemblySolver, GenericSolutions, StoredError,
};
use linkwork::description::load;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

const THREE_RPS: &str = "mechanisms/three_rps.ron";
const FOUR_BAR: &str = "mechanisms/four_bar.ron";

fn mechanism(path: &str) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    Mechanism::new(&load(path).unwrap().1).unwrap()
}

fn stored(path: &str) -> String {
    let mechanism = mechanism(path);
    let held = Question::new(&mechanism).held();
    let solver = AssemblySolver::new(
        &mechanism,
        &held,
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    solver.generic().to_text()
}

/// The text without its last solution, in form as good as before.
fn shortened(text: &str) -> String {
    let start = text.rfind("],[").unwrap();
    let end = start + 3 + text[start + 3..].find(']').unwrap();
    text[..start].to_owned() + &text[end..]
}

#[test]
fn whatever_was_changed_is_refused() {
    let text = stored(FOUR_BAR);
    assert!(GenericSolutions::from_text(&text).is_ok());
    let (title, body) = text.split_once('\n').unwrap();
    let digit = body.rfind(|c: char| c.is_ascii_digit()).unwrap();
    let mut tampered = body.to_owned();
    let other = if &body[digit..=digit] == "1" {
        "2"
    } else {
        "1"
    };
    tampered.replace_range(digit..=digit, other);
    for (what, changed, error) in [
        (
            "a number",
            format!("{title}\n{tampered}"),
            StoredError::Damaged,
        ),
        ("a solution", shortened(&text), StoredError::Damaged),
        (
            "the end",
            text[..text.len() - 2].to_owned(),
            StoredError::Damaged,
        ),
        (
            "half of it",
            text[..text.len() / 2].to_owned(),
            StoredError::Damaged,
        ),
        (
            "the count",
            text.replacen("2 solutions", "1 solutions", 1),
            StoredError::Damaged,
        ),
        ("more", format!("{text}more"), StoredError::Damaged),
        ("the title", body.to_owned(), StoredError::SomethingElse),
        ("all of it", String::new(), StoredError::SomethingElse),
        (
            "the version",
            text.replacen("version 6", "version 4", 1),
            StoredError::OtherVersion,
        ),
    ] {
        assert_ne!(changed, text, "{what}");
        assert_eq!(GenericSolutions::from_text(&changed), Err(error), "{what}");
    }
}

/// Numbers with a right checksum that solve nothing belong to another question.
#[test]
fn numbers_that_do_not_assemble_the_mechanism_are_refused() {
    let mechanism = mechanism(FOUR_BAR);
    let held = Question::new(&mechanism).held();
    let text = stored(FOUR_BAR);
    let right = GenericSolutions::from_text(&text).unwrap();
    assert!(AssemblySolver::from_stored(&mechanism, &held, right).is_ok());
    // as a program that writes its own title would do it
    let body = text.split_once('\n').unwrap().1;
    let first = body.rfind("],[").unwrap();
    let at = first + body[first..].find(|c: char| c.is_ascii_digit()).unwrap();
    let wrong = format!("{}9{}", &body[..at], &body[at..]);
    let title = format!(
        "linkwork generic solutions, version 6: 2 solutions, checksum {:08x}",
        crc32fast::hash(wrong.as_bytes())
    );
    let wrong = GenericSolutions::from_text(&format!("{title}\n{wrong}")).unwrap();
    assert_eq!(
        AssemblySolver::from_stored(&mechanism, &held, wrong).unwrap_err(),
        AssembliesError::StoredForAnotherQuestion
    );
}

fn run(mechanism: &str, store: &Path) -> Output {
    let mut command = Command::cargo_bin("linkwork").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
        .args(["assemblies", mechanism, "--store"])
        .arg(store);
    command
        .timeout(std::time::Duration::from_secs(120))
        .output()
        .unwrap()
}

/// Exit code 2, nothing on stdout, and a message that names the file, the reason and the remedy.
#[track_caller]
fn refused(store: &Path, reason: &str, remedy: &str) {
    let output = run(THREE_RPS, store);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains(store.to_str().unwrap()), "{said}");
    assert!(said.contains(reason) && said.contains(remedy), "{said}");
}

fn names(folder: &Path) -> Vec<String> {
    let files = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = files
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

const ANOTHER: &str = "name another file with --store";

#[test]
fn damaged_stores_are_refused_with_the_remedy_and_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    for (text, reason, remedy) in [
        (
            shortened(&stored(FOUR_BAR)),
            "cut short or changed",
            "delete the file",
        ),
        (
            "(solutions: [])".to_owned(),
            "does not hold stored solutions",
            ANOTHER,
        ),
    ] {
        fs::write(&store, &text).unwrap();
        refused(&store, reason, remedy);
        assert_eq!(fs::read_to_string(&store).unwrap(), text);
    }
    // a mechanism named by mistake
    let own = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(FOUR_BAR)).unwrap();
    fs::write(&store, &own).unwrap();
    refused(&store, "something else", ANOTHER);
    assert_eq!(fs::read_to_string(&store).unwrap(), own);
    // not text
    fs::write(&store, [0xff, 0xfe, 0]).unwrap();
    refused(&store, "something else", ANOTHER);
    assert_eq!(names(folder.path()), ["store"]);
}

#[test]
fn places_that_cannot_hold_a_store_are_refused_and_nothing_is_left_there() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    refused(folder.path(), "it is a folder", ANOTHER);
    refused(&at("no/such"), "there is no such folder", ANOTHER);
    // larger than any store; it has no blocks on the disk
    fs::File::create(at("huge"))
        .unwrap()
        .set_len(1 << 40)
        .unwrap();
    refused(&at("huge"), "no store has more than", ANOTHER);
    // of another question, and not to be written
    fs::write(at("kept"), stored(FOUR_BAR)).unwrap();
    let mut permissions = fs::metadata(at("kept")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(at("kept"), permissions).unwrap();
    refused(&at("kept"), "write-protected", ANOTHER);
    assert_eq!(names(folder.path()), ["huge", "kept"]);
}

#[cfg(unix)]
#[test]
fn pipes_devices_and_dead_links_are_not_opened() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    refused(&pipe, "not a regular file", ANOTHER);
    for device in ["/dev/null", "/dev/full"] {
        refused(Path::new(device), "not a regular file", ANOTHER);
    }
    let link = folder.path().join("link");
    std::os::unix::fs::symlink("nowhere", &link).unwrap();
    refused(&link, "leads nowhere", ANOTHER);
    assert_eq!(names(folder.path()), ["link", "pipe"]);
}

/// An empty file, as `mktemp` makes it, is filled; a link keeps being one.
#[cfg(unix)]
#[test]
fn empty_files_are_filled_and_links_followed() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("file"), folder.path().join("link"));
    fs::write(&file, "").unwrap();
    std::os::unix::fs::symlink("file", &link).unwrap();
    assert_eq!(run(FOUR_BAR, &link).status.code(), Some(0));
    assert!(link.is_symlink());
    assert!(GenericSolutions::from_text(&fs::read_to_string(&file).unwrap()).is_ok());
    assert_eq!(names(folder.path()), ["file", "link"]);
}

/// A disk that is full only when the search is done: the answer is given, the store is not half
/// written, and the old one stays.
#[cfg(unix)]
#[test]
fn an_answer_is_not_lost_with_its_store() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let old = stored(FOUR_BAR);
    fs::write(&store, &old).unwrap();
    let output = std::process::Command::new("sh")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        // no file may have a byte, and the signal that would say so is ignored
        .args([
            "-c",
            "trap '' XFSZ; ulimit -f 0; exec \"$0\" assemblies \"$1\" --store \"$2\"",
        ])
        .arg(assert_cmd::cargo::cargo_bin("linkwork"))
        .arg(THREE_RPS)
        .arg(&store)
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("could not be stored in"), "{said}");
    assert_eq!(output.status.code(), Some(0));
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("8 real of 16 complex")
    );
    assert_eq!(fs::read_to_string(&store).unwrap(), old);
    assert_eq!(names(folder.path()), ["store"]);
}
