//! One path, tracked to s = 1, and the classification of its endpoint.

use nalgebra::{DMatrix, DVector};

use super::along::polish;
use super::homotopy::{END, FAR, ParameterHomotopy, START};
use super::local::Local;
use super::simple::{are_one, stands_alone};
use crate::analysis::assemblies::family::{C, size};
use crate::number::tolerance::{DIFFERENCE, EXACT, SAME};
use crate::number::{Number, complex, real};
use crate::solve::{
    Arrival, Homotopy, Newton, PathEnd, Progress, Stages, Tracker, Watch, path_end,
};

/// Endpoint of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum End {
    /// A simple isolated solution.
    Regular(Vec<C>),
    /// A solution where several meet, or that is not isolated.
    Singular(Vec<C>),
    /// One of two regular solutions too near each other to tell which; another path ends at the other.
    Either([Vec<C>; 2]),
    Infinite,
    /// Far out on its way; it may come back.
    Gone,
    Lost,
}

impl End {
    /// The solution, if it is finite.
    pub fn point(&self) -> Option<&Vec<C>> {
        match self {
            End::Regular(x) | End::Singular(x) => Some(x),
            _ => None,
        }
    }
}

/// Radius 1 − s at which the endgame starts.
const NEAR_END: f64 = 0.03;

/// A tracked path.
#[derive(Clone)]
pub(crate) struct Path {
    pub end: End,
    pub steps: usize,
}

/// Tracks one path along an arc through complex s, bent to the side by `bend`.
pub(crate) fn follow(
    homotopy: &mut ParameterHomotopy<'_>,
    tracker: &Tracker,
    bend: f64,
    from: &[C],
    watch: (&Watch, Progress),
) -> Path {
    let mut stages = Stages::new(from.len(), watch);
    let mut steps = 0;
    let (mut x, mut here) = (from.to_vec(), START);
    let mut leg = |homotopy: &mut ParameterHomotopy<'_>,
                   x: &mut [C],
                   stages: &mut Stages<'_>,
                   (a, b): (C, C)| {
        let track = tracker.track(homotopy, (a, b), x, stages);
        steps += track.steps;
        track.arrival
    };
    // segments longer than ten rad or characteristic lengths are tracked in parts, each ten times as long as all before it
    let decades = real::log10(homotopy.length() / 10.0)
        .ceil()
        .clamp(0.0, 12.0) as i32;
    let mut corners: Vec<C> = (1..=decades)
        .rev()
        .map(|k| C::new(1.0, bend) * 0.1f64.powi(k))
        .collect();
    if bend != 0.0 {
        corners.extend([C::new(0.3, bend), C::new(0.8, bend)]);
    }
    let mut arrival = Arrival::There;
    for corner in corners {
        if arrival == Arrival::There {
            arrival = leg(homotopy, &mut x, &mut stages, (here, corner));
            here = corner;
        }
    }
    let far = FAR * homotopy.reach();
    let mut found = None;
    if arrival == Arrival::There {
        let corner = x.clone();
        if leg(homotopy, &mut x, &mut stages, (here, END)) == Arrival::There {
            found = arrived(homotopy, &x);
        }
        if found.is_none() {
            // not regular: Cauchy endgame
            x = corner;
            let short = C::from_f64(1.0 - NEAR_END);
            arrival = leg(homotopy, &mut x, &mut stages, (here, short));
        }
    }
    let end = found.unwrap_or_else(|| match arrival {
        Arrival::There => go_round(homotopy, tracker, far, &x, &mut stages),
        Arrival::Diverged(_) => End::Gone,
        // beyond this rounding may stop a path
        Arrival::Stuck(_) if homotopy.extent(&x) > if decades > 0 { FAR } else { far } => End::Gone,
        Arrival::Stuck(_) => End::Lost,
    });
    Path { end, steps }
}

/// The regular endpoint that a point is at; `None` if there is none, or it is too far out.
pub(crate) fn arrived(homotopy: &mut ParameterHomotopy<'_>, x: &[C]) -> Option<End> {
    let mut x = x.to_vec();
    (size(&x) <= FAR * homotopy.reach() && settles(homotopy, &mut x)).then_some(End::Regular(x))
}

/// True if Newton's method converges quadratically to a simple solution.
fn settles(homotopy: &mut ParameterHomotopy<'_>, x: &mut [C]) -> bool {
    polish(homotopy, END, x) && stands_alone(homotopy, END, x)
}

/// The two simple solutions beside a point where they seem to coincide: the roots t of
/// w·h + t w·Jv + ½ t² w·(v·∇)Jv for null vectors v and w of J at rank n − 1.
fn parted(homotopy: &mut ParameterHomotopy<'_>, x: &[C]) -> Option<[Vec<C>; 2]> {
    const REACH: f64 = 1e-3;
    let (residual, jacobian) = homotopy.evaluated(END, x);
    let (rows, columns) = (residual.len(), homotopy.unknowns());
    if columns == 0 || rows < columns {
        return None;
    }
    let matrix = |entries: Vec<C>| DMatrix::from_vec(rows, columns, entries);
    let svd = matrix(jacobian).svd(true, true);
    let (left, right) = (svd.u?, svd.v_t?);
    let last = svd.singular_values.imin();
    let w = left.column(last).conjugate();
    let v: Vec<C> = right.row(last).iter().map(|z| z.conj()).collect();
    let ahead = |length: C| v.iter().map(|v| v * length).collect::<Vec<C>>();
    let mut slope = |length: f64| {
        let at = homotopy.moved(END, x, &ahead(C::from_f64(length)));
        let (_, jacobian) = homotopy.evaluated(END, &at);
        w.dot(&(matrix(jacobian) * DVector::from_column_slice(&v)))
    };
    let (after, before) = (slope(DIFFERENCE), slope(-DIFFERENCE));
    let bent = (after - before) / (2.0 * DIFFERENCE);
    let along = (after + before) * 0.5;
    let left = w.dot(&DVector::from_vec(residual));
    let root = Number::sqrt(along * along - bent * left * 2.0);
    let mut both = [1.0, -1.0].map(|sign| {
        let length = (root * sign - along) / bent;
        let near = length.is_finite() && complex::norm(length) < REACH;
        near.then(|| homotopy.moved(END, x, &ahead(length)))
    });
    let [Some(a), Some(b)] = &mut both else {
        return None;
    };
    let apart = settles(homotopy, a) && settles(homotopy, b) && !are_one(homotopy, END, a, b);
    let near = |y: &[C]| homotopy.family.coordinates.difference(x, y) < 2.0 * REACH;
    (apart && near(a) && near(b)).then(|| [a.clone(), b.clone()])
}

fn go_round(
    homotopy: &mut ParameterHomotopy<'_>,
    tracker: &Tracker,
    far: f64,
    x: &[C],
    stages: &mut Stages<'_>,
) -> End {
    match path_end(homotopy, tracker, x, NEAR_END, stages) {
        PathEnd::Finite { mut x, winding } => {
            homotopy.family.coordinates.settle(&mut x);
            let mut refined = x.clone();
            let near = |homotopy: &ParameterHomotopy<'_>, y: &[C]| {
                homotopy.family.coordinates.difference(&x, y) < SAME * size(y).max(1.0)
            };
            if winding == 1
                && settles(homotopy, &mut refined)
                && near(homotopy, &refined)
                && size(&refined) <= far
            {
                return End::Regular(refined);
            }
            if size(&x) > far {
                return End::Infinite;
            }
            if let Some(both) = parted(homotopy, &x) {
                return End::Either(both);
            }
            // what Newton's method calls solved; where more is left solutions pass each other
            let meeting = Newton::default().tolerance.max(EXACT * size(&x).powi(2));
            let x = Local::new(homotopy, false).refined(&x);
            match homotopy.residual(END, &x) <= meeting {
                true => End::Singular(x),
                false => End::Lost,
            }
        }
        PathEnd::Infinite => End::Infinite,
        PathEnd::Undecided { x } if homotopy.extent(&x) > far => End::Infinite,
        PathEnd::Undecided { .. } => End::Lost,
    }
}
