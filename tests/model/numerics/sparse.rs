//! Sparse least-squares steps.

use linkwork::linear::ColumnBlock;
use linkwork::linear::*;

#[test]
fn the_sparse_step_is_the_least_squares_step_with_and_without_damping() {
    // a chain: block k of three rows touches unknowns k and k + 1
    let size = 8;
    let entry = |k: usize| ((k * 29 + 7) % 13) as f64 / 5.0 - 1.1;
    let blocks: Vec<Filled<f64>> = (0..size - 1)
        .map(|k| Filled {
            block: ColumnBlock {
                rows: 3,
                own: vec![],
                shared: vec![k, k + 1],
            },
            entries: (0..6).map(|i| entry(6 * k + i)).collect(),
        })
        .collect();
    let extra: Vec<f64> = (0..size).map(|k| entry(100 + k)).collect();
    let rows = 3 * (size - 1) + 1;
    let mut dense = nalgebra::DMatrix::zeros(rows, size);
    for (k, filled) in blocks.iter().enumerate() {
        for (i, &value) in filled.entries.iter().enumerate() {
            dense[(3 * k + i % 3, k + i / 3)] = value;
        }
    }
    for (j, &value) in extra.iter().enumerate() {
        dense[(rows - 1, j)] = value;
    }
    let r: Vec<f64> = (0..rows).map(|k| entry(200 + k)).collect();
    for damping in [0.0, 0.3] {
        let mut sparse = SparseNormal::new(size, &blocks, 1);
        sparse.factorise(&blocks, &extra, damping);
        let mut x = vec![0.0; size];
        sparse.step(&blocks, &r, &mut x);
        let rhs = -(dense.transpose() * nalgebra::DVector::from_row_slice(&r));
        let normal = dense.transpose() * &dense + nalgebra::DMatrix::identity(size, size) * damping;
        let expected = normal.lu().solve(&rhs).expect("full rank");
        for k in 0..size {
            assert!((x[k] - expected[k]).abs() < 1e-10, "{x:?} {expected}");
        }
    }
}
