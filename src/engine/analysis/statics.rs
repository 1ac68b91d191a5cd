//! Static equilibrium of an assembled mechanism: holding forces and reactions.

mod reactions;
mod rest;

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::linear::{RANK_TOLERANCE, add, norm, rank_of};
use crate::mechanism::{Along, ClosureKind, Configuration, GivenEffort, Kinematics, Mechanism};
use crate::solve::Watch;
use crate::system::{
    Acting, Analysed, AssemblySettings, Coordinate, Equilibrium, GivenPose, Load, Loaded,
    Neighbourhood, Question, QuestionError, Unknown, check_angles,
};

pub use reactions::Reaction;
pub use rest::Rest;

/// The forces in an assembled mechanism at rest. Vectors are in ground, forces in N, moments in N·m, points in m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StaticsReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// True if the forces balance the load.
    pub balanced: bool,
    /// The wrenches applied, then the weights of bodies.
    pub loads: Vec<AppliedWrench>,
    /// The loads on joints.
    pub joint_loads: Vec<Force>,
    /// Efforts of springs and given forces of the file, each positive along its joint; along a line of two points where it
    /// pulls them together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<Force>,
    /// For each held coordinate the forces between which friction keeps the mechanism at rest; the forces and reactions
    /// below are those without friction.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rests: Vec<Rest>,
    /// True if nothing has weight.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub weightless: bool,
    /// Joints and platforms that the unbalanced part of the load would move; the forces below then come nearest to
    /// balance.
    pub unbalanced: Vec<String>,
    /// Freedoms gained at a singular configuration: motions that nothing held resists.
    pub gained: usize,
    /// Forces and moments that the held coordinates need, each positive along its coordinate.
    pub actuators: Vec<Force>,
    /// Reaction at each closure.
    pub closures: Vec<Reaction>,
    /// Reaction at each joint of a chain, its drive included.
    pub joints: Vec<Reaction>,
    /// Number of independent self-stresses, states of stress without load: 0 if all forces are determined. Reactions
    /// that are not `unique` are the choice of least norm, forces multiplied by the normalising length.
    pub self_stresses: usize,
    /// The number of these that act across the plane of a planar mechanism only.
    #[serde(default, skip_serializing_if = "is_none")]
    pub across_plane: usize,
    /// Ratio of the largest to the smallest singular value that counts, of the equilibrium equations.
    pub condition: f64,
    /// The length that makes forces comparable with moments, in m.
    pub normalising_length: f64,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
}

/// A wrench at a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AppliedWrench {
    /// The point: a frame stands for its origin.
    pub frame: String,
    /// Force at it, in N.
    pub force: [f64; 3],
    /// Moment, in N·m.
    pub moment: [f64; 3],
}

/// A force or moment along a coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Force {
    /// The coordinate.
    pub name: String,
    /// `N` or `N·m`.
    pub unit: SiUnit,
    /// Magnitude, positive along the coordinate, in `unit`.
    pub force: f64,
    /// True if equilibrium determines it.
    pub unique: bool,
}

fn yes() -> bool {
    true
}

fn is_yes(flag: &bool) -> bool {
    *flag
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Finds the forces that balance a load, with the weights, springs and forces of the file, at the assembled configuration near the start of a question.
///
/// By virtual work g + Jᵀλ + Sᵀτ = 0: g are the generalised forces of the load, J the closure
/// Jacobian with nothing held, S picks the held coordinates. Of many solutions the one is taken that
/// loads closures and joints least, by the sum of squares; closures alone beyond
/// [`SPECTRUM_LIMIT`](crate::linear::SPECTRUM_LIMIT) unknowns.
/// Source: Ghosal, Robotics, 2006, §5.9; Hunt, Kinematic Geometry, 1978 on wrenches.
///
/// # Errors
/// If more or less is held than the mechanism has freedoms, if what is held depends on itself, or if
/// an angle is held of a platform pitched by ±90°.
pub fn statics(
    question: &Question,
    load: &Load,
    watch: &Watch,
) -> Result<Analysed<StaticsReport>, QuestionError> {
    let mechanism = question.mechanism();
    let closed = match AssemblySettings::default().determined(question, watch)? {
        Ok(closed) => closed,
        Err(answer) => return Ok(answer),
    };
    let at = &closed.configuration;
    check_angles(question, at)?;
    let mut near = Neighbourhood::new(mechanism);
    let tangent = near.tangent(at.clone());
    let unknowns = near.system().unknowns().to_vec();
    let rows = near.system().rows();
    let held = question.driven_coordinates();

    let Equilibrium {
        rank,
        condition,
        stresses,
        generalised,
        mut forces,
        left,
    } = Equilibrium::of(&near, at, &held, load);
    let none = Load::default();
    let changes: Vec<Vec<Reaction>> = (stresses.iter())
        .map(|stress| reactions::of(&mut near, at, &none, &stress[..rows]))
        .collect();
    let length = mechanism.characteristic_length();
    let drives = stresses.iter().map(|stress| &stress[rows..]);
    let across_plane = mechanism.plane_of_motion().map_or(0, |normal| {
        let in_plane = changes.iter().zip(drives);
        let in_plane: Vec<f64> = in_plane
            .flat_map(|(change, drives)| {
                let reactions = reactions::in_plane(change, normal, length);
                reactions.chain(drives.iter().copied())
            })
            .collect();
        let entries = in_plane.len() / stresses.len().max(1);
        stresses.len() - rank_of(entries, stresses.len(), &in_plane)
    });
    // in a large mechanism closures alone are loaded least: its states of stress are not all known
    if !near.system().is_large() {
        let found = reactions::of(&mut near, at, load, &forces[..rows]);
        let shares = reactions::least(&found, &changes, length);
        for (share, stress) in shares.iter().zip(&stresses) {
            add(&mut forces, *share, stress);
        }
    }
    let mut closures = reactions::of(&mut near, at, load, &forces[..rows]);
    reactions::mark(&mut closures, &changes, length);
    let mut joints = closures.split_off(mechanism.closures().len());

    let actuators = held.iter().enumerate().map(|(i, &coordinate)| Force {
        name: coordinate.name(mechanism),
        unit: coordinate.force_unit(mechanism),
        force: forces[rows + i] / coordinate.scale(mechanism),
        unique: (stresses.iter()).all(|stress| stress[rows + i].abs() <= RANK_TOLERANCE),
    });
    let actuators = actuators.collect();
    // what makes coordinates of points joints carries only what holds these
    closures.truncate(mechanism.own_parts()[1]);
    // a coupling acts on the joints in it alone
    let kinds = mechanism.closures().iter().map(|closure| closure.kind);
    let mut kinds = kinds.map(|kind| kind != ClosureKind::Coupling);
    closures.retain(|_| kinds.next().unwrap_or(true));
    let of_points = mechanism.joints().iter().enumerate();
    let of_points: HashSet<&String> = of_points
        .filter(|(i, _)| mechanism.is_of_point(*i))
        .map(|(_, joint)| &joint.name)
        .collect();
    joints.retain(|joint| !joint.variables.iter().any(|name| of_points.contains(name)));
    let unbalanced = unbalanced(mechanism, &unknowns, &left, norm(&generalised));
    Ok(Analysed::Closed(StaticsReport {
        mechanism: mechanism.name().to_owned(),
        balanced: unbalanced.is_empty(),
        loads: (load.wrenches.iter())
            .map(|&(point, force, moment)| AppliedWrench {
                frame: point.name(mechanism),
                force,
                moment,
            })
            .chain(weights(load))
            .collect(),
        springs: springs(mechanism, at, load),
        rests: rest::of(question, at, &held, load),
        weightless: weights(load).next().is_none(),
        joint_loads: (load.joints.iter())
            .map(|&(joint, force)| Force {
                name: mechanism.joints()[joint].name.clone(),
                unit: Coordinate::Joint(joint).force_unit(mechanism),
                force,
                unique: true,
            })
            .collect(),
        unbalanced,
        gained: (unknowns.len() - rank).saturating_sub(tangent.idle.len()),
        actuators,
        closures,
        joints,
        self_stresses: rows + held.len() - rank,
        across_plane,
        condition,
        normalising_length: mechanism.characteristic_length(),
        pose: closed.pose(mechanism),
    }))
}

/// The weights of bodies.
fn weights(load: &Load) -> impl Iterator<Item = AppliedWrench> {
    let gravity = load.own.gravity;
    let heavy = load.own.masses.iter();
    let heavy = heavy.filter(move |of| of.mass > 0.0 && gravity != [0.0; 3]);
    heavy.map(move |of| AppliedWrench {
        frame: format!("weight of {}", of.name),
        force: gravity.map(|g| g * of.mass),
        moment: [0.0; 3],
    })
}

/// The efforts of springs and of given forces along joints and lines.
fn springs(mechanism: &Mechanism, at: &Configuration<f64>, load: &Load) -> Vec<Force> {
    let own = &load.own;
    let kinematics = Kinematics::new(mechanism.dimensions(), load.frames());
    let loaded = Loaded::new(mechanism, &[], load, &kinematics);
    let mut placement = kinematics.placement();
    kinematics.place(at, &mut placement);
    let mut acting = Acting::default();
    loaded.act(at, &placement, None, &mut acting);
    let of_springs = own.springs.iter().map(|of| (&of.name, Some(of.along)));
    let of_forces = own.forces.iter().map(|of| match &of.on {
        GivenEffort::Along(along, _) => (&of.name, Some(*along)),
        GivenEffort::At { .. } => (&of.name, None),
    });
    let all = of_springs.chain(of_forces).zip(&acting.pulls);
    let efforts = all.filter_map(|((name, along), pull)| {
        let (unit, force) = match along? {
            Along::Points(_) => (SiUnit::NEWTON, *pull),
            Along::Joint(joint) => (Coordinate::Joint(joint).force_unit(mechanism), -pull),
        };
        Some(Force {
            name: name.clone(),
            unit,
            force,
            unique: true,
        })
    });
    efforts.collect()
}

/// For each component of the reactions of closures, then of joints, true if equilibrium determines it at a configuration
/// with these coordinates held.
pub(crate) fn determined(
    mechanism: &Mechanism,
    at: &Configuration<f64>,
    held: &[Coordinate],
) -> Vec<[bool; 6]> {
    let mut near = Neighbourhood::new(mechanism);
    let rows = near.system().rows();
    let none = Load::default();
    let stresses = Equilibrium::of(&near, at, held, &none).stresses;
    let changes: Vec<Vec<Reaction>> = (stresses.iter())
        .map(|stress| reactions::of(&mut near, at, &none, &stress[..rows]))
        .collect();
    let mut all = reactions::of(&mut near, at, &none, &vec![0.0; rows]);
    reactions::mark(&mut all, &changes, mechanism.characteristic_length());
    all.into_iter().map(|reaction| reaction.unique).collect()
}

/// The joints and platforms that forces without counterpart would move.
fn unbalanced(mechanism: &Mechanism, unknowns: &[Unknown], left: &[f64], all: f64) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (unknown, force) in unknowns.iter().zip(left) {
        if force.abs() <= RANK_TOLERANCE * all {
            continue;
        }
        let name = unknown.owner(mechanism).to_owned();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}
