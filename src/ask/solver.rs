//! The solver of the question as a program of its own, and configurations that it must reproduce.

use std::f64::consts::TAU;

use super::{AskError, Mode, Question};
use crate::analysis::solver::{Solver, solver, values};
use crate::mechanism::{Configuration, Frame};
use crate::number::real;
use crate::solve::{Newton, Stop, Watch};
use crate::system::{self, Coordinate, check_count};

/// Values of the inputs, then the state.
pub type SampleAnswer = (Vec<f64>, Vec<f64>);

impl Question {
    /// The solver for what is held, in the assembly near the start or that of the mode asked for; with poses and twists
    /// of frames.
    ///
    /// # Errors
    /// If the question is wrong, holds more or less than the mechanism has freedoms, nothing assembles, or the assembly is
    /// singular.
    pub fn solver_program(
        &self,
        frames: &[(String, Frame)],
        watch: &Watch,
    ) -> Result<Solver, AskError> {
        let (question, start) = self.posed(watch)?;
        solver(&question, &start, frames).map_err(AskError::NoSolver)
    }

    /// Configurations along a closed curve of the inputs through the start, each near the one before it; fewer if the
    /// mechanism cannot follow so far.
    ///
    /// # Errors
    /// As for [`solver_program`](Self::solver_program).
    pub fn examples(&self, count: usize, watch: &Watch) -> Result<Vec<SampleAnswer>, AskError> {
        /// Amplitudes to begin with, in rad and in characteristic lengths.
        const WIDEST: f64 = 0.3;
        /// The most of it for one configuration, so that each is near the one before it however few there are.
        const PER_STEP: f64 = 0.003;
        /// Number of times they are halved if the mechanism cannot follow.
        const HALVINGS: usize = 8;
        let (question, start) = self.posed(watch)?;
        let mut amplitude = WIDEST.min(PER_STEP * count as f64);
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
            check_count(&question).map_err(AskError::Question)?;
        }
        let question = question.with_spins_still();
        let start = self.start(&question, watch)?;
        Ok((question, start))
    }
}

/// Configurations as long as Newton's method closes from one to the next on its branch, and joints stay within limits.
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
        question
            .held_values(p)
            .into_iter()
            .map(move |(c, _)| Coordinate::Pose(p, c))
    });
    let inputs: Vec<Coordinate> = joints.map(Coordinate::Joint).chain(poses).collect();
    let values_at = |k: usize| {
        let turn = TAU * k as f64 / count as f64;
        let values = inputs.iter().enumerate().map(move |(i, &input)| {
            // no two inputs go to and fro alike
            let away = amplitude * input.scale(mechanism) * real::sin((i + 1) as f64 * turn);
            let value = input.of(mechanism, start) + away;
            let limits = match input {
                Coordinate::Joint(joint) => mechanism.joints()[joint].limits,
                _ => None,
            };
            let within = |(low, high): (f64, f64)| value.clamp(low, high.max(low));
            (input, limits.map_or(value, within))
        });
        values.collect::<Vec<_>>()
    };
    /// The shortest part of the way from one to the next in which it is gone.
    const SHORTEST: f64 = 1.0 / 64.0;
    /// The farthest that a joint moves from one to the next, in rad and characteristic lengths.
    const FARTHEST: f64 = 0.3;
    let far = |a: &Configuration<f64>, b: &Configuration<f64>| {
        let moved = a.joints.iter().zip(&b.joints).map(|(a, b)| (a - b).abs());
        moved
            .zip(&mechanism.dimensions().joint_scales)
            .any(|(moved, scale)| moved > FARTHEST * scale)
    };
    let joints_only = inputs.iter().all(|of| matches!(of, Coordinate::Joint(_)));
    let outside = |at: &Configuration<f64>| mechanism.outside_limits(&at.joints).count();
    let newton = Newton::default();
    let mut found: Vec<SampleAnswer> = Vec::with_capacity(count);
    let (mut system, mut at, mut trial) = (question.system(), start.clone(), start.clone());
    let mut work = system.work();
    let mut latest = values_at(0);
    for k in 0..count {
        let goal = values_at(k);
        let (mut part, mut step) = (0.0, 1.0);
        let previous = at.clone();
        while part < 1.0 {
            let end = f64::min(part + step, 1.0);
            let ways = latest.iter().zip(&goal);
            let wanted = ways.map(|(from, to)| match end {
                1.0 => *to,
                _ => (to.0, from.1 + end * (to.1 - from.1)),
            });
            let before = at.clone();
            if joints_only {
                for (input, value) in wanted {
                    if let Coordinate::Joint(joint) = input {
                        at.joints[joint] = value;
                    }
                }
            } else {
                let question = question.clone().at_values(wanted).near(&at);
                system = question.system();
                at = question.start();
            }
            trial.clone_from(&at);
            let report = newton.solve(&system, &mut at, &mut trial, &mut work);
            let within = outside(&at) <= outside(start);
            if report.stop == Stop::Solved
                && within
                && system.is_on_branch_of(&before, &at, &mut work)
            {
                part = end;
                continue;
            }
            at = before;
            step *= 0.5;
            if step < SHORTEST {
                return found;
            }
        }
        if k > 0 && far(&previous, &at) {
            return found;
        }
        latest = goal;
        found.push(values(question, &at));
    }
    found
}
