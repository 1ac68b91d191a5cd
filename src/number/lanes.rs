//! Several real numbers side by side, one in each lane of a vector register.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::{Extent, Field, Number, Packed, trigonometry};

/// How many numbers stand side by side: two registers of AVX2, one of AVX-512.
pub const LANES: usize = 8;

/// Eight real numbers that take the same way through the kinematics.
///
/// Each operation does in every lane what it does over `f64`, bit by bit. Loops over the lanes are
/// plain, so that the compiler turns them into vector instructions wherever it may use some.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes(pub [f64; LANES]);

impl Lanes {
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let mut lanes = self.0;
        for x in &mut lanes {
            *x = f(*x);
        }
        Lanes(lanes)
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut lanes = self.0;
        for (x, y) in lanes.iter_mut().zip(other.0) {
            *x = f(*x, y);
        }
        Lanes(lanes)
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |x, y| x + y)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |x, y| x - y)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |x, y| x * y)
    }
}

impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(other, |x, y| x / y)
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Lanes {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Number for Lanes {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Lanes([x; LANES])
    }
    /// That of the first lane.
    fn real(self) -> f64 {
        self.0[0]
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = trigonometry::sin_cos_of_each(self.0);
        (Lanes(sin), Lanes(cos))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.each(f64::sqrt)
    }
    fn asin(self) -> Self {
        self.each(Number::asin)
    }
    fn acos(self) -> Self {
        self.each(Number::acos)
    }
    fn atan(self) -> Self {
        self.each(Number::atan)
    }
    fn atan2(self, x: Self) -> Self {
        self.with(x, Number::atan2)
    }
    fn exp(self) -> Self {
        self.each(Number::exp)
    }
    fn ln(self) -> Self {
        self.each(Number::ln)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.each(f64::abs)
    }
    fn powf(self, exponent: Self) -> Self {
        self.with(exponent, Number::powf)
    }
    fn is_finite(self) -> bool {
        self.0.into_iter().all(f64::is_finite)
    }
    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        self.each(|x| x * factor)
    }
}

impl Field for Lanes {
    type Size = Lanes;
    #[inline(always)]
    fn conjugate(self) -> Self {
        self
    }
    #[inline(always)]
    fn norm_squared(self) -> Lanes {
        self * self
    }
    #[inline(always)]
    fn phase(self) -> Self {
        self.each(Field::phase)
    }
    #[inline(always)]
    fn stretched(self, factor: Lanes) -> Self {
        self * factor
    }
}

impl Extent for Lanes {
    #[inline(always)]
    fn least(self) -> f64 {
        // halves first: as many comparisons, but side by side
        let mut lanes = self.0;
        let mut width = LANES / 2;
        while width > 0 {
            for i in 0..width {
                let (x, y) = (lanes[i], lanes[i + width]);
                lanes[i] = if x < y { x } else { y };
            }
            width /= 2;
        }
        lanes[0]
    }
    #[inline(always)]
    fn greatest(self) -> f64 {
        let mut lanes = self.0;
        let mut width = LANES / 2;
        while width > 0 {
            for i in 0..width {
                let (x, y) = (lanes[i], lanes[i + width]);
                // a NaN stays whichever side it is on
                lanes[i] = if x <= y || y.is_nan() { y } else { x };
            }
            width /= 2;
        }
        lanes[0]
    }
}

impl Packed for Lanes {
    const WIDTH: usize = LANES;
    #[inline(always)]
    fn part(self, place: usize) -> f64 {
        self.0[place]
    }
    #[inline(always)]
    fn of_parts(parts: impl Fn(usize) -> f64) -> Self {
        Lanes(std::array::from_fn(parts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Lanes = Lanes([0.1, -2.0, 3.5, 1e4, -0.0, 7.25, -1e-9, 2e5]);

    #[test]
    fn every_lane_is_bit_for_bit_what_a_real_is() {
        let y = Lanes([1.5, 0.3, -2.0, 7.0, 11.0, -0.4, 1e3, 0.9]);
        let (sin, cos) = X.sin_cos();
        for i in 0..LANES {
            let (x, other) = (X.0[i], y.0[i]);
            assert_eq!((X + y).0[i], x + other);
            assert_eq!((X - y).0[i], x - other);
            assert_eq!((X * y).0[i], x * other);
            assert_eq!((X / y).0[i], x / other);
            assert_eq!(X.abs().sqrt().0[i], x.abs().sqrt());
            assert_eq!((sin.0[i], cos.0[i]), Number::sin_cos(x));
            assert_eq!(X.phase().0[i], x.phase());
        }
    }

    #[test]
    fn decisions_go_by_the_extreme_lane_and_a_nan_is_never_lost() {
        assert_eq!((X.least(), X.greatest()), (-2.0, 2e5));
        for i in 0..LANES {
            let mut lanes = X;
            lanes.0[i] = f64::NAN;
            assert!(lanes.greatest().is_nan(), "{i}");
            assert!(!lanes.is_finite());
        }
    }
}
