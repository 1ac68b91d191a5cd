//! Rates and accelerations of all unknowns for those of the held coordinates.

mod frames;
mod held;

use crate::geometry::{Quaternion, Vector3};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Frame, Kinematics, Mechanism, Placement, PlatformPose};
use crate::number::{Dual, Number};
use crate::solve::Equations;
use crate::system::{ClosureWrenches, Coordinate, Held, System, SystemWork, Unknown};

use super::driving::{Driving, Entrance};
pub use frames::FrameMotion;

/// Solves the derivatives of the closure equations r(x, h) = 0 for given rates of the held coordinates h. Built once;
/// nothing allocates afterwards.
///
/// ṙ = J ẋ + H ḣ = 0 gives ẋ = −J⁺ H ḣ, where H ḣ are the rates of the rows in a motion of h alone, and r̈ = 0 gives
/// ẍ = −J⁺ γ, where γ is r̈ along the path that has these rates and no acceleration but that of h.
///
/// Over [`Recorded`](crate::algebra::Recorded) numbers it writes down how.
///
/// Rates are dimensionless in the order of [`Motion::unknowns`]: rad and characteristic lengths. At a singular
/// configuration they are one choice of many ([`Freedoms`](super::Freedoms) of [`Motion::held`]).
#[derive(Clone, Debug)]
pub struct Motion<T: Factorable = f64> {
    coordinates: Vec<Coordinate>,
    driving: Driving,
    /// Sizes of the held coordinates' dimensionless units, in m and rad.
    units: Vec<T>,
    held: Held<f64>,
    system: System<T>,
    work: SystemWork<T>,
    changing: ChangingSystem<T>,
    length: f64,
    scales: Vec<f64>,
    unknowns: Vec<Unknown>,
    here: Configuration<T>,
    /// Rates and accelerations of the held coordinates, dimensionless.
    given: [Vec<T>; 2],
    rates: Vec<T>,
    accelerations: Vec<T>,
    opening: Vec<T>,
}

/// The equations along a path.
#[derive(Clone, Debug)]
struct ChangingSystem<T: Factorable> {
    system: System<Dual<T>>,
    work: SystemWork<Dual<T>>,
    /// For each row of the real equations that of these, which may be ordered otherwise.
    rows: Vec<usize>,
    path: Configuration<Dual<T>>,
    rates: Vec<Dual<T>>,
    /// True if the frames are placed along the path of the rates last computed.
    placed: bool,
}

impl<T: Factorable> ChangingSystem<T> {
    fn new(
        mechanism: &Mechanism,
        held: &Held<f64>,
        frames: &[Frame],
        of: (&System<T>, &[Unknown], &Configuration<T>),
    ) -> Self {
        let (real, unknowns, home) = of;
        let constant = Dual::from_f64;
        let dimensions = mechanism.dimensions().map(constant);
        let system = System::placing(mechanism, &dimensions, &held.map(constant), frames);
        let mut rows: Vec<usize> = vec![0; real.rows()];
        let mut next = 0;
        for (here, there) in real.closure_rows().zip(system.closure_rows()) {
            next = next.max(here.end);
            here.zip(there).for_each(|(h, t)| rows[h] = t);
        }
        (next..real.rows()).for_each(|row| rows[row] = row);
        ChangingSystem {
            work: system.work(),
            rates: vec![constant(0.0); unknowns.len()],
            path: home.map(Dual::constant),
            placed: false,
            system,
            rows,
        }
    }
}

impl<T: Factorable> Motion<T> {
    /// The motion for a choice of held coordinates.
    pub fn new(mechanism: &Mechanism, coordinates: &[Coordinate]) -> Self {
        Motion::placing(mechanism, coordinates, &[], |held| held)
    }

    /// As [`Motion::new`], with frames to be placed and further coordinates held still, such as local spins.
    pub fn placing(
        mechanism: &Mechanism,
        coordinates: &[Coordinate],
        frames: &[Frame],
        still: impl FnOnce(Held<f64>) -> Held<f64>,
    ) -> Self {
        let held = still(held::of(mechanism, coordinates));
        let dimensions = mechanism.dimensions();
        let system = {
            let dimensions = dimensions.map(T::from_f64);
            System::placing(mechanism, &dimensions, &held.map(T::from_f64), frames)
        };
        let joints = (0..mechanism.joints().len()).map(Unknown::Joint);
        let platforms = (0..mechanism.platforms().len())
            .flat_map(|platform| (0..6).map(move |component| Unknown::Twist(platform, component)));
        let unknowns: Vec<Unknown> = joints.chain(platforms).collect();
        let length = dimensions.characteristic_length;
        let scales = dimensions.joint_scales.clone();
        let unit = |of: &Coordinate| T::from_f64(of.scale(mechanism));
        let home = mechanism.home().map(T::from_f64);
        Motion {
            driving: Driving::new(&system, &held, coordinates),
            units: coordinates.iter().map(unit).collect(),
            coordinates: coordinates.to_vec(),
            work: system.work(),
            changing: ChangingSystem::new(mechanism, &held, frames, (&system, &unknowns, &home)),
            given: [(); 2].map(|()| vec![T::zero(); coordinates.len()]),
            rates: vec![T::zero(); unknowns.len()],
            accelerations: vec![T::zero(); unknowns.len()],
            opening: vec![T::zero(); unknowns.len()],
            here: home,
            length,
            scales,
            held,
            system,
            unknowns,
        }
    }

    /// The held coordinates in the form of the solver, every platform coordinate singly unless it turns as a whole.
    pub fn held(&self) -> &Held<f64> {
        &self.held
    }

    /// The held coordinates.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// All joints, then six twist components of each platform.
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// The order in which its frames are placed.
    pub fn kinematics(&self) -> &Kinematics<T> {
        self.system.kinematics()
    }

    /// Its frames where it was last factorised.
    pub fn placement(&self) -> &Placement<T> {
        self.system.placement(&self.work)
    }

    /// Factorises at an assembled configuration, for [`Motion::rates`] and [`Motion::accelerations`] that follow.
    pub fn at(&mut self, at: &Configuration<T>) {
        self.here.clone_from(at);
        for (platform, pose) in at.platforms.iter().enumerate() {
            self.system
                .set_orientation(platform, pose.orientation.rotation());
        }
        // over numbers that are not real the rows of angles are right at their values only
        let held = self.coordinates.iter().filter(|_| !T::REAL);
        for of in held {
            if let Coordinate::Pose(platform, c) = *of {
                self.system
                    .set_target_about_centre(platform, c, of.about_centre(at));
            }
        }
        self.system.linearise(at, &mut self.work);
        self.system.factorise(0.0, &mut self.work);
        self.changing.placed = false;
    }

    /// Rates of all unknowns for rates of the held coordinates, in m and rad per unit of time.
    pub fn rates(&mut self, given: &[T]) -> &[T] {
        self.give(0, given);
        self.solve_rates()
    }

    fn give(&mut self, order: usize, given: &[T]) {
        let given = given.iter().zip(&self.units);
        for (to, (&rate, &unit)) in self.given[order].iter_mut().zip(given) {
            *to = rate / unit;
        }
    }

    fn solve_rates(&mut self) -> &[T] {
        self.changing.placed = false;
        let (system, given) = (&self.system, &self.given[0]);
        (self.driving).rates(system, &self.here, given, &mut self.work, &mut self.rates);
        &self.rates
    }

    /// The rates of all rows for the rates of all unknowns and those given.
    fn row_rates(&mut self) -> &mut [T] {
        let (system, given) = (&self.system, &self.given[0]);
        (self.driving).row_rates(system, &self.here, given, &mut self.work, &self.rates)
    }

    /// Rates of all unknowns for unit rates of the held coordinates, one at a time.
    pub fn responses(&mut self) -> Vec<Vec<T>> {
        let all = 0..self.coordinates.len();
        all.map(|i| self.response(i).to_vec()).collect()
    }

    /// Rates of all unknowns for a unit rate of one held coordinate, the others at rest.
    pub fn response(&mut self, i: usize) -> &[T] {
        self.given[0].fill(T::zero());
        self.given[0][i] = T::one() / self.units[i];
        self.solve_rates()
    }

    /// The number of rows of the closures.
    pub fn rows(&self) -> usize {
        self.system
            .closure_rows()
            .map(|rows| rows.end)
            .max()
            .unwrap_or(0)
    }

    /// Rates of all unknowns in a motion −J⁺ e, in which one row of the closures opens while held coordinates are at rest,
    /// as far as the other rows let it.
    pub fn opening(&mut self, row: usize) -> &[T] {
        self.opening.fill(T::zero());
        let residual = self.system.residual_mut(&mut self.work);
        residual.fill(T::zero());
        residual[row] = T::one();
        let (system, work) = (&self.system, &mut self.work);
        self.driving.rest(system, work, &mut self.opening);
        &self.opening
    }

    /// The wrenches of every closure's rows where it was last factorised.
    pub fn closure_wrenches(&self) -> Vec<ClosureWrenches<T>> {
        self.system.closure_wrenches(&self.here, &self.work)
    }

    /// Sets the rates to a sum of [responses](Self::responses); those of coordinates at rest need not be known.
    pub fn set_rates(&mut self, responses: &[Vec<T>], given: &[T]) {
        self.give(0, given);
        self.changing.placed = false;
        self.rates.fill(T::zero());
        let moving = responses.iter().zip(given);
        for (response, &rate) in moving.filter(|(_, rate)| **rate != T::zero()) {
            let both = self.rates.iter_mut().zip(response);
            both.for_each(|(sum, &x)| *sum += rate * x);
        }
    }

    /// The latest rates and [accelerations](Self::accelerations), with frames placed along the path of these rates.
    pub fn changes(&self) -> (&[Dual<T>], &Placement<Dual<T>>) {
        let ChangingSystem {
            system,
            work,
            rates,
            ..
        } = &self.changing;
        (rates, system.placement(work))
    }

    /// The rates and accelerations last computed.
    pub fn known(&self) -> [&[T]; 2] {
        [&self.rates, &self.accelerations]
    }

    /// True if rates and accelerations are determined where it was last factorised.
    pub fn is_determined(&self) -> bool {
        self.system.undetermined(&self.work) == 0
    }

    /// Places the frames along the path x ⊕ t ẋ.
    fn follow(&mut self) {
        let ChangingSystem {
            system,
            work,
            path,
            rates,
            placed,
            ..
        } = &mut self.changing;
        let both = self.rates.iter().zip(&self.accelerations);
        for (known, (&value, &slope)) in rates.iter_mut().zip(both) {
            *known = Dual { value, slope };
        }
        if *placed {
            return;
        }
        *placed = true;
        let joints = self.here.joints.iter().zip(&self.rates).zip(&self.scales);
        for (path, ((&value, &rate), scale)) in path.joints.iter_mut().zip(joints) {
            let slope = rate.scale(*scale);
            *path = Dual { value, slope };
        }
        let twists = self.rates[self.scales.len()..].chunks_exact(6);
        for ((path, pose), twist) in path
            .platforms
            .iter_mut()
            .zip(&self.here.platforms)
            .zip(twists)
        {
            *path = moved(pose, self.length, twist);
        }
        system.place(path, work);
    }

    /// The accelerations of all rows for the rates and accelerations of all unknowns and those given.
    fn row_changes(&mut self) -> &[T] {
        self.follow();
        let ChangingSystem {
            system,
            work,
            rows,
            path,
            rates,
            ..
        } = &mut self.changing;
        let found = system.row_rates(path, rates, work);
        let right = self.system.residual_mut(&mut self.work);
        for (right, &row) in right.iter_mut().zip(&*rows) {
            *right = found[row].slope;
        }
        for (entrance, change) in self.driving.entering(&self.here, &self.given[1]) {
            if let Entrance::Row(row) = entrance {
                right[row] -= change;
            }
        }
        right
    }

    /// Accelerations for the rates last computed and those of held coordinates, in m and rad per unit of time squared.
    pub fn accelerations(&mut self, given: &[T]) -> &[T] {
        self.give(1, given);
        self.accelerations.fill(T::zero());
        // no angle is held by itself beside a whole orientation, so that components are changes
        for (entrance, change) in self.driving.entering(&self.here, &self.given[1]) {
            if let Entrance::Unknown(place) = entrance {
                self.accelerations[place] = change;
            }
        }
        self.row_changes();
        self.driving
            .rest(&self.system, &mut self.work, &mut self.accelerations);
        self.follow();
        &self.accelerations
    }
}

impl Motion {
    /// The largest dimensionless rate at which a closure would open: rounding, unless the held coordinates cannot move
    /// so.
    pub fn mismatch(&mut self) -> f64 {
        largest(self.row_rates())
    }

    /// The largest acceleration at which one would open: more than rounding where only rates are possible.
    pub fn mismatch_of_accelerations(&mut self) -> f64 {
        largest(self.row_changes())
    }
}

fn largest(all: &[f64]) -> f64 {
    all.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// A pose displaced by a twist (ω; v/L) for an instant.
fn moved<T: Number>(pose: &PlatformPose<T>, length: f64, twist: &[T]) -> PlatformPose<Dual<T>> {
    let still = PlatformPose {
        orientation: Quaternion(pose.orientation.0.map(Dual::constant)),
        position: Vector3(pose.position.0.map(Dual::constant)),
    };
    let slope = |slope| Dual {
        value: T::zero(),
        slope,
    };
    let omega = Vector3([0, 1, 2].map(|k| slope(twist[k])));
    let shift = Vector3([3, 4, 5].map(|k| slope(twist[k].scale(length))));
    still.moved_by(&omega, shift)
}
