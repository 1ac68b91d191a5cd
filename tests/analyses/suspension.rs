//! A double-wishbone suspension: two arms on hinges, an upright with balls at both, a tie rod between
//! balls on the chassis and on the upright. However the rod is written, every command gives the
//! answers of the same suspension whose rod is a distance, which has no spin.

use std::f64::consts::FRAC_PI_2;

use linkwork::analysis::assemblies::{AssembliesReport, Assembly, Fit, Wanted};
use linkwork::analysis::assembly::AssemblySettings;
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::analysis::sweep::{Row, SweepEnd, SweepSettings};
use linkwork::analysis::workspace::WorkspaceSettings;
use linkwork::ask::{Question, Solved};
use linkwork::description::Description;
use linkwork::geometry::{Pose, Vector3};
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;

/// How the rod may be written, and how many sets of angles its balls have for each of its places: a
/// ball of three rows has two.
const MODELS: [(&str, usize); 6] = [
    ("distance", 1),
    ("platform", 1),
    ("platform aside", 1),
    ("chain", 2),
    ("inner ball cut", 2),
    ("halves", 4),
];

/// The suspension as it stands at home, where it is assembled.
fn suspension(model: &str) -> Mechanism {
    read(&written(model))
}

fn read(text: &str) -> Mechanism {
    let description = Description::read(text).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn written(model: &str) -> String {
    let ball = |[u, v, w]: [&str; 3]| {
        format!(
            r#"rows: [(theta: "{u}"), (alpha: "90 deg", theta: "{v} + 90 deg"),
               (alpha: "90 deg", theta: "{w}")]"#
        )
    };
    let joints = r#""u": Passive(home: "90 deg"), "v": Passive(home: "-slope"), "w": Passive(home: "20 deg"),"#;
    let more = r#""x": Passive(home: "-90 deg"), "y": Passive(home: "slope"), "z": Passive(home: "-20 deg"),"#;
    let inner = r#""inner": Chain(base: [T(-0.12, 0.05, 0.1)]),"#.to_owned();
    let from_inner = format!(r#"base: [T(-0.12, 0.05, 0.1)], {}"#, ball(["u", "v", "w"]));
    let from_outer = format!(r#"on: "upright.S", {}"#, ball(["x", "y", "z"]));
    let (joints, chains, platforms, closures) = match model {
        "distance" => (
            String::new(),
            inner,
            "",
            r#""rod": Distance("inner", "upright.S", "rod")"#,
        ),
        "platform" => (
            String::new(),
            inner,
            r#""tie": Platform(
                home: [T(-0.12, 0.2, 0.09), Rz("90 deg"), Ry("slope")],
                frames: { "A": [Tx("-rod/2")], "B": [Tx("rod/2")] },
            )"#,
            r#""in": Spherical("inner", "tie.A"), "out": Spherical("tie.B", "upright.S")"#,
        ),
        // a line that is no axis of the platform's own frame
        "platform aside" => (
            String::new(),
            inner,
            r#""tie": Platform(
                home: [T(-0.12, 0.05, 0.1), Rx("-slope"), Rz("atan2(0.6, 0.8)"), Ry("40 deg")],
                frames: { "A": [], "B": [Ry("-40 deg"), T("0.6*rod", "0.8*rod", 0)] },
            )"#,
            r#""in": Spherical("inner", "tie.A"), "out": Spherical("tie.B", "upright.S")"#,
        ),
        "chain" => (
            joints.to_owned(),
            format!(r#""tie": Chain({from_inner}, tip: [Tz("rod")]),"#),
            "",
            r#""out": Spherical("tie", "upright.S")"#,
        ),
        "inner ball cut" => (
            more.to_owned(),
            format!(r#"{inner} "tie": Chain({from_outer}, tip: [Tz("rod")]),"#),
            "",
            r#""in": Spherical("inner", "tie")"#,
        ),
        "halves" => (
            format!("{joints} {more}"),
            format!(
                r#""tie": Chain({from_inner}, tip: [Tz(0.1)]),
                "rest": Chain({from_outer}, tip: [Tz("rod - 0.1"), Rx("180 deg")]),"#
            ),
            "",
            r#""middle": Rigid("tie", "rest")"#,
        ),
        other => panic!("{other}"),
    };
    format!(
        r#"Mechanism(
            version: 1,
            name: "double wishbone, {model}",
            convention: Modified,
            parameters: {{
                "rod": "sqrt(0.3^2 + 0.02^2)", "slope": "atan2(0.02, 0.3)",
                "arm": "sqrt(0.28^2 + 0.02^2)",
            }},
            joints: {{
                "lower": Actuated(home: 0), "upper": Passive(home: "-atan2(0.02, 0.28)"), {joints}
            }},
            chains: {{
                "lower": Chain(
                    base: [Ry("90 deg"), Rz("90 deg")],
                    rows: [(theta: "lower")],
                    tip: [Tx(0.4)],
                ),
                "upper": Chain(
                    base: [T(0.02, 0.1, 0.3), Ry("90 deg"), Rz("90 deg")],
                    rows: [(theta: "upper")],
                    tip: [Tx("arm")],
                ),
                {chains}
            }},
            platforms: {{
                "upright": Platform(
                    home: [T(0, 0.4, 0)],
                    frames: {{ "L": [], "U": [T(0.02, -0.02, 0.28)], "S": [T(-0.12, -0.05, 0.08)] }},
                ),
                {platforms}
            }},
            closures: {{
                "lowerball": Spherical("lower", "upright.L"),
                "upperball": Spherical("upper", "upright.U"),
                {closures}
            }},
        )"#
    )
}

/// What is answered for the distance, then for each of the other models.
fn compared<T>(answer: impl Fn(&Mechanism, &str) -> T, same: impl Fn(&T, &T, &str, usize)) {
    let plain = answer(&suspension("distance"), "distance");
    for (model, sets) in &MODELS[1..] {
        same(&answer(&suspension(model), model), &plain, model, *sets);
    }
}

fn near(a: &[f64], b: &[f64], model: &str) {
    assert_eq!(a.len(), b.len(), "{model}");
    for (x, y) in a.iter().zip(b) {
        assert!(
            (x - y).abs() < 1e-8 * (1.0 + y.abs()),
            "{model}: {a:?} {b:?}"
        );
    }
}

/// Upper arm, then position and orientation of the upright, each quaternion with one sign.
fn places(report: &AssembliesReport) -> Vec<Vec<f64>> {
    let of = |a: &linkwork::analysis::assemblies::Assembly| {
        let upper = a
            .joints
            .0
            .iter()
            .find(|(name, _)| name == "upper")
            .unwrap()
            .1;
        let pose = &a
            .platforms
            .0
            .iter()
            .find(|(name, _)| name == "upright")
            .unwrap()
            .1;
        let sign = pose.quaternion[0].signum();
        let turn = pose.quaternion.map(|x| x * sign);
        [&[upper][..], &pose.position, &turn].concat()
    };
    let mut all: Vec<Vec<f64>> = report.assemblies.iter().map(of).collect();
    all.sort_by(|a, b| {
        let rounded = |x: &Vec<f64>| x.iter().map(|x| (x * 1e6).round()).collect::<Vec<_>>();
        rounded(a).partial_cmp(&rounded(b)).unwrap()
    });
    all
}

#[test]
fn one_freedom_is_counted_however_the_rod_is_written() {
    for (model, _) in MODELS {
        let question = Question::new(suspension(model));
        let report = question.mobility(&Watch::none()).unwrap().closed().unwrap();
        assert_eq!((report.mobility, report.infinitesimal), (1, 1), "{model}");
        assert_eq!(report.redundant, 0, "{model}");
    }
}

#[test]
fn the_assemblies_are_two_of_the_upper_arm_with_two_turns_of_the_upright_each() {
    let of = |mechanism: &Mechanism, model: &str| {
        let question = Question::new(mechanism.clone()).hold("lower", 0.1);
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        assert_eq!(report.fit, Fit::Finite, "{model}");
        assert!(report.continua.is_empty(), "{model}");
        report
    };
    // the ball at the upper arm is on a circle and a sphere about the lower ball, then the ball of the
    // tie rod on a circle about the line of both and a sphere about the inner ball
    let plain = of(&suspension("distance"), "distance");
    assert_eq!(plain.real, 4);
    compared(of, |found, plain, model, sets| {
        assert_eq!(found.real, plain.real * sets, "{model}");
        assert_eq!(found.poses.len(), plain.real, "{model}");
        let answer = found.document().answer;
        let counted = "4 assemblies: 4 real of 4 complex.";
        assert!(answer.starts_with(counted), "{model}: {answer}");
        let (found, plain) = (places(found), places(plain));
        for (k, place) in found.iter().enumerate() {
            near(place, &plain[k / sets], model);
        }
    });
}

/// Without a platform: the upright is the end of a chain with a ball of three rows.
#[test]
fn modes_that_differ_in_the_angles_of_a_ball_only_share_a_pose() {
    let whole = written("distance");
    let (rows, tip) = (r#"rows: [(theta: "lower")],"#, "tip: [Tx(0.4)],");
    let ball = r#"rows: [(theta: "lower"), (a: 0.4, theta: "u"), (alpha: "90 deg", theta: "v + 90 deg"),
        (alpha: "90 deg", theta: "w")],"#;
    let joints =
        r#""u": Passive(home: 0.3), "v": Passive(home: 0.2), "w": Passive(home: 0.1), "upper":"#;
    let points = r#""U": Chain(on: "lower.4", base: [T(0.02, -0.02, 0.28)]),
        "S": Chain(on: "lower.4", base: [T(-0.12, -0.05, 0.08)]), "upper": Chain("#;
    let platforms = whole.find("platforms: {").unwrap()..whole.find("closures: {").unwrap();
    let text = whole
        .replace(&whole[platforms], "")
        .replace(r#""lowerball": Spherical("lower", "upright.L"),"#, "")
        .replace("upright.", "")
        .replace(tip, "")
        .replace(rows, ball)
        .replace(r#""upper": Chain("#, points)
        .replace(r#""upper": Passive"#, &format!("{joints} Passive"));
    assert!(
        [ball, points, "on: \"lower.4\""]
            .iter()
            .all(|part| text.contains(part))
    );
    let all = |mechanism: Mechanism| {
        let question = Question::new(mechanism).hold("lower", 0.1);
        question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap()
    };
    let value = |a: &Assembly, name: &str| *a.joints.get(name).unwrap();
    let (report, plain) = (all(read(&text)), all(suspension("distance")));
    assert_eq!((report.real, plain.real), (8, 4));
    assert_eq!(report.positions.len(), 4);
    let mut uppers = Vec::new();
    for modes in &report.positions {
        let [a, b] = modes[..] else {
            panic!("{modes:?}");
        };
        let [a, b] = [a, b].map(|mode| &report.assemblies[mode - 1]);
        near(&[value(a, "upper")], &[value(b, "upper")], "chains");
        // (φ, θ, ψ) and (φ + π, −θ, ψ + π)
        for name in ["u", "w"] {
            assert!((value(a, name) - value(b, name)).sin().abs() < 1e-9);
        }
        let v = value(a, "v") + value(b, "v");
        assert!(v.sin().abs() < 1e-9, "{v}");
        uppers.push(value(a, "upper"));
    }
    let mut expected: Vec<f64> = plain.assemblies.iter().map(|a| value(a, "upper")).collect();
    uppers.sort_by(f64::total_cmp);
    expected.sort_by(f64::total_cmp);
    near(&uppers, &expected, "chains");
    let answer = report.document().answer;
    assert!(
        answer.starts_with("4 assemblies: 4 real of 4 complex. Each is listed with 2 sets"),
        "{answer}"
    );
}

#[test]
fn one_assembly_is_nearest_home_and_none_where_the_upper_arm_does_not_reach() {
    let of = |mechanism: &Mechanism, model: &str| {
        let solved = |lower: f64| {
            let question = Question::new(mechanism.clone()).hold("lower", lower);
            match question.solve(&AssemblySettings::default(), &Watch::none()) {
                Ok(Solved::Ended(report)) => report,
                other => panic!("{model}: {other:?}"),
            }
        };
        // with the lower ball 0.4 m below its hinge, the upper ball is to be 0.28 m from it and from the upper hinge,
        // which are 0.71 m apart
        assert!(!solved(-FRAC_PI_2).is_assembled(), "{model}");
        let report = solved(0.1);
        assert!(report.is_assembled(), "{model}");
        let at = report.configuration();
        let Pose { rotation, position } = at.platforms[0].pose();
        // the tie rod keeps its length
        let outer = position + rotation * Vector3([-0.12, -0.05, 0.08]);
        let rod = (outer - Vector3([-0.12, 0.05, 0.1])).norm();
        assert!((rod - 0.3f64.hypot(0.02)).abs() < 1e-9, "{model}: {rod}");
        let turned = rotation.0.map(|axis| axis.0).concat();
        [&at.joints[..2], &position.0, &turned[..]].concat()
    };
    compared(of, |found, plain, model, _| near(found, plain, model));
}

#[test]
fn a_bump_moves_the_upright_alike() {
    let of = |mechanism: &Mechanism, model: &str| {
        let question = Question::new(mechanism.clone()).input("lower", -0.3, 1.0);
        let settings = SweepSettings {
            steps: 20,
            ..SweepSettings::default()
        };
        let motions = question.motions(&settings, &Watch::none()).unwrap();
        let mut rows = Vec::new();
        let mut sink = |row: &Row| {
            let at = &row.configuration;
            let pose = at.platforms[0];
            rows.push([&at.joints[..2], &pose.position.0, &pose.orientation.0].concat());
        };
        let report = motions.run(&motions.starts[0].1, &mut sink, &Watch::none());
        assert_eq!(report.ending, SweepEnd::Complete, "{model}");
        rows
    };
    compared(of, |found, plain, model, _| {
        assert_eq!(found.len(), 21, "{model}");
        for (a, b) in found.iter().zip(plain) {
            near(a, b, model);
        }
    });
}

#[test]
fn circuits_are_as_many_and_as_wide() {
    let of = |mechanism: &Mechanism, model: &str| {
        let report = Question::new(mechanism.clone())
            .circuits(&Watch::none())
            .unwrap();
        assert_eq!(report.unusable, 0, "{model}");
        let ranges = report.circuits.iter().map(|circuit| {
            assert!(circuit.closed && circuit.whole, "{model}");
            let of = |name: &str| circuit.joints.iter().find(|j| j.name == name).unwrap();
            let (lower, upper) = (of("lower"), of("upper"));
            (
                circuit.branches.len(),
                vec![lower.low, lower.high, upper.low, upper.high],
            )
        });
        let mut ranges: Vec<(usize, Vec<f64>)> = ranges.collect();
        ranges.sort_by(|a, b| a.partial_cmp(b).unwrap());
        ranges
    };
    compared(of, |found, plain, model, _| {
        // sets of angles of a ball make no circuits of their own
        assert_eq!(found.len(), plain.len(), "{model}");
        let branches = |of: &[(usize, Vec<f64>)]| of.iter().map(|c| c.0).sum::<usize>();
        assert_eq!(branches(found), branches(plain), "{model}");
        for (_, range) in found {
            let known = |(_, other): &(usize, Vec<f64>)| {
                range.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-6)
            };
            assert!(plain.iter().any(known), "{model}: {range:?}");
        }
    });
}

#[test]
fn singularities_on_the_way_are_met_at_the_same_places() {
    let of = |mechanism: &Mechanism, _: &str| {
        let question = Question::new(mechanism.clone())
            .input("lower", 0.3, -1.0)
            .output("upright");
        let report = question
            .along(&SingularitiesSettings::default(), &Watch::none())
            .unwrap();
        let mut met: Vec<f64> = report.crossings.iter().map(|c| c.moved[0]).collect();
        met.push(report.part);
        met
    };
    compared(of, |found, plain, model, _| near(found, plain, model));
}

#[test]
fn the_upright_moves_at_the_same_rates_and_needs_the_same_torque() {
    let of = |mechanism: &Mechanism, _: &str| {
        let question = Question::new(mechanism.clone());
        let driven = question.clone().rate("lower", 1.0);
        let velocity = driven.velocity(&Watch::none()).unwrap().closed().unwrap();
        let upright = velocity
            .frames
            .iter()
            .find(|f| f.name == "upright")
            .unwrap();
        let loaded = question.wrench("upright", [100.0, 20.0, 3000.0], [5.0, 0.0, 40.0]);
        let statics = loaded.statics(&Watch::none()).unwrap().closed().unwrap();
        assert!(statics.balanced);
        let [torque] = &statics.actuators[..] else {
            panic!("{:?}", statics.actuators);
        };
        [
            &upright.velocity[..],
            &upright.angular_velocity,
            &upright.acceleration.unwrap(),
            &upright.angular_acceleration.unwrap(),
            &[torque.force],
        ]
        .concat()
    };
    compared(of, |found, plain, model, _| near(found, plain, model));
}

#[test]
fn a_map_has_the_same_modes_and_the_same_ends() {
    let of = |mechanism: &Mechanism, _: &str| {
        let settings = WorkspaceSettings {
            nodes: vec![24],
            ..WorkspaceSettings::default()
        };
        let question = Question::new(mechanism.clone()).input("lower", -1.0, 1.5);
        let report = question.workspace(&settings, &Watch::none()).unwrap();
        assert!(report.home.unwrap().mode.is_some());
        let counts = report.modes.iter().map(|mode| (mode.nodes, mode.repeated));
        let mut counts: Vec<(usize, usize)> = counts.collect();
        counts.sort_unstable();
        let mut ends: Vec<f64> = report.points.iter().map(|point| point.at[0]).collect();
        ends.sort_by(f64::total_cmp);
        (counts, ends, report.aspects.len())
    };
    compared(of, |found, plain, model, _| {
        assert_eq!((&found.0, found.2), (&plain.0, plain.2), "{model}");
        near(&found.1, &plain.1, model);
    });
}

#[test]
fn loci_over_bump_and_steering_are_those_without_the_spin() {
    let steered = |model: &str| {
        let text = written(model);
        // the inner ball on a rack
        let rack = r#"base: [T(-0.12, 0.05, 0.1), Rx("-90 deg")], rows: [(d: "rack")], tip: [Rx("90 deg")]"#;
        let text = text.replace(r#"base: [T(-0.12, 0.05, 0.1)]"#, rack);
        let lower = r#""lower": Actuated(home: 0),"#;
        assert!(text.contains(rack) && text.contains(lower));
        let question = Question::new(read(
            &text.replace(lower, &format!(r#"{lower} "rack": Actuated(home: 0),"#)),
        ))
        .input("lower", -1.0, 0.5)
        .input("rack", -0.1, 0.03)
        .output("upright");
        let settings = SingularitiesSettings {
            starts: 15,
            ..SingularitiesSettings::default()
        };
        question.loci(&settings, &Watch::none()).unwrap()
    };
    let plain = steered("distance");
    assert!(plain.pinned.is_empty() && !plain.loci.is_empty());
    for model in ["platform", "platform aside"] {
        let found = steered(model);
        assert_eq!(found.pinned, ["tie"], "{model}");
        assert_eq!(found.loci.len(), plain.loci.len(), "{model}");
        for (a, b) in found.loci.iter().zip(&plain.loci) {
            assert_eq!(
                (a.kind, a.shape, a.closed),
                (b.kind, b.shape, b.closed),
                "{model}"
            );
            assert_eq!(a.singularity.zlatanov, b.singularity.zlatanov, "{model}");
            near(a.extents.as_flattened(), b.extents.as_flattened(), model);
        }
    }
}
