//! Interval arithmetic: images hold all values, and little more.

use std::f64::consts::PI;

use linkwork::number::*;

fn over(low: f64, high: f64) -> Interval {
    Interval { low, high }
}

/// A cheap reproducible sequence in [0, 1).
fn sequence(k: u64) -> f64 {
    let x = (k.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (k << 7)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (x >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn one_third_is_between_its_neighbours_and_three_thirds_hold_one() {
    let third = Interval::point(1.0) / Interval::point(3.0);
    assert!(third.low < third.high);
    assert!((third + third + third).contains(1.0));
    assert!((third * Interval::point(3.0)).contains(1.0));
}

#[test]
fn a_tenth_added_ten_times_holds_the_sum_of_the_exact_binary_tenths() {
    // 0.1 in binary is 3602879701896397/2⁵⁵; ten of them are 1 + 2⁻⁵³ + …, not an f64
    let tenth = Interval::point(0.1);
    let sum = (0..9).fold(tenth, |sum, _| sum + tenth);
    assert!(sum.low <= 1.0 && sum.high > 1.0);
    assert!(sum.width() < 1e-14);
}

#[test]
fn images_of_points_inside_are_inside_the_image() {
    for k in 0..20_000 {
        let centre = 20.0 * sequence(3 * k) - 10.0;
        let radius = 4.0 * sequence(3 * k + 1).powi(6);
        let x = Interval::around(centre, radius);
        let inside = centre + radius * (2.0 * sequence(3 * k + 2) - 1.0);
        let (sin, cos) = x.sin_cos();
        let (s, c) = (pxfm::f_sin(inside), pxfm::f_cos(inside));
        assert!(sin.contains(s) && cos.contains(c), "{x:?} {inside}");
        assert!(x.atan().contains(pxfm::f_atan(inside)));
        assert!((x * x).contains(inside * inside));
        assert!(x.abs().contains(inside.abs()));
        assert!(x.exp().contains(pxfm::f_exp(inside)));
        let y = Interval::around(3.0 * sequence(k), 0.1);
        assert!(x.atan2(y).contains(pxfm::f_atan2(inside, y.real())));
        let (one, width) = (sin * sin + cos * cos, x.width());
        assert!(one.contains(1.0) && one.width() < 4.0 * width + 1e-14);
    }
}

#[test]
fn constants_enclose_numbers_that_no_f64_is() {
    fn pi<T: Number>() -> T {
        T::pi()
    }
    let pi: Interval = pi();
    // sin falls through zero at π
    assert!(pxfm::f_sin(pi.low) > 0.0 && pxfm::f_sin(pi.high) < 0.0);
    // what is left of π beside the f64 nearest to it
    let rest = pxfm::f_sin(PI);
    for k in 1..=720 {
        let k = f64::from(k);
        let angle = Interval::degrees(k);
        // 180 x - k π, the products each with what rounding leaves of it
        let beyond = |x: f64| {
            let (a, b) = (180.0 * x, k * PI);
            (a - b) + (x.mul_add(180.0, -a) - k.mul_add(PI, -b)) - k * rest
        };
        assert!(beyond(angle.low) < 0.0 && beyond(angle.high) > 0.0, "{k}");
        assert!(angle.width() < 1e-15 * k);
        assert_eq!(Interval::degrees(-k), -angle);
    }
    assert_eq!(Interval::degrees(0.0), Interval::point(0.0));
}

#[test]
fn a_sine_over_its_peak_reaches_one_and_beside_it_does_not() {
    assert_eq!(over(1.0, 2.0).sin_cos().0.high, 1.0);
    assert!(over(1.0, 1.5).sin_cos().0.high < 0.9976);
    assert_eq!(over(4.0, 5.0).sin_cos().0.low, -1.0);
    assert_eq!(over(3.0, 3.3).sin_cos().1.low, -1.0);
}

#[test]
fn what_has_no_value_is_the_whole_line() {
    let around_zero = Interval::around(0.0, 1.0);
    assert!(!(Interval::point(1.0) / around_zero).is_finite());
    assert!(!around_zero.sqrt().is_finite());
    assert!(!around_zero.ln().is_finite());
}

#[test]
fn structural_zeros_and_ones_stay_exact() {
    let x = Interval::point(0.1) + Interval::point(0.2);
    assert_eq!(x * Interval::point(0.0), Interval::point(0.0));
    assert_eq!(x * Interval::point(1.0), x);
    assert_eq!(x + Interval::point(0.0), x);
}
