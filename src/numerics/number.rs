//! The numbers that run through the one kinematics: reals, complex numbers, duals and intervals.
//!
//! A joint enters the algebra only through (cos, sin) or a slide, so chain products, closure
//! residuals and their Jacobians are written once over [`Number`].

/// Functions of complex numbers, the same on every machine.
pub mod complex;
mod dual;
mod folded;
mod gradient;
mod interval;
mod mark;
pub mod real;
pub mod residue;
pub mod sorting;
mod taylor;
pub mod tolerance;
pub(crate) mod trigonometry;
mod widest;

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

pub use dual::Dual;
pub use folded::Folded;
pub use gradient::Gradient;
pub use interval::Interval;
pub use mark::mark;
pub use num_complex::Complex;
pub use taylor::Taylor;
pub use widest::widest;

/// A complex number in double precision.
pub type C = Complex<f64>;

/// A number the kinematics can be evaluated over.
///
/// Every function is the analytic continuation of the real one, so that an identity between
/// dimensions which holds for reals holds for every implementor.
pub trait Number:
    Copy
    + Debug
    + PartialEq
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// True for real types, where roots and angles have a single branch; over complex numbers the branches are
    /// exchanged on a way round zero.
    const REAL: bool = true;

    /// The constant `x`.
    fn from_f64(x: f64) -> Self;
    /// π.
    #[inline]
    fn pi() -> Self {
        Self::from_f64(std::f64::consts::PI)
    }
    /// An angle given in degrees, in radians.
    #[inline]
    fn degrees(angle: f64) -> Self {
        Self::from_f64(angle.to_radians())
    }
    /// The real part: what comparisons and printed values use.
    fn real(self) -> f64;
    /// True if the number is a real constant: no imaginary part or derivative; an interval no wider than rounding.
    #[inline]
    fn is_real(self) -> bool {
        self == Self::from_f64(self.real())
    }
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Principal square root.
    fn sqrt(self) -> Self;
    /// Tangent of an angle in radians.
    #[inline]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }
    /// Arc sine, in radians.
    fn asin(self) -> Self;
    /// Arc cosine, in radians.
    fn acos(self) -> Self;
    /// Arc tangent, in radians.
    fn atan(self) -> Self;
    /// The angle of the point (`x`, `self`), in radians.
    fn atan2(self, x: Self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Compares real parts.
    #[inline]
    fn less(self, other: Self) -> bool {
        self.real() < other.real()
    }
    /// `then` where the real part is less than that of `other`, else `otherwise`.
    #[inline]
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.less(other) { then } else { otherwise }
    }
    /// `self` or `-self`, whichever has a real part that is not negative.
    #[inline]
    fn abs(self) -> Self {
        self.if_less(Self::zero(), -self, self)
    }
    /// The one of two with the lesser real part; the first if they are equal.
    #[inline]
    fn lesser(self, other: Self) -> Self {
        other.if_less(self, other, self)
    }
    /// The one of two with the greater real part; the first if they are equal.
    #[inline]
    fn greater(self, other: Self) -> Self {
        self.if_less(other, other, self)
    }
    /// Whole power.
    #[inline]
    fn powi(self, n: i32) -> Self {
        let (mut base, mut left, mut power) = (self, n.unsigned_abs(), Self::one());
        while left > 0 {
            if left & 1 == 1 {
                power *= base;
            }
            base *= base;
            left >>= 1;
        }
        if n < 0 { Self::one() / power } else { power }
    }
    /// Power with any exponent.
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        (self.ln() * exponent).exp()
    }
    /// True if no part of the number is infinite or NaN.
    fn is_finite(self) -> bool;
    /// Zero.
    #[inline]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
    /// One.
    #[inline]
    fn one() -> Self {
        Self::from_f64(1.0)
    }
    /// `self` times a real constant.
    #[inline]
    fn scale(self, factor: f64) -> Self {
        self * Self::from_f64(factor)
    }
}

/// The operators of a number; `+=`, `-=` and `*=` follow from the others.
macro_rules! operators {
    ($number:tt $(#[$inline:meta] $op:ident $name:ident |$a:ident $(, $b:ident)?| $value:expr;)*) => {
        $($crate::number::operators!(@of $number #[$inline] $op $name |$a $(, $b)?| $value);)*
        $crate::number::operators!(@assigning $number AddAssign add_assign +);
        $crate::number::operators!(@assigning $number SubAssign sub_assign -);
        $crate::number::operators!(@assigning $number MulAssign mul_assign *);
    };
    (@of [$number:ty $(; $t:ident)?] #[$inline:meta] $op:ident $name:ident
     |$a:ident $(, $b:ident)?| $value:expr) => {
        impl$(<$t: $crate::number::Number>)? std::ops::$op for $number {
            type Output = Self;
            #[$inline]
            fn $name(self $(, $b: Self)?) -> Self {
                let $a = self;
                $value
            }
        }
    };
    (@assigning [$number:ty $(; $t:ident)?] $op:ident $name:ident $sign:tt) => {
        impl$(<$t: $crate::number::Number>)? std::ops::$op for $number {
            #[inline(always)]
            fn $name(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    };
}
pub(crate) use operators;

/// Functions of one number, each by its value.
macro_rules! functions {
    (|$x:ident| $($name:ident: $value:expr,)*) => {
        $(#[inline]
        fn $name(self) -> Self {
            let $x = self;
            $value
        })*
    };
}
pub(crate) use functions;

/// The functions of a number with derivatives, each by its value and its derivative.
macro_rules! chained {
    () => {
        #[inline]
        fn sin_cos(self) -> (Self, Self) {
            let (sin, cos) = self.value.sin_cos();
            (self.chain(sin, cos), self.chain(cos, -sin))
        }
        functions!(|x|
            sqrt: {
                let root = x.value.sqrt();
                x.chain(root, T::from_f64(0.5) / root)
            },
            asin: x.chain(x.value.asin(), T::one() / (T::one() - x.value * x.value).sqrt()),
            acos: x.chain(x.value.acos(), -(T::one() / (T::one() - x.value * x.value).sqrt())),
            atan: x.chain(x.value.atan(), T::one() / (T::one() + x.value * x.value)),
            exp: {
                let e = x.value.exp();
                x.chain(e, e)
            },
            ln: x.chain(x.value.ln(), T::one() / x.value),
        );
    };
}
pub(crate) use chained;

/// A number with a conjugate and a size: what orthogonal factorisations need beyond [`Number`].
///
/// A dual has the size of its value, so that every decision over duals is that over its inner number.
pub trait Field: Number {
    /// Complex conjugate; the number itself for reals.
    fn conjugate(self) -> Self;
    /// Squared absolute value |z|².
    fn norm_squared(self) -> f64;
    /// The direction z/|z|, 1 for zero.
    fn phase(self) -> Self;
}
