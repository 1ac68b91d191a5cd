//! One suite run over every number: whatever the kinematics is evaluated with obeys the same laws.

use linkwork::number::{Complex, Dual, Field, Interval, Number};

/// A number with generic parts, derived from a real part and a seed.
trait Sample: Field {
    fn sample(real: f64, seed: f64) -> Self;
    /// The largest absolute value of any part.
    fn size(self) -> f64;
}

impl Sample for f64 {
    fn sample(real: f64, _: f64) -> Self {
        real
    }
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Sample for Complex<f64> {
    fn sample(real: f64, seed: f64) -> Self {
        Complex::new(real, 0.3 * (5.1 * seed + 1.0).sin())
    }
    fn size(self) -> f64 {
        self.norm()
    }
}

/// Points, which operations widen by rounding: the laws hold for both ends.
impl Sample for Interval {
    fn sample(real: f64, _: f64) -> Self {
        Interval::point(real)
    }
    fn size(self) -> f64 {
        self.magnitude()
    }
}

impl<T: Sample> Sample for Dual<T> {
    fn sample(real: f64, seed: f64) -> Self {
        Dual {
            value: T::sample(real, seed),
            slope: T::sample((3.7 * seed + 2.0).cos(), seed + 1.0),
        }
    }
    fn size(self) -> f64 {
        self.value.size().max(self.slope.size())
    }
}

#[track_caller]
fn close<T: Sample>(a: T, b: T) {
    let error = (a - b).size();
    assert!(
        error <= 1e-13 * (1.0 + a.size().max(b.size())),
        "{a:?} and {b:?} differ by {error}"
    );
}

const REALS: [f64; 9] = [-2.3, -1.1, -0.7, -0.2, 0.15, 0.4, 0.9, 1.7, 2.6];

/// Triples of samples.
fn triples<T: Sample>() -> impl Iterator<Item = [T; 3]> {
    (0..REALS.len()).map(|i| {
        [0, 1, 2].map(|k| {
            let j = (i + 4 * k) % REALS.len();
            T::sample(REALS[j], (i + 10 * k) as f64)
        })
    })
}

/// Single samples, with real parts inside an interval.
fn within<T: Sample>(low: f64, high: f64) -> impl Iterator<Item = T> {
    let inside = REALS.into_iter().zip(0..);
    inside
        .filter(move |(x, _)| (low..=high).contains(x))
        .map(|(x, seed)| T::sample(x, f64::from(seed)))
}

fn one<T: Number>() -> T {
    T::one()
}

// equal operands are what these laws are about
#[allow(clippy::eq_op)]
fn field_laws<T: Sample>() {
    for [a, b, c] in triples::<T>() {
        close(a + b, b + a);
        close(a * b, b * a);
        close((a + b) + c, a + (b + c));
        close((a * b) * c, a * (b * c));
        close(a * (b + c), a * b + a * c);
        close(a + T::zero(), a);
        close(a * T::one(), a);
        close(a - a, T::zero());
        close(a + -a, T::zero());
        close(a / a, T::one());
        close(a / b * b, a);
        close(one::<T>() / (one::<T>() / a), a);
        close(a.scale(-2.5), a * T::from_f64(-2.5));
        let mut sum = a;
        sum += b;
        close(sum, a + b);
        sum -= b;
        close(sum, a);
        let mut product = a;
        product *= b;
        close(product, a * b);
        assert!(a.is_finite() && !(a / T::zero()).is_finite());
        assert_eq!(T::from_f64(1.25).real(), 1.25);
        assert!(a.abs().real() >= 0.0);
        close(a.abs() * a.abs(), a * a);
    }
}

fn conjugation_and_size<T: Sample>() {
    for [a, b, _] in triples::<T>() {
        close(a.conjugate().conjugate(), a);
        close((a * b).conjugate(), a.conjugate() * b.conjugate());
        close((a + b).conjugate(), a.conjugate() + b.conjugate());
        let product = (a * b).norm_squared();
        let expected = a.norm_squared() * b.norm_squared();
        assert!((product - expected).abs() <= 1e-13 * (1.0 + expected));
        let size = a.norm_squared();
        assert!(((a.conjugate() * a).real() - size).abs() <= 1e-14 * (1.0 + size));
        assert!(0.0 < size && size.is_finite());
        // a = |a| a/|a|, and a direction has length 1
        close(a.phase().scale(size.sqrt()), a);
        assert!((a.phase().norm_squared() - 1.0).abs() < 1e-14);
    }
}

fn circle<T: Sample>() {
    for [a, b, _] in triples::<T>() {
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        close(sa * sa + ca * ca, T::one());
        close(a.tan(), sa / ca);
        let (s, c) = (a + b).sin_cos();
        close(s, sa * cb + ca * sb);
        close(c, ca * cb - sa * sb);
        let (s, c) = (-a).sin_cos();
        close(s, -sa);
        close(c, ca);
    }
    let (s, c) = T::zero().sin_cos();
    close(s, T::zero());
    close(c, T::one());
}

fn inverse_functions<T: Sample>() {
    for x in within::<T>(-0.9, 0.9) {
        close(x.asin().sin_cos().0, x);
        close(x.acos().sin_cos().1, x);
        close(
            x.asin() + x.acos(),
            T::from_f64(std::f64::consts::FRAC_PI_2),
        );
    }
    for x in within::<T>(-1.3, 1.3) {
        close(x.atan().tan(), x);
        close(x.tan().atan(), x);
        close(x.atan(), x.atan2(T::one()));
        close(x.sin_cos().0.asin(), x);
    }
    // the angle of a point of the unit circle, all the way round
    for angle in within::<T>(-3.0, 3.0) {
        let (sin, cos) = angle.sin_cos();
        close(sin.atan2(cos), angle);
        let radius = T::sample(1.7, angle.real());
        close((radius * sin).atan2(radius * cos), angle);
    }
}

fn powers<T: Sample>() {
    for x in within::<T>(-2.5, 2.7) {
        close(x.powi(0), T::one());
        close(x.powi(3), x * x * x);
        close(x.powi(-2), one::<T>() / (x * x));
        close(x.powi(7), x.powi(4) * x.powi(3));
        close((-x).exp(), one::<T>() / x.exp());
    }
    for x in within::<T>(0.1, 2.7) {
        close(x.sqrt() * x.sqrt(), x);
        close(x.powf(T::from_f64(0.5)), x.sqrt());
        close(x.powf(T::from_f64(3.0)), x.powi(3));
        close(x.ln().exp(), x);
        close(x.exp().ln(), x);
        close((x * x).ln(), x.ln() + x.ln());
        close((x * x).sqrt(), x);
    }
}

/// f′ over duals of this number beside the derivative written down.
fn derivatives<T: Sample>() {
    #[track_caller]
    fn check<T: Sample>(
        x: T,
        f: impl Fn(Dual<T>) -> Dual<T>,
        plain: impl Fn(T) -> T,
        derivative: impl Fn(T) -> T,
    ) {
        let y = f(Dual::variable(x));
        close(y.value, plain(x));
        close(y.slope, derivative(x));
        assert_eq!(f(Dual::constant(x)).slope.size(), 0.0);
    }
    let half = || T::from_f64(0.5);
    for x in within::<T>(-2.5, 2.7) {
        check(x, |x| x.sin_cos().0, |x| x.sin_cos().0, |x| x.sin_cos().1);
        check(x, |x| x.sin_cos().1, |x| x.sin_cos().1, |x| -x.sin_cos().0);
        check(
            x,
            |x| x.tan(),
            |x| x.tan(),
            |x| T::one() + x.tan() * x.tan(),
        );
        check(
            x,
            |x| x.atan(),
            |x| x.atan(),
            |x| one::<T>() / (T::one() + x * x),
        );
        check(x, |x| x.exp(), |x| x.exp(), |x| x.exp());
        check(x, |x| x.powi(5), |x| x.powi(5), |x| x.powi(4).scale(5.0));
        check(
            x,
            |x| x.scale(-3.0),
            |x| x.scale(-3.0),
            |_| T::from_f64(-3.0),
        );
        check(
            x,
            |x| Dual::one() / (x * x),
            |x| one::<T>() / (x * x),
            |x| T::from_f64(-2.0) / (x * x * x),
        );
    }
    for x in within::<T>(0.1, 2.7) {
        check(x, |x| x.sqrt(), |x| x.sqrt(), |x| half() / x.sqrt());
        check(x, |x| x.ln(), |x| x.ln(), |x| one::<T>() / x);
        check(
            x,
            |x| x.powf(Dual::from_f64(1.5)),
            |x| x.powf(T::from_f64(1.5)),
            |x| x.sqrt().scale(1.5),
        );
    }
    for x in within::<T>(-0.9, 0.9) {
        let root = |x: T| (T::one() - x * x).sqrt();
        check(x, |x| x.asin(), |x| x.asin(), |x| one::<T>() / root(x));
        check(x, |x| x.acos(), |x| x.acos(), |x| -(one::<T>() / root(x)));
    }
    for [x, y, _] in triples::<T>() {
        let r2 = x * x + y * y;
        check(
            y,
            |y| y.atan2(Dual::constant(x)),
            |y| y.atan2(x),
            |_| x / r2,
        );
        check(
            x,
            |x| Dual::constant(y).atan2(x),
            |x| y.atan2(x),
            |_| -y / r2,
        );
    }
}

macro_rules! suite {
    ($($number:ident: $type:ty),+) => {
        $(mod $number {
            use super::*;
            #[test]
            fn obeys_the_laws_of_a_field() { field_laws::<$type>() }
            #[test]
            fn conjugates_and_measures() { conjugation_and_size::<$type>() }
            #[test]
            fn turns_on_a_circle() { circle::<$type>() }
            #[test]
            fn inverts_its_functions() { inverse_functions::<$type>() }
            #[test]
            fn raises_to_powers() { powers::<$type>() }
            #[test]
            fn is_differentiated_by_duals() { derivatives::<$type>() }
        })+
    };
}

suite! {
    real: f64,
    complex: Complex<f64>,
    dual: Dual<f64>,
    dual_complex: Dual<Complex<f64>>,
    interval: Interval,
    dual_interval: Dual<Interval>
}

#[test]
fn functions_of_complex_numbers_continue_the_real_ones() {
    for x in REALS {
        let z = Complex::new(x, 0.0);
        let continued = |f: fn(Complex<f64>) -> Complex<f64>, real: f64| {
            let value = f(z);
            assert!(
                (value - real).norm() <= 1e-14 * (1.0 + real.abs()),
                "{x}: {value} {real}"
            );
        };
        continued(|z| z.sin_cos().0, x.sin());
        continued(|z| z.sin_cos().1, x.cos());
        continued(Number::tan, x.tan());
        continued(Number::atan, x.atan());
        continued(Number::exp, x.exp());
        continued(Number::abs, x.abs());
        for y in REALS {
            let angle = Number::atan2(Complex::new(y, 0.0), z);
            assert!(
                (angle - y.atan2(x)).norm() < 1e-14,
                "atan2({y}, {x}): {angle}"
            );
        }
    }
    // Cauchy–Riemann: the derivative does not depend on the direction
    let h = 1e-6;
    let z = Complex::new(0.4, 0.7);
    let functions: [fn(Complex<f64>) -> Complex<f64>; 6] = [
        |z| z.sin_cos().0,
        |z| z.sin_cos().1,
        Number::sqrt,
        Number::asin,
        Number::ln,
        |z| Number::atan2(z, Complex::new(-0.6, 0.2)),
    ];
    for f in functions {
        let along = |dz: Complex<f64>| (f(z + dz) - f(z - dz)) / (dz * 2.0);
        let (real, imaginary) = (along(Complex::new(h, 0.0)), along(Complex::new(0.0, h)));
        assert!((real - imaginary).norm() < 1e-8);
    }
}
