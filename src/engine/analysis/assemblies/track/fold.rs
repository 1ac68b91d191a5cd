//! Turning points of a real path, to full precision.

use super::homotopy::ParameterHomotopy;
use crate::analysis::assemblies::family::C;
use crate::linear::{Decomposition, dot, norm};
use crate::number::Number;
use crate::number::tolerance::DIFFERENCE;

/// A point of a homotopy where the Jacobian is singular.
pub(crate) struct Meeting {
    pub s: f64,
    pub x: Vec<C>,
    /// True at a turning point, beyond which the solutions are complex; false where they cross.
    pub turns_back: bool,
}

/// Residual and Jacobian J of a real point, column-major.
fn linear(homotopy: &mut ParameterHomotopy<'_>, s: f64, x: &[C]) -> (Vec<f64>, Vec<f64>) {
    let (residual, jacobian) = homotopy.evaluated(C::from_f64(s), x);
    let real = |all: Vec<C>| all.into_iter().map(|z| z.re).collect();
    (real(residual), real(jacobian))
}

/// The central difference.
fn slope(after: &[f64], before: &[f64]) -> Vec<f64> {
    let pairs = after.iter().zip(before);
    pairs.map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
}

/// The singular point near a real point of a path, by Newton's method for x and s on h(x, s) = 0 and
/// wᵢᵀ J(x, s) v = 0, with null vectors v and w of J at rank n − 1, renewed in every step (Griewank and
/// Reddien 1984). `None` if there is none nearby.
pub(crate) fn located(
    homotopy: &mut ParameterHomotopy<'_>,
    mut s: f64,
    x: &[C],
) -> Option<Meeting> {
    const STEPS: usize = 25;
    let unknowns = homotopy.unknowns();
    let regular = unknowns.checked_sub(1)?;
    let mut x = x.to_vec();
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let (residual, jacobian) = linear(homotopy, s, &x);
        let rows = residual.len();
        if rows == 0 {
            return None;
        }
        let here = Decomposition::of_rank(rows, unknowns, &jacobian, regular);
        let v = here.null_space().pop()?;
        let left = here.left_null_space();
        let later = linear(homotopy, s + DIFFERENCE, &x);
        let earlier = linear(homotopy, s - DIFFERENCE, &x);
        let rate = slope(&later.0, &earlier.0);
        let mut ahead = |length: f64| {
            let step: Vec<C> = v.iter().map(|v| C::from_f64(v * length)).collect();
            let at = homotopy.moved(C::from_f64(s), &x, &step);
            linear(homotopy, s, &at).1
        };
        let bent = slope(&ahead(DIFFERENCE), &ahead(-DIFFERENCE));
        let swept = slope(&later.1, &earlier.1);
        let times = |matrix: &[f64]| -> Vec<f64> {
            let columns = || matrix.chunks_exact(rows);
            let row = |r: usize| columns().zip(&v).map(|(column, v)| column[r] * v).sum();
            (0..rows).map(row).collect()
        };
        let (along, swept) = (times(&jacobian), times(&swept));
        // columns of the unknowns, then that of s
        let column = |entries: &[f64], of_left: &dyn Fn(&[f64]) -> f64| -> Vec<f64> {
            let below = left.iter().map(|w| of_left(w));
            entries.iter().copied().chain(below).collect()
        };
        let mut entries = Vec::new();
        for (j, bent) in jacobian.chunks_exact(rows).zip(bent.chunks_exact(rows)) {
            entries.extend(column(j, &|w| dot(w, bent)));
        }
        entries.extend(column(&rate, &|w| dot(w, &swept)));
        let wanted = column(&residual, &|w| dot(w, &along));
        let step = Decomposition::of(wanted.len(), unknowns + 1, &entries).solve(&wanted);
        let length = norm(&step);
        // a point farther away is not that of the path
        if !length.is_finite() || length > 0.05 {
            return None;
        }
        if length < 1e-14 || length >= 0.5 * before && length < 1e-9 {
            let held = left.iter().map(|w| dot(w, &rate).abs()).fold(0.0, f64::max);
            return Some(Meeting {
                s,
                x,
                turns_back: held > 1e-6 * norm(&rate),
            });
        }
        before = length;
        let shift: Vec<C> = (step[..unknowns].iter()).map(|d| C::from_f64(-d)).collect();
        x = homotopy.moved(C::from_f64(s), &x, &shift);
        s -= step[unknowns];
    }
    None
}
