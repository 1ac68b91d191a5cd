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

pub const INPUTS: usize = 3;
pub const STATE: usize = 10;
/// From this number on the state follows from the numbers before it.
pub const ITERATED: usize = 3;
pub const UNKNOWNS: usize = 9;
pub const ROWS: usize = 9;
/// Number of rows of the iteration.
pub const EQUATIONS: usize = 3;
/// Number of unknowns of the iteration.
pub const STEPS: usize = 3;
pub const FRAMES: usize = 0;
/// Number of signs of the closed form, each for two solutions.
pub const SIGNS: usize = 0;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The largest row accepted where a step makes it no smaller, by rounding.
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
    let t73: f64 = u1 * t65;
    let t74: f64 = (-0.4999999999999998) * t73;
    let t76: f64 = 0.8660254037844388 * t73;
    let t78: f64 = u1 * t66;
    let t79: f64 = (-0.4999999999999998) - t74;
    let t80: f64 = 0.8660254037844388 - t76;
    let t81: f64 = (-0.2499999999999999) * t42;
    let t82: f64 = (-0.2499999999999999) * t43;
    let t83: f64 = (-0.2499999999999999) * t44;
    let t84: f64 = 0.4330127018922194 * t45;
    let t85: f64 = 0.4330127018922194 * t47;
    let t86: f64 = 0.4330127018922194 * t48;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = t83 + t86;
    let t90: f64 = x7 + t87;
    let t91: f64 = x8 + t88;
    let t92: f64 = x9 + t89;
    let (t93, t94) = sine_cosine(x2);
    let t101: f64 = u2 * t93;
    let t102: f64 = (-0.5000000000000004) * t101;
    let t104: f64 = (-0.8660254037844384) * t101;
    let t106: f64 = u2 * t94;
    let t107: f64 = (-0.5000000000000004) - t102;
    let t108: f64 = (-0.8660254037844384) - t104;
    let t109: f64 = (-0.2500000000000002) * t42;
    let t110: f64 = (-0.2500000000000002) * t43;
    let t111: f64 = (-0.2500000000000002) * t44;
    let t112: f64 = (-0.4330127018922192) * t45;
    let t113: f64 = (-0.4330127018922192) * t47;
    let t114: f64 = (-0.4330127018922192) * t48;
    let t115: f64 = t109 + t112;
    let t116: f64 = t110 + t113;
    let t117: f64 = t111 + t114;
    let t118: f64 = x7 + t115;
    let t119: f64 = x8 + t116;
    let t120: f64 = x9 + t117;
    let t121: f64 = t62 - t58;
    let t122: f64 = t64 - t57;
    let t124: f64 = -t60;
    let t125: f64 = -t61;
    let t126: f64 = -t59;
    let t127: f64 = t90 - t79;
    let t128: f64 = t91 - t80;
    let t129: f64 = t92 - t78;
    let t130: f64 = 0.4999999999999998 * t78;
    let t131: f64 = 0.8660254037844388 * t78;
    let t140: f64 = -t130;
    let t141: f64 = -t88;
    let t142: f64 = -t89;
    let t143: f64 = -t87;
    let t144: f64 = t118 - t107;
    let t145: f64 = t119 - t108;
    let t146: f64 = t120 - t106;
    let t147: f64 = 0.5000000000000004 * t106;
    let t148: f64 = (-0.8660254037844384) * t106;
    let t157: f64 = -t147;
    let t158: f64 = -t116;
    let t159: f64 = -t117;
    let t160: f64 = -t115;
    r[0] = t121;
    r[1] = t63;
    r[2] = t122;
    r[3] = t127;
    r[4] = t128;
    r[5] = t129;
    r[6] = t144;
    r[7] = t145;
    r[8] = t146;
    j[0][0] = t57;
    j[0][1] = 0.0;
    j[0][2] = 0.0;
    j[0][3] = 0.0;
    j[0][4] = t61;
    j[0][5] = t124;
    j[0][6] = 1.0;
    j[0][7] = 0.0;
    j[0][8] = 0.0;
    j[1][0] = 0.0;
    j[1][1] = 0.0;
    j[1][2] = 0.0;
    j[1][3] = t125;
    j[1][4] = 0.0;
    j[1][5] = t59;
    j[1][6] = 0.0;
    j[1][7] = 1.0;
    j[1][8] = 0.0;
    j[2][0] = t55;
    j[2][1] = 0.0;
    j[2][2] = 0.0;
    j[2][3] = t60;
    j[2][4] = t126;
    j[2][5] = 0.0;
    j[2][6] = 0.0;
    j[2][7] = 0.0;
    j[2][8] = 1.0;
    j[3][0] = 0.0;
    j[3][1] = t140;
    j[3][2] = 0.0;
    j[3][3] = 0.0;
    j[3][4] = t89;
    j[3][5] = t141;
    j[3][6] = 1.0;
    j[3][7] = 0.0;
    j[3][8] = 0.0;
    j[4][0] = 0.0;
    j[4][1] = t131;
    j[4][2] = 0.0;
    j[4][3] = t142;
    j[4][4] = 0.0;
    j[4][5] = t87;
    j[4][6] = 0.0;
    j[4][7] = 1.0;
    j[4][8] = 0.0;
    j[5][0] = 0.0;
    j[5][1] = t73;
    j[5][2] = 0.0;
    j[5][3] = t88;
    j[5][4] = t143;
    j[5][5] = 0.0;
    j[5][6] = 0.0;
    j[5][7] = 0.0;
    j[5][8] = 1.0;
    j[6][0] = 0.0;
    j[6][1] = 0.0;
    j[6][2] = t157;
    j[6][3] = 0.0;
    j[6][4] = t117;
    j[6][5] = t158;
    j[6][6] = 1.0;
    j[6][7] = 0.0;
    j[6][8] = 0.0;
    j[7][0] = 0.0;
    j[7][1] = 0.0;
    j[7][2] = t148;
    j[7][3] = t159;
    j[7][4] = 0.0;
    j[7][5] = t115;
    j[7][6] = 0.0;
    j[7][7] = 1.0;
    j[7][8] = 0.0;
    j[8][0] = 0.0;
    j[8][1] = 0.0;
    j[8][2] = t101;
    j[8][3] = t116;
    j[8][4] = t160;
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
    let t802: f64 = x0 + d0;
    let t803: f64 = x1 + d1;
    let t804: f64 = x2 + d2;
    let t805: f64 = 0.5 * d3;
    let t806: f64 = 0.5 * d4;
    let t807: f64 = 0.5 * d5;
    let t808: f64 = x4 * t805;
    let t809: f64 = x3 - t808;
    let t810: f64 = x5 * t806;
    let t811: f64 = t809 - t810;
    let t812: f64 = x6 * t807;
    let t813: f64 = t811 - t812;
    let t814: f64 = x3 * t805;
    let t815: f64 = x4 + t814;
    let t816: f64 = x6 * t806;
    let t817: f64 = t815 + t816;
    let t818: f64 = x5 * t807;
    let t819: f64 = t817 - t818;
    let t820: f64 = x6 * t805;
    let t821: f64 = x5 - t820;
    let t822: f64 = x3 * t806;
    let t823: f64 = t821 + t822;
    let t824: f64 = x4 * t807;
    let t825: f64 = t823 + t824;
    let t826: f64 = x5 * t805;
    let t827: f64 = x6 + t826;
    let t828: f64 = x4 * t806;
    let t829: f64 = t827 - t828;
    let t830: f64 = x3 * t807;
    let t831: f64 = t829 + t830;
    let t832: f64 = t813 * t813;
    let t833: f64 = t819 * t819;
    let t834: f64 = t832 + t833;
    let t835: f64 = t825 * t825;
    let t836: f64 = t834 + t835;
    let t837: f64 = t831 * t831;
    let t838: f64 = t836 + t837;
    let t840: f64 = inverse_root(t838);
    let t841: f64 = t813 * t840;
    let t842: f64 = t819 * t840;
    let t843: f64 = t825 * t840;
    let t844: f64 = t831 * t840;
    let t845: f64 = x7 + d6;
    let t846: f64 = x8 + d7;
    let t847: f64 = x9 + d8;
    y[0] = t802;
    y[1] = t803;
    y[2] = t804;
    y[3] = t841;
    y[4] = t842;
    y[5] = t843;
    y[6] = t844;
    y[7] = t845;
    y[8] = t846;
    y[9] = t847;
}

/// The rows r of the iteration and their Jacobian.
fn slopes(
    u: &[f64; INPUTS],
    x: &[f64; STATE],
    r: &mut [f64; EQUATIONS],
    j: &mut [[f64; STEPS]; EQUATIONS],
) {
    let u0: f64 = u[0];
    let u1: f64 = u[1];
    let u2: f64 = u[2];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let (t52, t53) = sine_cosine(x0);
    let t55: f64 = u0 * t52;
    let t57: f64 = u0 * t53;
    let t58: f64 = 1.0 - t55;
    let (t65, t66) = sine_cosine(x1);
    let t73: f64 = u1 * t65;
    let t74: f64 = (-0.4999999999999998) * t73;
    let t76: f64 = 0.8660254037844388 * t73;
    let t78: f64 = u1 * t66;
    let t79: f64 = (-0.4999999999999998) - t74;
    let t80: f64 = 0.8660254037844388 - t76;
    let (t93, t94) = sine_cosine(x2);
    let t101: f64 = u2 * t93;
    let t102: f64 = (-0.5000000000000004) * t101;
    let t104: f64 = (-0.8660254037844384) * t101;
    let t106: f64 = u2 * t94;
    let t107: f64 = (-0.5000000000000004) - t102;
    let t108: f64 = (-0.8660254037844384) - t104;
    let t130: f64 = 0.4999999999999998 * t78;
    let t131: f64 = 0.8660254037844388 * t78;
    let t147: f64 = 0.5000000000000004 * t106;
    let t148: f64 = (-0.8660254037844384) * t106;
    let t574: f64 = t79 - t58;
    let t575: f64 = t78 - t57;
    let t679: f64 = t574 * t574;
    let t680: f64 = t80 * t80;
    let t681: f64 = t679 + t680;
    let t682: f64 = t575 * t575;
    let t683: f64 = t681 + t682;
    let t685: f64 = t683 - 0.7499999999999999;
    let t686: f64 = 0.5 * t685;
    let t687: f64 = t57 * t574;
    let t689: f64 = t55 * t575;
    let t691: f64 = t687 + t689;
    let t693: f64 = t130 * t574;
    let t694: f64 = t80 * t131;
    let t696: f64 = t693 - t694;
    let t697: f64 = t73 * t575;
    let t699: f64 = t696 - t697;
    let t700: f64 = t107 - t79;
    let t701: f64 = t108 - t80;
    let t702: f64 = t106 - t78;
    let t703: f64 = t700 * t700;
    let t704: f64 = t701 * t701;
    let t705: f64 = t703 + t704;
    let t706: f64 = t702 * t702;
    let t707: f64 = t705 + t706;
    let t708: f64 = t707 - 0.7499999999999999;
    let t709: f64 = 0.5 * t708;
    let t710: f64 = t130 * t700;
    let t711: f64 = t131 * t701;
    let t713: f64 = t710 - t711;
    let t714: f64 = t73 * t702;
    let t717: f64 = t714 - t713;
    let t718: f64 = t147 * t700;
    let t719: f64 = t148 * t701;
    let t721: f64 = t718 - t719;
    let t722: f64 = t101 * t702;
    let t724: f64 = t721 - t722;
    let t725: f64 = t58 - t107;
    let t726: f64 = t104 - (-0.8660254037844384);
    let t727: f64 = t57 - t106;
    let t728: f64 = t725 * t725;
    let t729: f64 = t726 * t726;
    let t730: f64 = t728 + t729;
    let t731: f64 = t727 * t727;
    let t732: f64 = t730 + t731;
    let t733: f64 = t732 - 0.7500000000000003;
    let t734: f64 = 0.5 * t733;
    let t735: f64 = t147 * t725;
    let t736: f64 = t148 * t726;
    let t738: f64 = t735 - t736;
    let t739: f64 = t101 * t727;
    let t742: f64 = t739 - t738;
    let t743: f64 = t57 * t725;
    let t745: f64 = t55 * t727;
    let t747: f64 = t743 + t745;
    let t748: f64 = -t747;
    r[0] = t686;
    r[1] = t709;
    r[2] = t734;
    j[0][0] = t691;
    j[0][1] = t699;
    j[0][2] = 0.0;
    j[1][0] = 0.0;
    j[1][1] = t717;
    j[1][2] = t724;
    j[2][0] = t748;
    j[2][1] = 0.0;
    j[2][2] = t742;
}

/// The square of the distance between inputs u with a state x and inputs v with a state y, in rad and
/// characteristic lengths, as far as the Jacobian depends on them.
#[inline(always)]
fn apart(u: &[f64; INPUTS], x: &[f64; STATE], v: &[f64; INPUTS], y: &[f64; STATE]) -> f64 {
    let a0: f64 = u[0] - v[0];
    let a1: f64 = u[1] - v[1];
    let a2: f64 = u[2] - v[2];
    let b0: f64 = x[0] - y[0];
    let b1: f64 = x[1] - y[1];
    let b2: f64 = x[2] - y[2];
    return a0 * a0 + a1 * a1 + a2 * a2 + b0 * b0 + b1 * b1 + b2 * b2;
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
    let u1: f64 = u[1];
    let u2: f64 = u[2];
    let mut x0: f64 = x[0];
    let mut x1: f64 = x[1];
    let mut x2: f64 = x[2];
    let (mut s0, mut c0) = sine_cosine(x0);
    let (mut s1, mut c1) = sine_cosine(x1);
    let (mut s2, mut c2) = sine_cosine(x2);
    let mut last: f64 = LARGE;
    for _ in 0..MOST_STEPS {
        let t55: f64 = u0 * s0;
        let t57: f64 = u0 * c0;
        let t58: f64 = 1.0 - t55;
        let t73: f64 = u1 * s1;
        let t74: f64 = (-0.4999999999999998) * t73;
        let t76: f64 = 0.8660254037844388 * t73;
        let t78: f64 = u1 * c1;
        let t79: f64 = (-0.4999999999999998) - t74;
        let t80: f64 = 0.8660254037844388 - t76;
        let t101: f64 = u2 * s2;
        let t102: f64 = (-0.5000000000000004) * t101;
        let t104: f64 = (-0.8660254037844384) * t101;
        let t106: f64 = u2 * c2;
        let t107: f64 = (-0.5000000000000004) - t102;
        let t108: f64 = (-0.8660254037844384) - t104;
        let t574: f64 = t79 - t58;
        let t575: f64 = t78 - t57;
        let t679: f64 = t574 * t574;
        let t680: f64 = t80 * t80;
        let t681: f64 = t679 + t680;
        let t682: f64 = t575 * t575;
        let t683: f64 = t681 + t682;
        let t685: f64 = t683 - 0.7499999999999999;
        let t686: f64 = 0.5 * t685;
        let t700: f64 = t107 - t79;
        let t701: f64 = t108 - t80;
        let t702: f64 = t106 - t78;
        let t703: f64 = t700 * t700;
        let t704: f64 = t701 * t701;
        let t705: f64 = t703 + t704;
        let t706: f64 = t702 * t702;
        let t707: f64 = t705 + t706;
        let t708: f64 = t707 - 0.7499999999999999;
        let t709: f64 = 0.5 * t708;
        let t725: f64 = t58 - t107;
        let t726: f64 = t104 - (-0.8660254037844384);
        let t727: f64 = t57 - t106;
        let t728: f64 = t725 * t725;
        let t729: f64 = t726 * t726;
        let t730: f64 = t728 + t729;
        let t731: f64 = t727 * t727;
        let t732: f64 = t730 + t731;
        let t733: f64 = t732 - 0.7500000000000003;
        let t734: f64 = 0.5 * t733;
        let mut size: f64 = 0.0;
        size = larger(size, 10.886621079036352 * t686);
        size = larger(size, 10.886621079036352 * t709);
        size = larger(size, 10.886621079036352 * t734);
        if size <= TOLERANCE || size <= ROUNDING && !(size < HALF * last) {
            let x3: f64 = x[3];
            let x4: f64 = x[4];
            let x5: f64 = x[5];
            let x6: f64 = x[6];
            let t576: f64 = t107 - t58;
            let t577: f64 = t106 - t57;
            let t578: f64 = t80 * t577;
            let t579: f64 = t108 * t575;
            let t580: f64 = t578 - t579;
            let t581: f64 = t575 * t576;
            let t582: f64 = t574 * t577;
            let t583: f64 = t581 - t582;
            let t584: f64 = t108 * t574;
            let t585: f64 = t80 * t576;
            let t586: f64 = t584 - t585;
            let t588: f64 = (-0.6666666666666665) * t574;
            let t589: f64 = (-0.6666666666666665) * t80;
            let t590: f64 = (-0.6666666666666665) * t575;
            let t592: f64 = (-0.6666666666666667) * t576;
            let t593: f64 = (-0.6666666666666667) * t108;
            let t594: f64 = (-0.6666666666666667) * t577;
            let t595: f64 = t588 + t592;
            let t596: f64 = t589 + t593;
            let t597: f64 = t590 + t594;
            let t599: f64 = 1.154700538379252 * t574;
            let t600: f64 = 1.154700538379252 * t80;
            let t601: f64 = 1.154700538379252 * t575;
            let t603: f64 = (-1.1547005383792515) * t576;
            let t604: f64 = (-1.1547005383792515) * t108;
            let t605: f64 = (-1.1547005383792515) * t577;
            let t606: f64 = t599 + t603;
            let t607: f64 = t600 + t604;
            let t608: f64 = t601 + t605;
            let t610: f64 = 1.539600717839002 * t580;
            let t611: f64 = 1.539600717839002 * t583;
            let t612: f64 = 1.539600717839002 * t586;
            let t613: f64 = 0.5 * t595;
            let t614: f64 = 0.5 * t596;
            let t615: f64 = 0.5 * t597;
            let t616: f64 = t608 - t611;
            let t617: f64 = t610 - t597;
            let t618: f64 = t596 - t606;
            let t619: f64 = t596 + t606;
            let t620: f64 = t597 + t610;
            let t621: f64 = t608 + t611;
            let t622: f64 = 1.0 + t595;
            let t623: f64 = t607 + t622;
            let t624: f64 = t612 + t623;
            let t625: f64 = t622 - t607;
            let t626: f64 = t625 - t612;
            let t627: f64 = 1.0 - t595;
            let t628: f64 = t607 + t627;
            let t629: f64 = t628 - t612;
            let t630: f64 = t627 - t607;
            let t631: f64 = t612 + t630;
            let t632: f64 = x3 * t624;
            let t633: f64 = x4 * t616;
            let t634: f64 = t632 + t633;
            let t635: f64 = x5 * t617;
            let t636: f64 = x6 * t618;
            let t637: f64 = t635 + t636;
            let t638: f64 = t634 + t637;
            let t639: f64 = x3 * t616;
            let t640: f64 = x4 * t626;
            let t641: f64 = t639 + t640;
            let t642: f64 = x5 * t619;
            let t643: f64 = x6 * t620;
            let t644: f64 = t642 + t643;
            let t645: f64 = t641 + t644;
            let t646: f64 = x3 * t617;
            let t647: f64 = x4 * t619;
            let t648: f64 = t646 + t647;
            let t649: f64 = x5 * t629;
            let t650: f64 = x6 * t621;
            let t651: f64 = t649 + t650;
            let t652: f64 = t648 + t651;
            let t653: f64 = x3 * t618;
            let t654: f64 = x4 * t620;
            let t655: f64 = t653 + t654;
            let t656: f64 = x5 * t621;
            let t657: f64 = x6 * t631;
            let t658: f64 = t656 + t657;
            let t659: f64 = t655 + t658;
            let t660: f64 = x3 * t638;
            let t661: f64 = x4 * t645;
            let t662: f64 = t660 + t661;
            let t663: f64 = x5 * t652;
            let t664: f64 = x6 * t659;
            let t665: f64 = t663 + t664;
            let t666: f64 = t662 + t665;
            let t668: f64 = 0.25 * t666;
            let t670: f64 = 0.25 * inverse_root(t668);
            let t671: f64 = t638 * t670;
            let t672: f64 = t645 * t670;
            let t673: f64 = t652 * t670;
            let t674: f64 = t659 * t670;
            let t675: f64 = t58 - t613;
            let t676: f64 = -t614;
            let t677: f64 = t57 - t615;
            if !(absolute(t668) > 5000.0 * LEAST_PIVOT) { return false; }
            x[0] = x0;
            x[1] = x1;
            x[2] = x2;
            x[3] = t671;
            x[4] = t672;
            x[5] = t673;
            x[6] = t674;
            x[7] = t675;
            x[8] = t676;
            x[9] = t677;
            return true;
        }
        /* a step that does not halve the rows is not to be trusted */
        if !(size < HALF * last) { return false; }
        last = size;
        let t130: f64 = 0.4999999999999998 * t78;
        let t131: f64 = 0.8660254037844388 * t78;
        let t147: f64 = 0.5000000000000004 * t106;
        let t148: f64 = (-0.8660254037844384) * t106;
        let t687: f64 = t57 * t574;
        let t689: f64 = t55 * t575;
        let t691: f64 = t687 + t689;
        let t693: f64 = t130 * t574;
        let t694: f64 = t80 * t131;
        let t696: f64 = t693 - t694;
        let t697: f64 = t73 * t575;
        let t699: f64 = t696 - t697;
        let t710: f64 = t130 * t700;
        let t711: f64 = t131 * t701;
        let t713: f64 = t710 - t711;
        let t714: f64 = t73 * t702;
        let t717: f64 = t714 - t713;
        let t718: f64 = t147 * t700;
        let t719: f64 = t148 * t701;
        let t721: f64 = t718 - t719;
        let t722: f64 = t101 * t702;
        let t724: f64 = t721 - t722;
        let t735: f64 = t147 * t725;
        let t736: f64 = t148 * t726;
        let t738: f64 = t735 - t736;
        let t739: f64 = t101 * t727;
        let t742: f64 = t739 - t738;
        let t743: f64 = t57 * t725;
        let t745: f64 = t55 * t727;
        let t747: f64 = t743 + t745;
        let t749: f64 = t717 * t742;
        let t750: f64 = t699 * t742;
        let t752: f64 = t699 * t724;
        let t753: f64 = t724 * t747;
        let t755: f64 = t691 * t742;
        let t756: f64 = t691 * t724;
        let t758: f64 = t717 * t747;
        let t760: f64 = t699 * t747;
        let t762: f64 = t691 * t717;
        let t763: f64 = t691 * t749;
        let t764: f64 = t699 * t753;
        let t766: f64 = t763 - t764;
        let t767: f64 = 1.0 / t766;
        let t768: f64 = t686 * t749;
        let t769: f64 = t709 * t750;
        let t771: f64 = t768 - t769;
        let t772: f64 = t734 * t752;
        let t773: f64 = t771 + t772;
        let t774: f64 = t767 * t773;
        let t775: f64 = t686 * t753;
        let t777: f64 = t709 * t755;
        let t778: f64 = t777 - t775;
        let t779: f64 = t734 * t756;
        let t781: f64 = t778 - t779;
        let t782: f64 = t767 * t781;
        let t783: f64 = t686 * t758;
        let t784: f64 = t709 * t760;
        let t786: f64 = t783 - t784;
        let t787: f64 = t734 * t762;
        let t788: f64 = t786 + t787;
        let t789: f64 = t767 * t788;
        let t790: f64 = -t774;
        let t791: f64 = -t782;
        let t792: f64 = -t789;
        if !(absolute(t766) > 0.21937500000000032 * LEAST_PIVOT) { return false; }
        let d0: f64 = t790;
        let d1: f64 = t791;
        let d2: f64 = t792;
        let mut longest: f64 = 0.0;
        longest = larger(longest, d0);
        longest = larger(longest, d1);
        longest = larger(longest, d2);
        if !(longest <= LONGEST_STEP) { return false; }
        let t802: f64 = x0 + d0;
        let t803: f64 = x1 + d1;
        let t804: f64 = x2 + d2;
        turn(d0, longest, &mut s0, &mut c0);
        turn(d1, longest, &mut s1, &mut c1);
        turn(d2, longest, &mut s2, &mut c2);
        let y0: f64 = t802;
        let y1: f64 = t803;
        let y2: f64 = t804;
        x0 = y0;
        x1 = y1;
        x2 = y2;
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
    const CURVATURE: f64 = 3.393266518073814;
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
    const UNKNOWN: [usize; STEPS] = [0, 1, 2];
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

/// True if all numbers are finite and of a size that sines take.
fn near(numbers: &[f64]) -> bool {
    // of all, without a branch for each
    numbers.iter().fold(true, |near, &x| near & (absolute(x) < 1e5))
}

/// True if the joints are within their limits.
#[inline]
pub fn within_limits(u: &[f64; INPUTS], x: &[f64; STATE]) -> bool {
    const ROUNDING: f64 = 1e-9;
    if !((u[0] >= 0.3 - ROUNDING) & (u[0] <= 1.2 + ROUNDING) & (u[1] >= 0.3 - ROUNDING) & (u[1] <= 1.2 + ROUNDING) & (u[2] >= 0.3 - ROUNDING) & (u[2] <= 1.2 + ROUNDING)) { return false; }
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
    let u1: f64 = u[1];
    let u2: f64 = u[2];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
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
    let t59: f64 = 0.5 * t42;
    let t60: f64 = 0.5 * t43;
    let t61: f64 = 0.5 * t44;
    let (t65, t66) = sine_cosine(x1);
    let t67: f64 = (-0.4999999999999998) * t65;
    let t68: f64 = 0.8660254037844388 * t65;
    let t73: f64 = u1 * t65;
    let t78: f64 = u1 * t66;
    let t81: f64 = (-0.2499999999999999) * t42;
    let t82: f64 = (-0.2499999999999999) * t43;
    let t83: f64 = (-0.2499999999999999) * t44;
    let t84: f64 = 0.4330127018922194 * t45;
    let t85: f64 = 0.4330127018922194 * t47;
    let t86: f64 = 0.4330127018922194 * t48;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = t83 + t86;
    let (t93, t94) = sine_cosine(x2);
    let t95: f64 = (-0.5000000000000004) * t93;
    let t96: f64 = (-0.8660254037844384) * t93;
    let t101: f64 = u2 * t93;
    let t106: f64 = u2 * t94;
    let t109: f64 = (-0.2500000000000002) * t42;
    let t110: f64 = (-0.2500000000000002) * t43;
    let t111: f64 = (-0.2500000000000002) * t44;
    let t112: f64 = (-0.4330127018922192) * t45;
    let t113: f64 = (-0.4330127018922192) * t47;
    let t114: f64 = (-0.4330127018922192) * t48;
    let t115: f64 = t109 + t112;
    let t116: f64 = t110 + t113;
    let t117: f64 = t111 + t114;
    let t130: f64 = 0.4999999999999998 * t78;
    let t131: f64 = 0.8660254037844388 * t78;
    let t147: f64 = 0.5000000000000004 * t106;
    let t148: f64 = (-0.8660254037844384) * t106;
    let t166: f64 = 1.0 / t57;
    let t167: f64 = t55 * t166;
    let t168: f64 = t61 * t167;
    let t169: f64 = t59 + t168;
    let t171: f64 = t60 * t167;
    let t176: f64 = t52 * t167;
    let t177: f64 = t53 + t176;
    let t179: f64 = t61 - t89;
    let t180: f64 = t87 - t59;
    let t182: f64 = t61 - t117;
    let t183: f64 = t115 - t59;
    let t185: f64 = 1.0 / t131;
    let t186: f64 = t130 * t185;
    let t188: f64 = t179 * t186;
    let t190: f64 = t180 * t186;
    let t192: f64 = t190 - t88;
    let t196: f64 = t68 * t186;
    let t198: f64 = t67 + t196;
    let t199: f64 = t73 * t185;
    let t200: f64 = t179 * t199;
    let t201: f64 = t88 - t200;
    let t202: f64 = t180 * t199;
    let t206: f64 = t68 * t199;
    let t207: f64 = t66 + t206;
    let t209: f64 = 1.0 / t148;
    let t210: f64 = t147 * t209;
    let t212: f64 = t182 * t210;
    let t214: f64 = t183 * t210;
    let t216: f64 = t214 - t116;
    let t220: f64 = t96 * t210;
    let t222: f64 = t95 + t220;
    let t223: f64 = t101 * t209;
    let t224: f64 = t182 * t223;
    let t225: f64 = t116 - t224;
    let t226: f64 = t183 * t223;
    let t230: f64 = t96 * t223;
    let t231: f64 = t94 + t230;
    let t233: f64 = t167 * t188;
    let t235: f64 = t60 + t233;
    let t236: f64 = t89 * t167;
    let t238: f64 = t236 - t169;
    let t239: f64 = t167 * t192;
    let t241: f64 = t171 + t239;
    let t245: f64 = t167 * t198;
    let t247: f64 = t212 - t188;
    let t248: f64 = t117 - t89;
    let t249: f64 = t216 - t192;
    let t252: f64 = t201 - t235;
    let t253: f64 = t87 + t238;
    let t255: f64 = t202 + t241;
    let t258: f64 = t207 + t245;
    let t260: f64 = t225 - t235;
    let t261: f64 = t115 + t238;
    let t263: f64 = t226 + t241;
    let t266: f64 = t248 * t263;
    let t268: f64 = t249 * t261;
    let t270: f64 = t268 - t266;
    let t271: f64 = t253 * t263;
    let t272: f64 = t255 * t261;
    let t274: f64 = t272 - t271;
    let t275: f64 = t249 * t253;
    let t277: f64 = t248 * t255;
    let t279: f64 = t277 - t275;
    let t280: f64 = t247 * t263;
    let t282: f64 = t249 * t260;
    let t283: f64 = t280 + t282;
    let t285: f64 = t252 * t263;
    let t287: f64 = t255 * t260;
    let t289: f64 = t287 - t285;
    let t290: f64 = t249 * t252;
    let t291: f64 = t247 * t255;
    let t293: f64 = t290 + t291;
    let t295: f64 = t247 * t261;
    let t297: f64 = t248 * t260;
    let t298: f64 = t295 + t297;
    let t300: f64 = t252 * t261;
    let t302: f64 = t253 * t260;
    let t305: f64 = t300 - t302;
    let t306: f64 = t248 * t252;
    let t307: f64 = t247 * t253;
    let t309: f64 = t306 + t307;
    let t310: f64 = t252 * t270;
    let t311: f64 = t253 * t283;
    let t313: f64 = t310 - t311;
    let t314: f64 = t255 * t298;
    let t315: f64 = t313 + t314;
    let t316: f64 = 1.0 / t315;
    let t371: f64 = t177 * t270;
    let t372: f64 = t177 * t279;
    let t373: f64 = t371 + t372;
    let t374: f64 = t316 * t373;
    let t375: f64 = t177 * t283;
    let t376: f64 = t177 * t293;
    let t378: f64 = t375 - t376;
    let t379: f64 = t316 * t378;
    let t380: f64 = t177 * t298;
    let t382: f64 = t177 * t309;
    let t383: f64 = t382 - t380;
    let t384: f64 = t316 * t383;
    let t385: f64 = t241 * t384;
    let t386: f64 = t177 + t385;
    let t388: f64 = t238 * t379;
    let t389: f64 = t386 + t388;
    let t391: f64 = t235 * t374;
    let t392: f64 = t389 + t391;
    let t394: f64 = t192 * t384;
    let t396: f64 = t89 * t379;
    let t397: f64 = t394 + t396;
    let t399: f64 = t188 * t374;
    let t400: f64 = t397 + t399;
    let t402: f64 = t183 * t384;
    let t404: f64 = t182 * t374;
    let t405: f64 = t402 + t404;
    let t407: f64 = t209 * t405;
    let t409: f64 = t180 * t384;
    let t411: f64 = t179 * t374;
    let t412: f64 = t409 + t411;
    let t414: f64 = t185 * t412;
    let t416: f64 = t59 * t384;
    let t418: f64 = t61 * t374;
    let t421: f64 = t52 + t400;
    let t422: f64 = t60 * t384;
    let t424: f64 = t421 + t422;
    let t425: f64 = t61 * t379;
    let t426: f64 = t424 - t425;
    let t427: f64 = t166 * t426;
    let t428: f64 = t258 * t270;
    let t430: f64 = t198 * t274;
    let t432: f64 = t428 + t430;
    let t434: f64 = t245 * t279;
    let t436: f64 = t432 + t434;
    let t438: f64 = t316 * t436;
    let t440: f64 = t258 * t283;
    let t442: f64 = t198 * t289;
    let t444: f64 = t440 + t442;
    let t446: f64 = t245 * t293;
    let t447: f64 = t446 - t444;
    let t448: f64 = t316 * t447;
    let t449: f64 = t258 * t298;
    let t450: f64 = t198 * t305;
    let t452: f64 = t449 - t450;
    let t453: f64 = t245 * t309;
    let t455: f64 = t452 - t453;
    let t456: f64 = t316 * t455;
    let t457: f64 = t241 * t456;
    let t458: f64 = t245 - t457;
    let t459: f64 = t238 * t448;
    let t460: f64 = t458 - t459;
    let t461: f64 = t235 * t438;
    let t463: f64 = t460 + t461;
    let t464: f64 = t192 * t456;
    let t465: f64 = t198 - t464;
    let t466: f64 = t89 * t448;
    let t467: f64 = t465 - t466;
    let t468: f64 = t188 * t438;
    let t470: f64 = t467 + t468;
    let t471: f64 = t183 * t456;
    let t473: f64 = t182 * t438;
    let t475: f64 = t473 - t471;
    let t476: f64 = t209 * t475;
    let t477: f64 = t180 * t456;
    let t478: f64 = t68 - t477;
    let t479: f64 = t179 * t438;
    let t481: f64 = t478 + t479;
    let t482: f64 = t185 * t481;
    let t483: f64 = t59 * t456;
    let t485: f64 = t61 * t438;
    let t486: f64 = t483 + t485;
    let t488: f64 = -t470;
    let t489: f64 = t60 * t456;
    let t491: f64 = t489 - t470;
    let t492: f64 = t61 * t448;
    let t493: f64 = t491 - t492;
    let t494: f64 = t166 * t493;
    let t495: f64 = t222 * t274;
    let t496: f64 = t231 * t279;
    let t498: f64 = t495 - t496;
    let t499: f64 = t316 * t498;
    let t500: f64 = t222 * t289;
    let t501: f64 = t231 * t293;
    let t502: f64 = t500 + t501;
    let t503: f64 = t316 * t502;
    let t504: f64 = t222 * t305;
    let t505: f64 = t231 * t309;
    let t507: f64 = t504 - t505;
    let t508: f64 = t316 * t507;
    let t509: f64 = t241 * t508;
    let t511: f64 = t238 * t503;
    let t512: f64 = t509 + t511;
    let t514: f64 = t235 * t499;
    let t515: f64 = t512 + t514;
    let t517: f64 = t192 * t508;
    let t519: f64 = t89 * t503;
    let t520: f64 = t517 + t519;
    let t522: f64 = t188 * t499;
    let t523: f64 = t520 + t522;
    let t525: f64 = t183 * t508;
    let t526: f64 = t96 - t525;
    let t527: f64 = t182 * t499;
    let t528: f64 = t526 - t527;
    let t529: f64 = t209 * t528;
    let t530: f64 = t180 * t508;
    let t532: f64 = t179 * t499;
    let t533: f64 = t530 + t532;
    let t535: f64 = t185 * t533;
    let t537: f64 = t59 * t508;
    let t539: f64 = t61 * t499;
    let t542: f64 = t60 * t508;
    let t544: f64 = t523 + t542;
    let t545: f64 = t61 * t503;
    let t546: f64 = t544 - t545;
    let t547: f64 = t166 * t546;
    let t557: f64 = -t427;
    let t561: f64 = t416 - t418;
    let t562: f64 = -t494;
    let t563: f64 = -t482;
    let t564: f64 = -t476;
    let t567: f64 = -t463;
    let t568: f64 = -t547;
    let t569: f64 = -t529;
    let t573: f64 = t537 - t539;
    let t848: f64 = 0.5 * t374;
    let t850: f64 = 0.5 * t379;
    let t852: f64 = 0.5 * t384;
    let t854: f64 = x4 * t848;
    let t856: f64 = x5 * t850;
    let t858: f64 = t854 + t856;
    let t859: f64 = x6 * t852;
    let t861: f64 = t858 + t859;
    let t862: f64 = x3 * t848;
    let t864: f64 = x6 * t850;
    let t866: f64 = t862 + t864;
    let t868: f64 = x5 * t852;
    let t870: f64 = t868 - t866;
    let t871: f64 = x6 * t848;
    let t873: f64 = x3 * t850;
    let t875: f64 = t871 - t873;
    let t876: f64 = x4 * t852;
    let t878: f64 = t875 - t876;
    let t879: f64 = x5 * t848;
    let t881: f64 = x4 * t850;
    let t883: f64 = t881 - t879;
    let t884: f64 = x3 * t852;
    let t886: f64 = t883 - t884;
    let t887: f64 = x3 * x3;
    let t888: f64 = x3 * t861;
    let t889: f64 = t888 + t888;
    let t890: f64 = x4 * x4;
    let t891: f64 = x4 * t870;
    let t892: f64 = t891 + t891;
    let t893: f64 = t887 + t890;
    let t894: f64 = t889 + t892;
    let t895: f64 = x5 * x5;
    let t896: f64 = x5 * t878;
    let t897: f64 = t896 + t896;
    let t898: f64 = t893 + t895;
    let t899: f64 = t894 + t897;
    let t900: f64 = x6 * x6;
    let t901: f64 = x6 * t886;
    let t902: f64 = t901 + t901;
    let t903: f64 = t898 + t900;
    let t904: f64 = t899 + t902;
    let t906: f64 = 0.5 * inverse_root(t903);
    let t907: f64 = t904 * t906;
    let t908: f64 = inverse_root(t903);
    let t909: f64 = t907 * t908;
    let t910: f64 = -t909;
    let t911: f64 = t910 * inverse_root(t903);
    let t913: f64 = x3 * t911;
    let t914: f64 = t861 * t908;
    let t915: f64 = t913 + t914;
    let t917: f64 = x4 * t911;
    let t918: f64 = t870 * t908;
    let t919: f64 = t917 + t918;
    let t921: f64 = x5 * t911;
    let t922: f64 = t878 * t908;
    let t923: f64 = t921 + t922;
    let t925: f64 = x6 * t911;
    let t926: f64 = t886 * t908;
    let t927: f64 = t925 + t926;
    let t928: f64 = 0.5 * t438;
    let t929: f64 = 0.5 * t448;
    let t931: f64 = 0.5 * t456;
    let t933: f64 = x4 * t928;
    let t935: f64 = x5 * t929;
    let t937: f64 = t935 - t933;
    let t938: f64 = x6 * t931;
    let t940: f64 = t937 + t938;
    let t941: f64 = x3 * t928;
    let t942: f64 = x6 * t929;
    let t944: f64 = t941 - t942;
    let t945: f64 = x5 * t931;
    let t947: f64 = t944 + t945;
    let t948: f64 = x6 * t928;
    let t950: f64 = x3 * t929;
    let t952: f64 = t948 + t950;
    let t954: f64 = x4 * t931;
    let t956: f64 = t952 + t954;
    let t958: f64 = x5 * t928;
    let t959: f64 = x4 * t929;
    let t961: f64 = t958 + t959;
    let t962: f64 = x3 * t931;
    let t964: f64 = t961 - t962;
    let t965: f64 = x3 * t940;
    let t966: f64 = t965 + t965;
    let t967: f64 = x4 * t947;
    let t968: f64 = t967 + t967;
    let t969: f64 = t966 + t968;
    let t970: f64 = x5 * t956;
    let t972: f64 = t970 + t970;
    let t974: f64 = t969 - t972;
    let t975: f64 = x6 * t964;
    let t976: f64 = t975 + t975;
    let t977: f64 = t974 + t976;
    let t978: f64 = t906 * t977;
    let t979: f64 = t908 * t978;
    let t980: f64 = -t979;
    let t981: f64 = t980 * inverse_root(t903);
    let t982: f64 = x3 * t981;
    let t983: f64 = t908 * t940;
    let t984: f64 = t982 + t983;
    let t985: f64 = x4 * t981;
    let t986: f64 = t908 * t947;
    let t987: f64 = t985 + t986;
    let t988: f64 = x5 * t981;
    let t989: f64 = t908 * t956;
    let t991: f64 = t988 - t989;
    let t992: f64 = x6 * t981;
    let t993: f64 = t908 * t964;
    let t994: f64 = t992 + t993;
    let t995: f64 = 0.5 * t499;
    let t997: f64 = 0.5 * t503;
    let t999: f64 = 0.5 * t508;
    let t1001: f64 = x4 * t995;
    let t1003: f64 = x5 * t997;
    let t1005: f64 = t1001 + t1003;
    let t1006: f64 = x6 * t999;
    let t1008: f64 = t1005 + t1006;
    let t1009: f64 = x3 * t995;
    let t1011: f64 = x6 * t997;
    let t1013: f64 = t1009 + t1011;
    let t1015: f64 = x5 * t999;
    let t1017: f64 = t1015 - t1013;
    let t1018: f64 = x6 * t995;
    let t1020: f64 = x3 * t997;
    let t1022: f64 = t1018 - t1020;
    let t1023: f64 = x4 * t999;
    let t1025: f64 = t1022 - t1023;
    let t1026: f64 = x5 * t995;
    let t1028: f64 = x4 * t997;
    let t1030: f64 = t1028 - t1026;
    let t1031: f64 = x3 * t999;
    let t1033: f64 = t1030 - t1031;
    let t1034: f64 = x3 * t1008;
    let t1035: f64 = t1034 + t1034;
    let t1036: f64 = x4 * t1017;
    let t1037: f64 = t1036 + t1036;
    let t1038: f64 = t1035 + t1037;
    let t1039: f64 = x5 * t1025;
    let t1040: f64 = t1039 + t1039;
    let t1041: f64 = t1038 + t1040;
    let t1042: f64 = x6 * t1033;
    let t1043: f64 = t1042 + t1042;
    let t1044: f64 = t1041 + t1043;
    let t1045: f64 = t906 * t1044;
    let t1046: f64 = t908 * t1045;
    let t1047: f64 = -t1046;
    let t1048: f64 = t1047 * inverse_root(t903);
    let t1049: f64 = x3 * t1048;
    let t1050: f64 = t908 * t1008;
    let t1051: f64 = t1049 + t1050;
    let t1052: f64 = x4 * t1048;
    let t1053: f64 = t908 * t1017;
    let t1054: f64 = t1052 + t1053;
    let t1055: f64 = x5 * t1048;
    let t1056: f64 = t908 * t1025;
    let t1057: f64 = t1055 + t1056;
    let t1058: f64 = x6 * t1048;
    let t1059: f64 = t908 * t1033;
    let t1060: f64 = t1058 + t1059;
    if !(absolute(t57) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t131) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t148) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t315) > 1.2990381056766587 * LEAST_PIVOT) { return false; }
    rate[0][0] = t557;
    rate[1][0] = t414;
    rate[2][0] = t407;
    rate[3][0] = t915;
    rate[4][0] = t919;
    rate[5][0] = t923;
    rate[6][0] = t927;
    rate[7][0] = t400;
    rate[8][0] = t561;
    rate[9][0] = t392;
    rate[0][1] = t562;
    rate[1][1] = t563;
    rate[2][1] = t564;
    rate[3][1] = t984;
    rate[4][1] = t987;
    rate[5][1] = t991;
    rate[6][1] = t994;
    rate[7][1] = t488;
    rate[8][1] = t486;
    rate[9][1] = t567;
    rate[0][2] = t568;
    rate[1][2] = t535;
    rate[2][2] = t569;
    rate[3][2] = t1051;
    rate[4][2] = t1054;
    rate[5][2] = t1057;
    rate[6][2] = t1060;
    rate[7][2] = t523;
    rate[8][2] = t573;
    rate[9][2] = t515;
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
