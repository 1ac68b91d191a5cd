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
/// From this number on the state follows from the numbers before it.
pub const ITERATED: usize = 3;
pub const UNKNOWNS: usize = 9;
pub const ROWS: usize = 9;
pub const FRAMES: usize = 0;
/// In how many places there are two solutions.
pub const SIGNS: usize = 0;

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

/// Unit quaternions again after a small change.
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
    /// How far the numbers moved that the others follow from.
    pub moved: [f64; ITERATED],
}

impl Follower {
    /// At a state, at rest.
    pub fn new(state: [f64; STATE]) -> Self {
        Follower {
            state,
            moved: [0.0; ITERATED],
        }
    }

    /// Finds the state for inputs u near where the last move, made once more, leads.
    #[inline]
    pub fn solve(&mut self, u: &[f64; INPUTS]) -> Verdict {
        let mut before = [0.0; ITERATED];
        before.copy_from_slice(&self.state[..ITERATED]);
        for (x, moved) in self.state.iter_mut().zip(&self.moved) {
            *x += moved;
        }
        normalise(&mut self.state);
        if !(near(u) && near(&self.state[..ITERATED]) && fast(u, &mut self.state)) {
            self.state[..ITERATED].copy_from_slice(&before);
            return self.restart(u);
        }
        for i in 0..ITERATED {
            self.moved[i] = self.state[i] - before[i];
        }
        Verdict::Solved
    }

    /// The same from the state itself. Apart from the above, whose numbers then stay in registers.
    #[cold]
    #[inline(never)]
    fn restart(&mut self, u: &[f64; INPUTS]) -> Verdict {
        let before = self.state;
        let verdict = solve(u, &mut self.state);
        for i in 0..ITERATED {
            self.moved[i] = match verdict {
                Verdict::Solved => self.state[i] - before[i],
                _ => 0.0,
            };
        }
        verdict
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
