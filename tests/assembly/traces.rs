//! Searches that the trace test ends.

use linkwork::analysis::assemblies::{AssembliesReport, Traced, Wanted};
use linkwork::ask::Question;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;

fn asked(mechanism: Mechanism, seed: u64) -> AssembliesReport {
    (Question::new(mechanism).seed(seed))
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap()
}

fn shipped(name: &str) -> Mechanism {
    let folder = env!("CARGO_MANIFEST_DIR");
    Mechanism::load(format!("{folder}/mechanisms/{name}.ron")).unwrap()
}

/// Structures for which no bound is known; their counts are those of the cranks, hands and linkages they are made of: a
/// four-bar closes in two ways (Freudenstein 1955), whatever bodies it is written with, a five-bar with two cranks held
/// too, and a plate on three equal, parallel cranks in one (`mechanisms/three_parallel_cranks.ron`).
#[test]
fn loops_end_where_the_trace_test_holds() {
    for (name, count) in [
        ("four_bar_cut1", 2),
        ("five_bar_hand", 2),
        ("three_parallel_cranks", 1),
    ] {
        for seed in 1..=3 {
            let report = asked(shipped(name), seed);
            assert_eq!((report.generic, report.bound), (count, None), "{name}");
            assert_eq!(report.traced, Some(Traced::Inputs), "{name}, seed {seed}");
            assert!(report.quiet_loops < 20 && !report.may_lack_some());
            let said = report.document().remarks.complete.unwrap();
            let held = "the trace test holds: no loop of the inputs leads from these to others";
            assert!(said.ends_with(held), "{said}");
        }
    }
}

/// Where the known bound is reached it is enough, and nothing is asked.
#[test]
fn a_known_bound_needs_no_trace_test() {
    let report = asked(shipped("planar_3rpr"), 1);
    assert_eq!((report.generic, report.bound), (6, Some(6)));
    assert_eq!(report.traced, None);
}
