//! Lists that are certain: what can be decided is not left in doubt.

use linkwork::analysis::assemblies::{AssembliesReport, Wanted};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;

fn shipped(name: &str) -> Mechanism {
    linkwork::load(format!(
        "{}/mechanisms/{name}.ron",
        env!("CARGO_MANIFEST_DIR")
    ))
    .unwrap()
}

fn asked(question: &Question) -> AssembliesReport {
    question
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap()
}

#[test]
fn the_pose_of_an_arm_follows_from_its_joints_with_certainty() {
    let arms = [
        "elbow_manipulator",
        "puma560_corke",
        "puma560_modified",
        "puma560_standard",
        "scara_modified",
        "scara_standard",
        "stanford_arm",
    ];
    for name in arms {
        let report = asked(&Question::new(shipped(name)));
        assert_eq!(
            (report.real, report.complex, report.bound),
            (1, 1, Some(1)),
            "{name}"
        );
        assert!(report.is_yes() && !report.may_lack_some(), "{name}");
    }
}

#[test]
fn solutions_that_rounding_blurs_far_out_are_no_others() {
    // two hands on one arm: no bound is known for several platforms
    let text = std::fs::read_to_string(format!(
        "{}/mechanisms/scara_modified.ron",
        env!("CARGO_MANIFEST_DIR")
    ))
    .unwrap();
    let second = r#""hand2": Platform(home: [Rz("75 deg"), Tx(0.4)]), "hand": Platform("#;
    let text = text.replace("\"hand\": Platform(", second);
    let text = text.replace(
        "closures: {",
        "closures: { \"grip2\": Rigid(\"arm.2\", \"hand2\"),",
    );
    let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
    let report = asked(&Question::new(mechanism));
    assert_eq!((report.real, report.complex, report.bound), (1, 1, None));
    assert!(
        report.search.multiple == 0 && report.is_yes(),
        "{} multiple",
        report.search.multiple
    );
}

#[test]
fn a_solution_that_is_multiple_for_all_inputs_comes_with_its_multiplicity() {
    // the rod is stretched in every assembly: twice the same point, whatever is held
    let text = r#"Mechanism(
        version: 1, name: "stretched", convention: Modified,
        joints: { "t": Actuated(home: "30 deg"), "q": Passive() },
        chains: {
            "arm": Chain(rows: [(theta: "t"), (a: 1, theta: "q")], tip: [Tx(0.5)]),
            "post": Chain(on: "arm.1", base: [Tx(2.5)]),
        },
        closures: { "rod": Distance("arm", "post", 1) },
    )"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = asked(&Question::new(mechanism));
    assert_eq!(
        (report.real, report.complex, report.search.multiple),
        (1, 2, 0)
    );
    assert_eq!(report.assemblies[0].multiplicity, 2);
    assert!(report.bound == Some(2) && !report.may_lack_some());
    // a rod that is longer than that has two
    let report = asked(&Question::new(
        Mechanism::new(
            &Description::read(&text.replace("\"post\", 1)", "\"post\", 1.1)")).unwrap(),
        )
        .unwrap(),
    ));
    assert_eq!((report.real, report.complex, report.singular), (2, 2, 0));
}

#[test]
fn a_gear_of_a_fraction_comes_back_after_some_turns() {
    // the second crank turns at half the rate of the first: positions repeat after two turns of it, and the ends of
    // the cranks are a rod's length apart at the roots of a quartic in tan(q/4)
    let text = r#"Mechanism(
        version: 1, name: "geared cranks", convention: Modified,
        joints: { "t": Actuated(home: 0.2), "q": Passive(home: 1) },
        chains: {
            "left": Chain(rows: [(theta: "q")], tip: [Tx(0.5)]),
            "right": Chain(base: [Tx(1)], rows: [(theta: "-0.5*q + t")], tip: [Tx(0.6)]),
        },
        closures: { "rod": Distance("left", "right", 1) },
    )"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let reports = [1, 2, 3].map(|seed| asked(&Question::new(mechanism.clone()).seed(seed)));
    // signs of the gap on a fine grid over two turns
    let gap = |q: f64| {
        let right = -0.5 * q + 0.2;
        let [x, y] = [
            1.0 + 0.6 * right.cos() - 0.5 * q.cos(),
            0.6 * right.sin() - 0.5 * q.sin(),
        ];
        x.hypot(y) - 1.0
    };
    let at =
        |k: usize| -2.0 * std::f64::consts::PI + 4.0 * std::f64::consts::PI * k as f64 / 4000.0;
    let roots = (0..4000)
        .filter(|&k| (gap(at(k)) < 0.0) != (gap(at(k + 1)) < 0.0))
        .count();
    for report in &reports {
        assert_eq!(report.real, roots);
        assert_eq!(
            (report.complex, report.generic),
            (reports[0].complex, reports[0].generic)
        );
        assert!(!report.may_lack_some());
    }
}
