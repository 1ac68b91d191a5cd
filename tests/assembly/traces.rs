//! Searches that the trace test ends.

use linkwork::analysis::assemblies::{AssembliesReport, Wanted};
use linkwork::ask::Question;
use linkwork::description::Description;
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
    linkwork::load(format!("{folder}/mechanisms/{name}.ron")).unwrap()
}

/// Structures for which no bound is known; their counts are those of the cranks, hands and linkages they are made of: a
/// four-bar closes in two ways (Freudenstein 1955), whatever bodies it is written with, a five-bar with two cranks held
/// too, and a plate on three equal, parallel cranks in one (`mechanisms/three_parallel_cranks.ron`).
#[test]
fn without_a_bound_loops_and_seeds_that_find_no_more_end_the_search() {
    for (name, count) in [
        ("four_bar_cut1", 2),
        ("five_bar_hand", 2),
        ("three_parallel_cranks", 1),
    ] {
        for seed in 1..=3 {
            let report = asked(shipped(name), seed);
            assert_eq!((report.generic, report.bound), (count, None), "{name}");
            assert!(!report.search.traced, "{name}: it has no rod");
            assert!(report.search.quiet_loops >= 20 && report.search.quiet_seeds >= 150);
            assert!(!report.may_lack_some());
            let said = report.document().remarks.complete.unwrap();
            assert!(said.contains("found no more; no bound is known"), "{said}");
        }
    }
}

/// The relation between links and offsets that lets Bricard's loop close is kept, and the report says so; the lengths of a truss
/// are numbers of their own.
#[test]
fn the_report_says_where_dimensions_kept_their_relations() {
    assert!(asked(shipped("bricard_plane"), 1).search.related);
    assert!(!asked(shipped("triangle"), 1).search.related);
}

/// Where the known bound is reached it is enough, and nothing is asked.
/// 18 by Waldron and Sreenivasan (1996), and as the intersections of two coupler curves that are not circular points.
#[test]
fn the_double_butterfly_closes_in_eighteen_ways() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let mechanism = || linkwork::load(format!("{folder}/tests/data/double_butterfly.ron")).unwrap();
    for seed in 1..=5 {
        let report = asked(mechanism(), seed);
        // the real ones by a scan of both coupler curves
        assert_eq!((report.real, report.complex), (14, 18), "seed {seed}");
        assert!(report.search.traced && !report.may_lack_some());
    }
}

#[test]
fn a_known_bound_needs_no_trace_test() {
    let report = asked(shipped("planar_3rpr"), 1);
    assert_eq!((report.generic, report.bound), (6, Some(6)));
    assert!(!report.search.traced);
}

/// One crank between two rods that agree: more equations than unknowns and no parameters, so that nothing can move and no
/// loop goes anywhere. That says nothing about other solutions.
#[test]
fn a_family_of_one_member_is_not_said_to_be_traced() {
    let text = r#"Mechanism(
        version: 1, name: "crank between rods", convention: Modified,
        joints: { "q": Passive(home: "60 deg") },
        chains: {
            "tip": Chain(rows: [(theta: "q")], tip: [Tx(1)]),
            "right": Chain(base: [Tx(2)]),
            "top": Chain(base: [T(0, 2, 0)]),
        },
        closures: {
            "a": Distance("tip", "right", "sqrt(3)"),
            "b": Distance("tip", "top", "sqrt(5 - 2*sqrt(3))"),
        },
    )"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = asked(mechanism, 1);
    assert_eq!(
        (report.generic, report.real, report.search.traced),
        (1, 1, false)
    );
}

/// Rods written as bodies between two balls are solved as distances: 8 real assemblies of 28 finite ones, as with distances.
#[test]
fn rods_between_two_balls_are_six_distances() {
    let file = "tests/data/hexapod_ball_rods.ron";
    let mechanism = linkwork::load(format!("{}/{file}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let report = asked(mechanism, 1);
    assert_eq!((report.complex, report.real), (28, 8));
    assert_eq!((report.paths, report.search.general), (40, Some(0)));
    assert!(report.assemblies.iter().all(|a| a.certified));
}

/// Six ternary links on ground pivots with bars from each to the next (13 links, 7 loops) close in 126 ways: the degree published for this topology (Rojas and Thomas), and the mixed volume
/// of its loop equations (Bernstein 1975). The sides of its triangles are parameters, and roots of them have branch points.
#[test]
fn a_truss_whose_triangles_have_roots_of_parameters_is_complete_for_different_seeds() {
    let mechanism = linkwork::load(format!(
        "{}/tests/data/truss_13.ron",
        env!("CARGO_MANIFEST_DIR")
    ));
    let mechanism = mechanism.unwrap();
    for seed in 1..=2 {
        let report = asked(mechanism.clone(), seed);
        assert_eq!((report.generic, report.real), (126, 70), "seed {seed}");
        assert_eq!(
            (report.lost, report.search.exhausted),
            (0, false),
            "seed {seed}"
        );
        assert!(report.search.traced, "seed {seed}");
        assert!(!report.may_lack_some(), "seed {seed}");
    }
}

/// Two trusses of seven links have as many solutions as PHCpack finds for polynomials that know nothing of frames and angles
/// (`tests/data/random_assemblies.py`, seeds 3 and 1038). What a rod leaves of the first has no known number: the test is
/// made of that too. Angles of the second are up to 8i, where bars have to be found again from far out. Neither count is doubted,
/// whatever the seed.
#[test]
fn smaller_trusses_are_tested_like_the_whole_and_solutions_far_out_are_not_doubted() {
    let folder = env!("CARGO_MANIFEST_DIR");
    for (name, seeds) in [("truss_7", [1, 2, 3, 4]), ("truss_7_far", [13, 14, 33, 43])] {
        let mechanism = linkwork::load(format!("{folder}/tests/data/{name}.ron")).unwrap();
        for seed in seeds {
            let report = asked(mechanism.clone(), seed);
            let counts = (report.generic, report.complex, report.at_infinity);
            assert_eq!(counts, (16, 16, 0), "{name}, seed {seed}");
            let search = &report.search;
            // of the other some seeds find members at which bars are too far out
            assert!(search.traced || name != "truss_7", "{name}, seed {seed}");
            assert!(!report.may_lack_some(), "{name}, seed {seed}");
        }
    }
}

/// What is said where the test failed at two members, and the exit status that goes with it.
#[test]
fn a_count_that_the_test_refutes_twice_is_doubted() {
    let mut report = asked(shipped("triangle"), 1);
    assert!(!report.may_lack_some());
    report.search.refuted = true;
    assert!(report.may_lack_some() && !report.is_yes());
    let said = report.document().remarks.complete.unwrap();
    assert!(said.contains("failed at every member"), "{said}");
}
