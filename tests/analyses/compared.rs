//! Closed forms against the chains of a 4-bar.

use linkwork::analysis::compare::*;
use linkwork::mechanism::Mechanism;
use linkwork::solve::{Progress, Stage, Watch};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use linkwork::description::Description;

fn mechanism(forms: &str) -> Mechanism {
    let text = format!(
        r#"Mechanism(
            version: 1, name: "test", convention: Modified,
            parameters: {{ "l0": 5.0, "l1": 1.0, "l2": 3.0, "l3": 4.0 }},
            joints: {{ "t": Actuated(home: "60 deg"), "p": Passive(home: "-12 deg"), "q": Passive(home: "129 deg") }},
            chains: {{
                "left": Chain(rows: [(theta: "t"), (a: "l1", theta: "p")], tip: [Tx("l2")]),
                "right": Chain(base: [Tx("l0")], rows: [(theta: "q")], tip: [Tx("l3")]),
            }},
            closures: {{ "c": Revolute("left", "right") }},
            closed_forms: {{ {forms} }},
        )"#
    );
    Mechanism::new(&Description::read(&text).unwrap()).unwrap()
}

fn reports(forms: &str) -> Vec<FormReport> {
    compare(
        &mechanism(forms),
        &CompareSettings::default(),
        &Watch::none(),
    )
    .closed_forms
}

#[test]
fn identities_are_tried_at_assembled_configurations_only() {
    let forms = reports(
        r#""loop": (identities: {
               "right": "l1*sin(t) + l2*sin(t + p) - l3*sin(q)",
               "wrong": "l1*sin(t) + l2*sin(t + p) + l3*sin(q)",
               "tiny": "1e-9*(l1*sin(t) + l2*sin(t + p) + l3*sin(q))",
           }),"#,
    );
    let agree: Vec<bool> = forms[0].components.iter().map(|c| c.agree).collect();
    assert_eq!(agree, [true, false, false]);
}

#[test]
fn a_form_without_a_value_is_counted_and_is_not_agreement() {
    let forms = reports(
        r#""never": (of: "left", where: { "zero": "l1 - 1", "unused": "sqrt(-l1)" }, entries: { "px": "1/zero", "pz": "0" }),
           "sometimes": (of: "left", entries: { "pz": "0*sqrt(sin(t))" }),"#,
    );
    let never = &forms[0].components[0];
    assert_eq!((never.samples, never.without_value), (0, 102));
    assert_eq!(forms[0].verdict, Verdict::Undefined);
    assert!(forms[0].components[1].agree);
    let sometimes = &forms[1].components[0];
    assert!(sometimes.agree && sometimes.samples > 20 && sometimes.without_value > 20);
    assert_eq!(forms[1].verdict, Verdict::Agrees);
}

#[test]
fn an_identity_of_a_mechanism_that_cannot_be_assembled_is_not_tried() {
    let text = r#"Mechanism(
        version: 1, name: "too short", convention: Modified,
        joints: { "t": Actuated(), "q": Passive() },
        chains: {
            "left": Chain(rows: [(theta: "t")], tip: [Tx(1)]),
            "right": Chain(base: [Tx(5)], rows: [(theta: "q")], tip: [Tx(1)]),
        },
        closures: { "rod": Distance("left", "right", 0.5) },
        closed_forms: { "nothing": (identity: "t - t") },
    )"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = compare(&mechanism, &CompareSettings::default(), &Watch::none());
    assert_eq!(report.closed_forms[0].verdict, Verdict::NotTried);
    assert!(!report.agree && !report.home_assembles);
    assert_eq!(report.not_assembled, 100);
}

#[test]
fn a_frame_on_a_platform_is_seen_where_the_platform_is_when_assembled() {
    let text = r#"Mechanism(
        version: 1, name: "carried", convention: Modified,
        joints: { "t": Actuated(home: 0.3), "u": Actuated(home: 0.2) },
        chains: {
            "arm": Chain(rows: [(theta: "t")], tip: [Tx(2)]),
            "hand": Chain(on: "top", rows: [(theta: "u")], tip: [Tx(1)]),
        },
        platforms: { "top": Platform(home: [Tx(1.5)]) },
        closures: { "grip": Rigid("arm", "top") },
        closed_forms: {
            "in_ground": (of: "hand", entries: { "px": "2*cos(t) + cos(t + u)" }),
            "on_top": (of: "hand", in: "top", entries: { "px": "cos(u)" }),
        },
    )"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = compare(&mechanism, &CompareSettings::default(), &Watch::none());
    assert!(report.agree, "{report:#?}");
}

#[test]
fn more_samples_than_are_remembered_go_on_from_those() {
    let mechanism = mechanism(r#""loop": (identity: "l1*sin(t) + l2*sin(t + p) - l3*sin(q)"),"#);
    let settings = CompareSettings {
        samples: 1500,
        ..CompareSettings::default()
    };
    let samples = AtomicUsize::new(0);
    let count = |now: Progress| {
        if now.stage == Stage::Samples {
            assert_eq!(now.done, samples.fetch_add(1, Ordering::Relaxed));
            assert_eq!(now.of, Some(3002));
        }
        ControlFlow::Continue(())
    };
    let report = compare(&mechanism, &settings, &Watch::new(&count));
    assert!(report.agree);
    assert_eq!(report.closed_forms[0].samples + report.not_assembled, 1501);
    assert!(samples.into_inner() > 3000 && !report.interrupted);
}
