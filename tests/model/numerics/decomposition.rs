//! Null spaces and shortest solutions of rank-deficient matrices.

use linkwork::linear::*;

#[test]
fn a_matrix_of_rank_two_has_both_null_spaces_and_the_shortest_solution() {
    // columns (1,0,1,0), (0,1,0,1), their sum
    let a = [1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let decomposition = Decomposition::of(4, 3, &a);
    assert_eq!(decomposition.rank(), 2);
    let null = decomposition.null_space();
    assert_eq!((null.len(), decomposition.left_null_space().len()), (1, 2));
    assert!((null[0][0] - null[0][1]).abs() < 1e-14 && (null[0][0] + null[0][2]).abs() < 1e-14);
    for w in decomposition.left_null_space() {
        for column in a.chunks_exact(4) {
            assert!(dot(&w, column).abs() < 1e-14);
        }
    }
    let x = decomposition.solve(&[1.0, 2.0, 1.0, 2.0]);
    assert!(
        (x[0] - 0.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14,
        "{x:?}"
    );
    assert!((x[2] - 1.0).abs() < 1e-14);
}

#[test]
fn singular_values_of_a_small_matrix_are_those_of_its_decomposition_in_either_shape() {
    // a diagonal of 3, 2 and 1e-9 between two reflections I − 2 u uᵀ/u·u
    let reflected = |u: &[f64], v: &mut [f64]| {
        let factor = -2.0 * dot(u, v) / dot(u, u);
        add(v, factor, u);
    };
    let known = [3.0, 2.0, 1e-9];
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for j in 0..3 {
        let mut weights = [0.0; 3];
        weights[j] = 1.0;
        reflected(&[0.3, -0.8, 0.4], &mut weights);
        let mut column = vec![0.0; 5];
        for k in 0..3 {
            column[k] = known[k] * weights[k];
        }
        reflected(&[0.2, 0.5, -0.1, 0.7, 0.9], &mut column);
        columns.push(column);
    }
    let tall = columns.concat();
    let flat: Vec<f64> = (0..5)
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect();
    for (rows, width, entries) in [(5, 3, &tall), (3, 5, &flat)] {
        let found = singular_values(rows, width, entries);
        assert_eq!(found.len(), 3);
        for (found, known) in found.iter().zip(known) {
            assert!((found - known).abs() < 1e-14 * 3.0, "{found} {known}");
        }
    }
    assert_eq!(
        singular_values(2, 2, &[1.0, 1.0, 2.0, 2.0])[1].max(1e-15),
        1e-15
    );
}
