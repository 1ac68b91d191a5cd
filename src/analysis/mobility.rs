//! What an assembled mechanism can do: how many freedoms, which joints move, what is redundant.
//!
//! Three numbers are told apart. *Kutzbach's count* is unknowns less equations. The *infinitesimal*
//! mobility is unknowns less the rank of the closure Jacobian. The *finite* mobility is the largest
//! dimension of the assembled configurations through the one given; it is found by moving a finite
//! step, never from a rank alone.

mod branches;
mod cone;
mod loops;
mod redundancy;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

use crate::linear::axis_aligned;
use crate::mechanism::{ClosureKind, Mechanism, Variable};
use crate::solve::{Newton, Stage, Watch};
use crate::system::{
    Analysed, Lasting, Moved, Named, Neighbourhood, Question, TwistSpace, Unknown, WidestGap,
    close, random_configuration, too_large,
};

pub use loops::LoopCount;
pub use redundancy::{Redundancy, Wrench};

/// How to look for freedoms.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilitySettings {
    /// The iteration that closes the mechanism.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Length of the finite step along a candidate motion, in rad and characteristic lengths. A
    /// motion that is only infinitesimal to second order leaves a gap of about its square.
    pub step: f64,
    /// Directions of motion that are tried; all must be free for the mechanism to be regular.
    pub directions: usize,
    /// Length of the steps by which branches are sought where it is not.
    pub branch_step: f64,
    /// Steps per infinitesimal freedom by which branches are sought.
    pub branch_trials: usize,
    /// Random starts from which assemblies of another mobility are sought; none in large mechanisms.
    pub elsewhere: usize,
    /// Seed of all random directions and starts.
    pub seed: u64,
}

impl Default for MobilitySettings {
    fn default() -> Self {
        MobilitySettings {
            newton: Newton::default(),
            restarts: 40,
            step: 0.05,
            directions: 3,
            branch_step: 0.02,
            branch_trials: 8,
            elsewhere: 8,
            seed: 1,
        }
    }
}

/// What an assembled mechanism can do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MobilityReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joint variables with their units, in the order of the file.
    pub variables: Vec<Variable>,
    /// Finite freedoms at the configuration, without idle ones: the largest dimension of a branch.
    pub mobility: usize,
    /// Kutzbach's count: joint variables and 6 for each platform less closure equations.
    pub kutzbach: i64,
    /// Rank of the closure Jacobian with nothing held.
    pub rank: usize,
    /// Infinitesimal freedoms, without idle ones.
    pub infinitesimal: usize,
    /// Closure equations that depend on the others.
    pub redundant: usize,
    /// Joints that stand still in every finite motion, or move in idle freedoms only.
    pub idle_joints: Vec<String>,
    /// Those of the idle joints that spin a link about its own line.
    pub spinning_joints: Vec<String>,
    /// Joints that only turn in place at the configuration, though they move links beside it:
    /// those in gimbal lock.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub locked_joints: Vec<String>,
    /// How many freedoms are lost so at the configuration.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub locked: usize,
    /// Joints that move.
    pub moving_joints: Vec<String>,
    /// Joint values of the closed configuration, rad or m.
    pub joints: Named<f64>,
    /// What kind of point of the configuration space this is.
    pub character: Character,
    /// The branches through the configuration, if more than the one regular motion; of very many
    /// the first.
    pub branches: Vec<BranchReport>,
    /// How many there are, found by steps in many directions.
    pub branch_count: usize,
    /// Whether it is certain that there are no more.
    pub branches_complete: bool,
    /// Another mobility that the mechanism has in another assembly.
    pub elsewhere: Vec<Elsewhere>,
    /// Random starts from which one was sought.
    pub elsewhere_starts: usize,
    /// Joint variables and six for each platform.
    pub unknowns: usize,
    /// Closure equations.
    pub equations: usize,
    /// Freedoms that only turn a link about its own line.
    pub idle_freedoms: Vec<LocalFreedom>,
    /// Kutzbach's count loop by loop.
    pub loops: Vec<LoopCount>,
    /// The dependent equations as wrenches.
    pub redundancies: Vec<Redundancy>,
    /// Infinitesimal motions of the platforms, or of the links at the closures if there are none.
    pub twists: Vec<TwistSpace>,
    /// Ratio of the largest to the smallest singular value that counts, of the dimensionless
    /// Jacobian.
    pub condition: f64,
    /// About how far a singular configuration is where a regular one is nearer to it than the
    /// length of a step, in rad and normalising lengths: to first order, along the motions.
    pub singular_at: Option<f64>,
    /// The characteristic length that makes it dimensionless, in m.
    #[serde(rename = "normalising_length")]
    pub length: f64,
    /// The widest gap of the pose given, before it was closed.
    #[serde(rename = "given_gap")]
    pub given: Option<WidestGap>,
    /// What moved most from the values guessed, or from a pose of the file that was more than
    /// rounded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<Moved>,
    /// Whether joints held by the file kept their values when the mechanism was closed.
    pub kept: bool,
    /// Names of the joints that are outside their limits.
    pub outside_limits: Vec<String>,
    /// What is left of the closure equations after a finite step along the infinitesimal freedoms,
    /// dimensionless; `None` if the step does not settle.
    pub gap_after_step: Option<f64>,
    /// Whether the work was stopped before it was done: branches and other assemblies may be missing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// What kind of point of the configuration space a configuration is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Character {
    /// No freedom, not even an infinitesimal one.
    Structure,
    /// Every infinitesimal freedom is finite.
    Regular,
    /// Infinitesimal freedoms, none of them finite.
    Shaky,
    /// One branch with fewer freedoms than the infinitesimal ones.
    Singular,
    /// Several branches of the same number of freedoms meet.
    Bifurcation,
    /// Branches of different numbers of freedoms meet (Wohlhart 1996).
    Kinematotropic,
}

/// A freedom that only turns a link about its own line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LocalFreedom {
    /// The link turns in joints of its own, which these are.
    Joints(Vec<String>),
    /// The link is a platform on closures, which turns in joints too if it has some.
    Platforms {
        /// The platform, or those that turn together.
        platforms: Vec<String>,
        /// The joints that turn with it.
        joints: Vec<String>,
    },
    /// The rod of a `Distance` turns in the balls at its ends, which the closure does not model.
    Rod(String),
}

impl LocalFreedom {
    /// Whether the joint turns in it.
    fn moves(&self, joint: &String) -> bool {
        match self {
            LocalFreedom::Joints(joints) | LocalFreedom::Platforms { joints, .. } => {
                joints.contains(joint)
            }
            LocalFreedom::Rod(_) => false,
        }
    }
}

/// A branch of assembled configurations through the one given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchReport {
    /// Its freedoms.
    pub mobility: usize,
    /// Joints that move on it.
    pub moving_joints: Vec<String>,
    /// Its motions at the configuration, as for the whole.
    pub twists: Vec<TwistSpace>,
    /// Whether these motions are a curved cone that its `twists` span: not each of them is possible.
    pub cone: bool,
    /// Whether `twists` are known to about the length of a step only: those of a branch of several
    /// freedoms that is shaky throughout.
    pub approximate: bool,
}

/// An assembly of another mobility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Elsewhere {
    /// Its freedoms.
    pub mobility: usize,
    /// Joint values there, rad or m.
    pub joints: Named<f64>,
}

/// Counts the freedoms of a mechanism, closed near the start of a question.
///
/// What the question holds only decides which configuration is looked at: all is free then. The
/// finite mobility follows from a reduction of Lyapunov and Schmidt; where that finds the
/// configuration singular, from the branches that small steps in many directions settle on.
pub fn mobility(
    question: &Question,
    settings: &MobilitySettings,
    watch: &Watch,
) -> Analysed<MobilityReport> {
    let mechanism = question.mechanism();
    if let Some(large) = too_large(mechanism) {
        return Analysed::TooLarge(large);
    }
    let closed = match close(
        question,
        &settings.newton,
        (settings.restarts, settings.seed),
        watch,
    ) {
        Ok(closed) => closed,
        Err(open) => return Analysed::NotClosed(open),
    };
    let mut near = Neighbourhood::new(mechanism);
    let tangent = near.tangent(closed.configuration.clone());
    let Lasting {
        tangent,
        locked,
        idle_beside,
    } = tangent.lasting(&mut near);
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    let found = branches::find(&mut near, &tangent, (settings, watch), &mut rng);
    let (rows, unknowns) = (near.system().rows(), near.system().unknowns().len());
    let moving = |moved: &[bool]| -> Vec<String> {
        let unknowns = near.system().unknowns().iter().zip(moved);
        unknowns
            .filter_map(|(unknown, &moved)| match *unknown {
                Unknown::Joint(joint) if moved => Some(mechanism.joints()[joint].name.clone()),
                _ => None,
            })
            .collect()
    };
    let moving_joints = moving(&found.moved);
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
    let idle_joints: Vec<String> = (mechanism.joints().iter())
        .map(|joint| joint.name.clone())
        .filter(|name| !moving_joints.contains(name))
        .collect();
    let spins = |name: &&String| idle_freedoms.iter().any(|freedom| freedom.moves(name));
    let mut report = MobilityReport {
        mechanism: mechanism.name().into(),
        variables: Variable::joints(mechanism),
        mobility: found.freedoms,
        kutzbach: unknowns as i64 - rows as i64,
        rank: tangent.decomposition.rank(),
        infinitesimal: tangent.motions.len(),
        redundant: rows - tangent.decomposition.rank(),
        spinning_joints: idle_joints.iter().filter(spins).cloned().collect(),
        idle_joints,
        outside_limits: closed.outside_limits(mechanism),
        moving_joints,
        locked_joints: turning(mechanism, near.system().unknowns(), &locked),
        locked: locked.len(),
        joints: mechanism.named_joints(&closed.configuration.joints),
        character: found.character,
        branches,
        branch_count: found.count,
        branches_complete: found.complete,
        elsewhere: Vec::new(),
        elsewhere_starts: if unknowns > ELSEWHERE_LIMIT {
            0
        } else {
            settings.elsewhere
        },
        unknowns,
        equations: rows,
        idle_freedoms,
        loops: loops::count(&mut near, &closed.configuration),
        redundancies,
        twists: near.twist_spaces(&tangent.at, &tangent.motions, &tangent.idle),
        condition: tangent.decomposition.condition(),
        singular_at: match found.character {
            Character::Regular => near.singular_within(&tangent, settings.step),
            _ => None,
        },
        length: mechanism.characteristic_length(),
        given: closed.given.filter(|gap| gap.size(mechanism) > 1e-9),
        moved: closed.moved,
        kept: closed.kept,
        gap_after_step: found.gap,
        interrupted: false,
    };
    report.elsewhere = elsewhere(&mut near, (settings, watch), &report, &mut rng);
    report.interrupted = watch.is_stopped();
    Analysed::Closed(report)
}

/// Beyond so many unknowns no assemblies of another mobility are sought: each start would take long
/// and hardly one would close.
const ELSEWHERE_LIMIT: usize = 100;

/// Regular assemblies of another mobility than `here`, one for each.
fn elsewhere(
    near: &mut Neighbourhood,
    (settings, watch): (&MobilitySettings, &Watch),
    here: &MobilityReport,
    rng: &mut Pcg64Mcg,
) -> Vec<Elsewhere> {
    let mechanism = near.mechanism();
    let mut found: Vec<Elsewhere> = Vec::new();
    for start in 0..here.elsewhere_starts {
        if watch.stops(Stage::Starts, start, Some(here.elsewhere_starts)) {
            break;
        }
        let start = random_configuration(mechanism, &mechanism.home(), rng);
        let Some(at) = near.solve(&settings.newton, start) else {
            continue;
        };
        if here.character == Character::Regular && near.rank(&at) == here.rank {
            continue;
        }
        let tangent = near.tangent(at).lasting(near).tangent;
        let freedoms = tangent.motions.len();
        if freedoms == here.mobility || found.iter().any(|other| other.mobility == freedoms) {
            continue;
        }
        // a random start meets a singular point with probability zero, a shaky assembly it may meet
        if freedoms > 0 && !branches::is_regular(near, &tangent, settings.step, 2, rng) {
            continue;
        }
        found.push(Elsewhere {
            mobility: freedoms,
            joints: mechanism.named_joints(&tangent.at.joints),
        });
    }
    found
}

/// Whether a count is left out of a report.
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The joints that turn in any of some motions.
fn turning(mechanism: &Mechanism, unknowns: &[Unknown], motions: &[Vec<f64>]) -> Vec<String> {
    /// Below this a component of a unit motion is that of another one, mixed in.
    const MIXED: f64 = 1e-2;
    let places = (0..unknowns.len()).filter(|&i| motions.iter().any(|m| m[i].abs() > MIXED));
    let names = places.filter_map(|i| match unknowns[i] {
        Unknown::Joint(joint) => Some(mechanism.joints()[joint].name.clone()),
        Unknown::Twist { .. } => None,
    });
    names.collect()
}

/// The idle freedoms of the model, then one for each rod between two balls.
fn idle_freedoms(
    mechanism: &Mechanism,
    unknowns: &[Unknown],
    idle: &[Vec<f64>],
) -> Vec<LocalFreedom> {
    /// Below this a component of a unit motion is rounding.
    const ROUNDING: f64 = 1e-6;
    let spins = axis_aligned(idle);
    let link = |motion: &Vec<f64>| {
        let (mut platforms, mut joints): (Vec<String>, Vec<String>) = (vec![], vec![]);
        let turning = (unknowns.iter().zip(motion)).filter(|(_, rate)| rate.abs() > ROUNDING);
        for (unknown, _) in turning {
            match *unknown {
                Unknown::Joint(joint) => joints.push(mechanism.joints()[joint].name.clone()),
                Unknown::Twist { platform, .. } => {
                    platforms.push(mechanism.platforms()[platform].name.clone());
                }
            }
        }
        platforms.dedup();
        match platforms.is_empty() {
            true => LocalFreedom::Joints(joints),
            false => LocalFreedom::Platforms { platforms, joints },
        }
    };
    let rods = (mechanism.closures().iter()).filter(|c| c.kind == ClosureKind::Distance);
    let rods = rods.map(|rod| LocalFreedom::Rod(rod.name.clone()));
    (spins.iter().map(link)).chain(rods).collect()
}
