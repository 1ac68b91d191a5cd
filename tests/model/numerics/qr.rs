//! QR with column pivoting over real and complex numbers.

use linkwork::linear::*;
use linkwork::number::{Complex, Field};

fn example<T: Field>(entry: impl Fn(usize, usize) -> T) -> Qr<T> {
    let mut qr = Qr::new(4, 3, 0);
    qr.reset(4);
    for j in 0..3 {
        for i in 0..4 {
            qr.column_mut(j)[i] = entry(i, j);
        }
    }
    qr
}

#[test]
fn solves_a_consistent_tall_system_over_reals_and_complex_numbers() {
    fn check<T: Field>(entry: impl Fn(usize, usize) -> T, solution: [T; 3]) {
        let mut qr = example(&entry);
        qr.factorise(0.0);
        assert_eq!(qr.rank(), 3);
        let mut b =
            [0, 1, 2, 3].map(|i| (0..3).fold(T::zero(), |sum, j| sum + entry(i, j) * solution[j]));
        let mut x = [T::zero(); 3];
        qr.rotate(&mut b);
        qr.back_substitute(&mut b, &mut x);
        for j in 0..3 {
            let error = (x[j] - solution[j]).norm_squared();
            assert!(error < 1e-26, "{x:?}");
        }
    }
    let real = |i: usize, j: usize| ((3 * i + 5 * j + i * j * j) % 7) as f64 - 2.5;
    check(real, [1.0, -2.0, 0.5]);
    let solution = [(1.0, 2.0), (-0.5, 0.1), (0.0, 3.0)];
    let solution = solution.map(|(re, im)| Complex::new(re, im));
    check(|i, j| Complex::new(real(i, j), real(j + 1, i)), solution);
}

#[test]
fn a_repeated_column_lowers_the_rank_and_its_unknown_stays_zero() {
    let entry = |i: usize, j: usize| {
        if j == 0 {
            i as f64
        } else {
            1.0 + (i * i) as f64
        }
    };
    let mut qr = example(entry);
    qr.factorise(0.0);
    assert_eq!(qr.rank(), 2);
    let mut b = [1.0, 3.0, 7.0, 13.0];
    let mut x = [f64::NAN; 3];
    qr.rotate(&mut b);
    qr.back_substitute(&mut b, &mut x);
    assert!((x[0] - 1.0).abs() < 1e-12);
    assert!(x[1] == 0.0 || x[2] == 0.0);
    assert!((x[1] + x[2] - 1.0).abs() < 1e-12);
}
