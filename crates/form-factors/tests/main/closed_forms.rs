//! Every estimator against the one table of closed forms.

use crate::estimated::{accurate, regular};
use crate::monte_carlo::mean_of_runs;
use crate::plain::SINGLE;
use radiosity_test_kit::closed_forms::{closed_forms, closed_forms_apart, closed_forms_touching};
use radiosity_test_kit::{hinged, mesh_of};

/// Factors are stored in 24 bits, relative to the total area.
const STORED: f64 = 1.0 / (1 << 24) as f64;

/// Away from singularities the regular rule is a midpoint rule: its error falls with the square of
/// the points' spacing, so extrapolating from a spacing and its half leaves an error of the fourth
/// order. The constant is about 1 in units of the gap between patches; it is allowed to be 20.
#[test]
fn the_regular_rule_converges_to_them() {
    for row in closed_forms_apart() {
        let (mesh, exact) = (mesh_of(row.pair), row.factor);
        let points = (6.0 * row.longest_edge / row.gap).ceil().max(4.0) as u32;
        let [coarse, fine] = [points, 2 * points].map(|points| regular(&mesh, points).factor(0, 1));
        let order = ((coarse - exact) / (fine - exact)).log2();
        assert!((1.8..2.2).contains(&order), "{}: order {order}", row.name);
        let extrapolated = (4.0 * fine - coarse) / 3.0;
        let spacing = row.longest_edge / f64::from(points);
        let bound = (20.0 * (spacing / row.gap).powi(4) + 2.0 * SINGLE) * exact;
        let error = (extrapolated - exact).abs();
        assert!(
            error < bound,
            "{}: off by {error:.1e}, {bound:.1e}",
            row.name
        );
    }
}

/// At a common edge the kernel is homogeneous, of degree -2: points next to it are off by as much
/// at any spacing, over a strip as wide as the spacing. So the error is of the first order, and
/// extrapolation leaves one of the second. Its constant is 0.4 at most; it is allowed to be 2.
#[test]
fn the_regular_rule_overestimates_touching_patches() {
    for row in closed_forms_touching() {
        let (mesh, exact) = (mesh_of(row.pair), row.factor);
        let points = 24;
        let [coarse, fine] = [points, 2 * points].map(|points| regular(&mesh, points).factor(0, 1));
        let order = ((coarse - exact) / (fine - exact)).log2();
        assert!(fine > exact, "{}: {fine}", row.name);
        assert!((0.9..1.1).contains(&order), "{}: order {order}", row.name);
        let spacing = row.longest_edge / f64::from(points);
        let error = (2.0 * fine - coarse - exact).abs();
        assert!(
            error < 2.0 * spacing.powi(2) * exact,
            "{}: {error}",
            row.name
        );
    }
}

/// The known error of the course's rule: two squares at a right angle by +21.8 %.
#[test]
fn the_course_is_off_as_documented() {
    let factor = regular(&mesh_of(hinged(90.0)), 3).factor(0, 1);
    assert!((factor / 0.200_043_776 - 1.218).abs() < 0.0005, "{factor}");
}

/// The mean over independent seeds is within four of its own standard errors (one in 16,000). Where
/// patches touch, the kernel has no variance, and means no standard error.
#[test]
fn monte_carlo_is_unbiased() {
    for row in closed_forms_apart() {
        let (mesh, exact) = (mesh_of(row.pair), row.factor);
        for strata_and_pairs in [[3, 9], [2, 7], [1, 16]] {
            let mean = mean_of_runs(&mesh, strata_and_pairs);
            let error = (mean.value - exact).abs();
            assert!(error < 4.0 * mean.error, "{}: {mean:?}", row.name);
            assert!(mean.error < 0.2 * exact, "{}: {mean:?}", row.name);
        }
    }
}

/// Nothing stands between: contours and Gauss's rules give what the row says, at any tolerance.
#[test]
fn the_accurate_estimator_keeps_its_tolerance() {
    for row in closed_forms() {
        let (mesh, exact) = (mesh_of(row.pair), row.factor);
        for tolerance in [1e-6, 1e-3, 0.1] {
            let found = accurate(&mesh, tolerance);
            let (factor, said) = (found.factor(0, 1), found.rows[0].error.unwrap());
            let error = (factor - exact).abs();
            println!(
                "{} {tolerance}: off by {error:.1e}, said {said:.1e}",
                row.name
            );
            assert!(error <= said + STORED * exact, "{}: {error:.1e}", row.name);
            assert!(said <= tolerance, "{}: {said:.1e}", row.name);
        }
    }
}
