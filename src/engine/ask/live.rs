//! Quantities, forces and freedoms gained while a mechanism is moved by hand.

use super::{AskError, Role, Steering};
use crate::algebra::SiUnit;
use crate::analysis::quantities::Meter;
use crate::analysis::singularities::SingularitiesReport;
use crate::analysis::statics::StaticsReport;
use crate::mechanism::{Configuration, Measured, Order, Point};
use crate::solve::Watch;
use crate::system::{Analysed, Freedoms, System};

/// A quantity and its present value.
#[derive(Clone, Debug, PartialEq)]
pub struct LiveReading {
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
    pub fn readings(&self, list: &str) -> Result<Vec<LiveReading>, AskError> {
        let mut asked = self.question().near(self.at().clone());
        if !list.trim().is_empty() {
            asked = asked.report(list);
        }
        let question = asked.resolved()?;
        // what is held decides the configuration, as inputs do
        let quantities = asked.quantities(&question, asked.has(Role::Hold), &[])?;
        let metered = asked.metered(question, quantities, Vec::new())?;
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
                LiveReading {
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
                // the component that moves most swings by 0.25 rad or characteristic lengths
                let part = 0.25 * f64::from(k) / f64::from(PHASES) / most;
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
