//! Targets of a bundle: quantities of a configuration that should have given values.

use std::f64::consts::TAU;

use thiserror::Error;

use super::{Bundle, Lanes};
use crate::algebra::SiUnit;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Frame, Measured, Mechanism, Order, Quantity};
use crate::number::{Gradient, Number};
use crate::system::{System, SystemWork};

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
    /// True if it must be met: it is then an equation of the configuration, as its closures are.
    pub exact: bool,
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
        evaluated: (&System<T>, &SystemWork<T>),
        parameters: &[T],
        at: &Configuration<T>,
    ) -> Option<T> {
        let value = T::from_f64(self.value);
        let left = self.quantity(mechanism, evaluated, parameters, at)? - value;
        let turns = match self.turns(mechanism) {
            true => (left.real() / TAU).round(),
            false => 0.0,
        };
        Some((left - T::from_f64(turns * TAU)).scale(self.weight))
    }

    /// The quantity q where the equations were last evaluated.
    pub(super) fn quantity<T: Factorable>(
        &self,
        mechanism: &Mechanism,
        (system, work): (&System<T>, &SystemWork<T>),
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
        value.ok()
    }

    /// True for an angle that means the same after a turn.
    pub(super) fn turns(&self, mechanism: &Mechanism) -> bool {
        self.quantity.unit == SiUnit::RADIAN
            && self.quantity.measured().all(|of| match of {
                Measured::Joint(joint, _) => {
                    !mechanism.joints()[*joint].kind.is_angle()
                        || mechanism.turns_to_repeat(*joint) == Some(1.0)
                }
                _ => true,
            })
    }
}

impl Bundle<'_> {
    /// Rows of some targets of a configuration: derivatives by the unknowns, then what is left.
    pub(super) fn rows_by_unknowns(
        &self,
        targets: &[&Target],
        lanes: &mut Lanes,
        at: &Configuration<f64>,
    ) -> Option<Vec<Vec<f64>>> {
        let unknowns = lanes.system.unknowns().len();
        let mut names = targets.iter().flat_map(|target| target.quantity.measured());
        let placed = names.any(|of| matches!(of, Measured::Place(..)));
        let mut rows = vec![vec![0.0; unknowns + 1]; targets.len()];
        let at = at.map(Gradient::from_f64);
        for from in (0..unknowns).step_by(Gradient::LANES) {
            let count = Gradient::LANES.min(unknowns - from);
            let mut step = vec![Gradient::zero(); unknowns];
            let moved = step[from..from + count].iter_mut().enumerate();
            moved.for_each(|(lane, x)| *x = Gradient::variable(0.0, lane));
            let at = lanes.system.displaced(&at, &step);
            if placed {
                lanes.system.place(&at, &mut lanes.work);
            }
            for (target, row) in targets.iter().zip(&mut rows) {
                let system = (&lanes.system, &lanes.work);
                let left = target.left(self.mechanism, system, &lanes.parameters, &at)?;
                row[unknowns] = left.value;
                row[from..from + count].copy_from_slice(&left.slopes[..count]);
            }
        }
        Some(rows)
    }
}
