//! Quantities, forces and freedoms gained while a mechanism is moved by hand.

use super::{AskError, Role, Steering};
use crate::algebra::SiUnit;
use crate::analysis::quantities::{Meter, Metered};
use crate::analysis::singularities::SingularitiesReport;
use crate::analysis::statics::StaticsReport;
use crate::analysis::sweep::Pace;
use crate::mechanism::{Configuration, Measured, Order, Point};
use crate::solve::Watch;
use crate::system::{Analysed, Freedoms, System};

/// A quantity and its present value.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: SiUnit,
    /// Its value; none where it is not determined, or changes only with the time.
    pub value: Option<f64>,
}

/// Freedoms gained at a singular configuration.
#[derive(Clone, Debug)]
pub struct Gained {
    /// The singular configuration.
    pub at: Configuration<f64>,
    /// Report on its singularity.
    pub report: SingularitiesReport,
    /// For each freedom configurations from one side to the other, which close to first order.
    pub swings: Vec<Vec<Configuration<f64>>>,
}

impl Steering {
    /// The quantities of a list ([`Question::report`](super::Question::report)) where the mechanism is; those that the file names if it is empty.
    ///
    /// # Errors
    /// If one is wrong or cannot be known.
    pub fn readings(&self, list: &str) -> Result<Vec<Reading>, AskError> {
        let mut asked = self.question().near(self.at().clone());
        if !list.trim().is_empty() {
            asked = asked.report(list);
        }
        let question = asked.resolved()?;
        // what is held decides the configuration, as inputs do
        let quantities = asked.quantities(&question, asked.has(Role::Hold), &[])?;
        let metered = Metered {
            quantities,
            inputs: Vec::new(),
            pace: Pace::default(),
            schedule: None,
            load: asked.load_of(&question)?,
            outputs: Vec::new(),
            question,
        };
        let at = (asked.mechanism()).completed(self.mechanism(), self.at());
        let mut meter = Meter::new(&metered, &at);
        let values = meter.read(&at, 0.0).iter();
        let readings = metered
            .quantities
            .iter()
            .zip(values)
            .map(|(quantity, value)| {
                let timed = quantity.measured().any(|of| match of {
                    Measured::Joint(_, order) | Measured::Place(_, _, order) => {
                        *order != Order::Value
                    }
                    Measured::Size(..) => true,
                    _ => false,
                });
                Reading {
                    name: quantity.name.clone(),
                    unit: quantity.unit,
                    value: value.filter(|value| !timed && value.is_finite()),
                }
            });
        Ok(readings.collect())
    }

    /// The forces that balance a force in N, in ground, at a point.
    ///
    /// # Errors
    /// If something is held that cannot be, such as an angle of a platform pitched by ±90°.
    pub fn forces(
        &self,
        point: &Point,
        force: [f64; 3],
        watch: &Watch,
    ) -> Result<Analysed<StaticsReport>, AskError> {
        let name = point.name(self.mechanism());
        let asked = self.question().near(self.at().clone());
        asked.wrench(name, force, [0.0; 3]).statics(watch)
    }

    /// The freedoms gained at the singular configuration that stopped the last motion, or else where the mechanism is;
    /// none where nothing is gained.
    ///
    /// # Errors
    /// If something is held that cannot be.
    pub fn gained(&self, watch: &Watch) -> Result<Option<Gained>, AskError> {
        /// Amplitude of the swings, in rad or characteristic lengths, of the component that moves most.
        const SWING: f64 = 0.25;
        /// Configurations to either side.
        const PHASES: i32 = 6;
        let there = self.where_stopped();
        let asked = there.question().near(there.at().clone());
        let report = match asked.singularities(&Default::default(), watch)? {
            Analysed::Closed(report) if report.singularity.gain > 0 => report,
            _ => return Ok(None),
        };
        let (dimensions, held) = (self.mechanism().dimensions(), there.held());
        let system = System::new(dimensions, &held);
        let motions = Freedoms::at(dimensions, &held, there.at()).motions;
        let swings = motions.iter().map(|motion| {
            let most = motion.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let phase = |k: i32| {
                let part = SWING * f64::from(k) / f64::from(PHASES) / most;
                let step: Vec<f64> = motion.iter().map(|x| x * part).collect();
                system.displaced(there.at(), &step)
            };
            (-PHASES..=PHASES).map(phase).collect()
        });
        Ok(Some(Gained {
            swings: swings.collect(),
            report,
            at: there.at().clone(),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::sweep::SweepEnd;
    use crate::ask::Question;
    use crate::geometry::Vector3;
    use crate::mechanism::Mechanism;

    fn asked(file: &str) -> Question {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/");
        Question::new(Mechanism::load(format!("{folder}{file}")).unwrap())
    }

    /// The angle between coupler (3) and rocker (4) by the law of cosines on the diagonal from the crank's pin to the ground
    /// pivot of the rocker; as transmission angles are taken between 0 and 90°.
    #[test]
    fn a_transmission_angle_is_read_as_the_crank_is_moved() {
        let watch = &Watch::none();
        let mut steering = asked("four_bar.ron").steering(watch).unwrap();
        let [crank] = *steering.driven() else {
            panic!("one coordinate is held")
        };
        for degrees in [60.0_f64, 100.0, 170.0] {
            steering.move_to(&[(crank, degrees.to_radians())], watch);
            let diagonal = 26.0 - 10.0 * degrees.to_radians().cos();
            let angle = ((9.0 + 16.0 - diagonal) / 24.0).acos();
            let angle = angle.min(std::f64::consts::PI - angle);
            let readings = steering.readings("transmission").unwrap();
            let read = readings[0].value.unwrap();
            assert!((read - angle).abs() < 1e-9, "{read} is not {angle}");
        }
        // nothing says how fast it moves, and there is no such name
        let rate = steering.readings("velocity:left").unwrap();
        assert_eq!(rate[0].value, None);
        assert!(steering.readings("transmision").is_err());
    }

    /// A force on the crank is held by its drive alone, with the moment r × F; the rest carries nothing.
    #[test]
    fn a_force_on_the_crank_is_balanced_by_its_moment() {
        let watch = &Watch::none();
        let mut steering = asked("four_bar.ron").steering(watch).unwrap();
        let crank = steering.driven()[0];
        let frame = steering.mechanism().frame("left.1").unwrap();
        let offset = [0.5, 0.25, 0.0];
        let point = Point { frame, offset };
        let force = [3.0, -7.0, 0.0];
        for angle in [1.0_f64, 2.5] {
            steering.move_to(&[(crank, angle)], watch);
            let found = steering.forces(&point, force, watch).unwrap();
            let report = found.closed().unwrap();
            let (sin, cos) = angle.sin_cos();
            let arm = Vector3([0.5 * cos - 0.25 * sin, 0.5 * sin + 0.25 * cos, 0.0]);
            let moment = arm.cross(&Vector3(force)).0[2];
            assert!((report.actuators[0].force + moment).abs() < 1e-9);
        }
    }

    /// At a dead point of the driven rocker, which stands still, the coupler turns about the pin between them, and the
    /// crank about its own; away from it nothing moves.
    #[test]
    fn a_dead_point_that_stops_a_motion_gains_a_freedom() {
        let watch = &Watch::none();
        let asked = asked("four_bar.ron").free("theta1").hold("phi1", "129 deg");
        let mut steering = asked.steering(watch).unwrap();
        assert!(steering.gained(watch).unwrap().is_none());
        let rocker = steering.driven()[0];
        let home = rocker.of(steering.mechanism(), steering.at());
        steering.move_to(&[(rocker, home + 2.0)], watch);
        assert!(steering.is_stopped());
        let gained = steering.gained(watch).unwrap().unwrap();
        assert_eq!(gained.report.singularity.gain, 1);
        assert_eq!(gained.swings.len(), 1);
        // each side is open by no more than the second order
        let mechanism = steering.mechanism();
        let ends = ["left", "right"].map(|name| mechanism.frame(name).unwrap());
        for at in &gained.swings[0] {
            let [a, b] = mechanism.poses(ends, at).map(|pose| pose.position);
            let step = at.joints[0] - gained.at.joints[0];
            assert!((a - b).norm() < 2.0 * step * step + 1e-9);
        }
        let turned = gained.swings[0][0].joints[0] - gained.at.joints[0];
        assert!(turned.abs() > 0.1, "the crank moves by {turned}");
        steering.move_to(&[(rocker, home)], watch);
        assert!(!steering.is_stopped());
        assert!(steering.gained(watch).unwrap().is_none());
    }

    /// The middle of a rod between two platforms or bodies follows the pointer as a point of a body does.
    #[test]
    fn a_rod_is_pulled_by_a_point_between_its_ends() {
        let watch = &Watch::none();
        let mut steering = asked("delta.ron").steering(watch).unwrap();
        let rod = &steering.mechanism().closures()[0];
        assert!(rod.kind.has_length());
        let grip = rod.frames.map(|frame| (Point::from(frame), 0.5));
        let middle = |steering: &Steering| {
            let place = |i: usize| grip[i].0.at(steering.mechanism(), steering.at());
            (place(0) + place(1)).times(0.5)
        };
        let to = middle(&steering) + Vector3([0.01, 0.02, -0.02]);
        for _ in 0..40 {
            let report = steering.pull(&grip, to.0, None, watch);
            // also where there is nothing left to go
            assert_eq!(report.ending, SweepEnd::Complete);
        }
        let missed = (middle(&steering) - to).norm();
        assert!(missed < 1e-3, "it stays {missed} away");
    }
}
