//! Inverse dynamics, reactions and friction against published mechanisms computed by two routes each, and invariants.

use std::f64::consts::TAU;

use linkwork::analysis::statics::StaticsReport;
use linkwork::analysis::sweep::{Law, MotionReport, Pace, SweepSettings};
use linkwork::ask::Question;
use linkwork::description::{Description, ProblemKind};
use linkwork::mechanism::{Configuration, Mechanism, PoseCoordinate};
use linkwork::solve::Watch;
use linkwork::system::{self, Balance, Coordinate, Instant, Load, Motion};
use serde_json::Value;

fn data(name: &str) -> Value {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn numbers(of: &Value) -> Vec<f64> {
    let of = of.as_array().unwrap();
    of.iter().map(|x| x.as_f64().unwrap()).collect()
}

fn rows(of: &Value) -> Vec<Vec<f64>> {
    of.as_array().unwrap().iter().map(numbers).collect()
}

fn written(text: &str) -> Mechanism {
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

fn moved(question: &Question, steps: usize, pace: Pace) -> MotionReport {
    let settings = SweepSettings {
        steps,
        pace,
        ..SweepSettings::default()
    };
    let motions = question.motions(&settings, &Watch::none()).unwrap();
    let mut report = motions.report(usize::MAX, &mut |_, _| {}, &Watch::none());
    report.motions.remove(0)
}

/// The values of a column at the rows of steps.
fn column(motion: &MotionReport, name: &str) -> Vec<f64> {
    let place = motion.columns.iter().position(|of| of.name == name);
    let place = place.unwrap_or_else(|| panic!("no column {name}: {:?}", motion.columns));
    let steps = motion.values.iter().filter(|row| row[0].is_some());
    steps.map(|row| row[place].unwrap_or(f64::NAN)).collect()
}

fn near(found: f64, expected: f64, within: f64, what: &str) {
    let off = (found - expected).abs();
    assert!(off <= within, "{what}: {found} instead of {expected}");
}

/// The four-bar of the first case.
const FOUR_BAR: &str = r#"Mechanism(
    version: 1, name: "four-bar with masses", convention: Modified,
    parameters: { "g": 9.81, "m2": 2 },
    joints: {
        "theta1": Actuated(home: 1),
        "phi2": Passive(home: -0.6),
        "phi1": Passive(home: 1.6),
    },
    chains: {
        "left": Chain(
            rows: [(theta: "theta1", link: "crank"), (a: 0.1, theta: "phi2", link: "coupler")],
            tip: [Tx(0.3)],
        ),
        "right": Chain(base: [Tx(0.38)], rows: [(theta: "phi1", link: "rocker")], tip: [Tx(0.2)]),
    },
    closures: { "B": Revolute("left", "right") },
    gravity: (0, "-g", 0),
    masses: {
        "crank": (mass: "600 g", centre: ("30 mm*cos(30 deg)", "0.03*sin(30 deg)", 0), inertia: 0.0012),
        "coupler": (mass: "m2", centre: ("0.16*cos(15 deg)", "0.16*sin(15 deg)", 0), inertia: "0.018 kg*m^2"),
        "rocker": (mass: "1.5 kg", centre: (0.1, 0, 0), inertia: 0.009),
    },
)"#;

/// The columns of the tables of the first two cases.
const BEARINGS: &str = "force:theta1, reaction:theta1.Fx, reaction:theta1.Fy, reaction:phi2.Fx, reaction:phi2.Fy, \
    reaction:B.Fx, reaction:B.Fy, reaction:phi1.Fx, reaction:phi1.Fy, shaking.Fx, shaking.Fy";

#[test]
fn torque_and_bearing_forces_of_a_four_bar_at_constant_speed() {
    let known = data("loads_four_bar");
    let omega = known["inputs"]["omega"].as_f64().unwrap();
    let question = Question::new(written(FOUR_BAR))
        .input("theta1", 0.0, TAU)
        .report(BEARINGS.to_owned() + ", power, energy, energy:kinetic, velocity:phi1");
    // 24 and 480 steps: the second is read side by side
    for steps in [24, 480] {
        let pace = Pace {
            law: Law::Constant,
            duration: TAU / omega,
        };
        let motion = moved(&question, steps, pace);
        let names: Vec<&str> = BEARINGS.split(", ").collect();
        for (i, row) in rows(&known["answer"]["rows"]).iter().enumerate() {
            for (name, expected) in names.iter().zip(&row[1..]) {
                let found = column(&motion, name)[i * steps / 24];
                near(found, *expected, 1e-9 * 300.0, &format!("{name}, row {i}"));
            }
        }
        // what the motor gives goes into the energy
        let (power, energy) = (column(&motion, "power"), column(&motion, "energy"));
        let torque = column(&motion, "force:theta1");
        for i in 0..power.len() {
            near(power[i], omega * torque[i], 1e-9 * 300.0, "power");
        }
        if steps == 480 {
            // fourth-order differences of the energy
            let h = pace.duration / steps as f64;
            for i in 2..power.len() - 2 {
                let d = |k: usize| energy[i + k] - energy[i - k];
                let rate = (8.0 * d(1) - d(2)) / (12.0 * h);
                near(rate, power[i], 2e-6 * 300.0, "rate of energy");
            }
        }
    }
}

#[test]
fn a_law_that_starts_and_stops_needs_torque_for_its_accelerations() {
    // over a cycle that begins and ends at rest the work is zero: Simpson's rule is exact to h⁴
    let question = Question::new(written(FOUR_BAR))
        .input("theta1", 0.0, TAU)
        .report("power, energy");
    let pace = Pace {
        law: Law::Quintic,
        duration: 0.3,
    };
    let motion = moved(&question, 2000, pace);
    let power = column(&motion, "power");
    let h = pace.duration / 2000.0;
    let simpson = |i: usize| match i {
        0 | 2000 => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let work: f64 = (0..=2000).map(|i| simpson(i) * power[i] * h / 3.0).sum();
    let peak = power.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    near(work, 0.0, 1e-8 * peak * pace.duration, "work of a cycle");
    // half-way, where energy is largest, less work would not do
    let half: f64 = (0..=1000)
        .map(|i| if i == 1000 { 1.0 } else { simpson(i) } * power[i] * h / 3.0)
        .sum();
    let energy = column(&motion, "energy");
    near(
        half,
        energy[1000] - energy[0],
        1e-8 * peak,
        "work of half a cycle",
    );
}

/// Rates and forces where a mechanism is at a configuration: its held coordinates, their rates and accelerations.
fn driven(
    mechanism: &Mechanism,
    load: &Load,
    at: &Configuration<f64>,
    held: &[(Coordinate, f64, f64)],
) -> (Balance, Vec<Vec<f64>>) {
    let coordinates: Vec<Coordinate> = held.iter().map(|of| of.0).collect();
    let frames = Balance::<f64>::frames(mechanism, load, true);
    let mut motion: Motion = Motion::placing(mechanism, &coordinates, &frames, |held| held);
    let kinematics = motion.kinematics().clone();
    let mut balance = Balance::new(mechanism, load, &motion, &kinematics, true);
    motion.at(at);
    let responses = motion.responses();
    let column = |f: fn(&(Coordinate, f64, f64)) -> f64| held.iter().map(f).collect::<Vec<f64>>();
    motion.rates(&column(|of| of.1));
    motion.accelerations(&column(|of| of.2));
    let wanted: Vec<(&[f64], bool)> = responses.iter().map(|of| (&of[..], true)).collect();
    let instant = Instant {
        pace: [1.0, 0.0],
        time: 0.0,
        impending: None,
    };
    balance.at(&mut motion, at, &wanted, instant);
    let known = motion.known().map(<[f64]>::to_vec);
    (balance, known.into())
}

fn loads_of(mechanism: &Mechanism) -> Load {
    Load {
        own: mechanism.loads().clone().into(),
        ..Load::default()
    }
}

fn closed(question: &Question) -> Configuration<f64> {
    let closed = question.closed(&Watch::none()).unwrap();
    closed.closed().expect("closes").configuration
}

#[test]
fn a_force_and_a_torque_on_a_moving_four_bar() {
    // in inches, lbf, s and blobs, which any consistent units may stand for
    let known = &data("loads_four_bar")["textbook_instant"];
    let text = r#"Mechanism(
        version: 1, name: "textbook", convention: Modified,
        joints: { "a": Actuated(home: "60 deg"), "b": Passive(home: "-39 deg"), "c": Passive(home: "104 deg") },
        chains: {
            "left": Chain(rows: [(theta: "a", link: "crank"), (a: 5, theta: "b", link: "coupler")], tip: [Tx(15)]),
            "right": Chain(base: [Tx(19)], rows: [(theta: "c", link: "rocker")], tip: [Tx(10)]),
        },
        closures: { "B": Revolute("left", "right") },
        masses: {
            "crank": (mass: 0.004, centre: ("3*cos(30 deg)", "3*sin(30 deg)", 0), inertia: 0.05),
            "coupler": (mass: 0.02, centre: ("9*cos(45 deg)", "9*sin(45 deg)", 0), inertia: 0.1),
            "rocker": (mass: 0.015, centre: (5, 0, 0), inertia: 0.1),
        },
        loads: {
            "push": Force(
                at: "coupler+9*cos(45 deg)+3*cos(100 deg),9*sin(45 deg)+3*sin(100 deg)",
                force: ("80*cos(330 deg)", "80*sin(330 deg)", 0),
            ),
            "brake": Force(at: "rocker", moment: (0, 0, 120)),
        },
    )"#;
    let mechanism = written(text);
    let at = closed(&Question::new(mechanism.clone()));
    let crank = Coordinate::Joint(0);
    let (balance, _) = driven(
        &mechanism,
        &loads_of(&mechanism),
        &at,
        &[(crank, 25.0, -40.0)],
    );
    let answer = &known["answer"];
    let expected = answer["tau"].as_f64().unwrap();
    near(balance.forces[0], expected, 1e-9 * expected.abs(), "torque");
    let links = ["B", "O2", "A", "O4"];
    for (name, found) in links.into_iter().zip(&balance.reactions) {
        let expected = numbers(&answer[name]);
        for (force, expected) in found.force.0.iter().zip(&expected) {
            near(*force, *expected, 1e-9 * 240.0, name);
        }
    }
}

const ENGINE: &str = r#"Mechanism(
    version: 1, name: "engine", convention: Modified,
    joints: { "theta": Actuated(), "phi": Passive(home: 0.1), "s": Passive(home: 0.25) },
    chains: {
        "crank": Chain(rows: [(theta: "theta", link: "shaft"), (a: 0.05, theta: "phi", link: "rod")], tip: [Tx(0.2)]),
        "slider": Chain(base: [Ry("90 deg")], rows: [(d: "s", link: "piston")], tip: [Ry("-90 deg")]),
    },
    closures: { "pin": Revolute("crank", "slider") },
    masses: {
        "shaft": (mass: "1 kg", centre: (0.012, 0, 0), inertia: 0.0012),
        "rod": (mass: "0.8 kg", centre: (0.06, 0, 0), inertia: 0.0045),
        "slider": (mass: "0.6 kg"),
    },
)"#;

#[test]
fn an_engine_without_gas_shakes_its_frame() {
    let known = data("loads_engine");
    let omega = known["inputs"]["omega"].as_f64().unwrap();
    let columns = [
        "force:theta",
        "reaction:theta.Fx",
        "reaction:theta.Fy",
        "reaction:phi.Fx",
        "reaction:phi.Fy",
        "reaction:pin.Fx",
        "reaction:pin.Fy",
        "reaction:s.Fy",
        "shaking.Fx",
        "shaking.Fy",
    ];
    let question = Question::new(written(ENGINE))
        .input("theta", 0.0, TAU)
        .report(columns.join(","));
    let pace = Pace {
        law: Law::Constant,
        duration: TAU / omega,
    };
    let motion = moved(&question, 24, pace);
    for (i, row) in rows(&known["answer"]["rows"]).iter().enumerate() {
        let largest = row[1..].iter().fold(0.0f64, |most, x| most.max(x.abs()));
        for (name, expected) in columns.iter().zip(&row[1..]) {
            let found = column(&motion, name)[i];
            near(
                found,
                *expected,
                1e-9 * largest,
                &format!("{name}, row {i}"),
            );
        }
    }
}

/// A slider-crank without mass: its slide rubs, and a force opposes the motion of the slider or has a constant direction.
fn rubbing(pins: &str, force: &str) -> Mechanism {
    let text = r#"Mechanism(
        version: 1, name: "slider-crank", convention: Modified,
        joints: { "theta": Actuated(), "phi": Passive(home: 0.1), "s": Passive(home: 0.35) },
        chains: {
            "crank": Chain(rows: [(theta: "theta"), (a: 0.1, theta: "phi", link: "rod")], tip: [Tx(0.25)]),
            "slider": Chain(base: [Ry("90 deg")], rows: [(d: "s")], tip: [Ry("-90 deg")]),
        },
        closures: { "B": Revolute("crank", "slider") },
        loads: {
            "slide": Friction(joint: "s", coefficient: 0.15),
            "push": Force(joint: "s", force: "FORCE"),
            PINS
        },
    )"#;
    written(&text.replace("FORCE", force).replace("PINS", pins))
}

#[test]
fn friction_of_a_slide_and_of_pins_takes_its_part_of_the_torque() {
    let known = data("loads_friction");
    let answer = &known["answer"];
    // the crank drives, against a force that always opposes the slider
    let question = Question::new(rubbing("", "if(velocity:s > 0, -1000, 1000)"))
        .input("theta", TAU / 24.0, TAU / 24.0 * 11.0)
        .report("force:theta, reaction:s.Fy");
    // at the dead points, before the first row and after the last, the force has no direction
    let motion = moved(&question, 10, Pace::default());
    let known_rows = rows(&answer["crank_drives_rows"]["rows"]);
    for (i, row) in known_rows[1..12].iter().enumerate() {
        let [torque, wall] = ["force:theta", "reaction:s.Fy"].map(|of| column(&motion, of)[i]);
        near(torque, row[3], 1e-9 * row[3], "torque");
        near(wall, row[2], 1e-9 * row[2].abs(), "wall");
    }
    // the slider drives the crank, which a torque holds back
    let drives = |mechanism: Mechanism, theta: f64| {
        let question = Question::new(mechanism.clone()).hold("theta", theta);
        let at = closed(&question);
        let crank = Coordinate::Joint(0);
        let (balance, _) = driven(&mechanism, &loads_of(&mechanism), &at, &[(crank, 1.0, 0.0)]);
        -balance.forces[0]
    };
    for row in rows(&answer["slider_drives_rows"]["rows"]) {
        let found = drives(rubbing("", "-1000"), row[0]);
        near(found, row[3], 1e-9 * row[3], "torque delivered");
    }
    let pins = r#""A": Friction(joint: "phi", coefficient: 0.1, radius: 0.02),
        "pin": Friction(joint: "B", coefficient: 0.1, radius: "20 mm"),"#;
    // with the crank upright the rod stands still for an instant, and with it the pin of the slider
    let turning = rows(&answer["slider_drives_with_pins"]["rows"]);
    let turning = turning.into_iter();
    for row in turning {
        let found = drives(rubbing(pins, "-1000"), row[0]);
        near(found, row[1], 1e-9 * row[1], "torque delivered with pins");
    }
    // within the dead angle no torque is delivered, and just outside of it some is
    let dead = answer["slider_drives_with_pins"]["dead_angle_rad"]
        .as_f64()
        .unwrap();
    let [inside, outside] = [0.999, 1.001].map(|part| drives(rubbing(pins, "-1000"), part * dead));
    assert!(inside < 0.0 && outside > 0.0, "{inside} {outside}");
}

#[test]
fn where_friction_holds_the_load_no_force_is_needed() {
    let statics = |mechanism: Mechanism, theta: f64| -> StaticsReport {
        let question = Question::new(mechanism).hold("theta", theta);
        question.statics(&Watch::none()).unwrap().closed().unwrap()
    };
    // torque = 1000 N times arm, less in the one direction and more in the other
    let found = statics(rubbing("", "-1000"), 1.0);
    let rest = &found.rests[0];
    let [least, greatest] = [rest.least.unwrap(), rest.greatest.unwrap()];
    assert!(least < found.actuators[0].force && found.actuators[0].force < greatest);
    assert!(!rest.self_locking);
    // a wedge on a slope: tan 10° < 0.2 < tan 12°
    let slope = |angle: f64| {
        let text = r#"Mechanism(
            version: 1, name: "slope", convention: Modified,
            joints: { "s": Actuated() },
            chains: { "block": Chain(base: [Ry("90 deg"), Rx("ANGLE deg")], rows: [(d: "s")]) },
            gravity: (0, 0, 0), masses: { "block": (mass: 2) },
            loads: {
                "weight": Force(at: "block", force: ("-20*sin(ANGLE deg)", "-20*cos(ANGLE deg)", 0)),
                "rub": Friction(joint: "s", coefficient: 0.2),
            },
        )"#;
        statics_of(written(
            &text
                .replace("Rx(\"ANGLE deg\")", "Rx(0)")
                .replace("ANGLE", &angle.to_string()),
        ))
    };
    for (angle, locks) in [(10.0, true), (12.0, false)] {
        let found = slope(angle);
        let rest = &found.rests[0];
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        near(
            rest.least.unwrap(),
            20.0 * (sin - 0.2 * cos),
            1e-12,
            "least",
        );
        near(
            rest.greatest.unwrap(),
            20.0 * (sin + 0.2 * cos),
            1e-12,
            "greatest",
        );
        assert_eq!(rest.self_locking, locks, "{angle}");
    }
    // where tan φ exceeds 1/μ the slider jams: no torque moves it against its force
    let jams = |theta: f64| {
        let text = r#"Mechanism(
            version: 1, name: "jam", convention: Modified,
            joints: { "theta": Actuated(), "phi": Passive(home: 0.1), "s": Passive(home: 0.3) },
            chains: {
                "crank": Chain(rows: [(theta: "theta"), (a: 0.95, theta: "phi")], tip: [Tx(1)]),
                "slider": Chain(base: [Ry("90 deg")], rows: [(d: "s")], tip: [Ry("-90 deg")]),
            },
            closures: { "B": Revolute("crank", "slider") },
            loads: {
                "slide": Friction(joint: "s", coefficient: 0.5),
                "push": Force(joint: "s", force: -1000),
            },
        )"#;
        let mechanism = written(text);
        let question = Question::new(mechanism)
            .hold("theta", theta.to_radians())
            .guess("phi", -theta.to_radians() - 1.0);
        let found = question.statics(&Watch::none()).unwrap().closed().unwrap();
        // towards the load: a lower crank angle pushes the slider out, against its force
        found.rests[0].least.is_none()
    };
    let interval = numbers(
        &data("loads_friction")["answer"]["jamming"]["jam_interval_deg_r_over_l_0_95_mu_0_5"],
    );
    assert!(!jams(interval[0] - 0.01) && jams(interval[0] + 0.01));
    assert!(jams(interval[1] - 0.01) && !jams(interval[1] + 0.01));
}

fn statics_of(mechanism: Mechanism) -> StaticsReport {
    let answer = Question::new(mechanism).statics(&Watch::none()).unwrap();
    answer.closed().expect("closes")
}

/// The platform of the case as text: legs of two universal axes, a cylinder behind them and a piston on a slide.
fn stewart() -> Mechanism {
    let known = data("loads_stewart");
    let points = |of: &str| rows(&known["geometry"][of]);
    let (bases, tops) = (points("base_points"), points("platform_points"));
    let (mut joints, mut chains, mut frames, mut closures, mut masses) = Default::default();
    let put = |to: &mut String, text: String| to.push_str(&text);
    for (i, (a, b)) in bases.iter().zip(&tops).enumerate() {
        let k = i + 1;
        put(
            &mut joints,
            format!("\"u{k}\": Passive(), \"v{k}\": Passive(), \"l{k}\": Actuated(home: 1.3),"),
        );
        put(
            &mut chains,
            format!(
                "\"leg{k}\": Chain(base: [T({}, {}, {}), Ry(\"90 deg\")], rows: [(theta: \"u{k}\"), \
             (alpha: \"-90 deg\", theta: \"v{k} + 90 deg\", link: \"cylinder{k}\"), \
             (alpha: \"-90 deg\", d: \"l{k}\", link: \"piston{k}\")]),",
                a[0], a[1], a[2]
            ),
        );
        put(
            &mut frames,
            format!("\"B{k}\": [T({}, {}, {})],", b[0], b[1], b[2]),
        );
        put(
            &mut closures,
            format!("\"ball{k}\": Spherical(\"leg{k}\", \"top.B{k}\"),"),
        );
        // the leg is along −y of the cylinder's frame, and along z of the piston's
        put(
            &mut masses,
            format!(
                "\"cylinder{k}\": (mass: 0.1, centre: (0, 0.5, 0), inertia: (0.00625, 0, 0.00625, 0, 0, 0)),\
             \"piston{k}\": (mass: 0.1, centre: (0, 0, -0.5), inertia: (0.00625, 0.00625, 0, 0, 0, 0)),"
            ),
        );
    }
    let texts: [&String; 5] = [&joints, &chains, &frames, &closures, &masses];
    let [joints, chains, frames, closures, masses] = texts;
    written(&format!(
        "Mechanism(version: 1, name: \"platform\", convention: Modified, joints: {{ {joints} }}, chains: {{ {chains} }}, \
         platforms: {{ \"top\": Platform(home: [T(-1.5, 0, 1)], frames: {{ {frames} }}) }}, closures: {{ {closures} }}, \
         gravity: (0, 0, -9.81), \
         masses: {{ \"top\": (mass: 1.5, inertia: (0.08, 0.08, 0.08, 0, 0, 0)), {masses} }})"
    ))
}

#[test]
fn legs_of_a_platform_with_mass_of_their_own() {
    let mechanism = stewart();
    let load = loads_of(&mechanism);
    let omega = 3.0;
    for motion in data("loads_stewart")["answer"]["motions"]
        .as_array()
        .unwrap()
    {
        let turns = motion["motion"].as_str().unwrap().starts_with("rotation");
        for row in rows(&motion["rows"]) {
            let (sin, cos) = (omega * row[0]).sin_cos();
            let coordinates: &[PoseCoordinate] = match turns {
                true => &[PoseCoordinate::Yaw],
                false => &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z],
            };
            let size = if turns { 0.35 } else { 0.2 };
            let all = PoseCoordinate::ALL
                .into_iter()
                .zip([-1.5, 0.0, 1.0, 0.0, 0.0, 0.0]);
            let all: Vec<(PoseCoordinate, f64, f64, f64)> = all
                .map(|(c, home)| match coordinates.contains(&c) {
                    true => (
                        c,
                        home + size * sin,
                        size * omega * cos,
                        -size * omega * omega * sin,
                    ),
                    false => (c, home, 0.0, 0.0),
                })
                .collect();
            let mut question = Question::new(mechanism.clone()).free("actuated");
            for (c, value, ..) in &all {
                question = question.hold(format!("top.{}", c.word()), *value);
            }
            let at = closed(&question);
            // rates of the legs for those of the platform, then forces of the legs for their rates
            let platform: Vec<_> = all
                .iter()
                .map(|(c, _, rate, change)| (Coordinate::Pose(0, *c), *rate, *change))
                .collect();
            let (_, known) = driven(&mechanism, &load, &at, &platform);
            let scale = mechanism.characteristic_length();
            let legs: Vec<(Coordinate, f64, f64)> = (1..=6)
                .map(|k| {
                    let joint = mechanism.joint(&format!("l{k}")).unwrap();
                    near(at.joints[joint], row[6 + k], 1e-9, "length");
                    (
                        Coordinate::Joint(joint),
                        known[0][joint] * scale,
                        known[1][joint] * scale,
                    )
                })
                .collect();
            let (balance, _) = driven(&mechanism, &load, &at, &legs);
            for (k, force) in balance.forces.iter().enumerate() {
                near(
                    *force,
                    row[1 + k],
                    1e-8 * 15.0,
                    &format!("leg {k} at {}", row[0]),
                );
            }
        }
    }
}

#[test]
fn reactions_of_overconstrained_loops_are_marked_where_they_are_not_unique() {
    let known = data("loads_overconstrained");
    // a planar four-bar in space: only what acts across the plane is not unique
    let text = r#"Mechanism(
        version: 1, name: "planar", convention: Modified,
        joints: { "a": Actuated(home: "50 deg"), "b": Passive(home: -0.4), "c": Passive(home: 1.7) },
        chains: {
            "left": Chain(rows: [(theta: "a", link: "one"), (a: 0.1, theta: "b", link: "two")], tip: [Tx(0.3)]),
            "right": Chain(base: [Tx(0.38)], rows: [(theta: "c", link: "three")], tip: [Tx(0.2)]),
        },
        closures: { "d": Revolute("left", "right") },
        gravity: (0, -9.81, 0),
        masses: {
            "one": (mass: 0.6, centre: (0.05, 0, 0)), "two": (mass: 2, centre: (0.15, 0, 0)),
            "three": (mass: 1.5, centre: (0.1, 0, 0)),
        },
    )"#;
    let found = statics_of(written(text));
    let expected = &known["answer"]["planar"]["unique"];
    let value = |label: &str| {
        let all = expected.as_array().unwrap();
        all.iter().find(|of| of[0] == label).unwrap()[2].as_f64()
    };
    assert_eq!(found.self_stresses, 3);
    near(
        found.actuators[0].force,
        value("joint 0 drive").unwrap(),
        1e-9,
        "drive",
    );
    // the frames of the data have t1 = y and t2 = −x; joints 2 and 3 are the closure and the rocker's bearing
    for (joint, reaction, sign) in [
        (0, &found.joints[0], 1.0),
        (1, &found.joints[1], 1.0),
        (2, &found.closures[0], 1.0),
        (3, &found.joints[2], -1.0),
    ] {
        let [f1, f2] = ["F1", "F2"].map(|part| value(&format!("joint {joint} {part}")).unwrap());
        near(sign * reaction.force[1], f1, 1e-8, "F1");
        near(-sign * reaction.force[0], f2, 1e-8, "F2");
        assert_eq!(
            reaction.unique,
            [true, true, false, false, false, true],
            "joint {joint}"
        );
    }
    // Bennett's linkage: nothing but the drive is unique
    let numbers = &known["geometry"]["bennett"];
    let theta2 = numbers["theta2"].as_f64().unwrap();
    let text = r#"Mechanism(
        version: 1, name: "Bennett", convention: Standard,
        parameters: { "a": 1, "alpha": "60 deg", "beta": "40 deg", "b": "a*sin(beta)/sin(alpha)" },
        joints: {
            "t1": Actuated(home: "70 deg"), "t2": Passive(home: T2), "t3": Passive(home: "-70 deg"),
        },
        chains: {
            "loop": Chain(rows: [
                (theta: "t1", a: "a", alpha: "alpha", link: "one"),
                (theta: "t2", a: "b", alpha: "beta", link: "two"),
                (theta: "t3", a: "a", alpha: "alpha", link: "three"),
            ]),
            "ground4": Chain(rows: [], tip: [Rx("-beta"), Tx("-b")]),
        },
        closures: { "d": Revolute("loop", "ground4") },
        gravity: (0, 0, -9.81),
        masses: {
            "one": (mass: 1, centre: ("-a/2", 0, 0)), "two": (mass: 0.8, centre: ("-b/2", 0, 0)),
            "three": (mass: 1, centre: ("-a/2", 0, 0)),
        },
    )"#;
    let mut found = statics_of(written(&text.replace("T2", &theta2.to_string())));
    let expected = &known["answer"]["bennett"]["unique"];
    let drive = expected
        .as_array()
        .unwrap()
        .iter()
        .find(|of| of[0] == "joint 0 drive")
        .unwrap();
    assert_eq!(found.self_stresses, 3);
    assert!(found.actuators[0].unique);
    let force = found.actuators.remove(0).force;
    near(
        force,
        drive[2].as_f64().unwrap(),
        1e-8,
        "drive of Bennett's linkage",
    );
    assert!(
        found
            .joints
            .iter()
            .all(|joint| joint.unique[..3] == [false; 3])
    );
}

#[test]
fn springs_balance_a_lamp_at_every_angle() {
    // a zero-free-length spring from height h above the pivot to r along the arm balances m·g·l if k·h·r = m·g·l
    let text = r#"Mechanism(
        version: 1, name: "lamp", convention: Modified,
        parameters: { "h": "0.1 m", "r": "0.08 m", "l": "0.4 m", "m": "0.5 kg", "k": "m*9.81*l/(h*r)" },
        joints: { "a": Actuated(home: "20 deg") },
        chains: { "arm": Chain(base: [Rx("90 deg")], rows: [(theta: "a")]) },
        gravity: (0, 0, "-9.81 m/s^2"),
        masses: { "arm": (mass: "m", centre: ("l", 0, 0)) },
        loads: { "spring": Spring(between: ("ground+0,0,h", "arm+r,0,0"), stiffness: "k") },
    )"#;
    for angle in [-80.0, -10.0, 0.0, 35.0, 89.0f64] {
        let at = |text: &str| {
            let question = Question::new(written(text)).hold("a", angle.to_radians());
            let found = question.statics(&Watch::none()).unwrap().closed().unwrap();
            found.actuators[0].force
        };
        near(at(text), 0.0, 1e-12, "balanced");
        // a stiffer one lifts it
        let stiffer = at(&text.replace("h*r)", "h*r)*1.1"));
        near(
            stiffer,
            -0.1 * 0.5 * 9.81 * 0.4 * angle.to_radians().cos(),
            1e-12,
            "stiffer",
        );
    }
}

#[test]
fn ropes_pull_and_stops_push_and_tables_are_read_between_their_rows() {
    let text = r#"Mechanism(
        version: 1, name: "slide", convention: Modified,
        joints: { "x": Actuated(home: HOME) },
        chains: { "block": Chain(rows: [(d: "x")]) },
        loads: {
            "rope": Spring(joint: "x", stiffness: "2 N/mm", rest: 0.1, tension_only: true),
            "stop": Spring(joint: "x", stiffness: "3 N/mm", rest: "-10 cm", compression_only: true),
            "gas": Force(joint: "x", table: [(0, 0), (0.05, 10), (0.2, 40)], over: "x", force: "-1 N"),
        },
    )"#;
    for (home, force) in [
        (0.15, 30.0 + 100.0),
        (0.02, 4.0),
        (-0.12, -60.0),
        (0.3, 40.0 + 400.0),
    ] {
        let found = statics_of(written(&text.replace("HOME", &format!("{home}"))));
        near(found.actuators[0].force, force, 1e-9, &format!("at {home}"));
        assert_eq!(found.springs.len(), 3);
    }
    let without = Question::new(written(&text.replace("HOME", "0.15")))
        .without("springs")
        .without("gas");
    let found = without.statics(&Watch::none()).unwrap().closed().unwrap();
    assert_eq!((found.actuators[0].force, found.springs.len()), (0.0, 0));
}

#[test]
fn shapes_have_the_inertia_of_their_textbooks() {
    let inertia = |mass: &str| {
        let text = format!(
            "Mechanism(version: 1, name: \"body\", convention: Modified, joints: {{ \"a\": Actuated() }}, \
             chains: {{ \"c\": Chain(rows: [(theta: \"a\")]) }}, masses: {{ \"c\": {mass} }})"
        );
        let of = written(&text).loads().masses[0].clone();
        (of.mass, of.inertia)
    };
    let diagonal = |[x, y, z]: [f64; 3]| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let same = |(mass, found): (f64, [[f64; 3]; 3]), (kg, expected): (f64, [f64; 3])| {
        near(mass, kg, 1e-12 * kg, "mass");
        for (row, other) in found.iter().zip(diagonal(expected)) {
            row.iter()
                .zip(other)
                .for_each(|(a, b)| near(*a, b, 1e-14, "inertia"));
        }
    };
    same(inertia("(mass: 3, shape: Rod(2))"), (3.0, [0.0, 1.0, 1.0]));
    same(
        inertia("(shape: Box(0.3, 0.2, 0.1), density: \"1000 kg/m^3\")"),
        (6.0, [0.025, 0.05, 0.065]),
    );
    same(
        inertia("(mass: 12, shape: Plate(1, 2))"),
        (12.0, [4.0, 1.0, 5.0]),
    );
    same(
        inertia("(mass: 12, shape: Cylinder(1, 2))"),
        (12.0, [7.0, 7.0, 6.0]),
    );
    same(
        inertia("(mass: 5, shape: Sphere(0.5))"),
        (5.0, [0.5, 0.5, 0.5]),
    );
    same(
        inertia("(mass: 3, shape: Rod(2), turned: [Rz(\"90 deg\")])"),
        (3.0, [1.0, 0.0, 1.0]),
    );
    same(inertia("(mass: 1, inertia: 0.5)"), (1.0, [0.25, 0.25, 0.5]));
}

#[test]
fn wrong_masses_and_springs_are_refused_where_they_stand() {
    let refused = |from: &str, to: &str, marked: &str, title: &str| {
        let with_spring = FOUR_BAR.replace(
            "gravity:",
            r#"loads: { "s": Spring(between: ("crank", "ground+0.1"), stiffness: 10) }, gravity:"#,
        );
        assert!(with_spring.contains(from), "{from}");
        let text = with_spring.replacen(from, to, 1);
        let problems = Mechanism::problems(&text);
        let [problem] = &problems[..] else {
            panic!("{to}: {problems:?}")
        };
        assert_eq!(&text[problem.span.clone()], marked, "{to}");
        assert!(
            problem.kind.title().contains(title),
            "{}",
            problem.kind.title()
        );
        assert!(!matches!(problem.kind, ProblemKind::NotAffine));
    };
    refused(
        "mass: \"600 g\"",
        "mass: \"-600 g\"",
        "\"-600 g\"",
        "the mass is negative: -0.6",
    );
    refused(
        "mass: \"600 g\"",
        "mass: \"600 mm\"",
        "\"600 mm\"",
        "expected kg, found m",
    );
    refused(
        "mass: \"1.5 kg\", ",
        "",
        "(centre: (0.1, 0, 0), inertia: 0.009)",
        "the mass of `rocker` is not given",
    );
    refused(
        "inertia: 0.009",
        "inertia: (1, 1, 3, 0, 0, 0)",
        "1, 1, 3, 0, 0, 0",
        "exceeds the sum of the others",
    );
    refused(
        "inertia: 0.009",
        "inertia: (1, 1, 1, 2, 0, 0)",
        "1, 1, 1, 2, 0, 0",
        "or one is negative",
    );
    refused(
        "\"rocker\": (mass",
        "\"right.0\": (mass",
        "\"right.0\"",
        "is fixed to ground",
    );
    refused(
        "\"ground+0.1\"",
        "\"crank+0.1\"",
        "\"crank\", \"crank+0.1\"",
        "joins two points of the same body",
    );
    refused(
        "\"ground+0.1\"",
        "\"grond+0.1\"",
        "\"grond+0.1\"",
        "there is no frame `grond`",
    );
    refused(
        "stiffness: 10",
        "stiffness: -10",
        "-10",
        "the stiffness is negative",
    );
    refused(
        "stiffness: 10",
        "stiffness: \"10 N\"",
        "\"10 N\"",
        "expected N/m, found N",
    );
    refused(
        "stiffness: 10",
        "stiffness: \"10*theta1\"",
        "theta1",
        "changes while the mechanism moves",
    );
    refused(
        "between: (\"crank\", \"ground+0.1\")",
        "joint: \"theta9\"",
        "\"theta9\"",
        "there is no joint `theta9`",
    );
    refused(
        "gravity: (0, \"-g\", 0)",
        "gravity: (0, \"-g*q\", 0)",
        "q",
        "`q` is neither",
    );
    let force = r#"loads: { "s": Force(joint: "theta1", force: 3) }, gravity:"#;
    let problems = Mechanism::problems(&FOUR_BAR.replace("gravity:", force));
    let title = problems[0].kind.title();
    assert!(
        title.contains("needs `moment`, as its joint turns"),
        "{title}"
    );
}

#[test]
fn a_file_with_loads_is_written_as_it_was_read() {
    for text in [FOUR_BAR, ENGINE] {
        let read = Description::read(text).unwrap();
        let again = Description::read(&read.to_ron().unwrap()).unwrap();
        assert_eq!(read, again);
    }
}

#[test]
fn other_values_of_parameters_change_masses_too() {
    let mechanism = written(FOUR_BAR);
    let heavier = mechanism.with_values(&[(1, 4.0)]).unwrap();
    assert_eq!(heavier.loads().masses[1].mass, 4.0);
    assert_eq!(mechanism.loads().masses[1].mass, 2.0);
    let refused = mechanism.with_values(&[(1, -4.0)]).unwrap_err();
    assert!(refused.kind.title().contains("the mass is negative"));
    let _ = system::Question::new(&heavier);
}

#[test]
fn means_over_a_cycle_size_motor_and_flywheel() {
    // torque a + b·sin θ at a constant speed: mean a, mean square a² + b²/2, energy stored and given back 2·b
    let text = r#"Mechanism(
        version: 1, name: "shaft", convention: Modified,
        joints: { "theta": Actuated() },
        chains: { "shaft": Chain(rows: [(theta: "theta")]) },
        loads: { "machine": Force(joint: "theta", moment: "-(3 + 2*sin(theta)) * 1 N*m") },
    )"#;
    let question = Question::new(written(text))
        .input("theta", 0.0, TAU)
        .report("force:theta, power");
    let pace = Pace {
        law: Law::Constant,
        duration: TAU / 10.0,
    };
    let motion = moved(&question, 36, pace);
    let of = |name: &str| motion.extremes.iter().find(|of| of.name == name).unwrap();
    near(of("force:theta").mean.unwrap(), 3.0, 1e-9, "mean");
    near(
        of("force:theta").rms.unwrap(),
        11f64.sqrt(),
        1e-9,
        "root mean square",
    );
    assert_eq!(of("force:theta").fluctuation, None);
    near(of("power").mean.unwrap(), 30.0, 1e-8, "mean power");
    near(
        of("power").fluctuation.unwrap(),
        4.0,
        1e-8,
        "fluctuation of energy",
    );
}

/// Work of drives and loads is the change of energy at every row, and does not depend on the rows that are asked for.
#[test]
fn work_is_the_change_of_energy_on_every_row() {
    let shipped = |name: &str| {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/loads");
        let text = std::fs::read_to_string(folder.join(format!("{name}.ron"))).unwrap();
        Question::new(written(&text))
    };
    let cases = [
        ("engine", "theta", 0.0, 2.0 * TAU, Law::Constant),
        ("four_bar_flywheel", "theta1", 0.0, TAU, Law::Cycloidal),
        ("wishbone", "lower", -0.1, 0.2, Law::Quintic),
        ("toggle_press", "turn", -1.0, 1.0, Law::Constant),
        ("andrews_squeezer", "beta", 0.0, 6.0, Law::Cubic),
    ];
    for (name, input, from, to, law) in cases {
        let question = shipped(name)
            .input(input, from, to)
            .report("work:drives, energy, work:loads, energy/1 s - power");
        let pace = Pace { law, duration: 0.3 };
        let [few, many] = [6, 60].map(|steps| moved(&question, steps, pace));
        assert_eq!(few.extremes[0].unit.to_string(), "J");
        assert_eq!(few.extremes[3].unit.to_string(), "W");
        let [work, energy, loads] =
            ["work:drives", "energy", "work:loads"].map(|of| column(&many, of));
        let all = work.iter().chain(&energy).chain(&loads);
        let size = all.fold(0.0, |most: f64, x| most.max(x.abs()));
        assert_eq!([work[0], loads[0]], [0.0; 2]);
        assert!(work.iter().any(|x| x.abs() > 0.01 * size), "{name}");
        for (row, work) in work.iter().enumerate() {
            let change = energy[row] - energy[0] - loads[row];
            near(*work, change, 1e-10 * size, name);
        }
        for (row, of) in column(&few, "work:drives").iter().enumerate() {
            near(*of, work[10 * row], 1e-12 * size, name);
        }
    }
    // a spring that is stretched by 0.3 m stores ½·k·x², and its damper takes c·v·x
    let text = r#"Mechanism(
        version: 1, name: "slide", convention: Modified,
        joints: { "s": Actuated() },
        chains: { "slide": Chain(rows: [(d: "s")]) },
        loads: { "spring": Spring(joint: "s", stiffness: 200, damping: 5), "push": Force(joint: "s", force: 7) },
    )"#;
    let question = Question::new(written(text))
        .input("s", 0.0, 0.3)
        .report("work:spring, work:push, work, power:push * 1 s");
    let pace = Pace {
        law: Law::Constant,
        duration: 0.6,
    };
    let motion = moved(&question, 3, pace);
    let last = |name: &str| *column(&motion, name).last().unwrap();
    near(last("work:spring"), -9.0 - 0.75, 1e-12, "spring");
    near(last("work:push"), 2.1, 1e-12, "push");
    near(last("work"), 9.75 - 2.1, 1e-12, "drive");
    assert_eq!(motion.extremes[3].unit.to_string(), "J");
}

#[test]
fn tables_are_read_from_files_beside_the_mechanism() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slide.ron");
    let text = r#"Mechanism(
        version: 1, name: "slide", convention: Modified,
        joints: { "x": Actuated(home: "25 mm") },
        chains: { "block": Chain(rows: [(d: "x")]) },
        loads: { "gas": Force(joint: "x", table: "gas.csv", over: "x", force: "-0.001") },
    )"#;
    std::fs::write(&path, text).unwrap();
    let missing = linkwork::load(&path).unwrap_err().to_string();
    assert!(
        missing.contains("the table `gas.csv` cannot be read"),
        "{missing}"
    );
    let table = folder.path().join("gas.csv");
    std::fs::write(&table, "stroke (mm),pressure (bar)\n0,4\n50,2\n").unwrap();
    let found = statics_of(linkwork::load(&path).unwrap());
    near(found.actuators[0].force, 0.001 * 3e5, 1e-9, "gas force");
    std::fs::write(&table, "0,4,1\n50,2\n").unwrap();
    let wrong = linkwork::load(&path).unwrap_err().to_string();
    assert!(wrong.contains("line 1 has not two columns"), "{wrong}");
}

#[cfg(feature = "interchange")]
#[test]
fn masses_go_through_the_files_of_other_programs() {
    use linkwork::interchange::{
        ImportSettings, NotRead, import, tree_of, write_mjcf, write_sdf, write_urdf,
    };
    let mechanism = written(FOUR_BAR);
    let question = Question::new(mechanism.clone());
    let at = closed(&question);
    let torque = question.statics(&Watch::none()).unwrap().closed().unwrap();
    let torque = torque.actuators[0].force;
    let (tree, _) = tree_of(&mechanism, &at);
    let texts = [
        write_mjcf(&tree, &[]).0,
        write_sdf(&tree, &[]).0,
        write_urdf(&tree).0,
    ];
    for (i, text) in texts.iter().enumerate() {
        let none = |_: &str| Err(NotRead::Outside);
        let read = import("four_bar", text, &none, None, &ImportSettings::default()).unwrap();
        let again = Mechanism::new(&read.description).unwrap();
        let total: f64 = again.loads().masses.iter().map(|of| of.mass).sum();
        near(total, 4.1, 1e-9, "mass");
        // MJCF says where gravity points, and closes the loop
        if i == 0 {
            let found = statics_of(again);
            near(found.actuators[0].force.abs(), torque.abs(), 1e-8, "torque");
        }
    }
}
