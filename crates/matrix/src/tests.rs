//! Rows, sums and blocks of small matrices, against plain loops.

use super::*;
use proptest::prelude::*;

fn counting(size: usize) -> SymmetricMatrix {
    let values: Vec<f32> = (0..packed_len(size)).map(|k| k as f32).collect();
    SymmetricMatrix::new(size, values).unwrap()
}

#[test]
fn wrong_length_is_refused() {
    let error = SymmetricMatrix::new(3, vec![0.0; 4]).unwrap_err();
    assert_eq!(error.to_string(), "the matrix needs 3 values but has 4");
}

#[test]
fn rows_are_the_lower_triangle() {
    let matrix = counting(4);
    let rows: Vec<Vec<f32>> = matrix.rows().map(|(_, row)| row.to_vec()).collect();
    assert_eq!(
        rows,
        [vec![], vec![0.0], vec![1.0, 2.0], vec![3.0, 4.0, 5.0]]
    );
}

proptest! {
    #[test]
    fn entries_are_symmetric_and_sum_to_row_sums(size in 0usize..40) {
        let matrix = counting(size);
        let sums = matrix.row_sums();
        let vector: Vec<f64> = (0..size).map(|j| (j % 7) as f64).collect();
        let products = matrix.product(&vector);
        for (i, &sum) in sums.iter().enumerate() {
            // Integers below 2^24: every sum is exact.
            let direct: f64 = (0..size).map(|j| f64::from(matrix.get(i, j))).sum();
            prop_assert_eq!(direct, sum);
            let entry = |j: usize| f64::from(matrix.get(i, j)) * (j % 7) as f64;
            prop_assert_eq!((0..size).map(entry).sum::<f64>(), products[i]);
            for j in 0..size {
                prop_assert_eq!(matrix.get(i, j), matrix.get(j, i));
            }
        }
    }

    #[test]
    fn lumped_sums_are_sums_over_blocks(part_of in prop::collection::vec(0usize..4, 0..40)) {
        let matrix = counting(part_of.len());
        let sums = matrix.block_sums(&part_of, 4);
        for (k, &sum) in sums.iter().enumerate() {
            let mut direct = 0.0;
            for i in (0..part_of.len()).filter(|&i| part_of[i] == k / 4) {
                for j in (0..part_of.len()).filter(|&j| part_of[j] == k % 4) {
                    direct += f64::from(matrix.get(i, j));
                }
            }
            prop_assert_eq!(direct, sum);
        }
    }

    #[test]
    fn some_rows_are_those_of_the_matrix(first in 0usize..40, more in 0usize..20) {
        let rows = first..first + more;
        let matrix = counting(rows.end);
        let mut values = matrix.values()[packed_len(first)..].to_vec();
        let found = rows_mut(rows.clone(), &mut values);
        for (row, found) in rows.zip(found) {
            prop_assert_eq!(&matrix.values()[packed_row(row)], &*found);
        }
    }
}
