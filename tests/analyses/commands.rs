//! Commands from end to end: help that can be followed, values kept as given, exit statuses.
#![cfg(feature = "cli")]

use serde_json::Value;

use crate::linkwork;

const FOUR_BAR: &str = "mechanisms/four_bar.ron";
const THREE_RPS: &str = "mechanisms/three_rps.ron";

fn json(arguments: &[&str]) -> Value {
    let (_, out, err) = linkwork(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str(&out).unwrap_or_else(|_| panic!("{arguments:?}: {err}"))
}

/// The options that a help names behind `e.g.`.
fn proposed(help: &str) -> Vec<String> {
    let (_, options) = help.split_once("e.g. ").unwrap_or_else(|| panic!("{help}"));
    let options = options.lines().next().unwrap();
    let options = options.split(';').next().unwrap();
    options
        .split_whitespace()
        .map(|word| word.trim_matches('\'').to_owned())
        .collect()
}

#[test]
fn a_motion_begins_exactly_at_the_value_given() {
    let (code, out, _) = linkwork(&[
        "sweep",
        FOUR_BAR,
        "--input",
        "theta1=0..1",
        "--format",
        "csv",
    ]);
    assert_eq!(code, 0);
    let mut lines = out.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = header
        .iter()
        .position(|name| name.starts_with("theta1"))
        .unwrap();
    let values: Vec<f64> = (lines.map(|line| line.split(',').nth(column).unwrap()))
        .map(|value| value.parse().unwrap())
        .collect();
    assert_eq!((values[0], *values.last().unwrap()), (0.0, 1.0));
}

#[test]
fn whole_turns_of_a_guess_are_kept() {
    let phi2 = |guess: &[&str]| {
        let report = json(&[&["solve", FOUR_BAR], guess].concat());
        report["joints"]["phi2"].as_f64().unwrap()
    };
    let home = phi2(&[]);
    for (guess, turns) in [
        ("phi2=348deg", 1.0),
        ("phi2=-372deg", -1.0),
        ("phi2=-12deg", 0.0),
    ] {
        let found = phi2(&["--guess", guess]) - home;
        assert!(
            (found / std::f64::consts::TAU - turns).abs() < 1e-9,
            "{guess}: {found}"
        );
    }
}

#[test]
fn a_file_that_cannot_be_assembled_is_no_success() {
    for command in ["mobility", "velocity", "statics", "singularities"] {
        let (code, out, err) = linkwork(&[command, THREE_RPS, "--set", "a=3"]);
        assert_eq!(code, 1, "{command}: {out}{err}");
        let (code, ..) = linkwork(&[command, THREE_RPS]);
        assert_eq!(code, 0, "{command}");
    }
}

#[test]
fn the_measure_of_a_closest_approach_is_stated() {
    let squared = "counts as (d² − L²)/2";
    for command in ["solve", "assemblies"] {
        let (code, out, _) = linkwork(&[
            command,
            "mechanisms/stewart_gough_6sps.ron",
            "--hold",
            "l1=30",
        ]);
        assert!(code == 1 && out.contains(squared), "{command}: {out}");
        let (code, out, _) = linkwork(&[command, THREE_RPS, "--hold", "l1=3"]);
        assert!(code == 1 && !out.contains(squared), "{command}: {out}");
    }
}

#[test]
fn help_is_followed_in_one_step() {
    let begun: [&[&str]; 4] = [
        &["sweep", THREE_RPS, "--circuits"],
        &["sweep", THREE_RPS, "--circuits", "--hold", "top.z=0.5"],
        &["sweep", THREE_RPS, "--follow"],
        // with l1 at 0.6 m the file's 0.9 m of another leg may close or not: what is proposed does
        &[
            "velocity", THREE_RPS, "--free", "actuated", "--hold", "l1=0.4",
        ],
    ];
    for arguments in begun {
        let (code, _, help) = linkwork(arguments);
        assert_eq!(code, 2, "{arguments:?}");
        let more = proposed(&help);
        let more: Vec<&str> = more.iter().map(String::as_str).collect();
        let (code, _, err) = linkwork(&[arguments, &more[..]].concat());
        assert_ne!(code, 2, "{arguments:?} {more:?}: {err}");
        assert!(
            !err.contains("does not assemble"),
            "{arguments:?} {more:?}: {err}"
        );
    }
    // what was freed and has to be held was freed in vain
    let (code, _, err) = linkwork(&["velocity", THREE_RPS, "--free", "l3"]);
    assert!(code == 2 && err.contains("leave out --free l3"), "{err}");
    let (code, ..) = linkwork(&["velocity", THREE_RPS]);
    assert_eq!(code, 0);
}

#[test]
fn whether_mobility_depends_on_the_assembly_does_not_depend_on_the_seed() {
    let mut elsewhere = 0;
    for name in [
        "parallelogram",
        "two_rhombi",
        "bricard_plane",
        "three_rps",
        "sarrus",
    ] {
        let file = format!("mechanisms/{name}.ron");
        let of = |seed: &str| json(&["mobility", &file, "--seed", seed])["elsewhere"].clone();
        let first = of("1");
        for seed in ["2", "3", "77"] {
            assert_eq!(of(seed), first, "{name}, seed {seed}");
        }
        elsewhere += first.as_array().map_or(0, Vec::len);
    }
    assert!(elsewhere > 0);
}
