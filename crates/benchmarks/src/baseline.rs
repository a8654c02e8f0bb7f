//! The form factors of the university course's program, as slow as they were: what speeds are
//! compared with.
//!
//! A transcription of the loop structure of that C++ program, not the program: for every pair of
//! points a ray is traced past all rectangles, whose closest hit decides, and only then are the
//! cosines looked at.

use radiosity::geometry::{DVec3, Mesh, Patch};
use std::f64::consts::PI;

/// Points along each edge of a patch.
const POINTS: usize = 3;
/// Hits nearer than this are those of the rectangle that the ray leaves.
const NEAREST: f64 = 1e-5;

struct Rectangle {
    corner: DVec3,
    edges: [DVec3; 2],
    normal: DVec3,
}

pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

/// The course's form factor loop over a mesh of parallelograms.
pub(crate) struct Baseline<'a> {
    pub(crate) mesh: &'a Mesh,
    rectangles: Vec<Rectangle>,
    points: Vec<Vec<DVec3>>,
}

impl<'a> Baseline<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Baseline<'a> {
        let rectangle = |face: &radiosity::geometry::Face| {
            let [a, b, _, d] = *face.polygon.padded_corners();
            Rectangle {
                corner: a,
                edges: [b - a, d - a],
                normal: face.normal,
            }
        };
        Baseline {
            mesh,
            rectangles: mesh.faces.iter().map(rectangle).collect(),
            points: mesh.patches.iter().map(points).collect(),
        }
    }

    /// The sum of the factors of a patch to all patches before it, and the pairs of points.
    pub(crate) fn row(&self, i: usize) -> (f64, u64) {
        let (mut sum, mut pairs) = (0.0, 0);
        for j in 0..i {
            if self.mesh.patches[i].face != self.mesh.patches[j].face {
                sum += self.factor(i, j);
                pairs += (POINTS * POINTS * POINTS * POINTS) as u64;
            }
        }
        (sum, pairs)
    }

    fn factor(&self, i: usize, j: usize) -> f64 {
        let (patch_i, patch_j) = (&self.mesh.patches[i], &self.mesh.patches[j]);
        let mut sum = 0.0;
        for &p in &self.points[i] {
            for &q in &self.points[j] {
                let distance = p.distance(q);
                let direction = (q - p) / distance;
                let origin = p;
                let first = self.closest(&Ray { origin, direction });
                if first.is_some_and(|(first, _)| first != patch_j.face.index()) {
                    continue;
                }
                let cos_i = patch_i.normal.dot(direction);
                let cos_j = -patch_j.normal.dot(direction);
                if cos_i > 0.0 && cos_j > 0.0 {
                    sum += cos_i * cos_j / (PI * distance * distance);
                }
            }
        }
        sum * patch_j.area / (POINTS * POINTS * POINTS * POINTS) as f64
    }

    /// The first rectangle that a ray meets, and where.
    pub(crate) fn closest(&self, ray: &Ray) -> Option<(usize, f64)> {
        let mut closest: Option<(usize, f64)> = None;
        for (k, rectangle) in self.rectangles.iter().enumerate() {
            let nearest = closest.map_or(f64::INFINITY, |(_, t)| t);
            if let Some(t) = rectangle.hit(ray).filter(|&t| t < nearest) {
                closest = Some((k, t));
            }
        }
        closest
    }
}

impl Rectangle {
    fn hit(&self, ray: &Ray) -> Option<f64> {
        let t = (self.corner - ray.origin).dot(self.normal) / ray.direction.dot(self.normal);
        if t.is_nan() || t <= NEAREST {
            return None;
        }
        let offset = ray.origin + t * ray.direction - self.corner;
        let inside = |edge: DVec3| (0.0..=edge.length_squared()).contains(&offset.dot(edge));
        self.edges.into_iter().all(inside).then_some(t)
    }
}

fn points(patch: &Patch) -> Vec<DVec3> {
    let at = |k: usize| (k as f64 + 0.5) / POINTS as f64;
    let row = |a: usize| (0..POINTS).map(move |b| (a, b));
    let pairs = (0..POINTS).flat_map(row);
    pairs
        .map(|(a, b)| patch.polygon.bilinear(at(a), at(b)))
        .collect()
}
