//! Numbers of solutions of random mechanisms for many seeds, beside PHCpack's.
//!
//! `tests/data/random_assemblies.json` has 30 mechanisms of eight structures, written with PHCpack's numbers for polynomials that
//! know nothing of frames, cuts and angles by `tests/data/random_assemblies.py` (PHCpack 2.4.86, Verschelde 1999).

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Wanted,
};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

#[derive(serde::Deserialize)]
struct Case {
    structure: String,
    solutions: usize,
    file: String,
}

fn cases() -> Vec<Case> {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/random_assemblies.json"
    );
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}

fn answer(text: &str, seed: u64) -> AssembliesReport {
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let (question, watch) = (Question::new(&mechanism), Watch::none());
    let settings = AssembliesSettings {
        seed,
        ..AssembliesSettings::default()
    };
    let solver = AssemblySolver::new(&mechanism, &question.held(), &settings, &watch).unwrap();
    let wanted = Wanted {
        certificates: false,
        ..Wanted::default()
    };
    solver.at_targets(&question.start(), &question.held(), wanted, &watch)
}

/// Cases and seeds whose answer is not PHCpack's, or which doubt it.
fn others(every: usize, seeds: std::ops::RangeInclusive<u64>) -> Vec<String> {
    let mut found = Vec::new();
    let cases = cases();
    assert_eq!(cases.len(), 30);
    for (k, case) in cases.iter().enumerate().step_by(every) {
        for seed in seeds.clone() {
            let report = answer(&case.file, seed);
            let counts = (
                report.complex,
                report.at_infinity + report.singular + report.lost,
            );
            if counts != (case.solutions, 0) || report.may_lack_some() {
                let structure = &case.structure;
                found.push(format!(
                    "{k}, {structure}, seed {seed}: {counts:?} of {}",
                    case.solutions
                ));
            }
        }
    }
    found
}

#[test]
fn random_mechanisms_have_as_many_solutions_as_phcpack_finds() {
    assert_eq!(others(1, 1..=1), Vec::<String>::new());
    assert_eq!(others(3, 2..=3), Vec::<String>::new());
}

/// Minutes: `cargo test --release --test assembly random_counts -- --ignored`
#[test]
#[ignore = "takes minutes"]
fn fifty_seeds_find_as_many_solutions_as_phcpack() {
    assert_eq!(others(1, 1..=50), Vec::<String>::new());
}

/// A length that differs a little leaves the number as it is, a joint more does not.
#[test]
fn another_structure_has_another_number() {
    let cases = cases();
    let [triad, truss] = [&cases[0], &cases[5]];
    assert_ne!(triad.solutions, truss.solutions);
    assert_eq!(
        answer(&truss.file.replacen("0.", "0.1", 1), 1).complex,
        truss.solutions
    );
}
