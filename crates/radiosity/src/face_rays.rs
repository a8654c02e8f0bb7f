//! Rays from faces: some thousands tell roughly what there is to be seen.

use radiosity_geometry::{Face, FaceId, Ray};

/// Rays from each face.
const RAYS: u32 = 64;
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// At most so many of some faces, evenly spread.
pub(crate) fn spread(faces: &[FaceId], most: usize) -> impl Iterator<Item = FaceId> {
    let step = faces.len().div_ceil(most).max(1);
    faces.iter().step_by(step).copied()
}

/// Rays from the middle of a face, of density `cos / pi`.
pub(crate) fn cosine_rays(face: &Face) -> impl Iterator<Item = Ray> {
    let (from, normal) = (face.polygon.centroid(), face.normal);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    (0..RAYS).map(move |k| {
        // A spiral (Vogel 1979) over the disk, and up to the half-sphere: by the cosine.
        let radius = ((f64::from(k) + 0.5) / f64::from(RAYS)).sqrt();
        let (sin, cos) = (GOLDEN_ANGLE * f64::from(k)).sin_cos();
        let up = (1.0 - radius * radius).sqrt();
        let direction = radius * (cos * tangent + sin * bitangent) + up * normal;
        Ray::new(from, direction)
    })
}
