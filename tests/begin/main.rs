//! The first hour with the program: files to begin from, standard input, help, schemas, what is handed out.
#![cfg(feature = "cli")]

mod schemas;

use std::fs;
use std::io::Write;
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::CommandCargoExt;

fn linkwork() -> Command {
    let mut command = Command::cargo_bin("linkwork").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command.env("NO_COLOR", "1");
    command
}

fn run(arguments: &[&str]) -> Output {
    linkwork().args(arguments).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn answer(arguments: &[&str]) -> String {
    let output = run(arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    stdout(&output)
}

fn refusal(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
    String::from_utf8(output.stderr).unwrap()
}

/// The answer to arguments with a file as standard input.
fn piped(arguments: &[&str], file: &str) -> String {
    let mut command = linkwork();
    let command = command.args(arguments).stdin(Stdio::piped());
    let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
    let text = fs::read(file).unwrap();
    child.stdin.take().unwrap().write_all(&text).unwrap();
    stdout(&child.wait_with_output().unwrap())
}

#[test]
fn a_new_file_is_a_copy_of_an_example_under_its_own_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my_platform");
    let path = path.to_str().unwrap();
    answer(&["new", path, "--from", "3-rps"]);
    let file = format!("{path}.ron");
    let text = fs::read_to_string(&file).unwrap();
    let original = fs::read_to_string("mechanisms/three_rps.ron").unwrap();
    let renamed = original.replace("3-RPS parallel manipulator\"", "my_platform\"");
    assert_eq!(text, renamed);
    assert!(answer(&["check", &file]).starts_with("my_platform\n"));
    // what is there stays
    fs::write(&file, "mine").unwrap();
    assert!(refusal(&["new", path]).contains("--force"));
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    answer(&["new", path, "--force"]);
    assert!(fs::read_to_string(&file).unwrap().contains("Axes("));
}

#[test]
fn every_shipped_file_is_an_example() {
    let list = answer(&["examples"]);
    for folder in ["mechanisms", "mechanisms/axes"] {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.extension().is_some_and(|end| end == "ron") {
                let name = path.with_extension("");
                let name = name.strip_prefix("mechanisms").unwrap().to_str().unwrap();
                let listed = list
                    .lines()
                    .any(|line| line.split(' ').next() == Some(name));
                assert!(listed, "{name}");
            }
        }
    }
    let shown = answer(&["examples", "jansen"]);
    assert_eq!(
        shown,
        fs::read_to_string("mechanisms/jansen_leg.ron").unwrap()
    );
    assert!(refusal(&["examples", "janson_leg"]).contains("did you mean `jansen_leg`?"));
    assert!(refusal(&["examples", "nothing like it"]).contains("linkwork examples"));
}

#[test]
fn a_dash_is_standard_input_wherever_a_file_is_read() {
    for (command, file) in [
        ("check", "mechanisms/four_bar.ron"),
        ("solve", "mechanisms/three_rps.ron"),
        ("mobility", "mechanisms/bennett.ron"),
        ("frames", "mechanisms/axes/puma560.ron"),
        ("convert", "mechanisms/four_bar.ron"),
        ("draw", "mechanisms/four_bar.ron"),
    ] {
        let more: &[&str] = match command {
            "convert" => &["--to", "axes"],
            _ => &[],
        };
        let named = answer(&[&[command, file], more].concat());
        assert_eq!(
            piped(&[&[command, "-"], more].concat(), file),
            named,
            "{command}"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("arm.urdf");
    fs::write(
        &urdf,
        answer(&["export", "mechanisms/planar_2r.ron", "--to", "urdf"]),
    )
    .unwrap();
    let urdf = urdf.to_str().unwrap();
    let named = answer(&["import", urdf]).replace("from arm.urdf", "from standard input");
    assert_eq!(piped(&["import", "-"], urdf), named);
    // problems are told of it by that name
    let mut command = linkwork();
    let output = command
        .args(["check", "-"])
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("in standard input"), "{said}");
}

#[test]
fn a_mistyped_path_is_told_its_neighbour() {
    for (typed, meant) in [
        ("mechanisms/four_br.ron", "`mechanisms/four_bar.ron`"),
        ("mechanisms/four_bar", "`mechanisms/four_bar.ron`"),
        ("mechanims/axes/shaper.rn", "`mechanisms/axes/shaper.ron`"),
        (
            "jansen_leg.ron",
            "`linkwork new jansen_leg --from jansen_leg`",
        ),
    ] {
        let said = refusal(&["solve", typed]);
        assert!(said.contains(meant), "{typed}: {said}");
    }
    let said = refusal(&["solve", "mechanisms/qqqqqqqq.ron"]);
    assert!(!said.contains("help"), "{said}");
}

#[test]
fn options_are_grouped_and_rare_ones_come_last() {
    for command in ["solve", "sweep", "workspace", "draw"] {
        let help = answer(&[command, "--help"]);
        let at = |part: &str| {
            help.find(part)
                .unwrap_or_else(|| panic!("{command}: {part}"))
        };
        let order = [
            "\nOptions:",
            "\nConfiguration:",
            "\nAnswer:",
            "\nRarely needed:",
        ]
        .map(at);
        assert!(order.is_sorted(), "{command}");
        assert!(at("\n      --max-bytes") > order[3] && at("\n      --seed") > order[3]);
        assert!(
            (order[1]..order[2]).contains(&at("\n      --hold")),
            "{command}"
        );
    }
}

#[test]
fn completions_and_manual_are_installed_below_one_folder() {
    let folder = tempfile::tempdir().unwrap();
    let share = folder.path().to_str().unwrap();
    answer(&["setup", "--to", share]);
    let read = |place: &str| fs::read_to_string(folder.path().join(place)).unwrap();
    for place in [
        "bash-completion/completions/linkwork",
        "zsh/site-functions/_linkwork",
        "fish/vendor_completions.d/linkwork.fish",
        "powershell/linkwork.ps1",
    ] {
        let script = read(place);
        for word in ["assemblies", "all-modes", "circuits", "handout"] {
            assert!(script.contains(word), "{place}: {word}");
        }
    }
    assert!(read("man/man1/linkwork.1").contains("linkwork\\-assemblies(1)"));
    assert!(read("man/man1/linkwork-sweep.1").contains("\\-\\-circuits"));
    let printed = answer(&["setup", "--print", "bash"]);
    assert_eq!(printed, read("bash-completion/completions/linkwork"));
}

#[test]
fn tables_are_written_for_booktabs() {
    let tables = answer(&["check", "mechanisms/three_rps.ron", "--latex"]);
    assert_eq!(tables.matches("\\toprule").count(), 3);
    assert!(tables.contains("$i$ & $\\alpha_{i-1}$ & $a_{i-1}$ & $d_i$ & $\\theta_i$ \\\\"));
    assert!(tables.contains("2 & $-90^{\\circ}$ & $0$ & $l_{1}$ & $0$ \\\\"));
    assert!(tables.contains("base $\\operatorname{Rz}\\left(120^{\\circ}\\right)"));
    let standard = answer(&["check", "mechanisms/scara_standard.ron", "--latex"]);
    assert!(standard.contains("$i$ & $\\theta_i$ & $d_i$ & $a_i$ & $\\alpha_i$ \\\\"));
}

#[test]
fn formulas_are_mathml_on_pages_and_tex_in_markdown() {
    let page = answer(&[
        "formulas",
        "mechanisms/four_bar.ron",
        "--solve",
        "--format",
        "html",
    ]);
    assert!(page.contains("<mfrac>") && page.contains("<msqrt>"));
    assert!(!page.contains("<pre"));
    let text = answer(&[
        "formulas",
        "mechanisms/four_bar.ron",
        "--format",
        "markdown",
    ]);
    assert!(text.contains("$$\n{}^{\\mathrm{left.0}}_{\\mathrm{left.1}}T = "));
    assert_eq!(text.matches("$$").count() % 2, 0);
}

#[test]
fn a_handout_has_all_parts_and_is_well_formed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    answer(&[
        "handout",
        "mechanisms/four_bar.ron",
        "-o",
        path.to_str().unwrap(),
    ]);
    let page = fs::read_to_string(&path).unwrap();
    for title in [
        "Drawing",
        "Joints",
        "Formulas",
        "Closed form",
        "Printed formulas",
        "Assemblies",
        "Mobility",
    ] {
        assert!(page.contains(&format!("<h2>{title}</h2>")), "{title}");
    }
    assert!(page.contains("<svg") && page.contains("<math ") && page.contains("from closures"));
    assert!(!page.contains("<script") && !page.contains("http-equiv=\"refresh"));
    // a page of HTML whose elements all close is XML but for its first lines and void elements
    let body = page.split_once("<main>").unwrap().1;
    let body = body
        .split_once("</main>")
        .unwrap()
        .0
        .replace("<br>", "<br/>");
    roxmltree::Document::parse(&format!("<main>{body}</main>")).unwrap();
}
