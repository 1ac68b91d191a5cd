//! Frames placed on joint axes: published tables, and round trips on axes with all special relations.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwork::geometry::{Axis, Line, Pose, Relation, Vector3};
use linkwork::mechanism::{Assignment, Convention, JointAxis, SerialAxes, Table};
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
fn rows(table: &Table) -> Vec<[f64; 4]> {
    let row = |row: &linkwork::mechanism::TableRow| {
        [row.alpha.to_degrees(), row.a, row.d, row.theta.to_degrees()]
    };
    table.rows.iter().map(row).collect()
}

fn assert_rows(table: &Table, expected: &[[f64; 4]]) {
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

const RELATIONS: [Relation; 6] = [
    Relation::Skew,
    Relation::Intersecting,
    Relation::Parallel,
    Relation::AntiParallel,
    Relation::Coincident,
    Relation::AntiCoincident,
];

fn step() -> impl Strategy<Value = Step> {
    let numbers = prop::array::uniform4(-1.0..1.0);
    (0usize..6, prop::bool::weighted(0.3), numbers, -1.5..1.5f64).prop_map(
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
        };
        pose = pose
            * Pose::rotation(Axis::Z, 3.0 * about)
            * translation(apart, 0.0, along)
            * Pose::rotation(Axis::X, twist);
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

fn size(table: &Table) -> f64 {
    let rows = table.rows.iter().map(|row| row.d.abs() + row.a);
    rows.fold(1.0, f64::max)
}

fn check(axes: &SerialAxes, made: &Assignment) -> Result<(), TestCaseError> {
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
