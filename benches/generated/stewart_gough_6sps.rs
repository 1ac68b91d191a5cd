//! Stewart-Gough platform, 6-SPS
//!
//! Solver written by linkwork 0.1.0.
//!
//! Inputs, what is held:
//!      0  l1, m
//!      1  l2, m
//!      2  l3, m
//!      3  l4, m
//!      4  l5, m
//!      5  l6, m
//!
//! State, what is found:
//!      0  top.qw
//!      1  top.qx
//!      2  top.qy
//!      3  top.qz
//!      4  top.x, m
//!      5  top.y, m
//!      6  top.z, m
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

pub const INPUTS: usize = 6;
pub const STATE: usize = 7;
/// From this number on the state follows from the numbers before it.
pub const ITERATED: usize = 7;
pub const UNKNOWNS: usize = 6;
pub const ROWS: usize = 6;
/// Number of rows of the iteration.
pub const EQUATIONS: usize = 6;
/// Number of unknowns of the iteration.
pub const STEPS: usize = 6;
pub const FRAMES: usize = 0;
/// Number of signs of the closed form, each for two solutions.
pub const SIGNS: usize = 0;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The largest row accepted where a step makes it no smaller, by rounding.
pub const ROUNDING: f64 = 1e-12;

/// Inputs of the assembled configuration at which the order of elimination was chosen.
pub const START_INPUTS: [f64; INPUTS] = [
    0.953617769339477, 1.1009888509880563, 0.8880096958930123, 1.1283650162957022,
    0.9437028610743955, 1.159383754414387,
];
/// Its state.
pub const START_STATE: [f64; STATE] = [
    1.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.9,
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
    let u3: f64 = u[3];
    let u4: f64 = u[4];
    let u5: f64 = u[5];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
    let t51: f64 = x1 + x1;
    let t52: f64 = x2 + x2;
    let t53: f64 = x3 + x3;
    let t54: f64 = x0 * t51;
    let t55: f64 = x0 * t52;
    let t56: f64 = x0 * t53;
    let t57: f64 = x1 * t51;
    let t58: f64 = x1 * t52;
    let t59: f64 = x1 * t53;
    let t60: f64 = x2 * t52;
    let t61: f64 = x2 * t53;
    let t62: f64 = x3 * t53;
    let t63: f64 = 1.0 - t60;
    let t64: f64 = t63 - t62;
    let t65: f64 = t56 + t58;
    let t66: f64 = t59 - t55;
    let t67: f64 = t58 - t56;
    let t68: f64 = 1.0 - t57;
    let t69: f64 = t68 - t62;
    let t70: f64 = t54 + t61;
    let t71: f64 = t55 + t59;
    let t72: f64 = t61 - t54;
    let t73: f64 = t68 - t60;
    let t74: f64 = 0.4413 * t64;
    let t75: f64 = 0.4413 * t65;
    let t76: f64 = 0.4413 * t66;
    let t77: f64 = (-0.3448) * t67;
    let t78: f64 = (-0.3448) * t69;
    let t79: f64 = (-0.3448) * t70;
    let t80: f64 = t74 + t77;
    let t81: f64 = t75 + t78;
    let t82: f64 = t76 + t79;
    let t83: f64 = (-0.03) * t71;
    let t84: f64 = (-0.03) * t72;
    let t85: f64 = (-0.03) * t73;
    let t86: f64 = t80 + t83;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = x4 + t86;
    let t90: f64 = x5 + t87;
    let t91: f64 = x6 + t88;
    let t92: f64 = 0.4334 * t64;
    let t93: f64 = 0.4334 * t65;
    let t94: f64 = 0.4334 * t66;
    let t95: f64 = 0.3386 * t67;
    let t96: f64 = 0.3386 * t69;
    let t97: f64 = 0.3386 * t70;
    let t98: f64 = t92 + t95;
    let t99: f64 = t93 + t96;
    let t100: f64 = t94 + t97;
    let t101: f64 = 0.03 * t71;
    let t102: f64 = 0.03 * t72;
    let t103: f64 = 0.03 * t73;
    let t104: f64 = t98 + t101;
    let t105: f64 = t99 + t102;
    let t106: f64 = t100 + t103;
    let t107: f64 = x4 + t104;
    let t108: f64 = x5 + t105;
    let t109: f64 = x6 + t106;
    let t110: f64 = 0.0907 * t64;
    let t111: f64 = 0.0907 * t65;
    let t112: f64 = 0.0907 * t66;
    let t113: f64 = 0.5729 * t67;
    let t114: f64 = 0.5729 * t69;
    let t115: f64 = 0.5729 * t70;
    let t116: f64 = t110 + t113;
    let t117: f64 = t111 + t114;
    let t118: f64 = t112 + t115;
    let t119: f64 = (-0.05) * t71;
    let t120: f64 = (-0.05) * t72;
    let t121: f64 = (-0.05) * t73;
    let t122: f64 = t116 + t119;
    let t123: f64 = t117 + t120;
    let t124: f64 = t118 + t121;
    let t125: f64 = x4 + t122;
    let t126: f64 = x5 + t123;
    let t127: f64 = x6 + t124;
    let t128: f64 = (-0.4821) * t64;
    let t129: f64 = (-0.4821) * t65;
    let t130: f64 = (-0.4821) * t66;
    let t131: f64 = 0.1948 * t67;
    let t132: f64 = 0.1948 * t69;
    let t133: f64 = 0.1948 * t70;
    let t134: f64 = t128 + t131;
    let t135: f64 = t129 + t132;
    let t136: f64 = t130 + t133;
    let t137: f64 = 0.04 * t71;
    let t138: f64 = 0.04 * t72;
    let t139: f64 = 0.04 * t73;
    let t140: f64 = t134 + t137;
    let t141: f64 = t135 + t138;
    let t142: f64 = t136 + t139;
    let t143: f64 = x4 + t140;
    let t144: f64 = x5 + t141;
    let t145: f64 = x6 + t142;
    let t146: f64 = (-0.5247) * t64;
    let t147: f64 = (-0.5247) * t65;
    let t148: f64 = (-0.5247) * t66;
    let t149: f64 = (-0.2227) * t67;
    let t150: f64 = (-0.2227) * t69;
    let t151: f64 = (-0.2227) * t70;
    let t152: f64 = t146 + t149;
    let t153: f64 = t147 + t150;
    let t154: f64 = t148 + t151;
    let t155: f64 = (-0.02) * t71;
    let t156: f64 = (-0.02) * t72;
    let t157: f64 = (-0.02) * t73;
    let t158: f64 = t152 + t155;
    let t159: f64 = t153 + t156;
    let t160: f64 = t154 + t157;
    let t161: f64 = x4 + t158;
    let t162: f64 = x5 + t159;
    let t163: f64 = x6 + t160;
    let t164: f64 = 0.0658 * t64;
    let t165: f64 = 0.0658 * t65;
    let t166: f64 = 0.0658 * t66;
    let t167: f64 = (-0.536) * t67;
    let t168: f64 = (-0.536) * t69;
    let t169: f64 = (-0.536) * t70;
    let t170: f64 = t164 + t167;
    let t171: f64 = t165 + t168;
    let t172: f64 = t166 + t169;
    let t173: f64 = 0.06 * t71;
    let t174: f64 = 0.06 * t72;
    let t175: f64 = 0.06 * t73;
    let t176: f64 = t170 + t173;
    let t177: f64 = t171 + t174;
    let t178: f64 = t172 + t175;
    let t179: f64 = x4 + t176;
    let t180: f64 = x5 + t177;
    let t181: f64 = x6 + t178;
    let t182: f64 = t89 - 0.9272;
    let t183: f64 = t90 - (-0.3746);
    let t184: f64 = t91 - 0.05;
    let t185: f64 = t182 * t182;
    let t186: f64 = t183 * t183;
    let t187: f64 = t185 + t186;
    let t188: f64 = t184 * t184;
    let t189: f64 = t187 + t188;
    let t190: f64 = u0 * u0;
    let t191: f64 = t189 - t190;
    let t193: f64 = 0.37197656794614387 * t191;
    let t195: f64 = 0.7439531358922877 * t182;
    let t196: f64 = 0.7439531358922877 * t183;
    let t197: f64 = 0.7439531358922877 * t184;
    let t198: f64 = t87 * t197;
    let t199: f64 = t88 * t196;
    let t200: f64 = t198 - t199;
    let t201: f64 = t88 * t195;
    let t202: f64 = t86 * t197;
    let t203: f64 = t201 - t202;
    let t204: f64 = t86 * t196;
    let t205: f64 = t87 * t195;
    let t206: f64 = t204 - t205;
    let t209: f64 = 0.8625271797991572 * t182;
    let t210: f64 = 0.8625271797991572 * t183;
    let t211: f64 = 0.8625271797991572 * t184;
    let t212: f64 = t107 - 0.9356;
    let t213: f64 = t108 - 0.4767;
    let t214: f64 = t109 - (-0.04);
    let t215: f64 = t212 * t212;
    let t216: f64 = t213 * t213;
    let t217: f64 = t215 + t216;
    let t218: f64 = t214 * t214;
    let t219: f64 = t217 + t218;
    let t220: f64 = u1 * u1;
    let t221: f64 = t219 - t220;
    let t222: f64 = 0.37197656794614387 * t221;
    let t223: f64 = 0.7439531358922877 * t212;
    let t224: f64 = 0.7439531358922877 * t213;
    let t225: f64 = 0.7439531358922877 * t214;
    let t226: f64 = t105 * t225;
    let t227: f64 = t106 * t224;
    let t228: f64 = t226 - t227;
    let t229: f64 = t106 * t223;
    let t230: f64 = t104 * t225;
    let t231: f64 = t229 - t230;
    let t232: f64 = t104 * t224;
    let t233: f64 = t105 * t223;
    let t234: f64 = t232 - t233;
    let t235: f64 = 0.8625271797991572 * t212;
    let t236: f64 = 0.8625271797991572 * t213;
    let t237: f64 = 0.8625271797991572 * t214;
    let t238: f64 = t125 - (-0.1182);
    let t239: f64 = t126 - 0.9628;
    let t240: f64 = t127 - 0.08;
    let t241: f64 = t238 * t238;
    let t242: f64 = t239 * t239;
    let t243: f64 = t241 + t242;
    let t244: f64 = t240 * t240;
    let t245: f64 = t243 + t244;
    let t246: f64 = u2 * u2;
    let t247: f64 = t245 - t246;
    let t248: f64 = 0.37197656794614387 * t247;
    let t249: f64 = 0.7439531358922877 * t238;
    let t250: f64 = 0.7439531358922877 * t239;
    let t251: f64 = 0.7439531358922877 * t240;
    let t252: f64 = t123 * t251;
    let t253: f64 = t124 * t250;
    let t254: f64 = t252 - t253;
    let t255: f64 = t124 * t249;
    let t256: f64 = t122 * t251;
    let t257: f64 = t255 - t256;
    let t258: f64 = t122 * t250;
    let t259: f64 = t123 * t249;
    let t260: f64 = t258 - t259;
    let t261: f64 = 0.8625271797991572 * t238;
    let t262: f64 = 0.8625271797991572 * t239;
    let t263: f64 = 0.8625271797991572 * t240;
    let t264: f64 = t143 - (-0.8456);
    let t265: f64 = t144 - 0.5704;
    let t266: f64 = t145 - (-0.06);
    let t267: f64 = t264 * t264;
    let t268: f64 = t265 * t265;
    let t269: f64 = t267 + t268;
    let t270: f64 = t266 * t266;
    let t271: f64 = t269 + t270;
    let t272: f64 = u3 * u3;
    let t273: f64 = t271 - t272;
    let t274: f64 = 0.37197656794614387 * t273;
    let t275: f64 = 0.7439531358922877 * t264;
    let t276: f64 = 0.7439531358922877 * t265;
    let t277: f64 = 0.7439531358922877 * t266;
    let t278: f64 = t141 * t277;
    let t279: f64 = t142 * t276;
    let t280: f64 = t278 - t279;
    let t281: f64 = t142 * t275;
    let t282: f64 = t140 * t277;
    let t283: f64 = t281 - t282;
    let t284: f64 = t140 * t276;
    let t285: f64 = t141 * t275;
    let t286: f64 = t284 - t285;
    let t287: f64 = 0.8625271797991572 * t264;
    let t288: f64 = 0.8625271797991572 * t265;
    let t289: f64 = 0.8625271797991572 * t266;
    let t290: f64 = t161 - (-0.7782);
    let t291: f64 = t162 - (-0.5449);
    let t292: f64 = t163 - 0.03;
    let t293: f64 = t290 * t290;
    let t294: f64 = t291 * t291;
    let t295: f64 = t293 + t294;
    let t296: f64 = t292 * t292;
    let t297: f64 = t295 + t296;
    let t298: f64 = u4 * u4;
    let t299: f64 = t297 - t298;
    let t300: f64 = 0.37197656794614387 * t299;
    let t301: f64 = 0.7439531358922877 * t290;
    let t302: f64 = 0.7439531358922877 * t291;
    let t303: f64 = 0.7439531358922877 * t292;
    let t304: f64 = t159 * t303;
    let t305: f64 = t160 * t302;
    let t306: f64 = t304 - t305;
    let t307: f64 = t160 * t301;
    let t308: f64 = t158 * t303;
    let t309: f64 = t307 - t308;
    let t310: f64 = t158 * t302;
    let t311: f64 = t159 * t301;
    let t312: f64 = t310 - t311;
    let t313: f64 = 0.8625271797991572 * t290;
    let t314: f64 = 0.8625271797991572 * t291;
    let t315: f64 = 0.8625271797991572 * t292;
    let t316: f64 = t179 - (-0.1267);
    let t317: f64 = t180 - (-1.0322);
    let t318: f64 = t181 - (-0.07);
    let t319: f64 = t316 * t316;
    let t320: f64 = t317 * t317;
    let t321: f64 = t319 + t320;
    let t322: f64 = t318 * t318;
    let t323: f64 = t321 + t322;
    let t324: f64 = u5 * u5;
    let t325: f64 = t323 - t324;
    let t326: f64 = 0.37197656794614387 * t325;
    let t327: f64 = 0.7439531358922877 * t316;
    let t328: f64 = 0.7439531358922877 * t317;
    let t329: f64 = 0.7439531358922877 * t318;
    let t330: f64 = t177 * t329;
    let t331: f64 = t178 * t328;
    let t332: f64 = t330 - t331;
    let t333: f64 = t178 * t327;
    let t334: f64 = t176 * t329;
    let t335: f64 = t333 - t334;
    let t336: f64 = t176 * t328;
    let t337: f64 = t177 * t327;
    let t338: f64 = t336 - t337;
    let t339: f64 = 0.8625271797991572 * t316;
    let t340: f64 = 0.8625271797991572 * t317;
    let t341: f64 = 0.8625271797991572 * t318;
    r[0] = t193;
    r[1] = t222;
    r[2] = t248;
    r[3] = t274;
    r[4] = t300;
    r[5] = t326;
    j[0][0] = t200;
    j[0][1] = t203;
    j[0][2] = t206;
    j[0][3] = t209;
    j[0][4] = t210;
    j[0][5] = t211;
    j[1][0] = t228;
    j[1][1] = t231;
    j[1][2] = t234;
    j[1][3] = t235;
    j[1][4] = t236;
    j[1][5] = t237;
    j[2][0] = t254;
    j[2][1] = t257;
    j[2][2] = t260;
    j[2][3] = t261;
    j[2][4] = t262;
    j[2][5] = t263;
    j[3][0] = t280;
    j[3][1] = t283;
    j[3][2] = t286;
    j[3][3] = t287;
    j[3][4] = t288;
    j[3][5] = t289;
    j[4][0] = t306;
    j[4][1] = t309;
    j[4][2] = t312;
    j[4][3] = t313;
    j[4][4] = t314;
    j[4][5] = t315;
    j[5][0] = t332;
    j[5][1] = t335;
    j[5][2] = t338;
    j[5][3] = t339;
    j[5][4] = t340;
    j[5][5] = t341;
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
    let d0: f64 = d[0];
    let d1: f64 = d[1];
    let d2: f64 = d[2];
    let d3: f64 = d[3];
    let d4: f64 = d[4];
    let d5: f64 = d[5];
    let t962: f64 = 1.159383754414387 * d3;
    let t963: f64 = 1.159383754414387 * d4;
    let t964: f64 = 1.159383754414387 * d5;
    let t966: f64 = 0.5 * d0;
    let t967: f64 = 0.5 * d1;
    let t968: f64 = 0.5 * d2;
    let t969: f64 = x1 * t966;
    let t970: f64 = x0 - t969;
    let t971: f64 = x2 * t967;
    let t972: f64 = t970 - t971;
    let t973: f64 = x3 * t968;
    let t974: f64 = t972 - t973;
    let t975: f64 = x0 * t966;
    let t976: f64 = x1 + t975;
    let t977: f64 = x3 * t967;
    let t978: f64 = t976 + t977;
    let t979: f64 = x2 * t968;
    let t980: f64 = t978 - t979;
    let t981: f64 = x3 * t966;
    let t982: f64 = x2 - t981;
    let t983: f64 = x0 * t967;
    let t984: f64 = t982 + t983;
    let t985: f64 = x1 * t968;
    let t986: f64 = t984 + t985;
    let t987: f64 = x2 * t966;
    let t988: f64 = x3 + t987;
    let t989: f64 = x1 * t967;
    let t990: f64 = t988 - t989;
    let t991: f64 = x0 * t968;
    let t992: f64 = t990 + t991;
    let t993: f64 = t974 * t974;
    let t994: f64 = t980 * t980;
    let t995: f64 = t993 + t994;
    let t996: f64 = t986 * t986;
    let t997: f64 = t995 + t996;
    let t998: f64 = t992 * t992;
    let t999: f64 = t997 + t998;
    let t1001: f64 = inverse_root(t999);
    let t1002: f64 = t974 * t1001;
    let t1003: f64 = t980 * t1001;
    let t1004: f64 = t986 * t1001;
    let t1005: f64 = t992 * t1001;
    let t1006: f64 = x4 + t962;
    let t1007: f64 = x5 + t963;
    let t1008: f64 = x6 + t964;
    y[0] = t1002;
    y[1] = t1003;
    y[2] = t1004;
    y[3] = t1005;
    y[4] = t1006;
    y[5] = t1007;
    y[6] = t1008;
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
    let u3: f64 = u[3];
    let u4: f64 = u[4];
    let u5: f64 = u[5];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
    let t51: f64 = x1 + x1;
    let t52: f64 = x2 + x2;
    let t53: f64 = x3 + x3;
    let t54: f64 = x0 * t51;
    let t55: f64 = x0 * t52;
    let t56: f64 = x0 * t53;
    let t57: f64 = x1 * t51;
    let t58: f64 = x1 * t52;
    let t59: f64 = x1 * t53;
    let t60: f64 = x2 * t52;
    let t61: f64 = x2 * t53;
    let t62: f64 = x3 * t53;
    let t63: f64 = 1.0 - t60;
    let t64: f64 = t63 - t62;
    let t65: f64 = t56 + t58;
    let t66: f64 = t59 - t55;
    let t67: f64 = t58 - t56;
    let t68: f64 = 1.0 - t57;
    let t69: f64 = t68 - t62;
    let t70: f64 = t54 + t61;
    let t71: f64 = t55 + t59;
    let t72: f64 = t61 - t54;
    let t73: f64 = t68 - t60;
    let t74: f64 = 0.4413 * t64;
    let t75: f64 = 0.4413 * t65;
    let t76: f64 = 0.4413 * t66;
    let t77: f64 = (-0.3448) * t67;
    let t78: f64 = (-0.3448) * t69;
    let t79: f64 = (-0.3448) * t70;
    let t80: f64 = t74 + t77;
    let t81: f64 = t75 + t78;
    let t82: f64 = t76 + t79;
    let t83: f64 = (-0.03) * t71;
    let t84: f64 = (-0.03) * t72;
    let t85: f64 = (-0.03) * t73;
    let t86: f64 = t80 + t83;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = x4 + t86;
    let t90: f64 = x5 + t87;
    let t91: f64 = x6 + t88;
    let t92: f64 = 0.4334 * t64;
    let t93: f64 = 0.4334 * t65;
    let t94: f64 = 0.4334 * t66;
    let t95: f64 = 0.3386 * t67;
    let t96: f64 = 0.3386 * t69;
    let t97: f64 = 0.3386 * t70;
    let t98: f64 = t92 + t95;
    let t99: f64 = t93 + t96;
    let t100: f64 = t94 + t97;
    let t101: f64 = 0.03 * t71;
    let t102: f64 = 0.03 * t72;
    let t103: f64 = 0.03 * t73;
    let t104: f64 = t98 + t101;
    let t105: f64 = t99 + t102;
    let t106: f64 = t100 + t103;
    let t107: f64 = x4 + t104;
    let t108: f64 = x5 + t105;
    let t109: f64 = x6 + t106;
    let t110: f64 = 0.0907 * t64;
    let t111: f64 = 0.0907 * t65;
    let t112: f64 = 0.0907 * t66;
    let t113: f64 = 0.5729 * t67;
    let t114: f64 = 0.5729 * t69;
    let t115: f64 = 0.5729 * t70;
    let t116: f64 = t110 + t113;
    let t117: f64 = t111 + t114;
    let t118: f64 = t112 + t115;
    let t119: f64 = (-0.05) * t71;
    let t120: f64 = (-0.05) * t72;
    let t121: f64 = (-0.05) * t73;
    let t122: f64 = t116 + t119;
    let t123: f64 = t117 + t120;
    let t124: f64 = t118 + t121;
    let t125: f64 = x4 + t122;
    let t126: f64 = x5 + t123;
    let t127: f64 = x6 + t124;
    let t128: f64 = (-0.4821) * t64;
    let t129: f64 = (-0.4821) * t65;
    let t130: f64 = (-0.4821) * t66;
    let t131: f64 = 0.1948 * t67;
    let t132: f64 = 0.1948 * t69;
    let t133: f64 = 0.1948 * t70;
    let t134: f64 = t128 + t131;
    let t135: f64 = t129 + t132;
    let t136: f64 = t130 + t133;
    let t137: f64 = 0.04 * t71;
    let t138: f64 = 0.04 * t72;
    let t139: f64 = 0.04 * t73;
    let t140: f64 = t134 + t137;
    let t141: f64 = t135 + t138;
    let t142: f64 = t136 + t139;
    let t143: f64 = x4 + t140;
    let t144: f64 = x5 + t141;
    let t145: f64 = x6 + t142;
    let t146: f64 = (-0.5247) * t64;
    let t147: f64 = (-0.5247) * t65;
    let t148: f64 = (-0.5247) * t66;
    let t149: f64 = (-0.2227) * t67;
    let t150: f64 = (-0.2227) * t69;
    let t151: f64 = (-0.2227) * t70;
    let t152: f64 = t146 + t149;
    let t153: f64 = t147 + t150;
    let t154: f64 = t148 + t151;
    let t155: f64 = (-0.02) * t71;
    let t156: f64 = (-0.02) * t72;
    let t157: f64 = (-0.02) * t73;
    let t158: f64 = t152 + t155;
    let t159: f64 = t153 + t156;
    let t160: f64 = t154 + t157;
    let t161: f64 = x4 + t158;
    let t162: f64 = x5 + t159;
    let t163: f64 = x6 + t160;
    let t164: f64 = 0.0658 * t64;
    let t165: f64 = 0.0658 * t65;
    let t166: f64 = 0.0658 * t66;
    let t167: f64 = (-0.536) * t67;
    let t168: f64 = (-0.536) * t69;
    let t169: f64 = (-0.536) * t70;
    let t170: f64 = t164 + t167;
    let t171: f64 = t165 + t168;
    let t172: f64 = t166 + t169;
    let t173: f64 = 0.06 * t71;
    let t174: f64 = 0.06 * t72;
    let t175: f64 = 0.06 * t73;
    let t176: f64 = t170 + t173;
    let t177: f64 = t171 + t174;
    let t178: f64 = t172 + t175;
    let t179: f64 = x4 + t176;
    let t180: f64 = x5 + t177;
    let t181: f64 = x6 + t178;
    let t182: f64 = t89 - 0.9272;
    let t183: f64 = t90 - (-0.3746);
    let t184: f64 = t91 - 0.05;
    let t185: f64 = t182 * t182;
    let t186: f64 = t183 * t183;
    let t187: f64 = t185 + t186;
    let t188: f64 = t184 * t184;
    let t189: f64 = t187 + t188;
    let t190: f64 = u0 * u0;
    let t191: f64 = t189 - t190;
    let t193: f64 = 0.37197656794614387 * t191;
    let t195: f64 = 0.7439531358922877 * t182;
    let t196: f64 = 0.7439531358922877 * t183;
    let t197: f64 = 0.7439531358922877 * t184;
    let t198: f64 = t87 * t197;
    let t199: f64 = t88 * t196;
    let t200: f64 = t198 - t199;
    let t201: f64 = t88 * t195;
    let t202: f64 = t86 * t197;
    let t203: f64 = t201 - t202;
    let t204: f64 = t86 * t196;
    let t205: f64 = t87 * t195;
    let t206: f64 = t204 - t205;
    let t209: f64 = 0.8625271797991572 * t182;
    let t210: f64 = 0.8625271797991572 * t183;
    let t211: f64 = 0.8625271797991572 * t184;
    let t212: f64 = t107 - 0.9356;
    let t213: f64 = t108 - 0.4767;
    let t214: f64 = t109 - (-0.04);
    let t215: f64 = t212 * t212;
    let t216: f64 = t213 * t213;
    let t217: f64 = t215 + t216;
    let t218: f64 = t214 * t214;
    let t219: f64 = t217 + t218;
    let t220: f64 = u1 * u1;
    let t221: f64 = t219 - t220;
    let t222: f64 = 0.37197656794614387 * t221;
    let t223: f64 = 0.7439531358922877 * t212;
    let t224: f64 = 0.7439531358922877 * t213;
    let t225: f64 = 0.7439531358922877 * t214;
    let t226: f64 = t105 * t225;
    let t227: f64 = t106 * t224;
    let t228: f64 = t226 - t227;
    let t229: f64 = t106 * t223;
    let t230: f64 = t104 * t225;
    let t231: f64 = t229 - t230;
    let t232: f64 = t104 * t224;
    let t233: f64 = t105 * t223;
    let t234: f64 = t232 - t233;
    let t235: f64 = 0.8625271797991572 * t212;
    let t236: f64 = 0.8625271797991572 * t213;
    let t237: f64 = 0.8625271797991572 * t214;
    let t238: f64 = t125 - (-0.1182);
    let t239: f64 = t126 - 0.9628;
    let t240: f64 = t127 - 0.08;
    let t241: f64 = t238 * t238;
    let t242: f64 = t239 * t239;
    let t243: f64 = t241 + t242;
    let t244: f64 = t240 * t240;
    let t245: f64 = t243 + t244;
    let t246: f64 = u2 * u2;
    let t247: f64 = t245 - t246;
    let t248: f64 = 0.37197656794614387 * t247;
    let t249: f64 = 0.7439531358922877 * t238;
    let t250: f64 = 0.7439531358922877 * t239;
    let t251: f64 = 0.7439531358922877 * t240;
    let t252: f64 = t123 * t251;
    let t253: f64 = t124 * t250;
    let t254: f64 = t252 - t253;
    let t255: f64 = t124 * t249;
    let t256: f64 = t122 * t251;
    let t257: f64 = t255 - t256;
    let t258: f64 = t122 * t250;
    let t259: f64 = t123 * t249;
    let t260: f64 = t258 - t259;
    let t261: f64 = 0.8625271797991572 * t238;
    let t262: f64 = 0.8625271797991572 * t239;
    let t263: f64 = 0.8625271797991572 * t240;
    let t264: f64 = t143 - (-0.8456);
    let t265: f64 = t144 - 0.5704;
    let t266: f64 = t145 - (-0.06);
    let t267: f64 = t264 * t264;
    let t268: f64 = t265 * t265;
    let t269: f64 = t267 + t268;
    let t270: f64 = t266 * t266;
    let t271: f64 = t269 + t270;
    let t272: f64 = u3 * u3;
    let t273: f64 = t271 - t272;
    let t274: f64 = 0.37197656794614387 * t273;
    let t275: f64 = 0.7439531358922877 * t264;
    let t276: f64 = 0.7439531358922877 * t265;
    let t277: f64 = 0.7439531358922877 * t266;
    let t278: f64 = t141 * t277;
    let t279: f64 = t142 * t276;
    let t280: f64 = t278 - t279;
    let t281: f64 = t142 * t275;
    let t282: f64 = t140 * t277;
    let t283: f64 = t281 - t282;
    let t284: f64 = t140 * t276;
    let t285: f64 = t141 * t275;
    let t286: f64 = t284 - t285;
    let t287: f64 = 0.8625271797991572 * t264;
    let t288: f64 = 0.8625271797991572 * t265;
    let t289: f64 = 0.8625271797991572 * t266;
    let t290: f64 = t161 - (-0.7782);
    let t291: f64 = t162 - (-0.5449);
    let t292: f64 = t163 - 0.03;
    let t293: f64 = t290 * t290;
    let t294: f64 = t291 * t291;
    let t295: f64 = t293 + t294;
    let t296: f64 = t292 * t292;
    let t297: f64 = t295 + t296;
    let t298: f64 = u4 * u4;
    let t299: f64 = t297 - t298;
    let t300: f64 = 0.37197656794614387 * t299;
    let t301: f64 = 0.7439531358922877 * t290;
    let t302: f64 = 0.7439531358922877 * t291;
    let t303: f64 = 0.7439531358922877 * t292;
    let t304: f64 = t159 * t303;
    let t305: f64 = t160 * t302;
    let t306: f64 = t304 - t305;
    let t307: f64 = t160 * t301;
    let t308: f64 = t158 * t303;
    let t309: f64 = t307 - t308;
    let t310: f64 = t158 * t302;
    let t311: f64 = t159 * t301;
    let t312: f64 = t310 - t311;
    let t313: f64 = 0.8625271797991572 * t290;
    let t314: f64 = 0.8625271797991572 * t291;
    let t315: f64 = 0.8625271797991572 * t292;
    let t316: f64 = t179 - (-0.1267);
    let t317: f64 = t180 - (-1.0322);
    let t318: f64 = t181 - (-0.07);
    let t319: f64 = t316 * t316;
    let t320: f64 = t317 * t317;
    let t321: f64 = t319 + t320;
    let t322: f64 = t318 * t318;
    let t323: f64 = t321 + t322;
    let t324: f64 = u5 * u5;
    let t325: f64 = t323 - t324;
    let t326: f64 = 0.37197656794614387 * t325;
    let t327: f64 = 0.7439531358922877 * t316;
    let t328: f64 = 0.7439531358922877 * t317;
    let t329: f64 = 0.7439531358922877 * t318;
    let t330: f64 = t177 * t329;
    let t331: f64 = t178 * t328;
    let t332: f64 = t330 - t331;
    let t333: f64 = t178 * t327;
    let t334: f64 = t176 * t329;
    let t335: f64 = t333 - t334;
    let t336: f64 = t176 * t328;
    let t337: f64 = t177 * t327;
    let t338: f64 = t336 - t337;
    let t339: f64 = 0.8625271797991572 * t316;
    let t340: f64 = 0.8625271797991572 * t317;
    let t341: f64 = 0.8625271797991572 * t318;
    r[0] = t193;
    r[1] = t222;
    r[2] = t248;
    r[3] = t274;
    r[4] = t300;
    r[5] = t326;
    j[0][0] = t200;
    j[0][1] = t203;
    j[0][2] = t206;
    j[0][3] = t209;
    j[0][4] = t210;
    j[0][5] = t211;
    j[1][0] = t228;
    j[1][1] = t231;
    j[1][2] = t234;
    j[1][3] = t235;
    j[1][4] = t236;
    j[1][5] = t237;
    j[2][0] = t254;
    j[2][1] = t257;
    j[2][2] = t260;
    j[2][3] = t261;
    j[2][4] = t262;
    j[2][5] = t263;
    j[3][0] = t280;
    j[3][1] = t283;
    j[3][2] = t286;
    j[3][3] = t287;
    j[3][4] = t288;
    j[3][5] = t289;
    j[4][0] = t306;
    j[4][1] = t309;
    j[4][2] = t312;
    j[4][3] = t313;
    j[4][4] = t314;
    j[4][5] = t315;
    j[5][0] = t332;
    j[5][1] = t335;
    j[5][2] = t338;
    j[5][3] = t339;
    j[5][4] = t340;
    j[5][5] = t341;
}

/// The square of the distance between inputs u with a state x and inputs v with a state y, in rad and
/// characteristic lengths, as far as the Jacobian depends on them.
#[inline(always)]
fn apart(u: &[f64; INPUTS], x: &[f64; STATE], v: &[f64; INPUTS], y: &[f64; STATE]) -> f64 {
    let b0: f64 = 2.0 * (x[0] - y[0]);
    let b1: f64 = 2.0 * (x[1] - y[1]);
    let b2: f64 = 2.0 * (x[2] - y[2]);
    let b3: f64 = 2.0 * (x[3] - y[3]);
    let b4: f64 = 0.8625271797991573 * (x[4] - y[4]);
    let b5: f64 = 0.8625271797991573 * (x[5] - y[5]);
    let b6: f64 = 0.8625271797991573 * (x[6] - y[6]);
    return b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3 + b4 * b4 + b5 * b5 + b6 * b6;
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
    let f0: f64 = 1.5 - 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
    x[0] *= f0;
    x[1] *= f0;
    x[2] *= f0;
    x[3] *= f0;
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
    let u3: f64 = u[3];
    let u4: f64 = u[4];
    let u5: f64 = u[5];
    let t190: f64 = u0 * u0;
    let t220: f64 = u1 * u1;
    let t246: f64 = u2 * u2;
    let t272: f64 = u3 * u3;
    let t298: f64 = u4 * u4;
    let t324: f64 = u5 * u5;
    let mut x0: f64 = x[0];
    let mut x1: f64 = x[1];
    let mut x2: f64 = x[2];
    let mut x3: f64 = x[3];
    let mut x4: f64 = x[4];
    let mut x5: f64 = x[5];
    let mut x6: f64 = x[6];
    let mut last: f64 = LARGE;
    for _ in 0..MOST_STEPS {
        let t51: f64 = x1 + x1;
        let t52: f64 = x2 + x2;
        let t53: f64 = x3 + x3;
        let t54: f64 = x0 * t51;
        let t55: f64 = x0 * t52;
        let t56: f64 = x0 * t53;
        let t57: f64 = x1 * t51;
        let t58: f64 = x1 * t52;
        let t59: f64 = x1 * t53;
        let t60: f64 = x2 * t52;
        let t61: f64 = x2 * t53;
        let t62: f64 = x3 * t53;
        let t63: f64 = 1.0 - t60;
        let t64: f64 = t63 - t62;
        let t65: f64 = t56 + t58;
        let t66: f64 = t59 - t55;
        let t67: f64 = t58 - t56;
        let t68: f64 = 1.0 - t57;
        let t69: f64 = t68 - t62;
        let t70: f64 = t54 + t61;
        let t71: f64 = t55 + t59;
        let t72: f64 = t61 - t54;
        let t73: f64 = t68 - t60;
        let t74: f64 = 0.4413 * t64;
        let t75: f64 = 0.4413 * t65;
        let t76: f64 = 0.4413 * t66;
        let t77: f64 = (-0.3448) * t67;
        let t78: f64 = (-0.3448) * t69;
        let t79: f64 = (-0.3448) * t70;
        let t80: f64 = t74 + t77;
        let t81: f64 = t75 + t78;
        let t82: f64 = t76 + t79;
        let t83: f64 = (-0.03) * t71;
        let t84: f64 = (-0.03) * t72;
        let t85: f64 = (-0.03) * t73;
        let t86: f64 = t80 + t83;
        let t87: f64 = t81 + t84;
        let t88: f64 = t82 + t85;
        let t89: f64 = x4 + t86;
        let t90: f64 = x5 + t87;
        let t91: f64 = x6 + t88;
        let t92: f64 = 0.4334 * t64;
        let t93: f64 = 0.4334 * t65;
        let t94: f64 = 0.4334 * t66;
        let t95: f64 = 0.3386 * t67;
        let t96: f64 = 0.3386 * t69;
        let t97: f64 = 0.3386 * t70;
        let t98: f64 = t92 + t95;
        let t99: f64 = t93 + t96;
        let t100: f64 = t94 + t97;
        let t101: f64 = 0.03 * t71;
        let t102: f64 = 0.03 * t72;
        let t103: f64 = 0.03 * t73;
        let t104: f64 = t98 + t101;
        let t105: f64 = t99 + t102;
        let t106: f64 = t100 + t103;
        let t107: f64 = x4 + t104;
        let t108: f64 = x5 + t105;
        let t109: f64 = x6 + t106;
        let t110: f64 = 0.0907 * t64;
        let t111: f64 = 0.0907 * t65;
        let t112: f64 = 0.0907 * t66;
        let t113: f64 = 0.5729 * t67;
        let t114: f64 = 0.5729 * t69;
        let t115: f64 = 0.5729 * t70;
        let t116: f64 = t110 + t113;
        let t117: f64 = t111 + t114;
        let t118: f64 = t112 + t115;
        let t119: f64 = (-0.05) * t71;
        let t120: f64 = (-0.05) * t72;
        let t121: f64 = (-0.05) * t73;
        let t122: f64 = t116 + t119;
        let t123: f64 = t117 + t120;
        let t124: f64 = t118 + t121;
        let t125: f64 = x4 + t122;
        let t126: f64 = x5 + t123;
        let t127: f64 = x6 + t124;
        let t128: f64 = (-0.4821) * t64;
        let t129: f64 = (-0.4821) * t65;
        let t130: f64 = (-0.4821) * t66;
        let t131: f64 = 0.1948 * t67;
        let t132: f64 = 0.1948 * t69;
        let t133: f64 = 0.1948 * t70;
        let t134: f64 = t128 + t131;
        let t135: f64 = t129 + t132;
        let t136: f64 = t130 + t133;
        let t137: f64 = 0.04 * t71;
        let t138: f64 = 0.04 * t72;
        let t139: f64 = 0.04 * t73;
        let t140: f64 = t134 + t137;
        let t141: f64 = t135 + t138;
        let t142: f64 = t136 + t139;
        let t143: f64 = x4 + t140;
        let t144: f64 = x5 + t141;
        let t145: f64 = x6 + t142;
        let t146: f64 = (-0.5247) * t64;
        let t147: f64 = (-0.5247) * t65;
        let t148: f64 = (-0.5247) * t66;
        let t149: f64 = (-0.2227) * t67;
        let t150: f64 = (-0.2227) * t69;
        let t151: f64 = (-0.2227) * t70;
        let t152: f64 = t146 + t149;
        let t153: f64 = t147 + t150;
        let t154: f64 = t148 + t151;
        let t155: f64 = (-0.02) * t71;
        let t156: f64 = (-0.02) * t72;
        let t157: f64 = (-0.02) * t73;
        let t158: f64 = t152 + t155;
        let t159: f64 = t153 + t156;
        let t160: f64 = t154 + t157;
        let t161: f64 = x4 + t158;
        let t162: f64 = x5 + t159;
        let t163: f64 = x6 + t160;
        let t164: f64 = 0.0658 * t64;
        let t165: f64 = 0.0658 * t65;
        let t166: f64 = 0.0658 * t66;
        let t167: f64 = (-0.536) * t67;
        let t168: f64 = (-0.536) * t69;
        let t169: f64 = (-0.536) * t70;
        let t170: f64 = t164 + t167;
        let t171: f64 = t165 + t168;
        let t172: f64 = t166 + t169;
        let t173: f64 = 0.06 * t71;
        let t174: f64 = 0.06 * t72;
        let t175: f64 = 0.06 * t73;
        let t176: f64 = t170 + t173;
        let t177: f64 = t171 + t174;
        let t178: f64 = t172 + t175;
        let t179: f64 = x4 + t176;
        let t180: f64 = x5 + t177;
        let t181: f64 = x6 + t178;
        let t182: f64 = t89 - 0.9272;
        let t183: f64 = t90 - (-0.3746);
        let t184: f64 = t91 - 0.05;
        let t185: f64 = t182 * t182;
        let t186: f64 = t183 * t183;
        let t187: f64 = t185 + t186;
        let t188: f64 = t184 * t184;
        let t189: f64 = t187 + t188;
        let t191: f64 = t189 - t190;
        let t193: f64 = 0.37197656794614387 * t191;
        let t212: f64 = t107 - 0.9356;
        let t213: f64 = t108 - 0.4767;
        let t214: f64 = t109 - (-0.04);
        let t215: f64 = t212 * t212;
        let t216: f64 = t213 * t213;
        let t217: f64 = t215 + t216;
        let t218: f64 = t214 * t214;
        let t219: f64 = t217 + t218;
        let t221: f64 = t219 - t220;
        let t222: f64 = 0.37197656794614387 * t221;
        let t238: f64 = t125 - (-0.1182);
        let t239: f64 = t126 - 0.9628;
        let t240: f64 = t127 - 0.08;
        let t241: f64 = t238 * t238;
        let t242: f64 = t239 * t239;
        let t243: f64 = t241 + t242;
        let t244: f64 = t240 * t240;
        let t245: f64 = t243 + t244;
        let t247: f64 = t245 - t246;
        let t248: f64 = 0.37197656794614387 * t247;
        let t264: f64 = t143 - (-0.8456);
        let t265: f64 = t144 - 0.5704;
        let t266: f64 = t145 - (-0.06);
        let t267: f64 = t264 * t264;
        let t268: f64 = t265 * t265;
        let t269: f64 = t267 + t268;
        let t270: f64 = t266 * t266;
        let t271: f64 = t269 + t270;
        let t273: f64 = t271 - t272;
        let t274: f64 = 0.37197656794614387 * t273;
        let t290: f64 = t161 - (-0.7782);
        let t291: f64 = t162 - (-0.5449);
        let t292: f64 = t163 - 0.03;
        let t293: f64 = t290 * t290;
        let t294: f64 = t291 * t291;
        let t295: f64 = t293 + t294;
        let t296: f64 = t292 * t292;
        let t297: f64 = t295 + t296;
        let t299: f64 = t297 - t298;
        let t300: f64 = 0.37197656794614387 * t299;
        let t316: f64 = t179 - (-0.1267);
        let t317: f64 = t180 - (-1.0322);
        let t318: f64 = t181 - (-0.07);
        let t319: f64 = t316 * t316;
        let t320: f64 = t317 * t317;
        let t321: f64 = t319 + t320;
        let t322: f64 = t318 * t318;
        let t323: f64 = t321 + t322;
        let t325: f64 = t323 - t324;
        let t326: f64 = 0.37197656794614387 * t325;
        let mut size: f64 = 0.0;
        size = larger(size, t193);
        size = larger(size, t222);
        size = larger(size, t248);
        size = larger(size, t274);
        size = larger(size, t300);
        size = larger(size, t326);
        if size <= TOLERANCE || size <= ROUNDING && !(size < HALF * last) {
            x[0] = x0;
            x[1] = x1;
            x[2] = x2;
            x[3] = x3;
            x[4] = x4;
            x[5] = x5;
            x[6] = x6;
            return true;
        }
        /* a step that does not halve the rows is not to be trusted */
        if !(size < HALF * last) { return false; }
        last = size;
        let t195: f64 = 0.7439531358922877 * t182;
        let t196: f64 = 0.7439531358922877 * t183;
        let t197: f64 = 0.7439531358922877 * t184;
        let t198: f64 = t87 * t197;
        let t199: f64 = t88 * t196;
        let t200: f64 = t198 - t199;
        let t201: f64 = t88 * t195;
        let t202: f64 = t86 * t197;
        let t203: f64 = t201 - t202;
        let t204: f64 = t86 * t196;
        let t205: f64 = t87 * t195;
        let t206: f64 = t204 - t205;
        let t209: f64 = 0.8625271797991572 * t182;
        let t210: f64 = 0.8625271797991572 * t183;
        let t211: f64 = 0.8625271797991572 * t184;
        let t223: f64 = 0.7439531358922877 * t212;
        let t224: f64 = 0.7439531358922877 * t213;
        let t225: f64 = 0.7439531358922877 * t214;
        let t226: f64 = t105 * t225;
        let t227: f64 = t106 * t224;
        let t228: f64 = t226 - t227;
        let t229: f64 = t106 * t223;
        let t230: f64 = t104 * t225;
        let t231: f64 = t229 - t230;
        let t232: f64 = t104 * t224;
        let t233: f64 = t105 * t223;
        let t234: f64 = t232 - t233;
        let t235: f64 = 0.8625271797991572 * t212;
        let t236: f64 = 0.8625271797991572 * t213;
        let t237: f64 = 0.8625271797991572 * t214;
        let t249: f64 = 0.7439531358922877 * t238;
        let t250: f64 = 0.7439531358922877 * t239;
        let t251: f64 = 0.7439531358922877 * t240;
        let t252: f64 = t123 * t251;
        let t253: f64 = t124 * t250;
        let t254: f64 = t252 - t253;
        let t255: f64 = t124 * t249;
        let t256: f64 = t122 * t251;
        let t257: f64 = t255 - t256;
        let t258: f64 = t122 * t250;
        let t259: f64 = t123 * t249;
        let t260: f64 = t258 - t259;
        let t261: f64 = 0.8625271797991572 * t238;
        let t262: f64 = 0.8625271797991572 * t239;
        let t263: f64 = 0.8625271797991572 * t240;
        let t275: f64 = 0.7439531358922877 * t264;
        let t276: f64 = 0.7439531358922877 * t265;
        let t277: f64 = 0.7439531358922877 * t266;
        let t278: f64 = t141 * t277;
        let t279: f64 = t142 * t276;
        let t280: f64 = t278 - t279;
        let t281: f64 = t142 * t275;
        let t282: f64 = t140 * t277;
        let t283: f64 = t281 - t282;
        let t284: f64 = t140 * t276;
        let t285: f64 = t141 * t275;
        let t286: f64 = t284 - t285;
        let t287: f64 = 0.8625271797991572 * t264;
        let t288: f64 = 0.8625271797991572 * t265;
        let t289: f64 = 0.8625271797991572 * t266;
        let t301: f64 = 0.7439531358922877 * t290;
        let t302: f64 = 0.7439531358922877 * t291;
        let t303: f64 = 0.7439531358922877 * t292;
        let t304: f64 = t159 * t303;
        let t305: f64 = t160 * t302;
        let t306: f64 = t304 - t305;
        let t307: f64 = t160 * t301;
        let t308: f64 = t158 * t303;
        let t309: f64 = t307 - t308;
        let t310: f64 = t158 * t302;
        let t311: f64 = t159 * t301;
        let t312: f64 = t310 - t311;
        let t313: f64 = 0.8625271797991572 * t290;
        let t314: f64 = 0.8625271797991572 * t291;
        let t315: f64 = 0.8625271797991572 * t292;
        let t327: f64 = 0.7439531358922877 * t316;
        let t328: f64 = 0.7439531358922877 * t317;
        let t329: f64 = 0.7439531358922877 * t318;
        let t330: f64 = t177 * t329;
        let t331: f64 = t178 * t328;
        let t332: f64 = t330 - t331;
        let t333: f64 = t178 * t327;
        let t334: f64 = t176 * t329;
        let t335: f64 = t333 - t334;
        let t336: f64 = t176 * t328;
        let t337: f64 = t177 * t327;
        let t338: f64 = t336 - t337;
        let t339: f64 = 0.8625271797991572 * t316;
        let t340: f64 = 0.8625271797991572 * t317;
        let t341: f64 = 0.8625271797991572 * t318;
        let t366: f64 = 1.0 / t341;
        let t367: f64 = t211 * t366;
        let t368: f64 = t332 * t367;
        let t369: f64 = t200 - t368;
        let t370: f64 = t335 * t367;
        let t371: f64 = t203 - t370;
        let t372: f64 = t338 * t367;
        let t373: f64 = t206 - t372;
        let t374: f64 = t339 * t367;
        let t375: f64 = t209 - t374;
        let t376: f64 = t340 * t367;
        let t377: f64 = t210 - t376;
        let t378: f64 = t326 * t367;
        let t379: f64 = t193 - t378;
        let t382: f64 = t237 * t366;
        let t383: f64 = t332 * t382;
        let t384: f64 = t228 - t383;
        let t385: f64 = t335 * t382;
        let t386: f64 = t231 - t385;
        let t387: f64 = t338 * t382;
        let t388: f64 = t234 - t387;
        let t389: f64 = t339 * t382;
        let t390: f64 = t235 - t389;
        let t391: f64 = t340 * t382;
        let t392: f64 = t236 - t391;
        let t393: f64 = t326 * t382;
        let t394: f64 = t222 - t393;
        let t397: f64 = t263 * t366;
        let t398: f64 = t332 * t397;
        let t399: f64 = t254 - t398;
        let t400: f64 = t335 * t397;
        let t401: f64 = t257 - t400;
        let t402: f64 = t338 * t397;
        let t403: f64 = t260 - t402;
        let t404: f64 = t339 * t397;
        let t405: f64 = t261 - t404;
        let t406: f64 = t340 * t397;
        let t407: f64 = t262 - t406;
        let t408: f64 = t326 * t397;
        let t409: f64 = t248 - t408;
        let t412: f64 = t289 * t366;
        let t413: f64 = t332 * t412;
        let t414: f64 = t280 - t413;
        let t415: f64 = t335 * t412;
        let t416: f64 = t283 - t415;
        let t417: f64 = t338 * t412;
        let t418: f64 = t286 - t417;
        let t419: f64 = t339 * t412;
        let t420: f64 = t287 - t419;
        let t421: f64 = t340 * t412;
        let t422: f64 = t288 - t421;
        let t423: f64 = t326 * t412;
        let t424: f64 = t274 - t423;
        let t427: f64 = t315 * t366;
        let t428: f64 = t332 * t427;
        let t429: f64 = t306 - t428;
        let t430: f64 = t335 * t427;
        let t431: f64 = t309 - t430;
        let t432: f64 = t338 * t427;
        let t433: f64 = t312 - t432;
        let t434: f64 = t339 * t427;
        let t435: f64 = t313 - t434;
        let t436: f64 = t340 * t427;
        let t437: f64 = t314 - t436;
        let t438: f64 = t326 * t427;
        let t439: f64 = t300 - t438;
        let t442: f64 = 1.0 / t422;
        let t443: f64 = t377 * t442;
        let t444: f64 = t414 * t443;
        let t445: f64 = t369 - t444;
        let t446: f64 = t416 * t443;
        let t447: f64 = t371 - t446;
        let t448: f64 = t418 * t443;
        let t449: f64 = t373 - t448;
        let t450: f64 = t420 * t443;
        let t451: f64 = t375 - t450;
        let t452: f64 = t424 * t443;
        let t453: f64 = t379 - t452;
        let t458: f64 = t392 * t442;
        let t459: f64 = t414 * t458;
        let t460: f64 = t384 - t459;
        let t461: f64 = t416 * t458;
        let t462: f64 = t386 - t461;
        let t463: f64 = t418 * t458;
        let t464: f64 = t388 - t463;
        let t465: f64 = t420 * t458;
        let t466: f64 = t390 - t465;
        let t467: f64 = t424 * t458;
        let t468: f64 = t394 - t467;
        let t473: f64 = t407 * t442;
        let t474: f64 = t414 * t473;
        let t475: f64 = t399 - t474;
        let t476: f64 = t416 * t473;
        let t477: f64 = t401 - t476;
        let t478: f64 = t418 * t473;
        let t479: f64 = t403 - t478;
        let t480: f64 = t420 * t473;
        let t481: f64 = t405 - t480;
        let t482: f64 = t424 * t473;
        let t483: f64 = t409 - t482;
        let t488: f64 = t437 * t442;
        let t489: f64 = t414 * t488;
        let t490: f64 = t429 - t489;
        let t491: f64 = t416 * t488;
        let t492: f64 = t431 - t491;
        let t493: f64 = t418 * t488;
        let t494: f64 = t433 - t493;
        let t495: f64 = t420 * t488;
        let t496: f64 = t435 - t495;
        let t497: f64 = t424 * t488;
        let t498: f64 = t439 - t497;
        let t503: f64 = 1.0 / t466;
        let t504: f64 = t451 * t503;
        let t505: f64 = t460 * t504;
        let t506: f64 = t445 - t505;
        let t507: f64 = t462 * t504;
        let t508: f64 = t447 - t507;
        let t509: f64 = t464 * t504;
        let t510: f64 = t449 - t509;
        let t511: f64 = t468 * t504;
        let t512: f64 = t453 - t511;
        let t519: f64 = t481 * t503;
        let t520: f64 = t460 * t519;
        let t521: f64 = t475 - t520;
        let t522: f64 = t462 * t519;
        let t523: f64 = t477 - t522;
        let t524: f64 = t464 * t519;
        let t525: f64 = t479 - t524;
        let t526: f64 = t468 * t519;
        let t527: f64 = t483 - t526;
        let t534: f64 = t496 * t503;
        let t535: f64 = t460 * t534;
        let t536: f64 = t490 - t535;
        let t537: f64 = t462 * t534;
        let t538: f64 = t492 - t537;
        let t539: f64 = t464 * t534;
        let t540: f64 = t494 - t539;
        let t541: f64 = t468 * t534;
        let t542: f64 = t498 - t541;
        let t549: f64 = t523 * t540;
        let t550: f64 = t525 * t538;
        let t551: f64 = t549 - t550;
        let t552: f64 = t508 * t540;
        let t553: f64 = t510 * t538;
        let t555: f64 = t553 - t552;
        let t556: f64 = t508 * t525;
        let t557: f64 = t510 * t523;
        let t558: f64 = t556 - t557;
        let t559: f64 = t521 * t540;
        let t560: f64 = t525 * t536;
        let t562: f64 = t560 - t559;
        let t563: f64 = t506 * t540;
        let t564: f64 = t510 * t536;
        let t565: f64 = t563 - t564;
        let t566: f64 = t506 * t525;
        let t567: f64 = t510 * t521;
        let t569: f64 = t567 - t566;
        let t570: f64 = t521 * t538;
        let t571: f64 = t523 * t536;
        let t572: f64 = t570 - t571;
        let t573: f64 = t506 * t538;
        let t574: f64 = t508 * t536;
        let t576: f64 = t574 - t573;
        let t577: f64 = t506 * t523;
        let t578: f64 = t508 * t521;
        let t579: f64 = t577 - t578;
        let t580: f64 = t506 * t551;
        let t581: f64 = t508 * t562;
        let t582: f64 = t580 + t581;
        let t583: f64 = t510 * t572;
        let t584: f64 = t582 + t583;
        let t585: f64 = 1.0 / t584;
        let t586: f64 = t512 * t551;
        let t587: f64 = t527 * t555;
        let t588: f64 = t586 + t587;
        let t589: f64 = t542 * t558;
        let t590: f64 = t588 + t589;
        let t591: f64 = t585 * t590;
        let t592: f64 = t512 * t562;
        let t593: f64 = t527 * t565;
        let t594: f64 = t592 + t593;
        let t595: f64 = t542 * t569;
        let t596: f64 = t594 + t595;
        let t597: f64 = t585 * t596;
        let t598: f64 = t512 * t572;
        let t599: f64 = t527 * t576;
        let t600: f64 = t598 + t599;
        let t601: f64 = t542 * t579;
        let t602: f64 = t600 + t601;
        let t603: f64 = t585 * t602;
        let t604: f64 = t464 * t603;
        let t605: f64 = t468 - t604;
        let t606: f64 = t462 * t597;
        let t607: f64 = t605 - t606;
        let t608: f64 = t460 * t591;
        let t609: f64 = t607 - t608;
        let t610: f64 = t503 * t609;
        let t611: f64 = t420 * t610;
        let t612: f64 = t424 - t611;
        let t613: f64 = t418 * t603;
        let t614: f64 = t612 - t613;
        let t615: f64 = t416 * t597;
        let t616: f64 = t614 - t615;
        let t617: f64 = t414 * t591;
        let t618: f64 = t616 - t617;
        let t619: f64 = t442 * t618;
        let t620: f64 = t340 * t619;
        let t621: f64 = t326 - t620;
        let t622: f64 = t339 * t610;
        let t623: f64 = t621 - t622;
        let t624: f64 = t338 * t603;
        let t625: f64 = t623 - t624;
        let t626: f64 = t335 * t597;
        let t627: f64 = t625 - t626;
        let t628: f64 = t332 * t591;
        let t629: f64 = t627 - t628;
        let t630: f64 = t366 * t629;
        let t926: f64 = -t591;
        let t927: f64 = -t597;
        let t928: f64 = -t603;
        let t929: f64 = -t610;
        let t930: f64 = -t619;
        let t931: f64 = -t630;
        if !(absolute(t341) > 1.0 * LEAST_PIVOT) { return false; }
        if !(absolute(t422) > 1.0 * LEAST_PIVOT) { return false; }
        if !(absolute(t466) > 1.0 * LEAST_PIVOT) { return false; }
        if !(absolute(t584) > 0.10790763242084472 * LEAST_PIVOT) { return false; }
        let d0: f64 = t926;
        let d1: f64 = t927;
        let d2: f64 = t928;
        let d3: f64 = t929;
        let d4: f64 = t930;
        let d5: f64 = t931;
        let mut longest: f64 = 0.0;
        longest = larger(longest, d0);
        longest = larger(longest, d1);
        longest = larger(longest, d2);
        longest = larger(longest, d3);
        longest = larger(longest, d4);
        longest = larger(longest, d5);
        if !(longest <= LONGEST_STEP) { return false; }
        let t962: f64 = 1.159383754414387 * d3;
        let t963: f64 = 1.159383754414387 * d4;
        let t964: f64 = 1.159383754414387 * d5;
        let t966: f64 = 0.5 * d0;
        let t967: f64 = 0.5 * d1;
        let t968: f64 = 0.5 * d2;
        let t969: f64 = x1 * t966;
        let t970: f64 = x0 - t969;
        let t971: f64 = x2 * t967;
        let t972: f64 = t970 - t971;
        let t973: f64 = x3 * t968;
        let t974: f64 = t972 - t973;
        let t975: f64 = x0 * t966;
        let t976: f64 = x1 + t975;
        let t977: f64 = x3 * t967;
        let t978: f64 = t976 + t977;
        let t979: f64 = x2 * t968;
        let t980: f64 = t978 - t979;
        let t981: f64 = x3 * t966;
        let t982: f64 = x2 - t981;
        let t983: f64 = x0 * t967;
        let t984: f64 = t982 + t983;
        let t985: f64 = x1 * t968;
        let t986: f64 = t984 + t985;
        let t987: f64 = x2 * t966;
        let t988: f64 = x3 + t987;
        let t989: f64 = x1 * t967;
        let t990: f64 = t988 - t989;
        let t991: f64 = x0 * t968;
        let t992: f64 = t990 + t991;
        let t993: f64 = t974 * t974;
        let t994: f64 = t980 * t980;
        let t995: f64 = t993 + t994;
        let t996: f64 = t986 * t986;
        let t997: f64 = t995 + t996;
        let t998: f64 = t992 * t992;
        let t999: f64 = t997 + t998;
        let t1001: f64 = inverse_root(t999);
        let t1002: f64 = t974 * t1001;
        let t1003: f64 = t980 * t1001;
        let t1004: f64 = t986 * t1001;
        let t1005: f64 = t992 * t1001;
        let t1006: f64 = x4 + t962;
        let t1007: f64 = x5 + t963;
        let t1008: f64 = x6 + t964;
        let y0: f64 = t1002;
        let y1: f64 = t1003;
        let y2: f64 = t1004;
        let y3: f64 = t1005;
        let y4: f64 = t1006;
        let y5: f64 = t1007;
        let y6: f64 = t1008;
        x0 = y0;
        x1 = y1;
        x2 = y2;
        x3 = y3;
        x4 = y4;
        x5 = y5;
        x6 = y6;
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
    const CURVATURE: f64 = 3.317874981152291;
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
    const UNKNOWN: [usize; STEPS] = [0, 1, 2, 3, 4, 5];
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
    if !((u[0] >= 0.6 - ROUNDING) & (u[0] <= 1.6 + ROUNDING) & (u[1] >= 0.6 - ROUNDING) & (u[1] <= 1.6 + ROUNDING) & (u[2] >= 0.6 - ROUNDING) & (u[2] <= 1.6 + ROUNDING) & (u[3] >= 0.6 - ROUNDING) & (u[3] <= 1.6 + ROUNDING) & (u[4] >= 0.6 - ROUNDING) & (u[4] <= 1.6 + ROUNDING) & (u[5] >= 0.6 - ROUNDING) & (u[5] <= 1.6 + ROUNDING)) { return false; }
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
    let u3: f64 = u[3];
    let u4: f64 = u[4];
    let u5: f64 = u[5];
    let x0: f64 = x[0];
    let x1: f64 = x[1];
    let x2: f64 = x[2];
    let x3: f64 = x[3];
    let x4: f64 = x[4];
    let x5: f64 = x[5];
    let x6: f64 = x[6];
    let t51: f64 = x1 + x1;
    let t52: f64 = x2 + x2;
    let t53: f64 = x3 + x3;
    let t54: f64 = x0 * t51;
    let t55: f64 = x0 * t52;
    let t56: f64 = x0 * t53;
    let t57: f64 = x1 * t51;
    let t58: f64 = x1 * t52;
    let t59: f64 = x1 * t53;
    let t60: f64 = x2 * t52;
    let t61: f64 = x2 * t53;
    let t62: f64 = x3 * t53;
    let t63: f64 = 1.0 - t60;
    let t64: f64 = t63 - t62;
    let t65: f64 = t56 + t58;
    let t66: f64 = t59 - t55;
    let t67: f64 = t58 - t56;
    let t68: f64 = 1.0 - t57;
    let t69: f64 = t68 - t62;
    let t70: f64 = t54 + t61;
    let t71: f64 = t55 + t59;
    let t72: f64 = t61 - t54;
    let t73: f64 = t68 - t60;
    let t74: f64 = 0.4413 * t64;
    let t75: f64 = 0.4413 * t65;
    let t76: f64 = 0.4413 * t66;
    let t77: f64 = (-0.3448) * t67;
    let t78: f64 = (-0.3448) * t69;
    let t79: f64 = (-0.3448) * t70;
    let t80: f64 = t74 + t77;
    let t81: f64 = t75 + t78;
    let t82: f64 = t76 + t79;
    let t83: f64 = (-0.03) * t71;
    let t84: f64 = (-0.03) * t72;
    let t85: f64 = (-0.03) * t73;
    let t86: f64 = t80 + t83;
    let t87: f64 = t81 + t84;
    let t88: f64 = t82 + t85;
    let t89: f64 = x4 + t86;
    let t90: f64 = x5 + t87;
    let t91: f64 = x6 + t88;
    let t92: f64 = 0.4334 * t64;
    let t93: f64 = 0.4334 * t65;
    let t94: f64 = 0.4334 * t66;
    let t95: f64 = 0.3386 * t67;
    let t96: f64 = 0.3386 * t69;
    let t97: f64 = 0.3386 * t70;
    let t98: f64 = t92 + t95;
    let t99: f64 = t93 + t96;
    let t100: f64 = t94 + t97;
    let t101: f64 = 0.03 * t71;
    let t102: f64 = 0.03 * t72;
    let t103: f64 = 0.03 * t73;
    let t104: f64 = t98 + t101;
    let t105: f64 = t99 + t102;
    let t106: f64 = t100 + t103;
    let t107: f64 = x4 + t104;
    let t108: f64 = x5 + t105;
    let t109: f64 = x6 + t106;
    let t110: f64 = 0.0907 * t64;
    let t111: f64 = 0.0907 * t65;
    let t112: f64 = 0.0907 * t66;
    let t113: f64 = 0.5729 * t67;
    let t114: f64 = 0.5729 * t69;
    let t115: f64 = 0.5729 * t70;
    let t116: f64 = t110 + t113;
    let t117: f64 = t111 + t114;
    let t118: f64 = t112 + t115;
    let t119: f64 = (-0.05) * t71;
    let t120: f64 = (-0.05) * t72;
    let t121: f64 = (-0.05) * t73;
    let t122: f64 = t116 + t119;
    let t123: f64 = t117 + t120;
    let t124: f64 = t118 + t121;
    let t125: f64 = x4 + t122;
    let t126: f64 = x5 + t123;
    let t127: f64 = x6 + t124;
    let t128: f64 = (-0.4821) * t64;
    let t129: f64 = (-0.4821) * t65;
    let t130: f64 = (-0.4821) * t66;
    let t131: f64 = 0.1948 * t67;
    let t132: f64 = 0.1948 * t69;
    let t133: f64 = 0.1948 * t70;
    let t134: f64 = t128 + t131;
    let t135: f64 = t129 + t132;
    let t136: f64 = t130 + t133;
    let t137: f64 = 0.04 * t71;
    let t138: f64 = 0.04 * t72;
    let t139: f64 = 0.04 * t73;
    let t140: f64 = t134 + t137;
    let t141: f64 = t135 + t138;
    let t142: f64 = t136 + t139;
    let t143: f64 = x4 + t140;
    let t144: f64 = x5 + t141;
    let t145: f64 = x6 + t142;
    let t146: f64 = (-0.5247) * t64;
    let t147: f64 = (-0.5247) * t65;
    let t148: f64 = (-0.5247) * t66;
    let t149: f64 = (-0.2227) * t67;
    let t150: f64 = (-0.2227) * t69;
    let t151: f64 = (-0.2227) * t70;
    let t152: f64 = t146 + t149;
    let t153: f64 = t147 + t150;
    let t154: f64 = t148 + t151;
    let t155: f64 = (-0.02) * t71;
    let t156: f64 = (-0.02) * t72;
    let t157: f64 = (-0.02) * t73;
    let t158: f64 = t152 + t155;
    let t159: f64 = t153 + t156;
    let t160: f64 = t154 + t157;
    let t161: f64 = x4 + t158;
    let t162: f64 = x5 + t159;
    let t163: f64 = x6 + t160;
    let t164: f64 = 0.0658 * t64;
    let t165: f64 = 0.0658 * t65;
    let t166: f64 = 0.0658 * t66;
    let t167: f64 = (-0.536) * t67;
    let t168: f64 = (-0.536) * t69;
    let t169: f64 = (-0.536) * t70;
    let t170: f64 = t164 + t167;
    let t171: f64 = t165 + t168;
    let t172: f64 = t166 + t169;
    let t173: f64 = 0.06 * t71;
    let t174: f64 = 0.06 * t72;
    let t175: f64 = 0.06 * t73;
    let t176: f64 = t170 + t173;
    let t177: f64 = t171 + t174;
    let t178: f64 = t172 + t175;
    let t179: f64 = x4 + t176;
    let t180: f64 = x5 + t177;
    let t181: f64 = x6 + t178;
    let t182: f64 = t89 - 0.9272;
    let t183: f64 = t90 - (-0.3746);
    let t184: f64 = t91 - 0.05;
    let t195: f64 = 0.7439531358922877 * t182;
    let t196: f64 = 0.7439531358922877 * t183;
    let t197: f64 = 0.7439531358922877 * t184;
    let t198: f64 = t87 * t197;
    let t199: f64 = t88 * t196;
    let t200: f64 = t198 - t199;
    let t201: f64 = t88 * t195;
    let t202: f64 = t86 * t197;
    let t203: f64 = t201 - t202;
    let t204: f64 = t86 * t196;
    let t205: f64 = t87 * t195;
    let t206: f64 = t204 - t205;
    let t209: f64 = 0.8625271797991572 * t182;
    let t210: f64 = 0.8625271797991572 * t183;
    let t211: f64 = 0.8625271797991572 * t184;
    let t212: f64 = t107 - 0.9356;
    let t213: f64 = t108 - 0.4767;
    let t214: f64 = t109 - (-0.04);
    let t223: f64 = 0.7439531358922877 * t212;
    let t224: f64 = 0.7439531358922877 * t213;
    let t225: f64 = 0.7439531358922877 * t214;
    let t226: f64 = t105 * t225;
    let t227: f64 = t106 * t224;
    let t228: f64 = t226 - t227;
    let t229: f64 = t106 * t223;
    let t230: f64 = t104 * t225;
    let t231: f64 = t229 - t230;
    let t232: f64 = t104 * t224;
    let t233: f64 = t105 * t223;
    let t234: f64 = t232 - t233;
    let t235: f64 = 0.8625271797991572 * t212;
    let t236: f64 = 0.8625271797991572 * t213;
    let t237: f64 = 0.8625271797991572 * t214;
    let t238: f64 = t125 - (-0.1182);
    let t239: f64 = t126 - 0.9628;
    let t240: f64 = t127 - 0.08;
    let t249: f64 = 0.7439531358922877 * t238;
    let t250: f64 = 0.7439531358922877 * t239;
    let t251: f64 = 0.7439531358922877 * t240;
    let t252: f64 = t123 * t251;
    let t253: f64 = t124 * t250;
    let t254: f64 = t252 - t253;
    let t255: f64 = t124 * t249;
    let t256: f64 = t122 * t251;
    let t257: f64 = t255 - t256;
    let t258: f64 = t122 * t250;
    let t259: f64 = t123 * t249;
    let t260: f64 = t258 - t259;
    let t261: f64 = 0.8625271797991572 * t238;
    let t262: f64 = 0.8625271797991572 * t239;
    let t263: f64 = 0.8625271797991572 * t240;
    let t264: f64 = t143 - (-0.8456);
    let t265: f64 = t144 - 0.5704;
    let t266: f64 = t145 - (-0.06);
    let t275: f64 = 0.7439531358922877 * t264;
    let t276: f64 = 0.7439531358922877 * t265;
    let t277: f64 = 0.7439531358922877 * t266;
    let t278: f64 = t141 * t277;
    let t279: f64 = t142 * t276;
    let t280: f64 = t278 - t279;
    let t281: f64 = t142 * t275;
    let t282: f64 = t140 * t277;
    let t283: f64 = t281 - t282;
    let t284: f64 = t140 * t276;
    let t285: f64 = t141 * t275;
    let t286: f64 = t284 - t285;
    let t287: f64 = 0.8625271797991572 * t264;
    let t288: f64 = 0.8625271797991572 * t265;
    let t289: f64 = 0.8625271797991572 * t266;
    let t290: f64 = t161 - (-0.7782);
    let t291: f64 = t162 - (-0.5449);
    let t292: f64 = t163 - 0.03;
    let t301: f64 = 0.7439531358922877 * t290;
    let t302: f64 = 0.7439531358922877 * t291;
    let t303: f64 = 0.7439531358922877 * t292;
    let t304: f64 = t159 * t303;
    let t305: f64 = t160 * t302;
    let t306: f64 = t304 - t305;
    let t307: f64 = t160 * t301;
    let t308: f64 = t158 * t303;
    let t309: f64 = t307 - t308;
    let t310: f64 = t158 * t302;
    let t311: f64 = t159 * t301;
    let t312: f64 = t310 - t311;
    let t313: f64 = 0.8625271797991572 * t290;
    let t314: f64 = 0.8625271797991572 * t291;
    let t315: f64 = 0.8625271797991572 * t292;
    let t316: f64 = t179 - (-0.1267);
    let t317: f64 = t180 - (-1.0322);
    let t318: f64 = t181 - (-0.07);
    let t327: f64 = 0.7439531358922877 * t316;
    let t328: f64 = 0.7439531358922877 * t317;
    let t329: f64 = 0.7439531358922877 * t318;
    let t330: f64 = t177 * t329;
    let t331: f64 = t178 * t328;
    let t332: f64 = t330 - t331;
    let t333: f64 = t178 * t327;
    let t334: f64 = t176 * t329;
    let t335: f64 = t333 - t334;
    let t336: f64 = t176 * t328;
    let t337: f64 = t177 * t327;
    let t338: f64 = t336 - t337;
    let t339: f64 = 0.8625271797991572 * t316;
    let t340: f64 = 0.8625271797991572 * t317;
    let t341: f64 = 0.8625271797991572 * t318;
    let t342: f64 = u0 + u0;
    let t344: f64 = 0.37197656794614387 * t342;
    let t346: f64 = u1 + u1;
    let t348: f64 = 0.37197656794614387 * t346;
    let t350: f64 = u2 + u2;
    let t352: f64 = 0.37197656794614387 * t350;
    let t354: f64 = u3 + u3;
    let t356: f64 = 0.37197656794614387 * t354;
    let t358: f64 = u4 + u4;
    let t360: f64 = 0.37197656794614387 * t358;
    let t362: f64 = u5 + u5;
    let t364: f64 = 0.37197656794614387 * t362;
    let t366: f64 = 1.0 / t341;
    let t367: f64 = t211 * t366;
    let t368: f64 = t332 * t367;
    let t369: f64 = t200 - t368;
    let t370: f64 = t335 * t367;
    let t371: f64 = t203 - t370;
    let t372: f64 = t338 * t367;
    let t373: f64 = t206 - t372;
    let t374: f64 = t339 * t367;
    let t375: f64 = t209 - t374;
    let t376: f64 = t340 * t367;
    let t377: f64 = t210 - t376;
    let t380: f64 = t364 * t367;
    let t382: f64 = t237 * t366;
    let t383: f64 = t332 * t382;
    let t384: f64 = t228 - t383;
    let t385: f64 = t335 * t382;
    let t386: f64 = t231 - t385;
    let t387: f64 = t338 * t382;
    let t388: f64 = t234 - t387;
    let t389: f64 = t339 * t382;
    let t390: f64 = t235 - t389;
    let t391: f64 = t340 * t382;
    let t392: f64 = t236 - t391;
    let t395: f64 = t364 * t382;
    let t397: f64 = t263 * t366;
    let t398: f64 = t332 * t397;
    let t399: f64 = t254 - t398;
    let t400: f64 = t335 * t397;
    let t401: f64 = t257 - t400;
    let t402: f64 = t338 * t397;
    let t403: f64 = t260 - t402;
    let t404: f64 = t339 * t397;
    let t405: f64 = t261 - t404;
    let t406: f64 = t340 * t397;
    let t407: f64 = t262 - t406;
    let t410: f64 = t364 * t397;
    let t412: f64 = t289 * t366;
    let t413: f64 = t332 * t412;
    let t414: f64 = t280 - t413;
    let t415: f64 = t335 * t412;
    let t416: f64 = t283 - t415;
    let t417: f64 = t338 * t412;
    let t418: f64 = t286 - t417;
    let t419: f64 = t339 * t412;
    let t420: f64 = t287 - t419;
    let t421: f64 = t340 * t412;
    let t422: f64 = t288 - t421;
    let t425: f64 = t364 * t412;
    let t427: f64 = t315 * t366;
    let t428: f64 = t332 * t427;
    let t429: f64 = t306 - t428;
    let t430: f64 = t335 * t427;
    let t431: f64 = t309 - t430;
    let t432: f64 = t338 * t427;
    let t433: f64 = t312 - t432;
    let t434: f64 = t339 * t427;
    let t435: f64 = t313 - t434;
    let t436: f64 = t340 * t427;
    let t437: f64 = t314 - t436;
    let t440: f64 = t364 * t427;
    let t442: f64 = 1.0 / t422;
    let t443: f64 = t377 * t442;
    let t444: f64 = t414 * t443;
    let t445: f64 = t369 - t444;
    let t446: f64 = t416 * t443;
    let t447: f64 = t371 - t446;
    let t448: f64 = t418 * t443;
    let t449: f64 = t373 - t448;
    let t450: f64 = t420 * t443;
    let t451: f64 = t375 - t450;
    let t454: f64 = t356 * t443;
    let t456: f64 = t425 * t443;
    let t457: f64 = t380 - t456;
    let t458: f64 = t392 * t442;
    let t459: f64 = t414 * t458;
    let t460: f64 = t384 - t459;
    let t461: f64 = t416 * t458;
    let t462: f64 = t386 - t461;
    let t463: f64 = t418 * t458;
    let t464: f64 = t388 - t463;
    let t465: f64 = t420 * t458;
    let t466: f64 = t390 - t465;
    let t469: f64 = t356 * t458;
    let t471: f64 = t425 * t458;
    let t472: f64 = t395 - t471;
    let t473: f64 = t407 * t442;
    let t474: f64 = t414 * t473;
    let t475: f64 = t399 - t474;
    let t476: f64 = t416 * t473;
    let t477: f64 = t401 - t476;
    let t478: f64 = t418 * t473;
    let t479: f64 = t403 - t478;
    let t480: f64 = t420 * t473;
    let t481: f64 = t405 - t480;
    let t484: f64 = t356 * t473;
    let t486: f64 = t425 * t473;
    let t487: f64 = t410 - t486;
    let t488: f64 = t437 * t442;
    let t489: f64 = t414 * t488;
    let t490: f64 = t429 - t489;
    let t491: f64 = t416 * t488;
    let t492: f64 = t431 - t491;
    let t493: f64 = t418 * t488;
    let t494: f64 = t433 - t493;
    let t495: f64 = t420 * t488;
    let t496: f64 = t435 - t495;
    let t499: f64 = t356 * t488;
    let t501: f64 = t425 * t488;
    let t502: f64 = t440 - t501;
    let t503: f64 = 1.0 / t466;
    let t504: f64 = t451 * t503;
    let t505: f64 = t460 * t504;
    let t506: f64 = t445 - t505;
    let t507: f64 = t462 * t504;
    let t508: f64 = t447 - t507;
    let t509: f64 = t464 * t504;
    let t510: f64 = t449 - t509;
    let t513: f64 = t348 * t504;
    let t515: f64 = t469 * t504;
    let t516: f64 = t454 - t515;
    let t517: f64 = t472 * t504;
    let t518: f64 = t457 - t517;
    let t519: f64 = t481 * t503;
    let t520: f64 = t460 * t519;
    let t521: f64 = t475 - t520;
    let t522: f64 = t462 * t519;
    let t523: f64 = t477 - t522;
    let t524: f64 = t464 * t519;
    let t525: f64 = t479 - t524;
    let t528: f64 = t348 * t519;
    let t530: f64 = t469 * t519;
    let t531: f64 = t484 - t530;
    let t532: f64 = t472 * t519;
    let t533: f64 = t487 - t532;
    let t534: f64 = t496 * t503;
    let t535: f64 = t460 * t534;
    let t536: f64 = t490 - t535;
    let t537: f64 = t462 * t534;
    let t538: f64 = t492 - t537;
    let t539: f64 = t464 * t534;
    let t540: f64 = t494 - t539;
    let t543: f64 = t348 * t534;
    let t545: f64 = t469 * t534;
    let t546: f64 = t499 - t545;
    let t547: f64 = t472 * t534;
    let t548: f64 = t502 - t547;
    let t549: f64 = t523 * t540;
    let t550: f64 = t525 * t538;
    let t551: f64 = t549 - t550;
    let t552: f64 = t508 * t540;
    let t553: f64 = t510 * t538;
    let t555: f64 = t553 - t552;
    let t556: f64 = t508 * t525;
    let t557: f64 = t510 * t523;
    let t558: f64 = t556 - t557;
    let t559: f64 = t521 * t540;
    let t560: f64 = t525 * t536;
    let t562: f64 = t560 - t559;
    let t563: f64 = t506 * t540;
    let t564: f64 = t510 * t536;
    let t565: f64 = t563 - t564;
    let t566: f64 = t506 * t525;
    let t567: f64 = t510 * t521;
    let t569: f64 = t567 - t566;
    let t570: f64 = t521 * t538;
    let t571: f64 = t523 * t536;
    let t572: f64 = t570 - t571;
    let t573: f64 = t506 * t538;
    let t574: f64 = t508 * t536;
    let t576: f64 = t574 - t573;
    let t577: f64 = t506 * t523;
    let t578: f64 = t508 * t521;
    let t579: f64 = t577 - t578;
    let t580: f64 = t506 * t551;
    let t581: f64 = t508 * t562;
    let t582: f64 = t580 + t581;
    let t583: f64 = t510 * t572;
    let t584: f64 = t582 + t583;
    let t585: f64 = 1.0 / t584;
    let t631: f64 = t344 * t551;
    let t633: f64 = t585 * t631;
    let t635: f64 = t344 * t562;
    let t637: f64 = t585 * t635;
    let t639: f64 = t344 * t572;
    let t641: f64 = t585 * t639;
    let t643: f64 = t464 * t641;
    let t645: f64 = t462 * t637;
    let t647: f64 = t643 + t645;
    let t648: f64 = t460 * t633;
    let t650: f64 = t647 + t648;
    let t651: f64 = t503 * t650;
    let t652: f64 = t420 * t651;
    let t654: f64 = t418 * t641;
    let t656: f64 = t654 - t652;
    let t657: f64 = t416 * t637;
    let t659: f64 = t656 + t657;
    let t660: f64 = t414 * t633;
    let t662: f64 = t659 + t660;
    let t663: f64 = t442 * t662;
    let t664: f64 = t340 * t663;
    let t666: f64 = t339 * t651;
    let t667: f64 = t664 + t666;
    let t669: f64 = t338 * t641;
    let t671: f64 = t669 - t667;
    let t672: f64 = t335 * t637;
    let t674: f64 = t671 + t672;
    let t675: f64 = t332 * t633;
    let t677: f64 = t674 + t675;
    let t678: f64 = t366 * t677;
    let t679: f64 = t513 * t551;
    let t680: f64 = t528 * t555;
    let t681: f64 = t679 + t680;
    let t682: f64 = t543 * t558;
    let t683: f64 = t681 + t682;
    let t684: f64 = t585 * t683;
    let t685: f64 = t513 * t562;
    let t686: f64 = t528 * t565;
    let t687: f64 = t685 + t686;
    let t688: f64 = t543 * t569;
    let t689: f64 = t687 + t688;
    let t690: f64 = t585 * t689;
    let t691: f64 = t513 * t572;
    let t692: f64 = t528 * t576;
    let t693: f64 = t691 + t692;
    let t694: f64 = t543 * t579;
    let t695: f64 = t693 + t694;
    let t696: f64 = t585 * t695;
    let t697: f64 = t464 * t696;
    let t698: f64 = t348 + t697;
    let t700: f64 = t462 * t690;
    let t701: f64 = t698 + t700;
    let t703: f64 = t460 * t684;
    let t704: f64 = t701 + t703;
    let t706: f64 = t503 * t704;
    let t708: f64 = t420 * t706;
    let t710: f64 = t418 * t696;
    let t711: f64 = t708 - t710;
    let t712: f64 = t416 * t690;
    let t713: f64 = t711 - t712;
    let t714: f64 = t414 * t684;
    let t715: f64 = t713 - t714;
    let t716: f64 = t442 * t715;
    let t717: f64 = t340 * t716;
    let t719: f64 = t339 * t706;
    let t721: f64 = t719 - t717;
    let t722: f64 = t338 * t696;
    let t723: f64 = t721 - t722;
    let t724: f64 = t335 * t690;
    let t725: f64 = t723 - t724;
    let t726: f64 = t332 * t684;
    let t727: f64 = t725 - t726;
    let t728: f64 = t366 * t727;
    let t729: f64 = t352 * t555;
    let t731: f64 = t585 * t729;
    let t733: f64 = t352 * t565;
    let t735: f64 = t585 * t733;
    let t737: f64 = t352 * t576;
    let t739: f64 = t585 * t737;
    let t741: f64 = t464 * t739;
    let t743: f64 = t462 * t735;
    let t745: f64 = t741 + t743;
    let t746: f64 = t460 * t731;
    let t748: f64 = t745 + t746;
    let t749: f64 = t503 * t748;
    let t750: f64 = t420 * t749;
    let t752: f64 = t418 * t739;
    let t754: f64 = t752 - t750;
    let t755: f64 = t416 * t735;
    let t757: f64 = t754 + t755;
    let t758: f64 = t414 * t731;
    let t760: f64 = t757 + t758;
    let t761: f64 = t442 * t760;
    let t762: f64 = t340 * t761;
    let t764: f64 = t339 * t749;
    let t765: f64 = t762 + t764;
    let t767: f64 = t338 * t739;
    let t769: f64 = t767 - t765;
    let t770: f64 = t335 * t735;
    let t772: f64 = t769 + t770;
    let t773: f64 = t332 * t731;
    let t775: f64 = t772 + t773;
    let t776: f64 = t366 * t775;
    let t777: f64 = t516 * t551;
    let t778: f64 = t531 * t555;
    let t779: f64 = t777 + t778;
    let t780: f64 = t546 * t558;
    let t781: f64 = t779 + t780;
    let t782: f64 = t585 * t781;
    let t783: f64 = t516 * t562;
    let t784: f64 = t531 * t565;
    let t785: f64 = t783 + t784;
    let t786: f64 = t546 * t569;
    let t787: f64 = t785 + t786;
    let t788: f64 = t585 * t787;
    let t789: f64 = t516 * t572;
    let t790: f64 = t531 * t576;
    let t791: f64 = t789 + t790;
    let t792: f64 = t546 * t579;
    let t793: f64 = t791 + t792;
    let t794: f64 = t585 * t793;
    let t795: f64 = t464 * t794;
    let t796: f64 = t469 - t795;
    let t797: f64 = t462 * t788;
    let t798: f64 = t796 - t797;
    let t799: f64 = t460 * t782;
    let t800: f64 = t798 - t799;
    let t801: f64 = t503 * t800;
    let t802: f64 = t420 * t801;
    let t803: f64 = t356 + t802;
    let t805: f64 = t418 * t794;
    let t806: f64 = t803 + t805;
    let t808: f64 = t416 * t788;
    let t809: f64 = t806 + t808;
    let t811: f64 = t414 * t782;
    let t812: f64 = t809 + t811;
    let t814: f64 = t442 * t812;
    let t816: f64 = t340 * t814;
    let t818: f64 = t339 * t801;
    let t819: f64 = t816 - t818;
    let t820: f64 = t338 * t794;
    let t821: f64 = t819 - t820;
    let t822: f64 = t335 * t788;
    let t823: f64 = t821 - t822;
    let t824: f64 = t332 * t782;
    let t825: f64 = t823 - t824;
    let t826: f64 = t366 * t825;
    let t827: f64 = t360 * t558;
    let t829: f64 = t585 * t827;
    let t831: f64 = t360 * t569;
    let t833: f64 = t585 * t831;
    let t835: f64 = t360 * t579;
    let t837: f64 = t585 * t835;
    let t839: f64 = t464 * t837;
    let t841: f64 = t462 * t833;
    let t843: f64 = t839 + t841;
    let t844: f64 = t460 * t829;
    let t846: f64 = t843 + t844;
    let t847: f64 = t503 * t846;
    let t848: f64 = t420 * t847;
    let t850: f64 = t418 * t837;
    let t852: f64 = t850 - t848;
    let t853: f64 = t416 * t833;
    let t855: f64 = t852 + t853;
    let t856: f64 = t414 * t829;
    let t858: f64 = t855 + t856;
    let t859: f64 = t442 * t858;
    let t860: f64 = t340 * t859;
    let t862: f64 = t339 * t847;
    let t863: f64 = t860 + t862;
    let t865: f64 = t338 * t837;
    let t867: f64 = t865 - t863;
    let t868: f64 = t335 * t833;
    let t870: f64 = t867 + t868;
    let t871: f64 = t332 * t829;
    let t873: f64 = t870 + t871;
    let t874: f64 = t366 * t873;
    let t875: f64 = t518 * t551;
    let t876: f64 = t533 * t555;
    let t877: f64 = t875 + t876;
    let t878: f64 = t548 * t558;
    let t879: f64 = t877 + t878;
    let t880: f64 = t585 * t879;
    let t881: f64 = t518 * t562;
    let t882: f64 = t533 * t565;
    let t883: f64 = t881 + t882;
    let t884: f64 = t548 * t569;
    let t885: f64 = t883 + t884;
    let t886: f64 = t585 * t885;
    let t887: f64 = t518 * t572;
    let t888: f64 = t533 * t576;
    let t889: f64 = t887 + t888;
    let t890: f64 = t548 * t579;
    let t891: f64 = t889 + t890;
    let t892: f64 = t585 * t891;
    let t893: f64 = t464 * t892;
    let t894: f64 = t472 - t893;
    let t895: f64 = t462 * t886;
    let t896: f64 = t894 - t895;
    let t897: f64 = t460 * t880;
    let t898: f64 = t896 - t897;
    let t899: f64 = t503 * t898;
    let t900: f64 = t420 * t899;
    let t901: f64 = t425 - t900;
    let t902: f64 = t418 * t892;
    let t903: f64 = t901 - t902;
    let t904: f64 = t416 * t886;
    let t905: f64 = t903 - t904;
    let t906: f64 = t414 * t880;
    let t907: f64 = t905 - t906;
    let t908: f64 = t442 * t907;
    let t909: f64 = t340 * t908;
    let t910: f64 = t364 + t909;
    let t912: f64 = t339 * t899;
    let t913: f64 = t910 + t912;
    let t915: f64 = t338 * t892;
    let t916: f64 = t913 + t915;
    let t918: f64 = t335 * t886;
    let t919: f64 = t916 + t918;
    let t921: f64 = t332 * t880;
    let t922: f64 = t919 + t921;
    let t924: f64 = t366 * t922;
    let t1009: f64 = 1.159383754414387 * t651;
    let t1010: f64 = -t1009;
    let t1011: f64 = 1.159383754414387 * t663;
    let t1012: f64 = -t1011;
    let t1013: f64 = 1.159383754414387 * t678;
    let t1014: f64 = -t1013;
    let t1015: f64 = 0.5 * t633;
    let t1016: f64 = 0.5 * t637;
    let t1017: f64 = 0.5 * t641;
    let t1018: f64 = x1 * t1015;
    let t1020: f64 = x2 * t1016;
    let t1021: f64 = t1018 + t1020;
    let t1023: f64 = x3 * t1017;
    let t1024: f64 = t1021 + t1023;
    let t1026: f64 = x0 * t1015;
    let t1027: f64 = x3 * t1016;
    let t1028: f64 = t1026 + t1027;
    let t1029: f64 = x2 * t1017;
    let t1030: f64 = t1028 - t1029;
    let t1031: f64 = x3 * t1015;
    let t1033: f64 = x0 * t1016;
    let t1034: f64 = t1033 - t1031;
    let t1035: f64 = x1 * t1017;
    let t1036: f64 = t1034 + t1035;
    let t1037: f64 = x2 * t1015;
    let t1038: f64 = x1 * t1016;
    let t1039: f64 = t1037 - t1038;
    let t1040: f64 = x0 * t1017;
    let t1041: f64 = t1039 + t1040;
    let t1042: f64 = x0 * x0;
    let t1043: f64 = x0 * t1024;
    let t1045: f64 = t1043 + t1043;
    let t1047: f64 = x1 * x1;
    let t1048: f64 = x1 * t1030;
    let t1049: f64 = t1048 + t1048;
    let t1050: f64 = t1042 + t1047;
    let t1051: f64 = t1049 - t1045;
    let t1052: f64 = x2 * x2;
    let t1053: f64 = x2 * t1036;
    let t1054: f64 = t1053 + t1053;
    let t1055: f64 = t1050 + t1052;
    let t1056: f64 = t1051 + t1054;
    let t1057: f64 = x3 * x3;
    let t1058: f64 = x3 * t1041;
    let t1059: f64 = t1058 + t1058;
    let t1060: f64 = t1055 + t1057;
    let t1061: f64 = t1056 + t1059;
    let t1063: f64 = 0.5 * inverse_root(t1060);
    let t1064: f64 = t1061 * t1063;
    let t1065: f64 = inverse_root(t1060);
    let t1066: f64 = t1064 * t1065;
    let t1067: f64 = -t1066;
    let t1068: f64 = t1067 * inverse_root(t1060);
    let t1070: f64 = x0 * t1068;
    let t1071: f64 = t1024 * t1065;
    let t1073: f64 = t1070 - t1071;
    let t1075: f64 = x1 * t1068;
    let t1076: f64 = t1030 * t1065;
    let t1077: f64 = t1075 + t1076;
    let t1079: f64 = x2 * t1068;
    let t1080: f64 = t1036 * t1065;
    let t1081: f64 = t1079 + t1080;
    let t1083: f64 = x3 * t1068;
    let t1084: f64 = t1041 * t1065;
    let t1085: f64 = t1083 + t1084;
    let t1086: f64 = 1.159383754414387 * t706;
    let t1087: f64 = 1.159383754414387 * t716;
    let t1088: f64 = -t1087;
    let t1089: f64 = 1.159383754414387 * t728;
    let t1090: f64 = -t1089;
    let t1091: f64 = 0.5 * t684;
    let t1093: f64 = 0.5 * t690;
    let t1095: f64 = 0.5 * t696;
    let t1097: f64 = x1 * t1091;
    let t1099: f64 = x2 * t1093;
    let t1101: f64 = t1097 + t1099;
    let t1102: f64 = x3 * t1095;
    let t1104: f64 = t1101 + t1102;
    let t1105: f64 = x0 * t1091;
    let t1107: f64 = x3 * t1093;
    let t1109: f64 = t1105 + t1107;
    let t1111: f64 = x2 * t1095;
    let t1113: f64 = t1111 - t1109;
    let t1114: f64 = x3 * t1091;
    let t1116: f64 = x0 * t1093;
    let t1118: f64 = t1114 - t1116;
    let t1119: f64 = x1 * t1095;
    let t1121: f64 = t1118 - t1119;
    let t1122: f64 = x2 * t1091;
    let t1124: f64 = x1 * t1093;
    let t1126: f64 = t1124 - t1122;
    let t1127: f64 = x0 * t1095;
    let t1129: f64 = t1126 - t1127;
    let t1130: f64 = x0 * t1104;
    let t1131: f64 = t1130 + t1130;
    let t1132: f64 = x1 * t1113;
    let t1133: f64 = t1132 + t1132;
    let t1134: f64 = t1131 + t1133;
    let t1135: f64 = x2 * t1121;
    let t1136: f64 = t1135 + t1135;
    let t1137: f64 = t1134 + t1136;
    let t1138: f64 = x3 * t1129;
    let t1139: f64 = t1138 + t1138;
    let t1140: f64 = t1137 + t1139;
    let t1141: f64 = t1063 * t1140;
    let t1142: f64 = t1065 * t1141;
    let t1143: f64 = -t1142;
    let t1144: f64 = t1143 * inverse_root(t1060);
    let t1145: f64 = x0 * t1144;
    let t1146: f64 = t1065 * t1104;
    let t1147: f64 = t1145 + t1146;
    let t1148: f64 = x1 * t1144;
    let t1149: f64 = t1065 * t1113;
    let t1150: f64 = t1148 + t1149;
    let t1151: f64 = x2 * t1144;
    let t1152: f64 = t1065 * t1121;
    let t1153: f64 = t1151 + t1152;
    let t1154: f64 = x3 * t1144;
    let t1155: f64 = t1065 * t1129;
    let t1156: f64 = t1154 + t1155;
    let t1157: f64 = 1.159383754414387 * t749;
    let t1158: f64 = -t1157;
    let t1159: f64 = 1.159383754414387 * t761;
    let t1160: f64 = -t1159;
    let t1161: f64 = 1.159383754414387 * t776;
    let t1162: f64 = -t1161;
    let t1163: f64 = 0.5 * t731;
    let t1164: f64 = 0.5 * t735;
    let t1165: f64 = 0.5 * t739;
    let t1166: f64 = x1 * t1163;
    let t1168: f64 = x2 * t1164;
    let t1169: f64 = t1166 + t1168;
    let t1171: f64 = x3 * t1165;
    let t1172: f64 = t1169 + t1171;
    let t1174: f64 = x0 * t1163;
    let t1175: f64 = x3 * t1164;
    let t1176: f64 = t1174 + t1175;
    let t1177: f64 = x2 * t1165;
    let t1178: f64 = t1176 - t1177;
    let t1179: f64 = x3 * t1163;
    let t1181: f64 = x0 * t1164;
    let t1182: f64 = t1181 - t1179;
    let t1183: f64 = x1 * t1165;
    let t1184: f64 = t1182 + t1183;
    let t1185: f64 = x2 * t1163;
    let t1186: f64 = x1 * t1164;
    let t1187: f64 = t1185 - t1186;
    let t1188: f64 = x0 * t1165;
    let t1189: f64 = t1187 + t1188;
    let t1190: f64 = x0 * t1172;
    let t1192: f64 = t1190 + t1190;
    let t1194: f64 = x1 * t1178;
    let t1195: f64 = t1194 + t1194;
    let t1196: f64 = t1195 - t1192;
    let t1197: f64 = x2 * t1184;
    let t1198: f64 = t1197 + t1197;
    let t1199: f64 = t1196 + t1198;
    let t1200: f64 = x3 * t1189;
    let t1201: f64 = t1200 + t1200;
    let t1202: f64 = t1199 + t1201;
    let t1203: f64 = t1063 * t1202;
    let t1204: f64 = t1065 * t1203;
    let t1205: f64 = -t1204;
    let t1206: f64 = t1205 * inverse_root(t1060);
    let t1207: f64 = x0 * t1206;
    let t1208: f64 = t1065 * t1172;
    let t1210: f64 = t1207 - t1208;
    let t1211: f64 = x1 * t1206;
    let t1212: f64 = t1065 * t1178;
    let t1213: f64 = t1211 + t1212;
    let t1214: f64 = x2 * t1206;
    let t1215: f64 = t1065 * t1184;
    let t1216: f64 = t1214 + t1215;
    let t1217: f64 = x3 * t1206;
    let t1218: f64 = t1065 * t1189;
    let t1219: f64 = t1217 + t1218;
    let t1220: f64 = 1.159383754414387 * t801;
    let t1221: f64 = -t1220;
    let t1222: f64 = 1.159383754414387 * t814;
    let t1223: f64 = 1.159383754414387 * t826;
    let t1224: f64 = -t1223;
    let t1225: f64 = 0.5 * t782;
    let t1227: f64 = 0.5 * t788;
    let t1229: f64 = 0.5 * t794;
    let t1231: f64 = x1 * t1225;
    let t1233: f64 = x2 * t1227;
    let t1235: f64 = t1231 + t1233;
    let t1236: f64 = x3 * t1229;
    let t1238: f64 = t1235 + t1236;
    let t1239: f64 = x0 * t1225;
    let t1241: f64 = x3 * t1227;
    let t1243: f64 = t1239 + t1241;
    let t1245: f64 = x2 * t1229;
    let t1247: f64 = t1245 - t1243;
    let t1248: f64 = x3 * t1225;
    let t1250: f64 = x0 * t1227;
    let t1252: f64 = t1248 - t1250;
    let t1253: f64 = x1 * t1229;
    let t1255: f64 = t1252 - t1253;
    let t1256: f64 = x2 * t1225;
    let t1258: f64 = x1 * t1227;
    let t1260: f64 = t1258 - t1256;
    let t1261: f64 = x0 * t1229;
    let t1263: f64 = t1260 - t1261;
    let t1264: f64 = x0 * t1238;
    let t1265: f64 = t1264 + t1264;
    let t1266: f64 = x1 * t1247;
    let t1267: f64 = t1266 + t1266;
    let t1268: f64 = t1265 + t1267;
    let t1269: f64 = x2 * t1255;
    let t1270: f64 = t1269 + t1269;
    let t1271: f64 = t1268 + t1270;
    let t1272: f64 = x3 * t1263;
    let t1273: f64 = t1272 + t1272;
    let t1274: f64 = t1271 + t1273;
    let t1275: f64 = t1063 * t1274;
    let t1276: f64 = t1065 * t1275;
    let t1277: f64 = -t1276;
    let t1278: f64 = t1277 * inverse_root(t1060);
    let t1279: f64 = x0 * t1278;
    let t1280: f64 = t1065 * t1238;
    let t1281: f64 = t1279 + t1280;
    let t1282: f64 = x1 * t1278;
    let t1283: f64 = t1065 * t1247;
    let t1284: f64 = t1282 + t1283;
    let t1285: f64 = x2 * t1278;
    let t1286: f64 = t1065 * t1255;
    let t1287: f64 = t1285 + t1286;
    let t1288: f64 = x3 * t1278;
    let t1289: f64 = t1065 * t1263;
    let t1290: f64 = t1288 + t1289;
    let t1291: f64 = 1.159383754414387 * t847;
    let t1292: f64 = -t1291;
    let t1293: f64 = 1.159383754414387 * t859;
    let t1294: f64 = -t1293;
    let t1295: f64 = 1.159383754414387 * t874;
    let t1296: f64 = -t1295;
    let t1297: f64 = 0.5 * t829;
    let t1298: f64 = 0.5 * t833;
    let t1299: f64 = 0.5 * t837;
    let t1300: f64 = x1 * t1297;
    let t1302: f64 = x2 * t1298;
    let t1303: f64 = t1300 + t1302;
    let t1305: f64 = x3 * t1299;
    let t1306: f64 = t1303 + t1305;
    let t1308: f64 = x0 * t1297;
    let t1309: f64 = x3 * t1298;
    let t1310: f64 = t1308 + t1309;
    let t1311: f64 = x2 * t1299;
    let t1312: f64 = t1310 - t1311;
    let t1313: f64 = x3 * t1297;
    let t1315: f64 = x0 * t1298;
    let t1316: f64 = t1315 - t1313;
    let t1317: f64 = x1 * t1299;
    let t1318: f64 = t1316 + t1317;
    let t1319: f64 = x2 * t1297;
    let t1320: f64 = x1 * t1298;
    let t1321: f64 = t1319 - t1320;
    let t1322: f64 = x0 * t1299;
    let t1323: f64 = t1321 + t1322;
    let t1324: f64 = x0 * t1306;
    let t1326: f64 = t1324 + t1324;
    let t1328: f64 = x1 * t1312;
    let t1329: f64 = t1328 + t1328;
    let t1330: f64 = t1329 - t1326;
    let t1331: f64 = x2 * t1318;
    let t1332: f64 = t1331 + t1331;
    let t1333: f64 = t1330 + t1332;
    let t1334: f64 = x3 * t1323;
    let t1335: f64 = t1334 + t1334;
    let t1336: f64 = t1333 + t1335;
    let t1337: f64 = t1063 * t1336;
    let t1338: f64 = t1065 * t1337;
    let t1339: f64 = -t1338;
    let t1340: f64 = t1339 * inverse_root(t1060);
    let t1341: f64 = x0 * t1340;
    let t1342: f64 = t1065 * t1306;
    let t1344: f64 = t1341 - t1342;
    let t1345: f64 = x1 * t1340;
    let t1346: f64 = t1065 * t1312;
    let t1347: f64 = t1345 + t1346;
    let t1348: f64 = x2 * t1340;
    let t1349: f64 = t1065 * t1318;
    let t1350: f64 = t1348 + t1349;
    let t1351: f64 = x3 * t1340;
    let t1352: f64 = t1065 * t1323;
    let t1353: f64 = t1351 + t1352;
    let t1354: f64 = 1.159383754414387 * t899;
    let t1355: f64 = -t1354;
    let t1356: f64 = 1.159383754414387 * t908;
    let t1357: f64 = -t1356;
    let t1358: f64 = 1.159383754414387 * t924;
    let t1359: f64 = 0.5 * t880;
    let t1361: f64 = 0.5 * t886;
    let t1363: f64 = 0.5 * t892;
    let t1365: f64 = x1 * t1359;
    let t1367: f64 = x2 * t1361;
    let t1369: f64 = t1365 + t1367;
    let t1370: f64 = x3 * t1363;
    let t1372: f64 = t1369 + t1370;
    let t1373: f64 = x0 * t1359;
    let t1375: f64 = x3 * t1361;
    let t1377: f64 = t1373 + t1375;
    let t1379: f64 = x2 * t1363;
    let t1381: f64 = t1379 - t1377;
    let t1382: f64 = x3 * t1359;
    let t1384: f64 = x0 * t1361;
    let t1386: f64 = t1382 - t1384;
    let t1387: f64 = x1 * t1363;
    let t1389: f64 = t1386 - t1387;
    let t1390: f64 = x2 * t1359;
    let t1392: f64 = x1 * t1361;
    let t1394: f64 = t1392 - t1390;
    let t1395: f64 = x0 * t1363;
    let t1397: f64 = t1394 - t1395;
    let t1398: f64 = x0 * t1372;
    let t1399: f64 = t1398 + t1398;
    let t1400: f64 = x1 * t1381;
    let t1401: f64 = t1400 + t1400;
    let t1402: f64 = t1399 + t1401;
    let t1403: f64 = x2 * t1389;
    let t1404: f64 = t1403 + t1403;
    let t1405: f64 = t1402 + t1404;
    let t1406: f64 = x3 * t1397;
    let t1407: f64 = t1406 + t1406;
    let t1408: f64 = t1405 + t1407;
    let t1409: f64 = t1063 * t1408;
    let t1410: f64 = t1065 * t1409;
    let t1411: f64 = -t1410;
    let t1412: f64 = t1411 * inverse_root(t1060);
    let t1413: f64 = x0 * t1412;
    let t1414: f64 = t1065 * t1372;
    let t1415: f64 = t1413 + t1414;
    let t1416: f64 = x1 * t1412;
    let t1417: f64 = t1065 * t1381;
    let t1418: f64 = t1416 + t1417;
    let t1419: f64 = x2 * t1412;
    let t1420: f64 = t1065 * t1389;
    let t1421: f64 = t1419 + t1420;
    let t1422: f64 = x3 * t1412;
    let t1423: f64 = t1065 * t1397;
    let t1424: f64 = t1422 + t1423;
    if !(absolute(t341) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t422) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t466) > 1.0 * LEAST_PIVOT) { return false; }
    if !(absolute(t584) > 0.10790763242084472 * LEAST_PIVOT) { return false; }
    rate[0][0] = t1073;
    rate[1][0] = t1077;
    rate[2][0] = t1081;
    rate[3][0] = t1085;
    rate[4][0] = t1010;
    rate[5][0] = t1012;
    rate[6][0] = t1014;
    rate[0][1] = t1147;
    rate[1][1] = t1150;
    rate[2][1] = t1153;
    rate[3][1] = t1156;
    rate[4][1] = t1086;
    rate[5][1] = t1088;
    rate[6][1] = t1090;
    rate[0][2] = t1210;
    rate[1][2] = t1213;
    rate[2][2] = t1216;
    rate[3][2] = t1219;
    rate[4][2] = t1158;
    rate[5][2] = t1160;
    rate[6][2] = t1162;
    rate[0][3] = t1281;
    rate[1][3] = t1284;
    rate[2][3] = t1287;
    rate[3][3] = t1290;
    rate[4][3] = t1221;
    rate[5][3] = t1222;
    rate[6][3] = t1224;
    rate[0][4] = t1344;
    rate[1][4] = t1347;
    rate[2][4] = t1350;
    rate[3][4] = t1353;
    rate[4][4] = t1292;
    rate[5][4] = t1294;
    rate[6][4] = t1296;
    rate[0][5] = t1415;
    rate[1][5] = t1418;
    rate[2][5] = t1421;
    rate[3][5] = t1424;
    rate[4][5] = t1355;
    rate[5][5] = t1357;
    rate[6][5] = t1358;
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
