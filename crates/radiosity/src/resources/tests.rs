//! What is told and refused.

use super::*;

#[test]
fn estimates_deserve_two_digits() {
    assert_eq!([0, 7, 99, 105_701].map(two_digits), [0, 7, 99, 100_000]);
}

/// What is said of what does not fit, with its remedy.
fn refusal(checked: Result<(), Error>) -> String {
    let error = checked.unwrap_err();
    format!("{error}: {}", error.remedy().unwrap())
}

#[test]
fn impossible_runs_are_refused_with_a_remedy() {
    let needs = |patches, points| Needs::of(patches, 6, Estimator::Regular { points });
    let error = refusal(needs(1 << 20, 3).check_memory());
    assert!(
        error.contains("1,048,576 patches need 2.2 TB of memory"),
        "{error}"
    );
    assert!(error.contains("into fewer patches"), "{error}");
    for patches in [500, 5000, 50_000] {
        let all = needs(patches, 3).with_closure(patches == 5000);
        let fit = two_digits(patches as u64);
        let remedy = all.remedy(all.memory + 1000);
        assert_eq!(remedy, Remedy::FewerPatches { fit: Some(fit) });
    }
    let mesh = Needs::of(1 << 20, 1 << 20, Estimator::Regular { points: 3 });
    let error = refusal(mesh.check_memory());
    assert!(
        error.contains("coarser meshes") && !error.contains("into fewer patches"),
        "{error}"
    );
    let (open, closed) = (needs(6000, 3), needs(6000, 3).with_closure(true));
    assert_eq!(closed.memory - open.memory, 4 * open.pairs);
    assert_eq!(closed.disk, 2 * open.disk);
    assert!(needs(100, 3).check_memory().is_ok());
    assert!(needs(4000, 64).memory > 500_000_000, "points count too");
    let error = refusal(check_parts(1 << 20, Remedy::words("use groups")));
    assert!(
        error.contains("8.8 TB") && error.contains("use groups"),
        "{error}"
    );
    let error = refusal(check_image(1 << 16, 1 << 16));
    assert!(
        error.contains("283 GB") && error.contains("smaller"),
        "{error}"
    );
}

#[test]
fn exports_that_do_not_fit_are_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let refused = refusal(check_export(folder.path(), u64::MAX));
    assert!(
        refused.contains("the export needs 18446744 TB of disk")
            && refused.contains("leave small entries out"),
        "{refused}"
    );
    assert!(check_export(folder.path(), 0).is_ok());
}
