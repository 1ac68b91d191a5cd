//! Links that spin about their own lines: every command gives the answers of the same mechanism
//! without the spin, however the rod is written.

use std::f64::consts::TAU;

use linkwork::analysis::assemblies::{AssembliesReport, Fit, Wanted};
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::analysis::sweep::{Row, SweepEnd, SweepSettings};
use linkwork::analysis::workspace::WorkspaceSettings;
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;

const CRANK: f64 = 0.2;
const ROCKER: f64 = 0.5;
const AWAY: f64 = 0.6;
const ASIDE: f64 = 0.4;
const ROD: f64 = 0.8;

/// The R-S-S-R linkage of `mechanisms/rssr.ron` with another model of its rod: a distance, a platform
/// on two balls, a link of the crank's chain after a ball of three rows, the same cut in the middle
/// of the rod, where the spins of both halves are one or, about a swivel, two.
fn rssr(model: &str) -> Mechanism {
    read(&written(model))
}

fn read(text: &str) -> Mechanism {
    let description = Description::read(text).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn written(model: &str) -> String {
    let ball = |first: &str, [u, v, w]: [&str; 3]| {
        format!(
            r#"({first}theta: "{u}"), (alpha: "90 deg", theta: "{v} + 90 deg"),
               (alpha: "90 deg", theta: "{w}")"#
        )
    };
    let crank = r#"rows: [(theta: "theta")], tip: [Tx(0.2)]"#.to_owned();
    let rocker = r#"rows: [(theta: "psi")], tip: [Tx(0.5)]"#.to_owned();
    let after_crank = ball("a: 0.2, ", ["u", "v", "w"]);
    let after_rocker = ball("a: 0.5, ", ["x", "y", "z"]);
    let joints = r#""u": Passive(home: "-39 deg"), "v": Passive(home: "38 deg"), "w": Passive(home: "20 deg"),"#;
    let more = r#""x": Passive(home: "40 deg"), "y": Passive(home: "30 deg"), "z": Passive(home: "-50 deg"),"#;
    let (joints, crank, rocker, rest) = match model {
        "distance" => (
            String::new(),
            crank,
            rocker,
            r#"closures: { "rod": Distance("crank", "rocker", 0.8) },"#,
        ),
        "platform" => (
            String::new(),
            crank,
            rocker,
            r#"platforms: { "rod": Platform(
                home: [T(0.4, 0.3, 0.25), Rz("30 deg"), Ry("-40 deg")],
                frames: { "A": [Tx(-0.4)], "B": [Tx(0.4)] },
            ) },
            closures: { "A": Spherical("crank", "rod.A"), "B": Spherical("rod.B", "rocker") },"#,
        ),
        "chain" => (
            joints.to_owned(),
            format!(r#"rows: [(theta: "theta"), {after_crank}], tip: [Tz(0.8)]"#),
            rocker,
            r#"closures: { "B": Spherical("crank", "rocker") },"#,
        ),
        "halves" | "swivel" => (
            format!("{joints} {more}"),
            format!(r#"rows: [(theta: "theta"), {after_crank}], tip: [Tz(0.3)]"#),
            format!(r#"rows: [(theta: "psi"), {after_rocker}], tip: [Tz(0.5), Rx("180 deg")]"#),
            match model {
                "halves" => r#"closures: { "middle": Rigid("crank", "rocker") },"#,
                _ => r#"closures: { "middle": Revolute("crank", "rocker") },"#,
            },
        ),
        other => panic!("{other}"),
    };
    format!(
        r#"Mechanism(
            version: 1,
            name: "R-S-S-R, {model}",
            convention: Modified,
            joints: {{
                "theta": Actuated(home: "60 deg"), "psi": Passive(home: "80 deg"), {joints}
            }},
            chains: {{
                "crank": Chain({crank}),
                "rocker": Chain(base: [T(0.6, 0.4, 0), Rx("90 deg")], {rocker}),
            }},
            {rest}
        )"#
    )
}

const MODELS: [&str; 5] = ["distance", "platform", "chain", "halves", "swivel"];

/// ψ ≥ 0 for θ; the other assembly has −ψ. From |A − B|² = s² with A = (a cos θ, a sin θ, 0) and
/// B = (g + c cos ψ, h, c sin ψ).
fn psi(theta: f64) -> f64 {
    let (p, q) = (AWAY - CRANK * theta.cos(), ASIDE - CRANK * theta.sin());
    ((ROD * ROD - p * p - q * q - ROCKER * ROCKER) / (2.0 * p * ROCKER)).acos()
}

fn assemblies(mechanism: &Mechanism) -> AssembliesReport {
    let question = Question::new(mechanism.clone());
    question
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap()
}

fn of(names: &[(String, f64)], name: &str) -> f64 {
    names.iter().find(|(n, _)| n == name).unwrap().1
}

#[test]
fn one_freedom_is_counted_however_the_rod_is_written() {
    for (model, spins) in MODELS.into_iter().zip([1, 1, 1, 1, 2]) {
        let question = Question::new(rssr(model));
        let report = question.mobility(&Watch::none()).unwrap().closed().unwrap();
        assert_eq!((report.mobility, report.infinitesimal), (1, 1), "{model}");
        assert_eq!(report.idle_freedoms.len(), spins, "{model}");
    }
}

#[test]
fn a_finite_number_of_assemblies_stays_finite() {
    // a ball of three rows has two sets of angles for each of its orientations
    for (model, sets) in MODELS.into_iter().zip([1, 1, 2, 4, 4]) {
        let modes = 2 * sets;
        let report = assemblies(&rssr(model));
        assert_eq!(report.fit, Fit::Finite, "{model}");
        assert!(report.continua.is_empty(), "{model}");
        assert_eq!(report.real, modes, "{model}");
        let wanted = psi(60f64.to_radians());
        for assembly in &report.assemblies {
            let found = of(&assembly.joints.0, "psi");
            assert!((found.abs() - wanted).abs() < 1e-9, "{model}: {found}");
        }
        let above = report
            .assemblies
            .iter()
            .filter(|a| of(&a.joints.0, "psi") > 0.0);
        assert_eq!(2 * above.count(), modes, "{model}");
        let listed = match sets {
            1 => String::new(),
            sets => format!(
                " Each is listed with {sets} sets of joint angles, because a ball written as three rows has two for \
                 each of its orientations."
            ),
        };
        let answer = report.document().answer;
        assert_eq!(
            answer,
            format!("2 assemblies: 2 real of 2 complex.{listed}")
        );
        let psi = |mode: &usize| of(&report.assemblies[mode - 1].joints.0, "psi");
        for modes in &report.positions {
            assert_eq!(modes.len(), sets, "{model}");
            assert!(modes.iter().all(|mode| psi(mode) * psi(&modes[0]) > 0.0));
        }
    }
}

/// A row that has limits or turns with another one, or an inner link that carries something: two sets of angles are two
/// assemblies.
#[test]
fn hinges_that_are_no_ball_keep_their_assemblies() {
    let chain = written("chain");
    let limited = chain.replace(
        r#""v": Passive(home: "38 deg")"#,
        r#""v": Passive(home: "38 deg", limits: ("-179 deg", "179 deg"))"#,
    );
    let carries = chain
        .replace(
            r#""theta": Act"#,
            r#""slack": Passive(home: 0.5), "theta": Act"#,
        )
        .replace(
            r#"chains: {"#,
            r#"chains: { "beside": Chain(on: "crank.3", rows: [(a: 0.1, theta: "slack")]),"#,
        );
    let skew = chain.replace(r#"a: 0.2, theta: "u""#, r#"a: 0.2, theta: "u + w""#);
    for (what, text) in [
        ("limited", limited),
        ("carries", carries),
        ("coupled", skew),
    ] {
        assert_ne!(text, chain, "{what}");
        let question = Question::new(read(&text));
        let question = match what {
            "carries" => question.hold("slack", 0.5),
            _ => question,
        };
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        assert!(report.positions.is_empty(), "{what}");
        let answer = report.document().answer;
        assert_eq!(answer, "4 assemblies: 4 real of 4 complex.", "{what}");
    }
}

#[test]
fn a_motion_goes_through() {
    let (from, to) = (60f64.to_radians(), 420f64.to_radians());
    for model in MODELS {
        let mechanism = rssr(model);
        let question = Question::new(mechanism.clone()).input("theta", from, to);
        let settings = SweepSettings {
            steps: 24,
            ..SweepSettings::default()
        };
        let motions = question.motions(&settings, &Watch::none()).unwrap();
        let mut rows = Vec::new();
        let mut sink = |row: &Row| rows.push(row.configuration.joints[..2].to_vec());
        let report = motions.run(&motions.starts[0].1, &mut sink, &Watch::none());
        assert_eq!(report.ending, SweepEnd::Complete, "{model}");
        assert_eq!(rows.len(), 25);
        for row in rows {
            let wanted = psi(row[0]) * row[1].signum();
            assert!((row[1] - wanted).abs() < 1e-9, "{model} at {}", row[0]);
        }
    }
}

#[test]
fn circuits_are_those_without_the_spin() {
    // ψ over a turn of the crank, sampled
    let samples = (0..100_000).map(|k| psi(TAU * f64::from(k) / 1e5));
    let (low, high) = samples.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    for model in MODELS {
        let question = Question::new(rssr(model));
        let report = question.circuits(&Watch::none()).unwrap();
        assert_eq!(report.unusable, 0, "{model}");
        let mut sides = [0; 2];
        for circuit in &report.circuits {
            assert!(circuit.closed && circuit.whole, "{model}");
            assert_eq!(circuit.branches.len(), 1, "{model}");
            let psi = circuit.joints.iter().find(|j| j.name == "psi").unwrap();
            let (a, b) = match psi.low > 0.0 {
                true => (psi.low, psi.high),
                false => (-psi.high, -psi.low),
            };
            assert!((a - low).abs() < 1e-6 && (b - high).abs() < 1e-6, "{model}");
            sides[usize::from(psi.low > 0.0)] += 1;
        }
        assert!(sides[0] > 0 && sides[0] == sides[1], "{model}: {sides:?}");
    }
}

#[test]
fn singularities_on_the_way_are_those_without_the_spin() {
    let mut of_distance = Vec::new();
    for model in MODELS {
        let question = Question::new(rssr(model))
            .input("theta", 0.1, 6.2)
            .output("psi");
        let report = (question.along(&SingularitiesSettings::default(), &Watch::none())).unwrap();
        let met: Vec<f64> = report.crossings.iter().map(|c| c.moved[0]).collect();
        if model == "distance" {
            assert!(!met.is_empty());
            of_distance.clone_from(&met);
        }
        assert_eq!(met.len(), of_distance.len(), "{model}: {met:?}");
        for (a, b) in met.iter().zip(&of_distance) {
            assert!((a - b).abs() < 1e-7, "{model}: {met:?}");
        }
    }
}

#[test]
fn a_map_has_the_modes_without_the_spin() {
    for model in MODELS {
        let settings = WorkspaceSettings {
            nodes: vec![20],
            ..WorkspaceSettings::default()
        };
        let question = Question::new(rssr(model)).input("theta", 0.0, TAU);
        let report = question.workspace(&settings, &Watch::none()).unwrap();
        // sets of angles of a ball make no modes of their own
        assert_eq!(report.modes.len(), 2, "{model}");
        // the rod is no output, whose coordinates would part the modes
        assert_eq!(report.aspects.len(), 2, "{model}");
        assert!(
            report
                .modes
                .iter()
                .all(|mode| mode.nodes == 20 && mode.repeated == 0)
        );
    }
}

#[test]
fn a_rod_that_a_joint_stops_does_not_spin() {
    // the rod ends in a universal joint: no freedom is left over and nothing stands still for it
    let mechanism = {
        let description = Description::read(
            r#"Mechanism(
                version: 1,
                name: "R-S-U-R",
                convention: Modified,
                joints: {
                    "theta": Actuated(home: "60 deg"), "psi": Passive(home: "80 deg"),
                    "u": Passive(home: "-39 deg"), "v": Passive(home: "38 deg"),
                    "w": Passive(home: "20 deg"),
                },
                chains: {
                    "crank": Chain(
                        rows: [(theta: "theta"), (a: 0.2, theta: "u"),
                            (alpha: "90 deg", theta: "v + 90 deg"), (alpha: "90 deg", theta: "w")],
                        tip: [Tz(0.8), Rx("90 deg")],
                    ),
                    "rocker": Chain(
                        base: [T(0.6, 0.4, 0), Rx("90 deg")],
                        rows: [(theta: "psi")],
                        tip: [Tx(0.5)],
                    ),
                },
                closures: { "B": Universal("crank", "rocker") },
            )"#,
        );
        Mechanism::new(&description.unwrap()).unwrap()
    };
    let report = assemblies(&mechanism);
    assert_eq!(report.fit, Fit::Finite);
    assert!(
        report
            .variables
            .iter()
            .all(|joint| joint.held == (joint.name == "theta"))
    );
}

/// Two bodies that slide in one another on the line through their balls; with a universal joint for a ball nothing spins.
#[test]
fn a_cylinder_between_balls_spins_as_a_rod_does() {
    for (end, spins) in [
        ("Spherical(", 1),
        ("Universal(directions: ((0, 0, 1), (2, 1, 0)), ", 0),
    ] {
        let text = format!(
            r#"Axes(
                version: 1,
                name: "cylinder",
                joints: {{
                    "arm": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("ground", "arm")),
                    "low": Spherical(point: (1, 0, 0), between: ("ground", "tube")),
                    "lift": Prismatic(through: ((1, 0, 0), (0.5, 1, 0.3)), role: Actuated, between: ("tube", "rod")),
                    "high": {end}point: (0.5, 1, 0.3), between: ("rod", "arm")),
                }},
            )"#
        );
        let question = Question::new(read(&text));
        let report = question.mobility(&Watch::none()).unwrap().closed().unwrap();
        assert_eq!((report.mobility, report.infinitesimal), (1, 1), "{end}");
        assert_eq!(report.idle_freedoms.len(), spins, "{end}");
    }
}
