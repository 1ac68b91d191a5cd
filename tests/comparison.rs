//! What is said of closed forms that agree and that do not.
#![cfg(feature = "cli")]

use linkwork::analysis::compare::{CompareReport, CompareSettings, compare};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::comparison;

fn compared(text: &str) -> (Mechanism, CompareReport) {
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = compare(&mechanism, &CompareSettings::default());
    (mechanism, report)
}

const THREE_RPS: &str = include_str!("../mechanisms/three_rps.ron");

/// The file with the sign of S1's x coordinate wrong.
fn wrong() -> String {
    let wrong = THREE_RPS.replacen("(\"b - l1*cos(theta1)\"", "(\"b + l1*cos(theta1)\"", 1);
    assert_ne!(wrong, THREE_RPS);
    wrong
}

#[test]
fn all_agree() {
    let (mechanism, report) = compared(THREE_RPS);
    let text = comparison::text(&mechanism, &report);
    assert!(text.starts_with("3-RPS parallel manipulator: closed forms beside the chains\n\n"));
    assert!(text.ends_with("\nAll 6 closed forms agree with the chains (seed 1).\n"));
    for form in ["TL1", "T12", "S1", "S2", "S3", "closure"] {
        let row = text.lines().find(|line| line.trim().starts_with(form));
        let row = row.unwrap_or_else(|| panic!("no row for {form}:\n{text}"));
        assert!(
            row.contains("agrees") && row.contains("lecture 6, 52:44"),
            "{row}"
        );
    }
}

#[test]
fn a_wrong_sign_is_shown_with_its_component_and_joint_values() {
    let (mechanism, report) = compared(&wrong());
    let text = comparison::text(&mechanism, &report);
    insta::assert_snapshot!(
        text.split_once("\n\n")
            .unwrap()
            .1
            .split_once("\n\n")
            .unwrap()
            .1
    );
}

#[test]
fn json_says_the_same() {
    let (mechanism, report) = compared(&wrong());
    let json = comparison::json(&mechanism, &report);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["agree"], false);
    assert_eq!(json["seed"], 1);
    let forms = json["closed_forms"].as_array().unwrap();
    let names: Vec<&str> = forms.iter().map(|f| f["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["TL1", "T12", "S1", "S2", "S3", "closure"]);
    let s1 = &forms[2];
    assert_eq!(s1["agree"], false);
    assert_eq!(s1["verdict"], "disagrees");
    assert_eq!(s1["source"], "lecture 6, 52:44");
    assert_eq!(s1["samples"], 102);
    let worst = &s1["worst"];
    let (phi1, l1) = (
        worst["phi1"].as_f64().unwrap(),
        worst["l1"].as_f64().unwrap(),
    );
    let difference = 2.0 * l1 * phi1.sin().abs();
    assert!((s1["max_difference"].as_f64().unwrap() - difference).abs() < 1e-12);
    let components = s1["components"].as_array().unwrap();
    let agree: Vec<bool> = components
        .iter()
        .map(|c| c["agree"].as_bool().unwrap())
        .collect();
    assert_eq!(agree, [false, true, true]);
    // numbers survive the way through text
    let back: serde_json::Value = serde_json::from_str(&json.to_string()).unwrap();
    assert_eq!(back, json);
}

#[test]
fn a_file_without_closed_forms_says_so_and_agrees() {
    let (mechanism, report) = compared(include_str!("../mechanisms/dietmaier.ron"));
    assert!(report.agree);
    assert_eq!(
        comparison::text(&mechanism, &report),
        "Dietmaier's platform with 40 real postures: the file has no closed forms to compare.\n"
    );
}
