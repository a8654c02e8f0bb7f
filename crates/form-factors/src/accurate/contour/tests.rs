//! Against closed forms (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors").

use super::*;
use radiosity_test_kit::closed_forms::closed_forms;
use radiosity_test_kit::mesh_of;
use std::f64::consts::PI;

fn exchange(i: &[DVec3], j: &[DVec3]) -> f64 {
    super::exchange(i, j, 1e-12).value
}

fn square(z: f64, up: bool, low: f64, high: f64) -> [DVec3; 4] {
    let corner = |x, y| DVec3::new(x, y, z);
    let corners = [
        corner(low, low),
        corner(high, low),
        corner(high, high),
        corner(low, high),
    ];
    if up {
        corners
    } else {
        [corners[0], corners[3], corners[2], corners[1]]
    }
}

/// Two unit squares that share the edge along y, opened by an angle.
fn hinged(degrees: f64) -> [[DVec3; 4]; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let leaf = DVec3::new(cos, 0.0, sin);
    [
        [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y],
        [DVec3::ZERO, DVec3::Y, DVec3::Y + leaf, leaf],
    ]
}

/// To the twelve digits of the table, and the tolerance of the contours.
#[test]
fn closed_forms_are_met() {
    for row in closed_forms() {
        let [i, j] = row.pair.map(|shape| mesh_of([shape]).patches.remove(0));
        let found = exchange(i.polygon.corners(), j.polygon.corners()) / i.area;
        let error = (found - row.factor).abs();
        assert!(error < 2e-12, "{}: {found:.14} {error:.1e}", row.name);
    }
}

/// Rotating a pair makes no edge parallel to an axis, and nothing else changes.
#[test]
fn rotation_changes_nothing() {
    let axis = DVec3::new(1.0, 2.0, -0.5).normalize();
    let turn = glam_rotation(axis, 1.1);
    for degrees in [30.0, 90.0, 150.0] {
        let pair = hinged(degrees);
        let turned = pair.map(|corners| corners.map(|c| turn(c) + DVec3::splat(7.0)));
        let (a, b) = (
            exchange(&pair[0], &pair[1]),
            exchange(&turned[0], &turned[1]),
        );
        assert!((a - b).abs() < 1e-12, "{degrees}: {a} {b}");
    }
}

fn glam_rotation(axis: DVec3, angle: f64) -> impl Fn(DVec3) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    move |v| cos * v + sin * axis.cross(v) + (1.0 - cos) * axis.dot(v) * axis
}

/// The exchange of a whole is the sum of the exchanges of its parts, also where the parts touch
/// the other polygon, or each other, in edges, parts of edges and corners at odd angles.
#[test]
fn parts_add_up() {
    let [i, j] = hinged(70.0);
    let whole = exchange(&i, &j);
    let center = DVec3::new(0.3, 0.6, 0.0);
    let fan: f64 = (0..4)
        .map(|k| exchange(&[i[k], i[(k + 1) % 4], center], &j))
        .sum();
    assert!((fan - whole).abs() < 1e-10, "{fan} {whole}");
    // Cut both across the shared edge, at different places: parts of edges touch.
    let mid = |a: DVec3, b: DVec3, t: f64| a + t * (b - a);
    let halves_i = [
        [i[0], i[1], mid(i[1], i[2], 0.4), mid(i[0], i[3], 0.3)],
        [mid(i[0], i[3], 0.3), mid(i[1], i[2], 0.4), i[2], i[3]],
    ];
    let halves_j = [
        [j[0], mid(j[0], j[1], 0.6), mid(j[3], j[2], 0.8), j[3]],
        [mid(j[0], j[1], 0.6), j[1], j[2], mid(j[3], j[2], 0.8)],
    ];
    let mut sum = 0.0;
    for part_i in &halves_i {
        for part_j in &halves_j {
            sum += exchange(part_i, part_j);
        }
    }
    assert!((sum - whole).abs() < 1e-10, "{sum} {whole}");
}

/// Far apart it is the kernel at the centres: rounding does not eat what is left.
#[test]
fn far_polygons_keep_their_digits() {
    let i = square(0.0, true, -0.5, 0.5);
    let axis = DVec3::new(0.3, 0.5, 0.4).normalize();
    let turn = glam_rotation(axis, 0.3);
    for r in [30.0, 100.0] {
        let j = square(0.0, false, -0.5, 0.5).map(|c| turn(c) + DVec3::new(0.0, 0.0, r));
        let cos = -turn(-DVec3::Z).z;
        let expected = cos.abs() / (PI * r * r);
        let found = exchange(&i, &j);
        let relative = found / expected - 1.0;
        assert!(relative.abs() < 2.0 / (r * r), "{r}: {relative}");
    }
}
