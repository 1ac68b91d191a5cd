//! Functions of complex numbers and gradients against those they generalise.

use linkwork::number::{Complex, Dual, Gradient, Number};

/// On a grid that meets both sides of each branch cut, against num-complex on the platform's functions.
#[test]
fn functions_agree_with_those_of_the_platform() {
    type Function = fn(Complex<f64>) -> Complex<f64>;
    let pairs: [(Function, Function); 6] = [
        (Number::sqrt, Complex::sqrt),
        (Number::asin, Complex::asin),
        (Number::acos, Complex::acos),
        (Number::atan, Complex::atan),
        (Number::exp, Complex::exp),
        (Number::ln, Complex::ln),
    ];
    let steps = || (-7..=7).map(|k| 0.37 * f64::from(k));
    for z in steps().flat_map(|x| steps().map(move |y| Complex::new(x, y))) {
        for (ours, theirs) in pairs {
            let (got, wanted) = (ours(z), theirs(z));
            let both = got.is_finite() && wanted.is_finite();
            assert!(
                !both || (got - wanted).norm() <= 4e-15 * wanted.norm().max(1.0),
                "{z}: {got}, {wanted}"
            );
        }
    }
    assert!(
        (Number::exp(Complex::new(1.0, 1.0)) - Complex::exp(Complex::new(1.0, 1.1))).norm() > 0.1
    );
}

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
