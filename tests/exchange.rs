//! Files of other programs: what MuJoCo finds in exported files, and what comes back when they are read.
//!
//! MuJoCo is asked through Python, from `target/mujoco` as `.ci/run` makes it, or from `MUJOCO_PYTHON`. Where there is
//! none, its tests say so and pass.
#![cfg(feature = "interchange")]

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use linkwork::analysis::assembly::{AssemblySettings, assemble};
use linkwork::analysis::mobility::{MobilitySettings, mobility};
use linkwork::interchange::{tree_of, write_mjcf};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::system::Question;
use serde_json::{Value, json};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The shipped mechanisms with their names.
fn shipped() -> Vec<(String, Mechanism)> {
    let files = root().join("mechanisms").read_dir().unwrap();
    let mut files: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    files.sort();
    let named = files.iter().map(|path| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, Mechanism::load(path).unwrap())
    });
    named.collect()
}

fn home_assembly(mechanism: &Mechanism) -> Configuration<f64> {
    let report = assemble(&Question::new(mechanism), &AssemblySettings::default()).unwrap();
    assert!(report.residual < 1e-9, "{}", mechanism.name());
    report.configuration
}

/// Python with MuJoCo.
fn python() -> Option<PathBuf> {
    let given = std::env::var_os("MUJOCO_PYTHON").map(PathBuf::from);
    let made = root().join("target/mujoco/bin/python");
    let python = given.unwrap_or(made);
    if !python.exists() {
        eprintln!("skipped: there is no MuJoCo at {}", python.display());
        return None;
    }
    Some(python)
}

/// What a script of this folder answers to a question.
fn ask(python: &Path, script: &str, question: &Value) -> Value {
    let mut child = Command::new(python)
        .arg(root().join("tests/exchange").join(script))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(question.to_string().as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{script} failed");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Where every frame of a mechanism is.
fn places(mechanism: &Mechanism, at: &Configuration<f64>) -> BTreeMap<String, [f64; 3]> {
    let names = mechanism
        .frames()
        .into_iter()
        .map(|frame| mechanism.frame_name(frame));
    names
        .map(|name| {
            let place = mechanism.pose(&name, at).unwrap().position.0;
            (name, place)
        })
        .collect()
}

#[test]
fn mujoco_finds_every_exported_mechanism_assembled_and_as_free_as_it_is() {
    let Some(python) = python() else { return };
    let shipped = shipped();
    let mut question = serde_json::Map::new();
    for (name, mechanism) in &shipped {
        let at = home_assembly(mechanism);
        let (tree, remarks) = tree_of(mechanism, &at);
        let (mjcf, _) = write_mjcf(&tree, &remarks);
        let frames = places(mechanism, &at);
        question.insert(name.clone(), json!({"mjcf": mjcf, "frames": frames}));
        question.insert(
            format!("{name} nudged"),
            json!({"mjcf": mjcf, "frames": frames, "nudge": 1e-3}),
        );
    }
    let answers = ask(&python, "gaps.py", &question.into());
    for (name, mechanism) in &shipped {
        let answer = &answers[name];
        let number = |key: &str| answer[key].as_f64().unwrap();
        assert!(number("gap") < 1e-9, "{name}: {answer}");
        assert!(number("sites") < 1e-9, "{name}: {answer}");
        assert!(number("outside") < 1e-9, "{name}: {answer}");
        let at = home_assembly(mechanism);
        let question = Question::new(mechanism).near(&at);
        let report = mobility(&question, &MobilitySettings::default()).unwrap();
        let free = report.unknowns - report.rank;
        assert_eq!(number("freedoms") as usize, free, "{name}: {answer}");
        // what is held open gapes
        let nudged = &answers[&format!("{name} nudged")];
        if !mechanism.closures().is_empty() {
            assert!(nudged["gap"].as_f64().unwrap() > 1e-5, "{name}: {nudged}");
            assert!(number("constraints") > 0.0);
        }
        assert!(
            nudged["sites"].as_f64().unwrap() > 1e-6 || mechanism.frames().len() < 3,
            "{name}: {nudged}"
        );
    }
}
