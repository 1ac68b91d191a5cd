//! The quantities of one row of a study.

use std::sync::{Arc, OnceLock};

use crate::analysis::quantities::{Meter, Metered};
use crate::analysis::sweep::Pace;
use crate::ask::modes::NUMBERED;
use crate::ask::{AskError, Item, Question, Role, Unmeasured};
use crate::mechanism::{Configuration, Measured, Mechanism, Order, Quantity};
use crate::solve::Watch;
use crate::system::{self, Driven};

impl Question {
    /// The question about another mechanism with the same names.
    pub(in crate::ask) fn about(&self, mechanism: Arc<Mechanism>) -> Question {
        Question {
            mechanism,
            ready: OnceLock::new(),
            ..self.clone()
        }
    }

    /// The quantities that are asked for where what is held moves at the rates that are given, and how it moves.
    pub(in crate::ask) fn measured_by_rates(
        &self,
        held: &system::Question,
    ) -> Result<(Vec<Quantity>, Vec<Driven>), AskError> {
        let drive = self.drive(held)?;
        let driven = drive.coordinates.iter().zip(&drive.rates);
        let inputs = driven.map(|(&coordinate, &rate)| Driven {
            coordinate,
            from: 0.0,
            to: rate,
        });
        let inputs: Vec<Driven> = inputs.collect();
        let quantities = self.quantities(held, !drive.coordinates.is_empty(), &[])?;
        let at_rest = quantities
            .iter()
            .find(|of| !drive.given && of.measured().any(moves));
        let item = (self.of(Role::Report).next()).map_or(Item::new(0), |(item, _)| item);
        match at_rest {
            Some(quantity) => Err(item.unmeasured(&quantity.name, Unmeasured::NoInput)),
            None => Ok((quantities, inputs)),
        }
    }

    /// Quantities where held coordinates move at these rates.
    pub(in crate::ask) fn metered<'q>(
        &self,
        question: system::Question<'q>,
        quantities: Vec<Quantity>,
        inputs: Vec<Driven>,
    ) -> Result<Metered<'q>, AskError> {
        Ok(Metered {
            quantities,
            inputs,
            pace: Pace::default(),
            schedule: None,
            load: self.load_of(&question)?,
            outputs: self.asked_outputs()?,
            question,
        })
    }

    /// The row of results: 1 if the mechanism assembles, else 0, the number of assemblies if it is asked for, and the
    /// quantities.
    pub(in crate::ask) fn measured_here(
        &self,
        counted: bool,
        spins: bool,
    ) -> Result<Vec<Option<f64>>, AskError> {
        let watch = &Watch::none();
        let mut held = self.resolved()?;
        if !spins {
            held = held.without_spins();
        }
        let still = held.clone().with_spins_still();
        let count = counted.then(|| {
            let report = self.all(&still, NUMBERED, watch);
            report.ok().map(|report| report.real as f64)
        });
        let start = match self.start(&still, watch) {
            Ok(start) => start,
            Err(_) => return Ok([Some(0.0)].into_iter().chain(count).collect()),
        };
        let (quantities, inputs) = self.measured_by_rates(&held)?;
        let metered = self.metered(held, quantities, inputs)?;
        let mut values: Vec<Option<f64>> = [Some(1.0)].into_iter().chain(count).collect();
        values.extend_from_slice(Meter::new(&metered, &start).read(&start, 0.0));
        Ok(values)
    }

    /// The quantities that are asked for at rest at configurations of a motion, one after another.
    pub(in crate::ask) fn measured_along(
        &self,
        places: &[Configuration<f64>],
    ) -> Result<Vec<Vec<Option<f64>>>, AskError> {
        let held = self.resolved()?.without_spins();
        let (quantities, inputs) = self.measured_by_rates(&held)?;
        let metered = self.metered(held, quantities, inputs)?;
        let places = places.iter();
        let places = places.map(|at| self.mechanism().completed(&self.mechanism, at));
        let mut meter: Option<Meter> = None;
        let values = places.map(|at| {
            let meter = meter.get_or_insert_with(|| Meter::new(&metered, &at));
            meter.read(&at, 0.0).to_vec()
        });
        Ok(values.collect())
    }
}

/// True if it depends on the motion of the inputs.
fn moves(measured: &Measured) -> bool {
    match measured {
        Measured::Joint(_, order) | Measured::Place(_, _, order) | Measured::Size(_, order) => {
            *order != Order::Value
        }
        Measured::Curvature(_) | Measured::Screw(..) => true,
        _ => false,
    }
}
