//! Assembled configurations to begin with.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::asked::{Asked, Targets};
use super::grid::Grid;
use super::step::{Measure, Steps};
use crate::mechanism::{Configuration, PlatformPose};
use crate::solve::{Equations, Stop, each};
use crate::system::{System, Walk, Work, random_configuration, with_coordinates};

/// What was found at the nodes that were searched.
pub(super) struct Sown {
    pub seeds: Vec<(usize, Configuration<f64>)>,
    /// Assembled configurations with a joint outside its limits, which are no seeds.
    pub outside: usize,
}

#[derive(Clone)]
struct Storage {
    targets: Targets,
    system: System<f64>,
    work: Work<f64>,
    steps: Steps<f64>,
}

/// Newton's method from random starts at each of some nodes; and from what is given.
pub(super) fn sow(
    asked: &Asked,
    grid: &Grid,
    measure: &Measure,
    (nodes, starts, seed): (&[usize], usize, u64),
    given: &[Configuration<f64>],
) -> Sown {
    let system = asked.question.system();
    let storage = Storage {
        targets: Targets::new(asked),
        work: system.work(),
        system,
        steps: Steps::new(asked),
    };
    let found = each(nodes.len(), &storage, |storage, i| {
        let node = nodes[i];
        // each node draws for itself, so that threads do not matter
        let mut rng = Pcg64Mcg::seed_from_u64(seed.wrapping_add(node as u64));
        let values = grid.values(node);
        let around = asked.at(&values).start();
        let mut found: Vec<Configuration<f64>> = Vec::new();
        for k in 0..starts {
            let at = match k {
                0 => around.clone(),
                _ => random_configuration(asked.mechanism, &around, &mut rng),
            };
            take(asked, measure, storage, &values, at, &mut found);
        }
        (node, found)
    });
    let mut sown = Sown {
        seeds: Vec::new(),
        outside: 0,
    };
    let mut last = storage.clone();
    let here = given.iter().filter_map(|at| {
        let node = nearest(asked, grid, at)?;
        let mut found = Vec::new();
        let values = grid.values(node);
        take(asked, measure, &mut last, &values, at.clone(), &mut found);
        Some((node, found))
    });
    let all: Vec<_> = found.into_iter().chain(here.collect::<Vec<_>>()).collect();
    for (node, found) in all {
        for mut at in found {
            Walk::within_limits(asked.mechanism, &mut at);
            let mut joints = asked.mechanism.joints().iter().zip(&at.joints);
            match joints.all(|(joint, value)| joint.allows(*value)) {
                true => sown.seeds.push((node, at)),
                false => sown.outside += 1,
            }
        }
    }
    sown
}

/// Adds what Newton's method finds from a start, if it is new.
fn take(
    asked: &Asked,
    measure: &Measure,
    storage: &mut Storage,
    values: &[f64],
    mut at: Configuration<f64>,
    found: &mut Vec<Configuration<f64>>,
) {
    const SAME: f64 = 1e-6;
    let held = asked.at(values);
    for (platform, pose) in at.platforms.iter_mut().enumerate() {
        let coordinates = held.held_values(platform);
        if !coordinates.is_empty() {
            let with = with_coordinates(&pose.pose(), coordinates);
            *pose = PlatformPose::from_pose(&with);
        }
    }
    let mut at = asked.put(&at, values);
    let targets = [values.to_vec()];
    (storage.targets).ask(&mut storage.system, &mut at, &targets);
    let mut trial = at.clone();
    let report = (asked.newton).solve(&storage.system, &mut at, &mut trial, &mut storage.work);
    if report.stop != Stop::Solved || found.iter().any(|known| measure.apart(known, &at) < SAME) {
        return;
    }
    storage.system.residual(&at, &mut storage.work);
    let [told] = &storage.steps.rates.at(&at)[..] else {
        return;
    };
    // where the mapped coordinates do not tell how things move there is nothing to go on from
    if told.regular {
        found.push(at);
    }
}

/// The node nearest to a configuration, if it is in the box.
fn nearest(asked: &Asked, grid: &Grid, at: &Configuration<f64>) -> Option<usize> {
    let (mut node, mut stride) = (0, 1);
    for (i, axis) in asked.axes.iter().enumerate() {
        let place = ((axis.coordinate.of(at) - axis.from) / grid.spacing(i)).round();
        if !(place >= 0.0 && place < grid.count(i) as f64) {
            return None;
        }
        node += stride * place as usize;
        stride *= grid.count(i);
    }
    Some(node)
}
