//! Closing along the path of the motion.

use super::Dynamics;
use super::chart::{Base, Chart};
use crate::geometry::Vector3;
use crate::linear::{add, dot};
use crate::mechanism::Configuration;

impl Dynamics<'_> {
    /// The configuration from which the mechanism is closed.
    pub fn base(&self) -> &Configuration<f64> {
        &self.base.at
    }

    /// Makes the configuration last evaluated that from which the mechanism is closed.
    pub fn stand(&mut self) {
        let at = self.configuration().clone();
        self.base = Base {
            values: self.values(&at),
            responses: self.responses.clone(),
            rates: std::mem::take(&mut self.latest.0),
            curvature: std::mem::take(&mut self.latest.1),
            at,
        };
    }

    /// Goes to the assembled configuration with these values of the coordinates that move that is reached from the
    /// [base](Dynamics::stand) along its path. False if there is none.
    pub fn close(&mut self, values: &[f64]) -> bool {
        let mechanism = self.mechanism;
        let Base {
            at: base,
            values: from,
            responses,
            rates,
            curvature,
        } = &self.base;
        let mut start = base.clone();
        let mut move_all = vec![0.0; self.chart.motion.unknowns().len()];
        let change: Vec<f64> = values
            .iter()
            .zip(from)
            .map(|(to, from)| to - from)
            .collect();
        for (change, response) in change.iter().zip(responses) {
            add(&mut move_all, *change, response);
        }
        // the time that the motion takes for as much of the way as it goes
        let square = dot(rates, rates);
        if square > 0.0 {
            let time = dot(&change, rates) / square;
            add(&mut move_all, 0.5 * time * time, curvature);
        }
        let dimensions = mechanism.dimensions();
        let (joints, twists) = move_all.split_at(start.joints.len());
        let joints = joints.iter().zip(&dimensions.joint_scales);
        for (value, (change, scale)) in start.joints.iter_mut().zip(joints) {
            *value += change * scale;
        }
        let length = dimensions.characteristic_length;
        for (pose, twist) in start.platforms.iter_mut().zip(twists.chunks_exact(6)) {
            let shift = Vector3([3, 4, 5].map(|k| twist[k] * length));
            *pose = pose.moved_by(&Vector3([twist[0], twist[1], twist[2]]), shift);
        }
        let Chart {
            coordinates,
            free,
            tracker,
            ..
        } = &mut self.chart;
        let locked = coordinates[*free..].iter();
        let locked: Vec<f64> = locked.map(|of| of.of(mechanism, base)).collect();
        let value = |i: usize| values.get(i).copied().unwrap_or_else(|| locked[i - *free]);
        tracker.restart(&start);
        let found = tracker.solve_at(coordinates.iter().copied(), value);
        self.residual = found.residual;
        if !found.solved {
            tracker.restart(base);
        }
        found.solved
    }

    /// The largest dimensionless residual of the closure equations where they were last solved.
    pub fn residual(&self) -> f64 {
        self.residual
    }
}
