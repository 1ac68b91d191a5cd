//! Where Gauss–Newton steps lead to from afar: a place of a locus, or a singular configuration that no
//! curve of others passes through.
//!
//! Where the determinant of the matrix is least or greatest and just vanishes, as for a 5-bar whose
//! cranks part as far as its couplers reach, the locus is a point: there the augmented system loses
//! rank, and the steps come nearer by half each time.

use crate::linear::{Decomposition, norm};
use crate::solve::{Continuation, Place, SolutionCurve};
use crate::system::{LocusCurve, Singular};

/// What steps lead to.
pub(super) enum Arrival {
    /// A place of a curve.
    Curve(Place<Singular>),
    /// A point through which nothing passes. The place has a tangent of no meaning.
    Point(Place<Singular>),
}

impl Arrival {
    /// From a configuration and motion, by steps of bounded length. Isolated points, which take longer
    /// to locate, are sought only where one is `wanted`.
    pub fn from(
        curve: &mut LocusCurve,
        mut point: Singular,
        method: &Continuation,
        wanted: impl Fn(&Singular) -> bool,
    ) -> Option<Arrival> {
        const STEPS: usize = 40;
        const LONGEST: f64 = 0.5;
        /// The last step, and about as far an isolated point.
        const NEAR: f64 = 1e-3;
        let unknowns = curve.unknowns();
        let regular = unknowns.saturating_sub(1);
        for _ in 0..STEPS {
            let (residual, jacobian) = curve.linearise(&point);
            if !jacobian.iter().chain(&residual).all(|x| x.is_finite()) {
                return None;
            }
            let decomposition =
                Decomposition::of_rank(residual.len(), unknowns, &jacobian, regular);
            let mut step = decomposition.solve(&residual);
            let size = norm(&step);
            // at a singular point itself the steps are of rounding, and have any length
            let there = residual.iter().all(|r| r.abs() <= method.tolerance);
            if size < NEAR || there {
                if let Ok(place) = method.settle(curve, point.clone()) {
                    return Some(Arrival::Curve(place));
                }
                if !wanted(&point) {
                    return None;
                }
                let found = method.branch_point(curve, &point, 50.0 * NEAR)?;
                let nowhere = vec![0.0; unknowns];
                let place = found.place(curve, &nowhere);
                return found.isolated.then_some(Arrival::Point(place));
            }
            let factor = (LONGEST / size).min(1.0);
            step.iter_mut().for_each(|x| *x *= -factor);
            point = curve.displaced(&point, &step);
        }
        None
    }
}
