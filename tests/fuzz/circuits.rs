//! Circuits of random planar linkages with one freedom, made of random points.

use std::f64::consts::{PI, TAU};

use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::sweep::{CircuitsReport, FourBarClass};
use linkwork::ask::Question;
use linkwork::solve::Watch;

use crate::generator::Dice;
use crate::invariants::{Broken, Budget, mobility, read};

type Point = [f64; 2];

fn distance(a: Point, b: Point) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

fn angle(a: Point, b: Point) -> f64 {
    (b[1] - a[1]).atan2(b[0] - a[0])
}

/// A point in the frame at another one, turned by an angle.
fn seen(from: Point, turned: f64, to: Point) -> Point {
    let (x, y, (sin, cos)) = (to[0] - from[0], to[1] - from[1], turned.sin_cos());
    [cos * x + sin * y, cos * y - sin * x]
}

/// A linkage with the input q0, and after how many turns of it everything is where it was.
struct Linkage {
    text: String,
    turns: f64,
    /// Ground, crank, coupler and rocker of a 4-bar.
    lengths: Option<[f64; 4]>,
}

/// With `width` 0 all its points lie on one line.
fn linkage(dice: &mut Dice, width: f64) -> Linkage {
    let mut point = |reach: f64| [reach * dice.signed(), width * reach * dice.signed()];
    let (ground, a, b) = (point(2.0), point(1.5), point(2.0));
    let (c, d, second) = (point(2.0), point(2.0), point(2.0));
    let origin = [0.0; 2];
    let crank = angle(origin, a);
    let coupler = angle(a, b);
    let rocker = angle(ground, b);
    let first = format!(
        r#""A": Chain(rows: [(theta: "q0"), (a: {:?}, theta: "q1")], tip: [Tx({:?})])"#,
        distance(origin, a),
        distance(a, b)
    );
    let base = |at: Point| format!("[T({:?}, {:?}, 0)]", at[0], at[1]);
    let second_crank = |ratio: &str, length: f64, tip: f64| {
        format!(
            r#""B": Chain(base: {}, rows: [(theta: "{ratio}"), (a: {length:?}, theta: "q2")], tip: [Tx({tip:?})])"#,
            base(ground)
        )
    };
    let (homes, chains, closures, turns, lengths) = match dice.below(5) {
        0 | 1 => {
            let lengths = [
                distance(origin, ground),
                distance(origin, a),
                distance(a, b),
                distance(ground, b),
            ];
            let rocking = format!(
                r#""B": Chain(base: {}, rows: [(theta: "q2")], tip: [Tx({:?})])"#,
                base(ground),
                lengths[3]
            );
            let homes = vec![crank, coupler - crank, rocker];
            (
                homes,
                vec![first, rocking],
                vec![("A", "B")],
                1.0,
                Some(lengths),
            )
        }
        2 => {
            // a 5-bar whose cranks are geared: the second one stands at d
            let (over, under) = dice.pick(&[(1, 2), (-1, 2), (2, 3), (3, 2), (-1, 3), (2, 1)]);
            let turned = angle(ground, d);
            let offset = turned - crank * f64::from(over) / f64::from(under);
            let ratio = format!("{over}*q0/{under} + {offset:?}");
            let geared = second_crank(&ratio, distance(ground, d), distance(d, b));
            let homes = vec![crank, coupler - crank, angle(d, b) - turned];
            (
                homes,
                vec![first, geared],
                vec![("A", "B")],
                f64::from(under),
                None,
            )
        }
        kind => {
            // a dyad c d from the coupler or from the rocker to ground
            let (on, from, turned) = match kind {
                3 => ("A.2", a, coupler),
                _ => ("B.1", ground, rocker),
            };
            let rocking = format!(
                r#""B": Chain(base: {}, rows: [(theta: "q2")], tip: [Tx({:?})])"#,
                base(ground),
                distance(ground, b)
            );
            let dyad = format!(
                r#""C": Chain(on: "{on}", base: {}, rows: [(theta: "q3")], tip: [Tx({:?})])"#,
                base(seen(from, turned, c)),
                distance(c, d)
            );
            let last = format!(
                r#""D": Chain(base: {}, rows: [(theta: "q4")], tip: [Tx({:?})])"#,
                base(second),
                distance(second, d)
            );
            let homes = vec![
                crank,
                coupler - crank,
                rocker,
                angle(c, d) - turned,
                angle(second, d),
            ];
            let closures = vec![("A", "B"), ("C", "D")];
            (homes, vec![first, rocking, dyad, last], closures, 1.0, None)
        }
    };
    let joints = homes.iter().enumerate().map(|(i, home)| {
        let role = if i == 0 { "Actuated" } else { "Passive" };
        let home = home - TAU * (home / TAU).round();
        format!(r#""q{i}": {role}(home: {home:?})"#)
    });
    let joints: Vec<String> = joints.collect();
    let closures = closures.iter().enumerate();
    let closures = closures.map(|(i, (a, b))| format!(r#""k{i}": Revolute("{a}", "{b}")"#));
    let closures: Vec<String> = closures.collect();
    let text = format!(
        r#"Mechanism(version: 1, name: "linkage", convention: Modified, joints: {{ {} }}, chains: {{ {} }}, closures: {{ {} }})"#,
        joints.join(", "),
        chains.join(", "),
        closures.join(", ")
    );
    Linkage {
        text,
        turns,
        lengths,
    }
}

/// How often circuits pass a value of the input, from the ranges of their branches.
fn passes(report: &CircuitsReport, value: f64, period: f64) -> usize {
    let circuits = report.circuits.iter().map(|circuit| {
        let branches = circuit.branches.iter().map(|branch| match branch.turns {
            true => (circuit.joints[0].turns.unsigned_abs() as f64 * TAU / period).round() as usize,
            false => {
                let [low, high] = [branch.low, branch.high].map(|end| (end - value) / period);
                (high.floor() - low.floor()) as usize
            }
        });
        branches.sum::<usize>()
    });
    circuits.sum()
}

/// Circuits are whole, as many as Grashof says, and pass each value of the input as often as there are assemblies.
pub fn check(seed: u64) -> Result<(), (String, String)> {
    let linkage = linkage(&mut Dice::new(seed), 1.0);
    kept(&linkage, seed).map_err(|broken| (broken, linkage.text))
}

fn kept(linkage: &Linkage, seed: u64) -> Broken {
    let question = Question::new(read(&linkage.text)?);
    let report = question.circuits(&Watch::none());
    let report = report.map_err(|e| format!("circuits: {e}"))?;
    if !report.is_whole() {
        return Err(format!("circuits may be missing: {:?}", report.swept));
    }
    if let Some(mut lengths) = linkage.lengths {
        let class = report.class.ok_or("a 4-bar without a class")?;
        lengths.sort_by(f64::total_cmp);
        let grashof = lengths[0] + lengths[3] < lengths[1] + lengths[2];
        if report.circuits.len() != 1 + usize::from(grashof)
            || grashof == (class == FourBarClass::TripleRocker)
        {
            return Err(format!(
                "{} circuits, {class:?}: {lengths:?}",
                report.circuits.len()
            ));
        }
    }
    let mut dice = Dice::new(!seed);
    let period = linkage.turns * TAU;
    for _ in 0..3 {
        let value = PI * dice.signed();
        let wanted = Wanted {
            certificates: false,
            ..Wanted::default()
        };
        let held = question.clone().hold("q0", value);
        let found = held.assemblies(wanted, &Watch::none());
        let found = found.map_err(|e| format!("assemblies: {e}"))?.real;
        let passes = passes(&report, value, period);
        if passes != found {
            return Err(format!(
                "q0 = {value}: {found} assemblies, passed {passes} times"
            ));
        }
    }
    Ok(())
}

/// Freedoms add up at and beside singular poses: dead points of the input, and poses in which all bars lie on one line.
pub fn check_singular(seed: u64) -> Result<(), (String, String)> {
    let flat = linkage(&mut Dice::new(seed), 0.0);
    let bent = linkage(&mut Dice::new(seed), 1.0);
    beside_dead_points(&bent, seed).map_err(|broken| (broken, bent.text))?;
    beside_home(&flat).map_err(|broken| (broken, flat.text))
}

/// Distances from a singular pose.
const BESIDE: [f64; 6] = [0.0, 1e-1, 1e-3, 1e-5, 1e-7, 1e-9];

/// Answers are given up after as many calls of a watch.
const BUDGET: Budget = Budget { steps: 20_000 };

fn beside_home(linkage: &Linkage) -> Broken {
    let mechanism = read(&linkage.text)?;
    for (joint, home) in mechanism.home().joints.iter().enumerate() {
        let name = mechanism.joints()[joint].name.as_str();
        for distance in BESIDE {
            let question = Question::new(mechanism.clone()).hold(name, home + distance);
            mobility(&question, &BUDGET)
                .map_err(|e| format!("{name} at home + {distance:e}: {e}"))?;
        }
    }
    Ok(())
}

fn beside_dead_points(linkage: &Linkage, seed: u64) -> Broken {
    let mechanism = read(&linkage.text)?;
    let question = Question::new(mechanism.clone());
    let report = question.circuits(&Watch::none());
    let report = report.map_err(|e| format!("circuits: {e}"))?;
    let circuits = report.circuits.iter().filter(|of| !of.branches[0].turns);
    // one of them, for each takes its time
    let circuits: Vec<_> = circuits.collect();
    let Some(circuit) = circuits.get(seed as usize % circuits.len().max(1)) else {
        return Ok(());
    };
    let inward = |row: &&Vec<f64>| row[0];
    let lowest = circuit
        .course
        .iter()
        .min_by(|a, b| inward(a).total_cmp(&inward(b)));
    let row = lowest.ok_or("a circuit without a course")?;
    let low = circuit.branches.iter().map(|of| of.low);
    let low = low.fold(f64::INFINITY, f64::min);
    for distance in BESIDE {
        // the others are as far away as its square root
        let value = low + distance * distance;
        let names = mechanism.joints().iter().map(|joint| &joint.name);
        let guessed = names.zip(row).skip(1);
        let near = guessed.fold(question.clone().hold("q0", value), |question, (name, x)| {
            question.guess(name, *x)
        });
        mobility(&near, &BUDGET).map_err(|e| format!("dead point + {distance:e}: {e}"))?;
    }
    Ok(())
}
