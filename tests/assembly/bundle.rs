//! Configurations that share dimensions: calibration from measured angles, and columns of the Jacobian by dimensions.

use linkwork::description::Description;
use linkwork::mechanism::{Configuration, Mechanism, Quantity};
use linkwork::number::{Complex, Number};
use linkwork::solve::{Equations, LeastSquares, LevenbergMarquardt};
use linkwork::system::{Bundle, Bundled, Held, Target, TargetError};

/// A four-bar whose angles are read with offsets.
const FOUR_BAR: &str = r#"Mechanism(version: 1, name: "calibrated four-bar", convention: Modified,
    parameters: { "l0": 0.4, "l1": 0.1, "l2": 0.3, "l3": 0.25, "crank_offset": "0 deg", "rocker_offset": "0 deg" },
    joints: { "crank": Actuated(home: "60 deg"), "coupler": Passive(), "rocker": Passive(home: "90 deg") },
    chains: {
        "left": Chain(rows: [(theta: "crank + crank_offset"), (a: "l1", theta: "coupler")], tip: [Tx("l2")]),
        "right": Chain(base: [Tx("l0")], rows: [(theta: "rocker + rocker_offset")], tip: [Tx("l3")]),
    },
    closures: { "pin": Revolute("left", "right") })"#;

/// Crank angles, exact, and rocker angles with an uncertainty of 5e-4 rad, made by the law of cosines with lengths of
/// 0.402, 0.1013, 0.3017, 0.2489 m and offsets of 0.011 and -0.007 rad.
const READ: [(f64, f64); 40] = [
    (0.05, 1.980442433),
    (0.207692, 1.936513272),
    (0.365385, 1.907205425),
    (0.523077, 1.891371612),
    (0.680769, 1.888471789),
    (0.838462, 1.901177728),
    (0.996154, 1.926894485),
    (1.153846, 1.96275758),
    (1.311538, 2.008409225),
    (1.469231, 2.061232976),
    (1.626923, 2.121449423),
    (1.784615, 2.185284424),
    (1.942308, 2.251816561),
    (2.1, 2.320705357),
    (2.257692, 2.388630948),
    (2.415385, 2.454464344),
    (2.573077, 2.518057623),
    (2.730769, 2.575027305),
    (2.888462, 2.626446144),
    (3.046154, 2.667802335),
    (3.203846, -3.583370261),
    (3.361538, -3.561680563),
    (3.519231, -3.548678914),
    (3.676923, -3.546475438),
    (3.834615, -3.551932813),
    (3.992308, -3.564492319),
    (4.15, -3.583135671),
    (4.307692, -3.608204172),
    (4.465385, -3.638677054),
    (4.623077, -3.674458198),
    (4.780769, -3.714594868),
    (4.938462, -3.76203853),
    (5.096154, -3.813406106),
    (5.253846, -3.869879929),
    (5.411538, -3.930128106),
    (5.569231, -3.994722095),
    (5.726923, -4.062783383),
    (5.884615, -4.131215453),
    (6.042308, -4.197276356),
    (6.2, -4.25748501),
];

/// The estimates with the ground length known, by a fit of the angles in closed form that agrees with one in Freudenstein's
/// coefficients to 1e-10: l1, l2, l3, the offsets.
const ESTIMATE: [f64; 5] = [
    0.101375720617792,
    0.301862500507208,
    0.248990482159459,
    0.0113442742037266,
    -0.0077342143867026,
];

fn four_bar() -> Mechanism {
    Mechanism::new(&Description::read(FOUR_BAR).unwrap()).unwrap()
}

fn parameter(mechanism: &Mechanism, name: &str) -> usize {
    let mut all = mechanism.parameters().iter();
    all.position(|of| &*of.name == name).unwrap()
}

/// The bundle of all readings with some parameters unknown, and where it begins; the ground is 0.402 m long.
fn readings<'m>(mechanism: &'m Mechanism, names: &[&str]) -> (Bundle<'m>, Bundled) {
    let mut held = Held::nothing(mechanism);
    held.joints[mechanism.joint("crank").unwrap()] = true;
    let numbers: Vec<(usize, f64)> =
        (names.iter().map(|of| (parameter(mechanism, of), 1.0))).collect();
    let mut bundle = Bundle::new(mechanism, held, &numbers);
    let mut configurations = Vec::new();
    for (configuration, (crank, rocker)) in READ.into_iter().enumerate() {
        let quantity = Quantity::read(mechanism, "rocker", "rocker").unwrap();
        let target = Target {
            configuration,
            quantity,
            value: rocker,
            weight: 1.0 / 5e-4,
            exact: false,
        };
        bundle = bundle.target(target).unwrap();
        let (x, y) = (
            0.4 + 0.25 * rocker.cos() - 0.1 * crank.cos(),
            0.25 * rocker.sin() - 0.1 * crank.sin(),
        );
        let joints = vec![crank, y.atan2(x) - crank, rocker];
        configurations.push(Configuration {
            joints,
            platforms: vec![],
        });
    }
    let numbers = bundle.file();
    (
        bundle,
        Bundled {
            numbers,
            configurations,
        },
    )
}

#[test]
fn a_four_bar_is_calibrated_from_its_angles_to_ten_digits() {
    let known = Description::read(FOUR_BAR)
        .unwrap()
        .with_parameter("l0", "0.402")
        .unwrap();
    let mechanism = Mechanism::new(&known).unwrap();
    let names = ["l1", "l2", "l3", "crank_offset", "rocker_offset"];
    let (bundle, start) = readings(&mechanism, &names);
    for damping in [0.0, 1e-3] {
        let search = LevenbergMarquardt {
            damping,
            ..LevenbergMarquardt::default()
        };
        let found = search.solve(&bundle, start.clone());
        assert!(found.converged && found.steps < 20, "{found:?}");
        assert!(found.misfit.equations < 1e-24);
        // χ² of the same fit, for 35 degrees of freedom
        assert!(
            (found.misfit.squares - 24.846386270681).abs() < 1e-6,
            "{:?}",
            found.misfit
        );
        for (found, known) in found.point.numbers.iter().zip(ESTIMATE) {
            assert!((found - known).abs() < 1e-9, "{found} {known}");
        }
        assert_eq!(bundle.model(&found.point).unwrap().open([]).len(), 0);
    }
}

#[test]
fn angles_alone_do_not_determine_the_scale() {
    let mechanism = four_bar();
    let names = ["l0", "l1", "l2", "l3", "crank_offset", "rocker_offset"];
    let (bundle, start) = readings(&mechanism, &names);
    let found = LevenbergMarquardt::default().solve(&bundle, start);
    assert!(found.converged);
    let model = bundle.model(&found.point).unwrap();
    assert_eq!((model.open([]).len(), model.conditions()), (1, 0));
    // the lengths of least change have the ratios of those with the ground known
    let numbers = found.point.numbers;
    for (length, known) in numbers[1..4].iter().zip(ESTIMATE) {
        assert!((length / numbers[0] - known / 0.402).abs() < 1e-8);
    }
}

#[test]
fn a_rate_is_no_target() {
    let mechanism = four_bar();
    let quantity = Quantity::read(&mechanism, "rate", "velocity:rocker").unwrap();
    let target = Target {
        configuration: 0,
        quantity,
        value: 0.0,
        weight: 1.0,
        exact: false,
    };
    let refused = Bundle::new(&mechanism, Held::nothing(&mechanism), &[]).target(target);
    assert_eq!(
        refused.unwrap_err(),
        TargetError::NotOfConfiguration("rate".into())
    );
}

#[test]
fn columns_by_dimensions_are_complex_steps() {
    let mut compared = 0;
    for file in [
        "bennett",
        "four_bar",
        "three_rps",
        "sarrus",
        "delta",
        "stewart_gough_6sps",
        "three_fingered_hand",
    ] {
        let path = format!("{}/mechanisms/{file}.ron", env!("CARGO_MANIFEST_DIR"));
        let mechanism = linkwork::load(path).unwrap();
        let numbers: Vec<(usize, f64)> = (mechanism
            .independent_parameters()
            .into_iter()
            .map(|i| (i, 1.0)))
        .collect();
        let bundle = Bundle::new(&mechanism, Held::nothing(&mechanism), &numbers);
        let mut away = mechanism.home();
        away.joints.iter_mut().for_each(|joint| *joint += 0.1);
        let values = bundle.file();
        let at = Bundled {
            numbers: values.clone(),
            configurations: vec![mechanism.home(), away],
        };
        let columns = bundle.by_numbers(&at).unwrap();
        const STEP: f64 = 1e-30;
        for (at, columns) in at.configurations.iter().zip(columns) {
            for number in 0..values.len() {
                let mut values: Vec<Complex<f64>> =
                    values.iter().map(|&x| Complex::new(x, 0.0)).collect();
                values[number].im = STEP;
                let system = bundle.equations(&values).unwrap();
                let mut work = system.work();
                system.residual(&at.map(Complex::from_f64), &mut work);
                let rows = system.rows();
                for (row, found) in system
                    .residual_of(&work)
                    .iter()
                    .zip(&columns[number * rows..])
                {
                    let expected = row.im / STEP;
                    assert!(
                        (found - expected).abs() < 1e-13 * (1.0 + expected.abs()),
                        "{file} {found} {expected}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}
