//! Targets of a bundle: quantities of a configuration that should have given values.

use thiserror::Error;

use super::elimination::Linear;
use super::{Bundle, Bundled};
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Frame, Measured, Mechanism, Order, Quantity};
use crate::number::{Gradient, Number};
use crate::solve::Equations;
use crate::system::{System, Work};

/// A quantity of one configuration that should have a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The configuration, by its place in the bundle.
    pub configuration: usize,
    /// The quantity: an expression over joints, coordinates of points and parameters.
    pub quantity: Quantity,
    /// The value that it should have, in SI units and rad.
    pub value: f64,
    /// Weight of a unit of difference: 1 over the uncertainty of the value.
    pub weight: f64,
}

/// Reasons for which a quantity cannot be a target.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum TargetError {
    /// It needs more than a configuration.
    #[error("`{0}` is a rate, a force or a figure, which one configuration alone does not have")]
    NotOfConfiguration(String),
}

impl Target {
    /// The frames whose points it uses.
    pub(super) fn frames(&self) -> Result<Vec<Frame>, TargetError> {
        let frames = self.quantity.measured().filter_map(|of| match of {
            Measured::Parameter(_) | Measured::Joint(_, Order::Value) => None,
            Measured::Place(point, _, Order::Value) => Some(Ok(point.frame)),
            _ => Some(Err(TargetError::NotOfConfiguration(
                self.quantity.name.clone(),
            ))),
        });
        frames.collect()
    }

    /// w(q − v) where the equations were last evaluated; `None` if it has no value there.
    pub(super) fn left<T: Factorable>(
        &self,
        mechanism: &Mechanism,
        (system, work): (&System<T>, &Work<T>),
        parameters: &[T],
        at: &Configuration<T>,
    ) -> Option<T> {
        let centre = mechanism.dimensions().centre;
        let value = self.quantity.expression.evaluate(&|of| match of {
            Measured::Parameter(i) => parameters[*i],
            Measured::Joint(i, _) => at.joints[*i],
            Measured::Place(point, coordinate, _) => {
                let placed = system
                    .kinematics()
                    .pose(point.frame, system.placement(work));
                let mut pose = *placed.expect("the frames of targets are placed");
                pose.position = point.placed(&pose);
                let value = coordinate.of(&pose);
                match coordinate.is_angle() {
                    true => value,
                    false => value + T::from_f64(centre[*coordinate as usize]),
                }
            }
            _ => unreachable!("targets of anything else are refused"),
        });
        Some((value.ok()? - T::from_f64(self.value)).scale(self.weight))
    }
}

impl Bundle<'_> {
    /// Linearises the targets: all their derivatives are taken through the kinematics.
    pub(super) fn linear_targets(&self, at: &Bundled, all: &mut [Linear]) -> Option<()> {
        if self.targets.is_empty() {
            return Some(());
        }
        let (unknowns, numbers) = (all.first()?.unknowns, self.numbers.len());
        for (&k, targets) in &self.targets {
            let row = vec![0.0; unknowns + numbers + 1];
            all.get_mut(k)?.targets = vec![row; targets.len()];
        }
        let lanes = |count: usize| (0..count).step_by(Gradient::LANES);
        let by_unknowns = lanes(unknowns).map(|from| (from, None));
        let by_numbers = lanes(numbers).map(|from| (unknowns + from, Some(from)));
        for (place, number) in by_unknowns.chain(by_numbers) {
            let mut lanes = self.lanes(&at.numbers, number.unwrap_or(numbers))?;
            let end = if number.is_none() {
                unknowns
            } else {
                unknowns + numbers
            };
            let count = Gradient::LANES.min(end - place);
            let mut step = vec![Gradient::zero(); unknowns];
            if number.is_none() {
                let moved = step[place..place + count].iter_mut().enumerate();
                moved.for_each(|(lane, x)| *x = Gradient::variable(0.0, lane));
            }
            for (&k, targets) in &self.targets {
                let at = at.configurations.get(k)?.map(Gradient::from_f64);
                let at = lanes.system.displaced(&at, &step);
                lanes.system.residual(&at, &mut lanes.work);
                for (target, row) in targets.iter().zip(&mut all[k].targets) {
                    let system = (&lanes.system, &lanes.work);
                    let left = target.left(self.mechanism, system, &lanes.parameters, &at)?;
                    row[unknowns + numbers] = left.value;
                    row[place..place + count].copy_from_slice(&left.slopes[..count]);
                }
            }
        }
        Some(())
    }
}
