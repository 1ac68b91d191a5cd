//! The equations of equilibrium of an assembled mechanism.

use super::Load;
use crate::geometry::Vector3;
use crate::linear::{Decomposition, Elimination, Rows, add};
use crate::mechanism::{Configuration, Frame, Kinematics, Mechanism, Placement, Point};
use crate::number::Number;
use crate::solve::Equations;
use crate::system::{Coordinate, FrameTwists, Neighbourhood, Unknown};

/// Forces that balance a load: g + Jᵀλ + Sᵀτ = 0 with the generalised forces g of the load, the closure Jacobian J
/// with nothing held, and S the derivatives of the held coordinates.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The rank of [Jᵀ, Sᵀ].
    pub rank: usize,
    /// Its condition number.
    pub condition: f64,
    /// States of stress without load: an orthonormal basis, or some of a large mechanism without pattern, which change
    /// whatever a state of stress can change.
    pub stresses: Vec<Vec<f64>>,
    /// g, in N·m, in the order of the unknowns.
    pub generalised: Vec<f64>,
    /// λ, then τ, in N·m: of many solutions that of least norm.
    pub forces: Vec<f64>,
    /// Residual of the equations, in N·m: not zero where nothing resists the load.
    pub left: Vec<f64>,
}

impl Equilibrium {
    /// Equilibrium at a configuration, with nothing held in `near`.
    pub fn of(
        near: &Neighbourhood,
        at: &Configuration<f64>,
        held: &[Coordinate],
        load: &Load,
    ) -> Self {
        let system = near.system();
        let mut work = system.work();
        system.linearise(at, &mut work);
        let generalised = generalised(near, at, load);
        let opposite: Vec<f64> = generalised.iter().map(|g| -g).collect();
        let slopes = held.iter().map(|held| held.slope_in(system, at));
        if system.is_large() {
            let groups = system.jacobian_rows(&work).into_iter();
            let groups = groups.chain(slopes.map(Rows::single));
            return Equilibrium::of_groups(groups.collect(), generalised, &opposite);
        }
        let (unknowns, rows) = (system.unknowns().len(), system.rows());
        let jacobian = system.dense_jacobian(&work);
        // Jᵀ and Sᵀ beside one another, column by column
        let mut entries = Vec::with_capacity(unknowns * (rows + held.len()));
        for row in 0..rows {
            let columns = jacobian.chunks_exact(rows);
            entries.extend(columns.map(|column| column[row]));
        }
        for slope in slopes {
            let first = entries.len();
            entries.resize(first + unknowns, 0.0);
            for (place, slope) in slope {
                entries[first + place] = slope;
            }
        }
        let equations = Decomposition::of(unknowns, rows + held.len(), &entries);
        let forces = equations.solve(&opposite);
        let mut left = generalised.clone();
        for (column, force) in entries.chunks_exact(unknowns.max(1)).zip(&forces) {
            add(&mut left, *force, column);
        }
        Equilibrium {
            rank: equations.rank(),
            condition: equations.condition(),
            stresses: equations.null_space(),
            generalised,
            forces,
            left,
        }
    }

    /// Equilibrium from the rows of a large J and S, by elimination.
    fn of_groups(rows: Vec<Rows>, generalised: Vec<f64>, opposite: &[f64]) -> Self {
        const STRESSES: usize = 3;
        let equations = Elimination::of(generalised.len(), rows);
        let forces = equations.solve_transposed(opposite);
        let mut left = generalised.clone();
        add(&mut left, 1.0, &equations.transposed_product(&forces));
        Equilibrium {
            rank: equations.rank(),
            condition: equations.largest() / equations.smallest().0,
            stresses: equations.left_null_vectors(STRESSES),
            generalised,
            forces,
            left,
        }
    }
}

/// The work of a load for a unit of each unknown, in N·m.
fn generalised(near: &Neighbourhood, at: &Configuration<f64>, load: &Load) -> Vec<f64> {
    let unknowns = near.system().unknowns();
    let kinematics = Kinematics::new(near.mechanism().dimensions(), Loaded::frames(load));
    let loaded = Loaded::new(near.mechanism(), unknowns, load, &kinematics);
    let mut placement = kinematics.placement();
    kinematics.place(at, &mut placement);
    let mut rates = vec![0.0; unknowns.len()];
    let powers = (0..unknowns.len()).map(|k| {
        rates[k] = 1.0;
        let power = loaded.power(&rates, &placement);
        rates[k] = 0.0;
        power
    });
    powers.collect()
}

/// The power of a load in motions of a mechanism. Built once; nothing allocates afterwards.
#[derive(Clone, Debug)]
pub struct Loaded<T = f64> {
    twists: FrameTwists<T>,
    /// Force and moment at each of the points.
    wrenches: Vec<([f64; 3], [f64; 3])>,
    /// Unknowns with the loads along them, in N·m.
    joints: Vec<(usize, f64)>,
}

impl Loaded {
    /// Frames that must be placed.
    pub fn frames(load: &Load) -> impl Iterator<Item = Frame> {
        load.wrenches.iter().map(|(point, ..)| point.frame)
    }
}

impl<T: Number> Loaded<T> {
    /// For rates of these unknowns.
    pub fn new(
        mechanism: &Mechanism,
        unknowns: &[Unknown],
        load: &Load,
        kinematics: &Kinematics<T>,
    ) -> Self {
        let points: Vec<Point> = load.wrenches.iter().map(|(point, ..)| *point).collect();
        let dimensions = mechanism.dimensions().map(T::from_f64);
        let twists = FrameTwists::sharing(kinematics, &dimensions, unknowns, &points);
        let scales = &mechanism.dimensions().joint_scales;
        let joints = load.joints.iter().filter_map(|&(joint, force)| {
            let column = unknowns.iter().position(|u| *u == Unknown::Joint(joint))?;
            Some((column, force * scales[joint]))
        });
        Loaded {
            wrenches: (load.wrenches.iter())
                .map(|&(_, force, moment)| (force, moment))
                .collect(),
            joints: joints.collect(),
            twists,
        }
    }

    /// The power for rates of the unknowns, which are dimensionless per s: in W.
    pub fn power(&self, rates: &[T], placement: &Placement<T>) -> T {
        let wrenches = self.wrenches.iter().enumerate();
        let along = |v: &Vector3<T>, f: &[f64; 3]| v.dot(&Vector3(f.map(T::from_f64)));
        let wrenches = wrenches.map(|(i, (force, moment))| {
            let twist = self.twists.twist(i, placement, rates);
            along(&twist.velocity, force) + along(&twist.omega, moment)
        });
        let joints = (self.joints.iter()).map(|&(k, force)| rates[k].scale(force));
        let [wrenches, joints] = [
            wrenches.fold(T::zero(), |sum, x| sum + x),
            joints.fold(T::zero(), |sum, x| sum + x),
        ];
        wrenches + joints
    }
}
