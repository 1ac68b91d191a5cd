//! Newton's method from a node to its neighbour.

mod side_by_side;

use super::arrivals::Arrivals;
use crate::analysis::workspace::problem::{
    HeldMotions, Indicators, MOST_AXES, MapProblem, Rates, Targets,
};
use crate::linear::norm;
use crate::mechanism::{Configuration, ConfigurationRef};
use crate::number::tolerance::{ROUNDING, SOLVED};
use crate::solve::{Equations, Newton, Stop};
use crate::system::{System, SystemWork};
use side_by_side::SideBySide;

/// Start of a step.
#[derive(Clone, Debug)]
pub(crate) struct StepStart<'a> {
    pub from: ConfigurationRef<'a, f64>,
    /// A tangent and how far along it the solution is expected.
    pub along: Option<(&'a [f64], f64)>,
    /// Length of the prediction, dimensionless; infinite if any solution is wanted.
    pub reach: f64,
    /// The mapped coordinates there, and zeros.
    pub values: [f64; MOST_AXES],
}

/// Newton's method between nodes. It ends where a correction is too long.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    targets: Targets,
    system: System<f64>,
    work: SystemWork<f64>,
    point: Configuration<f64>,
    spare: Configuration<f64>,
    /// Tangent of a step to its predicted end.
    ahead: Vec<f64>,
    rates: Rates,
    found: HeldMotions<f64>,
    together: Option<SideBySide>,
}

/// Part of a step that its first correction may be, and so on: beyond it others may be as near.
pub(crate) const SURE: f64 = 0.3;

/// Longest correction allowed.
#[derive(Clone, Copy, Debug)]
struct LongestCorrection(f64);

impl LongestCorrection {
    /// Corrections at most: more if the solution may be anywhere.
    pub fn most(reaches: impl IntoIterator<Item = LongestCorrection>) -> usize {
        let far = reaches.into_iter().any(|reach| reach.0.is_infinite());
        if far { 20 } else { 8 }
    }

    /// True if a correction is short enough; the next one must be shorter.
    pub fn allows(&mut self, size: f64) -> bool {
        // what is not finite is rejected too
        let sure = size.is_finite() && size <= self.0.max(ROUNDING);
        if self.0.is_finite() {
            self.0 = SURE * size;
        }
        sure
    }
}

impl Steps {
    pub fn new(problem: &MapProblem) -> Self {
        let system = problem.question.system();
        Steps {
            targets: Targets::new(problem),
            work: system.work(),
            point: problem.question.start(),
            spare: problem.question.start(),
            ahead: Vec::new(),
            rates: Rates::new(problem, &system),
            found: HeldMotions::default(),
            together: None,
            system,
        }
    }

    /// Takes several steps side by side from now on, by operations that are recorded at an assembled configuration.
    pub fn recorded(
        mut self,
        problem: &MapProblem,
        at: &Configuration<f64>,
        values: &[f64],
    ) -> Self {
        let mut at = at.clone();
        self.targets.put(&mut at, values);
        self.together = SideBySide::new(problem, (&self.targets, &self.rates), &at, values);
        self
    }

    #[cfg(test)]
    pub fn is_recorded(&self) -> bool {
        self.together.is_some()
    }

    /// The solutions the starts certainly lead to; at most as many starts as are taken side by side.
    pub fn settle(&mut self, starts: &[StepStart], arrivals: &mut Arrivals) {
        /// Number of starts below which they are quicker one by one.
        const FEW: usize = 4;
        arrivals.begin(starts.len());
        let mut together = match starts.len() < FEW {
            true => None,
            false => self.together.take(),
        };
        let ends = together.as_mut().map(|together| {
            for (i, start) in starts.iter().enumerate() {
                self.begin(start);
                let numbers = self.targets.numbers(&start.values);
                together.put(i, numbers, &self.point);
            }
            together.solve(starts.iter().map(|start| LongestCorrection(start.reach)))
        });
        for (i, start) in starts.iter().enumerate() {
            let arrives = match (&together, &ends) {
                (Some(together), Some(ends)) if ends.open[i] == 0 => {
                    let arrives = ends.arrived[i] != 0;
                    if arrives {
                        together.get(i, &mut self.point, &mut self.found);
                    }
                    arrives
                }
                _ => self.solve(start),
            };
            if arrives {
                let indicators = self.rates.indicators(&self.point, &self.found);
                if indicators.regular {
                    arrivals.put(i, &self.point, &self.found.motions, indicators);
                }
            }
        }
        if together.is_some() {
            self.together = together;
        }
    }

    /// Newton's method for one start; true if it certainly arrives.
    fn solve(&mut self, start: &StepStart) -> bool {
        self.begin(start);
        (self.targets).set(&mut self.system, self.targets.numbers(&start.values));
        let mut reach = LongestCorrection(start.reach);
        let most = LongestCorrection::most([reach]);
        for step in 0..=most {
            self.system.linearise(&self.point, &mut self.work);
            // a NaN is not small
            let mut rows = self.system.residual_of(&self.work).iter();
            if rows.all(|row| row.abs() <= SOLVED) {
                self.motions();
                return true;
            }
            if step == most {
                break;
            }
            self.system.factorise(0.0, &mut self.work);
            self.system.step(&mut self.work);
            if !reach.allows(norm(self.system.step_of(&self.work))) {
                break;
            }
            let (from, to) = (&self.point, &mut self.spare);
            self.system.advance(from, 1.0, &self.work, to);
            std::mem::swap(&mut self.point, &mut self.spare);
        }
        false
    }

    /// The solution that Newton's method finds from a start, wherever it is.
    pub fn solved(
        &mut self,
        mut at: Configuration<f64>,
        values: &[f64],
    ) -> Option<Configuration<f64>> {
        (self.targets).ask(&mut self.system, &mut at, values);
        let newton = Newton::default();
        let report = newton.solve(&self.system, &mut at, &mut self.spare, &mut self.work);
        (report.stop == Stop::Solved).then_some(at)
    }

    fn motions(&mut self) {
        self.system.factorise(0.0, &mut self.work);
        (self.rates).motions(&self.point, &self.system, &mut self.work, &mut self.found);
    }

    /// The indicators of a configuration that solves the equations for its mapped coordinates.
    pub fn indicators(&mut self, at: &Configuration<f64>, values: &[f64]) -> Indicators {
        self.point.clone_from(at);
        (self.targets).ask(&mut self.system, &mut self.point, values);
        self.system.linearise(&self.point, &mut self.work);
        self.motions();
        self.rates.indicators(&self.point, &self.found)
    }

    /// Puts the point near where a start is to arrive.
    fn begin(&mut self, start: &StepStart) {
        self.point.joints.copy_from_slice(start.from.joints);
        self.point.platforms.copy_from_slice(start.from.platforms);
        if let Some((motion, factor)) = start.along {
            self.ahead.clear();
            self.ahead.extend(motion.iter().map(|x| x * factor));
            self.rates.displace(&mut self.point, &self.ahead);
        }
        self.targets.put(&mut self.point, &start.values);
    }
}
