//! Random mechanisms whose closures hold by construction must be found again; the same with one
//! dimension wrong must not assemble where nothing can give way.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwork::description::{ClosureKind, Description};
use linkwork::geometry::{Axis, Pose, Quaternion, RollPitchYaw, Rotation, Vector3};
use linkwork::mechanism::{Configuration, Mechanism, PlatformPose, PoseCoordinate};
use linkwork::number::Dual;
use linkwork::solve::{Equations, Newton, Stop};
use linkwork::system::{Freedoms, Held, HeldParts, HeldPlatform, System};
use nalgebra::{DMatrix, DVector};
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

/// A row of a table: α, a, d, θ, and whether it turns or slides.
#[derive(Clone, Debug)]
struct Row {
    entries: [f64; 4],
    slides: bool,
}

/// A leg from ground to the platform, ending in a closure.
#[derive(Clone, Debug)]
struct Leg {
    base: [f64; 6],
    rows: Vec<Row>,
    kind: ClosureKind,
    /// Free parameters of the closure at the configuration: where its frames may still differ.
    play: [f64; 6],
    standard: bool,
}

#[derive(Clone, Debug)]
struct Sketch {
    platform: [f64; 6],
    legs: Vec<Leg>,
}

fn six() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-1.0..1.0)
}

fn sketch() -> impl Strategy<Value = Sketch> {
    let row = (prop::array::uniform4(-1.0..1.0), prop::bool::weighted(0.25)).prop_map(
        |([alpha, a, d, theta], slides): ([f64; 4], bool)| Row {
            entries: [2.0 * alpha, a.abs() + 0.1, d, 2.5 * theta],
            slides,
        },
    );
    let kind = prop::sample::select(joining());
    let rows = prop::collection::vec(row, 1..4);
    let leg =
        (six(), rows, kind, six(), any::<bool>()).prop_map(|(base, rows, kind, play, standard)| {
            Leg {
                base,
                rows,
                kind,
                play,
                standard,
            }
        });
    (six(), prop::collection::vec(leg, 2..5)).prop_map(|(platform, legs)| Sketch { platform, legs })
}

/// A pose from three coordinates and three angles.
fn pose([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Pose<f64> {
    let angles = RollPitchYaw {
        roll: PI * roll,
        pitch: 1.4 * pitch,
        yaw: PI * yaw,
    };
    Pose {
        rotation: angles.rotation(),
        position: Vector3([x, y, z]),
    }
}

/// A pose as a list of displacements, to all its digits.
fn written(pose: &Pose<f64>) -> String {
    let [x, y, z] = pose.position.0;
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
    format!("[T({x:?}, {y:?}, {z:?}), Rz({yaw:?}), Ry({pitch:?}), Rx({roll:?})]")
}

/// The closures that join frames.
fn joining() -> Vec<ClosureKind> {
    let mut kinds = ClosureKind::ALL.to_vec();
    kinds.retain(|kind| *kind != ClosureKind::Coupling);
    kinds
}

impl Leg {
    /// What a closure leaves between its frames: B seen from A.
    fn between(&self) -> Pose<f64> {
        let [x, y, z, a, b, c] = self.play;
        let shift = |x, y, z| Pose::translation(Vector3([x, y, z]));
        let turn = |axis, angle| Pose::rotation(axis, angle);
        match self.kind {
            ClosureKind::Spherical => pose([0.0, 0.0, 0.0, a, b, c]),
            ClosureKind::Revolute => turn(Axis::Z, 2.0 * a),
            ClosureKind::Prismatic => shift(0.0, 0.0, z),
            ClosureKind::Universal => {
                turn(Axis::Z, 2.0 * a) * turn(Axis::X, FRAC_PI_2) * turn(Axis::Z, 2.0 * b)
            }
            ClosureKind::Cylindrical => turn(Axis::Z, 2.0 * a) * shift(0.0, 0.0, z),
            ClosureKind::Planar => shift(x, y, 0.0) * turn(Axis::Z, 2.0 * a),
            ClosureKind::Rigid => Pose::identity(),
            ClosureKind::Distance => pose([x, y, z + 1.5, a, b, c]),
            ClosureKind::Coupling => unreachable!("it joins no frames"),
        }
    }

    /// The tip, multiplied out here independently of the kernel.
    fn tip(&self) -> Pose<f64> {
        self.rows.iter().fold(pose(self.base), |at, row| {
            let [alpha, a, d, theta] = row.entries;
            let along_x = Pose::translation(Vector3([a, 0.0, 0.0]));
            let along_z = Pose::translation(Vector3([0.0, 0.0, d]));
            let link = Pose::rotation(Axis::X, alpha) * along_x;
            let joint = Pose::rotation(Axis::Z, theta) * along_z;
            at * if self.standard {
                joint * link
            } else {
                link * joint
            }
        })
    }
}

impl Sketch {
    /// The mechanism file: its home is the configuration in which every closure holds.
    fn ron(&self) -> String {
        let (mut joints, mut chains) = (String::new(), String::new());
        let (mut frames, mut closures) = (String::new(), String::new());
        let platform = pose(self.platform);
        for (i, leg) in self.legs.iter().enumerate() {
            let mut rows = String::new();
            for (j, row) in leg.rows.iter().enumerate() {
                let [alpha, a, d, theta] = row.entries;
                let name = format!("q{i}{j}");
                let home = if row.slides { d } else { theta };
                joints += &format!("\"{name}\": Passive(home: {home:?}),");
                rows += &match row.slides {
                    true => {
                        format!("(alpha: {alpha:?}, a: {a:?}, d: \"{name}\", theta: {theta:?}),")
                    }
                    false => format!("(alpha: {alpha:?}, a: {a:?}, d: {d:?}, theta: \"{name}\"),"),
                };
            }
            let convention = if leg.standard { "Standard" } else { "Modified" };
            let base = written(&pose(leg.base));
            chains += &format!(
                "\"leg{i}\": Chain(convention: {convention}, base: {base}, rows: [{rows}]),\n"
            );
            let between = leg.between();
            let frame = platform.inverse() * leg.tip() * between;
            frames += &format!("\"F{i}\": {},\n", written(&frame));
            let kind = leg.kind.word();
            let length = match leg.kind {
                ClosureKind::Distance => format!(", {:?}", between.position.norm()),
                _ => String::new(),
            };
            closures += &format!("\"c{i}\": {kind}(\"leg{i}\", \"top.F{i}\"{length}),\n");
        }
        let home = written(&platform);
        format!(
            "Mechanism(version: 1, name: \"random\", convention: Modified,\njoints: {{{joints}}},\n\
             chains: {{{chains}}},\nplatforms: {{\"top\": Platform(home: {home}, frames: {{{frames}}})}},\n\
             closures: {{{closures}}})"
        )
    }

    fn mechanism(&self) -> Mechanism {
        let text = self.ron();
        let description = Description::read(&text).unwrap_or_else(|p| panic!("{text}\n{p:?}"));
        Mechanism::new(&description).unwrap()
    }
}

/// Joints held one after another until nothing moves, or all of them.
fn held_until_fixed(mechanism: &Mechanism) -> (Held<f64>, Freedoms) {
    let (dimensions, home) = (mechanism.dimensions(), mechanism.home());
    let mut held = Held {
        joints: vec![false; mechanism.joints().len()],
        platforms: vec![HeldPlatform::Free],
    };
    let mut freedoms = Freedoms::at(dimensions, &held, &home);
    for joint in 0..held.joints.len() {
        if freedoms.motions.is_empty() {
            break;
        }
        held.joints[joint] = true;
        let fewer = Freedoms::at(dimensions, &held, &home);
        match fewer.motions.len() < freedoms.motions.len() {
            true => freedoms = fewer,
            false => held.joints[joint] = false,
        }
    }
    (held, freedoms)
}

fn solve(system: &System<f64>, start: &Configuration<f64>) -> (Configuration<f64>, Stop, f64) {
    let (mut at, mut trial, mut work) = (start.clone(), start.clone(), system.work());
    let report = Newton::default().solve(system, &mut at, &mut trial, &mut work);
    (at, report.stop, report.size.squares.sqrt())
}

fn apart(mechanism: &Mechanism, a: &Configuration<f64>, b: &Configuration<f64>) -> f64 {
    let length = mechanism.characteristic_length();
    let scales = &mechanism.dimensions().joint_scales;
    let joints = (a.joints.iter().zip(&b.joints).zip(scales)).map(|((x, y), s)| (x - y).abs() / s);
    let platforms = a.platforms.iter().zip(&b.platforms).flat_map(|(a, b)| {
        let (a, b) = (a.pose(), b.pose());
        let turns = (a.rotation.rows().into_iter().flatten())
            .zip(b.rotation.rows().into_iter().flatten())
            .map(|(x, y)| (x - y).abs());
        let shifts =
            (a.position.0.into_iter().zip(b.position.0)).map(move |(x, y)| (x - y).abs() / length);
        turns.chain(shifts).collect::<Vec<f64>>()
    });
    joints.chain(platforms).fold(0.0, f64::max)
}

#[test]
fn a_mechanism_closed_by_construction_is_found_again() {
    let (mut determined, mut kinds) = (0, std::collections::BTreeSet::new());
    let strategy = (sketch(), prop::collection::vec(-1.0..1.0f64, 32));
    let cases = std::cell::RefCell::new((&mut determined, &mut kinds));
    runner(400)
        .run(&strategy, |(sketch, noise)| {
            let mechanism = sketch.mechanism();
            let home = mechanism.home();
            let (held, freedoms) = held_until_fixed(&mechanism);
            let system = System::new(mechanism.dimensions(), &held);
            let mut work = system.work();
            let residual = system.residual(&home, &mut work).largest;
            prop_assert!(residual <= 1e-13, "not closed by construction: {residual}");

            let condition = freedoms.condition();
            // the basin of a badly conditioned solution is small
            let aside = if condition < 1e2 { 0.05 } else { 1e-4 };
            let step: Vec<f64> = (noise.iter().cycle())
                .take(system.unknowns().len())
                .map(|x| aside * x)
                .collect();
            let (at, stop, size) = solve(&system, &system.displaced(&home, &step));
            prop_assert_eq!(stop, Stop::Solved, "condition {}", condition);
            prop_assert!(size <= 1e-12 * (system.rows() as f64).sqrt());
            let (determined, kinds) = &mut *cases.borrow_mut();
            kinds.extend(sketch.legs.iter().map(|leg| leg.kind.word()));
            if condition < 1e2 {
                let apart = apart(&mechanism, &at, &home);
                prop_assert!(apart <= 1e-9, "{apart} away, condition {condition}");
                **determined += 1;
            }
            Ok(())
        })
        .unwrap();
    assert_eq!(kinds.len(), 8);
    assert!(determined > 150, "{determined} of 400 determined");
}

/// What of the residual no motion of the unknowns can take away, to first order.
fn leftover(system: &System<f64>, at: &Configuration<f64>) -> f64 {
    let mut work = system.work();
    system.linearise(at, &mut work);
    let residual = DVector::from_column_slice(system.residual_of(&work));
    let (rows, columns) = (system.rows(), system.unknowns().len());
    let jacobian = DMatrix::from_vec(rows, columns, system.dense_jacobian(&work));
    let step = jacobian
        .clone()
        .svd(true, true)
        .solve(&residual, 1e-9)
        .unwrap();
    (jacobian * step - residual).norm()
}

#[test]
fn with_one_twist_or_length_wrong_a_structure_without_freedom_does_not_assemble() {
    let mut refused = 0;
    let refusals = std::cell::RefCell::new(&mut refused);
    let strategy = (sketch(), 0..4usize, any::<bool>());
    runner(400)
        .run(&strategy, |(sketch, leg, twist)| {
            let mechanism = sketch.mechanism();
            let (held, freedoms) = held_until_fixed(&mechanism);
            let mut wrong = sketch.clone();
            let leg = leg % wrong.legs.len();
            // the wrong dimension goes into the row only: the platform's frames stay as they were
            let frames = wrong.ron();
            let entry = usize::from(!twist);
            let old = wrong.legs[leg].rows[0].entries[entry];
            wrong.legs[leg].rows[0].entries[entry] = old + 1e-3;
            let rows = |text: &str| -> String {
                let start = text.find("chains:").unwrap();
                text[start..text.find("platforms:").unwrap()].to_owned()
            };
            let text = frames.replace(&rows(&frames), &rows(&wrong.ron()));
            let wrong = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
            let system = System::new(wrong.dimensions(), &held);
            let left = leftover(&system, &wrong.home());
            let rigid = freedoms.condition() < 1e2;
            let (at, stop, size) = solve(&system, &wrong.home());
            if rigid && left > 1e-4 {
                prop_assert!(stop != Stop::Solved, "assembled with {left} left over");
                // the closest approach is where the linear theory says it is
                prop_assert!((size - left).abs() < 0.3 * left, "{size} {left}");
                **refusals.borrow_mut() += 1;
            } else if rigid
                && system.rows() == system.unknowns().len()
                && freedoms.condition() < 30.0
            {
                // as many equations as unknowns: the wrong dimension only moves the solution
                prop_assert_eq!(stop, Stop::Solved);
                let away = apart(&mechanism, &at, &mechanism.home());
                prop_assert!(away < 0.5, "{}", away);
            }
            Ok(())
        })
        .unwrap();
    assert!(refused > 80, "{refused} of 400 refused");
}

/// A mechanism with nothing but a platform, so that only the held coordinates make rows.
fn lone_platform() -> Mechanism {
    let text = r#"Mechanism(version: 1, name: "lone", convention: Modified,
        chains: { "post": Chain(base: [Tx(0.7)]) },
        platforms: { "top": Platform(frames: { "A": [Tx(1.3)] }) },
        closures: { "rod": Distance("post", "top.A", 2) })"#;
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

#[test]
fn rows_of_held_coordinates_are_differentiated_rightly() {
    let mechanism = lone_platform();
    let dimensions = mechanism.dimensions();
    let duals = dimensions.map(Dual::constant);
    let values = prop::array::uniform6(-3.0..3.0f64);
    runner(300)
        .run(&(six(), six(), values), |(actual, wanted, values)| {
            let wanted: Rotation<f64> = pose(wanted).rotation;
            let mut coordinates: Vec<(PoseCoordinate, f64)> =
                PoseCoordinate::ALL.into_iter().zip(values).collect();
            let mut at = mechanism.home();
            at.platforms[0] = PlatformPose::from_pose(&pose(actual));
            // half a turn away an angle's gap jumps from π to −π
            for (coordinate, value) in &mut coordinates {
                let gap = coordinate.of(&at.platforms[0].pose()) - *value;
                if coordinate.is_angle()
                    && (gap / PI).rem_euclid(2.0) > 0.98
                    && (gap / PI).rem_euclid(2.0) < 1.02
                {
                    *value += 0.5;
                }
            }
            let held = Held {
                joints: vec![],
                platforms: vec![HeldPlatform::Partly(HeldParts {
                    reference: None,
                    coordinates: coordinates.clone(),
                    orientation: Some(wanted),
                    spins: vec![],
                })],
            };
            let system = System::new(dimensions, &held);
            let rows = system.rows();
            prop_assert_eq!(rows, 1 + 6 + 3);
            let mut work = system.work();
            system.linearise(&at, &mut work);
            let jacobian = system.dense_jacobian(&work);
            let residual = system.residual_of(&work).to_vec();
            // each angle's gap is its difference, modulo a turn
            for (row, (coordinate, value)) in (1..).zip(&coordinates) {
                let scale = match coordinate.is_angle() {
                    true => 1.0,
                    false => mechanism.characteristic_length(),
                };
                let gap = (coordinate.of(&at.platforms[0].pose()) - value) / scale;
                let off = residual[row] - gap;
                let turns = if coordinate.is_angle() {
                    (off / (2.0 * PI)).round()
                } else {
                    0.0
                };
                prop_assert!(
                    (off - 2.0 * PI * turns).abs() < 1e-12,
                    "{coordinate:?}: {off}"
                );
            }
            let held = Held {
                joints: vec![],
                platforms: vec![HeldPlatform::Partly(HeldParts {
                    reference: None,
                    coordinates: (coordinates.into_iter())
                        .map(|(c, value)| (c, Dual::constant(value)))
                        .collect(),
                    orientation: Some(Rotation(wanted.0.map(|v| Vector3(v.0.map(Dual::constant))))),
                    spins: vec![],
                })],
            };
            let over_duals = System::new(&duals, &held);
            for k in 0..6 {
                let mut step = vec![Dual::constant(0.0); 6];
                step[k].slope = 1.0;
                let moving = over_duals.displaced(&at.map(Dual::constant), &step);
                let mut dual_work = over_duals.work();
                over_duals.residual(&moving, &mut dual_work);
                let shifted = |h: f64| {
                    let mut step = [0.0; 6];
                    step[k] = h;
                    let mut work = system.work();
                    system.residual(&system.displaced(&at, &step), &mut work);
                    system.residual_of(&work).to_vec()
                };
                const H: f64 = 1e-6;
                let (plus, minus) = (shifted(H), shifted(-H));
                for row in 0..rows {
                    let entry = jacobian[k * rows + row];
                    let dual = over_duals.residual_of(&dual_work)[row].slope;
                    let difference = (plus[row] - minus[row]) / (2.0 * H);
                    let size = 1.0 + entry.abs() + residual[row].abs();
                    prop_assert!(
                        (entry - dual).abs() <= 1e-11 * size * size,
                        "row {row}: {entry} {dual}"
                    );
                    prop_assert!(
                        (entry - difference).abs() <= 1e-6 * size * size,
                        "row {row}: {entry} {difference}"
                    );
                }
            }
            Ok(())
        })
        .unwrap();
}

#[test]
fn quaternions_and_roll_pitch_yaw_give_the_same_rotation_back() {
    runner(500)
        .run(&six(), |values| {
            let rotation = pose(values).rotation;
            let by_quaternion = Quaternion::from_rotation(&rotation).rotation();
            let by_angles = RollPitchYaw::from_rotation(&rotation).rotation();
            for other in [by_quaternion, by_angles] {
                for (a, b) in (rotation.rows().iter().flatten()).zip(other.rows().iter().flatten())
                {
                    prop_assert!((a - b).abs() < 1e-14);
                }
            }
            Ok(())
        })
        .unwrap();
}
