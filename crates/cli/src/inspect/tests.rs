//! Whoever wrote a file, and whatever is in it, it is described or refused.

use super::lines;
use radiosity::cache::{Id, Key, Miss, Store, open};
use radiosity::form_factors::{Classes, Estimator, FormFactors, RowFacts};
use radiosity::inspect::Inspection;
use radiosity::matrix::{DenseExchange, SymmetricMatrix};
use radiosity::metadata::{FORM_FACTORS, FactorFacts, SOLUTION, SolutionFacts};
use radiosity::solver::{Convergence, Method, Power};
use radiosity::{Energy, RowSummary};
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const PATCHES: usize = 5;
/// Their pairs.
const PAIRS: usize = 10;

fn factor_facts() -> FactorFacts {
    FactorFacts {
        estimator: Estimator::Accurate { tolerance: 1e-3 },
        patches_of_surfaces: vec![2, 3],
        exported_as: vec![4, 3, 2, 1, 0],
        areas: vec![1.0; PATCHES],
        elements: vec![1.0; PATCHES],
        rows: vec![RowFacts::default(); PATCHES],
        classes: Some(Classes::default()),
        closure: None,
    }
}

fn form_factors() -> FormFactors {
    let FactorFacts {
        areas,
        rows,
        classes,
        closure,
        ..
    } = factor_facts();
    FormFactors {
        exchange: DenseExchange::new(
            SymmetricMatrix::new(PATCHES, vec![0.0; PAIRS]).unwrap(),
            areas.clone(),
        ),
        areas,
        rows,
        classes,
        closure,
    }
}

fn solution_facts() -> SolutionFacts {
    SolutionFacts {
        report: Convergence {
            method: Method::ConjugateGradients,
            converged: true,
            stalled: false,
            residual: 1e-7,
            residuals: vec![1.0, 1e-7],
            error: None,
            relaxation: None,
            powers: vec![Power::default()],
        },
        rows: RowSummary::of(&form_factors(), |_| 0),
        lights: vec!["lamp".to_owned()],
        energies: vec![Energy::default()],
        elements: vec![1.0; PATCHES],
        visible: vec![1.0; PATCHES],
    }
}

/// The file of an artifact in a folder.
fn written(folder: &TempDir, stage: &str, facts: &impl Serialize, values: &[f32]) -> PathBuf {
    let store = Store::new(folder.path());
    let key = Key::of(stage, 1, &0);
    let id = Id {
        scene: "room",
        stage,
        key,
    };
    store.write(&id, facts, values).unwrap();
    store.path(&id)
}

fn inspected(path: &Path) -> Result<(), Miss> {
    let inspection = Inspection::of(open(path)?, None)?;
    assert!(!lines(&inspection).is_empty());
    serde_json::to_string(&inspection).unwrap();
    Ok(())
}

/// Makes the digest of a header fit again, as whoever forges a file does: magic, version, length of
/// the header, its digest, and the header.
fn seal(bytes: &mut [u8]) {
    let Some(length) = bytes.get(12..20) else {
        return;
    };
    let length = u64::from_le_bytes(length.try_into().unwrap());
    let end = usize::try_from(length)
        .unwrap_or(usize::MAX)
        .saturating_add(52);
    if let Some(header) = bytes.get(52..end) {
        let digest = blake3::hash(header);
        bytes[20..52].copy_from_slice(digest.as_bytes());
    }
}

/// Damages some of a file.
fn damage(bytes: &mut Vec<u8>, random: &mut impl FnMut(usize) -> usize) {
    let at = random(bytes.len());
    let rest = bytes.len() - at;
    match random(6) {
        _ if rest == 0 => {}
        0 => bytes[at] ^= 1 << random(8),
        1 => bytes[at] = random(256) as u8,
        2 => bytes.truncate(at),
        3 => bytes.extend(vec![0; random(100)]),
        // Counts and lengths of eight bytes, and numbers that are none.
        4 => bytes[at..at + rest.min(8)].fill(0xff),
        _ => drop(bytes.drain(at..at + rest.min(8))),
    }
}

#[test]
fn forged_files_are_described_or_refused() {
    let folder = TempDir::new().unwrap();
    let factors = written(&folder, FORM_FACTORS, &factor_facts(), &[0.0; PAIRS]);
    let solution = written(&folder, SOLUTION, &solution_facts(), &[0.5; 30]);
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % below.max(1)
    };
    let forged = folder.path().join("forged.bin");
    let mut described = 0;
    for path in [factors, solution] {
        inspected(&path).unwrap();
        let good = fs::read(path).unwrap();
        for round in 0..750 {
            let mut bytes = good.clone();
            (0..1 + random(3)).for_each(|_| damage(&mut bytes, &mut random));
            if round % 4 > 0 {
                seal(&mut bytes);
            }
            fs::write(&forged, bytes).unwrap();
            described += usize::from(inspected(&forged).is_ok());
        }
    }
    assert!(
        described > 20,
        "some change what can be anything: {described}"
    );
}

/// Facts of files that are as they were written may still not fit together.
#[test]
fn facts_that_do_not_fit_are_damage() {
    let folder = TempDir::new().unwrap();
    let refused = |facts: &FactorFacts, count: usize| {
        let path = written(&folder, FORM_FACTORS, facts, &vec![0.0; count]);
        let miss = inspected(&path).unwrap_err();
        assert!(matches!(miss, Miss::Header), "{miss}");
    };
    let with = |change: fn(&mut FactorFacts)| {
        let mut facts = factor_facts();
        change(&mut facts);
        facts
    };
    refused(&factor_facts(), PAIRS + 1);
    refused(&with(|facts| facts.patches_of_surfaces[1] = 2), PAIRS);
    refused(&with(|facts| facts.exported_as[0] = 5), PAIRS);
    refused(&with(|facts| facts.rows[1].fronts = f64::NAN), PAIRS);
    refused(
        &with(|facts| facts.rows[1].error = Some(f64::INFINITY)),
        PAIRS,
    );
    let refused = |facts: &SolutionFacts, values: &[f32]| {
        let path = written(&folder, SOLUTION, facts, values);
        let miss = inspected(&path).unwrap_err();
        assert!(matches!(miss, Miss::Header), "{miss}");
    };
    let mut values = [0.5; 30];
    refused(&solution_facts(), &values[1..]);
    values[17] = f32::NAN;
    refused(&solution_facts(), &values);
}
