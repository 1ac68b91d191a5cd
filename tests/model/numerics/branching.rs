//! Points where branches of a curve of solutions cross: there the Jacobian loses rank.

use super::continuation::Plain;
use linkwork::linear::norm;
use linkwork::solve::*;

#[test]
fn a_crossing_is_located_to_rounding_with_both_branches() {
    // (y − x)(y + x/2 − 1) = 0, with a second, redundant row, and z = x²
    let lines = |x: &[f64]| {
        let (a, b) = (x[1] - x[0], x[1] + 0.5 * x[0] - 1.0);
        let r = a * b;
        let d = [-b + 0.5 * a, b + a, 0.0];
        let columns = [
            [d[0], 3.0 * d[0], -2.0 * x[0]],
            [d[1], 3.0 * d[1], 0.0],
            [0.0, 0.0, 1.0],
        ];
        (vec![r, 3.0 * r, x[2] - x[0] * x[0]], columns.concat())
    };
    let mut curve = Plain(3, lines);
    let method = Continuation::default();
    let point = method
        .branch_point(&mut curve, &vec![0.6, 0.61, 0.36], 0.2)
        .unwrap();
    let exact = [2.0 / 3.0, 2.0 / 3.0, 4.0 / 9.0];
    for (x, exact) in point.at.iter().zip(exact) {
        assert!((x - exact).abs() < 1e-14, "{:?}", point.at);
    }
    assert_eq!((point.freedoms, point.directions.len()), (2, 2));
    for direction in &point.directions {
        let slope = direction[1] / direction[0];
        assert!(
            (slope - 1.0).abs() < 1e-8 || (slope + 0.5).abs() < 1e-8,
            "{slope}"
        );
    }
}

#[test]
fn an_avoided_crossing_is_none() {
    // y² − x² = 1e-4: two branches that come near
    let near = |x: &[f64]| {
        let r = x[1] * x[1] - x[0] * x[0] - 1e-4;
        (vec![r], vec![-2.0 * x[0], 2.0 * x[1]])
    };
    let mut curve = Plain(2, near);
    let found = Continuation::default().branch_point(&mut curve, &vec![0.02, 0.025], 0.2);
    assert!(found.is_none());
}

#[test]
fn a_point_that_nothing_passes_is_told_from_a_crossing() {
    // x² + s y² + y³ = 0 on z = x: a point for s = 2, a crossing for s = −2, a cusp for s = 0
    let cubic = |s: f64| {
        move |x: &[f64]| {
            let r = x[0] * x[0] + s * x[1] * x[1] + x[1].powi(3);
            let slope = 2.0 * s * x[1] + 3.0 * x[1] * x[1];
            let columns = [[2.0 * x[0], -1.0], [slope, 0.0], [0.0, 1.0]];
            (vec![r, x[2] - x[0]], columns.concat())
        }
    };
    let method = Continuation::default();
    let at = |s: f64| {
        let mut curve = Plain(3, cubic(s));
        method.branch_point(&mut curve, &vec![0.01, -0.02, 0.01], 0.2)
    };
    let point = at(2.0).unwrap();
    assert!(norm(&point.at) < 1e-12 && point.isolated);
    assert!(point.directions.is_empty());
    let crossing = at(-2.0).unwrap();
    assert!(!crossing.isolated && crossing.directions.len() == 2);
    assert!(at(0.0).is_none_or(|cusp| !cusp.isolated));
}

#[test]
fn three_lines_in_space_through_one_point_are_told_apart() {
    // xy = 0, yz = 0, zx = 0: the axes
    let axes = |x: &[f64]| {
        let residual = vec![x[0] * x[1], x[1] * x[2], x[2] * x[0]];
        let columns = [[x[1], 0.0, x[2]], [x[0], x[2], 0.0], [0.0, x[1], x[0]]];
        (residual, columns.concat())
    };
    let method = Continuation::default();
    let point = method
        .branch_point(&mut Plain(3, axes), &vec![0.05, 0.0, 0.0], 0.2)
        .unwrap();
    assert!(norm(&point.at) < 1e-12);
    assert_eq!((point.freedoms, point.directions.len()), (3, 3));
}
