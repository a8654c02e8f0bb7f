//! The scene as paths see it.

use crate::Rgb;
use crate::emitters::Emitters;
use radiosity_geometry::{DVec3, FaceId, Hit, Mesh, Occluders, Ray};
use radiosity_scene::Scene;

/// Faces with their materials, ready for paths.
pub(crate) struct World {
    occluders: Occluders,
    faces: Vec<FaceLight>,
    pub(crate) emitters: Emitters,
}

/// A face's orientation and material.
#[derive(Clone, Copy)]
pub(crate) struct FaceLight {
    pub(crate) normal: DVec3,
    /// Unit vectors at right angles to the normal and to each other.
    pub(crate) tangents: [DVec3; 2],
    /// Radiant exitance, W/m^2.
    pub(crate) emission: Rgb,
    pub(crate) reflectance: Rgb,
}

impl World {
    pub(crate) fn new(scene: &Scene, mesh: &Mesh) -> World {
        let light = |face: &radiosity_geometry::Face| {
            let material = scene.material(face.surface, face.input_index);
            FaceLight {
                normal: face.normal,
                tangents: face.normal.any_orthonormal_pair().into(),
                emission: scene.dimmed_emission(material),
                reflectance: material.reflectance,
            }
        };
        let faces: Vec<FaceLight> = mesh.faces.iter().map(light).collect();
        World {
            occluders: Occluders::new(mesh),
            emitters: Emitters::new(mesh, &faces),
            faces,
        }
    }

    pub(crate) fn face(&self, id: FaceId) -> &FaceLight {
        &self.faces[id.index()]
    }

    /// The first front that a ray from a face meets, and where; `None` for backs and for the
    /// background.
    pub(crate) fn next_front(&self, from: FaceId, ray: &Ray) -> Option<(FaceId, DVec3)> {
        World::front(self.occluders.closest_hit_from(from, ray), ray)
    }

    /// The first front that a ray from anywhere meets at a parameter from `near` on.
    pub(crate) fn first_front(&self, ray: &Ray, near: f64) -> Option<(FaceId, DVec3)> {
        let hit = self.occluders.closest_hit(ray, near, f64::INFINITY, None);
        World::front(hit, ray)
    }

    fn front(hit: Option<Hit>, ray: &Ray) -> Option<(FaceId, DVec3)> {
        let hit = hit.filter(|hit| hit.front)?;
        Some((hit.face, ray.at(hit.t)))
    }

    /// Whether nothing stands between two points on faces.
    pub(crate) fn sees(&self, from: (FaceId, DVec3), to: (FaceId, DVec3)) -> bool {
        !self.occluders.blocked(from.0, from.1, to.0, to.1)
    }
}
