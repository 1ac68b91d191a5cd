//! Descent to a local minimum.

use linkwork::solve::walk_down;

#[test]
fn ends_where_the_function_has_no_value() {
    let cost = |x: &[f64]| if x[0] > 0.5 { f64::NAN } else { -x[0] };
    let x = walk_down(vec![0.0], cost, |_| vec![-1.0]);
    assert!((0.0..=0.5).contains(&x[0]), "{x:?}");
}

#[test]
fn finds_the_bottom_of_a_bent_valley() {
    // Rosenbrock 1960
    let cost = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
    let gradient = |x: &[f64]| {
        let bend = x[1] - x[0] * x[0];
        vec![-2.0 * (1.0 - x[0]) - 400.0 * x[0] * bend, 200.0 * bend]
    };
    let x = walk_down(vec![-1.2, 1.0], cost, gradient);
    assert!(
        (x[0] - 1.0).abs() < 1e-6 && (x[1] - 1.0).abs() < 1e-6,
        "{x:?}"
    );
}
