//! One number of a mode means one configuration, whatever is asked of it.

use std::path::Path;
use std::sync::Arc;

use linkwork::analysis::assemblies::Assembly;
use linkwork::analysis::assembly::AssemblySettings;
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::{AskError, Mode, Question, Solved};
use linkwork::mechanism::{Mechanism, Role};
use linkwork::solve::Watch;

fn load(path: &Path) -> Arc<Mechanism> {
    Arc::new(Mechanism::load(path).unwrap())
}

fn shipped() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let files = std::fs::read_dir(folder).unwrap();
    let files = files.map(|file| file.unwrap().path());
    let mut files: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|ending| ending == "ron"))
        .collect();
    files.sort();
    files
}

#[test]
fn a_question_can_be_sent_anywhere_and_outlives_its_maker() {
    fn owned<T: Send + Sync + Clone + 'static>(_: &T) {}
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let question = Question::new(load(&folder.join("four_bar.ron"))).hold("theta1", 1.0);
    owned(&question);
    let asked = std::thread::spawn(move || question.count().unwrap().held);
    assert_eq!(asked.join().unwrap(), 1);
}

#[test]
fn a_number_and_the_text_of_it_hold_the_same_value() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let question = Question::new(load(&folder.join("three_rps.ron")));
    for value in [0.1 + 0.2, 1.0 / 3.0, -2.5e-7] {
        let number = question.clone().hold("top.z", value);
        let text = question.clone().hold("top.z", format!("{value:?}"));
        let held = |question: &Question| question.resolved().unwrap().held();
        assert_eq!(held(&number), held(&text));
    }
    let refused = question.hold("l1", f64::NAN).count().unwrap_err();
    assert!(matches!(refused, AskError::Named { .. }), "{refused:?}");
}

/// Compares everything that takes a mode with the list of assemblies at home.
fn compare(path: &Path, seed: u64) {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let mechanism = load(path);
    let question = Question::new(Arc::clone(&mechanism)).seed(seed);
    if question.count().is_err() {
        return;
    }
    let watch = &Watch::none();
    let report = question.assemblies(Default::default(), watch).unwrap();
    let turns = |joint: usize| mechanism.repeats(joint);
    let agree = |what: &str, assembly: &Assembly, joints: &[f64]| {
        for (joint, (value, (_, listed))) in joints.iter().zip(&assembly.joints.0).enumerate() {
            let apart = match turns(joint) {
                true => (0.5 * (value - listed)).sin().abs(),
                false => (value - listed).abs(),
            };
            let mode = assembly.mode;
            assert!(apart < 1e-6, "{name}, seed {seed}, {what}, mode {mode}");
        }
    };
    let driven = mechanism.joints().iter();
    let driven = driven.filter(|joint| joint.role == Role::Actuated);
    let moving = driven.fold(question.clone(), |question, joint| {
        let room = joint.limits.map_or(1.0, |(_, high)| high - joint.home);
        let end = joint.home + if room > 0.01 { 0.01 } else { -0.01 };
        question.input(&joint.name, joint.home, end)
    });
    let regular = report.assemblies.iter().filter(|a| a.multiplicity == 1);
    for assembly in regular {
        let number = Mode::Number(assembly.mode);
        let solved = (question.clone().mode(number)).solve(&AssemblySettings::default(), watch);
        let Ok(Solved::Ended(solved)) = solved else {
            panic!("{name}, mode {}: {solved:?}", assembly.mode);
        };
        agree("solve", assembly, &solved.configuration().joints);
        let moving = moving.clone().mode(number);
        match moving.motions(&SweepSettings::default(), watch) {
            Ok(motions) => agree("sweep", assembly, &motions.starts[0].1.joints),
            Err(error) => {
                assert!(matches!(error, AskError::NothingMoves { .. }), "{error}");
            }
        }
        let asked = question.clone().mode(number);
        match asked.singularities(&SingularitiesSettings::default(), watch) {
            Ok(answer) => {
                let report = answer.closed().unwrap();
                agree("singularities", assembly, &report.joints);
            }
            Err(error) => assert!(
                matches!(error, AskError::NothingToDrive | AskError::Question(_)),
                "{error}"
            ),
        }
    }
    let drives = mechanism.joints().iter().any(|j| j.role == Role::Actuated);
    if report.real > 0 && drives {
        let all = moving.mode(Mode::All);
        let all = all.motions(&SweepSettings::default(), watch).unwrap();
        assert_eq!(all.starts.len(), report.real);
        for (assembly, (mode, start)) in report.assemblies.iter().zip(&all.starts) {
            assert_eq!(*mode, Some(assembly.mode));
            agree("all modes", assembly, &start.joints);
        }
    }
}

#[test]
fn every_command_numbers_modes_alike() {
    for name in ["four_bar", "five_bar", "slider_crank", "chebyshev", "rssr"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
        for seed in 1..=3 {
            compare(&folder.join(format!("{name}.ron")), seed);
        }
    }
}

#[test]
#[ignore = "takes long: all shipped files with several seeds"]
fn every_command_numbers_modes_of_every_shipped_file_alike() {
    for path in shipped() {
        for seed in 1..=3 {
            compare(&path, seed);
        }
    }
}
