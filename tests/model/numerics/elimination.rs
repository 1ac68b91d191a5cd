//! Rank, null space and least squares of a large matrix whose rows touch few unknowns each.

use super::numbers;
use linkwork::linear::*;

fn transposed(rows: usize, entries: &[f64]) -> Vec<f64> {
    let row = |i: usize| entries.iter().skip(i).step_by(rows).copied();
    (0..rows).flat_map(row).collect()
}

/// A ring of groups of rows, each of a given rank over its own unknown, two that it shares with its neighbours, and
/// one that all share.
fn ring(
    groups: usize,
    next: &mut impl FnMut() -> f64,
    rank: impl Fn(usize) -> usize,
) -> Vec<RowGroup> {
    let group = |k: usize| {
        let unknowns = vec![2 * k, 2 * k + 1, (2 * k + 3) % (2 * groups), 2 * groups];
        let wide = rank(k).min(4);
        let left: Vec<f64> = (0..5 * wide).map(|_| next()).collect();
        let right: Vec<f64> = (0..4 * wide).map(|_| next()).collect();
        let entry = |i: usize, j: usize| -> f64 {
            (0..wide).map(|m| left[5 * m + i] * right[4 * m + j]).sum()
        };
        let entries = (0..20).map(|k| entry(k % 5, k / 5)).collect();
        RowGroup {
            count: 5,
            unknowns,
            entries,
        }
    };
    (0..groups).map(group).collect()
}

#[test]
fn ranks_and_solutions_are_those_of_the_singular_values() {
    let mut next = numbers(4321);
    // as many freedoms as there are loops of too low a rank, and none where one loop has more equations
    let ranks: [&dyn Fn(usize) -> usize; 5] = [
        &|_| 2,
        &|k| if k == 3 { 1 } else { 2 },
        &|k| if k == 3 || k == 4 { 3 } else { 2 },
        &|k| k % 3,
        &|_| 4,
    ];
    for rank in ranks {
        for groups in [2, 5, 12] {
            let rows = ring(groups, &mut next, rank);
            let columns = 2 * groups + 1;
            let (count, entries) = dense(columns, &rows);
            let expected = Decomposition::of(count, columns, &entries);
            let found = Elimination::of(columns, rows);
            assert_eq!(found.rank(), expected.rank());
            let null_space = found.null_space();
            assert_eq!(null_space.len(), columns - found.rank());
            for motion in &null_space {
                assert!(norm(&found.product(motion)) < 1e-12);
                assert!((norm(motion) - 1.0).abs() < 1e-12);
            }
            let b: Vec<f64> = (0..count).map(|_| next()).collect();
            let gap: Vec<f64> = (found.solve(&b).iter())
                .zip(expected.solve(&b))
                .map(|(a, b)| a - b)
                .collect();
            assert!(norm(&gap) < 1e-9 * expected.condition(), "{gap:?}");
            let b: Vec<f64> = (0..columns).map(|_| next()).collect();
            let turned = transposed(count, &entries);
            let expected_turned = Decomposition::of(columns, count, &turned).solve(&b);
            let gap: Vec<f64> = (found.solve_transposed(&b).iter())
                .zip(expected_turned)
                .map(|(a, b)| a - b)
                .collect();
            assert!(norm(&gap) < 1e-9 * expected.condition(), "{gap:?}");
            let redundant = expected.left_null_space();
            for stress in found.left_null_vectors(2) {
                assert!(norm(&found.transposed_product(&stress)) < 1e-12 * norm(&stress));
                // no basis vector is missing in it
                assert!(
                    redundant
                        .iter()
                        .all(|known| dot(known, &stress).abs() > 1e-6)
                );
            }
            let (largest, smallest) = (found.largest(), found.smallest().0);
            let values = expected.singular_values();
            assert!(
                (largest / values[0] - 1.0).abs() < 0.1,
                "{largest} {values:?}"
            );
            let last = expected.smallest();
            assert!(
                smallest >= 0.999 * last && smallest < 1.5 * last,
                "{smallest} {values:?}"
            );
        }
    }
}

#[test]
fn the_change_beside_a_matrix_is_that_of_the_singular_values() {
    let mut next = numbers(4321);
    let (before, groups) = (ring(8, &mut next, |_| 2), 8);
    let columns = 2 * groups + 1;
    let after: Vec<RowGroup> = (before.iter())
        .map(|group| RowGroup {
            entries: group.entries.iter().map(|x| x + 0.1 * next()).collect(),
            ..group.clone()
        })
        .collect();
    let (count, here) = dense(columns, &before);
    let (_, there) = dense(columns, &after);
    let whole = Decomposition::of(count, columns, &here);
    let moved = there.chunks_exact(count).zip(here.chunks_exact(count));
    let changes: Vec<f64> = moved
        .flat_map(|(b, a)| {
            let change: Vec<f64> = b.iter().zip(a).map(|(b, a)| b - a).collect();
            whole.solve(&change)
        })
        .collect();
    let expected = singular_values(columns, columns, &changes)[0];
    let found = Elimination::of(columns, before);
    let change = found.relative_change(&after);
    assert!((change / expected - 1.0).abs() < 0.1, "{change} {expected}");
}

#[test]
fn a_column_within_the_rank_tolerance_is_free_and_one_beyond_it_is_not() {
    for (size, rank) in [(1e-9, 1), (1e-5, 2)] {
        let rows = RowGroup {
            count: 2,
            unknowns: vec![0, 1],
            entries: vec![1.0, 0.0, 1.0, size],
        };
        assert_eq!(Elimination::of(3, vec![rows]).rank(), rank);
    }
}
