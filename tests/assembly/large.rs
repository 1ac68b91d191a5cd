//! Linkages with many loops: a row of 4-bars, each driven by the rocker of the one before.

use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

/// `loops` crank-rockers in a row; the rocker angle of one is the crank angle of the next.
fn row_of_four_bars(loops: usize) -> Mechanism {
    let mut joints = String::from("\"r0\": Actuated(home: \"60 deg\"),");
    let (mut chains, mut closures) = (String::new(), String::new());
    for k in 0..loops {
        let next = k + 1;
        joints += &format!(
            "\"c{k}\": Passive(home: \"-60 deg\"), \"r{next}\": Passive(home: \"60 deg\"),"
        );
        chains += &format!(
            "\"left{k}\": Chain(base: [Tx(\"{k}*l0\")], rows: [(theta: \"r{k}\"), (a: \"l1\", theta: \"c{k}\")], tip: [Tx(\"l2\")]),
             \"right{k}\": Chain(base: [Tx(\"{next}*l0\")], rows: [(theta: \"r{next}\")], tip: [Tx(\"l3\")]),"
        );
        closures += &format!("\"pin{k}\": Revolute(\"left{k}\", \"right{k}\"),");
    }
    let text = format!(
        "Mechanism(version: 1, name: \"row\", convention: Modified,
            parameters: {{ \"l0\": 4, \"l1\": 2, \"l2\": 4.001, \"l3\": 2.001 }},
            joints: {{ {joints} }}, chains: {{ {chains} }}, closures: {{ {closures} }})"
    );
    Mechanism::new(&Description::read(&text).expect("well formed")).expect("meaningful")
}

#[test]
fn a_row_of_loops_assembles_in_as_many_steps_however_long_it_is() {
    for loops in [5, 40, 150] {
        let mechanism = row_of_four_bars(loops);
        let report = assemble(
            &Question::new(&mechanism),
            &AssemblySettings::default(),
            &Watch::none(),
        )
        .expect("one input for one freedom");
        assert_eq!(report.outcome, Outcome::Converged, "{loops} loops");
        assert_eq!(report.restarts, 0);
        assert!(report.residual <= 1e-12);
        assert!(
            report.steps <= 12,
            "{} steps for {loops} loops",
            report.steps
        );
    }
}

#[test]
fn a_row_with_an_input_out_of_reach_is_not_said_to_assemble() {
    let mechanism = row_of_four_bars(40);
    let question = Question::new(&mechanism)
        .free("r0")
        .and_then(|q| q.hold("r40", "180 deg"));
    let settings = AssemblySettings {
        restarts: 1,
        ..AssemblySettings::default()
    };
    let report = assemble(
        &question.expect("names of the row"),
        &settings,
        &Watch::none(),
    )
    .expect("one input");
    assert!(
        !matches!(report.outcome, Outcome::Converged),
        "{:?}",
        report.outcome
    );
}
