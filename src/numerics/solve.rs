//! Newton's method for equations that may be redundant, inconsistent or singular.
//!
//! Nothing here knows joints: a problem offers its residual, a least-squares step and a way to move along it
//! ([`Equations`]), and learns where and why the iteration stopped ([`Stop`]).

mod boxes;
mod branching;
mod continuation;
mod deflation;
mod endgame;
mod homotopy;
mod integrator;
mod least_squares;
mod line_maximum;
mod minimum;
pub mod monodromy;
mod newton;
mod threads;
mod warm;
mod watch;

pub use boxes::{Conditions, Pruned, Pruning, Sides, holds_one, isolated, nearest, prune};
pub use branching::{ALIGNED, BranchPoint};
pub use continuation::{Continuation, CurvePoint, SolutionCurve, StepFailure};
pub use deflation::{deflating_step, step_off_saddle};
pub use endgame::{PathEnd, Turning, path_end};
pub use homotopy::{Arrival, Homotopy, Stages, Track, Tracker};
pub use integrator::{Flow, Integrator, TooShort};
pub use least_squares::{Fitted, LeastSquares, LevenbergMarquardt, Misfit};
pub use line_maximum::{GOLDEN, edge, halved, summit};
pub use minimum::{simplex, walk_down};
pub use newton::{Newton, NewtonReport, Stop};
pub use threads::{Pool, each};
pub use warm::{Trail, Warm, WarmReport};
pub use watch::{Observer, Progress, Stage, Watch};

use crate::number::Field;

/// Equations r(x) = 0 on a manifold, with a least-squares step at a point.
pub trait Equations {
    /// The number of a row or an unknown.
    type Scalar: Field;
    /// A point of the manifold.
    type Point;
    /// Storage for residual, factors and step, so that no iteration allocates.
    type Work;

    /// Evaluates r at a point.
    fn residual(&self, at: &Self::Point, work: &mut Self::Work) -> Size;
    /// Evaluates r and its Jacobian J at a point.
    fn linearise(&self, at: &Self::Point, work: &mut Self::Work) -> Size;
    /// Factorises the Jacobian last evaluated, with rows √λ·I added.
    fn factorise(&self, damping: f64, work: &mut Self::Work);
    /// The step −J⁺r for the residual last evaluated; returns its largest component, infinite if one is not finite.
    fn step(&self, work: &mut Self::Work) -> f64;
    /// The last step in tangent coordinates, to be read or to be replaced by another move.
    fn step_mut<'a>(&self, work: &'a mut Self::Work) -> &'a mut [Self::Scalar];
    /// Moves along a fraction of the last step: from ⊕ fraction·step.
    fn advance(&self, from: &Self::Point, fraction: f64, work: &Self::Work, to: &mut Self::Point);
}

/// Size of a residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// The largest absolute value of a row.
    pub largest: f64,
    /// The sum of squares of the rows.
    pub squares: f64,
}

impl Size {
    /// The size of the given rows. A NaN anywhere gives an infinite size.
    #[inline]
    pub fn of<T: Field>(rows: &[T]) -> Self {
        let (mut largest, mut squares) = (0.0, 0.0f64);
        for row in rows {
            let square = row.norm_squared();
            squares += square;
            // one instruction, where `max` has six for what is not a number
            largest = if square > largest { square } else { largest };
        }
        // a NaN among the largest may have been passed over, in the sum it is not
        if squares.is_finite() {
            Size {
                largest: largest.sqrt(),
                squares,
            }
        } else {
            Size {
                largest: f64::INFINITY,
                squares: f64::INFINITY,
            }
        }
    }
}
