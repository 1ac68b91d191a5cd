//! Least-squares steps with a bordered matrix.

use linkwork::linear::*;

/// Two blocks of three rows with one own unknown each, three shared unknowns, one extra row.
fn example() -> (Bordered<f64>, Vec<f64>, Vec<f64>) {
    let layout = |own| ColumnBlock {
        rows: 3,
        own: vec![own],
        shared: vec![2, 3, 4],
    };
    let mut j = Bordered::new(5, vec![layout(0), layout(1)], 1, vec![2, 3, 4]);
    let entry = |k: usize| ((k * 37 + 11) % 17) as f64 / 7.0 - 1.0;
    let mut dense = vec![0.0; 7 * 5];
    for block in 0..2 {
        for column in 0..4 {
            for row in 0..3 {
                let value = entry(block * 12 + column * 3 + row);
                j.block_mut(block)[column * 3 + row] = value;
                let unknown = if column == 0 { block } else { column + 1 };
                dense[unknown * 7 + block * 3 + row] = value;
            }
        }
    }
    let extra = [0.3, -0.7, 1.1];
    for (k, value) in extra.into_iter().enumerate() {
        dense[(k + 2) * 7 + 6] = value;
    }
    (j, extra.to_vec(), dense)
}

#[test]
fn the_bordered_step_is_the_least_squares_step_of_the_whole() {
    for damping in [0.0, 0.3] {
        let (mut j, extra, dense) = example();
        let r = [0.4, -0.2, 0.9, 0.1, 0.5, -0.8, 0.25];
        let mut x = [0.0; 5];
        j.factorise(&extra, damping);
        j.solve(&r, &mut x);
        // normal equations (JᵀJ + λ) x = −Jᵀr by another library
        let dense = nalgebra::DMatrix::from_column_slice(7, 5, &dense);
        let normal = dense.transpose() * &dense + nalgebra::DMatrix::identity(5, 5) * damping;
        let rhs = -(dense.transpose() * nalgebra::DVector::from_row_slice(&r));
        let expected = normal.lu().solve(&rhs).expect("full rank");
        for k in 0..5 {
            assert!((x[k] - expected[k]).abs() < 1e-11, "{x:?} {expected}");
        }
        assert_eq!(j.nullity(), 0);
    }
}

#[test]
fn an_unknown_no_row_feels_is_reported_and_left_alone() {
    let (mut j, extra, _) = example();
    for value in &mut j.block_mut(1)[..3] {
        *value = 0.0;
    }
    j.factorise(&extra, 0.0);
    let mut x = [9.0; 5];
    j.solve(&[0.1; 7], &mut x);
    assert_eq!(j.nullity(), 1);
    assert_eq!(x[1], 0.0);
}
