//! The command line as its users meet it: answers, problems, exit codes.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::CommandCargoExt;
use serde_json::Value;

const FOUR_BAR: &str = "mechanisms/four_bar.ron";
/// Files whose point is a singular configuration.
const SINGULAR: [&str; 3] = ["flat_triangle.ron", "parallelogram.ron", "two_rhombi.ron"];
const SIX_SPS: &str = "mechanisms/stewart_gough_6sps.ron";
const THREE_RPS: &str = "mechanisms/three_rps.ron";

fn linkwork() -> Command {
    let mut command = Command::cargo_bin("linkwork").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

fn run(arguments: &[&str]) -> Output {
    linkwork().args(arguments).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The answer, which must be a yes.
fn answer(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stdout(&output)
}

/// What is said of a wrong file or question; nothing else may be printed.
fn refusal(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
    assert_eq!(stdout(&output), "", "data on stdout");
    stderr(&output)
}

fn json(arguments: &[&str]) -> Value {
    let output = run(&[arguments, &["--format", "json"]].concat());
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn mechanisms() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let names = folder.read_dir().unwrap();
    let files = names.filter(|entry| entry.as_ref().unwrap().path().is_file());
    let names = files.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.map(|name| format!("mechanisms/{name}")).collect();
    names.sort();
    names
}

#[test]
fn every_shipped_mechanism_is_checked_solved_and_compared() {
    for file in mechanisms() {
        assert_eq!(
            json(&["check", &file])["linkwork"],
            env!("CARGO_PKG_VERSION")
        );
        answer(&["mobility", &file]);
        let special = SINGULAR.iter().any(|name| file.ends_with(name));
        let outcome = if special { "singular" } else { "converged" };
        assert_eq!(json(&["solve", &file])["outcome"], outcome, "{file}");
        assert_eq!(json(&["compare", &file])["agree"], true, "{file}");
    }
}

#[test]
fn a_wrong_closed_form_is_answered_no() {
    let file = "mechanisms/three_rps.ron";
    answer(&["compare", file, "--set", "b=1.1"]);
    let right = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.ron");
    std::fs::write(&path, right.replace("b - l1*", "b + l1*")).unwrap();
    let output = run(&["compare", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("disagrees") && text.contains("S1"), "{text}");
}

#[test]
fn a_four_bar_is_described() {
    insta::assert_snapshot!(answer(&["check", FOUR_BAR]));
}

#[test]
fn a_platform_is_described() {
    insta::assert_snapshot!(answer(&["check", THREE_RPS]));
}

#[test]
fn a_standard_table_is_drawn_in_its_own_order() {
    insta::assert_snapshot!(answer(&["check", "mechanisms/bennett.ron"]));
}

#[test]
fn an_assembled_platform_is_described() {
    insta::assert_snapshot!(answer(&["solve", THREE_RPS]));
}

#[test]
fn what_cannot_be_assembled_is_answered_no() {
    let output = run(&["solve", FOUR_BAR, "--set", "l2=0.5"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let text = stdout(&output);
    let sentence = "Cannot be assembled with these inputs: at the closest approach closure joint3 is open by 0.08";
    assert!(text.contains(sentence), "{text}");
    let json = json(&["solve", FOUR_BAR, "--set", "l2=0.5"]);
    assert_eq!(json["outcome"], "cannot_be_assembled");
    assert_eq!(json["worst"], "joint3");
    assert!(json["gaps"]["joint3"]["distance"].as_f64().unwrap() > 0.08);
}

#[test]
fn what_is_outside_limits_is_answered_no() {
    let output = run(&["solve", THREE_RPS, "--hold", "l1=1.25"]);
    let json = json(&["solve", THREE_RPS, "--hold", "l1=1.25"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(json["outcome"], "converged_outside_limits");
    assert_eq!(json["outside_limits"], serde_json::json!(["l1"]));
}

#[test]
fn json_has_the_promised_keys_and_every_digit() {
    let json = json(&["solve", THREE_RPS]);
    for key in [
        "linkwork",
        "mechanism",
        "outcome",
        "steps",
        "residual",
        "condition",
        "warnings",
    ] {
        assert!(!json[key].is_null(), "{key}");
    }
    assert_eq!(json["joints"]["l1"].as_f64(), Some(2.0 / 3.0));
    let top = &json["platforms"]["top"];
    assert_eq!(top["position"].as_array().unwrap().len(), 3);
    assert_eq!(top["quaternion"].as_array().unwrap().len(), 4);
    let rotation = &json["frames"]["leg1"]["rotation"];
    assert_eq!(rotation[2].as_array().unwrap().len(), 3);
}

#[test]
fn an_infinite_condition_number_is_null() {
    let json = json(&["solve", FOUR_BAR, "--set", "l2=0.5"]);
    assert!(json["condition"].is_null(), "{}", json["condition"]);
}

#[test]
fn values_are_expressions_over_the_parameters() {
    let json = json(&[
        "solve",
        FOUR_BAR,
        "--set",
        "l2=l1 + 2",
        "--set",
        "l0=5000 mm",
        "--hold",
        "theta1=pi/l2",
    ]);
    assert_eq!(
        json["joints"]["theta1"].as_f64(),
        Some(std::f64::consts::PI / 3.0)
    );
    assert_eq!(json["outcome"], "converged");
}

#[test]
fn a_guess_chooses_the_other_assembly() {
    let value = |json: Value| json["joints"]["phi1"].as_f64().unwrap();
    assert!(value(json(&["solve", FOUR_BAR])) > 0.0);
    assert!(value(json(&["solve", FOUR_BAR, "--guess", "phi1=-90 deg"])) < 0.0);
}

#[test]
fn inverse_kinematics_holds_the_platform() {
    let arguments = [
        "solve",
        THREE_RPS,
        "--free",
        "actuated",
        "--hold",
        "top.z=0.5",
        "--hold",
        "top.roll=0",
        "--hold",
        "top.pitch=0",
    ];
    let json = json(&arguments);
    assert_eq!(json["outcome"], "converged");
    assert!((json["platforms"]["top"]["position"][2].as_f64().unwrap() - 0.5).abs() < 1e-12);
}

#[test]
fn wrong_values_of_options_are_underlined() {
    let mut said = String::new();
    for options in [
        &["--set", "l1=2*"][..],
        &["--set", "l9=2"],
        &["--set", "l1=theta1 + lo"],
        &["--set", "l1=1/(l0 - 5)"],
        &["--set", "l1=l2", "--set", "l2=l1"],
        &["--hold", "tehta1=1"],
        &["--hold", "theta1=60 dge"],
        &["--hold", "theta1=lo + 1"],
        &["--hold", "theta1=1/0"],
        &["--guess", "joint4=0"],
        &["--free", "phi"],
    ] {
        said += &refusal(&[&["velocity", FOUR_BAR], options].concat());
        said += "\n";
    }
    for options in [&["--hold", "top=[Tz(1), Rw(2)]"][..], &["--free", "top"]] {
        said += &refusal(&[&["velocity", THREE_RPS], options].concat());
        said += "\n";
    }
    insta::assert_snapshot!(said);
}

#[test]
fn a_wrong_count_says_what_would_do() {
    let mut said = String::new();
    for options in [
        &["--hold", "phi2=0"][..],
        &["--free", "theta1"],
        &["--free", "theta1", "--free", "phi1"],
    ] {
        said += &refusal(&[&["velocity", FOUR_BAR], options].concat());
        said += "\n";
    }
    for options in [
        &["--hold", "top.z=0.5", "--hold", "top.x=0"][..],
        &["--free", "l1", "--free", "l3"],
        &["--free", "actuated", "--hold", "top=home"],
    ] {
        said += &refusal(&[&["velocity", THREE_RPS], options].concat());
        said += "\n";
    }
    insta::assert_snapshot!(said);
}

#[test]
fn wrong_command_lines_are_refused() {
    for arguments in [
        &["solv", FOUR_BAR][..],
        &["check"],
        &["check", FOUR_BAR, "--format", "xml"],
        &["check", FOUR_BAR, "--set", "l1"],
        &["check", FOUR_BAR, "--set", "=1"],
        &["check", FOUR_BAR, "--hold", "theta1=1"],
        &["solve", FOUR_BAR, "--seed", "-1"],
        &["solve", FOUR_BAR, THREE_RPS],
    ] {
        refusal(arguments);
    }
}

#[test]
fn a_number_that_is_none_is_told_what_it_should_be() {
    for value in ["x", "-1", "0", "1.5"] {
        let said = refusal(&["solve", FOUR_BAR, "--mode", value]);
        let wanted = "a mode is a whole number from 1 on, as `linkwork assemblies` numbers them";
        assert!(said.contains(wanted), "{said}");
    }
    let said = refusal(&["solve", FOUR_BAR, "--mode", "3"]);
    assert!(said.contains("home inputs have modes 1 to 2"), "{said}");
    for command in ["solve", "assemblies", "mobility", "compare"] {
        let said = refusal(&[command, FOUR_BAR, "--seed", "-1"]);
        assert!(
            said.contains("a seed is a whole number from 0 to"),
            "{said}"
        );
    }
    answer(&["solve", FOUR_BAR, "--mode", "2", "--seed", "0"]);
}

#[test]
fn a_frame_that_stands_on_ground_has_no_velocity() {
    let said = refusal(&["velocity", FOUR_BAR, "--point", "ground"]);
    assert!(said.contains("`ground` does not move"), "{said}");
    answer(&["velocity", FOUR_BAR, "--point", "left"]);
}

/// Isolated assemblies are no samples, and what ends in a set of assemblies is no path.
#[test]
fn the_first_sentence_tells_isolated_assemblies_from_samples() {
    let said = stdout(&run(&["assemblies", "mechanisms/peaucellier.ron"]));
    let sentence = "4 isolated assemblies and 6 samples of the others are listed.";
    assert!(said.contains(sentence), "{said}");
    let said = stdout(&run(&["assemblies", "mechanisms/two_rhombi.ron"]));
    let sentence = "a set of dimension 2 to which 4 complex solutions lead, with 6 samples";
    assert!(said.contains(sentence), "{said}");
}

#[test]
fn joints_outside_their_limits_are_named() {
    let inverse = ["--free", "actuated", "--hold", "hand=home"];
    let puma = ["assemblies", "mechanisms/puma560_modified.ron"];
    let said = stdout(&run(&[&puma[..], &inverse].concat()));
    assert!(said.contains("outside: theta"), "{said}");
    let said = stdout(&run(&["assemblies", FOUR_BAR]));
    assert!(!said.contains("outside"), "{said}");
}

#[test]
fn files_that_cannot_be_read_are_refused() {
    assert!(
        refusal(&["check", "mechanisms/no_such_file.ron"])
            .contains("no_such_file.ron: cannot be read")
    );
    assert!(refusal(&["check", "mechanisms"]).contains("mechanisms: cannot be read"));
    assert!(refusal(&["solve", "mechanisms/no_such_file.ron"]).contains("cannot be read"));
}

#[test]
fn a_wrong_file_is_answered_with_all_its_problems() {
    for command in [
        "check",
        "solve",
        "assemblies",
        "compare",
        "frames",
        "convert",
    ] {
        let said = refusal(&[command, "tests/wrong/unknown_frames.ron"]);
        assert!(said.contains("did you mean `ground`?"), "{said}");
        assert!(
            said.contains("problems in tests/wrong/unknown_frames.ron"),
            "{said}"
        );
    }
}

#[test]
fn warnings_do_not_change_the_answer() {
    let output = run(&["check", "mechanisms/four_bar_cut1.ron"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(stdout(&output).starts_with("4-bar"));
    let said = stderr(&output);
    assert!(
        said.starts_with("warning: row 3 of chain `links`"),
        "{said}"
    );
    assert!(
        said.ends_with("1 warning in mechanisms/four_bar_cut1.ron\n"),
        "{said}"
    );
}

#[test]
fn a_reader_who_leaves_early_is_no_error() {
    for arguments in [
        &["check", THREE_RPS][..],
        &["solve", THREE_RPS],
        &["--help"],
    ] {
        let mut child = linkwork()
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(stderr(&output), "");
        assert_eq!(output.status.code(), Some(0));
    }
}

#[test]
fn a_full_disk_is_reported() {
    let Ok(full) = std::fs::File::create("/dev/full") else {
        return;
    };
    let output = linkwork()
        .args(["check", FOUR_BAR])
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("cannot be written"));
}

#[test]
fn help_shows_an_example_of_every_command() {
    for command in ["check", "solve", "assemblies", "compare"] {
        let help = answer(&[command, "--help"]);
        assert!(
            help.contains(&format!("linkwork {command} mechanisms/")),
            "{help}"
        );
    }
    assert!(answer(&["--help"]).contains("Exit codes"));
}

#[test]
fn mobility_is_written_as_asked() {
    let bar = json(&["mobility", FOUR_BAR]);
    let keys: Vec<&String> = bar.as_object().unwrap().keys().collect();
    assert_eq!(keys[..3], ["linkwork", "mechanism", "sentence"]);
    let fields = [
        "mobility",
        "kutzbach",
        "rank",
        "infinitesimal",
        "redundant",
        "idle_joints",
        "moving_joints",
        "redundant_constraints",
        "explanation",
    ];
    for field in fields {
        assert!(keys.iter().any(|key| *key == field), "{field}");
    }
    let words = &bar["redundant_constraints"][0];
    assert_eq!(
        words,
        "closure `joint3`: force along z, moments about x and y"
    );
    assert_eq!(
        (&bar["mobility"], &bar["redundant"]),
        (&1.into(), &3.into())
    );
    let explanation = bar["explanation"].as_str().unwrap();
    assert!(
        explanation.starts_with("The mechanism has 1 freedom."),
        "{explanation}"
    );
}

#[test]
fn a_mechanism_that_is_not_closed_is_not_analysed_and_the_way_out_is_told() {
    let asked = [
        "mobility",
        FOUR_BAR,
        "--set",
        "l2=0.5",
        "--hold",
        "theta1=60 deg",
    ];
    let output = run(&asked);
    assert_eq!(output.status.code(), Some(1));
    let said = stdout(&output);
    assert!(
        said.contains("Not assembled") && said.contains("start elsewhere"),
        "{said}"
    );
    assert_eq!(json(&asked)["closed"], false);
}

#[test]
fn velocity_and_statics_answer_for_every_shipped_mechanism() {
    for file in mechanisms() {
        let special = SINGULAR.iter().any(|name| file.ends_with(name));
        let velocity = json(&["velocity", &file]);
        assert_eq!(velocity["gain"].is_null(), !special, "{file}");
        let statics = json(&["statics", &file]);
        assert_eq!(
            statics["balanced"], true,
            "{file}: no load is always balanced"
        );
        if !special {
            answer(&["velocity", &file]);
        }
        answer(&["statics", &file]);
    }
}

#[test]
fn rates_and_forces_are_written_with_names_and_units() {
    let moving = json(&[
        "velocity", THREE_RPS, "--rate", "l1=0.1", "--point", "top.S1",
    ]);
    assert_eq!(moving["inputs"][0]["name"], "l1");
    assert_eq!(moving["inputs"][0]["rate"], 0.1);
    let jacobian = &moving["jacobian"];
    assert_eq!(jacobian["rows"][0]["name"], "top ωx");
    assert_eq!(jacobian["rows"][0]["unit"], "rad/s");
    assert_eq!(jacobian["columns"][2]["unit"], "m/s");
    assert_eq!(jacobian["entries"].as_array().unwrap().len(), 9);
    assert_eq!(moving["frames"][1]["name"], "top.S1");
    let forces = json(&["statics", THREE_RPS, "--wrench", "top=0,0,-100"]);
    assert_eq!(forces["balanced"], true);
    assert_eq!(forces["actuators"][0]["unit"], "N");
    let text = answer(&["statics", FOUR_BAR, "--load", "phi1=2"]);
    assert!(
        text.contains("minimum-norm") && text.contains("N·m"),
        "{text}"
    );
}

#[test]
fn questions_that_make_no_sense_are_told_what_to_ask_instead() {
    for (asked, told) in [
        (
            &["velocity", FOUR_BAR, "--rate", "phi1=2"][..],
            "--rate theta1=0.1",
        ),
        (
            &["velocity", FOUR_BAR, "--rate", "theta=2"],
            "did you mean `theta1`?",
        ),
        (&["velocity", FOUR_BAR, "--rate", "theta1=1/0"], "no value"),
        (
            &["velocity", FOUR_BAR, "--point", "lefd"],
            "did you mean `left`?",
        ),
        (
            &["velocity", FOUR_BAR, "--free", "theta1"],
            "leave out --free theta1",
        ),
        (&["velocity", FOUR_BAR, "--hold", "phi1=home"], "--free"),
        (
            &["velocity", FOUR_BAR, "--rate", "theta1=1e200"],
            "too large",
        ),
        (
            &[
                "velocity",
                SIX_SPS,
                "--free",
                "actuated",
                "--hold",
                "top=[Tz(0.9), Ry(90 deg)]",
                "--rate",
                "top.yaw=1",
                "--rate",
                "top.wx=1",
            ],
            "either roll, pitch and yaw, or top.wx",
        ),
        (
            &["velocity", SIX_SPS, "--rate", "top.wx=1"],
            "--free actuated --hold top=home",
        ),
        (
            &["velocity", SIX_SPS, "--rate", "top=1"],
            "--rate top.z=0.1",
        ),
        (
            &["velocity", FOUR_BAR, "--rate", "hand.z=1"],
            "--rate theta1=0.1",
        ),
        (
            &["statics", SIX_SPS, "--load", "top.z=1"],
            "--wrench top=0,0,1",
        ),
        (
            &["statics", FOUR_BAR, "--load", "hand=1"],
            "theta1, phi2 and phi1",
        ),
        (
            &["velocity", "mechanisms/triangle.ron", "--rate", "theta=1"],
            "linkwork statics",
        ),
        (
            &["velocity", FOUR_BAR, "--rate", "theta1=0.1 m"],
            "expected an angle, found a length",
        ),
        (
            &["statics", FOUR_BAR, "--load", "phi1=2 deg"],
            "expected a moment, found an angle",
        ),
        (&["statics", FOUR_BAR, "--wrench", "ground=0,0,1"], "left"),
        (&["statics", FOUR_BAR, "--wrench", "left=0,1"], "Fx,Fy,Fz"),
        (&["statics", FOUR_BAR, "--wrench", "left=0,1,q"], "q"),
        (&["statics", FOUR_BAR, "--load", "phi3=1"], "did you mean"),
        (
            &["statics", FOUR_BAR, "--free", "theta1"],
            "leave out --free theta1",
        ),
        (
            &["sweep", THREE_RPS, "--circuits", "--free", "l1"],
            "--hold l1=0.6609 --hold l2=0.5977 without --free l1",
        ),
        (
            &["mobility", FOUR_BAR, "--hold", "theta9=1"],
            "did you mean `theta1`?",
        ),
    ] {
        let said = refusal(asked);
        assert!(said.contains(told), "{asked:?}: {said}");
    }
    // out of reach
    for command in ["mobility", "velocity", "statics"] {
        let output = run(&[command, THREE_RPS, "--hold", "l1=40"]);
        assert_eq!(output.status.code(), Some(1), "{command}");
        assert!(
            stdout(&output).contains("Not assembled with"),
            "{}",
            stdout(&output)
        );
    }
}

#[test]
fn all_assemblies_are_listed_with_their_accounting() {
    let json = json(&["assemblies", THREE_RPS]);
    for (key, value) in [
        ("complex", 16),
        ("real", 8),
        ("lost", 0),
        ("at_infinity", 0),
        ("bound", 16),
    ] {
        assert_eq!(json[key], value, "{key}");
    }
    assert_eq!(json["seed"], 1);
    let first = &json["assemblies"][0];
    assert_eq!(first["mode"], 1);
    assert_eq!(first["certified"], true);
    assert!(first["radius"].as_f64().unwrap() > 0.0);
    assert!(first["joints"]["phi1"].is_f64() && first["platforms"]["top"].is_object());
    let text = answer(&["assemblies", THREE_RPS]);
    assert!(text.contains("8 real of 16 complex"), "{text}");
    assert!(
        text.contains("equals the known bound of 16 for this structure"),
        "{text}"
    );
}

#[test]
fn the_number_of_threads_does_not_show() {
    let with_threads = |threads: &str| {
        let mut command = linkwork();
        command.args(["assemblies", THREE_RPS, "--format", "json"]);
        command
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap()
            .stdout
    };
    assert_eq!(with_threads("1"), with_threads("3"));
}

#[test]
fn inputs_out_of_reach_are_a_no_with_a_closest_approach() {
    let output = run(&["assemblies", THREE_RPS, "--hold", "l1=3"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("0 real of 16 complex"));
    assert!(stdout(&output).contains("Closest approach: closure S1 has the widest gap"));
    let folded = run(&["solve", THREE_RPS, "--mode", "1", "--hold", "l1=3"]);
    assert_eq!(folded.status.code(), Some(1));
    assert!(stdout(&folded).contains("Mode 1 ceases to exist"));
    assert!(refusal(&["solve", THREE_RPS, "--mode", "9"]).contains("modes 1 to 8"));
    assert!(refusal(&["assemblies", FOUR_BAR, "--hold", "phi1=1"]).contains("1 too many"));
}

#[test]
fn stored_solutions_are_used_again_and_a_wrong_store_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let store = store.to_str().unwrap();
    let arguments = ["assemblies", THREE_RPS, "--store", store];
    assert_eq!(answer(&arguments), answer(&arguments));
    let other = run(&["assemblies", FOUR_BAR, "--store", store]);
    assert_eq!(other.status.code(), Some(0));
    assert!(stderr(&other).contains("another question"));
    std::fs::write(store, "nonsense").unwrap();
    assert!(refusal(&arguments).contains("does not hold stored solutions"));
}

#[test]
fn options_that_contradict_one_another_are_refused() {
    let platform = |more: &[&str]| refusal(&[&["solve", THREE_RPS], more].concat());
    for (options, named) in [
        (
            &["--hold", "l1=0.7", "--hold", "l1=0.8"][..],
            "`--hold l1=0.7` and `--hold l1=0.8`",
        ),
        (
            &["--hold", "l1=0.7", "--free", "l1"],
            "`--free l1` and `--hold l1=0.7`",
        ),
        (
            &["--guess", "phi1=1", "--guess", "phi1=2"],
            "`--guess phi1=1` and `--guess phi1=2`",
        ),
        (
            &["--hold", "top=[Tz(0.5)]", "--hold", "top.z=0.5"],
            "`--hold 'top=[Tz(0.5)]'` and `--hold top.z=0.5`",
        ),
        (
            &["--set", "a=2", "--set", "a=3"],
            "`--set a=2` and `--set a=3`",
        ),
    ] {
        let said = platform(options);
        let wanted = format!("error: {named} contradict one another");
        assert!(said.contains(&wanted), "{said}");
    }
    answer(&[
        "solve", THREE_RPS, "--free", "actuated", "--hold", "l1=0.7", "--hold", "l2=0.7", "--hold",
        "l3=0.7",
    ]);
}

#[test]
fn what_is_held_too_much_is_named_for_whole_poses_too() {
    let said = refusal(&[
        "solve",
        THREE_RPS,
        "--free",
        "actuated",
        "--hold",
        "top=[Tz(0.5)]",
    ]);
    assert!(said.contains("do not hold top."), "{said}");
}

#[test]
fn a_joint_used_nowhere_is_neither_hinge_nor_slide() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let text = r#"Mechanism(version: 1, name: "arm", convention: Modified,
        joints: { "q": Actuated(), "idle": Passive(home: 0.5) },
        chains: { "c": Chain(rows: [(theta: "q")]) })"#;
    std::fs::write(&file, text).unwrap();
    let path = file.path().to_str().unwrap();
    let shown = answer(&["check", path]);
    let line = shown
        .lines()
        .find(|line| line.trim().starts_with("idle"))
        .unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(words, ["idle", "unused", "passive", "0.5", "none"]);
    let joints = &json(&["check", path])["joints"];
    assert_eq!(joints[0]["unit"], "rad");
    assert!(joints[1]["unit"].is_null());
    let said = stderr(&run(&["check", path]));
    assert!(
        said.contains("uses the joint `idle`") && !said.contains("moves no closure"),
        "{said}"
    );
}

#[test]
fn formulas_are_written_in_every_script_and_unknown_frames_are_refused() {
    let of = ["formulas", FOUR_BAR, "--of", "left"];
    let with = |option: &[&str]| answer(&[&of[..], option].concat());
    assert!(with(&[]).contains("l₁ cos θ₁ + l₂ cos(θ₁ + φ₂)"));
    assert_eq!(with(&[]), with(&["--unicode"]));
    assert!(with(&["--latex"]).contains("l_{1} \\, \\cos \\theta_{1}"));
    assert!(with(&["--ron"]).contains("\"l1*cos(theta1) + l2*cos(theta1 + phi2)\""));
    assert!(with(&["--rust"]).contains("pub fn left_in_ground(l1: f64, l2: f64,"));
    let json: Value = serde_json::from_str(&with(&["--format", "json"])).unwrap();
    let x = &json["transforms"][0]["position"][0];
    assert_eq!(x, "l1*cos(theta1) + l2*cos(theta1 + phi2)");
    for (arguments, complaint) in [
        (&["--of", "lfet"][..], "did you mean `left`?"),
        (&["--of", "left", "--in", "left.7"], "is not a frame"),
        (&["--in", "left"], "add --of FRAME"),
        (&["--latex", "--rust"], "cannot be used with"),
    ] {
        let output = run(&[&["formulas", FOUR_BAR], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(complaint), "{}", stderr(&output));
    }
}

#[test]
fn a_drawing_goes_to_stdout_and_shows_every_mode() {
    let held = ["--hold", "theta1=60deg"];
    let one = answer(&[&["draw", FOUR_BAR], &held[..]].concat());
    assert!(one.starts_with("<svg") && one.trim_end().ends_with("</svg>"));
    let both = answer(&[&["draw", FOUR_BAR, "--all-modes"], &held[..]].concat());
    assert!(both.contains(": mode 1") && both.contains(": mode 2") && !both.contains(": mode 3"));
    let second = answer(&[&["draw", FOUR_BAR, "--mode", "2"], &held[..]].concat());
    assert!(second.contains(": mode 2") && !second.contains(": mode 1"));
    let refused = refusal(&["draw", FOUR_BAR, "--mode", "3"]);
    assert!(refused.contains("modes 1 to 2"), "{refused}");
    assert!(refusal(&["draw", FOUR_BAR, "--view", "left"]).contains("a view is `iso`"));
}

#[test]
fn a_rate_of_a_joint_that_is_misspelt_gets_the_name_that_was_meant() {
    let sweep = |report: &str| {
        refusal(&[
            "sweep",
            FOUR_BAR,
            "--input",
            "theta1=0..1",
            "--report",
            report,
        ])
    };
    let joint = sweep("velocity:ph1");
    assert!(
        joint.contains("`ph1` is neither a frame nor a joint"),
        "{joint}"
    );
    assert!(joint.contains("did you mean `phi1`?"), "{joint}");
    assert!(sweep("velocity:lefft").contains("did you mean `left`?"));
}

#[test]
fn a_joint_that_passes_no_moment_is_drawn_without_one() {
    let drawn = |file: &str| answer(&["draw", file, "--wrench", "top=0,50,-100"]);
    // every leg of a 6-UPS has a ball and a universal joint: it passes a force along itself
    let balls = drawn("mechanisms/stewart_gough_6ups.ron");
    assert!(balls.contains(" N<") && !balls.contains("N·m"), "{balls}");
    // the hinges of a 3-RPS pass moments across their axes
    assert!(drawn(THREE_RPS).contains("N·m"));
}

#[test]
fn a_base_on_two_bearings_is_a_bar_between_them() {
    // the bar is drawn in pieces; the triad in the corner has thinner lines
    let length = |arguments: &[&str]| -> f64 {
        let svg = answer(&[&["draw"], arguments].concat());
        let bars = svg.split("<polyline points=\"").skip(1);
        let bars = bars.filter(|of| of.contains("stroke=\"#666666\" stroke-width=\"2\""));
        let ends = bars.map(|of| {
            let points = of.split('"').next().unwrap().split([' ', ',']);
            points.map(|x| x.parse().unwrap()).collect::<Vec<f64>>()
        });
        ends.map(|of| (of[2] - of[0]).hypot(of[3] - of[1])).sum()
    };
    // its bearings are the farther apart the longer its ground link is
    let bennett = length(&["mechanisms/bennett.ron"]);
    assert!(bennett > 100.0, "{bennett}");
    assert!(length(&[FOUR_BAR, "--view", "iso"]) > 100.0);
    // in its plane a linkage has the symbol of ground at each pin
    assert_eq!(length(&[FOUR_BAR]), 0.0);
}

#[test]
fn pictures_are_written_whole_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [svg, png, glb, animated] = ["a.svg", "a.png", "a.glb", "a.gif"].map(file);
    let drawn = [
        "draw",
        FOUR_BAR,
        "--trace",
        "left+-1.5,1",
        "--svg",
        &svg,
        "--png",
        &png,
        "--glb",
        &glb,
    ];
    assert_eq!(answer(&drawn), "");
    let moved = [
        "sweep",
        FOUR_BAR,
        "--input",
        "theta1=0deg..90deg",
        "--steps",
        "5",
        "--animate",
        &animated,
    ];
    assert!(answer(&moved).contains("complete"));
    let begins = |path: &str, with: &[u8]| std::fs::read(path).unwrap().starts_with(with);
    assert!(begins(&svg, b"<svg") && begins(&png, b"\x89PNG\r\n\x1a\n"));
    assert!(begins(&glb, b"glTF") && begins(&animated, b"GIF89a"));
    // nothing is left beside them
    assert_eq!(folder.path().read_dir().unwrap().count(), 4);
    let refused = refusal(&["draw", FOUR_BAR, "--png", &file("nowhere/a.png")]);
    assert!(refused.contains("cannot be written"), "{refused}");
    let refused = refusal(&["draw", FOUR_BAR, "--trace", "nobody"]);
    assert!(
        refused.contains("--trace nobody") && refused.contains("the frames are"),
        "{refused}"
    );
    let refused = refusal(&["draw", "mechanisms/five_bar.ron", "--trace", "left"]);
    assert!(refused.contains("hold 1 coordinate more"), "{refused}");
}

#[test]
fn a_map_marks_the_assembly_that_a_guess_leads_to() {
    let map = [FOUR_BAR, "--map", "theta1=30deg..100deg", "--grid", "8"];
    let mode = |guess: &[&str]| {
        let report = json(&[&["workspace"], &map[..], guess].concat());
        report["home"]["mode"].as_u64().unwrap()
    };
    let home = mode(&[]);
    assert_eq!(mode(&["--guess", "phi1=130 deg"]), home);
    assert_ne!(mode(&["--guess", "phi1=-150 deg"]), home);
}

#[test]
fn rounding_beside_large_forces_is_printed_as_zero() {
    let excavator = "mechanisms/axes/excavator.ron";
    let forces = |force: &str| answer(&["statics", excavator, "--wrench", force]);
    let bucket = |force: &str| format!("bucket={force},0,0");
    assert!(!forces(&bucket("10000")).contains("e-1"));
    // which is not rounding where it is all there is
    assert!(forces(&bucket("1e-9")).contains("e-"));
}

/// On a terminal, which `script` of util-linux makes.
#[test]
fn the_line_of_progress_never_counts_beyond_its_total() {
    let program = linkwork().get_program().to_owned();
    let map = "workspace mechanisms/planar_3rpr.ron --grid 70 --hold platform.yaw=0.1 \
               --map platform.x=-2..3 --map platform.y=-2..3";
    let watched = format!("{} {map}", program.display());
    let mut terminal = Command::new("script");
    terminal
        .args(["-qec", &watched, "/dev/null"])
        .env("TERM", "xterm");
    let Ok(output) = terminal.output() else {
        eprintln!("skipped: no `script` is here");
        return;
    };
    assert!(output.status.success());
    let shown = stdout(&output);
    let number = |text: &str| text.replace(',', "").parse::<u64>().ok();
    let counts: Vec<(u64, u64)> = (shown.split('\r'))
        .filter_map(|line| line.split_once(" of ").zip(line.rsplit_once(" left ")))
        .filter_map(|((before, after), _)| {
            let done = number(before.rsplit(' ').next()?)?;
            Some((done, number(after.split(", ").next()?)?))
        })
        .collect();
    assert!(!counts.is_empty(), "{shown}");
    assert!(counts.iter().all(|(done, of)| done <= of), "{counts:?}");
}
