//! Points on emitting faces, chosen by power.

use crate::world::FaceLight;
use radiosity_geometry::{DVec3, FaceId, Mesh, Polygon};
use rand::{Rng, RngExt};

/// The emitting faces of a scene.
pub(crate) struct Emitters {
    triangles: Vec<(FaceId, Triangle)>,
    /// Power of each triangle and all before it, summed over channels, relative to the total.
    cumulative: Vec<f64>,
    /// For every face of the mesh: the probability per area of choosing a point on it.
    density: Vec<f64>,
}

impl Emitters {
    pub(crate) fn new(mesh: &Mesh, lights: &[FaceLight]) -> Emitters {
        let strength = |face: usize| lights[face].emission.iter().sum::<f64>();
        let power = |face: usize| strength(face) * mesh.faces[face].polygon.area();
        let total: f64 = (0..lights.len()).map(power).sum();
        let mut emitters = Emitters {
            triangles: Vec::new(),
            cumulative: Vec::new(),
            density: vec![0.0; lights.len()],
        };
        let mut sum = 0.0;
        for (face, density) in emitters.density.iter_mut().enumerate() {
            if power(face) > 0.0 {
                *density = strength(face) / total;
                for triangle in triangles(&mesh.faces[face].polygon) {
                    sum += *density * triangle.area();
                    emitters.triangles.push((FaceId(face as u32), triangle));
                    emitters.cumulative.push(sum);
                }
            }
        }
        emitters
    }

    /// A point with the density of its face; `None` in the dark.
    pub(crate) fn sample(&self, rng: &mut impl Rng) -> Option<(FaceId, DVec3)> {
        let last = self.triangles.len().checked_sub(1)?;
        let choice: f64 = rng.random();
        let index = self.cumulative.partition_point(|&sum| sum <= choice);
        let (face, triangle) = &self.triangles[index.min(last)];
        Some((*face, triangle.uniform_point(rng)))
    }

    /// The probability per area of [`Emitters::sample`] at any point of a face.
    pub(crate) fn density(&self, face: FaceId) -> f64 {
        self.density[face.index()]
    }
}

/// A point with uniform density on a polygon.
pub(crate) fn uniform_point(polygon: &Polygon, rng: &mut impl Rng) -> DVec3 {
    let [first, second] = triangles(polygon);
    let (first_area, second_area) = (first.area(), second.area());
    let in_first = rng.random::<f64>() * (first_area + second_area) < first_area;
    let triangle = if in_first { first } else { second };
    triangle.uniform_point(rng)
}

/// The triangles that a polygon consists of; a triangle consists of itself and of nothing.
fn triangles(polygon: &Polygon) -> [Triangle; 2] {
    let [a, b, c, d] = *polygon.padded_corners();
    [(b, c), (c, d)].map(|(b, c)| Triangle {
        corner: a,
        edges: [b - a, c - a],
    })
}

/// A corner and the edges that start there.
#[derive(Clone, Copy)]
struct Triangle {
    corner: DVec3,
    edges: [DVec3; 2],
}

impl Triangle {
    fn area(&self) -> f64 {
        0.5 * self.edges[0].cross(self.edges[1]).length()
    }

    /// A point with uniform density, folded from a parallelogram.
    fn uniform_point(&self, rng: &mut impl Rng) -> DVec3 {
        let (s, t): (f64, f64) = (rng.random(), rng.random());
        // 1 - s and 1 - t, if they lie beyond the diagonal: without a branch that nothing predicts.
        let fold = f64::from(u8::from(s + t > 1.0));
        self.corner + (fold - s).abs() * self.edges[0] + (fold - t).abs() * self.edges[1]
    }
}
