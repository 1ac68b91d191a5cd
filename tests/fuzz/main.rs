//! Random mechanisms and random questions: every answer keeps the invariants of kinematics.
//!
//! A few cases run with all tests. `FUZZ=1000..2000 cargo test --test fuzz -- --ignored --nocapture` runs as many as
//! one likes; what breaks an invariant is written to the folder `FUZZ_FOUND` names. Cases that once did are kept in
//! `tests/found`.

mod circuits;
mod generator;
mod invariants;
mod kinematics;
mod motions;
mod questions;

use std::path::{Path, PathBuf};
use std::time::Instant;

use generator::Dice;
use invariants::{Budget, check, other_cuts, read};
use linkwork::mechanism::Mechanism;
use questions::{Asked, asked};

/// A case: a mechanism with a question about it, and the file of both.
fn posed(seed: u64, size: usize) -> (String, Result<(Mechanism, Asked), String>) {
    let text = generator::mechanism(seed, size);
    let mechanism = match read(&text) {
        Ok(mechanism) => mechanism,
        Err(broken) => return (text, Err(broken)),
    };
    let home = mechanism.home();
    let placed = kinematics::Placed {
        mechanism: &mechanism,
        at: &home,
    };
    let gap = placed.gap();
    assert!(
        gap < 1e-9,
        "seed {seed} is open by {gap:e} where it was made:\n{text}"
    );
    match asked(&mechanism, &mut Dice::new(!seed)) {
        Ok(asked) => (format!("{}\n{text}", asked.line()), Ok((mechanism, asked))),
        Err(broken) => (text, Err(broken)),
    }
}

#[test]
fn answers_about_random_mechanisms_keep_the_invariants() {
    let budget = Budget { steps: 300 };
    for seed in 0..24 {
        let (text, posed) = posed(seed, 5);
        let checked = posed.and_then(|(mechanism, asked)| check(&mechanism, &asked, &budget));
        let checked = checked.and_then(|()| other_cuts(&text, &budget));
        if let Err(broken) = checked {
            panic!("seed {seed}: {broken}\n{text}");
        }
    }
}

#[test]
fn circuits_of_random_linkages_hold_every_assembly() {
    for seed in 0..40 {
        if let Err((broken, text)) = circuits::check(seed) {
            panic!("seed {seed}: {broken}\n{text}");
        }
    }
}

#[test]
fn freedoms_add_up_beside_singular_poses() {
    for seed in 0..12 {
        if let Err((broken, text)) = circuits::check_singular(seed) {
            panic!("seed {seed}: {broken}\n{text}");
        }
    }
}

#[test]
#[ignore = "takes as long as one likes: FUZZ=0..1000"]
fn circuits_of_many_random_linkages_hold_every_assembly() {
    let seeds = range(&std::env::var("FUZZ").unwrap_or("0..200".into()));
    let checked = |seed| circuits::check(seed).and_then(|()| circuits::check_singular(seed));
    let broken = seeds.filter_map(|seed| Some((seed, checked(seed).err()?)));
    let broken: Vec<_> = broken.collect();
    for (seed, (said, text)) in &broken {
        eprintln!("seed {seed}: {said}\n{text}");
    }
    assert!(broken.is_empty(), "{} of them", broken.len());
}

/// The numbers `a..b` of an environment variable.
fn range(text: &str) -> std::ops::Range<u64> {
    let (from, to) = text
        .split_once("..")
        .expect("FUZZ is a range, as in 0..1000");
    from.parse().unwrap()..to.parse().unwrap()
}

#[test]
#[ignore = "takes as long as one likes: FUZZ=0..1000"]
fn answers_about_many_random_mechanisms_keep_the_invariants() {
    let seeds = range(&std::env::var("FUZZ").unwrap_or("0..200".into()));
    let folder = std::env::var_os("FUZZ_FOUND").map(PathBuf::from);
    let budget = Budget { steps: 20_000 };
    let mut broken = 0;
    for seed in seeds {
        let start = Instant::now();
        let size = 3 + (seed % 7) as usize;
        let (text, posed) = posed(seed, size);
        // there beforehand, should it never end
        let file = (folder.as_ref()).map(|folder| folder.join(format!("{seed}.ron")));
        if let Some(file) = &file {
            std::fs::write(file, &text).unwrap();
        }
        let ended = std::panic::catch_unwind(|| {
            posed
                .and_then(|(mechanism, asked)| check(&mechanism, &asked, &budget))
                .and_then(|()| other_cuts(&text, &budget))
        });
        let said = match ended {
            Ok(checked) => checked.err(),
            Err(_) => Some("panics".into()),
        };
        let seconds = start.elapsed().as_secs_f64();
        if seconds > 20.0 {
            eprintln!("seed {seed}: {seconds:.0} s");
        }
        match (said, &file) {
            (Some(said), _) => {
                broken += 1;
                eprintln!("seed {seed} ({seconds:.1} s): {said}");
            }
            (None, Some(file)) => std::fs::remove_file(file).unwrap(),
            (None, None) => {}
        }
    }
    assert_eq!(broken, 0);
}

/// Cases that broke an invariant once, with their questions.
#[test]
fn cases_found_before_keep_the_invariants() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/found");
    let mut files: Vec<PathBuf> = (folder.read_dir().unwrap())
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        let mechanism = read(&text).unwrap_or_else(|broken| panic!("{}: {broken}", path.display()));
        let asked = Asked::read(text.lines().next().unwrap());
        let budget = Budget { steps: 20_000 };
        let checked = check(&mechanism, &asked, &budget);
        let checked = checked.and_then(|()| other_cuts(&text, &budget));
        checked.unwrap_or_else(|broken| panic!("{}: {broken}", path.display()));
    }
}
