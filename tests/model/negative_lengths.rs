//! The advice on a negative link length, followed to the letter.

use std::path::Path;

use linkwork::algebra::{Expression, Node};
use linkwork::description::{Axis, Convention, Description, Displacement, Entry, ProblemKind};
use linkwork::geometry::Pose;
use linkwork::mechanism::{Configuration, Frame, Mechanism};

fn shipped() -> Vec<(String, Description)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let files = folder.read_dir().unwrap().map(|file| file.unwrap().path());
    let mut files: Vec<_> = files.filter(|path| path.is_file()).collect();
    files.sort();
    let read = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        (name, Description::read(&text).unwrap())
    };
    files.iter().map(read).collect()
}

fn negated(entry: &Entry) -> Entry {
    Expression {
        node: Node::Negate(Box::new(entry.expression.clone())),
        span: 0..0,
    }
    .into()
}

fn turned(entry: &Entry) -> Entry {
    let text = format!("{} + 180 deg", entry.expression);
    Expression::parse(&text).unwrap().into()
}

fn half_turn() -> Displacement {
    Displacement::Rotate(Axis::Z, Entry::angle(std::f64::consts::PI))
}

/// Every instruction of the help, in its own words, and no other.
fn follow(help: &str, description: &mut Description, chain: usize) {
    let says = |what: &str| help.contains(what);
    let names: Vec<String> = description
        .chains
        .iter()
        .map(|c| c.name.value.clone())
        .collect();
    for row in 1..=description.chains[chain].value.rows.len() {
        let of = &mut description.chains[chain].value.rows[row - 1];
        if says(&format!("change the signs of a and alpha of row {row}")) {
            (of.a, of.alpha) = (negated(&of.a), negated(&of.alpha));
        }
        if says(&format!("add 180 deg to theta of row {row}")) {
            of.theta = turned(&of.theta);
        }
    }
    let of = &mut description.chains[chain].value;
    if says("add `Rz(180 deg)` at the end of `base`") {
        of.base.push(half_turn());
    }
    if says("add `Rz(180 deg)` at the beginning of `tip`") {
        of.tip.insert(0, half_turn());
    }
    if let Some((_, on_it)) = help.split_once("at the beginning of `base` of ") {
        for (i, name) in names.iter().enumerate() {
            if on_it.contains(&format!("`{name}`")) {
                description.chains[i].value.base.insert(0, half_turn());
            }
        }
    }
}

/// Poses of all frames, with joints away from home.
fn poses(mechanism: &Mechanism) -> Vec<(Frame, Pose<f64>)> {
    let mut at: Configuration<f64> = mechanism.home();
    for (i, q) in at.joints.iter_mut().enumerate() {
        *q += 0.3 + 0.1 * i as f64;
    }
    let frames = mechanism.frames().into_iter();
    frames
        .map(|frame| (frame, mechanism.transform(Frame::Ground, frame, &at)))
        .collect()
}

/// The frames that two mechanisms have in different places.
fn differing(a: &Mechanism, b: &Mechanism) -> Vec<Frame> {
    let size = a.characteristic_length();
    let pairs = poses(a).into_iter().zip(poses(b));
    let apart = |(a, b): (&Pose<f64>, &Pose<f64>)| {
        let position = (a.position - b.position).norm() / size;
        let axes = (0..3).map(|i| (a.rotation.0[i] - b.rotation.0[i]).norm());
        axes.fold(position, f64::max) > 1e-9
    };
    pairs
        .filter(|((_, a), (_, b))| apart((a, b)))
        .map(|((frame, _), _)| frame)
        .collect()
}

#[test]
fn the_advice_gives_the_same_mechanism_with_a_positive_length() {
    let (mut followed, mut left) = (0, 0);
    for (file, description) in shipped() {
        let standard = |chain: usize| {
            let own = description.chains[chain].value.convention.as_ref();
            let convention = own.or(description.convention.as_ref());
            convention.is_some_and(|c| c.value == Convention::Standard)
        };
        for chain in 0..description.chains.len() {
            for row in 0..description.chains[chain].value.rows.len() {
                let mut negative = description.clone();
                let a = &mut negative.chains[chain].value.rows[row].a;
                *a = negated(a);
                let before = Mechanism::new(&negative).unwrap();
                let name = before.chains()[chain].name.clone();
                let about = |kind: &&ProblemKind| matches!(kind, ProblemKind::NegativeLinkLength { chain, row: r, .. } if *chain == name && *r == row + 1);
                let kinds: Vec<ProblemKind> =
                    before.warnings().iter().map(|w| w.kind.clone()).collect();
                let Some(kind) = kinds.iter().find(about) else {
                    continue;
                };
                let help = kind.help().unwrap();
                if !help.contains("to make it positive") {
                    left += 1;
                    continue;
                }
                let mut positive = negative.clone();
                follow(&help, &mut positive, chain);
                let after = Mechanism::new(&positive).unwrap();
                assert!(
                    !after.warnings().iter().any(|w| about(&&w.kind)),
                    "{file}: {help}"
                );
                // only the frame whose x axis turns is another
                let turning = Frame::Link {
                    chain,
                    row: if standard(chain) { row + 1 } else { row },
                };
                let differ = differing(&before, &after);
                assert_eq!(
                    differ,
                    [turning],
                    "{file}, row {} of {name}: {help}",
                    row + 1
                );
                // without the neighbour it is another mechanism
                let mut half = negative.clone();
                let of = &mut half.chains[chain].value.rows[row];
                (of.a, of.alpha, of.theta) =
                    (negated(&of.a), negated(&of.alpha), turned(&of.theta));
                let half = Mechanism::new(&half).unwrap();
                assert!(
                    differing(&before, &half).len() > 1,
                    "{file}, row {}",
                    row + 1
                );
                followed += 1;
            }
        }
    }
    assert!(
        followed > 40 && left > 0,
        "{followed} followed, {left} left"
    );
}
