//! Following a curve of solutions: F(x) = 0 with one freedom left.

use linkwork::solve::*;

/// A curve in Rⁿ given by a function with its derivative by columns.
pub struct Plain<F>(pub usize, pub F);

impl<F: Fn(&[f64]) -> (Vec<f64>, Vec<f64>)> SolutionCurve for Plain<F> {
    type Point = Vec<f64>;
    fn unknowns(&self) -> usize {
        self.0
    }
    fn residual(&mut self, at: &Vec<f64>) -> Vec<f64> {
        self.1(at).0
    }
    fn linearise(&mut self, at: &Vec<f64>) -> (Vec<f64>, Vec<f64>) {
        self.1(at)
    }
    fn displaced(&self, at: &Vec<f64>, step: &[f64]) -> Vec<f64> {
        at.iter().zip(step).map(|(a, b)| a + b).collect()
    }
    fn difference(&self, from: &Vec<f64>, to: &Vec<f64>) -> Vec<f64> {
        to.iter().zip(from).map(|(a, b)| a - b).collect()
    }
}

/// x²/4 + y² = 1 twice over, so that the rows are redundant.
fn ellipse(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let r = 0.25 * x[0] * x[0] + x[1] * x[1] - 1.0;
    let columns = [[0.5 * x[0], x[0]], [2.0 * x[1], 4.0 * x[1]]];
    (vec![r, 2.0 * r], columns.concat())
}

#[test]
fn a_closed_curve_with_redundant_rows_is_followed_round_and_its_turning_points_are_exact() {
    let mut curve = Plain(2, ellipse);
    let method = Continuation::default();
    let start = method.settle(&mut curve, vec![0.3, 1.1]).unwrap();
    let mut place = start.towards(&[1.0, 0.0]);
    let (mut length, mut turned, mut folds) = (0.05, 0.0f64, Vec::new());
    while turned < std::f64::consts::TAU {
        let Ok((next, changed)) = method.step(&mut curve, &place, length) else {
            length *= 0.5;
            assert!(length > 1e-6);
            continue;
        };
        length = method.next_length(length, changed, &next);
        if place.tangent[0] * next.tangent[0] < 0.0 {
            let fold = method.root(&mut curve, &place, &next, &mut |_, p| p.tangent[0]);
            folds.push(fold.at);
        }
        let angle = |p: &[f64]| (2.0 * p[1]).atan2(p[0]);
        let moved = angle(&place.at) - angle(&next.at);
        turned += moved.rem_euclid(std::f64::consts::TAU);
        place = next;
    }
    assert_eq!(folds.len(), 2);
    for (fold, x) in folds.iter().zip([2.0, -2.0]) {
        let exact = (fold[0] - x).abs() < 1e-15 && fold[1].abs() < 1e-14;
        assert!(exact, "{fold:?}");
    }
}

#[test]
fn a_step_to_a_neighbouring_branch_is_refused() {
    // (y − 1e-3)(y + 1e-3) = x²·1e-12: two nearly straight lines close by
    let lines = |x: &[f64]| {
        let r = x[1] * x[1] - 1e-6 - 1e-12 * x[0] * x[0];
        (vec![r], vec![-2e-12 * x[0], 2.0 * x[1]])
    };
    // bent lines: y = ±(1e-3 + …) with a bend that the tangent misses
    let bent = |x: &[f64]| {
        let y = x[1] - 0.5 * x[0] * x[0];
        let r = y * y - 1e-4;
        (vec![r], vec![-2.0 * y * x[0], 2.0 * y])
    };
    let method = Continuation::default();
    let mut straight = Plain(2, lines);
    let place = method.settle(&mut straight, vec![0.0, 1e-3]).unwrap();
    let place = place.towards(&[1.0, 0.0]);
    assert!(method.step(&mut straight, &place, 0.1).is_ok());
    let mut curve = Plain(2, bent);
    let place = method.settle(&mut curve, vec![-0.3, 0.055]).unwrap();
    let mut place = place.towards(&[1.0, 0.0]);
    let across = method.step(&mut curve, &place, 0.5);
    assert!(across.is_err(), "a step across the other line");
    let mut length = 0.1;
    while place.at[0] < 0.3 {
        match method.step(&mut curve, &place, length) {
            Ok((next, changed)) => {
                length = method.next_length(length, changed, &next);
                place = next;
            }
            Err(_) => length *= 0.5,
        }
        let y = place.at[1] - 0.5 * place.at[0] * place.at[0];
        assert!((y - 1e-2).abs() < 1e-9, "{y}");
    }
}
