//! The solver of the question as a program of its own, and configurations that it must reproduce.

use std::f64::consts::TAU;

use super::many::RowSeries;
use super::{AskError, Mode, Question};
use crate::analysis::solver::{Solver, forces, solver, values};
use crate::mechanism::{Configuration, Frame};
use crate::number::real;
use crate::solve::Watch;
use crate::system::{self, Coordinate, check_count};

/// Values of the inputs, then the state.
pub type SampleAnswer = (Vec<f64>, Vec<f64>);

/// Rates of the inputs, their accelerations, and the forces that drive the inputs so.
pub type SampleForces = [Vec<f64>; 3];

/// Settings of a solver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolverSettings {
    /// Frames whose poses and twists for unit rates of the inputs are written too, with their names.
    pub frames: Vec<(String, Frame)>,
    /// True if the forces that drive the inputs are written too.
    pub forces: bool,
}

impl Question {
    /// The solver for what is held, in the assembly near the start or that of the mode asked for. With forces it takes the
    /// wrenches and loads of the question.
    ///
    /// # Errors
    /// If the question is wrong, holds more or less than the mechanism has freedoms, nothing assembles, the assembly is
    /// singular, or forces cannot be written.
    pub fn solver_program(
        &self,
        settings: &SolverSettings,
        watch: &Watch,
    ) -> Result<Solver, AskError> {
        self.takes(match settings.forces {
            true => "generate with forces",
            false => "generate",
        })?;
        let (question, start) = self.posed(watch)?;
        let load = match settings.forces {
            true => Some(self.load_of(&question)?),
            false => None,
        };
        solver(&question, &start, &settings.frames, load.as_ref()).map_err(AskError::NoSolver)
    }

    /// Motions of the inputs at configurations of a solver, at a time of 0.25 s, with the forces that drive them; nothing where
    /// the configuration is singular.
    ///
    /// # Errors
    /// As for [`solver_program`](Self::solver_program).
    pub fn example_forces(
        &self,
        examples: &[SampleAnswer],
        watch: &Watch,
    ) -> Result<Vec<SampleForces>, AskError> {
        let (question, _) = self.posed(watch)?;
        let load = self.load_of(&question)?;
        let driven = examples.iter().enumerate().map(|(k, (inputs, state))| {
            // about one unit per s and per s², each input otherwise
            let number = |i: usize, of: f64| real::sin(of + (3 * i + k) as f64);
            let [rates, changes]: [Vec<f64>; 2] =
                [1.0, 2.0].map(|of| (0..inputs.len()).map(|i| number(i, of)).collect());
            let found = forces(&question, &load, (inputs, state), [&rates, &changes], 0.25);
            [rates, changes, found.unwrap_or_default()]
        });
        Ok(driven.collect())
    }

    /// Configurations along a closed curve of the inputs through the start, each near the one before it; fewer if the
    /// mechanism cannot follow so far.
    ///
    /// # Errors
    /// As for [`solver_program`](Self::solver_program).
    pub fn examples(&self, count: usize, watch: &Watch) -> Result<Vec<SampleAnswer>, AskError> {
        /// Number of times they are halved if the mechanism cannot follow.
        const HALVINGS: usize = 8;
        let (question, start) = self.posed(watch)?;
        // in rad and characteristic lengths; each is near the one before it however few there are
        let mut amplitude = 0.3_f64.min(0.003 * count as f64);
        let mut found = Vec::new();
        for _ in 0..HALVINGS {
            found = follow(&question, &start, amplitude, count);
            if found.len() == count {
                break;
            }
            amplitude *= 0.5;
        }
        Ok(found)
    }

    fn posed(&self, watch: &Watch) -> Result<(system::Question<'_>, Configuration<f64>), AskError> {
        let question = self.resolved()?;
        if self.mode == Mode::Nearest {
            check_count(&question)?;
        }
        let question = question.with_spins_still();
        let start = self.start(&question, watch)?;
        Ok((question, start))
    }
}

/// Configurations as long as the mechanism can be followed from one to the next on its branch, and joints stay within limits.
fn follow(
    question: &system::Question,
    start: &Configuration<f64>,
    amplitude: f64,
    count: usize,
) -> Vec<SampleAnswer> {
    let mechanism = question.mechanism();
    let held = question.held();
    let joints = (0..held.joints.len()).filter(|joint| held.joints[*joint]);
    let poses = (0..held.platforms.len()).flat_map(|p| {
        let values = question.held_values(p).into_iter();
        values.map(move |(c, _)| Coordinate::Pose(p, c))
    });
    let inputs: Vec<Coordinate> = joints.map(Coordinate::Joint).chain(poses).collect();
    let wanted = (0..count).flat_map(|k| {
        let turn = TAU * k as f64 / count as f64;
        let values = inputs.iter().enumerate().map(|(i, &input)| {
            // no two inputs go to and fro alike
            let away = amplitude * input.scale(mechanism) * real::sin((i + 1) as f64 * turn);
            let value = input.of(mechanism, start) + away;
            let limits = match input {
                Coordinate::Joint(joint) => mechanism.joints()[joint].limits,
                _ => None,
            };
            limits.map_or(value, |(low, high)| value.clamp(low, high.max(low)))
        });
        values.collect::<Vec<f64>>()
    });
    let wanted: Vec<f64> = wanted.collect();
    let far = |a: &Configuration<f64>, b: &Configuration<f64>| {
        let moved = a.joints.iter().zip(&b.joints).map(|(a, b)| (a - b).abs());
        moved
            .zip(&mechanism.dimensions().joint_scales)
            .any(|(moved, scale)| moved > 0.3 * scale)
    };
    let outside = |at: &Configuration<f64>| mechanism.outside_limits(&at.joints).count();
    let watch = Watch::none();
    let rows = RowSeries::new(question, &inputs, &wanted, start.clone(), &watch);
    let mut found = Vec::with_capacity(count);
    let mut before: Option<Configuration<f64>> = None;
    for at in rows.followed(count) {
        let jumps = before.as_ref().is_some_and(|before| far(before, &at));
        if jumps || outside(&at) > outside(start) {
            break;
        }
        found.push(values(question, &at));
        before = Some(at);
    }
    found
}
