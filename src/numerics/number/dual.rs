use super::{Field, Number, chained, functions, operators};

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

operators!([Dual<T>; T]
    #[inline] Add add |a, b| dual(a.value + b.value, a.slope + b.slope);
    #[inline] Sub sub |a, b| dual(a.value - b.value, a.slope - b.slope);
    #[inline] Mul mul |a, b| dual(a.value * b.value, a.value * b.slope + a.slope * b.value);
    #[inline] Div div |a, b| {
        let value = a.value / b.value;
        dual(value, (a.slope - value * b.slope) / b.value)
    };
    #[inline] Neg neg |a| dual(-a.value, -a.slope);
);

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
    chained!();
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let (y, r2) = (self, self.value * self.value + x.value * x.value);
        dual(
            y.value.atan2(x.value),
            (x.value * y.slope - y.value * x.slope) / r2,
        )
    }
    #[inline]
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        let chosen = |then, otherwise| self.value.if_less(other.value, then, otherwise);
        dual(
            chosen(then.value, otherwise.value),
            chosen(then.slope, otherwise.slope),
        )
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
    #[inline]
    fn conjugate(self) -> Self {
        dual(self.value.conjugate(), self.slope.conjugate())
    }
    #[inline]
    fn norm_squared(self) -> f64 {
        self.value.norm_squared()
    }
    #[inline]
    fn phase(self) -> Self {
        match self.value.norm_squared() {
            0.0 => Dual::constant(self.value.phase()),
            size => self.scale(1.0 / size.sqrt()),
        }
    }
}
