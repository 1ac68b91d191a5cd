//! Edges in shorter steps, many edges side by side.

use super::arrivals::{Arrivals, TangentSolution, TangentSolutionRef};
use super::neighbour::Flood;
use super::spread::{GridTask, GrowingSet};
use super::step::{StepStart, Steps};
use crate::analysis::workspace::problem::MOST_AXES;
use crate::linear::norm;
use crate::solve::Pool;

/// End of the way along an edge.
pub(crate) enum EdgeEnd {
    /// At the neighbour.
    Arrived(TangentSolution),
    /// At a fold of the mode, before the neighbour.
    Fold,
    /// At a point from which no step is certain.
    Stuck,
}

/// Progress along an edge.
struct PacedStep {
    at: TangentSolution,
    axis: usize,
    /// The mapped coordinates at the neighbour.
    end: [f64; MOST_AXES],
    x: f64,
    /// The next change of the mapped coordinate.
    step: f64,
    /// 1/‖N‖² at the point reached.
    slowness: f64,
    /// Value of the mapped coordinate at which this would vanish, extrapolated on a straight line.
    fold: f64,
}

impl PacedStep {
    fn rest(&self) -> f64 {
        self.end[self.axis] - self.x
    }

    /// Takes a step and sets the next; true if the mode folds back before the neighbour.
    ///
    /// On the way to a fold at x* the configuration goes with √(x* − x), and ‖N‖⁻² falls in
    /// proportion to x* − x. Towards a place where a leg merely turns fast it falls with the square
    /// instead, and the straight line through two points leads to another place each time.
    fn on(&mut self, at: TangentSolution, slowness: f64) -> bool {
        let before = std::mem::replace(&mut self.fold, f64::INFINITY);
        let gone = self.step;
        self.x += gone;
        if slowness < self.slowness {
            self.fold = self.x + gone * slowness / (self.slowness - slowness);
        }
        (self.at, self.slowness) = (at, slowness);
        let (left, rest) = (self.fold - self.x, self.rest());
        let ahead = left.is_finite() && left.abs() < 1.5 * rest.abs();
        // the greater part of the way to the fold
        let next = if ahead { 0.6 * left } else { 2.0 * gone };
        self.step = if next.abs() < rest.abs() { next } else { rest };
        // the estimates of the fold from this step and the one before
        let agreed = (self.fold - before).abs() < 0.05 * left.abs();
        ahead && agreed && 1.1 * left.abs() < rest.abs()
    }
}

impl Flood<'_> {
    /// Halves steps until they are certain, then continues.
    pub(crate) fn paced(
        &self,
        steps: &Pool<Steps>,
        spread: &GrowingSet,
        tasks: &[GridTask],
    ) -> Vec<EdgeEnd> {
        const ROUNDS: usize = 30;
        let slowness = |at: TangentSolutionRef, axis: usize| {
            let (motion, _) = self.metric.motion(at, axis, 1.0);
            norm(motion).powi(-2)
        };
        let mut ends: Vec<EdgeEnd> = tasks.iter().map(|_| EdgeEnd::Stuck).collect();
        let mut ways: Vec<(usize, PacedStep)> = (tasks.iter().enumerate())
            .map(|(i, task)| {
                let edge = spread.step(self.grid, *task);
                let way = PacedStep {
                    axis: edge.axis,
                    end: edge.to,
                    x: edge.to[edge.axis] - edge.change,
                    step: 0.5 * edge.change,
                    slowness: slowness(edge.from, edge.axis),
                    fold: f64::INFINITY,
                    at: edge.from.arrival(),
                };
                (i, way)
            })
            .collect();
        let mut storage = Vec::new();
        for _ in 0..ROUNDS {
            if ways.is_empty() {
                break;
            }
            let starts: Vec<StepStart> = (ways.iter()).map(|(_, way)| self.start_of(way)).collect();
            let arrivals = self.settled(steps, &starts);
            let arrivals = arrivals.iter().flat_map(Arrivals::iter);
            let mut left = Vec::new();
            for ((i, mut way), arrival) in ways.into_iter().zip(arrivals) {
                let from = way.at.moving();
                let (_, length) = self.metric.motion(from, way.axis, way.step);
                let sure = arrival.filter(|to| self.metric.alike(from, *to, length, &mut storage));
                match sure {
                    Some(arrival) if way.step == way.rest() => {
                        ends[i] = EdgeEnd::Arrived(arrival.arrival());
                    }
                    Some(arrival) => {
                        let slowness = slowness(arrival, way.axis);
                        match way.on(arrival.arrival(), slowness) {
                            true => ends[i] = EdgeEnd::Fold,
                            false => left.push((i, way)),
                        }
                    }
                    None => {
                        way.step *= 0.5;
                        let edge = self.grid.spacing(way.axis).abs();
                        if way.step.abs() > 1.0 / 256.0 * edge {
                            left.push((i, way));
                        }
                    }
                }
            }
            ways = left;
        }
        ends
    }

    fn start_of<'w>(&self, way: &'w PacedStep) -> StepStart<'w> {
        let mut values = way.end;
        if way.step != way.rest() {
            values[way.axis] = way.x + way.step;
        }
        self.towards(way.at.moving(), way.axis, way.step, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::workspace::problem::Indicators;
    use crate::mechanism::Configuration;

    fn way(slowness: f64) -> PacedStep {
        PacedStep {
            at: arrival(),
            axis: 0,
            end: [1.0, 0.0, 0.0],
            x: 0.0,
            step: 0.125,
            slowness,
            fold: f64::INFINITY,
        }
    }

    fn arrival() -> TangentSolution {
        TangentSolution {
            at: Configuration {
                joints: Vec::new(),
                platforms: Vec::new(),
            },
            motions: Vec::new(),
            indicators: Indicators {
                regular: true,
                direct: 1.0,
                inverse: 1.0,
                condition: 1.0,
            },
        }
    }

    fn folds(slowness: impl Fn(f64) -> f64) -> bool {
        let mut way = way(slowness(0.0));
        for _ in 0..30 {
            if way.step == way.rest() {
                return false;
            }
            let next = slowness(way.x + way.step);
            if way.on(arrival(), next) {
                return true;
            }
        }
        false
    }

    #[test]
    fn a_fold_before_the_end_is_told_from_one_behind_it_and_from_a_leg_that_turns_fast() {
        for at in [0.3, 0.6, 0.85] {
            // with a curved rest, as a motion has it
            assert!(folds(|x| (at - x) * (1.0 + 0.2 * x)), "{at}");
        }
        for behind in [1.01, 1.2, 3.0] {
            assert!(!folds(|x| behind - x), "{behind}");
        }
        for passed in [1e-3, 1e-2, 0.1] {
            assert!(!folds(|x| (x - 0.4) * (x - 0.4) + passed * passed));
        }
    }
}
