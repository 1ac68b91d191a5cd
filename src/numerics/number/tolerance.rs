//! Tolerances: one number for one question, wherever it is asked.
//!
//! All are relative or dimensionless: rows and unknowns are in rad and characteristic lengths. A number that belongs to one
//! algorithm, as the length of its steps, stands beside it.

/// A residual of exact values: some units of the last place of a sum of numbers near 1.
pub const EXACT: f64 = 1e-15;

/// Rounding left by a sum of numbers about 1 that cancel: entries of dimensionless matrices this small are zero.
pub const CANCELLED: f64 = 1e-14;

/// Rounding of a longer sum, relative to its terms.
pub const SUMMED: f64 = 1e-13;

/// The largest row of solved equations, and the rounding of singular values and of sums of squares: a condition number beyond
/// the inverse of this has no digit.
pub const SOLVED: f64 = 1e-12;

/// Numbers of files and answers, in SI units or relative to the largest, below this are the rounding of a zero.
pub const WRITTEN_ZERO: f64 = 1e-12;

/// A change that no printed digit shows.
pub const NOT_PRINTED: f64 = 1e-10;

/// Rounding at a solved configuration: gaps, rates, angles and excesses over a bound this small are zero. It is what
/// [`SOLVED`] leaves with condition numbers up to a thousand.
pub const ROUNDING: f64 = 1e-9;

/// The part of the largest singular value below which a place of a curve is singular: places are located to rounding, so
/// a crossing of branches is distinguished from a regular place by less than [`RANK_TOLERANCE`].
pub const SINGULAR_PLACE: f64 = 1e-9;

/// The one rank tolerance of the program: a singular value counts as zero when it is this small relative to the
/// largest.
///
/// Jacobians are dimensionless, and at a double solution a closure residual of 1e-14 leaves the joints uncertain by its
/// square root.
pub const RANK_TOLERANCE: f64 = 1e-7;

/// Two configurations, points, values or directions nearer than this are one, and a joint as near to its limit is at it.
pub const SAME: f64 = 1e-6;

/// Components of a motion of unit norm, in rad and characteristic lengths, below this are rounding: a null space is known
/// to about [`RANK_TOLERANCE`], with a digit to spare.
pub const STILL: f64 = 1e-6;

/// The part of a row that Gram–Schmidt must leave for it to be chosen as independent: stricter than the rank tolerance.
pub const INDEPENDENT: f64 = 1e-6;

/// A curvature counts as negative from this part of the largest on: it is taken by differences.
pub const CURVED: f64 = 1e-6;

/// The error of solutions at which equations only touch zero: half of the digits are known.
pub const DOUBLE: f64 = 1e-5;

/// Singular values as small, relative to the largest, may vanish at a solution near by: at one that is known to half its
/// digits, or at a crossing of curves, whose branches the tangent does not distinguish there.
pub const SUSPECT: f64 = 1e-5;

/// The step of central differences of first derivatives, in rad and characteristic lengths: their error, of second order,
/// is about as large as that of rounding.
pub const DIFFERENCE: f64 = 1e-5;

/// Steps h, in rad and characteristic lengths, and weights w of the derivative f′ ≈ Σ w f(x + h) by five points: its error, of
/// fourth order, is about as large as that of rounding.
pub const FIVE_POINTS: [(f64, f64); 4] = [
    (-2e-3, 1.0 / 12e-3),
    (-1e-3, -8.0 / 12e-3),
    (1e-3, 8.0 / 12e-3),
    (2e-3, -1.0 / 12e-3),
];

/// The longest step to a solution near by, in rad and characteristic lengths: a longer one may lead to another branch, and
/// its ends do not tell what is between them.
pub const LONGEST_STEP: f64 = 0.5;
