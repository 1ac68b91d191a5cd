//! The state linearised.

use super::super::Linear;
use super::*;
use crate::description::Role;
use crate::number::tolerance::FIVE_POINTS;

impl Run<'_, '_> {
    /// The equations linearised at the state; `None` where something has no value.
    pub(super) fn linear(&mut self) -> Option<Linear> {
        let (mechanism, free) = (self.mechanism, self.free());
        let (rates, instant) = at(self.dynamics, &self.laws, 0.0, &self.state)?;
        let names = self.dynamics.coordinates().iter();
        let names = names.map(|of| (self.dynamics.name(*of), of.is_angle(mechanism)));
        let states: Vec<NamedUnit> = names
            .map(|(name, angle)| NamedUnit::new(name, SiUnit::of_coordinate(angle)))
            .collect();
        let rates_of = states
            .iter()
            .map(|of| NamedUnit::new(format!("rate:{}", of.name), of.unit.per_second()));
        let joints = mechanism.joints().iter().enumerate();
        let driven = |joint: usize| {
            let held = self.settings.locked.iter();
            let driven = self.settings.speeds.iter().map(|of| &of.coordinate);
            held.chain(driven).any(|of| *of == Coordinate::Joint(joint))
        };
        let actuated: Vec<usize> = joints
            .filter(|(i, joint)| joint.role == Role::Actuated && !driven(*i))
            .map(|(i, _)| i)
            .collect();
        let effort = |&i: &usize| {
            let joint = &mechanism.joints()[i];
            let unit = SiUnit::of_effort(joint.kind.is_angle());
            NamedUnit::new(format!("force:{}", joint.name), unit)
        };
        let mass = Decomposition::of(free, free, &instant.mass);
        let shares: Vec<Vec<f64>> = (actuated.iter())
            .map(|&i| mass.solve(&self.dynamics.rates_of(Coordinate::Joint(i))[..free]))
            .collect();
        let outputs: Vec<NamedUnit> = {
            let all = self.columns();
            let energies = 3 + self.settings.speeds.len();
            all[1..all.len() - energies].to_vec()
        };
        // accelerations, then outputs, over values and rates in dimensionless units
        let state = self.state.clone();
        let scales: Vec<f64> = [&self.laws.units[..free], &self.laws.units[..free]].concat();
        let places: Vec<usize> = (0..free)
            .chain((0..free).map(|i| self.laws.units.len() + i))
            .collect();
        let mut columns_of: Vec<Vec<f64>> = Vec::new();
        for (place, scale) in places.iter().zip(&scales) {
            let mut slope = vec![0.0; free + outputs.len()];
            for (length, weight) in FIVE_POINTS {
                let mut moved = state.clone();
                moved[*place] += length;
                let (_, instant) = at(self.dynamics, &self.laws, 0.0, &moved)?;
                let values = self.values(0.0, &moved)?;
                let found = [&instant.accelerations[..], &values[..outputs.len()]].concat();
                add(&mut slope, weight / scale, &found);
            }
            let largest = slope.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let rounding = SUMMED / FIVE_POINTS[2].0 * largest;
            for x in slope.iter_mut().filter(|x| x.abs() <= rounding) {
                *x = 0.0;
            }
            columns_of.push(slope);
        }
        let row = |i: usize| columns_of.iter().map(|of| of[i]).collect::<Vec<f64>>();
        let unit = |i: usize| {
            (0..2 * free)
                .map(|j| f64::from(u8::from(j == free + i)))
                .collect()
        };
        let none = || vec![0.0; actuated.len()];
        Some(Linear {
            change: [&rates[..free], &instant.accelerations[..]].concat(),
            a: (0..free).map(unit).chain((0..free).map(row)).collect(),
            b: (0..free)
                .map(|_| none())
                .chain((0..free).map(|i| shares.iter().map(|of| of[i]).collect()))
                .collect(),
            c: (0..outputs.len()).map(|i| row(free + i)).collect(),
            d: (0..outputs.len()).map(|_| none()).collect(),
            inputs: actuated.iter().map(effort).collect(),
            states: states.iter().cloned().chain(rates_of).collect(),
            outputs,
        })
    }
}
