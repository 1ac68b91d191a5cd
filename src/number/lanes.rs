//! Several real numbers side by side, one in each lane of a vector register.

use super::{Extent, Field, Number, Packed, functions, operators, trigonometry};

/// How many numbers stand side by side: two registers of AVX2, one of AVX-512.
pub const LANES: usize = 8;

/// Eight real numbers on which the kinematics is evaluated at once.
///
/// Each operation gives in every lane the bits it gives over `f64`. Held as vectors of the processor:
/// the compiler keeps an array in memory between operations, a quarter slower for a workspace map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes(wide::f64x8);

impl Lanes {
    /// A number for each lane.
    #[inline(always)]
    pub const fn new(lanes: [f64; LANES]) -> Self {
        Lanes(wide::f64x8::new(lanes))
    }

    /// The number of each lane.
    #[inline(always)]
    pub fn lanes(self) -> [f64; LANES] {
        self.0.to_array()
    }

    /// Puts a number into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: f64) {
        self.0.as_mut_array()[lane] = value;
    }

    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let mut lanes = self.lanes();
        for x in &mut lanes {
            *x = f(*x);
        }
        Lanes::new(lanes)
    }

    /// All lanes combined, by halves, so that the operations are independent of one another.
    #[inline(always)]
    fn reduced(self, f: impl Fn(f64, f64) -> f64) -> f64 {
        let mut lanes = self.lanes();
        let mut width = LANES / 2;
        while width > 0 {
            for i in 0..width {
                lanes[i] = f(lanes[i], lanes[i + width]);
            }
            width /= 2;
        }
        lanes[0]
    }
}

operators!([Lanes]
    #[inline(always)] Add add |a, b| Lanes(a.0 + b.0);
    #[inline(always)] Sub sub |a, b| Lanes(a.0 - b.0);
    #[inline(always)] Mul mul |a, b| Lanes(a.0 * b.0);
    #[inline(always)] Div div |a, b| Lanes(a.0 / b.0);
    #[inline(always)] Neg neg |a| Lanes(-a.0);
);

impl Number for Lanes {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Lanes(wide::f64x8::splat(x))
    }
    /// That of the first lane.
    #[inline]
    fn real(self) -> f64 {
        self.0.as_array()[0]
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = trigonometry::sin_cos_of_each(self.lanes());
        (Lanes::new(sin), Lanes::new(cos))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(self.0.sqrt())
    }
    functions!(|x|
        asin: x.each(Number::asin),
        acos: x.each(Number::acos),
        atan: x.each(Number::atan),
        exp: x.each(Number::exp),
        ln: x.each(Number::ln),
    );
    #[inline]
    fn atan2(self, x: Self) -> Self {
        Lanes::new(trigonometry::atan2_of_each(self.lanes(), x.lanes()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(self.0.abs())
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        Lanes::of_parts(|i| self.part(i).powf(exponent.part(i)))
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.lanes().into_iter().all(f64::is_finite)
    }
    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        Lanes(self.0 * factor)
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
        self.reduced(|x, y| if x < y { x } else { y })
    }
    #[inline(always)]
    fn greatest(self) -> f64 {
        // a NaN stays whichever side it is on
        self.reduced(|x, y| if x <= y || y.is_nan() { y } else { x })
    }
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Lanes(self.0.fast_max(other.0))
    }
}

impl Packed for Lanes {
    const WIDTH: usize = LANES;
    #[inline(always)]
    fn part(self, place: usize) -> f64 {
        self.0.as_array()[place]
    }
    #[inline(always)]
    fn of_parts(parts: impl Fn(usize) -> f64) -> Self {
        Lanes::new(std::array::from_fn(parts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Lanes = Lanes::new([0.1, -2.0, 3.5, 1e4, -0.0, 7.25, -1e-9, 2e5]);

    #[test]
    fn every_lane_is_bit_for_bit_what_a_real_is() {
        let y = Lanes::new([1.5, 0.3, -2.0, 7.0, 11.0, -0.4, 1e3, 0.9]);
        let (sin, cos) = X.sin_cos();
        for i in 0..LANES {
            let (x, other) = (X.part(i), y.part(i));
            assert_eq!((X + y).part(i), x + other);
            assert_eq!((X - y).part(i), x - other);
            assert_eq!((X * y).part(i), x * other);
            assert_eq!((X / y).part(i), x / other);
            assert_eq!(X.abs().sqrt().part(i), x.abs().sqrt());
            assert_eq!((sin.part(i), cos.part(i)), Number::sin_cos(x));
            assert_eq!(X.phase().part(i), x.phase());
            assert_eq!(X.atan2(y).part(i), x.atan2(other));
        }
    }

    #[test]
    fn decisions_go_by_the_extreme_lane_and_a_nan_is_never_lost() {
        assert_eq!((X.least(), X.greatest()), (-2.0, 2e5));
        for i in 0..LANES {
            let mut lanes = X;
            lanes.set(i, f64::NAN);
            assert!(lanes.greatest().is_nan(), "{i}");
            assert!(!lanes.is_finite());
        }
    }
}
