//! Forces and moments that act at a configuration: loads, weights, springs and, where it moves, inertia.

mod here;
mod inertia;

use super::{FrameTwists, Load, Places, Unknown};
use crate::geometry::Vector3;
use crate::mechanism::{
    Along, Configuration, Frame, GivenEffort, GivenValue, Kinematics, Loads, Measured, Mechanism,
    Placement, Point,
};
use crate::number::{Dual, Number};
use here::Here;
use std::sync::Arc;

/// The loads of a mechanism, ready to be evaluated. Built once; nothing allocates afterwards.
#[derive(Clone, Debug)]
pub struct Loaded<T = f64> {
    own: Arc<Loads>,
    twists: FrameTwists<T>,
    points: Vec<Point>,
    /// Number of the point of each mass, of the ends of each spring and of each given force.
    masses: Vec<usize>,
    springs: Vec<LoadPlace>,
    forces: Vec<LoadPlace>,
    /// Number of the point, force at it and moment.
    constant: Vec<(usize, [f64; 3], [f64; 3])>,
    /// Joints with the constant loads along them, in N and N·m.
    joints: Vec<(usize, f64)>,
    /// For each joint its column among the unknowns, and its scale.
    columns: Vec<(Option<usize>, f64)>,
    parameters: Vec<f64>,
    centre: [f64; 3],
}

/// Numbers of points, or a joint.
#[derive(Clone, Copy, Debug)]
enum LoadPlace {
    Points(usize, usize),
    Joint(usize),
    At(usize),
}

/// Points, the rates as duals, and frames placed along their path.
pub type Changes<'a, T> = (
    &'a FrameTwists<Dual<T>>,
    &'a [Dual<T>],
    &'a Placement<Dual<T>>,
);

/// The motion of a mechanism at an instant.
#[derive(Clone, Copy)]
pub struct Moving<'a, T> {
    /// Dimensionless rates of the unknowns.
    pub rates: &'a [T],
    /// Points with the rates as duals and frames placed along their path, if accelerations are known.
    pub changes: Option<Changes<'a, T>>,
    /// Velocities are those of `rates` times the first of these, r, and accelerations r²·a + c·v.
    pub pace: [T; 2],
    /// In s.
    pub time: T,
}

/// Forces and moments at a configuration.
#[derive(Clone, Debug)]
pub struct Acting<T = f64> {
    /// For each point force and moment, in N and N·m.
    pub wrenches: Vec<[Vector3<T>; 2]>,
    /// For each joint the effort along it, in N or N·m.
    pub efforts: Vec<T>,
    /// Efforts of springs, then of given forces along joints or lines, each towards lower values of a joint or shorter
    /// distances; 0 of forces at points.
    pub pulls: Vec<T>,
    /// Energy of weights and springs, in J: weights have none at the origin of ground, springs none without effort.
    pub potential: T,
    /// Kinetic energy, in J.
    pub kinetic: T,
    /// The power of dampers and given forces, in W.
    pub supplied: T,
    /// The power of each weight, spring and given force of the mechanism, in W, with dampers and what springs store.
    pub powers: Vec<T>,
}

impl<T: Number> Default for Acting<T> {
    fn default() -> Self {
        Acting {
            wrenches: Vec::new(),
            efforts: Vec::new(),
            pulls: Vec::new(),
            potential: T::zero(),
            kinetic: T::zero(),
            supplied: T::zero(),
            powers: Vec::new(),
        }
    }
}

impl Load {
    /// The points of everything that acts: masses, ends of springs, given forces and what they depend on, loads.
    pub fn points(&self) -> Vec<Point> {
        let own = &self.own;
        let mut points: Vec<Point> = own.masses.iter().map(|mass| mass.centre).collect();
        let places = own.springs.iter().map(|spring| &spring.along);
        let given = own.forces.iter().filter_map(|force| match &force.on {
            GivenEffort::Along(along, _) => Some(along),
            GivenEffort::At { .. } => None,
        });
        for along in places.chain(given) {
            if let Along::Points(both) = along {
                points.extend(both);
            }
        }
        for force in &own.forces {
            if let GivenEffort::At { point, .. } = force.on {
                points.push(point);
            }
            let measured = force.values().iter().flat_map(GivenValue::measured);
            points.extend(measured.filter_map(|of| match of {
                Measured::Place(point, ..) | Measured::Size(point, _) => Some(*point),
                _ => None,
            }));
        }
        points.extend(self.wrenches.iter().map(|(point, ..)| *point));
        let mut distinct: Vec<Point> = Vec::new();
        for point in points {
            if !distinct.contains(&point) {
                distinct.push(point);
            }
        }
        distinct
    }

    /// Frames that must be placed.
    pub fn frames(&self) -> impl Iterator<Item = Frame> {
        self.points().into_iter().map(|point| point.frame)
    }

    /// True if bodies have mass, so that forces depend on how fast everything moves.
    pub fn has_inertia(&self) -> bool {
        !self.own.masses.is_empty() && !self.own.without_inertia
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
        let points = load.points();
        let dimensions = mechanism.dimensions().map(T::from_f64);
        let number = |point: &Point| {
            let place = points.iter().position(|known| known == point);
            place.expect("every point is among those of the load")
        };
        let place = |along: &Along| match along {
            Along::Points([a, b]) => LoadPlace::Points(number(a), number(b)),
            Along::Joint(joint) => LoadPlace::Joint(*joint),
        };
        let places = Places::new(unknowns);
        let scales = mechanism.dimensions().joint_scales.iter().enumerate();
        let own = &load.own;
        Loaded {
            masses: own.masses.iter().map(|of| number(&of.centre)).collect(),
            springs: own.springs.iter().map(|of| place(&of.along)).collect(),
            forces: (own.forces.iter())
                .map(|of| match &of.on {
                    GivenEffort::Along(along, _) => place(along),
                    GivenEffort::At { point, .. } => LoadPlace::At(number(point)),
                })
                .collect(),
            constant: (load.wrenches.iter())
                .map(|(point, force, moment)| (number(point), *force, *moment))
                .collect(),
            joints: load.joints.clone(),
            columns: scales
                .map(|(joint, scale)| (places.of(Unknown::Joint(joint)), *scale))
                .collect(),
            parameters: mechanism.parameters().iter().map(|of| of.value).collect(),
            centre: mechanism.dimensions().centre,
            twists: FrameTwists::sharing(kinematics, &dimensions, unknowns, &points),
            own: own.clone(),
            points,
        }
    }

    /// rad or m in one unit of a joint's dimensionless variable.
    pub fn joint_scale(&self, joint: usize) -> f64 {
        self.columns[joint].1
    }

    /// The points at which something acts.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Point `i` where frames are placed, in m from the centre.
    pub fn origin(&self, i: usize, placement: &Placement<T>) -> Vector3<T> {
        self.twists.origin(i, placement)
    }

    /// Everything that acts at a configuration where frames are placed; dampers and inertia only where it moves.
    pub fn act(
        &self,
        at: &Configuration<T>,
        placement: &Placement<T>,
        moving: Option<Moving<T>>,
        acting: &mut Acting<T>,
    ) {
        let still = [Vector3::zero(); 2];
        acting.wrenches.clear();
        acting.wrenches.resize(self.points.len(), still);
        acting.efforts.clear();
        acting.efforts.resize(self.columns.len(), T::zero());
        (acting.potential, acting.kinetic, acting.supplied) = (T::zero(), T::zero(), T::zero());
        acting.pulls.clear();
        acting.powers.clear();
        let constant = |x: &[f64; 3]| Vector3(x.map(T::from_f64));
        for (i, force, moment) in &self.constant {
            acting.wrenches[*i][0] += constant(force);
            acting.wrenches[*i][1] += constant(moment);
        }
        for &(joint, effort) in &self.joints {
            acting.efforts[joint] += T::from_f64(effort);
        }
        let here = Here {
            of: self,
            at,
            placement,
            moving,
        };
        for (i, force, moment) in &self.constant {
            if let Some([omega, velocity]) = here.motion(*i) {
                acting.supplied += velocity.dot(&constant(force)) + omega.dot(&constant(moment));
            }
        }
        for &(joint, effort) in &self.joints {
            acting.supplied += here
                .rate(joint)
                .map_or(T::zero(), |rate| rate.scale(effort));
        }
        self.weigh(&here, acting);
        for (spring, place) in self.own.springs.iter().zip(&self.springs) {
            let (x, rate) = here.extension(*place);
            let n = T::from_f64;
            let (stiffness, preload) = (n(spring.stiffness), n(spring.preload));
            let out = x - n(spring.rest);
            let one_way = |effort: T| match spring.only {
                None => effort,
                Some(sign) if sign > 0.0 => effort.greater(T::zero()),
                Some(_) => effort.lesser(T::zero()),
            };
            let elastic = preload + stiffness * out;
            let kept = one_way(elastic);
            acting.potential += match spring.stiffness > 0.0 {
                true => (kept * kept).scale(0.5 / spring.stiffness),
                false => kept * out,
            };
            let effort = match (spring.damping > 0.0, rate) {
                (true, Some(rate)) => {
                    let damped = one_way(elastic + rate.scale(spring.damping));
                    // a slack rope has no damping, but one-way dampers have no other force
                    let any = spring.stiffness > 0.0 || spring.preload != 0.0;
                    match spring.only.filter(|_| any) {
                        Some(sign) => T::zero().if_less(elastic.scale(sign), damped, T::zero()),
                        None => damped,
                    }
                }
                _ => kept,
            };
            let rate = rate.unwrap_or(T::zero());
            acting.supplied += (kept - effort) * rate;
            acting.powers.push(-(effort * rate));
            acting.pulls.push(effort);
            self.pull(&here, *place, effort, acting);
        }
        for (force, place) in self.own.forces.iter().zip(&self.forces) {
            let value = |of: &GivenValue| of.at(&|of: &Measured| here.value(of));
            let mut power = T::zero();
            match (&force.on, *place) {
                (GivenEffort::Along(_, given), place) => {
                    // positive towards higher values of a joint, but towards one another of points
                    let effort = match place {
                        LoadPlace::Joint(_) => -value(given),
                        _ => value(given),
                    };
                    if let (_, Some(rate)) = here.extension(place) {
                        power = -(effort * rate);
                    }
                    acting.pulls.push(effort);
                    self.pull(&here, place, effort, acting);
                }
                (
                    GivenEffort::At {
                        wrench, follows, ..
                    },
                    LoadPlace::At(i),
                ) => {
                    let values = wrench.each_ref().map(value);
                    let [fx, fy, fz, mx, my, mz] = values;
                    let turned = |v: Vector3<T>| match follows {
                        true => self.twists.frame(i, placement).rotation * v,
                        false => v,
                    };
                    let (force, moment) =
                        (turned(Vector3([fx, fy, fz])), turned(Vector3([mx, my, mz])));
                    if let Some([omega, velocity]) = here.motion(i) {
                        power = force.dot(&velocity) + moment.dot(&omega);
                    }
                    acting.pulls.push(T::zero());
                    acting.wrenches[i][0] += force;
                    acting.wrenches[i][1] += moment;
                }
                (GivenEffort::At { .. }, _) => {}
            }
            acting.supplied += power;
            acting.powers.push(power);
        }
    }

    /// An effort that pulls two points together, or a joint to lower values.
    fn pull(&self, here: &Here<T>, place: LoadPlace, effort: T, acting: &mut Acting<T>) {
        match place {
            LoadPlace::Joint(joint) => acting.efforts[joint] -= effort,
            LoadPlace::Points(a, b) => {
                let (_, direction) = here.line(a, b);
                let force = direction.times(effort);
                acting.wrenches[a][0] += force;
                acting.wrenches[b][0] += -force;
            }
            LoadPlace::At(_) => {}
        }
    }

    /// The power of what acts for dimensionless rates of the unknowns, in W.
    pub fn power(&self, acting: &Acting<T>, rates: &[T], placement: &Placement<T>) -> T {
        let mut power = T::zero();
        for (i, [force, moment]) in acting.wrenches.iter().enumerate() {
            let twist = self.twists.twist(i, placement, rates);
            power += twist.velocity.dot(force) + twist.omega.dot(moment);
        }
        for (effort, (column, scale)) in acting.efforts.iter().zip(&self.columns) {
            if let Some(column) = column {
                power += (*effort * rates[*column]).scale(*scale);
            }
        }
        power
    }
}
