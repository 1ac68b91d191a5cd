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
//! [`Follower::solve`] finds the state for inputs on the branch of its last state, along the straight path
//! between the inputs. [`solve`] does it from the start state, along the straight path from the start inputs,
//! or from a state measured or known for inputs near these, along a path on which the gaps of the closures
//! shrink: a state of inputs far away is for a follower. Nothing is allocated, and no library is needed.
//!
//! After `NotAssembled` or `StepLimit` the follower stands where it stood: keep the mechanism there, and ask
//! for inputs back along the way they came; those asked for are beyond a dead point or another singularity,
//! or out of reach. After `BadInput` ask again with numbers. After `Singular` the branch is no longer known:
//! let a new follower begin from a state measured or known. After `Elsewhere` compare the state with the
//! mechanism before it is used. [`margin`] tells beforehand how near a singular configuration is.

#![allow(clippy::all, unused, non_snake_case)]

/// Outcome of a search. With `NotAssembled`, `StepLimit` and `BadInput` the state is left as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every closure equation holds to [`TOLERANCE`], or to [`ROUNDING`] where rounding allows no more, and the
    /// state is on the branch of the one it was found from.
    Solved,
    /// The closures hold, but the configuration is singular or next to one: the state is known to about half
    /// the digits, something moves although the inputs are held, and branches meet.
    Singular,
    /// The closures cannot be closed near the start, or on its branch.
    NotAssembled,
    /// Neither was reached in the steps that are allowed.
    StepLimit,
    /// A number is not finite, or beyond 1e5.
    BadInput,
    /// As `Solved`, but a joint is beyond its limits.
    OutsideLimits,
    /// Of [`solve`] only: as `Solved`, but no path leads there from the state it began with.
    Elsewhere,
}

pub const INPUTS: usize = 1;
pub const STATE: usize = 2;
/// From this number on the state follows from the numbers before it.
pub const ITERATED: usize = 2;
pub const UNKNOWNS: usize = 2;
pub const ROWS: usize = 2;
/// Number of rows of the iteration.
pub const EQUATIONS: usize = 2;
/// Number of unknowns of the iteration.
pub const STEPS: usize = 2;
pub const FRAMES: usize = 0;
/// Number of signs of the closed form, each for two solutions.
pub const SIGNS: usize = 1;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The largest row accepted where a step makes it no smaller, by rounding.
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

/// 1/√x for x > 0: by its series near 1, where quaternions are, otherwise by Newton's method.
#[inline]
fn inverse_root(x: f64) -> f64 {
    let e = x - 1.0;
    if absolute(e) < 1e-4 {
        return 1.0 - e * (0.5 - e * (0.375 - e * 0.3125));
    }
    let mut y: f64 = f64::from_bits(0x5fe6_eb50_c7b5_37a9 - (x.to_bits() >> 1));
    let mut k = 0;
    while k < 4 {
        y = y * (1.5 - 0.5 * x * y * y);
        k += 1;
    }
    y
}

/// √x for x ≥ 0.
#[inline]
fn root(x: f64) -> f64 {
    if !(x > 0.0) {
        return 0.0;
    }
    let y = inverse_root(x);
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
    // choices by bits, so that several angles share vector registers
    let (s, c) = (s.to_bits(), c.to_bits());
    let exchanged = (s ^ c) & (quarter & 1).wrapping_neg();
    (
        f64::from_bits(s ^ exchanged ^ ((quarter & 2) << 62)),
        f64::from_bits(c ^ exchanged ^ ((quarter.wrapping_add(1) & 2) << 62)),
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
    let (t10, t11) = sine_cosine(u0);
    let t13: f64 = 2.0 * t11;
    let t14: f64 = 2.0 * t10;
    let (t15, t16) = sine_cosine(x0);
    let t17: f64 = t11 * t16;
    let t18: f64 = t10 * t15;
    let t19: f64 = t17 - t18;
    let t20: f64 = t10 * t16;
    let t21: f64 = t11 * t15;
    let t22: f64 = t20 + t21;
    let t24: f64 = 4.0 * t19;
    let t25: f64 = t13 + t24;
    let t26: f64 = 4.0 * t22;
    let t27: f64 = t14 + t26;
    let (t28, t29) = sine_cosine(x1);
    let t31: f64 = 3.5 * t29;
    let t32: f64 = 4.5 + t31;
    let t33: f64 = 3.5 * t28;
    let t34: f64 = t32 - t25;
    let t35: f64 = t33 - t27;
    let t37: f64 = 0.2222222222222222 * t34;
    let t38: f64 = 0.2222222222222222 * t35;
    let t48: f64 = (-0.8888888888888888) * t22;
    let t49: f64 = -t48;
    let t50: f64 = (-0.8888888888888888) * t19;
    let t53: f64 = 0.7777777777777777 * t28;
    let t54: f64 = -t53;
    let t55: f64 = 0.7777777777777777 * t29;
    r[0] = t37;
    r[1] = t38;
    j[0][0] = t49;
    j[0][1] = t54;
    j[1][0] = t50;
    j[1][1] = t55;
}

/// The state x moved by a step d.
fn displace(x: &[f64; STATE], d: &[f64; UNKNOWNS], y: &mut [f64; STATE]) {
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let d0: f64 = d[0];
    let d1: f64 = d[1];
    let t99: f64 = x0 + d0;
    let t100: f64 = x1 + d1;
    y[0] = t99;
    y[1] = t100;
}

/// The rows r of the iteration and their Jacobian.
fn slopes(
    u: &[f64; INPUTS],
    x: &[f64; STATE],
    r: &mut [f64; EQUATIONS],
    j: &mut [[f64; STEPS]; EQUATIONS],
) {
    let u0: f64 = u[0];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let (t10, t11) = sine_cosine(u0);
    let t13: f64 = 2.0 * t11;
    let t14: f64 = 2.0 * t10;
    let (t15, t16) = sine_cosine(x0);
    let t17: f64 = t11 * t16;
    let t18: f64 = t10 * t15;
    let t19: f64 = t17 - t18;
    let t20: f64 = t10 * t16;
    let t21: f64 = t11 * t15;
    let t22: f64 = t20 + t21;
    let t24: f64 = 4.0 * t19;
    let t25: f64 = t13 + t24;
    let t26: f64 = 4.0 * t22;
    let t27: f64 = t14 + t26;
    let (t28, t29) = sine_cosine(x1);
    let t31: f64 = 3.5 * t29;
    let t32: f64 = 4.5 + t31;
    let t33: f64 = 3.5 * t28;
    let t34: f64 = t32 - t25;
    let t35: f64 = t33 - t27;
    let t37: f64 = 0.2222222222222222 * t34;
    let t38: f64 = 0.2222222222222222 * t35;
    let t48: f64 = (-0.8888888888888888) * t22;
    let t49: f64 = -t48;
    let t50: f64 = (-0.8888888888888888) * t19;
    let t53: f64 = 0.7777777777777777 * t28;
    let t54: f64 = -t53;
    let t55: f64 = 0.7777777777777777 * t29;
    r[0] = t37;
    r[1] = t38;
    j[0][0] = t49;
    j[0][1] = t54;
    j[1][0] = t50;
    j[1][1] = t55;
}

/// The square of the distance between inputs u with a state x and inputs v with a state y, in rad and
/// characteristic lengths, as far as the Jacobian depends on them.
#[inline(always)]
fn apart(u: &[f64; INPUTS], x: &[f64; STATE], v: &[f64; INPUTS], y: &[f64; STATE]) -> f64 {
    let a0: f64 = u[0] - v[0];
    let b0: f64 = x[0] - y[0];
    let b1: f64 = x[1] - y[1];
    return a0 * a0 + b0 * b0 + b1 * b1;
}

/// A left inverse of a Jacobian, by the method of Gram and Schmidt. Returns the sum of the squares of its
/// entries; 0 if there is none.
fn inverse(mut j: [[f64; STEPS]; EQUATIONS], inverse: &mut [[f64; EQUATIONS]; STEPS]) -> f64 {
    let mut t = [[0.0; STEPS]; STEPS];
    let mut squares = 0.0;
    for k in 0..STEPS {
        let mut sum = 0.0;
        for row in &j {
            sum += row[k] * row[k];
        }
        let length = root(sum);
        if !(length > 1e-10) {
            return 0.0;
        }
        t[k][k] = length;
        for row in &mut j {
            row[k] /= length;
        }
        for c in k + 1..STEPS {
            let mut sum = 0.0;
            for row in &j {
                sum += row[k] * row[c];
            }
            for row in &mut j {
                row[c] -= sum * row[k];
            }
            t[k][c] = sum;
        }
    }
    for i in 0..EQUATIONS {
        for k in (0..STEPS).rev() {
            let mut sum = j[i][k];
            for c in k + 1..STEPS {
                sum -= t[k][c] * inverse[c][i];
            }
            let entry = sum / t[k][k];
            inverse[k][i] = entry;
            squares += entry * entry;
        }
    }
    squares
}

/// Normalises quaternions after a small change.
#[inline(always)]
fn normalise(x: &mut [f64; STATE]) {
}

/// Newton's method with the order of elimination chosen beforehand; false, and x as it was, where a
/// pivot is small or a step does not halve the rows.
// it takes a tenth longer within another function
#[inline(never)]
fn fast(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> bool {
    const LEAST_PIVOT: f64 = 1e-4;
    const LONGEST_STEP: f64 = 0.5;
    const LARGE: f64 = 1e30;
    const HALF: f64 = 0.5;
    const MOST_STEPS: usize = 12;
    let u0: f64 = u[0];
    let (t10, t11) = sine_cosine(u0);
    let t13: f64 = 2.0 * t11;
    let t14: f64 = 2.0 * t10;
    let mut x0: f64 = x[0];
    let mut x1: f64 = x[1];
    let (mut s0, mut c0) = sine_cosine(x0);
    let (mut s1, mut c1) = sine_cosine(x1);
    let mut last: f64 = LARGE;
    for _ in 0..MOST_STEPS {
        let t17: f64 = t11 * c0;
        let t18: f64 = t10 * s0;
        let t19: f64 = t17 - t18;
        let t20: f64 = t10 * c0;
        let t21: f64 = t11 * s0;
        let t22: f64 = t20 + t21;
        let t24: f64 = 4.0 * t19;
        let t25: f64 = t13 + t24;
        let t26: f64 = 4.0 * t22;
        let t27: f64 = t14 + t26;
        let t31: f64 = 3.5 * c1;
        let t32: f64 = 4.5 + t31;
        let t33: f64 = 3.5 * s1;
        let t34: f64 = t32 - t25;
        let t35: f64 = t33 - t27;
        let t37: f64 = 0.2222222222222222 * t34;
        let t38: f64 = 0.2222222222222222 * t35;
        let mut size: f64 = 0.0;
        size = larger(size, t37);
        size = larger(size, t38);
        if size <= TOLERANCE || size <= ROUNDING && !(size < HALF * last) {
            x[0] = x0;
            x[1] = x1;
            return true;
        }
        /* a step that does not halve the rows is not to be trusted */
        if !(size < HALF * last) { return false; }
        last = size;
        let t48: f64 = (-0.8888888888888888) * t22;
        let t50: f64 = (-0.8888888888888888) * t19;
        let t53: f64 = 0.7777777777777777 * s1;
        let t55: f64 = 0.7777777777777777 * c1;
        let t67: f64 = t48 * t55;
        let t69: f64 = t50 * t53;
        let t70: f64 = t69 - t67;
        let t71: f64 = 1.0 / t70;
        let t72: f64 = t37 * t55;
        let t73: f64 = t38 * t53;
        let t74: f64 = t72 + t73;
        let t75: f64 = t71 * t74;
        let t76: f64 = t37 * t50;
        let t78: f64 = t38 * t48;
        let t80: f64 = t76 + t78;
        let t82: f64 = t71 * t80;
        let t94: f64 = -t75;
        if !(absolute(t70) > 0.769800358919501 * LEAST_PIVOT) { return false; }
        let d0: f64 = t94;
        let d1: f64 = t82;
        let mut longest: f64 = 0.0;
        longest = larger(longest, d0);
        longest = larger(longest, d1);
        if !(longest <= LONGEST_STEP) { return false; }
        let t99: f64 = x0 + d0;
        let t100: f64 = x1 + d1;
        turn(d0, longest, &mut s0, &mut c0);
        turn(d1, longest, &mut s1, &mut c1);
        let y0: f64 = t99;
        let y1: f64 = t100;
        x0 = y0;
        x1 = y1;
    }
    false
}

/// At most the smallest singular value of the Jacobian by the unknowns that are iterated, dimensionless, and
/// at least that over the root of their number: the margin to a singular configuration, where it is 0.
pub fn margin(u: &[f64; INPUTS], x: &[f64; STATE]) -> f64 {
    let (mut r, mut j) = ([0.0; EQUATIONS], [[0.0; STEPS]; EQUATIONS]);
    slopes(u, x, &mut r, &mut j);
    let squares = inverse(j, &mut [[0.0; EQUATIONS]; STEPS]);
    if squares > 0.0 { inverse_root(squares) } else { 0.0 }
}

/// Tests if an assembly (u, x) is on the branch of another one (v, y). Returns the square of the distance from
/// it within which others are certain to be too, or 0 if that is not certain.
///
/// With b the norm of the inverse of the Jacobian J at (u, x) and K that of its derivative there is one
/// solution within a distance of 1/bK (Newton and Kantorovich). Where that does not suffice the change of the
/// Jacobian decides: ‖J⁻¹(J(v, y) − J)‖ ≤ ½. Two assemblies for the same inputs differ by about 2.
#[inline(never)]
fn reach(u: &[f64; INPUTS], x: &[f64; STATE], v: &[f64; INPUTS], y: &[f64; STATE]) -> f64 {
    const CURVATURE: f64 = 1.2570787220990214;
    const LEAST: f64 = 1e-30;
    let (mut r, mut here) = ([0.0; EQUATIONS], [[0.0; STEPS]; EQUATIONS]);
    slopes(u, x, &mut r, &mut here);
    let mut inverted = [[0.0; EQUATIONS]; STEPS];
    let squares = inverse(here, &mut inverted);
    if !(squares > 0.0) {
        return 0.0;
    }
    let size = squares * CURVATURE * CURVATURE;
    let way = apart(u, x, v, y);
    if !(36.0 * size * way <= 1.0) {
        let mut there = [[0.0; STEPS]; EQUATIONS];
        slopes(v, y, &mut r, &mut there);
        let mut squares = 0.0;
        for row in &inverted {
            for c in 0..STEPS {
                let mut sum = 0.0;
                for i in 0..EQUATIONS {
                    sum += row[i] * (there[i][c] - here[i][c]);
                }
                squares += sum * sum;
            }
        }
        if !(squares <= 0.25 && way <= 0.25) {
            return 0.0;
        }
    }
    0.64 / (size + LEAST)
}

/// Leads an assembly (v, x) to inputs u along the straight path of inputs, in steps that keep to its branch;
/// gaps that it has shrink alike. Returns what [`reach`] does at the end; 0 if it is not reached, with x the
/// last assembly before and v its inputs.
fn lead(v: &mut [f64; INPUTS], u: &[f64; INPUTS], x: &mut [f64; STATE]) -> f64 {
    const SHORTEST: f64 = 1e-9;
    const LONGEST_STEP: f64 = 0.5;
    const CLOSED: f64 = 1e-8;
    const MOST_PARTS: usize = 1000;
    const MOST_STEPS: usize = 12;
    const UNKNOWN: [usize; STEPS] = [0, 1];
    let (from, mut to) = (*v, *u);
    let (mut gap, mut r) = ([0.0; EQUATIONS], [0.0; EQUATIONS]);
    let mut j = [[0.0; STEPS]; EQUATIONS];
    let mut inverted = [[0.0; EQUATIONS]; STEPS];
    let mut d = [0.0; UNKNOWNS];
    let (mut part, mut step, mut tried) = (0.0, 1.0, 0);
    slopes(v, x, &mut gap, &mut j);
    while tried < MOST_PARTS && step >= SHORTEST {
        tried += 1;
        let end = if part + step < 1.0 { part + step } else { 1.0 };
        for i in 0..INPUTS {
            to[i] = if end < 1.0 { from[i] + end * (u[i] - from[i]) } else { u[i] };
        }
        let (mut y, mut next) = (*x, *x);
        let (mut last, mut reached) = (LONGEST_STEP, 0.0);
        for _ in 0..MOST_STEPS {
            slopes(&to, &y, &mut r, &mut j);
            if !(inverse(j, &mut inverted) > 0.0) {
                break;
            }
            let mut longest = 0.0;
            for n in 0..STEPS {
                let mut sum = 0.0;
                for i in 0..EQUATIONS {
                    sum -= inverted[n][i] * (r[i] - (1.0 - end) * gap[i]);
                }
                d[UNKNOWN[n]] = sum;
                longest = larger(longest, sum);
            }
            if !(longest <= last) {
                break;
            }
            last = 0.5 * longest;
            displace(&y, &d, &mut next);
            y = next;
            if longest <= CLOSED {
                reached = reach(&to, &y, v, x);
                break;
            }
        }
        if !(reached > 0.0) {
            step *= 0.5;
            continue;
        }
        *x = y;
        *v = to;
        if !(end < 1.0) {
            return reached;
        }
        part = end;
        step *= 2.0;
    }
    0.0
}

fn root_or_zero(x: f64) -> f64 {
    if x > 0.0 { root(x) } else { 0.0 }
}

fn sign(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// The angle of the vector (x, y): its tangent brought below tan 22.5°, then a polynomial (fdlibm, Sun 1993).
fn angle(y: f64, x: f64) -> f64 {
    let (across, along) = (absolute(x), absolute(y));
    let steep = along > across;
    let (low, high) = if steep { (across, along) } else { (along, across) };
    let half = low > 0.41421356 * high;
    let (top, over) = if half { (low - high, low + high) } else { (low, high) };
    let t = if over > 0.0 { top / over } else { 0.0 };
    let z: f64 = t * t;
    let w: f64 = z * z;
    let a: f64 = t + t * z * (((-0.3333333333333293) + z * 0.19999999999876483) + w * (((-0.14285714272503466) + z * 0.11111110405462356) + w * (((-0.09090887133436507) + z * 0.0769187620504483) + w * (((-0.06661073137387531) + z * 0.058335701337905735) + w * (((-0.04976877994615932) + z * 0.036531572744216916) + w * (-0.016285820115365782))))));
    let eighth = if half { a + 0.7853981633974483 } else { a };
    let quarter = if steep { 1.5707963267948966 - eighth } else { eighth };
    let upper = if x < 0.0 { 3.141592653589793 - quarter } else { quarter };
    if y < 0.0 { -upper } else { upper }
}

/// An angle, whole turns on, within half a turn of another.
fn nearest(angle: f64, other: f64) -> f64 {
    let turns: f64 = (other - angle) * 0.15915494309189535;
    // adding 3·2ⁿ rounds to the nearest integer
    angle + 6.283185307179586 * ((turns + 6755399441055744.0) - 6755399441055744.0)
}

/// The state in closed form. Solutions differ in signs, each +1 or −1: this is the one of given signs, or of none the
/// one nearest to x. [`Verdict::Singular`]: two solutions meet, or, with x left as it was, there are infinitely many.
#[inline]
pub fn assembly(
    u: &[f64; INPUTS],
    signs: Option<&[f64; SIGNS]>,
    x: &mut [f64; STATE],
) -> Verdict {
    let mut singular = false;
    let u0: f64 = u[0];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let (t10, t11) = sine_cosine(u0);
    let t13: f64 = 2.0 * t11;
    let (t28, t29) = sine_cosine(x1);
    let t103: f64 = 4.0 * t11;
    let t104: f64 = 9.0 - t103;
    let t105: f64 = (-3.5) * t104;
    let t107: f64 = 14.0 * t10;
    let t118: f64 = 18.0 * t11;
    let t119: f64 = 20.5 - t118;
    let t120: f64 = t105 * t105;
    let t121: f64 = t107 * t107;
    let t122: f64 = t120 + t121;
    let t123: f64 = t119 * t119;
    let t124: f64 = t122 - t123;
    let t125: f64 = root_or_zero(t124);
    let t126: f64 = t28 * t105;
    let t127: f64 = t29 * t107;
    let t128: f64 = t126 - t127;
    let t129: f64 = match signs { Some(signs) => signs[0], None => sign(t128) };
    let t130: f64 = t125 * t129;
    let t131: f64 = t107 * t119;
    let t132: f64 = t105 * t130;
    let t133: f64 = t131 + t132;
    let t134: f64 = t105 * t119;
    let t135: f64 = t107 * t130;
    let t136: f64 = t134 - t135;
    let t137: f64 = t133 * t133;
    let t138: f64 = t136 * t136;
    let t139: f64 = t137 + t138;
    let t140: f64 = angle(t133, t136);
    let t141: f64 = nearest(t140, x1);
    let t142: f64 = 1.0 / t122;
    let t143: f64 = t133 * t142;
    let t144: f64 = t136 * t142;
    let t145: f64 = u0 + x0;
    let t147: f64 = (-2.0) * t10;
    let t148: f64 = 3.5 * t143;
    let t149: f64 = t147 + t148;
    let t150: f64 = 4.5 - t13;
    let t151: f64 = 3.5 * t144;
    let t152: f64 = t150 + t151;
    let t153: f64 = t149 * t149;
    let t154: f64 = t152 * t152;
    let t155: f64 = t153 + t154;
    let t157: f64 = angle(t149, t152);
    let t158: f64 = nearest(t157, t145);
    let t163: f64 = t158 - u0;
    if !(t124 >= -ROUNDING * t122) { return Verdict::NotAssembled; }
    singular |= t124 < 1e-5 * 1e-5 * t122;
    if !(absolute(t139) > 9.378906250000002e-14) { return Verdict::Singular; }
    if !(absolute(t155) > 1.6e-17) { return Verdict::Singular; }
    x[0] = t163;
    x[1] = t141;
    if singular { Verdict::Singular } else { Verdict::Solved }
}

fn careful(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> Verdict {
    assembly(u, None, x)
}

/// True if all numbers are finite and of a size that sines take.
fn near(numbers: &[f64]) -> bool {
    // of all, without a branch for each
    numbers.iter().fold(true, |near, &x| near & (absolute(x) < 1e5))
}

/// True if the joints are within their limits.
#[inline]
pub fn within_limits(u: &[f64; INPUTS], x: &[f64; STATE]) -> bool {
    const ROUNDING: f64 = 1e-9;
    true
}

#[inline]
fn judged(u: &[f64; INPUTS], x: &[f64; STATE], verdict: Verdict) -> Verdict {
    match verdict {
        Verdict::Solved if !within_limits(u, x) => Verdict::OutsideLimits,
        _ => verdict,
    }
}

/// Leads the assembly (v, x) to inputs u; the verdict, and the square of the distance to which others are certain.
#[inline(never)]
fn led(v: &[f64; INPUTS], u: &[f64; INPUTS], x: &mut [f64; STATE]) -> (Verdict, f64) {
    let (mut from, mut y) = (*v, *x);
    let mut reached = lead(&mut from, u, &mut y);
    let last = y;
    let mut verdict = match reached > 0.0 && fast(u, &mut y) {
        true => Verdict::Solved,
        false => careful(u, &mut y),
    };
    if !matches!(verdict, Verdict::Solved | Verdict::Singular) {
        return (verdict, 0.0);
    }
    if !(margin(u, &y) > 1e-5) {
        verdict = Verdict::Singular;
    }
    // the end of the branch may be singular, but is not on another one
    if verdict == Verdict::Solved && !(reached > 0.0) || !(apart(u, &y, u, &last) <= 0.01) {
        return (Verdict::Elsewhere, 0.0);
    }
    if verdict == Verdict::Singular {
        reached = 0.0;
    }
    *x = y;
    (verdict, reached)
}

/// The inputs that the path to u begins with: those of the start for its state, else u itself.
fn origin<'a>(u: &'a [f64; INPUTS], x: &[f64; STATE]) -> &'a [f64; INPUTS] {
    if *x == START_STATE { &START_INPUTS } else { u }
}

/// Finds the state for inputs u, starting from x.
pub fn solve(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> Verdict {
    if !near(u) || !near(x) {
        return Verdict::BadInput;
    }
    let (v, mut y) = (origin(u, x), *x);
    if fast(u, &mut y) && reach(u, &y, v, x) > 0.0 {
        *x = y;
        return judged(u, x, Verdict::Solved);
    }
    let (mut verdict, _) = led(v, u, x);
    if !matches!(verdict, Verdict::Solved | Verdict::Singular) {
        // a singular start is on no branch that could be left
        let singular = !(margin(v, x) > 1e-5);
        verdict = careful(u, x);
        if verdict == Verdict::Solved && !singular {
            return Verdict::Elsewhere;
        }
    }
    judged(u, x, verdict)
}

/// A state with its past.
#[derive(Clone, Debug)]
pub struct Follower {
    /// The state.
    pub state: [f64; STATE],
    /// The last move of the numbers from which the others follow.
    pub moved: [f64; ITERATED],
    /// Inputs and state of an assembly of its branch.
    inputs: [f64; INPUTS],
    certain: [f64; STATE],
    /// The square of the distance to which these are certain to be on it; 0 at the beginning.
    reach: f64,
}

impl Follower {
    /// A follower at rest at a state. It begins as [`solve`] does.
    pub fn new(state: [f64; STATE]) -> Self {
        Follower {
            state,
            moved: [0.0; ITERATED],
            inputs: [0.0; INPUTS],
            certain: state,
            reach: 0.0,
        }
    }

    /// Finds the state for inputs u near where the last move, made once more, leads.
    #[inline]
    pub fn solve(&mut self, u: &[f64; INPUTS]) -> Verdict {
        let before = self.state;
        for (x, moved) in self.state.iter_mut().zip(&self.moved) {
            *x += moved;
        }
        normalise(&mut self.state);
        if !(near(u) && near(&self.state[..ITERATED]) && fast(u, &mut self.state) && self.is_certain(u, &before)) {
            self.state = before;
            return self.recover(u);
        }
        for i in 0..ITERATED {
            self.moved[i] = self.state[i] - before[i];
        }
        judged(u, &self.state, Verdict::Solved)
    }

    /// True if the state is certain to be on the branch of the one before.
    #[inline(always)]
    fn is_certain(&mut self, u: &[f64; INPUTS], before: &[f64; STATE]) -> bool {
        (apart(u, &self.state, &self.inputs, &self.certain) <= self.reach
            && 100.0 * apart(u, &self.state, u, before) <= self.reach)
            || self.reaches(u, before)
    }

    #[cold]
    #[inline(never)]
    fn reaches(&mut self, u: &[f64; INPUTS], before: &[f64; STATE]) -> bool {
        let reached = match self.reach > 0.0 {
            true => reach(u, &self.state, &self.inputs, &self.certain),
            false => reach(u, &self.state, origin(u, before), before),
        };
        if reached > 0.0 {
            (self.inputs, self.certain, self.reach) = (*u, self.state, reached);
        }
        reached > 0.0
    }

    /// [`Follower::solve`] from the certain state: a function apart, so that its numbers stay in registers.
    #[cold]
    #[inline(never)]
    fn recover(&mut self, u: &[f64; INPUTS]) -> Verdict {
        self.moved = [0.0; ITERATED];
        if !near(u) || !near(&self.state) {
            return Verdict::BadInput;
        }
        let (from, mut x) = match self.reach > 0.0 {
            true => (self.inputs, self.certain),
            false => (*origin(u, &self.state), self.state),
        };
        let (verdict, reached) = led(&from, u, &mut x);
        match verdict {
            Verdict::Solved | Verdict::Singular => {}
            Verdict::Elsewhere => return Verdict::NotAssembled,
            _ => return verdict,
        }
        self.state = x;
        (self.inputs, self.certain, self.reach) = (*u, x, reached);
        judged(u, &self.state, verdict)
    }
}

/// For each number of the state its rate for a unit rate of each input. False at a singular configuration,
/// where there are none.
pub fn rates(u: &[f64; INPUTS], x: &[f64; STATE], rate: &mut [[f64; INPUTS]; STATE]) -> bool {
    const LEAST_PIVOT: f64 = 1e-6;
    let u0: f64 = u[0];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let (t10, t11) = sine_cosine(u0);
    let t13: f64 = 2.0 * t11;
    let t14: f64 = 2.0 * t10;
    let (t15, t16) = sine_cosine(x0);
    let t17: f64 = t11 * t16;
    let t18: f64 = t10 * t15;
    let t19: f64 = t17 - t18;
    let t20: f64 = t10 * t16;
    let t21: f64 = t11 * t15;
    let t22: f64 = t20 + t21;
    let t24: f64 = 4.0 * t19;
    let t25: f64 = t13 + t24;
    let t26: f64 = 4.0 * t22;
    let t27: f64 = t14 + t26;
    let (t28, t29) = sine_cosine(x1);
    let t48: f64 = (-0.8888888888888888) * t22;
    let t50: f64 = (-0.8888888888888888) * t19;
    let t53: f64 = 0.7777777777777777 * t28;
    let t55: f64 = 0.7777777777777777 * t29;
    let t63: f64 = 0.2222222222222222 * t27;
    let t64: f64 = 0.2222222222222222 * t25;
    let t67: f64 = t48 * t55;
    let t69: f64 = t50 * t53;
    let t70: f64 = t69 - t67;
    let t71: f64 = 1.0 / t70;
    let t84: f64 = t55 * t63;
    let t85: f64 = t53 * t64;
    let t87: f64 = t84 - t85;
    let t88: f64 = t71 * t87;
    let t89: f64 = t50 * t63;
    let t91: f64 = t48 * t64;
    let t92: f64 = t91 - t89;
    let t93: f64 = t71 * t92;
    let t95: f64 = -t88;
    let t96: f64 = -t93;
    if !(absolute(t70) > 0.769800358919501 * LEAST_PIVOT) { return false; }
    rate[0][0] = t95;
    rate[1][0] = t96;
    true
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
