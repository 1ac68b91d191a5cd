//! Workspaces against closed forms: rings of arms and legs, lengths of legs, lines that meet.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;

use crate::linkwork;
use linkwork::analysis::workspace::{BoundaryKind, MapNode, WorkspaceReport, WorkspaceSettings};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::LocusEnd;
use nalgebra::Matrix3;

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    std::fs::read_to_string(path).unwrap()
}

fn written(text: &str, parameters: &[(&str, &str)]) -> Mechanism {
    let mut description = Description::read(text).unwrap();
    for (name, value) in parameters {
        description = description.with_parameter(name, value).unwrap();
    }
    Mechanism::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// With these coordinates mapped and these held.
fn asked(
    mechanism: &Mechanism,
    mapped: &[(&str, f64, f64)],
    held: &[(&str, f64)],
    settings: &WorkspaceSettings,
) -> WorkspaceReport {
    let question = Question::new(mechanism.clone());
    let question = (mapped.iter()).fold(question, |q, (name, from, to)| q.input(*name, *from, *to));
    let question = (held.iter()).fold(question, |q, (name, value)| q.hold(*name, *value));
    question.workspace(settings, &Watch::none()).unwrap()
}

/// The same where every edge of the grid is decided.
fn map_with(
    mechanism: &Mechanism,
    mapped: &[(&str, f64, f64)],
    held: &[(&str, f64)],
    settings: &WorkspaceSettings,
) -> WorkspaceReport {
    let report = asked(mechanism, mapped, held, settings);
    assert_eq!(report.unsure, 0, "{:?}", report.modes);
    report
}

fn map(
    mechanism: &Mechanism,
    mapped: &[(&str, f64, f64)],
    held: &[(&str, f64)],
    nodes: usize,
) -> WorkspaceReport {
    let settings = WorkspaceSettings {
        nodes: vec![nodes; mapped.len()],
        ..WorkspaceSettings::default()
    };
    map_with(mechanism, mapped, held, &settings)
}

/// Every node with its coordinates and the cells within limits.
fn nodes(report: &WorkspaceReport) -> Vec<(Vec<f64>, Vec<MapNode<'_>>)> {
    let mut of: BTreeMap<usize, Vec<MapNode>> = BTreeMap::new();
    for cell in report.cells.iter().filter(|cell| cell.aspect.is_some()) {
        of.entry(cell.node).or_default().push(cell);
    }
    (0..report.nodes)
        .map(|node| {
            let mut rest = node;
            let at = report.axes.iter().map(|axis| {
                let place = rest % axis.nodes;
                rest /= axis.nodes;
                axis.from + (axis.to - axis.from) * place as f64 / (axis.nodes - 1) as f64
            });
            (at.collect(), of.remove(&node).unwrap_or_default())
        })
        .collect()
}

/// Every node is reached in as many modes as a formula says; `None` where it is too near a boundary.
fn agrees(report: &WorkspaceReport, modes: impl Fn(&[f64]) -> Option<usize>) {
    let (mut inside, mut outside) = (0, 0);
    for (at, cells) in nodes(report) {
        let Some(expected) = modes(&at) else {
            continue;
        };
        assert_eq!(cells.len(), expected, "{at:?}");
        for cell in &cells {
            for (a, b) in cell.at.iter().zip(&at) {
                assert!((a - b).abs() < 1e-12);
            }
        }
        match expected {
            0 => outside += 1,
            _ => inside += 1,
        }
    }
    assert!(inside > 100 && outside > 100, "{inside} {outside}");
}

/// Whether a value is between two; `None` if it is at one of them.
fn between(x: f64, low: f64, high: f64) -> Option<bool> {
    let near = (x - low).abs() < 1e-9 || (x - high).abs() < 1e-9;
    (!near).then_some(low < x && x < high)
}

fn all(parts: impl IntoIterator<Item = Option<bool>>) -> Option<bool> {
    parts
        .into_iter()
        .try_fold(true, |all, part| Some(all && part?))
}

/// The points of boundary curves and those on edges of the grid, of one kind.
fn boundary<'r>(
    report: &'r WorkspaceReport,
    kind: impl Fn(&BoundaryKind) -> bool + Copy + 'r,
) -> Vec<([f64; 2], &'r Vec<f64>)> {
    let curves = report.curves.iter().filter(move |curve| kind(&curve.kind));
    let of_curves = curves.flat_map(|c| c.points.iter().copied().zip(&c.joints));
    let points = report.points.iter().filter(move |point| kind(&point.kind));
    let points = points.map(|p| ([p.at[0], p.at[1]], &p.joints));
    of_curves.chain(points).collect()
}

#[test]
fn a_two_link_arm_reaches_a_ring_in_two_modes() {
    let mechanism = written(&text("planar_2r"), &[]);
    let axes = [("hand.x", -1.95, 1.97), ("hand.y", -1.96, 1.93)];
    let report = map(&mechanism, &axes, &[], 35);
    // beyond 160° at the elbow the limit ends the ring before the links fold
    let inner = (1.0 + 0.64 + 1.6 * 160f64.to_radians().cos()).sqrt();
    let outer = 1.8;
    agrees(&report, |at| {
        Some(if between(at[0].hypot(at[1]), inner, outer)? {
            2
        } else {
            0
        })
    });
    assert_eq!(report.modes.len(), 2);
    assert_eq!(report.aspects.len(), 2);
    let area = PI * (outer * outer - inner * inner);
    for size in [
        report.reached_size,
        report.modes[0].size,
        report.aspects[1].size,
    ] {
        assert!((size / area - 1.0).abs() < 1e-2, "{size} {area}");
    }
    let stretched = boundary(&report, |kind| *kind == BoundaryKind::Inverse);
    let limits = boundary(&report, |kind| matches!(kind, BoundaryKind::Limit { .. }));
    assert!(stretched.len() > 100 && limits.len() > 20);
    for (at, _) in stretched {
        assert!((at[0].hypot(at[1]) - outer).abs() < 1e-9, "{at:?}");
    }
    for (at, joints) in limits {
        assert!((at[0].hypot(at[1]) - inner).abs() < 1e-9, "{at:?}");
        assert!((joints[1].abs() - 160f64.to_radians()).abs() < 1e-12);
    }
    // the Jacobian of x and y, by hand: it tells of the stretched arm
    let mut worst = 0.0f64;
    for cell in report.cells.iter().filter(|cell| cell.aspect.is_some()) {
        let (a, b) = (cell.joints[0], cell.joints[0] + cell.joints[1]);
        let second = [-0.8 * b.sin(), 0.8 * b.cos()];
        let first = [second[0] - a.sin(), second[1] + a.cos()];
        let dot = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (p, q, r) = (dot(first, first), dot(first, second), dot(second, second));
        let root = ((p - r).powi(2) + 4.0 * q * q).sqrt();
        let determinant = first[0] * second[1] - first[1] * second[0];
        let exact = 0.5 * (p + r + root) / determinant.abs();
        let told = cell.condition.unwrap();
        assert!((told / exact - 1.0).abs() < 1e-8, "{told} {exact}");
        worst = worst.max(told);
    }
    assert!(worst > 10.0, "{worst}");
    assert!(report.modes.iter().all(|mode| mode.repeated == 0));
}

#[test]
fn nothing_is_reached_where_the_arm_is_too_short() {
    let mechanism = written(&text("planar_2r"), &[]);
    let report = map(
        &mechanism,
        &[("hand.x", 1.3, 2.0), ("hand.y", 1.3, 2.0)],
        &[],
        15,
    );
    assert_eq!((report.reached, report.cells.len()), (0, 0));
    assert_eq!(report.reached_size, 0.0);
    assert!(report.modes.is_empty() && report.curves.is_empty());
}

#[test]
fn a_three_link_arm_with_its_orientation_held_reaches_the_ring_of_its_wrist() {
    let mechanism = written(&text("planar_3r"), &[]);
    let yaw = 0.4f64;
    let axes = [("tool.x", -2.2, 2.45), ("tool.y", -2.3, 2.25)];
    let report = map(&mechanism, &axes, &[("tool.yaw", yaw)], 40);
    let limit = 160f64.to_radians();
    agrees(&report, |at| {
        let (x, y) = (at[0] - 0.5 * yaw.cos(), at[1] - 0.5 * yaw.sin());
        let cos = (x * x + y * y - 1.64) / 1.6;
        if !(between(cos, -1.0, 1.0)?) {
            return Some(0);
        }
        let mut modes = 0;
        for elbow in [cos.acos(), -cos.acos()] {
            let first = y.atan2(x) - (0.8 * elbow.sin()).atan2(1.0 + 0.8 * elbow.cos());
            let wrist = yaw - first - elbow;
            let wrist = wrist - 2.0 * PI * (wrist / (2.0 * PI)).round();
            let inside = all([between(elbow, -limit, limit), between(wrist, -limit, limit)])?;
            modes += usize::from(inside);
        }
        Some(modes)
    });
}

fn five_bar(parameters: &[(&str, &str)]) -> Mechanism {
    written(&text("five_bar_hand"), parameters)
}

/// Twice the signed area of the triangle E1, P, E2: zero where the distal links of the 5-bar align.
fn alignment(at: [f64; 2], joints: &[f64], [g, r]: [f64; 2]) -> f64 {
    let e1 = [r * joints[0].cos(), r * joints[0].sin()];
    let e2 = [g + r * joints[1].cos(), r * joints[1].sin()];
    (e1[0] - at[0]) * (e2[1] - at[1]) - (e1[1] - at[1]) * (e2[0] - at[0])
}

#[test]
fn a_five_bar_reaches_the_overlap_of_two_rings_in_four_working_modes() {
    let mechanism = five_bar(&[]);
    let axes = [("hand.x", -0.63, 0.81), ("hand.y", -0.72, 0.74)];
    let report = map(&mechanism, &axes, &[], 28);
    agrees(&report, |at| {
        let rings = [0.0, 0.2].map(|x| between((at[0] - x).hypot(at[1]), 0.1, 0.7));
        Some(if all(rings)? { 4 } else { 0 })
    });
    assert_eq!(report.modes.len(), 4);
    // the lens of two circles less two discs that touch
    let (r, d) = (0.7f64, 0.2f64);
    let lens = 2.0 * r * r * (d / (2.0 * r)).acos() - 0.5 * d * (4.0 * r * r - d * d).sqrt();
    let area = lens - 2.0 * PI * 0.01;
    assert!(
        (report.reached_size / area - 1.0).abs() < 1e-2,
        "{}",
        report.reached_size
    );
    let ends = boundary(&report, |kind| *kind == BoundaryKind::Inverse);
    assert!(ends.len() > 200);
    for (at, _) in ends {
        let misses = [0.0, 0.2].map(|x| {
            let distance = (at[0] - x).hypot(at[1]);
            (distance - 0.7).abs().min((distance - 0.1).abs())
        });
        assert!(misses[0].min(misses[1]) < 1e-9, "{at:?}");
    }
    let aligned = boundary(&report, |kind| *kind == BoundaryKind::Direct);
    assert!(aligned.len() > 100);
    for (at, joints) in aligned {
        assert!(alignment(at, joints, [0.2, 0.3]).abs() < 1e-9, "{at:?}");
    }
    // in one working mode the sign of the determinant is that of the triangle, or the other
    let sizes: f64 = report.aspects.iter().map(|aspect| aspect.size).sum();
    let modes: f64 = report.modes.iter().map(|mode| mode.size).sum();
    assert!((sizes / modes - 1.0).abs() < 2e-2);
    for mode in 1..=4 {
        let cells = report.cells.iter().filter(|cell| cell.mode == mode);
        let signs = cells.map(|cell| {
            let triangle = alignment([cell.at[0], cell.at[1]], cell.joints, [0.2, 0.3]);
            (triangle > 0.0) == (cell.direct.unwrap() > 0.0)
        });
        let signs: Vec<bool> = signs.collect();
        assert!(signs.iter().all(|sign| *sign == signs[0]), "mode {mode}");
        let aspects = report.aspects.iter().filter(|aspect| aspect.mode == mode);
        let signs: Vec<i8> = aspects.map(|aspect| aspect.direct).collect();
        assert!(signs.contains(&1) && signs.contains(&-1), "mode {mode}");
    }
    // reflected about the line between the motors, working modes change places
    let mut sizes: Vec<f64> = report.modes.iter().map(|mode| mode.size).collect();
    sizes.sort_by(f64::total_cmp);
    assert!(sizes[3] - sizes[0] < 1e-9);
}

#[test]
fn within_one_aspect_of_a_five_bar_nothing_is_singular() {
    // where both elbows point outwards and the hand stays above the motors
    let mechanism = five_bar(&[]);
    let report = map(
        &mechanism,
        &[("hand.x", 0.0, 0.2), ("hand.y", 0.35, 0.6)],
        &[],
        15,
    );
    let outwards = |cell: &MapNode| cell.joints[2] < 0.0 && cell.joints[3] > 0.0;
    let cells: Vec<MapNode> = report.cells.iter().filter(outwards).collect();
    assert_eq!(cells.len(), 225);
    assert!(cells.iter().all(|cell| cell.aspect == cells[0].aspect));
    let mode = cells[0].mode;
    assert!(report.points.iter().all(|point| point.mode != mode));
}

#[test]
fn in_the_joint_space_of_a_five_bar_its_assemblies_meet_where_the_distal_links_stretch() {
    let mechanism = five_bar(&[("c", "0.25")]);
    let axes = [("theta1", -3.1, 3.15), ("theta2", -3.12, 3.1)];
    let report = map(&mechanism, &axes, &[], 32);
    let apart =
        |a: f64, b: f64| (0.2 + 0.3 * b.cos() - 0.3 * a.cos()).hypot(0.3 * b.sin() - 0.3 * a.sin());
    agrees(&report, |at| {
        Some(if between(apart(at[0], at[1]), 0.0, 0.5)? {
            2
        } else {
            0
        })
    });
    let stretched = boundary(&report, |kind| *kind == BoundaryKind::Direct);
    assert!(stretched.len() > 100);
    for (at, _) in stretched {
        assert!((apart(at[0], at[1]) - 0.5).abs() < 1e-9, "{at:?}");
    }
    assert_eq!(report.unit.to_string(), "rad²");
    // a leg that is stretched does not move the hand: type 1 inside
    let inverse = boundary(&report, |kind| *kind == BoundaryKind::Inverse);
    assert!(!inverse.is_empty());
    for (_, joints) in inverse {
        let folded = [joints[2], joints[3]].map(|psi| psi.sin().abs());
        assert!(folded[0].min(folded[1]) < 1e-9, "{joints:?}");
    }
}

/// The planar 3-RPR with limits of its legs.
fn three_rpr(low: f64, high: f64) -> Mechanism {
    let mut text = text("planar_3rpr");
    for home in ["14.98", "15.38", "12.0"] {
        let with = format!("home: {home}, limits: ({low:?}, {high:?}))");
        text = text.replace(&format!("home: {home})"), &with);
    }
    written(&text, &[])
}

#[test]
fn a_three_rpr_platform_reaches_where_the_rings_of_its_legs_overlap() {
    let (low, high) = (4.0, 18.5);
    let mechanism = three_rpr(low, high);
    let yaw = 0.9f64;
    let (b12, b23, b31) = (17.04f64, 16.54f64, 20.84f64);
    let b3x = (b12 * b12 + b31 * b31 - b23 * b23) / (2.0 * b12);
    let hinges = [
        [0.0, 0.0],
        [b12, 0.0],
        [b3x, (b31 * b31 - b3x * b3x).sqrt()],
    ];
    let bases = [[0.0, 0.0], [15.91, 0.0], [0.0, 10.0]];
    let turned =
        hinges.map(|[x, y]| [x * yaw.cos() - y * yaw.sin(), x * yaw.sin() + y * yaw.cos()]);
    let legs = |at: &[f64]| {
        [0, 1, 2].map(|i| {
            [
                at[0] + turned[i][0] - bases[i][0],
                at[1] + turned[i][1] - bases[i][1],
            ]
        })
    };
    let axes = [("platform.x", -19.3, 24.1), ("platform.y", -24.2, 18.9)];
    let report = map(&mechanism, &axes, &[("platform.yaw", yaw)], 32);
    agrees(&report, |at| {
        let rings = legs(at).map(|[x, y]| between(x.hypot(y), low, high));
        Some(usize::from(all(rings)?))
    });
    for (name, upper, limit) in [("rho1", true, high), ("rho2", false, low)] {
        let leg = usize::from(name == "rho2");
        let points = boundary(
            &report,
            |kind| matches!(kind, BoundaryKind::Limit { joint, upper: u } if joint == name && *u == upper),
        );
        for (at, _) in points {
            let [x, y] = legs(&at)[leg];
            assert!((x.hypot(y) - limit).abs() < 1e-9, "{name} {at:?}");
        }
    }
    assert!(
        report
            .points
            .iter()
            .any(|p| matches!(p.kind, BoundaryKind::Limit { .. }))
    );
    // three lines through one point, or parallel: a conic in the position
    let lines = |at: &[f64]| {
        let legs = legs(at);
        Matrix3::from_fn(|i, j| {
            let [x, y] = legs[i];
            let (arm, length) = (turned[i], x.hypot(y));
            [x, y, arm[0] * y - arm[1] * x][j] / length
        })
        .determinant()
    };
    let meeting = boundary(&report, |kind| *kind == BoundaryKind::Direct);
    assert!(meeting.len() > 20);
    for (at, _) in meeting {
        assert!(lines(&at).abs() < 1e-8, "{at:?} {}", lines(&at));
    }
    let mut same = Vec::new();
    for cell in report.cells.iter().filter(|cell| cell.aspect.is_some()) {
        same.push((lines(cell.at) > 0.0) == (cell.direct.unwrap() > 0.0));
    }
    assert!(same.iter().all(|s| *s == same[0]));
}

/// Leg lengths of the 3-RPS with b = 1, a = 1/2 at a height and two angles, for both yaws that its
/// hinges allow: each keeps its ball in the plane of its leg (Lee and Shah 1988).
fn three_rps(z: f64, roll: f64, pitch: f64) -> [[f64; 3]; 2] {
    let a = 0.5;
    let (sr, cr) = roll.sin_cos();
    let (sp, cp) = pitch.sin_cos();
    // columns of Ry(pitch) Rx(roll)
    let m = [[cp, 0.0, -sp], [sp * sr, cr, cp * sr]];
    let first = (m[1][0] - m[0][1]).atan2(m[0][0] + m[1][1]);
    [first, first + PI].map(|yaw| {
        let turn = |v: [f64; 3]| {
            let (s, c) = yaw.sin_cos();
            [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]]
        };
        let (n, s) = (turn(m[0]), turn(m[1]));
        let middle = [0.5 * a * (n[0] - s[1]), -a * n[1], z];
        [0.0, 120.0, 240.0].map(|angle: f64| {
            let (sin, cos) = angle.to_radians().sin_cos();
            let parts = [0, 1, 2].map(|k| {
                let ball = middle[k] + a * (cos * n[k] + sin * s[k]);
                ball - [cos, sin, 0.0][k]
            });
            parts.iter().map(|x| x * x).sum::<f64>().sqrt()
        })
    })
}

#[test]
fn a_section_of_the_three_rps_is_bounded_by_the_lengths_of_its_legs() {
    let mechanism = written(&text("three_rps"), &[]);
    let axes = [("top.roll", -1.22, 1.25), ("top.pitch", -1.24, 1.21)];
    let report = map(&mechanism, &axes, &[("top.z", 0.7)], 32);
    agrees(&report, |at| {
        let mut modes = 0;
        for legs in three_rps(0.7, at[0], at[1]) {
            modes += usize::from(all(legs.map(|l| between(l, 0.3, 1.2)))?);
        }
        Some(modes)
    });
    // what follows of the pose, as far as the hinges tell
    let names = report.following.iter().map(|of| of.name.as_str());
    assert_eq!(names.collect::<Vec<&str>>(), ["top.x", "top.y", "top.yaw"]);
    for cell in report.cells.iter() {
        let yaw = cell.following[2];
        let (sin, cos) = yaw.sin_cos();
        let ((sr, cr), (sp, cp)) = (cell.at[0].sin_cos(), cell.at[1].sin_cos());
        let n = [cos * cp, sin * cp];
        let sy = sin * sp * sr + cos * cr;
        let sx = cos * sp * sr - sin * cr;
        assert!((n[1] - sx).abs() < 1e-9, "{cell:?}");
        assert!((cell.following[0] - 0.25 * (n[0] - sy)).abs() < 1e-9);
        assert!((cell.following[1] + 0.5 * n[1]).abs() < 1e-9);
    }
    let mut met = 0;
    for (i, name) in ["l1", "l2", "l3"].into_iter().enumerate() {
        let points = boundary(
            &report,
            |kind| matches!(kind, BoundaryKind::Limit { joint, .. } if joint == name),
        );
        met += points.len();
        for (at, _) in points {
            let misses = three_rps(0.7, at[0], at[1])
                .map(|legs| (legs[i] - 0.3).abs().min((legs[i] - 1.2).abs()));
            assert!(misses[0].min(misses[1]) < 1e-9, "{name} {at:?}");
        }
    }
    assert!(met > 100);
}

#[test]
fn an_aspect_is_of_one_mode_where_only_a_finer_grid_joins_a_node_to_it() {
    let mechanism = written(&text("three_rps"), &[]);
    let axes = [("l1", 0.5, 1.0), ("l2", 0.5, 1.0)];
    let report = map(&mechanism, &axes, &[("l3", 0.75)], 30);
    let mut met = 0;
    for aspect in &report.aspects {
        let mode = &report.modes[aspect.mode - 1];
        assert!(aspect.nodes <= mode.within + mode.repeated, "{aspect:?}");
        for cell in report.cells.iter() {
            if cell.aspect == Some(aspect.aspect) {
                met += 1;
                assert_eq!(cell.mode, aspect.mode, "{cell:?}");
            }
        }
    }
    assert!(met > 4000);
}

#[test]
fn three_coordinates_are_mapped_in_slices() {
    let mechanism = written(&text("three_rps"), &[]);
    let axes = [
        ("top.roll", -0.62, 0.65),
        ("top.pitch", -0.64, 0.61),
        ("top.z", 0.2, 1.43),
    ];
    let report = map(&mechanism, &axes, &[], 12);
    agrees(&report, |at| {
        let mut modes = 0;
        for legs in three_rps(at[2], at[0], at[1]) {
            modes += usize::from(all(legs.map(|l| between(l, 0.3, 1.2)))?);
        }
        Some(modes)
    });
    assert_eq!(report.unit.to_string(), "rad²·m");
    assert!(report.curves.iter().all(|curve| curve.slice.is_some()));
    assert!(report.curves.iter().any(|curve| curve.points.len() > 2));
}

#[test]
fn one_coordinate_is_mapped_to_intervals() {
    // the rod l = 3 and the crank r = 1 reach a line beside the hinge of the crank, e = 0.5 away
    let mechanism = written(&text("slider_crank"), &[]);
    let settings = WorkspaceSettings {
        nodes: vec![90],
        ..WorkspaceSettings::default()
    };
    // the slide is driven in place of the crank
    let question = Question::new(mechanism)
        .free("actuated")
        .input("s", 1.5, 4.4);
    let report = question.workspace(&settings, &Watch::none()).unwrap();
    assert_eq!(
        (report.modes.len(), report.unit.to_string()),
        (2, "m".into())
    );
    let ends = [2.0f64, 4.0].map(|reach| (reach * reach - 0.25).sqrt());
    assert!(
        (report.reached_size - (ends[1] - ends[0])).abs() < 1e-9,
        "{}",
        report.reached_size
    );
    for point in &report.points {
        let misses = ends.map(|end| (point.at[0] - end).abs());
        assert!(misses[0].min(misses[1]) < 1e-9, "{point:?}");
    }
    assert_eq!(report.points.len(), 4);
}

#[test]
fn a_singularity_on_the_way_along_one_coordinate_does_not_end_a_mode() {
    // through the flat 3-RPS, and tilted legs at the same heights below and above
    let mechanism = written(&text("three_rps"), &[]);
    let held = [("top.roll", 10f64.to_radians()), ("top.pitch", 0.0)];
    let report = map(&mechanism, &[("top.z", -0.51, 1.0)], &held, 60);
    let direct = |kind: &BoundaryKind| *kind == BoundaryKind::Direct;
    let met: Vec<_> = report.points.iter().filter(|p| direct(&p.kind)).collect();
    assert!(met.len() >= 3);
    assert!(met.iter().all(|point| !point.ends_reach));
    assert!(met.iter().any(|point| point.at[0].abs() < 1e-9));
    assert_eq!(report.modes.len(), 1);
}

#[test]
fn nodes_reached_in_several_configurations_of_a_mode_are_counted_once() {
    let mechanism = written(&text("delta"), &[]);
    let axes = [("hand.x", -0.9, 0.9), ("hand.y", -0.9, 0.9)];
    let settings = WorkspaceSettings {
        nodes: vec![16; 2],
        boundaries: false,
        ..WorkspaceSettings::default()
    };
    let report = modes_of(&mechanism, axes, &[("hand.z", -1.0)], settings);
    assert!(report.modes.iter().any(|mode| mode.repeated > 0));
    for mode in &report.modes {
        assert!(mode.within <= mode.nodes, "{mode:?}");
    }
}

#[test]
fn where_two_legs_fold_at_once_modes_are_not_taken_for_one() {
    // at (0.1, 0) the inner circles of both rings touch; straight up through that point both elbows
    // would turn over together, smoothly
    let mechanism = five_bar(&[]);
    let axes = [("hand.x", -0.6, 0.8), ("hand.y", -0.7, 0.7)];
    for nodes in [[13, 12], [15, 14], [29, 20]] {
        let settings = WorkspaceSettings {
            nodes: nodes.to_vec(),
            boundaries: false,
            ..WorkspaceSettings::default()
        };
        let report = asked(&mechanism, &axes, &[], &settings);
        assert_eq!(report.modes.len(), 4, "{nodes:?}");
        assert!(
            report.modes.iter().all(|mode| mode.repeated == 0),
            "{nodes:?}"
        );
    }
}

/// A map of the ways a mechanism gets somewhere, without its boundaries.
fn modes_of(
    mechanism: &Mechanism,
    axes: [(&str, f64, f64); 2],
    held: &[(&str, f64)],
    settings: WorkspaceSettings,
) -> WorkspaceReport {
    asked(mechanism, &axes, held, &settings)
}

#[test]
fn a_leg_does_not_pass_through_length_zero_from_one_mode_to_another() {
    // grid lines run by the feet of the legs at a small part of a cell, where the leg turns round
    // within it: a step that is too long finds the leg of negative length instead
    let mechanism = written(&text("planar_3rpr"), &[]);
    let axes = [("platform.x", -20.0, 40.0), ("platform.y", -20.0, 40.0)];
    for nodes in [20, 50, 60, 61] {
        let settings = WorkspaceSettings {
            nodes: vec![nodes; 2],
            boundaries: false,
            ..WorkspaceSettings::default()
        };
        let yaw = 57f64.to_radians();
        let report = modes_of(&mechanism, axes, &[("platform.yaw", yaw)], settings);
        let mut signs: Vec<Vec<bool>> = Vec::new();
        for mode in 1..=report.modes.len() {
            let cells = report.cells.iter().filter(|cell| cell.mode == mode);
            let mut of = cells.map(|cell| [1, 3, 5].map(|rho| cell.joints[rho] > 0.0).to_vec());
            let first = of.next().unwrap();
            assert!(of.all(|other| other == first), "{nodes}: mode {mode}");
            signs.push(first);
        }
        signs.sort();
        signs.dedup();
        assert_eq!((signs.len(), report.modes.len()), (8, 8), "{nodes}");
        // the conic of singular poses parts each mode in two
        assert_eq!(report.aspects.len(), 16, "{nodes}");
    }
}

/// With legs of one length the platform of a 3-RPS is level, and the rates of its x and y lose two ranks at once: an
/// isolated point of each slice, where a motion of the platform may be any of a circle while nothing moves on.
#[test]
fn an_isolated_singularity_is_a_point_of_the_map_and_no_curve() {
    let mechanism = written(&text("three_rps"), &[]);
    let lengths = ["l1", "l2", "l3"].map(|leg| (leg, 0.5, 1.0));
    let report = asked(
        &mechanism,
        &lengths,
        &[],
        &WorkspaceSettings {
            nodes: vec![4; 3],
            ..WorkspaceSettings::default()
        },
    );
    let inverse = report
        .points
        .iter()
        .filter(|point| point.kind == BoundaryKind::Inverse);
    let level = inverse.filter(|point| point.at.iter().all(|l| (l - point.at[0]).abs() < 1e-6));
    assert!(level.count() > 0);
    let closed = report
        .curves
        .iter()
        .filter(|curve| curve.ends.contains(&LocusEnd::Closed));
    for curve in closed {
        let off = |joints: &Vec<f64>| {
            let pairs = joints.iter().zip(&curve.joints[0]);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let extent = curve.joints.iter().map(off).fold(0.0, f64::max);
        assert!(extent > 1e-3, "{:?} {extent}", curve.points[0]);
    }
}

#[test]
fn nodes_on_a_singularity_part_aspects_and_belong_to_none() {
    // flat on the ground the platform is singular whatever its legs
    let mechanism = written(&text("three_rps"), &[]);
    let axes = [("top.z", 0.0, 1.2), ("top.roll", -1.0, 1.0)];
    let report = map(&mechanism, &axes, &[("top.pitch", 0.0)], 24);
    let (flat, raised): (Vec<MapNode>, Vec<MapNode>) =
        report.cells.iter().partition(|cell| cell.at[0] == 0.0);
    assert_eq!(flat.len(), 24);
    for cell in flat {
        assert_eq!((cell.aspect, cell.direct), (None, Some(0.0)), "{cell:?}");
        assert_eq!(cell.condition, None);
    }
    assert!(raised.iter().any(|cell| cell.aspect.is_some()));
    for aspect in &report.aspects {
        assert!(aspect.nodes > 50, "{aspect:?}");
    }
    // the border there is one curve, as far as the legs reach
    let along = report.curves.iter().filter(|curve| {
        let points = &curve.points;
        curve.kind == BoundaryKind::Direct && points.iter().all(|point| point[0].abs() < 1e-9)
    });
    let along: Vec<_> = along.collect();
    assert_eq!(along.len(), 1);
    let rolls = along[0].points.iter().map(|point| point[1]);
    let (low, high) = rolls.fold((1.0f64, -1.0f64), |(a, b), x| (a.min(x), b.max(x)));
    assert!(low < -0.999 && high > 0.999, "{low} {high}");
}

#[test]
fn a_small_region_by_itself_is_found_by_the_few_starts_at_every_node() {
    // beside the lens of both outer circles the two inner ones leave a pocket of a few nodes
    let mechanism = five_bar(&[]);
    let axes = [("hand.x", -0.6, 0.8), ("hand.y", -0.1, 0.7)];
    let with = |probed: usize| {
        let settings = WorkspaceSettings {
            nodes: vec![60; 2],
            boundaries: false,
            probed,
            ..WorkspaceSettings::default()
        };
        modes_of(&mechanism, axes, &[], settings)
    };
    let report = with(10_000);
    agrees(&report, |at| {
        let rings = [0.0, 0.2].map(|x| between((at[0] - x).hypot(at[1]), 0.1, 0.7));
        Some(if all(rings)? { 4 } else { 0 })
    });
    assert!(with(0).reached < report.reached);
    assert_eq!(report.probed[0], report.nodes);
}

#[test]
fn threads_change_nothing() {
    let mechanism = five_bar(&[]);
    let axes = [("hand.x", -0.63, 0.81), ("hand.y", -0.72, 0.74)];
    let settings = WorkspaceSettings {
        nodes: vec![12; 2],
        searched: 9,
        ..WorkspaceSettings::default()
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let report = pool.unwrap();
        format!(
            "{:?}",
            report.install(|| map_with(&mechanism, &axes, &[], &settings))
        )
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn questions_without_a_meaning_are_refused_with_a_remedy() {
    let hand = "mechanisms/five_bar_hand.ron";
    let x = ["--map", "hand.x=0..0.2"];
    let cases: &[(&[&str], &str)] = &[
        (&[hand], "e.g. --map hand.x=-1..1 --map hand.y=-1..1"),
        (
            &[hand, "--map", "hand.x=0..0.2"],
            "--hold hand.y=home or --map hand.y=-1..1",
        ),
        (
            &[hand, "--map", "hand.x=0.2"],
            "write --map hand.x=FROM..TO",
        ),
        (
            &[hand, "--map", "hand.x=0.2..0.2"],
            "the range of `hand.x` is empty",
        ),
        (
            &[hand, "--map", "hand.x=0.3..0.2"],
            "the range of `hand.x` is empty",
        ),
        (&[hand, "--map", "hand.q=0..1"], "did you mean"),
        (
            &[
                "mechanisms/planar_2r.ron",
                "--map",
                "theta1=0..1e9rad",
                "--hold",
                "theta2=10deg",
            ],
            "wider than a full turn",
        ),
        (
            &[hand, x[0], x[1], "--hold", "hand.x=0"],
            "given a range and also held",
        ),
        (
            &[
                hand,
                x[0],
                x[1],
                "--map",
                "hand.y=0..1",
                "--map",
                "hand.yaw=0..1",
            ],
            "do not map hand.yaw",
        ),
        (
            &[hand, x[0], x[1], "--map", "hand.z=-1..1"],
            "do not map hand.z; map or hold theta1 instead",
        ),
        (
            &[hand, x[0], x[1], "--map", "hand.y=0..1", "--grid", "1"],
            "at least 2 nodes",
        ),
        (
            &[hand, x[0], x[1], "--map", "hand.y=0..1", "--grid", "2,3,4"],
            "one for each",
        ),
        (
            &[
                hand,
                x[0],
                x[1],
                "--map",
                "hand.y=0..1",
                "--grid",
                "1000000",
            ],
            "GB",
        ),
        (
            &[
                "mechanisms/four_bar.ron",
                "--map",
                "x=0..1",
                "--map",
                "y=0..1",
            ],
            "a point's `left+0.5,0.2.x`",
        ),
    ];
    for (arguments, expected) in cases {
        let (code, out, err) = linkwork(&[&["workspace"], *arguments].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    }
}

/// Texts of a picture of a map, the picture, and what is noted of it.
fn drawn(map: &[&str]) -> (Vec<String>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.svg");
    let svg = ["--svg", path.to_str().unwrap(), "--starts", "8"];
    let (code, _, err) = linkwork(&[&["workspace"], map, &svg].concat());
    assert_eq!(code, 0, "{err}");
    let svg = std::fs::read_to_string(path).unwrap();
    let texts = svg.split("<text").skip(1).map(|text| {
        let text = text.split_once('>').unwrap().1;
        text.split_once('<').unwrap().0.trim().to_owned()
    });
    (texts.collect(), svg, err)
}

#[test]
fn axes_of_a_picture_end_where_the_map_does_and_what_is_not_reached_is_left_open() {
    let map = ["mechanisms/five_bar_hand.ron", "--map", "hand.x=-0.6..0.8"];
    let map = [&map[..], &["--map", "hand.y=-0.1..0.7", "--grid", "15,9"]].concat();
    let (texts, svg, noted) = drawn(&map);
    assert!(!noted.contains("drawn"), "{noted}");
    // half a cell more at each end; the scale of colours is from 0 to 1 at most
    let numbers = texts
        .iter()
        .filter_map(|text| text.replace('−', "-").parse::<f64>().ok());
    let numbers: Vec<f64> = numbers.collect();
    assert!(
        numbers.len() > 20 && numbers.contains(&-0.6) && numbers.contains(&0.8),
        "{numbers:?}"
    );
    assert!(
        numbers.iter().all(|x| (-0.65..=1.0).contains(x)),
        "{numbers:?}"
    );
    // beside the sheet and 40 colours of the scale of each picture, one square for each node that is reached
    let pictures = texts.iter().filter(|text| text.contains(": mode ")).count();
    let json = [
        &["workspace"],
        &map[..],
        &["--starts", "8", "--format", "json"],
    ]
    .concat();
    let report: serde_json::Value = serde_json::from_str(&linkwork(&json).1).unwrap();
    let columns = report["columns"].as_array().unwrap();
    let aspect = columns.iter().position(|name| name == "aspect").unwrap();
    let cells = report["values"].as_array().unwrap().iter();
    let reached = cells.filter(|cell| !cell[aspect].is_null()).count();
    assert!(pictures > 0 && reached < (135 - 20) * pictures && !svg.contains("NaN"));
    assert_eq!(svg.matches("<rect").count(), 1 + 40 * pictures + reached);
}

#[test]
fn every_slice_of_a_map_is_drawn_with_one_scale_of_colours() {
    let map = [
        "mechanisms/three_rps.ron",
        "--map",
        "top.roll=-40deg..40deg",
        "--map",
        "top.pitch=-40deg..40deg",
        "--map",
        "top.z=0.4..0.7",
        "--grid",
        "6,6,7",
    ];
    let (texts, _, noted) = drawn(&map);
    assert!(!noted.contains("drawn"), "{noted}");
    let titles = texts.iter().filter(|text| text.contains(", top.z = "));
    let pictures = titles.clone().count();
    let modes = titles
        .clone()
        .filter(|text| text.ends_with("top.z = 0.4 m"))
        .count();
    assert_eq!(pictures, 7 * modes, "{texts:?}");
    let mut different: Vec<&String> = titles.collect();
    different.sort();
    different.dedup();
    assert_eq!(different.len(), pictures);
    // the same figures stand at each picture, at its axes and its scale
    let mut numbers: Vec<&String> = (texts.iter())
        .filter(|text| text.replace('−', "-").parse::<f64>().is_ok())
        .collect();
    numbers.sort();
    for same in numbers.chunk_by(|a, b| a == b) {
        assert_eq!(same.len() % pictures, 0, "{same:?} in {pictures} pictures");
    }
}

#[test]
fn slices_that_are_too_many_to_draw_are_noted_on_stderr_as_in_the_picture() {
    let map = [
        "mechanisms/three_rps.ron",
        "--map",
        "top.roll=-20deg..20deg",
    ];
    let map = [&map[..], &["--map", "top.pitch=-20deg..20deg"]].concat();
    let (texts, _, noted) =
        drawn(&[&map[..], &["--map", "top.z=0.5..0.6", "--grid", "2,2,121"]].concat());
    let pictures = texts
        .iter()
        .filter(|text| text.contains(", top.z = "))
        .count();
    assert!(pictures > 0 && pictures <= 120, "{pictures}");
    let note = noted
        .lines()
        .find(|line| line.contains("drawn"))
        .expect(&noted);
    let (said, file) = note
        .strip_prefix("note: ")
        .unwrap()
        .split_once(" in ")
        .unwrap();
    assert!(
        said.ends_with(" of 121 slices drawn") && file.ends_with("map.svg"),
        "{note}"
    );
    assert!(texts.iter().any(|text| text == said), "{said} {texts:?}");
}

#[test]
fn the_command_writes_whole_rows_of_numbers() {
    let map = [
        "workspace",
        "mechanisms/five_bar_hand.ron",
        "--map",
        "hand.x=-0.6..0.8",
    ];
    let map = [&map[..], &["--map", "hand.y=-0.7..0.7", "--grid", "13,12"]].concat();
    for more in [&["--format", "csv"][..], &["--format", "csv", "--boundary"]] {
        let (code, out, err) = linkwork(&[&map[..], more].concat());
        assert_eq!(code, 0, "{err}");
        let lines: Vec<Vec<&str>> = out.lines().map(|line| line.split(',').collect()).collect();
        assert!(lines.len() > 50 && out.ends_with('\n'));
        assert!(lines.iter().all(|line| line.len() == lines[0].len()));
        assert!(!out.contains("NaN") && !out.contains("inf"));
    }
    let (code, out, _) = linkwork(&[&map[..], &["--format", "json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(code, 0);
    assert_eq!(json["modes"].as_array().unwrap().len(), 4);
    let columns = json["columns"].as_array().unwrap().len();
    for row in json["values"].as_array().unwrap() {
        assert_eq!(row.as_array().unwrap().len(), columns);
    }
    let (code, _, _) = linkwork(&[
        "workspace",
        "mechanisms/planar_2r.ron",
        "--map",
        "hand.x=3..4",
        "--map",
        "hand.y=3..4",
        "--grid",
        "5",
    ]);
    assert_eq!(code, 1);
}

/// Interrupts a command once it has written its first bytes: its exit status, and what it wrote to stdout and stderr. It
/// must write more than a pipe holds, which waits to be read.
#[cfg(unix)]
fn interrupted(arguments: &[&str]) -> (Option<i32>, String, String) {
    use std::io::Read;
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkwork"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut written = vec![0; 100];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut written).unwrap();
    let signalled = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signalled.unwrap().success());
    std::thread::sleep(std::time::Duration::from_millis(300));
    stdout.read_to_end(&mut written).unwrap();
    let output = child.wait_with_output().unwrap();
    let [written, remark] = [written, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code(), written, remark)
}

/// As in a sweep: rows end with a whole one, and the status says that the answer did not.
#[cfg(unix)]
#[test]
fn an_interrupted_map_leaves_whole_rows_and_says_so() {
    let map = "workspace mechanisms/planar_2r.ron --grid 50 --map hand.x=-2..2 --map hand.y=-2..2 --format csv";
    let (status, written, remark) = interrupted(&map.split(' ').collect::<Vec<_>>());
    assert_eq!(status, Some(1));
    assert!(remark.contains("note: interrupted"), "{remark}");
    assert!(written.ends_with('\n'));
    let columns = written.lines().next().unwrap().split(',').count();
    let mut lines = written.lines();
    assert!(lines.all(|line| line.split(',').count() == columns));
}

/// All of it is worked out before the first byte is written.
#[cfg(unix)]
#[test]
fn an_answer_that_was_whole_when_it_was_interrupted_says_nothing_of_it() {
    let study = "study mechanisms/four_bar.ron --vary l2=3..5 --samples 4000 --quantity phi1";
    let (status, written, remark) = interrupted(&study.split(' ').collect::<Vec<_>>());
    assert_eq!((status, &*remark), (Some(0), ""));
    assert!(written.len() > 1 << 17, "{} bytes", written.len());
    assert_eq!(written.lines().count(), 4001);
}

/// Home of the five-bar with a hand by its elbows: ψ₁ < 0 < ψ₂ in one working mode alone, and P above the middle of
/// the motors where the circles of the couplers about the elbows meet.
#[test]
fn home_is_in_the_mode_in_which_its_elbows_point_as_they_do_at_home() {
    let mechanism = five_bar(&[]);
    let whole = [("hand.x", -0.6, 0.8), ("hand.y", -0.1, 0.7)];
    let settings = WorkspaceSettings {
        nodes: vec![36],
        ..WorkspaceSettings::default()
    };
    let report = asked(&mechanism, &whole, &[], &settings);
    let home = report.home.as_ref().unwrap();
    let (elbow, half) = (0.3 * (PI / 3.0).sin(), 0.1 + 0.3 * (PI / 3.0).cos());
    let top = [0.1, elbow + (0.4f64 * 0.4 - half * half).sqrt()];
    assert!((home.at[0] - top[0]).abs() < 1e-9 && (home.at[1] - top[1]).abs() < 1e-9);
    let folded = |joints: &[f64]| joints[2] < 0.0 && joints[3] > 0.0;
    let mode = home.mode.unwrap();
    let node_near = |at: &[f64]| (0..2).all(|k| (at[k] - top[k]).abs() < 0.05);
    let mut near = 0;
    for (at, cells) in nodes(&report) {
        for cell in cells {
            if cell.mode == mode {
                assert!(folded(cell.joints), "{at:?}: {:?}", cell.joints);
            } else if node_near(&at) {
                assert!(!folded(cell.joints), "{at:?}: {:?}", cell.joints);
            }
            // nothing is singular so near home
            if cell.mode == mode && node_near(&at) {
                assert_eq!(cell.aspect, home.aspect, "{at:?}");
                near += 1;
            }
        }
    }
    assert!(near > 2);
    // the box beside it, which the same mode reaches
    let beside = [("hand.x", -0.6, 0.05), ("hand.y", -0.1, 0.3)];
    let home = asked(&mechanism, &beside, &[], &settings).home.unwrap();
    assert!((home.mode, home.aspect) == (None, None) && (home.at[1] - top[1]).abs() < 1e-9);
    // legs of 0.7 m never reach 5 m
    let report = asked(&mechanism, &whole[..1], &[("hand.y", 5.0)], &settings);
    assert_eq!((report.home, report.reached), (None, 0));
}

/// Of two assemblies at the same inputs the guess says which is meant, also where home is given a turn further on.
#[test]
fn the_mode_of_what_is_guessed_is_told_instead_of_that_of_home() {
    let mechanism = written(&text("five_bar"), &[]);
    let settings = WorkspaceSettings {
        nodes: vec![9, 9],
        ..WorkspaceSettings::default()
    };
    let up = |guess: Option<f64>, turn: f64| {
        let question = Question::new(mechanism.clone())
            .input("theta1", turn + 0.9, turn + 1.2)
            .input("theta2", turn + 1.9, turn + 2.2);
        let question = match guess {
            Some(side) => (question.guess("psi1", side)).guess("psi2", -side),
            None => question,
        };
        let report = question.workspace(&settings, &Watch::none()).unwrap();
        let home = report.home.clone().unwrap();
        let at = [turn + PI / 3.0, turn + 2.0 * PI / 3.0];
        assert!((0..2).all(|k| (home.at[k] - at[k]).abs() < 1e-9));
        assert_eq!(report.modes.len(), 2);
        let mode = home.mode.unwrap();
        let cells = nodes(&report).into_iter().flat_map(|(_, cells)| {
            let cells = cells.into_iter().filter(|cell| cell.mode == mode);
            // psi1 passes half a turn where the elbow is down
            cells.map(|cell| cell.joints[3].sin() < 0.0)
        });
        let sides: Vec<bool> = cells.collect();
        assert!(sides.iter().all(|side| *side == sides[0]) && sides.len() == 81);
        sides[0]
    };
    assert!(up(None, 0.0) && up(None, 2.0 * PI) && !up(Some(-2.0), 0.0));
}

/// At x = g/2 both legs are stretched at once where y² = 0.7² − 0.1²: the edge to the node beyond ends on that corner of the
/// boundary in every mode, whatever the seed.
#[test]
fn edges_through_a_corner_of_the_boundary_do_not_depend_on_the_seed() {
    let mechanism = written(&text("five_bar_hand"), &[]);
    let corner = 0.48f64.sqrt();
    for seed in 1..=8 {
        let settings = WorkspaceSettings {
            nodes: vec![5, 4],
            seed,
            ..WorkspaceSettings::default()
        };
        let axes = [("hand.x", -0.1, 0.3), ("hand.y", 0.5, 0.8)];
        let report = asked(&mechanism, &axes, &[], &settings);
        let at_corner = report.points.iter().filter(|point| {
            (point.at[0] - 0.1).abs() < 1e-9 && (point.at[1] - corner).abs() < 1e-6
        });
        let mut modes: Vec<_> = at_corner.map(|point| point.mode).collect();
        modes.sort();
        assert_eq!(modes, [1, 2, 3, 4], "{seed}");
        let sizes = report.modes.iter().map(|mode| mode.size);
        assert!(
            sizes
                .clone()
                .all(|size| (size - report.reached_size).abs() < 1e-9),
            "{seed}: {:?}",
            sizes.collect::<Vec<_>>()
        );
    }
}

/// Newton's method ends at a fold from some starts and not from others. Nodes that lie to rounding on the rings of the legs,
/// |p| or |p − g| = |r ± c|, are of no mode, whatever the seed, and all between them are.
#[test]
fn nodes_on_the_very_boundary_do_not_depend_on_the_seed() {
    let mechanism = written(&text("five_bar_hand"), &[]);
    for (nodes, x, y, boundary) in [
        (30, (-0.6, 0.8), (-0.7, 0.7), 4),
        (31, (-0.6, 0.8), (-0.8, 0.8), 1),
        (31, (-0.5, 0.7), (-0.6, 0.6), 17),
    ] {
        let at =
            |k: usize, (low, high): (f64, f64)| low + (high - low) * k as f64 / (nodes - 1) as f64;
        let (mut inside, mut on) = (0, 0);
        for (i, j) in (0..nodes).flat_map(|i| (0..nodes).map(move |j| (i, j))) {
            let p = [at(i, x), at(j, y)];
            let radii = [0.0, 0.2].map(|g| (p[0] - g).hypot(p[1]));
            let between = |margin: f64| {
                radii
                    .iter()
                    .all(|d| (0.1 + margin..0.7 - margin).contains(d))
            };
            inside += usize::from(between(1e-12));
            on += usize::from(between(-1e-12) && !between(1e-12));
        }
        assert!(on >= boundary, "{on}");
        for seed in 1..=2 {
            let settings = WorkspaceSettings {
                nodes: vec![nodes; 2],
                seed,
                boundaries: false,
                ..WorkspaceSettings::default()
            };
            let axes = [("hand.x", x.0, x.1), ("hand.y", y.0, y.1)];
            let report = asked(&mechanism, &axes, &[], &settings);
            let found = (report.reached, report.modes.len());
            assert_eq!(found, (inside, 4), "{nodes} {x:?} {y:?} {seed}");
        }
    }
}
