//! All complex and real assemblies of random mechanisms against those that PHCpack finds from other equations.
//!
//! `tests/data/witness.json` holds the geometries and their solutions; `tests/data/witness.py` made it and says how. Here
//! the same numbers become mechanism files.

use std::f64::consts::TAU;
use std::path::Path;

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Wanted,
};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;
use num_complex::Complex64;
use serde_json::{Map, Value};

/// A coordinate that the witness knows too.
#[derive(Clone, Copy)]
enum Read {
    /// cos t + i sin t of a joint's angle t.
    Turn(&'static str),
    /// The length of a slide.
    Slide(&'static str),
    /// Position and rotation matrix of a platform, row by row.
    Pose(&'static str),
    /// Position and cos t + i sin t of a platform that stays in the plane.
    InPlane(&'static str),
    /// The position of a platform.
    Place(&'static str),
}
use Read::{InPlane, Place, Pose, Slide, Turn};

struct Family {
    inputs: &'static [&'static str],
    read: &'static [Read],
    /// Convention and joints that are not inputs, chains, platforms and closures.
    convention: &'static str,
    passive: &'static [&'static str],
    body: String,
}

/// The text for each of `1..=n`, with the number in place of `#`.
fn each(n: usize, text: &str) -> String {
    (1..=n).map(|i| text.replace('#', &i.to_string())).collect()
}

fn rods() -> String {
    each(
        3,
        r##""arm#": Chain(base: [Rz("g#"), Tx("w#"), Rx("-90 deg")], rows: [(theta: "theta#")], tip: [Tx("L#")]),
        "left#": Chain(on: "arm#", base: [Tz("h")]), "right#": Chain(on: "arm#", base: [Tz("-h")]),"##,
    )
}

fn delta() -> String {
    let frames = each(
        3,
        r##""left#": [Rz("g#"), Tx("u#"), Ty("h")], "right#": [Rz("g#"), Tx("u#"), Ty("-h")],"##,
    );
    let closures = each(
        3,
        r##""left#": Distance("left#", "hand.left#", "k#"), "right#": Distance("right#", "hand.right#", "k#"),"##,
    );
    format!(
        r#"chains: {{{}}}, platforms: {{"hand": Platform(home: [Tz(-1)], frames: {{{frames}}})}},
        closures: {{{closures}}}"#,
        rods()
    )
}

/// Six legs; `corners` says at which corner of the platform each ends.
fn legs(corners: [usize; 6]) -> String {
    let feet = each(6, r##""A#": Chain(base: [T("a#x", "a#y", "a#z")]),"##);
    let corner = r##""B#": [T("b#x", "b#y", "b#z")],"##;
    let frames = each(*corners.iter().max().unwrap(), corner);
    let legs = corners.iter().enumerate();
    let legs: String = legs
        .map(|(i, b)| format!(r#""leg{0}": Distance("A{0}", "top.B{b}", "l{0}"),"#, i + 1))
        .collect();
    format!(
        r#"chains: {{{feet}}}, platforms: {{"top": Platform(home: [Tz(0.9)], frames: {{{frames}}})}},
        closures: {{{legs}}}"#
    )
}

fn family(name: &str) -> Family {
    match name {
        "four_bar" => Family {
            inputs: &["theta1"],
            read: &[Turn("phi1"), Turn("phi2")],
            convention: "Modified",
            passive: &["phi1", "phi2"],
            body: r#"chains: {
                    "left": Chain(rows: [(theta: "theta1"), (a: "l1", theta: "phi2")], tip: [Tx("l2")]),
                    "right": Chain(base: [Tx("l0")], rows: [(theta: "phi1")], tip: [Tx("l3")]) },
                closures: { "c": Revolute("left", "right") }"#
                .into(),
        },
        "slider_crank" => Family {
            inputs: &["theta"],
            read: &[Slide("s"), Turn("phi")],
            convention: "Modified",
            passive: &["phi", "s"],
            body: r#"chains: {
                    "crank": Chain(rows: [(theta: "theta"), (a: "r", theta: "phi")], tip: [Tx("l")]),
                    "slider": Chain(base: [Ty("e"), Ry("90 deg")], rows: [(d: "s")], tip: [Ry("-90 deg")]) },
                closures: { "c": Revolute("crank", "slider") }"#
                .into(),
        },
        "five_bar" => Family {
            inputs: &["theta1", "theta2"],
            read: &[Turn("psi1"), Turn("psi2")],
            convention: "Modified",
            passive: &["psi1", "psi2"],
            body: r#"chains: {
                    "left": Chain(rows: [(theta: "theta1"), (a: "r1", theta: "psi1")], tip: [Tx("k1")]),
                    "right": Chain(base: [Tx("g")], rows: [(theta: "theta2"), (a: "r2", theta: "psi2")],
                        tip: [Tx("k2")]) },
                closures: { "c": Revolute("left", "right") }"#
                .into(),
        },
        "planar_3rpr" => Family {
            inputs: &["rho1", "rho2", "rho3"],
            read: &[InPlane("platform")],
            convention: "Modified",
            passive: &["theta1", "theta2", "theta3"],
            body: format!(
                r#"chains: {{{}}}, platforms: {{"platform": Platform(frames: {{{}}})}}, closures: {{{}}}"#,
                each(3, r##""leg#": Chain(base: [T("a#x", "a#y", 0)],
                    rows: [(theta: "theta# - 90 deg"), (alpha: "-90 deg", d: "rho#")], tip: [Rx("90 deg")]),"##),
                each(3, r##""B#": [T("b#x", "b#y", 0)],"##),
                each(3, r##""B#": Revolute("leg#", "platform.B#"),"##),
            ),
        },
        "three_rps" => Family {
            inputs: &["l1", "l2", "l3"],
            read: &[Turn("phi1"), Turn("phi2"), Turn("phi3")],
            convention: "Modified",
            passive: &["phi1", "phi2", "phi3"],
            body: format!(
                r#"chains: {{{}}}, platforms: {{"top": Platform(home: [Tz(0.5)], frames: {{{}}})}}, closures: {{{}}}"#,
                each(3, r##""leg#": Chain(base: [Rz("g#"), Tx("r#"), Rx("90 deg")],
                    rows: [(theta: "phi#"), (alpha: "-90 deg", d: "l#")]),"##),
                each(3, r##""S#": [T("b#x", "b#y", 0)],"##),
                each(3, r##""S#": Spherical("leg#", "top.S#"),"##),
            ),
        },
        "hand" => Family {
            inputs: &["theta1", "theta2", "theta3", "psi1", "psi2", "psi3"],
            read: &[Turn("phi1"), Turn("phi2"), Turn("phi3")],
            convention: "Modified",
            passive: &["phi1", "phi2", "phi3"],
            body: format!(
                r#"chains: {{{}}}, closures: {{ "p1p2": Distance("finger1", "finger2", "k12"),
                    "p2p3": Distance("finger2", "finger3", "k23"), "p3p1": Distance("finger3", "finger1", "k31") }}"#,
                each(3, r##""finger#": Chain(base: [T("f#x", "f#y", "f#z"), Ry("gamma#")], rows: [(theta: "theta#"),
                    (alpha: "90 deg", a: "m#", theta: "psi#"), (a: "n#", theta: "phi#")], tip: [Tx("o#")]),"##),
            ),
        },
        "spherical_four_bar" => Family {
            inputs: &["theta1"],
            read: &[Turn("theta2")],
            convention: "Standard",
            passive: &["phi", "theta2"],
            body: r#"chains: {
                    "driving": Chain(rows: [(alpha: "crank", theta: "theta1"), (alpha: "coupler", theta: "phi")]),
                    "driven": Chain(base: [Rx("ground_arc")], rows: [(alpha: "driven", theta: "theta2")]) },
                closures: { "pin": Revolute("driving", "driven") }"#
                .into(),
        },
        "rssr" => Family {
            inputs: &["theta"],
            read: &[Turn("psi")],
            convention: "Modified",
            passive: &["psi"],
            body: r#"chains: {
                    "crank": Chain(rows: [(d: "k", theta: "theta")], tip: [Tx("a")]),
                    "rocker": Chain(base: [T("x", "y", "z"), Rz("yaw"), Rx("tilt")], rows: [(d: "d", theta: "psi")],
                        tip: [Tx("c")]) },
                closures: { "rod": Distance("crank", "rocker", "s") }"#
                .into(),
        },
        "watt" => Family {
            inputs: &["theta"],
            read: &[Turn("phi1"), Turn("phi2")],
            convention: "Modified",
            passive: &["psi1", "phi1", "psi2", "phi2"],
            body: r#"chains: {
                    "crank": Chain(rows: [(theta: "theta"), (a: "a1", theta: "psi1")], tip: [Tx("b1")]),
                    "middle": Chain(base: [Tx("g1")], rows: [(theta: "phi1")], tip: [Tx("c1")]),
                    "coupler": Chain(on: "middle.1", base: [Rz("phase")], rows: [(a: "a2", theta: "psi2")],
                        tip: [Tx("b2")]),
                    "output": Chain(base: [Tx("g1 + g2")], rows: [(theta: "phi2")], tip: [Tx("c2")]) },
                closures: { "first": Revolute("crank", "middle"), "second": Revolute("coupler", "output") }"#
                .into(),
        },
        "stephenson" => Family {
            inputs: &["theta"],
            read: &[Turn("theta1"), Turn("psi1"), Turn("phi1")],
            convention: "Modified",
            passive: &["theta1", "psi1", "phi1", "chi"],
            body: r#"chains: {
                    "crank": Chain(rows: [(theta: "theta1"), (a: "a", theta: "psi1")], tip: [Tx("b")]),
                    "rocker": Chain(base: [Tx("g")], rows: [(theta: "phi1")], tip: [Tx("c")]),
                    "link": Chain(on: "crank.2", base: [T("u", "v", 0)], rows: [(theta: "chi")], tip: [Tx("l")]),
                    "driver": Chain(base: [T("qx", "qy", 0)], rows: [(theta: "theta")], tip: [Tx("r")]) },
                closures: { "four_bar": Revolute("crank", "rocker"), "P": Revolute("link", "driver") }"#
                .into(),
        },
        "six_r" => Family {
            inputs: &[],
            read: &[Turn("q1"), Turn("q2"), Turn("q3"), Turn("q4"), Turn("q5"), Turn("q6")],
            convention: "Standard",
            passive: &["q1", "q2", "q3", "q4", "q5", "q6"],
            body: format!(
                r#"chains: {{ "links": Chain(base: [T("px", "py", "pz"), Rz("yaw"), Ry("pitch"), Rx("roll")],
                    rows: [{}]) }}, closures: {{ "c": Rigid("links", "ground") }}"#,
                each(6, r##"(a: "a#", alpha: "alpha#", d: "d#", theta: "q#"),"##),
            ),
        },
        "six_three" => Family {
            inputs: &["l1", "l2", "l3", "l4", "l5", "l6"],
            read: &[Pose("top")],
            convention: "Modified",
            passive: &[],
            body: legs([1, 1, 2, 2, 3, 3]),
        },
        "stewart_gough" => Family {
            inputs: &["l1", "l2", "l3", "l4", "l5", "l6"],
            read: &[Pose("top")],
            convention: "Modified",
            passive: &[],
            body: legs([1, 2, 3, 4, 5, 6]),
        },
        "delta" | "delta_of_rods" => Family {
            inputs: &["theta1", "theta2", "theta3"],
            read: if name == "delta" { &[Place("hand")] } else { &[Pose("hand")] },
            convention: "Modified",
            passive: &[],
            body: delta(),
        },
        other => panic!("no family {other}"),
    }
}

impl Family {
    fn mechanism(&self, numbers: &Map<String, Value>) -> Mechanism {
        let given = numbers.iter().map(|(name, value)| {
            // `ground` is a name of its own in mechanism files
            let name = if name == "ground" { "ground_arc" } else { name };
            (name, value)
        });
        let (inputs, parameters): (Vec<_>, Vec<_>) =
            given.partition(|(name, _)| self.inputs.contains(name));
        let parameters: String = parameters
            .iter()
            .map(|(n, v)| format!("\"{n}\": {v},"))
            .collect();
        let actuated = inputs
            .iter()
            .map(|(n, v)| format!("\"{n}\": Actuated(home: {v}),"));
        let passive = self.passive.iter().map(|n| format!("\"{n}\": Passive(),"));
        let joints: String = actuated.chain(passive).collect();
        let text = format!(
            "Mechanism(version: 1, name: \"random\", convention: {}, parameters: {{{parameters}}}, joints: {{{joints}}}, {})",
            self.convention, self.body
        );
        Mechanism::new(&Description::read(&text).unwrap_or_else(|e| panic!("{e:?}\n{text}")))
            .unwrap()
    }

    /// The witness's coordinates of every solution, the real ones first, and how many those are.
    fn solutions(&self, report: &AssembliesReport) -> (Vec<Vec<Complex64>>, usize) {
        let real = |x: &f64| Complex64::new(*x, 0.0);
        let complex = |z: &[f64; 2]| Complex64::new(z[0], z[1]);
        let mut found = Vec::new();
        for assembly in &report.assemblies {
            let joint = |name: &str| real(assembly.joints.get(name).unwrap());
            let pose = |name: &str| {
                let pose = assembly.platforms.get(name).unwrap();
                let all = pose.position.iter().chain(&pose.quaternion);
                all.map(real).collect()
            };
            found.push(
                self.read
                    .iter()
                    .flat_map(|r| read(*r, &joint, &pose))
                    .collect(),
            );
        }
        for assembly in &report.complex_assemblies {
            let joint = |name: &str| complex(assembly.joints.get(name).unwrap());
            let pose = |name: &str| {
                let pose = assembly.platforms.get(name).unwrap();
                pose.iter().map(complex).collect()
            };
            found.push(
                self.read
                    .iter()
                    .flat_map(|r| read(*r, &joint, &pose))
                    .collect(),
            );
        }
        (found, report.assemblies.len())
    }
}

fn read(
    what: Read,
    joint: &dyn Fn(&str) -> Complex64,
    pose: &dyn Fn(&str) -> Vec<Complex64>,
) -> Vec<Complex64> {
    let i = Complex64::i();
    match what {
        Turn(name) => vec![(i * joint(name)).exp()],
        Slide(name) => vec![joint(name)],
        Place(name) => pose(name)[..3].to_vec(),
        Pose(name) => {
            let pose = pose(name);
            [&pose[..3], &matrix(&pose[3..])].concat()
        }
        InPlane(name) => {
            let pose = pose(name);
            let matrix = matrix(&pose[3..]);
            vec![pose[0], pose[1], matrix[0] + i * matrix[3]]
        }
    }
}

/// The rotation matrix of a quaternion of length 1, row by row (Hamilton's formula).
fn matrix(q: &[Complex64]) -> [Complex64; 9] {
    let [w, x, y, z] = [q[0], q[1], q[2], q[3]];
    let (one, two) = (Complex64::new(1.0, 0.0), 2.0);
    [
        one - (y * y + z * z) * two,
        (x * y - w * z) * two,
        (x * z + w * y) * two,
        (x * y + w * z) * two,
        one - (x * x + z * z) * two,
        (y * z - w * x) * two,
        (x * z - w * y) * two,
        (y * z + w * x) * two,
        one - (x * x + y * y) * two,
    ]
}

/// Largest difference of two solutions, compared with their size.
fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    let far = a
        .iter()
        .zip(b)
        .map(|(a, b)| (a - b).norm() / (1.0 + b.norm()));
    far.fold(0.0, f64::max)
}

/// What the two lists disagree in; the witness's list is the second.
fn disagreement(found: &[Vec<Complex64>], known: &[Vec<Complex64>], digits: f64) -> Option<String> {
    if found.len() != known.len() {
        return Some(format!("{} solutions against {}", found.len(), known.len()));
    }
    let mut left: Vec<&Vec<Complex64>> = found.iter().collect();
    for solution in known {
        let far = |k: usize| apart(left[k], solution);
        let best = (0..left.len())
            .min_by(|a, b| far(*a).total_cmp(&far(*b)))
            .unwrap();
        if far(best) > digits {
            return Some(format!(
                "nearest to {solution:?} is off by {:.1e}",
                far(best)
            ));
        }
        left.swap_remove(best);
    }
    None
}

fn cases(name: &str) -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/witness.json");
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let cases = data["cases"].as_array().unwrap().iter();
    cases
        .filter(|case| case["family"] == name)
        .cloned()
        .collect()
}

fn answer(mechanism: &Mechanism) -> AssembliesReport {
    let question = Question::new(mechanism);
    let held = question.held();
    let solver = AssemblySolver::new(
        mechanism,
        &held,
        &AssembliesSettings::default(),
        &Watch::none(),
    )
    .unwrap();
    let wanted = Wanted {
        all_complex: true,
        ..Wanted::default()
    };
    solver.at_targets(&question.start(), &held, wanted, &Watch::none())
}

/// Real and complex solutions of every geometry of a family, and of one that is slightly wrong.
fn agrees(name: &str, least: usize) {
    const DIGITS: f64 = 1e-9;
    let family = family(name);
    let cases = cases(name);
    assert!(cases.len() >= least, "{name}: {} geometries", cases.len());
    for (k, case) in cases.iter().enumerate() {
        let numbers = case["numbers"].as_object().unwrap();
        let solutions = case["solutions"].as_array().unwrap();
        let values = |solution: &Value| -> Vec<Complex64> {
            let pairs = solution["values"].as_array().unwrap().iter();
            pairs
                .map(|z| Complex64::new(z[0].as_f64().unwrap(), z[1].as_f64().unwrap()))
                .collect()
        };
        let (real, rest): (Vec<&Value>, Vec<&Value>) =
            solutions.iter().partition(|s| s["real"] == true);
        let real: Vec<_> = real.into_iter().map(values).collect();
        let rest: Vec<_> = rest.into_iter().map(values).collect();
        let lists = |numbers: &Map<String, Value>| {
            let report = answer(&family.mechanism(numbers));
            assert_eq!((report.lost, report.singular), (0, 0), "{name} {k}");
            let (mut found, real) = family.solutions(&report);
            if name == "delta" {
                return translating(&report, found, real);
            }
            assert_eq!(
                (report.complex, report.real),
                (found.len(), real),
                "{name} {k}"
            );
            let rest = found.split_off(real);
            (found, rest)
        };
        let (found, others) = lists(numbers);
        assert_eq!(
            disagreement(&found, &real, DIGITS),
            None,
            "{name} {k}: real"
        );
        assert_eq!(
            disagreement(&others, &rest, DIGITS),
            None,
            "{name} {k}: complex"
        );
        if k == 0 {
            let mut wrong = numbers.clone();
            let first = wrong.iter().next().unwrap().0.clone();
            wrong[&first] = (wrong[&first].as_f64().unwrap() * 1.0001).into();
            let (found, others) = lists(&wrong);
            assert!(
                disagreement(&found, &real, DIGITS).is_some()
                    || disagreement(&others, &rest, DIGITS).is_some(),
                "{name}: {first} says nothing"
            );
        }
    }
}

/// Those solutions of six free rods at which the hand is parallel to the base.
fn translating(
    report: &AssembliesReport,
    found: Vec<Vec<Complex64>>,
    real: usize,
) -> (Vec<Vec<Complex64>>, Vec<Vec<Complex64>>) {
    let turned = |w: Complex64| (w * w - 1.0).norm() > 1e-9;
    let hands = report
        .assemblies
        .iter()
        .map(|a| a.platforms.get("hand").unwrap());
    let quaternions = hands.map(|hand| Complex64::new(hand.quaternion[0], 0.0));
    let complex = report
        .complex_assemblies
        .iter()
        .map(|a| a.platforms.get("hand").unwrap()[3]);
    let quaternions = quaternions.chain(complex.map(|z| Complex64::new(z[0], z[1])));
    let (mut plain, mut rest) = (Vec::new(), Vec::new());
    for (k, (solution, w)) in found.into_iter().zip(quaternions).enumerate() {
        match (turned(w), k < real) {
            (true, _) => {}
            (false, true) => plain.push(solution),
            (false, false) => rest.push(solution),
        }
    }
    (plain, rest)
}

#[test]
fn planar_linkages_of_one_loop() {
    for (name, least) in [("four_bar", 5), ("slider_crank", 3), ("five_bar", 3)] {
        agrees(name, least);
    }
}

#[test]
fn six_bars() {
    agrees("watt", 3);
    agrees("stephenson", 3);
}

#[test]
fn spatial_loops_of_four_links() {
    agrees("spherical_four_bar", 3);
    agrees("rssr", 3);
}

#[test]
fn planar_3rpr() {
    agrees("planar_3rpr", 4);
}

#[test]
fn three_rps() {
    agrees("three_rps", 3);
}

#[test]
fn three_fingered_hands() {
    agrees("hand", 3);
}

#[test]
fn six_revolute_joints() {
    agrees("six_r", 3);
}

#[test]
fn six_three_platforms() {
    agrees("six_three", 3);
}

#[test]
fn stewart_gough_platforms() {
    agrees("stewart_gough", 2);
}

#[test]
fn deltas_with_a_translating_hand() {
    agrees("delta", 2);
}

#[test]
fn deltas_of_six_free_rods() {
    agrees("delta_of_rods", 1);
}

/// The comparison itself tells one digit.
#[test]
fn lists_that_differ_in_one_number_disagree() {
    let list = |x: f64| {
        vec![
            vec![Complex64::from_polar(1.0, TAU * x)],
            vec![Complex64::i()],
        ]
    };
    assert_eq!(disagreement(&list(0.1), &list(0.1), 1e-9), None);
    assert!(disagreement(&list(0.1), &list(0.1 + 1e-8), 1e-9).is_some());
    assert!(disagreement(&list(0.1)[..1], &list(0.1), 1e-9).is_some());
}
