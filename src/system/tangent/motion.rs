//! Rates and accelerations of all unknowns for those of the held coordinates.

mod frames;
mod held;

use crate::geometry::{Quaternion, Vector3};
use crate::linear::add;
use crate::mechanism::{Configuration, Mechanism, PlatformPose};
use crate::number::{Dual, Number};
use crate::solve::Equations;
use crate::system::{Coordinate, Held, HeldPlatform, System, Unknown, Work};

pub use frames::{FrameMotion, FrameMotions};

/// A number with first and second derivative along a path: 1, ε₁, ε₂, ε₁ε₂.
type Second = Dual<Dual<f64>>;

/// Solves the derivatives of the closure equations r(x, h) = 0 for given rates of the held
/// coordinates h. Built once; nothing allocates afterwards.
///
/// ṙ = J ẋ + H ḣ = 0 gives ẋ = −J⁺ H ḣ, and r̈ = 0 gives ẍ = −J⁺ γ, where γ is r̈ along the path
/// that has these rates and no acceleration but that of h. H ḣ and γ are the derivatives of the
/// same residuals over dual numbers.
///
/// Rates are dimensionless in the order of [`Motion::unknowns`]: rad and characteristic lengths.
/// At a singular configuration they are one choice of many; see [`Motion::held`] with
/// [`Freedoms`](super::Freedoms).
#[derive(Clone, Debug)]
pub struct Motion {
    coordinates: Vec<Coordinate>,
    held: Held<f64>,
    system: System<f64>,
    work: Work<f64>,
    first: System<Dual<f64>>,
    first_work: Work<Dual<f64>>,
    second: System<Second>,
    second_work: Work<Second>,
    /// For each row of the real equations that of the others, which may be ordered otherwise.
    rows: Vec<usize>,
    length: f64,
    scales: Vec<f64>,
    unknowns: Vec<Unknown>,
    first_path: Configuration<Dual<f64>>,
    second_path: Configuration<Second>,
    right: Vec<f64>,
    rates: Vec<f64>,
    accelerations: Vec<f64>,
}

impl Motion {
    /// For a choice of what is held.
    pub fn new(mechanism: &Mechanism, coordinates: &[Coordinate]) -> Self {
        Motion::with(mechanism, coordinates, |held| held)
    }

    /// The same where more stands still, such as links that would spin about their own lines.
    pub fn with(
        mechanism: &Mechanism,
        coordinates: &[Coordinate],
        still: impl FnOnce(Held<f64>) -> Held<f64>,
    ) -> Self {
        let held = still(held::of(mechanism, coordinates));
        let dimensions = mechanism.dimensions();
        let system = System::new(dimensions, &held);
        let first = System::new(
            &dimensions.map(&mut Dual::constant),
            &held.map(Dual::constant),
        );
        let lift = |x| Dual::constant(Dual::constant(x));
        let second = System::new(&dimensions.map(&mut { lift }), &held.map(lift));
        let closures = system.closure_rows().zip(first.closure_rows());
        let mut rows: Vec<usize> = vec![0; system.rows()];
        let mut next = 0;
        for (here, there) in closures {
            next = next.max(here.end);
            here.zip(there).for_each(|(h, t)| rows[h] = t);
        }
        (next..system.rows()).for_each(|row| rows[row] = row);
        let joints = (0..mechanism.joints().len()).map(Unknown::Joint);
        let platforms = (0..mechanism.platforms().len()).flat_map(|platform| {
            (0..6).map(move |component| Unknown::Twist {
                platform,
                component,
            })
        });
        let unknowns: Vec<Unknown> = joints.chain(platforms).collect();
        let home = mechanism.home();
        Motion {
            coordinates: coordinates.to_vec(),
            work: system.work(),
            first_work: first.work(),
            second_work: second.work(),
            right: vec![0.0; system.rows()],
            rates: vec![0.0; unknowns.len()],
            accelerations: vec![0.0; unknowns.len()],
            first_path: home.map(Dual::constant),
            second_path: home.map(lift),
            length: dimensions.characteristic_length,
            scales: dimensions.joint_scales.clone(),
            held,
            system,
            first,
            second,
            rows,
            unknowns,
        }
    }

    /// What is held, every platform coordinate for itself.
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

    /// Factorises at an assembled configuration, for the calls of [`Motion::rates`] and
    /// [`Motion::accelerations`] that follow.
    pub fn at(&mut self, at: &Configuration<f64>) {
        for (platform, pose) in at.platforms.iter().enumerate() {
            self.system
                .set_orientation(platform, pose.orientation.rotation());
        }
        self.system.linearise(at, &mut self.work);
        self.system.factorise(0.0, &mut self.work);
        let path = self.first_path.joints.iter_mut().zip(&at.joints);
        path.for_each(|(path, &x)| path.value = x);
        let path = self.second_path.joints.iter_mut().zip(&at.joints);
        path.for_each(|(path, &x)| path.value.value = x);
        for (platform, pose) in at.platforms.iter().enumerate() {
            let (first, second) = (
                &mut self.first_path.platforms[platform],
                &mut self.second_path.platforms[platform],
            );
            for i in 0..4 {
                first.orientation.0[i] = Dual::constant(pose.orientation.0[i]);
                second.orientation.0[i] = Dual::constant(first.orientation.0[i]);
            }
            for i in 0..3 {
                first.position.0[i] = Dual::constant(pose.position.0[i]);
                second.position.0[i] = Dual::constant(first.position.0[i]);
            }
        }
    }

    /// Rates of all unknowns for rates of the held coordinates in their order, in m and rad per
    /// unit of time.
    pub fn rates(&mut self, given: &[f64]) -> &[f64] {
        for path in &mut self.first_path.joints {
            path.slope = 0.0;
        }
        for pose in &mut self.first_path.platforms {
            let parts = pose.orientation.0.iter_mut().chain(&mut pose.position.0);
            parts.for_each(|part| part.slope = 0.0);
        }
        self.rates.fill(0.0);
        for (&coordinate, &rate) in self.coordinates.iter().zip(given) {
            if let Some((place, scale)) = self.place(coordinate) {
                self.rates[place] = rate / scale;
            }
            match coordinate {
                Coordinate::Joint(joint) => self.first_path.joints[joint].slope = rate,
                Coordinate::Pose(platform, c) if self.place(coordinate).is_none() => {
                    let pose = self.first_path.platforms[platform].pose();
                    let target = Dual {
                        value: c.of(&pose).value,
                        slope: rate,
                    };
                    self.first.set_target(platform, c, target);
                }
                Coordinate::Pose(..) | Coordinate::Turn(..) => {}
            }
        }
        for platform in 0..self.held.platforms.len() {
            if let Some(omega) = held::turning(&self.coordinates, given, platform) {
                let pose = self.first_path.platforms[platform].orientation;
                let pose = PlatformPose {
                    orientation: Quaternion(pose.0.map(|x| x.value)),
                    position: Vector3::zero(),
                };
                let wanted = moved(&pose, self.length, |k| match k {
                    0..3 => slope(omega[k]),
                    _ => slope(0.0),
                });
                self.first
                    .set_orientation(platform, wanted.orientation.rotation());
            }
        }
        for platform in 0..self.held.platforms.len() {
            if self.held.platforms[platform] == HeldPlatform::Pose {
                let first = self.scales.len() + 6 * platform;
                let path = &mut self.first_path.platforms[platform];
                let pose = PlatformPose {
                    orientation: Quaternion(path.orientation.0.map(|x| x.value)),
                    position: Vector3(path.position.0.map(|x| x.value)),
                };
                let rates = &self.rates[first..first + 6];
                *path = moved(&pose, self.length, |k| slope(rates[k]));
            }
        }
        self.first.residual(&self.first_path, &mut self.first_work);
        let derivative = self.first.residual_of(&self.first_work);
        for (right, &row) in self.right.iter_mut().zip(&self.rows) {
            *right = derivative[row].slope;
        }
        self.system.step_for(&self.right, &mut self.work);
        let step = self.system.step_of(&self.work);
        scatter(self.system.unknowns(), step, &self.scales, &mut self.rates);
        &self.rates
    }

    /// Rates of all unknowns for unit rates of the held coordinates, one at a time.
    pub fn responses(&mut self) -> Vec<Vec<f64>> {
        let mut responses = Vec::new();
        self.responses_into(&mut responses);
        responses
    }

    /// The same in storage that is kept.
    pub fn responses_into(&mut self, responses: &mut Vec<Vec<f64>>) {
        let mut given = vec![0.0; self.coordinates.len()];
        responses.resize_with(given.len(), Vec::new);
        for (i, response) in responses.iter_mut().enumerate() {
            given[i] = 1.0;
            response.clear();
            response.extend_from_slice(self.rates(&given));
            given[i] = 0.0;
        }
    }

    /// Goes on with rates that were computed before, as a sum of [responses](Self::responses).
    pub fn set_rates(&mut self, responses: &[Vec<f64>], given: &[f64]) {
        self.rates.fill(0.0);
        for (response, &rate) in responses.iter().zip(given) {
            add(&mut self.rates, rate, response);
        }
    }

    /// The place of a held coordinate among the unknowns, with the scale of its rate there; none
    /// for single coordinates of a platform and for its orientation alone, which are equations.
    fn place(&self, coordinate: Coordinate) -> Option<(usize, f64)> {
        let twist = |platform: usize| self.scales.len() + 6 * platform;
        match coordinate {
            Coordinate::Joint(joint) => Some((joint, self.scales[joint])),
            Coordinate::Turn(platform, axis) => {
                let whole = self.held.platforms[platform] == HeldPlatform::Pose;
                whole.then(|| (twist(platform) + axis as usize, 1.0))
            }
            Coordinate::Pose(platform, c) => {
                let whole = self.held.platforms[platform] == HeldPlatform::Pose;
                whole.then(|| (twist(platform) + 3 + c as usize, self.length))
            }
        }
    }

    /// The largest rate, dimensionless, at which a closure would open with the rates last computed:
    /// nothing but rounding unless the held coordinates cannot move so.
    pub fn mismatch(&mut self, at: &Configuration<f64>) -> f64 {
        self.follow_rates(at);
        self.first.residual(&self.first_path, &mut self.first_work);
        let rows = self.first.residual_of(&self.first_work);
        rows.iter()
            .fold(0.0, |most: f64, row| most.max(row.slope.abs()))
    }

    /// The largest acceleration, dimensionless, at which a closure would open with the
    /// accelerations last computed: more than rounding where no motion has them, at a configuration
    /// that is mobile to first order only. The accelerations must be the last thing computed.
    pub fn mismatch_of_accelerations(&mut self, at: &Configuration<f64>) -> f64 {
        self.follow_accelerations(at);
        self.second
            .residual(&self.second_path, &mut self.second_work);
        let rows = self.second.residual_of(&self.second_work);
        rows.iter()
            .fold(0.0, |most: f64, row| most.max(row.slope.slope.abs()))
    }

    /// The path with the rates last computed, in m, rad and s.
    pub fn first_path(&mut self, at: &Configuration<f64>) -> &Configuration<Dual<f64>> {
        self.follow_rates(at);
        &self.first_path
    }

    /// The path with the rates and accelerations last computed, in m, rad and s: what is computed along it has these
    /// as derivatives.
    pub fn path(&mut self, at: &Configuration<f64>) -> &Configuration<Dual<Dual<f64>>> {
        self.follow_accelerations(at);
        &self.second_path
    }

    /// The largest of the rates and of the accelerations last computed, in rad and characteristic lengths per unit of
    /// time.
    pub fn largest(&self) -> [f64; 2] {
        let largest = |all: &[f64]| all.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        [largest(&self.rates), largest(&self.accelerations)]
    }

    /// Whether rates and accelerations are determined where it was last factorised.
    pub fn is_determined(&self) -> bool {
        self.system.undetermined(&self.work) == 0
    }

    /// The path x ⊕ t ẋ + t²/2 ẍ for the rates and accelerations known.
    fn follow_accelerations(&mut self, at: &Configuration<f64>) {
        for (joint, path) in self.second_path.joints.iter_mut().enumerate() {
            let scale = self.scales[joint];
            *path = time(self.rates[joint] * scale, self.accelerations[joint] * scale)
                + Second::constant(Dual::constant(at.joints[joint]));
        }
        for (platform, pose) in at.platforms.iter().enumerate() {
            let first = self.scales.len() + 6 * platform;
            let (rates, changes) = (&self.rates[first..], &self.accelerations[first..]);
            self.second_path.platforms[platform] =
                moved(pose, self.length, |k| time(rates[k], changes[k]));
        }
    }

    fn follow_rates(&mut self, at: &Configuration<f64>) {
        for (joint, path) in self.first_path.joints.iter_mut().enumerate() {
            path.slope = self.rates[joint] * self.scales[joint];
        }
        for (platform, pose) in at.platforms.iter().enumerate() {
            let first = self.scales.len() + 6 * platform;
            let rates = &self.rates[first..first + 6];
            self.first_path.platforms[platform] = moved(pose, self.length, |k| slope(rates[k]));
        }
    }

    /// Accelerations of everything for the rates last computed and accelerations of the held
    /// coordinates, in m and rad per unit of time squared. `rates` are those given before.
    pub fn accelerations(
        &mut self,
        at: &Configuration<f64>,
        rates: &[f64],
        given: &[f64],
    ) -> &[f64] {
        self.accelerations.fill(0.0);
        for (&coordinate, &acceleration) in self.coordinates.iter().zip(given) {
            if let Some((place, scale)) = self.place(coordinate) {
                self.accelerations[place] = acceleration / scale;
            }
        }
        self.follow_accelerations(at);
        let asked = self.coordinates.iter().zip(rates).zip(given);
        for ((&coordinate, &rate), &acceleration) in asked {
            if let (Coordinate::Pose(platform, c), None) = (coordinate, self.place(coordinate)) {
                let mut target = time(rate, acceleration);
                target.value.value = c.of(&at.platforms[platform].pose());
                self.second.set_target(platform, c, target);
            }
        }
        for (platform, pose) in at.platforms.iter().enumerate() {
            let turns = |given| held::turning(&self.coordinates, given, platform);
            if let (Some(omega), Some(change)) = (turns(rates), turns(given)) {
                let wanted = moved(pose, self.length, |k| match k {
                    0..3 => time(omega[k], change[k]),
                    _ => time(0.0, 0.0),
                });
                self.second
                    .set_orientation(platform, wanted.orientation.rotation());
            }
        }
        self.second
            .residual(&self.second_path, &mut self.second_work);
        let derivative = self.second.residual_of(&self.second_work);
        for (right, &row) in self.right.iter_mut().zip(&self.rows) {
            *right = derivative[row].slope.slope;
        }
        self.system.step_for(&self.right, &mut self.work);
        let step = self.system.step_of(&self.work);
        let all = &mut self.accelerations;
        scatter(self.system.unknowns(), step, &self.scales, all);
        &self.accelerations
    }
}

/// t as a number with derivatives, of the path t ẋ + t²/2 ẍ.
fn time(rate: f64, acceleration: f64) -> Second {
    Dual {
        value: slope(rate),
        slope: Dual {
            value: rate,
            slope: acceleration,
        },
    }
}

fn slope(slope: f64) -> Dual<f64> {
    Dual { value: 0.0, slope }
}

/// A pose displaced by a twist (ω; v/L).
fn moved<T: Number>(
    pose: &PlatformPose<f64>,
    length: f64,
    twist: impl Fn(usize) -> T,
) -> PlatformPose<T> {
    let still = PlatformPose {
        orientation: Quaternion(pose.orientation.0.map(T::from_f64)),
        position: Vector3(pose.position.0.map(T::from_f64)),
    };
    let omega = Vector3([0, 1, 2].map(&twist));
    let shift = Vector3([3, 4, 5].map(|k| twist(k).scale(length)));
    still.moved_by(&omega, shift)
}

/// Puts the steps of free unknowns to their places among all.
fn scatter(free: &[Unknown], step: &[f64], scales: &[f64], all: &mut [f64]) {
    for (unknown, &step) in free.iter().zip(step) {
        match *unknown {
            Unknown::Joint(joint) => all[joint] = step,
            Unknown::Twist {
                platform,
                component,
            } => all[scales.len() + 6 * platform + component] = step,
        }
    }
}
