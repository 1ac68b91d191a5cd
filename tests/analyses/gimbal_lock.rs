//! Joints of chains in gimbal lock: freedoms do not depend on the configuration that is looked at.

use linkwork::analysis::convert::{ConvertSettings, convert, possible_cuts};
use linkwork::analysis::mobility::{Character, MobilityReport, MobilitySettings, mobility};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;
use linkwork::system::{Question, RegularFreedoms};

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
    let description = Description::read(&text(joints, chains, frames, closures)).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn text(joints: &String, chains: &String, frames: &String, closures: &String) -> String {
    format!(
        r#"Mechanism(
            version: 1,
            name: "walker",
            convention: Modified,
            joints: {{ {joints} }},
            chains: {{ {chains} }},
            platforms: {{ {} }},
            closures: {{ {closures} }},
        )"#,
        match frames.is_empty() {
            true => String::new(),
            false => format!(r#""body": Platform(home: [], frames: {{ {frames} }})"#),
        }
    )
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
        let count = RegularFreedoms::near(&mechanism, &mechanism.home()).expect("closes");
        assert_eq!((count.count(), count.idle()), (6, 0), "{locked} locked");
    }
}

/// A body on six legs, freed of its actuators. Foot: a ball written as three rows, turned so that it is in gimbal lock at
/// home where `locked` says so; knee, with a cylinder between pins on shank and thigh; universal joint at the hip, with a
/// cylinder between balls on body and thigh.
///
/// Grübler: 1 + 6·6 bodies; a leg takes 3 (foot) + 5 (knee) + 4 (hip) + 5·3 (pins and slide) + 3·2 + 5 (balls and slide) =
/// 38; planar loops of the knees give 3 back: 6·37 − 6·38 + 6·3 = 12. Six of these are spins of the cylinders between
/// balls; the other six are those of the body, for each leg as a chain from foot to hip has six of its own.
fn robot(locked: impl Fn(usize) -> bool) -> String {
    let [mut joints, mut chains, mut frames, mut closures] = [const { String::new() }; 4];
    // in the plane of a leg: from a ball on the body to one on the thigh
    let [x, y, z]: [f64; 3] = [0.55, -0.1, 0.65];
    let length = (x * x + y * y + z * z).sqrt();
    let (turn, rise) = (y.atan2(x), z.atan2(x.hypot(y)));
    for i in 0..6 {
        let (leg, turned) = (60 * i + 15, if locked(i) { 90 } else { 0 });
        joints += &format!(
            r#""u{i}": Passive(home: 0), "v{i}": Passive(home: "{turned} deg"), "w{i}": Passive(home: 0),
            "knee{i}": Passive(home: "-90 deg"), "x{i}": Passive(home: 0), "y{i}": Passive(home: 0),
            "z{i}": Passive(home: 0), "lift{i}": Actuated(home: {length}),
            "pin{i}": Passive(home: "atan2(0.65, 0.4)"), "bend{i}": Actuated(home: "hypot(0.65, 0.4)"),"#
        );
        let ball = |[u, v, w]: [&str; 3]| {
            format!(
                r#"(theta: "{u}{i}"), (alpha: "90 deg", theta: "{v}{i} + 90 deg"), (alpha: "90 deg", theta: "{w}{i}")"#
            )
        };
        chains += &format!(
            r#""leg{i}": Chain(
                base: [Rz("{leg} deg"), Tx(1.3), Ry("{turned} deg")],
                rows: [{}, (alpha: "90 deg", a: 1.1, theta: "knee{i}")],
                tip: [Tx(0.8)],
            ),
            "bend{i}": Chain(
                on: "leg{i}.3",
                base: [Tx(0.5), Rx("90 deg")],
                rows: [(theta: "pin{i}"), (alpha: "90 deg", d: "bend{i}")],
                tip: [Rx("-90 deg")],
            ),
            "eye{i}": Chain(on: "leg{i}.4", base: [T(0.4, 0.05, 0)]),
            "lift{i}": Chain(on: "body.ball{i}", rows: [{}, (d: "lift{i}")]),
            "ball{i}": Chain(on: "leg{i}.4", base: [T(0.3, -0.05, 0)]),"#,
            ball(["u", "v", "w"]),
            ball(["x", "y", "z"]),
        );
        frames += &format!(
            r#""hip{i}": [Rz("{leg} deg"), T(0.5, 0, 1.1)],
            "ball{i}": [Rz("{leg} deg"), T(0.45, 0.1, 0.4), Rz({turn}), Ry({})],"#,
            -rise
        );
        closures += &format!(
            r#""hip{i}": Universal("leg{i}", "body.hip{i}"), "eye{i}": Revolute("bend{i}", "eye{i}"),
            "ball{i}": Spherical("lift{i}", "ball{i}"),"#
        );
    }
    text(&joints, &chains, &frames, &closures)
}

fn freed(description: &Description, seed: u64) -> MobilityReport {
    let mechanism = Mechanism::new(description).unwrap_or_else(|problems| panic!("{problems:?}"));
    report(&mechanism, seed)
}

#[test]
fn a_robot_on_six_legs_has_six_freedoms_for_every_seed_and_cut_and_in_gimbal_lock() {
    let counts = |report: &MobilityReport| {
        let freedoms = (report.mobility, report.idle_freedoms.len());
        (freedoms, report.character)
    };
    let expected = ((6, 6), Character::Regular);
    let description = Description::read(&robot(|_| false)).unwrap();
    for seed in 1..4 {
        let report = freed(&description, seed);
        assert_eq!(counts(&report), expected, "seed {seed}");
        assert_eq!((report.rank, report.kutzbach), (54, -6));
        assert_eq!(report.gimbal_locked, 0);
    }
    let mechanism = Mechanism::new(&description).unwrap();
    let cuts = possible_cuts(&mechanism, &description);
    for joint in ["knee1", "pin2", "bend3", "lift4"] {
        assert!(cuts.iter().any(|cut| cut == joint), "{cuts:?}");
        let settings = ConvertSettings {
            cut: Some(joint.into()),
            ..ConvertSettings::default()
        };
        let cut = convert(&mechanism, &description, &settings).unwrap();
        assert_eq!(counts(&freed(&cut.description, 1)), expected, "{joint}");
    }
    // the same pose with other angles of one foot, then of all, in which the equations lose rank
    for (locked, rank) in [(1, 54), (6, 51)] {
        let description = Description::read(&robot(|leg| leg < locked)).unwrap();
        for seed in 1..4 {
            let report = freed(&description, seed);
            assert_eq!(counts(&report), expected, "{locked} locked, seed {seed}");
            assert_eq!((report.rank, report.gimbal_locked), (rank, locked));
            let names = (0..locked).flat_map(|leg| [format!("u{leg}"), format!("w{leg}")]);
            assert_eq!(report.gimbal_locked_joints, names.collect::<Vec<_>>());
            let answer = report.document().answer;
            let beside = match rank {
                54 => "The mechanism has 6 freedoms.",
                _ => "The mechanism has 6 freedoms, counted beside this configuration.",
            };
            assert_eq!(answer, beside);
        }
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

/// A planar four-bar whose pin between coupler and rocker is a ball: three rows whose first axis lies along the coupler's normal
/// in the plane, so that they are in gimbal lock where coupler and rocker are at right angles as at home. `turned` is where the
/// second axis stands about the line of the others, which moves no body.
fn four_bar_with_a_ball(turned: f64, crank: bool) -> Mechanism {
    let (name, base, row) = match crank {
        true => (
            r#""crank": Actuated(home: "90 deg"),"#,
            "",
            r#"(theta: "crank"),"#,
        ),
        false => ("", r#"base: [Rz("90 deg")],"#, ""),
    };
    let joints = format!(
        r#"{name} "coupler": Passive(home: "-90 deg"), "u": Passive(home: {turned}), "v": Passive(home: 0),
        "w": Passive(home: {}), "rocker": Passive(home: "90 deg"),"#,
        -turned
    );
    let chains = format!(
        r#""left": Chain({base} rows: [{row} (a: 1, theta: "coupler"), (alpha: "90 deg", a: 1.3, theta: "u"),
            (alpha: "90 deg", theta: "v"), (alpha: "-90 deg", theta: "w")], tip: [Rx("-90 deg")]),
        "right": Chain(base: [Tx(1.3)], rows: [(theta: "rocker")], tip: [Tx(1), Rz("-90 deg")]),"#
    );
    let closures = r#""C": Rigid("left", "right"),"#.to_owned();
    let frames = String::new();
    read(&joints, &chains, &frames, &closures)
}

/// The bodies of a four-bar have one freedom, whatever angles their ball has; without the crank it is a structure.
#[test]
fn a_ball_in_gimbal_lock_holds_no_body() {
    for turned in [0.0, 0.3, 1.2, 1.5, -2.0] {
        let mechanism = four_bar_with_a_ball(turned, true);
        for seed in 1..4 {
            let report = report(&mechanism, seed);
            let found = (
                report.mobility,
                report.idle_freedoms.len(),
                report.gimbal_locked,
            );
            assert_eq!(found, (1, 0, 1), "z2 at {turned}, seed {seed}");
            assert_eq!(report.moving_joints, ["crank", "coupler", "v", "rocker"]);
            assert_eq!(report.gimbal_locked_joints, ["u", "w"]);
            assert!(report.counted_beside && report.elsewhere.is_empty());
        }
        let count = RegularFreedoms::near(&mechanism, &mechanism.home()).expect("closes");
        assert_eq!((count.count(), count.idle()), (1, 0), "z2 at {turned}");
        let fixed = report(&four_bar_with_a_ball(turned, false), 1);
        assert_eq!((fixed.mobility, fixed.counted_beside), (0, false));
    }
}
