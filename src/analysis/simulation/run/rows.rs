//! The rows of a simulation.

use super::*;

impl Run<'_, '_> {
    /// The time of a row.
    pub(super) fn time_of(&self, row: usize) -> f64 {
        self.settings.duration * (row as f64 / self.settings.rows as f64)
    }

    /// Adds the rows up to a time within the last step.
    pub(super) fn rows_until(&mut self, integrator: &mut Integrator, until: f64) {
        while self.rows.len() <= self.settings.rows && self.time_of(self.rows.len()) <= until {
            let at = self.time_of(self.rows.len());
            let state = integrator.reached(&mut self.equations(), at);
            self.row(at, &state);
        }
    }

    pub(super) fn columns(&self) -> Vec<SimulationColumn> {
        let column = |name: String, unit: SiUnit| SimulationColumn { name, unit };
        let mut columns = vec![column("t".into(), SiUnit::SECOND)];
        for (i, joint) in self.mechanism.joints().iter().enumerate() {
            let unit = SiUnit::of_coordinate(Coordinate::Joint(i).is_angle(self.mechanism));
            columns.push(column(joint.name.clone(), unit));
            columns.push(column(format!("rate:{}", joint.name), unit.per_second()));
        }
        for platform in self.mechanism.platforms() {
            for c in PoseCoordinate::ALL {
                let name = format!("{}.{}", platform.name, c.word());
                columns.push(column(name, SiUnit::of_coordinate(c.is_angle())));
            }
        }
        for point in &self.points {
            let name = point.name(self.mechanism);
            for c in ["x", "y", "z"] {
                columns.push(column(format!("{name}.{c}"), SiUnit::METRE));
            }
        }
        for name in ["kinetic energy", "potential energy", "work"] {
            columns.push(column(name.into(), SiUnit::NEWTON_METRE));
        }
        columns
    }

    /// Adds the row of a state.
    pub(super) fn row(&mut self, time: f64, state: &[f64]) {
        let Some((_, instant)) = at(self.dynamics, &self.units, time, state) else {
            return;
        };
        let at = self.dynamics.configuration();
        let rates = self.dynamics.rates();
        let mut row = vec![time];
        let scales = &self.mechanism.dimensions().joint_scales;
        for (joint, value) in at.joints.iter().enumerate() {
            row.extend([*value, rates[joint] * scales[joint]]);
        }
        for platform in 0..at.platforms.len() {
            let of = PoseCoordinate::ALL.map(|c| Coordinate::Pose(platform, c));
            row.extend(of.map(|of| of.of(self.mechanism, at)));
        }
        let twists = FrameTwists::new(self.mechanism.dimensions(), &[], &self.points);
        let placement = twists.placed(at);
        let centre = self.mechanism.dimensions().centre;
        for i in 0..self.points.len() {
            let place = twists.origin(i, &placement).0;
            row.extend(place.iter().zip(centre).map(|(x, c)| x + c));
        }
        row.extend([
            instant.kinetic,
            instant.potential,
            state[2 * self.units.len()],
        ]);
        let energy = &mut self.energy;
        let supplied = state[2 * self.units.len()];
        let balance = instant.kinetic + instant.potential - energy.start - supplied + energy.lost;
        energy.error = energy.error.max(balance.abs());
        self.residual = self.residual.max(self.dynamics.residual());
        self.rows.push(row);
    }
}
