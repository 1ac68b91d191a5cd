//! Following a curve of solutions: F(x) = 0 with one freedom left.
//!
//! A curve offers its residual, its Jacobian and its manifold ([`SolutionCurve`]). Rows may be redundant, as long as
//! the rank at a regular place is one less than the number of unknowns. Predictor: the tangent. Corrector: Newton's
//! method in the plane across it with the Jacobian of the place the step starts from (pseudo-arclength continuation;
//! Keller 1977).
//!
//! **When a step is accepted.** With J⁺ of the place x₀ it starts from, both the correction must contract and
//! ‖J⁺(J(x₁) − J(x₀))‖ ≤ [`Continuation::change`] < 1 must hold at its end x₁ (in the Frobenius norm, an upper bound).
//! As long as the same holds between them, x ↦ J⁺F(x) is one to one on each plane across the tangent (the affine
//! covariant theorem of Newton and Kantorovich; Deuflhard, Newton Methods for Nonlinear Problems, 2004, §2.1): there
//! is no other solution for the step to end at. A crossing of branches, where J⁺ is infinite, is located and left as a
//! [`BranchPoint`](super::BranchPoint).
//!
//! **Large Jacobians** must meet the second condition group of rows by group, each with the inverse of its own rows.
//! A group that these leave only the freedom along the tangent changes no branch by its own unknowns, and so nothing
//! does; the norm of the whole would grow with the number of loops in a row.

mod place;

use crate::number::tolerance::SOLVED;
pub use place::CurvePoint;

use crate::linear::{Decomposition, RowGroup, dot, norm};

/// A set of solutions with one freedom, on a manifold of points with tangent coordinates.
pub trait SolutionCurve {
    /// A point of the manifold.
    type Point: Clone;

    /// Number of tangent coordinates.
    fn unknowns(&self) -> usize;
    /// F at a point, every row dimensionless.
    fn residual(&mut self, at: &Self::Point) -> Vec<f64>;
    /// F and its Jacobian at a point, column-major, rows × unknowns.
    fn linearise(&mut self, at: &Self::Point) -> (Vec<f64>, Vec<f64>);
    /// F and the groups of rows of its Jacobian, if that is large.
    fn linearise_groups(&mut self, _: &Self::Point) -> Option<(Vec<f64>, Vec<RowGroup>)> {
        None
    }
    /// at ⊕ step.
    fn displaced(&self, at: &Self::Point, step: &[f64]) -> Self::Point;
    /// The step that leads from one point to another.
    fn difference(&self, from: &Self::Point, to: &Self::Point) -> Vec<f64>;
}

/// Reasons for which no regular place is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepFailure {
    /// Newton's method does not lead to the curve.
    NotClosed,
    /// Branches cross here, or more than one freedom is left.
    Singular,
    /// The step would have to be shorter than [`Continuation::shortest`].
    TooShort,
}

/// Tolerances and step lengths of a continuation.
#[derive(Clone, Debug, PartialEq)]
pub struct Continuation {
    /// A point is on the curve when no row exceeds this.
    pub tolerance: f64,
    /// The longest step, in rad and characteristic lengths.
    pub longest: f64,
    /// Steps shorter than this are not tried.
    pub shortest: f64,
    /// Largest ‖J⁺(J₁ − J₀)‖ along a step: below 1.
    pub change: f64,
}

impl Default for Continuation {
    fn default() -> Self {
        Continuation {
            tolerance: SOLVED,
            longest: 0.1,
            shortest: 1e-10,
            change: 0.25,
        }
    }
}

impl Continuation {
    /// The regular place of the curve nearest to a point, by Gauss–Newton steps of least length.
    /// The tangent's sense is arbitrary; see [`CurvePoint::towards`].
    ///
    /// # Errors
    /// If the steps do not arrive, or the point they arrive at is not regular.
    pub fn settle<C: SolutionCurve>(
        &self,
        curve: &mut C,
        at: C::Point,
    ) -> Result<CurvePoint<C::Point>, StepFailure> {
        self.settle_after(curve, at, f64::INFINITY)
    }

    /// As [`Continuation::settle`], after a step of size `before`.
    fn settle_after<C: SolutionCurve>(
        &self,
        curve: &mut C,
        mut at: C::Point,
        mut before: f64,
    ) -> Result<CurvePoint<C::Point>, StepFailure> {
        const STEPS: usize = 30;
        let unknowns = curve.unknowns();
        for _ in 0..STEPS {
            let regular = unknowns.saturating_sub(1);
            let (residual, jacobian, decomposition) = match curve.linearise_groups(&at) {
                Some((residual, groups)) => {
                    if !residual.iter().all(|x| x.is_finite()) {
                        return Err(StepFailure::NotClosed);
                    }
                    (residual, vec![], Decomposition::of_groups(unknowns, groups))
                }
                None => {
                    let (residual, jacobian) = curve.linearise(&at);
                    if !jacobian.iter().chain(&residual).all(|x| x.is_finite()) {
                        return Err(StepFailure::NotClosed);
                    }
                    let rows = residual.len();
                    let cut = Decomposition::of_rank(rows, unknowns, &jacobian, regular);
                    (residual, jacobian, cut)
                }
            };
            let step = back(&decomposition, &residual);
            let size = norm(&step);
            let largest = residual.iter().fold(0.0f64, |m, r| m.max(r.abs()));
            let closed = largest <= self.tolerance;
            // what the rank tolerance cuts off has no inverse
            if closed && decomposition.whole_rank() < regular {
                return Err(StepFailure::Singular);
            }
            let settled = size < 1e-14 || (closed && size >= 0.25 * before);
            if !size.is_finite() || size > 1e3 || (settled && !closed) {
                return Err(StepFailure::NotClosed);
            }
            if settled {
                let free = unknowns - decomposition.whole_rank().min(unknowns);
                if free != 1 {
                    return Err(StepFailure::Singular);
                }
                // too short to change the Jacobian, but it takes the last digits in
                if size < 1e-8 {
                    at = curve.displaced(&at, &step);
                }
                let tangent = decomposition.null_space().swap_remove(0);
                return Ok(CurvePoint {
                    at,
                    tangent,
                    jacobian,
                    decomposition,
                });
            }
            before = size;
            at = curve.displaced(&at, &step);
        }
        Err(StepFailure::NotClosed)
    }

    /// A place from which steps can be made, although it may have been [thinned](CurvePoint::thinned).
    pub fn restored<C: SolutionCurve>(
        &self,
        curve: &mut C,
        place: &CurvePoint<C::Point>,
    ) -> Option<CurvePoint<C::Point>> {
        match place.jacobian.is_empty() && place.decomposition.groups().is_none() {
            true => Some((self.settle(curve, place.at.clone()).ok()?).towards(&place.tangent)),
            false => Some(place.clone()),
        }
    }

    /// The place at the distance `length` along the tangent, if the step meets the conditions above.
    ///
    /// # Errors
    /// [`StepFailure::TooShort`] if it does not: try half the length.
    pub fn step<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &CurvePoint<C::Point>,
        length: f64,
    ) -> Result<(CurvePoint<C::Point>, f64), StepFailure> {
        let to = self
            .across(curve, from, length)
            .ok_or(StepFailure::TooShort)?;
        let change = change(from, &to);
        match change <= self.change && dot(&from.tangent, &to.tangent) > 0.5 {
            true => Ok((to, change)),
            false => Err(StepFailure::TooShort),
        }
    }

    /// The place in the plane across the tangent at a distance, by simplified Newton steps.
    pub fn across<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &CurvePoint<C::Point>,
        length: f64,
    ) -> Option<CurvePoint<C::Point>> {
        if from.decomposition.groups().is_some() {
            return self.settled_ahead(curve, from, length);
        }
        let (at, size) = self.ahead(curve, from, length)?;
        let place = self.settle_after(curve, at, size).ok()?;
        Some(place.towards(&from.tangent))
    }

    /// A place near the one at a distance along the tangent, by full Newton steps: others hardly contract there.
    fn settled_ahead<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &CurvePoint<C::Point>,
        length: f64,
    ) -> Option<CurvePoint<C::Point>> {
        let ahead: Vec<f64> = from.tangent.iter().map(|x| x * length).collect();
        let predicted = curve.displaced(&from.at, &ahead);
        let place = self.settle(curve, predicted.clone()).ok()?;
        let corrected = norm(&curve.difference(&predicted, &place.at));
        (corrected <= 0.5 * length.abs()).then(|| place.towards(&from.tangent))
    }

    /// The point of that place, which takes no decomposition, with the size of the last step to it.
    pub fn ahead<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &CurvePoint<C::Point>,
        length: f64,
    ) -> Option<(C::Point, f64)> {
        const STEPS: usize = 40;
        let ahead: Vec<f64> = from.tangent.iter().map(|x| x * length).collect();
        let mut at = curve.displaced(&from.at, &ahead);
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let residual = curve.residual(&at);
            let step = back(&from.decomposition, &residual);
            let size = norm(&step);
            // a NaN is refused too
            let shrinks = size < 0.5 * before;
            let there = size < 1e-13 || (size < 1e-11 && !shrinks);
            let sure = size <= 0.5 * length.abs() && shrinks;
            if !sure && !there {
                return None;
            }
            before = size;
            at = curve.displaced(&at, &step);
            if there {
                break;
            }
        }
        Some((at, before))
    }

    /// The place between two where a function of places, of different signs there, vanishes to rounding. `to` is one
    /// step from `from`; where `from` is singular, steps are made from `to`.
    ///
    /// Regula falsi with the weights of Anderson and Björck 1973, halving when that does not.
    pub fn root<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &CurvePoint<C::Point>,
        to: &CurvePoint<C::Point>,
        f: &mut dyn FnMut(&mut C, &CurvePoint<C::Point>) -> f64,
    ) -> CurvePoint<C::Point> {
        const EVALUATIONS: usize = 80;
        let back = from.is_singular();
        let turned = back.then(|| [to, from].map(|place| place.clone().reversed()));
        let [from, to] = turned.as_ref().map_or([from, to], |[to, from]| [to, from]);
        // solutions of large equations are rounded more
        let (near, zero) = match from.decomposition.groups() {
            Some(_) => (1e-11, 1e-11),
            None => (4.0 * f64::EPSILON, 0.0),
        };
        let end = dot(&curve.difference(&from.at, &to.at), &from.tangent);
        let (mut low, mut high) = ((0.0, f(curve, from)), (end, f(curve, to)));
        let (nearest, value) = if low.1.abs() < high.1.abs() {
            (from, low.1)
        } else {
            (to, high.1)
        };
        let mut best = (value.abs(), nearest.clone());
        let (mut width, mut slow) = (end.abs(), 0);
        for _ in 0..EVALUATIONS {
            if best.0 <= zero || (high.0 - low.0).abs() <= near * end.abs() {
                break;
            }
            let mut s = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let within = (s - low.0) * (high.0 - s) > 0.0;
            if slow >= 3 || !within {
                s = 0.5 * (low.0 + high.0);
                slow = 0;
            }
            if s == low.0 || s == high.0 {
                break;
            }
            let Some(place) = self.across(curve, from, s) else {
                break;
            };
            let value = f(curve, &place);
            if value.abs() < best.0 {
                best = (value.abs(), place);
            }
            if value.signum() == low.1.signum() {
                let weight = 1.0 - value / low.1;
                high.1 *= if weight > 0.0 { weight } else { 0.5 };
                low = (s, value);
            } else {
                let weight = 1.0 - value / high.1;
                low.1 *= if weight > 0.0 { weight } else { 0.5 };
                high = (s, value);
            }
            let now = (high.0 - low.0).abs();
            slow = if now > 0.5 * width { slow + 1 } else { 0 };
            width = now;
        }
        match back {
            true => best.1.reversed(),
            false => best.1,
        }
    }

    /// A length for the next step from that of the last and the change along it; of many unknowns the fastest counts.
    pub fn next_length<P>(&self, length: f64, changed: f64, from: &CurvePoint<P>) -> f64 {
        let wanted = 0.7 * self.change / changed.max(1e-3);
        let fastest = match from.decomposition.groups() {
            Some(_) => from.tangent.iter().fold(0.0f64, |m, x| m.max(x.abs())),
            None => 1.0,
        };
        (length * wanted.clamp(0.5, 2.0)).min(self.longest / fastest)
    }
}

/// Relative change of the Jacobian between two places, ‖J⁺(J₁ − J₀)‖; of a large one, the largest of any group of rows.
pub(super) fn change<P>(from: &CurvePoint<P>, to: &CurvePoint<P>) -> f64 {
    if let (Some(before), Some(after)) = (from.decomposition.groups(), to.decomposition.groups()) {
        let mut changes = before.iter().zip(after).map(|(a, b)| group_change(a, b));
        let largest = changes.try_fold(0.0f64, |m, change| Some(m.max(change?)));
        return largest.unwrap_or_else(|| from.decomposition.relative_change(after));
    }
    let rows = match from.tangent.len() {
        0 => return 0.0,
        n => from.jacobian.len() / n,
    };
    let [before, after] = [from, to].map(|place| place.jacobian.chunks_exact(rows.max(1)));
    let squares = before.zip(after).map(|(before, after)| {
        let moved: Vec<f64> = after.iter().zip(before).map(|(a, b)| a - b).collect();
        let beside = from.decomposition.solve(&moved);
        dot(&beside, &beside)
    });
    squares.sum::<f64>().sqrt()
}

/// Relative change of a group of rows, by its own inverse; `None` if it leaves more freedoms than one.
fn group_change(before: &RowGroup, after: &RowGroup) -> Option<f64> {
    if before == after {
        return Some(0.0);
    }
    let columns = before.columns().zip(after.columns());
    let columns = columns.map(|((_, a), (_, b))| (a, b));
    let moving = |(a, b): &(&[f64], &[f64])| a.iter().chain(*b).any(|x| *x != 0.0);
    let columns: Vec<(&[f64], &[f64])> = columns.filter(moving).collect();
    let entries: Vec<f64> = columns.iter().flat_map(|(a, _)| *a).copied().collect();
    let here = Decomposition::of(before.count, columns.len(), &entries);
    let squares = columns.iter().map(|(a, b)| {
        let moved: Vec<f64> = b.iter().zip(*a).map(|(b, a)| b - a).collect();
        let beside = here.solve(&moved);
        dot(&beside, &beside)
    });
    (here.rank() + 1 == columns.len()).then(|| squares.sum::<f64>().sqrt())
}

/// −J⁺r.
pub(super) fn back(decomposition: &Decomposition, residual: &[f64]) -> Vec<f64> {
    let mut step = decomposition.solve(residual);
    step.iter_mut().for_each(|x| *x = -*x);
    step
}
