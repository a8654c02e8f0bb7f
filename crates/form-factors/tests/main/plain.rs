//! The regular rule as its definition says: what all else is measured against.

use radiosity_geometry::{DVec3, Mesh, Occluders, Polygon};
use std::f64::consts::PI;

/// The regular rule computes in single precision, relative to a point among eight patches:
/// distances between touching patches, of a sixth of an edge or more, are exact to `24 * 2^-24`,
/// and the kernel goes with the square of heights and distances.
pub(crate) const SINGLE: f64 = 2.0 * 24.0 / (1 << 24) as f64;

/// The plainest loop over all points of all patches, in double precision. Nothing is culled,
/// nothing shared.
pub(crate) struct Plain<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    /// By patch: the points, and the area each stands for.
    points: Vec<Vec<(DVec3, f64)>>,
}

impl<'a> Plain<'a> {
    pub(crate) fn new(mesh: &'a Mesh, n: u32) -> Plain<'a> {
        let patches = mesh.patches.iter();
        Plain {
            mesh,
            occluders: Occluders::new(mesh),
            points: patches.map(|patch| points(&patch.polygon, n)).collect(),
        }
    }

    /// `F_ij`.
    pub(crate) fn factor(&self, i: usize, j: usize) -> f64 {
        let (patch_i, patch_j) = (&self.mesh.patches[i], &self.mesh.patches[j]);
        if patch_i.face == patch_j.face {
            return 0.0;
        }
        let mut sum = 0.0;
        for &(p, area_p) in &self.points[i] {
            for &(q, area_q) in &self.points[j] {
                let d = q - p;
                let r = d.length();
                let cos_i = patch_i.normal.dot(d) / r;
                let cos_j = -patch_j.normal.dot(d) / r;
                let visible = || !self.occluders.blocked(patch_i.face, p, patch_j.face, q);
                if cos_i > 0.0 && cos_j > 0.0 && visible() {
                    sum += area_p * area_q * cos_i * cos_j / (PI * r * r);
                }
            }
        }
        sum / patch_i.area
    }
}

fn points(polygon: &Polygon, n: u32) -> Vec<(DVec3, f64)> {
    let strata = f64::from(n * n);
    let mut points = Vec::new();
    for a in 0..n {
        for b in 0..n {
            let [u, v] = [a, b].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            if !polygon.is_triangle() {
                let area = polygon.bilinear_jacobian(u, v);
                points.push((polygon.bilinear(u, v), area / strata));
                continue;
            }
            // Centroids of the n^2 sub-triangles, in any order.
            let third = 1.0 / (3.0 * f64::from(n));
            let [s, t] = [a, b].map(|k| f64::from(k) / f64::from(n));
            let (s, t) = if a + b < n {
                (s + third, t + third)
            } else {
                let turned = |x: f64| 1.0 - 1.0 / f64::from(n) - x + 2.0 * third;
                (turned(s), turned(t))
            };
            points.push((polygon.barycentric(s, t), polygon.area() / strata));
        }
    }
    points
}
