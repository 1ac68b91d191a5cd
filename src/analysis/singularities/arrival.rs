//! Where Gauss–Newton steps lead to from afar: a place of a locus, or a singular configuration that no
//! curve of others passes through.
//!
//! Where the determinant of the matrix is least or greatest and just vanishes, as for a 5-bar whose
//! cranks part as far as its couplers reach, the locus is a point: there the augmented system loses
//! rank, and the steps come nearer by half each time.

use crate::solve::{Continuation, Place, SolutionCurve};
use crate::system::{LocusCurve, Singular, neared};

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
        point: Singular,
        method: &Continuation,
        wanted: impl Fn(&Singular) -> bool,
    ) -> Option<Arrival> {
        /// The last step, and about as far an isolated point.
        const NEAR: f64 = 1e-3;
        // at a singular point itself the steps are of rounding, and have any length
        let point = neared(curve, point, |size, residual| {
            size < NEAR || residual.iter().all(|r| r.abs() <= method.tolerance)
        })?;
        if let Ok(place) = method.settle(curve, point.clone()) {
            return Some(Arrival::Curve(place));
        }
        if !wanted(&point) {
            return None;
        }
        let found = method.branch_point(curve, &point, 50.0 * NEAR)?;
        let place = found.place(curve, &vec![0.0; curve.unknowns()]);
        found.isolated.then_some(Arrival::Point(place))
    }
}
