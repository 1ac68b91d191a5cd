//! A place on a curve of solutions.

use crate::linear::{Decomposition, SINGULAR_PLACE, SUSPECT, dot};

/// A regular point of a curve with its tangent.
#[derive(Clone, Debug)]
pub struct CurvePoint<P> {
    /// The point.
    pub at: P,
    /// Unit tangent, in the direction the curve is followed.
    pub tangent: Vec<f64>,
    pub(in crate::solve) jacobian: Vec<f64>,
    pub(in crate::solve) decomposition: Decomposition,
}

impl<P> CurvePoint<P> {
    /// The smallest singular value of the Jacobian across the tangent: it vanishes where branches cross. Of a large one
    /// the least pivot, which does too; singular values of long rows of loops are small everywhere.
    pub fn least(&self) -> f64 {
        if self.decomposition.groups().is_some() {
            return self.decomposition.least_pivot();
        }
        let values = self.decomposition.singular_values();
        let across = self.tangent.len().wrapping_sub(2);
        values.get(across).copied().unwrap_or(1.0)
    }

    /// The largest singular value of the Jacobian, 1 of a large one.
    pub fn largest(&self) -> f64 {
        if self.decomposition.groups().is_some() {
            return 1.0;
        }
        let values = self.decomposition.singular_values();
        values.first().copied().unwrap_or(1.0)
    }

    /// True if branches may cross so near that rounding decides which of them the tangent follows.
    pub fn is_beside_a_crossing(&self) -> bool {
        self.least() < SUSPECT * self.largest()
    }

    /// True if branches cross here, as at the places of a [`BranchPoint`](crate::solve::BranchPoint), located to
    /// rounding.
    pub fn is_singular(&self) -> bool {
        self.least() <= SINGULAR_PLACE * self.largest()
    }

    /// Drops the Jacobian, most of the storage; [`Continuation::restored`](super::Continuation::restored) computes it
    /// again.
    pub fn thinned(self) -> Self {
        CurvePoint {
            jacobian: Vec::new(),
            decomposition: Decomposition::of(0, 0, &[]),
            ..self
        }
    }

    /// Reverses the tangent.
    pub fn reversed(mut self) -> Self {
        self.tangent.iter_mut().for_each(|x| *x = -*x);
        self
    }

    /// Turns the tangent to the side of a direction.
    pub fn towards(self, direction: &[f64]) -> Self {
        match dot(&self.tangent, direction) < 0.0 {
            true => self.reversed(),
            false => self,
        }
    }
}
