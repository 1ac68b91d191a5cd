//! Shards of a study: each says what it is, goes on where it was interrupted, and meets no others.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::CommandCargoExt;

const FILE: &str = "mechanisms/four_bar.ron";

fn linkwork(arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("linkwork").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command.args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A study with options in one text.
fn study<'a>(file: &'a str, options: &'a str, more: &[&'a str]) -> Output {
    let options = options.split(' ').filter(|option| !option.is_empty());
    let arguments: Vec<&str> = ["study", file].into_iter().chain(options).collect();
    linkwork(&[&arguments[..], more].concat())
}

const ASKED: &str = "--set l0=5 --vary theta1=10deg..80deg --samples 6 --quantity phi1";

fn shard(folder: &Path, name: &str, file: &str, options: &str, part: &str) -> String {
    let path = folder.join(name).display().to_string();
    let output = study(file, options, &["--shard", part, "-o", &path]);
    assert!(output.status.success(), "{}", said(&output));
    path
}

#[test]
fn shards_of_other_studies_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let first = shard(folder, "a.csv", FILE, ASKED, "1/2");
    let second = shard(folder, "b.csv", FILE, ASKED, "2/2");
    let whole = study(FILE, ASKED, &[]);
    let merged = linkwork(&["merge", &second, &first]);
    assert_eq!(
        (merged.status.code(), said(&merged)),
        (Some(0), String::new())
    );
    assert_eq!(merged.stdout, whole.stdout);
    let twice = linkwork(&["merge", &second, &first, &second]);
    assert!(
        said(&twice).contains("are both shard 2, which counts once")
            && twice.stdout == whole.stdout
    );
    // the same file under another name, with a remark, is the same mechanism
    let copy = folder.join("copy.ron");
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(FILE)).unwrap();
    std::fs::write(&copy, format!("// a remark\n{text}")).unwrap();
    let copied = shard(folder, "c.csv", copy.to_str().unwrap(), ASKED, "2/2");
    assert!(linkwork(&["merge", &first, &copied]).status.success());
    // what joins the chains, which no number of the question shows
    std::fs::write(
        &copy,
        text.replacen("home: \"60 deg\"", "home: \"61 deg\"", 1),
    )
    .unwrap();
    let changed = copy.to_str().unwrap();
    let of = |from: &str, to: &str| ASKED.replace(from, to);
    for (file, options) in [
        (FILE, of("l0=5", "l0=4.2")),
        (FILE, of("80deg", "81deg")),
        (FILE, of("--samples 6", "--samples 6 --latin")),
        (FILE, of("--samples", "--grid")),
        (FILE, format!("{ASKED} --guess phi1=-30deg")),
        (FILE, format!("{ASKED} --seed 2")),
        (FILE, format!("{ASKED} --rate theta1=1")),
        (changed, ASKED.into()),
    ] {
        let other = shard(folder, "other.csv", file, &options, "2/2");
        let refused = linkwork(&["merge", &first, &other]);
        assert_eq!(refused.status.code(), Some(2), "{options}");
        assert!(
            said(&refused).contains("are shards of two studies"),
            "{}",
            said(&refused)
        );
        assert!(refused.stdout.is_empty());
    }
    let missing = linkwork(&["merge", &second]);
    assert!(
        said(&missing).contains("shard 1 of 2 is missing"),
        "{}",
        said(&missing)
    );
    let plain = folder.join("plain.csv");
    std::fs::write(&plain, &whole.stdout).unwrap();
    let unlabelled = linkwork(&["merge", &first, plain.to_str().unwrap()]);
    assert!(said(&unlabelled).contains("does not say of which study"));
}

/// A file with a part of the rows, as an interruption leaves it, is gone on with; another is written anew.
#[test]
fn a_study_goes_on_where_it_was_interrupted() {
    let folder = tempfile::tempdir().unwrap();
    for (shards, first, rows) in [("1/1", 0, 6), ("2/2", 3, 3)] {
        let file = folder.path().join("rows.csv");
        let path = file.to_str().unwrap();
        let run = |options: &str| study(FILE, options, &["--shard", shards, "-o", path]);
        assert!(run(ASKED).status.success());
        let whole = std::fs::read_to_string(&file).unwrap();
        // the mark is the same for all shards
        let labelled = shard(folder.path(), "other.csv", FILE, ASKED, "1/2");
        let labelled = std::fs::read_to_string(labelled).unwrap();
        let (label, _) = labelled.split_once('\n').unwrap();
        let label = label.replace("1 of 2", &shards.replace('/', " of "));
        let lines: Vec<&str> = whole
            .lines()
            .filter(|line| !line.starts_with('#'))
            .collect();
        assert_eq!(lines.len(), rows + 1);
        let begun = |count: usize| format!("{label}\n{}\n", lines[..=count].join("\n"));
        std::fs::write(&file, begun(2)).unwrap();
        let output = run(ASKED);
        let note = format!("has rows up to {}: going on from there", first + 2);
        assert!(said(&output).contains(&note), "{}", said(&output));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), whole);
        // of another question, cut in a row, or with a gap: written anew
        let gap = begun(2).replacen(&format!("\n{first},"), "\n7,", 1);
        for (options, text) in [
            (ASKED.replace("80deg", "81deg"), begun(2)),
            (ASKED.into(), begun(2).trim_end().into()),
            (ASKED.into(), gap),
        ] {
            std::fs::write(&file, text).unwrap();
            let output = run(&options);
            assert_eq!(
                (output.status.code(), said(&output)),
                (Some(0), String::new())
            );
            assert_eq!(
                std::fs::read_to_string(&file).unwrap() == whole,
                options == ASKED
            );
        }
    }
}

/// What is finished when the signal comes is in the file, or the note says that nothing is.
#[cfg(unix)]
#[test]
fn an_interrupted_study_keeps_what_is_finished() {
    use std::process::Stdio;
    use std::time::Duration;
    let folder = tempfile::tempdir().unwrap();
    for signal in ["-INT", "-TERM"] {
        let file = folder.path().join(format!("rows{signal}.csv"));
        let mut wait = Duration::from_millis(300);
        // until it was time enough for a row
        loop {
            let child = Command::new(env!("CARGO_BIN_EXE_linkwork"))
                .args(["study", FILE, "--vary", "l2=3..5", "--samples", "3000000"])
                .args(["--quantity", "phi1", "-o"])
                .arg(&file)
                .current_dir(env!("CARGO_MANIFEST_DIR"))
                .stderr(Stdio::piped())
                .spawn()
                .unwrap();
            std::thread::sleep(wait);
            let signalled = Command::new("kill")
                .args([signal, &child.id().to_string()])
                .status();
            assert!(signalled.unwrap().success());
            let output = child.wait_with_output().unwrap();
            let note = said(&output);
            wait *= 2;
            if output.status.code().is_none() || note.contains("nothing is written to") {
                assert!(!file.exists(), "{note}");
                continue;
            }
            assert_eq!(output.status.code(), Some(1));
            let text = std::fs::read_to_string(&file).unwrap();
            let rows: Vec<&str> = text.lines().collect();
            assert!(rows[0].starts_with("# shard 1 of 1 of study "));
            assert!(rows[1].starts_with("row of 3000000,"));
            for (i, row) in rows[2..].iter().enumerate() {
                assert!(row.starts_with(&format!("{i},")), "{row}");
            }
            let last = rows.len() - 3;
            let expected =
                format!("has rows 0 to {last} of 3000000; the same command goes on from there");
            assert!(
                note.contains(&expected) && note.lines().count() == 1,
                "{note}"
            );
            let merged = linkwork(&["merge", file.to_str().unwrap()]);
            assert!(
                said(&merged).contains("which was interrupted"),
                "{}",
                said(&merged)
            );
            break;
        }
    }
}
