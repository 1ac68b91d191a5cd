//! The page of `linkwork view`: its solver by node, and all of it in a browser. What is not here is said and left out:
//! node; puppeteer-core, by `npm ci --prefix tests/page`; Chromium, at `CHROMIUM` or where Debian has it.

// a test that is left out says so
#![allow(clippy::print_stdout)]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

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

/// Runs a script in Chromium, if that is here.
fn browse(script: &str) {
    let driver = root().join("tests/page/node_modules/puppeteer-core");
    match (chromium().exists(), driver.exists()) {
        (true, true) if node_is_here() => run(script),
        (true, true) => {}
        (false, _) => println!("skipped: there is no Chromium"),
        (_, false) => println!("skipped: run `npm ci --prefix tests/page` first"),
    }
}

#[test]
fn the_page_works_in_a_browser() {
    browse("browser.mjs");
}

#[test]
fn the_page_never_gets_stuck() {
    browse("stuck.mjs");
}

#[test]
fn pictures_in_the_page_read() {
    browse("pictures.mjs");
}

#[test]
fn what_acts_in_a_mechanism_moves_it_in_the_page() {
    browse("loads.mjs");
}

#[test]
fn designs_in_the_page_are_those_of_the_program() {
    browse("design.mjs");
}

#[test]
fn mechanisms_are_drawn_in_the_page() {
    browse("drawing.mjs");
}

#[test]
fn everything_in_the_page_is_read_and_reached() {
    let rules = root().join("tests/page/node_modules/axe-core");
    match rules.exists() {
        true => browse("accessible.mjs"),
        false => println!("skipped: run `npm ci --prefix tests/page` first"),
    }
}

/// What is answered to a request.
fn answered(address: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    stream
        .write_all(format!("{request}\r\n\r\n").as_bytes())
        .unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

/// The same with such a host.
fn asked(address: &str, path: &str, host: &str) -> String {
    answered(address, &format!("GET {path} HTTP/1.1\r\nHost: {host}"))
}

/// Whether the other end has not closed it yet.
fn is_open(stream: &TcpStream) -> bool {
    stream.set_nonblocking(true).unwrap();
    stream
        .peek(&mut [0])
        .is_err_and(|error| error.kind() == std::io::ErrorKind::WouldBlock)
}

#[test]
fn a_watched_page_is_served_to_this_machine_alone_and_follows_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("linkage.ron");
    let text = std::fs::read_to_string(root().join("mechanisms/four_bar.ron")).unwrap();
    std::fs::write(&file, &text).unwrap();
    let mut server = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(["view", "--watch"])
        .arg(&file)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = String::new();
    BufReader::new(server.stdout.take().unwrap())
        .read_line(&mut said)
        .unwrap();
    let address = said
        .strip_prefix("http://")
        .unwrap()
        .split('/')
        .next()
        .unwrap();
    assert!(address.starts_with("127.0.0.1:"), "{said}");
    let page = asked(address, "/", address);
    assert!(page.starts_with("HTTP/1.1 200 OK") && page.contains("connect-src 'self'"));
    assert!(page.contains("4-bar, broken at joint 3"));
    let local = address.replace("127.0.0.1", "localhost");
    assert!(asked(address, "/", &local).starts_with("HTTP/1.1 200 OK"));
    // who is connected and says nothing keeps nobody waiting
    let idle: Vec<TcpStream> = (0..100)
        .map(|_| TcpStream::connect(address).unwrap())
        .collect();
    assert!(asked(address, "/", address).starts_with("HTTP/1.1 200 OK"));
    assert!(idle.iter().any(is_open));
    // a file with problems is shown with them
    std::fs::write(&file, text.replace("4-bar, broken", "changed")).unwrap();
    assert!(asked(address, "/file", address).contains("changed at joint 3"));
    std::fs::write(&file, "Mechanism(").unwrap();
    assert!(asked(address, "/file", address).contains("\"text\":\"Mechanism(\""));
    for (path, host) in [
        ("/other", address),
        ("/../linkage.ron", address),
        ("/", "elsewhere.example"),
    ] {
        assert!(
            asked(address, path, host).starts_with("HTTP/1.1 404"),
            "{path} {host}"
        );
    }
    let local = address.replace("127.0.0.1", "LocalHost");
    for request in [
        format!("GET / HTTP/1.1\r\nAccept: a:b\r\nhOST:{local}"),
        format!("GET http://{address}/ HTTP/1.1\r\nHost: {address}"),
        format!("GET HTTP://{local} HTTP/1.1\r\nHost: {address}"),
    ] {
        let answer = answered(address, &request);
        assert!(answer.starts_with("HTTP/1.1 200 OK"), "{request}");
    }
    // a foreign host wherever it stands, and what may be read in two ways
    let own = format!("Host: {address}");
    for request in [
        "GET / HTTP/1.1".into(),
        "GET / HTTP/1.1\r\nhost: elsewhere.example".into(),
        format!("GET / HTTP/1.1\r\n{own}\r\nHost: elsewhere.example"),
        format!("GET / HTTP/1.1\r\nHOST: elsewhere.example\r\n{own}"),
        format!("GET / HTTP/1.1\r\n{own}\r\n{own}"),
        format!("GET / HTTP/1.1\r\nHost : elsewhere.example\r\n{own}"),
        format!("GET / HTTP/1.1\r\n{own}\r\n Host: elsewhere.example"),
        format!("GET / HTTP/1.1\r\n{own}\nHost: elsewhere.example"),
        format!("GET / HTTP/1.1\r\nAccept: text/html\r\n\r\n{own}"),
        format!("GET / HTTP/1.1\r\n{own}.elsewhere.example"),
        format!("GET / HTTP/1.1\r\n{own}1"),
        format!("GET http://elsewhere.example/ HTTP/1.1\r\n{own}"),
        format!("GET http://elsewhere.example@{address}/ HTTP/1.1\r\n{own}"),
        format!("POST / HTTP/1.1\r\n{own}"),
    ] {
        let answer = answered(address, &request);
        assert!(answer.starts_with("HTTP/1.1 404"), "{request}");
        assert!(!answer.contains("4-bar"), "{request}");
    }
    server.kill().unwrap();
    server.wait().unwrap();
}

#[test]
fn a_gallery_has_nothing_to_set_and_nothing_to_watch() {
    for (given, why) in [
        (
            ["--set", "l2=3"].as_slice(),
            "a gallery has no parameters to set",
        ),
        (&["--watch"], "there is no file to watch"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let run = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .arg("view")
            .args(given)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert_eq!(run.status.code(), Some(2), "{said}");
        assert!(
            said.contains(why) && said.contains("linkwork view FILE"),
            "{said}"
        );
        assert!(!folder.path().join("linkwork.html").exists());
    }
}

#[test]
fn a_page_is_written_beside_its_file_and_a_wrong_file_gives_none() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("linkage.ron");
    let text = std::fs::read_to_string(root().join("mechanisms/four_bar.ron")).unwrap();
    let view = || {
        let run = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .arg("view")
            .arg(&file)
            .output();
        run.unwrap()
    };
    std::fs::write(
        &file,
        text.replace("theta: \"theta1\"", "theta: \"tehta1\""),
    )
    .unwrap();
    let refused = view();
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("did you mean `theta1`?"));
    let page = folder.path().join("linkage.html");
    assert!(!page.exists());
    std::fs::write(&file, &text).unwrap();
    let written = view();
    let said = format!("{}: open it in a browser.\n", page.display());
    assert_eq!(String::from_utf8_lossy(&written.stdout), said);
    assert!(
        std::fs::read_to_string(page)
            .unwrap()
            .contains("4-bar, broken at joint 3")
    );
}
