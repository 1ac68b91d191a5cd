//! Equations of Newton's method: all closure equations, or fewer where platforms leave.

use super::placing::placings;
use super::{NoSolver, StateVariable, VariablePlan};
use crate::algebra::{OperationIndex, Recorded};
use crate::algebra::{Pivot, eliminate};
use crate::mechanism::{Configuration, Dimensions};
use crate::solve::Equations;
use crate::system::{Held, System};

/// Equations, Jacobian and step of Newton's method.
pub(super) struct Iteration {
    /// With the factors by which no closure row is larger.
    pub rows: Vec<(Recorded, f64)>,
    /// The Jacobian of the rows by these unknowns.
    pub jacobian: Vec<Vec<Recorded>>,
    /// The steps of unknowns by their places.
    pub step: Vec<(usize, Recorded)>,
    /// Pivots of a step.
    pub pivots: Vec<Pivot>,
    /// Numbers of the state that follow afterwards, by their places.
    pub placed: Vec<(usize, Recorded)>,
    /// Pivots of these.
    pub placing: Vec<Pivot>,
}

impl Iteration {
    /// Iteration on all rows, with the step that follows from them by these pivots.
    pub fn of(rows: &OpenRows, step: Vec<Recorded>, pivots: Vec<Pivot>) -> Self {
        Iteration {
            rows: rows.residual.iter().map(|&row| (row, 1.0)).collect(),
            jacobian: rows.jacobian.clone(),
            step: step.into_iter().enumerate().collect(),
            pivots,
            placed: Vec::new(),
            placing: Vec::new(),
        }
    }
}

/// Rows that do not vanish whatever the unknowns are, which would say nothing.
pub(super) struct OpenRows {
    pub open: Vec<usize>,
    pub residual: Vec<Recorded>,
    pub jacobian: Vec<Vec<Recorded>>,
}

impl OpenRows {
    pub fn of(system: &System<Recorded>, at: &Configuration<Recorded>) -> Self {
        let mut work = system.work();
        system.linearise(at, &mut work);
        let residual = system.residual_of(&work);
        let (rows, unknowns) = (system.rows(), system.unknowns().len());
        let jacobian = system.dense_jacobian(&work);
        let open = (0..rows).filter(|&row| residual[row].constant() != Some(0.0));
        let open: Vec<usize> = open.collect();
        let row = |&row: &usize| (0..unknowns).map(|c| jacobian[c * rows + row]).collect();
        OpenRows {
            residual: open.iter().map(|&row| residual[row]).collect(),
            jacobian: open.iter().map(row).collect(),
            open,
        }
    }

    /// The numbers that belong to open rows.
    pub fn among(&self, all: &[Recorded]) -> Vec<Recorded> {
        self.open.iter().map(|&row| all[row]).collect()
    }
}

pub(super) fn negated(of: Vec<Recorded>) -> Vec<Recorded> {
    of.into_iter().map(|x| -x).collect()
}

pub(super) fn places(of: &[Recorded]) -> Vec<OperationIndex> {
    of.iter().map(|number| number.place()).collect()
}

pub(super) fn numbered(of: &[(usize, Recorded)]) -> Vec<(usize, OperationIndex)> {
    of.iter().map(|(i, number)| (*i, number.place())).collect()
}

impl VariablePlan<'_> {
    /// The iteration on all closure rows.
    pub(super) fn on_all(
        &self,
        system: &System<Recorded>,
        at: &Configuration<Recorded>,
    ) -> Result<Iteration, NoSolver> {
        let (rows, unknowns) = (OpenRows::of(system, at), system.unknowns().len());
        let sides = vec![rows.residual.clone()];
        let (mut solutions, pivots) = eliminate(rows.jacobian.clone(), sides, unknowns)
            .map_err(|rank| NoSolver::Singular { rank, unknowns })?;
        let step = negated(solutions.swap_remove(0));
        Ok(Iteration::of(&rows, step, pivots))
    }

    /// The iteration without the poses of platforms that stand on three balls, if there are any.
    pub(super) fn placing(
        &self,
        system: &System<Recorded>,
        mut held: Held<Recorded>,
        dimensions: &Dimensions<Recorded>,
        at: &Configuration<Recorded>,
    ) -> Option<Iteration> {
        let placings = placings(self.mechanism, &self.held);
        let (mut few, mut reached) = (dimensions.clone(), at.clone());
        let (mut placing, mut own) = (Vec::new(), Vec::new());
        for platform in &placings {
            let (pose, pivot) = platform.pose(dimensions, at);
            reached.platforms[platform.platform] = pose;
            platform.leave(&mut few, &mut held);
            placing.push(pivot);
            own.push(platform.platform);
        }
        if own.is_empty() {
            return None;
        }
        let few = System::new(&few, &held);
        let rows = OpenRows::of(&few, at);
        let closure = |row: usize| few.closure_rows().position(|rows| rows.contains(&row));
        let factor = |row: usize| {
            let mut own = placings.iter();
            let placing = own.find(|p| closure(row).is_some_and(|c| p.closures.contains(&c)));
            placing.map_or(1.0, |p| p.stretch(few.characteristic_length()))
        };
        let unknowns = few.unknowns().len();
        let (mut solutions, pivots) =
            eliminate(rows.jacobian.clone(), vec![rows.residual.clone()], unknowns).ok()?;
        let step = negated(solutions.pop()?).into_iter().zip(few.unknowns());
        let step = step.filter_map(|(x, &unknown)| Some((system.place_of(unknown)?, x)));
        let placed = self
            .state
            .iter()
            .enumerate()
            .filter_map(|(i, variable)| match variable {
                StateVariable::Orientation(platform, _) | StateVariable::Position(platform, _) => {
                    own.contains(platform)
                        .then(|| (i, variable.of(self.mechanism, &reached)))
                }
                _ => None,
            });
        Some(Iteration {
            rows: (rows.residual.into_iter())
                .zip(rows.open.into_iter().map(factor))
                .collect(),
            jacobian: rows.jacobian,
            step: step.collect(),
            pivots,
            placed: placed.collect(),
            placing,
        })
    }
}
