//! Mechanisms far from the origin of ground: what is asked of them has the answers that it has at the origin.

use std::path::Path;

use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::assembly::{AssemblySettings, Outcome};
use linkwork::analysis::sweep::FourBarClass;
use linkwork::ask::{Question, Solved};
use linkwork::description::{ChainDescription, Description, Displacement, Entry, Named, Spanned};
use linkwork::geometry::Axis;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Analysed;

use crate::scales::{files, read};

/// Everything on ground displaced and turned, as by a first step of every base.
fn moved(description: &Description, by: [f64; 3]) -> Description {
    placed(description, by, [0.0, 0.7, -0.4])
}

/// As [`moved`], turned by these angles about y, z and x.
fn placed(description: &Description, by: [f64; 3], [y, z, x]: [f64; 3]) -> Description {
    let steps = || {
        [
            Displacement::TranslateBy(by.map(Entry::length)),
            Displacement::Rotate(Axis::Y, Entry::angle(y)),
            Displacement::Rotate(Axis::Z, Entry::angle(z)),
            Displacement::Rotate(Axis::X, Entry::angle(x)),
        ]
    };
    let mut made = description.clone();
    let stays = |on: &Option<Spanned<String>>| on.as_ref().is_none_or(|on| on.value == "ground");
    for chain in made.chains.iter_mut().filter(|c| stays(&c.value.on)) {
        chain.value.base.splice(0..0, steps());
    }
    for platform in &mut made.platforms {
        platform.value.home.splice(0..0, steps());
    }
    let joined = (made.closures.iter_mut()).flat_map(|closure| &mut closure.value.frames);
    let mut on_ground = joined.filter(|frame| frame.value == "ground").peekable();
    if on_ground.peek().is_some() {
        on_ground.for_each(|frame| frame.value = "moved ground".into());
        made.chains.push(Named {
            name: Spanned::nowhere("moved ground".into()),
            value: ChainDescription::frame("ground", steps().into()),
        });
    }
    made
}

/// What does not depend on where ground has its origin.
#[derive(Debug, PartialEq)]
struct Answers {
    /// Real and complex assemblies.
    assemblies: [usize; 2],
    /// Mobility, infinitesimal freedoms and rank; none if it does not close.
    mobility: Option<[usize; 3]>,
    /// Circuits and the class of a 4-bar, if one freedom is left.
    circuits: Option<(usize, Option<FourBarClass>)>,
    /// Names of what moves although the inputs are held.
    moving: Vec<String>,
}

fn answers(description: &Description) -> (Answers, Mechanism) {
    let mechanism = Mechanism::new(description).unwrap();
    let question = Question::new(mechanism.clone());
    let watch = Watch::none();
    let all = question.assemblies(Wanted::default(), &watch).unwrap();
    let mobility = match question.mobility(&watch).unwrap() {
        Analysed::Closed(report) => Some([report.mobility, report.infinitesimal, report.rank]),
        _ => None,
    };
    let circuits = question.circuits(&watch).ok();
    let moving = match question.solve(&AssemblySettings::default(), &watch) {
        Ok(Solved::Ended(report)) => match report.outcome {
            Outcome::Singular { moving, .. } => moving,
            _ => Vec::new(),
        },
        _ => Vec::new(),
    };
    let answers = Answers {
        assemblies: [all.real, all.complex],
        mobility,
        circuits: circuits.map(|report| (report.circuits.len(), report.class)),
        moving,
    };
    (answers, mechanism)
}

/// What differs between a file and the same so many of its sizes away.
fn differences(name: &str, sizes: &[f64]) -> Vec<String> {
    let description = read(name);
    let (own, mechanism) = answers(&description);
    let length = mechanism.characteristic_length();
    let mut wrong = Vec::new();
    for &away in sizes {
        let by = [0.8, -0.5, 0.3].map(|part| part * away * length);
        let (found, there) = answers(&moved(&description, by));
        if found != own {
            wrong.push(format!(
                "{name}, {away:e} sizes away: {found:?} for {own:?}"
            ));
        }
        let ratio = there.characteristic_length() / length;
        if (ratio - 1.0).abs() > 1e-8 {
            wrong.push(format!(
                "{name}, {away:e} sizes away: normalised by {ratio} times the length"
            ));
        }
    }
    wrong
}

#[test]
fn a_platform_kilometres_from_the_origin_has_the_assemblies_it_has_there() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let text = std::fs::read_to_string(folder.join("platform_10_km_away.ron")).unwrap();
    for (x, real) in [("0.0", 2), ("2000.0", 2), ("10000.0", 2)] {
        let text = text.replace("10000.0", x);
        let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
        let question = Question::new(mechanism.clone());
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        // a generic platform on six rods has 40 (Lazard 1993, Mourrain 1993)
        assert_eq!((report.real, report.complex), (real, 40), "at {x} m");
        // its poses are given in ground
        for assembly in &report.assemblies {
            let [of, ..] = assembly.platforms.values().next().unwrap().position;
            assert!((of - x.parse::<f64>().unwrap()).abs() < 3.0, "{of}");
        }
        // it closes at home, and its frames are in ground
        let closed = question.closed(&Watch::none()).unwrap().closed().unwrap();
        let pose = mechanism.pose("top.B0", &closed.configuration).unwrap();
        assert!((pose.position.0[0] - x.parse::<f64>().unwrap()).abs() < 3.0);
    }
    // a rod too long for any pose
    let long = text.replace("0.508186443720726", "90.0");
    let mechanism = Mechanism::new(&Description::read(&long).unwrap()).unwrap();
    let report = Question::new(mechanism)
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap();
    assert_eq!(report.real, 0);
}

#[test]
fn a_four_bar_far_away_has_its_two_circuits() {
    // 1, 3, 4 and 5 m: the shortest and the longest are as long as 6 m, the others 7 m, and the shortest turns (Grashof)
    let four_bar = |x: f64| {
        let base = |x: f64| format!("[T({x:?}, 0, 0)]");
        format!(
            "Mechanism(version: 1, name: \"four-bar\", convention: Modified, joints: {{ \
             \"t\": Actuated(home: 1.0), \"f\": Passive(home: -0.2), \"s\": Passive(home: 2.25) }}, chains: {{ \
             \"L\": Chain(base: {}, rows: [(theta: \"t\"), (a: 1, theta: \"f\")], tip: [Tx(3)]), \
             \"R\": Chain(base: {}, rows: [(theta: \"s\")], tip: [Tx(4)]) }}, \
             closures: {{ \"k\": Revolute(\"L\", \"R\") }})",
            base(x),
            base(x + 5.0)
        )
    };
    for x in [0.0, 1e5, 1e7] {
        let mechanism = Mechanism::new(&Description::read(&four_bar(x)).unwrap()).unwrap();
        let question = Question::new(mechanism);
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        assert_eq!((report.real, report.complex), (2, 2), "at {x} m");
        let circuits = question.circuits(&Watch::none()).unwrap();
        assert_eq!(circuits.circuits.len(), 2, "at {x} m");
    }
}

#[test]
fn shipped_files_have_the_same_answers_far_away() {
    for name in [
        "four_bar",
        "three_rps",
        "planar_3rpr",
        "delta",
        "axes/four_bar",
        "watt_linkage",
        "two_rhombi",
    ] {
        assert_eq!(differences(name, &[1e3, 1e6]), Vec::<String>::new());
    }
}

/// How a loop lies in ground does not matter: bodies that stay in a plane do so in a tilted one.
#[test]
fn tilted_loops_have_the_assemblies_and_multiplicities_of_level_ones() {
    let listed = |description: &Description| {
        let question = Question::new(Mechanism::new(description).unwrap());
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        let all = report.assemblies.iter();
        let multiplicities: Vec<usize> = all.map(|of| of.multiplicity).collect();
        let how = (report.fit, report.bound, report.search.general);
        (report.real, report.complex, multiplicities, how)
    };
    let poses = [
        ([3.1, -2.2, 1.7], [-0.4, 1.9, 0.7]),
        ([-0.3, 12.0, 0.1], [2.9, -1.3, 0.2]),
        ([0.0; 3], [0.5, 0.0, -2.2]),
    ];
    for name in [
        "flat_triangle",
        "triangle",
        "parallelogram",
        "slider_crank",
        "spherical_four_bar",
        "stephenson_six_bar",
        "planar_3rpr",
    ] {
        let level = read(name);
        let own = listed(&level);
        for (by, turned) in poses {
            let found = listed(&placed(&level, by, turned));
            assert_eq!(found, own, "{name} at {by:?} turned by {turned:?}");
        }
    }
    // two circles that touch meet in one point, which counts twice
    let (real, complex, multiplicities, _) = listed(&read("flat_triangle"));
    assert_eq!((real, complex, multiplicities), (1, 2, vec![2]));
}

#[test]
fn numbers_that_keep_few_digits_are_said_to() {
    let warned = |away: f64| {
        let made = moved(&read("three_rps"), [away, 0.0, 0.0]);
        !Mechanism::new(&made).unwrap().warnings().is_empty()
    };
    assert_eq!(
        [0.0, 100.0, 1e4, 1e6].map(warned),
        [false, false, true, true]
    );
}

/// All shipped files at all distances; minutes.
#[test]
#[ignore = "minutes"]
fn every_shipped_file_has_the_same_answers_far_away() {
    let found: Vec<String> = (files().iter())
        .flat_map(|name| differences(name, &[1e3, 1e4, 1e5, 1e6]))
        .collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn positions_that_are_held_far_away_are_no_lengths_of_the_mechanism() {
    let made = Mechanism::new(&moved(&read("three_rps"), [65536.0, 0.0, 16384.0])).unwrap();
    let held = (Question::new(made.clone()).free("actuated")).hold("top.x", 65536.2);
    let moved = (Question::new(made.clone()).free("actuated")).input("top.z", 16384.5, 16384.6);
    for question in [held, moved] {
        let length = question.mechanism().characteristic_length();
        assert_eq!(length, made.characteristic_length());
    }
    // one that is held 100 m from where the mechanism is
    let away = (Question::new(made.clone()).free("actuated")).hold("top.x", 65636.0);
    assert!(away.mechanism().characteristic_length() > 50.0);
}
