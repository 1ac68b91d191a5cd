//! Chance decides the way to the list of assemblies, not the list: every shipped mechanism with
//! fifty random seeds.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use linkwork::analysis::assemblies::{
    AssembliesReport, AssembliesSettings, AssemblySolver, Wanted,
};
use linkwork::description::load;
use linkwork::mechanism::Mechanism;
use linkwork::system::Question;

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let files = std::fs::read_dir(folder).unwrap();
    let files = files.map(|file| file.unwrap().path());
    let mut files: Vec<PathBuf> = files
        .filter(|f| f.extension().is_some_and(|e| e == "ron"))
        .collect();
    files.sort();
    files
}

fn mechanism(path: &Path) -> Mechanism {
    Mechanism::new(&load(path).unwrap().1).unwrap()
}

fn answer(mechanism: &Mechanism, seed: u64) -> AssembliesReport {
    let question = Question::new(mechanism);
    let settings = AssembliesSettings {
        seed,
        ..AssembliesSettings::default()
    };
    let solver = AssemblySolver::new(mechanism, &question.held(), &settings).unwrap();
    solver.at_targets(&question.start(), &question.held(), Wanted::default())
}

/// How far apart two values are, going round for angles.
fn apart(mechanism: &Mechanism, joint: usize, a: f64, b: f64) -> f64 {
    match mechanism.joints()[joint].kind.is_angle() {
        true => ((a - b + PI).rem_euclid(TAU) - PI).abs(),
        false => (a - b).abs(),
    }
}

/// What the two answers say differently, in the order of the report; nothing if they agree.
///
/// Where solutions meet or are samples, only as many digits are determined as the square root of
/// rounding leaves.
fn differences(mechanism: &Mechanism, a: &AssembliesReport, b: &AssembliesReport) -> Vec<String> {
    let mut found = Vec::new();
    let counts = |r: &AssembliesReport| {
        format!(
            "{:?}, {} generic, {} complex, {} real, {} singular, {} at infinity, {} lost, bound {:?}",
            r.fit, r.generic, r.complex, r.real, r.singular, r.at_infinity, r.lost, r.bound
        )
    };
    if counts(a) != counts(b) {
        found.push(format!("{} against {}", counts(a), counts(b)));
    }
    for (x, y) in a.assemblies.iter().zip(&b.assemblies) {
        let digits = if x.multiplicity == 1 { 1e-9 } else { 1e-6 };
        for (j, ((name, u), (_, v))) in x.joints.0.iter().zip(&y.joints.0).enumerate() {
            let far = apart(mechanism, j, *u, *v);
            if far > digits {
                found.push(format!("mode {}: {name} {u} against {v}", x.mode));
            }
        }
        for ((name, u), (_, v)) in x.platforms.0.iter().zip(&y.platforms.0) {
            let far = (0..3).map(|i| (u.position[i] - v.position[i]).abs());
            let far = far.chain((0..4).map(|i| (u.quaternion[i] - v.quaternion[i]).abs()));
            if far.fold(0.0, f64::max) > digits {
                found.push(format!("mode {}: pose of {name} differs", x.mode));
            }
        }
        let verdict = |a: &linkwork::analysis::assemblies::Assembly| {
            format!(
                "sign {}, multiplicity {}, certified {}, within limits {}, shares with {:?}",
                a.determinant_sign,
                a.multiplicity,
                a.certified,
                a.within_limits,
                a.shares_platform_pose_with
            )
        };
        if verdict(x) != verdict(y) {
            found.push(format!(
                "mode {}: {} against {}",
                x.mode,
                verdict(x),
                verdict(y)
            ));
        }
    }
    found
}

#[test]
#[ignore = "campaign"]
fn campaign() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let top: u64 = std::env::var("TOP").map_or(50, |x| x.parse().unwrap());
    for file in files() {
        let name = file.file_stem().unwrap().to_str().unwrap().to_owned();
        if name == "stewart_gough_6ups" || !(only.is_empty() || only.split(',').any(|o| o == name))
        {
            continue;
        }
        let m = mechanism(&file);
        let reference = answer(&m, 1);
        let t = std::time::Instant::now();
        for seed in 2..=top {
            let other = answer(&m, seed);
            for d in differences(&m, &reference, &other) {
                println!("DIFF {name} seed {seed}: {d}");
            }
        }
        println!(
            "{name} done, {:.2} s a seed",
            t.elapsed().as_secs_f64() / (top - 1) as f64
        );
    }
}
