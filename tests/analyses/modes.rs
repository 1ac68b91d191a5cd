//! One number of a mode means one configuration, whatever is asked of it.

use std::path::Path;
use std::sync::{Arc, Mutex};

use linkwork::analysis::assemblies::{Assembly, GenericSolutions};
use linkwork::analysis::assembly::AssemblySettings;
use linkwork::analysis::singularities::SingularitiesSettings;
use linkwork::analysis::sweep::SweepSettings;
use linkwork::ask::{AskError, Mode, Question, Solved, Store};
use linkwork::description::Description;
use linkwork::mechanism::{Mechanism, Role};
use linkwork::output::Report;
use linkwork::solve::Watch;

fn load(path: &Path) -> Arc<Mechanism> {
    Arc::new(linkwork::load(path).unwrap())
}

fn shipped() -> Vec<std::path::PathBuf> {
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let folders = [tables.join("axes"), tables];
    let files = folders.iter().flat_map(|of| std::fs::read_dir(of).unwrap());
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

/// Solutions kept in memory, as `--store` keeps them in a file.
#[derive(Default)]
struct Kept(Mutex<Option<GenericSolutions>>);

impl Store for Kept {
    fn known(&self) -> Result<Option<GenericSolutions>, String> {
        Ok(self.0.lock().unwrap().clone())
    }

    fn prepare(&self, _: bool) -> Result<(), String> {
        Ok(())
    }

    fn keep(&self, generic: &GenericSolutions) {
        *self.0.lock().unwrap() = Some(generic.clone());
    }
}

/// About how many modes of a mechanism are compared.
const MODES: usize = 4;

/// Of mechanisms with more complex solutions one seed is tried.
const MANY: usize = 30;

/// Compares everything that takes a mode with the list of assemblies at home; returns how many complex ones there are.
fn compare(path: &Path, seed: u64, store: Kept) -> usize {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let mechanism = load(path);
    let question = Question::new(Arc::clone(&mechanism)).seed(seed);
    let question = question.store(Arc::new(store));
    if question.count().is_err() {
        return 0;
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
    // of many modes the first, the last and some between
    let every = report.real.div_ceil(MODES).max(1);
    let last = report.real.saturating_sub(1);
    let some = regular.filter(|a| (a.mode - 1) % every == 0 || a.mode - 1 == last);
    for assembly in some {
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
    report.complex
}

#[test]
fn every_command_numbers_modes_of_every_shipped_file_alike() {
    for path in shipped() {
        for seed in 1..=2 {
            // every mode begins with the same search
            let solutions = compare(&path, seed, Kept::default());
            if solutions > MANY {
                break;
            }
        }
    }
}

/// A platform on a crank, its other end on a rod to the ground, with or without a leg of two links to a third point.
fn rodded(with_leg: bool) -> Mechanism {
    let (joints, chain, closure) = match with_leg {
        true => (
            r#""q1": Passive(), "q2": Passive(),"#,
            r#""leg": Chain(base: [T(1, -1, 0)], rows: [(theta: "q1"), (a: 1.5, theta: "q2")], tip: [Tx(1.5)]),"#,
            r#""C": Revolute("leg", "cup.C"),"#,
        ),
        false => ("", "", ""),
    };
    let text = format!(
        r#"Mechanism(version: 1, name: "cup", convention: Modified,
            joints: {{ "theta": Actuated(home: "60 deg"), {joints} }},
            chains: {{ "crank": Chain(rows: [(theta: "theta")], tip: [Tx(1)]),
                "anchor": Chain(base: [Tx(2)], rows: []), {chain} }},
            platforms: {{ "cup": Platform(home: [T(0.5, 0.8, 0)],
                frames: {{ "A": [], "B": [Tx(1)], "C": [T(0.5, 0.5, 0)] }}) }},
            closures: {{ "A": Revolute("crank", "cup.A"), "B": Distance("anchor", "cup.B", 1.2), {closure} }})"#
    );
    Mechanism::new(&Description::read(&text).unwrap())
        .unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// The rod places the platform in two ways, where two circles meet, and in each of them the leg's elbow has two more:
/// law of cosines.
#[test]
fn assemblies_that_share_a_pose_of_the_platform_are_listed_by_pose() {
    let all = |with_leg: bool| {
        let question = Question::new(rodded(with_leg));
        let report = question
            .assemblies(Default::default(), &Watch::none())
            .unwrap();
        let text = linkwork::output::text::render(&report.document());
        (report, text)
    };
    let (report, text) = all(true);
    assert_eq!((report.real, report.poses.len()), (4, 2));
    let (crank, anchor) = ([0.5, 0.75f64.sqrt()], [2.0, 0.0]);
    let apart = [anchor[0] - crank[0], anchor[1] - crank[1]];
    let distance = apart[0].hypot(apart[1]);
    let between = ((1.0 + distance * distance - 1.44) / (2.0 * distance)).acos();
    let bearing = apart[1].atan2(apart[0]);
    for (modes, yaw) in report
        .poses
        .iter()
        .zip([bearing - between, bearing + between])
    {
        assert_eq!(modes.len(), 2);
        let reach = {
            let [c, s] = [yaw.cos(), yaw.sin()];
            let at = [crank[0] + 0.5 * (c - s), crank[1] + 0.5 * (s + c)];
            (at[0] - 1.0).hypot(at[1] + 1.0)
        };
        let elbow = (reach * reach / 4.5 - 1.0).acos();
        let mut elbows = Vec::new();
        for mode in modes {
            let assembly = &report.assemblies[mode - 1];
            let pose = assembly.platforms.get("cup").unwrap();
            assert!((pose.roll_pitch_yaw[2] - yaw).abs() < 1e-9, "{mode}: {yaw}");
            let q2 = *assembly.joints.get("q2").unwrap();
            assert!((q2.abs() - elbow).abs() < 1e-9, "{mode}: {elbow}");
            elbows.push(q2 > 0.0);
        }
        assert_ne!(elbows[0], elbows[1]);
    }
    let rows: Vec<Vec<&str>> = text
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    let title = rows
        .iter()
        .position(|row| row.first() == Some(&"pose"))
        .unwrap();
    assert!(
        text.contains("Assemblies by the 2 poses of the platforms"),
        "{text}"
    );
    assert_eq!(
        (rows[title + 1][..2].to_vec(), rows[title + 2][..2].to_vec()),
        (vec!["1", "2"], vec!["2", "2"])
    );
    // each pose of its own: a row for each assembly as ever
    let (report, text) = all(false);
    assert_eq!(report.poses, [[1], [2]]);
    assert!(
        !text.contains("poses of the platforms")
            && !text
                .lines()
                .any(|line| line.trim_start().starts_with("pose"))
    );
}

/// The configuration in which an analysis is made is that of the mode asked for, as `assemblies` has it.
#[test]
fn a_mode_is_the_same_configuration_for_mobilities() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let watch = &Watch::default();
    let asked = Question::new(load(&folder.join("four_bar.ron"))).hold("theta1", "60 deg");
    let all = asked.assemblies(Default::default(), watch).unwrap();
    assert_eq!(all.real, 2);
    for known in &all.assemblies {
        let asked = asked.clone().mode(Mode::Number(known.mode));
        let report = asked.mobility(watch).unwrap().closed().unwrap();
        let [at, wanted] = [&report.joints, &known.joints].map(|of| *of.get("phi1").unwrap());
        assert!((at - wanted).abs() < 1e-9, "{at} is not {wanted}");
    }
    let third = asked.clone().mode(Mode::Number(3)).velocity(watch);
    assert!(
        matches!(third, Err(AskError::NoSuchMode { .. })),
        "{third:?}"
    );
    let every = asked.mode(Mode::All).statics(watch);
    assert!(matches!(every, Err(AskError::AllModes)), "{every:?}");
}

#[test]
fn a_demand_that_an_analysis_would_not_use_is_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let watch = &Watch::default();
    let asked = Question::new(load(&folder.join("four_bar.ron")));
    let (locked, moved) = (
        asked.clone().lock("phi1"),
        asked.clone().input("theta1", 0.0, 1.0),
    );
    let (dwells, loaded) = (
        asked.clone().dwell("phi1", 0.1),
        asked.clone().load("phi1", 2.0),
    );
    let settings = SingularitiesSettings::default();
    for error in [
        locked.solve(&AssemblySettings::default(), watch).err(),
        moved.solve(&AssemblySettings::default(), watch).err(),
        moved.singularities(&settings, watch).err(),
        dwells.velocity(watch).err(),
        loaded.velocity(watch).err(),
        loaded.circuits(watch).err(),
    ] {
        let refused = matches!(error, Some(AskError::Unused { .. }));
        assert!(refused, "{error:?}");
    }
    // where they are used they are taken
    assert!(locked.mobility(watch).is_ok() && loaded.statics(watch).is_ok());
    assert!(moved.along(&settings, watch).is_ok());
}
