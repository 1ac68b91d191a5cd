//! Sine and cosine of a real angle and the angle of a point in the plane without branches, and
//! hyperbolic functions, bit for bit the same on every machine.

/// Largest angle for the three-part reduction, which loses digits beyond; there the correctly rounding library serves.
const REDUCIBLE: f64 = 1e5;

// π/2 as a sum, the first two terms with zeros in their last bits, so that k times them is exact
// for |k| < 2²⁰ (Cody and Waite 1980; the split is that of fdlibm's __ieee754_rem_pio2)
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E03_7073),
];

// minimax coefficients on |r| ≤ π/4 (fdlibm's __kernel_sin and __kernel_cos, Sun 1993)
const S: [f64; 6] = [
    -0.16666666666666632,
    0.00833333333332249,
    -0.0001984126982985795,
    2.7557313707070068e-06,
    -2.5050760253406863e-08,
    1.58969099521155e-10,
];
const C: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887411,
    2.480158728947673e-05,
    -2.7557314351390663e-07,
    2.087572321298175e-09,
    -1.1359647557788195e-11,
];

/// (sin x, cos x) for x in rad, to within 1 unit in the last place of 1.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    // infinities and NaN are reduced there too
    if x.abs() >= REDUCIBLE || x.is_nan() {
        return pxfm::f_sincos(x);
    }
    reduced(x)
}

/// (sinh x, cosh x) by one exponential, to within 3 units in the last place.
#[inline]
pub(crate) fn sinh_cosh(x: f64) -> (f64, f64) {
    if x == 0.0 {
        return (x, 1.0);
    }
    let grown = pxfm::f_exp(x.abs());
    let shrunk = 1.0 / grown;
    let cosh = 0.5 * (grown + shrunk);
    // below, the difference of exponentials loses digits, and seven terms of the series leave less than rounding: 2⁻¹⁴/15!
    if x.abs() >= 0.5 {
        return ((0.5 * (grown - shrunk)).copysign(x), cosh);
    }
    let z = x * x;
    let divisors = [156.0, 110.0, 72.0, 42.0, 20.0, 6.0];
    let series = (divisors.into_iter()).fold(1.0, |series, n| 1.0 + z / n * series);
    (x * series, cosh)
}

/// (sin, cos) of each angle, as [`sin_cos`], by vector instructions where the processor has them.
#[inline(always)]
pub(crate) fn sin_cos_of_each<const N: usize>(x: [f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sin, mut cos) = (x, x);
    for i in 0..N {
        (sin[i], cos[i]) = reduced(x[i]);
    }
    let mut reducible = true;
    for angle in x {
        reducible &= angle.abs() < REDUCIBLE;
    }
    if !reducible {
        for i in 0..N {
            (sin[i], cos[i]) = sin_cos(x[i]);
        }
    }
    (sin, cos)
}

/// The angle of (x, y) in [−π, π], to within 3 units in the last place of it.
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    match ordinary(y, x) {
        true => folded(y, x),
        // the library loses the sign of an angle that vanishes
        false => pxfm::f_atan2(y, x).copysign(y),
    }
}

/// Angle of each point, as [`atan2`], by vector instructions where the processor has them.
#[inline(always)]
pub(crate) fn atan2_of_each<const N: usize>(y: [f64; N], x: [f64; N]) -> [f64; N] {
    let mut angles = y;
    let mut all = true;
    for i in 0..N {
        angles[i] = folded(y[i], x[i]);
        all &= ordinary(y[i], x[i]);
    }
    if !all {
        for i in 0..N {
            angles[i] = atan2(y[i], x[i]);
        }
    }
    angles
}

/// True if a point is finite, does not overflow and is not the origin.
#[inline(always)]
fn ordinary(y: f64, x: f64) -> bool {
    let size = y.abs() + x.abs();
    size > 0.0 && size < f64::MAX
}

// π/4 as a sum, the first term with zeros in its last bits, so that k times it is exact for k ≤ 4
const QUARTER_PI: [f64; 2] = [f64::from_bits(0x3FE9_21FB_5440_0000), 3.038550253253096e-11];

// (atan t / t − 1)/t² as a polynomial in t², interpolated at the Chebyshev nodes of |t| ≤ tan π/8;
// t² times it is off by less than 8e-18
const A: [f64; 11] = [
    -0.3333333333333333,
    0.19999999999995516,
    -0.14285714284665682,
    0.11111111015187018,
    -0.0909090457530649,
    0.07692183125376892,
    -0.06664510525508936,
    0.05858140904866328,
    -0.050854078345894844,
    0.03923044778479309,
    -0.019175404711104935,
];

/// For an [`ordinary`] point.
#[inline(always)]
fn folded(y: f64, x: f64) -> f64 {
    let choose = |first: bool, a: f64, b: f64| if first { a } else { b };
    let (a, b) = (y.abs(), x.abs());
    let steep = a > b;
    let (low, high) = (choose(steep, b, a), choose(steep, a, b));
    // beyond tan π/8, atan(low/high) = π/4 + atan((low − high)/(low + high))
    let wide = low > 0.414_213_562_373_095_03 * high;
    let t = choose(wide, low - high, low) / choose(wide, low + high, high);
    let z = t * t;
    let (z2, z4) = (z * z, (z * z) * (z * z));
    let first = (A[0] + z * A[1]) + z2 * (A[2] + z * A[3]);
    let second = (A[4] + z * A[5]) + z2 * (A[6] + z * A[7]);
    let third = (A[8] + z * A[9]) + z2 * A[10];
    let part = t + t * z * (first + z4 * (second + z4 * third));
    // quarters of π to begin with, and which way on from there
    let back = x.is_sign_negative();
    let quarters = choose(wide, 1.0, 0.0);
    let quarters = choose(steep, 2.0 - quarters, quarters);
    let quarters = choose(back, 4.0 - quarters, quarters);
    let part = choose(steep != back, -part, part);
    (quarters * QUARTER_PI[0] + (quarters * QUARTER_PI[1] + part)).copysign(y)
}

/// For |x| below [`REDUCIBLE`].
#[inline(always)]
fn reduced(x: f64) -> (f64, f64) {
    // nearest whole number of quarter turns, by letting the sum with 3·2⁵¹ round: its last bits
    // are those of the number
    let shift = 6_755_399_441_055_744.0;
    let shifted = x * std::f64::consts::FRAC_2_PI + shift;
    let quadrant = shifted.to_bits();
    let k = shifted - shift;
    let r = ((x - k * HALF_PI[0]) - k * HALF_PI[1]) - k * HALF_PI[2];
    let z = r * r;
    let w = z * z;
    // Estrin's scheme: short dependency chains
    let s = (S[0] + z * S[1]) + w * ((S[2] + z * S[3]) + w * (S[4] + z * S[5]));
    let c = (C[0] + z * C[1]) + w * ((C[2] + z * C[3]) + w * (C[4] + z * C[5]));
    let sin = r + r * z * s;
    let cos = (1.0 - 0.5 * z) + w * c;
    // choices by bits: there is no branch to mispredict and none in the way of vectors
    let odd = (quadrant & 1).wrapping_neg();
    let swapped = (sin.to_bits() ^ cos.to_bits()) & odd;
    let sign = |quadrant: u64| (quadrant & 2) << 62;
    (
        f64::from_bits(sin.to_bits() ^ swapped ^ sign(quadrant)),
        f64::from_bits(cos.to_bits() ^ swapped ^ sign(quadrant.wrapping_add(1))),
    )
}

#[cfg(test)]
mod tests {
    #[test]
    fn agrees_with_the_correctly_rounding_library_to_one_unit_in_the_last_place() {
        let mut x: f64 = 1e-9;
        let mut worst = 0.0f64;
        for i in 0..200_000 {
            x = if i % 2 == 0 { -x * 1.000_137 } else { -x };
            let at = if x.abs() > 2e5 { x / 1e5 } else { x } + f64::from(i) * 1e-3;
            let ((s, c), (sin, cos)) = (super::sin_cos(at), pxfm::f_sincos(at));
            worst = worst.max((s - sin).abs()).max((c - cos).abs());
        }
        assert!(worst <= f64::EPSILON, "{worst:e}");
    }

    #[test]
    fn the_angle_of_a_point_agrees_with_the_correctly_rounding_library() {
        let mut worst = 0.0f64;
        for i in 0..200_000u32 {
            let (turn, far) = (f64::from(i) * 0.618_034, f64::from(i % 601) - 300.0);
            let size = 10f64.powf(far);
            let (sin, cos) = pxfm::f_sincos(turn);
            // near the axes as well
            let bent = 10f64.powi(-((i % 37) as i32));
            for (y, x) in [(sin, cos), (sin * bent, cos), (sin, cos * bent)] {
                let (y, x) = (y * size, x * size);
                let (angle, wanted) = (super::atan2(y, x), pxfm::f_atan2(y, x));
                worst = worst.max(((angle - wanted) / wanted).abs());
            }
        }
        assert!(worst <= 1.5 * f64::EPSILON, "{worst:e}");
    }

    #[test]
    fn the_angle_of_a_point_on_an_axis_or_far_out_is_that_of_the_standard() {
        let special = [0.0, 1.0, 5e-324, 1e-310, 1e300, f64::MAX, f64::INFINITY];
        for y in special.iter().flat_map(|y| [*y, -y]) {
            for x in special.iter().flat_map(|x| [*x, -x]) {
                let (angle, wanted) = (super::atan2(y, x), pxfm::f_atan2(y, x));
                let near = (angle - wanted).abs() <= f64::EPSILON * wanted.abs();
                let sign = angle.is_sign_negative() == y.is_sign_negative();
                assert!(near && sign, "{y:e} {x:e}: {angle:e}, {wanted:e}");
            }
        }
        assert!(super::atan2(f64::NAN, 1.0).is_nan() && super::atan2(1.0, f64::NAN).is_nan());
    }

    #[test]
    fn hyperbolic_functions_agree_with_the_correctly_rounding_library() {
        let mut worst = 0.0f64;
        for i in -40_000..=40_000 {
            let at = f64::from(i) * 1e-3 / 1.7;
            let ((s, c), (sinh, cosh)) =
                (super::sinh_cosh(at), (pxfm::f_sinh(at), pxfm::f_cosh(at)));
            if i != 0 {
                worst = worst.max(((s - sinh) / sinh).abs());
            }
            worst = worst.max(((c - cosh) / cosh).abs());
        }
        assert!(worst <= 3.0 * f64::EPSILON, "{worst:e}");
        assert_eq!(super::sinh_cosh(-0.0).0.to_bits(), (-0.0f64).to_bits());
        assert_eq!(super::sinh_cosh(1e-300), (1e-300, 1.0));
        assert_eq!(
            super::sinh_cosh(f64::NEG_INFINITY),
            (f64::NEG_INFINITY, f64::INFINITY)
        );
        assert!(super::sinh_cosh(f64::NAN).0.is_nan() && super::sinh_cosh(f64::NAN).1.is_nan());
    }

    #[test]
    fn is_exact_at_zero_and_passes_on_what_is_no_angle() {
        assert_eq!(super::sin_cos(0.0), (0.0, 1.0));
        assert!(super::sin_cos(f64::NAN).0.is_nan());
        assert!(super::sin_cos(f64::INFINITY).1.is_nan());
    }
}
