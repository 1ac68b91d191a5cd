//! Masses, springs, forces and friction with their values.

mod build;

use super::{Measured, Point};
use crate::algebra::Expression;
use crate::number::Number;

/// Loads of a mechanism, in kg, N, m, rad and s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// The acceleration of free fall in ground, in m/s².
    pub gravity: [f64; 3],
    /// Bodies with mass, or parts of them.
    pub masses: Vec<Mass>,
    /// Springs and dampers.
    pub springs: Vec<Spring>,
    /// Forces and moments that are given.
    pub forces: Vec<GivenForce>,
    /// Coulomb friction in joints.
    pub frictions: Vec<Friction>,
    /// True if bodies have weight only.
    pub without_inertia: bool,
}

/// The mass of a body, or of a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// The name of the body, or of a frame on it.
    pub name: String,
    /// The centre of mass.
    pub centre: Point,
    /// In kg.
    pub mass: f64,
    /// The tensor of inertia about the centre along the axes of its frame, in kg·m².
    pub inertia: [[f64; 3]; 3],
}

/// The place at which a spring or a force acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// On the line of two points, whose distance counts, in m.
    Points([Point; 2]),
    /// Along the variable of the joint of that index, in m or rad.
    Joint(usize),
}

/// A spring with a damper beside it. Its effort pulls two points together, or the joint to lower values:
/// preload + stiffness·(x − rest) + damping·ẋ.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Its name.
    pub name: String,
    /// Its place.
    pub along: Along,
    /// In N/m, at a hinge N·m/rad.
    pub stiffness: f64,
    /// The length or angle at which stiffness gives no effort.
    pub rest: f64,
    /// Effort there, in N or N·m.
    pub preload: f64,
    /// In N·s/m, at a hinge N·m·s/rad.
    pub damping: f64,
    /// The only sign that its effort can have, as that of a rope, which pulls: 1, or of a stop, which pushes: −1.
    pub only: Option<f64>,
}

/// A value over quantities, times one read off a table.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenValue {
    /// The value, or the factor of that of the table.
    pub value: Expression<Measured>,
    /// The argument of the table and its rows, ascending.
    pub table: Option<(Expression<Measured>, Vec<[f64; 2]>)>,
}

/// A force or moment that is given.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenForce {
    /// Its name.
    pub name: String,
    /// Its place and values.
    pub on: GivenEffort,
}

/// Place and values of a given force, in N and N·m.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenEffort {
    /// It acts on a joint towards higher values, or pulls two points together.
    Along(Along, Box<GivenValue>),
    /// Force at a point and moment, in ground or along the axes of the point's frame.
    At {
        /// The point.
        point: Point,
        /// Components of the force, then of the moment.
        wrench: Box<[GivenValue; 6]>,
        /// True if along the axes of the point's frame.
        follows: bool,
    },
}

/// Coulomb friction in a joint: at most so much, against the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Its name.
    pub name: String,
    /// The joint.
    pub joint: usize,
    /// A constant part, in N or N·m.
    pub constant: f64,
    /// The coefficient of friction; in a hinge the moment is ρ·sin(atan μ) times the force across the pin, with its
    /// radius ρ, in a slide the force is μ times that across it.
    pub coefficient: f64,
    /// The radius of the pin, in m.
    pub radius: f64,
}

impl Loads {
    /// The names of masses, springs, forces and friction, in this order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let masses = self.masses.iter().map(|of| &*of.name);
        let springs = self.springs.iter().map(|of| &*of.name);
        let forces = self.forces.iter().map(|of| &*of.name);
        let frictions = self.frictions.iter().map(|of| &*of.name);
        masses.chain(springs).chain(forces).chain(frictions)
    }

    /// Leaves out one group of what acts, or one part by its name. Returns the names that are known if this is none.
    pub fn leave_out(&mut self, name: &str) -> Option<Vec<String>> {
        match name {
            "weight" => self.gravity = [0.0; 3],
            "inertia" => self.without_inertia = true,
            "springs" => self.springs.clear(),
            "forces" => self.forces.clear(),
            "friction" => self.frictions.clear(),
            _ => {
                let groups = ["weight", "inertia", "springs", "forces", "friction"];
                let mut known: Vec<String> = groups.map(str::to_owned).into();
                known.extend(self.names().map(str::to_owned));
                if !known.iter().any(|of| of == name) {
                    return Some(known);
                }
                self.masses.retain(|of| of.name != name);
                self.springs.retain(|of| of.name != name);
                self.forces.retain(|of| of.name != name);
                self.frictions.retain(|of| of.name != name);
            }
        }
        None
    }

    /// True if nothing acts.
    pub fn is_empty(&self) -> bool {
        let Loads {
            gravity: _,
            without_inertia: _,
            masses,
            springs,
            forces,
            frictions,
        } = self;
        masses.is_empty() && springs.is_empty() && forces.is_empty() && frictions.is_empty()
    }
}

impl Friction {
    /// The factor of the force across the joint: ρ·sin(atan μ) of a hinge in m, μ of a slide.
    pub fn factor(&self, turns: bool) -> f64 {
        let mu = self.coefficient;
        match turns {
            true => self.radius * mu / (1.0 + mu * mu).sqrt(),
            false => mu,
        }
    }
}

impl GivenValue {
    /// The value where quantities have these values; not a number where it has none.
    pub fn at<T: Number>(&self, of: &impl Fn(&Measured) -> T) -> T {
        let nothing = T::from_f64(f64::NAN);
        let value = self.value.evaluate(of).unwrap_or(nothing);
        let Some((argument, rows)) = &self.table else {
            return value;
        };
        let x = argument.evaluate(of).unwrap_or(nothing);
        // a sum of ramps, each of which stands still outside its own piece
        let pieces = rows.windows(2).map(|pair| {
            let [[low, from], [high, to]] = [pair[0], pair[1]];
            let [start, end] = [low, high].map(T::from_f64);
            (x.greater(start).lesser(end) - start).scale((to - from) / (high - low))
        });
        let first = rows.first().map_or(0.0, |row| row[1]);
        value * pieces.fold(T::from_f64(first), |sum, ramp| sum + ramp)
    }

    /// The quantities in it.
    pub fn measured(&self) -> impl Iterator<Item = &Measured> {
        let table = self.table.iter().flat_map(|(argument, _)| argument.names());
        self.value.names().chain(table).map(|(of, _)| of)
    }
}

impl GivenForce {
    /// Its values.
    pub fn values(&self) -> &[GivenValue] {
        match &self.on {
            GivenEffort::Along(_, value) => std::slice::from_ref(&**value),
            GivenEffort::At { wrench, .. } => &wrench[..],
        }
    }
}
