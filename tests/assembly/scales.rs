//! Mechanisms of other sizes: the number of assemblies does not depend on the unit of length, and what is guessed
//! decides only where to start.

use std::path::Path;

use linkwork::algebra::{Expression, Node, Operator};
use linkwork::analysis::assemblies::Wanted;
use linkwork::ask::Question;
use linkwork::description::{Description, Displacement, Entry, Role};
use linkwork::mechanism::{JointKind, Mechanism};
use linkwork::solve::Watch;

const SCALES: [f64; 4] = [1e-9, 1e-6, 1e3, 1e9];

pub fn files() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let within = |subfolder: &'static str| {
        let files = folder.join(subfolder).read_dir().unwrap();
        let files = files.map(|file| file.unwrap().path());
        files.filter(|path| path.is_file()).map(move |path| {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            format!("{subfolder}{name}")
        })
    };
    let mut names: Vec<String> = within("").chain(within("axes/")).collect();
    names.sort();
    names
}

pub fn read(name: &str) -> Description {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let mut description = Description::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    // printed in letters and numbers of the file's own size
    description.closed_forms.clear();
    description
}

fn number(value: f64) -> Expression {
    Expression::number(value)
}

fn binary(operator: Operator, x: Expression, y: Expression) -> Expression {
    Expression {
        node: Node::Binary(operator, Box::new(x), Box::new(y)),
        span: 0..0,
    }
}

/// The expression with every slide divided by the scale.
fn divided(x: &Expression, slides: &[String], scale: f64) -> Expression {
    let inside = |x: &Expression| divided(x, slides, scale);
    let node = match &x.node {
        Node::Name(name) if slides.contains(name) => {
            return binary(Operator::Divide, x.clone(), number(scale));
        }
        Node::Negate(x) => Node::Negate(Box::new(inside(x))),
        Node::Binary(operator, x, y) => {
            Node::Binary(*operator, Box::new(inside(x)), Box::new(inside(y)))
        }
        Node::Call(function, arguments) => {
            Node::Call(*function, arguments.iter().map(inside).collect())
        }
        other => other.clone(),
    };
    Expression { node, span: 0..0 }
}

/// The mechanism with all dimensions times a scale; with `homes` also the homes and limits of slides and the homes
/// of platforms.
fn scaled(description: &Description, scale: f64, homes: bool) -> Description {
    let own = Mechanism::new(description).unwrap();
    let slides = own
        .joints()
        .iter()
        .filter(|j| j.kind == JointKind::Prismatic);
    let slides: Vec<String> = slides.map(|joint| joint.name.clone()).collect();
    let times = |entry: &mut Entry| {
        let inside = divided(&entry.expression, &slides, scale);
        *entry = binary(Operator::Multiply, number(scale), inside).into();
    };
    let move_by = |steps: &mut Vec<Displacement>| {
        for step in steps {
            match step {
                Displacement::Translate(_, entry) => times(entry),
                Displacement::TranslateBy(entries) => entries.iter_mut().for_each(times),
                Displacement::Rotate(..) => {}
            }
        }
    };
    let mut made = description.clone();
    for chain in &mut made.chains {
        move_by(&mut chain.value.base);
        move_by(&mut chain.value.tip);
        for row in &mut chain.value.rows {
            times(&mut row.a);
            times(&mut row.d);
        }
    }
    for platform in &mut made.platforms {
        for frame in &mut platform.value.frames {
            move_by(&mut frame.value);
        }
        if homes {
            move_by(&mut platform.value.home);
        }
    }
    for closure in &mut made.closures {
        if let Some(length) = &mut closure.value.length {
            times(length);
        }
    }
    for joint in &mut made.joints {
        if homes && slides.contains(&joint.name.value) {
            times(&mut joint.value.home);
            if let Some((low, high)) = &mut joint.value.limits {
                times(low);
                times(high);
            }
        }
    }
    made
}

/// Real and complex assemblies, with driven slides held at this scale.
fn assemblies(description: &Description, scale: f64) -> [usize; 2] {
    let mechanism = Mechanism::new(description).unwrap();
    let driven = (mechanism.joints().iter())
        .filter(|joint| joint.role == Role::Actuated && joint.kind == JointKind::Prismatic);
    let driven: Vec<(String, f64)> = driven
        .map(|joint| (joint.name.clone(), scale * joint.home))
        .collect();
    let question = Question::new(mechanism);
    let question = (driven.into_iter()).fold(question, |q, (name, value)| q.hold(name, value));
    let report = question
        .assemblies(Wanted::default(), &Watch::none())
        .unwrap();
    [report.real, report.complex]
}

/// The numbers of assemblies that are not those of the file at its own size.
fn wrong(name: &str, scales: &[f64]) -> Vec<String> {
    let description = read(name);
    let own = assemblies(&description, 1.0);
    let mut wrong = Vec::new();
    for &scale in scales {
        // homes grow with the dimensions, then the dimensions alone
        let whole = assemblies(&scaled(&description, scale, true), 1.0);
        let alone = assemblies(&scaled(&description, scale, false), scale);
        for (found, which) in [(whole, "whole"), (alone, "dimensions alone")] {
            if found != own {
                wrong.push(format!(
                    "{name} times {scale:e}, {which}: {found:?} for {own:?}"
                ));
            }
        }
    }
    wrong
}

#[test]
fn assemblies_do_not_depend_on_the_unit_of_length() {
    for name in [
        "three_rps",
        "slider_crank",
        "planar_3rpr",
        "rssr",
        "five_bar_hand",
        "cylindrical_rpp",
    ] {
        assert_eq!(wrong(name, &[1e-9, 1e9]), Vec::<String>::new());
    }
    // two lengths that differ: another mechanism
    let other = scaled(&read("three_rps"), 1e-9, false);
    assert_eq!(assemblies(&other, 1.0)[0], 0);
}

#[test]
fn three_rps_of_nanometres_has_its_eight_assemblies() {
    let mechanism = |scale: f64| {
        let mut description = read("three_rps");
        for (name, value) in [("a", 0.5), ("b", 1.0)] {
            let value = format!("{}", value * scale);
            description = description.with_parameter(name, &value).unwrap();
        }
        Mechanism::new(&description).unwrap()
    };
    for scale in SCALES {
        let question = Question::new(mechanism(scale))
            .hold("l1", 2.0 / 3.0 * scale)
            .hold("l2", 0.6 * scale)
            .hold("l3", 0.75 * scale);
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        assert_eq!((report.real, report.complex), (8, 16), "{scale:e}");
        let length = report.characteristic_length / scale;
        assert!((length - 1.0).abs() < 1e-12, "{length}");
    }
    // out of reach at every scale
    for scale in SCALES {
        let question = ["l1", "l2", "l3"].iter().zip([3.0, 0.6, 0.75]);
        let question = question.fold(Question::new(mechanism(scale)), |q, (name, length)| {
            q.hold(*name, length * scale)
        });
        let report = question
            .assemblies(Wanted::default(), &Watch::none())
            .unwrap();
        assert_eq!(report.real, 0, "{scale:e}");
    }
}

/// All shipped files at all scales; minutes.
#[test]
#[ignore = "minutes"]
fn every_shipped_file_has_the_same_assemblies_at_every_scale() {
    let found: Vec<String> = files()
        .iter()
        .flat_map(|name| wrong(name, &SCALES))
        .collect();
    assert_eq!(found, Vec::<String>::new());
}
