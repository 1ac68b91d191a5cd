//! Bodies: their names, and their frames where the axes of joints are nearly parallel.
#![cfg(feature = "cli")]

use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use serde_json::Value;

use crate::linkwork;

/// A file of this test alone.
fn written(name: &str, text: &str) -> String {
    let path = std::env::temp_dir().join(format!("linkwork-{}-{name}", std::process::id()));
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn answer(arguments: &[&str]) -> Value {
    let (code, out, err) = linkwork(&[arguments, &["--format", "json"]].concat());
    assert_eq!(code, 0, "{err}");
    serde_json::from_str(&out).unwrap()
}

/// Quaternions of six digits put the axes of the arm 7e-6 rad apart, and their common normals 13 km away.
#[test]
#[cfg(feature = "interchange")]
fn nearly_parallel_axes_keep_the_size_of_the_machine() {
    let file = written("near_parallel.ron", "");
    std::fs::remove_file(&file).unwrap();
    let (code, _, err) = linkwork(&[
        "import",
        "tests/exchange/near_parallel.xml",
        "--output",
        &file,
    ]);
    assert_eq!(code, 0, "{err}");
    let mobility = answer(&["mobility", &file]);
    assert_eq!(
        (&mobility["mobility"], &mobility["infinitesimal"]),
        (&13.into(), &13.into())
    );
    assert!(mobility["normalising_length"].as_f64().unwrap() < 2.0);
    let solved = answer(&["solve", &file, "--hold", "crank0=0.3"]);
    for (joint, value) in [
        ("rod0", -0.31379264957810193),
        ("foot0", 0.2117678447468777),
    ] {
        let found = solved["joints"][joint].as_f64().unwrap();
        assert!((found - value).abs() < 1e-9, "{joint} {found}");
    }
    let _ = std::fs::remove_file(file);
}

/// A four-bar in a vertical plane turned by 120°, with six digits as printf writes them: two axes are given in the frame of the
/// model, two in those of links turned by 2.0944, 5e-6 rad apart. Ten times that is no rounding.
#[test]
#[cfg(feature = "interchange")]
fn angles_above_one_are_off_by_more_than_lengths_below() {
    let text = |turn: &str| {
        let link = |name: &str, pose: &str| {
            format!("<link name=\"{name}\"><pose>{pose} 0 0 {turn}</pose></link>")
        };
        let joint = |name: &str, ends: [&str; 2], axis: &str| {
            let [parent, child] = ends;
            format!(
                "<joint name=\"{name}\" type=\"revolute\"><parent>{parent}</parent><child>{child}</child><axis>{axis}</axis></joint>"
            )
        };
        let of_model =
            "<xyz>-0.866025 -0.5 0</xyz><use_parent_model_frame>1</use_parent_model_frame>";
        let of_link = "<xyz>0 1 0</xyz>";
        [
            "<sdf version=\"1.6\"><model name=\"bars\">".to_owned(),
            link("crank", "0 0 0"),
            link("coupler", "0 0 0.3"),
            link("rocker", "-0.3 0.519615 0"),
            "<link name=\"pin\"><pose>-0.25 0.433013 0.4 0 0 0</pose></link>".to_owned(),
            joint("A", ["world", "crank"], of_model),
            joint("B", ["crank", "coupler"], of_link),
            joint("C", ["rocker", "pin"], of_model),
            joint("D", ["world", "rocker"], of_link),
            "<joint name=\"F\" type=\"fixed\"><parent>coupler</parent><child>pin</child></joint>"
                .to_owned(),
            "</model></sdf>".to_owned(),
        ]
        .concat()
    };
    for (turn, freedoms) in [("2.0944", 1), ("2.09445", 0)] {
        let (file, made) = (written("bars.sdf", &text(turn)), written("bars.ron", ""));
        std::fs::remove_file(&made).unwrap();
        let (code, _, err) = linkwork(&["import", &file, "--output", &made]);
        assert_eq!(code, 0, "{err}");
        assert_eq!(err.contains("within the rounding"), freedoms == 1, "{err}");
        assert_eq!(answer(&["mobility", &made])["mobility"], freedoms);
        let _ = [file, made].map(std::fs::remove_file);
    }
}

/// A parallelogram is drawn with crank and rocker at 0, both outside: they are moved inside together, with the loop closed.
/// Where limits leave no such place, the loop is closed outside them.
#[test]
#[cfg(feature = "interchange")]
fn joints_that_move_together_are_moved_inside_together() {
    let text = |range: &str| {
        format!(
            r#"<mujoco><worldbody><body><joint name="crank" axis="0 1 0" range="-140 -30"/>
            <body pos="0.2 0 0"><joint name="coupler" axis="0 1 0"/><site name="b" pos="0.05 0 0.4"/></body></body>
            <body pos="0 0 0.4"><joint name="rocker" axis="0 1 0" range="{range}"/><site name="a" pos="0.2 0 0"/></body></worldbody>
            <equality><connect site1="a" site2="b"/></equality><actuator><motor joint="crank"/></actuator></mujoco>"#
        )
    };
    for (range, inside) in [("-140 -30", true), ("30 140", false)] {
        let (file, made) = (written("pair.xml", &text(range)), written("pair.ron", ""));
        std::fs::remove_file(&made).unwrap();
        let (code, _, err) = linkwork(&["import", &file, "--output", &made]);
        assert_eq!(code, 0, "{err}");
        let (code, out, _) = linkwork(&["solve", &made]);
        assert_eq!(
            (code == 0, out.contains("outside")),
            (inside, !inside),
            "{out}"
        );
        let _ = [file, made].map(std::fs::remove_file);
    }
}

/// A parallelogram drawn with a rod 1 µm too short, and closed 5 µrad outside the limit of the rocker: its home is moved inside,
/// not to the assembly far away that is within the limits.
#[test]
#[cfg(feature = "interchange")]
fn a_home_closed_just_outside_its_limits_is_moved_inside() {
    let text = r#"<mujoco><worldbody><body><joint name="crank" axis="0 1 0" range="-90 0"/>
        <body pos="0 0 -0.2"><joint name="coupler" axis="0 1 0" range="-90 90"/><site name="a" pos="0.06 0 0"/></body></body>
        <body pos="0.06 0 0"><joint name="rocker" axis="0 1 0" range="-90 0"/><site name="b" pos="0.000001 0 -0.2"/></body></worldbody>
        <equality><connect site1="a" site2="b"/></equality><actuator><motor joint="crank"/></actuator></mujoco>"#;
    let (file, made) = (written("near.xml", text), written("near.ron", ""));
    std::fs::remove_file(&made).unwrap();
    let (code, _, err) = linkwork(&["import", &file, "--output", &made]);
    assert_eq!(code, 0, "{err}");
    let solved = answer(&["solve", &made]);
    for joint in ["crank", "rocker"] {
        let value = solved["joints"][joint].as_f64().unwrap();
        // inside but for the rounding of a solved configuration
        assert!((-0.6..=1e-9).contains(&value), "{joint} {value} {err}");
    }
    let _ = [file, made].map(std::fs::remove_file);
}

const NAMED: &str = r#"Mechanism(version: 1, name: "named links", convention: Modified, joints: {
        "t": Actuated(home: "60 deg"), "p": Passive(home: "-80 deg"), "r": Passive(home: "100 deg"),
    }, chains: {
        "left": Chain(rows: [(theta: "t", link: "crank"), (a: 1, theta: "p", link: "coupler")], tip: [Tx(3)]),
        "right": Chain(base: [Tx(3)], rows: [(theta: "r", link: "rocker")], tip: [Tx(2)]),
        "mark": Chain(on: "coupler", base: [T(1, 0.5, 0)]),
    }, closures: { "pin": Revolute("left", "right") })"#;

#[test]
fn links_have_names_that_options_take() {
    let file = written("named.ron", NAMED);
    let checked = answer(&["check", &file]);
    let names = |of: &Value| -> Vec<String> {
        let bodies = of["bodies"].as_array().unwrap().iter();
        bodies
            .map(|body| body["name"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(names(&checked), ["ground", "crank", "coupler", "rocker"]);
    let coupler = &checked["bodies"][2];
    assert_eq!(coupler["joints"], serde_json::json!(["p", "pin"]));
    assert_eq!(coupler["frames"], serde_json::json!(["left", "mark"]));
    let point = |name: &str| {
        answer(&["velocity", &file, "--rate", "t=1", "--point", name])["frames"].clone()
    };
    let (by_name, by_number) = (point("coupler+1,0.5"), point("left.2+1,0.5"));
    assert_eq!(by_name[0]["velocity"], by_number[0]["velocity"]);
    // a name given twice points at both, an unknown one at what was meant
    let twice = NAMED.replace("link: \"rocker\"", "link: \"left\"");
    let (code, _, err) = linkwork(&["check", &written("twice.ron", &twice)]);
    assert!(code == 2 && err.contains("`left`"), "{err}");
    let wrong = NAMED.replace("on: \"coupler\"", "on: \"copler\"");
    let (code, _, err) = linkwork(&["check", &written("wrong.ron", &wrong)]);
    assert!(
        code == 2 && err.contains("did you mean `coupler`?"),
        "{err}"
    );
}

#[test]
fn shipped_files_name_every_body() {
    let checked = answer(&["check", "mechanisms/three_rps.ron"]);
    let bodies = checked["bodies"].as_array().unwrap();
    let (_, mechanism) = {
        let text = std::fs::read_to_string("mechanisms/three_rps.ron").unwrap();
        let description = Description::read(&text).unwrap();
        (text, Mechanism::new(&description).unwrap())
    };
    assert_eq!(bodies.len(), mechanism.bodies().len());
    for body in bodies {
        assert!(mechanism.frame(body["name"].as_str().unwrap()).is_some());
    }
}

/// A file with names keeps them where it is written again, cut elsewhere, and in the other convention.
#[test]
fn names_of_links_survive_conversions() {
    let file = written("convert.ron", NAMED);
    for how in [
        &["--cut", "p"][..],
        &["--cut", "t"],
        &["--convention", "standard"],
    ] {
        let (code, out, err) = linkwork(&[&["convert", &file], how].concat());
        assert_eq!(code, 0, "{err}");
        let other = Mechanism::new(&Description::read(&out).unwrap()).unwrap();
        for name in ["crank", "coupler", "rocker"] {
            let frame = other
                .frame(name)
                .unwrap_or_else(|| panic!("{how:?} {name}\n{out}"));
            assert_eq!(other.body_name(other.body(frame)), name, "{how:?}");
        }
    }
}
