//! Scenes that are made in code.

use crate::light::Light;
use crate::material::Material;
use crate::scene::{FileKind, Scene};
use crate::surface::Surface;
use radiosity_geometry::Shape;

/// A material of a scene that is made in code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaterialId(usize);

impl Scene {
    /// An empty scene of this name.
    ///
    /// ```
    /// use radiosity_geometry::{DVec3, Shape};
    /// use radiosity_scene::{Material, Scene};
    ///
    /// let mut scene = Scene::new("tent");
    /// let cloth = scene.add_material(Material::reflecting("cloth", [0.6; 3]));
    /// let lamp = scene.add_material(Material::emitting("lamp", [5.0; 3]));
    /// let corners = |z| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]].map(DVec3::from);
    /// scene.add_surface("lamp", Shape::Triangle(corners(0.0)), lamp);
    /// scene.add_surface("roof", Shape::Triangle(corners(1.0)), cloth);
    /// assert_eq!(scene.lights[0].name, "lamp");
    /// ```
    pub fn new(name: &str) -> Scene {
        Scene {
            kind: FileKind::Toml,
            name: name.to_owned(),
            surfaces: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            camera: None,
            views: Vec::new(),
            closed: false,
        }
    }

    /// Adds a material. If it emits, it is a light of its own, which has its name.
    ///
    /// # Panics
    ///
    /// If there is a material of this name.
    pub fn add_material(&mut self, material: Material) -> MaterialId {
        let is_new = self
            .materials
            .iter()
            .all(|known| known.name != material.name);
        assert!(is_new, "there are two materials named `{}`", material.name);
        let emits = material.emission != [0.0; 3];
        let light = emits.then_some(self.lights.len());
        if emits {
            self.lights.push(Light::named(&material.name));
        }
        self.materials.push(Material { light, ..material });
        MaterialId(self.materials.len() - 1)
    }

    /// Adds a surface of one material.
    ///
    /// # Panics
    ///
    /// If there is a surface of this name, or if the material is of another scene.
    pub fn add_surface(&mut self, name: &str, shape: Shape, material: MaterialId) {
        let is_new = self.surfaces.iter().all(|surface| surface.name != name);
        assert!(is_new, "there are two surfaces named `{name}`");
        assert!(material.0 < self.materials.len(), "a material of the scene");
        let faces = match &shape {
            Shape::Mesh(mesh) => mesh.faces.len(),
            _ => 1,
        };
        let polygons = match &shape {
            Shape::Mesh(_) => (0..faces as u32).collect(),
            _ => Vec::new(),
        };
        self.surfaces.push(Surface {
            name: name.to_owned(),
            shape,
            is_obstruction: false,
            group: name.to_owned(),
            groups_of_faces: Vec::new(),
            materials: vec![material.0; faces],
            polygons,
        });
    }
}

impl Material {
    /// A material that reflects this much of each channel, 0 to 1, and emits nothing.
    pub fn reflecting(name: &str, reflectance: [f64; 3]) -> Material {
        Material {
            name: name.to_owned(),
            reflectance,
            emission: [0.0; 3],
            light: None,
        }
    }

    /// A material that emits this radiant exitance, W/m^2 per channel, and reflects nothing.
    pub fn emitting(name: &str, emission: [f64; 3]) -> Material {
        Material {
            emission,
            ..Material::reflecting(name, [0.0; 3])
        }
    }
}
