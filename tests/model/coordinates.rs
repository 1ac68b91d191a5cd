//! Joint coordinates as an input of equal rank: what is shipped as tables is the same mechanism when written by
//! coordinates, and files as a drawing gives them agree with closed forms.

use std::path::{Path, PathBuf};

use linkwork::analysis::compare::{CompareSettings, Verdict, compare};
use linkwork::analysis::convert::to_axes;
use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::Question;
use linkwork::description::{AxesDescription, Description};
use linkwork::geometry::Vector3;
use linkwork::mechanism::{Configuration, Frame, Mechanism};
use linkwork::solve::Watch;

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let entries = folder.read_dir().unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    files
}

fn by_coordinates(path: &Path) -> (Mechanism, Mechanism) {
    let description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let (axes, _) = to_axes(&mechanism, &description).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    // through the text, as a user would
    let text = axes.to_ron().unwrap();
    let again = AxesDescription::read(&text).unwrap_or_else(|e| panic!("{path:?}: {e:?}\n{text}"));
    assert_eq!(again, axes, "{path:?}\n{text}");
    let tables = Description::read(&text).unwrap_or_else(|e| panic!("{path:?}: {e:?}\n{text}"));
    let made = Mechanism::new(&tables).unwrap_or_else(|e| panic!("{path:?}: {e:?}\n{text}"));
    (mechanism, made)
}

/// The configuration of the second mechanism with the values of the first.
fn carried(from: &Mechanism, at: &Configuration<f64>, to: &Mechanism) -> Configuration<f64> {
    let mut there = to.home();
    for (joint, value) in to.joints().iter().zip(&mut there.joints) {
        let known = from.joint(&joint.name);
        *value = at.joints[known.unwrap_or_else(|| panic!("{} is new", joint.name))];
    }
    for (platform, pose) in to.platforms().iter().zip(&mut there.platforms) {
        *pose = at.platforms[from.platform(&platform.name).unwrap()];
    }
    there
}

#[test]
fn shipped_mechanisms_are_the_same_when_written_by_coordinates() {
    for path in shipped() {
        let (mechanism, made) = by_coordinates(&path);
        assert_eq!(made.joints().len(), mechanism.joints().len(), "{path:?}");
        for joint in mechanism.joints() {
            let same = &made.joints()[made.joint(&joint.name).unwrap()];
            assert_eq!((same.role, same.kind), (joint.role, joint.kind), "{path:?}");
            assert_eq!(
                (same.home, same.limits),
                (joint.home, joint.limits),
                "{path:?}"
            );
        }
        let parameters = |m: &Mechanism| -> Vec<(String, f64)> {
            let all = m.parameters().iter();
            all.map(|p| (p.name.to_string(), p.value)).collect()
        };
        assert_eq!(parameters(&made), parameters(&mechanism), "{path:?}");
        assert_eq!(
            made.closures().len(),
            mechanism.closures().len(),
            "{path:?}"
        );
        // at values that assemble nothing in particular
        let size = mechanism.characteristic_length();
        for sample in 1..4 {
            let mut at = mechanism.home();
            for (i, value) in at.joints.iter_mut().enumerate() {
                *value += 0.3 * ((7 * i + 3 * sample) as f64).sin();
            }
            let there = carried(&mechanism, &at, &made);
            for frame in mechanism.frames() {
                // a frame that is no point is the end of a closure, whose name is made of that of the closure
                let name = mechanism.frame_name(frame);
                let point = name.replace('.', "_");
                let same_name = match frame {
                    Frame::Tip { .. } | Frame::Platform { .. } => name,
                    Frame::OnPlatform { .. } if made.frame(&point).is_some() => point,
                    Frame::OnPlatform { .. } => name,
                    _ => continue,
                };
                let was = mechanism.transform(Frame::Ground, frame, &at);
                let Some(is) = made.pose(&same_name, &there) else {
                    panic!("{path:?}: no frame {same_name}");
                };
                let moved = (was.position - is.position).norm();
                assert!(moved < 1e-12 * size, "{path:?} {same_name} {moved}");
                for (u, v) in was.rotation.0.iter().zip(&is.rotation.0) {
                    assert!((*u - *v).norm() < 1e-12, "{path:?} {same_name}");
                }
            }
            // the sides of each closure stand as they did
            for (a, b) in mechanism.closures().iter().zip(made.closures()) {
                assert_eq!(a.kind, b.kind, "{path:?}");
                let gap = |m: &Mechanism, frames, at| {
                    let [a, b]: [linkwork::geometry::Pose<f64>; 2] = m.poses(frames, at);
                    (b.position - a.position).norm()
                };
                let gaps = [gap(&mechanism, a.frames, &at), gap(&made, b.frames, &there)];
                assert!(
                    (gaps[0] - gaps[1]).abs() < 1e-12 * size,
                    "{path:?} {}",
                    a.name
                );
            }
        }
    }
}

#[test]
fn another_value_of_a_parameter_moves_tables_and_coordinates_alike() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/four_bar.ron");
    let description = Description::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let mechanism = Mechanism::new(&description).unwrap();
    let (axes, _) = to_axes(&mechanism, &description).unwrap();
    let tables = Description::read(&axes.to_ron().unwrap()).unwrap();
    let set = |of: Description| Mechanism::new(&of.with_parameter("l2", "3.5").unwrap()).unwrap();
    let (one, two) = (set(description), set(tables));
    let pose = |m: &Mechanism| m.pose("left", &m.home()).unwrap().position;
    assert!((pose(&one) - pose(&mechanism)).norm() > 0.1);
    assert!((pose(&one) - pose(&two)).norm() < 1e-12);
}

#[test]
fn there_are_as_many_assemblies() {
    for name in ["four_bar", "three_rps", "rssr", "planar_3rpr", "bennett"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
        let (mechanism, made) = by_coordinates(&path);
        let found = [mechanism, made].map(|mechanism| {
            let question = Question::new(mechanism);
            let report = question
                .assemblies(Default::default(), &Watch::none())
                .unwrap();
            (report.real, report.complex)
        });
        assert_eq!(found[0], found[1], "{name}");
    }
}

#[test]
fn the_same_questions_have_the_same_answers() {
    let moved = [
        ("four_bar", "theta1", 1.0, 2.0),
        ("four_bar_cut1", "theta1", 1.0, 2.0),
        ("slider_crank", "theta", 0.2, 3.0),
        ("rssr", "theta", 1.0, 1.7),
        ("planar_3rpr", "rho1", 14.9, 15.1),
        ("three_rps", "l1", 0.6, 0.7),
    ];
    for (name, input, from, to) in moved {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
        let (mechanism, made) = by_coordinates(&path);
        let names: Vec<String> = mechanism.joints().iter().map(|j| j.name.clone()).collect();
        let answers = [mechanism, made].map(|mechanism| {
            let question = Question::new(mechanism);
            let closed = question.closed(&Watch::none()).unwrap().closed().unwrap();
            let at_home: Vec<(String, f64)> = (question.mechanism().joints().iter())
                .map(|joint| joint.name.clone())
                .zip(closed.configuration.joints.iter().copied())
                .collect();
            let mobility = question.mobility(&Watch::none()).unwrap();
            let mobility = mobility.report().unwrap();
            let freedoms = (mobility.mobility, mobility.kutzbach, mobility.rank);
            let settings = SweepSettings {
                steps: 4,
                ..SweepSettings::default()
            };
            let sweep = question.input(input, from, to);
            let sweep = sweep.motions(&settings, &Watch::none()).unwrap();
            let sweep = sweep.report(usize::MAX, &mut |_, _| {}, &Watch::none());
            let motion = &sweep.motions[0];
            let column = |name: &String| {
                let place = motion
                    .columns
                    .iter()
                    .position(|of| of.name == *name)
                    .unwrap();
                motion
                    .values
                    .iter()
                    .map(|row| row[place].unwrap())
                    .collect::<Vec<f64>>()
            };
            let rows: Vec<f64> = names.iter().flat_map(column).collect();
            let home = names.iter().map(|name| {
                let found = at_home.iter().find(|(joint, _)| joint == name);
                found.unwrap().1
            });
            (freedoms, home.chain(rows).collect::<Vec<f64>>())
        });
        let [(freedoms, values), (same_freedoms, same_values)] = answers;
        assert_eq!(freedoms, same_freedoms, "{name}");
        assert_eq!(values.len(), same_values.len(), "{name}");
        for (a, b) in values.iter().zip(&same_values) {
            assert!((a - b).abs() < 1e-8 * (1.0 + a.abs()), "{name}: {a} {b}");
        }
    }
}

#[test]
fn shipped_mechanisms_have_the_same_freedoms_when_written_by_coordinates() {
    for path in shipped() {
        let (mechanism, made) = by_coordinates(&path);
        let found = [mechanism, made].map(|mechanism| {
            let question = Question::new(mechanism);
            let report = question.mobility(&Watch::none()).unwrap();
            let report = report.report().map(|report| {
                let idle = (report.idle_joints.len(), report.spinning_joints.len());
                (
                    report.mobility,
                    report.kutzbach,
                    report.rank,
                    report.infinitesimal,
                    idle,
                )
            });
            report.unwrap_or_else(|| panic!("{path:?} is not assembled"))
        });
        assert_eq!(found[0], found[1], "{path:?}");
    }
}

#[test]
fn converted_closed_forms_are_tried() {
    let settings = CompareSettings {
        samples: 12,
        ..CompareSettings::default()
    };
    for name in ["planar_3rpr", "four_bar_cut1"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
        let (_, made) = by_coordinates(&path);
        let report = compare(&made, &settings, &Watch::none());
        assert!(!report.closed_forms.is_empty());
        for form in &report.closed_forms {
            assert_eq!(form.verdict, Verdict::Agrees, "{name}: {form:#?}");
        }
    }
}

#[test]
fn a_file_drawn_apart_may_be_cut_anywhere() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/four_bar.ron");
    let (mechanism, _) = by_coordinates(&path);
    let description = Description::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let (mut axes, _) = to_axes(&mechanism, &description).unwrap();
    // closed forms may name the joint that is cut
    axes.closed_forms.clear();
    for cut in ["phi2", "phi1"] {
        axes.cut[0].value = cut.into();
        let made = Mechanism::new(&axes.tables().unwrap()).unwrap();
        assert!(made.joint(cut).is_none());
        let report = Question::new(made).hold("theta1", 1.0);
        let report = report
            .assemblies(Default::default(), &Watch::none())
            .unwrap();
        assert_eq!((report.real, report.complex), (2, 2), "{cut}");
    }
}

pub fn axes(name: &str) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/axes/{name}.ron"));
    linkwork::load(path).unwrap()
}

pub fn solved(mechanism: &Mechanism, hold: &[(&str, f64)]) -> Configuration<f64> {
    let start = Question::new(mechanism.clone());
    let question = (hold.iter()).fold(start, |question, &(name, value)| question.hold(name, value));
    question
        .closed(&Watch::none())
        .unwrap()
        .closed()
        .unwrap()
        .configuration
}

pub fn at(mechanism: &Mechanism, frame: &str, configuration: &Configuration<f64>) -> Vector3<f64> {
    mechanism.pose(frame, configuration).unwrap().position
}

/// The point at given distances from two others in the plane, on the left of the way from the first to the second, or
/// on the right.
pub fn meeting(a: [f64; 2], r: f64, b: [f64; 2], s: f64, left: bool) -> [f64; 2] {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let d = x.hypot(y);
    let along = (r * r - s * s + d * d) / (2.0 * d);
    let across = (r * r - along * along).sqrt() * if left { 1.0 } else { -1.0 };
    [
        a[0] + (x * along - y * across) / d,
        a[1] + (y * along + x * across) / d,
    ]
}

#[test]
fn a_wiper_of_two_four_bars_follows_their_closed_form() {
    let wiper = axes("wiper");
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let (l, r) = ([0.2, -0.1], [0.8, -0.1]);
    let (a, b, d, e) = ([0.0, 0.05], [0.2, 0.0], [0.2, -0.02], [0.8, -0.03]);
    for motor in [0.0_f64, 0.2, 0.5, -0.4] {
        let found = solved(&wiper, &[("motor", motor)]);
        let pin = [-0.05 * motor.sin(), 0.05 * motor.cos()];
        let new_b = meeting(pin, distance(a, b), l, distance(l, b), true);
        // the left arm is one body: D stands on the same line as B
        let part = distance(l, d) / distance(l, b);
        let new_d = [
            l[0] + part * (new_b[0] - l[0]),
            l[1] + part * (new_b[1] - l[1]),
        ];
        let new_e = meeting(new_d, distance(d, e), r, distance(r, e), true);
        let tip = |pivot: [f64; 2], pin: [f64; 2], length: f64| {
            let part = 0.55 / length;
            let at = [0, 1].map(|i| pivot[i] + part * (pin[i] - pivot[i]));
            Vector3([at[0], at[1], 0.0])
        };
        let left = tip(l, new_b, distance(l, b));
        let right = tip(r, new_e, distance(r, e));
        assert!(
            (at(&wiper, "left tip", &found) - left).norm() < 1e-9,
            "{motor}"
        );
        assert!(
            (at(&wiper, "right tip", &found) - right).norm() < 1e-9,
            "{motor}"
        );
    }
    // a wrong length is seen
    let wrong = meeting(a, distance(a, b) + 0.001, l, 0.1, true);
    assert!(distance(wrong, b) > 1e-4);
}

fn turned(point: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>, angle: f64) -> Vector3<f64> {
    let n = (to - from).times(1.0 / (to - from).norm());
    let arm = point - from;
    let along = n.times(n.dot(&arm));
    let across = arm - along;
    from + along + across.times(angle.cos()) + n.cross(&arm).times(angle.sin())
}

/// The point at given distances from three others, on the side of `near` (trilateration).
fn trilaterated(centres: [Vector3<f64>; 3], radii: [f64; 3], near: Vector3<f64>) -> Vector3<f64> {
    let [a, b, c] = centres;
    let ex = (b - a).times(1.0 / (b - a).norm());
    let i = ex.dot(&(c - a));
    let ey = (c - a) - ex.times(i);
    let ey = ey.times(1.0 / ey.norm());
    let ez = ex.cross(&ey);
    let (d, j) = ((b - a).norm(), ey.dot(&(c - a)));
    let [r, s, t] = radii.map(|r| r * r);
    let x = (r - s + d * d) / (2.0 * d);
    let y = (r - t + i * i + j * j) / (2.0 * j) - i / j * x;
    let z = (r - x * x - y * y).sqrt();
    let side = ez.dot(&(near - a)).signum();
    a + ex.times(x) + ey.times(y) + ez.times(z * side)
}

#[test]
fn a_double_wishbone_follows_its_closed_form() {
    let wishbone = axes("double_wishbone");
    let v = |x: f64, y: f64, z: f64| Vector3([x, y, z].map(|mm| mm / 1000.0));
    let (l, u) = (v(0.0, 600.0, 110.0), v(15.0, 570.0, 320.0));
    let (k, t) = (v(-110.0, 260.0, 160.0), v(-100.0, 590.0, 165.0));
    let wheel = v(0.0, 650.0, 215.0);
    let lower = (v(-150.0, 250.0, 120.0), v(200.0, 250.0, 130.0));
    let upper = (v(-120.0, 280.0, 300.0), v(180.0, 280.0, 290.0));
    for (travel, rack) in [
        (0.0_f64, 0.0),
        (0.1, 0.0),
        (-0.12, 0.0),
        (0.05, 0.03),
        (-0.1, -0.03),
    ] {
        let found = solved(&wishbone, &[("lower", travel), ("rack", rack)]);
        let new_l = turned(l, lower.0, lower.1, travel);
        // U on its circle at its distance from L: a cos + b sin = c
        let n = (upper.1 - upper.0).times(1.0 / (upper.1 - upper.0).norm());
        let arm = u - upper.0;
        let centre = upper.0 + n.times(n.dot(&arm));
        let (p, q) = (u - centre, n.cross(&arm));
        let away = centre - new_l;
        let (a, b) = (2.0 * away.dot(&p), 2.0 * away.dot(&q));
        let c = (u - l).dot(&(u - l)) - away.dot(&away) - p.dot(&p);
        let middle = b.atan2(a);
        let reach = (c / a.hypot(b)).acos();
        let angles = [middle + reach, middle - reach].map(|x| x.sin().atan2(x.cos()));
        let angle = if angles[0].abs() < angles[1].abs() {
            angles[0]
        } else {
            angles[1]
        };
        let new_u = turned(u, upper.0, upper.1, angle);
        let new_k = k + Vector3([0.0, rack, 0.0]);
        let radii = [(t - l).norm(), (t - u).norm(), (t - k).norm()];
        let new_t = trilaterated([new_l, new_u, new_k], radii, t);
        let radii = [(wheel - l).norm(), (wheel - u).norm(), (wheel - t).norm()];
        let new_wheel = trilaterated([new_l, new_u, new_t], radii, wheel);
        let is = at(&wishbone, "wheel", &found);
        assert!(
            (is - new_wheel).norm() < 1e-9,
            "{travel} {rack}: {is:?} {new_wheel:?}"
        );
    }
}

/// A boom and a stick, each with a cylinder given by the pins at its ends.
fn arm() -> Mechanism {
    let text = r#"Axes(
        version: 1, name: "arm with cylinders",
        joints: {
            "boom":  Revolute(point: (0, 0, 0), direction: (0, -1, 0), between: ("ground", "boom")),
            "stick": Revolute(point: (3, 0, 1), direction: (0, -1, 0), between: ("boom", "stick")),
            "lift":  Distance(through: ((1, 0, -1), (2, 0, 1)), role: Actuated, limits: (1.5, 3), between: ("ground", "boom")),
            "crowd": Distance(through: ((2, 0, 1.5), (4, 0, 1.5)), role: Actuated, between: ("boom", "stick")),
        },
        points: { "bucket pin": (body: "stick", at: (4, 0, -1)) },
    )"#;
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

#[test]
fn cylinders_turn_an_arm_by_the_law_of_cosines() {
    let arm = arm();
    let angle_of = |a: f64, b: f64, c: f64| ((a * a + b * b - c * c) / (2.0 * a * b)).acos();
    let (lift, crowd) = (2.0_f64, 1.9_f64);
    let found = solved(&arm, &[("lift", lift), ("crowd", crowd)]);
    // about −y in the plane of x and z: counterclockwise seen from the right
    let turned_by = |near: f64, far: f64, drawn: f64, now: f64| {
        angle_of(near, far, now) - angle_of(near, far, drawn)
    };
    let boom = turned_by(2.0_f64.sqrt(), 5.0_f64.sqrt(), 5.0_f64.sqrt(), lift);
    // pins of the stick's cylinder seen from the stick's pin: (−1, 0.5) on the boom, (1, 0.5) on the stick
    let stick = -turned_by(1.25_f64.sqrt(), 1.25_f64.sqrt(), 2.0, crowd);
    let turn = |x: f64, z: f64, by: f64| [x * by.cos() - z * by.sin(), x * by.sin() + z * by.cos()];
    let pin = turn(3.0, 1.0, boom);
    let end = turn(1.0, -2.0, boom + stick);
    let expected = Vector3([pin[0] + end[0], 0.0, pin[1] + end[1]]);
    let is = at(&arm, "bucket pin", &found);
    assert!((is - expected).norm() < 1e-9, "{is:?} {expected:?}");
    // bodies are called what the file calls them
    let names: Vec<String> = arm
        .bodies()
        .iter()
        .map(|&body| arm.body_name(body))
        .collect();
    assert_eq!(names, ["ground", "boom", "stick"]);
}

#[test]
fn gears_racks_and_screws_follow_by_their_ratio() {
    let gears = axes("gears");
    assert_eq!(gears.joints().len(), 1);
    let mut now = gears.home();
    let by = 0.7;
    now.joints[0] += by;
    // 40 teeth against 20, module 2 mm: axles 60 mm apart, pitch radius 20 mm
    let pinion = -2.0 * by;
    let tooth = Vector3([0.06 + 0.02 * pinion.cos(), 0.02 * pinion.sin(), 0.0]);
    assert!((at(&gears, "tooth", &now) - tooth).norm() < 1e-14);
    assert!((at(&gears, "end", &now) - Vector3([0.02 * pinion, -0.02, 0.0])).norm() < 1e-14);
    let rise = 0.005 * 3.0 * by / std::f64::consts::TAU;
    assert!((at(&gears, "flange", &now) - Vector3([0.0, 0.1, rise])).norm() < 1e-14);
    // at home all is as drawn
    let drawn = Vector3([0.08, 0.0, 0.0]);
    assert!((at(&gears, "tooth", &gears.home()) - drawn).norm() < 1e-14);
}

#[test]
fn a_constant_of_a_coupling_counts_from_the_value_in_the_drawing() {
    let follower = |more: &str| {
        let text = format!(
            r#"Axes(version: 1, name: "pair", joints: {{
                "a": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, home: "20 deg", between: ("ground", "one")),
                "c": Revolute(point: (0, 0, 0), direction: (0, 0, 1), value: "2*a + 10 deg"{more}, between: ("ground", "two")),
            }}, points: {{ "tip": (body: "two", at: (1, 0, 0)) }})"#
        );
        Description::read(&text).and_then(|description| Mechanism::new(&description))
    };
    // at home it is at 50°, from where it was drawn
    for (drawn, turned) in [("50 deg", 0.0_f64), ("10 deg", 40.0), ("0 deg", 50.0)] {
        let pair = follower(&format!(", drawn: \"{drawn}\"")).unwrap();
        let (sin, cos) = turned.to_radians().sin_cos();
        let tip = at(&pair, "tip", &pair.home());
        assert!(
            (tip - Vector3([cos, sin, 0.0])).norm() < 1e-14,
            "{drawn}: {tip:?}"
        );
    }
    let problems = follower("").unwrap_err();
    assert_eq!(problems.len(), 1, "{problems:?}");
}

#[test]
fn a_scissor_lift_rises_by_the_theorem_of_pythagoras() {
    let lift = axes("scissor_lift");
    let foot = 2.0 * 30.0_f64.to_radians().cos();
    for ram in [1.3_f64, 1.4, 1.5] {
        let found = solved(&lift, &[("ram", ram)]);
        // the cylinder ends a quarter up arm 1
        let cos = (0.25 + foot * foot - ram * ram) / foot;
        let (x, z) = (2.0 * cos, 2.0 * (1.0 - cos * cos).sqrt());
        let load = at(&lift, "load", &found);
        assert!(
            (load - Vector3([foot / 2.0, 0.0, z])).norm() < 1e-9,
            "{ram}: {load:?}"
        );
        let slide = found.joints[lift.joint("slide").unwrap()];
        assert!((slide - (x - foot)).abs() < 1e-9, "{ram}: {slide}");
    }
}

#[test]
fn a_shaper_swings_by_its_slotted_lever() {
    let shaper = axes("shaper");
    for turn in [0.0_f64, 0.7, 1.5, -1.0] {
        let found = solved(&shaper, &[("turn", turn)]);
        let swing = (0.12 * turn.sin()).atan2(0.3 + 0.12 * turn.cos());
        let is = found.joints[shaper.joint("swing").unwrap()];
        assert!((is - swing).abs() < 1e-9, "{turn}: {is} {swing}");
        // the link of 250 mm keeps the tool at the height of the lever's upright end
        let (x, z) = (0.6 * swing.sin(), 0.6 * swing.cos());
        let tool = x + (0.25_f64.powi(2) - (0.6 - z).powi(2)).sqrt();
        let is = at(&shaper, "tool", &found);
        assert!(
            (is - Vector3([tool, 0.0, 0.6])).norm() < 1e-9,
            "{turn}: {is:?}"
        );
    }
}

/// All lines that a wrong file gets: `line:column: what (remedy)`.
fn refused(text: &str) -> Vec<String> {
    let problems = Mechanism::problems(text);
    let error = linkwork::description::FileError {
        path: "f".into(),
        text: text.into(),
        problems,
    };
    error.to_string().lines().map(str::to_owned).collect()
}

#[test]
fn bad_coordinates_are_refused_at_their_place_with_the_remedy() {
    let file = |joints: &str, rest: &str| {
        format!("Axes(version: 1, name: \"x\", joints: {{\n{joints}\n}}, {rest})")
    };
    let two =
        "\"a\": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: (\"ground\", \"b\")),\n";
    let cases = [
        (
            file(&two.replace("(0, 0, 1)", "(0, 0, 0)"), ""),
            "f:2:45: the axis of joint `a` has no direction (give a nonzero vector, or two different points)",
        ),
        (
            file(
                "\"a\": Revolute(through: ((1, 2, 3), (1, 2, 3)), between: (\"ground\", \"b\")),",
                "",
            ),
            "f:2:26: the axis of joint `a` has no direction (give a nonzero vector, or two different points)",
        ),
        (
            file(two, "points: { \"p\": (body: \"c\", at: (0, 0, 0)) }"),
            "f:4:26: no joint is at the body `c` (connect it with others by the `between` of a joint, or leave it out)",
        ),
        (
            file(two, "bodies: { \"lever\": (origin: (0, 0, 0)) }"),
            "f:4:14: no joint is at the body `lever` (connect it with others by the `between` of a joint, or leave it out)",
        ),
        (
            file(
                "\"a\": Revolute(point: (0, 0, 0), direction: (0, 0, 1), value: \"2*b\", between: (\"ground\", \"b\")),\n\
                 \"b\": Revolute(point: (0, 0, 0), direction: (0, 0, 1), value: \"3*a\", between: (\"b\", \"c\")),",
                "",
            ),
            "f:2:1: the value of a joint depends on itself: `a` -> `b` -> `a` (leave out the `value` of one of them: it is then the variable)",
        ),
        (
            file(
                "\"a\": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: (\"c\", \"b\")),",
                "",
            ),
            "f:2:1: no joint connects anything with `ground` (the fixed body is called `ground`; one that floats has `Free(between: (\"ground\", \"body\"))`)",
        ),
        (
            file(
                &format!(
                    "{two}\"d\": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: (\"c\", \"e\")),"
                ),
                "",
            ),
            "f:3:1: no joints connect the body `c` with `ground` (if it floats, add a joint `Free(between: (\"ground\", \"c\"))`)",
        ),
        (
            file(two, "cut: [\"aa\"]"),
            "f:4:10: there is no joint `aa` to cut (did you mean `a`?)",
        ),
        (
            file(
                "\"a\": Universal(point: (0, 0, 0), directions: ((0, 0, 1), (0, 1, 1)), between: (\"ground\", \"b\")),",
                "",
            ),
            "f:2:48: the axes of the universal joint `a` are not perpendicular: the angle between them is 45.0000° (turn one of them, or write two revolute joints with a body between them)",
        ),
        (
            file(&two.replace("(0, 0, 0), d", "(0, 0, \"2 deg\"), d"), ""),
            "f:2:30: expected a length, found an angle",
        ),
    ];
    for (text, expected) in cases {
        let lines = refused(&text);
        assert!(
            lines.iter().any(|line| line.starts_with(expected)),
            "{text}\n{lines:#?}\n{expected}"
        );
    }
    assert_eq!(refused(&file(two, "")), Vec::<String>::new());
    let dashed = refused(&file(&two.replace("\"a\"", "\"boom-pin\""), ""));
    let title = "f:2:1: `boom-pin` cannot be the name of a joint";
    assert!(dashed[0].starts_with(title), "{dashed:?}");
    let spaced = file(&two.replace("\"a\"", "\"boom pin\""), "");
    assert_eq!(refused(&spaced), Vec::<String>::new());
    // six digits leave this much open of a right angle, five times as much they do not
    let askew = |z: &str| {
        let first = "(0.707107, 0.707107, 0)";
        let directions = format!("({first}, (-0.408248, {z}, 0.816497))");
        file(
            &format!(
                "\"a\": Universal(point: (0, 0, 0), directions: {directions}, between: (\"ground\", \"b\")),"
            ),
            "",
        )
    };
    assert_eq!(refused(&askew("0.408249")), Vec::<String>::new());
    assert_eq!(refused(&askew("0.408256")).len(), 1);
}

#[test]
fn a_rod_of_two_balls_is_a_distance_and_a_universal_joint_two_turns() {
    let text = r#"Axes(version: 1, name: "RSSR", joints: {
        "crank": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, between: ("ground", "disc")),
        "S1": Spherical(point: (1, 0, 0), between: ("disc", "rod")),
        "S2": Spherical(point: (3, 1, 2), between: ("rod", "lever")),
        "lever": Revolute(point: (3, 0, 0), direction: (0, 1, 0.2), between: ("ground", "lever")),
    })"#;
    let description =
        Description::read(&text.replace("\"rod\", \"lever\"", "\"lever\", \"rod\"")).unwrap();
    let made = Mechanism::new(&description).unwrap();
    assert_eq!(made.coordinates().unwrap().rods, ["rod"]);
    assert_eq!(made.platforms().len(), 0);
    assert!((made.dimensions().closures[0].length - 3.0).abs() < 1e-15);
    // with a point on it, it is a body of its own
    let kept = text.replace(
        "})",
        "}, points: { \"P\": (body: \"rod\", at: (2, 1, 1)) })",
    );
    let kept = Mechanism::new(&Description::read(&kept).unwrap()).unwrap();
    assert_eq!((kept.platforms().len(), kept.closures().len()), (1, 2));
    let cardan = r#"Axes(version: 1, name: "cardan", joints: {
        "in":  Revolute(point: (0, 0, 0), direction: (1, 0, 0), role: Actuated, between: ("ground", "in")),
        "U":   Universal(point: (1, 0, 0), directions: ((0, 1, 0), (0, 0, 1)), between: ("in", "out")),
        "out": Revolute(point: (1, 0, 0), direction: ("cos(b)", 0, "sin(b)"), between: ("ground", "out")),
    }, parameters: { "b": "0 deg" })"#;
    let bent = Description::read(cardan)
        .unwrap()
        .with_parameter("b", "0 deg")
        .unwrap();
    assert!(Mechanism::new(&bent).is_ok());
}

/// Joint coordinates, written as tables and read from these again, keep the names of bodies and points, and the home
/// configuration.
#[test]
fn coordinates_that_became_tables_become_coordinates_again() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/axes");
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let given = AxesDescription::read(&text).unwrap();
        let tables = Description::read(&text).unwrap().to_ron().unwrap();
        let tables = Description::read(&tables).unwrap();
        let mechanism = Mechanism::new(&tables).unwrap();
        let (axes, _) = to_axes(&mechanism, &tables).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        let text = axes.to_ron().unwrap();
        let again = Description::read(&text).unwrap_or_else(|e| panic!("{path:?}: {e:?}\n{text}"));
        let made = Mechanism::new(&again).unwrap();
        let bodies = |axes: &AxesDescription| -> Vec<String> {
            let ends = axes
                .joints
                .iter()
                .flat_map(|j| j.value.between.iter().flatten());
            ends.map(|end| end.value.clone()).collect()
        };
        let kept = bodies(&axes);
        for body in bodies(&given) {
            assert!(kept.contains(&body), "{path:?}: no {body}\n{text}");
        }
        let names = |axes: &AxesDescription| -> Vec<String> {
            axes.points.iter().map(|p| p.name.value.clone()).collect()
        };
        for point in names(&given) {
            assert!(
                names(&axes).contains(&point),
                "{path:?}: no {point}\n{text}"
            );
        }
        let [was, is] = [&mechanism, &made].map(|mechanism| solved(mechanism, &[]));
        for (joint, value) in mechanism.joints().iter().zip(&was.joints) {
            let same = is.joints[made.joint(&joint.name).unwrap()];
            assert!((same - value).abs() < 1e-9, "{path:?} {}", joint.name);
        }
    }
}

/// What a table turns by 120° is not rounded, so that proofs go through as before; with a decimal in its place they do not.
#[test]
fn closed_forms_are_proved_after_conversion() {
    let proofs = |mechanism: &Mechanism| {
        let settings = CompareSettings {
            samples: 4,
            ..CompareSettings::default()
        };
        let report = compare(mechanism, &settings, &Watch::none());
        // balls of a platform that is drawn tilted have rounded places
        let forms = report.closed_forms.into_iter();
        let forms = forms.filter(|form| form.name != "closure");
        let proofs = forms.flat_map(|form| form.components.into_iter().map(|part| part.proof));
        proofs.collect::<Vec<_>>()
    };
    for name in ["three_rps", "delta"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
        let (mechanism, made) = by_coordinates(&path);
        assert_eq!(proofs(&mechanism), proofs(&made), "{name}");
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/delta.ron");
    let text = std::fs::read_to_string(&path).unwrap();
    let rounded = text.replace("Rz(\"30 deg\")", "Rz(0.5235987)");
    assert_ne!(rounded, text);
    let rounded = Mechanism::new(&Description::read(&rounded).unwrap());
    let exact = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
    assert_ne!(proofs(&exact), proofs(&rounded.unwrap()));
}
