//! Mechanisms whose numbers are rounded: the same freedoms as exact, and structures stay structures.

use linkwork::algebra::Measure;
use linkwork::analysis::frames::joint_axes;
use linkwork::analysis::rounding::{posed, posed_from_poses, snap};
use linkwork::ask::Question;
use linkwork::description::{AxesDescription, AxisPlace, Description, Entry, rounding_of_text};
use linkwork::geometry::Vector3;
use linkwork::mechanism::{Mechanism, Rounding};
use linkwork::output::rounding::sentence;
use linkwork::solve::Watch;

/// Overconstrained mechanisms that have one freedom each.
const SHIPPED: [&str; 12] = [
    "bennett",
    "goldberg_5r",
    "myard_5r",
    "bricard_line",
    "bricard_plane",
    "bricard_trihedral",
    "sarrus",
    "schatz",
    "spherical_four_bar",
    "four_bar",
    "three_parallel_cranks",
    "peaucellier",
];

/// Those that move only for special lengths and angles, wherever their axes are parallel or meet in one point.
const SPECIAL: [&str; 8] = [
    "three_parallel_cranks",
    "bennett",
    "goldberg_5r",
    "myard_5r",
    "bricard_line",
    "bricard_plane",
    "bricard_trihedral",
    "schatz",
];

fn description(name: &str) -> Description {
    let path = format!("{}/mechanisms/{name}.ron", env!("CARGO_MANIFEST_DIR"));
    Mechanism::read(path).unwrap().1
}

fn read(text: &str) -> (Description, Mechanism) {
    posed(Description::read(text).unwrap()).unwrap()
}

/// The freedoms where the mechanism is closed, if it closes.
fn freedoms(mechanism: &Mechanism) -> Option<usize> {
    let answer = Question::new(mechanism.clone()).mobility(&Watch::none());
    answer.unwrap().closed().map(|report| report.mobility)
}

fn is_changed(mechanism: &Mechanism) -> bool {
    matches!(mechanism.rounding(), Some(Rounding::Nearest(_)))
}

/// The same file with every parameter as a number of so many decimals.
fn rounded(description: &Description, digits: usize) -> Description {
    let mechanism = Mechanism::new(description).unwrap();
    let parameters = mechanism.parameters().iter();
    parameters.fold(description.clone(), |file, of| {
        file.with_parameter(&of.name, &format!("{:.digits$}", of.value))
            .unwrap()
    })
}

type Vector = [f64; 3];

/// Joint coordinates in a tilted frame away from the origin, with so many decimals, some then moved.
fn tilted(name: &str, digits: i32, moved: impl Fn(usize, &mut Vector)) -> Description {
    let mechanism = Mechanism::new(&description(name)).unwrap();
    let at = Question::new(mechanism.clone())
        .closed(&Watch::none())
        .unwrap()
        .closed()
        .unwrap();
    let mut axes = joint_axes(&mechanism, &at.configuration).unwrap();
    let turn = |[x, y, z]: Vector| {
        let ((s, c), (t, d)) = (0.7_f64.sin_cos(), (-0.4_f64).sin_cos());
        let [x, y] = [c * x - s * y, s * x + c * y];
        [x, d * y - t * z, t * y + d * z]
    };
    let value = |entry: &Entry| entry.expression.evaluate(&|_: &String| 0.0_f64).unwrap();
    let unit = 10.0_f64.powi(digits);
    let written = |v: Vector| v.map(|x| Entry::number((x * unit).round() / unit, 0..0));
    for (number, joint) in axes.joints.iter_mut().enumerate() {
        let AxisPlace::Along(point, direction) = &joint.value.place else {
            panic!("the axes of tables have directions");
        };
        let mut from = point
            .as_ref()
            .map_or([0.0; 3], |of| turn(of.each_ref().map(value)));
        let along = turn(direction.each_ref().map(value));
        moved(number, &mut from);
        let at = [0.3, -0.2, 0.1];
        let place = [0, 1, 2].map(|i| from[i] + at[i]);
        joint.value.place = AxisPlace::Along(Some(written(place)), written(along));
    }
    axes.tables().unwrap()
}

#[test]
fn shipped_mechanisms_with_rounded_parameters_move_as_they_did() {
    let mut changed = 0;
    for name in SHIPPED {
        let exact = description(name);
        let (_, mechanism) = posed(exact.clone()).unwrap();
        assert!(mechanism.rounding().is_none(), "{name}");
        for digits in [12, 9, 6, 4] {
            let (_, mechanism) = posed(rounded(&exact, digits)).unwrap();
            assert_eq!(freedoms(&mechanism), Some(1), "{name} {digits}");
            changed += usize::from(is_changed(&mechanism));
        }
    }
    // in the others rounding of parameters does no harm
    assert!(changed >= 12, "{changed}");
}

#[test]
fn shipped_mechanisms_with_rounded_coordinates_in_a_tilted_frame_move_as_they_did() {
    let mut failed = Vec::new();
    for name in SHIPPED {
        for digits in [9, 6, 4] {
            let (_, mechanism) = posed(tilted(name, digits, |_, _| {})).unwrap();
            let found = (is_changed(&mechanism), freedoms(&mechanism));
            // axes that are parallel, or meet in one point, still do when all are rounded alike
            let expected = (SPECIAL.contains(&name), Some(1));
            if found != expected {
                failed.push((name, digits, found));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn a_hinge_ten_roundings_aside_leaves_a_structure() {
    for (name, joint) in SPECIAL.iter().zip([1, 1, 2, 3, 0, 2, 3, 1]) {
        for digits in [6, 4] {
            let aside = |number: usize, point: &mut Vector| {
                if number == joint {
                    point
                        .iter_mut()
                        .for_each(|x| *x += 10.0_f64.powi(1 - digits));
                }
            };
            let (_, mechanism) = posed(tilted(name, digits, aside)).unwrap();
            assert!(
                !is_changed(&mechanism),
                "{name} {digits} {:?}",
                mechanism.rounding()
            );
        }
    }
}

/// Bricard's plane-symmetric linkage as a table in which the second of two links that mirror each other is longer by so much.
fn mirrored(longer: f64) -> Description {
    let text = format!(
        r#"Mechanism(version: 1, name: "mirrored", convention: Modified,
        joints: {{ "theta1": Actuated(home: -2.1415926535897932), "theta2": Passive(home: -1.20580), "theta3": Passive(home: 1.72722),
            "theta4": Passive(home: 2.45665), "theta5": Passive(home: 1.72722) }},
        chains: {{
            "links": Chain(rows: [(theta: "theta1"), (alpha: "70 deg", a: 0.8, d: 0.3, theta: "theta2"),
                (alpha: "55 deg", a: 1.1, d: -0.2, theta: "theta3"), (alpha: "100 deg", a: 0.6, theta: "theta4"),
                (alpha: "-100 deg", a: 0.6, theta: "theta5")], tip: [T({}, 0, 0.2), Rx("-55 deg")]),
            "hinge6": Chain(base: [T(-0.8, -0.28191, 0.10261), Rx("70 deg")]),
        }},
        closures: {{ "joint6": Revolute("links", "hinge6") }})"#,
        1.1 + longer
    );
    Description::read(&text).unwrap()
}

#[test]
fn a_link_of_a_table_ten_roundings_longer_than_its_mirror_is_a_structure() {
    // five decimals: a rounding is 5 µm
    let (_, mechanism) = posed(mirrored(0.0)).unwrap();
    assert!(is_changed(&mechanism));
    assert_eq!(freedoms(&mechanism), Some(1));
    for longer in [5e-5, 1e-4] {
        let (_, mechanism) = posed(mirrored(longer)).unwrap();
        assert!(!is_changed(&mechanism), "{longer}");
        assert_eq!(freedoms(&mechanism), None, "{longer}");
    }
}

#[test]
fn a_pose_of_another_file_ten_roundings_aside_leaves_a_structure() {
    // the same linkage from quaternions and positions of four decimals
    let table = |text: &str| Description::read(text).unwrap();
    let near = table(&mirrored(0.0).to_ron().unwrap());
    let (_, mechanism) = posed_from_poses(near, 5e-5).unwrap();
    assert_eq!(freedoms(&mechanism), Some(1));
    let (_, mechanism) = posed_from_poses(mirrored(1e-3), 5e-5).unwrap();
    assert!(!is_changed(&mechanism), "{:?}", mechanism.rounding());
    assert_eq!(freedoms(&mechanism), None);
}

/// Pins through points to a micrometre, of a plane linkage of 20, 60, 80, 100 mm in a tilted plane.
const PINS: &str = include_str!("../exchange/pins.ron");

/// Unit vectors along the pins, of two points each.
fn directions(file: &Description) -> impl Iterator<Item = Vector3<f64>> {
    let values: Vec<f64> = file.literals().iter().map(|of| of.value()).collect();
    let pins: Vec<Vector3<f64>> = values
        .chunks_exact(6)
        .map(|of| Vector3::new(of[3] - of[0], of[4] - of[1], of[5] - of[2]))
        .collect();
    pins.into_iter().map(|of| of.scaled(1.0 / of.norm()))
}

#[test]
fn a_four_bar_with_pins_to_a_micrometre_moves_by_the_law_of_cosines() {
    let (file, mechanism) = read(PINS);
    let Some(Rounding::Nearest(found)) = mechanism.rounding() else {
        panic!("{:?}", mechanism.rounding());
    };
    assert!(found.gap < 5e-6 && found.gap_angle < 2e-4, "{found:?}");
    // no coordinate by more than half a micrometre
    assert!(
        found
            .changes
            .iter()
            .all(|of| (of.to - of.from).abs() <= 0.5e-6 && of.is_length)
    );
    let said = sentence(mechanism.rounding().unwrap());
    assert!(said.starts_with("Closes to 2.6 µm and 0.0"), "{said}");
    assert!(
        said.contains("nearest linkage that closes exactly (24 numbers changed"),
        "{said}"
    );
    assert_eq!(freedoms(&mechanism), Some(1));
    // not only a linkage that moves: the drawing means parallel pins
    let across = directions(&file).map(|pin| pin.cross(&directions(&file).next().unwrap()));
    assert!(across.map(|of| of.norm()).all(|of| of < 1e-14));
    let drawn = Description::read(PINS).unwrap();
    let across = directions(&drawn).map(|pin| pin.cross(&directions(&drawn).next().unwrap()));
    assert!(across.map(|of| of.norm()).any(|of| of > 1e-6));
    // crank, coupler, rocker and ground by the law of cosines, at 20° of the crank
    let at = Question::new(mechanism)
        .hold("crank", "20 deg")
        .closed(&Watch::none());
    let joints = at.unwrap().closed().unwrap().configuration.joints;
    for (found, known) in joints[1..].iter().zip([-25.7712_f64, 2.0643]) {
        assert!((found.to_degrees() - known).abs() < 0.01, "{joints:?}");
    }
    // the exact file is left as it is
    let exact = snap(&file, &read(PINS).1).file;
    assert!(read(&exact).1.rounding().is_none());
    assert_eq!(freedoms(&read(&exact).1), Some(1));
}

#[test]
fn next_to_nothing_out_of_plane_is_nothing_and_a_millimetre_is_not() {
    let file = |row: &str| {
        format!(
            r#"Mechanism(version: 1, name: "four-bar", convention: Modified,
            joints: {{ "t1": Actuated(home: "60 deg"), "t2": Passive(home: "-30 deg"), "t3": Passive(home: "80 deg") }},
            chains: {{ "left": Chain(rows: [(theta: "t1"), (a: 2, {row}, theta: "t2")], tip: [Tx(3.5)]),
                "right": Chain(base: [Tx(4)], rows: [(theta: "t3")], tip: [Tx(3)]) }},
            closures: {{ "B": Revolute("left", "right") }})"#
        )
    };
    for row in ["d: 1e-12", "d: -3e-10", "alpha: 1e-9"] {
        let (_, mechanism) = read(&file(row));
        assert!(is_changed(&mechanism), "{row}");
        assert_eq!(freedoms(&mechanism), Some(1), "{row}");
    }
    for row in ["d: 0.001", "alpha: 0.001"] {
        assert_eq!(freedoms(&read(&file(row)).1), None, "{row}");
    }
    // but for one who says that drawings are no better
    let drawn = Description::read(&file("d: 0.001")).unwrap();
    let (_, mechanism) = posed(drawn.clone().with_tolerance("1 mm").unwrap()).unwrap();
    assert_eq!(freedoms(&mechanism), Some(1));
    let (_, mechanism) = posed(drawn.with_tolerance("0.1 mm").unwrap()).unwrap();
    assert_eq!(freedoms(&mechanism), None);
    let said = file("d: 0.001").replace("name:", "tolerance: \"1 mm\", name:");
    assert_eq!(freedoms(&read(&said).1), Some(1));
}

#[test]
fn right_angles_are_recognised() {
    // a universal joint's four hinges, 1.5708 for a right angle
    let text = r#"Mechanism(version: 1, name: "spherical", convention: Standard,
        joints: { "a": Actuated(home: "45 deg"), "b": Passive(home: "-55 deg"), "c": Passive(home: "35 deg") },
        chains: {
            "driving": Chain(rows: [(alpha: 1.5708, theta: "a + 1.5708"), (alpha: 1.5708, theta: "b")]),
            "driven": Chain(base: [Rx(0.7854)], rows: [(alpha: 1.5708, theta: "c")]),
        },
        closures: { "cross": Revolute("driving", "driven") })"#;
    let (file, mechanism) = read(text);
    assert_eq!(freedoms(&mechanism), Some(1));
    let alpha = &file.chains[0].value.rows[0].alpha.expression;
    if is_changed(&mechanism) {
        assert_eq!(alpha.to_string(), "90 deg");
        assert_eq!(alpha.measure(&|_| Measure::Open).unwrap(), Measure::Angle);
    }
}

#[test]
fn structures_stay_structures() {
    for name in ["triangle", "flat_triangle"] {
        let exact = description(name);
        for digits in [9, 6, 4] {
            let (_, mechanism) = posed(rounded(&exact, digits)).unwrap();
            assert!(mechanism.rounding().is_none(), "{name}");
        }
    }
    // two rods nearly in line between posts 2.00001 m apart: shaky, moves by the root of a rounding only
    let shaky = r#"Mechanism(version: 1, name: "shaky", convention: Modified,
        joints: { "p": Passive(), "q": Passive(), "r": Passive() },
        chains: { "left": Chain(rows: [(theta: "p"), (a: 1.000001, theta: "q")], tip: [Tx(0.999999)]),
            "right": Chain(base: [Tx(2.000001)], rows: [(theta: "r")], tip: []) },
        closures: { "pin": Revolute("left", "right") })"#;
    let (_, mechanism) = read(shaky);
    assert!(mechanism.rounding().is_none(), "{:?}", mechanism.rounding());
}

/// Two of the loop in one file, the joints of the second with a 2 behind their names.
fn twice(second: &str) -> String {
    let inside = |text: &str| {
        let (start, end) = (
            text.find("joints: {").unwrap() + 9,
            text.rfind("})").unwrap(),
        );
        text[start..end].to_owned()
    };
    let names = ["crank", "A", "B", "rocker", "coupler"];
    let second = names.iter().fold(inside(second), |text, name| {
        text.replace(&format!("\"{name}\""), &format!("\"{name}2\""))
    });
    PINS.replace("})", "") + &second + "})"
}

#[test]
fn loops_are_closed_one_by_one() {
    let both = read(&twice(PINS)).1;
    assert!(is_changed(&both));
    assert_eq!(freedoms(&both), Some(2));
    // a pin of the second loop forty roundings out of line leaves that loop as it is, and the first is closed
    let aside = PINS.replace("130.028 mm", "130.048 mm");
    let mechanism = read(&twice(&aside)).1;
    let Some(Rounding::Nearest(found)) = mechanism.rounding() else {
        panic!("{:?}", mechanism.rounding());
    };
    assert!(
        found.changes.iter().all(|of| !of.place.contains('2')),
        "{found:?}"
    );
}

#[test]
fn a_file_loaded_by_its_name_is_closed_too() {
    let path = std::env::temp_dir().join(format!("rounded-pins-{}.ron", std::process::id()));
    std::fs::write(&path, PINS).unwrap();
    let mechanism = linkwork::load(&path);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(freedoms(&mechanism.unwrap()), Some(1));
}

#[test]
fn digits_are_counted_where_they_say_something() {
    // six digits each, as printf's %g writes them: what is nearly nothing has decimals that say little
    let digits = r#"<body pos="0.0316325 1.98799e-15 -0.037853" quat="0.000327035 -0.790569 0.000422201 -0.612372"/>"#;
    assert_eq!(rounding_of_text(digits), Some(0.5e-6));
    // six decimals each, and numbers of all digits beside them
    assert_eq!(
        rounding_of_text("12.345678 0.123456 0.30000000000000004"),
        Some(0.5e-6)
    );
    // six digits each: angles above 1 are off by more
    assert_eq!(rounding_of_text("3.14159 -2.0944 0.860271"), Some(5e-6));
    assert_eq!(rounding_of_text("1.5708 0.05"), Some(0.5e-4));
    // chosen, not rounded
    assert_eq!(rounding_of_text("0.125 0.5 1.25"), None);
    assert_eq!(rounding_of_text("0.30000000000000004 0.1"), None);
}

#[test]
fn an_axes_file_keeps_its_tolerance() {
    let text = PINS.replace("name:", "tolerance: \"0.01 mm\", name:");
    let axes = AxesDescription::read(&text).unwrap();
    let again = AxesDescription::read(&axes.to_ron().unwrap()).unwrap();
    assert_eq!(axes.tolerance, again.tolerance);
    assert!(is_changed(&read(&text).1));
}

#[test]
fn links_of_equal_length_in_a_drawing_are_equal() {
    // crank and rocker of 60 mm, and a rocker 10 µm longer
    let file = |rocker: f64| {
        let across = [0.939_692_620_785, 0.321_393_804_843, 0.116_977_778_44];
        let (u, v) = (
            [0.342_020_143_325, -0.883_022_221_559, -0.321_393_804_843],
            across,
        );
        let at = |x: f64, y: f64| [0, 1, 2].map(|i| 0.1 + u[i] * x + v[i] * y);
        let n = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        let pin = |name: &str, between: [&str; 2], point: [f64; 3]| {
            let written = |of: [f64; 3]| format!("({:.6}, {:.6}, {:.6})", of[0], of[1], of[2]);
            let other = [0, 1, 2].map(|i| point[i] + 0.02 * n[i]);
            format!(
                "\"{name}\": Revolute(through: ({}, {}), between: (\"{}\", \"{}\")),",
                written(point),
                written(other),
                between[0],
                between[1]
            )
        };
        let pins = [
            pin("crank", ["ground", "crank"], at(0.0, 0.0)),
            pin("A", ["crank", "coupler"], at(0.036, 0.048)),
            pin(
                "B",
                ["coupler", "rocker"],
                at(0.1 - 0.8 * rocker, 0.6 * rocker),
            ),
            pin("rocker", ["ground", "rocker"], at(0.1, 0.0)),
        ];
        format!(
            "Axes(version: 1, name: \"pins\", joints: {{ {} }})",
            pins.concat()
        )
    };
    let ratio = |text: &str| {
        let (file, mechanism) = read(text);
        assert!(is_changed(&mechanism));
        assert_eq!(freedoms(&mechanism), Some(1));
        let values: Vec<f64> = file.literals().iter().map(|of| of.value()).collect();
        let points = values
            .chunks_exact(3)
            .map(|of| Vector3::new(of[0], of[1], of[2]));
        let points: Vec<Vector3<f64>> = points.collect();
        // across the axis of the crank: points on pins may lie beside one another
        let axis = points[1] - points[0];
        let axis = axis.scaled(1.0 / axis.norm());
        let apart = |from: usize, to: usize| {
            let way = points[2 * to] - points[2 * from];
            (way - axis.scaled(way.dot(&axis))).norm()
        };
        apart(0, 1) / apart(3, 2)
    };
    assert!((ratio(&file(0.06)) - 1.0).abs() < 1e-14);
    assert!((ratio(&file(0.06001)) - 1.0).abs() > 1e-4);
}
