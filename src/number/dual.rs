use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Extent, Field, Number, assigning};

/// A value with its derivative along one direction: a + a′ε with ε² = 0 (Clifford 1873).
///
/// Running the kinematics over duals differentiates it exactly, whatever the inner number is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The value a.
    pub value: T,
    /// The derivative a′.
    pub slope: T,
}

#[inline]
fn dual<T>(value: T, slope: T) -> Dual<T> {
    Dual { value, slope }
}

impl<T: Number> Dual<T> {
    /// The variable of differentiation, at `value`.
    #[inline]
    pub fn variable(value: T) -> Self {
        dual(value, T::one())
    }

    /// A constant: its derivative is zero.
    #[inline]
    pub fn constant(value: T) -> Self {
        dual(value, T::zero())
    }

    /// f(a) + f′(a) a′ε.
    #[inline]
    fn chain(self, value: T, derivative: T) -> Self {
        dual(value, derivative * self.slope)
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        dual(self.value + other.value, self.slope + other.slope)
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        dual(self.value - other.value, self.slope - other.slope)
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        dual(
            self.value * other.value,
            self.value * other.slope + self.slope * other.value,
        )
    }
}

impl<T: Number> Div for Dual<T> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        dual(value, (self.slope - value * other.slope) / other.value)
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        dual(-self.value, -self.slope)
    }
}

assigning!(Dual<T>, T);

impl<T: Number> Number for Dual<T> {
    const REAL: bool = T::REAL;

    #[inline]
    fn from_f64(x: f64) -> Self {
        Dual::constant(T::from_f64(x))
    }
    #[inline]
    fn real(self) -> f64 {
        self.value.real()
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::from_f64(0.5) / root)
    }
    #[inline]
    fn asin(self) -> Self {
        let a = self.value;
        self.chain(a.asin(), T::one() / (T::one() - a * a).sqrt())
    }
    #[inline]
    fn acos(self) -> Self {
        let a = self.value;
        self.chain(a.acos(), -(T::one() / (T::one() - a * a).sqrt()))
    }
    #[inline]
    fn atan(self) -> Self {
        let a = self.value;
        self.chain(a.atan(), T::one() / (T::one() + a * a))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let (y, r2) = (self, self.value * self.value + x.value * x.value);
        dual(
            y.value.atan2(x.value),
            (x.value * y.slope - y.value * x.slope) / r2,
        )
    }
    #[inline]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    #[inline]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::one() / self.value)
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
    #[inline]
    fn scale(self, factor: f64) -> Self {
        dual(self.value.scale(factor), self.slope.scale(factor))
    }
}

impl<T: Field> Field for Dual<T> {
    type Size = T::Size;
    #[inline]
    fn conjugate(self) -> Self {
        dual(self.value.conjugate(), self.slope.conjugate())
    }
    #[inline]
    fn norm_squared(self) -> T::Size {
        self.value.norm_squared()
    }
    #[inline]
    fn phase(self) -> Self {
        match self.value.norm_squared() {
            size if size.least() == 0.0 => Dual::constant(self.value.phase()),
            size => self.stretched(T::Size::one() / size.sqrt()),
        }
    }
    #[inline]
    fn stretched(self, factor: T::Size) -> Self {
        dual(self.value.stretched(factor), self.slope.stretched(factor))
    }
}
