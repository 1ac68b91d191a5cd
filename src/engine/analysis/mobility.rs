//! Mobility of an assembled mechanism: finite and infinitesimal freedoms, moving joints, redundant equations.
//!
//! *Kutzbach's count* is unknowns less equations, the *infinitesimal* mobility unknowns less the rank of the closure
//! Jacobian. The *finite* mobility is the largest dimension of the assembled configurations through the one given; it is
//! found by moving a finite step, never from a rank alone.

mod branches;
mod loops;
mod redundancy;
mod report;

use std::collections::HashSet;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::linear::{Decomposition, axis_aligned};
use crate::mechanism::{Configuration, Mechanism, Variable};
use crate::number::tolerance::STILL;
use crate::solve::{Newton, Stage, Watch};
use crate::system::{
    Analysed, AssemblySettings, Coordinate, FINITE_STEP, Held, HeldPlatform, Lasting,
    Neighbourhood, Question, Unknown, random_configuration,
};

use branches::FiniteSearch;
pub use loops::LoopCount;
pub use redundancy::{Redundancy, RedundantWrench};
pub use report::{BranchReport, Character, Elsewhere, LocalFreedom, MobilityReport};

/// Settings of a mobility analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilitySettings {
    /// Seed of all random directions.
    pub seed: u64,
    /// Coordinates locked where the mechanism is closed, such as those of actuators.
    pub locked: Vec<Coordinate>,
}

impl Default for MobilitySettings {
    fn default() -> Self {
        MobilitySettings {
            seed: 1,
            locked: Vec::new(),
        }
    }
}

/// Counts the freedoms of a mechanism, closed near the start of a question.
///
/// The held coordinates of the question choose the configuration; then all is free but the locked ones of the settings:
/// a
/// joint is one variable less, a coordinate of a platform one equation more. The finite mobility follows from a reduction
/// of Lyapunov and Schmidt, and at a singular configuration from the branches that small steps in many directions reach.
pub fn mobility(
    question: &Question,
    settings: &MobilitySettings,
    watch: &Watch,
) -> Analysed<MobilityReport> {
    let mechanism = question.mechanism();
    // the same starts for all seeds: freedoms may depend on the assembly
    let closed = match AssemblySettings::default().start(question, watch) {
        Ok(closed) => closed,
        Err(answer) => return answer,
    };
    let locking = Question::locking(mechanism, &settings.locked, &closed.configuration);
    let held = locking.held();
    let mut near = Neighbourhood::holding(mechanism, &held).watched(watch);
    let tangent = near.tangent(closed.configuration.clone());
    let Lasting {
        tangent,
        locked,
        idle_beside,
        unlocked,
    } = tangent.lasting(&mut near);
    let mut search = FiniteSearch {
        near: &mut near,
        watch,
        rng: Pcg64Mcg::seed_from_u64(settings.seed),
    };
    let beside = match unlocked {
        None if locked.is_empty() || search.is_regular(&tangent, FINITE_STEP, 3) => None,
        None => search.regular_beside(&tangent),
        unlocked => unlocked,
    };
    let found = search.find(beside.as_ref().unwrap_or(&tangent));
    let (rows, unknowns) = (near.system().rows(), near.system().unknowns().len());
    let moving = |moved: &[bool]| -> Vec<String> {
        let unknowns = near.system().unknowns().iter().zip(moved);
        unknowns
            .filter_map(|(unknown, &moved)| match *unknown {
                Unknown::Joint(joint) if moved && !mechanism.is_of_point(joint) => {
                    Some(unknown.owner(mechanism).to_owned())
                }
                _ => None,
            })
            .collect()
    };
    let moving_joints = moving(&found.moved);
    // smaller components of a unit motion come from another one, mixed in
    let turns = |i: usize| locked.iter().any(|motion| motion[i].abs() > 1e-2);
    let gimbal_locked_joints = moving(&(0..unknowns).map(turns).collect::<Vec<bool>>());
    let branches = (found.branches.iter())
        .map(|branch| BranchReport {
            mobility: branch.freedoms,
            moving_joints: moving(&branch.moved),
            twists: near.twist_spaces(&tangent.at, &branch.motions, &tangent.idle),
            cone: branch.cone,
            approximate: branch.approximate,
        })
        .collect();
    let redundancies = redundancy::find(&mut near, &tangent);
    let idle_freedoms = idle_freedoms(mechanism, near.system().unknowns(), &idle_beside);
    let known: HashSet<&String> = moving_joints.iter().collect();
    let idle_joints: Vec<String> = (mechanism.joints().iter().enumerate())
        .filter(|(joint, _)| !held.joints[*joint] && !mechanism.is_of_point(*joint))
        .map(|(_, joint)| joint.name.clone())
        .filter(|name| !known.contains(name))
        .collect();
    let spins = |name: &&String| idle_freedoms.iter().any(|freedom| freedom.moves(name));
    let slides = mechanism.added_unknowns();
    let mut report = MobilityReport {
        mechanism: mechanism.name().into(),
        variables: Variable::all_joints(mechanism),
        locked: names(mechanism, &held, &locking),
        mobility: found.freedoms,
        kutzbach: unknowns as i64 - rows as i64,
        rank: tangent.decomposition.rank() - slides,
        infinitesimal: tangent.motions.len(),
        redundant: rows - tangent.decomposition.rank(),
        spinning_joints: idle_joints.iter().filter(spins).cloned().collect(),
        idle_joints,
        moving_joints,
        gimbal_locked_joints,
        gimbal_locked: locked.len(),
        counted_beside: beside.is_some(),
        joints: mechanism.all_joints(&closed.configuration),
        character: found.character,
        branches,
        branch_count: found.count,
        branches_complete: found.complete,
        elsewhere: Vec::new(),
        elsewhere_starts: match unknowns > ELSEWHERE_LIMIT {
            true => 0,
            false => ELSEWHERE,
        },
        unknowns: unknowns - slides,
        equations: rows - slides,
        locking: near.system().hold_rows().len(),
        idle_freedoms,
        loops: loops::count(&mut near, &closed.configuration),
        redundancies,
        twists: near.twist_spaces(&tangent.at, &tangent.motions, &tangent.idle),
        condition: tangent.decomposition.condition(),
        singular_at: match found.character {
            Character::Regular if beside.is_none() => near.singular_within(&tangent, FINITE_STEP),
            _ => None,
        },
        neglected: match found.character {
            Character::Structure | Character::Regular => None,
            _ => neglected(&tangent.decomposition).filter(|_| !near.system().is_large()),
        },
        length: mechanism.characteristic_length(),
        pose: closed.pose(mechanism),
        gap_after_step: found.gap,
        interrupted: false,
    };
    // always the same starts: whether the mobility depends on the assembly is a property of the mechanism
    let search = FiniteSearch {
        near: &mut near,
        watch,
        rng: Pcg64Mcg::seed_from_u64(1),
    };
    report.elsewhere = elsewhere(search, (&held, &closed.configuration), &report);
    report.interrupted = watch.is_stopped();
    Analysed::Closed(report)
}

/// The largest singular value beyond the rank, relative to the largest, if no rounding of a double solution explains
/// it.
fn neglected(of: &Decomposition) -> Option<f64> {
    let values = of.singular_values();
    let part = values.get(of.rank())? / values.first()?;
    // joints of a double solution are uncertain by the root of its residual, which is rounding
    (part > f64::EPSILON.sqrt()).then_some(part)
}

/// Random starts from which assemblies of another mobility are sought.
const ELSEWHERE: usize = 8;

/// Unknowns beyond which no assemblies of another mobility are sought: hardly a start would close.
const ELSEWHERE_LIMIT: usize = 100;

/// Regular assemblies of another mobility than `here`, one for each.
fn elsewhere(
    mut search: FiniteSearch,
    (held, locked_at): (&Held<f64>, &Configuration<f64>),
    here: &MobilityReport,
) -> Vec<Elsewhere> {
    let (mechanism, watch) = (search.near.mechanism(), search.watch);
    let slides = mechanism.added_unknowns();
    let mut found: Vec<Elsewhere> = Vec::new();
    for start in 0..here.elsewhere_starts {
        if watch.stops(Stage::Starts, start, Some(here.elsewhere_starts)) {
            break;
        }
        let mut start = random_configuration(mechanism, &mechanism.home(), &mut search.rng);
        held.keep(locked_at, &mut start);
        let Some(at) = search.near.solve(&Newton::default(), start) else {
            continue;
        };
        if here.character == Character::Regular && search.near.rank(&at) == here.rank + slides {
            continue;
        }
        let tangent = search.near.tangent(at).lasting(search.near).tangent;
        let freedoms = tangent.motions.len();
        if freedoms == here.mobility || found.iter().any(|other| other.mobility == freedoms) {
            continue;
        }
        // a random start meets a singular point with probability zero, a shaky assembly it may meet
        if freedoms > 0 && !search.is_regular(&tangent, FINITE_STEP, 2) {
            continue;
        }
        found.push(Elsewhere {
            mobility: freedoms,
            joints: mechanism.all_joints(&tangent.at),
        });
    }
    found
}

/// Names of the locked coordinates; a platform locked as a whole has its own name.
fn names(mechanism: &Mechanism, held: &Held<f64>, locking: &Question) -> Vec<String> {
    let joints = locking.held_names().into_iter();
    let joints = joints.take(held.joints.iter().filter(|locked| **locked).count());
    let platforms = mechanism.platforms().iter().enumerate();
    let platforms = platforms.flat_map(|(i, platform)| match held.platforms[i] {
        HeldPlatform::Pose => vec![platform.name.clone()],
        _ => (locking.held_values(i).into_iter())
            .map(|(c, _)| Coordinate::Pose(i, c).name(mechanism))
            .collect(),
    });
    joints.chain(platforms).collect()
}

/// The local freedoms of the model, then one for each rod between two balls.
fn idle_freedoms(
    mechanism: &Mechanism,
    unknowns: &[Unknown],
    idle: &[Vec<f64>],
) -> Vec<LocalFreedom> {
    let spins = axis_aligned(idle);
    let link = |motion: &Vec<f64>| {
        let (mut platforms, mut joints): (Vec<String>, Vec<String>) = (vec![], vec![]);
        let turning = (unknowns.iter().zip(motion)).filter(|(_, rate)| rate.abs() > STILL);
        for (unknown, _) in turning {
            let names = match unknown {
                Unknown::Joint(_) => &mut joints,
                Unknown::Twist(..) => &mut platforms,
            };
            names.push(unknown.owner(mechanism).to_owned());
        }
        platforms.dedup();
        match platforms.is_empty() {
            true => LocalFreedom::Joints(joints),
            false => LocalFreedom::Platforms { platforms, joints },
        }
    };
    let rods = (mechanism.closures().iter()).filter(|c| c.kind.has_length());
    let rods = rods.map(|rod| LocalFreedom::Rod(rod.name.clone()));
    (spins.iter().map(link)).chain(rods).collect()
}
