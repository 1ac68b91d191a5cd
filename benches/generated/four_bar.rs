//! 4-bar, broken at joint 3
//!
//! Solver written by linkwork 0.1.0.
//!
//! Inputs, what is held:
//!      0  theta1, rad
//!
//! State, what is found:
//!      0  phi2, rad
//!      1  phi1, rad
//!
//! [`solve`] finds the state for inputs, from a state near it; [`Follower::solve`] does the same with a
//! start extrapolated from the last move. Nothing is allocated, and no library is needed.

#![allow(clippy::all, unused, non_snake_case)]

/// What a search came to. But for the first two the state is left as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every closure equation holds to [`TOLERANCE`], or to [`ROUNDING`] where rounding allows no more.
    Solved,
    /// The same, but the configuration is singular or next to one: the state is known to about half the
    /// digits, and something moves although the inputs are held.
    Singular,
    /// The closures cannot be closed near the start.
    NotAssembled,
    /// Neither was reached in the steps that are allowed.
    StepLimit,
    /// A number is not finite, or beyond 1e5.
    BadInput,
}

pub const INPUTS: usize = 1;
pub const STATE: usize = 2;
pub const UNKNOWNS: usize = 2;
pub const ROWS: usize = 2;
pub const FRAMES: usize = 0;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The same where a step makes it no smaller.
pub const ROUNDING: f64 = 1e-12;

/// Inputs of the assembled configuration at which the order of elimination was chosen.
pub const START_INPUTS: [f64; INPUTS] = [
    0.0,
];
/// Its state.
pub const START_STATE: [f64; STATE] = [
    1.0471975511965979, 1.714143895700262,
];

#[inline(always)]
fn absolute(x: f64) -> f64 {
    if x < 0.0 { -x } else { x }
}

/// The larger of a size and |x|; NaN if x is.
#[inline(always)]
fn larger(size: f64, x: f64) -> f64 {
    let x = absolute(x);
    if size > x { size } else { x }
}

/// √x for x ≥ 0: by its series near 1, where quaternions are, otherwise by Newton's method for 1/√x.
#[inline]
fn root(x: f64) -> f64 {
    let e = x - 1.0;
    if absolute(e) < 1e-4 {
        return 1.0 + e * (0.5 - e * (0.125 - e * 0.0625));
    }
    if !(x > 0.0) {
        return 0.0;
    }
    let mut y: f64 = f64::from_bits(0x5fe6_eb50_c7b5_37a9 - (x.to_bits() >> 1));
    let mut k = 0;
    while k < 4 {
        y = y * (1.5 - 0.5 * x * y * y);
        k += 1;
    }
    let s = x * y;
    s + 0.5 * y * (x - s * s)
}

/// Sine and cosine, |x| < 1e5: reduction by quarter turns (Cody and Waite 1980), then polynomials
/// (fdlibm, Sun 1993).
#[inline(always)]
fn sine_cosine(x: f64) -> (f64, f64) {
    // adding 3·2ⁿ rounds to the nearest integer and leaves it in the lowest bits
    let shifted: f64 = x * 0.6366197723675814 + 6755399441055744.0;
    let quarter = shifted.to_bits();
    let k = shifted - 6755399441055744.0;
    let r: f64 = ((x - k * 1.5707963267341256) - k * 6.077100506303966e-11) - k * 2.0222662487959506e-21;
    let z: f64 = r * r;
    let w: f64 = z * z;
    let s: f64 = r + r * z * (((-0.16666666666666632) + z * 0.00833333333332249) + w * (((-0.0001984126982985795) + z * 2.7557313707070068e-6) + w * ((-2.5050760253406863e-8) + z * 1.58969099521155e-10)));
    let c: f64 = (1.0 - 0.5 * z) + w * ((0.0416666666666666 + z * (-0.001388888888887411)) + w * ((2.480158728947673e-5 + z * (-2.7557314351390663e-7)) + w * (2.087572321298175e-9 + z * (-1.1359647557788195e-11))));
    let (first, second) = if quarter & 1 == 1 { (c, s) } else { (s, c) };
    (
        if quarter & 2 == 2 { -first } else { first },
        if quarter.wrapping_add(1) & 2 == 2 { -second } else { second },
    )
}

/// Sine and cosine after a further turn, one of several of which the longest is known.
#[inline(always)]
fn turn(by: f64, longest: f64, sine: &mut f64, cosine: &mut f64) {
    let (s, c) = (*sine, *cosine);
    let (sin_by, versine) = if longest < 0.015625 {
        let z = by * by;
        (
            by - by * z * (1.0 / 6.0 - z * (1.0 / 120.0)),
            z * (0.5 - z * (1.0 / 24.0 - z * (1.0 / 720.0))),
        )
    } else {
        let (sin_by, cos_by) = sine_cosine(by);
        (sin_by, 1.0 - cos_by)
    };
    *sine = s - (s * versine - c * sin_by);
    *cosine = c - (c * versine + s * sin_by);
}

/// The closure rows r, dimensionless, and their Jacobian by a dimensionless step of the unknowns.
fn linearise(
    u: &[f64; INPUTS],
    x: &[f64; STATE],
    r: &mut [f64; ROWS],
    j: &mut [[f64; UNKNOWNS]; ROWS],
) {
    let u0: f64 = u[0];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let (t9, t10) = sine_cosine(u0);
    let t12: f64 = 2.0 * t10;
    let t13: f64 = 2.0 * t9;
    let (t14, t15) = sine_cosine(x0);
    let t16: f64 = t10 * t15;
    let t17: f64 = t9 * t15;
    let t18: f64 = t9 * t14;
    let t20: f64 = t10 * t14;
    let t21: f64 = t16 - t18;
    let t22: f64 = t17 + t20;
    let t25: f64 = 4.0 * t21;
    let t26: f64 = 4.0 * t22;
    let t27: f64 = t12 + t25;
    let t28: f64 = t13 + t26;
    let (t29, t30) = sine_cosine(x1);
    let t32: f64 = 3.5 * t30;
    let t33: f64 = 3.5 * t29;
    let t34: f64 = 4.5 + t32;
    let t35: f64 = t34 - t27;
    let t36: f64 = t33 - t28;
    let t38: f64 = 0.2222222222222222 * t35;
    let t39: f64 = 0.2222222222222222 * t36;
    let t49: f64 = (-0.8888888888888888) * t22;
    let t50: f64 = -t49;
    let t51: f64 = (-0.8888888888888888) * t21;
    let t55: f64 = 0.7777777777777777 * t29;
    let t56: f64 = -t55;
    let t57: f64 = 0.7777777777777777 * t30;
    r[0] = t38;
    r[1] = t39;
    j[0][0] = t50;
    j[0][1] = t56;
    j[1][0] = t51;
    j[1][1] = t57;
}

/// The state x moved by a step d.
fn displace(x: &[f64; STATE], d: &[f64; UNKNOWNS], y: &mut [f64; STATE]) {
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let d0: f64 = d[0];
    let d1: f64 = d[1];
    let t101: f64 = x0 + d0;
    let t102: f64 = x1 + d1;
    y[0] = t101;
    y[1] = t102;
}

/// Unit quaternions again after a small change.
#[inline(always)]
fn normalise(x: &mut [f64; STATE]) {
}

/// Newton's method with the order of elimination chosen beforehand; false, and x as it was, where a
/// pivot is small or a step does not halve the rows.
#[inline]
fn fast(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> bool {
    const LEAST_PIVOT: f64 = 1e-4;
    const LONGEST_STEP: f64 = 0.5;
    const LARGE: f64 = 1e30;
    const HALF: f64 = 0.5;
    const MOST_STEPS: usize = 12;
    let u0: f64 = u[0];
    let (t9, t10) = sine_cosine(u0);
    let t12: f64 = 2.0 * t10;
    let t13: f64 = 2.0 * t9;
    let mut x0: f64 = x[0];
    let mut x1: f64 = x[1];
    let (mut s0, mut c0) = sine_cosine(x0);
    let (mut s1, mut c1) = sine_cosine(x1);
    let mut last: f64 = LARGE;
    for _ in 0..MOST_STEPS {
        let t16: f64 = t10 * c0;
        let t17: f64 = t9 * c0;
        let t18: f64 = t9 * s0;
        let t20: f64 = t10 * s0;
        let t21: f64 = t16 - t18;
        let t22: f64 = t17 + t20;
        let t25: f64 = 4.0 * t21;
        let t26: f64 = 4.0 * t22;
        let t27: f64 = t12 + t25;
        let t28: f64 = t13 + t26;
        let t32: f64 = 3.5 * c1;
        let t33: f64 = 3.5 * s1;
        let t34: f64 = 4.5 + t32;
        let t35: f64 = t34 - t27;
        let t36: f64 = t33 - t28;
        let t38: f64 = 0.2222222222222222 * t35;
        let t39: f64 = 0.2222222222222222 * t36;
        let mut size: f64 = 0.0;
        size = larger(size, t38);
        size = larger(size, t39);
        if size <= TOLERANCE || size <= ROUNDING && !(size < HALF * last) {
            x[0] = x0;
            x[1] = x1;
            return true;
        }
        /* a step that does not halve the rows is not to be trusted */
        if !(size < HALF * last) { return false; }
        last = size;
        let t49: f64 = (-0.8888888888888888) * t22;
        let t51: f64 = (-0.8888888888888888) * t21;
        let t55: f64 = 0.7777777777777777 * s1;
        let t57: f64 = 0.7777777777777777 * c1;
        let t69: f64 = t49 * t57;
        let t71: f64 = t51 * t55;
        let t72: f64 = t71 - t69;
        let t73: f64 = 1.0 / t72;
        let t74: f64 = t38 * t57;
        let t75: f64 = t39 * t55;
        let t76: f64 = t74 + t75;
        let t77: f64 = t73 * t76;
        let t78: f64 = t38 * t51;
        let t80: f64 = t39 * t49;
        let t82: f64 = t78 + t80;
        let t84: f64 = t73 * t82;
        let t96: f64 = -t77;
        if !(absolute(t72) > 0.769800358919501 * LEAST_PIVOT) { return false; }
        let d0: f64 = t96;
        let d1: f64 = t84;
        let mut longest: f64 = 0.0;
        longest = larger(longest, d0);
        longest = larger(longest, d1);
        if !(longest <= LONGEST_STEP) { return false; }
        let t101: f64 = x0 + d0;
        let t102: f64 = x1 + d1;
        turn(d0, longest, &mut s0, &mut c0);
        turn(d1, longest, &mut s1, &mut c1);
        let y0: f64 = t101;
        let y1: f64 = t102;
        x0 = y0;
        x1 = y1;
    }
    false
}

const M: usize = ROWS + UNKNOWNS;

/// The least-squares step for rows r and Jacobian j with rows damping·1 below: Householder reflections
/// with column pivoting (Businger and Golub 1965). Unknowns that the rows do not determine stay. Returns
/// the ratio of the smallest pivot to the largest.
fn least_squares(
    r: &[f64; ROWS],
    j: &[[f64; UNKNOWNS]; ROWS],
    damping: f64,
    d: &mut [f64; UNKNOWNS],
) -> f64 {
    let mut a = [[0.0; UNKNOWNS]; M];
    let mut b = [0.0; M];
    let mut order = [0; UNKNOWNS];
    let (mut first, mut least, mut rank) = (0.0, 0.0, 0);
    for i in 0..ROWS {
        a[i] = j[i];
        b[i] = -r[i];
    }
    for k in 0..UNKNOWNS {
        a[ROWS + k][k] = damping;
        order[k] = k;
    }
    for k in 0..UNKNOWNS {
        let (mut best, mut column) = (-1.0, k);
        for c in k..UNKNOWNS {
            let mut sum = 0.0;
            for row in &a[k..] {
                sum += row[c] * row[c];
            }
            if sum > best {
                (best, column) = (sum, c);
            }
        }
        let norm = root(best);
        if k == 0 {
            first = norm;
        }
        least = norm;
        if !(norm > 1e-10 * first) {
            break;
        }
        for row in &mut a {
            row.swap(k, column);
        }
        order.swap(k, column);
        let head = if a[k][k] > 0.0 { -norm } else { norm };
        // v = column − head e_k stays in the column; v·v = 2 head (head − a_kk)
        a[k][k] -= head;
        let scale = -head * a[k][k];
        for c in k + 1..UNKNOWNS {
            let mut dot = 0.0;
            for row in &a[k..] {
                dot += row[k] * row[c];
            }
            for row in &mut a[k..] {
                row[c] -= dot / scale * row[k];
            }
        }
        let mut dot = 0.0;
        for (row, b) in a[k..].iter().zip(&b[k..]) {
            dot += row[k] * b;
        }
        for (row, b) in a[k..].iter().zip(&mut b[k..]) {
            *b -= dot / scale * row[k];
        }
        a[k][k] = head;
        rank += 1;
    }
    *d = [0.0; UNKNOWNS];
    for k in (0..rank).rev() {
        let mut sum = b[k];
        for i in k + 1..rank {
            sum -= a[k][i] * d[order[i]];
        }
        d[order[k]] = sum / a[k][k];
    }
    if first > 0.0 { least / first } else { 0.0 }
}

/// Newton's method from a guess that may be far off or singular: Gauss–Newton steps, damped when they
/// fail (Levenberg 1944, Marquardt 1963).
fn careful(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> Verdict {
    const MOST_STEPS: usize = 100;
    const MOST_TRIALS: usize = 40;
    let squares_of = |r: &[f64; ROWS]| {
        let mut squares = 0.0;
        for row in r {
            squares += row * row;
        }
        squares
    };
    let (mut at, mut next) = (*x, *x);
    let mut d = [0.0; UNKNOWNS];
    let (mut r, mut j) = ([0.0; ROWS], [[0.0; UNKNOWNS]; ROWS]);
    let (mut damping, mut slow, mut stuck): (f64, _, _) = (0.0, 0, false);
    linearise(u, &at, &mut r, &mut j);
    for _ in 0..MOST_STEPS {
        let squares = squares_of(&r);
        let mut largest = 0.0;
        for &row in &r {
            largest = larger(largest, row);
        }
        if largest <= TOLERANCE || largest <= ROUNDING && stuck {
            // a double solution is met only to the root of the tolerance
            let ratio = least_squares(&r, &j, 0.0, &mut d);
            *x = at;
            return if ratio < 1e-5 { Verdict::Singular } else { Verdict::Solved };
        }
        if stuck {
            return Verdict::NotAssembled;
        }
        let mut lower = squares;
        for _ in 0..MOST_TRIALS {
            least_squares(&r, &j, damping, &mut d);
            let mut longest = 0.0;
            for &part in &d {
                longest = larger(longest, part);
            }
            if longest > 1.0 {
                for part in &mut d {
                    *part /= longest;
                }
            }
            displace(&at, &d, &mut next);
            let (mut tried, mut slopes) = ([0.0; ROWS], [[0.0; UNKNOWNS]; ROWS]);
            linearise(u, &next, &mut tried, &mut slopes);
            lower = squares_of(&tried);
            if lower < squares {
                (r, j, at) = (tried, slopes, next);
                break;
            }
            damping = if damping > 0.0 { damping * 3.0 } else { 0.03 };
        }
        if !(lower < squares) {
            stuck = true;
            continue;
        }
        damping = if damping < 1e-4 { 0.0 } else { damping * 0.2 };
        slow = if 1.0 - lower / squares < 1e-6 { slow + 1 } else { 0 };
        stuck = slow == 3;
    }
    Verdict::StepLimit
}

/// Whether all numbers are finite and of a size that sines take.
fn near(numbers: &[f64]) -> bool {
    // of all, without a branch for each
    numbers.iter().fold(true, |near, &x| near & (absolute(x) < 1e5))
}

/// Finds the state for inputs u, starting from x.
pub fn solve(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> Verdict {
    if !near(u) || !near(x) {
        return Verdict::BadInput;
    }
    match fast(u, x) {
        true => Verdict::Solved,
        false => careful(u, x),
    }
}

/// A state with the last move.
#[derive(Clone, Debug)]
pub struct Follower {
    /// The state.
    pub state: [f64; STATE],
    /// How far it moved.
    pub moved: [f64; STATE],
}

impl Follower {
    /// At a state, at rest.
    pub fn new(state: [f64; STATE]) -> Self {
        Follower {
            state,
            moved: [0.0; STATE],
        }
    }

    /// Finds the state for inputs u near where the last move, made once more, leads.
    #[inline]
    pub fn solve(&mut self, u: &[f64; INPUTS]) -> Verdict {
        let mut x = self.state;
        for (x, moved) in x.iter_mut().zip(&self.moved) {
            *x += moved;
        }
        normalise(&mut x);
        if !(near(u) && near(&x) && fast(u, &mut x)) {
            x = self.state;
            let verdict = solve(u, &mut x);
            if verdict != Verdict::Solved {
                *self = Follower::new(x);
                return verdict;
            }
        }
        for i in 0..STATE {
            self.moved[i] = x[i] - self.state[i];
        }
        self.state = x;
        Verdict::Solved
    }
}

/// For each frame its axes x, y, z and its origin in ground, and for each input the twist (v, ω) for a
/// unit rate of it, v at the frame's origin. False at a singular configuration, where there are none.
pub fn frames(
    u: &[f64; INPUTS],
    x: &[f64; STATE],
    pose: &mut [[f64; 12]; FRAMES],
    twist: &mut [[[f64; 6]; INPUTS]; FRAMES],
) -> bool {
    const LEAST_PIVOT: f64 = 1e-6;
    true
}
