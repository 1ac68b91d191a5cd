//! Steps from the nodes of a grid to their neighbours, and which of them are sure.

use std::hash::Hash;

use rustc_hash::FxHashSet;

use super::arrivals::{Arrivals, Moving};
use super::metric::Metric;
use super::reached::{Name, NodeSolution, Signs, signs};
use super::step::{SURE, Start, Steps};
use crate::algebra::BATCH;
use crate::analysis::workspace::problem::{Grid, MOST_AXES, MapProblem};
use crate::linear::norm;
use crate::mechanism::Configuration;
use crate::solve::Pool;

#[derive(Clone, Copy)]
pub(crate) struct Flood<'a> {
    pub problem: &'a MapProblem<'a>,
    pub grid: &'a Grid,
    pub metric: &'a Metric,
    /// Solutions kept at most.
    pub most: usize,
    /// The signs of the one aspect that is to be spread over, if not all are.
    pub only: Option<Signs>,
}

/// An edge of the grid that is to be gone along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a> {
    pub from: Moving<'a>,
    pub axis: usize,
    /// The mapped coordinates at its end, and zeros.
    pub to: [f64; MOST_AXES],
    /// By how much the mapped coordinate of its axis changes.
    pub change: f64,
}

impl Flood<'_> {
    pub(crate) fn goes_on_from(&self, solution: &NodeSolution) -> bool {
        self.only.is_none() || signs(solution) == self.only
    }

    /// A Newton start near an assembled configuration at a node.
    pub(crate) fn here<'s>(&self, node: usize, at: &'s Configuration<f64>) -> Start<'s> {
        Start {
            from: at.view(),
            along: None,
            reach: 1e-3,
            values: self.grid.point(node),
        }
    }

    pub(crate) fn settled(&self, steps: &Pool<Steps>, starts: &[Start]) -> Vec<Arrivals> {
        in_packs(steps, starts, |steps, pack| {
            let mut arrivals = Arrivals::default();
            steps.settle(pack, &mut arrivals);
            arrivals
        })
    }

    /// Which of the solutions of a node has this configuration.
    pub(crate) fn known<'s>(
        &self,
        mut solutions: impl Iterator<Item = (Name, Moving<'s>)>,
        at: Moving,
    ) -> Option<Name> {
        let known = solutions.find(|(_, known)| self.metric.meets(*known, at));
        known.map(|(name, _)| name)
    }

    /// The way from a node to its neighbour, of zero length if there is none.
    pub(crate) fn step<'f>(&self, node: usize, from: Moving<'f>, direction: usize) -> Step<'f> {
        let axis = direction / 2;
        let next = self.grid.neighbour(node, direction).unwrap_or(node);
        let to = self.grid.point(next);
        let here = self.grid.coordinate(axis, self.grid.place(node, axis));
        Step {
            from,
            axis,
            to,
            change: to[axis] - here,
        }
    }

    /// The solution at the neighbour that both tangent predictions agree on.
    pub(crate) fn near<'s>(
        &self,
        step: &Step,
        there: impl Iterator<Item = (Name, Moving<'s>)>,
        storage: &mut Vec<f64>,
    ) -> Option<Name> {
        let ahead = (self.metric).ahead(step.from, step.axis, step.change);
        let mut near = there.filter(|(_, to)| self.metric.linked(&ahead, *to, storage));
        let (first, _) = near.next()?;
        // if two are as near, shorter steps must distinguish them
        near.next().is_none().then_some(first)
    }

    /// The same for one pack.
    pub(crate) fn sure(
        &self,
        steps: &mut Steps,
        planned: &[Step],
        arrivals: &mut Arrivals,
        storage: &mut Vec<f64>,
    ) {
        let starts: Vec<Start> = (planned.iter())
            .map(|step| self.towards(step.from, step.axis, step.change, step.to))
            .collect();
        steps.settle(&starts, arrivals);
        for (i, step) in planned.iter().enumerate() {
            let (_, length) = self.metric.motion(step.from, step.axis, step.change);
            let alike = |to| self.metric.alike(step.from, to, length, storage);
            if !arrivals.get(i).is_some_and(alike) {
                arrivals.reject(i);
            }
        }
    }

    /// A start for a change of one mapped coordinate, which leads to these values.
    pub(crate) fn towards<'f>(
        &self,
        from: Moving<'f>,
        axis: usize,
        change: f64,
        values: [f64; MOST_AXES],
    ) -> Start<'f> {
        let (motion, factor) = self.metric.motion(from, axis, change);
        Start {
            from: from.at,
            along: Some((motion, factor)),
            reach: SURE * factor.abs() * norm(motion),
            values,
        }
    }
}

/// One step to each node from each mode known so far; the others wait for what it finds.
pub(crate) fn one_each<S, R: Eq + Hash>(
    steps: Vec<S>,
    mut node_and_mode: impl FnMut(&S) -> (Option<usize>, R),
) -> (Vec<S>, Vec<S>) {
    let mut taken = FxHashSet::with_capacity_and_hasher(steps.len(), Default::default());
    (steps.into_iter()).partition(|step| taken.insert(node_and_mode(step)))
}

/// What comes of items given to as many places as go side by side, in their order.
pub(crate) fn in_packs<I: Sync, R: Send>(
    steps: &Pool<Steps>,
    items: &[I],
    of: impl Fn(&mut Steps, &[I]) -> R + Sync,
) -> Vec<R> {
    let packs: Vec<&[I]> = items.chunks(BATCH).collect();
    steps.each(packs.len(), |steps, i| of(steps, packs[i]))
}
