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
use crate::mechanism::{Configuration, Mechanism, Variable};
use crate::solve::{Newton, Stage, Watch};
use crate::system::{
    Analysed, Closing, Coordinate, Held, HeldPlatform, Lasting, Moved, Named, Neighbourhood,
    Question, STILL, TwistSpace, Unknown, WidestGap, random_configuration,
};

pub use loops::LoopCount;
pub use redundancy::{Redundancy, Wrench};

/// How to look for freedoms.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilitySettings {
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
    /// Coordinates that stand still where the mechanism is closed, as those of actuators that are locked.
    pub locked: Vec<Coordinate>,
}

impl Default for MobilitySettings {
    fn default() -> Self {
        MobilitySettings {
            step: 0.05,
            directions: 3,
            branch_step: 0.02,
            branch_trials: 8,
            elsewhere: 8,
            seed: 1,
            locked: Vec::new(),
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
    /// Names of what is locked: everything else in the report is about the mechanism in which these stand still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub locked: Vec<String>,
    /// Finite freedoms at the configuration without local ones: the largest dimension of a branch.
    pub mobility: usize,
    /// Kutzbach's count: joint variables and 6 for each platform less closure equations, where what is
    /// locked is no variable.
    pub kutzbach: i64,
    /// Rank of the closure Jacobian with nothing held but what is locked.
    pub rank: usize,
    /// Infinitesimal freedoms without local ones.
    pub infinitesimal: usize,
    /// Closure equations that depend on the others.
    pub redundant: usize,
    /// Joints that stand still in every finite motion, or move in local freedoms only.
    pub idle_joints: Vec<String>,
    /// Those of the idle joints that spin a link about its own axis.
    pub spinning_joints: Vec<String>,
    /// Joints that only turn in place at the configuration, though they move links beside it:
    /// those in gimbal lock.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gimbal_locked_joints: Vec<String>,
    /// How many freedoms are lost so at the configuration.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gimbal_locked: usize,
    /// Joints that move.
    pub moving_joints: Vec<String>,
    /// Joint values of the closed configuration, rad or m.
    pub joints: Named<f64>,
    /// What kind of point of the configuration space this is.
    pub character: Character,
    /// The branches through a singular configuration, the first of very many.
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
    /// Closure equations, and one for each coordinate of a platform that is locked by itself.
    pub equations: usize,
    /// How many of the equations lock coordinates of platforms.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub locking: usize,
    /// Local (passive) freedoms: a link turns about its own axis and nothing else moves.
    pub idle_freedoms: Vec<LocalFreedom>,
    /// Kutzbach's count loop by loop.
    pub loops: Vec<LoopCount>,
    /// The dependent equations as wrenches.
    pub redundancies: Vec<Redundancy>,
    /// Infinitesimal motions of the platforms, or of the links at the closures if there are none.
    pub twists: Vec<TwistSpace>,
    /// Condition number of the dimensionless Jacobian over its rank.
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

/// A local (passive) freedom: a link turns about its own axis and nothing else moves.
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
/// What the question holds only decides which configuration is looked at. Then all is free but what the
/// settings lock: that stands still where it is, a joint as one variable less and a coordinate of a
/// platform as one equation more, so that all counts are those of the mechanism with it locked. The
/// finite mobility follows from a reduction of Lyapunov and Schmidt; where that finds the
/// configuration singular, from the branches that small steps in many directions settle on.
pub fn mobility(
    question: &Question,
    settings: &MobilitySettings,
    watch: &Watch,
) -> Analysed<MobilityReport> {
    let mechanism = question.mechanism();
    let closed = match Closing::seeded(settings.seed).start(question, watch) {
        Ok(closed) => closed,
        Err(answer) => return answer,
    };
    let locking = Question::locking(mechanism, &settings.locked, &closed.configuration);
    let held = locking.held();
    let mut near = Neighbourhood::holding(mechanism, &held);
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
                Unknown::Joint(_) if moved => Some(unknown.owner(mechanism).to_owned()),
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
    let idle_joints: Vec<String> = (mechanism.joints().iter().zip(&held.joints))
        .filter(|(_, locked)| !**locked)
        .map(|(joint, _)| joint.name.clone())
        .filter(|name| !moving_joints.contains(name))
        .collect();
    let spins = |name: &&String| idle_freedoms.iter().any(|freedom| freedom.moves(name));
    let mut report = MobilityReport {
        mechanism: mechanism.name().into(),
        variables: Variable::joints(mechanism),
        locked: names(mechanism, &held, &locking),
        mobility: found.freedoms,
        kutzbach: unknowns as i64 - rows as i64,
        rank: tangent.decomposition.rank(),
        infinitesimal: tangent.motions.len(),
        redundant: rows - tangent.decomposition.rank(),
        spinning_joints: idle_joints.iter().filter(spins).cloned().collect(),
        idle_joints,
        outside_limits: closed.outside_limits(mechanism),
        moving_joints,
        gimbal_locked_joints: turning(mechanism, near.system().unknowns(), &locked),
        gimbal_locked: locked.len(),
        joints: mechanism.named_joints(&closed.configuration.joints),
        character: found.character,
        branches,
        branch_count: found.count,
        branches_complete: found.complete,
        elsewhere: Vec::new(),
        elsewhere_starts: match unknowns > ELSEWHERE_LIMIT {
            true => 0,
            false => settings.elsewhere,
        },
        unknowns,
        equations: rows,
        locking: near.system().hold_rows().len(),
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
    report.elsewhere = elsewhere(
        &mut near,
        (&held, &closed.configuration),
        (settings, watch),
        &report,
    );
    report.interrupted = watch.is_stopped();
    Analysed::Closed(report)
}

/// Unknowns beyond which no assemblies of another mobility are sought: hardly a start would close.
const ELSEWHERE_LIMIT: usize = 100;

/// Regular assemblies of another mobility than `here`, one for each.
fn elsewhere(
    near: &mut Neighbourhood,
    (held, locked_at): (&Held<f64>, &Configuration<f64>),
    (settings, watch): (&MobilitySettings, &Watch),
    here: &MobilityReport,
) -> Vec<Elsewhere> {
    // always the same starts: whether the mobility depends on the assembly is a property of the mechanism
    let rng = &mut Pcg64Mcg::seed_from_u64(1);
    let mechanism = near.mechanism();
    let mut found: Vec<Elsewhere> = Vec::new();
    for start in 0..here.elsewhere_starts {
        if watch.stops(Stage::Starts, start, Some(here.elsewhere_starts)) {
            break;
        }
        let mut start = random_configuration(mechanism, &mechanism.home(), rng);
        held.keep(locked_at, &mut start);
        let Some(at) = near.solve(&Newton::default(), start) else {
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

/// What is locked, a platform that stands still as a whole by its own name.
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

/// Whether a count is left out of a report.
#[allow(clippy::trivially_copy_pass_by_ref)] // serde passes it so
fn is_zero(number: &usize) -> bool {
    *number == 0
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
                Unknown::Twist { .. } => &mut platforms,
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
