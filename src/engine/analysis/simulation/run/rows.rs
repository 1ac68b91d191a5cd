//! The rows of a simulation.

use super::*;

impl Run<'_, '_> {
    /// The time of a row.
    pub(super) fn time_of(&self, row: usize) -> f64 {
        let (duration, rows) = (self.settings.duration, self.settings.rows);
        match row == rows {
            true => duration,
            false => duration * row as f64 / rows as f64,
        }
    }

    /// Adds the rows up to a time within the last step; false if one has no values.
    pub(super) fn rows_until(&mut self, integrator: &mut Integrator, until: f64) -> bool {
        while self.rows.len() <= self.settings.rows && self.time_of(self.rows.len()) <= until {
            let at = self.time_of(self.rows.len());
            let state = integrator.reached(&mut self.equations(), at);
            if !self.row(at, &state) {
                return false;
            }
        }
        true
    }

    pub(super) fn columns(&self) -> Vec<NamedUnit> {
        let column = |name: String, unit| NamedUnit::new(name, unit);
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
        for of in self.settings.speeds.iter().map(|of| of.coordinate) {
            let name = format!("force:{}", of.name(self.mechanism));
            let unit = SiUnit::of_effort(of.is_angle(self.mechanism));
            columns.push(column(name, unit));
        }
        for name in ["kinetic energy", "potential energy", "work"] {
            columns.push(column(name.into(), SiUnit::JOULE));
        }
        columns
    }

    /// The values of a row but for its time and work; `None` if it has none.
    pub(super) fn values(&mut self, time: f64, state: &[f64]) -> Option<Vec<f64>> {
        let (mechanism, laws, points, sick) =
            (self.mechanism, &self.laws, &self.points, self.sick());
        let drives = self.settings.speeds.len();
        across(
            self.dynamics,
            laws,
            (time, state),
            sick,
            |dynamics, state| values((mechanism, drives), dynamics, laws, points, (time, state)),
        )
    }

    /// Adds the row of a state, and takes its energies into the balance; false if it has no values.
    pub(super) fn row(&mut self, time: f64, state: &[f64]) -> bool {
        let Some(values) = self.values(time, state) else {
            return false;
        };
        let supplied = state.last().copied().unwrap_or(0.0);
        let energy = &mut self.energy;
        let [.., kinetic, potential] = values[..] else {
            return false;
        };
        (energy.end, energy.supplied) = (kinetic + potential, supplied);
        energy.kinetic = energy.kinetic.max(kinetic);
        let balance = energy.end - energy.start - supplied + energy.lost;
        energy.error = energy.error.max(balance.abs());
        self.residual = self.residual.max(self.dynamics.residual());
        let row = [time]
            .into_iter()
            .chain(values.iter().copied())
            .chain([supplied]);
        self.rows.push(row.collect());
        let mut there = self.dynamics.configuration().clone();
        // beside a singular configuration the equations stand to one side of it, the joints of the row in its middle
        let joints = there.joints.iter_mut().zip(values.chunks(2));
        joints.for_each(|(to, pair)| *to = pair[0]);
        self.configurations.push(there);
        true
    }
}

/// Values of joints with their rates, platforms, points and forces of drives at a state, and its kinetic and potential
/// energy.
fn values(
    (mechanism, drives): (&Mechanism, usize),
    dynamics: &mut Dynamics,
    laws: &Laws,
    points: &[Point],
    (time, state): (f64, &[f64]),
) -> Option<Vec<f64>> {
    let (_, instant) = at(dynamics, laws, time, state)?;
    let at = dynamics.configuration();
    let rates = dynamics.rates();
    let mut row = Vec::new();
    let scales = &mechanism.dimensions().joint_scales;
    for (joint, value) in at.joints.iter().enumerate() {
        row.extend([*value, rates[joint] * scales[joint]]);
    }
    for platform in 0..at.platforms.len() {
        let of = PoseCoordinate::ALL.map(|c| Coordinate::Pose(platform, c));
        row.extend(of.map(|of| of.of(mechanism, at)));
    }
    let twists = FrameTwists::new(mechanism.dimensions(), &[], points);
    let placement = twists.placed(at);
    let centre = mechanism.dimensions().centre;
    for i in 0..points.len() {
        let place = twists.origin(i, &placement).0;
        row.extend(place.iter().zip(centre).map(|(x, c)| x + c));
    }
    row.extend(&instant.drives[..drives]);
    row.extend([instant.kinetic, instant.potential]);
    Some(row)
}
