//! Frames placed on joint axes: published tables, and round trips on axes with all special relations.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwork::geometry::{Axis, Line, Pose, Relation, Vector3};
use linkwork::mechanism::{Convention, DhTable, FrameAssignment, JointAxis, SerialAxes};
use linkwork::solve::Watch;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// The same cases on every run.
fn runner(cases: u32) -> TestRunner {
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

fn line(point: [f64; 3], along: [f64; 3]) -> Line {
    Line::new(Vector3(point), Vector3(along)).unwrap()
}

fn revolute(point: [f64; 3], along: [f64; 3], home: f64) -> JointAxis {
    JointAxis::revolute(line(point, along), home)
}

fn translation(x: f64, y: f64, z: f64) -> Pose<f64> {
    Pose::translation(Vector3([x, y, z]))
}

/// α, a, d, θ in degrees and metres.
fn rows(table: &DhTable) -> Vec<[f64; 4]> {
    let row = |row: &linkwork::mechanism::TableRow| {
        [row.alpha.to_degrees(), row.a, row.d, row.theta.to_degrees()]
    };
    table.rows.iter().map(row).collect()
}

fn assert_rows(table: &DhTable, expected: &[[f64; 4]]) {
    let found = rows(table);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        for (x, y) in found.iter().zip(expected) {
            assert!((x - y).abs() < 1e-12, "{found:?} for {expected:?}");
        }
    }
}

/// The PUMA 560 stretched out along x: shoulder at the origin, z upwards (Craig 1986, figure 3.18).
fn puma(a2: f64, a3: f64, d3: f64, d4: f64) -> Vec<JointAxis> {
    let wrist = [a2 + a3, d3, -d4];
    vec![
        revolute([0.0, 0.0, -0.6], [0.0, 0.0, 1.0], 0.0),
        revolute([0.0, 0.3, 0.0], [0.0, 1.0, 0.0], 0.0),
        revolute([a2, 0.1, 0.0], [0.0, 1.0, 0.0], 0.0),
        revolute(wrist, [0.0, 0.0, -1.0], 0.0),
        revolute(wrist, [0.0, 1.0, 0.0], 0.0),
        revolute(wrist, [0.0, 0.0, -1.0], 0.0),
    ]
}

#[test]
fn the_axes_of_the_puma_give_the_lectures_table() {
    let (a2, a3, d3, d4) = (0.4318, 0.0203, 0.15005, 0.4318);
    let axes = SerialAxes {
        base: None,
        joints: puma(a2, a3, d3, d4),
        // T06 of the table at zero: y and z of the last frame point against those of the base
        tool: None,
    };
    let made = axes.assign(Convention::Modified);
    assert_eq!(made.table.base, Pose::identity());
    assert_rows(
        &made.table,
        &[
            [0.0, 0.0, 0.0, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
            [0.0, a2, d3, 0.0],
            [-90.0, a3, d4, 0.0],
            [90.0, 0.0, 0.0, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
        ],
    );
    // the same normals, each read into the row before
    let standard = axes.assign(Convention::Standard);
    assert_rows(
        &standard.table,
        &[
            [-90.0, 0.0, 0.0, 0.0],
            [0.0, a2, 0.0, 0.0],
            [-90.0, a3, d3, 0.0],
            [90.0, 0.0, d4, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
        ],
    );
}

/// Hayati and Mirmirani 1985: axes that a calibration finds some microradians from parallel keep the size of the arm by
/// β; their common normal is 0.43 m/5e-6 away. A tilt of 0.05 rad has a common normal within the arm, which is used.
#[test]
fn nearly_parallel_axes_have_a_turn_about_y_in_place_of_a_far_normal() {
    let elbow = |tilt: [f64; 2]| {
        let mut joints = puma(0.4318, 0.0203, 0.15005, 0.4318);
        let direction = [tilt[0], 1.0, tilt[1]];
        joints[2] = revolute([0.4318, 0.1, 0.0], direction, 0.0);
        SerialAxes {
            base: None,
            joints,
            tool: None,
        }
    };
    for convention in [Convention::Modified, Convention::Standard] {
        for (tilt, is_near) in [
            ([5e-6, -3e-6], true),
            ([-4e-7, 0.0], true),
            ([0.05, 0.02], false),
            ([5e-8, 0.0], false),
        ] {
            let axes = elbow(tilt);
            let made = axes.assign(convention);
            let (turned, moved) = axes.difference(&made.table);
            assert!(turned <= 5.1e-8 && moved < 1e-7, "{turned:e} {moved:e}");
            if is_near {
                assert!(turned < 1e-15 && moved < 1e-12, "{turned:e} {moved:e}");
            }
            let betas = made.table.rows.iter().filter(|row| row.beta != 0.0);
            assert_eq!(betas.count(), usize::from(is_near), "{tilt:?}");
            if tilt[0] < 0.04 {
                assert!(size(&made.table) <= 1.0, "{:?}", rows(&made.table));
            }
            // the products of the rows by matrices of their own
            let mut pose = made.table.base;
            for (row, frame) in made.table.rows.iter().zip(&made.table.frames()[1..]) {
                let joint = Pose::rotation(Axis::Z, row.theta) * translation(0.0, 0.0, row.d);
                let link = translation(row.a, 0.0, 0.0)
                    * Pose::rotation(Axis::X, row.alpha)
                    * Pose::rotation(Axis::Y, row.beta);
                pose = match convention {
                    Convention::Modified => pose * link * joint,
                    Convention::Standard => pose * joint * link,
                };
                assert!((pose.position - frame.position).norm() < 1e-12);
            }
        }
    }
}

fn stanford(q: [f64; 6]) -> Vec<JointAxis> {
    // a table is turned into axes by matrices of its own, not by the code under test
    let (d2, d6) = (0.154, 0.263);
    let rz = |angle: f64| Pose::rotation(Axis::Z, angle);
    let rx = |angle: f64| Pose::rotation(Axis::X, angle);
    let t = |z: f64| translation(0.0, 0.0, z);
    let links = [
        rz(q[0]) * rx(-FRAC_PI_2),
        rz(q[1]) * t(d2) * rx(FRAC_PI_2),
        t(q[2]),
        rz(q[3]) * rx(-FRAC_PI_2),
        rz(q[4]) * rx(FRAC_PI_2),
        rz(q[5]) * t(d6),
    ];
    let mut pose = Pose::identity();
    let mut joints = Vec::new();
    for (k, link) in links.into_iter().enumerate() {
        let z = pose.rotation.column(Axis::Z);
        joints.push(match k {
            // any point will do
            2 => JointAxis::prismatic(Line::new(Vector3([9.0, 8.0, 7.0]), z).unwrap(), q[k]),
            _ => JointAxis::revolute(Line::new(pose.position, z).unwrap(), q[k]),
        });
        pose = pose * link;
    }
    joints
}

#[test]
fn the_axes_of_the_stanford_arm_give_the_slides_table() {
    let q = [0.3, 0.4, 0.6, 0.5, 0.7, -0.9];
    let joints = stanford(q);
    let wrist = joints[5].line;
    let tool = {
        // z along axis 6, x from the slide's product at these values
        let (s, c) = (q[5].sin(), q[5].cos());
        let z = wrist.direction;
        let x5 = joints[4].line.direction.cross(&z);
        let x = x5.times(c) + z.cross(&x5).times(s);
        Pose {
            rotation: linkwork::geometry::Rotation([x, z.cross(&x), z]),
            position: wrist.point + z.times(0.263),
        }
    };
    let axes = SerialAxes {
        base: Some(Pose::identity()),
        joints,
        tool: Some(tool),
    };
    let made = axes.assign(Convention::Standard);
    assert!(made.starts_at_base && made.ends_at_tool);
    assert_eq!(made.table.tip, Pose::identity());
    assert_rows(
        &made.table,
        &[
            [-90.0, 0.0, 0.0, 0.0],
            [90.0, 0.0, 0.154, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
            [90.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.263, 0.0],
        ],
    );
}

/// One more axis, from the one before: how, and four numbers.
#[derive(Clone, Copy, Debug)]
struct Step {
    relation: Relation,
    slides: bool,
    numbers: [f64; 4],
    home: f64,
}

const RELATIONS: [Relation; 7] = [
    Relation::Skew,
    Relation::Intersecting,
    Relation::Parallel,
    Relation::AntiParallel,
    Relation::Coincident,
    Relation::AntiCoincident,
    Relation::NearlyParallel,
];

fn step() -> impl Strategy<Value = Step> {
    let numbers = prop::array::uniform4(-1.0..1.0);
    (0usize..7, prop::bool::weighted(0.3), numbers, -1.5..1.5f64).prop_map(
        |(kind, slides, numbers, home)| Step {
            relation: RELATIONS[kind],
            slides,
            numbers,
            home,
        },
    )
}

/// Axes by a walk, so that consecutive ones have the relations asked for.
fn axes(steps: &[Step]) -> Vec<JointAxis> {
    let mut pose = Pose::rotation(Axis::X, 0.3) * Pose::rotation(Axis::Y, -0.4);
    let mut joints = Vec::new();
    for step in steps {
        let [along, about, twist, apart] = step.numbers;
        let twist = 0.2 + 2.6 * twist.abs();
        let apart = 0.1 + apart.abs();
        let (twist, apart) = match step.relation {
            Relation::Skew => (twist, apart),
            Relation::Intersecting => (twist, 0.0),
            Relation::Parallel => (0.0, apart),
            Relation::AntiParallel => (PI, apart),
            Relation::Coincident => (0.0, 0.0),
            Relation::AntiCoincident => (PI, 0.0),
            Relation::NearlyParallel => (0.0, apart),
        };
        pose = pose
            * Pose::rotation(Axis::Z, 3.0 * about)
            * translation(apart, 0.0, along)
            * Pose::rotation(Axis::X, twist);
        let slid = joints.last().is_none_or(JointAxis::is_prismatic);
        if step.relation == Relation::NearlyParallel && !slid && !step.slides {
            // the two meet 1e5 lengths away or more; a slide may be put where they meet
            pose = pose * Pose::rotation(Axis::Y, 1e-6);
        }
        // the point given is anywhere on the axis
        let line = Line::new(
            (pose * translation(0.0, 0.0, 2.0 * about)).position,
            pose.rotation.column(Axis::Z).times(3.0),
        )
        .unwrap();
        joints.push(match step.slides {
            true => JointAxis::prismatic(line, step.home),
            false => JointAxis::revolute(line, step.home),
        });
    }
    joints
}

fn frame(numbers: [f64; 6]) -> Pose<f64> {
    let [a, b, c, x, y, z] = numbers;
    translation(x, y, z)
        * Pose::rotation(Axis::Z, 3.0 * a)
        * Pose::rotation(Axis::Y, b)
        * Pose::rotation(Axis::X, 3.0 * c)
}

fn serial() -> impl Strategy<Value = SerialAxes> {
    let pose = || prop::option::of(prop::array::uniform6(-1.0..1.0).prop_map(frame));
    (pose(), prop::collection::vec(step(), 1..8), pose()).prop_map(|(base, steps, tool)| {
        SerialAxes {
            base,
            joints: axes(&steps),
            tool,
        }
    })
}

fn size(table: &DhTable) -> f64 {
    let rows = table.rows.iter().map(|row| row.d.abs() + row.a);
    rows.fold(1.0, f64::max)
}

fn check(axes: &SerialAxes, made: &FrameAssignment) -> Result<(), TestCaseError> {
    let (turned, moved) = axes.difference(&made.table);
    let size = size(&made.table);
    prop_assert!(turned < 1e-12, "turned {turned:e}");
    prop_assert!(moved < 1e-12 * size, "moved {moved:e} of {size}");
    prop_assert!(made.table.rows.iter().all(|row| row.a >= 0.0));
    Ok(())
}

#[test]
fn axes_to_rows_to_axes_are_the_same() {
    for convention in Convention::ALL {
        runner(2000)
            .run(&serial(), |axes| {
                let made = axes.assign(convention);
                check(&axes, &made)
            })
            .unwrap();
    }
}

#[test]
fn rows_to_axes_to_rows_are_the_same() {
    for convention in Convention::ALL {
        runner(2000)
            .run(&serial(), |axes| {
                let first = axes.assign(convention);
                let again = first.table.axes().assign(convention);
                check(&first.table.axes(), &again)?;
                let size = size(&first.table);
                for (r, s) in first.table.rows.iter().zip(&again.table.rows) {
                    let angle = |x: f64| (x + PI).rem_euclid(2.0 * PI) - PI;
                    let near = |x: f64, y: f64| (x - y).abs() < 1e-11 * size;
                    prop_assert!(
                        near(r.a, s.a)
                            && near(r.d, s.d)
                            && angle(r.alpha - s.alpha).abs() < 1e-11
                            && angle(r.theta - s.theta).abs() < 1e-11,
                        "{:#?}\n{:#?}",
                        first.table.rows,
                        again.table.rows
                    );
                }
                Ok(())
            })
            .unwrap();
    }
}

/// A length in m and an angle in rad by which two lines differ, sense included.
fn apart(a: &Line, b: &Line) -> f64 {
    let turned = a.direction.cross(&b.direction).norm() + (1.0 - a.direction.dot(&b.direction));
    turned + a.distance(&b.point)
}

#[test]
fn nearly_parallel_axes_are_parallel_or_skew_and_never_blow_up() {
    for exponent in 3..16 {
        let tilt = 10.0_f64.powi(-exponent);
        let axes = SerialAxes {
            base: None,
            joints: vec![
                revolute([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 0.0),
                revolute([1.0, 0.0, 0.0], [0.0, tilt, 1.0], 0.0),
                revolute([2.0, 0.3, 0.0], [0.1, 0.2, 1.0], 0.0),
            ],
            tool: Some(translation(2.0, 0.5, 0.3)),
        };
        for convention in Convention::ALL {
            let made = axes.assign(convention);
            let taken = made.normals[1].relation.unwrap();
            let parallel = tilt <= 1e-7;
            assert_eq!(taken.is_parallel(), parallel, "{tilt:e}");
            // within the tolerance the tilt is dropped; beyond it digits are lost to the far normal
            let allowed = if parallel {
                2.0 * tilt + 1e-15
            } else {
                1e-15 / tilt
            };
            assert!(
                made.turned <= allowed.max(1e-14),
                "{tilt:e}: {:e}",
                made.turned
            );
            assert!(
                made.moved <= allowed.max(1e-14),
                "{tilt:e}: {:e}",
                made.moved
            );
            let finite = |x: &f64| x.is_finite();
            assert!(rows(&made.table).iter().flatten().all(finite));
        }
    }
}

#[test]
fn a_prismatic_axis_is_put_where_the_table_is_simplest_wherever_its_point_is() {
    let axes = |point: [f64; 3]| SerialAxes {
        base: None,
        joints: vec![
            revolute([0.0; 3], [0.0, 0.0, 1.0], 0.0),
            JointAxis::prismatic(line(point, [1.0, 0.0, 0.0]), 0.5),
            revolute([0.5, 0.0, 0.0], [1.0, 0.0, 0.0], 0.0),
        ],
        tool: None,
    };
    let near = axes([0.0; 3]).assign(Convention::Standard);
    let far = axes([3.0, -7.0, 2.0]).assign(Convention::Standard);
    assert_eq!(near.table, far.table);
    // the axis of the slide is that of the joint behind it: nothing but d moves
    assert_rows(
        &near.table,
        &[
            [90.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
        ],
    );
}

mod files {
    use super::*;
    use std::path::{Path, PathBuf};

    use linkwork::analysis::frames::{AxesError, FramesSettings, frames, joint_axes};
    use linkwork::description::{
        AxesDescription, AxisDescription, Description, Lines, Named, Problem,
    };
    use linkwork::mechanism::{Configuration, Frame, Mechanism};
    use linkwork::solve::Newton;
    use linkwork::system::{Question, close};

    fn folder() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms")
    }

    fn shipped(folder: &Path) -> Vec<PathBuf> {
        let entries = folder.read_dir().unwrap();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.retain(|path| path.is_file());
        paths.sort();
        assert!(!paths.is_empty());
        paths
    }

    fn placed(axes: &AxesDescription, convention: Convention) -> Mechanism {
        let settings = FramesSettings {
            convention: Some(convention),
        };
        let report = frames(axes, &settings).unwrap();
        // what is written is what was meant
        let text = report.description.to_ron().unwrap();
        assert_eq!(Description::read(&text).unwrap(), report.description);
        let mechanism = Mechanism::new(&report.description).unwrap();
        assert!(mechanism.warnings().is_empty(), "{text}");
        mechanism
    }

    fn closed(mechanism: &Mechanism) -> Configuration<f64> {
        match mechanism.closures().is_empty() {
            true => mechanism.home(),
            false => {
                let question = Question::new(mechanism);
                let closed = close(&question, &Newton::default(), (20, 1), &Watch::none()).unwrap();
                closed.configuration
            }
        }
    }

    /// A joint's name, a point of its axis and its direction.
    type Placed = (String, Option<Vector3<f64>>, Option<Vector3<f64>>);

    /// The lines of joints, by name; a ball has a point only and a slide a direction only.
    fn lines(axes: &AxesDescription) -> Vec<Placed> {
        use linkwork::description::AxisPlace;
        let vector = |v: &[linkwork::description::Entry; 3]| {
            Vector3(v.each_ref().map(|x| x.expression.as_number().unwrap()))
        };
        let line = |joint: &Named<AxisDescription>| {
            let (point, along) = match &joint.value.place {
                AxisPlace::Along(point, along) => (point.as_ref().map(vector), Some(vector(along))),
                AxisPlace::Centre(point) => (Some(vector(point)), None),
                AxisPlace::Through(..) | AxisPlace::Cross(..) | AxisPlace::Frame(_) => {
                    unreachable!("axes of tables are written with directions")
                }
            };
            (joint.name.value.clone(), point, along)
        };
        let mut lines: Vec<_> = axes.joints.iter().map(line).collect();
        lines.sort_by(|a, b| a.0.cmp(&b.0));
        lines
    }

    #[test]
    fn shipped_mechanisms_to_axes_to_mechanisms_have_the_same_axes_and_are_assembled() {
        let mut made = 0;
        for path in shipped(&folder()) {
            let mechanism = linkwork::load(&path).unwrap();
            let axes = match joint_axes(&mechanism, &closed(&mechanism)) {
                Ok(axes) => axes,
                Err(AxesError::Row { .. } | AxesError::Closure { .. }) => continue,
                Err(AxesError::TooFew) => {
                    panic!("{path:?} has joints")
                }
            };
            let text = axes.to_ron().unwrap();
            let read = AxesDescription::read(&text).unwrap();
            assert_eq!(read, axes, "{text}");
            for convention in Convention::ALL {
                let again = placed(&axes, convention);
                let home = again.home();
                for closure in again.closures() {
                    let [a, b] = again.poses(closure.frames, &home);
                    let gap = (a.position - b.position).norm();
                    let z = |pose: &Pose<f64>| pose.rotation.column(Axis::Z);
                    let kind = format!("{:?}", closure.kind);
                    if kind != "Prismatic" {
                        assert!(
                            gap < 1e-12 * again.characteristic_length().max(1.0),
                            "{path:?} {gap:e}"
                        );
                    }
                    if kind != "Spherical" {
                        assert!((z(&a) - z(&b)).norm() < 1e-12, "{path:?}");
                    }
                }
                let back = joint_axes(&again, &home).unwrap();
                let (given, back) = (lines(&axes), lines(&back));
                assert_eq!(given.len(), back.len(), "{path:?}");
                for ((name, point, along), (other, at, found)) in given.iter().zip(&back) {
                    assert_eq!(name, other);
                    if let (Some(u), Some(v)) = (along, found) {
                        // passed from its second body to its first, a joint points the other way
                        let sense = u.dot(v).signum();
                        assert!((*u - v.times(sense)).norm() < 1e-12, "{path:?} {name}");
                    }
                    match (point, at, along, found) {
                        (Some(p), Some(q), None, None) => assert!((*p - *q).norm() < 1e-12),
                        (Some(p), Some(q), Some(u), Some(v)) => {
                            let given = Line::new(*p, *u).unwrap();
                            let found = Line::new(*q, v.times(u.dot(v).signum())).unwrap();
                            let apart = apart(&given, &found);
                            assert!(apart < 2e-12, "{path:?} {name}: {apart:e}");
                        }
                        _ => {}
                    }
                }
                made += 1;
            }
        }
        assert!(made > 60, "{made}");
    }

    #[test]
    fn closed_mechanisms_move_as_before() {
        let names = [
            "four_bar",
            "slider_crank",
            "bennett",
            "watt_six_bar",
            "planar_3rpr",
            "three_rps",
            "sarrus",
        ];
        for name in names {
            let mechanism = linkwork::load(folder().join(format!("{name}.ron"))).unwrap();
            let at = closed(&mechanism);
            let axes = joint_axes(&mechanism, &at).unwrap();
            let again = placed(&axes, Convention::Modified);
            let moved = |m: &Mechanism| {
                let mut question = Question::new(m);
                for (joint, value) in mechanism.joints().iter().zip(&at.joints) {
                    if joint.role == linkwork::mechanism::Role::Actuated {
                        question = question
                            .hold(&joint.name, format!("{} + 0.02", value))
                            .unwrap();
                    }
                }
                close(&question, &Newton::default(), (0, 1), &Watch::none())
                    .unwrap()
                    .configuration
            };
            let (a, b) = (moved(&mechanism), moved(&again));
            let mut compared = 0;
            for (i, joint) in mechanism.joints().iter().enumerate() {
                if let Some(k) = again.joint(&joint.name) {
                    let apart = (a.joints[i] - b.joints[k]).abs();
                    assert!(apart < 1e-9, "{name} {}: {apart:e}", joint.name);
                    compared += 1;
                }
            }
            assert!(compared >= 2, "{name}");
        }
    }

    #[test]
    fn serial_chains_move_as_before() {
        // beyond home the joint variables must mean the same
        for name in [
            "puma560_modified",
            "stanford_arm",
            "scara_modified",
            "scara_standard",
            "rpp_wrist",
        ] {
            let mechanism = linkwork::load(folder().join(format!("{name}.ron"))).unwrap();
            let axes = joint_axes(&mechanism, &mechanism.home()).unwrap();
            for convention in Convention::ALL {
                let again = placed(&axes, convention);
                for k in 1..8 {
                    let mut at = mechanism.home();
                    let mut there = again.home();
                    for (i, joint) in mechanism.joints().iter().enumerate() {
                        let value = joint.home + (f64::from(k) * (i as f64 + 1.3)).sin();
                        at.joints[i] = value;
                        there.joints[again.joint(&joint.name).unwrap()] = value;
                    }
                    let tip =
                        |m: &Mechanism, at| m.transform(Frame::Ground, Frame::Tip { chain: 0 }, at);
                    let (a, b) = (tip(&mechanism, &at), tip(&again, &there));
                    assert!((a.position - b.position).norm() < 1e-12, "{name}");
                    for (u, v) in a.rotation.0.iter().zip(&b.rotation.0) {
                        assert!((*u - *v).norm() < 1e-12, "{name}");
                    }
                }
            }
        }
    }

    #[test]
    fn canonical_tables_come_back_as_they_are() {
        let same = [
            "puma560_modified",
            "stanford_arm",
            "planar_3r",
            "spherical_wrist",
            "elbow_manipulator",
        ];
        for name in same {
            let mechanism = linkwork::load(folder().join(format!("{name}.ron"))).unwrap();
            let convention = mechanism.chains()[0].convention;
            let axes = joint_axes(&mechanism, &mechanism.home()).unwrap();
            let again = placed(&axes, convention);
            let (a, b) = (
                &mechanism.dimensions().chains[0],
                &again.dimensions().chains[0],
            );
            for (a, b) in a.rows.iter().zip(&b.rows) {
                for (p, q) in [(a.before, b.before), (a.after, b.after)] {
                    assert!((p.position - q.position).norm() < 1e-12, "{name}");
                    for (u, v) in p.rotation.0.iter().zip(&q.rotation.0) {
                        assert!((*u - *v).norm() < 1e-12, "{name}");
                    }
                }
            }
        }
    }

    #[test]
    fn shipped_axes_give_mechanisms_in_both_conventions() {
        let mut placed_all = 0;
        for path in shipped(&folder().join("axes")) {
            let axes = AxesDescription::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
            if let Err(problems) = frames(&axes, &FramesSettings::default()) {
                // rods, gears and frames have no rows among these tables
                let kinds = problems.iter().map(|problem| problem.kind.title());
                let only = "`frames` places revolute, prismatic and spherical joints ";
                assert!(
                    kinds.clone().all(|title| title.starts_with(only)),
                    "{path:?}"
                );
                continue;
            }
            placed_all += 1;
            for convention in Convention::ALL {
                let mechanism = placed(&axes, convention);
                let gap = close(
                    &Question::new(&mechanism),
                    &Newton::default(),
                    (0, 1),
                    &Watch::none(),
                );
                assert!(mechanism.closures().is_empty() || gap.is_ok(), "{path:?}");
            }
        }
        assert!(placed_all >= 2, "{placed_all}");
    }

    #[test]
    fn every_choice_of_cuts_assembles_where_the_axes_are() {
        let text = std::fs::read_to_string(folder().join("axes/four_bar.ron")).unwrap();
        for cut in ["theta1", "phi2", "phi3", "phi1"] {
            let text = text.replacen("joints:", &format!("cut: [\"{cut}\"],\n    joints:"), 1);
            let axes = AxesDescription::read(&text).unwrap();
            for convention in Convention::ALL {
                let mechanism = placed(&axes, convention);
                assert_eq!(mechanism.closures().len(), 1);
                assert!(mechanism.joint(cut).is_none());
                let frames = mechanism.closures()[0].frames;
                let [a, b] = mechanism.poses(frames, &mechanism.home());
                assert!((a.position - b.position).norm() < 1e-14, "{cut}");
            }
        }
    }

    fn titles(text: &str) -> Vec<String> {
        let problems = match AxesDescription::read(text) {
            Ok(axes) => frames(&axes, &FramesSettings::default())
                .map(|_| ())
                .unwrap_err(),
            Err(problems) => problems,
        };
        let shown = |problem: &Problem| {
            let (line, column) = Lines::new(text).position(problem.span.start);
            let help = problem
                .kind
                .help()
                .map_or(String::new(), |help| format!(" ({help})"));
            format!("{line}:{column} {}{help}", problem.kind.title())
        };
        problems.iter().map(shown).collect()
    }

    #[test]
    fn wrong_axes_are_pointed_at() {
        let serial =
            |joints: &str| format!("Axes(version: 1, name: \"x\", joints: {{\n{joints}}})");
        let q = "\"q\": Revolute(point: (0, 0, 0), direction: (0, 0, 1)),\n";
        assert_eq!(
            titles(&serial(&format!(
                "{q}\"p\": Prismatic(direction: (0, 0, \"1 - 1\"))"
            ))),
            [
                "3:28 the axis of joint `p` has no direction (give a nonzero vector, or two different points)"
            ]
        );
        assert_eq!(
            titles(&serial(&format!(
                "{q}\"p\": Revolute(through: ((1, 2, 3), (1, 2, 3)))"
            ))),
            [
                "3:26 the axis of joint `p` has no direction (give a nonzero vector, or two different points)"
            ]
        );
        assert_eq!(
            titles(&serial(q)),
            ["1:24 there is only one joint (a table needs at least two axes)"]
        );
        assert_eq!(
            titles(&serial("")),
            ["1:24 there are no joints (a table needs at least two axes)"]
        );
        assert_eq!(
            titles(&serial(&format!(
                "{q}\"p\": Revolut(point: (0, 0, 0), direction: (0, 1, l))"
            ))),
            [
                "3:6 expected a joint such as `Revolute(…)`, `Prismatic(…)` or `Spherical(…)`, found `Revolut` (did you mean `Revolute`?)"
            ]
        );
        assert_eq!(
            titles(&serial(&format!(
                "{q}\"p\": Prismatic(direction: (0, 1, \"l\"))"
            ))),
            ["3:35 `l` is not a parameter (declare it under `parameters`)"]
        );
        assert_eq!(
            titles(&serial(&format!(
                "{q}\"p\": Revolute(direction: (0, 1, 0))"
            ))),
            ["3:6 a revolute joint needs the field `point`"]
        );
        let closed = |joints: &str, cut: &str| {
            format!("Axes(version: 1, name: \"x\", cut: [{cut}],\njoints: {{ {joints} }})")
        };
        let joint = |name: &str, x: i32, a: &str, b: &str| {
            format!(
                "\"{name}\": Revolute(point: ({x}, 0, 0), direction: (0, 0, 1), between: (\"{a}\", \"{b}\")),\n"
            )
        };
        let triangle =
            joint("a", 0, "ground", "u") + &joint("b", 1, "u", "v") + &joint("c", 2, "v", "ground");
        let starts = |text: String, start: &str| {
            let found = titles(&text);
            assert!(found.len() == 1 && found[0].contains(start), "{found:?}");
        };
        assert!(titles_none(&closed(&triangle, "")));
        starts(closed(&triangle, "\"d\""), "there is no joint `d` to cut");
        starts(
            closed(&triangle, "\"a\", \"b\""),
            "cutting the joint `b` disconnects bodies",
        );
        let two = triangle.clone() + &joint("d", 3, "u", "ground");
        starts(closed(&two, "\"a\""), "leave a closed loop");
        starts(
            closed(&(triangle.clone() + &joint("d", 3, "s", "t")), ""),
            "no joints connect the body `s`",
        );
        starts(
            closed(&(triangle.clone() + &joint("d", 3, "s", "s")), ""),
            "connects the body `s` with itself",
        );
        starts(
            closed(&(triangle + q), ""),
            "the joint `q` does not name the bodies that it connects",
        );
        starts(
            closed(&(joint("a", 0, "u", "v") + &joint("b", 1, "v", "w")), ""),
            "no joint connects anything with `ground`",
        );
    }

    /// The titles of the warnings for a file of axes.
    fn warned(text: &str) -> Vec<String> {
        let axes = AxesDescription::read(text).unwrap();
        let report = frames(&axes, &FramesSettings::default()).unwrap();
        report.warnings.iter().map(|p| p.kind.title()).collect()
    }

    #[test]
    fn frames_finds_the_problems_that_check_finds() {
        // rods, outputs and loads use these parameters
        for file in ["axes/wiper", "loads/engine", "loads/toggle_press"] {
            let text = std::fs::read_to_string(folder().join(format!("{file}.ron"))).unwrap();
            assert_eq!(warned(&text), [""; 0], "{file}");
        }
        let wrong = r#"Axes(version: 1, name: "w", joints: {
            "a": Revolute(point: (0, 0, 0), direction: (0, 0, 1)),
            "s": Prismatic(direction: (1, 0, 0), limits: (0, "20 deg")),
        }, base: [Tx("b*2")])"#;
        let axes = AxesDescription::read(wrong).unwrap();
        let found = frames(&axes, &FramesSettings::default()).unwrap_err();
        assert_eq!(found, Mechanism::problems(wrong));
        let titles: Vec<String> = found.iter().map(|of| of.kind.title()).collect();
        let expected = [
            "expected a length, found an angle",
            "`b` is not a parameter",
        ];
        assert_eq!(titles, expected);
    }

    #[test]
    fn what_cuts_and_bases_do_not_keep_is_warned_of() {
        let four_bar = std::fs::read_to_string(folder().join("axes/four_bar.ron")).unwrap();
        assert!(warned(&four_bar).is_empty());
        let cut =
            |joint: &str| four_bar.replacen("joints:", &format!("cut: [\"{joint}\"], joints:"), 1);
        assert_eq!(
            warned(&cut("theta1")),
            ["the driven joint `theta1` is cut and loses its variable"]
        );
        assert!(warned(&cut("phi1")).is_empty());
        let home = "home: \"atan2(y3, x3 - l0)\"";
        let limited = cut("phi1").replacen(home, &format!("{home}, limits: (0, 3)"), 1);
        assert_eq!(
            warned(&limited),
            ["the joint `phi1` is cut and loses its variable and its limits"]
        );
        // where no role is given the first joint that is not cut is driven
        let silent = cut("theta1").replace("role: Actuated, ", "");
        let axes = AxesDescription::read(&silent).unwrap();
        let report = frames(&axes, &FramesSettings::default()).unwrap();
        let mechanism = Mechanism::new(&report.description).unwrap();
        let driven = mechanism.joint("phi2").map(|j| mechanism.joints()[j].role);
        assert_eq!(driven, Some(linkwork::mechanism::Role::Actuated));
        let based = |base: &str| {
            format!(
                "Axes(version: 1, name: \"b\", base: [{base}], joints: {{
                \"a\": Revolute(point: (0, 0, 0), direction: (0, 0, 1)),
                \"b\": Revolute(point: (1, 0, 0), direction: (0, 1, 0)) }})"
            )
        };
        assert_eq!(
            warned(&based("T(1, 0, 2)")),
            ["frame 0 cannot be placed as `base` says; it is placed freely"]
        );
        assert!(warned(&based("T(-1, 0, 2)")).is_empty());
        assert!(warned(&based("Tz(2)")).is_empty());
    }

    #[test]
    fn the_sense_of_the_first_normal_is_told_as_it_is() {
        use linkwork::output::Report;
        let sense = |first: &str, second: &str, home: f64| {
            let text = format!(
                "Axes(version: 1, name: \"p\", joints: {{
                \"a\": Revolute(point: (0, 0, 0), direction: ({first}), home: {home}),
                \"b\": Revolute(point: (0, 0, 0), direction: ({second})) }})"
            );
            let axes = AxesDescription::read(&text).unwrap();
            let report = frames(&axes, &FramesSettings::default()).unwrap();
            let said = linkwork::output::text::render(&report.document());
            let x0 = report.chains[0].frames[0].x;
            let line = said.lines().find(|line| line.contains("sense of x1: "));
            let line = line.unwrap().split("sense of x1: ").nth(1).unwrap().trim();
            (line.to_owned(), x0)
        };
        let (said, x0) = sense("0, 0, 1", "0, 1, 0", 0.0);
        assert_eq!(said, "x0 within ±90° of the coordinates' x");
        assert!(x0[0] > 0.99);
        // turned by its home, the first frame is still the nearest
        let (said, x0) = sense("0, 0, 1", "1, 1, 0", 2.0);
        assert_eq!(said, "x0 within ±90° of the coordinates' x");
        assert!(x0[0] > 0.0);
        let (said, x0) = sense("1, 0, 0", "0, 0, 1", 0.0);
        assert_eq!(said, "x0 within ±90° of the coordinates' y");
        assert!(x0[1] > 0.99);
        // neither of them: along the vector product
        let (said, x0) = sense("1, 0, 0", "0, 1, 0", 0.0);
        assert_eq!(said, "along z1 × z2");
        assert!(x0[2] > 0.99);
        let (said, _) = sense("0, 0, 1", "1, 0, 0", 0.0);
        assert_eq!(said, "along z1 × z2");
    }

    #[test]
    fn rods_cylinders_and_planes_have_axes() {
        // what closes them moves as before: the same freedoms, and the rods keep their lengths
        for name in [
            "rssr",
            "delta",
            "stewart_gough_6sps",
            "three_fingered_hand_distances",
        ] {
            let mechanism = linkwork::load(folder().join(format!("{name}.ron"))).unwrap();
            let at = closed(&mechanism);
            let axes = joint_axes(&mechanism, &at).unwrap();
            let balls = axes
                .joints
                .iter()
                .filter(|j| j.value.kind == linkwork::description::AxisKind::Spherical);
            let rods = mechanism
                .closures()
                .iter()
                .filter(|c| c.kind == linkwork::mechanism::ClosureKind::Distance);
            assert!(balls.count() >= 2 * rods.count(), "{name}");
            let again = placed(&axes, Convention::Modified);
            let held = mechanism.joints().iter().zip(&at.joints);
            let held = held.filter(|(j, _)| j.role == linkwork::mechanism::Role::Actuated);
            let mut questions = [Question::new(&mechanism), Question::new(&again)];
            for (joint, value) in held {
                let value = format!("{} + 0.01", value);
                questions = questions.map(|question| question.hold(&joint.name, &value).unwrap());
            }
            let found = questions.map(|q| {
                close(&q, &Newton::default(), (0, 1), &Watch::none())
                    .unwrap()
                    .configuration
            });
            for (i, joint) in mechanism.joints().iter().enumerate() {
                let Some(k) = again.joint(&joint.name) else {
                    continue;
                };
                let apart = (found[0].joints[i] - found[1].joints[k]).abs();
                assert!(apart < 1e-9, "{name} {}: {apart:e}", joint.name);
            }
        }
        // an arm that only balls hold once its hinge is cut becomes a platform
        let mechanism = linkwork::load(folder().join("delta.ron")).unwrap();
        let mut axes = joint_axes(&mechanism, &closed(&mechanism)).unwrap();
        axes.cut = vec![linkwork::description::Spanned::new("theta1".into(), 0..0)];
        let again = placed(&axes, Convention::Modified);
        assert_eq!(again.platforms().len(), mechanism.platforms().len() + 7);
        assert!(again.joint("theta1").is_none());
        let home = again.home();
        for closure in again.closures() {
            let [a, b] = again.poses(closure.frames, &home);
            assert!((a.position - b.position).norm() < 1e-12);
        }
        let cylinder = r#"Mechanism(version: 1, name: "c", convention: Modified,
            joints: { "q": Actuated(home: 0.3), "s": Actuated(home: 0.2), "p": Actuated(home: 0.1) },
            chains: { "c": Chain(rows: [(theta: "q", d: "s"), (alpha: "90 deg", a: 1, theta: "p")], tip: [Tx(2)]) })"#;
        let mechanism = Mechanism::new(&Description::read(cylinder).unwrap()).unwrap();
        let axes = joint_axes(&mechanism, &mechanism.home()).unwrap();
        let again = placed(&axes, Convention::Modified);
        let values = [0.7, -0.4, 1.1];
        let tips = [&mechanism, &again].map(|m| {
            let mut at = m.home();
            for (name, value) in ["q", "s", "p"].into_iter().zip(values) {
                at.joints[m.joint(name).unwrap()] = value;
            }
            m.transform(Frame::Ground, Frame::Tip { chain: 0 }, &at)
        });
        assert!((tips[0].position - tips[1].position).norm() < 1e-12);
        // one variable in both is a screw, which is no axis of these kinds
        let screw = cylinder
            .replace("d: \"s\"", "d: \"0.1*q\"")
            .replace("\"s\": Actuated(home: 0.2), ", "");
        let screw = Mechanism::new(&Description::read(&screw).unwrap()).unwrap();
        assert!(matches!(
            joint_axes(&screw, &screw.home()),
            Err(AxesError::Row { row: 1, .. })
        ));
    }

    fn titles_none(text: &str) -> bool {
        AxesDescription::read(text)
            .is_ok_and(|axes| frames(&axes, &FramesSettings::default()).is_ok())
    }

    #[test]
    fn damaged_files_are_answered_without_a_panic() {
        let texts: Vec<String> = shipped(&folder().join("axes"))
            .iter()
            .map(|path| std::fs::read_to_string(path).unwrap())
            .collect();
        let pieces = [
            "0",
            "-1",
            "1e308",
            "1e-320",
            "\"q\"",
            "ground",
            "()",
            "(0, 0, 0)",
            "[]",
            "{",
            "}",
            ",",
            "(",
            "Spherical",
            "Prismatic",
            "between",
            "cut: [\"phi1\"],",
            "tool: [Tx(1)],",
            "base: [],",
            "inf",
        ];
        let damage = (
            0..texts.len(),
            0.0..1.0f64,
            0usize..40,
            0..pieces.len(),
            0.0..1.0f64,
            0..pieces.len(),
        );
        runner(1500)
            .run(&damage, |(file, at, removed, piece, second, other)| {
                let mut text: Vec<char> = texts[file].chars().collect();
                for (at, piece) in [(at, piece), (second, other)] {
                    let start = (at * text.len() as f64) as usize;
                    let end = (start + removed).min(text.len());
                    text.splice(start..end, pieces[piece].chars());
                }
                let text: String = text.into_iter().collect();
                if let Ok(axes) = AxesDescription::read(&text)
                    && let Ok(report) = frames(&axes, &FramesSettings::default())
                {
                    prop_assert!(
                        report.turned.is_finite() && report.moved.is_finite(),
                        "{text}"
                    );
                    prop_assert!(Mechanism::new(&report.description).is_ok(), "{text}");
                }
                Ok(())
            })
            .unwrap();
    }
}
