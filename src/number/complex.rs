use super::{Complex, Field, Number, functions, trigonometry};

impl Number for Complex<f64> {
    const REAL: bool = false;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Complex::new(x, 0.0)
    }
    #[inline(always)]
    fn real(self) -> f64 {
        self.re
    }
    /// sin(x + iy) = sin x cosh y + i cos x sinh y, cos(x + iy) = cos x cosh y − i sin x sinh y.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = trigonometry::sin_cos(self.re);
        let (sinh, cosh) = trigonometry::sinh_cosh(self.im);
        (
            Complex::new(sin * cosh, cos * sinh),
            Complex::new(cos * cosh, -sin * sinh),
        )
    }
    functions!(|z|
        sqrt: root(z),
        asin: Complex::asin(z),
        acos: Complex::acos(z),
        atan: Complex::atan(z),
        exp: Complex::exp(z),
        ln: Complex::ln(z),
    );
    /// −i ln((x + iy)/√(x² + y²)), which is the analytic continuation of the real function.
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let i = Complex::new(0.0, 1.0);
        -i * ((x + i * self) / (x * x + self * self).sqrt()).ln()
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }
    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        Complex::new(self.re * factor, self.im * factor)
    }
}

/// The root with a real part that is not negative, in roots of real numbers, which are the same everywhere.
#[inline]
fn root(z: Complex<f64>) -> Complex<f64> {
    let t = (0.5 * (z.norm_sqr().sqrt() + z.re.abs())).sqrt();
    match t > 0.0 {
        true if z.re >= 0.0 => Complex::new(t, 0.5 * z.im / t),
        true => Complex::new(0.5 * z.im.abs() / t, t.copysign(z.im)),
        false => Complex::new(0.0, z.im),
    }
}

impl Field for Complex<f64> {
    #[inline(always)]
    fn conjugate(self) -> Self {
        self.conj()
    }
    #[inline(always)]
    fn norm_squared(self) -> f64 {
        self.norm_sqr()
    }
    #[inline(always)]
    fn phase(self) -> Self {
        match self.norm_sqr().sqrt() {
            0.0 => Complex::new(1.0, 0.0),
            size => Number::scale(self, 1.0 / size),
        }
    }
}
