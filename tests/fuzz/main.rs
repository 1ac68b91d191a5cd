//! Random mechanisms and random questions: every answer keeps the invariants of kinematics.
//!
//! A few cases run with all tests. `FUZZ=1000..2000 cargo test --test fuzz -- --ignored --nocapture` runs as many as
//! one likes; what breaks an invariant is written to the folder `FUZZ_FOUND` names. Cases that once did are kept in
//! `tests/found`.

mod generator;
mod invariants;
mod kinematics;
mod questions;

use std::path::{Path, PathBuf};
use std::time::Instant;

use generator::Dice;
use invariants::{Budget, check, read};
use questions::{Asked, asked};

/// One case: its text with the question, and what it breaks.
fn case(seed: u64, size: usize, budget: &Budget) -> (String, Result<(), String>) {
    let text = generator::mechanism(seed, size);
    let mechanism = match read(&text) {
        Ok(mechanism) => mechanism,
        Err(broken) => return (text, Err(broken)),
    };
    let home = mechanism.home();
    let gap = kinematics::Placed {
        mechanism: &mechanism,
        at: &home,
    }
    .gap();
    assert!(
        gap < 1e-9,
        "seed {seed} is open by {gap:e} where it was made:\n{text}"
    );
    let asked = match asked(&mechanism, &mut Dice::new(!seed)) {
        Ok(asked) => asked,
        Err(broken) => return (text, Err(broken)),
    };
    let text = format!("{}\n{text}", asked.line());
    let checked = check(&mechanism, &asked, budget);
    (text, checked)
}

#[test]
fn answers_about_random_mechanisms_keep_the_invariants() {
    let budget = Budget { steps: 300 };
    for seed in 0..24 {
        let (text, checked) = case(seed, 5, &budget);
        if let Err(broken) = checked {
            panic!("seed {seed}: {broken}\n{text}");
        }
    }
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
        let ended = std::panic::catch_unwind(|| case(seed, size, &budget));
        let (text, said) = match ended {
            Ok((text, Ok(()))) => (text, None),
            Ok((text, Err(broken))) => (text, Some(broken)),
            Err(_) => (generator::mechanism(seed, size), Some("panics".into())),
        };
        let seconds = start.elapsed().as_secs_f64();
        if seconds > 20.0 {
            println!("seed {seed}: {seconds:.0} s");
        }
        let Some(said) = said else { continue };
        broken += 1;
        println!("seed {seed} ({seconds:.1} s): {said}");
        if let Some(folder) = &folder {
            std::fs::write(folder.join(format!("{seed}.ron")), text).unwrap();
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
        let checked = check(&mechanism, &asked, &Budget { steps: 20_000 });
        checked.unwrap_or_else(|broken| panic!("{}: {broken}", path.display()));
    }
}
