//! The page of `linkwork view`: its solver by node, and all of it in a browser. What is not here is said and left out:
//! node; puppeteer-core, by `npm ci --prefix tests/page`; Chromium, at `CHROMIUM` or where Debian has it.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs a script of `tests/page`; all that it prints is shown if it fails.
fn run(script: &str) {
    let output = Command::new("node")
        .arg(root().join("tests/page").join(script))
        .env("LINKWORK", env!("CARGO_BIN_EXE_linkwork"))
        .env("CHROMIUM", chromium())
        .output()
        .unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success(), "{out}{err}");
}

fn node_is_here() -> bool {
    let found = Command::new("node").arg("--version").output();
    let here = found.is_ok_and(|output| output.status.success());
    if !here {
        println!("skipped: there is no node");
    }
    here
}

fn chromium() -> PathBuf {
    std::env::var_os("CHROMIUM").map_or_else(|| "/usr/bin/chromium".into(), PathBuf::from)
}

#[test]
fn the_solver_in_the_page_answers_as_the_program_does() {
    if node_is_here() {
        run("native.mjs");
    }
}

#[test]
fn the_page_works_in_a_browser() {
    let driver = root().join("tests/page/node_modules/puppeteer-core");
    match (chromium().exists(), driver.exists()) {
        (true, true) if node_is_here() => run("browser.mjs"),
        (true, true) => {}
        (false, _) => println!("skipped: there is no Chromium"),
        (_, false) => println!("skipped: run `npm ci --prefix tests/page` first"),
    }
}
