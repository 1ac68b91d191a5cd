//! Spatial synthesis by theory, and designs that are the best of their kind.

use linkwork::analysis::design::{Defect, DesignReport};
use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::{Design, DesignError, Question};
use linkwork::description::{Description, DesignDescription};
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

fn designed(mechanism: &str, asked: &str) -> Result<DesignReport, DesignError> {
    let asked = format!("Design(version: 1, mechanism: \"mechanism.ron\", {asked})");
    let design = Design {
        mechanism: Description::read(mechanism).unwrap(),
        asked: DesignDescription::read(&asked).unwrap(),
        ..Design::default()
    };
    design.report(&Watch::none())
}

type Matrix = [[f64; 3]; 3];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let of = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| of(i, j)))
}

fn times(a: &Matrix, x: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| a[i][k] * x[k]).sum())
}

/// Rodrigues' formula.
fn rotation(vector: [f64; 3]) -> Matrix {
    let angle = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = vector.map(|x| if angle > 0.0 { x / angle } else { 0.0 });
    let k = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let square = product(&k, &k);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let one = f64::from(u8::from(i == j));
            one + angle.sin() * k[i][j] + (1.0 - angle.cos()) * square[i][j]
        })
    })
}

/// A moving axis, a fixed axis and the arc between them, axes up to their sign.
type Dyad = ([f64; 3], [f64; 3], f64);

/// Five orientations as rotation vectors, and the real spherical dyads that carry a body through them: of six complex ones
/// (McCarthy 2000), computed from the minors of the axis conditions and their resultant, to 15 digits.
const DYADS: [([[f64; 3]; 5], &[Dyad]); 3] = [
    (
        [
            [0.0, 0.0, 0.0],
            [0.886, 0.023, 0.952],
            [-0.838, 0.215, -0.247],
            [0.604, -0.651, 0.743],
            [0.088, 0.804, -0.046],
        ],
        &[
            (
                [0.2700157916534, -0.646341530708735, 0.71367646587153],
                [0.70268392264507, -0.320388282842176, 0.635284702376485],
                0.554424130273383,
            ),
            (
                [0.764862444201084, 0.419124219918319, 0.489203771171691],
                [0.314265286440904, -0.938292946708308, 0.144373390538762],
                1.48843968231371,
            ),
        ],
    ),
    (
        [
            [0.0, 0.0, 0.0],
            [-0.001, 0.912, 0.806],
            [-0.21, -0.385, 0.614],
            [-0.785, -0.216, 0.753],
            [0.835, -0.533, -0.843],
        ],
        &[],
    ),
    (
        [
            [0.0, 0.0, 0.0],
            [0.666, -0.292, 0.268],
            [0.542, -0.876, 0.579],
            [-0.83, 0.88, -0.517],
            [0.926, -0.536, 0.071],
        ],
        &[],
    ),
];

/// The angle of two axes but for their signs.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let sign = dot.signum();
    let squares = a.iter().zip(b).map(|(a, b)| (a - sign * b).powi(2));
    squares.sum::<f64>().sqrt()
}

#[test]
fn five_orientations_have_six_spherical_dyads() {
    let dyad = r#"Mechanism(version: 1, name: "dyad", convention: Modified,
        parameters: { "a": 0.3, "b": 0.7, "arc": 0.9, "c": 0.5, "d": 0.2 },
        joints: { "theta": Actuated(home: 1.0), "phi": Passive(home: -0.7) },
        chains: { "arm": Chain(base: [Rz("a"), Rx("b")], rows: [(theta: "theta"), (alpha: "arc", theta: "phi")],
            tip: [Rx("c"), Rz("d")]) },
        closures: {})"#;
    for (orientations, known) in DYADS {
        let turn = r#"("-180 deg", "180 deg")"#;
        let positions = orientations.map(|vector| {
            let r = rotation(vector);
            let (roll, pitch) = (r[2][1].atan2(r[2][2]), -r[2][0].asin());
            let yaw = r[1][0].atan2(r[0][0]);
            format!(r#"{{ "arm.roll": {roll:?}, "arm.pitch": {pitch:?}, "arm.yaw": {yaw:?} }}"#)
        });
        let asked = format!(
            r#"vary: {{ "a": {turn}, "b": {turn}, "arc": {turn}, "c": {turn}, "d": {turn} }}, positions: [{}]"#,
            positions.join(", ")
        );
        let report = designed(dyad, &asked).unwrap();
        let exact = report.exact.unwrap();
        assert_eq!((exact.classes, exact.real), (6, known.len()));
        let mut found: Vec<Dyad> = (report.designs.iter())
            .map(|design| {
                let [a, b, arc, c, d] = design.values[..] else {
                    panic!("five numbers")
                };
                let (x, z) = (|t| rotation([t, 0.0, 0.0]), |t| rotation([0.0, 0.0, t]));
                let fixed = times(&product(&z(a), &x(b)), [0.0, 0.0, 1.0]);
                // the second axis in the body, which stands as ground in the first pose
                let tip = product(&x(c), &z(d));
                let moving = std::array::from_fn(|k| tip[2][k]);
                let arc = arc.rem_euclid(std::f64::consts::PI);
                (moving, fixed, arc.min(std::f64::consts::PI - arc))
            })
            .collect();
        for (moving, fixed, arc) in known {
            let place = found.iter().position(|of| {
                apart(of.0, *moving) < 1e-8
                    && apart(of.1, *fixed) < 1e-8
                    && (of.2 - arc).abs() < 1e-8
            });
            found.remove(place.expect("the dyad is found"));
        }
        assert!(found.is_empty());
    }
}

/// A function generator with axes 1 m apart: pairs of angles, then crank, arm, rod and offsets, of which only one linkage has them
/// (Denavit and Hartenberg 1960, from linear equations in 40 digits), and if it is assembled all the way.
struct Rssr {
    angle: f64,
    crank: &'static [f64],
    arm: &'static [f64],
    numbers: [f64; 5],
    assembles: bool,
}

const RSSR: [Rssr; 4] = [
    Rssr {
        angle: 90.0,
        crank: &[0.628822177407915, 1.30899693899575, 1.98917170058358],
        arm: &[1.75081152084928, 2.05076187109334, 2.80886114998591],
        numbers: [
            -0.299163834843152,
            -0.597918795258123,
            1.48215905290858,
            0.0,
            0.0,
        ],
        assembles: false,
    },
    Rssr {
        angle: 60.0,
        crank: &[0.779972124427434, 1.30899693899575, 1.83802175356406],
        arm: &[2.19235310478876, 2.70696640069023, 3.09012406427393],
        numbers: [
            1.36454608578465,
            1.35083849511743,
            1.28282917080891,
            0.0,
            0.0,
        ],
        assembles: true,
    },
    Rssr {
        angle: 90.0,
        crank: &[
            0.562038897810358,
            0.847351481373133,
            1.30899693899575,
            1.77064239661836,
            2.05595498018114,
        ],
        arm: &[
            1.7460609050202,
            1.7972286675229,
            2.05076187109334,
            2.51534382382474,
            2.90799563575303,
        ],
        numbers: [
            -0.475322509457098,
            -0.420099174813457,
            1.7951821544866,
            -0.972277692173509,
            -0.603233559478654,
        ],
        assembles: true,
    },
    Rssr {
        angle: 70.0,
        crank: &[
            0.911104748209224,
            1.196417331772,
            1.65806278939461,
            2.11970824701723,
            2.40502083058,
        ],
        arm: &[
            1.96010666616852,
            2.25300350928559,
            2.66034266688682,
            2.91265599470283,
            2.96628613159241,
        ],
        numbers: [
            2.47405688251572,
            3.74488660482108,
            2.39683304569848,
            1.99584232264913,
            -2.22349541316558,
        ],
        assembles: true,
    },
];

#[test]
fn pairs_of_angles_have_one_spatial_four_bar_with_ball_joints() {
    for case in RSSR {
        let mechanism = format!(
            r#"Mechanism(version: 1, name: "RSSR", convention: Modified,
            parameters: {{ "a": 0.5, "b": 0.6, "rod": 1.5, "s1": 0, "s2": 0, "angle": "{} deg" }},
            joints: {{ "theta": Actuated(home: 1), "phi": Passive(home: 2) }},
            chains: {{
                "crank": Chain(rows: [(theta: "theta")], tip: [Tx("a"), Tz("s1")]),
                "arm": Chain(base: [Tx(1), Rx("angle")], rows: [(theta: "phi")], tip: [Tx("b"), Tz("s2")]),
            }},
            closures: {{ "rod": Distance("crank", "arm", "rod") }})"#,
            case.angle
        );
        let count = case.crank.len();
        let vary = match count {
            3 => r#""a": (-9, 9), "b": (-9, 9), "rod": (0, 9)"#,
            _ => r#""a": (-9, 9), "b": (-9, 9), "rod": (0, 9), "s1": (-9, 9), "s2": (-9, 9)"#,
        };
        let pairs = case.crank.iter().zip(case.arm);
        let positions: Vec<String> = pairs
            .map(|(crank, arm)| format!(r#"{{ "theta": {crank:?}, "phi": {arm:?} }}"#))
            .collect();
        // Chebyshev's spacing within the range of the function
        let ends = [case.crank[0], case.crank[count - 1]];
        let middle = 0.5 * (ends[0] + ends[1]);
        let half = 0.5 * (ends[1] - ends[0]) / (std::f64::consts::FRAC_PI_2 / count as f64).cos();
        let asked = format!(
            r#"vary: {{ {vary} }}, positions: [{}], motion: {{ "theta": ({:?}, {:?}) }}"#,
            positions.join(", "),
            middle - half,
            middle + half
        );
        let report = designed(&mechanism, &asked).unwrap();
        let exact = report.exact.unwrap();
        assert_eq!((exact.classes, exact.real), (1, 1));
        let [design] = &report.designs[..] else {
            panic!("one design")
        };
        for (value, known) in design.values.iter().zip(case.numbers) {
            assert!((value - known).abs() < 1e-9, "{:?}", design.values);
        }
        let stops =
            |defect: &Defect| matches!(defect, Defect::Motion { .. } | Defect::Circuit { .. });
        assert_eq!(
            case.assembles,
            design.defects.is_empty(),
            "{:?}",
            design.defects
        );
        assert_eq!(case.assembles, !design.defects.iter().any(stops));
    }
}

/// Salisbury and Craig 1982: an arm whose links are as 1 to 1/√2 is isotropic at an elbow of 135°.
#[test]
fn an_isotropic_arm_is_found() {
    let arm = r#"Mechanism(version: 1, name: "arm", convention: Modified, parameters: { "l1": 1.0, "l2": 0.8 },
        joints: { "theta1": Actuated(home: 1), "theta2": Actuated(home: 0.7) },
        chains: { "arm": Chain(rows: [(theta: "theta1"), (a: "l1", theta: "theta2")], tip: [Tx("l2")]) },
        closures: {})"#;
    let asked = |goal: &str| {
        format!(
            r#"vary: {{ "l2": (0.1, 3), "elbow": ("1 deg", "179 deg") }},
            positions: [{{ "theta1": 0, "theta2": "elbow" }}], outputs: ["arm.x", "arm.y"], {goal}"#
        )
    };
    let report = designed(arm, &asked(r#"minimise: "max(condition)""#)).unwrap();
    let best = &report.designs[0];
    assert!((best.goal.unwrap() - 1.0).abs() < 1e-6);
    assert!(
        (best.values[0] - 0.5f64.sqrt()).abs() < 1e-6,
        "{:?}",
        best.values
    );
    assert!((best.values[1].to_degrees() - 135.0).abs() < 1e-4);
    // a quantity alone is no figure of a motion
    let error = designed(arm, &asked(r#"minimise: "condition""#)).unwrap_err();
    assert!(error.to_string().contains("no figure"), "{error}");
}

/// A planar 3-RRR, its hinges on circles of radius R = 0.6 m on the base and r on the platform, at its centre and not turned. After
/// Gosselin and Angeles 1988 the rows of the Jacobian from the platform to the cranks are (u, h/L)/β, with u along the outer link,
/// h = b × u for the hinge b, L the normalising length; in all legs |h| and |β| are the same. The squares of the singular values of the
/// rows (u, h/L) add up to 3 + 3 h²/L², and the least is no greater than that of the last column, 3 h²/L²: the largest is 3/2 at least
/// and the condition number L/(√2 |h|), which three equal legs with |h| ≤ L/√2 have. It is 1 for |h| = L/√2. As |h| ≤ r, a platform with
/// r < L/√2 is best with the largest r and outer links square to b, where l1² = (R − r)² + l2².
#[test]
fn the_best_3_rrr_is_found() {
    let [mut joints, mut legs, mut frames, mut pins] = <[String; 4]>::default();
    for (i, turn) in [0, 120, 240].into_iter().enumerate() {
        joints += &format!(
            r#""theta{i}": Actuated(home: "{} deg"), "psi{i}": Passive(home: "100 deg"), "#,
            60 + turn
        );
        legs += &format!(
            r#""leg{i}": Chain(base: [Rz("{turn} deg"), Tx("R"), Rz("-{turn} deg")],
                rows: [(theta: "theta{i}"), (a: "l1", theta: "psi{i}")], tip: [Tx("l2")]), "#
        );
        frames += &format!(r#""B{i}": [Rz("{turn} deg"), Tx("r")], "#);
        pins += &format!(r#""B{i}": Revolute("leg{i}", "top.B{i}"), "#);
    }
    let mechanism = format!(
        r#"Mechanism(version: 1, name: "3-RRR", convention: Modified, parameters: {{ "R": 0.6, "r": 0.2, "l1": 0.5, "l2": 0.3 }},
            joints: {{ {joints} }}, chains: {{ {legs} }}, platforms: {{ "top": Platform(home: [], frames: {{ {frames} }}) }},
            closures: {{ {pins} }})"#
    );
    let designed = |largest: f64, goal: &str| {
        let asked = format!(
            r#"Design(version: 1, mechanism: "3_rrr.ron", vary: {{ "l1": (0.1, 0.6), "r": (0.05, {largest}) }},
                positions: [{{ "top.x": 0, "top.y": 0, "top.yaw": 0 }}], {goal})"#
        );
        let design = Design {
            mechanism: Description::read(&mechanism).unwrap(),
            asked: DesignDescription::read(&asked).unwrap(),
            starts: 6,
            ..Design::default()
        };
        design.report(&Watch::none()).unwrap()
    };
    let ([base, outer], least) = ([0.6f64, 0.3f64], r#"minimise: "max(condition)""#);
    let length = |file: &str| {
        let found = Mechanism::new(&Description::read(file).unwrap()).unwrap();
        found.characteristic_length()
    };

    // the pose is met by moving the legs: both numbers are open, and no target is too many
    let report = designed(0.2, least);
    assert_eq!((report.undetermined, report.surplus), (2, 0));
    let best = &report.designs[0];
    assert!(best.defects.is_empty(), "{:?}", best.defects);
    let known = length(&best.file) / (2f64.sqrt() * 0.2);
    assert!(
        (best.goal.unwrap() - known).abs() < 1e-6 * known,
        "{best:?}"
    );
    let crank = (base - 0.2).hypot(outer);
    assert!((best.values[0] - crank).abs() < 1e-4, "{:?}", best.values);
    assert!((best.values[1] - 0.2).abs() < 1e-6, "{:?}", best.values);
    // nothing is better
    let bound = format!(r#"at_most: {{ "condition": {} }}"#, 0.99 * known);
    let report = designed(0.2, &bound);
    let defects = &report.designs[0].defects;
    assert!(
        matches!(defects[..], [Defect::Condition { .. }]),
        "{defects:?}"
    );

    // a larger platform is isotropic where the outer link has the lever arm L/√2 about the centre: it ends on the circle about A
    let report = designed(0.6, least);
    let best = &report.designs[0];
    assert!((best.goal.unwrap() - 1.0).abs() < 1e-5, "{best:?}");
    let ([crank, radius], arm) = (
        [best.values[0], best.values[1]],
        length(&best.file) / 2f64.sqrt(),
    );
    let along = outer * (1.0 - (arm / radius).powi(2)).sqrt();
    let ends = [along, -along].map(|along| (radius - base + along).hypot(outer * arm / radius));
    assert!(
        ends.iter().any(|end| (end - crank).abs() < 1e-4),
        "{ends:?} {crank}"
    );
}

/// A plotter for a sheet of A4: of all five-bars with motors 0.2 m apart, cranks to 0.4 m and rods to 0.5 m the greatest condition number
/// at 3 by 3 places of the sheet is 1.262779 at least, with r = 0.295 m, c = 0.5 m and the sheet 0.365 m away (closed-form inverse
/// kinematics in all four working modes, Nelder and Mead's method from 60 starts each in double precision).
#[test]
fn a_five_bar_for_a_sheet_of_a4_is_the_best_that_is_known() {
    let mechanism = std::fs::read_to_string("mechanisms/five_bar.ron").unwrap();
    let best = |[r, c, h]: [&str; 3], goal: &str| {
        let asked = format!(
            r#"vary: {{ "r": {r}, "c": {c}, "h": {h} }}, outputs: ["left.x", "left.y"],
            contains: {{ "left.x - g/2": ("-148.5 mm", "148.5 mm"), "left.y": ("h", "h + 210 mm") }}, {goal}"#
        );
        designed(&mechanism, &asked).unwrap().designs[0].clone()
    };
    let design = best(
        ["(0.1, 0.4)", "(0.1, 0.5)", "(0.05, 0.5)"],
        r#"minimise: "max(condition)""#,
    );
    assert!(design.defects.is_empty(), "{:?}", design.defects);
    // between the places it may be greater
    let goal = design.goal.unwrap();
    assert!(
        (1.262778..1.2645).contains(&goal),
        "{goal} {:?}",
        design.values
    );
    // nothing near it is better
    let design = best(
        ["(0.295, 0.295)", "(0.5, 0.5)", "(0.36, 0.37)"],
        r#"at_most: { "condition": 1.2 }"#,
    );
    assert!(matches!(design.defects[..], [Defect::Condition { .. }]));
}

/// A platform on six legs of 0.7 m to 1.3 m over a box of 0.3 m in each direction, level: hinges 10° beside three directions on the base
/// and half way between on the platform. At places all over the box legs have lengths within their limits, and the determinant of
/// the rows (u, b × u) of their directions has one sign.
#[test]
fn a_platform_on_six_legs_reaches_a_box() {
    let (mut points, mut frames, mut joints, mut closures) = <[String; 4]>::default().into();
    let angles: [[f64; 2]; 6] = std::array::from_fn(|i| {
        let (third, side) = ((i / 2) as f64, if i % 2 == 0 { -1.0 } else { 1.0 });
        [120.0 * third + 10.0 * side, 120.0 * third + 50.0 * side]
    });
    for (i, [base, top]) in angles.iter().enumerate() {
        points += &format!(r#""A{i}": Chain(base: [Rz("{base} deg"), Tx("rb")]), "#);
        frames += &format!(r#""B{i}": [Rz("{top} deg"), Tx("rp")], "#);
        joints += &format!(r#""l{i}": Actuated(home: 1, limits: (0.7, 1.3)), "#);
        closures += &format!(r#""l{i}": Distance("A{i}", "top.B{i}", "l{i}"), "#);
    }
    let mechanism = format!(
        r#"Mechanism(version: 1, name: "platform", convention: Modified, parameters: {{ "rb": 0.5, "rp": 0.3 }}, joints: {{ {joints} }},
            chains: {{ {points} }}, platforms: {{ "top": Platform(home: [Tz(0.9)], frames: {{ {frames} }}) }},
            closures: {{ {closures} }})"#
    );
    let asked = r#"vary: { "rb": (0.2, 0.8), "rp": (0.1, 0.6), "z": (0.4, 1.2) }, contains: {
        "top.x": (-0.15, 0.15), "top.y": (-0.15, 0.15), "top.z": ("z", "z + 0.3 m"), "top.roll": (0, 0), "top.pitch": (0, 0),
        "top.yaw": (0, 0) }"#;
    let report = designed(&mechanism, asked).unwrap();
    assert_eq!(report.positions, 27);
    let best = &report.designs[0];
    assert!(best.defects.is_empty(), "{:?}", best.defects);
    let [rb, rp, z] = best.values[..] else {
        panic!("three numbers")
    };
    let mut signs = Vec::new();
    for node in 0..9 * 9 * 9 {
        let of = |k: i32| f64::from(node / 9i32.pow(k as u32) % 9) / 8.0;
        let at = [0.3 * of(0) - 0.15, 0.3 * of(1) - 0.15, z + 0.3 * of(2)];
        let rows = angles.map(|[base, top]| {
            let on = |r: f64, angle: f64| {
                [
                    r * angle.to_radians().cos(),
                    r * angle.to_radians().sin(),
                    0.0,
                ]
            };
            let (a, b) = (on(rb, base), on(rp, top));
            let leg: [f64; 3] = std::array::from_fn(|k| at[k] + b[k] - a[k]);
            let length = leg.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((0.7 - 1e-9..1.3 + 1e-9).contains(&length), "{length}");
            let u = leg.map(|x| x / length);
            [
                u[0],
                u[1],
                u[2],
                b[1] * u[2],
                -b[0] * u[2],
                b[0] * u[1] - b[1] * u[0],
            ]
        });
        signs.push(
            nalgebra::Matrix6::from_fn(|i, j| rows[i][j])
                .determinant()
                .signum(),
        );
    }
    assert!(signs.iter().all(|sign| *sign == signs[0]));
    // a box beyond the legs has none: each leg is named once
    let asked = asked.replace("(0.4, 1.2)", "(1.9, 2)");
    let asked = format!("Design(version: 1, mechanism: \"mechanism.ron\", {asked})");
    let design = Design {
        mechanism: Description::read(&mechanism).unwrap(),
        asked: DesignDescription::read(&asked).unwrap(),
        starts: 4,
        ..Design::default()
    };
    for design in design.report(&Watch::none()).unwrap().designs {
        let [Defect::Limit { joints, positions }] = &design.defects[..] else {
            panic!("{:?}", design.defects)
        };
        assert_eq!((joints.len(), positions.len()), (6, 27));
    }
}

/// A crank from 90° to 270°: figures of its angle θ by hand, straightness of Hoeken's point beside that of its motion.
#[test]
fn figures_of_a_motion_are_those_of_calculus() {
    let mechanism = std::fs::read_to_string("mechanisms/hoeken.ron").unwrap();
    let asked = r#"positions: [{ "theta1": "120 deg" }], motion: { "theta1": ("90 deg", "270 deg") }, at_least: {
        "mean(crank*cos(theta1))": 0.9, "rms(crank*sin(theta1))": 0.9, "stroke(theta1)": 9, "dwell(theta1, 9 deg)": 0.9,
        "straightness(left.2+5,0)": 9 }"#;
    let report = designed(&mechanism, asked).unwrap();
    let defects = report.designs[0].defects.iter();
    let worst: Vec<f64> = defects
        .map(|of| match of {
            Defect::Condition { worst, .. } => worst.unwrap(),
            other => panic!("{other:?}"),
        })
        .collect();
    let pi = std::f64::consts::PI;
    // mean and root of the mean square over half a turn; of 180° 18° are within 9° of one value
    let known = [-2.0 / pi, 0.5f64.sqrt(), pi, 0.1];
    for (found, known) in worst.iter().zip(known) {
        assert!((found - known).abs() < 1e-9, "{worst:?}");
    }
    let settings = SweepSettings {
        straightness: true,
        ..SweepSettings::default()
    };
    let mechanism = Mechanism::new(&Description::read(&mechanism).unwrap()).unwrap();
    let question = Question::new(mechanism).point("left.2+5,0");
    let question = question.input("theta1", 0.5 * pi, 1.5 * pi);
    let motions = question.motions(&settings, &Watch::none()).unwrap();
    let report = motions.report(2, &mut |_, _| {}, &Watch::none());
    let line = &report.motions[0].straightness[0];
    assert!((worst[4] - line.deviation).abs() < 1e-9);
    // a tolerance that is none is refused
    let asked = asked.replace("9 deg", "9 m");
    let error = designed(
        &std::fs::read_to_string("mechanisms/hoeken.ron").unwrap(),
        &asked,
    );
    assert!(error.unwrap_err().to_string().contains("no figure"));
}

/// Crank-rockers with equal times forth and back and a given swing: dead positions half a turn apart. With ground 1 and rocker
/// l₃ the crank is l₃ sin(ψ/2), the coupler √(1 − l₃² cos²(ψ/2)), and the least transmission angle has cos μ = sin(ψ/2)/l₂: it is
/// greatest for the shortest rocker.
#[test]
fn the_crank_rocker_with_the_best_transmission_angle_is_found() {
    let four_bar = r#"Mechanism(version: 1, name: "crank-rocker", convention: Modified,
        parameters: { "l1": 0.2, "l2": 0.9, "l3": 0.5 },
        joints: { "theta1": Actuated(home: 1), "phi2": Passive(home: -0.2), "phi1": Passive(home: 2.2) },
        chains: {
            "left": Chain(rows: [(theta: "theta1"), (a: "l1", theta: "phi2")], tip: [Tx("l2")]),
            "right": Chain(base: [Tx(1)], rows: [(theta: "phi1")], tip: [Tx("l3")]),
        },
        closures: { "pin": Revolute("left", "right") })"#;
    let (swing, shortest) = (90.0f64, 0.5);
    let asked = |more: &str| {
        format!(
            r#"vary: {{ "l1": (0.01, 1), "l2": (0.1, 3), "l3": ({shortest}, 3), "from": ("0 deg", "360 deg"),
                    "p": ("0 deg", "180 deg") }},
                positions: [
                    {{ "theta1": "from", "phi2": 0, "phi1": "p" }},
                    {{ "theta1": "from + 180 deg", "phi2": "180 deg", "phi1": "p + {swing} deg" }},
                ], {more}"#
        )
    };
    let report = designed(four_bar, &asked(r#"maximise: "min(transmission)""#)).unwrap();
    let best = &report.designs[0];
    let half = (0.5 * swing).to_radians();
    let coupler = (1.0 - (shortest * half.cos()).powi(2)).sqrt();
    let angle = (half.sin() / coupler).acos();
    assert!((best.goal.unwrap() - angle).abs() < 1e-6, "{:?}", best.goal);
    let known = [shortest * half.sin(), coupler, shortest];
    for (value, known) in best.values.iter().zip(known) {
        assert!((value - known).abs() < 1e-6, "{:?}", best.values);
    }
    // nothing is better
    let bound = angle.to_degrees() + 0.1;
    let more = format!(r#"at_least: {{ "transmission": "{bound} deg" }}"#);
    let report = designed(four_bar, &asked(&more)).unwrap();
    let defects = &report.designs[0].defects;
    assert!(
        matches!(defects[..], [Defect::Condition { .. }]),
        "{defects:?}"
    );
}

/// The shipped walking leg, whose search is long, from fewer starts; the guide runs the other shipped designs.
#[test]
fn the_shipped_walking_leg_is_found_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leg.svg");
    let svg = path.to_str().unwrap();
    let asked = [
        "design",
        "mechanisms/designs/walking_leg.ron",
        "--starts",
        "24",
        "--svg",
        svg,
    ];
    let (status, said, _) = crate::linkwork(&asked);
    assert_eq!(status, 0, "{said}");
    assert!(said.contains("without defects"));
    // seven targets are marked, one after another
    let drawn = std::fs::read_to_string(path).unwrap();
    assert!((1..=7).all(|k| drawn.contains(&format!(">{k}</text>"))));
    assert!(!drawn.contains(">8</text>"));
}
