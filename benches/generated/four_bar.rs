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
/// In how many places there are two solutions.
pub const SIGNS: usize = 1;

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

/// Unit quaternions again after a small change.
#[inline(always)]
fn normalise(x: &mut [f64; STATE]) {
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

#[inline]
fn fast(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> bool {
    assembly(u, None, x) == Verdict::Solved
}

fn careful(u: &[f64; INPUTS], x: &mut [f64; STATE]) -> Verdict {
    assembly(u, None, x)
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
