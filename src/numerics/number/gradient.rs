use super::{Field, Number, chained, functions, operators};

/// A value with its derivatives along several directions at once: a + Σ aᵢ εᵢ with εᵢ εⱼ = 0.
///
/// One evaluation of the kinematics gives [`LANES`](Gradient::LANES) columns of a Jacobian, where duals give one each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<T = f64> {
    /// The value a.
    pub value: T,
    /// The derivatives aᵢ.
    pub slopes: [T; LANES],
}

/// The directions of one evaluation.
const LANES: usize = 8;

#[inline(always)]
fn lanes<T>(f: impl FnMut(usize) -> T) -> [T; LANES] {
    std::array::from_fn(f)
}

impl Gradient {
    /// The directions of one evaluation.
    pub const LANES: usize = LANES;
}

impl<T: Number> Gradient<T> {
    /// The variable of differentiation of a direction, at `value`.
    pub fn variable(value: T, direction: usize) -> Self {
        let slopes = lanes(|i| T::from_f64(f64::from(u8::from(i == direction))));
        Gradient { value, slopes }
    }

    /// A constant: its derivatives are zero.
    pub fn constant(value: T) -> Self {
        let slopes = [T::zero(); LANES];
        Gradient { value, slopes }
    }

    /// f(a) + f′(a) Σ aᵢ εᵢ.
    #[inline]
    fn chain(self, value: T, derivative: T) -> Self {
        let slopes = lanes(|i| derivative * self.slopes[i]);
        Gradient { value, slopes }
    }

    /// p a + q b as derivatives of a value.
    #[inline(always)]
    fn combined(value: T, (p, a): (T, &Self), (q, b): (T, &Self)) -> Self {
        let slopes = lanes(|i| p * a.slopes[i] + q * b.slopes[i]);
        Gradient { value, slopes }
    }
}

operators!([Gradient<T>; T]
    #[inline] Add add |a, b| Gradient {
        value: a.value + b.value,
        slopes: lanes(|i| a.slopes[i] + b.slopes[i]),
    };
    #[inline] Sub sub |a, b| Gradient {
        value: a.value - b.value,
        slopes: lanes(|i| a.slopes[i] - b.slopes[i]),
    };
    #[inline] Mul mul |a, b| Gradient::combined(a.value * b.value, (b.value, &a), (a.value, &b));
    #[inline] Div div |a, b| {
        let (inverse, value) = (T::one() / b.value, a.value / b.value);
        Gradient::combined(value, (inverse, &a), (-value * inverse, &b))
    };
    #[inline] Neg neg |a| a.chain(-a.value, -T::one());
);

impl<T: Number> Number for Gradient<T> {
    const REAL: bool = T::REAL;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Gradient::constant(T::from_f64(value))
    }
    #[inline]
    fn real(self) -> f64 {
        self.value.real()
    }
    chained!();
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let value = self.value.atan2(x.value);
        Gradient::combined(
            value,
            (x.value / square, &self),
            (-(self.value / square), &x),
        )
    }
    #[inline]
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        let chosen = |then, otherwise| self.value.if_less(other.value, then, otherwise);
        let slopes = lanes(|i| chosen(then.slopes[i], otherwise.slopes[i]));
        let value = chosen(then.value, otherwise.value);
        Gradient { value, slopes }
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }
    #[inline]
    fn scale(self, factor: f64) -> Self {
        let slopes = lanes(|i| self.slopes[i].scale(factor));
        let value = self.value.scale(factor);
        Gradient { value, slopes }
    }
}

impl<T: Field> Field for Gradient<T> {
    #[inline]
    fn conjugate(self) -> Self {
        let slopes = lanes(|i| self.slopes[i].conjugate());
        let value = self.value.conjugate();
        Gradient { value, slopes }
    }
    #[inline]
    fn norm_squared(self) -> f64 {
        self.value.norm_squared()
    }
    #[inline]
    fn phase(self) -> Self {
        Gradient::constant(self.value.phase())
    }
}
