//! Maps of arms whose joints are driven by cylinders, beside the same arms with driven joints.

use linkwork::analysis::workspace::{WorkspaceReport, WorkspaceSettings};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

/// Links of 1 m and 0.8 m, mapped by the end point. All pins are on the lines of the links, so that
/// the lengths of the cylinders are the same for both bends of the arm where the end point is on
/// the x axis.
fn arm(joints: &str, chains: &str, closures: &str) -> Mechanism {
    let text = format!(
        r#"Mechanism(
            version: 1,
            name: "arm of two links",
            convention: Modified,
            joints: {{ {joints} }},
            chains: {{
                "arm": Chain(rows: [(theta: "boom"), (a: 1, theta: "stick")], tip: [Tx(0.8)]),
                {chains}
            }},
            platforms: {{ "tip": Platform(home: [T(1.4, 0.2, 0)]) }},
            closures: {{ "point": Spherical("arm", "tip"), {closures} }},
        )"#
    );
    let description = Description::read(&text).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// Each joint moved by a cylinder from a pin of the link before it to a pin of the link after it.
fn by_cylinders(limits: &str, aside: f64) -> Mechanism {
    let chains = format!(
        r#"
        "boomcylinder": Chain(
            base: [T(-0.4, {aside}, 0)],
            rows: [(theta: "pb - 90 deg"), (alpha: "-90 deg", d: "cb")],
            tip: [Rx("90 deg")],
        ),
        "stickcylinder": Chain(
            on: "arm.1",
            base: [T(0.6, {aside}, 0)],
            rows: [(theta: "ps - 90 deg"), (alpha: "-90 deg", d: "cs")],
            tip: [Rx("90 deg")],
        ),
        "boompin": Chain(on: "arm.1", base: [Tx(0.5)], rows: []),
        "stickpin": Chain(on: "arm.2", base: [Tx(0.3)], rows: []),"#
    );
    let joints = format!(
        r#""boom": Passive(home: "40 deg"), "stick": Passive(home: "-70 deg"),
        "cb": Actuated(home: 0.8{limits}), "pb": Passive(home: "20 deg"),
        "cs": Actuated(home: 0.6{limits}), "ps": Passive(home: "-20 deg"),"#
    );
    let closures = r#"
        "boomrod": Revolute("boomcylinder", "boompin"),
        "stickrod": Revolute("stickcylinder", "stickpin"),"#;
    arm(&joints, &chains, closures)
}

const DRIVEN: &str = r#""boom": Actuated(home: "40 deg"), "stick": Actuated(home: "-70 deg"),"#;

fn map(mechanism: &Mechanism, nodes: usize, shift: f64) -> WorkspaceReport {
    let settings = WorkspaceSettings {
        nodes: vec![nodes; 2],
        boundaries: false,
        ..WorkspaceSettings::default()
    };
    let question = Question::new(mechanism.clone())
        .input("tip.x", -2.0, 2.0)
        .input("tip.y", -2.0 + shift, 2.0 + shift)
        .hold("tip.roll", 0.0)
        .hold("tip.pitch", 0.0)
        .hold("tip.yaw", 0.0);
    question.workspace(&settings, &Watch::none()).unwrap()
}

/// Nodes in the ring that the end point reaches.
fn in_ring(nodes: usize, shift: f64) -> usize {
    let at = |i: usize| -2.0 + 4.0 * i as f64 / (nodes - 1) as f64;
    let all = (0..nodes * nodes).map(|k| at(k % nodes).hypot(at(k / nodes) + shift));
    all.filter(|r| (0.2..=1.8).contains(r)).count()
}

/// Modes of as many nodes each as the ring has.
fn assert_modes(report: &WorkspaceReport, modes: usize, nodes: usize, shift: f64) {
    let counts: Vec<usize> = report.modes.iter().map(|mode| mode.nodes).collect();
    assert_eq!(counts, vec![in_ring(nodes, shift); modes]);
    assert!(report.modes.iter().all(|mode| mode.repeated == 0));
}

#[test]
fn an_arm_driven_by_cylinders_has_the_modes_of_the_arm_with_driven_joints() {
    // bent to the one or to the other side
    let driven = arm(DRIVEN, "", "");
    // nodes on the x axis, near it and on both sides of it
    for (nodes, shift) in [(15, 0.0), (15, 1e-4), (15, 0.03), (14, 0.0)] {
        assert_modes(&map(&driven, nodes, shift), 2, nodes, shift);
        for aside in [0.0, 0.02] {
            let limited = by_cylinders(", limits: (0.05, 3)", aside);
            assert_modes(&map(&limited, nodes, shift), 2, nodes, shift);
        }
        // without limits each cylinder may also point backwards, with a negative length
        let both_ways = by_cylinders("", 0.0);
        assert_modes(&map(&both_ways, nodes, shift), 8, nodes, shift);
    }
}

#[test]
fn a_dyad_folded_the_other_way_makes_no_other_mode() {
    // two links between the links of the arm, which nothing depends on
    let joints =
        format!(r#"{DRIVEN} "u": Passive(home: "60 deg"), "v": Passive(home: "-120 deg"),"#);
    let chains = r#"
        "dyad": Chain(
            on: "arm.1",
            base: [Tx(0.7)],
            rows: [(theta: "u"), (a: 0.4, theta: "v")],
            tip: [Tx(0.4)],
        ),
        "end": Chain(on: "arm.2", base: [Tx(0.2)], rows: []),"#;
    let mechanism = arm(&joints, chains, r#""pin": Revolute("dyad", "end"),"#);
    for (nodes, shift) in [(15, 0.0), (14, 0.0)] {
        assert_modes(&map(&mechanism, nodes, shift), 2, nodes, shift);
    }
}
