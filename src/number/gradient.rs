use super::{Field, Number, functions, operators};

/// A value with its derivatives along several directions at once: a + Σ aᵢ εᵢ with εᵢ εⱼ = 0.
///
/// One evaluation of the kinematics gives [`LANES`](Gradient::LANES) columns of a Jacobian, where duals give one each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// The value a.
    pub value: f64,
    /// The derivatives aᵢ.
    pub slopes: [f64; Gradient::LANES],
}

#[inline(always)]
fn lanes(f: impl FnMut(usize) -> f64) -> [f64; Gradient::LANES] {
    std::array::from_fn(f)
}

impl Gradient {
    /// The directions of one evaluation.
    pub const LANES: usize = 8;

    /// The variable of differentiation of a direction, at `value`.
    pub fn variable(value: f64, direction: usize) -> Self {
        let slopes = lanes(|i| f64::from(u8::from(i == direction)));
        Gradient { value, slopes }
    }

    /// f(a) + f′(a) Σ aᵢ εᵢ.
    #[inline]
    fn chain(self, value: f64, derivative: f64) -> Self {
        let slopes = lanes(|i| derivative * self.slopes[i]);
        Gradient { value, slopes }
    }

    /// p a + q b as derivatives of a value.
    #[inline(always)]
    fn combined(value: f64, (p, a): (f64, &Self), (q, b): (f64, &Self)) -> Self {
        let slopes = lanes(|i| p * a.slopes[i] + q * b.slopes[i]);
        Gradient { value, slopes }
    }
}

operators!([Gradient]
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
        let (inverse, value) = (1.0 / b.value, a.value / b.value);
        Gradient::combined(value, (inverse, &a), (-value * inverse, &b))
    };
    #[inline] Neg neg |a| a.chain(-a.value, -1.0);
);

impl Number for Gradient {
    #[inline]
    fn from_f64(value: f64) -> Self {
        let slopes = [0.0; Gradient::LANES];
        Gradient { value, slopes }
    }
    #[inline]
    fn real(self) -> f64 {
        self.value
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Number::sin_cos(self.value);
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    functions!(|x|
        sqrt: {
            let root = x.value.sqrt();
            x.chain(root, 0.5 / root)
        },
        asin: x.chain(Number::asin(x.value), 1.0 / (1.0 - x.value * x.value).sqrt()),
        acos: x.chain(Number::acos(x.value), -1.0 / (1.0 - x.value * x.value).sqrt()),
        atan: x.chain(Number::atan(x.value), 1.0 / (1.0 + x.value * x.value)),
        exp: {
            let e = Number::exp(x.value);
            x.chain(e, e)
        },
        ln: x.chain(Number::ln(x.value), 1.0 / x.value),
    );
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let value = Number::atan2(self.value, x.value);
        Gradient::combined(value, (x.value / square, &self), (-self.value / square, &x))
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }
    #[inline]
    fn scale(self, factor: f64) -> Self {
        self.chain(self.value * factor, factor)
    }
}

impl Field for Gradient {
    #[inline]
    fn conjugate(self) -> Self {
        self
    }
    #[inline]
    fn norm_squared(self) -> f64 {
        self.value * self.value
    }
    #[inline]
    fn phase(self) -> Self {
        Gradient::from_f64(if self.value < 0.0 { -1.0 } else { 1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Dual;

    #[test]
    fn every_lane_is_a_dual() {
        fn f<T: Number>(x: T, y: T) -> T {
            let (sin, cos) = (x * y).sin_cos();
            (sin / (cos + T::from_f64(2.0))).atan2(x.sqrt()) + (x - y).exp().ln() * y.acos().abs()
        }
        let (x, y) = (0.7, 0.4);
        let found = f(Gradient::variable(x, 2), Gradient::variable(y, 5));
        let by_x = f(Dual::variable(x), Dual::constant(y));
        let by_y = f(Dual::constant(x), Dual::variable(y));
        assert_eq!(found.value, by_x.value);
        assert!((found.slopes[2] - by_x.slope).abs() < 1e-15);
        assert!((found.slopes[5] - by_y.slope).abs() < 1e-15);
        assert!((0..8).all(|i| i == 2 || i == 5 || found.slopes[i] == 0.0));
    }
}
