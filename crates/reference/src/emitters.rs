//! Points on emitting faces, chosen by power.

use crate::world::FaceLight;
use radiosity_geometry::{DVec3, FaceId, Mesh, Polygon};
use rand::{Rng, RngExt};

/// The emitting faces of a scene.
pub(crate) struct Emitters {
    faces: Vec<(FaceId, Polygon)>,
    /// Power of each face and all before it, summed over channels, relative to the total.
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
            faces: Vec::new(),
            cumulative: Vec::new(),
            density: vec![0.0; lights.len()],
        };
        let mut sum = 0.0;
        for (face, density) in emitters.density.iter_mut().enumerate() {
            if power(face) > 0.0 {
                sum += power(face) / total;
                *density = strength(face) / total;
                let id = FaceId(face as u32);
                emitters.faces.push((id, mesh.faces[face].polygon));
                emitters.cumulative.push(sum);
            }
        }
        emitters
    }

    /// A point with the density of its face; `None` in the dark.
    pub(crate) fn sample(&self, rng: &mut impl Rng) -> Option<(FaceId, DVec3)> {
        let last = self.faces.len().checked_sub(1)?;
        let choice: f64 = rng.random();
        let index = self.cumulative.partition_point(|&sum| sum <= choice);
        let (face, polygon) = &self.faces[index.min(last)];
        Some((*face, uniform_point(polygon, rng)))
    }

    /// The probability per area of [`Emitters::sample`] at any point of a face.
    pub(crate) fn density(&self, face: FaceId) -> f64 {
        self.density[face.index()]
    }
}

/// A point with uniform density on a polygon: a triangle is folded from a parallelogram, a quad
/// is one of its two triangles by area.
pub(crate) fn uniform_point(polygon: &Polygon, rng: &mut impl Rng) -> DVec3 {
    let [a, b, c, d] = *polygon.padded_corners();
    let (s, t): (f64, f64) = (rng.random(), rng.random());
    let (s, t) = if s + t > 1.0 {
        (1.0 - s, 1.0 - t)
    } else {
        (s, t)
    };
    let (first, second) = (area(a, b, c), area(a, c, d));
    let in_first = second == 0.0 || rng.random::<f64>() * (first + second) < first;
    let (p, q) = if in_first { (b, c) } else { (c, d) };
    a + s * (p - a) + t * (q - a)
}

fn area(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    (b - a).cross(c - a).length()
}
