//! Joints of chains in gimbal lock: freedoms do not depend on the configuration that is looked at.

use linkwork::analysis::mobility::{MobilityReport, MobilitySettings, mobility};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::{Mobility, Question};

/// A body on three legs. Each has a ball at the foot, written as three rows, a knee, and two hinges
/// at the hip; it is rigid with the body. The balls of the first `locked` legs stand in gimbal lock:
/// their first and third axes are one line.
///
/// Grübler: 6 (1 + 3·5 + 1 − 1 − 18) + 18 = 6, those of the body.
fn walker(locked: usize) -> Mechanism {
    let [mut joints, mut chains, mut frames, mut closures] = [const { String::new() }; 4];
    for leg in 0..3 {
        let middle = if leg < locked { 0.0 } else { 25.0 };
        let home = [20.0 + 7.0 * leg as f64, middle, -35.0, 50.0, 15.0, -40.0];
        let foot = format!(r#"Rz("{} deg"), Tx(0.8)"#, 120 * leg);
        let mut rows = String::new();
        let mut stiff = foot.clone();
        for (k, (angle, (alpha, a))) in home.into_iter().zip(LEG).enumerate() {
            let role = if k < 3 { "Passive" } else { "Actuated" };
            joints += &format!(r#""q{leg}{k}": {role}(home: "{angle} deg"), "#);
            rows += &format!(r#"(alpha: "{alpha} deg", a: {a}, theta: "q{leg}{k}"), "#);
            stiff += &format!(r#", Rx("{alpha} deg"), Tx({a}), Rz("{angle} deg")"#);
        }
        chains += &format!(r#""leg{leg}": Chain(base: [{foot}], rows: [{rows}]), "#);
        frames += &format!(r#""hip{leg}": [{stiff}], "#);
        closures += &format!(r#""hip{leg}": Rigid("leg{leg}", "body.hip{leg}"), "#);
    }
    read(&joints, &chains, &frames, &closures)
}

/// α and a of each row of a leg.
const LEG: [(f64, f64); 6] = [
    (0.0, 0.0),
    (90.0, 0.0),
    (-90.0, 0.0),
    (60.0, 0.0),
    (0.0, 0.5),
    (90.0, 0.4),
];

fn read(joints: &String, chains: &String, frames: &String, closures: &String) -> Mechanism {
    let text = format!(
        r#"Mechanism(
            version: 1,
            name: "walker",
            convention: Modified,
            joints: {{ {joints} }},
            chains: {{ {chains} }},
            platforms: {{ "body": Platform(home: [], frames: {{ {frames} }}) }},
            closures: {{ {closures} }},
        )"#
    );
    let description = Description::read(&text).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn report(mechanism: &Mechanism, seed: u64) -> MobilityReport {
    let settings = MobilitySettings {
        seed,
        ..MobilitySettings::default()
    };
    let question = Question::new(mechanism).free("actuated").unwrap();
    let report = mobility(&question, &settings, &Watch::none());
    report.closed().expect("closes at home")
}

#[test]
fn legs_in_gimbal_lock_take_no_freedom_away() {
    for locked in 0..=3 {
        let mechanism = walker(locked);
        for seed in 1..4 {
            let report = report(&mechanism, seed);
            let found = (
                report.mobility,
                report.infinitesimal,
                report.idle_freedoms.len(),
            );
            assert_eq!(found, (6, 6, 0), "{locked} locked, seed {seed}");
            // the pose is special, and is said to be
            let names = (0..locked).flat_map(|leg| [format!("q{leg}0"), format!("q{leg}2")]);
            assert_eq!(report.gimbal_locked_joints, names.collect::<Vec<_>>());
            assert_eq!(report.gimbal_locked, locked);
            assert!(report.elsewhere.is_empty());
        }
        let count = Mobility::near(&mechanism, &mechanism.home()).expect("closes");
        assert_eq!((count.count(), count.idle()), (6, 0), "{locked} locked");
    }
}

#[test]
fn a_leg_that_always_spins_stays_idle() {
    // the leg ends in a ball and its last hinge is on the line through both balls; the first ball is
    // in gimbal lock at home, the spin is not lost there and nothing else is gained
    for middle in [0.0, 30.0] {
        let joints = format!(
            r#""a": Passive(home: "20 deg"), "b": Passive(home: "{middle} deg"),
            "c": Passive(home: "10 deg"), "l": Actuated(home: 1),"#
        );
        let rows = r#"(theta: "a"), (alpha: "90 deg", theta: "b"),
            (alpha: "-90 deg", theta: "c"), (d: "l")"#;
        let stiff =
            format!(r#"Rz("20 deg"), Rx("90 deg"), Rz("{middle} deg"), Rx("-90 deg"), Tz(1)"#);
        let mechanism = read(
            &joints,
            &format!(r#""leg": Chain(rows: [{rows}]),"#),
            &format!(r#""hip": [{stiff}],"#),
            &r#""hip": Spherical("leg", "body.hip"),"#.to_owned(),
        );
        // 4 joints and 6 of the body less 3 equations; the spin c is one of these
        let report = report(&mechanism, 1);
        assert_eq!(
            (report.mobility, report.idle_freedoms.len()),
            (6, 1),
            "{middle}°"
        );
        assert_eq!(report.gimbal_locked, usize::from(middle == 0.0));
    }
}
