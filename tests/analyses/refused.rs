//! What is asked too much, in other words than usual, or of a mechanism in which nothing is free.
#![cfg(feature = "cli")]

use crate::linkwork;

const FOUR_BAR: &str = "mechanisms/four_bar.ron";

/// A file of this test alone.
fn written(name: &str, text: &str) -> String {
    let path = std::env::temp_dir().join(format!("linkwork-{}-{name}", std::process::id()));
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Everything is driven: |(3 cos 60°, 3 sin 60°) − (5, 0)| = √19.
#[test]
fn a_mechanism_in_which_nothing_is_free_is_answered() {
    let arm = r#"joints: { "q": Actuated(home: "60 deg") }, chains: { "arm": Chain(rows: [(theta: "q")], tip: [Tx(3)]),"#;
    let bare = r#"chains: { "arm": Chain(tip: [Tx(3)]),"#;
    let mut answers = Vec::new();
    for (moving, far, closure) in [
        (arm, "Tx(5)", r#"Revolute("arm", "post")"#),
        (arm, "Tx(5)", r#"Spherical("arm", "post")"#),
        (arm, "Tx(5)", r#"Distance("arm", "post", 1)"#),
        (
            arm,
            r#"T(1.5, "1.5*sqrt(3)", 0)"#,
            r#"Revolute("arm", "post")"#,
        ),
        (bare, "Tx(5)", r#"Revolute("arm", "post")"#),
        (bare, "Tx(3)", r#"Revolute("arm", "post")"#),
    ] {
        let file = written(
            "fixed.ron",
            &format!(
                r#"Mechanism(version: 1, name: "fixed", convention: Modified,
                {moving} "post": Chain(base: [{far}]) }}, closures: {{ "pin": {closure} }})"#
            ),
        );
        for command in [
            "solve",
            "assemblies",
            "mobility",
            "velocity",
            "statics",
            "singularities",
            "check",
            "formulas",
            "compare",
            "frames",
        ] {
            let (code, out, err) = linkwork(&[command, &file]);
            assert!(
                (0..=2).contains(&code),
                "{command} {moving} {closure}: {code} {err}"
            );
            if command == "solve" {
                answers.push((code, out));
            }
        }
    }
    let open = "Cannot be assembled with these inputs: nothing is free, and closure pin is open by 4.358899 m.";
    assert!(
        answers[0].0 == 1 && answers[0].1.contains(open),
        "{answers:?}"
    );
    let codes: Vec<i32> = answers.iter().map(|(code, _)| *code).collect();
    // where it closes it is a structure, of which nothing may be held
    assert_eq!(codes[..3], [1; 3]);
}

#[test]
fn more_than_can_be_kept_or_waited_for_is_refused() {
    let study = ["study", FOUR_BAR, "--vary", "l2=3..5", "--quantity", "phi1"];
    let two = [&study[..], &["--vary", "theta1=0..1"]].concat();
    let many = "10000000000";
    let product = format!("{many},{many}");
    for (arguments, said) in [
        (
            [&study[..], &["--grid", many]].concat(),
            "10000000000 rows at once are too many",
        ),
        (
            [&study[..], &["--grid", many]].concat(),
            "in 1000 shards or more",
        ),
        (
            [&study[..], &["--samples", "4000000000"]].concat(),
            "4000000000 rows at once",
        ),
        (
            [&study[..], &["--samples", many]].concat(),
            "2³² of Sobol's",
        ),
        (
            [&two[..], &["--grid", "100000,100000"]].concat(),
            "10000000000 rows at once",
        ),
        (
            [&two[..], &["--grid", &product]].concat(),
            "no more than can be counted",
        ),
        (
            vec!["sweep", FOUR_BAR, "--input", "theta1=0..1e9deg"],
            "theta1=0deg..360deg",
        ),
        (
            vec!["sweep", FOUR_BAR, "--input", "theta1=1e9deg..0"],
            "would turn 2777778 times",
        ),
        (
            vec!["singularities", FOUR_BAR, "--input", "theta1=0..1e9deg"],
            "at most 10000 turns",
        ),
    ] {
        let (code, _, err) = linkwork(&arguments);
        assert!(
            code == 2 && err.contains(said),
            "{arguments:?}: {code} {err}"
        );
    }
    // a shard of it is computed
    let part = [&study[..], &["--grid", many, "--shard", "7/10000000000"]].concat();
    let (code, out, err) = linkwork(&part);
    let rows = out.lines().filter(|line| !line.starts_with('#'));
    assert!(code == 0 && rows.count() == 2, "{err}");
}

#[test]
fn values_of_a_study_are_read_as_those_of_a_parameter() {
    let study = |options: &[&str]| {
        let asked = [&["study", FOUR_BAR, "--quantity", "phi1"], options].concat();
        linkwork(&asked)
    };
    for (plain, with_units) in [
        (
            ["--vary", "l2=3..3.5", "--grid", "3"],
            ["--vary", "l2=3 m..350 cm", "--grid", "3"],
        ),
        (
            ["--deviate", "l2=0.0001", "--samples", "5"],
            ["--deviate", "l2=0.1 mm", "--samples", "5"],
        ),
        (
            ["--vary", "theta1=10deg..50deg", "--grid", "3"],
            ["--vary", "theta1=10°..50°", "--grid", "3"],
        ),
    ] {
        let (plain, with_units) = (study(&plain), study(&with_units));
        assert_eq!((plain.0, &plain.1), (0, &with_units.1), "{}", with_units.2);
    }
    for wrong in ["l2=30 deg..40 deg", "l2=3°..4°", "theta1=1 mm..2 mm"] {
        let (code, _, err) = study(&["--vary", wrong, "--grid", "3"]);
        assert!(code == 2 && err.contains("expected"), "{wrong}: {err}");
    }
    let solved = |hold: &str| linkwork(&["solve", FOUR_BAR, "--hold", hold]);
    assert_eq!(solved("theta1=60 deg").1, solved("theta1=60°").1);
    assert_eq!(solved("theta1=60 deg").1, solved("theta1=2*30 °").1);
}

#[test]
fn a_file_whose_name_ends_otherwise_is_not_written() {
    let folder = std::env::temp_dir().join(format!("linkwork-{}-endings", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let input = ["--input", "theta1=0deg..90deg"];
    for (arguments, wrong, right) in [
        (vec!["draw", FOUR_BAR, "--svg"], "a.png", "a.svg"),
        (vec!["draw", FOUR_BAR, "--png"], "a.SVG", "a.PNG"),
        (vec!["draw", FOUR_BAR, "--glb"], "a.gltf", "a.glb"),
        (
            [&["sweep", FOUR_BAR], &input[..], &["--svg"]].concat(),
            "a.gif",
            "a",
        ),
        (
            [&["sweep", FOUR_BAR], &input[..], &["--animate"]].concat(),
            "a.png",
            "a.gif",
        ),
        (
            vec!["export", FOUR_BAR, "--to", "mjcf", "--output"],
            "a.urdf",
            "a.xml",
        ),
        (
            vec!["generate", FOUR_BAR, "--lang", "c", "--output"],
            "a.rs",
            "a.h",
        ),
        (vec!["view", FOUR_BAR, "--output"], "a.svg", "a.html"),
        (
            vec![
                "study", FOUR_BAR, "--vary", "l2=3..4", "--grid", "2", "--output",
            ],
            "a.json",
            "a.csv",
        ),
    ] {
        for (name, fits) in [(wrong, false), (right, true)] {
            let path = folder.join(name);
            let (code, _, err) = linkwork(&[&arguments[..], &[path.to_str().unwrap()]].concat());
            assert_eq!(
                code,
                if fits { 0 } else { 2 },
                "{arguments:?} {name}: {err}"
            );
            assert!(fits || err.contains("the name ends in"), "{err}");
            assert_eq!(path.exists(), fits, "{arguments:?} {name}");
            let _ = std::fs::remove_file(path);
        }
    }
    std::fs::remove_dir_all(folder).unwrap();
}

/// A chain, a star and a chain of followers: n links are read in a time that grows with n, not with its square (10⁵ links
/// compared pairwise would take minutes).
#[test]
fn models_of_many_links_are_imported() {
    let count = 20_000;
    let model = |parent: &dyn Fn(usize) -> usize, more: &dyn Fn(usize) -> String| {
        let mut text = r#"<robot name="many"><link name="l0"/>"#.to_owned();
        for i in 1..=count {
            text += &format!(
                r#"<link name="l{i}"/><joint name="j{i}" type="continuous"><parent link="l{}"/><child link="l{i}"/>
                <origin xyz="0.1 0 0"/><axis xyz="0 0 1"/>{}</joint>"#,
                parent(i),
                more(i)
            );
        }
        text + "</robot>"
    };
    let none = |_| String::new();
    let follows = |i: usize| match i {
        1 => String::new(),
        _ => format!(r#"<mimic joint="j{}"/>"#, i - 1),
    };
    for (name, text, joints) in [
        ("chain", model(&|i| i - 1, &none), count),
        ("star", model(&|_| 0, &none), count),
        ("followers", model(&|_| 0, &follows), 1),
    ] {
        let file = written(&format!("{name}.urdf"), &text);
        let (code, out, err) = linkwork(&["import", &file]);
        std::fs::remove_file(file).unwrap();
        assert_eq!(code, 0, "{name}: {err}");
        assert_eq!(out.matches("Actuated(").count(), joints, "{name}");
    }
}
