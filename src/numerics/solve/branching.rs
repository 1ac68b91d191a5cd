//! Points where branches of a curve of solutions cross: there the Jacobian loses rank.

use super::continuation::{Continuation, CurvePoint, SolutionCurve, back};
use crate::linear::{Decomposition, RANK_TOLERANCE, SINGULAR_PLACE, SUSPECT, dot, norm, product};
use crate::number::tolerance::DIFFERENCE;
use crate::number::{real, sorting::sort_by};

/// A point where the Jacobian of a curve loses rank.
#[derive(Clone, Debug)]
pub struct BranchPoint<P> {
    /// The point.
    pub at: P,
    /// Dimension of the null space of the Jacobian: 2 or more.
    pub freedoms: usize,
    /// Unit tangents of the branches that pass, each once; none if no branch could be distinguished.
    pub directions: Vec<Vec<f64>>,
    /// True for an isolated point: no direction leads on to second order, and no other solution is near.
    pub isolated: bool,
}

impl<P> BranchPoint<P> {
    /// The direction of the branch straight on along the tangent at a place from which `step` leads here, if ahead.
    pub fn straight_on(&self, step: &[f64], tangent: &[f64]) -> Option<Vec<f64>> {
        if dot(step, tangent) < 0.9 * norm(step) {
            return None;
        }
        let along = |d: &Vec<f64>| dot(d, tangent);
        let best =
            (self.directions.iter()).max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()));
        let straight = best.filter(|d| along(d).abs() > 0.9)?;
        let sign = along(straight).signum();
        Some(straight.iter().map(|x| sign * x).collect())
    }
}

/// Least cosine of the angle between the tangents of one branch on the two sides of a crossing.
pub const ALIGNED: f64 = 0.98;

impl Continuation {
    /// The branch point near a point, by Newton's method on the augmented system
    ///
    /// F(x) = 0, wᵢᵀ J(x) vⱼ = 0
    ///
    /// for bases w and v of the null spaces that the point has with k singular values fewer, renewed in every step;
    /// all of these equations hold at a branch point. `None` if there is none within `reach`, or the Jacobian is
    /// large.
    ///
    /// Source: Griewank and Reddien 1984 (borders); Leykin, Verschelde and Zhao 2006 (deflation).
    pub fn branch_point<C: SolutionCurve>(
        &self,
        curve: &mut C,
        near: &C::Point,
        reach: f64,
    ) -> Option<BranchPoint<C::Point>> {
        // of a large Jacobian the left null space, which has a vector for each redundant row, is not known
        if curve.linearise_groups(near).is_some() {
            return None;
        }
        let unknowns = curve.unknowns();
        (1..unknowns).take(4).find_map(|lost| {
            let found = self.rank_drop(curve, near, reach, lost)?;
            // of higher order, where Newton's method was slow and its end uncertain
            let free = freedoms(curve, &found);
            (free == lost + 1).then(|| self.described(curve, found, free))
        })
    }

    fn rank_drop<C: SolutionCurve>(
        &self,
        curve: &mut C,
        near: &C::Point,
        reach: f64,
        lost: usize,
    ) -> Option<C::Point> {
        const STEPS: usize = 25;
        let unknowns = curve.unknowns();
        let regular = unknowns.checked_sub(1 + lost)?;
        let mut at = near.clone();
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let (residual, jacobian) = curve.linearise(&at);
            let rows = residual.len();
            let here = Decomposition::of_rank(rows, unknowns, &jacobian, regular);
            let (left, right) = (here.left_null_space(), here.null_space());
            let values = here.singular_values();
            let defect = values.get(regular).copied().unwrap_or(0.0);
            // rows of the augmented matrix, with what they are to become zero
            let mut matrix: Vec<Vec<f64>> = Vec::new();
            let mut wanted = residual.clone();
            for i in 0..rows {
                matrix.push((0..unknowns).map(|j| jacobian[j * rows + i]).collect());
            }
            for v in &right {
                let bent = bent(curve, &at, v);
                let along = product(&jacobian, rows, v);
                for w in &left {
                    matrix.push((bent.chunks_exact(rows.max(1)).map(|c| dot(w, c))).collect());
                    wanted.push(dot(w, &along));
                }
            }
            let augmented = decomposed(&matrix, unknowns);
            let step = back(&augmented, &wanted);
            let size = norm(&step);
            let largest = residual.iter().fold(0.0f64, |m, r| m.max(r.abs()));
            let there = largest <= self.tolerance
                && defect <= SINGULAR_PLACE * values.first().map_or(1.0, |v| v.max(SINGULAR_PLACE));
            if there && (size < 1e-14 || size >= 0.5 * before) {
                let gone = norm(&curve.difference(near, &at));
                return (gone <= reach).then_some(at);
            }
            if !size.is_finite() || size > 2.0 * reach {
                return None;
            }
            before = size;
            at = curve.displaced(&at, &step);
        }
        None
    }

    fn described<C: SolutionCurve>(
        &self,
        curve: &mut C,
        at: C::Point,
        freedoms: usize,
    ) -> BranchPoint<C::Point> {
        let unknowns = curve.unknowns();
        let (residual, jacobian) = curve.linearise(&at);
        let rows = residual.len();
        let here = Decomposition::of_rank(rows, unknowns, &jacobian, unknowns - freedoms);
        let (left, right) = (here.left_null_space(), here.null_space());
        let forms = forms(curve, &at, &left, &right);
        let zeros = zeros(&forms, right.len());
        let isolated = zeros.is_empty() && forms.iter().any(|form| norm(form) > RANK_TOLERANCE);
        let basis = right.concat();
        let directions = zeros
            .iter()
            .map(|weights| product(&basis, unknowns, weights));
        let mut leaves = |direction: &Vec<f64>| self.leave(curve, &at, direction).is_some();
        let found = directions.filter(|direction| leaves(direction)).collect();
        BranchPoint {
            at,
            freedoms,
            directions: found,
            isolated,
        }
    }

    /// A regular place a little way along one of a branch point's directions, with the distance, if one is there.
    pub fn leave<C: SolutionCurve>(
        &self,
        curve: &mut C,
        from: &C::Point,
        direction: &[f64],
    ) -> Option<(CurvePoint<C::Point>, f64)> {
        let mut length = 0.2 * self.longest;
        for _ in 0..8 {
            let ahead: Vec<f64> = direction.iter().map(|x| x * length).collect();
            let start = curve.displaced(from, &ahead);
            if let Ok(place) = self.settle(curve, start) {
                let place = place.towards(direction);
                let gone = curve.difference(from, &place.at);
                let (along, gone) = (dot(&gone, direction), norm(&gone));
                let straight = along >= ALIGNED * gone && gone >= 0.5 * length;
                if straight && dot(&place.tangent, direction) >= ALIGNED {
                    return Some((place, gone));
                }
            }
            length *= 0.35;
        }
        None
    }
}

impl<P: Clone> BranchPoint<P> {
    /// The point as a place of the branch along a direction: for bracketing only, as its Jacobian is singular.
    pub fn place<C: SolutionCurve<Point = P>>(
        &self,
        curve: &mut C,
        direction: &[f64],
    ) -> CurvePoint<P> {
        let (residual, jacobian) = curve.linearise(&self.at);
        let (rows, unknowns) = (residual.len(), direction.len());
        let regular = unknowns.saturating_sub(self.freedoms);
        CurvePoint {
            at: self.at.clone(),
            tangent: direction.to_vec(),
            decomposition: Decomposition::of_rank(rows, unknowns, &jacobian, regular),
            jacobian,
        }
    }
}

/// Number of singular values near zero, those of missing rows counted.
fn freedoms<C: SolutionCurve>(curve: &mut C, at: &C::Point) -> usize {
    let unknowns = curve.unknowns();
    let (residual, jacobian) = curve.linearise(at);
    let here = Decomposition::of(residual.len(), unknowns, &jacobian);
    let values = here.singular_values();
    let least = SUSPECT * values.first().copied().unwrap_or(0.0);
    unknowns - values.iter().take_while(|value| **value > least).count()
}

/// dJ along v, column-major, by central differences.
fn bent<C: SolutionCurve>(curve: &mut C, at: &C::Point, v: &[f64]) -> Vec<f64> {
    let mut side = |h: f64| {
        let step: Vec<f64> = v.iter().map(|x| x * h).collect();
        let at = curve.displaced(at, &step);
        curve.linearise(&at).1
    };
    let (after, before) = (side(DIFFERENCE), side(-DIFFERENCE));
    let both = after.iter().zip(&before);
    both.map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
}

/// The decomposition of a matrix given by its rows.
fn decomposed(rows: &[Vec<f64>], columns: usize) -> Decomposition {
    let columns_of = (0..columns).flat_map(|j| rows.iter().map(move |row| row[j]));
    let entries: Vec<f64> = columns_of.collect();
    Decomposition::of(rows.len(), columns, &entries)
}

/// For every left null vector w the symmetric form wᵀ H(vᵢ, vⱼ), row after row.
fn forms<C: SolutionCurve>(
    curve: &mut C,
    at: &C::Point,
    left: &[Vec<f64>],
    right: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let n = right.len();
    let mut forms = vec![vec![0.0; n * n]; left.len()];
    for (i, v) in right.iter().enumerate() {
        let bent = bent(curve, at, v);
        let rows = bent.len() / curve.unknowns();
        for (j, u) in right.iter().enumerate() {
            let along = product(&bent, rows, u);
            for (form, w) in forms.iter_mut().zip(left) {
                let half = 0.5 * dot(w, &along);
                form[i * n + j] += half;
                form[j * n + i] += half;
            }
        }
    }
    forms
}

/// Isolated unit vectors on which all forms vanish, up to their sign: Newton's method from all over the sphere.
fn zeros(forms: &[Vec<f64>], n: usize) -> Vec<Vec<f64>> {
    let largest = forms.iter().map(|form| norm(form)).fold(0.0, f64::max);
    let counts = |form: &&Vec<f64>| norm(form) > RANK_TOLERANCE.max(SUSPECT * largest);
    let forms: Vec<&Vec<f64>> = forms.iter().filter(counts).collect();
    if forms.is_empty() || n < 2 {
        return Vec::new();
    }
    let slope = |form: &[f64], a: &[f64]| -> Vec<f64> {
        form.chunks_exact(n).map(|row| 2.0 * dot(row, a)).collect()
    };
    let starts = match n {
        2 => 32,
        _ => 150 * (n - 1),
    };
    let mut found: Vec<Vec<f64>> = Vec::new();
    for k in 0..starts {
        let mut a: Vec<f64> = match n {
            2 => {
                let angle = std::f64::consts::PI * k as f64 / f64::from(starts as u32);
                vec![real::cos(angle), real::sin(angle)]
            }
            _ => (0..n)
                .map(|i| real::sin(12.9898 * (k * n + i + 1) as f64) * 43758.5453 % 1.0)
                .collect(),
        };
        let mut best = f64::INFINITY;
        for _ in 0..40 {
            let size = norm(&a);
            a.iter_mut().for_each(|x| *x /= size);
            // the forms, and a·da = 0
            let mut rows: Vec<Vec<f64>> = forms.iter().map(|form| slope(form, &a)).collect();
            let mut values: Vec<f64> = rows.iter().map(|row| 0.5 * dot(row, &a)).collect();
            best = norm(&values) / largest;
            rows.push(a.clone());
            values.push(0.0);
            let step = decomposed(&rows, n).solve(&values);
            a.iter_mut().zip(&step).for_each(|(a, s)| *a -= s);
            if norm(&step) < 1e-15 {
                break;
            }
        }
        let size = norm(&a);
        a.iter_mut().for_each(|x| *x /= size);
        let new = found.iter().all(|b| dot(&a, b).abs() < 1.0 - 1e-8);
        if best < RANK_TOLERANCE && new && a.iter().all(|x| x.is_finite()) {
            found.push(a);
        }
    }
    for a in &mut found {
        let first = a.iter().copied().find(|x| x.abs() > SINGULAR_PLACE);
        if first.is_some_and(|x| x < 0.0) {
            a.iter_mut().for_each(|x| *x = -*x);
        }
    }
    sort_by(&mut found, |a, b| {
        b.partial_cmp(a).unwrap_or(std::cmp::Ordering::Equal)
    });
    found
}
