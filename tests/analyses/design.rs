//! Designs: verdicts known by construction, exact synthesis by theory, benchmarks of the literature.

use linkwork::analysis::design::{Defect, DesignReport, Moves};
use linkwork::ask::{Design, DesignError};
use linkwork::description::{Description, DesignDescription};
use linkwork::solve::Watch;

/// A four-bar with a point beside its coupler, driven by its crank or by its rocker.
fn four_bar([l0, l1, l2, l3]: [f64; 4], [u, v]: [f64; 2], rocker: bool) -> Description {
    let (crank, other) = match rocker {
        false => ("Actuated", "Passive"),
        true => ("Passive", "Actuated"),
    };
    let text = format!(
        r#"Mechanism(version: 1, name: "four-bar", convention: Modified,
        parameters: {{ "l0": {l0:?}, "l1": {l1:?}, "l2": {l2:?}, "l3": {l3:?}, "u": {u:?}, "v": {v:?} }},
        joints: {{ "theta1": {crank}(home: "60 deg"), "phi2": Passive(home: "-12 deg"), "phi1": {other}(home: "129 deg") }},
        chains: {{
            "left": Chain(rows: [(theta: "theta1"), (a: "l1", theta: "phi2")], tip: [Tx("l2")]),
            "right": Chain(base: [Tx("l0")], rows: [(theta: "phi1")], tip: [Tx("l3")]),
            "point": Chain(on: "left.2", base: [Tx("u"), Ty("v")]),
        }},
        closures: {{ "pin": Revolute("left", "right") }})"#
    );
    Description::read(&text).unwrap()
}

fn asked(mechanism: Description, text: &str) -> Result<DesignReport, DesignError> {
    let text = format!("Design(version: 1, mechanism: \"four_bar.ron\", {text})");
    let asked = DesignDescription::read(&text).unwrap();
    let design = Design {
        mechanism,
        asked,
        ..Design::default()
    };
    design.report(&Watch::none())
}

/// A case of [`DEFECTS`].
struct Case {
    links: [f64; 4],
    poses: [[f64; 3]; 4],
    circuit: bool,
    order: Option<bool>,
    /// Branch defect if the crank drives, and if the rocker does.
    branch: [bool; 2],
}

/// Four poses (x, y, coupler angle) of the point (0.12, 0.07) on the coupler, made from crank angles and assemblies, with the
/// verdicts by the definitions of Chase and Mirth 1993: those of a circuit from the assemblies, of order and branch from the
/// whole curve.
const DEFECTS: [Case; 8] = [
    Case {
        links: [0.38, 0.1, 0.3, 0.2],
        poses: [
            [0.156741507972118, 0.158136049792898, 0.573890003798649],
            [0.125386848018859, 0.198780168503463, 0.32673432047042],
            [0.0535799905851309, 0.179183237882752, 0.201309500220638],
            [0.00515100808949524, 0.109887536443025, 0.200749890837924],
        ],
        circuit: false,
        order: Some(true),
        branch: [false, true],
    },
    Case {
        links: [0.38, 0.1, 0.3, 0.2],
        poses: [
            [0.156741507972118, 0.158136049792898, 0.573890003798649],
            [0.0535799905851309, 0.179183237882752, 0.201309500220638],
            [0.125386848018859, 0.198780168503463, 0.32673432047042],
            [0.00515100808949524, 0.109887536443025, 0.200749890837924],
        ],
        circuit: false,
        order: Some(false),
        branch: [false, true],
    },
    Case {
        links: [0.38, 0.1, 0.3, 0.2],
        poses: [
            [0.156741507972118, 0.158136049792898, 0.573890003798649],
            [0.125386848018859, 0.198780168503463, 0.32673432047042],
            [0.0885771803286154, 0.0767859680555603, -0.59879461674437],
            [0.00515100808949524, 0.109887536443025, 0.200749890837924],
        ],
        circuit: true,
        order: None,
        branch: [true, true],
    },
    Case {
        links: [0.38, 0.1, 0.3, 0.2],
        poses: [
            [0.0996688986528761, 0.0727177022920921, 0.875928005211236],
            [0.153272359270045, 0.145027977394627, 0.637308730974766],
            [0.137100343930838, 0.194831603421278, 0.365074444300571],
            [0.0677736817364837, 0.188314147532083, 0.218474139771301],
        ],
        circuit: false,
        order: Some(true),
        branch: [false, true],
    },
    Case {
        links: [0.25, 0.22, 0.17, 0.19],
        poses: [
            [0.281643802015564, 0.221117757412455, 0.22423654796741],
            [0.244463798206841, 0.25308700790693, 0.0241183083766476],
            [0.185660028492376, 0.264764596036593, -0.142401982362802],
            [0.11859869559869, 0.237012532947668, -0.399233335557034],
        ],
        circuit: false,
        order: Some(true),
        branch: [false, false],
    },
    Case {
        links: [0.25, 0.22, 0.17, 0.19],
        poses: [
            [0.231178651135428, 0.258464785979719, -0.0170890142290777],
            [0.152497870144866, 0.258211724546973, -0.24315508383518],
            [0.114130684993834, 0.140790235811245, -1.13478035381924],
            [0.143263286392748, 0.0556421066030832, -1.85708753689723],
        ],
        circuit: false,
        order: Some(true),
        branch: [true, false],
    },
    Case {
        links: [0.1, 0.25, 0.22, 0.28],
        poses: [
            [0.356505299750716, -0.0410460424803535, -1.18154123018875],
            [0.0684339261271532, 0.328606300231628, 0.106903271094896],
            [-0.247917390039406, 0.095501803795635, 1.05507028434142],
            [-0.0955090030005857, -0.245231070355128, 2.60652968822956],
        ],
        circuit: false,
        order: Some(true),
        branch: [false, false],
    },
    Case {
        links: [0.1, 0.25, 0.22, 0.28],
        poses: [
            [0.356505299750716, -0.0410460424803535, -1.18154123018875],
            [-0.0565518212738328, 0.107900288717894, -2.19359454809497],
            [-0.112592580328548, -0.0814717274816468, -0.805582189092896],
            [0.157177819658162, -0.166468956471881, 0.083223162099567],
        ],
        circuit: true,
        order: None,
        branch: [true, true],
    },
];

#[test]
fn defects_are_named_and_nothing_else_is() {
    for case in &DEFECTS {
        for (rocker, branch) in [false, true].into_iter().zip(case.branch) {
            let positions = case.poses.map(|[x, y, yaw]| {
                format!("{{ \"point\": ({x:?}, {y:?}), \"point.yaw\": {yaw:?} }}")
            });
            let mechanism = four_bar(case.links, [0.12, 0.07], rocker);
            let text = format!("positions: [{}]", positions.join(", "));
            let report = asked(mechanism, &text).unwrap();
            let [design] = &report.designs[..] else {
                panic!("{report:?}");
            };
            assert!(design.sum_of_squares < 1e-20);
            let has = |of: fn(&Defect) -> bool| design.defects.iter().any(of);
            let circuit = has(|of| matches!(of, Defect::Circuit { .. }));
            assert_eq!(circuit, case.circuit, "{:?}", case.links);
            let order = has(|of| matches!(of, Defect::Order { .. }));
            assert_eq!(order, case.order == Some(false), "{:?}", design.defects);
            // a position on another circuit is reached by no driver
            let found = circuit || has(|of| matches!(of, Defect::Branch { .. }));
            assert_eq!(
                found, branch,
                "{:?} {rocker}: {:?}",
                case.links, design.defects
            );
            let known = circuit || order || found;
            assert_eq!(design.defects.is_empty(), !known);
            let crank = case.links == [0.38, 0.1, 0.3, 0.2];
            if crank {
                let moves = if rocker { Moves::Rocks } else { Moves::Turns };
                assert_eq!(design.driver, moves);
            }
        }
    }
}

/// Freudenstein's equations K₁ cos ψ − K₂ cos φ + K₃ = cos(φ − ψ) are linear: three precision points have one linkage. Angles by
/// Chebyshev's spacing for y = log₁₀ x, 1 to 2, φ 45° to 105°, ψ 135° to 225°; lengths from K in 40 digits.
#[test]
fn three_precision_points_have_freudensteins_linkage() {
    let report = asked(
        four_bar([1.0, 0.5, 0.9, 0.8], [0.0, 0.0], false),
        r#"vary: { "l1": (-20, 20), "l2": (0, 20), "l3": (-20, 20) }, positions: [
            { "theta1": 0.855547097937193, "phi1": 2.50313149378569 },
            { "theta1": 1.30899693899575, "phi1": 3.27505143763789 },
            { "theta1": 1.7624467800543, "phi1": 3.84978793301345 },
        ], motion: { "theta1": ("45 deg", "105 deg") }"#,
    );
    let report = report.unwrap();
    let exact = report.exact.as_ref().expect("as many targets as unknowns");
    // the coupler's length enters by its square
    assert_eq!((exact.generic, exact.classes, exact.real), (2, 1, 1));
    let [design] = &report.designs[..] else {
        panic!("{report:?}");
    };
    let expected = [1.85086061889954, 2.86800754089801, -1.92051113145365];
    for (value, expected) in design.values.iter().zip(expected) {
        assert!((value - expected).abs() < 1e-9, "{:?}", design.values);
    }
    assert!(design.defects.is_empty(), "{:?}", design.defects);
}

#[test]
fn wrong_questions_are_refused_where_they_are_wrong() {
    let wrong = |text: &str| {
        let mechanism = four_bar([1.0, 0.5, 0.9, 0.8], [0.0, 0.0], false);
        asked(mechanism, text).unwrap_err().to_string()
    };
    let positions = r#"positions: [{ "point": (0.1, 0.2) }, { "point": (0.3, 0.2) }]"#;
    let cases = [
        (r#"vary: { "l1": (1, 2) }"#.to_owned(), "no positions"),
        (format!(r#"vary: {{ "l1": (2, 1) }}, {positions}"#), "reversed"),
        (format!(r#"vary: {{ "l9": (1, 2) }}, {positions}"#), "nothing uses `l9`"),
        (format!(r#"vary: {{ "phi1": (1, 2) }}, {positions}"#), "`phi1` is a joint"),
        (
            r#"positions: [{ "point": (0.1, 0.2) }, { "point": (0.1, 0.2) }]"#.to_owned(),
            "positions 1 and 2 are the same",
        ),
        (r#"positions: [{ "transmission": 1 }]"#.to_owned(), "a rate, a force or a figure"),
        (
            r#"vary: { "l2": (0.01, 0.02), "l3": (0.01, 0.02), "l1": (0.01, 0.02) },
            positions: [{ "theta1": 0, "phi1": 1 }, { "theta1": 1, "phi1": 2 }, { "theta1": 2, "phi1": 3 },
                { "theta1": 3, "phi1": 4 }]"#
                .to_owned(),
            "can be assembled in all positions",
        ),
    ];
    for (text, expected) in cases {
        let said = wrong(&text);
        assert!(said.contains(expected), "{text}: {said}");
    }
}
