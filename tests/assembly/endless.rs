//! Infinitely many generic solutions are noticed instead of collected.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Fit, Wanted,
};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::output::assemblies::completeness;
use linkwork::solve::{Progress, Watch};

/// A five-bar whose cranks are geared with a ratio; a point of it is held instead of the crank.
fn geared(ratio: &str) -> Question {
    let text = format!(
        r#"Mechanism(
            version: 1, name: "geared five-bar", convention: Modified,
            parameters: {{ "l0": 1.0, "l1": 0.4, "l2": 1.1, "n": "{ratio}" }},
            joints: {{ "q": Actuated(home: "60 deg"), "a": Passive(), "b": Passive(home: "10 deg") }},
            chains: {{
                "left": Chain(rows: [(theta: "q"), (a: "l1", theta: "a")], tip: [Tx("l2")]),
                "right": Chain(
                    base: [Tx("l0")],
                    rows: [(theta: "n*q + 100 deg"), (a: "l1", theta: "b")],
                    tip: [Tx("l2")],
                ),
            }},
            platforms: {{ "p": Platform(home: [T(0.5, 1, 0)]) }},
            closures: {{
                "c": Revolute("left", "right"), "on": Spherical("left", "p"), "flat": Planar("p", "ground"),
            }},
        )"#
    );
    let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
    Question::new(mechanism)
        .free("q")
        .hold("p.x", 0.5)
        .hold("p.yaw", 0.0)
}

#[test]
fn a_gear_whose_ratio_is_no_fraction_has_no_finite_number_of_assemblies() {
    let report = geared("sqrt(2)").assemblies(Wanted::default(), &Watch::none());
    let report = report.unwrap();
    assert_eq!(report.fit, Fit::Endless);
    assert!(report.search.seeds < 2500, "{} seeds", report.search.seeds);
    assert!(report.real > 0);
}

#[test]
fn with_the_crank_held_or_a_whole_ratio_their_number_is_finite() {
    let held = geared("sqrt(2)");
    let mechanism = (**held.mechanism()).clone();
    let question = Question::new(mechanism).hold("p.yaw", 0.0);
    let report = question
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap();
    // two circles meet in two points
    assert_eq!((report.fit, report.complex), (Fit::Finite, 2));
    let report = geared("2").assemblies(Wanted::default(), &Watch::none());
    assert_eq!(report.unwrap().fit, Fit::Finite);
}

/// A screw that travels 0.1 m with every radian, with what is joined to it.
fn screw(joints: &str, before: &str, after: &str, closure: &str) -> Question {
    let text = format!(
        r#"Mechanism(
            version: 1, name: "screw", convention: Modified,
            joints: {{ "q": Passive(home: 0.5), {joints} }},
            chains: {{
                "nut": Chain(rows: [{before} (d: "0.1*q", theta: "q"), {after}], tip: [Tx(0.5)]),
                "post": Chain(base: [T(0.3, 0.6, 0.4)]),
            }},
            closures: {{ "c": {closure} }},
        )"#
    );
    Question::new(Mechanism::new(&Description::read(&text).unwrap()).unwrap())
}

fn found(question: &Question) -> AssembliesReport {
    let [a, b] = [1, 2].map(|seed| {
        let question = question.clone().seed(seed);
        question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap()
    });
    assert_eq!((&a.fit, a.real, a.complex), (&b.fit, b.real, b.complex));
    a
}

#[test]
fn a_screw_whose_travel_a_slide_makes_up_for_has_an_assembly_with_every_turn() {
    let joints = r#""s": Passive(home: 0.2), "u": Passive(home: "20 deg")"#;
    let (slide, hinge) = (r#"(d: "s"),"#, r#"(alpha: "90 deg", a: 0.4, theta: "u")"#);
    let report = found(&screw(joints, slide, hinge, r#"Spherical("nut", "post")"#));
    assert_eq!(report.fit, Fit::Endless);
    assert!(report.real > 0 && !report.is_yes() && report.may_lack_some());
    for assembly in &report.assemblies {
        let [q, s, u] = ["q", "s", "u"].map(|name| *assembly.joints.get(name).unwrap());
        // the arm points to the post after any number of turns, and the slide stands where that puts it
        assert!((q - f64::atan2(0.6, 0.3)).sin().abs() < 1e-9, "{q}");
        assert!((s + 0.1 * q + 0.5 * u.sin() - 0.4).abs() < 1e-9);
    }
    let answer = report.document().answer;
    assert!(
        answer.contains("q stands differently after every turn"),
        "{answer}"
    );
}

#[test]
fn a_screw_whose_travel_turns_it_has_no_end_of_complex_solutions() {
    let report = found(&screw("", "", "", r#"Distance("nut", "post", 0.6)"#));
    assert_eq!(report.fit, Fit::Endless);
    assert!(report.real > 0 && !report.is_yes());
    for assembly in &report.assemblies {
        let q = *assembly.joints.get("q").unwrap();
        let [x, y, z] = [0.5 * q.cos() - 0.3, 0.5 * q.sin() - 0.6, 0.1 * q - 0.4];
        assert!((x * x + y * y + z * z - 0.36).abs() < 1e-9, "{q}");
    }
}

#[test]
fn a_screw_whose_nut_is_held_has_one_assembly() {
    let report = found(&screw("", "", "", r#"Planar("nut", "post")"#));
    assert_eq!(
        (report.fit.clone(), report.real, report.complex),
        (Fit::Finite, 1, 1)
    );
    // 0.4 m at 0.1 m a radian, more than half a turn from home
    let q = *report.assemblies[0].joints.get("q").unwrap();
    assert!((q - 4.0).abs() < 1e-9 && report.is_yes());
}

/// A link whose ball lies on the axis of its hinge, to rounding: whatever the hinge does, the rod fits.
fn on_its_axis(beside: f64) -> Mechanism {
    let text = format!(
        r#"Mechanism(
            version: 1, name: "a ball on the axis of a hinge", convention: Modified,
            joints: {{ "t": Actuated(home: "20 deg"), "q": Passive(home: "40 deg") }},
            chains: {{
                "arm": Chain(
                    base: [Rx("17 deg"), Ry("23 deg")],
                    rows: [(theta: "t"), (alpha: "33 deg", a: 0.7, theta: "q")],
                    tip: [
                        Tx(0.6), Rz("-41 deg"), Tx("-0.6*cos(41 deg)"), Ty("-0.6*sin(41 deg)"), Rz("41 deg"),
                        T({beside:?}, 0, 0.3),
                    ],
                ),
                "post": Chain(on: "arm.1", base: [Rx("33 deg"), T(0.2, 0.5, 1)]),
            }},
            closures: {{ "rod": Distance("arm", "post", "sqrt(0.5^2 + 0.5^2 + 0.7^2)") }},
        )"#
    );
    Mechanism::new(&Description::read(&text).unwrap()).unwrap()
}

#[test]
fn where_nearly_every_seed_gives_a_new_solution_the_family_has_a_dimension() {
    let found = |mechanism: &Mechanism| {
        // asked of the solver itself: questions hold such spins still
        let held = linkwork::system::Question::new(mechanism).held();
        let settings = AssembliesSettings::default();
        let solver = AssemblySolver::new(mechanism, &held, &settings, &Watch::none()).unwrap();
        let report = solver.at(&mechanism.home(), Wanted::default(), &Watch::none());
        (report.fit, report.generic, report.search.seeds)
    };
    let (fit, generic, seeds) = found(&on_its_axis(0.0));
    assert_eq!((fit, generic), (Fit::FreedomLeft(1), 0));
    assert!(seeds < 500, "{seeds} seeds");
    // a ball beside the axis goes round a circle, which meets the rod's sphere twice
    let (fit, generic, _) = found(&on_its_axis(0.1));
    assert_eq!((fit, generic), (Fit::Finite, 2));
}

#[test]
fn an_interrupted_search_lists_the_assembly_that_is_drawn() {
    // of an H4 with hundreds of complex solutions: one of its real ones is the home position
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/h4_eight_rods.ron");
    let calls = AtomicUsize::new(0);
    let few = |_: Progress| match calls.fetch_add(1, Ordering::Relaxed) < 5 {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    };
    let mechanism = linkwork::load(file).unwrap();
    let home = mechanism.home();
    let report = Question::new(mechanism)
        .assemblies(Wanted::default(), &Watch::new(&few))
        .unwrap();
    assert!(report.interrupted && report.may_lack_some());
    assert_eq!(report.real, 1);
    let found = report.assemblies[0].configuration();
    for (a, b) in found.platforms.iter().zip(&home.platforms) {
        assert!((a.position - b.position).norm() < 1e-9);
    }
}

#[test]
#[ignore = "a minute on two cores without debug assertions"]
fn a_search_whose_every_loop_loses_a_few_of_hundreds_of_paths_ends_and_says_so() {
    let load = |name: &str| {
        let folder = env!("CARGO_MANIFEST_DIR");
        let question = Question::new(linkwork::load(format!("{folder}/{name}.ron")).unwrap());
        question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap()
    };
    let report = load("tests/data/h4_eight_rods");
    assert_eq!(
        (report.fit.clone(), report.search.exhausted),
        (Fit::Finite, false)
    );
    assert!(
        report.generic > 800 && report.search.loops < 60,
        "{}",
        report.search.loops
    );
    assert_eq!(report.real, 62);
    assert!(report.search.lost_in_loops > 0 && report.may_lack_some());
    let said = completeness(&report);
    assert!(said.contains("each with") && said.contains("lost paths at most"));
    // of few paths none may be lost
    let report = load("mechanisms/stewart_gough_6sps");
    assert!(report.search.lost_in_loops == 0 && !report.may_lack_some());
    assert!(completeness(&report).contains("without a lost path"));
}
