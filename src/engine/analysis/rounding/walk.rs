//! Finite motions that closures resist no more than rounding explains.

use crate::linear::{Svd, add, dot, norm};
use crate::mechanism::{Configuration, Mechanism};
use crate::number::tolerance::LONGEST_STEP;
use crate::solve::Equations;
use crate::system::{Bundle, Bundled, System, SystemWork};

/// The first direction that rounding may have closed, and the number of equations that resist the others.
pub(super) struct RoundedDirections<'a> {
    pub bundle: &'a Bundle<'a>,
    file: &'a [f64],
    start: Configuration<f64>,
    /// Directions that are free or nearly so, orthonormal.
    free: Vec<Vec<f64>>,
    pub rank: usize,
    /// Conditions and singular values below this part of the largest are within the rounding.
    pub cut: f64,
    /// The most that rounding leaves open of a row.
    open: f64,
}

/// The rounding that arithmetic in double precision leaves in closures and singular values.
const ARITHMETIC: f64 = 2e-14;

/// One step of a walk, in rad or characteristic lengths.
const STRIDE: f64 = 0.2;

/// The steps to either side of one freedom, and of several: far enough that what bends is seen to, and that conditions on the
/// numbers that differ little from one configuration to the next are told apart.
const STEPS: [usize; 2] = [16, 6];

/// Amounts that rounding leaves open and closes, beside the sum of all roundings in a row: the second is larger where the closures
/// are badly conditioned.
const SLACK: f64 = 10.0;

/// The configuration that steps of least length reach in which directions beyond a rank do not count, with the largest row
/// that is left.
fn nearest(
    system: &System<f64>,
    work: &mut SystemWork<f64>,
    mut at: Configuration<f64>,
    counts: impl Fn(&[f64]) -> usize,
) -> (Configuration<f64>, f64, Svd) {
    const ROUNDS: usize = 40;
    let mut best: Option<(f64, Configuration<f64>, f64, Svd)> = None;
    let mut stale = 0;
    for _ in 0..ROUNDS {
        let size = system.linearise(&at, work);
        let (rows, unknowns) = (system.rows(), system.unknowns().len());
        let mut svd = Svd::of(rows, unknowns, &system.dense_jacobian(work));
        svd.values.truncate(rows.min(unknowns));
        let mut step = vec![0.0; unknowns];
        for i in 0..counts(&svd.values).min(svd.values.len()) {
            let part = dot(&svd.left[i], system.residual_of(work)) / svd.values[i];
            add(&mut step, -part, &svd.right[i]);
        }
        let long = norm(&step);
        let better = best
            .as_ref()
            .is_none_or(|(least, ..)| size.squares < 0.99 * least);
        stale = if better { 0 } else { stale + 1 };
        if best
            .as_ref()
            .is_none_or(|(least, ..)| size.squares <= *least)
        {
            best = Some((size.squares, at.clone(), size.largest, svd));
        }
        // a step that brings nothing and is short is the last
        if stale > 3 || stale > 0 && long < 1e-8 || long < 1e-15 || !long.is_finite() {
            break;
        }
        let factor = (LONGEST_STEP / long).min(1.0);
        step.iter_mut().for_each(|x| *x *= factor);
        at = system.displaced(&at, &step);
    }
    let (_, at, largest, svd) = best.expect("there is a first round");
    (at, largest, svd)
}

impl<'a> RoundedDirections<'a> {
    /// `None` if the numbers leave nothing open, unless they may, or more than rounding explains.
    pub(super) fn new(
        bundle: &'a Bundle<'a>,
        mechanism: &Mechanism,
        file: &'a [f64],
        may_be_exact: bool,
    ) -> Option<Self> {
        let system = bundle.equations::<f64>(file)?;
        let mut work = system.work();
        let (rows, unknowns) = (system.rows(), system.unknowns().len());
        if rows == 0 || unknowns == 0 {
            return None;
        }
        let open = |at: &Configuration<f64>| {
            let at = Bundled {
                numbers: file.to_vec(),
                configurations: vec![at.clone()],
            };
            let columns = bundle.by_numbers(&at)?.pop()?;
            let sum = |row: usize| {
                columns
                    .iter()
                    .skip(row)
                    .step_by(rows)
                    .map(|x| x.abs())
                    .sum()
            };
            Some((0..rows).map(sum).fold(0.0, f64::max))
        };
        let home = mechanism.home();
        // where drawings of joints begin they close whatever their numbers are
        let away = |sign: f64| {
            let step: Vec<f64> = (0..unknowns)
                .map(|i| sign * (0.2 + 0.15 * (i as f64 * 0.618_034).fract()))
                .collect();
            open(&system.displaced(&home, &step))
        };
        let most = open(&home)?.max(away(1.0)?).max(away(-1.0)?);
        let cut = (SLACK * most).clamp(ARITHMETIC, 1e-2);
        let counts = |values: &[f64]| {
            let largest = values.first().copied().unwrap_or(0.0);
            values
                .iter()
                .filter(|value| **value > cut * largest)
                .count()
        };
        let (start, left, svd) = nearest(&system, &mut work, home, counts);
        let rank = counts(&svd.values);
        let most = open(&start)?.max(most);
        let largest = svd.values.first().copied().unwrap_or(0.0);
        let strictly = svd
            .values
            .iter()
            .filter(|value| **value > ARITHMETIC * largest)
            .count();
        let exact = strictly == rank && left <= ARITHMETIC;
        // with values that a drawing means nothing may be left free: a structure, however exactly it closes
        let stands = may_be_exact && rank == unknowns;
        if exact && !may_be_exact || stands || left > SLACK * most + ARITHMETIC || rank == 0 {
            return None;
        }
        Some(RoundedDirections {
            bundle,
            file,
            start,
            free: svd.right[rank..].to_vec(),
            rank,
            cut: cut.max(1e-8),
            open: SLACK * most + ARITHMETIC,
        })
    }

    fn steps(&self) -> usize {
        STEPS[usize::from(self.free.len() > 1)]
    }

    /// Directions to walk: each that is free, and for several of them sums of all.
    fn directions(&self) -> Vec<Vec<f64>> {
        let unknowns = self.free.first().map_or(0, Vec::len);
        let mut all = self.free.clone();
        if self.free.len() > 1 {
            for k in 1..=2 {
                let mut sum = vec![0.0; unknowns];
                for (i, direction) in self.free.iter().enumerate() {
                    // weights without a pattern
                    let weight = ((i + 1) as f64 * k as f64 * 0.618_034).fract() - 0.45;
                    add(&mut sum, weight, direction);
                }
                let size = norm(&sum).max(f64::MIN_POSITIVE);
                sum.iter_mut().for_each(|x| *x /= size);
                all.push(sum);
            }
        }
        all
    }

    /// Configurations along a way from one, and whether rounding explains all that they leave open.
    fn along(
        &self,
        system: &System<f64>,
        start: &Configuration<f64>,
        direction: &[f64],
        (stride, steps): (f64, usize),
        open: f64,
    ) -> Option<Vec<Configuration<f64>>> {
        let mut work = system.work();
        let (mut at, mut direction) = (start.clone(), direction.to_vec());
        let mut way = Vec::new();
        for _ in 0..steps {
            let step: Vec<f64> = direction.iter().map(|x| x * stride).collect();
            let (to, left, svd) = nearest(system, &mut work, system.displaced(&at, &step), |_| {
                self.rank
            });
            if left > open {
                return None;
            }
            let smallest = svd.values.get(self.rank - 1).copied().unwrap_or(0.0);
            // beside a singularity more is free, and tells nothing
            if smallest <= self.cut * svd.values[0] {
                break;
            }
            let mut next = vec![0.0; direction.len()];
            for free in &svd.right[self.rank..] {
                add(&mut next, dot(free, &direction), free);
            }
            let size = norm(&next);
            if size < 0.1 {
                break;
            }
            next.iter_mut().for_each(|x| *x /= size);
            (at, direction) = (to, next);
            way.push(at.clone());
        }
        Some(way)
    }

    /// Configurations of finite motions in all free directions; `None` if one leaves open more than rounding explains.
    pub(super) fn configurations(&self) -> Option<Vec<Configuration<f64>>> {
        let system = self.bundle.equations::<f64>(self.file)?;
        let mut all = vec![self.start.clone()];
        for direction in self.directions() {
            let mut here = Vec::new();
            for sign in [1.0, -1.0] {
                here.extend(self.along(
                    &system,
                    &self.start,
                    &direction,
                    (sign * STRIDE, self.steps()),
                    self.open,
                )?);
            }
            // a motion that ends at once is none
            if here.len() < 2 {
                return None;
            }
            all.extend(here);
        }
        Some(all)
    }

    /// Configurations in which a linkage does not close although it moves there; `None` if it closes in all.
    pub(super) fn opens(&self, found: &Bundled) -> Option<Vec<Configuration<f64>>> {
        let system = self.bundle.equations::<f64>(&found.numbers)?;
        let start = found.configurations.first()?;
        let directions = self.directions().into_iter();
        let mut open = Vec::new();
        for (k, direction) in directions.enumerate() {
            for sign in [1.0, -1.0] {
                let stride = sign * STRIDE * (1.3 + 0.1 * (k % 3) as f64);
                let way = self.along(&system, start, &direction, (stride, self.steps()), 1e-12);
                if way.is_none() {
                    open.extend(self.along(
                        &system,
                        start,
                        &direction,
                        (stride, self.steps()),
                        self.open,
                    )?);
                }
            }
        }
        (!open.is_empty()).then_some(open)
    }
}
