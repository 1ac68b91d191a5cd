//! Solvers of random mechanisms keep to the branch that fine steps follow.
//!
//! `BRANCHES=25 cargo test --test generated branch` takes as many of each structure.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use linkwork::algebra::BATCH;
use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::analysis::solver::{Follower, solver, values};
use linkwork::ask;
use linkwork::description::Description;
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::solve::Watch;
use linkwork::system::{Coordinate, MotionTracker, Question};

use super::{
    From, all_c, all_rust, c_from, examples_file, folder, has_cc, judged, judged_with, rust_from,
};

/// Mechanisms of each structure, and inputs of each mechanism.
const EACH: usize = 2;
const INPUTS: usize = 200;

/// Numbers in (−1, 1) (Knuth's linear congruential generator).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn point(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| size * self.roll())
    }
}

/// Shipped files with the lengths that are varied.
const SHIPPED: [(&str, &[(&str, f64)]); 8] = [
    (
        "four_bar",
        &[("l0", 5.0), ("l1", 1.0), ("l2", 3.0), ("l3", 4.0)],
    ),
    ("five_bar", &[("g", 0.2), ("r", 0.3), ("c", 0.4)]),
    ("slider_crank", &[("r", 1.0), ("l", 3.0), ("e", 0.5)]),
    (
        "stephenson_six_bar",
        &[("a", 2.0), ("b", 5.0), ("c", 4.0), ("l", 2.0), ("r", 1.0)],
    ),
    (
        "watt_six_bar",
        &[("a1", 2.0), ("b1", 4.5), ("a2", 2.5), ("b2", 5.5)],
    ),
    (
        "planar_3rpr",
        &[
            ("a2x", 15.91),
            ("a3y", 10.0),
            ("b12", 17.04),
            ("b23", 16.54),
        ],
    ),
    ("three_rps", &[("b", 1.0), ("a", 0.5)]),
    (
        "rssr",
        &[("a", 0.2), ("c", 0.5), ("g", 0.6), ("h", 0.4), ("s", 0.8)],
    ),
];

fn shipped(name: &str, lengths: &[(&str, f64)], dice: &mut Dice) -> Option<Mechanism> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("mechanisms/{name}.ron"));
    let (_, mut description) = Mechanism::read(path).unwrap();
    for (length, value) in lengths {
        let value = value * (1.0 + 0.3 * dice.roll());
        description = description
            .with_parameter(length, &format!("{value:?}"))
            .unwrap();
    }
    Mechanism::new(&description).ok()
}

/// A platform on six legs with random balls: many of its configurations are close to singular ones.
fn platform(dice: &mut Dice) -> Mechanism {
    let base = [0; 6].map(|_| dice.point(1.0));
    let balls = [0; 6].map(|_| dice.point(0.65));
    let position = [dice.roll() * 0.3, dice.roll() * 0.3, 0.8];
    let [yaw, pitch, roll] = dice.point(0.7);
    let ((sy, cy), (sp, cp), (sr, cr)) = (yaw.sin_cos(), pitch.sin_cos(), roll.sin_cos());
    let rotation = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ];
    let (mut joints, mut chains) = (String::new(), String::new());
    let (mut frames, mut closures) = (String::new(), String::new());
    for (i, (a, b)) in base.iter().zip(&balls).enumerate() {
        let away = [0, 1, 2].map(|k| {
            let turned: f64 = (0..3).map(|c| rotation[k][c] * b[c]).sum();
            turned + position[k] - a[k]
        });
        let length = away.iter().map(|x| x * x).sum::<f64>().sqrt();
        write!(joints, "\"l{i}\": Actuated(home: {length:?}),").unwrap();
        write!(
            chains,
            "\"A{i}\": Chain(base: [T({:?}, {:?}, {:?})]),",
            a[0], a[1], a[2]
        )
        .unwrap();
        write!(frames, "\"B{i}\": [T({:?}, {:?}, {:?})],", b[0], b[1], b[2]).unwrap();
        write!(
            closures,
            "\"c{i}\": Distance(\"A{i}\", \"top.B{i}\", \"l{i}\"),"
        )
        .unwrap();
    }
    let [x, y, z] = position;
    let text = format!(
        "Mechanism(version: 1, name: \"platform\", convention: Modified, joints: {{{joints}}}, chains: {{{chains}}}, \
         platforms: {{\"top\": Platform(home: [T({x:?}, {y:?}, {z:?}), Rz({yaw:?}), Ry({pitch:?}), Rx({roll:?})], \
         frames: {{{frames}}})}}, closures: {{{closures}}})"
    );
    Mechanism::new(&Description::read(&text).unwrap()).unwrap()
}

/// All mechanisms that assemble, so many of each structure.
fn mechanisms() -> Vec<(String, Mechanism, Configuration<f64>)> {
    let each = std::env::var("BRANCHES").map_or(EACH, |each| each.parse().unwrap());
    let mut dice = Dice(35);
    let mut all = Vec::new();
    for structure in 0..=SHIPPED.len() {
        let mut found = 0;
        for _ in 0..100 * each {
            let (name, mechanism) = match SHIPPED.get(structure) {
                Some((name, lengths)) => (*name, shipped(name, lengths, &mut dice)),
                None => ("platform", Some(platform(&mut dice))),
            };
            let Some(mechanism) = mechanism else { continue };
            let question = Question::new(&mechanism);
            let settings = AssemblySettings::default();
            let start = assemble(&question, &settings, &Watch::none()).unwrap();
            if start.outcome != Outcome::Converged {
                continue;
            }
            let start = start.configuration();
            if solver(&question, &start, &[], None).is_err() {
                continue;
            }
            found += 1;
            all.push((format!("{name}_{found}"), mechanism, start));
            if found == each {
                break;
            }
        }
        assert_eq!(found, each);
    }
    all
}

/// The joints that are held.
fn held(mechanism: &Mechanism) -> Vec<usize> {
    let joints = Question::new(mechanism).held().joints;
    (0..joints.len()).filter(|joint| joints[*joint]).collect()
}

/// Moves a mechanism along straight paths of its inputs, in steps of so much in rad and characteristic lengths at most.
fn fine_steps<'m>(
    mechanism: &'m Mechanism,
    start: &Configuration<f64>,
    fine: f64,
) -> impl FnMut(&Configuration<f64>, &[f64]) -> Option<Configuration<f64>> + use<'m> {
    /// The farthest that an unknown moves in one.
    const FARTHEST: f64 = 0.02;
    let question = Question::new(mechanism);
    let (system, held) = (question.system(), held(mechanism));
    let scale = |joint: usize| Coordinate::Joint(joint).scale(mechanism);
    let mut tracker = MotionTracker::new(question.system(), start.clone());
    move |from, to| {
        tracker.restart(from);
        let ways = held.iter().zip(to);
        let way = ways.map(|(&joint, to)| (to - from.joints[joint]).abs() / scale(joint));
        let steps = (way.fold(0.0, f64::max) / fine).ceil().max(1.0);
        for step in 1..=steps as usize {
            let before = tracker.configuration().clone();
            let part = step as f64 / steps;
            let report = tracker.solve(|at| {
                for (&joint, to) in held.iter().zip(to) {
                    let from = from.joints[joint];
                    at.joints[joint] = if part < 1.0 {
                        from + part * (to - from)
                    } else {
                        *to
                    };
                }
            });
            let moved = system.difference(&before, tracker.configuration());
            if !report.solved || moved.iter().any(|x| x.abs() > FARTHEST) {
                return None;
            }
        }
        Some(tracker.configuration().clone())
    }
}

/// The largest difference of two configurations, in rad and characteristic lengths.
fn apart(mechanism: &Mechanism, a: &Configuration<f64>, b: &Configuration<f64>) -> f64 {
    let gaps = Question::new(mechanism).system().difference(a, b);
    gaps.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Configurations for random inputs, each followed in fine steps from the one before, there and back.
fn followed(
    mechanism: &Mechanism,
    start: &Configuration<f64>,
    count: usize,
) -> Vec<Configuration<f64>> {
    let held = held(mechanism);
    let scale = |joint: usize| Coordinate::Joint(joint).scale(mechanism);
    let mut go = fine_steps(mechanism, start, 1e-3);
    let mut dice = Dice(count as u64);
    let mut found = vec![start.clone()];
    for _ in 0..20 * count {
        let here = found.last().unwrap().clone();
        // from fine steps to ones that are long beside the distance to other branches
        let size = 10f64.powf(-1.5 + 1.2 * dice.roll());
        let to: Vec<f64> = (held.iter())
            .map(|&joint| {
                let to = here.joints[joint] + size * scale(joint) * dice.roll();
                let home = start.joints[joint];
                // lengths stay near those of the start
                let most = if scale(joint) == 1.0 { PI } else { 0.5 * home };
                let (low, high) =
                    (mechanism.joints()[joint].limits).unwrap_or((home - most, home + most));
                to.clamp(low, high)
            })
            .collect();
        let values: Vec<f64> = held.iter().map(|&joint| here.joints[joint]).collect();
        let Some(there) = go(&here, &to) else {
            continue;
        };
        let back = go(&there, &values);
        if back.is_some_and(|back| apart(mechanism, &here, &back) < 1e-9)
            && mechanism.outside_limits(&there.joints).next().is_none()
        {
            found.push(there);
        }
        if found.len() > count {
            break;
        }
    }
    found
}

#[test]
fn what_a_solver_finds_is_on_the_branch_that_fine_steps_follow() {
    let count = std::env::var("BRANCH_INPUTS").map_or(INPUTS, |count| count.parse().unwrap());
    let mechanisms = mechanisms();
    let mut solvers = Vec::new();
    let (mut rows, mut paths) = (Vec::new(), Vec::new());
    for (name, mechanism, start) in &mechanisms {
        let question = Question::new(mechanism);
        let mut path = followed(mechanism, start, count);
        // the same number for all, so that one program runs them
        assert!(path.len() > count / 4, "{name}: {}", path.len());
        let mut back = path.clone();
        back.reverse();
        while path.len() <= count {
            path.extend(back.iter().skip(1).cloned());
            back.reverse();
        }
        path.truncate(count + 1);
        let solver = solver(&question, start, &[], None).unwrap();
        rows.push(path[1..].iter().map(|at| values(&question, at)).collect());
        solvers.push((name.clone(), ask::Question::new(mechanism.clone()), solver));
        paths.push(path);
    }
    let folder = folder("branches");
    let data = folder.join("examples");
    examples_file(&rows, &data);
    judged(&all_rust(&folder, &solvers, count), &data, &solvers, 1e-9);
    if has_cc() {
        judged(&all_c(&folder, &solvers, count), &data, &solvers, 1e-9);
    }
    for ((name, mechanism, _), path) in mechanisms.iter().zip(&paths) {
        side_by_side(name, mechanism, path);
        row_by_row(name, mechanism, path);
    }
}

/// From its start a solver comes to no other branch than the straight path from the inputs of the start, however far
/// that leads: of two random assemblies at the same inputs one would be as near.
#[test]
fn a_solver_that_begins_at_its_start_keeps_to_the_branch_of_the_start() {
    let count = std::env::var("BRANCH_INPUTS").map_or(60, |count| count.parse().unwrap());
    let (mut solvers, mut rows) = (Vec::new(), Vec::new());
    for (name, mechanism, start) in mechanisms() {
        let held = held(&mechanism);
        let mut go = fine_steps(&mechanism, &start, 5e-3);
        let mut dice = Dice(7);
        let mut found = Vec::new();
        for _ in 0..20 * count {
            let to = held.iter().map(|&joint| {
                let home = start.joints[joint];
                let angle = Coordinate::Joint(joint).scale(&mechanism) == 1.0;
                let most = if angle { PI } else { 0.3 * home };
                let limits = mechanism.joints()[joint].limits;
                let (low, high) = limits.unwrap_or((home - most, home + most));
                (home + most * dice.roll()).clamp(low, high)
            });
            let Some(there) = go(&start, &to.collect::<Vec<f64>>()) else {
                continue;
            };
            let within = mechanism.outside_limits(&there.joints).next().is_none();
            let back: Vec<f64> = held.iter().map(|&joint| start.joints[joint]).collect();
            let back = go(&there, &back).filter(|_| within);
            if back.is_some_and(|back| apart(&mechanism, &start, &back) < 1e-9) {
                found.push(there);
            }
            if found.len() == count {
                break;
            }
        }
        if found.len() < count {
            // most straight paths from here end at a singular configuration
            continue;
        }
        let question = Question::new(&mechanism);
        rows.push(found.iter().map(|at| values(&question, at)).collect());
        let solver = solver(&question, &start, &[], None).unwrap();
        solvers.push((name, ask::Question::new(mechanism.clone()), solver));
    }
    assert!(solvers.len() > SHIPPED.len());
    let folder = folder("from_start");
    let data = folder.join("examples");
    examples_file(&rows, &data);
    let mut programs = vec![rust_from(From::Start, &folder, &solvers, count)];
    if has_cc() {
        programs.push(c_from(From::Start, &folder, &solvers, count));
    }
    for program in programs {
        judged_with(count / 20, &program, &data, &solvers, 1e-9);
    }
}

/// Side by side a long step is left to whoever asked for it, but none ends on another branch.
fn side_by_side(name: &str, mechanism: &Mechanism, path: &[Configuration<f64>]) {
    let (question, held) = (Question::new(mechanism), held(mechanism));
    let coordinates: Vec<Coordinate> = held.iter().map(|&j| Coordinate::Joint(j)).collect();
    let follower = Follower::new(&question, &path[0], &coordinates).unwrap();
    let mut motions = follower.motions(&path[0]);
    let mut solved = 0;
    for at in &path[1..] {
        let to: Vec<f64> = held.iter().map(|&joint| at.joints[joint]).collect();
        for (i, to) in to.iter().enumerate() {
            follower.values(&mut motions, i).fill(*to);
        }
        if follower.solve(&mut motions, &[true; BATCH])[0] {
            solved += 1;
            let found = follower.configuration(&motions, 0, &to);
            let apart = apart(mechanism, at, &found);
            assert!(apart < 1e-9, "{name}: {apart:e} apart");
        } else {
            (0..BATCH).for_each(|motion| follower.put(&mut motions, motion, at));
        }
    }
    assert!(
        5 * solved > path.len(),
        "{name}: {solved} of {}",
        path.len() - 1
    );
}

/// Rows that lie along a path are found on its branch.
fn row_by_row(name: &str, mechanism: &Mechanism, path: &[Configuration<f64>]) {
    /// After as many rows following begins again.
    const ROWS: usize = 200;
    let names: Vec<String> = (mechanism.joints().iter())
        .filter(|joint| joint.role == linkwork::description::Role::Actuated)
        .map(|joint| joint.name.clone())
        .collect();
    let held: Vec<usize> = names
        .iter()
        .map(|name| mechanism.joint(name).unwrap())
        .collect();
    let rows = &path[1..path.len().min(ROWS)];
    let inputs: Vec<f64> = (rows.iter())
        .flat_map(|at| held.iter().map(|&joint| at.joints[joint]))
        .collect();
    let question = ask::Question::new(mechanism.clone());
    let many = question
        .solve_many(&names, &inputs, &Watch::none())
        .unwrap();
    let width = many.names.len();
    let mut lost = 0;
    for (k, at) in rows.iter().enumerate() {
        if !many.reached[k] {
            lost += 1;
            continue;
        }
        for (joint, value) in at.joints.iter().enumerate() {
            let off = (many.values[k * width + joint] - value).abs();
            assert!(off < 1e-8, "{name}: row {k} is {off:e} off");
        }
    }
    assert!(20 * lost <= rows.len(), "{name}: {lost} rows not reached");
}
