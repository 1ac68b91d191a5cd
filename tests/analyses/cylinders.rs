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

/// Boom, stick and bucket of an excavator, the tip of the bucket mapped. The bucket is moved by a
/// cylinder; boom and stick are driven themselves, or by cylinders too.
fn excavator(by_cylinders: bool, limits: &str) -> Mechanism {
    let (joints, chains, closures) = match by_cylinders {
        true => (
            format!(
                r#""boom": Passive(home: "30 deg"), "stick": Passive(home: "-80 deg"),
                "cb": Actuated(home: 2.7{limits}), "pb": Passive(home: "50 deg"),
                "cs": Actuated(home: 2.8{limits}), "ps": Passive(home: "-5 deg"),"#
            ),
            r#""boomcylinder": Chain(
                base: [T(0.6, -0.5, 0)],
                rows: [(theta: "pb - 90 deg"), (alpha: "-90 deg", d: "cb")],
                tip: [Rx("90 deg")],
            ),
            "stickcylinder": Chain(
                on: "arm.1",
                base: [T(3, 1, 0)],
                rows: [(theta: "ps - 90 deg"), (alpha: "-90 deg", d: "cs")],
                tip: [Rx("90 deg")],
            ),
            "boompin": Chain(on: "arm.1", base: [T(2.6, 0.6, 0)]),
            "stickpin": Chain(on: "arm.2", base: [T(-0.75, 0.25, 0)]),"#,
            r#""boomrod": Revolute("boomcylinder", "boompin"),
            "stickrod": Revolute("stickcylinder", "stickpin"),"#,
        ),
        false => (
            r#""boom": Actuated(home: "30 deg"), "stick": Actuated(home: "-80 deg"),"#.to_owned(),
            "",
            "",
        ),
    };
    let text = format!(
        r#"Mechanism(
            version: 1,
            name: "excavator",
            convention: Modified,
            joints: {{
                {joints}
                "bucket": Passive(home: "-40 deg"),
                "ck": Actuated(home: 2.2{limits}), "pk": Passive(home: 0),
            }},
            chains: {{
                "arm": Chain(
                    rows: [(theta: "boom"), (a: 5.7, theta: "stick"), (a: 2.9, theta: "bucket")],
                    tip: [Tx(1.5)],
                ),
                {chains}
                "bucketcylinder": Chain(
                    on: "arm.2",
                    base: [T(0.6, 0.5, 0)],
                    rows: [(theta: "pk - 90 deg"), (alpha: "-90 deg", d: "ck")],
                    tip: [Rx("90 deg")],
                ),
                "bucketpin": Chain(on: "arm.3", base: [T(-0.2, 0.4, 0)]),
            }},
            platforms: {{ "tip": Platform(home: [T(7, -1, 0)]) }},
            closures: {{
                "point": Rigid("arm", "tip"),
                {closures}
                "bucketrod": Revolute("bucketcylinder", "bucketpin"),
            }},
        )"#
    );
    let description = Description::read(&text).unwrap();
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

const CYLINDER: f64 = 2.0;

/// The tip's nodes that boom and stick reach for each of the two angles that the cylinder leaves to
/// the bucket: stick and bucket are one link then, and reach a ring with the boom.
fn in_rings(nodes: usize) -> Vec<usize> {
    // the pin on the bucket, on a circle about its hinge and on one about the cylinder's other end
    let (near, far) = (0.2f64.hypot(0.4), 2.3f64.hypot(0.5));
    let between = (near * near + far * far - CYLINDER * CYLINDER) / (2.0 * near * far);
    let (to_end, of_pin) = (0.5f64.atan2(-2.3), 0.4f64.atan2(-0.2));
    let at = |from: f64, to: f64, i: usize| from + (to - from) * i as f64 / (nodes - 1) as f64;
    let counts = [1.0, -1.0].map(|side| {
        let bucket = to_end + side * between.acos() - of_pin;
        let link = (2.9 + 1.5 * bucket.cos()).hypot(1.5 * bucket.sin());
        let reach = (5.7 - link).abs()..=5.7 + link;
        let all =
            (0..nodes * nodes).map(|k| at(-2.0, 11.0, k % nodes).hypot(at(-9.0, 9.0, k / nodes)));
        all.filter(|r| reach.contains(r)).count()
    });
    counts.to_vec()
}

fn dug(mechanism: &Mechanism, nodes: usize, boundaries: bool) -> WorkspaceReport {
    let settings = WorkspaceSettings {
        nodes: vec![nodes; 2],
        boundaries,
        ..WorkspaceSettings::default()
    };
    let question = Question::new(mechanism.clone())
        .input("tip.x", -2.0, 11.0)
        .input("tip.y", -9.0, 9.0)
        .hold("ck", CYLINDER);
    question.workspace(&settings, &Watch::none()).unwrap()
}

/// How many modes have how many nodes.
fn sizes(report: &WorkspaceReport) -> Vec<usize> {
    assert!(report.modes.iter().all(|mode| mode.repeated == 0));
    let mut sizes: Vec<usize> = report.modes.iter().map(|mode| mode.nodes).collect();
    sizes.sort_unstable();
    sizes
}

#[test]
fn an_excavator_driven_by_cylinders_has_the_modes_of_one_with_driven_joints() {
    let pushed = ", limits: (0.1, 10)";
    for nodes in [9, 16] {
        let rings = in_rings(nodes);
        // two bends of the arm for each angle of the bucket
        let mut expected: Vec<usize> = rings.iter().flat_map(|n| [*n; 2]).collect();
        expected.sort_unstable();
        assert_ne!(rings[0], rings[1]);
        let driven = dug(&excavator(false, pushed), nodes, false);
        let cylinders = dug(&excavator(true, pushed), nodes, false);
        assert_eq!(sizes(&driven), expected);
        assert_eq!(sizes(&cylinders), expected);
        // cylinders of any sign: two of them tell four modes where there was one
        let mut all: Vec<usize> = expected.iter().flat_map(|n| [*n; 4]).collect();
        all.sort_unstable();
        assert_eq!(sizes(&dug(&excavator(true, ""), nodes, false)), all);
    }
}

#[test]
fn each_boundary_curve_is_followed_once() {
    let report = dug(&excavator(true, ", limits: (0.1, 10)"), 16, true);
    assert!(report.curves.len() > 5);
    let apart = |a: &[f64], b: &[f64]| -> f64 {
        // whole turns left out; lengths differ by less than one
        let parts = a.iter().zip(b).map(|(x, y)| 2.0 * (0.5 * (x - y)).sin());
        parts.map(|part| part * part).sum::<f64>().sqrt()
    };
    // curves cross, and come near one another there, but not all along
    for (i, one) in report.curves.iter().enumerate() {
        let along: Vec<&Vec<f64>> = (one.joints.iter())
            .step_by(one.joints.len() / 5 + 1)
            .collect();
        for other in report.curves[..i].iter().filter(|c| c.kind == one.kind) {
            let off = along.iter().map(|at| {
                let nearest = other.joints.iter().map(|there| apart(at, there));
                nearest.fold(f64::INFINITY, f64::min)
            });
            assert!(off.fold(0.0, f64::max) > 0.1, "{i}");
        }
    }
    // folds end the modes of both rings at the bounds that the rings have
    assert!(report.curves.iter().any(|curve| curve.ends_reach));
}
