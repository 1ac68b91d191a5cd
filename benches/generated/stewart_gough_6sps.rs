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

pub const INPUTS: usize = 6;
pub const STATE: usize = 7;
/// From this number on the state follows from the numbers before it.
pub const ITERATED: usize = 7;
pub const UNKNOWNS: usize = 6;
pub const ROWS: usize = 6;
pub const FRAMES: usize = 0;
/// In how many places there are two solutions.
pub const SIGNS: usize = 0;

/// The largest closure row that is accepted, in characteristic lengths and rad.
pub const TOLERANCE: f64 = 1e-14;
/// The same where a step makes it no smaller.
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

/// Unit quaternions again after a small change.
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
