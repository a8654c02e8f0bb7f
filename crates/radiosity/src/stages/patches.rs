//! Stage 1: the patches of a scene.

use crate::advice;
use crate::context::Context;
use crate::error::Error;
use radiosity_cache::{Id, Key};
use radiosity_geometry::{Discretization, FaceOrder, Mesh, subdivide_in};
use radiosity_params::Parameters;
use radiosity_scene::{Material, Scene};
use std::collections::BTreeSet;

/// A scene cut into patches, with what they emit and reflect.
pub struct Patches<'a> {
    /// The patches.
    pub mesh: Mesh,
    pub(super) scene: &'a Scene,
    pub(super) context: Context<'a>,
    /// Of each light of the scene, undimmed, per patch.
    pub(super) lights: Vec<Vec<[f64; 3]>>,
    /// Per patch.
    pub(super) reflectance: Vec<[f64; 3]>,
}

/// Cuts the surfaces of a scene into patches.
pub fn subdivide<'a>(
    scene: &'a Scene,
    params: &Discretization,
    context: Context<'a>,
) -> Result<Patches<'a>, Error> {
    params.check()?;
    check_lights(scene)?;
    let known: BTreeSet<&str> = scene.shapes().map(|shape| shape.name).collect();
    let mut rules = params.surfaces.keys();
    if let Some(name) = rules.find(|name| !known.contains(name.as_str())) {
        return Err(Error::not_in_scene("surface", name, known.iter().copied()));
    }
    let surfaces = params.of_shapes(scene.shapes());
    let mesh = subdivide_in(FaceOrder::Curve, &surfaces, params.default);
    let mesh = mesh.map_err(|error| Error::of_mesh(scene, params, &error))?;
    for note in advice::notes(scene, &mesh) {
        context.observer.note(&note);
    }
    let patches = mesh.patches.len();
    let material = |patch: usize| {
        let face = mesh.face_of(patch);
        scene.material(face.surface, face.input_index)
    };
    let of_light = |light: usize| {
        let emission = |patch: usize| {
            let material = material(patch);
            let shines = material.light == Some(light);
            if shines { material.emission } else { [0.0; 3] }
        };
        (0..patches).map(emission).collect()
    };
    Ok(Patches {
        lights: (0..scene.lights.len()).map(of_light).collect(),
        reflectance: (0..patches)
            .map(|patch| material(patch).reflectance)
            .collect(),
        scene,
        context,
        mesh,
    })
}

impl<'a> Patches<'a> {
    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Where results are kept, and who is told.
    pub fn context(&self) -> Context<'a> {
        self.context
    }

    /// The name of the surface that a patch belongs to.
    pub fn surface_name(&self, patch: usize) -> &'a str {
        &self.scene.surfaces[self.mesh.patches[patch].surface.index()].name
    }

    pub(super) fn id(&self, stage: &'static str, key: Key) -> Id<'a> {
        let scene = &self.scene.name;
        Id { scene, stage, key }
    }
}

/// Refuses a material that emits and belongs to no light.
fn check_lights(scene: &Scene) -> Result<(), Error> {
    let is_lost = |material: &&Material| {
        let has_light = material
            .light
            .is_some_and(|light| light < scene.lights.len());
        material.emission != [0.0; 3] && !has_light
    };
    let on_surfaces = scene.surfaces.iter().flat_map(|surface| &surface.materials);
    let mut materials = on_surfaces.map(|&material| &scene.materials[material]);
    match materials.find(is_lost) {
        Some(lost) => Err(Error::NoLight {
            material: lost.name.clone(),
        }),
        None => Ok(()),
    }
}
