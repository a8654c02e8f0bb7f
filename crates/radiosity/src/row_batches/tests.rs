//! How large batches are, and that parts of rows make the same as all at once.

use super::*;
use crate::observer::Silent;
use crate::{Context, Project, subdivide};
use radiosity_form_factors::Estimator;
use radiosity_geometry::{Discretization, Mesh};
use std::path::Path;

const MS: Duration = Duration::from_millis(1);

/// The pairs and the time of each batch on one thread, where rows have so many pairs and take so
/// long.
fn batches(rows: &[(u64, Duration)]) -> Vec<(u64, Duration)> {
    let mut rows = rows.iter().peekable();
    let mut size = BatchSize::first();
    let mut batches = Vec::new();
    while rows.peek().is_some() {
        let (mut pairs, mut time) = (0, Duration::ZERO);
        while let Some((more, longer)) = rows.next_if(|_| !size.is_reached(pairs, time)) {
            (pairs, time) = (pairs + more, time + *longer);
        }
        batches.push((pairs, time));
        size = size.next();
    }
    batches
}

fn longest(batches: &[(u64, Duration)]) -> Duration {
    batches.iter().map(|(_, time)| *time).max().unwrap()
}

#[test]
fn rows_slower_than_a_batch_are_batches_by_themselves() {
    let slow = [(1000, 2000 * MS); 20];
    assert_eq!(batches(&slow), slow);
}

#[test]
fn no_batch_is_longer_than_its_time_and_a_row() {
    let (fast, slow) = ((10_000, MS / 100), (10_000, 40 * MS));
    let suddenly = [vec![fast; 50_000], vec![slow; 100], vec![fast; 5000]].concat();
    assert!(longest(&batches(&suddenly)) < BatchSize::TIME + 40 * MS);
}

#[test]
fn fast_rows_are_many_to_a_batch() {
    let batches = batches(&vec![(10_000, MS / 1000); 20_000]);
    let total: u64 = batches.iter().map(|(pairs, _)| pairs).sum();
    let fewest = total / BatchSize::MOST_PAIRS;
    assert!(batches[0].0 < 2 * BatchSize::FIRST_PAIRS);
    assert!((batches.len() as u64) < fewest + 10, "{}", batches.len());
}

fn mesh() -> Mesh {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let project = Project::open(&scenes.join("cornell.toml")).unwrap();
    let params = Discretization::uniform(6);
    let patches = subdivide(&project.scene, &params, Context::default());
    patches.unwrap().mesh
}

/// In batches of one part of a row each, each after a checkpoint that the next begins at.
#[test]
fn batches_are_what_is_estimated_at_once() {
    let mesh = mesh();
    let estimation = Estimation::new(&mesh, Estimator::Accurate { tolerance: 0.01 });
    let whole = estimation.run();
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        let (at_once, tally) = pool.install(|| estimate_in_memory(&estimation, &Silent));
        assert!(
            at_once == whole.exchange.matrix().values(),
            "{threads} threads"
        );
        let exchange = radiosity_matrix::SymmetricMatrix::new(mesh.patches.len(), at_once);
        assert_eq!(
            estimation.complete(exchange.unwrap(), &tally).rows,
            whole.rows
        );
        let mut finished = Finished {
            rows: 0,
            begun: Vec::new(),
            tally: Tally::new(mesh.patches.len()),
            pairs: 0,
        };
        let (mut values, mut parts) = (Vec::new(), 0);
        let mut has_counted_begun_rows = false;
        loop {
            let mut batches = Batches::after(finished.clone(), &estimation, &Silent);
            batches.time = Duration::ZERO;
            let Some(batch) = pool.install(|| batches.next()) else {
                break;
            };
            values.extend(batch.values.concat());
            finished = batch.state.expect("a checkpoint behind each");
            assert_eq!(values.len(), packed_len(finished.rows as usize));
            let begun: usize = finished.begun.iter().map(|rows| rows.values.len()).sum();
            let known = values.len()..=values.len() + begun;
            assert!(known.contains(&(finished.pairs as usize)));
            has_counted_begun_rows |= finished.pairs as usize > values.len();
            parts += 1;
        }
        assert!(parts > 10, "{parts}");
        assert!(has_counted_begun_rows);
        assert_eq!(finished.pairs as usize, values.len());
        assert!(
            values == whole.exchange.matrix().values(),
            "{threads} threads"
        );
        let exchange = radiosity_matrix::SymmetricMatrix::new(mesh.patches.len(), values);
        let completed = estimation.complete(exchange.unwrap(), &finished.tally);
        assert_eq!(completed.rows, whole.rows);
        assert_eq!(completed.classes, whole.classes);
    }
}
