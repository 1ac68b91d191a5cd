//! The same mechanism in the other convention, or broken at another joint, over all that are shipped.

use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use linkwork::analysis::compare::{CompareSettings, compare};
use linkwork::analysis::convert::{
    Conversion, ConversionNote, ConvertError, ConvertSettings, CutError, convert, possible_cuts,
    to_axes,
};
use linkwork::ask;
use linkwork::description::{Description, Displacement, Entry};
use linkwork::geometry::{Axis, Pose};
use linkwork::mechanism::{ClosureKind, Configuration, Convention, Frame, Mechanism};
use linkwork::solve::Newton;
use linkwork::solve::Watch;
use linkwork::system::{Question, close};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let entries = folder.read_dir().unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    assert!(files.len() >= 35);
    files
}

fn read(path: &Path) -> (Description, Mechanism) {
    let description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    (description, mechanism)
}

fn shipped(name: &str) -> (Description, Mechanism) {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron")))
}

fn in_convention(mechanism: &Mechanism, description: &Description, to: Convention) -> Conversion {
    let settings = ConvertSettings {
        convention: Some(to),
        cut: None,
    };
    convert(mechanism, description, &settings).unwrap()
}

fn assert_same(a: &Pose<f64>, b: &Pose<f64>, tolerance: f64, what: &str) {
    assert!((a.position - b.position).norm() < tolerance, "{what}");
    for (u, v) in a.rotation.0.iter().zip(&b.rotation.0) {
        assert!((*u - *v).norm() < tolerance, "{what}");
    }
}

/// The frames that both mechanisms have under names that mean the same: all but links, and renamed ones.
fn common(mechanism: &Mechanism, conversion: &Conversion, new: &Mechanism) -> Vec<(Frame, Frame)> {
    let named = mechanism
        .frames()
        .into_iter()
        .filter(|f| !matches!(f, Frame::Link { .. }));
    let mut common: Vec<(Frame, Frame)> = named
        .map(|frame| {
            let name = mechanism.frame_name(frame);
            (
                frame,
                new.frame(&name).unwrap_or_else(|| panic!("{name} is lost")),
            )
        })
        .collect();
    for note in &conversion.notes {
        if let ConversionNote::Renamed { from, to } = note {
            common.push((mechanism.frame(from).unwrap(), new.frame(to).unwrap()));
        }
    }
    common
}

fn anywhere(mechanism: &Mechanism, k: usize) -> Configuration<f64> {
    let mut at = mechanism.home();
    for (i, value) in at.joints.iter_mut().enumerate() {
        *value += ((k * 7 + i) as f64 * 1.7).sin();
    }
    at
}

#[test]
fn the_other_convention_puts_every_frame_in_the_same_place() {
    for path in files() {
        let (description, mechanism) = read(&path);
        for to in Convention::ALL {
            let conversion = in_convention(&mechanism, &description, to);
            let text = conversion.description.to_ron().unwrap();
            assert_eq!(Description::read(&text).unwrap(), conversion.description);
            let new = Mechanism::new(&conversion.description).unwrap();
            assert!(
                new.chains()
                    .iter()
                    .all(|chain| chain.convention == to || chain.rows.is_empty())
            );
            assert_eq!(mechanism.warnings().len(), new.warnings().len(), "{path:?}");
            assert_eq!(mechanism.closed_forms().len(), new.closed_forms().len());
            // parameters and joints with their limits are untouched
            assert_eq!(description.parameters, conversion.description.parameters);
            assert_eq!(description.joints, conversion.description.joints);
            let common = common(&mechanism, &conversion, &new);
            for k in 0..5 {
                // joints and platforms are the same, so configurations are
                let at = anywhere(&mechanism, k);
                for &(old, found) in &common {
                    let [a] = mechanism.poses([old], &at);
                    let [b] = new.poses([found], &at);
                    assert_same(
                        &a,
                        &b,
                        1e-12,
                        &format!("{path:?} {}", mechanism.frame_name(old)),
                    );
                }
            }
        }
    }
}

#[test]
fn rows_are_moved_as_they_are_written_and_come_back() {
    let (description, mechanism) = shipped("puma560_modified");
    let there = in_convention(&mechanism, &description, Convention::Standard).description;
    let row = &there.chains[0].value.rows[2];
    let written = [&row.alpha, &row.a, &row.d, &row.theta].map(|e| e.expression.to_string());
    assert_eq!(written, ["-pi/2", "a3", "d3", "theta3"]);
    for path in files() {
        let (description, mechanism) = read(&path);
        let of_file = description.convention.as_ref().map(|c| c.value);
        let Some(own) = of_file else { continue };
        let to = Convention::ALL.into_iter().find(|c| *c != own).unwrap();
        let there = in_convention(&mechanism, &description, to).description;
        let new = Mechanism::new(&there).unwrap();
        let back = in_convention(&new, &there, own).description;
        for (a, b) in description.chains.iter().zip(
            back.chains
                .iter()
                .filter(|c| description.chains.iter().any(|d| d.name == c.name)),
        ) {
            assert_eq!(a.value.rows.len(), b.value.rows.len(), "{path:?}");
            let rows = a.value.rows.iter().zip(&b.value.rows);
            for (k, (r, s)) in rows.enumerate() {
                assert_eq!((&r.d, &r.theta), (&s.d, &s.theta));
                // what stood at an end stays in base or tip
                let end = if own == Convention::Modified {
                    0
                } else {
                    a.value.rows.len() - 1
                };
                if k != end {
                    assert_eq!((&r.alpha, &r.a), (&s.alpha, &s.a), "{path:?}");
                }
            }
        }
    }
}

/// Rows with β in both conventions and as joint coordinates put every body in the same place; a cut in front of such a row
/// has no way back.
#[test]
fn rows_of_nearly_parallel_axes_are_moved_with_their_tilt() {
    let text = r#"Mechanism(version: 1, name: "tilted", convention: Modified,
        parameters: { "tilt": "2 deg" },
        joints: { "a": Actuated(home: 0.3), "b": Passive(home: 0.4), "c": Passive(home: 0.2) },
        chains: { "arm": Chain(rows: [
            (theta: "a"), (alpha: "3 deg", a: 0.5, beta: "tilt", theta: "b"), (a: 0.4, beta: "1 deg", theta: "c")],
            tip: [Tx(0.3)]) },
        closures: { "ball": Spherical("arm", "ground") })"#;
    let description = Description::read(text).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let at = mechanism.home();
    let tip = |mechanism: &Mechanism| {
        let tip = mechanism.frame("arm").unwrap();
        mechanism.poses([tip, tip], &mechanism.home())[0]
    };
    // by matrices
    let rz = |angle: f64| Pose::rotation(Axis::Z, angle);
    let link = |alpha: f64, a: f64, beta: f64| {
        Pose::rotation(Axis::X, alpha.to_radians())
            * Pose::translation(linkwork::geometry::Vector3([a, 0.0, 0.0]))
            * Pose::rotation(Axis::Y, beta.to_radians())
    };
    let expected = rz(at.joints[0])
        * link(3.0, 0.5, 2.0)
        * rz(at.joints[1])
        * link(0.0, 0.4, 1.0)
        * rz(at.joints[2])
        * link(0.0, 0.3, 0.0);
    assert_same(&tip(&mechanism), &expected, 1e-14, "tables");
    let standard = in_convention(&mechanism, &description, Convention::Standard);
    let rows = &standard.description.chains[0].value.rows;
    assert_eq!(rows[0].beta.expression.to_string(), "tilt");
    let made = Mechanism::new(&standard.description).unwrap();
    assert_same(&tip(&made), &expected, 1e-14, "standard");
    let back = in_convention(&made, &standard.description, Convention::Modified);
    assert_eq!(
        back.description.chains[0].value.rows[1].beta,
        description.chains[0].value.rows[1].beta
    );
    let (axes, _) = to_axes(&mechanism, &description).unwrap();
    let drawn = Mechanism::new(&axes.tables().unwrap()).unwrap();
    assert_same(&tip(&drawn), &expected, 1e-14, "coordinates");
    let settings = ConvertSettings {
        cut: Some("b".into()),
        ..ConvertSettings::default()
    };
    let refused = convert(&mechanism, &description, &settings).unwrap_err();
    assert!(
        refused.to_string().contains("a row behind `b` has `beta`"),
        "{refused}"
    );
}

#[test]
fn closed_forms_agree_in_the_other_convention() {
    for path in files() {
        let (description, mechanism) = read(&path);
        if mechanism.closed_forms().is_empty() {
            continue;
        }
        let settings = CompareSettings {
            samples: 3,
            ..CompareSettings::default()
        };
        // a file by coordinates says none, and has both
        let own = description.convention.as_ref().map(|of| of.value);
        for to in Convention::ALL.into_iter().filter(|to| Some(*to) != own) {
            let conversion = in_convention(&mechanism, &description, to);
            let new = Mechanism::new(&conversion.description).unwrap();
            let report = compare(&new, &settings, &Watch::none());
            assert!(report.agree, "{path:?} {to:?}");
        }
    }
}

/// The description with an assembled configuration as its home.
fn at_home(description: &Description, mechanism: &Mechanism) -> Option<(Description, Mechanism)> {
    let closed = close(
        &Question::new(mechanism),
        &Newton::default(),
        (20, 1),
        &Watch::none(),
    )
    .ok()?;
    let at = closed.configuration;
    let mut description = description.clone();
    for (joint, &value) in description.joints.iter_mut().zip(&at.joints) {
        joint.value.home = Entry::number(value, 0..0);
    }
    for (platform, pose) in description.platforms.iter_mut().zip(&at.platforms) {
        platform.value.home = Displacement::of_pose(&pose.pose());
    }
    let mechanism = Mechanism::new(&description).unwrap();
    Some((description, mechanism))
}

/// How far a closure is from being whole, in m and rad.
fn gap(mechanism: &Mechanism, closure: usize, at: &Configuration<f64>) -> f64 {
    let closure = &mechanism.closures()[closure];
    let [a, b] = mechanism.poses(closure.frames, at);
    let apart = b.position - a.position;
    let along = |axis: Axis| (a.rotation.column(axis) - b.rotation.column(axis)).norm();
    let z = a.rotation.column(Axis::Z);
    match closure.kind {
        ClosureKind::Spherical | ClosureKind::Universal => apart.norm(),
        ClosureKind::Revolute => apart.norm() + along(Axis::Z),
        ClosureKind::Prismatic => apart.cross(&z).norm() + along(Axis::X) + along(Axis::Z),
        ClosureKind::Cylindrical => apart.cross(&z).norm() + along(Axis::Z),
        ClosureKind::Planar => apart.dot(&z).abs() + along(Axis::Z),
        ClosureKind::Rigid => apart.norm() + along(Axis::X) + along(Axis::Z),
        ClosureKind::Distance | ClosureKind::Coupling => 0.0,
    }
}

#[test]
fn a_mechanism_broken_at_another_joint_is_assembled_where_it_was() {
    let (mut cuts, mut refused) = (0, 0);
    for path in files() {
        let (description, mechanism) = read(&path);
        if mechanism.closures().is_empty() {
            continue;
        }
        let Some((description, mechanism)) = at_home(&description, &mechanism) else {
            continue;
        };
        for joint in mechanism.joints() {
            for convention in [None, Some(Convention::Modified), Some(Convention::Standard)] {
                let what = format!("{path:?} cut at {}", joint.name);
                let settings = ConvertSettings {
                    convention,
                    cut: Some(joint.name.clone()),
                };
                let conversion = match convert(&mechanism, &description, &settings) {
                    Ok(conversion) => conversion,
                    Err(ConvertError::Cut(_)) => {
                        refused += 1;
                        continue;
                    }
                    Err(error) => panic!("{what}: {error:?}"),
                };
                cuts += 1;
                let new = Mechanism::new(&conversion.description).unwrap();
                let text = conversion.description.to_ron().unwrap();
                assert_eq!(Description::read(&text).unwrap(), conversion.description);
                assert!(
                    new.closures()
                        .iter()
                        .any(|closure| closure.name == joint.name)
                );
                let (old_home, home) = (mechanism.home(), new.home());
                // every joint has the value that it had, by turns and all
                let values = new.all_joints(&home);
                for (name, value) in mechanism.all_joints(&old_home).0 {
                    let now = values
                        .get(&name)
                        .unwrap_or_else(|| panic!("{what}: {name}"));
                    let slides = |of: &linkwork::mechanism::Joint| !of.kind.is_angle();
                    let off = match mechanism.joint(&name).map(|j| &mechanism.joints()[j]) {
                        Some(joint) if slides(joint) => now - value,
                        _ => ((now - value) / 2.0).sin(),
                    };
                    assert!(off.abs() < 1e-9, "{what}: {name} was {value} and is {now}");
                }
                for (old, found) in common(&mechanism, &conversion, &new) {
                    let [a] = mechanism.poses([old], &old_home);
                    let [b] = new.poses([found], &home);
                    let name = mechanism.frame_name(old);
                    assert!((a.position - b.position).norm() < 1e-9, "{what}: {name}");
                }
                for closure in 0..new.closures().len() {
                    let gap = gap(&new, closure, &home);
                    let name = &new.closures()[closure].name;
                    assert!(gap < 1e-9, "{what}: {name} gapes by {gap:e}");
                }
            }
        }
    }
    assert!(cuts > 150 && refused > 0, "{cuts} cuts, {refused} refused");
}

#[test]
fn the_four_bar_broken_anywhere_has_the_assemblies_of_the_shipped_files() {
    use linkwork::analysis::assemblies::{AssembliesSettings, AssemblySolver, Wanted};
    let (description, mechanism) = shipped("four_bar");
    for (cut, other, hold) in [
        ("phi2", "four_bar_cut2", ("theta1", "60 deg")),
        ("phi1", "four_bar_cut4", ("theta1", "60 deg")),
        ("theta1", "four_bar_cut1", ("phi1", "129 deg")),
    ] {
        let settings = ConvertSettings {
            cut: Some(cut.into()),
            ..ConvertSettings::default()
        };
        let conversion = convert(&mechanism, &description, &settings).unwrap();
        let converted = Mechanism::new(&conversion.description).unwrap();
        let (_, shipped) = shipped(other);
        let found = |mechanism: &Mechanism| {
            let question = Question::new(mechanism);
            let question = match mechanism.joint("theta1") {
                Some(_) if hold.0 != "theta1" => question.free("theta1").unwrap(),
                _ => question,
            };
            let question = question.hold(hold.0, hold.1).unwrap();
            let settings = AssembliesSettings::default();
            let solver =
                AssemblySolver::new(mechanism, &question.held(), &settings, &Watch::none())
                    .unwrap();
            let report = solver.at_targets(
                &question.start(),
                &question.held(),
                Wanted::default(),
                &Watch::none(),
            );
            // the joints that both have, modulo a turn
            let both =
                |name: &&str| converted.joint(name).is_some() && shipped.joint(name).is_some();
            let mut found: Vec<Vec<i64>> = (report.assemblies.iter())
                .map(|assembly| {
                    let names = ["theta1", "phi1", "phi2"].into_iter().filter(both);
                    let turned = |name: &str| {
                        let value = *assembly.joints.get(name).unwrap();
                        (value.rem_euclid(std::f64::consts::TAU) * 1e9).round() as i64
                    };
                    names.map(turned).collect()
                })
                .collect();
            found.sort();
            found
        };
        let (a, b) = (found(&converted), found(&shipped));
        assert_eq!(a.len(), 2, "{cut}");
        let near = |(x, y): (&i64, &i64)| (x - y).abs() <= 2;
        assert!(
            a.iter().flatten().zip(b.iter().flatten()).all(near),
            "{cut}: {a:?} {b:?}"
        );
    }
}

#[test]
fn cuts_that_are_not_possible_say_why() {
    let error = |name: &str, joint: &str| {
        let (description, mechanism) = shipped(name);
        let settings = ConvertSettings {
            cut: Some(joint.into()),
            ..ConvertSettings::default()
        };
        match convert(&mechanism, &description, &settings) {
            Err(ConvertError::Cut(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    assert!(matches!(
        error("four_bar", "phi9"),
        CutError::UnknownJoint {
            suggestion: Some(_),
            ..
        }
    ));
    assert!(matches!(
        error("four_bar", "joint3"),
        CutError::AlreadyCut { .. }
    ));
    let open = r#"Mechanism(version: 1, name: "x", convention: Modified, joints: { "q": Actuated() },
        chains: { "c": Chain(rows: [(a: 1, theta: "q")]) })"#;
    let open = Description::read(open).unwrap();
    let settings = ConvertSettings {
        cut: Some("q".into()),
        ..ConvertSettings::default()
    };
    let found = convert(&Mechanism::new(&open).unwrap(), &open, &settings);
    assert!(matches!(
        found,
        Err(ConvertError::Cut(CutError::NoLoop { .. }))
    ));
    assert!(matches!(
        error("four_bar_cut1", "phi1"),
        CutError::SeveralRows { .. }
    ));
    assert!(matches!(error("delta", "theta1"), CutError::NotRows { .. }));
}

#[test]
fn limits_stay_with_a_joint_that_is_cut_and_other_cuts_are_named() {
    let text = include_str!("../../mechanisms/four_bar.ron");
    let limited = text.replacen(
        "Passive(home: \"-12 deg\"",
        "Passive(limits: (\"-90 deg\", \"90 deg\"), home: \"-12 deg\"",
        1,
    );
    assert_ne!(limited, text);
    let limits = |text: &str, joint: &str| {
        let description = Description::read(text).unwrap();
        let mechanism = Mechanism::new(&description).unwrap();
        let settings = ConvertSettings {
            cut: Some(joint.into()),
            ..ConvertSettings::default()
        };
        let made = convert(&mechanism, &description, &settings).unwrap();
        let made = Mechanism::new(&made.description).unwrap();
        made.joint("phi2").map(|joint| made.joints()[joint].limits)
    };
    let given = Some((-FRAC_PI_2, FRAC_PI_2));
    assert_eq!(limits(&limited, "phi2"), Some(given));
    assert_eq!(limits(&limited, "theta1"), Some(given));
    assert_eq!(limits(text, "phi2"), Some(None));
    let (description, mechanism) = shipped("four_bar");
    assert_eq!(
        possible_cuts(&mechanism, &description),
        ["theta1", "phi2", "phi1"]
    );
    let (description, mechanism) = shipped("delta");
    assert!(possible_cuts(&mechanism, &description).is_empty());
}

/// Two links under their weights and a load: the moment that the first joint bears, from the places of the centres of mass.
#[test]
fn masses_and_loads_stay_where_they_are() {
    let text = r#"Mechanism(
        version: 1, name: "arm", convention: Modified, tolerance: "0.1 mm",
        joints: { "a": Actuated(home: "30 deg"), "b": Actuated(home: "40 deg") },
        chains: { "arm": Chain(base: [Rx("90 deg")], rows: [(theta: "a", link: "upper"), (a: 0.4, theta: "b", link: "fore")],
                               tip: [Tx(0.3)]) },
        gravity: (0, 0, "-9.81 m/s^2"),
        masses: { "upper": (mass: 2, centre: (0.2, 0, 0)), "fore+0.1,0,0": (mass: 1) },
        loads: { "push": Force(at: "arm+-0.1,0,0", force: (0, 0, "-5 N")) },
    )"#;
    let moment = |description: &Description| {
        let question = ask::Question::new(Mechanism::new(description).unwrap()).hold("a", 0.5);
        let question = question.hold("b", 0.7);
        let found = question.statics(&Watch::none()).unwrap().closed().unwrap();
        found.actuators[0].force
    };
    let (upper, fore) = (0.5_f64.cos(), 1.2_f64.cos());
    let weights = 9.81 * (2.0 * 0.2 * upper + 0.4 * upper + 0.1 * fore);
    let expected = weights + 5.0 * (0.4 * upper + 0.2 * fore);
    let description = Description::read(text).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let standard = in_convention(&mechanism, &description, Convention::Standard).description;
    let in_standard = Mechanism::new(&standard).unwrap();
    let back = in_convention(&in_standard, &standard, Convention::Modified).description;
    let axes = to_axes(&mechanism, &description).unwrap().0;
    assert_eq!(axes.tolerance, description.tolerance);
    for of in [description, standard, back, axes.tables().unwrap()] {
        assert!((moment(&of) - expected).abs() < 1e-12, "{}", moment(&of));
    }
}

/// A four-bar on a body that floats has its own freedom and six of the body, also as joint coordinates; the angle of its
/// coupler follows from the cosine theorem.
#[test]
fn bodies_that_float_are_joint_coordinates_too() {
    let text = r#"Mechanism(
        version: 1, name: "on a float", convention: Modified,
        joints: { "a": Actuated(home: "90 deg"), "b": Passive(home: "-60 deg"), "c": Passive(home: "80 deg") },
        platforms: { "float": Platform(home: [T(0.1, 0.2, 1), Rx("30 deg")], frames: { "pin": [Tx(4)] }) },
        chains: {
            "left": Chain(on: "float", rows: [(theta: "a"), (a: 2, theta: "b")], tip: [Tx(3.5)]),
            "right": Chain(on: "float.pin", rows: [(theta: "c")], tip: [Tx(3)]),
        },
        closures: { "tip": Revolute("left", "right") },
    )"#;
    let description = Description::read(text).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let (axes, _) = to_axes(&mechanism, &description).unwrap();
    let written = Description::read(&axes.to_ron().unwrap()).unwrap();
    for of in [description, axes.tables().unwrap(), written] {
        let mechanism = Mechanism::new(&of).unwrap();
        let question = ask::Question::new(mechanism.clone()).hold("a", FRAC_PI_2);
        let report = question.mobility(&Watch::none()).unwrap().closed().unwrap();
        assert_eq!(report.mobility, 7);
        let found = question.closed(&Watch::none()).unwrap().closed().unwrap();
        // the diagonal from the crank's pin to the rocker's is sqrt(20)
        let inside = (20.0 + 3.5 * 3.5 - 9.0) / (2.0 * 20.0_f64.sqrt() * 3.5);
        let coupler = inside.acos() + (-2.0_f64).atan2(4.0) - FRAC_PI_2;
        let b = found.configuration.joints[mechanism.joint("b").unwrap()];
        assert!((b - coupler).abs() < 1e-9, "{b} {coupler}");
    }
}

/// What joins nothing to ground is refused unless it is said to float.
#[test]
fn what_floats_must_say_so() {
    let file = |more: &str| {
        format!(
            r#"Axes(version: 1, name: "pendulum", joints: {{
                "a": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("hull", "arm")),
                "b": Revolute(point: (1, 0, 0), direction: (0, 1, 0), between: ("arm", "hand")), {more}
            }})"#
        )
    };
    let lost = Description::read(&file("")).unwrap_err();
    let help = lost[0].kind.help().unwrap();
    assert!(
        help.contains(r#"`Free(between: ("ground", "body"))`"#),
        "{help}"
    );
    let floats = file(r#""f": Free(between: ("ground", "hull")),"#);
    let mechanism = Mechanism::new(&Description::read(&floats).unwrap()).unwrap();
    let report = ask::Question::new(mechanism).mobility(&Watch::none());
    assert_eq!(report.unwrap().closed().unwrap().mobility, 8);
}
