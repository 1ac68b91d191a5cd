//! All zeros in a box, by interval branch and prune.
//!
//! A box in which a row cannot vanish is dropped. Others are contracted by the mean-value form of each row and of the
//! rows preconditioned by the Jacobian of the middle (Hansen and Sengupta 1981; Neumaier 1990, chapter 5), and halved.
//! A box lies round one zero at most where the preconditioned matrix is strictly diagonally dominant for all points of
//! the box, columns weighted by its sides: then no matrix of mean slopes has a kernel.

use nalgebra::{DMatrix, DVector};

use super::threads::Pool;
use super::{Stage, Watch};
use crate::number::tolerance::SAME;
use crate::number::{Interval, Number};

/// Rows that vanish where a solution is, over boxes.
pub trait Conditions: Sync {
    /// Storage.
    type Work: Clone + Send + Sync;
    /// Storage for evaluations.
    fn work(&self) -> Self::Work;
    /// Evaluates the rows over a box, and their derivatives.
    fn evaluate(&self, at: &[Interval], slopes: bool, work: &mut Self::Work);
    /// True if the conditions that are no rows allow a solution in the box.
    fn possible(&self, work: &Self::Work) -> bool;
    /// The values of the rows.
    fn values<'a>(&self, work: &'a Self::Work) -> &'a [Interval];
    /// Their derivatives, column-major.
    fn slopes<'a>(&self, work: &'a Self::Work) -> &'a [Interval];
}

/// Limits of branch and prune.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pruning {
    /// Boxes after which the search ends.
    pub most_boxes: usize,
    /// Boxes too small to be halved after which the search ends: about a set of solutions there is no end of them.
    pub most_left: usize,
}

impl Default for Pruning {
    fn default() -> Self {
        Pruning {
            most_boxes: 2_000_000,
            most_left: 2000,
        }
    }
}

/// The sides of a box, an interval for each unknown.
pub type Sides = Vec<Interval>;

/// Result of branch and prune.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pruned {
    /// Boxes examined.
    pub boxes: usize,
    /// For each region given, how many boxes ended in it.
    pub met: Vec<usize>,
    /// Boxes outside of these regions that hold exactly one zero of the preconditioned rows.
    pub found: Vec<Sides>,
    /// Boxes too small to be halved in which zeros are not excluded.
    pub left: Vec<Sides>,
    /// Boxes not examined.
    pub waiting: Vec<Sides>,
}

/// A box round a point that holds one zero at most. Its sides are 2·10⁻⁸ to 1; none where no such box is found.
pub fn isolated<C: Conditions>(conditions: &C, centre: &[f64]) -> Option<Sides> {
    let mut work = conditions.work();
    let mut radius = 0.5;
    while radius > 1e-8 {
        let sides: Sides = centre
            .iter()
            .map(|&x| Interval::around(x, radius))
            .collect();
        if let Some(step) = contracted(conditions, &sides, &mut work)
            && step.unique
        {
            return Some(sides);
        }
        radius *= 0.7;
    }
    None
}

/// True if a box is proved to hold exactly one zero of the preconditioned rows, for each value of constants that are
/// intervals.
pub fn holds_one<C: Conditions>(conditions: &C, sides: &Sides, work: &mut C::Work) -> bool {
    // without unknowns there is nothing to choose
    contracted(conditions, sides, work).is_some_and(|step| step.one || sides.is_empty())
}

/// A zero near a point, by Newton steps without control of rounding.
pub fn nearest<C: Conditions>(
    conditions: &C,
    start: &[f64],
    work: &mut C::Work,
) -> Option<Vec<f64>> {
    const STEPS: usize = 20;
    let mut x = start.to_vec();
    for _ in 0..STEPS {
        let point: Vec<Interval> = x.iter().map(|&x| Interval::point(x)).collect();
        conditions.evaluate(&point, true, work);
        let values = conditions.values(work).iter().map(|f| f.real());
        let values = DVector::from_iterator(conditions.values(work).len(), values);
        let slopes = conditions.slopes(work).iter().map(|f| f.real());
        let slopes = DMatrix::from_iterator(values.len(), x.len(), slopes);
        let step = nearly_inverse(&slopes)? * values;
        x.iter_mut().zip(&step).for_each(|(x, step)| *x -= step);
        if step.amax() < 1e-13 {
            return Some(x);
        }
    }
    None
}

/// Looks for zeros in `domain` outside of `regions`, which hold one zero at most; unknowns may have periods.
pub fn prune<C: Conditions>(
    conditions: &C,
    domain: Sides,
    periods: &[Option<Interval>],
    regions: &[Sides],
    settings: &Pruning,
    watch: &Watch,
) -> Pruned {
    /// Boxes that are worked on at a time, and those that each of them becomes before the next ones.
    const BATCH: usize = 32;
    const PIECE: usize = 256;
    let pool = Pool::new(conditions.work());
    let mut regions = regions.to_vec();
    let given = regions.len();
    let mut all = Pruned {
        met: vec![0; given],
        waiting: vec![domain],
        ..Pruned::default()
    };
    while !all.waiting.is_empty()
        && all.boxes < settings.most_boxes
        && all.left.len() < settings.most_left
    {
        if watch.stops(Stage::Boxes, all.boxes, None) {
            break;
        }
        let first = all.waiting.len().saturating_sub(BATCH);
        let batch = all.waiting.split_off(first);
        let allowed = settings.most_boxes - all.boxes;
        let most = PIECE.min(allowed.div_ceil(batch.len()));
        let pieces = pool.each(batch.len(), |work, i| {
            piece(conditions, &batch[i], (periods, &regions), most, work)
        });
        for piece in pieces {
            all.boxes += piece.boxes;
            all.left.extend(piece.left);
            all.waiting.extend(piece.waiting);
            for (met, more) in all.met.iter_mut().zip(&piece.met) {
                *met += more;
            }
            for found in piece.found {
                let place = |region: &Sides| lies_in(&found, region, periods);
                if regions[given..].iter().any(place) {
                    continue;
                }
                let centre: Vec<f64> = found.iter().map(|x| x.real()).collect();
                regions.push(isolated(conditions, &centre).unwrap_or_else(|| found.clone()));
                all.found.push(found);
            }
        }
    }
    all
}

/// Prunes a box and the parts into which it is halved, up to `most` boxes.
fn piece<C: Conditions>(
    conditions: &C,
    start: &Sides,
    (periods, regions): (&[Option<Interval>], &[Sides]),
    most: usize,
    work: &mut C::Work,
) -> Pruned {
    let mut done = Pruned {
        met: vec![0; regions.len()],
        waiting: vec![start.clone()],
        ..Pruned::default()
    };
    while done.boxes < most {
        let Some(mut sides) = done.waiting.pop() else {
            break;
        };
        done.boxes += 1;
        let region = |sides: &Sides| regions.iter().position(|r| lies_in(sides, r, periods));
        let mut one = false;
        let mut place = region(&sides);
        let mut along = 0;
        // on with it as long as a side loses a fifth
        let empty = loop {
            if place.is_some() {
                break false;
            }
            let Some(step) = contracted(conditions, &sides, work) else {
                break true;
            };
            one |= step.one;
            along = step.longest;
            let shrunk =
                (step.sides.iter().zip(&sides)).any(|(new, old)| new.width() < 0.8 * old.width());
            sides = step.sides;
            place = region(&sides);
            let tiny = sides.iter().all(|x| x.width() < 1e-12);
            if !shrunk || tiny {
                break false;
            }
        };
        let longest = sides.iter().map(|x| x.width()).fold(0.0, f64::max);
        match (empty, place) {
            (true, _) => {}
            (_, Some(place)) => done.met[place] += 1,
            _ if longest <= SAME && one => done.found.push(sides),
            _ if longest <= SAME => done.left.push(sides),
            _ => {
                let x = sides[along];
                // halves are not equal, so that no face passes through a zero in the middle
                let middle = x.low + 0.487 * x.width();
                let mut lower = sides.clone();
                lower[along].high = middle;
                sides[along].low = middle;
                done.waiting.extend([sides, lower]);
            }
        }
    }
    done
}

/// True if a box, moved by whole periods, lies in another.
fn lies_in(sides: &Sides, region: &Sides, periods: &[Option<Interval>]) -> bool {
    sides
        .iter()
        .zip(region)
        .zip(periods)
        .all(|((x, region), period)| {
            let x = match period {
                Some(period) => {
                    let turns = ((x.real() - region.real()) / period.real()).round();
                    *x - *period * Interval::point(turns)
                }
                None => *x,
            };
            region.low <= x.low && x.high <= region.high
        })
}

struct BoxStep {
    sides: Sides,
    /// True if the box before holds at most one zero.
    unique: bool,
    /// True if the new box holds exactly one zero of the preconditioned rows.
    one: bool,
    /// The side that matters most.
    longest: usize,
}

/// A box that holds all zeros of another; `None` if there are none.
fn contracted<C: Conditions>(conditions: &C, sides: &Sides, work: &mut C::Work) -> Option<BoxStep> {
    let n = sides.len();
    conditions.evaluate(sides, true, work);
    let values = conditions.values(work);
    if !conditions.possible(work) || values.iter().any(|f| f.low > 0.0 || f.high < 0.0) {
        return None;
    }
    let rows = values.len();
    // what rounding may add to a sum of so many products (Higham 2002, §3.1)
    let error = 4.0 * (rows + n + 4) as f64 * f64::EPSILON;
    let middle: Vec<f64> = sides.iter().map(|x| x.real()).collect();
    let reach = |x: &Interval| (x.high - x.real()).max(x.real() - x.low).next_up();
    let radii: Vec<f64> = sides.iter().map(reach).collect();
    let slopes = conditions.slopes(work).to_vec();
    let mut step = BoxStep {
        sides: sides.clone(),
        // nothing to choose
        unique: n == 0,
        one: false,
        longest: 0,
    };
    let mut largest = -1.0;
    for (j, column) in slopes.chunks_exact(rows.max(1)).enumerate() {
        let slope = column.iter().map(|x| x.magnitude()).fold(0.0, f64::max);
        let effect = (slope.min(1e3) + 1e-3) * radii[j];
        if effect > largest && radii[j] > 0.0 {
            (largest, step.longest) = (effect, j);
        }
    }
    if slopes.iter().any(|x| !x.is_finite()) || n == 0 {
        return Some(step);
    }
    let point: Vec<Interval> = middle.iter().map(|&x| Interval::point(x)).collect();
    conditions.evaluate(&point, false, work);
    let values = conditions.values(work);

    // f(m) + Σ f′ⱼ (xⱼ − mⱼ), row by row
    let mut part = vec![0.0; n];
    for (r, f) in values.iter().enumerate() {
        for (j, part) in part.iter_mut().enumerate() {
            *part = slopes[j * rows + r].magnitude() * radii[j];
        }
        let slope = |j: usize| slopes[j * rows + r];
        step.narrow(*f, &part, &slope, (&middle, error))?;
    }

    // the same of C f, where C is nearly an inverse of the slopes in the middle
    let centre = DMatrix::from_fn(rows, n, |r, j| slopes[j * rows + r].real());
    let Some(inverse) = nearly_inverse(&centre) else {
        return Some(step);
    };
    let product = &inverse * &centre;
    let (mut unique, mut one) = (true, true);
    let mut row = vec![Interval::point(0.0); n];
    for i in 0..n {
        let mut size = 0.0;
        let mut f = Interval::point(0.0);
        for (r, value) in values.iter().enumerate() {
            f += Interval::point(inverse[(i, r)]) * *value;
        }
        for (j, entry) in row.iter_mut().enumerate() {
            let (mut spread, mut summed) = (0.0, 0.0);
            for r in 0..rows {
                let x = slopes[j * rows + r];
                let c = inverse[(i, r)].abs();
                spread += c * reach(&x);
                summed += c * x.magnitude();
            }
            *entry = Interval::around(product[(i, j)], (spread + error * summed) * (1.0 + error));
            part[j] = entry.magnitude() * radii[j];
            size += part[j];
        }
        step.narrow(f, &part, &|j| row[j], (&middle, error))?;
        let own = match row[i].contains(0.0) {
            true => 0.0,
            false => row[i].low.abs().min(row[i].high.abs()) * radii[i],
        };
        let others = (size - part[i]).max(0.0) + error * size;
        unique &= others < own * (1.0 - error);
        one &= others + f.magnitude() < own * (1.0 - error);
    }
    (step.unique, step.one) = (unique, unique && one);
    Some(step)
}

impl BoxStep {
    /// Narrows a side by 0 ∈ f + Σ sⱼ dⱼ, where |sⱼ dⱼ| ≤ partⱼ; `None` if that is impossible.
    fn narrow(
        &mut self,
        f: Interval,
        part: &[f64],
        slope: &dyn Fn(usize) -> Interval,
        (middle, error): (&[f64], f64),
    ) -> Option<()> {
        let sum = part.iter().sum::<f64>() * (1.0 + error);
        if f.low > sum || f.high < -sum {
            return None;
        }
        for (j, side) in self.sides.iter_mut().enumerate() {
            let s = slope(j);
            if s.contains(0.0) || part[j] < 0.1 * sum {
                continue;
            }
            let others = (sum - part[j]).max(0.0) + error * sum;
            let rest = Interval {
                low: (-f.high - others).next_down(),
                high: (-f.low + others).next_up(),
            };
            let x = Interval::point(middle[j]) + rest / s;
            side.low = side.low.max(x.low);
            side.high = side.high.min(x.high);
            if side.low > side.high {
                return None;
            }
        }
        Some(())
    }
}

/// (AᵀA + λ)⁻¹Aᵀ. Any matrix serves; this one makes its product with A nearly the identity.
fn nearly_inverse(a: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let transposed = a.transpose();
    let mut normal = &transposed * a;
    let shift = 1e-13 * normal.trace();
    for i in 0..normal.nrows() {
        normal[(i, i)] += shift;
    }
    let factor = normal.cholesky()?;
    Some(factor.solve(&transposed))
}
