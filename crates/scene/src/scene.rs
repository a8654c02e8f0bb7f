//! A scene: what there is to be lit.

use crate::camera::View;
use crate::light::Light;
use crate::material::Material;
use crate::surface::Surface;
use radiosity_geometry::{Camera, NamedShape, SurfaceId};

/// What kind of file a scene comes from: not all say the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// TOML, or none.
    Toml,
    /// `.vs3` of View3D: surfaces and emittances alone.
    View3D,
}

/// Surfaces, their materials, lights and cameras.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What kind of file it comes from.
    pub kind: FileKind,
    /// The name of its file, without the ending.
    pub name: String,
    /// The surfaces.
    pub surfaces: Vec<Surface>,
    /// All materials.
    pub materials: Vec<Material>,
    /// The groups of emitters that are dimmed together; of scenes that were read, only those that
    /// are on surfaces.
    pub lights: Vec<Light>,
    /// The camera, if the scene has one.
    pub camera: Option<Camera>,
    /// Further cameras, in the order of the file.
    pub views: Vec<View>,
    /// Whether the file says that patches see nothing but fronts, so that rows should sum to 1.
    pub closed: bool,
}

impl Scene {
    /// The shapes of the surfaces, for whoever cuts them.
    pub fn shapes(&self) -> impl Iterator<Item = NamedShape<'_>> {
        self.surfaces.iter().map(|surface| NamedShape {
            name: &surface.name,
            shape: &surface.shape,
            is_obstruction: surface.is_obstruction,
        })
    }

    /// The material of a face, by its surface and its input index.
    pub fn material(&self, surface: SurfaceId, input_face: u32) -> &Material {
        let materials = &self.surfaces[surface.index()].materials;
        &self.materials[materials[input_face as usize]]
    }

    /// The group of a face, by its surface and its input index.
    pub fn group(&self, surface: SurfaceId, input_face: u32) -> &str {
        let surface = &self.surfaces[surface.index()];
        let of_face = surface.groups_of_faces.get(input_face as usize);
        of_face.map_or(&surface.group, |group| group)
    }

    /// The camera, or else that of the first view.
    pub fn first_camera(&self) -> Option<Camera> {
        let first_view = self.views.first().map(|view| view.camera);
        self.camera.or(first_view)
    }

    /// What a material emits with its light as bright as the scene has it.
    pub fn dimmed_emission(&self, material: &Material) -> [f64; 3] {
        material.dimmed_emission(&self.lights)
    }
}
