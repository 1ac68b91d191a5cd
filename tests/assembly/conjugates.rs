//! For real inputs the solutions that are not real come in conjugate pairs, also where the search
//! ended too early.

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, ComplexAssembly, Wanted,
};
use linkwork::solve::Watch;
use linkwork::system::Question;

fn report(name: &str, settings: &AssembliesSettings) -> AssembliesReport {
    let path = format!("{}/mechanisms/{name}.ron", env!("CARGO_MANIFEST_DIR"));
    let mechanism = linkwork::load(path).unwrap();
    let question = Question::new(&mechanism);
    let held = question.held();
    let solver = AssemblySolver::new(&mechanism, &held, settings, &Watch::none()).unwrap();
    let wanted = Wanted {
        certificates: false,
        all_complex: true,
        starts: false,
        proof: None,
    };
    solver.at(&question.start(), wanted, &Watch::none())
}

/// Whether one is the conjugate of the other: angles but for whole turns, quaternions but for sign.
fn are_conjugate(a: &ComplexAssembly, b: &ComplexAssembly) -> bool {
    const NEAR: f64 = 1e-6;
    let joints = a.joints.values().zip(b.joints.values());
    let mut joints = joints.map(|([x, u], [y, v])| {
        let turns = ((x - y) / std::f64::consts::TAU).round();
        let part = (x - y - turns * std::f64::consts::TAU).abs();
        (part.min((x - y).abs()) + (u + v).abs()) / (1.0 + x.abs() + u.abs())
    });
    let mut platforms = a.platforms.values().zip(b.platforms.values());
    joints.all(|gap| gap < NEAR)
        && platforms.all(|(a, b)| {
            let gap = |range: std::ops::Range<usize>, sign: f64| {
                let parts = a[range.clone()].iter().zip(&b[range]);
                let gaps = parts.map(|([x, u], [y, v])| {
                    ((x - sign * y).abs() + (u + sign * v).abs()) / (1.0 + x.abs() + u.abs())
                });
                gaps.fold(0.0, f64::max)
            };
            gap(0..3, 1.0) < NEAR && gap(3..7, 1.0).min(gap(3..7, -1.0)) < NEAR
        })
}

fn assert_paired(report: &AssembliesReport) {
    let complex = &report.complex_assemblies;
    for solution in complex {
        let partners = complex
            .iter()
            .filter(|other| are_conjugate(solution, other));
        assert_eq!(partners.count(), 1);
    }
    let counted: usize = complex.iter().map(|solution| solution.multiplicity).sum();
    assert_eq!(counted % 2, 0);
    let real: usize = report.assemblies.iter().map(|a| a.multiplicity).sum();
    assert_eq!(report.complex, real + counted);
}

#[test]
fn solutions_that_are_not_real_come_in_pairs() {
    let names = ["planar_3rpr", "three_rps", "stewart_gough_6sps", "four_bar"];
    for name in names {
        for seed in 1..4 {
            let settings = AssembliesSettings {
                seed,
                ..AssembliesSettings::default()
            };
            let report = report(name, &settings);
            assert_paired(&report);
            assert!(report.conjugates == 0 && !report.may_lack_some(), "{name}");
        }
    }
}

#[test]
fn partners_that_the_search_missed_are_added_and_told() {
    let mut missed = 0;
    for name in ["three_rps", "stephenson_six_bar"] {
        for seed in 1..6 {
            // one batch of seeds and no loop
            let settings = AssembliesSettings {
                seed,
                quiet_seeds: 1,
                most_seeds: 1,
                most_loops: 0,
                ..AssembliesSettings::default()
            };
            let report = report(name, &settings);
            assert_paired(&report);
            // where the seeds alone reach the known bound nothing is left to search for
            let all = report.bound == Some(report.generic);
            assert_eq!(report.search.exhausted, !all, "{name}, seed {seed}");
            assert!(all || report.may_lack_some(), "{name}");
            missed += report.conjugates;
            let completeness = linkwork::output::assemblies::completeness(&report);
            let told = completeness.contains("conjugate");
            assert_eq!(told, report.conjugates > 0, "{completeness}");
        }
    }
    assert!(missed > 0);
}
