//! 3-RPS parallel manipulator
//!
//! Solver written by linkwork 0.1.0.
//!
//! Inputs, what is held:
//!      0  l1, m
//!      1  l2, m
//!      2  l3, m
//!
//! State, what is found:
//!      0  phi1, rad
//!      1  phi2, rad
//!      2  phi3, rad
//!      3  top.qw
//!      4  top.qx
//!      5  top.qy
//!      6  top.qz
//!      7  top.x, m
//!      8  top.y, m
//!      9  top.z, m
//! qw, qx, qy, qz is the unit quaternion of a platform, ground from platform.
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

pub const INPUTS: usize = 3;
pub const STATE: usize = 10;
pub const UNKNOWNS: usize = 9;
pub const ROWS: usize = 9;
pub const FRAMES: usize = 0;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The same where a step makes it no smaller.
pub const ROUNDING: f64 = 1e-12;

/// Inputs of the assembled configuration at which the order of elimination was chosen.
pub const START_INPUTS: [f64; INPUTS] = [
    0.8, 0.8, 0.8,
];
/// Its state.
pub const START_STATE: [f64; STATE] = [
    0.6751315329370314, 0.6751315329370314, 0.6751315329370315, 1.0,
    2.7121042100272843e-17, 8.745639952378402e-18, -2.106230049623858e-17, 8.66334185444043e-18,
    2.1062299725126498e-17, 0.6244997998398399,
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

/// √x for x ≥ 0, by Newton's method for 1/√x.
#[inline]
fn root(x: f64) -> f64 {
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
    let turns: f64 = x * 0.6366197723675814 + if x < 0.0 { -0.5 } else { 0.5 };
    let quarter = turns as i32;
    let k = quarter as f64;
    let r: f64 = ((x - k * 1.5707963267341256) - k * 6.077100506303966e-11) - k * 2.0222662487959506e-21;
    let z: f64 = r * r;
    let s: f64 = r + r * z * ((-0.16666666666666632) + z * (0.00833333333332249 + z * ((-0.0001984126982985795) + z * (2.7557313707070068e-6 + z * ((-2.5050760253406863e-8) + z * 1.58969099521155e-10)))));
    let c: f64 = (1.0 - 0.5 * z) + z * z * (0.0416666666666666 + z * ((-0.001388888888887411) + z * (2.480158728947673e-5 + z * ((-2.7557314351390663e-7) + z * (2.087572321298175e-9 + z * (-1.1359647557788195e-11))))));
    let (first, second) = if quarter & 1 == 1 { (c, s) } else { (s, c) };
    (
        if quarter & 2 == 2 { -first } else { first },
        if (quarter + 1) & 2 == 2 { -second } else { second },
    )
}

/// Sine and cosine after a further turn.
#[inline(always)]
fn turn(by: f64, sine: &mut f64, cosine: &mut f64) {
    let (s, c) = (*sine, *cosine);
    let (sin_by, versine) = if absolute(by) < 0.015625 {
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
    let u1: f64 = u[1];
    let u2: f64 = u[2];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
    let x7: f64 = x[7];
    let x8: f64 = x[8];
    let x9: f64 = x[9];
    let t29: f64 = x4 + x4;
    let t30: f64 = x5 + x5;
    let t31: f64 = x6 + x6;
    let t32: f64 = x3 * t29;
    let t33: f64 = x3 * t30;
    let t34: f64 = x3 * t31;
    let t35: f64 = x4 * t29;
    let t36: f64 = x4 * t30;
    let t37: f64 = x4 * t31;
    let t38: f64 = x5 * t30;
    let t39: f64 = x5 * t31;
    let t40: f64 = x6 * t31;
    let t41: f64 = 1.0 - t38;
    let t42: f64 = t41 - t40;
    let t43: f64 = t34 + t36;
    let t44: f64 = t37 - t33;
    let t45: f64 = t36 - t34;
    let t46: f64 = 1.0 - t35;
    let t47: f64 = t46 - t40;
    let t48: f64 = t32 + t39;
    let (t52, t53) = sine_cosine(x0);
    let t55: f64 = u0 * t52;
    let t57: f64 = u0 * t53;
    let t58: f64 = 1.0 - t55;
    let t59: f64 = 0.5 * t42;
    let t60: f64 = 0.5 * t43;
    let t61: f64 = 0.5 * t44;
    let t62: f64 = x7 + t59;
    let t63: f64 = x8 + t60;
    let t64: f64 = x9 + t61;
    let (t65, t66) = sine_cosine(x1);
    let t69: f64 = (-0.4999999999999998) * t65;
    let t70: f64 = 0.8660254037844388 * t65;
    let t73: f64 = u1 * t69;
    let t75: f64 = u1 * t70;
    let t77: f64 = u1 * t66;
    let t78: f64 = (-0.4999999999999998) - t73;
    let t79: f64 = 0.8660254037844388 - t75;
    let t80: f64 = (-0.2499999999999999) * t42;
    let t81: f64 = (-0.2499999999999999) * t43;
    let t82: f64 = (-0.2499999999999999) * t44;
    let t83: f64 = 0.4330127018922194 * t45;
    let t84: f64 = 0.4330127018922194 * t47;
    let t85: f64 = 0.4330127018922194 * t48;
    let t86: f64 = t80 + t83;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = x7 + t86;
    let t90: f64 = x8 + t87;
    let t91: f64 = x9 + t88;
    let (t92, t93) = sine_cosine(x2);
    let t96: f64 = (-0.5000000000000004) * t92;
    let t97: f64 = (-0.8660254037844384) * t92;
    let t100: f64 = u2 * t96;
    let t102: f64 = u2 * t97;
    let t104: f64 = u2 * t93;
    let t105: f64 = (-0.5000000000000004) - t100;
    let t106: f64 = (-0.8660254037844384) - t102;
    let t107: f64 = (-0.2500000000000002) * t42;
    let t108: f64 = (-0.2500000000000002) * t43;
    let t109: f64 = (-0.2500000000000002) * t44;
    let t110: f64 = (-0.4330127018922192) * t45;
    let t111: f64 = (-0.4330127018922192) * t47;
    let t112: f64 = (-0.4330127018922192) * t48;
    let t113: f64 = t107 + t110;
    let t114: f64 = t108 + t111;
    let t115: f64 = t109 + t112;
    let t116: f64 = x7 + t113;
    let t117: f64 = x8 + t114;
    let t118: f64 = x9 + t115;
    let t119: f64 = t62 - t58;
    let t120: f64 = t64 - t57;
    let t122: f64 = -t60;
    let t123: f64 = -t61;
    let t124: f64 = -t59;
    let t125: f64 = t89 - t78;
    let t126: f64 = t90 - t79;
    let t127: f64 = t91 - t77;
    let t128: f64 = 0.4999999999999998 * t77;
    let t129: f64 = 0.8660254037844388 * t77;
    let t131: f64 = 0.8660254037844388 * t75;
    let t133: f64 = 0.4999999999999998 * t73;
    let t136: f64 = -t128;
    let t137: f64 = t131 - t133;
    let t138: f64 = -t87;
    let t139: f64 = -t88;
    let t140: f64 = -t86;
    let t141: f64 = t116 - t105;
    let t142: f64 = t117 - t106;
    let t143: f64 = t118 - t104;
    let t144: f64 = 0.5000000000000004 * t104;
    let t145: f64 = (-0.8660254037844384) * t104;
    let t147: f64 = (-0.8660254037844384) * t102;
    let t149: f64 = 0.5000000000000004 * t100;
    let t152: f64 = -t144;
    let t153: f64 = t147 - t149;
    let t154: f64 = -t114;
    let t155: f64 = -t115;
    let t156: f64 = -t113;
    r[0] = t119;
    r[1] = t63;
    r[2] = t120;
    r[3] = t125;
    r[4] = t126;
    r[5] = t127;
    r[6] = t141;
    r[7] = t142;
    r[8] = t143;
    j[0][0] = t57;
    j[0][1] = 0.0;
    j[0][2] = 0.0;
    j[0][3] = 0.0;
    j[0][4] = t61;
    j[0][5] = t122;
    j[0][6] = 1.0;
    j[0][7] = 0.0;
    j[0][8] = 0.0;
    j[1][0] = 0.0;
    j[1][1] = 0.0;
    j[1][2] = 0.0;
    j[1][3] = t123;
    j[1][4] = 0.0;
    j[1][5] = t59;
    j[1][6] = 0.0;
    j[1][7] = 1.0;
    j[1][8] = 0.0;
    j[2][0] = t55;
    j[2][1] = 0.0;
    j[2][2] = 0.0;
    j[2][3] = t60;
    j[2][4] = t124;
    j[2][5] = 0.0;
    j[2][6] = 0.0;
    j[2][7] = 0.0;
    j[2][8] = 1.0;
    j[3][0] = 0.0;
    j[3][1] = t136;
    j[3][2] = 0.0;
    j[3][3] = 0.0;
    j[3][4] = t88;
    j[3][5] = t138;
    j[3][6] = 1.0;
    j[3][7] = 0.0;
    j[3][8] = 0.0;
    j[4][0] = 0.0;
    j[4][1] = t129;
    j[4][2] = 0.0;
    j[4][3] = t139;
    j[4][4] = 0.0;
    j[4][5] = t86;
    j[4][6] = 0.0;
    j[4][7] = 1.0;
    j[4][8] = 0.0;
    j[5][0] = 0.0;
    j[5][1] = t137;
    j[5][2] = 0.0;
    j[5][3] = t87;
    j[5][4] = t140;
    j[5][5] = 0.0;
    j[5][6] = 0.0;
    j[5][7] = 0.0;
    j[5][8] = 1.0;
    j[6][0] = 0.0;
    j[6][1] = 0.0;
    j[6][2] = t152;
    j[6][3] = 0.0;
    j[6][4] = t115;
    j[6][5] = t154;
    j[6][6] = 1.0;
    j[6][7] = 0.0;
    j[6][8] = 0.0;
    j[7][0] = 0.0;
    j[7][1] = 0.0;
    j[7][2] = t145;
    j[7][3] = t155;
    j[7][4] = 0.0;
    j[7][5] = t113;
    j[7][6] = 0.0;
    j[7][7] = 1.0;
    j[7][8] = 0.0;
    j[8][0] = 0.0;
    j[8][1] = 0.0;
    j[8][2] = t153;
    j[8][3] = t114;
    j[8][4] = t156;
    j[8][5] = 0.0;
    j[8][6] = 0.0;
    j[8][7] = 0.0;
    j[8][8] = 1.0;
}

/// The state x moved by a step d.
fn displace(x: &[f64; STATE], d: &[f64; UNKNOWNS], y: &mut [f64; STATE]) {
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
    let x7: f64 = x[7];
    let x8: f64 = x[8];
    let x9: f64 = x[9];
    let d0: f64 = d[0];
    let d1: f64 = d[1];
    let d2: f64 = d[2];
    let d3: f64 = d[3];
    let d4: f64 = d[4];
    let d5: f64 = d[5];
    let d6: f64 = d[6];
    let d7: f64 = d[7];
    let d8: f64 = d[8];
    let t535: f64 = x0 + d0;
    let t536: f64 = x1 + d1;
    let t537: f64 = x2 + d2;
    let t538: f64 = 0.5 * d3;
    let t539: f64 = 0.5 * d4;
    let t540: f64 = 0.5 * d5;
    let t541: f64 = x4 * t538;
    let t542: f64 = x3 - t541;
    let t543: f64 = x5 * t539;
    let t544: f64 = t542 - t543;
    let t545: f64 = x6 * t540;
    let t546: f64 = t544 - t545;
    let t547: f64 = x3 * t538;
    let t548: f64 = x4 + t547;
    let t549: f64 = x6 * t539;
    let t550: f64 = t548 + t549;
    let t551: f64 = x5 * t540;
    let t552: f64 = t550 - t551;
    let t553: f64 = x6 * t538;
    let t554: f64 = x5 - t553;
    let t555: f64 = x3 * t539;
    let t556: f64 = t554 + t555;
    let t557: f64 = x4 * t540;
    let t558: f64 = t556 + t557;
    let t559: f64 = x5 * t538;
    let t560: f64 = x6 + t559;
    let t561: f64 = x4 * t539;
    let t562: f64 = t560 - t561;
    let t563: f64 = x3 * t540;
    let t564: f64 = t562 + t563;
    let t565: f64 = t546 * t546;
    let t566: f64 = t552 * t552;
    let t567: f64 = t565 + t566;
    let t568: f64 = t558 * t558;
    let t569: f64 = t567 + t568;
    let t570: f64 = t564 * t564;
    let t571: f64 = t569 + t570;
    let t572: f64 = root(t571);
    let t573: f64 = 1.0 / t572;
    let t574: f64 = t546 * t573;
    let t575: f64 = t552 * t573;
    let t576: f64 = t558 * t573;
    let t577: f64 = t564 * t573;
    let t578: f64 = x7 + d6;
    let t579: f64 = x8 + d7;
    let t580: f64 = x9 + d8;
    y[0] = t535;
    y[1] = t536;
    y[2] = t537;
    y[3] = t574;
    y[4] = t575;
    y[5] = t576;
    y[6] = t577;
    y[7] = t578;
    y[8] = t579;
    y[9] = t580;
}

/// Unit quaternions again after a small change.
#[inline(always)]
fn normalise(x: &mut [f64; STATE]) {
    let f3: f64 = 1.5 - 0.5 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6]);
    x[3] *= f3;
    x[4] *= f3;
    x[5] *= f3;
    x[6] *= f3;
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
    let u1: f64 = u[1];
    let u2: f64 = u[2];
    let mut x0: f64 = x[0];
    let mut x1: f64 = x[1];
    let mut x2: f64 = x[2];
    let mut x3: f64 = x[3];
    let mut x4: f64 = x[4];
    let mut x5: f64 = x[5];
    let mut x6: f64 = x[6];
    let mut x7: f64 = x[7];
    let mut x8: f64 = x[8];
    let mut x9: f64 = x[9];
    let (mut s0, mut c0) = sine_cosine(x0);
    let (mut s1, mut c1) = sine_cosine(x1);
    let (mut s2, mut c2) = sine_cosine(x2);
    let mut last: f64 = LARGE;
    for _ in 0..MOST_STEPS {
        let t29: f64 = x4 + x4;
        let t30: f64 = x5 + x5;
        let t31: f64 = x6 + x6;
        let t32: f64 = x3 * t29;
        let t33: f64 = x3 * t30;
        let t34: f64 = x3 * t31;
        let t35: f64 = x4 * t29;
        let t36: f64 = x4 * t30;
        let t37: f64 = x4 * t31;
        let t38: f64 = x5 * t30;
        let t39: f64 = x5 * t31;
        let t40: f64 = x6 * t31;
        let t41: f64 = 1.0 - t38;
        let t42: f64 = t41 - t40;
        let t43: f64 = t34 + t36;
        let t44: f64 = t37 - t33;
        let t45: f64 = t36 - t34;
        let t46: f64 = 1.0 - t35;
        let t47: f64 = t46 - t40;
        let t48: f64 = t32 + t39;
        let t55: f64 = u0 * s0;
        let t57: f64 = u0 * c0;
        let t58: f64 = 1.0 - t55;
        let t59: f64 = 0.5 * t42;
        let t60: f64 = 0.5 * t43;
        let t61: f64 = 0.5 * t44;
        let t62: f64 = x7 + t59;
        let t63: f64 = x8 + t60;
        let t64: f64 = x9 + t61;
        let t69: f64 = (-0.4999999999999998) * s1;
        let t70: f64 = 0.8660254037844388 * s1;
        let t73: f64 = u1 * t69;
        let t75: f64 = u1 * t70;
        let t77: f64 = u1 * c1;
        let t78: f64 = (-0.4999999999999998) - t73;
        let t79: f64 = 0.8660254037844388 - t75;
        let t80: f64 = (-0.2499999999999999) * t42;
        let t81: f64 = (-0.2499999999999999) * t43;
        let t82: f64 = (-0.2499999999999999) * t44;
        let t83: f64 = 0.4330127018922194 * t45;
        let t84: f64 = 0.4330127018922194 * t47;
        let t85: f64 = 0.4330127018922194 * t48;
        let t86: f64 = t80 + t83;
        let t87: f64 = t81 + t84;
        let t88: f64 = t82 + t85;
        let t89: f64 = x7 + t86;
        let t90: f64 = x8 + t87;
        let t91: f64 = x9 + t88;
        let t96: f64 = (-0.5000000000000004) * s2;
        let t97: f64 = (-0.8660254037844384) * s2;
        let t100: f64 = u2 * t96;
        let t102: f64 = u2 * t97;
        let t104: f64 = u2 * c2;
        let t105: f64 = (-0.5000000000000004) - t100;
        let t106: f64 = (-0.8660254037844384) - t102;
        let t107: f64 = (-0.2500000000000002) * t42;
        let t108: f64 = (-0.2500000000000002) * t43;
        let t109: f64 = (-0.2500000000000002) * t44;
        let t110: f64 = (-0.4330127018922192) * t45;
        let t111: f64 = (-0.4330127018922192) * t47;
        let t112: f64 = (-0.4330127018922192) * t48;
        let t113: f64 = t107 + t110;
        let t114: f64 = t108 + t111;
        let t115: f64 = t109 + t112;
        let t116: f64 = x7 + t113;
        let t117: f64 = x8 + t114;
        let t118: f64 = x9 + t115;
        let t119: f64 = t62 - t58;
        let t120: f64 = t64 - t57;
        let t125: f64 = t89 - t78;
        let t126: f64 = t90 - t79;
        let t127: f64 = t91 - t77;
        let t141: f64 = t116 - t105;
        let t142: f64 = t117 - t106;
        let t143: f64 = t118 - t104;
        let mut size: f64 = 0.0;
        size = larger(size, t119);
        size = larger(size, t63);
        size = larger(size, t120);
        size = larger(size, t125);
        size = larger(size, t126);
        size = larger(size, t127);
        size = larger(size, t141);
        size = larger(size, t142);
        size = larger(size, t143);
        if size <= TOLERANCE || size <= ROUNDING && !(size < HALF * last) {
            x[0] = x0;
            x[1] = x1;
            x[2] = x2;
            x[3] = x3;
            x[4] = x4;
            x[5] = x5;
            x[6] = x6;
            x[7] = x7;
            x[8] = x8;
            x[9] = x9;
            return true;
        }
        /* a step that does not halve the rows is not to be trusted */
        if !(size < HALF * last) { return false; }
        last = size;
        let t128: f64 = 0.4999999999999998 * t77;
        let t129: f64 = 0.8660254037844388 * t77;
        let t131: f64 = 0.8660254037844388 * t75;
        let t133: f64 = 0.4999999999999998 * t73;
        let t137: f64 = t131 - t133;
        let t144: f64 = 0.5000000000000004 * t104;
        let t145: f64 = (-0.8660254037844384) * t104;
        let t147: f64 = (-0.8660254037844384) * t102;
        let t149: f64 = 0.5000000000000004 * t100;
        let t153: f64 = t147 - t149;
        let t162: f64 = 1.0 / t57;
        let t163: f64 = t55 * t162;
        let t164: f64 = t61 * t163;
        let t165: f64 = t59 + t164;
        let t167: f64 = t60 * t163;
        let t170: f64 = t119 * t163;
        let t171: f64 = t120 - t170;
        let t175: f64 = t61 - t88;
        let t176: f64 = t86 - t59;
        let t177: f64 = t126 - t63;
        let t178: f64 = t61 - t115;
        let t179: f64 = t113 - t59;
        let t180: f64 = t142 - t63;
        let t181: f64 = 1.0 / t129;
        let t182: f64 = t128 * t181;
        let t184: f64 = t175 * t182;
        let t186: f64 = t176 * t182;
        let t188: f64 = t186 - t87;
        let t189: f64 = t177 * t182;
        let t191: f64 = t125 + t189;
        let t195: f64 = t137 * t181;
        let t196: f64 = t175 * t195;
        let t197: f64 = t87 - t196;
        let t198: f64 = t176 * t195;
        let t200: f64 = t177 * t195;
        let t201: f64 = t127 - t200;
        let t205: f64 = 1.0 / t145;
        let t206: f64 = t144 * t205;
        let t208: f64 = t178 * t206;
        let t210: f64 = t179 * t206;
        let t212: f64 = t210 - t114;
        let t213: f64 = t180 * t206;
        let t215: f64 = t141 + t213;
        let t219: f64 = t153 * t205;
        let t220: f64 = t178 * t219;
        let t221: f64 = t114 - t220;
        let t222: f64 = t179 * t219;
        let t224: f64 = t180 * t219;
        let t225: f64 = t143 - t224;
        let t229: f64 = t163 * t184;
        let t231: f64 = t60 + t229;
        let t232: f64 = t88 * t163;
        let t234: f64 = t232 - t165;
        let t235: f64 = t163 * t188;
        let t237: f64 = t167 + t235;
        let t238: f64 = t163 * t191;
        let t240: f64 = t171 + t238;
        let t243: f64 = t208 - t184;
        let t244: f64 = t115 - t88;
        let t245: f64 = t212 - t188;
        let t246: f64 = t215 - t191;
        let t248: f64 = t197 - t231;
        let t249: f64 = t86 + t234;
        let t251: f64 = t198 + t237;
        let t253: f64 = t201 - t240;
        let t256: f64 = t221 - t231;
        let t257: f64 = t113 + t234;
        let t259: f64 = t222 + t237;
        let t261: f64 = t225 - t240;
        let t262: f64 = 1.0 / t245;
        let t263: f64 = t251 * t262;
        let t265: f64 = t243 * t263;
        let t267: f64 = t248 + t265;
        let t268: f64 = t244 * t263;
        let t270: f64 = t268 - t249;
        let t271: f64 = t246 * t263;
        let t273: f64 = t253 + t271;
        let t279: f64 = t259 * t262;
        let t281: f64 = t243 * t279;
        let t283: f64 = t256 + t281;
        let t284: f64 = t244 * t279;
        let t286: f64 = t284 - t257;
        let t287: f64 = t246 * t279;
        let t289: f64 = t261 + t287;
        let t296: f64 = 1.0 / t270;
        let t297: f64 = t286 * t296;
        let t298: f64 = t267 * t297;
        let t299: f64 = t283 - t298;
        let t300: f64 = t273 * t297;
        let t301: f64 = t289 - t300;
        let t309: f64 = 1.0 / t299;
        let t310: f64 = t301 * t309;
        let t311: f64 = t267 * t310;
        let t312: f64 = t273 - t311;
        let t313: f64 = t296 * t312;
        let t314: f64 = t244 * t313;
        let t315: f64 = t246 - t314;
        let t316: f64 = t243 * t310;
        let t317: f64 = t315 - t316;
        let t318: f64 = t262 * t317;
        let t319: f64 = t237 * t318;
        let t320: f64 = t240 - t319;
        let t321: f64 = t234 * t313;
        let t322: f64 = t320 - t321;
        let t323: f64 = t231 * t310;
        let t325: f64 = t188 * t318;
        let t326: f64 = t191 - t325;
        let t327: f64 = t88 * t313;
        let t328: f64 = t326 - t327;
        let t329: f64 = t184 * t310;
        let t330: f64 = t328 - t329;
        let t331: f64 = t179 * t318;
        let t332: f64 = t180 - t331;
        let t333: f64 = t178 * t310;
        let t334: f64 = t332 - t333;
        let t335: f64 = t205 * t334;
        let t336: f64 = t176 * t318;
        let t337: f64 = t177 - t336;
        let t338: f64 = t175 * t310;
        let t339: f64 = t337 - t338;
        let t340: f64 = t181 * t339;
        let t341: f64 = t59 * t318;
        let t342: f64 = t63 - t341;
        let t343: f64 = t61 * t310;
        let t345: f64 = t342 + t343;
        let t346: f64 = t119 - t330;
        let t347: f64 = t60 * t318;
        let t349: f64 = t346 + t347;
        let t350: f64 = t61 * t313;
        let t351: f64 = t349 - t350;
        let t352: f64 = t162 * t351;
        let t497: f64 = -t352;
        let t498: f64 = -t340;
        let t499: f64 = -t335;
        let t500: f64 = -t310;
        let t501: f64 = -t313;
        let t502: f64 = -t318;
        let t503: f64 = t329 - t328;
        let t504: f64 = -t345;
        let t505: f64 = t323 - t322;
        if !(absolute(t57) > LEAST_PIVOT) { return false; }
        if !(absolute(t129) > LEAST_PIVOT) { return false; }
        if !(absolute(t145) > LEAST_PIVOT) { return false; }
        if !(absolute(t245) > LEAST_PIVOT) { return false; }
        if !(absolute(t270) > LEAST_PIVOT) { return false; }
        if !(absolute(t299) > LEAST_PIVOT) { return false; }
        let d0: f64 = t497;
        let d1: f64 = t498;
        let d2: f64 = t499;
        let d3: f64 = t500;
        let d4: f64 = t501;
        let d5: f64 = t502;
        let d6: f64 = t503;
        let d7: f64 = t504;
        let d8: f64 = t505;
        let mut longest: f64 = 0.0;
        longest = larger(longest, d0);
        longest = larger(longest, d1);
        longest = larger(longest, d2);
        longest = larger(longest, d3);
        longest = larger(longest, d4);
        longest = larger(longest, d5);
        longest = larger(longest, d6);
        longest = larger(longest, d7);
        longest = larger(longest, d8);
        if !(longest <= LONGEST_STEP) { return false; }
        let t535: f64 = x0 + d0;
        let t536: f64 = x1 + d1;
        let t537: f64 = x2 + d2;
        let t538: f64 = 0.5 * d3;
        let t539: f64 = 0.5 * d4;
        let t540: f64 = 0.5 * d5;
        let t541: f64 = x4 * t538;
        let t542: f64 = x3 - t541;
        let t543: f64 = x5 * t539;
        let t544: f64 = t542 - t543;
        let t545: f64 = x6 * t540;
        let t546: f64 = t544 - t545;
        let t547: f64 = x3 * t538;
        let t548: f64 = x4 + t547;
        let t549: f64 = x6 * t539;
        let t550: f64 = t548 + t549;
        let t551: f64 = x5 * t540;
        let t552: f64 = t550 - t551;
        let t553: f64 = x6 * t538;
        let t554: f64 = x5 - t553;
        let t555: f64 = x3 * t539;
        let t556: f64 = t554 + t555;
        let t557: f64 = x4 * t540;
        let t558: f64 = t556 + t557;
        let t559: f64 = x5 * t538;
        let t560: f64 = x6 + t559;
        let t561: f64 = x4 * t539;
        let t562: f64 = t560 - t561;
        let t563: f64 = x3 * t540;
        let t564: f64 = t562 + t563;
        let t565: f64 = t546 * t546;
        let t566: f64 = t552 * t552;
        let t567: f64 = t565 + t566;
        let t568: f64 = t558 * t558;
        let t569: f64 = t567 + t568;
        let t570: f64 = t564 * t564;
        let t571: f64 = t569 + t570;
        let t572: f64 = root(t571);
        let t573: f64 = 1.0 / t572;
        let t574: f64 = t546 * t573;
        let t575: f64 = t552 * t573;
        let t576: f64 = t558 * t573;
        let t577: f64 = t564 * t573;
        let t578: f64 = x7 + d6;
        let t579: f64 = x8 + d7;
        let t580: f64 = x9 + d8;
        let y0: f64 = t535;
        let y1: f64 = t536;
        let y2: f64 = t537;
        let y3: f64 = t574;
        let y4: f64 = t575;
        let y5: f64 = t576;
        let y6: f64 = t577;
        let y7: f64 = t578;
        let y8: f64 = t579;
        let y9: f64 = t580;
        turn(y0 - x0, &mut s0, &mut c0);
        turn(y1 - x1, &mut s1, &mut c1);
        turn(y2 - x2, &mut s2, &mut c2);
        x0 = y0;
        x1 = y1;
        x2 = y2;
        x3 = y3;
        x4 = y4;
        x5 = y5;
        x6 = y6;
        x7 = y7;
        x8 = y8;
        x9 = y9;
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
    numbers.iter().all(|&x| absolute(x) < 1e5)
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
