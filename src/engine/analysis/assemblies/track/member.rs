//! The equations at one parameter value of a homotopy.

use std::sync::Arc;

use crate::analysis::assemblies::family::{C, Coordinates, Family, Input, Member};
use crate::geometry::{Quaternion, Vector3};
use crate::linear::RANK_TOLERANCE;
use crate::mechanism::{Configuration, PlatformPose};
use crate::number::{Dual, complex::norm};
use crate::solve::Equations;
use crate::system::{ConstantsCourse, System, SystemWork};

/// s at both ends of a way.
pub(crate) const START: C = C::new(0.0, 0.0);
pub(crate) const END: C = C::new(1.0, 0.0);

/// The straight segment from one member to another: its start and the difference.
#[derive(Clone, Debug)]
pub(crate) struct MemberSegment {
    pub from: Member,
    pub change: Member,
    /// True if dimensions change, false if only inputs do.
    pub resized: bool,
    /// A row, and what it is to be more at the end.
    pub raised: Option<(usize, C)>,
}

impl MemberSegment {
    pub fn new(from: &Member, to: &Member) -> Self {
        let difference = |a: &[C], b: &[C]| a.iter().zip(b).map(|(a, b)| b - a).collect::<Vec<C>>();
        let change = Member {
            parameters: difference(&from.parameters, &to.parameters),
            inputs: difference(&from.inputs, &to.inputs),
        };
        MemberSegment {
            resized: change.parameters.iter().any(|x| x.norm_sqr() > 0.0),
            from: from.clone(),
            change,
            raised: None,
        }
    }

    fn parameters(&self, s: C) -> Vec<C> {
        let moved = self.from.parameters.iter().zip(&self.change.parameters);
        moved.map(|(a, d)| a + d * s).collect()
    }
}

/// A member's equations, with storage for evaluating them.
#[derive(Clone, Debug)]
pub(crate) struct MemberEquations {
    pub system: System<C>,
    pub work: SystemWork<C>,
    /// The configuration last evaluated.
    pub at: Configuration<C>,
    /// True if all expressions have values here.
    pub sound: bool,
    inputs: Vec<C>,
    /// A row, and what it is to be more here.
    raised: Option<(usize, C)>,
    s: Option<C>,
    /// The way of the dimensions as numbers, where their relations need not be kept.
    numbers: Option<Arc<ConstantsCourse<C>>>,
    /// Rates of joints.
    rates: Vec<C>,
    /// Rotation rates and velocities of ground, platforms and all frames that are placed.
    slots: Vec<(Vector3<C>, Vector3<C>)>,
}

impl MemberEquations {
    /// The equations at s = 0. `None` if an expression has no value there.
    pub fn start(family: &Family, course: &MemberSegment) -> Option<Self> {
        let system = family.system(&course.from.parameters)?;
        if course.resized && family.is_free {
            let end = family.system(&course.parameters(END))?;
            let way = MemberEquations::between(family, course, (&system, &end));
            if way.is_some() {
                return way;
            }
        }
        Some(MemberEquations::new(family, course, system, None))
    }

    /// At the first of two systems, on the way of the numbers of one to those of the other.
    pub fn between(
        family: &Family,
        course: &MemberSegment,
        (from, to): (&System<C>, &System<C>),
    ) -> Option<Self> {
        let (system, way) = from.towards(to)?;
        Some(MemberEquations::new(
            family,
            course,
            system,
            Some(Arc::new(way)),
        ))
    }

    fn new(
        family: &Family,
        course: &MemberSegment,
        system: System<C>,
        numbers: Option<Arc<ConstantsCourse<C>>>,
    ) -> Self {
        let mut place = MemberEquations {
            work: system.work(),
            system,
            at: family.home.map(|x| C::new(x, 0.0)),
            sound: true,
            inputs: course.from.inputs.clone(),
            raised: None,
            s: None,
            numbers,
            rates: vec![START; family.home.joints.len()],
            slots: Vec::new(),
        };
        place.go(family, course, START);
        place
    }

    /// Changes the equations to those at another s.
    pub fn go(&mut self, family: &Family, course: &MemberSegment, s: C) {
        if self.s == Some(s) {
            return;
        }
        self.s = Some(s);
        if let Some(numbers) = &self.numbers {
            self.system.go(numbers, s, &mut self.work);
        } else if course.resized {
            let system = family.system(&course.parameters(s));
            self.sound = system.is_some();
            if let Some(system) = system {
                self.system = system;
                self.system.refit(&mut self.work);
            }
        }
        self.raised = course.raised.map(|(row, more)| (row, more * s));
        let inputs = course.from.inputs.iter().zip(&course.change.inputs);
        for (x, (a, d)) in self.inputs.iter_mut().zip(inputs) {
            *x = a + d * s;
        }
        let quaternion = |x: &[C]| Quaternion([x[0], x[1], x[2], x[3]]).normalised();
        for (input, x) in family.coordinates.split(&self.inputs) {
            match input {
                Input::Joint(j) => self.at.joints[j] = x[0],
                Input::Pose(p) => {
                    self.at.platforms[p] = PlatformPose {
                        orientation: quaternion(x),
                        position: Vector3([x[4], x[5], x[6]]),
                    }
                }
                Input::Target(p, coordinate) => {
                    self.system.set_target_about_centre(p, coordinate, x[0])
                }
                Input::Orientation(p) => {
                    self.system.set_orientation(p, quaternion(x).rotation());
                }
            }
        }
    }

    /// ∂h/∂s where frames were last placed, in place of the residual; true if there is one.
    pub fn drift(&mut self, family: &Family, course: &MemberSegment) -> bool {
        /// Step of s over which dimensions are compared where their relations are kept.
        const APART: f64 = 1e-7;
        let s = self.s.unwrap_or(START);
        let still = (Vector3::zero(), Vector3::zero());
        self.slots
            .resize(self.system.placement(&self.work).0.len(), still);
        let coordinates = &family.coordinates;
        let quaternion = |x: &[C]| Quaternion([x[0], x[1], x[2], x[3]]);
        let changes = || {
            let changes = coordinates.split(&course.change.inputs);
            coordinates.split(&self.inputs).zip(changes)
        };
        for ((input, x), (_, change)) in changes() {
            match input {
                Input::Joint(j) => self.rates[j] = change[0],
                Input::Pose(p) => {
                    let omega = quaternion(x).turning(&quaternion(change));
                    self.slots[1 + p] = (omega, Vector3([change[4], change[5], change[6]]));
                }
                Input::Target(..) | Input::Orientation(_) => {}
            }
        }
        let mut way = self.numbers.as_ref().map(|numbers| (numbers.clone(), s));
        if course.resized && way.is_none() {
            // from here to a little ahead, as so much of a way
            let ahead = family.system(&course.parameters(s + APART));
            let ahead = ahead.and_then(|ahead| self.system.towards(&ahead));
            let Some((_, ahead)) = ahead else {
                return false;
            };
            way = Some((Arc::new(ahead.stretched(1.0 / APART)), START));
        }
        let way = way.as_ref().map(|(course, s)| (&**course, *s));
        let (system, work) = (&self.system, &mut self.work);
        system.drift(&self.at, &self.rates, way, &mut self.slots, work);
        if let Some((row, more)) = course.raised {
            system.residual_mut(work)[row] -= more;
        }
        for ((input, x), (_, change)) in changes() {
            let dual = |i: usize| Dual {
                value: x[i],
                slope: change[i],
            };
            match input {
                Input::Joint(_) | Input::Pose(_) => {}
                Input::Target(p, c) => system.add_target_rate((p, c), dual(0), &self.at, work),
                Input::Orientation(p) => {
                    let wanted = Quaternion([0, 1, 2, 3].map(dual)).normalised().rotation();
                    system.add_orientation_rate(p, &wanted, &self.at, work);
                }
            }
        }
        true
    }

    /// True if the place last evaluated is one of infinitely many solutions, because a joint never comes back to the
    /// same place.
    ///
    /// A screw's angle φ enters by cos φ and sin φ, its travel t = hφ linearly. Where both may vary apart from each other a
    /// surface of solutions, algebraic in t and e^{iφ}, passes through this one, and the screw's own are where
    /// it meets t = hφ: no end of them, unless t is the same all over the surface, as where a nut is held.
    pub fn is_endless(&self, family: &Family, course: &MemberSegment) -> bool {
        let Coordinates {
            screws,
            incommensurate,
            ..
        } = &family.coordinates;
        let freedom = |travel_is_held: bool| {
            let s = self.s.unwrap_or(START);
            let mut dimensions = family.dimensions(&course.parameters(s))?;
            let (mut held, mut at) = (family.held.clone(), self.at.clone());
            for &screw in screws {
                dimensions.detach_travel(screw, at.joints.len());
                held.joints.push(travel_is_held);
                at.joints.push(at.joints[screw]);
            }
            let system = System::new(&dimensions, &held);
            let mut apart = MemberEquations {
                work: system.work(),
                system,
                at,
                s: None,
                numbers: None,
                ..self.clone()
            };
            apart.go(family, course, s);
            apart.linearise();
            Some(apart.system.nullity(RANK_TOLERANCE, &apart.work))
        };
        !incommensurate.is_empty() || !screws.is_empty() && freedom(false) > freedom(true)
    }

    /// Residual and Jacobian at `at`; returns the largest residual.
    pub fn linearise(&mut self) -> f64 {
        let largest = self.system.linearise(&self.at, &mut self.work).largest;
        self.lowered(largest)
    }

    /// The largest residual at `at`.
    pub fn residual(&mut self) -> f64 {
        let largest = self.system.residual(&self.at, &mut self.work).largest;
        self.lowered(largest)
    }

    /// The largest residual once that of a row that is to be more is less.
    fn lowered(&mut self, largest: f64) -> f64 {
        let Some((row, more)) = self.raised else {
            return largest;
        };
        let residual = self.system.residual_mut(&mut self.work);
        residual[row] -= more;
        residual.iter().map(|x| norm(*x)).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::Description;
    use crate::mechanism::Mechanism;
    use crate::number::tolerance::DIFFERENCE;
    use crate::solve::Homotopy;
    use crate::system::Question;
    use rand::SeedableRng;

    /// A way on which dimensions change gives the same wherever it was before, and factors last
    /// made serve beside the place ahead that rates are taken from.
    #[test]
    fn a_place_that_was_left_and_come_back_to_is_the_same() {
        let text = include_str!("../../../../../mechanisms/three_rps.ron");
        let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
        let family = Family::new(&mechanism, &Question::new(&mechanism).held());
        let mut rng = rand_pcg::Pcg64::seed_from_u64(5);
        let from = family.generic_member(&mut rng);
        let to = Member {
            parameters: family.random_parameters(&mut rng, 1.0),
            inputs: family.random_inputs(&mut rng, 1.0),
        };
        let x = family.random_point(&mut rng, 1.0);
        let s = C::new(0.3, 0.1);
        let mut fresh = family.homotopy(&from, &to).unwrap();
        let expected = fresh.evaluated(s, &x);
        let (mut rate, mut again) = (x.clone(), x.clone());
        assert!(fresh.velocity(s, &x, &mut rate));
        let mut homotopy = family.homotopy(&from, &to).unwrap();
        for elsewhere in [C::new(0.7, 0.0), C::new(1.0, -0.2)] {
            assert!(homotopy.velocity(elsewhere, &x, &mut again));
            assert_ne!(again, rate);
        }
        assert_eq!(homotopy.evaluated(s, &x), expected);
        homotopy.linearise(s, &x);
        for _ in 0..2 {
            assert!(homotopy.velocity_again(s, &x, &mut again));
            assert_eq!(again, rate);
        }
        // the rate is that of the residual: J dx/ds + ∂h/∂s = 0
        let moved = |length: f64| -> Vec<C> {
            let pairs = x.iter().zip(&rate);
            let mut y: Vec<C> = pairs.map(|(x, r)| x + r * length).collect();
            family.coordinates.settle(&mut y);
            y
        };
        let mut at = |length: f64| {
            homotopy.residual(s + length, &moved(length));
            homotopy
                .here
                .system
                .residual_of(&homotopy.here.work)
                .to_vec()
        };
        let (after, before) = (at(DIFFERENCE), at(-DIFFERENCE));
        for (after, before) in after.iter().zip(&before) {
            let slope = (after - before) / (2.0 * DIFFERENCE);
            assert!(slope.norm() < 1e-4, "{slope}");
        }
    }
}
